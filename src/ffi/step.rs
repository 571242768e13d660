//! STEP files.

use super::arguments::{self, ArgumentError, Record, ReportOut, choice, deref, options, text};
use super::guard::guard;
use super::planish_status;
use super::progress::{planish_progress, with_control};
use super::surface::planish_surface;
use crate::Error;
use crate::control::Stage;
use crate::export::step::{Schema, StepOptions, StepReport, Unit, write};
use crate::fit::conversion::{ConversionOptions, to_model};
use crate::model::{Form, FormOptions};
use libc::{c_char, c_void};

/// The application protocol of a STEP file.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_step_schema {
    /// AP214, automotive design: read by every CAD system.
    Ap214 = 0,
    /// AP242, managed model-based 3D engineering.
    Ap242 = 1,
}

/// What one model unit is.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_unit {
    /// A millimetre.
    Millimetre = 0,
    /// A metre.
    Metre = 1,
    /// An inch, 25.4 mm.
    Inch = 2,
}

/// What a STEP file holds of a T-spline or PHT-spline.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_step_form {
    /// The same surface as one tensor surface.
    Tensor = 0,
    /// One face for each span of v, over the knots of four control curves: far fewer control points.
    Strips = 1,
    /// A PHT-spline as a shell of faces that share edges, each over a rectangle of cells whose levels differ by at
    /// most level_spread.
    Patches = 2,
}

record! {
    /// What was written to a STEP file.
    pub struct planish_step_report {
        /// Largest distance between an edge's curve in space and the image of its p-curve, measured on the curves
        /// written, in model units.
        pub curve_deviation: f64,
        /// The uncertainty that the file states, in model units: 1e-7 of the diagonal, or more if the curves need it.
        pub uncertainty: f64,
        /// Diagonal of the box around the part of the surface inside the trims.
        pub diagonal: f64,
        /// Bounds of all faces, the outer ones included.
        pub loop_count: usize,
        /// Edges; one between two faces counts once.
        pub edge_count: usize,
        /// Faces.
        pub face_count: usize,
        /// Control points of the surfaces of all faces.
        pub pole_count: usize,
    }
}

impl From<StepReport> for planish_step_report {
    fn from(report: StepReport) -> Self {
        Self {
            struct_size: size_of::<Self>(),
            curve_deviation: report.curve_deviation,
            uncertainty: report.uncertainty,
            diagonal: report.diagonal,
            loop_count: report.loop_count,
            edge_count: report.edge_count,
            face_count: report.face_count,
            pole_count: report.pole_count,
        }
    }
}

record! {
    /// What a STEP file says beside the shape. Fill with planish_step_options_init(), then change what you need.
    /// Texts are UTF-8, end with a NUL and are borrowed.
    pub struct planish_step_options (planish_step_options_init) {
        /// Name of the product; NULL (default) for the surface's, or "surface" if it has none.
        pub product: *const c_char,
        /// Who made it; NULL (default) for nobody.
        pub author: *const c_char,
        /// For whom; NULL (default) for nobody.
        pub organization: *const c_char,
        /// When, such as "2026-01-31T12:00:00"; NULL (default) for 1970-01-01T00:00:00, so that equal input gives
        /// equal bytes.
        pub timestamp: *const c_char,
        /// Receives what was written, or NULL (default). Set its struct_size before. Filled on success only.
        pub out_report: *mut planish_step_report,
        /// Hears of the progress and may cancel; NULL (default) for nobody.
        pub progress: planish_progress,
        /// Handed to progress as it is.
        pub user: *mut c_void,
        /// Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
        pub cancel: *const i32,
        /// Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
        /// Array: [1].
        pub out_stage: *mut u32,
        /// A planish_step_schema; PLANISH_STEP_SCHEMA_AP214 (default).
        pub schema: u32 = planish_step_schema::Ap214 as u32,
        /// A planish_unit, what one model unit is; PLANISH_UNIT_MILLIMETRE (default) leaves it to the surface.
        pub unit: u32 = planish_unit::Millimetre as u32,
        /// Most control points of PLANISH_STEP_FORM_TENSOR. Default 4000000.
        pub max_coefficients: usize = FormOptions::default().max_coefficients,
        /// A planish_step_form, what is written of a T-spline or PHT-spline; PLANISH_STEP_FORM_TENSOR (default), which
        /// is also taken where the form is of another family.
        pub form: u32 = planish_step_form::Tensor as u32,
        /// By how much the levels of cells in one face of PLANISH_STEP_FORM_PATCHES may differ. Default 1; more gives
        /// fewer faces with more control points.
        pub level_spread: u32 = FormOptions::default().level_spread,
        /// A D1RC-spline is written as a tensor surface fitted within this, in model units, at the nodes of a fine
        /// tessellation; 0 (default) takes 1e-3 of the diagonal.
        pub tolerance: f64,
        /// Threads to use, at most 1024; 0 (default) for all cores. Results do not depend on it.
        pub thread_count: u32,
        /// 0.
        pub reserved: u32,
    }
}

