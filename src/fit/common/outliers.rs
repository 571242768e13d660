//! Gross errors among data: found against their neighbours, left out of the fit, and taken back where the fit that
//! does without them agrees with them.
//!
//! ```text
//! predict each datum from its neighbours, by a quadratic that gross errors among them do not move
//! suspect what lies far off, unless neighbours are off alike: that is a ridge
//! fit without the suspects
//! take back those that the surface meets, leave out what it misses and neighbours do not predict, and fit again
//! ```
//! The quadratic is a robust regression: iteratively reweighed, first towards the least sum of distances, then with the
//! biweight (A. Beaton, J. Tukey, "The fitting of power series, meaning polynomials, illustrated on band-spectroscopic
//! data", Technometrics 16 (1974), 147-185; P. Huber, "Robust statistics", 1981, chapter 7).

use super::error::FitError;
use super::report::{Tolerance, ToleranceScale};
use super::{Demands, Fit};
use crate::control::{Control, Pool};
use crate::geometry::Bounds;
use crate::lists::Lists;
use crate::mesh::Mesh;
use crate::surface::Surface;
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// Which data may be taken for gross errors.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Outliers {
    /// None.
    #[default]
    None,
    /// At most this share of the data, above 0 and at most 0.25: those that stand out most.
    Share(f64),
    /// Those that miss the surface of the others by more than this, in the scale of the tolerance.
    Scale(f64),
}

impl Outliers {
    pub(super) fn check(self) -> Result<(), FitError> {
        let (option, value, holds, range) = match self {
            Self::None => return Ok(()),
            Self::Share(share) => {
                ("outlier_share", share, share > 0.0 && share <= 0.25, "above 0 and at most 0.25")
            }
            Self::Scale(scale) => {
                ("outlier_scale", scale, scale > 0.0 && scale.is_finite(), "positive and finite")
            }
        };
        if holds { Ok(()) } else { Err(FitError::Option { option, value, range }) }
    }
}

/// Data among which gross errors are looked for.
pub(in crate::fit) struct Cloud<'a> {
    pub uv: &'a [DVec2],
    /// Rows of `dim` numbers.
    pub values: &'a [f64],
    pub dim: usize,
    /// Triangles between neighbours.
    pub triangles: &'a [[u32; 3]],
}

/// Fits without gross errors. `fit` is handed the values, with those of gross errors replaced by what their neighbours
/// say, and the demands, which leave these data out. `asked` is the tolerance of the fit.
pub(in crate::fit) fn fit_without<S: Surface>(
    cloud: &Cloud,
    (demands, asked): (&Demands, &Tolerance),
    control: &mut Control,
    mut fit: impl FnMut(&[f64], &Demands, &mut Control) -> Result<Fit<S>, FitError>,
) -> Result<Fit<S>, FitError> {
    let neighbours = Neighbourhoods::of(cloud.uv.len(), cloud.triangles);
    let is_exempt = |datum: usize| {
        // in corners there are too few neighbours to tell, and maps are uneven
        let is_corner = neighbours.of_datum(datum).len() < LEAST_FOR_QUADRATIC;
        let is_left_out = demands.tolerances.is_some_and(|tolerances| tolerances[datum] == f64::INFINITY);
        is_corner || is_left_out || demands.fixed.contains(&(datum as u32))
    };
    let predictions = control.watch(|pool, _| pool.run(|| predict(cloud, &neighbours, pool)))?;
    let scores = scores(&neighbours, &predictions);
    let scale = match asked.scale {
        ToleranceScale::Relative => {
            Bounds::of_rows(&likely(cloud, &predictions, &scores), cloud.dim).diagonal()
        }
        ToleranceScale::Absolute => 1.0,
    };
    let mut suspects = suspects(cloud, &neighbours, &predictions, &scores, (demands.outliers, scale));
    suspects.retain(|&datum| !is_exempt(datum));
    let mut fit_all_but = |left_out: &[usize], control: &mut Control| {
        let (values, tolerances) = all_but(cloud, demands, asked.value, &predictions, left_out);
        let tolerances = tolerances.as_deref().or(demands.tolerances);
        fit(&values, &Demands { outliers: Outliers::None, tolerances, ..*demands }, control)
    };
    let every: Vec<usize> = (0..cloud.uv.len()).filter(|&datum| !is_exempt(datum)).collect();
    let mut left_out = suspects;
    let mut fitted = control.within(0.05, 0.5, |control| fit_all_but(&left_out, control))?;
    for round in 1..=CORRECTIONS {
        let errors = missed(&fitted, cloud, &every);
        let limit = limit(&fitted, demands.outliers, scale);
        // both the surface of the others and the neighbours say so
        let is_off = |datum: usize| left_out.binary_search(&datum).is_ok() || predictions[datum].miss > limit;
        let off = every.iter().zip(errors).filter(|&(&datum, error)| !(error <= limit) && is_off(datum));
        let guilty = farthest(off.map(|(&datum, error)| (datum, error)).collect(), demands.outliers, cloud);
        if guilty == left_out {
            break;
        }
        left_out = guilty;
        let from = 0.5 + 0.25 * (round - 1) as f64;
        fitted = control.within(from, from + 0.25, |control| fit_all_but(&left_out, control))?;
    }
    let errors = missed(&fitted, cloud, &left_out);
    fitted.report.left_out = left_out.iter().map(|&datum| datum as u32).collect();
    left_out.iter().zip(errors).for_each(|(&datum, error)| fitted.errors[datum] = error);
    Ok(fitted)
}

