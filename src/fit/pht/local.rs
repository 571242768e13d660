//! Jets from polynomials fitted to the data around a place.
//!
//! The paper's quadratic fits know nothing of the size of cells: one around each datum, carried to the vertices by
//! linear interpolation. Weighted cubics around each vertex, over a circle as large as the cells there, do. Both
//! work in the unit square of the data's box.

use super::data::Data;
use crate::control::Pool;
use crate::fit::common::FitError;
use crate::lists::Lists;
use crate::memory::ParallelCollectVec;
use crate::tmesh::{TMesh, Topology, VertexKind};
use glam::DVec2;
use nalgebra::{Const, Dyn, OMatrix, SMatrix};
use rayon::prelude::*;
use spade::{DelaunayTriangulation, FloatTriangulation, HasPosition, Point2, Triangulation};

/// Neighbours of a datum, itself included, in a quadratic fit.
const QUADRATIC_NEIGHBOURS: usize = 18;
/// Least data of a cubic fit with its ten coefficients.
const CUBIC_NEIGHBOURS: usize = 24;
/// Radius of a cubic fit, in mean widths of the cells at the vertex.
const CUBIC_RADIUS: f64 = 0.75;
/// Data at the radius weigh exp(-3).
const CUBIC_DECAY: f64 = 3.0;

/// Jets of weighted cubics around the basis vertices, in the frame of the data.
pub(super) fn cubic(data: &Data, mesh: &TMesh, topology: &Topology, pool: &Pool) -> Vec<f64> {
    let buckets = Buckets::new(data);
    let mut widths = vec![(0.0, 0.0); topology.basis.len()];
    for (&node, corners) in topology.leaves.iter().zip(&topology.corners) {
        let size = buckets.to_unit_size(mesh.cell_domain(mesh.cell(node)).size());
        for &vertex in corners {
            if let VertexKind::Basis(rank) = topology.kinds[vertex as usize] {
                let (sum, count) = &mut widths[rank as usize];
                *sum += size.element_product().sqrt();
                *count += 1.0;
            }
        }
    }
    let jet = |(&vertex, &(sum, count)): (&u32, &(f64, f64))| {
        let center = buckets.to_unit(mesh.parameters(topology.vertices[vertex as usize]));
        let near = buckets.around(center, CUBIC_RADIUS * sum / count, CUBIC_NEIGHBOURS);
        let weight = |distance: f64| (-CUBIC_DECAY * distance * distance).exp();
        buckets.jet(polynomial_jet::<10>(data, &buckets, center, &near, weight))
    };
    pool.run(|| topology.basis.par_iter().zip(&widths).with_min_len(16).map(jet).flatten().collect())
}

/// Jets of quadratics around the data, interpolated linearly over their Delaunay triangles.
pub(super) fn quadratic(
    data: &Data,
    mesh: &TMesh,
    topology: &Topology,
    pool: &Pool,
) -> Result<Vec<f64>, FitError> {
    let buckets = Buckets::new(data);
    let length = 4 * data.dim;
    let at_datum = |&center: &DVec2| {
        let near = buckets.around(center, 0.0, QUADRATIC_NEIGHBOURS);
        polynomial_jet::<6>(data, &buckets, center, &near, |_| 1.0)
    };
    let jets: Vec<Vec<f64>> = pool.run(|| buckets.uv.par_iter().with_min_len(64).map(at_datum).collect_vec());
    let sites = buckets.uv.iter().enumerate().map(|(index, &uv)| Site { uv, index }).collect();
    let triangles = DelaunayTriangulation::<Site>::bulk_load_stable(sites).map_err(|_| FitError::Singular)?;
    let barycentric = triangles.barycentric();
    let mut shares = Vec::new();
    let mut all = Vec::with_capacity(topology.basis.len() * length);
    for &vertex in &topology.basis {
        let place = buckets.to_unit(mesh.parameters(topology.vertices[vertex as usize]));
        barycentric.get_weights(Point2::new(place.x, place.y), &mut shares);
        let mut jet = vec![0.0; length];
        for (vertex, share) in &shares {
            let near = &jets[triangles.vertex(*vertex).data().index];
            jet.iter_mut().zip(near).for_each(|(sum, x)| *sum += share * x);
        }
        if shares.is_empty() {
            // beyond the data: those of the nearest datum
            let near = buckets.around(place, 0.0, 1);
            jet.clone_from(&jets[near.data[0].1]);
        }
        all.extend(buckets.jet(jet));
    }
    Ok(all)
}

/// A datum of the triangulation.
struct Site {
    uv: DVec2,
    index: usize,
}

impl HasPosition for Site {
    type Scalar = f64;
    fn position(&self) -> Point2<f64> {
        Point2::new(self.uv.x, self.uv.y)
    }
}

/// A row of numbers for each of `N` coefficients.
type RowsOf<const N: usize> = OMatrix<f64, Const<N>, Dyn>;

