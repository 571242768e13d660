//! Gradients in space of fields over the parameters of a shape.

use crate::control::Pool;
use crate::failure::{Classify, ErrorKind};
use crate::memory;
use crate::surface::{Surface, surface_gradient};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// Gradients cannot be computed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum GradientError {
    /// Only a shape in space has a metric to take gradients with.
    #[error("the shape is of dimension {dim}, dimension 3 is needed")]
    Dimension {
        /// Dimension of the surface given as shape.
        dim: usize,
    },
    /// A parameter is NaN or infinite.
    #[error("the parameters of point {index} are not finite")]
    NotFinite {
        /// The point.
        index: usize,
    },
    /// A point lies outside the domain of the shape or of the field.
    #[error("point {index} at ({u}, {v}) lies outside the domain of the {what}")]
    Outside {
        /// The point.
        index: usize,
        /// Its u.
        u: f64,
        /// Its v.
        v: f64,
        /// Which of the two.
        what: &'static str,
    },
}

impl GradientError {
    /// The same of a point with another number.
    pub(crate) fn at(self, number: impl Fn(usize) -> usize) -> Self {
        match self {
            Self::NotFinite { index } => Self::NotFinite { index: number(index) },
            Self::Outside { index, u, v, what } => Self::Outside { index: number(index), u, v, what },
            other => other,
        }
    }
}

impl Classify for GradientError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::Dimension { .. } => ErrorKind::InvalidArgument,
            Self::NotFinite { .. } => ErrorKind::NotFinite,
            Self::Outside { .. } => ErrorKind::Outside,
        }
    }

    /// The offending point.
    fn index(&self) -> Option<usize> {
        match *self {
            Self::NotFinite { index } | Self::Outside { index, .. } => Some(index),
            Self::Dimension { .. } => None,
        }
    }
}

/// Points of one piece of work. Pieces do not depend on the number of threads.
const CHUNK: usize = 1024;

/// The pieces of work that so many places are: no more threads are of use.
pub fn piece_count(count: usize) -> usize {
    count.div_ceil(CHUNK)
}

/// The gradients of each component of a field, as vectors in space tangential to the shape: for each of `uv` as many
/// rows of three numbers as the field has components. NaN where the shape has no tangent plane.
pub fn field_gradient(
    shape: &dyn Surface,
    field: &dyn Surface,
    uv: &[DVec2],
    out: &mut [f64],
    pool: &Pool,
) -> Result<(), GradientError> {
    if shape.dim() != 3 {
        return Err(GradientError::Dimension { dim: shape.dim() });
    }
    check(shape, field, uv)?;
    let dim = field.dim();
    assert_eq!(out.len(), 3 * dim * uv.len(), "three numbers for each component of each point");
    let piece = |(uv, out): (&[DVec2], &mut [f64])| {
        let (mut places, mut values) =
            (memory::filled(0.0, 9 * uv.len()), memory::filled(0.0, 3 * dim * uv.len()));
        shape.eval_rows(uv, 1, &mut places);
        field.eval_rows(uv, 1, &mut values);
        let rows = places.chunks_exact(9).zip(values.chunks_exact(3 * dim));
        for ((place, value), out) in rows.zip(out.chunks_exact_mut(3 * dim)) {
            let (su, sv) = (DVec3::from_slice(&place[3..]), DVec3::from_slice(&place[6..]));
            for (k, out) in out.chunks_exact_mut(3).enumerate() {
                let gradient = surface_gradient(su, sv, value[dim + k], value[2 * dim + k]);
                out.copy_from_slice(&gradient.to_array());
            }
        }
    };
    if pool.thread_count() == 1 || uv.len() <= CHUNK {
        uv.chunks(CHUNK).zip(out.chunks_mut(3 * dim * CHUNK)).for_each(piece);
    } else {
        pool.run(|| uv.par_chunks(CHUNK).zip(out.par_chunks_mut(3 * dim * CHUNK)).for_each(piece));
    }
    Ok(())
}

