//! Errors between the nodes, and the part of them that flat facets explain.

use super::errors::data_errors;
use super::neighbours::triangles_between;
use crate::control::Pool;
use crate::geometry::Domain;
use crate::mesh::Mesh;
use crate::surface::{Surface, normal};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// Errors at triangle centroids and edge middles.
#[derive(Debug, Clone, Copy, Default)]
pub struct InteriorErrors {
    /// The largest error.
    pub max: f64,
    /// The largest height of the shape above a facet; 0 for a field, which has no facets in space.
    pub sagitta: f64,
    /// The largest error beyond what its own facet explains.
    pub max_excess: f64,
}

/// Values on the nodes of a mesh over parameters.
#[derive(Clone, Copy)]
pub struct MeshData<'a> {
    pub mesh: &'a Mesh,
    pub uv: &'a [DVec2],
    pub values: &'a [f64],
    /// Whether the values are the nodes' places in space.
    pub is_shape: bool,
}

impl MeshData<'_> {
    /// Measures a surface between the nodes.
    pub fn interior_errors(&self, surface: &dyn Surface, pool: &Pool) -> InteriorErrors {
        Between::nodes(self, surface.dim()).measure(surface, pool)
    }
}

/// Places between the nodes of a mesh, with what is known of the shape there: made once for many surfaces.
pub struct Between {
    /// Four places for each triangle: its centroid and the middles of its edges.
    pub uv: Vec<DVec2>,
    values: Vec<f64>,
    /// What each triangle explains.
    allowances: Vec<f64>,
    is_shape: bool,
}

impl Between {
    /// Between the nodes of a mesh.
    pub fn nodes(data: &MeshData, dim: usize) -> Self {
        let triangles = data.mesh.triangles();
        let (uv, values) = interior_samples(triangles, data.uv, data.values, dim);
        let allowances = if data.is_shape {
            triangle_sagittas(data.mesh)
        } else {
            triangle_spreads(triangles, data.values, dim)
        };
        Self { uv, values, allowances, is_shape: data.is_shape }
    }

    /// Between scattered data, of which neighbours in (u,v) make triangles.
    pub fn scattered(uv: &[DVec2], values: &[f64], dim: usize, data: &Domain) -> Self {
        let triangles = triangles_between(uv, data);
        let (places, rows) = interior_samples(&triangles, uv, values, dim);
        let allowances = triangle_spreads(&triangles, values, dim);
        Self { uv: places, values: rows, allowances, is_shape: false }
    }

    /// What is known in one triangle of so many that at most `most` are left.
    pub fn thinned(&self, most: usize) -> Self {
        let every = self.allowances.len().div_ceil(most).max(1);
        let width = self.values.len() / self.uv.len().max(1);
        let places = self.uv.chunks(4).step_by(every).flatten().copied().collect();
        let values = self.values.chunks((4 * width).max(1)).step_by(every).flatten().copied().collect();
        let allowances = self.allowances.iter().step_by(every).copied().collect();
        Self { uv: places, values, allowances, is_shape: self.is_shape }
    }

    /// The error at each place.
    fn errors(&self, surface: &dyn Surface, pool: &Pool) -> Vec<f64> {
        if self.is_shape {
            heights_over(surface, &self.uv, &self.values, pool)
        } else {
            data_errors(surface, &self.uv, &self.values, pool).each
        }
    }

    /// Measures a surface.
    pub fn measure(&self, surface: &dyn Surface, pool: &Pool) -> InteriorErrors {
        let errors = self.errors(surface, pool);
        let mut result = InteriorErrors::default();
        for (errors, &allowance) in errors.chunks_exact(4).zip(&self.allowances) {
            let max = errors.iter().copied().fold(0.0, f64::max);
            result.max = result.max.max(max);
            result.max_excess = result.max_excess.max(max - allowance);
        }
        if self.is_shape {
            result.sagitta = self.allowances.iter().copied().fold(0.0, f64::max);
        }
        result
    }

    /// The error at each place beyond what its triangle explains.
    pub fn excess(&self, surface: &dyn Surface, pool: &Pool) -> Vec<f64> {
        let mut errors = self.errors(surface, pool);
        for (errors, allowance) in errors.chunks_exact_mut(4).zip(&self.allowances) {
            errors.iter_mut().for_each(|error| *error -= allowance);
        }
        errors
    }
}

