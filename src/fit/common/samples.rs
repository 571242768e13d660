//! What is fitted beside the nodes: where triangles are larger than cells, places inside them.
//!
//! With cells smaller than triangles the nodes alone leave the surface free between them; it then swings by
//! many times the tolerance. Triangles are cut until their parts are as small as a cell, and the middles of the
//! parts are fitted with a weight so small that nodes are not pulled off, but above the bending energy's.

use super::uniform::grid::UniformGrid;
use crate::mesh::Mesh;
use glam::{DVec2, DVec3};

/// A place inside a triangle.
#[derive(Debug, Clone, Copy)]
pub(crate) struct InteriorPlace {
    pub nodes: [usize; 3],
    /// How it weighs the nodes.
    pub shares: [f64; 3],
    /// The mean weight of the nodes.
    pub weight: f64,
}

/// Most parts along one side of a triangle; a guard against triangles of absurd length.
const MOST_PARTS: usize = 256;

/// The places inside triangles that are larger than the cells of a grid.
pub(crate) fn interior_places<'a>(
    mesh: &'a Mesh,
    uv: &'a [DVec2],
    grid: &[UniformGrid; 2],
    weights: Option<&'a [f64]>,
) -> impl Iterator<Item = InteriorPlace> + 'a {
    places_in_cells(mesh, uv, in_cells(grid), weights)
}

/// Parameters of which one unit is a cell of a grid.
pub(crate) fn in_cells(grid: &[UniformGrid; 2]) -> impl Fn(DVec2) -> DVec2 + use<> {
    let cell = DVec2::new(grid[0].step, grid[1].step);
    move |uv| uv / cell
}

/// The same with parameters of which one unit is a cell.
pub(crate) fn places_in_cells<'a>(
    mesh: &'a Mesh,
    uv: &'a [DVec2],
    in_cells: impl Fn(DVec2) -> DVec2 + 'a,
    weights: Option<&'a [f64]>,
) -> impl Iterator<Item = InteriorPlace> + 'a {
    mesh.triangles().iter().flat_map(move |triangle| {
        let nodes = triangle.map(|node| node as usize);
        let parts = part_count(nodes.map(|n| in_cells(uv[n])));
        let weight = weights.map_or(1.0, |w| mean_weight(nodes.map(|n| w[n])));
        let middles = (parts >= 2 && weight > 0.0).then(|| part_middles(parts)).into_iter().flatten();
        middles.map(move |shares| InteriorPlace { nodes, shares, weight })
    })
}

/// The mean weight of the corners of a triangle; 0 if one has none: the inside is known no better than that.
pub(crate) fn mean_weight(corners: [f64; 3]) -> f64 {
    if corners.contains(&0.0) { 0.0 } else { corners.iter().sum::<f64>() / 3.0 }
}

impl InteriorPlace {
    /// The mean of what the nodes have, weighed by the shares.
    pub(crate) fn mean<T: std::iter::Sum<T>>(&self, at: impl Fn(usize) -> T) -> T
    where
        f64: std::ops::Mul<T, Output = T>,
    {
        self.nodes.iter().zip(self.shares).map(|(&node, share)| share * at(node)).sum()
    }
}

/// Weight of a place inside a triangle against that of a node, as a multiple of the smoothing: well above the
/// bending energy, which would let the surface swing, and so far below the nodes that it does not pull them.
const INTERIOR_PER_SMOOTHING: f64 = 50.0;
/// Its limit: places inside are estimates.
const INTERIOR_MOST: f64 = 0.05;

/// Weight of places inside triangles against that of nodes.
pub(crate) fn interior_weight(smoothing: f64) -> f64 {
    (INTERIOR_PER_SMOOTHING * smoothing).min(INTERIOR_MOST)
}

/// Into how many parts each side is cut, so that parts are no longer than a cell; corners in cells.
fn part_count([a, b, c]: [DVec2; 3]) -> usize {
    let side = |a: DVec2, b: DVec2| (a - b).abs().max_element();
    (side(a, b).max(side(b, c)).max(side(c, a)).ceil() as usize).min(MOST_PARTS)
}

/// Barycentric coordinates of the middles of the `n * n` parts of a triangle.
fn part_middles(n: usize) -> impl Iterator<Item = [f64; 3]> {
    (0..n)
        .flat_map(move |i| {
            (0..n - i).flat_map(move |j| {
                let upright = ((i, j), 1.0);
                let reversed = (i + j + 1 < n).then_some(((i, j), 2.0));
                [Some(upright), reversed].into_iter().flatten()
            })
        })
        .map(move |((i, j), thirds)| {
            let at = |k: usize| (k as f64 + thirds / 3.0) / n as f64;
            let (b, c) = (at(i), at(j));
            [1.0 - b - c, b, c]
        })
}

/// The place of a smooth shape over a flat facet: halfway from the facet to the tangent planes of its corners,
/// which is exact for quadratic shapes (T. Boubekeur and M. Alexa, "Phong tessellation", ACM Trans. Graph.
/// 27 (2008), with the factor 1/2).
pub(crate) fn bulge(corners: [DVec3; 3], normals: [DVec3; 3], shares: [f64; 3]) -> DVec3 {
    let flat: DVec3 = corners.iter().zip(shares).map(|(&p, share)| share * p).sum();
    let lift: DVec3 = (0..3).map(|k| shares[k] * (corners[k] - flat).dot(normals[k]) * normals[k]).sum();
    flat + 0.5 * lift
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_cover_a_triangle_evenly() {
        for n in 1..6 {
            let middles: Vec<[f64; 3]> = part_middles(n).collect();
            assert_eq!(middles.len(), n * n);
            for k in 0..3 {
                let mean = middles.iter().map(|m| m[k]).sum::<f64>() / (n * n) as f64;
                assert!((mean - 1.0 / 3.0).abs() < 1e-14, "{n}: {mean}");
            }
            assert!(middles.iter().flatten().all(|&share| share > 0.0));
        }
    }

    #[test]
    fn a_facet_of_a_paraboloid_bulges_onto_it() {
        let h = 1e-3;
        let corners = [(0., 0.), (h, 0.), (0., h)].map(|(x, y)| DVec3::new(x, y, x * x + 0.5 * y * y));
        let normals = corners.map(|p| DVec3::new(-2.0 * p.x, -p.y, 1.0).normalize());
        for shares in part_middles(3) {
            let p = bulge(corners, normals, shares);
            // exact but for the tilt of the normals, which is of third order
            assert!((p.z - (p.x * p.x + 0.5 * p.y * p.y)).abs() < 4.0 * h * h * h, "{p}");
        }
    }
}
