//! The order in which nodes leave, down to a tetrahedron.
//!
//! A node goes on to the neighbour for which
//! ```text
//! (|uv| + r / 4)^2 (1 + 0.1 max(0, n - 6)^2) (1 + 0.05 (d - 6)^2)
//! ```
//! is least: d is its valence, n that of the neighbour afterwards, and r the way of nodes that have gone to it before:
//! without r one node after the other of a regular grid goes on to the next, and draws edges as long as the row behind it.
//! Short edges go first, so levels are even; neither
//! large fans nor removals of large fans come about, which would make rings hard to enter. The link condition keeps a
//! sphere; one that is no tetrahedron has an edge that fulfils it (E. Steinitz, H. Rademacher, "Vorlesungen ueber die
//! Theorie der Polyeder", 1934).

use super::SphereError;
use crate::Control;
use crate::memory;
use crate::mesh::Mesh;
use crate::mesh::rings::{RingMarks, Rings};
use glam::DVec3;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Largest valence that a collapse may make, as long as there are others.
const MOST_VALENCE: usize = 40;
/// What the way of nodes that went before counts beside that of the next one: a quarter of it keeps levels even and is
/// kinder to long limbs than all of it.
const REACH_SHARE: f64 = 0.25;
/// A tetrahedron's nodes.
const LAST: usize = 4;
/// Collapses between two questions to the listener: a few milliseconds.
const COLLAPSES_PER_REPORT: usize = 1024;

/// Collapses the mesh to a tetrahedron and returns the nodes that went, in order.
pub(super) fn collapse(
    mesh: &Mesh,
    rings: &mut Rings,
    control: &mut Control,
) -> Result<Vec<u32>, SphereError> {
    let count = mesh.points().len();
    let used = (0..count as u32).filter(|&node| rings.valence(node) > 0).count();
    let mut collapser = Collapser {
        points: mesh.points(),
        rings,
        marks: RingMarks::new(count),
        reach: memory::filled(0.0, count),
        is_gone: memory::filled(false, count),
        stamps: memory::filled(0, count),
        queue: BinaryHeap::new(),
        most_valence: MOST_VALENCE,
    };
    let mut order = memory::with_capacity(used);
    while used - order.len() > LAST {
        let before = order.len();
        collapser.fill();
        while let Some((node, to)) = collapser.next() {
            collapser.collapse(node, to);
            memory::push(&mut order, node);
            if used - order.len() == LAST {
                break;
            }
            if order.len().is_multiple_of(COLLAPSES_PER_REPORT) {
                control.report(order.len() as f64 / used as f64, f64::NAN)?;
            }
        }
        if order.len() == before {
            if collapser.most_valence == usize::MAX {
                let node = collapser.is_gone.iter().position(|gone| !gone).unwrap_or(0);
                return Err(SphereError::Stuck { count: used - order.len(), node });
            }
            collapser.most_valence = usize::MAX;
        }
    }
    Ok(order)
}

/// Cost (the bits of a positive number sort as it does), node, and its stamp.
type Entry = Reverse<(u64, u32, u32)>;

struct Collapser<'a> {
    points: &'a [DVec3],
    rings: &'a mut Rings,
    marks: RingMarks,
    /// By node: the longest `way` of those that have gone to it.
    reach: Vec<f64>,
    is_gone: Vec<bool>,
    /// By node: how often its surroundings have changed; older entries of the queue are void.
    stamps: Vec<u32>,
    queue: BinaryHeap<Entry>,
    most_valence: usize,
}

impl Collapser<'_> {
    fn fill(&mut self) {
        self.queue.clear();
        for node in 0..self.points.len() as u32 {
            if !self.is_gone[node as usize] && self.rings.valence(node) > 0 {
                self.enqueue(node);
            }
        }
    }

    fn enqueue(&mut self, node: u32) {
        self.stamps[node as usize] += 1;
        if let Some((cost, _)) = self.cheapest(node) {
            memory::reserve_item(&mut self.queue);
            self.queue.push(Reverse((cost.to_bits(), node, self.stamps[node as usize])));
        }
    }

    /// The next node to go, and where to.
    fn next(&mut self) -> Option<(u32, u32)> {
        loop {
            let Reverse((_, node, stamp)) = self.queue.pop()?;
            if self.is_gone[node as usize] || stamp != self.stamps[node as usize] {
                continue;
            }
            // what is two edges away may have changed without a stamp
            if let Some((_, to)) = self.cheapest(node) {
                return Some((node, to));
            }
        }
    }

    /// The least cost of a collapse that keeps a sphere, and the neighbour it leads to.
    fn cheapest(&mut self, node: u32) -> Option<(f64, u32)> {
        let ring = self.rings.of(node);
        self.marks.mark(ring);
        let valence = ring.len();
        let removal = 1.0 + 0.05 * (valence as f64 - 6.0).powi(2);
        let mut best: Option<(f64, u32)> = None;
        for (k, &to) in ring.iter().enumerate() {
            let after = self.rings.valence(to) + valence - 4;
            let excess = (after as f64 - 6.0).max(0.0);
            let cost = self.way(node, to).powi(2) * (1.0 + 0.1 * excess * excess) * removal;
            let sides = [ring[(k + 1) % valence], ring[(k + valence - 1) % valence]];
            if best.is_none_or(|(least, _)| cost < least)
                && (3..=self.most_valence).contains(&after)
                && sides.iter().all(|&side| self.rings.valence(side) > 3)
                && self.marks.count(self.rings.of(to)) == 2
            {
                best = Some((cost, to));
            }
        }
        best
    }

    /// The way of a node and of those that have gone to it.
    fn way(&self, node: u32, to: u32) -> f64 {
        self.points[node as usize].distance(self.points[to as usize])
            + REACH_SHARE * self.reach[node as usize]
    }

    fn collapse(&mut self, node: u32, to: u32) {
        self.reach[to as usize] = self.reach[to as usize].max(self.way(node, to));
        self.rings.collapse(node, to);
        self.is_gone[node as usize] = true;
        for k in 0..self.rings.valence(node) {
            self.enqueue(self.rings.of(node)[k]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::closed::block;

    #[test]
    fn levels_of_regular_grids_are_even() {
        // the spacing grows all the way along the block
        let grid = block(0, 30, 0).unwrap();
        let points = grid.points().iter().map(|p| *p * (1.0 + 0.3 * p.y)).collect();
        let mesh = Mesh::new(points, grid.triangles().to_vec()).unwrap();
        let mut rings = Rings::new(&mesh);
        let count = mesh.points().len();
        let order = collapse(&mesh, &mut rings, &mut Control::new(1)).unwrap();
        let point = |node: u32| mesh.points()[node as usize];
        let mut left = order.as_slice();
        for share in [0.02, 0.1, 0.5, 0.9] {
            while let Some((&node, rest)) = left.split_last()
                && ((count - left.len()) as f64) < share * count as f64
            {
                rings.expand(node);
                left = rest;
            }
            let live = (0..count as u32).filter(|node| !left.contains(node));
            let lengths = live.flat_map(|node| {
                rings
                    .of(node)
                    .iter()
                    .map(move |&other| point(node).distance(point(other)))
                    .collect::<Vec<_>>()
            });
            let (sum, most, ends) = lengths
                .fold((0.0, 0.0_f64, 0), |(sum, most, n), length| (sum + length, most.max(length), n + 1));
            let mean = sum / f64::from(ends);
            // the spacing differs by a factor of 1.9 along the block
            assert!(most <= 4.0 * mean, "{share}: {most} {mean}");
        }
    }
}
