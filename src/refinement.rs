//! Changes of the knot vector that leave a spline as it is: knot insertion, degree elevation, restriction.
//!
//! L. Ramshaw, "Blossoms are polar forms", Comput. Aided Geom. Des. 6 (1989), 323-358. On a span inside the
//! support of the basis function `j` of degree q over knots `s` the blossom F of the spline gives its control
//! point, and a spline of degree p < q has the blossom of degree q that is the mean over its arguments:
//! ```text
//! c_j = F(s_{j+1}, .., s_{j+q}),    F(x_1, .., x_{p+1}) = sum_i f(x_1, .., x_{i-1}, x_{i+1}, ..) / (p + 1)
//! ```
//! So all three are one linear map from control points to control points, with a few weights for each.

use crate::basis::raise;
use crate::knots::{KnotError, KnotVector, MAX_DEGREE};
use crate::memory::{self, CollectVec};

/// The map from the control points over one knot vector to those over another.
#[derive(Debug, Clone, PartialEq)]
pub struct Refinement {
    knots: KnotVector,
    rows: Vec<Row>,
}

/// How one new control point weighs the old ones from `first` on.
#[derive(Debug, Clone, PartialEq)]
struct Row {
    first: usize,
    weights: Vec<f64>,
}

impl Refinement {
    /// Inserts `added` knots, in any order, anywhere in the domain. A knot may not occur more than `degree`
    /// times inside the domain afterwards; at its ends it may be repeated `degree + 1` times, which clamps.
    pub fn insert(from: &KnotVector, added: &[f64]) -> Result<Self, KnotError> {
        let (start, end) = from.domain();
        if let Some(index) = added.iter().position(|t| !t.is_finite()) {
            return Err(KnotError::NotFinite { index });
        }
        if let Some(&at) = added.iter().find(|&&t| t < start || end < t) {
            return Err(KnotError::Outside { at, from: start, to: end });
        }
        let degree = from.degree();
        let mut knots: Vec<f64> = from.knots().iter().chain(added).copied().collect_vec();
        knots.sort_unstable_by(f64::total_cmp);
        let torn = |run: &[f64]| run[0] == run[degree] && start < run[0] && run[0] < end;
        if let Some(run) = knots.windows(degree + 1).find(|run| torn(run) && added.contains(&run[0])) {
            return Err(KnotError::Torn { at: run[0], degree });
        }
        let to = KnotVector::new(within(&knots, degree, (start, end)), degree)?;
        Ok(Self::between(from, to))
    }

    /// Raises the degree by one.
    pub fn elevate(from: &KnotVector) -> Result<Self, KnotError> {
        let degree = from.degree() + 1;
        let runs = from.knots().chunk_by(|a, b| a == b);
        let knots: Vec<f64> = runs.flat_map(|run| run.iter().copied().chain([run[0]])).collect_vec();
        let to = KnotVector::new(within(&knots, degree, from.domain()), degree)?;
        Ok(Self::between(from, to))
    }

    /// The part from `start` to `end` in the domain, clamped at both.
    pub fn restrict(from: &KnotVector, start: f64, end: f64) -> Result<Self, KnotError> {
        let (first, last) = from.domain();
        if let Some(at) = [start, end].into_iter().find(|t| !(first <= *t && *t <= last)) {
            return Err(KnotError::Outside { at, from: first, to: last });
        }
        if start >= end {
            return Err(KnotError::Empty { at: start });
        }
        let ends = |t| std::iter::repeat_n(t, from.degree() + 1);
        let inner = from.knots().iter().copied().filter(|&t| start < t && t < end);
        let to = KnotVector::new(ends(start).chain(inner).chain(ends(end)).collect(), from.degree())?;
        Ok(Self::between(from, to))
    }

    /// `to` has the knots of `from` inside its domain, and its degree or one more.
    fn between(from: &KnotVector, to: KnotVector) -> Self {
        let rows = (0..to.basis_count()).map(|j| Row::new(from, &to, j)).collect();
        Self { knots: to, rows }
    }

    /// The new knot vector.
    pub fn knots(&self) -> &KnotVector {
        &self.knots
    }

