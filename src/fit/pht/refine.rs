//! The outer loop: estimate, correct, measure, split.

use super::data::Data;
use super::global::{ByLeaf, KnownSums, System};
use super::{Estimator, PhtFit, PhtOptions, local};
use crate::control::{Control, Pool, Watch};
use crate::fit::common::FitError;
use crate::fit::common::errors::{DataErrors, data_errors, max_distance};
use crate::fit::common::foot_points::{LONGEST_STEP, STEPS, gauss_newton_step, hold_back};
use crate::fit::common::report::{FitReport, Remarks, StopReason};
use crate::fit::common::uniform::energy::FreeFunctions;
use crate::surface::pht::{PhtError, PhtSurface};
use crate::surface::{Region, Surface, Trims};
use crate::tmesh::{Cell, MAX_LEVEL, NodeId, TMesh, Topology};
use glam::DVec2;
use rayon::prelude::*;

/// A fit on its way.
pub struct Refinement<'a> {
    data: Data<'a>,
    options: &'a PhtOptions<'a>,
    mesh: TMesh,
    known: KnownSums,
    /// Weight of the energy: that of the options, less where cells cannot be split any more.
    smoothing: f64,
    /// The tolerance in model units, and whether it was raised.
    tolerance: (f64, bool),
}

/// A surface, measured, with the parameters it was made for.
struct Round {
    surface: PhtSurface,
    errors: DataErrors,
    uv: Vec<DVec2>,
    /// The leaves in which an error exceeds the tolerance.
    rough: Vec<Rough>,
    smoothing: f64,
}

/// A leaf that misses the tolerance.
struct Rough {
    cell: Cell,
    samples: usize,
    /// The largest error in it.
    error: f64,
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

impl<'a> Refinement<'a> {
    pub fn new(data: Data<'a>, options: &'a PhtOptions<'a>) -> Result<Self, FitError> {
        if FreeFunctions::of(&data.uv, &data.data_box) == FreeFunctions::Linear {
            return Err(FitError::Singular);
        }
        let (min, max) = (data.data_box.min, data.data_box.max);
        let breaks = |from: f64, to: f64, count: usize| -> Vec<f64> {
            (0..=count)
                .map(|k| if k == count { to } else { from + (to - from) * k as f64 / count as f64 })
                .collect()
        };
        let [count_u, count_v] = options.initial_grid;
        let mesh = TMesh::new(&breaks(min.x, max.x, count_u), &breaks(min.y, max.y, count_v));
        // the box has a range, but no room for more lines than it has roundings
        let mesh = mesh.map_err(|_| FitError::DegenerateRange { axis: 'u', at: min.x })?;
        let tolerance = options.tolerance.absolute(&data.bounds);
        let known = KnownSums::new(!data.is_shape);
        Ok(Self { data, options, mesh, known, smoothing: options.smoothing, tolerance })
    }

    pub fn run(mut self, control: &mut Control) -> Result<PhtFit, FitError> {
        let mut best: Option<Round> = None;
        let mut noise = NoiseTest::default();
        let (mut passes, mut first_error) = (0, f64::NAN);
        let stop = loop {
            let round = control.watch(|pool, watch| self.round(pool, watch))??;
            passes += 1;
            first_error = if passes == 1 { round.errors.max } else { first_error };
            control.report(fraction(first_error, round.errors.max, self.tolerance.0), round.errors.max)?;
            if round.rough.is_empty() {
                best = Some(round);
                break StopReason::ToleranceMet;
            }
            if noise.has_reached_floor(&round) {
                break StopReason::Stagnated;
            }
            let outcome = self.refine(&round, &mut noise);
            let is_met = round.rough.iter().all(|rough| rough.error <= self.tolerance.0);
            if best.as_ref().is_none_or(|best| round.errors.max < best.errors.max) {
                best = Some(round);
            }
            if outcome.is_err() && !is_met && self.smoothing > LEAST_SMOOTHING {
                // no cell can be split: what is left may be the energy's doing
                self.smoothing *= SMOOTHING_STEP;
                noise = NoiseTest::default();
                continue;
            }
            if let Err(stop) = outcome {
                break if is_met { StopReason::ToleranceMet } else { stop };
            }
        };
        let mut best = best.ok_or(FitError::Singular)?;
        best.rough.retain(|rough| !(rough.error <= self.tolerance.0));
        Ok(self.finish(best, stop, passes, control))
    }

