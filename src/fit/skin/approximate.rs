//! Fewer knots along v than rows.
//!
//! The control curves minimize `sum_l |sum_j N_j(v_l) Q_j - R_l|^2` with the first and the last row held; they are
//! sums of sections as before, `C = (B^T B)^-1 B^T`. Knots are inserted at the parameters of rows, one at a time
//! where the exact surface of this kind misses the data most, until it is within half of the tolerance; the other
//! half is left for the knots along u.

use super::SkinError;
use super::loft::{Combination, Loft, overshoot};
use super::sections::Sources;
use crate::basis::basis_functions;
use crate::control::Watch;
use crate::knots::KnotVector;
use crate::linalg::SymbolicCholesky;
use crate::memory::{self, CollectVec, ParallelCollectVec};
use rayon::prelude::*;
use sprs::CsMat;

/// The share of the tolerance that fewer knots along v may use up.
const V_SHARE: f64 = 0.5;

/// Weights below this share of the largest are rounding.
const LEAST_WEIGHT: f64 = 1e-16;

/// The loft with the fewest knots found and the error it leaves at the data; None if it would need a knot for nearly
/// every row, where interpolation is as good.
pub(super) fn loft(
    parameters: &[f64],
    sources: &Sources,
    tolerance: f64,
    watch: &Watch,
) -> Result<Option<(Loft, f64)>, SkinError> {
    let n = parameters.len() - 1;
    let mut inner: Vec<usize> = Vec::new(); // rows whose parameters are knots
    while inner.len() + 4 < n + 1 {
        watch.check()?;
        let Some(loft) = least_squares(parameters, &inner)? else { return Ok(None) };
        let errors = row_errors(&loft, sources);
        let worst = errors.iter().copied().fold(0.0, f64::max);
        if worst < V_SHARE * tolerance {
            return Ok(Some((loft, worst)));
        }
        let Some(row) = next_knot(&errors, &inner) else { return Ok(None) };
        memory::push(&mut inner, row);
        inner.sort_unstable();
    }
    Ok(None)
}

/// The row of the largest error that is no knot and has no knot beside it: two rows between knots keep the least
/// squares determined.
fn next_knot(errors: &[f64], inner: &[usize]) -> Option<usize> {
    let last = errors.len() - 1;
    let is_free =
        |&row: &usize| row >= 2 && row + 2 <= last && inner.iter().all(|&knot| knot.abs_diff(row) >= 2);
    let mut free: Vec<usize> = (1..last).filter(is_free).collect_vec();
    // a row beside a knot counts for the free one next to it
    let near = |row: usize| errors[row - 1].max(errors[row]).max(errors[row + 1]);
    free.sort_by(|&a, &b| near(b).total_cmp(&near(a)).then(errors[b].total_cmp(&errors[a])));
    free.first().copied()
}

