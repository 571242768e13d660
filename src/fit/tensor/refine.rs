//! The outer loop: double the grid in the direction that helps more, until the tolerance is met.

use super::single_grid::Candidate;
use super::{FitError, Problem, TensorFit};
use crate::control::{Control, Pool};
use crate::fit::common::errors::max_distance;
use crate::fit::common::report::{FitReport, Remarks, StopReason};
use crate::surface::tensor::TensorSurface;
use crate::surface::{Surface, Trims};
use glam::DVec2;

/// Two rounds in a row that do not lower the error are followed by doubling both ways; this many end the fit.
const STAGNANT_ROUNDS: usize = 4;

/// Coarse grids see nothing of short waves, and their error stays the same from one to the next. Only with more
/// than one unknown for this many data is a standstill one.
const DATA_PER_UNKNOWN: f64 = 4.0;

impl Problem<'_> {
    /// Fits grids of growing size (`ferguson.md` 5).
    pub fn fit(&mut self, control: &mut Control) -> Result<TensorFit, FitError> {
        let first = self.options.fixed_grid.unwrap_or([2, 2]);
        let candidate = control.watch(|pool, watch| self.fit_grid(first, pool, watch))??;
        let candidate = self.correct(candidate, control)?;
        let mut rounds = Rounds { passes: 1, stagnant: 0, first_error: candidate.errors.max, counts: first };
        let mut best = Best { candidate, uv: self.uv.clone(), is_current: true };
        let stop = loop {
            let error = best.candidate.errors.max;
            control.report(rounds.fraction(error, self.tolerance.0), error)?;
            if let Some(stop) = self.reason_to_stop(&best, &rounds, control) {
                break stop;
            }
            let next = match self.next_grids(rounds.counts, rounds.stagnant) {
                Ok(next) => next,
                Err(stop) => break stop,
            };
            let candidate = self.better_of(next, control)?;
            let candidate = self.correct(candidate, control)?;
            rounds.passes += 1;
            rounds.counts = candidate.counts();
            best.is_current = candidate.errors.max < error;
            rounds.stagnant = if best.is_current { 0 } else { rounds.stagnant + 1 };
            if best.is_current {
                best = Best { candidate, uv: self.uv.clone(), is_current: true };
            }
        };
        self.uv = best.uv;
        Ok(self.finish(best.candidate, stop, rounds.passes, control))
    }

    fn reason_to_stop(&self, best: &Best, rounds: &Rounds, control: &Control) -> Option<StopReason> {
        let unknowns = self.coefficient_count(rounds.counts) as f64;
        let could_resolve = DATA_PER_UNKNOWN * unknowns > self.uv.len() as f64;
        if best.is_current && self.is_met(&best.candidate, control) {
            Some(StopReason::ToleranceMet)
        } else if self.options.fixed_grid.is_some() {
            Some(StopReason::FixedGrid)
        } else if rounds.stagnant >= STAGNANT_ROUNDS && could_resolve {
            Some(StopReason::Stagnated)
        } else {
            None
        }
    }

    /// Whether data and, beyond what the facets explain, what lies between them are within the tolerance.
    fn is_met(&self, candidate: &Candidate, control: &Control) -> bool {
        let tolerance = self.tolerance.0;
        candidate.errors.max <= tolerance
            && self.interior_errors(&candidate.surface, control.pool()).max_excess <= tolerance
    }

    /// The grids to try next, or why there are none.
    fn next_grids(&self, counts: [usize; 2], stagnant: usize) -> Result<Vec<[usize; 2]>, StopReason> {
        let double = |count: usize| 2 * count - 1;
        let [u, v] = counts;
        let mut next = vec![[double(u), v], [u, double(v)]];
        if stagnant >= 2 {
            next = vec![[double(u), double(v)]];
        }
        let options = self.options;
        let fits_limit = |counts: &[usize; 2]| {
            counts.iter().all(|&count| count <= options.max_grid)
                && self.coefficient_count(*counts) <= options.max_coefficients
        };
        next.retain(fits_limit);
        if next.is_empty() {
            return Err(StopReason::Limit);
        }
        // between scattered points nothing is known; on a mesh the triangles tell
        let most = if self.mesh.is_some() { usize::MAX } else { self.uv.len().max(64) };
        next.retain(|&counts| self.coefficient_count(counts) <= most);
        if next.is_empty() { Err(StopReason::DataExhausted) } else { Ok(next) }
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
        let meets = |candidate: &Candidate| candidate.errors.max <= self.tolerance.0;
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
        let noise = 1e-13 * self.frame.scale;
        (first.errors.rms - second.errors.rms).abs() <= noise.max(1e-9 * first.errors.rms)
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
            if current.errors.max <= self.tolerance.0 {
                break;
            }
            let moved = self.foot_points(&current, control.pool());
            let before = std::mem::replace(&mut self.uv, moved);
            let counts = current.counts();
            let refitted = control.watch(|pool, watch| self.fit_grid(counts, pool, watch))??;
            if refitted.errors.rms >= current.errors.rms {
                self.uv = before;
                break;
            }
            current = refitted;
        }
        Ok(current)
    }

    /// The boundary loops of the mesh in the parameter plane.
    fn trims(&self, surface: &TensorSurface) -> Trims {
        let loops = self.mesh.map_or(&[][..], |mesh| mesh.loops());
        let loops = loops.iter().map(|nodes| nodes.iter().map(|&n| self.uv[n as usize]).collect());
        // parameters of data lie in the domain, and loops have three nodes at least
        Trims::new(loops.collect(), &surface.domain()).unwrap_or_default()
    }

    /// Largest closest-point distance from a datum to the surface; NaN unless asked for, and for fields, whose
    /// values are no places.
    fn max_distance(&self, surface: &TensorSurface, pool: &Pool) -> f64 {
        if !self.options.measure_distance || (self.mesh.is_some() && !self.is_shape) {
            return f64::NAN;
        }
        max_distance(surface, self.values, &self.uv, pool)
    }

    fn finish(
        &mut self,
        mut best: Candidate,
        stop: StopReason,
        passes: usize,
        control: &Control,
    ) -> TensorFit {
        let interior = self.interior_errors(&best.surface, control.pool());
        let trims = self.trims(&best.surface);
        let empty_cell_count = self.empty_cell_count(&best.grid, &trims);
        best.surface.region_mut().trims = trims;
        let (tolerance, raised) = self.tolerance;
        let mut remarks = Remarks::default();
        remarks.add_if(best.errors.max > tolerance, Remarks::TOLERANCE_NOT_MET);
        remarks.add_if(stop == StopReason::Stagnated, Remarks::STAGNATED);
        remarks.add_if(raised, Remarks::TOLERANCE_RAISED);
        remarks.add_if(self.energy != self.options.energy, Remarks::PLATE_ENERGY_USED);
        remarks.add_if(empty_cell_count > 0, Remarks::EMPTY_CELLS);
        remarks.add_if(interior.max_excess > tolerance, Remarks::ROUGH_BETWEEN_NODES);
        let [grid_u, grid_v] = best.counts();
        let report = FitReport {
            max_error: best.errors.max,
            rms_error: best.errors.rms,
            mean_error: best.errors.mean,
            worst_index: best.errors.worst_index,
            tolerance,
            diagonal: self.bounds.diagonal(),
            max_interior_error: interior.max,
            facet_sagitta: interior.sagitta,
            max_distance: self.max_distance(&best.surface, control.pool()),
            grid_u,
            grid_v,
            coefficient_count: best.coefficient_count,
            smoothing: best.smoothing,
            empty_cell_count,
            passes,
            stop,
            remarks,
            ..FitReport::default()
        };
        TensorFit {
            surface: best.surface,
            report,
            parameters: std::mem::take(&mut self.uv),
            errors: best.errors.each,
        }
    }
}

/// The best fit so far, with the parameters it was made for.
struct Best {
    candidate: Candidate,
    uv: Vec<DVec2>,
    /// Whether the latest round found it.
    is_current: bool,
}

struct Rounds {
    passes: usize,
    /// Rounds in a row that did not lower the error.
    stagnant: usize,
    first_error: f64,
    /// The grid of the latest round.
    counts: [usize; 2],
}

impl Rounds {
    /// How far the error has come from the first towards the tolerance, on a logarithmic scale.
    fn fraction(&self, error: f64, tolerance: f64) -> f64 {
        let way = (self.first_error / tolerance).ln();
        if way > 0.0 { ((self.first_error / error.max(tolerance)).ln() / way).clamp(0.0, 1.0) } else { 1.0 }
    }
}
