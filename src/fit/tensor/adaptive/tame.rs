//! Nets that run wild where there are no data get tension there, and lines where their cells are too large for it.

use super::super::FitError;
use super::super::lines::Lines;
use super::super::tame::HALVINGS;
use super::net::{Net, NetFitter, Tension};
use crate::control::{Control, Pool};
use crate::fit::common::tame::{AIM, CutCells, Standing, tamed};
use crate::fit::common::uniform::grid::Direction;

impl NetFitter<'_> {
    /// A net that stays near the box of the data, where one is found that is as good; the tension that it takes is what
    /// later nets have too.
    pub(super) fn tamed(&mut self, net: Net, control: &mut Control) -> Result<Net, FitError> {
        let problem = self.problem;
        if !self.is_wild(&net, control.pool()) {
            return Ok(net);
        }
        let limit = problem.options.max_coefficients.min(problem.uv.len());
        let is_allowed = |lines: &[Lines; 2]| {
            lines[0].len() * lines[1].len() <= limit
                && lines.iter().all(|lines| lines.cell_count() < problem.options.max_grid)
        };
        let same = [CutCells::No, CutCells::Yes].map(|cut| (net.lines.clone(), cut));
        let finer = std::iter::successors(halved(&net.lines), halved);
        let finer = finer.take(HALVINGS).take_while(is_allowed).map(|lines| (lines, CutCells::Yes));
        let finer: Vec<_> = finer.collect();
        let (smoothing, bound) = (net.smoothing, self.bound());
        let fitter = std::cell::RefCell::new(self);
        let judge = |net: &Net, pool: &Pool| {
            let mut net = net.clone();
            fitter.borrow().measure_between(&mut net, pool);
            Standing {
                excursion: problem.excursion(&net.surface, pool),
                error: net.errors.demand,
                between: net.excess.iter().copied().fold(0.0, f64::max),
            }
        };
        let refit = |(lines, cut): &([Lines; 2], CutCells), multiple, control: &mut Control| {
            fitter.borrow_mut().tension = Tension { multiple, cut: *cut };
            fitter.borrow().fit(lines.clone(), smoothing, control)
        };
        let net = tamed(net, bound, &same, (&finer, AIM), judge, refit, control)?;
        let fitter = fitter.into_inner();
        fitter.tension = net.tension;
        fitter.may_be_wild = fitter.is_wild(&net, control.pool());
        Ok(net)
    }
}

/// All cells halved; None where rounding cannot tell the halves from their ends.
fn halved(lines: &[Lines; 2]) -> Option<[Lines; 2]> {
    let halve = |lines: &Lines| {
        let halves = lines.breaks().windows(2).flat_map(|ends| [ends[0], (ends[0] + ends[1]) / 2.0]);
        Lines::new(halves.chain(lines.breaks().last().copied()).collect()).ok()
    };
    Some([halve(&lines[0])?, halve(&lines[1])?])
}
