//! Into how many layout edges each chain falls, and where.
//!
//! All regions beside a chain see the same division, and every border of quads has an even number of edges. One more edge
//! on a chain flips both its sides: odd regions are joined in pairs, or with what has no patches, by shortest ways over
//! the regions (a T-join, J. Edmonds, E. Johnson 1973). Then counts change, two or three chains at a time so that the
//! parity holds, as long as the cost of all fillings (`polygon`) falls.

use super::pieces::{Line, Piece, Sheet};
use super::places::{Division, Stop, place};
use super::polygon::{Corner, Polygon};
use crate::Control;
use crate::control::Cancelled;
use crate::layout::complex::border::inner_angle;
use crate::mesh::Mesh;
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet, BinaryHeap, HashMap};
use std::f64::consts::FRAC_PI_2;

/// Edges of a closed chain at the start.
const CLOSED_EDGES: u32 = 4;

/// Fewest: arcs of a quarter turn, which cubics follow closely.
const LEAST_CLOSED: u32 = 4;

/// Fewest of a loop: two quads of a ring must not have both ends of an edge in common.
const LEAST_LOOP: u32 = 3;

/// No edge of a loop is longer than so many of its mean edges.
const LONGEST_EDGE: f64 = 2.0;

/// A chain that turns by more than this gets one more edge: 120 degrees.
const TURN_PER_EDGE: f64 = 2.1;

/// Chains get no more edges than at the start and these.
const MOST_MORE: u32 = 4;

/// Borders up to this length are filled to learn their cost.
const MOST_FILLED: u32 = 10;

/// Quads that are tried for that.
const STEPS: usize = 20_000;

/// A border that cannot be filled costs as much as many that can.
const UNFILLED: f64 = 1e3;

/// Of rings: the share of an edge of their borders, and of a difference between both loops.
const EDGE_COST: f64 = 0.05;

const UNEQUAL_COST: f64 = 0.4;

/// Of other regions: the share of an edge, more than that of any filling, so that none is made long for its own sake.
const LONG_EDGE_COST: f64 = 0.15;

/// What an edge costs that is shorter than half the mean of its loop, for each further time that it is: quads at it are
/// wedges, and fold.
const SHORT_COST: f64 = 0.1;

/// Times that an edge is shorter than the mean of its loop before it costs.
const SHORT: f64 = 2.0;

/// Rounds over all changes.
const ROUNDS: usize = 12;

/// Quarter turns of a vertex inside a chain, and the quads it needs.
pub(super) const STRAIGHT: Corner = Corner { angle: 2.0, need: 2 };

/// Up to these angles, in quarter turns, one and two patches meet in a corner.
const MOST_ANGLES: [f64; 2] = [150.0 / 90.0, 300.0 / 90.0];

/// Quads around the end of a chain inside a region.
const DART_NEED: u32 = 3;

/// A run of a border.
#[derive(Debug, Clone, Copy)]
pub(super) struct Side {
    pub chain: u32,
    is_forward: bool,
    /// The corner at which it begins; none on a closed chain.
    pub corner: Option<Corner>,
}

/// The runs of a loop.
pub(super) fn outline(sheet: &Sheet, index: usize, lines: &[Line]) -> Vec<Side> {
    let runs = &sheet.loops[index];
    let corner = |k: usize| {
        let (before, run) = (&runs[(k + runs.len() - 1) % runs.len()], &runs[k]);
        if lines[run.chain as usize].is_closed {
            return None;
        }
        let angle = inner_angle(&sheet.mesh, run.nodes[0]) / FRAC_PI_2;
        let is_dart = before.chain == run.chain && before.is_forward != run.is_forward;
        let need = if is_dart {
            DART_NEED
        } else {
            1 + MOST_ANGLES.iter().filter(|&&most| angle > most).count() as u32
        };
        Some(Corner { angle, need })
    };
    let side = |k: usize| Side { chain: runs[k].chain, is_forward: runs[k].is_forward, corner: corner(k) };
    (0..runs.len()).map(side).collect()
}

/// Divides all chains beside the pieces.
pub(super) fn divide(
    mesh: &Mesh,
    pieces: &[Piece],
    lines: &[Line],
    control: &mut Control,
) -> Result<Division, Cancelled> {
    let mut counts = Counts::new(mesh, pieces, lines);
    counts.make_even();
    counts.improve(control)?;
    Ok(place(pieces, lines, &counts.of_chains))
}

