//! What single data demand of a fit beside its tolerance: to be met exactly, or more or less closely than the others.

use super::error::FitError;
use super::errors::{DataErrors, summarize};
use super::report::{FitReport, Goal, Tolerance, ToleranceScale};
use super::{Outliers, Symmetry};
use crate::linalg::{Condition, Conditions};
use glam::DVec2;

/// Demands of single data. A datum is a node of the mesh, or a point.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Demands<'a> {
    /// Data that the surface passes through: by linear conditions on its coefficients, to 1e-12 of the diagonal of the
    /// data's box.
    pub fixed: &'a [u32],
    /// A tolerance for each datum in the scale of the fit's, instead of that; data weigh by the inverse of its square. An
    /// infinite one leaves the datum out: it is not fitted, and its error does not count.
    pub tolerances: Option<&'a [f64]>,
    /// Which data may be taken for gross errors, and left out.
    pub outliers: Outliers,
    /// Whether the shape of a mesh is to be its own mirror image.
    pub symmetry: Symmetry,
}

impl Demands<'_> {
    /// What `count` data can demand.
    pub(in crate::fit) fn check(&self, count: usize) -> Result<(), FitError> {
        self.outliers.check()?;
        self.symmetry.check()?;
        if let Some(&index) = self.fixed.iter().find(|&&datum| datum as usize >= count) {
            return Err(FitError::NoSuchDatum { index: index as usize, count });
        }
        let Some(tolerances) = self.tolerances else { return Ok(()) };
        if tolerances.len() != count {
            return Err(FitError::Count { what: "the tolerances", count: tolerances.len(), expected: count });
        }
        match tolerances.iter().position(|&tolerance| !(tolerance > 0.0)) {
            Some(index) => Err(FitError::DatumTolerance { index, tolerance: tolerances[index] }),
            None => Ok(()),
        }
    }
}

/// Demands of data, in the terms of a fit.
#[derive(Debug, Clone, Default)]
pub(in crate::fit) struct Standards {
    /// The tolerance of the fit by that of each datum; empty if all are 1. 0 for a datum that is left out.
    factors: Vec<f64>,
    /// The data that are fixed, each once.
    pub fixed: Vec<usize>,
    /// The tolerance of the fit.
    tolerance: f64,
}

/// Fixed data whose parameters differ by less than this share of the range have the same.
const SAME_PLACE: f64 = 1e-13;

/// Beyond it a tolerance makes no further difference to the weight of a datum: matrices stay well conditioned.
const MOST_FACTOR: f64 = 1e2;

impl Standards {
    /// `uv` and `values`, rows of `dim` numbers, are the data.
    pub(crate) fn new(
        demands: &Demands,
        asked: &Tolerance,
        goal: &Goal,
        uv: &[DVec2],
        (values, dim): (&[f64], usize),
    ) -> Result<Self, FitError> {
        let mut fixed: Vec<usize> = demands.fixed.iter().map(|&datum| datum as usize).collect();
        fixed.sort_unstable();
        fixed.dedup();
        let scale = match asked.scale {
            ToleranceScale::Relative => goal.diagonal,
            ToleranceScale::Absolute => 1.0,
        };
        let exact = Tolerance::SMALLEST * goal.diagonal;
        let factor =
            |tolerance: f64| if tolerance > 0.0 { goal.tolerance / tolerance.max(exact) } else { 1.0 };
        let mut factors = match demands.tolerances {
            Some(tolerances) => tolerances.iter().map(|&tolerance| factor(tolerance * scale)).collect(),
            None if fixed.is_empty() => Vec::new(),
            None => vec![1.0; uv.len()],
        };
        fixed.iter().for_each(|&datum| factors[datum] = factor(exact));
        let standards = Self { factors, fixed, tolerance: goal.tolerance };
        standards.check_places(uv, (values, dim), exact)?;
        Ok(standards)
    }

