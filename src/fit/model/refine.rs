//! The rounds of a fit over a layout.
//!
//! ```text
//! conform the cells along edges, least squares over all patches
//! move each sample one step towards its foot point
//! split the cells that hold a node above the tolerance, or another sample above twice of it
//! ```
//! Between the samples a cell may swing: cells with few of them get guards, places whose targets are the points of the
//! mesh nearest to the surface of the round before.

use super::error::ModelFitError;
use super::foot::foot_points;
use super::least_squares::{System, Targets};
use super::options::ModelOptions;
use super::samples::{ByCell, Samples, guard_places, quads_of_cells, weight_on_facet};
use crate::control::{Control, Pool, Watch};
use crate::fit::common::report::StopReason;
use crate::fit::common::rounds::{Next, Rounds, Standing};
use crate::layout::{Layout, Place};
use crate::mesh::Mesh;
use crate::query::triangles::TriangleTree;
use crate::surface::Surface;
use crate::surface::g1::{Space, conform};
use crate::surface::pht::PhtSurface;
use crate::tmesh::{MAX_LEVEL, NodeId, TMesh};
use glam::DVec3;
use rayon::prelude::*;

/// A fit in progress.
pub struct Refinement<'a> {
    pub layout: &'a Layout,
    pub options: &'a ModelOptions,
    pub samples: Samples,
    pub meshes: Vec<TMesh>,
    pub tree: TriangleTree<&'a Mesh>,
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
    /// Rounds without gain before the fit is given up.
    pub idle_limit: usize,
}

/// One round: the surfaces and where the samples lie on them.
pub struct Round {
    pub surfaces: Vec<PhtSurface>,
    pub places: Vec<Place>,
    /// By sample.
    pub distances: Vec<f64>,
    /// Free unknowns a component.
    pub free_count: usize,
    /// Samples by cell at their new places.
    by_cell: ByCell,
    /// Of the nodes alone.
    node_error: f64,
    /// The larger of that and half the error of the other samples.
    error: f64,
}

/// What the tolerance is for samples that are no nodes, beside that of nodes.
const SLACK: f64 = 2.0;

impl Samples {
    /// What a distance is beside the tolerance of nodes: between them, only what the facet does not explain.
    fn error(&self, sample: usize, distance: f64) -> f64 {
        let excess = distance - self.allowances[sample];
        if sample < self.nodes.len() { distance } else { excess / SLACK }
    }
}

/// Rounds that only move samples before cells with fewer of them are split, or a fit is given up.
const MOST_STUCK: usize = 3;
/// Rounds without gain before a fit is given up, while cells of no fewer samples are split.
pub const MOST_IDLE: usize = 3;

