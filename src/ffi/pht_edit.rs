//! PHT-splines from their parts and from other surfaces; edits of the mesh below them.

use super::arguments::{
    ArgumentError, choice, copy, copy_rows, deref, deref_mut, flag, options, out, rows_mut, slice,
    slice_mut_or_none,
};
use super::guard::guard;
use super::progress::with_helper;
use super::surface::planish_surface;
use super::{planish_progress, planish_status};
use crate::control::Stage;
use crate::surface::Domain;
use crate::surface::pht::{BorderSide, ConvertOptions, PhtSurface, stitch};
use crate::tmesh::{Cell, TMesh};
use glam::DVec2;
use libc::c_void;

/// # Safety
/// `cells` is NULL or points to `count` rows of three numbers.
unsafe fn cells(at: *const u32, count: usize) -> Result<Vec<Cell>, ArgumentError> {
    // SAFETY: the caller's promise.
    unsafe { copy_rows(at, count, 3, "cells", |[level, i, j]| Cell { level, i, j }) }
}

/// Makes a PHT-spline from an initial grid and a list of splits.
///
/// dim:           numbers of a value, at least 1.
/// is_rational:   1 if values are followed by a weight and multiplied by it, else 0.
/// lines_u:       line_count_u increasing parameters.
/// line_count_u:  2 to 4096.
/// lines_v:       line_count_v increasing parameters.
/// line_count_v:  2 to 4096.
/// cells:         split_count rows of level, i, j: the cells to split, a cell before its quarters; i and j are
///                counted along u and v over the cells of that level.
/// split_count:   may be 0.
/// data:          for each basis vertex, ordered along u, then along v, the rows f, f_u, f_v, f_uv of dim numbers
///                (dim + 1 with weights); NULL for zeros, and weights of 1: the vertices are known afterwards.
/// data_count:    numbers in data; 0 if it is NULL.
/// out_surface:   receives a new surface; destroy with planish_surface_free().
/// Arrays: lines_u[line_count_u], lines_v[line_count_v], cells[split_count, 3],
///         data[data_count, 4, dim + is_rational].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (dim, a count, a line
/// that does not increase, a weight that is not positive everywhere), PLANISH_STATUS_NOT_FINITE (the index is the
/// line or the vertex), PLANISH_STATUS_INDEX (a cell that is no leaf when its turn comes; the index is its row),
/// PLANISH_STATUS_TOO_LARGE (lines, or a level above 20) or PLANISH_STATUS_OUT_OF_MEMORY.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_pht_new(
    dim: usize,
    is_rational: u32,
    lines_u: *const f64,
    line_count_u: usize,
    lines_v: *const f64,
    line_count_v: usize,
    cells: *const u32,
    split_count: usize,
    data: *const f64,
    data_count: usize,
    out_surface: *mut *mut planish_surface,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let out_surface = out(out_surface, "out_surface")?;
        let is_rational = flag(is_rational, "is_rational")?;
        let lines_u = slice(lines_u, line_count_u, "lines_u")?;
        let lines_v = slice(lines_v, line_count_v, "lines_v")?;
        let mut mesh = TMesh::new(lines_u, lines_v)?;
        mesh.split_all(&self::cells(cells, split_count)?)?;
        let surface = if data.is_null() && data_count == 0 {
            PhtSurface::zero(dim, is_rational, mesh)?
        } else {
            PhtSurface::new(dim, is_rational, mesh, &copy(data, data_count, "data")?)?
        };
        out_surface.write(planish_surface::into_raw(surface));
        Ok(())
    })
}

/// Splits cells of a PHT-spline at their middles; the surface stays the same, all cells or none are split.
///
/// surface: not NULL; changed.
/// cells:   count rows of level, i, j: leaves when their turn comes, so quarters may follow their cell.
/// count:   may be 0.
/// Arrays: cells[count, 3].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_INDEX (a cell
/// is no leaf; the index is its row), PLANISH_STATUS_TOO_LARGE (a level above 20) or
/// PLANISH_STATUS_OUT_OF_MEMORY.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_pht_split(
    surface: *mut planish_surface,
    cells: *const u32,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe { Ok(deref_mut(surface, "surface")?.pht_mut()?.split(&self::cells(cells, count)?)?) })
}

/// Merges the quarters of cells of a PHT-spline: the exact inverse of planish_pht_split(). The surface changes
/// where the vertices that vanish acted, which may reach beyond the neighbours. All cells or none are merged.
///
/// surface: not NULL; changed.
/// cells:   count rows of level, i, j: cells whose quarters are four leaves when their turn comes.
/// count:   may be 0.
/// Arrays: cells[count, 3].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_INDEX (the
/// quarters are not four leaves; the index is the row) or PLANISH_STATUS_OUT_OF_MEMORY.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_pht_merge(
    surface: *mut planish_surface,
    cells: *const u32,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe { Ok(deref_mut(surface, "surface")?.pht_mut()?.merge(&self::cells(cells, count)?)?) })
}

