//! A surface over free knots is continued a little beyond its data: by one more cell at each end, with the curvature
//! of the end falling to zero.
//!
//! With the knots `s, t, t', t''` at an end, `s` the new one, and `f` the blossom of the first cell, whose control
//! points are `P0 = f(t,t,t)`, `P1 = f(t,t,t')`, `P2 = f(t,t',t'')`, those of the new cell follow from its joining
//! twice differentiably at `t`:
//! ```text
//! Q2 = f(s,t,t')   E = f(s,t,t)   Q1 = f(s,s,t)   Q0 = 2 Q1 - E    (no curvature at s)
//! ```

use crate::geometry::Bounds;
use crate::knots::KnotVector;
use crate::surface::tensor::{Axis, TensorError, TensorSurface};
use crate::surface::{Domain, Surface};
use glam::DVec2;

/// A buffer that leaves the box of the data by more than this share of its diagonal is too wide.
const FARTHEST: f64 = 0.05;
/// How often it is halved before it is given up.
const HALVINGS: i32 = 4;
/// Places looked at along a side of the domain.
const SAMPLES: usize = 65;

/// The surface continued by the share `buffer` of its ranges, or less where it would leave the box of its data.
pub(super) fn with_buffer(surface: TensorSurface, buffer: f64, bounds: &Bounds) -> TensorSurface {
    let data = surface.domain();
    let widths = (0..HALVINGS).map(|k| buffer * 0.5_f64.powi(k) * data.size());
    let continued = widths.filter(|width| width.min_element() > 0.0).map(|width| continued(&surface, width));
    let fit =
        continued.flatten().find(|wider| farthest(wider, &data, bounds) <= FARTHEST * bounds.diagonal());
    fit.unwrap_or(surface)
}

/// How far a surface leaves a box between the sides of its domain and the data.
fn farthest(surface: &TensorSurface, data: &Domain, bounds: &Bounds) -> f64 {
    let domain = surface.domain();
    let along = |k: usize, from: f64, to: f64| from + (to - from) * k as f64 / (SAMPLES - 1) as f64;
    let mut places = Vec::with_capacity(8 * SAMPLES);
    for k in 0..SAMPLES {
        let (u, v) = (along(k, domain.min.x, domain.max.x), along(k, domain.min.y, domain.max.y));
        for share in [0.5, 1.0] {
            let (low, high) = (data.min.lerp(domain.min, share), data.max.lerp(domain.max, share));
            places.extend([(u, low.y), (u, high.y), (low.x, v), (high.x, v)].map(DVec2::from));
        }
    }
    let dim = surface.dim();
    let mut rows = vec![0.0; places.len() * dim];
    surface.eval_rows(&places, 0, &mut rows);
    let beyond = |(k, x): (usize, &f64)| (bounds.min[k % dim] - x).max(x - bounds.max[k % dim]);
    rows.iter().enumerate().map(beyond).fold(0.0, f64::max)
}

fn continued(surface: &TensorSurface, width: DVec2) -> Result<TensorSurface, TensorError> {
    let (dim, domain) = (surface.dim(), surface.domain());
    let (u, v) = (surface.knots(Axis::U), surface.knots(Axis::V));
    let line = v.basis_count() * dim;
    let (low, high) = (domain.min - width, domain.max + width);
    let along_u = continue_rows(surface.control_points(), line, u, [low.x, high.x]);
    let points = along_u.chunks_exact(line).flat_map(|line| continue_rows(line, dim, v, [low.y, high.y]));
    let longer = |knots: &KnotVector, low: f64, high: f64, axis: Axis| {
        let breaks: Vec<f64> = [low].into_iter().chain(knots.breaks()).chain([high]).collect();
        KnotVector::clamped(&breaks, 3).map_err(|error| TensorError::Knots { axis, error })
    };
    let (u, v) = (longer(u, low.x, high.x, Axis::U)?, longer(v, low.y, high.y, Axis::V)?);
    TensorSurface::new(dim, u, v, points.collect(), None)
}

/// Control points, rows of `row` numbers over cubic knots, and those of a cell more at each end.
fn continue_rows(points: &[f64], row: usize, knots: &KnotVector, [low, high]: [f64; 2]) -> Vec<f64> {
    let (t, count) = (knots.knots(), points.len() / row);
    let last = t.len() - 1;
    let at = |i: usize| &points[i * row..][..row];
    let start = end_cell([low, t[3], t[4], t[5]], [at(0), at(1), at(2)]);
    let end = [high, t[last - 3], t[last - 4], t[last - 5]];
    let end = end_cell(end, [at(count - 1), at(count - 2), at(count - 3)]);
    let inner = &points[2 * row..(count - 2) * row];
    let [q0, q1, q2] = start;
    let [r0, r1, r2] = end;
    [&q0, &q1, &q2, inner, &r2, &r1, &r0].concat()
}

/// `Q0`, `Q1` and `Q2` from the knots `s, t, t', t''` and `P0`, `P1`, `P2`.
fn end_cell([s, t, t1, t2]: [f64; 4], [p0, p1, p2]: [&[f64]; 3]) -> [Vec<f64>; 3] {
    let blend = |a: &[f64], b: &[f64], share: f64| -> Vec<f64> {
        a.iter().zip(b).map(|(a, b)| a + share * (b - a)).collect()
    };
    let (near, far) = ((s - t) / (t1 - t), (s - t) / (t2 - t));
    let q2 = blend(p1, p2, far);
    let e = blend(p0, p1, near);
    let q1 = blend(&e, &q2, near);
    let q0 = blend(&e, &q1, 2.0);
    [q0, q1, q2]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::Random;

    #[test]
    fn a_continued_surface_is_the_same_inside_and_straight_at_its_ends() {
        for breaks in [vec![0.0, 1.0], vec![0.0, 0.1, 0.4, 1.0]] {
            let mut random = Random::new(5);
            let knots = KnotVector::clamped(&breaks, 3).unwrap();
            let points = (0..knots.basis_count().pow(2)).map(|_| random.unit()).collect();
            let surface = TensorSurface::new(1, knots.clone(), knots, points, None).unwrap();
            let wider = continued(&surface, DVec2::splat(0.1)).unwrap();
            assert_eq!(wider.domain(), Domain { min: DVec2::splat(-0.1), max: DVec2::splat(1.1) });
            for _ in 0..100 {
                let uv = DVec2::new(random.unit(), random.unit());
                let (mut a, mut b) = ([0.0], [0.0]);
                surface.eval_rows(&[uv], 0, &mut a);
                wider.eval_rows(&[uv], 0, &mut b);
                // a few blends of numbers below 10
                assert!((a[0] - b[0]).abs() < 1e-13, "{uv}: {a:?} {b:?}");
            }
            let mut end = [0.0; 6];
            wider.eval_rows(&[DVec2::new(-0.1, 0.3)], 2, &mut end);
            // second derivatives of size 1e3 cancel
            assert!(end[3].abs() < 1e-10, "{end:?}");
        }
    }
}
