//! The errors of a leaf, and what is split for them where the surface has two continuous derivatives.
//!
//! A cell that is split alone adds no function: one of the next level is there when the four by four cells of its support
//! are. For a datum that misses the tolerance the least that helps are two by two cells around it, so chosen that it
//! lies in the middle half of the new function's support.
//! ```text
//! +-------+-------+      x misses the tolerance, in the upper right quarter of its cell:
//! |       |       |      that cell and those to the right and above are split, and with
//! |       |       |      them the function over all four is there
//! +-------+-------+
//! |     x |       |
//! |       |       |
//! +-------+-------+
//! ```

use crate::tmesh::{Cell, NodeId, QUADRANTS, TMesh};

/// Where the tolerance is missed, cells are split that use up more than this share of it: half the rounds, and few
/// functions more.
const MARGIN: f64 = 0.8;

/// The errors of one leaf.
pub(super) struct LeafErrors {
    pub cell: Cell,
    pub samples: usize,
    /// The largest error in it.
    pub error: f64,
    /// What may be expected at the places between its data.
    pub expected: f64,
    /// The largest error in each quarter, in the order of the quadrants.
    pub quarters: [f64; 4],
}

/// Splits the two by two cells around each quarter of a leaf in which an error is too large.
pub(super) fn split_around<E>(
    mesh: &mut TMesh,
    leaf: &LeafErrors,
    tolerance: f64,
    allow: &mut impl FnMut(&TMesh, NodeId) -> Result<(), E>,
) -> Result<(), E> {
    let doubt = if leaf.error > 0.0 { leaf.expected / leaf.error } else { 1.0 };
    for (error, quadrant) in leaf.quarters.into_iter().zip(QUADRANTS) {
        if doubt * error <= MARGIN * tolerance {
            continue;
        }
        for other in QUADRANTS {
            let Cell { level, i, j } = leaf.cell;
            // the lower left cell of the four is one to the left, or below, where the quarter is the left or lower one
            let along = |at: u32, near: u32, far: u32| (at + near + far).checked_sub(1);
            let (i, j) = (along(i, quadrant[0], other[0]), along(j, quadrant[1], other[1]));
            if let (Some(i), Some(j)) = (i, j) {
                split_cell(mesh, Cell { level, i, j }, allow)?;
            }
        }
    }
    Ok(())
}

/// Splits a cell, and before it those that it is a part of; nothing beyond the border.
fn split_cell<E>(
    mesh: &mut TMesh,
    cell: Cell,
    allow: &mut impl FnMut(&TMesh, NodeId) -> Result<(), E>,
) -> Result<(), E> {
    if mesh.find(cell).is_none() {
        match cell.parent() {
            Some(parent) => split_cell(mesh, parent, allow)?,
            None => return Ok(()),
        }
    }
    match mesh.find(cell).filter(|&node| mesh.is_leaf(node)) {
        Some(leaf) => {
            allow(mesh, leaf)?;
            mesh.split(leaf);
            Ok(())
        }
        None => Ok(()),
    }
}
