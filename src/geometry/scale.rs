//! Sizes at which products of lengths are numbers.

/// The fourth powers of lengths within this range, and of their differences from roundoff on, are numbers.
const SAFE: std::ops::RangeInclusive<f64> = 1e-50..=1e50;

/// 1 for lengths up to `largest` whose products are safe from overflow and underflow, else the power of two that
/// brings `largest` to about one: multiplying by it rounds nothing.
pub fn safe_scale(largest: f64) -> f64 {
    /// The exponent of a power of two that is a number, as its inverse is.
    const MOST: f64 = 1000.0;
    if largest == 0.0 || !largest.is_finite() || SAFE.contains(&largest) {
        return 1.0;
    }
    2.0_f64.powi(-largest.log2().floor().clamp(-MOST, MOST) as i32)
}
