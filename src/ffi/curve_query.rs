//! What can be asked of curves, and their files.

use super::arguments::{
    self, ArgumentError, array_len, copy_rows, deref, options, out, slice, slice_mut, slice_mut_or_none,
};
use super::curve::{planish_curve, query_curve};
use super::guard::guard;
use super::progress::thread_count;
use super::query::status_of;
use super::{planish_project_options, planish_status};
use crate::control::Pool;
use crate::curve::Curve;
use crate::export::native;
use crate::query::project::{ProjectOptions, piece_count};
use glam::DVec2;
use libc::{c_char, c_void};

/// Length of a curve, but for 1e-12 of it and the roundoff of its coordinates; 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_curve_length(curve: *const planish_curve) -> f64 {
    // SAFETY: the caller's promise.
    unsafe { query_curve(curve, Curve::length) }
}

/// The lengths of a curve from its start to parameters, as exact as planish_curve_length().
///
/// curve:       not NULL.
/// u:           count parameters in the domain, in any order.
/// count:       may be 0.
/// out_lengths: receives count lengths.
/// Arrays: u[count], out_lengths[count].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_NOT_FINITE or PLANISH_STATUS_OUTSIDE (the
/// index is the parameter for both).
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_curve_arc_lengths(
    curve: *const planish_curve,
    u: *const f64,
    count: usize,
    out_lengths: *mut f64,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let curve = deref(curve, "curve")?.core();
        let u = slice(u, count, "u")?;
        let out_lengths = slice_mut(out_lengths, count, "out_lengths")?;
        out_lengths.copy_from_slice(&curve.lengths_to(u)?);
        Ok(())
    })
}

/// Finds the place on a curve nearest to each point, anywhere on the curve: there is no start to choose, and no local
/// minimum to fall into.
///
/// curve:         not NULL.
/// points:        count rows of planish_curve_dim() doubles.
/// count:         number of points; with 0 nothing is done.
/// options:       NULL for the defaults. guesses are count parameters u; keep_trims is not used.
/// out_u:         receives count parameters; NULL for none.
/// out_distances: receives count distances; NULL for none.
/// Arrays: points[count, curve_dim], out_u[count], out_distances[count].
/// Returns what planish_surface_project() returns, but for PLANISH_STATUS_WRONG_KIND.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_curve_project(
    curve: *const planish_curve,
    points: *const f64,
    count: usize,
    options: *const planish_project_options,
    out_u: *mut f64,
    out_distances: *mut f64,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let curve = deref(curve, "curve")?;
        let given = self::options(options)?;
        let points = slice(points, array_len::<f64>(count, curve.core().dim(), "points")?, "points")?;
        let guesses = match given.guesses.is_null() {
            true => None,
            false => Some(copy_rows(given.guesses, count, 1, "guesses", |[u]| DVec2::new(u, 0.0))?),
        };
        let max_distance = given.max_distance;
        let core = ProjectOptions { guesses: guesses.as_deref(), max_distance, keep_trims: false };
        let pool = Pool::for_pieces(thread_count(given.thread_count)?, piece_count(count));
        let out_u = slice_mut_or_none(out_u, count, "out_u")?;
        let out_distances = slice_mut_or_none(out_distances, count, "out_distances")?;
        let out_flags = slice_mut_or_none(given.out_flags, count, "out_flags")?;
        let projection = curve.projector().project(points, &core, &pool)?;
        if let Some(out_u) = out_u {
            out_u.iter_mut().zip(&projection.uv).for_each(|(out, uv)| *out = uv.x);
        }
        if let Some(out_distances) = out_distances {
            out_distances.copy_from_slice(&projection.distances);
        }
        if let Some(out_flags) = out_flags {
            out_flags.copy_from_slice(&projection.flags);
        }
        Ok(status_of(&projection))
    })
}

/// How many bytes planish_curve_save() writes; 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_curve_save_size(curve: *const planish_curve) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_curve(curve, native::save_size) }
}

/// Writes everything a curve is into a buffer, to the bit. The layout is documented in docs/format.md; it is the same
/// on all machines.
///
/// curve:  not NULL.
/// buffer: receives planish_curve_save_size() bytes.
/// size:   bytes that the buffer has room for.
/// Arrays: buffer[size].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_curve_save(
    curve: *const planish_curve,
    buffer: *mut c_void,
    size: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let curve = deref(curve, "curve")?.core();
        let needed = native::save_size(curve);
        if size < needed {
            return Err(ArgumentError::TooSmall { name: "buffer", given: size, needed }.into());
        }
        slice_mut(buffer.cast::<u8>(), needed, "buffer")?.copy_from_slice(&native::save(curve));
        Ok(())
    })
}

/// Makes a curve from bytes of planish_curve_save(). Damaged bytes are refused, sizes are checked before memory is
/// asked for.
///
/// buffer:    size bytes.
/// out_curve: receives a new curve; destroy with planish_curve_free().
/// Arrays: buffer[size].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_FORMAT (the index is the byte) or
/// PLANISH_STATUS_VERSION (a later library made it).
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_curve_load(
    buffer: *const c_void,
    size: usize,
    out_curve: *mut *mut planish_curve,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let bytes = slice(buffer.cast::<u8>(), size, "buffer")?;
        let out_curve = out(out_curve, "out_curve")?;
        out_curve.write(planish_curve::into_raw(native::load_curve(bytes)?));
        Ok(())
    })
}

/// Writes the bytes of planish_curve_save() to a file, which appears whole or not at all.
///
/// curve: not NULL.
/// path:  ends with a NUL; on Unix any bytes, elsewhere UTF-8. An existing file is replaced, see planish_mesh_write().
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (the path is not UTF-8) or
/// PLANISH_STATUS_FILE.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_curve_save_file(
    curve: *const planish_curve,
    path: *const c_char,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let curve = deref(curve, "curve")?.core();
        Ok(native::save_file(curve, arguments::path(path, "path")?)?)
    })
}

/// Makes a curve from a file of planish_curve_save_file().
///
/// path:      ends with a NUL; on Unix any bytes, elsewhere UTF-8.
/// out_curve: receives a new curve; destroy with planish_curve_free().
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (the path is not UTF-8),
/// PLANISH_STATUS_FILE, PLANISH_STATUS_FORMAT (the index is the byte) or PLANISH_STATUS_VERSION.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_curve_load_file(
    path: *const c_char,
    out_curve: *mut *mut planish_curve,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let path = arguments::path(path, "path")?;
        let out_curve = out(out_curve, "out_curve")?;
        out_curve.write(planish_curve::into_raw(native::load_curve_file(path)?));
        Ok(())
    })
}
