//! Skinning: rows of points with unlike counts become one surface, without knot explosion.
//!
//! X. Yang and J. Zheng, "Approximate T-spline surface skinning" (2012). Each row is replaced by a C2 cubic `R_l`
//! through its points. The surface through them is a sum over control curves,
//! ```text
//! S(u,v) = sum_j Q_j(u) N_j(v),   Q_j = sum_l C_jl R_l
//! ```
//! each of which would need the knots of all rows. Instead each is interpolated at as few knots as keep it within
//! the tolerance, which makes the surface a T-spline and keeps the tolerance at every datum.
//!
//! Nothing is guaranteed between the data, where sparse rows may deviate ten times as far: `extra_checks` looks
//! there too, and `certify` bounds the distance everywhere.

mod align;
mod approximate;
mod certificate;
mod common;
mod control_curve;
mod distinct;
mod error;
mod loft;
mod monotone;
mod options;
mod report;
mod rows;
mod sections;
#[cfg(test)]
mod tests;

pub use error::SkinError;
pub use options::{SectionEnds, SkinMethod, SkinOptions, VRule, VSlopes};
pub use report::SkinReport;
pub use rows::Rows;

use crate::control::{Control, Stage, Watch};
use crate::curve::Curve;
use crate::fit::common::errors::data_errors;
use crate::fit::common::report::{FitReport, Goal, Remarks, StopReason};
use crate::memory::{self, CollectVec};
use crate::surface::Surface;
use crate::surface::tspline::TSplineSurface;
use control_curve::{Approximation, Rules, Target, row_values};
use glam::DVec2;
use loft::Loft;
use rayon::prelude::*;
use rows::Data;
use sections::Section;
use std::time::Instant;

/// A skin with all that is known of it.
#[derive(Debug, Clone)]
pub struct SkinFit {
    /// The surface, over the unit square.
    pub surface: TSplineSurface,
    /// What every fit says.
    pub report: FitReport,
    /// What only skins say.
    pub skin: SkinReport,
    /// The (u,v) of each point at which its error is measured.
    pub parameters: Vec<DVec2>,
    /// The error of each point.
    pub errors: Vec<f64>,
}

/// Skins rows of points.
pub fn skin(rows: &Rows, options: &SkinOptions, control: &mut Control) -> Result<SkinFit, SkinError> {
    let start = Instant::now();
    check(options)?;
    skin_data(Data::of_rows(rows, options)?, options, control, start)
}

/// Skins section curves, of any degree and over any domains. Their data are their values at their different knots;
/// `ends` and `align` are not used.
pub fn skin_curves(
    curves: &[Curve],
    options: &SkinOptions,
    control: &mut Control,
) -> Result<SkinFit, SkinError> {
    let start = Instant::now();
    check(options)?;
    skin_data(Data::of_curves(curves, options)?, options, control, start)
}

/// Most places between two data at which a control curve may be checked.
const MOST_EXTRA_CHECKS: usize = 100;

fn check(options: &SkinOptions) -> Result<(), SkinError> {
    let check = |holds: bool, option, value, range| {
        if holds { Ok(()) } else { Err(SkinError::Option { option, value, range }) }
    };
    let tolerance = options.tolerance.value;
    check(tolerance > 0.0 && tolerance.is_finite(), "tolerance", tolerance, "positive and finite")?;
    let checks = options.extra_checks;
    check(checks <= MOST_EXTRA_CHECKS, "extra_checks", checks as f64, "at most 100")?;
    let has_tangents = options.begin_tangents.is_some() || options.end_tangents.is_some();
    check(!(options.closed_v && has_tangents), "closed_v", 1.0, "0 where tangents at the ends are given")?;
    let loose_ends = !options.closed_v && !has_tangents;
    check(!options.approximate_v || loose_ends, "approximate_v", 1.0, "0 with tangents or closed along v")?;
    let is_plain = loose_ends && !options.approximate_v;
    let needed = "0 with tangents, closed along v or with approximate_v";
    check(options.v_slopes == VSlopes::Smooth || is_plain, "v_slopes", 1.0, needed)
}

/// The control curves with what it took to find them.
struct ControlCurves {
    curves: Vec<Curve>,
    passes: usize,
    removed_knots: usize,
    certified_distance: f64,
    is_stalled: bool,
}

/// What the work on threads comes to.
struct Solved {
    loft: Loft,
    found: ControlCurves,
    /// The part of the error that fewer knots along v leave.
    v_error: f64,
    /// Control points over common knots; 0 unless asked for.
    common_count: usize,
}

