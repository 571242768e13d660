//! Feature edges as they hang together.

use super::super::decimate::half_edges;
use super::super::{HalfEdge, Mesh};
use super::Chain;
use crate::memory::{self, CollectVec};
use std::collections::BTreeSet;

/// Cosine of the largest turn of a chain that is made longer: 45 degrees.
const LEAST_STRAIGHTNESS: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// The net of feature edges.
pub(super) struct Net<'a> {
    mesh: &'a Mesh,
    /// By node: the other ends of its feature edges, in increasing order.
    ends: Vec<BTreeSet<u32>>,
    /// By half-edge: stays whatever happens.
    kept: Vec<bool>,
}

impl<'a> Net<'a> {
    pub(super) fn new(mesh: &'a Mesh, is_sharp: impl Fn(HalfEdge) -> bool, kept: Vec<bool>) -> Self {
        let mut net = Self { mesh, ends: memory::filled(BTreeSet::new(), mesh.points().len()), kept };
        for edge in half_edges(mesh) {
            if net.kept[edge.index()] || is_sharp(edge) {
                net.insert(edge.origin(mesh.triangles()), edge.target(mesh.triangles()));
            }
        }
        net
    }

    fn insert(&mut self, a: u32, b: u32) {
        self.ends[a as usize].insert(b);
        self.ends[b as usize].insert(a);
    }

    fn remove(&mut self, a: u32, b: u32) {
        self.ends[a as usize].remove(&b);
        self.ends[b as usize].remove(&a);
    }

    /// The other end of the only feature edge of a node.
    fn only(&self, node: u32) -> Option<u32> {
        let ends = &self.ends[node as usize];
        if ends.len() == 1 { ends.first().copied() } else { None }
    }

    fn loose_ends(&self) -> Vec<u32> {
        (0..self.ends.len() as u32).filter(|&node| self.only(node).is_some()).collect_vec()
    }

    fn is_kept(&self, a: u32, b: u32) -> bool {
        self.mesh.edge_between(a, b).is_some_and(|edge| self.kept[edge.index()])
    }

    fn length(&self, a: u32, b: u32) -> f64 {
        self.mesh.points()[a as usize].distance(self.mesh.points()[b as usize])
    }

    /// The cosine of the turn from a to b to c.
    fn straightness(&self, [a, b, c]: [u32; 3]) -> f64 {
        let [a, b, c] = [a, b, c].map(|node| self.mesh.points()[node as usize]);
        (b - a).normalize_or_zero().dot((c - b).normalize_or_zero())
    }

    /// Lets chains that end go on along edges that turn by more than an angle; returns how many edges were added.
    pub(super) fn prolong(&mut self, turns: &[f64], least_turn: f64) -> usize {
        let mut added = 0;
        loop {
            let before = added;
            for node in self.loose_ends() {
                // an end may have been met by another chain meanwhile
                let Some(from) = self.only(node) else { continue };
                let next = self.mesh.outgoing(node).filter_map(|edge| {
                    let to = edge.target(self.mesh.triangles());
                    let (turn, straightness) = (turns[edge.index()], self.straightness([from, node, to]));
                    (turn > least_turn && straightness > LEAST_STRAIGHTNESS)
                        .then_some((turn * straightness, to))
                });
                if let Some((_, to)) = next.max_by(|a, b| a.0.total_cmp(&b.0)) {
                    self.insert(node, to);
                    added += 1;
                }
            }
            if added == before {
                return added;
            }
        }
    }

    /// Drops bits that end in nothing and are shorter than a length; returns how many edges went.
    pub(super) fn drop_bits(&mut self, least_length: f64) -> usize {
        let mut dropped = 0;
        loop {
            let before = dropped;
            for node in self.loose_ends() {
                let Some(bit) = self.bit(node) else { continue };
                let length: f64 = bit.windows(2).map(|pair| self.length(pair[0], pair[1])).sum();
                let is_loose = !bit.windows(2).any(|pair| self.is_kept(pair[0], pair[1]));
                if length < least_length && is_loose {
                    bit.windows(2).for_each(|pair| self.remove(pair[0], pair[1]));
                    dropped += bit.len() - 1;
                }
            }
            if dropped == before {
                return dropped;
            }
        }
    }

    /// The nodes from a loose end to the next that has not two edges.
    fn bit(&self, end: u32) -> Option<Vec<u32>> {
        let mut nodes = vec![end, self.only(end)?];
        while let [.., before, node] = nodes[..]
            && let Some(next) = self.after(before, node)
        {
            memory::push(&mut nodes, next);
        }
        Some(nodes)
    }

    /// Where a chain goes on from `before` over `node`, if exactly two edges meet there.
    fn after(&self, before: u32, node: u32) -> Option<u32> {
        let ends = &self.ends[node as usize];
        if ends.len() == 2 { ends.iter().copied().find(|&end| end != before) } else { None }
    }

