//! What can be wrong with a layout.

use crate::failure::{Classify, ErrorKind};

/// Quads do not make a layout.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum LayoutError {
    /// No quads.
    #[error("a layout needs at least one quad")]
    Empty,
    /// Too many quads.
    #[error("{quads} quads are more than the {limit} that a layout may have")]
    TooLarge {
        /// Number of quads.
        quads: usize,
        /// Most that are possible.
        limit: usize,
    },
    /// The numbers of vertices are far apart.
    #[error("vertices are numbered up to {vertices}, but the quads have at most {limit} corners")]
    VertexNumbers {
        /// One more than the largest number.
        vertices: usize,
        /// Corners of all quads.
        limit: usize,
    },
    /// The lists differ in length.
    #[error("{edges} quads have edge numbers, but there are {quads} quads")]
    EdgeCount {
        /// Number of quads.
        quads: usize,
        /// Length of the list of edges.
        edges: usize,
    },
    /// A quad has a vertex twice.
    #[error("quad {quad} has a vertex twice")]
    RepeatedVertex {
        /// The quad.
        quad: usize,
    },
    /// An edge of three sides.
    #[error("quad {quad} is the third at the edge from vertex {} to {}", ends[0], ends[1])]
    CrowdedEdge {
        /// The quad.
        quad: usize,
        /// The ends of the edge.
        ends: [u32; 2],
    },
    /// Neighbours have opposite senses, or the surface has one side only.
    #[error(
        "quads {other} and {quad} run the same way along the edge from vertex {} to {}; turn one around, or the \
         surface is one-sided", ends[0], ends[1]
    )]
    SameDirection {
        /// The quad.
        quad: usize,
        /// Its neighbour.
        other: usize,
        /// The ends of the edge.
        ends: [u32; 2],
    },
    /// Sides of one number with different ends.
    #[error(
        "a side of quad {quad} from vertex {} to {} has the number of an edge from {} to {}",
        ends[0], ends[1], other[0], other[1]
    )]
    EdgeEnds {
        /// The quad.
        quad: usize,
        /// The ends of its side.
        ends: [u32; 2],
        /// The ends of the edge.
        other: [u32; 2],
    },
    /// Quads touch in a vertex without a common edge.
    #[error("quads touch at vertex {vertex} without an edge between them; give each its own vertex there")]
    NonManifoldVertex {
        /// The vertex.
        vertex: u32,
    },
    /// Too few quads around an inner vertex for a tangent plane.
    #[error("vertex {vertex} lies inside and has {valence} quads around it, at least 3 are needed")]
    Valence {
        /// The vertex.
        vertex: u32,
        /// Quads around it.
        valence: usize,
    },
}

impl Classify for LayoutError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::Empty | Self::EdgeCount { .. } => ErrorKind::InvalidArgument,
            Self::VertexNumbers { .. } => ErrorKind::Index,
            Self::TooLarge { .. } => ErrorKind::TooLarge,
            _ => ErrorKind::Topology,
        }
    }

    /// The offending quad or vertex.
    fn index(&self) -> Option<usize> {
        match *self {
            Self::RepeatedVertex { quad }
            | Self::CrowdedEdge { quad, .. }
            | Self::SameDirection { quad, .. }
            | Self::EdgeEnds { quad, .. } => Some(quad),
            Self::NonManifoldVertex { vertex } | Self::Valence { vertex, .. } => Some(vertex as usize),
            Self::Empty | Self::TooLarge { .. } | Self::VertexNumbers { .. } | Self::EdgeCount { .. } => None,
        }
    }
}
