//! What can be wrong with a D1RC-spline.

use crate::control::Cancelled;
use crate::failure::{Classify, ErrorKind};

/// A D1RC-spline is not one, or cannot be changed as asked.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum D1rcError {
    /// The progress callback asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// The degree is out of range.
    #[error("the degree is {degree}, it must be 1, 2 or 3")]
    Degree {
        /// The degree given.
        degree: usize,
    },
    /// Values need at least one component.
    #[error("the dimension is 0")]
    Dimension,
    /// The mesh has no (u,v).
    #[error("the control mesh has no parameters")]
    NoParameters,
    /// The mesh is not one piece in the plane.
    #[error("the control mesh is no disk, with or without holes: {reason}")]
    NotDisk {
        /// What it is instead.
        reason: &'static str,
    },
    /// A face of the parameter mesh is turned over.
    #[error("face {face} is turned over in the parameter plane")]
    Folded {
        /// The face.
        face: usize,
    },
    /// A face of the parameter mesh has no area.
    #[error("face {face} has no area in the parameter plane")]
    NoArea {
        /// The face.
        face: usize,
    },
    /// The mesh is too small for the degree.
    #[error("the control mesh has no configuration of degree {degree}")]
    NoConfiguration {
        /// The degree.
        degree: usize,
    },
    /// The configurations around a vertex do not close.
    #[error("the configurations around vertex {vertex} have no simple link, change the parameters near it")]
    NotSimple {
        /// The vertex.
        vertex: usize,
    },
    /// Knots beyond the boundary have no place.
    #[error(
        "the boundary near vertex {vertex} leaves no room for knots beyond it, take another boundary rule"
    )]
    NoRoom {
        /// The vertex.
        vertex: usize,
    },
    /// The ends of a sharp edge are not joined.
    #[error("edge {index} joins vertices {} and {}, which have no common edge", vertices[0], vertices[1])]
    NotAnEdge {
        /// Its place in the list.
        index: usize,
        /// Its ends.
        vertices: [u32; 2],
    },
    /// A vertex does not exist.
    #[error("{what} {index} is vertex {vertex}, the control mesh has {count}")]
    NoSuchVertex {
        /// The list.
        what: &'static str,
        /// The place in it.
        index: usize,
        /// The vertex given.
        vertex: u32,
        /// Vertices of the mesh.
        count: usize,
    },
    /// The rule for sharp edges does not suit the mode.
    #[error("the sharp edges of mode {mode} cannot be of rule {rule}")]
    SharpRule {
        /// The mode.
        mode: &'static str,
        /// The rule.
        rule: &'static str,
    },
    /// The weight of sharp functions is not positive.
    #[error("the sharp weight is {weight}, it must be positive and finite")]
    Weight {
        /// The weight given.
        weight: f64,
    },
    /// The angle between faces is out of range.
    #[error("the sharp angle is {angle}, it must be between 0 and pi")]
    Angle {
        /// The angle given.
        angle: f64,
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
    /// The parameters of a point are NaN or infinite.
    #[error("the parameters of point {index} are not finite")]
    PointNotFinite {
        /// The point.
        index: usize,
    },
    /// A point lies outside the domain.
    #[error("point {index} at ({u}, {v}) lies outside the domain")]
    Outside {
        /// The point.
        index: usize,
        /// Its u.
        u: f64,
        /// Its v.
        v: f64,
    },
    /// A number of a control point is NaN or infinite.
    #[error("control point {index} is not finite")]
    NotFinite {
        /// The control point.
        index: usize,
    },
}

impl Classify for D1rcError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::Cancelled(_) => ErrorKind::Cancelled,
            Self::Degree { .. } | Self::Dimension | Self::NoParameters | Self::SharpRule { .. } => {
                ErrorKind::InvalidArgument
            }
            Self::Count { .. } => ErrorKind::InvalidArgument,
            Self::Weight { weight: x } | Self::Angle { angle: x } if !x.is_finite() => ErrorKind::NotFinite,
            Self::Weight { .. } | Self::Angle { .. } => ErrorKind::InvalidArgument,
            Self::NotFinite { .. } | Self::PointNotFinite { .. } => ErrorKind::NotFinite,
            Self::Outside { .. } => ErrorKind::Outside,
            Self::NoSuchVertex { .. } => ErrorKind::Index,
            Self::NotDisk { .. } | Self::NotAnEdge { .. } | Self::NotSimple { .. } => ErrorKind::Topology,
            Self::Folded { .. } | Self::NoArea { .. } => ErrorKind::Degenerate,
            Self::NoConfiguration { .. } | Self::NoRoom { .. } => ErrorKind::Degenerate,
        }
    }

    /// The offending face, vertex, control point, or place in a list.
    fn index(&self) -> Option<usize> {
        match *self {
            Self::Folded { face } | Self::NoArea { face } => Some(face),
            Self::NotSimple { vertex } | Self::NoRoom { vertex } => Some(vertex),
            Self::NotAnEdge { index, .. } | Self::NoSuchVertex { index, .. } => Some(index),
            Self::NotFinite { index } | Self::PointNotFinite { index } => Some(index),
            Self::Outside { index, .. } => Some(index),
            _ => None,
        }
    }
}
