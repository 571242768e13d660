//! T-splines with control curves: skins of rows, parts in and out, knots in and out.

use super::arguments::{
    ArgumentError, ReportOut, array_len, choice, copy, deref, deref_mut, flag, options, out, rows_mut, slice,
};
use super::choices::tolerance;
use super::curve::planish_curve;
use super::guard::{Failure, guard};
use super::progress::with_control;
use super::report::{FitOutputs, planish_fit_report};
use super::surface::{planish_surface, query_surface};
use super::{planish_progress, planish_status};
use crate::Control;
use crate::curve::Curve;
use crate::fit::skin::{
    Rows, SectionEnds, SkinError, SkinFit, SkinMethod, SkinOptions, SkinReport, VRule, VSlopes, skin,
    skin_curves,
};
use crate::knots::KnotVector;
use crate::surface::tspline::{DEGREE, TSplineError, TSplineSurface};
use libc::c_void;

/// Which knots the control curves of a skin get.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_skin_method {
    /// Each its own, as few as the tolerance allows.
    ControlCurves = 0,
    /// All the same: the classical skin, for comparison.
    CommonKnots = 1,
}

/// What happens at the ends of rows.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_section_ends {
    /// Periodic for closed rows, parabolic for open ones.
    Auto = 0,
    /// The slope of the parabola through three points; at the seam of closed rows a kink may remain.
    Parabolic = 1,
    /// No curvature.
    Natural = 2,
    /// The slopes in end_slopes.
    Slopes = 3,
    /// Closed rows go on over the seam without a break in two derivatives.
    Periodic = 4,
}

/// How far apart rows are along v.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_v_rule {
    /// As their first and last points are; where that gives a step of next to nothing, as PLANISH_V_RULE_MEAN.
    Endpoints = 0,
    /// As points at equal fractions of their lengths are on average.
    Mean = 1,
}

/// How a skin runs from row to row.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_v_slopes {
    /// Without a break in two derivatives; bunched rows make it swing between others.
    Smooth = 0,
    /// Without a break in one derivative, and no coordinate leaves the range of the two rows that it is between: it
    /// cannot overshoot. Not together with tangents, closed_v or approximate_v.
    Monotone = 1,
}

record! {
    /// What a skin did beside what every fit reports. Lengths are in model units.
    pub struct planish_skin_report {
        /// By how much control curves may be larger than the rows, 1 at least. Equal steps give 3 at most; rows much
        /// nearer to one another than to the next make it large.
        pub overshoot: f64,
        /// A bound of the distance between the surface and the skin through the section curves at any (u,v); NaN unless
        /// certify asked for it, or if a section is no cubic.
        pub certified_distance: f64,
        /// The part of the error that fewer knots along v leave; 0 with a knot for each row.
        pub v_error: f64,
        /// The first row that looks reversed or shifted against the one before it, counted from 0; -1 if there is none.
        pub twisted_row: i64,
        /// Control curves of the surface.
        pub curve_count: usize,
        /// Control points of the shortest control curve.
        pub least_count: usize,
        /// Control points of the longest control curve.
        pub largest_count: usize,
        /// Control points of the same surface as a tensor surface: what planish_surface_to_tensor() makes.
        pub tensor_count: usize,
        /// Control points of the same surface in strips: what PLANISH_STEP_FORM_STRIPS writes.
        pub strip_count: usize,
        /// Control points of the skin over common knots; 0 unless compare asked for it.
        pub common_count: usize,
        /// Knots that the removal pass took out.
        pub removed_knot_count: usize,
        /// Points that lay on the one before them.
        pub merged_point_count: usize,
        /// Rows that were turned round or given another first point.
        pub aligned_row_count: usize,
    }
}

impl From<&SkinReport> for planish_skin_report {
    fn from(report: &SkinReport) -> Self {
        Self {
            struct_size: size_of::<Self>(),
            overshoot: report.overshoot,
            certified_distance: report.certified_distance,
            v_error: report.v_error,
            twisted_row: report.twisted_row.map_or(-1, |row| row as i64),
            curve_count: report.curve_count,
            least_count: report.least_count,
            largest_count: report.largest_count,
            tensor_count: report.tensor_count,
            strip_count: report.strip_count,
            common_count: report.common_count,
            removed_knot_count: report.removed_knot_count,
            merged_point_count: report.merged_point_count,
            aligned_row_count: report.aligned_row_count,
        }
    }
}