record! {
    /// How a PHT-spline is simplified. Fill with planish_pht_simplify_options_init(), then change what you need.
    pub struct planish_pht_simplify_options (planish_pht_simplify_options_init) {
        /// Hears of the progress and may cancel; NULL (default) for nobody.
        pub progress: planish_progress,
        /// Handed to progress as it is.
        pub user: *mut c_void,
        /// Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
        pub cancel: *const i32,
        /// Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
        /// Array: [1].
        pub out_stage: *mut u32,
    }
}

/// Merges as many cells of a PHT-spline as it can while no point moves by more than a tolerance.
///
/// surface:       not NULL; changed on success.
/// tolerance:     in model units, not negative.
/// options:       NULL for the defaults.
/// out_deviation: receives a bound of how far a point has moved; NULL for none.
/// Arrays: out_deviation[1].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND,
/// PLANISH_STATUS_INVALID_ARGUMENT (tolerance), PLANISH_STATUS_VERSION or PLANISH_STATUS_CANCELLED.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_pht_simplify(
    surface: *mut planish_surface,
    tolerance: f64,
    options: *const planish_pht_simplify_options,
    out_deviation: *mut f64,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let given = self::options(options)?;
        let pht = deref_mut(surface, "surface")?.pht_mut()?;
        let out_deviation = slice_mut_or_none(out_deviation, 1, "out_deviation")?;
        // of a copy, so that a call that is cancelled changes nothing; one thread is enough
        let mut simplified = pht.clone();
        let result = with_helper(listener!(given), |control| {
            control.enter(Stage::Convert);
            simplified.simplify_watched(tolerance, control.pool().watch())
        })??;
        *pht = simplified;
        if let Some(out) = out_deviation {
            out[0] = result.deviation;
        }
        Ok(())
    })
}

/// Splits all cells of a PHT-spline that meet the inside of a rectangle until they have at least some level; the
/// surface stays the same.
///
/// surface:   not NULL; changed.
/// region:    least u, largest u, least v, largest v.
/// level:     at most 20.
/// max_cells: with more cells the call fails.
/// Arrays: region[4].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND or
/// PLANISH_STATUS_TOO_LARGE (level, cells).
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_pht_refine_region(
    surface: *mut planish_surface,
    region: *const f64,
    level: u32,
    max_cells: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let region = self::region(slice(region, 4, "region")?);
        Ok(deref_mut(surface, "surface")?.pht_mut()?.refine_region(region, level, max_cells)?)
    })
}

fn region(numbers: &[f64]) -> Domain {
    Domain { min: DVec2::new(numbers[0], numbers[2]), max: DVec2::new(numbers[1], numbers[3]) }
}

record! {
    /// How a tensor surface becomes a PHT-spline. Fill with planish_pht_convert_options_init(), then change what you
    /// need.
    pub struct planish_pht_convert_options (planish_pht_convert_options_init; core: ConvertOptions) {
        /// Largest distance at equal parameters, in model units; 0 (default) takes all knot lines, which is exact up to
        /// degree 3.
        pub tolerance: f64 = core.tolerance,
        /// Most cells; with more the call fails. Default 200000.
        pub max_cells: usize = core.max_cells,
        /// Hears of the progress and may cancel; NULL (default) for nobody.
        pub progress: planish_progress,
        /// Handed to progress as it is.
        pub user: *mut c_void,
        /// Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
        pub cancel: *const i32,
        /// Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
        /// Array: [1].
        pub out_stage: *mut u32,
        /// Deepest level of a cell, at most 20. Default 12.
        pub max_level: u32 = core.max_level,
        /// 0.
        pub reserved: u32,
    }
}

/// Makes a PHT-spline of a tensor surface, with its weights and trims.
///
/// surface:     not NULL, a tensor surface without creases: no knot inside occurs degree times.
/// options:     NULL for the defaults.
/// out_surface: receives a new surface; destroy with planish_surface_free().
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND (a PHT-spline is refused as
/// well), PLANISH_STATUS_INVALID_ARGUMENT (an option; a crease, the index is the knot: convert the parts of
/// planish_tensor_split()), PLANISH_STATUS_TOO_LARGE (the limits do not allow the tolerance) or
/// PLANISH_STATUS_VERSION.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_pht_from_surface(
    surface: *const planish_surface,
    options: *const planish_pht_convert_options,
    out_surface: *mut *mut planish_surface,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let tensor = deref(surface, "surface")?.tensor()?;
        let out_surface = out(out_surface, "out_surface")?;
        let given: planish_pht_convert_options = self::options(options)?;
        if given.reserved != 0 {
            let record = "planish_pht_convert_options";
            return Err(ArgumentError::Reserved { record, given: given.reserved }.into());
        }
        let options = ConvertOptions {
            tolerance: given.tolerance,
            max_level: given.max_level,
            max_cells: given.max_cells,
        };
        // results are the same for any number of threads, and one is enough
        let pht = with_helper(listener!(given), |control| {
            control.enter(Stage::Convert);
            PhtSurface::from_tensor_watched(tensor, &options, control.pool().watch())
        })??;
        out_surface.write(planish_surface::into_raw(pht));
        Ok(())
    })
}

