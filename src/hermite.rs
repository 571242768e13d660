//! Cubic pieces by values and slopes on uniform knots (Ferguson form).
//!
//! J. Dannenhoffer and R. Haimes, "Generation of spline approximations to tessellations" (2009),
//! equations 2 to 6. Slopes `X` are derivatives with respect to the cell fraction `s`.
//! ```text
//! x(s) = A x_i + B x_{i+1} + C X_i + D X_{i+1}
//! A = 1 - 3s^2 + 2s^3   B = 3s^2 - 2s^3   C = s - 2s^2 + s^3   D = -s^2 + s^3
//! ```
//! C2 at inner knots and zero curvature at both ends fix the slopes:
//! ```text
//! X_{i-1} + 4 X_i + X_{i+1} = 3 (x_{i+1} - x_{i-1}),
//! 2 X_1 + X_2 = 3 (x_2 - x_1),   X_{I-1} + 2 X_I = 3 (x_I - x_{I-1})
//! ```

/// `[A, B, C, D]` at the fraction `s` of a cell.
pub fn shape_functions(s: f64) -> [f64; 4] {
    let (s2, s3) = (s * s, s * s * s);
    [1.0 - 3.0 * s2 + 2.0 * s3, 3.0 * s2 - 2.0 * s3, s - 2.0 * s2 + s3, s3 - s2]
}

/// Their derivatives with respect to `s`.
pub fn shape_slopes(s: f64) -> [f64; 4] {
    let s2 = s * s;
    [6.0 * (s2 - s), 6.0 * (s - s2), 1.0 - 4.0 * s + 3.0 * s2, 3.0 * s2 - 2.0 * s]
}

/// The control points of the C2 spline with these values and slopes over the knots `u_1 x4, u_2, ..., u_{I-1}, u_I x4`: two more
/// than values. Right for any C2 data, natural or not.
///
/// `P_0 = x_1, P_1 = x_1 + X_1/3, P_i = 2x_i - x_{i+1} + (2X_i + X_{i+1})/3, P_I = x_I - X_I/3, P_{I+1} = x_I`
pub fn control_points(values: &[f64], slopes: &[f64]) -> Vec<f64> {
    let last = values.len() - 1;
    let inner = (1..last).map(|i| 2.0 * values[i] - values[i + 1] + (2.0 * slopes[i] + slopes[i + 1]) / 3.0);
    let begin = [values[0], values[0] + slopes[0] / 3.0];
    let end = [values[last] - slopes[last] / 3.0, values[last]];
    begin.into_iter().chain(inner).chain(end).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_close(measured: &[f64], exact: &[f64]) {
        assert_eq!(measured.len(), exact.len());
        for (m, e) in measured.iter().zip(exact) {
            // a dozen operations on numbers of size 1
            assert!((m - e).abs() <= 16.0 * f64::EPSILON, "{measured:?} is not {exact:?}");
        }
    }

    #[test]
    fn a_tent_has_the_control_points_worked_out_by_hand() {
        let slopes = [1.5, 0., -1.5];
        assert_close(&control_points(&[0., 1., 0.], &slopes), &[0., 0.5, 1.5, 0.5, 0.]);
        let [a, b, c, d] = shape_functions(0.5);
        assert_close(&[b + c * slopes[0] + d * slopes[1] + a * 0.0], &[11. / 16.]);
    }

    #[test]
    fn a_zigzag_has_the_control_points_worked_out_by_hand() {
        let values = [0., 1., 0., 1.];
        let slopes = [5. / 3., -1. / 3., -1. / 3., 5. / 3.];
        assert_close(&control_points(&values, &slopes), &[0., 5. / 9., 5. / 3., -2. / 3., 4. / 9., 1.]);
    }

    #[test]
    fn two_values_give_a_straight_line() {
        assert_close(&control_points(&[1., 4.], &[3., 3.]), &[1., 2., 3., 4.]);
    }
}
