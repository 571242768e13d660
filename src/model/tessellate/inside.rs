//! Which triangles of a face's plane are part of the face.

use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

/// Which triangles lie inside an odd number of loops: those reached from outside across an odd number of sides.
pub(super) struct Inside {
    pub keeps: Vec<bool>,
}

impl Inside {
    pub(super) fn new(triangulation: &ConstrainedDelaunayTriangulation<Point2<f64>>) -> Self {
        let mut parity = vec![None; triangulation.num_all_faces()];
        let outer = triangulation.outer_face().fix();
        parity[outer.index()] = Some(false);
        let mut stack = Vec::new();
        for edge in triangulation.convex_hull() {
            // the inner side of the hull
            stack.push((edge.rev().fix(), edge.is_constraint_edge()));
            stack.push((edge.fix(), edge.is_constraint_edge()));
        }
        while let Some((edge, is_inside)) = stack.pop() {
            let Some(face) = triangulation.directed_edge(edge).face().as_inner() else { continue };
            if parity[face.fix().index()].is_some() {
                continue;
            }
            parity[face.fix().index()] = Some(is_inside);
            for side in face.adjacent_edges() {
                stack.push((side.rev().fix(), is_inside ^ side.is_constraint_edge()));
            }
        }
        Self { keeps: parity.into_iter().map(|inside| inside == Some(true)).collect() }
    }

    /// Whether a place is inside a kept triangle, not on its sides.
    pub(super) fn contains(
        &self,
        triangulation: &ConstrainedDelaunayTriangulation<Point2<f64>>,
        place: Point2<f64>,
    ) -> bool {
        match triangulation.locate(place) {
            spade::PositionInTriangulation::OnFace(face) => self.keeps[face.index()],
            spade::PositionInTriangulation::OnEdge(edge) => {
                let edge = triangulation.directed_edge(edge);
                !edge.is_constraint_edge()
                    && edge.face().as_inner().is_some_and(|face| self.keeps[face.fix().index()])
            }
            _ => false,
        }
    }
}
