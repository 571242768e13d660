//! Tensor surfaces from their parts, their parts, and edits that keep or cut the surface.

use super::arguments::{ArgumentError, array_len, choice, copy, deref, deref_mut, out, rows_mut, slice};
use super::guard::{Failure, guard};
use super::planish_status;
use super::surface::{planish_surface, query_surface};
use crate::knots::KnotVector;
use crate::surface::tensor::{Axis, TensorError, TensorSurface};

/// A parameter direction.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_axis {
    /// The first parameter.
    U = 0,
    /// The second parameter.
    V = 1,
}

/// Makes a tensor surface from its parts, which are copied.
///
/// dim:            numbers of a control point, at least 1.
/// degree_u:       1 to 9.
/// degree_v:       1 to 9.
/// knots_u:        knot_count_u knots that do not decrease, none more than degree_u + 1 times.
/// knot_count_u:   at least 2 * (degree_u + 1); there are knot_count_u - degree_u - 1 control points along u.
/// knots_v:        knot_count_v knots that do not decrease, none more than degree_v + 1 times.
/// knot_count_v:   at least 2 * (degree_v + 1); there are knot_count_v - degree_v - 1 control points along v.
/// control_points: rows of dim numbers, v running fastest, not multiplied by weights.
/// weights:        one positive number for each control point in the same order; NULL for a polynomial surface.
/// out_surface:    receives a new surface; destroy with planish_surface_free().
/// Arrays: knots_u[knot_count_u], knots_v[knot_count_v],
///         control_points[knot_count_u - degree_u - 1, knot_count_v - degree_v - 1, dim],
///         weights[knot_count_u - degree_u - 1, knot_count_v - degree_v - 1].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (dim, a degree, a
/// count, a knot, a weight; the index is the knot or the control point), PLANISH_STATUS_NOT_FINITE (likewise),
/// PLANISH_STATUS_DEGENERATE (the knots span no interval), PLANISH_STATUS_TOO_LARGE or
/// PLANISH_STATUS_OUT_OF_MEMORY.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_tensor_new(
    dim: usize,
    degree_u: u32,
    degree_v: u32,
    knots_u: *const f64,
    knot_count_u: usize,
    knots_v: *const f64,
    knot_count_v: usize,
    control_points: *const f64,
    weights: *const f64,
    out_surface: *mut *mut planish_surface,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let out_surface = out(out_surface, "out_surface")?;
        if dim == 0 {
            return Err(TensorError::Dimension.into());
        }
        let knots = |at, count, degree: u32, axis| -> Result<KnotVector, Failure> {
            let name = if axis == Axis::U { "knots_u" } else { "knots_v" };
            let knots = KnotVector::new(copy(at, count, name)?, degree as usize);
            Ok(knots.map_err(|error| TensorError::Knots { axis, error })?)
        };
        let knots_u = knots(knots_u, knot_count_u, degree_u, Axis::U)?;
        let knots_v = knots(knots_v, knot_count_v, degree_v, Axis::V)?;
        let count = array_len::<f64>(knots_u.basis_count(), knots_v.basis_count(), "control_points")?;
        let len = array_len::<f64>(count, dim, "control_points")?;
        let control_points = copy(control_points, len, "control_points")?;
        let weights = if weights.is_null() { None } else { Some(copy(weights, count, "weights")?) };
        let tensor = TensorSurface::new(dim, knots_u, knots_v, control_points, weights)?;
        out_surface.write(planish_surface::into_raw(tensor));
        Ok(())
    })
}

fn axis(given: u32) -> Result<Axis, ArgumentError> {
    choice(given, &[Axis::U, Axis::V], "axis")
}

/// Degree of a tensor surface; 0 for NULL, another family or an axis that does not exist.
///
/// axis: a planish_axis.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_tensor_degree(surface: *const planish_surface, axis: u32) -> u32 {
    // SAFETY: the caller's promise.
    unsafe {
        query_surface(surface, |surface| Ok(surface.tensor()?.knots(self::axis(axis)?).degree() as u32))
    }
}

/// Number of knots of a tensor surface, each as often as it occurs; 0 for NULL, another family or an axis that
/// does not exist.
///
/// axis: a planish_axis.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_tensor_knot_count(surface: *const planish_surface, axis: u32) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_surface(surface, |surface| Ok(surface.tensor()?.knots(self::axis(axis)?).knots().len())) }
}

/// Number of control points of a tensor surface along one axis; 0 for NULL, another family or an axis that does
/// not exist. planish_surface_coefficient_count() is the product of both.
///
/// axis: a planish_axis.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_tensor_control_point_count(
    surface: *const planish_surface,
    axis: u32,
) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_surface(surface, |surface| Ok(surface.tensor()?.knots(self::axis(axis)?).basis_count())) }
}

/// Copies the knots of a tensor surface.
///
/// surface:   not NULL.
/// axis:      a planish_axis.
/// out_knots: receives planish_tensor_knot_count() knots.
/// count:     knots that out_knots has room for.
/// Arrays: out_knots[tensor_knot_count].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (the axis),
/// PLANISH_STATUS_WRONG_KIND or PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_tensor_copy_knots(
    surface: *const planish_surface,
    axis: u32,
    out_knots: *mut f64,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let knots = deref(surface, "surface")?.tensor()?.knots(self::axis(axis)?).knots();
        rows_mut(out_knots, count, knots.len(), 1, "out_knots")?.copy_from_slice(knots);
        Ok(())
    })
}

