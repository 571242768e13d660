//! Why no trims follow curves.

use crate::control::Cancelled;
use crate::failure::{Classify, ErrorKind};
use crate::fit::common::FitError;
use crate::query::project::ProjectError;
use crate::surface::TrimError;

/// No trims follow the curves. Curves are counted through all loops.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CurveTrimError {
    /// An option will not do.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// There are no loops.
    #[error("no loops of curves are given")]
    NoLoops,
    /// A loop has no curves.
    #[error("loop {index} has no curves")]
    NoCurves {
        /// The loop.
        index: usize,
    },
    /// The surface is no shape in space.
    #[error("the surface has dimension {dim}, curves in space need one of dimension 3")]
    SurfaceDimension {
        /// Its dimension.
        dim: usize,
    },
    /// A curve is none in space.
    #[error("curve {curve} has dimension {dim}, it needs 3")]
    CurveDimension {
        /// The curve.
        curve: usize,
        /// Its dimension.
        dim: usize,
    },
    /// A loop does not end where it begins, or two of its curves do not meet.
    #[error(
        "the loop is not closed: curve {curve} ends {gap:e} from where curve {next} begins, more than the tolerance {tolerance:e}"
    )]
    Open {
        /// The curve before the gap.
        curve: usize,
        /// The curve behind it; the same for a loop of one curve.
        next: usize,
        /// The gap.
        gap: f64,
        /// What is allowed.
        tolerance: f64,
    },
    /// A curve is farther from the surface than the tolerance.
    #[error(
        "curve {curve} is {distance:e} from the surface at its parameter {parameter}, more than the tolerance {tolerance:e}"
    )]
    TooFar {
        /// The curve.
        curve: usize,
        /// Its parameter with the largest distance found.
        parameter: f64,
        /// The distance.
        distance: f64,
        /// What is allowed.
        tolerance: f64,
    },
    /// However short its sides, the loop does not come near the curve.
    #[error(
        "the loop stays {distance:e} from curve {curve} near its parameter {parameter}, more than the tolerance \
         {tolerance:e}, however finely it is divided: a seam or a fold of the surface, or a gap between curves, is in the way"
    )]
    Unreached {
        /// The curve.
        curve: usize,
        /// Its parameter there.
        parameter: f64,
        /// The distance.
        distance: f64,
        /// What is allowed.
        tolerance: f64,
    },
    /// A loop is no polygon: its curves are a point on the surface, or run back on themselves.
    #[error("loop {index} has fewer than three different places on the surface")]
    Thin {
        /// The loop.
        index: usize,
    },
    /// Two trims meet, or one meets itself.
    #[error("trim {second} meets {} near u, v = {u}, {v}", met(.first, .second))]
    Crossing {
        /// The trim with the smaller number.
        first: usize,
        /// The other; the same for one that meets itself.
        second: usize,
        /// Where.
        u: f64,
        /// Where.
        v: f64,
    },
    /// The curves cannot be projected.
    #[error(transparent)]
    Project(#[from] ProjectError),
    /// A trim is not one.
    #[error(transparent)]
    Trim(#[from] TrimError),
    /// The caller asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// What a trim meets.
fn met(first: &usize, second: &usize) -> String {
    if first == second { "itself".to_owned() } else { format!("trim {first}") }
}

impl Classify for CurveTrimError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::Fit(error) => error.kind(),
            Self::NoLoops
            | Self::NoCurves { .. }
            | Self::SurfaceDimension { .. }
            | Self::CurveDimension { .. }
            | Self::Open { .. }
            | Self::TooFar { .. } => ErrorKind::InvalidArgument,
            Self::Unreached { .. } | Self::Crossing { .. } => ErrorKind::Topology,
            Self::Thin { .. } => ErrorKind::Degenerate,
            Self::Project(error) => error.kind(),
            Self::Trim(error) => error.kind(),
            Self::Cancelled(_) => ErrorKind::Cancelled,
        }
    }

    /// The offending curve; the loop or trim where none is to blame alone.
    fn index(&self) -> Option<usize> {
        match *self {
            Self::CurveDimension { curve, .. }
            | Self::Open { curve, .. }
            | Self::TooFar { curve, .. }
            | Self::Unreached { curve, .. } => Some(curve),
            Self::NoCurves { index } | Self::Thin { index } => Some(index),
            Self::Crossing { second, .. } => Some(second),
            Self::Trim(ref error) => error.index(),
            _ => None,
        }
    }
}
