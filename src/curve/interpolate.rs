//! C2 cubics through points at given parameters.
//!
//! C. de Boor, "A Practical Guide to Splines" (1978), chapter IV; end rules after L. Piegl and W. Tiller, "The NURBS
//! Book" (1997), section 9.3. The unknowns are the slopes `d_l` at the parameters `u_l`: with `h_l = u_{l+1} - u_l`
//! ```text
//! h_l d_{l-1} + 2 (h_{l-1} + h_l) d_l + h_{l-1} d_{l+1} = 3 (h_{l-1} (P_{l+1} - P_l) / h_l + h_l (P_l - P_{l-1}) / h_{l-1})
//! ```
//! is dominant in its diagonal for every spacing, which the equations of the control points are not. On each span
//! the curve is a Hermite cubic of two points and two slopes ([`shape_functions`]), and its control points are
//! ```text
//! X_{l+1} = P_l + d_l (h_l - h_{l-1}) / 3 - f_l h_l h_{l-1} / 3,   f_l = (3 (P_{l+1} - P_l) / h_l - 2 d_l - d_{l+1}) / h_l
//! ```

use super::{Curve, CurveError};
use crate::hermite::{shape_functions, shape_slopes};
use crate::knots::KnotVector;
use crate::linalg::Tridiagonal;
use crate::memory::{self, CollectVec};

/// What happens at the ends of a row of points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum EndRule<'a> {
    /// The slope of the parabola through the first, and the last, three points.
    Parabolic,
    /// No curvature.
    Natural,
    /// These slopes, derivatives with respect to the parameter.
    Slopes {
        /// At the first point.
        begin: &'a [f64],
        /// At the last point.
        end: &'a [f64],
    },
    /// The last point is the first, and the curve goes on there without a break in two derivatives.
    Periodic,
}

/// The C2 cubic curve through rows of `dim` numbers at rising parameters.
pub fn interpolate(dim: usize, u: &[f64], points: &[f64], ends: EndRule) -> Result<Curve, CurveError> {
    if u.len() < 2 {
        return Err(CurveError::TooFew { count: u.len() });
    }
    Curve::check_finite(u)?;
    if let Some(index) = points.iter().position(|x| !x.is_finite()) {
        return Err(CurveError::PointNotFinite { index: index / dim.max(1) });
    }
    match ends {
        EndRule::Slopes { begin, end } if begin.len() != dim || end.len() != dim => {
            Err(CurveError::SlopeCount { count: begin.len() + end.len(), expected: 2 * dim })
        }
        EndRule::Slopes { begin, end } if begin.iter().chain(end).any(|x| !x.is_finite()) => {
            Err(CurveError::SlopesNotFinite)
        }
        EndRule::Periodic if points.get(..dim) != points.get(points.len().saturating_sub(dim)..) => {
            Err(CurveError::NotClosed)
        }
        _ => Interpolant::new(dim, memory::copied(u), memory::copied(points), ends)?.to_curve(),
    }
}

/// A cubic spline in Hermite form: points and slopes at rising parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct Interpolant {
    dim: usize,
    parameters: Vec<f64>,
    points: Vec<f64>,
    slopes: Vec<f64>,
}

impl Interpolant {
    /// The C2 cubic through rows of `dim` numbers at rising parameters, at least two.
    pub fn new(
        dim: usize,
        parameters: Vec<f64>,
        points: Vec<f64>,
        ends: EndRule,
    ) -> Result<Self, CurveError> {
        let slopes = memory::filled(0.0, points.len());
        let mut curve = Self::with_slopes(dim, parameters, points, slopes)?;
        match ends {
            EndRule::Periodic => curve.solve_periodic(),
            _ => curve.solve_open(ends),
        }
        Ok(curve)
    }

    /// The C1 cubic with these slopes.
    pub fn with_slopes(
        dim: usize,
        parameters: Vec<f64>,
        points: Vec<f64>,
        slopes: Vec<f64>,
    ) -> Result<Self, CurveError> {
        let expected = parameters.len().max(2);
        if dim == 0 {
            return Err(CurveError::Dimension);
        }
        for count in [points.len(), slopes.len()] {
            if count != expected * dim {
                return Err(CurveError::ControlPointCount { count, expected, dim });
            }
        }
        match parameters.windows(2).position(|pair| !(pair[0] < pair[1])) {
            Some(index) => Err(CurveError::NotRising { index: index + 1 }),
            None => Ok(Self { dim, parameters, points, slopes }),
        }
    }

