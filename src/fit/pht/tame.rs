//! Where there are no data and the surface runs wild, cells are put under tension, and split where they are too large for
//! that.

use super::Estimator;
use super::refine::{Refinement, Round};
use super::sums::{ByLeaf, KnownSums};
use crate::control::{Control, Pool, Watch};
use crate::fit::common::FitError;
use crate::fit::common::hermite_cell::{Membrane, PARTS};
use crate::fit::common::tame::{CutCells, FINER_BEYOND, Standing, TENSE_WITHIN, excursion, is_wild, tamed};
use crate::fit::common::trims;
use crate::surface::pht::PhtSurface;
use crate::surface::{Domain, Trims};
use crate::tmesh::{MAX_LEVEL, NodeId, TMesh, Topology};
use glam::DVec2;

/// How often cells are split that are too large for their emptiness.
const SPLITS: usize = 3;

impl Refinement<'_> {
    /// A round, or one over the same cells or more that stays nearer to the box of the data where there are none.
    pub(super) fn tamed(&mut self, round: Round, control: &mut Control) -> Result<Round, FitError> {
        if self.options.estimator != Estimator::Global {
            return Ok(round);
        }
        self.mesh = round.surface.mesh().clone();
        self.data.uv.clone_from(&round.uv);
        let this = &*self;
        if !is_wild(this.excursion(&round.surface, control.pool())) {
            return Ok(round);
        }
        let trims = trims(this.data.mesh, &this.data.uv, &this.data.data_box);
        let wild = this.wild_cells(&round.surface, control.pool());
        let first = this.with_split(&this.mesh, |cell| has_border(cell, &trims) || wild.contains(cell));
        let finer = |mesh: &TMesh| this.with_split(mesh, |cell| has_border(cell, &trims));
        // between scattered points nothing is known: no more unknowns than there are
        let is_allowed = |mesh: &TMesh| this.data.mesh.is_some() || this.unknowns(mesh) <= this.data.uv.len();
        let finer = std::iter::successors(first, finer).take(SPLITS).take_while(is_allowed);
        let same = [CutCells::No, CutCells::Yes].map(|cut| (this.mesh.clone(), cut));
        let finer: Vec<(TMesh, CutCells)> = finer.map(|mesh| (mesh, CutCells::Yes)).collect();
        let judge = |round: &Round, pool: &Pool| Standing {
            excursion: this.excursion(&round.surface, pool),
            error: round.errors.demand,
            between: round.leaves.iter().map(|leaf| leaf.error).fold(0.0, f64::max),
        };
        let smoothing = round.smoothing;
        let refit = |(mesh, cut): &(TMesh, CutCells), tension, control: &mut Control| {
            let weights = [smoothing, tension];
            control.watch(|pool, watch| this.tense((mesh, *cut), &trims, weights, pool, watch))?
        };
        let round = tamed(round, this.goal.tolerance, &same, (&finer, FINER_BEYOND), judge, refit, control)?;
        self.mesh = round.surface.mesh().clone();
        Ok(round)
    }

    fn excursion(&self, surface: &PhtSurface, pool: &Pool) -> f64 {
        let (mesh, topology) = (surface.mesh(), surface.topology());
        let cells: Vec<Domain> =
            topology.leaves.iter().map(|&leaf| mesh.cell_domain(mesh.cell(leaf))).collect();
        excursion(surface, &cells, &self.data.bounds, pool)
    }

    /// The cells over which a surface leaves the box of the data too far.
    fn wild_cells(&self, surface: &PhtSurface, pool: &Pool) -> Vec<Domain> {
        let (mesh, topology) = (surface.mesh(), surface.topology());
        let cells = topology.leaves.iter().map(|&leaf| mesh.cell_domain(mesh.cell(leaf)));
        cells.filter(|&cell| is_wild(excursion(surface, &[cell], &self.data.bounds, pool))).collect()
    }

    /// The fit over some cells with the present parameters, a smoothing, and so many times the tension that makes a
    /// membrane where there are no data.
    fn tense(
        &self,
        (mesh, cut): (&TMesh, CutCells),
        trims: &Trims,
        [smoothing, tension]: [f64; 2],
        pool: &Pool,
        watch: &Watch,
    ) -> Result<Round, FitError> {
        let energy = self.energy(smoothing, Vec::new());
        let membranes = |topology: &Topology, by_leaf: &ByLeaf| -> Vec<Membrane> {
            let in_leaf = |(leaf, &node): (usize, &NodeId)| {
                let domain = mesh.cell_domain(mesh.cell(node));
                let share = domain.size() / self.data.data_box.size() / TENSE_WITHIN;
                let plate = energy.plate(mesh.cell(node).level);
                let places = by_leaf.of(leaf).iter().map(|&sample| by_leaf.uv[sample as usize]);
                let parts = empty_parts(&domain, places, cut, trims);
                Membrane { weight: plate * tension * share.x * share.y, parts }
            };
            topology.leaves.iter().enumerate().map(in_leaf).collect()
        };
        self.over(mesh, &mut KnownSums::default(), (smoothing, &membranes), pool, watch)
    }

    /// With some cells split; None if there are none that may be.
    fn with_split(&self, mesh: &TMesh, is_too_large: impl Fn(&Domain) -> bool) -> Option<TMesh> {
        let options = self.options;
        let grade = if options.grade == 0 { MAX_LEVEL } else { options.grade };
        let mut finer = mesh.clone();
        for leaf in mesh.leaves().filter(|&leaf| is_too_large(&mesh.cell_domain(mesh.cell(leaf)))) {
            // a neighbour may have split it
            if let Some(node) = finer.find(mesh.cell(leaf)).filter(|&node| finer.is_leaf(node)) {
                let mut allow = |mesh: &TMesh, leaf: NodeId| {
                    let fits = mesh.cell(leaf).level < options.max_level
                        && mesh.leaf_count() + 3 <= options.max_cells;
                    if fits { Ok(()) } else { Err(()) }
                };
                // where one may not be split the others still may
                let _ = finer.split_graded(node, grade, &mut allow);
            }
        }
        (finer.leaf_count() > mesh.leaf_count()).then_some(finer)
    }
}

