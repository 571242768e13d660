//! Quad layouts: the quadrilateral patches of a surface of any genus, closed or with borders, and how they meet.
//!
//! ```text
//!   (0,1) -----2----- (1,1)     A quad has its corners counterclockwise, and over it lie parameters in [0,1]^2.
//!     |                 |       Side k runs from corner k to corner k + 1; t is measured along it and q inwards.
//!     3                 1
//!     |                 |       Two sides that meet are one edge; they run opposite ways, so t on one is 1 - t
//!   (0,0) -----0----- (1,0)     on the other. An edge of one side is a border.
//! ```
//! Around a vertex the corners lie in sectors, counterclockwise: one that closes inside, and else from sharp edge to
//! sharp edge; borders and [`Creases`] are sharp. Edges have numbers, because two quads may share more than one.

mod bilinear;
mod complex;
mod cube;
mod error;
mod mesh_layout;
mod node_map;
pub mod of_features;
pub mod of_mesh;
mod sectors;
#[cfg(test)]
mod tests;
mod walk;

pub use cube::{CUBE_FACES, CubeFace, cube_place};
pub use error::LayoutError;
pub use node_map::NodeMap;
pub use sectors::{Creases, Sector};

use glam::DVec2;
use std::collections::BTreeMap;

/// A side of a quad, and by the same numbers the corner at which it begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Side {
    /// The quad.
    pub quad: u32,
    /// 0 to 3, counterclockwise.
    pub side: u8,
}

impl Side {
    /// The side after it on the same quad, and the corner at which it ends.
    pub fn next(self) -> Self {
        Self { side: (self.side + 1) % 4, ..self }
    }

    /// The side before it on the same quad.
    pub fn previous(self) -> Self {
        Self { side: (self.side + 3) % 4, ..self }
    }

    /// The parameters at the fraction `t` along it and `q` inwards.
    pub fn place(self, t: f64, q: f64) -> Place {
        let uv = match self.side {
            0 => [t, q],
            1 => [1.0 - q, t],
            2 => [1.0 - t, 1.0 - q],
            _ => [q, 1.0 - t],
        };
        Place { quad: self.quad, uv: DVec2::from_array(uv) }
    }

    /// The fraction along it and the distance inwards of parameters on its quad: what [`Side::place`] inverts.
    pub fn coordinates(self, uv: DVec2) -> [f64; 2] {
        match self.side {
            0 => [uv.x, uv.y],
            1 => [uv.y, 1.0 - uv.x],
            2 => [1.0 - uv.x, 1.0 - uv.y],
            _ => [1.0 - uv.y, uv.x],
        }
    }
}

/// A place on the layout.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// The quad.
    pub quad: u32,
    /// Its parameters, in `[0,1]^2`.
    pub uv: DVec2,
}

/// An edge seen from one of its ends, or in one direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct HalfEdge {
    /// The edge.
    pub edge: u32,
    /// Whether it runs as the first side of the edge does.
    pub is_forward: bool,
}

impl HalfEdge {
    /// The other direction.
    pub fn reversed(self) -> Self {
        Self { is_forward: !self.is_forward, ..self }
    }

    /// Its number among the directions of all edges.
    pub fn index(self) -> usize {
        2 * self.edge as usize + usize::from(!self.is_forward)
    }
}

/// One side or two that meet.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Edge {
    /// The vertices at its ends, in the direction of the first side.
    pub ends: [u32; 2],
    /// The side that came first.
    pub first: Side,
    /// The one that runs the other way; none at a border.
    pub second: Option<Side>,
}

impl Edge {
    /// The sides that meet in it.
    pub fn sides(&self) -> impl Iterator<Item = Side> {
        [Some(self.first), self.second].into_iter().flatten()
    }
}

/// Quadrilateral patches and how they meet.
#[derive(Debug, Clone, PartialEq)]
pub struct Layout {
    quads: Vec<[u32; 4]>,
    edges: Vec<Edge>,
    /// By edge: whether the surface goes on across it with one tangent plane.
    is_smooth: Vec<bool>,
    /// The edge of each side, in the direction of the side.
    edge_of_side: Vec<[HalfEdge; 4]>,
    /// By vertex, and around it counterclockwise.
    sectors: Vec<Sector>,
    /// Those of vertex `v` are `sectors[starts[v]..starts[v + 1]]`.
    sector_starts: Vec<u32>,
    /// The sector of each corner.
    sector_of_corner: Vec<[u32; 4]>,
}

