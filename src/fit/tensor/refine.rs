//! The outer loop: double the grid in the direction that helps more, until the tolerance is met.

use super::candidate::{Candidate, Fitted};
use super::{FitError, Problem, TensorFit};
use crate::control::{Control, Pool};
use crate::fit::common::errors::max_distance;
use crate::fit::common::foot_points::{LONGEST_STEP, foot_points, hold_back};
use crate::fit::common::report::{FitReport, Remarks, StopReason};
use crate::fit::common::rounds::{self, Next, Rounds, Standing};
use crate::fit::common::sides::side_deviation;
use crate::fit::common::trims;
use crate::surface::Surface;
use crate::surface::tensor::{Axis, TensorSurface};
use glam::DVec2;

/// Two rounds in a row that do not lower the error are followed by doubling both ways; this many end the fit.
const STAGNANT_ROUNDS: usize = 4;

/// Coarse grids see nothing of short waves, and their error stays the same from one to the next. Only with more
/// than one unknown for this many data is a standstill one.
pub(super) const DATA_PER_UNKNOWN: f64 = 4.0;

/// Errors below this share of the data's diagonal are rounding: some hundred operations on numbers of that size.
const ROUNDING: f64 = 1e-13;
/// RMS errors that differ by a smaller share are equal: the two grids differ by symmetry, and what is left is the
/// rounding of solutions of condition up to 1e6. With less, rounding would choose the direction that is doubled.
const SAME_ERROR: f64 = 1e-9;

/// A triangle that keeps less than this share of its area holds its nodes back.
const LEAST_AREA: f64 = 1e-3;

/// A fit with the parameters it was made for.
pub(super) struct Round {
    candidate: Candidate,
    uv: Vec<DVec2>,
    /// The largest error between the data beyond what they explain; not measured where the error at the data is worse
    /// than an earlier round.
    excess: f64,
}

impl Round {
    /// What is to be small: a step that gains at the data and loses more between them is none.
    fn merit(&self) -> f64 {
        self.candidate.errors.demand.max(self.excess)
    }
}

/// Grids of growing size, doubled where the error asks: Dannenhoffer and Haimes (2009).
impl Rounds for Problem<'_> {
    type Round = Round;
    type Error = FitError;

    fn fit(&mut self, control: &mut Control) -> Result<Round, FitError> {
        let next = std::mem::take(&mut self.next);
        let candidate = self.better_of(next, control)?;
        let candidate = self.correct(candidate, control)?;
        let mut round = Round { candidate, uv: self.uv.clone(), excess: 0.0 };
        if round.merit() < self.least {
            let surface = &round.candidate.surface;
            let errors = control.watch(|pool, _| self.interior_errors(surface, pool))?;
            round.excess = errors.max_smooth_excess;
            self.least = self.least.min(round.merit());
        }
        Ok(round)
    }

    fn error(&self, round: &Round) -> f64 {
        round.merit()
    }

    fn tolerance(&self) -> f64 {
        self.goal.tolerance
    }

    fn refine(&mut self, standing: &Standing<Round>, _: &Control) -> Next {
        let Some(Round { candidate, .. }) = standing.round else { return Next::Stop(StopReason::Stagnated) };
        let unknowns = self.coefficient_count(candidate.counts()) as f64;
        let could_resolve = DATA_PER_UNKNOWN * unknowns > self.uv.len() as f64;
        if standing.is_best && standing.error <= self.goal.tolerance {
            return Next::Done;
        }
        if self.options.fixed_grid.is_some() {
            return Next::Stop(StopReason::FixedGrid);
        }
        if standing.idle >= STAGNANT_ROUNDS && could_resolve {
            return Next::Stop(StopReason::Stagnated);
        }
        match self.next_grids(candidate.counts(), standing.idle) {
            Ok(next) => self.next = next,
            Err(stop) => return Next::Stop(stop),
        }
        Next::Round
    }
}

