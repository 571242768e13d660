//! Evaluation of surfaces.

use super::arguments::{
    ArgumentError, array_len, choice, deref, options, slice, slice_mut, slice_mut_or_none, stride,
    strided_len,
};
use super::guard::{Failure, guard};
use super::planish_status;
use super::progress::thread_count;
use super::surface::planish_surface;
use crate::control::Pool;
use crate::query::project::FLAG_NOT_PROVEN;
use crate::surface::evaluate::{
    FLAG_IN_BUFFER, FLAG_NO_NORMAL, FLAG_OUTSIDE_DOMAIN, FLAG_OUTSIDE_TRIMS, Output, OutsideRule, Points,
    Quantity, evaluate, piece_count,
};
use crate::surface::{MAX_DERIVATIVE, Surface};

/// What to do with points outside the domain.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_outside {
    /// Refuse all points, before one value is written.
    Fail = 0,
    /// NaN and a flag; the call returns PLANISH_STATUS_POINTS_OUTSIDE.
    Flag = 1,
    /// The polynomial at the domain's end is continued, and the point flagged.
    /// A D1RC-spline, whose domain are the faces of its control mesh, is continued by its tangent plane at the nearest
    /// place of the border.
    Extrapolate = 2,
}

/// Flags of a point: bits of the elements of out_flags.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_flag {
    /// The parameters lie outside the domain.
    OutsideDomain = 1,
    /// The point lies outside the trims: in a hole, or beyond the boundary of the data.
    OutsideTrims = 2,
    /// The parameters lie in the domain but beyond the box of the data: the surface is extrapolated there.
    InBuffer = 4,
    /// The surface has no normal there, so that normal and curvatures are NaN.
    NoNormal = 8,
    /// The answer for the point is not proved: the distance is that of a place on the surface, and the least one may
    /// be smaller.
    NotProven = 16,
}

const _: () = {
    assert!(planish_flag::OutsideDomain as u8 == FLAG_OUTSIDE_DOMAIN);
    assert!(planish_flag::OutsideTrims as u8 == FLAG_OUTSIDE_TRIMS);
    assert!(planish_flag::InBuffer as u8 == FLAG_IN_BUFFER);
    assert!(planish_flag::NoNormal as u8 == FLAG_NO_NORMAL);
    assert!(planish_flag::NotProven as u8 == FLAG_NOT_PROVEN);
};

record! {
    /// How points are evaluated. Fill with planish_eval_options_init(), then change what you need.
    pub struct planish_eval_options (planish_eval_options_init) {
        /// Doubles from one point to the next in `uv`; at least 2, or 0 (default) for 2. Must be 0 for grids.
        pub uv_stride: usize,
        /// Doubles from one point's results to the next; at least as many as a point has, or 0 (default) for
        /// exactly so many. What lies between is left alone.
        pub out_stride: usize,
        /// Receives bits of planish_flag, one element for each point; NULL (default) for none.
        /// Array: [points].
        pub out_flags: *mut u8,
        /// A planish_outside. Default PLANISH_OUTSIDE_FAIL.
        pub outside: u32 = planish_outside::Fail as u32,
        /// Threads to use, at most 1024; 0 (default) for all cores. Results do not depend on it, and fewer than
        /// about a thousand points are evaluated on the calling thread alone.
        pub thread_count: u32,
    }
}

impl planish_eval_options {
    /// What to do with points outside.
    pub(super) fn rule(&self) -> Result<OutsideRule, ArgumentError> {
        let rules = [OutsideRule::Fail, OutsideRule::Flag, OutsideRule::Extrapolate];
        choice(self.outside, &rules, "outside")
    }

