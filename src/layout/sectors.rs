//! The corners around the vertices of a layout, as creases and borders part them.
//!
//! ```text
//!        e1                 A sector begins and ends at a sharp edge, or closes around the vertex.
//!     c1 | c0               straight  angle pi: T_k = -T_0, for |angle - pi| < 25 degrees
//!   e2 --v-- e0             dart      one sharp edge at both ends, angle 2 pi
//!     c2 | c3               wedge     anything else; angles near 0, pi and 2 pi are kept away from them, for the
//!        e3                           plane of the sector is that of its two ends
//! ```
//! What is straight ties the tangents of two edges, and several sectors may contradict each other: those nearest to
//! straight go first, and one that would lay both ends of another sector on each other becomes a wedge.

use super::{HalfEdge, Layout, LayoutError, Side};
use std::collections::BTreeSet;
use std::f64::consts::{PI, TAU};

/// Which edges of a layout are sharp, and the angles between them.
#[derive(Clone, Copy)]
pub struct Creases<'a> {
    /// The sharp ones, by their numbers in the lists of the quads. Borders are sharp anyway.
    pub sharp: &'a BTreeSet<u32>,
    /// The angle of an open sector in radians, between the tangents at its ends through its corners.
    pub angle: &'a dyn Fn(&Sector) -> f64,
}

/// The corners around a vertex that follow one another, counterclockwise, without a sharp edge between them.
#[derive(Debug, Clone, PartialEq)]
pub struct Sector {
    /// The vertex.
    pub vertex: u32,
    /// The corners.
    pub corners: Vec<Side>,
    /// The edges away from the vertex, each before the corner of the same rank. An open sector has one more, at its
    /// end.
    pub edges: Vec<HalfEdge>,
    /// The angle of all corners together, in the tangent plane: 2 pi, or that between the sharp edges.
    pub angle: f64,
}

impl Sector {
    /// Whether it ends at sharp edges.
    pub fn is_open(&self) -> bool {
        self.edges.len() > self.corners.len()
    }

    /// Whether the sharp edge goes straight on along it.
    pub fn is_straight(&self) -> bool {
        self.is_open() && self.angle == PI
    }

    /// Whether it begins and ends at the same edge: a crease that ends in a smooth surface.
    pub fn is_dart(&self) -> bool {
        self.is_open() && self.edges.first() == self.edges.last()
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

    /// The edges at its ends.
    fn ends(&self) -> [HalfEdge; 2] {
        [self.edges[0], self.edges[self.edges.len() - 1]]
    }
}

/// Nearer to straight than this, 25 degrees, a sharp edge goes straight on.
const STRAIGHT: f64 = 25.0 / 180.0 * PI;
/// Least angle of a wedge and least distance from a full turn, 5 degrees: its plane is that of its ends.
const LEAST_WEDGE: f64 = 5.0 / 180.0 * PI;
/// Fewest corners without a sharp edge between them that have a tangent plane: of a closed sector or a dart.
const LEAST_AROUND: usize = 3;

impl Layout {
    /// Walks around each vertex, from sharp edges if it has some.
    pub(super) fn collect_sectors(
        &mut self,
        vertex_count: usize,
        creases: Option<&Creases>,
    ) -> Result<(), LayoutError> {
        let mut corners: Vec<Vec<Side>> = vec![Vec::new(); vertex_count];
        for (quad, vertices) in (0..).zip(&self.quads) {
            for (side, &vertex) in (0..).zip(vertices) {
                corners[vertex as usize].push(Side { quad, side });
            }
        }
        self.sector_starts.push(0);
        for (vertex, around) in (0..).zip(&corners) {
            let mut sectors = self.sectors_from(vertex, around);
            let count: usize = sectors.iter().map(Sector::valence).sum();
            if count < around.len() || (creases.is_none() && sectors.len() > 1) {
                return Err(LayoutError::NonManifoldVertex { vertex });
            }
            for sector in sectors.iter_mut().filter(|sector| sector.is_open()) {
                sector.angle = match creases {
                    _ if sector.is_dart() => TAU,
                    Some(creases) => (creases.angle)(sector),
                    None if sector.valence() == 1 => PI / 2.0,
                    None => PI,
                };
            }
            let needs_more =
                |sector: &&Sector| (!sector.is_open() || sector.is_dart()) && sector.valence() < LEAST_AROUND;
            if let Some(sector) = sectors.iter().find(needs_more) {
                return Err(LayoutError::Valence { vertex, valence: sector.valence() });
            }
            settle_angles(&mut sectors);
            for sector in sectors {
                for corner in &sector.corners {
                    let number = self.sectors.len() as u32;
                    self.sector_of_corner[corner.quad as usize][corner.side as usize] = number;
                }
                self.sectors.push(sector);
            }
            self.sector_starts.push(self.sectors.len() as u32);
        }
        Ok(())
    }

