//! B-spline curves.

use super::arguments::{
    ArgumentError, array_len, choice, copy, deref, options, out, rows_mut, slice, slice_mut, slice_or_none,
    stride, strided_len,
};
use super::choices::{ends, planish_ends, planish_tensor_method, planish_tolerance_scale, tolerance};
use super::guard::{Failure, guard};
use super::progress::{thread_count, with_control};
use super::report::{FitOutputs, planish_fit_report};
use super::status::query;
use super::surface_eval::{derivative_order, status_of_values};
use super::{planish_eval_options, planish_flag, planish_progress, planish_section_ends, planish_status};
use crate::curve::{Curve, EndRule, MAX_DERIVATIVE, interpolate};
use crate::fit::common::uniform::Method;
use crate::fit::curve::{CurveOptions, fit_curve};
use crate::knots::KnotVector;
use crate::query::project::Projector;
use crate::surface::evaluate::{Output, OutsideRule};
use libc::c_void;
use std::sync::OnceLock;

/// A B-spline curve: a map from an interval of parameters u to R^dim. Made by planish_curve_fit(),
/// planish_curve_interpolate(), planish_curve_new() or planish_curve_load(), destroyed by planish_curve_free().
///
/// Calls that take it const may run at once on any threads.
/// The first projection onto it builds an index, which it keeps.
pub struct planish_curve {
    curve: Curve,
    /// Made when first needed; a curve does not change.
    projector: OnceLock<Projector>,
}

const _: () = {
    const fn is_shared<T: Send + Sync>() {}
    is_shared::<planish_curve>();
};

impl planish_curve {
    pub(super) fn into_raw(curve: Curve) -> *mut Self {
        Box::into_raw(Box::new(Self { curve, projector: OnceLock::new() }))
    }

    pub(super) fn core(&self) -> &Curve {
        &self.curve
    }

    /// What projects onto it; the first call makes it.
    pub(super) fn projector(&self) -> &Projector {
        self.projector.get_or_init(|| Projector::of_curve(&self.curve))
    }
}

record! {
    /// Options of curve fits. Fill with planish_curve_options_init(), then change what you need.
    pub struct planish_curve_options (planish_curve_options_init; core: CurveOptions) {
        /// The largest error allowed at the data, positive, measured in tolerance_scale. Default 1e-3.
        pub tolerance: f64 = core.tolerance.value,
        /// Weight of the bending energy; 0 (default) takes the largest of 1e-3, 1e-4, 1e-5, 1e-6 that meets the
        /// tolerance (for PLANISH_TENSOR_METHOD_FERGUSON 1e-3).
        pub smoothing: f64 = core.smoothing,
        /// How far the knots reach beyond the data, as a fraction of the data's range, 0 to 10. Default 0.1.
        pub buffer: f64 = core.buffer,
        /// A positive weight for each datum; NULL (default) for all 1.
        /// Array: [data].
        pub weights: *const f64,
        /// Hears of the progress and may cancel; NULL (default) for nobody.
        pub progress: planish_progress,
        /// Handed to progress as it is.
        pub user: *mut c_void,
        /// Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
        pub cancel: *const i32,
        /// Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
        /// Array: [1].
        pub out_stage: *mut u32,
        /// Receives the error of each datum in model units: one number for each datum, or NULL (default). Written
        /// on success only.
        /// Array: [data].
        pub out_errors: *mut f64,
        /// A planish_tolerance_scale. Default PLANISH_TOLERANCE_SCALE_RELATIVE.
        pub tolerance_scale: u32 = planish_tolerance_scale::Relative as u32,
        /// A planish_tensor_method. Default PLANISH_TENSOR_METHOD_LEAST_SQUARES.
        pub method: u32 = planish_tensor_method::LeastSquares as u32,
        /// A planish_ends. Default PLANISH_ENDS_NATURAL.
        pub ends: u32 = planish_ends::Natural as u32,
        /// Most knots, at least 2. Default 257.
        pub max_grid: u32 = core.max_grid as u32,
        /// Knots to use without refinement, 2 to 8193; 0 (default) refines.
        pub grid: u32,
        /// Threads to use, at most 1024; 0 (default) for all cores. Results do not depend on it.
        pub thread_count: u32,
    }
}