struct Counts<'a> {
    lines: &'a [Line],
    /// By piece and loop.
    outlines: Vec<Vec<Vec<Side>>>,
    /// By chain: the pieces beside it an odd number of times.
    odd_beside: Vec<Vec<u32>>,
    /// By chain: all pieces beside it.
    beside: Vec<Vec<u32>>,
    least: Vec<u32>,
    /// By chain, 0 beside no piece.
    of_chains: Vec<u32>,
    /// Costs of pieces, by the counts of their chains.
    known: HashMap<(u32, Vec<u32>), f64>,
}

impl<'a> Counts<'a> {
    fn new(mesh: &Mesh, pieces: &[Piece], lines: &'a [Line]) -> Self {
        let outlines: Vec<Vec<Vec<Side>>> = pieces
            .iter()
            .map(|Piece { sheet, .. }| {
                (0..sheet.loops.len()).map(|index| outline(sheet, index, lines)).collect()
            })
            .collect();
        let mut beside: Vec<Vec<u32>> = vec![Vec::new(); lines.len()];
        for (number, loops) in (0..).zip(&outlines) {
            loops.iter().flatten().for_each(|side| beside[side.chain as usize].push(number));
        }
        let is_odd = |of_chain: &Vec<u32>| match of_chain[..] {
            [a, b] if a == b => Vec::new(),
            _ => of_chain.clone(),
        };
        let mut least: Vec<u32> = lines.iter().map(|line| least_count(mesh, line)).collect();
        for sides in outlines.iter().flatten() {
            balance(sides, &mut least, lines);
            lengthen(sides, &mut least, lines);
        }
        let start = |(line, least): (&Line, &u32)| if line.is_closed { CLOSED_EDGES } else { *least };
        let mut of_chains: Vec<u32> = lines.iter().zip(&least).map(start).collect();
        for (count, beside) in of_chains.iter_mut().zip(&beside) {
            if beside.is_empty() {
                *count = 0;
            }
        }
        let odd_beside = beside.iter().map(is_odd).collect();
        Self { lines, outlines, odd_beside, beside, least, of_chains, known: HashMap::new() }
    }

    fn edge_count(&self, piece: usize) -> u32 {
        self.outlines[piece].iter().flatten().map(|side| self.of_chains[side.chain as usize]).sum()
    }

    /// Gives every piece an even border.
    fn make_even(&mut self) {
        let outside = self.outlines.len();
        // ways from piece to piece, or outside; a long chain is divided rather than a short one
        let mut ways: Vec<Vec<(usize, u32)>> = vec![Vec::new(); outside + 1];
        for (chain, beside) in (0..).zip(&self.odd_beside) {
            let ends = match beside[..] {
                [a] => [a as usize, outside],
                [a, b] => [a as usize, b as usize],
                _ => continue,
            };
            ways[ends[0]].push((ends[1], chain));
            ways[ends[1]].push((ends[0], chain));
        }
        while let Some(odd) = (0..outside).find(|&piece| self.edge_count(piece) % 2 == 1) {
            let is_end = |piece: usize| piece == outside || self.edge_count(piece) % 2 == 1;
            let Some(way) = self.shortest_way(&ways, odd, is_end) else { break };
            way.into_iter().for_each(|chain| self.of_chains[chain as usize] += 1);
        }
    }

    /// The chains of the shortest way from a piece to another that may end it.
    fn shortest_way(
        &self,
        ways: &[Vec<(usize, u32)>],
        from: usize,
        is_end: impl Fn(usize) -> bool,
    ) -> Option<Vec<u32>> {
        let mut reached: Vec<(f64, Option<(usize, u32)>)> = vec![(f64::INFINITY, None); ways.len()];
        reached[from].0 = 0.0;
        // lengths are positive, and sort as their bits do
        let mut heap = BinaryHeap::from([Reverse((0_u64, from))]);
        while let Some(Reverse((bits, at))) = heap.pop() {
            let length = f64::from_bits(bits);
            if length > reached[at].0 {
                continue;
            }
            if at != from && is_end(at) {
                let mut way = Vec::new();
                let mut at = at;
                while let Some((before, chain)) = reached[at].1 {
                    way.push(chain);
                    at = before;
                }
                return Some(way);
            }
            for &(next, chain) in &ways[at] {
                let line = &self.lines[chain as usize];
                let edges = f64::from(self.of_chains[chain as usize]);
                let further = length + edges / line.length().max(f64::MIN_POSITIVE);
                if further < reached[next].0 {
                    reached[next] = (further, Some((at, chain)));
                    heap.push(Reverse((further.to_bits(), next)));
                }
            }
        }
        None
    }

