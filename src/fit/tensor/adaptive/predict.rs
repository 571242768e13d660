//! Where the tolerance is out of reach, the data choose the smoothing.
//!
//! G. Golub, M. Heath and G. Wahba, "Generalized cross-validation as a method for choosing a good ridge parameter",
//! Technometrics 21 (1979), 215-223; the trace by random signs after M. Hutchinson, Commun. Statist. Simul. 18 (1989).
//! ```text
//! minimize over lambda  (|r|^2 / N) / (1 - trace(H) / N)^2,    trace(H) ~ mean of z^T H z
//! ```
//! r the errors of the data, H the matrix that makes the fit's values of theirs, z a column of signs.

use super::super::FitError;
use super::net::{Net, NetEquations, NetFitter};
use crate::control::Control;

/// The calmest smoothing that is tried.
const CALMEST: f64 = 1e-2;

impl NetFitter<'_> {
    /// The fit over the same lines that predicts each datum best from the others. More smoothing is tried as long as
    /// that helps.
    pub(super) fn best_predictor(&self, missed: Net, control: &mut Control) -> Result<Net, FitError> {
        let equations = self.assemble(missed.lines.clone(), None, control)?;
        let probes = self.assemble_probes(missed.lines.clone(), control)?;
        let mut smoothing = missed.smoothing;
        let mut best = (self.score(&missed, &probes, control)?, missed);
        loop {
            smoothing *= 10.0;
            if smoothing > CALMEST {
                break;
            }
            let net = self.solve(&equations, smoothing, control)?;
            let score = self.score(&net, &probes, control)?;
            if score >= best.0 {
                break;
            }
            best = (score, net);
        }
        Ok(best.1)
    }

    /// The score of generalized cross-validation.
    fn score(&self, net: &Net, probes: &NetEquations, control: &mut Control) -> Result<f64, FitError> {
        let count = self.problem.uv.len() as f64;
        let freedom = 1.0 - self.trace(probes, net.smoothing, control)? / count;
        let sum: f64 = net.errors.each.iter().zip(&self.weights).map(|(e, weight)| weight * e * e).sum();
        Ok(sum / (count * freedom.max(f64::EPSILON).powi(2)))
    }
}
