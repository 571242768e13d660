//! Knot lines that are not needed are taken out.
//!
//! A line matters as much as the third derivative jumps across it (T. Lyche and K. Moerken, "Knot removal for
//! parametric B-spline curves and surfaces", Comput. Aided Geom. Des. 4 (1987), 217-230), times the cube of the
//! distance to its neighbours. The lines that matter least go first, many at a time while that succeeds.

use super::super::FitError;
use super::super::lines::Lines;
use super::net::{Net, NetFitter};
use crate::control::Control;
use crate::fit::common::sides::side_lines;
use crate::fit::common::uniform::grid::Direction;
use crate::memory;

/// Share of the lines that are tried at first.
const FIRST_SHARE: f64 = 0.2;
/// Data near the tolerance weigh more, by the cube of their error in units of this share of it: that brings the
/// largest error down, so that more lines can go.
const WEIGH_FROM: f64 = 0.75;
/// A largest error beyond this many tolerances is not worth weighing.
const WORTH_WEIGHING: f64 = 1.4;
/// More than this a weight does not grow at once, however strict the tolerance of a datum.
const MOST_WEIGHT: f64 = 10.0;
/// Solves with weights for one batch.
const MOST_WEIGHED: usize = 4;
/// The jump of a line is this percentile of the jumps along it: single spikes do not save it.
const PERCENTILE: f64 = 0.95;

/// A line that could go.
#[derive(Clone, Copy)]
struct Line {
    axis: usize,
    /// Its place among the breaks.
    index: usize,
    rank: f64,
}

impl NetFitter<'_> {
    /// Takes lines out of a net that meets the tolerance as long as the rest seems to meet it too. `most` solves are
    /// spent at most. With `factors` data near the tolerance are weighed where that helps.
    pub(super) fn thin(
        &self,
        mut net: Net,
        most: usize,
        mut factors: Option<&mut Vec<f64>>,
        control: &mut Control,
    ) -> Result<(Net, usize), FitError> {
        let mut kept: [Vec<f64>; 2] = side_lines(&self.problem.sides);
        let mut share = FIRST_SHARE;
        let mut solves = 0;
        while solves < most {
            let ranked = self.ranked(&net, &kept);
            let count = ((share * ranked.len() as f64) as usize).max(1);
            let batch = without_neighbours(&ranked, count);
            if batch.is_empty() {
                break;
            }
            let lines = without(&net.lines, &batch)?;
            let thinner = match &mut factors {
                None => {
                    solves += 1;
                    let thinner = self.fit(lines, net.smoothing, control)?;
                    self.seems_to_meet(&thinner, control.pool()).then_some(thinner)
                }
                Some(factors) => self.fit_weighed(lines, net.smoothing, factors, &mut solves, control)?,
            };
            self.tell(net.merit(), control)?;
            if let Some(thinner) = thinner {
                net = thinner;
            } else if let [line] = batch[..] {
                memory::push(&mut kept[line.axis], net.lines[line.axis].breaks()[line.index]);
            } else {
                share = 0.5 * batch.len() as f64 / ranked.len() as f64;
            }
        }
        Ok((net, solves))
    }

    /// Fits with data near the tolerance weighed more and more; `factors` are changed if that succeeds.
    fn fit_weighed(
        &self,
        lines: [Lines; 2],
        smoothing: f64,
        factors: &mut Vec<f64>,
        solves: &mut usize,
        control: &mut Control,
    ) -> Result<Option<Net>, FitError> {
        let tolerance = self.problem.goal.tolerance;
        let mut trial = memory::copied(factors);
        for _ in 0..MOST_WEIGHED {
            *solves += 1;
            let equations = self.assemble(lines.clone(), Some(&trial), control)?;
            let net = self.solve(&equations, smoothing, control)?;
            if self.seems_to_meet(&net, control.pool()) {
                *factors = trial;
                return Ok(Some(net));
            }
            if net.errors.demand > WORTH_WEIGHING * tolerance {
                break;
            }
            for (datum, (factor, error)) in trial.iter_mut().zip(&net.errors.each).enumerate() {
                let demand = self.problem.standards.factor(datum) * error;
                *factor *= (demand / (WEIGH_FROM * tolerance)).clamp(1.0, MOST_WEIGHT).powi(3);
            }
            let mean = trial.iter().sum::<f64>() / trial.len() as f64;
            trial.iter_mut().for_each(|factor| *factor /= mean);
        }
        Ok(None)
    }

    /// The inner lines but those that are to stay, the least important first.
    fn ranked(&self, net: &Net, kept: &[Vec<f64>; 2]) -> Vec<Line> {
        let mut ranked: Vec<Line> = (0..2)
            .flat_map(|axis| {
                let breaks = net.lines[axis].breaks();
                (1..breaks.len() - 1)
                    .filter(move |&index| !kept[axis].contains(&breaks[index]))
                    .map(move |index| Line { axis, index, rank: rank(net, axis, index) })
            })
            .collect();
        ranked.sort_by(|a, b| a.rank.total_cmp(&b.rank));
        ranked
    }
}

