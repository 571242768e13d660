//! Quadratic forms of a surface's control points: what it costs to move it, and its energy.
//!
//! Over the unit interval Bernstein polynomials of degree p have the products
//! ```text
//! integral B_i B_j = C(p,i) C(p,j) / C(2p,i+j) / (2p+1)
//! ```
//! and derivatives are differences of ordinates, so that all integrals are exact. Lengths are those of the surface: a
//! parameter counts as much as its lines are long on the average, which makes energies independent of how the domain
//! is scaled.

use super::Fairness;
use super::space::{Cell, Space};
use crate::control::Cancelled;
use crate::control::Watch;
use glam::DVec2;
use sprs::CsMat;

/// A matrix of one direction of a cell, by rows.
type Gram = Vec<Vec<f64>>;

/// Integrals over the unit interval of products of derivatives of Bernstein polynomials.
fn gram(degree: usize, order: usize) -> Gram {
    if order > degree {
        return vec![vec![0.0; degree + 1]; degree + 1];
    }
    let p = degree - order;
    // the derivative's ordinates: rows of differences
    let mut rows: Gram =
        (0..=degree).map(|i| (0..=degree).map(|j| f64::from(u8::from(i == j))).collect()).collect();
    for k in 0..order {
        let factor = (degree - k) as f64;
        let difference =
            |pair: &[Vec<f64>]| pair[1].iter().zip(&pair[0]).map(|(b, a)| factor * (b - a)).collect();
        rows = rows.windows(2).map(difference).collect();
    }
    let mass =
        |i: usize, j: usize| binomial(p, i) * binomial(p, j) / binomial(2 * p, i + j) / (2 * p + 1) as f64;
    let entry = |a: usize, b: usize| -> f64 {
        let pairs = (0..=p).flat_map(|i| (0..=p).map(move |j| (i, j)));
        pairs.map(|(i, j)| rows[i][a] * mass(i, j) * rows[j][b]).sum()
    };
    (0..=degree).map(|a| (0..=degree).map(|b| entry(a, b)).collect()).collect()
}

fn binomial(n: usize, k: usize) -> f64 {
    (0..k).map(|i| (n - i) as f64 / (i + 1) as f64).product()
}

/// Weights and orders of derivatives in each direction whose squares make an energy.
fn derivatives(energy: Fairness) -> &'static [(f64, [usize; 2])] {
    match energy {
        Fairness::ThinPlate => &[(1.0, [2, 0]), (2.0, [1, 1]), (1.0, [0, 2])],
        Fairness::CurvatureVariation => &[(1.0, [3, 0]), (3.0, [2, 1]), (3.0, [1, 2]), (1.0, [0, 3])],
    }
}

/// Integrals of products of the derivatives of the functions of one cell.
pub(super) struct CellForms {
    grams: [Vec<Gram>; 2],
}

impl CellForms {
    pub(super) fn new(degree: [usize; 2]) -> Self {
        Self { grams: degree.map(|degree| (0..=3).map(|order| gram(degree, order)).collect()) }
    }

    /// The matrix over the control points of a cell, by rows, of the integral of a sum of squares of derivatives.
    /// `lengths` are those of the domain's units.
    fn over(&self, cell: &Cell, lengths: DVec2, terms: &[(f64, [usize; 2])]) -> Vec<f64> {
        let size = cell.domain.size() * lengths;
        let [u, v] = &self.grams;
        let (rows_u, rows_v) = (u[0].len(), v[0].len());
        let count = rows_u * rows_v;
        let scale = |size: f64, order: usize| size.powi(1 - 2 * order as i32);
        let mut local = vec![0.0; count * count];
        for &(weight, [i, j]) in terms {
            let weight = weight * scale(size.x, i) * scale(size.y, j);
            for (row, values) in local.chunks_exact_mut(count).enumerate() {
                let (a, b) = (row / rows_v, row % rows_v);
                for (column, value) in values.iter_mut().enumerate() {
                    *value += weight * u[i][a][column / rows_v] * v[j][b][column % rows_v];
                }
            }
        }
        congruence(&local, &cell.extraction, count, cell.unknowns.len())
    }