impl planish_curve_options {
    /// # Safety
    /// The weights are NULL or `count` numbers, until the options are no longer used.
    unsafe fn to_core<'a>(self, count: usize) -> Result<CurveOptions<'a>, ArgumentError> {
        Ok(CurveOptions {
            tolerance: tolerance(self.tolerance, self.tolerance_scale)?,
            method: choice(self.method, &[Method::LeastSquares, Method::Ferguson], "method")?,
            ends: ends(self.ends)?,
            smoothing: self.smoothing,
            buffer: self.buffer,
            max_grid: self.max_grid as usize,
            fixed_count: (self.grid != 0).then_some(self.grid as usize),
            // SAFETY: the caller's promise.
            weights: unsafe { slice_or_none(self.weights, count, "weights") }?,
        })
    }
}

/// Fits a cubic curve to values at parameters, by the method of planish_tensor_fit() in one parameter.
///
/// u:          count parameters, in any order.
/// values:     count rows of dim numbers.
/// count:      at least 3.
/// dim:        numbers of a value, at least 1.
/// options:    NULL for the defaults.
/// out_curve:  receives a new curve; destroy with planish_curve_free().
/// out_report: receives what the fit did and how good it is; grid_v is 1. NULL for no report.
/// Arrays: u[count], values[count, dim].
/// Returns what planish_tensor_fit_points() returns.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_curve_fit(
    u: *const f64,
    values: *const f64,
    count: usize,
    dim: usize,
    options: *const planish_curve_options,
    out_curve: *mut *mut planish_curve,
    out_report: *mut planish_fit_report,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let u = slice(u, count, "u")?;
        let values = slice(values, array_len::<f64>(count, dim, "values")?, "values")?;
        let given = self::options(options)?;
        let outputs = FitOutputs::new(
            (out_curve, "out_curve"),
            out_report,
            std::ptr::null_mut(),
            given.out_errors,
            count,
        )?;
        let options = given.to_core(count)?;
        let fit = with_control(given.thread_count, listener!(given), |control| {
            fit_curve(u, values, dim, &options, control)
        })??;
        Ok(outputs.store(planish_curve::into_raw(fit.curve), &[], &fit.errors, &fit.report))
    })
}

/// Makes a curve from its parts, which are copied.
///
/// dim:            numbers of a control point, at least 1.
/// degree:         1 to 9.
/// knots:          knot_count knots, never falling.
/// knot_count:     at least 2 * (degree + 1).
/// control_points: knot_count - degree - 1 rows of dim numbers.
/// out_curve:      receives a new curve; destroy with planish_curve_free().
/// Arrays: knots[knot_count], control_points[knot_count - degree - 1, dim].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (dim, degree or knots),
/// PLANISH_STATUS_NOT_FINITE (the index is the knot or the control point), PLANISH_STATUS_DEGENERATE (the knots span
/// no interval), PLANISH_STATUS_TOO_LARGE or PLANISH_STATUS_OUT_OF_MEMORY.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_curve_new(
    dim: usize,
    degree: u32,
    knots: *const f64,
    knot_count: usize,
    control_points: *const f64,
    out_curve: *mut *mut planish_curve,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let out_curve = out(out_curve, "out_curve")?;
        let knots = KnotVector::new(copy(knots, knot_count, "knots")?, degree as usize)?;
        let len = array_len::<f64>(knots.basis_count(), dim, "control_points")?;
        let curve = Curve::new(dim, knots, copy(control_points, len, "control_points")?)?;
        out_curve.write(planish_curve::into_raw(curve));
        Ok(())
    })
}

record! {
    /// How points are interpolated. Fill with planish_interpolate_options_init(), then change what you need.
    pub struct planish_interpolate_options (planish_interpolate_options_init) {
        /// For PLANISH_SECTION_ENDS_SLOPES: 2 rows of dim numbers, the derivatives with respect to u at the first and at
        /// the last point; otherwise NULL (default). Borrowed for the call.
        /// Array: [2, dim].
        pub end_slopes: *const f64,
        /// A planish_section_ends. Default PLANISH_SECTION_ENDS_AUTO: periodic if the last point is the first one, else
        /// parabolic.
        pub ends: u32,
        /// 0.
        pub reserved: u32,
    }
}

