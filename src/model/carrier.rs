//! What faces lie on: splines, and surfaces with exact formulas.

use super::EdgeCurve;
use crate::geometry::Domain;
use crate::memory::{self, CollectVec};
use crate::surface::tensor::TensorSurface;
use crate::surface::{Surface, derivative_rows};
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// Three axes at right angles, right-handed, through a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    origin: DVec3,
    x: DVec3,
    z: DVec3,
}

impl Frame {
    /// The frame at `origin` whose third axis is along `z` and whose first axis is as near to `x` as it can be; none
    /// if the directions do not tell.
    pub fn new(origin: DVec3, z: DVec3, x: DVec3) -> Option<Self> {
        let z = z.try_normalize()?;
        let x = (x - x.dot(z) * z).try_normalize()?;
        origin.is_finite().then_some(Self { origin, x, z })
    }

    /// The frame with these axes to the bit, if they are at right angles and of length 1 within rounding.
    pub fn from_axes(origin: DVec3, z: DVec3, x: DVec3) -> Option<Self> {
        /// Some operations' worth of rounding.
        const ROUNDING: f64 = 64.0 * f64::EPSILON;
        let off = [x.dot(z), x.length() - 1.0, z.length() - 1.0];
        let is_frame = origin.is_finite() && off.iter().all(|off| off.abs() <= ROUNDING);
        is_frame.then_some(Self { origin, x, z })
    }

    /// Where it stands.
    pub fn origin(&self) -> DVec3 {
        self.origin
    }

    /// The first axis.
    pub fn x(&self) -> DVec3 {
        self.x
    }

    /// The second axis.
    pub fn y(&self) -> DVec3 {
        self.z.cross(self.x)
    }

    /// The third axis.
    pub fn z(&self) -> DVec3 {
        self.z
    }

    /// The coordinates of a place.
    fn coordinates(&self, place: DVec3) -> DVec3 {
        let from = place - self.origin;
        DVec3::new(from.dot(self.x), from.dot(self.y()), from.dot(self.z))
    }
}

/// `S(u,v) = origin + u x + v y`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane(pub Frame);

/// `S(u,v) = origin + radius (cos u x + sin u y) + v z`, u in radians; its normal points away from the axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cylinder {
    frame: Frame,
    radius: f64,
}

impl Cylinder {
    /// Around the third axis of a frame; none unless the radius is positive and finite.
    pub fn new(frame: Frame, radius: f64) -> Option<Self> {
        (radius > 0.0 && radius.is_finite()).then_some(Self { frame, radius })
    }

    /// Its axis is the third.
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// The radius.
    pub fn radius(&self) -> f64 {
        self.radius
    }
}

/// The surface under a face.
#[derive(Debug, Clone, PartialEq)]
#[allow(clippy::large_enum_variant, reason = "almost all are splines")]
pub enum Carrier {
    /// A B-spline surface in space.
    Spline(TensorSurface),
    /// A plane.
    Plane(Plane),
    /// A cylinder.
    Cylinder(Cylinder),
}

impl From<TensorSurface> for Carrier {
    fn from(surface: TensorSurface) -> Self {
        Self::Spline(surface)
    }
}

impl From<Plane> for Carrier {
    fn from(plane: Plane) -> Self {
        Self::Plane(plane)
    }
}

impl From<Cylinder> for Carrier {
    fn from(cylinder: Cylinder) -> Self {
        Self::Cylinder(cylinder)
    }
}

impl Carrier {
    /// The spline, if it is one.
    pub fn spline(&self) -> Option<&TensorSurface> {
        match self {
            Self::Spline(surface) => Some(surface),
            _ => None,
        }
    }

    /// Control points; none for an exact formula.
    pub fn pole_count(&self) -> usize {
        self.spline().map_or(0, Surface::coefficient_count)
    }

    /// The nearest parameters at which the surface is defined.
    pub fn clamp(&self, uv: DVec2) -> DVec2 {
        self.spline().map_or(uv, |surface| surface.domain().clamp(uv))
    }

