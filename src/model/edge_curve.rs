//! Curves of edges: splines, and exact arcs of circles and ellipses.

use super::Frame;
use crate::curve::Curve;
use crate::knots::KnotVector;
use glam::DVec3;
use std::f64::consts::{FRAC_PI_4, TAU};

/// A piece of an ellipse, `C(t) = origin + a cos t x + b sin t y` in a frame with a >= b, or of a circle: a = b. The
/// parameter t is in radians and turns counter-clockwise about the third axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arc {
    frame: Frame,
    radii: [f64; 2],
    from: f64,
    to: f64,
}

/// Pieces of an arc between which it is sampled and integrated: an eighth of a turn each.
const PIECE: f64 = FRAC_PI_4;
/// A whole turn may be longer than it is by rounding.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

impl Arc {
    /// The arc over parameters `from` to `to`; none unless the radii are positive, finite and in order, and the
    /// parameters increase by a turn at most.
    pub fn new(frame: Frame, radii: [f64; 2], [from, to]: [f64; 2]) -> Option<Self> {
        let [a, b] = radii;
        let is_ellipse = a.is_finite() && b > 0.0 && a >= b;
        let turn = to - from;
        (is_ellipse && from.is_finite() && turn > 0.0 && turn <= TAU * (1.0 + ROUNDING)).then_some(Self {
            frame,
            radii,
            from,
            to,
        })
    }

    /// Its centre is the origin, its plane that of the first two axes.
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// Half its width along the first and the second axis.
    pub fn radii(&self) -> [f64; 2] {
        self.radii
    }

    /// Where it begins and ends.
    pub fn domain(&self) -> (f64, f64) {
        (self.from, self.to)
    }

    /// Whether it is a piece of a circle.
    pub fn is_circle(&self) -> bool {
        self.radii[0] == self.radii[1]
    }

    /// The part of it between two of its parameters.
    pub fn part(&self, ends: [f64; 2]) -> Option<Self> {
        Self::new(self.frame, self.radii, ends)
    }

    /// The derivative of this order; the place itself for 0.
    fn derivative(&self, t: f64, order: usize) -> DVec3 {
        let [a, b] = self.radii;
        let (sin, cos) = t.sin_cos();
        // each derivative turns by a quarter
        let [p, q] = [[cos, sin], [-sin, cos], [-cos, -sin], [sin, -cos]][order % 4];
        let from_centre = a * p * self.frame.x() + b * q * self.frame.y();
        if order == 0 { self.frame.origin() + from_centre } else { from_centre }
    }

    fn breaks(&self) -> Vec<f64> {
        let pieces = ((self.to - self.from) / PIECE).ceil().max(1.0);
        let inner = (1..pieces as usize).map(|k| self.from + (self.to - self.from) * k as f64 / pieces);
        [self.from].into_iter().chain(inner).chain([self.to]).collect()
    }

    /// A quintic spline over the same parameters that has the places and two derivatives of the arc at the ends of
    /// pieces of h = a sixty-fourth of a turn: off by at most a h^6 / 46080, 2e-11 of the radius.
    fn to_spline(self) -> Curve {
        const PIECES: f64 = 64.0;
        let count = ((self.to - self.from) / TAU * PIECES).ceil().max(1.0) as usize;
        let step = (self.to - self.from) / count as f64;
        let at = |k: usize| if k == count { self.to } else { self.from + step * k as f64 };
        let mut points = Vec::with_capacity(3 * count + 3);
        for k in 0..=count {
            let [place, speed, turn] = [0, 1, 2].map(|order| self.derivative(at(k), order));
            // Bezier points three a side of the break: C2 there, so that the middle one stands alone
            let side =
                |h: f64| [place + h / 5.0 * speed, place + 2.0 * h / 5.0 * speed + h * h / 20.0 * turn];
            let ([b1, b2], [a1, a2]) = (side(-step), side(step));
            if k > 0 {
                points.extend([b2, b1]);
            }
            points.push(place);
            if k < count {
                points.extend([a1, a2]);
            }
        }
        let mut knots = vec![self.from; 6];
        (1..count).for_each(|k| knots.extend([at(k); 5]));
        knots.extend([self.to; 6]);
        let knots = KnotVector::new(knots, 5).expect("breaks increase");
        let numbers = points.iter().flat_map(|point| point.to_array()).collect();
        Curve::new(3, knots, numbers).expect("five control points a piece, and one")
    }
}

