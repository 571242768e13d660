//! The one measure of error: on the finished surface, through its public evaluation.

use crate::control::Pool;
use crate::surface::Surface;
use glam::DVec2;
use rayon::prelude::*;

/// Errors at some data.
#[derive(Debug, Clone, Default)]
pub struct DataErrors {
    /// |S(u_n,v_n) - P_n| of each datum.
    pub each: Vec<f64>,
    /// The largest; 0 without data.
    pub max: f64,
    /// Square root of the mean square.
    pub rms: f64,
    /// The mean.
    pub mean: f64,
    /// The datum with the largest error.
    pub worst_index: usize,
}

/// Data measured in one piece; fixed, so that sums do not depend on the number of threads.
const CHUNK: usize = 1024;

/// Euclidean distances between the surface at `uv` and the rows of `values`.
pub fn data_errors(surface: &dyn Surface, uv: &[DVec2], values: &[f64], pool: &Pool) -> DataErrors {
    let dim = surface.dim();
    let mut each = vec![0.0; uv.len()];
    pool.run(|| {
        each.par_chunks_mut(CHUNK).zip(uv.par_chunks(CHUNK)).zip(values.par_chunks(CHUNK * dim)).for_each(
            |((each, uv), values)| {
                let mut rows = vec![0.0; uv.len() * dim];
                surface.eval_rows(uv, 0, &mut rows);
                for ((error, row), value) in each.iter_mut().zip(rows.chunks(dim)).zip(values.chunks(dim)) {
                    *error = row.iter().zip(value).map(|(s, p)| (s - p) * (s - p)).sum::<f64>().sqrt();
                }
            },
        )
    });
    summarize(each)
}

/// Sums up the errors of single data.
pub fn summarize(each: Vec<f64>) -> DataErrors {
    let count = each.len().max(1) as f64;
    let (worst_index, max) = each
        .iter()
        .enumerate()
        .fold((0, 0.0), |worst, (index, &error)| if error > worst.1 { (index, error) } else { worst });
    // scaled by the largest, so that squares neither overflow nor vanish
    let scale = if max > 0.0 { max } else { 1.0 };
    let squares: f64 = each.iter().map(|e| (e / scale) * (e / scale)).sum();
    let sum: f64 = each.iter().sum();
    DataErrors { rms: scale * (squares / count).sqrt(), mean: sum / count, max, worst_index, each }
}
