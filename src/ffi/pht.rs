//! PHT-splines: fits.

use super::arguments::{
    ArgumentError, array_len, choice, copy_rows, deref, flag, options, slice, slice_or_none, unused,
};
use super::choices::{missing, regularize, tolerance};
use super::curve::planish_curve;
use super::demands::planish_symmetry;
use super::guard::{Failure, guard};
use super::mesh::planish_mesh;
use super::mesh_fields::check_field_count;
use super::progress::with_control;
use super::report::{FitOutputs, planish_fit_report};
use super::surface::planish_surface;
use super::{planish_parameterize_options, planish_progress, planish_status};
use crate::Control;
use crate::fit::common::FitError;
use crate::fit::pht::{
    Coarsening, Continuity, Estimator, PhtFit, PhtOptions, fit_field, fit_mesh, fit_points,
};
use glam::DVec2;
use libc::c_void;

/// What determines a PHT-spline at its vertices.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_pht_estimator {
    /// Least squares over all data with a weak bending energy: fewest coefficients.
    Global = 0,
    /// A quadratic fit around each datum, interpolated linearly (Deng et al., 2008): for comparison.
    LocalQuadratic = 1,
    /// A weighted cubic fit around each vertex: no system to solve, for very large data.
    LocalCubic = 2,
}

/// Whether a PHT fit merges cells again as long as the tolerance is met, at the cost of up to 40 further fits.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_coarsening {
    /// Where the surface has two continuous derivatives.
    Auto = 0,
    /// Yes.
    On = 1,
    /// No.
    Off = 2,
}

