//! Sums of squared distances to planes.
//!
//! M. Garland, P. Heckbert, "Surface simplification using quadric error metrics", SIGGRAPH 1997, 209-216.
//! ```text
//! Q(x) = sum_k w_k (n_k . x + d_k)^2 = x^T A x + 2 b . x + c
//! A = sum w n n^T,    b = sum w d n,    c = sum w d^2
//! ```

use glam::{DMat3, DVec3};
use std::ops::Add;

/// The weighted squared distance to some planes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Quadric {
    square: DMat3,
    linear: DVec3,
    constant: f64,
}

impl Quadric {
    /// No plane.
    pub(crate) const ZERO: Self = Self { square: DMat3::ZERO, linear: DVec3::ZERO, constant: 0.0 };

    /// The plane through `point` across the unit vector `normal`.
    pub(crate) fn plane(point: DVec3, normal: DVec3, weight: f64) -> Self {
        let offset = -normal.dot(point);
        let weighted = weight * normal;
        let square = DMat3::from_cols(weighted * normal.x, weighted * normal.y, weighted * normal.z);
        Self { square, linear: offset * weighted, constant: weight * offset * offset }
    }

    /// The sum at a point; rounding may leave it slightly below zero.
    pub(crate) fn at(&self, x: DVec3) -> f64 {
        x.dot(self.square * x) + 2.0 * self.linear.dot(x) + self.constant
    }
}

impl Add for Quadric {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            square: self.square + other.square,
            linear: self.linear + other.linear,
            constant: self.constant + other.constant,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::Random;

    #[test]
    fn the_sum_is_that_of_squared_distances() {
        let mut random = Random::new(1);
        let mut vector = || DVec3::new(random.signed(), random.signed(), random.signed());
        let planes: Vec<_> = (0..20).map(|k| (vector(), vector().normalize(), f64::from(k))).collect();
        let sum = planes.iter().map(|&(p, n, w)| Quadric::plane(p, n, w)).fold(Quadric::ZERO, Add::add);
        for _ in 0..50 {
            let x = vector();
            let exact: f64 = planes.iter().map(|&(p, n, w)| w * n.dot(x - p).powi(2)).sum();
            // twenty planes of weights that sum to 190, terms up to 12 in size, a few roundings each
            assert!((sum.at(x) - exact).abs() <= 190.0 * 12.0 * 8.0 * f64::EPSILON, "{x}: {exact}");
        }
    }
}
