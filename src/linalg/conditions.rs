//! Linear conditions on the solution of a symmetric positive definite system, by its Schur complement.
//!
//! ```text
//! minimize  x^T A x / 2 - b^T x   subject to   C x = d
//! x = A^-1 (b + C^T l),    (C A^-1 C^T) l = d - C A^-1 b
//! ```
//! The second step is repeated with what rounding left of `d - C x`, so that conditions hold to rounding however
//! ill-conditioned `A` is. A condition that follows from those before it is passed over: it holds, or it cannot hold.

use super::Cholesky;
use std::ops::Range;

/// One condition: a weighed sum of unknowns has a value, in each column of its own.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Condition {
    /// Unknowns and their weights.
    pub terms: Vec<(usize, f64)>,
    /// What the sum is in each column.
    pub values: Vec<f64>,
}

impl Condition {
    /// The weighed sum of a column.
    fn sum(&self, column: &[f64]) -> f64 {
        self.terms.iter().map(|&(unknown, weight)| weight * column[unknown]).sum()
    }
}

/// A condition of which less than this share is its own follows from those before it: with less, solutions swing by more
/// than ten thousand times what conditions ask for.
const LEAST_SHARE: f64 = 1e-8;

/// How often what rounding left is imposed: each time it shrinks by the rounding of a solution.
const REPETITIONS: usize = 3;

/// Conditions on some of the columns.
#[derive(Debug, Clone, PartialEq)]
pub struct Conditions {
    /// The columns.
    pub columns: Range<usize>,
    /// With a value for each of these.
    pub conditions: Vec<Condition>,
}

/// Imposes conditions on the columns that they are for; `n` is the length of a column.
pub fn impose_all(all: &[Conditions], factor: &Cholesky, solutions: &mut [f64], n: usize) {
    for Conditions { columns, conditions } in all {
        impose(conditions, factor, &mut solutions[columns.start * n..columns.end * n], columns.len());
    }
}

/// Moves solutions, columns of unknowns one after the other, to the nearest that fulfil the conditions. `factor` is that
/// of the matrix they solve.
fn impose(conditions: &[Condition], factor: &Cholesky, solutions: &mut [f64], columns: usize) {
    if conditions.is_empty() || columns == 0 {
        return;
    }
    let (n, m) = (solutions.len() / columns, conditions.len());
    let mut responses = vec![0.0; n * m];
    for (response, condition) in responses.chunks_exact_mut(n).zip(conditions) {
        condition.terms.iter().for_each(|&(unknown, weight)| response[unknown] += weight);
    }
    factor.solve(&mut responses, m);
    let complement = Complement::new(conditions, &responses, n);
    for (k, solution) in solutions.chunks_exact_mut(n).enumerate() {
        for _ in 0..REPETITIONS {
            let misses = conditions.iter().map(|condition| condition.values[k] - condition.sum(solution));
            for (share, response) in
                complement.solve(misses.collect()).into_iter().zip(responses.chunks_exact(n))
            {
                if share != 0.0 {
                    solution.iter_mut().zip(response).for_each(|(x, r)| *x += share * r);
                }
            }
        }
    }
}

/// The Cholesky factor of `C A^-1 C^T`, by rows, without the rows of conditions that follow from others.
struct Complement {
    rows: Vec<Vec<f64>>,
    follows: Vec<bool>,
}

impl Complement {
    /// By hand: which pivot vanishes is the answer, and a library's factorization would stop there.
    fn new(conditions: &[Condition], responses: &[f64], n: usize) -> Self {
        let (mut rows, mut follows): (Vec<Vec<f64>>, Vec<bool>) = (Vec::new(), Vec::new());
        for (i, response) in responses.chunks_exact(n).enumerate() {
            let mut row: Vec<f64> =
                conditions[..=i].iter().map(|condition| condition.sum(response)).collect();
            let whole = row[i];
            for j in 0..=i {
                let known: f64 = match rows.get(j) {
                    Some(other) => row[..j].iter().zip(other).map(|(a, b)| a * b).sum(),
                    None => row[..j].iter().map(|a| a * a).sum(),
                };
                row[j] -= known;
                if j < i {
                    row[j] = if follows[j] { 0.0 } else { row[j] / rows[j][j] };
                }
            }
            let is_own = row[i] > LEAST_SHARE * whole;
            row[i] = if is_own { row[i].sqrt() } else { 0.0 };
            follows.push(!is_own);
            rows.push(row);
        }
        Self { rows, follows }
    }

