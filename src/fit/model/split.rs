//! Splitting the cells that miss a tolerance, over all patches of a layout.

use crate::fit::common::report::StopReason;
use crate::geometry::Domain;
use crate::layout::Layout;
use crate::surface::g1::conform;
use crate::tmesh::{NodeId, TMesh};

/// Deepest level of a cell unless the options say otherwise: a 4096th of a side of its patch.
pub(super) const DEEPEST_LEVEL: u32 = 12;

/// Samples of a cell that is split, at least: its quarters have one or two each.
pub(super) const LEAST_SAMPLES: usize = 6;

/// Which cells may be split.
#[derive(Debug, Clone, Copy)]
pub(super) struct SplitLimits {
    pub max_level: u32,
    /// Of all patches; those that conforming needs come on top.
    pub max_cells: usize,
    /// Levels by which neighbours in a patch may differ.
    pub grade: u32,
}

impl Default for SplitLimits {
    fn default() -> Self {
        Self { max_level: DEEPEST_LEVEL, max_cells: usize::MAX, grade: 1 }
    }
}

/// Splits the cells that are to be split, told by their number over all patches and their domain, and those that conforming
/// along the edges of the layout then needs; or says why none could be split.
pub(super) fn split_cells(
    layout: &Layout,
    meshes: &mut [TMesh],
    limits: SplitLimits,
    is_to_split: impl Fn(usize, &Domain) -> bool,
) -> Result<(), StopReason> {
    let before: usize = meshes.iter().map(TMesh::leaf_count).sum();
    let (mut count, mut first, mut stop) = (before, 0, StopReason::DataExhausted);
    for mesh in meshes.iter_mut() {
        let leaves: Vec<NodeId> = mesh.leaves().collect();
        let others = count - mesh.leaf_count();
        let mut allow = |mesh: &TMesh, leaf: NodeId| {
            let has_room = others + mesh.leaf_count() + 3 <= limits.max_cells;
            if mesh.cell(leaf).level < limits.max_level && has_room { Ok(()) } else { Err(StopReason::Limit) }
        };
        for (number, &leaf) in (first..).zip(&leaves) {
            if !is_to_split(number, &mesh.cell_domain(mesh.cell(leaf))) {
                continue;
            }
            // a neighbour may have split it
            if mesh.is_leaf(leaf)
                && let Err(limit) = mesh.split_graded(leaf, limits.grade, &mut allow)
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
    conform(layout, meshes);
    Ok(())
}
