//! B-spline curves in any dimension.

mod interpolate;
mod length;
mod refine;

pub use interpolate::{EndRule, Interpolant, interpolate};
pub use refine::{KNOT_TOLERANCE, common_breaks, common_knots, on_common_knots};

use crate::basis::basis_derivatives;
use crate::failure::{Classify, ErrorKind};
use crate::knots::{KnotError, KnotVector};
use crate::memory;

/// A curve is not one.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CurveError {
    /// Values need at least one component.
    #[error("the dimension is 0")]
    Dimension,
    /// There are not as many control points as basis functions.
    #[error("{count} numbers are given for {expected} control points of dimension {dim}")]
    ControlPointCount {
        /// Numbers given.
        count: usize,
        /// Control points that the knots ask for.
        expected: usize,
        /// Numbers a control point.
        dim: usize,
    },
    /// A coordinate is NaN or infinite.
    #[error("control point {index} is not finite")]
    NotFinite {
        /// The control point.
        index: usize,
    },
    /// A parameter is NaN or infinite.
    #[error("the parameter of point {index} is not finite")]
    ParameterNotFinite {
        /// The point.
        index: usize,
    },
    /// A point lies outside the domain.
    #[error("point {index} at {u} lies outside the domain")]
    Outside {
        /// The point.
        index: usize,
        /// Its parameter.
        u: f64,
    },
    /// The parameters of points to interpolate must rise.
    #[error("parameter {index} is not above the one before it")]
    NotRising {
        /// The point.
        index: usize,
    },
    /// Too few points to interpolate.
    #[error("{count} points are too few to interpolate, at least 2 are needed")]
    TooFew {
        /// Points given.
        count: usize,
    },
    /// A coordinate of a point to interpolate is NaN or infinite.
    #[error("point {index} is not finite")]
    PointNotFinite {
        /// The point.
        index: usize,
    },
    /// The slopes at the ends are not rows of the curve's dimension.
    #[error("{count} numbers are given for the slopes at both ends, {expected} are needed")]
    SlopeCount {
        /// Numbers given.
        count: usize,
        /// Numbers needed.
        expected: usize,
    },
    /// A slope at an end is NaN or infinite.
    #[error("the slopes at the ends are not finite")]
    SlopesNotFinite,
    /// A periodic curve ends where it begins.
    #[error("the last point is not the first one, so the curve cannot be periodic: repeat the first point")]
    NotClosed,
    /// The knots are none.
    #[error(transparent)]
    Knots(#[from] KnotError),
}

impl Classify for CurveError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::NotFinite { .. }
            | Self::ParameterNotFinite { .. }
            | Self::PointNotFinite { .. }
            | Self::SlopesNotFinite => ErrorKind::NotFinite,
            Self::Outside { .. } => ErrorKind::Outside,
            Self::NotRising { .. } => ErrorKind::Degenerate,
            Self::Knots(error) => error.kind(),
            _ => ErrorKind::InvalidArgument,
        }
    }

    /// The offending control point, or point to evaluate.
    fn index(&self) -> Option<usize> {
        match *self {
            Self::NotFinite { index }
            | Self::ParameterNotFinite { index }
            | Self::PointNotFinite { index }
            | Self::Outside { index, .. }
            | Self::NotRising { index } => Some(index),
            Self::Knots(ref error) => error.index(),
            _ => None,
        }
    }
}

/// A B-spline curve `C(u) = sum_i N_i(u) P_i`.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    dim: usize,
    knots: KnotVector,
    control_points: Vec<f64>,
}

/// Highest derivative that [`Curve::eval_rows`] computes.
pub const MAX_DERIVATIVE: usize = 3;

