//! Bezier patches: the polynomial or rational pieces of a surface over rectangles of parameters.
//!
//! L. Ramshaw, "Blossoms are polar forms", Comput. Aided Geom. Des. 6 (1989), 323-358: the ordinates of a
//! polynomial over `[a, b]` are the values of its blossom, a symmetric function linear in each argument, at
//! ```text
//! b_j = f(a, .., a, b, .., b),    b taken j times
//! ```
//! which gives the pieces of a spline, parts of a piece and curves on it alike; all weights are positive
//! inside, so nothing is lost to rounding.

use crate::basis::raise;
use crate::geometry::{Bounds, Domain};
use crate::knots::{KnotVector, MAX_DEGREE};
use crate::memory::{self, CollectVec};
use glam::DVec2;

/// A polynomial or rational surface over a rectangle in Bernstein form.
#[derive(Debug, Clone, PartialEq)]
pub struct BezierPatch {
    /// The rectangle of parameters.
    pub domain: Domain,
    /// Degree along u and v.
    pub degree: [usize; 2],
    /// Components of a value.
    pub dim: usize,
    /// Whether rows have a weight as their last number and the others are multiplied by it.
    pub is_rational: bool,
    /// Rows of [`BezierPatch::width`] numbers, `degree + 1` along each direction, v running fastest.
    pub ordinates: Vec<f64>,
}

impl BezierPatch {
    /// Numbers in a row of ordinates.
    pub fn width(&self) -> usize {
        self.dim + usize::from(self.is_rational)
    }

    /// The value at a parameter pair; beyond the domain the polynomial is continued.
    pub fn eval(&self, uv: DVec2) -> Vec<f64> {
        let local = (uv - self.domain.min) / self.domain.size();
        let row = |degree: usize, t: f64| blossom_weights(degree, |_| t);
        let point = apply(
            &self.ordinates,
            self.degree,
            self.width(),
            &row(self.degree[0], local.x),
            &row(self.degree[1], local.y),
        );
        self.to_value(&point)
    }

    /// The part over a rectangle, which may reach beyond the domain.
    pub fn restrict(&self, domain: Domain) -> Self {
        let from = (domain.min - self.domain.min) / self.domain.size();
        let to = (domain.max - self.domain.min) / self.domain.size();
        Self { domain, ordinates: self.local_ordinates([from.x, to.x], [from.y, to.y]), ..self.clone() }
    }

    /// The parts below and above `u`.
    pub fn split_u(&self, u: f64) -> [Self; 2] {
        let Domain { min, max } = self.domain;
        [Domain { min, max: DVec2::new(u, max.y) }, Domain { min: DVec2::new(u, min.y), max }]
            .map(|part| self.restrict(part))
    }

    /// The parts below and above `v`.
    pub fn split_v(&self, v: f64) -> [Self; 2] {
        let Domain { min, max } = self.domain;
        [Domain { min, max: DVec2::new(max.x, v) }, Domain { min: DVec2::new(min.x, v), max }]
            .map(|part| self.restrict(part))
    }

    /// The same surface with degrees that are not below the present ones.
    pub fn elevate(&self, degree: [usize; 2]) -> Self {
        let rows = |axis: usize| elevation(self.degree[axis], degree[axis].max(self.degree[axis]));
        let ordinates = apply(&self.ordinates, self.degree, self.width(), &rows(0), &rows(1));
        let degree = [degree[0].max(self.degree[0]), degree[1].max(self.degree[1])];
        Self { degree, ordinates, ..self.clone() }
    }

    /// The same surface with weights, all 1 if there were none.
    pub fn to_rational(&self) -> Self {
        if self.is_rational {
            return self.clone();
        }
        let rows = self.ordinates.chunks_exact(self.dim);
        let ordinates = rows.flat_map(|row| row.iter().copied().chain([1.0])).collect();
        Self { is_rational: true, ordinates, ..self.clone() }
    }

    /// The curve over the straight line from `from` to `to`, as a patch of degree 0 along v over the unit
    /// square: its degree is the sum of both degrees.
    pub fn line(&self, from: DVec2, to: DVec2) -> Self {
        let [from, to] = [from, to].map(|uv| (uv - self.domain.min) / self.domain.size());
        let part = self.local_ordinates([from.x, to.x], [from.y, to.y]);
        let ([p, q], width) = (self.degree, self.width());
        let mut ordinates = memory::filled(0.0, (p + q + 1) * width);
        for (ij, row) in part.chunks_exact(width).enumerate() {
            let (i, j) = (ij / (q + 1), ij % (q + 1));
            let share = binomial(p, i) * binomial(q, j) / binomial(p + q, i + j);
            let sum = &mut ordinates[(i + j) * width..][..width];
            sum.iter_mut().zip(row).for_each(|(sum, x)| *sum += share * x);
        }
        let domain = Domain { min: DVec2::ZERO, max: DVec2::ONE };
        Self { domain, degree: [p + q, 0], ordinates, ..self.clone() }
    }

