//! A fitted surface with all that is known of it.

use super::report::FitReport;
use glam::DVec2;
use std::time::Instant;

/// A fitted surface with all that is known of it.
#[derive(Debug, Clone)]
pub struct Fit<S> {
    /// The surface; its trims are the boundary loops of the mesh.
    pub surface: S,
    /// What the fit did and how good it is.
    pub report: FitReport,
    /// The (u,v) of each datum at which its error is measured.
    pub parameters: Vec<DVec2>,
    /// The error of each datum.
    pub errors: Vec<f64>,
}

/// Fits, and reports how long that took.
pub(in crate::fit) fn timed<S, E>(fit: impl FnOnce() -> Result<Fit<S>, E>) -> Result<Fit<S>, E> {
    let start = Instant::now();
    let mut fit = fit()?;
    fit.report.seconds = start.elapsed().as_secs_f64();
    Ok(fit)
}
