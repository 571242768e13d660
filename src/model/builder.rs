//! Makes models from their parts, and checks once that they fit together.

use super::{
    Carrier, Edge, EdgeCurve, EdgeId, Face, FaceId, Loop, Model, ModelError, Role, Shell, ShellId, SurfaceId,
    Use, VertexId, places,
};
use crate::curve::Curve;
use crate::geometry::{Axis, Bounds, Domain};
use crate::surface::tensor::TensorSurface;
use crate::surface::{Patches, Surface, Trims};
use glam::DVec3;

/// A model in the making. Parts get their numbers when they are added; ids of another builder are a bug of the
/// caller and refused or taken for others.
#[derive(Debug, Default)]
pub struct Builder {
    pub(super) surfaces: Vec<Carrier>,
    pub(super) vertices: Vec<DVec3>,
    pub(super) edges: Vec<Edge>,
    pub(super) faces: Vec<Face>,
    pub(super) shells: Vec<Shell>,
    diagonal: Option<f64>,
}

impl Builder {
    /// Adds a surface.
    pub fn surface(&mut self, carrier: impl Into<Carrier>) -> SurfaceId {
        self.surfaces.push(carrier.into());
        SurfaceId(self.surfaces.len() as u32 - 1)
    }

    /// Adds a vertex.
    pub fn vertex(&mut self, place: DVec3) -> VertexId {
        self.vertices.push(place);
        VertexId(self.vertices.len() as u32 - 1)
    }

    /// The place of a vertex that was added.
    pub(super) fn place(&self, vertex: VertexId) -> DVec3 {
        self.vertices[vertex.index()]
    }

    /// Adds an edge across which its faces are smooth.
    pub fn edge(&mut self, curve: impl Into<EdgeCurve>, vertices: [VertexId; 2]) -> EdgeId {
        self.add_edge(Edge { curve: curve.into(), vertices, is_sharp: false })
    }

    /// Adds any edge.
    pub fn add_edge(&mut self, edge: Edge) -> EdgeId {
        self.edges.push(edge);
        EdgeId(self.edges.len() as u32 - 1)
    }

    /// Adds a face, its outer loop first, whose front is that of its surface.
    pub fn face(&mut self, surface: SurfaceId, bounds: Vec<Loop>) -> FaceId {
        self.add_face(Face { surface, is_forward: true, bounds, label: 0 })
    }

    /// Adds any face.
    pub fn add_face(&mut self, face: Face) -> FaceId {
        self.faces.push(face);
        FaceId(self.faces.len() as u32 - 1)
    }

    /// Adds a shell.
    pub fn shell(&mut self, faces: Vec<FaceId>, role: Role) -> ShellId {
        self.shells.push(Shell { faces, role });
        ShellId(self.shells.len() as u32 - 1)
    }

    /// The size that tolerances refer to, for a model of data whose size is known; by default it is measured.
    pub fn diagonal(&mut self, diagonal: f64) {
        self.diagonal = Some(diagonal);
    }

    /// The model, if its parts fit together.
    pub fn finish(self) -> Result<Model, ModelError> {
        let Self { surfaces, vertices, edges, faces, shells, diagonal } = self;
        let mut model = Model {
            surfaces,
            vertices,
            edges,
            faces,
            shells,
            uses: Vec::new(),
            diagonal: 0.0,
            curve_deviation: 0.0,
            origin: None,
            face_errors: Vec::new(),
        };
        check_numbers(&model)?;
        check_ids(&model)?;
        model.surfaces.iter().filter_map(Carrier::spline).try_for_each(check_whole)?;
        check_loops(&model)?;
        model.uses = edge_uses(&model)?;
        check_shells(&model)?;
        model.diagonal = diagonal.unwrap_or_else(|| size(&model));
        if !model.diagonal.is_finite() || model.diagonal <= 0.0 {
            return Err(ModelError::Size { diagonal: model.diagonal });
        }
        model.curve_deviation = curve_deviation(&model);
        if cfg!(any(test, debug_assertions)) {
            assert!(model.keeps_eulers_formula(), "V - E + F does not fit the free edges");
        }
        Ok(model)
    }
}

