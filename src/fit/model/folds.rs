//! Cells in which a surface turns its back: its normal points against that of the mesh there.
//!
//! Neither the error, nor the volume, nor a check of the topology sees a fold: a patch may run over itself within the
//! tolerance of all samples.

use super::samples::{ByCell, CellPlace, Samples};
use crate::control::Pool;
use crate::layout::Place;
use crate::surface::Surface;
use crate::surface::pht::PhtSurface;
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// Places along a side of a cell at which the normal is looked at.
const PLACES: usize = 4;

/// The cells with a reversed normal, ascending. The normal of the mesh is that of the sample that lies nearest in the cell, where
/// the mesh is cut along its sharp edges; where they are rounded (`is_cut` false) a normal is between those on both sides, and
/// reversed if it is so against all samples of the cell. For a cell without samples `elsewhere` says the normal.
pub(super) fn folded_cells(
    surfaces: &[PhtSurface],
    (quads, cells): (&[u32], &[CellPlace]),
    (samples, places): (&Samples, &[Place]),
    by_cell: &ByCell,
    is_cut: bool,
    elsewhere: &(dyn Fn(u32, DVec3) -> DVec3 + Sync),
    pool: &Pool,
) -> Vec<usize> {
    let is_folded = |&cell: &usize| {
        let (quad, CellPlace { min, size }) = (quads[cell], cells[cell]);
        let place = |k: usize| {
            min + size * (DVec2::new((k / PLACES) as f64, (k % PLACES) as f64) + 0.5) / PLACES as f64
        };
        let uv: Vec<DVec2> = (0..PLACES * PLACES).map(place).collect();
        let mut rows = vec![0.0; 9 * uv.len()];
        surfaces[quad as usize].eval_rows(&uv, 1, &mut rows);
        uv.iter().zip(rows.chunks_exact(9)).any(|(uv, row)| {
            let [point, along_u, along_v] = [0, 3, 6].map(|k| DVec3::from_slice(&row[k..k + 3]));
            let turn = along_u.cross(along_v);
            let is_against = |&sample: &u32| turn.dot(samples.normals[sample as usize]) < 0.0;
            let squared = |&sample: &u32| places[sample as usize].uv.distance_squared(*uv);
            let of_cell = by_cell.of(cell);
            let nearest = of_cell.iter().min_by(|a, b| squared(a).total_cmp(&squared(b)).then(a.cmp(b)));
            match nearest {
                Some(nearest) if is_cut => is_against(nearest),
                Some(_) => of_cell.iter().all(is_against),
                None => turn.dot(elsewhere(quad, point)) < 0.0,
            }
        })
    };
    let all: Vec<usize> = (0..cells.len()).collect();
    pool.run(|| all.into_par_iter().with_min_len(16).filter(is_folded).collect())
}
