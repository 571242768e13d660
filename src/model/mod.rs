//! Models: faces that share edges and vertices, watertight by construction.
//!
//! The boundary representation of ISO 10303-42, section 5, with manifold shells only.
//! ```text
//!   v3 <--- e2 --- v2     An edge is one curve in space from a vertex to another. A face lies on a surface and
//!    |              ^     is bounded by loops of coedges, the outer one first; each coedge runs along its edge or
//!    e3      f      e1    against it, with the face on the left as seen from outside, and knows where the edge
//!    v              |     lies in the parameter plane of the face's surface: its p-curve, over the same
//!   v0 ---- e0 ---> v1    parameters as the curve in space. One or two coedges use an edge.
//! ```
//! Shells are open, or bound a solid from outside, or a void inside a solid. A surface with trims is a model of one
//! face, see [`of_surface`](fn@of_surface); a [`Builder`] makes any other and checks it once.

mod as_tensor;
mod builder;
mod carrier;
mod deviation;
mod edge_curve;
mod error;
mod euler;
mod evaluate;
mod field;
mod measure;
mod of_patches;
mod of_surface;
mod origin;
mod project;
#[cfg(test)]
pub(crate) mod shapes;
mod tessellate;
#[cfg(test)]
mod tests;

pub use builder::Builder;
pub use carrier::{Carrier, Cylinder, Frame, Plane};
pub use deviation::ModelDeviation;
pub use edge_curve::{Arc, EdgeCurve};
pub use error::ModelError;
pub use evaluate::{ModelEvalError, ModelValues};
pub use field::{FieldGradientError, ModelField};
pub use measure::{Joint, Measure};
pub use of_patches::{PatchModel, Patchwork, PlaneFace, Planes, Rim, RimVertex, of_patches};
pub use of_surface::{CURVE_TOLERANCE, Form, FormOptions, of_parts, of_surface};
pub use origin::{FaceErrors, NodePlace, Origin, PatchPiece};
pub use project::{ModelFeet, ModelProjector};
pub use tessellate::ModelTessellation;

use crate::curve::{Curve, EndRule, interpolate};
use crate::geometry::Domain;
use crate::knots::KnotVector;
use glam::{DVec2, DVec3};

macro_rules! ids {
    ($($(#[$doc:meta])* $name:ident),+ $(,)?) => {$(
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name(u32);

        impl $name {
            /// The part with this number; a model that has none is refused when it is built.
            pub fn new(number: u32) -> Self {
                Self(number)
            }

            /// Its number, counted from 0.
            pub fn index(self) -> usize {
                self.0 as usize
            }
        }
    )+};
}

ids! {
    /// A vertex of one model.
    VertexId,
    /// An edge of one model.
    EdgeId,
    /// A surface of one model.
    SurfaceId,
    /// A face of one model.
    FaceId,
    /// A shell of one model.
    ShellId,
}

/// A curve in space between two vertices.
#[derive(Debug, Clone, PartialEq)]
pub struct Edge {
    /// From the first vertex to the second.
    pub curve: EdgeCurve,
    /// Where it begins and ends; the same vertex for a closed edge.
    pub vertices: [VertexId; 2],
    /// Whether the faces beside it meet at an angle on purpose.
    pub is_sharp: bool,
}

/// An edge as a side of a face.
#[derive(Debug, Clone, PartialEq)]
pub struct Coedge {
    /// The edge.
    pub edge: EdgeId,
    /// Whether the loop runs along the edge, not against it.
    pub is_forward: bool,
    /// Where the edge lies in the parameter plane of the face's surface, over the parameters of its curve in space
    /// and in its direction. Planes and cylinders need none: places on them have unique parameters.
    pub pcurve: Option<Curve>,
}

/// A closed row of coedges: each begins where the one before it ends.
pub type Loop = Vec<Coedge>;

/// A bounded part of a surface.
#[derive(Debug, Clone, PartialEq)]
pub struct Face {
    /// What it lies on.
    pub surface: SurfaceId,
    /// Whether the normal of the surface points out of the face's front, not its back.
    pub is_forward: bool,
    /// The outer one first.
    pub bounds: Vec<Loop>,
    /// What the caller calls it, such as the label of the triangles it was made from; faces may share it.
    pub label: u32,
}

/// What a shell bounds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// Nothing: it may have free edges.
    Open,
    /// A solid, from outside.
    Solid,
    /// A void inside the solid that another shell bounds. The fronts of its faces look into the void.
    VoidIn(ShellId),
}

/// Faces that hang together.
#[derive(Debug, Clone, PartialEq)]
pub struct Shell {
    /// Its faces.
    pub faces: Vec<FaceId>,
    /// What it bounds.
    pub role: Role,
}

/// Where an edge is used.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Use {
    /// The face.
    pub face: FaceId,
    /// The loop of the face.
    pub bound: usize,
    /// The place in the loop.
    pub place: usize,
}

