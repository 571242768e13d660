//! Watertight triangle meshes of models.
//!
//! Each edge becomes one polyline, whose nodes the faces on both sides share. A face is then a polygon in the parameter
//! plane of its surface, stretched so that both parameters count alike in space: a constrained Delaunay triangulation,
//! in which the middles of all inner sides that are too long or too far from the surface become nodes.
//! ```text
//!   e1       e2        Sides on the bound are never halved. A pole, where a loop jumps from one end of a side of the
//!   o--o--o--o--o      plane to the other without an edge, is one node with two places; triangles that it makes
//!   |  face A   |      degenerate are left out.
//!   o--o--o--o--o
//! ```

mod face_plane;
mod inside;
mod nodes;
mod polygons;

use super::{FaceId, Model};
use crate::control::Pool;
use crate::mesh::Mesh;
use crate::query::crossings::crossed_triangles;
use crate::query::tessellate::{TessellateError, TessellateOptions};
use face_plane::FacePlane;
use glam::DVec2;
use nodes::Nodes;
use rayon::prelude::*;

/// A tessellation with its quality.
#[derive(Debug, Clone)]
pub struct ModelTessellation {
    /// The mesh: one component a shell, closed where the shell is.
    pub mesh: Mesh,
    /// The face under each triangle.
    pub faces: Vec<FaceId>,
    /// The parameters of the corners of each triangle on the surface of its face.
    pub places: Vec<[DVec2; 3]>,
    /// The nodes along each edge, its ends included.
    pub edges: Vec<Vec<u32>>,
    /// Smallest angle of a triangle in space, in radians.
    pub smallest_angle: f64,
    /// Largest distance measured between the middle of a side and the surface or curve.
    pub chord_error: f64,
    /// Pairs of triangles that cross.
    pub crossings: usize,
}

/// Share of the diagonal that stands for a chord tolerance of 0.
const CHORD_SHARE: f64 = 1e-3;
/// Times that the edges of a face are sampled more finely because their polylines cross, by this factor each time.
const MAX_TRIALS: usize = 8;
const FINER: f64 = 0.25;
/// Times that faces whose triangles cross are triangulated again, [`FINER`] each time.
const MAX_CROSSED: usize = 3;
/// Faces whose triangulations are kept until they are joined.
const AT_ONCE: usize = 64;

impl Model {
    /// Triangulates a model on this thread.
    pub fn tessellate(&self, options: &TessellateOptions) -> Result<ModelTessellation, TessellateError> {
        self.tessellate_by(options, &Pool::new(1))
    }

    /// Triangulates a model; faces are shared by the threads of a pool, and the result does not depend on them.
    pub fn tessellate_by(
        &self,
        options: &TessellateOptions,
        pool: &Pool,
    ) -> Result<ModelTessellation, TessellateError> {
        options.check()?;
        let automatic = CHORD_SHARE * self.diagonal();
        let chord = if options.chord_tolerance > 0.0 { options.chord_tolerance } else { automatic };
        let mut chords =
            Chords { faces: vec![chord; self.faces().len()], edges: vec![chord; self.edges().len()] };
        let mut best = self.tessellate_within(&mut chords, options, pool)?;
        let mut crossed = best.count_crossings(pool)?;
        for _ in 0..MAX_CROSSED {
            if best.crossings == 0 {
                break;
            }
            crossed.into_iter().for_each(|face| chords.divide(self, face));
            let mut finer = match self.tessellate_within(&mut chords, options, pool) {
                Ok(finer) => finer,
                Err(cancelled @ TessellateError::Cancelled(_)) => return Err(cancelled),
                // the coarser one will do
                Err(_) => break,
            };
            crossed = finer.count_crossings(pool)?;
            if finer.crossings >= best.crossings {
                break;
            }
            best = finer;
        }
        Ok(best)
    }

    /// Triangulates a model with a chord of its own for each face and edge; edges whose polylines cross get shorter ones.
    fn tessellate_within(
        &self,
        chords: &mut Chords,
        options: &TessellateOptions,
        pool: &Pool,
    ) -> Result<ModelTessellation, TessellateError> {
        let all: Vec<FaceId> = self.face_ids().collect();
        for trial in 0.. {
            let mut nodes = Nodes::new(self, &chords.edges, options)?;
            let mut crossing = None;
            for faces in all.chunks(AT_ONCE) {
                pool.check()?;
                let plane = |&face: &FaceId| {
                    let chord = chords.faces[face.index()];
                    FacePlane::new(self, face, &nodes, options, chord).and_then(FacePlane::refined)
                };
                let planes: Vec<_> = pool.run(|| faces.par_iter().map(plane).collect());
                for (&face, plane) in faces.iter().zip(planes) {
                    match plane {
                        Ok(plane) => plane.finish(&mut nodes),
                        Err(error @ TessellateError::CrossingTrims { .. }) => {
                            crossing = Some(error);
                            // polylines that cross have too few nodes
                            chords.divide_edges(self, face);
                        }
                        Err(error) => return Err(error),
                    }
                    nodes.check(options)?;
                }
            }
            match crossing {
                None => return nodes.finish(),
                Some(error) if trial == MAX_TRIALS => return Err(error),
                Some(_) => {}
            }
        }
        unreachable!("the loop ends by its trials")
    }
}