record! {
    /// Options of PHT fits. Fill with planish_pht_options_init(), then change what you need.
    ///
    /// A datum is a node of the mesh, or a point; a sample is a datum, or the middle of a triangle.
    pub struct planish_pht_options (planish_pht_options_init; core: PhtOptions) {
        /// The largest error allowed at the data, positive, measured in tolerance_scale. Default 1e-3.
        pub tolerance: f64 = core.tolerance.value,
        /// Weight of the bending energy of each cell, mapped to the unit cell; lowered where cells cannot be split any
        /// more. Default 1e-3.
        pub smoothing: f64 = core.smoothing,
        /// How a mesh without parameters gets them; NULL (default) for a circle, with one stretch step unless the
        /// tolerance is fine and the plain map even. Of this record progress, user and thread_count are not looked at, and node_weights must be
        /// NULL. Not used for points.
        pub parameterize: *const planish_parameterize_options,
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
        /// Receives the (u,v) at which the error of each datum is measured: two numbers for each datum, or NULL
        /// (default). Written on success only.
        /// Array: [data, 2].
        pub out_parameters: *mut f64,
        /// Receives the error of each datum in model units: one number for each datum, or NULL (default). Written
        /// on success only.
        /// Array: [data].
        pub out_errors: *mut f64,
        /// Most cells, at least the initial ones. Default 200000.
        pub max_cells: usize = core.max_cells,
        /// A planish_tolerance_scale. Default PLANISH_TOLERANCE_SCALE_RELATIVE.
        pub tolerance_scale: u32,
        /// A planish_pht_estimator. Default PLANISH_PHT_ESTIMATOR_GLOBAL.
        pub estimator: u32 = planish_pht_estimator::Global as u32,
        /// A planish_regularize. Default PLANISH_REGULARIZE_AUTO.
        pub regularize: u32,
        /// Cells along u to start from, 1 to 4095. Default 1.
        pub grid_u: u32 = core.initial_grid[0] as u32,
        /// Cells along v to start from, 1 to 4095. Default 1.
        pub grid_v: u32 = core.initial_grid[1] as u32,
        /// Deepest level of a cell, at most 20. Default 12.
        pub max_level: u32 = core.max_level,
        /// A cell with fewer samples is not split, at least 1. Default 2.
        pub min_samples: u32 = core.min_samples as u32,
        /// Levels by which cells that share an edge may differ; 0 for any number. Default 1.
        pub grade: u32 = core.grade,
        /// Sweeps of parameter correction in each round of the fit of a shape. Default 1.
        pub correction_sweeps: u32 = core.correction_sweeps as u32,
        /// 1 measures the closest-point distance of the nodes for the report. Default 0.
        pub measure_distance: u32 = core.measure_distance.into(),
        /// Threads to use, at most 1024; 0 (default) for all cores. Results do not depend on it.
        pub thread_count: u32,
        /// A planish_symmetry, for the shape of a mesh. Default PLANISH_SYMMETRY_NONE.
        pub symmetry: u32 = planish_symmetry::None as u32,
        /// A planish_missing: what values of points and fields mean that are NaN. Default PLANISH_MISSING_REFUSED. Not
        /// used for the shape of a mesh.
        pub missing: u32,
        /// 0.
        pub reserved_end: u32,
        /// A tolerance for each datum in tolerance_scale, positive, in place of tolerance; infinity leaves the datum
        /// out: it is not fitted, and its error does not count. NULL (default): tolerance for all.
        /// Array: [data].
        pub tolerances: *const f64,
        /// Numbers of data that the surface passes through, to 1e-12 of the diagonal of the data's box, by linear
        /// conditions on its coefficients. Default NULL.
        /// Array: [fixed_count].
        pub fixed: *const u32,
        /// Receives 1 for each datum that was taken for a gross error and left out, else 0; NULL (default) for no such
        /// list. Written on success only.
        /// Array: [data].
        pub out_left_out: *mut u8,
        /// The largest share of the data that may be gross errors, at most 0.25: those that stand out most from their
        /// neighbours are left out of the fit. 0 (default) for none.
        pub outlier_share: f64,
        /// A gross error misses the surface of the other data by more than this, in tolerance_scale: such data are
        /// left out. 0 (default) for none; not together with outlier_share.
        pub outlier_scale: f64,
        /// Numbers in fixed. Default 0.
        pub fixed_count: usize,
        /// A place in the plane of symmetry and a normal of it, for PLANISH_SYMMETRY_ABOUT; else NULL (default).
        /// Array: [6].
        pub plane: *const f64,
        /// Receives a place in the plane of symmetry and its unit normal, if symmetry was asked for; NULL (default) for
        /// nobody. Written on success only.
        /// Array: [6].
        pub out_plane: *mut f64,
        /// The curve that the side at the least u is, exactly; NULL (default) for a free side. Clamped, of degree 3 at most,
        /// with continuous tangents. Its knots are lines of the first grid.
        pub curve_u_low: *const planish_curve,
        /// The curve that the side at the largest u is, exactly; NULL (default) for a free side. As curve_u_low.
        pub curve_u_high: *const planish_curve,
        /// The curve that the side at the least v is, exactly; NULL (default) for a free side. As curve_u_low.
        pub curve_v_low: *const planish_curve,
        /// The curve that the side at the largest v is, exactly; NULL (default) for a free side. As curve_u_low.
        pub curve_v_high: *const planish_curve,
        /// The tensor surface or PHT-spline beyond the side at the least u; NULL (default) for none. Bicubic,
        /// clamped, without weights: the side takes over its side that lies nearest to the data, and its tangent planes.
        pub neighbour_u_low: *const planish_surface,
        /// The tensor surface or PHT-spline beyond the side at the largest u; NULL (default) for none. As neighbour_u_low.
        pub neighbour_u_high: *const planish_surface,
        /// The tensor surface or PHT-spline beyond the side at the least v; NULL (default) for none. As neighbour_u_low.
        pub neighbour_v_low: *const planish_surface,
        /// The tensor surface or PHT-spline beyond the side at the largest v; NULL (default) for none. As neighbour_u_low.
        pub neighbour_v_high: *const planish_surface,
        /// Continuous derivatives of the surface: 1 (default), or 2. With 2 it is a truncated hierarchical B-spline, with
        /// fewest coefficients; estimator must be PLANISH_PHT_ESTIMATOR_GLOBAL, symmetry PLANISH_SYMMETRY_NONE and all sides
        /// free, grade is not looked at, several initial grids are tried unless grid_u or grid_v is given, smoothing weighs one plate
        /// over the whole surface, 1e-8 of it against the mean square error, and parameters are corrected by a fit with
        /// one continuous derivative that comes first.
        pub continuity: u32 = 1,
        /// A planish_coarsening. Default PLANISH_COARSENING_AUTO.
        pub coarsening: u32 = planish_coarsening::Auto as u32,
    }
}

