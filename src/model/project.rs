//! The places of a model nearest to points: globally, over all faces.
//!
//! Faces lie in a binary tree of boxes, of which the nearer half is searched first and what cannot be nearer is left out. On
//! splines the search is that
//! of [`query::project`](crate::query::project). On planes and cylinders the foot is exact: it counts if it lies inside
//! the loops, else the nearest place of an edge does.

use super::{Carrier, EdgeCurve, Face, FaceId, Model, Use};
use crate::control::Pool;
use crate::query::project::{FLAG_NOT_PROVEN, ProjectError, ProjectOptions, Projector};
use crate::surface::Surface;
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Nearest places.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ModelFeet {
    /// The face of each; none for points farther away than [`ProjectOptions::max_distance`].
    pub faces: Vec<Option<FaceId>>,
    /// Their parameters on the surface of the face; NaN for the same points.
    pub uv: Vec<DVec2>,
    /// Their distances; NaN for the same points.
    pub distances: Vec<f64>,
    /// [`FLAG_NOT_PROVEN`] where a search ended without a proof.
    pub flags: Vec<u8>,
}

impl ModelFeet {
    /// Points whose answer is not proved to be the nearest.
    pub fn unproven(&self) -> usize {
        self.flags.iter().filter(|&flags| flags & FLAG_NOT_PROVEN != 0).count()
    }
}

/// Projects points onto one model. It holds all it needs of that.
#[derive(Debug)]
pub struct ModelProjector {
    faces: Vec<FaceFeet>,
    /// The root first, each first child behind its parent.
    tree: Vec<TreeNode>,
}

/// A box around some faces.
#[derive(Debug)]
struct TreeNode {
    min: DVec3,
    max: DVec3,
    /// The second child, or the face of a leaf.
    below: Below,
}

#[derive(Debug, Clone, Copy)]
enum Below {
    Face(usize),
    Second(usize),
}

impl TreeNode {
    fn distance(&self, point: DVec3) -> f64 {
        point.distance(point.clamp(self.min, self.max))
    }
}

/// Adds the tree over some faces: halves by the middles of their boxes along the longest extent of these.
fn add_tree(faces: &[FaceFeet], order: &mut [usize], tree: &mut Vec<TreeNode>) {
    let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let join = |(min, max): (DVec3, DVec3), (a, b): (DVec3, DVec3)| (min.min(a), max.max(b));
    let (min, max) = order.iter().map(|&face| (faces[face].min, faces[face].max)).fold(start, join);
    let node = tree.len();
    tree.push(TreeNode { min, max, below: Below::Face(order[0]) });
    if order.len() == 1 {
        return;
    }
    let middle = |face: usize| faces[face].min + faces[face].max;
    let (least, most) = order.iter().map(|&face| (middle(face), middle(face))).fold(start, join);
    let axis = (most - least).max_position();
    let half = order.len() / 2;
    order.select_nth_unstable_by(half, |&a, &b| middle(a)[axis].total_cmp(&middle(b)[axis]).then(a.cmp(&b)));
    let (low, high) = order.split_at_mut(half);
    add_tree(faces, low, tree);
    tree[node].below = Below::Second(tree.len());
    add_tree(faces, high, tree);
}

/// The nearest place on a face.
struct Foot {
    uv: DVec2,
    distance: f64,
    is_proven: bool,
}

/// The nearest place of a model.
struct ModelFoot {
    face: Option<FaceId>,
    uv: DVec2,
    distance: f64,
    is_proven: bool,
}

/// Points of one piece of work. Pieces do not depend on the number of threads.
const CHUNK: usize = 64;

/// A face with a box around it.
#[derive(Debug)]
struct FaceFeet {
    min: DVec3,
    max: DVec3,
    feet: Feet,
}

#[derive(Debug)]
#[allow(clippy::large_enum_variant, reason = "one for each face: some hundred bytes do not matter")]
enum Feet {
    Spline(Projector),
    Exact { carrier: Carrier, bound: Bound },
}