    /// A box that holds the patch: the one of its ordinates, divided by their weights.
    pub fn bounds(&self) -> Bounds {
        let points: Vec<f64> =
            self.ordinates.chunks_exact(self.width()).flat_map(|row| self.to_value(row)).collect_vec();
        Bounds::of_rows(&points, self.dim)
    }

    fn to_value(&self, row: &[f64]) -> Vec<f64> {
        let weight = if self.is_rational { row[self.dim] } else { 1.0 };
        row[..self.dim].iter().map(|x| x / weight).collect_vec()
    }

    /// Ordinates over intervals of the unit square, which may run backwards.
    fn local_ordinates(&self, [u0, u1]: [f64; 2], [v0, v1]: [f64; 2]) -> Vec<f64> {
        let rows = |degree, from, to| interval_weights(degree, from, to);
        apply(
            &self.ordinates,
            self.degree,
            self.width(),
            &rows(self.degree[0], u0, u1),
            &rows(self.degree[1], v0, v1),
        )
    }
}

/// The ordinates of one polynomial piece of a spline: row `j` weighs the control points
/// `span - degree ..= span`.
pub fn extraction(knots: &KnotVector, span: usize) -> Vec<f64> {
    extraction_over(knots, span, [knots.knots()[span], knots.knots()[span + 1]])
}

/// The same for the piece's polynomial over any interval.
pub fn extraction_over(knots: &KnotVector, span: usize, [from, to]: [f64; 2]) -> Vec<f64> {
    let (t, degree) = (knots.knots(), knots.degree());
    let mut matrix = memory::with_capacity((degree + 1) * (degree + 1));
    for j in 0..=degree {
        let mut values = [0.0; MAX_DEGREE + 1];
        values[0] = 1.0;
        for p in 1..=degree {
            raise(t, span, if p <= j { to } else { from }, p, &mut values);
        }
        matrix.extend_from_slice(&values[..=degree]);
    }
    matrix
}

/// `rows_u net rows_v^T` for a net of rows of `width` numbers, `degree + 1` along each direction.
pub(crate) fn apply(
    net: &[f64],
    degree: [usize; 2],
    width: usize,
    rows_u: &[f64],
    rows_v: &[f64],
) -> Vec<f64> {
    let [m, n] = degree.map(|degree| degree + 1);
    let mut half = memory::filled(0.0, rows_u.len() / m * n * width);
    for (row, out) in rows_u.chunks_exact(m).zip(half.chunks_exact_mut(n * width)) {
        for (&share, line) in row.iter().zip(net.chunks_exact(n * width)) {
            out.iter_mut().zip(line).for_each(|(out, x)| *out += share * x);
        }
    }
    let out_n = rows_v.len() / n;
    let mut whole = memory::filled(0.0, rows_u.len() / m * out_n * width);
    for (line, outs) in half.chunks_exact(n * width).zip(whole.chunks_exact_mut(out_n * width)) {
        for (row, out) in rows_v.chunks_exact(n).zip(outs.chunks_exact_mut(width)) {
            for (&share, point) in row.iter().zip(line.chunks_exact(width)) {
                out.iter_mut().zip(point).for_each(|(out, x)| *out += share * x);
            }
        }
    }
    whole
}

/// How the blossom at `argument(0), argument(1), ..` weighs the ordinates over the unit interval.
fn blossom_weights(degree: usize, argument: impl Fn(usize) -> f64) -> Vec<f64> {
    let mut weights = vec![1.0];
    for k in 0..degree {
        let x = argument(k);
        weights.push(0.0);
        for i in (0..weights.len()).rev() {
            let carried = if i > 0 { x * weights[i - 1] } else { 0.0 };
            weights[i] = (1.0 - x) * weights[i] + carried;
        }
    }
    weights
}

/// From the ordinates over the unit interval to those over another, one row for each.
fn interval_weights(degree: usize, from: f64, to: f64) -> Vec<f64> {
    (0..=degree).flat_map(|j| blossom_weights(degree, |k| if k < j { to } else { from })).collect_vec()
}

