//! How far the surface is from the skin through the section curves, everywhere.
//!
//! Both are sums of control curves with the same positive basis functions, so the distance is at most that of two
//! control curves. Their difference is a cubic between all their knots together; its Bernstein ordinates bound it.

use super::loft::Loft;
use super::sections::{Section, Sources};
use crate::curve::Interpolant;
use crate::memory;

/// A bound of the distance between a control curve and what stands for it; NaN if a section is no cubic.
pub(super) fn distance(curve: usize, loft: &Loft, sources: &Sources, stands_for_it: &Interpolant) -> f64 {
    let sum = &loft.weights[curve];
    let mut u = memory::copied(stands_for_it.parameters());
    for &(source, _) in sum {
        match &sources.sections[source] {
            Section::Cubic(cubic) => u.extend(cubic.parameters()),
            Section::Other { .. } => return f64::NAN,
        }
    }
    u.sort_unstable_by(f64::total_cmp);
    u.dedup();
    let dim = sources.dim;
    let difference = |mut exact: Vec<f64>, eval: fn(&Interpolant, &[f64], &mut [f64])| {
        let mut values = memory::filled(0.0, exact.len());
        eval(stands_for_it, &u, &mut values);
        exact.iter_mut().zip(values).for_each(|(exact, x)| *exact -= x);
        exact
    };
    let points = difference(sources.combine(&[sum], &u).swap_remove(0), Interpolant::eval_rising);
    let slopes = difference(sources.slopes(sum, &u), Interpolant::slopes_rising);
    let length = |row: &[f64]| row.iter().fold(0.0, |length: f64, x| length.hypot(*x));
    let Ok(difference) = Interpolant::with_slopes(dim, u, points, slopes) else { return f64::NAN };
    let spans = 0..difference.parameters().len() - 1;
    let ordinates = |l: usize| difference.ordinates(l).chunks(dim).map(length).fold(0.0, f64::max);
    spans.map(ordinates).fold(0.0, f64::max)
}
