//! Local detail: finer cells, and the vertices to edit, in a rectangle of parameters.

use super::{PhtError, PhtSurface};
use crate::geometry::Domain;
use crate::memory::{self, CollectVec};
use crate::tmesh::{Cell, MAX_LEVEL, TMeshError};

impl PhtSurface {
    /// Splits all leaves that meet the inside of a rectangle until they have at least this level. The surface
    /// stays the same; there will be at most `max_cells` leaves, or nothing changes.
    pub fn refine_region(&mut self, region: Domain, level: u32, max_cells: usize) -> Result<(), PhtError> {
        if level > MAX_LEVEL {
            return Err(TMeshError::LevelLimit { index: 0, level, limit: MAX_LEVEL }.into());
        }
        let mut mesh = self.mesh.clone();
        let mut splits: Vec<Cell> = Vec::new();
        let mut open: Vec<_> = mesh.leaves().collect_vec();
        while let Some(leaf) = open.pop() {
            let cell = mesh.cell(leaf);
            let domain = mesh.cell_domain(cell);
            let meets = domain.min.cmplt(region.max).all() && region.min.cmplt(domain.max).all();
            if cell.level >= level || !meets {
                continue;
            }
            let count = mesh.leaf_count() + 3;
            if count > max_cells {
                return Err(PhtError::TooLarge { what: "cells", count, limit: max_cells });
            }
            mesh.split(leaf);
            memory::push(&mut splits, cell);
            memory::extend(&mut open, mesh.children(leaf).into_iter().flatten());
        }
        self.split(&splits)
    }

    /// The ranks of the basis vertices inside a rectangle or on its border, ascending.
    pub fn vertices_in(&self, region: Domain) -> Vec<usize> {
        let inside = |vertex| region.contains(self.mesh.parameters(vertex));
        self.jets
            .keys()
            .enumerate()
            .filter(|&(_, &vertex)| inside(vertex))
            .map(|(rank, _)| rank)
            .collect_vec()
    }
}
