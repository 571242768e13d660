//! The mesh as the map sees it: holes closed by fans, neighbours listed, fixed nodes known.
//!
//! Every loop but the border gets one node at its centroid and a fan of
//! triangles. Weights and stretch use the fans; they are never returned.

use super::ParameterizeError;
use crate::lists::Lists;
use crate::memory::{self, CollectVec};
use crate::mesh::{Mesh, close_loop, loop_edges};
use glam::DVec3;
use std::cmp::Ordering;

/// No unknown: the node is fixed.
pub(super) const FIXED: u32 = u32::MAX;

/// Who is next to whom; the neighbours of each node ascend. A *slot* is an index into all of them.
#[derive(Debug, Clone)]
pub(super) struct Neighbours(Lists);

impl Neighbours {
    /// From half-edges and the reverses of those without a partner.
    pub(super) fn new(node_count: usize, triangles: &[[u32; 3]], open_edges: &[[u32; 2]]) -> Self {
        let inner = triangles.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
        let half_edges = inner.chain(open_edges.iter().map(|&[a, b]| (b, a)));
        let mut lists = Lists::new(node_count, half_edges);
        (0..node_count).for_each(|node| lists.of_mut(node).sort_unstable());
        Self(lists)
    }

    pub(super) fn slots(&self, node: usize) -> std::ops::Range<usize> {
        self.0.range(node)
    }

    pub(super) fn of(&self, node: usize) -> &[u32] {
        self.0.of(node)
    }

    /// The neighbour in each slot.
    pub(super) fn nodes(&self) -> &[u32] {
        self.0.items()
    }

    /// The slot of `to` in the list of `from`; they are neighbours.
    pub(super) fn slot(&self, from: u32, to: u32) -> usize {
        let list = self.of(from as usize);
        let place = match list.len() {
            0..=16 => list.iter().position(|&node| node == to).unwrap_or(0),
            _ => list.partition_point(|&node| node < to),
        };
        self.slots(from as usize).start + place
    }
}

/// A disk of triangles with its fixed nodes.
#[derive(Debug, Clone)]
pub(super) struct Patch {
    /// Nodes of the mesh, then one for each filled hole.
    pub points: Vec<DVec3>,
    /// Triangles of the mesh, then the fans.
    pub triangles: Vec<[u32; 3]>,
    /// Nodes and triangles that belong to the mesh.
    pub mesh_node_count: usize,
    pub mesh_triangle_count: usize,
    pub neighbours: Neighbours,
    /// The number of each node among the unknowns, or [`FIXED`].
    pub unknown: Vec<u32>,
    /// The node of each unknown.
    pub nodes: Vec<u32>,
}

/// What happens at the boundary loops.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Holes {
    /// The longest loop is fixed, fans close the others.
    Filled,
    /// The longest loop is fixed, the others are free.
    Open,
    /// All loops are fixed.
    Fixed,
}

impl Patch {
    pub(super) fn new(mesh: &Mesh, holes: Holes) -> Self {
        let (mut points, mut triangles) = (memory::copied(mesh.points()), memory::copied(mesh.triangles()));
        let loops = mesh.loops();
        let outer = outer_loop(mesh);
        let (outer, inner): (Vec<&Vec<u32>>, Vec<&Vec<u32>>) = match outer {
            Some(outer) => {
                let inner = loops.iter().enumerate().filter(|&(k, _)| k != outer);
                (vec![&loops[outer]], inner.map(|(_, nodes)| nodes).collect_vec())
            }
            None => (Vec::new(), Vec::new()),
        };
        let all = [outer.clone(), inner.clone()].concat();
        let (open, fixed) = match holes {
            Holes::Filled => {
                inner.iter().for_each(|hole| close_loop(hole, &mut points, &mut triangles));
                (outer.clone(), outer)
            }
            Holes::Open => (all, outer),
            Holes::Fixed => (all.clone(), all),
        };
        let open_edges: Vec<[u32; 2]> = open.iter().flat_map(|nodes| loop_edges(nodes)).collect_vec();
        let neighbours = Neighbours::new(points.len(), &triangles, &open_edges);
        let mut is_fixed: Vec<bool> = (0..points.len()).map(|i| neighbours.slots(i).is_empty()).collect_vec();
        fixed.iter().copied().flatten().for_each(|&node| is_fixed[node as usize] = true);
        let nodes: Vec<u32> = (0..points.len() as u32).filter(|&i| !is_fixed[i as usize]).collect_vec();
        let mut unknown = memory::filled(FIXED, points.len());
        nodes.iter().enumerate().for_each(|(k, &node)| unknown[node as usize] = k as u32);
        Self {
            mesh_node_count: mesh.points().len(),
            mesh_triangle_count: mesh.triangles().len(),
            points,
            triangles,
            neighbours,
            unknown,
            nodes,
        }
    }

    pub(super) fn is_fixed(&self, node: u32) -> bool {
        self.unknown[node as usize] == FIXED
    }

    /// Whether a map can change the triangle's shape.
    pub(super) fn is_movable(&self, triangle: &[u32; 3]) -> bool {
        !triangle.iter().all(|&node| self.is_fixed(node))
    }
}

/// Loops whose lengths differ by no more than this share are equally long but for rounding.
const SAME_LENGTH: f64 = 1e-9;

/// The loop that becomes the border of the map: the longest; of equally long ones the one with the first landmark,
/// so that it is the same one however nodes are numbered.
pub(super) fn outer_loop(mesh: &Mesh) -> Option<usize> {
    let place = |node: u32| mesh.points()[node as usize];
    let length = |nodes: &Vec<u32>| loop_edges(nodes).map(|[a, b]| place(a).distance(place(b))).sum::<f64>();
    let lengths: Vec<f64> = mesh.loops().iter().map(length).collect_vec();
    let longest = lengths.iter().copied().fold(0.0, f64::max);
    let first = |k: usize| place(mesh.loops()[k][landmark(mesh, &mesh.loops()[k])]);
    (0..lengths.len())
        .filter(|&k| lengths[k] >= (1.0 - SAME_LENGTH) * longest)
        .min_by(|&a, &b| in_space_order(&first(a), &first(b)))
}

/// Where in a loop the node with the least x, of these the least y and z, stands: a place to begin that does not
/// depend on the numbers of nodes.
pub(super) fn landmark(mesh: &Mesh, nodes: &[u32]) -> usize {
    let place = |k: &usize| &mesh.points()[nodes[*k] as usize];
    (0..nodes.len()).min_by(|a, b| in_space_order(place(a), place(b))).unwrap_or(0)
}

fn in_space_order(a: &DVec3, b: &DVec3) -> Ordering {
    a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)).then(a.z.total_cmp(&b.z))
}

/// Refuses what is no disk, naming what is in the way.
pub(super) fn check_disk(mesh: &Mesh) -> Result<(), ParameterizeError> {
    if mesh.loops().is_empty() {
        return Err(ParameterizeError::Closed);
    }
    if mesh.component_count() > 1 {
        return Err(ParameterizeError::Components { count: mesh.component_count() });
    }
    if let Some(&node) = mesh.pinched_nodes().first() {
        return Err(ParameterizeError::Pinched { node: node as usize });
    }
    match mesh.genus() {
        0 => Ok(()),
        genus => Err(ParameterizeError::Genus { genus }),
    }
}
