//! Sides of a surface that are given: by curves, or by surfaces that lie beyond them.
//!
//! A side is a curve over the range of the data, and what lies beyond it also tells the derivative across it. Both are
//! splines, and the surface can have them exactly where the lines of the curve are among its own, so they are put there and
//! stay. The neighbour's parameter across is scaled to that of the data by one factor all along the side, which keeps the
//! tangent planes.

use super::FitError;
use crate::curve::Curve;
use crate::geometry::Domain;
use crate::knots::KnotVector;
use crate::memory::CollectVec;
use crate::refinement::Refinement;
use crate::surface::pht::PhtSurface;
use crate::surface::tensor::{Axis, TensorSurface};
use crate::tmesh::Vertex;
use glam::DVec2;
use nalgebra::{Matrix3, Vector3};

/// A surface beyond a side.
#[derive(Debug, Clone, Copy)]
pub enum Neighbour<'a> {
    /// Bicubic, clamped, without weights.
    Tensor(&'a TensorSurface),
    /// Without weights.
    Pht(&'a PhtSurface),
}

impl PartialEq for Neighbour<'_> {
    /// Whether it is the same surface.
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Tensor(a), Self::Tensor(b)) => std::ptr::eq(*a, *b),
            (Self::Pht(a), Self::Pht(b)) => std::ptr::eq(*a, *b),
            _ => false,
        }
    }
}

impl<'a> From<&'a TensorSurface> for Neighbour<'a> {
    fn from(surface: &'a TensorSurface) -> Self {
        Self::Tensor(surface)
    }
}

impl<'a> From<&'a PhtSurface> for Neighbour<'a> {
    fn from(surface: &'a PhtSurface) -> Self {
        Self::Pht(surface)
    }
}

/// What the sides of a surface are to be: those at the least u, the largest u, the least v and the largest v.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Sides<'a> {
    /// Curves that the sides are, exactly, from their begin to their end: of degree 3 at most, with continuous curvature for
    /// tensor surfaces, with continuous tangents for PHT-splines.
    pub curves: [Option<&'a Curve>; 4],
    /// Surfaces beyond the sides: a side takes over that of the neighbour which lies nearest, and its tangent planes.
    pub neighbours: [Option<Neighbour<'a>>; 4],
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
/// Least eigenvalue of the products of three powers of the ways of data, as a share of the largest: half of what data at
/// three distances, evenly apart, have.
const LEAST_EIGENVALUE: f64 = 1e-4;

/// How smooth the curves of sides must be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SideJoints {
    /// Their curvature is continuous: knots inside are single.
    Curvature,
    /// Their tangents are: knots inside are double at most.
    Tangent,
}

impl SideJoints {
    fn most_multiplicity(self) -> usize {
        match self {
            Self::Curvature => 1,
            Self::Tangent => 2,
        }
    }

    fn lack(self) -> &'static str {
        match self {
            Self::Curvature => "bends sharply at a knot: it needs continuous curvature",
            Self::Tangent => "has a corner at a knot: it needs continuous tangents",
        }
    }
}

/// What sides are measured by, in model units.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SideMeasure {
    /// How far curves may lie off the data.
    pub tolerance: f64,
    /// Of the data.
    pub diagonal: f64,
}

/// A side that is given, in model units, over the range of the data.
#[derive(Debug, Clone)]
pub(crate) struct GivenSide {
    /// Its place among those at the least u, the largest u, the least v and the largest v.
    pub side: usize,
    /// Cubic.
    pub curve: Curve,
    /// The derivative across, into the surface.
    pub across: Option<Curve>,
}

