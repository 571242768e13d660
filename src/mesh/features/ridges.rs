//! Blunt edges that are features all the same: their facets turn by less than those of sharp ones, but far more than the
//! surface beside them bends.
//!
//! ```text
//!         w               By how much the normals of h and g leave that of f across the edge ab is the bend of f. Where
//!        / \  g           a round surface is triangulated coarsely the facets beside an edge bend as it turns; at an
//!       / h \             edge between two faces of a part they hardly do. Two facets away, for those of a wall stand
//!      b-----c            in pairs that are plane.
//!      | f  /
//!      |  /
//!      a
//! ```

use super::super::{HalfEdge, Mesh};
use glam::DVec3;

/// A ridge turns by more than so many times what the surface beside it bends. On scanned heads and cast parts few edges do,
/// and hardly any chain of them divides the surface.
pub(super) const LEAST_RATIO: f64 = 3.0;

/// A crease that fades out goes on as long as its edges turn by more than so many times; along a round wall they turn once.
pub(super) const FADING_RATIO: f64 = 1.5;

/// Ridges shorter than this part of the diagonal are accidents of the triangulation.
pub(super) const LEAST_LENGTH: f64 = 0.015;

/// Surfaces bend by no less: rounding of coordinates in single precision.
const LEAST_BEND: f64 = 1e-4;

/// An edge that is sharp and turns by more than so many times another bounds the surface beside it.
const BOUND: f64 = 2.0;

/// The facets of a mesh as ridges are looked for.
pub(super) struct Facets<'a> {
    pub mesh: &'a Mesh,
    /// By facet.
    pub normals: &'a [DVec3],
    /// By half-edge.
    pub turns: &'a [f64],
    pub sharp_angle: f64,
}

impl Facets<'_> {
    /// By how many times an edge turns more than the surface beside it bends; 0 at the border.
    pub(super) fn ratio(&self, edge: HalfEdge) -> f64 {
        let Some(twin) = self.mesh.topology().twin(edge) else { return 0.0 };
        self.turns[edge.index()] / self.bend(edge).max(self.bend(twin)).max(LEAST_BEND)
    }

    /// By how much the surface on the left of an edge bends across it.
    fn bend(&self, edge: HalfEdge) -> f64 {
        let triangles = self.mesh.triangles();
        let [from, to] = [edge.origin(triangles), edge.target(triangles)];
        let along = (self.mesh.points()[to as usize] - self.mesh.points()[from as usize]).normalize_or_zero();
        let across = self.normals[edge.triangle()].cross(along);
        let bound = self.sharp_angle.max(BOUND * self.turns[edge.index()]);
        let beyond =
            |side: HalfEdge| self.mesh.topology().twin(side).filter(|_| self.turns[side.index()] <= bound);
        let off = |side: HalfEdge| self.normals[side.triangle()].dot(across).abs().min(1.0).asin();
        // over each side to the next facet, and from there away from the edge
        let over = [
            beyond(edge.next()).map(|side| (side, side.previous())),
            beyond(edge.previous()).map(|side| (side, side.next())),
        ];
        let bends =
            over.into_iter().flatten().map(|(side, away)| off(side).max(beyond(away).map_or(0.0, off)));
        bends.fold(0.0, f64::max)
    }
}