    /// Components of a value.
    pub fn dim(&self) -> usize {
        self.dim
    }

    /// Where the pieces meet.
    pub fn parameters(&self) -> &[f64] {
        &self.parameters
    }

    /// The values there.
    pub fn points(&self) -> &[f64] {
        &self.points
    }

    /// The derivatives at the first and the last parameter.
    pub fn end_slopes(&self) -> [&[f64]; 2] {
        [&self.slopes[..self.dim], &self.slopes[self.slopes.len() - self.dim..]]
    }

    fn step(&self, l: usize) -> f64 {
        self.parameters[l + 1] - self.parameters[l]
    }

    /// `(P_{l+1} - P_l) / h_l`, component `c`.
    fn chord(&self, l: usize, c: usize) -> f64 {
        (self.points[(l + 1) * self.dim + c] - self.points[l * self.dim + c]) / self.step(l)
    }

    fn solve_open(&mut self, ends: EndRule) {
        let (last, dim) = (self.parameters.len() - 1, self.dim);
        let (mut lower, mut diagonal, mut upper) =
            (memory::filled(0.0, last + 1), memory::filled(1.0, last + 1), memory::filled(0.0, last + 1));
        let mut slopes = memory::filled(0.0, (last + 1) * dim);
        for l in 1..last {
            let (before, after) = (self.step(l - 1), self.step(l));
            (lower[l], diagonal[l], upper[l]) = (after, 2.0 * (before + after), before);
            for c in 0..dim {
                slopes[l * dim + c] = 3.0 * (before * self.chord(l, c) + after * self.chord(l - 1, c));
            }
        }
        match ends {
            EndRule::Slopes { begin, end } => {
                slopes[..dim].copy_from_slice(begin);
                slopes[last * dim..].copy_from_slice(end);
            }
            EndRule::Natural if last > 1 => {
                (diagonal[0], upper[0]) = (2.0, 1.0);
                (lower[last], diagonal[last]) = (1.0, 2.0);
                for c in 0..dim {
                    slopes[c] = 3.0 * self.chord(0, c);
                    slopes[last * dim + c] = 3.0 * self.chord(last - 1, c);
                }
            }
            _ => {
                for c in 0..dim {
                    slopes[c] = self.parabolic_slope([0, 1.min(last - 1)], c);
                    slopes[last * dim + c] = self.parabolic_slope([last - 1, last.max(2) - 2], c);
                }
            }
        }
        Tridiagonal::new(lower, &diagonal, upper).solve(&mut slopes, dim);
        self.slopes = slopes;
    }

    /// The slope of a parabola where its first span begins, or its last one ends; `spans` are the outer and the
    /// inner one, which are the same for a straight line.
    fn parabolic_slope(&self, spans: [usize; 2], c: usize) -> f64 {
        let [outer, inner] = spans.map(|l| self.chord(l, c));
        let [h, next] = spans.map(|l| self.step(l));
        outer + (outer - inner) * h / (h + next)
    }

    fn solve_periodic(&mut self) {
        let (count, dim) = (self.parameters.len() - 1, self.dim);
        let before = |l: usize| (l + count - 1) % count;
        let mut slopes = memory::filled(0.0, count * dim);
        for l in 0..count {
            for c in 0..dim {
                let (earlier, later) = (self.step(before(l)), self.step(l));
                slopes[l * dim + c] = 3.0 * (earlier * self.chord(l, c) + later * self.chord(before(l), c));
            }
        }
        if count > 1 {
            let steps: Vec<f64> = (0..count).map(|l| self.step(l)).collect_vec();
            let earlier: Vec<f64> = (0..count).map(|l| steps[before(l)]).collect_vec();
            let diagonal = steps.iter().zip(&earlier).map(|(h, e)| 2.0 * (h + e)).collect();
            Tridiagonal::cyclic(steps, diagonal, earlier).solve(&mut slopes, dim);
        } else {
            slopes.fill(0.0); // a closed curve through one point
        }
        slopes.extend_from_within(..dim);
        self.slopes = slopes;
    }

