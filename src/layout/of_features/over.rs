//! Quads over a piece of many corners, loops or handles: its base complex, whose border is given.

use super::FeatureLayoutError;
use super::border::Loop;
use super::fill::Quads;
use super::pieces::Sheet;
use crate::Control;
use crate::layout::Side;
use crate::layout::complex::{self, Over};
use crate::layout::of_mesh::{MeshLayoutOptions, layout_of_mesh};
use std::collections::BTreeMap;

/// Whether every other stop of a border lies in the middle between its neighbours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Halving {
    /// It does not.
    No,
    /// It does, and all cells are halved with their edges: this always succeeds.
    Yes,
}

/// Halved cells are taken up to so many times the quads that are wanted: around ragged borders there are hundreds, which
/// neither hold nodes enough nor can be relaxed in seconds.
const MOST_HALVED: usize = 4;

/// Complexes are made over borders of up to so many edges for each quad that is wanted: they have at least half as many
/// quads, and what scans have in edges that seem sharp has a thousand.
const MOST_SIDES: usize = 16;

/// About so many quads over a piece; none if a stop lies between nodes, or there is no such complex that has not many times as
/// many.
pub(super) fn over(
    sheet: &Sheet,
    loops: &[Loop],
    wanted: usize,
    halving: Halving,
    control: &mut Control,
) -> Result<Option<Quads>, FeatureLayoutError> {
    let sides: usize = loops.iter().map(|border| border.stops.len()).sum();
    if sides > MOST_SIDES * wanted {
        return Ok(None);
    }
    let (mut needs, mut stop_of, mut next) = (BTreeMap::new(), BTreeMap::new(), Vec::new());
    for border in loops {
        let first = next.len() as u32;
        let count = border.stops.len() as u32;
        for (rank, stop) in (0..).zip(&border.stops) {
            next.push(first + (rank + 1) % count);
            if halving == Halving::Yes && stop.stop.is_middle() {
                continue;
            }
            let Some(node) = stop.node else { return Ok(None) };
            needs.insert(node, stop.corner.need);
            stop_of.insert(node, first + rank);
        }
    }
    let made = match halving {
        Halving::No => complex::make_over(&sheet.mesh, &needs, wanted.max(sides / 2 + 1), control)?,
        Halving::Yes => {
            // halving makes four of each
            let whole = (wanted / 2).max(sides / 4 + 1);
            complex::make_halved(&sheet.mesh, &needs, [whole, MOST_HALVED * wanted], control)?
        }
    };
    Ok(made.and_then(|made| numbered(made, &stop_of, &next)))
}

/// Stops first, then the vertices inside; edges along loops with the numbers of the stops that they leave. None if the
/// border has other edges.
fn numbered(made: Over, stop_of: &BTreeMap<u32, u32>, next: &[u32]) -> Option<Quads> {
    let mut uses: BTreeMap<u32, u32> = BTreeMap::new();
    made.edges.iter().flatten().for_each(|&edge| *uses.entry(edge).or_default() += 1);
    let stop = |vertex: u32| made.nodes.get(vertex as usize)?.and_then(|node| stop_of.get(&node)).copied();
    let mut numbers: BTreeMap<u32, u32> = BTreeMap::new();
    let sides = || {
        made.corners
            .iter()
            .zip(&made.edges)
            .flat_map(|(quad, edges)| (0..4).map(|k| (quad[k], quad[(k + 1) % 4], edges[k])))
    };
    for (from, to, edge) in sides().filter(|(.., edge)| uses[edge] == 1) {
        let Some(from_stop) = stop(from) else { continue };
        numbers.insert(from, from_stop);
        numbers.insert(to, next[from_stop as usize]);
        debug_assert!(uses[&edge] == 1 && stop(to).is_none_or(|stop| stop == next[from_stop as usize]));
    }
    let stops = next.len() as u32;
    let mut inner_count = 0;
    let mut vertex = |old: u32| {
        *numbers.entry(old).or_insert_with(|| {
            inner_count += 1;
            stops + inner_count - 1
        })
    };
    let corners: Vec<[u32; 4]> = made.corners.iter().map(|quad| quad.map(&mut vertex)).collect();
    let (mut inner, mut border_count, mut edges) = (BTreeMap::new(), 0, Vec::new());
    for (quad, numbers) in corners.iter().zip(&made.edges) {
        edges.push([0, 1, 2, 3].map(|k| {
            let (from, to) = (quad[k], quad[(k + 1) % 4]);
            if uses[&numbers[k]] == 1 && next.get(from as usize) == Some(&to) {
                border_count += 1;
                return from;
            }
            let next = stops + inner.len() as u32;
            *inner.entry(numbers[k]).or_insert(next)
        }));
    }
    let is_whole =
        border_count == next.len() && uses.values().filter(|&&uses| uses == 1).count() == next.len();
    is_whole.then_some(Quads {
        corners,
        edges,
        places: made.places,
        fine: Some(made.fine),
        splits: made.splits,
        doublets: made.doublets,
    })
}

/// Quads over a piece without a border.
pub(super) fn closed(sheet: &Sheet, control: &mut Control) -> Result<Quads, FeatureLayoutError> {
    let made = layout_of_mesh(&sheet.mesh, &MeshLayoutOptions::default(), control)?;
    let edge = |quad: u32, side: u8| made.layout.edge_of(Side { quad, side }).edge;
    let count = made.layout.quads().len() as u32;
    Ok(Quads {
        corners: made.layout.quads().to_vec(),
        edges: (0..count).map(|quad| [0, 1, 2, 3].map(|side| edge(quad, side))).collect(),
        places: made.map.places().to_vec(),
        fine: None,
        splits: made.report.splits,
        doublets: made.report.doublets,
    })
}
