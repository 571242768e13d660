//! Where the edges of a layout begin and end along the chains.
//!
//! Edges of a chain are equally long, up to the node nearest to each end. A closed chain may begin anywhere: where its
//! vertices lie nearest to those of other loops around the same regions.

use super::pieces::{Line, Piece, Run, Sheet};
use crate::mesh::Mesh;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// A vertex moves to a node if that is no further than this part of an edge.
const REACH: f64 = 0.25;

/// A vertex of the layout on a chain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) enum Stop {
    /// A corner of the features, by its node.
    Corner(u32),
    /// Inside a chain, by its rank among the chain's vertices.
    OnChain { chain: u32, rank: u32 },
}

impl Stop {
    /// Whether it is the middle of an edge that was halved.
    pub(super) fn is_middle(self) -> bool {
        matches!(self, Self::OnChain { rank, .. } if rank % 2 == 1)
    }
}

/// The vertices of the layout along each chain.
#[derive(Debug, Clone)]
pub(super) struct Division {
    /// By chain: lengths along it in increasing order, with both ends; of a closed chain without the first again. Empty
    /// for a chain beside no patch.
    pub lengths: Vec<Vec<f64>>,
}

impl Division {
    /// Edges of the layout along a chain.
    pub(super) fn edge_count(&self, chain: u32, line: &Line) -> usize {
        let count = self.lengths[chain as usize].len();
        if line.is_closed { count } else { count.saturating_sub(1) }
    }

    /// With a vertex in the middle of every edge.
    pub(super) fn halved(&self, lines: &[Line]) -> Self {
        let halved = |(chain, line): (u32, &Line)| {
            let count = self.edge_count(chain, line);
            let ends = |edge: usize| {
                let [from, to] = self.span(chain, edge, line);
                [from, 0.5 * (from + to)]
            };
            let last = self.lengths[chain as usize].last().filter(|_| !line.is_closed);
            (0..count).flat_map(ends).chain(last.copied()).collect()
        };
        Self { lengths: (0..).zip(lines).map(halved).collect() }
    }

    /// The lengths at which an edge begins and ends; the last of a closed chain ends beyond its length.
    pub(super) fn span(&self, chain: u32, edge: usize, line: &Line) -> [f64; 2] {
        let lengths = &self.lengths[chain as usize];
        let end = lengths.get(edge + 1).copied().unwrap_or_else(|| lengths[0] + line.length());
        [lengths[edge], end]
    }

    /// The vertex of some rank on a chain.
    pub(super) fn stop(&self, chain: u32, rank: usize, line: &Line) -> Stop {
        let count = self.lengths[chain as usize].len();
        match line.is_closed {
            false if rank == 0 => Stop::Corner(line.nodes[0]),
            false if rank + 1 == count => Stop::Corner(line.nodes[line.nodes.len() - 1]),
            _ => Stop::OnChain { chain, rank: (rank % count) as u32 },
        }
    }
}

/// Places the vertices of chains with so many edges.
pub(super) fn place(pieces: &[Piece], lines: &[Line], counts: &[u32]) -> Division {
    let mut division = Division { lengths: vec![Vec::new(); lines.len()] };
    for ((lengths, line), &count) in division.lengths.iter_mut().zip(lines).zip(counts) {
        if count > 0 && !line.is_closed {
            *lengths = even(line, 0.0, count);
        }
    }
    let closed = |pieces: &[Piece]| {
        let runs = pieces.iter().enumerate().flat_map(|(number, piece)| {
            piece.sheet.loops.iter().flatten().map(move |run| (number, run.chain))
        });
        runs.filter(|&(_, chain)| lines[chain as usize].is_closed).collect::<Vec<_>>()
    };
    let mut waiting = closed(pieces);
    waiting.retain(|&(_, chain)| counts[chain as usize] > 0);
    // first those beside something that has its place
    while let Some(&first) = waiting.first() {
        let ready =
            waiting.iter().copied().find(|&(piece, _)| !anchors(&pieces[piece].sheet, &division).is_empty());
        let (piece, chain) = ready.unwrap_or(first);
        let begin = match ready {
            Some(_) => best_begin(&pieces[piece].sheet, chain, lines, counts[chain as usize], &division),
            None => 0.0,
        };
        division.lengths[chain as usize] = even(&lines[chain as usize], begin, counts[chain as usize]);
        waiting.retain(|&(_, other)| other != chain);
    }
    division
}

