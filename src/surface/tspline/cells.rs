//! The patches of a T-spline: over each span of v the pieces between the knots of the four active curves.

use super::{DEGREE, TSplineSurface};
use crate::bezier::{BezierPatch, extraction, extraction_over};
use crate::curve::{Curve, common_breaks};
use crate::memory::{self, CollectVec};
use crate::surface::{Domain, Patches, Surface};
use glam::DVec2;

/// The spans of v with their pieces along u.
#[derive(Debug, Clone)]
pub(super) struct Cells {
    /// For each span of v where along u its pieces meet.
    breaks: Vec<Vec<f64>>,
    /// The number of the first patch of each span, and the number of all.
    first: Vec<usize>,
}

impl Cells {
    pub(super) fn new(surface: &TSplineSurface) -> Self {
        let together = |span| common_breaks(&surface.active(span).iter().collect::<Vec<&Curve>>());
        let breaks: Vec<Vec<f64>> = surface.knots_v.spans().map(together).collect_vec();
        let mut first = vec![0];
        breaks.iter().for_each(|breaks| first.push(first[first.len() - 1] + breaks.len() - 1));
        Self { breaks, first }
    }
}

/// `rows points`: as many rows of `dim` numbers as `rows` has rows of four.
fn weigh(rows: &[f64], points: &[f64], dim: usize) -> Vec<f64> {
    let mut sums = memory::filled(0.0, rows.len() / 4 * dim);
    for (row, out) in rows.chunks_exact(4).zip(sums.chunks_exact_mut(dim)) {
        for (weight, point) in row.iter().zip(points.chunks_exact(dim)) {
            out.iter_mut().zip(point).for_each(|(sum, x)| *sum += weight * x);
        }
    }
    sums
}

/// Patches in the order of the spans of v, u running fastest.
impl Patches for TSplineSurface {
    fn patch_count(&self) -> usize {
        let first = &self.cells().first;
        first[first.len() - 1]
    }

    fn patch(&self, index: usize) -> BezierPatch {
        let cells = self.cells();
        let rank = cells.first.partition_point(|&first| first <= index) - 1;
        let piece = index - cells.first[rank];
        let [u0, u1] = [0, 1].map(|a| cells.breaks[rank][piece + a]);
        let span_v = self.knots_v.span_of_rank(rank);
        let [v0, v1] = [0, 1].map(|a| self.knots_v.knots()[span_v + a]);
        let dim = self.dim();
        let mut net: [Vec<f64>; 4] = Default::default();
        for curve in self.active(span_v) {
            // knots joined with a neighbour may lie a rounding inside: the middle knows the polynomial
            let span = curve.knots().span((u0 + u1) / 2.0);
            let points = &curve.control_points()[(span - DEGREE) * dim..(span + 1) * dim];
            let along_u = weigh(&extraction_over(curve.knots(), span, [u0, u1]), points, dim);
            net.iter_mut().zip(along_u.chunks_exact(dim)).for_each(|(line, point)| line.extend(point));
        }
        let rows_v = extraction(&self.knots_v, span_v);
        BezierPatch {
            domain: Domain { min: DVec2::new(u0, v0), max: DVec2::new(u1, v1) },
            degree: [DEGREE; 2],
            dim,
            is_rational: false,
            ordinates: net.iter().flat_map(|line| weigh(&rows_v, line, dim)).collect(),
        }
    }

    fn patch_at(&self, uv: DVec2) -> usize {
        let cells = self.cells();
        let rank = self.knots_v.rank_at(uv.y);
        let breaks = &cells.breaks[rank];
        let inner = &breaks[1..breaks.len() - 1];
        cells.first[rank] + inner.partition_point(|&t| t <= uv.x)
    }
}
