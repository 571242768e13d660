//! Fewer cells: those that are not needed are merged again, many at a time, as long as the tolerance is met.
//!
//! Growth splits where the error of a fit over larger cells was; once all is split, many of the first cells are no longer
//! needed. Those with the least errors around them are merged, the rest is fitted anew, and where that misses the tolerance
//! the nearest merged cells are split again, for good.
//! ```text
//! repeat   merge the share of cells with the least errors in their neighbourhood
//!          repeat   fit; where it misses the tolerance, split those merged nearby, in a growing ring
//!          where nothing is gained, halve the share
//! ```
//! Between scattered data the surface is watched by some that are withheld from the fits, but must be met.

use super::leaf::LeafErrors;
use super::options::{COARSENING_SOLVES, Coarsening};
use super::refine::{Refinement, Round};
use super::{Continuity, Estimator};
use crate::control::Control;
use crate::fit::common::FitError;
use crate::fit::common::rounds::Outcome;
use crate::surface::Surface;
use crate::tmesh::{Cell, QUADRANTS, TMesh};
use std::collections::{BTreeMap, BTreeSet};

/// Share of the cells that could be merged that are, at first: more saves fits on smooth data, and wastes them on rough.
const FIRST_SHARE: f64 = 0.5;
/// Widths of a merged cell within which a miss is laid at its door.
const FARTHEST: u32 = 4;
/// One of so many scattered data is withheld.
const WITHHELD: usize = 12;
/// With fewer data none is: each is needed.
const LEAST_DATA: usize = 1000;

