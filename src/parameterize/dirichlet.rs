//! The symmetric Dirichlet energy of the triangles around one node, and a step that lowers it.
//!
//! J. Schreiner, A. Asirvatham, E. Praun, H. Hoppe, "Inter-surface mapping" (2004); J. Smith, S. Schaefer, "Bijective
//! parameterization with free boundaries" (2015). For a triangle of area A in space, mapped with the Jacobian J:
//! ```text
//! E = A (|J|^2 + |J^-1|^2) = A |J|^2 (1 + 1/det^2),    det = det J
//! A |J|^2 = (cot_x |a - b|^2 + cot_a |x - b|^2 + cot_b |x - a|^2) / 2,    det = x . (a x b) / 2A
//! ```
//! with the images x of the node and a, b of the other two, and the angles in space. E is at least 4 A, which is an
//! isometry, and infinite where the triangle turns over: a step that keeps E finite folds nothing.
//!
//! On the unit sphere det is taken of the cone over the image, not of the chord's area: it vanishes exactly when the
//! triangle turns over. In a plane, places are homogeneous, (u, v, 1), and the same formula is twice the area. In both
//! cases det is linear in x and A |J|^2 quadratic, so gradient and Hessian are
//! ```text
//! g = w q - 2 e/det^3 n,                               q = cot_a (x - b) + cot_b (x - a),   w = 1 + 1/det^2
//! H = w (cot_a + cot_b) - 2/det^3 (q n^T + n q^T) + 6 e/det^4 n n^T,    n = (a x b) / 2A,   e = A |J|^2
//! ```
//! in tangent coordinates; on the sphere minus (x . g) for its curvature.

use crate::linalg::Symmetric2;
use crate::memory;
use glam::{DVec2, DVec3};

/// A triangle has at least this much of its longest edge squared as its area: slivers count as if they were wider, or
/// a few of them would rule the map.
const LEAST_AREA_SHARE: f64 = 0.01;
/// Below this ratio of areas a triangle counts as turned over: rounding has more than its sign.
const LEAST_DET: f64 = 1e-9;
/// Above this ratio of areas a triangle is well clear of turning over.
const CLEAR_DET: f64 = 0.1;
/// Shortest step tried, as a power of [`SHORTER`].
const TRIES: usize = 16;
/// A step that does not lower the energy is cut to this.
const SHORTER: f64 = 0.4;
/// Steps that promise less than this share of the energy are not worth their rounding.
const LEAST_GAIN: f64 = 1e-13;

/// A triangle in space, as its map sees it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Shape {
    /// Cotangents at its three corners.
    cotangents: [f64; 3],
    area: f64,
    /// Whether it is a sliver that counts as wider.
    pub is_clamped: bool,
}

impl Shape {
    /// `area_scale`: area of the image of all by area in space of all.
    pub(crate) fn new([p, q, r]: [DVec3; 3], area_scale: f64) -> Self {
        let (pq, pr, qr) = (q - p, r - p, r - q);
        let longest_sq = pq.length_squared().max(pr.length_squared()).max(qr.length_squared());
        let double_area = pq.cross(pr).length();
        let least = (2.0 * LEAST_AREA_SHARE * longest_sq).max(f64::MIN_POSITIVE);
        let clamped = double_area.max(least);
        let cotangents = [pq.dot(pr), -pq.dot(qr), pr.dot(qr)].map(|product| product / clamped);
        Self { cotangents, area: 0.5 * clamped * area_scale, is_clamped: double_area < least }
    }

    /// E of the triangle, infinite if its image is turned over.
    pub(crate) fn energy(&self, [x, a, b]: [DVec3; 3]) -> f64 {
        Image::new(self, a, b).energy(x)
    }
}

/// A triangle at the node, all but the node's own place.
#[derive(Debug, Clone, Copy)]
struct Image {
    a: DVec3,
    b: DVec3,
    cot_a: f64,
    cot_b: f64,
    /// cot_x |a - b|^2.
    opposite: f64,
    /// n.
    normal: DVec3,
    area: f64,
}

impl Image {
    fn new(shape: &Shape, a: DVec3, b: DVec3) -> Self {
        let [cot_x, cot_a, cot_b] = shape.cotangents;
        let opposite = cot_x * a.distance_squared(b);
        Self { a, b, cot_a, cot_b, opposite, normal: a.cross(b) * (0.5 / shape.area), area: shape.area }
    }

    /// A |J|^2.
    fn dirichlet(&self, x: DVec3) -> f64 {
        let sides = self.cot_a * x.distance_squared(self.b) + self.cot_b * x.distance_squared(self.a);
        (0.5 * (self.opposite + sides)).max(f64::MIN_POSITIVE)
    }

