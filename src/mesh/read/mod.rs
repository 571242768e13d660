//! Mesh files: OFF, OBJ, PLY and STL.
//!
//! A reader turns bytes into a [`Soup`]: points, polygons, and what else the file knows of its nodes. Sizes
//! that a file claims are compared with the bytes it has left before memory is asked for. Any of them may be packed by
//! gzip, and texts may begin with a byte order mark.

mod obj;
mod off;
mod ply;
mod scanner;
mod stl;
#[cfg(test)]
mod tests;
mod unpack;

use super::{Faces, Field, Mesh, MeshError, MeshOptions, MeshRepairs, Repair};
use crate::failure::{Classify, ErrorKind};
use crate::file::{self, FileError};
use crate::memory::{self, CollectVec};
use glam::{DVec2, DVec3};
use scanner::BYTE_ORDER_MARK;
use std::path::Path;

/// A mesh file cannot be read.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ReadError {
    /// The file cannot be opened or read.
    #[error(transparent)]
    File(#[from] FileError),
    /// Neither the name nor the content is that of a known format.
    #[error("'{path}' is none of OFF, OBJ, PLY and STL")]
    UnknownFormat {
        /// The path as given.
        path: String,
    },
    /// Only PLY files have numbers on faces.
    #[error("'{path}' is no PLY file, which alone has numbers on faces")]
    NoFaceProperties {
        /// The path as given.
        path: String,
    },
    /// The content is not that of a known format.
    #[error("the bytes are none of OFF, OBJ, PLY and STL")]
    UnknownContent,
    /// A text in UTF-16.
    #[error("the text is in UTF-16: save it as UTF-8 or plain ASCII")]
    Utf16,
    /// The content is larger than may be read.
    #[error(
        "unpacked it has more than the {limit} bytes that may be read: raise the limit on memory if it is right"
    )]
    TooLarge {
        /// Most bytes.
        limit: u64,
    },
    /// The text ends too early and no repair is allowed.
    #[error(
        "the file ends without 'endsolid', and facets may be missing: allow repairs to take those that are there"
    )]
    MissingEnd,
    /// A fault in a text.
    #[error("line {line}: {problem}")]
    Text {
        /// The line, counted from 1 as editors do.
        line: usize,
        /// What is wrong with it.
        problem: String,
    },
    /// A fault in a binary file.
    #[error("byte {byte}: {problem}")]
    Binary {
        /// The offset, counted from 0.
        byte: usize,
        /// What is wrong there.
        problem: String,
    },
    /// The file holds no mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}

impl Classify for ReadError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::File(error) => error.kind(),
            Self::TooLarge { .. } => ErrorKind::TooLarge,
            Self::Mesh(error) => error.kind(),
            _ => ErrorKind::Format,
        }
    }

    /// The offending line, byte, face, node or triangle, counted from 0.
    fn index(&self) -> Option<usize> {
        match self {
            Self::Text { line, .. } => Some(line - 1),
            Self::Binary { byte, .. } => Some(*byte),
            Self::Mesh(error) => error.index(),
            _ => None,
        }
    }
}

/// A format of mesh files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Object file format of Geomview, as text or binary; `C`, `N` and `ST` variants too, in any order.
    Off,
    /// Wavefront OBJ; `vt` become parameters if each node has one.
    Obj,
    /// Polygon file format, as text or binary of either byte order; the numbers on nodes become fields.
    Ply,
    /// Stereolithography, as text or binary; corners with equal coordinates become one node.
    Stl,
}

impl Format {
    /// The format that a file's name ends in; a further `.gz` says nothing.
    pub fn of_path(path: &Path) -> Option<Self> {
        let extension = path.extension()?.to_ascii_lowercase();
        match extension.to_str()? {
            "off" => Some(Self::Off),
            "obj" => Some(Self::Obj),
            "ply" => Some(Self::Ply),
            "stl" => Some(Self::Stl),
            "gz" => Self::of_path(Path::new(path.file_stem()?)),
            _ => None,
        }
    }

    /// The format that a file's content begins like.
    pub fn of_bytes(bytes: &[u8]) -> Option<Self> {
        if stl::is_binary(bytes) {
            return Some(Self::Stl); // its name may hold anything
        }
        let start = bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes);
        let mut lines = start.split(|byte| matches!(byte, b'\n' | b'\r')).map(<[u8]>::trim_ascii).take(1000);
        let is_said = |line: &&[u8]| !line.is_empty() && !line.starts_with(b"#");
        let word = lines.clone().find(is_said)?.split(u8::is_ascii_whitespace).next()?;
        if word == b"ply" {
            Some(Self::Ply)
        } else if off::header(word).is_some() {
            Some(Self::Off)
        } else if word.eq_ignore_ascii_case(b"solid") {
            Some(Self::Stl)
        } else {
            let is_obj = lines.any(|line| line.starts_with(b"v ") || line.starts_with(b"f "));
            is_obj.then_some(Self::Obj)
        }
    }
}

/// Reads a mesh file. The format is that of the file's name, or if that says nothing of its content.
///
/// Polygons become triangles, so the triangles that errors and repairs speak of are those of the mesh.
pub fn read(path: &Path, options: &MeshOptions) -> Result<(Mesh, MeshRepairs), ReadError> {
    read_as(path, None, options)
}