/// What a line is worth for each of its coefficients.
fn rank(net: &Net, axis: usize, index: usize) -> f64 {
    let (lines, across) = (&net.lines[axis], net.lines[1 - axis].len());
    let dim = net.surface.control_points().len() / (lines.len() * across);
    let points = net.surface.control_points();
    let third = |cell: usize| {
        let scale = lines.length(cell).powi(-3);
        lines.window(cell, 0.0, 3).weights.map(|weight| weight * scale)
    };
    let (before, after) = (third(index - 1), third(index));
    // five functions reach across the line
    let weights: [f64; 5] = std::array::from_fn(|k| {
        let after = if k > 0 { after[k - 1] } else { 0.0 };
        let before = before.get(k).copied().unwrap_or(0.0);
        after - before
    });
    let mut jumps: Vec<f64> = (0..across)
        .map(|j| {
            let component = |c: usize| {
                let at = |k: usize| match axis {
                    0 => points[((index - 1 + k) * across + j) * dim + c],
                    _ => points[(j * lines.len() + index - 1 + k) * dim + c],
                };
                weights.iter().enumerate().map(|(k, weight)| weight * at(k)).sum::<f64>()
            };
            (0..dim).map(|c| component(c).powi(2)).sum::<f64>()
        })
        .collect();
    let place = ((jumps.len() - 1) as f64 * PERCENTILE) as usize;
    let (_, jump, _) = jumps.select_nth_unstable_by(place, f64::total_cmp);
    let gap = 2.0 / (1.0 / lines.length(index - 1) + 1.0 / lines.length(index));
    jump.sqrt() * gap.powi(3) / across as f64
}

/// The first `count` lines, without any whose neighbour is among them.
fn without_neighbours(ranked: &[Line], count: usize) -> Vec<Line> {
    let mut batch: Vec<Line> = Vec::with_capacity(count);
    for line in ranked {
        if batch.len() == count {
            break;
        }
        let is_neighbour = |other: &Line| other.axis == line.axis && other.index.abs_diff(line.index) == 1;
        if !batch.iter().any(is_neighbour) {
            batch.push(*line);
        }
    }
    batch
}

/// The lines without those of a batch.
fn without(lines: &[Lines; 2], batch: &[Line]) -> Result<[Lines; 2], FitError> {
    let rest = |axis: usize| {
        let is_left = |index: usize| !batch.iter().any(|line| line.axis == axis && line.index == index);
        let breaks = lines[axis].breaks().iter().enumerate();
        let breaks = breaks.filter(|&(index, _)| is_left(index)).map(|(_, &u)| u).collect();
        Lines::new(breaks).map_err(|_| FitError::Singular)
    };
    Ok([rest(0)?, rest(1)?])
}
