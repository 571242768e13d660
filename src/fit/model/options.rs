//! What a fit of a model may be asked for.

use super::split::{DEEPEST_LEVEL, LEAST_SAMPLES};
use crate::fit::common::FitError;
use crate::fit::common::checks::{check_option, check_smoothing, check_tolerance};
use crate::fit::common::report::Tolerance;
use crate::options::with_fields;
use crate::tmesh::MAX_LEVEL;

/// Options of fits over a layout.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ModelOptions {
    /// The largest error allowed at the nodes.
    pub tolerance: Tolerance,
    /// Weight of the plate energy of each cell, mapped to the unit cell. Default 1e-4; ten times more changes little.
    pub smoothing: f64,
    /// Level of the cells to start from; 0 takes 3 for a cube and 2 for any other layout. 1 is the least that
    /// layouts of mixed valences allow.
    pub start_level: u32,
    /// Deepest level of a cell.
    pub max_level: u32,
    /// Most cells of all patches, beside those that patches need to meet.
    pub max_cells: usize,
    /// A cell with fewer samples is not split, as long as others help: nodes, centroids of facets, middles of edges.
    pub min_samples: usize,
    /// Levels by which cells of a patch that share an edge may differ; 0 for any number.
    pub grade: u32,
    /// Steps towards the foot points in each round.
    pub foot_steps: u32,
    /// Whether cells with few samples are held to the mesh between them.
    pub guard: bool,
    /// Most rounds.
    pub max_rounds: usize,
}

impl Default for ModelOptions {
    fn default() -> Self {
        Self {
            tolerance: Tolerance::default(),
            smoothing: 1e-4,
            start_level: 0,
            max_level: DEEPEST_LEVEL,
            max_cells: 200_000,
            min_samples: LEAST_SAMPLES,
            grade: 1,
            foot_steps: 1,
            guard: true,
            max_rounds: 20,
        }
    }
}

impl ModelOptions {
    with_fields! {
        with_tolerance tolerance: Tolerance,
        with_smoothing smoothing: f64,
        with_start_level start_level: u32,
        with_max_level max_level: u32,
        with_max_cells max_cells: usize,
        with_min_samples min_samples: usize,
        with_grade grade: u32,
        with_foot_steps foot_steps: u32,
        with_guard guard: bool,
        with_max_rounds max_rounds: usize,
    }

    pub(super) fn check(&self, quads: usize) -> Result<(), FitError> {
        check_tolerance(&self.tolerance)?;
        check_smoothing(self.smoothing, true)?;
        let (start, level, cells) = (self.start_level, self.max_level, self.max_cells);
        check_option(level <= MAX_LEVEL, "max_level", f64::from(level), "at most 20")?;
        check_option(
            start <= level.min(MOST_START),
            "start_level",
            f64::from(start),
            "at most max_level and 8",
        )?;
        let first = quads.saturating_mul(1 << (2 * start));
        check_option(cells >= first, "max_cells", cells as f64, "at least the initial cells")?;
        check_option(self.min_samples >= 1, "min_samples", self.min_samples as f64, "at least 1")?;
        check_option(self.foot_steps <= MOST_STEPS, "foot_steps", f64::from(self.foot_steps), "at most 100")?;
        check_option(self.max_rounds >= 1, "max_rounds", self.max_rounds as f64, "at least 1")
    }
}

/// Deepest level to start from: 65,536 cells a patch.
const MOST_START: u32 = 8;
/// Most steps to foot points a round; one does.
const MOST_STEPS: u32 = 100;