    /// The integral of the square of a displacement.
    pub(super) fn mass(&self, cell: &Cell, lengths: DVec2) -> Vec<f64> {
        self.over(cell, lengths, &[(1.0, [0, 0])])
    }

    pub(super) fn energy(&self, cell: &Cell, lengths: DVec2, energy: Fairness) -> Vec<f64> {
        self.over(cell, lengths, derivatives(energy))
    }

    /// How long the units of the domain are on the surface: roots of the mean squares of its first derivatives.
    pub(super) fn lengths(&self, space: &Space) -> DVec2 {
        let mut sums = [0.0; 3];
        for cell in &space.cells {
            let point = |k: u32| &space.control_points[k as usize * space.dim..][..space.dim];
            let points: Vec<&[f64]> = cell.unknowns.iter().map(|&unknown| point(unknown)).collect();
            for (sum, orders) in sums.iter_mut().zip([[1, 0], [0, 1]]) {
                *sum += form(&self.over(cell, DVec2::ONE, &[(1.0, orders)]), &points);
            }
            sums[2] += cell.domain.size().element_product();
        }
        let length = |sum: f64| {
            let length = (sum / sums[2]).sqrt();
            if length > 0.0 { length } else { 1.0 }
        };
        DVec2::new(length(sums[0]), length(sums[1]))
    }
}

/// The value of a quadratic form at rows of numbers, one for each unknown.
fn form(matrix: &[f64], points: &[&[f64]]) -> f64 {
    let rows = matrix.chunks_exact(points.len()).zip(points);
    let row = |(row, a): (&[f64], &&[f64])| -> f64 {
        row.iter().zip(points).map(|(m, b)| m * a.iter().zip(*b).map(|(x, y)| x * y).sum::<f64>()).sum()
    };
    rows.map(row).sum()
}

/// `E^T M E` for a matrix over ordinates and an extraction operator.
fn congruence(matrix: &[f64], extraction: &[f64], count: usize, width: usize) -> Vec<f64> {
    let mut half = vec![0.0; count * width];
    for (row, half) in matrix.chunks_exact(count).zip(half.chunks_exact_mut(width)) {
        for (m, weights) in row.iter().zip(extraction.chunks_exact(width)) {
            half.iter_mut().zip(weights).for_each(|(sum, x)| *sum += m * x);
        }
    }
    let mut whole = vec![0.0; width * width];
    for (weights, half) in extraction.chunks_exact(width).zip(half.chunks_exact(width)) {
        for (x, row) in weights.iter().zip(whole.chunks_exact_mut(width)).filter(|(x, _)| **x != 0.0) {
            row.iter_mut().zip(half).for_each(|(sum, h)| *sum += x * h);
        }
    }
    whole
}

/// The entries that matrices over the control points have: their lower triangle in columns.
pub(super) struct Pattern {
    starts: Vec<usize>,
    rows: Vec<usize>,
}

impl Pattern {
    pub(super) fn of(space: &Space, watch: &Watch) -> Result<Self, Cancelled> {
        let mut columns: Vec<Vec<u32>> = (0..space.count() as u32).map(|unknown| vec![unknown]).collect();
        for cell in &space.cells {
            for (k, &column) in cell.unknowns.iter().enumerate() {
                columns[column as usize].extend(&cell.unknowns[k..]);
            }
        }
        let (mut starts, mut rows) = (vec![0], Vec::new());
        for (k, mut column) in columns.into_iter().enumerate() {
            if k.is_multiple_of(1024) {
                watch.check()?;
            }
            column.sort_unstable();
            column.dedup();
            rows.extend(column.into_iter().map(|row| row as usize));
            starts.push(rows.len());
        }
        Ok(Self { starts, rows })
    }

    pub(super) fn zeros(&self) -> Vec<f64> {
        vec![0.0; self.rows.len()]
    }

