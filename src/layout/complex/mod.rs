//! The base complex of a mesh of any genus, closed or with a border, as a layout (docs/theory.md, models of
//! many patches).
//!
//! 0. Edges of a mesh with few nodes for so many patches are halved (`Mesh::halved`).
//! 1. Edge collapses leave a few triangles, and track where each node lies on them (`base`, `flatten`, `border`).
//! 2. A matching makes quads of pairs of triangles (`pairing`). On an open surface triangles may be left over: edges there
//!    are split until none is (`search`).
//! 3. Vertices of two quads are removed with one of them (`doublets`).
//! 4. The nodes are relaxed over the layout, which moves its edges and vertices to better places (`relax`, `chart`): first
//!    those of a middle level, then all, as they come back. Nodes of the border stay where their length along it says.

mod base;
pub(super) mod border;
mod chart;
mod doublets;
mod flatten;
mod halves;
mod pairing;
mod relax;
mod search;
#[cfg(test)]
mod tests;

use super::mesh_layout::{LayoutKind, MeshLayout, MeshLayoutError, MeshLayoutOptions, MeshLayoutReport};
use super::{Layout, NodeMap, Place, Side};
use crate::Control;
use crate::mesh::rings::Rings;
use crate::mesh::{Mesh, Middles};
pub(super) use base::Fine;
use base::{Base, Collapsing, TrianglePlace};
use border::{Along, Border};
use glam::DVec2;
use halves::Halves;
use pairing::Pairing;
use search::Splitting;
use std::borrow::Cow;
use std::collections::BTreeMap;

/// Quads on their way to a layout, with the places of the nodes.
struct Patches {
    corners: Vec<[u32; 4]>,
    /// The number of each side's edge.
    edges: Vec<[u32; 4]>,
    /// By vertex: where it lies on the border.
    border: Vec<Option<Along>>,
    /// By node; none for those that come later, and for those without triangles.
    places: Vec<Option<Place>>,
}

/// The base complex of a mesh of one component, without pinched nodes.
pub(super) fn make(
    mesh: &Mesh,
    options: &MeshLayoutOptions,
    control: &mut Control,
) -> Result<MeshLayout, MeshLayoutError> {
    let (fine, middles) = match halvings(mesh, options.patches) {
        0 => (Cow::Borrowed(mesh), Middles::default()),
        times => mesh.halved(times).map(|(fine, middles)| (Cow::Owned(fine), middles))?,
    };
    let border = Border::new(&fine)?;
    // quads = vertices - Euler characteristic - border edges / 2
    let vertices = options.patches as i64 + fine.euler_characteristic() + border.least_nodes() as i64 / 2;
    let target = vertices.max(LEAST_VERTICES) as usize + border.lengths.len();
    control.set_stage(0.0, 0.3);
    let base = base::decimate(&border, target, TRACKED * options.patches, Collapsing::Any, control)?;
    let triangles = base.triangles.len();
    let (base, pairing, splits) = search::quads(base, &border.lengths, Splitting::Any, control)?
        .ok_or(MeshLayoutError::NoPairing { triangles })?;
    let mut patches = patches(&base, pairing);
    let doublets = doublets::remove(&mut patches).ok_or(MeshLayoutError::NoPairing { triangles })?;
    place_border(&border, &mut patches);
    let layout = Layout::with_edges(&numbered(&patches.corners), &patches.edges)?;
    control.set_stage(0.3, 1.0);
    let mut places = patches.places;
    let (first, quality) = relax::relax(&border, &layout, &mut places, base.fine, options.sweeps, control)?;
    places.truncate(fine.points().len());
    let report = MeshLayoutReport {
        kind: LayoutKind::Complex,
        energy: quality.energy,
        first_energy: first.energy,
        folded_nodes: quality.folded,
        spread_nodes: quality.spread,
        doublets,
        splits,
        seconds: 0.0,
    };
    Ok(MeshLayout { layout, map: NodeMap::with_middles(places, mesh.points().len(), middles), report })
}

