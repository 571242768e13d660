//! Sides of a surface that are given: by curves, or by surfaces that lie beyond them.
//!
//! Along a side at the begin or end of a clamped direction the first row of control points is that of the side's curve, and
//! the second adds the derivative across:
//! ```text
//! c_0 = b                 b the control points of the curve over the lines of the net
//! c_1 - c_0 = h k a / 3   a those of the neighbour's derivative across it, h the first cell
//! ```
//! Both are exact where the lines of the curve are among those of the net, so they are put there and stay. k scales the
//! neighbour's parameter to that of the data: it is the same all along, which keeps the tangent planes.

use super::lines::Lines;
use super::{FitError, Problem};
use crate::curve::Curve;
use crate::fit::common::uniform::grid::Direction;
use crate::fit::common::uniform::normal_equations::TensorBasis;
use crate::geometry::Domain;
use crate::knots::KnotVector;
use crate::linalg::Condition;
use crate::refinement::Refinement;
use crate::surface::tensor::{Axis, TensorSurface};
use glam::DVec2;

/// What the sides of a surface are to be: those at the least u, the largest u, the least v and the largest v.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Sides<'a> {
    /// Curves that the sides are, exactly, from their begin to their end: of degree 3 at most, without knots of more than
    /// one inside.
    pub curves: [Option<&'a Curve>; 4],
    /// Bicubic surfaces beyond the sides: a side takes over that of the neighbour which lies nearest, and its tangent planes.
    pub neighbours: [Option<&'a TensorSurface>; 4],
}

impl Sides<'_> {
    /// Whether none is given.
    pub fn are_free(&self) -> bool {
        self.curves.iter().all(Option::is_none) && self.neighbours.iter().all(Option::is_none)
    }
}

/// The names of the sides, in their order.
const NAMES: [&str; 4] = ["the least u", "the largest u", "the least v", "the largest v"];

/// Data within this share of the range of a side lie on it.
const ON_SIDE: f64 = 1e-9;
/// Ends of sides that meet in a corner lie apart by no more than this share of the diagonal.
const SAME_CORNER: f64 = 1e-12;
/// Lines nearer to those of a side than this share of a cell give way to them.
const TOO_NEAR: f64 = 0.3;
/// Data within this share of the range of a side tell how fast the surface leaves it.
const NEAR_SIDE: f64 = 0.15;

/// A side that is given, in model units, over the range of the data.
pub(super) struct GivenSide {
    side: usize,
    curve: Curve,
    /// The derivative across, into the surface.
    across: Option<Curve>,
}

impl GivenSide {
    /// The sides that are given, made ready for the data.
    pub(super) fn all(
        sides: &Sides,
        data_box: &Domain,
        uv: &[DVec2],
        (values, dim): (&[f64], usize),
        (tolerance, diagonal): (f64, f64),
    ) -> Result<Vec<Self>, FitError> {
        let mut all = Vec::new();
        for side in 0..4 {
            let data = SideData::new(side, data_box, uv, (values, dim));
            let found = match (sides.curves[side], sides.neighbours[side]) {
                (None, None) => continue,
                (Some(_), Some(_)) => return Err(FitError::SideTwice { side: NAMES[side] }),
                (Some(curve), None) => Self { side, curve: data.over_range(curve, dim)?, across: None },
                (None, Some(surface)) => data.beside(surface, dim)?,
            };
            data.check(&found.curve, tolerance)?;
            all.push(found);
        }
        check_corners(&all, dim, SAME_CORNER * diagonal)?;
        Ok(all)
    }

    /// The direction across the side: 0 along u.
    fn across_axis(&self) -> usize {
        self.side / 2
    }

    fn is_end(&self) -> bool {
        self.side % 2 == 1
    }

