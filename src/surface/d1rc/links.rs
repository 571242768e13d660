//! Configurations that reproduce polynomials: links of links.
//!
//! After Y. Liu, J. Snoeyink, "Quadratic and cubic B-splines by generalizing higher-order Voronoi diagrams" (2007),
//! from any triangulation in place of Delaunay's:
//! ```text
//! G_0     = the triangles of the mesh, each with the empty set
//! link(J) = the edges opposite to x in all (X,t) of G_(k-1) with x in t and X + x = J, less pairs of opposites
//! G_k     = each link triangulated, with the set J
//! ```
//! The functions of degree k have the knots J and the edges link(J). Seen from `sum_J b_J`, an inner edge of a
//! triangulation occurs twice with opposite signs and each level passes the sum on to the one below, down to the
//! triangles of the mesh: `sum b_J = 1` wherever all links close, and polynomials up to degree k are reproduced.

use super::polygon::triangulate;
use crate::control::{Cancelled, Watch};
use crate::memory::{self, CollectVec};
use glam::DVec2;

/// Up to three knots in increasing order, filled up with [`NONE`].
type KnotSet = [u32; 3];
const NONE: u32 = u32::MAX;

/// The knots of a function, and the closed edges around them.
pub(super) struct Link {
    pub knots: Vec<u32>,
    pub edges: Vec<[u32; 2]>,
}

/// All links of one degree.
pub(super) struct Links {
    pub closed: Vec<Link>,
    /// The knots of elements with a corner for which there is no link: under their hulls the functions do not sum
    /// to one.
    pub lost: Vec<Vec<u32>>,
}

/// The link of a set is not a union of simple counter-clockwise cycles.
pub(super) struct NotSimple {
    /// One of the set.
    pub knot: u32,
}

/// The links of all sets of `degree` knots that close. Around knots on the border of the triangles none does.
pub(super) fn links(
    places: &[DVec2],
    triangles: &[[u32; 3]],
    degree: usize,
    watch: &Watch,
) -> Result<Result<Links, NotSimple>, Cancelled> {
    let mut is_open = memory::filled(false, places.len());
    let mut elements: Vec<(KnotSet, [u32; 3])> =
        triangles.iter().map(|&triangle| ([NONE; 3], triangle)).collect_vec();
    let (mut closed, mut lost) = (Vec::new(), Vec::new());
    for level in 1..=degree {
        let entries = opposite_edges(&elements);
        let before = std::mem::take(&mut elements);
        for (number, group) in entries.chunk_by(|a, b| a.0 == b.0).enumerate() {
            watch.check_at(number)?;
            let set = group[0].0;
            let knots = &set[..level];
            if knots.iter().any(|&knot| is_open[knot as usize]) {
                continue;
            }
            let edges = without_opposites(group);
            let Some(cycles) = cycles(&edges) else {
                if level > 1 {
                    return Ok(Err(NotSimple { knot: set[0] }));
                }
                is_open[set[0] as usize] = true;
                continue;
            };
            if level == degree {
                if !edges.is_empty() {
                    memory::push(&mut closed, Link { knots: memory::copied(knots), edges });
                }
                continue;
            }
            for cycle in cycles {
                let corners: Vec<DVec2> = cycle.iter().map(|&knot| places[knot as usize]).collect_vec();
                let Some(inner) = triangulate(&corners) else {
                    return Ok(Err(NotSimple { knot: set[0] }));
                };
                let inner = inner.iter().map(|triangle| (set, triangle.map(|corner| cycle[corner])));
                memory::extend(&mut elements, inner);
            }
        }
        let is_lost = |triangle: &[u32; 3]| triangle.iter().any(|&corner| is_open[corner as usize]);
        let knots = |set: KnotSet| set.into_iter().take(level - 1);
        memory::extend(
            &mut lost,
            before
                .into_iter()
                .filter(|(_, triangle)| is_lost(triangle))
                .map(|(set, triangle)| knots(set).chain(triangle).collect_vec()),
        );
    }
    Ok(Ok(Links { closed, lost }))
}

/// For each set X and corner x of its triangles: the set X + x and the edge opposite to x, in order.
fn opposite_edges(elements: &[(KnotSet, [u32; 3])]) -> Vec<(KnotSet, [u32; 2])> {
    let mut entries = memory::with_capacity(3 * elements.len());
    for &(set, triangle) in elements {
        for corner in 0..3 {
            let mut joined = set;
            joined[2] = triangle[corner]; // the set has at most two
            joined.sort_unstable();
            memory::push(&mut entries, (joined, [triangle[(corner + 1) % 3], triangle[(corner + 2) % 3]]));
        }
    }
    entries.sort_unstable();
    entries
}

/// The edges of one set, in order, of which none is there the other way round too.
fn without_opposites(group: &[(KnotSet, [u32; 2])]) -> Vec<[u32; 2]> {
    let has = |edge: [u32; 2]| group.binary_search_by_key(&edge, |&(_, other)| other).is_ok();
    group.iter().map(|&(_, edge)| edge).filter(|&[a, b]| !has([b, a])).collect_vec()
}

/// Edges, in order, as closed lines of knots; None where one ends or meets another.
fn cycles(edges: &[[u32; 2]]) -> Option<Vec<Vec<u32>>> {
    let from = |knot: u32| {
        let place = edges.partition_point(|edge| edge[0] < knot);
        edges.get(place).is_some_and(|edge| edge[0] == knot).then_some(place)
    };
    let mut seen = memory::filled(false, edges.len());
    let mut cycles = Vec::new();
    for start in 0..edges.len() {
        if seen[start] {
            continue;
        }
        let mut cycle = Vec::new();
        let mut at = start;
        while !std::mem::replace(&mut seen[at], true) {
            memory::push(&mut cycle, edges[at][0]);
            at = from(edges[at][1])?;
        }
        if at != start {
            return None;
        }
        memory::push(&mut cycles, cycle);
    }
    Some(cycles)
}
