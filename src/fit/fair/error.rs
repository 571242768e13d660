//! Why a surface cannot be faired.

use crate::control::Cancelled;
use crate::failure::{Classify, ErrorKind};
use crate::fit::common::FitError;

/// A surface cannot be faired.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FairError {
    /// An option, or the data, will not do.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// The surface is no tensor surface and no PHT-spline.
    #[error(
        "only tensor surfaces and PHT-splines can be faired: convert the surface, or fit one of these to it"
    )]
    Family,
    /// The surface has weights.
    #[error("the surface has weights: only polynomial surfaces can be faired")]
    Rational,
    /// Curvature jumps inside the surface, so that its variation is infinite.
    #[error(
        "curvature jumps across u or v = {at} of the surface, so it has no variation: take the thin plate"
    )]
    CurvatureJumps {
        /// The knot, or the side of the first cell, where it jumps.
        at: f64,
    },
    /// A datum lies outside the surface's domain.
    #[error("the parameters of datum {index} lie outside the domain of the surface")]
    Outside {
        /// The datum.
        index: usize,
    },
    /// The surface misses a datum by more than the tolerance before anything is moved.
    #[error(
        "the surface misses datum {index} by {distance:e}, more than the tolerance {tolerance:e}: fit it first"
    )]
    NotWithin {
        /// The datum with the largest error.
        index: usize,
        /// Its error.
        distance: f64,
        /// What is allowed.
        tolerance: f64,
    },
    /// The equations cannot be solved: a number overflows.
    #[error("the equations cannot be solved: a number overflows")]
    Singular,
    /// The progress callback asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl Classify for FairError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::Fit(error) => error.kind(),
            Self::Family | Self::Rational => ErrorKind::WrongKind,
            Self::CurvatureJumps { .. } | Self::NotWithin { .. } => ErrorKind::InvalidArgument,
            Self::Outside { .. } => ErrorKind::Outside,
            Self::Singular => ErrorKind::Singular,
            Self::Cancelled(_) => ErrorKind::Cancelled,
        }
    }

    /// The offending datum.
    fn index(&self) -> Option<usize> {
        match self {
            Self::Fit(error) => error.index(),
            Self::Outside { index } | Self::NotWithin { index, .. } => Some(*index),
            _ => None,
        }
    }
}