    /// Adds `weight` times a matrix over some unknowns, ascending.
    pub(super) fn add(&self, values: &mut [f64], unknowns: &[u32], matrix: &[f64], weight: f64) {
        for (k, (&column, entries)) in unknowns.iter().zip(matrix.chunks_exact(unknowns.len())).enumerate() {
            let (from, to) = (self.starts[column as usize], self.starts[column as usize + 1]);
            let (rows, mut place) = (&self.rows[from..to], 0);
            for (&row, entry) in unknowns[k..].iter().zip(&entries[k..]) {
                place += rows[place..].partition_point(|&other| other < row as usize);
                values[from + place] += weight * entry;
            }
        }
    }

    /// The same for the square of one weighed sum of unknowns.
    pub(super) fn add_square(&self, values: &mut [f64], unknowns: &[u32], weights: &[f64], weight: f64) {
        for (k, (&column, &a)) in unknowns.iter().zip(weights).enumerate().filter(|(_, (_, a))| **a != 0.0) {
            let (from, to) = (self.starts[column as usize], self.starts[column as usize + 1]);
            let (rows, mut place) = (&self.rows[from..to], 0);
            for (&row, b) in unknowns[k..].iter().zip(&weights[k..]) {
                place += rows[place..].partition_point(|&other| other < row as usize);
                values[from + place] += weight * a * b;
            }
        }
    }

    /// Takes out what is kept: its rows and columns become those of the identity times `scale`.
    pub(super) fn keep(&self, values: &mut [f64], is_kept: &[bool], scale: f64) {
        for column in 0..is_kept.len() {
            for at in self.starts[column]..self.starts[column + 1] {
                if is_kept[column] || is_kept[self.rows[at]] {
                    values[at] = if self.rows[at] == column { scale } else { 0.0 };
                }
            }
        }
    }

    /// The diagonal's sum.
    pub(super) fn trace(&self, values: &[f64]) -> f64 {
        self.starts[..self.starts.len() - 1].iter().map(|&diagonal| values[diagonal]).sum()
    }

    /// The product of the symmetric matrix with rows of `dim` numbers.
    pub(super) fn product(&self, values: &[f64], points: &[f64], dim: usize) -> Vec<f64> {
        let mut product = vec![0.0; points.len()];
        for column in 0..self.starts.len() - 1 {
            for at in self.starts[column]..self.starts[column + 1] {
                let (row, value) = (self.rows[at], values[at]);
                for k in 0..dim {
                    product[row * dim + k] += value * points[column * dim + k];
                    if row != column {
                        product[column * dim + k] += value * points[row * dim + k];
                    }
                }
            }
        }
        product
    }

    pub(super) fn matrix(&self, values: Vec<f64>) -> CsMat<f64> {
        let n = self.starts.len() - 1;
        CsMat::new_csc((n, n), self.starts.clone(), self.rows.clone(), values)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integrals_of_powers_are_exact() {
        // x^k has the ordinates C(i,k)/C(p,k)
        for degree in 1..=6 {
            for k in 0..=degree {
                let power: Vec<f64> = (0..=degree)
                    .map(|i| if i < k { 0.0 } else { binomial(i, k) / binomial(degree, k) })
                    .collect();
                for order in 0..=3 {
                    let gram = gram(degree, order);
                    let found: f64 = (0..=degree)
                        .flat_map(|i| (0..=degree).map(move |j| (i, j)))
                        .map(|(i, j)| power[i] * gram[i][j] * power[j])
                        .sum();
                    let falling: f64 = (0..order).map(|i| k as f64 - i as f64).product();
                    let exact =
                        if k < order { 0.0 } else { falling * falling / (2 * (k - order) + 1) as f64 };
                    // differences of numbers below degree^order
                    let tol = 1e3 * f64::EPSILON * (degree as f64).powi(2 * order as i32);
                    assert!((found - exact).abs() <= tol, "{degree} {k} {order}: {found} {exact}");
                }
            }
        }
    }
}
