//! Smooth surfaces of many patches: bicubic PHT-splines over the quads of a layout, with one tangent plane across
//! edges and at vertices of any number of quads.
//!
//! J. Deng et al., "Polynomial splines over hierarchical T-meshes", Graph. Models 70 (2008), section 5.2, for the
//! cube; J. Peters, J. Fan, "On the complexity of smooth spline surfaces from quad meshes", Comput. Aided Geom. Des. 27
//! (2010), for any layout. With the edge curve E(s), and p, q inwards on the quads A, B beside it:
//! ```text
//! edge     A_p + B_q = g(s) E'(s):    A_p = D + g E'/2,  B_q = -D + g E'/2,  and their derivatives along s
//! vertex   T_{i-1} + T_{i+1} = c T_i, c = 2 cos a:   T_i = cos(i a) X + sin(i a) Y
//! twists   W_{i-1} + W_i = R_i = g'(0) T_i + c E_i''(0)
//! ```
//! T_i is the derivative of edge i away from the vertex and W_i the twist of the quad between the edges i and i + 1. Around an
//! odd number of quads the twists follow; around an even number W_0 is free and `sum (-1)^i R_i = 0` must hold
//! (vertex enclosure): four quads see to it by the choice of [`g`](Rule), six and more by one equation each.
//!
//! The space is a linear map: jets at the basis vertices of all quads out of numbers without conditions,
//! ```text
//! vertex   P, X, Y, and W_0 for an even number of quads or at a border
//! edge     E_j at inner breaks (and E'_j where g = 0), D_j, D'_j
//! inside   the four rows of the jet
//! ```
//! so whatever the unknowns are, the surface is smooth to rounding, apart from the few enclosure equations.
//!
//! Across a crease the sides share E alone: E_j and E'_j are free, and each side has its own D_j and D'_j. Around a vertex
//! creases part the quads into sectors, each with its own plane that the tangents T_0, T_k at its ends span; where they lie
//! on one line (a crease that goes straight on, or ends there) the plane has a free direction Y.

mod combination;
mod conform;
mod edge_curve;
mod edge_function;
mod measure;
#[cfg(test)]
mod tests;
mod vertex;

pub use combination::Combination;
pub use conform::{conform, uniform};
pub use edge_function::{EdgeFunction, End, Rule};
pub use measure::{Jump, enclosed_volume, normal_jump};

use super::pht::{PhtError, PhtSurface};
use crate::failure::{Classify, ErrorKind};
use crate::layout::{Layout, Side};
use crate::tmesh::{TMesh, Topology, Vertex, VertexKind};
use edge_curve::EdgeCurve;

/// A smooth space cannot be built over these meshes.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum SpaceError {
    /// The numbers of meshes and quads differ.
    #[error("{meshes} meshes are given for {quads} quads")]
    MeshCount {
        /// Meshes given.
        meshes: usize,
        /// Quads of the layout.
        quads: usize,
    },
    /// A mesh has more than one initial cell.
    #[error("the mesh of quad {quad} does not start from one cell")]
    InitialGrid {
        /// The quad.
        quad: usize,
    },
    /// The breaks of the sides of an edge differ.
    #[error("the vertices of quads {} and {} differ along edge {edge}", quads[0], quads[1])]
    NotConforming {
        /// The edge.
        edge: usize,
        /// The quads beside it.
        quads: [u32; 2],
    },
    /// An edge needs more segments.
    #[error("edge {edge} has one segment and needs two: split each quad once at least")]
    TooCoarse {
        /// The edge.
        edge: usize,
    },
}

impl Classify for SpaceError {
    fn kind(&self) -> ErrorKind {
        ErrorKind::InvalidArgument
    }

    /// The offending quad or edge.
    fn index(&self) -> Option<usize> {
        match *self {
            Self::MeshCount { .. } => None,
            Self::InitialGrid { quad } => Some(quad),
            Self::NotConforming { edge, .. } | Self::TooCoarse { edge } => Some(edge),
        }
    }
}

/// Rows of a jet.
const ROWS: usize = 4;

/// An equation that the free unknowns have to keep, around an inner vertex of six or more quads.
#[derive(Debug, Clone, PartialEq)]
pub struct Enclosure {
    /// The vertex.
    pub vertex: u32,
    /// The combination that vanishes.
    pub sum: Combination,
}

/// A free unknown of the curve over a sharp edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CreaseUnknown {
    /// The edge.
    pub edge: u32,
    /// Its number.
    pub unknown: u32,
    /// Whether it is a place, not a derivative along the edge.
    pub is_position: bool,
}