/// How often the edges of a coarse mesh are halved, so that stars of nodes fit into few patches.
fn halvings(mesh: &Mesh, patches: usize) -> u32 {
    let count = mesh.points().len();
    let enough = TRACKED.saturating_mul(patches).min(FINE);
    (0..MOST_HALVINGS).find(|&times| count << (2 * times) >= enough).unwrap_or(MOST_HALVINGS)
}

/// A mesh of so many nodes is fine enough, however many patches are asked for.
const FINE: usize = 100_000;

/// Halvings make at most so many times more nodes, by the power of 4: what they help a mesh of a few nodes.
const MOST_HALVINGS: u32 = 4;

/// Nodes of the middle level for each patch: enough for stars that fit into few patches, few enough for hundreds of
/// sweeps.
const TRACKED: usize = 60;

/// Fewest vertices of a base complex: those of an octahedron.
const LEAST_VERTICES: i64 = 6;

/// How good the map of a surface is, and what it was before.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Relaxed {
    pub energy: f64,
    pub first_energy: f64,
    pub folded: usize,
    pub spread: usize,
}

/// Relaxes the places of all nodes of a surface but those of its border, in at most so many sweeps; nodes that `fine`
/// brings back have none before.
pub(super) fn relax_all(
    mesh: &Mesh,
    layout: &Layout,
    places: &mut [Option<Place>],
    fine: Option<Fine>,
    sweeps: usize,
    control: &mut Control,
) -> Result<Relaxed, MeshLayoutError> {
    let border = Border::new(mesh)?;
    let all = || Fine { rings: Rings::new(&border.closed), order: Vec::new() };
    let fine = fine.unwrap_or_else(all);
    let (first, last) = relax::relax(&border, layout, places, fine, sweeps, control)?;
    Ok(Relaxed { energy: last.energy, first_energy: first.energy, folded: last.folded, spread: last.spread })
}

/// Quads over a surface whose border is given.
#[derive(Debug, Clone)]
pub(super) struct Over {
    pub corners: Vec<[u32; 4]>,
    /// The number of each side's edge.
    pub edges: Vec<[u32; 4]>,
    /// By vertex: its node, where it has one; none for the last vertices.
    pub nodes: Vec<Option<u32>>,
    /// By node; none for those that `fine` brings back.
    pub places: Vec<Option<Place>>,
    pub fine: Fine,
    /// Edges inside that were split, and vertices of two quads that were removed.
    pub splits: usize,
    pub doublets: usize,
}

/// The base complex of a surface whose border is given: its vertices are the nodes in `needs`, with the quads that each
/// of them needs. It has about so many patches. None if there is no such complex: an odd border has none.
pub(super) fn make_over(
    mesh: &Mesh,
    needs: &BTreeMap<u32, u32>,
    patches: usize,
    control: &mut Control,
) -> Result<Option<Over>, MeshLayoutError> {
    let Some((border, base)) = base_over(mesh, needs, patches, control)? else { return Ok(None) };
    let found = search::quads(base, &border.lengths, Splitting::Inside, control)?;
    let Some((base, pairing, splits)) = found.filter(|_| needs.len().is_multiple_of(2)) else {
        return Ok(None);
    };
    let mut quads = self::patches(&base, pairing);
    let Some(doublets) = doublets::remove(&mut quads) else { return Ok(None) };
    let Patches { corners, edges, mut places, .. } = quads;
    places.truncate(mesh.points().len());
    Ok(Some(Over { corners, edges, nodes: base.nodes, places, fine: base.fine, splits, doublets }))
}

/// The same with one more vertex in the middle of each edge of the border, even or not; it has two to four times the
/// patches. None if the border cannot be kept, or with more than `most` patches.
pub(super) fn make_halved(
    mesh: &Mesh,
    needs: &BTreeMap<u32, u32>,
    [patches, most]: [usize; 2],
    control: &mut Control,
) -> Result<Option<Over>, MeshLayoutError> {
    let Some((_, base)) = base_over(mesh, needs, patches, control)? else { return Ok(None) };
    // a pair of triangles becomes four quads, one alone three
    if 2 * base.triangles.len() > most {
        return Ok(None);
    }
    let Some(mut pairing) = search::first(&base, control)? else { return Ok(None) };
    halves::take_apart(&mut pairing);
    let Halves { corners, edges, mut places } = halves::halved(&base, &pairing);
    places.truncate(mesh.points().len());
    let splits = base.triangles.len();
    Ok((corners.len() <= most).then_some(Over {
        corners,
        edges,
        nodes: base.nodes,
        places,
        fine: base.fine,
        splits,
        doublets: 0,
    }))
}

