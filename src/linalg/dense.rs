//! Dense kernels of one front: LU of its leading columns without pivoting.
//!
//! A front of `size` rows has `width` pivots. Its columns are stored as `lower` (size x width, by
//! columns: the pivots' block and L below it) and `upper` (height x width, by columns: U right of
//! the pivots, transposed), height = size - width, so that both are swept along columns.

use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::solve_unit_lower_triangular_in_place;
use faer::prelude::{Reborrow, ReborrowMut};
use faer::{Accum, MatMut, MatRef, Par};
use std::ops::Range;

/// Columns swept one by one before a block product updates the rest: wide enough for the product
/// to run at full speed, narrow enough to stay in the first-level cache with a few hundred rows.
const BLOCK: usize = 16;

/// Below this many multiplications plain loops beat the set-up of a block product.
const SMALL_PRODUCT: usize = 512;

/// Runs the loops in `work` with the vector instructions that the processor has. They neither fuse
/// nor reorder operations, so the bits stay the same on all of them.
#[inline(always)]
pub(super) fn vectorized<R>(work: impl FnOnce() -> R) -> R {
    pulp::Arch::new().dispatch(work)
}

/// Factors the pivots' columns in place; `Err` has the first pivot that is zero or not finite.
pub(super) fn factor_columns(
    lower: &mut [f64],
    upper: &mut [f64],
    size: usize,
    width: usize,
) -> Result<(), usize> {
    let height = size - width;
    for start in (0..width).step_by(BLOCK) {
        let end = (start + BLOCK).min(width);
        vectorized(|| {
            factor_lower_block(lower, size, start..end)?;
            sweep_upper_block(lower, upper, size, height, start..end);
            Ok::<(), usize>(())
        })?;
        if end < width {
            update_later_columns(lower, upper, size, width, start..end);
        }
    }
    Ok(())
}

#[inline(always)]
fn factor_lower_block(lower: &mut [f64], size: usize, block: Range<usize>) -> Result<(), usize> {
    for k in block.clone() {
        let (done, later) = lower.split_at_mut((k + 1) * size);
        let column = &mut done[k * size..];
        let pivot = column[k];
        if pivot == 0.0 || !pivot.is_finite() {
            return Err(k);
        }
        let inverse = 1.0 / pivot;
        column[k + 1..].iter_mut().for_each(|x| *x *= inverse);
        for target in later[..(block.end - k - 1) * size].chunks_exact_mut(size) {
            let factor = target[k];
            subtract_scaled(&mut target[k + 1..], &column[k + 1..], factor);
        }
    }
    Ok(())
}

/// Eliminates the block's rows from U right of the pivots.
#[inline(always)]
fn sweep_upper_block(lower: &[f64], upper: &mut [f64], size: usize, height: usize, block: Range<usize>) {
    for k in block.clone() {
        let (done, later) = upper.split_at_mut((k + 1) * height);
        let column = &done[k * height..];
        for (c, target) in (k + 1..block.end).zip(later.chunks_exact_mut(height.max(1))) {
            subtract_scaled(target, column, lower[k * size + c]);
        }
    }
}

/// Block product of a finished block into the pivots' columns after it.
fn update_later_columns(
    lower: &mut [f64],
    upper: &mut [f64],
    size: usize,
    width: usize,
    block: Range<usize>,
) {
    let (height, rest) = (size - width, width - block.end);
    let (done, later) = lower.split_at_mut(block.end * size);
    let done = MatRef::from_column_major_slice(&done[block.start * size..], size, block.len());
    let later = MatMut::from_column_major_slice_mut(later, size, rest);
    let (above, below) = later.split_at_row_mut(block.end);
    let mut right = above.subrows_mut(block.start, block.len());
    let diagonal = done.subrows(block.start, block.len());
    solve_unit_lower_triangular_in_place(diagonal, right.rb_mut(), Par::Seq);
    let left = done.subrows(block.end, size - block.end);
    matmul(below, Accum::Add, left, right.rb(), -1.0, Par::Seq);

    let (done, later) = upper.split_at_mut(block.end * height);
    let done = MatRef::from_column_major_slice(&done[block.start * height..], height, block.len());
    let later = MatMut::from_column_major_slice_mut(later, height, rest);
    matmul(later, Accum::Add, done, left.subrows(0, rest).transpose(), -1.0, Par::Seq);
}

/// Subtracts L below the pivots times U right of them from the update matrix (height x height).
pub(super) fn subtract_product(update: &mut [f64], lower: &[f64], upper: &[f64], size: usize, width: usize) {
    let height = size - width;
    if height * height * width <= SMALL_PRODUCT {
        return vectorized(|| {
            for k in 0..width {
                let left = &lower[k * size + width..(k + 1) * size];
                let right = &upper[k * height..(k + 1) * height];
                for (column, &factor) in update.chunks_exact_mut(height.max(1)).zip(right) {
                    subtract_scaled(column, left, factor);
                }
            }
        });
    }
    let left = MatRef::from_column_major_slice(lower, size, width).subrows(width, height);
    let right = MatRef::from_column_major_slice(upper, height, width).transpose();
    let update = MatMut::from_column_major_slice_mut(update, height, height);
    matmul(update, Accum::Add, left, right, -1.0, Par::Seq);
}

/// y -= factor * x.
#[inline(always)]
fn subtract_scaled(y: &mut [f64], x: &[f64], factor: f64) {
    y.iter_mut().zip(x).for_each(|(y, x)| *y -= factor * x);
}
