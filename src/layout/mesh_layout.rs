//! Layouts of meshes: what is asked for, what comes of it, and why there may be none.

use super::{Layout, LayoutError, NodeMap};
use crate::control::Cancelled;
use crate::failure::{Classify, ErrorKind};
use crate::mesh::MeshError;
use crate::options::with_fields;
use crate::parameterize::sphere::SphereError;

/// Which layout a mesh gets.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum LayoutKind {
    /// The cube for closed meshes of genus 0, else the base complex.
    #[default]
    Auto,
    /// The six faces of a cube: closed meshes of genus 0 only.
    Cube,
    /// Quads made of pairs of triangles of the coarse mesh.
    Complex,
}

/// How a layout is made for a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MeshLayoutOptions {
    /// Which layout. Default: the cube where there is one.
    pub kind: LayoutKind,
    /// About how many patches a base complex has: limbs take some away, a shape that needs more gets them. Default 40.
    pub patches: usize,
    /// Most sweeps over all nodes at the end. Default 300; they end before where nothing is gained.
    pub sweeps: usize,
}

impl Default for MeshLayoutOptions {
    fn default() -> Self {
        Self { kind: LayoutKind::Auto, patches: 40, sweeps: 300 }
    }
}

impl MeshLayoutOptions {
    with_fields! {
        with_kind kind: LayoutKind,
        with_patches patches: usize,
        with_sweeps sweeps: usize,
    }
}

/// How good a layout is and what it took.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeshLayoutReport {
    /// The kind that was made.
    pub kind: LayoutKind,
    /// Symmetric Dirichlet energy of the node map by area: 4 for an isometry; of a cube that of the map to the sphere.
    pub energy: f64,
    /// The same before nodes moved over the layout; of a cube the same number.
    pub first_energy: f64,
    /// Nodes with a triangle whose image is turned over.
    pub folded_nodes: usize,
    /// Nodes whose triangles are spread over quads that have no common corner: fewer patches, or more nodes, help.
    pub spread_nodes: usize,
    /// Vertices of only two quads that were removed, each with one patch.
    pub doublets: usize,
    /// Edges of the coarse mesh that were split because its triangles could not be paired; each adds a patch or half of one.
    pub splits: usize,
    /// Wall time.
    pub seconds: f64,
}

/// A layout with the places of a mesh's nodes.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshLayout {
    /// The patches.
    pub layout: Layout,
    /// Where the nodes lie on them.
    pub map: NodeMap,
    /// How good both are.
    pub report: MeshLayoutReport,
}

/// A mesh has no layout of the kind asked for.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MeshLayoutError {
    /// The mesh falls apart.
    #[error("the mesh has {count} components; split it and make a layout for each of them")]
    Components {
        /// How many.
        count: usize,
    },
    /// The surface touches itself in a node.
    #[error("the surface touches itself in node {node}; use two nodes there")]
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
    /// Too few patches were asked for, or more than the mesh can tell.
    #[error("patches is {given}, it must be from {least} to {most} for this mesh")]
    Patches {
        /// How many were asked for.
        given: usize,
        /// The least.
        least: usize,
        /// The most.
        most: usize,
    },
    /// The triangles cannot be paired to quads that make a layout.
    #[error("{triangles} triangles of the coarse mesh make no layout; ask for another number of patches")]
    NoPairing {
        /// Number of triangles.
        triangles: usize,
    },
    /// The mesh cannot be mapped on to the sphere.
    #[error(transparent)]
    Sphere(#[from] SphereError),
    /// The border cannot be closed while the layout is made.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The quads make no layout.
    #[error(transparent)]
    Layout(#[from] LayoutError),
    /// The listener asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl Classify for MeshLayoutError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::Components { .. } | Self::Pinched { .. } => ErrorKind::Topology,
            Self::ZeroArea { .. } | Self::NoPairing { .. } => ErrorKind::Degenerate,
            Self::Patches { .. } => ErrorKind::InvalidArgument,
            Self::Sphere(error) => error.kind(),
            Self::Mesh(error) => error.kind(),
            Self::Layout(error) => error.kind(),
            Self::Cancelled(_) => ErrorKind::Cancelled,
        }
    }

    /// The offending node, if one is to blame.
    fn index(&self) -> Option<usize> {
        match *self {
            Self::Pinched { node } => Some(node),
            Self::Sphere(error) => error.index(),
            _ => None,
        }
    }
}