    /// Drops triangles of edges that touch no other edge: slivers, whose normals say nothing; returns how many edges went.
    pub(super) fn drop_slivers(&mut self) -> usize {
        let mut dropped = 0;
        for a in 0..self.ends.len() as u32 {
            let ends: Vec<u32> = self.ends[a as usize].iter().copied().collect_vec();
            let [b, c] = ends[..] else { continue };
            let is_alone = self.after(a, b) == Some(c) && self.after(a, c) == Some(b);
            let sides = [(a, b), (b, c), (c, a)];
            if is_alone && !sides.iter().any(|&(from, to)| self.is_kept(from, to)) {
                sides.iter().for_each(|&(from, to)| self.remove(from, to));
                dropped += sides.len();
            }
        }
        dropped
    }

    /// Nodes with another number of feature edges than two, or with a turn, seen over so many edges on both sides, and
    /// pinched ones.
    pub(super) fn corners(&self, most_turn: f64, reach: usize) -> Vec<u32> {
        let turns: Vec<Option<f64>> =
            (0..self.ends.len() as u32).map(|node| self.turn(node, reach)).collect_vec();
        // a chain through a pinched node would leave its fan of triangles, and its regions
        let pinched = self.mesh.pinched_nodes();
        let is_corner = |node: u32| match turns[node as usize] {
            _ if pinched.binary_search(&node).is_ok() => !self.ends[node as usize].is_empty(),
            None => !self.ends[node as usize].is_empty(),
            // seen from afar, all nodes about a corner turn: it is the one that turns most
            Some(turn) => {
                turn > most_turn
                    && self.about(node, reach - 1).all(|other| {
                        turns[other as usize].is_none_or(|other_turn| (turn, node) >= (other_turn, other))
                    })
            }
        };
        (0..self.ends.len() as u32).filter(|&node| is_corner(node)).collect_vec()
    }

    /// The angle by which a chain turns at a node, over so many edges on both sides; None where it is no chain.
    fn turn(&self, node: u32, reach: usize) -> Option<f64> {
        let ends: Vec<u32> = self.ends[node as usize].iter().copied().collect_vec();
        let [before, after] = ends[..] else { return None };
        let [before, after] = [before, after].map(|end| self.along(node, end).take(reach).last());
        Some(self.straightness([before?, node, after?]).clamp(-1.0, 1.0).acos())
    }

    /// The nodes of a chain that follow a node on one side, as far as it is a chain.
    fn along(&self, node: u32, next: u32) -> impl Iterator<Item = u32> + '_ {
        let step = move |&[before, at]: &[u32; 2]| {
            self.after(before, at).filter(|&next| next != node).map(|next| [at, next])
        };
        std::iter::successors(Some([node, next]), step).map(|[_, at]| at)
    }

    /// The nodes of a chain up to so many edges from a node.
    fn about(&self, node: u32, reach: usize) -> impl Iterator<Item = u32> + '_ {
        self.ends[node as usize].iter().flat_map(move |&end| self.along(node, end).take(reach))
    }

    /// All edges, the smaller node first.
    pub(super) fn edges(&self) -> Vec<[u32; 2]> {
        let of_node = |(node, ends): (u32, &'_ BTreeSet<u32>)| -> Vec<[u32; 2]> {
            ends.range(node..).map(|&end| [node, end]).collect_vec()
        };
        (0..).zip(&self.ends).flat_map(of_node).collect_vec()
    }

    /// The edges between corners, and closed chains without one.
    pub(super) fn chains(&self, corners: &[u32]) -> Vec<Chain> {
        let mut seen: BTreeSet<[u32; 2]> = BTreeSet::new();
        let mut chains = Vec::new();
        let is_corner = |node: u32| corners.binary_search(&node).is_ok();
        let inner = (0..self.ends.len() as u32).filter(|&node| !is_corner(node));
        for start in corners.iter().copied().chain(inner) {
            for &second in &self.ends[start as usize] {
                if seen.contains(&[start.min(second), start.max(second)]) {
                    continue;
                }
                let mut nodes = vec![start, second];
                while let [.., before, node] = nodes[..]
                    && node != start
                    && !is_corner(node)
                    && let Some(next) = self.after(before, node)
                {
                    memory::push(&mut nodes, next);
                }
                seen.extend(nodes.windows(2).map(|pair| [pair[0].min(pair[1]), pair[0].max(pair[1])]));
                let is_closed = nodes.len() > 2 && nodes.last() == Some(&start) && !is_corner(start);
                if is_closed {
                    nodes.pop();
                }
                memory::push(&mut chains, Chain { nodes, is_closed });
            }
        }
        chains
    }
}
