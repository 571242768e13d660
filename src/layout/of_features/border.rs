//! The borders of a piece with the vertices of the layout on them.

use super::division::{STRAIGHT, outline};
use super::pieces::{Line, Run, Sheet};
use super::places::{Division, Stop};
use super::polygon::Corner;

/// A vertex of the layout on a border, as the region on one side sees it.
#[derive(Debug, Clone, Copy)]
pub(super) struct BorderStop {
    pub stop: Stop,
    /// The node there; none for the middle of an edge that is halved.
    pub node: Option<u32>,
    pub corner: Corner,
    /// The length along the loop.
    pub at: f64,
    /// The edge of the layout that leaves it along the loop.
    pub edge: ChainEdge,
}

/// A layout edge on a chain, as a loop runs along it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct ChainEdge {
    pub chain: u32,
    /// Its rank on the chain.
    pub rank: u32,
    pub is_forward: bool,
}

/// A loop of a sheet.
#[derive(Debug, Clone)]
pub(super) struct Loop {
    /// In order along it.
    pub stops: Vec<BorderStop>,
    /// Its nodes with the lengths along it, in order.
    pub nodes: Vec<(u32, f64)>,
    pub length: f64,
}

/// Part of a loop below which two lengths along it are one.
const ROUNDING: f64 = 1e-12;

/// The loops of a piece that has nodes at all ends of edges.
pub(super) fn loops(sheet: &Sheet, lines: &[Line], division: &Division) -> Vec<Loop> {
    (0..sheet.loops.len()).map(|index| border(sheet, index, lines, division)).collect()
}

fn border(sheet: &Sheet, index: usize, lines: &[Line], division: &Division) -> Loop {
    let corners = outline(sheet, index, lines);
    let (mut stops, mut nodes, mut offset) = (Vec::new(), Vec::new(), 0.0);
    for (run, side) in sheet.loops[index].iter().zip(corners) {
        let line = &lines[run.chain as usize];
        let along = |length: f64| offset + if run.is_forward { length } else { line.length() - length };
        let of_run = run.nodes.iter().zip(&run.lengths).map(|(&node, &length)| (node, along(length)));
        nodes.extend(of_run.take(run.nodes.len() - 1));
        let mut of_run = stops_of_run(run, line, division);
        of_run.iter_mut().for_each(|stop| stop.at += offset);
        if let (Some(corner), Some(first)) = (side.corner, of_run.first_mut()) {
            first.corner = corner;
        }
        stops.extend(of_run);
        offset += line.length();
    }
    // lengths of one place, reckoned along a chain and against it, differ by rounding
    for stop in &mut stops {
        let is_there = |at: f64| {
            let off = (at - stop.at).abs();
            off.min(offset - off) <= ROUNDING * offset
        };
        if let Some(&(node, at)) = nodes.iter().find(|&&(_, at)| is_there(at)) {
            (stop.node, stop.at) = (Some(node), at);
        }
    }
    Loop { stops, nodes, length: offset }
}

/// The vertices along a run, without the one at its end.
fn stops_of_run(run: &Run, line: &Line, division: &Division) -> Vec<BorderStop> {
    let Run { chain, is_forward, .. } = *run;
    let lengths = &division.lengths[chain as usize];
    let edges = division.edge_count(chain, line);
    let stop = |rank: usize, at: f64, edge: usize| BorderStop {
        stop: division.stop(chain, rank, line),
        node: None,
        corner: STRAIGHT,
        at,
        edge: ChainEdge { chain, rank: edge as u32, is_forward },
    };
    // a vertex may lie beyond the first node of a closed chain, which begins the loop
    let all = line.length();
    let on_loop = |at: f64| if line.is_closed { at.rem_euclid(all) } else { at };
    let mut stops: Vec<BorderStop> = if is_forward {
        (0..edges).map(|rank| stop(rank, on_loop(lengths[rank]), rank)).collect()
    } else {
        let ranks = if line.is_closed { 0..edges } else { 1..edges + 1 };
        ranks.map(|rank| stop(rank, on_loop(all - lengths[rank]), (rank + edges - 1) % edges)).collect()
    };
    stops.sort_by(|a, b| a.at.total_cmp(&b.at));
    stops
}
