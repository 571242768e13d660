//! Stretch of a map: how far it is from keeping lengths, and how to weigh against it.
//!
//! P. Sander et al., "Texture mapping progressive meshes" (2001); S. Yoshizawa, A. Belyaev,
//! H.-P. Seidel, "A fast and simple stretch-minimizing mesh parameterization" (2004).
//! With the singular values G >= g of d(x,y,z)/d(u,v) on a triangle and
//! the areas A3 (space), A2 (parameters):
//! ```text
//! sigma^2 = (G^2 + g^2)/2,   E = sqrt(sum A3 sigma^2 / sum A3) sqrt(sum A2 / sum A3) >= 1
//! ```
//! E is the L2 stretch, max G sqrt(sum A2 / sum A3) the Linf stretch; both ignore scale.

use super::patch::Patch;
use crate::Control;
use crate::geometry::safe_scale;
use crate::memory::{self, CollectVec, ParallelCollectVec};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// Triangles of less area in space than this share of the mean count as if they had it.
const LEAST_AREA: f64 = 1e-12;

/// How much a map stretches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StretchMeasure {
    /// Root of the mean square stretch, 1 for an isometry; infinite if a triangle collapsed.
    pub l2: f64,
    /// The largest stretch in any direction anywhere.
    pub max: f64,
    /// The largest ratio of a triangle's area in space to that in the parameters, by the smallest.
    pub area_ratio: f64,
}

/// One triangle's part.
#[derive(Debug, Clone, Copy)]
pub(super) struct TriangleStretch {
    /// G, the largest singular value; infinite without parameter area.
    pub largest: f64,
    /// g.
    pub smallest: f64,
    pub area: f64,
    /// Positive if counter-clockwise.
    pub parameter_area: f64,
}

impl TriangleStretch {
    pub(super) fn new(p: [DVec3; 3], q: [DVec2; 3]) -> Self {
        let (e1, e2) = (p[1] - p[0], p[2] - p[0]);
        let (d1, d2) = (q[1] - q[0], q[2] - q[0]);
        let (area, parameter_area) = (e1.cross(e2).length() / 2.0, d1.perp_dot(d2) / 2.0);
        let twice = 2.0 * parameter_area;
        let (along_u, along_v) = ((e1 * d2.y - e2 * d1.y) / twice, (e2 * d1.x - e1 * d2.x) / twice);
        let (largest, smallest) = singular_values(along_u, along_v);
        Self { largest, smallest, area, parameter_area }
    }

    fn mean_square(&self) -> f64 {
        (self.largest * self.largest + self.smallest * self.smallest) / 2.0
    }
}

/// Of the matrix with these two columns: in closed form from its triangular factor, once for each triangle and step. Products
/// of the columns would lose half the digits of thin triangles.
fn singular_values(x: DVec3, y: DVec3) -> (f64, f64) {
    let a = x.length();
    if !(a.is_finite() && y.is_finite()) {
        return (f64::INFINITY, f64::INFINITY);
    }
    if a == 0.0 {
        return (y.length(), 0.0);
    }
    let unit = x / a;
    let b = unit.dot(y);
    let c = (y - unit * b).length();
    let length = |x: f64| (x * x + b * b).sqrt();
    let (sum, difference) = (length(a + c), length(a - c));
    ((sum + difference) / 2.0, (sum - difference).abs() / 2.0)
}

/// Measures a map on all triangles; the sign of parameter areas does not matter here.
pub fn stretch(points: &[DVec3], triangles: &[[u32; 3]], uv: &[DVec2]) -> StretchMeasure {
    let scale = safe_scale(points.iter().map(|p| p.abs().max_element()).fold(0.0, f64::max));
    let part = |t: &[u32; 3]| {
        let places = t.map(|node| scale * points[node as usize]);
        TriangleStretch::new(places, t.map(|node| uv[node as usize]))
    };
    let parts: Vec<TriangleStretch> = triangles.iter().map(part).collect_vec();
    summed(parts.iter().map(|part| (part, 1.0)))
}

pub(super) fn triangle_stretch(points: &[DVec3], uv: &[DVec2], triangle: &[u32; 3]) -> TriangleStretch {
    TriangleStretch::new(triangle.map(|node| points[node as usize]), triangle.map(|node| uv[node as usize]))
}

/// Sums triangles, each with the square of its weight.
fn summed<'a>(parts: impl Iterator<Item = (&'a TriangleStretch, f64)> + Clone) -> StretchMeasure {
    let floor = area_floor(parts.clone().map(|(part, _)| part));
    let (mut area, mut weighted_area, mut parameter_area, mut square) = (0.0, 0.0, 0.0, 0.0);
    let (mut largest, mut most, mut least) = (0.0_f64, 0.0_f64, f64::INFINITY);
    for (part, weight_sq) in parts {
        let weight = weight_sq * part.area.max(floor);
        area += part.area;
        weighted_area += weight;
        parameter_area += part.parameter_area.abs();
        square += weight * part.mean_square();
        largest = largest.max(part.largest);
        let ratio = part.area.max(floor) / part.parameter_area.abs();
        (most, least) = (most.max(ratio), least.min(ratio));
    }
    let scale = (parameter_area / area).sqrt();
    StretchMeasure {
        l2: (square / weighted_area).sqrt() * scale,
        max: largest * scale,
        area_ratio: most / least,
    }
}

