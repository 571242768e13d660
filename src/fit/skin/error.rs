//! Why rows cannot be skinned.

use crate::control::Cancelled;
use crate::curve::CurveError;
use crate::failure::{Classify, ErrorKind};
use crate::knots::KnotError;
use crate::linalg::NotPositiveDefinite;
use crate::surface::tspline::TSplineError;

/// Rows cannot be skinned.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SkinError {
    /// An option is out of its range.
    #[error("{option} is {value}, it must be {range}")]
    Option {
        /// Name of the option.
        option: &'static str,
        /// Its value.
        value: f64,
        /// What it may be.
        range: &'static str,
    },
    /// Too few rows.
    #[error("{count} rows are too few, at least {least} are needed")]
    TooFewRows {
        /// Rows given.
        count: usize,
        /// Rows needed.
        least: usize,
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
    /// A row has no points.
    #[error("row {row} has no points")]
    EmptyRow {
        /// The row.
        row: usize,
    },
    /// A coordinate is NaN or infinite.
    #[error("point {point}, in row {row}, is not finite")]
    NotFinite {
        /// The point, counted over all rows.
        point: usize,
        /// Its row.
        row: usize,
    },
    /// A slope or tangent is NaN or infinite.
    #[error("vector {index} of {what} is not finite")]
    VectorNotFinite {
        /// The array.
        what: &'static str,
        /// The vector.
        index: usize,
    },
    /// A row lies where the one before it does.
    #[error("row {row} lies on the row before it: there is no surface between the two")]
    Identical {
        /// The later of the two.
        row: usize,
    },
    /// A section curve differs from the others in its dimension.
    #[error("section curve {row} has dimension {dim}, the first one {expected}")]
    Dimension {
        /// The curve.
        row: usize,
        /// Its dimension.
        dim: usize,
        /// The dimension of the first.
        expected: usize,
    },
    /// Points cannot be interpolated: they are too large, or too uneven for double precision.
    #[error("row {row}: {error}")]
    Row {
        /// The row.
        row: usize,
        /// What is wrong.
        error: CurveError,
    },
    /// A control curve cannot be computed: numbers overflow.
    #[error("a control curve cannot be computed: {0}")]
    Curve(#[from] CurveError),
    /// The knots along v are none: rows too close for double precision.
    #[error("the rows give no knots along v: {0}")]
    Knots(#[from] KnotError),
    /// The surface cannot be put together.
    #[error(transparent)]
    Surface(#[from] TSplineError),
    /// Fewer knots along v leave the surface undetermined.
    #[error("the rows do not determine a surface with fewer knots along v")]
    Singular(#[from] NotPositiveDefinite),
    /// The progress callback asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl Classify for SkinError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::NotFinite { .. } | Self::VectorNotFinite { .. } => ErrorKind::NotFinite,
            Self::Row { error, .. } | Self::Curve(error) => error.kind(),
            Self::Knots(error) => error.kind(),
            Self::Surface(error) => error.kind(),
            Self::Identical { .. } => ErrorKind::Degenerate,
            Self::Singular(_) => ErrorKind::Singular,
            Self::Cancelled(_) => ErrorKind::Cancelled,
            _ => ErrorKind::InvalidArgument,
        }
    }

    /// The offending row, point or vector.
    fn index(&self) -> Option<usize> {
        match *self {
            Self::EmptyRow { row }
            | Self::Identical { row }
            | Self::Dimension { row, .. }
            | Self::Row { row, .. } => Some(row),
            Self::NotFinite { point, .. } => Some(point),
            Self::VectorNotFinite { index, .. } => Some(index),
            Self::Surface(ref error) => error.index(),
            _ => None,
        }
    }
}