fn check_numbers(model: &Model) -> Result<(), ModelError> {
    if model.faces.is_empty() {
        return Err(ModelError::NoFaces);
    }
    if let Some(vertex) = model.vertices.iter().position(|place| !place.is_finite()) {
        return Err(ModelError::NotFinite { vertex });
    }
    let dims = model.surfaces.iter().filter_map(Carrier::spline).map(Surface::dim);
    let dims = dims.chain(model.edges.iter().map(|edge| edge.curve.dim()));
    let of_coedges = model.faces.iter().flat_map(|face| face.bounds.iter().flatten());
    let dims_in_plane = of_coedges.filter_map(|coedge| coedge.pcurve.as_ref()).map(Curve::dim);
    let wrong =
        dims.map(|dim| (dim, 3)).chain(dims_in_plane.map(|dim| (dim, 2))).find(|(dim, right)| dim != right);
    wrong.map_or(Ok(()), |(dim, _)| Err(ModelError::Dimension { dim }))
}

/// Every number that one part has of another is there.
fn check_ids(model: &Model) -> Result<(), ModelError> {
    let refuse = |part, index| Err(ModelError::NoSuch { part, index });
    for (index, edge) in model.edges.iter().enumerate() {
        if edge.vertices.iter().any(|vertex| vertex.index() >= model.vertices.len()) {
            return refuse("edge", index);
        }
    }
    for (index, face) in model.faces.iter().enumerate() {
        let has_edges = face.bounds.iter().flatten().all(|coedge| coedge.edge.index() < model.edges.len());
        if face.surface.index() >= model.surfaces.len() || !has_edges {
            return refuse("face", index);
        }
    }
    for (index, shell) in model.shells.iter().enumerate() {
        let has_faces = shell.faces.iter().all(|face| face.index() < model.faces.len());
        let has_solid = match shell.role {
            Role::VoidIn(solid) => {
                model.shells.get(solid.index()).is_some_and(|shell| shell.role == Role::Solid)
            }
            Role::Open | Role::Solid => true,
        };
        if !has_faces || !has_solid {
            return refuse("shell", index);
        }
    }
    Ok(())
}

/// Refuses knots inside the domain at which a surface falls apart.
fn check_whole(surface: &TensorSurface) -> Result<(), ModelError> {
    for axis in [Axis::U, Axis::V] {
        let knots = surface.knots(axis);
        let (degree, (from, to)) = (knots.degree(), knots.domain());
        let torn = |run: &[f64]| run[0] == run[degree] && from < run[0] && run[0] < to;
        if let Some(index) = knots.knots().windows(degree + 1).position(torn) {
            return Err(ModelError::Torn { axis, index, degree });
        }
    }
    Ok(())
}

/// Loops close, and lie on their surfaces.
fn check_loops(model: &Model) -> Result<(), ModelError> {
    for (face, Face { surface, bounds, .. }) in model.faces.iter().enumerate() {
        if bounds.is_empty() || bounds.iter().any(Vec::is_empty) {
            return Err(ModelError::EmptyLoop { face });
        }
        let needs_pcurves = model.surface(*surface).spline().is_some();
        for (bound, coedges) in bounds.iter().enumerate() {
            for (place, coedge) in coedges.iter().enumerate() {
                let ends = |coedge: &super::Coedge| {
                    let [start, end] = model.edge(coedge.edge).vertices;
                    if coedge.is_forward { [start, end] } else { [end, start] }
                };
                if ends(coedge)[1] != ends(&coedges[(place + 1) % coedges.len()])[0] {
                    return Err(ModelError::OpenLoop { face, bound, place });
                }
                let domain = model.edge(coedge.edge).curve.domain();
                match &coedge.pcurve {
                    None if needs_pcurves => {
                        return Err(ModelError::NoPcurve { face, edge: coedge.edge.index() });
                    }
                    Some(pcurve) if pcurve.knots().domain() != domain => {
                        return Err(ModelError::PcurveDomain { face, edge: coedge.edge.index() });
                    }
                    _ => {}
                }
            }
        }
    }
    Ok(())
}

