//! What a surface is called, and how large its units are.

use super::arguments::{choice, deref_mut, text, write_text};
use super::guard::guard;
use super::planish_status;
use super::surface::{planish_surface, query_surface};
use crate::surface::Unit;
use std::ffi::c_char;

/// The name of a surface, which copies, parts and saved files have too and STEP files take for the product's. A surface is
/// born without one.
///
/// surface: not NULL.
/// name:    receives the name in UTF-8, cut off if it is too long and always terminated; NULL if size is 0.
/// size:    bytes that name has room for, the NUL included.
/// Arrays: name[size].
/// Returns the length of the whole name in bytes without the NUL; 0 for NULL and without a name.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_name(
    surface: *const planish_surface,
    name: *mut c_char,
    size: usize,
) -> usize {
    // SAFETY: the caller's promises.
    unsafe {
        query_surface(surface, |surface| Ok(write_text(&surface.any().region().label.name, name, size)))
    }
}

/// Gives a surface a name.
///
/// surface: not NULL; changed.
/// name:    in UTF-8, terminated; empty for none. Copied.
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (name is not UTF-8).
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_set_name(
    surface: *mut planish_surface,
    name: *const c_char,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let surface = deref_mut(surface, "surface")?;
        surface.any_mut().region_mut().label.name = text(name, "name")?.to_owned();
        Ok(())
    })
}

/// What one unit of a surface is: a planish_unit; PLANISH_UNIT_MILLIMETRE for NULL. The library computes in the units it is
/// given; STEP files say which they are.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_unit(surface: *const planish_surface) -> u32 {
    // SAFETY: the caller's promise.
    unsafe { query_surface(surface, |surface| Ok(surface.any().region().label.unit as u32)) }
}

/// Says what one unit of a surface is. No number changes.
///
/// surface: not NULL; changed.
/// unit:    a planish_unit.
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_INVALID_ARGUMENT (unit).
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_set_unit(
    surface: *mut planish_surface,
    unit: u32,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let surface = deref_mut(surface, "surface")?;
        surface.any_mut().region_mut().label.unit = choice(unit, &Unit::ALL, "unit")?;
        Ok(())
    })
}
