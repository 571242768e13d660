//! Bezier cells: the surface itself, not an approximation of it.
//!
//! A VTK_BEZIER_QUADRILATERAL has its corners first, then the inner points of its sides, then those inside:
//! ```text
//!   v                        sides in the order bottom, right, top, left, each towards larger u or v;
//!   3---8---9---2            inside u runs fastest
//!   |           |
//!  11  14  15   7
//!  10  12  13   6
//!   |           |
//!   0---4---5---1  u
//! ```

use super::grid::{self, Grid};
use crate::bezier::BezierPatch;
use crate::export::error::ExportError;
use crate::file;
use crate::memory::{self, CollectVec};
use crate::surface::Patches;
use std::path::Path;

/// Writes all patches of a surface in space as Bezier cells. Trims are not shown: a cell is a whole patch.
pub fn write_patches(patches: &dyn Patches, path: &Path) -> Result<(), ExportError> {
    let patches: Vec<BezierPatch> =
        (0..patches.patch_count()).map(|index| patches.patch(index)).collect_vec();
    if let Some(patch) = patches.iter().find(|patch| patch.dim != 3) {
        return Err(ExportError::Dimension { dim: patch.dim });
    }
    let (mut points, mut weights, mut degrees) = (Vec::new(), Vec::new(), Vec::new());
    for patch in &patches {
        for at in order(patch.degree) {
            let row = &patch.ordinates[at * patch.width()..][..patch.width()];
            let weight = if patch.is_rational { row[3] } else { 1.0 };
            memory::extend(&mut points, row[..3].iter().map(|x| x / weight));
            memory::push(&mut weights, weight);
        }
        memory::extend(&mut degrees, [patch.degree[0] as f64, patch.degree[1] as f64, 0.0]);
    }
    let is_rational = patches.iter().any(|patch| patch.is_rational);
    let mut grid = Grid::new(weights.len(), patches.len());
    if is_rational {
        grid.section("PointData", " RationalWeights=\"RationalWeights\"", |grid| {
            grid.doubles("RationalWeights", 1, &weights);
        });
    }
    grid.section("CellData", " HigherOrderDegrees=\"HigherOrderDegrees\"", |grid| {
        grid.doubles("HigherOrderDegrees", 3, &degrees);
        let corners = patches.iter().flat_map(|patch| {
            let (min, max) = (patch.domain.min, patch.domain.max);
            [min.x, max.x, min.y, max.y]
        });
        grid.doubles("parameters", 4, &corners.collect::<Vec<f64>>());
    });
    grid.section("Points", "", |grid| grid.doubles("points", 3, &points));
    let mut next = 0;
    grid.cells(
        grid::BEZIER_QUADRILATERAL,
        patches.iter().map(|patch| {
            let first = next;
            next += ((patch.degree[0] + 1) * (patch.degree[1] + 1)) as i64;
            first..next
        }),
    );
    Ok(file::write(path, &grid.finish())?)
}

/// The ordinates of a patch, whose v runs fastest, in the order of a cell.
fn order([p, q]: [usize; 2]) -> Vec<usize> {
    let at = |i: usize, j: usize| i * (q + 1) + j;
    let mut order = vec![at(0, 0), at(p, 0), at(p, q), at(0, q)];
    memory::extend(&mut order, (1..p).map(|i| at(i, 0)));
    memory::extend(&mut order, (1..q).map(|j| at(p, j)));
    memory::extend(&mut order, (1..p).map(|i| at(i, q)));
    memory::extend(&mut order, (1..q).map(|j| at(0, j)));
    memory::extend(&mut order, (1..q).flat_map(|j| (1..p).map(move |i| at(i, j))));
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_ordinate_comes_once() {
        for (p, q) in [(1, 1), (1, 3), (3, 3), (4, 2)] {
            let mut order = order([p, q]);
            order.sort_unstable();
            assert_eq!(order, (0..(p + 1) * (q + 1)).collect::<Vec<_>>(), "{p} {q}");
        }
    }
}
