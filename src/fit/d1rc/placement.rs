//! Where the data lie in the parameter plane of a control mesh.
//!
//! The boundary of a coarser mesh cuts corners, so nodes of the boundary go to the nearest place on its boundary, and
//! so does what lies outside; nodes of sharp edges go to the nearest place on its sharp edges. There they may slide.
//! A control mesh that was made elsewhere has a plane of its own: in it each node gets the parameters of its nearest
//! place in space.

use crate::control::Pool;
use crate::memory::{self, CollectVec, ParallelCollectVec};
use crate::mesh::Mesh;
use crate::query::triangles::TriangleTree;
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// The parameters of nodes over one control mesh, and the lines on which some of them stay.
pub(super) struct Placement {
    pub uv: Vec<DVec2>,
    /// By node.
    lines: Vec<Line>,
    boundary: Vec<[DVec2; 2]>,
    creases: Vec<[DVec2; 2]>,
}

/// Where a node stays.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Line {
    None,
    Crease,
    Boundary,
}

impl Placement {
    /// In the plane that a mesh shares with the control mesh made of it; `sharp` are the sharp edges of both.
    pub(super) fn in_plane(
        fine: &Mesh,
        coarse: &Mesh,
        sharp: (&[[u32; 2]], &[[u32; 2]]),
        pool: &Pool,
    ) -> Self {
        let uv = memory::copied(fine.parameters().unwrap_or_default());
        let mut placement = Self::on_lines(uv, fine, coarse, sharp);
        let flat = flat(coarse);
        let tree = flat.as_ref().map(TriangleTree::new);
        let inside = |uv: DVec2| {
            let near = tree.as_ref().and_then(|tree| tree.nearest(uv.extend(0.0)));
            near.filter(|near| near.distance > 0.0).map_or(uv, |near| near.point.truncate())
        };
        let lines = &placement.lines;
        pool.run(|| {
            let free = placement.uv.par_iter_mut().zip(lines).filter(|(_, line)| **line == Line::None);
            free.for_each(|(uv, _)| *uv = inside(*uv));
        });
        placement
    }

    /// From nearest places in space.
    pub(super) fn in_space(mesh: &Mesh, coarse: &Mesh, pool: &Pool) -> Self {
        let places = coarse.parameters().unwrap_or_default();
        let tree = TriangleTree::new(coarse);
        let place = |&point: &DVec3| {
            let Some(near) = tree.nearest(point) else { return DVec2::ZERO };
            let nodes = coarse.triangles()[near.triangle as usize].map(|node| node as usize);
            let shares = barycentric(near.point, nodes.map(|node| coarse.points()[node]));
            nodes.iter().zip(shares).map(|(&node, share)| share * places[node]).sum()
        };
        let uv = pool.run(|| mesh.points().par_iter().map(place).collect_vec());
        Self::on_lines(uv, mesh, coarse, (&[], &[]))
    }

    /// Puts nodes of the boundary and of sharp edges on their lines.
    fn on_lines(uv: Vec<DVec2>, mesh: &Mesh, coarse: &Mesh, sharp: (&[[u32; 2]], &[[u32; 2]])) -> Self {
        let places = coarse.parameters().unwrap_or_default();
        let segment = |edge: [u32; 2]| edge.map(|node| places[node as usize]);
        let mut lines = memory::filled(Line::None, uv.len());
        sharp.0.iter().flatten().for_each(|&node| lines[node as usize] = Line::Crease);
        mesh.loops().iter().flatten().for_each(|&node| lines[node as usize] = Line::Boundary);
        let boundary = coarse.boundary_edges().map(segment).collect_vec();
        let creases = sharp.1.iter().copied().map(segment).collect_vec();
        let mut placement = Self { uv, lines, boundary, creases };
        placement.uv =
            (0..placement.uv.len()).map(|node| placement.settled(node, placement.uv[node])).collect_vec();
        placement
    }

    /// Where a node goes that is to move to a place: the nearest one on its line, if it has one.
    pub(super) fn settled(&self, node: usize, place: DVec2) -> DVec2 {
        match self.lines[node] {
            Line::None => place,
            Line::Crease => nearest(place, &self.creases),
            Line::Boundary => nearest(place, &self.boundary),
        }
    }
}

/// A mesh of the parameters.
fn flat(mesh: &Mesh) -> Option<Mesh> {
    let places = mesh.parameters()?.iter().map(|uv| uv.extend(0.0));
    Mesh::new(places.collect_vec(), memory::copied(mesh.triangles())).ok()
}

/// The nearest place on some segments; the point itself if there are none.
fn nearest(point: DVec2, segments: &[[DVec2; 2]]) -> DVec2 {
    let on = |&[from, to]: &[DVec2; 2]| {
        let along = to - from;
        from + ((point - from).dot(along) / along.length_squared()).clamp(0.0, 1.0) * along
    };
    let distance = |place: &DVec2| place.distance_squared(point);
    segments.iter().map(on).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(point)
}

/// The shares of the corners of a triangle in a place on it.
fn barycentric(place: DVec3, [a, b, c]: [DVec3; 3]) -> [f64; 3] {
    let normal = (b - a).cross(c - a);
    let share = |from: DVec3, to: DVec3| {
        let area = (to - from).cross(place - from).dot(normal) / normal.length_squared();
        if area.is_finite() { area.clamp(0.0, 1.0) } else { 1.0 / 3.0 }
    };
    let (of_b, of_c) = (share(c, a), share(a, b));
    [1.0 - of_b - of_c, of_b, of_c]
}