    /// Fixed data at one place have one value.
    fn check_places(&self, uv: &[DVec2], (values, dim): (&[f64], usize), exact: f64) -> Result<(), FitError> {
        let (min, max) = self
            .fixed
            .iter()
            .fold((DVec2::MAX, DVec2::MIN), |(min, max), &datum| (min.min(uv[datum]), max.max(uv[datum])));
        let near = SAME_PLACE * (max - min);
        let mut sorted = self.fixed.clone();
        sorted.sort_unstable_by(|&a, &b| uv[a].x.total_cmp(&uv[b].x).then(a.cmp(&b)));
        for (k, &first) in sorted.iter().enumerate() {
            let beside = sorted[k + 1..].iter().take_while(|&&second| uv[second].x - uv[first].x <= near.x);
            for &second in beside.filter(|&&second| (uv[second].y - uv[first].y).abs() <= near.y) {
                let row = |datum: usize| &values[datum * dim..][..dim];
                let pairs = row(first).iter().zip(row(second));
                let distance = pairs.map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
                if distance > exact {
                    let (first, second) = (first.min(second), first.max(second));
                    return Err(FitError::Contradiction { first, second, distance });
                }
            }
        }
        Ok(())
    }

    /// Whether all data demand alike.
    pub(crate) fn are_alike(&self) -> bool {
        self.factors.is_empty()
    }

    /// The tolerance of the fit by that of a datum.
    pub(crate) fn factor(&self, datum: usize) -> f64 {
        self.factors.get(datum).copied().unwrap_or(1.0)
    }

    /// Whether a datum is not to be fitted.
    pub(crate) fn is_left_out(&self, datum: usize) -> bool {
        self.factor(datum) == 0.0
    }

    /// Whether any datum is.
    pub(crate) fn leaves_out(&self) -> bool {
        self.factors.contains(&0.0)
    }

    /// How much more a datum weighs for its own tolerance: by the square, as errors of that size would. What is fixed needs
    /// no weight.
    pub(crate) fn weight(&self, datum: usize) -> f64 {
        match self.factor(datum) {
            0.0 => 0.0,
            _ if self.fixed.binary_search(&datum).is_ok() => 1.0,
            factor => factor.clamp(1.0 / MOST_FACTOR, MOST_FACTOR).powi(2),
        }
    }

    /// The weights of data with what they demand.
    pub(crate) fn weights(&self, given: Option<&[f64]>) -> Option<Vec<f64>> {
        if self.are_alike() {
            return given.map(<[f64]>::to_vec);
        }
        let weight = |datum: usize| given.map_or(1.0, |weights| weights[datum]);
        Some((0..self.factors.len()).map(|k| self.weight(k) * weight(k)).collect())
    }

    /// Errors of data measured by what they demand; those that are left out count nowhere.
    pub(crate) fn measure(&self, errors: DataErrors) -> DataErrors {
        if self.factors.is_empty() {
            return errors;
        }
        let each = errors.each;
        let demand = each.iter().zip(&self.factors).map(|(e, f)| if *f > 0.0 { e * f } else { 0.0 });
        let demand = demand.fold(0.0, f64::max);
        if !self.leaves_out() {
            return DataErrors { demand, ..summarize(each) };
        }
        let kept: Vec<usize> = (0..each.len()).filter(|&datum| !self.is_left_out(datum)).collect();
        let summary = summarize(kept.iter().map(|&datum| each[datum]).collect());
        let worst_index = kept.get(summary.worst_index).copied().unwrap_or(0);
        DataErrors { demand, worst_index, each, ..summary }
    }

    /// Tells how far the demands are met.
    pub(crate) fn report(&self, each: &[f64], report: &mut FitReport) {
        report.max_fixed_error = self.fixed.iter().map(|&datum| each[datum]).fold(0.0, f64::max);
        let is_fixed = |datum: &usize| self.fixed.binary_search(datum).is_ok();
        let shares = (0..each.len()).filter(|datum| !self.is_left_out(*datum) && !is_fixed(datum));
        let shares = shares.map(|datum| each[datum] * self.factor(datum) / self.tolerance);
        report.max_tolerance_share = shares.fold(0.0, f64::max);
    }

    /// The conditions under which a surface passes through the fixed data; `terms` are those of its value at some place,
    /// and `values` are rows of `dim` numbers, one for each datum, in the frame of the unknowns.
    pub(crate) fn conditions(
        &self,
        uv: &[DVec2],
        (values, dim): (&[f64], usize),
        terms: impl Fn(DVec2) -> Vec<(usize, f64)>,
    ) -> Vec<Conditions> {
        let condition = |&datum: &usize| Condition {
            terms: terms(uv[datum]),
            values: values[datum * dim..][..dim].to_vec(),
        };
        if self.fixed.is_empty() {
            return Vec::new();
        }
        vec![Conditions { columns: 0..dim, conditions: self.fixed.iter().map(condition).collect() }]
    }
}

#[cfg(test)]
mod tests;
