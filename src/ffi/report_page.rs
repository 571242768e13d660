//! The report as a page.

use super::arguments::{self, ArgumentError, deref, options, text};
use super::choices::tolerance_scale;
use super::guard::guard;
use super::mesh::planish_mesh;
use super::model::planish_model;
use super::planish_status;
use super::progress::{planish_progress, with_control};
use super::surface::planish_surface;
use crate::export::html::{ReportOptions, write_model_report, write_report};
use crate::fit::common::report::Remarks;
use libc::{c_char, c_void};

record! {
    /// What a report says beside what it measures. Fill with planish_report_options_init(), then change what you need.
    /// Texts are UTF-8, end with a NUL and are borrowed.
    pub struct planish_report_options (planish_report_options_init) {
        /// The headline; NULL (default) for "Deviation".
        pub title: *const c_char,
        /// What one unit of length is called; NULL (default) for "mm".
        pub unit: *const c_char,
        /// The largest distance allowed, where the colours end, measured in tolerance_scale; 0 (default) takes the
        /// largest distance found.
        pub tolerance: f64,
        /// Hears of the progress and may cancel; NULL (default) for nobody.
        pub progress: planish_progress,
        /// Handed to progress as it is.
        pub user: *mut c_void,
        /// Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
        pub cancel: *const i32,
        /// Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
        /// Array: [1].
        pub out_stage: *mut u32,
        /// What the fit had to remark, explained on the page: bits of planish_remark. Default 0.
        pub remarks: u64,
        /// A planish_tolerance_scale; PLANISH_TOLERANCE_SCALE_RELATIVE (default): to the diagonal of the mesh's box.
        pub tolerance_scale: u32,
        /// Threads to use, at most 1024; 0 (default) for all cores. The page does not depend on it.
        pub thread_count: u32,
    }
}

impl planish_report_options {
    /// The core's options.
    ///
    /// # Safety
    /// Texts are NULL or end with a NUL, and stay as they are.
    unsafe fn core(&self) -> Result<ReportOptions<'_>, ArgumentError> {
        let defaults = ReportOptions::default();
        // SAFETY: the caller's promise.
        let or = |given: *const c_char, default, name| unsafe {
            if given.is_null() { Ok(default) } else { text(given, name) }
        };
        Ok(ReportOptions {
            title: or(self.title, defaults.title, "title")?,
            unit: or(self.unit, defaults.unit, "unit")?,
            tolerance: Some(self.tolerance).filter(|&value| value != 0.0),
            tolerance_scale: tolerance_scale(self.tolerance_scale, "tolerance_scale")?,
            remarks: Remarks(self.remarks),
        })
    }
}

/// Measures a surface in space against a mesh and writes the result as one HTML page that needs nothing from outside:
/// the mesh in the colours of its signed distances (positive on the side of the normal), the surface and its control
/// net, a section plane, a histogram, the ten worst places, and the numbers in words.
///
/// surface: not NULL, of dimension 3.
/// mesh:    not NULL.
/// path:    the file, UTF-8; not NULL. Replaced as a whole.
/// options: NULL for the defaults.
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (the dimension, or an option),
/// PLANISH_STATUS_TOO_LARGE (the surface needs too many triangles), PLANISH_STATUS_FILE, PLANISH_STATUS_VERSION or
/// PLANISH_STATUS_CANCELLED.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_write_report(
    surface: *const planish_surface,
    mesh: *const planish_mesh,
    path: *const c_char,
    options: *const planish_report_options,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let surface = deref(surface, "surface")?.any();
        let mesh = &deref(mesh, "mesh")?.0;
        let path = arguments::path(path, "path")?;
        let given = self::options(options)?;
        let core = given.core()?;
        with_control(given.thread_count, listener!(given), |control| {
            write_report(surface, mesh, &core, path, control)
        })??;
        Ok(())
    })
}

/// Measures a model against a mesh and writes the result as one HTML page, as planish_surface_write_report() does: the mesh in
/// the colours of its signed distances (positive in front of the faces), the model, a section plane, a histogram, the ten
/// worst places, and the numbers in words.
///
/// model:   not NULL.
/// mesh:    not NULL.
/// path:    the file, UTF-8; not NULL. Replaced as a whole.
/// options: NULL for the defaults.
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND (a field), an error of
/// planish_model_deviation() or planish_model_tessellate(), PLANISH_STATUS_INVALID_ARGUMENT (an option),
/// PLANISH_STATUS_FILE, PLANISH_STATUS_VERSION or PLANISH_STATUS_CANCELLED.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_write_report(
    model: *const planish_model,
    mesh: *const planish_mesh,
    path: *const c_char,
    options: *const planish_report_options,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let model = deref(model, "model")?.core()?;
        let mesh = &deref(mesh, "mesh")?.0;
        let path = arguments::path(path, "path")?;
        let given = self::options(options)?;
        let core = given.core()?;
        with_control(given.thread_count, listener!(given), |control| {
            write_model_report(model, mesh, &core, path, control)
        })??;
        Ok(())
    })
}
