//! Free knots: lines are inserted where the error asks for them, and taken out where they are not needed.
//!
//! ```text
//! from several starts   insert lines until the tolerance is met
//!                       or, where it is not, let the data choose the smoothing
//! from the best         take lines out, many at a time, as long as it is still met
//! in the end            fit once more with the data that were withheld
//! ```

mod buffer;
mod equal;
mod insert;
mod net;
mod predict;
mod remove;
mod tame;

use super::candidate::Fitted;
use super::lines::Lines;
use super::{FitError, Knots, Method, Problem, TensorFit};
use crate::control::Control;
use crate::fit::common::report::StopReason;
use crate::fit::common::sides::{side_lines, with_side_lines};
use crate::geometry::Bounds;
use crate::memory;
use crate::surface::Surface;
use buffer::with_buffer;
use insert::Growth;
use net::{Net, NetFitter};

/// Cells along each direction to start from. The result depends on where the first lines stand: small fits try
/// several and keep the best.
const STARTS: [usize; 3] = [8, 6, 11];
/// A fit of more coefficients than this is not worth a second start, nor weighing data.
const SMALL: usize = 1200;
/// Fits to scattered data of fewer than these are cheap enough for weighing.
const FEW_DATA: usize = 20_000;
/// Solves to take lines out, at least and at most; between them one for this many coefficients.
const SOLVES: (usize, usize, usize) = (16, 40, 100);
/// Solves to take lines out with data weighed.
const WEIGHED_SOLVES: usize = 24;

/// Fewest data for knots of their own: with fewer, the 16 coefficients of one cell are too many.
const LEAST_COUNT: usize = 32;

/// What free knots came to.
struct Freed {
    net: Net,
    stop: StopReason,
    rounds: usize,
}

