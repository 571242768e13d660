//! Files and buffers.

use super::arguments::{self, ArgumentError, choice, deref, options, out, slice, slice_mut};
use super::guard::guard;
use super::mesh::planish_mesh;
use super::planish_status;
use super::progress::{planish_progress, with_control};
use super::query::planish_tessellate_options;
use super::surface::{planish_surface, query_surface};
use crate::control::Stage;
use crate::export::{ExportError, native, vtk};
use libc::{c_char, c_void};

/// What a VTK file holds of a surface.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_vtk_content {
    /// Triangles of the part inside the trims, or of deviation_from.
    Triangles = 0,
    /// Its Bezier patches as cells of type VTK_BEZIER_QUADRILATERAL (VTK 9): the surface itself. Trims are not
    /// shown; cell data "parameters" has least and largest u, least and largest v of each patch.
    Patches = 1,
    /// Its control points, joined by polylines as neighbours in the control net.
    ControlNet = 2,
}

record! {
    /// What a VTK file shows. Fill with planish_vtk_options_init(), then change what you need.
    pub struct planish_vtk_options (planish_vtk_options_init) {
        /// A mesh to compare with, or NULL (default). Its triangles are then written instead of a tessellation,
        /// each node moved to its nearest place on the surface, with the distance as point data "deviation".
        /// Borrowed.
        pub deviation_from: *const planish_mesh,
        /// How the surface is tessellated otherwise; NULL (default) for the defaults. Borrowed.
        pub tessellate: *const planish_tessellate_options,
        /// Hears of the progress and may cancel; NULL (default) for nobody.
        pub progress: planish_progress,
        /// Handed to progress as it is.
        pub user: *mut c_void,
        /// Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
        pub cancel: *const i32,
        /// Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
        /// Array: [1].
        pub out_stage: *mut u32,
        /// Threads to use, at most 1024; 0 (default) for all cores.
        pub thread_count: u32,
        /// A planish_vtk_content. Default PLANISH_VTK_CONTENT_TRIANGLES.
        pub content: u32 = planish_vtk_content::Triangles as u32,
    }
}

impl planish_vtk_options {
    /// What is written as triangles.
    ///
    /// # Safety
    /// The pointers are NULL or as the header says, until the options are no longer used.
    pub(super) unsafe fn triangles<'a>(&self) -> Result<vtk::SurfaceOptions<'a>, ArgumentError> {
        // SAFETY: the caller's promise.
        unsafe {
            let deviation_from = match self.deviation_from.is_null() {
                true => None,
                false => Some(&deref(self.deviation_from, "deviation_from")?.0),
            };
            Ok(vtk::SurfaceOptions { tessellate: options(self.tessellate)?.core()?, deviation_from })
        }
    }
}

/// Writes a surface in space as a VTK file (.vtu): triangles with their (u,v) as point data "uv", the patches, or
/// the control net. The file appears whole or not at all.
///
/// surface: not NULL, of dimension 3.
/// path:    ends with a NUL; on Unix any bytes, elsewhere UTF-8. An existing file is replaced, see planish_mesh_write().
/// options: NULL for the defaults.
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (the dimension, an
/// option, a path that is not UTF-8), PLANISH_STATUS_WRONG_KIND (a family without patches or control net, where these
/// are asked for), PLANISH_STATUS_FILE, or what planish_surface_tessellate() or
/// planish_surface_deviation() return.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_write_vtk(
    surface: *const planish_surface,
    path: *const c_char,
    options: *const planish_vtk_options,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let surface = deref(surface, "surface")?.any();
        let path = arguments::path(path, "path")?;
        let given = self::options(options)?;
        let contents =
            [planish_vtk_content::Triangles, planish_vtk_content::Patches, planish_vtk_content::ControlNet];
        let no_patches = ArgumentError::NoPatches { found: surface.kind() };
        match choice(given.content, &contents, "content")? {
            planish_vtk_content::Triangles => {}
            planish_vtk_content::Patches => {
                return Ok(vtk::write_patches(surface.patches().ok_or(no_patches)?, path)?);
            }
            planish_vtk_content::ControlNet if surface.dim() != 3 => {
                return Err(ExportError::Dimension { dim: surface.dim() }.into());
            }
            planish_vtk_content::ControlNet => {
                let no_net = ArgumentError::NoControlNet { found: surface.kind() };
                return Ok(vtk::write_control_net(&surface.control_net().ok_or(no_net)?, path)?);
            }
        }
        let core = given.triangles()?;
        Ok(with_control(given.thread_count, listener!(given), |control| {
            control.enter(Stage::Write);
            vtk::write_surface(surface, &core, path, control.pool())
        })??)
    })
}

/// How many bytes planish_surface_save() writes; 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_save_size(surface: *const planish_surface) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_surface(surface, |surface| Ok(native::save_size(surface.family()?.as_saved()))) }
}

/// Writes everything a surface is into a buffer, to the bit. The layout is documented in docs/format.md; it is
/// the same on all machines.
///
/// surface: not NULL.
/// buffer:  receives planish_surface_save_size() bytes.
/// size:    bytes that the buffer has room for.
/// Arrays: buffer[size].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_save(
    surface: *const planish_surface,
    buffer: *mut c_void,
    size: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let saved = deref(surface, "surface")?.family()?.as_saved();
        let needed = native::save_size(saved);
        if size < needed {
            return Err(ArgumentError::TooSmall { name: "buffer", given: size, needed }.into());
        }
        let buffer = slice_mut(buffer.cast::<u8>(), needed, "buffer")?;
        buffer.copy_from_slice(&native::save(saved));
        Ok(())
    })
}

/// Makes a surface from bytes of planish_surface_save(). Damaged bytes are refused, sizes are checked before
/// memory is asked for.
///
/// buffer:      size bytes.
/// out_surface: receives a new surface; destroy with planish_surface_free().
/// Arrays: buffer[size].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_FORMAT (the index is the byte) or
/// PLANISH_STATUS_VERSION (a later library made it).
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_load(
    buffer: *const c_void,
    size: usize,
    out_surface: *mut *mut planish_surface,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let bytes = slice(buffer.cast::<u8>(), size, "buffer")?;
        let out_surface = out(out_surface, "out_surface")?;
        let surface = native::load(bytes)?;
        out_surface.write(planish_surface::into_raw(surface));
        Ok(())
    })
}

/// Writes the bytes of planish_surface_save() to a file, which appears whole or not at all.
///
/// surface: not NULL.
/// path:    ends with a NUL; on Unix any bytes, elsewhere UTF-8. An existing file is replaced, see planish_mesh_write().
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (the path is not
/// UTF-8) or PLANISH_STATUS_FILE.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_save_file(
    surface: *const planish_surface,
    path: *const c_char,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let saved = deref(surface, "surface")?.family()?.as_saved();
        Ok(native::save_file(saved, arguments::path(path, "path")?)?)
    })
}

/// Makes a surface from a file of planish_surface_save_file().
///
/// path:        ends with a NUL; on Unix any bytes, elsewhere UTF-8.
/// out_surface: receives a new surface; destroy with planish_surface_free().
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (the path is not
/// UTF-8), PLANISH_STATUS_FILE, PLANISH_STATUS_FORMAT (the index is the byte) or PLANISH_STATUS_VERSION.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_load_file(
    path: *const c_char,
    out_surface: *mut *mut planish_surface,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let path = arguments::path(path, "path")?;
        let out_surface = out(out_surface, "out_surface")?;
        let surface = native::load_file(path)?;
        out_surface.write(planish_surface::into_raw(surface));
        Ok(())
    })
}