/// The use along each edge and the use against it: fronts of faces that share an edge are on the same side.
fn edge_uses(model: &Model) -> Result<Vec<[Option<Use>; 2]>, ModelError> {
    let mut uses = vec![[None; 2]; model.edges.len()];
    for (face, of_face) in model.face_ids().zip(&model.faces) {
        for (bound, coedges) in of_face.bounds.iter().enumerate() {
            for (place, coedge) in coedges.iter().enumerate() {
                let slot = &mut uses[coedge.edge.index()][usize::from(!coedge.is_forward)];
                if slot.replace(Use { face, bound, place }).is_some() {
                    return Err(ModelError::SharedTwice { edge: coedge.edge.index() });
                }
            }
        }
    }
    match uses.iter().position(|uses| *uses == [None; 2]) {
        None => Ok(uses),
        Some(edge) => Err(ModelError::Unused { edge }),
    }
}

/// Each face is in one shell, neighbours are in the same, and what bounds a solid has no free edge.
fn check_shells(model: &Model) -> Result<(), ModelError> {
    let mut shell_of = vec![None; model.faces.len()];
    for (shell, Shell { faces, .. }) in model.shells.iter().enumerate() {
        for face in faces {
            if shell_of[face.index()].replace(shell).is_some() {
                return Err(ModelError::Shells { face: face.index() });
            }
        }
    }
    if let Some(face) = shell_of.iter().position(Option::is_none) {
        return Err(ModelError::Shells { face });
    }
    for (edge, uses) in model.uses.iter().enumerate() {
        let shells = uses.map(|at| at.and_then(|at| shell_of[at.face.index()]));
        match shells {
            [Some(a), Some(b)] if a != b => return Err(ModelError::BetweenShells { edge }),
            [Some(shell), None] | [None, Some(shell)] if model.shells[shell].role != Role::Open => {
                return Err(ModelError::FreeEdge { shell, edge });
            }
            _ => {}
        }
    }
    Ok(())
}

/// The diagonal of a box around points of all edges and of the insides of all faces.
fn size(model: &Model) -> f64 {
    let mut rows: Vec<f64> = model.vertices.iter().flat_map(|place| place.to_array()).collect();
    for edge in &model.edges {
        let places = edge.curve.points(&with_middles(&edge.curve.breaks()));
        rows.extend(places.iter().flat_map(|place| place.to_array()));
    }
    for face in model.face_ids() {
        let Some(surface) = model.carrier(face).spline() else { continue };
        let Ok(trims) = model.trims(face) else { continue };
        let middle = |index| {
            let Domain { min, max } = surface.patch(index).domain;
            min.midpoint(max)
        };
        let inside: Vec<_> =
            (0..surface.patch_count()).map(middle).filter(|&uv| trims.contains(uv)).collect();
        rows.extend(model.carrier(face).points(&inside).iter().flat_map(|place| place.to_array()));
    }
    Bounds::of_rows(&rows, 3).diagonal()
}

fn with_middles(breaks: &[f64]) -> Vec<f64> {
    let middles = breaks.windows(2).flat_map(|pair| [pair[0], 0.5 * (pair[0] + pair[1])]);
    middles.chain(breaks.last().copied()).collect()
}

/// Samples of a span while curves are measured.
const MEASURE_SAMPLES: usize = 11;