/// Equally long edges from a length on, each up to a node where one is near.
fn even(line: &Line, begin: f64, count: u32) -> Vec<f64> {
    let all = line.length();
    let edge = all / f64::from(count);
    let nodes = &line.starts[..line.nodes.len()];
    let at = |rank: u32| {
        let ideal = begin + edge * f64::from(rank);
        let ideal = if line.is_closed { ideal.rem_euclid(all) } else { ideal };
        let above = nodes.partition_point(|&start| start < ideal).min(nodes.len() - 1);
        let near = [above.saturating_sub(1), above].map(|k| nodes[k]);
        let nearest = if ideal - near[0] <= near[1] - ideal { near[0] } else { near[1] };
        if (nearest - ideal).abs() <= REACH * edge { nearest } else { ideal }
    };
    let mut lengths: Vec<f64> = if line.is_closed {
        (0..count).map(at).collect()
    } else {
        std::iter::once(0.0).chain((1..count).map(at)).chain([all]).collect()
    };
    lengths.sort_unstable_by(f64::total_cmp);
    lengths
}

/// Nodes of a piece at which a vertex of the layout is known.
fn anchors(sheet: &Sheet, division: &Division) -> Vec<u32> {
    let of_run = |run: &Run| {
        let lengths = &division.lengths[run.chain as usize];
        let is_stop = |length: f64| lengths.contains(&length);
        run.nodes
            .iter()
            .zip(&run.lengths)
            .filter(|&(_, &length)| is_stop(length))
            .map(|(&node, _)| node)
            .collect()
    };
    let mut nodes: Vec<u32> =
        sheet.loops.iter().flatten().flat_map(|run| -> Vec<u32> { of_run(run) }).collect();
    nodes.sort_unstable();
    nodes.dedup();
    nodes
}

/// The length at which a closed chain should begin: its vertices are then nearest to the anchors of a piece.
fn best_begin(sheet: &Sheet, chain: u32, lines: &[Line], count: u32, division: &Division) -> f64 {
    let line = &lines[chain as usize];
    let distances = distances(&sheet.mesh, &anchors(sheet, division));
    let runs = sheet.loops.iter().flatten().filter(|run| run.chain == chain);
    let mut of_nodes: Vec<(f64, f64)> = runs
        .flat_map(|run| run.lengths.iter().zip(&run.nodes))
        .map(|(&length, &node)| (length, distances[node as usize]))
        .collect();
    of_nodes.sort_by(|a, b| a.0.total_cmp(&b.0));
    let distance_at = |length: f64| {
        let k = of_nodes.partition_point(|&(start, _)| start <= length).clamp(1, of_nodes.len()) - 1;
        of_nodes[k].1
    };
    let cost = |begin: f64| -> f64 { even(line, begin, count).into_iter().map(distance_at).sum() };
    let begins = line.starts[..line.nodes.len()].iter().copied();
    begins.min_by(|&a, &b| cost(a).total_cmp(&cost(b))).unwrap_or(0.0)
}

/// Shortest ways along edges from any of some nodes.
fn distances(mesh: &Mesh, from: &[u32]) -> Vec<f64> {
    let mut lengths = vec![f64::INFINITY; mesh.points().len()];
    let mut heap = BinaryHeap::new();
    for &node in from {
        lengths[node as usize] = 0.0;
        heap.push(Reverse((0_u64, node)));
    }
    // lengths are positive, and sort as their bits do
    while let Some(Reverse((bits, node))) = heap.pop() {
        let length = f64::from_bits(bits);
        if length > lengths[node as usize] {
            continue;
        }
        for next in mesh.neighbours(node) {
            let further = length + mesh.points()[node as usize].distance(mesh.points()[next as usize]);
            if further < lengths[next as usize] {
                lengths[next as usize] = further;
                heap.push(Reverse((further.to_bits(), next)));
            }
        }
    }
    lengths
}
