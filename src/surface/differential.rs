//! Normals and curvatures from derivatives.

use crate::geometry::safe_scale;
use crate::linalg::Symmetric2;
use glam::{DVec2, DVec3};

/// The unit normal `Su x Sv / |Su x Sv|`; NaN where the tangents are parallel or zero.
pub fn normal(su: DVec3, sv: DVec3) -> DVec3 {
    // tangents of any length
    let [su, sv] = [su, sv].map(|tangent| tangent * safe_scale(tangent.abs().max_element()));
    let n = su.cross(sv);
    let length = n.length();
    // parallel within rounding: the direction of the product is noise
    if length > 16.0 * f64::EPSILON * su.length() * sv.length() { n / length } else { DVec3::NAN }
}

/// The gradient in space of a number with the derivatives `fu`, `fv` on a surface with the tangents `su`, `sv`: the
/// tangent vector that gives the change in each tangent direction; NaN where the tangents are parallel or zero.
///
/// With the metric `E = Su.Su, F = Su.Sv, G = Sv.Sv` (M. do Carmo, "Differential Geometry of Curves and Surfaces",
/// section 2.5)
/// ```text
/// grad f = ((G fu - F fv) Su + (E fv - F fu) Sv) / (E G - F^2)
/// ```
pub fn surface_gradient(su: DVec3, sv: DVec3, fu: f64, fv: f64) -> DVec3 {
    if normal(su, sv).is_nan() {
        return DVec3::NAN;
    }
    // a shape of another size has gradients of the inverse size
    let scale = safe_scale(su.abs().max(sv.abs()).max_element());
    let (su, sv) = (su * scale, sv * scale);
    let sum = Symmetric2::of_products(su, sv).adjugate(DVec2::new(fu, fv));
    // the product of the tangents keeps digits of E G - F^2 that the difference loses
    scale * ((sum.x * su + sum.y * sv) / su.cross(sv).length_squared())
}

/// The principal curvatures and their directions.
#[derive(Debug, Clone, Copy)]
pub struct Curvatures {
    /// The larger curvature, positive where the surface bends towards the normal.
    pub k1: f64,
    /// The smaller curvature.
    pub k2: f64,
    /// Unit tangent in which the curvature is `k1`.
    pub direction1: DVec3,
    /// Unit tangent in which the curvature is `k2`; `direction1 x direction2` is the normal.
    pub direction2: DVec3,
}

/// Principal curvatures of a surface with these derivatives; NaN where it has no normal.
///
/// In an orthonormal tangent frame `e1 = Su/|Su|`, `e2 = n x e1` the second fundamental form is a symmetric
/// matrix whose eigenvalues and eigenvectors are the curvatures and directions (M. do Carmo, "Differential
/// Geometry of Curves and Surfaces", section 3.2), here in closed form: it makes the directions those of the frame at an umbilic, where
/// those of an iteration are chance.
pub fn curvatures([su, sv, suu, suv, svv]: [DVec3; 5]) -> Curvatures {
    let n = normal(su, sv);
    let e1 = su.normalize();
    let e2 = n.cross(e1);
    // d/de2 = (d/dv - (Sv.e1)/|Su| d/du) / (Sv.e2)
    let (length, skew, height) = (su.length(), sv.dot(e1), sv.dot(e2));
    let (l, m, k) = (suu.dot(n), suv.dot(n), svv.dot(n));
    let a = l / (length * length);
    let b = (m / length - skew * a) / height;
    let c = ((k - 2.0 * skew * m / length) + skew * skew * a) / (height * height);
    let (mean, half) = ((a + c) / 2.0, (a - c) / 2.0);
    let radius = half.hypot(b);
    let angle = if radius == 0.0 { 0.0 } else { b.atan2(half) / 2.0 };
    let (sin, cos) = angle.sin_cos();
    Curvatures {
        k1: mean + radius,
        k2: mean - radius,
        direction1: cos * e1 + sin * e2,
        direction2: cos * e2 - sin * e1,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_skewed_paraboloid_has_its_curvatures_whatever_the_parameters() {
        // z = (3 x^2 + y^2) / 2 at the origin with x = 2 u + v, y = v - u
        let su = DVec3::new(2., -1., 0.);
        let sv = DVec3::new(1., 1., 0.);
        let form = |a: DVec3, b: DVec3| DVec3::new(0., 0., 3. * a.x * b.x + a.y * b.y);
        let measured = curvatures([su, sv, form(su, su), form(su, sv), form(sv, sv)]);
        let tol = 32.0 * f64::EPSILON; // some thirty operations on numbers below 14
        assert!((measured.k1 - 3.0).abs() <= 14.0 * tol, "{measured:?}");
        assert!((measured.k2 - 1.0).abs() <= 14.0 * tol, "{measured:?}");
        assert!((measured.direction1.x.abs() - 1.0).abs() <= tol, "{measured:?}");
        assert!((measured.direction2.y.abs() - 1.0).abs() <= tol, "{measured:?}");
        let n = measured.direction1.cross(measured.direction2);
        assert!((n - normal(su, sv)).length() <= tol, "{measured:?}");
    }

    #[test]
    fn parallel_tangents_have_no_normal() {
        assert!(normal(DVec3::X, 3.0 * DVec3::X).is_nan());
        assert!(curvatures([DVec3::X, DVec3::ZERO, DVec3::Y, DVec3::Y, DVec3::Y]).k1.is_nan());
    }
}
