//! The base complex: few triangles, and where every node of the mesh lies on them.
//!
//! M. Garland, P. Heckbert, "Surface simplification using quadric error metrics" (1997) for the cost; A. Lee, W. Sweldens,
//! P. Schroeder, L. Cowsar, D. Dobkin, "MAPS: multiresolution adaptive parameterization of surfaces", SIGGRAPH 1998, for
//! the tracked map. When v is moved on to u, the triangles around v are laid flat (`flatten`), all nodes in them get
//! places in the plane, and those places are found again in the triangles that are left:
//! ```text
//!         q3 --- q2                q3 --- q2      .  a node that went before
//!        /  \ . /  \              /  `. . | \     v  becomes one
//!      q4 --- v --- q1    ->    q4 - v `. |  q1
//!        \    |    /              \      `|./
//!          `- u -'                  `---- u
//! ```
//! A collapse keeps the topology (link condition) and valences between 4 and 8, from which pairs of triangles make quads
//! with good corners. Nodes of the border stay on it (`border`).

use super::border::{Along, Border, BorderNode};
use super::flatten::flattened;
use crate::Control;
use crate::control::Cancelled;
use crate::mesh::Quadric;
use crate::mesh::rings::{RingMarks, Rings};
use glam::{DVec2, DVec3};
use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap};

/// Least valence of a node.
const LEAST_VALENCE: usize = 4;
/// Most, unless it was above before and does not grow.
const MOST_VALENCE: usize = 8;
/// The same for nodes of the border, where a part of the triangles is void.
const LEAST_BORDER_VALENCE: usize = 3;
const MOST_BORDER_VALENCE: usize = 10;
/// Planes across border edges weigh this much, in squares of the edges: chains keep their place in the tangent plane.
const BORDER_WEIGHT: f64 = 4.0;
/// Weight of the length of an edge, to the fourth power as the quadric, so that flat regions thin out evenly.
const LENGTH_SHARE: f64 = 0.01;
/// Weight of the squared distance of a valence from 6.
const VALENCE_SHARE: f64 = 0.1;
/// Cosine of the turn beyond which a triangle counts as turned over: 78 degrees.
const LEAST_TURN_COSINE: f64 = 0.2;
/// Collapses that turn a triangle over come last.
const TURNED_OVER: f64 = 1e3;
/// An entry of the queue is renewed if its cost has grown by more than this share.
const STALE: f64 = 1e-4;
/// Collapses between two questions to the listener.
const COLLAPSES_PER_REPORT: usize = 256;

/// A place in a triangle: weights of its corners, positive, of sum 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TrianglePlace {
    pub triangle: u32,
    pub weights: [f64; 3],
}

/// A coarse triangulation of a surface with the map of the nodes of a middle level, and how the others come back.
#[derive(Debug, Clone)]
pub(super) struct Base {
    /// By vertex: its node; none for one in the middle of an edge that was split.
    pub nodes: Vec<Option<u32>>,
    /// Where the vertices are.
    pub points: Vec<DVec3>,
    /// By vertex: where it lies on the border, and the quads that it needs.
    pub border: Vec<Option<(Along, u32)>>,
    /// Three vertices each.
    pub triangles: Vec<[u32; 3]>,
    /// By node of the middle level.
    pub places: Vec<Option<TrianglePlace>>,
    pub fine: Fine,
}

/// The nodes between a middle level and the mesh.
#[derive(Debug, Clone)]
pub(in crate::layout) struct Fine {
    /// The mesh of the middle level.
    pub rings: Rings,
    /// The nodes that went before it was reached, in order.
    pub order: Vec<u32>,
}

/// Which nodes collapse.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Collapsing {
    /// All but corners.
    Any,
    /// When so many are left beside nodes of the border that are no corners, only these, until none of them is left.
    ToCorners,
}