impl Problem<'_> {
    pub(super) fn run(mut self, control: &mut Control) -> Result<TensorFit, FitError> {
        let outcome = rounds::run(&mut self, control)?;
        self.move_data(outcome.best.uv);
        let tame = self.tamed(outcome.best.candidate, control)?;
        Ok(self.finish(tame.into(), outcome.stop, outcome.passes, control))
    }

    /// The grids to try next, or why there are none.
    fn next_grids(&self, counts: [usize; 2], stagnant: usize) -> Result<Vec<[usize; 2]>, StopReason> {
        let double = |count: usize| 2 * count - 1;
        let [u, v] = counts;
        let mut next = vec![[double(u), v], [u, double(v)]];
        if stagnant >= 2 {
            next = vec![[double(u), double(v)]];
        }
        next.retain(|&counts| self.is_within_limits(counts));
        if next.is_empty() {
            return Err(StopReason::Limit);
        }
        next.retain(|&counts| self.allows(counts));
        if next.is_empty() { Err(StopReason::DataExhausted) } else { Ok(next) }
    }

    fn is_within_limits(&self, counts: [usize; 2]) -> bool {
        counts.iter().all(|&count| count <= self.options.max_grid)
            && self.coefficient_count(counts) <= self.options.max_coefficients
    }

    /// Whether a grid is within the limits and has no more unknowns than there are data.
    pub(super) fn allows(&self, counts: [usize; 2]) -> bool {
        self.is_within_limits(counts) && self.coefficient_count(counts) <= self.uv.len()
    }

    /// Fits all of `next` side by side and keeps the one that meets the tolerance, then the one with the
    /// smaller RMS error; a tie goes to the direction with the longer cells.
    fn better_of(&self, next: Vec<[usize; 2]>, control: &mut Control) -> Result<Candidate, FitError> {
        let mut fitted = control.watch(|pool, watch| match next.as_slice() {
            &[first, second] => {
                let (first, second) =
                    rayon::join(|| self.fit_grid(first, pool, watch), || self.fit_grid(second, pool, watch));
                Ok(vec![first?, second?])
            }
            others => others.iter().map(|&counts| self.fit_grid(counts, pool, watch)).collect(),
        })??;
        let meets = |candidate: &Candidate| candidate.errors.demand <= self.goal.tolerance;
        let second = if fitted.len() > 1 { fitted.pop() } else { None };
        let first = fitted.pop().ok_or(FitError::Singular)?;
        let Some(second) = second else { return Ok(first) };
        let prefers_second = if meets(&first) != meets(&second) {
            meets(&second)
        } else if self.is_tie(&first, &second) {
            self.cells_are_longer_along_v(&first)
        } else {
            second.errors.rms < first.errors.rms
        };
        Ok(if prefers_second { second } else { first })
    }

    /// Errors that differ by rounding only.
    fn is_tie(&self, first: &Candidate, second: &Candidate) -> bool {
        let noise = ROUNDING * self.frame.scale;
        (first.errors.rms - second.errors.rms).abs() <= noise.max(SAME_ERROR * first.errors.rms)
    }

    /// Compares the cells from before the doubling; `along_u` is the grid doubled in u.
    fn cells_are_longer_along_v(&self, along_u: &Candidate) -> bool {
        let surface = &along_u.surface;
        let uv = &self.uv[..self.uv.len().min(1000)];
        let dim = self.dim;
        let mut rows = vec![0.0; uv.len() * 3 * dim];
        crate::surface::Surface::eval_rows(surface, uv, 1, &mut rows);
        let (mut u, mut v) = (0.0, 0.0);
        for row in rows.chunks_exact(3 * dim) {
            let length = |k: usize| row[k * dim..][..dim].iter().map(|x| x * x).sum::<f64>().sqrt();
            u += length(1);
            v += length(2);
        }
        v * along_u.grid[1].step > u * 2.0 * along_u.grid[0].step
    }

    /// Parameter correction, as many sweeps as asked for while they help.
    fn correct(&mut self, mut current: Candidate, control: &mut Control) -> Result<Candidate, FitError> {
        for _ in 0..self.options.correction_sweeps {
            if current.errors.demand <= self.goal.tolerance {
                break;
            }
            let moved = self.moved(&current, control.pool());
            let before = self.move_data(moved);
            let counts = current.counts();
            let refitted = control.watch(|pool, watch| self.fit_grid(counts, pool, watch))??;
            if refitted.errors.rms >= current.errors.rms {
                self.move_data(before);
                break;
            }
            current = refitted;
        }
        Ok(current)
    }

    /// Where the data go that move towards their foot points.
    fn moved(&self, candidate: &Candidate, pool: &Pool) -> Vec<DVec2> {
        let longest = LONGEST_STEP * DVec2::new(candidate.grid[0].step, candidate.grid[1].step);
        let settle = |_, _, to| self.data_box.clamp(to);
        let mut moved = foot_points(&candidate.surface, self.values, &self.uv, |_| longest, settle, pool);
        if let Some(mesh) = self.mesh {
            hold_back(mesh, (&self.uv, LEAST_AREA), &self.uv, &mut moved);
        }
        moved
    }

    /// Largest closest-point distance from a datum to the surface; NaN unless asked for, and for fields, whose
    /// values are no places.
    fn max_distance(&self, surface: &TensorSurface, pool: &Pool) -> f64 {
        if !self.options.measure_distance || (self.mesh.is_some() && !self.is_shape) {
            return f64::NAN;
        }
        max_distance(surface, self.values, &self.uv, pool)
    }

    /// The surface with what is known of it.
    pub(super) fn finish(
        self,
        mut best: Fitted,
        stop: StopReason,
        passes: usize,
        control: &Control,
    ) -> TensorFit {
        let trims = trims(self.mesh, &self.uv, &best.surface.domain());
        let empty_cell_count = self.empty_cell_count(&best.surface, &trims);
        best.surface.region_mut().trims = trims;
        let [grid_u, grid_v] = [Axis::U, Axis::V].map(|axis| best.surface.knots(axis).breaks().len());
        let mut report = FitReport {
            max_distance: self.max_distance(&best.surface, control.pool()),
            grid_u,
            grid_v,
            coefficient_count: best.coefficient_count,
            smoothing: best.smoothing,
            empty_cell_count,
            ..FitReport::new(&best.errors, &self.goal, stop, passes)
        };
        self.standards.report(&best.errors.each, &mut report);
        [report.max_side_error, report.max_side_angle] = side_deviation((&best.surface).into(), &self.sides);
        report.add_interior(&self.interior_errors(&best.surface, control.pool()));
        report.remarks.add_if(self.energy != self.options.energy, Remarks::PLATE_ENERGY_USED);
        report.remarks.add_if(empty_cell_count > 0, Remarks::EMPTY_CELLS);
        TensorFit { surface: best.surface, report, parameters: self.uv, errors: best.errors.each }
    }
}
