//! A mesh whose edges collapse.
//!
//! T. Dey, H. Edelsbrunner, S. Guha, D. Nekhayev, "Topology preserving edge contraction", Publ. Inst. Math. 66
//! (1999), 23-45: collapsing the edge uv keeps the topology if the links meet in nothing more than they must,
//! ```text
//! Lk u  intersect  Lk v  =  Lk uv
//! ```
//! where the boundary counts as joined to one more node. The half-edge collapse moves u onto v:
//! ```text
//!       a                  a
//!     / | \                | \      the triangles at uv vanish, the others of u go to v;
//!    x--u--v--y    ->   x--v--y     u's edges to a and b become those of v
//!     \ | /                | /
//!       b                  b
//! ```

use super::features::{Features, Role, normal};
use super::quadric::Quadric;
use crate::control::{Cancelled, Watch};
use crate::geometry::{Orientation, orientation};
use crate::memory::{self, CollectVec};
use crate::mesh::priced::Priced;
use glam::{DVec2, DVec3};

/// Cosine of the largest angle by which one collapse may turn a triangle: 60 degrees. Half turns would fold
/// the mesh, and small angles stop it on round shapes long before it is coarse.
const LEAST_TURN_COSINE: f64 = 0.5;
/// A triangle below this shape (1 if equilateral) may only replace worse ones: no angle then exceeds 140 degrees.
/// With half of it a sphere of 300 nodes had triangles that lay 0.13 deep.
const LEAST_SHAPE: f64 = 0.4;
/// Planes across feature edges weigh this much against those of triangles of the same size: chains keep their
/// place in the tangent plane about three times as well as the surface keeps its height.
const FEATURE_WEIGHT: f64 = 10.0;
/// Share of the squared edge length in the cost, against the squared height of the planes: where all is flat,
/// short edges go first. A hundred times more would thin out bends like plains.
const LENGTH_SHARE: f64 = 1e-5;

/// A node with more triangles, as the tip of a cone has, is a hub: others are collapsed onto it, but it stays, and a
/// collapse beside it is not followed all around it, so that a hub of many neighbours costs no more than others do.
/// Nodes of scans and parts have some ten triangles.
const HUB: u32 = 64;

/// The mesh in its present state.
pub(super) struct Collapsing<'a> {
    nodes: Vec<Node>,
    /// The parameters, and the side that triangles show there.
    map: Option<(&'a [DVec2], Orientation)>,
    /// None: vanished.
    triangles: Vec<Option<[u32; 3]>>,
    features: Features,
}

/// All that is known of a node in one place: collapses come to nodes in no order, and what lies apart is fetched apart.
// what others ask of it is in its first cache line
#[derive(Clone)]
#[repr(C, align(64))]
struct Node {
    /// Around the middle of the box, where quadrics keep their digits.
    point: DVec3,
    /// The quadric at the point.
    height: f64,
    /// Its triangles, and some that have vanished.
    around: Vec<u32>,
    /// Its triangles that have not; none when it is gone.
    live: u32,
    /// Area around it when the mesh was whole, with that of the nodes collapsed onto it.
    area: f64,
    quadric: Quadric,
}

impl Node {
    fn at(point: DVec3) -> Self {
        Self { point, height: 0.0, area: 0.0, quadric: Quadric::ZERO, around: Vec::new(), live: 0 }
    }
}

impl<'a> Collapsing<'a> {
    pub(super) fn new(
        points: &[DVec3],
        triangles: &[[u32; 3]],
        map: Option<(&'a [DVec2], Orientation)>,
        features: Features,
        watch: &Watch,
    ) -> Result<Self, Cancelled> {
        let mut nodes = memory::with_capacity(points.len());
        for (number, &point) in points.iter().enumerate() {
            watch.check_at(number)?;
            memory::push(&mut nodes, Node::at(point));
        }
        for (t, triangle) in triangles.iter().enumerate() {
            watch.check_at(t)?;
            let double_area = normal(points, triangle);
            let (unit, area) = (double_area.normalize_or_zero(), 0.5 * double_area.length());
            let plane = Quadric::plane(points[triangle[0] as usize], unit, area);
            for node in triangle.map(|node| node as usize) {
                let node = &mut nodes[node];
                memory::push(&mut node.around, t as u32);
                node.live += 1;
                node.quadric = node.quadric + plane;
                node.area += area;
            }
            for (from, to) in edges(triangle) {
                if features.neighbours[from as usize].contains(&to) {
                    let [a, b] = [from, to].map(|node| points[node as usize]);
                    let across = (b - a).cross(unit).normalize_or_zero();
                    let plane = Quadric::plane(a, across, FEATURE_WEIGHT * (b - a).length_squared());
                    for node in [from as usize, to as usize] {
                        nodes[node].quadric = nodes[node].quadric + plane;
                    }
                }
            }
        }
        for (number, node) in nodes.iter_mut().enumerate() {
            watch.check_at(number)?;
            node.height = node.quadric.at(node.point);
        }
        let triangles = triangles.iter().copied().map(Some).collect_vec();
        Ok(Self { nodes, map, triangles, features })
    }

    /// The triangles that are left, with their numbers.
    pub(super) fn triangles(&self) -> impl Iterator<Item = (u32, [u32; 3])> + '_ {
        (0..).zip(&self.triangles).filter_map(|(number, triangle)| Some((number, (*triangle)?)))
    }

