//! Why a field cannot be fitted.

use crate::control::Cancelled;
use crate::failure::{Classify, ErrorKind};
use crate::fit::common::FitError;

/// A field cannot be fitted.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FieldError {
    /// An option, the nodes or the values will not do.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// A surface that is to be updated is not one of this fitter's.
    #[error("the surface has other knots or another dimension than the fields of this fitter")]
    OtherGrid,
    /// The progress callback asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl Classify for FieldError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::Fit(error) => error.kind(),
            Self::OtherGrid => ErrorKind::InvalidArgument,
            Self::Cancelled(_) => ErrorKind::Cancelled,
        }
    }

    /// The offending node.
    fn index(&self) -> Option<usize> {
        match self {
            Self::Fit(error) => error.index(),
            _ => None,
        }
    }
}
