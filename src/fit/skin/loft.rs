//! From section curves to control curves: the interpolation along v.
//!
//! With the knots `{v_0 x4, v_1 .. v_{n-1}, v_n x4}` the control curves solve a tridiagonal system,
//! ```text
//! N_{j-1}(v_{j-1}) Q_{j-1} + N_j(v_{j-1}) Q_j + N_{j+1}(v_{j-1}) Q_{j+1} = R_{j-1},    j = 2 .. n
//! Q_0 = R_0,   (1 - c_1) Q_1 + c_1 Q_2 = R_0,   c_1 = -(v_1 - v_0) / (v_2 - v_0),   and so at the end (natural)
//! Q_1 - Q_0 = (v_1 - v_0) / 3 T_0   (a given tangent T_0 in place of the second)
//! ```
//! so each of them is a sum `Q_j = sum_l C_jl R_l` of sections, tangents among them. `C` decays exponentially away
//! from its band, and its norm says how far control curves overshoot the rows. A surface closed along v has cyclic
//! knots instead, and its first three curves once more at the end.
//!
//! paper -> code: C `weights`, R_l and T `sources`.

use super::SkinError;
use crate::basis::basis_functions;
use crate::knots::KnotVector;
use crate::linalg::Tridiagonal;
use crate::memory::{self, CollectVec};

/// A sum of sources: their numbers, rising, and weights.
pub(super) type Combination = Vec<(usize, f64)>;

/// Weights below this share of the largest are rounding.
const LEAST_WEIGHT: f64 = 1e-16;

/// The direction across the rows.
#[derive(Debug, Clone)]
pub(super) struct Loft {
    pub knots_v: KnotVector,
    /// Where the rows lie.
    pub parameters: Vec<f64>,
    /// The control curves as sums of sources.
    pub weights: Vec<Combination>,
    /// For each control curve the rows at whose data it has to be right.
    pub checked_rows: Vec<Vec<usize>>,
    /// How much larger than the rows control curves may be.
    pub overshoot: f64,
}

impl Loft {
    /// One knot for each row, at rising `parameters`. With tangents the source after all rows, and the one after
    /// that, are the derivatives across the first and the last row, with respect to a length of which the whole range
    /// of `parameters` has `length`.
    pub(super) fn interpolating(
        parameters: Vec<f64>,
        has_tangents: [bool; 2],
        length: f64,
    ) -> Result<Self, SkinError> {
        let v = &parameters;
        let n = v.len() - 1;
        let knots_v = KnotVector::clamped(v, 3)?;
        let (mut lower, mut diagonal, mut upper) =
            (memory::filled(0.0, n + 3), memory::filled(1.0, n + 3), memory::filled(0.0, n + 3));
        for j in 2..=n {
            let basis = basis_functions(&knots_v, j + 2, v[j - 1]);
            (lower[j], diagonal[j], upper[j]) = (basis[0], basis[1], basis[2]);
        }
        // with two rows there is no third one: the other end takes its place
        let (second, last_but_one) = (v[2.min(n)], v[n.max(2) - 2]);
        let (begin, end) = (-(v[1] - v[0]) / (second - v[0]), -(v[n] - v[n - 1]) / (v[n] - last_but_one));
        let third = length / (v[n] - v[0]) / 3.0;
        // right sides: for each source the equations that it stands in, and its factor there
        let mut sides: Vec<Vec<(usize, f64)>> = (0..=n).map(|l| vec![(l + 1, 1.0)]).collect_vec();
        sides[0] = vec![(0, 1.0)];
        sides[n] = vec![(n + 2, 1.0)];
        if has_tangents[0] {
            (lower[1], diagonal[1]) = (-1.0, 1.0);
            memory::push(&mut sides, vec![(1, third * (v[1] - v[0]))]);
        } else {
            (diagonal[1], upper[1]) = (1.0 - begin, begin);
            memory::push(&mut sides[0], (1, 1.0));
        }
        if has_tangents[1] {
            (diagonal[n + 1], upper[n + 1]) = (1.0, -1.0);
            memory::push(&mut sides, vec![(n + 1, third * (v[n - 1] - v[n]))]);
        } else {
            (lower[n + 1], diagonal[n + 1]) = (end, 1.0 - end);
            memory::push(&mut sides[n], (n + 1, 1.0));
        }
        let system = Tridiagonal::new(lower, &diagonal, upper);
        let weights = columns(&system, n + 3, &sides, |equation| equation);
        // the rows whose knots a curve may need: those under its basis function, and one more at the ends
        let rows = |j: usize| match j {
            0 | 1 => (0..=1.min(n)).collect_vec(),
            _ if j > n => (n - 1..=n).collect_vec(),
            _ => (j - 2..=j.min(n)).collect_vec(),
        };
        let checked_rows = (0..n + 3).map(rows).collect_vec();
        Ok(Self { overshoot: overshoot(&weights), knots_v, parameters, weights, checked_rows })
    }