    fn energy(&self, x: DVec3) -> f64 {
        let det = x.dot(self.normal);
        if det > LEAST_DET { self.dirichlet(x) * (1.0 + 1.0 / (det * det)) } else { f64::INFINITY }
    }
}

/// Where images lie.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Target {
    /// On the unit sphere.
    Sphere,
    /// In the plane of the (u, v, 1).
    Plane,
}

impl Target {
    /// Two orthogonal unit directions in which a place may move.
    fn directions(self, x: DVec3) -> [DVec3; 2] {
        match self {
            Self::Sphere => {
                let (first, second) = x.any_orthonormal_pair();
                [first, second]
            }
            Self::Plane => [DVec3::X, DVec3::Y],
        }
    }

    fn moved(self, x: DVec3, step: DVec3) -> DVec3 {
        match self {
            Self::Sphere => (x + step).normalize(),
            Self::Plane => x + step,
        }
    }
}

/// The triangles around a node with the images of their other corners.
#[derive(Debug, Clone, Default)]
pub(crate) struct Star {
    triangles: Vec<Image>,
}

impl Star {
    pub(crate) fn clear(&mut self) {
        self.triangles.clear();
    }

    /// A triangle whose first corner is the node; `a` and `b` are the images of the others.
    pub(crate) fn push(&mut self, shape: &Shape, a: DVec3, b: DVec3) {
        memory::push(&mut self.triangles, Image::new(shape, a, b));
    }

    /// E with the node at `x`.
    pub(crate) fn energy(&self, x: DVec3) -> f64 {
        self.triangles.iter().map(|triangle| triangle.energy(x)).sum()
    }

    /// The area by which triangles are turned over, or nearly so: convex in `x`, 0 where all are well clear of it.
    pub(crate) fn turned_area(&self, x: DVec3) -> f64 {
        let turned = |triangle: &Image| triangle.area * (CLEAR_DET - x.dot(triangle.normal)).max(0.0);
        self.triangles.iter().map(turned).sum()
    }

