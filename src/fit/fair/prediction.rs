//! How much of what data say is noise: generalized cross-validation.
//!
//! G. Golub, M. Heath and G. Wahba, "Generalized cross-validation as a method for choosing a good ridge parameter",
//! Technometrics 21 (1979), 215-223; the trace by random signs after M. Hutchinson, Commun. Statist. Simul. 18 (1989).
//! ```text
//! minimize over lambda  (sum_n |s(u_n,v_n) - P_n|^2 / N) / (1 - trace(H) / N)^2,    trace(H) ~ mean of z^T H z
//! ```
//! H makes the values of the surface at the data of theirs, z is a column of signs. In space only what lies across the
//! surface counts: parameters that are feet on it follow its noise along it, and would speak for that.

use super::{FairError, FairReport, Lowest, POWERS, Problem};
use crate::control::{Control, Watch};
use crate::fit::common::signs::{PROBES, signs};
use crate::surface::{Surface, normal};
use glam::{DVec2, DVec3};

/// A score so many times the least ends the search: it grows with the square of the weight from there on.
const HOPELESS: f64 = 4.0;
/// A surface that follows all data but this share of them goes through them: nothing is left that would tell it from noise.
const LEAST_FREEDOM: f64 = 1e-2;
/// Powers of ten beside the best one that are tried at last.
const BESIDE: [f64; 2] = [-0.5, 0.5];

impl Problem<'_> {
    /// The displacement towards the surface that tells each datum best from the others, as far as the tolerance lets it.
    pub(crate) fn lower_to_noise(
        &self,
        report: &mut FairReport,
        control: &mut Control,
    ) -> Result<Vec<f64>, FairError> {
        let mut lowest = Lowest::new(self.space);
        let mut weights = self.reference.weights();
        let Some(balance) = self.balance(&weights) else { return Ok(lowest.displacement) };
        let signs = signs(weights.len());
        let mut best = (f64::INFINITY, f64::from(*POWERS.end()));
        let count = (POWERS.count() + BESIDE.len()) as f64;
        for (k, power) in POWERS.map(f64::from).enumerate() {
            let score = self.score(balance * 10.0_f64.powf(power), &signs, control)?;
            report.passes += 1;
            control.report((k + 1) as f64 / count, f64::NAN)?;
            if score < best.0 {
                best = (score, power);
            } else if score > HOPELESS * best.0 {
                break;
            }
        }
        for power in BESIDE.map(|step| best.1 + step) {
            let score = self.score(balance * 10.0_f64.powf(power), &signs, control)?;
            report.passes += 1;
            if score < best.0 {
                best = (score, power);
            }
        }
        self.sweep(balance * 10.0_f64.powf(best.1), &mut weights, &mut lowest, report, control)?;
        Ok(lowest.displacement)
    }

    fn score(&self, smoothing: f64, signs: &[f64], control: &mut Control) -> Result<f64, FairError> {
        control.watch(|_, watch| self.score_in(smoothing, signs, watch))?
    }

    fn score_in(&self, smoothing: f64, signs: &[f64], watch: &Watch) -> Result<f64, FairError> {
        let weights = self.reference.weights();
        let factor = self.factor(&weights, smoothing, watch)?;
        let mut pull = self.reference.pull(&weights);
        pull.iter_mut().zip(&self.gradient).for_each(|(sum, slope)| *sum -= smoothing * slope);
        let d = self.solve_rows(&factor, &pull, self.space.dim);
        watch.check()?;
        let followed = self.solve_rows(&factor, &self.reference.pull_of(signs, PROBES), PROBES);
        let trace = self.reference.product(&followed, signs, PROBES) / PROBES as f64;
        let count = weights.len() as f64;
        let freedom = 1.0 - trace / count;
        if freedom < LEAST_FREEDOM {
            return Ok(f64::INFINITY);
        }
        Ok(self.squares_across(&d) / count / freedom.powi(2))
    }

    /// The sum of the squares of what data are missed by after a displacement, in space across the surface that is given.
    fn squares_across(&self, d: &[f64]) -> f64 {
        let misses = self.reference.misses(d);
        if self.normals.is_empty() {
            return misses.iter().map(|x| x * x).sum();
        }
        let across = misses.chunks_exact(3).zip(&self.normals);
        across.map(|(miss, normal)| DVec3::from_slice(miss).dot(*normal).powi(2)).sum()
    }
}

/// The normals of a surface in space at the data; none for other surfaces.
pub(crate) fn normals(surface: &dyn Surface, uv: &[DVec2]) -> Vec<DVec3> {
    if surface.dim() != 3 {
        return Vec::new();
    }
    let mut rows = vec![0.0; 9 * uv.len()];
    surface.eval_rows(uv, 1, &mut rows);
    let [su, sv] = [3, 6].map(|k| move |row: &[f64]| DVec3::from_slice(&row[k..]));
    rows.chunks_exact(9).map(|row| normal(su(row), sv(row))).collect()
}
