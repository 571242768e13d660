//! Models of meshes within a tolerance: one PHT-spline a patch of a layout, fitted together.
//!
//! J. Deng et al., "Polynomial splines over hierarchical T-meshes", Graph. Models 70 (2008), section 5.2, carried on to any
//! layout: the unknowns are those of a [smooth space](crate::surface::g1), so the patches share position and tangent
//! plane to rounding whatever the data say.
//!
//! ```text
//! samples: nodes, centroids, middles of edges, grids on long facets
//! repeat   least squares over all patches, with guards where samples are few
//!          one step towards the foot points, over edges where they lie there
//!          split the cells in which a sample misses the tolerance, and conform the cells along edges
//! ```

mod bodies;
mod chart;
mod constraints;
#[cfg(test)]
mod crease_tests;
mod creased;
mod error;
mod exact;
pub mod field;
mod folds;
mod foot;
pub mod from_patches;
mod least_squares;
mod locks;
mod mesh_model;
mod near;
mod options;
mod refine;
mod report;
mod samples;
mod smooth;
mod split;
#[cfg(test)]
mod tests;
mod walls;
mod ways;
mod whole;

pub use constraints::{Constraints, PlaneEquation};
pub use error::ModelFitError;
pub use exact::{ExactFit, Limits, Obstacle, Recognized, fit_exact, recognize};
pub use mesh_model::{ComponentReport, Family, MeshModelOptions, ModelFit, Piece};
pub use options::ModelOptions;
pub use report::{ModelReport, PatchReport};
pub use samples::NodePlaces;
pub use whole::fit_mesh;

use super::common::interior::triangle_sagittas;
use super::common::rounds::run;
use crate::control::Control;
use crate::layout::{Layout, Place};
use crate::memory::{self, CollectVec};
use crate::mesh::Mesh;
use crate::surface::g1::uniform;
use crate::surface::pht::PhtSurface;
use glam::DVec2;
use near::NearMesh;
use refine::Refinement;
use samples::{Samples, facet_normals};
use std::time::Instant;

/// Patches that meet smoothly, with all that is known of them.
#[derive(Debug, Clone)]
pub struct LayoutFit {
    /// A surface for each quad of the layout.
    pub surfaces: Vec<PhtSurface>,
    /// What the fit did and how good it is.
    pub report: ModelReport,
    /// Where each node of the mesh lies; None for a node without triangles.
    pub places: Vec<Option<Place>>,
    /// The error of each node, at its place; NaN without one.
    pub errors: Vec<f64>,
}

/// Level of the cells to start from over six large patches.
const CUBE_LEVEL: u32 = 3;
/// Level of the cells to start from over any other layout: vertices of four quads ask for two segments an edge, and
/// one level more leaves room for the parameters to slide.
const LAYOUT_LEVEL: u32 = 2;

/// Fits the shape of a mesh over a layout on which its nodes have places.
pub fn fit_over_layout(
    mesh: &Mesh,
    layout: &Layout,
    places: NodePlaces,
    options: &ModelOptions,
    control: &mut Control,
) -> Result<LayoutFit, ModelFitError> {
    fit_with_creases(mesh, layout, places, &Constraints::default(), options, control)
}

/// The same over a layout with creases, of a mesh that is cut along them: each node of a crease once for each side, at
/// a place on that side.
pub fn fit_with_creases(
    mesh: &Mesh,
    layout: &Layout,
    places: NodePlaces,
    constraints: &Constraints,
    options: &ModelOptions,
    control: &mut Control,
) -> Result<LayoutFit, ModelFitError> {
    let start = Instant::now();
    options.check(layout.quads().len())?;
    check_places(mesh, layout, places)?;
    let start_level = match (options.start_level, places) {
        (0, NodePlaces::Sphere(_)) => CUBE_LEVEL,
        (0, NodePlaces::Patches(_) | NodePlaces::Map(_)) => LAYOUT_LEVEL,
        (level, _) => level,
    };
    let (tolerance, is_raised) = options.tolerance.absolute(&mesh.bounds());
    let facets = triangle_sagittas(mesh, control.pool().watch());
    let sagittas: Vec<f64> = (0..mesh.triangles().len()).map(|triangle| facets.of(triangle)).collect_vec();
    let is_corner = locks::corners(layout, &constraints.corners);
    let samples = Samples::new(mesh, places, layout, &sagittas, &is_corner);
    super::common::checks::check_count(samples.nodes.len())?;
    let of_nodes = samples.nodes.iter().copied().zip(samples.places.iter().copied());
    let near = NearMesh::new(mesh, layout, of_nodes);
    let has_creases = (0..layout.edges().len() as u32).any(|edge| !layout.is_smooth(edge));
    let strictness = match has_creases {
        // a mesh that is cut along creases has walls at all of them
        true => memory::filled(1.0, samples.points.len()),
        false => walls::strictness(mesh, &samples, tolerance, control.pool()),
    };
    control.pool().check()?;
    let emphasis = memory::filled(1.0, samples.nodes.len());
    let mut refinement = Refinement {
        layout,
        options,
        samples,
        strictness,
        meshes: uniform(layout, start_level)?,
        constraints,
        has_creases,
        is_corner,
        near,
        facet_normals: facet_normals(mesh),
        stiff: Vec::new(),
        sagittas,
        tolerance,
        before: Vec::new(),
        rounds: 0,
        stuck: 0,
        least_samples: options.min_samples,
        least_error: f64::INFINITY,
        folded_rounds: 0,
        idle_limit: refine::MOST_IDLE,
        emphasis,
    };
    let outcome = run(&mut refinement, control)?;
    let mut report = report::measure(mesh, &refinement, &outcome, control)?;
    report.remarks.add_if(is_raised, super::report::Remarks::TOLERANCE_RAISED);
    report.fit_seconds = start.elapsed().as_secs_f64();
    let round = outcome.best;
    let mut places = vec![None; mesh.points().len()];
    let mut errors = vec![f64::NAN; mesh.points().len()];
    for ((&node, &place), &distance) in
        refinement.samples.nodes.iter().zip(&round.places).zip(&round.distances)
    {
        places[node as usize] = Some(place);
        errors[node as usize] = distance;
    }
    Ok(LayoutFit { surfaces: round.surfaces, report, places, errors })
}

fn check_places(mesh: &Mesh, layout: &Layout, places: NodePlaces) -> Result<(), ModelFitError> {
    let expected = mesh.points().len();
    if places.len() != expected {
        let what = "the places of nodes";
        return Err(super::common::FitError::Count { what, count: places.len(), expected }.into());
    }
    let is_inside = |uv: DVec2| uv.cmpge(DVec2::ZERO).all() && uv.cmple(DVec2::ONE).all();
    let is_wrong = |place: &Option<Place>| {
        place.is_some_and(|Place { quad, uv }| quad as usize >= layout.quads().len() || !is_inside(uv))
    };
    let wrong = match places {
        NodePlaces::Sphere(directions) => directions.iter().position(|at| !at.is_finite()),
        NodePlaces::Patches(places) => places.iter().position(is_wrong),
        NodePlaces::Map(map) => map.all_places().iter().position(is_wrong),
    };
    wrong.map_or(Ok(()), |node| Err(ModelFitError::Place { node }))
}