fn skin_data(
    mut data: Data,
    options: &SkinOptions,
    control: &mut Control,
    start: Instant,
) -> Result<SkinFit, SkinError> {
    let goal = Goal::new(&options.tolerance, &data.bounds);
    let steps = Steps::new(&data, options)?;
    if options.v_slopes == VSlopes::Monotone {
        let parameters = steps.parameters(data.sources.row_count);
        monotone::add_slopes(&mut data.sources, &parameters, data.is_periodic)?;
    }
    let data = &data;
    control.enter(Stage::Fit);
    let mut solved = control.watch(|_, watch| solve(data, &steps, options, goal.tolerance, watch))??;
    let surface = assemble(&mut solved)?;
    let place = |&(row, u): &(usize, f64)| DVec2::new(u, solved.loft.parameters[row]);
    let parameters: Vec<DVec2> = data.places.iter().map(place).collect_vec();
    let errors = data_errors(&surface, &parameters, &data.values, control.pool());
    control.report(1.0, errors.max)?;

    let skin = skin_report(data, &solved, &surface)?;
    let stop = if solved.found.is_stalled { StopReason::Stagnated } else { StopReason::ToleranceMet };
    let mut report = FitReport {
        grid_u: skin.largest_count - 2,
        grid_v: surface.knots_v().spans().len() + 1,
        coefficient_count: surface.coefficient_count(),
        seconds: start.elapsed().as_secs_f64(),
        ..FitReport::new(&errors, &goal, stop, solved.found.passes)
    };
    let remarks = &mut report.remarks;
    remarks.add_if(data.merged_points > 0, Remarks::MERGED_POINTS);
    remarks.add_if(data.twisted_row.is_some(), Remarks::TWISTED_ROWS);
    remarks.add_if(steps.is_mean && options.v_rule == VRule::Endpoints, Remarks::MEAN_STEPS);
    remarks.add_if(skin.overshoot > CLUSTERED_OVERSHOOT, Remarks::CLUSTERED_ROWS);
    Ok(SkinFit { surface, report, skin, parameters, errors: errors.each })
}

/// Finds the control curves.
fn solve(
    data: &Data,
    steps: &Steps,
    options: &SkinOptions,
    tolerance: f64,
    watch: &Watch,
) -> Result<Solved, SkinError> {
    let (loft, v_error) = lofted(data, steps, options, tolerance, watch)?;
    let rules = Rules {
        tolerance: tolerance - v_error,
        extra_checks: options.extra_checks,
        batch: options.batch,
        removal: options.removal,
        is_periodic: data.is_periodic,
    };
    let wants_common = options.method == SkinMethod::CommonKnots;
    let mut common_count = 0;
    if wants_common || options.compare {
        let common = common::skin(&loft, &data.sources, rules.tolerance, data.is_periodic, watch)?;
        common_count = loft.knots_v.basis_count() * common.curves[0].knots().basis_count();
        if wants_common {
            return Ok(Solved { loft, found: common, v_error, common_count });
        }
    }
    let found = control_curves(&loft, data, &rules, options.certify, watch)?;
    Ok(Solved { loft, found, v_error, common_count })
}

/// The surface; closed along v it has its first three curves once more at the end.
fn assemble(solved: &mut Solved) -> Result<TSplineSurface, SkinError> {
    let mut curves = std::mem::take(&mut solved.found.curves);
    let repeated = solved.loft.knots_v.basis_count() - curves.len();
    curves.extend_from_within(..repeated);
    Ok(TSplineSurface::new(solved.loft.knots_v.clone(), curves)?)
}

fn skin_report(data: &Data, solved: &Solved, surface: &TSplineSurface) -> Result<SkinReport, SkinError> {
    let counts = surface.curves().iter().map(|curve| curve.knots().basis_count());
    Ok(SkinReport {
        curve_count: surface.curves().len(),
        least_count: counts.clone().min().unwrap_or(0),
        largest_count: counts.max().unwrap_or(0),
        tensor_count: surface.tensor_coefficient_count()?,
        strip_count: surface.strip_coefficient_count()?,
        common_count: solved.common_count,
        removed_knot_count: solved.found.removed_knots,
        merged_point_count: data.merged_points,
        aligned_row_count: data.aligned_rows,
        twisted_row: data.twisted_row,
        overshoot: solved.loft.overshoot,
        certified_distance: solved.found.certified_distance,
        v_error: solved.v_error,
    })
}

/// Control curves that are thirty times larger than the rows, where equal steps give three, are worth a remark: they
/// need knots that the rows do not, and between clustered rows the surface may wave.
const CLUSTERED_OVERSHOOT: f64 = 30.0;

/// How far each row is from the one before it, and the last from the first for a surface closed along v.
struct Steps {
    steps: Vec<f64>,
    is_mean: bool,
}