/// A smooth space over a layout.
#[derive(Debug, Clone)]
pub struct Space<'a> {
    layout: &'a Layout,
    meshes: Vec<TMesh>,
    topologies: Vec<Topology>,
    /// The first jet of each quad, and the number of jets.
    starts: Vec<u32>,
    /// Four rows a jet.
    rows: Vec<Combination>,
    free_count: usize,
    enclosures: Vec<Enclosure>,
    /// The position of each vertex.
    positions: Vec<Combination>,
    crease_unknowns: Vec<CreaseUnknown>,
}

impl<'a> Space<'a> {
    /// The space over one mesh a quad, each from a single cell, with equal vertices along edges.
    pub fn new(layout: &'a Layout, meshes: Vec<TMesh>) -> Result<Self, SpaceError> {
        if meshes.len() != layout.quads().len() {
            return Err(SpaceError::MeshCount { meshes: meshes.len(), quads: layout.quads().len() });
        }
        if let Some(quad) = meshes.iter().position(|mesh| mesh.grid_size() != [1, 1]) {
            return Err(SpaceError::InitialGrid { quad });
        }
        let topologies: Vec<Topology> = meshes.iter().map(Topology::new).collect();
        let mut starts = vec![0];
        for topology in &topologies {
            starts.push(starts[starts.len() - 1] + topology.basis.len() as u32);
        }
        let rows = vec![Combination::default(); ROWS * starts[starts.len() - 1] as usize];
        let mut space = Self {
            layout,
            meshes,
            topologies,
            starts,
            rows,
            free_count: 0,
            enclosures: Vec::new(),
            positions: Vec::new(),
            crease_unknowns: Vec::new(),
        };
        space.build()?;
        Ok(space)
    }

