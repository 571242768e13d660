//! Feature edges as they hang together.

use super::super::decimate::half_edges;
use super::super::{HalfEdge, Mesh};
use super::Chain;
use crate::memory::{self, CollectVec};
use std::collections::BTreeSet;

/// Cosine of the largest turn of a chain that is made longer: 45 degrees.
const LEAST_STRAIGHTNESS: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// Borders of fewer nodes may turn at all of them: polygons.
const JAGGED: usize = 24;

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
        let kept = net.kept.clone();
        net.add(|edge| kept[edge.index()] || is_sharp(edge));
        net
    }

    /// Adds edges.
    pub(super) fn add(&mut self, is_feature: impl Fn(HalfEdge) -> bool) {
        for edge in half_edges(self.mesh).filter(|&edge| is_feature(edge)) {
            self.insert(edge.origin(self.mesh.triangles()), edge.target(self.mesh.triangles()));
        }
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

    /// Lets chains that end go on along edges that fade, straight ahead, if they come to another feature; returns how many
    /// edges were added.
    pub(super) fn join(&mut self, turns: &[f64], is_fading: impl Fn(HalfEdge) -> bool) -> usize {
        let mut added = 0;
        for node in self.loose_ends() {
            // an end may have been met by another chain meanwhile
            let Some(from) = self.only(node) else { continue };
            let way = self.way_ahead([from, node], turns, &is_fading);
            added += way.len().saturating_sub(1);
            way.windows(2).for_each(|pair| self.insert(pair[0], pair[1]));
        }
        added
    }

    /// The nodes from the end of a chain straight ahead to another feature; empty if the way leads to none.
    fn way_ahead(
        &self,
        [mut from, end]: [u32; 2],
        turns: &[f64],
        is_fading: impl Fn(HalfEdge) -> bool,
    ) -> Vec<u32> {
        let mut way = vec![end];
        loop {
            let node = way[way.len() - 1];
            let ahead = self.mesh.outgoing(node).filter_map(|edge| {
                let to = edge.target(self.mesh.triangles());
                let straightness = self.straightness([from, node, to]);
                (straightness > LEAST_STRAIGHTNESS).then_some((
                    turns[edge.index()] * straightness.powi(3),
                    edge,
                    to,
                ))
            });
            let Some((_, edge, to)) = ahead.max_by(|a, b| a.0.total_cmp(&b.0)) else { return Vec::new() };
            let (arrives, returns) = (!self.ends[to as usize].is_empty(), way.contains(&to));
            if returns || !(arrives || is_fading(edge)) {
                return Vec::new();
            }
            way.push(to);
            if arrives {
                return way;
            }
            from = node;
        }
    }

    /// Drops chains, from one node to the next that has not two edges, until none is to be dropped any more.
    pub(super) fn drop_chains(&mut self, is_dropped: impl Fn(&Self, &Chain) -> bool) {
        loop {
            let junctions =
                (0..self.ends.len() as u32).filter(|&node| ![0, 2].contains(&self.ends[node as usize].len()));
            let chains = self.chains(&junctions.collect_vec());
            let dropped: Vec<Chain> = chains.into_iter().filter(|chain| is_dropped(self, chain)).collect();
            if dropped.is_empty() {
                return;
            }
            for [a, b] in dropped.iter().flat_map(edges) {
                self.remove(a, b);
            }
        }
    }

    /// Whether no edge of a chain is sharp, or kept whatever happens.
    pub(super) fn is_blunt(&self, chain: &Chain, is_sharp: impl Fn(HalfEdge) -> bool) -> bool {
        let stays = |edge: HalfEdge| self.kept[edge.index()] || is_sharp(edge);
        !edges(chain).any(|[a, b]| self.mesh.edge_between(a, b).is_some_and(stays))
    }

    /// Whether a chain ends in nothing.
    pub(super) fn is_loose(&self, chain: &Chain) -> bool {
        let ends = [chain.nodes.first(), chain.nodes.last()].into_iter().flatten();
        !chain.is_closed && ends.into_iter().any(|&end| self.only(end).is_some())
    }

    /// The length of a chain.
    pub(super) fn length_of(&self, chain: &Chain) -> f64 {
        edges(chain).map(|[a, b]| self.length(a, b)).sum()
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

    /// The nodes of borders that turn at more than one of four: the seams of triangles that were cut through, not of a part.
    pub(super) fn jagged_borders(&self, most_turn: f64) -> BTreeSet<u32> {
        const FEW: usize = 4;
        let turns = |node: &&u32| self.turn(**node, 1).is_some_and(|turn| turn > most_turn);
        let is_jagged = |nodes: &&Vec<u32>| {
            FEW * nodes.iter().filter(turns).count() > nodes.len() && nodes.len() > JAGGED
        };
        self.mesh.loops().iter().filter(is_jagged).flatten().copied().collect()
    }

    /// Nodes with another number of feature edges than two, or with a turn, seen over so many edges on both sides, and
    /// pinched ones.
    pub(super) fn corners(&self, most_turn: f64, reach: impl Fn(u32) -> usize) -> Vec<u32> {
        let turns: Vec<Option<f64>> =
            (0..self.ends.len() as u32).map(|node| self.turn(node, reach(node))).collect_vec();
        // a chain through a pinched node would leave its fan of triangles, and its regions
        let pinched = self.mesh.pinched_nodes();
        let is_corner = |node: u32| match turns[node as usize] {
            _ if pinched.binary_search(&node).is_ok() => !self.ends[node as usize].is_empty(),
            None => !self.ends[node as usize].is_empty(),
            // seen from afar, all nodes about a corner turn: it is the one that turns most
            Some(turn) => {
                turn > most_turn
                    && self.about(node, reach(node) - 1).all(|other| {
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

/// The edges of a chain, two nodes each.
fn edges(chain: &Chain) -> impl Iterator<Item = [u32; 2]> + '_ {
    let after = chain.nodes.iter().cycle().skip(1);
    let count = chain.nodes.len() - usize::from(!chain.is_closed);
    chain.nodes.iter().zip(after).take(count).map(|(&a, &b)| [a, b])
}
