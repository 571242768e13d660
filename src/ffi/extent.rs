//! How large a surface is.

use super::arguments::{array_len, choice, deref, options, out, slice_mut};
use super::guard::guard;
use super::planish_status;
use super::progress::with_helper;
use super::query::planish_tessellate_options;
use super::surface::{planish_surface, query_surface};
use super::tensor_parts::planish_axis;
use crate::control::Stage;
use crate::query::extent::{area, bounding_box, is_closed};
use crate::query::tessellate::TessellateError;

/// The box of a surface over its whole domain, whatever its trims.
///
/// surface: not NULL.
/// out_box: receives dim numbers, the least of each component, then the largest of each. Of a D1RC-spline it is the box of
///          places on it, a few for each face.
/// Arrays: out_box[2, surface_dim].
/// Returns PLANISH_STATUS_OK or PLANISH_STATUS_NULL_POINTER.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_box(
    surface: *const planish_surface,
    out_box: *mut f64,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let surface = deref(surface, "surface")?.any();
        let out_box = slice_mut(out_box, array_len::<f64>(2, surface.dim(), "out_box")?, "out_box")?;
        let found = bounding_box(surface);
        let (least, largest) = out_box.split_at_mut(surface.dim());
        least.copy_from_slice(&found.min);
        largest.copy_from_slice(&found.max);
        Ok(())
    })
}

/// The area of the part of a surface in space that is inside its trims.
///
/// surface:  not NULL, of dim 3.
/// options:  how finely the surface is divided, which matters little: pieces are integrated along the surface. NULL for
///           the defaults; out_report is not looked at.
/// out_area: receives the area, in squares of model units.
/// Arrays: out_area[1].
/// Returns PLANISH_STATUS_OK or what planish_surface_tessellate() returns.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_area(
    surface: *const planish_surface,
    options: *const planish_tessellate_options,
    out_area: *mut f64,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let surface = deref(surface, "surface")?.any();
        let given = self::options(options)?;
        let out_area = out(out_area, "out_area")?;
        let core = given.core()?;
        // one thread tessellates, so one is enough
        let found = with_helper(listener!(given), |control| -> Result<f64, TessellateError> {
            control.enter(Stage::Tessellate);
            area(surface, &core, control.pool())
        })??;
        out_area.write(found);
        Ok(())
    })
}

/// 1 if the sides of the domain at the least and the largest parameter of an axis are one curve, as those of a tube are; 0
/// if not, for NULL, for an axis that is none, and for a D1RC-spline, whose domain has no sides.
///
/// axis: a planish_axis.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_is_closed(surface: *const planish_surface, axis: u32) -> u32 {
    // SAFETY: the caller's promise.
    unsafe {
        query_surface(surface, |surface| {
            let axis = choice(axis, &[planish_axis::U, planish_axis::V], "axis")?;
            Ok(u32::from(is_closed(surface.any(), axis as usize)))
        })
    }
}
