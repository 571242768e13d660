//! Section curves, and sums of them.

use super::loft::Combination;
use crate::curve::{Curve, CurveError, Interpolant};
use crate::knots::KnotVector;
use crate::memory::{self, CollectVec};

/// A curve over [0, 1] that a row is replaced by.
#[derive(Debug, Clone)]
pub(super) enum Section {
    /// A cubic with continuous slopes.
    Cubic(Interpolant),
    /// Any other curve.
    Other { curve: Curve, breaks: Vec<f64> },
}

impl Section {
    /// A curve over whatever domain, moved to [0, 1].
    pub(super) fn of_curve(curve: &Curve) -> Result<Self, CurveError> {
        let (from, to) = curve.knots().domain();
        let (degree, dim) = (curve.knots().degree(), curve.dim());
        let moved = curve.knots().knots().iter().map(|t| (t - from) / (to - from)).collect_vec();
        let knots = KnotVector::new(moved, degree)?;
        let breaks = knots.breaks();
        let is_smooth = breaks[1..breaks.len() - 1].iter().all(|&t| knots.multiplicity(t) < degree);
        let curve = Curve::new(dim, knots, memory::copied(curve.control_points()))?;
        if degree > 3 || !is_smooth {
            return Ok(Self::Other { curve, breaks });
        }
        let mut rows = memory::filled(0.0, 2 * dim * breaks.len());
        curve.eval_rows(&breaks, 1, &mut rows);
        let part = |k: usize| {
            rows.chunks(2 * dim).flat_map(|row| &row[k * dim..(k + 1) * dim]).copied().collect_vec()
        };
        Ok(Self::Cubic(Interpolant::with_slopes(dim, breaks, part(0), part(1))?))
    }

    /// Where its pieces meet; for a row these are the data.
    pub(super) fn breaks(&self) -> &[f64] {
        match self {
            Self::Cubic(cubic) => cubic.parameters(),
            Self::Other { breaks, .. } => breaks,
        }
    }

    /// Components of a value.
    pub(super) fn dim(&self) -> usize {
        match self {
            Self::Cubic(cubic) => cubic.dim(),
            Self::Other { curve, .. } => curve.dim(),
        }
    }

    /// Values at rising parameters.
    pub(super) fn eval_rising(&self, u: &[f64], out: &mut [f64]) {
        match self {
            Self::Cubic(cubic) => cubic.eval_rising(u, out),
            Self::Other { curve, .. } => curve.eval_rows(u, 0, out),
        }
    }

    /// First derivatives at rising parameters.
    pub(super) fn slopes_rising(&self, u: &[f64], out: &mut [f64]) {
        match self {
            Self::Cubic(cubic) => cubic.slopes_rising(u, out),
            Self::Other { curve, .. } => {
                let dim = curve.dim();
                let mut rows = memory::filled(0.0, 2 * dim * u.len());
                curve.eval_rows(u, 1, &mut rows);
                rows.chunks(2 * dim)
                    .zip(out.chunks_mut(dim))
                    .for_each(|(row, out)| out.copy_from_slice(&row[dim..]));
            }
        }
    }
}

/// The rows' sections, after them the tangents across the end rows.
#[derive(Debug)]
pub(super) struct Sources {
    pub sections: Vec<Section>,
    pub row_count: usize,
    pub dim: usize,
}

impl Sources {
    pub(super) fn rows(&self) -> &[Section] {
        &self.sections[..self.row_count]
    }

    /// Values of several sums at rising parameters. Each source is evaluated once.
    pub(super) fn combine(&self, sums: &[&Combination], u: &[f64]) -> Vec<Vec<f64>> {
        self.combine_by(sums, u, Section::eval_rising)
    }

    /// First derivatives of a sum at rising parameters.
    pub(super) fn slopes(&self, sum: &Combination, u: &[f64]) -> Vec<f64> {
        self.combine_by(&[sum], u, Section::slopes_rising).swap_remove(0)
    }

    fn combine_by(
        &self,
        sums: &[&Combination],
        u: &[f64],
        eval: impl Fn(&Section, &[f64], &mut [f64]),
    ) -> Vec<Vec<f64>> {
        let len = u.len() * self.dim;
        let mut results = memory::filled(memory::filled(0.0, len), sums.len());
        let mut next = memory::filled(0, sums.len());
        let mut values = memory::filled(0.0, len);
        for (source, section) in self.sections.iter().enumerate() {
            let mut is_evaluated = false;
            for ((sum, next), result) in sums.iter().zip(&mut next).zip(&mut results) {
                let Some(&(_, weight)) = sum.get(*next).filter(|term| term.0 == source) else { continue };
                if !is_evaluated {
                    eval(section, u, &mut values);
                    is_evaluated = true;
                }
                *next += 1;
                result.iter_mut().zip(&values).for_each(|(sum, x)| *sum += weight * x);
            }
        }
        results
    }
}