    /// The feature edges that are left, each once.
    pub(super) fn feature_edges(&self) -> impl Iterator<Item = [u32; 2]> + '_ {
        let chains = self.features.neighbours.iter().zip(0..);
        chains.flat_map(|(ends, from)| ends.iter().filter(move |&&to| from < to).map(move |&to| [from, to]))
    }

    /// Whether a node has so many triangles that going through them again and again would take too long.
    pub(super) fn is_hub(&self, node: u32) -> bool {
        self.nodes[node as usize].live > HUB
    }

    /// Nodes joined to a node by edges, in increasing order.
    pub(super) fn neighbours(&self, node: u32) -> Vec<u32> {
        // two of each triangle
        let mut nodes = memory::with_capacity(2 * self.nodes[node as usize].live as usize);
        memory::extend(&mut nodes, self.fan(node).flat_map(|(_, triangle)| triangle).filter(|&n| n != node));
        nodes.sort_unstable();
        nodes.dedup();
        nodes
    }

    /// The nodes that a node may be collapsed onto as far as features have a say. Hubs have none, nor have nodes that are
    /// gone.
    pub(super) fn targets_of(&self, from: u32, targets: &mut Vec<Priced>) {
        targets.clear();
        let target = |node: u32| Priced { cost: self.cost(from, node), node };
        match self.features.roles[from as usize] {
            _ if self.is_hub(from) => {}
            Role::Corner => {}
            Role::Chain => {
                memory::extend(targets, self.features.neighbours[from as usize].iter().map(|&to| target(to)));
            }
            // inside the surface each neighbour comes after the node in one triangle
            Role::Smooth => {
                memory::extend(targets, self.fan(from).map(|(_, nodes)| target(after(from, nodes))));
            }
        }
    }

    /// What it costs to collapse `from` onto a neighbour; infinite if features have a say against it.
    pub(super) fn cost_if_target(&self, from: u32, to: u32) -> f64 {
        let chain = &self.features.neighbours[from as usize];
        match self.features.roles[from as usize] {
            _ if self.is_hub(from) => f64::INFINITY,
            Role::Smooth => self.cost(from, to),
            Role::Chain if chain.contains(&to) => self.cost(from, to),
            Role::Corner | Role::Chain => f64::INFINITY,
        }
    }

    /// What it costs to collapse `from` onto `to`.
    fn cost(&self, from: u32, to: u32) -> f64 {
        let [u, v] = [from, to].map(|node| &self.nodes[node as usize]);
        let height = (u.quadric.at(v.point) + v.height).max(0.0);
        height + LENGTH_SHARE * u.area * u.point.distance_squared(v.point)
    }

    /// Whether a collapse keeps well-shaped triangles, topology and features.
    pub(super) fn may_collapse(&self, from: u32, to: u32) -> bool {
        self.keeps_shapes(from, to) && self.keeps_topology(from, to)
    }

    /// The link condition.
    fn keeps_topology(&self, from: u32, to: u32) -> bool {
        let is_joined =
            |node: u32| self.short_fan(&[to, node]).any(|other| other.contains(&to) && other.contains(&node));
        let mut common = self.neighbours(from);
        common.retain(|&node| node != to && is_joined(node));
        let at_edge = self.fan(from).filter(|(_, triangle)| triangle.contains(&to)).count();
        // one triangle less on both sides of the edge, or chains would lie upon one another
        let is_feature = |a: u32, b: u32| self.features.neighbours[a as usize].contains(&b);
        let merges_chains = common.iter().any(|&node| is_feature(from, node) && is_feature(to, node));
        // links share an edge where both nodes have a triangle over it
        let doubles_triangle = self.fan(from).any(|(_, triangle)| {
            let over_edge = replaced(triangle, from, to);
            !triangle.contains(&to)
                && triangle.iter().all(|node| *node == from || common.contains(node))
                && self.short_fan(&over_edge).any(|other| over_edge.iter().all(|node| other.contains(node)))
        });
        common.len() == at_edge && !merges_chains && !doubles_triangle
    }

    /// Whether the triangles that follow the node keep their sides, and are no slivers.
    fn keeps_shapes(&self, from: u32, to: u32) -> bool {
        let mut moved = self.fan(from).map(|(_, triangle)| triangle).filter(|nodes| !nodes.contains(&to));
        moved.all(|old| {
            let new = replaced(old, from, to);
            let [before, after] = [old, new].map(|triangle| self.normal(triangle));
            let least = LEAST_TURN_COSINE * before.length() * after.length();
            after != DVec3::ZERO
                && before.dot(after) >= least
                && self.shows_side(&new)
                && self.is_fit(&new, from)
        })
    }

    /// Whether a triangle is no sliver, or no worse than one around the node that it is to replace.
    fn is_fit(&self, new: &[u32; 3], from: u32) -> bool {
        let shape = self.shape(new);
        shape >= LEAST_SHAPE || self.fan(from).any(|(_, triangle)| shape >= self.shape(&triangle))
    }

    /// Whether a triangle shows its side in the parameter plane, exactly; true without parameters.
    fn shows_side(&self, triangle: &[u32; 3]) -> bool {
        self.map.is_none_or(|(uv, side)| {
            let [a, b, c] = triangle.map(|node| uv[node as usize]);
            orientation(a, b, c) == side
        })
    }

    /// Normal times twice the area.
    fn normal(&self, triangle: [u32; 3]) -> DVec3 {
        let [a, b, c] = triangle.map(|node| self.nodes[node as usize].point);
        (b - a).cross(c - a)
    }

    /// 1 for an equilateral triangle, 0 for a flat one; the lesser of space and parameter plane.
    fn shape(&self, triangle: &[u32; 3]) -> f64 {
        let in_space = shape(triangle.map(|node| self.nodes[node as usize].point));
        let in_plane = |(uv, _): (&[DVec2], _)| shape(triangle.map(|node| uv[node as usize].extend(0.0)));
        self.map.map_or(in_space, |map| in_space.min(in_plane(map)))
    }

    /// Moves `from` onto `to`.
    pub(super) fn collapse(&mut self, from: u32, to: u32) {
        let [u, v] = [from as usize, to as usize];
        for t in std::mem::take(&mut self.nodes[u].around) {
            let Some(triangle) = &mut self.triangles[t as usize] else { continue };
            if triangle.contains(&to) {
                let nodes = *triangle;
                self.triangles[t as usize] = None;
                nodes.into_iter().for_each(|node| self.forget_one(node));
            } else {
                *triangle = replaced(*triangle, from, to);
                memory::push(&mut self.nodes[v].around, t);
                self.nodes[v].live += 1;
            }
        }
        self.nodes[u].live = 0;
        let (quadric, area) = (self.nodes[u].quadric, self.nodes[u].area);
        let left = &mut self.nodes[v];
        left.quadric = quadric + left.quadric;
        left.height = left.quadric.at(left.point);
        left.area += area;
        for end in std::mem::take(&mut self.features.neighbours[u]) {
            let ends = &mut self.features.neighbours[end as usize];
            if end == to {
                ends.retain(|&node| node != from);
            } else {
                ends.iter_mut().filter(|node| **node == from).for_each(|node| *node = to);
                memory::push(&mut self.features.neighbours[v], end);
            }
        }
    }

    /// Counts a triangle of a node that has vanished; when they are many, their numbers go.
    fn forget_one(&mut self, node: u32) {
        let node = &mut self.nodes[node as usize];
        node.live -= 1;
        if node.around.len() > 2 * node.live as usize + 8 {
            node.around.retain(|&t| self.triangles[t as usize].is_some());
        }
    }

    /// The triangles of the first of some nodes that is no hub, or else of the one that has the fewest.
    fn short_fan(&self, nodes: &[u32]) -> impl Iterator<Item = [u32; 3]> + '_ {
        let nodes = nodes.iter().copied();
        let short = nodes.clone().find(|&node| !self.is_hub(node));
        let node = short.or_else(|| nodes.min_by_key(|&node| self.nodes[node as usize].live));
        node.into_iter().flat_map(move |node| self.fan(node).map(|(_, triangle)| triangle))
    }

    fn fan(&self, node: u32) -> impl Iterator<Item = (u32, [u32; 3])> + '_ {
        let present = |&t: &u32| self.triangles[t as usize].map(|triangle| (t, triangle));
        self.nodes[node as usize].around.iter().filter_map(present)
    }
}

/// A triangle with one node in place of another.
fn replaced(triangle: [u32; 3], from: u32, to: u32) -> [u32; 3] {
    triangle.map(|node| if node == from { to } else { node })
}

/// The node after one of a triangle's nodes.
fn after(node: u32, [a, b, c]: [u32; 3]) -> u32 {
    if node == a {
        b
    } else if node == b {
        c
    } else {
        a
    }
}

fn edges(&[a, b, c]: &[u32; 3]) -> [(u32, u32); 3] {
    [(a, b), (b, c), (c, a)]
}

/// `4 sqrt(3) area / sum of squared sides`.
fn shape([a, b, c]: [DVec3; 3]) -> f64 {
    let squares = a.distance_squared(b) + b.distance_squared(c) + c.distance_squared(a);
    2.0 * 3.0_f64.sqrt() * (b - a).cross(c - a).length() / squares.max(f64::MIN_POSITIVE)
}
