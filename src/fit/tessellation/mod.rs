//! Bicubic surfaces on uniform grids, from tessellations, scattered points and fields on nodes.
//!
//! J. Dannenhoffer and R. Haimes, "Generation of spline approximations to tessellations" (2009). The default
//! is true least squares in the space of natural C2 splines, with a bending energy where data are thin;
//! [`Method::Ferguson`] keeps the paper's own equations. Grids are doubled in one direction at a time until
//! every datum lies within the tolerance.
//!
//! ```text
//! minimize  sum_n |S(u_n,v_n) - P_n|^2 + (mu/12) energy(S)
//! ```

mod curve;
pub(in crate::fit) mod energy;
mod ferguson;
pub(in crate::fit) mod foot_points;
pub(in crate::fit) mod grid;
pub(in crate::fit) mod interior;
pub(in crate::fit) mod normal_equations;
pub(in crate::fit) mod refine;
pub(in crate::fit) mod samples;
pub(in crate::fit) mod single_grid;

pub use curve::{CurveFit, fit_curve};
pub use energy::Energy;
pub use grid::Ends;

use crate::control::{Cancelled, Control};
use crate::fit::report::{FitReport, Remarks, Tolerance};
use crate::geometry::Bounds;
use crate::mesh::Mesh;
use crate::parameterize::{
    ParameterizeError, ParameterizeOptions, ParameterizeReport, RegularizeOptions, parameterize, regularize,
};
use crate::surface::tensor::TensorSurface;
use crate::surface::{Domain, Region, Trims};
use energy::FreeFunctions;
use glam::DVec2;
use std::time::Instant;

/// Which equations determine the surface on a grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Method {
    /// Least squares in the spline space itself.
    #[default]
    LeastSquares,
    /// The paper's equations: slopes are held while values are differentiated. Less accurate by orders of
    /// magnitude on fine grids; for comparison.
    Ferguson,
}

/// What to do with parameters that came with a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Regularize {
    /// Even them out if they are uneven and it helps.
    #[default]
    Auto,
    /// Take them as they are.
    Never,
    /// Even them out.
    Always,
}

/// Options of tensor fits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TensorOptions<'a> {
    /// The largest error allowed at the data.
    pub tolerance: Tolerance,
    /// Which equations determine the surface.
    pub method: Method,
    /// What happens at the ends of the knots.
    pub ends: Ends,
    /// Which second derivatives cost energy.
    pub energy: Energy,
    /// Weight mu of the energy; 0 takes the largest of [`SMOOTHING_LADDER`] that meets the tolerance (for
    /// [`Method::Ferguson`]: 1e-3).
    pub smoothing: f64,
    /// How far the knots reach beyond the data, as a fraction of the data's range.
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
    /// Whether to measure the closest-point distance of the nodes.
    pub measure_distance: bool,
}

/// Smoothing weights tried on each grid, from the calmest to the closest. `ferguson.md` 7: the first limits the
/// accuracy of fine grids, the last fills holes badly when data are noisy.
pub const SMOOTHING_LADDER: [f64; 4] = [1e-3, 1e-4, 1e-5, 1e-6];

impl Default for TensorOptions<'_> {
    fn default() -> Self {
        Self {
            tolerance: Tolerance::default(),
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
            measure_distance: false,
        }
    }
}

/// Least number of data that determine anything worth calling a surface.
const LEAST_COUNT: usize = 3;

/// A fit is not possible.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FitError {
    /// An option is out of its range.
    #[error("{option} is {value}, it must be {range}")]
    Option {
        /// Name of the option.
        option: &'static str,
        /// Its value.
        value: f64,
        /// What it may be.
        range: &'static str,
    },
    /// Too few data.
    #[error("{count} data are too few, at least {LEAST_COUNT} are needed")]
    TooFew {
        /// Data given.
        count: usize,
    },
    /// Arrays do not fit together.
    #[error("{count} numbers are given for {what}, {expected} are needed")]
    Count {
        /// The array.
        what: &'static str,
        /// Numbers given.
        count: usize,
        /// Numbers needed.
        expected: usize,
    },
    /// A parameter is NaN or infinite.
    #[error("the parameters of datum {index} are not finite")]
    ParametersNotFinite {
        /// The datum.
        index: usize,
    },
    /// A value is NaN or infinite.
    #[error("the values of datum {index} are not finite")]
    ValuesNotFinite {
        /// The datum.
        index: usize,
    },
    /// A surface that is to be updated is not one of this fitter's.
    #[error("the surface has other knots or another dimension than the fields of this fitter")]
    OtherGrid,
    /// A weight is not a positive number.
    #[error("weight {index} is {weight}, it must be positive and finite")]
    Weight {
        /// The datum.
        index: usize,
        /// Its weight.
        weight: f64,
    },
    /// All data have the same u or the same v.
    #[error("all data have {axis} = {at}: the parameter range is degenerate")]
    DegenerateRange {
        /// The parameter.
        axis: char,
        /// The one value it has.
        at: f64,
    },
    /// The data leave the surface undetermined.
    #[error("the data do not determine a surface: all lie on one line in (u,v)")]
    Singular,
    /// The mesh cannot be parameterized.
    #[error(transparent)]
    Parameterize(#[from] ParameterizeError),
    /// The progress callback asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl FitError {
    /// The class of the error.
    pub fn kind(&self) -> crate::ErrorKind {
        use crate::ErrorKind;
        match self {
            Self::Option { .. } | Self::TooFew { .. } | Self::Count { .. } | Self::OtherGrid => {
                ErrorKind::InvalidArgument
            }
            Self::Weight { weight, .. } if weight.is_finite() => ErrorKind::InvalidArgument,
            Self::ParametersNotFinite { .. } | Self::ValuesNotFinite { .. } | Self::Weight { .. } => {
                ErrorKind::NotFinite
            }
            Self::DegenerateRange { .. } => ErrorKind::Degenerate,
            Self::Singular => ErrorKind::Singular,
            Self::Parameterize(error) => error.kind(),
            Self::Cancelled(_) => ErrorKind::Cancelled,
        }
    }

    /// The offending datum.
    pub fn index(&self) -> Option<usize> {
        match *self {
            Self::ParametersNotFinite { index }
            | Self::ValuesNotFinite { index }
            | Self::Weight { index, .. } => Some(index),
            Self::Parameterize(ref error) => error.index(),
            _ => None,
        }
    }
}

