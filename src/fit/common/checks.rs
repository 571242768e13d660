//! What options and data must be like before anything is fitted.

use super::error::{FitError, LEAST_COUNT};
use super::report::Tolerance;
use super::uniform::LARGEST_GRID;
use crate::geometry::Domain;
use glam::DVec2;

/// An option holds what it may.
pub(in crate::fit) fn check_option(
    holds: bool,
    option: &'static str,
    value: f64,
    range: &'static str,
) -> Result<(), FitError> {
    if holds { Ok(()) } else { Err(FitError::Option { option, value, range }) }
}

/// An option that the method does not use is at its default: nobody waits in vain for what it does.
pub(in crate::fit) fn check_unused(
    is_default: bool,
    option: &'static str,
    by: &'static str,
) -> Result<(), FitError> {
    if is_default { Ok(()) } else { Err(FitError::Unused { option, by }) }
}

/// A positive tolerance.
pub(in crate::fit) fn check_tolerance(tolerance: &Tolerance) -> Result<(), FitError> {
    let value = tolerance.value;
    check_option(value > 0.0 && value.is_finite(), "tolerance", value, "positive and finite")
}

/// A weight of the energy that is positive, or may be 0 too.
pub(in crate::fit) fn check_smoothing(smoothing: f64, may_be_zero: bool) -> Result<(), FitError> {
    let range = if may_be_zero { "finite and not negative" } else { "positive and finite" };
    let holds = smoothing > 0.0 || may_be_zero && smoothing == 0.0;
    check_option(holds && smoothing.is_finite(), "smoothing", smoothing, range)
}

/// How far uniform knots reach beyond the data.
pub(in crate::fit) fn check_buffer(buffer: f64) -> Result<(), FitError> {
    check_option((0.0..=10.0).contains(&buffer), "buffer", buffer, "between 0 and 10")
}

/// Numbers of uniform knots that are given.
pub(in crate::fit) fn check_grid(counts: impl IntoIterator<Item = usize>) -> Result<(), FitError> {
    let holds = |count: usize| (2..=LARGEST_GRID).contains(&count);
    let mut counts = counts.into_iter();
    counts.try_for_each(|count| check_option(holds(count), "grid", count as f64, "between 2 and 8193"))
}

/// Values, and weights if there are any, that `count` data can have.
pub(in crate::fit) fn check_values(
    count: usize,
    values: &[f64],
    dim: usize,
    weights: Option<&[f64]>,
) -> Result<(), FitError> {
    check_count(count)?;
    check_rows(count, values, dim)?;
    check_weights(count, weights)
}

/// Finite rows of `dim` numbers.
pub(in crate::fit) fn check_rows(count: usize, values: &[f64], dim: usize) -> Result<(), FitError> {
    if dim == 0 {
        return Err(FitError::Option { option: "dim", value: 0.0, range: "at least 1" });
    }
    let expected = count.saturating_mul(dim);
    if values.len() != expected {
        return Err(FitError::Count { what: "the values", count: values.len(), expected });
    }
    match values.iter().position(|x| !x.is_finite()) {
        Some(index) => Err(FitError::ValuesNotFinite { index: index / dim }),
        None => check_size(values),
    }
}

/// Values whose squares are numbers too.
fn check_size(values: &[f64]) -> Result<(), FitError> {
    let largest = values.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let is_within = largest == 0.0 || (LEAST_SIZE..=LARGEST_SIZE).contains(&largest);
    if is_within { Ok(()) } else { Err(FitError::ValueRange { largest }) }
}

/// As many data as determine anything.
pub(in crate::fit) fn check_count(count: usize) -> Result<(), FitError> {
    if count < LEAST_COUNT { Err(FitError::TooFew { count }) } else { Ok(()) }
}

/// Weights of `count` data, if there are any.
pub(in crate::fit) fn check_weights(count: usize, weights: Option<&[f64]>) -> Result<(), FitError> {
    let Some(weights) = weights else { return Ok(()) };
    if weights.len() != count {
        return Err(FitError::Count { what: "the weights", count: weights.len(), expected: count });
    }
    match weights.iter().position(|&w| !(w > 0.0 && w.is_finite())) {
        Some(index) => Err(FitError::Weight { index, weight: weights[index] }),
        None => Ok(()),
    }
}

/// Parameters that a surface can be fitted over: finite, and of some range both ways.
pub(in crate::fit) fn check_parameters(uv: &[DVec2]) -> Result<(), FitError> {
    if let Some(index) = uv.iter().position(|uv| !uv.is_finite()) {
        return Err(FitError::ParametersNotFinite { index });
    }
    let data = Domain::around(uv.iter().copied());
    for (axis, at, end) in [('u', data.min.x, data.max.x), ('v', data.min.y, data.max.y)] {
        if end - at <= LEAST_RANGE * at.abs().max(end.abs()) {
            return Err(FitError::DegenerateRange { axis, at });
        }
        let (range, largest) = (end - at, at.abs().max(end.abs()));
        if !(range >= LEAST_SIZE && largest <= LARGEST_SIZE) {
            return Err(FitError::Range {
                what: axis,
                size: if range < LEAST_SIZE { range } else { largest },
            });
        }
    }
    Ok(())
}

/// Parameters and values that a fit can take: knots between them, and squares of sums of them, are numbers.
const LEAST_SIZE: f64 = 1e-140;
/// The same upwards.
const LARGEST_SIZE: f64 = 1e140;

/// A range of parameters of a few roundings has no room for knots.
pub(in crate::fit) const LEAST_RANGE: f64 = 64.0 * f64::EPSILON;