impl planish_pht_options {
    /// Refuses what only the fit of a shape uses.
    fn refuse_correction(&self, call: &'static str) -> Result<(), ArgumentError> {
        let usual = Self::default();
        unused(self.correction_sweeps == usual.correction_sweeps, "correction_sweeps", call)
    }

    /// # Safety
    /// The pointers are NULL or as the header says, for `count` data, until the options are no longer used.
    unsafe fn to_core<'a>(self, count: usize) -> Result<PhtOptions<'a>, ArgumentError> {
        if self.reserved_end != 0 {
            return Err(ArgumentError::Reserved { record: "planish_pht_options", given: self.reserved_end });
        }
        let parameterize = match self.parameterize {
            at if at.is_null() => None,
            // SAFETY: the caller's promise.
            at => Some(unsafe { planish_parameterize_options::of_fit(at) }?),
        };
        let continuity = match self.continuity {
            1 => Continuity::C1,
            2 => Continuity::C2,
            given => return Err(ArgumentError::Continuity { given }),
        };
        let coarsening = [Coarsening::Auto, Coarsening::On, Coarsening::Off];
        let estimators = [Estimator::Global, Estimator::LocalQuadratic, Estimator::LocalCubic];
        Ok(PhtOptions {
            // SAFETY: the caller's promise.
            sides: unsafe { sides!(self).to_core() }?,
            tolerance: tolerance(self.tolerance, self.tolerance_scale)?,
            continuity,
            coarsening: choice(self.coarsening, &coarsening, "coarsening")?,
            estimator: choice(self.estimator, &estimators, "estimator")?,
            smoothing: self.smoothing,
            initial_grid: [self.grid_u as usize, self.grid_v as usize],
            max_level: self.max_level,
            max_cells: self.max_cells,
            min_samples: self.min_samples as usize,
            grade: self.grade,
            correction_sweeps: self.correction_sweeps as usize,
            regularize: regularize(self.regularize)?,
            parameterize,
            // SAFETY: the caller's promise.
            weights: unsafe { slice_or_none(self.weights, count, "weights") }?,
            measure_distance: flag(self.measure_distance, "measure_distance")?,
            missing: missing(self.missing)?,
            // SAFETY: the caller's promise.
            demands: unsafe { demands!(self).to_core(count) }?,
        })
    }
}

/// Runs a fit of `count` data.
///
/// # Safety
/// The pointers are NULL or as the header says.
unsafe fn fit(
    count: usize,
    options: *const planish_pht_options,
    out_surface: *mut *mut planish_surface,
    out_report: *mut planish_fit_report,
    method: impl FnOnce(&PhtOptions, &mut Control) -> Result<PhtFit, FitError> + Send,
) -> Result<planish_status, Failure> {
    // SAFETY: the caller's promises.
    unsafe {
        let given = self::options(options)?;
        let (parameters, errors) = (given.out_parameters, given.out_errors);
        let outputs = FitOutputs::new((out_surface, "out_surface"), out_report, parameters, errors, count)?;
        let outputs = outputs.and_left_out(given.out_left_out, count)?.and_plane(given.out_plane)?;
        let options = given.to_core(count)?;
        let fit = with_control(given.thread_count, listener!(given), |control| method(&options, control))??;
        Ok(outputs.store(planish_surface::into_raw(fit.surface), &fit.parameters, &fit.errors, &fit.report))
    }
}

