//! The mesh: its quadtrees, and who lies beside whom.

use super::cell::{Cell, EDGES, Edge, MAX_GRID, MAX_LEVEL, QUADRANTS, UNIT, Vertex};
use super::error::TMeshError;
use crate::geometry::{Axis, Domain};
use crate::knots::KnotVector;
use crate::memory::{self, CollectVec};
use glam::DVec2;

/// Number of a node of the quadtrees; its meaning ends when the node is merged away.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NodeId(u32);

impl NodeId {
    /// For tables beside the mesh.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

#[derive(Debug, Clone, Copy)]
struct Node {
    /// The parameters where its children meet.
    middle: DVec2,
    cell: Cell,
    /// The first of four; 0 for a leaf, as no child is the first node.
    first_child: u32,
}

/// What a place of the mesh is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// No leaf has a corner there.
    Absent,
    /// All leaves that touch it have a corner there, or it lies on the border.
    Basis,
    /// It lies inside an edge of this leaf.
    Hanging(NodeId),
}

/// A hierarchical T-mesh.
#[derive(Debug)]
pub struct TMesh {
    /// The initial grid, as knots of degree 1.
    grid: [KnotVector; 2],
    /// The initial cells first, v running fastest.
    nodes: Vec<Node>,
    /// First nodes of fours that were merged away.
    free: Vec<u32>,
    leaf_count: usize,
}

impl Clone for TMesh {
    fn clone(&self) -> Self {
        let Self { grid, nodes, free, leaf_count } = self;
        Self {
            grid: grid.clone(),
            nodes: memory::copied(nodes),
            free: memory::copied(free),
            leaf_count: *leaf_count,
        }
    }
}

impl PartialEq for TMesh {
    fn eq(&self, other: &Self) -> bool {
        let leaves = |mesh: &Self| mesh.leaves().map(|leaf| mesh.cell(leaf)).collect_vec();
        self.grid == other.grid && self.leaf_count == other.leaf_count && leaves(self) == leaves(other)
    }
}

impl TMesh {
    /// The tensor grid over strictly increasing `breaks_u` and `breaks_v`.
    pub fn new(breaks_u: &[f64], breaks_v: &[f64]) -> Result<Self, TMeshError> {
        let grid = |axis, breaks: &[f64]| {
            if let Some(index) = breaks.iter().position(|t| !t.is_finite()) {
                return Err(TMeshError::KnotNotFinite { axis, index });
            }
            if let Some(index) = breaks.windows(2).position(|pair| pair[0] >= pair[1]) {
                return Err(TMeshError::KnotNotIncreasing { axis, index: index + 1 });
            }
            if breaks.len() < 2 || breaks.len() - 1 > MAX_GRID {
                return Err(TMeshError::KnotCount { axis, count: breaks.len() });
            }
            KnotVector::clamped(breaks, 1).map_err(|_| TMeshError::KnotCount { axis, count: breaks.len() })
        };
        let grid = [grid(Axis::U, breaks_u)?, grid(Axis::V, breaks_v)?];
        let [count_u, count_v] = [breaks_u.len() as u32 - 1, breaks_v.len() as u32 - 1];
        let leaf_count = count_u as usize * count_v as usize;
        let mut mesh = Self { grid, nodes: memory::with_capacity(leaf_count), free: Vec::new(), leaf_count };
        for i in 0..count_u {
            for j in 0..count_v {
                let node = mesh.leaf(Cell { level: 0, i, j });
                mesh.nodes.push(node);
            }
        }
        Ok(mesh)
    }

    fn leaf(&self, cell: Cell) -> Node {
        // at the deepest level the middle is never asked for
        let middle = if cell.level < MAX_LEVEL { self.parameters(cell.middle()) } else { DVec2::INFINITY };
        Node { middle, cell, first_child: 0 }
    }

    /// Grid lines of the initial grid along an axis.
    pub fn breaks(&self, axis: Axis) -> &[f64] {
        let knots = self.grid_lines(axis).knots();
        &knots[1..knots.len() - 1]
    }

    /// The initial grid along an axis, as knots of degree 1.
    pub fn grid_lines(&self, axis: Axis) -> &KnotVector {
        match axis {
            Axis::U => &self.grid[0],
            Axis::V => &self.grid[1],
        }
    }

    /// Initial cells along both directions.
    pub fn grid_size(&self) -> [u32; 2] {
        [Axis::U, Axis::V].map(|axis| self.breaks(axis).len() as u32 - 1)
    }

    /// The vertex at the largest u and v.
    pub fn last_vertex(&self) -> Vertex {
        let [i, j] = self.grid_size().map(|count| count * UNIT);
        Vertex { i, j }
    }

    /// Whether a vertex lies on the border of the domain.
    pub fn is_border(&self, vertex: Vertex) -> bool {
        let last = self.last_vertex();
        vertex.i == 0 || vertex.j == 0 || vertex.i == last.i || vertex.j == last.j
    }

    /// The rectangle of all cells.
    pub fn domain(&self) -> Domain {
        let ((u0, u1), (v0, v1)) = (self.grid[0].domain(), self.grid[1].domain());
        Domain { min: DVec2::new(u0, v0), max: DVec2::new(u1, v1) }
    }