record! {
    /// How a PHT-spline becomes tensor surfaces. Fill with planish_pht_patches_options_init(), then change what you need.
    pub struct planish_pht_patches_options (planish_pht_patches_options_init) {
        /// Hears of the progress and may cancel; NULL (default) for nobody.
        pub progress: planish_progress,
        /// Handed to progress as it is.
        pub user: *mut c_void,
        /// Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
        pub cancel: *const i32,
        /// Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
        /// Array: [1].
        pub out_stage: *mut u32,
        /// By how much the levels of cells in one surface may differ: many small ones for 0 (default), one for 20.
        pub level_spread: u32,
        /// 0.
        pub reserved: u32,
    }
}

/// Makes tensor surfaces that together are a PHT-spline exactly. They meet with equal parameters. Each has its part of
/// the trims; one outside of them has a trim without area.
///
/// surface:      not NULL.
/// options:      NULL for the defaults.
/// out_surfaces: receives new surfaces; destroy each with planish_surface_free(). NULL asks for the number.
/// count:        handles that out_surfaces has room for.
/// out_count:    receives the number of surfaces.
/// Arrays: out_surfaces[count], out_count[1].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND,
/// PLANISH_STATUS_BUFFER_TOO_SMALL (nothing is made), PLANISH_STATUS_NOT_FINITE (a number would overflow),
/// PLANISH_STATUS_VERSION or PLANISH_STATUS_CANCELLED.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_pht_to_tensor_patches(
    surface: *const planish_surface,
    options: *const planish_pht_patches_options,
    out_surfaces: *mut *mut planish_surface,
    count: usize,
    out_count: *mut usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let pht = deref(surface, "surface")?.pht()?;
        let out_count = out(out_count, "out_count")?;
        let given = self::options(options)?;
        if given.reserved != 0 {
            let record = "planish_pht_patches_options";
            return Err(ArgumentError::Reserved { record, given: given.reserved }.into());
        }
        // results are the same for any number of threads, and one is enough
        let patches = with_helper(listener!(given), |control| {
            control.enter(Stage::Convert);
            pht.to_tensor_patches_watched(given.level_spread, control.pool().watch())
        })??;
        if !out_surfaces.is_null() {
            let handles = rows_mut(out_surfaces, count, patches.len(), 1, "out_surfaces")?;
            out_count.write(patches.len());
            for (handle, patch) in handles.iter_mut().zip(patches) {
                *handle = planish_surface::into_raw(patch);
            }
        } else {
            out_count.write(patches.len());
        }
        Ok(())
    })
}

/// An edge of a surface's domain.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_border_side {
    /// Least u.
    LowU = 0,
    /// Largest u.
    HighU = 1,
    /// Least v.
    LowV = 2,
    /// Largest v.
    HighV = 3,
}

/// Makes two PHT-splines meet with common tangents along an edge of each: both get the same vertices there, by
/// splits, and the means of their positions and derivatives. Changes neither if they cannot be stitched.
///
/// first:       not NULL, not second; changed.
/// first_side:  a planish_border_side.
/// second:      not NULL; changed.
/// second_side: a planish_border_side.
/// is_reversed: 1 if the edges run in opposite directions, else 0.
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND or
/// PLANISH_STATUS_INVALID_ARGUMENT (a side; the dimensions or the initial grids along the edges differ).
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_pht_stitch(
    first: *mut planish_surface,
    first_side: u32,
    second: *mut planish_surface,
    second_side: u32,
    is_reversed: u32,
) -> planish_status {
    // SAFETY: the caller's promises; that the handles differ is checked first.
    guard(|| unsafe {
        if std::ptr::eq(first, second) && !first.is_null() {
            return Err(ArgumentError::NotTwo { name: "second" }.into());
        }
        let side = |given, name| {
            use BorderSide::{HighU, HighV, LowU, LowV};
            choice(given, &[LowU, HighU, LowV, HighV], name)
        };
        let first_side = side(first_side, "first_side")?;
        let second_side = side(second_side, "second_side")?;
        let is_reversed = flag(is_reversed, "is_reversed")?;
        let first = deref_mut(first, "first")?.pht_mut()?;
        let second = deref_mut(second, "second")?.pht_mut()?;
        Ok(stitch((first, first_side), (second, second_side), is_reversed)?)
    })
}
