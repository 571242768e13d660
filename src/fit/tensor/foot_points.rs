//! Parameter correction on a grid.

use super::Problem;
use super::single_grid::Candidate;
use crate::control::Pool;
use crate::fit::common::foot_points::{LONGEST_STEP, STEPS, gauss_newton_step, hold_back};
use crate::surface::Surface;
use glam::DVec2;
use rayon::prelude::*;

/// A triangle that keeps less than this share of its area holds its nodes back.
const LEAST_AREA: f64 = 1e-3;
impl Problem<'_> {
    /// Where the data go.
    pub fn foot_points(&self, candidate: &Candidate, pool: &Pool) -> Vec<DVec2> {
        let cell = DVec2::new(candidate.grid[0].step, candidate.grid[1].step);
        let dim = self.dim;
        let mut moved = self.uv.clone();
        pool.run(|| {
            moved.par_iter_mut().zip(self.values.par_chunks(dim)).for_each(|(uv, value)| {
                let mut row = vec![0.0; 3 * dim];
                for _ in 0..STEPS {
                    candidate.surface.eval_rows(&[*uv], 1, &mut row);
                    let step = gauss_newton_step(&row, value);
                    let longest = LONGEST_STEP * cell;
                    *uv = self.data_box.clamp(*uv + step.clamp(-longest, longest));
                }
            })
        });
        if let Some(mesh) = self.mesh {
            hold_back(mesh.triangles(), (&self.uv, LEAST_AREA), &self.uv, &mut moved);
        }
        moved
    }
}
