//! The library's own format: everything a surface is, to the bit.
//!
//! Little-endian, every field eight bytes long but for two of four:
//! ```text
//! offset  type          content
//!  0      8 bytes       "PLANISH" and a zero
//!  8      u32           version of the format, 1
//! 12      u32           kind of the surface, 0 for a tensor surface
//! 16      u64           size of the whole in bytes
//! 24      u64           dim
//! 32      u64 x 2       degrees along u and v
//! 48      u64 x 2       knot counts K_u, K_v along u and v
//! 64      u64           1 if there are weights, else 0
//! 72      u64           1 if there is a data box, else 0
//! 80      u64           number of trims
//! 88      f64           K_u knots, K_v knots, control points (v runs fastest, dim numbers each),
//!                       weights, data box (u0 u1 v0 v1); for each trim a u64 count and count pairs (u,v)
//! end-8   u64           CRC-32 (IEEE 802.3) of all bytes before
//! ```

use super::error::{ExportError, write_file};
use crate::knots::KnotVector;
use crate::surface::tensor::{Axis, TensorSurface};
use crate::surface::{Domain, Region, Surface, Trims};
use glam::DVec2;
use std::path::Path;

/// A buffer or file is not a saved surface.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum LoadError {
    /// The file cannot be read.
    #[error("cannot read {path}: {reason}")]
    File {
        /// The file.
        path: String,
        /// What the system said.
        reason: String,
    },
    /// The bytes are not what they claim to be.
    #[error("not a saved surface: byte {byte}: {problem}")]
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

impl LoadError {
    /// The class of the error.
    pub fn kind(&self) -> crate::ErrorKind {
        match self {
            Self::File { .. } => crate::ErrorKind::File,
            Self::Format { .. } => crate::ErrorKind::Format,
            Self::Version { .. } => crate::ErrorKind::Version,
        }
    }

    /// The offending byte.
    pub fn index(&self) -> Option<usize> {
        match *self {
            Self::Format { byte, .. } => Some(byte),
            _ => None,
        }
    }
}

const MAGIC: [u8; 8] = *b"PLANISH\0";
const VERSION: u32 = 1;
const TENSOR: u32 = 0;

/// The bytes of a tensor surface.
pub fn save(surface: &TensorSurface) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(save_size(surface));
    let (knots_u, knots_v) = (surface.knots(Axis::U), surface.knots(Axis::V));
    let region = surface.region();
    bytes.extend(MAGIC);
    bytes.extend(VERSION.to_le_bytes());
    bytes.extend(TENSOR.to_le_bytes());
    let mut put = |number: usize| bytes.extend((number as u64).to_le_bytes());
    put(save_size(surface));
    put(surface.dim());
    put(knots_u.degree());
    put(knots_v.degree());
    put(knots_u.knots().len());
    put(knots_v.knots().len());
    put(usize::from(surface.weights().is_some()));
    put(usize::from(region.data_box.is_some()));
    put(region.trims.loops().len());
    put_doubles(&mut bytes, knots_u.knots());
    put_doubles(&mut bytes, knots_v.knots());
    put_doubles(&mut bytes, surface.control_points());
    put_doubles(&mut bytes, surface.weights().unwrap_or(&[]));
    if let Some(data) = region.data_box {
        put_doubles(&mut bytes, &[data.min.x, data.max.x, data.min.y, data.max.y]);
    }
    for polyline in region.trims.loops() {
        bytes.extend((polyline.len() as u64).to_le_bytes());
        polyline.iter().for_each(|uv| put_doubles(&mut bytes, &uv.to_array()));
    }
    let sum = crc32fast::hash(&bytes);
    bytes.extend(u64::from(sum).to_le_bytes());
    bytes
}

fn put_doubles(bytes: &mut Vec<u8>, values: &[f64]) {
    bytes.extend(values.iter().flat_map(|x| x.to_le_bytes()));
}

/// How many bytes [`save`] makes.
pub fn save_size(surface: &TensorSurface) -> usize {
    let region = surface.region();
    let doubles = surface.knots(Axis::U).knots().len()
        + surface.knots(Axis::V).knots().len()
        + surface.control_points().len()
        + surface.weights().map_or(0, <[f64]>::len)
        + if region.data_box.is_some() { 4 } else { 0 }
        + region.trims.loops().iter().map(|polyline| 1 + 2 * polyline.len()).sum::<usize>();
    88 + 8 * doubles + 8
}

