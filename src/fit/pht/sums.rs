//! Sums over the samples of each leaf of a T-mesh, which the matrices of all splines over it are made of.

use super::data::Data;
use crate::control::{Pool, Watch};
use crate::fit::common::FitError;
use crate::fit::common::hermite_cell::{CellSums, Membrane, weights};
use crate::lists::Lists;
use crate::memory::ParallelCollectVec;
use crate::surface::Domain;
use crate::tmesh::{Cell, TMesh, Topology};
use glam::DVec2;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

/// Samples sorted by leaf.
pub(super) struct ByLeaf {
    /// Parameters of all samples.
    pub uv: Vec<DVec2>,
    by_leaf: Lists,
}

impl ByLeaf {
    pub(super) fn sort(mesh: &TMesh, topology: &Topology, data: &Data, pool: &Pool) -> Self {
        let uv = data.sample_uv();
        let leaf = |&uv: &DVec2| topology.leaf_of(mesh.locate(uv)) as u32;
        let leaves: Vec<u32> = pool.run(|| uv.par_iter().with_min_len(4096).map(leaf).collect_vec());
        Self { uv, by_leaf: Lists::by_key(topology.leaves.len(), &leaves) }
    }

    pub(super) fn of(&self, leaf: usize) -> &[u32] {
        self.by_leaf.of(leaf)
    }

    /// The sums over the samples of a leaf.
    fn sums(&self, domain: &Domain, leaf: usize, data: &Data) -> CellSums {
        let mut sums = CellSums::new(data.dim);
        pulp::Arch::new().dispatch(
            #[inline(always)]
            || {
                for &sample in self.of(leaf) {
                    let sample = sample as usize;
                    let at = (self.uv[sample] - domain.min) / domain.size();
                    let value = &data.sample_values[sample * data.dim..][..data.dim];
                    let weight = data.sample_weights.get(sample).copied().unwrap_or(1.0);
                    sums.add(&weights(at.x, at.y), value, weight);
                }
            },
        );
        sums
    }

    /// Makes a share of the sums of each leaf, and adds the shares in the order of the leaves. Those of one batch are there at
    /// once: the batch bounds the memory, and is fixed.
    pub(super) fn add_shares<S: Send>(
        &self,
        (mesh, topology): (&TMesh, &Topology),
        data: &Data,
        known: &mut KnownSums,
        (pool, watch): (&Pool, &Watch),
        share: impl Fn(usize, &CellSums) -> S + Sync,
        mut add: impl FnMut(usize, S),
    ) -> Result<(), FitError> {
        let cell = |leaf: usize| mesh.cell(topology.leaves[leaf]);
        let leaves: Vec<usize> = (0..topology.leaves.len()).collect();
        for batch in leaves.chunks(16 * PIECE) {
            watch.check()?;
            let shares: Vec<(Option<CellSums>, S)> = pool.run(|| {
                let share = |&leaf: &usize| {
                    let compute = || self.sums(&mesh.cell_domain(cell(leaf)), leaf, data);
                    known.with(cell(leaf), compute, |sums| share(leaf, sums))
                };
                let pieces = batch.par_chunks(PIECE);
                pieces.flat_map_iter(|piece| piece.iter().map(share).collect::<Vec<_>>()).collect()
            });
            for (&leaf, (new, share)) in batch.iter().zip(shares) {
                known.keep(cell(leaf), new);
                add(leaf, share);
            }
        }
        known.forget_others(leaves.iter().map(|&leaf| cell(leaf)));
        Ok(watch.check()?)
    }
}

/// Sums of cells that later meshes may have too. They hold as long as no sample moves and no weight changes.
#[derive(Default)]
pub(super) struct KnownSums {
    keeps: bool,
    sums: BTreeMap<Cell, CellSums>,
}

impl KnownSums {
    /// None yet; later ones are kept if samples stay where they are.
    pub(super) fn new(keeps: bool) -> Self {
        Self { keeps, sums: BTreeMap::new() }
    }

    /// Forgets all, and keeps later ones.
    pub(super) fn renew(&mut self) {
        *self = Self::new(true);
    }

    /// What is made of the sums of a cell, and those sums if they are new.
    fn with<T>(
        &self,
        cell: Cell,
        compute: impl FnOnce() -> CellSums,
        make: impl FnOnce(&CellSums) -> T,
    ) -> (Option<CellSums>, T) {
        match self.sums.get(&cell) {
            Some(sums) => (None, make(sums)),
            None => {
                let sums = compute();
                let made = make(&sums);
                (Some(sums), made)
            }
        }
    }

    /// Keeps new sums.
    fn keep(&mut self, cell: Cell, new: Option<CellSums>) {
        if self.keeps && self.sums.len() < MOST_KEPT {
            self.sums.extend(new.map(|sums| (cell, sums)));
        }
    }

    /// Where there is no room for more, forgets cells that are not among these.
    fn forget_others(&mut self, cells: impl Iterator<Item = Cell>) {
        if self.sums.len() >= MOST_KEPT {
            let present: BTreeSet<Cell> = cells.collect();
            self.sums.retain(|cell, _| present.contains(cell));
        }
    }
}

/// Most cells whose sums are kept: a little over two kilobytes each.
const MOST_KEPT: usize = 16_384;

/// Leaves summed in one piece of work; what they add is kept at once.
const PIECE: usize = 64;

/// What weighs against the data.
#[derive(Default)]
pub(super) struct Energy {
    /// Of the plate in a cell of the initial grid, mapped to the unit cell.
    plate: f64,
    /// By how much more it weighs with each level.
    growth: f64,
    /// The membrane in each leaf; empty for none.
    membranes: Vec<Membrane>,
}

impl Energy {
    /// A plate of its own in every cell, all of one weight; and membranes.
    pub(super) fn by_cell(plate: f64, membranes: Vec<Membrane>) -> Self {
        Self { plate, growth: 1.0, membranes }
    }

    /// One plate over the domain, which in a cell of the initial grid weighs `plate`; and membranes. The energy over a cell
    /// is that of the unit cell divided by its area.
    pub(super) fn of_domain(plate: f64, membranes: Vec<Membrane>) -> Self {
        Self { plate, growth: 4.0, membranes }
    }

    /// The weight of the plate in a cell of a level.
    pub(super) fn plate(&self, level: u32) -> f64 {
        self.plate * self.growth.powi(level as i32)
    }

    /// The membrane in a leaf.
    pub(super) fn membrane(&self, leaf: usize) -> Membrane {
        self.membranes.get(leaf).copied().unwrap_or_default()
    }
}
