//! Why arrays are not a mesh.

use super::Origins;
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
    /// A file has nodes only.
    #[error(
        "there are {count} points but no triangles: a mesh needs both, so join the points to triangles first"
    )]
    PointCloud {
        /// Points of the file.
        count: usize,
    },
    /// No triangle has three different corners.
    #[error("none of the {count} triangles has three different nodes")]
    NoArea {
        /// Triangles and faces given.
        count: usize,
    },
    /// A face has less than three corners.
    #[error(
        "{count} faces have less than three corners, the first is face {face}; the repair 'corners' leaves them out"
    )]
    FewCorners {
        /// The first such face.
        face: usize,
        /// How many there are.
        count: usize,
    },
    /// A polygon that is not convex has too many corners.
    #[error("face {face} is not convex and has {corner_count} corners, the limit is {limit}")]
    PolygonTooLarge {
        /// The face, counted from 0.
        face: usize,
        /// Its corners.
        corner_count: usize,
        /// The largest number of corners.
        limit: usize,
    },
    /// A node belongs to no triangle.
    #[error("node {node} belongs to no triangle; the repair 'unused' passes such nodes over")]
    UnusedNode {
        /// The first such node.
        node: usize,
    },
    /// Triangles meet in a node without an edge between them.
    #[error("the surface touches itself in node {node}; the repair 'touching' makes two nodes of it")]
    TouchingNode {
        /// The first such node.
        node: usize,
    },
    /// There is no component of this number.
    #[error("there is no component {component}, the mesh has {count}")]
    NoSuchComponent {
        /// The number given.
        component: u32,
        /// Components of the mesh.
        count: usize,
    },
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
    #[error("triangle {triangle} has node {node} twice; the repair 'corners' leaves it out")]
    RepeatedNode {
        /// The first such triangle.
        triangle: usize,
        /// Its repeated node.
        node: u32,
    },
    /// Two triangles have the same three nodes, in either orientation.
    #[error("triangle {triangle} has the same nodes as triangle {first}; the repair 'copies' leaves it out")]
    DuplicateTriangle {
        /// The second of the two.
        triangle: usize,
        /// The first of the two.
        first: usize,
    },
    /// More than two triangles meet at an edge.
    #[error(
        "the edge between nodes {} and {} has {triangle_count} triangles, a mesh allows two; the repair 'sheets' \
         parts them",
        nodes[0], nodes[1]
    )]
    NonManifoldEdge {
        /// The ends of the edge, the smaller first.
        nodes: [u32; 2],
        /// Triangles at the edge.
        triangle_count: usize,
    },
    /// Two neighbours run along their common edge in the same direction.
    #[error(
        "triangles {} and {} run along the edge from node {} to node {} in the same direction; the repair \
         'orientation' turns one over",
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
    /// There must be one point for each node.
    #[error("{given} points do not fit {count} nodes")]
    PointCount {
        /// Points given.
        given: usize,
        /// Nodes of the mesh.
        count: usize,
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
            Self::ParameterCount { .. } | Self::FieldCount { .. } | Self::PointCount { .. } => {
                ErrorKind::InvalidArgument
            }
            Self::PointCloud { .. } => ErrorKind::InvalidArgument,
            Self::TooManyNodes { .. } | Self::TooManyTriangles { .. } => ErrorKind::TooLarge,
            Self::PolygonTooLarge { .. } => ErrorKind::TooLarge,
            Self::NoArea { .. } | Self::FewCorners { .. } => ErrorKind::Degenerate,
            Self::NoSuchComponent { .. } => ErrorKind::Index,
            Self::UnusedNode { .. } | Self::TouchingNode { .. } => ErrorKind::Topology,
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
            Self::UnusedNode { node } | Self::TouchingNode { node } => Some(node),
            Self::FewCorners { face, .. } | Self::PolygonTooLarge { face, .. } => Some(face),
            Self::NoSuchComponent { component, .. } => Some(component as usize),
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
    /// The same fault told in the numbers of the arrays from which nodes and triangles were taken.
    pub(super) fn renumbered(mut self, origins: &Origins) -> Self {
        let old_node = |node: &mut u32| *node = origins.node(*node);
        let old_triangle = |triangle: &mut usize| *triangle = origins.triangle(*triangle as u32) as usize;
        match &mut self {
            Self::DuplicateTriangle { triangle, first } => {
                [triangle, first].into_iter().for_each(old_triangle)
            }
            Self::NonManifoldEdge { nodes, .. } => nodes.iter_mut().for_each(old_node),
            Self::InconsistentOrientation { nodes, triangles } | Self::NonOrientable { nodes, triangles } => {
                nodes.iter_mut().for_each(old_node);
                triangles.iter_mut().for_each(old_triangle);
            }
            _ => {}
        }
        self
    }
}
