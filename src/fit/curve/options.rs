//! What a fit of a curve may be asked for.

use crate::fit::common::FitError;
use crate::fit::common::checks::{
    check_buffer, check_grid, check_option, check_smoothing, check_tolerance, check_unused,
};
use crate::fit::common::report::Tolerance;
use crate::fit::common::uniform::{Ends, Method};
use crate::options::with_fields;

/// Options of curve fits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurveOptions<'a> {
    /// The largest error allowed at the data.
    pub tolerance: Tolerance,
    /// Which equations determine the curve.
    pub method: Method,
    /// What happens at the ends of the knots.
    pub ends: Ends,
    /// Weight mu of the energy; 0 takes the largest of [`SMOOTHING_LADDER`](crate::fit::common::uniform::SMOOTHING_LADDER) that meets the tolerance (for
    /// [`Method::Ferguson`]: 1e-3).
    pub smoothing: f64,
    /// How far the knots reach beyond the data, as a fraction of the data's range.
    pub buffer: f64,
    /// Most knots.
    pub max_grid: usize,
    /// Knots to use without refinement.
    pub fixed_count: Option<usize>,
    /// A positive weight for each datum.
    pub weights: Option<&'a [f64]>,
}

impl Default for CurveOptions<'_> {
    fn default() -> Self {
        Self {
            tolerance: Tolerance::default(),
            method: Method::default(),
            ends: Ends::default(),
            smoothing: 0.0,
            buffer: 0.10,
            max_grid: 257,
            fixed_count: None,
            weights: None,
        }
    }
}

impl<'a> CurveOptions<'a> {
    with_fields! {
        with_tolerance tolerance: Tolerance,
        with_method method: Method,
        with_ends ends: Ends,
        with_smoothing smoothing: f64,
        with_buffer buffer: f64,
        with_max_grid max_grid: usize,
        with_fixed_count fixed_count: Option<usize>,
        with_weights weights: Option<&'a [f64]>,
    }

    pub(super) fn check(&self) -> Result<(), FitError> {
        check_tolerance(&self.tolerance)?;
        check_smoothing(self.smoothing, true)?;
        check_buffer(self.buffer)?;
        check_option(self.max_grid >= 2, "max_grid", self.max_grid as f64, "at least 2")?;
        if self.method == Method::Ferguson {
            const BY: &str = "the equations of Dannenhoffer and Haimes";
            check_unused(self.ends == Ends::default(), "ends", BY)?;
            check_unused(self.weights.is_none(), "weights", BY)?;
        }
        check_grid(self.fixed_count)
    }
}
