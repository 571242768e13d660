//! Surfaces and models for tests.

use super::*;
use crate::surface::tensor::TensorSurface;
use crate::surface::{Region, Surface, Trims};
use std::f64::consts::{FRAC_1_SQRT_2, TAU};

/// A wave over the unit square, bicubic with some inner knots.
pub(crate) fn wave() -> TensorSurface {
    let knots = KnotVector::clamped(&[0.0, 0.2, 0.5, 0.6, 1.0], 3).unwrap();
    let count = knots.basis_count();
    let mut points = Vec::new();
    for i in 0..count {
        for j in 0..count {
            let (x, y) = (knots.greville(i), knots.greville(j));
            points.extend([x, y, 0.2 * (5.0 * x).sin() * (4.0 * y).cos()]);
        }
    }
    TensorSurface::new(3, knots.clone(), knots, points, None).unwrap()
}

/// A quarter of a torus tube by a quarter of its ring, exactly.
pub(crate) fn torus_piece() -> TensorSurface {
    let knots = KnotVector::clamped(&[0.0, 1.0], 2).unwrap();
    let (ring, tube) = (3.0, 1.0);
    let w = [1.0, FRAC_1_SQRT_2, 1.0];
    let arc = [(1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
    let (mut points, mut weights) = (Vec::new(), Vec::new());
    for (i, (cx, cy)) in arc.into_iter().enumerate() {
        for (j, (tr, tz)) in arc.into_iter().enumerate() {
            let radius = ring + tube * tr;
            points.extend([radius * cx, radius * cy, tube * tz]);
            weights.push(w[i] * w[j]);
        }
    }
    TensorSurface::new(3, knots.clone(), knots, points, Some(weights)).unwrap()
}

pub(crate) fn circle(center: [f64; 2], radius: f64, count: usize) -> Vec<DVec2> {
    let place = |k: usize| DVec2::from(center) + radius * DVec2::from_angle(TAU * k as f64 / count as f64);
    (0..count).map(place).collect()
}

pub(crate) fn rectangle(min: f64, max: f64) -> Vec<DVec2> {
    [(min, min), (min, max), (max, max), (max, min)].map(DVec2::from).to_vec() // clockwise
}

pub(crate) fn trimmed(mut surface: TensorSurface, loops: Vec<Vec<DVec2>>) -> TensorSurface {
    let trims = Trims::new(loops, &surface.domain()).unwrap();
    *surface.region_mut() = Region { data_box: None, trims, ..Region::default() };
    surface
}

/// The unit cube: six bilinear faces, or planes.
pub(crate) fn cube(is_flat: bool) -> Builder {
    let mut builder = Builder::default();
    box_shell(&mut builder, DVec3::ZERO, 1.0, is_flat, false, Role::Solid);
    builder
}

/// A cube as one shell; turned inside out for a void.
pub(crate) fn box_shell(
    builder: &mut Builder,
    low: DVec3,
    side: f64,
    is_flat: bool,
    is_inward: bool,
    role: Role,
) -> ShellId {
    let corner = |k: usize| low + side * DVec3::new((k & 1) as f64, (k >> 1 & 1) as f64, (k >> 2 & 1) as f64);
    let vertices: Vec<VertexId> = (0..8).map(|k| builder.vertex(corner(k))).collect();
    let mut edges = std::collections::BTreeMap::new();
    // corners counter-clockwise seen from outside
    let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let mut faces = Vec::new();
    for mut side in sides {
        if is_inward {
            side.reverse();
        }
        let [a, b, c, d] = side.map(corner);
        let line = || KnotVector::clamped(&[0.0, 1.0], 1).unwrap();
        let surface = if is_flat {
            builder.surface(Plane(Frame::new(a, (b - a).cross(d - a), b - a).unwrap()))
        } else {
            let points = [a, d, b, c].iter().flat_map(|p| p.to_array()).collect();
            builder.surface(TensorSurface::new(3, line(), line(), points, None).unwrap())
        };
        let uv = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
        let coedge = |k: usize| {
            let ends = [side[k], side[(k + 1) % 4]];
            let is_forward = ends[0] < ends[1];
            let low_high = if is_forward { ends } else { [ends[1], ends[0]] };
            let edge = *edges.entry(low_high).or_insert_with(|| {
                let numbers = low_high.iter().flat_map(|&k| corner(k).to_array()).collect();
                builder.edge(Curve::new(3, line(), numbers).unwrap(), low_high.map(|k| vertices[k]))
            });
            let ends = if is_forward { [uv[k], uv[(k + 1) % 4]] } else { [uv[(k + 1) % 4], uv[k]] };
            let pcurve = (!is_flat).then(|| straight(&Curve::new(1, line(), vec![0.0, 1.0]).unwrap(), ends));
            Coedge { edge, is_forward, pcurve }
        };
        let bound: Loop = (0..4).map(coedge).collect();
        faces.push(builder.face(surface, vec![bound]));
    }
    builder.shell(faces, role)
}

/// A cube with a void in its middle.
pub(crate) fn hollow_cube(is_flat: bool) -> Model {
    let mut builder = cube(is_flat);
    box_shell(&mut builder, DVec3::splat(0.25), 0.5, is_flat, true, Role::VoidIn(ShellId(0)));
    builder.finish().unwrap()
}

pub(crate) const PIPE_RADIUS: f64 = 2.0;
pub(crate) const PIPE_HEIGHT: f64 = 3.0;

/// A sheet of a cylinder of radius 1 over angles `from` to `from + 5` and heights 0 to 2, with a hole of 0.4 by 1 around the
/// angle `middle`.
pub(crate) fn pierced_sheet(from: f64, middle: f64) -> Model {
    let mut builder = Builder::default();
    let frame = Frame::new(DVec3::ZERO, DVec3::Z, DVec3::X).unwrap();
    let wall = builder.surface(Cylinder::new(frame, 1.0).unwrap());
    let mut rectangle = |angles: [f64; 2], heights: [f64; 2], is_hole: bool| -> Loop {
        let place = |k: usize, j: usize| DVec3::new(angles[k].cos(), angles[k].sin(), heights[j]);
        let vertices = [0, 1].map(|k| [0, 1].map(|j| builder.vertex(place(k, j))));
        let mut arc = |j: usize| {
            let at = Frame::new(heights[j] * DVec3::Z, DVec3::Z, DVec3::X).unwrap();
            builder.edge(Arc::new(at, [1.0; 2], angles).unwrap(), [vertices[0][j], vertices[1][j]])
        };
        let arcs = [0, 1].map(&mut arc);
        let line = |k: usize| builder.edge(EdgeCurve::line([place(k, 0), place(k, 1)]).unwrap(), vertices[k]);
        let lines = [0, 1].map(line);
        let coedges = [(arcs[0], true), (lines[1], true), (arcs[1], false), (lines[0], false)];
        let mut bound: Loop = coedges
            .map(|(edge, is_forward)| Coedge { edge, is_forward: is_forward != is_hole, pcurve: None })
            .to_vec();
        if is_hole {
            bound.reverse();
        }
        bound
    };
    let bounds = vec![
        rectangle([from, from + 5.0], [0.0, 2.0], false),
        rectangle([middle - 0.2, middle + 0.2], [0.5, 1.5], true),
    ];
    let face = builder.face(wall, bounds);
    builder.shell(vec![face], Role::Open);
    builder.finish().unwrap()
}

/// How far the cubics of its circles are off: 2.8e-4 of the radius for a quarter, by the sixth power of the angle.
pub(crate) const PIPE_OFF: f64 = 2.8e-4 * PIPE_RADIUS / 4096.0;

/// A cylinder, oblique in space, between two disks, with circles of sixteen cubic arcs.
pub(crate) fn pipe() -> Model {
    const ARCS: usize = 16;
    let mut builder = Builder::default();
    let frame = Frame::new(DVec3::new(1.0, 0.5, -1.0), DVec3::new(0.3, 0.2, 1.0), DVec3::X).unwrap();
    let wall = builder.surface(Cylinder::new(frame, PIPE_RADIUS).unwrap());
    let at = |angle: f64, height: f64| {
        frame.origin()
            + PIPE_RADIUS * (angle.cos() * frame.x() + angle.sin() * frame.y())
            + height * frame.z()
    };
    let line = KnotVector::clamped(&[0.0, 1.0], 3).unwrap();
    let mut circles = Vec::new();
    for height in [0.0, PIPE_HEIGHT] {
        let angle = |k: usize| TAU * k as f64 / ARCS as f64;
        let vertices: Vec<_> = (0..ARCS).map(|k| builder.vertex(at(angle(k), height))).collect();
        let mut arc = |k: usize| {
            let (from, to) = (angle(k), angle(k + 1));
            let reach = 4.0 / 3.0 * ((to - from) / 4.0).tan() * PIPE_RADIUS;
            let along = |angle: f64| reach * (angle.cos() * frame.y() - angle.sin() * frame.x());
            let points = [
                at(from, height),
                at(from, height) + along(from),
                at(to, height) - along(to),
                at(to, height),
            ];
            let curve =
                Curve::new(3, line.clone(), points.iter().flat_map(|p| p.to_array()).collect()).unwrap();
            let vertices = [vertices[k], vertices[(k + 1) % ARCS]];
            builder.add_edge(Edge { curve: curve.into(), vertices, is_sharp: true })
        };
        circles.push((0..ARCS).map(&mut arc).collect::<Vec<_>>());
    }
    let bound = |circle: &[EdgeId], is_forward: bool| -> Loop {
        let coedge = |&edge: &EdgeId| Coedge { edge, is_forward, pcurve: None };
        if is_forward {
            circle.iter().map(coedge).collect()
        } else {
            circle.iter().rev().map(coedge).collect()
        }
    };
    let bottom = builder.surface(Plane(Frame::new(frame.origin(), -frame.z(), frame.x()).unwrap()));
    let top = builder.surface(Plane(Frame::new(at(0.0, PIPE_HEIGHT), frame.z(), frame.x()).unwrap()));
    let faces = vec![
        builder.face(wall, vec![bound(&circles[0], true), bound(&circles[1], false)]),
        builder.face(bottom, vec![bound(&circles[0], false)]),
        builder.face(top, vec![bound(&circles[1], true)]),
    ];
    builder.shell(faces, Role::Solid);
    builder.finish().unwrap()
}