/// The same for values on the nodes of a mesh; `fit` is handed the mesh too, which for the values of its shape has its
/// nodes where they say.
pub(in crate::fit) fn fit_mesh_without<S: Surface>(
    (mesh, uv): (&Mesh, &[DVec2]),
    (values, dim, is_shape): (&[f64], usize, bool),
    asked: (&Demands, &Tolerance),
    control: &mut Control,
    mut fit: impl FnMut(&Mesh, &[f64], &Demands, &mut Control) -> Result<Fit<S>, FitError>,
) -> Result<Fit<S>, FitError> {
    let cloud = Cloud { uv, values, dim, triangles: mesh.triangles() };
    fit_without(&cloud, asked, control, |values, demands, control| match is_shape {
        true => fit(&moved(mesh, values), values, demands, control),
        false => fit(mesh, values, demands, control),
    })
}

/// A shape with its nodes at other places: rows of three finite numbers.
fn moved(mesh: &Mesh, values: &[f64]) -> Mesh {
    let mut moved = mesh.clone();
    let places = values.chunks_exact(3).map(DVec3::from_slice).collect();
    moved.set_points(places).expect("one finite place for each node");
    moved
}

/// The values with some data as their neighbours say, and tolerances that leave these out.
fn all_but(
    cloud: &Cloud,
    demands: &Demands,
    tolerance: f64,
    predictions: &[Prediction],
    left_out: &[usize],
) -> (Vec<f64>, Option<Vec<f64>>) {
    let mut values = cloud.values.to_vec();
    if left_out.is_empty() {
        return (values, None);
    }
    let given = demands.tolerances.map(<[f64]>::to_vec);
    let mut tolerances = given.unwrap_or_else(|| vec![tolerance; cloud.uv.len()]);
    for &datum in left_out {
        tolerances[datum] = f64::INFINITY;
        values[datum * cloud.dim..][..cloud.dim].copy_from_slice(&predictions[datum].value);
    }
    (values, Some(tolerances))
}

/// By how much data miss the surface.
fn missed(fitted: &Fit<impl Surface>, cloud: &Cloud, data: &[usize]) -> Vec<f64> {
    let dim = cloud.dim;
    let uv: Vec<DVec2> = data.iter().map(|&datum| fitted.parameters[datum]).collect();
    let mut rows = vec![0.0; uv.len() * dim];
    fitted.surface.eval_rows(&uv, 0, &mut rows);
    let value = |&datum: &usize| &cloud.values[datum * dim..][..dim];
    data.iter().zip(rows.chunks(dim)).map(|(datum, row)| distance(row, value(datum))).collect()
}

/// The error up to which a suspect is taken back.
fn limit<S>(fitted: &Fit<S>, outliers: Outliers, scale: f64) -> f64 {
    /// Errors of the others as a multiple of their root mean square: beyond it normal ones are one in 10,000.
    const RARE: f64 = 4.0;
    /// What misses by less than so many tolerances may be a feature that is sampled thinly.
    const GROSS: f64 = 5.0;
    let report = &fitted.report;
    match outliers {
        Outliers::Scale(asked) => asked * scale,
        _ => (GROSS * report.tolerance).max(RARE * report.rms_error),
    }
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}

/// Neighbours of data over two edges.
struct Neighbourhoods {
    lists: Lists,
}

