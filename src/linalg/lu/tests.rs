use super::*;
use crate::Control;
use sprs::{CsMat, TriMat};

/// A diagonally dominant M-matrix on a grid cut into triangles, unsymmetric.
fn grid_matrix(columns: usize, rows: usize) -> CsMat<f64> {
    let n = columns * rows;
    let mut triplets = TriMat::new((n, n));
    let index = |i: usize, j: usize| i * columns + j;
    for i in 0..rows {
        for j in 0..columns {
            let mut sum = if i == 0 { 1.0 } else { 0.0 };
            for (di, dj) in [(0, 1), (1, 0), (0, -1), (-1, 0), (1, 1), (-1, -1)] {
                let (a, b) = (i as i64 + di, j as i64 + dj);
                if a >= 0 && b >= 0 && a < rows as i64 && b < columns as i64 {
                    let weight = 0.1 + ((i * 7 + j * 13) as f64 + di as f64 * 3.0 + dj as f64).sin().abs();
                    triplets.add_triplet(index(i, j), index(a as usize, b as usize), -weight);
                    sum += weight;
                }
            }
            triplets.add_triplet(index(i, j), index(i, j), sum);
        }
    }
    triplets.to_csr()
}

/// Right-hand sides of a planted solution.
fn planted(matrix: &CsMat<f64>) -> (Vec<[f64; 2]>, Vec<[f64; 2]>) {
    let x: Vec<[f64; 2]> = (0..matrix.rows()).map(|i| [(i as f64).sin(), (i % 17) as f64]).collect();
    let mut rhs = vec![[0.0; 2]; x.len()];
    for (row, entries) in matrix.outer_iterator().enumerate() {
        for (column, value) in entries.iter() {
            (0..2).for_each(|k| rhs[row][k] += value * x[column][k]);
        }
    }
    (x, rhs)
}

fn solved(matrix: &CsMat<f64>, rhs: &[[f64; 2]], threads: usize) -> Vec<[f64; 2]> {
    Control::new(threads).run(|| {
        let symbolic = SymbolicLu::new(matrix.view(), &Watch::default()).unwrap();
        let numeric = symbolic.factor(matrix.view(), &Watch::default()).unwrap();
        symbolic.solve(&numeric, matrix.view(), rhs, &Watch::default())
    })
}

#[test]
fn planted_solutions_are_found() {
    for (columns, rows) in [(1, 1), (2, 1), (1, 40), (3, 3), (17, 5), (60, 41), (5, 900), (180, 170)] {
        let matrix = grid_matrix(columns, rows);
        let (x, rhs) = planted(&matrix);
        let found = solved(&matrix, &rhs, 2);
        let error = x.iter().zip(&found).flat_map(|(a, b)| [(a[0] - b[0]).abs(), (a[1] - b[1]).abs()]);
        let error = error.fold(0.0, f64::max);
        // the condition number grows like the square of the distance to the anchored row
        let tol = 64.0 * f64::EPSILON * 16.0 * (rows * rows) as f64;
        assert!(error <= tol, "{columns} x {rows}: {error:e}");
    }
}

#[test]
fn bits_do_not_depend_on_threads() {
    let matrix = grid_matrix(210, 190);
    let (_, rhs) = planted(&matrix);
    let bits = |threads| -> Vec<u64> {
        solved(&matrix, &rhs, threads).iter().flatten().map(|x| x.to_bits()).collect()
    };
    let one = bits(1);
    assert!(one == bits(2), "two threads differ");
    assert!(one == bits(5), "five threads differ");
}

#[test]
fn further_matrices_of_a_pattern_need_no_analysis() {
    let matrix = grid_matrix(30, 20);
    let symbolic = SymbolicLu::new(matrix.view(), &Watch::default()).unwrap();
    let mut numeric = symbolic.factor(matrix.view(), &Watch::default()).unwrap();
    let doubled = matrix.map(|value| 2.0 * value);
    symbolic.refactor(doubled.view(), &mut numeric, &Watch::default()).unwrap();
    let (x, rhs) = planted(&matrix);
    let found = symbolic.solve(&numeric, doubled.view(), &rhs, &Watch::default());
    let error = x.iter().zip(&found).map(|(a, b)| (a[1] - 2.0 * b[1]).abs()).fold(0.0, f64::max);
    assert!(error <= 1e-9, "{error:e}");
}

#[test]
fn separate_components_and_dense_blocks_factor() {
    // two dense blocks without a common entry, and a diagonal
    let mut triplets = TriMat::new((90, 90));
    for i in 0..90_usize {
        triplets.add_triplet(i, i, 50.0);
        for j in (0..80).filter(|&j| i < 80 && j != i && j / 40 == i / 40) {
            triplets.add_triplet(i, j, -1.0 - (i as f64 - 2.0 * j as f64).sin());
        }
    }
    let matrix: CsMat<f64> = triplets.to_csr();
    let (x, rhs) = planted(&matrix);
    let found = solved(&matrix, &rhs, 2);
    let error = x.iter().zip(&found).map(|(a, b)| (a[0] - b[0]).abs()).fold(0.0, f64::max);
    assert!(error <= 1e-11, "{error:e}");
}

#[test]
fn what_cannot_be_factored_is_named() {
    let mut triplets = TriMat::new((3, 3));
    (0..3).for_each(|i| triplets.add_triplet(i, i, 1.0));
    triplets.add_triplet(0, 2, 1.0);
    let lopsided: CsMat<f64> = triplets.to_csr();
    let error = SymbolicLu::new(lopsided.view(), &Watch::default()).unwrap_err();
    assert_eq!(error, LuError::PatternNotSymmetric { row: 0 });

    triplets.add_triplet(2, 0, 1.0);
    let singular: CsMat<f64> = triplets.to_csr();
    let symbolic = SymbolicLu::new(singular.view(), &Watch::default()).unwrap();
    let error = symbolic.factor(singular.view(), &Watch::default()).unwrap_err();
    assert!(matches!(error, LuError::Singular { row: 0 | 2 }), "{error}");
    assert_eq!(error.kind(), ErrorKind::Singular);

    let other = grid_matrix(2, 2);
    let error = symbolic.factor(other.view(), &Watch::default()).unwrap_err();
    assert_eq!(error, LuError::OtherPattern { expected: 5, found: other.nnz() });
}

#[test]
fn a_cancelled_call_is_not_factored() {
    let matrix = grid_matrix(30, 20);
    let symbolic = SymbolicLu::new(matrix.view(), &Watch::default()).unwrap();
    let watch = Watch::default();
    watch.cancel();
    assert_eq!(SymbolicLu::new(matrix.view(), &watch).unwrap_err(), LuError::Cancelled(Cancelled));
    assert_eq!(symbolic.factor(matrix.view(), &watch).unwrap_err(), LuError::Cancelled(Cancelled));
}
