//! Noise of a mesh, and normals without it.
//!
//! Y. Zheng, H. Fu, O. K.-C. Au, C.-L. Tai, "Bilateral normal filtering for mesh denoising", IEEE Trans. Vis. Comput.
//! Graph. 17 (2011), 1521-1530: each normal becomes the mean of its neighbours' that differ little from it, so that
//! noise is averaged away and creases stay.
//! ```text
//! n_i  <-  sum_j A_j exp(-|c_i - c_j|^2 / 2 s_c^2) exp(-|n_i - n_j|^2 / 2 s_n^2) n_j,   normalized
//! ```
//! over the facets j around the corners of i; s_c is the mean distance of neighbours' centroids.

use super::super::Mesh;
use super::super::decimate::normal;
use crate::control::Pool;
use crate::memory::{self, CollectVec, ParallelCollectVec};
use glam::DVec3;
use rayon::prelude::*;

/// Noise above which normals are filtered, by mean edge length: below it angles are right within a few degrees.
pub(super) const WORTH_FILTERING: f64 = 0.02;
/// s_n: facets that turn by more than about twice this do not mix. A noise of 10 % of the edge length turns normals
/// by about 0.15.
const NORMAL_SPREAD: f64 = 0.35;
/// Sweeps: noise of a tenth of an edge length is then below that of the estimate.
const SWEEPS: usize = 12;
/// Standard deviation of twice differenced unit noise on a hexagonal mesh, 1.36, times the median of the absolute
/// value of a normal variable, 0.6745.
const MEDIAN_OF_UNIT_NOISE: f64 = 0.917;

/// The standard deviation of the nodes along the normal, by mean edge length.
///
/// The difference of a node from the mean of its neighbours, differenced again, forgets slope and curvature; the median
/// of its part along the normal is that of noise, and creases, which few nodes have, do not count.
pub(super) fn estimate(mesh: &Mesh) -> f64 {
    estimate_of(mesh, |_| true)
}

/// The same of nodes that are asked for, and so are all their neighbours.
pub(super) fn estimate_of(mesh: &Mesh, is_asked: impl Fn(u32) -> bool) -> f64 {
    let points = mesh.points();
    let inner = |node: u32| mesh.is_used(node) && !mesh.is_boundary(node) && is_asked(node);
    let difference = |values: &[DVec3], node: u32| {
        let (count, sum) = mesh
            .neighbours(node)
            .fold((0, DVec3::ZERO), |(n, sum), other| (n + 1, sum + values[other as usize]));
        values[node as usize] - sum / f64::from(count.max(1))
    };
    let nodes = 0..points.len() as u32;
    let first: Vec<DVec3> = nodes
        .clone()
        .map(|node| if inner(node) { difference(points, node) } else { DVec3::ZERO })
        .collect_vec();
    let is_deep = |node: u32| inner(node) && mesh.neighbours(node).all(inner);
    let mut sizes: Vec<f64> = nodes
        .filter(|&node| is_deep(node))
        .map(|node| {
            let along = mesh.outgoing(node).map(|edge| normal(points, &mesh.triangles()[edge.triangle()]));
            difference(&first, node).dot(along.sum::<DVec3>().normalize_or_zero()).abs()
        })
        .collect_vec();
    if sizes.is_empty() {
        return 0.0;
    }
    let middle = sizes.len() / 2;
    let (_, median, _) = sizes.select_nth_unstable_by(middle, f64::total_cmp);
    *median / (MEDIAN_OF_UNIT_NOISE * mean_edge_length(mesh))
}

fn mean_edge_length(mesh: &Mesh) -> f64 {
    let side = |t: &[u32; 3], k: usize| {
        mesh.points()[t[k] as usize].distance(mesh.points()[t[(k + 1) % 3] as usize])
    };
    let sum: f64 = mesh.triangles().iter().map(|t| (0..3).map(|k| side(t, k)).sum::<f64>()).sum();
    sum / (3 * mesh.triangles().len()) as f64
}

/// Normals of the facets without noise; those of facets without area stay zero. A cancelled call gets those that it has.
pub(super) fn filtered(mesh: &Mesh, mut normals: Vec<DVec3>, pool: &Pool) -> Vec<DVec3> {
    let triangles = mesh.triangles();
    let centroid = |t: &[u32; 3]| t.iter().map(|&node| mesh.points()[node as usize]).sum::<DVec3>() / 3.0;
    let centroids: Vec<DVec3> = triangles.iter().map(centroid).collect_vec();
    let areas: Vec<f64> = triangles.iter().map(|t| normal(mesh.points(), t).length()).collect_vec();
    let around = Around::new(mesh);
    let distance = |i: usize, j: u32| centroids[i].distance(centroids[j as usize]);
    let of_facet = |i: usize| around.of(i).iter().map(|&j| distance(i, j)).sum::<f64>();
    let sum: f64 = (0..triangles.len()).map(of_facet).sum();
    let spread_sq = (sum / around.facets.len() as f64).powi(2);
    for _ in 0..SWEEPS {
        let mean = |i: usize| {
            let weighted = around.of(i).iter().map(|&j| {
                let far = distance(i, j).powi(2) / (2.0 * spread_sq);
                let turned = normals[i].distance_squared(normals[j as usize]) / (2.0 * NORMAL_SPREAD.powi(2));
                areas[j as usize] * (-far - turned).exp() * normals[j as usize]
            });
            weighted.sum::<DVec3>().normalize_or_zero()
        };
        if pool.check().is_err() {
            break;
        }
        normals =
            pool.run(|| (0..triangles.len()).into_par_iter().with_min_len(1024).map(mean).collect_vec());
    }
    normals
}

/// The facets around the corners of each, itself among them.
struct Around {
    facets: Vec<u32>,
    /// Where those of each begin, and at last where those of the last end.
    starts: Vec<usize>,
}

impl Around {
    fn new(mesh: &Mesh) -> Self {
        let (mut facets, mut starts, mut own) = (Vec::new(), Vec::new(), Vec::new());
        for triangle in mesh.triangles() {
            own.clear();
            own.extend(
                triangle.iter().flat_map(|&node| mesh.outgoing(node)).map(|edge| edge.triangle() as u32),
            );
            own.sort_unstable();
            own.dedup();
            memory::push(&mut starts, facets.len());
            memory::extend(&mut facets, own.iter().copied());
        }
        memory::push(&mut starts, facets.len());
        Self { facets, starts }
    }

    fn of(&self, facet: usize) -> &[u32] {
        &self.facets[self.starts[facet]..self.starts[facet + 1]]
    }
}
