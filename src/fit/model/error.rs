//! Why a mesh does not become a model.

use crate::control::Cancelled;
use crate::failure::{Classify, ErrorKind};
use crate::fit::common::FitError;
use crate::surface::g1::SpaceError;
use crate::tmesh::TMeshError;

/// A fit of a model is not possible.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ModelFitError {
    /// What every fit refuses.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// The layout needs finer cells to start from.
    #[error(transparent)]
    Space(#[from] SpaceError),
    /// Cells cannot be made.
    #[error(transparent)]
    TMesh(#[from] TMeshError),
    /// A place is not on the layout.
    #[error("the place of node {node} is not on a quad of the layout, or its parameters are outside [0, 1]")]
    Place {
        /// The node.
        node: usize,
    },
}

impl From<Cancelled> for ModelFitError {
    fn from(cancelled: Cancelled) -> Self {
        Self::Fit(FitError::Cancelled(cancelled))
    }
}

impl Classify for ModelFitError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::Fit(error) => error.kind(),
            Self::Space(error) => error.kind(),
            Self::TMesh(error) => error.kind(),
            Self::Place { .. } => ErrorKind::InvalidArgument,
        }
    }

    /// The offending node, quad or edge.
    fn index(&self) -> Option<usize> {
        match self {
            Self::Fit(error) => error.index(),
            Self::Space(error) => error.index(),
            Self::TMesh(error) => error.index(),
            Self::Place { node } => Some(*node),
        }
    }
}
