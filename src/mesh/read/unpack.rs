//! Files packed by gzip.

use super::ReadError;
use flate2::read::MultiGzDecoder;
use std::borrow::Cow;
use std::io::Read;

/// What every file of gzip begins with.
const MAGIC: &[u8] = b"\x1f\x8b";

/// The content itself, or what is packed in it, of which at most `limit` bytes are taken.
pub(super) fn unpacked(bytes: &[u8], limit: u64) -> Result<Cow<'_, [u8]>, ReadError> {
    if !bytes.starts_with(MAGIC) {
        return Ok(bytes.into());
    }
    let mut content = Vec::new();
    let mut packed = MultiGzDecoder::new(bytes).take(limit.saturating_add(1));
    let byte = bytes.len();
    packed.read_to_end(&mut content).map_err(|error| ReadError::Binary {
        byte,
        problem: format!("the packed file cannot be unpacked: {error}"),
    })?;
    if content.len() as u64 > limit {
        return Err(ReadError::TooLarge { limit });
    }
    Ok(content.into())
}
