//! How good a model of exact faces is, measured on it.

use super::draft::Scale;
use super::evidence::signed_distance;
use super::{ModelReport, Obstacle};
use crate::control::Watch;
use crate::fit::common::interior::triangle_sagittas;
use crate::fit::common::report::{Remarks, StopReason};
use crate::fit::model::report::mesh_volume;
use crate::memory::{self, CollectVec};
use crate::mesh::{Features, Mesh, Regions};
use crate::model::{FaceId, Model};
use crate::query::tessellate::TessellateOptions;
use crate::query::triangles::TriangleTree;
use crate::summary::summarize;
use glam::{DVec2, DVec3};

/// Where nodes are, how far off, and the report.
pub(super) struct Measured {
    pub places: Vec<Option<(FaceId, DVec2)>>,
    pub errors: Vec<f64>,
    pub report: ModelReport,
}

/// Nodes between two looks at the watch.
const BETWEEN_WATCHES: usize = 4096;

/// Measures a model whose faces are the regions of the mesh, in order; refuses one of another shape.
pub(super) fn measure(
    mesh: &Mesh,
    features: &Features,
    regions: &Regions,
    model: &Model,
    scale: &Scale,
    watch: &Watch,
) -> Result<Measured, Obstacle> {
    let faces = faces_of_nodes(mesh, features, regions);
    let place = |(node, face): (usize, &Option<u32>)| {
        let face = FaceId::new((*face)?);
        let uv = model.carrier(face).nearest(mesh.points()[node])?;
        Some((face, uv))
    };
    let places: Vec<Option<(FaceId, DVec2)>> = faces.iter().enumerate().map(place).collect_vec();
    let error = |(place, &point): (&Option<(FaceId, DVec2)>, &DVec3)| {
        place.map_or(f64::NAN, |(face, uv)| model.carrier(face).points(&[uv])[0].distance(point))
    };
    let mut errors: Vec<f64> = places.iter().zip(mesh.points()).map(error).collect_vec();
    // a node between faces is as far from each of them
    for &node in features.chains.iter().flat_map(|chain| &chain.nodes) {
        let beside = mesh.outgoing(node).map(|edge| FaceId::new(regions.of_triangle[edge.triangle()]));
        let off = beside.map(|face| signed_distance(model.carrier(face), mesh.points()[node as usize]).abs());
        errors[node as usize] = off.fold(errors[node as usize], f64::max);
    }
    watch.check()?;
    let between = between(mesh, regions, model, watch)?;
    let known = summarize(errors.iter().copied().filter(|error| !error.is_nan()).collect_vec());
    let used: Vec<usize> = (0..errors.len()).filter(|&node| !errors[node].is_nan()).collect_vec();
    let measured = model.measure();
    let mesh_volume = mesh_volume(mesh);
    let most = known.max + between.max;
    // faces are nowhere farther from facets than nodes and middles tell, but for a part of it
    let reach = 2.0 * most.max(1e-9 * scale.diagonal);
    let is_closed = mesh.loops().is_empty();
    let is_other_volume = is_closed && (measured.volume - mesh_volume).abs() > reach * measured.area;
    if is_other_volume || model.euler_characteristic() != mesh.euler_characteristic() {
        return Err(Obstacle::Shape);
    }
    let enclosed = |volume: f64| if is_closed { volume } else { f64::NAN };
    let max_back_distance = back_distance(mesh, model, watch)?;
    let mut remarks = Remarks::default();
    remarks.add_if(known.max > scale.tolerance, Remarks::TOLERANCE_NOT_MET);
    remarks.add_if(between.excess > scale.tolerance, Remarks::ROUGH_BETWEEN_NODES);
    let report = ModelReport {
        max_error: known.max,
        rms_error: known.rms,
        mean_error: known.mean,
        worst_node: used.get(known.worst_index).copied().unwrap_or(0),
        tolerance: scale.tolerance,
        diagonal: scale.diagonal,
        max_interior_error: between.max,
        facet_sagitta: between.max - between.excess,
        max_back_distance,
        normal_jump: measured.max_normal_jump,
        gap: measured.max_gap,
        volume: enclosed(measured.volume),
        mesh_volume: enclosed(mesh_volume),
        passes: 1,
        // what is missed is noise: more faces would not help
        stop: if known.max > scale.tolerance { StopReason::Stagnated } else { StopReason::ToleranceMet },
        remarks,
        ..ModelReport::default()
    };
    Ok(Measured { places, errors, report })
}

/// By node: the face it lies on; of several the first.
fn faces_of_nodes(mesh: &Mesh, features: &Features, regions: &Regions) -> Vec<Option<u32>> {
    let mut faces = memory::filled(None, mesh.points().len());
    for (triangle, &region) in mesh.triangles().iter().zip(&regions.of_triangle) {
        for &node in triangle {
            let face: &mut Option<u32> = &mut faces[node as usize];
            *face = Some(face.map_or(region, |known| known.min(region)));
        }
    }
    debug_assert!(features.edges.iter().flatten().all(|&node| faces[node as usize].is_some()));
    faces
}

/// Errors between the nodes: at centroids of facets and middles of their sides.
struct Between {
    max: f64,
    /// The most by which an error is more than its own facet explains.
    excess: f64,
}

fn between(mesh: &Mesh, regions: &Regions, model: &Model, watch: &Watch) -> Result<Between, Obstacle> {
    let sagittas = triangle_sagittas(mesh, watch);
    let mut all = Between { max: 0.0, excess: 0.0 };
    for (triangle, nodes) in mesh.triangles().iter().enumerate() {
        if triangle % BETWEEN_WATCHES == 0 {
            watch.check()?;
        }
        let [a, b, c] = nodes.map(|node| mesh.points()[node as usize]);
        let carrier = model.carrier(FaceId::new(regions.of_triangle[triangle]));
        let places = [(a + b + c) / 3.0, a.midpoint(b), b.midpoint(c), c.midpoint(a)];
        let off = places.map(|place| signed_distance(carrier, place).abs()).into_iter().fold(0.0, f64::max);
        all.max = all.max.max(off);
        all.excess = all.excess.max(off - sagittas.of(triangle));
    }
    Ok(all)
}

/// Largest distance from places all over the model to the mesh.
fn back_distance(mesh: &Mesh, model: &Model, watch: &Watch) -> Result<f64, Obstacle> {
    // loops that cross cannot be triangulated: no face
    let tessellation = model.tessellate(&TessellateOptions::default()).map_err(|_| Obstacle::Shape)?;
    let tree = TriangleTree::new(mesh);
    let mut largest: f64 = 0.0;
    for (k, &place) in tessellation.mesh.points().iter().enumerate() {
        if k % BETWEEN_WATCHES == 0 {
            watch.check()?;
        }
        largest = largest.max(tree.nearest(place).map_or(0.0, |near| near.distance));
    }
    Ok(largest)
}
