//! Nearest points of triangle meshes.
//!
//! A binary hierarchy of boxes over the triangles; the closest point of one triangle by its Voronoi regions
//! (C. Ericson, "Real-Time Collision Detection" (2005), section 5.1.5).

use crate::control::Watch;
use crate::memory::{self, CollectVec};
use crate::mesh::Mesh;
use glam::DVec3;
use std::borrow::Borrow;

/// Triangles of a leaf: below that a box costs more than it saves.
const LEAF_SIZE: usize = 4;

/// A hierarchy over the triangles of a mesh, its own or borrowed.
#[derive(Debug, Clone)]
pub struct TriangleTree<M> {
    mesh: M,
    /// Triangles in the order of the leaves.
    order: Vec<u32>,
    nodes: Vec<Node>,
}

/// Triangles `first .. first + count` of the order. The first child follows its parent.
#[derive(Debug, Clone)]
struct Node {
    min: DVec3,
    max: DVec3,
    first: u32,
    count: u32,
    /// The second child; 0 for a leaf.
    second: u32,
}

/// The nearest place of a mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearestTriangle {
    /// The place.
    pub point: DVec3,
    /// Its distance.
    pub distance: f64,
    /// A triangle it lies on.
    pub triangle: u32,
}

impl<M: Borrow<Mesh>> TriangleTree<M> {
    /// Sorts the triangles.
    pub fn new(mesh: M) -> Self {
        Self::watched(mesh, &Watch::default())
    }

    /// The same; what is not sorted when the call is cancelled stays in large leaves.
    pub(crate) fn watched(mesh: M, watch: &Watch) -> Self {
        let order = (0..mesh.borrow().triangles().len() as u32).collect_vec();
        let mut tree = Self { mesh, order, nodes: Vec::new() };
        let middles: Vec<DVec3> =
            (0..tree.order.len()).map(|t| tree.corners(t as u32).iter().sum()).collect_vec();
        if !tree.order.is_empty() {
            tree.add(0, tree.order.len(), &middles, watch);
        }
        tree
    }

    pub(crate) fn corners(&self, triangle: u32) -> [DVec3; 3] {
        let mesh = self.mesh();
        mesh.triangles()[triangle as usize].map(|node| mesh.points()[node as usize])
    }

    /// The mesh.
    pub fn mesh(&self) -> &Mesh {
        self.mesh.borrow()
    }

    fn add(&mut self, first: usize, count: usize, middles: &[DVec3], watch: &Watch) {
        let (mut min, mut max) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (mut least, mut most) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for &t in &self.order[first..first + count] {
            for corner in self.corners(t) {
                (min, max) = (min.min(corner), max.max(corner));
            }
            let middle = middles[t as usize];
            (least, most) = (least.min(middle), most.max(middle));
        }
        let node = self.nodes.len();
        memory::push(&mut self.nodes, Node { min, max, first: first as u32, count: count as u32, second: 0 });
        if count <= LEAF_SIZE || watch.check().is_err() {
            return;
        }
        let axis = (most - least).max_position();
        let half = count / 2;
        self.order[first..first + count].select_nth_unstable_by(half, |&a, &b| {
            let key = |t: u32| middles[t as usize][axis];
            key(a).total_cmp(&key(b)).then(a.cmp(&b))
        });
        self.add(first, half, middles, watch);
        self.nodes[node].second = self.nodes.len() as u32;
        self.add(first + half, count - half, middles, watch);
    }

    /// Calls `visit` with the triangles that may meet one with these corners: those whose leaf's box meets its box.
    pub(super) fn for_each_near(&self, corners: [DVec3; 3], visit: impl FnMut(u32)) {
        let [a, b, c] = corners;
        self.for_each_in_box(a.min(b).min(c), a.max(b).max(c), visit);
    }

    /// The triangles below each branch of the hierarchy.
    pub(crate) fn branches(&self) -> impl Iterator<Item = &[u32]> {
        self.nodes.iter().map(|node| self.below(node))
    }

    fn below(&self, node: &Node) -> &[u32] {
        &self.order[node.first as usize..(node.first + node.count) as usize]
    }

    /// Calls `visit` with the triangles that may meet a box: those whose leaf's box does.
    fn for_each_in_box(&self, min: DVec3, max: DVec3, visit: impl FnMut(u32)) {
        self.for_each_in_box_of(|_| true, min, max, visit);
    }