    /// The parameter at an integer coordinate.
    pub fn parameter(&self, axis: Axis, at: u32) -> f64 {
        let (breaks, cell, part) = (self.breaks(axis), (at / UNIT) as usize, at % UNIT);
        if part == 0 {
            return breaks[cell];
        }
        breaks[cell] + (breaks[cell + 1] - breaks[cell]) * (f64::from(part) / f64::from(UNIT))
    }

    /// The parameters of a vertex.
    pub fn parameters(&self, vertex: Vertex) -> DVec2 {
        DVec2::new(self.parameter(Axis::U, vertex.i), self.parameter(Axis::V, vertex.j))
    }

    /// The rectangle of a cell.
    pub fn cell_domain(&self, cell: Cell) -> Domain {
        let [min, _, _, max] = cell.corners().map(|corner| self.parameters(corner));
        Domain { min, max }
    }

    /// Number of leaves.
    pub fn leaf_count(&self) -> usize {
        self.leaf_count
    }

    /// Upper bound of [`NodeId::index`].
    pub fn node_count(&self) -> usize {
        self.nodes.len()
    }

    /// The leaves: initial cells in their order, in each of them quarter after quarter.
    pub fn leaves(&self) -> impl Iterator<Item = NodeId> + '_ {
        let [count_u, count_v] = self.grid_size();
        let mut stack: Vec<NodeId> = (0..count_u * count_v).rev().map(NodeId).collect_vec();
        std::iter::from_fn(move || {
            loop {
                let node = stack.pop()?;
                match self.children(node) {
                    None => return Some(node),
                    Some(children) => stack.extend(children.into_iter().rev()),
                }
            }
        })
    }

    /// The cells that are split, each before its quarters.
    pub fn splits(&self) -> impl Iterator<Item = Cell> + '_ {
        let [count_u, count_v] = self.grid_size();
        let mut stack: Vec<NodeId> = (0..count_u * count_v).rev().map(NodeId).collect_vec();
        std::iter::from_fn(move || {
            loop {
                let node = stack.pop()?;
                if let Some(children) = self.children(node) {
                    stack.extend(children.into_iter().rev());
                    return Some(self.cell(node));
                }
            }
        })
    }

    /// Splits leaves one after the other; later ones may be quarters of earlier ones. An error leaves those
    /// before it split.
    pub fn split_all(&mut self, cells: &[Cell]) -> Result<(), TMeshError> {
        for (index, &cell) in cells.iter().enumerate() {
            let leaf = self.splittable(index, cell)?;
            self.split(leaf);
        }
        Ok(())
    }

    /// The leaf at an address, the `index`-th of a list, if it can be split.
    pub fn splittable(&self, index: usize, cell: Cell) -> Result<NodeId, TMeshError> {
        let leaf = self.find(cell).filter(|&node| self.is_leaf(node));
        let leaf = leaf.ok_or(TMeshError::NotLeaf { index, cell })?;
        if cell.level >= MAX_LEVEL {
            return Err(TMeshError::LevelLimit { index, level: cell.level, limit: MAX_LEVEL });
        }
        Ok(leaf)
    }

    /// The address of a node.
    pub fn cell(&self, node: NodeId) -> Cell {
        self.nodes[node.index()].cell
    }

    /// The quarters of a node that is no leaf.
    pub fn children(&self, node: NodeId) -> Option<[NodeId; 4]> {
        let first = self.nodes[node.index()].first_child;
        (first != 0).then(|| [0, 1, 2, 3].map(|k| NodeId(first + k)))
    }

    /// Whether it has no quarters.
    pub fn is_leaf(&self, node: NodeId) -> bool {
        self.nodes[node.index()].first_child == 0
    }

    /// Whether it has four quarters and each is a leaf.
    pub fn is_mergeable(&self, node: NodeId) -> bool {
        self.children(node).is_some_and(|children| children.into_iter().all(|child| self.is_leaf(child)))
    }

    /// The node at an address.
    pub fn find(&self, cell: Cell) -> Option<NodeId> {
        let [count_u, count_v] = self.grid_size();
        if cell.level > MAX_LEVEL || cell.i >> cell.level >= count_u || cell.j >> cell.level >= count_v {
            return None;
        }
        Some(self.find_or_holder(cell)).filter(|&node| self.cell(node).level == cell.level)
    }

    /// The node at an address in the grid, or the leaf that holds the cell.
    pub(super) fn find_or_holder(&self, cell: Cell) -> NodeId {
        let mut node = NodeId((cell.i >> cell.level) * self.grid_size()[1] + (cell.j >> cell.level));
        for shift in (0..cell.level).rev() {
            let quadrant = 2 * (cell.i >> shift & 1) + (cell.j >> shift & 1);
            match self.children(node) {
                Some(children) => node = children[quadrant as usize],
                None => break,
            }
        }
        node
    }

    /// The leaf that has `uv`: on a grid line the one to the right or above; beyond the domain the nearest.
    #[inline]
    pub fn locate(&self, uv: DVec2) -> NodeId {
        let [rank_u, rank_v] = [self.grid[0].rank_at(uv.x), self.grid[1].rank_at(uv.y)];
        self.descend(NodeId((rank_u * self.grid[1].spans().len() + rank_v) as u32), uv)
    }

    /// The leaf below a node.
    #[inline(always)]
    pub(super) fn descend(&self, node: NodeId, uv: DVec2) -> NodeId {
        let mut at = node.index();
        loop {
            let node = &self.nodes[at];
            if node.first_child == 0 {
                return NodeId(at as u32);
            }
            let quadrant = 2 * u32::from(uv.x >= node.middle.x) + u32::from(uv.y >= node.middle.y);
            at = (node.first_child + quadrant) as usize;
        }
    }

    /// The leaf that touches a place from one of its [`QUADRANTS`]; none beyond the border.
    pub fn leaf_beside(&self, vertex: Vertex, [a, b]: [u32; 2]) -> Option<NodeId> {
        let last = self.last_vertex();
        let is_beyond = |at: u32, end: u32, side: u32| if side == 0 { at == 0 } else { at == end };
        if is_beyond(vertex.i, last.i, a) || is_beyond(vertex.j, last.j, b) {
            return None;
        }
        // the smallest possible cell in that quadrant
        let (i, j) = (vertex.i + a - 1, vertex.j + b - 1);
        let mut node = NodeId((i >> MAX_LEVEL) * self.grid_size()[1] + (j >> MAX_LEVEL));
        let mut shift = MAX_LEVEL;
        while let Some(children) = self.children(node) {
            shift -= 1;
            node = children[(2 * (i >> shift & 1) + (j >> shift & 1)) as usize];
        }
        Some(node)
    }

    /// What a place is.
    pub fn role(&self, vertex: Vertex) -> Role {
        let around = QUADRANTS.map(|quadrant| self.leaf_beside(vertex, quadrant));
        let mut leaves = around.iter().flatten();
        if !leaves.clone().any(|&leaf| self.cell(leaf).has_corner(vertex)) {
            return Role::Absent;
        }
        leaves
            .find(|&&leaf| !self.cell(leaf).has_corner(vertex))
            .map_or(Role::Basis, |&host| Role::Hanging(host))
    }

    /// Halves a leaf both ways. Its level is below [`MAX_LEVEL`].
    pub fn split(&mut self, leaf: NodeId) {
        debug_assert!(self.is_leaf(leaf) && self.cell(leaf).level < MAX_LEVEL, "{leaf:?} cannot be split");
        let children = self.cell(leaf).children().map(|cell| self.leaf(cell));
        let first = match self.free.pop() {
            Some(first) => {
                self.nodes[first as usize..first as usize + 4].copy_from_slice(&children);
                first
            }
            None => {
                memory::extend(&mut self.nodes, children);
                (self.nodes.len() - 4) as u32
            }
        };
        self.nodes[leaf.index()].first_child = first;
        self.leaf_count += 3;
    }

    /// Splits a leaf, and before it those across its edges that are more than `grade` levels coarser than its
    /// quarters will be. Asks `allow` before each.
    pub fn split_graded<E>(
        &mut self,
        leaf: NodeId,
        grade: u32,
        allow: &mut impl FnMut(&Self, NodeId) -> Result<(), E>,
    ) -> Result<(), E> {
        let level = self.cell(leaf).level;
        for edge in EDGES {
            // where the leaf across is coarser there is only one
            while let Some(&coarse) = self.across(leaf, edge).first() {
                if self.cell(coarse).level + grade > level {
                    break;
                }
                self.split_graded(coarse, grade, allow)?;
            }
        }
        allow(self, leaf)?;
        self.split(leaf);
        Ok(())
    }

    /// Makes a node a leaf whose quarters are leaves.
    pub fn merge(&mut self, node: NodeId) {
        debug_assert!(self.is_mergeable(node), "{node:?} cannot be merged");
        self.free.push(self.nodes[node.index()].first_child);
        self.nodes[node.index()].first_child = 0;
        self.leaf_count -= 3;
    }

    /// Leaves that share a part of an edge with a leaf, in the order of the edges at least u, largest u, least
    /// v, largest v, and along each of them.
    pub fn neighbours(&self, leaf: NodeId) -> Vec<NodeId> {
        EDGES.iter().flat_map(|&edge| self.across(leaf, edge)).collect_vec()
    }

    /// The leaves on the other side of an edge, in order along it.
    pub fn across(&self, leaf: NodeId, edge: Edge) -> Vec<NodeId> {
        let cell = self.cell(leaf);
        let corners = cell.corners();
        let end = corners[edge.ends[1]].along(edge.along);
        let mut at = corners[edge.ends[0]];
        let mut leaves = Vec::new();
        // from a place on the edge, the leaf ahead of it on the other side
        while let Some(next) = self.leaf_beside(at, edge.ahead) {
            leaves.push(next);
            let far = self.cell(next).corners()[3].along(edge.along);
            if far >= end {
                break;
            }
            match edge.along {
                Axis::U => at.i = far,
                Axis::V => at.j = far,
            }
        }
        leaves
    }
}
