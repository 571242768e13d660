//! Models of patches that somebody else made.

use super::arguments::{ArgumentError, ReportOut, deref, options, out, slice};
use super::choices::tolerance;
use super::guard::guard;
use super::model::planish_model;
use super::planish_status;
use super::progress::{planish_progress, with_control};
use super::report::{gravest, planish_stop_reason};
use super::surface::planish_surface;
use crate::fit::model::from_patches::{FromPatchesOptions, FromPatchesReport, smooth_from_patches};
use crate::surface::tensor::TensorSurface;
use std::ffi::c_void;

record! {
    /// How patches become one smooth model. Fill with planish_smooth_options_init(), then change what you need.
    pub struct planish_smooth_options (planish_smooth_options_init; core: FromPatchesOptions) {
        /// Hears of the progress and may cancel; NULL (default) for nobody.
        pub progress: planish_progress,
        /// Handed to progress as it is.
        pub user: *mut c_void,
        /// Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
        pub cancel: *const i32,
        /// Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
        /// Array: [1].
        pub out_stage: *mut u32,
        /// Largest deviation from the given surfaces allowed. Default 1e-3.
        pub tolerance: f64 = core.tolerance.value,
        /// Within what distance corners and sides of patches meet. Default 1e-3.
        pub join_tolerance: f64 = core.join_tolerance.value,
        /// Weight of the plate energy of each cell of a patch, mapped to the unit cell. Default 1e-6.
        pub smoothing: f64 = core.smoothing,
        /// Most cells of all patches of a piece. Default 200000.
        pub max_cells: usize = core.max_cells,
        /// What both tolerances are measured in: a planish_tolerance_scale; PLANISH_TOLERANCE_SCALE_RELATIVE (default): the
        /// diagonal of the box around all control points.
        pub tolerance_scale: u32,
        /// Most rounds of fitting and refining. Default 12.
        pub max_rounds: u32 = core.max_rounds as u32,
        /// By how much the levels of the cells in one face may differ. Default 1.
        pub level_spread: u32 = core.level_spread,
        /// Threads that share the work; 0 (default) for all cores. The result does not depend on it.
        pub thread_count: u32,
    }
}

record! {
    /// What became of patches. Set struct_size to sizeof(planish_smooth_report) before the call; the report is filled as
    /// far as that goes, on success only. Lengths are in model units.
    pub struct planish_smooth_report {
        /// Largest distance between places all over the given surfaces and the model.
        pub max_deviation: f64,
        /// Square root of the mean of its square.
        pub rms_deviation: f64,
        /// Its mean.
        pub mean_deviation: f64,
        /// The tolerance that was kept or missed.
        pub tolerance: f64,
        /// Diagonal of the box around all given control points.
        pub diagonal: f64,
        /// Largest distance between given sides that were joined.
        pub given_gap: f64,
        /// Largest difference of unit normals across given sides that were joined.
        pub given_normal_jump: f64,
        /// Largest distance between the two sides of an edge of the model.
        pub gap: f64,
        /// Largest difference of unit normals across edges of the model.
        pub normal_jump: f64,
        /// Volume that closed pieces enclose.
        pub volume: f64,
        /// Seconds in all.
        pub seconds: f64,
        /// The given patch that deviates most.
        pub worst_patch: usize,
        /// Sides that were joined, counted once for both.
        pub joined_count: usize,
        /// Sides that stayed free.
        pub free_count: usize,
        /// Pieces: shells of the model.
        pub piece_count: usize,
        /// Control points, four a vertex of the cells of each patch.
        pub coefficient_count: usize,
        /// Cells of all patches.
        pub cell_count: usize,
        /// Everything worth knowing: bits of planish_remark.
        pub remarks: u64,
        /// Rounds of fitting and measuring of the piece that took most.
        pub pass_count: u32,
        /// A planish_stop_reason, why the fit ended.
        pub stop_reason: u32,
    }
}

impl From<&FromPatchesReport> for planish_smooth_report {
    fn from(report: &FromPatchesReport) -> Self {
        Self {
            struct_size: size_of::<Self>(),
            max_deviation: report.max_deviation,
            rms_deviation: report.rms_deviation,
            mean_deviation: report.mean_deviation,
            tolerance: report.tolerance,
            diagonal: report.diagonal,
            given_gap: report.given_gap,
            given_normal_jump: report.given_normal_jump,
            gap: report.gap,
            normal_jump: report.normal_jump,
            volume: report.volume,
            seconds: report.seconds,
            worst_patch: report.worst_patch,
            joined_count: report.joined_count,
            free_count: report.free_count,
            piece_count: report.piece_count,
            coefficient_count: report.coefficient_count,
            cell_count: report.cell_count,
            remarks: report.remarks.0,
            pass_count: report.passes as u32,
            stop_reason: planish_stop_reason::from(report.stop) as u32,
        }
    }
}

/// Makes one smooth model of four-sided patches that meet edge to edge within a tolerance: tensor surfaces of any degree,
/// over their whole domains. The patches of the model share position and tangent plane along all their edges to rounding;
/// the report says how far they are from the given ones, and how far those were apart. Patches that look the other way than
/// their neighbours are turned; several pieces become several shells, closed ones solids.
///
/// surfaces:   count tensor surfaces in space without trims; they stay as they are.
/// count:      at least 1.
/// options:    NULL for the defaults.
/// out_model:  receives a new model; destroy with planish_model_free().
/// out_report: receives what became of the patches; NULL for no report.
/// Arrays: surfaces[count].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_TOLERANCE_NOT_MET or PLANISH_STATUS_STAGNATED (the best model found is
/// there), or an error: PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option, no patches, a dimension
/// that is not 3, trims; the index is the patch), PLANISH_STATUS_WRONG_KIND (no tensor surface),
/// PLANISH_STATUS_DEGENERATE (a side without length; the index is the patch), PLANISH_STATUS_TOPOLOGY (a third side at an
/// edge, a corner inside a side, a patch that meets itself, a one-sided surface: the index is the patch; an inner vertex
/// of two patches), PLANISH_STATUS_SINGULAR, PLANISH_STATUS_CANCELLED or PLANISH_STATUS_VERSION.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_smooth_from_patches(
    surfaces: *const *const planish_surface,
    count: usize,
    options: *const planish_smooth_options,
    out_model: *mut *mut planish_model,
    out_report: *mut planish_smooth_report,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let surfaces = slice(surfaces, count, "surfaces")?;
        let given = self::options(options)?;
        let out_model = out(out_model, "out_model")?;
        let report = ReportOut::new(out_report)?;
        let patch = |&surface: &*const planish_surface| deref(surface, "surfaces")?.tensor();
        let patches = surfaces.iter().map(patch).collect::<Result<Vec<&TensorSurface>, ArgumentError>>()?;
        let core = FromPatchesOptions {
            tolerance: tolerance(given.tolerance, given.tolerance_scale)?,
            join_tolerance: tolerance(given.join_tolerance, given.tolerance_scale)?,
            smoothing: given.smoothing,
            max_cells: given.max_cells,
            max_rounds: given.max_rounds as usize,
            level_spread: given.level_spread,
        };
        let (model, made) = with_control(given.thread_count, listener!(given), |control| {
            smooth_from_patches(&patches, &core, control)
        })??;
        report.store((&made).into());
        out_model.write(planish_model::into_raw(model));
        Ok(gravest(made.remarks.0))
    })
}
