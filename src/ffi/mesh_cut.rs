//! Parts of meshes as meshes of their own, and paths along their edges.

use super::arguments::{deref, out, rows_mut, slice};
use super::guard::Failure;
use super::guard::guard;
use super::mesh::planish_mesh;
use super::planish_status;
use crate::mesh::Piece;
use std::mem::MaybeUninit;

/// Makes a mesh without some of the triangles, and without the nodes that no triangle needs any more.
///
/// Parameters and fields go with their nodes, and planish_mesh_copy_node_map() of the new mesh tells which node each
/// one was.
///
/// mesh:      not NULL; stays as it is.
/// triangles: count triangles to leave out, counted from 0, in any order.
/// count:     may be 0.
/// out_mesh:  receives a new mesh; destroy with planish_mesh_free().
/// Arrays: triangles[count].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INDEX (no such triangle; it is the
/// index) or PLANISH_STATUS_INVALID_ARGUMENT (nothing is left).
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_mesh_remove_triangles(
    mesh: *const planish_mesh,
    triangles: *const u32,
    count: usize,
    out_mesh: *mut *mut planish_mesh,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let mesh = &deref(mesh, "mesh")?.0;
        let triangles = slice(triangles, count, "triangles")?;
        let out_mesh = out(out_mesh, "out_mesh")?;
        out_mesh.write(planish_mesh::into_raw(mesh.remove_triangles(triangles)?.mesh));
        Ok(())
    })
}

/// Makes a mesh that is cut open along a path of edges: how a closed mesh or a handle is opened.
///
/// Nodes inside the path are doubled, and so are its ends on the boundary; ends inside the mesh are not. A
/// closed path, whose last node is its first, separates what it surrounds. Triangles keep their numbers and
/// nodes theirs; copies come after them. Parameters and fields go with their nodes.
///
/// mesh:     not NULL; stays as it is.
/// nodes:    count nodes of the path in order, counted from 0; see planish_mesh_shortest_path().
/// count:    at least 2.
/// out_mesh: receives a new mesh; destroy with planish_mesh_free().
/// Arrays: nodes[count].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (count),
/// PLANISH_STATUS_INDEX (no such node; it is the index) or PLANISH_STATUS_TOPOLOGY (two nodes that follow each
/// other have no common edge, the index is the first; or the path opens nothing).
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_mesh_cut_along(
    mesh: *const planish_mesh,
    nodes: *const u32,
    count: usize,
    out_mesh: *mut *mut planish_mesh,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let mesh = &deref(mesh, "mesh")?.0;
        let nodes = slice(nodes, count, "nodes")?;
        let out_mesh = out(out_mesh, "out_mesh")?;
        out_mesh.write(planish_mesh::into_raw(mesh.cut_along(nodes)?.mesh));
        Ok(())
    })
}

/// Makes a mesh of each part that hangs together by edges, in the order of their first triangles. Parameters
/// and fields go with their nodes.
///
/// mesh:       not NULL; stays as it is.
/// out_meshes: receives planish_mesh_component_count() new meshes, all or none; destroy each with
///             planish_mesh_free().
/// count:      meshes that out_meshes has room for.
/// Arrays: out_meshes[mesh_component_count].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_mesh_split_components(
    mesh: *const planish_mesh,
    out_meshes: *mut *mut planish_mesh,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises; MaybeUninit has the layout of a pointer.
    guard(|| unsafe {
        let mesh = &deref(mesh, "mesh")?.0;
        let out_meshes = out_meshes.cast::<MaybeUninit<*mut planish_mesh>>();
        let out_meshes = rows_mut(out_meshes, count, mesh.component_count(), 1, "out_meshes")?;
        let pieces = mesh.split_components()?;
        for (out, Piece { mesh, .. }) in out_meshes.iter_mut().zip(pieces) {
            out.write(planish_mesh::into_raw(mesh));
        }
        Ok(())
    })
}

/// Finds the shortest path along edges, by length in space.
///
/// mesh:      not NULL.
/// from, to:  its ends, nodes counted from 0.
/// out_nodes: receives the nodes of the path, both ends included. NULL asks for their number.
/// count:     nodes that out_nodes has room for.
/// out_count: receives the number of nodes of the path; not NULL.
/// Arrays: out_nodes[count], out_count[1].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INDEX (no such node; it is the
/// index), PLANISH_STATUS_TOPOLOGY (no path joins them) or PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_mesh_shortest_path(
    mesh: *const planish_mesh,
    from: u32,
    to: u32,
    out_nodes: *mut u32,
    count: usize,
    out_count: *mut usize,
) -> planish_status {
    guard(|| -> Result<(), Failure> {
        // SAFETY: the caller's promises.
        unsafe {
            let mesh = &deref(mesh, "mesh")?.0;
            let out_count = out(out_count, "out_count")?;
            let path = mesh.shortest_path(from, to)?;
            if !out_nodes.is_null() {
                rows_mut(out_nodes, count, path.len(), 1, "out_nodes")?.copy_from_slice(&path);
            }
            out_count.write(path.len());
            Ok(())
        }
    })
}
