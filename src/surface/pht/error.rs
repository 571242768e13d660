//! What can be wrong with a PHT-spline.

use super::mesh::{Cell, MAX_GRID, MAX_LEVEL};
use crate::ErrorKind;
use crate::surface::tensor::Axis;

/// A PHT-spline is not one, or cannot be changed as asked.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PhtError {
    /// Values need at least one component.
    #[error("the dimension is 0")]
    Dimension,
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
    /// Arrays do not fit together.
    #[error("{count} numbers are given for {what}, {expected} are needed")]
    Count {
        /// The array.
        what: &'static str,
        /// Numbers given.
        count: usize,
        /// Numbers needed.
        expected: usize,
    },
    /// A number of a vertex is NaN or infinite.
    #[error("the data of vertex {index} are not finite")]
    NotFinite {
        /// The basis vertex.
        index: usize,
    },
    /// There is no such vertex.
    #[error("there is no basis vertex {index}, there are {count}")]
    NoSuchVertex {
        /// The vertex asked for.
        index: usize,
        /// Basis vertices.
        count: usize,
    },
    /// A weight is not positive somewhere.
    #[error("a weight in leaf {index} is {weight}, all ordinates of the weights must be positive")]
    Weight {
        /// The leaf.
        index: usize,
        /// The least ordinate.
        weight: f64,
    },
    /// A tolerance is not a number that can be met.
    #[error("the tolerance is {value}, it must be {range}")]
    Tolerance {
        /// The tolerance.
        value: f64,
        /// What it may be.
        range: &'static str,
    },
    /// The surface has a crease, so it is no C1 spline.
    #[error("the surface has a crease at knot {index} in {axis:?}: convert the parts on both sides of it")]
    Crease {
        /// The direction.
        axis: Axis,
        /// The first of the equal knots.
        index: usize,
    },
    /// The result would be larger than allowed.
    #[error("{count} {what} exceed the limit of {limit}")]
    TooLarge {
        /// What there would be too many of.
        what: &'static str,
        /// How many.
        count: usize,
        /// How many are allowed.
        limit: usize,
    },
    /// Two surfaces cannot be stitched.
    #[error("the surfaces cannot be stitched: {reason}")]
    Stitch {
        /// What does not fit.
        reason: &'static str,
    },
}

impl PhtError {
    /// The class of the error.
    pub fn kind(&self) -> ErrorKind {
        match self {
            Self::KnotNotFinite { .. } | Self::NotFinite { .. } => ErrorKind::NotFinite,
            Self::Weight { weight, .. } if !weight.is_finite() => ErrorKind::NotFinite,
            Self::NotLeaf { .. } | Self::NotMergeable { .. } | Self::NoSuchVertex { .. } => ErrorKind::Index,
            Self::TooLarge { .. } | Self::LevelLimit { .. } => ErrorKind::TooLarge,
            Self::KnotCount { count, .. } if *count > MAX_GRID => ErrorKind::TooLarge,
            _ => ErrorKind::InvalidArgument,
        }
    }

    /// The offending knot, cell, vertex or leaf.
    pub fn index(&self) -> Option<usize> {
        match *self {
            Self::KnotNotFinite { index, .. }
            | Self::KnotNotIncreasing { index, .. }
            | Self::NotLeaf { index, .. }
            | Self::LevelLimit { index, .. }
            | Self::NotMergeable { index, .. }
            | Self::NotFinite { index }
            | Self::NoSuchVertex { index, .. }
            | Self::Weight { index, .. }
            | Self::Crease { index, .. } => Some(index),
            _ => None,
        }
    }
}
