//! The library's own format: everything a surface is, to the bit.
//!
//! Little-endian, every field eight bytes long but for two of four:
//! ```text
//! offset  type          content
//!  0      8 bytes       "PLANISH" and a zero
//!  8      u32           version of the format: 1, 2 for a model with arcs of circles and ellipses, 3 for kind 4
//! 12      u32           kind: 0 tensor surface, 1 T-spline, 2 PHT-spline, 3 D1RC-spline, 4 PHT-spline with two
//!                       continuous derivatives, 16 curve, 17 model, 18 field over a model
//! 16      u64           size of the whole in bytes
//! 24                    what the family needs, see its module
//! ...     u64           the unit of a surface: 0 millimetre, 1 metre, 2 inch \
//!         u64           bytes of its name                               | if either is not as it is by default
//!         bytes         the name in UTF-8, zeros to a multiple of 8     /
//! end-8   u64           CRC-32 (IEEE 802.3) of all bytes before
//! ```
//! Each family has a module of its own here, with its layout, its [`Save`] and `read`.

mod bytes;
mod curve;
mod d1rc;
mod model;
mod model_field;
mod pht;
mod tensor;
mod tspline;

use super::error::ExportError;
use crate::curve::Curve;
use crate::failure::{Classify, ErrorKind};
use crate::file::{self, FileError};
use crate::memory;
use crate::model::{Model, ModelField};
use crate::surface::{AnySurface, Label};
pub use bytes::Writer;
use bytes::{Reader, label_size};
use std::path::Path;

/// A buffer or file is not what was saved.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum LoadError {
    /// The file cannot be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// The bytes are not what they claim to be.
    #[error("not a saved surface, curve, model or field: byte {byte}: {problem}")]
    Format {
        /// Where.
        byte: usize,
        /// What is wrong.
        problem: String,
    },
    /// A later version of the library made it.
    #[error("saved in version {version} of the format, this library knows versions up to {VERSION}")]
    Version {
        /// The version found.
        version: u32,
    },
}

impl Classify for LoadError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::File(error) => error.kind(),
            Self::Format { .. } => ErrorKind::Format,
            Self::Version { .. } => ErrorKind::Version,
        }
    }

    /// The offending byte.
    fn index(&self) -> Option<usize> {
        match *self {
            Self::Format { byte, .. } => Some(byte),
            _ => None,
        }
    }
}

const MAGIC: [u8; 8] = *b"PLANISH\0";
/// The latest version. Each file says the first that knows all it holds.
const VERSION: u32 = 3;
/// The version of what needs nothing newer.
const FIRST_VERSION: u32 = 1;
/// Bytes before the content, and those of the checksum after it.
const FRAME_SIZE: usize = 24 + 8;

/// The kinds of surfaces as the file says them.
const TENSOR: u32 = 0;
const TSPLINE: u32 = 1;
const PHT: u32 = 2;
const D1RC: u32 = 3;
const SMOOTH_PHT: u32 = 4;
/// What is no surface has kinds from 16 on.
const CURVE: u32 = 16;
const MODEL: u32 = 17;
const FIELD: u32 = 18;

/// A surface, curve or model that the format knows.
pub trait Save {
    /// Its kind as the file says it.
    fn file_kind(&self) -> u32;

    /// The first version of the format that knows it.
    fn version(&self) -> u32 {
        FIRST_VERSION
    }

    /// Bytes that [`Save::write`] adds.
    fn content_size(&self) -> usize;

    /// Adds what the family needs.
    fn write(&self, writer: &mut Writer);

    /// What a surface is called.
    fn label(&self) -> Option<&Label> {
        None
    }
}

impl AnySurface {
    /// The surface for [`save`].
    pub fn as_saved(&self) -> &dyn Save {
        match self {
            Self::Tensor(surface) => surface,
            Self::Pht(surface) => surface,
            Self::TSpline(surface) => surface,
            Self::D1rc(surface) => surface,
        }
    }
}

/// The bytes of a surface or curve.
pub fn save<S: Save + ?Sized>(surface: &S) -> Vec<u8> {
    let mut writer = Writer::new(surface.version(), surface.file_kind(), save_size(surface));
    surface.write(&mut writer);
    if let Some(label) = told_label(surface) {
        writer.label(label);
    }
    writer.finish()
}

/// How many bytes [`save`] makes.
pub fn save_size<S: Save + ?Sized>(surface: &S) -> usize {
    FRAME_SIZE + surface.content_size() + told_label(surface).map_or(0, label_size)
}

