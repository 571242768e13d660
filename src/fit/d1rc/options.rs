//! What a D1RC fit may be asked for.

use crate::fit::common::checks::{check_option, check_smoothing, check_tolerance};
use crate::fit::common::report::Tolerance;
use crate::fit::common::{FitError, Regularize};
use crate::mesh::Mesh;
use crate::options::with_fields;
use crate::parameterize::{Border, ParameterizeOptions};
use crate::surface::d1rc::D1rcOptions;
use std::f64::consts::PI;

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

impl<'a> D1rcFitOptions<'a> {
    with_fields! {
        with_tolerance tolerance: Tolerance,
        with_surface surface: D1rcOptions,
        with_control_mesh control_mesh: Option<&'a Mesh>,
        with_sharp_edges sharp_edges: &'a [[u32; 2]],
        with_sharp_angle sharp_angle: Option<f64>,
        with_control_count control_count: usize,
        with_max_control_count max_control_count: usize,
        with_smoothing smoothing: f64,
        with_correction_sweeps correction_sweeps: usize,
        with_regularize regularize: Regularize,
        with_parameterize parameterize: ParameterizeOptions,
        with_weights weights: Option<&'a [f64]>,
    }

    pub(super) fn check(&self) -> Result<(), FitError> {
        check_tolerance(&self.tolerance)?;
        check_smoothing(self.smoothing, false)?;
        let angle = self.sharp_angle.unwrap_or(PI);
        check_option(angle > 0.0 && angle <= PI, "sharp_angle", angle, "positive and at most pi")?;
        let (count, most) = (self.control_count, self.max_control_count);
        check_option(count == 0 || count >= 3, "control_count", count as f64, "0 or at least 3")?;
        check_option(most >= 3, "max_control_count", most as f64, "at least 3")
    }
}