record! {
    /// Options of skins. Fill with planish_skin_options_init(), then change what you need.
    pub struct planish_skin_options (planish_skin_options_init; core: SkinOptions) {
        /// The largest error allowed at the points, positive, measured in tolerance_scale. Default 1e-3.
        pub tolerance: f64 = core.tolerance.value,
        /// For each row two vectors of dim numbers, the slopes at its begin and its end, derivatives with respect to
        /// chord length (a unit tangent keeps the pace); NULL (default) unless ends is PLANISH_SECTION_ENDS_SLOPES. Not
        /// used for curves.
        /// Array: [rows, 2, dim].
        pub end_slopes: *const f64,
        /// For each point of the first row, or each different knot of the first curve, a vector of dim numbers: the
        /// derivative across it with respect to length along v; NULL (default) for no curvature there.
        /// Array: [*, dim].
        pub begin_tangents: *const f64,
        /// The same at the last row.
        /// Array: [*, dim].
        pub end_tangents: *const f64,
        /// Hears of the progress and may cancel; NULL (default) for nobody.
        pub progress: planish_progress,
        /// Handed to progress as it is.
        pub user: *mut c_void,
        /// Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
        pub cancel: *const i32,
        /// Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
        /// Array: [1].
        pub out_stage: *mut u32,
        /// Receives the (u,v) at which the error of each point is measured: two numbers for each point, or NULL
        /// (default; for curves it must be). Written on success only.
        /// Array: [data, 2].
        pub out_parameters: *mut f64,
        /// Receives the error of each point in model units, or NULL (default; for curves it must be). Written on success
        /// only.
        /// Array: [data].
        pub out_errors: *mut f64,
        /// Receives what only skins report, or NULL (default). Set its struct_size before. Filled on success only.
        pub out_report: *mut planish_skin_report,
        /// Numbers of a point, at least 1. Default 3. Not used for curves.
        pub dim: usize = 3,
        /// A planish_tolerance_scale. Default PLANISH_TOLERANCE_SCALE_RELATIVE.
        pub tolerance_scale: u32,
        /// A planish_skin_method. Default PLANISH_SKIN_METHOD_CONTROL_CURVES.
        pub method: u32 = planish_skin_method::ControlCurves as u32,
        /// 1 if rows are closed: their first point is not repeated. Default 0.
        pub closed: u32 = core.closed.into(),
        /// A planish_section_ends. Default PLANISH_SECTION_ENDS_AUTO. Not used for curves.
        pub ends: u32 = planish_section_ends::Auto as u32,
        /// 1 if the last row is followed by the first one; needs three rows, and no tangents. Default 0.
        pub closed_v: u32 = core.closed_v.into(),
        /// A planish_v_rule. Default PLANISH_V_RULE_ENDPOINTS.
        pub v_rule: u32 = planish_v_rule::Endpoints as u32,
        /// 1 turns rows round, and moves the first point of closed ones, where that brings them nearer to the row
        /// before. Default 0. Not used for curves.
        pub align: u32 = core.align.into(),
        /// 1 looks for fewer knots along v than rows. Default 0.
        pub approximate_v: u32 = core.approximate_v.into(),
        /// Places between two data at which a control curve is checked too, at most 100; 0 as in the paper. Default 3.
        pub extra_checks: u32 = core.extra_checks as u32,
        /// 1 inserts a knot into every span that needs one in each pass: faster, some more control points. Default 0.
        pub batch: u32 = core.batch.into(),
        /// 1 takes knots out again that turn out not to be needed. Default 0.
        pub removal: u32 = core.removal.into(),
        /// 1 bounds the distance from the skin through the section curves. Default 0.
        pub certify: u32 = core.certify.into(),
        /// 1 counts the control points of PLANISH_SKIN_METHOD_COMMON_KNOTS for the report. Default 0.
        pub compare: u32 = core.compare.into(),
        /// Threads to use, at most 1024; 0 (default) for all cores. Results do not depend on it.
        pub thread_count: u32,
        /// A planish_v_slopes. Default PLANISH_V_SLOPES_SMOOTH.
        pub v_slopes: u32 = planish_v_slopes::Smooth as u32,
        /// 0.
        pub reserved: u32,
    }
}

/// What the arrays in the options refer to.
#[derive(Clone, Copy)]
struct Sizes {
    dim: usize,
    row_count: usize,
    /// Data of the first and the last row.
    end_counts: [usize; 2],
}