    /// The layout.
    pub fn layout(&self) -> &'a Layout {
        self.layout
    }

    /// The mesh of each quad.
    pub fn meshes(&self) -> &[TMesh] {
        &self.meshes
    }

    /// The tables of each mesh.
    pub fn topologies(&self) -> &[Topology] {
        &self.topologies
    }

    /// Number of free unknowns a component.
    pub fn free_count(&self) -> usize {
        self.free_count
    }

    /// Control points of all quads, four a basis vertex.
    pub fn coefficient_count(&self) -> usize {
        self.rows.len()
    }

    /// The equations that the unknowns have to keep.
    pub fn enclosures(&self) -> &[Enclosure] {
        &self.enclosures
    }

    /// The unknowns of the curves over all sharp edges; those at a vertex once for each of its edges.
    pub fn crease_unknowns(&self) -> &[CreaseUnknown] {
        &self.crease_unknowns
    }

    /// The unknown that is the place of a vertex; none for a number that no quad has.
    pub fn vertex_unknown(&self, vertex: u32) -> Option<u32> {
        self.positions[vertex as usize].terms().first().map(|&(number, _)| number)
    }

    /// The four rows of the jet of a basis vertex of a quad.
    pub fn jet_rows(&self, quad: usize, rank: u32) -> &[Combination] {
        &self.rows[ROWS * (self.starts[quad] + rank) as usize..][..ROWS]
    }

    /// The surfaces that rows of `dim` numbers for the free unknowns give, one a quad.
    pub fn surfaces(&self, unknowns: &[f64], dim: usize) -> Result<Vec<PhtSurface>, PhtError> {
        let row = |combination: &Combination| {
            let mut row = vec![0.0; dim];
            for &(number, factor) in combination.terms() {
                let unknown = &unknowns[number as usize * dim..][..dim];
                row.iter_mut().zip(unknown).for_each(|(sum, x)| *sum += factor * x);
            }
            row
        };
        let surface = |(quad, mesh): (usize, &TMesh)| {
            let [from, to] = [quad, quad + 1].map(|k| ROWS * self.starts[k] as usize);
            let jets: Vec<f64> = self.rows[from..to].iter().flat_map(row).collect();
            PhtSurface::new(dim, false, mesh.clone(), &jets)
        };
        self.meshes.iter().enumerate().map(surface).collect()
    }

    fn free(&mut self) -> Combination {
        self.free_count += 1;
        Combination::unknown(self.free_count as u32 - 1)
    }

    fn build(&mut self) -> Result<(), SpaceError> {
        let vertices = self.vertex_positions();
        let tangents = self.tangents();
        let balances = self.edges(&vertices, &tangents)?;
        self.corners(&vertices, &tangents, &balances);
        self.inside();
        self.positions = vertices;
        Ok(())
    }

    /// Stores the jet that has these derivatives along a side of a quad, inwards, and both.
    fn put(&mut self, side: Side, rank: u32, value: &Combination, along: [&Combination; 3]) {
        let [t, q] = SIDE_ROWS[side.side as usize];
        let [f_t, f_q, f_tq] = along;
        let first = ROWS * (self.starts[side.quad as usize] + rank) as usize;
        self.rows[first] = value.clone();
        self.rows[first + t.row] = f_t.scaled(t.sign);
        self.rows[first + q.row] = f_q.scaled(q.sign);
        self.rows[first + 3] = f_tq.scaled(t.sign * q.sign);
    }

    /// Unknowns and jets of the inner breaks of all edges; returns R for each direction of each edge.
    fn edges(
        &mut self,
        positions: &[Combination],
        tangents: &[Combination],
    ) -> Result<Vec<Combination>, SpaceError> {
        let mut balances = vec![Combination::default(); tangents.len()];
        for number in 0..self.layout.edges().len() as u32 {
            let edge = self.layout.edges()[number as usize];
            let sides: Vec<SideBreaks> = self.breaks(number)?;
            let breaks: Vec<f64> = sides[0].1.iter().map(|&(s, _)| s).collect();
            let rule = Rule::of(self.layout, number);
            let is_smooth = self.layout.is_smooth(number);
            if is_smooth && breaks.len() <= rule.least_segments() {
                return Err(SpaceError::TooCoarse { edge: number as usize });
            }
            let [begin, end] = edge.ends.map(|vertex| &positions[vertex as usize]);
            let [away, back] = [0, 1].map(|k| &tangents[2 * number as usize + k]);
            let function = rule.function(self.layout.end_sectors(number).map(|end| end.balance()), &breaks);
            let function = function.filter(|_| is_smooth);
            let curve = self.curve(&breaks, function.as_ref(), [begin, end], [away, back]);
            for j in 1..breaks.len() - 1 {
                self.break_jets(&sides, j, &curve, is_smooth);
            }
            if !is_smooth {
                self.note_crease(number, &curve);
            }
            if let Some(g) = &function {
                let last = breaks.len() - 1;
                let [from, to] = [0, last].map(|k| g.values[k]);
                balances[2 * number as usize] =
                    Combination::sum([(g.right[0], away), (from, &curve.second[0])]);
                balances[2 * number as usize + 1] =
                    Combination::sum([(g.left[last], back), (-to, &curve.second[last])]);
            }
        }
        Ok(balances)
    }

    /// The breaks of an edge with the ranks of the vertices there, for each of its sides in the direction of the first.
    fn breaks(&self, number: u32) -> Result<Vec<SideBreaks>, SpaceError> {
        let edge = self.layout.edges()[number as usize];
        let mut sides = vec![(edge.first, self.side_vertices(edge.first))];
        if let Some(second) = edge.second {
            let mut vertices = self.side_vertices(second);
            vertices.reverse();
            vertices.iter_mut().for_each(|(s, _)| *s = 1.0 - *s);
            let breaks = |vertices: &[(f64, u32)]| vertices.iter().map(|&(s, _)| s).collect::<Vec<f64>>();
            if breaks(&sides[0].1) != breaks(&vertices) {
                let quads = [edge.first.quad, second.quad];
                return Err(SpaceError::NotConforming { edge: number as usize, quads });
            }
            sides.push((second, vertices));
        }
        Ok(sides)
    }

    /// The basis vertices on a side of a quad along it: t and rank.
    fn side_vertices(&self, side: Side) -> Vec<(f64, u32)> {
        let topology = &self.topologies[side.quad as usize];
        let unit = Vertex::side_at(0);
        let along = |vertex: Vertex| {
            let [t, q] = match side.side {
                0 => [vertex.i, vertex.j],
                1 => [vertex.j, unit - vertex.i],
                2 => [unit - vertex.i, unit - vertex.j],
                _ => [unit - vertex.j, vertex.i],
            };
            (q == 0).then_some(t)
        };
        let on_side = |(rank, &vertex): (usize, &u32)| {
            along(topology.vertices[vertex as usize]).map(|t| (t, rank as u32))
        };
        let mut vertices: Vec<(u32, u32)> = topology.basis.iter().enumerate().filter_map(on_side).collect();
        vertices.sort_unstable();
        vertices.into_iter().map(|(t, rank)| (f64::from(t) / f64::from(unit), rank)).collect()
    }

    /// E, E' and what g makes of them, at all breaks.
    fn curve(
        &mut self,
        breaks: &[f64],
        function: Option<&EdgeFunction>,
        [begin, end]: [&Combination; 2],
        [away, back]: [&Combination; 2],
    ) -> Curve {
        let last = breaks.len() - 1;
        let end_slope = back.scaled(-1.0);
        let Some(g) = function else {
            let mut rows = vec![[begin.clone(), away.clone()]];
            rows.extend((1..last).map(|_| [self.free(), self.free()]));
            rows.push([end.clone(), end_slope]);
            let none = vec![Combination::default(); last + 1];
            return Curve { rows, second: none.clone(), half: none.clone(), half_slope: none };
        };
        let curve = EdgeCurve::new(breaks, g);
        let mut inputs = vec![begin.clone()];
        inputs.extend((1..last).map(|j| if curve.is_free(j) { self.free() } else { Combination::default() }));
        inputs.extend([end.clone(), away.clone(), end_slope]);
        let expand = |row: &[f64]| {
            let negligible = NEGLIGIBLE * row.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
            let terms = row.iter().zip(&inputs).filter(|(factor, _)| factor.abs() > negligible);
            Combination::sum(terms.map(|(&factor, input)| (factor, input)))
        };
        let rows: Vec<[Combination; 2]> =
            curve.positions.iter().zip(&curve.slopes).map(|(e, d)| [expand(e), expand(d)]).collect();
        let second: Vec<Combination> = (0..=last)
            .map(|j| expand(&if j < last { curve.second_right(j) } else { curve.second_left(j) }))
            .collect();
        let half = (0..=last).map(|j| rows[j][1].scaled(0.5 * g.values[j])).collect();
        let half_slope = (0..=last)
            .map(|j| Combination::sum([(0.5 * g.right[j], &rows[j][1]), (0.5 * g.values[j], &second[j])]))
            .collect();
        Curve { rows, second, half, half_slope }
    }

    /// Over a sharp edge each position and derivative is an unknown, or the opposite of one.
    fn note_crease(&mut self, edge: u32, curve: &Curve) {
        for (row, is_position) in curve.rows.iter().flat_map(|[e, d]| [(e, true), (d, false)]) {
            let unknowns = row.terms().iter();
            self.crease_unknowns.extend(unknowns.map(|&(unknown, _)| CreaseUnknown {
                edge,
                unknown,
                is_position,
            }));
        }
    }

    /// Jets at an inner break, on both sides of an edge.
    fn break_jets(&mut self, sides: &[SideBreaks], j: usize, curve: &Curve, is_smooth: bool) {
        let [position, slope] = &curve.rows[j];
        let mut across = [self.free(), self.free()];
        for (rank, (side, vertices)) in sides.iter().enumerate() {
            if rank > 0 && !is_smooth {
                across = [self.free(), self.free()];
            }
            // the second side runs the other way, and lies on the other side of D
            let sign = if rank == 0 { 1.0 } else { -1.0 };
            let share = if is_smooth { sign } else { 1.0 };
            let inwards = Combination::sum([(share, &across[0]), (1.0, &curve.half[j])]);
            let twist = Combination::sum([(sign * share, &across[1]), (sign, &curve.half_slope[j])]);
            self.put(*side, vertices[j].1, position, [&slope.scaled(sign), &inwards, &twist]);
        }
    }

    /// Unknowns of the basis vertices inside the quads.
    fn inside(&mut self) {
        for quad in 0..self.meshes.len() {
            for rank in 0..self.topologies[quad].basis.len() {
                let topology = &self.topologies[quad];
                let vertex = topology.vertices[topology.basis[rank] as usize];
                if !self.meshes[quad].is_border(vertex) {
                    let first = ROWS * (self.starts[quad] as usize + rank);
                    for row in 0..ROWS {
                        self.rows[first + row] = self.free();
                    }
                }
            }
        }
    }

    /// The rank of the basis vertex at a corner of a quad.
    fn corner_rank(&self, corner: Side) -> u32 {
        let topology = &self.topologies[corner.quad as usize];
        let unit = Vertex::side_at(0);
        let [i, j] = [[0, 0], [unit, 0], [unit, unit], [0, unit]][corner.side as usize];
        let number = topology.vertices.binary_search(&Vertex { i, j }).expect("corners are vertices");
        let VertexKind::Basis(rank) = topology.kinds[number] else {
            unreachable!("corners are on the border")
        };
        rank
    }
}

/// Factors of the inputs of an edge curve below this part of the largest are left out: below rounding, and far
/// segments do not fill the matrix.
const NEGLIGIBLE: f64 = 1e-18;

/// A side with its breaks along the edge and the ranks of the vertices there.
type SideBreaks = (Side, Vec<(f64, u32)>);

/// What an edge has at its breaks.
struct Curve {
    /// E and E'.
    rows: Vec<[Combination; 2]>,
    /// E'' to the right of each break, at the last one to its left.
    second: Vec<Combination>,
    /// g E' / 2.
    half: Vec<Combination>,
    /// Its derivative.
    half_slope: Vec<Combination>,
}

/// Where a derivative along or across a side is in a jet.
#[derive(Clone, Copy)]
struct Component {
    row: usize,
    sign: f64,
}

const fn component(row: usize, sign: f64) -> Component {
    Component { row, sign }
}

/// For each side the derivatives along t and q: `f_t = sign row`.
const SIDE_ROWS: [[Component; 2]; 4] = [
    [component(1, 1.0), component(2, 1.0)],
    [component(2, 1.0), component(1, -1.0)],
    [component(1, -1.0), component(2, -1.0)],
    [component(2, -1.0), component(1, 1.0)],
];
