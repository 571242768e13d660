//! Errors between the nodes, and the part of them that flat facets explain.

use super::Problem;
use crate::control::Pool;
use crate::fit::errors::data_errors;
use crate::mesh::Mesh;
use crate::surface::tensor::TensorSurface;
use glam::{DVec2, DVec3};

/// Errors at triangle centroids and edge middles.
#[derive(Debug, Clone, Copy, Default)]
pub struct InteriorErrors {
    /// The largest error.
    pub max: f64,
    /// The largest height of the shape above a facet.
    pub sagitta: f64,
    /// The largest error beyond the sagitta of its own facet.
    pub max_excess: f64,
}

impl Problem<'_> {
    /// Measures a surface between the nodes.
    pub fn interior_errors(&self, surface: &TensorSurface, pool: &Pool) -> InteriorErrors {
        let Some(mesh) = self.mesh else {
            return InteriorErrors::default();
        };
        let (uv, values) = interior_samples(mesh, &self.uv, self.values, self.dim);
        let errors = data_errors(surface, &uv, &values, pool).each;
        // a field has no facets in space: what lies between its nodes is unknown altogether
        let sagittas = if self.dim == 3 { triangle_sagittas(mesh) } else { vec![0.0; errors.len() / 4] };
        let mut result = InteriorErrors::default();
        for (errors, &sagitta) in errors.chunks_exact(4).zip(&sagittas) {
            let max = errors.iter().copied().fold(0.0, f64::max);
            result.max = result.max.max(max);
            result.sagitta = result.sagitta.max(sagitta);
            result.max_excess = result.max_excess.max(max - sagitta);
        }
        result
    }
}

/// Centroid and three edge middles of each triangle.
fn interior_samples(mesh: &Mesh, uv: &[DVec2], values: &[f64], dim: usize) -> (Vec<DVec2>, Vec<f64>) {
    let count = 4 * mesh.triangles().len();
    let (mut places, mut rows) = (Vec::with_capacity(count), Vec::with_capacity(count * dim));
    for &[a, b, c] in mesh.triangles() {
        for nodes in [[a, b, c].as_slice(), &[a, b], &[b, c], &[c, a]] {
            let share = 1.0 / nodes.len() as f64;
            places.push(nodes.iter().map(|&n| uv[n as usize]).sum::<DVec2>() * share);
            for k in 0..dim {
                rows.push(nodes.iter().map(|&n| values[n as usize * dim + k]).sum::<f64>() * share);
            }
        }
    }
    (places, rows)
}

/// The height of the shape above each facet. A chord of length l whose end normals enclose the angle a belongs
/// to an arc of height `l/2 tan(a/4)`; the middle of an equilateral triangle on a sphere lies 4/3 as high as
/// the middle of its edges.
fn triangle_sagittas(mesh: &Mesh) -> Vec<f64> {
    let normals = node_normals(mesh);
    let height = |a: u32, b: u32| {
        let (a, b) = (a as usize, b as usize);
        let angle = normals[a].angle_between(normals[b]);
        let angle = if angle.is_finite() { angle } else { 0.0 };
        mesh.points()[a].distance(mesh.points()[b]) / 2.0 * (angle / 4.0).tan()
    };
    let triangles = mesh.triangles().iter();
    triangles.map(|&[a, b, c]| 4.0 / 3.0 * height(a, b).max(height(b, c)).max(height(c, a))).collect()
}

/// Sums of the area vectors of the triangles at each node.
fn node_normals(mesh: &Mesh) -> Vec<DVec3> {
    let points = mesh.points();
    let mut normals = vec![DVec3::ZERO; points.len()];
    for triangle in mesh.triangles() {
        let [a, b, c] = triangle.map(|node| points[node as usize]);
        let area = (b - a).cross(c - a);
        triangle.iter().for_each(|&node| normals[node as usize] += area);
    }
    normals
}
