//! Arc length: the integral of `|C'|`, by Gauss rules on intervals that are halved until they agree.
//!
//! P. J. Davis, P. Rabinowitz, "Methods of Numerical Integration" (1984), section 6.2. On an interval the rule of
//! seven points is compared with the sum of the rule on both halves. They differ by about 2^14 times what the
//! halves still miss where `|C'|` is smooth; at a cusp, where it has a kink, each halving leaves a quarter.

use super::{Curve, CurveError};
use crate::memory;

/// Places on [-1, 1], positive ones and the middle, and weights of the Gauss rule of seven points: exact to degree 13.
const GAUSS: [(f64, f64); 4] = [
    (0.0, 0.417_959_183_673_469_4),
    (0.405_845_151_377_397_2, 0.381_830_050_505_118_9),
    (0.741_531_185_599_394_4, 0.279_705_391_489_276_66),
    (0.949_107_912_342_758_5, 0.129_484_966_168_869_7),
];
/// An interval is halved while its rule and that of its halves differ by more than this share of the length of the
/// curve, or than the roundoff of its coordinates: less would be noise, and halved without end.
const TOLERANCE: f64 = 1e-13;
const ROUNDOFF: f64 = 64.0 * f64::EPSILON;
/// Most halvings: an interval is then shorter than the roundoff of its ends.
const MAX_HALVINGS: u32 = 50;

impl Curve {
    /// The length of the whole curve, but for 1e-12 of it and the roundoff of its coordinates.
    pub fn length(&self) -> f64 {
        self.lengths_to_breaks().last().copied().unwrap_or(0.0)
    }

    /// The lengths from the start of the curve to each of `u`, as exact as [`Curve::length`].
    pub fn lengths_to(&self, u: &[f64]) -> Result<Vec<f64>, CurveError> {
        self.check_inside(u)?;
        let breaks = self.knots.breaks();
        let lengths = self.lengths_to_breaks();
        let tolerance = self.length_tolerance(lengths.last().copied().unwrap_or(0.0));
        let to = |&u: &f64| {
            let piece = breaks.partition_point(|&start| start <= u).clamp(1, breaks.len() - 1) - 1;
            lengths[piece] + self.integrate(breaks[piece], u, tolerance)
        };
        Ok(u.iter().map(to).collect())
    }

    /// The lengths from the start of the curve to each of its breaks.
    fn lengths_to_breaks(&self) -> Vec<f64> {
        let breaks = self.knots.breaks();
        let pieces = || breaks.windows(2).map(|ends| (ends[0], ends[1]));
        let tolerance = self.length_tolerance(pieces().map(|(from, to)| self.rule(from, to)).sum());
        let mut length = 0.0;
        let mut lengths = vec![length];
        for (from, to) in pieces() {
            length += self.integrate(from, to, tolerance);
            lengths.push(length);
        }
        lengths
    }

    /// By how much rules may differ on a curve of about this length.
    fn length_tolerance(&self, length: f64) -> f64 {
        let largest = self.control_points.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        TOLERANCE * length + ROUNDOFF * largest
    }

    /// The length over an interval on which the curve is a polynomial.
    fn integrate(&self, from: f64, to: f64, tolerance: f64) -> f64 {
        let mut sum = 0.0;
        let mut open = vec![(from, to, self.rule(from, to), 0)];
        while let Some((from, to, whole, halvings)) = open.pop() {
            let middle = from + 0.5 * (to - from);
            let [left, right] = [self.rule(from, middle), self.rule(middle, to)];
            // false where numbers overflow
            let differ = (left + right - whole).abs() > tolerance;
            if !differ || halvings == MAX_HALVINGS {
                sum += left + right;
            } else {
                open.push((middle, to, right, halvings + 1));
                open.push((from, middle, left, halvings + 1));
            }
        }
        sum
    }

