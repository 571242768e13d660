//! Tridiagonal systems, also cyclic ones: elimination without pivoting (L. Thomas 1949).
//!
//! Row `i` reads `lower[i] x_{i-1} + diagonal[i] x_i + upper[i] x_{i+1} = b_i`. A cyclic system has `lower[0]` and
//! `upper[n-1]` too, around the corner; it is cut open by one rank (J. Sherman, W. Morrison 1950). The systems of
//! cubic splines are diagonally dominant in their slopes and totally positive in their control points: neither
//! needs pivots.

use crate::memory;

/// The eliminated matrix.
#[derive(Debug, Clone)]
pub struct Tridiagonal {
    lower: Vec<f64>,
    /// One over the pivots.
    inverse: Vec<f64>,
    /// The superdiagonal, divided by the pivots.
    upper: Vec<f64>,
    corner: Option<Corner>,
}

/// What closes a cyclic system: the open one's answer `response` to the cut, of which the share
/// `(x_0 + ratio x_{n-1}) / denominator` is taken off a solution `x`.
#[derive(Debug, Clone)]
struct Corner {
    response: Vec<f64>,
    ratio: f64,
    denominator: f64,
}

impl Tridiagonal {
    /// Eliminates; `lower[0]` and the last of `upper` are not looked at.
    pub fn new(lower: Vec<f64>, diagonal: &[f64], mut upper: Vec<f64>) -> Self {
        let mut inverse = memory::with_capacity(diagonal.len());
        let mut above = 0.0;
        for i in 0..diagonal.len() {
            let pivot = if i == 0 { diagonal[0] } else { diagonal[i] - lower[i] * above };
            inverse.push(1.0 / pivot);
            upper[i] /= pivot;
            above = upper[i];
        }
        Self { lower, inverse, upper, corner: None }
    }

    /// Eliminates a cyclic system of at least two rows.
    pub fn cyclic(mut lower: Vec<f64>, mut diagonal: Vec<f64>, mut upper: Vec<f64>) -> Self {
        let last = diagonal.len() - 1;
        if last == 1 {
            // both neighbours of a row are the other one
            upper[0] += lower[0];
            lower[1] += upper[1];
            return Self::new(lower, &diagonal, upper);
        }
        let (top_right, bottom_left) = (lower[0], upper[last]);
        // A = open + e e'^T with e = (gamma, 0, .., bottom_left), e' = (1, 0, .., ratio)
        let gamma = -diagonal[0];
        let ratio = top_right / gamma;
        diagonal[0] -= gamma;
        diagonal[last] -= bottom_left * ratio;
        let mut open = Self::new(lower, &diagonal, upper);
        let mut response = memory::filled(0.0, last + 1);
        (response[0], response[last]) = (gamma, bottom_left);
        open.solve(&mut response, 1);
        let denominator = 1.0 + response[0] + ratio * response[last];
        open.corner = Some(Corner { response, ratio, denominator });
        open
    }

    /// Replaces right-hand sides, rows of `width` numbers, by the solutions.
    pub fn solve(&self, rows: &mut [f64], width: usize) {
        let n = self.inverse.len();
        rows[..width].iter_mut().for_each(|x| *x *= self.inverse[0]);
        for i in 1..n {
            let (done, rest) = rows.split_at_mut(i * width);
            let (factor, inverse) = (self.lower[i], self.inverse[i]);
            for (x, above) in rest[..width].iter_mut().zip(&done[(i - 1) * width..]) {
                *x = (*x - factor * above) * inverse;
            }
        }
        for i in (0..n - 1).rev() {
            let (rows, below) = rows.split_at_mut((i + 1) * width);
            let factor = self.upper[i];
            rows[i * width..].iter_mut().zip(&*below).for_each(|(x, below)| *x -= factor * below);
        }
        if let Some(corner) = &self.corner {
            for c in 0..width {
                let share = (rows[c] + corner.ratio * rows[(n - 1) * width + c]) / corner.denominator;
                for (row, response) in rows.chunks_exact_mut(width).zip(&corner.response) {
                    row[c] -= share * response;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::Random;

    #[test]
    fn solutions_have_no_residual() {
        let mut random = Random::new(5);
        for n in [2, 3, 4, 17, 200] {
            let mut numbers = |low: f64| (0..n).map(|_| low + random.unit()).collect::<Vec<f64>>();
            let (lower, diagonal, upper) = (numbers(0.0), numbers(2.5), numbers(0.0));
            let exact = numbers(-0.5);
            for is_cyclic in [false, true] {
                let product = |i: usize| {
                    let before = if i > 0 || is_cyclic { lower[i] * exact[(i + n - 1) % n] } else { 0.0 };
                    let after = if i + 1 < n || is_cyclic { upper[i] * exact[(i + 1) % n] } else { 0.0 };
                    before + diagonal[i] * exact[i] + after
                };
                let mut rows: Vec<f64> = (0..n).flat_map(|i| [product(i), -2.0 * product(i)]).collect();
                let system = match is_cyclic {
                    true => Tridiagonal::cyclic(lower.clone(), diagonal.clone(), upper.clone()),
                    false => Tridiagonal::new(lower.clone(), &diagonal, upper.clone()),
                };
                system.solve(&mut rows, 2);
                for (row, x) in rows.chunks(2).zip(&exact) {
                    // dominance above 0.5: condition below 10; a few roundings a row
                    let tol = 100.0 * f64::EPSILON;
                    assert!((row[0] - x).abs() <= tol && (row[1] + 2.0 * x).abs() <= 2.0 * tol, "{n}");
                }
            }
        }
    }
}
