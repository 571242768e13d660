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
//! with good corners.

use super::flatten::flattened;
use crate::Control;
use crate::control::Cancelled;
use crate::mesh::rings::{RingMarks, Rings};
use crate::mesh::{Mesh, Quadric};
use glam::{DVec2, DVec3};
use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap};

/// Least valence of a node.
const LEAST_VALENCE: usize = 4;
/// Most, unless it was above before and does not grow.
const MOST_VALENCE: usize = 8;
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

/// A coarse triangulation of a surface with the map of its nodes.
#[derive(Debug, Clone)]
pub(super) struct Base {
    /// The node that each vertex is.
    pub vertices: Vec<u32>,
    /// Three vertices each.
    pub triangles: Vec<[u32; 3]>,
    /// By node; none for a node without triangles.
    pub places: Vec<Option<TrianglePlace>>,
}

/// Collapses edges of a closed mesh until `target` nodes are left, or none can go.
pub(super) fn decimate(mesh: &Mesh, target: usize, control: &mut Control) -> Result<Base, Cancelled> {
    let mut decimation = Decimation::new(mesh);
    let used = (0..mesh.points().len() as u32).filter(|&node| decimation.rings.valence(node) > 0).count();
    let mut left = used;
    loop {
        let before = left;
        decimation.fill();
        while left > target {
            let Some((node, to)) = decimation.next() else { break };
            decimation.collapse(node, to);
            left -= 1;
            if (used - left).is_multiple_of(COLLAPSES_PER_REPORT) {
                control.report((used - left) as f64 / (used - target) as f64, f64::NAN)?;
            }
        }
        // what was refused may have become possible by changes two edges away
        if left <= target || left == before {
            return Ok(decimation.finish());
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

struct Decimation {
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
}

impl Decimation {
    fn new(mesh: &Mesh) -> Self {
        let count = mesh.points().len();
        let bounds = mesh.bounds();
        let middle = DVec3::from_slice(&bounds.min).midpoint(DVec3::from_slice(&bounds.max));
        let points: Vec<DVec3> = mesh.points().iter().map(|&point| point - middle).collect();
        let mut quadrics = vec![Quadric::ZERO; count];
        for triangle in mesh.triangles() {
            let [a, b, c] = triangle.map(|node| points[node as usize]);
            let double_area = (b - a).cross(c - a);
            let plane = Quadric::plane(a, double_area.normalize_or_zero(), 0.5 * double_area.length());
            triangle.iter().for_each(|&node| quadrics[node as usize] = quadrics[node as usize] + plane);
        }
        Self {
            points,
            rings: Rings::new(mesh),
            quadrics,
            is_gone: vec![false; count],
            marks: RingMarks::new(count),
            stamps: vec![0; count],
            queue: BinaryHeap::new(),
            inside: HashMap::new(),
            places: vec![([u32::MAX; 3], [0.0; 3]); count],
        }
    }

    fn present(&self) -> impl Iterator<Item = u32> + '_ {
        let nodes = 0..self.points.len() as u32;
        nodes.filter(|&node| !self.is_gone[node as usize] && self.rings.valence(node) > 0)
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
        let ring = self.rings.of(node);
        self.marks.mark(ring);
        let mut best: Option<(f64, u32)> = None;
        for (k, &to) in ring.iter().enumerate() {
            if self.is_allowed(ring, k) {
                let cost = self.cost(node, ring, k);
                if best.is_none_or(|(least, _)| cost < least) {
                    best = Some((cost, to));
                }
            }
        }
        best
    }

    /// Whether the node with this ring, which is marked, may go on to its neighbour k.
    fn is_allowed(&self, ring: &[u32], k: usize) -> bool {
        let (to, valence) = (ring[k], ring.len());
        let sides = [ring[(k + 1) % valence], ring[(k + valence - 1) % valence]];
        let before = self.rings.valence(to);
        let after = before + valence - 4;
        (LEAST_VALENCE..=MOST_VALENCE.max(before)).contains(&after)
            && sides.iter().all(|&side| self.rings.valence(side) > LEAST_VALENCE)
            && self.marks.count(self.rings.of(to)) == 2
    }

    fn cost(&self, node: u32, ring: &[u32], k: usize) -> f64 {
        let (to, valence) = (ring[k], ring.len());
        let [from, target] = [node, to].map(|node| self.points[node as usize]);
        let height = (self.quadrics[node as usize] + self.quadrics[to as usize]).at(target).max(0.0);
        let length = LENGTH_SHARE * from.distance_squared(target).powi(2);
        let after = (self.rings.valence(to) + valence - 4) as f64;
        let cost = (height + length) * (1.0 + VALENCE_SHARE * (after - 6.0).powi(2));
        let turns_over = (1..valence - 1).any(|j| {
            let [a, b] = [j, j + 1].map(|j| self.points[ring[(k + j) % valence] as usize]);
            let [before, after] = [from, target].map(|apex| (a - apex).cross(b - apex));
            before.dot(after) < LEAST_TURN_COSINE * (before.length_squared() * after.length_squared()).sqrt()
        });
        if turns_over { TURNED_OVER * (cost + length) } else { cost }
    }

    fn collapse(&mut self, node: u32, to: u32) {
        self.rings.collapse(node, to);
        self.is_gone[node as usize] = true;
        self.quadrics[to as usize] = self.quadrics[to as usize] + self.quadrics[node as usize];
        let ring = self.rings.of(node).to_vec();
        self.relocate(node, &ring);
        ring.into_iter().for_each(|other| self.enqueue(other));
    }

    /// Finds `node` and the nodes in the triangles around it again in those that replace them: a fan around the first
    /// of the ring.
    fn relocate(&mut self, node: u32, ring: &[u32]) {
        let count = ring.len();
        let around: Vec<DVec3> = ring.iter().map(|&other| self.points[other as usize]).collect();
        let flat = flattened(self.points[node as usize], &around);
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

    /// Numbers what is left.
    fn finish(self) -> Base {
        let vertices: Vec<u32> = self.present().collect();
        let mut number = vec![u32::MAX; self.points.len()];
        (0..).zip(&vertices).for_each(|(vertex, &node)| number[node as usize] = vertex);
        let mut faces: HashMap<Face, u32> = HashMap::new();
        let mut triangles = Vec::new();
        let mut places = vec![None; self.points.len()];
        for &node in &vertices {
            let ring = self.rings.of(node);
            for (&a, &b) in ring.iter().zip(ring.iter().cycle().skip(1)) {
                if node < a && node < b {
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
            if self.is_gone[node] {
                places[node] = Some(TrianglePlace { triangle: faces[face], weights: *weights });
            }
        }
        Base { vertices, triangles, places }
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
