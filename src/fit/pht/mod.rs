//! PHT-splines within a tolerance, from meshes and scattered points: cells are split where the error is too large.
//!
//! J. Deng et al., "Polynomial splines over hierarchical T-meshes", Graph. Models 70 (2008), section 5.2, with
//! other estimators of the jets than the paper's (`pht.md` 4) and parameter correction
//! (`parameterization.md` 8).
//!
//! ```text
//! repeat   estimate the jets at the basis vertices
//!          move the nodes of a mesh towards their foot points, and estimate again
//!          measure each datum, and the inside of each triangle above its sagitta
//!          split the cells in which one misses the tolerance
//! ```

mod data;
mod global;
mod hermite_cell;
mod local;
pub(in crate::fit) mod refine;
#[cfg(test)]
mod tests;

use super::common::checks::{check_parameters, check_values};
use super::common::report::{FitReport, Remarks, Tolerance};
use super::common::{FitError, NodeParameters, Regularize, node_parameters};
use crate::control::Control;
use crate::mesh::Mesh;
use crate::parameterize::{Border, ParameterizeOptions};
use crate::surface::pht::PhtSurface;
use crate::tmesh::{MAX_GRID, MAX_LEVEL};
use data::Data;
use glam::DVec2;
use refine::Refinement;
use std::time::Instant;

/// What determines the jets at the basis vertices.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Estimator {
    /// Least squares over all data with a weak plate energy: fewest coefficients.
    #[default]
    Global,
    /// A quadratic fit around each datum, interpolated linearly (the paper): for comparison.
    LocalQuadratic,
    /// A weighted cubic fit around each basis vertex: no system to solve, for very large data.
    LocalCubic,
}

/// Options of PHT fits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PhtOptions<'a> {
    /// The largest error allowed at the data.
    pub tolerance: Tolerance,
    /// What determines the jets.
    pub estimator: Estimator,
    /// Weight of the plate energy of each cell, mapped to the unit cell; of [`Estimator::Global`]. Default 1e-3:
    /// ten times more flattens, a hundred times less lets the surface swing where a cell has few data. Where cells
    /// cannot be split any more it is lowered.
    pub smoothing: f64,
    /// Cells to start from, along u and v.
    pub initial_grid: [usize; 2],
    /// Deepest level of a cell.
    pub max_level: u32,
    /// Most cells.
    pub max_cells: usize,
    /// A cell with fewer samples is not split: nodes, and middles of triangles.
    pub min_samples: usize,
    /// Levels by which cells that share an edge may differ; 0 for any number.
    pub grade: u32,
    /// Sweeps of parameter correction in each round, for shapes of meshes.
    pub correction_sweeps: usize,
    /// What to do with parameters that came with the mesh.
    pub regularize: Regularize,
    /// How a mesh without parameters gets them; None for a circle, with one stretch step unless the tolerance is
    /// fine and the plain map even.
    pub parameterize: Option<ParameterizeOptions>,
    /// A positive weight for each datum.
    pub weights: Option<&'a [f64]>,
    /// Whether to measure the closest-point distance of the nodes.
    pub measure_distance: bool,
}

impl Default for PhtOptions<'_> {
    fn default() -> Self {
        Self {
            tolerance: Tolerance::default(),
            estimator: Estimator::default(),
            smoothing: 1e-3,
            initial_grid: [1, 1],
            max_level: 12,
            max_cells: 200_000,
            min_samples: 2,
            grade: 1,
            correction_sweeps: 1,
            regularize: Regularize::default(),
            parameterize: None,
            weights: None,
            measure_distance: false,
        }
    }
}

/// A fitted surface with all that is known of it.
#[derive(Debug, Clone)]
pub struct PhtFit {
    /// The surface; its trims are the boundary loops of the mesh.
    pub surface: PhtSurface,
    /// What the fit did and how good it is.
    pub report: FitReport,
    /// The (u,v) of each datum at which its error is measured.
    pub parameters: Vec<DVec2>,
    /// The error of each datum.
    pub errors: Vec<f64>,
}

/// Fits the shape of a mesh. Without parameters the mesh is parameterized first.
pub fn fit_mesh(mesh: &Mesh, options: &PhtOptions, control: &mut Control) -> Result<PhtFit, FitError> {
    let values: Vec<f64> = mesh.points().iter().flat_map(|p| p.to_array()).collect();
    fit_on_mesh(mesh, &values, 3, true, options, control)
}

