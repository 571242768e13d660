//! Fast evaluation of bicubic polynomial surfaces in space.
//!
//! Basis functions come from their coefficients ([`CubicSpan`]). The sums run over rows of twelve numbers, the four
//! control points of one line, and are compiled twice (through `pulp`, which looks at the processor): for AVX2 with FMA,
//! where twelve numbers are three registers, and for any processor. There is no third time for AVX-512: twelve numbers are one
//! and a half of its registers, and points of three numbers do not fill one.
//!
//! Points in a row have the same u, and many of them the same four control points along v: these are computed once. On a
//! grid each point takes four loads, products and one store of a whole register, whose last number is that of the next point.
//!
//! To look the span of u up only where u changes, and to store a whole register a point here too, gains 8 % row by row beside
//! the fastest peer and costs a quarter at random places, measured on an EPYC: the next lookups wait for the last.

use super::{Axis, TensorSurface};
use crate::memory::{self, CollectVec};
use crate::surface::cubic::{CubicSpan, fma};
use crate::surface::rows_of_four::{combine, contract, contract_wide};
use glam::DVec2;
use pulp::{Arch, Simd, WithSimd};

/// The spans of both directions.
#[derive(Debug, Clone)]
pub(super) struct BicubicTable {
    spans: [Vec<CubicSpan>; 2],
}

impl BicubicTable {
    /// None for surfaces of another kind.
    pub(super) fn new(surface: &TensorSurface) -> Option<Self> {
        let knots = [Axis::U, Axis::V].map(|axis| surface.knots(axis));
        let is_cubic = knots.iter().all(|knots| knots.degree() == 3);
        (is_cubic && surface.dim == 3 && surface.weights.is_none())
            .then(|| Self { spans: knots.map(CubicSpan::all) })
    }
}

/// Points whose spans are looked up before the first of them is summed, so that the memory of the next ones is
/// fetched meanwhile.
const BLOCK: usize = 32;

/// A batch of points on one surface.
struct Batch<'a> {
    surface: &'a TensorSurface,
    table: &'a BicubicTable,
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
        let (knots_u, knots_v) = (&self.surface.knots_u, &self.surface.knots_v);
        let count_v = knots_v.basis_count();
        let width = if SLOPES { 9 } else { 3 };
        let mut ranks = [(0, 0); BLOCK];
        // the u and the span along v of the lines
        let mut of_lines = (0, usize::MAX);
        let (mut line, mut across) = ([0.0; 12], [0.0; 12]);
        for (uv, out) in self.uv.chunks(BLOCK).zip(self.out.chunks_mut(BLOCK * width)) {
            for (rank, uv) in ranks.iter_mut().zip(uv) {
                *rank = (knots_u.rank_at(uv.x), knots_v.rank_at(uv.y));
            }
            for ((rank, uv), out) in ranks.iter().zip(uv).zip(out.chunks_exact_mut(width)) {
                let (span_u, span_v) = (&self.table.spans[0][rank.0], &self.table.spans[1][rank.1]);
                let net = &self.surface.control_points[3 * (span_u.first * count_v + span_v.first)..];
                let net = &net[..9 * count_v + 12];
                let lines = [0, 1, 2, 3].map(|r| &net[3 * r * count_v..][..12]);
                // the bits of u, for the lines to be those that u itself would have
                let key = (uv.x.to_bits(), rank.1);
                if key != of_lines {
                    of_lines = key;
                    line = combine::<S>(lines, span_u.basis::<S>(uv.x));
                    if SLOPES {
                        across = combine::<S>(lines, span_u.slopes::<S>(uv.x));
                    }
                }
                let n_v = span_v.basis::<S>(uv.y);
                out[..3].copy_from_slice(&contract::<S>(&line, n_v));
                if SLOPES {
                    out[3..6].copy_from_slice(&contract::<S>(&across, n_v));
                    out[6..9].copy_from_slice(&contract::<S>(&line, span_v.slopes::<S>(uv.y)));
                }
            }
        }
    }
}

/// A grid of points on one surface.
struct Grid<'a> {
    surface: &'a TensorSurface,
    table: &'a BicubicTable,
    u: &'a [f64],
    v: &'a [f64],
    out: &'a mut [f64],
}

