//! What a tessellation is, and how good it is.

use crate::mesh::Mesh;
use glam::DVec3;

/// A tessellation with its quality.
#[derive(Debug, Clone)]
pub struct Tessellation {
    /// The mesh; its parameters are those of the surface.
    pub mesh: Mesh,
    /// Smallest angle of a triangle in space, in radians.
    pub smallest_angle: f64,
    /// Largest distance measured between an edge's middle and the surface.
    pub chord_error: f64,
}

pub(crate) fn distance_to_segment(p: DVec3, a: DVec3, b: DVec3) -> f64 {
    let along = b - a;
    let length_sq = along.length_squared();
    let t = if length_sq > 0.0 { ((p - a).dot(along) / length_sq).clamp(0.0, 1.0) } else { 0.0 };
    p.distance(a + t * along)
}

pub(crate) fn least_angle([a, b, c]: [DVec3; 3]) -> f64 {
    (b - a).angle_between(c - a).min((c - b).angle_between(a - b)).min((a - c).angle_between(b - c))
}