/// Faces, edges and vertices that are known to fit together.
#[derive(Debug, Clone)]
pub struct Model {
    surfaces: Vec<Carrier>,
    vertices: Vec<DVec3>,
    edges: Vec<Edge>,
    faces: Vec<Face>,
    shells: Vec<Shell>,
    /// By edge: the use along it and the use against it.
    uses: Vec<[Option<Use>; 2]>,
    diagonal: f64,
    curve_deviation: f64,
    /// Where it comes from, if a fit made it.
    origin: Option<std::sync::Arc<Origin>>,
    /// By face, if a fit made it.
    face_errors: Vec<FaceErrors>,
}

/// What follows from the rest is not compared: errors of faces without nodes are NaN.
impl PartialEq for Model {
    fn eq(&self, other: &Self) -> bool {
        self.surfaces == other.surfaces
            && self.vertices == other.vertices
            && self.edges == other.edges
            && self.faces == other.faces
            && self.shells == other.shells
            && self.diagonal == other.diagonal
            && self.origin == other.origin
    }
}

impl Model {
    /// The surfaces that faces lie on.
    pub fn surfaces(&self) -> &[Carrier] {
        &self.surfaces
    }

    /// The places of the vertices.
    pub fn vertices(&self) -> &[DVec3] {
        &self.vertices
    }

    /// The edges.
    pub fn edges(&self) -> &[Edge] {
        &self.edges
    }

    /// The faces.
    pub fn faces(&self) -> &[Face] {
        &self.faces
    }

    /// The shells.
    pub fn shells(&self) -> &[Shell] {
        &self.shells
    }

    /// The ids of all faces, in order.
    pub fn face_ids(&self) -> impl ExactSizeIterator<Item = FaceId> + use<> {
        (0..self.faces.len() as u32).map(FaceId)
    }

    /// The ids of all edges, in order.
    pub fn edge_ids(&self) -> impl ExactSizeIterator<Item = EdgeId> + use<> {
        (0..self.edges.len() as u32).map(EdgeId)
    }

    /// The ids of all shells, in order.
    pub fn shell_ids(&self) -> impl ExactSizeIterator<Item = ShellId> + use<> {
        (0..self.shells.len() as u32).map(ShellId)
    }

    /// A surface.
    pub fn surface(&self, id: SurfaceId) -> &Carrier {
        &self.surfaces[id.index()]
    }

    /// A face.
    pub fn face(&self, id: FaceId) -> &Face {
        &self.faces[id.index()]
    }

    /// What a face lies on.
    pub fn carrier(&self, face: FaceId) -> &Carrier {
        self.surface(self.face(face).surface)
    }

    /// An edge.
    pub fn edge(&self, id: EdgeId) -> &Edge {
        &self.edges[id.index()]
    }

    /// The place of a vertex.
    pub fn vertex(&self, id: VertexId) -> DVec3 {
        self.vertices[id.index()]
    }