impl WithSimd for Grid<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let (knots_u, knots_v) = (&self.surface.knots_u, &self.surface.knots_v);
        let line_length = 3 * knots_v.basis_count();
        let along_v: Vec<(usize, [f64; 4])> = self
            .v
            .iter()
            .map(|&v| &self.table.spans[1][knots_v.rank_at(v)])
            .zip(self.v)
            .map(|(span, &v)| (3 * span.first, span.basis::<S>(v)))
            .collect_vec();
        let mut line = memory::filled(0.0, line_length + 1);
        for (&u, out) in self.u.iter().zip(self.out.chunks_exact_mut(3 * self.v.len())) {
            let span = &self.table.spans[0][knots_u.rank_at(u)];
            let net = &self.surface.control_points[span.first * line_length..];
            let n = span.basis::<S>(u);
            let [a, b, c, d] = [0, 1, 2, 3].map(|r| &net[r * line_length..][..line_length]);
            for k in 0..line_length {
                let low = fma::<S>(n[1], b[k], n[0] * a[k]);
                line[k] = fma::<S>(n[3], d[k], fma::<S>(n[2], c[k], low));
            }
            for (k, &(first, n)) in along_v.iter().enumerate() {
                let Some(points) = line[first..].first_chunk() else { continue };
                let point = contract_wide::<S>(points, n);
                match out[3 * k..].first_chunk_mut() {
                    Some(place) => *place = point,
                    None => out[3 * k..].copy_from_slice(&point[..3]),
                }
            }
        }
    }
}

impl TensorSurface {
    /// The tables of a bicubic polynomial surface in space; None for all others.
    fn bicubic_table(&self) -> Option<&BicubicTable> {
        self.bicubic.get_or_init(|| BicubicTable::new(self)).as_ref()
    }

    /// Values, and first derivatives on request. False if the surface is of another kind.
    pub(super) fn eval_bicubic(&self, uv: &[DVec2], max_derivative: usize, out: &mut [f64]) -> bool {
        let Some(table) = self.bicubic_table().filter(|_| max_derivative <= 1) else { return false };
        Arch::new().dispatch(Batch { surface: self, table, uv, has_slopes: max_derivative == 1, out });
        true
    }

    /// Values on a grid. False if the surface is of another kind.
    pub(super) fn eval_bicubic_grid(&self, u: &[f64], v: &[f64], out: &mut [f64]) -> bool {
        let Some(table) = self.bicubic_table() else { return false };
        if !v.is_empty() {
            Arch::new().dispatch(Grid { surface: self, table, u, v, out });
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::knots::KnotVector;
    use crate::samples::Random;
    use crate::surface::{Surface, derivative_rows};

    fn surface(counts: [usize; 2], evenness: f64, seed: u64) -> TensorSurface {
        let mut random = Random::new(seed);
        let mut knots = |count: usize| {
            let mut t = -1.0;
            let breaks: Vec<f64> = (0..count - 2)
                .map(|_| {
                    t += evenness + (1.0 - evenness) * random.unit().powi(4);
                    t
                })
                .collect();
            KnotVector::clamped(&breaks, 3).unwrap()
        };
        let (knots_u, knots_v) = (knots(counts[0]), knots(counts[1]));
        let points = (0..3 * counts[0] * counts[1]).map(|_| random.signed()).collect();
        TensorSurface::new(3, knots_u, knots_v, points, None).unwrap()
    }

    #[test]
    fn both_paths_agree() {
        for (counts, evenness) in [([4, 4], 1.0), ([12, 40], 1.0), ([30, 9], 0.1), ([50, 50], 1e-2)] {
            let surface = surface(counts, evenness, 3);
            let domain = surface.domain();
            let mut random = Random::new(1);
            let mut uv: Vec<DVec2> = (0..1000)
                .map(|_| domain.min + DVec2::new(random.unit(), random.unit()) * domain.size())
                .collect();
            uv.extend([domain.min, domain.max]);
            for order in 0..=1 {
                let rows = 3 * derivative_rows(order);
                let (mut fast, mut slow) = (vec![0.0; uv.len() * rows], vec![0.0; uv.len() * rows]);
                assert!(surface.eval_bicubic(&uv, order, &mut fast));
                surface.eval_rows_generic(&uv, order, &mut slow);
                // coefficients of the basis stay below 6, those of slopes are divided by a span
                let scale = if order == 0 { 1.0 } else { 6.0 / evenness };
                for (k, (a, b)) in fast.iter().zip(&slow).enumerate() {
                    assert!((a - b).abs() <= 1e-12 * scale, "{counts:?} {k}: {a} is not {b}");
                }
            }
            let (u, v): (Vec<f64>, Vec<f64>) = uv[..30].iter().map(|uv| (uv.x, uv.y)).unzip();
            let mut grid = vec![0.0; 3 * 900];
            surface.eval_grid(&u, &v, &mut grid);
            for (k, row) in grid.chunks_exact(3).enumerate() {
                let mut value = [0.0; 3];
                surface.eval_rows_generic(&[DVec2::new(u[k / 30], v[k % 30])], 0, &mut value);
                assert!(row.iter().zip(value).all(|(a, b)| (a - b).abs() <= 1e-12), "{row:?} {value:?}");
            }
        }
    }
}
