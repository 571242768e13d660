//! Fields of the format, one after the other.

use super::{LoadError, MAGIC, VERSION};
use crate::knots::KnotVector;
use crate::memory::{self, CollectVec};
use crate::surface::{Domain, Label, Region, Trims, Unit};
use glam::DVec2;

/// Writes fields.
#[derive(Debug)]
pub struct Writer {
    bytes: Vec<u8>,
    size: usize,
}

impl Writer {
    /// With the fields of every file; `size` is that of the whole.
    pub(super) fn new(version: u32, kind: u32, size: usize) -> Self {
        let mut bytes = memory::with_capacity(size);
        bytes.extend(MAGIC);
        bytes.extend(version.to_le_bytes());
        bytes.extend(kind.to_le_bytes());
        bytes.extend((size as u64).to_le_bytes());
        Self { bytes, size }
    }

    pub(super) fn count(&mut self, number: usize) {
        memory::extend(&mut self.bytes, (number as u64).to_le_bytes());
    }

    pub(super) fn doubles(&mut self, values: &[f64]) {
        memory::extend(&mut self.bytes, values.iter().flat_map(|x| x.to_le_bytes()));
    }

    /// The flag and the count that say what [`Writer::region`] writes.
    pub(super) fn region_sizes(&mut self, region: &Region) {
        self.count(usize::from(region.data_box.is_some()));
        self.count(region.trims.loops().len());
    }

    pub(super) fn region(&mut self, region: &Region) {
        if let Some(data) = region.data_box {
            self.doubles(&[data.min.x, data.max.x, data.min.y, data.max.y]);
        }
        for polyline in region.trims.loops() {
            self.count(polyline.len());
            polyline.iter().for_each(|uv| self.doubles(&uv.to_array()));
        }
    }

    pub(super) fn label(&mut self, label: &Label) {
        self.count(label.unit as usize);
        self.count(label.name.len());
        self.bytes.extend(label.name.as_bytes());
        self.bytes.resize(self.bytes.len().next_multiple_of(8), 0);
    }

    /// The whole, with its checksum.
    pub(super) fn finish(mut self) -> Vec<u8> {
        let sum = crc32fast::hash(&self.bytes);
        memory::extend(&mut self.bytes, u64::from(sum).to_le_bytes());
        debug_assert_eq!(self.bytes.len(), self.size, "the family's size is wrong");
        self.bytes
    }
}

/// Bytes that [`Writer::label`] writes.
pub(super) fn label_size(label: &Label) -> usize {
    16 + label.name.len().next_multiple_of(8)
}

/// Bytes that [`Writer::region`] writes.
pub(super) fn region_size(region: &Region) -> usize {
    let trims = region.trims.loops().iter().map(|polyline| 1 + 2 * polyline.len()).sum::<usize>();
    8 * (trims + if region.data_box.is_some() { 4 } else { 0 })
}

/// Reads fields; the checksum has been verified, sizes are still not trusted.
pub(super) struct Reader<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Reader<'a> {
    /// Checks the frame; the kind and what follows the size are next.
    pub(super) fn open(bytes: &'a [u8]) -> Result<(u32, Self), LoadError> {
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
        let version = reader.u32()?;
        if version > VERSION {
            return Err(LoadError::Version { version });
        }
        if version == 0 {
            return Err(reader.wrong("there is no version 0"));
        }
        let kind = reader.u32()?;
        reader.at = 24;
        Ok((kind, reader))
    }

    pub(super) fn wrong(&self, problem: impl Into<String>) -> LoadError {
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

    pub(super) fn count(&mut self) -> Result<usize, LoadError> {
        let value = self.u64()?;
        usize::try_from(value).map_err(|_| self.wrong(format!("the count {value} is too large")))
    }

    /// A count that fits into 32 bits.
    pub(super) fn number(&mut self) -> Result<u32, LoadError> {
        let value = self.u64()?;
        u32::try_from(value).map_err(|_| self.wrong(format!("the number {value} is too large")))
    }

    pub(super) fn double(&mut self) -> Result<f64, LoadError> {
        Ok(f64::from_le_bytes(self.take()?))
    }

    pub(super) fn flag(&mut self) -> Result<bool, LoadError> {
        match self.u64()? {
            0 => Ok(false),
            1 => Ok(true),
            other => Err(self.wrong(format!("a flag is {other}"))),
        }
    }

    pub(super) fn doubles(&mut self, count: usize) -> Result<Vec<f64>, LoadError> {
        let rest = &self.bytes[self.at..];
        let Some(taken) = count.checked_mul(8).and_then(|size| rest.get(..size)) else {
            return Err(self.wrong(format!("{count} numbers are announced, {} bytes are left", rest.len())));
        };
        self.at += taken.len();
        Ok(taken.as_chunks().0.iter().map(|&number| f64::from_le_bytes(number)).collect_vec())
    }

    /// `count` numbers that are knots.
    pub(super) fn knots(&mut self, degree: usize, count: usize) -> Result<KnotVector, LoadError> {
        let knots = self.doubles(count)?;
        KnotVector::new(knots, degree).map_err(|error| self.wrong(error.to_string()))
    }

    /// What [`Writer::region`] wrote for a surface over `domain`.
    pub(super) fn region(
        &mut self,
        has_data_box: bool,
        trim_count: usize,
        domain: &Domain,
    ) -> Result<Region, LoadError> {
        let data_box = if has_data_box { Some(self.domain()?) } else { None };
        let mut loops = Vec::new();
        for _ in 0..trim_count {
            let count = self.count()?;
            let numbers = self.doubles(count.saturating_mul(2))?;
            memory::push(&mut loops, numbers.chunks_exact(2).map(DVec2::from_slice).collect_vec());
        }
        let trims = Trims::new(loops, domain).map_err(|error| self.wrong(error.to_string()))?;
        Ok(Region { data_box, trims, ..Region::default() })
    }

    /// What [`Writer::label`] wrote.
    pub(super) fn label(&mut self) -> Result<Label, LoadError> {
        let unit = self.count()?;
        let unit = *Unit::ALL.get(unit).ok_or_else(|| self.wrong(format!("the unit {unit} is unknown")))?;
        let count = self.count()?;
        let padded = count.checked_next_multiple_of(8);
        let Some(taken) = padded.and_then(|size| self.bytes.get(self.at..)?.get(..size)) else {
            return Err(self.wrong(format!("a name of {count} bytes is announced, there are fewer")));
        };
        let (name, rest) = taken.split_at(count);
        let Ok(name) = std::str::from_utf8(name) else { return Err(self.wrong("the name is not UTF-8")) };
        if name.contains('\0') || rest.iter().any(|&byte| byte != 0) {
            return Err(self.wrong("the name has a zero, or none behind it"));
        }
        let label = Label { name: name.to_owned(), unit };
        self.at += taken.len();
        Ok(label)
    }

    fn domain(&mut self) -> Result<Domain, LoadError> {
        let numbers = self.doubles(4)?;
        let &[u0, u1, v0, v1] = numbers.as_slice() else {
            return Err(self.wrong("the data box is incomplete"));
        };
        Ok(Domain { min: DVec2::new(u0, v0), max: DVec2::new(u1, v1) })
    }

    pub(super) fn end(&self) -> Result<(), LoadError> {
        if self.at == self.bytes.len() { Ok(()) } else { Err(self.wrong("there are bytes left over")) }
    }
}