/// The jet of the polynomial with `N` coefficients that fits the data near `center` best, `weight` of the distance
/// in radii; parameters in the unit square.
fn polynomial_jet<const N: usize>(
    data: &Data,
    buckets: &Buckets,
    center: DVec2,
    near: &Near,
    weight: impl Fn(f64) -> f64,
) -> Vec<f64> {
    let dim = data.dim;
    let radius = if near.radius > 0.0 { near.radius } else { 1.0 };
    let (mut matrix, mut right) = (SMatrix::<f64, N, N>::zeros(), RowsOf::<N>::zeros(dim));
    for &(distance, datum) in &near.data {
        let d = (buckets.uv[datum] - center) / radius;
        let monomials = monomials::<N>(d);
        let given = data.sample_weights.get(datum).copied().unwrap_or(1.0);
        let weight = given * weight(distance / radius);
        let value = &data.sample_values[datum * dim..][..dim];
        for i in 0..N {
            for j in 0..N {
                matrix[(i, j)] += weight * monomials[i] * monomials[j];
            }
            value.iter().enumerate().for_each(|(k, x)| right[(i, k)] += weight * monomials[i] * x);
        }
    }
    let ridge = RIDGE * matrix.trace().max(f64::MIN_POSITIVE);
    matrix += SMatrix::from_diagonal_element(ridge);
    // positive but for overflow, which the surface refuses
    if let Some(factor) = matrix.cholesky() {
        factor.solve_mut(&mut right);
    }
    let scales = [1.0, radius, radius, radius * radius];
    // 1, x, y and xy are the first, second, third and fifth monomial
    let rows = [0, 1, 2, 4].into_iter().zip(scales);
    rows.flat_map(|(row, scale)| right.row(row).iter().map(|x| x / scale).collect::<Vec<_>>()).collect()
}

/// 1, x, y, x^2, xy, y^2, x^3, x^2 y, x y^2, y^3.
fn monomials<const N: usize>(DVec2 { x, y }: DVec2) -> [f64; N] {
    let all = [1.0, x, y, x * x, x * y, y * y, x * x * x, x * x * y, x * y * y, y * y * y];
    std::array::from_fn(|k| all[k])
}

/// Share of the trace that is added to the diagonal: data on a line leave coefficients undetermined, which then
/// are zero.
const RIDGE: f64 = 1e-12;

/// Data near a place.
struct Near {
    /// Distances and numbers.
    data: Vec<(f64, usize)>,
    /// Of the circle that holds them.
    radius: f64,
}

/// Data in a grid of buckets over the unit square.
struct Buckets {
    min: DVec2,
    size: DVec2,
    /// Parameters in the unit square.
    uv: Vec<DVec2>,
    /// Buckets along each direction.
    count: usize,
    data: Lists,
}

/// Data of a bucket, on average.
const BUCKET: usize = 2;

impl Buckets {
    fn new(data: &Data) -> Self {
        let (min, size) = (data.data_box.min, data.data_box.size());
        let uv: Vec<DVec2> = data.uv.iter().map(|&uv| (uv - min) / size).collect();
        let count = ((uv.len() / BUCKET) as f64).sqrt().ceil().max(1.0) as usize;
        let mut buckets = Self { min, size, count, data: Lists::default(), uv };
        let places: Vec<u32> = buckets.uv.iter().map(|&uv| buckets.bucket(uv) as u32).collect();
        buckets.data = Lists::by_key(count * count, &places);
        buckets
    }

    fn to_unit(&self, uv: DVec2) -> DVec2 {
        (uv - self.min) / self.size
    }

    fn to_unit_size(&self, size: DVec2) -> DVec2 {
        size / self.size
    }

    /// From derivatives in the unit square to those in the parameters.
    fn jet(&self, mut jet: Vec<f64>) -> Vec<f64> {
        let scales = [1.0, self.size.x, self.size.y, self.size.x * self.size.y];
        let length = jet.len() / 4;
        for (row, scale) in jet.chunks_exact_mut(length).zip(scales) {
            row.iter_mut().for_each(|x| *x /= scale);
        }
        jet
    }

    fn line(&self, x: f64) -> usize {
        ((x.max(0.0) * self.count as f64) as usize).min(self.count - 1)
    }

    fn bucket(&self, uv: DVec2) -> usize {
        self.line(uv.x) * self.count + self.line(uv.y)
    }

    /// The data within `radius`, or the `least` nearest if those are more.
    fn around(&self, center: DVec2, radius: f64, least: usize) -> Near {
        let least = least.min(self.uv.len());
        let mut reach = radius.max(1.0 / self.count as f64);
        loop {
            let mut data = self.within(center, reach);
            if data.len() < least {
                reach *= 1.5;
                continue;
            }
            data.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            let inside = data.partition_point(|&(distance, _)| distance <= radius);
            data.truncate(inside.max(least));
            let farthest = data.last().map_or(0.0, |&(distance, _)| distance);
            return Near { data, radius: radius.max(farthest) };
        }
    }

    fn within(&self, center: DVec2, reach: f64) -> Vec<(f64, usize)> {
        let range = |x: f64| self.line(x - reach)..=self.line(x + reach);
        let mut data = Vec::new();
        for i in range(center.x) {
            for j in range(center.y) {
                let place = i * self.count + j;
                for &datum in self.data.of(place) {
                    let distance = self.uv[datum as usize].distance(center);
                    if distance <= reach {
                        data.push((distance, datum as usize));
                    }
                }
            }
        }
        data
    }
}