/// Distances from places on facets to the tangent planes of the surface at their parameters. A map that
/// stretches unevenly puts the mean of parameters beside the mean of places, along the surface: that is no
/// error of the shape. Where the surface has no tangent plane the whole distance counts.
pub fn heights_over(surface: &dyn Surface, uv: &[DVec2], values: &[f64], pool: &Pool) -> Vec<f64> {
    const CHUNK: usize = 1024;
    let mut heights = vec![0.0; uv.len()];
    pool.run(|| {
        let data = uv.par_chunks(CHUNK).zip(values.par_chunks(3 * CHUNK));
        heights.par_chunks_mut(CHUNK).zip(data).for_each(|(heights, (uv, values))| {
            // a cancelled call throws its heights away
            if pool.check().is_err() {
                return;
            }
            let mut rows = vec![0.0; uv.len() * 9];
            surface.eval_rows(uv, 1, &mut rows);
            for ((height, row), value) in heights.iter_mut().zip(rows.chunks(9)).zip(values.chunks(3)) {
                let [s, su, sv] = [0, 3, 6].map(|k| DVec3::from_slice(&row[k..]));
                let miss = DVec3::from_slice(value) - s;
                let normal = normal(su, sv);
                *height = if normal.is_nan() { miss.length() } else { miss.dot(normal).abs() };
            }
        });
    });
    heights
}

/// Centroid and three edge middles of each triangle.
fn interior_samples(
    triangles: &[[u32; 3]],
    uv: &[DVec2],
    values: &[f64],
    dim: usize,
) -> (Vec<DVec2>, Vec<f64>) {
    let count = 4 * triangles.len();
    let (mut places, mut rows) = (Vec::with_capacity(count), Vec::with_capacity(count * dim));
    for &[a, b, c] in triangles {
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
/// the middle of its edges. Normals are rough at borders and on uneven triangles, so each facet takes the
/// largest height among the edges at its nodes.
pub fn triangle_sagittas(mesh: &Mesh) -> Vec<f64> {
    let normals = mesh.node_normals();
    let mut heights = vec![0.0_f64; normals.len()];
    let mut is_border = vec![false; normals.len()];
    mesh.loops().iter().flatten().for_each(|&node| is_border[node as usize] = true);
    for &[a, b, c] in mesh.triangles() {
        for (a, b) in [(a, b), (b, c), (c, a)] {
            let (a, b) = (a as usize, b as usize);
            let angle = normals[a].angle_between(normals[b]);
            let angle = if angle.is_finite() { angle } else { 0.0 };
            let height = mesh.points()[a].distance(mesh.points()[b]) / 2.0 * (angle / 4.0).tan();
            // a normal at the border is that of one side only, half an edge away
            let is_border = is_border[a] || is_border[b];
            let height = if is_border { 2.0 * height } else { height };
            heights[a] = heights[a].max(height);
            heights[b] = heights[b].max(height);
        }
    }
    let highest = |nodes: &[u32; 3]| nodes.iter().map(|&n| heights[n as usize]).fold(0.0, f64::max);
    mesh.triangles().iter().map(|nodes| 4.0 / 3.0 * highest(nodes)).collect()
}

/// How far the values of a field differ along the edges around each facet. What a field does between its nodes
/// is unknown, but a surface that leaves the values of a facet by more than they change around it oscillates.
fn triangle_spreads(triangles: &[[u32; 3]], values: &[f64], dim: usize) -> Vec<f64> {
    let value = |node: usize| &values[node * dim..][..dim];
    let mut spreads = vec![0.0_f64; values.len() / dim];
    for &[a, b, c] in triangles {
        for (a, b) in [(a, b), (b, c), (c, a)] {
            let (a, b) = (a as usize, b as usize);
            let spread = value(a).iter().zip(value(b)).map(|(x, y)| (x - y).powi(2)).sum::<f64>().sqrt();
            spreads[a] = spreads[a].max(spread);
            spreads[b] = spreads[b].max(spread);
        }
    }
    let largest = |nodes: &[u32; 3]| nodes.iter().map(|&n| spreads[n as usize]).fold(0.0, f64::max);
    triangles.iter().map(largest).collect()
}
