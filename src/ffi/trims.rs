//! The trims of a surface.

use super::arguments::{ArgumentError, copy_rows, deref, deref_mut, rows_mut, slice};
use super::guard::guard;
use super::planish_status;
use super::report::write_pairs;
use super::surface::{planish_surface, query_surface};
use crate::surface::{Surface, Trims};
use glam::DVec2;

/// Number of trims: closed polylines in the parameter plane that bound the part of the surface that counts. A
/// surface made from a mesh has the mesh's boundary loops. 0 if the whole domain counts, and for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_trim_count(surface: *const planish_surface) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_surface(surface, |surface| Ok(surface.any().region().trims.loops().len())) }
}

fn trim(surface: &dyn Surface, index: usize) -> Result<&[DVec2], ArgumentError> {
    let loops = surface.region().trims.loops();
    let missing = ArgumentError::NoSuch { name: "trim", index, count: loops.len() };
    loops.get(index).map(Vec::as_slice).ok_or(missing)
}

/// Number of points of a trim; 0 for NULL or a trim that does not exist.
///
/// trim: below planish_surface_trim_count(); trim 0 is the outer one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_trim_point_count(
    surface: *const planish_surface,
    trim: usize,
) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_surface(surface, |surface| Ok(self::trim(surface.any(), trim)?.len())) }
}

/// Copies the points of a trim in order. The first is not repeated.
///
/// surface: not NULL.
/// trim:    below planish_surface_trim_count(); trim 0 is the outer one.
/// out_uv:  receives planish_surface_trim_point_count() rows of u, v.
/// count:   rows that out_uv has room for.
/// Arrays: out_uv[surface_trim_point_count, 2].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INDEX (the trim) or
/// PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_copy_trim(
    surface: *const planish_surface,
    trim: usize,
    out_uv: *mut f64,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let points = self::trim(deref(surface, "surface")?.any(), trim)?;
        write_pairs(points, rows_mut(out_uv, count, points.len(), 2, "out_uv")?);
        Ok(())
    })
}

/// Replaces the trims. A point counts when a ray from it crosses the trims an odd number of times, so the
/// outer one and holes may run in any direction.
///
/// surface:      not NULL; changed.
/// uv:           rows of u, v inside the domain, trim after trim, the first point of a trim not repeated.
///               Copied.
/// point_counts: trim_count numbers of points, each at least 3.
/// trim_count:   0 removes all trims.
/// Arrays: uv[*, 2], point_counts[trim_count].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (a trim of fewer
/// than 3 points), PLANISH_STATUS_NOT_FINITE, PLANISH_STATUS_OUTSIDE (the index is the trim for all three),
/// PLANISH_STATUS_TOO_LARGE or PLANISH_STATUS_OUT_OF_MEMORY.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_set_trims(
    surface: *mut planish_surface,
    uv: *const f64,
    point_counts: *const usize,
    trim_count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let surface = deref_mut(surface, "surface")?.any_mut();
        let point_counts = slice(point_counts, trim_count, "point_counts")?;
        let total = point_counts.iter().try_fold(0_usize, |sum, &count| sum.checked_add(count));
        let name = "uv";
        let total = total.ok_or(ArgumentError::Overflow { name, count: usize::MAX, width: trim_count })?;
        let mut rest = copy_rows(uv, total, 2, name, DVec2::from_array)?.into_iter();
        let loops = point_counts.iter().map(|&count| rest.by_ref().take(count).collect()).collect();
        surface.region_mut().trims = Trims::new(loops, &surface.domain())?;
        Ok(())
    })
}
