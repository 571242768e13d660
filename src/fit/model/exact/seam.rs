//! Seams: a wall that goes round its cylinder gets one loop, along a line from one rim to the other and back.
//!
//! ```text
//!  b ---<--- b'    a a' and b b' are one vertex each: the line from a to b is used in both directions. It runs beside
//!  |    ( )  |     holes, between vertices where the rims have them; a rim that is a whole circle begins where it is
//!  a --->--- a'    needed, any other edge is cut.
//! ```

use super::draft::{Draft, DraftEdge, DraftLoop};
use super::edges::Shape;
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// Places tried around a cylinder beside those of vertices.
const TRIALS: usize = 48;
/// Angle that a seam stays away from holes, and within which a vertex is at an angle.
const CLEARANCE: f64 = 0.02;
const SAME: f64 = 1e-7;

impl Draft {
    /// Joins the two loops of a face that go round its cylinder; None if no seam between them misses the holes.
    pub(super) fn add_seam(
        &mut self,
        face: usize,
        rims: [usize; 2],
        round: &Shape,
        holes: &[[f64; 2]],
    ) -> Option<()> {
        let is_free = |angle: &f64| {
            holes.iter().all(|[low, high]| {
                let middle = 0.5 * (low + high);
                let off = (angle - middle + PI).rem_euclid(TAU) - PI;
                off.abs() > 0.5 * (high - low) + CLEARANCE
            })
        };
        let at_vertices = rims.iter().flat_map(|&rim| self.vertex_angles(face, rim, round));
        let others = (0..TRIALS).map(|k| TAU * k as f64 / TRIALS as f64);
        let angles: Vec<f64> = at_vertices.chain(others).filter(is_free).collect();
        let ends = angles.into_iter().find_map(|angle| {
            let ends = rims.map(|rim| self.crossing(face, rim, round, angle));
            let [Some(a), Some(b)] = ends else { return None };
            Some([a, b])
        })?;
        let [a, b] = ends.map(|end| self.vertex_at(end));
        let along = (self.vertices[b] - self.vertices[a]).try_normalize()?;
        let shape = Shape::Line { origin: self.vertices[a], along };
        let length = self.vertices[a].distance(self.vertices[b]);
        let seam = self.edges.len();
        self.edges.push(DraftEdge { shape, vertices: [a, b], ends: [0.0, length], is_smooth: true });
        // cutting edges has changed the loops
        let mut loops = std::mem::take(&mut self.faces[face].loops);
        let [first, second] =
            [(rims[0], a), (rims[1], b)].map(|(rim, vertex)| self.turned(&loops[rim], vertex));
        let whole: DraftLoop =
            first?.into_iter().chain([(seam, true)]).chain(second?).chain([(seam, false)]).collect();
        let mut rim = 0..loops.len();
        loops.retain(|_| rim.next().is_some_and(|k| !rims.contains(&k)));
        loops.insert(0, whole);
        self.faces[face].loops = loops;
        Some(())
    }

    /// Angles of vertices of a loop that others need.
    fn vertex_angles(&self, face: usize, rim: usize, round: &Shape) -> Vec<f64> {
        let starts = self.faces[face].loops[rim].iter().map(|&(edge, _)| &self.edges[edge]);
        starts.map(|edge| round.parameter(self.vertices[edge.vertices[0]])).collect()
    }

    /// Where a loop passes an angle: the edge and its parameter.
    fn crossing(&self, face: usize, rim: usize, round: &Shape, angle: f64) -> Option<(usize, f64)> {
        let &Shape::Conic { frame: axis, radii } = round else { return None };
        let foot = axis.origin() + radii[0] * (angle.cos() * axis.x() + angle.sin() * axis.y());
        self.faces[face].loops[rim].iter().find_map(|&(edge, _)| {
            let DraftEdge { shape, ends, .. } = &self.edges[edge];
            let Shape::Conic { frame, .. } = shape else { return None };
            let height = (frame.origin() - foot).dot(frame.z()) / axis.z().dot(frame.z());
            let t = shape.parameter(foot + height * axis.z());
            // the same angle within the piece, or at one of its ends
            let t = ends[0] - SAME + (t - ends[0] + SAME).rem_euclid(TAU);
            (t <= ends[1] + SAME).then_some((edge, t))
        })
    }

    /// A vertex on an edge: one of its ends, or a new one that cuts it.
    fn vertex_at(&mut self, (edge, t): (usize, f64)) -> usize {
        let DraftEdge { shape, vertices, ends, is_smooth } = self.edges[edge].clone();
        let at_end = (0..2).find(|&k| (t - ends[k]).abs() <= SAME);
        if let Some(k) = at_end {
            self.held.push(vertices[k]);
            return vertices[k];
        }
        let place: DVec3 = shape.place(t);
        let is_ring = self.edges[edge].is_ring();
        if is_ring && !self.held.contains(&vertices[0]) && !self.corners.values().any(|&v| v == vertices[0]) {
            self.vertices[vertices[0]] = place;
            self.edges[edge].ends = [t, t + TAU];
            self.held.push(vertices[0]);
            return vertices[0];
        }
        let middle = self.vertices.len();
        self.vertices.push(place);
        self.held.push(middle);
        let rest = self.edges.len();
        self.edges[edge].vertices[1] = middle;
        self.edges[edge].ends[1] = t;
        self.edges.push(DraftEdge { shape, vertices: [middle, vertices[1]], ends: [t, ends[1]], is_smooth });
        for row in self.faces.iter_mut().flat_map(|face| &mut face.loops) {
            let cut = |&(of, is_forward): &(usize, bool)| match (of == edge, is_forward) {
                (false, _) => vec![(of, is_forward)],
                (true, true) => vec![(edge, true), (rest, true)],
                (true, false) => vec![(rest, false), (edge, false)],
            };
            *row = row.iter().flat_map(cut).collect();
        }
        middle
    }

    /// A loop that begins at a vertex.
    fn turned(&self, row: &DraftLoop, vertex: usize) -> Option<DraftLoop> {
        let start = |&(edge, is_forward): &(usize, bool)| self.edges[edge].vertices[usize::from(!is_forward)];
        let first = row.iter().position(|coedge| start(coedge) == vertex)?;
        let mut row = row.clone();
        row.rotate_left(first);
        Some(row)
    }
}
