//! A face as a constrained Delaunay triangulation in the plane of its parameters, stretched so that both count alike in space.

use super::inside::Inside;
use super::nodes::Nodes;
use super::polygons::{Polygon, polygons};
use crate::geometry::Axis;
use crate::model::{Carrier, FaceId, Model};
use crate::query::tessellate::{TessellateError, TessellateOptions, distance_to_segment, least_angle};
use crate::surface::Patches;
use glam::{DVec2, DVec3};
use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation, mitigate_underflow};
use std::collections::HashMap;

/// Sides are not halved any more once they are this short against the face: a fold or pole would go on for ever.
const SHORTEST_SIDE: f64 = 1e-7;
/// Least height of a triangle over a side of the bound, as a share of that side.
const LEAST_HEIGHT: f64 = 0.05;
/// Most lines in each direction on whose crossings first nodes are set: where patches are, features may be.
const START_LINES: usize = 17;

/// A face in the stretched plane.
pub(super) struct FacePlane<'a> {
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
    pub(super) fn new(
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

    fn add_bounds(&mut self, loops: &[Polygon], nodes: &Nodes) -> Result<(), TessellateError> {
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
    pub(super) fn refined(mut self) -> Result<Self, TessellateError> {
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
    pub(super) fn finish(mut self, nodes: &mut Nodes) {
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

/// The middles of spans, of about as many as [`START_LINES`] if there are more.
fn middles(breaks: &[f64]) -> Vec<f64> {
    let count = breaks.len() - 1;
    let step = count.div_ceil(START_LINES);
    breaks.windows(2).skip(step / 2).step_by(step).map(|span| 0.5 * (span[0] + span[1])).collect()
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