impl Refinement<'_> {
    /// A fit over as few cells as meet the tolerance that it meets; the same where it does not.
    pub(super) fn coarsened(
        &mut self,
        grown: Outcome<Round>,
        control: &mut Control,
    ) -> Result<Outcome<Round>, FitError> {
        let options = self.options;
        let is_asked_for = match options.coarsening {
            Coarsening::Auto => options.continuity == Continuity::C2,
            Coarsening::On => true,
            Coarsening::Off => false,
        };
        let is_met = grown.best.error() <= self.goal.tolerance;
        if !is_asked_for || !is_met || options.estimator != Estimator::Global {
            return Ok(grown);
        }
        let refined_count = grown.best.refined_count;
        self.data.uv.clone_from(&grown.best.uv);
        self.known.renew();
        let (coarse, solves) = match self.withhold() {
            Some(weights) => self.merge_watched(grown.best, weights, control)?,
            None => self.merge_rounds(grown.best, control)?,
        };
        Ok(Outcome {
            best: Round { refined_count, ..coarse },
            stop: grown.stop,
            passes: grown.passes + solves,
        })
    }

    /// Merges cells while some data are withheld, and fits once more to all, which have these `weights`.
    fn merge_watched(
        &mut self,
        round: Round,
        weights: Vec<f64>,
        control: &mut Control,
    ) -> Result<(Round, usize), FitError> {
        let watched = self.fit_over(round.surface.mesh(), round.smoothing, control)?;
        if !(watched.error() <= self.goal.tolerance) {
            // the rest of the data do not suffice
            self.use_all_data(weights);
            return self.merge_rounds(round, control);
        }
        let (coarse, solves) = self.merge_rounds(watched, control)?;
        self.use_all_data(weights);
        let whole = self.fit_over(coarse.surface.mesh(), coarse.smoothing, control)?;
        let is_met = whole.error() <= self.goal.tolerance;
        Ok((if is_met { whole } else { coarse }, solves + 2))
    }

    /// Gives the data back their weights.
    fn use_all_data(&mut self, weights: Vec<f64>) {
        self.data.sample_weights = weights;
        self.known.renew();
    }

    /// Merges cells until nothing is gained any more.
    fn merge_rounds(&mut self, round: Round, control: &mut Control) -> Result<(Round, usize), FitError> {
        let (mut best, mut share, mut solves) = (round, FIRST_SHARE, 0);
        let mut needed: BTreeSet<Cell> = BTreeSet::new();
        let mut before = best.surface.coefficient_count();
        while solves < COARSENING_SOLVES {
            let mut merged = self.candidates(&best, &needed);
            merged.truncate((share * merged.len() as f64).ceil() as usize);
            let count = merged.len();
            let trial = self.merge(&best, merged, (&mut needed, &mut solves), control)?;
            match trial {
                // fewer cells may have as many functions, but those around them may then be merged
                Some(trial) if trial.leaves.len() < best.leaves.len() => best = trial,
                _ if count > 1 => share /= 2.0,
                // what was needed beside others may not be now
                _ if best.surface.coefficient_count() < before => {
                    before = best.surface.coefficient_count();
                    share = FIRST_SHARE;
                    needed.clear();
                }
                _ => break,
            }
        }
        Ok((best, solves))
    }

    /// The fit without some crosses, or without those of them that are not needed; these are taken down.
    fn merge(
        &mut self,
        round: &Round,
        mut merged: Vec<Cell>,
        (needed, solves): (&mut BTreeSet<Cell>, &mut usize),
        control: &mut Control,
    ) -> Result<Option<Round>, FitError> {
        for ring in 0..=FARTHEST {
            if merged.is_empty() || *solves >= COARSENING_SOLVES {
                break;
            }
            *solves += 1;
            let mesh = self.without(round.surface.mesh(), &merged);
            let trial = self.fit_over(&mesh, round.smoothing, control)?;
            let misses: Vec<[u32; 4]> = trial.leaves.iter().flat_map(|leaf| self.misses(leaf)).collect();
            if misses.is_empty() {
                return Ok(Some(trial));
            }
            let is_near = |cell: &Cell| {
                let around = around(*cell, ring);
                misses.iter().any(|miss| (0..2).all(|k| miss[k] <= around[k + 2] && around[k] <= miss[k + 2]))
            };
            needed.extend(merged.iter().copied().filter(is_near));
            merged.retain(|cell| !needed.contains(cell));
        }
        Ok(None)
    }

    /// A mesh without some crosses; those stay that neighbours need which may not be much finer.
    fn without(&self, mesh: &TMesh, cells: &[Cell]) -> TMesh {
        let is_graded = self.options.continuity == Continuity::C1 && self.options.grade > 0;
        let mut coarse = mesh.clone();
        for &cell in cells {
            let Some(node) = coarse.find(cell).filter(|&node| coarse.is_mergeable(node)) else { continue };
            let finest = cell.level + self.options.grade;
            let mut beside =
                coarse.children(node).into_iter().flatten().flat_map(|child| coarse.neighbours(child));
            if !is_graded || beside.all(|other| coarse.cell(other).level <= finest) {
                coarse.merge(node);
            }
        }
        coarse
    }

    fn fit_over(&mut self, mesh: &TMesh, smoothing: f64, control: &mut Control) -> Result<Round, FitError> {
        let mut known = std::mem::take(&mut self.known);
        let this = &*self;
        let fit = control
            .watch(|pool, watch| this.over(mesh, &mut known, (smoothing, &|_, _| Vec::new()), pool, watch));
        self.known = known;
        fit?
    }

    /// The quarters of a leaf that miss the tolerance: least and largest coordinates of each.
    fn misses(&self, leaf: &LeafErrors) -> impl Iterator<Item = [u32; 4]> + use<> {
        let tolerance = self.goal.tolerance;
        let quarters = leaf.quarters.into_iter().zip(quarters_of(leaf.cell));
        quarters.filter(move |(error, _)| !(*error <= tolerance)).map(|(_, quarter)| quarter)
    }

    /// Cells whose quarters are leaves and may be merged, those with the least errors around them first.
    fn candidates(&self, round: &Round, needed: &BTreeSet<Cell>) -> Vec<Cell> {
        let mesh = round.surface.mesh();
        let mut peaks: BTreeMap<Cell, f64> = BTreeMap::new();
        for leaf in &round.leaves {
            for cell in std::iter::successors(Some(leaf.cell), |cell| cell.parent()) {
                let peak = peaks.entry(cell).or_default();
                *peak = peak.max(leaf.error);
            }
        }
        let peak = |cell: Cell| {
            std::iter::successors(Some(cell), |cell| cell.parent()).find_map(|cell| peaks.get(&cell)).copied()
        };
        let score = |cell: Cell| {
            let at = |i: u32, a: u32| (i + a).checked_sub(1);
            let around = (0..9).filter_map(|k| Some((at(cell.i, k / 3)?, at(cell.j, k % 3)?)));
            around.filter_map(|(i, j)| peak(Cell { i, j, ..cell })).fold(0.0, f64::max)
        };
        let is_mergeable = |cell: &Cell| mesh.find(*cell).is_some_and(|node| mesh.is_mergeable(node));
        let cells = mesh.splits().filter(|cell| !needed.contains(cell)).filter(is_mergeable);
        let mut scored: Vec<(f64, Cell)> = cells.map(|cell| (score(cell), cell)).collect();
        scored.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        scored.into_iter().map(|(_, cell)| cell).collect()
    }

    /// Withholds some of many scattered data from the fits that follow; the weights of all as they were.
    fn withhold(&mut self) -> Option<Vec<f64>> {
        let count = self.data.uv.len();
        if self.data.mesh.is_some() || count < LEAST_DATA {
            return None;
        }
        let before = self.data.sample_weights.clone();
        self.data.sample_weights.resize(count, 1.0);
        // neighbours in the plane are neighbours in their order
        let fixed = &self.data.standards.fixed;
        let withheld =
            (WITHHELD / 2..count).step_by(WITHHELD).filter(|datum| fixed.binary_search(datum).is_err());
        withheld.for_each(|datum| self.data.sample_weights[datum] = 0.0);
        Some(before)
    }
}

/// Least and largest coordinates of the quarters of a cell.
fn quarters_of(cell: Cell) -> [[u32; 4]; 4] {
    let half = cell.side() / 2;
    let low = cell.corners()[0];
    QUADRANTS.map(|[a, b]| {
        let (i, j) = (low.i + a * half, low.j + b * half);
        [i, j, i + half, j + half]
    })
}

/// Least and largest coordinates of a cell with so many of its widths around it.
fn around(cell: Cell, ring: u32) -> [u32; 4] {
    let [low, _, _, high] = cell.corners();
    let reach = ring * cell.side();
    [low.i.saturating_sub(reach), low.j.saturating_sub(reach), high.i + reach, high.j + reach]
}
