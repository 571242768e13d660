//! Tensor product B-spline surfaces: fits.

use super::arguments::{
    ArgumentError, array_len, choice, copy_rows, deref, flag, options, slice, slice_or_none, unused,
};
use super::choices::{
    ends, energy, missing, planish_ends, planish_energy, planish_knots, planish_missing, planish_regularize,
    planish_tensor_method, planish_tolerance_scale, regularize, tolerance,
};
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
use crate::fit::tensor::{Knots, Method, TensorFit, TensorOptions, fit_field, fit_mesh, fit_points};
use glam::DVec2;
use libc::c_void;

record! {
    /// Options of tensor fits. Fill with planish_tensor_options_init(), then change what you need.
    ///
    /// A datum is a node of the mesh, or a point.
    pub struct planish_tensor_options (planish_tensor_options_init; core: TensorOptions) {
        /// The largest error allowed at the data, positive, measured in tolerance_scale. Default 1e-3.
        pub tolerance: f64 = core.tolerance.value,
        /// Weight of the bending energy; 0 (default) finds one: of uniform knots the largest of 1e-3, 1e-4, 1e-5,
        /// 1e-6 that meets the tolerance (for PLANISH_TENSOR_METHOD_FERGUSON 1e-3), of adaptive knots 1e-11 or
        /// less, the weight of a thin plate over the unit square against the mean square error; where the
        /// tolerance is out of reach, adaptive knots take the one of least generalized cross-validation.
        pub smoothing: f64 = core.smoothing,
        /// How far the knots reach beyond the data, as a fraction of the data's range, 0 to 10. Default 0.1.
        /// Adaptive knots reach less far where the surface would leave the box of its data.
        pub buffer: f64 = core.buffer,
        /// How a mesh without parameters gets them; NULL (default) for the defaults. Of this record progress, user
        /// and thread_count are not looked at, and node_weights must be NULL. Not used for points.
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
        /// Most unknowns of one grid, at least 4. Default 66049.
        pub max_coefficients: usize = core.max_coefficients,
        /// A planish_tolerance_scale. Default PLANISH_TOLERANCE_SCALE_RELATIVE.
        pub tolerance_scale: u32 = planish_tolerance_scale::Relative as u32,
        /// A planish_tensor_method. Default PLANISH_TENSOR_METHOD_LEAST_SQUARES.
        pub method: u32 = planish_tensor_method::LeastSquares as u32,
        /// A planish_ends, of uniform knots. Default PLANISH_ENDS_NATURAL.
        pub ends: u32 = planish_ends::Natural as u32,
        /// A planish_energy, of uniform knots. Default PLANISH_ENERGY_BEAM.
        pub energy: u32 = planish_energy::Beam as u32,
        /// A planish_regularize. Default PLANISH_REGULARIZE_AUTO.
        pub regularize: u32 = planish_regularize::Auto as u32,
        /// Most knots along one direction, at least 2. Default 257.
        pub max_grid: u32 = core.max_grid as u32,
        /// Knots along u to use without refinement, 2 to 8193; 0 (default, then grid_v too) refines.
        pub grid_u: u32,
        /// Knots along v to use without refinement, 2 to 8193; 0 (default, then grid_u too) refines.
        pub grid_v: u32,
        /// Sweeps of parameter correction on each grid: data move to their foot points, then the fit is repeated.
        /// Default 0.
        pub correction_sweeps: u32 = core.correction_sweeps as u32,
        /// 1 measures the closest-point distance of the nodes for the report. Default 0.
        pub measure_distance: u32 = core.measure_distance.into(),
        /// Threads to use, at most 1024; 0 (default) for all cores. Results do not depend on it.
        pub thread_count: u32,
        /// A planish_knots. Default PLANISH_KNOTS_ADAPTIVE. Knots given by grid_u and grid_v, and those of
        /// PLANISH_TENSOR_METHOD_FERGUSON, are uniform always.
        pub knots: u32 = planish_knots::Adaptive as u32,
        /// A planish_missing: what values of points and fields mean that are NaN. Default PLANISH_MISSING_REFUSED. Not
        /// used for the shape of a mesh.
        pub missing: u32 = planish_missing::Refused as u32,
        /// A planish_symmetry, for the shape of a mesh over adaptive knots. Default PLANISH_SYMMETRY_NONE.
        pub symmetry: u32 = planish_symmetry::None as u32,
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
        /// without knots of more than one inside. With sides that are given the surface has their lines among its own, free
        /// ends and no buffer.
        pub curve_u_low: *const planish_curve,
        /// The curve that the side at the largest u is, exactly; NULL (default) for a free side. As curve_u_low.
        pub curve_u_high: *const planish_curve,
        /// The curve that the side at the least v is, exactly; NULL (default) for a free side. As curve_u_low.
        pub curve_v_low: *const planish_curve,
        /// The curve that the side at the largest v is, exactly; NULL (default) for a free side. As curve_u_low.
        pub curve_v_high: *const planish_curve,
        /// The tensor surface beyond the side at the least u; NULL (default) for none. Bicubic, clamped, without weights:
        /// the side takes over its side that lies nearest to the data, and its tangent planes there.
        pub neighbour_u_low: *const planish_surface,
        /// The tensor surface beyond the side at the largest u; NULL (default) for none. As neighbour_u_low.
        pub neighbour_u_high: *const planish_surface,
        /// The tensor surface beyond the side at the least v; NULL (default) for none. As neighbour_u_low.
        pub neighbour_v_low: *const planish_surface,
        /// The tensor surface beyond the side at the largest v; NULL (default) for none. As neighbour_u_low.
        pub neighbour_v_high: *const planish_surface,
        /// The period of a surface that closes along u: after so much of it the surface goes on as it began, with slope and
        /// curvature. For points; at least the range of their u. 0 (default) for an open surface. Ends are free, and there is
        /// no buffer.
        pub period_u: f64,
        /// The same along v. Default 0.
        pub period_v: f64,
    }
}

