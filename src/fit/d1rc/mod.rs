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

mod error;
mod least_squares;
mod options;
mod placement;
mod rounds;
#[cfg(test)]
mod tests;

pub use error::D1rcFitError;
pub use options::D1rcFitOptions;

use super::common::checks::check_values;
use super::common::report::FitReport;
use super::common::{Demands, Used};
use crate::control::Control;
use crate::memory::CollectVec;
use crate::mesh::Mesh;
use crate::surface::d1rc::D1rcSurface;
use glam::DVec2;
use rounds::{Problem, Source};
use std::time::Instant;

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
    options.check()?;
    let values: Vec<f64> = mesh.points().iter().flat_map(|p| p.to_array()).collect_vec();
    if let Some(used) = Used::of(mesh, &values, 3, options.weights, &Demands::default())? {
        let mut sharp_edges = options.sharp_edges.to_vec();
        if options.control_mesh.is_none() {
            sharp_edges.iter_mut().flatten().for_each(|node| *node = used.node(*node));
        }
        let parameterize = used.parameterize(options.parameterize);
        let options =
            D1rcFitOptions { weights: used.weights(), parameterize, sharp_edges: &sharp_edges, ..*options };
        let mut fit = fit_mesh(used.mesh(), &options, control).map_err(|error| match error {
            D1rcFitError::Fit(error) => used.told(error).into(),
            error => error,
        })?;
        used.spread(&mut fit.report, &mut fit.parameters, &mut fit.errors);
        return Ok(fit);
    }
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
