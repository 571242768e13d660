//! Borders of open meshes: what a face would meet there, were the part closed.
//!
//! A border has a face on one side only. It is a line, circle or ellipse if its nodes lie on an upright plane or cylinder on
//! a plane, or on a plane through a cylinder.

use super::evidence::{circle, least_aligned};
use crate::linalg::principal_axes;
use crate::model::{Carrier, Cylinder, Frame, Plane};
use glam::{DVec2, DVec3};

/// What meets a carrier along some places within a distance.
pub(super) fn rim(carrier: &Carrier, places: &[DVec3], reach: f64) -> Option<Carrier> {
    let is_on = |rim: &Carrier| {
        places.iter().all(|&place| super::evidence::signed_distance(rim, place).abs() <= reach)
    };
    let candidates: Vec<Option<Carrier>> = match carrier {
        Carrier::Plane(Plane(frame)) => vec![upright_plane(frame, places), upright_cylinder(frame, places)],
        Carrier::Cylinder(cylinder) => {
            vec![across(cylinder, places), along(cylinder, places), slanted(places)]
        }
        Carrier::Spline(_) => Vec::new(),
    };
    candidates.into_iter().flatten().find(is_on)
}

/// Chords of a circle are no longer than this part of its radius: they turn by less than sharp edges, 40 degrees.
const LONGEST_CHORD: f64 = 0.68;

fn middle(places: &[DVec3]) -> DVec3 {
    places.iter().sum::<DVec3>() / places.len().max(1) as f64
}

/// Directions in which places spread, the least first.
fn spread(places: &[DVec3]) -> [DVec3; 3] {
    let centre = middle(places);
    principal_axes(places.iter().map(|&place| place - centre))
}

fn plane(origin: DVec3, normal: DVec3) -> Option<Carrier> {
    Some(Plane(Frame::new(origin, normal, least_aligned(normal))?).into())
}

/// Through a line of a plane, square to it.
fn upright_plane(frame: &Frame, places: &[DVec3]) -> Option<Carrier> {
    let [.., along] = spread(places);
    let along = along - along.dot(frame.z()) * frame.z();
    plane(middle(places), along.cross(frame.z()))
}

/// Around a circle of a plane, square to it.
fn upright_cylinder(frame: &Frame, places: &[DVec3]) -> Option<Carrier> {
    let centre = middle(places);
    let flat: Vec<DVec2> = places
        .iter()
        .map(|&p| DVec2::new((p - centre).dot(frame.x()), (p - centre).dot(frame.y())))
        .collect();
    let extent = flat.iter().map(|p| p.length()).fold(0.0, f64::max);
    let (at, radius) = circle(&flat, &[], extent)?;
    // any three corners lie on a circle
    let is_round = flat.windows(2).all(|pair| pair[0].distance(pair[1]) <= LONGEST_CHORD * radius);
    if !is_round {
        return None;
    }
    let origin = centre + at.x * frame.x() + at.y * frame.y();
    Some(Cylinder::new(Frame::new(origin, frame.z(), frame.x())?, radius)?.into())
}

/// Across the axis of a cylinder: a circle.
fn across(cylinder: &Cylinder, places: &[DVec3]) -> Option<Carrier> {
    plane(middle(places), cylinder.frame().z())
}

/// Through the axis of a cylinder: a line.
fn along(cylinder: &Cylinder, places: &[DVec3]) -> Option<Carrier> {
    let axis = cylinder.frame().z();
    let from = middle(places) - cylinder.frame().origin();
    plane(cylinder.frame().origin(), axis.cross(from))
}

/// Through a cylinder at any angle: an ellipse.
fn slanted(places: &[DVec3]) -> Option<Carrier> {
    plane(middle(places), spread(places)[0])
}