impl planish_step_options {
    /// # Safety
    /// The texts are NULL or end with a NUL, and nobody changes them for `'a`.
    pub(super) unsafe fn core<'a>(&self) -> Result<StepOptions<'a>, ArgumentError> {
        if self.reserved != 0 {
            return Err(ArgumentError::Reserved { record: Self::NAME, given: self.reserved });
        }
        let defaults = StepOptions::default();
        let or = |at: *const c_char, name, default| match at.is_null() {
            true => Ok(default),
            // SAFETY: the caller's promise.
            false => unsafe { text(at, name) },
        };
        Ok(StepOptions {
            schema: choice(self.schema, &[Schema::Ap214, Schema::Ap242], "schema")?,
            unit: choice(self.unit, &Unit::ALL, "unit")?,
            product: or(self.product, "product", defaults.product)?,
            author: or(self.author, "author", defaults.author)?,
            organization: or(self.organization, "organization", defaults.organization)?,
            timestamp: or(self.timestamp, "timestamp", defaults.timestamp)?,
        })
    }

    /// How a surface becomes what is written.
    fn conversion(&self) -> Result<ConversionOptions, ArgumentError> {
        let form = FormOptions {
            form: choice(self.form, &[Form::Tensor, Form::Strips, Form::Patches], "form")?,
            level_spread: self.level_spread,
            max_coefficients: self.max_coefficients,
        };
        Ok(ConversionOptions { form, tolerance: self.tolerance })
    }
}

/// Writes a surface in space as a STEP file with one face, bounded by the surface's trims or, if it has none, by its
/// domain. A T-spline or PHT-spline is written as the same tensor surface, or as a shell of faces that share their
/// edges: trims are cut where they cross the faces' common sides, and where they run within 1e-7 of the domain's
/// size beside one they are moved on to it. P-curves are the trims themselves, of degree 1; curves in space are cubic
/// and follow them over the same parameters within the uncertainty that the file states. The file appears whole or
/// not at all; equal input gives equal bytes. A D1RC-spline is written as a tensor surface fitted to it.
///
/// surface: not NULL, of dimension 3.
/// path:    ends with a NUL; on Unix any bytes, elsewhere UTF-8. An existing file is replaced, see planish_mesh_write().
/// options: NULL for the defaults.
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (the dimension, an
/// option, a text that is not UTF-8), PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_TOPOLOGY (trims that cross or
/// touch, the index is one of them; trims around several pieces; a knot inside the domain that occurs more often
/// than the degree), PLANISH_STATUS_TOO_LARGE (max_coefficients, or tolerance is
/// missed), PLANISH_STATUS_DEGENERATE (a trim without area, the index; a face without size) or
/// PLANISH_STATUS_FILE.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_write_step(
    surface: *const planish_surface,
    path: *const c_char,
    options: *const planish_step_options,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let surface = deref(surface, "surface")?.family()?;
        let path = arguments::path(path, "path")?;
        let given = self::options(options)?;
        let (mut core, conversion) = (given.core()?, given.conversion()?);
        let label = &surface.as_surface().region().label;
        if given.product.is_null() && !label.name.is_empty() {
            core.product = &label.name;
        }
        if core.unit == Unit::default() {
            core.unit = label.unit;
        }
        let report = ReportOut::new(given.out_report)?;
        let written = with_control(given.thread_count, listener!(given), |control| -> Result<_, Error> {
            control.enter(Stage::Convert);
            let model = to_model(surface, &conversion, control)?;
            control.enter(Stage::Write);
            Ok(write(&model, &core, path, control.pool().watch())?)
        })??;
        report.store(written.into());
        Ok(())
    })
}
