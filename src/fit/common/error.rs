//! Why data cannot be fitted, the same for every method.

use crate::control::Cancelled;
use crate::failure::{Classify, ErrorKind};
use crate::parameterize::ParameterizeError;

/// Least number of data that determine anything worth calling a surface.
pub(super) const LEAST_COUNT: usize = 3;

/// A fit is not possible.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FitError {
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
    /// Too few data.
    #[error("{count} data are too few, at least {LEAST_COUNT} are needed")]
    TooFew {
        /// Data given.
        count: usize,
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
    /// A parameter is NaN or infinite.
    #[error("the parameters of datum {index} are not finite")]
    ParametersNotFinite {
        /// The datum.
        index: usize,
    },
    /// A value is NaN or infinite.
    #[error("the values of datum {index} are not finite")]
    ValuesNotFinite {
        /// The datum.
        index: usize,
    },
    /// A weight is not a positive number.
    #[error("weight {index} is {weight}, it must be positive and finite")]
    Weight {
        /// The datum.
        index: usize,
        /// Its weight.
        weight: f64,
    },
    /// A tolerance of a datum is not positive.
    #[error("tolerance {index} is {tolerance}, it must be positive")]
    DatumTolerance {
        /// The datum.
        index: usize,
        /// Its tolerance.
        tolerance: f64,
    },
    /// A datum that is to be fixed does not exist.
    #[error("datum {index} is to be fixed, there are {count}")]
    NoSuchDatum {
        /// Its number.
        index: usize,
        /// Data given.
        count: usize,
    },
    /// A curve or a neighbour cannot be the side of the surface.
    #[error("what is given for the side of {side} {why}")]
    SideCurve {
        /// The side.
        side: &'static str,
        /// Why not.
        why: &'static str,
    },
    /// A side has both a curve and a neighbour.
    #[error("the side of {side} has both a curve and a neighbour: give one of them")]
    SideTwice {
        /// The side.
        side: &'static str,
    },
    /// A given side is not where the data are.
    #[error("the side of {side} misses datum {index} by {distance:e}, more than the tolerance {tolerance:e}")]
    SideOff {
        /// The side.
        side: &'static str,
        /// The datum that is missed most.
        index: usize,
        /// By how much.
        distance: f64,
        /// The tolerance of the fit.
        tolerance: f64,
    },
    /// Two given sides do not meet in their corner.
    #[error("the sides of {first} and {second} contradict: their ends lie {distance:e} apart")]
    SidesApart {
        /// The one.
        first: &'static str,
        /// The other.
        second: &'static str,
        /// How far apart.
        distance: f64,
    },
    /// A plane of symmetry has no direction.
    #[error("the plane of symmetry needs a finite point and a finite normal that is not zero")]
    NoPlane,
    /// The mesh is not its own mirror image.
    #[error(
        "the mesh and its mirror image lie up to {distance:e} apart, more than the tolerance {tolerance:e}: it is not symmetric"
    )]
    NotSymmetric {
        /// The largest distance of a node's image to the mesh.
        distance: f64,
        /// The tolerance of the fit.
        tolerance: f64,
    },
    /// The plane of symmetry does not part the mesh as a symmetric chart needs it.
    #[error("the plane of symmetry must cut the mesh into two halves along one line from border to border")]
    NotCutInTwo,
    /// A node that is to be fixed belongs to no triangle.
    #[error("node {index} is to be fixed, but belongs to no triangle")]
    FixedUnused {
        /// The node.
        index: usize,
    },
    /// Two fixed data lie at the same parameters and differ.
    #[error(
        "the fixed data {first} and {second} have the same parameters and lie {distance:e} apart: fix one of them"
    )]
    Contradiction {
        /// The one.
        first: usize,
        /// The other.
        second: usize,
        /// How far apart they are.
        distance: f64,
    },
    /// The method does not look at the option, which is not at its default.
    #[error("{option} is not used by {by}: leave it at its default")]
    Unused {
        /// The option.
        option: &'static str,
        /// What does not use it.
        by: &'static str,
    },
    /// The parameters are so near to one another, or so large, that knots between them are no numbers.
    #[error(
        "the parameters have a range or a size of {size:e} in {what}: scale them to between 1e-140 and 1e140"
    )]
    Range {
        /// Which of them.
        what: char,
        /// The range, or the size.
        size: f64,
    },
    /// The values are so small or so large that their squares are no numbers.
    #[error("the largest value is {largest:e}: scale the values to between 1e-140 and 1e140")]
    ValueRange {
        /// The largest size of a value.
        largest: f64,
    },
    /// All data have the same u or the same v.
    #[error("all data have {axis} = {at}: the parameter range is degenerate")]
    DegenerateRange {
        /// The parameter.
        axis: char,
        /// The one value it has.
        at: f64,
    },
    /// The data leave the surface undetermined.
    #[error("the data do not determine a surface: all lie on one line in (u,v)")]
    Singular,
    /// The mesh cannot be parameterized.
    #[error(transparent)]
    Parameterize(#[from] ParameterizeError),
    /// The progress callback asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl Classify for FitError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::Option { .. } | Self::TooFew { .. } | Self::Count { .. } => ErrorKind::InvalidArgument,
            Self::Weight { weight, .. } if weight.is_finite() => ErrorKind::InvalidArgument,
            Self::DatumTolerance { tolerance, .. } if !tolerance.is_nan() => ErrorKind::InvalidArgument,
            Self::Contradiction { .. } | Self::NoPlane | Self::NotSymmetric { .. } => {
                ErrorKind::InvalidArgument
            }
            Self::NotCutInTwo => ErrorKind::Topology,
            Self::SideCurve { .. } | Self::SideTwice { .. } => ErrorKind::InvalidArgument,
            Self::SideOff { .. } | Self::SidesApart { .. } => ErrorKind::InvalidArgument,
            Self::NoSuchDatum { .. } | Self::FixedUnused { .. } => ErrorKind::Index,
            Self::ParametersNotFinite { .. }
            | Self::ValuesNotFinite { .. }
            | Self::Weight { .. }
            | Self::DatumTolerance { .. } => ErrorKind::NotFinite,
            Self::DegenerateRange { .. } => ErrorKind::Degenerate,
            Self::Range { .. } | Self::ValueRange { .. } | Self::Unused { .. } => ErrorKind::InvalidArgument,
            Self::Singular => ErrorKind::Singular,
            Self::Parameterize(error) => error.kind(),
            Self::Cancelled(_) => ErrorKind::Cancelled,
        }
    }

    /// The offending datum.
    fn index(&self) -> Option<usize> {
        match *self {
            Self::ParametersNotFinite { index }
            | Self::ValuesNotFinite { index }
            | Self::Weight { index, .. }
            | Self::DatumTolerance { index, .. }
            | Self::NoSuchDatum { index, .. }
            | Self::FixedUnused { index }
            | Self::SideOff { index, .. }
            | Self::Contradiction { second: index, .. } => Some(index),
            Self::Parameterize(ref error) => error.index(),
            _ => None,
        }
    }
}
