//! The outer loop: estimate, correct, measure, split.

use super::data::Data;
use super::global::{ByLeaf, Energy, KnownSums, System};
use super::{Estimator, PhtFit, PhtOptions, local};
use crate::control::{Control, Pool, Watch};
use crate::fit::common::FitError;
use crate::fit::common::errors::{DataErrors, max_distance};
use crate::fit::common::foot_points::{self, LONGEST_STEP, hold_back};
use crate::fit::common::report::{FitReport, Goal, Remarks, StopReason};
use crate::fit::common::rounds::{self, Next, Outcome, Rounds, Standing};
use crate::fit::common::sides::{side_deviation, side_lines, with_side_lines};
use crate::fit::common::trims;
use crate::fit::common::uniform::energy::FreeFunctions;
use crate::memory;
use crate::surface::pht::{PhtError, PhtSurface};
use crate::surface::{Region, Surface, Trims};
use crate::tmesh::{Cell, MAX_LEVEL, NodeId, TMesh, Topology};
use glam::DVec2;

/// A fit on its way.
pub(super) struct Refinement<'a> {
    pub(super) data: Data<'a>,
    pub(super) options: &'a PhtOptions<'a>,
    pub(super) mesh: TMesh,
    known: KnownSums,
    /// Weight of the energy: that of the options, less where cells cannot be split any more.
    smoothing: f64,
    pub(super) goal: Goal,
    noise: NoiseTest,
}

/// A surface, measured, with the parameters it was made for.
pub(super) struct Round {
    pub surface: PhtSurface,
    pub errors: DataErrors,
    pub uv: Vec<DVec2>,
    /// The leaves in which an error exceeds the tolerance.
    pub rough: Vec<Rough>,
    pub smoothing: f64,
}

/// A leaf that misses the tolerance.
pub(super) struct Rough {
    cell: Cell,
    samples: usize,
    /// The largest error in it.
    pub error: f64,
}

/// Where no cell can be split the energy is lowered by this factor,
const SMOOTHING_STEP: f64 = 1e-2;
/// as long as its weight is above this: far below, rounding decides in cells without data.
const LEAST_SMOOTHING: f64 = 1e-6;

/// Smallest share of its first area that a triangle keeps when its nodes move. Sweeps follow each other; with less
/// the map is crushed here and there, and the surface swings between the nodes: of 0, 0.1, .. 0.75 this needed the
/// fewest coefficients.
const LEAST_AREA: f64 = 0.6;

/// By how much the error at a datum grows when the datum is left out of the fit: `1 / (1 - h)`, its leverage h up to
/// twice the mean, which is the unknowns of a cell by its data (D. Allen, "The relationship between variable
/// selection and data augmentation and a method for prediction", Technometrics 16 (1974)). What lies between
/// scattered data is known no better.
fn left_out_factor(unknowns: f64, samples: usize) -> f64 {
    const MOST: f64 = 2.0;
    (1.0 / (1.0 - 2.0 * unknowns / samples as f64).max(1.0 / MOST)).min(MOST)
}

/// The four unknowns of each corner, shared by the cells that touch it: fewer at the border.
fn unknowns_of(mesh: &TMesh, cell: Cell) -> f64 {
    let (last, [low, _, _, high]) = (mesh.last_vertex(), cell.corners());
    let along = |is_at_border: bool| if is_at_border { 1.5 } else { 1.0 };
    4.0 * along(low.i == 0 || high.i == last.i) * along(low.j == 0 || high.j == last.j)
}

impl Rounds for Refinement<'_> {
    type Round = Round;
    type Error = FitError;

    fn fit(&mut self, control: &mut Control) -> Result<Round, FitError> {
        control.watch(|pool, watch| self.round(pool, watch))?
    }

    fn error(&self, round: &Round) -> f64 {
        round.errors.demand
    }

    fn tolerance(&self) -> f64 {
        self.goal.tolerance
    }

    fn refine(&mut self, standing: &Standing<Round>, _: &Control) -> Next {
        let Some(round) = standing.round else { return Next::Stop(StopReason::Stagnated) };
        if round.rough.is_empty() {
            return Next::Done;
        }
        // noise is no reason to miss what is fixed
        let is_fixed = self.data.standards.fixed.iter().all(|&datum| {
            round.errors.each[datum] * self.data.standards.factor(datum) <= self.goal.tolerance
        });
        let idle_rounds = IDLE_ROUNDS + usize::from(self.data.standards.leaves_out());
        if is_fixed && self.noise.idle_rounds(round) >= idle_rounds {
            return Next::Drop(StopReason::Stagnated);
        }
        let is_met = round.rough.iter().all(|rough| rough.error <= self.goal.tolerance);
        match self.split(round) {
            Ok(()) => Next::Round,
            Err(_) if !is_met && self.smoothing > LEAST_SMOOTHING => {
                // no cell can be split: what is left may be the energy's doing
                self.smoothing *= SMOOTHING_STEP;
                self.noise = NoiseTest::default();
                Next::Round
            }
            Err(_) if is_met => Next::Stop(StopReason::ToleranceMet),
            Err(stop) => Next::Stop(stop),
        }
    }
}