    /// Estimates on the present mesh, corrects the parameters, measures.
    fn round(&mut self, pool: &Pool, watch: &Watch) -> Result<Round, FitError> {
        let (mesh, topology) = (self.mesh.clone(), Topology::new(&self.mesh));
        let system = match self.options.estimator {
            Estimator::Global => Some(System::new(&mesh, &topology)),
            _ => None,
        };
        let (options, smoothing) = (self.options, self.smoothing);
        let mut estimate = |data: &Data, by_leaf: &ByLeaf| -> Result<PhtSurface, FitError> {
            watch.check()?;
            let jets = match &system {
                Some(system) => system.solve(data, by_leaf, &mut self.known, smoothing, pool, watch)?,
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
            self.data.uv = foot_points(&self.data, &surface, pool);
            by_leaf = ByLeaf::sort(&mesh, &topology, &self.data, pool);
            surface = estimate(&self.data, &by_leaf)?;
        }
        let errors = data_errors(&surface, &self.data.uv, &self.data.values, pool);
        let rough = self.rough_leaves(&surface, &errors, &by_leaf, pool);
        Ok(Round { surface, errors, uv: self.data.uv.clone(), rough, smoothing })
    }

    /// The leaves that miss the tolerance at a datum, or inside a triangle by more than its sagitta.
    fn rough_leaves(
        &self,
        surface: &PhtSurface,
        errors: &DataErrors,
        by_leaf: &ByLeaf,
        pool: &Pool,
    ) -> Vec<Rough> {
        let (topology, count) = (surface.topology(), self.data.uv.len());
        let excesses = self.data.excesses(surface, &by_leaf.uv, pool);
        let miss = |sample: usize| match sample.checked_sub(count) {
            None => errors.each[sample],
            Some(triangle) => excesses.get(triangle).copied().unwrap_or(0.0),
        };
        let is_scattered = self.data.mesh.is_none();
        let rough = |(leaf, &node): (usize, &NodeId)| {
            let (cell, samples) = (self.mesh.cell(node), by_leaf.of(leaf));
            let error = samples.iter().map(|&sample| miss(sample as usize)).fold(0.0, f64::max);
            let unknowns = unknowns_of(&self.mesh, cell);
            let between = if is_scattered { error * left_out_factor(unknowns, samples.len()) } else { error };
            (!(between <= self.tolerance.0)).then_some(Rough { cell, samples: samples.len(), error })
        };
        topology.leaves.iter().enumerate().filter_map(rough).collect()
    }

    /// Splits the rough cells, or says why none can be split.
    fn refine(&mut self, round: &Round, noise: &mut NoiseTest) -> Result<(), StopReason> {
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
            let is_met = rough.error <= self.tolerance.0;
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
        let is_split =
            |&uv: &DVec2| mesh.cell(mesh.locate(uv)).level > self.mesh.cell(self.mesh.locate(uv)).level;
        noise.before = self.data.uv.iter().map(is_split).zip(round.errors.each.iter().copied()).collect();
        noise.unknowns = (round.surface.coefficient_count(), unknowns);
        self.mesh = mesh;
        Ok(())
    }

    fn finish(&mut self, best: Round, stop: StopReason, passes: usize, control: &Control) -> PhtFit {
        let Round { mut surface, errors, uv, rough, smoothing } = best;
        self.data.uv = uv;
        let pool = control.pool();
        let trims = self.trims(&surface);
        let empty_cell_count = self.empty_cell_count(&surface, &trims);
        *surface.region_mut() = Region { data_box: Some(self.data.data_box), trims };
        let interior =
            self.data.on_mesh().map(|mesh| mesh.interior_errors(&surface, pool)).unwrap_or_default();
        let (tolerance, raised) = self.tolerance;
        let mut remarks = Remarks::default();
        remarks.add_if(errors.max > tolerance, Remarks::TOLERANCE_NOT_MET);
        remarks.add_if(stop == StopReason::Stagnated, Remarks::STAGNATED);
        remarks.add_if(raised, Remarks::TOLERANCE_RAISED);
        remarks.add_if(empty_cell_count > 0, Remarks::EMPTY_CELLS);
        remarks.add_if(interior.max_excess > tolerance, Remarks::ROUGH_BETWEEN_NODES);
        let mesh = surface.mesh();
        let measures_distance =
            self.options.measure_distance && (self.data.mesh.is_none() || self.data.is_shape);
        let distance = if measures_distance {
            max_distance(&surface, &self.data.values, &self.data.uv, pool)
        } else {
            f64::NAN
        };
        let report = FitReport {
            max_error: errors.max,
            rms_error: errors.rms,
            mean_error: errors.mean,
            worst_index: self.data.order.get(errors.worst_index).map_or(errors.worst_index, |&k| k as usize),
            tolerance,
            diagonal: self.data.bounds.diagonal(),
            max_interior_error: interior.max,
            facet_sagitta: interior.sagitta,
            max_distance: distance,
            cell_count: mesh.leaf_count(),
            deepest_level: mesh.leaves().map(|leaf| mesh.cell(leaf).level).max().unwrap_or(0),
            rough_cell_count: rough.len(),
            coefficient_count: surface.coefficient_count(),
            smoothing,
            empty_cell_count,
            passes,
            stop,
            remarks,
            ..FitReport::default()
        };
        let uv = std::mem::take(&mut self.data.uv);
        let parameters = self.data.as_given(uv);
        PhtFit { surface, report, parameters, errors: self.data.as_given(errors.each) }
    }

    /// The boundary loops of the mesh in the parameter plane.
    fn trims(&self, surface: &PhtSurface) -> Trims {
        let loops = self.data.mesh.map_or(&[][..], |mesh| mesh.loops());
        let loops = loops.iter().map(|nodes| nodes.iter().map(|&n| self.data.uv[n as usize]).collect());
        // parameters of data lie in the domain, and loops have three nodes at least
        Trims::new(loops.collect(), &surface.domain()).unwrap_or_default()
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
fn foot_points(data: &Data, surface: &PhtSurface, pool: &Pool) -> Vec<DVec2> {
    let (mesh, dim) = (surface.mesh(), data.dim);
    let mut moved = data.uv.clone();
    pool.run(|| {
        moved.par_iter_mut().zip(data.values.par_chunks(dim)).with_min_len(256).for_each(|(uv, value)| {
            let mut row = vec![0.0; 3 * dim];
            for _ in 0..STEPS {
                surface.eval_rows(&[*uv], 1, &mut row);
                let cell = mesh.cell_domain(mesh.cell(mesh.locate(*uv)));
                let longest = LONGEST_STEP * cell.size();
                let step = gauss_newton_step(&row, value).clamp(-longest, longest);
                *uv = data.data_box.clamp(*uv + step);
            }
        })
    });
    if let Some(mesh) = data.mesh {
        hold_back(mesh.triangles(), (&data.first_uv, LEAST_AREA), &data.uv, &mut moved);
    }
    moved
}

/// How far the error has come from the first towards the tolerance, on a logarithmic scale.
pub fn fraction(first: f64, error: f64, tolerance: f64) -> f64 {
    let way = (first / tolerance).ln();
    if way > 0.0 { ((first / error.max(tolerance)).ln() / way).clamp(0.0, 1.0) } else { 1.0 }
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
/// Rounds without gain that end the fit.
const IDLE_ROUNDS: usize = 1;
/// Share of the data that a round must concern.
const LEAST_SHARE: f64 = 0.3;

impl NoiseTest {
    fn has_reached_floor(&mut self, round: &Round) -> bool {
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
        self.idle >= IDLE_ROUNDS
    }
}

/// The surface with jets in the frame of the data.
fn outward(data: &Data, mesh: &TMesh, mut jets: Vec<f64>) -> Result<PhtSurface, FitError> {
    for jet in jets.chunks_exact_mut(4 * data.dim) {
        let (value, slopes) = jet.split_at_mut(data.dim);
        data.frame.outward(value);
        slopes.iter_mut().for_each(|x| *x *= data.frame.scale);
    }
    // an overflow in the solution is the one thing that can be wrong
    PhtSurface::new(data.dim, false, mesh.clone(), &jets).map_err(|_: PhtError| FitError::Singular)
}
