//! Sparse LU of matrices that need no pivoting, for many matrices of one pattern: here we factor the maps of meshes
//! (mean value, harmonic, stretch) ourselves; Cholesky and all other LU is faer's ([`super::SymbolicCholesky`],
//! [`super::Entries`]).
//!
//! Ours because faer's sparse LU pivots, so it cannot factor another matrix of a pattern without looking for pivots
//! again: `benches/lu.rs` times both.
//!
//! I. Duff, J. Reid, "The multifrontal solution of unsymmetric sets of linear equations", SIAM J.
//! Sci. Stat. Comput. 5 (1984), 633-641; J. W. H. Liu, "The multifrontal method for sparse matrix
//! solution: theory and practice", SIAM Review 34 (1992), 82-109.
//!
//! The pattern must be symmetric, the values need not be. Pivots stay on the diagonal: right for
//! row-dominant M-matrices (mean value and stretch maps) and for symmetric positive definite ones
//! (harmonic maps), where elimination in any order is stable. Each supernode is a dense front
//! ```text
//!     [ F11 F12 ]   F11 = L11 U11,   L21 = F21 inv(U11),   U12 = inv(L11) F12
//!     [ F21 F22 ]   F22 - L21 U12 is added to the parent's front
//! ```
//! Independent subtrees are factored in parallel. Updates are added in the order of the children,
//! so the bits of the result do not depend on the number of threads.

use super::dense::{factor_columns, subtract_product, vectorized};
use super::elimination::{EliminationTree, Supernode};
use super::ordering::{Graph, fill_reducing_order};
use crate::failure::{Classify, ErrorKind};
use crate::memory::{self, CollectVec};
use rayon::prelude::*;
use sprs::CsMatView;
use std::ops::Range;

/// A matrix cannot be factored.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum LuError {
    /// The matrix is not square, or not stored by rows.
    #[error("a matrix of {rows} rows and {columns} columns, stored by rows, was expected to be square")]
    NotSquare {
        /// Rows of the matrix.
        rows: usize,
        /// Columns of the matrix.
        columns: usize,
    },
    /// The pattern is not symmetric, or lacks a diagonal entry.
    #[error("row {row} of the matrix has an entry without a mirror image, or no diagonal")]
    PatternNotSymmetric {
        /// The row.
        row: usize,
    },
    /// The values belong to another pattern.
    #[error("the matrix has {found} entries where the analysed pattern has {expected}")]
    OtherPattern {
        /// Entries of the analysed pattern.
        expected: usize,
        /// Entries of the matrix.
        found: usize,
    },
    /// A dense front has more entries than can be numbered.
    #[error("elimination leads to a dense block of {size} rows, too large to be stored")]
    TooLarge {
        /// Rows of the block.
        size: usize,
    },
    /// A pivot vanished: the matrix is singular (or not of the kind that needs no pivoting).
    #[error("the matrix is singular at row {row}")]
    Singular {
        /// The row whose pivot is zero or not finite.
        row: usize,
    },
}

impl Classify for LuError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::NotSquare { .. } | Self::PatternNotSymmetric { .. } | Self::OtherPattern { .. } => {
                ErrorKind::InvalidArgument
            }
            Self::TooLarge { .. } => ErrorKind::TooLarge,
            Self::Singular { .. } => ErrorKind::Singular,
        }
    }

    /// The offending row.
    fn index(&self) -> Option<usize> {
        match self {
            Self::PatternNotSymmetric { row } | Self::Singular { row } => Some(*row),
            _ => None,
        }
    }
}

/// Where one entry of the matrix goes in its supernode's panel.
#[derive(Debug, Clone, Copy)]
struct Slot {
    entry: u32,
    place: u32,
}

/// Everything about the elimination that the pattern alone decides.
#[derive(Debug, Clone)]
pub struct SymbolicLu {
    tree: EliminationTree,
    /// For each row of `tree.rows` its place in the parent's front.
    parent_places: Vec<u32>,
    /// Entries of the matrix by supernode.
    slots: Vec<Slot>,
    slot_starts: Vec<usize>,
    /// A supernode's panel: its `lower`, then its `upper` (see `dense`).
    panel_starts: Vec<usize>,
    /// Subtrees with less work than this are not split between threads.
    split_work: f64,
    entry_count: usize,
}

