//! The rounds of a fit over a layout.
//!
//! ```text
//! conform the cells along edges, least squares over all patches
//! move each sample one step towards its foot point
//! split the cells that hold a node above the tolerance, or another sample above twice of it
//! stiffen the cells whose normals are reversed
//! let nodes that miss by little count more
//! ```
//! Between the samples a cell may swing: cells with few of them get guards, places whose targets are the points of the
//! mesh nearest to the surface of the round before.

use super::constraints::{Constraints, Projector};
use super::error::ModelFitError;
use super::folds::folded_cells;
use super::foot::{Ground, foot_points};
use super::least_squares::{System, Targets};
use super::locks::Lock;
use super::near::NearMesh;
use super::options::ModelOptions;
use super::samples::{ByCell, CellPlace, Samples, guard_places, quads_of_cells, weight_on_facet};
use super::split::{SplitLimits, split_cells};
use crate::control::{Control, Pool, Watch};
use crate::fit::common::FitError;
use crate::fit::common::report::StopReason;
use crate::fit::common::rounds::{Next, Rounds, Standing};
use crate::geometry::Domain;
use crate::layout::{Layout, Place};
use crate::memory::CollectVec;
use crate::surface::Surface;
use crate::surface::g1::Space;
use crate::surface::pht::PhtSurface;
use crate::tmesh::{MAX_LEVEL, TMesh};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// A fit in progress.
pub(super) struct Refinement<'a> {
    pub layout: &'a Layout,
    pub options: &'a ModelOptions,
    pub samples: Samples,
    /// What the tolerance is divided by at each of them.
    pub strictness: Vec<f64>,
    pub meshes: Vec<TMesh>,
    /// What the fit keeps exactly.
    pub constraints: &'a Constraints,
    /// Whether the layout has borders or creases.
    pub has_creases: bool,
    /// By vertex of the layout, whether samples on creases stop there.
    pub is_corner: Vec<bool>,
    /// The mesh under the patches.
    pub near: NearMesh,
    /// By triangle of the mesh.
    pub facet_normals: Vec<DVec3>,
    /// Parts of patches that folded, with what their energy is multiplied by.
    pub stiff: Vec<Stiff>,
    /// How far the shape may lie above each facet.
    pub sagittas: Vec<f64>,
    /// In model units.
    pub tolerance: f64,
    /// The surfaces of the round before.
    pub before: Vec<PhtSurface>,
    pub rounds: usize,
    /// Rounds in a row without a cell that can be split.
    pub stuck: usize,
    /// Cells with fewer samples are not split.
    pub least_samples: usize,
    /// The least error of a round, folded or not.
    pub(super) least_error: f64,
    /// Rounds that had folds.
    pub(super) folded_rounds: usize,
    /// Rounds without gain before the fit is given up.
    pub idle_limit: usize,
    /// By node: what it counts beside others.
    pub emphasis: Vec<f64>,
}

/// One round: the surfaces and where the samples lie on them.
pub(super) struct Round {
    pub surfaces: Vec<PhtSurface>,
    pub places: Vec<Place>,
    pub locks: Vec<Lock>,
    /// By sample.
    pub distances: Vec<f64>,
    /// Parts of patches where the normal is reversed.
    pub folded: Vec<(u32, Domain)>,
    /// Free unknowns a component.
    pub free_count: usize,
    /// Samples by cell at their new places.
    by_cell: ByCell,
    /// Of the nodes alone.
    node_error: f64,
    /// The larger of that and half the error of the other samples.
    error: f64,
}

/// A part of a patch that resists bending more than others.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stiff {
    quad: u32,
    domain: Domain,
    factor: f64,
}

/// What the energy of a folded cell and half a cell around it is multiplied by, each time it is found. Over smooth patches it
/// is half a cell more each time, as what is around a cell folds it; patches between creases are too narrow for that.
const STIFFER: f64 = 10.0;
/// Most of that: a thousand times the energy makes a cell a plane plate.
const STIFFEST: f64 = 1e3;
/// A round with folds is worth one without that misses so many times as much.
const FOLD_PENALTY: f64 = 2.0;

