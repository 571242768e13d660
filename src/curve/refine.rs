//! The same curve over more knots, a near one over fewer.
//!
//! Insertion is a [`Refinement`].
//!
//! Removal of a knot t that then is left s times: W. Boehm's insertion (1980) read backwards,
//! ```text
//! P_i = a_i Q_i + (1 - a_i) Q_{i-1},   a_i = (t - u_i) / (u_{i+p} - u_i),   i = k-p+1 ..= k-s
//! ```
//! with one equation more than unknowns Q. Its defect, spread so that the largest share is least, is the distance
//! of the control polygons over the old knots, which bounds that of the curves everywhere.

use super::Curve;
use crate::knots::{KnotError, KnotVector};
use crate::memory::{self, CollectVec};
use crate::refinement::Refinement;

/// Knots of several curves nearer than this share of the domain count as one.
pub const KNOT_TOLERANCE: f64 = 1e-12;

impl Curve {
    /// The same curve with more knots inside its domain, none of them more than `degree` times.
    pub fn insert_knots(&self, added: &[f64]) -> Result<Self, KnotError> {
        let (from, to) = self.knots.domain();
        if let Some(&at) = added.iter().find(|&&t| !(from < t && t < to)) {
            return Err(KnotError::Outside { at, from, to });
        }
        let refinement = Refinement::insert(&self.knots, added)?;
        let control_points = refinement.apply(&self.control_points, self.dim);
        Ok(Self { dim: self.dim, knots: refinement.knots().clone(), control_points })
    }

    /// A curve without the knot of this index, which must lie inside the domain where the curve is continuous, and a
    /// bound of its distance from this one at any parameter.
    pub fn remove_knot(&self, index: usize) -> Result<(Self, f64), KnotError> {
        let (t, degree, dim) = (self.knots.knots(), self.knots.degree(), self.dim);
        let (from, to) = self.knots.domain();
        let is_inner = |&&at: &&f64| from < at && at < to && self.knots.multiplicity(at) <= degree;
        let Some(&at) = t.get(index).filter(is_inner) else {
            return Err(KnotError::NotRemovable { index });
        };
        let k = t.partition_point(|&t| t <= at) - 2; // the last knot that is left at or before `at`
        let mut left = memory::copied(t);
        left.remove(k + 1);
        let knots = KnotVector::new(left, degree)?;
        let u = knots.knots();
        let (first, last) = (k + 1 - degree, k - knots.multiplicity(at));
        let share: Vec<f64> = (first..=last).map(|i| (at - u[i]) / (u[i + degree] - u[i])).collect_vec();
        let mut control_points = self.control_points.clone();
        let error = level_defect(&mut control_points[(first - 1) * dim..(last + 2) * dim], &share, dim);
        solve_from_both_ends(&mut control_points[(first - 1) * dim..(last + 2) * dim], &share, dim);
        control_points.drain((last + 1) * dim..(last + 2) * dim);
        Ok((Self { dim, knots, control_points }, error))
    }
}

/// Takes the defect off the control points P between the first and the last of `points`, equal shares of it, and
/// returns the length of a share.
///
/// The equations weighted by `n`, with `n_i a_i + n_{i+1} (1 - a_{i+1}) = 0`, cancel all unknowns; what is left is the
/// defect. Of all ways to spread it, equal shares have the least maximum.
fn level_defect(points: &mut [f64], share: &[f64], dim: usize) -> f64 {
    let mut weights = vec![1.0];
    for pair in share.windows(2) {
        weights.push(-weights[weights.len() - 1] * pair[0] / (1.0 - pair[1]));
    }
    let (before, after) = (share[0] - 1.0, -weights[share.len() - 1] * share[share.len() - 1]);
    let all = [before].into_iter().chain(weights.iter().copied()).chain([after]);
    let total: f64 = weights.iter().map(|n| n.abs()).sum();
    let mut defect = memory::filled(0.0, dim);
    for (point, n) in points.chunks(dim).zip(all) {
        defect.iter_mut().zip(point).for_each(|(sum, x)| *sum += n * x / total);
    }
    for (point, n) in points[dim..].chunks_mut(dim).zip(&weights) {
        point.iter_mut().zip(&defect).for_each(|(x, part)| *x -= n.signum() * part);
    }
    defect.iter().fold(0.0, |length: f64, x| length.hypot(*x))
}