/// The label, if it says anything.
fn told_label<S: Save + ?Sized>(surface: &S) -> Option<&Label> {
    surface.label().filter(|label| **label != Label::default())
}

/// The surface that bytes of [`save`] hold.
pub fn load(bytes: &[u8]) -> Result<AnySurface, LoadError> {
    let (kind, mut reader) = Reader::open(bytes)?;
    let mut surface = match kind {
        TENSOR => AnySurface::Tensor(tensor::read(&mut reader)?),
        PHT => AnySurface::Pht(pht::read(&mut reader)?),
        SMOOTH_PHT => AnySurface::Pht(pht::read_smooth(&mut reader)?),
        D1RC => AnySurface::D1rc(d1rc::read(&mut reader)?),
        TSPLINE => AnySurface::TSpline(tspline::read(&mut reader)?),
        CURVE => return Err(reader.wrong("this is a curve, not a surface")),
        MODEL => return Err(reader.wrong("this is a model, not a surface")),
        FIELD => return Err(reader.wrong("this is a field over a model, not a surface")),
        _ => return Err(reader.wrong(format!("the kind {kind} is unknown"))),
    };
    if reader.end().is_err() {
        surface.as_surface_mut().region_mut().label = reader.label()?;
    }
    reader.end()?;
    Ok(surface)
}

/// The curve that bytes of [`save`] hold.
pub fn load_curve(bytes: &[u8]) -> Result<Curve, LoadError> {
    let (kind, mut reader) = Reader::open(bytes)?;
    if kind != CURVE {
        return Err(reader.wrong(format!("the kind is {kind}, not that of a curve")));
    }
    let curve = curve::read(&mut reader)?;
    reader.end()?;
    Ok(curve)
}

/// What a file of the format holds.
#[derive(Debug, Clone)]
#[allow(clippy::large_enum_variant, reason = "one is alive at once")]
pub enum Saved {
    /// A surface.
    Surface(AnySurface),
    /// A curve.
    Curve(Curve),
    /// A model.
    Model(Model),
}

/// Whatever bytes of [`save`] hold.
pub fn load_any(bytes: &[u8]) -> Result<Saved, LoadError> {
    let (kind, _) = Reader::open(bytes)?;
    match kind {
        MODEL => load_model(bytes).map(Saved::Model),
        CURVE => load_curve(bytes).map(Saved::Curve),
        _ => load(bytes).map(Saved::Surface),
    }
}

/// Whatever a file holds.
pub fn load_any_file(path: &Path) -> Result<Saved, LoadError> {
    load_any(&read_file(path)?)
}

/// The model that bytes of [`save`] hold.
pub fn load_model(bytes: &[u8]) -> Result<Model, LoadError> {
    let (kind, mut reader) = Reader::open(bytes)?;
    if kind != MODEL {
        return Err(reader.wrong(format!("the kind is {kind}, not that of a model")));
    }
    let model = model::read(&mut reader)?;
    reader.end()?;
    Ok(model)
}

/// A model in space, or values over the faces of one.
#[derive(Debug, Clone)]
#[allow(clippy::large_enum_variant, reason = "one is alive at once")]
pub enum ModelOrField {
    /// A model.
    Model(Model),
    /// Values over its faces.
    Field(ModelField),
}

/// The model or field that bytes of [`save`] hold.
pub fn load_model_or_field(bytes: &[u8]) -> Result<ModelOrField, LoadError> {
    let (kind, mut reader) = Reader::open(bytes)?;
    if kind != FIELD {
        return load_model(bytes).map(ModelOrField::Model);
    }
    let field = model_field::read(&mut reader)?;
    reader.end()?;
    Ok(ModelOrField::Field(field))
}

/// The model or field that a file holds.
pub fn load_model_or_field_file(path: &Path) -> Result<ModelOrField, LoadError> {
    load_model_or_field(&read_file(path)?)
}

/// Saves to a file.
pub fn save_file<S: Save + ?Sized>(surface: &S, path: &Path) -> Result<(), ExportError> {
    Ok(file::write(path, &save(surface))?)
}

/// Loads from a file.
pub fn load_file(path: &Path) -> Result<AnySurface, LoadError> {
    load(&read_file(path)?)
}

/// Loads a curve from a file.
pub fn load_curve_file(path: &Path) -> Result<Curve, LoadError> {
    load_curve(&read_file(path)?)
}

fn read_file(path: &Path) -> Result<Vec<u8>, LoadError> {
    Ok(file::read(path, memory::limit(0))?)
}

#[cfg(test)]
mod tests;