impl Layout {
    /// The layout of these quads, whose sides meet where they have the same two ends.
    pub fn new(quads: &[[u32; 4]]) -> Result<Self, LayoutError> {
        let mut numbers = BTreeMap::new();
        let mut number = |a: u32, b: u32| {
            let next = numbers.len() as u32;
            *numbers.entry([a.min(b), a.max(b)]).or_insert(next)
        };
        let sides = |quad: &[u32; 4]| std::array::from_fn(|k| number(quad[k], quad[(k + 1) % 4]));
        let edges: Vec<[u32; 4]> = quads.iter().map(sides).collect();
        Self::with_edges(quads, &edges)
    }

    /// The same where sides meet that have the same number in `edges`: two edges may join the same vertices.
    pub fn with_edges(quads: &[[u32; 4]], edges: &[[u32; 4]]) -> Result<Self, LayoutError> {
        Self::assemble(quads, edges, None)
    }

    /// The same where the surface has creases: at a vertex there may be any number of open sectors.
    pub fn with_creases(
        quads: &[[u32; 4]],
        edges: &[[u32; 4]],
        creases: &Creases,
    ) -> Result<Self, LayoutError> {
        Self::assemble(quads, edges, Some(creases))
    }

    fn assemble(
        quads: &[[u32; 4]],
        edges: &[[u32; 4]],
        creases: Option<&Creases>,
    ) -> Result<Self, LayoutError> {
        if quads.is_empty() {
            return Err(LayoutError::Empty);
        }
        if quads.len() != edges.len() {
            return Err(LayoutError::EdgeCount { quads: quads.len(), edges: edges.len() });
        }
        if quads.len() > MAX_QUADS {
            return Err(LayoutError::TooLarge { quads: quads.len(), limit: MAX_QUADS });
        }
        if let Some(quad) = quads.iter().position(|q| (0..4).any(|k| q[..k].contains(&q[k]))) {
            return Err(LayoutError::RepeatedVertex { quad });
        }
        let vertex_count = quads.iter().flatten().max().map_or(0, |&v| v as usize + 1);
        if vertex_count > 4 * quads.len() {
            return Err(LayoutError::VertexNumbers { vertices: vertex_count, limit: 4 * quads.len() });
        }
        let numbers = edges;
        let (edges, edge_of_side) = join_sides(quads, numbers)?;
        let is_smooth = |edge: &Edge| {
            let number = numbers[edge.first.quad as usize][edge.first.side as usize];
            edge.second.is_some() && !creases.is_some_and(|creases| creases.sharp.contains(&number))
        };
        let mut layout = Self {
            quads: quads.to_vec(),
            is_smooth: edges.iter().map(is_smooth).collect(),
            edges,
            edge_of_side,
            sectors: Vec::new(),
            sector_starts: Vec::new(),
            sector_of_corner: vec![[u32::MAX; 4]; quads.len()],
        };
        layout.collect_sectors(vertex_count, creases)?;
        Ok(layout)
    }

    /// The six faces of a cube: [`CUBE_FACES`].
    pub fn cube() -> Self {
        cube::layout()
    }

    /// The corners of each quad.
    pub fn quads(&self) -> &[[u32; 4]] {
        &self.quads
    }

    /// The edges, in the order in which the sides of the quads meet them first.
    pub fn edges(&self) -> &[Edge] {
        &self.edges
    }

    /// One more than the largest number of a vertex.
    pub fn vertex_count(&self) -> usize {
        self.sector_starts.len() - 1
    }

    /// All sectors, by vertex.
    pub fn sectors(&self) -> &[Sector] {
        &self.sectors
    }

    /// The sectors of a vertex, below [`vertex_count`](Self::vertex_count); none where no quad has it.
    pub fn sectors_of(&self, vertex: u32) -> &[Sector] {
        let [from, to] = [0, 1].map(|k| self.sector_starts[vertex as usize + k] as usize);
        &self.sectors[from..to]
    }

    /// The sector of a corner.
    pub fn sector_at(&self, corner: Side) -> &Sector {
        &self.sectors[self.sector_of_corner[corner.quad as usize][corner.side as usize] as usize]
    }

    /// The edge of a side, in the direction of the side.
    pub fn edge_of(&self, side: Side) -> HalfEdge {
        self.edge_of_side[side.quad as usize][side.side as usize]
    }

    /// The side that meets a side; none at a border.
    pub fn opposite(&self, side: Side) -> Option<Side> {
        let HalfEdge { edge, is_forward } = self.edge_of(side);
        let Edge { first, second, .. } = self.edges[edge as usize];
        if is_forward { second } else { Some(first) }
    }

    /// Whether the surface has one tangent plane across an edge.
    pub fn is_smooth(&self, edge: u32) -> bool {
        self.is_smooth[edge as usize]
    }

