//! Cutting meshes: removing faces, splitting components, opening along paths of edges.
//!
//! A path opens a mesh by splitting the fans of its nodes: the cut edges part the triangles around a node
//! into sectors, the first keeps the node, each further one gets a copy.
//! ```text
//!   a closed fan with one cut edge stays whole (the path ends inside the mesh),
//!   with two or more it falls into as many sectors;
//!   an open fan (on the boundary) falls into one sector more than it has cut edges.
//! ```
//! Parameters and fields go with their nodes.

use super::priced::Priced;
use super::{Field, HalfEdge, Mesh, MeshError, Origins};
use crate::failure::{Classify, ErrorKind};
use crate::memory::{self, CollectVec};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// A mesh cannot be cut as asked.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CutError {
    /// What is left is no mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// A triangle to remove does not exist.
    #[error("there is no triangle {triangle}, the mesh has {count}")]
    NoSuchTriangle {
        /// The triangle given.
        triangle: u32,
        /// Triangles of the mesh.
        count: usize,
    },
    /// A node does not exist.
    #[error("there is no node {node}, the mesh has {count}")]
    NoSuchNode {
        /// The node given.
        node: u32,
        /// Nodes of the mesh.
        count: usize,
    },
    /// A path needs two nodes.
    #[error("a path needs two nodes, this one has {node_count}")]
    PathTooShort {
        /// Nodes of the path.
        node_count: usize,
    },
    /// Two nodes of a path that follow each other have no common edge.
    #[error("nodes {from} and {to} of the path have no common edge")]
    NotAnEdge {
        /// The first of the two.
        from: u32,
        /// The second.
        to: u32,
    },
    /// The path opens nothing: it is a single edge with both ends inside, or runs along the boundary.
    #[error("the path from node {from} to node {to} opens nothing")]
    NothingOpened {
        /// Its first node.
        from: u32,
        /// Its last node.
        to: u32,
    },
    /// No path of edges joins two nodes.
    #[error("no path of edges joins nodes {from} and {to}")]
    NotConnected {
        /// Where the path should begin.
        from: u32,
        /// Where it should end.
        to: u32,
    },
}

impl Classify for CutError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::Mesh(error) => error.kind(),
            Self::NoSuchTriangle { .. } | Self::NoSuchNode { .. } => ErrorKind::Index,
            Self::PathTooShort { .. } => ErrorKind::InvalidArgument,
            Self::NotAnEdge { .. } | Self::NothingOpened { .. } | Self::NotConnected { .. } => {
                ErrorKind::Topology
            }
        }
    }

    /// The offending triangle, or node: the first of a pair.
    fn index(&self) -> Option<usize> {
        match *self {
            Self::Mesh(ref error) => error.index(),
            Self::NoSuchTriangle { triangle, .. } => Some(triangle as usize),
            Self::NoSuchNode { node, .. } => Some(node as usize),
            Self::PathTooShort { .. } => None,
            Self::NotAnEdge { from, .. } | Self::NothingOpened { from, .. } => Some(from as usize),
            Self::NotConnected { from, .. } => Some(from as usize),
        }
    }
}

/// A mesh made from another.
#[derive(Debug, Clone, PartialEq)]
pub struct Piece {
    /// The mesh.
    pub mesh: Mesh,
    /// By node of this mesh, the node of the other that it was.
    pub nodes: Vec<u32>,
}

impl Piece {
    /// Rows of `dim` numbers, one a node of the other mesh: those of this one.
    pub fn gather(&self, rows: &[f64], dim: usize) -> Vec<f64> {
        self.nodes.iter().flat_map(|&node| &rows[node as usize * dim..][..dim]).copied().collect_vec()
    }

    /// What is known by node of this mesh, by node of the other, which has `count`; `nothing` elsewhere.
    pub fn spread<T: Copy>(&self, values: &[T], count: usize, nothing: T) -> Vec<T> {
        let mut spread = memory::filled(nothing, count);
        self.nodes.iter().zip(values).for_each(|(&node, &value)| spread[node as usize] = value);
        spread
    }
}

impl Mesh {
    /// The mesh without some of its triangles, and without the nodes that no triangle needs any more.
    pub fn remove_triangles(&self, triangles: &[u32]) -> Result<Piece, CutError> {
        let count = self.triangles.len();
        let mut keeps = memory::filled(true, count);
        for &triangle in triangles {
            match keeps.get_mut(triangle as usize) {
                Some(keep) => *keep = false,
                None => return Err(CutError::NoSuchTriangle { triangle, count }),
            }
        }
        self.compacted((0..).zip(&self.triangles).zip(keeps).filter(|&(_, keep)| keep).map(|(kept, _)| kept))
    }

