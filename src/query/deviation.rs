//! How far a surface and a mesh are apart: closest-point distances from the nodes to the surface and, on
//! request, from a tessellation of the surface back to the mesh, which notices holes that were filled and
//! sheets that the mesh does not have.

use crate::control::Pool;
use crate::failure::{Classify, ErrorKind};
use crate::memory::{self, CollectVec, ParallelCollectVec};
use crate::mesh::Mesh;
use crate::options::with_fields;
use crate::query::extent::bounding_box;
use crate::query::project::{ProjectError, ProjectOptions, Projector};
use crate::query::tessellate::{TessellateError, TessellateOptions, tessellate_watched};
use crate::query::triangles::TriangleTree;
use crate::summary::{DataErrors, summarize};
use crate::surface::Surface;
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// What to measure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DeviationOptions {
    /// Whether only the part of the surface inside its trims counts. Default: yes.
    pub keep_trims: bool,
    /// Whether the mesh's parameters, if it has any, are where searches start. They make a search faster, the
    /// answer is the global minimum all the same. Default: yes.
    pub use_parameters: bool,
    /// Whether to measure from the surface to the mesh as well. Default: no.
    pub measure_back: bool,
    /// Chord tolerance of the tessellation that is measured back from; 0 takes 1e-3 of the diagonal.
    pub chord_tolerance: f64,
    /// Longest edge of that tessellation; 0 takes 1e-2 of the mesh's diagonal, and at least 2e-3 of the surface's.
    /// Smaller holes may be missed.
    pub max_edge_length: f64,
}

impl Default for DeviationOptions {
    fn default() -> Self {
        Self {
            keep_trims: true,
            use_parameters: true,
            measure_back: false,
            chord_tolerance: 0.0,
            max_edge_length: 0.0,
        }
    }
}

impl DeviationOptions {
    with_fields! {
        with_keep_trims keep_trims: bool,
        with_use_parameters use_parameters: bool,
        with_measure_back measure_back: bool,
        with_chord_tolerance chord_tolerance: f64,
        with_max_edge_length max_edge_length: f64,
    }
}

/// A surface cannot be measured against a mesh.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum DeviationError {
    /// Only surfaces in space lie beside a mesh.
    #[error("a surface of dimension {dim} has no distance to a mesh, dimension 3 is needed")]
    Dimension {
        /// Dimension of the surface.
        dim: usize,
    },
    /// The nodes cannot be projected.
    #[error(transparent)]
    Project(#[from] ProjectError),
    /// The surface cannot be tessellated.
    #[error(transparent)]
    Tessellate(#[from] TessellateError),
}

impl Classify for DeviationError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::Dimension { .. } => ErrorKind::InvalidArgument,
            Self::Project(error) => error.kind(),
            Self::Tessellate(error) => error.kind(),
        }
    }

    /// The offending node.
    fn index(&self) -> Option<usize> {
        match self {
            Self::Project(error) => error.index(),
            _ => None,
        }
    }
}

/// Distances between a surface and a mesh, in model units.
#[derive(Debug, Clone, Default)]
pub struct DeviationReport {
    /// From the nodes to the surface: each (NaN for a node without triangles), the largest, root mean square, mean, and
    /// the farthest node.
    pub nodes: DataErrors,
    /// The (u,v) nearest to each node; NaN for a node without triangles.
    pub uv: Vec<DVec2>,
    /// Nodes whose distance is not proved to be the least one.
    pub unproven: usize,
    /// Largest distance from a place on the surface to the mesh; NaN unless asked for.
    pub max_back_distance: f64,
    /// Where it was found; NaN unless asked for.
    pub worst_back_uv: DVec2,
    /// Places on the surface that were measured.
    pub back_count: usize,
}

/// Refuses a surface of another dimension than 3.
pub fn check_in_space(surface: &dyn Surface) -> Result<(), DeviationError> {
    match surface.dim() {
        3 => Ok(()),
        dim => Err(DeviationError::Dimension { dim }),
    }
}

