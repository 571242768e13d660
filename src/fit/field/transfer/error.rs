//! What can go wrong with a transfer.

use crate::control::Cancelled;
use crate::failure::{Classify, ErrorKind};
use crate::fit::common::FitError;
use crate::fit::field::FieldError;
use crate::query::project::ProjectError;

/// A transfer is not possible.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TransferError {
    /// A target lies too far from the source.
    #[error(
        "target {index} is {distance} away from the source's surface, the limit is {limit}: raise max_distance, or \
         keep far targets"
    )]
    Far {
        /// The target.
        index: usize,
        /// Its distance.
        distance: f64,
        /// The limit, in model units.
        limit: f64,
    },
    /// The limit is negative or NaN.
    #[error("max_distance is {value}, it must not be negative")]
    MaxDistance {
        /// The limit given.
        value: f64,
    },
    /// A coordinate of a target is NaN or infinite.
    #[error("target {index} is not finite")]
    NotFinite {
        /// The target.
        index: usize,
    },
    /// Fields on the source cannot be fitted.
    #[error(transparent)]
    Field(FieldError),
    /// Values are none.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// Targets cannot be projected.
    #[error(transparent)]
    Project(#[from] ProjectError),
    /// The progress callback asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl From<FieldError> for TransferError {
    fn from(error: FieldError) -> Self {
        match error {
            FieldError::Fit(error) => Self::Fit(error),
            other => Self::Field(other),
        }
    }
}

impl Classify for TransferError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::Far { .. } => ErrorKind::Outside,
            Self::MaxDistance { .. } => ErrorKind::InvalidArgument,
            Self::NotFinite { .. } => ErrorKind::NotFinite,
            Self::Field(error) => error.kind(),
            Self::Fit(error) => error.kind(),
            Self::Project(error) => error.kind(),
            Self::Cancelled(_) => ErrorKind::Cancelled,
        }
    }

    /// The offending target, node or value.
    fn index(&self) -> Option<usize> {
        match self {
            Self::Far { index, .. } | Self::NotFinite { index } => Some(*index),
            Self::Field(error) => error.index(),
            Self::Fit(error) => error.index(),
            Self::Project(error) => error.index(),
            _ => None,
        }
    }
}