impl<'a> Refinement<'a> {
    pub(super) fn new(mut data: Data<'a>, options: &'a PhtOptions<'a>) -> Result<Self, FitError> {
        if FreeFunctions::of(&data.uv, &data.data_box) == FreeFunctions::Linear {
            return Err(FitError::Singular);
        }
        let (min, max) = (data.data_box.min, data.data_box.max);
        let breaks = |from: f64, to: f64, count: usize| -> Vec<f64> {
            (0..=count)
                .map(|k| if k == count { to } else { from + (to - from) * k as f64 / count as f64 })
                .collect()
        };
        let goal = Goal::new(&options.tolerance, &data.bounds);
        data.demand(&options.demands, &options.tolerance, &goal)?;
        data.give_sides(&options.sides, &goal)?;
        let [count_u, count_v] = options.initial_grid;
        let [lines_u, lines_v] = side_lines(&data.sides);
        let breaks_u = with_side_lines(breaks(min.x, max.x, count_u), &lines_u);
        let breaks_v = with_side_lines(breaks(min.y, max.y, count_v), &lines_v);
        // the box has a range, but no room for more lines than it has roundings
        let mesh = TMesh::new(&breaks_u, &breaks_v)
            .map_err(|_| FitError::DegenerateRange { axis: 'u', at: min.x })?;
        let known = KnownSums::new(!data.is_shape);
        let (smoothing, noise) = (options.smoothing, NoiseTest::default());
        Ok(Self { data, options, mesh, known, smoothing, goal, noise })
    }

    pub(super) fn run(mut self, control: &mut Control) -> Result<PhtFit, FitError> {
        let mut outcome = rounds::run(&mut self, control)?;
        outcome.best = self.tamed(outcome.best, control)?;
        outcome.best.rough.retain(|rough| !(rough.error <= self.goal.tolerance));
        Ok(self.finish(outcome, control))
    }

    /// Estimates on the present mesh, corrects the parameters, measures.
    fn round(&mut self, pool: &Pool, watch: &Watch) -> Result<Round, FitError> {
        let (mesh, topology) = (self.mesh.clone(), Topology::new(&self.mesh));
        let system = match self.options.estimator {
            Estimator::Global => Some(System::new(&mesh, &topology)),
            _ => None,
        };
        let (options, smoothing) = (self.options, self.smoothing);
        let energy = Energy { plate: smoothing, membranes: Vec::new() };
        let mut estimate = |data: &Data, by_leaf: &ByLeaf| -> Result<PhtSurface, FitError> {
            watch.check()?;
            let jets = match &system {
                Some(system) => system.solve(data, by_leaf, &mut self.known, &energy, pool, watch)?,
                None if options.estimator == Estimator::LocalCubic => {
                    local::cubic(data, &mesh, &topology, pool)
                }
                None => local::quadratic(data, &mesh, &topology, pool)?,
            };
            outward(data, &mesh, jets)
        };
        let mut by_leaf = ByLeaf::sort(&mesh, &topology, &self.data, pool);
        let mut surface = estimate(&self.data, &by_leaf)?;
        let sweeps = if self.data.is_shape { options.correction_sweeps } else { 0 };
        for _ in 0..sweeps {
            self.data.uv = moved(&self.data, &surface, pool);
            watch.check()?;
            by_leaf = ByLeaf::sort(&mesh, &topology, &self.data, pool);
            surface = estimate(&self.data, &by_leaf)?;
        }
        let errors = self.data.errors(&surface, pool);
        watch.check()?;
        let rough = self.rough_leaves(&surface, &errors, &by_leaf, pool);
        Ok(Round { surface, errors, uv: memory::copied(&self.data.uv), rough, smoothing })
    }

