//! Saved surfaces, curves and models of any content behind a frame that is right: no panic, and what loads is saved again to the
//! same bytes, evaluates to numbers and has an end.
#![no_main]

use glam::DVec2;
use libfuzzer_sys::fuzz_target;
use planish::export::native::{load, load_curve, load_model, save};

/// Bytes before the content: mark, version, kind, size.
const FRAME: usize = 24;
/// Those of the checksum.
const SUM: usize = 8;

/// The same bytes with the mark, the version, the size and the checksum that they should have.
fn mended(data: &[u8]) -> Option<Vec<u8>> {
    let mut bytes = data.to_vec();
    if bytes.len() < FRAME + SUM {
        return None;
    }
    let size = bytes.len();
    bytes[..8].copy_from_slice(b"PLANISH\0");
    bytes[8..12].copy_from_slice(&1_u32.to_le_bytes());
    bytes[16..24].copy_from_slice(&(size as u64).to_le_bytes());
    let sum = crc32fast::hash(&bytes[..size - SUM]);
    bytes[size - SUM..].copy_from_slice(&u64::from(sum).to_le_bytes());
    Some(bytes)
}

fuzz_target!(|data: &[u8]| {
    drop(load(data));
    let Some(bytes) = mended(data) else { return };
    if let Ok(curve) = load_curve(&bytes) {
        assert_eq!(save(&curve), bytes);
    }
    if let Ok(model) = load_model(&bytes) {
        assert_eq!(save(&model), bytes);
    }
    let Ok(any) = load(&bytes) else { return };
    assert_eq!(save(any.as_saved()), bytes);
    let surface = any.as_surface();
    let domain = surface.domain();
    let mut row = vec![0.0; surface.dim()];
    for share in [0.0, 0.3, 1.0] {
        let uv: DVec2 = (domain.min * (1.0 - share) + domain.max * share).clamp(domain.min, domain.max);
        surface.eval_rows(&[uv], 0, &mut row);
    }
});