impl planish_tensor_options {
    /// Refuses what a fit without a mesh does not use.
    pub(super) fn refuse_map_options(&self, call: &'static str) -> Result<(), ArgumentError> {
        let usual = Self::default();
        unused(self.regularize == usual.regularize, "regularize", call)?;
        unused(self.parameterize.is_null(), "parameterize", call)
    }

    /// # Safety
    /// The pointers are NULL or as the header says, for `count` data, until the options are no longer used.
    pub(super) unsafe fn to_core<'a>(self, count: usize) -> Result<TensorOptions<'a>, ArgumentError> {
        Ok(TensorOptions {
            periods: [self.period_u, self.period_v],
            // SAFETY: the caller's promise.
            sides: unsafe { sides!(self).to_core() }?,
            tolerance: tolerance(self.tolerance, self.tolerance_scale)?,
            knots: choice(self.knots, &[Knots::Adaptive, Knots::Uniform], "knots")?,
            method: choice(self.method, &[Method::LeastSquares, Method::Ferguson], "method")?,
            ends: ends(self.ends)?,
            energy: energy(self.energy)?,
            smoothing: self.smoothing,
            buffer: self.buffer,
            max_grid: self.max_grid as usize,
            max_coefficients: self.max_coefficients,
            fixed_grid: match [self.grid_u, self.grid_v] {
                [0, 0] => None,
                grid => Some(grid.map(|count| count as usize)),
            },
            correction_sweeps: self.correction_sweeps as usize,
            regularize: regularize(self.regularize)?,
            // SAFETY: the caller's promise.
            parameterize: unsafe { planish_parameterize_options::of_fit(self.parameterize) }?,
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
    options: *const planish_tensor_options,
    out_surface: *mut *mut planish_surface,
    out_report: *mut planish_fit_report,
    method: impl FnOnce(&TensorOptions, &mut Control) -> Result<TensorFit, FitError> + Send,
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

/// Fits a bicubic surface to the shape of a mesh, within a tolerance if the limits allow it. A mesh without
/// parameters is parameterized first, which changes nothing in the mesh. The boundary loops become trims.
///
/// mesh:        not NULL.
/// options:     NULL for the defaults.
/// out_surface: receives a new surface of dim 3; destroy with planish_surface_free().
/// out_report:  receives what the fit did and how good it is; NULL for no report.
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_FOLDED_PARAMETERS, PLANISH_STATUS_TOLERANCE_NOT_MET,
/// PLANISH_STATUS_STAGNATED (all three with the best surface found) or an error: PLANISH_STATUS_NULL_POINTER,
/// PLANISH_STATUS_INVALID_ARGUMENT (an option, or fewer than 3 data; fixed data or sides that contradict each other; a side
/// that is not where the data are; a mesh that is not symmetric), PLANISH_STATUS_INDEX (a fixed datum that does not
/// exist), PLANISH_STATUS_NOT_FINITE (a weight or a tolerance; the index is the datum), PLANISH_STATUS_TOPOLOGY (a plane
/// of symmetry that does not cut the mesh in two), PLANISH_STATUS_DEGENERATE (all data have the same u or the same v),
/// PLANISH_STATUS_SINGULAR (the data do not determine a surface), PLANISH_STATUS_VERSION or
/// PLANISH_STATUS_CANCELLED; for a mesh without parameters also what planish_mesh_parameterize() returns.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_tensor_fit(
    mesh: *const planish_mesh,
    options: *const planish_tensor_options,
    out_surface: *mut *mut planish_surface,
    out_report: *mut planish_fit_report,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let usual = planish_tensor_options::default();
        unused(self::options(options)?.missing == usual.missing, "missing", "planish_tensor_fit")?;
        let mesh = &deref(mesh, "mesh")?.0;
        let count = mesh.points().len();
        fit(count, options, out_surface, out_report, |options, control| fit_mesh(mesh, options, control))
    })
}

/// Fits a bicubic surface to values at scattered parameters.
///
/// uv:          count rows of u, v.
/// values:      count rows of dim numbers.
/// count:       at least 3.
/// dim:         numbers of a value, at least 1.
/// options:     NULL for the defaults; parameterize and regularize are not used, and refused unless they are at
///              their defaults.
/// out_surface: receives a new surface; destroy with planish_surface_free().
/// out_report:  receives what the fit did and how good it is; NULL for no report.
/// Arrays: uv[count, 2], values[count, dim].
/// Returns what planish_tensor_fit() returns; PLANISH_STATUS_NOT_FINITE also for uv and values (the index is
/// the datum), PLANISH_STATUS_TOO_LARGE (count times dim) and PLANISH_STATUS_OUT_OF_MEMORY.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_tensor_fit_points(
    uv: *const f64,
    values: *const f64,
    count: usize,
    dim: usize,
    options: *const planish_tensor_options,
    out_surface: *mut *mut planish_surface,
    out_report: *mut planish_fit_report,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        self::options(options)?.refuse_map_options("planish_tensor_fit_points")?;
        let uv = copy_rows(uv, count, 2, "uv", DVec2::from_array)?;
        let values = slice(values, array_len::<f64>(count, dim, "values")?, "values")?;
        fit(count, options, out_surface, out_report, |options, control| {
            fit_points(&uv, values, dim, options, control)
        })
    })
}

