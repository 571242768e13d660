//! Turned boxes around things that are longer than wide.
//!
//! S. Gottschalk, M. C. Lin, D. Manocha, "OBBTree: a hierarchical structure for rapid interference detection", SIGGRAPH
//! 1996: a tree whose boxes lie along what is in them. Those around the faces of a fan hardly overlap, while boxes along the
//! axes of the plane all have its hub.

use crate::memory;
use glam::DVec2;
use std::ops::Range;

/// A number and three corners.
type Thing = (u32, [DVec2; 3]);

/// Things of a leaf.
const LEAF: usize = 4;
/// Against the largest coordinate: turning a point rounds by less, and places on a border computed from its ends are not
/// farther outside (see `locate`).
const SLACK: f64 = 32.0 * f64::EPSILON;

/// A tree of boxes around triangles, or sides with one end given twice.
#[derive(Debug, Clone, Default)]
pub(super) struct TurnedBoxes {
    /// Each before those inside it.
    nodes: Vec<Node>,
    /// The numbers of the things, by leaf.
    numbers: Vec<u32>,
    /// How far boxes reach beyond what is in them: more than coordinates are rounded by.
    slack: f64,
}

#[derive(Debug, Clone)]
struct Node {
    /// Of length 1.
    along: DVec2,
    /// In the coordinates along and across.
    min: DVec2,
    max: DVec2,
    /// The node after all those inside this one.
    after: u32,
    /// Those of a leaf.
    numbers: Range<u32>,
}

impl TurnedBoxes {
    /// Around things that are numbered; no coordinate is larger than `largest`.
    pub(super) fn new(mut things: Vec<Thing>, largest: f64) -> Self {
        let mut tree = Self { slack: SLACK * largest, ..Self::default() };
        if !things.is_empty() {
            tree.add(&mut things);
        }
        tree
    }

    pub(super) fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    fn add(&mut self, things: &mut [Thing]) {
        let place = self.nodes.len();
        memory::push(&mut self.nodes, Node::around(things, self.slack));
        if things.len() <= LEAF {
            let first = self.numbers.len() as u32;
            memory::extend(&mut self.numbers, things.iter().map(|&(number, _)| number));
            self.nodes[place].numbers = first..self.numbers.len() as u32;
        } else {
            let (left, right) = halves(things);
            self.add(left);
            self.add(right);
        }
        self.nodes[place].after = self.nodes.len() as u32;
    }

    /// Appends the numbers of all things that may meet a convex counter-clockwise polygon, or a single point.
    pub(super) fn near(&self, polygon: &[DVec2], out: &mut Vec<u32>) {
        let mut at = 0;
        while let Some(node) = self.nodes.get(at) {
            if !node.meets(polygon, self.slack) {
                at = node.after as usize;
                continue;
            }
            let numbers = node.numbers.start as usize..node.numbers.end as usize;
            memory::extend(out, self.numbers[numbers].iter().copied());
            at += 1;
        }
    }
}

/// Two halves on either side of the middle, across the longer side of the box around all middles.
fn halves(things: &mut [Thing]) -> (&mut [Thing], &mut [Thing]) {
    let middle = |corners: &[DVec2; 3]| corners[0] + corners[1] + corners[2];
    let around = crate::geometry::Domain::around(things.iter().map(|(_, corners)| middle(corners)));
    let axis = usize::from(around.size().y > around.size().x);
    let half = things.len() / 2;
    things.select_nth_unstable_by(half, |(a, p), (b, q)| {
        middle(p)[axis].total_cmp(&middle(q)[axis]).then(a.cmp(b))
    });
    things.split_at_mut(half)
}

impl Node {
    /// Along the longest side of all things.
    fn around(things: &[Thing], slack: f64) -> Self {
        let sides = things.iter().flat_map(|(_, [a, b, c])| [*b - *a, *c - *b, *a - *c]);
        let longest = sides.max_by(|p, q| p.length_squared().total_cmp(&q.length_squared()));
        let along = longest.unwrap_or_default().normalize_or(DVec2::X);
        let mut node =
            Self { along, min: DVec2::INFINITY, max: DVec2::NEG_INFINITY, after: 0, numbers: 0..0 };
        for &corner in things.iter().flat_map(|(_, corners)| corners) {
            let turned = node.turned(corner);
            (node.min, node.max) = (node.min.min(turned - slack), node.max.max(turned + slack));
        }
        node
    }

    fn turned(&self, p: DVec2) -> DVec2 {
        DVec2::new(self.along.dot(p), self.along.perp_dot(p))
    }

    fn meets(&self, polygon: &[DVec2], slack: f64) -> bool {
        let corners = polygon.iter().map(|&p| self.turned(p));
        let (min, max) = corners
            .clone()
            .fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(min, max), p| (min.min(p), max.max(p)));
        if min.cmpgt(self.max).any() || max.cmplt(self.min).any() {
            return false;
        }
        let next = corners.clone().cycle().skip(1);
        !corners.zip(next).any(|(a, b)| self.is_right_of(a, b, slack))
    }

    /// Whether the whole box, and what rounding adds to it, lies to the right of a line.
    fn is_right_of(&self, a: DVec2, b: DVec2, slack: f64) -> bool {
        let along = b - a;
        // the corner farthest to the left
        let corner = DVec2::new(
            if along.y < 0.0 { self.max.x } else { self.min.x },
            if along.x > 0.0 { self.max.y } else { self.min.y },
        );
        along.perp_dot(corner - a) < -slack * along.length()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::memory::CollectVec;
    use crate::samples::Random;

    #[test]
    fn all_that_meet_are_found_and_few_others() {
        // the faces of a fan, thin and turned in all directions
        const COUNT: usize = 5000;
        let rim = |k: usize| DVec2::from_angle(std::f64::consts::TAU * k as f64 / COUNT as f64);
        let faces: Vec<[DVec2; 3]> = (0..COUNT).map(|k| [DVec2::ZERO, rim(k), rim(k + 1)]).collect();
        let numbered = faces.iter().enumerate().map(|(k, &face)| (k as u32, face)).collect_vec();
        let tree = TurnedBoxes::new(numbered, 1.0);
        let mut random = Random::new(3);
        let mut near = Vec::new();
        for _ in 0..200 {
            let k = (random.unit() * COUNT as f64) as usize % COUNT;
            let shares = [random.unit(), random.unit()];
            let inside = faces[k][1].lerp(faces[k][2], shares[0]) * (0.1 + 0.9 * shares[1]);
            near.clear();
            tree.near(&[inside], &mut near);
            assert!(near.contains(&(k as u32)), "{k} at {inside}");
            // boxes are as wide at the hub as at the rim: ten times as many overlap at a tenth of the way
            assert!(near.len() <= 20 * LEAF, "{} near {inside}", near.len());
            // a triangle that has the point: the same face is found
            let around =
                [(1.0, 0.0), (-0.5, 0.8), (-0.5, -0.8)].map(|step| inside + 1e-6 * DVec2::from(step));
            near.clear();
            tree.near(&around, &mut near);
            assert!(near.contains(&(k as u32)), "{k} under {around:?}");
        }
        assert!(TurnedBoxes::new(Vec::new(), 0.0).is_empty());
    }
}