/// Copies the control points of a tensor surface.
///
/// surface:            not NULL.
/// out_control_points: receives planish_surface_coefficient_count() rows of dim numbers, v running fastest, not
///                     multiplied by weights.
/// count:              rows that out_control_points has room for.
/// Arrays: out_control_points[surface_coefficient_count, surface_dim].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND or
/// PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_tensor_copy_control_points(
    surface: *const planish_surface,
    out_control_points: *mut f64,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let surface = deref(surface, "surface")?;
        let (tensor, any) = (surface.tensor()?, surface.any());
        let needed = any.coefficient_count();
        let rows = rows_mut(out_control_points, count, needed, any.dim(), "out_control_points")?;
        rows.copy_from_slice(tensor.control_points());
        Ok(())
    })
}

/// 1 if a tensor surface has weights, else 0; 0 for NULL and other families.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_tensor_has_weights(surface: *const planish_surface) -> u32 {
    // SAFETY: the caller's promise.
    unsafe { query_surface(surface, |surface| Ok(surface.tensor()?.weights().is_some().into())) }
}

/// Copies the weights of a tensor surface; all are 1 if it is polynomial.
///
/// surface:     not NULL.
/// out_weights: receives planish_surface_coefficient_count() weights, in the order of the control points.
/// count:       weights that out_weights has room for.
/// Arrays: out_weights[surface_coefficient_count].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND or
/// PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_tensor_copy_weights(
    surface: *const planish_surface,
    out_weights: *mut f64,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let surface = deref(surface, "surface")?;
        let tensor = surface.tensor()?;
        let out_weights = rows_mut(out_weights, count, surface.any().coefficient_count(), 1, "out_weights")?;
        match tensor.weights() {
            Some(weights) => out_weights.copy_from_slice(weights),
            None => out_weights.fill(1.0),
        }
        Ok(())
    })
}

/// Inserts knots into a tensor surface, which stays the same surface.
///
/// surface: not NULL; changed.
/// axis:    a planish_axis.
/// knots:   count parameters in the domain, in any order. Inside the domain no knot may occur more than degree
///          times afterwards; at its ends degree + 1 times, which clamps.
/// count:   may be 0.
/// Arrays: knots[count].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND,
/// PLANISH_STATUS_INVALID_ARGUMENT (the axis, or a knot would occur too often), PLANISH_STATUS_NOT_FINITE (the
/// index is that of knots) or PLANISH_STATUS_OUTSIDE.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_tensor_insert_knots(
    surface: *mut planish_surface,
    axis: u32,
    knots: *const f64,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let tensor = deref_mut(surface, "surface")?.tensor_mut()?;
        *tensor = tensor.insert_knots(self::axis(axis)?, slice(knots, count, "knots")?)?;
        Ok(())
    })
}

/// Raises the degree of a tensor surface along one axis, which stays the same surface.
///
/// surface: not NULL; changed.
/// axis:    a planish_axis.
/// degree:  from the present degree to 9.
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND or
/// PLANISH_STATUS_INVALID_ARGUMENT (the axis, the degree).
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_tensor_elevate_degree(
    surface: *mut planish_surface,
    axis: u32,
    degree: u32,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let tensor = deref_mut(surface, "surface")?.tensor_mut()?;
        *tensor = tensor.elevate_degree(self::axis(axis)?, degree as usize)?;
        Ok(())
    })
}

/// Turns a tensor surface round along one axis: the same points over the same domain in the other direction, trims
/// included. Normals turn round.
///
/// surface: not NULL; changed.
/// axis:    a planish_axis.
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND,
/// PLANISH_STATUS_INVALID_ARGUMENT (the axis) or PLANISH_STATUS_DEGENERATE (the domain is so short that it has no
/// length after rounding).
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_tensor_reverse(surface: *mut planish_surface, axis: u32) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let tensor = deref_mut(surface, "surface")?.tensor_mut()?;
        *tensor = tensor.reverse(self::axis(axis)?)?;
        Ok(())
    })
}

/// Makes the two parts of a tensor surface below and above a parameter. Each keeps its side of the trims: a loop
/// that crosses the cut is closed along it, and a part beyond all loops gets one loop without area.
///
/// surface:   not NULL.
/// axis:      a planish_axis: the parameter that is cut.
/// at:        inside the domain, not at its ends.
/// out_lower: receives a new surface; destroy with planish_surface_free().
/// out_upper: receives a new surface; destroy with planish_surface_free().
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND,
/// PLANISH_STATUS_INVALID_ARGUMENT (the axis) or PLANISH_STATUS_OUTSIDE (at, also if it is NaN).
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_tensor_split(
    surface: *const planish_surface,
    axis: u32,
    at: f64,
    out_lower: *mut *mut planish_surface,
    out_upper: *mut *mut planish_surface,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let tensor = deref(surface, "surface")?.tensor()?;
        let (out_lower, out_upper) = (out(out_lower, "out_lower")?, out(out_upper, "out_upper")?);
        let [lower, upper] = tensor.split(self::axis(axis)?, at)?;
        out_lower.write(planish_surface::into_raw(lower));
        out_upper.write(planish_surface::into_raw(upper));
        Ok(())
    })
}
