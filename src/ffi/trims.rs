//! The trims of a surface.

use super::arguments::{
    ArgumentError, Record, ReportOut, choice, copy_rows, deref, deref_mut, flag, options, rows_mut, slice,
};
use super::choices::planish_tolerance_scale;
use super::curve::planish_curve;
use super::guard::guard;
use super::planish_status;
use super::progress::{planish_progress, with_control};
use super::report::write_pairs;
use super::surface::{planish_surface, query_surface};
use crate::curve::Curve;
use crate::fit::report::{Tolerance, ToleranceScale};
use crate::fit::trim::{CurveTrimOptions, CurveTrimReport, trim_by_curves};
use crate::memory;
use crate::surface::{Surface, Trims};
use glam::DVec2;
use libc::c_void;

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

record! {
    /// How trims follow curves. Fill with planish_trim_options_init(), then change what you need.
    pub struct planish_trim_options (planish_trim_options_init; core: CurveTrimOptions) {
        /// How far the trims may lie from the curves, and the curves from the surface, positive, measured in
        /// tolerance_scale. Default 1e-3.
        pub tolerance: f64 = core.tolerance.value,
        /// Hears of the progress and may cancel; NULL (default) for nobody.
        pub progress: planish_progress,
        /// Handed to progress as it is.
        pub user: *mut c_void,
        /// Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
        pub cancel: *const i32,
        /// Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
        /// Array: [1].
        pub out_stage: *mut u32,
        /// A planish_tolerance_scale; relative is to the diagonal of the box of the curves' control points. Default
        /// PLANISH_TOLERANCE_SCALE_RELATIVE.
        pub tolerance_scale: u32 = planish_tolerance_scale::Relative as u32,
        /// 1 adds the loops to the trims that the surface has, so that a closed curve inside cuts a hole; 0 (default)
        /// replaces them.
        pub add: u32 = u32::from(core.adds),
        /// Threads to use, at most 1024; 0 (default) for all cores. Results do not depend on it.
        pub thread_count: u32,
        /// 0.
        pub reserved: u32,
    }
}

impl planish_trim_options {
    fn to_core(self) -> Result<CurveTrimOptions, ArgumentError> {
        let scales = [ToleranceScale::Relative, ToleranceScale::Absolute];
        let scale = choice(self.tolerance_scale, &scales, "tolerance_scale")?;
        if self.reserved != 0 {
            return Err(ArgumentError::Reserved { record: Self::NAME, given: self.reserved });
        }
        Ok(CurveTrimOptions {
            tolerance: Tolerance { value: self.tolerance, scale },
            adds: flag(self.add, "add")?,
        })
    }
}

record! {
    /// How near trims are to the curves that they follow: distances of the surface over them to the pieces of curve that
    /// they stand for, in model units. Set struct_size to sizeof(planish_trim_report) before the call; the report is
    /// filled as far as that goes, on success only.
    pub struct planish_trim_report {
        /// Largest distance at a vertex.
        pub max_vertex_distance: f64,
        /// Root mean square of the distances at vertices.
        pub rms_vertex_distance: f64,
        /// Largest distance between vertices, measured at seven places of each side.
        pub max_distance_between: f64,
        /// Root mean square of the distances between vertices.
        pub rms_distance_between: f64,
        /// The parameter of the place on its curve that the trims are farthest from.
        pub worst_parameter: f64,
        /// The tolerance, which is no less than what rounding leaves.
        pub tolerance: f64,
        /// What a relative tolerance is measured in.
        pub diagonal: f64,
        /// Wall time in seconds.
        pub seconds: f64,
        /// The curve of that place.
        pub worst_curve: usize,
        /// Vertices of the new trims.
        pub vertex_count: usize,
        /// Of these those whose places are not proved to be nearest to the curve.
        pub unproven_count: usize,
    }
}

impl From<&CurveTrimReport> for planish_trim_report {
    fn from(report: &CurveTrimReport) -> Self {
        Self {
            struct_size: size_of::<Self>(),
            max_vertex_distance: report.max_vertex_distance,
            rms_vertex_distance: report.rms_vertex_distance,
            max_distance_between: report.max_distance_between,
            rms_distance_between: report.rms_distance_between,
            worst_parameter: report.worst_parameter,
            tolerance: report.tolerance,
            diagonal: report.diagonal,
            seconds: report.seconds,
            worst_curve: report.worst_curve,
            vertex_count: report.vertex_count,
            unproven_count: report.unproven_count,
        }
    }
}