    /// Two knots for each row but the outer ones, and two control curves beside it,
    /// ```text
    /// R_l - (v_l - v_{l-1}) / 3 T_l,    R_l + (v_{l+1} - v_l) / 3 T_l
    /// ```
    /// where the slopes `T_l` are the sources after all rows ([`super::monotone`]).
    pub(super) fn monotone(parameters: Vec<f64>) -> Result<Self, SkinError> {
        let (v, n) = (&parameters, parameters.len() - 1);
        let ends = |at: usize| [v[at]; 4];
        let inner = v[1..n].iter().flat_map(|&t| [t, t]);
        let knots = ends(0).into_iter().chain(inner).chain(ends(n)).collect_vec();
        let knots_v = KnotVector::new(knots, 3)?;
        let slope = |l: usize, step: f64| vec![(l, 1.0), (n + 1 + l, step / 3.0)];
        let mut weights = vec![vec![(0, 1.0)]];
        for l in 0..=n {
            if l > 0 {
                memory::push(&mut weights, slope(l, v[l - 1] - v[l]));
            }
            if l < n {
                memory::push(&mut weights, slope(l, v[l + 1] - v[l]));
            }
        }
        memory::push(&mut weights, vec![(n, 1.0)]);
        // the slopes of a row follow its neighbours too
        let near = |l: usize| (l.saturating_sub(1)..=(l + 1).min(n)).collect_vec();
        let checked_rows = (0..2 * n + 2).map(|j| near(j / 2)).collect_vec();
        Ok(Self { knots_v, parameters, weights, checked_rows, overshoot: 1.0 })
    }

    /// The last row is followed by the first: `period` is where it comes again. Needs three rows.
    pub(super) fn closed(parameters: Vec<f64>, period: f64) -> Result<Self, SkinError> {
        let count = parameters.len();
        let wrapped = |k: usize| {
            // t_{3+l} = v_l
            let l = k + 2 * count - 3;
            parameters[l % count] + period * ((l / count) as f64 - 2.0)
        };
        let knots_v = KnotVector::new((0..count + 7).map(wrapped).collect_vec(), 3)?;
        // equation l is row l, and its middle unknown is curve l + 1
        let rows: Vec<[f64; 3]> = (0..count)
            .map(|l| {
                let basis = basis_functions(&knots_v, l + 3, parameters[l]);
                [basis[0], basis[1], basis[2]]
            })
            .collect_vec();
        let part = |k: usize| rows.iter().map(|row| row[k]).collect_vec();
        let system = Tridiagonal::cyclic(part(0), part(1), part(2));
        let sides: Vec<Vec<(usize, f64)>> = (0..count).map(|l| vec![(l, 1.0)]).collect_vec();
        let weights = columns(&system, count, &sides, |equation| (equation + 1) % count);
        let checked_rows =
            (0..count).map(|j| [2, 1, 0].map(|k| (j + count - k) % count).to_vec()).collect_vec();
        Ok(Self { overshoot: overshoot(&weights), knots_v, parameters, weights, checked_rows })
    }

    /// Control curves that differ: the surface repeats the first of them at its end if it has more.
    pub(super) fn curve_count(&self) -> usize {
        self.weights.len()
    }
}

/// How much larger than the sources sums of them may be.
pub(super) fn overshoot(weights: &[Combination]) -> f64 {
    let sum = |combination: &Combination| combination.iter().map(|(_, weight)| weight.abs()).sum::<f64>();
    weights.iter().map(sum).fold(0.0, f64::max)
}

/// Solves for each source, and sorts the solutions by unknowns. `unknown` numbers those of the equations.
fn columns(
    system: &Tridiagonal,
    count: usize,
    sides: &[Vec<(usize, f64)>],
    unknown: impl Fn(usize) -> usize,
) -> Vec<Combination> {
    let mut weights = memory::filled(Vec::new(), count);
    let mut column = memory::filled(0.0, count);
    for (source, side) in sides.iter().enumerate() {
        column.fill(0.0);
        side.iter().for_each(|&(equation, factor)| column[equation] += factor);
        system.solve(&mut column, 1);
        let least = LEAST_WEIGHT * column.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        for (equation, &weight) in column.iter().enumerate().filter(|(_, weight)| weight.abs() > least) {
            memory::push(&mut weights[unknown(equation)], (source, weight));
        }
    }
    weights
}

#[cfg(test)]
mod tests {
    use super::*;

