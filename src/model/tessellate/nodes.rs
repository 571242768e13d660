//! Nodes and triangles: those on edges first, which the faces on both sides share.

use super::ModelTessellation;
use crate::mesh::Mesh;
use crate::model::{Edge, FaceId, Model};
use crate::query::tessellate::{TessellateError, TessellateOptions, distance_to_segment};
use glam::{DVec2, DVec3};

/// Halvings of an edge: its pieces are then as short as rounding lets them be told apart.
const MAX_DEPTH: u32 = 30;

/// Nodes and triangles of all faces so far.
pub(super) struct Nodes {
    pub points: Vec<DVec3>,
    pub triangles: Vec<[u32; 3]>,
    pub faces: Vec<FaceId>,
    pub places: Vec<[DVec2; 3]>,
    /// Parameters and nodes along each edge.
    pub edges: Vec<(Vec<f64>, Vec<u32>)>,
    pub smallest_angle: f64,
    pub chord_error: f64,
}

impl Nodes {
    /// With the nodes of all edges.
    pub(super) fn new(
        model: &Model,
        chords: &[f64],
        options: &TessellateOptions,
    ) -> Result<Self, TessellateError> {
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

    pub(super) fn check(&self, options: &TessellateOptions) -> Result<(), TessellateError> {
        let limit = options.max_points;
        if self.points.len() > limit { Err(TessellateError::TooLarge { limit }) } else { Ok(()) }
    }

    pub(super) fn finish(self) -> Result<ModelTessellation, TessellateError> {
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
