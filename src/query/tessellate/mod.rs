//! Triangle meshes of surfaces, with trims kept.
//!
//! A surface over triangles is divided along with them (`bisect`). For the others, a
//! constrained Delaunay triangulation in the parameter plane (stretched so that both parameters count alike
//! in space) starts from the trims and a grid as coarse as the surface's patches; then the middles of all
//! edges that are too long or too far from the surface become nodes, until none is left.

mod bisect;
mod error;
pub(super) mod subdivide;
mod tessellation;

pub use error::TessellateError;
pub use tessellation::Tessellation;

use crate::control::Watch;
use crate::memory::{self, CollectVec};
use crate::mesh::Mesh;
use crate::options::with_fields;
use crate::surface::Surface;
use bisect::{Fineness, tessellate_facets};
use glam::{DVec2, DVec3};
use spade::handles::{FixedVertexHandle, UndirectedEdgeHandle};
use spade::{CdtEdge, ConstrainedDelaunayTriangulation, Point2, Triangulation, mitigate_underflow};
pub(crate) use tessellation::{distance_to_segment, least_angle};

pub use bisect::CHORD_SHARE;

/// How fine a tessellation is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TessellateOptions {
    /// Largest distance between the surface and its triangles, in model units; 0 takes [`CHORD_SHARE`] of the diagonal.
    pub chord_tolerance: f64,
    /// Longest edge in model units; 0 for no limit.
    pub max_edge_length: f64,
    /// Most nodes; beyond it the call fails.
    pub max_points: usize,
    /// Whether to keep to the trims; otherwise the whole domain is covered.
    pub keep_trims: bool,
}

impl Default for TessellateOptions {
    fn default() -> Self {
        Self { chord_tolerance: 0.0, max_edge_length: 0.0, max_points: 4_000_000, keep_trims: true }
    }
}

impl TessellateOptions {
    with_fields! {
        with_chord_tolerance chord_tolerance: f64,
        with_max_edge_length max_edge_length: f64,
        with_max_points max_points: usize,
        with_keep_trims keep_trims: bool,
    }

    /// Refuses lengths that are none.
    pub fn check(&self) -> Result<(), TessellateError> {
        for (option, value) in
            [("chord_tolerance", self.chord_tolerance), ("max_edge_length", self.max_edge_length)]
        {
            if !(value >= 0.0 && value.is_finite()) {
                return Err(TessellateError::Option { option, value });
            }
        }
        Ok(())
    }
}

/// Triangulates the part of a surface inside its trims.
pub fn tessellate(
    surface: &dyn Surface,
    options: &TessellateOptions,
) -> Result<Tessellation, TessellateError> {
    tessellate_watched(surface, options, &Watch::default())
}

/// The same as a part of a call that may be cancelled.
pub fn tessellate_watched(
    surface: &dyn Surface,
    options: &TessellateOptions,
    watch: &Watch,
) -> Result<Tessellation, TessellateError> {
    if surface.dim() != 3 {
        return Err(TessellateError::Dimension { dim: surface.dim() });
    }
    options.check()?;
    if let Some(facets) = surface.facets()
        && (!options.keep_trims || facets.has_own_trims())
    {
        let TessellateOptions { chord_tolerance, max_edge_length, max_points, .. } = *options;
        return tessellate_facets(
            facets.as_ref(),
            &Fineness { chord_tolerance, max_edge_length, max_points },
            watch,
        );
    }
    let mut plane = Plane::new(surface, options, watch)?;
    plane.add_frame()?;
    plane.add_trims()?;
    plane.add_grid()?;
    plane.refine()?;
    plane.finish()
}

/// A direction in which nothing moves, against the other: it still needs room in the plane.
const LEAST_STRETCH: f64 = 1e-3;
/// Grid lines along one direction at the start; patches are found by refinement.
const START_LINES: usize = 9;
/// An edge is not halved once it is this short against the domain: a fold or pole of the surface would go on
/// for ever.
const SHORTEST_EDGE: f64 = 1e-7;