    /// Changes counts as long as costs fall.
    fn improve(&mut self, control: &mut Control) -> Result<(), Cancelled> {
        let changes = self.changes();
        for _ in 0..ROUNDS {
            let mut has_changed = false;
            for chains in &changes {
                control.report(0.1, f64::NAN)?;
                has_changed |= self.try_changes(chains);
            }
            if !has_changed {
                break;
            }
        }
        Ok(())
    }

    /// Sets of chains that leave every piece even if each gets one edge more or less.
    fn changes(&self) -> Vec<Vec<u32>> {
        let mut by_sides: BTreeMap<&[u32], Vec<u32>> = BTreeMap::new();
        for (chain, sides) in (0..).zip(&self.odd_beside) {
            if self.of_chains[chain as usize] > 0 {
                by_sides.entry(sides).or_default().push(chain);
            }
        }
        let mut changes = Vec::new();
        for (&sides, chains) in &by_sides {
            for (k, &chain) in chains.iter().enumerate() {
                // twice the same: two edges more or less
                changes.push(if sides.is_empty() { vec![chain] } else { vec![chain, chain] });
                if !sides.is_empty() {
                    changes.extend(chains[..k].iter().map(|&other| vec![other, chain]));
                }
            }
        }
        let keys: Vec<&[u32]> = by_sides.keys().copied().filter(|sides| !sides.is_empty()).collect();
        for (k, first) in keys.iter().enumerate() {
            for second in &keys[..k] {
                let [a, b] = [first, second].map(|sides| sides.iter().copied().collect::<BTreeSet<u32>>());
                let third: Vec<u32> = a.symmetric_difference(&b).copied().collect();
                if third.as_slice() < *second
                    && let Some(third) = by_sides.get(&third[..])
                {
                    for &p in &by_sides[*first] {
                        for &q in &by_sides[*second] {
                            changes.extend(third.iter().map(|&r| vec![p, q, r]));
                        }
                    }
                }
            }
        }
        changes
    }

    /// Gives each of some chains one edge more or less, in the best of all ways, if that lowers the cost.
    fn try_changes(&mut self, chains: &[u32]) -> bool {
        let mut pieces: Vec<u32> =
            chains.iter().flat_map(|&chain| &self.beside[chain as usize]).copied().collect();
        pieces.sort_unstable();
        pieces.dedup();
        let before: Vec<u32> = chains.iter().map(|&chain| self.of_chains[chain as usize]).collect();
        let mut least: f64 = pieces.iter().map(|&piece| self.cost(piece)).sum();
        let mut best = None;
        for signs in 0..1_u32 << chains.len() {
            let steps: Vec<i64> =
                (0..chains.len()).map(|k| if signs >> k & 1 == 0 { 1 } else { -1 }).collect();
            if !self.step(chains, &steps) {
                continue;
            }
            let cost: f64 = pieces.iter().map(|&piece| self.cost(piece)).sum();
            if cost < least - 1e-9 {
                (least, best) = (cost, Some(steps));
            }
            chains.iter().zip(&before).for_each(|(&chain, &count)| self.of_chains[chain as usize] = count);
        }
        best.is_some_and(|steps| self.step(chains, &steps))
    }

    /// Adds to the counts of chains, or leaves them all where one would leave its range.
    fn step(&mut self, chains: &[u32], steps: &[i64]) -> bool {
        let mut counts = self.of_chains.clone();
        for (&chain, step) in chains.iter().zip(steps) {
            counts[chain as usize] = (i64::from(counts[chain as usize]) + step).max(0) as u32;
        }
        let is_in_range = |&chain: &u32| {
            let least = self.least[chain as usize];
            (least..=least + MOST_MORE).contains(&counts[chain as usize])
        };
        let fits = chains.iter().all(is_in_range) && counts != self.of_chains;
        if fits {
            self.of_chains = counts;
        }
        fits
    }

