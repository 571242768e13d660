//! Why a mesh does not become a model.

use crate::control::Cancelled;
use crate::failure::{Classify, ErrorKind};
use crate::fit::common::FitError;
use crate::layout::of_features::FeatureLayoutError;
use crate::layout::of_mesh::MeshLayoutError;
use crate::mesh::FeatureError;
use crate::model::ModelError;
use crate::parameterize::sphere::SphereError;
use crate::surface::g1::SpaceError;
use crate::tmesh::TMeshError;

/// A fit of a model is not possible.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ModelFitError {
    /// What every fit refuses.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// The layout needs finer cells to start from.
    #[error(transparent)]
    Space(#[from] SpaceError),
    /// Cells cannot be made.
    #[error(transparent)]
    TMesh(#[from] TMeshError),
    /// Patches need a closed mesh.
    #[error(
        "the mesh has {loops} boundary loops, one through node {node}; fit it as one chart, or close it first"
    )]
    Open {
        /// How many loops.
        loops: usize,
        /// The first node of the longest.
        node: usize,
    },
    /// Too many components.
    #[error(
        "the mesh has {count} components, at most {limit} become shells of one model; take out the small ones"
    )]
    Components {
        /// How many.
        count: usize,
        /// Most that are possible.
        limit: usize,
    },
    /// Products of its lengths are no numbers.
    #[error("coordinates reach {largest:e}: take a unit in which they are between 1e-50 and 1e50")]
    Size {
        /// The largest coordinate.
        largest: f64,
    },
    /// A component encloses nothing.
    #[error("the component of node {node} encloses no volume")]
    ZeroVolume {
        /// One of its nodes.
        node: usize,
    },
    /// The features cannot be found as asked.
    #[error(transparent)]
    Features(#[from] FeatureError),
    /// The mesh cannot be mapped on to the sphere.
    #[error(transparent)]
    Sphere(#[from] SphereError),
    /// The mesh gets no layout.
    #[error(transparent)]
    Layout(#[from] MeshLayoutError),
    /// Its regions get no layout.
    #[error(transparent)]
    Regions(#[from] FeatureLayoutError),
    /// The patches make no model.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// A place is not on the layout.
    #[error("the place of node {node} is not on a quad of the layout, or its parameters are outside [0, 1]")]
    Place {
        /// The node.
        node: usize,
    },
}

impl From<Cancelled> for ModelFitError {
    fn from(cancelled: Cancelled) -> Self {
        Self::Fit(FitError::Cancelled(cancelled))
    }
}

impl Classify for ModelFitError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::Fit(error) => error.kind(),
            Self::Space(error) => error.kind(),
            Self::TMesh(error) => error.kind(),
            Self::Open { .. } => ErrorKind::Topology,
            Self::Components { .. } | Self::Size { .. } => ErrorKind::TooLarge,
            Self::ZeroVolume { .. } => ErrorKind::Degenerate,
            Self::Features(error) => error.kind(),
            Self::Sphere(error) => error.kind(),
            Self::Layout(error) => error.kind(),
            Self::Regions(error) => error.kind(),
            Self::Model(error) => error.kind(),
            Self::Place { .. } => ErrorKind::InvalidArgument,
        }
    }

    /// The offending node, quad or edge.
    fn index(&self) -> Option<usize> {
        match self {
            Self::Fit(error) => error.index(),
            Self::Space(error) => error.index(),
            Self::TMesh(error) => error.index(),
            Self::Features(error) => error.index(),
            Self::Sphere(error) => error.index(),
            Self::Layout(error) => error.index(),
            Self::Regions(error) => error.index(),
            Self::Model(error) => error.index(),
            Self::Components { .. } | Self::Size { .. } => None,
            Self::Open { node, .. } | Self::ZeroVolume { node } | Self::Place { node } => Some(*node),
        }
    }
}