/// The loops of a face on a plane or cylinder.
#[derive(Debug)]
struct Bound {
    sides: Vec<Side>,
    /// Pieces of the loops in the parameter plane.
    segments: Vec<[DVec2; 2]>,
    /// How far those are from the edges at most, in space.
    chord_error: f64,
    is_periodic: bool,
}

#[derive(Debug)]
struct Side {
    curve: EdgeCurve,
    /// Onto a spline that is the curve or very near to it.
    projector: Projector,
    /// Whether the face is on its left.
    is_forward: bool,
}

impl ModelProjector {
    /// Builds what searches need: time and memory are proportional to the patches and edges.
    pub fn new(model: &Model) -> Result<Self, ProjectError> {
        let faces = model.face_ids().map(|face| face_feet(model, face)).collect::<Result<Vec<_>, _>>()?;
        let (mut order, mut tree) = ((0..faces.len()).collect::<Vec<usize>>(), Vec::new());
        add_tree(&faces, &mut order, &mut tree);
        Ok(Self { faces, tree })
    }

    /// The nearest place for each row of `points`. Guesses are not used: the answers are global. The result for a point
    /// depends on nothing but the point and the options.
    pub fn project(
        &self,
        points: &[DVec3],
        options: &ProjectOptions,
        pool: &Pool,
    ) -> Result<ModelFeet, ProjectError> {
        options.check(points)?;
        let of_chunk = |chunk: &[DVec3]| -> Result<Vec<ModelFoot>, ProjectError> {
            pool.check()?;
            chunk.iter().map(|&point| self.nearest(point, options.max_distance, pool)).collect()
        };
        let chunks: Result<Vec<_>, _> = pool.run(|| points.par_chunks(CHUNK).map(of_chunk).collect());
        let mut feet = ModelFeet::default();
        for foot in chunks?.into_iter().flatten() {
            feet.faces.push(foot.face);
            feet.uv.push(foot.uv);
            feet.distances.push(foot.distance);
            feet.flags.push(if foot.is_proven { 0 } else { FLAG_NOT_PROVEN });
        }
        Ok(feet)
    }

    fn nearest(&self, point: DVec3, max_distance: f64, pool: &Pool) -> Result<ModelFoot, ProjectError> {
        let mut best = ModelFoot { face: None, uv: DVec2::NAN, distance: f64::NAN, is_proven: true };
        let mut most = max_distance;
        let mut stack = vec![(self.tree[0].distance(point), 0)];
        while let Some((least, at)) = stack.pop() {
            if least > most {
                continue;
            }
            match self.tree[at].below {
                Below::Second(second) => {
                    let [a, b] = [at + 1, second].map(|child| (self.tree[child].distance(point), child));
                    // the nearer one is taken from the stack first
                    stack.extend(if a.0 <= b.0 { [b, a] } else { [a, b] });
                }
                Below::Face(face) => {
                    let foot = self.faces[face].nearest(point, most, pool)?;
                    best.is_proven &= foot.is_proven;
                    if foot.distance < most || (best.face.is_none() && foot.distance <= most) {
                        (best.face, best.uv) = (Some(FaceId(face as u32)), foot.uv);
                        (best.distance, most) = (foot.distance, foot.distance);
                    }
                }
            }
        }
        Ok(best)
    }
}

impl FaceFeet {
    /// The nearest place, NaN if it is farther away than `most`.
    fn nearest(&self, point: DVec3, most: f64, pool: &Pool) -> Result<Foot, ProjectError> {
        match &self.feet {
            Feet::Exact { carrier, bound } => bound.nearest(carrier, point, pool),
            Feet::Spline(projector) => {
                let options = ProjectOptions { max_distance: most, ..ProjectOptions::default() };
                let nearest = projector.project(&point.to_array(), &options, pool)?;
                let is_proven = nearest.unproven() == 0;
                Ok(Foot { uv: nearest.uv[0], distance: nearest.distances[0], is_proven })
            }
        }
    }
}

