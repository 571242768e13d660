//! Sharp edges of a control mesh.

use super::error::D1rcError;
use crate::memory::{self, CollectVec};
use crate::mesh::{HalfEdge, Mesh};
use std::f64::consts::PI;

/// Edges whose faces meet at more than `angle` radians (0 for a plane), by their smaller vertex. Boundary edges do
/// not count, nor do edges of faces without area.
pub fn sharp_edges(mesh: &Mesh, angle: f64) -> Result<Vec<[u32; 2]>, D1rcError> {
    if !(0.0..=PI).contains(&angle) {
        return Err(D1rcError::Angle { angle });
    }
    Ok(mesh.sharp_edges(angle))
}

/// By half-edge: whether it is sharp. Sharp edges on the boundary are none.
pub(super) fn flags(mesh: &Mesh, sharp: &[[u32; 2]]) -> Result<Vec<bool>, D1rcError> {
    let count = mesh.points().len();
    let mut flags = memory::filled(false, 3 * mesh.triangles().len());
    let mut face_count = memory::filled(0_u32, count);
    mesh.triangles().iter().flatten().for_each(|&vertex| face_count[vertex as usize] += 1);
    for (index, &vertices) in sharp.iter().enumerate() {
        if let Some(&vertex) = vertices.iter().find(|&&vertex| vertex as usize >= count) {
            return Err(D1rcError::NoSuchVertex { what: "an end of sharp edge", index, vertex, count });
        }
        // around the end with fewer faces: the other may have thousands
        let [from, to] = vertices;
        let is_less = face_count[from as usize] <= face_count[to as usize];
        let [from, to] = if is_less { [from, to] } else { [to, from] };
        let edge = mesh.edge_between(from, to).ok_or(D1rcError::NotAnEdge { index, vertices })?;
        if let Some(twin) = mesh.topology().twin(edge) {
            flags[edge.index()] = true;
            flags[twin.index()] = true;
        }
    }
    Ok(flags)
}

/// Sharp edges that no other touches, with both ends inside: a cut along them would not open.
pub(super) fn lonely_edges(mesh: &Mesh, flags: &[bool]) -> Vec<HalfEdge> {
    let mut count = memory::filled(0_u32, mesh.points().len());
    let origins = (0..flags.len()).filter(|&h| flags[h]).map(|h| mesh.triangles()[h / 3][h % 3]);
    origins.for_each(|vertex| count[vertex as usize] += 1);
    let is_tip = |vertex: u32| !mesh.is_boundary(vertex) && count[vertex as usize] == 1;
    let half_edges = (0..flags.len()).filter(|&h| flags[h]).map(|h| HalfEdge::new(h / 3, h % 3));
    half_edges
        .filter(|h| h.origin(mesh.triangles()) < h.target(mesh.triangles()))
        .filter(|h| is_tip(h.origin(mesh.triangles())) && is_tip(h.target(mesh.triangles())))
        .collect_vec()
}
