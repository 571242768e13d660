//! What a field fitter may be asked for.

use crate::fit::common::checks::{
    check_buffer, check_count, check_grid, check_smoothing, check_tolerance, check_weights,
};
use crate::fit::common::report::Tolerance;
use crate::fit::common::uniform::{Ends, Energy};
use crate::fit::common::{FitError, Missing};
use crate::options::with_fields;
use crate::parameterize::ParameterizeOptions;

/// On which grid fields are fitted. On the one that the adaptive fit of a field takes: [`crate::fit::found_grid`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FieldGrid {
    /// As fine as the nodes bear, about four of them a coefficient, but no finer than 129 x 129 knots.
    Auto,
    /// Knots along u and v.
    Fixed([usize; 2]),
}

/// Options of a field fitter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FieldOptions<'a> {
    /// What reports compare the errors with.
    pub tolerance: Tolerance,
    /// The grid.
    pub grid: FieldGrid,
    /// Weight mu of the energy, positive.
    pub smoothing: f64,
    /// How far the knots reach beyond the nodes, as a fraction of their range.
    pub buffer: f64,
    /// What happens at the ends of the knots.
    pub ends: Ends,
    /// Which second derivatives cost energy.
    pub energy: Energy,
    /// A positive weight for each node.
    pub weights: Option<&'a [f64]>,
    /// Which nodes have values; the values of the others are not looked at.
    pub is_known: Option<&'a [bool]>,
    /// What values mean that are NaN: with [`Missing::Skipped`] each fit leaves out nodes without a value, and factors
    /// their equations anew where they are not those of the fit before.
    pub missing: Missing,
    /// How a mesh without parameters gets them.
    pub parameterize: ParameterizeOptions,
}

impl Default for FieldOptions<'_> {
    fn default() -> Self {
        Self {
            tolerance: Tolerance::default(),
            grid: FieldGrid::Auto,
            smoothing: 1e-6,
            buffer: 0.10,
            ends: Ends::default(),
            energy: Energy::default(),
            weights: None,
            is_known: None,
            missing: Missing::default(),
            parameterize: ParameterizeOptions::TENSOR,
        }
    }
}

impl<'a> FieldOptions<'a> {
    with_fields! {
        with_tolerance tolerance: Tolerance,
        with_grid grid: FieldGrid,
        with_smoothing smoothing: f64,
        with_buffer buffer: f64,
        with_ends ends: Ends,
        with_energy energy: Energy,
        with_weights weights: Option<&'a [f64]>,
        with_is_known is_known: Option<&'a [bool]>,
        with_missing missing: Missing,
        with_parameterize parameterize: ParameterizeOptions,
    }

    /// Checks the options for fields on `count` nodes.
    pub(in crate::fit) fn check(&self, count: usize) -> Result<(), FitError> {
        check_tolerance(&self.tolerance)?;
        check_smoothing(self.smoothing, false)?;
        check_buffer(self.buffer)?;
        if let FieldGrid::Fixed(counts) = self.grid {
            check_grid(counts)?;
        }
        match self.is_known {
            Some(is_known) if is_known.len() != count => {
                Err(FitError::Count { what: "the mask", count: is_known.len(), expected: count })
            }
            _ => check_count(count).and_then(|()| check_weights(count, self.weights)),
        }
    }
}