    /// Values at rising parameters; beyond the ends the outer cubics are continued.
    pub fn eval_rising(&self, u: &[f64], out: &mut [f64]) {
        // the common dimension as a constant unrolls the loops
        match self.dim {
            3 => self.eval_rising_in(3, u, out),
            dim => self.eval_rising_in(dim, u, out),
        }
    }

    #[inline(always)]
    fn eval_rising_in(&self, dim: usize, u: &[f64], out: &mut [f64]) {
        let mut piece = self.piece(0);
        for (&u, out) in u.iter().zip(out.chunks_exact_mut(dim)) {
            piece = self.advance(piece, u);
            let [a, b, c, d] = piece.weights(u, shape_functions);
            for k in 0..dim {
                out[k] = a * piece.points[k]
                    + b * piece.points[dim + k]
                    + c * piece.slopes[k]
                    + d * piece.slopes[dim + k];
            }
        }
    }

    /// First derivatives at rising parameters.
    pub fn slopes_rising(&self, u: &[f64], out: &mut [f64]) {
        let (dim, mut piece) = (self.dim, self.piece(0));
        for (&u, out) in u.iter().zip(out.chunks_exact_mut(dim)) {
            piece = self.advance(piece, u);
            let [a, b, c, d] = piece.weights(u, shape_slopes);
            for k in 0..dim {
                let sum = a * piece.points[k]
                    + b * piece.points[dim + k]
                    + c * piece.slopes[k]
                    + d * piece.slopes[dim + k];
                out[k] = sum / piece.length;
            }
        }
    }

    /// Squared distances between the curve at rising parameters and rows of `values`.
    pub fn distances_sq(&self, u: &[f64], values: &[f64], out: &mut [f64]) {
        match self.dim {
            3 => self.distances_sq_in(3, u, values, out),
            dim => self.distances_sq_in(dim, u, values, out),
        }
    }

    #[inline(always)]
    fn distances_sq_in(&self, dim: usize, u: &[f64], values: &[f64], out: &mut [f64]) {
        let mut piece = self.piece(0);
        for ((&u, value), out) in u.iter().zip(values.chunks_exact(dim)).zip(out) {
            piece = self.advance(piece, u);
            let [a, b, c, d] = piece.weights(u, shape_functions);
            *out = 0.0;
            for k in 0..dim {
                let at = a * piece.points[k]
                    + b * piece.points[dim + k]
                    + c * piece.slopes[k]
                    + d * piece.slopes[dim + k];
                *out += (at - value[k]) * (at - value[k]);
            }
        }
    }

    /// The piece over span `l`.
    #[inline(always)]
    fn piece(&self, l: usize) -> Piece<'_> {
        let length = self.step(l);
        let is_last = l + 2 == self.parameters.len();
        Piece {
            index: l,
            begin: self.parameters[l],
            end: if is_last { f64::INFINITY } else { self.parameters[l + 1] },
            length,
            inverse: 1.0 / length,
            points: &self.points[l * self.dim..(l + 2) * self.dim],
            slopes: &self.slopes[l * self.dim..(l + 2) * self.dim],
        }
    }

    /// The piece of `u`, which does not lie before `piece`.
    #[inline(always)]
    fn advance<'a>(&'a self, mut piece: Piece<'a>, u: f64) -> Piece<'a> {
        while piece.end <= u {
            piece = self.piece(piece.index + 1);
        }
        piece
    }

    /// The Bernstein ordinates of the piece over span `l` and their parameters' step: four rows of `dim` numbers.
    pub fn ordinates(&self, l: usize) -> Vec<f64> {
        let (dim, third) = (self.dim, self.step(l) / 3.0);
        let part = |of: &[f64], l: usize| of[l * dim..(l + 1) * dim].to_vec();
        let moved = |l: usize, by: f64| {
            let slopes = part(&self.slopes, l);
            part(&self.points, l).iter().zip(slopes).map(|(p, d)| p + by * d).collect()
        };
        [part(&self.points, l), moved(l, third), moved(l + 1, -third), part(&self.points, l + 1)].concat()
    }

    /// The same curve by knots and control points. Slopes that are not those of a C2 curve are not kept.
    pub fn to_curve(&self) -> Result<Curve, CurveError> {
        let (last, dim) = (self.parameters.len() - 1, self.dim);
        let mut control_points = memory::with_capacity((last + 3) * dim);
        let (first, end) = (self.ordinates(0), self.ordinates(last - 1));
        control_points.extend_from_slice(&first[..2 * dim]);
        for l in 1..last {
            let (before, h) = (self.step(l - 1), self.step(l));
            for c in 0..dim {
                let (d, next) = (self.slopes[l * dim + c], self.slopes[(l + 1) * dim + c]);
                let f = (3.0 * self.chord(l, c) - 2.0 * d - next) / h;
                control_points.push(self.points[l * dim + c] + d * (h - before) / 3.0 - f * h * before / 3.0);
            }
        }
        control_points.extend_from_slice(&end[2 * dim..]);
        Curve::new(dim, KnotVector::clamped(&self.parameters, 3)?, control_points)
    }
}

