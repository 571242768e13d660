//! PHT-splines in parts: cells, vertices, data, control points, extraction operators.

use super::arguments::{
    ArgumentError, choice, copy_rows, deref, deref_mut, out, rows_mut, slice, slice_mut_or_none,
};
use super::guard::guard;
use super::planish_status;
use super::surface::{planish_surface, query_surface};
use crate::surface::Patches;
use crate::surface::pht::{Basis, PhtSurface};
use crate::tmesh::{NodeId, VertexKind};

/// Which control points a PHT-spline has.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_pht_basis {
    /// Of the cells at the birth of a vertex (Deng et al., 2008): independent of later splits.
    Canonical = 0,
    /// Of the widest cell of a vertex's support on each side: well conditioned whatever the levels.
    SupportSized = 1,
}

fn basis(given: u32) -> Result<Basis, ArgumentError> {
    choice(given, &[Basis::Canonical, Basis::SupportSized], "basis")
}

/// Number of cells (leaves) of a PHT-spline; 0 for NULL and other families. Cell k is patch k of
/// planish_surface_copy_patch().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_pht_cell_count(surface: *const planish_surface) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_surface(surface, |surface| Ok(surface.pht()?.mesh().leaf_count())) }
}

/// Number of basis vertices of a PHT-spline, each with four control points; 0 for NULL and other families.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_pht_vertex_count(surface: *const planish_surface) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_surface(surface, |surface| Ok(surface.pht()?.jets().len())) }
}

/// Number of T-vertices of a PHT-spline: they lie inside an edge of a cell, their host, and have its data; 0 for
/// NULL and other families.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_pht_hanging_count(surface: *const planish_surface) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_surface(surface, |surface| Ok(surface.pht()?.topology().hanging.len())) }
}

/// Numbers of a row of data: dim, or dim + 1 with weights; 0 for NULL and other families.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_pht_width(surface: *const planish_surface) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_surface(surface, |surface| Ok(surface.pht()?.width())) }
}

/// Copies the addresses of the cells of a PHT-spline.
///
/// surface:   not NULL.
/// out_cells: receives planish_pht_cell_count() rows of level, i, j.
/// count:     rows that out_cells has room for.
/// Arrays: out_cells[pht_cell_count, 3].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND or
/// PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_pht_copy_cells(
    surface: *const planish_surface,
    out_cells: *mut u32,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let mesh = deref(surface, "surface")?.pht()?.mesh();
        let rows = rows_mut(out_cells, count, mesh.leaf_count(), 3, "out_cells")?;
        for (row, leaf) in rows.chunks_exact_mut(3).zip(mesh.leaves()) {
            let cell = mesh.cell(leaf);
            row.copy_from_slice(&[cell.level, cell.i, cell.j]);
        }
        Ok(())
    })
}

/// Copies the parameters of the basis vertices of a PHT-spline, ordered along u, then along v.
///
/// surface: not NULL.
/// out_uv:  receives planish_pht_vertex_count() rows of u, v.
/// count:   rows that out_uv has room for.
/// Arrays: out_uv[pht_vertex_count, 2].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND or
/// PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_pht_copy_vertices(
    surface: *const planish_surface,
    out_uv: *mut f64,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let pht = deref(surface, "surface")?.pht()?;
        let rows = rows_mut(out_uv, count, pht.jets().len(), 2, "out_uv")?;
        for (row, (vertex, _)) in rows.chunks_exact_mut(2).zip(pht.jets()) {
            pht.mesh().parameters(vertex).write_to_slice(row);
        }
        Ok(())
    })
}