    /// The same, of the branches that are wanted alone; by their number.
    pub(crate) fn for_each_in_box_of(
        &self,
        is_wanted: impl Fn(usize) -> bool,
        min: DVec3,
        max: DVec3,
        mut visit: impl FnMut(u32),
    ) {
        let mut stack = vec![0];
        while let Some(at) = stack.pop() {
            let Some(node) = self.nodes.get(at) else { continue };
            if node.min.cmpgt(max).any() || node.max.cmplt(min).any() || !is_wanted(at) {
                continue;
            }
            if node.second == 0 {
                self.below(node).iter().for_each(|&triangle| visit(triangle));
            } else {
                stack.extend([at + 1, node.second as usize]);
            }
        }
    }

    /// The place of the mesh nearest to a point; None for a mesh without triangles.
    pub fn nearest(&self, point: DVec3) -> Option<NearestTriangle> {
        let mut best = NearestTriangle { point: DVec3::NAN, distance: f64::INFINITY, triangle: 0 };
        let mut stack = memory::with_capacity(64);
        stack.extend(self.nodes.first().map(|root| (root.distance(point), 0)));
        while let Some((bound, at)) = stack.pop() {
            if bound >= best.distance {
                continue;
            }
            let node = &self.nodes[at];
            if node.second == 0 {
                for &triangle in self.below(node) {
                    let place = nearest_on_triangle(point, self.corners(triangle));
                    let distance = place.distance(point);
                    if distance < best.distance {
                        best = NearestTriangle { point: place, distance, triangle };
                    }
                }
            } else {
                let children = [at + 1, node.second as usize].map(|k| (self.nodes[k].distance(point), k));
                let [near, far] = if children[0].0 <= children[1].0 { [0, 1] } else { [1, 0] };
                stack.extend([children[far], children[near]]);
            }
        }
        best.distance.is_finite().then_some(best)
    }
}

impl Node {
    fn distance(&self, point: DVec3) -> f64 {
        (self.min - point).max(point - self.max).max(DVec3::ZERO).length()
    }
}

/// The place of a triangle nearest to a point; degenerate triangles are lines or points.
pub fn nearest_on_triangle(p: DVec3, [a, b, c]: [DVec3; 3]) -> DVec3 {
    let (ab, ac, normal) = (b - a, c - a, (b - a).cross(c - a));
    let area_sq = normal.length_squared();
    if area_sq > 0.0 {
        // barycentric coordinates of the foot point on the plane
        let r = p - a;
        let v = r.cross(ac).dot(normal) / area_sq;
        let w = ab.cross(r).dot(normal) / area_sq;
        if v >= 0.0 && w >= 0.0 && v + w <= 1.0 {
            return a + v * ab + w * ac;
        }
    }
    let places = [(a, b), (b, c), (c, a)].map(|(from, to)| nearest_on_segment(p, from, to));
    let nearer = |x: DVec3, y: DVec3| if y.distance_squared(p) < x.distance_squared(p) { y } else { x };
    nearer(nearer(places[0], places[1]), places[2])
}

fn nearest_on_segment(p: DVec3, from: DVec3, to: DVec3) -> DVec3 {
    let along = to - from;
    let length_sq = along.length_squared();
    let t = if length_sq > 0.0 { ((p - from).dot(along) / length_sq).clamp(0.0, 1.0) } else { 0.0 };
    from + t * along
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::{Random, bumps};

    #[test]
    fn the_tree_finds_what_a_linear_search_finds() {
        let (mesh, _) = bumps([20, 20], 8, 1).unwrap();
        let tree = TriangleTree::new(&mesh);
        let mut random = Random::new(4);
        for _ in 0..200 {
            let p = DVec3::new(random.signed(), random.signed(), random.signed()) * 2.0;
            let all = (0..mesh.triangles().len() as u32).map(|t| nearest_on_triangle(p, tree.corners(t)));
            let linear = all.map(|q| q.distance(p)).fold(f64::INFINITY, f64::min);
            let found = tree.nearest(p).unwrap();
            assert_eq!(found.distance, linear);
            assert_eq!(nearest_on_triangle(p, tree.corners(found.triangle)), found.point);
        }
    }

    #[test]
    fn flat_triangles_are_lines() {
        let triangle = [DVec3::ZERO, DVec3::X, 3.0 * DVec3::X];
        assert_eq!(nearest_on_triangle(DVec3::new(2.0, 1.0, 0.0), triangle), 2.0 * DVec3::X);
        assert_eq!(nearest_on_triangle(DVec3::Y, [DVec3::Z; 3]), DVec3::Z);
    }
}
