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

mod foot_points;
mod measure;
mod refine;
mod single_grid;

pub use super::common::uniform::{Ends, Energy, Method, SMOOTHING_LADDER};

use super::common::checks::{check_parameters, check_values};
use super::common::report::{FitReport, Tolerance};
use super::common::uniform::LARGEST_GRID;
use super::common::uniform::energy::FreeFunctions;
use super::common::{FitError, Frame, Regularize, node_parameters};
use crate::control::Control;
use crate::geometry::Bounds;
use crate::mesh::Mesh;
use crate::parameterize::ParameterizeOptions;
use crate::surface::tensor::TensorSurface;
use crate::surface::{Domain, Region, Trims};
use glam::DVec2;
use std::time::Instant;

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

pub(in crate::fit) fn check_options(options: &TensorOptions) -> Result<(), FitError> {
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

fn check(uv: &[DVec2], values: &[f64], dim: usize, options: &TensorOptions) -> Result<(), FitError> {
    check_options(options)?;
    check_values(uv.len(), values, dim, options.weights)?;
    check_parameters(uv)
}

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