/// The curve of an edge in space.
#[derive(Debug, Clone, PartialEq)]
pub enum EdgeCurve {
    /// A B-spline; one of two control points is a line.
    Spline(Curve),
    /// A piece of a circle or an ellipse.
    Arc(Arc),
}

impl From<Curve> for EdgeCurve {
    fn from(curve: Curve) -> Self {
        Self::Spline(curve)
    }
}

impl From<Arc> for EdgeCurve {
    fn from(arc: Arc) -> Self {
        Self::Arc(arc)
    }
}

impl EdgeCurve {
    /// The straight line between two places, over its length.
    pub fn line(ends: [DVec3; 2]) -> Option<Self> {
        let knots = KnotVector::clamped(&[0.0, ends[0].distance(ends[1])], 1).ok()?;
        let numbers = ends.iter().flat_map(|end| end.to_array()).collect();
        Some(Self::Spline(Curve::new(3, knots, numbers).ok()?))
    }

    /// The spline, if it is one.
    pub fn spline(&self) -> Option<&Curve> {
        match self {
            Self::Spline(curve) => Some(curve),
            Self::Arc(_) => None,
        }
    }

    /// Dimension of its places.
    pub fn dim(&self) -> usize {
        self.spline().map_or(3, Curve::dim)
    }

    /// Where it begins and ends.
    pub fn domain(&self) -> (f64, f64) {
        match self {
            Self::Spline(curve) => curve.knots().domain(),
            Self::Arc(arc) => arc.domain(),
        }
    }

    /// Parameters between which it is smooth and bends by little.
    pub fn breaks(&self) -> Vec<f64> {
        match self {
            Self::Spline(curve) => curve.knots().breaks(),
            Self::Arc(arc) => arc.breaks(),
        }
    }

    /// Whether it is straight, or made of straight pieces.
    pub fn is_polyline(&self) -> bool {
        self.spline().is_some_and(|curve| curve.knots().degree() == 1)
    }

    /// The ends of the line that it is; None for another curve.
    pub fn as_line(&self) -> Option<[DVec3; 2]> {
        match self.spline()?.control_points().as_chunks::<3>().0 {
            &[a, b] => Some([a, b].map(DVec3::from)),
            _ => None,
        }
    }

    /// Values and derivatives at each of `t`, as [`Curve::eval_rows`].
    pub fn eval_rows(&self, t: &[f64], max_derivative: usize, out: &mut [f64]) {
        match self {
            Self::Spline(curve) => curve.eval_rows(t, max_derivative, out),
            Self::Arc(arc) => {
                for (&t, out) in t.iter().zip(out.chunks_exact_mut(3 * (max_derivative + 1))) {
                    for (order, row) in out.chunks_exact_mut(3).enumerate() {
                        row.copy_from_slice(&arc.derivative(t, order).to_array());
                    }
                }
            }
        }
    }

    /// Points at each of `t`.
    pub fn points(&self, t: &[f64]) -> Vec<DVec3> {
        let mut rows = vec![0.0; 3 * t.len()];
        self.eval_rows(t, 0, &mut rows);
        rows.chunks_exact(3).map(DVec3::from_slice).collect()
    }

    /// Its first and last point: control points of a clamped spline to the bit.
    pub fn ends(&self) -> [DVec3; 2] {
        let (from, to) = self.domain();
        match self {
            Self::Spline(curve) if curve.knots().is_clamped() => {
                let points = curve.control_points();
                [&points[..3], &points[points.len() - 3..]].map(DVec3::from_slice)
            }
            _ => [from, to].map(|t| self.points(&[t])[0]),
        }
    }

