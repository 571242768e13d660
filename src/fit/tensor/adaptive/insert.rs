//! Knot lines are inserted where the error asks for them.

use super::super::FitError;
use super::super::lines::Lines;
use super::net::{Net, NetFitter};
use crate::control::{Control, Pool};
use crate::fit::common::report::StopReason;
use crate::fit::common::uniform::grid::Direction;

/// Smoothings of the thin plate: the first, and the last that is tried. Above the first a fit stalls while knots
/// pile up; below the last it swings between the data.
const FIRST_SMOOTHING: f64 = 1e-11;
const LAST_SMOOTHING: f64 = 1e-14;
/// A maximum that falls by less than this share in [`STALLED_ROUNDS`] has stalled: the smoothing is divided by ten.
const STALL: f64 = 0.05;
const STALLED_ROUNDS: usize = 2;
/// Errors count from this share of the tolerance on: what is nearly bad will be bad elsewhere.
const COUNTS_FROM: f64 = 0.8;
/// A datum with a tolerance of its own scores no more, however strict that is.
const WORST_SCORE: f64 = 1e3;
/// Cells with at least this share of the worst score are halved.
const MARK_SHARE: f64 = 0.3;
/// Most new lines in a round, as a share of those there are.
const MOST_NEW: f64 = 0.3;

/// How far inserting lines came.
pub(super) struct Growth {
    pub net: Net,
    pub stop: StopReason,
    pub rounds: usize,
}

/// A cell to halve.
struct Mark {
    axis: usize,
    cell: usize,
    score: f64,
}