    /// Each part that hangs together by edges as a mesh of its own, in the order of their first triangles.
    pub fn split_components(&self) -> Result<Vec<Piece>, CutError> {
        let (labels, count) = self.topology.components();
        let mut parts = memory::filled(Vec::new(), count);
        for (triangle, label) in (0..).zip(&self.triangles).zip(labels) {
            memory::push(&mut parts[label as usize], triangle);
        }
        parts.into_iter().map(|triangles| self.compacted(triangles)).collect()
    }

    /// The mesh without the nodes that no triangle needs; none if it has no such nodes.
    pub fn without_unused_nodes(&self) -> Option<Piece> {
        if self.used_count == self.points.len() {
            return None;
        }
        Some(self.compacted((0..).zip(&self.triangles)).expect("it stays the same mesh"))
    }

    /// Opens the mesh along a path of edges, given by its nodes in order.
    ///
    /// Nodes inside the path are doubled, and so are its ends on the boundary; ends inside the mesh are not.
    /// A closed path, whose last node is its first, separates what it surrounds. Edges on the boundary are
    /// open already. Triangles keep their numbers and old nodes theirs; copies come after them.
    pub fn cut_along(&self, path: &[u32]) -> Result<Piece, CutError> {
        let (&[from, ..], &[_, .., to]) = (path, path) else {
            return Err(CutError::PathTooShort { node_count: path.len() });
        };
        path.iter().try_for_each(|&node| self.check_node(node))?;
        let mut cut = memory::filled(false, 3 * self.triangles.len());
        for pair in path.windows(2) {
            let edge = self.edge_between(pair[0], pair[1]);
            let edge = edge.ok_or(CutError::NotAnEdge { from: pair[0], to: pair[1] })?;
            if let Some(twin) = self.topology.twin(edge) {
                cut[edge.index()] = true;
                cut[twin.index()] = true;
            }
        }

        let mut triangles = self.triangles.clone();
        let mut nodes: Vec<u32> = (0..self.points.len() as u32).collect_vec();
        let mut split_nodes = memory::copied(path);
        split_nodes.sort_unstable();
        split_nodes.dedup();
        for node in split_nodes {
            for start in self.topology.fans(node) {
                for sector in self.sectors(start, &cut).into_iter().skip(1) {
                    for half_edge in sector {
                        triangles[half_edge.triangle()][half_edge.corner()] = nodes.len() as u32;
                    }
                    memory::push(&mut nodes, node);
                }
            }
        }
        if nodes.len() == self.points.len() {
            return Err(CutError::NothingOpened { from, to });
        }
        let numbers = (0..triangles.len() as u32).collect_vec();
        self.piece(triangles, nodes, numbers)
    }

    /// The mesh of some triangles, opened along edges: triangles around a node hang together there only over common
    /// edges that stay closed. Nodes and triangles keep their order.
    pub(crate) fn cut_out(
        &self,
        triangles: &[u32],
        is_cut: impl Fn(HalfEdge) -> bool,
    ) -> Result<Piece, CutError> {
        const NONE: u32 = u32::MAX;
        let mut place = memory::filled(NONE, self.triangles.len());
        (0..).zip(triangles).for_each(|(k, &triangle)| place[triangle as usize] = k);
        // corners of triangles in sets that are one node
        let mut sets: Vec<u32> = (0..3 * triangles.len() as u32).collect_vec();
        let corner = |place: u32, corner: usize| 3 * place + corner as u32;
        for (k, &triangle) in (0..).zip(triangles) {
            for edge in (0..3).map(|side| HalfEdge::new(triangle as usize, side)) {
                let Some(twin) = self.topology.twin(edge).filter(|_| !is_cut(edge)) else { continue };
                let other = place[twin.triangle()];
                if other == NONE {
                    continue;
                }
                let [from, to] = [edge.corner(), edge.next().corner()].map(|c| corner(k, c));
                let [begin, end] = [twin.corner(), twin.next().corner()].map(|c| corner(other, c));
                join(&mut sets, from, end);
                join(&mut sets, to, begin);
            }
        }
        let old = |corner: u32| self.triangles[triangles[corner as usize / 3] as usize][corner as usize % 3];
        let roots: Vec<u32> = (0..sets.len() as u32).map(|corner| root(&mut sets, corner)).collect_vec();
        let mut nodes: Vec<[u32; 2]> =
            (0..).zip(&roots).filter(|(k, r)| k == *r).map(|(k, _)| [old(k), k]).collect_vec();
        nodes.sort_unstable();
        let mut number = memory::filled(NONE, sets.len());
        (0..).zip(&nodes).for_each(|(node, &[_, root])| number[root as usize] = node);
        let new = |k: usize| [0, 1, 2].map(|c| number[roots[3 * k + c] as usize]);
        let new_triangles = (0..triangles.len()).map(new).collect_vec();
        self.piece(new_triangles, nodes.into_iter().map(|[old, _]| old).collect_vec(), triangles.to_vec())
    }

