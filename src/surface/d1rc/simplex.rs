//! Simplex splines: shadows of simplices in the plane.
//!
//! C. A. Micchelli, "A constructive approach to Kergin interpolation in R^k" (1980); in the notation of J. Cao,
//! J. Zheng (2016), (2.2) and (2.3), whose `M_0` needs the absolute value:
//! ```text
//! M_0(t|a,b,c) = chi / |det(a,b,c)|,  0 for collinear knots           det(a,b,c) = (b - a) x (c - a)
//! M_d(t|U)     = sum_j lambda_j(t|W) M_(d-1)(t|U \ w_j)              |U| = d + 3, W three knots of U
//! D_y M_d      = d sum_j mu_j M_(d-1)(t|U \ w_j),  y = sum mu_j w_j, sum mu_j = 0
//! ```
//! W is the triangle of largest area. Knots may be repeated and collinear. This is the definition, for any knots;
//! `kernel` is the fast way for knots in general position.
//!
//! On lines between knots the value is the limit from one side, the same for all functions: from
//! `t + eps toward + eps^2 across`, `across` to the left of `toward`.

use crate::geometry::signed_area;
use glam::DVec2;

/// Most knots of one simplex spline: degree 3.
pub const MAX_KNOTS: usize = 6;

/// A point, and the side from which limits are taken there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Site {
    /// The point.
    pub t: DVec2,
    /// Any direction that is not zero.
    pub toward: DVec2,
}

impl Site {
    /// A point inside a domain: the limit comes from the right, then from above.
    pub fn new(t: DVec2) -> Self {
        Self { t, toward: DVec2::X }
    }

    /// On which side of the line from `a` to `b` the point counts: 1 left, -1 right.
    fn side(&self, a: DVec2, b: DVec2) -> f64 {
        let along = b - a;
        let sides = [signed_area(a, b, self.t), along.perp_dot(self.toward), along.dot(self.toward)];
        sides.into_iter().find(|&side| side != 0.0).map_or(0.0, f64::signum)
    }

    /// Whether the point counts as inside a triangle, whatever the turn of its corners.
    pub fn is_in(&self, [a, b, c]: [DVec2; 3]) -> bool {
        let side = self.side(a, b);
        side == self.side(b, c) && side == self.side(c, a)
    }
}

/// `M_d` at a point, of the degree `d = knots.len() - 3`.
pub fn simplex_spline(site: &Site, knots: &[DVec2]) -> f64 {
    let Some((w, area)) = widest_triangle(knots) else { return 0.0 };
    if knots.len() == 3 {
        return if site.is_in([knots[0], knots[1], knots[2]]) { 1.0 / area.abs() } else { 0.0 };
    }
    let weights = barycentric(site.t, w.map(|j| knots[j]), area);
    (0..3).map(|j| weights[j] * simplex_spline(site, Without::new(knots, w[j]).as_slice())).sum()
}

/// The gradient of `M_d`; zero for `d = 0`.
pub fn simplex_gradient(site: &Site, knots: &[DVec2]) -> DVec2 {
    let degree = knots.len() - 3;
    let Some((w, area)) = widest_triangle(knots).filter(|_| degree > 0) else { return DVec2::ZERO };
    let gradients = barycentric_gradients(w.map(|j| knots[j]), area);
    let each = (0..3).map(|j| gradients[j] * simplex_spline(site, Without::new(knots, w[j]).as_slice()));
    degree as f64 * each.sum::<DVec2>()
}

/// Three knots that span the largest area, and twice that area with its sign; None if all are collinear.
pub fn widest_triangle(knots: &[DVec2]) -> Option<([usize; 3], f64)> {
    let mut widest = ([0; 3], 0.0_f64);
    for a in 0..knots.len() {
        for b in a + 1..knots.len() {
            for c in b + 1..knots.len() {
                let area = signed_area(knots[a], knots[b], knots[c]);
                if area.abs() > widest.1.abs() {
                    widest = ([a, b, c], area);
                }
            }
        }
    }
    (widest.1 != 0.0).then_some(widest)
}

fn barycentric(t: DVec2, [a, b, c]: [DVec2; 3], area: f64) -> [f64; 3] {
    [signed_area(b, c, t), signed_area(c, a, t), signed_area(a, b, t)].map(|part| part / area)
}

/// The gradients of the barycentric coordinates of a triangle, which is twice `area` large.
pub fn barycentric_gradients([a, b, c]: [DVec2; 3], area: f64) -> [DVec2; 3] {
    [c - b, a - c, b - a].map(|side| side.perp() / area)
}

/// Knots without one of them.
struct Without {
    knots: [DVec2; MAX_KNOTS],
    count: usize,
}

impl Without {
    fn new(knots: &[DVec2], left_out: usize) -> Self {
        let mut kept = [DVec2::ZERO; MAX_KNOTS];
        kept[..left_out].copy_from_slice(&knots[..left_out]);
        kept[left_out..knots.len() - 1].copy_from_slice(&knots[left_out + 1..]);
        Self { knots: kept, count: knots.len() - 1 }
    }

    fn as_slice(&self) -> &[DVec2] {
        &self.knots[..self.count]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(t: [f64; 2], knots: &[[f64; 2]]) -> f64 {
        let knots: Vec<DVec2> = knots.iter().map(|&knot| DVec2::from(knot)).collect();
        simplex_spline(&Site::new(DVec2::from(t)), &knots)
    }

    #[test]
    fn values_are_the_exact_fractions() {
        const SQUARE: [[f64; 2]; 4] = [[0., 0.], [4., 0.], [4., 4.], [0., 4.]];
        const TENT: [[f64; 2]; 4] = [[0., 0.], [4., 0.], [0., 4.], [1., 1.]];
        const COLLINEAR: [[f64; 2]; 4] = [[0., 0.], [2., 0.], [4., 0.], [0., 4.]];
        for (t, knots, value) in [
            ([2., 1.], SQUARE, 1. / 64.),
            ([2., 2.], SQUARE, 1. / 32.),
            ([1., 1.], TENT, 1. / 16.),
            ([2., 1.], TENT, 1. / 32.),
            ([2., 0.], COLLINEAR, 1. / 16.),
            ([1., 1.], COLLINEAR, 1. / 32.),
        ] {
            assert_eq!(at(t, &knots), value, "{t:?} {knots:?}"); // small integers: nothing is rounded
        }
        let five = [SQUARE[0], SQUARE[1], SQUARE[2], SQUARE[3], [2., 1.]];
        assert!((at([2., 2.], &five) - 1. / 48.).abs() <= 4.0 * f64::EPSILON / 48.);
    }

    #[test]
    fn triangles_share_their_borders() {
        // a fan around the origin: each of its points belongs to exactly one triangle
        let ring = [[3., 0.], [0., 3.], [-3., 0.], [0., -3.]].map(DVec2::from);
        for t in [[0., 0.], [1., 0.], [0., 1.], [-1., 0.], [0., -1.], [1., 1.]].map(DVec2::from) {
            let site = Site::new(t);
            let count = (0..4).filter(|&k| site.is_in([DVec2::ZERO, ring[k], ring[(k + 1) % 4]])).count();
            assert_eq!(count, 1, "{t}");
        }
    }

    #[test]
    fn knots_on_one_line_give_nothing() {
        assert_eq!(at([1., 1.], &[[0., 0.], [1., 1.], [2., 2.], [5., 5.]]), 0.0);
        assert_eq!(at([0., 0.], &[[0., 0.]; 5]), 0.0);
    }
}
