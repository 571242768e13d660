//! Where a node enters the map.
//!
//! The ring of the node lies on the sphere, and all of it is seen from its first node, whose triangles were positive:
//! ```text
//!      q3 --- q2
//!     /         \        A place sees the edge q_k q_(k+1) from inside if it lies on the positive side of the
//!   q4     *     q1      great circle through it, n_k . x > 0. Near u only the two edges at u matter: the walk
//!     \   :     /        starts along their bisector, and its length is the one with the largest least distance.
//!      `-- u --'
//! ```
//! A few steps of ascent then lead away from the nearest circles. More than a few do not improve the final map and take
//! most of the time on shapes with long limbs.

use crate::memory::CollectVec;
use glam::DVec3;

/// Each length tried is this part of the one before.
const SHORTER: f64 = 0.6;
/// Shortest walk: rounding has more beyond.
const LEAST_WALK: f64 = 1e-12;
/// Steps of ascent.
const ASCENTS: usize = 8;
/// The first step of ascent, in twice the present least distance.
const FIRST_ASCENT: f64 = 0.5;
/// The last.
const LEAST_ASCENT: f64 = 0.1;

/// A place on the positive side of all edges of a ring; none if rounding leaves none.
pub(super) fn inside(ring: &[DVec3]) -> Option<DVec3> {
    let count = ring.len();
    let circle = |k: usize| ring[k].cross(ring[(k + 1) % count]).try_normalize();
    let circles: Vec<DVec3> = (0..count).map(circle).collect::<Option<_>>()?;
    let (place, distance) = walk(ring[0], &circles)?;
    Some(ascend(place, distance, &circles))
}

/// The least distance to the circles, positive inside all of them.
fn least(place: DVec3, circles: &[DVec3]) -> f64 {
    circles.iter().map(|circle| circle.dot(place)).fold(f64::INFINITY, f64::min)
}

/// From `start` into the angle between its edges, as far as the least distance grows.
fn walk(start: DVec3, circles: &[DVec3]) -> Option<(DVec3, f64)> {
    let (before, after) = (circles[circles.len() - 1], circles[0]);
    // where the two circles nearly coincide the bisector may miss the inside: other directions between them
    [0.5, 0.3, 0.7, 0.1, 0.9, 0.02, 0.98].into_iter().find_map(|share| {
        let toward = before.lerp(after, share);
        let direction = toward.reject_from_normalized(start).try_normalize()?;
        let lengths = std::iter::successors(Some(1.0), |length| Some(SHORTER * length));
        let mut best: Option<(DVec3, f64)> = None;
        for length in lengths.take_while(|&length| length > LEAST_WALK) {
            let place = (start + length * direction).normalize();
            let distance = least(place, circles);
            if distance > best.map_or(0.0, |(_, most)| most) {
                best = Some((place, distance));
            } else if best.is_some() {
                break;
            }
        }
        best
    })
}

/// Away from the nearest circle, or from the nearest two or three together.
fn ascend(mut place: DVec3, mut distance: f64, circles: &[DVec3]) -> DVec3 {
    let mut length = FIRST_ASCENT;
    let mut nearest: Vec<usize> = (0..circles.len()).collect_vec();
    for _ in 0..ASCENTS {
        nearest.sort_unstable_by(|&i, &j| {
            circles[i].dot(place).total_cmp(&circles[j].dot(place)).then(i.cmp(&j))
        });
        let mut direction = DVec3::ZERO;
        let better = nearest.iter().take(3).find_map(|&k| {
            direction += circles[k];
            let moved = (place + 2.0 * length * distance * direction).normalize();
            let reached = least(moved, circles);
            (reached > distance).then_some((moved, reached))
        });
        match better {
            Some(better) => (place, distance) = better,
            None if length <= LEAST_ASCENT => break,
            None => length *= 0.5,
        }
    }
    place
}
