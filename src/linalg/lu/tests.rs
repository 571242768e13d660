use super::*;
use crate::Control;
use sprs::{CsMat, TriMat};
use std::time::Instant;

/// A diagonally dominant M-matrix on a grid cut into triangles, unsymmetric.
fn grid_matrix(side: usize) -> CsMat<f64> {
    let n = side * side;
    let mut triplets = TriMat::new((n, n));
    let index = |i: usize, j: usize| i * side + j;
    for i in 0..side {
        for j in 0..side {
            let mut sum = if i == 0 { 1.0 } else { 0.0 };
            for (di, dj) in [(0, 1), (1, 0), (0, -1), (-1, 0), (1, 1), (-1, -1)] {
                let (a, b) = (i as i64 + di, j as i64 + dj);
                if a >= 0 && b >= 0 && a < side as i64 && b < side as i64 {
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

#[test]
fn timing() {
    let matrix = grid_matrix(316);
    for threads in [1, 2] {
        let control = Control::new(threads);
        control.run(|| {
            let t = Instant::now();
            let graph = off_diagonal_graph(&matrix.view());
            let order = fill_reducing_order(&graph);
            let t1 = t.elapsed();
            let tree = EliminationTree::new(&graph, &order);
            let t2 = t.elapsed();
            let symbolic = SymbolicLu::new(matrix.view()).unwrap();
            let t3 = t.elapsed() - t2;
            let t = Instant::now();
            let mut numeric = symbolic.factor(matrix.view()).unwrap();
            let t4 = t.elapsed();
            let t = Instant::now();
            symbolic.refactor(matrix.view(), &mut numeric).unwrap();
            let t5 = t.elapsed();
            let t = Instant::now();
            let rhs: Vec<[f64; 2]> = (0..symbolic.size()).map(|i| [i as f64, 1.0]).collect();
            let x = symbolic.solve(&numeric, matrix.view(), &rhs);
            let t6 = t.elapsed();
            let t = Instant::now();
            let mut y = rhs.clone();
            symbolic.solve_in_place(&numeric, &mut y);
            let t7 = t.elapsed();
            eprintln!("threads {threads}: order {t1:?} tree {:?} symbolic all {t3:?} factor {t4:?} refactor {t5:?} solve+refine {t6:?} solve {t7:?} supernodes {} entries {} work {:e} x {:?}",
              t2-t1, tree.supernodes.len(), symbolic.factor_entry_count(), tree.supernodes.last().unwrap().work, x[77]);
        });
    }
}
