//! Choices that fits of several kinds offer.

use super::arguments::{ArgumentError, choice};
use crate::fit::common::uniform::{Ends, Energy};
use crate::fit::common::{Missing, Regularize};
use crate::fit::report::{Tolerance, ToleranceScale};

/// What a tolerance is measured in.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_tolerance_scale {
    /// The diagonal of the data's bounding box; for a field, of the box of its values.
    Relative = 0,
    /// Model units.
    Absolute = 1,
}

/// What the values of points and fields mean that are NaN.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_missing {
    /// A mistake: PLANISH_STATUS_NOT_FINITE.
    Refused = 0,
    /// There is none: the datum is passed over, and its error is NaN.
    Skipped = 1,
}

/// Where the knot lines of a tensor fit stand.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_knots {
    /// Where the error asks for them: lines are inserted and taken out one by one.
    Adaptive = 0,
    /// At equal distances: all cells are halved in one direction at a time.
    Uniform = 1,
}

/// Which equations determine a tensor surface on a grid.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_tensor_method {
    /// Least squares in the spline space.
    LeastSquares = 0,
    /// The equations of Dannenhoffer and Haimes, 2009: less accurate on fine grids, for comparison.
    Ferguson = 1,
}

/// What happens at the ends of the knots.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_ends {
    /// Zero curvature across the ends.
    Natural = 0,
    /// Two more unknowns a direction.
    Free = 1,
}

/// Which second derivatives cost energy.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_energy {
    /// Elastic beams along the knot lines.
    Beam = 0,
    /// An elastic plate over the cells.
    Plate = 1,
}

/// What to do with parameters that came with a mesh.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_regularize {
    /// Even them out if they are uneven and it helps.
    Auto = 0,
    /// Take them as they are.
    Never = 1,
    /// Even them out.
    Always = 2,
}

/// What a tolerance is measured in.
pub(super) fn tolerance_scale(given: u32, name: &'static str) -> Result<ToleranceScale, ArgumentError> {
    choice(given, &[ToleranceScale::Relative, ToleranceScale::Absolute], name)
}

/// A tolerance and its `tolerance_scale`.
pub(super) fn tolerance(value: f64, scale: u32) -> Result<Tolerance, ArgumentError> {
    Ok(Tolerance { value, scale: tolerance_scale(scale, "tolerance_scale")? })
}

/// What happens at the ends of the knots.
pub(super) fn ends(given: u32) -> Result<Ends, ArgumentError> {
    choice(given, &[Ends::Natural, Ends::Free], "ends")
}

/// Which second derivatives cost energy.
pub(super) fn energy(given: u32) -> Result<Energy, ArgumentError> {
    choice(given, &[Energy::Beam, Energy::Plate], "energy")
}

/// What to do with parameters that came with a mesh.
pub(super) fn regularize(given: u32) -> Result<Regularize, ArgumentError> {
    choice(given, &[Regularize::Auto, Regularize::Never, Regularize::Always], "regularize")
}

/// What a value means that is NaN.
pub(super) fn missing(given: u32) -> Result<Missing, ArgumentError> {
    choice(given, &[Missing::Refused, Missing::Skipped], "missing")
}