fn face_feet(model: &Model, face: FaceId) -> Result<FaceFeet, ProjectError> {
    let Face { bounds, .. } = model.face(face);
    let hull = |rows: &[f64], reach: f64| {
        let points = rows.chunks_exact(3).map(DVec3::from_slice);
        let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        points.fold(start, |(min, max), p| (min.min(p - reach), max.max(p + reach)))
    };
    let of_edges = || {
        bounds
            .iter()
            .flatten()
            .flat_map(|coedge| model.edge(coedge.edge).curve.bounds())
            .flat_map(|corner| corner.to_array())
    };
    let ((min, max), feet) = match model.carrier(face) {
        Carrier::Spline(surface) => {
            let mut surface = surface.clone();
            let whole = surface.domain();
            let region = surface.region_mut();
            region.data_box = None;
            // a loop along the sides of the domain bounds nothing
            region.trims = match model.trims(face) {
                Ok(trims) if !encloses_all(trims.loops(), whole.min, whole.max) => trims,
                _ => crate::surface::Trims::default(),
            };
            (hull(surface.control_points(), 0.0), Feet::Spline(Projector::new(&surface)?))
        }
        carrier => {
            // a wall is nowhere farther from its edges than all round the cylinder
            let reach = if let Carrier::Cylinder(cylinder) = carrier { 2.0 * cylinder.radius() } else { 0.0 };
            let rows: Vec<f64> = of_edges().collect();
            (hull(&rows, reach), Feet::Exact { carrier: carrier.clone(), bound: Bound::new(model, face) })
        }
    };
    Ok(FaceFeet { min, max, feet })
}

/// Whether one loop runs along the sides of a rectangle, but for roundings of its p-curves.
fn encloses_all(loops: &[Vec<DVec2>], min: DVec2, max: DVec2) -> bool {
    let near = 8.0 * f64::EPSILON * min.abs().max(max.abs());
    let is_at = |a: DVec2, b: DVec2| (a - b).abs().cmple(near);
    let on_side = |uv: &DVec2| is_at(*uv, min).any() || is_at(*uv, max).any();
    let corners = [min, max, DVec2::new(min.x, max.y), DVec2::new(max.x, min.y)];
    let [polyline] = loops else { return false };
    polyline.iter().all(on_side)
        && corners.iter().all(|&corner| polyline.iter().any(|&uv| is_at(uv, corner).all()))
}

impl Side {
    /// The parameter and distance of the place of an arc that is nearest, from that of its spline: one step of Newton's
    /// method, since both differ by roundings.
    fn exact(&self, place: DVec3, t: f64, distance: f64) -> (f64, f64) {
        let EdgeCurve::Arc(arc) = &self.curve else { return (t, distance) };
        let mut row = [0.0; 9];
        self.curve.eval_rows(&[t], 2, &mut row);
        let [at, speed, turn] = [0, 3, 6].map(|k| DVec3::from_slice(&row[k..]));
        let slope = speed.length_squared() + (at - place).dot(turn);
        let (from, to) = arc.domain();
        let step = if slope > 0.0 { (place - at).dot(speed) / slope } else { 0.0 };
        let t = (t + step).clamp(from, to);
        (t, self.curve.points(&[t])[0].distance(place))
    }
}

impl Bound {
    fn new(model: &Model, face: FaceId) -> Self {
        let of_face = model.face(face);
        let carrier = model.carrier(face);
        let mut bound = Self {
            sides: Vec::new(),
            segments: Vec::new(),
            chord_error: 0.0,
            is_periodic: matches!(carrier, Carrier::Cylinder(_)),
        };
        for (index, coedges) in of_face.bounds.iter().enumerate() {
            let mut before: Option<DVec2> = None;
            for (place, coedge) in coedges.iter().enumerate() {
                let curve = &model.edge(coedge.edge).curve;
                let breaks = curve.breaks();
                // pieces with their middles between them
                let fine = super::measure::between(&breaks, 2 * PIECES);
                let mut places = model.places(Use { face, bound: index, place }, &fine);
                if !coedge.is_forward {
                    places.reverse();
                }
                carrier.go_on(before, &mut places);
                before = places.last().copied();
                let middles = places.chunks_exact(2).map(|pair| pair[1]).collect::<Vec<_>>();
                for (k, &middle) in middles.iter().enumerate() {
                    let ends = [places[2 * k], places[2 * k + 2]];
                    let [a, b] = [middle, ends[0].midpoint(ends[1])].map(|uv| carrier.points(&[uv])[0]);
                    bound.chord_error = bound.chord_error.max(a.distance(b));
                    bound.segments.push(ends);
                }
                // a seam bounds nothing: the face goes on behind it
                if model.uses(coedge.edge).filter(|at| at.face == face).count() == 2 {
                    continue;
                }
                bound.sides.push(Side {
                    projector: Projector::of_curve(&curve.to_spline()),
                    curve: curve.clone(),
                    is_forward: coedge.is_forward == of_face.is_forward,
                });
            }
        }
        bound
    }