impl planish_skin_options {
    /// # Safety
    /// The arrays are NULL or as the header says, for rows of these sizes, until the options are no longer used.
    unsafe fn to_core<'a>(self, sizes: Sizes) -> Result<SkinOptions<'a>, ArgumentError> {
        let vectors = |at: *const f64, count: usize, name| match at.is_null() {
            true => Ok(None),
            // SAFETY: the caller's promise.
            false => unsafe { slice(at, array_len::<f64>(count, sizes.dim, name)?, name) }.map(Some),
        };
        if self.reserved != 0 {
            return Err(ArgumentError::Reserved { record: "planish_skin_options", given: self.reserved });
        }
        let plain = [
            SectionEnds::Auto,
            SectionEnds::Parabolic,
            SectionEnds::Natural,
            SectionEnds::Auto,
            SectionEnds::Periodic,
        ];
        let mut ends = choice(self.ends, &plain, "ends")?;
        if self.ends == planish_section_ends::Slopes as u32 {
            let slopes = vectors(self.end_slopes, sizes.row_count.saturating_mul(2), "end_slopes")?;
            ends = SectionEnds::Slopes(slopes.ok_or(ArgumentError::Null { name: "end_slopes" })?);
        }
        Ok(SkinOptions {
            tolerance: tolerance(self.tolerance, self.tolerance_scale)?,
            method: choice(self.method, &[SkinMethod::ControlCurves, SkinMethod::CommonKnots], "method")?,
            closed: flag(self.closed, "closed")?,
            ends,
            closed_v: flag(self.closed_v, "closed_v")?,
            begin_tangents: vectors(self.begin_tangents, sizes.end_counts[0], "begin_tangents")?,
            end_tangents: vectors(self.end_tangents, sizes.end_counts[1], "end_tangents")?,
            v_rule: choice(self.v_rule, &[VRule::Endpoints, VRule::Mean], "v_rule")?,
            v_slopes: choice(self.v_slopes, &[VSlopes::Smooth, VSlopes::Monotone], "v_slopes")?,
            align: flag(self.align, "align")?,
            approximate_v: flag(self.approximate_v, "approximate_v")?,
            extra_checks: self.extra_checks as usize,
            batch: flag(self.batch, "batch")?,
            removal: flag(self.removal, "removal")?,
            certify: flag(self.certify, "certify")?,
            compare: flag(self.compare, "compare")?,
        })
    }
}

/// Runs a skin of `count` data.
///
/// # Safety
/// The pointers are NULL or as the header says.
unsafe fn run(
    given: planish_skin_options,
    count: usize,
    sizes: Sizes,
    out_surface: *mut *mut planish_surface,
    out_report: *mut planish_fit_report,
    method: impl FnOnce(&SkinOptions, &mut Control) -> Result<SkinFit, SkinError> + Send,
) -> Result<planish_status, Failure> {
    // SAFETY: the caller's promises.
    unsafe {
        let (parameters, errors) = (given.out_parameters, given.out_errors);
        let outputs = FitOutputs::new((out_surface, "out_surface"), out_report, parameters, errors, count)?;
        let skin_report = ReportOut::new(given.out_report)?;
        let options = given.to_core(sizes)?;
        let fit = with_control(given.thread_count, listener!(given), |control| method(&options, control))??;
        skin_report.store((&fit.skin).into());
        Ok(outputs.store(planish_surface::into_raw(fit.surface), &fit.parameters, &fit.errors, &fit.report))
    }
}