    /// The leaves that miss the tolerance at a datum, or inside a triangle by more than its sagitta.
    pub(super) fn rough_leaves(
        &self,
        surface: &PhtSurface,
        errors: &DataErrors,
        by_leaf: &ByLeaf,
        pool: &Pool,
    ) -> Vec<Rough> {
        let (mesh, topology, count) = (surface.mesh(), surface.topology(), self.data.uv.len());
        let excesses = self.data.excesses(surface, &by_leaf.uv, pool);
        let miss = |sample: usize| match sample.checked_sub(count) {
            None => errors.each[sample] * self.data.standards.factor(sample),
            Some(triangle) => excesses.get(triangle).copied().unwrap_or(0.0),
        };
        let is_scattered = self.data.mesh.is_none();
        let rough = |(leaf, &node): (usize, &NodeId)| {
            let (cell, samples) = (mesh.cell(node), by_leaf.of(leaf));
            let error = samples.iter().map(|&sample| miss(sample as usize)).fold(0.0, f64::max);
            let unknowns = unknowns_of(mesh, cell);
            let between = if is_scattered { error * left_out_factor(unknowns, samples.len()) } else { error };
            (!(between <= self.goal.tolerance)).then_some(Rough { cell, samples: samples.len(), error })
        };
        topology.leaves.iter().enumerate().filter_map(rough).collect()
    }

    /// Splits the rough cells, or says why none can be split.
    fn split(&mut self, round: &Round) -> Result<(), StopReason> {
        let options = self.options;
        let mut mesh = self.mesh.clone();
        let mut stop = StopReason::DataExhausted;
        let mut allow = |mesh: &TMesh, leaf: NodeId| {
            let fits =
                mesh.cell(leaf).level < options.max_level && mesh.leaf_count() + 3 <= options.max_cells;
            if fits { Ok(()) } else { Err(StopReason::Limit) }
        };
        let grade = if options.grade == 0 { MAX_LEVEL } else { options.grade };
        // where the tolerance is met and only the places between the data are in doubt, quarters shall have as many
        // data as unknowns
        let least = |rough: &&Rough| {
            let is_met = rough.error <= self.goal.tolerance;
            if is_met { options.min_samples.max(16) } else { options.min_samples }
        };
        for rough in round.rough.iter().filter(|rough| rough.samples >= least(rough)) {
            // a neighbour may have split it
            if let Some(leaf) = mesh.find(rough.cell).filter(|&node| mesh.is_leaf(node))
                && let Err(limit) = mesh.split_graded(leaf, grade, &mut allow)
            {
                stop = limit;
            }
        }
        if mesh.leaf_count() == self.mesh.leaf_count() {
            return Err(stop);
        }
        let unknowns = 4 * Topology::new(&mesh).basis.len();
        // between scattered points nothing is known; on a mesh the triangles tell
        if self.data.mesh.is_none() && unknowns > self.data.uv.len().max(64) {
            return Err(StopReason::DataExhausted);
        }
        let is_split = |(datum, &uv): (usize, &DVec2)| {
            let level = |mesh: &TMesh| mesh.cell(mesh.locate(uv)).level;
            !self.data.standards.is_left_out(datum) && level(&mesh) > level(&self.mesh)
        };
        self.noise.before =
            self.data.uv.iter().enumerate().map(is_split).zip(round.errors.each.iter().copied()).collect();
        self.noise.unknowns = (round.surface.coefficient_count(), unknowns);
        self.mesh = mesh;
        Ok(())
    }

    fn finish(mut self, outcome: Outcome<Round>, control: &Control) -> PhtFit {
        let Outcome { best: Round { mut surface, errors, uv, rough, smoothing }, stop, passes } = outcome;
        self.data.uv = uv;
        let (data, pool) = (&self.data, control.pool());
        let trims = trims(data.mesh, &data.uv, &surface.domain());
        let empty_cell_count = self.empty_cell_count(&surface, &trims);
        *surface.region_mut() = Region { data_box: Some(data.data_box), trims, ..Region::default() };
        let mesh = surface.mesh();
        let measures_distance = self.options.measure_distance && (data.mesh.is_none() || data.is_shape);
        let mut report = FitReport {
            worst_index: data.order.get(errors.worst_index).map_or(errors.worst_index, |&k| k as usize),
            cell_count: mesh.leaf_count(),
            deepest_level: mesh.leaves().map(|leaf| mesh.cell(leaf).level).max().unwrap_or(0),
            rough_cell_count: rough.len(),
            coefficient_count: surface.coefficient_count(),
            smoothing,
            empty_cell_count,
            ..FitReport::new(&errors, &self.goal, stop, passes)
        };
        if measures_distance {
            report.max_distance = max_distance(&surface, &data.values, &data.uv, pool);
        }
        data.standards.report(&errors.each, &mut report);
        [report.max_side_error, report.max_side_angle] = side_deviation((&surface).into(), &data.sides);
        if let Some(interior) = data.interior_errors(&surface, pool) {
            report.add_interior(&interior);
        }
        report.remarks.add_if(empty_cell_count > 0, Remarks::EMPTY_CELLS);
        let uv = std::mem::take(&mut self.data.uv);
        let (parameters, errors) = (self.data.as_given(uv), self.data.as_given(errors.each));
        PhtFit { surface, report, parameters, errors }
    }