/// Collapses edges of a mesh closed by cones until about `target` nodes are left, or none can go; nodes are tracked from a
/// middle level of `tracked` nodes on.
pub(super) fn decimate(
    border: &Border,
    target: usize,
    tracked: usize,
    collapsing: Collapsing,
    control: &mut Control,
) -> Result<Base, Cancelled> {
    let mut decimation = Decimation::new(border);
    let used = decimation.present().count();
    let mut left = used;
    // those of the border that go at last: they are not counted, or nothing inside would be left beside them
    let mut loose = match collapsing {
        Collapsing::Any => 0,
        Collapsing::ToCorners => decimation.present().filter(|&node| decimation.is_loose(node)).count(),
    };
    let mut target = target;
    loop {
        let before = left;
        decimation.is_border_only |= collapsing == Collapsing::ToCorners && left <= target + loose;
        decimation.fill();
        while if decimation.is_border_only { loose > 0 } else { left > target + loose } {
            let Some((node, to)) = decimation.next() else { break };
            if left > tracked.max(target) {
                decimation.order.push(node);
                decimation.remove(node, to);
            } else {
                decimation.collapse(node, to);
            }
            left -= 1;
            loose -= usize::from(collapsing == Collapsing::ToCorners && decimation.is_loose(node));
            if (used - left).is_multiple_of(COLLAPSES_PER_REPORT) {
                control.report((used - left) as f64 / (used - target) as f64, f64::NAN)?;
            }
        }
        // what was refused may have become possible by changes two edges away
        let is_last = collapsing == Collapsing::Any || decimation.is_border_only;
        let is_reached = if decimation.is_border_only { loose == 0 } else { left <= target + loose };
        if left == before || (is_reached && is_last) {
            if is_last {
                return Ok(decimation.finish());
            }
            target = left - loose;
        }
    }
}

/// The corners of a triangle, the smallest first.
type Face = [u32; 3];

fn face(a: u32, b: u32, c: u32) -> Face {
    if a < b && a < c {
        [a, b, c]
    } else if b < c {
        [b, c, a]
    } else {
        [c, a, b]
    }
}

/// Cost (the bits of a positive number sort as it does), node, and its stamp.
type Entry = Reverse<(u64, u32, u32)>;

struct Decimation<'a> {
    border: &'a Border,
    /// Whether only nodes of the border may go.
    is_border_only: bool,
    /// By node: the neighbours along the border, which change as others go.
    chains: Vec<Option<[u32; 2]>>,
    /// Around the middle of the box, where quadrics keep their digits.
    points: Vec<DVec3>,
    rings: Rings,
    quadrics: Vec<Quadric>,
    is_gone: Vec<bool>,
    marks: RingMarks,
    stamps: Vec<u32>,
    queue: BinaryHeap<Entry>,
    /// Nodes that went, by the triangle they lie in.
    inside: HashMap<Face, Vec<u32>>,
    /// By node that went: its triangle and the weights of the corners.
    places: Vec<(Face, [f64; 3])>,
    /// Nodes that went untracked, in order.
    order: Vec<u32>,
    /// The rings when tracking began.
    fine_rings: Option<Rings>,
}

impl<'a> Decimation<'a> {
    fn new(border: &'a Border) -> Self {
        let mesh = &border.closed;
        let count = mesh.points().len();
        let bounds = mesh.bounds();
        let middle = DVec3::from_slice(&bounds.min).midpoint(DVec3::from_slice(&bounds.max));
        let points: Vec<DVec3> = mesh.points().iter().map(|&point| point - middle).collect();
        let mut quadrics = vec![Quadric::ZERO; count];
        let mut add = |node: u32, plane: Quadric| quadrics[node as usize] = quadrics[node as usize] + plane;
        for triangle in mesh.triangles().iter().filter(|t| !t.iter().any(|&node| border.is_tip(node))) {
            let [a, b, c] = triangle.map(|node| points[node as usize]);
            let double_area = (b - a).cross(c - a);
            let normal = double_area.normalize_or_zero();
            let plane = Quadric::plane(a, normal, 0.5 * double_area.length());
            triangle.iter().for_each(|&node| add(node, plane));
            for [from, to] in [[0, 1], [1, 2], [2, 0]].map(|side| side.map(|k| triangle[k])) {
                if border.node(from).is_some_and(|node| node.neighbours[1] == to) {
                    let along = points[to as usize] - points[from as usize];
                    let across = along.cross(normal).normalize_or_zero();
                    let plane =
                        Quadric::plane(points[from as usize], across, BORDER_WEIGHT * along.length_squared());
                    [from, to].into_iter().for_each(|node| add(node, plane));
                }
            }
        }
        Self {
            border,
            is_border_only: false,
            chains: border.nodes.iter().map(|node| node.map(|node| node.neighbours)).collect(),
            points,
            rings: Rings::new(mesh),
            quadrics,
            is_gone: vec![false; count],
            marks: RingMarks::new(count),
            stamps: vec![0; count],
            queue: BinaryHeap::new(),
            inside: HashMap::new(),
            places: vec![([u32::MAX; 3], [0.0; 3]); count],
            order: Vec::new(),
            fine_rings: None,
        }
    }