/// Replaces the control points P between the first and the last of `points` by the unknowns Q; the last row but one
/// then stands there twice. Works from both ends towards the equation that is
/// left over, so that no divisor is below one half.
fn solve_from_both_ends(points: &mut [f64], share: &[f64], dim: usize) {
    let count = share.len();
    let forward = share[..count - 1].iter().take_while(|&&a| a >= 0.5).count();
    for i in 0..forward {
        for c in 0..dim {
            let (known, point) = (points[i * dim + c], points[(i + 1) * dim + c]);
            points[(i + 1) * dim + c] = (point - (1.0 - share[i]) * known) / share[i];
        }
    }
    for i in (forward + 1..count).rev() {
        for c in 0..dim {
            let (point, known) = (points[(i + 1) * dim + c], points[(i + 2) * dim + c]);
            points[(i + 1) * dim + c] = (point - share[i] * known) / (1.0 - share[i]);
        }
    }
    // row i + 1 now holds Q_i before the equation left over, and Q_{i-1} behind it
    points.copy_within((forward + 2) * dim..(count + 2) * dim, (forward + 1) * dim);
}

/// The knots that all the curves need together: each as often as the curve that has it most. Knots nearer than
/// [`KNOT_TOLERANCE`] count as the first of them. The curves have one degree and one domain.
pub fn common_knots(curves: &[&Curve]) -> Result<KnotVector, KnotError> {
    let clusters = clusters(curves);
    let degree = curves[0].knots.degree();
    let knots = clusters.iter().flat_map(|&(at, count)| std::iter::repeat_n(at, count));
    KnotVector::new(knots.collect(), degree)
}

/// Where the pieces of all the curves together meet: their common knots, each once.
pub fn common_breaks(curves: &[&Curve]) -> Vec<f64> {
    clusters(curves).into_iter().map(|(at, _)| at).collect_vec()
}

/// The curves over their common knots.
pub fn on_common_knots(curves: &[&Curve]) -> Result<Vec<Curve>, KnotError> {
    let clusters = clusters(curves);
    let snap = |t: f64| clusters[clusters.partition_point(|&(at, _)| at <= t).max(1) - 1].0;
    let refined = curves.iter().map(|curve| {
        let (from, end) = curve.knots.domain();
        let snap = |&t: &f64| if is_near(t, end, end - from) { end } else { snap(t) };
        let snapped = curve.knots.knots().iter().map(snap).collect();
        let knots = KnotVector::new(snapped, curve.knots.degree())?;
        let missing: Vec<f64> = clusters
            .iter()
            .flat_map(|&(at, count)| std::iter::repeat_n(at, count - knots.multiplicity(at).min(count)))
            .collect_vec();
        Curve { knots, ..(*curve).clone() }.insert_knots(&missing)
    });
    refined.collect()
}

fn is_near(a: f64, b: f64, scale: f64) -> bool {
    (b - a).abs() <= KNOT_TOLERANCE * scale
}

