//! The fit on one grid: least squares at a fixed smoothing, the ladder of smoothings, the measure.

use super::candidate::Candidate;
use super::refine::DATA_PER_UNKNOWN;
use super::tame::Emptiness;
use super::{Ends, FitError, Method, Problem, SMOOTHING_LADDER};
use crate::control::{Pool, Watch};
use crate::fit::common::samples::{in_cells, interior_weight};
use crate::fit::common::tame::{CutCells, TENSE_WITHIN};
use crate::fit::common::uniform::energy::EnergyTerm;
use crate::fit::common::uniform::ferguson;
use crate::fit::common::uniform::grid::{Direction, UniformBasis, UniformGrid};
use crate::fit::common::uniform::normal_equations::{NormalEquations, Samples, TensorBasis};
use crate::knots::KnotVector;
use crate::linalg::{Conditions, SymbolicCholesky};
use crate::surface::Surface;
use crate::surface::tensor::TensorSurface;
use std::borrow::Cow;

impl Problem<'_> {
    /// The grid over the data with this many knots.
    pub(super) fn grid(&self, counts: [usize; 2]) -> [UniformGrid; 2] {
        let (min, max) = (self.data_box.min, self.data_box.max);
        [
            UniformGrid::over(min.x, max.x, self.options.buffer, counts[0]),
            UniformGrid::over(min.y, max.y, self.options.buffer, counts[1]),
        ]
    }

    /// The unknowns of a grid.
    pub(super) fn coefficient_count(&self, counts: [usize; 2]) -> usize {
        let extra = if self.options.ends == Ends::Free { 2 } else { 0 };
        counts.iter().map(|count| count + extra).product()
    }

    /// Fits and measures on one grid. `watch` may end it early.
    pub(super) fn fit_grid(
        &self,
        counts: [usize; 2],
        pool: &Pool,
        watch: &Watch,
    ) -> Result<Candidate, FitError> {
        match self.options.method {
            Method::LeastSquares => LeastSquares::new(self, counts, pool, watch)?.fit_ladder(),
            Method::Ferguson => self.fit_ferguson(counts, pool, watch),
        }
    }

    /// The fit on one grid with a smoothing once more, with so many times the tension that makes a membrane of the
    /// cells without data.
    pub(super) fn fit_tense(
        &self,
        counts: [usize; 2],
        cut: CutCells,
        [smoothing, tension]: [f64; 2],
        pool: &Pool,
        watch: &Watch,
    ) -> Result<Candidate, FitError> {
        let squares = LeastSquares::new(self, counts, pool, watch)?;
        let breaks = squares.grid().map(|grid| (0..grid.count).map(|k| grid.knot(k)).collect::<Vec<f64>>());
        let cells = counts.map(|count| TENSE_WITHIN * (count - 1) as f64);
        let Emptiness { parts, is_empty } = self.emptiness([&breaks[0], &breaks[1]], cut, &self.trims());
        let tension = Tension {
            equations: NormalEquations::tension(squares.basis, self.dim, &parts, &is_empty),
            weight: tension / (cells[0] * cells[1]),
        };
        squares.fit(smoothing, Some(&tension))
    }

    fn fit_ferguson(&self, counts: [usize; 2], pool: &Pool, watch: &Watch) -> Result<Candidate, FitError> {
        let grid = self.grid(counts);
        let smoothing =
            if self.options.smoothing > 0.0 { self.options.smoothing } else { SMOOTHING_LADDER[0] };
        let values = self.frame.inward(self.values);
        watch.check()?;
        let mut control_points = ferguson::fit(&grid, &self.uv, &values, self.dim, smoothing)?;
        self.frame.outward(&mut control_points);
        let surface = self.surface(&grid, control_points)?;
        Ok(Candidate {
            errors: self.errors(&surface, pool),
            grid,
            surface,
            smoothing,
            coefficient_count: counts[0] * counts[1],
        })
    }

    /// The surface with these control points over the knots of a grid.
    fn surface(&self, grid: &[UniformGrid; 2], control_points: Vec<f64>) -> Result<TensorSurface, FitError> {
        let knots = |grid: &UniformGrid| -> Result<KnotVector, FitError> {
            grid.knot_vector().map_err(|_| FitError::DegenerateRange { axis: 'u', at: grid.start })
        };
        let (knots_u, knots_v) = (knots(&grid[0])?, knots(&grid[1])?);
        let surface = TensorSurface::new(self.dim, knots_u, knots_v, control_points, None);
        // an overflow in the solution is the one thing that can be wrong
        let mut surface = surface.map_err(|_| FitError::Singular)?;
        *surface.region_mut() = self.region();
        Ok(surface)
    }
}

/// The normal equations of one grid, ready to be solved with any smoothing.
struct LeastSquares<'a> {
    problem: &'a Problem<'a>,
    pool: &'a Pool,
    watch: &'a Watch,
    basis: TensorBasis,
    nodes: NormalEquations,
    /// Of places inside large triangles.
    interior: Option<NormalEquations>,
    energy: Vec<EnergyTerm>,
    conditions: Vec<Conditions>,
    symbolic: SymbolicCholesky,
}

/// Tension over the cells without data.
struct Tension {
    equations: NormalEquations,
    /// Against the energy.
    weight: f64,
}

