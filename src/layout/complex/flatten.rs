//! The triangles around a node laid flat, so that they stay triangles when the node has gone to its first neighbour.

use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// Least area of the triangles that are left, where the mean length of the edges at the node is 1.
const LEAST_AREA: f64 = 1e-2;
/// With wider angles than this the node would hardly see that side from inside; on the circle, where its triangles
/// would be flat, less is allowed.
const MOST_ANGLE: f64 = 0.98 * PI;
const MOST_ANGLE_ON_CIRCLE: f64 = 0.9 * PI;

/// Places of the ring of a node that lies at the origin. On a border the node with number `straight` lies opposite to the
/// first, and both sides become half discs.
///
/// Angles keep their proportions and lengths go with the same power, z^a: a cone unrolls without distortion of angles.
/// Where the fan around the first place would fold, all lie on a circle: there it never does.
pub(super) fn flattened(node: DVec3, ring: &[DVec3], straight: Option<usize>) -> Vec<DVec2> {
    let count = ring.len();
    let edges: Vec<DVec3> = ring.iter().map(|&other| other - node).collect();
    let mean = edges.iter().map(|edge| edge.length()).sum::<f64>() / count as f64;
    let angle = |k: usize| {
        let (a, b) = (edges[k], edges[(k + 1) % count]);
        a.cross(b).length().atan2(a.dot(b))
    };
    // the numbers at which each part begins, and the angle of all of it
    let parts: Vec<(usize, f64)> = match straight {
        None => vec![(0, TAU)],
        Some(straight) => vec![(0, PI), (straight, PI)],
    };
    let end_of = |part: usize| parts.get(part + 1).map_or(count, |&(next, _)| next);
    let (mut turns, mut even) = (Vec::with_capacity(count), Vec::with_capacity(count));
    // half discs have no common power
    let mut power = 1.0;
    for (part, &(start, whole)) in parts.iter().enumerate() {
        let angles: Vec<f64> = (start..end_of(part)).map(angle).collect();
        let scale = whole / angles.iter().sum::<f64>();
        power = if straight.is_none() { scale } else { 1.0 };
        turns.extend(angles.iter().map(|angle| scale * angle));
        even.extend(angles.iter().map(|_| whole / angles.len() as f64));
    }
    let straightened = |mut places: Vec<DVec2>| {
        if let Some(straight) = straight {
            places[straight].y = 0.0;
        }
        places
    };
    if turns.iter().all(|&turn| turn <= MOST_ANGLE) || straight.is_some() {
        let unrolled = straightened(turned(&turns, |k| (edges[k].length() / mean).powf(power)));
        if is_fan(&unrolled) {
            return unrolled;
        }
    }
    if turns.iter().all(|&turn| turn <= MOST_ANGLE_ON_CIRCLE) {
        let round = straightened(turned(&turns, |_| 1.0));
        if is_fan(&round) {
            return round;
        }
    }
    straightened(turned(&even, |_| 1.0))
}

/// Places after turns by these angles.
fn turned(angles: &[f64], radius: impl Fn(usize) -> f64) -> Vec<DVec2> {
    let mut angle = 0.0;
    let place = |(k, turn): (usize, &f64)| {
        let place = radius(k) * DVec2::from_angle(angle);
        angle += turn;
        place
    };
    angles.iter().enumerate().map(place).collect()
}

/// Whether the triangles around the first place are positive, and wide enough to find places in them.
fn is_fan(places: &[DVec2]) -> bool {
    let from_first = |k: usize| places[k] - places[0];
    (1..places.len() - 1).all(|k| from_first(k).perp_dot(from_first(k + 1)) > LEAST_AREA)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::Random;

    #[test]
    fn every_star_becomes_a_fan() {
        let mut random = Random::new(1);
        for round in 0..2000 {
            let count = 3 + (7.0 * random.unit()) as usize;
            // from flat to needles and saddles, and rings that turn back on themselves
            let size = [1.0, 1e-3, 0.0][round % 3];
            let ring: Vec<DVec3> = (0..count)
                .map(|k| {
                    let angle = TAU * k as f64 / count as f64 + random.signed();
                    let length = 10.0_f64.powf(random.signed());
                    DVec3::new(length * angle.cos(), size * length * angle.sin(), random.signed())
                })
                .collect();
            let flat = flattened(DVec3::ZERO, &ring, None);
            let from_first = |k: usize| flat[k] - flat[0];
            assert!((1..count - 1).all(|k| from_first(k).perp_dot(from_first(k + 1)) > 0.0), "{flat:?}");
            // the node itself sees all sides from inside
            assert!((0..count).all(|k| flat[k].perp_dot(flat[(k + 1) % count]) > 0.0), "{flat:?}");
        }
    }

    #[test]
    fn a_plane_stays_as_it_is() {
        let ring = [DVec3::X, DVec3::Y, DVec3::new(-1.0, -0.2, 0.0), DVec3::new(0.3, -1.0, 0.0)];
        let flat = flattened(DVec3::ZERO, &ring, None);
        let mean = ring.iter().map(|p| p.length()).sum::<f64>() / 4.0;
        for (p, q) in ring.iter().zip(&flat) {
            // angles by inverse functions, a few roundings
            assert!(p.truncate().distance(*q * mean) <= 1e-14, "{p} {q}");
        }
    }
}