    /// The images around the node.
    pub(crate) fn corners(&self) -> impl Iterator<Item = DVec3> + '_ {
        self.triangles.iter().map(|triangle| triangle.a)
    }

    /// One guarded Newton step from `x`: a place that `accepts` takes and that has less energy; none if there is none.
    pub(crate) fn step(&self, x: DVec3, target: Target, accepts: impl Fn(DVec3) -> bool) -> Option<DVec3> {
        let before = self.energy(x);
        let directions = target.directions(x);
        let along = |step: DVec2| target.moved(x, step.x * directions[0] + step.y * directions[1]);
        let (gradient, step) = self.newton_step(x, target, directions)?;
        if -gradient.dot(step) < LEAST_GAIN * before && before.is_finite() {
            return None;
        }
        let lengths = std::iter::successors(Some(1.0), |length| Some(SHORTER * length)).take(TRIES);
        lengths.map(|length| along(length * step)).find(|&y| self.energy(y) < before && accepts(y))
    }

    /// Gradient and Newton step in tangent coordinates; the Hessian is shifted until it is positive.
    fn newton_step(&self, x: DVec3, target: Target, [s, t]: [DVec3; 2]) -> Option<(DVec2, DVec2)> {
        let (mut gradient, mut outward) = (DVec2::ZERO, 0.0);
        let (mut ss, mut st, mut tt) = (0.0, 0.0, 0.0);
        for triangle in &self.triangles {
            let det = x.dot(triangle.normal);
            let inverse_sq = 1.0 / (det * det);
            let e = triangle.dirichlet(x);
            let weight = 1.0 + inverse_sq;
            let q = triangle.cot_a * (x - triangle.b) + triangle.cot_b * (x - triangle.a);
            let n = triangle.normal;
            let (cross, square) = (2.0 * inverse_sq / det, 6.0 * e * inverse_sq * inverse_sq);
            let g = weight * q - e * cross * n;
            let (qs, qt, ns, nt) = (q.dot(s), q.dot(t), n.dot(s), n.dot(t));
            let diagonal = weight * (triangle.cot_a + triangle.cot_b);
            gradient += DVec2::new(g.dot(s), g.dot(t));
            outward += x.dot(g);
            ss += diagonal - 2.0 * cross * qs * ns + square * ns * ns;
            tt += diagonal - 2.0 * cross * qt * nt + square * nt * nt;
            st += square * ns * nt - cross * (qs * nt + qt * ns);
        }
        if target == Target::Sphere {
            (ss, tt) = (ss - outward, tt - outward);
        }
        /// The least eigenvalue must be this share of the trace.
        const LEAST_EIGENVALUE: f64 = 1e-3;
        let hessian = Symmetric2 { uu: ss, uv: st, vv: tt };
        let shift = (LEAST_EIGENVALUE * hessian.trace().abs() - hessian.least_eigenvalue()).max(0.0);
        let step = hessian.shifted(shift).solve(-gradient);
        (step.is_finite() && gradient.dot(step) < 0.0).then_some((gradient, step))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::Random;
    use std::f64::consts::TAU;

    /// A node among `n` others around it, on the sphere or in the plane, with a shape of its own in space.
    fn star(n: usize, target: Target, random: &mut Random) -> (Star, DVec3) {
        let place = |at: DVec2| match target {
            Target::Sphere => DVec3::new(at.x, at.y, 1.0).normalize(),
            Target::Plane => at.extend(1.0),
        };
        let rim: Vec<DVec2> = (0..n)
            .map(|k| {
                let angle = TAU * (k as f64 + 0.3 * random.unit()) / n as f64;
                (0.2 + 0.1 * random.unit()) * DVec2::from_angle(angle)
            })
            .collect();
        let mut star = Star::default();
        for k in 0..n {
            let [a, b] = [rim[k], rim[(k + 1) % n]];
            let height = |p: DVec2| DVec3::new(1.3 * p.x, 0.8 * p.y, 0.5 * p.x * p.y);
            let shape = Shape::new([DVec3::ZERO, height(a), height(b)], 1.0);
            star.push(&shape, place(a), place(b));
        }
        (star, place(DVec2::new(0.02, -0.01)))
    }

    #[test]
    fn the_newton_step_solves_for_the_differences_of_the_energy() {
        let mut random = Random::new(3);
        for target in [Target::Sphere, Target::Plane] {
            let (star, x) = star(6, target, &mut random);
            let [s, t] = target.directions(x);
            let (gradient, step) = star.newton_step(x, target, [s, t]).unwrap();
            let energy = |a: f64, b: f64| star.energy(target.moved(x, a * s + b * t));
            // central differences: the energies are about 1 and smooth over the ring's radius of 0.2
            let h = 1e-4;
            let slope =
                DVec2::new(energy(h, 0.0) - energy(-h, 0.0), energy(0.0, h) - energy(0.0, -h)) / (2.0 * h);
            assert!(slope.distance(gradient) <= 1e-4 * gradient.length(), "{slope} {gradient}");
            let second = |p: (f64, f64), m: (f64, f64)| {
                (energy(p.0, p.1) - 2.0 * energy(0.0, 0.0) + energy(m.0, m.1)) / (h * h)
            };
            let (ss, tt) = (second((h, 0.0), (-h, 0.0)), second((0.0, h), (0.0, -h)));
            let st = 0.5 * (second((h, h), (-h, -h)) - ss - tt);
            let residual = DVec2::new(ss * step.x + st * step.y, st * step.x + tt * step.y) + gradient;
            assert!(residual.length() <= 1e-3 * gradient.length(), "{residual} {gradient}");
        }
    }

    #[test]
    fn steps_lower_the_energy_and_end_where_it_is_least() {
        let mut random = Random::new(5);
        for target in [Target::Sphere, Target::Plane] {
            let (star, mut x) = star(7, target, &mut random);
            let mut energy = star.energy(x);
            while let Some(y) = star.step(x, target, |_| true) {
                assert!(star.energy(y) < energy);
                (x, energy) = (y, star.energy(y));
            }
            let [s, t] = target.directions(x);
            for direction in [s, -s, t, -t] {
                assert!(star.energy(target.moved(x, 1e-3 * direction)) > energy);
            }
            assert_eq!(star.step(x, target, |_| false), None);
        }
    }

    #[test]
    fn an_isometry_has_four_times_its_area() {
        let corners = [DVec2::ZERO, DVec2::X, DVec2::new(0.3, 0.8)];
        let shape = Shape::new(corners.map(|p| p.extend(0.0)), 1.0);
        let energy = shape.energy(corners.map(|p| p.extend(1.0)));
        assert!((energy - 4.0 * 0.4).abs() <= 16.0 * f64::EPSILON, "{energy}");
        let turned = [corners[0], corners[2], corners[1]];
        assert_eq!(shape.energy(turned.map(|p| p.extend(1.0))), f64::INFINITY);
        let sliver = Shape::new([DVec3::ZERO, DVec3::X, DVec3::new(0.5, 1e-3, 0.0)], 1.0);
        assert!(sliver.is_clamped && !shape.is_clamped);
    }
}