/// The surface that bytes of [`save`] hold.
pub fn load(bytes: &[u8]) -> Result<TensorSurface, LoadError> {
    let mut reader = Reader::new(bytes)?;
    let version = reader.u32()?;
    if version > VERSION {
        return Err(LoadError::Version { version });
    }
    let kind = reader.u32()?;
    if version == 0 || kind != TENSOR {
        return Err(reader.wrong(format!("unknown version {version} or kind {kind}")));
    }
    reader.count()?; // the size, checked when the reader was made
    let dim = reader.count()?;
    let degrees = [reader.count()?, reader.count()?];
    let knot_counts = [reader.count()?, reader.count()?];
    let [has_weights, has_data_box] = [reader.flag()?, reader.flag()?];
    let trim_count = reader.count()?;
    let knots_u = reader.knots(degrees[0], knot_counts[0])?;
    let knots_v = reader.knots(degrees[1], knot_counts[1])?;
    let point_count = knots_u.basis_count() * knots_v.basis_count();
    let control_points = reader.doubles(point_count.saturating_mul(dim))?;
    let weights = if has_weights { Some(reader.doubles(point_count)?) } else { None };
    let mut surface = TensorSurface::new(dim, knots_u, knots_v, control_points, weights)
        .map_err(|error| reader.wrong(error.to_string()))?;
    let data_box = if has_data_box { Some(reader.domain()?) } else { None };
    let mut loops = Vec::new();
    for _ in 0..trim_count {
        let count = reader.count()?;
        let numbers = reader.doubles(count.saturating_mul(2))?;
        loops.push(numbers.chunks_exact(2).map(DVec2::from_slice).collect());
    }
    let trims = Trims::new(loops, &surface.domain()).map_err(|error| reader.wrong(error.to_string()))?;
    *surface.region_mut() = Region { data_box, trims };
    reader.end()?;
    Ok(surface)
}

/// Saves to a file.
pub fn save_file(surface: &TensorSurface, path: &Path) -> Result<(), ExportError> {
    write_file(path, &save(surface))
}

/// Loads from a file.
pub fn load_file(path: &Path) -> Result<TensorSurface, LoadError> {
    let fail = |error: std::io::Error| LoadError::File {
        path: path.display().to_string(),
        reason: error.to_string(),
    };
    load(&std::fs::read(path).map_err(fail)?)
}

