//! Why a field cannot be fitted.

use crate::control::{Cancelled, Forked};
use crate::failure::{Classify, ErrorKind};
use crate::fit::common::FitError;
use crate::model::ModelError;
use crate::surface::g1::SpaceError;

/// A field cannot be fitted.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FieldError {
    /// An option, the nodes or the values will not do.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// A surface that is to be updated is not one of this fitter's.
    #[error("the surface has other knots or another dimension than the fields of this fitter")]
    OtherGrid,
    /// Nothing is known of the nodes of the model.
    #[error("no fit made the model, so it knows of no nodes to fit fields at")]
    NotFitted,
    /// One chart has parameters of its own.
    #[error("the model is one chart without patches: fit fields over the parameters of the mesh")]
    NoPatches,
    /// A face on a plane or cylinder has no smooth space.
    #[error("face {face} is no part of a patch that meets others smoothly")]
    NoPatch {
        /// The face.
        face: usize,
    },
    /// The smooth space cannot be built.
    #[error(transparent)]
    Space(#[from] SpaceError),
    /// The shape of the source makes no model.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// The process has forked since the fitter was used.
    #[error("the fitter cannot be used: {0}")]
    Forked(#[from] Forked),
    /// The progress callback asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl Classify for FieldError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::Fit(error) => error.kind(),
            Self::OtherGrid | Self::Forked(_) => ErrorKind::InvalidArgument,
            Self::NotFitted | Self::NoPatches | Self::NoPatch { .. } => ErrorKind::WrongKind,
            Self::Space(error) => error.kind(),
            Self::Model(error) => error.kind(),
            Self::Cancelled(_) => ErrorKind::Cancelled,
        }
    }

    /// The offending node or face.
    fn index(&self) -> Option<usize> {
        match self {
            Self::Fit(error) => error.index(),
            Self::NoPatch { face } => Some(*face),
            Self::Space(error) => error.index(),
            Self::Model(error) => error.index(),
            _ => None,
        }
    }
}