    fn dense(loft: &Loft, sources: usize) -> Vec<Vec<f64>> {
        let row = |combination: &Combination| {
            let mut row = vec![0.0; sources];
            combination.iter().for_each(|&(l, weight)| row[l] = weight);
            row
        };
        loft.weights.iter().map(row).collect()
    }

    fn assert_rows(loft: &Loft, exact: &[&[f64]]) {
        for (row, exact) in dense(loft, exact[0].len()).iter().zip(exact) {
            // a few roundings of numbers near one
            assert!(
                row.iter().zip(*exact).all(|(a, b)| (a - b).abs() <= 8.0 * f64::EPSILON),
                "{row:?} is not {exact:?}"
            );
        }
    }

    #[test]
    fn two_and_three_rows_have_the_weights_worked_out_by_hand() {
        let two = Loft::interpolating(vec![0.0, 1.0], [false; 2], 1.0).unwrap();
        assert_rows(&two, &[&[1.0, 0.0], &[2.0 / 3.0, 1.0 / 3.0], &[1.0 / 3.0, 2.0 / 3.0], &[0.0, 1.0]]);
        let three = Loft::interpolating(vec![0.0, 1.0, 2.0], [false; 2], 1.0).unwrap();
        assert_rows(
            &three,
            &[
                &[1.0, 0.0, 0.0],
                &[7.0 / 12.0, 0.5, -1.0 / 12.0],
                &[-0.25, 1.5, -0.25],
                &[-1.0 / 12.0, 0.5, 7.0 / 12.0],
                &[0.0, 0.0, 1.0],
            ],
        );
    }

    #[test]
    fn the_norm_tells_of_clustered_rows() {
        let norm = |v: &[f64]| Loft::interpolating(v.to_vec(), [false; 2], 1.0).unwrap().overshoot;
        let equal: Vec<f64> = (0..40).map(f64::from).collect();
        // the values that the theory states, to the digits stated; many equal steps tend to 3
        assert!((norm(&equal[..5]) - 2.7).abs() < 0.05 && (norm(&equal) - 3.0).abs() < 1e-6);
        assert!((norm(&[0.0, 1.0, 1.01, 2.0, 3.0]) - 68.0).abs() < 0.5);
        assert!((norm(&[0.0, 1.0, 1.001, 1.002, 2.0]) - 1000.0).abs() < 5.0);
        assert!((norm(&[0.0, 1e-3, 1.0, 2.0]) - 667.0).abs() < 1.0);
    }

    /// The loft of numbers: its curves are constants.
    fn values(loft: &Loft, sources: &[f64], v: f64, order: usize) -> f64 {
        let span = loft.knots_v.span(v);
        let basis = crate::basis::basis_derivatives(&loft.knots_v, span, v, order);
        let constant = |j: usize| {
            let combination = &loft.weights[j % loft.curve_count()];
            combination.iter().map(|&(l, weight)| weight * sources[l]).sum::<f64>()
        };
        (0..4).map(|r| basis[order][r] * constant(span - 3 + r)).sum()
    }

    #[test]
    fn every_loft_meets_its_rows_and_its_ends() {
        let v = [0.0, 0.3, 0.35, 0.8, 1.0];
        let sources = [1.0, -2.0, 0.5, 3.0, 2.0, 7.0, -4.0];
        let tol = 1e3 * f64::EPSILON; // norms of some tens
        for has_tangents in [[false, false], [true, false], [false, true], [true, true]] {
            let loft = Loft::interpolating(v.to_vec(), has_tangents, 1.0).unwrap();
            for (&v, exact) in v.iter().zip(sources) {
                assert!((values(&loft, &sources, v, 0) - exact).abs() <= tol);
            }
            let tangents = [sources[5], sources[5 + usize::from(has_tangents[0])]];
            for (end, at) in [(0, 0.0), (1, 1.0)] {
                let order = if has_tangents[end] { 1 } else { 2 };
                let exact = if has_tangents[end] { tangents[end] } else { 0.0 };
                assert!((values(&loft, &sources, at, order) - exact).abs() <= 1e3 * tol, "{has_tangents:?}");
            }
        }
        let closed = Loft::closed(v[..4].to_vec(), 1.0).unwrap();
        assert_eq!(closed.knots_v.domain(), (0.0, 1.0));
        for (&v, exact) in v.iter().zip([1.0, -2.0, 0.5, 3.0, 1.0]) {
            assert!((values(&closed, &sources, v, 0) - exact).abs() <= tol);
        }
        for order in 0..=2 {
            let jump = values(&closed, &sources, 1.0, order) - values(&closed, &sources, 0.0, order);
            assert!(jump.abs() <= 1e4 * tol, "derivative {order} jumps by {jump:e}");
        }
    }
}