/// Reads fields; the checksum has been verified, sizes are still not trusted.
struct Reader<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Reader<'a> {
    fn new(bytes: &'a [u8]) -> Result<Self, LoadError> {
        let mut reader = Self { bytes, at: 0 };
        if !bytes.starts_with(&MAGIC) {
            return Err(reader.wrong("the mark of the format is missing"));
        }
        reader.at = 16;
        let size = reader.u64()?;
        if size != bytes.len() as u64 || size < 32 {
            reader.at = 16;
            let count = bytes.len();
            return Err(reader.wrong(format!("the size is said to be {size}, there are {count} bytes")));
        }
        reader.at = bytes.len() - 8;
        let sum = reader.u64()?;
        reader.bytes = &bytes[..bytes.len() - 8];
        if sum != u64::from(crc32fast::hash(reader.bytes)) {
            reader.at = bytes.len() - 8;
            return Err(reader.wrong("the checksum does not agree"));
        }
        reader.at = 8;
        Ok(reader)
    }

    fn wrong(&self, problem: impl Into<String>) -> LoadError {
        LoadError::Format { byte: self.at, problem: problem.into() }
    }

    fn take<const N: usize>(&mut self) -> Result<[u8; N], LoadError> {
        let rest = self.bytes.get(self.at..).unwrap_or(&[]);
        let Some(&taken) = rest.first_chunk::<N>() else {
            return Err(self.wrong("the end is missing"));
        };
        self.at += N;
        Ok(taken)
    }

    fn u32(&mut self) -> Result<u32, LoadError> {
        Ok(u32::from_le_bytes(self.take()?))
    }

    fn u64(&mut self) -> Result<u64, LoadError> {
        Ok(u64::from_le_bytes(self.take()?))
    }

    fn count(&mut self) -> Result<usize, LoadError> {
        let value = self.u64()?;
        usize::try_from(value).map_err(|_| self.wrong(format!("the count {value} is too large")))
    }

    fn flag(&mut self) -> Result<bool, LoadError> {
        match self.u64()? {
            0 => Ok(false),
            1 => Ok(true),
            other => Err(self.wrong(format!("a flag is {other}"))),
        }
    }

    fn doubles(&mut self, count: usize) -> Result<Vec<f64>, LoadError> {
        let rest = &self.bytes[self.at..];
        let Some(taken) = count.checked_mul(8).and_then(|size| rest.get(..size)) else {
            return Err(self.wrong(format!("{count} numbers are announced, {} bytes are left", rest.len())));
        };
        self.at += taken.len();
        Ok(taken.as_chunks().0.iter().map(|&number| f64::from_le_bytes(number)).collect())
    }

    fn knots(&mut self, degree: usize, count: usize) -> Result<KnotVector, LoadError> {
        let knots = self.doubles(count)?;
        KnotVector::new(knots, degree).map_err(|error| self.wrong(error.to_string()))
    }

    fn domain(&mut self) -> Result<Domain, LoadError> {
        let numbers = self.doubles(4)?;
        let &[u0, u1, v0, v1] = numbers.as_slice() else {
            return Err(self.wrong("the data box is incomplete"));
        };
        Ok(Domain { min: DVec2::new(u0, v0), max: DVec2::new(u1, v1) })
    }

    fn end(&self) -> Result<(), LoadError> {
        if self.at == self.bytes.len() { Ok(()) } else { Err(self.wrong("there are bytes left over")) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn surface() -> TensorSurface {
        let knots_u = KnotVector::new(vec![0., 0., 0., 0.5, 1., 1., 1.], 2).unwrap();
        let knots_v = KnotVector::new(vec![-1., 0., 1., 2.], 1).unwrap();
        let points = (0..16).map(|k| f64::from(k).sqrt()).collect();
        let weights = (1..9).map(f64::from).collect();
        let mut surface = TensorSurface::new(2, knots_u, knots_v, points, Some(weights)).unwrap();
        let triangle = [(0.1, 0.1), (0.9, 0.1), (0.5, 0.8)].map(|(u, v)| DVec2::new(u, v)).to_vec();
        let data = Domain { min: DVec2::splat(0.1), max: DVec2::splat(0.9) };
        let trims = Trims::new(vec![triangle], &surface.domain()).unwrap();
        *surface.region_mut() = Region { data_box: Some(data), trims };
        surface
    }

    #[test]
    fn a_surface_comes_back_to_the_bit() {
        let bytes = save(&surface());
        assert_eq!(bytes.len(), save_size(&surface()));
        assert_eq!(load(&bytes).unwrap(), surface());
        assert_eq!(save(&load(&bytes).unwrap()), bytes);
    }

    #[test]
    fn every_flipped_bit_and_every_truncation_is_refused() {
        let bytes = save(&surface());
        for byte in 0..bytes.len() {
            for bit in 0..8 {
                let mut flipped = bytes.clone();
                flipped[byte] ^= 1 << bit;
                let error = load(&flipped).unwrap_err();
                assert!(matches!(error, LoadError::Format { .. }), "byte {byte}: {error}");
            }
            assert!(matches!(load(&bytes[..byte]), Err(LoadError::Format { .. })), "{byte} bytes");
        }
    }

    /// Writes a field and makes the checksum right again.
    fn forge(at: usize, field: &[u8]) -> Vec<u8> {
        let mut bytes = save(&surface());
        bytes[at..at + field.len()].copy_from_slice(field);
        let end = bytes.len() - 8;
        let sum = u64::from(crc32fast::hash(&bytes[..end]));
        bytes[end..].copy_from_slice(&sum.to_le_bytes());
        bytes
    }

    #[test]
    fn forged_sizes_are_refused_before_memory_is_asked_for() {
        for at in (24..88).step_by(8) {
            for value in [u64::MAX, u64::MAX / 8, 1 << 40, 77] {
                let result = load(&forge(at, &value.to_le_bytes()));
                assert!(matches!(result, Err(LoadError::Format { .. })), "{value} at {at}: {result:?}");
            }
        }
    }

    #[test]
    fn a_later_version_is_named() {
        assert_eq!(load(&forge(8, &2u32.to_le_bytes())).unwrap_err(), LoadError::Version { version: 2 });
    }
}
