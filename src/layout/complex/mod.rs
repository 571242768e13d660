//! The base complex of a closed mesh of any genus, as a layout: `theory/closed.md` 3.
//!
//! 1. Edge collapses leave a few triangles, and track where each node lies on them (`base`, `flatten`).
//! 2. A perfect matching makes quads of pairs of triangles (`pairing`).
//! 3. Vertices of two quads are removed with one of them (`doublets`).
//! 4. The nodes are relaxed over the layout, which moves its edges and vertices to better places (`relax`, `chart`).

mod base;
mod chart;
mod doublets;
mod flatten;
mod pairing;
mod relax;
#[cfg(test)]
mod tests;

use super::of_mesh::{LayoutKind, MeshLayout, MeshLayoutError, MeshLayoutOptions, MeshLayoutReport};
use super::{Layout, NodeMap, Place};
use crate::Control;
use crate::control::Stage;
use crate::mesh::Mesh;
use base::{Base, TrianglePlace};
use glam::{DVec2, DVec3};
use pairing::Pairing;
use std::collections::BTreeMap;

/// Quads on their way to a layout, with the places of the nodes.
struct Patches {
    corners: Vec<[u32; 4]>,
    /// The number of each side's edge.
    edges: Vec<[u32; 4]>,
    /// By node; none for a node without triangles.
    places: Vec<Option<Place>>,
}

/// The base complex of a closed mesh of one component, without pinched nodes.
pub(super) fn make(
    mesh: &Mesh,
    options: &MeshLayoutOptions,
    control: &mut Control,
) -> Result<MeshLayout, MeshLayoutError> {
    // patches = triangles / 2 = vertices - 2 + 2 genus
    let target = (options.patches + 2).saturating_sub(2 * mesh.genus()).max(LEAST_VERTICES);
    control.enter(Stage::Layout);
    control.set_stage(0.0, 0.3);
    let base = base::decimate(mesh, target, control)?;
    let mut patches = paired(mesh, &base)?;
    let no_pairing = MeshLayoutError::NoPairing { triangles: base.triangles.len() };
    let doublets = doublets::remove(&mut patches).ok_or(no_pairing)?;
    let (corners, places) = (numbered(&patches.corners), &mut patches.places);
    let layout = Layout::with_edges(&corners, &patches.edges)?;
    control.set_stage(0.3, 1.0);
    let first = relax::measure(mesh, &layout, places, control);
    let quality = relax::relax(mesh, &layout, places, options.sweeps, control)?;
    let report = MeshLayoutReport {
        kind: LayoutKind::Complex,
        energy: quality.energy,
        first_energy: first.energy,
        folded_nodes: quality.folded,
        spread_nodes: quality.spread,
        doublets,
        seconds: 0.0,
    };
    Ok(MeshLayout { layout, map: NodeMap::new(patches.places), report })
}

/// Fewest vertices of a base complex: those of an octahedron.
const LEAST_VERTICES: usize = 6;

/// Pairs the triangles, and gives the nodes their places in the quads.
fn paired(mesh: &Mesh, base: &Base) -> Result<Patches, MeshLayoutError> {
    let points: Vec<DVec3> = base.vertices.iter().map(|&node| mesh.points()[node as usize]).collect();
    let no_pairing = MeshLayoutError::NoPairing { triangles: base.triangles.len() };
    let pairing = pairing::paired(&points, &base.triangles).ok_or(no_pairing)?;
    let places =
        base.places.iter().map(|place| place.map(|place| quad_place(base, &pairing, place))).collect();
    Ok(Patches { edges: edge_numbers(&pairing.quads), corners: pairing.quads, places })
}

/// The place in a quad of a place in one of its triangles: linear, with the corners where the quad has them.
fn quad_place(base: &Base, pairing: &Pairing, place: TrianglePlace) -> Place {
    const CORNERS: [DVec2; 4] = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
    let quad = pairing.quad_of[place.triangle as usize];
    let corners = pairing.quads[quad as usize];
    let corner = |vertex: u32| {
        let k = corners
            .iter()
            .position(|&other| other == vertex)
            .expect("a quad has the corners of its triangles");
        CORNERS[k]
    };
    let triangle = base.triangles[place.triangle as usize];
    let uv: DVec2 = triangle.iter().zip(place.weights).map(|(&vertex, weight)| weight * corner(vertex)).sum();
    Place { quad, uv: uv.clamp(DVec2::ZERO, DVec2::ONE) }
}

/// A number for each side, the same for the same two ends: in a triangulation no two edges have both in common.
fn edge_numbers(quads: &[[u32; 4]]) -> Vec<[u32; 4]> {
    let mut numbers = BTreeMap::new();
    let mut number = |a: u32, b: u32| {
        let next = numbers.len() as u32;
        *numbers.entry([a.min(b), a.max(b)]).or_insert(next)
    };
    quads.iter().map(|quad| std::array::from_fn(|k| number(quad[k], quad[(k + 1) % 4]))).collect()
}

/// The same quads with vertices numbered from 0 without gaps, in the order in which quads meet them.
fn numbered(quads: &[[u32; 4]]) -> Vec<[u32; 4]> {
    let mut numbers = BTreeMap::new();
    let mut number = |vertex: u32| {
        let next = numbers.len() as u32;
        *numbers.entry(vertex).or_insert(next)
    };
    quads.iter().map(|quad| quad.map(&mut number)).collect()
}
