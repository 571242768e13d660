//! What can be wrong with a PHT-spline.

use crate::control::Cancelled;
use crate::failure::{Classify, ErrorKind};
use crate::geometry::Axis;
use crate::tmesh::TMeshError;

/// A PHT-spline is not one, or cannot be changed as asked.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PhtError {
    /// Values need at least one component.
    #[error("the dimension is 0")]
    Dimension,
    /// The mesh is not one, or cannot be changed as asked.
    #[error(transparent)]
    Mesh(#[from] TMeshError),
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
    /// The caller asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// Two surfaces cannot be stitched.
    #[error("the surfaces cannot be stitched: {reason}")]
    Stitch {
        /// What does not fit.
        reason: &'static str,
    },
}

impl Classify for PhtError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::Mesh(error) => error.kind(),
            Self::NotFinite { .. } => ErrorKind::NotFinite,
            Self::Weight { weight, .. } if !weight.is_finite() => ErrorKind::NotFinite,
            Self::NoSuchVertex { .. } => ErrorKind::Index,
            Self::TooLarge { .. } => ErrorKind::TooLarge,
            Self::Cancelled(_) => ErrorKind::Cancelled,
            _ => ErrorKind::InvalidArgument,
        }
    }

    /// The offending knot, cell, vertex or leaf.
    fn index(&self) -> Option<usize> {
        match *self {
            Self::Mesh(ref error) => error.index(),
            Self::NotFinite { index }
            | Self::NoSuchVertex { index, .. }
            | Self::Weight { index, .. }
            | Self::Crease { index, .. } => Some(index),
            _ => None,
        }
    }
}
