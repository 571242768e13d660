//! A shell: edges with their curves in space, each written once, and the faces beside them.

use super::StepError;
use super::image::{Image, deviation, image, points};
use super::layout::{Layout, PlaneEdge, Side, Trim, cut};
use super::tiling::Tiling;
use crate::surface::Surface;
use crate::surface::tensor::TensorSurface;
use glam::{DVec2, DVec3};

/// A turn of the image by more than this is a corner: below 45 degrees, the corner of an octagon, and above the
/// turns of a round hole drawn with a dozen points. More corners only make more edges.
const CORNER_DEGREES: f64 = 40.0;

/// A curve between two vertices.
#[derive(Debug)]
pub(super) struct Edge {
    pub image: Image,
    /// Numbers of the vertices.
    pub start: usize,
    pub end: usize,
    /// The surfaces on its left and right.
    pub surfaces: Vec<usize>,
}

/// A part of a surface.
#[derive(Debug)]
pub(super) struct Face {
    pub surface: usize,
    /// The outer one first.
    pub bounds: Vec<Vec<Side>>,
}

/// Faces that share edges.
#[derive(Debug)]
pub(super) struct Shell {
    pub vertices: Vec<DVec3>,
    pub edges: Vec<Edge>,
    pub faces: Vec<Face>,
    /// Largest distance between an edge's curve and the images of its p-curve on all surfaces beside it, and
    /// between its ends and its vertices.
    pub deviation: f64,
}

impl Shell {
    /// Surfaces over rectangles that fill a domain, inside directed loops.
    pub fn new(surfaces: &[&TensorSurface], loops: &[Vec<DVec2>], tolerance: f64) -> Result<Self, StepError> {
        let tiling = Tiling::new(surfaces.iter().map(|surface| surface.domain()).collect());
        let trims = cut(loops, &tiling);
        if let Some(index) = trims.iter().position(|trim| trim.points.len() < 3) {
            return Err(StepError::Collapsed { index });
        }
        let starts: Vec<Vec<usize>> = trims.iter().map(|trim| starts(surfaces, trim)).collect();
        let layout = Layout::new(&tiling, &trims, &starts);
        let mut images = Vec::with_capacity(layout.edges.len());
        for edge in &layout.edges {
            let image = image(surfaces[edge.left], &edge.polyline, tolerance)?;
            images.push((extent(&image) > tolerance).then_some(image));
        }
        for trim in 0..trims.len() {
            let mut edges = layout.edges.iter().zip(&images).filter(|(edge, _)| edge.trim == Some(trim));
            if edges.all(|(_, image)| image.is_none()) {
                return Err(StepError::Collapsed { index: trim });
            }
        }
        Ok(Self::assemble(surfaces, layout, images))
    }

    /// The surfaces with faces, in order.
    pub fn surfaces(&self) -> impl Iterator<Item = usize> {
        self.faces.chunk_by(|a, b| a.surface == b.surface).map(|faces| faces[0].surface)
    }

    /// Edges that are points in space, such as the side of a domain at a pole, are left out, and their ends are
    /// one vertex.
    fn assemble(surfaces: &[&TensorSurface], layout: Layout, images: Vec<Option<Image>>) -> Self {
        let mut vertices = Vertices::new(&layout.edges, &images);
        let mut shell = Self { vertices: Vec::new(), edges: Vec::new(), faces: Vec::new(), deviation: 0.0 };
        let mut numbers = Vec::with_capacity(images.len());
        for (plane, image) in layout.edges.iter().zip(images) {
            numbers.push(image.map(|image| {
                let surfaces = [Some(plane.left), plane.right].into_iter().flatten().collect();
                let [start, end] = plane.ends.map(|node| vertices.number(node));
                shell.edges.push(Edge { image, start, end, surfaces });
                shell.edges.len() - 1
            }));
        }
        for face in layout.faces {
            let kept = |side: &Side| Some(Side { edge: numbers[side.edge]?, ..*side });
            let bounds = face.bounds.iter().map(|bound| bound.iter().filter_map(kept).collect::<Vec<_>>());
            let bounds: Vec<Vec<Side>> = bounds.filter(|bound| !bound.is_empty()).collect();
            if !bounds.is_empty() {
                shell.faces.push(Face { surface: face.rectangle, bounds });
            }
        }
        shell.vertices = vec![DVec3::NAN; vertices.count];
        for edge in &shell.edges {
            let [start, end] = edge.image.ends();
            for (vertex, place) in [(edge.end, end), (edge.start, start)] {
                if shell.vertices[vertex].is_nan() {
                    shell.vertices[vertex] = place;
                }
            }
        }
        let off = |edge: &Edge| shell.deviation_of(surfaces, edge);
        shell.deviation = shell.edges.iter().map(off).fold(0.0, f64::max);
        shell
    }