impl Steps {
    fn new(data: &Data, options: &SkinOptions) -> Result<Self, SkinError> {
        let rows = data.sources.rows();
        let least_rows = if options.closed_v { 3 } else { 2 };
        if rows.len() < least_rows {
            return Err(SkinError::TooFewRows { count: rows.len(), least: least_rows });
        }
        if options.v_rule == VRule::Endpoints {
            let steps = distances(rows, &[0.0, 1.0], options.closed_v);
            let mean = steps.iter().sum::<f64>() / steps.len() as f64;
            if steps.iter().all(|&step| step > LEAST_STEP * mean) {
                return Ok(Self { steps, is_mean: false });
            }
        }
        let shares: Vec<f64> = (0..MEAN_SAMPLES).map(|k| k as f64 / (MEAN_SAMPLES - 1) as f64).collect_vec();
        let steps = distances(rows, &shares, options.closed_v);
        let least = IDENTICAL * data.bounds.diagonal();
        match steps.iter().position(|&step| !(step > least)) {
            Some(k) => Err(SkinError::Identical { row: (k + 1) % rows.len() }),
            None => Ok(Self { steps, is_mean: true }),
        }
    }

    fn length(&self) -> f64 {
        self.steps.iter().sum()
    }

    /// Where the rows lie in [0, 1]; the end is not among them for a surface closed along v.
    fn parameters(&self, row_count: usize) -> Vec<f64> {
        let length = self.length();
        let mut at = 0.0;
        let mut parameters = vec![0.0];
        for step in &self.steps[..row_count - 1] {
            at += step;
            parameters.push(at / length);
        }
        parameters
    }
}

/// Steps below this share of the mean step make the rule of end points useless.
const LEAST_STEP: f64 = 1e-3;
/// Rows nearer than this share of the diagonal are the same.
const IDENTICAL: f64 = 1e-12;
/// Places at which rows are compared for the mean step.
const MEAN_SAMPLES: usize = 33;

/// Mean distances of successive rows at some shares of their lengths.
fn distances(rows: &[Section], shares: &[f64], is_closed: bool) -> Vec<f64> {
    let dim = rows[0].dim();
    let mut values: Vec<Vec<f64>> = memory::filled(memory::filled(0.0, shares.len() * dim), rows.len());
    rows.iter().zip(&mut values).for_each(|(row, values)| row.eval_rising(shares, values));
    let length = |a: &[f64], b: &[f64]| a.iter().zip(b).fold(0.0, |length: f64, (a, b)| length.hypot(a - b));
    let mean = |a: &[f64], b: &[f64]| {
        a.chunks(dim).zip(b.chunks(dim)).map(|(a, b)| length(a, b)).sum::<f64>() / shares.len() as f64
    };
    let mut steps: Vec<f64> = values.windows(2).map(|pair| mean(&pair[0], &pair[1])).collect_vec();
    if is_closed {
        steps.push(mean(&values[values.len() - 1], &values[0]));
    }
    steps
}

/// The interpolation along v, and the error that it leaves.
fn lofted(
    data: &Data,
    steps: &Steps,
    options: &SkinOptions,
    tolerance: f64,
    watch: &Watch,
) -> Result<(Loft, f64), SkinError> {
    let parameters = steps.parameters(data.sources.row_count);
    if options.v_slopes == VSlopes::Monotone {
        return Ok((Loft::monotone(parameters)?, 0.0));
    }
    if options.closed_v {
        return Ok((Loft::closed(parameters, 1.0)?, 0.0));
    }
    if options.approximate_v
        && let Some(found) = approximate::loft(&parameters, &data.sources, tolerance, watch)?
    {
        return Ok(found);
    }
    Ok((Loft::interpolating(parameters, data.has_tangents, steps.length())?, 0.0))
}

/// All control curves, each within the tolerance of the exact one at its data.
fn control_curves(
    loft: &Loft,
    data: &Data,
    rules: &Rules,
    certify: bool,
    watch: &Watch,
) -> Result<ControlCurves, SkinError> {
    let sources = &data.sources;
    let of_rows = (0..sources.row_count)
        .into_par_iter()
        .map(|row| watch.check().map(|()| row_values(row, loft, sources)))
        .collect::<Result<Vec<_>, _>>()?;
    let found = (0..loft.curve_count())
        .into_par_iter()
        .map(|curve| {
            watch.check()?;
            let approximation = Target::new(curve, loft, sources, &of_rows, rules).approximate(rules)?;
            let stands_for_it = &approximation.interpolant;
            let bound = match certify {
                true => certificate::distance(curve, loft, sources, stands_for_it),
                false => f64::NAN,
            };
            Ok((stands_for_it.to_curve()?, approximation, bound))
        })
        .collect::<Result<Vec<(Curve, Approximation, f64)>, SkinError>>()?;
    let mut all = ControlCurves {
        curves: memory::with_capacity(found.len()),
        passes: 0,
        removed_knots: 0,
        certified_distance: if certify { 0.0 } else { f64::NAN },
        is_stalled: false,
    };
    for (curve, approximation, bound) in found {
        all.curves.push(curve);
        all.passes += approximation.passes;
        all.removed_knots += approximation.removed_knots;
        all.is_stalled |= approximation.is_stalled;
        // a bound that is not known makes the whole unknown
        let is_larger = !(bound <= all.certified_distance);
        all.certified_distance = if is_larger { bound } else { all.certified_distance };
    }
    Ok(all)
}
