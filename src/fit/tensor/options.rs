//! What a tensor fit may be asked for.

use super::{Ends, Energy, Method, Sides};
use crate::fit::common::checks::{
    check_buffer, check_grid, check_option, check_smoothing, check_tolerance, check_unused,
};
use crate::fit::common::report::Tolerance;
use crate::fit::common::{Demands, FitError, Missing, Outliers, Regularize, Symmetry};
use crate::options::with_fields;
use crate::parameterize::ParameterizeOptions;

/// Where knot lines stand.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Knots {
    /// Where the error asks for them: lines are inserted and taken out one by one.
    #[default]
    Adaptive,
    /// At equal distances, as in the paper: all cells are halved in one direction at a time.
    Uniform,
}

/// Options of tensor fits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TensorOptions<'a> {
    /// The largest error allowed at the data.
    pub tolerance: Tolerance,
    /// Where knot lines stand. [`Method::Ferguson`] and [`TensorOptions::fixed_grid`] are uniform always.
    pub knots: Knots,
    /// Which equations determine the surface.
    pub method: Method,
    /// What happens at the ends of uniform knots; adaptive ones are free there.
    pub ends: Ends,
    /// Which second derivatives cost energy over uniform knots; over adaptive ones it is a plate's.
    pub energy: Energy,
    /// Weight of the energy; 0 finds one: over uniform knots, mu is the largest of
    /// [`SMOOTHING_LADDER`](super::SMOOTHING_LADDER) that meets the tolerance (for [`Method::Ferguson`]: 1e-3); over adaptive ones
    /// it is that of a plate over the unit square against the mean square error, 1e-11 or less.
    pub smoothing: f64,
    /// How far the knots reach beyond the data, as a fraction of the data's range; adaptive ones reach less far where
    /// the surface would leave the box of its data.
    pub buffer: f64,
    /// Most knots along one direction.
    pub max_grid: usize,
    /// Most unknowns of one grid.
    pub max_coefficients: usize,
    /// Knots along u and v to use without refinement.
    pub fixed_grid: Option<[usize; 2]>,
    /// Sweeps of parameter correction on each grid: nodes move to their foot points, then the fit is
    /// repeated. The errors reported are then those at the corrected parameters.
    pub correction_sweeps: usize,
    /// What to do with parameters that came with the mesh.
    pub regularize: Regularize,
    /// How a mesh without parameters gets them.
    pub parameterize: ParameterizeOptions,
    /// A positive weight for each datum.
    pub weights: Option<&'a [f64]>,
    /// What single data demand.
    pub demands: Demands<'a>,
    /// Sides that are given: their lines are among those of the surface, whose ends are free and without a buffer.
    pub sides: Sides<'a>,
    /// Periods of surfaces that close, along u and v, for points: after so much of a parameter they go on as they began, with
    /// slope and curvature; at least the range of the data, 0 for open. Ends are free and without a buffer.
    pub periods: [f64; 2],
    /// Whether to measure the closest-point distance of the nodes.
    pub measure_distance: bool,
    /// What values of points and fields mean that are NaN.
    pub missing: Missing,
}

impl Default for TensorOptions<'_> {
    fn default() -> Self {
        Self {
            tolerance: Tolerance::default(),
            knots: Knots::default(),
            method: Method::default(),
            ends: Ends::default(),
            energy: Energy::default(),
            smoothing: 0.0,
            buffer: 0.10,
            max_grid: 257,
            max_coefficients: 257 * 257,
            fixed_grid: None,
            correction_sweeps: 0,
            regularize: Regularize::default(),
            parameterize: ParameterizeOptions::TENSOR,
            weights: None,
            demands: Demands::default(),
            sides: Sides { curves: [None; 4], neighbours: [None; 4] },
            periods: [0.0; 2],
            measure_distance: false,
            missing: Missing::default(),
        }
    }
}

impl<'a> TensorOptions<'a> {
    with_fields! {
        with_tolerance tolerance: Tolerance,
        with_knots knots: Knots,
        with_method method: Method,
        with_ends ends: Ends,
        with_energy energy: Energy,
        with_smoothing smoothing: f64,
        with_buffer buffer: f64,
        with_max_grid max_grid: usize,
        with_max_coefficients max_coefficients: usize,
        with_fixed_grid fixed_grid: Option<[usize; 2]>,
        with_correction_sweeps correction_sweeps: usize,
        with_regularize regularize: Regularize,
        with_parameterize parameterize: ParameterizeOptions,
        with_weights weights: Option<&'a [f64]>,
        with_demands demands: Demands<'a>,
        with_sides sides: Sides<'a>,
        with_periods periods: [f64; 2],
        with_measure_distance measure_distance: bool,
        with_missing missing: Missing,
    }

    pub(super) fn check(&self) -> Result<(), FitError> {
        let (most_knots, most) = (self.max_grid, self.max_coefficients);
        check_tolerance(&self.tolerance)?;
        check_smoothing(self.smoothing, true)?;
        check_buffer(self.buffer)?;
        check_option(most_knots >= 2, "max_grid", most_knots as f64, "at least 2")?;
        check_option(most >= 4, "max_coefficients", most as f64, "at least 4")?;
        if self.method == Method::Ferguson {
            const BY: &str = "the equations of Dannenhoffer and Haimes";
            check_unused(self.ends == Ends::default(), "ends", BY)?;
            check_unused(self.energy == Energy::default(), "energy", BY)?;
            check_unused(self.weights.is_none(), "weights", BY)?;
            check_unused(self.demands.fixed.is_empty(), "fixed", BY)?;
            check_unused(self.demands.outliers == Outliers::None, "outliers", BY)?;
            check_unused(self.demands.tolerances.is_none(), "tolerances", BY)?;
        }
        for (period, name) in self.periods.into_iter().zip(["period_u", "period_v"]) {
            check_option(period >= 0.0 && period.is_finite(), name, period, "finite and not negative")?;
        }
        if self.closes() {
            const BY: &str = "the fit of a surface that closes";
            check_unused(self.method == Method::default(), "method", BY)?;
            check_unused(self.sides.are_free(), "sides", BY)?;
        }
        if !self.sides.are_free() {
            const BY: &str = "a fit with given sides";
            check_unused(self.method == Method::default(), "method", BY)?;
            check_unused(self.demands.symmetry == Symmetry::None, "symmetry", BY)?;
        }
        check_grid(self.fixed_grid.into_iter().flatten())
    }
}
