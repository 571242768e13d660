//! Fairness: a surface is moved to one of less energy that stays within a tolerance of it, or of data.
//!
//! ```text
//! minimize  sum w |d|^2 + lambda E(s + d)
//! E  thin plate            integral of |s_xx|^2 + 2 |s_xy|^2 + |s_yy|^2
//!    variation of          integral of |s_xxx|^2 + 3 |s_xxy|^2 + 3 |s_xyy|^2 + |s_yyy|^2
//!    curvature
//! ```
//! d moves the surface s; without data |d|^2 is its integral over each cell, with data it is the square of what a datum is
//! missed by. Cells or data that would come to lie beyond the tolerance get more weight (C. Lawson, "Contributions to the
//! theory of linear least maximum approximation", 1961), and lambda grows as long as that lowers E; with data only as
//! long as they are told better from each other (module `prediction`), unless all of the tolerance is asked for. What is
//! still beyond the tolerance is met by a shorter step: E is convex, so it falls all the way. Without data the bound is a proof: no
//! place of the surface moves by more than the ordinates of d, of which it is a mean. Energies after G. Celniker and
//! D. Gossard, "Deformable curve and surface finite-elements for free-form shape design", SIGGRAPH 1991, and H. Moreton
//! and C. Sequin, "Functional optimization for fair surface design", SIGGRAPH 1992; here in the surface's own
//! parameters, in lengths, which keeps both quadratic.

mod error;
mod prediction;
mod quadratic;
mod reference;
mod space;
#[cfg(test)]
mod tests;

pub use error::FairError;

use crate::control::{Control, Stage, Watch};
use crate::fit::common::FitError;
use crate::fit::common::checks::{check_rows, check_tolerance};
use crate::fit::common::report::Tolerance;
use crate::geometry::Bounds;
use crate::linalg::{Cholesky, SymbolicCholesky};
use crate::options::with_fields;
use crate::surface::tensor::Axis;
use crate::surface::{AnySurface, Domain};
use glam::{DVec2, DVec3};
use quadratic::{CellForms, Pattern};
use reference::Reference;
use space::Space;
use std::time::Instant;

/// Which energy is lowered.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Fairness {
    /// Bending: flat is best.
    #[default]
    ThinPlate,
    /// Change of bending: round is as good as flat. For surfaces of continuous curvature.
    CurvatureVariation,
}

/// What of the border of the domain stays as it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum KeptBorder {
    /// Nothing.
    #[default]
    None,
    /// Its place.
    Position,
    /// Its place and its tangent planes.
    Tangent,
}

/// How far the energy is lowered where there are data.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum FairLimit {
    /// Until the surface tells each datum best from the others: noise goes, and what is no noise stays.
    #[default]
    Noise,
    /// As far as the tolerance lets it: what is narrower than that allows is flattened too.
    Tolerance,
}

/// Data that a surface is to stay near.
#[derive(Debug, Clone, Copy)]
pub struct FairData<'a> {
    /// Their parameters, in the domain.
    pub uv: &'a [DVec2],
    /// Rows of as many numbers as the surface has.
    pub values: &'a [f64],
}

/// Options of [`fair`].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FairOptions {
    /// How far the surface may come to lie from itself, or from the data; relative to the diagonal of the box of its
    /// control points, or of the data.
    pub tolerance: Tolerance,
    /// Which energy is lowered.
    pub energy: Fairness,
    /// What of the border stays.
    pub border: KeptBorder,
    /// How far the energy is lowered where there are data; without data it is as far as the tolerance lets it.
    pub limit: FairLimit,
}

impl FairOptions {
    with_fields! {
        with_tolerance tolerance: Tolerance,
        with_energy energy: Fairness,
        with_border border: KeptBorder,
        with_limit limit: FairLimit,
    }
}