    /// The conditions of this side on a surface over some lines, in the frame of the problem.
    fn conditions(&self, basis: &TensorBasis<Lines>, problem: &Problem) -> Vec<Condition> {
        let across = if self.across_axis() == 0 { &basis.u } else { &basis.v };
        let along = if self.across_axis() == 0 { &basis.v } else { &basis.u };
        let count_v = basis.v.len();
        let last = across.len() - 1;
        let number = |depth: usize, j: usize| {
            let i = if self.is_end() { last - depth } else { depth };
            if self.across_axis() == 0 { i * count_v + j } else { j * count_v + i }
        };
        let dim = problem.dim;
        let Ok(curve) = on_lines(&self.curve, along) else { return Vec::new() };
        let places = problem.frame.inward(&curve);
        let position = places.chunks_exact(dim).enumerate();
        let mut conditions: Vec<Condition> = position
            .map(|(j, row)| Condition { terms: vec![(number(0, j), 1.0)], values: row.to_vec() })
            .collect();
        if let Some(slopes) = self.across.as_ref().and_then(|slopes| on_lines(slopes, along).ok()) {
            let breaks = across.breaks();
            let cell = if self.is_end() { breaks.len() - 2 } else { 0 };
            let share = (breaks[cell + 1] - breaks[cell]) / 3.0 / problem.frame.scale;
            conditions.extend(slopes.chunks_exact(dim).enumerate().map(|(j, row)| Condition {
                terms: vec![(number(1, j), 1.0), (number(0, j), -1.0)],
                values: row.iter().map(|x| share * x).collect(),
            }));
        }
        conditions
    }
}

/// The control points of a curve over more lines.
fn on_lines(curve: &Curve, lines: &Lines) -> Result<Vec<f64>, FitError> {
    let own = curve.knots().breaks();
    let inner = &lines.breaks()[1..lines.breaks().len() - 1];
    let added: Vec<f64> = inner.iter().copied().filter(|line| !own.contains(line)).collect();
    let curve = curve.insert_knots(&added).map_err(|_| FitError::Singular)?;
    Ok(curve.control_points().to_vec())
}

/// The data along a side, and those near it.
struct SideData<'a> {
    side: usize,
    range: [f64; 2],
    /// Parameter along the side, share of the range across, value, number.
    near: Vec<(f64, f64, &'a [f64], usize)>,
}

