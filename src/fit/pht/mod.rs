//! PHT-splines within a tolerance, from meshes and scattered points: cells are split where the error is too large.
//!
//! J. Deng et al., "Polynomial splines over hierarchical T-meshes", Graph. Models 70 (2008), section 5.2, with
//! other estimators of the jets than the paper's and parameter correction (docs/theory.md, PHT-splines).
//!
//! ```text
//! repeat   estimate the jets at the basis vertices
//!          move the nodes of a mesh towards their foot points, and estimate again
//!          measure each datum, and the inside of each triangle above its sagitta
//!          split the cells in which one misses the tolerance
//! ```
//! [`Continuity::C2`] fits truncated hierarchical B-splines instead of jets, from several initial grids; cells that turn out
//! not to be needed are merged again ([`Coarsening`]).

mod coarsen;
mod data;
mod global;
mod growth;
mod leaf;
mod local;
mod mirror;
mod options;
mod refine;
mod sides;
mod smooth;
mod sums;
mod tame;
#[cfg(test)]
mod tests;

pub use options::{Coarsening, Continuity, Estimator, PhtOptions};

use super::common::checks::{check_parameters, check_unused, check_values};
use super::common::neighbours::triangles_between;
use super::common::outliers::{self, Cloud};
use super::common::partial::{self, is_on_triangles, is_partial};
use super::common::report::Remarks;
use super::common::{
    Demands, Fit, FitError, NodeParameters, Outliers, Partial, Symmetry, Used, node_parameters, prefer_plane,
    timed,
};
use crate::control::Control;
use crate::memory::CollectVec;
use crate::mesh::Mesh;
use crate::parameterize::{Border, ParameterizeOptions};
use crate::surface::Domain;
use crate::surface::pht::PhtSurface;
use data::Data;
use glam::DVec2;
use refine::Refinement;
use std::time::Instant;

/// A fitted PHT-spline with all that is known of it.
pub type PhtFit = Fit<PhtSurface>;

/// Fits the shape of a mesh. Without parameters the mesh is parameterized first.
pub fn fit_mesh(mesh: &Mesh, options: &PhtOptions, control: &mut Control) -> Result<PhtFit, FitError> {
    let values: Vec<f64> = mesh.points().iter().flat_map(|p| p.to_array()).collect_vec();
    timed(|| fit_on_mesh(mesh, &values, 3, true, options, control))
}

/// Fits values on the nodes of a mesh, `dim` numbers a node, over the same parameters as its shape; as many rows as the
/// mesh has triangles are taken at their centroids.
pub fn fit_field(
    mesh: &Mesh,
    values: &[f64],
    dim: usize,
    options: &PhtOptions,
    control: &mut Control,
) -> Result<PhtFit, FitError> {
    timed(|| {
        if dim > 0 && (is_partial(values, options.missing) || is_on_triangles(mesh, values.len() / dim)) {
            options.check()?;
            let map = |control: &mut Control| map(mesh, options, control);
            return partial::fit_on_mesh(
                mesh,
                values.len() / dim,
                control,
                map,
                |places, data_box, control| fit_partial(places, data_box, values, dim, options, control),
            );
        }
        fit_on_mesh(mesh, values, dim, false, options, control)
    })
}

/// Fits rows of `dim` numbers at scattered parameters.
pub fn fit_points(
    uv: &[DVec2],
    values: &[f64],
    dim: usize,
    options: &PhtOptions,
    control: &mut Control,
) -> Result<PhtFit, FitError> {
    timed(|| {
        options.check()?;
        check_unused(options.demands.symmetry == Symmetry::None, "symmetry", "the fit of points")?;
        if dim > 0 && is_partial(values, options.missing) {
            return partial::fit_at_points(uv, |places, data_box| {
                fit_partial(places, data_box, values, dim, options, control)
            });
        }
        check_values(uv.len(), values, dim, options.weights)?;
        options.demands.check(uv.len())?;
        check_parameters(uv)?;
        if options.demands.outliers != Outliers::None {
            let triangles =
                triangles_between(uv, &Domain::around(uv.iter().copied()), control.pool().watch());
            let cloud = Cloud { uv, values, dim, triangles: &triangles };
            let asked = (&options.demands, &options.tolerance);
            return outliers::fit_without(&cloud, asked, control, |values, demands, control| {
                fit_points(uv, values, dim, &PhtOptions { demands: *demands, ..*options }, control)
            });
        }
        let data = Data::of_points(uv, values, dim, options.weights);
        Refinement::new(data, options)?.run(control)
    })
}

