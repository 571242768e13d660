//! What can be wrong with a model.

use crate::curve::CurveError;
use crate::failure::{Classify, ErrorKind};
use crate::geometry::Axis;
use crate::knots::KnotError;
use crate::surface::tensor::TensorError;
use crate::surface::{ConvertError, TrimError};

/// Parts do not make a model, or a surface has none.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ModelError {
    /// Only surfaces in space bound anything.
    #[error(
        "values have dimension {dim}, a face needs curves and surfaces in space and p-curves in the plane"
    )]
    Dimension {
        /// The dimension.
        dim: usize,
    },
    /// There is nothing.
    #[error("a model has at least one face")]
    NoFaces,
    /// A place is NaN or infinite.
    #[error("vertex {vertex} is not finite")]
    NotFinite {
        /// The vertex.
        vertex: usize,
    },
    /// A part refers to one that does not exist.
    #[error("{part} {index} refers to a part that the model does not have")]
    NoSuch {
        /// What it is.
        part: &'static str,
        /// Its number.
        index: usize,
    },
    /// A face without a bound, or a bound without an edge.
    #[error("face {face} has no loop, or one without edges")]
    EmptyLoop {
        /// The face.
        face: usize,
    },
    /// A loop does not close.
    #[error("loop {bound} of face {face} is open: edge {place} of it does not end where the next begins")]
    OpenLoop {
        /// The face.
        face: usize,
        /// The loop.
        bound: usize,
        /// The place in the loop.
        place: usize,
    },
    /// Where an edge lies on a spline does not follow from its curve in space.
    #[error("face {face} lies on a spline, so its edge {edge} needs a p-curve")]
    NoPcurve {
        /// The face.
        face: usize,
        /// The edge.
        edge: usize,
    },
    /// A p-curve has other parameters than its edge.
    #[error("the p-curve of edge {edge} in face {face} is not over the parameters of the edge's curve")]
    PcurveDomain {
        /// The face.
        face: usize,
        /// The edge.
        edge: usize,
    },
    /// An edge has one face on each side at most.
    #[error("two faces run along edge {edge} in the same direction")]
    SharedTwice {
        /// The edge.
        edge: usize,
    },
    /// An edge bounds nothing.
    #[error("edge {edge} is in no loop")]
    Unused {
        /// The edge.
        edge: usize,
    },
    /// Every face is in one shell.
    #[error("face {face} is in no shell, or in several")]
    Shells {
        /// The face.
        face: usize,
    },
    /// Faces that share an edge belong together.
    #[error("the faces beside edge {edge} are in different shells")]
    BetweenShells {
        /// The edge.
        edge: usize,
    },
    /// A solid has no hole in its skin.
    #[error("shell {shell} bounds a solid, but only one face has its edge {edge}")]
    FreeEdge {
        /// The shell.
        shell: usize,
        /// The edge.
        edge: usize,
    },
    /// A surface with a gap is no face.
    #[error("knot {index} along {axis:?} occurs more than {degree} times inside the domain")]
    Torn {
        /// The direction.
        axis: Axis,
        /// The first of the equal knots.
        index: usize,
        /// The degree: so many are allowed.
        degree: usize,
    },
    /// Nothing is known of where the model comes from.
    #[error("no fit made the model, so it knows of no nodes")]
    NotFitted,
    /// The face lies on a plane or cylinder.
    #[error("face {face} lies on no spline surface")]
    NoSpline {
        /// The face.
        face: usize,
    },
    /// Bounds of a face must not meet.
    #[error("trim {index} crosses or touches itself or another near ({u}, {v})")]
    Crossing {
        /// The loop.
        index: usize,
        /// Where.
        u: f64,
        /// Where.
        v: f64,
    },
    /// A loop has fewer than three different points.
    #[error("trim {index} encloses no area")]
    Empty {
        /// The loop.
        index: usize,
    },
    /// A face is in one piece.
    #[error("the trims bound {count} separate pieces, a face has one")]
    Pieces {
        /// Loops that bound a piece from outside.
        count: usize,
    },
    /// A loop is a point in space.
    #[error("bound {index} is a single point in space")]
    Collapsed {
        /// The loop, the outer one first.
        index: usize,
    },
    /// Numbers overflow.
    #[error("the surface is too large or too small for its size to be computed: its diagonal is {diagonal}")]
    Size {
        /// Diagonal of its box.
        diagonal: f64,
    },
    /// The knots of a curve on the surface are none: parameters too close for double precision.
    #[error("a curve on the surface has no knots: {0}")]
    Knots(#[from] KnotError),
    /// A curve on the surface is none: numbers overflow.
    #[error("a curve on the surface cannot be computed: {0}")]
    Curve(#[from] CurveError),
    /// A surface under a face is none: numbers overflow.
    #[error("a face is no surface of its own: {0}")]
    Tensor(#[from] TensorError),
    /// A loop leaves the domain of its surface.
    #[error("a loop is no trim of its surface: {0}")]
    Trim(#[from] TrimError),
    /// The surface is no tensor surface of a size that is allowed.
    #[error(transparent)]
    Convert(#[from] ConvertError),
}

impl Classify for ModelError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::NotFinite { .. } => ErrorKind::NotFinite,
            Self::NoSuch { .. } => ErrorKind::Index,
            Self::Dimension { .. } | Self::NoPcurve { .. } | Self::PcurveDomain { .. } => {
                ErrorKind::InvalidArgument
            }
            Self::Empty { .. } | Self::Collapsed { .. } | Self::Size { .. } => ErrorKind::Degenerate,
            // numbers overflow, or parameters are too close for double precision
            Self::Knots(_) | Self::Curve(_) | Self::Tensor(_) => ErrorKind::Degenerate,
            Self::NoSpline { .. } | Self::NotFitted => ErrorKind::WrongKind,
            Self::Trim(error) => error.kind(),
            Self::Convert(error) => error.kind(),
            _ => ErrorKind::Topology,
        }
    }

    /// The offending part.
    fn index(&self) -> Option<usize> {
        match *self {
            Self::NotFinite { vertex: index }
            | Self::NoSuch { index, .. }
            | Self::EmptyLoop { face: index }
            | Self::OpenLoop { face: index, .. }
            | Self::NoPcurve { edge: index, .. }
            | Self::PcurveDomain { edge: index, .. }
            | Self::SharedTwice { edge: index }
            | Self::Unused { edge: index }
            | Self::Shells { face: index }
            | Self::BetweenShells { edge: index }
            | Self::FreeEdge { edge: index, .. }
            | Self::Torn { index, .. }
            | Self::NoSpline { face: index }
            | Self::Crossing { index, .. }
            | Self::Empty { index } => Some(index),
            _ => None,
        }
    }
}