impl<'a> SideData<'a> {
    fn new(side: usize, data_box: &Domain, uv: &[DVec2], (values, dim): (&'a [f64], usize)) -> Self {
        let (axis, size) = (side / 2, data_box.size());
        let from_side = |uv: &DVec2| match side % 2 {
            0 => (uv[axis] - data_box.min[axis]) / size[axis],
            _ => (data_box.max[axis] - uv[axis]) / size[axis],
        };
        let near =
            uv.iter().enumerate().map(|(k, uv)| (uv[1 - axis], from_side(uv), &values[k * dim..][..dim], k));
        let near = near.filter(|(_, share, ..)| *share <= NEAR_SIDE).collect();
        Self { side, range: [data_box.min[1 - axis], data_box.max[1 - axis]], near }
    }

    fn on_side(&self) -> impl Iterator<Item = &(f64, f64, &'a [f64], usize)> {
        self.near.iter().filter(|(_, share, ..)| *share <= ON_SIDE)
    }

    /// A curve of the right kind over the range of the side.
    fn over_range(&self, curve: &Curve, dim: usize) -> Result<Curve, FitError> {
        let unfit = |why| FitError::SideCurve { side: NAMES[self.side], why };
        if curve.dim() != dim {
            return Err(unfit("has another dimension than the data"));
        }
        let (knots, mut points) = (curve.knots(), curve.control_points().to_vec());
        if knots.degree() > 3 {
            return Err(unfit("has a degree above 3"));
        }
        if !knots.is_clamped() {
            return Err(unfit("is not clamped at its ends"));
        }
        let mut knots = knots.clone();
        while knots.degree() < 3 {
            let raised = Refinement::elevate(&knots).map_err(|_| unfit("cannot be raised to degree 3"))?;
            points = raised.apply(&points, dim);
            knots = raised.knots().clone();
        }
        let breaks = knots.breaks();
        if breaks[1..breaks.len() - 1].iter().any(|&knot| knots.multiplicity(knot) > 1) {
            return Err(unfit("bends sharply at a knot: it needs continuous curvature"));
        }
        let ([from, to], [low, high]) = ([breaks[0], breaks[breaks.len() - 1]], self.range);
        let place = |t: &f64| match *t {
            t if t == from => low,
            t if t == to => high,
            t => low + (t - from) / (to - from) * (high - low),
        };
        let knots = KnotVector::clamped(&breaks.iter().map(place).collect::<Vec<f64>>(), 3);
        let knots = knots.map_err(|_| unfit("has knots that rounding cannot tell apart"))?;
        Curve::new(dim, knots, points).map_err(|_| unfit("has another dimension than the data"))
    }

    /// The side of a surface that lies nearest to this one, and what its derivative across tells.
    fn beside(&self, surface: &TensorSurface, dim: usize) -> Result<GivenSide, FitError> {
        let unfit = |why| FitError::SideCurve { side: NAMES[self.side], why };
        if surface.weights().is_some() {
            return Err(unfit("is of a surface with weights"));
        }
        let [u, v] = [Axis::U, Axis::V].map(|axis| surface.knots(axis));
        if u.degree() != 3 || v.degree() != 3 || !u.is_clamped() || !v.is_clamped() {
            return Err(unfit("is of a surface that is not bicubic and clamped"));
        }
        if self.on_side().next().is_none() {
            return Err(unfit("has no data on it that tell where it lies"));
        }
        let mut best: Option<(f64, GivenSide)> = None;
        for side in 0..4 {
            let (curve, slopes) = side_of(surface, side).ok_or_else(|| unfit("is no curve"))?;
            for is_reversed in [false, true] {
                let turned = |curve: &Curve| if is_reversed { reversed(curve) } else { curve.clone() };
                let ready = |curve: &Curve| self.over_range(&turned(curve), dim);
                let (Ok(curve), Ok(slopes)) = (ready(&curve), ready(&slopes)) else { continue };
                let miss = self.misses(&curve).map(|(_, miss)| miss).fold(0.0, f64::max);
                if best.as_ref().is_none_or(|(least, _)| miss < *least) {
                    best = Some((miss, GivenSide { side: self.side, curve, across: Some(slopes) }));
                }
            }
        }
        let (_, mut found) =
            best.ok_or_else(|| unfit("is of a surface without a side of continuous curvature"))?;
        let speed = self
            .speed(&found)
            .ok_or_else(|| unfit("does not run on into the data: they lie on the other side"))?;
        found.across = found.across.map(|slopes| {
            let scaled = slopes.control_points().iter().map(|x| speed * x).collect();
            slopes.with_control_points(scaled)
        });
        Ok(found)
    }

    /// By how much the data on the side miss a curve at their parameters.
    fn misses(&self, curve: &Curve) -> impl Iterator<Item = (usize, f64)> {
        self.on_side().map(move |&(t, _, value, datum)| {
            let squares = curve.eval(t).iter().zip(value).map(|(a, b)| (a - b).powi(2)).sum::<f64>();
            (datum, squares.sqrt())
        })
    }

    /// How much faster than the neighbour's parameter the data near the side run away from it.
    fn speed(&self, side: &GivenSide) -> Option<f64> {
        let slopes = side.across.as_ref()?;
        let (mut along, mut square) = (0.0, 0.0);
        for &(t, share, value, _) in self.near.iter().filter(|(_, share, ..)| *share > ON_SIDE) {
            let (place, slope) = (side.curve.eval(t), slopes.eval(t));
            for k in 0..value.len() {
                along += (value[k] - place[k]) * slope[k] * share;
                square += slope[k] * slope[k] * share * share;
            }
        }
        (along > 0.0 && square > 0.0).then(|| along / square)
    }

    /// Refuses a curve that is not where the data are.
    fn check(&self, curve: &Curve, tolerance: f64) -> Result<(), FitError> {
        let (datum, distance) =
            self.misses(curve).fold((0, 0.0), |worst, next| if next.1 > worst.1 { next } else { worst });
        if distance > tolerance {
            return Err(FitError::SideOff { side: NAMES[self.side], index: datum, distance, tolerance });
        }
        Ok(())
    }
}

/// The curve of a side of a bicubic surface, and the derivative across it, out of the surface.
fn side_of(surface: &TensorSurface, side: usize) -> Option<(Curve, Curve)> {
    let (axis, along) = if side < 2 { (Axis::U, Axis::V) } else { (Axis::V, Axis::U) };
    let (across, along) = (surface.knots(axis), surface.knots(along));
    let (count, length) = (across.basis_count(), along.basis_count());
    let points = surface.control_points();
    let dim = points.len() / (count * length);
    let row = |i: usize| -> Vec<f64> {
        let number = |j: usize| if side < 2 { i * length + j } else { j * count + i };
        (0..length).flat_map(|j| points[number(j) * dim..][..dim].iter().copied()).collect()
    };
    let breaks = across.breaks();
    let (outer, inner, cell) = match side % 2 {
        0 => (row(0), row(1), breaks[1] - breaks[0]),
        _ => (row(count - 1), row(count - 2), breaks[breaks.len() - 1] - breaks[breaks.len() - 2]),
    };
    let slopes = outer.iter().zip(&inner).map(|(a, b)| 3.0 * (a - b) / cell).collect();
    Some((Curve::new(dim, along.clone(), outer).ok()?, Curve::new(dim, along.clone(), slopes).ok()?))
}

/// The same curve the other way round.
fn reversed(curve: &Curve) -> Curve {
    let (from, to) = curve.knots().domain();
    let knots = curve.knots().knots().iter().rev().map(|t| {
        if *t == to {
            from
        } else if *t == from {
            to
        } else {
            from + (to - t)
        }
    });
    let points = curve.control_points().chunks_exact(curve.dim()).rev().flatten().copied().collect();
    let knots = KnotVector::new(knots.collect(), curve.knots().degree());
    // mirrored knots increase as the others do, unless rounding makes them equal
    knots.ok().and_then(|knots| Curve::new(curve.dim(), knots, points).ok()).unwrap_or_else(|| curve.clone())
}

/// Sides that meet in a corner meet.
fn check_corners(all: &[GivenSide], dim: usize, exact: f64) -> Result<(), FitError> {
    for first in all.iter().filter(|side| side.across_axis() == 0) {
        for second in all.iter().filter(|side| side.across_axis() == 1) {
            let end = |curve: &Curve, is_end: bool| {
                let points = curve.control_points();
                let from = if is_end { points.len() - dim } else { 0 };
                points[from..from + dim].to_vec()
            };
            let (a, b) = (end(&first.curve, second.is_end()), end(&second.curve, first.is_end()));
            let distance = a.iter().zip(&b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
            if distance > exact {
                return Err(FitError::SidesApart {
                    first: NAMES[first.side],
                    second: NAMES[second.side],
                    distance,
                });
            }
        }
    }
    Ok(())
}

impl Problem<'_> {
    /// The conditions of all sides that are given.
    pub(super) fn side_conditions(&self, basis: &TensorBasis<Lines>) -> Vec<Condition> {
        self.sides.iter().flat_map(|side| side.conditions(basis, self)).collect()
    }

    /// The lines that sides need along u and v.
    pub(super) fn side_lines(&self) -> [Vec<f64>; 2] {
        [0, 1].map(|axis| {
            let sides = self.sides.iter().filter(|side| side.across_axis() != axis);
            let mut lines: Vec<f64> = sides.flat_map(|side| side.curve.knots().breaks()).collect();
            lines.sort_by(f64::total_cmp);
            lines.dedup();
            lines
        })
    }

    /// Lines to start from, with those that sides need.
    pub(super) fn with_side_lines(&self, start: Vec<f64>, axis: usize) -> Vec<f64> {
        let needed = &self.side_lines()[axis];
        if needed.is_empty() {
            return start;
        }
        let near = TOO_NEAR * (start[start.len() - 1] - start[0]) / (start.len() - 1) as f64;
        let is_free = |line: &f64| needed.iter().all(|needed| (needed - line).abs() > near);
        let mut lines: Vec<f64> = start.into_iter().filter(is_free).chain(needed.iter().copied()).collect();
        lines.sort_by(f64::total_cmp);
        lines
    }

    /// Largest distance of the surface to the curves of its sides, and largest angle to the planes of its neighbours.
    pub(super) fn side_deviation(&self, surface: &TensorSurface) -> [f64; 2] {
        const SAMPLES: usize = 200;
        let (mut distance, mut angle) = (0.0_f64, 0.0_f64);
        for side in &self.sides {
            let Some((curve, slopes)) = side_of(surface, side.side) else { continue };
            let (from, to) = side.curve.knots().domain();
            for k in 0..=SAMPLES {
                let t = if k == SAMPLES { to } else { from + (to - from) * k as f64 / SAMPLES as f64 };
                let length =
                    |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
                distance = distance.max(length(&curve.eval(t), &side.curve.eval(t)));
                if let Some(across) = &side.across {
                    // out of this surface against into it; the side itself is common to both planes
                    let (own, given) = (slopes.eval(t), across.eval(t));
                    let size = given.iter().map(|x| x * x).sum::<f64>().sqrt();
                    let apart = own.iter().zip(&given).map(|(a, b)| (a + b).powi(2)).sum::<f64>().sqrt();
                    angle = angle.max((apart / size).atan());
                }
            }
        }
        [distance, angle]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::Control;
    use crate::fit::common::report::{Tolerance, ToleranceScale};
    use crate::fit::tensor::{TensorOptions, fit_points};
    use crate::surface::{Surface, normal};
    use glam::DVec3;

    /// A shell over x from 0 to 2.
    fn shell(x: f64, y: f64) -> [f64; 3] {
        [x, y + 0.1 * x * y, 0.3 * (1.7 * x).sin() * (1.0 + y) + 0.2 * (3.0 * y).cos()]
    }

    /// Its half from `from` on, with places on the sides.
    fn half(from: f64) -> (Vec<DVec2>, Vec<f64>) {
        let uv: Vec<DVec2> =
            (0..40 * 40).map(|k| DVec2::new(f64::from(k / 40), f64::from(k % 40)) / 39.0).collect();
        let values = uv.iter().flat_map(|uv| shell(from + uv.x, uv.y)).collect();
        (uv, values)
    }

    fn options<'a>() -> TensorOptions<'a> {
        let tolerance = Tolerance { value: 1e-4, scale: ToleranceScale::Relative };
        TensorOptions { tolerance, buffer: 0.0, ..TensorOptions::default() }
    }

    fn rows(surface: &TensorSurface, u: f64) -> Vec<[DVec3; 3]> {
        let uv: Vec<DVec2> = (0..=100).map(|k| DVec2::new(u, f64::from(k) / 100.0)).collect();
        let mut rows = vec![0.0; 9 * uv.len()];
        surface.eval_rows(&uv, 1, &mut rows);
        rows.chunks(9).map(|row| [0, 3, 6].map(|k| DVec3::from_slice(&row[k..]))).collect()
    }

    #[test]
    fn halves_of_a_shell_share_their_curve_and_their_tangent_planes() {
        let (uv, values) = half(0.0);
        let first = fit_points(&uv, &values, 3, &options(), &mut Control::new(1)).unwrap();
        let (uv, values) = half(1.0);
        let sides = Sides { neighbours: [Some(&first.surface), None, None, None], ..Sides::default() };
        let second =
            fit_points(&uv, &values, 3, &TensorOptions { sides, ..options() }, &mut Control::new(1)).unwrap();
        assert!(second.report.max_error <= second.report.tolerance, "{:?}", second.report);
        for ([a, au, av], [b, bu, bv]) in
            rows(&first.surface, 1.0).into_iter().zip(rows(&second.surface, 0.0))
        {
            assert!(a.distance(b) <= 1e-12 * first.report.diagonal, "{a} {b}");
            let angle = normal(au, av).cross(normal(bu, bv)).length();
            assert!(angle <= 1e-10, "{angle:e}");
            assert!(au.dot(bu) > 0.0);
        }
        assert!(second.report.max_side_error <= 1e-12 * second.report.diagonal, "{:?}", second.report);
        assert!(second.report.max_side_angle <= 1e-10, "{:?}", second.report);
    }

    #[test]
    fn given_curves_are_the_sides_exactly() {
        let (uv, values) = half(0.0);
        let first = fit_points(&uv, &values, 3, &options(), &mut Control::new(1)).unwrap();
        // the curves of a finer surface, over lines of their own
        let [low, high, before, after] = [0, 1, 2, 3].map(|side| side_of(&first.surface, side).unwrap().0);
        let curves = [Some(&low), Some(&high), Some(&before), Some(&after)];
        let loose = Tolerance { value: 2e-3, scale: ToleranceScale::Relative };
        let sides = Sides { curves, ..Sides::default() };
        let options = TensorOptions { sides, tolerance: loose, ..options() };
        let fit = fit_points(&uv, &values, 3, &options, &mut Control::new(1)).unwrap();
        assert!(fit.report.max_error <= fit.report.tolerance && fit.report.max_side_angle == 0.0);
        assert!(fit.report.max_side_error <= 1e-12 * fit.report.diagonal, "{:?}", fit.report);
        for u in [0.0, 1.0] {
            for ([a, ..], [b, ..]) in rows(&first.surface, u).into_iter().zip(rows(&fit.surface, u)) {
                assert!(a.distance(b) <= 1e-12 * fit.report.diagonal, "{a} {b}");
            }
        }
    }

    #[test]
    fn sides_that_do_not_fit_are_refused() {
        let (uv, values) = half(0.0);
        let line =
            |points: Vec<f64>| Curve::new(3, KnotVector::clamped(&[0.0, 1.0], 1).unwrap(), points).unwrap();
        let refuse = |curves: [Option<&Curve>; 4], neighbours: [Option<&TensorSurface>; 4]| {
            let options = TensorOptions { sides: Sides { curves, neighbours }, ..options() };
            fit_points(&uv, &values, 3, &options, &mut Control::new(1)).unwrap_err()
        };
        let straight = line([shell(0.0, 0.0), shell(0.0, 1.0)].concat());
        let error = refuse([Some(&straight), None, None, None], [None; 4]);
        let FitError::SideOff { side, distance, tolerance, .. } = error else { panic!("{error}") };
        assert!(side == "the least u" && distance > 0.01 && tolerance < 1e-3, "{error}");
        assert!(error.to_string().contains("the least u"), "{error}");
        let flat = Curve::new(2, KnotVector::clamped(&[0.0, 1.0], 1).unwrap(), vec![0.0; 4]).unwrap();
        assert!(matches!(refuse([Some(&flat), None, None, None], [None; 4]), FitError::SideCurve { .. }));
        let fit = fit_points(&uv, &values, 3, &options(), &mut Control::new(1)).unwrap();
        let [low, _, before, _] = [0, 1, 2, 3].map(|side| side_of(&fit.surface, side).unwrap().0);
        let mut points = before.control_points().to_vec();
        points[2] += 1e-5;
        let moved = before.with_control_points(points);
        let error = refuse([Some(&low), None, Some(&moved), None], [None; 4]);
        assert!(matches!(error, FitError::SidesApart { .. }), "{error}");
        let error = refuse([Some(&low), None, None, None], [Some(&fit.surface), None, None, None]);
        assert!(matches!(error, FitError::SideTwice { .. }), "{error}");
        // the data lie where the neighbour is
        let error = refuse([None; 4], [Some(&fit.surface), None, None, None]);
        assert!(error.to_string().contains("other side"), "{error}");
    }
}