/// A fitted surface with all that is known of it.
#[derive(Debug, Clone)]
pub struct TensorFit {
    /// The surface; its trims are the boundary loops of the mesh.
    pub surface: TensorSurface,
    /// What the fit did and how good it is.
    pub report: FitReport,
    /// The (u,v) of each datum at which its error is measured.
    pub parameters: Vec<DVec2>,
    /// The error of each datum.
    pub errors: Vec<f64>,
}

/// Fits the shape of a mesh. Without parameters the mesh is parameterized first.
pub fn fit_mesh(mesh: &Mesh, options: &TensorOptions, control: &mut Control) -> Result<TensorFit, FitError> {
    let values: Vec<f64> = mesh.points().iter().flat_map(|p| p.to_array()).collect();
    fit_on_mesh(mesh, &values, 3, true, options, control)
}

/// Fits values on the nodes of a mesh, `dim` numbers a node, over the same parameters as its shape.
pub fn fit_field(
    mesh: &Mesh,
    values: &[f64],
    dim: usize,
    options: &TensorOptions,
    control: &mut Control,
) -> Result<TensorFit, FitError> {
    fit_on_mesh(mesh, values, dim, false, options, control)
}

/// Fits rows of `dim` numbers at scattered parameters.
pub fn fit_points(
    uv: &[DVec2],
    values: &[f64],
    dim: usize,
    options: &TensorOptions,
    control: &mut Control,
) -> Result<TensorFit, FitError> {
    let start = Instant::now();
    check(uv, values, dim, options)?;
    let mut problem = Problem::new(uv.to_vec(), values, dim, None, options)?;
    let mut fit = problem.fit(control)?;
    fit.report.seconds = start.elapsed().as_secs_f64();
    Ok(fit)
}

fn fit_on_mesh(
    mesh: &Mesh,
    values: &[f64],
    dim: usize,
    is_shape: bool,
    options: &TensorOptions,
    control: &mut Control,
) -> Result<TensorFit, FitError> {
    let start = Instant::now();
    check_options(options)?;
    check_values(mesh.points().len(), values, dim, options.weights)?;
    control.set_stage(0.0, 0.3);
    let map = node_parameters(mesh, &options.parameterize, options.regularize, control)?;
    let parameterize_seconds = start.elapsed().as_secs_f64();
    check(&map.uv, values, dim, options)?;
    let mut problem = Problem::new(map.uv, values, dim, Some(mesh), options)?;
    problem.is_shape = is_shape;
    control.set_stage(0.3, 1.0);
    let mut fit = problem.fit(control)?;
    fit.report.parameterize_seconds = parameterize_seconds;
    fit.report.remarks.0 |= map.remarks.0;
    fit.report.measure_map(mesh, &fit.parameters);
    fit.report.seconds = start.elapsed().as_secs_f64();
    Ok(fit)
}

/// The parameters of the nodes, and how they came about.
pub(in crate::fit) struct NodeParameters {
    pub uv: Vec<DVec2>,
    pub remarks: Remarks,
}

