//! Why a surface cannot be tessellated.

use crate::control::Cancelled;
use crate::failure::{Classify, ErrorKind};
use crate::mesh::MeshError;

/// A surface cannot be tessellated as asked.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TessellateError {
    /// Only surfaces in space have a shape.
    #[error("a surface of dimension {dim} has no shape, dimension 3 is needed")]
    Dimension {
        /// Dimension of the surface.
        dim: usize,
    },
    /// An option is out of its range.
    #[error("{option} is {value}, it must be finite and not negative")]
    Option {
        /// Name of the option.
        option: &'static str,
        /// Its value.
        value: f64,
    },
    /// Too many nodes would be needed.
    #[error("more than {limit} nodes would be needed")]
    TooLarge {
        /// The limit.
        limit: usize,
    },
    /// The trims cross each other or themselves.
    #[error("the trims cross near ({u}, {v})")]
    CrossingTrims {
        /// Where.
        u: f64,
        /// Where.
        v: f64,
    },
    /// The trims enclose nothing.
    #[error("the trims enclose no area")]
    Empty,
    /// The triangles are no mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The caller asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl Classify for TessellateError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::Dimension { .. } | Self::Option { .. } => ErrorKind::InvalidArgument,
            Self::TooLarge { .. } => ErrorKind::TooLarge,
            Self::CrossingTrims { .. } => ErrorKind::Topology,
            Self::Empty => ErrorKind::Degenerate,
            Self::Mesh(error) => error.kind(),
            Self::Cancelled(_) => ErrorKind::Cancelled,
        }
    }
}
