//! B-spline basis functions and their derivatives.
//!
//! M. Cox 1972, C. de Boor 1972; the derivative scheme after L. Piegl and W. Tiller, "The NURBS Book"
//! (1997), section 2.5.
//! ```text
//! N_{i,0}(u) = 1 on [t_i, t_{i+1}),  N_{i,p} = (u - t_i) / (t_{i+p} - t_i) N_{i,p-1}
//!                                            + (t_{i+p+1} - u) / (t_{i+p+1} - t_{i+1}) N_{i+1,p-1}
//! ```
//! Beyond the domain the polynomials of the end spans are continued.

use crate::knots::{KnotVector, MAX_DEGREE};

/// Room for the `degree + 1` functions of one span.
pub type BasisRow = [f64; MAX_DEGREE + 1];

/// The functions `span - degree ..= span` at `u`, in the first `degree + 1` entries.
pub fn basis_functions(knots: &KnotVector, span: usize, u: f64) -> BasisRow {
    let (t, degree) = (knots.knots(), knots.degree());
    let mut values = [0.0; MAX_DEGREE + 1];
    values[0] = 1.0;
    for p in 1..=degree {
        raise(t, span, u, p, &mut values);
    }
    values
}

/// From the functions of degree `p - 1` on a span to those of degree `p`: one column of the triangle. With
/// another `u` for each `p` the last column weighs the control points of a blossom's value.
pub(crate) fn raise(t: &[f64], span: usize, u: f64, p: usize, values: &mut BasisRow) {
    let mut carried = 0.0;
    for r in 0..p {
        let (left, right) = (t[span + 1 + r - p], t[span + 1 + r]);
        let share = values[r] / (right - left);
        values[r] = carried + (right - u) * share;
        carried = (u - left) * share;
    }
    values[p] = carried;
}

/// The functions and their derivatives up to `order` (at most 3): row `k` has the `k`-th derivatives.
///
/// Derivatives above the degree are zero.
pub fn basis_derivatives(knots: &KnotVector, span: usize, u: f64, order: usize) -> [BasisRow; 4] {
    let (t, degree) = (knots.knots(), knots.degree());
    let mut rows = [[0.0; MAX_DEGREE + 1]; 4];
    let mut values = [0.0; MAX_DEGREE + 1];
    values[0] = 1.0;
    for p in 0..=degree {
        if p > 0 {
            raise(t, span, u, p, &mut values);
        }
        // the functions of degree p are what the derivative of order degree - p is made of
        if degree - p <= order {
            rows[degree - p] = differentiate(t, span, p, degree, values);
        }
    }
    rows
}

/// From the functions of degree `p` on a span to the derivatives of order `degree - p` of those of
/// `degree`: `N'_{i,q} = q (N_{i,q-1} / (t_{i+q} - t_i) - N_{i+1,q-1} / (t_{i+q+1} - t_{i+1}))`.
fn differentiate(t: &[f64], span: usize, p: usize, degree: usize, mut values: BasisRow) -> BasisRow {
    for q in p + 1..=degree {
        let mut carried = 0.0;
        for r in 0..q {
            let share = q as f64 * values[r] / (t[span + 1 + r] - t[span + 1 + r - q]);
            values[r] = carried - share;
            carried = share;
        }
        values[q] = carried;
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ugly(degree: usize) -> KnotVector {
        let breaks = [0.0, 1e-3, 1.0, 1.0, 1.5, 4.0, 4.0 + 1e-6, 9.0];
        KnotVector::clamped(&breaks, degree).unwrap()
    }

    #[test]
    fn functions_are_positive_and_sum_to_one() {
        for degree in 2..=MAX_DEGREE {
            let knots = ugly(degree);
            for u in [0.0, 5e-4, 0.3, 1.0, 4.0 + 5e-7, 6.0, 9.0] {
                let values = basis_functions(&knots, knots.span(u), u);
                let tol = 4.0 * (degree + 1) as f64 * f64::EPSILON; // p + 1 terms, each rounded a few times
                assert!((values.iter().sum::<f64>() - 1.0).abs() <= tol, "u = {u}: {values:?}");
                assert!(values.iter().all(|&n| n >= 0.0), "u = {u}: {values:?}");
            }
        }
    }

    #[test]
    fn derivatives_of_powers_are_those_of_the_polynomial() {
        // Marsden: u^degree has the coefficients prod of the inner knots
        for degree in 2..=MAX_DEGREE {
            let knots = ugly(degree);
            let coefficient = |i: usize| -> f64 { knots.knots()[i + 1..=i + degree].iter().product() };
            for u in [0.3, 1.2, 3.0, 9.0] {
                let span = knots.span(u);
                let rows = basis_derivatives(&knots, span, u, 3);
                assert_eq!(rows[0], basis_functions(&knots, span, u));
                let mut factor = 1.0;
                for (order, row) in rows.iter().enumerate() {
                    let measured: f64 = (0..=degree).map(|r| row[r] * coefficient(span - degree + r)).sum();
                    let exact = if order <= degree { factor * u.powi((degree - order) as i32) } else { 0.0 };
                    factor *= degree as f64 - order as f64;
                    let scale: f64 =
                        (0..=degree).map(|r| (row[r] * coefficient(span - degree + r)).abs()).sum();
                    let tol = 16.0 * (degree * degree) as f64 * f64::EPSILON * (scale + exact.abs());
                    assert!((measured - exact).abs() <= tol, "p {degree} u {u} order {order}");
                }
            }
        }
    }
}
