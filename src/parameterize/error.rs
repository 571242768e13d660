//! Why a mesh cannot get its parameters.

use crate::control::Cancelled;
use crate::failure::{Classify, ErrorKind};
use crate::linalg::LuError;

/// A mesh cannot be parameterized as asked.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ParameterizeError {
    /// The mesh has no boundary.
    #[error(
        "the mesh is closed; make a model of it (planish_model_fit), or cut it open along a path of edges first"
    )]
    Closed,
    /// The mesh falls apart.
    #[error("the mesh has {count} components; split it and parameterize each of them")]
    Components {
        /// How many.
        count: usize,
    },
    /// The mesh has handles.
    #[error("the mesh has genus {genus}; cut its handles open first")]
    Genus {
        /// Number of handles.
        genus: usize,
    },
    /// The surface touches itself in a node.
    #[error("the surface touches itself in node {node}; the repair 'touching' makes two nodes of it")]
    Pinched {
        /// The node.
        node: usize,
    },
    /// No triangle has an area.
    #[error("all {count} triangles have zero area")]
    ZeroArea {
        /// Number of triangles.
        count: usize,
    },
    /// The triangles around a node have no area, or weights that cancel.
    #[error("the weights of node {node} sum to {total}: the triangles around it are degenerate")]
    ZeroWeight {
        /// The node.
        node: usize,
        /// Sum of its weights.
        total: f64,
    },
    /// No path of triangles with area leads from a node to the boundary.
    #[error("nothing ties node {node} to the boundary: the triangles between them have zero area")]
    Untied {
        /// The node.
        node: usize,
    },
    /// The unrolled map folds or overlaps itself.
    #[error("the shape cannot be unrolled without folds; use another border")]
    CannotUnroll,
    /// The border has no length.
    #[error("the boundary loop of {count} nodes has zero length")]
    ZeroBorder {
        /// Nodes of the loop.
        count: usize,
    },
    /// A square needs four corners.
    #[error("a square border needs 4 nodes, the boundary loop has {count}")]
    ShortBorder {
        /// Nodes of the loop.
        count: usize,
    },
    /// A corner asked for is not on the longest boundary loop, or out of order there.
    #[error("corner node {node} is not on the longest boundary loop, or not in its order")]
    Corner {
        /// The node.
        node: usize,
    },
    /// Kept borders and regularization start from given parameters.
    #[error("the mesh has no given parameters to start from")]
    NoParameters,
    /// The given parameters span no area.
    #[error("the given parameters span no area")]
    FlatParameters,
    /// An option is out of its range.
    #[error("option {name} is {value}, allowed are {allowed}")]
    Option {
        /// Name of the option.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// Weights of nodes must be positive numbers, one for each node.
    #[error("node weight {index} is missing, or not a positive number")]
    NodeWeight {
        /// The first offender.
        index: usize,
    },
    /// The linear system has no solution; `index` is the node.
    #[error("the equations of node {node} are singular")]
    Singular {
        /// The node.
        node: usize,
    },
    /// The linear system is not what it should be.
    #[error(transparent)]
    Lu(LuError),
    /// The progress callback asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl Classify for ParameterizeError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::Closed | Self::Components { .. } | Self::Genus { .. } | Self::Pinched { .. } => {
                ErrorKind::Topology
            }
            Self::ShortBorder { .. } => ErrorKind::Topology,
            Self::ZeroArea { .. } | Self::ZeroWeight { .. } | Self::Untied { .. } => ErrorKind::Degenerate,
            Self::ZeroBorder { .. } | Self::FlatParameters | Self::CannotUnroll => ErrorKind::Degenerate,
            Self::Corner { .. } | Self::NoParameters | Self::Option { .. } | Self::NodeWeight { .. } => {
                ErrorKind::InvalidArgument
            }
            Self::Singular { .. } => ErrorKind::Singular,
            Self::Lu(error) => error.kind(),
            Self::Cancelled(_) => ErrorKind::Cancelled,
        }
    }

    /// The offending node, if one is to blame.
    fn index(&self) -> Option<usize> {
        self.clone().node_mut().copied()
    }
}

impl ParameterizeError {
    /// The offending node, to be told in other numbers.
    pub(crate) fn node_mut(&mut self) -> Option<&mut usize> {
        match self {
            Self::Pinched { node }
            | Self::ZeroWeight { node, .. }
            | Self::Untied { node }
            | Self::Corner { node }
            | Self::NodeWeight { index: node }
            | Self::Singular { node } => Some(node),
            _ => None,
        }
    }
}