type Edge<'a> = UndirectedEdgeHandle<'a, Point2<f64>, (), CdtEdge<()>, ()>;

struct Plane<'a> {
    surface: &'a dyn Surface,
    options: &'a TessellateOptions,
    watch: &'a Watch,
    chord_tolerance: f64,
    /// From (u,v) to the stretched plane of the triangulation.
    stretch: DVec2,
    triangulation: ConstrainedDelaunayTriangulation<Point2<f64>>,
    /// By vertex, as far as they have been asked for.
    points: Vec<Option<DVec3>>,
    chord_error: f64,
    /// Vertices beyond the domain that belong to no triangle of the surface.
    frame: Vec<FixedVertexHandle>,
}

impl<'a> Plane<'a> {
    fn new(
        surface: &'a dyn Surface,
        options: &'a TessellateOptions,
        watch: &'a Watch,
    ) -> Result<Self, TessellateError> {
        let probe = Probe::new(surface);
        let chord_tolerance = if options.chord_tolerance > 0.0 {
            options.chord_tolerance
        } else {
            CHORD_SHARE * probe.diagonal
        };
        Ok(Self {
            surface,
            options,
            watch,
            chord_tolerance,
            stretch: probe.stretch,
            triangulation: ConstrainedDelaunayTriangulation::new(),
            points: Vec::new(),
            chord_error: 0.0,
            frame: Vec::new(),
        })
    }

    fn uv(&self, place: Point2<f64>) -> DVec2 {
        self.surface.domain().clamp(DVec2::new(place.x, place.y) / self.stretch)
    }

    fn insert(&mut self, uv: DVec2) -> Result<FixedVertexHandle, TessellateError> {
        self.watch.check()?;
        let place = uv * self.stretch;
        let crossing = TessellateError::CrossingTrims { u: uv.x, v: uv.y };
        let place = mitigate_underflow(Point2::new(place.x, place.y));
        let vertex = self.triangulation.insert(place).map_err(|_| crossing)?;
        if self.triangulation.num_vertices() > self.options.max_points {
            return Err(TessellateError::TooLarge { limit: self.options.max_points });
        }
        Ok(vertex)
    }

    /// Whether trims bound the surface.
    fn has_trims(&self) -> bool {
        self.options.keep_trims && !self.surface.region().trims.is_empty()
    }

    /// Puts trims inside a larger rectangle. A side on the hull of the triangulation could not be halved: a
    /// middle that rounding has moved inwards would leave it there, with a sliver behind it, for ever.
    fn add_frame(&mut self) -> Result<(), TessellateError> {
        if self.has_trims() {
            let domain = self.surface.domain();
            for (u, v) in [(-1.0, -1.0), (2.0, -1.0), (2.0, 2.0), (-1.0, 2.0)] {
                let corner = self.insert(domain.min + DVec2::new(u, v) * domain.size())?;
                memory::push(&mut self.frame, corner);
            }
        }
        Ok(())
    }

    fn add_trims(&mut self) -> Result<(), TessellateError> {
        let loops = if self.options.keep_trims { self.surface.region().trims.loops() } else { &[] };
        for polyline in loops {
            let vertices: Vec<FixedVertexHandle> =
                polyline.iter().map(|&uv| self.insert(uv)).collect::<Result<_, _>>()?;
            for (k, &from) in vertices.iter().enumerate() {
                let to = vertices[(k + 1) % vertices.len()];
                if from == to {
                    continue;
                }
                if !self.triangulation.can_add_constraint(from, to) {
                    let DVec2 { x: u, y: v } = polyline[k];
                    return Err(TessellateError::CrossingTrims { u, v });
                }
                self.triangulation.add_constraint(from, to);
            }
        }
        Ok(())
    }