/// What fairing did. Lengths are in model units.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FairReport {
    /// Energy before.
    pub energy_before: f64,
    /// Energy after; never more.
    pub energy_after: f64,
    /// Largest distance to the reference at equal parameters: of data an error, of the surface itself a proven bound.
    pub max_deviation: f64,
    /// Root mean square of the errors of the data; without data, of the bounds of the cells.
    pub rms_deviation: f64,
    /// No place of the surface moved by more.
    pub max_movement: f64,
    /// The tolerance.
    pub tolerance: f64,
    /// What a relative tolerance is measured in.
    pub diagonal: f64,
    /// The weight of the energy in the surface returned, against the mean square; 0 if nothing was gained.
    pub smoothing: f64,
    /// Systems solved.
    pub passes: usize,
    /// Seconds in all.
    pub seconds: f64,
}

/// A surface, faired.
#[derive(Debug, Clone)]
pub struct Faired {
    /// Of the same family over the same knots or cells, with its trims.
    pub surface: AnySurface,
    /// What was done.
    pub report: FairReport,
}

/// The weights of the energy that are tried, as powers of ten of the balance between both forms.
const POWERS: std::ops::RangeInclusive<i32> = -9..=5;
/// A share of the domain that is rounding.
const ROUNDING: f64 = 1e-12;
/// Solves with one weight: after each, what lies beyond the tolerance weighs more.
const SWEEPS: usize = 5;
/// Weights that add less than this share to what was gained are idle; so many in a row end the search.
const LEAST_GAIN: f64 = 1e-2;
const IDLE_WEIGHTS: usize = 2;

/// Lowers the energy of a surface within a tolerance of itself, or of data.
pub fn fair(
    surface: &AnySurface,
    data: Option<FairData>,
    options: &FairOptions,
    control: &mut Control,
) -> Result<Faired, FairError> {
    let start = Instant::now();
    check_tolerance(&options.tolerance)?;
    let space = Space::of(surface, options.border)?;
    check_energy(surface, options.energy)?;
    let bounds = match &data {
        Some(data) => {
            check_data(data, surface)?;
            Bounds::of_rows(data.values, space.dim)
        }
        None => Bounds::of_rows(&space.control_points, space.dim),
    };
    let (tolerance, _) = options.tolerance.absolute(&bounds);
    control.enter(Stage::Fit);
    let mut problem =
        control.watch(|_, watch| Problem::new(&space, data, tolerance, options.energy, watch))??;
    if let Some(data) = &data {
        problem.normals = prediction::normals(surface.as_surface(), data.uv);
    }
    let mut report = FairReport { tolerance, diagonal: bounds.diagonal(), ..FairReport::default() };
    report.energy_before = problem.energy_of_surface();
    report.energy_after = report.energy_before;
    let best = match (&data, options.limit) {
        (Some(_), FairLimit::Noise) => problem.lower_to_noise(&mut report, control)?,
        _ => problem.lower(&mut report, control)?,
    };
    let (deviations, movements) = (problem.reference.deviations(&best), reference::movements(&space, &best));
    report.max_deviation = deviations.iter().copied().fold(0.0, f64::max);
    let squares: f64 = deviations.iter().map(|deviation| deviation * deviation).sum();
    report.rms_deviation = (squares / deviations.len().max(1) as f64).sqrt();
    report.max_movement = movements.into_iter().fold(0.0, f64::max);
    report.seconds = start.elapsed().as_secs_f64();
    let is_same = best.iter().all(|&d| d == 0.0);
    Ok(Faired { surface: if is_same { surface.clone() } else { space.moved(surface, &best)? }, report })
}

fn check_data(data: &FairData, surface: &AnySurface) -> Result<(), FairError> {
    let surface = surface.as_surface();
    if let Some(index) = data.uv.iter().position(|uv| !uv.is_finite()) {
        return Err(FitError::ParametersNotFinite { index }.into());
    }
    check_rows(data.uv.len(), data.values, surface.dim())?;
    // a domain may end a rounding before the data it was made of
    let Domain { min, max } = surface.domain();
    let margin = ROUNDING * (max - min);
    let domain = Domain { min: min - margin, max: max + margin };
    match data.uv.iter().position(|&uv| !domain.contains(uv)) {
        Some(index) => Err(FairError::Outside { index }),
        None => Ok(()),
    }
}