/// Fits a bicubic surface to values on the nodes of a mesh, over the same parameters as its shape.
///
/// mesh:        not NULL.
/// values:      count rows of dim numbers.
/// count:       planish_mesh_point_count(), or planish_mesh_triangle_count() for values that are taken at the centroids of
///              the triangles; a datum is then a triangle.
/// dim:         numbers of a value, at least 1.
/// options:     NULL for the defaults.
/// out_surface: receives a new surface; destroy with planish_surface_free().
/// out_report:  receives what the fit did and how good it is; NULL for no report.
/// Arrays: values[count, dim].
/// Returns what planish_tensor_fit() returns; PLANISH_STATUS_INVALID_ARGUMENT also for count,
/// PLANISH_STATUS_NOT_FINITE also for values (the index is the node), and PLANISH_STATUS_TOO_LARGE.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_tensor_fit_field(
    mesh: *const planish_mesh,
    values: *const f64,
    count: usize,
    dim: usize,
    options: *const planish_tensor_options,
    out_surface: *mut *mut planish_surface,
    out_report: *mut planish_fit_report,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let mesh = &deref(mesh, "mesh")?.0;
        check_field_count(mesh, count)?;
        let values = slice(values, array_len::<f64>(count, dim, "values")?, "values")?;
        fit(count, options, out_surface, out_report, |options, control| {
            fit_field(mesh, values, dim, options, control)
        })
    })
}
