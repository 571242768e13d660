//! One control curve with few knots.
//!
//! Yang and Zheng 2012, algorithm 1: interpolate the exact control curve `Q` at the knots chosen so far, the two
//! ends at first, with its end slopes; measure at all candidates; take the worst one in. With all candidates in, the
//! error there is zero. Along v basis functions are positive and sum to one, and all curves that reach a row have
//! its data among their candidates: so the surface keeps the tolerance there too.

use super::SkinError;
use super::loft::{Combination, Loft};
use super::sections::Sources;
use crate::curve::{EndRule, Interpolant};
use crate::memory::{self, CollectVec};

/// Candidates nearer than this to a knot are checked but do not become knots: spans would be lost in rounding.
const LEAST_GAP: f64 = 1e-9;

/// The exact curve at its candidates.
#[derive(Debug)]
pub(super) struct Target {
    dim: usize,
    /// Rising.
    u: Vec<f64>,
    values: Vec<f64>,
    end_slopes: [Vec<f64>; 2],
    is_periodic: bool,
}

/// A curve within the tolerance of its target.
#[derive(Debug)]
pub(super) struct Approximation {
    pub interpolant: Interpolant,
    pub passes: usize,
    pub removed_knots: usize,
    /// Whether only candidates violate the tolerance that are too near to knots.
    pub is_stalled: bool,
}

/// What all control curves are made by.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rules {
    pub tolerance: f64,
    pub extra_checks: usize,
    pub batch: bool,
    pub removal: bool,
    pub is_periodic: bool,
}

/// The values of control curves at the data of each row that they check: of row `l` first of the lowest curve.
pub(super) fn row_values(row: usize, loft: &Loft, sources: &Sources) -> Vec<(usize, Vec<f64>)> {
    let curves: Vec<usize> =
        (0..loft.curve_count()).filter(|&j| loft.checked_rows[j].contains(&row)).collect_vec();
    let sums: Vec<&Combination> = curves.iter().map(|&j| &loft.weights[j]).collect_vec();
    let values = sources.combine(&sums, sources.rows()[row].breaks());
    curves.into_iter().zip(values).collect_vec()
}

impl Target {
    /// Curve `curve` of the loft; `of_rows` are [`row_values`] of all rows.
    pub(super) fn new(
        curve: usize,
        loft: &Loft,
        sources: &Sources,
        of_rows: &[Vec<(usize, Vec<f64>)>],
        rules: &Rules,
    ) -> Self {
        let dim = sources.dim;
        let mut found: Vec<(f64, &[f64])> = Vec::new();
        for &row in &loft.checked_rows[curve] {
            let of_curve = of_rows[row].iter().filter(|(owner, _)| *owner == curve);
            for (_, values) in of_curve {
                memory::extend(
                    &mut found,
                    sources.rows()[row].breaks().iter().copied().zip(values.chunks_exact(dim)),
                );
            }
        }
        // of candidates at one place the first stays
        let mut numbered = found.into_iter().enumerate().collect_vec();
        numbered.sort_unstable_by(|(i, a), (j, b)| a.0.total_cmp(&b.0).then(i.cmp(j)));
        let mut found = numbered.into_iter().map(|(_, candidate)| candidate).collect_vec();
        found.dedup_by_key(|candidate| candidate.0);
        let between = between(&found, rules.extra_checks);
        let extra = sources.combine(&[&loft.weights[curve]], &between).swap_remove(0);
        memory::extend(&mut found, between.iter().copied().zip(extra.chunks_exact(dim)));
        found.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        let ends = sources.slopes(&loft.weights[curve], &[0.0, 1.0]);
        Self {
            dim,
            u: found.iter().map(|candidate| candidate.0).collect_vec(),
            values: found.iter().flat_map(|candidate| candidate.1).copied().collect_vec(),
            end_slopes: [ends[..dim].to_vec(), ends[dim..].to_vec()],
            is_periodic: rules.is_periodic,
        }
    }

