//! Uniform knots in one direction, and the cubic basis over them in terms of the unknowns of a fit.
//!
//! With knots 0 .. I-1 (counted in cells) the uniform cubic B-splines centred at the knots and one beyond
//! each end have the coefficients `c_0 ..= c_{I+1}`; cell `k` sees `c_k ..= c_{k+3}` with the weights
//! ```text
//! (1-s)^3/6, (3s^3-6s^2+4)/6, (-3s^3+3s^2+3s+1)/6, s^3/6
//! ```
//! Natural ends (zero curvature) eliminate the outer two: `c_0 = 2c_1 - c_2`, `c_{I+1} = 2c_I - c_{I-1}`.

use crate::knots::{KnotError, KnotVector};
use crate::memory::{self, CollectVec};

/// What happens at the ends of the knots.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Ends {
    /// Zero curvature across the ends, as in the paper.
    #[default]
    Natural,
    /// Two more unknowns a direction; the smoothing energy determines what the data do not.
    Free,
}

/// Uniform knots `start + k * step`, `k = 0 .. count`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UniformGrid {
    pub start: f64,
    pub step: f64,
    /// Number of knots, at least 2.
    pub count: usize,
}

impl UniformGrid {
    /// `count` knots over the range of the data, widened by `buffer` times its length at both ends.
    pub fn over(min: f64, max: f64, buffer: f64, count: usize) -> Self {
        let margin = buffer * (max - min);
        let length = (max - min) + 2.0 * margin;
        Self { start: min - margin, step: length / (count - 1) as f64, count }
    }

    /// The knots with their ends fourfold.
    pub fn knot_vector(&self) -> Result<KnotVector, KnotError> {
        let breaks: Vec<f64> = (0..self.count).map(|k| self.knot(k)).collect_vec();
        KnotVector::clamped(&breaks, 3)
    }

    pub fn knot(&self, k: usize) -> f64 {
        self.start + k as f64 * self.step
    }

    /// The cell that holds `u` and the fraction of it; beyond the ends the fraction leaves [0, 1].
    pub fn locate(&self, u: f64) -> (usize, f64) {
        let t = (u - self.start) / self.step;
        let cell = (t.max(0.0) as usize).min(self.count - 2);
        (cell, t - cell as f64)
    }

    /// Twice as many cells over the same range.
    pub fn halved(&self) -> Self {
        Self { step: self.step / 2.0, count: 2 * self.count - 1, ..*self }
    }
}

/// Weights of up to four consecutive unknowns.
#[derive(Debug, Clone, Copy)]
pub struct Window {
    /// The first unknown.
    pub first: usize,
    /// Weights of `first ..`; those beyond [`UniformBasis::width`] are zero.
    pub weights: [f64; 4],
}

/// The cubic basis in one direction in terms of the unknowns: what equations are made of.
pub(crate) trait Direction: Sync {
    /// Number of unknowns.
    fn len(&self) -> usize;

    /// Number of cells.
    fn cell_count(&self) -> usize;

    /// Unknowns that a window holds: four, or all when there are fewer.
    fn width(&self) -> usize {
        self.len().min(4)
    }

    /// The length of a cell in the units that energies are measured in.
    fn length(&self, cell: usize) -> f64;

    /// First unknown of a cell's window.
    fn first(&self, cell: usize) -> usize;

    /// The cell that holds `u` and the fraction of it; beyond the ends the fraction leaves [0, 1].
    fn locate(&self, u: f64) -> (usize, f64);

    /// The derivative of order `order` with respect to the fraction `s` of a cell.
    fn window(&self, cell: usize, s: f64, order: usize) -> Window;

    /// The squares of these windows, weighed, sum up to the integral of `x^(order) x^(order) ds` over a cell.
    fn squares(&self, cell: usize, order: usize) -> [(Window, f64); 4] {
        self.squares_in(&Part { cell, from: 0.0, to: 1.0 }, order)
    }

    /// The same over a part of one.
    fn squares_in(&self, part: &Part, order: usize) -> [(Window, f64); 4] {
        let length = part.to - part.from;
        GAUSS.map(|(s, weight)| (self.window(part.cell, part.from + length * s, order), length * weight))
    }
}

/// A part of a cell: the fractions of it where it begins and ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Part {
    pub cell: usize,
    pub from: f64,
    pub to: f64,
}