/// Fits those values that there are, over the box of all.
fn fit_partial(
    places: &[Option<DVec2>],
    data_box: Domain,
    values: &[f64],
    dim: usize,
    options: &PhtOptions,
    control: &mut Control,
) -> Result<PhtFit, FitError> {
    const BY: &str = "the fit of data without values at some places";
    check_unused(options.demands == Demands::default(), "what single data demand", BY)?;
    check_unused(options.sides.are_free(), "sides", BY)?;
    let partial = Partial::of(places, data_box, values, dim, options.weights, options.missing)?;
    partial.fit(|partial| {
        let options = PhtOptions { weights: partial.weights(), ..*options };
        check_values(partial.uv.len(), &partial.values, dim, options.weights)?;
        check_parameters(&partial.uv)?;
        let mut data = Data::of_points(&partial.uv, &partial.values, dim, options.weights);
        data.data_box = partial.data_box;
        Refinement::new(data, &options)?.run(control)
    })
}

fn fit_on_mesh(
    mesh: &Mesh,
    values: &[f64],
    dim: usize,
    is_shape: bool,
    options: &PhtOptions,
    control: &mut Control,
) -> Result<PhtFit, FitError> {
    if let Some(used) = Used::of(mesh, values, dim, options.weights, &options.demands)? {
        let parameterize = options.parameterize.map(|options| used.parameterize(options));
        let options =
            PhtOptions { weights: used.weights(), demands: used.demands(), parameterize, ..*options };
        let fit = fit_on_mesh(used.mesh(), &used.values, dim, is_shape, &options, control);
        let mut fit = fit.map_err(|error| used.told(error))?;
        used.spread(&mut fit.report, &mut fit.parameters, &mut fit.errors);
        return Ok(fit);
    }
    let start = Instant::now();
    if options.demands.symmetry != Symmetry::None {
        check_unused(is_shape, "symmetry", "the fit of a field")?;
        return mirror::fit_symmetric(mesh, options, control);
    }
    options.check()?;
    check_values(mesh.points().len(), values, dim, options.weights)?;
    options.demands.check(mesh.points().len())?;
    control.set_stage(0.0, 0.3);
    let map = map(mesh, options, control)?;
    let parameterize_seconds = start.elapsed().as_secs_f64();
    check_parameters(&map.uv)?;
    if options.demands.outliers != Outliers::None {
        let (data, asked) = ((values, dim, is_shape), (&options.demands, &options.tolerance));
        return outliers::fit_mesh_without(
            (mesh, &map.uv),
            data,
            asked,
            control,
            |mesh, values, demands, control| {
                let options = PhtOptions { demands: *demands, ..*options };
                fit_on_mesh(mesh, values, dim, is_shape, &options, control)
            },
        );
    }
    let mut uv = map.uv;
    if is_shape && options.continuity == Continuity::C2 && options.correction_sweeps > 0 {
        control.set_stage(0.3, 0.5);
        uv = corrected(mesh, uv, values, options, control)?;
        control.set_stage(0.5, 1.0);
    } else {
        control.set_stage(0.3, 1.0);
    }
    let data = Data::of_mesh(mesh, uv, (values, dim), is_shape, options.weights, control.pool().watch());
    let mut fit = Refinement::new(data, options)?.run(control)?;
    control.pool().check()?;
    fit.report.remarks.0 |= map.remarks.0;
    fit.report.measure_map(mesh, &fit.parameters, control.pool().watch());
    fit.report.parameterize_seconds = parameterize_seconds;
    Ok(fit)
}

/// Parameters of the nodes as a fit with one continuous derivative leaves them. Its cells become small at once where the shape
/// asks; moved towards the coarse first surfaces that are C2, parameters end worse than they were.
fn corrected(
    mesh: &Mesh,
    uv: Vec<DVec2>,
    values: &[f64],
    options: &PhtOptions,
    control: &mut Control,
) -> Result<Vec<DVec2>, FitError> {
    let options = PhtOptions {
        continuity: Continuity::C1,
        coarsening: Coarsening::Off,
        measure_distance: false,
        ..*options
    };
    let data = Data::of_mesh(mesh, uv, (values, 3), true, options.weights, control.pool().watch());
    Ok(Refinement::new(data, &options)?.run(control)?.parameters)
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
            return prefer_plane(mesh, map, control);
        }
    }
    let map = node_parameters(mesh, &asked, options.regularize, control)?;
    if is_choice { prefer_plane(mesh, map, control) } else { Ok(map) }
}