/// Splitting finer than this share of the whole costs a stack of updates for each piece and balances
/// a dozen threads no better.
const SPLIT_SHARE: f64 = 1.0 / 64.0;
/// A subtree of fewer multiplications is done before another thread has picked it up.
const LEAST_SPLIT_WORK: f64 = 1e6;

impl SymbolicLu {
    /// Orders and analyses the pattern of a square matrix stored by rows.
    pub fn new(matrix: CsMatView<f64>) -> Result<Self, LuError> {
        if matrix.rows() != matrix.cols() || !matrix.is_csr() {
            return Err(LuError::NotSquare { rows: matrix.rows(), columns: matrix.cols() });
        }
        let mirror = mirror_entries(&matrix)?;
        let graph = off_diagonal_graph(&matrix);
        let tree = EliminationTree::new(&graph, &fill_reducing_order(&graph));
        let mut panel_starts = vec![0];
        for supernode in &tree.supernodes {
            let size = supernode.front_size();
            let length = (size + supernode.rows.len()) * supernode.columns.len();
            if length > u32::MAX as usize {
                return Err(LuError::TooLarge { size });
            }
            let end = panel_starts[panel_starts.len() - 1] + length;
            memory::push(&mut panel_starts, end);
        }
        let (parent_places, (slots, slot_starts)) =
            rayon::join(|| parent_places(&tree), || place_entries(&matrix, &mirror, &tree));
        let total: f64 = tree.supernodes.iter().filter(|s| s.parent.is_none()).map(|s| s.work).sum();
        let split_work = LEAST_SPLIT_WORK.max(SPLIT_SHARE * total);
        let entry_count = matrix.nnz();
        Ok(Self { tree, parent_places, slots, slot_starts, panel_starts, split_work, entry_count })
    }

    /// Order of the matrix.
    pub fn size(&self) -> usize {
        self.tree.order.len()
    }

    /// Numbers stored for L and U together.
    pub fn factor_entry_count(&self) -> usize {
        self.panel_starts[self.tree.supernodes.len()]
    }

    /// Factors a matrix of the analysed pattern.
    ///
    /// Runs on the rayon pool it is called in: call it inside [`crate::Control::run`].
    pub fn factor(&self, matrix: CsMatView<f64>) -> Result<NumericLu, LuError> {
        let mut numeric = NumericLu { panels: memory::filled(0.0, self.factor_entry_count()) };
        self.refactor(matrix, &mut numeric)?;
        Ok(numeric)
    }

    /// Factors into memory that an earlier matrix of the pattern has used.
    pub fn refactor(&self, matrix: CsMatView<f64>, numeric: &mut NumericLu) -> Result<(), LuError> {
        if matrix.nnz() != self.entry_count || matrix.rows() != self.size() {
            return Err(LuError::OtherPattern { expected: self.entry_count, found: matrix.nnz() });
        }
        let values = matrix.data();
        let roots: Vec<usize> = (0..self.tree.supernodes.len())
            .filter(|&s| self.tree.supernodes[s].parent.is_none())
            .collect_vec();
        self.factor_siblings(&roots, &mut numeric.panels, values).map(|_| ())
    }

    /// Factors the subtrees of consecutive siblings, in parallel; returns their updates.
    fn factor_siblings(
        &self,
        siblings: &[usize],
        panels: &mut [f64],
        values: &[f64],
    ) -> Result<Vec<Vec<f64>>, LuError> {
        match siblings {
            [] => Ok(Vec::new()),
            [one] => Ok(vec![self.factor_subtree(*one, panels, values)?]),
            _ => {
                let (left, right) = siblings.split_at(siblings.len() / 2);
                let first = self.tree.supernodes[siblings[0]].first_descendant;
                let middle = self.tree.supernodes[right[0]].first_descendant;
                let (left_panels, right_panels) =
                    panels.split_at_mut(self.panel_starts[middle] - self.panel_starts[first]);
                let work = |side: &[usize]| side.iter().map(|&s| self.tree.supernodes[s].work).sum::<f64>();
                let (a, b) = if work(left).min(work(right)) < LEAST_SPLIT_WORK {
                    let a = self.factor_siblings(left, left_panels, values);
                    (a, self.factor_siblings(right, right_panels, values))
                } else {
                    rayon::join(
                        || self.factor_siblings(left, left_panels, values),
                        || self.factor_siblings(right, right_panels, values),
                    )
                };
                let mut updates = a?;
                updates.extend(b?);
                Ok(updates)
            }
        }
    }

