//! Small dense algebra: two equations in two unknowns, and principal axes.
//!
//! Larger systems are nalgebra's. Two equations are solved by hand, by Cramer's rule: they stand in the innermost loops of
//! projection and parameter correction, and whoever solves them asks first how near to singular they are, of which
//! nalgebra's factorizations tell nothing.

use glam::{DMat3, DVec2, DVec3};
use nalgebra::Matrix3;
use std::ops::Add;

/// A symmetric matrix of two rows: `uu uv` over `uv vv`.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Symmetric2 {
    pub uu: f64,
    pub uv: f64,
    pub vv: f64,
}

impl Symmetric2 {
    /// The products of two vectors with each other: their normal equations.
    pub(crate) fn of_products(u: DVec3, v: DVec3) -> Self {
        Self { uu: u.length_squared(), uv: u.dot(v), vv: v.length_squared() }
    }

    /// With a number added on the diagonal.
    #[inline(always)]
    pub(crate) fn shifted(self, added: f64) -> Self {
        Self { uu: self.uu + added, vv: self.vv + added, ..self }
    }

    #[inline(always)]
    pub(crate) fn determinant(self) -> f64 {
        self.uu * self.vv - self.uv * self.uv
    }

    #[inline(always)]
    pub(crate) fn trace(self) -> f64 {
        self.uu + self.vv
    }

    pub(crate) fn least_eigenvalue(self) -> f64 {
        0.5 * (self.trace() - (self.uu - self.vv).hypot(2.0 * self.uv))
    }

    /// Whether both eigenvalues are above zero.
    #[inline(always)]
    pub(crate) fn is_positive(self) -> bool {
        self.uu > 0.0 && self.vv > 0.0 && self.uu * self.vv > self.uv * self.uv
    }

    /// Whether the determinant is no more than a share of the product of the diagonal, the squared sine of the angle between
    /// two vectors of which these are the products.
    #[inline(always)]
    pub(crate) fn is_within(self, share: f64) -> bool {
        !(self.determinant() > share * self.uu * self.vv)
    }

    /// The solution of `self x = right` times the determinant.
    #[inline(always)]
    pub(crate) fn adjugate(self, right: DVec2) -> DVec2 {
        DVec2::new(self.vv * right.x - self.uv * right.y, self.uu * right.y - self.uv * right.x)
    }

    /// The solution of `self x = right`.
    #[inline(always)]
    pub(crate) fn solve(self, right: DVec2) -> DVec2 {
        self.adjugate(right) / self.determinant()
    }
}

impl Add for Symmetric2 {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { uu: self.uu + other.uu, uv: self.uv + other.uv, vv: self.vv + other.vv }
    }
}

/// What `at` has of two vectors in the plane.
pub(crate) fn shares(at: DVec2, first: DVec2, second: DVec2) -> DVec2 {
    DVec2::new(at.perp_dot(second), first.perp_dot(at)) / first.perp_dot(second)
}

/// The axes along which vectors spread, square to each other and of length 1, the one of the least spread first; not finite if
/// the vectors are not.
pub(crate) fn principal_axes(vectors: impl Iterator<Item = DVec3>) -> [DVec3; 3] {
    let sum = vectors.fold(DMat3::ZERO, |sum, v| sum + DMat3::from_cols(v.x * v, v.y * v, v.z * v));
    let eigen = Matrix3::from_column_slice(&sum.to_cols_array()).symmetric_eigen();
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| eigen.eigenvalues[i].total_cmp(&eigen.eigenvalues[j]));
    order.map(|k| DVec3::from_slice(eigen.eigenvectors.column(k).as_slice()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::Random;

    #[test]
    fn two_equations_hold_for_their_solution() {
        let mut random = Random::new(3);
        for _ in 0..100 {
            let mut vector = || DVec3::new(random.signed(), random.signed(), random.signed());
            let (u, v, right) = (vector(), vector(), vector().truncate());
            let matrix = Symmetric2::of_products(u, v);
            let x = matrix.solve(right);
            let left = DVec2::new(matrix.uu * x.x + matrix.uv * x.y, matrix.uv * x.x + matrix.vv * x.y);
            // a few roundings of the largest products, before the division by the determinant
            let size = matrix.trace() * x.abs().max_element();
            let tol = 16.0 * f64::EPSILON * size * (matrix.uu * matrix.vv / matrix.determinant()).max(1.0);
            assert!(left.distance(right) <= tol, "{matrix:?} {right}: {left}");
            assert!(matrix.is_positive());
            let least = matrix.least_eigenvalue();
            let residual = matrix.shifted(-least).determinant();
            assert!(residual.abs() <= 16.0 * f64::EPSILON * matrix.trace().powi(2), "{matrix:?}: {least}");
            let sine_sq = u.cross(v).length_squared() / (matrix.uu * matrix.vv);
            assert!(matrix.is_within(1.1 * sine_sq) && !matrix.is_within(0.9 * sine_sq));
        }
        assert!(Symmetric2::of_products(DVec3::X, 3.0 * DVec3::X).is_within(0.0));
    }

    #[test]
    fn vectors_are_made_of_their_shares() {
        let (first, second) = (DVec2::new(3.0, 1.0), DVec2::new(-1.0, 2.0));
        assert_eq!(shares(2.0 * first - 0.5 * second, first, second), DVec2::new(2.0, -0.5));
    }

    #[test]
    fn the_principal_axes_of_an_ellipsoid_are_its_axes() {
        let turn = glam::DQuat::from_euler(glam::EulerRot::XYZ, 0.3, 0.7, -0.4);
        let ends = [3.0 * DVec3::X, DVec3::Y, 2.0 * DVec3::Z].map(|end| turn * end);
        let [least, middle, most] = principal_axes(ends.into_iter());
        for (axis, end) in [(least, ends[1]), (middle, ends[2]), (most, ends[0])] {
            // an eigenvector is off by the roundings of the largest square by the least gap of squares, 3
            assert!(axis.cross(end.normalize()).length() <= 32.0 * 9.0 / 3.0 * f64::EPSILON, "{axis} {end}");
        }
    }
}