/// Facets of a part with creases say where the shape is to this share of the tolerance: its round walls are to have their own
/// size, not that of a polygon's, and are so coarse on purpose.
const KNOWN_OF_PARTS: f64 = 0.1;

/// What the tolerance is for samples that are no nodes, beside that of nodes.
const SLACK: f64 = 2.0;

/// Rounds that only move samples before cells with fewer of them are split, or a fit is given up.
const MOST_STUCK: usize = 3;
/// Rounds with folds before they are left, and told: what so many do not mend, stiffness does not, and it costs nearness.
const MOST_FOLDED: usize = 12;
/// Folds of smooth patches are mended once the error is no more than so many times the tolerance.
const NEAR: f64 = 2.0;
/// Rounds without gain before a fit is given up, while cells of no fewer samples are split: folds that are mended come first.
pub(super) const MOST_IDLE: usize = 5;

/// Once the error is no more than so many times the tolerance, nodes that miss count more, as weights of C. L. Lawson (1961) do on
/// the way to the least largest error: more cells alone cannot hold noise that is larger than the tolerance.
const WITHIN_REACH: f64 = 5.0;
/// The share of the tolerance that nodes are to be brought below.
const AIM: f64 = 0.7;
/// A node counts at most so many times more from one round to the next.
const MOST_GROWTH: f64 = 4.0;
/// Most that it counts: more would be all that a cell sees.
const MOST_EMPHASIS: f64 = 1e4;

impl Rounds for Refinement<'_> {
    type Round = Round;
    type Error = ModelFitError;

    fn fit(&mut self, control: &mut Control) -> Result<Round, ModelFitError> {
        self.rounds += 1;
        let round = control.watch(|pool, watch| self.round(pool, watch))??;
        self.samples.places.clone_from(&round.places);
        self.samples.locks.clone_from(&round.locks);
        self.before.clone_from(&round.surfaces);
        Ok(round)
    }

    fn error(&self, round: &Round) -> f64 {
        if round.folded.is_empty() {
            return round.error;
        }
        // fewer folds are a gain
        let share = round.folded.len() as f64 / round.by_cell.cell_count() as f64;
        (FOLD_PENALTY + share) * round.error.max(self.tolerance)
    }

    fn tolerance(&self) -> f64 {
        self.tolerance
    }

    fn refine(&mut self, standing: &Standing<Round>, _: &Control) -> Next {
        let Some(round) = standing.round else { return Next::Stop(StopReason::Stagnated) };
        let is_folded = !round.folded.is_empty();
        if round.error <= self.tolerance && (!is_folded || self.folded_rounds > MOST_FOLDED) {
            return Next::Done;
        }
        if self.rounds >= self.options.max_rounds {
            return Next::Stop(StopReason::Limit);
        }
        // folds hide that a round is nearer than those before
        if round.error < self.least_error {
            self.least_error = round.error;
            self.idle_limit = self.idle_limit.max(standing.idle + 1);
        }
        if standing.idle >= self.idle_limit && self.stuck == 0 {
            return Next::Stop(StopReason::Stagnated);
        }
        self.insist(round);
        self.folded_rounds += usize::from(is_folded);
        if is_folded && self.folded_rounds == MOST_FOLDED + 1 {
            self.stiff.clear();
            self.idle_limit = standing.idle + MOST_IDLE;
        }
        let is_stiffer = self.mends(round) && self.stiffen(round);
        match self.split(round) {
            Ok(()) => self.stuck = 0,
            Err(_) if is_stiffer => self.stuck = 0,
            Err(_) if self.stuck + 1 < MOST_STUCK => self.stuck += 1,
            // moving samples does not help the nodes any more: cells with few of them are held by guards
            Err(StopReason::DataExhausted) if self.least_samples > 1 && round.node_error > self.tolerance => {
                self.stuck = 0;
                self.least_samples /= 2;
                self.idle_limit = standing.idle + MOST_IDLE;
            }
            Err(stop) => return Next::Stop(stop),
        }
        Next::Round
    }
}