/// Copies the T-vertices of a PHT-spline with their hosts.
///
/// surface:   not NULL.
/// out_uv:    receives planish_pht_hanging_count() rows of u, v; NULL for none.
/// out_hosts: receives as many numbers of cells; NULL for none.
/// count:     rows that each has room for.
/// Arrays: out_uv[pht_hanging_count, 2], out_hosts[pht_hanging_count].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND or
/// PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_pht_copy_hanging(
    surface: *const planish_surface,
    out_uv: *mut f64,
    out_hosts: *mut u32,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let pht = deref(surface, "surface")?.pht()?;
        let topology = pht.topology();
        let needed = topology.hanging.len();
        if count < needed {
            return Err(ArgumentError::TooSmall { name: "out_uv", given: count, needed }.into());
        }
        let uv = slice_mut_or_none(out_uv, 2 * needed, "out_uv")?;
        let hosts = slice_mut_or_none(out_hosts, needed, "out_hosts")?;
        if let Some(uv) = uv {
            for (row, &number) in uv.chunks_exact_mut(2).zip(&topology.hanging) {
                pht.mesh().parameters(topology.vertices[number as usize]).write_to_slice(row);
            }
        }
        if let Some(hosts) = hosts {
            for (host, &number) in hosts.iter_mut().zip(&topology.hanging) {
                if let VertexKind::Hanging(hanging) = topology.kinds[number as usize] {
                    *host = hanging.host;
                }
            }
        }
        Ok(())
    })
}

fn leaf(pht: &PhtSurface, index: usize) -> Result<NodeId, ArgumentError> {
    let leaves = &pht.topology().leaves;
    leaves.get(index).copied().ok_or(ArgumentError::NoSuch { name: "cell", index, count: leaves.len() })
}

/// Copies the numbers of the cells that share a part of an edge with a cell: those at its least u, largest u,
/// least v and largest v, in order along each.
///
/// surface:   not NULL.
/// cell:      below planish_pht_cell_count().
/// out_cells: receives the numbers; NULL asks how many there are.
/// count:     numbers that out_cells has room for.
/// out_count: receives how many there are.
/// Arrays: out_cells[count], out_count[1].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_INDEX or
/// PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_pht_copy_neighbours(
    surface: *const planish_surface,
    cell: usize,
    out_cells: *mut u32,
    count: usize,
    out_count: *mut usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let pht = deref(surface, "surface")?.pht()?;
        let out_count = out(out_count, "out_count")?;
        let neighbours = pht.mesh().neighbours(leaf(pht, cell)?);
        if !out_cells.is_null() {
            let cells = rows_mut(out_cells, count, neighbours.len(), 1, "out_cells")?;
            for (cell, &neighbour) in cells.iter_mut().zip(&neighbours) {
                // max_cells keeps the numbers of leaves far below 2^32
                *cell = pht.topology().leaf_of(neighbour) as u32;
            }
        }
        out_count.write(neighbours.len());
        Ok(())
    })
}

/// Copies the data of the basis vertices of a PHT-spline.
///
/// surface:  not NULL.
/// out_data: receives for each of planish_pht_vertex_count() vertices four rows f, f_u, f_v, f_uv of
///           planish_pht_width() numbers; with weights those of (w x, .., w).
/// count:    vertices that out_data has room for.
/// Arrays: out_data[pht_vertex_count, 4, pht_width].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND or
/// PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_pht_copy_data(
    surface: *const planish_surface,
    out_data: *mut f64,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let pht = deref(surface, "surface")?.pht()?;
        let width = 4 * pht.width();
        let rows = rows_mut(out_data, count, pht.jets().len(), width, "out_data")?;
        rows.chunks_exact_mut(width).zip(pht.jets()).for_each(|(row, (_, jet))| row.copy_from_slice(jet));
        Ok(())
    })
}

/// Replaces the data of some basis vertices of a PHT-spline, all or none.
///
/// surface:  not NULL; changed.
/// vertices: count numbers below planish_pht_vertex_count().
/// count:    may be 0.
/// data:     for each of them four rows f, f_u, f_v, f_uv of planish_pht_width() numbers.
/// Arrays: vertices[count], data[count, 4, pht_width].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_INDEX,
/// PLANISH_STATUS_NOT_FINITE (the index is the vertex), PLANISH_STATUS_INVALID_ARGUMENT (a weight would not be
/// positive everywhere; the index is the cell) or PLANISH_STATUS_TOO_LARGE.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_pht_set_data(
    surface: *mut planish_surface,
    vertices: *const u32,
    count: usize,
    data: *const f64,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let pht = deref_mut(surface, "surface")?.pht_mut()?;
        let len = super::arguments::array_len::<f64>(count, 4 * pht.width(), "data")?;
        Ok(pht.set_jets(&numbers(vertices, count)?, slice(data, len, "data")?)?)
    })
}

