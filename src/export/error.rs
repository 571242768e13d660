//! What can go wrong when a file is written.

use crate::failure::{Classify, ErrorKind};
use std::path::Path;

/// A file cannot be written.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ExportError {
    /// The system refused.
    #[error("cannot write {path}: {reason}")]
    File {
        /// The file.
        path: String,
        /// What the system said.
        reason: String,
    },
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
            Self::File { .. } => ErrorKind::File,
            _ => ErrorKind::InvalidArgument,
        }
    }
}

/// Writes a whole file: first beside it, then in its place, so that a reader never sees half of it and a
/// failure leaves what was there.
pub fn write_file(path: &Path, bytes: &[u8]) -> Result<(), ExportError> {
    let fail = |error: std::io::Error| ExportError::File {
        path: path.display().to_string(),
        reason: error.to_string(),
    };
    let mut name = path.file_name().unwrap_or_default().to_os_string();
    name.push(format!(".{}.part", std::process::id()));
    let beside = path.with_file_name(name);
    let written = std::fs::write(&beside, bytes).and_then(|()| std::fs::rename(&beside, path));
    written.map_err(|error| {
        // nothing more can be done if this fails too
        let _ = std::fs::remove_file(&beside);
        fail(error)
    })
}
