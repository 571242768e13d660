//! Where planes and cylinders meet: lines, circles and ellipses, and the points where three of them do.

use super::evidence::{gradient, least_aligned, signed_distance};
use crate::linalg::Symmetric2;
use crate::model::{Arc, Carrier, Cylinder, EdgeCurve, Frame, Plane};
use glam::{DVec2, DVec3};
use nalgebra::{DMatrix, DVector};
use std::f64::consts::{PI, TAU};

/// A whole line, circle or ellipse.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Shape {
    /// Through a point, along a direction of length 1.
    Line { origin: DVec3, along: DVec3 },
    /// Around the third axis of a frame, with half its width along the first and second.
    Conic { frame: Frame, radii: [f64; 2] },
}

/// The curve in which two carriers meet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Meeting {
    pub shape: Shape,
    /// Whether the carriers are tangent along it.
    pub is_smooth: bool,
}

/// Directions are parallel or square to each other below this sine: they were made so, up to rounding.
const ROUNDING: f64 = 1e-10;
/// Carriers that meet at a smaller sine have no certain curve: a degree.
const LEAST_ANGLE: f64 = 0.017;
/// Relative difference below which a distance is a radius.
const SAME: f64 = 1e-9;

/// Where two carriers meet near some places.
pub(crate) fn meet(a: &Carrier, b: &Carrier, near: &[DVec3]) -> Option<Meeting> {
    match (a, b) {
        (Carrier::Plane(a), Carrier::Plane(b)) => planes(a, b, near),
        (Carrier::Plane(plane), Carrier::Cylinder(cylinder))
        | (Carrier::Cylinder(cylinder), Carrier::Plane(plane)) => plane_and_cylinder(plane, cylinder, near),
        (Carrier::Cylinder(a), Carrier::Cylinder(b)) => cylinders(a, b, near),
        _ => None,
    }
}

fn planes(Plane(a): &Plane, Plane(b): &Plane, near: &[DVec3]) -> Option<Meeting> {
    let across = a.z().cross(b.z());
    if across.length() < LEAST_ANGLE {
        return None;
    }
    let along = across.normalize();
    // the nearest point of the line to the middle of the places
    let middle = near.iter().sum::<DVec3>() / near.len().max(1) as f64;
    let off = [a, b].map(|frame| (frame.origin() - middle).dot(frame.z()));
    let cosine = a.z().dot(b.z());
    let shares = Symmetric2 { uu: 1.0, uv: cosine, vv: 1.0 }.solve(DVec2::from_array(off));
    let origin = middle + shares.x * a.z() + shares.y * b.z();
    Some(Meeting { shape: Shape::Line { origin, along }, is_smooth: false })
}

fn plane_and_cylinder(plane: &Plane, cylinder: &Cylinder, near: &[DVec3]) -> Option<Meeting> {
    let (Plane(of_plane), frame, radius) = (plane, cylinder.frame(), cylinder.radius());
    let (normal, axis) = (of_plane.z(), frame.z());
    let cosine = normal.dot(axis);
    let height = (of_plane.origin() - frame.origin()).dot(normal);
    if normal.cross(axis).length() <= ROUNDING {
        let centre = frame.origin() + height / cosine * axis;
        let frame = Frame::new(centre, axis, frame.x())?;
        return Some(Meeting { shape: Shape::Conic { frame, radii: [radius; 2] }, is_smooth: false });
    }
    if cosine.abs() <= ROUNDING {
        let foot = frame.origin() + height * normal;
        let half = radius * radius - height * height;
        let is_smooth = (height.abs() - radius).abs() <= SAME * radius;
        if is_smooth {
            return Some(Meeting { shape: Shape::Line { origin: foot, along: axis }, is_smooth });
        }
        let aside = (half >= 0.0).then(|| half.sqrt() * normal.cross(axis))?;
        let lines = [foot + aside, foot - aside].map(|origin| Shape::Line { origin, along: axis });
        // a sine of the angle between them: half the chord by the radius
        return (half.sqrt() >= LEAST_ANGLE * radius)
            .then(|| Meeting { shape: nearest(lines, near), is_smooth: false });
    }
    (cosine.abs() >= LEAST_ANGLE).then(|| ellipse(normal, height, cylinder)).flatten()
}

/// The ellipse of a cylinder in the plane at a height over the axis's origin.
fn ellipse(normal: DVec3, height: f64, cylinder: &Cylinder) -> Option<Meeting> {
    let (frame, radius) = (cylinder.frame(), cylinder.radius());
    let cosine = normal.dot(frame.z());
    let centre = frame.origin() + height / cosine * frame.z();
    // the shorter axis is across the cylinder's, in the plane
    let minor = frame.z().cross(normal).normalize();
    let frame = Frame::new(centre, normal, minor.cross(normal))?;
    let radii = [radius / cosine.abs(), radius];
    Some(Meeting { shape: Shape::Conic { frame, radii }, is_smooth: false })
}