    /// The new rows of `width` numbers.
    pub fn apply(&self, old: &[f64], width: usize) -> Vec<f64> {
        let mut new = memory::filled(0.0, self.rows.len() * width);
        for (row, new) in self.rows.iter().zip(new.chunks_exact_mut(width)) {
            for (point, &weight) in old[row.first * width..].chunks_exact(width).zip(&row.weights) {
                new.iter_mut().zip(point).for_each(|(sum, x)| *sum += weight * x);
            }
        }
        new
    }
}

/// Ordered `knots` without those that no basis function needs whose support meets the domain.
fn within(knots: &[f64], degree: usize, (start, end): (f64, f64)) -> Vec<f64> {
    // the last knot at the start and the first at the end bound the spans of the domain
    let first = knots.partition_point(|&t| t <= start) - 1;
    let last = knots.partition_point(|&t| t < end);
    knots[first - degree..=last + degree].to_vec()
}

impl Row {
    fn new(from: &KnotVector, to: &KnotVector, j: usize) -> Self {
        let (p, q) = (from.degree(), to.degree());
        let arguments = &to.knots()[j + 1..=j + q];
        let span = from.span(place_in_support(to, j));
        let first = span - p;
        let mut weights = memory::filled(0.0, p + 1);
        if p == q {
            weights.copy_from_slice(&blossom(from, span, arguments.iter().copied())[..=p]);
        } else {
            for left_out in 0..q {
                let others = arguments.iter().enumerate().filter(|&(i, _)| i != left_out);
                let values = blossom(from, span, others.map(|(_, &t)| t));
                weights.iter_mut().zip(values).for_each(|(sum, value)| *sum += value / q as f64);
            }
        }
        Self { first, weights }
    }
}

/// A place on a span of the domain where basis function `j` lives: on the one in the middle of its knots, where
/// the blossom's weights are least.
fn place_in_support(to: &KnotVector, j: usize) -> f64 {
    let (t, q, middle) = (to.knots(), to.degree(), to.greville(j));
    let spans = (j.max(q)..=(j + q).min(to.basis_count() - 1)).filter(|&k| t[k] < t[k + 1]);
    let places = spans.map(|k| 0.5 * (t[k] + t[k + 1]));
    places.min_by(|a, b| (a - middle).abs().total_cmp(&(b - middle).abs())).unwrap_or(middle)
}