/// Copies the control points of a PHT-spline.
///
/// surface:    not NULL.
/// basis:      a planish_pht_basis.
/// out_points: receives for each of planish_pht_vertex_count() vertices four rows --, +-, -+, ++ (towards less or
///             more u, then v) of planish_pht_width() numbers; with weights those of (w x, .., w).
/// count:      vertices that out_points has room for.
/// Arrays: out_points[pht_vertex_count, 4, pht_width].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND,
/// PLANISH_STATUS_INVALID_ARGUMENT (basis) or PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_pht_copy_control_points(
    surface: *const planish_surface,
    basis: u32,
    out_points: *mut f64,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let pht = deref(surface, "surface")?.pht()?;
        let basis = self::basis(basis)?;
        let rows = rows_mut(out_points, count, pht.jets().len(), 4 * pht.width(), "out_points")?;
        rows.copy_from_slice(&pht.control_points(basis));
        Ok(())
    })
}

/// Numbers of vertices.
///
/// # Safety
/// `vertices` is NULL or points to so many numbers.
unsafe fn numbers(vertices: *const u32, count: usize) -> Result<Vec<usize>, ArgumentError> {
    // SAFETY: the caller's promise.
    unsafe { copy_rows(vertices, count, 1, "vertices", |[vertex]| vertex as usize) }
}

/// Replaces the control points of some basis vertices of a PHT-spline, all or none.
///
/// surface:  not NULL; changed.
/// vertices: count numbers below planish_pht_vertex_count().
/// count:    may be 0.
/// basis:    a planish_pht_basis.
/// points:   for each of them four rows --, +-, -+, ++ of planish_pht_width() numbers.
/// Arrays: vertices[count], points[count, 4, pht_width].
/// Returns what planish_pht_set_data() returns; PLANISH_STATUS_INVALID_ARGUMENT also for basis.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_pht_set_control_points(
    surface: *mut planish_surface,
    vertices: *const u32,
    count: usize,
    basis: u32,
    points: *const f64,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let pht = deref_mut(surface, "surface")?.pht_mut()?;
        let basis = self::basis(basis)?;
        let len = super::arguments::array_len::<f64>(count, 4 * pht.width(), "points")?;
        let vertices = numbers(vertices, count)?;
        Ok(pht.set_control_points(&vertices, basis, slice(points, len, "points")?)?)
    })
}

/// Copies the operator that makes the Bezier ordinates of a cell from the control points that act on it.
///
/// surface:      not NULL.
/// cell:         below planish_pht_cell_count().
/// basis:        a planish_pht_basis.
/// out_vertices: receives the basis vertices, ascending; NULL asks how many there are.
/// out_matrix:   receives 16 rows, v running fastest, of four numbers for each vertex; NULL for none.
/// count:        vertices that both have room for.
/// out_count:    receives how many there are.
/// Arrays: out_vertices[count], out_matrix[16, 4 * count], out_count[1].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_INDEX,
/// PLANISH_STATUS_INVALID_ARGUMENT (basis) or PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_pht_copy_extraction(
    surface: *const planish_surface,
    cell: usize,
    basis: u32,
    out_vertices: *mut u32,
    out_matrix: *mut f64,
    count: usize,
    out_count: *mut usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let pht = deref(surface, "surface")?.pht()?;
        leaf(pht, cell)?;
        let out_count = out(out_count, "out_count")?;
        let operator = pht.basis(self::basis(basis)?).extraction(cell);
        let needed = operator.vertices.len();
        if !out_vertices.is_null() {
            let vertices = rows_mut(out_vertices, count, needed, 1, "out_vertices")?;
            let matrix = slice_mut_or_none(out_matrix, operator.matrix.len(), "out_matrix")?;
            vertices.copy_from_slice(&operator.vertices);
            if let Some(matrix) = matrix {
                matrix.copy_from_slice(&operator.matrix);
            }
        }
        out_count.write(needed);
        Ok(())
    })
}

/// The number of the cell that has a parameter pair: on a line the one to the right or above; beyond the domain the
/// nearest. 0 for NULL and other families.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_pht_cell_at(surface: *const planish_surface, u: f64, v: f64) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_surface(surface, |surface| Ok(surface.pht()?.patch_at(glam::DVec2::new(u, v)))) }
}