    /// The sectors of a vertex, in the order of the corners at which they begin.
    fn sectors_from(&self, vertex: u32, around: &[Side]) -> Vec<Sector> {
        let is_start = |corner: &&Side| self.across(**corner).is_none();
        let starts: Vec<Side> = around.iter().filter(is_start).copied().collect();
        let starts = if starts.is_empty() { &around[..around.len().min(1)] } else { &starts };
        starts.iter().map(|&start| self.sector_from(vertex, start)).collect()
    }

    fn sector_from(&self, vertex: u32, start: Side) -> Sector {
        let (mut corners, mut edges) = (vec![start], vec![self.edge_of(start)]);
        let mut corner = start;
        loop {
            // the last edge of a corner is the side before it, which runs towards the vertex
            match self.across(corner.previous()) {
                Some(next) if next == start => break,
                Some(next) => corner = next,
                None => {
                    edges.push(self.edge_of(corner.previous()).reversed());
                    break;
                }
            }
            corners.push(corner);
            edges.push(self.edge_of(corner));
        }
        Sector { vertex, corners, edges, angle: TAU }
    }
}

/// Makes the angles of the open sectors of a vertex those of straight edges, darts and wedges.
fn settle_angles(sectors: &mut [Sector]) {
    let is_between = |sector: &Sector| sector.is_open() && !sector.is_dart();
    let off = |sector: &Sector| (sector.angle - PI).abs();
    let mut nearly: Vec<usize> =
        (0..sectors.len()).filter(|&k| is_between(&sectors[k]) && off(&sectors[k]) < STRAIGHT).collect();
    nearly.sort_by(|&a, &b| off(&sectors[a]).total_cmp(&off(&sectors[b])));
    let mut ties: Vec<[HalfEdge; 2]> = Vec::new();
    for tie in nearly.iter().map(|&k| sectors[k].ends()) {
        ties.push(tie);
        // no other sector may have both ends in one direction
        let mut others = sectors.iter().filter(|sector| is_between(sector));
        if others.any(|sector| sense(&ties, sector.ends()) == Some(1)) {
            ties.pop();
        }
    }
    for sector in sectors.iter_mut().filter(|sector| is_between(sector)) {
        sector.angle = match sense(&ties, sector.ends()) {
            Some(_) => PI,
            None if sector.angle <= PI => sector.angle.clamp(LEAST_WEDGE, PI - STRAIGHT),
            None => sector.angle.clamp(PI + STRAIGHT, TAU - LEAST_WEDGE),
        };
    }
}

/// Whether ties make one edge's tangent the other's (1) or its opposite (-1); None if they leave them apart.
fn sense(ties: &[[HalfEdge; 2]], [from, to]: [HalfEdge; 2]) -> Option<i8> {
    let mut known = vec![(from, 1)];
    let mut at = 0;
    while let Some(&(edge, sign)) = known.get(at) {
        at += 1;
        for tie in ties {
            for [here, there] in [[tie[0], tie[1]], [tie[1], tie[0]]] {
                if here == edge && known.iter().all(|&(other, _)| other != there) {
                    known.push((there, -sign));
                }
            }
        }
    }
    known.iter().find(|&&(edge, _)| edge == to).map(|&(_, sign)| sign)
}