/// Fits a PHT-spline to the shape of a mesh: a smooth bicubic surface whose cells are as small as the shape asks,
/// place by place. A mesh without parameters is parameterized first, which changes nothing in the mesh. The
/// boundary loops become trims.
///
/// mesh:        not NULL.
/// options:     NULL for the defaults.
/// out_surface: receives a new surface of dim 3; destroy with planish_surface_free().
/// out_report:  receives what the fit did and how good it is; NULL for no report.
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_FOLDED_PARAMETERS, PLANISH_STATUS_TOLERANCE_NOT_MET,
/// PLANISH_STATUS_STAGNATED (all three with the best surface found) or an error: PLANISH_STATUS_NULL_POINTER,
/// PLANISH_STATUS_INVALID_ARGUMENT (an option, or fewer than 3 data; fixed data that contradict each other; a mesh that
/// is not symmetric), PLANISH_STATUS_INDEX (a fixed datum that does not exist), PLANISH_STATUS_NOT_FINITE (a weight or a
/// tolerance; the index is the datum), PLANISH_STATUS_TOPOLOGY (a plane of symmetry that does not cut the mesh in two),
/// PLANISH_STATUS_DEGENERATE (all data have the same u or the same v),
/// PLANISH_STATUS_SINGULAR (the data do not determine a surface), PLANISH_STATUS_VERSION or
/// PLANISH_STATUS_CANCELLED; for a mesh without parameters also what planish_mesh_parameterize() returns.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_pht_fit(
    mesh: *const planish_mesh,
    options: *const planish_pht_options,
    out_surface: *mut *mut planish_surface,
    out_report: *mut planish_fit_report,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let usual = planish_pht_options::default();
        unused(self::options(options)?.missing == usual.missing, "missing", "planish_pht_fit")?;
        let mesh = &deref(mesh, "mesh")?.0;
        let count = mesh.points().len();
        fit(count, options, out_surface, out_report, |options, control| fit_mesh(mesh, options, control))
    })
}

/// Fits a PHT-spline to values at scattered parameters.
///
/// uv:          count rows of u, v.
/// values:      count rows of dim numbers.
/// count:       at least 3.
/// dim:         numbers of a value, at least 1.
/// options:     NULL for the defaults; parameterize, regularize and correction_sweeps are not used, and
///              refused unless they are at their defaults.
/// out_surface: receives a new surface; destroy with planish_surface_free().
/// out_report:  receives what the fit did and how good it is; NULL for no report.
/// Arrays: uv[count, 2], values[count, dim].
/// Returns what planish_pht_fit() returns; PLANISH_STATUS_NOT_FINITE also for uv and values (the index is the
/// datum), PLANISH_STATUS_TOO_LARGE (count times dim) and PLANISH_STATUS_OUT_OF_MEMORY.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_pht_fit_points(
    uv: *const f64,
    values: *const f64,
    count: usize,
    dim: usize,
    options: *const planish_pht_options,
    out_surface: *mut *mut planish_surface,
    out_report: *mut planish_fit_report,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let (given, call) = (self::options(options)?, "planish_pht_fit_points");
        given.refuse_correction(call)?;
        unused(given.regularize == planish_pht_options::default().regularize, "regularize", call)?;
        unused(given.parameterize.is_null(), "parameterize", call)?;
        let uv = copy_rows(uv, count, 2, "uv", DVec2::from_array)?;
        let values = slice(values, array_len::<f64>(count, dim, "values")?, "values")?;
        fit(count, options, out_surface, out_report, |options, control| {
            fit_points(&uv, values, dim, options, control)
        })
    })
}

/// Fits a PHT-spline to values on the nodes of a mesh, over the same parameters as its shape.
///
/// mesh:        not NULL.
/// values:      count rows of dim numbers.
/// count:       planish_mesh_point_count(), or planish_mesh_triangle_count() for values that are taken at the centroids of
///              the triangles; a datum is then a triangle.
/// dim:         numbers of a value, at least 1.
/// options:     NULL for the defaults; correction_sweeps is not used, and refused unless it is at its
///              default.
/// out_surface: receives a new surface; destroy with planish_surface_free().
/// out_report:  receives what the fit did and how good it is; NULL for no report.
/// Arrays: values[count, dim].
/// Returns what planish_pht_fit() returns; PLANISH_STATUS_INVALID_ARGUMENT also for count,
/// PLANISH_STATUS_NOT_FINITE also for values (the index is the node), and PLANISH_STATUS_TOO_LARGE.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_pht_fit_field(
    mesh: *const planish_mesh,
    values: *const f64,
    count: usize,
    dim: usize,
    options: *const planish_pht_options,
    out_surface: *mut *mut planish_surface,
    out_report: *mut planish_fit_report,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        self::options(options)?.refuse_correction("planish_pht_fit_field")?;
        let mesh = &deref(mesh, "mesh")?.0;
        check_field_count(mesh, count)?;
        let values = slice(values, array_len::<f64>(count, dim, "values")?, "values")?;
        fit(count, options, out_surface, out_report, |options, control| {
            fit_field(mesh, values, dim, options, control)
        })
    })
}