/// The largest distance between the curve of an edge and its images on the surfaces beside it, and between its ends
/// and its vertices.
fn curve_deviation(model: &Model) -> f64 {
    let of_edge = |edge: EdgeId| {
        let Edge { curve, vertices, .. } = model.edge(edge);
        let ends = curve.ends();
        let at_ends =
            ends[0].distance(model.vertex(vertices[0])).max(ends[1].distance(model.vertex(vertices[1])));
        let beside = model.uses(edge).map(|at| {
            let coedge = model.coedge(at);
            deviation(model.carrier(at.face), curve, coedge.pcurve.as_ref())
        });
        beside.fold(at_ends, f64::max)
    };
    model.edge_ids().map(of_edge).fold(0.0, f64::max)
}

/// Largest distance of a curve from its image on a surface, at samples of every span of either curve.
fn deviation(carrier: &Carrier, curve: &EdgeCurve, pcurve: Option<&Curve>) -> f64 {
    let mut breaks = curve.breaks();
    breaks.extend(pcurve.into_iter().flat_map(|pcurve| pcurve.knots().breaks()));
    breaks.sort_unstable_by(f64::total_cmp);
    let parameters: Vec<f64> = breaks
        .windows(2)
        .flat_map(|span| {
            let (from, to) = (span[0], span[1]);
            (0..=MEASURE_SAMPLES).map(move |k| from + (to - from) * k as f64 / MEASURE_SAMPLES as f64)
        })
        .collect();
    let on_surface = carrier.points(&places(carrier, curve, pcurve, &parameters));
    let in_space = curve.points(&parameters);
    on_surface.into_iter().zip(in_space).map(|(a, b)| a.distance(b)).fold(0.0, f64::max)
}

impl Model {
    /// The loops of a face as closed polylines in the parameter plane of its surface: exact where the p-curves are
    /// polylines, else through points of each span.
    pub fn polylines(&self, face: FaceId) -> Vec<Vec<glam::DVec2>> {
        let of_face = self.face(face);
        let polyline = |(bound, coedges): (usize, &Loop)| {
            let mut points: Vec<glam::DVec2> = Vec::new();
            for (place, coedge) in coedges.iter().enumerate() {
                let mut parameters = parameters_along(&self.edge(coedge.edge).curve, coedge.pcurve.as_ref());
                if !coedge.is_forward {
                    parameters.reverse();
                }
                let mut places = self.places(Use { face, bound, place }, &parameters);
                self.carrier(face).go_on(points.last().copied(), &mut places);
                points.extend(places);
            }
            points.dedup();
            while points.len() > 1 && points.first() == points.last() {
                points.pop();
            }
            points
        };
        let mut polylines: Vec<Vec<glam::DVec2>> = of_face.bounds.iter().enumerate().map(polyline).collect();
        self.carrier(face).align_holes(&mut polylines, |uv| uv);
        polylines
    }

    /// The part of the parameter plane that a face on a spline takes; none for a face on another surface, or one whose
    /// loops do not lie in the domain.
    pub fn trims(&self, face: FaceId) -> Result<Trims, ModelError> {
        let domain = self.carrier(face).domain().ok_or(ModelError::NoSpline { face: face.index() })?;
        Ok(Trims::new(self.polylines(face), &domain)?)
    }
}

/// Pieces of a span of a p-curve that is no polyline.
const PIECES: usize = 8;

/// Parameters of an edge between which its p-curve is nearly straight.
fn parameters_along(curve: &EdgeCurve, pcurve: Option<&Curve>) -> Vec<f64> {
    let (breaks, pieces) = match pcurve {
        Some(pcurve) if pcurve.knots().degree() == 1 => (pcurve.knots().breaks(), 1),
        Some(pcurve) => (pcurve.knots().breaks(), PIECES),
        None => (curve.breaks(), if curve.is_polyline() { 1 } else { PIECES }),
    };
    let inner = breaks.windows(2).flat_map(|span| {
        let (from, to) = (span[0], span[1]);
        (0..pieces).map(move |k| from + (to - from) * k as f64 / pieces as f64)
    });
    inner.chain(breaks.last().copied()).collect()
}
