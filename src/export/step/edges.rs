//! Loops cut into edges: at corners, and so that no edge begins and ends at the same vertex.

use super::StepError;
use super::image::{Image, image, points};
use crate::surface::Surface;
use crate::surface::tensor::TensorSurface;
use glam::{DVec2, DVec3};

/// A turn of the image by more than this is a corner: below 45 degrees, the corner of an octagon, and above the
/// turns of a round hole drawn with a dozen points. More corners only make more edges.
const CORNER_DEGREES: f64 = 40.0;

/// A part of a loop between two vertices.
#[derive(Debug)]
pub(super) struct Edge {
    pub image: Image,
    /// Numbers of the vertices.
    pub start: usize,
    pub end: usize,
}

/// The bounds of a face.
#[derive(Debug)]
pub(super) struct Boundary {
    pub vertices: Vec<DVec3>,
    /// The outer one first.
    pub loops: Vec<Vec<Edge>>,
}

impl Boundary {
    /// The images of directed loops in the parameter plane.
    pub fn new(surface: &TensorSurface, loops: &[Vec<DVec2>], tolerance: f64) -> Result<Self, StepError> {
        let mut boundary = Self { vertices: Vec::new(), loops: Vec::new() };
        for (index, polyline) in loops.iter().enumerate() {
            boundary.add(surface, index, polyline, tolerance)?;
        }
        Ok(boundary)
    }

    /// A side of the domain that is one point in space, a pole, has no edge: its neighbours share a vertex.
    fn add(
        &mut self,
        surface: &TensorSurface,
        index: usize,
        polyline: &[DVec2],
        tolerance: f64,
    ) -> Result<(), StepError> {
        let starts = starts(surface, polyline);
        let mut images = Vec::with_capacity(starts.len());
        for (k, &from) in starts.iter().enumerate() {
            let part = part(polyline, from, starts[(k + 1) % starts.len()]);
            let image = image(surface, &part, tolerance)?;
            if extent(&image) > tolerance {
                images.push(image);
            }
        }
        if images.is_empty() {
            return Err(StepError::Collapsed { index });
        }
        let (first, count) = (self.vertices.len(), images.len());
        self.vertices.extend(images.iter().map(|image| DVec3::from_slice(image.curve.control_points())));
        let edge = |(k, image)| Edge { image, start: first + k, end: first + (k + 1) % count };
        self.loops.push(images.into_iter().enumerate().map(edge).collect());
        Ok(())
    }

    /// All edges.
    pub fn edges(&self) -> impl Iterator<Item = &Edge> {
        self.loops.iter().flatten()
    }

    /// Largest distance between an edge's curves, and between its ends and its vertices.
    pub fn deviation(&self) -> f64 {
        let deviation = |edge: &Edge| {
            let points = edge.image.curve.control_points();
            let end = DVec3::from_slice(&points[points.len() - 3..]);
            edge.image.deviation.max(end.distance(self.vertices[edge.end]))
        };
        self.edges().map(deviation).fold(0.0, f64::max)
    }
}

/// How far an edge gets from where it begins.
fn extent(image: &Image) -> f64 {
    let points = image.curve.control_points();
    let start = DVec3::from_slice(points);
    points.chunks_exact(3).map(|point| start.distance(DVec3::from_slice(point))).fold(0.0, f64::max)
}

/// The points of a loop from one of them to another.
fn part(polyline: &[DVec2], from: usize, to: usize) -> Vec<DVec2> {
    let count = (to + polyline.len() - from - 1) % polyline.len() + 1;
    (0..=count).map(|k| polyline[(from + k) % polyline.len()]).collect()
}

/// Where edges begin: at the corners, and if there are fewer than two, also half way round.
fn starts(surface: &TensorSurface, polyline: &[DVec2]) -> Vec<usize> {
    let mut starts = corners(surface, polyline);
    if starts.len() < 2 {
        let first = starts.first().copied().unwrap_or(0);
        starts = vec![first, half_way(&points(surface, polyline), first)];
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

/// The points at which the image of a closed polyline turns sharply.
fn corners(surface: &TensorSurface, polyline: &[DVec2]) -> Vec<usize> {
    let count = polyline.len();
    let mut rows = vec![0.0; 9 * count];
    surface.eval_rows(polyline, 1, &mut rows);
    let least_cosine = CORNER_DEGREES.to_radians().cos();
    (0..count)
        .filter(|&k| {
            let [su, sv] = [3, 6].map(|column| DVec3::from_slice(&rows[9 * k + column..]));
            let tangent = |side: DVec2| (su * side.x + sv * side.y).normalize_or_zero();
            let before = tangent(polyline[k] - polyline[(k + count - 1) % count]);
            let after = tangent(polyline[(k + 1) % count] - polyline[k]);
            before.dot(after) < least_cosine
        })
        .collect()
}