/// One Hermite cubic.
struct Piece<'a> {
    index: usize,
    begin: f64,
    /// Where the next one begins; infinity for the last.
    end: f64,
    length: f64,
    inverse: f64,
    /// At both ends.
    points: &'a [f64],
    slopes: &'a [f64],
}

impl Piece<'_> {
    /// What the two points and the two slopes are weighted with.
    #[inline(always)]
    fn weights(&self, u: f64, shape: impl Fn(f64) -> [f64; 4]) -> [f64; 4] {
        let [a, b, c, d] = shape((u - self.begin) * self.inverse);
        [a, b, self.length * c, self.length * d]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::Random;

    fn through(parameters: &[f64], points: &[f64], ends: EndRule) -> Interpolant {
        Interpolant::new(1, parameters.to_vec(), points.to_vec(), ends).unwrap()
    }

    #[test]
    fn parabolic_ends_have_the_slopes_worked_out_by_hand() {
        let curve = through(&[0.0, 0.25, 1.0], &[0.0, 0.0625, 1.0], EndRule::Parabolic);
        // every number is a small fraction of a power of two, but for one division by three
        let [begin, end] = curve.end_slopes();
        assert!(begin[0].abs() <= f64::EPSILON && (end[0] - 2.0).abs() <= 2.0 * f64::EPSILON);
        let mut values = [0.0; 3];
        curve.eval_rising(&[0.1, 0.5, 0.9], &mut values);
        for (value, u) in values.iter().zip([0.1, 0.5, 0.9]) {
            assert!((value - u * u).abs() <= 8.0 * f64::EPSILON, "three points are one parabola");
        }
    }

    #[test]
    fn natural_ends_have_the_control_points_worked_out_by_hand() {
        let curve = through(&[0.0, 0.5, 1.0], &[0.0, 1.0, 0.0], EndRule::Natural).to_curve().unwrap();
        for (x, exact) in curve.control_points().iter().zip([0.0, 0.5, 1.5, 0.5, 0.0]) {
            assert!((x - exact).abs() <= 8.0 * f64::EPSILON, "{:?}", curve.control_points());
        }
    }

    /// Parameters of wildly different steps, and points of size one.
    fn ugly(count: usize, seed: u64) -> (Vec<f64>, Vec<f64>) {
        let mut random = Random::new(seed);
        let mut u = 0.0;
        let parameters: Vec<f64> = (0..count)
            .map(|_| {
                u += 1e-3 + random.unit().powi(6);
                u
            })
            .collect();
        let points = (0..2 * count).map(|_| random.signed()).collect();
        (parameters, points)
    }

    #[test]
    fn both_forms_are_one_c2_curve_through_the_points() {
        for ends in [EndRule::Parabolic, EndRule::Natural, EndRule::Periodic] {
            for (count, seed) in [(2, 1), (3, 2), (4, 3), (40, 4)] {
                let (parameters, mut points) = ugly(count, seed);
                if ends == EndRule::Periodic {
                    points.copy_within(..2, 2 * count - 2);
                }
                let hermite = Interpolant::new(2, parameters.clone(), points.clone(), ends).unwrap();
                let curve = hermite.to_curve().unwrap();
                let size = curve.control_points().iter().fold(1.0, |most: f64, x| most.max(x.abs()));
                let tol = 64.0 * f64::EPSILON * size;
                let middles: Vec<f64> = parameters.windows(2).map(|p| p[0] + 0.4 * (p[1] - p[0])).collect();
                for places in [&parameters, &middles] {
                    let mut values = vec![0.0; 2 * places.len()];
                    hermite.eval_rising(places, &mut values);
                    for (u, value) in places.iter().zip(values.chunks(2)) {
                        let other = curve.eval(*u);
                        assert!((0..2).all(|c| (value[c] - other[c]).abs() <= tol), "{ends:?} {count}");
                    }
                }
                let mut ends_of = [0.0; 12];
                curve.eval_rows(&[parameters[0], parameters[count - 1]], 2, &mut ends_of);
                for c in 4..6 {
                    let (begin, end) = (ends_of[c], ends_of[6 + c]);
                    // second differences over steps of 1e-3
                    let tol = 1e8 * tol;
                    match ends {
                        EndRule::Natural => assert!(begin.abs() <= tol && end.abs() <= tol, "{count}"),
                        EndRule::Periodic if count > 2 => assert!((begin - end).abs() <= tol, "{count}"),
                        _ => {}
                    }
                }
            }
        }
    }

    #[test]
    fn given_slopes_reproduce_a_cubic() {
        let cubic = |u: f64| u * u * (u - 2.0);
        let slope = |u: f64| 3.0 * u * u - 4.0 * u;
        let parameters = [0.0, 0.1, 0.5, 0.51, 2.0];
        let points = parameters.map(cubic);
        let curve =
            through(&parameters, &points, EndRule::Slopes { begin: &[slope(0.0)], end: &[slope(2.0)] });
        let mut values = [0.0; 2];
        curve.eval_rising(&[0.3, 1.7], &mut values);
        for (value, u) in values.iter().zip([0.3, 1.7]) {
            assert!((value - cubic(u)).abs() <= 64.0 * f64::EPSILON);
        }
    }

    #[test]
    fn equal_parameters_are_refused() {
        let refused = Interpolant::new(1, vec![0.0, 1.0, 1.0], vec![0.0; 3], EndRule::Natural);
        assert_eq!(refused.unwrap_err(), CurveError::NotRising { index: 2 });
    }

    #[test]
    fn curves_pass_through_their_points_and_refuse_what_is_none() {
        let u = [0.0, 0.5, 2.0, 3.0, 3.25];
        let points = [0.0, 1.0, 2.0, -1.0, 3.0, 0.5, 1.0, 4.0, 0.0, 1.0];
        let slopes = EndRule::Slopes { begin: &[1.0, 0.0], end: &[0.0, -2.0] };
        for ends in [EndRule::Parabolic, EndRule::Natural, EndRule::Periodic, slopes] {
            let curve = interpolate(2, &u, &points, ends).unwrap();
            for (u, point) in u.iter().zip(points.chunks(2)) {
                let value = curve.eval(*u);
                // sums of four products of numbers below 20
                assert!((value[0] - point[0]).abs() + (value[1] - point[1]).abs() <= 1e3 * f64::EPSILON);
            }
        }
        let refused = |u: &[f64], points: &[f64], ends| interpolate(2, u, points, ends).unwrap_err();
        let natural = EndRule::Natural;
        assert_eq!(refused(&u[..1], &points[..2], natural), CurveError::TooFew { count: 1 });
        let short = CurveError::ControlPointCount { count: 8, expected: 5, dim: 2 };
        assert_eq!(refused(&u, &points[..8], natural), short);
        assert_eq!(refused(&u[..4], &points[..8], EndRule::Periodic), CurveError::NotClosed);
        let bad = EndRule::Slopes { begin: &[f64::NAN, 0.0], end: &[0.0; 2] };
        assert_eq!(refused(&u, &points, bad), CurveError::SlopesNotFinite);
        let short = EndRule::Slopes { begin: &[0.0], end: &[0.0; 2] };
        assert_eq!(refused(&u, &points, short), CurveError::SlopeCount { count: 3, expected: 4 });
        let infinite = [0.0, 0.5, 2.0, 3.0, f64::INFINITY];
        assert_eq!(refused(&infinite, &points, natural), CurveError::ParameterNotFinite { index: 4 });
        let mut ugly = points;
        ugly[5] = f64::NAN;
        assert_eq!(refused(&u, &ugly, natural), CurveError::PointNotFinite { index: 2 });
    }
}