    /// Factors a subtree; returns the update of its root.
    ///
    /// Walks down to the lowest supernode that still has all the heavy work below it, splits the
    /// work there, and climbs back one front at a time.
    fn factor_subtree(&self, root: usize, panels: &mut [f64], values: &[f64]) -> Result<Vec<f64>, LuError> {
        let base = self.panel_starts[self.tree.supernodes[root].first_descendant];
        let mut node = root;
        let heavy = loop {
            let children = &self.tree.children[node];
            let is_heavy = |&&child: &&u32| self.tree.supernodes[child as usize].work >= self.split_work;
            let heavy: Vec<usize> =
                children.iter().take_while(is_heavy).map(|&child| child as usize).collect_vec();
            match heavy[..] {
                [only] => node = only,
                _ => break heavy,
            }
        };
        let next = heavy.last().map_or(self.tree.supernodes[node].first_descendant, |&last| last + 1);
        let (done, _) = panels.split_at_mut(self.panel_starts[next] - base);
        let mut stack: Vec<f64> = memory::with_capacity(self.stack_size(&heavy, next..root + 1));
        for update in self.factor_siblings(&heavy, done, values)? {
            stack.extend(update);
        }
        for s in next..=root {
            let panel = &mut panels[self.panel_starts[s] - base..self.panel_starts[s + 1] - base];
            self.factor_front(s, panel, values, &mut stack)?;
        }
        Ok(stack)
    }

    /// The heavy subtrees below the lowest supernode that has all the heavy work below it, and the
    /// supernode after them. They begin with the first descendant of `root`; there may be none.
    fn branches(&self, root: usize) -> (Vec<usize>, usize) {
        let mut node = root;
        loop {
            let children = &self.tree.children[node];
            let is_heavy = |&&child: &&u32| self.tree.supernodes[child as usize].work >= self.split_work;
            let heavy: Vec<usize> =
                children.iter().take_while(is_heavy).map(|&child| child as usize).collect_vec();
            match heavy[..] {
                [only] => node = only,
                [.., last] => return (heavy, last + 1),
                [] => return (heavy, self.tree.supernodes[node].first_descendant),
            }
        }
    }

    /// Assembles and factors one front; its children's updates, the top of the stack, make room
    /// for its own.
    fn factor_front(
        &self,
        s: usize,
        panel: &mut [f64],
        values: &[f64],
        stack: &mut Vec<f64>,
    ) -> Result<(), LuError> {
        let supernode = &self.tree.supernodes[s];
        let (size, width, height) = (supernode.front_size(), supernode.columns.len(), supernode.rows.len());
        panel.fill(0.0);
        for slot in &self.slots[self.slot_starts[s]..self.slot_starts[s + 1]] {
            panel[slot.place as usize] = values[slot.entry as usize];
        }
        let (lower, upper) = panel.split_at_mut(size * width);
        let top = stack.len();
        stack.resize(top + height * height, 0.0);
        let (below, update) = stack.split_at_mut(top);
        let mut start = top - self.children_length(s);
        let bottom = start;
        for &child in &self.tree.children[s] {
            let child = &self.tree.supernodes[child as usize];
            let length = child.rows.len() * child.rows.len();
            let places = &self.parent_places[child.rows.clone()];
            add_update(&below[start..start + length], places, lower, upper, update, size, width);
            start += length;
        }
        factor_columns(lower, upper, size, width).map_err(|k| {
            let row = self.tree.order[supernode.columns.start + k] as usize;
            LuError::Singular { row }
        })?;
        subtract_product(update, lower, upper, size, width);
        stack.copy_within(top.., bottom);
        stack.truncate(bottom + height * height);
        Ok(())
    }