    fn add_grid(&mut self) -> Result<(), TessellateError> {
        let domain = self.surface.domain();
        let trims = &self.surface.region().trims;
        let keeps_trims = self.has_trims();
        for i in 0..START_LINES {
            for j in 0..START_LINES {
                let share = DVec2::new(i as f64, j as f64) / (START_LINES - 1) as f64;
                let uv = domain.min + share * domain.size();
                if !keeps_trims || trims.contains(uv) {
                    self.insert(uv)?;
                }
            }
        }
        Ok(())
    }

    /// Whether a triangle belongs to the surface.
    fn is_kept(&self, middle: DVec2) -> bool {
        !self.options.keep_trims || self.surface.region().trims.contains(middle)
    }

    fn point(&mut self, vertex: FixedVertexHandle) -> DVec3 {
        let uv = self.uv(self.triangulation.vertex(vertex).position());
        let number = vertex.index();
        while self.points.len() <= number {
            memory::push(&mut self.points, None);
        }
        *self.points[number].get_or_insert_with(|| eval(self.surface, uv))
    }

    /// Halves edges until none needs it.
    ///
    /// A new edge ends in a new vertex: those between older ones are measured once, and all at the end.
    fn refine(&mut self) -> Result<(), TessellateError> {
        let mut oldest = 0;
        loop {
            let before = self.triangulation.num_vertices();
            self.halve_edges(oldest)?;
            // middles that are all nodes already would come again in every further round
            let has_new = self.triangulation.num_vertices() > before;
            if !has_new && oldest == 0 {
                return Ok(());
            }
            oldest = if has_new { before } else { 0 };
        }
    }

    /// Halves all edges that need it with an end among the vertices from a number on.
    fn halve_edges(&mut self, oldest: usize) -> Result<(), TessellateError> {
        let mut edges = Vec::new();
        for (k, edge) in self.triangulation.undirected_edges().enumerate() {
            self.watch.check_at(k)?;
            let vertices = edge.vertices().map(|vertex| vertex.fix());
            if vertices.iter().any(|vertex| vertex.index() >= oldest) && self.may_be_halved(edge) {
                memory::push(&mut edges, vertices);
            }
        }
        let mut middles = Vec::new();
        self.chord_error = 0.0;
        for [a, b] in edges {
            self.watch.check()?;
            let (from, to) = (self.point(a), self.point(b));
            let place = |vertex| self.uv(self.triangulation.vertex(vertex).position());
            let uv = (place(a) + place(b)) / 2.0;
            let sag = distance_to_segment(eval(self.surface, uv), from, to);
            let longest = self.options.max_edge_length;
            if sag > self.chord_tolerance || (longest > 0.0 && from.distance(to) > longest) {
                memory::push(&mut middles, ([a, b], uv));
            }
            self.chord_error = self.chord_error.max(sag);
        }
        middles.into_iter().try_for_each(|(ends, uv)| self.halve(ends, uv))
    }

    /// Whether an edge is long enough and belongs to a triangle of the surface.
    fn may_be_halved(&self, edge: Edge<'_>) -> bool {
        let shortest = SHORTEST_EDGE * (self.surface.domain().size() * self.stretch).length();
        let directed = edge.as_directed();
        edge.length_2() > shortest * shortest
            && [directed.face(), directed.rev().face()].iter().any(|face| {
                face.as_inner().is_some_and(|face| {
                    let center = face.center();
                    !face.vertices().iter().any(|vertex| self.frame.contains(&vertex.fix()))
                        && self.is_kept(DVec2::new(center.x, center.y) / self.stretch)
                })
            })
    }

    /// Makes the middle of an edge a node.
    ///
    /// A side of a trim gives way to its two halves: rounding puts the middle beside the side, not on it, so
    /// that the side would stay whole and be halved at the same place in every further round.
    fn halve(&mut self, ends: [FixedVertexHandle; 2], uv: DVec2) -> Result<(), TessellateError> {
        let [a, b] = ends;
        let side = self.triangulation.get_edge_from_neighbors(a, b).filter(|edge| edge.is_constraint_edge());
        let Some(side) = side.map(|edge| edge.as_undirected().fix()) else {
            self.insert(uv)?;
            return Ok(());
        };
        self.triangulation.remove_constraint_edge(side);
        let middle = self.insert(uv)?;
        for (from, to) in [(a, middle), (middle, b)] {
            if !self.triangulation.can_add_constraint(from, to) {
                return Err(TessellateError::CrossingTrims { u: uv.x, v: uv.y });
            }
            self.triangulation.add_constraint(from, to);
        }
        Ok(())
    }

