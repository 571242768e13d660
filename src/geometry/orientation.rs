//! On which side of a line a point lies, without rounding error.
//!
//! J. R. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric
//! predicates", Discrete Comput. Geom. 18 (1997), 305-363; through the crate `robust`.

use glam::DVec2;

/// The turn of three points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Orientation {
    /// Counter-clockwise: a triangle of positive area.
    Positive,
    /// The points lie on one line.
    Zero,
    /// Clockwise: a reversed triangle.
    Negative,
}

/// The exact sign of the area of the triangle `a`, `b`, `c`.
pub fn orientation(a: DVec2, b: DVec2, c: DVec2) -> Orientation {
    let coord = |p: DVec2| robust::Coord { x: p.x, y: p.y };
    match robust::orient2d(coord(a), coord(b), coord(c)) {
        area if area > 0.0 => Orientation::Positive,
        area if area < 0.0 => Orientation::Negative,
        _ => Orientation::Zero,
    }
}
