//! Solving with a factored matrix: forward and back substitution over the supernodes.

use super::{NumericLu, SymbolicLu};
use crate::control::Watch;
use crate::linalg::dense::vectorized;
use crate::memory::{self, CollectVec};
use rayon::prelude::*;
use sprs::CsMatView;
use std::ops::Range;

impl SymbolicLu {
    /// Solves in place for `K` right-hand sides, stored row by row.
    ///
    /// Heavy subtrees are swept in parallel, on the rayon pool the call is made in. A cancelled call throws `x` away.
    pub fn solve_in_place<const K: usize>(&self, numeric: &NumericLu, x: &mut [[f64; K]], watch: &Watch) {
        debug_assert_eq!(x.len(), self.size());
        let mut permuted: Vec<[f64; K]> = self.tree.order.iter().map(|&node| x[node as usize]).collect_vec();
        let count = self.tree.supernodes.len();
        // a forest of several roots is swept in one go
        let root = (0..count).next_back().filter(|&s| self.tree.supernodes[s].first_descendant == 0);
        let (branches, rest) = root.map_or((Vec::new(), 0), |root| self.branches(root));

        let beyond = self.sweep_branches(&branches, &mut permuted, |branch, span| {
            let subtree = self.tree.supernodes[branch].first_descendant..branch + 1;
            self.substitute_forward(subtree, numeric, span, watch);
        });
        for (&branch, changes) in branches.iter().zip(&beyond) {
            let rows = &self.tree.rows[self.tree.supernodes[branch].rows.clone()];
            rows.iter().zip(changes).for_each(|(&row, change)| add(&mut permuted[row as usize], change));
        }
        let mut whole = Span { start: 0, inside: &mut permuted, rows: &[], beyond: Vec::new() };
        self.substitute_forward(rest..count, numeric, &mut whole, watch);
        self.substitute_backward(rest..count, numeric, &mut whole, watch);
        let known = memory::copied(&permuted);
        self.sweep_branches(&branches, &mut permuted, |branch, span| {
            span.beyond.iter_mut().zip(span.rows).for_each(|(value, &row)| *value = known[row as usize]);
            let subtree = self.tree.supernodes[branch].first_descendant..branch + 1;
            self.substitute_backward(subtree, numeric, span, watch);
        });
        for (&node, &value) in self.tree.order.iter().zip(&permuted) {
            x[node as usize] = value;
        }
    }

    /// Gives each branch its unknowns; returns what each left beyond them.
    fn sweep_branches<const K: usize>(
        &self,
        branches: &[usize],
        x: &mut [[f64; K]],
        sweep: impl Fn(usize, &mut Span<K>) + Sync,
    ) -> Vec<Vec<[f64; K]>> {
        let mut spans = memory::with_capacity(branches.len());
        let (mut start, mut left) = (0, x);
        for &branch in branches {
            let supernode = &self.tree.supernodes[branch];
            let (inside, others) = left.split_at_mut(supernode.columns.end - start);
            let rows = &self.tree.rows[supernode.rows.clone()];
            spans.push((branch, Span { start, inside, rows, beyond: memory::filled([0.0; K], rows.len()) }));
            (start, left) = (supernode.columns.end, others);
        }
        let swept = spans.into_par_iter().map(|(branch, mut span)| {
            sweep(branch, &mut span);
            span.beyond
        });
        swept.collect()
    }

    /// For each supernode x1 <- inv(L11) x1, x2 <- x2 - L21 x1.
    fn substitute_forward<const K: usize>(
        &self,
        supernodes: Range<usize>,
        numeric: &NumericLu,
        x: &mut Span<K>,
        watch: &Watch,
    ) {
        vectorized(|| {
            let mut below = Vec::new();
            for s in supernodes.take_while(|&s| watch.check_at(s).is_ok()) {
                let supernode = &self.tree.supernodes[s];
                let (size, width) = (supernode.front_size(), supernode.columns.len());
                let lower = &numeric.panels[self.panel_starts[s]..][..size * width];
                below.clear();
                below.resize(supernode.rows.len(), [0.0; K]);
                let pivots = x.pivots(&supernode.columns);
                for (k, column) in lower.chunks_exact(size).enumerate() {
                    let value = pivots[k];
                    subtract_rows(&mut pivots[k + 1..], &column[k + 1..width], value);
                    subtract_rows(&mut below, &column[width..], value);
                }
                for (&row, change) in self.tree.rows[supernode.rows.clone()].iter().zip(&below) {
                    add(x.row(row), change);
                }
            }
        });
    }

