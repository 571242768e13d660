//! Cholesky factors of sparse symmetric positive definite matrices, by faer.

use crate::memory;
use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::perm::PermRef;
use faer::prelude::*;
use faer::sparse::linalg::cholesky::{self, LltRef, SymmetricOrdering};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, Par, Side};
use sprs::CsMatView;
use std::sync::Arc;

/// A matrix is not positive definite, or so nearly singular that rounding decides.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the matrix is not positive definite")]
pub struct NotPositiveDefinite;

/// What the pattern of a matrix says about its factor; shared by all matrices of that pattern.
#[derive(Debug)]
pub struct SymbolicCholesky {
    symbolic: Arc<cholesky::SymbolicCholesky<usize>>,
}

impl SymbolicCholesky {
    /// Analyses the pattern of `lower`: the lower triangle, diagonal included, in columns. Unknowns are
    /// eliminated in `order`, or in one found by approximate minimum degree.
    pub fn new(lower: &CsMatView<f64>, order: Option<&[usize]>) -> Self {
        let n = lower.cols();
        memory::ensure(analysis_size(n, lower.nnz()));
        let inverse = order.map(|order| {
            let mut inverse = memory::filled(0, n);
            order.iter().enumerate().for_each(|(place, &unknown)| inverse[unknown] = place);
            inverse
        });
        let ordering = match (order, &inverse) {
            (Some(order), Some(inverse)) => {
                SymmetricOrdering::Custom(PermRef::new_checked(order, inverse, n))
            }
            _ => SymmetricOrdering::Amd,
        };
        let symbolic = cholesky::factorize_symbolic_cholesky(
            pattern(lower, &lower.proper_indptr()),
            Side::Lower,
            ordering,
            Default::default(),
        )
        // all that faer refuses here is the memory, or numbers too large for it
        .unwrap_or_else(|_| memory::give_up(lower.nnz().saturating_mul(size_of::<usize>())));
        Self { symbolic: Arc::new(symbolic) }
    }

    /// Factors a matrix with the pattern that was analysed.
    pub fn factor(&self, lower: &CsMatView<f64>) -> Result<Cholesky, NotPositiveDefinite> {
        let mut values = memory::filled(0.0, self.symbolic.len_val());
        let starts = lower.proper_indptr();
        let matrix = SparseColMatRef::new(pattern(lower, &starts), lower.data());
        let scratch = self.symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default());
        let mut memory = buffer(scratch);
        self.symbolic
            .factorize_numeric_llt(
                &mut values,
                matrix,
                Side::Lower,
                Default::default(),
                Par::Seq,
                MemStack::new(&mut memory),
                Default::default(),
            )
            .map_err(|_| NotPositiveDefinite)?;
        // a pivot lost in rounding would pass as a huge value
        if values.iter().any(|x| !x.is_finite()) {
            return Err(NotPositiveDefinite);
        }
        Ok(Cholesky { symbolic: Arc::clone(&self.symbolic), values })
    }
}

/// The factor of one matrix.
#[derive(Debug)]
pub struct Cholesky {
    symbolic: Arc<cholesky::SymbolicCholesky<usize>>,
    values: Vec<f64>,
}

/// Memory that solving some number of right-hand sides takes.
pub struct SolveMemory(MemBuffer);

impl Cholesky {
    /// Replaces `count` right-hand sides, one after the other in `columns`, by the solutions.
    pub fn solve(&self, columns: &mut [f64], count: usize) {
        self.solve_in(columns, count, &mut self.memory(count));
    }

    /// The same in memory that is there already.
    pub fn solve_in(&self, columns: &mut [f64], count: usize, memory: &mut SolveMemory) {
        let n = self.symbolic.nrows();
        let factor = LltRef::new(&self.symbolic, &self.values);
        let right = MatMut::from_column_major_slice_mut(columns, n, count);
        factor.solve_in_place_with_conj(Conj::No, right, Par::Seq, MemStack::new(&mut memory.0));
    }

    /// What [`Cholesky::solve_in`] needs for `count` right-hand sides.
    pub fn memory(&self, count: usize) -> SolveMemory {
        SolveMemory(buffer(self.symbolic.solve_in_place_scratch::<f64>(count, Par::Seq)))
    }
}

/// Memory for faer to work in.
pub(super) fn buffer(needed: StackReq) -> MemBuffer {
    MemBuffer::try_new(needed).unwrap_or_else(|_| memory::give_up(needed.unaligned_bytes_required()))
}

/// Bytes that the analysis of a pattern takes: the pattern permuted and transposed, and some numbers for each unknown.
fn analysis_size(unknowns: usize, entries: usize) -> usize {
    let numbers = entries.saturating_mul(2).saturating_add(unknowns.saturating_mul(16));
    numbers.saturating_mul(size_of::<usize>())
}

/// faer's view of the pattern; `starts` are `lower.proper_indptr()`.
fn pattern<'a>(lower: &'a CsMatView<f64>, starts: &'a [usize]) -> SymbolicSparseColMatRef<'a, usize> {
    assert!(lower.is_csc() && lower.rows() == lower.cols(), "a square matrix in columns is needed");
    SymbolicSparseColMatRef::new_checked(lower.rows(), lower.cols(), starts, None, lower.indices())
}

#[cfg(test)]
mod tests {
    use super::*;
    use sprs::CsMat;

    #[test]
    fn a_tridiagonal_system_is_solved_in_any_order() {
        let n = 200;
        let starts: Vec<usize> = (0..n).map(|k| 2 * k).chain([2 * n - 1]).collect();
        let rows: Vec<usize> = (0..n).flat_map(|k| [k, k + 1]).take(2 * n - 1).collect();
        let values: Vec<f64> = (0..n).flat_map(|_| [2.5, -1.0]).take(2 * n - 1).collect();
        let matrix = CsMat::new_csc((n, n), starts, rows, values);
        let reversed: Vec<usize> = (0..n).rev().collect();
        for order in [None, Some(reversed.as_slice())] {
            let symbolic = SymbolicCholesky::new(&matrix.view(), order);
            let factor = symbolic.factor(&matrix.view()).unwrap();
            let exact: Vec<f64> = (0..n).map(|k| (k as f64).sin()).collect();
            let at = |k: usize, d: isize| exact.get(k.wrapping_add_signed(d)).copied().unwrap_or(0.0);
            let mut x: Vec<f64> = (0..n).map(|k| 2.5 * at(k, 0) - at(k, -1) - at(k, 1)).collect();
            factor.solve(&mut x, 1);
            // condition below 10, one rounding a step
            assert!(x.iter().zip(&exact).all(|(x, e)| (x - e).abs() <= 100.0 * f64::EPSILON));
        }
    }

    #[test]
    fn an_indefinite_matrix_is_refused() {
        let matrix = CsMat::new_csc((2, 2), vec![0, 2, 3], vec![0, 1, 1], vec![1.0, 2.0, 1.0]);
        let symbolic = SymbolicCholesky::new(&matrix.view(), None);
        assert_eq!(symbolic.factor(&matrix.view()).unwrap_err(), NotPositiveDefinite);
    }
}
