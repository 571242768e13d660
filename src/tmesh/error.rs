//! What can be wrong with a T-mesh.

use super::cell::{Cell, MAX_GRID, MAX_LEVEL};
use crate::failure::{Classify, ErrorKind};
use crate::geometry::Axis;

/// A T-mesh is not one, or cannot be changed as asked.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TMeshError {
    /// The number of grid lines is out of range.
    #[error("{count} knots are given in {axis:?}, there must be 2 to {}", MAX_GRID + 1)]
    KnotCount {
        /// The direction.
        axis: Axis,
        /// Knots given.
        count: usize,
    },
    /// A grid line is NaN or infinite.
    #[error("knot {index} in {axis:?} is not finite")]
    KnotNotFinite {
        /// The direction.
        axis: Axis,
        /// The knot.
        index: usize,
    },
    /// A grid line does not lie beyond the one before it.
    #[error("knot {index} in {axis:?} is not greater than the knot before it")]
    KnotNotIncreasing {
        /// The direction.
        axis: Axis,
        /// The knot.
        index: usize,
    },
    /// A cell that should be a leaf is none.
    #[error("cell {index} (level {}, {}, {}) is not a leaf of the mesh", cell.level, cell.i, cell.j)]
    NotLeaf {
        /// Its place in the list.
        index: usize,
        /// Its address.
        cell: Cell,
    },
    /// A leaf cannot be split any more.
    #[error("cell {index} has level {level}, the deepest is {limit} (at most {MAX_LEVEL})")]
    LevelLimit {
        /// Its place in the list.
        index: usize,
        /// Its level.
        level: u32,
        /// The deepest level allowed.
        limit: u32,
    },
    /// A cell cannot be merged: it has no quarters, or one of them is no leaf.
    #[error("the quarters of cell {index} (level {}, {}, {}) are not four leaves", cell.level, cell.i, cell.j)]
    NotMergeable {
        /// Its place in the list.
        index: usize,
        /// Its address.
        cell: Cell,
    },
}

impl Classify for TMeshError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::KnotNotFinite { .. } => ErrorKind::NotFinite,
            Self::NotLeaf { .. } | Self::NotMergeable { .. } => ErrorKind::Index,
            Self::LevelLimit { .. } => ErrorKind::TooLarge,
            Self::KnotCount { count, .. } if *count > MAX_GRID => ErrorKind::TooLarge,
            Self::KnotCount { .. } | Self::KnotNotIncreasing { .. } => ErrorKind::InvalidArgument,
        }
    }

    /// The offending knot or cell.
    fn index(&self) -> Option<usize> {
        match *self {
            Self::KnotNotFinite { index, .. }
            | Self::KnotNotIncreasing { index, .. }
            | Self::NotLeaf { index, .. }
            | Self::LevelLimit { index, .. }
            | Self::NotMergeable { index, .. } => Some(index),
            Self::KnotCount { .. } => None,
        }
    }
}