    /// Cells without samples inside the trims: there the surface is smooth guesswork.
    fn empty_cell_count(&self, surface: &PhtSurface, trims: &Trims) -> usize {
        let (mesh, topology) = (surface.mesh(), surface.topology());
        let mut is_empty = vec![true; topology.leaves.len()];
        self.data.sample_uv().iter().for_each(|&uv| is_empty[topology.leaf_of(mesh.locate(uv))] = false);
        let middle = |&node: &NodeId| mesh.parameters(mesh.cell(node).middle());
        let leaves = topology.leaves.iter().zip(is_empty);
        leaves.filter(|(node, is_empty)| *is_empty && trims.contains(middle(node))).count()
    }
}

/// Where the nodes go: towards their foot points, but no triangle folds.
fn moved(data: &Data, surface: &PhtSurface, pool: &Pool) -> Vec<DVec2> {
    let mesh = surface.mesh();
    let longest = |uv| LONGEST_STEP * mesh.cell_domain(mesh.cell(mesh.locate(uv))).size();
    let settle = |_, _, to| data.data_box.clamp(to);
    let mut moved = foot_points::foot_points(surface, &data.values, &data.uv, longest, settle, pool);
    if let Some(mesh) = data.mesh {
        hold_back(mesh, (&data.first_uv, LEAST_AREA), &data.uv, &mut moved);
    }
    moved
}

/// Watches for the round from which on refinement only follows noise.
///
/// Splitting the cells of N data adds d unknowns a component and lowers the sum of squares from R to R'. If the
/// rest is noise,
/// ```text
/// F = ((R - R') / d) / (R' / (N - n)),   n the unknowns of those cells
/// ```
/// is about one (the F-test of nested models); where the surface gains, it is far larger. Noise is everywhere: the
/// test needs a good part of the data.
#[derive(Default)]
struct NoiseTest {
    /// For each datum whether its cell was split, and its error before.
    before: Vec<(bool, f64)>,
    /// Unknowns a component before and after.
    unknowns: (usize, usize),
    /// Rounds in a row that gained nothing.
    idle: usize,
}

/// F below which a round has gained nothing.
const LEAST_GAIN: f64 = 1.5;
/// Rounds without gain that end the fit. One more where data are left out: a line along the end of what is left is one
/// for nothing.
const IDLE_ROUNDS: usize = 1;
/// Share of the data that a round must concern.
const LEAST_SHARE: f64 = 0.3;

impl NoiseTest {
    /// Rounds in a row that gained nothing, with the next one.
    fn idle_rounds(&mut self, round: &Round) -> usize {
        let (mut count, mut before, mut after) = (0, 0.0, 0.0);
        for (&(is_split, old), &new) in self.before.iter().zip(&round.errors.each) {
            if is_split {
                count += 1;
                before += old * old;
                after += new * new;
            }
        }
        let added = self.unknowns.1.saturating_sub(self.unknowns.0) as f64;
        // a quarter of the unknowns of the new cells was there before
        let free = count as f64 - 4.0 / 3.0 * added;
        let is_evidence =
            count as f64 >= LEAST_SHARE * self.before.len() as f64 && free > added && added > 0.0;
        let gains_nothing = is_evidence && before - after < LEAST_GAIN * added * (after / free);
        self.idle = if gains_nothing { self.idle + 1 } else { 0 };
        self.idle
    }
}

/// The surface with jets in the frame of the data.
pub(super) fn outward(data: &Data, mesh: &TMesh, mut jets: Vec<f64>) -> Result<PhtSurface, FitError> {
    for jet in jets.chunks_exact_mut(4 * data.dim) {
        let (value, slopes) = jet.split_at_mut(data.dim);
        data.frame.outward(value);
        slopes.iter_mut().for_each(|x| *x *= data.frame.scale);
    }
    // an overflow in the solution is the one thing that can be wrong
    PhtSurface::new(data.dim, false, mesh.clone(), &jets).map_err(|_: PhtError| FitError::Singular)
}
