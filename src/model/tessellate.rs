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

use super::{Carrier, Edge, FaceId, Model, Use};
use crate::control::Pool;
use crate::mesh::Mesh;
use crate::query::crossings::crossed_triangles;
use crate::query::tessellate::{TessellateError, TessellateOptions, distance_to_segment, least_angle};
use crate::surface::Patches;
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation, mitigate_underflow};
use std::collections::HashMap;
use std::f64::consts::{PI, TAU};

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
/// Halvings of an edge: its pieces are then as short as rounding lets them be told apart.
const MAX_DEPTH: u32 = 30;
/// Times that the edges of a face are sampled more finely because their polylines cross, by this factor each time.
const MAX_TRIALS: usize = 8;
const FINER: f64 = 0.25;
/// Sides are not halved any more once they are this short against the face: a fold or pole would go on for ever.
const SHORTEST_SIDE: f64 = 1e-7;
/// Times that faces whose triangles cross are triangulated again, [`FINER`] each time.
const MAX_CROSSED: usize = 3;
/// Least height of a triangle over a side of the bound, as a share of that side.
const LEAST_HEIGHT: f64 = 0.05;
/// Faces whose triangulations are kept until they are joined.
const AT_ONCE: usize = 64;
/// Most lines in each direction on whose crossings first nodes are set: where patches are, features may be.
const START_LINES: usize = 17;

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

/// Nodes and triangles of all faces so far.
struct Nodes {
    points: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    faces: Vec<FaceId>,
    places: Vec<[DVec2; 3]>,
    /// Parameters and nodes along each edge.
    edges: Vec<(Vec<f64>, Vec<u32>)>,
    smallest_angle: f64,
    chord_error: f64,
}

impl Nodes {
    /// With the nodes of all edges.
    fn new(model: &Model, chords: &[f64], options: &TessellateOptions) -> Result<Self, TessellateError> {
        let mut nodes = Self {
            points: model.vertices().to_vec(),
            triangles: Vec::new(),
            faces: Vec::new(),
            places: Vec::new(),
            edges: Vec::with_capacity(chords.len()),
            smallest_angle: f64::INFINITY,
            chord_error: 0.0,
        };
        let is_short = short_loops(model);
        for (id, &chord) in model.edge_ids().zip(chords) {
            let edge = model.edge(id);
            let (parameters, off) = samples(edge, chord, options.max_edge_length, is_short[id.index()]);
            nodes.chord_error = nodes.chord_error.max(off);
            let inner = &parameters[1..parameters.len() - 1];
            let first = nodes.points.len() as u32;
            nodes.points.extend(edge.curve.points(inner));
            let [start, end] = edge.vertices.map(|vertex| vertex.index() as u32);
            let along = [start].into_iter().chain(first..first + inner.len() as u32).chain([end]).collect();
            nodes.edges.push((parameters, along));
            nodes.check(options)?;
        }
        Ok(nodes)
    }

    fn check(&self, options: &TessellateOptions) -> Result<(), TessellateError> {
        let limit = options.max_points;
        if self.points.len() > limit { Err(TessellateError::TooLarge { limit }) } else { Ok(()) }
    }

    fn finish(self) -> Result<ModelTessellation, TessellateError> {
        if self.triangles.is_empty() {
            return Err(TessellateError::Empty);
        }
        Ok(ModelTessellation {
            mesh: Mesh::new(self.points, self.triangles)?,
            faces: self.faces,
            places: self.places,
            edges: self.edges.into_iter().map(|(_, nodes)| nodes).collect(),
            smallest_angle: self.smallest_angle,
            chord_error: self.chord_error,
            crossings: 0,
        })
    }
}

/// The edges of loops of one or two, which need inner nodes to enclose anything.
fn short_loops(model: &Model) -> Vec<bool> {
    let mut is_short = vec![false; model.edges().len()];
    let bounds = model.faces().iter().flat_map(|face| &face.bounds);
    for coedge in bounds.filter(|bound| bound.len() < 3).flatten() {
        is_short[coedge.edge.index()] = true;
    }
    is_short
}

