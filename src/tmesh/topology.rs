//! Leaves, vertices and hosts of a T-mesh as tables, in orders that do not depend on its history.

use super::cell::{EDGES, QUADRANTS, Vertex};
use super::mesh::{NodeId, Role, TMesh};
use crate::geometry::Axis;
use crate::memory::{self, CollectVec};

/// What a vertex of the tables is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum VertexKind {
    /// Basis vertex of this rank.
    Basis(u32),
    /// It lies inside an edge of a leaf.
    Hanging(Hanging),
}

/// A T-vertex.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Hanging {
    /// The leaf whose edge it lies in.
    pub host: u32,
    /// Direction of that edge.
    pub axis: Axis,
    /// The vertices at the ends of the edge.
    pub ends: [u32; 2],
}

/// The tables of one mesh.
#[derive(Debug, Clone)]
pub struct Topology {
    /// The node of each leaf, in the order of [`TMesh::leaves`].
    pub leaves: Vec<NodeId>,
    /// The vertices at the corners of each leaf, in the order of the quadrants.
    pub corners: Vec<[u32; 4]>,
    /// All vertices in their order.
    pub vertices: Vec<Vertex>,
    /// What each of them is.
    pub kinds: Vec<VertexKind>,
    /// The vertex of each basis rank, in order.
    pub basis: Vec<u32>,
    /// T-vertices in an order in which the ends of an edge come before what lies in it.
    pub hanging: Vec<u32>,
    leaf_of_node: Vec<u32>,
}

impl Topology {
    /// Derives the tables: time n log n.
    pub fn new(mesh: &TMesh) -> Self {
        let leaves: Vec<NodeId> = mesh.leaves().collect_vec();
        let mut leaf_of_node = memory::filled(u32::MAX, mesh.node_count());
        leaves.iter().enumerate().for_each(|(leaf, node)| leaf_of_node[node.index()] = leaf as u32);
        let mut incidences: Vec<(Vertex, u32)> = leaves
            .iter()
            .zip((0..).step_by(4))
            .flat_map(|(&node, first)| mesh.cell(node).corners().into_iter().zip(first..))
            .collect_vec();
        incidences.sort_unstable();
        let mut tables = Self {
            corners: memory::filled([0; 4], leaves.len()),
            leaves,
            vertices: Vec::new(),
            kinds: Vec::new(),
            basis: Vec::new(),
            hanging: Vec::new(),
            leaf_of_node,
        };
        for around in incidences.chunk_by(|a, b| a.0 == b.0) {
            let (number, vertex) = (tables.vertices.len() as u32, around[0].0);
            for &(_, corner) in around {
                tables.corners[corner as usize / 4][corner as usize % 4] = number;
            }
            if around.len() == QUADRANTS.len() || mesh.is_border(vertex) {
                let basis = VertexKind::Basis(tables.basis.len() as u32);
                memory::push(&mut tables.kinds, basis);
                memory::push(&mut tables.basis, number);
            } else {
                // the host is looked up below, when all corners have their numbers
                memory::push(&mut tables.kinds, VertexKind::Basis(u32::MAX));
                memory::push(&mut tables.hanging, number);
            }
            memory::push(&mut tables.vertices, vertex);
        }
        tables.find_hosts(mesh);
        tables
    }

    fn find_hosts(&mut self, mesh: &TMesh) {
        for &number in &self.hanging {
            let vertex = self.vertices[number as usize];
            let Role::Hanging(node) = mesh.role(vertex) else { unreachable!("{vertex:?} has no host") };
            let host = self.leaf_of_node[node.index()];
            let corners = mesh.cell(node).corners();
            let lies_in = |axis: Axis, end: usize| {
                let across = if axis == Axis::U { Axis::V } else { Axis::U };
                vertex.along(across) == corners[end].along(across)
            };
            let edge = EDGES.iter().find(|edge| lies_in(edge.along, edge.ends[0]));
            let edge = edge.expect("a T-vertex lies in an edge of its host");
            let ends = edge.ends.map(|corner| self.corners[host as usize][corner]);
            self.kinds[number as usize] = VertexKind::Hanging(Hanging { host, axis: edge.along, ends });
        }
        // hosts are strictly larger than the leaves that have the vertex as a corner
        let host_level = |&number: &u32| match self.kinds[number as usize] {
            VertexKind::Hanging(hanging) => mesh.cell(self.leaves[hanging.host as usize]).level,
            VertexKind::Basis(_) => 0,
        };
        let mut order = std::mem::take(&mut self.hanging);
        order.sort_by_key(host_level);
        self.hanging = order;
    }

    /// The leaf of a node.
    #[inline]
    pub fn leaf_of(&self, node: NodeId) -> usize {
        self.leaf_of_node[node.index()] as usize
    }
}
