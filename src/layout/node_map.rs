//! Where the nodes of a mesh lie on a layout.

use super::Place;

/// A place on a layout for each node of a mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct NodeMap {
    places: Vec<Option<Place>>,
}

impl NodeMap {
    /// From places by node; none for nodes without triangles.
    pub fn new(places: Vec<Option<Place>>) -> Self {
        Self { places }
    }

    /// By node; none for a node without triangles.
    pub fn places(&self) -> &[Option<Place>] {
        &self.places
    }

    /// The place of a node.
    pub fn place(&self, node: u32) -> Option<Place> {
        self.places[node as usize]
    }
}
