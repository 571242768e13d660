//! What data must be like before anything is fitted to them.

use super::error::{FitError, LEAST_COUNT};
use crate::geometry::Domain;
use glam::DVec2;

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
        None => Ok(()),
    }
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
    }
    Ok(())
}

/// A range of parameters of a few roundings has no room for knots.
pub(in crate::fit) const LEAST_RANGE: f64 = 64.0 * f64::EPSILON;
