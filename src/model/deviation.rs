//! How far a model and a mesh are apart.

use super::{FaceId, Model, ModelProjector};
use crate::control::Pool;
use crate::memory::ParallelCollectVec;
use crate::mesh::Mesh;
use crate::query::deviation::{DeviationError, DeviationOptions};
use crate::query::project::ProjectOptions;
use crate::query::side::side;
use crate::query::tessellate::TessellateOptions;
use crate::query::triangles::TriangleTree;
use crate::summary::{DataErrors, summarize};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// Distances between a model and a mesh, in model units.
#[derive(Debug, Clone, Default)]
pub struct ModelDeviation {
    /// From the nodes to the model: each, the largest, root mean square, mean, and the farthest node.
    pub nodes: DataErrors,
    /// The face nearest to each node.
    pub faces: Vec<Option<FaceId>>,
    /// The parameters nearest to each node.
    pub uv: Vec<DVec2>,
    /// Nodes whose distance is not proved to be the least one.
    pub unproven: usize,
    /// Largest distance from a place on the model to the mesh; NaN unless asked for.
    pub max_back_distance: f64,
    /// Where it was found; NaN unless asked for.
    pub worst_back_place: DVec3,
    /// Places on the model that were measured.
    pub back_count: usize,
}

/// Longest side of the triangles from which is measured back, against the mesh's diagonal.
const EDGE_LENGTH: f64 = 1e-2;

impl Model {
    /// Measures a model against a mesh.
    pub fn deviation(
        &self,
        mesh: &Mesh,
        options: &DeviationOptions,
        pool: &Pool,
    ) -> Result<ModelDeviation, DeviationError> {
        let feet = ModelProjector::new(self)?.project(mesh.points(), &ProjectOptions::default(), pool)?;
        let mut report = ModelDeviation {
            unproven: feet.unproven(),
            nodes: summarize(feet.distances),
            faces: feet.faces,
            uv: feet.uv,
            max_back_distance: f64::NAN,
            worst_back_place: DVec3::NAN,
            back_count: 0,
        };
        if options.measure_back {
            let automatic = EDGE_LENGTH * mesh.diagonal();
            let longest = if options.max_edge_length > 0.0 { options.max_edge_length } else { automatic };
            let places = self.samples(options.chord_tolerance, longest, pool)?;
            let tree = TriangleTree::watched(mesh, pool.watch());
            let distance = |&place: &DVec3| tree.nearest(place).map_or(f64::NAN, |near| near.distance);
            let errors = summarize(pool.run(|| places.par_iter().map(distance).collect_vec()));
            report.max_back_distance = errors.max;
            report.worst_back_place = places[errors.worst_index];
            report.back_count = places.len();
        }
        Ok(report)
    }

    /// The distances of the nodes with the sign of their side: positive in front of the face that is nearest, which is the
    /// outside of a solid.
    pub fn signed(&self, mesh: &Mesh, found: &ModelDeviation, pool: &Pool) -> Vec<f64> {
        let one = |node: usize| {
            let (distance, Some(face)) = (found.nodes.each[node], found.faces[node]) else {
                return found.nodes.each[node];
            };
            let mut row = [0.0; 9];
            self.carrier(face).eval_rows(&[found.uv[node]], 1, &mut row);
            let is_behind = side(mesh.points()[node], &row) < 0.0;
            if is_behind == self.face(face).is_forward { -distance } else { distance }
        };
        pool.run(|| (0..mesh.points().len()).into_par_iter().map(one).collect())
    }

    /// Nodes of a tessellation, which lie on the model, and places of the model below the middles of its triangles.
    fn samples(
        &self,
        chord_tolerance: f64,
        max_edge_length: f64,
        pool: &Pool,
    ) -> Result<Vec<DVec3>, DeviationError> {
        let options = TessellateOptions { chord_tolerance, max_edge_length, ..TessellateOptions::default() };
        let tessellation = self.tessellate_by(&options, pool)?;
        let mut places = tessellation.mesh.points().to_vec();
        let middles = tessellation.places.iter().map(|corners| corners.iter().sum::<DVec2>() / 3.0);
        for (middle, &face) in middles.zip(&tessellation.faces) {
            places.extend(self.carrier(face).points(&[self.carrier(face).clamp(middle)]));
        }
        Ok(places)
    }
}
