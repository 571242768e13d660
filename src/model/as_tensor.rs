//! A face as a surface of its own: the spline under it with the loops as trims.
//!
//! A plane becomes a bilinear patch over the box of its loops with the same parameters. A cylinder becomes rational
//! quadratics over arcs of at most a quarter (L. Piegl, W. Tiller, "The NURBS Book" (1997), section 7.3). Along an arc
//! of the angle 2 h from its start
//! ```text
//! weights 1, cos h, 1:   tan(angle / 2) = a t / (1 + b t)
//! ```
//! is linear fractional in the parameter t of the arc; [`Arcs::parameter`] solves it for t.

use super::{Carrier, Cylinder, FaceId, Frame, Model, ModelError, Plane};
use crate::geometry::Domain;
use crate::knots::KnotVector;
use crate::surface::tensor::TensorSurface;
use crate::surface::{Surface, Trims};
use glam::{DVec2, DVec3};
use std::f64::consts::FRAC_PI_2;

impl Model {
    /// An independent surface that is the face inside its trims. On a cylinder its parameter u is not the angle.
    pub fn face_surface(&self, face: FaceId) -> Result<TensorSurface, ModelError> {
        let polylines = self.polylines(face);
        let (mut surface, polylines) = match self.carrier(face) {
            Carrier::Spline(surface) => (surface.clone(), polylines),
            Carrier::Plane(Plane(frame)) => (plane_patch(frame, &around(&polylines))?, polylines),
            Carrier::Cylinder(cylinder) => {
                let (surface, place) = cylinder_patch(cylinder, &around(&polylines))?;
                let moved = |polyline: &Vec<DVec2>| polyline.iter().map(|&uv| place(uv)).collect();
                let polylines = polylines.iter().map(moved).collect();
                (surface, polylines)
            }
        };
        let domain = surface.domain();
        let clamped =
            polylines.into_iter().map(|polyline| polyline.into_iter().map(|uv| domain.clamp(uv)).collect());
        let region = surface.region_mut();
        region.data_box = None;
        region.trims = Trims::new(clamped.collect(), &domain)?;
        Ok(surface)
    }
}

fn around(polylines: &[Vec<DVec2>]) -> Domain {
    Domain::around(polylines.iter().flatten().copied())
}

fn plane_patch(frame: &Frame, domain: &Domain) -> Result<TensorSurface, ModelError> {
    let knots = |from, to| KnotVector::clamped(&[from, to], 1);
    let (min, max) = (domain.min, domain.max);
    let corners = [min, DVec2::new(min.x, max.y), DVec2::new(max.x, min.y), max];
    let place = |uv: DVec2| (frame.origin() + uv.x * frame.x() + uv.y * frame.y()).to_array();
    let points = corners.into_iter().flat_map(place).collect();
    Ok(TensorSurface::new(3, knots(min.x, max.x)?, knots(min.y, max.y)?, points, None)?)
}

/// The patch over a rectangle of angles and heights, and where places given by angle and height lie in its plane.
pub(super) fn cylinder_patch(
    cylinder: &Cylinder,
    domain: &Domain,
) -> Result<(TensorSurface, impl Fn(DVec2) -> DVec2 + use<>), ModelError> {
    let arcs = Arcs::new(domain);
    Ok((arcs.surface(cylinder)?, move |uv| arcs.place(uv)))
}

/// Equal arcs over a range of angles, one unit of parameter each.
struct Arcs {
    domain: Domain,
    count: usize,
    /// Half the angle of an arc.
    half: f64,
}

impl Arcs {
    fn new(domain: &Domain) -> Self {
        let angle = domain.size().x;
        let count = (angle / FRAC_PI_2).ceil().max(1.0) as usize;
        Self { domain: *domain, count, half: 0.5 * angle / count as f64 }
    }

    /// Where a place given by angle and height lies in the plane of the rational surface.
    fn place(&self, uv: DVec2) -> DVec2 {
        let from = uv.x - self.domain.min.x;
        let arc = (from / (2.0 * self.half)).floor().clamp(0.0, self.count as f64 - 1.0);
        DVec2::new(arc + self.parameter(from - 2.0 * self.half * arc), uv.y)
    }

    /// The parameter on an arc at an angle from its start.
    ///
    /// By symmetry t(2h) = 1 and t(h) = 1/2, which fix the fraction: t = tan(angle/2) / (a - b tan(angle/2)).
    fn parameter(&self, angle: f64) -> f64 {
        let (whole, half) = (self.half.tan(), (0.5 * self.half).tan());
        let b = (2.0 * half - whole) / (whole - half);
        let a = whole * (1.0 + b);
        let tangent = (0.5 * angle).tan();
        tangent / (a - b * tangent)
    }

    fn surface(&self, cylinder: &Cylinder) -> Result<TensorSurface, ModelError> {
        let (frame, radius) = (cylinder.frame(), cylinder.radius());
        let (low, high) = (self.domain.min.y, self.domain.max.y);
        let (mut points, mut weights) = (Vec::new(), Vec::new());
        for k in 0..=2 * self.count {
            let angle = self.domain.min.x + k as f64 * self.half;
            // the middle control point of an arc is where the tangents at its ends meet
            let weight = if k % 2 == 1 { self.half.cos() } else { 1.0 };
            let outward = angle.cos() * frame.x() + angle.sin() * frame.y();
            for height in [low, high] {
                let place: DVec3 = frame.origin() + radius / weight * outward + height * frame.z();
                points.extend(place.to_array());
                weights.push(weight);
            }
        }
        let mut knots = vec![0.0; 3];
        (1..self.count).for_each(|k| knots.extend([k as f64; 2]));
        knots.extend([self.count as f64; 3]);
        let (u, v) = (KnotVector::new(knots, 2)?, KnotVector::clamped(&[low, high], 1)?);
        Ok(TensorSurface::new(3, u, v, points, Some(weights))?)
    }
}
