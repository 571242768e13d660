//! Signs that look random, to estimate traces with, and numbers to choose data by.

use crate::memory::CollectVec;

/// Columns of signs that a trace is estimated with.
pub(crate) const PROBES: usize = 4;

/// A number that looks random and depends on `x` alone (G. Steele, D. Lea and C. Flood, "Fast splittable
/// pseudorandom number generators", OOPSLA 2014).
pub(crate) fn scramble(x: usize) -> u64 {
    let mut z = (x as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// Rows of [`PROBES`] signs, one for each datum.
pub(crate) fn signs(count: usize) -> Vec<f64> {
    let sign = |k: usize| if scramble(k) & 1 == 0 { 1.0 } else { -1.0 };
    (0..PROBES * count).map(sign).collect_vec()
}
