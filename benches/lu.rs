//! Factoring many matrices of one pattern: our LU without pivoting beside faer's with pivoting.
//!
//! `cargo bench --bench lu -- [SIDE]`: the matrix of a map of a grid of SIDE x SIDE nodes (317: 100,489 unknowns), whose
//! rows are dominant and not symmetric, as those of mean value maps. Both have analysed the pattern before.

use faer::linalg::solvers::Solve;
use faer::sparse::linalg::solvers::{Lu, SymbolicLu as FaerSymbolicLu};
use faer::sparse::{SparseColMat, Triplet};
use planish::control::Pool;
use planish::control::Watch;
use planish::linalg::SymbolicLu;
use planish::samples::Random;
use sprs::{CsMat, TriMat};
use std::time::Instant;

/// Refactorizations timed; the fastest counts.
const ROUNDS: usize = 5;

fn main() {
    let side = std::env::args().skip(1).find_map(|argument| argument.parse().ok()).unwrap_or(317);
    println!("{:>8} {:>8} {:>12} {:>10} {:>10}", "unknowns", "threads", "what", "seconds", "residual");
    let matrices: Vec<CsMat<f64>> = (0..ROUNDS as u64).map(|seed| map_matrix(side, seed)).collect();
    for threads in [1, 2] {
        Pool::new(threads).run(|| ours(&matrices, threads));
    }
    // the library builds faer without threads of its own
    theirs(&matrices, 1);
}

/// Rows 1 on the diagonal, and minus the shares of the neighbours in a triangulated grid beside it. Neighbours beyond the
/// border are fixed.
fn map_matrix(side: usize, seed: u64) -> CsMat<f64> {
    let mut random = Random::new(seed);
    let mut entries = TriMat::new((side * side, side * side));
    for (i, j) in (0..side).flat_map(|i| (0..side).map(move |j| (i, j))) {
        let row = i * side + j;
        let shares: [f64; 6] = std::array::from_fn(|_| 0.2 + random.unit());
        let sum: f64 = shares.iter().sum();
        entries.add_triplet(row, row, 1.0);
        let steps = [(0, 1), (1, 1), (1, 0), (0, -1), (-1, -1), (-1, 0)];
        for ((a, b), share) in steps.into_iter().zip(shares) {
            let at = |k: usize, step: isize| k.checked_add_signed(step).filter(|&k| k < side);
            if let (Some(i), Some(j)) = (at(i, a), at(j, b)) {
                entries.add_triplet(row, i * side + j, -share / sum);
            }
        }
    }
    entries.to_csr()
}

fn ours(matrices: &[CsMat<f64>], threads: usize) {
    let symbolic = SymbolicLu::new(matrices[0].view(), &Watch::default()).expect("a symmetric pattern");
    let mut numeric = symbolic.factor(matrices[0].view(), &Watch::default()).expect("dominant rows");
    let mut least = f64::INFINITY;
    let mut residual = 0.0_f64;
    for matrix in matrices {
        let start = Instant::now();
        symbolic.refactor(matrix.view(), &mut numeric, &Watch::default()).expect("dominant rows");
        least = least.min(start.elapsed().as_secs_f64());
        let mut x = vec![[1.0]; matrix.rows()];
        symbolic.solve_in_place(&numeric, &mut x, &Watch::default());
        residual = residual.max(largest_residual(matrix, |row| x[row][0]));
    }
    report(matrices, threads, "ours", least, residual);
}

fn theirs(matrices: &[CsMat<f64>], threads: usize) {
    let columns = |matrix: &CsMat<f64>| {
        let entries: Vec<_> =
            matrix.iter().map(|(&value, (row, column))| Triplet::new(row, column, value)).collect();
        SparseColMat::<usize, f64>::try_new_from_triplets(matrix.rows(), matrix.cols(), &entries)
            .expect("entries of a matrix")
    };
    let symbolic = FaerSymbolicLu::try_new(columns(&matrices[0]).symbolic()).expect("a pattern");
    let mut least = f64::INFINITY;
    let mut residual = 0.0_f64;
    for matrix in matrices {
        let columns = columns(matrix);
        let start = Instant::now();
        let factor = Lu::try_new_with_symbolic(symbolic.clone(), columns.as_ref()).expect("dominant rows");
        least = least.min(start.elapsed().as_secs_f64());
        let mut x = faer::Mat::from_fn(matrix.rows(), 1, |_, _| 1.0);
        factor.solve_in_place(x.as_mut());
        residual = residual.max(largest_residual(matrix, |row| x[(row, 0)]));
    }
    report(matrices, threads, "faer", least, residual);
}

/// The largest entry of `1 - A x`.
fn largest_residual(matrix: &CsMat<f64>, x: impl Fn(usize) -> f64) -> f64 {
    let miss =
        |row: sprs::CsVecView<f64>| 1.0 - row.iter().map(|(column, &value)| value * x(column)).sum::<f64>();
    matrix.outer_iterator().map(miss).fold(0.0, |most, miss| most.max(miss.abs()))
}

fn report(matrices: &[CsMat<f64>], threads: usize, what: &str, seconds: f64, residual: f64) {
    println!("{:8} {threads:8} {what:>12} {seconds:10.4} {residual:10.1e}", matrices[0].rows());
}
