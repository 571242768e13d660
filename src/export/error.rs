//! What can go wrong when a file is written.

use crate::failure::{Classify, ErrorKind};
use crate::file::FileError;

/// A file cannot be written.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ExportError {
    /// The system refused.
    #[error(transparent)]
    File(#[from] FileError),
    /// The format is for shapes in space.
    #[error("a surface of dimension {dim} has no shape, dimension 3 is needed")]
    Dimension {
        /// Dimension of the surface.
        dim: usize,
    },
    /// Arrays do not fit together.
    #[error("array {name} has {count} numbers, {expected} are needed")]
    Count {
        /// The array.
        name: String,
        /// Numbers given.
        count: usize,
        /// Numbers needed.
        expected: usize,
    },
}

impl Classify for ExportError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::File(error) => error.kind(),
            _ => ErrorKind::InvalidArgument,
        }
    }
}
