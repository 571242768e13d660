//! Constrained Delaunay triangulation of polygons: of small ones by ear clipping, of others by the crate `spade`.
//!
//! An ear is a corner whose triangle turns left and holds no other corner. Of all ears the one whose circle holds
//! the fewest corners is cut off, of those the one of the best shape, of those the first: for a convex polygon with
//! corners in general position that is the constrained Delaunay triangulation, for others nearly. Best shape first would not be: links of clamped
//! knots must be triangulated by nearness (see `links`).

use crate::geometry::{Orientation, is_in_circle, orientation};
use crate::memory::{self, CollectVec};
use glam::DVec2;
use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation, mitigate_underflow};

/// Bytes of a point in spade's triangulation.
const PLANE_BYTES: usize = 200;
/// Ears are cut off polygons of so many corners, which takes quadratic time. The two ways may differ where polygons are not
/// convex and where corners lie on a circle; hardly a mesh has larger ones.
const MOST_CORNERS: usize = 64;

/// The triangles of a simple counter-clockwise polygon, as numbers of its corners; None if it is none.
pub(super) fn triangulate(corners: &[DVec2]) -> Option<Vec<[usize; 3]>> {
    if corners.len() <= MOST_CORNERS { cut_ears(corners) } else { delaunay(corners) }
}

/// In the time of a sort.
fn delaunay(corners: &[DVec2]) -> Option<Vec<[usize; 3]>> {
    let count = corners.len();
    memory::ensure(PLANE_BYTES.saturating_mul(count));
    let points = corners.iter().map(|p| mitigate_underflow(Point2::new(p.x, p.y))).collect_vec();
    let sides = (0..count).map(|k| [k, (k + 1) % count]).collect_vec();
    let plane =
        ConstrainedDelaunayTriangulation::<Point2<f64>>::try_bulk_load_cdt(points, sides, |_| {}).ok()?;
    if plane.num_vertices() != count || plane.num_constraints() != count {
        return None; // corners or sides meet
    }
    let [first, second] = [0, 1].map(FixedVertexHandle::from_index);
    let start = plane.get_edge_from_neighbors(first, second)?.face().as_inner()?;
    let mut seen = memory::filled(false, plane.num_all_faces());
    let mut open = vec![start];
    let mut triangles = memory::with_capacity(count.saturating_sub(2));
    while let Some(face) = open.pop() {
        if std::mem::replace(&mut seen[face.fix().index()], true) {
            continue;
        }
        memory::push(&mut triangles, face.vertices().map(|vertex| vertex.fix().index()));
        for side in face.adjacent_edges().into_iter().filter(|side| !side.is_constraint_edge()) {
            memory::push(&mut open, side.rev().face().as_inner()?);
        }
    }
    // clockwise it is a part of the outside
    (triangles.len() + 2 == count).then_some(triangles)
}

fn cut_ears(corners: &[DVec2]) -> Option<Vec<[usize; 3]>> {
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
    use crate::samples::Random;

    fn area(corners: &[DVec2]) -> f64 {
        let next = corners.iter().cycle().skip(1);
        corners.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum()
    }

    #[test]
    fn triangles_fill_a_star_and_keep_its_borders() {
        for count in [14, 200] {
            let corner = |k: usize| {
                let radius = if k.is_multiple_of(2) { 3.0 } else { 1.0 };
                radius * DVec2::from_angle(0.3 + std::f64::consts::TAU * k as f64 / count as f64)
            };
            let star: Vec<DVec2> = (0..count).map(corner).collect();
            let triangles = triangulate(&star).unwrap();
            assert_eq!(triangles.len(), count - 2);
            let filled: f64 = triangles.iter().map(|t| area(&t.map(|corner| star[corner]))).sum();
            assert!((filled - area(&star)).abs() <= count as f64 * f64::EPSILON * area(&star));
        }
    }

    #[test]
    fn both_ways_give_the_same_triangles_of_a_convex_polygon() {
        let mut random = Random::new(11);
        for count in [5, 20, 64, 65, 200] {
            let corner = |k: usize| {
                let turn = (k as f64 + 0.5 * random.unit()) / count as f64;
                DVec2::new(2.0, 1.0) * DVec2::from_angle(std::f64::consts::TAU * turn)
            };
            let oval: Vec<DVec2> = (0..count).map(corner).collect();
            let sorted = |triangles: Option<Vec<[usize; 3]>>| {
                let mut all = triangles.unwrap();
                all.iter_mut().for_each(|triangle| {
                    let least = (0..3).min_by_key(|&k| triangle[k]).unwrap();
                    triangle.rotate_left(least);
                });
                all.sort_unstable();
                all
            };
            assert_eq!(sorted(cut_ears(&oval)), sorted(delaunay(&oval)), "{count} corners");
            let reversed: Vec<DVec2> = oval.iter().rev().copied().collect();
            assert_eq!(delaunay(&reversed), None, "{count} corners");
        }
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
        assert_eq!(delaunay(&square), None);
        let bow = [(0., 0.), (1., 1.), (1., 0.), (0., 1.)].map(DVec2::from);
        assert_eq!(triangulate(&bow), None);
        assert_eq!(delaunay(&bow), None);
        // a corner twice, a corner on a side
        let twice = [(0., 0.), (2., 0.), (1., 1.), (2., 2.), (0., 2.), (1., 1.)].map(DVec2::from);
        assert_eq!(delaunay(&twice), None);
        let beside = [(0., 0.), (4., 0.), (4., 4.), (2., 0.), (0., 4.)].map(DVec2::from);
        assert_eq!(delaunay(&beside), None);
        assert_eq!(triangulate(&square[..2]), None);
    }
}