/// Different knots and how often each is needed.
fn clusters(curves: &[&Curve]) -> Vec<(f64, usize)> {
    let (from, end) = curves[0].knots.domain();
    let scale = end - from;
    let mut knots: Vec<(f64, usize)> = curves
        .iter()
        .enumerate()
        .flat_map(|(owner, curve)| curve.knots.knots().iter().map(move |&t| (t, owner)))
        .collect_vec();
    knots.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut clusters: Vec<(f64, usize)> = Vec::new();
    let mut counts = memory::filled(0, curves.len());
    for (t, owner) in knots {
        let t = if is_near(t, end, scale) { end } else { t };
        match clusters.last_mut() {
            Some((at, most)) if is_near(*at, t, scale) => {
                counts[owner] += 1;
                *most = counts[owner].max(*most);
            }
            _ => {
                counts.fill(0);
                counts[owner] = 1;
                clusters.push((t, 1));
            }
        }
    }
    clusters
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::Random;

    fn curve(degree: usize, seed: u64) -> Curve {
        let mut random = Random::new(seed);
        let mut breaks: Vec<f64> = (0..9).map(|_| random.unit()).collect();
        breaks.extend([0.0, 1.0, breaks[0]]); // one knot twice
        breaks.sort_unstable_by(f64::total_cmp);
        let knots = KnotVector::clamped(&breaks, degree).unwrap();
        let points = (0..2 * knots.basis_count()).map(|_| random.signed()).collect();
        Curve::new(2, knots, points).unwrap()
    }

    fn distance(a: &Curve, b: &Curve) -> f64 {
        let at = |k: i32| f64::from(k) / 1000.0;
        (0..=1000)
            .map(|k| (a.eval(at(k)), b.eval(at(k))))
            .fold(0.0, |most: f64, (a, b)| most.max((a[0] - b[0]).hypot(a[1] - b[1])))
    }

    #[test]
    fn insertion_keeps_the_curve_and_what_is_far() {
        for degree in 3..=5 {
            for seed in 0..20 {
                let curve = curve(degree, seed);
                let refined =
                    curve.insert_knots(&[0.3, 0.7, 0.3, curve.knots().knots()[degree + 3]]).unwrap();
                // convex combinations of numbers of size one, p + 1 terms in p rounds
                assert!(distance(&curve, &refined) <= 64.0 * (degree * degree) as f64 * f64::EPSILON);
                let one = curve.insert_knots(&[0.5]).unwrap();
                let span = curve.knots().span(0.5);
                assert_eq!(
                    one.control_points()[..2 * (span - degree + 1)],
                    curve.control_points()[..2 * (span - degree + 1)]
                );
                assert_eq!(one.control_points()[2 * (span + 1)..], curve.control_points()[2 * span..]);
            }
        }
    }

    #[test]
    fn removal_undoes_insertion() {
        for degree in 1..=5 {
            for seed in 0..20 {
                let curve = curve(degree, seed);
                let at = 0.05 + 0.045 * seed as f64;
                let refined = curve.insert_knots(&[at]).unwrap();
                let index = refined.knots().knots().iter().position(|&t| t == at).unwrap();
                let (back, error) = refined.remove_knot(index).unwrap();
                assert_eq!(back.knots(), curve.knots());
                // the divisors are above one half: errors grow at most twofold a row
                let tol = 1e3 * f64::EPSILON * (1 << degree) as f64;
                assert!(
                    error <= tol && distance(&back, &curve) <= tol,
                    "degree {degree}, seed {seed}: {error:e}"
                );
            }
        }
    }

    #[test]
    fn the_error_of_a_removal_bounds_the_distance() {
        for degree in 1..=5 {
            for seed in 0..20 {
                let curve = curve(degree, seed);
                let index = degree + 1 + seed as usize % 10;
                if curve.knots().multiplicity(curve.knots().knots()[index]) > degree {
                    continue; // torn there
                }
                let (without, error) = curve.remove_knot(index).unwrap();
                let measured = distance(&curve, &without);
                assert!(
                    measured <= error * (1.0 + 1e-9) + 1e-12,
                    "{degree} {seed}: {measured:e} above {error:e}"
                );
                assert!(measured >= 1e-3 * error, "{degree} {seed}: {measured:e} far below {error:e}");
            }
        }
    }

    #[test]
    fn curves_on_common_knots_are_the_same_curves() {
        let curves = [curve(3, 1), curve(3, 2), curve(3, 3)];
        let nearly = {
            let mut knots = curves[0].knots().knots().to_vec();
            knots.iter_mut().filter(|t| (0.1..0.9).contains(*t)).for_each(|t| *t += 1e-14);
            let knots = KnotVector::new(knots, 3).unwrap();
            Curve::new(2, knots, curves[0].control_points().to_vec()).unwrap()
        };
        let all: Vec<&Curve> = curves.iter().chain([&nearly]).collect();
        let common = on_common_knots(&all).unwrap();
        assert_eq!(common[0].knots().basis_count(), 4 + 3 * 10, "the nearly equal knots are one");
        for (curve, refined) in all.iter().zip(&common) {
            assert_eq!(refined.knots(), common[0].knots());
            // knots moved by 1e-14 times slopes of a hundred
            assert!(distance(curve, refined) <= 1e-11);
        }
    }

    #[test]
    fn knots_at_the_ends_stay() {
        let curve = curve(3, 1);
        assert_eq!(
            curve.insert_knots(&[1.0]).unwrap_err(),
            KnotError::Outside { at: 1.0, from: 0.0, to: 1.0 }
        );
        assert_eq!(curve.remove_knot(3).unwrap_err(), KnotError::NotRemovable { index: 3 });
        assert_eq!(curve.remove_knot(99).unwrap_err(), KnotError::NotRemovable { index: 99 });
        let full = curve.insert_knots(&[0.5; 3]).unwrap();
        assert_eq!(full.insert_knots(&[0.5]).unwrap_err(), KnotError::Torn { at: 0.5, degree: 3 });
    }
}