    /// What a piece costs with the counts as they are.
    fn cost(&mut self, piece: u32) -> f64 {
        let loops = &self.outlines[piece as usize];
        let counts: Vec<u32> =
            loops.iter().flatten().map(|side| self.of_chains[side.chain as usize]).collect();
        let key = (piece, counts);
        if let Some(&cost) = self.known.get(&key) {
            return cost;
        }
        let total: u32 = key.1.iter().sum();
        let of_loops: Vec<u32> = loops
            .iter()
            .map(|runs| runs.iter().map(|side| self.of_chains[side.chain as usize]).sum())
            .collect();
        let shortness: f64 = loops.iter().map(|runs| self.shortness(runs)).sum();
        let cost = if total % 2 == 1 || of_loops.iter().any(|&edges| edges < LEAST_LOOP) {
            UNFILLED
        } else if let ([runs], true) = (&loops[..], total <= MOST_FILLED) {
            let polygon = polygon(runs, &self.of_chains, self.lines);
            polygon.filled(STEPS).map_or(UNFILLED, |filling| filling.cost)
        } else if let [first, second] = &loops[..] {
            // both sides of a chain that ends inside have their own quads
            let around = |runs: &[Side]| -> u32 {
                let is_bound = |side: &&Side| !self.odd_beside[side.chain as usize].is_empty();
                runs.iter().filter(is_bound).map(|side| self.of_chains[side.chain as usize]).sum()
            };
            let difference = around(first).abs_diff(around(second));
            EDGE_COST * f64::from(total) + UNEQUAL_COST * f64::from(difference)
        } else {
            LONG_EDGE_COST * f64::from(total)
        };
        self.known.insert(key, cost + shortness);
        cost + shortness
    }

    /// What the short edges of a loop cost.
    fn shortness(&self, runs: &[Side]) -> f64 {
        let length = |side: &Side| self.lines[side.chain as usize].length();
        let edges: u32 = runs.iter().map(|side| self.least[side.chain as usize]).sum();
        let mean = runs.iter().map(length).sum::<f64>() / f64::from(edges.max(1));
        let cost = |side: &Side| {
            let count = f64::from(self.of_chains[side.chain as usize]);
            (mean * count / length(side).max(f64::MIN_POSITIVE) - SHORT).max(0.0)
        };
        SHORT_COST * runs.iter().map(cost).sum::<f64>()
    }
}

/// The border of a piece of one loop as a polygon.
fn polygon(sides: &[Side], counts: &[u32], lines: &[Line]) -> Polygon {
    let mut numbers: BTreeMap<Stop, u32> = BTreeMap::new();
    let (mut vertices, mut corners) = (Vec::new(), Vec::new());
    for &Side { chain, is_forward, corner } in sides {
        let (count, nodes) = (counts[chain as usize], &lines[chain as usize].nodes);
        for rank in 0..count {
            let stop = match corner {
                Some(_) if rank == 0 => Stop::Corner(nodes[if is_forward { 0 } else { nodes.len() - 1 }]),
                _ => Stop::OnChain { chain, rank: if is_forward { rank } else { count - rank } },
            };
            let next = numbers.len() as u32;
            vertices.push(*numbers.entry(stop).or_insert(next));
            corners.push(corner.filter(|_| rank == 0).unwrap_or(STRAIGHT));
        }
    }
    Polygon { groups: (0..vertices.len() as u32).collect(), vertices, corners }
}

/// Raises the fewest edges of chains that are much longer than the others of a loop: quads beside a long edge end in short
/// ones.
fn balance(sides: &[Side], least: &mut [u32], lines: &[Line]) {
    let count: u32 = sides.iter().map(|side| least[side.chain as usize]).sum();
    let length: f64 = sides.iter().map(|side| lines[side.chain as usize].length()).sum();
    let longest = LONGEST_EDGE * length / f64::from(count.max(1));
    for chain in sides.iter().map(|side| side.chain as usize) {
        least[chain] = least[chain].max((lines[chain].length() / longest).ceil() as u32);
    }
}

/// Raises the fewest edges of the longest chain of a loop until the loop has enough: one around a chain with two loose ends
/// would have two.
fn lengthen(sides: &[Side], least: &mut [u32], lines: &[Line]) {
    let longest = sides.iter().map(|side| side.chain).max_by(|&a, &b| {
        let [a, b] = [a, b].map(|chain| lines[chain as usize].length());
        a.total_cmp(&b)
    });
    let Some(longest) = longest else { return };
    while sides.iter().map(|side| least[side.chain as usize]).sum::<u32>() < LEAST_LOOP {
        least[longest as usize] += 1;
    }
}

/// Fewest edges of a chain.
fn least_count(mesh: &Mesh, line: &Line) -> u32 {
    if line.is_closed {
        return LEAST_CLOSED;
    }
    let points: Vec<_> = line.nodes.iter().map(|&node| mesh.points()[node as usize]).collect();
    let turn: f64 = points
        .windows(3)
        .map(|p| {
            let [a, b] = [p[1] - p[0], p[2] - p[1]];
            a.cross(b).length().atan2(a.dot(b))
        })
        .sum();
    let is_loop = line.nodes[0] == line.nodes[line.nodes.len() - 1];
    (1 + (turn / TURN_PER_EDGE) as u32).max(if is_loop { LEAST_LOOP } else { 1 })
}
