//! Linear combinations of tensor surfaces: a shape and its displacements, modes and their factors.
//!
//! Splines over one domain are a vector space once they are written over common knots: degrees are raised and knots
//! inserted until all nets agree, then control points are added.

use super::{Axis, TensorError, TensorSurface};
use crate::failure::{Classify, ErrorKind};
use crate::knots::KnotVector;
use crate::memory::CollectVec;
use crate::surface::Surface;

/// Surfaces cannot be added.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CombineError {
    /// There is nothing to add.
    #[error("no surfaces are given")]
    Nothing,
    /// A factor is NaN or infinite.
    #[error("factor {index} is not finite")]
    NotFinite {
        /// Its surface.
        index: usize,
    },
    /// Values of different length have no sum.
    #[error("surface {index} is of dimension {dim}, the first is of dimension {expected}")]
    Dimension {
        /// The surface.
        index: usize,
        /// Its dimension.
        dim: usize,
        /// The dimension of the first.
        expected: usize,
    },
    /// The surfaces are not over the same parameters.
    #[error("surface {index} has another domain than the first")]
    Domain {
        /// The surface.
        index: usize,
    },
    /// The sum of rational surfaces is of a higher degree.
    #[error("surface {index} has weights")]
    Weights {
        /// The surface.
        index: usize,
    },
    /// The sum has no net: its degree, knots or numbers are out of range.
    #[error("surface {index}: {error}")]
    Tensor {
        /// The surface.
        index: usize,
        /// What is wrong.
        error: TensorError,
    },
}

impl Classify for CombineError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::NotFinite { .. } => ErrorKind::NotFinite,
            Self::Tensor { error, .. } => error.kind(),
            _ => ErrorKind::InvalidArgument,
        }
    }

    /// The offending surface or factor.
    fn index(&self) -> Option<usize> {
        match *self {
            Self::Nothing => None,
            Self::NotFinite { index }
            | Self::Dimension { index, .. }
            | Self::Domain { index }
            | Self::Weights { index }
            | Self::Tensor { index, .. } => Some(index),
        }
    }
}

impl TensorSurface {
    /// The surface `sum_k factor_k S_k`, exactly: over the knots of all. It has the region of the first.
    pub fn combine(terms: &[(f64, &Self)]) -> Result<Self, CombineError> {
        let Some(&(_, first)) = terms.first() else { return Err(CombineError::Nothing) };
        for (index, &(factor, surface)) in terms.iter().enumerate() {
            check_term(index, factor, surface, first)?;
        }
        let [u, v] = [Axis::U, Axis::V].map(|axis| Common::of(axis, terms));
        let mut sum: Option<Self> = None;
        let mut control_points = Vec::new();
        for (index, &(factor, surface)) in terms.iter().enumerate() {
            let refined = surface.onto(Axis::U, &u).and_then(|half| half.onto(Axis::V, &v));
            let refined = refined.map_err(|error| CombineError::Tensor { index, error })?;
            control_points.resize(refined.control_points().len(), 0.0);
            control_points.iter_mut().zip(refined.control_points()).for_each(|(sum, x)| *sum += factor * x);
            sum.get_or_insert(refined);
        }
        let mut sum = sum.ok_or(CombineError::Nothing)?;
        sum.set_control_points(&control_points).map_err(|error| CombineError::Tensor { index: 0, error })?;
        *sum.region_mut() = first.region().clone();
        Ok(sum)
    }

    /// The same surface, clamped, with the degree and inner knots of `common`.
    fn onto(&self, axis: Axis, common: &Common) -> Result<Self, TensorError> {
        let raised = self.restrict(self.domain())?.elevate_degree(axis, common.degree)?;
        raised.insert_knots(axis, &common.missing(raised.knots(axis)))
    }
}

fn check_term(
    index: usize,
    factor: f64,
    surface: &TensorSurface,
    first: &TensorSurface,
) -> Result<(), CombineError> {
    let (dim, expected) = (surface.dim(), first.dim());
    if !factor.is_finite() {
        return Err(CombineError::NotFinite { index });
    }
    if dim != expected {
        return Err(CombineError::Dimension { index, dim, expected });
    }
    if surface.domain() != first.domain() {
        return Err(CombineError::Domain { index });
    }
    if surface.weights().is_some() {
        return Err(CombineError::Weights { index });
    }
    Ok(())
}

/// A degree, and inner knots with how often they occur, in order.
struct Common {
    degree: usize,
    inner: Vec<(f64, usize)>,
}