/// Makes the cubic curve with two continuous derivatives that passes through points.
///
/// u:         count parameters, each above the one before it.
/// values:    count rows of dim numbers.
/// count:     at least 2.
/// dim:       numbers of a value, at least 1.
/// options:   NULL for the defaults.
/// out_curve: receives a new curve; destroy with planish_curve_free().
/// Arrays: u[count], values[count, dim].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_NOT_FINITE (a parameter or a value; the index
/// is the point), PLANISH_STATUS_DEGENERATE (a parameter is not above the one before it; the index is the point),
/// PLANISH_STATUS_INVALID_ARGUMENT (count, dim, ends; a periodic curve whose last point is not the first),
/// PLANISH_STATUS_TOO_LARGE or PLANISH_STATUS_VERSION.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_curve_interpolate(
    u: *const f64,
    values: *const f64,
    count: usize,
    dim: usize,
    options: *const planish_interpolate_options,
    out_curve: *mut *mut planish_curve,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let u = slice(u, count, "u")?;
        let values = slice(values, array_len::<f64>(count, dim, "values")?, "values")?;
        let out_curve = out(out_curve, "out_curve")?;
        let given = self::options(options)?;
        if given.reserved != 0 {
            let record = "planish_interpolate_options";
            return Err(ArgumentError::Reserved { record, given: given.reserved }.into());
        }
        let slopes = match given.ends == planish_section_ends::Slopes as u32 {
            true => slice(given.end_slopes, array_len::<f64>(2, dim, "end_slopes")?, "end_slopes")?,
            false if given.end_slopes.is_null() => &[],
            false => return Err(ArgumentError::NotNull { name: "end_slopes" }.into()),
        };
        let (begin, end) = slopes.split_at(slopes.len() / 2);
        let is_closed = values.len() > dim && values[..dim] == values[values.len() - dim..];
        let auto = if is_closed { EndRule::Periodic } else { EndRule::Parabolic };
        let given_slopes = EndRule::Slopes { begin, end };
        let rules = [auto, EndRule::Parabolic, EndRule::Natural, given_slopes, EndRule::Periodic];
        let curve = interpolate(dim, u, values, choice(given.ends, &rules, "ends")?)?;
        out_curve.write(planish_curve::into_raw(curve));
        Ok(())
    })
}

/// What `find` reads from a curve; 0 for NULL.
///
/// # Safety
/// `curve` is NULL or a curve.
pub(super) unsafe fn query_curve<T: Default>(
    curve: *const planish_curve,
    find: impl FnOnce(&Curve) -> T,
) -> T {
    // SAFETY: the caller's promise.
    query(|| Ok(find(unsafe { deref(curve, "curve") }?.core())))
}

/// Numbers of a value; 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_curve_dim(curve: *const planish_curve) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_curve(curve, Curve::dim) }
}

/// Degree of the polynomial pieces; 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_curve_degree(curve: *const planish_curve) -> u32 {
    // SAFETY: the caller's promise.
    unsafe { query_curve(curve, |curve| curve.knots().degree() as u32) }
}

/// Number of knots, each as often as it occurs; 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_curve_knot_count(curve: *const planish_curve) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_curve(curve, |curve| curve.knots().knots().len()) }
}

/// Number of control points; 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_curve_control_point_count(curve: *const planish_curve) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_curve(curve, |curve| curve.knots().basis_count()) }
}

/// Copies the knots of a curve.
///
/// curve:     not NULL.
/// out_knots: receives planish_curve_knot_count() knots.
/// count:     knots that out_knots has room for.
/// Arrays: out_knots[curve_knot_count].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_curve_copy_knots(
    curve: *const planish_curve,
    out_knots: *mut f64,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let knots = deref(curve, "curve")?.core().knots().knots();
        rows_mut(out_knots, count, knots.len(), 1, "out_knots")?.copy_from_slice(knots);
        Ok(())
    })
}

/// Copies the control points of a curve.
///
/// curve:              not NULL.
/// out_control_points: receives planish_curve_control_point_count() rows of dim numbers.
/// count:              rows that out_control_points has room for.
/// Arrays: out_control_points[curve_control_point_count, curve_dim].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_curve_copy_control_points(
    curve: *const planish_curve,
    out_control_points: *mut f64,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let curve = deref(curve, "curve")?.core();
        let needed = curve.knots().basis_count();
        let rows = rows_mut(out_control_points, count, needed, curve.dim(), "out_control_points")?;
        rows.copy_from_slice(curve.control_points());
        Ok(())
    })
}