    /// Where `width` numbers for each of `count` points go, and their flags.
    ///
    /// # Safety
    /// `out` and the flags are NULL or as the header says, for so many points.
    pub(super) unsafe fn output<'a>(
        &self,
        (out, name): (*mut f64, &'static str),
        count: usize,
        width: usize,
    ) -> Result<Output<'a>, ArgumentError> {
        let stride = stride(self.out_stride, width, "out_stride")?;
        let len = strided_len::<f64>(count, stride, width, name)?;
        // SAFETY: the caller's promise.
        let (rows, flags) =
            unsafe { (slice_mut(out, len, name)?, slice_mut_or_none(self.out_flags, count, "out_flags")?) };
        Ok(Output { rows, stride, flags: flags.unwrap_or(&mut []) })
    }
}

/// The status of values of which so many belong to points outside.
pub(super) fn status_of_values(rule: OutsideRule, outside: usize) -> planish_status {
    let has_nan = rule == OutsideRule::Flag && outside > 0;
    if has_nan { planish_status::PointsOutside } else { planish_status::Ok }
}

/// The order that max_derivative asks for.
pub(super) fn derivative_order(given: u32, largest: usize) -> Result<usize, ArgumentError> {
    let order = given as usize;
    if order > largest {
        return Err(ArgumentError::Limit { name: "max_derivative", given: order, largest });
    }
    Ok(order)
}

/// Evaluates at points that are already borrowed.
///
/// # Safety
/// `out` and the options' flags are NULL or as the header says, for all points.
unsafe fn eval(
    surface: &dyn Surface,
    quantity: Quantity,
    points: Points,
    options: &planish_eval_options,
    out: *mut f64,
    name: &'static str,
) -> Result<planish_status, Failure> {
    let (count, rule) = (points.count(), options.rule()?);
    // SAFETY: the caller's promise.
    let output = unsafe { options.output((out, name), count, quantity.width(surface.dim())) }?;
    let pool = Pool::for_pieces(thread_count(options.thread_count)?, piece_count(count));
    let outside = evaluate(surface, quantity, points, rule, output, &pool)?;
    Ok(status_of_values(rule, outside))
}

/// Evaluates at rows of u and v.
///
/// # Safety
/// The pointers are NULL or as the header says.
unsafe fn eval_points(
    surface: *const planish_surface,
    quantity: Quantity,
    uv: *const f64,
    count: usize,
    options: *const planish_eval_options,
    out: *mut f64,
    name: &'static str,
) -> Result<planish_status, Failure> {
    // SAFETY: the caller's promises.
    unsafe {
        let surface = deref(surface, "surface")?.any();
        let options = self::options(options)?;
        let uv_stride = stride(options.uv_stride, 2, "uv_stride")?;
        let uv = slice(uv, strided_len::<f64>(count, uv_stride, 2, "uv")?, "uv")?;
        eval(surface, quantity, Points::new(uv, uv_stride, count), &options, out, name)
    }
}

/// Evaluates the surface at points.
///
/// surface:    not NULL.
/// uv:         count rows of u, v; rows start options->uv_stride doubles apart.
/// count:      may be 0.
/// options:    NULL for the defaults.
/// out_values: receives count rows of dim numbers; rows start options->out_stride doubles apart. It must not
///             overlap uv.
/// Arrays: uv[count, 2], out_values[count, surface_dim].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_POINTS_OUTSIDE (with PLANISH_OUTSIDE_FLAG; the values of those
/// points are NaN) or an error: PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option),
/// PLANISH_STATUS_OUTSIDE (with PLANISH_OUTSIDE_FAIL; the index is the first such point),
/// PLANISH_STATUS_NOT_FINITE (u or v, unless PLANISH_OUTSIDE_FLAG; the index is the point),
/// PLANISH_STATUS_TOO_LARGE (count times stride) or PLANISH_STATUS_VERSION.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_eval(
    surface: *const planish_surface,
    uv: *const f64,
    count: usize,
    options: *const planish_eval_options,
    out_values: *mut f64,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe { eval_points(surface, Quantity::Values, uv, count, options, out_values, "out_values") })
}

