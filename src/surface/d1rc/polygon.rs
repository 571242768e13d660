//! Constrained Delaunay triangulation of small polygons by ear clipping.
//!
//! An ear is a corner whose triangle turns left and holds no other corner. Of all ears the one whose circle holds
//! the fewest corners is cut off, of those the one of the best shape, of those the first: for corners in general
//! position that is the constrained Delaunay triangulation. Best shape first would not be: links of clamped
//! knots must be triangulated by nearness (see `links`).

use crate::geometry::{Orientation, is_in_circle, orientation};
use glam::DVec2;

/// The triangles of a simple counter-clockwise polygon, as numbers of its corners; None if it is none.
pub fn triangulate(corners: &[DVec2]) -> Option<Vec<[usize; 3]>> {
    let mut rest: Vec<usize> = (0..corners.len()).collect();
    let mut triangles = Vec::with_capacity(corners.len().saturating_sub(2));
    while rest.len() > 3 {
        let ear = best_ear(corners, &rest)?;
        triangles.push(triangle_at(&rest, ear));
        rest.remove(ear);
    }
    let &[a, b, c] = rest.as_slice() else { return None };
    let is_left = orientation(corners[a], corners[b], corners[c]) == Orientation::Positive;
    is_left.then(|| {
        triangles.push([a, b, c]);
        triangles
    })
}

fn triangle_at(rest: &[usize], ear: usize) -> [usize; 3] {
    let count = rest.len();
    [rest[(ear + count - 1) % count], rest[ear], rest[(ear + 1) % count]]
}

fn best_ear(corners: &[DVec2], rest: &[usize]) -> Option<usize> {
    let mut best: Option<(usize, f64, usize)> = None;
    for ear in 0..rest.len() {
        let numbers = triangle_at(rest, ear);
        let triangle = numbers.map(|corner| corners[corner]);
        let [a, b, c] = triangle;
        if orientation(a, b, c) != Orientation::Positive {
            continue;
        }
        let others = || rest.iter().filter(|corner| !numbers.contains(corner)).map(|&corner| corners[corner]);
        let holds = |p: DVec2| {
            [(a, b), (b, c), (c, a)]
                .iter()
                .all(|&(from, to)| orientation(from, to, p) != Orientation::Negative)
        };
        if others().any(holds) {
            continue;
        }
        let in_circle = others().filter(|&p| is_in_circle(triangle, p)).count();
        let shape = shape(triangle);
        if best.is_none_or(|(count, least, _)| in_circle < count || (in_circle == count && shape > least)) {
            best = Some((in_circle, shape, ear));
        }
    }
    best.map(|(_, _, ear)| ear)
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