/// Measures a surface against a mesh.
pub fn deviation(
    surface: &dyn Surface,
    mesh: &Mesh,
    options: &DeviationOptions,
    pool: &Pool,
) -> Result<DeviationReport, DeviationError> {
    check_in_space(surface)?;
    deviation_with(&Projector::new(surface)?, surface, mesh, options, pool)
}

/// The same with a projector that was made for the surface before.
pub fn deviation_with(
    projector: &Projector,
    surface: &dyn Surface,
    mesh: &Mesh,
    options: &DeviationOptions,
    pool: &Pool,
) -> Result<DeviationReport, DeviationError> {
    check_in_space(surface)?;
    // nodes that no triangle needs are none of the shape's
    let nodes: Vec<usize> = (0..mesh.points().len()).filter(|&node| mesh.is_used(node as u32)).collect_vec();
    let points: Vec<f64> = nodes.iter().flat_map(|&node| mesh.points()[node].to_array()).collect_vec();
    let guesses: Option<Vec<DVec2>> = mesh
        .parameters()
        .filter(|_| options.use_parameters)
        .map(|uv| nodes.iter().map(|&node| uv[node]).collect_vec());
    let project = ProjectOptions {
        guesses: guesses.as_deref(),
        keep_trims: options.keep_trims,
        ..ProjectOptions::default()
    };
    let projection = projector.project(&points, &project, pool)?;
    let unproven = projection.unproven();
    let (max_back_distance, worst_back_uv, back_count) = match options.measure_back {
        true => measure_back(surface, mesh, options, pool)?,
        false => (f64::NAN, DVec2::NAN, 0),
    };
    let mut errors = summarize(projection.distances);
    let mut uv = memory::filled(DVec2::NAN, mesh.points().len());
    let mut each = memory::filled(f64::NAN, mesh.points().len());
    for (&node, (&place, &distance)) in nodes.iter().zip(projection.uv.iter().zip(&errors.each)) {
        (uv[node], each[node]) = (place, distance);
    }
    (errors.worst_index, errors.each) = (nodes[errors.worst_index], each);
    Ok(DeviationReport { nodes: errors, uv, unproven, max_back_distance, worst_back_uv, back_count })
}