impl NetFitter<'_> {
    /// The smoothings to try: the one that was asked for, or the first and the last.
    pub(super) fn smoothings(&self) -> (f64, f64) {
        match self.problem.options.smoothing {
            0.0 => (FIRST_SMOOTHING, LAST_SMOOTHING),
            asked => (asked, asked),
        }
    }

    /// The fit over one cell.
    pub(super) fn try_one_cell(&self, cell: [Lines; 2], control: &mut Control) -> Result<Growth, FitError> {
        let mut net = self.fit(cell, self.smoothings().0, control)?;
        self.tell(net.errors.demand, control)?;
        let stop = match self.meets(&mut net, control.pool()) {
            true => StopReason::ToleranceMet,
            false => StopReason::DataExhausted,
        };
        Ok(Growth { net, stop, rounds: 1 })
    }

    /// Inserts lines until the tolerance is met, or `limit` coefficients are reached.
    pub(super) fn grow(
        &self,
        start: [Lines; 2],
        limit: usize,
        control: &mut Control,
    ) -> Result<Growth, FitError> {
        let (mut smoothing, last_smoothing) = self.smoothings();
        let mut equations = self.assemble(start, None, control)?;
        let mut best: Option<Net> = None;
        // the largest errors with the present smoothing
        let mut history: Vec<f64> = Vec::new();
        let mut rounds = 0;
        let stop = loop {
            let mut net = self.solve(&equations, smoothing, control)?;
            rounds += 1;
            let is_met = self.meets(&mut net, control.pool());
            history.push(net.merit());
            self.tell(best.as_ref().map_or(f64::INFINITY, Net::merit).min(net.merit()), control)?;
            if is_met {
                return Ok(Growth { net, stop: StopReason::ToleranceMet, rounds });
            }
            let has_stalled = has_stalled(&history) && smoothing > 1.5 * last_smoothing;
            let next = if has_stalled { None } else { Some(self.refined(&net, limit)) };
            self.keep_better(&mut best, net, control.pool());
            match next {
                None => {
                    smoothing /= 10.0;
                    history.clear();
                }
                Some(Ok(lines)) => equations = self.assemble(lines, None, control)?,
                Some(Err(stop)) => break stop,
            }
        };
        let net = best.expect("the first round left one");
        Ok(Growth { net, stop, rounds })
    }

    /// Keeps the net that is better at the data and between them.
    pub(super) fn keep_better(&self, best: &mut Option<Net>, mut net: Net, pool: &Pool) {
        if let Some(best) = best {
            if net.errors.demand >= best.merit() {
                return;
            }
            self.measure_between(&mut net, pool);
            self.measure_between(best, pool);
            if net.merit() >= best.merit() {
                return;
            }
        }
        *best = Some(net);
    }

    /// The lines of a net and those that its errors ask for, or why there are none.
    fn refined(&self, net: &Net, limit: usize) -> Result<[Lines; 2], StopReason> {
        let marks = self.marks(net);
        if marks.is_empty() {
            return Err(StopReason::DataExhausted);
        }
        let mut counts = [0, 1].map(|axis| net.lines[axis].len());
        let mut breaks = [0, 1].map(|axis| net.lines[axis].breaks().to_vec());
        let mut added = 0;
        for mark in &marks {
            counts[mark.axis] += 1;
            let knots = counts[mark.axis] - 2;
            if counts[0] * counts[1] > limit || knots > self.problem.options.max_grid {
                counts[mark.axis] -= 1;
                continue;
            }
            let old = net.lines[mark.axis].breaks();
            breaks[mark.axis].push((old[mark.cell] + old[mark.cell + 1]) / 2.0);
            added += 1;
        }
        if added == 0 {
            let is_exhausted = limit == self.problem.uv.len();
            return Err(if is_exhausted { StopReason::DataExhausted } else { StopReason::Limit });
        }
        let [u, v] = breaks.map(|mut breaks| {
            breaks.sort_unstable_by(f64::total_cmp);
            Lines::new(breaks)
        });
        // halves that rounding cannot tell from their ends
        let (Ok(u), Ok(v)) = (u, v) else { return Err(StopReason::Limit) };
        Ok([u, v])
    }

    /// The cells to halve, the worst first.
    fn marks(&self, net: &Net) -> Vec<Mark> {
        let tolerance = self.problem.goal.tolerance;
        let mut scores = [0, 1].map(|axis| vec![0.0; net.lines[axis].cell_count()]);
        let standards = &self.problem.standards;
        let demand = |(datum, &error): (usize, &f64)| match standards.factor(datum) {
            1.0 => error,
            factor => (error * factor).min(WORST_SCORE * tolerance),
        };
        let demands = net.errors.each.iter().enumerate().map(demand);
        let between = self.places_between().iter().zip(net.excess.iter().copied());
        for (uv, error) in self.problem.uv.iter().zip(demands).chain(between) {
            let score = error / tolerance - COUNTS_FROM;
            if score > 0.0 {
                scores[0][net.lines[0].locate(uv.x).0] += score;
                scores[1][net.lines[1].locate(uv.y).0] += score;
            }
        }
        let mut marks: Vec<Mark> = (0..2)
            .flat_map(|axis| {
                scores[axis].iter().enumerate().map(move |(cell, &score)| Mark { axis, cell, score })
            })
            .filter(|mark| mark.score > 0.0 && self.can_halve(&net.lines[mark.axis], mark))
            .collect();
        marks.sort_by(|a, b| b.score.total_cmp(&a.score));
        let most = (MOST_NEW * (scores[0].len() + scores[1].len()) as f64).ceil() as usize;
        let least = marks.first().map_or(0.0, |mark| MARK_SHARE * mark.score);
        marks.truncate(most);
        marks.retain(|mark| mark.score >= least);
        marks
    }

    /// No cell is finer than the data: both halves hold some.
    fn can_halve(&self, lines: &Lines, mark: &Mark) -> bool {
        let (from, to) = (lines.breaks()[mark.cell], lines.breaks()[mark.cell + 1]);
        let middle = (from + to) / 2.0;
        self.count_between(mark.axis, from, middle) > 0 && self.count_between(mark.axis, middle, to) > 0
    }
}

fn has_stalled(history: &[f64]) -> bool {
    let Some(before) = history.len().checked_sub(STALLED_ROUNDS + 1) else { return false };
    history[history.len() - 1] > (1.0 - STALL) * history[before]
}