    /// The side that goes on smoothly across a side; none at a border or a crease.
    pub fn across(&self, side: Side) -> Option<Side> {
        self.opposite(side).filter(|_| self.is_smooth(self.edge_of(side).edge))
    }

    /// By quad, the number of the smooth piece it belongs to: pieces meet in creases or not at all.
    pub fn smooth_pieces(&self) -> Vec<u32> {
        self.pieces(|side| self.across(side)).0
    }

    /// The sectors at the begin and at the end of an edge, on its first side.
    pub fn end_sectors(&self, edge: u32) -> [&Sector; 2] {
        let first = self.edges[edge as usize].first;
        [self.sector_at(first), self.sector_at(first.next())]
    }

    /// Whether a vertex lies on a border or a crease.
    pub fn is_border(&self, vertex: u32) -> bool {
        self.sectors_of(vertex).iter().any(Sector::is_open)
    }

    /// Number of quads around a vertex.
    pub fn valence(&self, vertex: u32) -> usize {
        self.sectors_of(vertex).iter().map(Sector::valence).sum()
    }

    /// Vertices of quads minus edges plus quads: 2 for a sphere, 0 for a torus.
    pub fn euler_characteristic(&self) -> i64 {
        let vertices = self.sector_starts.windows(2).filter(|pair| pair[0] < pair[1]).count();
        vertices as i64 - self.edges.len() as i64 + self.quads.len() as i64
    }

    /// Handles of a closed layout in one piece; None for any other.
    pub fn genus(&self) -> Option<usize> {
        let is_closed = self.edges.iter().all(|edge| edge.second.is_some());
        (is_closed && self.component_count() == 1).then(|| (2 - self.euler_characteristic()) as usize / 2)
    }

    /// Pieces that no edge joins.
    pub fn component_count(&self) -> usize {
        self.pieces(|side| self.opposite(side)).1
    }

    /// The piece of each quad, and how many there are, where quads hang together by some of their sides.
    fn pieces(&self, beside: impl Fn(Side) -> Option<Side>) -> (Vec<u32>, usize) {
        let mut piece_of = vec![u32::MAX; self.quads.len()];
        let mut count = 0;
        for start in 0..self.quads.len() {
            if piece_of[start] != u32::MAX {
                continue;
            }
            piece_of[start] = count;
            let mut stack = vec![start as u32];
            while let Some(quad) = stack.pop() {
                for other in (0..4).filter_map(|side| beside(Side { quad, side })) {
                    if piece_of[other.quad as usize] == u32::MAX {
                        piece_of[other.quad as usize] = count;
                        stack.push(other.quad);
                    }
                }
            }
            count += 1;
        }
        (piece_of, count as usize)
    }
}

/// Most quads of a layout: far more than patches that make sense, and numbers of sides fit into 32 bits.
pub const MAX_QUADS: usize = 1 << 24;

/// Joins sides of equal numbers to edges.
fn join_sides(
    quads: &[[u32; 4]],
    numbers: &[[u32; 4]],
) -> Result<(Vec<Edge>, Vec<[HalfEdge; 4]>), LayoutError> {
    let mut known: BTreeMap<u32, u32> = BTreeMap::new();
    let mut edges: Vec<Edge> = Vec::with_capacity(2 * quads.len());
    let mut edge_of_side = Vec::with_capacity(quads.len());
    for (quad, (vertices, numbers)) in quads.iter().zip(numbers).enumerate() {
        let mut of_sides = [HalfEdge { edge: 0, is_forward: true }; 4];
        for k in 0..4 {
            let (side, ends) =
                (Side { quad: quad as u32, side: k as u8 }, [vertices[k], vertices[(k + 1) % 4]]);
            let edge = *known.entry(numbers[k]).or_insert(edges.len() as u32);
            of_sides[k] = HalfEdge { edge, is_forward: edge as usize == edges.len() };
            match edges.get_mut(edge as usize) {
                None => edges.push(Edge { ends, first: side, second: None }),
                Some(edge) if edge.second.is_some() => {
                    return Err(LayoutError::CrowdedEdge { quad, ends });
                }
                Some(edge) if edge.ends == ends => {
                    return Err(LayoutError::SameDirection { quad, other: edge.first.quad as usize, ends });
                }
                Some(edge) if edge.ends != [ends[1], ends[0]] => {
                    return Err(LayoutError::EdgeEnds { quad, ends, other: edge.ends });
                }
                Some(edge) => edge.second = Some(side),
            }
        }
        edge_of_side.push(of_sides);
    }
    Ok((edges, edge_of_side))
}
