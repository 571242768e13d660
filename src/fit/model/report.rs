//! What a fit of a model says of itself.

use super::error::ModelFitError;
use super::locks::Lock;
use super::refine::{Refinement, Round};
use crate::control::Control;
use crate::fit::common::report::{Remarks, StopReason};
use crate::fit::common::rounds::Outcome;
use crate::mesh::Mesh;
use crate::summary::{sum, summarize};
use crate::surface::g1::{enclosed_volume, normal_jump};
use crate::surface::pht::PhtSurface;
use crate::surface::{Patches, Surface};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// One patch.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PatchReport {
    /// Largest error of the nodes that lie on it.
    pub max_error: f64,
    /// The same for centroids of facets and middles of edges.
    pub max_interior_error: f64,
    /// Nodes on it.
    pub node_count: usize,
    /// Its cells.
    pub cell_count: usize,
    /// Its control points, four a basis vertex.
    pub coefficient_count: usize,
}

/// What a fit did and how good it is. Errors are in model units and measured on the finished surfaces.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ModelReport {
    /// Largest distance of a node from the surface at its place: what the tolerance bounds.
    pub max_error: f64,
    /// Square root of the mean of its square.
    pub rms_error: f64,
    /// Its mean.
    pub mean_error: f64,
    /// The node with the largest error.
    pub worst_node: usize,
    /// The tolerance in model units.
    pub tolerance: f64,
    /// Diagonal of the mesh's bounding box: an error divided by it is relative.
    pub diagonal: f64,
    /// Largest distance of a centroid of a facet or a middle of an edge from the surface.
    pub max_interior_error: f64,
    /// The part of that which flat facets on a curved shape explain: nowhere does a distance exceed what its own facet
    /// explains by more than the rest.
    pub facet_sagitta: f64,
    /// Largest distance from places all over the surface to the mesh.
    pub max_back_distance: f64,
    /// The largest of these beyond what the facet there explains; 0 for charts and exact faces.
    pub max_back_excess: f64,
    /// Largest difference of unit normals across edges of patches.
    pub normal_jump: f64,
    /// Largest distance between the sides of an edge.
    pub gap: f64,
    /// Largest distance of a node on a crease or border from its curve; 0 without any.
    pub crease_error: f64,
    /// Cells in which the normal points against that of the mesh.
    pub folded_cells: usize,
    /// Enclosed by the surface; NaN for a layout with a border.
    pub volume: f64,
    /// Enclosed by the mesh.
    pub mesh_volume: f64,
    /// Patches, in the order of the layout's quads.
    pub patches: Vec<PatchReport>,
    /// Control points of all patches, four a basis vertex and patch.
    pub coefficient_count: usize,
    /// Unknowns a component that remain when all patches meet smoothly.
    pub free_count: usize,
    /// Cells of all patches.
    pub cell_count: usize,
    /// The deepest level of a cell.
    pub deepest_level: u32,
    /// Samples that lie on facets spread over too many patches, and were left out.
    pub dropped_samples: usize,
    /// Rounds of fitting and measuring.
    pub passes: usize,
    /// Pairs of triangles of the mesh that cross.
    pub mesh_crossings: usize,
    /// Pairs of triangles of the finished model that cross; None if it could not be triangulated, or has not been yet.
    pub crossings: Option<usize>,
    /// Why the fit ended.
    pub stop: StopReason,
    /// Everything worth knowing.
    pub remarks: Remarks,
    /// Seconds for the fit.
    pub fit_seconds: f64,
}

/// A model may leave the facets by so many tolerances, beside what they explain: between the nodes it swings.
pub(super) const BACK_SLACK: f64 = 2.5;

/// Places along a side of a cell at which the distance to the mesh is measured.
const BACK_PLACES: usize = 5;