impl Rounds for Refinement<'_> {
    type Round = Round;
    type Error = ModelFitError;

    fn fit(&mut self, control: &mut Control) -> Result<Round, ModelFitError> {
        self.rounds += 1;
        let round = control.watch(|pool, watch| self.round(pool, watch))??;
        self.samples.places.clone_from(&round.places);
        self.before.clone_from(&round.surfaces);
        Ok(round)
    }

    fn error(&self, round: &Round) -> f64 {
        round.error
    }

    fn tolerance(&self) -> f64 {
        self.tolerance
    }

    fn refine(&mut self, standing: &Standing<Round>, _: &Control) -> Next {
        let Some(round) = standing.round else { return Next::Stop(StopReason::Stagnated) };
        if round.error <= self.tolerance {
            return Next::Done;
        }
        if self.rounds >= self.options.max_rounds {
            return Next::Stop(StopReason::Limit);
        }
        if standing.idle >= self.idle_limit && self.stuck == 0 {
            return Next::Stop(StopReason::Stagnated);
        }
        match self.split(round) {
            Ok(()) => self.stuck = 0,
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
    fn round(&self, pool: &Pool, watch: &Watch) -> Result<Round, ModelFitError> {
        let space = Space::new(self.layout, self.meshes.clone())?;
        watch.check()?;
        let system = System::new(&space, pool);
        watch.check()?;
        let by_cell = ByCell::sort(&space, &self.samples.places, pool);
        let targets = self.targets(&space, &system, &by_cell, pool);
        let all_places: Vec<Place> = self.samples.places.iter().chain(&targets.1).copied().collect();
        let by_cell = if targets.1.is_empty() { by_cell } else { ByCell::sort(&space, &all_places, pool) };
        watch.check()?;
        let surfaces = system.solve(&targets.0, &by_cell, self.options.smoothing, pool, watch)?;
        watch.check()?;
        let mut places = self.samples.places.clone();
        let steps = self.options.foot_steps;
        let distances = foot_points(self.layout, &surfaces, &mut places, &self.samples.points, steps, pool);
        let by_cell = ByCell::sort(&space, &places, pool);
        let errors = (0..distances.len()).map(|sample| self.samples.error(sample, distances[sample]));
        let error = errors.fold(0.0, f64::max);
        let node_error = distances[..self.samples.nodes.len()].iter().copied().fold(0.0, f64::max);
        Ok(Round { surfaces, places, distances, free_count: space.free_count(), by_cell, node_error, error })
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
        let weight = |sample: usize| self.samples.weight(sample, self.tolerance);
        let mut targets = Targets {
            uv: places.iter().map(|place| place.uv).collect(),
            points: points.clone(),
            weights: (0..places.len()).map(weight).collect(),
        };
        if self.before.is_empty() || !self.options.guard {
            return (targets, Vec::new());
        }
        let guards = guard_places(&quads_of_cells(space), system.cells(), by_cell);
        let nearest = |place: &Place| {
            let mut row = [0.0; 3];
            self.before[place.quad as usize].eval_rows(&[place.uv], 0, &mut row);
            let point = DVec3::from_array(row);
            self.tree.nearest(point).map_or((point, 0.0), |nearest| {
                let sagitta = self.sagittas[nearest.triangle as usize];
                (nearest.point, weight_on_facet(sagitta, self.tolerance))
            })
        };
        let nearest: Vec<(DVec3, f64)> =
            pool.run(|| guards.par_iter().with_min_len(64).map(nearest).collect());
        targets.uv.extend(guards.iter().map(|place| place.uv));
        targets.points.extend(nearest.iter().map(|&(point, _)| point));
        targets.weights.extend(nearest.iter().map(|&(_, weight)| weight));
        (targets, guards)
    }

    /// Splits the cells that miss the tolerance, or says why none can be split.
    fn split(&mut self, round: &Round) -> Result<(), StopReason> {
        let cells = rough_cells(round, &self.samples, self.tolerance);
        let (options, mut stop) = (self.options, StopReason::DataExhausted);
        let before: usize = self.meshes.iter().map(TMesh::leaf_count).sum();
        let mut count = before;
        let mut first = 0;
        let mut numbers = cells.into_iter().peekable();
        let least_samples = self.least_samples;
        for mesh in &mut self.meshes {
            let leaves: Vec<NodeId> = mesh.leaves().collect();
            let of_mesh: Vec<Rough> =
                std::iter::from_fn(|| numbers.next_if(|rough| rough.cell < first + leaves.len())).collect();
            let others = count - mesh.leaf_count();
            let mut allow = |mesh: &TMesh, leaf: NodeId| {
                let fits = mesh.cell(leaf).level < options.max_level
                    && others + mesh.leaf_count() + 3 <= options.max_cells;
                if fits { Ok(()) } else { Err(StopReason::Limit) }
            };
            let grade = if options.grade == 0 { MAX_LEVEL } else { options.grade };
            for rough in of_mesh.into_iter().filter(|rough| rough.samples >= least_samples) {
                let leaf = leaves[rough.cell - first];
                // a neighbour may have split it
                if mesh.is_leaf(leaf)
                    && let Err(limit) = mesh.split_graded(leaf, grade, &mut allow)
                {
                    stop = limit;
                }
            }
            first += leaves.len();
            count = others + mesh.leaf_count();
        }
        if count == before {
            return Err(stop);
        }
        conform(self.layout, &mut self.meshes);
        Ok(())
    }
}

/// A cell that misses the tolerance.
struct Rough {
    cell: usize,
    samples: usize,
}

fn rough_cells(round: &Round, samples: &Samples, tolerance: f64) -> Vec<Rough> {
    let is_rough = |&sample: &u32| {
        let sample = sample as usize;
        !(samples.error(sample, round.distances[sample]) <= tolerance)
    };
    let cells = (0..round.by_cell.cell_count()).map(|cell| (cell, round.by_cell.of(cell)));
    cells
        .filter(|(_, of_cell)| of_cell.iter().any(is_rough))
        .map(|(cell, of_cell)| Rough { cell, samples: of_cell.len() })
        .collect()
}
