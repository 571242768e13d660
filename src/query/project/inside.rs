//! Which cells lie inside the trims.
//!
//! A cell that no line of the trims touches is inside or outside as a whole; the others keep the list of their
//! lines, which shrinks as a search halves them:
//! ```text
//! +-------+-------+-------+
//! |  out  |  cut /|  in   |    out: never looked at;  in: searched as if there were no trims;
//! |       |     / |       |    cut: its halves are in, out, or cut by fewer lines.
//! +-------+----/--+-------+
//! ```
//! Tests lean to "cut": a line that only comes near counts. That costs time and never an answer.

use super::index::{Index, LEAF, Place};
use crate::geometry::Domain;
use crate::memory::{self, CollectVec};
use crate::surface::Trims;
use glam::DVec2;

/// A line this near to a cell, against the size of the domain, touches it.
const MARGIN: f64 = 1e-13;

/// How a rectangle lies to the trims.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    Inside,
    Outside,
    Cut,
}

/// The leaves of an index against trims.
#[derive(Debug, Clone)]
pub(super) struct Inside {
    trims: Trims,
    lines: Vec<[DVec2; 2]>,
    margin: DVec2,
    sides: Vec<Side>,
    /// The lines that touch leaf k are `touching[starts[k]..starts[k + 1]]`.
    starts: Vec<u32>,
    touching: Vec<u32>,
    /// For each node a bit for each child that has nothing inside.
    closed: Vec<u8>,
}

impl Inside {
    /// For trims that are not empty.
    pub(super) fn new(index: &Index, trims: &Trims, domain: &Domain) -> Self {
        let largest = domain.min.abs().max(domain.max.abs());
        let mut inside = Self {
            trims: trims.clone(),
            lines: trims.segments().map(|(from, to)| [from, to]).collect_vec(),
            margin: MARGIN * domain.size() + 4.0 * f64::EPSILON * largest,
            sides: memory::with_capacity(index.leaf_count()),
            starts: memory::with_capacity(index.leaf_count() + 1),
            touching: Vec::new(),
            closed: memory::filled(0, index.node_count()),
        };
        inside.sort_lines(index);
        for leaf in 0..index.leaf_count() {
            let is_cut = inside.starts[leaf] < inside.starts[leaf + 1];
            let side = if is_cut { Side::Cut } else { inside.side_of(&rectangle(index.place(leaf))) };
            memory::push(&mut inside.sides, side);
        }
        inside.close_nodes(index);
        inside
    }

    /// Finds the lines of each leaf.
    fn sort_lines(&mut self, index: &Index) {
        let mut pairs: Vec<(u32, u32)> = Vec::new();
        for (number, &[from, to]) in self.lines.iter().enumerate() {
            let box_around = Domain { min: from.min(to) - self.margin, max: from.max(to) + self.margin };
            index.visit_leaves_near(&box_around, |leaf| {
                if self.touches(number as u32, &rectangle(index.place(leaf))) {
                    memory::push(&mut pairs, (leaf as u32, number as u32));
                }
            });
        }
        pairs.sort_unstable();
        let start = |leaf: usize| pairs.partition_point(|&(of, _)| (of as usize) < leaf) as u32;
        memory::extend(&mut self.starts, (0..=index.leaf_count()).map(start));
        memory::extend(&mut self.touching, pairs.iter().map(|&(_, number)| number));
    }

    /// Children come after their nodes.
    fn close_nodes(&mut self, index: &Index) {
        for node in (0..index.node_count()).rev() {
            for (b, &child) in index.children(node as u32).iter().enumerate() {
                let is_closed = match child & LEAF {
                    0 => {
                        let used = index.children(child).len();
                        self.closed[child as usize].count_ones() as usize == used
                    }
                    _ => self.sides[(child & !LEAF) as usize] == Side::Outside,
                };
                self.closed[node] |= u8::from(is_closed) << b;
            }
        }
    }

    /// Whether a child of a node has nothing inside.
    #[inline(always)]
    pub(super) fn is_closed(&self, node: u32, child: usize) -> bool {
        self.closed[node as usize] >> child & 1 == 1
    }

    /// Whether a leaf has nothing inside.
    pub(super) fn is_outside(&self, leaf: usize) -> bool {
        self.sides[leaf] == Side::Outside
    }