    /// Values and derivatives at each of `uv`, as [`Surface::eval_rows`].
    pub fn eval_rows(&self, uv: &[DVec2], max_derivative: usize, out: &mut [f64]) {
        let rows = 3 * derivative_rows(max_derivative);
        match self {
            Self::Spline(surface) => surface.eval_rows(uv, max_derivative, out),
            Self::Plane(Plane(frame)) => {
                for (uv, out) in uv.iter().zip(out.chunks_exact_mut(rows)) {
                    let place = frame.origin + uv.x * frame.x + uv.y * frame.y();
                    store(&[place, frame.x, frame.y(), DVec3::ZERO, DVec3::ZERO, DVec3::ZERO], out);
                }
            }
            Self::Cylinder(Cylinder { frame, radius }) => {
                for (uv, out) in uv.iter().zip(out.chunks_exact_mut(rows)) {
                    let (sin, cos) = uv.x.sin_cos();
                    let outward = cos * frame.x + sin * frame.y();
                    let around = radius * (cos * frame.y() - sin * frame.x);
                    let place = frame.origin + *radius * outward + uv.y * frame.z;
                    store(&[place, around, frame.z, -*radius * outward, DVec3::ZERO, DVec3::ZERO], out);
                }
            }
        }
    }

    /// The points at each of `uv`.
    pub fn points(&self, uv: &[DVec2]) -> Vec<DVec3> {
        let mut rows = memory::filled(0.0, 3 * uv.len());
        self.eval_rows(uv, 0, &mut rows);
        rows.chunks_exact(3).map(DVec3::from_slice).collect_vec()
    }

    /// The parameters of the place of an exact surface that is nearest to a point; none on a spline, which has no formula
    /// for them.
    pub fn nearest(&self, point: DVec3) -> Option<DVec2> {
        self.spline().is_none().then(|| self.locate_all(&[point])[0])
    }

    /// The parameters of the places of an exact surface that are nearest to points which follow one another: angles
    /// go on from one to the next without a jump. A spline has no formula for them.
    pub(super) fn locate_all(&self, points: &[DVec3]) -> Vec<DVec2> {
        let mut before = 0.0;
        let mut locate = |&point: &DVec3| match self {
            Self::Spline(_) => unreachable!("every coedge on a spline has a p-curve"),
            Self::Plane(Plane(frame)) => frame.coordinates(point).truncate(),
            Self::Cylinder(Cylinder { frame, .. }) => {
                let at = frame.coordinates(point);
                let angle = at.y.atan2(at.x);
                let turns = ((before - angle) / TAU).round();
                before = angle + turns * TAU;
                DVec2::new(before, at.z)
            }
        };
        points.iter().map(&mut locate).collect()
    }

    /// The derivative of a curve's place on a cylinder: angle and height.
    pub(super) fn speed(&self, curve: &EdgeCurve, t: f64) -> DVec2 {
        let Self::Cylinder(Cylinder { frame, .. }) = self else { return DVec2::ZERO };
        let mut row = [0.0; 6];
        curve.eval_rows(&[t], 1, &mut row);
        let [place, along] = [0, 3].map(|k| DVec3::from_slice(&row[k..]));
        let at = frame.coordinates(place);
        let across = at.x * frame.y() - at.y * frame.x();
        DVec2::new(along.dot(across) / (at.x * at.x + at.y * at.y), along.dot(frame.z()))
    }

    /// Turns angles on a cylinder by whole turns, so that places go on where others ended.
    pub(super) fn go_on(&self, before: Option<DVec2>, places: &mut [DVec2]) {
        if let (Self::Cylinder(_), Some(before), Some(first)) = (self, before, places.first()) {
            let turns = ((before.x - first.x) / TAU).round();
            places.iter_mut().for_each(|uv| uv.x += turns * TAU);
        }
    }

    /// Turns holes on a cylinder by whole turns, so that they lie between the ends of the loop around them, the first.
    /// ```text
    ///   0         tau        3 tau / 2
    ///   |     ------------------         the loop around, from where its seam is
    ///   ( )       ( )                    a hole where its angle says, and a turn on
    /// ```
    pub(super) fn align_holes<T>(&self, loops: &mut [Vec<T>], place: impl Fn(&mut T) -> &mut DVec2) {
        let (Self::Cylinder(_), Some((outer, holes))) = (self, loops.split_first_mut()) else { return };
        let middle = |of: &mut Vec<T>| {
            let angles = of.iter_mut().map(|corner| place(corner).x);
            let (low, high) =
                angles.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), u| (low.min(u), high.max(u)));
            0.5 * (low + high)
        };
        let around = middle(outer);
        for hole in holes {
            let turns = ((around - middle(hole)) / TAU).round();
            hole.iter_mut().for_each(|corner| place(corner).x += turns * TAU);
        }
    }

    /// The rectangle of parameters on which a spline is defined.
    pub fn domain(&self) -> Option<Domain> {
        self.spline().map(Surface::domain)
    }
}

fn store(values: &[DVec3; 6], out: &mut [f64]) {
    for (value, out) in values.iter().zip(out.chunks_exact_mut(3)) {
        out.copy_from_slice(&value.to_array());
    }
}
