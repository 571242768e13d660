//! How fits with two continuous derivatives grow: from several initial grids, and by single functions.
//!
//! A cell that is split alone adds no function: one of the next level is there when the four by four cells of its support
//! are. For a datum that misses the tolerance the least that helps are two by two cells around it, so chosen that it
//! lies in the middle half of the new function's support.
//! ```text
//! +-------+-------+      x misses the tolerance, in the upper right quarter of its cell:
//! |       |       |      that cell and those to the right and above are split, and with
//! |       |       |      them the function over all four is there
//! +-------+-------+
//! |     x |       |
//! |       |       |
//! +-------+-------+
//! ```

use super::PhtOptions;
use super::refine::{LeafErrors, NoiseTest, Refinement, Round};
use crate::control::Control;
use crate::fit::common::FitError;
use crate::fit::common::report::StopReason;
use crate::fit::common::rounds::{self, Outcome};
use crate::surface::Surface;
use crate::tmesh::{Cell, NodeId, QUADRANTS, TMesh};

/// The weight of the plate over the domain, mapped to a square, against the mean square error, by the smoothing that is asked
/// for: 1e-11 by default. A tenth leaves surfaces that swing between their data by up to twice the tolerance, ten times
/// as much asks for a third more coefficients on steep ridges.
pub(super) const PLATE_SHARE: f64 = 1e-8;
/// Where splits do not help, the plate's weight is lowered by this factor,
pub(super) const SMOOTH_STEP: f64 = 0.1;
/// to no less than this share of the one asked for: with less, surfaces swing between the data.
pub(super) const SMOOTH_LEAST: f64 = 1e-2;

/// Two rounds that leave more than this share of the error have not helped.
const STALLED: f64 = 0.95;
/// Where the tolerance is missed, cells are split that use up more than this share of it: half the rounds, and few
/// functions more.
const MARGIN: f64 = 0.8;

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

/// Splits the two by two cells around each quarter of a leaf in which an error is too large.
pub(super) fn split_around<E>(
    mesh: &mut TMesh,
    leaf: &LeafErrors,
    tolerance: f64,
    allow: &mut impl FnMut(&TMesh, NodeId) -> Result<(), E>,
) -> Result<(), E> {
    let doubt = if leaf.error > 0.0 { leaf.expected / leaf.error } else { 1.0 };
    for (error, quadrant) in leaf.quarters.into_iter().zip(QUADRANTS) {
        if doubt * error <= MARGIN * tolerance {
            continue;
        }
        for other in QUADRANTS {
            let Cell { level, i, j } = leaf.cell;
            // the lower left cell of the four is one to the left, or below, where the quarter is the left or lower one
            let along = |at: u32, near: u32, far: u32| (at + near + far).checked_sub(1);
            let (i, j) = (along(i, quadrant[0], other[0]), along(j, quadrant[1], other[1]));
            if let (Some(i), Some(j)) = (i, j) {
                split_cell(mesh, Cell { level, i, j }, allow)?;
            }
        }
    }
    Ok(())
}

/// Splits a cell, and before it those that it is a part of; nothing beyond the border.
fn split_cell<E>(
    mesh: &mut TMesh,
    cell: Cell,
    allow: &mut impl FnMut(&TMesh, NodeId) -> Result<(), E>,
) -> Result<(), E> {
    if mesh.find(cell).is_none() {
        match cell.parent() {
            Some(parent) => split_cell(mesh, parent, allow)?,
            None => return Ok(()),
        }
    }
    match mesh.find(cell).filter(|&node| mesh.is_leaf(node)) {
        Some(leaf) => {
            allow(mesh, leaf)?;
            mesh.split(leaf);
            Ok(())
        }
        None => Ok(()),
    }
}