    /// The shortest path along edges, by length; of equally short ones always the same.
    pub fn shortest_path(&self, from: u32, to: u32) -> Result<Vec<u32>, CutError> {
        self.check_node(from)?;
        self.check_node(to)?;
        let mut lengths = memory::filled(f64::INFINITY, self.points.len());
        let mut before = memory::filled(from, self.points.len());
        let mut heap = BinaryHeap::from([Reverse(Priced { cost: 0.0, node: from })]);
        lengths[from as usize] = 0.0;
        while let Some(Reverse(Priced { cost: length, node })) = heap.pop() {
            if node == to {
                let back =
                    std::iter::successors(Some(to), |&node| (node != from).then(|| before[node as usize]));
                let mut path: Vec<u32> = back.collect_vec();
                path.reverse();
                return Ok(path);
            }
            if length > lengths[node as usize] {
                continue; // a shorter way was found since
            }
            for next in self.neighbours(node) {
                let further = length + self.points[node as usize].distance(self.points[next as usize]);
                if further < lengths[next as usize] {
                    lengths[next as usize] = further;
                    before[next as usize] = node;
                    heap.push(Reverse(Priced { cost: further, node: next }));
                }
            }
        }
        Err(CutError::NotConnected { from, to })
    }

    fn check_node(&self, node: u32) -> Result<(), CutError> {
        let count = self.points.len();
        if (node as usize) < count { Ok(()) } else { Err(CutError::NoSuchNode { node, count }) }
    }

    /// The half-edges of a fan, parted at the cut edges; each part begins at a cut or on the boundary.
    pub(crate) fn sectors(&self, start: HalfEdge, cut: &[bool]) -> Vec<Vec<HalfEdge>> {
        let mut sectors: Vec<Vec<HalfEdge>> = vec![Vec::new()];
        for half_edge in self.topology.fan_from(start) {
            match sectors.last_mut() {
                Some(sector) if half_edge == start || !cut[half_edge.index()] => sector.push(half_edge),
                _ => sectors.push(vec![half_edge]),
            }
        }
        // a closed fan goes on from its last sector into the first, unless it begins at a cut
        let is_closed = self.topology.twin(start).is_some();
        if is_closed && !cut[start.index()] && sectors.len() > 1 {
            let mut last = sectors.pop().unwrap_or_default();
            last.append(&mut sectors[0]);
            sectors[0] = last;
        }
        sectors
    }

    /// The mesh of some triangles, given with what they were in this one, and only their nodes.
    pub(super) fn compacted<T: std::borrow::Borrow<[u32; 3]>>(
        &self,
        triangles: impl IntoIterator<Item = (u32, T)>,
    ) -> Result<Piece, CutError> {
        let (numbers, mut triangles): (Vec<u32>, Vec<[u32; 3]>) =
            triangles.into_iter().map(|(number, triangle)| (number, *triangle.borrow())).unzip();
        let mut new = memory::filled(u32::MAX, self.points.len());
        triangles.iter().flatten().for_each(|&node| new[node as usize] = 0);
        let nodes: Vec<u32> = (0..new.len() as u32).filter(|&node| new[node as usize] == 0).collect_vec();
        nodes.iter().enumerate().for_each(|(i, &node)| new[node as usize] = i as u32);
        triangles.iter_mut().flatten().for_each(|node| *node = new[*node as usize]);
        self.piece(triangles, nodes, numbers)
    }

    /// A mesh whose node i is the node `nodes[i]` of this one, and whose triangle t was `numbers[t]`.
    fn piece(&self, triangles: Vec<[u32; 3]>, nodes: Vec<u32>, numbers: Vec<u32>) -> Result<Piece, CutError> {
        let points = nodes.iter().map(|&node| self.points[node as usize]).collect_vec();
        let mut mesh = Mesh::new(points, triangles).map_err(|error| match error {
            MeshError::NoPoints => MeshError::NoTriangles, // the nodes went with the triangles
            error => error,
        })?;
        mesh.parameters =
            self.parameters().map(|uv| nodes.iter().map(|&node| uv[node as usize]).collect_vec());
        let fields = self.fields.iter().map(|field| Field {
            name: field.name.clone(),
            values: nodes.iter().map(|&node| field.values[node as usize]).collect_vec(),
        });
        mesh.fields = fields.collect_vec();
        mesh.origins = Origins::new(nodes.clone(), numbers);
        Ok(Piece { mesh, nodes })
    }
}

/// The first of a set; the way to it becomes shorter.
fn root(sets: &mut [u32], mut member: u32) -> u32 {
    while sets[member as usize] != member {
        sets[member as usize] = sets[sets[member as usize] as usize];
        member = sets[member as usize];
    }
    member
}

fn join(sets: &mut [u32], a: u32, b: u32) {
    let [a, b] = [a, b].map(|member| root(sets, member));
    sets[a.max(b) as usize] = a.min(b);
}