impl Refinement<'_> {
    /// Whether the fit is to mend the folds of a round: over smooth patches once it is near, or many come and go with the
    /// cells; where creases end in corners, patches are narrow, and a fold stays from the first round on.
    fn mends(&self, round: &Round) -> bool {
        let is_near = round.error <= NEAR * self.tolerance;
        !round.folded.is_empty() && self.folded_rounds <= MOST_FOLDED && (self.has_creases || is_near)
    }

    /// Lets nodes that miss count more, where the round is near enough.
    fn insist(&mut self, round: &Round) {
        if round.error > WITHIN_REACH * self.tolerance {
            return;
        }
        for sample in 0..self.emphasis.len() {
            let miss = self.error_at(sample, round.distances[sample]) / (AIM * self.tolerance);
            let growth = (miss * miss).clamp(1.0, MOST_GROWTH);
            self.emphasis[sample] = (growth * self.emphasis[sample]).min(MOST_EMPHASIS);
        }
    }

    /// The distance to which facets say where the shape is.
    fn known_on_facets(&self) -> f64 {
        if self.has_creases { KNOWN_OF_PARTS * self.tolerance } else { self.tolerance }
    }

    /// Raises the energy where the surface is folded and around it; whether any was raised.
    fn stiffen(&mut self, round: &Round) -> bool {
        let before = self.stiff.len();
        for &(quad, domain) in &round.folded {
            let factor = STIFFER * self.stiffness(quad, &domain);
            if factor <= STIFFEST {
                let times = if self.has_creases { 1.0 } else { factor.log10() };
                let margin = DVec2::splat(0.5 * times * domain.size().x);
                let domain = Domain { min: domain.min - margin, max: domain.max + margin };
                self.stiff.push(Stiff { quad, domain, factor });
            }
        }
        self.stiff.len() > before
    }

    /// What the energy in a part of a patch is multiplied by.
    fn stiffness(&self, quad: u32, domain: &Domain) -> f64 {
        let overlaps = |stiff: &&Stiff| {
            stiff.quad == quad
                && stiff.domain.min.cmplt(domain.max).all()
                && domain.min.cmplt(stiff.domain.max).all()
        };
        self.stiff.iter().filter(overlaps).map(|stiff| stiff.factor).fold(1.0, f64::max)
    }

    fn round(&self, pool: &Pool, watch: &Watch) -> Result<Round, ModelFitError> {
        let space = Space::new(self.layout, self.meshes.clone())?;
        watch.check()?;
        let system = System::new(&space, pool);
        watch.check()?;
        let by_cell = ByCell::sort(&space, &self.samples.places, pool);
        let targets = self.targets(&space, &system, &by_cell, pool);
        let all_places: Vec<Place> = self.samples.places.iter().chain(&targets.1).copied().collect_vec();
        let by_cell = if targets.1.is_empty() { by_cell } else { ByCell::sort(&space, &all_places, pool) };
        watch.check()?;
        let quads = quads_of_cells(&space);
        let energy: Vec<f64> = quads
            .iter()
            .zip(system.cells())
            .map(|(&quad, cell)| self.options.smoothing * self.stiffness(quad, &domain_of(cell)))
            .collect_vec();
        let mut unknowns = system.solve(&targets.0, &by_cell, &energy, pool, watch)?;
        Projector::new(&space, self.constraints).apply(&space, &mut unknowns);
        // an overflow in the solution is the one thing that can be wrong
        let surfaces = space.surfaces(&unknowns, 3).map_err(|_| FitError::Singular)?;
        watch.check()?;
        let (mut places, mut locks) = (self.samples.places.clone(), self.samples.locks.clone());
        let ground = Ground { layout: self.layout, surfaces: &surfaces, is_corner: &self.is_corner };
        let steps = self.options.foot_steps;
        let distances = foot_points(ground, &mut places, &mut locks, &self.samples.points, steps, pool);
        let by_cell = ByCell::sort(&space, &places, pool);
        watch.check()?;
        let cells = (quads.as_slice(), system.cells());
        let normal_near = |quad: u32, point: DVec3| {
            let near = self.near.nearest(quad, point);
            near.map_or(DVec3::ZERO, |near| self.facet_normals[near.triangle as usize])
        };
        let of_samples = (&self.samples, places.as_slice());
        let folded =
            folded_cells(&surfaces, cells, of_samples, &by_cell, self.has_creases, &normal_near, pool);
        let folded =
            folded.into_iter().map(|cell| (quads[cell], domain_of(&system.cells()[cell]))).collect_vec();
        let errors = (0..distances.len()).map(|sample| self.error_at(sample, distances[sample]));
        let error = errors.fold(0.0, f64::max);
        let node_error = distances[..self.samples.nodes.len()].iter().copied().fold(0.0, f64::max);
        let free_count = space.free_count();
        Ok(Round { surfaces, places, locks, distances, folded, free_count, by_cell, node_error, error })
    }

    /// The samples with their weights, and after them the guards, whose places come along.
    fn targets(
        &self,
        space: &Space,
        system: &System,
        by_cell: &ByCell,
        pool: &Pool,
    ) -> (Targets, Vec<Place>) {
        let Samples { places, points, .. } = &self.samples;
        let weight = |sample: usize| {
            let emphasis = self.emphasis.get(sample).copied().unwrap_or(1.0);
            emphasis * self.samples.weight(sample, self.known_on_facets())
        };
        let mut targets = Targets {
            uv: places.iter().map(|place| place.uv).collect_vec(),
            points: points.clone(),
            weights: (0..places.len()).map(weight).collect_vec(),
        };
        if self.before.is_empty() || !self.options.guard {
            return (targets, Vec::new());
        }
        let guards = guard_places(&quads_of_cells(space), system.cells(), by_cell);
        let nearest = |place: &Place| {
            let mut row = [0.0; 3];
            self.before[place.quad as usize].eval_rows(&[place.uv], 0, &mut row);
            let point = DVec3::from_array(row);
            self.near.nearest(place.quad, point).map_or((point, 0.0), |nearest| {
                let sagitta = self.sagittas[nearest.triangle as usize];
                (nearest.point, weight_on_facet(sagitta, self.known_on_facets()))
            })
        };
        let nearest: Vec<(DVec3, f64)> =
            pool.run(|| guards.par_iter().with_min_len(64).map(nearest).collect());
        targets.uv.extend(guards.iter().map(|place| place.uv));
        targets.points.extend(nearest.iter().map(|&(point, _)| point));
        targets.weights.extend(nearest.iter().map(|&(_, weight)| weight));
        (targets, guards)
    }

    /// What a distance at a sample is beside the tolerance of nodes: between them, only what the facet does not explain; more
    /// where a wall is thin.
    fn error_at(&self, sample: usize, distance: f64) -> f64 {
        let excess = distance - self.samples.allowances[sample];
        let error = if sample < self.samples.nodes.len() { distance } else { excess / SLACK };
        error * self.strictness[sample]
    }

    /// Splits the cells that miss the tolerance, or says why none can be split.
    fn split(&mut self, round: &Round) -> Result<(), StopReason> {
        let options = self.options;
        let mut meshes = std::mem::take(&mut self.meshes);
        let is_rough = |&sample: &u32| {
            let sample = sample as usize;
            !(self.error_at(sample, round.distances[sample]) <= self.tolerance)
        };
        let is_to_split = |cell: usize, domain: &Domain| {
            let samples = round.by_cell.of(cell);
            // a corner between creases swings when it is left with few samples
            let is_kept = self.has_creases && is_at_corner(domain);
            let least = if is_kept { options.min_samples } else { self.least_samples };
            samples.len() >= least && samples.iter().any(is_rough)
        };
        let limits = SplitLimits {
            max_level: options.max_level,
            max_cells: options.max_cells,
            grade: if options.grade == 0 { MAX_LEVEL } else { options.grade },
        };
        let done = split_cells(self.layout, &mut meshes, limits, is_to_split);
        self.meshes = meshes;
        done
    }
}

fn domain_of(cell: &CellPlace) -> Domain {
    Domain { min: cell.min, max: cell.min + cell.size }
}

/// Whether a part of a patch has one of its corners.
fn is_at_corner(domain: &Domain) -> bool {
    [domain.min, domain.max].iter().any(|at| at.x == 0.0 || at.x == 1.0)
        && [domain.min, domain.max].iter().any(|at| at.y == 0.0 || at.y == 1.0)
}