/// The interval on which the curve is defined.
///
/// curve:        not NULL.
/// out_interval: receives 2 numbers: least u, largest u.
/// Arrays: out_interval[2].
/// Returns PLANISH_STATUS_OK or PLANISH_STATUS_NULL_POINTER.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_curve_domain(
    curve: *const planish_curve,
    out_interval: *mut f64,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let (from, to) = deref(curve, "curve")?.core().knots().domain();
        slice_mut(out_interval, 2, "out_interval")?.copy_from_slice(&[from, to]);
        Ok(())
    })
}

/// Evaluates the curve and its derivatives at parameters.
///
/// curve:          not NULL.
/// u:              count parameters, options->uv_stride doubles apart (0 for 1).
/// count:          may be 0.
/// max_derivative: 0 to 3.
/// options:        NULL for the defaults; thread_count is not used.
/// out:            receives for each parameter max_derivative + 1 rows of dim numbers: C, C', C'', C''';
///                 parameters start options->out_stride doubles apart. It must not overlap u.
/// Arrays: u[count], out[count, max_derivative + 1, curve_dim].
/// Returns what planish_surface_eval() returns; PLANISH_STATUS_INVALID_ARGUMENT also for max_derivative.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_curve_eval(
    curve: *const planish_curve,
    u: *const f64,
    count: usize,
    max_derivative: u32,
    options: *const planish_eval_options,
    out: *mut f64,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let curve = deref(curve, "curve")?.core();
        let options = self::options(options)?;
        let order = derivative_order(max_derivative, MAX_DERIVATIVE)?;
        let rule = options.rule()?;
        thread_count(options.thread_count)?;
        let width = array_len::<f64>(order + 1, curve.dim(), "out")?;
        let u_stride = stride(options.uv_stride, 1, "uv_stride")?;
        let u = slice(u, strided_len::<f64>(count, u_stride, 1, "u")?, "u")?;
        let u: Vec<f64> = u.iter().step_by(u_stride).copied().collect();
        eval(curve, &u, order, rule, options.output((out, "out"), count, width)?, width)
    })
}

/// Evaluates into rows of `width` numbers.
fn eval(
    curve: &Curve,
    u: &[f64],
    order: usize,
    rule: OutsideRule,
    output: Output,
    width: usize,
) -> Result<planish_status, Failure> {
    match rule {
        OutsideRule::Fail => curve.check_inside(u)?,
        OutsideRule::Extrapolate => Curve::check_finite(u)?,
        OutsideRule::Flag => {}
    }
    let mut outside = 0;
    for (&u, row) in u.iter().zip(output.rows.chunks_mut(output.stride)) {
        if rule == OutsideRule::Flag && !curve.contains(u) {
            row[..width].fill(f64::NAN);
            outside += 1;
        } else {
            curve.eval_rows(&[u], order, &mut row[..width]);
        }
    }
    for (flag, &u) in output.flags.iter_mut().zip(u) {
        *flag = if curve.contains(u) { 0 } else { planish_flag::OutsideDomain as u8 };
    }
    Ok(status_of_values(rule, outside))
}

/// Makes a copy of a curve.
///
/// curve:     not NULL.
/// out_curve: receives a new curve; destroy with planish_curve_free().
/// Returns PLANISH_STATUS_OK or PLANISH_STATUS_NULL_POINTER.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_curve_clone(
    curve: *const planish_curve,
    out_curve: *mut *mut planish_curve,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let curve = deref(curve, "curve")?;
        let out_curve = out(out_curve, "out_curve")?;
        out_curve.write(planish_curve::into_raw(curve.core().clone()));
        Ok(())
    })
}

/// Destroys a curve.
///
/// curve: from this library and not destroyed yet; NULL does nothing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_curve_free(curve: *mut planish_curve) {
    query(|| {
        if !curve.is_null() {
            // SAFETY: the caller's promise.
            drop(unsafe { Box::from_raw(curve) });
        }
        Ok(())
    });
}
