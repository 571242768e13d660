//! Addresses: cells, vertices and edges as integers.

use crate::geometry::Axis;

/// Most times a cell of the initial grid can be halved.
pub const MAX_LEVEL: u32 = 20;
/// Side of an initial cell in units of vertices.
pub(super) const UNIT: u32 = 1 << MAX_LEVEL;
/// Most initial cells along one direction: vertices fit into 32 bits.
pub const MAX_GRID: usize = 4095;

/// The address of a cell: `level` halvings of an initial cell, `i` and `j` counted along u and v over the
/// whole grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Cell {
    /// 0 for a cell of the initial grid.
    pub level: u32,
    /// Below `2^level` times the initial cells along u.
    pub i: u32,
    /// Below `2^level` times the initial cells along v.
    pub j: u32,
}

/// The place of a vertex, in units of 2^-20 of an initial cell; ordered along u first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Vertex {
    /// Along u.
    pub i: u32,
    /// Along v.
    pub j: u32,
}

/// Corners, children and quadrants come in this order, v running fastest.
pub const QUADRANTS: [[u32; 2]; 4] = [[0, 0], [0, 1], [1, 0], [1, 1]];

impl Cell {
    /// Side in units of vertices.
    pub fn side(self) -> u32 {
        UNIT >> self.level
    }

    /// The corners in the order of [`QUADRANTS`].
    pub fn corners(self) -> [Vertex; 4] {
        let side = self.side();
        QUADRANTS.map(|[a, b]| Vertex { i: (self.i + a) * side, j: (self.j + b) * side })
    }

    /// The cell it is a quarter of.
    pub fn parent(self) -> Option<Self> {
        (self.level > 0).then(|| Self { level: self.level - 1, i: self.i / 2, j: self.j / 2 })
    }

    /// Its quarters.
    pub fn children(self) -> [Self; 4] {
        QUADRANTS.map(|[a, b]| Self { level: self.level + 1, i: 2 * self.i + a, j: 2 * self.j + b })
    }

    /// The vertex in its middle. The level is below [`MAX_LEVEL`].
    pub fn middle(self) -> Vertex {
        let half = self.side() / 2;
        Vertex { i: (2 * self.i + 1) * half, j: (2 * self.j + 1) * half }
    }

    /// The middles of the edges at least u, largest u, least v, largest v.
    pub fn edge_middles(self) -> [Vertex; 4] {
        let [a, b, c, _] = self.corners();
        let (low, high, Vertex { i, j }) = (a, Vertex { i: c.i, j: b.j }, self.middle());
        [Vertex { i: low.i, j }, Vertex { i: high.i, j }, Vertex { i, j: low.j }, Vertex { i, j: high.j }]
    }

    /// Whether `vertex` is one of its corners.
    pub fn has_corner(self, vertex: Vertex) -> bool {
        self.corners().contains(&vertex)
    }
}

impl Vertex {
    /// Its coordinate along one axis.
    pub fn along(self, axis: Axis) -> u32 {
        match axis {
            Axis::U => self.i,
            Axis::V => self.j,
        }
    }

    /// Side of the cells of a level, in units of vertices.
    pub fn side_at(level: u32) -> u32 {
        UNIT >> level
    }

    /// The least level at which both coordinates are grid lines.
    pub fn birth_level(self) -> u32 {
        MAX_LEVEL - (self.i | self.j | UNIT).trailing_zeros()
    }
}

/// An edge of a cell.
#[derive(Debug, Clone, Copy)]
pub struct Edge {
    /// The direction it runs in.
    pub along: Axis,
    /// The corners at its ends.
    pub ends: [usize; 2],
    /// From its first end, the quadrant ahead on the other side.
    pub ahead: [u32; 2],
}

/// The edges at least u, largest u, least v, largest v.
pub const EDGES: [Edge; 4] = [
    Edge { along: Axis::V, ends: [0, 1], ahead: [0, 1] },
    Edge { along: Axis::V, ends: [2, 3], ahead: [1, 1] },
    Edge { along: Axis::U, ends: [0, 2], ahead: [1, 0] },
    Edge { along: Axis::U, ends: [1, 3], ahead: [1, 1] },
];
