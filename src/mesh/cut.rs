//! Cutting meshes: removing faces, splitting components, opening along paths of edges.

use super::{Mesh, MeshError};
use crate::error::ErrorKind;

/// A mesh cannot be cut as asked.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CutError {
    /// What is left is no mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}

impl CutError {
    /// The class of the error.
    pub fn kind(&self) -> ErrorKind {
        match self {
            Self::Mesh(error) => error.kind(),
        }
    }

    /// The offender.
    pub fn index(&self) -> Option<usize> {
        match self {
            Self::Mesh(error) => error.index(),
        }
    }
}

/// A mesh made from another.
#[derive(Debug, Clone, PartialEq)]
pub struct Piece {
    /// The mesh.
    pub mesh: Mesh,
    /// The old number of each of its nodes.
    pub nodes: Vec<u32>,
}