/// The coarse triangles over a surface whose border is given; none if more nodes of the border are left.
fn base_over(
    mesh: &Mesh,
    needs: &BTreeMap<u32, u32>,
    patches: usize,
    control: &mut Control,
) -> Result<Option<(Border, Base)>, MeshLayoutError> {
    let border = Border::with_corners(mesh, needs)?;
    let vertices = patches as i64 + mesh.euler_characteristic() + needs.len() as i64 / 2;
    let target = vertices.max(needs.len() as i64) as usize + border.lengths.len();
    let base = base::decimate(&border, target, TRACKED * patches, Collapsing::ToCorners, control)?;
    let is_given = |(along, node): (&Option<(Along, u32)>, &Option<u32>)| {
        along.is_none() || node.is_some_and(|node| needs.contains_key(&node))
    };
    let is_kept = base.border.iter().zip(&base.nodes).all(is_given);
    Ok(is_kept.then_some((border, base)))
}

/// The quads with the places of the nodes in them.
fn patches(base: &Base, pairing: Pairing) -> Patches {
    let place = |place: &TrianglePlace| quad_place(base, &pairing, *place);
    let places = base.places.iter().map(|found| found.as_ref().and_then(place)).collect();
    let border = base.border.iter().map(|border| border.map(|(along, _)| along)).collect();
    Patches { edges: edge_numbers(&pairing.quads), corners: pairing.quads, border, places }
}

/// The place in a quad of a place in one of its triangles: linear, with the corners where the quad has them.
fn quad_place(base: &Base, pairing: &Pairing, place: TrianglePlace) -> Option<Place> {
    const CORNERS: [DVec2; 4] = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
    let quad = pairing.quad_of[place.triangle as usize]?;
    let corners = pairing.quads[quad as usize];
    let triangle = base.triangles[place.triangle as usize];
    let mut uv = DVec2::ZERO;
    for (vertex, weight) in triangle.into_iter().zip(place.weights) {
        let k = corners.iter().position(|&corner| corner == vertex)?;
        uv += weight * CORNERS[k];
    }
    Some(Place { quad, uv: uv.clamp(DVec2::ZERO, DVec2::ONE) })
}

/// Gives the nodes of the border their places: along the sides of the border as far as along its loops.
fn place_border(border: &Border, patches: &mut Patches) {
    let mut uses: BTreeMap<u32, usize> = BTreeMap::new();
    patches.edges.iter().flatten().for_each(|&edge| *uses.entry(edge).or_default() += 1);
    let mut of_loops: Vec<Vec<(f64, usize)>> = vec![Vec::new(); border.lengths.len()];
    for (node, found) in border.nodes.iter().enumerate() {
        if let Some(node_of_border) = found {
            of_loops[node_of_border.along.index].push((node_of_border.along.length, node));
        }
    }
    for quad in 0..patches.corners.len() {
        for k in 0..4 {
            let [from, to] = [k, k + 1].map(|k| patches.corners[quad][k % 4] as usize);
            let (Some(begin), Some(end)) = (patches.border[from], patches.border[to]) else { continue };
            if uses[&patches.edges[quad][k]] != 1 {
                continue;
            }
            let side = Side { quad: quad as u32, side: k as u8 };
            let all = border.lengths[begin.index];
            let length = (end.length - begin.length).rem_euclid(all);
            for &(at, node) in &of_loops[begin.index] {
                let t = (at - begin.length).rem_euclid(all) / length;
                if t <= 1.0 {
                    patches.places[node] = Some(side.place(t, 0.0));
                }
            }
        }
    }
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
