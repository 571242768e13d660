//! Mesh files: OFF, OBJ, PLY and STL.
//!
//! A reader turns bytes into a [`Soup`]: points, polygons, and what else the file knows of its nodes. Sizes
//! that a file claims are compared with the bytes it has left before memory is asked for.

mod obj;
mod off;
mod ply;
mod polygon;
mod scanner;
mod stl;
#[cfg(test)]
mod tests;

use super::{Field, Mesh, MeshError, MeshOptions, MeshRepairs};
use crate::failure::{Classify, ErrorKind};
use glam::{DVec2, DVec3};
use polygon::Faces;
use std::path::Path;

/// A mesh file cannot be read.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ReadError {
    /// The file cannot be opened or read.
    #[error("cannot read '{path}': {reason}")]
    File {
        /// The path as given.
        path: String,
        /// What the system says.
        reason: String,
    },
    /// Neither the name nor the content is that of a known format.
    #[error("'{path}' is none of OFF, OBJ, PLY and STL")]
    UnknownFormat {
        /// The path as given.
        path: String,
    },
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
    /// A polygon that is not convex has too many corners.
    #[error("face {face} is not convex and has {corner_count} corners, the limit is {limit}")]
    PolygonTooLarge {
        /// The face, counted from 0.
        face: usize,
        /// Its corners.
        corner_count: usize,
        /// The largest number of corners.
        limit: usize,
    },
    /// The file holds no mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}

impl Classify for ReadError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::File { .. } => ErrorKind::File,
            Self::UnknownFormat { .. } | Self::Text { .. } | Self::Binary { .. } => ErrorKind::Format,
            Self::PolygonTooLarge { .. } => ErrorKind::TooLarge,
            Self::Mesh(error) => error.kind(),
        }
    }

    /// The offending line, byte, face, node or triangle, counted from 0.
    fn index(&self) -> Option<usize> {
        match self {
            Self::File { .. } | Self::UnknownFormat { .. } => None,
            Self::Text { line, .. } => Some(line - 1),
            Self::Binary { byte, .. } => Some(*byte),
            Self::PolygonTooLarge { face, .. } => Some(*face),
            Self::Mesh(error) => error.index(),
        }
    }
}

/// A format of mesh files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Object file format of Geomview, as text; `C`, `N` and `ST` variants too.
    Off,
    /// Wavefront OBJ; `vt` become parameters if each node has one.
    Obj,
    /// Polygon file format, as text or binary of either byte order; the numbers on nodes become fields.
    Ply,
    /// Stereolithography, as text or binary; corners with equal coordinates become one node.
    Stl,
}

impl Format {
    /// The format that a file's name ends in.
    pub fn of_path(path: &Path) -> Option<Self> {
        match path.extension()?.to_ascii_lowercase().to_str()? {
            "off" => Some(Self::Off),
            "obj" => Some(Self::Obj),
            "ply" => Some(Self::Ply),
            "stl" => Some(Self::Stl),
            _ => None,
        }
    }

    /// The format that a file's content begins like.
    pub fn of_bytes(bytes: &[u8]) -> Option<Self> {
        let start = bytes.trim_ascii_start();
        let word = start.split(u8::is_ascii_whitespace).next()?;
        if word == b"ply" {
            Some(Self::Ply)
        } else if word.ends_with(b"OFF") {
            Some(Self::Off)
        } else if stl::is_binary(bytes) || word.eq_ignore_ascii_case(b"solid") {
            Some(Self::Stl)
        } else {
            let lines = start.split(|&byte| byte == b'\n').take(1000);
            let is_obj = lines.into_iter().any(|line| line.starts_with(b"v ") || line.starts_with(b"f "));
            is_obj.then_some(Self::Obj)
        }
    }
}

/// Reads a mesh file. The format is that of the file's name, or if that says nothing of its content.
///
/// Polygons become triangles, so the triangles that errors and repairs speak of are those of the mesh.
pub fn read(path: &Path, options: &MeshOptions) -> Result<(Mesh, MeshRepairs), ReadError> {
    let name = || path.display().to_string();
    let bytes =
        std::fs::read(path).map_err(|error| ReadError::File { path: name(), reason: error.to_string() })?;
    let format = Format::of_path(path).or_else(|| Format::of_bytes(&bytes));
    let format = format.ok_or_else(|| ReadError::UnknownFormat { path: name() })?;
    read_bytes(&bytes, format, options)
}

/// Reads a mesh from the content of a file; [`MeshOptions::index_base`] has no meaning here.
pub fn read_bytes(
    bytes: &[u8],
    format: Format,
    options: &MeshOptions,
) -> Result<(Mesh, MeshRepairs), ReadError> {
    let soup = match format {
        Format::Off => off::read(bytes)?,
        Format::Obj => obj::read(bytes)?,
        Format::Ply => ply::read(bytes)?,
        Format::Stl => stl::read(bytes)?,
    };
    let weld = (format == Format::Stl || options.weld_distance != 0.0).then_some(options.weld_distance);
    soup.into_mesh(weld, &options.with_index_base(0))
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
    fields: Vec<Field>,
}

impl Soup {
    fn into_mesh(self, weld: Option<f64>, options: &MeshOptions) -> Result<(Mesh, MeshRepairs), ReadError> {
        let triangles = self.faces.into_triangles(&self.points)?;
        let (mut mesh, mut repairs) = Mesh::repaired(self.points, triangles, weld, options)?;
        repairs.dropped_parameters = self.dropped_parameters;

        // by node of the mesh, the first node of the file that became it
        let firsts = repairs.node_map.as_ref().map(|map| {
            let mut firsts = Vec::with_capacity(mesh.points().len());
            for (old, &new) in map.iter().enumerate() {
                if new as usize == firsts.len() {
                    firsts.push(old);
                }
            }
            firsts
        });
        if let Some(parameters) = self.parameters {
            if let Some(node) = parameters.iter().position(|uv| !uv.is_finite()) {
                return Err(MeshError::ParameterNotFinite { node }.into());
            }
            match (&firsts, &repairs.node_map) {
                (Some(firsts), Some(map)) => {
                    let joined: Vec<DVec2> = firsts.iter().map(|&old| parameters[old]).collect();
                    let agree = parameters.iter().zip(map).all(|(&uv, &new)| joined[new as usize] == uv);
                    repairs.dropped_parameters |= !agree;
                    if agree {
                        mesh.set_parameters(joined)?;
                    }
                }
                _ => mesh.set_parameters(parameters)?,
            }
        }
        for Field { name, values } in self.fields {
            let values = match &firsts {
                Some(firsts) => firsts.iter().map(|&old| values[old]).collect(),
                None => values,
            };
            mesh.set_field(&name, values)?;
        }
        Ok((mesh, repairs))
    }
}