pub(in crate::fit) fn node_parameters(
    mesh: &Mesh,
    options: &ParameterizeOptions,
    when: Regularize,
    control: &mut Control,
) -> Result<NodeParameters, FitError> {
    let mut remarks = Remarks::default();
    let Some(given) = mesh.parameters() else {
        let map = parameterize(mesh, options, control)?;
        remarks.add_if(true, Remarks::PARAMETERIZED);
        remarks.add_if(has_high_stretch(&map.report), Remarks::SEGMENTATION_ADVISED);
        return Ok(NodeParameters { uv: map.uv, remarks });
    };
    let choice = match when {
        Regularize::Never => return Ok(NodeParameters { uv: given.to_vec(), remarks }),
        Regularize::Auto => crate::parameterize::RegularizeWhen::Auto,
        Regularize::Always => crate::parameterize::RegularizeWhen::Always,
    };
    // a mesh that is no disk keeps what was given: only regularizing needs its connectivity
    match regularize(mesh, &RegularizeOptions::default().with_when(choice), control) {
        Ok(map) => {
            remarks.add_if(map.report.replaced, Remarks::REGULARIZED);
            Ok(NodeParameters { uv: map.uv, remarks })
        }
        Err(ParameterizeError::Cancelled(cancelled)) => Err(cancelled.into()),
        Err(error) if when == Regularize::Always => Err(error.into()),
        Err(_) => Ok(NodeParameters { uv: given.to_vec(), remarks }),
    }
}

fn has_high_stretch(report: &ParameterizeReport) -> bool {
    report.remarks.contains(crate::parameterize::Remarks::HIGH_STRETCH)
}

fn check_options(options: &TensorOptions) -> Result<(), FitError> {
    let check = |holds: bool, option, value, range| {
        if holds { Ok(()) } else { Err(FitError::Option { option, value, range }) }
    };
    let positive = |x: f64| x > 0.0 && x.is_finite();
    check(positive(options.tolerance.value), "tolerance", options.tolerance.value, "positive and finite")?;
    let smoothing = options.smoothing;
    check(smoothing >= 0.0 && smoothing.is_finite(), "smoothing", smoothing, "finite and not negative")?;
    check((0.0..=10.0).contains(&options.buffer), "buffer", options.buffer, "between 0 and 10")?;
    check(options.max_grid >= 2, "max_grid", options.max_grid as f64, "at least 2")?;
    check(options.max_coefficients >= 4, "max_coefficients", options.max_coefficients as f64, "at least 4")?;
    for count in options.fixed_grid.into_iter().flatten() {
        check((2..=LARGEST_GRID).contains(&count), "grid", count as f64, "between 2 and 8193")?;
    }
    Ok(())
}

/// Most knots along one direction that may be asked for.
pub(in crate::fit) const LARGEST_GRID: usize = 8193;

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

fn check(uv: &[DVec2], values: &[f64], dim: usize, options: &TensorOptions) -> Result<(), FitError> {
    check_options(options)?;
    check_values(uv.len(), values, dim, options.weights)?;
    check_parameters(uv)
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
const LEAST_RANGE: f64 = 64.0 * f64::EPSILON;

/// Everything that stays the same while grids are tried.
struct Problem<'a> {
    options: &'a TensorOptions<'a>,
    mesh: Option<&'a Mesh>,
    /// Whether the values are the nodes' places in space.
    is_shape: bool,
    /// Rows of `dim` numbers, as given.
    values: &'a [f64],
    dim: usize,
    /// Parameters of the data; correction sweeps move them.
    uv: Vec<DVec2>,
    /// The box of `uv` as it was at first.
    data_box: Domain,
    /// The energy asked for, or the plate where that leaves the surface undetermined.
    energy: Energy,
    frame: Frame,
    bounds: Bounds,
    /// The tolerance in model units, and whether it was raised.
    tolerance: (f64, bool),
}

/// Moves values into a box of size one around the origin, where sums of squares keep their digits.
pub(in crate::fit) struct Frame {
    center: Vec<f64>,
    pub scale: f64,
}

impl Frame {
    pub fn new(bounds: &Bounds) -> Self {
        let center = bounds.min.iter().zip(&bounds.max).map(|(a, b)| a + (b - a) / 2.0).collect();
        let diagonal = bounds.diagonal();
        Self { center, scale: if diagonal > 0.0 { diagonal } else { 1.0 } }
    }

    pub fn inward(&self, values: &[f64]) -> Vec<f64> {
        let center = self.center.iter().cycle();
        values.iter().zip(center).map(|(x, c)| (x - c) / self.scale).collect()
    }

    pub fn outward(&self, values: &mut [f64]) {
        let center = self.center.iter().cycle();
        values.iter_mut().zip(center).for_each(|(x, c)| *x = *x * self.scale + c);
    }
}

impl<'a> Problem<'a> {
    fn new(
        uv: Vec<DVec2>,
        values: &'a [f64],
        dim: usize,
        mesh: Option<&'a Mesh>,
        options: &'a TensorOptions<'a>,
    ) -> Result<Self, FitError> {
        let bounds = Bounds::of_rows(values, dim);
        let data_box = Domain::around(uv.iter().copied());
        let energy = match FreeFunctions::of(&uv, &data_box) {
            FreeFunctions::None => options.energy,
            FreeFunctions::Bilinear => Energy::Plate,
            FreeFunctions::Linear => return Err(FitError::Singular),
        };
        Ok(Self {
            tolerance: options.tolerance.absolute(&bounds),
            energy,
            frame: Frame::new(&bounds),
            options,
            mesh,
            is_shape: false,
            values,
            dim,
            uv,
            data_box,
            bounds,
        })
    }

    fn region(&self) -> Region {
        Region { data_box: Some(self.data_box), trims: Trims::default() }
    }
}
