//! Configurations as printed, and sharp features among them.
//!
//! J. Cao, J. Zheng (2016), sections 3 and 4, with the misprints corrected:
//! ```text
//! X = an inner vertex, edge or face for k = 1, 2, 3;  E = the border of all faces that have a vertex of X
//! sharp edge (v1,v2): X = {v1 + s/k (v2 - v1), s = 0 .. k-1}, E = the border of the faces around v1, and the same
//!                     with v1 and v2 exchanged: k + 1 collinear knots, C0 across the edge
//! vertex to be interpolated: X = {v, .., v}, E = the border of the faces around v: the k-th power of its hat
//! ```
//! The functions do not sum to one: the surface is their weighted mean. With the sector rule the faces around a
//! vertex of a crease count only as far as the crease, on the side of X; edges of the crease are no X.

use super::configuration::{Configuration, mean_row};
use crate::memory::{self, CollectVec};
use crate::mesh::{HalfEdge, Mesh};
use glam::DVec2;

/// The parameter mesh and its sharp features.
pub(super) struct Plane<'a> {
    pub mesh: &'a Mesh,
    pub degree: usize,
    /// By half-edge.
    pub is_sharp: &'a [bool],
    /// Vertices to be interpolated.
    pub fixed: &'a [u32],
    /// Whether faces count as far as the crease only.
    pub keeps_sectors: bool,
    pub sharp_weight: f64,
}

impl Plane<'_> {
    /// The smooth functions: for each inner vertex, edge or face.
    pub(super) fn smooth(&self) -> Vec<Configuration> {
        let triangles = self.mesh.triangles();
        let is_inner =
            |knots: &[u32]| knots.iter().all(|&v| self.mesh.is_used(v) && !self.mesh.is_boundary(v));
        let mut sets: Vec<(Vec<u32>, usize)> = Vec::new();
        match self.degree {
            1 => {
                let first = |v: u32| self.mesh.topology().first(v).map(HalfEdge::triangle);
                let vertices = 0..self.mesh.points().len() as u32;
                memory::extend(&mut sets, vertices.filter_map(|v| Some((vec![v], first(v)?))));
            }
            2 => {
                let half_edges = (0..3 * triangles.len()).map(|h| HalfEdge::new(h / 3, h % 3));
                let one_side = half_edges.filter(|h| h.origin(triangles) < h.target(triangles));
                let smooth = one_side.filter(|h| !(self.keeps_sectors && self.is_sharp[h.index()]));
                memory::extend(
                    &mut sets,
                    smooth.map(|h| (vec![h.origin(triangles), h.target(triangles)], h.triangle())),
                );
            }
            _ => sets.extend(triangles.iter().enumerate().map(|(face, t)| (memory::copied(t), face))),
        }
        sets.retain(|(knots, _)| is_inner(knots));
        let configuration = |(knots, face): (Vec<u32>, usize)| {
            let stars = knots.iter().flat_map(|&vertex| self.star(vertex, face));
            let edges = self.border(stars.collect_vec());
            let weight = 1.0 / knots.len() as f64;
            let mut row: Vec<(u32, f64)> = knots.iter().map(|&vertex| (vertex, weight)).collect_vec();
            row.sort_by_key(|&(vertex, _)| vertex);
            Configuration { knots, edges, weight: 1.0, row }
        };
        sets.into_iter().map(configuration).collect_vec()
    }

    /// The functions of sharp edges and fixed vertices; their own knots are added to `places`.
    pub(super) fn special(&self, places: &mut Vec<DVec2>) -> Vec<Configuration> {
        let triangles = self.mesh.triangles();
        let mut all = Vec::new();
        let half_edges = (0..self.is_sharp.len()).filter(|&h| self.is_sharp[h] && self.degree > 1);
        for half_edge in half_edges.map(|h| HalfEdge::new(h / 3, h % 3)) {
            let ends = [half_edge.origin(triangles), half_edge.target(triangles)];
            let [from, to] = ends.map(|vertex| places[vertex as usize]);
            let shares = (1..self.degree).map(|s| s as f64 / self.degree as f64);
            let own: Vec<DVec2> = shares.clone().map(|share| from + share * (to - from)).collect_vec();
            let rows: Vec<[(u32, f64); 2]> = std::iter::once(0.0)
                .chain(shares)
                .map(|share| [(ends[0], 1.0 - share), (ends[1], share)])
                .collect_vec();
            let first = places.len() as u32;
            places.extend(own);
            let knots = std::iter::once(ends[0]).chain(first..places.len() as u32).collect_vec();
            let row = mean_row(rows.iter().map(|row| row.as_slice()));
            let edges = self.border(self.faces_around(ends[0]));
            memory::push(&mut all, Configuration { knots, edges, weight: self.sharp_weight, row });
        }
        for &vertex in self.fixed {
            let edges = self.border(self.faces_around(vertex));
            let knots = memory::filled(vertex, self.degree);
            memory::push(
                &mut all,
                Configuration { knots, edges, weight: self.sharp_weight, row: vec![(vertex, 1.0)] },
            );
        }
        all
    }

    fn faces_around(&self, vertex: u32) -> Vec<usize> {
        self.mesh.outgoing(vertex).map(HalfEdge::triangle).collect_vec()
    }

    /// The faces around a vertex, with the sector rule only those on the side of `face`.
    fn star(&self, vertex: u32, face: usize) -> Vec<usize> {
        if !self.keeps_sectors || self.degree == 1 {
            return self.faces_around(vertex);
        }
        let faces =
            |sector: Vec<HalfEdge>| sector.into_iter().map(HalfEdge::triangle).collect::<Vec<usize>>();
        let fans = self.mesh.topology().fans(vertex);
        let mut sectors = fans.flat_map(|start| self.mesh.sectors(start, self.is_sharp)).map(faces);
        sectors.find(|sector| sector.contains(&face)).unwrap_or_default()
    }

    /// The directed edges of some faces whose reverse is not among them.
    fn border(&self, mut faces: Vec<usize>) -> Vec<[u32; 2]> {
        faces.sort_unstable();
        faces.dedup();
        let sides = |face: usize| {
            let [a, b, c] = self.mesh.triangles()[face];
            [[a, b], [b, c], [c, a]]
        };
        let mut edges: Vec<[u32; 2]> = faces.iter().flat_map(|&face| sides(face)).collect_vec();
        edges.sort_unstable();
        let has = |edge: [u32; 2]| edges.binary_search(&edge).is_ok();
        edges.iter().copied().filter(|&[a, b]| !has([b, a])).collect_vec()
    }
}
