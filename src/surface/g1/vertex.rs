//! What a space has at the vertices of the layout: positions, tangents in one plane, twists.

use super::{Combination, Enclosure, Space};
use crate::layout::Sector;

impl Space<'_> {
    /// P of each vertex.
    pub(super) fn vertex_positions(&mut self) -> Vec<Combination> {
        let has_quads = |vertex: u32| !self.layout.sectors_of(vertex).is_empty();
        let is_used: Vec<bool> = (0..self.layout.vertex_count() as u32).map(has_quads).collect();
        is_used.into_iter().map(|used| if used { self.free() } else { Combination::default() }).collect()
    }

    /// T of each direction of each edge.
    pub(super) fn tangents(&mut self) -> Vec<Combination> {
        let mut tangents: Vec<Option<Combination>> = vec![None; 2 * self.layout.edges().len()];
        for vertex in 0..self.layout.vertex_count() as u32 {
            let sectors = self.layout.sectors_of(vertex);
            let mut straight: Vec<&Sector> = sectors.iter().filter(|sector| sector.is_straight()).collect();
            while !straight.is_empty() {
                // what hangs on a known tangent comes first, so that a row of them has one
                let is_known = |sector: &&Sector| ends(sector).iter().any(|&end| tangents[end].is_some());
                let next = straight.iter().position(is_known).unwrap_or(0);
                self.tie_ends(straight.remove(next), &mut tangents);
            }
            for sector in sectors.iter().filter(|sector| sector.is_open()) {
                for end in ends(sector) {
                    tangents[end].get_or_insert_with(|| self.free());
                }
            }
            for sector in sectors {
                self.fan(sector, &mut tangents);
            }
        }
        tangents.into_iter().map(|tangent| tangent.expect("an edge lies in a sector at both ends")).collect()
    }

    /// The sharp edge goes straight on: T_k = -T_0.
    fn tie_ends(&mut self, sector: &Sector, tangents: &mut [Option<Combination>]) {
        let [first, last] = ends(sector);
        match (&tangents[first], &tangents[last]) {
            (None, None) => {
                let tangent = self.free();
                tangents[last] = Some(tangent.scaled(-1.0));
                tangents[first] = Some(tangent);
            }
            (Some(tangent), None) => tangents[last] = Some(tangent.scaled(-1.0)),
            (None, Some(tangent)) => tangents[first] = Some(tangent.scaled(-1.0)),
            (Some(_), Some(_)) => {}
        }
    }

    /// T_i = cos(i a) X + sin(i a) Y inside a sector.
    fn fan(&mut self, sector: &Sector, tangents: &mut [Option<Combination>]) {
        if sector.is_open() && sector.valence() == 1 {
            return;
        }
        let [first, last] = ends(sector);
        let (sin, cos) = exact_sin_cos(sector.angle);
        let known = sector.is_open().then(|| tangents[first].clone()).flatten();
        let x = known.unwrap_or_else(|| self.free());
        let y = match &tangents[last] {
            // what an open sector ends with fixes the plane
            Some(end) if sector.is_open() && sin != 0.0 => {
                Combination::sum([(1.0 / sin, end), (-cos / sin, &x)])
            }
            _ => self.free(),
        };
        for (i, edge) in sector.edges.iter().enumerate().take(sector.valence()) {
            let (sin, cos) = exact_sin_cos(i as f64 * sector.corner_angle());
            if i > 0 || !sector.is_open() {
                tangents[edge.index()] = Some(Combination::sum([(cos, &x), (sin, &y)]));
            }
        }
    }

    /// Jets at the corners of the quads: `balances` are R for each direction of each edge.
    pub(super) fn corners(
        &mut self,
        positions: &[Combination],
        tangents: &[Combination],
        balances: &[Combination],
    ) {
        for sector in self.layout.sectors() {
            let right: Vec<&Combination> = sector.edges.iter().map(|edge| &balances[edge.index()]).collect();
            let twists = self.twists(sector, &right);
            for (i, (corner, twist)) in sector.corners.iter().zip(&twists).enumerate() {
                let [along, across] = [i, (i + 1) % sector.edges.len()].map(|k| sector.edges[k].index());
                let slopes = [&tangents[along], &tangents[across], twist];
                self.put(*corner, self.corner_rank(*corner), &positions[sector.vertex as usize], slopes);
            }
        }
    }

    /// W_i of the corners of a sector, with `W_{i-1} + W_i = R_i`.
    fn twists(&mut self, sector: &Sector, right: &[&Combination]) -> Vec<Combination> {
        let n = sector.valence();
        if !sector.is_open() && n % 2 == 1 {
            let term =
                |i: usize, k: usize| (if k.is_multiple_of(2) { 0.5 } else { -0.5 }, right[(i + 1 + k) % n]);
            return (0..n).map(|i| Combination::sum((0..n).map(|k| term(i, k)))).collect();
        }
        let mut twists = vec![self.free()];
        for i in 1..n {
            twists.push(Combination::sum([(1.0, right[i]), (-1.0, &twists[i - 1])]));
        }
        if !sector.is_open() {
            let signs = [1.0, -1.0].into_iter().cycle();
            let sum = Combination::sum(signs.zip(right.iter().copied()));
            if n == 4 {
                debug_assert!(sum.largest() <= ENCLOSED, "slopes at vertex {}", sector.vertex);
            } else {
                self.enclosures.push(Enclosure { vertex: sector.vertex, sum });
            }
        }
        twists
    }
}

/// Rounding of slopes, which are of size 1, at a vertex of four quads.
const ENCLOSED: f64 = 1e-12;

/// The directions of the edges at both ends.
fn ends(sector: &Sector) -> [usize; 2] {
    [&sector.edges[0], &sector.edges[sector.edges.len() - 1]].map(|edge| edge.index())
}

/// Sine and cosine, exactly 0 at multiples of right angles.
fn exact_sin_cos(angle: f64) -> (f64, f64) {
    let exact = |x: f64| if x.abs() <= 4.0 * f64::EPSILON { 0.0 } else { x };
    let (sin, cos) = angle.sin_cos();
    (exact(sin), exact(cos))
}
