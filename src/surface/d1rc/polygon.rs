//! Constrained Delaunay triangulation of small polygons by ear clipping.
//!
//! An ear is a corner whose triangle turns left and holds no other corner. Of all ears the one whose circle holds
//! the fewest corners is cut off, of those the one of the best shape, of those the first: for corners in general
//! position that is the constrained Delaunay triangulation. Best shape first would not be: links of clamped
//! knots must be triangulated by nearness (see `links`).

use crate::geometry::{Orientation, is_in_circle, orientation};
use crate::memory::{self, CollectVec};
use glam::DVec2;

/// The triangles of a simple counter-clockwise polygon, as numbers of its corners; None if it is none. Quadratic time in
/// the number of corners.
pub(super) fn triangulate(corners: &[DVec2]) -> Option<Vec<[usize; 3]>> {
    let mut rest: Vec<usize> = (0..corners.len()).collect_vec();
    let mut ears: Vec<Ear> = rest.iter().map(|&at| Ear::new(corners, &rest, at)).collect_vec();
    let mut triangles = memory::with_capacity(corners.len().saturating_sub(2));
    while rest.len() > 3 {
        let cut = best_ear(&ears)?;
        memory::push(&mut triangles, ears[cut].corners);
        let gone = rest.remove(cut);
        ears.remove(cut);
        ears.iter_mut().for_each(|ear| ear.forget(gone, corners[gone]));
        // the neighbours have other triangles now
        for beside in [(cut + rest.len() - 1) % rest.len(), cut % rest.len()] {
            ears[beside] = Ear::new(corners, &rest, beside);
        }
    }
    let &[a, b, c] = rest.as_slice() else { return None };
    let is_left = orientation(corners[a], corners[b], corners[c]) == Orientation::Positive;
    is_left.then(|| {
        memory::push(&mut triangles, [a, b, c]);
        triangles
    })
}

/// A corner with the ones before and after it.
struct Ear {
    corners: [usize; 3],
    triangle: [DVec2; 3],
    turns_left: bool,
    /// Other corners in the triangle.
    held: usize,
    /// Other corners in its circle.
    in_circle: usize,
    shape: f64,
}

impl Ear {
    /// At a place of the polygon that is left.
    fn new(all: &[DVec2], rest: &[usize], at: usize) -> Self {
        let count = rest.len();
        let corners = [rest[(at + count - 1) % count], rest[at], rest[(at + 1) % count]];
        let triangle = corners.map(|corner| all[corner]);
        let [a, b, c] = triangle;
        let turns_left = orientation(a, b, c) == Orientation::Positive;
        let mut ear = Self { corners, triangle, turns_left, held: 0, in_circle: 0, shape: shape(triangle) };
        if turns_left {
            for &corner in rest.iter().filter(|corner| !corners.contains(corner)) {
                ear.held += usize::from(ear.holds(all[corner]));
                ear.in_circle += usize::from(is_in_circle(triangle, all[corner]));
            }
        }
        ear
    }

    fn holds(&self, p: DVec2) -> bool {
        let [a, b, c] = self.triangle;
        [(a, b), (b, c), (c, a)].iter().all(|&(from, to)| orientation(from, to, p) != Orientation::Negative)
    }

    /// Another corner has been cut off.
    fn forget(&mut self, corner: usize, place: DVec2) {
        if self.turns_left && !self.corners.contains(&corner) {
            self.held -= usize::from(self.holds(place));
            self.in_circle -= usize::from(is_in_circle(self.triangle, place));
        }
    }
}

fn best_ear(ears: &[Ear]) -> Option<usize> {
    let mut best: Option<(usize, &Ear)> = None;
    for (at, ear) in ears.iter().enumerate().filter(|(_, ear)| ear.turns_left && ear.held == 0) {
        let is_better = |other: &Ear| {
            ear.in_circle < other.in_circle || (ear.in_circle == other.in_circle && ear.shape > other.shape)
        };
        if best.is_none_or(|(_, other)| is_better(other)) {
            best = Some((at, ear));
        }
    }
    best.map(|(at, _)| at)
}

/// Area against squared sides: largest for the equilateral triangle.
fn shape([a, b, c]: [DVec2; 3]) -> f64 {
    (b - a).perp_dot(c - a) / (a.distance_squared(b) + b.distance_squared(c) + c.distance_squared(a))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(corners: &[DVec2]) -> f64 {
        let next = corners.iter().cycle().skip(1);
        corners.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum()
    }

    #[test]
    fn triangles_fill_a_star_and_keep_its_borders() {
        let corner = |k: usize| {
            let radius = if k.is_multiple_of(2) { 3.0 } else { 1.0 };
            radius * DVec2::from_angle(0.3 + std::f64::consts::TAU * k as f64 / 14.0)
        };
        let star: Vec<DVec2> = (0..14).map(corner).collect();
        let triangles = triangulate(&star).unwrap();
        assert_eq!(triangles.len(), 12);
        let filled: f64 = triangles.iter().map(|t| area(&t.map(|corner| star[corner]))).sum();
        assert!((filled - area(&star)).abs() <= 14.0 * f64::EPSILON * area(&star));
    }

    #[test]
    fn the_diagonal_of_a_kite_is_the_short_one() {
        let kite = [(0., 0.), (5., -1.), (10., 0.), (5., 1.)].map(DVec2::from);
        let triangles = triangulate(&kite).unwrap();
        assert!(triangles.iter().all(|t| t.contains(&1) && t.contains(&3)), "{triangles:?}");
    }

    #[test]
    fn reversed_and_crossing_polygons_are_refused() {
        let square = [(0., 0.), (0., 1.), (1., 1.), (1., 0.)].map(DVec2::from);
        assert_eq!(triangulate(&square), None);
        let bow = [(0., 0.), (1., 1.), (1., 0.), (0., 1.)].map(DVec2::from);
        assert_eq!(triangulate(&bow), None);
        assert_eq!(triangulate(&square[..2]), None);
    }
}
