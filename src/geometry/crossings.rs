//! Where pieces of polylines in the plane meet.
//!
//! A binary tree of boxes over the pieces, each cut off at its corners by lines of slope 1 and -1, is walked against itself:
//! of a border, however its pieces lie, few boxes overlap. Long pieces side by side of another slope have boxes that
//! overlap, and are compared in pairs. All decisions are exact: rounding keeps sums in their order.

use super::{Orientation, orientation};
use crate::memory::{self, CollectVec};
use glam::{DVec2, DVec4};
use std::ops::ControlFlow;

/// Visits pairs of pieces that meet other than at a common node, until `visit` breaks. A piece is the two nodes at its
/// ends.
pub fn visit_meetings(
    pieces: Vec<[u32; 2]>,
    place: impl Fn(u32) -> DVec2,
    mut visit: impl FnMut([u32; 2], [u32; 2]) -> ControlFlow<()>,
) -> ControlFlow<()> {
    visit_near(pieces, &place, |one, other| match pieces_meet(one, other, &place) {
        true => visit(one, other),
        false => ControlFlow::Continue(()),
    })
}

/// The least and the largest x, y, x + y and x - y of some pieces.
#[derive(Debug, Clone, Copy)]
struct Extent {
    least: DVec4,
    most: DVec4,
}

impl Extent {
    const NOTHING: Self = Self { least: DVec4::INFINITY, most: DVec4::NEG_INFINITY };

    fn of(ends: [DVec2; 2]) -> Self {
        let [a, b] = ends.map(|p| DVec4::new(p.x, p.y, p.x + p.y, p.x - p.y));
        Self { least: a.min(b), most: a.max(b) }
    }

    fn and(self, other: Self) -> Self {
        Self { least: self.least.min(other.least), most: self.most.max(other.most) }
    }

    fn overlaps(&self, other: &Self) -> bool {
        self.least.cmple(other.most).all() && other.least.cmple(self.most).all()
    }
}

/// A piece, and where it lies.
#[derive(Debug, Clone, Copy)]
struct Placed {
    piece: [u32; 2],
    extent: Extent,
}

impl Placed {
    /// Twice its middle.
    fn middle(&self) -> DVec4 {
        self.extent.least + self.extent.most
    }
}

/// Pieces of a leaf: comparing two of them costs no more than comparing boxes.
const LEAF_SIZE: usize = 4;

/// Pieces `first .. first + count`. The first child follows its parent.
struct Node {
    extent: Extent,
    first: usize,
    count: usize,
    /// The second child; 0 for a leaf.
    second: usize,
}

/// Visits pairs of pieces, among them all that meet.
fn visit_near(
    pieces: Vec<[u32; 2]>,
    place: impl Fn(u32) -> DVec2,
    mut visit: impl FnMut([u32; 2], [u32; 2]) -> ControlFlow<()>,
) -> ControlFlow<()> {
    let placed = |piece: [u32; 2]| Placed { piece, extent: Extent::of(piece.map(&place)) };
    let mut pieces = pieces.into_iter().map(placed).collect_vec();
    if pieces.is_empty() {
        return ControlFlow::Continue(());
    }
    let mut nodes = Vec::new();
    add_node(&mut nodes, 0, &mut pieces);
    let mut pairs = vec![(0, 0)];
    while let Some((a, b)) = pairs.pop() {
        let (one, other) = (&nodes[a], &nodes[b]);
        if !one.extent.overlaps(&other.extent) {
            continue;
        }
        match (one.second, other.second) {
            (0, 0) => visit_leaves(&pieces, one, other, &mut visit)?,
            (second, _) if a == b => pairs.extend([(a + 1, a + 1), (a + 1, second), (second, second)]),
            // the larger of the two is divided
            (_, second) if second > 0 && other.count >= one.count => pairs.extend([(a, b + 1), (a, second)]),
            (second, _) => pairs.extend([(a + 1, b), (second, b)]),
        }
    }
    ControlFlow::Continue(())
}

/// Adds the node of some pieces, the `first` of all on, with all below it.
fn add_node(nodes: &mut Vec<Node>, first: usize, pieces: &mut [Placed]) {
    let extent = pieces.iter().fold(Extent::NOTHING, |all, placed| all.and(placed.extent));
    let (node, count, half) = (nodes.len(), pieces.len(), pieces.len() / 2);
    memory::push(nodes, Node { extent, first, count, second: 0 });
    if count <= LEAF_SIZE {
        return;
    }
    let axis = (extent.most - extent.least).max_position();
    pieces.select_nth_unstable_by(half, |a, b| {
        a.middle()[axis].total_cmp(&b.middle()[axis]).then(a.piece.cmp(&b.piece))
    });
    let (low, high) = pieces.split_at_mut(half);
    add_node(nodes, first, low);
    nodes[node].second = nodes.len();
    add_node(nodes, first + half, high);
}