impl Neighbourhoods {
    fn of(count: usize, triangles: &[[u32; 3]]) -> Self {
        let edges = triangles.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a), (b, a), (c, b), (a, c)]);
        let near = Lists::new(count, edges);
        let mut pairs: Vec<(u32, u32)> = Vec::new();
        for datum in 0..count {
            let first = near.of(datum);
            let mut all: Vec<u32> =
                first.iter().chain(first.iter().flat_map(|&n| near.of(n as usize))).copied().collect();
            all.sort_unstable();
            all.dedup();
            pairs.extend(all.into_iter().filter(|&n| n as usize != datum).map(|n| (datum as u32, n)));
        }
        Self { lists: Lists::new(count, pairs.iter().copied()) }
    }

    fn of_datum(&self, datum: usize) -> &[u32] {
        self.lists.of(datum)
    }
}

/// What the neighbours of a datum say of it.
struct Prediction {
    value: Vec<f64>,
    /// How far the datum is from that.
    miss: f64,
}

/// Fits after the first: data that it meets are taken back, others that it misses go.
const CORRECTIONS: usize = 2;

/// Data predicted in one piece of work.
const PIECE: usize = 256;

/// To be called within the pool.
fn predict(cloud: &Cloud, neighbours: &Neighbourhoods, pool: &Pool) -> Vec<Prediction> {
    let data: Vec<usize> = (0..cloud.uv.len()).collect();
    let prediction = |&datum: &usize| {
        let own = &cloud.values[datum * cloud.dim..][..cloud.dim];
        // a cancelled call throws its predictions away
        let is_cancelled = pool.check().is_err();
        let value = if is_cancelled { None } else { regression(cloud, datum, neighbours.of_datum(datum)) };
        let value = value.unwrap_or_else(|| own.to_vec());
        Prediction { miss: distance(&value, own), value }
    };
    let pieces = data.par_chunks(PIECE);
    pieces.flat_map_iter(|piece| piece.iter().map(prediction).collect::<Vec<_>>()).collect()
}

/// Fewest neighbours for a quadratic, which has six coefficients, and for a plane.
const LEAST_FOR_QUADRATIC: usize = 10;
const LEAST_FOR_PLANE: usize = 4;
/// Rounds of reweighing: towards the least sum of distances, then with the biweight.
const ABSOLUTE_ROUNDS: usize = 12;
const BIWEIGHT_ROUNDS: usize = 6;
/// The biweight is zero from this multiple of the median distance on; about 7 of normal errors.
const CUTOFF: f64 = 7.0;

/// The value at a datum of the quadratic, or plane, through its neighbours; None for too few.
fn regression(cloud: &Cloud, datum: usize, neighbours: &[u32]) -> Option<Vec<f64>> {
    let size = match neighbours.len() {
        count if count >= LEAST_FOR_QUADRATIC => 6,
        count if count >= LEAST_FOR_PLANE => 3,
        _ => return None,
    };
    let dim = cloud.dim;
    let offsets: Vec<DVec2> = neighbours.iter().map(|&n| cloud.uv[n as usize] - cloud.uv[datum]).collect();
    let reach = offsets.iter().fold(DVec2::ZERO, |most, offset| most.max(offset.abs()));
    let place = |offset: &DVec2| {
        let at = *offset / reach;
        [1.0, at.x, at.y, at.x * at.x, at.x * at.y, at.y * at.y]
    };
    let rows: Vec<[f64; 6]> = offsets.iter().map(place).collect();
    let value = |n: u32| &cloud.values[n as usize * dim..][..dim];
    let mut weights = vec![1.0; rows.len()];
    let mut coefficients = weighed_squares(&rows, size, &weights, |k| value(neighbours[k]), dim)?;
    for round in 0..ABSOLUTE_ROUNDS + BIWEIGHT_ROUNDS {
        let misses: Vec<f64> = rows
            .iter()
            .zip(neighbours)
            .map(|(row, &n)| {
                let miss = |(c, x): (usize, &f64)| {
                    let fitted: f64 =
                        row[..size].iter().zip(&coefficients[c * size..]).map(|(a, b)| a * b).sum();
                    (fitted - x).powi(2)
                };
                value(n).iter().enumerate().map(miss).sum::<f64>().sqrt()
            })
            .collect();
        let middle = median(misses.clone());
        if middle == 0.0 {
            break;
        }
        let weight = |miss: &f64| match round {
            _ if round < ABSOLUTE_ROUNDS => middle / miss.max(0.1 * middle),
            _ => (1.0 - (miss / (CUTOFF * middle)).powi(2)).max(0.0).powi(2),
        };
        weights = misses.iter().map(weight).collect();
        // where the biweight leaves too few, what came before stands
        let Some(next) = weighed_squares(&rows, size, &weights, |k| value(neighbours[k]), dim) else { break };
        coefficients = next;
    }
    Some((0..dim).map(|c| coefficients[c * size]).collect())
}

