//! The outer loop: estimate, correct, measure, split.

use super::data::Data;
use super::global::System;
use super::leaf::{LeafErrors, split_around};
use super::smooth::SmoothSystem;
use super::sums::{ByLeaf, Energy, KnownSums};
use super::{Continuity, Estimator, PhtFit, PhtOptions, local};
use crate::control::{Control, Pool, Watch};
use crate::fit::common::FitError;
use crate::fit::common::errors::{DataErrors, max_distance};
use crate::fit::common::foot_points::{self, LONGEST_STEP, hold_back};
use crate::fit::common::hermite_cell::Membrane;
use crate::fit::common::report::{FitReport, Goal, Remarks, StopReason};
use crate::fit::common::rounds::{self, Next, Outcome, Rounds, Standing};
use crate::fit::common::sides::{side_deviation, side_lines, with_side_lines};
use crate::fit::common::trims;
use crate::fit::common::uniform::energy::FreeFunctions;
use crate::memory::{self, CollectVec};
use crate::surface::pht::{PhtError, PhtSurface, TruncatedBasis};
use crate::surface::{Region, Surface, Trims};
use crate::tmesh::{Cell, MAX_LEVEL, NodeId, TMesh, Topology};
use glam::DVec2;

/// A fit on its way.
pub(super) struct Refinement<'a> {
    pub(super) data: Data<'a>,
    pub(super) options: &'a PhtOptions<'a>,
    pub(super) mesh: TMesh,
    pub(super) known: KnownSums,
    /// Weight of the energy: that of the options, less where it stands in the way of the tolerance.
    pub(super) smoothing: f64,
    pub(super) goal: Goal,
    pub(super) noise: NoiseTest,
    /// The errors of the rounds since the energy was last lowered.
    pub(super) course: Vec<f64>,
}

/// A surface, measured, with the parameters it was made for.
pub(super) struct Round {
    pub surface: PhtSurface,
    pub errors: DataErrors,
    pub uv: Vec<DVec2>,
    pub leaves: Vec<LeafErrors>,
    pub smoothing: f64,
    /// Unknowns before cells were merged again.
    pub refined_count: usize,
}

impl Round {
    /// The largest error at the data and between them, beyond what is explained.
    pub(super) fn error(&self) -> f64 {
        self.leaves.iter().map(|leaf| leaf.error).fold(self.errors.demand, f64::max)
    }
}

/// Where no cell can be split the energy is lowered by this factor,
const SMOOTHING_STEP: f64 = 1e-2;
/// as long as its weight is above this: far below, rounding decides in cells without data.
const LEAST_SMOOTHING: f64 = 1e-6;

/// The weight of the plate over the domain, mapped to a square, against the mean square error, by the smoothing that is asked
/// for: 1e-11 by default. A tenth leaves surfaces that swing between their data by up to twice the tolerance, ten times
/// as much asks for a third more coefficients on steep ridges.
const PLATE_SHARE: f64 = 1e-8;
/// Where splits do not help, the plate's weight is lowered by this factor,
const SMOOTH_STEP: f64 = 0.1;
/// to no less than this share of the one asked for: with less, surfaces swing between the data.
const SMOOTH_LEAST: f64 = 1e-2;

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

/// Unknowns that a cell has of its own: of a spline that is C1 the four of each corner, shared by the cells that touch it;
/// of one that is C2 a function, and half of the three that there are more than cells along a line at each end.
fn unknowns_of(mesh: &TMesh, cell: Cell, continuity: Continuity) -> f64 {
    let (last, [low, _, _, high]) = (mesh.last_vertex(), cell.corners());
    let (inside, at_border) = match continuity {
        Continuity::C1 => (4.0, 1.5),
        Continuity::C2 => (1.0, 2.5),
    };
    let along = |is_at_border: bool| if is_at_border { at_border } else { 1.0 };
    inside * along(low.i == 0 || high.i == last.i) * along(low.j == 0 || high.j == last.j)
}

/// The membrane in each leaf; none at all for no membranes.
pub(super) type Membranes<'a> = dyn Fn(&Topology, &ByLeaf) -> Vec<Membrane> + 'a;

