//! D1RC-splines within a tolerance, from meshes: control points by least squares, as many as it takes.
//!
//! The control mesh is given, or it is the mesh with fewer nodes, its boundary and sharp edges kept
//! ([`Mesh::decimate`]). Its points as control points would give a surface that cuts every bend; least squares puts
//! them where the surface meets the data.
//!
//! ```text
//! repeat   make a control mesh of more vertices (unless it is given)
//!          place the nodes in its parameter plane
//!          fit the control points, move the nodes towards their foot points, fit again
//!          measure each node
//! ```

mod least_squares;
mod placement;
mod rounds;
#[cfg(test)]
mod tests;

use super::common::checks::check_values;
use super::common::report::{FitReport, Tolerance};
use super::common::{FitError, Regularize};
use crate::control::{Cancelled, Control};
use crate::error::ErrorKind;
use crate::mesh::{DecimateError, Mesh};
use crate::parameterize::{Border, ParameterizeError, ParameterizeOptions};
use crate::surface::d1rc::{D1rcError, D1rcOptions, D1rcSurface};
use glam::DVec2;
use rounds::{Problem, Source};
use std::f64::consts::PI;
use std::time::Instant;

/// Options of D1RC fits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct D1rcFitOptions<'a> {
    /// The largest error allowed at the nodes.
    pub tolerance: Tolerance,
    /// Degree, mode, boundary and the rule for sharp edges.
    pub surface: D1rcOptions,
    /// The control mesh, which is used without refinement; default: the mesh itself with fewer nodes. Without
    /// parameters it is parameterized first.
    pub control_mesh: Option<&'a Mesh>,
    /// Sharp edges, by nodes of the control mesh if that is given, else of the mesh.
    pub sharp_edges: &'a [[u32; 2]],
    /// Edges of the same mesh whose triangles turn by more than this, in radians, are sharp too. Default: none.
    pub sharp_angle: Option<f64>,
    /// Vertices of a control mesh that is made, without refinement; 0 (default) for as many as the tolerance takes.
    pub control_count: usize,
    /// Most vertices of a control mesh that is made.
    pub max_control_count: usize,
    /// Weight of the energy that determines control points without data. Default 1e-5: ten times more raises the error
    /// of a face mask by a third, a hundred times less does not lower it.
    pub smoothing: f64,
    /// Sweeps in each round: nodes move to their foot points, those with large errors gain weight, and the fit is
    /// repeated. Default 3.
    pub correction_sweeps: usize,
    /// What to do with parameters that came with the mesh.
    pub regularize: Regularize,
    /// How a mesh without parameters gets them.
    pub parameterize: ParameterizeOptions,
    /// A positive weight for each node.
    pub weights: Option<&'a [f64]>,
}

impl Default for D1rcFitOptions<'_> {
    fn default() -> Self {
        Self {
            tolerance: Tolerance::default(),
            surface: D1rcOptions::default(),
            control_mesh: None,
            sharp_edges: &[],
            sharp_angle: None,
            control_count: 0,
            max_control_count: 100_000,
            smoothing: 1e-5,
            correction_sweeps: 3,
            regularize: Regularize::default(),
            parameterize: ParameterizeOptions::PHT.with_border(Border::Circle),
            weights: None,
        }
    }
}

/// A D1RC fit is not possible.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum D1rcFitError {
    /// An option, the data or their parameters will not do.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// No control mesh can be made of the mesh.
    #[error(transparent)]
    Decimate(#[from] DecimateError),
    /// The control mesh makes no surface.
    #[error(transparent)]
    Surface(#[from] D1rcError),
    /// The control mesh cannot be parameterized.
    #[error("the control mesh has no parameters: {0}")]
    ControlMesh(ParameterizeError),
    /// The progress callback asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl D1rcFitError {
    /// The class of the error.
    pub fn kind(&self) -> ErrorKind {
        match self {
            Self::Fit(error) => error.kind(),
            Self::Decimate(error) => error.kind(),
            Self::Surface(error) => error.kind(),
            Self::ControlMesh(error) => error.kind(),
            Self::Cancelled(_) => ErrorKind::Cancelled,
        }
    }

    /// The offending node, triangle, sharp edge or weight.
    pub fn index(&self) -> Option<usize> {
        match self {
            Self::Fit(error) => error.index(),
            Self::Decimate(error) => error.index(),
            Self::Surface(error) => error.index(),
            Self::ControlMesh(error) => error.index(),
            Self::Cancelled(_) => None,
        }
    }
}

/// A fitted surface with all that is known of it.
#[derive(Debug, Clone)]
pub struct D1rcFit {
    /// The surface.
    pub surface: D1rcSurface,
    /// The control mesh that it began with: its vertices on the shape, where the control points are not.
    pub control_mesh: Mesh,
    /// The sharp edges of the control mesh.
    pub sharp_edges: Vec<[u32; 2]>,
    /// What the fit did and how good it is.
    pub report: FitReport,
    /// The (u,v) of each node at which its error is measured.
    pub parameters: Vec<DVec2>,
    /// The error of each node.
    pub errors: Vec<f64>,
}

/// Fits the shape of a mesh.
pub fn fit_mesh(
    mesh: &Mesh,
    options: &D1rcFitOptions,
    control: &mut Control,
) -> Result<D1rcFit, D1rcFitError> {
    let start = Instant::now();
    check_options(options)?;
    let values: Vec<f64> = mesh.points().iter().flat_map(|p| p.to_array()).collect();
    check_values(mesh.points().len(), &values, 3, options.weights)?;
    control.set_stage(0.0, 0.2);
    let source = Source::new(mesh, options, control)?;
    let parameterize_seconds = start.elapsed().as_secs_f64();
    control.set_stage(0.2, 1.0);
    let mut fit = Problem::new(mesh, &values, source, options).run(control)?;
    fit.report.parameterize_seconds = parameterize_seconds;
    fit.report.seconds = start.elapsed().as_secs_f64();
    Ok(fit)
}

fn check_options(options: &D1rcFitOptions) -> Result<(), FitError> {
    let check = |holds: bool, option, value, range| {
        if holds { Ok(()) } else { Err(FitError::Option { option, value, range }) }
    };
    let tolerance = options.tolerance.value;
    check(tolerance > 0.0 && tolerance.is_finite(), "tolerance", tolerance, "positive and finite")?;
    let smoothing = options.smoothing;
    check(smoothing > 0.0 && smoothing.is_finite(), "smoothing", smoothing, "positive and finite")?;
    let angle = options.sharp_angle.unwrap_or(PI);
    check(angle > 0.0 && angle <= PI, "sharp_angle", angle, "positive and at most pi")?;
    let count = options.control_count;
    check(count == 0 || count >= 3, "control_count", count as f64, "0 or at least 3")?;
    let most = options.max_control_count;
    check(most >= 3, "max_control_count", most as f64, "at least 3")
}