fn area_floor<'a>(parts: impl Iterator<Item = &'a TriangleStretch>) -> f64 {
    let (sum, count) = parts.fold((0.0, 0_usize), |(sum, count), part| (sum + part.area, count + 1));
    LEAST_AREA * sum / count.max(1) as f64
}

/// A patch's triangles with their stretch under a map.
pub(super) struct PatchStretch {
    parts: Vec<TriangleStretch>,
    /// L2 stretch of the triangles that can move, fans included: what steps work against.
    pub movable_l2: f64,
    /// The stretch of the triangles of the mesh: what counts in the end.
    pub of_mesh: StretchMeasure,
}

impl PatchStretch {
    /// `node_weights`: b of section 5; E is weighted by b^2.
    pub(super) fn new(patch: &Patch, uv: &[DVec2], node_weights: Option<&[f64]>, control: &Control) -> Self {
        let part = |triangle| triangle_stretch(&patch.points, uv, triangle);
        let parts: Vec<TriangleStretch> = control.run(|| patch.triangles.par_iter().map(part).collect_vec());
        let weight_sq = |triangle: &[u32; 3]| match node_weights {
            Some(b) => triangle.iter().map(|&node| weight_of(b, node).powi(2)).sum::<f64>() / 3.0,
            None => 1.0,
        };
        let movable = patch.triangles.iter().zip(&parts).filter(|(triangle, _)| patch.is_movable(triangle));
        // a kept border may run clockwise: the map is mirrored then, and as good
        let turned = movable.clone().filter(|(_, part)| part.parameter_area < 0.0).count();
        let sign = if 2 * turned > movable.clone().count() { -1.0 } else { 1.0 };
        let collapsed = !movable.clone().all(|(_, part)| sign * part.parameter_area > 0.0);
        let movable_l2 = if collapsed {
            f64::INFINITY
        } else {
            summed(movable.map(|(triangle, part)| (part, weight_sq(triangle)))).l2
        };
        let of_mesh = summed(parts[..patch.mesh_triangle_count].iter().map(|part| (part, 1.0)));
        Self { parts, movable_l2, of_mesh }
    }

    /// The stretch of each node over its geometric mean, smoothed by `rings` sweeps.
    pub(super) fn of_nodes(&self, patch: &Patch, node_weights: Option<&[f64]>, rings: usize) -> Vec<f64> {
        let movable =
            patch.triangles.iter().zip(&self.parts).filter(|(triangle, _)| patch.is_movable(triangle));
        let floor = area_floor(movable.clone().map(|(_, part)| part));
        let mut sums = memory::filled((0.0, 0.0), patch.points.len());
        for (triangle, part) in movable {
            let area = part.area.max(floor);
            for &node in triangle {
                let (square, total) = &mut sums[node as usize];
                *square += area * part.mean_square();
                *total += area;
            }
        }
        let logarithm = |(node, &(square, total)): (usize, &(f64, f64))| {
            let weight = node_weights.map_or(1.0, |b| weight_of(b, node as u32));
            let sigma_sq: f64 = (square / total).clamp(f64::MIN_POSITIVE, f64::MAX);
            (total > 0.0).then(|| 0.5 * sigma_sq.ln() + weight.ln())
        };
        let logarithms: Vec<Option<f64>> = sums.iter().enumerate().map(logarithm).collect_vec();
        let known = logarithms.iter().flatten();
        let mean = known.clone().sum::<f64>() / known.count().max(1) as f64;
        let mut logarithms: Vec<f64> =
            logarithms.into_iter().map(|log| log.map_or(0.0, |log| log - mean)).collect_vec();
        for _ in 0..rings {
            logarithms = averaged(patch, &logarithms);
        }
        logarithms.into_iter().map(f64::exp).collect_vec()
    }
}

/// Nodes in filled holes have none of their own.
fn weight_of(node_weights: &[f64], node: u32) -> f64 {
    node_weights.get(node as usize).copied().unwrap_or(1.0)
}

/// The mean of each node's own value and its neighbours'.
fn averaged(patch: &Patch, values: &[f64]) -> Vec<f64> {
    (0..values.len())
        .map(|node| {
            let around = patch.neighbours.of(node);
            let sum: f64 = around.iter().map(|&other| values[other as usize]).sum();
            (values[node] + sum) / (1 + around.len()) as f64
        })
        .collect_vec()
}
