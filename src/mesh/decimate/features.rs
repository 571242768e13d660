//! Which edges and nodes must survive.
//!
//! Feature edges are the boundary and the sharp edges. Their nodes lie on *chains*:
//! ```text
//!   c --- x --- x --- c     x: two feature edges that hardly turn; may be collapsed along the chain
//!          \  /             c: an end, a junction, or a turn: stays
//!           s               s: no feature edge; may be collapsed onto any neighbour
//! ```

use super::{DecimateError, DecimateOptions};
use crate::control::Watch;
use crate::memory::{self, CollectVec};
use crate::mesh::{HalfEdge, Mesh};
use glam::{DVec2, DVec3};

/// What may happen to a node.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    /// It stays.
    Corner,
    /// It may be collapsed onto a neighbour in its chain.
    Chain,
    /// It may be collapsed onto any neighbour.
    Smooth,
}

/// Boundary and sharp edges, and what they make of nodes.
pub(super) struct Features {
    /// By node: the other ends of its feature edges.
    pub neighbours: Vec<Vec<u32>>,
    /// By node.
    pub roles: Vec<Role>,
}

impl Features {
    pub(super) fn of(mesh: &Mesh, options: &DecimateOptions, watch: &Watch) -> Result<Self, DecimateError> {
        let is_sharp = sharp_edges(mesh, options)?;
        let mut neighbours = memory::filled(Vec::new(), mesh.points().len());
        for (edge, &is_sharp) in half_edges(mesh).zip(&is_sharp) {
            watch.check_at(edge.index())?;
            let is_boundary = mesh.topology().twin(edge).is_none();
            let [from, to] = [edge.origin(mesh.triangles()), edge.target(mesh.triangles())];
            if is_boundary || (is_sharp && from < to) {
                memory::push(&mut neighbours[from as usize], to);
                memory::push(&mut neighbours[to as usize], from);
            }
        }
        let mut roles: Vec<Role> = neighbours
            .iter()
            .enumerate()
            .map(|(node, chain)| match chain[..] {
                [] => Role::Smooth,
                [before, after] if !turns(mesh, [before, node as u32, after], options) => Role::Chain,
                _ => Role::Corner,
            })
            .collect_vec();
        mesh.pinched_nodes().iter().for_each(|&node| roles[node as usize] = Role::Corner);
        Ok(Self { neighbours, roles })
    }
}

pub(crate) fn half_edges(mesh: &Mesh) -> impl Iterator<Item = HalfEdge> {
    (0..mesh.triangles().len()).flat_map(|t| (0..3).map(move |corner| HalfEdge::new(t, corner)))
}

/// Edges inside the mesh that are given as sharp, or whose triangles turn by more than the angle.
fn sharp_edges(mesh: &Mesh, options: &DecimateOptions) -> Result<Vec<bool>, DecimateError> {
    let mut is_sharp = memory::filled(false, 3 * mesh.triangles().len());
    let count = mesh.points().len();
    let found = options.sharp_angle.map(|angle| mesh.sharp_edges(angle)).unwrap_or_default();
    for (index, &nodes) in options.sharp_edges.iter().chain(&found).enumerate() {
        if let Some(node) = nodes.into_iter().find(|&node| node as usize >= count) {
            return Err(DecimateError::NoSuchNode { index, node, count });
        }
        let edge = mesh.edge_between(nodes[0], nodes[1]);
        let edge = edge.ok_or(DecimateError::NotAnEdge { index, nodes })?;
        if let Some(twin) = mesh.topology().twin(edge) {
            is_sharp[edge.index()] = true;
            is_sharp[twin.index()] = true;
        }
    }
    Ok(is_sharp)
}

impl Mesh {
    /// Edges inside the mesh whose triangles turn by more than an angle in radians, as nodes, the smaller first, in
    /// increasing order. Edges of triangles without area are not among them.
    pub fn sharp_edges(&self, angle: f64) -> Vec<[u32; 2]> {
        let normals: Vec<DVec3> = self.triangles().iter().map(|t| normal(self.points(), t)).collect_vec();
        let is_sharp = |edge: &HalfEdge| {
            self.topology().twin(*edge).filter(|twin| twin > edge).is_some_and(|twin| {
                let [m, n] = [edge.triangle(), twin.triangle()].map(|t| normals[t]);
                m.cross(n).length().atan2(m.dot(n)) > angle
            })
        };
        let nodes = |edge: HalfEdge| {
            let [a, b] = [edge.origin(self.triangles()), edge.target(self.triangles())];
            [a.min(b), a.max(b)]
        };
        let mut edges: Vec<[u32; 2]> = half_edges(self).filter(is_sharp).map(nodes).collect_vec();
        edges.sort_unstable();
        edges
    }
}

/// Normal times twice the area.
pub(crate) fn normal(points: &[DVec3], triangle: &[u32; 3]) -> DVec3 {
    let [a, b, c] = triangle.map(|node| points[node as usize]);
    (b - a).cross(c - a)
}

/// Whether a chain turns too much at its middle node, in space or in the parameter plane.
fn turns(mesh: &Mesh, chain: [u32; 3], options: &DecimateOptions) -> bool {
    let [a, b, c] = chain.map(|node| mesh.points()[node as usize]);
    let in_space = (b - a).angle_between(c - b);
    let in_plane = options.parameters_of(mesh).map_or(0.0, |uv| {
        let [a, b, c] = chain.map(|node| uv[node as usize]);
        DVec2::angle_to(b - a, c - b).abs()
    });
    in_space.max(in_plane) > options.corner_angle
}
