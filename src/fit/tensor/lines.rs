//! Knot lines of any spacing in one direction, and the cubic B-splines over them.
//!
//! Over breaks `t_0 < .. < t_m`, fourfold at the ends, there are `m + 3` functions, of which cell `k` sees
//! `k ..= k + 3`. Energies are measured as if the whole range had length 1, so that they do not depend on how
//! the parameters are scaled, and do not change when lines are inserted.

use crate::fit::common::uniform::grid::{Banded4, Direction, Window};
use crate::knots::{KnotError, KnotVector};
use crate::surface::cubic::CubicSpan;

/// Knot lines in one direction.
#[derive(Debug, Clone)]
pub(super) struct Lines {
    breaks: Vec<f64>,
    knots: KnotVector,
    cells: Vec<CubicSpan>,
}

impl Lines {
    /// Over increasing breaks.
    pub(super) fn new(breaks: Vec<f64>) -> Result<Self, KnotError> {
        let knots = KnotVector::clamped(&breaks, 3)?;
        let cells = CubicSpan::all(&knots);
        Ok(Self { breaks, knots, cells })
    }

    /// `count` equal cells.
    pub(super) fn uniform(min: f64, max: f64, count: usize) -> Result<Self, KnotError> {
        let inner = (1..count).map(|k| min + (max - min) * (k as f64 / count as f64));
        Self::new([min].into_iter().chain(inner).chain([max]).collect())
    }

    pub(super) fn breaks(&self) -> &[f64] {
        &self.breaks
    }

    pub(super) fn knots(&self) -> &KnotVector {
        &self.knots
    }

    /// The matrix of the integrals of `x^(order) x^(order)` over the whole range, taken as 1.
    pub(super) fn gram(&self, order: usize) -> Banded4 {
        let mut gram = Banded4::zeros(self.len());
        for cell in 0..self.cell_count() {
            let scale = self.length(cell).powi(1 - 2 * order as i32);
            for (window, weight) in self.squares(cell, order) {
                gram.add_square(&window, scale * weight);
            }
        }
        gram
    }
}

impl Direction for Lines {
    fn len(&self) -> usize {
        self.cells.len() + 3
    }

    fn cell_count(&self) -> usize {
        self.cells.len()
    }

    /// The whole range has length 1.
    fn length(&self, cell: usize) -> f64 {
        let range = self.breaks[self.breaks.len() - 1] - self.breaks[0];
        (self.breaks[cell + 1] - self.breaks[cell]) / range
    }

    fn first(&self, cell: usize) -> usize {
        cell
    }

    fn locate(&self, u: f64) -> (usize, f64) {
        let cell = self.knots.rank_at(u);
        (cell, (u - self.cells[cell].start) * self.cells[cell].inverse_length)
    }

    fn window(&self, cell: usize, s: f64, order: usize) -> Window {
        let [c0, c1, c2, c3] = &self.cells[cell].coefficients;
        let weight = |r: usize| match order {
            0 => ((c3[r] * s + c2[r]) * s + c1[r]) * s + c0[r],
            1 => (3.0 * c3[r] * s + 2.0 * c2[r]) * s + c1[r],
            2 => 6.0 * c3[r] * s + 2.0 * c2[r],
            _ => 6.0 * c3[r],
        };
        Window { first: cell, weights: [0, 1, 2, 3].map(weight) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::basis::basis_derivatives;

    fn lines() -> Lines {
        Lines::new(vec![-1.0, -0.5, 0.25, 0.3, 2.0, 4.0]).unwrap()
    }

    #[test]
    fn windows_are_the_basis_functions() {
        let lines = lines();
        for u in (0..=50).map(|k| -1.0 + f64::from(k) / 10.0) {
            let (cell, s) = lines.locate(u);
            let exact = basis_derivatives(lines.knots(), lines.knots().span(u), u, 3);
            for (order, exact) in exact.iter().enumerate() {
                let window = lines.window(cell, s, order);
                let scale = (5.0 * lines.length(cell)).powi(order as i32);
                for r in 0..4 {
                    // a few products of numbers below 200, the third differences over the shortest cell
                    let tol = 1e3 * f64::EPSILON * (1.0 + (exact[r] * scale).abs());
                    assert!((window.weights[r] - exact[r] * scale).abs() <= tol, "{order} {r} at {u}");
                }
            }
        }
    }

    #[test]
    fn the_energy_of_a_parabola_is_exact() {
        // x = u^2 has the blossom (ab + bc + ca)/3 and x'' = 2; the range 5 counts as 1
        let lines = lines();
        let t = lines.knots().knots();
        let x: Vec<f64> = (0..lines.len())
            .map(|i| {
                let [a, b, c] = [t[i + 1], t[i + 2], t[i + 3]];
                (a * b + b * c + c * a) / 3.0
            })
            .collect();
        let gram = lines.gram(2);
        let energy: f64 = (0..x.len())
            .flat_map(|i| (0..x.len()).map(move |j| (i, j)))
            .map(|(i, j)| x[i] * gram.get(i, j) * x[j])
            .sum();
        // sums of terms below 1e6, which cancel
        assert!((energy - 4.0 * 625.0).abs() < 1e6 * 64.0 * f64::EPSILON, "{energy}");
    }
}
