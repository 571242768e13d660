//! Numbers on the nodes of meshes: fields and parameters.

use super::arguments::{ArgumentError, copy, copy_rows, deref, deref_mut, rows_mut, text, write_text};
use super::guard::guard;
use super::mesh::planish_mesh;
use super::mesh_parts::query_mesh;
use super::planish_status;
use super::report::write_pairs;
use crate::fit::common::FitError;
use crate::mesh::Mesh;
use glam::DVec2;
use libc::c_char;

/// Number of fields on the nodes; 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_mesh_field_count(mesh: *const planish_mesh) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_mesh(mesh, |mesh| Ok(mesh.fields().len())) }
}

/// The name of a field.
///
/// mesh:  not NULL.
/// field: below planish_mesh_field_count().
/// name:  receives the name in UTF-8, cut off if it is too long and always terminated; NULL if size is 0.
/// size:  bytes that name has room for, the NUL included.
/// Arrays: name[size].
/// Returns the length of the whole name in bytes without the NUL; 0 for NULL or a field that does not exist.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_mesh_field_name(
    mesh: *const planish_mesh,
    field: usize,
    name: *mut c_char,
    size: usize,
) -> usize {
    // SAFETY: the caller's promises.
    unsafe {
        query_mesh(mesh, |mesh| {
            let count = mesh.fields().len();
            let found = mesh.fields().get(field);
            let found = found.ok_or(ArgumentError::NoSuch { name: "field", index: field, count })?;
            Ok(write_text(&found.name, name, size))
        })
    }
}

/// Copies the values of a field.
///
/// mesh:       not NULL.
/// name:       the field's name in UTF-8, terminated.
/// out_values: receives planish_mesh_point_count() values; NaN where nothing is known.
/// count:      values that out_values has room for.
/// Arrays: out_values[mesh_point_count].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (no such field, or
/// name is not UTF-8) or PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_mesh_copy_field(
    mesh: *const planish_mesh,
    name: *const c_char,
    out_values: *mut f64,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let mesh = &deref(mesh, "mesh")?.0;
        let name = text(name, "name")?;
        let values = mesh.field(name).ok_or_else(|| ArgumentError::NoField { name: name.to_owned() })?;
        rows_mut(out_values, count, values.len(), 1, "out_values")?.copy_from_slice(values);
        Ok(())
    })
}

/// Adds a field, or replaces the one of this name.
///
/// mesh:   not NULL; changed.
/// name:   the field's name in UTF-8, terminated.
/// values: count values, one for each node; NaN where nothing is known. Copied.
/// count:  planish_mesh_point_count().
/// Arrays: values[count].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (count, or name is
/// not UTF-8), PLANISH_STATUS_TOO_LARGE or PLANISH_STATUS_OUT_OF_MEMORY.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_mesh_set_field(
    mesh: *mut planish_mesh,
    name: *const c_char,
    values: *const f64,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let mesh = &mut deref_mut(mesh, "mesh")?.0;
        let name = text(name, "name")?;
        Ok(mesh.set_field(name, copy(values, count, "values")?)?)
    })
}

/// Removes a field.
///
/// mesh: not NULL; changed.
/// name: the field's name in UTF-8, terminated.
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (no such field, or name is
/// not UTF-8).
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_mesh_remove_field(
    mesh: *mut planish_mesh,
    name: *const c_char,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let mesh = &mut deref_mut(mesh, "mesh")?.0;
        let name = text(name, "name")?;
        match mesh.remove_field(name) {
            true => Ok(()),
            false => Err(ArgumentError::NoField { name: name.to_owned() }.into()),
        }
    })
}

/// 1 if the nodes have parameters, else 0; 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_mesh_has_parameters(mesh: *const planish_mesh) -> u32 {
    // SAFETY: the caller's promise.
    unsafe { query_mesh(mesh, |mesh| Ok(mesh.parameters().is_some().into())) }
}

/// Gives each node its (u,v).
///
/// mesh:  not NULL; changed.
/// uv:    count rows of u, v. Copied.
/// count: planish_mesh_point_count().
/// Arrays: uv[count, 2].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (count),
/// PLANISH_STATUS_NOT_FINITE (the index is the node), PLANISH_STATUS_TOO_LARGE or PLANISH_STATUS_OUT_OF_MEMORY.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_mesh_set_parameters(
    mesh: *mut planish_mesh,
    uv: *const f64,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let mesh = &mut deref_mut(mesh, "mesh")?.0;
        Ok(mesh.set_parameters(copy_rows(uv, count, 2, "uv", DVec2::from_array)?)?)
    })
}

/// Copies the (u,v) of the nodes.
///
/// mesh:   not NULL.
/// out_uv: receives planish_mesh_point_count() rows of u, v.
/// count:  rows that out_uv has room for.
/// Arrays: out_uv[mesh_point_count, 2].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (the mesh has no
/// parameters) or PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_mesh_copy_parameters(
    mesh: *const planish_mesh,
    out_uv: *mut f64,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let parameters = deref(mesh, "mesh")?.0.parameters().ok_or(ArgumentError::NoParameters)?;
        write_pairs(parameters, rows_mut(out_uv, count, parameters.len(), 2, "out_uv")?);
        Ok(())
    })
}

/// How many rows the values of a field on a mesh have: one a node, or one a triangle.
pub(super) fn check_field_count(mesh: &Mesh, count: usize) -> Result<(), FitError> {
    let expected = mesh.points().len();
    if count == expected || count == mesh.triangles().len() {
        return Ok(());
    }
    Err(FitError::Count { what: "the nodes", count, expected })
}
