//! Fast evaluation of T-splines in space.
//!
//! Every piece of every control curve is kept as a polynomial of the place in its span, so a curve costs nine
//! multiplications; the four of a point are then summed with basis functions along v ([`CubicSpan`]). Compiled
//! once more for processors with wide registers (through `pulp`).
//!
//! ```text
//! Q_j(u) = ((c_3 x + c_2) x + c_1) x + c_0,    x = (u - t_k) / (t_{k+1} - t_k)
//! ```

use super::TSplineSurface;
use crate::curve::Curve;
use crate::memory;
use crate::surface::Surface;
use crate::surface::cubic::{CubicSpan, fma};
use glam::DVec2;
use pulp::{Arch, Simd, WithSimd};

/// One polynomial piece of a curve in space.
#[derive(Debug, Clone)]
struct Piece {
    /// Row `m` has the coefficients of `x^m`.
    coefficients: [[f64; 3]; 4],
    start: f64,
    inverse_length: f64,
}

/// The pieces of all control curves, and the spans along v.
#[derive(Debug, Clone)]
pub(super) struct FastTable {
    spans_v: Vec<CubicSpan>,
    pieces: Vec<Piece>,
    /// The first piece of each curve.
    first: Vec<usize>,
}

impl FastTable {
    /// None for surfaces of another dimension.
    fn new(surface: &TSplineSurface) -> Option<Self> {
        (surface.dim() == 3).then(|| {
            let mut first = memory::with_capacity(surface.curves.len());
            let mut pieces = Vec::new();
            for curve in &surface.curves {
                first.push(pieces.len());
                pieces.extend(CubicSpan::all(curve.knots()).iter().map(|span| Piece::new(curve, span)));
            }
            Self { spans_v: CubicSpan::all(&surface.knots_v), pieces, first }
        })
    }
}

impl Piece {
    fn new(curve: &Curve, span: &CubicSpan) -> Self {
        let points = &curve.control_points()[3 * span.first..3 * span.first + 12];
        let coefficient =
            |m: usize, c: usize| (0..4).map(|r| span.coefficients[m][r] * points[3 * r + c]).sum();
        Self {
            coefficients: [0, 1, 2, 3].map(|m| [0, 1, 2].map(|c| coefficient(m, c))),
            start: span.start,
            inverse_length: span.inverse_length,
        }
    }

    #[inline(always)]
    fn value<S: Simd>(&self, u: f64) -> [f64; 3] {
        let x = (u - self.start) * self.inverse_length;
        let [c0, c1, c2, c3] = &self.coefficients;
        let mut q = [0.0; 3];
        for k in 0..3 {
            q[k] = fma::<S>(fma::<S>(fma::<S>(c3[k], x, c2[k]), x, c1[k]), x, c0[k]);
        }
        q
    }

    #[inline(always)]
    fn slope<S: Simd>(&self, u: f64) -> [f64; 3] {
        let x = (u - self.start) * self.inverse_length;
        let [_, c1, c2, c3] = &self.coefficients;
        let mut q = [0.0; 3];
        for k in 0..3 {
            q[k] = fma::<S>(fma::<S>(3.0 * c3[k], x, 2.0 * c2[k]), x, c1[k]) * self.inverse_length;
        }
        q
    }
}

/// Points whose pieces are looked up before the first of them is summed, so that the memory of the next ones is
/// fetched meanwhile.
const BLOCK: usize = 32;

/// A batch of points on one surface.
struct Batch<'a> {
    surface: &'a TSplineSurface,
    table: &'a FastTable,
    uv: &'a [DVec2],
    has_slopes: bool,
    out: &'a mut [f64],
}

impl WithSimd for Batch<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        if self.has_slopes { self.eval::<S, true>() } else { self.eval::<S, false>() }
    }
}

impl Batch<'_> {
    #[inline(always)]
    fn eval<S: Simd, const SLOPES: bool>(self) {
        let width = if SLOPES { 9 } else { 3 };
        let mut places = [(0, [0; 4]); BLOCK];
        for (uv, out) in self.uv.chunks(BLOCK).zip(self.out.chunks_mut(BLOCK * width)) {
            for (place, uv) in places.iter_mut().zip(uv) {
                let rank = self.surface.knots_v.rank_at(uv.y);
                let first = self.table.spans_v[rank].first;
                let piece = |r: usize| {
                    self.table.first[first + r] + self.surface.curves[first + r].knots().rank_at(uv.x)
                };
                *place = (rank, [0, 1, 2, 3].map(piece));
            }
            for ((place, uv), out) in places.iter().zip(uv).zip(out.chunks_exact_mut(width)) {
                let span = &self.table.spans_v[place.0];
                let n = span.basis::<S>(uv.y);
                let pieces = place.1.map(|at| &self.table.pieces[at]);
                let values = pieces.map(|piece| piece.value::<S>(uv.x));
                out[..3].copy_from_slice(&combine::<S>(&values, n));
                if SLOPES {
                    let slopes = pieces.map(|piece| piece.slope::<S>(uv.x));
                    out[3..6].copy_from_slice(&combine::<S>(&slopes, n));
                    out[6..9].copy_from_slice(&combine::<S>(&values, span.slopes::<S>(uv.y)));
                }
            }
        }
    }
}

/// One point out of the four curves'.
#[inline(always)]
fn combine<S: Simd>(points: &[[f64; 3]; 4], n: [f64; 4]) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for k in 0..3 {
        let low = fma::<S>(n[1], points[1][k], n[0] * points[0][k]);
        let high = fma::<S>(n[3], points[3][k], n[2] * points[2][k]);
        sum[k] = low + high;
    }
    sum
}

impl TSplineSurface {
    /// Values, and first derivatives on request. False if the surface is of another dimension.
    pub(super) fn eval_fast(&self, uv: &[DVec2], max_derivative: usize, out: &mut [f64]) -> bool {
        let table = self.fast.get_or_init(|| FastTable::new(self)).as_ref();
        let Some(table) = table.filter(|_| max_derivative <= 1) else { return false };
        Arch::new().dispatch(Batch { surface: self, table, uv, has_slopes: max_derivative == 1, out });
        true
    }
}