/// From the ordinates of one degree to those of a higher one, one row for each.
fn elevation(from: usize, to: usize) -> Vec<f64> {
    let mut matrix = memory::filled(0.0, (to + 1) * (from + 1));
    for k in 0..=to {
        for i in k.saturating_sub(to - from)..=k.min(from) {
            matrix[k * (from + 1) + i] = binomial(from, i) * binomial(to - from, k - i) / binomial(to, k);
        }
    }
    matrix
}

/// The binomial coefficient, exact while it is below 2^53.
pub(crate) fn binomial(n: usize, k: usize) -> f64 {
    (0..k.min(n - k)).fold(1.0, |product, i| product * (n - i) as f64 / (i + 1) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::Random;
    use crate::surface::Surface;
    use crate::surface::tensor::{Axis, TensorSurface};

    /// A surface with unclamped, uneven and repeated knots.
    fn surface(degree: [usize; 2], is_rational: bool) -> TensorSurface {
        let mut random = Random::new(degree[0] as u64);
        let mut knots = |degree: usize| {
            let mut t: Vec<f64> = (0..2 * degree + 6).map(|_| 10.0 * random.unit()).collect();
            t.sort_unstable_by(f64::total_cmp);
            let middle = t.len() / 2;
            t[middle] = t[middle - 1];
            KnotVector::new(t, degree).unwrap()
        };
        let (knots_u, knots_v) = (knots(degree[0]), knots(degree[1]));
        let count = knots_u.basis_count() * knots_v.basis_count();
        let points = (0..3 * count).map(|_| random.signed()).collect();
        let weights = is_rational.then(|| (0..count).map(|_| 0.5 + random.unit()).collect());
        TensorSurface::new(3, knots_u, knots_v, points, weights).unwrap()
    }

    fn near(a: &[f64], b: &[f64], tol: f64) -> bool {
        a.iter().zip(b).all(|(a, b)| (a - b).abs() <= tol)
    }

    #[test]
    fn patches_are_the_surface() {
        let mut random = Random::new(9);
        for degree in [[1, 1], [2, 3], [3, 3], [5, 4], [9, 9]] {
            for is_rational in [false, true] {
                let surface = surface(degree, is_rational);
                let patches = surface.patches().unwrap();
                // ordinates are convex combinations on clamped ends; on unclamped ones they grow with the degree
                let tol = 1e3 * (degree[0] * degree[1]) as f64 * f64::EPSILON;
                for k in 0..patches.patch_count() {
                    let patch = patches.patch(k);
                    let share = DVec2::new(random.unit(), random.unit());
                    let uv = patch.domain.min + share * patch.domain.size();
                    assert_eq!(patches.patch_at(uv), k);
                    let mut exact = [0.0; 3];
                    surface.eval_rows(&[uv], 0, &mut exact);
                    assert!(near(&patch.eval(uv), &exact, tol), "{degree:?} {k}");
                    let higher = patch.elevate([degree[0] + 2, degree[1] + 1]).to_rational();
                    assert!(near(&higher.eval(uv), &exact, tol), "{degree:?} {k}: elevated");
                    for part in patch.split_u(uv.x).into_iter().chain(patch.split_v(uv.y)) {
                        assert!(near(&part.eval(uv), &exact, tol), "{degree:?} {k}: split");
                    }
                    let to = patch.domain.max;
                    let line = patch.line(uv, to);
                    surface.eval_rows(&[uv.lerp(to, 0.3)], 0, &mut exact);
                    assert!(near(&line.eval(DVec2::new(0.3, 0.0)), &exact, tol), "{degree:?} {k}: line");
                    let bounds = patch.bounds();
                    for c in 0..3 {
                        assert!(bounds.min[c] <= exact[c] + tol && exact[c] <= bounds.max[c] + tol);
                    }
                }
            }
        }
    }

    #[test]
    fn patches_are_found_from_outside() {
        let surface = surface([3, 2], false);
        let patches = surface.patches().unwrap();
        assert_eq!(patches.patch_at(DVec2::splat(-1e9)), 0);
        assert_eq!(patches.patch_at(DVec2::splat(1e9)), patches.patch_count() - 1);
        let spans = surface.knots(Axis::U).spans().len() * surface.knots(Axis::V).spans().len();
        assert_eq!(patches.patch_count(), spans);
    }
}