/// The largest distance from nodes and middles of a tessellation to the mesh, its place, and their number.
fn measure_back(
    surface: &dyn Surface,
    mesh: &Mesh,
    options: &DeviationOptions,
    pool: &Pool,
) -> Result<(f64, DVec2, usize), DeviationError> {
    /// Against the mesh's diagonal.
    const EDGE_LENGTH: f64 = 1e-2;
    /// Against the surface's: a mesh may be a small part of it, and then a quarter of a million places are enough.
    const LEAST_EDGE_LENGTH: f64 = 2e-3;
    let least = LEAST_EDGE_LENGTH * bounding_box(surface).diagonal();
    let automatic = (EDGE_LENGTH * mesh.diagonal()).max(least);
    let max_edge_length = if options.max_edge_length > 0.0 { options.max_edge_length } else { automatic };
    let tessellation = TessellateOptions {
        chord_tolerance: options.chord_tolerance,
        max_edge_length,
        keep_trims: options.keep_trims,
        ..TessellateOptions::default()
    };
    let samples = tessellate_watched(surface, &tessellation, pool.watch())?.mesh;
    let parameters = samples.parameters().unwrap_or(&[]);
    let middles =
        samples.triangles().iter().map(|t| t.map(|n| parameters[n as usize]).iter().sum::<DVec2>() / 3.0);
    let uv: Vec<DVec2> = parameters.iter().copied().chain(middles).collect_vec();
    let mut rows = memory::filled(0.0, 3 * uv.len());
    surface.eval_rows(&uv, 0, &mut rows);
    pool.check().map_err(ProjectError::from)?;
    let tree = TriangleTree::watched(mesh, pool.watch());
    let distance = |row: &[f64]| match pool.check() {
        Ok(()) => tree.nearest(DVec3::from_slice(row)).map_or(f64::NAN, |near| near.distance),
        Err(_) => f64::NAN,
    };
    let errors = summarize(pool.run(|| rows.par_chunks_exact(3).map(distance).collect_vec()));
    pool.check().map_err(ProjectError::from)?;
    Ok((errors.max, uv[errors.worst_index], uv.len()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::knots::KnotVector;
    use crate::samples::grid;
    use crate::surface::Trims;
    use crate::surface::tensor::TensorSurface;

    /// The unit square in the plane z = 0.
    fn square() -> TensorSurface {
        let knots = || KnotVector::clamped(&[0.0, 1.0], 1).unwrap();
        let points = vec![0., 0., 0., 0., 1., 0., 1., 0., 0., 1., 1., 0.];
        TensorSurface::new(3, knots(), knots(), points, None).unwrap()
    }

    /// A mesh of the unit square at the height `z`, with a square hole.
    fn sheet(z: impl Fn(DVec2) -> f64) -> Mesh {
        let in_hole = |p: DVec2| (p - 0.5).abs().max_element() < 0.25;
        let (places, triangles) = grid([21, 21], 0.0, 1, |p| !in_hole(p));
        Mesh::new(places.iter().map(|&p| p.extend(z(p))).collect(), triangles).unwrap()
    }

    #[test]
    fn a_raised_sheet_is_as_far_as_it_is_high() {
        let mut mesh = sheet(|p| 0.01 + 0.1 * p.x);
        let report = deviation(&square(), &mesh, &DeviationOptions::default(), &Pool::new(1)).unwrap();
        assert!((report.nodes.max - 0.11).abs() <= 1e-15);
        assert_eq!(mesh.points()[report.nodes.worst_index].x, 1.0);
        assert!(report.max_back_distance.is_nan());
        // parameters that are all wrong change nothing
        mesh.set_parameters(vec![DVec2::splat(0.3); mesh.points().len()]).unwrap();
        let guessed = deviation(&square(), &mesh, &DeviationOptions::default(), &Pool::new(2)).unwrap();
        for (node, (a, b)) in report.nodes.each.iter().zip(&guessed.nodes.each).enumerate() {
            // nodes without triangles, here in the hole, are none of the shape's
            assert!(if mesh.is_used(node as u32) {
                (a - b).abs() <= 1e-12
            } else {
                a.is_nan() && b.is_nan()
            });
        }
    }

    #[test]
    fn a_mesh_far_smaller_than_the_surface_is_measured_back() {
        let mut points = sheet(|_| 0.0).points().to_vec();
        points.iter_mut().for_each(|p| *p *= 1e-3);
        let mesh = Mesh::new(points, sheet(|_| 0.0).triangles().to_vec()).unwrap();
        let options = DeviationOptions { measure_back: true, ..Default::default() };
        let report = deviation(&square(), &mesh, &options, &Pool::new(2)).unwrap();
        let farthest = (2.0_f64).sqrt() * (1.0 - 1e-3);
        assert!((report.max_back_distance - farthest).abs() <= 1e-12, "{}", report.max_back_distance);
    }

    #[test]
    fn a_filled_hole_is_seen_from_the_surface() {
        let mesh = sheet(|_| 0.0);
        let options = DeviationOptions { measure_back: true, max_edge_length: 0.02, ..Default::default() };
        let mut surface = square();
        let report = deviation(&surface, &mesh, &options, &Pool::new(2)).unwrap();
        assert!(report.nodes.max <= 1e-15);
        // the middle of the hole is a quarter away, and a sample lies within one edge of it
        assert!(report.max_back_distance > 0.25 - 0.02 && report.max_back_distance <= 0.25 + 1e-12);
        assert!((report.worst_back_uv - 0.5).length() < 0.02 * 2.0);
        let corners = |half: f64| {
            [(-half, -half), (half, -half), (half, half), (-half, half)]
                .map(|(x, y)| DVec2::splat(0.5) + DVec2::new(x, y))
                .to_vec()
        };
        let trims = Trims::new(vec![corners(0.5), corners(0.25)], &surface.domain()).unwrap();
        surface.region_mut().trims = trims;
        let report = deviation(&surface, &mesh, &options, &Pool::new(2)).unwrap();
        assert!(report.max_back_distance <= 1e-15, "{}", report.max_back_distance);
    }
}