    fn present(&self) -> impl Iterator<Item = u32> + '_ {
        let nodes = 0..self.points.len() as u32;
        nodes.filter(|&node| !self.is_gone[node as usize] && self.rings.valence(node) > 0)
    }

    /// Whether a node is one of the border and no corner.
    fn is_loose(&self, node: u32) -> bool {
        self.border.node(node).is_some_and(|node| !node.is_corner)
    }

    fn fill(&mut self) {
        self.queue.clear();
        let nodes: Vec<u32> = self.present().collect();
        nodes.into_iter().for_each(|node| self.enqueue(node));
    }

    fn enqueue(&mut self, node: u32) {
        self.stamps[node as usize] += 1;
        if let Some((cost, _)) = self.cheapest(node) {
            self.queue.push(Reverse((cost.to_bits(), node, self.stamps[node as usize])));
        }
    }

    /// The next node to go, and where to.
    fn next(&mut self) -> Option<(u32, u32)> {
        loop {
            let Reverse((cost, node, stamp)) = self.queue.pop()?;
            if self.is_gone[node as usize] || stamp != self.stamps[node as usize] {
                continue;
            }
            match self.cheapest(node) {
                Some((now, to)) if now <= (1.0 + STALE) * f64::from_bits(cost) => return Some((node, to)),
                Some((now, _)) => self.queue.push(Reverse((now.to_bits(), node, stamp))),
                None => {}
            }
        }
    }

    /// The least cost of a collapse that is allowed, and the neighbour it leads to.
    fn cheapest(&mut self, node: u32) -> Option<(f64, u32)> {
        let mut best: Option<(f64, u32)> = None;
        let ring = self.rings.of(node);
        self.marks.mark(ring);
        let is_fixed = self.border.is_tip(node) || self.border.node(node).is_some_and(|node| node.is_corner);
        if is_fixed || (self.is_border_only && !self.is_loose(node)) {
            return None;
        }
        for (k, &to) in ring.iter().enumerate() {
            if self.is_allowed(node, ring, k) {
                let cost = self.cost(node, ring, k);
                if best.is_none_or(|(least, _)| cost < least) {
                    best = Some((cost, to));
                }
            }
        }
        best
    }

    /// Whether a node with this ring, which is marked, may go on to its neighbour k.
    fn is_allowed(&self, node: u32, ring: &[u32], k: usize) -> bool {
        let (to, valence) = (ring[k], ring.len());
        let sides = [ring[(k + 1) % valence], ring[(k + valence - 1) % valence]];
        let before = self.rings.valence(to);
        let after = before + valence - 4;
        let (least, most) = match self.border.node(to) {
            None => (LEAST_VALENCE, MOST_VALENCE),
            // what must go goes, however many triangles meet there
            Some(_) if self.is_border_only => (LEAST_BORDER_VALENCE, usize::MAX),
            Some(_) => (LEAST_BORDER_VALENCE, MOST_BORDER_VALENCE),
        };
        (least..=most.max(before)).contains(&after)
            && !self.border.is_tip(to)
            && self.keeps_border(node, to)
            && sides.iter().all(|&side| self.may_lose_triangle(side, [node, to]))
            && self.marks.count(self.rings.of(to)) == 2
    }

    /// A node of the border goes along it, and not where the rest of its loop would be one edge.
    fn keeps_border(&self, node: u32, to: u32) -> bool {
        let [Some(ends), Some(next)] = [node, to].map(|node| self.chains[node as usize]) else {
            return self.chains[node as usize].is_none();
        };
        // three nodes are the shortest loop: both are then neighbours of the third
        ends.contains(&to) && !ends.iter().any(|end| *end != to && next.contains(end))
    }

    /// Whether a node has triangles to spare for the one with this edge.
    fn may_lose_triangle(&self, node: u32, edge: [u32; 2]) -> bool {
        let valence = self.rings.valence(node);
        match (self.border.node(node), self.chains[node as usize]) {
            (Some(BorderNode { need, is_corner, .. }), Some(ends)) => {
                // two of its triangles are void, and what will go needs only one more
                let need = if self.is_border_only && !is_corner { 1 } else { *need as usize };
                valence > 2 + need && !edge.iter().all(|end| ends.contains(end))
            }
            _ if self.border.is_tip(node) || self.is_border_only => valence > LEAST_BORDER_VALENCE,
            _ => valence > LEAST_VALENCE,
        }
    }

    fn cost(&self, node: u32, ring: &[u32], k: usize) -> f64 {
        let (to, valence) = (ring[k], ring.len());
        let [from, target] = [node, to].map(|node| self.points[node as usize]);
        let height = (self.quadrics[node as usize] + self.quadrics[to as usize]).at(target).max(0.0);
        let length = LENGTH_SHARE * from.distance_squared(target).powi(2);
        let after = (self.rings.valence(to) + valence - 4) as f64;
        let cost = (height + length) * (1.0 + VALENCE_SHARE * (after - 6.0).powi(2));
        let turns_over = (1..valence - 1).any(|j| {
            let others = [j, j + 1].map(|j| ring[(k + j) % valence]);
            if others.iter().any(|&other| self.border.is_tip(other)) {
                return false;
            }
            let [a, b] = others.map(|other| self.points[other as usize]);
            let [before, after] = [from, target].map(|apex| (a - apex).cross(b - apex));
            before.dot(after) < LEAST_TURN_COSINE * (before.length_squared() * after.length_squared()).sqrt()
        });
        if turns_over { TURNED_OVER * (cost + length) } else { cost }
    }

    /// Moves a node on to another, and the nodes around it to triangles that are left.
    fn collapse(&mut self, node: u32, to: u32) {
        if self.fine_rings.is_none() {
            self.fine_rings = Some(self.rings.clone());
        }
        let chain = self.chains[node as usize];
        self.remove(node, to);
        let ring = self.rings.of(node).to_vec();
        self.relocate(node, &ring, chain);
    }

    /// Moves a node on to another.
    fn remove(&mut self, node: u32, to: u32) {
        self.rings.collapse(node, to);
        self.is_gone[node as usize] = true;
        self.quadrics[to as usize] = self.quadrics[to as usize] + self.quadrics[node as usize];
        if let Some([before, after]) = self.chains[node as usize].take() {
            for (end, side, other) in [(before, 1, after), (after, 0, before)] {
                if let Some(ends) = &mut self.chains[end as usize] {
                    ends[side] = other;
                }
            }
        }
        for k in 0..self.rings.valence(node) {
            self.enqueue(self.rings.of(node)[k]);
        }
    }

    /// Finds `node` and the nodes in the triangles around it again in those that replace them: a fan around the first
    /// of the ring. `chain`: the neighbours that the node had along the border.
    fn relocate(&mut self, node: u32, ring: &[u32], chain: Option<[u32; 2]>) {
        if let Some(end) = self.ear_end(ring) {
            return self.relocate_ear(node, ring[0], end);
        }
        let count = ring.len();
        let around: Vec<DVec3> = ring.iter().map(|&other| self.points[other as usize]).collect();
        // a chain of the border stays straight, and tips are beyond it
        let beyond = chain.and_then(|ends| ends.into_iter().find(|&end| end != ring[0]));
        let straight = ring.iter().position(|&other| Some(other) == beyond);
        let flat = flattened(self.points[node as usize], &around, straight);
        let mut moved = vec![(node, DVec2::ZERO)];
        for k in 0..count {
            let old = face(node, ring[k], ring[(k + 1) % count]);
            for inner in self.inside.remove(&old).unwrap_or_default() {
                let (corners, weights) = self.places[inner as usize];
                let place = corners.iter().zip(weights).map(|(&corner, weight)| {
                    let place = ring.iter().position(|&other| other == corner);
                    weight * place.map_or(DVec2::ZERO, |place| flat[place])
                });
                moved.push((inner, place.sum()));
            }
        }
        for (inner, place) in moved {
            let (k, weights) = (1..count - 1)
                .filter(|&k| !self.border.is_tip(ring[k]) && !self.border.is_tip(ring[k + 1]))
                .map(|k| (k, barycentric([flat[0], flat[k], flat[k + 1]], place)))
                .max_by(|(_, a), (_, b)| least(a).total_cmp(&least(b)))
                .expect("a ring has at least three nodes");
            let weights = weights.map(|weight| weight.max(0.0));
            let sum: f64 = weights.iter().sum();
            let corners = [ring[0], ring[k], ring[k + 1]];
            let first = face(corners[0], corners[1], corners[2]);
            let weight_of = |corner: u32| {
                let place = corners.iter().position(|&other| other == corner).expect("the same three");
                weights[place] / sum
            };
            self.places[inner as usize] = (first, first.map(weight_of));
            self.inside.entry(first).or_default().push(inner);
        }
    }

    /// Of a node with one triangle beside the border, which went to the first of its ring: the third corner.
    fn ear_end(&self, ring: &[u32]) -> Option<u32> {
        let mut inner = ring[1..].iter().copied().filter(|&node| !self.border.is_tip(node));
        let end = inner.next().filter(|_| ring.len() == 3);
        end.filter(|_| inner.next().is_none())
    }

    /// What lay in the triangle of an ear comes to lie on the edge that closes it, from `to` to `end`, in the triangle
    /// beyond.
    fn relocate_ear(&mut self, node: u32, to: u32, end: u32) {
        let ring = self.rings.of(to);
        let at = self.rings.position(to, end);
        let beside = [ring[(at + 1) % ring.len()], ring[(at + ring.len() - 1) % ring.len()]];
        let Some((side, &beyond)) = beside.iter().enumerate().find(|(_, other)| !self.border.is_tip(**other))
        else {
            return;
        };
        let first = if side == 0 { face(to, end, beyond) } else { face(to, beyond, end) };
        let share = |from: u32| self.points[node as usize].distance(self.points[from as usize]);
        let [near, far] = [share(to), share(end)];
        let to_end = if near + far > 0.0 { near / (near + far) } else { 0.5 };
        let mut moved = vec![(node, [1.0 - to_end, to_end])];
        for old in [face(node, to, end), face(node, end, to)] {
            for inner in self.inside.remove(&old).unwrap_or_default() {
                let (corners, weights) = self.places[inner as usize];
                let weight_of = |corner: u32| {
                    corners
                        .iter()
                        .zip(weights)
                        .filter(|&(&other, _)| other == corner)
                        .map(|(_, weight)| weight)
                        .sum()
                };
                let [of_node, of_to, of_end]: [f64; 3] = [node, to, end].map(weight_of);
                moved.push((inner, [of_to + (1.0 - to_end) * of_node, of_end + to_end * of_node]));
            }
        }
        for (inner, [of_to, of_end]) in moved {
            let weight_of = |corner: u32| match corner {
                _ if corner == to => of_to,
                _ if corner == end => of_end,
                _ => 0.0,
            };
            self.places[inner as usize] = (first, first.map(weight_of));
            self.inside.entry(first).or_default().push(inner);
        }
    }

    /// Numbers what is left, without tips.
    fn finish(self) -> Base {
        let vertices: Vec<u32> = self.present().filter(|&node| !self.border.is_tip(node)).collect();
        let mut number = vec![u32::MAX; self.points.len()];
        (0..).zip(&vertices).for_each(|(vertex, &node)| number[node as usize] = vertex);
        let mut faces: HashMap<Face, u32> = HashMap::new();
        let mut triangles = Vec::new();
        let mut places = vec![None; self.points.len()];
        for &node in &vertices {
            let ring = self.rings.of(node);
            for (&a, &b) in ring.iter().zip(ring.iter().cycle().skip(1)) {
                if node < a && node < b && !self.border.is_tip(a) && !self.border.is_tip(b) {
                    let triangle = triangles.len() as u32;
                    faces.insert([node, a, b], triangle);
                    triangles.push([node, a, b].map(|node| number[node as usize]));
                    for (corner, node) in [node, a, b].into_iter().enumerate() {
                        let mut weights = [0.0; 3];
                        weights[corner] = 1.0;
                        places[node as usize].get_or_insert(TrianglePlace { triangle, weights });
                    }
                }
            }
        }
        for (node, (face, weights)) in self.places.iter().enumerate() {
            if let Some(&triangle) = faces.get(face) {
                places[node] = Some(TrianglePlace { triangle, weights: *weights });
            }
        }
        let of_border = |&node: &u32| self.border.node(node).map(|node| (node.along, node.need));
        Base {
            nodes: vertices.iter().copied().map(Some).collect(),
            points: vertices.iter().map(|&node| self.border.closed.points()[node as usize]).collect(),
            border: vertices.iter().map(of_border).collect(),
            triangles,
            places,
            fine: Fine { rings: self.fine_rings.unwrap_or(self.rings), order: self.order },
        }
    }
}