/// What fits over one mesh are made of.
enum Space<'a> {
    /// Jets at the basis vertices.
    Jets(System<'a>),
    /// Truncated hierarchical B-splines.
    Smooth(SmoothSystem<'a>),
    /// Nothing that is shared: each jet for itself.
    Local,
}

impl<'a> Space<'a> {
    fn new(mesh: &'a TMesh, topology: &'a Topology, options: &PhtOptions) -> Self {
        match (options.estimator, options.continuity) {
            (Estimator::Global, Continuity::C1) => Self::Jets(System::new(mesh, topology)),
            (Estimator::Global, Continuity::C2) => Self::Smooth(SmoothSystem::new(mesh, topology)),
            _ => Self::Local,
        }
    }
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
        let tolerance = self.goal.tolerance;
        if round.leaves.iter().all(|leaf| leaf.expected <= tolerance) {
            return Next::Done;
        }
        // noise is no reason to miss what is fixed
        let is_fixed = self
            .data
            .standards
            .fixed
            .iter()
            .all(|&datum| round.errors.each[datum] * self.data.standards.factor(datum) <= tolerance);
        let idle_rounds = IDLE_ROUNDS + usize::from(self.data.standards.leaves_out());
        if is_fixed && self.noise.idle_rounds(round) >= idle_rounds {
            return Next::Drop(StopReason::Stagnated);
        }
        let is_met = round.leaves.iter().all(|leaf| leaf.error <= tolerance);
        if self.has_stalled(standing.error) {
            return Next::Round;
        }
        match self.split(round) {
            Ok(()) => Next::Round,
            // no cell can be split: what is left may be the energy's doing
            Err(_) if !is_met && self.lower_smoothing() => Next::Round,
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
        let goal = Goal::new(&options.tolerance, &data.bounds);
        data.demand(&options.demands, &options.tolerance, &goal)?;
        data.give_sides(&options.sides, &goal)?;
        let mesh = Self::initial_mesh(&data, options.initial_grid)?;
        let known = KnownSums::new(!data.is_shape);
        let (smoothing, noise) = (options.smoothing, NoiseTest::default());
        Ok(Self { data, options, mesh, known, smoothing, goal, noise, course: Vec::new() })
    }

    /// Equal cells over the box of the data, and lines at the knots of sides that are given.
    pub(super) fn initial_mesh(data: &Data, [count_u, count_v]: [usize; 2]) -> Result<TMesh, FitError> {
        let (min, max) = (data.data_box.min, data.data_box.max);
        let breaks = |from: f64, to: f64, count: usize| -> Vec<f64> {
            (0..=count)
                .map(|k| if k == count { to } else { from + (to - from) * k as f64 / count as f64 })
                .collect_vec()
        };
        let [lines_u, lines_v] = side_lines(&data.sides);
        let breaks_u = with_side_lines(breaks(min.x, max.x, count_u), &lines_u);
        let breaks_v = with_side_lines(breaks(min.y, max.y, count_v), &lines_v);
        // the box has a range, but no room for more lines than it has roundings
        TMesh::new(&breaks_u, &breaks_v).map_err(|_| FitError::DegenerateRange { axis: 'u', at: min.x })
    }

    pub(super) fn run(mut self, control: &mut Control) -> Result<PhtFit, FitError> {
        let mut outcome = match self.options.continuity {
            Continuity::C1 => {
                let grown = rounds::run(&mut self, control)?;
                self.coarsened(grown, control)?
            }
            Continuity::C2 => self.grow_smoothly(control)?,
        };
        let refined_count = outcome.best.refined_count;
        outcome.best = Round { refined_count, ..self.tamed(outcome.best, control)? };
        Ok(self.finish(outcome, control))
    }

    /// Lowers the weight of the energy; false where that would be too far.
    pub(super) fn lower_smoothing(&mut self) -> bool {
        let (step, least) = match self.options.continuity {
            Continuity::C1 => (SMOOTHING_STEP, LEAST_SMOOTHING),
            Continuity::C2 => (SMOOTH_STEP, SMOOTH_LEAST * self.options.smoothing),
        };
        let is_possible = self.smoothing > least;
        if is_possible {
            self.smoothing *= step;
            self.noise = NoiseTest::default();
            self.course.clear();
        }
        is_possible
    }

    /// Estimates on the present mesh, corrects the parameters, measures.
    fn round(&mut self, pool: &Pool, watch: &Watch) -> Result<Round, FitError> {
        let (mesh, topology) = (self.mesh.clone(), Topology::new(&self.mesh));
        let (options, smoothing) = (self.options, self.smoothing);
        let energy = self.energy(smoothing, Vec::new());
        let system = Space::new(&mesh, &topology, options);
        let mut estimate = |data: &Data, by_leaf: &ByLeaf| -> Result<PhtSurface, FitError> {
            watch.check()?;
            match &system {
                Space::Jets(system) => {
                    let jets = system.solve(data, by_leaf, &mut self.known, &energy, pool, watch)?;
                    outward(data, &mesh, jets)
                }
                Space::Smooth(system) => system.solve(data, by_leaf, &mut self.known, &energy, pool, watch),
                Space::Local if options.estimator == Estimator::LocalCubic => {
                    outward(data, &mesh, local::cubic(data, &mesh, &topology, pool))
                }
                Space::Local => outward(data, &mesh, local::quadratic(data, &mesh, &topology, pool)?),
            }
        };
        let mut by_leaf = ByLeaf::sort(&mesh, &topology, &self.data, pool);
        let mut surface = estimate(&self.data, &by_leaf)?;
        // from coarse grids parameters of smooth splines move far, and for the worse
        let is_moved = self.data.is_shape && options.continuity == Continuity::C1;
        let sweeps = if is_moved { options.correction_sweeps } else { 0 };
        for _ in 0..sweeps {
            self.data.uv = moved(&self.data, &surface, pool);
            watch.check()?;
            by_leaf = ByLeaf::sort(&mesh, &topology, &self.data, pool);
            surface = estimate(&self.data, &by_leaf)?;
        }
        let errors = self.data.errors(&surface, pool);
        watch.check()?;
        let leaves = self.leaf_errors(&surface, &errors, &by_leaf, pool);
        let refined_count = surface.coefficient_count();
        Ok(Round { surface, errors, uv: memory::copied(&self.data.uv), leaves, smoothing, refined_count })
    }

    /// The fit over some cells with the present parameters, a smoothing, and a membrane in some leaves.
    pub(super) fn over(
        &self,
        mesh: &TMesh,
        known: &mut KnownSums,
        (smoothing, membranes): (f64, &Membranes),
        pool: &Pool,
        watch: &Watch,
    ) -> Result<Round, FitError> {
        let (data, topology) = (&self.data, Topology::new(mesh));
        let by_leaf = ByLeaf::sort(mesh, &topology, data, pool);
        let energy = self.energy(smoothing, membranes(&topology, &by_leaf));
        let surface = match Space::new(mesh, &topology, self.options) {
            Space::Smooth(system) => system.solve(data, &by_leaf, known, &energy, pool, watch)?,
            Space::Jets(system) => {
                outward(data, mesh, system.solve(data, &by_leaf, known, &energy, pool, watch)?)?
            }
            Space::Local => return Err(FitError::Singular),
        };
        let errors = data.errors(&surface, pool);
        watch.check()?;
        let leaves = self.leaf_errors(&surface, &errors, &by_leaf, pool);
        let refined_count = surface.coefficient_count();
        Ok(Round { surface, errors, uv: memory::copied(&data.uv), leaves, smoothing, refined_count })
    }

    /// What weighs against the data.
    pub(super) fn energy(&self, smoothing: f64, membranes: Vec<Membrane>) -> Energy {
        if self.options.continuity == Continuity::C1 {
            return Energy::by_cell(smoothing, membranes);
        }
        let weights = &self.data.sample_weights;
        let weight = if weights.is_empty() { self.data.uv.len() as f64 } else { weights.iter().sum() };
        let cells = self.mesh.grid_size().into_iter().max().map_or(1.0, f64::from);
        Energy::of_domain(smoothing * PLATE_SHARE * weight * cells * cells, membranes)
    }

    /// Unknowns a component of a fit over a mesh.
    pub(super) fn unknowns(&self, mesh: &TMesh) -> usize {
        match self.options.continuity {
            Continuity::C1 => 4 * Topology::new(mesh).basis.len(),
            Continuity::C2 => TruncatedBasis::new(mesh).count(),
        }
    }

    /// The errors of all leaves, at data, and inside triangles beyond their sagittas.
    pub(super) fn leaf_errors(
        &self,
        surface: &PhtSurface,
        errors: &DataErrors,
        by_leaf: &ByLeaf,
        pool: &Pool,
    ) -> Vec<LeafErrors> {
        let (mesh, topology, count) = (surface.mesh(), surface.topology(), self.data.uv.len());
        let excesses = self.data.excesses(surface, &by_leaf.uv, pool);
        let miss = |sample: usize| match sample.checked_sub(count) {
            None => errors.each[sample] * self.data.standards.factor(sample),
            Some(triangle) => excesses.get(triangle).copied().unwrap_or(0.0),
        };
        let is_scattered = self.data.mesh.is_none();
        let of_leaf = |(leaf, &node): (usize, &NodeId)| {
            let (cell, samples) = (mesh.cell(node), by_leaf.of(leaf));
            let domain = mesh.cell_domain(cell);
            let middle = (domain.min + domain.max) / 2.0;
            let mut quarters = [0.0_f64; 4];
            for &sample in samples {
                let uv = by_leaf.uv[sample as usize];
                let quarter = 2 * usize::from(uv.x >= middle.x) + usize::from(uv.y >= middle.y);
                quarters[quarter] = quarters[quarter].max(miss(sample as usize));
            }
            let error = quarters.into_iter().fold(0.0, f64::max);
            let unknowns = unknowns_of(mesh, cell, self.options.continuity);
            let expected =
                if is_scattered { error * left_out_factor(unknowns, samples.len()) } else { error };
            LeafErrors { cell, samples: samples.len(), error, expected, quarters }
        };
        topology.leaves.iter().enumerate().map(of_leaf).collect_vec()
    }

    /// Splits cells where the tolerance is missed, or says why none can be split.
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
        let least = |leaf: &&LeafErrors| {
            let is_met = leaf.error <= self.goal.tolerance;
            if is_met { options.min_samples.max(16) } else { options.min_samples }
        };
        // a function that is C2 has the samples of four cells
        let cells = if options.continuity == Continuity::C1 { 1 } else { 4 };
        for rough in round.leaves.iter().filter(|leaf| cells * leaf.samples >= least(leaf)) {
            let done = match options.continuity {
                Continuity::C2 => split_around(&mut mesh, rough, self.goal.tolerance, &mut allow),
                Continuity::C1 if rough.expected <= self.goal.tolerance => Ok(()),
                // a neighbour may have split it
                Continuity::C1 => match mesh.find(rough.cell).filter(|&node| mesh.is_leaf(node)) {
                    Some(leaf) => mesh.split_graded(leaf, grade, &mut allow),
                    None => Ok(()),
                },
            };
            stop = done.err().unwrap_or(stop);
        }
        if mesh.leaf_count() == self.mesh.leaf_count() {
            return Err(stop);
        }
        let unknowns = self.unknowns(&mesh);
        // between scattered points nothing is known; on a mesh the triangles tell
        if self.data.mesh.is_none() && unknowns > self.data.uv.len().max(64) {
            return Err(StopReason::DataExhausted);
        }
        let is_split = |(datum, &uv): (usize, &DVec2)| {
            let level = |mesh: &TMesh| mesh.cell(mesh.locate(uv)).level;
            !self.data.standards.is_left_out(datum) && level(&mesh) > level(&self.mesh)
        };
        self.noise.before = self
            .data
            .uv
            .iter()
            .enumerate()
            .map(is_split)
            .zip(round.errors.each.iter().copied())
            .collect_vec();
        self.noise.unknowns = (round.surface.coefficient_count(), unknowns);
        self.mesh = mesh;
        Ok(())
    }

    fn finish(mut self, outcome: Outcome<Round>, control: &Control) -> PhtFit {
        let Outcome {
            best: Round { mut surface, errors, uv, leaves, smoothing, refined_count },
            stop,
            passes,
        } = outcome;
        let is_rough = |leaf: &&LeafErrors| !(leaf.error <= self.goal.tolerance);
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
            rough_cell_count: leaves.iter().filter(is_rough).count(),
            coefficient_count: surface.coefficient_count(),
            refined_coefficient_count: refined_count,
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
        let mut is_empty = memory::filled(true, topology.leaves.len());
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
pub(super) struct NoiseTest {
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