/// Parameters along an edge whose chords are near and short enough, and how far places between them are off at most.
fn samples(edge: &Edge, chord: f64, longest: f64, is_short: bool) -> (Vec<f64>, f64) {
    let breaks = edge.curve.breaks();
    let point = |t: f64| edge.curve.points(&[t])[0];
    // the ends of pieces and three places inside each
    let mut fine = vec![(breaks[0], point(breaks[0]))];
    for span in breaks.windows(2) {
        let mut stack = vec![(span[0], span[1], point(span[0]), point(span[1]), 0)];
        while let Some((from, to, a, b, depth)) = stack.pop() {
            let inner = [0.25, 0.5, 0.75].map(|share| from + share * (to - from));
            let points = inner.map(point);
            let off = points.iter().map(|&p| distance_to_segment(p, a, b)).fold(0.0, f64::max);
            let is_long = longest > 0.0 && a.distance(b) > longest;
            let needs_more = is_short && breaks.len() == 2 && depth < 2;
            if (off > chord || is_long || needs_more) && depth < MAX_DEPTH {
                stack.push((inner[1], to, points[1], b, depth + 1));
                stack.push((from, inner[1], a, points[1], depth + 1));
            } else {
                fine.extend(inner.into_iter().zip(points));
                fine.push((to, b));
            }
        }
    }
    joined_pieces(&fine, chord, longest, is_short)
}

/// Numbers of places from the end of a piece to the end of the next.
const PLACES: usize = 4;
/// Most pieces under one chord: more would make the search for them quadratic.
const MOST_JOINED: usize = 64;

/// Without the nodes that only stand where spans meet: chords over several pieces may be near enough as well.
fn joined_pieces(fine: &[(f64, DVec3)], chord: f64, longest: f64, is_short: bool) -> (Vec<f64>, f64) {
    let least = if is_short { 3 } else { 1 };
    let last = fine.len() / PLACES;
    let off = |from: usize, to: usize| {
        let (a, b) = (fine[PLACES * from].1, fine[PLACES * to].1);
        let between = &fine[PLACES * from + 1..PLACES * to];
        between.iter().map(|&(_, p)| distance_to_segment(p, a, b)).fold(0.0, f64::max)
    };
    let (mut parameters, mut most) = (vec![fine[0].0], 0.0_f64);
    let mut at = 0;
    while at < last {
        let mut next = at + 1;
        let fits = |next: usize| {
            let is_long = longest > 0.0 && fine[PLACES * at].1.distance(fine[PLACES * next].1) > longest;
            // a loop of one edge or two needs nodes enough to enclose something
            !is_long && (next - at) * least <= last && next - at <= MOST_JOINED && off(at, next) <= chord
        };
        while next < last && fits(next + 1) {
            next += 1;
        }
        most = most.max(off(at, next));
        parameters.push(fine[PLACES * next].0);
        at = next;
    }
    (parameters, most)
}

/// A face in the stretched plane.
struct FacePlane<'a> {
    model: &'a Model,
    face: FaceId,
    options: &'a TessellateOptions,
    chord: f64,
    stretch: DVec2,
    triangulation: ConstrainedDelaunayTriangulation<Point2<f64>>,
    /// The node at each vertex of the bound.
    bound: HashMap<FixedVertexHandle, u32>,
    points: HashMap<FixedVertexHandle, DVec3>,
    shortest: f64,
    chord_error: f64,
}