    /// For each supernode, last first, x1 <- inv(U11) (x1 - U12 x2).
    fn substitute_backward<const K: usize>(
        &self,
        supernodes: Range<usize>,
        numeric: &NumericLu,
        x: &mut Span<K>,
        watch: &Watch,
    ) {
        vectorized(|| {
            let mut below = Vec::new();
            for s in supernodes.rev().take_while(|&s| watch.check_at(s).is_ok()) {
                let supernode = &self.tree.supernodes[s];
                let (size, width) = (supernode.front_size(), supernode.columns.len());
                let panel = &numeric.panels[self.panel_starts[s]..self.panel_starts[s + 1]];
                let (lower, upper) = panel.split_at(size * width);
                below.clear();
                below.extend(self.tree.rows[supernode.rows.clone()].iter().map(|&row| *x.row(row)));
                let pivots = x.pivots(&supernode.columns);
                for (pivot, right) in pivots.iter_mut().zip(upper.chunks_exact(below.len().max(1))) {
                    let mut sum = [0.0; K];
                    for (&factor, value) in right.iter().zip(&below) {
                        (0..K).for_each(|i| sum[i] -= factor * value[i]);
                    }
                    add(pivot, &sum);
                }
                for (k, column) in lower.chunks_exact(size).enumerate().rev() {
                    pivots[k].iter_mut().for_each(|x| *x /= column[k]);
                    let value = pivots[k];
                    subtract_rows(&mut pivots[..k], &column[..k], value);
                }
            }
        });
    }

    /// Solves `matrix x = rhs` with one step of iterative refinement, which keeps small
    /// differences of nearly equal unknowns (strongly compressed triangles) right. A cancelled call throws them away.
    pub fn solve<const K: usize>(
        &self,
        numeric: &NumericLu,
        matrix: CsMatView<f64>,
        rhs: &[[f64; K]],
        watch: &Watch,
    ) -> Vec<[f64; K]> {
        let mut x = memory::copied(rhs);
        self.solve_in_place(numeric, &mut x, watch);
        let mut residual = memory::copied(rhs);
        for (row, entries) in matrix.outer_iterator().enumerate() {
            for (column, &value) in entries.iter() {
                (0..K).for_each(|i| residual[row][i] -= value * x[column][i]);
            }
        }
        self.solve_in_place(numeric, &mut residual, watch);
        x.iter_mut().zip(&residual).for_each(|(x, change)| add(x, change));
        x
    }
}

/// A contiguous part of the unknowns, with copies of the rows after it that its pivots touch.
struct Span<'x, const K: usize> {
    start: usize,
    inside: &'x mut [[f64; K]],
    /// Ascending.
    rows: &'x [u32],
    beyond: Vec<[f64; K]>,
}

impl<const K: usize> Span<'_, K> {
    #[inline(always)]
    fn pivots(&mut self, columns: &Range<usize>) -> &mut [[f64; K]] {
        &mut self.inside[columns.start - self.start..columns.end - self.start]
    }

    #[inline(always)]
    fn row(&mut self, row: u32) -> &mut [f64; K] {
        match row as usize - self.start {
            place if place < self.inside.len() => &mut self.inside[place],
            _ => &mut self.beyond[self.rows.partition_point(|&other| other < row)],
        }
    }
}

#[inline(always)]
fn add<const K: usize>(x: &mut [f64; K], change: &[f64; K]) {
    (0..K).for_each(|i| x[i] += change[i]);
}

#[inline(always)]
fn subtract_rows<const K: usize>(rows: &mut [[f64; K]], factors: &[f64], value: [f64; K]) {
    for (row, &factor) in rows.iter_mut().zip(factors) {
        (0..K).for_each(|i| row[i] -= factor * value[i]);
    }
}