/// Fits values on the nodes of a mesh, `dim` numbers a node, over the same parameters as its shape.
pub fn fit_field(
    mesh: &Mesh,
    values: &[f64],
    dim: usize,
    options: &PhtOptions,
    control: &mut Control,
) -> Result<PhtFit, FitError> {
    fit_on_mesh(mesh, values, dim, false, options, control)
}

/// Fits rows of `dim` numbers at scattered parameters.
pub fn fit_points(
    uv: &[DVec2],
    values: &[f64],
    dim: usize,
    options: &PhtOptions,
    control: &mut Control,
) -> Result<PhtFit, FitError> {
    let start = Instant::now();
    check_options(options)?;
    check_values(uv.len(), values, dim, options.weights)?;
    check_parameters(uv)?;
    let data = Data::of_points(uv, values, dim, options.weights);
    let mut fit = Refinement::new(data, options)?.run(control)?;
    fit.report.seconds = start.elapsed().as_secs_f64();
    Ok(fit)
}

fn fit_on_mesh(
    mesh: &Mesh,
    values: &[f64],
    dim: usize,
    is_shape: bool,
    options: &PhtOptions,
    control: &mut Control,
) -> Result<PhtFit, FitError> {
    let start = Instant::now();
    check_options(options)?;
    check_values(mesh.points().len(), values, dim, options.weights)?;
    control.set_stage(0.0, 0.3);
    let map = map(mesh, options, control)?;
    let parameterize_seconds = start.elapsed().as_secs_f64();
    check_parameters(&map.uv)?;
    control.set_stage(0.3, 1.0);
    let data = Data::of_mesh(mesh, map.uv, values, dim, is_shape, options.weights);
    let mut fit = Refinement::new(data, options)?.run(control)?;
    fit.report.remarks.0 |= map.remarks.0;
    fit.report.measure_map(mesh, &fit.parameters);
    fit.report.parameterize_seconds = parameterize_seconds;
    fit.report.seconds = start.elapsed().as_secs_f64();
    Ok(fit)
}

/// Largest stretch at which the plain mean value map is even enough for fine tolerances. A quadtree absorbs changes
/// of scale by levels, of which a fine mesh has enough, but not what a stretch step costs in conformality: heads
/// that are better off without have up to 20, the others 120 and more.
const EVEN_STRETCH: f64 = 30.0;
/// Relative tolerances above this give so coarse a mesh that scale matters more.
const COARSE_TOLERANCE: f64 = 3e-3;

/// The parameters of the nodes.
fn map(mesh: &Mesh, options: &PhtOptions, control: &mut Control) -> Result<NodeParameters, FitError> {
    let stretched = ParameterizeOptions::PHT.with_border(Border::Circle);
    let asked = options.parameterize.unwrap_or(stretched);
    let relative = options.tolerance.absolute(&mesh.bounds()).0 / mesh.diagonal();
    let is_choice = options.parameterize.is_none() && mesh.parameters().is_none();
    if is_choice && relative <= COARSE_TOLERANCE {
        let plain = ParameterizeOptions::MEAN_VALUE.with_border(Border::Circle);
        let mut map = node_parameters(mesh, &plain, options.regularize, control)?;
        if crate::parameterize::stretch(mesh.points(), mesh.triangles(), &map.uv).max <= EVEN_STRETCH {
            // what one step would mend is no reason to cut the mesh
            map.remarks.remove(Remarks::SEGMENTATION_ADVISED);
            return Ok(map);
        }
    }
    node_parameters(mesh, &asked, options.regularize, control)
}

fn check_options(options: &PhtOptions) -> Result<(), FitError> {
    let check = |holds: bool, option, value, range| {
        if holds { Ok(()) } else { Err(FitError::Option { option, value, range }) }
    };
    let tolerance = options.tolerance.value;
    check(tolerance > 0.0 && tolerance.is_finite(), "tolerance", tolerance, "positive and finite")?;
    let smoothing = options.smoothing;
    check(smoothing >= 0.0 && smoothing.is_finite(), "smoothing", smoothing, "finite and not negative")?;
    for count in options.initial_grid {
        check((1..=MAX_GRID).contains(&count), "initial_grid", count as f64, "between 1 and 4095")?;
    }
    let level = options.max_level;
    check(level <= MAX_LEVEL, "max_level", f64::from(level), "at most 20")?;
    let least = options.initial_grid[0] * options.initial_grid[1];
    check(options.max_cells >= least, "max_cells", options.max_cells as f64, "at least the initial cells")?;
    check(options.min_samples >= 1, "min_samples", options.min_samples as f64, "at least 1")
}
