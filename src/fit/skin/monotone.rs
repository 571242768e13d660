//! Slopes across the rows that cannot overshoot.
//!
//! F. Fritsch and J. Butland, "A method for constructing local monotone piecewise cubic interpolants", SIAM J. Sci.
//! Stat. Comput. 5 (1984), 300-304, with the weights of K. Brodlie: where two chords `d` before and `e` after a row
//! have one sign,
//! ```text
//! T = 3 (h + k) / ((2 k + h) / d + (k + 2 h) / e),     h, k: the steps before and after
//! ```
//! and 0 where they have not. In each coordinate by itself the cubics with these slopes are monotone between rows, so
//! they stay in the range of the two rows. The price is the second derivative.
//!
//! The slopes are curves along u: found where the row or a neighbour has a knot, interpolated between.

use super::SkinError;
use super::sections::{Section, Sources};
use crate::curve::{EndRule, Interpolant};
use crate::memory::{self, CollectVec};

/// Adds the slopes of all rows, in their order, to the sources.
pub(super) fn add_slopes(sources: &mut Sources, v: &[f64], is_periodic: bool) -> Result<(), SkinError> {
    let slopes = (0..v.len()).map(|row| slopes_of(row, sources.rows(), v, is_periodic));
    let slopes = slopes.collect::<Result<Vec<_>, _>>()?;
    memory::extend(&mut sources.sections, slopes);
    Ok(())
}

fn slopes_of(row: usize, rows: &[Section], v: &[f64], is_periodic: bool) -> Result<Section, SkinError> {
    let near = &rows[row.saturating_sub(1)..(row + 2).min(rows.len())];
    let mut u: Vec<f64> = near.iter().flat_map(|section| section.breaks()).copied().collect_vec();
    u.sort_unstable_by(f64::total_cmp);
    u.dedup_by(|b, a| *b - *a < LEAST_GAP);
    if let Some(last) = u.last_mut() {
        *last = 1.0;
    }
    let dim = rows[row].dim();
    let values = |section: &Section| {
        let mut values = memory::filled(0.0, u.len() * dim);
        section.eval_rising(&u, &mut values);
        values
    };
    let chord = |l: usize| -> Vec<f64> {
        let (from, to) = (values(&rows[l]), values(&rows[l + 1]));
        from.iter().zip(to).map(|(a, b)| (b - a) / (v[l + 1] - v[l])).collect_vec()
    };
    let last = rows.len() - 1;
    let step = |l: usize| v[l + 1] - v[l];
    let slopes: Vec<f64> = match row {
        _ if last == 1 => chord(0),
        0 => end_slopes(&chord(0), &chord(1), [step(0), step(1)]),
        _ if row == last => end_slopes(&chord(last - 1), &chord(last - 2), [step(last - 1), step(last - 2)]),
        _ => {
            let (before, after) = (chord(row - 1), chord(row));
            let steps = [step(row - 1), step(row)];
            before.iter().zip(&after).map(|(&d, &e)| inner_slope(d, e, steps)).collect_vec()
        }
    };
    let ends = if is_periodic { EndRule::Periodic } else { EndRule::Parabolic };
    let fail = |error| SkinError::Row { row, error };
    Ok(Section::Cubic(Interpolant::new(dim, u, slopes, ends).map_err(fail)?))
}

/// Knots of neighbours nearer than this are one.
const LEAST_GAP: f64 = 1e-9;

fn inner_slope(d: f64, e: f64, [h, k]: [f64; 2]) -> f64 {
    if d * e > 0.0 { 3.0 * (h + k) / ((2.0 * k + h) / d + (k + 2.0 * h) / e) } else { 0.0 }
}

/// That of the parabola through three rows, where it does not overshoot.
fn end_slopes(outer: &[f64], inner: &[f64], [h, k]: [f64; 2]) -> Vec<f64> {
    let slope = |(&d, &e): (&f64, &f64)| {
        let parabola = ((2.0 * h + k) * d - h * e) / (h + k);
        // between none and three chords, on the chord's side
        if d > 0.0 { parabola.clamp(0.0, 3.0 * d) } else { parabola.clamp(3.0 * d, 0.0) }
    };
    outer.iter().zip(inner).map(slope).collect_vec()
}
