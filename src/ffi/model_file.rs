//! Models as files and bytes.

use super::arguments::{self, ArgumentError, ReportOut, deref, options, out, rows_mut, slice, slice_mut};
use super::guard::guard;
use super::model::{planish_model, query_model};
use super::planish_status;
use super::step::planish_step_options;
use crate::control::Watch;
use crate::export::{native, step};
use libc::{c_char, c_void};

/// Writes a model as a STEP file: solids as solids, with voids, and open shells as a shell-based surface model. Edges
/// are written once, for both faces. The file appears whole or not at all; equal input gives equal bytes.
///
/// model:   not NULL.
/// path:    ends with a NUL; on Unix any bytes, elsewhere UTF-8. An existing file is replaced, see planish_mesh_write().
/// options: NULL for the defaults. What is said there of forms and tolerances is for surfaces, and not used.
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option, a text that is
/// not UTF-8), PLANISH_STATUS_DEGENERATE (numbers overflow) or PLANISH_STATUS_FILE.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_write_step(
    model: *const planish_model,
    path: *const c_char,
    options: *const planish_step_options,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let model = deref(model, "model")?.core()?;
        let path = arguments::path(path, "path")?;
        let given = self::options(options)?;
        let core = given.core()?;
        let report = ReportOut::new(given.out_report)?;
        report.store(step::write(model, &core, path, &Watch::default())?.into());
        Ok(())
    })
}

/// Writes the content of the file of planish_model_write_step() into memory.
///
/// model:     not NULL.
/// options:   NULL for the defaults.
/// out_bytes: receives the content, which is text without a NUL; NULL to learn its size.
/// size:      bytes that out_bytes has room for.
/// out_size:  receives the size of the content in bytes; not NULL.
/// Arrays: out_bytes[out_size], out_size[1].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option, a text that is
/// not UTF-8), PLANISH_STATUS_DEGENERATE (numbers overflow) or PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_write_step_memory(
    model: *const planish_model,
    options: *const planish_step_options,
    out_bytes: *mut c_void,
    size: usize,
    out_size: *mut usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let model = deref(model, "model")?.core()?;
        let given = self::options(options)?;
        let core = given.core()?;
        let report = ReportOut::new(given.out_report)?;
        let out_size = out(out_size, "out_size")?;
        let (content, written) = step::to_text(model, &core, &Watch::default())?;
        let needed = content.len();
        if !out_bytes.is_null() {
            rows_mut(out_bytes.cast::<u8>(), size, needed, 1, "out_bytes")?
                .copy_from_slice(content.as_bytes());
        }
        out_size.write(needed);
        report.store(written.into());
        Ok(())
    })
}

/// How many bytes planish_model_save() writes; 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_save_size(model: *const planish_model) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_model(model, |model| Ok(native::save_size(model.saved()))) }
}

/// Writes everything a model is into a buffer, to the bit. The layout is documented in docs/format.md; it is the same
/// on all machines.
///
/// model:  not NULL.
/// buffer: receives planish_model_save_size() bytes.
/// size:   bytes that the buffer has room for.
/// Arrays: buffer[size].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_save(
    model: *const planish_model,
    buffer: *mut c_void,
    size: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let model = deref(model, "model")?.saved();
        let needed = native::save_size(model);
        if size < needed {
            return Err(ArgumentError::TooSmall { name: "buffer", given: size, needed }.into());
        }
        slice_mut(buffer.cast::<u8>(), needed, "buffer")?.copy_from_slice(&native::save(model));
        Ok(())
    })
}

/// Makes a model from bytes of planish_model_save(). Damaged bytes are refused, sizes are checked before memory is
/// asked for.
///
/// buffer:    size bytes.
/// out_model: receives a new model; destroy with planish_model_free().
/// Arrays: buffer[size].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_FORMAT (the index is the byte) or
/// PLANISH_STATUS_VERSION (a later library made it).
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_load(
    buffer: *const c_void,
    size: usize,
    out_model: *mut *mut planish_model,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let bytes = slice(buffer.cast::<u8>(), size, "buffer")?;
        let out_model = out(out_model, "out_model")?;
        out_model.write(planish_model::loaded(native::load_model_or_field(bytes)?));
        Ok(())
    })
}

/// Writes the bytes of planish_model_save() to a file, which appears whole or not at all.
///
/// model: not NULL.
/// path:  ends with a NUL; on Unix any bytes, elsewhere UTF-8. An existing file is replaced, see planish_mesh_write().
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (the path is not UTF-8) or
/// PLANISH_STATUS_FILE.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_save_file(
    model: *const planish_model,
    path: *const c_char,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let model = deref(model, "model")?.saved();
        Ok(native::save_file(model, arguments::path(path, "path")?)?)
    })
}

/// Makes a model from a file of planish_model_save_file().
///
/// path:      ends with a NUL; on Unix any bytes, elsewhere UTF-8.
/// out_model: receives a new model; destroy with planish_model_free().
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (the path is not UTF-8),
/// PLANISH_STATUS_FILE, PLANISH_STATUS_FORMAT (the index is the byte) or PLANISH_STATUS_VERSION.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_load_file(
    path: *const c_char,
    out_model: *mut *mut planish_model,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let path = arguments::path(path, "path")?;
        let out_model = out(out_model, "out_model")?;
        out_model.write(planish_model::loaded(native::load_model_or_field_file(path)?));
        Ok(())
    })
}
