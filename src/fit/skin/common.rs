//! The skin over common knots, for comparison.
//!
//! L. Piegl and W. Tiller, "Surface skinning revisited" (2002): all rows share their knots, the two ends at first;
//! each row is interpolated there, and the parameter of the worst datum of all rows becomes the next knot. The
//! control points of the rows are then combined as the rows themselves would be.

use super::loft::Loft;
use super::sections::{Section, Sources};
use super::{ControlCurves, SkinError};
use crate::control::Watch;
use crate::curve::{Curve, EndRule, Interpolant};
use crate::memory;
use rayon::prelude::*;

/// Parameters nearer than this to a knot do not become knots.
const LEAST_GAP: f64 = 1e-9;

/// Skins with common knots.
pub(super) fn skin(
    loft: &Loft,
    sources: &Sources,
    tolerance: f64,
    is_periodic: bool,
    watch: &Watch,
) -> Result<ControlCurves, SkinError> {
    let mut knots = vec![0.0, 1.0];
    let mut passes = 0;
    let is_stalled = loop {
        watch.check()?;
        passes += 1;
        let worst = worst_datum(sources.rows(), &knots, is_periodic)?;
        match worst.filter(|&(error, _)| !(error < tolerance)) {
            None => break false,
            Some((_, u)) => {
                let place = knots.partition_point(|&t| t < u);
                if knots[place] - u < LEAST_GAP || u - knots[place - 1] < LEAST_GAP {
                    break true;
                }
                knots.insert(place, u);
            }
        }
    };
    let curves =
        sources.sections.iter().map(|section| Ok(interpolate(section, &knots, is_periodic)?.to_curve()?));
    let curves = curves.collect::<Result<Vec<Curve>, SkinError>>()?;
    let combined = loft.weights.iter().map(|combination| {
        let mut points = memory::filled(0.0, curves[0].control_points().len());
        for &(source, weight) in combination {
            points.iter_mut().zip(curves[source].control_points()).for_each(|(sum, x)| *sum += weight * x);
        }
        Curve::new(sources.dim, curves[0].knots().clone(), points)
    });
    Ok(ControlCurves {
        curves: combined.collect::<Result<_, _>>()?,
        passes,
        removed_knots: 0,
        certified_distance: f64::NAN,
        is_stalled,
    })
}

fn interpolate(section: &Section, knots: &[f64], is_periodic: bool) -> Result<Interpolant, SkinError> {
    let dim = section.dim();
    let mut points = memory::filled(0.0, knots.len() * dim);
    section.eval_rising(knots, &mut points);
    let mut slopes = memory::filled(0.0, 2 * dim);
    section.slopes_rising(&[0.0, 1.0], &mut slopes);
    let (begin, end) = slopes.split_at(dim);
    let ends = if is_periodic { EndRule::Periodic } else { EndRule::Slopes { begin, end } };
    Ok(Interpolant::new(dim, memory::copied(knots), points, ends)?)
}

/// The largest error of all rows at their data that are no knots, and its parameter.
fn worst_datum(rows: &[Section], knots: &[f64], is_periodic: bool) -> Result<Option<(f64, f64)>, SkinError> {
    let of_row = |row: &Section| -> Result<Option<(f64, f64)>, SkinError> {
        let interpolant = interpolate(row, knots, is_periodic)?;
        let mut exact = memory::filled(0.0, row.breaks().len() * row.dim());
        row.eval_rising(row.breaks(), &mut exact);
        let mut errors_sq = memory::filled(0.0, row.breaks().len());
        interpolant.distances_sq(row.breaks(), &exact, &mut errors_sq);
        let data = errors_sq.iter().zip(row.breaks()).map(|(error, &u)| (error.sqrt(), u));
        Ok(data.max_by(|a, b| a.0.total_cmp(&b.0)))
    };
    let worst = rows.par_iter().map(of_row).collect::<Result<Vec<_>, _>>()?;
    Ok(worst.into_iter().flatten().max_by(|a, b| a.0.total_cmp(&b.0)))
}
