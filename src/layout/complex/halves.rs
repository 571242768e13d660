//! Quads whatever the triangles: every cell is cut at the middles of its sides.
//!
//! ```text
//!      c                  d ---+--- c
//!     / \                 |    |    |      A pair of triangles becomes four quads, a single triangle three. Every edge
//!    +   +                +----*----+      falls into two halves, those of the border too, and there is no parity to
//!   / `*' \               |    |    |      keep: the last resort, with two to four times the patches.
//!  a --+-- b              a ---+--- b
//! ```

use super::base::{Base, TrianglePlace};
use super::pairing::Pairing;
use super::quad_place;
use crate::layout::bilinear::place_in;
use crate::layout::{Place, Side};
use glam::DVec2;
use std::collections::BTreeMap;

/// Quads over the halves of all edges.
pub(super) struct Halves {
    /// The vertices of the base first, then the middles of edges and of cells.
    pub corners: Vec<[u32; 4]>,
    /// The number of each side's edge.
    pub edges: Vec<[u32; 4]>,
    /// By node of the middle level.
    pub places: Vec<Option<Place>>,
}

/// Takes pairs apart at vertices that would have too few cells.
pub(super) fn take_apart(pairing: &mut Pairing) {
    let is_bad = |quad: &[u32; 4]| [quad[0], quad[2]].iter().any(|end| pairing.starved.contains(end));
    let mut number = Vec::new();
    let mut kept = Vec::new();
    for quad in &pairing.quads {
        number.push((!is_bad(quad)).then_some(kept.len() as u32));
        if !is_bad(quad) {
            kept.push(*quad);
        }
    }
    pairing.quads = kept;
    for quad in &mut pairing.quad_of {
        *quad = quad.and_then(|quad| number[quad as usize]);
    }
}

/// The quads of all cells.
pub(super) fn halved(base: &Base, pairing: &Pairing) -> Halves {
    let singles: Vec<usize> = (0..base.triangles.len()).filter(|&t| pairing.quad_of[t].is_none()).collect();
    let of_quads = pairing.quads.iter().map(|quad| quad.to_vec());
    let cells: Vec<Vec<u32>> = of_quads.chain(singles.iter().map(|&t| base.triangles[t].to_vec())).collect();
    let mut middles: BTreeMap<[u32; 2], u32> = BTreeMap::new();
    let vertex_count = base.points.len() as u32;
    for (a, b) in cells.iter().flat_map(|cell| sides(cell)) {
        let next = vertex_count + middles.len() as u32;
        middles.entry([a.min(b), a.max(b)]).or_insert(next);
    }
    let first_centre = vertex_count + middles.len() as u32;
    let (mut corners, mut first_quads) = (Vec::new(), Vec::new());
    for (centre, cell) in (first_centre..).zip(&cells) {
        first_quads.push(corners.len() as u32);
        let count = cell.len();
        let middle = |k: usize| {
            let [a, b] = [cell[k % count], cell[(k + 1) % count]];
            middles[&[a.min(b), a.max(b)]]
        };
        corners.extend((0..count).map(|k| [cell[k], middle(k), centre, middle(k + count - 1)]));
    }
    let single_cell = |t: usize| pairing.quads.len() + singles.partition_point(|&single| single < t);
    let place = |place: &TrianglePlace| match pairing.quad_of[place.triangle as usize] {
        Some(quad) => {
            quad_place(base, pairing, *place).map(|place| in_quad(place, first_quads[quad as usize]))
        }
        None => Some(in_triangle(place.weights, first_quads[single_cell(place.triangle as usize)])),
    };
    let places = base.places.iter().map(|found| found.as_ref().and_then(place)).collect();
    Halves { edges: super::edge_numbers(&corners), corners, places }
}

fn sides(cell: &[u32]) -> impl Iterator<Item = (u32, u32)> + '_ {
    cell.iter().copied().zip(cell.iter().copied().cycle().skip(1))
}

/// The place in the quarter that it lies in.
fn in_quad(place: Place, first: u32) -> Place {
    let [right, high] = [place.uv.x > 0.5, place.uv.y > 0.5];
    let corner = match (right, high) {
        (false, false) => 0,
        (true, false) => 1,
        (true, true) => 2,
        (false, true) => 3,
    };
    let [t, q] = Side { quad: place.quad, side: corner }.coordinates(place.uv);
    let uv = DVec2::new(2.0 * t, 2.0 * q).clamp(DVec2::ZERO, DVec2::ONE);
    Place { quad: first + u32::from(corner), uv }
}

/// The place in the third of a triangle whose corner has the most weight.
fn in_triangle(weights: [f64; 3], first: u32) -> Place {
    const THIRD: [DVec2; 4] =
        [DVec2::ZERO, DVec2::new(0.5, 0.0), DVec2::splat(1.0 / 3.0), DVec2::new(0.0, 0.5)];
    let corner = (0..3).max_by(|&a, &b| weights[a].total_cmp(&weights[b])).unwrap_or(0);
    let point = DVec2::new(weights[(corner + 1) % 3], weights[(corner + 2) % 3]);
    Place { quad: first + corner as u32, uv: place_in(&THIRD, point) }
}