impl<'a> LeastSquares<'a> {
    fn new(
        problem: &'a Problem<'a>,
        counts: [usize; 2],
        pool: &'a Pool,
        watch: &'a Watch,
    ) -> Result<Self, FitError> {
        let grid = problem.grid(counts);
        let [u, v] = grid.map(|grid| UniformBasis { grid, ends: problem.options.ends });
        let basis = TensorBasis { u, v };
        let (dim, values) = (problem.dim, problem.frame.inward(problem.values));
        let nodes = Samples { uv: &problem.uv, values: &values, dim, weights: problem.weights.as_deref() };
        watch.check()?;
        let nodes = NormalEquations::assemble(basis, &nodes, pool);
        watch.check()?;
        let data = problem.interior_data(in_cells(&grid), &values);
        let interior = Samples { uv: &data.uv, values: &data.values, dim, weights: Some(&data.weights) };
        let interior = (!data.uv.is_empty()).then(|| NormalEquations::assemble(basis, &interior, pool));
        watch.check()?;
        let conditions = problem.standards.conditions(&problem.uv, (&values, dim), |uv| basis.terms(uv));
        let symbolic = nodes.analyse();
        let energy = problem.energy.terms(&u, &v);
        Ok(Self { problem, pool, watch, basis, nodes, interior, energy, conditions, symbolic })
    }

    fn grid(&self) -> [UniformGrid; 2] {
        [self.basis.u.grid, self.basis.v.grid]
    }

    /// The calmest fit that meets the tolerance at the data, or the closest one if none does; a calmer one where that
    /// swings between them.
    fn fit_ladder(&self) -> Result<Candidate, FitError> {
        let asked = self.problem.options.smoothing;
        if asked > 0.0 { self.fit(asked, None) } else { self.calmed(self.at_the_data()?) }
    }

    /// The calmest fit that meets the tolerance at the data, or the closest one if none does.
    ///
    /// The closest is tried first: where it misses by more than the others could make good, they are not tried.
    fn at_the_data(&self) -> Result<Candidate, FitError> {
        let (closest, calmer) = SMOOTHING_LADDER.split_last().expect("the ladder has steps");
        let closest = self.fit(*closest, None)?;
        let tolerance = self.problem.goal.tolerance;
        // more smoothing lowers a maximum now and then, by a little
        const WORTH_TRYING: f64 = 1.1;
        if closest.errors.demand > WORTH_TRYING * tolerance {
            return Ok(closest);
        }
        for &smoothing in calmer {
            let candidate = self.fit(smoothing, None)?;
            if candidate.errors.demand <= tolerance {
                return Ok(candidate);
            }
        }
        Ok(closest)
    }

    /// A fit, or of it and calmer ones the one that is nearest where it is farthest, if that is between the data and beyond
    /// the tolerance. A grid of far fewer unknowns than data does not swing there.
    fn calmed(&self, nearest: Candidate) -> Result<Candidate, FitError> {
        if DATA_PER_UNKNOWN * nearest.coefficient_count as f64 <= self.problem.uv.len() as f64 {
            return Ok(nearest);
        }
        let farthest = |candidate: &Candidate| {
            let between = self.problem.interior_errors(&candidate.surface, self.pool).max_smooth_excess;
            between.max(candidate.errors.demand)
        };
        let (mut least, smoothing) = (farthest(&nearest), nearest.smoothing);
        let calmer = SMOOTHING_LADDER.iter().rev().filter(|&&calmer| calmer > smoothing);
        let mut best = nearest;
        for &smoothing in calmer {
            if least <= best.errors.demand.max(self.problem.goal.tolerance) {
                break;
            }
            let candidate = self.fit(smoothing, None)?;
            // still calmer ones are farther from the data
            if candidate.errors.demand >= least {
                break;
            }
            let distance = farthest(&candidate);
            if distance < least {
                (best, least) = (candidate, distance);
            }
        }
        Ok(best)
    }

    fn fit(&self, smoothing: f64, tension: Option<&Tension>) -> Result<Candidate, FitError> {
        let problem = self.problem;
        self.watch.check()?;
        let mut equations = match &self.interior {
            None => Cow::Borrowed(&self.nodes),
            Some(interior) => Cow::Owned(self.nodes.plus(interior, interior_weight(smoothing))),
        };
        if let Some(tension) = tension {
            equations = Cow::Owned(equations.plus(&tension.equations, smoothing / 12.0 * tension.weight));
        }
        self.watch.check()?;
        let factor = equations.factor(&self.symbolic, smoothing / 12.0, &self.energy);
        self.watch.check()?;
        let unknowns = equations.solve(&factor.map_err(|_| FitError::Singular)?, &self.conditions);
        self.watch.check()?;
        let grid = self.grid();
        let mut control_points = control_points(&self.basis, &unknowns, problem.dim);
        problem.frame.outward(&mut control_points);
        let surface = problem.surface(&grid, control_points)?;
        Ok(Candidate {
            errors: problem.errors(&surface, self.pool),
            grid,
            surface,
            smoothing,
            coefficient_count: self.basis.len(),
        })
    }
}

/// From columns of unknowns, one for each component, to rows of control points.
fn control_points(basis: &TensorBasis, unknowns: &[f64], dim: usize) -> Vec<f64> {
    let (n, count_v) = (basis.len(), basis.v.len());
    let rows: Vec<f64> =
        (0..n).flat_map(|i| (0..dim).map(move |k| (i, k))).map(|(i, k)| unknowns[k * n + i]).collect();
    let along_u = basis.u.control_points(&rows, count_v * dim);
    along_u.chunks_exact(count_v * dim).flat_map(|line| basis.v.control_points(line, dim)).collect()
}