    /// The longest the stack of updates gets while these supernodes are factored one by one.
    fn stack_size(&self, done: &[usize], todo: Range<usize>) -> usize {
        let square = |s: usize| self.tree.supernodes[s].rows.len().pow(2);
        let mut size: usize = done.iter().map(|&s| square(s)).sum();
        let mut largest = size;
        for s in todo {
            largest = largest.max(size + square(s));
            size = size + square(s) - self.children_length(s);
        }
        largest
    }

    fn children_length(&self, s: usize) -> usize {
        let square = |&child: &u32| self.tree.supernodes[child as usize].rows.len().pow(2);
        self.tree.children[s].iter().map(square).sum()
    }

    /// Solves in place for `K` right-hand sides, stored row by row.
    ///
    /// Heavy subtrees are swept in parallel, on the rayon pool the call is made in.
    pub fn solve_in_place<const K: usize>(&self, numeric: &NumericLu, x: &mut [[f64; K]]) {
        debug_assert_eq!(x.len(), self.size());
        let mut permuted: Vec<[f64; K]> = self.tree.order.iter().map(|&node| x[node as usize]).collect_vec();
        let count = self.tree.supernodes.len();
        // a forest of several roots is swept in one go
        let root = (0..count).next_back().filter(|&s| self.tree.supernodes[s].first_descendant == 0);
        let (branches, rest) = root.map_or((Vec::new(), 0), |root| self.branches(root));

        let beyond = self.sweep_branches(&branches, &mut permuted, |branch, span| {
            self.substitute_forward(self.tree.supernodes[branch].first_descendant..branch + 1, numeric, span);
        });
        for (&branch, changes) in branches.iter().zip(&beyond) {
            let rows = &self.tree.rows[self.tree.supernodes[branch].rows.clone()];
            rows.iter().zip(changes).for_each(|(&row, change)| add(&mut permuted[row as usize], change));
        }
        let mut whole = Span { start: 0, inside: &mut permuted, rows: &[], beyond: Vec::new() };
        self.substitute_forward(rest..count, numeric, &mut whole);
        self.substitute_backward(rest..count, numeric, &mut whole);
        let known = memory::copied(&permuted);
        self.sweep_branches(&branches, &mut permuted, |branch, span| {
            span.beyond.iter_mut().zip(span.rows).for_each(|(value, &row)| *value = known[row as usize]);
            self.substitute_backward(
                self.tree.supernodes[branch].first_descendant..branch + 1,
                numeric,
                span,
            );
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
    ) {
        vectorized(|| {
            let mut below = Vec::new();
            for s in supernodes {
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
    ) {
        vectorized(|| {
            let mut below = Vec::new();
            for s in supernodes.rev() {
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
    /// differences of nearly equal unknowns (strongly compressed triangles) right.
    pub fn solve<const K: usize>(
        &self,
        numeric: &NumericLu,
        matrix: CsMatView<f64>,
        rhs: &[[f64; K]],
    ) -> Vec<[f64; K]> {
        let mut x = memory::copied(rhs);
        self.solve_in_place(numeric, &mut x);
        let mut residual = memory::copied(rhs);
        for (row, entries) in matrix.outer_iterator().enumerate() {
            for (column, &value) in entries.iter() {
                (0..K).for_each(|i| residual[row][i] -= value * x[column][i]);
            }
        }
        self.solve_in_place(numeric, &mut residual);
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

/// The numbers of L and U, by supernode.
#[derive(Debug, Clone)]
pub struct NumericLu {
    panels: Vec<f64>,
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

/// Adds a child's update to the front. `places` ascend, so a column's rows split once.
fn add_update(
    child: &[f64],
    places: &[u32],
    lower: &mut [f64],
    upper: &mut [f64],
    update: &mut [f64],
    size: usize,
    width: usize,
) {
    let height = size - width;
    let split = places.partition_point(|&place| (place as usize) < width);
    let (pivots, others) = places.split_at(split);
    for (column, &place) in child.chunks_exact(places.len().max(1)).zip(places) {
        let place = place as usize;
        if place < width {
            let target = &mut lower[place * size..(place + 1) * size];
            column.iter().zip(places).for_each(|(x, &row)| target[row as usize] += x);
        } else {
            let (above, below) = column.split_at(split);
            above.iter().zip(pivots).for_each(|(x, &row)| upper[row as usize * height + place - width] += x);
            let target = &mut update[(place - width) * height..(place - width + 1) * height];
            below.iter().zip(others).for_each(|(x, &row)| target[row as usize - width] += x);
        }
    }
}

/// For each entry the index of its mirror image: one pass, since both are met in the same order.
fn mirror_entries(matrix: &CsMatView<f64>) -> Result<Vec<u32>, LuError> {
    let (starts, columns) = (matrix.indptr(), matrix.indices());
    let starts = starts.raw_storage();
    let mut next: Vec<usize> = starts[..matrix.rows()].to_vec();
    let mut mirror = memory::filled(0, columns.len());
    for row in 0..matrix.rows() {
        let mut has_diagonal = false;
        for entry in starts[row]..starts[row + 1] {
            let column = columns[entry];
            let image = next[column];
            if image >= starts[column + 1] || columns[image] != row {
                return Err(LuError::PatternNotSymmetric { row });
            }
            next[column] += 1;
            mirror[entry] = image as u32;
            has_diagonal |= column == row;
        }
        if !has_diagonal {
            return Err(LuError::PatternNotSymmetric { row });
        }
    }
    Ok(mirror)
}

fn off_diagonal_graph(matrix: &CsMatView<f64>) -> Graph {
    let mut graph = Graph { starts: vec![0], neighbours: memory::with_capacity(matrix.nnz()) };
    for (row, entries) in matrix.outer_iterator().enumerate() {
        let others = entries.indices().iter().filter(|&&column| column != row);
        graph.neighbours.extend(others.map(|&column| column as u32));
        graph.starts.push(graph.neighbours.len() as u32);
    }
    graph
}

/// Where each row below a supernode stands in its parent's front; both lists ascend.
fn parent_places(tree: &EliminationTree) -> Vec<u32> {
    let mut places = memory::filled(0, tree.rows.len());
    for supernode in &tree.supernodes {
        let Some(parent) = supernode.parent.map(|parent| &tree.supernodes[parent]) else { continue };
        let parent_rows = &tree.rows[parent.rows.clone()];
        let mut next = 0;
        for at in supernode.rows.clone() {
            let row = tree.rows[at] as usize;
            places[at] = if row < parent.columns.end {
                row - parent.columns.start
            } else {
                next += parent_rows[next..].iter().take_while(|&&r| (r as usize) < row).count();
                parent.columns.len() + next
            } as u32;
        }
    }
    places
}

/// Sorts the matrix entries into the panels: the supernode of the earlier pivot has both images.
fn place_entries(matrix: &CsMatView<f64>, mirror: &[u32], tree: &EliminationTree) -> (Vec<Slot>, Vec<usize>) {
    let starts = matrix.indptr();
    let (starts, columns) = (starts.raw_storage(), matrix.indices());
    let mut slots = memory::with_capacity(columns.len());
    let mut slot_starts = vec![0];
    let mut place_of_row = memory::filled(0_u32, tree.order.len());
    for supernode in &tree.supernodes {
        let Supernode { columns: pivots, rows, .. } = supernode;
        let (size, width, height) = (supernode.front_size(), pivots.len(), rows.len());
        let front = pivots.clone().chain(tree.rows[rows.clone()].iter().map(|&row| row as usize));
        front.enumerate().for_each(|(place, row)| place_of_row[row] = place as u32);
        for (k, pivot) in pivots.clone().enumerate() {
            let node = tree.order[pivot] as usize;
            for entry in starts[node]..starts[node + 1] {
                let other = tree.position[columns[entry]] as usize;
                if other < pivot {
                    continue;
                }
                let place = place_of_row[other] as usize;
                let in_upper =
                    if place < width { place * size + k } else { size * width + k * height + place - width };
                slots.push(Slot { entry: entry as u32, place: in_upper as u32 });
                if other != pivot {
                    slots.push(Slot { entry: mirror[entry], place: (k * size + place) as u32 });
                }
            }
        }
        slot_starts.push(slots.len());
    }
    (slots, slot_starts)
}

#[cfg(test)]
mod tests;
