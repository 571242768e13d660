//! Layouts made for meshes, with the places of their nodes.
//!
//! A closed mesh of genus 0 may become a cube: its nodes go on to the sphere and from there on to the cube's faces. Any
//! mesh, closed or with a border, has a base complex (`complex`), whose patches follow the shape.

pub use super::mesh_layout::{LayoutKind, MeshLayout, MeshLayoutError, MeshLayoutOptions, MeshLayoutReport};
use super::{Layout, NodeMap, complex, cube_place};
use crate::Control;
use crate::control::Stage;
use crate::memory::CollectVec;
use crate::mesh::Mesh;
use crate::parameterize::sphere::{SphereOptions, map_to_sphere};
use std::time::Instant;

/// Makes a layout for a mesh of one component, closed or with a border.
pub fn layout_of_mesh(
    mesh: &Mesh,
    options: &MeshLayoutOptions,
    control: &mut Control,
) -> Result<MeshLayout, MeshLayoutError> {
    let start = Instant::now();
    control.enter(Stage::Layout);
    check(mesh, options)?;
    let is_cube = match options.kind {
        LayoutKind::Auto => mesh.genus() == 0 && mesh.loops().is_empty(),
        LayoutKind::Cube => true,
        LayoutKind::Complex => false,
    };
    let mut made = if is_cube { cube(mesh, control) } else { complex::make(mesh, options, control) }?;
    made.report.seconds = start.elapsed().as_secs_f64();
    Ok(made)
}

/// Fewest patches that a base complex may have.
const LEAST_PATCHES: usize = 6;

/// So many patches any mesh may be asked for: where it has fewer triangles they are halved first.
const ANY_PATCHES: usize = 1000;

/// Refuses a number of patches that no layout of a mesh has.
pub(crate) fn check_patches(mesh: &Mesh, given: usize) -> Result<(), MeshLayoutError> {
    let (least, most) = (LEAST_PATCHES, mesh.triangles().len().max(ANY_PATCHES));
    match (least..=most).contains(&given) {
        true => Ok(()),
        false => Err(MeshLayoutError::Patches { given, least, most }),
    }
}

fn check(mesh: &Mesh, options: &MeshLayoutOptions) -> Result<(), MeshLayoutError> {
    if mesh.component_count() != 1 {
        return Err(MeshLayoutError::Components { count: mesh.component_count() });
    }
    if let Some(&node) = mesh.pinched_nodes().first() {
        return Err(MeshLayoutError::Pinched { node: node as usize });
    }
    check_patches(mesh, options.patches)?;
    let has_area = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|node| mesh.points()[node as usize]);
        (b - a).cross(c - a).length() > 0.0
    };
    match mesh.triangles().iter().any(has_area) {
        true => Ok(()),
        false => Err(MeshLayoutError::ZeroArea { count: mesh.triangles().len() }),
    }
}

/// Through the sphere on to the cube.
fn cube(mesh: &Mesh, control: &mut Control) -> Result<MeshLayout, MeshLayoutError> {
    let sphere = map_to_sphere(mesh, &SphereOptions::default(), control)?;
    let place = |node: u32| mesh.is_used(node).then(|| cube_place(sphere.points[node as usize]));
    let places = (0..mesh.points().len() as u32).map(place).collect_vec();
    let report = MeshLayoutReport {
        kind: LayoutKind::Cube,
        energy: sphere.report.energy,
        first_energy: sphere.report.energy,
        folded_nodes: sphere.report.folded_triangles,
        spread_nodes: 0,
        doublets: 0,
        splits: 0,
        seconds: 0.0,
    };
    Ok(MeshLayout { layout: Layout::cube(), map: NodeMap::new(places), report })
}