    /// Inserts knots until the tolerance is kept, then takes out what is not needed.
    pub(super) fn approximate(&self, rules: &Rules) -> Result<Approximation, SkinError> {
        let tolerance_sq = rules.tolerance * rules.tolerance;
        let mut chosen = vec![0, self.u.len() - 1];
        let mut errors_sq = memory::filled(0.0, self.u.len());
        let mut passes = 0;
        let (interpolant, is_stalled) = loop {
            passes += 1;
            let interpolant = self.interpolate(&chosen)?;
            if self.measure(&interpolant, &mut errors_sq) < tolerance_sq {
                break (interpolant, false);
            }
            let added = self.worst_candidates(&chosen, &errors_sq, tolerance_sq, rules.batch);
            if added.is_empty() {
                break (interpolant, true);
            }
            memory::extend(&mut chosen, added);
            chosen.sort_unstable();
        };
        if !rules.removal || is_stalled {
            return Ok(Approximation { interpolant, passes, removed_knots: 0, is_stalled });
        }
        let before = chosen.len();
        self.remove_needless(&mut chosen, &mut errors_sq, tolerance_sq)?;
        let removed_knots = before - chosen.len();
        Ok(Approximation { interpolant: self.interpolate(&chosen)?, passes, removed_knots, is_stalled })
    }

    fn interpolate(&self, chosen: &[usize]) -> Result<Interpolant, SkinError> {
        let parameters = chosen.iter().map(|&k| self.u[k]).collect_vec();
        let points = chosen
            .iter()
            .flat_map(|&k| &self.values[k * self.dim..(k + 1) * self.dim])
            .copied()
            .collect_vec();
        let [begin, end] = &self.end_slopes;
        let ends = if self.is_periodic { EndRule::Periodic } else { EndRule::Slopes { begin, end } };
        Ok(Interpolant::new(self.dim, parameters, points, ends)?)
    }

    /// Squared errors at all candidates, and the largest of them.
    fn measure(&self, interpolant: &Interpolant, errors_sq: &mut [f64]) -> f64 {
        interpolant.distances_sq(&self.u, &self.values, errors_sq);
        errors_sq.iter().copied().fold(0.0, f64::max)
    }

    /// The worst candidate that may become a knot; in a batch one of every span that violates the tolerance.
    fn worst_candidates(
        &self,
        chosen: &[usize],
        errors_sq: &[f64],
        tolerance_sq: f64,
        batch: bool,
    ) -> Vec<usize> {
        let of_spans = chosen.windows(2).filter_map(|span| {
            let (from, to) = (self.u[span[0]] + LEAST_GAP, self.u[span[1]] - LEAST_GAP);
            let free = (span[0] + 1..span[1]).filter(|&k| from <= self.u[k] && self.u[k] <= to);
            free.filter(|&k| !(errors_sq[k] < tolerance_sq))
                .max_by(|&a, &b| errors_sq[a].total_cmp(&errors_sq[b]))
        });
        if batch {
            return of_spans.collect_vec();
        }
        of_spans.max_by(|&a, &b| errors_sq[a].total_cmp(&errors_sq[b])).into_iter().collect_vec()
    }

    /// Removes the knots that the tolerance does not need, the least harmful first.
    fn remove_needless(
        &self,
        chosen: &mut Vec<usize>,
        errors_sq: &mut [f64],
        tolerance_sq: f64,
    ) -> Result<(), SkinError> {
        let mut harm_without = |chosen: &[usize], knot: usize| -> Result<f64, SkinError> {
            let rest: Vec<usize> = chosen.iter().copied().filter(|&k| k != knot).collect_vec();
            Ok(self.measure(&self.interpolate(&rest)?, errors_sq))
        };
        let inner = chosen[1..chosen.len() - 1].to_vec();
        let harm = |&knot: &usize| harm_without(chosen, knot).map(|harm| (harm, knot));
        let mut by_harm = inner.iter().map(harm).collect::<Result<Vec<_>, _>>()?;
        by_harm.retain(|&(harm, _)| harm < tolerance_sq);
        by_harm.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (_, knot) in by_harm {
            if harm_without(chosen, knot)? < tolerance_sq {
                chosen.retain(|&k| k != knot);
            }
        }
        Ok(())
    }
}

/// Places that divide each gap between candidates into `count + 1` equal parts.
fn between(candidates: &[(f64, &[f64])], count: usize) -> Vec<f64> {
    let gaps = candidates.windows(2).map(|pair| (pair[0].0, pair[1].0));
    let wide = gaps.filter(|(from, to)| to - from > LEAST_GAP);
    let parts = move |(from, to): (f64, f64)| {
        (1..=count).map(move |k| from + (to - from) * k as f64 / (count + 1) as f64)
    };
    wide.flat_map(parts).collect_vec()
}
