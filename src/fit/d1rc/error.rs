//! Why a D1RC fit is not possible.

use crate::control::Cancelled;
use crate::failure::{Classify, ErrorKind};
use crate::fit::common::FitError;
use crate::mesh::DecimateError;
use crate::parameterize::ParameterizeError;
use crate::surface::d1rc::D1rcError;

/// A D1RC fit is not possible.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum D1rcFitError {
    /// An option, the data or their parameters will not do.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// No control mesh can be made of the mesh.
    #[error(transparent)]
    Decimate(#[from] DecimateError),
    /// The control mesh makes no surface.
    #[error(transparent)]
    Surface(#[from] D1rcError),
    /// The control mesh cannot be parameterized.
    #[error("the control mesh has no parameters: {0}")]
    ControlMesh(ParameterizeError),
    /// The progress callback asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl Classify for D1rcFitError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::Fit(error) => error.kind(),
            Self::Decimate(error) => error.kind(),
            Self::Surface(error) => error.kind(),
            Self::ControlMesh(error) => error.kind(),
            Self::Cancelled(_) => ErrorKind::Cancelled,
        }
    }

    /// The offending node, triangle, sharp edge or weight.
    fn index(&self) -> Option<usize> {
        match self {
            Self::Fit(error) => error.index(),
            Self::Decimate(error) => error.index(),
            Self::Surface(error) => error.index(),
            Self::ControlMesh(error) => error.index(),
            Self::Cancelled(_) => None,
        }
    }
}