/// Skins rows of points: a surface over the unit square on which row after row lies within the tolerance, u along
/// the rows and v across them. Rows may have any counts, one point included.
///
/// points:      rows of dim numbers (3 unless the options say otherwise), row after row.
/// row_counts:  row_count numbers of points, each at least 1.
/// row_count:   at least 2; at least 3 for a surface closed along v.
/// options:     NULL for the defaults.
/// out_surface: receives a new T-spline; destroy with planish_surface_free().
/// out_report:  receives what the fit did and how good it is; grid_u is the largest number of knots of a control
///              curve. NULL for no report.
/// Arrays: points[*, options.dim], row_counts[row_count].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_TOLERANCE_NOT_MET, PLANISH_STATUS_STAGNATED (points are so near to one
/// another that no knot fits between), PLANISH_STATUS_INPUT_REPAIRED (points on the one before were merged) or an
/// error: PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option, too few rows, or a row without
/// points, the index is the row), PLANISH_STATUS_NOT_FINITE (the index is the point, or the vector of an option),
/// PLANISH_STATUS_DEGENERATE (a row lies on the one before, the index is the row), PLANISH_STATUS_TOO_LARGE,
/// PLANISH_STATUS_VERSION or PLANISH_STATUS_CANCELLED.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_tspline_skin(
    points: *const f64,
    row_counts: *const usize,
    row_count: usize,
    options: *const planish_skin_options,
    out_surface: *mut *mut planish_surface,
    out_report: *mut planish_fit_report,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let given = self::options(options)?;
        let counts = slice(row_counts, row_count, "row_counts")?;
        let count = counts.iter().try_fold(0_usize, |sum, &count| sum.checked_add(count));
        let overflow = ArgumentError::Overflow { name: "points", count: row_count, width: usize::MAX };
        let count = count.ok_or(overflow)?;
        let points = slice(points, array_len::<f64>(count, given.dim, "points")?, "points")?;
        let end_counts = [counts.first(), counts.last()].map(|count| count.copied().unwrap_or(0));
        let sizes = Sizes { dim: given.dim, row_count, end_counts };
        let rows = Rows { points, counts, dim: given.dim };
        run(given, count, sizes, out_surface, out_report, |options, control| skin(&rows, options, control))
    })
}

/// Skins section curves of any degree, over any domains. Their data are their values at their different knots.
///
/// curves:      curve_count curves of one dimension, none of them NULL.
/// curve_count: at least 2; at least 3 for a surface closed along v.
/// options:     NULL for the defaults. closed says that the curves are closed, and smooth there.
/// out_surface: receives a new T-spline; destroy with planish_surface_free().
/// out_report:  receives what the fit did and how good it is; NULL for no report.
/// Arrays: curves[curve_count].
/// Returns what planish_tspline_skin() returns; PLANISH_STATUS_INVALID_ARGUMENT also for a curve of another dimension
/// than the first, the index is the curve.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_tspline_skin_curves(
    curves: *const *const planish_curve,
    curve_count: usize,
    options: *const planish_skin_options,
    out_surface: *mut *mut planish_surface,
    out_report: *mut planish_fit_report,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let given = self::options(options)?;
        for (at, name) in [(given.out_parameters, "out_parameters"), (given.out_errors, "out_errors")] {
            if !at.is_null() {
                return Err(ArgumentError::NotNull { name }.into());
            }
        }
        let curves = self::curves(curves, curve_count)?;
        let dim = curves.first().map_or(0, Curve::dim);
        let data = |curve: Option<&Curve>| curve.map_or(0, |curve| curve.knots().spans().len() + 1);
        let sizes =
            Sizes { dim, row_count: curve_count, end_counts: [data(curves.first()), data(curves.last())] };
        run(given, 0, sizes, out_surface, out_report, |options, control| {
            skin_curves(&curves, options, control)
        })
    })
}

/// Copies of curves.
///
/// # Safety
/// `curves` is NULL or points to `count` pointers that are NULL or curves.
unsafe fn curves(curves: *const *const planish_curve, count: usize) -> Result<Vec<Curve>, ArgumentError> {
    // SAFETY: the caller's promise.
    let pointers = unsafe { slice(curves, count, "curves") }?;
    // SAFETY: the caller's promise.
    pointers.iter().map(|&curve| Ok(unsafe { deref(curve, "a curve") }?.core().clone())).collect()
}

/// Makes a T-spline from its parts, which are copied.
///
/// knots:       the knots along v, never falling, cubic.
/// knot_count:  at least 8.
/// curves:      knot_count - 4 control curves: cubic, their end knots repeated four times, all over one domain and of
///              one dimension; none of them NULL.
/// curve_count: knot_count - 4.
/// out_surface: receives a new surface; destroy with planish_surface_free().
/// Arrays: knots[knot_count], curves[curve_count].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (knots or curves, the index
/// is the one), PLANISH_STATUS_NOT_FINITE or PLANISH_STATUS_DEGENERATE (the knots span no interval).
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_tspline_new(
    knots: *const f64,
    knot_count: usize,
    curves: *const *const planish_curve,
    curve_count: usize,
    out_surface: *mut *mut planish_surface,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let out_surface = out(out_surface, "out_surface")?;
        let knots = KnotVector::new(copy(knots, knot_count, "knots")?, DEGREE)?;
        let tspline = TSplineSurface::new(knots, self::curves(curves, curve_count)?)?;
        out_surface.write(planish_surface::into_raw(tspline));
        Ok(())
    })
}

