//! How fits with two continuous derivatives grow: from several initial grids, of which the best is kept.

use super::PhtOptions;
use super::refine::{NoiseTest, Refinement, Round};
use crate::control::Control;
use crate::fit::common::FitError;
use crate::fit::common::report::StopReason;
use crate::fit::common::rounds::{self, Outcome};
use crate::surface::Surface;

/// Two rounds that leave more than this share of the error have not helped.
const STALLED: f64 = 0.95;

/// Cells along each direction of the initial grids that are tried. Lines of halved cells are those of twice as many: 1 stands
/// for 2, 4, 8 and more, 3 for 6 and 12. Which fits best is luck, and worth a quarter of the coefficients of small fits.
const STARTS: [usize; 5] = [1, 5, 7, 9, 3];
/// A fit of more coefficients than this is not worth a second start.
const SMALL: usize = 1200;

impl Refinement<'_> {
    /// Whether two rounds have not helped, and the plate now weighs less.
    pub(super) fn has_stalled(&mut self, error: f64) -> bool {
        if self.options.continuity == super::Continuity::C1 {
            return false;
        }
        self.course.push(error);
        let before = self.course.len().checked_sub(3).map(|k| self.course[k]);
        before.is_some_and(|before| error > STALLED * before && error > self.goal.tolerance)
            && self.lower_smoothing()
    }

    /// The best fit from several initial grids: the smallest that meets the tolerance, or the first.
    pub(super) fn grow_smoothly(&mut self, control: &mut Control) -> Result<Outcome<Round>, FitError> {
        if self.options.initial_grid != PhtOptions::default().initial_grid {
            let grown = rounds::run(self, control)?;
            return self.coarsened(grown, control);
        }
        let mut best = self.grow_from(STARTS[0], control)?;
        let count = |outcome: &Outcome<Round>| outcome.best.surface.coefficient_count();
        for start in &STARTS[1..] {
            let least = (start + 3) * (start + 3);
            if best.stop != StopReason::ToleranceMet || best.best.refined_count > SMALL {
                break;
            }
            if least < count(&best) && start * start <= self.options.max_cells {
                let grown = self.grow_from(*start, control)?;
                let is_better = grown.stop == StopReason::ToleranceMet && count(&grown) < count(&best);
                best = if is_better { grown } else { best };
            }
        }
        self.mesh = best.best.surface.mesh().clone();
        self.smoothing = best.best.smoothing;
        Ok(best)
    }

    /// The fit that grows from equal cells, as coarse as it may be.
    fn grow_from(&mut self, count: usize, control: &mut Control) -> Result<Outcome<Round>, FitError> {
        self.mesh = Self::initial_mesh(&self.data, [count, count])?;
        self.smoothing = self.options.smoothing;
        self.noise = NoiseTest::default();
        self.course.clear();
        self.known.renew();
        let grown = rounds::run(self, control)?;
        self.coarsened(grown, control)
    }
}