/// How the blossom on a span weighs the control points `span - degree ..= span`. Arguments that are consecutive
/// knots give one of them, to the bit.
fn blossom(knots: &KnotVector, span: usize, arguments: impl Iterator<Item = f64>) -> [f64; MAX_DEGREE + 1] {
    let (t, p) = (knots.knots(), knots.degree());
    let mut given = [0.0; MAX_DEGREE];
    given.iter_mut().zip(arguments).for_each(|(given, x)| *given = x);
    let mut values = [0.0; MAX_DEGREE + 1];
    if let Some(r) = (0..=p).find(|&r| t[span - p + r + 1..=span + r] == given[..p]) {
        values[r] = 1.0;
        return values;
    }
    values[0] = 1.0;
    for (k, &x) in given[..p].iter().enumerate() {
        raise(t, span, x, k + 1, &mut values);
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::Curve;
    use crate::samples::Random;

    /// Uneven knots, some repeated, clamped or not.
    fn ugly(degree: usize, is_clamped: bool, random: &mut Random) -> KnotVector {
        let mut t: Vec<f64> = (0..degree + 4).map(|_| 4.0 * random.unit()).collect();
        t.sort_unstable_by(f64::total_cmp);
        t[2] = t[1];
        if is_clamped {
            return KnotVector::clamped(&t, degree).unwrap();
        }
        t.extend((0..degree).map(|k| -0.3 * (k + 1) as f64));
        t.extend((0..degree).map(|k| 4.0 + 0.7 * (k + 1) as f64));
        t.sort_unstable_by(f64::total_cmp);
        KnotVector::new(t, degree).unwrap()
    }

    /// The largest difference over the domain of the refined curve, relative to the largest control point.
    fn difference(old: &Curve, refinement: &Refinement) -> f64 {
        let points = refinement.apply(old.control_points(), old.dim());
        let scale = points.iter().chain(old.control_points()).fold(0.0, |max: f64, x| max.max(x.abs()));
        let new = Curve::new(old.dim(), refinement.knots().clone(), points).unwrap();
        let (start, end) = new.knots().domain();
        let places = (0..=200).map(|k| start + (end - start) * f64::from(k) / 200.0);
        let gap =
            |u: f64| old.eval(u).iter().zip(new.eval(u)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        places.map(gap).fold(0.0, f64::max) / scale
    }

    #[test]
    fn the_spline_stays_as_it_is() {
        let mut random = Random::new(3);
        for degree in 1..MAX_DEGREE {
            for is_clamped in [true, false] {
                let knots = ugly(degree, is_clamped, &mut random);
                let points = (0..2 * knots.basis_count()).map(|_| random.signed()).collect();
                let curve = Curve::new(2, knots.clone(), points).unwrap();
                let (start, end) = knots.domain();
                let mut place = || start + (end - start) * random.unit();
                let once = place();
                let mut added = vec![place(), once, place()];
                added.extend(std::iter::repeat_n(once, degree - 1));
                // each argument of a blossom multiplies by sums of at most 1 in size near the middle span; the
                // shortest spans of these knots magnify by some hundreds
                let tol = 1e3 * (degree * degree) as f64 * f64::EPSILON;
                let inserted = Refinement::insert(&knots, &added).unwrap();
                assert_eq!(inserted.knots().basis_count(), knots.basis_count() + added.len());
                assert!(difference(&curve, &inserted) <= tol, "{degree} {is_clamped}: insertion");
                let elevated = Refinement::elevate(&knots).unwrap();
                assert_eq!(elevated.knots().domain(), knots.domain());
                assert!(difference(&curve, &elevated) <= tol, "{degree} {is_clamped}: elevation");
                let (mut a, mut b) = (place(), place());
                if a > b {
                    std::mem::swap(&mut a, &mut b);
                }
                let part = Refinement::restrict(&knots, a, b).unwrap();
                assert_eq!(part.knots().domain(), (a, b));
                assert!(part.knots().is_clamped());
                assert!(difference(&curve, &part) <= tol, "{degree} {is_clamped}: restriction");
            }
        }
    }

    #[test]
    fn control_points_far_from_a_new_knot_stay_to_the_bit() {
        let knots = KnotVector::clamped(&[0.0, 0.1, 0.3, 0.4, 0.7, 0.8, 1.0], 3).unwrap();
        let points: Vec<f64> = (0..knots.basis_count()).map(|i| (i as f64).sqrt()).collect();
        let new = Refinement::insert(&knots, &[0.75]).unwrap().apply(&points, 1);
        assert_eq!(new[..5], points[..5]);
        assert_eq!(new[8..], points[7..]);
        let none = Refinement::insert(&knots, &[]).unwrap();
        assert_eq!((none.knots(), none.apply(&points, 1)), (&knots, points));
    }

    #[test]
    fn repeated_elevation_gives_the_bernstein_form() {
        // u^2 over the unit interval in degree 4: k (k - 1) / 12
        let mut knots = KnotVector::clamped(&[0.0, 1.0], 2).unwrap();
        let mut points = vec![0.0, 0.0, 1.0];
        for _ in 0..2 {
            let elevated = Refinement::elevate(&knots).unwrap();
            points = elevated.apply(&points, 1);
            knots = elevated.knots().clone();
        }
        for (k, point) in points.iter().enumerate() {
            let exact = (k * k.saturating_sub(1)) as f64 / 12.0;
            assert!((point - exact).abs() <= 4.0 * f64::EPSILON, "{points:?}");
        }
    }

    #[test]
    fn refusals_name_the_knot() {
        let knots = KnotVector::clamped(&[0.0, 0.5, 1.0], 2).unwrap();
        let refuse = |added: &[f64]| Refinement::insert(&knots, added).unwrap_err();
        assert_eq!(refuse(&[0.2, f64::NAN]), KnotError::NotFinite { index: 1 });
        assert_eq!(refuse(&[0.2, 1.5]), KnotError::Outside { at: 1.5, from: 0.0, to: 1.0 });
        assert_eq!(refuse(&[0.5, 0.5]), KnotError::Torn { at: 0.5, degree: 2 });
        assert!(matches!(Refinement::restrict(&knots, 0.3, 0.3), Err(KnotError::Empty { .. })));
        let high = KnotVector::clamped(&[0.0, 1.0], MAX_DEGREE).unwrap();
        assert_eq!(Refinement::elevate(&high).unwrap_err(), KnotError::Degree { degree: MAX_DEGREE + 1 });
    }
}