    fn deviation_of(&self, surfaces: &[&TensorSurface], edge: &Edge) -> f64 {
        let [start, end] = edge.image.ends();
        let at_ends = start.distance(self.vertices[edge.start]).max(end.distance(self.vertices[edge.end]));
        let beside = edge.surfaces.iter().map(|&k| deviation(surfaces[k], &edge.image));
        beside.fold(at_ends, f64::max)
    }
}

/// Vertices for the ends of edges, one for all ends that are joined by edges without length.
struct Vertices {
    /// An end nearer to the one that stands for all.
    parent: Vec<usize>,
    number: Vec<Option<usize>>,
    count: usize,
}

impl Vertices {
    fn new(edges: &[PlaneEdge], images: &[Option<Image>]) -> Self {
        let count = edges.iter().flat_map(|edge| edge.ends).max().map_or(0, |last| last + 1);
        let mut vertices = Self { parent: (0..count).collect(), number: vec![None; count], count: 0 };
        for (edge, _) in edges.iter().zip(images).filter(|(_, image)| image.is_none()) {
            let [a, b] = edge.ends.map(|end| vertices.root(end));
            vertices.parent[b] = a;
        }
        vertices
    }

    fn root(&self, mut end: usize) -> usize {
        while self.parent[end] != end {
            end = self.parent[end];
        }
        end
    }

    fn number(&mut self, end: usize) -> usize {
        let root = self.root(end);
        *self.number[root].get_or_insert_with(|| {
            self.count += 1;
            self.count - 1
        })
    }
}

/// How far an edge gets from where it begins.
fn extent(image: &Image) -> f64 {
    let points = image.curve.control_points();
    let start = DVec3::from_slice(points);
    points.chunks_exact(3).map(|point| start.distance(DVec3::from_slice(point))).fold(0.0, f64::max)
}

/// Where edges begin: at the corners, and if there are fewer than two, also half way round.
fn starts(surfaces: &[&TensorSurface], trim: &Trim) -> Vec<usize> {
    let count = trim.points.len();
    let mut starts: Vec<usize> = (0..count).filter(|&k| is_corner(surfaces, trim, k)).collect();
    if starts.len() < 2 {
        let first = starts.first().copied().unwrap_or(0);
        let place = |k: usize| points(surfaces[trim.left[k]], &trim.points[k..=k])[0];
        starts = vec![first, half_way(&(0..count).map(place).collect::<Vec<_>>(), first)];
        starts.sort_unstable();
    }
    starts
}

/// The point of a closed polyline that is most nearly half its length away from another.
fn half_way(points: &[DVec3], first: usize) -> usize {
    let count = points.len();
    let mut along = 0.0;
    let lengths: Vec<f64> = (0..count)
        .map(|k| {
            along += points[(first + k) % count].distance(points[(first + k + 1) % count]);
            along
        })
        .collect();
    let from_half = |k: &usize| (lengths[*k] - 0.5 * along).abs();
    let nearest = (0..count - 1).min_by(|a, b| from_half(a).total_cmp(&from_half(b))).unwrap_or(0);
    (first + nearest + 1) % count
}

/// Whether the image of a trim turns sharply at a point.
fn is_corner(surfaces: &[&TensorSurface], trim: &Trim, k: usize) -> bool {
    let count = trim.points.len();
    let tangent = |from: usize, to: usize, side: usize| {
        let mut row = [0.0; 9];
        surfaces[trim.left[side]].eval_rows(&trim.points[k..=k], 1, &mut row);
        let along = trim.points[to] - trim.points[from];
        let [su, sv] = [3, 6].map(|column| DVec3::from_slice(&row[column..]));
        (su * along.x + sv * along.y).normalize_or_zero()
    };
    let before = (k + count - 1) % count;
    let turn = tangent(before, k, before).dot(tangent(k, (k + 1) % count, k));
    turn < CORNER_DEGREES.to_radians().cos()
}
