//! Why arrays are not a mesh.

use crate::failure::{Classify, ErrorKind};

/// Arrays are not a manifold, oriented triangle mesh, or something does not fit the mesh it is for.
///
/// Nodes and triangles are those of the arrays that were handed in, counted from 0, even when nodes were
/// welded before the fault was found. Polygons of a file count as the triangles they were split into.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MeshError {
    /// The array of points is empty.
    #[error("there are no points")]
    NoPoints,
    /// The array of triangles is empty.
    #[error("there are no triangles")]
    NoTriangles,
    /// More nodes than 32-bit indices can tell apart.
    #[error("{count} nodes are too many, the limit is {limit}")]
    TooManyNodes {
        /// Nodes given.
        count: usize,
        /// The largest number of nodes.
        limit: usize,
    },
    /// More triangles than 32-bit half-edges can tell apart.
    #[error("{count} triangles are too many, the limit is {limit}")]
    TooManyTriangles {
        /// Triangles given.
        count: usize,
        /// The largest number of triangles.
        limit: usize,
    },
    /// A coordinate is NaN or infinite.
    #[error("a coordinate of node {node} is not finite")]
    NotFinite {
        /// The first such node.
        node: usize,
    },
    /// A triangle refers to a node that does not exist; numbers are as the caller counts.
    #[error("triangle {triangle} refers to node {node}, but nodes run from {first} to {last}")]
    IndexOutOfRange {
        /// The first such triangle.
        triangle: usize,
        /// The index as it was given.
        node: u32,
        /// The smallest index there is: the index base.
        first: u32,
        /// The largest index there is.
        last: u64,
    },
    /// Two corners of a triangle are one node.
    #[error("triangle {triangle} has node {node} twice")]
    RepeatedNode {
        /// The first such triangle.
        triangle: usize,
        /// Its repeated node.
        node: u32,
    },
    /// Two triangles have the same three nodes, in either orientation.
    #[error("triangle {triangle} has the same nodes as triangle {first}")]
    DuplicateTriangle {
        /// The second of the two.
        triangle: usize,
        /// The first of the two.
        first: usize,
    },
    /// More than two triangles meet at an edge.
    #[error("the edge between nodes {} and {} has {triangle_count} triangles, a mesh allows two", nodes[0], nodes[1])]
    NonManifoldEdge {
        /// The ends of the edge, the smaller first.
        nodes: [u32; 2],
        /// Triangles at the edge.
        triangle_count: usize,
    },
    /// Two neighbours run along their common edge in the same direction.
    #[error(
        "triangles {} and {} run along the edge from node {} to node {} in the same direction",
        triangles[0], triangles[1], nodes[0], nodes[1]
    )]
    InconsistentOrientation {
        /// The ends of the edge, in the direction of the triangles.
        nodes: [u32; 2],
        /// The two triangles, the smaller first.
        triangles: [usize; 2],
    },
    /// No choice of orientations is consistent, as on a Moebius strip.
    #[error(
        "the surface has only one side: triangles {} and {} cannot agree at the edge between nodes {} and {}",
        triangles[0], triangles[1], nodes[0], nodes[1]
    )]
    NonOrientable {
        /// The ends of an edge where the attempt fails.
        nodes: [u32; 2],
        /// The triangles at that edge, the smaller first.
        triangles: [usize; 2],
    },
    /// The weld distance is negative, NaN or infinite.
    #[error("the weld distance {distance} is not a finite number of at least 0")]
    WeldDistance {
        /// The distance given.
        distance: f64,
    },
    /// Welding left no triangle with three different nodes.
    #[error("welding over the distance {distance} leaves no triangle")]
    NothingLeft {
        /// The weld distance.
        distance: f64,
    },
    /// There must be one parameter pair for each node.
    #[error("{given} parameter pairs do not fit {count} nodes")]
    ParameterCount {
        /// Pairs given.
        given: usize,
        /// Nodes of the mesh.
        count: usize,
    },
    /// A parameter is NaN or infinite.
    #[error("a parameter of node {node} is not finite")]
    ParameterNotFinite {
        /// The first such node.
        node: usize,
    },
    /// There must be one value of a field for each node.
    #[error("{given} values of the field '{name}' do not fit {count} nodes")]
    FieldCount {
        /// The field's name.
        name: String,
        /// Values given.
        given: usize,
        /// Nodes of the mesh.
        count: usize,
    },
}

impl Classify for MeshError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::NoPoints | Self::NoTriangles | Self::WeldDistance { .. } => ErrorKind::InvalidArgument,
            Self::ParameterCount { .. } | Self::FieldCount { .. } => ErrorKind::InvalidArgument,
            Self::TooManyNodes { .. } | Self::TooManyTriangles { .. } => ErrorKind::TooLarge,
            Self::NotFinite { .. } | Self::ParameterNotFinite { .. } => ErrorKind::NotFinite,
            Self::IndexOutOfRange { .. } => ErrorKind::Index,
            Self::RepeatedNode { .. } | Self::NothingLeft { .. } => ErrorKind::Degenerate,
            Self::DuplicateTriangle { .. } | Self::NonManifoldEdge { .. } => ErrorKind::Topology,
            Self::InconsistentOrientation { .. } | Self::NonOrientable { .. } => ErrorKind::Topology,
        }
    }

    /// The offending triangle, or the node where no single triangle is to blame.
    fn index(&self) -> Option<usize> {
        match *self {
            Self::NotFinite { node } | Self::ParameterNotFinite { node } => Some(node),
            Self::IndexOutOfRange { triangle, .. } | Self::RepeatedNode { triangle, .. } => Some(triangle),
            Self::DuplicateTriangle { triangle, .. } => Some(triangle),
            Self::NonManifoldEdge { nodes, .. } => Some(nodes[0] as usize),
            Self::InconsistentOrientation { triangles, .. } | Self::NonOrientable { triangles, .. } => {
                Some(triangles[1])
            }
            _ => None,
        }
    }
}

impl MeshError {
    /// The same fault told in the numbers of the arrays from which nodes and triangles were taken:
    /// `nodes[i]` and `triangles[i]` are the old numbers of node and triangle i.
    pub(super) fn renumbered(mut self, nodes: &[u32], triangles: &[u32]) -> Self {
        let old_triangle = |triangle: &mut usize| *triangle = triangles[*triangle] as usize;
        match &mut self {
            Self::DuplicateTriangle { triangle, first } => [triangle, first].map(old_triangle),
            Self::NonManifoldEdge { nodes: edge, .. } => {
                *edge = edge.map(|node| nodes[node as usize]);
                return self;
            }
            Self::InconsistentOrientation { nodes: edge, triangles: pair }
            | Self::NonOrientable { nodes: edge, triangles: pair } => {
                *edge = edge.map(|node| nodes[node as usize]);
                pair.each_mut().map(old_triangle)
            }
            _ => return self,
        };
        self
    }
}