    fn solve(&self, mut right: Vec<f64>) -> Vec<f64> {
        let m = right.len();
        for i in 0..m {
            let known: f64 = self.rows[i][..i].iter().zip(&right).map(|(a, x)| a * x).sum();
            right[i] = if self.follows[i] { 0.0 } else { (right[i] - known) / self.rows[i][i] };
        }
        for i in (0..m).rev() {
            if !self.follows[i] {
                right[i] /= self.rows[i][i];
                let share = right[i];
                let row = &self.rows[i];
                right[..i].iter_mut().zip(row).for_each(|(x, a)| *x -= a * share);
            }
        }
        right
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::SymbolicCholesky;
    use sprs::CsMat;

    /// The lower triangle of a chain of springs of very unlike stiffness, held weakly.
    fn chain(n: usize) -> CsMat<f64> {
        let stiffness = |k: usize| if k.is_multiple_of(3) { 1e-9 } else { 1.0 };
        let starts: Vec<usize> = (0..n).map(|k| 2 * k).chain([2 * n - 1]).collect();
        let rows: Vec<usize> = (0..n).flat_map(|k| [k, k + 1]).take(2 * n - 1).collect();
        let entry =
            |k: usize| [1e-12 + stiffness(k) + if k > 0 { stiffness(k - 1) } else { 0.0 }, -stiffness(k)];
        let values: Vec<f64> = (0..n).flat_map(entry).take(2 * n - 1).collect();
        CsMat::new_csc((n, n), starts, rows, values)
    }

    fn condition(terms: &[(usize, f64)], values: [f64; 2]) -> Condition {
        Condition { terms: terms.to_vec(), values: values.to_vec() }
    }

    #[test]
    fn conditions_hold_to_rounding_and_the_rest_is_least() {
        let n = 60;
        let matrix = chain(n);
        let factor = SymbolicCholesky::new(&matrix.view(), None).factor(&matrix.view()).unwrap();
        let conditions = [
            condition(&[(3, 1.0)], [1.0, -2.0]),
            condition(&[(10, 0.5), (11, 0.5)], [0.25, 0.0]),
            // three times the first
            condition(&[(3, 3.0)], [3.0, -6.0]),
            condition(&[(40, 1.0), (41, -1.0)], [0.125, 1.0]),
        ];
        let right: Vec<f64> = (0..2 * n).map(|k| 1e-3 * (k as f64).sin()).collect();
        let mut solutions = right.clone();
        factor.solve(&mut solutions, 2);
        impose(&conditions, &factor, &mut solutions, 2);
        for (k, x) in solutions.chunks_exact(n).enumerate() {
            let largest = x.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
            for condition in &conditions {
                let miss = condition.sum(x) - condition.values[k];
                assert!(miss.abs() <= 8.0 * f64::EPSILON * largest, "{k}: {miss:e} of {largest}");
            }
            // the gradient vanishes along all that keeps the conditions: here single unknowns
            let stiff = |i: usize, j: usize| matrix.get(i.max(j), i.min(j)).copied().unwrap_or(0.0);
            for i in (0..n).filter(|i| ![3, 10, 11, 40, 41].contains(i)) {
                let reach = i.saturating_sub(1)..(i + 2).min(n);
                let gradient: f64 = reach.map(|j| stiff(i, j) * x[j]).sum::<f64>() - right[k * n + i];
                assert!(gradient.abs() <= 1e-12 * largest, "{k} {i}: {gradient:e} of {largest}");
            }
        }
    }

    #[test]
    fn a_condition_that_contradicts_those_before_it_is_passed_over() {
        let matrix = chain(20);
        let factor = SymbolicCholesky::new(&matrix.view(), None).factor(&matrix.view()).unwrap();
        let conditions = [condition(&[(5, 1.0)], [1.0, 1.0]), condition(&[(5, 1.0)], [2.0, 2.0])];
        let mut solutions = vec![0.0; 40];
        impose(&conditions, &factor, &mut solutions, 2);
        assert!((solutions[5] - 1.0).abs() <= 4.0 * f64::EPSILON, "{}", solutions[5]);
    }
}
