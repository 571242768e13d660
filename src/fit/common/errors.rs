//! The one measure of error: on the finished surface, through its public evaluation.

use crate::control::Pool;
use crate::memory;
use crate::query::project::{ProjectOptions, Projector};
pub use crate::summary::{DataErrors, summarize};
use crate::surface::Surface;
use glam::DVec2;
use rayon::prelude::*;

/// Data measured in one piece; fixed, so that sums do not depend on the number of threads.
const CHUNK: usize = 1024;

/// Euclidean distances between the surface at `uv` and the rows of `values`.
pub fn data_errors(surface: &dyn Surface, uv: &[DVec2], values: &[f64], pool: &Pool) -> DataErrors {
    let dim = surface.dim();
    let mut each = memory::filled(0.0, uv.len());
    pool.run(|| {
        each.par_chunks_mut(CHUNK).zip(uv.par_chunks(CHUNK)).zip(values.par_chunks(CHUNK * dim)).for_each(
            |((each, uv), values)| {
                // a cancelled call throws its errors away
                if pool.check().is_err() {
                    return;
                }
                let mut rows = memory::filled(0.0, uv.len() * dim);
                surface.eval_rows(uv, 0, &mut rows);
                for ((error, row), value) in each.iter_mut().zip(rows.chunks(dim)).zip(values.chunks(dim)) {
                    *error = row.iter().zip(value).map(|(s, p)| (s - p) * (s - p)).sum::<f64>().sqrt();
                }
            },
        )
    });
    summarize(each)
}

/// Largest closest-point distance from data to the part of a surface inside its trims; NaN if they cannot be
/// projected.
pub(in crate::fit) fn max_distance(
    surface: &dyn Surface,
    values: &[f64],
    guesses: &[DVec2],
    pool: &Pool,
) -> f64 {
    let options = ProjectOptions { guesses: Some(guesses), ..Default::default() };
    match Projector::new(surface).and_then(|projector| projector.project(values, &options, pool)) {
        Ok(projection) => projection.distances.into_iter().fold(0.0, f64::max),
        Err(_) => f64::NAN,
    }
}