impl<'a> FacePlane<'a> {
    fn new(
        model: &'a Model,
        face: FaceId,
        nodes: &Nodes,
        options: &'a TessellateOptions,
        chord: f64,
    ) -> Result<Self, TessellateError> {
        let loops = polygons(model, face, nodes);
        let (min, max) = loops
            .iter()
            .flatten()
            .fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(min, max), (uv, _)| (min.min(*uv), max.max(*uv)));
        let stretch = stretch(model.carrier(face), min, max);
        let mut plane = Self {
            model,
            face,
            options,
            chord,
            stretch,
            triangulation: ConstrainedDelaunayTriangulation::new(),
            bound: HashMap::new(),
            points: HashMap::new(),
            shortest: SHORTEST_SIDE * ((max - min) * stretch).length(),
            chord_error: 0.0,
        };
        plane.add_bounds(&loops, nodes)?;
        plane.add_starts(min, max)?;
        Ok(plane)
    }

    fn uv(&self, place: Point2<f64>) -> DVec2 {
        self.model.carrier(self.face).clamp(DVec2::new(place.x, place.y) / self.stretch)
    }

    fn insert(&mut self, uv: DVec2) -> Result<FixedVertexHandle, TessellateError> {
        let place = uv * self.stretch;
        let place = mitigate_underflow(Point2::new(place.x, place.y));
        let crossing = TessellateError::CrossingTrims { u: uv.x, v: uv.y };
        self.triangulation.insert(place).map_err(|_| crossing)
    }

    fn add_bounds(&mut self, loops: &[Vec<(DVec2, u32)>], nodes: &Nodes) -> Result<(), TessellateError> {
        let mut polygons = Vec::with_capacity(loops.len());
        for polygon in loops {
            let mut vertices = Vec::with_capacity(polygon.len());
            for &(uv, node) in polygon {
                let vertex = self.insert(uv)?;
                // two nodes at one place: a side has vanished, or loops touch
                if self.bound.insert(vertex, node).is_some_and(|other| other != node) {
                    return Err(TessellateError::CrossingTrims { u: uv.x, v: uv.y });
                }
                self.points.insert(vertex, nodes.points[node as usize]);
                vertices.push(vertex);
            }
            polygons.push(vertices);
        }
        for (vertices, polygon) in polygons.iter().zip(loops) {
            for (k, &from) in vertices.iter().enumerate() {
                let to = vertices[(k + 1) % vertices.len()];
                let crossing = TessellateError::CrossingTrims { u: polygon[k].0.x, v: polygon[k].0.y };
                if from == to {
                    continue;
                }
                if !self.triangulation.can_add_constraint(from, to) {
                    return Err(crossing);
                }
                self.triangulation.add_constraint(from, to);
                // a vertex on the side would have cut it
                if self
                    .triangulation
                    .get_edge_from_neighbors(from, to)
                    .is_none_or(|edge| !edge.is_constraint_edge())
                {
                    return Err(crossing);
                }
            }
        }
        Ok(())
    }

    /// Nodes in the middles of patches.
    fn add_starts(&mut self, min: DVec2, max: DVec2) -> Result<(), TessellateError> {
        let lines = match self.model.carrier(self.face) {
            Carrier::Plane(_) => return Ok(()),
            Carrier::Cylinder(_) => [Vec::new(), Vec::new()],
            Carrier::Spline(surface) => {
                if surface.patch_count() == 1 {
                    [0.5 * (min.x + max.x), 0.5 * (min.y + max.y)].map(|middle| vec![middle])
                } else {
                    use crate::geometry::Axis;
                    [Axis::U, Axis::V].map(|axis| middles(&surface.knots(axis).breaks()))
                }
            }
        };
        let is_inside = Inside::new(&self.triangulation);
        let mut starts = Vec::new();
        for &u in &lines[0] {
            for &v in &lines[1] {
                let uv = DVec2::new(u, v);
                let place = uv * self.stretch;
                if is_inside.contains(&self.triangulation, Point2::new(place.x, place.y)) {
                    starts.push(uv);
                }
            }
        }
        starts.into_iter().try_for_each(|uv| self.insert(uv).map(|_| ()))
    }

    fn point(&mut self, vertex: FixedVertexHandle) -> DVec3 {
        let uv = self.uv(self.triangulation.vertex(vertex).position());
        let carrier = self.model.carrier(self.face);
        *self.points.entry(vertex).or_insert_with(|| carrier.points(&[uv])[0])
    }

    /// Whether a place is so near to a side of the bound, which cannot be halved, that a node there would make slivers,
    /// and their middles more of them.
    fn is_beside_bound(&self, uv: DVec2) -> bool {
        let place = uv * self.stretch;
        let point = Point2::new(place.x, place.y);
        use spade::PositionInTriangulation::{OnEdge, OnFace};
        let is_near = |side: spade::handles::DirectedEdgeHandle<_, _, _, _>| {
            side.is_constraint_edge()
                && side.distance_2(point) < LEAST_HEIGHT * LEAST_HEIGHT * side.length_2()
        };
        match self.triangulation.locate(point) {
            OnFace(face) => self.triangulation.face(face).adjacent_edges().into_iter().any(is_near),
            OnEdge(edge) => self.triangulation.directed_edge(edge).is_constraint_edge(),
            _ => false,
        }
    }

    /// With the middles of all inner sides as nodes that need it.
    fn refined(mut self) -> Result<Self, TessellateError> {
        loop {
            let inside = Inside::new(&self.triangulation);
            let sides: Vec<[FixedVertexHandle; 2]> = self
                .triangulation
                .undirected_edges()
                .filter(|edge| !edge.is_constraint_edge() && edge.length_2() > self.shortest * self.shortest)
                .filter(|edge| {
                    edge.as_directed().face().as_inner().is_some_and(|face| inside.keeps[face.fix().index()])
                })
                .map(|edge| edge.vertices().map(|vertex| vertex.fix()))
                .collect();
            let mut middles = Vec::new();
            self.chord_error = 0.0;
            for [a, b] in sides {
                let (from, to) = (self.point(a), self.point(b));
                let place = |vertex| self.uv(self.triangulation.vertex(vertex).position());
                let uv = (place(a) + place(b)) / 2.0;
                let off = distance_to_segment(self.model.carrier(self.face).points(&[uv])[0], from, to);
                let longest = self.options.max_edge_length;
                let is_rough = off > self.chord || (longest > 0.0 && from.distance(to) > longest);
                if is_rough && !self.is_beside_bound(uv) {
                    middles.push(uv);
                }
                self.chord_error = self.chord_error.max(off);
            }
            let before = self.triangulation.num_vertices();
            for uv in middles {
                self.insert(uv)?;
            }
            let count = self.triangulation.num_vertices();
            if count > self.options.max_points {
                return Err(TessellateError::TooLarge { limit: self.options.max_points });
            }
            if count == before {
                return Ok(self);
            }
        }
    }

    /// Adds the face to the others.
    fn finish(mut self, nodes: &mut Nodes) {
        let inside = Inside::new(&self.triangulation);
        let faces: Vec<[FixedVertexHandle; 3]> = self
            .triangulation
            .inner_faces()
            .filter(|face| inside.keeps[face.fix().index()])
            .map(|face| face.vertices().map(|vertex| vertex.fix()))
            .collect();
        let is_forward = self.model.face(self.face).is_forward;
        for face in faces {
            let corners = face.map(|vertex| self.point(vertex));
            let mut triangle = face.map(|vertex| {
                *self.bound.entry(vertex).or_insert_with(|| {
                    nodes.points.push(self.points[&vertex]);
                    nodes.points.len() as u32 - 1
                })
            });
            let [a, b, c] = triangle;
            if a == b || b == c || c == a {
                continue;
            }
            let mut places = face.map(|vertex| self.uv(self.triangulation.vertex(vertex).position()));
            if !is_forward {
                triangle.swap(1, 2);
                places.swap(1, 2);
            }
            nodes.places.push(places);
            nodes.smallest_angle = nodes.smallest_angle.min(least_angle(corners));
            nodes.triangles.push(triangle);
            nodes.faces.push(self.face);
        }
        nodes.chord_error = nodes.chord_error.max(self.chord_error);
    }
}

