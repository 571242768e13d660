//! Directions that are meant to be the same, or at right angles.
//!
//! Normals and axes found one by one are parallel within noise; an axis must be parallel to a normal to the bit for the
//! edge to be a circle. Directions are gone through from the surest on; each is drawn to those before it as far as the
//! nodes allow.

use super::recognize::Recognized;
use super::split::Part;
use crate::model::{Carrier, Cylinder, Plane};
use glam::DVec3;

/// Sine of the angle within which directions may be meant to be the same or at right angles: two degrees.
const NEAR: f64 = 0.035;
/// The root of the mean square of distances may grow by this factor: noise moves a direction by less.
const GROWTH: f64 = 1.05;
/// And by this part of the diagonal: coordinates in single precision are rounded by up to 6e-8 of it.
const ROUNDING: f64 = 1e-6;

/// Draws directions together and to right angles where the nodes allow it.
pub(crate) fn align(parts: &mut [Part], diagonal: f64) {
    let mut order: Vec<usize> = (0..parts.len()).collect();
    // how well the nodes tell a direction: by how many there are, and how far they reach
    let weight = |k: usize| {
        let evidence = &parts[k].found.evidence;
        evidence.points.len() as f64 * evidence.extent().powi(2)
    };
    let weights: Vec<f64> = (0..parts.len()).map(weight).collect();
    order.sort_by(|&i, &j| weights[j].total_cmp(&weights[i]));
    let mut known: Vec<DVec3> = Vec::new();
    for k in order {
        let found = &mut parts[k].found;
        let own = direction(&found.carrier);
        let same = known.iter().copied().find(|axis| axis.cross(own).length() <= NEAR);
        let wanted = same.or_else(|| squared(own, &known));
        if let Some(carrier) = wanted.and_then(|axis| turned(found, axis, diagonal)) {
            found.carrier = carrier;
        }
        let axis = direction(&found.carrier);
        if !known.iter().any(|other| other.cross(axis) == DVec3::ZERO || other.dot(axis).abs() == 1.0) {
            known.push(axis);
        }
    }
}

/// The normal of a plane or the axis of a cylinder.
pub(crate) fn direction(carrier: &Carrier) -> DVec3 {
    match carrier {
        Carrier::Plane(Plane(frame)) => frame.z(),
        Carrier::Cylinder(cylinder) => cylinder.frame().z(),
        Carrier::Spline(_) => DVec3::ZERO,
    }
}

/// A direction made square to the known ones that it is nearly square to: two of them tell it.
fn squared(own: DVec3, known: &[DVec3]) -> Option<DVec3> {
    let mut square = known.iter().copied().filter(|axis| axis.dot(own).abs() <= NEAR);
    let first = square.next()?;
    let second = square.find(|axis| axis.cross(first).length() > 0.5);
    match second {
        Some(second) => {
            let axis = first.cross(second).normalize();
            Some(if axis.dot(own) < 0.0 { -axis } else { axis })
        }
        None => (own - own.dot(first) * first).try_normalize(),
    }
}

/// The carrier of this direction, if the nodes allow it.
fn turned(found: &Recognized, axis: DVec3, diagonal: f64) -> Option<Carrier> {
    let evidence = &found.evidence;
    let carrier: Carrier = match &found.carrier {
        Carrier::Plane(_) => evidence.plane_along(axis)?.into(),
        Carrier::Cylinder(_) => evidence.cylinder_along(axis, &[])?.into(),
        Carrier::Spline(_) => return None,
    };
    let before = evidence.rms(&found.carrier);
    (evidence.rms(&carrier) <= GROWTH * before + ROUNDING * diagonal).then_some(carrier)
}

/// Lets a cylinder touch the planes that meet it smoothly, if the nodes allow it.
pub(crate) fn touch(found: &Recognized, planes: &[Plane], diagonal: f64) -> Option<Cylinder> {
    let Carrier::Cylinder(cylinder) = &found.carrier else { return None };
    let mut tangent: Vec<(DVec3, f64)> = Vec::new();
    for Plane(frame) in planes {
        let side = (cylinder.frame().origin() - frame.origin()).dot(frame.z());
        let normal = if side > 0.0 { -frame.z() } else { frame.z() };
        if tangent.iter().all(|(other, _)| other.dot(normal) < 1.0 - NEAR * NEAR) {
            tangent.push((normal, normal.dot(frame.origin())));
        }
    }
    let touching = found.evidence.cylinder_along(cylinder.frame().z(), &tangent)?;
    let before = found.evidence.rms(&found.carrier);
    let after = found.evidence.rms(&touching.into());
    (after <= GROWTH * before + ROUNDING * diagonal).then_some(touching)
}
