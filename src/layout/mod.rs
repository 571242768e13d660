//! Quad layouts: the quadrilateral patches of a surface of any genus, closed or with borders, and how they meet.
//!
//! ```text
//!   (0,1) -----2----- (1,1)     A quad has its corners counterclockwise, and over it lie parameters in [0,1]^2.
//!     |                 |       Side k runs from corner k to corner k + 1; t is measured along it and q inwards.
//!     3                 1
//!     |                 |       Two sides that meet are one edge; they run opposite ways, so t on one is 1 - t
//!   (0,0) -----0----- (1,0)     on the other. An edge of one side is a border.
//! ```
//! Around a vertex the corners lie in sectors, counterclockwise: one that closes inside, and one from border to
//! border at a border vertex. Edges have numbers, because two quads may share more than one.

mod complex;
mod cube;
mod error;
mod node_map;
pub mod of_mesh;
#[cfg(test)]
mod tests;
mod walk;

pub use cube::{CUBE_FACES, CubeFace, cube_place};
pub use error::LayoutError;
pub use node_map::NodeMap;

use glam::DVec2;
use std::collections::BTreeMap;
use std::f64::consts::PI;

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

/// The corners around a vertex that follow one another, counterclockwise, without a border between them.
#[derive(Debug, Clone, PartialEq)]
pub struct Sector {
    /// The vertex.
    pub vertex: u32,
    /// The corners.
    pub corners: Vec<Side>,
    /// The edges away from the vertex, each before the corner of the same rank. An open sector has one more, at its
    /// end.
    pub edges: Vec<HalfEdge>,
    /// The angle of all corners together, in the tangent plane: 2 pi, or that of the border.
    pub angle: f64,
}

impl Sector {
    /// Whether it ends at borders.
    pub fn is_open(&self) -> bool {
        self.edges.len() > self.corners.len()
    }

    /// Whether the border goes straight on along it.
    pub fn is_straight(&self) -> bool {
        self.is_open() && self.angle == PI
    }

    /// Number of corners.
    pub fn valence(&self) -> usize {
        self.corners.len()
    }

    /// The angle of one corner.
    pub fn corner_angle(&self) -> f64 {
        self.angle / self.valence() as f64
    }

    /// Twice the cosine of the angle of one corner: of three edges that follow one another the outer two add up to
    /// that many times the one between. Exactly 0 for right angles.
    pub fn balance(&self) -> f64 {
        let is_right = 2.0 * self.angle == PI * self.valence() as f64;
        if is_right { 0.0 } else { 2.0 * self.corner_angle().cos() }
    }
}

/// Quadrilateral patches and how they meet.
#[derive(Debug, Clone, PartialEq)]
pub struct Layout {
    quads: Vec<[u32; 4]>,
    edges: Vec<Edge>,
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
        let (edges, edge_of_side) = join_sides(quads, edges)?;
        let mut layout = Self {
            quads: quads.to_vec(),
            edges,
            edge_of_side,
            sectors: Vec::new(),
            sector_starts: Vec::new(),
            sector_of_corner: vec![[u32::MAX; 4]; quads.len()],
        };
        layout.collect_sectors(vertex_count)?;
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

    /// The sectors of a vertex; none for a number that no quad has.
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
        self.edges[edge as usize].second.is_some()
    }

    /// The sectors at the begin and at the end of an edge, on its first side.
    pub fn end_sectors(&self, edge: u32) -> [&Sector; 2] {
        let first = self.edges[edge as usize].first;
        [self.sector_at(first), self.sector_at(first.next())]
    }

    /// Whether a vertex lies on a border.
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
        let mut is_seen = vec![false; self.quads.len()];
        let mut count = 0;
        for start in 0..self.quads.len() {
            if std::mem::replace(&mut is_seen[start], true) {
                continue;
            }
            count += 1;
            let mut stack = vec![start as u32];
            while let Some(quad) = stack.pop() {
                for side in 0..4 {
                    if let Some(other) = self.opposite(Side { quad, side })
                        && !std::mem::replace(&mut is_seen[other.quad as usize], true)
                    {
                        stack.push(other.quad);
                    }
                }
            }
        }
        count
    }

    /// Walks around each vertex, from a border if it has one.
    fn collect_sectors(&mut self, vertex_count: usize) -> Result<(), LayoutError> {
        let mut corners: Vec<Vec<Side>> = vec![Vec::new(); vertex_count];
        for (quad, vertices) in (0..).zip(&self.quads) {
            for (side, &vertex) in (0..).zip(vertices) {
                corners[vertex as usize].push(Side { quad, side });
            }
        }
        self.sector_starts.push(0);
        for (vertex, around) in (0..).zip(&corners) {
            let borders = around.iter().filter(|&&corner| self.opposite(corner).is_none());
            let Some(&start) = borders.clone().next().or(around.first()) else {
                self.sector_starts.push(self.sectors.len() as u32);
                continue;
            };
            let sector = self.sector_from(vertex, start);
            if sector.corners.len() < around.len() {
                return Err(LayoutError::NonManifoldVertex { vertex });
            }
            if !sector.is_open() && sector.valence() < 3 {
                return Err(LayoutError::Valence { vertex, valence: sector.valence() });
            }
            for corner in &sector.corners {
                let number = self.sectors.len() as u32;
                self.sector_of_corner[corner.quad as usize][corner.side as usize] = number;
            }
            self.sectors.push(sector);
            self.sector_starts.push(self.sectors.len() as u32);
        }
        Ok(())
    }

    fn sector_from(&self, vertex: u32, start: Side) -> Sector {
        let (mut corners, mut edges) = (vec![start], vec![self.edge_of(start)]);
        let mut corner = start;
        let angle = loop {
            // the last edge of a corner is the side before it, which runs towards the vertex
            match self.opposite(corner.previous()) {
                Some(next) if next == start => break 2.0 * PI,
                Some(next) => corner = next,
                None => {
                    edges.push(self.edge_of(corner.previous()).reversed());
                    break if corners.len() == 1 { PI / 2.0 } else { PI };
                }
            }
            corners.push(corner);
            edges.push(self.edge_of(corner));
        };
        Sector { vertex, corners, edges, angle }
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
