//! What a PHT fit may be asked for.

use crate::fit::common::checks::{check_option, check_smoothing, check_tolerance, check_unused};
use crate::fit::common::report::Tolerance;
use crate::fit::common::{Demands, FitError, Missing, Regularize, Sides, Symmetry};
use crate::options::with_fields;
use crate::parameterize::ParameterizeOptions;
use crate::tmesh::{MAX_GRID, MAX_LEVEL};

/// What determines the jets at the basis vertices.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Estimator {
    /// Least squares over all data with a weak plate energy: fewest coefficients.
    #[default]
    Global,
    /// A quadratic fit around each datum, interpolated linearly (the paper): for comparison.
    LocalQuadratic,
    /// A weighted cubic fit around each basis vertex: no system to solve, for very large data.
    LocalCubic,
}

/// How smooth the surface is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Continuity {
    /// One continuous derivative: four unknowns at each vertex, local cells, the fastest fit.
    #[default]
    C1,
    /// Two continuous derivatives: truncated hierarchical B-splines, one unknown for each function. Fewest coefficients.
    C2,
}

/// Whether cells are merged again as long as the tolerance is met.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Coarsening {
    /// Where the surface is C2.
    #[default]
    Auto,
    /// Yes.
    On,
    /// No.
    Off,
}

/// Fits that coarsening may take: of 10 to 80 it gains little beyond.
pub(super) const COARSENING_SOLVES: usize = 40;

/// Options of PHT fits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PhtOptions<'a> {
    /// The largest error allowed at the data.
    pub tolerance: Tolerance,
    /// How smooth the surface is. Two continuous derivatives need [`Estimator::Global`].
    pub continuity: Continuity,
    /// Whether cells are merged again as long as the tolerance is met, at the cost of up to 40 further fits.
    pub coarsening: Coarsening,
    /// What determines the jets.
    pub estimator: Estimator,
    /// Weight of the plate energy of each cell, mapped to the unit cell; of [`Estimator::Global`]. Default 1e-3:
    /// ten times more flattens, a hundred times less lets the surface swing where a cell has few data. Where cells
    /// cannot be split any more it is lowered. Of [`Continuity::C2`], 1e-8 of it weighs one plate over the domain against
    /// the mean square error.
    pub smoothing: f64,
    /// Cells to start from, along u and v; a fit that is [`Continuity::C2`] tries several grids if this is at its default.
    pub initial_grid: [usize; 2],
    /// Deepest level of a cell.
    pub max_level: u32,
    /// Most cells.
    pub max_cells: usize,
    /// A cell with fewer samples is not split: nodes, and middles of triangles. For [`Continuity::C2`] each counts four
    /// times, as functions have the samples of four cells.
    pub min_samples: usize,
    /// Levels by which cells that share an edge may differ; 0 for any number, as always for [`Continuity::C2`].
    pub grade: u32,
    /// Sweeps of parameter correction in each round, for shapes of meshes; for [`Continuity::C2`] in those of a fit that is C1
    /// and comes first.
    pub correction_sweeps: usize,
    /// What to do with parameters that came with the mesh.
    pub regularize: Regularize,
    /// How a mesh without parameters gets them; None for a circle, with one stretch step unless the tolerance is
    /// fine and the plain map even.
    pub parameterize: Option<ParameterizeOptions>,
    /// A positive weight for each datum.
    pub weights: Option<&'a [f64]>,
    /// What single data demand.
    pub demands: Demands<'a>,
    /// Sides that are given, by [`Estimator::Global`]: their lines are among those of the first grid.
    pub sides: Sides<'a>,
    /// Whether to measure the closest-point distance of the nodes.
    pub measure_distance: bool,
    /// What values of points and fields mean that are NaN.
    pub missing: Missing,
}

impl Default for PhtOptions<'_> {
    fn default() -> Self {
        Self {
            tolerance: Tolerance::default(),
            continuity: Continuity::default(),
            coarsening: Coarsening::default(),
            estimator: Estimator::default(),
            smoothing: 1e-3,
            initial_grid: [1, 1],
            max_level: 12,
            max_cells: 200_000,
            min_samples: 2,
            grade: 1,
            correction_sweeps: 1,
            regularize: Regularize::default(),
            parameterize: None,
            weights: None,
            demands: Demands::default(),
            sides: Sides { curves: [None; 4], neighbours: [None; 4] },
            measure_distance: false,
            missing: Missing::default(),
        }
    }
}

impl<'a> PhtOptions<'a> {
    with_fields! {
        with_tolerance tolerance: Tolerance,
        with_continuity continuity: Continuity,
        with_coarsening coarsening: Coarsening,
        with_estimator estimator: Estimator,
        with_smoothing smoothing: f64,
        with_initial_grid initial_grid: [usize; 2],
        with_max_level max_level: u32,
        with_max_cells max_cells: usize,
        with_min_samples min_samples: usize,
        with_grade grade: u32,
        with_correction_sweeps correction_sweeps: usize,
        with_regularize regularize: Regularize,
        with_parameterize parameterize: Option<ParameterizeOptions>,
        with_weights weights: Option<&'a [f64]>,
        with_demands demands: Demands<'a>,
        with_sides sides: Sides<'a>,
        with_measure_distance measure_distance: bool,
        with_missing missing: Missing,
    }

    pub(super) fn check(&self) -> Result<(), FitError> {
        check_tolerance(&self.tolerance)?;
        check_smoothing(self.smoothing, true)?;
        if self.estimator != Estimator::Global {
            check_unused(self.demands.fixed.is_empty(), "fixed", "local estimators")?;
            check_unused(self.sides.are_free(), "sides", "local estimators")?;
        }
        if self.continuity == Continuity::C2 {
            const BY: &str = "a fit with two continuous derivatives";
            check_unused(self.estimator == Estimator::Global, "estimator", BY)?;
            check_unused(self.demands.symmetry == Symmetry::None, "symmetry", BY)?;
            check_unused(self.sides.are_free(), "sides", BY)?;
        }
        for count in self.initial_grid {
            let holds = (1..=MAX_GRID).contains(&count);
            check_option(holds, "initial_grid", count as f64, "between 1 and 4095")?;
        }
        let (level, most, samples) = (self.max_level, self.max_cells, self.min_samples);
        let least = self.initial_grid[0] * self.initial_grid[1];
        check_option(level <= MAX_LEVEL, "max_level", f64::from(level), "at most 20")?;
        check_option(most >= least, "max_cells", most as f64, "at least the initial cells")?;
        check_option(samples >= 1, "min_samples", samples as f64, "at least 1")
    }
}