    /// Where an edge is used: along it first, then against it.
    pub fn uses(&self, edge: EdgeId) -> impl Iterator<Item = Use> + '_ {
        self.uses[edge.index()].iter().flatten().copied()
    }

    /// The coedge at a use.
    pub fn coedge(&self, at: Use) -> &Coedge {
        &self.face(at.face).bounds[at.bound][at.place]
    }

    /// Whether only one face has an edge.
    pub fn is_free(&self, edge: EdgeId) -> bool {
        self.uses(edge).count() == 1
    }

    /// Edges that only one face has.
    pub fn free_edge_count(&self) -> usize {
        self.edge_ids().filter(|&edge| self.is_free(edge)).count()
    }

    /// Loops of all faces.
    pub fn loop_count(&self) -> usize {
        self.faces.iter().map(|face| face.bounds.len()).sum()
    }

    /// Control points of all spline surfaces.
    pub fn pole_count(&self) -> usize {
        self.surfaces.iter().map(Carrier::pole_count).sum()
    }

    /// Length of the diagonal of the box around it, from samples.
    pub fn diagonal(&self) -> f64 {
        self.diagonal
    }

    /// Largest distance between an edge's curve in space and its images on the surfaces beside it, and between its
    /// ends and its vertices, measured at samples of every span.
    pub fn curve_deviation(&self) -> f64 {
        self.curve_deviation
    }

    /// The parameters on a face's surface at which a coedge's edge lies, for each of the edge's parameters.
    pub fn places(&self, at: Use, parameters: &[f64]) -> Vec<DVec2> {
        let coedge = self.coedge(at);
        let carrier = self.carrier(at.face);
        places(carrier, &self.edge(coedge.edge).curve, coedge.pcurve.as_ref(), parameters)
    }

    /// Where a coedge's edge lies in the parameter plane of its face's surface. On a cylinder it goes on where the edges
    /// before it in its loop end: a seam is used at two angles.
    pub fn pcurve(&self, at: Use) -> Result<Curve, ModelError> {
        let coedge = self.coedge(at);
        match (&coedge.pcurve, self.carrier(at.face)) {
            (Some(pcurve), _) => Ok(pcurve.clone()),
            (None, Carrier::Plane(plane)) => {
                // coordinates in the plane are affine, so those of the control points make the curve
                let curve = self.edge(coedge.edge).curve.to_spline();
                let points: Vec<DVec3> =
                    curve.control_points().chunks_exact(3).map(DVec3::from_slice).collect();
                let places = Carrier::Plane(*plane).locate_all(&points);
                let numbers = places.iter().flat_map(|uv| uv.to_array()).collect();
                Ok(Curve::new(2, curve.knots().clone(), numbers)?)
            }
            (None, _) => self.unrolled(at),
        }
    }

    /// Where an edge lies on a cylinder: straight lines and circles across it are straight there, others are interpolated.
    fn unrolled(&self, at: Use) -> Result<Curve, ModelError> {
        let carrier = self.carrier(at.face);
        let mut before = None;
        let (mut parameters, mut places) = (Vec::new(), Vec::new());
        for (place, coedge) in self.face(at.face).bounds[at.bound][..=at.place].iter().enumerate() {
            parameters = measure::between(&self.edge(coedge.edge).curve.breaks(), UNROLLED_PIECES);
            places = self.places(Use { place, ..at }, &parameters);
            if !coedge.is_forward {
                places.reverse();
            }
            carrier.go_on(before, &mut places);
            before = places.last().copied();
        }
        if !self.coedge(at).is_forward {
            places.reverse();
        }
        let (from, to) = (parameters[0], parameters[parameters.len() - 1]);
        let ends = [places[0], places[places.len() - 1]];
        let size = places.iter().map(|uv| uv.abs().max_element()).fold(0.0, f64::max);
        let is_straight = parameters
            .iter()
            .zip(&places)
            .all(|(t, uv)| ends[0].lerp(ends[1], (t - from) / (to - from)).distance(*uv) <= STRAIGHT * size);
        if is_straight {
            return Ok(straight_over((from, to), ends));
        }
        let rows: Vec<f64> = places.iter().flat_map(|uv| uv.to_array()).collect();
        let [begin, end] =
            [from, to].map(|t| carrier.speed(&self.edge(self.coedge(at).edge).curve, t).to_array());
        let slopes = EndRule::Slopes { begin: &begin, end: &end };
        Ok(interpolate(2, &parameters, &rows, slopes)?)
    }

    /// V - E + F, where a face with k loops counts 2 - k: 2 less twice the handles and the open ends for each shell.
    pub fn euler_characteristic(&self) -> i64 {
        let faces: i64 = self.faces.iter().map(|face| 2 - face.bounds.len() as i64).sum();
        self.vertices.len() as i64 - self.edges.len() as i64 + faces
    }
}

/// Where a curve lies on a surface: by its p-curve, or else by its places in space.
fn places(carrier: &Carrier, curve: &EdgeCurve, pcurve: Option<&Curve>, parameters: &[f64]) -> Vec<DVec2> {
    match pcurve {
        Some(pcurve) => {
            let mut rows = vec![0.0; 2 * parameters.len()];
            pcurve.eval_rows(parameters, 0, &mut rows);
            // rounding may leave the domain by a unit in the last place; what runs along a parameter line stays on it
            let controls = pcurve.control_points().chunks_exact(2).map(DVec2::from_slice);
            let (min, max) = controls
                .fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(min, max), at| (min.min(at), max.max(at)));
            rows.chunks_exact(2).map(|row| carrier.clamp(DVec2::from_slice(row).clamp(min, max))).collect()
        }
        None => carrier.locate_all(&curve.points(parameters)),
    }
}

/// Pieces of each span of an edge between which its place on a cylinder is interpolated: an arc is then off by h^4 / 384
/// with h = a 128th of a turn, 2e-8 of the radius.
const UNROLLED_PIECES: usize = 16;
/// Places off a straight line by less than this part of their size are on it: rounding of angles.
const STRAIGHT: f64 = 1e-13;

/// The p-curve of an edge that runs straight from one parameter pair to another at an even pace.
pub fn straight(edge: &Curve, ends: [DVec2; 2]) -> Curve {
    straight_over(edge.knots().domain(), ends)
}

fn straight_over((from, to): (f64, f64), ends: [DVec2; 2]) -> Curve {
    let knots = KnotVector::clamped(&[from, to], 1).expect("the domain of a curve is an interval");
    let numbers = ends.iter().flat_map(|uv| uv.to_array()).collect();
    Curve::new(2, knots, numbers).expect("two control points for two basis functions")
}

/// The corners of a rectangle, counter-clockwise.
fn corners(domain: &Domain) -> [DVec2; 4] {
    let (min, max) = (domain.min, domain.max);
    [min, DVec2::new(max.x, min.y), max, DVec2::new(min.x, max.y)]
}