/// Makes trims that follow curves in space: each loop is projected on to the surface, to the nearest of all its places
/// whatever trims it has, and its feet are joined by lines in (u, v) that are halved until the surface over them is within
/// the tolerance of the curve, and the curve of it. The surface stays as it is on error.
///
/// surface:      not NULL, of dimension 3; changed.
/// curves:       curves of dimension 3, loop after loop, none of them NULL. The curves of a loop follow one another, each
///               in either direction; gaps within the tolerance are closed. A loop may not cross a seam of the surface.
/// curve_counts: trim_count numbers of curves, each at least 1; NULL if each loop is one closed curve.
/// trim_count:   number of loops, at least 1; the outer one first, unless they are added.
/// options:      NULL for the defaults.
/// out_report:   receives how near the trims are to the curves; NULL for no report.
/// Arrays: curves[*], curve_counts[trim_count].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NOT_PROVEN (some places are not proved to be nearest, as on a D1RC-spline) or
/// an error: PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option, no loops, a loop without curves, a
/// dimension, a gap, or a curve farther from the surface than the tolerance; the index is the curve, or the loop without
/// curves), PLANISH_STATUS_TOPOLOGY (a seam or a fold of the surface is in the way of a curve, the index is the curve; or
/// trims meet, the index is the trim), PLANISH_STATUS_DEGENERATE (a loop is no polygon, the index is the loop),
/// PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_TOO_LARGE, PLANISH_STATUS_OUT_OF_MEMORY, PLANISH_STATUS_VERSION or
/// PLANISH_STATUS_CANCELLED.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_trim_by_curves(
    surface: *mut planish_surface,
    curves: *const *const planish_curve,
    curve_counts: *const usize,
    trim_count: usize,
    options: *const planish_trim_options,
    out_report: *mut planish_trim_report,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let surface = deref_mut(surface, "surface")?;
        let given = self::options(options)?;
        let report = ReportOut::new(out_report)?;
        let core = given.to_core()?;
        let loops = loops(curves, curve_counts, trim_count)?;
        let shared = &*surface;
        let found = with_control(given.thread_count, listener!(given), |control| {
            let projector = shared.projector()?;
            trim_by_curves(shared.any(), projector, &loops, &core, control)
        })??;
        surface.any_mut().region_mut().trims = found.trims;
        report.store((&found.report).into());
        let is_proven = found.report.unproven_count == 0;
        Ok(if is_proven { planish_status::Ok } else { planish_status::NotProven })
    })
}

/// The curves of each loop.
///
/// # Safety
/// `curve_counts` is NULL or `trim_count` numbers; `curves` is NULL or as many pointers as these are in all, each NULL or
/// a curve that nobody changes for `'a`.
unsafe fn loops<'a>(
    curves: *const *const planish_curve,
    curve_counts: *const usize,
    trim_count: usize,
) -> Result<Vec<Vec<&'a Curve>>, ArgumentError> {
    let ones;
    let counts = match curve_counts.is_null() {
        true => {
            ones = memory::filled(1, trim_count);
            &ones[..]
        }
        // SAFETY: the caller's promise.
        false => unsafe { slice(curve_counts, trim_count, "curve_counts") }?,
    };
    let total = counts.iter().try_fold(0_usize, |sum, &count| sum.checked_add(count));
    let overflow = ArgumentError::Overflow { name: "curves", count: usize::MAX, width: trim_count };
    // SAFETY: the caller's promise.
    let mut rest = unsafe { slice(curves, total.ok_or(overflow)?, "curves") }?.iter();
    // SAFETY: the caller's promise.
    let next = |&curve: &*const planish_curve| unsafe { deref(curve, "a curve") }.map(planish_curve::core);
    let next_loop = |&count: &usize| rest.by_ref().take(count).map(next).collect::<Result<Vec<_>, _>>();
    counts.iter().map(next_loop).collect()
}