/// Measures the finished surfaces.
pub(super) fn measure(
    mesh: &Mesh,
    refinement: &Refinement,
    outcome: &Outcome<Round>,
    control: &mut Control,
) -> Result<ModelReport, ModelFitError> {
    let round = &outcome.best;
    let nodes = refinement.samples.nodes.len();
    let errors = summarize(round.distances[..nodes].to_vec());
    let jump = normal_jump(refinement.layout, &round.surfaces)?;
    let back = control.watch(|pool, watch| -> Result<Back, ModelFitError> {
        let mut largest = Back::default();
        for (quad, surface) in (0..).zip(&round.surfaces) {
            watch.check()?;
            largest = largest.max(pool.run(|| back_distance(refinement, quad, surface)));
        }
        Ok(largest)
    })??;
    let is_closed = refinement.layout.edges().iter().all(|edge| edge.second.is_some());
    let largest = |distances: &[f64]| distances.iter().copied().fold(0.0, f64::max);
    let on_creases: Vec<f64> = round.distances[..nodes]
        .iter()
        .zip(&round.locks)
        .filter(|(_, lock)| **lock != Lock::Free)
        .map(|(distance, _)| *distance)
        .collect();
    let patches = patches(refinement, round);
    let tmeshes = round.surfaces.iter().map(|surface| surface.mesh());
    let level =
        |mesh: &crate::tmesh::TMesh| mesh.leaves().map(|leaf| mesh.cell(leaf).level).max().unwrap_or(0);
    let tolerance = refinement.tolerance;
    let mut remarks = Remarks::default();
    remarks.add_if(errors.max > tolerance, Remarks::TOLERANCE_NOT_MET);
    remarks.add_if(outcome.stop == StopReason::Stagnated, Remarks::STAGNATED);
    remarks.add_if(!round.folded.is_empty(), Remarks::FOLDED_PARAMETERS);
    let max_interior_error = largest(&round.distances[nodes..]);
    let unexplained = round.distances[nodes..].iter().zip(&refinement.samples.allowances[nodes..]);
    let excess = unexplained.map(|(distance, allowance)| distance - allowance).fold(0.0, f64::max);
    let is_far = back.excess > BACK_SLACK * tolerance;
    remarks.add_if(excess > tolerance || is_far, Remarks::ROUGH_BETWEEN_NODES);
    Ok(ModelReport {
        max_error: errors.max,
        rms_error: errors.rms,
        mean_error: errors.mean,
        worst_node: refinement.samples.nodes[errors.worst_index] as usize,
        tolerance,
        diagonal: mesh.diagonal(),
        max_interior_error,
        facet_sagitta: max_interior_error - excess,
        max_back_distance: back.distance,
        max_back_excess: back.excess,
        normal_jump: jump.normal,
        gap: jump.gap,
        crease_error: largest(&on_creases),
        folded_cells: round.folded.len(),
        volume: if is_closed { enclosed_volume(&round.surfaces) } else { f64::NAN },
        mesh_volume: mesh_volume(mesh),
        coefficient_count: patches.iter().map(|patch| patch.coefficient_count).sum(),
        free_count: round.free_count,
        cell_count: patches.iter().map(|patch| patch.cell_count).sum(),
        deepest_level: tmeshes.map(level).max().unwrap_or(0),
        dropped_samples: refinement.samples.dropped,
        passes: outcome.passes,
        mesh_crossings: 0,
        crossings: None,
        stop: outcome.stop,
        remarks,
        patches,
        fit_seconds: 0.0,
    })
}

fn patches(refinement: &Refinement, round: &Round) -> Vec<PatchReport> {
    let mut patches: Vec<PatchReport> = round
        .surfaces
        .iter()
        .map(|surface| PatchReport {
            cell_count: surface.mesh().leaf_count(),
            coefficient_count: surface.coefficient_count(),
            ..PatchReport::default()
        })
        .collect();
    let nodes = refinement.samples.nodes.len();
    for (sample, (place, &distance)) in round.places.iter().zip(&round.distances).enumerate() {
        let patch = &mut patches[place.quad as usize];
        if sample < nodes {
            patch.node_count += 1;
            patch.max_error = patch.max_error.max(distance);
        } else {
            patch.max_interior_error = patch.max_interior_error.max(distance);
        }
    }
    patches
}

/// How far places of a model are from the mesh, and by how much more than the facet there explains.
#[derive(Debug, Clone, Copy, Default)]
struct Back {
    distance: f64,
    excess: f64,
}

impl Back {
    fn max(self, other: Self) -> Self {
        Self { distance: self.distance.max(other.distance), excess: self.excess.max(other.excess) }
    }
}

/// The largest of places on a patch.
fn back_distance(refinement: &Refinement, quad: u32, surface: &PhtSurface) -> Back {
    let of_cell = |cell: usize| {
        let domain = surface.patch(cell).domain;
        let place = |k: usize| {
            let at = DVec2::new((k / BACK_PLACES) as f64, (k % BACK_PLACES) as f64) + 0.5;
            domain.min + domain.size() * at / BACK_PLACES as f64
        };
        let uv: Vec<DVec2> = (0..BACK_PLACES * BACK_PLACES).map(place).collect();
        let mut rows = vec![0.0; 3 * uv.len()];
        surface.eval_rows(&uv, 0, &mut rows);
        let back = |row| {
            let near = refinement.near.nearest(quad, DVec3::from_slice(row));
            near.map_or_else(Back::default, |near| Back {
                distance: near.distance,
                excess: near.distance - refinement.sagittas[near.triangle as usize],
            })
        };
        rows.chunks_exact(3).map(back).fold(Back::default(), Back::max)
    };
    (0..surface.patch_count()).into_par_iter().with_min_len(16).map(of_cell).reduce(Back::default, Back::max)
}

/// The volume that a mesh encloses; NaN for an open one.
pub(super) fn mesh_volume(mesh: &Mesh) -> f64 {
    if !mesh.loops().is_empty() {
        return f64::NAN;
    }
    let Some(&origin) = mesh.points().first() else { return 0.0 };
    sum(mesh.triangles().iter().map(|triangle| {
        let [a, b, c] = triangle.map(|node| mesh.points()[node as usize] - origin);
        a.dot(b.cross(c)) / 6.0
    }))
}