/// How far triangles and polylines may be from their face or edge.
struct Chords {
    faces: Vec<f64>,
    edges: Vec<f64>,
}

impl Chords {
    fn divide(&mut self, model: &Model, face: FaceId) {
        self.faces[face.index()] *= FINER;
        self.divide_edges(model, face);
    }

    fn divide_edges(&mut self, model: &Model, face: FaceId) {
        let edges = model.face(face).bounds.iter().flatten().map(|coedge| coedge.edge);
        edges.for_each(|edge| self.edges[edge.index()] *= FINER);
    }
}

impl ModelTessellation {
    /// Counts the pairs of triangles that cross; returns their faces, ascending.
    fn count_crossings(&mut self, pool: &Pool) -> Result<Vec<FaceId>, TessellateError> {
        let (found, triangles) = crossed_triangles(&self.mesh, pool)?;
        self.crossings = found.count;
        let mut faces: Vec<FaceId> =
            triangles.into_iter().map(|triangle| self.faces[triangle as usize]).collect();
        faces.sort_unstable();
        faces.dedup();
        Ok(faces)
    }
}

#[cfg(test)]
mod tests {
    use super::super::of_parts;
    use super::super::shapes::{
        PIPE_HEIGHT, PIPE_RADIUS, circle, hollow_cube, pierced_sheet, pipe, rectangle, torus_piece, trimmed,
        wave,
    };
    use super::*;
    use crate::surface::Surface;
    use std::f64::consts::PI;

    fn area_and_volume(mesh: &Mesh) -> (f64, f64) {
        let corners = |t: &[u32; 3]| t.map(|n| mesh.points()[n as usize]);
        mesh.triangles().iter().map(corners).fold((0.0, 0.0), |(area, volume), [a, b, c]| {
            let n = (b - a).cross(c - a);
            (area + n.length() / 2.0, volume + a.dot(n) / 6.0)
        })
    }

    #[test]
    fn solids_become_closed_meshes() {
        for is_flat in [false, true] {
            let result = hollow_cube(is_flat).tessellate(&TessellateOptions::default()).unwrap();
            let mesh = &result.mesh;
            assert_eq!((mesh.loops().len(), mesh.component_count(), mesh.genus()), (0, 2, 0));
            let (area, volume) = area_and_volume(mesh);
            assert!((area - 7.5).abs() < 1e-14 && (volume - 0.875).abs() < 1e-14, "{area} {volume}");
        }
        let exact = PI * PIPE_RADIUS * PIPE_RADIUS * PIPE_HEIGHT;
        for chord_tolerance in [1e-1, 1e-2, 1e-3] {
            let options = TessellateOptions { chord_tolerance, ..TessellateOptions::default() };
            let result = pipe().tessellate(&options).unwrap();
            assert_eq!(
                (result.mesh.loops().len(), result.mesh.component_count(), result.mesh.genus()),
                (0, 1, 0)
            );
            assert!(result.chord_error <= chord_tolerance, "{}", result.chord_error);
            let (_, volume) = area_and_volume(&result.mesh);
            // chords are inside, by less than the tolerance all round
            let least = exact * (1.0 - 2.0 * chord_tolerance / PIPE_RADIUS);
            assert!(volume < exact && volume > least, "{volume} {exact}");
            assert_eq!(result.faces.len(), result.mesh.triangles().len());
        }
    }

    #[test]
    fn holes_in_cylinders_lie_where_they_are_wherever_angles_begin() {
        let options = TessellateOptions { chord_tolerance: 1e-3, ..TessellateOptions::default() };
        for from in [-4.0, -2.0, 0.0, 2.5] {
            for middle in [0.5, 1.5, 2.5, 3.5, 4.5] {
                let model = pierced_sheet(from, from + middle);
                let mesh = model.tessellate(&options).unwrap().mesh;
                assert_eq!((mesh.loops().len(), mesh.component_count()), (2, 1), "{from} {middle}");
                let (area, _) = area_and_volume(&mesh);
                // chords of a circle of radius 1 are shorter by less than their sagitta's part
                assert!(area < 9.6 && area > 9.6 * (1.0 - 2e-3), "{from} {middle}: {area}");
                let surface = model.face_surface(FaceId(0)).unwrap();
                assert_eq!(surface.region().trims.loops().len(), 2);
            }
        }
    }

    #[test]
    fn holes_of_any_size_stay_open() {
        let holes = vec![rectangle(0.05, 0.95), circle([0.5, 0.5], 0.3, 300), circle([0.87, 0.87], 1e-4, 7)];
        for surface in [trimmed(wave(), holes.clone()), trimmed(torus_piece(), holes)] {
            let model = of_parts(&surface, vec![surface.clone()]).unwrap();
            for chord_tolerance in [0.0, 1e-1, 1e-4] {
                let options = TessellateOptions { chord_tolerance, ..TessellateOptions::default() };
                let result = model.tessellate(&options).unwrap();
                assert_eq!((result.mesh.loops().len(), result.mesh.component_count()), (3, 1));
                // each edge is one polyline of the border
                let on_edges: usize = result.edges.iter().map(|nodes| nodes.len() - 1).sum();
                assert_eq!(on_edges, result.mesh.loops().iter().map(Vec::len).sum::<usize>());
            }
        }
    }
}