/// Coefficients of weighed least squares, `size` for each component; None where they are not determined.
fn weighed_squares<'a>(
    rows: &[[f64; 6]],
    size: usize,
    weights: &[f64],
    value: impl Fn(usize) -> &'a [f64],
    dim: usize,
) -> Option<Vec<f64>> {
    let mut matrix = nalgebra::DMatrix::<f64>::zeros(size, size);
    let mut right = nalgebra::DMatrix::<f64>::zeros(size, dim);
    for (k, (row, &weight)) in rows.iter().zip(weights).enumerate() {
        for i in 0..size {
            for j in 0..size {
                matrix[(i, j)] += weight * row[i] * row[j];
            }
            for (c, x) in value(k).iter().enumerate() {
                right[(i, c)] += weight * row[i] * x;
            }
        }
    }
    /// What the mean of the diagonal is raised by: neighbours on a line leave a quadratic free across it.
    const RIDGE: f64 = 1e-9;
    let lift = RIDGE * matrix.trace() / size as f64;
    (0..size).for_each(|i| matrix[(i, i)] += lift);
    let solved = matrix.cholesky()?.solve(&right);
    solved.iter().all(|x| x.is_finite()).then(|| solved.as_slice().to_vec())
}

/// The middle of some numbers; 0 of none.
fn median(mut numbers: Vec<f64>) -> f64 {
    if numbers.is_empty() {
        return 0.0;
    }
    let middle = numbers.len() / 2;
    *numbers.select_nth_unstable_by(middle, f64::total_cmp).1
}

/// A datum that misses by more than this multiple of the median around it stands out.
const STANDS_OUT: f64 = 6.0;
/// Neighbours that are off alike and make a ridge of a suspect, and how alike: a share of its miss.
const LEAST_SUPPORT: usize = 3;
const ALIKE: f64 = 0.5;

/// By how much the miss of each datum exceeds what is usual around it.
fn scores(neighbours: &Neighbourhoods, predictions: &[Prediction]) -> Vec<f64> {
    let usual = median(predictions.iter().map(|prediction| prediction.miss).collect());
    let score = |(datum, prediction): (usize, &Prediction)| {
        let around = neighbours.of_datum(datum).iter().map(|&n| predictions[n as usize].miss).collect();
        prediction.miss / median(around).max(usual).max(f64::MIN_POSITIVE)
    };
    predictions.iter().enumerate().map(score).collect()
}

/// The values, or what the neighbours say where one stands out.
fn likely(cloud: &Cloud, predictions: &[Prediction], scores: &[f64]) -> Vec<f64> {
    let rows = cloud.values.chunks(cloud.dim).zip(predictions).zip(scores);
    let row = |((own, predicted), score): ((&[f64], &Prediction), &f64)| {
        if *score > STANDS_OUT { predicted.value.clone() } else { own.to_vec() }
    };
    rows.flat_map(row).collect()
}

/// The data that look like gross errors, in their order.
fn suspects(
    cloud: &Cloud,
    neighbours: &Neighbourhoods,
    predictions: &[Prediction],
    scores: &[f64],
    (outliers, scale): (Outliers, f64),
) -> Vec<usize> {
    let dim = cloud.dim;
    let offset = |datum: usize| -> Vec<f64> {
        let own = &cloud.values[datum * dim..][..dim];
        own.iter().zip(&predictions[datum].value).map(|(x, predicted)| x - predicted).collect()
    };
    let is_supported = |datum: usize| {
        let own = offset(datum);
        let is_alike = |n: &&u32| distance(&offset(**n as usize), &own) <= ALIKE * predictions[datum].miss;
        neighbours.of_datum(datum).iter().filter(is_alike).count() >= LEAST_SUPPORT
    };
    let is_far = |datum: usize| match outliers {
        Outliers::Scale(asked) => predictions[datum].miss > asked * scale,
        _ => true,
    };
    let stands_out = |&datum: &usize| is_far(datum) && scores[datum] > STANDS_OUT && !is_supported(datum);
    let data = (0..cloud.uv.len()).filter(stands_out).map(|datum| (datum, predictions[datum].miss));
    farthest(data.collect(), outliers, cloud)
}

/// The data that are farthest off, as many as may be left out, in their order.
fn farthest(mut off: Vec<(usize, f64)>, outliers: Outliers, cloud: &Cloud) -> Vec<usize> {
    if let Outliers::Share(share) = outliers {
        off.sort_unstable_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
        off.truncate((share * cloud.uv.len() as f64) as usize);
    }
    let mut data: Vec<usize> = off.into_iter().map(|(datum, _)| datum).collect();
    data.sort_unstable();
    data
}
