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
use crate::memory::CollectVec;
use glam::DVec3;

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

/// Normals of the facets without noise; those of facets without area stay zero.
pub(super) fn filtered(mesh: &Mesh, mut normals: Vec<DVec3>) -> Vec<DVec3> {
    let triangles = mesh.triangles();
    let centroid = |t: &[u32; 3]| t.iter().map(|&node| mesh.points()[node as usize]).sum::<DVec3>() / 3.0;
    let centroids: Vec<DVec3> = triangles.iter().map(centroid).collect_vec();
    let areas: Vec<f64> = triangles.iter().map(|t| normal(mesh.points(), t).length()).collect_vec();
    let around: Vec<Vec<u32>> = triangles
        .iter()
        .map(|t| {
            let mut facets: Vec<u32> = t
                .iter()
                .flat_map(|&node| mesh.outgoing(node))
                .map(|edge| edge.triangle() as u32)
                .collect_vec();
            facets.sort_unstable();
            facets.dedup();
            facets
        })
        .collect_vec();
    let distance = |i: usize, j: u32| centroids[i].distance(centroids[j as usize]);
    let (count, sum) = around.iter().enumerate().fold((0, 0.0), |(count, sum), (i, facets)| {
        (count + facets.len(), sum + facets.iter().map(|&j| distance(i, j)).sum::<f64>())
    });
    let spread_sq = (sum / count as f64).powi(2);
    for _ in 0..SWEEPS {
        let mean = |(i, facets): (usize, &Vec<u32>)| {
            let weighted = facets.iter().map(|&j| {
                let far = distance(i, j).powi(2) / (2.0 * spread_sq);
                let turned = normals[i].distance_squared(normals[j as usize]) / (2.0 * NORMAL_SPREAD.powi(2));
                areas[j as usize] * (-far - turned).exp() * normals[j as usize]
            });
            weighted.sum::<DVec3>().normalize_or_zero()
        };
        normals = around.iter().enumerate().map(mean).collect_vec();
    }
    normals
}
