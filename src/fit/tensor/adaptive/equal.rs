//! Equal cells where the ends of a surface are bound: halved in one direction at a time until the tolerance is met, as free
//! grids are, with the lines of given sides among them.

use super::super::lines::Lines;
use super::super::{FIRST_GRID, FitError, Problem};
use super::insert::Growth;
use super::net::{Net, NetFitter, coefficient_count};
use crate::control::Control;
use crate::fit::common::report::StopReason;

/// Rounds in a row that gain nothing: after so many cells are halved both ways, and after so many the search ends.
const IDLE_ROUNDS: [usize; 2] = [2, 4];
/// Less smoothing than the calmest is worth trying where the error is above the tolerance by no more than this factor.
const WORTH_CALMING: f64 = 1.1;

impl Problem<'_> {
    /// The first net of equal cells that meets the tolerance, or the best.
    pub(super) fn grow_equal(&self, fitter: &NetFitter, control: &mut Control) -> Result<Growth, FitError> {
        let mut counts = self.options.fixed_grid.unwrap_or(FIRST_GRID).map(|knots| knots - 1);
        let mut net = fitter.fit_calmest(self.lines(counts)?, control)?;
        let mut best: Option<Net> = None;
        let (mut rounds, mut idle) = (1, 0);
        let stop = loop {
            if fitter.meets(&mut net, control.pool()) {
                return Ok(Growth { net, stop: StopReason::ToleranceMet, rounds });
            }
            let before = best.as_ref().map_or(f64::INFINITY, Net::merit);
            fitter.keep_better(&mut best, net, control.pool());
            let merit = best.as_ref().map_or(f64::INFINITY, Net::merit);
            fitter.tell(merit, control)?;
            idle = if merit < before { 0 } else { idle + 1 };
            let next = match self.finer_counts(counts, idle) {
                Ok(next) => next,
                Err(stop) => break stop,
            };
            (counts, net) = self.better_of_equal(fitter, &next, control)?;
            rounds += 1;
        };
        let net = best.ok_or(FitError::Singular)?;
        Ok(Growth { net, stop, rounds })
    }

    /// The numbers of cells to try next, or why there are none.
    fn finer_counts(&self, [u, v]: [usize; 2], idle: usize) -> Result<Vec<[usize; 2]>, StopReason> {
        if self.options.fixed_grid.is_some() {
            return Err(StopReason::FixedGrid);
        }
        if idle >= IDLE_ROUNDS[1] {
            return Err(StopReason::Stagnated);
        }
        let mut next = vec![[2 * u, v], [u, 2 * v]];
        if idle >= IDLE_ROUNDS[0] {
            next = vec![[2 * u, 2 * v]];
        }
        let count =
            |counts: &[usize; 2]| self.lines(*counts).map_or(usize::MAX, |lines| coefficient_count(&lines));
        next.retain(|counts| {
            counts.iter().all(|&cells| cells < self.options.max_grid)
                && count(counts) <= self.options.max_coefficients
        });
        if next.is_empty() {
            return Err(StopReason::Limit);
        }
        next.retain(|counts| count(counts) <= self.uv.len());
        if next.is_empty() { Err(StopReason::DataExhausted) } else { Ok(next) }
    }

    /// The one that meets the tolerance, then the one with the smaller RMS error.
    fn better_of_equal(
        &self,
        fitter: &NetFitter,
        next: &[[usize; 2]],
        control: &mut Control,
    ) -> Result<([usize; 2], Net), FitError> {
        let mut better: Option<([usize; 2], Net)> = None;
        for &counts in next {
            let net = fitter.fit_calmest(self.lines(counts)?, control)?;
            let rank = |net: &Net| (net.errors.demand > self.goal.tolerance, net.errors.rms);
            if better.as_ref().is_none_or(|(_, other)| rank(&net) < rank(other)) {
                better = Some((counts, net));
            }
        }
        better.ok_or(FitError::Singular)
    }
}

impl NetFitter<'_> {
    /// The calmest fit over some lines that meets the tolerance, or the closest one if none does.
    fn fit_calmest(&self, lines: [Lines; 2], control: &mut Control) -> Result<Net, FitError> {
        let (calmest, closest) = self.smoothings();
        let equations = self.assemble(lines, None, control)?;
        let net = self.solve(&equations, closest, control)?;
        if net.errors.demand > WORTH_CALMING * self.problem.goal.tolerance {
            return Ok(net);
        }
        let mut smoothing = calmest;
        while smoothing > 1.5 * closest {
            let calm = self.solve(&equations, smoothing, control)?;
            if calm.errors.demand <= self.problem.goal.tolerance {
                return Ok(calm);
            }
            smoothing /= 10.0;
        }
        Ok(net)
    }
}
