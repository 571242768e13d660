//! The inner loop of bicubic surfaces in space: sums over four rows of four points, compiled for the registers
//! that the processor has (through `pulp`).

use super::cubic::fma;
use pulp::Simd;

/// Four control points along v out of four lines of them.
#[inline(always)]
pub(super) fn combine<S: Simd>(lines: [&[f64]; 4], n: [f64; 4]) -> [f64; 12] {
    let mut sums = [0.0; 12];
    for k in 0..12 {
        sums[k] = n[0] * lines[0][k];
    }
    for r in 1..4 {
        for k in 0..12 {
            sums[k] = fma::<S>(n[r], lines[r][k], sums[k]);
        }
    }
    sums
}

/// One point out of four.
#[inline(always)]
pub(super) fn contract<S: Simd>(line: &[f64; 12], n: [f64; 4]) -> [f64; 3] {
    let mut point = [0.0; 3];
    for k in 0..3 {
        let low = fma::<S>(n[1], line[3 + k], n[0] * line[k]);
        let high = fma::<S>(n[3], line[9 + k], n[2] * line[6 + k]);
        point[k] = low + high;
    }
    point
}

/// [`contract`], a register wide: the fourth number is of no use. The line goes on for one number more.
#[inline(always)]
pub(super) fn contract_wide<S: Simd>(line: &[f64; 13], n: [f64; 4]) -> [f64; 4] {
    let mut point = [0.0; 4];
    for k in 0..4 {
        let low = fma::<S>(n[1], line[3 + k], n[0] * line[k]);
        let high = fma::<S>(n[3], line[9 + k], n[2] * line[6 + k]);
        point[k] = low + high;
    }
    point
}
