//! General sparse systems, solved once: LU with partial pivoting, by faer.

use faer::MatMut;
use faer::linalg::solvers::Solve;
use faer::sparse::{SparseColMat, Triplet};

/// A matrix is singular.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the matrix is singular")]
pub struct Singular;

/// Entries `(row, column, value)` of a matrix; those at one place add up.
#[derive(Debug, Clone, Default)]
pub struct Entries {
    triplets: Vec<Triplet<usize, usize, f64>>,
}

impl Entries {
    /// Adds `value` to an entry.
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        self.triplets.push(Triplet::new(row, column, value));
    }

    /// Replaces `count` right-hand sides of length `n`, one after the other in `columns`, by the solutions.
    pub fn solve(&self, n: usize, columns: &mut [f64], count: usize) -> Result<(), Singular> {
        let matrix = SparseColMat::<usize, f64>::try_new_from_triplets(n, n, &self.triplets);
        let factor = matrix.map_err(|_| Singular)?.sp_lu().map_err(|_| Singular)?;
        factor.solve_in_place(MatMut::from_column_major_slice_mut(columns, n, count));
        if columns.iter().all(|x| x.is_finite()) { Ok(()) } else { Err(Singular) }
    }
}