fn check(shape: &dyn Surface, field: &dyn Surface, uv: &[DVec2]) -> Result<(), GradientError> {
    if let Some(index) = uv.iter().position(|uv| !uv.is_finite()) {
        return Err(GradientError::NotFinite { index });
    }
    for (surface, what) in [(shape, "shape"), (field, "field")] {
        let domain = surface.domain();
        if let Some(index) = uv.iter().position(|&uv| !domain.contains(uv)) {
            let DVec2 { x: u, y: v } = uv[index];
            return Err(GradientError::Outside { index, u, v, what });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::knots::KnotVector;
    use crate::samples::Random;
    use crate::surface::tensor::TensorSurface;

    const HALF: f64 = std::f64::consts::FRAC_1_SQRT_2;
    /// The rational quadratic arc from (1, 0) to (0, 1): x, y, weight.
    const ARC: [[f64; 3]; 3] = [[1.0, 0.0, 1.0], [1.0, 1.0, HALF], [0.0, 1.0, 1.0]];

    fn surface(dim: usize, points: Vec<f64>, weights: Vec<f64>) -> TensorSurface {
        let knots = || KnotVector::clamped(&[0.0, 1.0], 2).unwrap();
        TensorSurface::new(dim, knots(), knots(), points, Some(weights)).unwrap()
    }

    /// An octant of the unit sphere, or a quarter of a cylinder of radius 2 and height 3, both exact.
    fn shape(is_sphere: bool) -> TensorSurface {
        let (mut points, mut weights) = (Vec::new(), Vec::new());
        for [x, y, w] in ARC {
            for (j, [r, z, wv]) in ARC.into_iter().enumerate() {
                let (point, weight) = match is_sphere {
                    true => ([r * x, r * y, z], w * wv),
                    false => ([2.0 * x, 2.0 * y, 1.5 * j as f64], w),
                };
                points.extend(point);
                weights.push(weight);
            }
        }
        surface(3, points, weights)
    }

    #[test]
    fn gradients_on_a_sphere_and_a_cylinder_are_those_of_calculus() {
        // the field g.x in space, exact over the same parameters; the surface sees the tangential part of g
        let g = DVec3::new(0.3, -0.7, 0.9);
        let pool = Pool::new(2);
        let mut random = Random::new(6);
        // away from the pole of the octant, where u has no direction
        let uv: Vec<DVec2> = (0..3000).map(|_| DVec2::new(random.unit(), 0.9 * random.unit())).collect();
        for is_sphere in [true, false] {
            let shape = shape(is_sphere);
            let heights =
                shape.control_points().chunks_exact(3).map(|p| DVec3::from_slice(p).dot(g)).collect();
            let field = surface(1, heights, shape.weights().unwrap().to_vec());
            let mut out = vec![0.0; 3 * uv.len()];
            field_gradient(&shape, &field, &uv, &mut out, &pool).unwrap();
            let mut places = vec![0.0; 3 * uv.len()];
            shape.eval_rows(&uv, 0, &mut places);
            for (gradient, place) in out.chunks_exact(3).zip(places.chunks_exact(3)) {
                let p = DVec3::from_slice(place);
                let n = if is_sphere { p } else { DVec3::new(p.x, p.y, 0.0) / 2.0 };
                let exact = g - g.dot(n) * n;
                // some two hundred operations; tangents shrink to a seventh towards the pole
                let tol = 1e4 * f64::EPSILON;
                assert!((DVec3::from_slice(gradient) - exact).length() <= tol, "{gradient:?} is not {exact}");
            }
        }
    }

    #[test]
    fn refusals_name_the_point() {
        let shape = shape(true);
        let pool = Pool::new(1);
        let mut out = [0.0; 9];
        let mut refuse = |shape: &TensorSurface, uv| {
            field_gradient(shape, shape, &[DVec2::splat(0.5), uv, uv], &mut out, &pool).unwrap_err()
        };
        assert_eq!(refuse(&shape, DVec2::NAN), GradientError::NotFinite { index: 1 });
        let outside = GradientError::Outside { index: 1, u: 2.0, v: 0.5, what: "shape" };
        assert_eq!(refuse(&shape, DVec2::new(2.0, 0.5)), outside);
        let scalar = surface(1, vec![1.0; 9], vec![1.0; 9]);
        assert_eq!(refuse(&scalar, DVec2::splat(0.5)), GradientError::Dimension { dim: 1 });
    }
}