/// Least squares over given knots; None where the rows do not determine it.
fn least_squares(parameters: &[f64], inner: &[usize]) -> Result<Option<Loft>, SkinError> {
    let n = parameters.len() - 1;
    let breaks: Vec<f64> = [0].iter().chain(inner).chain([&n]).map(|&row| parameters[row]).collect_vec();
    let knots_v = KnotVector::clamped(&breaks, 3)?;
    let count = knots_v.basis_count();
    let rows: Vec<(usize, [f64; 4])> = parameters
        .iter()
        .map(|&v| {
            let span = knots_v.span(v);
            let basis = basis_functions(&knots_v, span, v);
            (span - 3, [basis[0], basis[1], basis[2], basis[3]])
        })
        .collect_vec();
    // the unknowns are the curves between the first and the last
    let free = count - 2;
    let mut bands = memory::filled([0.0; 4], free);
    for &(first, basis) in &rows[1..n] {
        for (a, b) in (0..4).flat_map(|a| (0..=a).map(move |b| (a, b))) {
            let (high, low) = (first + a, first + b);
            if low >= 1 && high + 1 < count {
                bands[low - 1][high - low] += basis[a] * basis[b];
            }
        }
    }
    let matrix = lower_triangle(&bands);
    let order: Vec<usize> = (0..free).collect_vec();
    let symbolic = SymbolicCholesky::new(&matrix.view(), Some(&order));
    let Ok(factor) = symbolic.factor(&matrix.view()) else { return Ok(None) };
    let mut columns = memory::filled(0.0, (n + 1) * free);
    for (row, column) in columns.chunks_mut(free).enumerate() {
        if row == 0 || row == n {
            // what a held row takes off the right sides
            let end = if row == 0 { 0 } else { count - 1 };
            for &(first, basis) in &rows[1..n] {
                let held = end.checked_sub(first).and_then(|r| basis.get(r)).copied().unwrap_or(0.0);
                add_row(column, first, &basis, -held);
            }
        } else {
            add_row(column, rows[row].0, &rows[row].1, 1.0);
        }
    }
    factor.solve(&mut columns, n + 1);

    let mut weights: Vec<Combination> = memory::filled(Vec::new(), count);
    (weights[0], weights[count - 1]) = (vec![(0, 1.0)], vec![(n, 1.0)]);
    for (row, column) in columns.chunks(free).enumerate() {
        let least = LEAST_WEIGHT * column.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        for (j, &weight) in column.iter().enumerate().filter(|(_, weight)| weight.abs() > least) {
            memory::push(&mut weights[j + 1], (row, weight));
        }
    }
    let reaches = |j: usize, row: usize| {
        let (first, basis) = &rows[row];
        j.checked_sub(*first).and_then(|r| basis.get(r)).is_some_and(|&n| n != 0.0)
    };
    let checked_rows = (0..count).map(|j| (0..=n).filter(|&row| reaches(j, row)).collect_vec()).collect_vec();
    let overshoot = overshoot(&weights);
    Ok(Some(Loft { knots_v, parameters: memory::copied(parameters), weights, checked_rows, overshoot }))
}

/// Adds a row of basis functions to a right side that lacks the first and the last curve.
fn add_row(column: &mut [f64], first: usize, basis: &[f64; 4], factor: f64) {
    for (r, n) in basis.iter().enumerate() {
        if let Some(x) = (first + r).checked_sub(1).and_then(|at| column.get_mut(at)) {
            *x += factor * n;
        }
    }
}

/// The lower triangle whose column `k` has the diagonal and what is below it in `bands[k]`.
fn lower_triangle(bands: &[[f64; 4]]) -> CsMat<f64> {
    let n = bands.len();
    let (mut starts, mut rows, mut values) = (vec![0], Vec::new(), Vec::new());
    for (k, band) in bands.iter().enumerate() {
        let height = 4.min(n - k);
        memory::extend(&mut rows, k..k + height);
        values.extend_from_slice(&band[..height]);
        memory::push(&mut starts, rows.len());
    }
    CsMat::new_csc((n, n), starts, rows, values)
}

/// The largest error at the data of each row of the surface with exact control curves.
fn row_errors(loft: &Loft, sources: &Sources) -> Vec<f64> {
    let of_row = |(row, &v): (usize, &f64)| {
        let span = loft.knots_v.span(v);
        let basis = basis_functions(&loft.knots_v, span, v);
        let mut sum = memory::filled(0.0, sources.row_count);
        for (r, n) in basis.iter().enumerate().take(4) {
            loft.weights[span - 3 + r].iter().for_each(|&(source, weight)| sum[source] += n * weight);
        }
        sum[row] -= 1.0;
        let sum: Combination = sum.into_iter().enumerate().filter(|&(_, weight)| weight != 0.0).collect_vec();
        let differences = sources.combine(&[&sum], sources.rows()[row].breaks()).swap_remove(0);
        let length = |row: &[f64]| row.iter().fold(0.0, |length: f64, x| length.hypot(*x));
        differences.chunks(sources.dim).map(length).fold(0.0, f64::max)
    };
    loft.parameters.par_iter().enumerate().map(of_row).collect_vec()
}
