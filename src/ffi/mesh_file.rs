//! Files of triangle meshes.

use super::arguments::{self, ArgumentError, choice, deref, flag, options, slice};
use super::guard::guard;
use super::mesh::{MeshOutputs, planish_mesh, planish_mesh_options};
use super::planish_status;
use crate::export::mesh::{Encoding, write};
use crate::mesh::{Format, read_as, read_bytes};
use libc::{c_char, c_void};

/// A format of mesh files.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_mesh_format {
    /// The one that the name ends in; if that says nothing, or there is no name, the one that the content begins like.
    Auto = 0,
    /// Object file format of Geomview. Parameters are its texture coordinates.
    Off = 1,
    /// Wavefront OBJ. Parameters are its `vt`.
    Obj = 2,
    /// Polygon file format. Parameters are its numbers u and v, and every other number on its nodes is a field.
    Ply = 3,
    /// Stereolithography: triangles alone. Corners with equal coordinates become one node.
    Stl = 4,
}

pub(super) fn format(number: u32, name: &'static str) -> Result<Option<Format>, ArgumentError> {
    choice(number, &[None, Some(Format::Off), Some(Format::Obj), Some(Format::Ply), Some(Format::Stl)], name)
}

record! {
    /// How a mesh is written. Fill with planish_mesh_write_options_init(), then change what you need.
    pub struct planish_mesh_write_options (planish_mesh_write_options_init) {
        /// A planish_mesh_format. Default PLANISH_MESH_FORMAT_AUTO: what the name ends in.
        pub format: u32,
        /// 1 writes PLY and STL as text; with 0 (default) they are binary. OFF and OBJ are texts always.
        pub text: u32,
    }
}

/// Reads a mesh from an OFF, OBJ, PLY or STL file, packed by gzip or not.
///
/// Polygons become triangles. The `vt` of an OBJ become parameters if each node has one; the numbers that a
/// PLY has on its nodes become fields. Faults are mended as options->repair says; planish_mesh_copy_node_map() and
/// planish_mesh_copy_triangle_map() tell what nodes and triangles of the mesh were in the file.
///
/// path:     the file, terminated; on Unix any bytes, elsewhere UTF-8.
/// options:  NULL for the defaults.
/// out_mesh: receives a new mesh; destroy with planish_mesh_free().
/// Returns what planish_mesh_new() returns, or PLANISH_STATUS_FILE (cannot be read), PLANISH_STATUS_FORMAT (not
/// what it claims to be; the index is the line or the byte, counted from 0), PLANISH_STATUS_TOO_LARGE (more bytes than
/// options->max_memory) or PLANISH_STATUS_INVALID_ARGUMENT (out_node_map is not NULL, or the file has points only).
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_mesh_read(
    path: *const c_char,
    options: *const planish_mesh_options,
    out_mesh: *mut *mut planish_mesh,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let path = arguments::path(path, "path")?;
        let options = self::options(options)?;
        let outputs = MeshOutputs::of_file(out_mesh, &options)?;
        let (mesh, repairs) = read_as(path, format(options.format, "format")?, &options.to_core()?)?;
        Ok(outputs.store(mesh, &repairs))
    })
}

/// Reads a mesh from the content of a file in memory, as planish_mesh_read() does from a file.
///
/// buffer:   size bytes; borrowed for the call.
/// size:     at least 1.
/// options:  NULL for the defaults; with PLANISH_MESH_FORMAT_AUTO the content says what it is.
/// out_mesh: receives a new mesh; destroy with planish_mesh_free().
/// Arrays: buffer[size].
/// Returns what planish_mesh_read() returns, but for PLANISH_STATUS_FILE.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_mesh_read_buffer(
    buffer: *const c_void,
    size: usize,
    options: *const planish_mesh_options,
    out_mesh: *mut *mut planish_mesh,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let bytes = slice(buffer.cast::<u8>(), size, "buffer")?;
        let options = self::options(options)?;
        let outputs = MeshOutputs::of_file(out_mesh, &options)?;
        let (mesh, repairs) = read_bytes(bytes, format(options.format, "format")?, &options.to_core()?)?;
        Ok(outputs.store(mesh, &repairs))
    })
}

/// Writes a mesh as OFF, OBJ, PLY or STL. Numbers read back to the same bits, but for STL, which has floats of four
/// bytes in its binary form, and neither numbers of nodes nor parameters. Parameters go into the others, fields into PLY.
///
/// The file appears whole or not at all: it is written beside its place under another name, synced to the disk and
/// renamed. An existing file keeps its mode and survives every failure, a symbolic link is followed; what is no regular
/// file, such as a device or a FIFO, is written to. So it is with every function that writes a file.
///
/// mesh:    not NULL.
/// path:    ends with a NUL; on Unix any bytes, elsewhere UTF-8. An existing file is replaced.
/// options: NULL for the defaults.
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option, or a name that
/// ends in no known format without one), PLANISH_STATUS_FILE or PLANISH_STATUS_VERSION.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_mesh_write(
    mesh: *const planish_mesh,
    path: *const c_char,
    options: *const planish_mesh_write_options,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let mesh = &deref(mesh, "mesh")?.0;
        let path = arguments::path(path, "path")?;
        let options = self::options(options)?;
        let encoding = if flag(options.text, "text")? { Encoding::Text } else { Encoding::Binary };
        let format = format(options.format, "format")?.or_else(|| Format::of_path(path));
        let no_format = || ArgumentError::NoMeshFormat { path: path.display().to_string() };
        Ok(write(mesh, path, format.ok_or_else(no_format)?, encoding)?)
    })
}
