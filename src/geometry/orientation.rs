//! On which side of a line or in which circle a point lies, without rounding error.
//!
//! J. R. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric
//! predicates", Discrete Comput. Geom. 18 (1997), 305-363; through the crate `robust`.

use glam::{DVec2, DVec3};

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
    match robust::orient2d(coord(a), coord(b), coord(c)) {
        area if area > 0.0 => Orientation::Positive,
        area if area < 0.0 => Orientation::Negative,
        _ => Orientation::Zero,
    }
}

/// The exact sign of the volume `a . (b x c)`: positive where the triangle is counter-clockwise seen from outside a
/// sphere around the origin.
pub fn orientation_of_cone([a, b, c]: [DVec3; 3]) -> Orientation {
    let coord = |p: DVec3| robust::Coord3D { x: p.x, y: p.y, z: p.z };
    match robust::orient3d(coord(a), coord(b), coord(c), coord(DVec3::ZERO)) {
        volume if volume > 0.0 => Orientation::Positive,
        volume if volume < 0.0 => Orientation::Negative,
        _ => Orientation::Zero,
    }
}

/// Whether `p` lies strictly inside the circle through the counter-clockwise triangle `a`, `b`, `c`.
pub fn is_in_circle([a, b, c]: [DVec2; 3], p: DVec2) -> bool {
    robust::incircle(coord(a), coord(b), coord(c), coord(p)) > 0.0
}

fn coord(p: DVec2) -> robust::Coord<f64> {
    robust::Coord { x: p.x, y: p.y }
}

/// Where the two products of an area cancel to less than this share, it is computed with twice the digits. Beyond
/// it the relative error is below 4 EPSILON / share.
pub const CANCELLATION: f64 = 1.0 / 64.0;
/// The same, after which only the exact sign is left: twice the digits have a relative error of some EPSILON^2.
const LEAST_SHARE: f64 = 1e-28;

/// Twice the signed area of the triangle `a`, `b`, `c`: with the exact sign, a few last digits wrong at most, and
/// turned over to the last bit when `a` and `b` are exchanged.
#[inline(always)]
pub fn signed_area(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    let (p, q) = (a - c, b - c);
    let (left, right) = (p.x * q.y, p.y * q.x);
    let area = left - right;
    if area.abs() >= CANCELLATION * (left.abs() + right.abs()) { area } else { careful_area(a, b, c) }
}

#[cold]
#[inline(never)]
fn careful_area(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    let [px, py, qx, qy] =
        [difference(a.x, c.x), difference(a.y, c.y), difference(b.x, c.x), difference(b.y, c.y)];
    let (left, right) = (product(px, qy), product(py, qx));
    let (high, low) = difference(left.0, right.0);
    let area = high + (low + (left.1 - right.1));
    if area.abs() >= LEAST_SHARE * (left.0.abs() + right.0.abs()) {
        return area;
    }
    robust::orient2d(coord(a), coord(b), coord(c))
}

/// `a - b` as a rounded number and what rounding lost (T. J. Dekker, "A floating-point technique for extending the
/// available precision", Numer. Math. 18 (1971), 224-242).
fn difference(a: f64, b: f64) -> (f64, f64) {
    let high = a - b;
    let back = high - a;
    (high, (a - (high - back)) - (b + back))
}

/// The product of two such pairs.
fn product(x: (f64, f64), y: (f64, f64)) -> (f64, f64) {
    let high = x.0 * y.0;
    (high, x.0.mul_add(y.0, -high) + (x.0 * y.1 + x.1 * y.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::Random;

    #[test]
    fn nearly_flat_triangles_have_their_area() {
        // c = a + s (b - a) + (0, h): the area is -h (b - a).x, whatever was rounded before
        let mut random = Random::new(7);
        for _ in 0..1000 {
            let mut next = || (random.signed() * 1024.0).round();
            let (a, b) = (DVec2::new(next(), next()), DVec2::new(next(), next()));
            let h = f64::EPSILON * next();
            let c = DVec2::new((a.x + b.x) / 2.0, (a.y + b.y) / 2.0);
            let raised = [a, b].map(|p| p - c);
            // translated so that h is kept: c becomes the origin
            let area = signed_area(raised[0], raised[1], DVec2::new(0.0, h));
            let exact = h * (b.x - a.x); // 11 bits times 11 bits
            assert!((area - exact).abs() <= 4.0 * f64::EPSILON * exact.abs(), "{a} {b} {h}: {area} {exact}");
            assert_eq!(signed_area(raised[1], raised[0], DVec2::new(0.0, h)), -area);
        }
    }

    #[test]
    fn points_on_a_circle_are_not_inside() {
        let corners = [DVec2::ZERO, DVec2::X, DVec2::ONE];
        assert!(!is_in_circle(corners, DVec2::Y));
        assert!(is_in_circle(corners, DVec2::new(f64::EPSILON, 1.0 - f64::EPSILON)));
    }
}