impl GivenSide {
    /// The sides that are given, made ready for the data.
    pub(crate) fn all(
        sides: &Sides,
        data_box: &Domain,
        uv: &[DVec2],
        (values, dim): (&[f64], usize),
        joints: SideJoints,
        measure: SideMeasure,
    ) -> Result<Vec<Self>, FitError> {
        let mut all = Vec::new();
        for side in 0..4 {
            let data = SideData::new(side, data_box, uv, (values, dim), joints);
            let found = match (sides.curves[side], sides.neighbours[side]) {
                (None, None) => continue,
                (Some(_), Some(_)) => return Err(FitError::SideTwice { side: NAMES[side] }),
                (Some(curve), None) => Self { side, curve: data.over_range(curve, dim)?, across: None },
                (None, Some(neighbour)) => data.beside(neighbour, dim)?,
            };
            data.check(&found.curve, measure.tolerance)?;
            all.push(found);
        }
        check_corners(&all, dim, SAME_CORNER * measure.diagonal)?;
        Ok(all)
    }

    /// The direction across the side: 0 along u.
    pub(crate) fn across_axis(&self) -> usize {
        self.side / 2
    }

    /// Whether it is at the largest parameter.
    pub(crate) fn is_end(&self) -> bool {
        self.side % 2 == 1
    }
}

/// The data along a side, and those near it.
struct SideData<'a> {
    side: usize,
    joints: SideJoints,
    range: [f64; 2],
    /// The range across the side.
    width: f64,
    /// Parameter along the side, share of the range across, value, number.
    near: Vec<(f64, f64, &'a [f64], usize)>,
}