/// The same in a format that is known, whatever the name says.
pub fn read_as(
    path: &Path,
    format: Option<Format>,
    options: &MeshOptions,
) -> Result<(Mesh, MeshRepairs), ReadError> {
    let bytes = file::read(path, memory::limit(options.max_memory)).map_err(ReadError::from)?;
    let content = unpack::unpacked(&bytes, memory::limit(options.max_memory))?;
    let format = format.or_else(|| Format::of_path(path)).or_else(|| Format::of_bytes(&content));
    let format = format.ok_or_else(|| ReadError::UnknownFormat { path: path.display().to_string() })?;
    parse(&content, format, options)
}

/// A number of each face of a PLY file by its name, such as a label; at most `max_memory` bytes are read, 0 for three
/// quarters of the machine's.
pub fn read_face_property(path: &Path, name: &str, max_memory: u64) -> Result<Vec<f64>, ReadError> {
    let limit = memory::limit(max_memory);
    let bytes = file::read(path, limit).map_err(ReadError::from)?;
    let content = unpack::unpacked(&bytes, limit)?;
    match Format::of_bytes(&content) {
        Some(Format::Ply) => {
            ply::face_property(content.strip_prefix(BYTE_ORDER_MARK).unwrap_or(&content), name)
        }
        _ => Err(ReadError::NoFaceProperties { path: path.display().to_string() }),
    }
}

/// Reads a mesh from the content of a file, in the format that it begins like if none is given;
/// [`MeshOptions::index_base`] has no meaning here.
pub fn read_bytes(
    bytes: &[u8],
    format: impl Into<Option<Format>>,
    options: &MeshOptions,
) -> Result<(Mesh, MeshRepairs), ReadError> {
    let content = unpack::unpacked(bytes, memory::limit(options.max_memory))?;
    let format = format.into().or_else(|| Format::of_bytes(&content)).ok_or(ReadError::UnknownContent)?;
    parse(&content, format, options)
}

fn parse(bytes: &[u8], format: Format, options: &MeshOptions) -> Result<(Mesh, MeshRepairs), ReadError> {
    // numbers of a binary file may look like anything
    let is_text = format != Format::Stl || !stl::is_binary(bytes);
    let text = bytes.strip_prefix(BYTE_ORDER_MARK).filter(|_| is_text).unwrap_or(bytes);
    if is_text && is_utf16(text) {
        return Err(ReadError::Utf16);
    }
    let soup = match format {
        Format::Off => off::read(text)?,
        Format::Obj => obj::read(text)?,
        Format::Ply => ply::read(text)?,
        Format::Stl => stl::read(text)?,
    };
    let weld = (format == Format::Stl || options.weld_distance != 0.0).then_some(options.weld_distance);
    soup.into_mesh(weld, &options.with_index_base(0))
}

/// Whether a text begins with the byte order mark of UTF-16, or with two letters of it.
fn is_utf16(bytes: &[u8]) -> bool {
    let is_letter = |byte: u8| byte.is_ascii_graphic() || byte.is_ascii_whitespace();
    match *bytes {
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => true,
        [a, 0, b, 0, ..] | [0, a, 0, b, ..] => is_letter(a) && is_letter(b),
        _ => false,
    }
}

/// What a file holds.
#[derive(Debug, Default)]
struct Soup {
    points: Vec<DVec3>,
    /// Their nodes exist.
    faces: Faces,
    parameters: Option<Vec<DVec2>>,
    /// There are texture coordinates, but not one for each node.
    dropped_parameters: bool,
    /// The file ends before it says so.
    missing_end: bool,
    fields: Vec<Field>,
}

impl Soup {
    fn into_mesh(self, weld: Option<f64>, options: &MeshOptions) -> Result<(Mesh, MeshRepairs), ReadError> {
        let count = self.points.len();
        if count > 0 && self.faces.is_empty() {
            return Err(MeshError::PointCloud { count }.into());
        }
        if self.missing_end && options.repair == Repair::NONE {
            return Err(ReadError::MissingEnd);
        }
        let (mut mesh, mut repairs) = Mesh::from_faces_welded(self.points, self.faces, weld, options)?;
        let origins: Vec<usize> = mesh.node_origins().map(|node| node as usize).collect_vec();
        repairs.dropped_parameters = self.dropped_parameters;
        repairs.missing_end = self.missing_end;
        if let Some(given) = self.parameters {
            let own: Vec<DVec2> = origins.iter().map(|&node| given[node]).collect_vec();
            // nodes that were welded must agree
            let agrees = |map: &Vec<u32>| given.iter().zip(map).all(|(&uv, &node)| own[node as usize] == uv);
            if repairs.node_map.as_ref().is_none_or(agrees) && has_area(&mesh, &own) {
                mesh.set_parameters(own)?;
            } else {
                repairs.dropped_parameters = true;
            }
        }
        for Field { name, values } in self.fields {
            mesh.set_field(&name, origins.iter().map(|&node| values[node]).collect())?;
        }
        Ok((mesh, repairs))
    }
}

/// Whether parameters are finite and some triangle has an area in their plane beyond rounding: exporters write the
/// same pair at every node when there is no texture.
fn has_area(mesh: &Mesh, uv: &[DVec2]) -> bool {
    if uv.iter().any(|uv| !uv.is_finite()) {
        return false;
    }
    let largest = uv.iter().fold(DVec2::ZERO, |largest, uv| largest.max(uv.abs()));
    let rounding = AREA_ROUNDING * largest.x * largest.y;
    mesh.triangles().iter().any(|triangle| {
        let [a, b, c] = triangle.map(|node| uv[node as usize]);
        (b - a).perp_dot(c - a).abs() > rounding
    })
}

/// An area is the difference of two products of differences, each rounded a few times.
const AREA_ROUNDING: f64 = 16.0 * f64::EPSILON;