impl Base {
    /// Splits the edge between two vertices in its middle, which becomes a vertex, on the border if the edge is;
    /// `lengths` are those of the loops.
    pub(super) fn split(&mut self, [a, b]: [u32; 2], lengths: &[f64]) {
        let middle = self.points.len() as u32;
        self.points.push(self.points[a as usize].midpoint(self.points[b as usize]));
        self.nodes.push(None);
        let at_edge: Vec<usize> = (0..self.triangles.len())
            .filter(|&t| [a, b].iter().all(|end| self.triangles[t].contains(end)))
            .collect();
        let along = match (self.border[a as usize], self.border[b as usize], &at_edge[..]) {
            (Some((p, _)), Some((q, _)), [t]) => {
                // the triangle is on the left of the border
                let corners = self.triangles[*t];
                let is_forward = (0..3).any(|k| [corners[k], corners[(k + 1) % 3]] == [a, b]);
                let (first, last) = if is_forward { (p, q) } else { (q, p) };
                let all = lengths[p.index];
                let half = 0.5 * (last.length - first.length).rem_euclid(all);
                Some((Along { index: p.index, length: (first.length + half).rem_euclid(all) }, 2))
            }
            _ => None,
        };
        self.border.push(along);
        for t in at_edge {
            let corners = self.triangles[t];
            let half = |old: u32| corners.map(|corner| if corner == old { middle } else { corner });
            let new = self.triangles.len() as u32;
            self.triangles[t] = half(b);
            self.triangles.push(half(a));
            let [at_a, at_b] =
                [a, b].map(|end| corners.iter().position(|&corner| corner == end).expect("both ends"));
            for place in self.places.iter_mut().flatten().filter(|place| place.triangle as usize == t) {
                // the middle weighs twice the lesser of the two
                let [near, far] =
                    if place.weights[at_a] >= place.weights[at_b] { [at_a, at_b] } else { [at_b, at_a] };
                let lesser = place.weights[far];
                place.weights[near] -= lesser;
                place.weights[far] = 2.0 * lesser;
                place.triangle = if near == at_a { t as u32 } else { new };
            }
        }
    }
}

fn least(weights: &[f64; 3]) -> f64 {
    weights[0].min(weights[1]).min(weights[2])
}

fn barycentric([a, b, c]: [DVec2; 3], p: DVec2) -> [f64; 3] {
    let area = (b - a).perp_dot(c - a);
    let part = |b: DVec2, c: DVec2| (b - p).perp_dot(c - p) / area;
    [part(b, c), part(c, a), part(a, b)]
}