    /// The nearest place on the part of an exact surface inside the loops.
    fn nearest(&self, carrier: &Carrier, point: DVec3, pool: &Pool) -> Result<Foot, ProjectError> {
        let foot = carrier.locate_all(&[point])[0];
        let at_foot = carrier.points(&[foot])[0];
        let options = ProjectOptions::default();
        let mut edge = (0, 0.0, f64::INFINITY);
        let mut beside = (0, 0.0, f64::INFINITY);
        let mut is_proven = true;
        for (k, side) in self.sides.iter().enumerate() {
            for (place, best) in [(point, &mut edge), (at_foot, &mut beside)] {
                let nearest = side.projector.project(&place.to_array(), &options, pool)?;
                is_proven &= nearest.unproven() == 0;
                let (t, distance) = side.exact(place, nearest.uv[0].x, nearest.distances[0]);
                if distance < best.2 {
                    *best = (k, t, distance);
                }
            }
        }
        let is_inside = match beside.2 <= 2.0 * self.chord_error {
            // too near to an edge for the pieces of the loop to tell
            true => self.is_left(carrier, beside.0, beside.1, at_foot),
            false => self.contains(foot),
        };
        if is_inside {
            return Ok(Foot { uv: foot, distance: point.distance(at_foot), is_proven });
        }
        let at_edge = self.sides[edge.0].curve.points(&[edge.1])[0];
        Ok(Foot { uv: carrier.locate_all(&[at_edge])[0], distance: edge.2, is_proven })
    }

    /// Whether a place of the surface is on the side of an edge on which the face is.
    fn is_left(&self, carrier: &Carrier, side: usize, t: f64, place: DVec3) -> bool {
        let mut row = [0.0; 6];
        self.sides[side].curve.eval_rows(&[t], 1, &mut row);
        let [at, along] = [0, 3].map(|k| DVec3::from_slice(&row[k..]));
        let normal = match carrier {
            Carrier::Plane(plane) => plane.0.z(),
            Carrier::Cylinder(cylinder) => {
                let from = at - cylinder.frame().origin();
                from - from.dot(cylinder.frame().z()) * cylinder.frame().z()
            }
            Carrier::Spline(_) => DVec3::ZERO,
        };
        let sense = if self.sides[side].is_forward { 1.0 } else { -1.0 };
        sense * normal.dot(along.cross(place - at)) >= 0.0
    }

    /// Whether a ray towards larger v crosses the loops an odd number of times.
    fn contains(&self, uv: DVec2) -> bool {
        let crosses = |[a, b]: &[DVec2; 2]| {
            let turns = if self.is_periodic { ((a.midpoint(*b).x - uv.x) / TAU).round() } else { 0.0 };
            let u = uv.x + turns * TAU;
            (a.x <= u) != (b.x <= u) && uv.y < a.y + (u - a.x) / (b.x - a.x) * (b.y - a.y)
        };
        self.segments.iter().filter(|&segment| crosses(segment)).count() % 2 == 1
    }
}

/// Pieces of a span of an edge.
const PIECES: usize = 8;

#[cfg(test)]
mod tests {
    use super::super::shapes::{
        PIPE_HEIGHT, PIPE_OFF, PIPE_RADIUS, circle, hollow_cube, pipe, rectangle, trimmed, wave,
    };
    use super::super::{Frame, of_parts};
    use super::*;
    use crate::samples::Random;