impl Curve {
    /// Checks and keeps the parts; `control_points` are rows of `dim` numbers.
    pub fn new(dim: usize, knots: KnotVector, control_points: Vec<f64>) -> Result<Self, CurveError> {
        let expected = knots.basis_count();
        if dim == 0 {
            return Err(CurveError::Dimension);
        }
        if control_points.len() != expected * dim {
            return Err(CurveError::ControlPointCount { count: control_points.len(), expected, dim });
        }
        match control_points.iter().position(|x| !x.is_finite()) {
            Some(index) => Err(CurveError::NotFinite { index: index / dim }),
            None => Ok(Self { dim, knots, control_points }),
        }
    }

    /// Another curve over the same knots.
    pub(crate) fn with_control_points(&self, control_points: Vec<f64>) -> Self {
        debug_assert_eq!(control_points.len(), self.control_points.len());
        Self { control_points, ..self.clone() }
    }

    /// Components of a value.
    pub fn dim(&self) -> usize {
        self.dim
    }

    /// The knot vector.
    pub fn knots(&self) -> &KnotVector {
        &self.knots
    }

    /// The control points, rows of `dim` numbers.
    pub fn control_points(&self) -> &[f64] {
        &self.control_points
    }

    /// Whether a parameter lies in the domain; false for NaN.
    pub fn contains(&self, u: f64) -> bool {
        let (from, to) = self.knots.domain();
        from <= u && u <= to
    }

    /// Refuses parameters outside the domain.
    pub fn check_inside(&self, u: &[f64]) -> Result<(), CurveError> {
        match u.iter().position(|&u| !self.contains(u)) {
            None => Ok(()),
            Some(index) if !u[index].is_finite() => Err(CurveError::ParameterNotFinite { index }),
            Some(index) => Err(CurveError::Outside { index, u: u[index] }),
        }
    }

    /// Refuses parameters at which nothing can be continued.
    pub fn check_finite(u: &[f64]) -> Result<(), CurveError> {
        match u.iter().position(|u| !u.is_finite()) {
            None => Ok(()),
            Some(index) => Err(CurveError::ParameterNotFinite { index }),
        }
    }

    /// Values and derivatives up to `max_derivative` (at most [`MAX_DERIVATIVE`]) at each of `u`: for each
    /// the rows C, C', C'', ... of `dim` numbers. Beyond the domain the end polynomials are continued.
    pub fn eval_rows(&self, u: &[f64], max_derivative: usize, out: &mut [f64]) {
        let (degree, dim) = (self.knots.degree(), self.dim);
        for (&u, out) in u.iter().zip(out.chunks_exact_mut((max_derivative + 1) * dim)) {
            let span = self.knots.span(u);
            let points = &self.control_points[(span - degree) * dim..(span + 1) * dim];
            let basis = basis_derivatives(&self.knots, span, u, max_derivative);
            for (row, basis) in out.chunks_exact_mut(dim).zip(&basis) {
                row.fill(0.0);
                for (point, n) in points.chunks_exact(dim).zip(basis) {
                    row.iter_mut().zip(point).for_each(|(sum, x)| *sum += n * x);
                }
            }
        }
    }

    /// The value at one parameter.
    pub fn eval(&self, u: f64) -> Vec<f64> {
        let mut value = memory::filled(0.0, self.dim);
        self.eval_rows(&[u], 0, &mut value);
        value
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn greville_coefficients_give_the_parameter() {
        let knots = KnotVector::clamped(&[0.0, 0.5, 2.0, 2.5], 3).unwrap();
        let points: Vec<f64> = (0..knots.basis_count()).map(|i| knots.greville(i)).collect();
        let curve = Curve::new(1, knots, points).unwrap();
        for u in [-1.0, 0.0, 0.7, 2.5, 3.0] {
            let mut out = [0.0; 4];
            curve.eval_rows(&[u], 3, &mut out);
            for (measured, exact) in out.iter().zip([u, 1.0, 0.0, 0.0]) {
                // third differences over a span of 0.5 magnify roundings by 1/0.5^3 and factorials
                assert!((measured - exact).abs() <= 1024.0 * f64::EPSILON, "{out:?} at {u}");
            }
        }
    }
}