/// Visits the pairs of two leaves, or of one with itself, whose boxes overlap.
fn visit_leaves(
    pieces: &[Placed],
    one: &Node,
    other: &Node,
    visit: &mut impl FnMut([u32; 2], [u32; 2]) -> ControlFlow<()>,
) -> ControlFlow<()> {
    let range = |node: &Node| node.first..node.first + node.count;
    for k in range(one) {
        // of one leaf each pair once
        for j in range(other).filter(|&j| one.first != other.first || j > k) {
            if pieces[k].extent.overlaps(&pieces[j].extent) {
                visit(pieces[k].piece, pieces[j].piece)?;
            }
        }
    }
    ControlFlow::Continue(())
}

/// Pieces with a common node meet elsewhere only if they run back along one another.
fn pieces_meet(first: [u32; 2], second: [u32; 2], place: impl Fn(u32) -> DVec2) -> bool {
    let ([a, b], [c, d]) = (first.map(&place), second.map(&place));
    if let Some(&node) = first.iter().find(|node| second.contains(node)) {
        let other_end = |[p, q]: [u32; 2]| place(if p == node { q } else { p });
        let (at, p, q) = (place(node), other_end(first), other_end(second));
        return orientation(at, p, q) == Orientation::Zero && (p - at).dot(q - at) > 0.0;
    }
    let apart = |p: DVec2, q: DVec2, r: DVec2, s: DVec2| {
        let (one, other) = (orientation(p, q, r), orientation(p, q, s));
        one == other && one != Orientation::Zero
    };
    !apart(a, b, c, d) && !apart(c, d, a, b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::Random;
    use std::f64::consts::FRAC_PI_4;

    /// The pieces of a closed polyline.
    fn closed(count: usize) -> Vec<[u32; 2]> {
        (0..count).map(|k| [k as u32, ((k + 1) % count) as u32]).collect()
    }

    /// The border of the unit square in so many equal pieces.
    fn square(count: usize) -> Vec<DVec2> {
        let side = count / 4;
        let at = |k: usize| (k % side) as f64 / side as f64;
        let corner = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
        (0..4 * side).map(|k| corner[k / side].lerp(corner[(k / side + 1) % 4], at(k))).collect()
    }

    /// A comb of long upright teeth over a base far below.
    fn comb(count: usize) -> Vec<DVec2> {
        let side = |k: usize| DVec2::new((k / 2) as f64 / count as f64, (k.div_ceil(2) % 2) as f64);
        (0..count - 2).map(side).chain([DVec2::new(0.5, -2.0), DVec2::new(0.0, -2.0)]).collect()
    }

    #[test]
    fn of_borders_only_neighbours_are_compared() {
        for count in [4000, 16_000] {
            for (shape, places) in [("square", square(count)), ("comb", comb(count))] {
                for angle in [0.0, FRAC_PI_4] {
                    let turned: Vec<DVec2> =
                        places.iter().map(|&p| DVec2::from_angle(angle).rotate(p)).collect();
                    let mut compared = 0;
                    let _ = visit_near(
                        closed(count),
                        |node| turned[node as usize],
                        |_, _| {
                            compared += 1;
                            ControlFlow::Continue(())
                        },
                    );
                    // neighbours are `count` pairs; as many again may touch by rounding
                    assert!(compared <= 2 * count, "{shape} of {count} at {angle}: {compared} pairs");
                }
            }
        }
    }

    #[test]
    fn all_meetings_are_visited_once() {
        let mut random = Random::new(5);
        for (count, length) in [(0, 0.1), (1, 0.1), (5, 1.0), (300, 0.1), (300, 1.0)] {
            let places: Vec<DVec2> = (0..count)
                .flat_map(|_| {
                    let from = DVec2::new(random.signed(), random.signed());
                    // on a grid, so that ends touch other pieces and pieces run along one another
                    let to = from + length * DVec2::new(random.signed(), random.signed());
                    [from, to].map(|p| (16.0 * p).round() / 16.0)
                })
                .collect();
            let pieces: Vec<[u32; 2]> = (0..count as u32).map(|k| [2 * k, 2 * k + 1]).collect();
            let place = |node: u32| places[node as usize];
            let mut found = Vec::new();
            let _ = visit_meetings(pieces.clone(), place, |one, other| {
                found.push([one.min(other), one.max(other)]);
                ControlFlow::Continue(())
            });
            found.sort_unstable();
            let boxes_meet =
                |a: &[u32; 2], b: &[u32; 2]| Extent::of(a.map(place)).overlaps(&Extent::of(b.map(place)));
            let pairs =
                pieces.iter().enumerate().flat_map(|(k, a)| pieces[k + 1..].iter().map(move |b| [*a, *b]));
            let all: Vec<_> = pairs.filter(|[a, b]| boxes_meet(a, b) && pieces_meet(*a, *b, place)).collect();
            assert_eq!(found, all, "{count} pieces {length} long");
        }
    }
}