impl Common {
    /// The highest degree, and each knot as often as the surface that is least smooth there needs it.
    fn of(axis: Axis, terms: &[(f64, &TensorSurface)]) -> Self {
        let degree = terms.iter().map(|(_, surface)| surface.knots(axis).degree()).max().unwrap_or(1);
        let mut inner: Vec<(f64, usize)> = terms
            .iter()
            .flat_map(|(_, surface)| {
                let knots = surface.knots(axis);
                let ((start, end), raised) = (knots.domain(), degree - knots.degree());
                let runs = knots.knots().chunk_by(|a, b| a == b);
                let inside = runs.filter(move |run| start < run[0] && run[0] < end);
                inside.map(move |run| (run[0], run.len() + raised))
            })
            .collect_vec();
        inner.sort_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)));
        inner.dedup_by_key(|knot| knot.0);
        Self { degree, inner }
    }

    /// What has to be inserted so that `knots`, of the common degree, become the common ones.
    fn missing(&self, knots: &KnotVector) -> Vec<f64> {
        let lacks = |&(t, count): &(f64, usize)| std::iter::repeat_n(t, count - knots.multiplicity(t));
        self.inner.iter().flat_map(lacks).collect_vec()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::Random;
    use glam::DVec2;

    fn surface(degree: usize, breaks: &[f64], seed: u64) -> TensorSurface {
        let mut random = Random::new(seed);
        let knots = KnotVector::clamped(breaks, degree).unwrap();
        let count = knots.basis_count() * knots.basis_count();
        let points = (0..2 * count).map(|_| random.signed()).collect();
        TensorSurface::new(2, knots.clone(), knots, points, None).unwrap()
    }

    #[test]
    fn a_sum_is_the_sum_everywhere() {
        let terms = [
            (1.0, surface(3, &[0.0, 0.3, 0.5, 1.0], 1)),
            (-0.5, surface(2, &[0.0, 0.5, 0.5, 0.8, 1.0], 2)),
            (2.0, surface(5, &[0.0, 1.0], 3)),
        ];
        let borrowed = [0, 1, 2].map(|k: usize| (terms[k].0, &terms[k].1));
        let sum = TensorSurface::combine(&borrowed).unwrap();
        let mut random = Random::new(4);
        for _ in 0..200 {
            let uv = [DVec2::new(random.unit(), random.unit())];
            let mut exact = [0.0; 2];
            for (factor, surface) in &terms {
                let mut value = [0.0; 2];
                surface.eval_rows(&uv, 0, &mut value);
                exact.iter_mut().zip(value).for_each(|(sum, x)| *sum += factor * x);
            }
            let mut value = [0.0; 2];
            sum.eval_rows(&uv, 0, &mut value);
            // some hundred operations on numbers of at most 2
            let gap = value.iter().zip(exact).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(gap <= 500.0 * f64::EPSILON, "{gap} at {uv:?}");
        }
    }

    #[test]
    fn the_same_knots_add_control_points() {
        let (a, b) = (surface(3, &[0.0, 0.3, 1.0], 1), surface(3, &[0.0, 0.3, 1.0], 2));
        let sum = TensorSurface::combine(&[(1.0, &a), (0.25, &b)]).unwrap();
        for ((sum, a), b) in sum.control_points().iter().zip(a.control_points()).zip(b.control_points()) {
            assert_eq!(*sum, a + 0.25 * b);
        }
    }

    #[test]
    fn refusals_name_the_surface() {
        let (a, b) = (surface(3, &[0.0, 1.0], 1), surface(3, &[0.0, 2.0], 2));
        assert_eq!(TensorSurface::combine(&[]).unwrap_err(), CombineError::Nothing);
        let refuse = |factor, b| TensorSurface::combine(&[(1.0, &a), (factor, b)]).unwrap_err();
        assert_eq!(refuse(1.0, &b), CombineError::Domain { index: 1 });
        assert_eq!(refuse(f64::NAN, &a), CombineError::NotFinite { index: 1 });
        let (u, v) = (a.knots(Axis::U).clone(), a.knots(Axis::V).clone());
        let scalar = TensorSurface::new(1, u.clone(), v.clone(), vec![0.0; 16], None).unwrap();
        assert_eq!(refuse(1.0, &scalar), CombineError::Dimension { index: 1, dim: 1, expected: 2 });
        let rational = TensorSurface::new(2, u, v, vec![0.5; 32], Some(vec![1.0; 16])).unwrap();
        assert_eq!(refuse(1.0, &rational), CombineError::Weights { index: 1 });
    }
}
