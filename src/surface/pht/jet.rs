//! Jets: the record (f, f_u, f_v, f_uv) that a spline has at a vertex, and what cells make of four of them.
//!
//! A bicubic patch is fixed by the jets of its corners. Along a line of constant v the pairs
//! (f, f_u) and (f_v, f_uv) are cubics fixed by their ends, so a jet anywhere in a cell takes three
//! interpolations: along both edges in u, then between them in v.
//! ```text
//! ordinates nearest to a corner:   f + p f_u + q f_v + p q f_uv,   p in {0, +-H_u/3}, q in {0, +-H_v/3}
//! ```
//! A jet is stored as four rows of `width` numbers.

use crate::hermite::{shape_functions, shape_slopes};
use crate::memory;
use crate::surface::tensor::Axis;

/// Rows of a jet: f, f_u, f_v, f_uv.
pub(super) const ROWS: usize = 4;

/// Two by two weights that carry a row and its derivative from one end of a line to a place on it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Line {
    /// Weights of the row and of its derivative at the first end, for the value.
    pub value: [[f64; 2]; 2],
    /// The same for the derivative.
    pub slope: [[f64; 2]; 2],
}

impl Line {
    /// The place that lies at the fraction `s` of a line of this length.
    pub(super) fn at(s: f64, length: f64) -> Self {
        let ([a, b, c, d], [da, db, dc, dd]) = (shape_functions(s), shape_slopes(s));
        Self { value: [[a, length * c], [b, length * d]], slope: [[da / length, dc], [db / length, dd]] }
    }
}

/// The pairs of rows that are a cubic and its derivative along an axis.
pub(super) fn row_pairs(axis: Axis) -> [[usize; 2]; 2] {
    match axis {
        Axis::U => [[0, 1], [2, 3]],
        Axis::V => [[0, 2], [1, 3]],
    }
}

/// The jet at a place on the line between two others along `axis`.
pub(super) fn between(axis: Axis, line: &Line, ends: [&[f64]; 2], width: usize) -> Vec<f64> {
    let mut jet = memory::filled(0.0, ROWS * width);
    for [row, derivative] in row_pairs(axis) {
        for k in 0..width {
            let (r, d) = (row * width + k, derivative * width + k);
            let sum = |w: &[[f64; 2]; 2]| {
                (w[0][0] * ends[0][r] + w[0][1] * ends[0][d]) + (w[1][0] * ends[1][r] + w[1][1] * ends[1][d])
            };
            (jet[r], jet[d]) = (sum(&line.value), sum(&line.slope));
        }
    }
    jet
}

/// The jet inside a cell whose corners have these jets, in the order of the quadrants.
pub(super) fn inside(corners: [&[f64]; 4], lines: [Line; 2], width: usize) -> Vec<f64> {
    let [low, high] =
        [[0, 2], [1, 3]].map(|ends| between(Axis::U, &lines[0], ends.map(|c| corners[c]), width));
    between(Axis::V, &lines[1], [&low, &high], width)
}

/// One of the ordinates around a vertex: `f + p f_u + q f_v + p q f_uv`.
pub(super) fn ordinate(jet: &[f64], p: f64, q: f64, out: &mut [f64]) {
    let width = out.len();
    for (k, out) in out.iter_mut().enumerate() {
        let row = |r: usize| jet[r * width + k];
        *out = (row(0) + p * row(1)) + q * (row(2) + p * row(3));
    }
}

/// Sixteen rows of Bezier ordinates, v running fastest, of a cell of this size.
pub(super) fn ordinates(corners: [&[f64]; 4], size: [f64; 2], width: usize, out: &mut [f64]) {
    for i in 0..4 {
        for j in 0..4 {
            let corner = 2 * (i / 2) + j / 2;
            let p = [0.0, size[0] / 3.0, -size[0] / 3.0, 0.0][i];
            let q = [0.0, size[1] / 3.0, -size[1] / 3.0, 0.0][j];
            ordinate(corners[corner], p, q, &mut out[(4 * i + j) * width..][..width]);
        }
    }
}
