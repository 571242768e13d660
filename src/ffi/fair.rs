//! Fairness of surfaces.

use super::arguments::{ArgumentError, ReportOut, array_len, choice, copy_rows, deref, options, out, slice};
use super::choices::{planish_tolerance_scale, tolerance};
use super::guard::guard;
use super::planish_status;
use super::progress::{planish_progress, with_control};
use super::surface::planish_surface;
use crate::fit::fair::{FairData, FairLimit, FairOptions, FairReport, Fairness, KeptBorder, fair};
use glam::DVec2;
use libc::c_void;

/// Which energy of a surface is lowered.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_fairness {
    /// Bending: flat is best.
    ThinPlate = 0,
    /// Change of bending: round is as good as flat. For surfaces of continuous curvature: no PHT-splines.
    CurvatureVariation = 1,
}

/// What of the border of a surface's domain stays as it is.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_kept_border {
    /// Nothing.
    None = 0,
    /// Its place.
    Position = 1,
    /// Its place and its tangent planes.
    Tangent = 2,
}

/// How far the energy of a surface is lowered where there are data.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_fair_limit {
    /// Until the surface tells each datum best from the others (generalized cross-validation): noise goes, and what is no
    /// noise stays.
    Noise = 0,
    /// As far as the tolerance lets it: what is narrower than that allows is flattened too.
    Tolerance = 1,
}

record! {
    /// How a surface is made fair. Fill with planish_fair_options_init(), then change what you need.
    pub struct planish_fair_options (planish_fair_options_init; core: FairOptions) {
        /// How far the surface may come to lie from itself, or from the data, positive, measured in tolerance_scale.
        /// Default 1e-3.
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
        /// A planish_tolerance_scale; relative is to the diagonal of the box of the control points, or of the data.
        /// Default PLANISH_TOLERANCE_SCALE_RELATIVE.
        pub tolerance_scale: u32 = planish_tolerance_scale::Relative as u32,
        /// A planish_fairness. Default PLANISH_FAIRNESS_THIN_PLATE.
        pub energy: u32 = planish_fairness::ThinPlate as u32,
        /// A planish_kept_border. Default PLANISH_KEPT_BORDER_NONE.
        pub border: u32 = planish_kept_border::None as u32,
        /// A planish_fair_limit, for data; without data the energy is lowered as far as the tolerance lets it. Default
        /// PLANISH_FAIR_LIMIT_NOISE.
        pub limit: u32 = planish_fair_limit::Noise as u32,
    }
}

impl planish_fair_options {
    fn to_core(self) -> Result<FairOptions, ArgumentError> {
        let energies = [Fairness::ThinPlate, Fairness::CurvatureVariation];
        let borders = [KeptBorder::None, KeptBorder::Position, KeptBorder::Tangent];
        Ok(FairOptions {
            tolerance: tolerance(self.tolerance, self.tolerance_scale)?,
            energy: choice(self.energy, &energies, "energy")?,
            border: choice(self.border, &borders, "border")?,
            limit: choice(self.limit, &[FairLimit::Noise, FairLimit::Tolerance], "limit")?,
        })
    }
}

record! {
    /// What fairing did. Set struct_size to sizeof(planish_fair_report) before the call; the report is filled as far as
    /// that goes, on success only. Lengths are in model units.
    pub struct planish_fair_report {
        /// Energy before: the integral over the surface, in its own parameters, which count as much as their lines are
        /// long on the average.
        pub energy_before: f64,
        /// Energy after; never more.
        pub energy_after: f64,
        /// Largest distance to the reference at equal (u,v): of data an error, of the surface itself a proven bound.
        pub max_deviation: f64,
        /// Root mean square of the errors of the data; without data, of the bounds of the cells.
        pub rms_deviation: f64,
        /// No place of the surface moved by more.
        pub max_movement: f64,
        /// The tolerance.
        pub tolerance: f64,
        /// What a relative tolerance is measured in.
        pub diagonal: f64,
        /// The weight of the energy against the square of distances; 0 if nothing was gained.
        pub smoothing: f64,
        /// Wall time in seconds.
        pub seconds: f64,
        /// Systems solved.
        pub pass_count: usize,
    }
}

impl From<&FairReport> for planish_fair_report {
    fn from(report: &FairReport) -> Self {
        Self {
            struct_size: size_of::<Self>(),
            energy_before: report.energy_before,
            energy_after: report.energy_after,
            max_deviation: report.max_deviation,
            rms_deviation: report.rms_deviation,
            max_movement: report.max_movement,
            tolerance: report.tolerance,
            diagonal: report.diagonal,
            smoothing: report.smoothing,
            seconds: report.seconds,
            pass_count: report.passes,
        }
    }
}

/// Makes a surface of less energy that stays within a tolerance of the surface, or of data: of the same family, over the
/// same knots or cells, with the same trims. For tensor surfaces and PHT-splines without weights.
///
/// surface:     not NULL; stays as it is.
/// uv:          count rows of u, v in the domain, at which the surface is to stay near the data; NULL for no data: near
///              itself.
/// values:      count rows of planish_surface_dim() numbers; NULL for no data.
/// count:       number of data; 0 for none.
/// options:     NULL for the defaults.
/// out_surface: receives a new surface; destroy with planish_surface_free().
/// out_report:  receives what was done; NULL for no report.
/// Arrays: uv[count, 2], values[count, surface_dim].
/// Returns PLANISH_STATUS_OK or an error: PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option; the
/// surface misses a datum by more than the tolerance, which is the index; or curvature jumps and its variation was
/// asked for), PLANISH_STATUS_NOT_FINITE (uv or values; the index is the datum), PLANISH_STATUS_OUTSIDE (the datum is
/// the index), PLANISH_STATUS_WRONG_KIND (the family, or weights), PLANISH_STATUS_SINGULAR, PLANISH_STATUS_TOO_LARGE,
/// PLANISH_STATUS_OUT_OF_MEMORY, PLANISH_STATUS_VERSION or PLANISH_STATUS_CANCELLED.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_fair(
    surface: *const planish_surface,
    uv: *const f64,
    values: *const f64,
    count: usize,
    options: *const planish_fair_options,
    out_surface: *mut *mut planish_surface,
    out_report: *mut planish_fair_report,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let surface = deref(surface, "surface")?.family()?;
        let given = self::options(options)?;
        let out_surface = out(out_surface, "out_surface")?;
        let report = ReportOut::new(out_report)?;
        let core = given.to_core()?;
        let uv = copy_rows(uv, count, 2, "uv", DVec2::from_array)?;
        let len = array_len::<f64>(count, surface.as_surface().dim(), "values")?;
        let values = slice(values, len, "values")?;
        let data = (count > 0).then_some(FairData { uv: &uv, values });
        // results are the same for any number of threads, and one is enough
        let faired = with_control(1, listener!(given), |control| fair(surface, data, &core, control))??;
        report.store((&faired.report).into());
        out_surface.write(planish_surface::into_raw(faired.surface));
        Ok(())
    })
}