    fn random_points(count: usize, center: DVec3, reach: f64) -> Vec<DVec3> {
        let mut random = Random::new(7);
        (0..count)
            .map(|_| center + reach * DVec3::new(random.signed(), random.signed(), random.signed()))
            .collect()
    }

    fn project(model: &Model, points: &[DVec3], threads: usize) -> ModelFeet {
        let projector = ModelProjector::new(model).unwrap();
        projector.project(points, &ProjectOptions::default(), &Pool::new(threads)).unwrap()
    }

    #[test]
    fn distances_to_a_hollow_cube_are_those_of_boxes() {
        let points = random_points(500, DVec3::splat(0.5), 1.2);
        let to_skin = |p: DVec3, low: f64, high: f64| {
            let q = p.clamp(DVec3::splat(low), DVec3::splat(high));
            let inside = (p - low).min(high - p).min_element();
            if inside > 0.0 { inside } else { p.distance(q) }
        };
        let mut both = Vec::new();
        for is_flat in [false, true] {
            let model = hollow_cube(is_flat);
            let feet = project(&model, &points, 2);
            assert_eq!(feet, project(&model, &points, 1));
            for (k, &point) in points.iter().enumerate() {
                let exact = to_skin(point, 0.0, 1.0).min(to_skin(point, 0.25, 0.75));
                assert!((feet.distances[k] - exact).abs() < 1e-12, "{point} {exact} {}", feet.distances[k]);
                let at = model.carrier(feet.faces[k].unwrap()).points(&[feet.uv[k]])[0];
                assert!((at.distance(point) - exact).abs() < 1e-12);
            }
            both.push(feet.distances);
        }
    }

    #[test]
    fn distances_to_a_pipe_are_those_of_a_cylinder() {
        let model = pipe();
        let Carrier::Cylinder(cylinder) = &model.surfaces()[0] else { panic!("the wall is a cylinder") };
        let frame: Frame = *cylinder.frame();
        let middle = frame.origin() + 0.5 * PIPE_HEIGHT * frame.z();
        let points = random_points(300, middle, 4.0);
        let feet = project(&model, &points, 2);
        for (k, &point) in points.iter().enumerate() {
            let from = point - frame.origin();
            let height = from.dot(frame.z());
            let radius = (from - height * frame.z()).length();
            let out =
                DVec2::new((radius - PIPE_RADIUS).max(0.0), (height - PIPE_HEIGHT).max(-height).max(0.0));
            let inside = (PIPE_RADIUS - radius).min(height).min(PIPE_HEIGHT - height);
            let exact = if inside > 0.0 { inside } else { out.length() };
            assert!((feet.distances[k] - exact).abs() < PIPE_OFF, "{point} {exact} {}", feet.distances[k]);
        }
    }

    #[test]
    fn a_model_of_one_face_is_its_surface() {
        let surface = trimmed(wave(), vec![rectangle(0.1, 0.9), circle([0.4, 0.5], 0.1, 40)]);
        let model = of_parts(&surface, vec![surface.clone()]).unwrap();
        let points = random_points(200, DVec3::new(0.5, 0.5, 0.0), 1.0);
        let feet = project(&model, &points, 1);
        let rows: Vec<f64> = points.iter().flat_map(|p| p.to_array()).collect();
        let projector = Projector::new(&surface).unwrap();
        let nearest = projector.project(&rows, &ProjectOptions::default(), &Pool::new(1)).unwrap();
        let distances = nearest.distances;
        for (a, b) in feet.distances.iter().zip(&distances) {
            assert!((a - b).abs() < 1e-12, "{a} {b}");
        }
        let near = ProjectOptions { max_distance: 0.1, ..ProjectOptions::default() };
        let feet = ModelProjector::new(&model).unwrap().project(&points, &near, &Pool::new(1)).unwrap();
        for (k, distance) in distances.iter().enumerate() {
            assert_eq!(feet.faces[k].is_some(), *distance <= 0.1);
            assert_eq!(feet.distances[k].is_nan(), *distance > 0.1);
        }
    }
}