impl<'a> SideData<'a> {
    fn new(
        side: usize,
        data_box: &Domain,
        uv: &[DVec2],
        (values, dim): (&'a [f64], usize),
        joints: SideJoints,
    ) -> Self {
        let (axis, size) = (side / 2, data_box.size());
        let from_side = |uv: &DVec2| match side % 2 {
            0 => (uv[axis] - data_box.min[axis]) / size[axis],
            _ => (data_box.max[axis] - uv[axis]) / size[axis],
        };
        let near =
            uv.iter().enumerate().map(|(k, uv)| (uv[1 - axis], from_side(uv), &values[k * dim..][..dim], k));
        let near = near.filter(|(_, share, ..)| *share <= NEAR_SIDE).collect_vec();
        Self {
            side,
            joints,
            range: [data_box.min[1 - axis], data_box.max[1 - axis]],
            width: size[axis],
            near,
        }
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
        let most = self.joints.most_multiplicity();
        if breaks[1..breaks.len() - 1].iter().any(|&knot| knots.multiplicity(knot) > most) {
            return Err(unfit(self.joints.lack()));
        }
        let ([from, to], [low, high]) = ([breaks[0], breaks[breaks.len() - 1]], self.range);
        let place = |t: &f64| match *t {
            t if t == from => low,
            t if t == to => high,
            t => low + (t - from) / (to - from) * (high - low),
        };
        let knots = KnotVector::new(knots.knots().iter().map(place).collect_vec(), 3);
        let knots = knots.map_err(|_| unfit("has knots that rounding cannot tell apart"))?;
        Curve::new(dim, knots, points).map_err(|_| unfit("has another dimension than the data"))
    }

    /// The side of a neighbour that lies nearest to this one, and what its derivative across tells.
    fn beside(&self, neighbour: Neighbour, dim: usize) -> Result<GivenSide, FitError> {
        let unfit = |why| FitError::SideCurve { side: NAMES[self.side], why };
        check_neighbour(neighbour).map_err(unfit)?;
        if self.on_side().next().is_none() {
            return Err(unfit("has no data on it that tell where it lies"));
        }
        let mut best: Option<(f64, GivenSide)> = None;
        for side in 0..4 {
            let (curve, slopes) = side_of(neighbour, side).ok_or_else(|| unfit("is no curve"))?;
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
        let (_, mut found) = best.ok_or_else(|| unfit("is of a surface that has no side this smooth"))?;
        let speed = self
            .speed(&found)
            .ok_or_else(|| unfit("does not run on into the data: they lie on the other side"))?;
        found.across = found.across.map(|slopes| {
            let scaled = slopes.control_points().iter().map(|x| speed * x).collect_vec();
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

    /// How much faster than the neighbour's parameter the data near the side run away from it, along its slope `g`:
    /// ```text
    /// value - place = g (k x + a x^2 + b x^3),    x the way of a datum from the side
    /// ```
    /// by least squares, in which `a` and `b` take up that the surface bends.
    fn speed(&self, side: &GivenSide) -> Option<f64> {
        let slopes = side.across.as_ref()?;
        let (mut matrix, mut right) = (Matrix3::zeros(), Vector3::zeros());
        for &(t, share, value, _) in self.near.iter().filter(|(_, share, ..)| *share > ON_SIDE) {
            let (place, slope) = (side.curve.eval(t), slopes.eval(t));
            let square: f64 = slope.iter().map(|g| g * g).sum();
            let along: f64 = (0..value.len()).map(|k| (value[k] - place[k]) * slope[k]).sum();
            let x = share / NEAR_SIDE;
            let powers = Vector3::new(x, x * x, x * x * x);
            matrix += square * powers * powers.transpose();
            right += along * powers;
        }
        // with data at one or two distances bending cannot be told from speed
        let eigenvalues = matrix.symmetric_eigenvalues();
        let tells_bending = eigenvalues.min() > LEAST_EIGENVALUE * eigenvalues.max();
        let speed = match matrix.cholesky().filter(|_| tells_bending) {
            Some(factor) => factor.solve(&right).x,
            None => right.x / matrix[(0, 0)],
        };
        (speed > 0.0 && speed.is_finite()).then(|| speed / (NEAR_SIDE * self.width))
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

/// Why a surface cannot be beside a side.
fn check_neighbour(neighbour: Neighbour) -> Result<(), &'static str> {
    let (has_weights, is_cubic) = match neighbour {
        Neighbour::Tensor(surface) => {
            let is_cubic = |axis| surface.knots(axis).degree() == 3 && surface.knots(axis).is_clamped();
            (surface.weights().is_some(), is_cubic(Axis::U) && is_cubic(Axis::V))
        }
        Neighbour::Pht(surface) => (surface.is_rational(), true),
    };
    match (has_weights, is_cubic) {
        (true, _) => Err("is of a surface with weights"),
        (_, false) => Err("is of a surface that is not bicubic and clamped"),
        (false, true) => Ok(()),
    }
}

/// The curve of a side of a surface, and the derivative across it, out of the surface.
pub(crate) fn side_of(neighbour: Neighbour, side: usize) -> Option<(Curve, Curve)> {
    match neighbour {
        Neighbour::Tensor(surface) => side_of_tensor(surface, side),
        Neighbour::Pht(surface) => side_of_pht(surface, side),
    }
}

/// By the jets of the vertices on the side: cubics that share values and slopes there.
fn side_of_pht(surface: &PhtSurface, side: usize) -> Option<(Curve, Curve)> {
    let (mesh, dim, last) = (surface.mesh(), surface.width(), surface.mesh().last_vertex());
    let is_on = |vertex: &Vertex| match side {
        0 => vertex.i == 0,
        1 => vertex.i == last.i,
        2 => vertex.j == 0,
        _ => vertex.j == last.j,
    };
    let along = if side < 2 { 1 } else { 0 };
    let mut jets: Vec<(f64, &[f64])> = surface
        .jets()
        .filter(|(vertex, _)| is_on(vertex))
        .map(|(vertex, jet)| (mesh.parameters(vertex)[along], jet))
        .collect_vec();
    jets.sort_by(|a, b| a.0.total_cmp(&b.0));
    // of the rows f, f_u, f_v and f_uv of a jet those for the curve, and for the derivative across
    let (curve, across) = if side < 2 { ([0, 2], [1, 3]) } else { ([0, 1], [2, 3]) };
    let out = if side.is_multiple_of(2) { -1.0 } else { 1.0 };
    Some((hermite_curve(&jets, dim, curve, 1.0)?, hermite_curve(&jets, dim, across, out)?))
}

/// The cubic spline through values with slopes, two rows of `dim` numbers in each jet, times a factor.
fn hermite_curve(
    jets: &[(f64, &[f64])],
    dim: usize,
    [value, slope]: [usize; 2],
    factor: f64,
) -> Option<Curve> {
    let (first, last) = (jets.first()?.0, jets.last()?.0);
    let inner = jets[1..jets.len() - 1].iter().flat_map(|(t, _)| [*t; 2]);
    let knots = [first; 4].into_iter().chain(inner).chain([last; 4]).collect_vec();
    let mut points = Vec::with_capacity(2 * jets.len() * dim);
    for (k, (t, jet)) in jets.iter().enumerate() {
        let (value, slope) = (&jet[value * dim..][..dim], &jet[slope * dim..][..dim]);
        let beside = |third: f64| value.iter().zip(slope).map(move |(x, s)| factor * (x + third * s));
        let here = value.iter().map(|x| factor * x);
        match k.checked_sub(1) {
            Some(before) => points.extend(beside((jets[before].0 - t) / 3.0)),
            None => points.extend(here.clone()),
        }
        match jets.get(k + 1) {
            Some((after, _)) => points.extend(beside((after - t) / 3.0)),
            None => points.extend(here),
        }
    }
    Curve::new(dim, KnotVector::new(knots, 3).ok()?, points).ok()
}

/// By the outer two rows of control points.
fn side_of_tensor(surface: &TensorSurface, side: usize) -> Option<(Curve, Curve)> {
    let (axis, along) = if side < 2 { (Axis::U, Axis::V) } else { (Axis::V, Axis::U) };
    let (across, along) = (surface.knots(axis), surface.knots(along));
    let (count, length) = (across.basis_count(), along.basis_count());
    let points = surface.control_points();
    let dim = points.len() / (count * length);
    let row = |i: usize| -> Vec<f64> {
        let number = |j: usize| if side < 2 { i * length + j } else { j * count + i };
        (0..length).flat_map(|j| points[number(j) * dim..][..dim].iter().copied()).collect_vec()
    };
    let breaks = across.breaks();
    let (outer, inner, cell) = match side % 2 {
        0 => (row(0), row(1), breaks[1] - breaks[0]),
        _ => (row(count - 1), row(count - 2), breaks[breaks.len() - 1] - breaks[breaks.len() - 2]),
    };
    let slopes = outer.iter().zip(&inner).map(|(a, b)| 3.0 * (a - b) / cell).collect_vec();
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
    let points = curve.control_points().chunks_exact(curve.dim()).rev().flatten().copied().collect_vec();
    let knots = KnotVector::new(knots.collect_vec(), curve.knots().degree());
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

/// The lines that sides need along u and v.
pub(crate) fn side_lines(sides: &[GivenSide]) -> [Vec<f64>; 2] {
    [0, 1].map(|axis| {
        let sides = sides.iter().filter(|side| side.across_axis() != axis);
        let mut lines: Vec<f64> = sides.flat_map(|side| side.curve.knots().breaks()).collect_vec();
        lines.sort_unstable_by(f64::total_cmp);
        lines.dedup();
        lines
    })
}

/// Lines to start from, with those that sides need.
pub(crate) fn with_side_lines(start: Vec<f64>, needed: &[f64]) -> Vec<f64> {
    if needed.is_empty() {
        return start;
    }
    let near = TOO_NEAR * (start[start.len() - 1] - start[0]) / (start.len() - 1) as f64;
    let is_free = |line: &f64| needed.iter().all(|needed| (needed - line).abs() > near);
    let mut lines: Vec<f64> = start.into_iter().filter(is_free).chain(needed.iter().copied()).collect_vec();
    lines.sort_unstable_by(f64::total_cmp);
    lines
}

/// Largest distance of a surface to the curves of its sides, and largest angle to the planes of its neighbours.
pub(crate) fn side_deviation(surface: Neighbour, sides: &[GivenSide]) -> [f64; 2] {
    const SAMPLES: usize = 200;
    let (mut distance, mut angle) = (0.0_f64, 0.0_f64);
    for side in sides {
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