    /// The corners of a box in which it lies.
    pub fn bounds(&self) -> [DVec3; 2] {
        let around = |points: &mut dyn Iterator<Item = DVec3>| {
            let start = [DVec3::INFINITY, DVec3::NEG_INFINITY];
            points.fold(start, |[low, high], p| [low.min(p), high.max(p)])
        };
        match self {
            Self::Spline(curve) => around(&mut curve.control_points().chunks_exact(3).map(DVec3::from_slice)),
            Self::Arc(arc) => {
                // along each coordinate the whole ellipse reaches to the length of its two axes
                let [a, b] = arc.radii;
                let reach = ((a * arc.frame.x()).powf(2.0) + (b * arc.frame.y()).powf(2.0)).powf(0.5);
                [arc.frame.origin() - reach, arc.frame.origin() + reach]
            }
        }
    }

    /// A spline over the same parameters: itself, or within 2e-11 of the radius of an arc.
    pub fn to_spline(&self) -> Curve {
        match self {
            Self::Spline(curve) => curve.clone(),
            Self::Arc(arc) => arc.to_spline(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn arc(radii: [f64; 2], ends: [f64; 2]) -> Arc {
        let frame = Frame::new(DVec3::new(1.0, -2.0, 0.5), DVec3::new(0.2, 0.3, 1.0), DVec3::X).unwrap();
        Arc::new(frame, radii, ends).unwrap()
    }

    #[test]
    fn splines_of_arcs_are_arcs() {
        for (radii, ends) in [([2.0, 2.0], [0.0, TAU]), ([3.0, 1.0], [-1.0, 2.5]), ([1.0, 1.0], [4.0, 4.01])]
        {
            let exact = EdgeCurve::from(arc(radii, ends));
            let spline = exact.to_spline();
            assert_eq!(spline.knots().domain(), exact.domain());
            let places: Vec<f64> =
                (0..=1000).map(|k| ends[0] + (ends[1] - ends[0]) * f64::from(k) / 1000.0).collect();
            let (mut rows, mut exact_rows) = (vec![0.0; 9 * 1001], vec![0.0; 9 * 1001]);
            spline.eval_rows(&places, 2, &mut rows);
            exact.eval_rows(&places, 2, &mut exact_rows);
            for (row, exact) in rows.chunks_exact(9).zip(exact_rows.chunks_exact(9)) {
                let off = |k: usize| DVec3::from_slice(&row[k..]).distance(DVec3::from_slice(&exact[k..]));
                // h^6 / 46080 with h = 0.098; derivatives are of the fifth and fourth order
                assert!(off(0) < 2e-11 * radii[0] && off(3) < 2e-9 * radii[0] && off(6) < 2e-6 * radii[0]);
            }
        }
    }

    #[test]
    fn boxes_hold_arcs_and_are_no_larger_than_the_ellipse() {
        let curve = EdgeCurve::from(arc([3.0, 1.0], [0.0, TAU]));
        let [low, high] = curve.bounds();
        let places: Vec<f64> = (0..10_000).map(|k| TAU * f64::from(k) / 10_000.0).collect();
        let points = curve.points(&places);
        let least = points.iter().fold(DVec3::INFINITY, |low, &p| low.min(p));
        let most = points.iter().fold(DVec3::NEG_INFINITY, |high, &p| high.max(p));
        // a sample misses the extreme by half a step's sagitta: 3 (pi / 10000)^2 / 2
        assert!((least - low).min_element() >= -1e-14 && (least - low).max_element() < 2e-7);
        assert!((high - most).min_element() >= -1e-14 && (high - most).max_element() < 2e-7);
    }

    #[test]
    fn arcs_that_are_none_are_refused() {
        let whole = arc([1.0, 1.0], [0.0, TAU]);
        for ends in [[0.0, 0.0], [1.0, 0.0], [0.0, 7.0], [f64::NAN, 1.0]] {
            assert_eq!(whole.part(ends), None);
        }
        for radii in [[1.0, 2.0], [1.0, 0.0], [f64::INFINITY, 1.0]] {
            assert_eq!(Arc::new(*whole.frame(), radii, [0.0, 1.0]), None);
        }
    }
}
