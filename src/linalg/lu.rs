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

mod pattern;
mod solve;

use super::dense::{factor_columns, subtract_product};
use super::elimination::EliminationTree;
use super::ordering::fill_reducing_order;
use crate::control::{Cancelled, Watch};
use crate::failure::{Classify, ErrorKind};
use crate::memory::{self, CollectVec};
use pattern::{Slot, mirror_entries, off_diagonal_graph, parent_places, place_entries};
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
    /// The caller asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl Classify for LuError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::NotSquare { .. } | Self::PatternNotSymmetric { .. } | Self::OtherPattern { .. } => {
                ErrorKind::InvalidArgument
            }
            Self::TooLarge { .. } => ErrorKind::TooLarge,
            Self::Singular { .. } => ErrorKind::Singular,
            Self::Cancelled(_) => ErrorKind::Cancelled,
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
    pub fn new(matrix: CsMatView<f64>, watch: &Watch) -> Result<Self, LuError> {
        if matrix.rows() != matrix.cols() || !matrix.is_csr() {
            return Err(LuError::NotSquare { rows: matrix.rows(), columns: matrix.cols() });
        }
        let mirror = mirror_entries(&matrix)?;
        let graph = off_diagonal_graph(&matrix);
        watch.check()?;
        let order = fill_reducing_order(&graph, watch)?;
        watch.check()?;
        let tree = EliminationTree::new(&graph, &order);
        watch.check()?;
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
    pub fn factor(&self, matrix: CsMatView<f64>, watch: &Watch) -> Result<NumericLu, LuError> {
        let mut numeric = NumericLu { panels: memory::filled(0.0, self.factor_entry_count()) };
        self.refactor(matrix, &mut numeric, watch)?;
        Ok(numeric)
    }

    /// Factors into memory that an earlier matrix of the pattern has used.
    pub fn refactor(
        &self,
        matrix: CsMatView<f64>,
        numeric: &mut NumericLu,
        watch: &Watch,
    ) -> Result<(), LuError> {
        if matrix.nnz() != self.entry_count || matrix.rows() != self.size() {
            return Err(LuError::OtherPattern { expected: self.entry_count, found: matrix.nnz() });
        }
        let values = matrix.data();
        let roots: Vec<usize> = (0..self.tree.supernodes.len())
            .filter(|&s| self.tree.supernodes[s].parent.is_none())
            .collect_vec();
        self.factor_siblings(&roots, &mut numeric.panels, values, watch).map(|_| ())
    }

    /// Factors the subtrees of consecutive siblings, in parallel; returns their updates.
    fn factor_siblings(
        &self,
        siblings: &[usize],
        panels: &mut [f64],
        values: &[f64],
        watch: &Watch,
    ) -> Result<Vec<Vec<f64>>, LuError> {
        match siblings {
            [] => Ok(Vec::new()),
            [one] => Ok(vec![self.factor_subtree(*one, panels, values, watch)?]),
            _ => {
                let (left, right) = siblings.split_at(siblings.len() / 2);
                let first = self.tree.supernodes[siblings[0]].first_descendant;
                let middle = self.tree.supernodes[right[0]].first_descendant;
                let (left_panels, right_panels) =
                    panels.split_at_mut(self.panel_starts[middle] - self.panel_starts[first]);
                let work = |side: &[usize]| side.iter().map(|&s| self.tree.supernodes[s].work).sum::<f64>();
                let (a, b) = if work(left).min(work(right)) < LEAST_SPLIT_WORK {
                    let a = self.factor_siblings(left, left_panels, values, watch);
                    (a, self.factor_siblings(right, right_panels, values, watch))
                } else {
                    rayon::join(
                        || self.factor_siblings(left, left_panels, values, watch),
                        || self.factor_siblings(right, right_panels, values, watch),
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
    fn factor_subtree(
        &self,
        root: usize,
        panels: &mut [f64],
        values: &[f64],
        watch: &Watch,
    ) -> Result<Vec<f64>, LuError> {
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
        for update in self.factor_siblings(&heavy, done, values, watch)? {
            stack.extend(update);
        }
        for s in next..=root {
            watch.check()?;
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
}

/// The numbers of L and U, by supernode.
#[derive(Debug, Clone)]
pub struct NumericLu {
    panels: Vec<f64>,
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

#[cfg(test)]
mod tests;
