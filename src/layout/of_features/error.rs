//! Why a layout over regions cannot be made.

use super::super::LayoutError;
use crate::control::Cancelled;
use crate::failure::{Classify, ErrorKind};
use crate::layout::mesh_layout::MeshLayoutError;
use crate::mesh::{CutError, MeshError};

/// Regions have no layout.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FeatureLayoutError {
    /// There must be one answer for each region.
    #[error("{given} answers do not fit {count} regions")]
    RegionCount {
        /// Answers given.
        given: usize,
        /// Regions of the mesh.
        count: usize,
    },
    /// No region gets patches.
    #[error("no region is to get patches")]
    NoPatches,
    /// A region cannot be filled with quads.
    #[error("region {region} cannot be filled with quads; divide it by another sharp edge")]
    NoLayout {
        /// The region.
        region: usize,
    },
    /// A region cannot be cut out of the mesh.
    #[error(transparent)]
    Cut(#[from] CutError),
    /// The regions make no mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The quads make no layout.
    #[error(transparent)]
    Layout(#[from] LayoutError),
    /// The nodes have no places on the quads.
    #[error(transparent)]
    Places(#[from] MeshLayoutError),
    /// The listener asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl Classify for FeatureLayoutError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::RegionCount { .. } | Self::NoPatches => ErrorKind::InvalidArgument,
            Self::NoLayout { .. } => ErrorKind::Degenerate,
            Self::Cut(error) => error.kind(),
            Self::Mesh(error) => error.kind(),
            Self::Layout(error) => error.kind(),
            Self::Places(error) => error.kind(),
            Self::Cancelled(_) => ErrorKind::Cancelled,
        }
    }

    /// The offending region.
    fn index(&self) -> Option<usize> {
        match *self {
            Self::NoLayout { region } => Some(region),
            Self::Cut(ref error) => error.index(),
            Self::Mesh(ref error) => error.index(),
            Self::Places(ref error) => error.index(),
            _ => None,
        }
    }
}
