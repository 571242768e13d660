//! Why a mesh cannot be mapped on to the sphere.

use crate::control::Cancelled;
use crate::failure::{Classify, ErrorKind};

/// A mesh has no map on to the sphere.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum SphereError {
    /// The mesh falls apart.
    #[error("the mesh has {count} components; split it and map each of them")]
    Components {
        /// How many.
        count: usize,
    },
    /// The mesh has a boundary.
    #[error(
        "the mesh has {loops} boundary loops, one through node {node}; only closed meshes have a sphere's shape"
    )]
    Open {
        /// How many loops.
        loops: usize,
        /// The first node of the longest.
        node: usize,
    },
    /// The surface touches itself in a node.
    #[error("the surface touches itself in node {node}; use two nodes there")]
    Pinched {
        /// The node.
        node: usize,
    },
    /// The mesh has handles.
    #[error("the mesh has genus {genus}, a sphere has 0; use a layout of patches instead")]
    Genus {
        /// Number of handles.
        genus: usize,
    },
    /// No triangle has an area.
    #[error("all {count} triangles have zero area")]
    ZeroArea {
        /// Number of triangles.
        count: usize,
    },
    /// The collapses end early: a limit of rounding or of shape that no mesh is known to reach.
    #[error("the mesh cannot be made coarser than {count} nodes, one of them {node}")]
    Stuck {
        /// Nodes left.
        count: usize,
        /// The first of them.
        node: usize,
    },
    /// Rounding leaves no place for a node between its neighbours.
    #[error("the map has no room for node {node}: the mesh is stretched there beyond the digits of a double")]
    NoRoom {
        /// The node.
        node: usize,
    },
    /// The listener asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl Classify for SphereError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::Components { .. } | Self::Open { .. } | Self::Pinched { .. } | Self::Genus { .. } => {
                ErrorKind::Topology
            }
            Self::ZeroArea { .. } | Self::Stuck { .. } | Self::NoRoom { .. } => ErrorKind::Degenerate,
            Self::Cancelled(_) => ErrorKind::Cancelled,
        }
    }

    /// The offending node, if one is to blame.
    fn index(&self) -> Option<usize> {
        match *self {
            Self::Open { node, .. }
            | Self::Pinched { node }
            | Self::Stuck { node, .. }
            | Self::NoRoom { node } => Some(node),
            _ => None,
        }
    }
}
