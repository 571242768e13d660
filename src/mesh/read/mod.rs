//! Mesh files.

use super::{Mesh, MeshOptions, MeshRepairs};
use crate::error::{Error, ErrorKind};
use std::path::Path;

/// A mesh file cannot be read.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ReadError {
    /// The file cannot be opened or read.
    #[error("cannot read '{path}': {reason}")]
    File {
        /// The path as given.
        path: String,
        /// What the system says.
        reason: String,
    },
}

impl ReadError {
    /// The class of the error.
    pub fn kind(&self) -> ErrorKind {
        ErrorKind::File
    }

    /// The offending line or byte.
    pub fn index(&self) -> Option<usize> {
        None
    }
}

/// A format of mesh files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// OFF.
    Off,
}

/// Reads a mesh file.
pub fn read(path: &Path, _options: &MeshOptions) -> Result<(Mesh, MeshRepairs), Error> {
    Err(Error::Read(ReadError::File { path: path.display().to_string(), reason: "not yet".into() }))
}

/// Reads a mesh from memory.
pub fn read_bytes(
    _bytes: &[u8],
    _format: Format,
    _options: &MeshOptions,
) -> Result<(Mesh, MeshRepairs), Error> {
    Err(Error::Read(ReadError::File { path: String::new(), reason: "not yet".into() }))
}