/// Evaluates the surface and its derivatives at points.
///
/// surface:        not NULL.
/// uv:             count rows of u, v; rows start options->uv_stride doubles apart.
/// count:          may be 0.
/// max_derivative: 0, 1 or 2.
/// options:        NULL for the defaults.
/// out:            receives for each point 1, 3 or 6 rows of dim numbers: S; Su, Sv; Suu, Suv, Svv. Points
///                 start options->out_stride doubles apart. It must not overlap uv.
/// Arrays: uv[count, 2], out[count, *, surface_dim].
/// Returns what planish_surface_eval() returns; PLANISH_STATUS_INVALID_ARGUMENT also for max_derivative.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_eval_derivatives(
    surface: *const planish_surface,
    uv: *const f64,
    count: usize,
    max_derivative: u32,
    options: *const planish_eval_options,
    out: *mut f64,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let order = derivative_order(max_derivative, MAX_DERIVATIVE)?;
        eval_points(surface, Quantity::Derivatives(order), uv, count, options, out, "out")
    })
}

/// Evaluates the surface at all pairs of some u and some v.
///
/// surface:    not NULL.
/// u, u_count: parameters along u; may be none.
/// v, v_count: parameters along v; may be none.
/// options:    NULL for the defaults; uv_stride must be 0.
/// out_values: receives u_count * v_count rows of dim numbers, v running fastest; rows start
///             options->out_stride doubles apart. It must not overlap u or v.
/// Arrays: u[u_count], v[v_count], out_values[u_count, v_count, surface_dim].
/// Returns what planish_surface_eval() returns; the index of a point counts as the rows of out_values do.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_eval_grid(
    surface: *const planish_surface,
    u: *const f64,
    u_count: usize,
    v: *const f64,
    v_count: usize,
    options: *const planish_eval_options,
    out_values: *mut f64,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let surface = deref(surface, "surface")?.any();
        let options = self::options(options)?;
        if options.uv_stride != 0 {
            let (name, given) = ("uv_stride", options.uv_stride);
            return Err(ArgumentError::Limit { name, given, largest: 0 }.into());
        }
        array_len::<f64>(u_count, v_count, "out_values")?;
        let points = Points::grid(slice(u, u_count, "u")?, slice(v, v_count, "v")?);
        eval(surface, Quantity::Values, points, &options, out_values, "out_values")
    })
}

/// Computes unit normals Su x Sv / |Su x Sv| of a surface in space.
///
/// surface:     not NULL, of dim 3.
/// uv:          count rows of u, v; rows start options->uv_stride doubles apart.
/// count:       may be 0.
/// options:     NULL for the defaults.
/// out_normals: receives count rows of 3 numbers, NaN where Su and Sv are parallel; rows start
///              options->out_stride doubles apart. It must not overlap uv.
/// Arrays: uv[count, 2], out_normals[count, 3].
/// Returns what planish_surface_eval() returns; PLANISH_STATUS_INVALID_ARGUMENT also if dim is not 3.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_normals(
    surface: *const planish_surface,
    uv: *const f64,
    count: usize,
    options: *const planish_eval_options,
    out_normals: *mut f64,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        eval_points(surface, Quantity::Normals, uv, count, options, out_normals, "out_normals")
    })
}

/// Computes principal curvatures and their directions of a surface in space.
///
/// surface: not NULL, of dim 3.
/// uv:      count rows of u, v; rows start options->uv_stride doubles apart.
/// count:   may be 0.
/// options: NULL for the defaults.
/// out:     receives count rows of 8 numbers: k1, k2 with k1 >= k2, positive where the surface bends towards
///          its normal, then the unit tangents d1 and d2 of 3 numbers each, with d1 x d2 the normal; NaN where
///          there is no normal. Rows start options->out_stride doubles apart. It must not overlap uv.
/// Arrays: uv[count, 2], out[count, 8].
/// Returns what planish_surface_eval() returns; PLANISH_STATUS_INVALID_ARGUMENT also if dim is not 3.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_curvatures(
    surface: *const planish_surface,
    uv: *const f64,
    count: usize,
    options: *const planish_eval_options,
    out: *mut f64,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe { eval_points(surface, Quantity::Curvatures, uv, count, options, out, "out") })
}