/// A variation of curvature needs a curvature that is continuous.
fn check_energy(surface: &AnySurface, energy: Fairness) -> Result<(), FairError> {
    if energy == Fairness::ThinPlate {
        return Ok(());
    }
    match surface {
        AnySurface::Tensor(surface) => {
            for axis in [Axis::U, Axis::V] {
                let knots = surface.knots(axis);
                let breaks = knots.breaks();
                let inner = &breaks[1..breaks.len() - 1];
                let jumps = |knot: &&f64| knots.multiplicity(**knot) + 2 > knots.degree();
                if let Some(&at) = inner.iter().find(jumps) {
                    return Err(FairError::CurvatureJumps { at });
                }
            }
            Ok(())
        }
        AnySurface::Pht(surface) if surface.mesh().leaf_count() > 1 => {
            let mesh = surface.mesh();
            let first = mesh.leaves().next().map_or(0.0, |leaf| mesh.cell_domain(mesh.cell(leaf)).max.x);
            Err(FairError::CurvatureJumps { at: first })
        }
        _ => Ok(()),
    }
}

/// The displacement of least energy so far.
struct Lowest {
    /// By how much it changes the energy.
    change: f64,
    displacement: Vec<f64>,
}

impl Lowest {
    /// None.
    fn new(space: &Space) -> Self {
        Self { change: 0.0, displacement: vec![0.0; space.control_points.len()] }
    }
}

/// What is minimized.
struct Problem<'a> {
    space: &'a Space,
    pattern: Pattern,
    /// The matrix of the energy.
    energy: Vec<f64>,
    /// Its product with the control points.
    gradient: Vec<f64>,
    reference: Reference<'a>,
    /// Of the surface in space at its data; otherwise none.
    normals: Vec<DVec3>,
    symbolic: SymbolicCholesky,
}

impl<'a> Problem<'a> {
    fn new(
        space: &'a Space,
        data: Option<FairData<'a>>,
        tolerance: f64,
        energy: Fairness,
        watch: &Watch,
    ) -> Result<Self, FairError> {
        let (forms, pattern) = (CellForms::new(space.degree), Pattern::of(space, watch)?);
        let lengths = forms.lengths(space);
        let mut matrix = pattern.zeros();
        for (k, cell) in space.cells.iter().enumerate() {
            if k.is_multiple_of(64) {
                watch.check()?;
            }
            pattern.add(&mut matrix, &cell.unknowns, &forms.energy(cell, lengths, energy), 1.0);
        }
        // energies do not see where the surface lies: around the origin least is lost
        let bounds = Bounds::of_rows(&space.control_points, space.dim);
        let center: Vec<f64> = bounds.min.iter().zip(&bounds.max).map(|(a, b)| a / 2.0 + b / 2.0).collect();
        let centered: Vec<f64> =
            space.control_points.iter().zip(center.iter().cycle()).map(|(x, c)| x - c).collect();
        let gradient = pattern.product(&matrix, &centered, space.dim);
        let symbolic = SymbolicCholesky::new(&pattern.matrix(pattern.zeros()).view(), None);
        let reference = Reference::new(space, data, tolerance, &forms, lengths, watch)?;
        Ok(Self { space, pattern, energy: matrix, gradient, reference, normals: Vec::new(), symbolic })
    }

    /// The displacement of least energy that is found, zero if none is less than that of the surface.
    fn lower(&self, report: &mut FairReport, control: &mut Control) -> Result<Vec<f64>, FairError> {
        let mut lowest = Lowest::new(self.space);
        let mut idle = 0;
        let mut weights = self.reference.weights();
        let Some(balance) = self.balance(&weights) else { return Ok(lowest.displacement) };
        let count = POWERS.count() as f64;
        for (k, power) in POWERS.enumerate() {
            let before = lowest.change;
            self.sweep(balance * 10.0_f64.powi(power), &mut weights, &mut lowest, report, control)?;
            control.report((k + 1) as f64 / count, f64::NAN)?;
            let gain = before - lowest.change;
            idle = if lowest.change < 0.0 && gain <= LEAST_GAIN * -lowest.change { idle + 1 } else { 0 };
            if idle == IDLE_WEIGHTS {
                break;
            }
        }
        Ok(lowest.displacement)
    }

