//! Triangle meshes: construction, topology, files, cutting.

use crate::error::ErrorKind;
use glam::{DVec2, DVec3};

/// A mesh is not one. (stub: being written)
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MeshError {
    /// An index is out of range.
    #[error("triangle {triangle} refers to node {node}, but there are only {count}")]
    IndexOutOfRange { triangle: usize, node: u32, count: usize },
}
impl MeshError {
    pub fn kind(&self) -> ErrorKind {
        ErrorKind::Index
    }
    pub fn index(&self) -> Option<usize> {
        None
    }
}
/// A mesh file cannot be read. (stub: being written)
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ReadError {
    /// Unknown.
    #[error("unknown format")]
    Unknown,
}
impl ReadError {
    pub fn kind(&self) -> ErrorKind {
        ErrorKind::Format
    }
    pub fn index(&self) -> Option<usize> {
        None
    }
}

/// A manifold, consistently oriented triangle mesh.
#[derive(Debug, Clone)]
pub struct Mesh {
    points: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    parameters: Option<Vec<DVec2>>,
}

impl Mesh {
    /// From arrays.
    pub fn new(points: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        Ok(Self { points, triangles, parameters: None })
    }
    /// The nodes.
    pub fn points(&self) -> &[DVec3] {
        &self.points
    }
    /// Three nodes each, counter-clockwise seen from outside.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }
    /// The (u,v) of each node, if it has them.
    pub fn parameters(&self) -> Option<&[DVec2]> {
        self.parameters.as_deref()
    }
    /// Boundary loops in order, the interior on the left; the longest (in space) first.
    pub fn loops(&self) -> &[Vec<u32>] {
        &[]
    }
}