/// Which triangles lie inside an odd number of loops: those reached from outside across an odd number of sides.
struct Inside {
    keeps: Vec<bool>,
}

impl Inside {
    fn new(triangulation: &ConstrainedDelaunayTriangulation<Point2<f64>>) -> Self {
        let mut parity = vec![None; triangulation.num_all_faces()];
        let outer = triangulation.outer_face().fix();
        parity[outer.index()] = Some(false);
        let mut stack = Vec::new();
        for edge in triangulation.convex_hull() {
            // the inner side of the hull
            stack.push((edge.rev().fix(), edge.is_constraint_edge()));
            stack.push((edge.fix(), edge.is_constraint_edge()));
        }
        while let Some((edge, is_inside)) = stack.pop() {
            let Some(face) = triangulation.directed_edge(edge).face().as_inner() else { continue };
            if parity[face.fix().index()].is_some() {
                continue;
            }
            parity[face.fix().index()] = Some(is_inside);
            for side in face.adjacent_edges() {
                stack.push((side.rev().fix(), is_inside ^ side.is_constraint_edge()));
            }
        }
        Self { keeps: parity.into_iter().map(|inside| inside == Some(true)).collect() }
    }

    /// Whether a place is inside a kept triangle, not on its sides.
    fn contains(
        &self,
        triangulation: &ConstrainedDelaunayTriangulation<Point2<f64>>,
        place: Point2<f64>,
    ) -> bool {
        match triangulation.locate(place) {
            spade::PositionInTriangulation::OnFace(face) => self.keeps[face.index()],
            spade::PositionInTriangulation::OnEdge(edge) => {
                let edge = triangulation.directed_edge(edge);
                !edge.is_constraint_edge()
                    && edge.face().as_inner().is_some_and(|face| self.keeps[face.fix().index()])
            }
            _ => false,
        }
    }
}

/// The middles of spans, of about as many as [`START_LINES`] if there are more.
fn middles(breaks: &[f64]) -> Vec<f64> {
    let count = breaks.len() - 1;
    let step = count.div_ceil(START_LINES);
    breaks.windows(2).skip(step / 2).step_by(step).map(|span| 0.5 * (span[0] + span[1])).collect()
}

/// A closed polygon of places and nodes.
type Polygon = Vec<(DVec2, u32)>;

