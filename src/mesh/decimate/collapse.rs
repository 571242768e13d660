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
    /// Around the middle of the box, where quadrics keep their digits.
    points: Vec<DVec3>,
    /// The parameters, and the side that triangles show there.
    map: Option<(&'a [DVec2], Orientation)>,
    /// None: vanished.
    triangles: Vec<Option<[u32; 3]>>,
    /// By node: its triangles, and some that have vanished.
    around: Vec<Vec<u32>>,
    /// By node: its triangles that have not; none when it is gone.
    live: Vec<u32>,
    quadrics: Vec<Quadric>,
    /// By node: area around it when the mesh was whole, with that of the nodes collapsed onto it.
    areas: Vec<f64>,
    features: Features,
}

/// A node and what is around it, for all its collapses.
pub(super) struct Star {
    node: u32,
    /// The nodes joined to it by edges, in increasing order.
    beside: Vec<u32>,
    /// The least shape of its triangles, [`LEAST_SHAPE`] at most.
    worst: f64,
}

impl<'a> Collapsing<'a> {
    pub(super) fn new(
        points: Vec<DVec3>,
        triangles: &[[u32; 3]],
        map: Option<(&'a [DVec2], Orientation)>,
        features: Features,
        watch: &Watch,
    ) -> Result<Self, Cancelled> {
        let mut around = memory::filled(Vec::new(), points.len());
        let mut quadrics = memory::filled(Quadric::ZERO, points.len());
        let mut areas = memory::filled(0.0, points.len());
        for (t, triangle) in triangles.iter().enumerate() {
            watch.check_at(t)?;
            let double_area = normal(&points, triangle);
            let (unit, area) = (double_area.normalize_or_zero(), 0.5 * double_area.length());
            let plane = Quadric::plane(points[triangle[0] as usize], unit, area);
            for node in triangle.map(|node| node as usize) {
                memory::push(&mut around[node], t as u32);
                quadrics[node] = quadrics[node] + plane;
                areas[node] += area;
            }
            for (from, to) in edges(triangle) {
                if features.neighbours[from as usize].contains(&to) {
                    let [a, b] = [from, to].map(|node| points[node as usize]);
                    let across = (b - a).cross(unit).normalize_or_zero();
                    let plane = Quadric::plane(a, across, FEATURE_WEIGHT * (b - a).length_squared());
                    for node in [from as usize, to as usize] {
                        quadrics[node] = quadrics[node] + plane;
                    }
                }
            }
        }
        let triangles = triangles.iter().copied().map(Some).collect_vec();
        let live = around.iter().map(|triangles| triangles.len() as u32).collect_vec();
        Ok(Self { points, map, triangles, around, live, quadrics, areas, features })
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

    pub(super) fn is_present(&self, node: u32) -> bool {
        self.live[node as usize] > 0
    }

    /// Whether a node has so many triangles that going through them again and again would take too long.
    pub(super) fn is_hub(&self, node: u32) -> bool {
        self.live[node as usize] > HUB
    }

    /// Nodes joined to a node by edges, in increasing order.
    pub(super) fn neighbours(&self, node: u32) -> Vec<u32> {
        // two of each triangle
        let mut nodes = memory::with_capacity(2 * self.live[node as usize] as usize);
        memory::extend(&mut nodes, self.fan(node).flat_map(|(_, triangle)| triangle).filter(|&n| n != node));
        nodes.sort_unstable();
        nodes.dedup();
        nodes
    }

    /// A node and what is around it.
    pub(super) fn star(&self, node: u32) -> Star {
        let shapes = self.fan(node).map(|(_, triangle)| self.shape(&triangle));
        Star { node, beside: self.neighbours(node), worst: shapes.fold(LEAST_SHAPE, f64::min) }
    }

    /// The nodes that a node, which is no hub, may be collapsed onto, as far as features have a say.
    pub(super) fn targets<'s>(&'s self, star: &'s Star) -> &'s [u32] {
        match self.features.roles[star.node as usize] {
            Role::Corner => &[],
            Role::Chain => &self.features.neighbours[star.node as usize],
            Role::Smooth => &star.beside,
        }
    }

    /// What it costs to collapse `from` onto `to`.
    pub(super) fn cost(&self, from: u32, to: u32) -> f64 {
        let [u, v] = [from as usize, to as usize];
        let height = (self.quadrics[u] + self.quadrics[v]).at(self.points[v]).max(0.0);
        height + LENGTH_SHARE * self.areas[u] * self.points[u].distance_squared(self.points[v])
    }

    /// Whether the collapse of a star's node keeps topology, features and well-shaped triangles.
    pub(super) fn may_collapse(&self, star: &Star, to: u32) -> bool {
        self.keeps_topology(star, to) && self.keeps_shapes(star, to)
    }

    /// The link condition.
    fn keeps_topology(&self, star: &Star, to: u32) -> bool {
        let from = star.node;
        let are_joined =
            |a: u32, b: u32| self.smaller_fan(&[a, b]).any(|other| other.contains(&a) && other.contains(&b));
        let beside = star.beside.iter().copied();
        let common: Vec<u32> = beside.filter(|&node| node != to && are_joined(node, to)).collect_vec();
        let at_edge = self.fan(from).filter(|(_, triangle)| triangle.contains(&to)).count();
        // one triangle less on both sides of the edge, or chains would lie upon one another
        let is_feature = |a: u32, b: u32| self.features.neighbours[a as usize].contains(&b);
        let merges_chains = common.iter().any(|&node| is_feature(from, node) && is_feature(to, node));
        // links share an edge where both nodes have a triangle over it
        let doubles_triangle = self.fan(from).any(|(_, triangle)| {
            let over_edge = triangle.map(|node| if node == from { to } else { node });
            !triangle.contains(&to)
                && triangle.iter().all(|node| *node == from || common.contains(node))
                && self.smaller_fan(&over_edge).any(|other| over_edge.iter().all(|node| other.contains(node)))
        });
        common.len() == at_edge && !merges_chains && !doubles_triangle
    }

    /// Whether the triangles that follow the node keep their sides, and are no slivers.
    fn keeps_shapes(&self, star: &Star, to: u32) -> bool {
        let from = star.node;
        let replaced = |triangle: [u32; 3]| triangle.map(|node| if node == from { to } else { node });
        let moved = self.fan(from).filter(|(_, triangle)| !triangle.contains(&to));
        moved.map(|(_, triangle)| (triangle, replaced(triangle))).all(|(old, new)| {
            let [before, after] = [old, new].map(|triangle| normal(&self.points, &triangle));
            let least = LEAST_TURN_COSINE * before.length() * after.length();
            after != DVec3::ZERO
                && before.dot(after) >= least
                && self.shows_side(&new)
                && self.shape(&new) >= star.worst
        })
    }

    /// Whether a triangle shows its side in the parameter plane, exactly; true without parameters.
    fn shows_side(&self, triangle: &[u32; 3]) -> bool {
        self.map.is_none_or(|(uv, side)| {
            let [a, b, c] = triangle.map(|node| uv[node as usize]);
            orientation(a, b, c) == side
        })
    }

    /// 1 for an equilateral triangle, 0 for a flat one; the lesser of space and parameter plane.
    fn shape(&self, triangle: &[u32; 3]) -> f64 {
        let in_space = shape(triangle.map(|node| self.points[node as usize]));
        let in_plane = |(uv, _): (&[DVec2], _)| shape(triangle.map(|node| uv[node as usize].extend(0.0)));
        self.map.map_or(in_space, |map| in_space.min(in_plane(map)))
    }

    /// Moves `from` onto `to`.
    pub(super) fn collapse(&mut self, from: u32, to: u32) {
        let [u, v] = [from as usize, to as usize];
        for t in std::mem::take(&mut self.around[u]) {
            let Some(triangle) = &mut self.triangles[t as usize] else { continue };
            if triangle.contains(&to) {
                let nodes = *triangle;
                self.triangles[t as usize] = None;
                nodes.into_iter().for_each(|node| self.forget_one(node));
            } else {
                triangle.iter_mut().filter(|node| **node == from).for_each(|node| *node = to);
                memory::push(&mut self.around[v], t);
                self.live[v] += 1;
            }
        }
        self.live[u] = 0;
        self.quadrics[v] = self.quadrics[u] + self.quadrics[v];
        self.areas[v] += self.areas[u];
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
        let (live, around) = (&mut self.live[node as usize], &mut self.around[node as usize]);
        *live -= 1;
        if around.len() > 2 * *live as usize + 8 {
            around.retain(|&t| self.triangles[t as usize].is_some());
        }
    }

    /// The triangles of that of some nodes which has the fewest.
    fn smaller_fan(&self, nodes: &[u32]) -> impl Iterator<Item = [u32; 3]> + '_ {
        let node = nodes.iter().copied().min_by_key(|&node| self.live[node as usize]);
        node.into_iter().flat_map(move |node| self.fan(node).map(|(_, triangle)| triangle))
    }

    fn fan(&self, node: u32) -> impl Iterator<Item = (u32, [u32; 3])> + '_ {
        let present = |&t: &u32| self.triangles[t as usize].map(|triangle| (t, triangle));
        self.around[node as usize].iter().filter_map(present)
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