impl Problem<'_> {
    /// Fits over the kind of knots that is asked for.
    pub(super) fn fit_any(self, control: &mut Control) -> Result<TensorFit, FitError> {
        let options = self.options;
        let is_uniform = !self.is_mirrored
            && !self.has_bound_ends()
            && (options.knots == Knots::Uniform
                || options.method == Method::Ferguson
                || options.fixed_grid.is_some()
                || self.uv.len().min(options.max_coefficients) < LEAST_COUNT
                || options.max_grid < STARTS[0] + 1);
        if is_uniform {
            return self.run(control);
        }
        if self.is_mirrored || self.has_bound_ends() {
            let freed = self.fit_freely(control)?;
            return Ok(self.finish_freed(freed, control));
        }
        // a plain shape needs no lines of its own
        let plain = control.watch(|pool, watch| self.fit_grid([2, 2], pool, watch))??;
        let tolerance = self.goal.tolerance;
        control.report((tolerance / plain.errors.demand).min(1.0), plain.errors.demand)?;
        let is_met = plain.errors.demand <= tolerance
            && self.interior_errors(&plain.surface, control.pool()).max_smooth_excess <= tolerance;
        if is_met {
            let plain = self.tamed(plain, control)?;
            return Ok(self.finish(plain.into(), StopReason::ToleranceMet, 1, control));
        }
        let freed = self.fit_freely(control)?;
        Ok(self.finish_freed(freed, control))
    }

    /// The surface over free knots with its buffer.
    fn finish_freed(self, freed: Freed, control: &Control) -> TensorFit {
        let options = self.options;
        let coefficient_count = freed.net.coefficient_count();
        let Net { surface, smoothing, .. } = freed.net;
        let bounds = Bounds::of_rows(self.values, self.dim);
        let buffer = if self.has_bound_ends() { 0.0 } else { options.buffer };
        let mut surface = with_buffer(surface, buffer, &bounds);
        *surface.region_mut() = self.region();
        let errors = self.errors(&surface, control.pool());
        let fitted = Fitted { surface, errors, smoothing, coefficient_count };
        self.finish(fitted, freed.stop, freed.rounds + 1, control)
    }

    /// Fits over free knots.
    fn fit_freely(&self, control: &mut Control) -> Result<Freed, FitError> {
        let mut fitter = control.watch(|_, watch| NetFitter::new(self, watch))?;
        let is_equal = self.has_equal_cells();
        let Growth { mut net, stop, mut rounds } = match is_equal {
            true => self.grow_equal(&fitter, control)?,
            false => self.grow_best(&fitter, control)?,
        };
        if stop != StopReason::ToleranceMet {
            if fitter.withholds() {
                fitter.use_all_data();
            }
            if self.options.smoothing == 0.0 {
                net = fitter.best_predictor(net, control)?;
            }
            return Ok(Freed { net: fitter.tamed(net, control)?, stop, rounds });
        }
        net = fitter.tamed(net, control)?;
        if is_equal {
            return Ok(Freed { net, stop, rounds });
        }
        let (least, most, coefficients) = SOLVES;
        let most = (least + net.coefficient_count() / coefficients).min(most);
        let (mut thin, solves) = fitter.thin(net.clone(), most, None, control)?;
        rounds += solves;
        if self.mesh.is_none() && thin.coefficient_count() <= SMALL && self.uv.len() <= FEW_DATA {
            let mut factors = memory::filled(1.0, self.uv.len());
            let solves;
            (thin, solves) = fitter.thin(thin, WEIGHED_SOLVES, Some(&mut factors), control)?;
            rounds += solves;
        }
        if fitter.withholds() {
            fitter.use_all_data();
            let mut whole = fitter.fit(thin.lines.clone(), thin.smoothing, control)?;
            if fitter.meets(&mut whole, control.pool()) && !fitter.is_wild(&whole, control.pool()) {
                thin = whole;
            }
        }
        // it was measured between some of the data only
        if fitter.meets(&mut thin, control.pool()) && !fitter.is_wild(&thin, control.pool()) {
            net = thin;
        }
        Ok(Freed { net, stop, rounds })
    }

    /// The least of the nets that grow from several starts and meet the tolerance, or the first.
    fn grow_best(&self, fitter: &NetFitter, control: &mut Control) -> Result<Growth, FitError> {
        let limit = self.options.max_coefficients.min(self.uv.len());
        let fits =
            |start: usize, limit: usize| (start + 3) * (start + 3) <= limit && start < self.options.max_grid;
        // a plain shape needs no more than one cell
        let mut best = fitter.try_one_cell(self.lines([1, 1])?, control)?;
        let is_plain = best.stop == StopReason::ToleranceMet && !fitter.is_wild(&best.net, control.pool());
        if is_plain || !fits(STARTS[0], limit) {
            return Ok(best);
        }
        let mut rounds = best.rounds;
        for (k, start) in STARTS.into_iter().enumerate() {
            let limit = if k == 0 { limit } else { best.net.coefficient_count() - 1 };
            if !fits(start, limit) {
                continue;
            }
            let growth = fitter.grow(self.lines([start, start])?, limit, control)?;
            rounds += growth.rounds;
            let is_met = growth.stop == StopReason::ToleranceMet;
            if k == 0 || is_met {
                best = growth;
            }
            if !is_met && k == 0 || best.net.coefficient_count() > SMALL {
                break;
            }
        }
        Ok(Growth { rounds, ..best })
    }

    /// Whether cells are to be equal although the ends of the surface are bound.
    fn has_equal_cells(&self) -> bool {
        let options = self.options;
        self.has_bound_ends() && (options.knots == Knots::Uniform || options.fixed_grid.is_some())
    }

    /// Equal cells over the box of the data, with the lines that sides need.
    fn lines(&self, counts: [usize; 2]) -> Result<[Lines; 2], FitError> {
        let (min, max) = (self.data_box.min, self.data_box.max);
        let needed = side_lines(&self.sides);
        let lines = |axis: usize| {
            let degenerate = |_| FitError::DegenerateRange { axis: ['u', 'v'][axis], at: min[axis] };
            let equal = Lines::uniform(min[axis], max[axis], counts[axis]).map_err(degenerate)?;
            Lines::new(with_side_lines(equal.breaks().to_vec(), &needed[axis])).map_err(degenerate)
        };
        Ok([lines(0)?, lines(1)?])
    }
}

impl NetFitter<'_> {
    /// Reports the best error so far.
    fn tell(&self, error: f64, control: &mut Control) -> Result<(), FitError> {
        Ok(control.report((self.problem.goal.tolerance / error).min(1.0), error)?)
    }
}