/// Number of control curves of a T-spline; 0 for NULL and other families.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_tspline_curve_count(surface: *const planish_surface) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_surface(surface, |surface| Ok(surface.tspline()?.curves().len())) }
}

/// Makes a copy of a control curve, whose knots and control points the functions of planish_curve hand out.
///
/// surface:   not NULL.
/// curve:     below planish_tspline_curve_count().
/// out_curve: receives a new curve; destroy with planish_curve_free().
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND or PLANISH_STATUS_INDEX.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_tspline_clone_curve(
    surface: *const planish_surface,
    curve: usize,
    out_curve: *mut *mut planish_curve,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let curves = deref(surface, "surface")?.tspline()?.curves();
        let out_curve = out(out_curve, "out_curve")?;
        let missing = TSplineError::NoSuchCurve { index: curve, count: curves.len() };
        out_curve.write(planish_curve::into_raw(curves.get(curve).ok_or(missing)?.clone()));
        Ok(())
    })
}

/// Number of knots of a T-spline along v, each as often as it occurs; 0 for NULL and other families.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_tspline_knot_count(surface: *const planish_surface) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_surface(surface, |surface| Ok(surface.tspline()?.knots_v().knots().len())) }
}

/// Copies the knots of a T-spline along v.
///
/// surface:   not NULL.
/// out_knots: receives planish_tspline_knot_count() knots.
/// count:     knots that out_knots has room for.
/// Arrays: out_knots[tspline_knot_count].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND or
/// PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_tspline_copy_knots(
    surface: *const planish_surface,
    out_knots: *mut f64,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let knots = deref(surface, "surface")?.tspline()?.knots_v().knots();
        rows_mut(out_knots, count, knots.len(), 1, "out_knots")?.copy_from_slice(knots);
        Ok(())
    })
}

/// Inserts a knot into one control curve of a T-spline, which stays the same surface; all other curves stay as they
/// are.
///
/// surface: not NULL; changed.
/// curve:   below planish_tspline_curve_count().
/// u:       inside the domain, where the curve has no more than two knots yet.
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_INDEX,
/// PLANISH_STATUS_OUTSIDE (u, also if it is NaN) or PLANISH_STATUS_INVALID_ARGUMENT (the knot would occur too often).
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_tspline_insert_knot_u(
    surface: *mut planish_surface,
    curve: usize,
    u: f64,
) -> planish_status {
    // SAFETY: the caller's promise.
    guard(|| unsafe { Ok(deref_mut(surface, "surface")?.tspline_mut()?.insert_knot_u(curve, u)?) })
}

/// Inserts a knot along v into a T-spline, which stays the same surface and has one control curve more.
///
/// surface: not NULL; changed.
/// v:       inside the domain, where there are no more than two knots yet.
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_OUTSIDE (v, also
/// if it is NaN) or PLANISH_STATUS_INVALID_ARGUMENT (the knot would occur too often).
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_tspline_insert_knot_v(
    surface: *mut planish_surface,
    v: f64,
) -> planish_status {
    // SAFETY: the caller's promise.
    guard(|| unsafe { Ok(deref_mut(surface, "surface")?.tspline_mut()?.insert_knot_v(v)?) })
}

/// Removes a knot from one control curve of a T-spline if the surface then moves by no more than a tolerance.
///
/// surface:   not NULL; changed unless PLANISH_STATUS_TOLERANCE_NOT_MET is returned.
/// curve:     below planish_tspline_curve_count().
/// knot:      index of a knot of that curve inside the domain, counted from 0 over all its knots.
/// tolerance: in model units; 0 or more, or the knot stays.
/// out_error: receives a bound of the distance that the surface moves at any (u,v), or would have moved; NULL for
///            none.
/// Arrays: out_error[1].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_TOLERANCE_NOT_MET (the knot stays) or an error:
/// PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND or PLANISH_STATUS_INDEX (no such curve, or no such knot
/// inside the domain).
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_tspline_remove_knot_u(
    surface: *mut planish_surface,
    curve: usize,
    knot: usize,
    tolerance: f64,
    out_error: *mut f64,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let tspline = deref_mut(surface, "surface")?.tspline_mut()?;
        let out_error = if out_error.is_null() { None } else { Some(out(out_error, "out_error")?) };
        let removal = tspline.remove_knot_u(curve, knot, tolerance)?;
        out_error.into_iter().for_each(|error| {
            error.write(removal.error);
        });
        Ok(if removal.is_removed { planish_status::Ok } else { planish_status::ToleranceNotMet })
    })
}