/// Four Gauss points on [0, 1] and their weights: they integrate degree 7, the square of a cubic has 6.
const GAUSS: [(f64, f64); 4] = {
    const INNER: (f64, f64) = (0.339_981_043_584_856_26, 0.652_145_154_862_546_2);
    const OUTER: (f64, f64) = (0.861_136_311_594_052_6, 0.347_854_845_137_453_85);
    [
        (0.5 - 0.5 * OUTER.0, 0.5 * OUTER.1),
        (0.5 + 0.5 * OUTER.0, 0.5 * OUTER.1),
        (0.5 - 0.5 * INNER.0, 0.5 * INNER.1),
        (0.5 + 0.5 * INNER.0, 0.5 * INNER.1),
    ]
};

/// The cubic basis over a grid in terms of the unknowns.
#[derive(Debug, Clone, Copy)]
pub struct UniformBasis {
    pub grid: UniformGrid,
    pub ends: Ends,
}

impl Direction for UniformBasis {
    fn len(&self) -> usize {
        match self.ends {
            Ends::Natural => self.grid.count,
            Ends::Free => self.grid.count + 2,
        }
    }

    fn cell_count(&self) -> usize {
        self.grid.count - 1
    }

    fn length(&self, _: usize) -> f64 {
        1.0
    }

    fn first(&self, cell: usize) -> usize {
        match self.ends {
            Ends::Natural => cell.saturating_sub(1).min(self.len() - self.width()),
            Ends::Free => cell,
        }
    }

    fn locate(&self, u: f64) -> (usize, f64) {
        self.grid.locate(u)
    }

    fn window(&self, cell: usize, s: f64, order: usize) -> Window {
        let weights = uniform_weights(s, order);
        match self.ends {
            Ends::Free => Window { first: cell, weights },
            Ends::Natural => self.eliminate(cell, weights),
        }
    }
}

impl UniformBasis {
    /// Weights of `c_k ..= c_{k+3}` in terms of the unknowns `c_1 ..= c_I`, which are counted from 0.
    fn eliminate(&self, cell: usize, weights: [f64; 4]) -> Window {
        let last = self.grid.count;
        let first = self.first(cell);
        let mut window = Window { first, weights: [0.0; 4] };
        let mut add = |c: usize, weight: f64| window.weights[c - 1 - first] += weight;
        for (c, weight) in (cell..).zip(weights) {
            if c == 0 {
                add(1, 2.0 * weight);
                add(2, -weight);
            } else if c == last + 1 {
                add(last, 2.0 * weight);
                add(last - 1, -weight);
            } else {
                add(c, weight);
            }
        }
        window
    }

    /// The control points over [`UniformGrid::knot_vector`] that unknowns stand for: `count + 2` rows.
    ///
    /// Inside, the coefficient is the control point; at the ends the blossom at three or two equal knots
    /// is `(c_0 + 4c_1 + c_2)/6` and `(2c_1 + c_2)/3`.
    pub fn control_points(&self, unknowns: &[f64], row: usize) -> Vec<f64> {
        let mut points = memory::filled(0.0, (self.grid.count + 2) * row);
        self.write_control_points(unknowns, row, &mut points);
        points
    }

    /// The same into memory that is there already.
    pub fn write_control_points(&self, unknowns: &[f64], row: usize, points: &mut [f64]) {
        let last = self.grid.count + 1;
        match self.ends {
            Ends::Free => points.copy_from_slice(unknowns),
            Ends::Natural => points[row..last * row].copy_from_slice(unknowns),
        }
        for k in 0..row {
            let at = |i: usize| i * row + k;
            let mut begin = [0, 1, 2].map(|i| points[at(i)]);
            let mut end = [0, 1, 2].map(|i| points[at(last - i)]);
            if self.ends == Ends::Natural {
                begin[0] = 2.0 * begin[1] - begin[2];
                end[0] = 2.0 * end[1] - end[2];
            }
            for (outer, inner, c) in [(0, 1, begin), (last, last - 1, end)] {
                points[at(outer)] = (c[0] + 4.0 * c[1] + c[2]) / 6.0;
                points[at(inner)] = (2.0 * c[1] + c[2]) / 3.0;
            }
        }
    }

    /// The matrix `integral of x^(order) x^(order) ds` over the cells, in cell units.
    pub fn gram(&self, order: usize) -> Banded4 {
        let mut gram = Banded4::zeros(self.len());
        for (window, weight) in (0..self.cell_count()).flat_map(|cell| self.squares(cell, order)) {
            gram.add_square(&window, weight);
        }
        gram
    }

    /// The matrix `sum of x(knot)^2` over the knots.
    pub fn knot_sum(&self) -> Banded4 {
        let mut sum = Banded4::zeros(self.len());
        for knot in 0..self.grid.count {
            let cell = knot.min(self.grid.count - 2);
            sum.add_square(&self.window(cell, (knot - cell) as f64, 0), 1.0);
        }
        sum
    }
}

