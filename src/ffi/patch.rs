//! The common view of tensor surfaces, T-splines and PHT-splines: Bezier patches; and conversion.

use super::arguments::{ArgumentError, ReportOut, deref, options, out, rows_mut};
use super::guard::guard;
use super::planish_status;
use super::progress::{planish_progress, with_helper};
use super::surface::{planish_surface, query_surface};
use crate::bezier::BezierPatch;
use crate::control::Stage;
use crate::surface::Patches;
use glam::DVec2;
use libc::c_void;

record! {
    /// A Bezier patch: the polynomial or rational piece of a surface over a rectangle of parameters. Set struct_size
    /// to sizeof(planish_patch) before the call; filled as far as that goes, on success only.
    pub struct planish_patch {
        /// Least u of the rectangle.
        pub u_min: f64,
        /// Largest u of the rectangle.
        pub u_max: f64,
        /// Least v of the rectangle.
        pub v_min: f64,
        /// Largest v of the rectangle.
        pub v_max: f64,
        /// Number of ordinates: (degree_u + 1) * (degree_v + 1).
        pub ordinate_count: usize,
        /// Numbers of an ordinate: dim, or dim + 1 if the patch is rational.
        pub ordinate_width: usize,
        /// Degree along u.
        pub degree_u: u32,
        /// Degree along v.
        pub degree_v: u32,
        /// 1 if the last number of each ordinate is a weight, and the others are multiplied by it; else 0.
        pub is_rational: u32,
        /// 0.
        pub reserved: u32,
    }
}

impl From<&BezierPatch> for planish_patch {
    fn from(patch: &BezierPatch) -> Self {
        let [degree_u, degree_v] = patch.degree;
        Self {
            u_min: patch.domain.min.x,
            u_max: patch.domain.max.x,
            v_min: patch.domain.min.y,
            v_max: patch.domain.max.y,
            ordinate_count: (degree_u + 1) * (degree_v + 1),
            ordinate_width: patch.width(),
            degree_u: degree_u as u32,
            degree_v: degree_v as u32,
            is_rational: patch.is_rational.into(),
            ..Self::default()
        }
    }
}

fn patches(surface: &planish_surface) -> Result<&dyn Patches, ArgumentError> {
    surface.any().patches().ok_or(ArgumentError::NoPatches { found: surface.any().kind() })
}

/// Number of Bezier patches of a surface: they cover the domain without overlap and are the surface exactly. 0
/// for NULL and for a family that is not polynomial on rectangles.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_patch_count(surface: *const planish_surface) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_surface(surface, |surface| Ok(patches(surface)?.patch_count())) }
}

/// The number of the patch over a parameter pair; beyond the domain the one whose polynomial is continued there.
/// 0 for NULL and for a family without patches.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_patch_at(surface: *const planish_surface, u: f64, v: f64) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_surface(surface, |surface| Ok(patches(surface)?.patch_at(DVec2::new(u, v)))) }
}

/// Copies a Bezier patch.
///
/// surface:       not NULL.
/// index:         below planish_surface_patch_count().
/// out_patch:     receives rectangle, degrees and sizes; NULL for none.
/// out_ordinates: receives the patch's ordinate_count rows of ordinate_width numbers, v running fastest; NULL for
///                none: ask for the sizes first.
/// count:         rows that out_ordinates has room for.
/// Arrays: out_ordinates[out_patch.ordinate_count, out_patch.ordinate_width].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INDEX, PLANISH_STATUS_WRONG_KIND (the
/// family has no patches), PLANISH_STATUS_INVALID_ARGUMENT (struct_size) or PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_copy_patch(
    surface: *const planish_surface,
    index: usize,
    out_patch: *mut planish_patch,
    out_ordinates: *mut f64,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let patches = patches(deref(surface, "surface")?)?;
        let patch_count = patches.patch_count();
        if index >= patch_count {
            return Err(ArgumentError::NoSuch { name: "patch", index, count: patch_count }.into());
        }
        let out_patch = ReportOut::new(out_patch)?;
        let patch = patches.patch(index);
        let record = planish_patch::from(&patch);
        if !out_ordinates.is_null() {
            let (needed, width) = (record.ordinate_count, record.ordinate_width);
            rows_mut(out_ordinates, count, needed, width, "out_ordinates")?.copy_from_slice(&patch.ordinates);
        }
        out_patch.store(record);
        Ok(())
    })
}

record! {
    /// How a surface is converted. Fill with planish_convert_options_init(), then change what you need.
    pub struct planish_convert_options (planish_convert_options_init) {
        /// Most control points of the result; with more the call fails. Default 4000000.
        pub max_coefficients: usize = 4_000_000,
        /// Hears of the progress and may cancel; NULL (default) for nobody.
        pub progress: planish_progress,
        /// Handed to progress as it is.
        pub user: *mut c_void,
        /// Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
        pub cancel: *const i32,
        /// Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
        /// Array: [1].
        pub out_stage: *mut u32,
    }
}

/// Makes a tensor surface that is the same surface exactly, with the same trims. A surface with local refinement
/// may need far more control points as a tensor surface.
///
/// surface:     not NULL.
/// options:     NULL for the defaults.
/// out_surface: receives a new surface; destroy with planish_surface_free().
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option),
/// PLANISH_STATUS_WRONG_KIND (the family is not polynomial on rectangles), PLANISH_STATUS_TOO_LARGE (more than
/// max_coefficients control points) or PLANISH_STATUS_VERSION.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_to_tensor(
    surface: *const planish_surface,
    options: *const planish_convert_options,
    out_surface: *mut *mut planish_surface,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let surface = deref(surface, "surface")?.family()?;
        let out_surface = out(out_surface, "out_surface")?;
        let given = self::options(options)?;
        // results are the same for any number of threads, and one is enough
        let tensor = with_helper(listener!(given), |control| {
            control.enter(Stage::Convert);
            surface.to_tensor(given.max_coefficients, control.pool().watch())
        })??;
        out_surface.write(planish_surface::into_raw(tensor));
        Ok(())
    })
}