    fn finish(mut self) -> Result<Tessellation, TessellateError> {
        let mut numbers = memory::filled(None, self.triangulation.num_vertices());
        let (mut points, mut uvs, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
        let mut smallest_angle = f64::INFINITY;
        let faces: Vec<_> = self
            .triangulation
            .inner_faces()
            .map(|face| face.vertices().map(|vertex| vertex.fix()))
            .collect_vec();
        for face in faces {
            self.watch.check()?;
            if face.iter().any(|vertex| self.frame.contains(vertex)) {
                continue;
            }
            let place = face.map(|vertex| self.uv(self.triangulation.vertex(vertex).position()));
            if !self.is_kept(place.iter().sum::<DVec2>() / 3.0) {
                continue;
            }
            let corners = face.map(|vertex| self.point(vertex));
            smallest_angle = smallest_angle.min(least_angle(corners));
            let mut triangle = [0; 3];
            for k in 0..3 {
                triangle[k] = *numbers[face[k].index()].get_or_insert_with(|| {
                    memory::push(&mut points, corners[k]);
                    memory::push(&mut uvs, place[k]);
                    points.len() as u32 - 1
                });
            }
            memory::push(&mut triangles, triangle);
        }
        if triangles.is_empty() {
            return Err(TessellateError::Empty);
        }
        let mut mesh = Mesh::new(points, triangles)?;
        mesh.set_parameters(uvs)?;
        Ok(Tessellation { mesh, smallest_angle, chord_error: self.chord_error })
    }
}

/// What a few samples tell of a surface.
struct Probe {
    diagonal: f64,
    stretch: DVec2,
}

impl Probe {
    fn new(surface: &dyn Surface) -> Self {
        let domain = surface.domain();
        let (mut min, mut max) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let mut speed = DVec2::ZERO;
        for i in 0..START_LINES {
            for j in 0..START_LINES {
                let share = DVec2::new(i as f64, j as f64) / (START_LINES - 1) as f64;
                let mut row = [0.0; 9];
                surface.eval_rows(&[domain.min + share * domain.size()], 1, &mut row);
                let [s, su, sv] = [0, 3, 6].map(|k| DVec3::from_slice(&row[k..]));
                (min, max) = (min.min(s), max.max(s));
                speed += DVec2::new(su.length(), sv.length());
            }
        }
        let lengths = speed * domain.size();
        let least = LEAST_STRETCH * lengths.max_element().max(f64::MIN_POSITIVE);
        Self { diagonal: min.distance(max), stretch: lengths.max(DVec2::splat(least)) / domain.size() }
    }
}

fn eval(surface: &dyn Surface, uv: DVec2) -> DVec3 {
    let mut point = [0.0; 3];
    surface.eval_rows(&[uv], 0, &mut point);
    DVec3::from_array(point)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::knots::KnotVector;
    use crate::surface::Trims;
    use crate::surface::tensor::TensorSurface;
    use std::f64::consts::PI;

    /// Polynomial wave `z = u (1 - u) v` times `height` over the unit square.
    fn wave(height: f64) -> TensorSurface {
        let knots = || KnotVector::clamped(&[0.0, 1.0], 2).unwrap();
        let (x, z) = ([0.0, 0.5, 1.0], [0.0, 0.5, 0.0]);
        let points = (0..9).flat_map(|k| [x[k / 3], x[k % 3], height * z[k / 3] * x[k % 3]]).collect();
        TensorSurface::new(3, knots(), knots(), points, None).unwrap()
    }

    fn area(mesh: &Mesh) -> f64 {
        let corners = |t: &[u32; 3]| t.map(|n| mesh.points()[n as usize]);
        mesh.triangles().iter().map(corners).map(|[a, b, c]| (b - a).cross(c - a).length() / 2.0).sum()
    }

    #[test]
    fn triangles_keep_the_chord_tolerance_and_the_edge_length() {
        for chord_tolerance in [1e-2, 1e-3, 1e-4] {
            let options =
                TessellateOptions { chord_tolerance, max_edge_length: 0.2, ..TessellateOptions::default() };
            let surface = wave(1.0);
            let result = tessellate(&surface, &options).unwrap();
            assert!(result.chord_error <= chord_tolerance);
            let mesh = &result.mesh;
            assert_eq!(mesh.loops().len(), 1);
            for triangle in mesh.triangles() {
                for k in 0..3 {
                    let [a, b] = [triangle[k], triangle[(k + 1) % 3]].map(|n| mesh.points()[n as usize]);
                    assert!(a.distance(b) <= 0.2 + 1e-12);
                }
            }
            for (p, uv) in mesh.points().iter().zip(mesh.parameters().unwrap()) {
                assert_eq!(*p, eval(&surface, *uv));
            }
        }
    }

    #[test]
    fn trims_cut_holes() {
        let mut surface = wave(0.0);
        let circle = |radius: f64, count: usize| -> Vec<DVec2> {
            (0..count)
                .map(|k| DVec2::splat(0.5) + radius * DVec2::from_angle(2.0 * PI * k as f64 / count as f64))
                .collect()
        };
        let loops = vec![circle(0.45, 40), circle(0.2, 20)];
        surface.region_mut().trims = Trims::new(loops, &surface.domain()).unwrap();
        let options = TessellateOptions { max_edge_length: 0.08, ..TessellateOptions::default() };
        let mesh = tessellate(&surface, &options).unwrap().mesh;
        assert_eq!((mesh.loops().len(), mesh.component_count()), (2, 1));
        let polygon = |radius: f64, n: f64| 0.5 * n * radius * radius * (2.0 * PI / n).sin();
        let exact = polygon(0.45, 40.0) - polygon(0.2, 20.0);
        assert!((area(&mesh) - exact).abs() < 1e-12, "{} is not {exact}", area(&mesh));
        let whole = TessellateOptions { keep_trims: false, ..options };
        assert!((area(&tessellate(&surface, &whole).unwrap().mesh) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn long_slanted_sides_of_trims_are_halved() {
        let mut surface = wave(1.0);
        let slanted = [(0.0, 0.0), (1.0, 0.1), (0.7, 0.9), (0.3, 1.0)].map(|(u, v)| DVec2::new(u, v));
        surface.region_mut().trims = Trims::new(vec![slanted.to_vec()], &surface.domain()).unwrap();
        let options = TessellateOptions { chord_tolerance: 1e-4, ..TessellateOptions::default() };
        let result = tessellate(&surface, &options).unwrap();
        assert!(result.chord_error <= 1e-4);
        assert_eq!(result.mesh.loops().len(), 1);
        assert!(result.mesh.loops()[0].len() > 50, "{} nodes", result.mesh.loops()[0].len());
    }

    #[test]
    fn refusals_say_what_is_wrong() {
        let few = TessellateOptions { max_edge_length: 1e-3, max_points: 1000, ..Default::default() };
        assert_eq!(tessellate(&wave(1.0), &few).unwrap_err(), TessellateError::TooLarge { limit: 1000 });
        let mut surface = wave(0.0);
        let bow = [(0.1, 0.1), (0.9, 0.9), (0.9, 0.1), (0.1, 0.9)].map(|(u, v)| DVec2::new(u, v));
        surface.region_mut().trims = Trims::new(vec![bow.to_vec()], &surface.domain()).unwrap();
        let error = tessellate(&surface, &TessellateOptions::default()).unwrap_err();
        assert!(matches!(error, TessellateError::CrossingTrims { .. }), "{error}");
    }
}