/// The parts of a cell that have none of the samples, which lie in it, and are no part of the mesh: all or none of them unless
/// cells are cut. Only a mesh says what is between its nodes: without trims no cell is cut.
fn empty_parts(cell: &Domain, mut samples: impl Iterator<Item = DVec2>, cut: CutCells, trims: &Trims) -> u16 {
    if cut == CutCells::No || trims.is_empty() {
        let is_outside = trims.is_empty() || !trims.contains((cell.min + cell.max) / 2.0);
        return if is_outside && samples.next().is_none() { Membrane::WHOLE } else { 0 };
    }
    let outside = part_middles(cell).enumerate().filter(|&(_, middle)| !trims.contains(middle));
    let outside = outside.fold(0, |parts, (part, _)| parts | 1 << part);
    samples.fold(outside, |parts, uv| {
        let at = (uv - cell.min) / cell.size() * PARTS as f64;
        let along = |x: f64| (x as usize).min(PARTS - 1);
        parts & !(1 << (PARTS * along(at.x) + along(at.y)))
    })
}

/// The middles of the parts of a cell.
fn part_middles(cell: &Domain) -> impl Iterator<Item = DVec2> {
    let (min, size) = (cell.min, cell.size());
    let middle = |k: usize| (k as f64 + 0.5) / PARTS as f64;
    (0..PARTS * PARTS).map(move |k| min + size * DVec2::new(middle(k / PARTS), middle(k % PARTS)))
}

/// Whether some parts of a cell are inside the trims and others are not.
fn has_border(cell: &Domain, trims: &Trims) -> bool {
    if trims.is_empty() {
        return false;
    }
    let mut are_inside = part_middles(cell).map(|middle| trims.contains(middle));
    let first = are_inside.next();
    are_inside.any(|is_inside| Some(is_inside) != first)
}