    /// What balances the traces of both forms; None where there is nothing to lower.
    fn balance(&self, weights: &[f64]) -> Option<f64> {
        let distance = self.reference.form(&self.pattern, weights);
        let (size, bending) = (self.pattern.trace(&distance), self.pattern.trace(&self.energy));
        (bending > 0.0 && self.energy_of_surface() > 0.0).then(|| size / bending)
    }

    /// Displacements with one weight of the energy, while those that lie beyond the tolerance weigh more and more.
    fn sweep(
        &self,
        smoothing: f64,
        weights: &mut [f64],
        lowest: &mut Lowest,
        report: &mut FairReport,
        control: &mut Control,
    ) -> Result<(), FairError> {
        for _ in 0..SWEEPS {
            let d = control.watch(|_, watch| self.solve(weights, smoothing, watch))??;
            report.passes += 1;
            let step = self.reference.longest_step(&d);
            let change = self.change(&d, step);
            if change < lowest.change {
                report.smoothing = smoothing;
                report.energy_after = (report.energy_before + change).max(0.0);
                *lowest = Lowest { change, displacement: d.iter().map(|x| step * x).collect() };
            }
            if step == 1.0 {
                break;
            }
            self.reference.weigh(&d, weights);
        }
        Ok(())
    }

    /// The displacement that balances distance and energy.
    fn solve(&self, weights: &[f64], smoothing: f64, watch: &Watch) -> Result<Vec<f64>, FairError> {
        let mut pull = self.reference.pull(weights);
        pull.resize(self.gradient.len(), 0.0);
        pull.iter_mut().zip(&self.gradient).for_each(|(sum, slope)| *sum -= smoothing * slope);
        let factor = self.factor(weights, smoothing, watch)?;
        Ok(self.solve_rows(&factor, &pull, self.space.dim))
    }

    /// The matrix of distance and energy, factored.
    fn factor(&self, weights: &[f64], smoothing: f64, watch: &Watch) -> Result<Cholesky, FairError> {
        watch.check()?;
        let mut matrix = self.reference.form(&self.pattern, weights);
        let scale = self.pattern.trace(&matrix) / self.space.count() as f64;
        matrix.iter_mut().zip(&self.energy).for_each(|(sum, e)| *sum += smoothing * e);
        self.pattern.keep(&mut matrix, &self.space.is_kept, scale);
        watch.check()?;
        let factor = self.symbolic.factor(&self.pattern.matrix(matrix).view());
        watch.check()?;
        factor.map_err(|_| FairError::Singular)
    }

    /// The solution for rows of `dim` numbers; what is kept does not move.
    fn solve_rows(&self, factor: &Cholesky, rows: &[f64], dim: usize) -> Vec<f64> {
        let n = self.space.count();
        let mut columns = vec![0.0; n * dim];
        for unknown in (0..n).filter(|&unknown| !self.space.is_kept[unknown]) {
            (0..dim).for_each(|k| columns[k * n + unknown] = rows[unknown * dim + k]);
        }
        factor.solve(&mut columns, dim);
        let places = (0..n).flat_map(|unknown| (0..dim).map(move |k| (unknown, k)));
        places.map(|(i, k)| columns[k * n + i]).collect()
    }

    fn energy_of_surface(&self) -> f64 {
        let points = self.space.control_points.iter().zip(&self.gradient);
        points.map(|(point, slope)| point * slope).sum::<f64>().max(0.0)
    }

    /// By how much a step along a displacement changes the energy.
    fn change(&self, d: &[f64], step: f64) -> f64 {
        let slope: f64 = d.iter().zip(&self.gradient).map(|(d, slope)| d * slope).sum();
        let bend: f64 =
            d.iter().zip(self.pattern.product(&self.energy, d, self.space.dim)).map(|(d, b)| d * b).sum();
        step * (2.0 * slope + step * bend)
    }
}