/// The loops of a face as polygons.
fn polygons(model: &Model, face: FaceId, nodes: &Nodes) -> Vec<Polygon> {
    let carrier = model.carrier(face);
    let polygon = |(bound, coedges): (usize, &super::Loop)| {
        let mut polygon = Polygon::new();
        for (place, coedge) in coedges.iter().enumerate() {
            let (parameters, along) = &nodes.edges[coedge.edge.index()];
            let mut places = model.places(Use { face, bound, place }, parameters);
            let mut along = along.clone();
            if !coedge.is_forward {
                places.reverse();
                along.reverse();
            }
            carrier.go_on(polygon.last().map(|&(uv, _)| uv), &mut places);
            polygon.extend(places.into_iter().zip(along));
        }
        // an edge begins where the one before ends: at the same place, but at a pole or seam
        polygon.dedup_by(|next, before| is_same(next, before));
        polygon
    };
    let polygons: Vec<Polygon> = model.face(face).bounds.iter().enumerate().map(polygon).collect();
    let (open, mut closed): (Vec<Polygon>, Vec<Polygon>) =
        polygons.into_iter().partition(|polygon| winds(carrier, polygon));
    if let [a, b] = open.as_slice() {
        closed.insert(0, joined(a, b));
    } else {
        closed.extend(open);
    }
    for polygon in &mut closed {
        while polygon.len() > 1 && is_same(&polygon[0], &polygon[polygon.len() - 1]) {
            polygon.pop();
        }
    }
    closed
}

/// Places of one node that differ by less than this share of their size are one: they come from two p-curves.
const SAME: f64 = 1e-12;

fn is_same(a: &(DVec2, u32), b: &(DVec2, u32)) -> bool {
    a.1 == b.1 && a.0.distance(b.0) <= SAME * a.0.abs().max_element().max(1.0)
}

/// Whether a loop goes round a cylinder, so that it ends a whole turn from where it begins.
fn winds(carrier: &Carrier, polygon: &[(DVec2, u32)]) -> bool {
    matches!(carrier, Carrier::Cylinder(_))
        && polygon.first().zip(polygon.last()).is_some_and(|(first, last)| (last.0.x - first.0.x).abs() > PI)
}

/// Two loops round a cylinder as one polygon, cut open along a line between them.
/// ```text
/// b begins  <------  b ends      The line on the left and that on the right are one in space: their ends are the
///      |                ^        same nodes.
/// a begins  ------>  a ends
/// ```
fn joined(a: &[(DVec2, u32)], b: &[(DVec2, u32)]) -> Polygon {
    let (start, end) = (a[0].0.x, a[a.len() - 1].0.x);
    // b without its repeated end, turned round to begin as near as it can to where a ends
    let mut ring = b[..b.len() - 1].to_vec();
    let turn = TAU.copysign(end - start);
    let off = |&k: &usize| ((ring[k].0.x - end) / TAU - ((ring[k].0.x - end) / TAU).round()).abs();
    let first = (0..ring.len()).min_by(|i, j| off(i).total_cmp(&off(j))).unwrap_or(0);
    for (uv, _) in &mut ring[..first] {
        uv.x -= turn;
    }
    ring.rotate_left(first);
    let shift = TAU * ((end - ring[0].0.x) / TAU).round();
    ring.iter_mut().for_each(|(uv, _)| uv.x += shift);
    let (uv, node) = ring[0];
    ring.push((uv - DVec2::new(turn, 0.0), node));
    a.iter().copied().chain(ring).collect()
}

/// Factors that make both parameters count as in space, from samples over a rectangle.
fn stretch(carrier: &Carrier, min: DVec2, max: DVec2) -> DVec2 {
    const SAMPLES: usize = 9;
    let size = (max - min).max(DVec2::splat(f64::MIN_POSITIVE));
    let shares = (0..SAMPLES * SAMPLES).map(|k| DVec2::new((k / SAMPLES) as f64, (k % SAMPLES) as f64));
    let places: Vec<DVec2> =
        shares.map(|share| carrier.clamp(min + share / (SAMPLES - 1) as f64 * (max - min))).collect();
    let mut rows = vec![0.0; 9 * places.len()];
    carrier.eval_rows(&places, 1, &mut rows);
    let speed = rows.chunks_exact(9).fold(DVec2::ZERO, |sum, row| {
        sum + DVec2::new(DVec3::from_slice(&row[3..]).length(), DVec3::from_slice(&row[6..]).length())
    });
    let lengths = speed * size;
    // a direction in which nothing moves still needs room in the plane
    let least = 1e-3 * lengths.max_element().max(f64::MIN_POSITIVE);
    lengths.max(DVec2::splat(least)) / size / places.len() as f64
}

#[cfg(test)]
mod tests {
    use super::super::of_parts;
    use super::super::shapes::{
        PIPE_HEIGHT, PIPE_RADIUS, circle, hollow_cube, pipe, rectangle, torus_piece, trimmed, wave,
    };
    use super::*;

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