fn uniform_weights(s: f64, order: usize) -> [f64; 4] {
    let r = 1.0 - s;
    match order {
        0 => {
            let (s2, s3) = (s * s, s * s * s);
            let inner = (3.0 * s3 - 6.0 * s2 + 4.0) / 6.0;
            [r * r * r / 6.0, inner, (-3.0 * s3 + 3.0 * s2 + 3.0 * s + 1.0) / 6.0, s3 / 6.0]
        }
        1 => {
            let inner = (3.0 * s * s - 4.0 * s) / 2.0;
            [-r * r / 2.0, inner, (-3.0 * s * s + 2.0 * s + 1.0) / 2.0, s * s / 2.0]
        }
        2 => [r, 3.0 * s - 2.0, 1.0 - 3.0 * s, s],
        _ => unreachable!("energies take two derivatives at most"),
    }
}

/// A symmetric matrix of half band 3: `rows[i][d]` is entry `(i, i + d)`.
#[derive(Debug, Clone)]
pub struct Banded4 {
    pub rows: Vec<[f64; 4]>,
}

impl Banded4 {
    pub fn zeros(n: usize) -> Self {
        Self { rows: memory::filled([0.0; 4], n) }
    }

    pub fn add_square(&mut self, window: &Window, weight: f64) {
        let width = self.rows.len().min(4);
        for a in 0..width {
            for b in a..width {
                self.rows[window.first + a][b - a] += weight * window.weights[a] * window.weights[b];
            }
        }
    }

    /// Entry `(i, j)`, zero outside the band.
    pub fn get(&self, i: usize, j: usize) -> f64 {
        self.rows[i.min(j)].get(i.abs_diff(j)).copied().unwrap_or(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOTH: [Ends; 2] = [Ends::Natural, Ends::Free];

    fn basis(count: usize, ends: Ends) -> UniformBasis {
        UniformBasis { grid: UniformGrid { start: 0.0, step: 1.0, count }, ends }
    }

    #[test]
    fn the_bending_energy_of_three_knots_is_the_one_worked_out_by_hand() {
        let gram = basis(3, Ends::Natural).gram(2);
        let second = [1.0, -2.0, 1.0];
        for i in 0..3 {
            for j in 0..3 {
                let exact = 2.0 / 3.0 * second[i] * second[j];
                assert!((gram.get(i, j) - exact).abs() <= 32.0 * f64::EPSILON, "{i} {j}: {gram:?}");
            }
        }
    }

    #[test]
    fn straight_lines_are_reproduced_and_bend_nothing() {
        for ends in BOTH {
            for count in 2..9 {
                let basis = basis(count, ends);
                let shift = if ends == Ends::Free { -1.0 } else { 0.0 };
                let unknowns: Vec<f64> = (0..basis.len()).map(|i| i as f64 + shift).collect();
                for u in [-0.5, 0.0, 0.3, count as f64 - 1.0, count as f64] {
                    let (cell, s) = basis.grid.locate(u);
                    let window = basis.window(cell, s, 0);
                    let value: f64 =
                        (0..basis.width()).map(|k| window.weights[k] * unknowns[window.first + k]).sum();
                    assert!((value - u).abs() <= 64.0 * f64::EPSILON * count as f64, "{value} at {u}");
                }
                let gram = basis.gram(2);
                let energy: f64 = (0..basis.len())
                    .flat_map(|i| (0..basis.len()).map(move |j| (i, j)))
                    .map(|(i, j)| unknowns[i] * gram.get(i, j) * unknowns[j])
                    .sum();
                assert!(energy.abs() <= 1e3 * f64::EPSILON * (count * count) as f64, "{energy}");
            }
        }
    }

    #[test]
    fn control_points_are_the_same_curve() {
        for ends in BOTH {
            for count in 2..8 {
                let basis = basis(count, ends);
                let unknowns: Vec<f64> = (0..basis.len()).map(|i| ((i * 7) % 5) as f64).collect();
                let knots = basis.grid.knot_vector().unwrap();
                let points = basis.control_points(&unknowns, 1);
                for u in (0..=40).map(|k| f64::from(k) / 40.0 * (count - 1) as f64) {
                    let (cell, s) = basis.grid.locate(u);
                    let window = basis.window(cell, s, 0);
                    let exact: f64 =
                        (0..basis.width()).map(|k| window.weights[k] * unknowns[window.first + k]).sum();
                    let span = knots.span(u);
                    let values = crate::basis::basis_functions(&knots, span, u);
                    let measured: f64 = (0..4).map(|k| values[k] * points[span - 3 + k]).sum();
                    assert!((measured - exact).abs() <= 64.0 * f64::EPSILON, "{ends:?} {count} {u}");
                }
            }
        }
    }
}