    /// The Gauss rule on an interval.
    fn rule(&self, from: f64, to: f64) -> f64 {
        let (middle, half) = (from + 0.5 * (to - from), 0.5 * (to - from));
        let mut rows = memory::filled(0.0, 2 * self.dim);
        let mut speed = |u: f64| {
            self.eval_rows(&[u], 1, &mut rows);
            rows[self.dim..].iter().fold(0.0_f64, |length, x| length.hypot(*x))
        };
        let mut sum = GAUSS[0].1 * speed(middle);
        for (place, weight) in &GAUSS[1..] {
            sum += weight * (speed(middle - half * place) + speed(middle + half * place));
        }
        half * sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::knots::KnotVector;

    /// A Bezier curve over [0, 1].
    fn bezier(dim: usize, points: &[f64]) -> Curve {
        let knots = KnotVector::clamped(&[0.0, 1.0], points.len() / dim - 1).unwrap();
        Curve::new(dim, knots, points.to_vec()).unwrap()
    }

    #[test]
    fn a_parabola_has_the_length_of_its_formula() {
        // (t, t^2): sqrt(1 + 4 t^2)
        let curve = bezier(2, &[0.0, 0.0, 0.5, 0.0, 1.0, 1.0]);
        let exact = |t: f64| 0.5 * t * (1.0 + 4.0 * t * t).sqrt() + 0.25 * (2.0 * t).asinh();
        let u = [0.0, 0.1, 0.5, 0.999, 1.0];
        for (length, u) in curve.lengths_to(&u).unwrap().iter().zip(u) {
            assert!((length - exact(u)).abs() <= 1e-12 * exact(1.0), "{length} at {u}");
        }
        assert!((curve.length() - exact(1.0)).abs() <= 1e-12 * exact(1.0));
    }

    #[test]
    fn a_cusp_is_met_too() {
        // (s^3, s^2) with s = 3 t - 1, whose length from the cusp to s is ((4 + 9 s^2)^(3/2) - 8) / 27
        let curve = bezier(2, &[-1.0, 1.0, 2.0, -1.0, -4.0, 0.0, 8.0, 4.0]);
        let from_cusp = |s: f64| ((4.0 + 9.0 * s * s).powf(1.5) - 8.0) / 27.0;
        let whole = from_cusp(1.0) + from_cusp(2.0);
        let lengths = curve.lengths_to(&[1.0 / 3.0, 1.0]).unwrap();
        for (length, exact) in lengths.iter().zip([from_cusp(1.0), whole]) {
            assert!((length - exact).abs() <= 1e-12 * whole, "{lengths:?}: not {exact}");
        }
    }

    #[test]
    fn far_from_the_origin_roundoff_ends_the_halving() {
        let far: Vec<f64> = [0.0, 0.0, 0.5, 0.0, 1.0, 1.0].iter().map(|x| x + 1e12).collect();
        let [near, far] = [vec![0.0, 0.0, 0.5, 0.0, 1.0, 1.0], far].map(|points| bezier(2, &points).length());
        // coordinates of 1e12 are rounded to 1e-4
        assert!((near - far).abs() <= 1e-3, "{near} {far}");
    }

    #[test]
    fn lengths_add_up_over_pieces_and_scale_with_the_curve() {
        let knots = KnotVector::clamped(&[0.0, 0.01, 1.0, 1.5, 4.0], 3).unwrap();
        let points: Vec<f64> = (0..3 * knots.basis_count()).map(|k| ((k * k) % 11) as f64).collect();
        let curve = Curve::new(3, knots, points).unwrap();
        let u: Vec<f64> = (0..=400).map(|k| f64::from(k) / 100.0).collect();
        let lengths = curve.lengths_to(&u).unwrap();
        assert!(lengths.is_sorted() && lengths[0] == 0.0);
        assert!((lengths[400] - curve.length()).abs() <= 1e-12 * curve.length());
        // chords are shorter, by a share of h^2
        let chord: f64 = u
            .windows(2)
            .map(|u| {
                let [a, b] = [curve.eval(u[0]), curve.eval(u[1])];
                a.iter().zip(&b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
            })
            .sum();
        assert!(chord <= curve.length() && chord >= 0.99 * curve.length(), "{chord} {}", curve.length());
        let scaled = curve.control_points().iter().map(|x| 1e6 * x).collect();
        let scaled = curve.with_control_points(scaled);
        assert!((scaled.length() / (1e6 * curve.length()) - 1.0).abs() <= 2e-12);
    }

    #[test]
    fn a_point_has_no_length_and_places_outside_are_refused() {
        let point = bezier(1, &[2.0, 2.0, 2.0]);
        // slopes that vanish but for the roundoff of a coordinate of 2
        assert!(point.length() <= 16.0 * f64::EPSILON);
        assert_eq!(point.lengths_to(&[0.5, 2.0]), Err(CurveError::Outside { index: 1, u: 2.0 }));
    }
}
