//! Nodes, triangles and boundary loops of meshes.

use super::arguments::{ArgumentError, copy_rows, deref, deref_mut, rows_mut};
use super::guard::guard;
use super::mesh::planish_mesh;
use super::planish_status;
use super::status::query;
use crate::mesh::Mesh;
use glam::DVec3;

/// What `find` reads from a mesh; 0 for NULL.
///
/// # Safety
/// `mesh` is NULL or a mesh that nobody changes meanwhile.
pub(super) unsafe fn query_mesh<T: Default>(
    mesh: *const planish_mesh,
    find: impl FnOnce(&Mesh) -> Result<T, ArgumentError>,
) -> T {
    // SAFETY: the caller's promise.
    query(|| Ok(find(&unsafe { deref(mesh, "mesh") }?.0)?))
}

/// Number of nodes; 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_mesh_point_count(mesh: *const planish_mesh) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_mesh(mesh, |mesh| Ok(mesh.points().len())) }
}

/// Number of triangles; 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_mesh_triangle_count(mesh: *const planish_mesh) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_mesh(mesh, |mesh| Ok(mesh.triangles().len())) }
}

/// Number of edges, each counted once; 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_mesh_edge_count(mesh: *const planish_mesh) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_mesh(mesh, |mesh| Ok(mesh.edge_count())) }
}

/// Number of parts that hang together by edges; 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_mesh_component_count(mesh: *const planish_mesh) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_mesh(mesh, |mesh| Ok(mesh.component_count())) }
}

/// Number of handles of all components together; 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_mesh_genus(mesh: *const planish_mesh) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_mesh(mesh, |mesh| Ok(mesh.genus())) }
}

/// Nodes that have triangles, minus edges, plus triangles; 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_mesh_euler_characteristic(mesh: *const planish_mesh) -> i64 {
    // SAFETY: the caller's promise.
    unsafe { query_mesh(mesh, |mesh| Ok(mesh.euler_characteristic())) }
}

/// Number of boundary loops; 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_mesh_loop_count(mesh: *const planish_mesh) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_mesh(mesh, |mesh| Ok(mesh.loops().len())) }
}

fn boundary_loop(mesh: &Mesh, index: usize) -> Result<&[u32], ArgumentError> {
    let count = mesh.loops().len();
    mesh.loops().get(index).map(Vec::as_slice).ok_or(ArgumentError::NoSuch { name: "loop", index, count })
}

/// Number of nodes of a boundary loop; 0 for NULL or a loop that does not exist.
///
/// loop: below planish_mesh_loop_count(); loop 0 is the longest.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_mesh_loop_point_count(mesh: *const planish_mesh, r#loop: usize) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_mesh(mesh, |mesh| Ok(boundary_loop(mesh, r#loop)?.len())) }
}

/// Copies the nodes' coordinates.
///
/// mesh:       not NULL.
/// out_points: receives planish_mesh_point_count() rows of x, y, z.
/// count:      rows that out_points has room for.
/// Arrays: out_points[mesh_point_count, 3].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_mesh_copy_points(
    mesh: *const planish_mesh,
    out_points: *mut f64,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let points = deref(mesh, "mesh")?.0.points();
        let rows = rows_mut(out_points, count, points.len(), 3, "out_points")?;
        points.iter().zip(rows.chunks_exact_mut(3)).for_each(|(point, row)| point.write_to_slice(row));
        Ok(())
    })
}

/// Copies the triangles.
///
/// mesh:          not NULL.
/// out_triangles: receives planish_mesh_triangle_count() rows of three nodes, counted from 0.
/// count:         rows that out_triangles has room for.
/// Arrays: out_triangles[mesh_triangle_count, 3].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_mesh_copy_triangles(
    mesh: *const planish_mesh,
    out_triangles: *mut u32,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let triangles = deref(mesh, "mesh")?.0.triangles();
        let rows = rows_mut(out_triangles, count, triangles.len(), 3, "out_triangles")?;
        rows.copy_from_slice(triangles.as_flattened());
        Ok(())
    })
}

/// Copies what each node of the mesh was in the arrays or the file that it comes from, or in the mesh that it was cut
/// from: copies of nodes name the node that they are copies of, and welded nodes the first of those that became one.
///
/// mesh:      not NULL.
/// out_nodes: receives planish_mesh_point_count() nodes, counted from 0.
/// count:     nodes that out_nodes has room for.
/// Arrays: out_nodes[mesh_point_count].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_mesh_copy_node_map(
    mesh: *const planish_mesh,
    out_nodes: *mut u32,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let origins = deref(mesh, "mesh")?.0.node_origins();
        let nodes = rows_mut(out_nodes, count, origins.len(), 1, "out_nodes")?;
        nodes.iter_mut().zip(origins).for_each(|(node, origin)| *node = origin);
        Ok(())
    })
}

/// Copies what each triangle of the mesh was: the triangle or polygon of the arrays, the face of the file, or the
/// triangle of the mesh that it was cut from.
///
/// mesh:          not NULL.
/// out_triangles: receives planish_mesh_triangle_count() numbers, counted from 0.
/// count:         numbers that out_triangles has room for.
/// Arrays: out_triangles[mesh_triangle_count].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_mesh_copy_triangle_map(
    mesh: *const planish_mesh,
    out_triangles: *mut u32,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let origins = deref(mesh, "mesh")?.0.triangle_origins();
        let triangles = rows_mut(out_triangles, count, origins.len(), 1, "out_triangles")?;
        triangles.iter_mut().zip(origins).for_each(|(triangle, origin)| *triangle = origin);
        Ok(())
    })
}

/// Moves the nodes of a mesh, which keeps its triangles, parameters and fields: a step of a simulation.
///
/// mesh:   not NULL; changed.
/// points: count rows of x, y, z in model units. Copied.
/// count:  planish_mesh_point_count().
/// Arrays: points[count, 3].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (count),
/// PLANISH_STATUS_NOT_FINITE (of a node that has triangles, which is the index), PLANISH_STATUS_TOO_LARGE or
/// PLANISH_STATUS_OUT_OF_MEMORY.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_mesh_set_points(
    mesh: *mut planish_mesh,
    points: *const f64,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let mesh = &mut deref_mut(mesh, "mesh")?.0;
        Ok(mesh.set_points(copy_rows(points, count, 3, "points", DVec3::from_array)?)?)
    })
}

/// Copies the nodes of a boundary loop in order, the surface on their left. The first is not repeated.
///
/// mesh:      not NULL.
/// loop:      below planish_mesh_loop_count(); loop 0 is the longest in space.
/// out_nodes: receives planish_mesh_loop_point_count() nodes, counted from 0.
/// count:     nodes that out_nodes has room for.
/// Arrays: out_nodes[mesh_loop_point_count].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INDEX (the loop) or
/// PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_mesh_copy_loop(
    mesh: *const planish_mesh,
    r#loop: usize,
    out_nodes: *mut u32,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let nodes = boundary_loop(&deref(mesh, "mesh")?.0, r#loop)?;
        rows_mut(out_nodes, count, nodes.len(), 1, "out_nodes")?.copy_from_slice(nodes);
        Ok(())
    })
}