    /// The lines that cut a leaf.
    pub(super) fn lines_of(&self, leaf: usize) -> &[u32] {
        &self.touching[self.starts[leaf] as usize..self.starts[leaf + 1] as usize]
    }

    /// Whether a place counts.
    pub(super) fn contains(&self, uv: DVec2) -> bool {
        self.trims.contains(uv)
    }

    /// Whether a rectangle that no line touches lies inside.
    pub(super) fn holds(&self, cell: &Domain) -> bool {
        self.side_of(cell) == Side::Inside
    }

    fn side_of(&self, cell: &Domain) -> Side {
        match self.trims.contains(cell.min + cell.size() / 2.0) {
            true => Side::Inside,
            false => Side::Outside,
        }
    }

    /// Whether a line and a rectangle have a point in common, or nearly: no side of the rectangle separates
    /// them, and the line itself does not.
    pub(super) fn touches(&self, line: u32, cell: &Domain) -> bool {
        let [from, to] = self.lines[line as usize];
        let half = cell.size() / 2.0 + self.margin;
        let centre = cell.min + cell.size() / 2.0;
        let (low, high) = (from.min(to) - centre, from.max(to) - centre);
        if low.cmpgt(half).any() || high.cmplt(-half).any() {
            return false;
        }
        let (along, out) = ((to - from).abs(), centre - from);
        let offset = (to - from).perp_dot(out).abs();
        let rounding = 4.0 * f64::EPSILON * (along.x * out.y.abs() + along.y * out.x.abs());
        offset <= along.x * half.y + along.y * half.x + rounding
    }
}

fn rectangle(place: &Place) -> Domain {
    match *place {
        Place::Rectangle(domain) => domain,
        Place::Line(from, to) => Domain::around([from, to]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::knots::KnotVector;
    use crate::query::project::cells::surface_cells;
    use crate::samples::Random;
    use crate::surface::Surface;
    use crate::surface::tensor::TensorSurface;
    use std::f64::consts::TAU;

    #[test]
    fn cells_without_lines_lie_on_one_side() {
        let breaks: Vec<f64> = (0..=20).map(f64::from).collect();
        let knots = KnotVector::clamped(&breaks, 2).unwrap();
        let count = knots.basis_count();
        let points = (0..count * count).flat_map(|k| [(k / count) as f64, (k % count) as f64, 0.0]);
        let surface = TensorSurface::new(3, knots.clone(), knots, points.collect(), None).unwrap();
        let star = |radius: f64, count: usize| -> Vec<DVec2> {
            let spoke = |k: usize| radius * if k.is_multiple_of(2) { 1.0 } else { 0.6 };
            let corner = |k: usize| 10.0 + spoke(k) * DVec2::from_angle(TAU * k as f64 / count as f64);
            (0..count).map(corner).collect()
        };
        let trims = Trims::new(vec![star(9.9, 16), star(4.0, 300)], &surface.domain()).unwrap();
        let index = Index::new(surface_cells(surface.patches().unwrap()));
        let inside = Inside::new(&index, &trims, &surface.domain());
        let mut random = Random::new(3);
        let mut seen = [0; 3];
        for leaf in 0..index.leaf_count() {
            let cell = rectangle(index.place(leaf));
            seen[inside.sides[leaf] as usize] += 1;
            for _ in 0..50 {
                let uv = cell.min + DVec2::new(random.unit(), random.unit()) * cell.size();
                match inside.sides[leaf] {
                    Side::Inside => assert!(trims.contains(uv), "{uv} is not inside"),
                    Side::Outside => assert!(!trims.contains(uv), "{uv} is not outside"),
                    Side::Cut => assert!(!inside.lines_of(leaf).is_empty()),
                }
            }
        }
        assert!(seen.iter().all(|&count| count > 20), "{seen:?}");
        let (index, inside) = (&index, &inside);
        let open = (0..index.node_count() as u32).flat_map(|node| {
            let children = index.children(node).iter().enumerate();
            children.filter(move |(b, child)| **child & LEAF != 0 && !inside.is_closed(node, *b))
        });
        assert_eq!(open.count(), seen[0] + seen[2]);
    }
}