/// Parallel cylinders meet in lines, equal ones whose axes cross in ellipses; of others the curve is no conic.
fn cylinders(a: &Cylinder, b: &Cylinder, near: &[DVec3]) -> Option<Meeting> {
    let axis = a.frame().z();
    let between = b.frame().origin() - a.frame().origin();
    let across = between - between.dot(axis) * axis;
    let turned = axis.cross(b.frame().z());
    if turned.length() <= ROUNDING {
        let distance = across.length();
        let towards = across.try_normalize()?;
        let (p, q) = (a.radius(), b.radius());
        let share = (distance * distance + p * p - q * q) / (2.0 * distance);
        let half = p * p - share * share;
        let is_smooth = half.abs() <= SAME * p * p;
        let foot = a.frame().origin() + share * towards;
        if is_smooth {
            return Some(Meeting { shape: Shape::Line { origin: foot, along: axis }, is_smooth });
        }
        let aside = (half >= 0.0).then(|| half.sqrt() * axis.cross(towards))?;
        let sine = half.sqrt() * distance / (p * q);
        let lines = [foot + aside, foot - aside].map(|origin| Shape::Line { origin, along: axis });
        return (sine >= LEAST_ANGLE).then(|| Meeting { shape: nearest(lines, near), is_smooth: false });
    }
    let is_equal = (a.radius() - b.radius()).abs() <= SAME * a.radius();
    let crosses = between.dot(turned).abs() <= SAME * a.radius();
    if !is_equal || !crosses {
        return None;
    }
    // the axes cross at a share of the first one
    let other = b.frame().z();
    let share = (between - between.dot(other) * other).dot(axis) / (1.0 - axis.dot(other).powi(2));
    let height = |normal: DVec3| normal.dot(share * axis);
    let normals = [(axis + other).normalize(), (axis - other).normalize()];
    let [first, second] =
        normals.map(|normal| ellipse(normal, height(normal), a).map(|meeting| meeting.shape));
    Some(Meeting { shape: nearest([first?, second?], near), is_smooth: false })
}

fn nearest(shapes: [Shape; 2], near: &[DVec3]) -> Shape {
    let [a, b] = shapes.map(|shape| near.iter().map(|&place| shape.distance(place)).sum::<f64>());
    if a <= b { shapes[0] } else { shapes[1] }
}

impl Shape {
    /// The parameter of the place nearest to one on or beside the curve: a length along a line, else an angle.
    pub(crate) fn parameter(&self, place: DVec3) -> f64 {
        match self {
            Self::Line { origin, along } => (place - *origin).dot(*along),
            Self::Conic { frame, radii } => {
                let from = place - frame.origin();
                (from.dot(frame.y()) / radii[1]).atan2(from.dot(frame.x()) / radii[0])
            }
        }
    }

    /// The place at a parameter.
    pub(crate) fn place(&self, t: f64) -> DVec3 {
        match self {
            Self::Line { origin, along } => *origin + t * *along,
            Self::Conic { frame, radii } => {
                frame.origin() + radii[0] * t.cos() * frame.x() + radii[1] * t.sin() * frame.y()
            }
        }
    }

    /// How far a place is from the curve: for an ellipse from the place of its parameter, which is little farther.
    pub(crate) fn distance(&self, place: DVec3) -> f64 {
        self.place(self.parameter(place)).distance(place)
    }

    /// The same curve run through in the other direction, and nothing else changed.
    pub(crate) fn reversed(&self) -> Option<Self> {
        Some(match *self {
            Self::Line { origin, along } => Self::Line { origin, along: -along },
            Self::Conic { frame, radii } => {
                Self::Conic { frame: Frame::new(frame.origin(), -frame.z(), frame.x())?, radii }
            }
        })
    }

    /// The angle by which places go round, the way from one to the next being the shorter one; for a line the length.
    pub(crate) fn sweep(&self, places: impl Iterator<Item = DVec3>) -> f64 {
        let parameters: Vec<f64> = places.map(|place| self.parameter(place)).collect();
        let step = |pair: &[f64]| match self {
            Self::Line { .. } => pair[1] - pair[0],
            Self::Conic { .. } => (pair[1] - pair[0] + PI).rem_euclid(TAU) - PI,
        };
        parameters.windows(2).map(step).sum()
    }

    /// The part between two parameters.
    pub(crate) fn part(&self, ends: [f64; 2]) -> Option<EdgeCurve> {
        match *self {
            Self::Line { .. } => EdgeCurve::line(ends.map(|t| self.place(t))),
            Self::Conic { frame, radii } => Some(Arc::new(frame, radii, ends)?.into()),
        }
    }

    /// The planes whose line it is, as a carrier beside one of its own: through it, and square to a plane or cylinder
    /// that is tangent there to the other.
    pub(crate) fn upright(&self, tangent: &Carrier) -> Option<Carrier> {
        let Self::Line { origin, along } = *self else { return None };
        let normal = along.cross(gradient(tangent, origin));
        Some(Plane(Frame::new(origin, normal, least_aligned(normal))?).into())
    }
}

/// Steps of Newton's method to a corner.
const STEPS: usize = 30;
/// Singular values below this part of the largest leave the place free along their directions.
const FREE: f64 = 1e-6;

/// The place nearest to a node where all carriers meet, and how far it is from them at most.
pub(crate) fn corner(carriers: &[Carrier], node: DVec3) -> Option<(DVec3, f64)> {
    let mut place = node;
    for _ in 0..STEPS {
        let matrix = DMatrix::from_fn(carriers.len(), 3, |i, j| gradient(&carriers[i], place)[j]);
        let right = DVector::from_fn(carriers.len(), |i, _| -signed_distance(&carriers[i], place));
        let step = matrix.svd(true, true).solve(&right, FREE).ok()?;
        let step = DVec3::new(step[0], step[1], step[2]);
        place += step;
        if step.length() <= 4.0 * f64::EPSILON * place.abs().max_element() {
            break;
        }
    }
    let off = carriers.iter().map(|carrier| signed_distance(carrier, place).abs()).fold(0.0, f64::max);
    place.is_finite().then_some((place, off))
}

/// Sine of the angle at which two carriers meet at a place.
pub(crate) fn sine_at(a: &Carrier, b: &Carrier, place: DVec3) -> f64 {
    gradient(a, place).cross(gradient(b, place)).length()
}
