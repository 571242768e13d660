//! Curves on uniform knots, from rows of numbers over one parameter.
//!
//! The methods of surfaces on uniform grids ([`super::tensor`]) with one parameter less: cells are halved until every
//! datum lies within the tolerance. A curve that swings between its data is not within it. Where none is, the curve
//! is the one that predicts each datum best from the others (P. Craven and G. Wahba, "Smoothing noisy data with spline
//! functions", Numer. Math. 31 (1979), 377-403):
//! ```text
//! minimize over mu  sum_n (r_n / (1 - h_n))^2,    h_n = w_n b_n^T A^-1 b_n
//! ```
//! r_n the error of datum n, b_n the basis there, A the matrix of the normal equations.

mod between;
mod options;

pub use options::CurveOptions;

use super::common::checks::{LEAST_RANGE, check_values};
use super::common::errors::{DataErrors, summarize};
use super::common::interior::InteriorErrors;
use super::common::report::{FitReport, Goal, StopReason};
use super::common::rounds::{self, Next, Outcome, Rounds, Standing};
use super::common::uniform::ferguson;
use super::common::uniform::grid::{Direction, UniformBasis, UniformGrid};
use super::common::uniform::{Method, SMOOTHING_LADDER};
use super::common::{FitError, Frame};
use crate::control::Control;
use crate::curve::Curve;
use crate::geometry::Bounds;
use crate::linalg::{Cholesky, SymbolicCholesky};
use crate::memory::{self, CollectVec};
use between::{Between, distance};
use sprs::CsMat;
use std::time::Instant;

/// A fitted curve with all that is known of it.
#[derive(Debug, Clone)]
pub struct CurveFit {
    /// The curve.
    pub curve: Curve,
    /// What the fit did and how good it is; there is one row of cells, so `grid_v` is 1.
    pub report: FitReport,
    /// The error of each datum.
    pub errors: Vec<f64>,
}

/// Fits rows of `dim` numbers at parameters `u` by a curve, halving all cells until the tolerance is met.
pub fn fit_curve(
    u: &[f64],
    values: &[f64],
    dim: usize,
    options: &CurveOptions,
    control: &mut Control,
) -> Result<CurveFit, FitError> {
    let start = Instant::now();
    let mut problem = CurveProblem::new(u, values, dim, options)?;
    let mut outcome = rounds::run(&mut problem, control)?;
    if outcome.best.merit() > problem.goal.tolerance && problem.may_choose_smoothing() {
        outcome.best = problem.best_predictor(outcome.best)?;
    }
    let mut fit = problem.finish(outcome);
    fit.report.seconds = start.elapsed().as_secs_f64();
    Ok(fit)
}

/// Knots of the first grid.
const FIRST_COUNT: usize = 2;
/// So many rounds in a row that do not lower the error end the fit.
const STAGNANT_ROUNDS: usize = 2;
/// Smoothings beyond the ladder for data that no curve follows within the tolerance.
const CALM: [f64; 4] = [1e1, 1e0, 1e-1, 1e-2];

/// Data, what they are fitted with, and how far the fit has come.
struct CurveProblem<'a> {
    u: &'a [f64],
    values: &'a [f64],
    dim: usize,
    options: &'a CurveOptions<'a>,
    frame: Frame,
    range: (f64, f64),
    goal: Goal,
    between: Between,
    /// Knots of the next round.
    count: usize,
}

struct Candidate {
    curve: Curve,
    errors: DataErrors,
    between: InteriorErrors,
    smoothing: f64,
    count: usize,
    coefficient_count: usize,
}

impl Rounds for CurveProblem<'_> {
    type Round = Candidate;
    type Error = FitError;

    fn fit(&mut self, _: &mut Control) -> Result<Candidate, FitError> {
        self.fit_grid(self.count)
    }

    fn error(&self, round: &Candidate) -> f64 {
        round.merit()
    }

    fn tolerance(&self) -> f64 {
        self.goal.tolerance
    }

    fn refine(&mut self, standing: &Standing<Candidate>, _: &Control) -> Next {
        if standing.error <= self.goal.tolerance {
            return Next::Done;
        }
        if self.options.fixed_count.is_some() {
            return Next::Stop(StopReason::FixedGrid);
        }
        if standing.idle >= STAGNANT_ROUNDS {
            return Next::Stop(StopReason::Stagnated);
        }
        self.count = 2 * self.count - 1;
        if self.count > self.options.max_grid {
            return Next::Stop(StopReason::Limit);
        }
        if self.coefficient_count(self.count) > self.u.len() {
            return Next::Stop(StopReason::DataExhausted);
        }
        Next::Round
    }
}

impl<'a> CurveProblem<'a> {
    fn new(
        u: &'a [f64],
        values: &'a [f64],
        dim: usize,
        options: &'a CurveOptions<'a>,
    ) -> Result<Self, FitError> {
        options.check()?;
        check_values(u.len(), values, dim, options.weights)?;
        if let Some(index) = u.iter().position(|u| !u.is_finite()) {
            return Err(FitError::ParametersNotFinite { index });
        }
        let range = u.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), &u| (a.min(u), b.max(u)));
        if range.1 - range.0 <= LEAST_RANGE * range.0.abs().max(range.1.abs()) {
            return Err(FitError::DegenerateRange { axis: 'u', at: range.0 });
        }
        let bounds = Bounds::of_rows(values, dim);
        let goal = Goal::new(&options.tolerance, &bounds);
        let (frame, count) = (Frame::new(&bounds), options.fixed_count.unwrap_or(FIRST_COUNT));
        let between = Between::new(u, values, dim);
        Ok(Self { u, values, dim, options, frame, range, goal, between, count })
    }

    fn basis(&self, count: usize) -> UniformBasis {
        let grid = UniformGrid::over(self.range.0, self.range.1, self.options.buffer, count);
        UniformBasis { grid, ends: self.options.ends }
    }

    fn coefficient_count(&self, count: usize) -> usize {
        self.basis(count).len()
    }

    /// Whether the caller has left the smoothing to the fit.
    fn may_choose_smoothing(&self) -> bool {
        self.options.method == Method::LeastSquares && self.options.smoothing == 0.0
    }

    /// The fit over the same knots that predicts each datum best from the others.
    fn best_predictor(&self, missed: Candidate) -> Result<Candidate, FitError> {
        let basis = self.basis(missed.count);
        let mut best = (f64::INFINITY, missed);
        for smoothing in CALM.into_iter().chain(SMOOTHING_LADDER) {
            let system = self.system(&basis, smoothing)?;
            let candidate = self.solve(&basis, &system, smoothing)?;
            let errors = candidate.errors.each.iter().zip(system.leverages(self, &basis));
            let sum = errors.map(|(error, leverage)| (error / (1.0 - leverage)).powi(2)).sum::<f64>();
            if sum < best.0 {
                best = (sum, candidate);
            }
        }
        Ok(best.1)
    }

    fn fit_grid(&self, count: usize) -> Result<Candidate, FitError> {
        let basis = self.basis(count);
        let asked = self.options.smoothing;
        let tolerance = self.goal.tolerance;
        match self.options.method {
            Method::Ferguson => {
                let smoothing = if asked > 0.0 { asked } else { SMOOTHING_LADDER[0] };
                let values = self.frame.inward(self.values);
                let points = ferguson::fit_line(&basis.grid, self.u, &values, self.dim, smoothing)?;
                self.candidate(&basis, points, smoothing, count)
            }
            Method::LeastSquares if asked > 0.0 => self.least_squares(&basis, asked),
            Method::LeastSquares => {
                let mut best = self.least_squares(&basis, SMOOTHING_LADDER[0])?;
                for &smoothing in &SMOOTHING_LADDER[1..] {
                    if best.merit() <= tolerance {
                        break;
                    }
                    let closer = self.least_squares(&basis, smoothing)?;
                    if closer.merit() < best.merit() {
                        best = closer;
                    }
                }
                Ok(best)
            }
        }
    }

    fn least_squares(&self, basis: &UniformBasis, smoothing: f64) -> Result<Candidate, FitError> {
        self.solve(basis, &self.system(basis, smoothing)?, smoothing)
    }

    /// The normal equations, factored.
    fn system(&self, basis: &UniformBasis, smoothing: f64) -> Result<System, FitError> {
        let (n, width, dim) = (basis.len(), basis.width(), self.dim);
        let mut matrix = basis.gram(2);
        matrix.rows.iter_mut().flatten().for_each(|x| *x *= smoothing / 12.0);
        let mut right = memory::filled(0.0, n * dim);
        let values = self.frame.inward(self.values);
        for (datum, &u) in self.u.iter().enumerate() {
            let (cell, s) = basis.grid.locate(u);
            let window = basis.window(cell, s, 0);
            let weight = self.options.weights.map_or(1.0, |weights| weights[datum]);
            matrix.add_square(&window, weight);
            for (k, x) in values[datum * dim..][..dim].iter().enumerate() {
                for a in 0..width {
                    right[k * n + window.first + a] += weight * window.weights[a] * x;
                }
            }
        }
        let starts = (0..=n).map(|i| (0..i).map(|i| 4.min(n - i)).sum()).collect_vec();
        let entries = || (0..n).flat_map(|i| (0..4.min(n - i)).map(move |d| (i, d)));
        let rows = entries().map(|(i, d)| i + d).collect_vec();
        let data = entries().map(|(i, d)| matrix.rows[i][d]).collect_vec();
        let matrix = CsMat::new_csc((n, n), starts, rows, data);
        let symbolic = SymbolicCholesky::new(&matrix.view(), Some(&(0..n).collect_vec()));
        let factor = symbolic.factor(&matrix.view()).map_err(|_| FitError::Singular)?;
        Ok(System { factor, right })
    }

    fn solve(&self, basis: &UniformBasis, system: &System, smoothing: f64) -> Result<Candidate, FitError> {
        let (n, dim) = (basis.len(), self.dim);
        let mut right = system.right.clone();
        system.factor.solve(&mut right, dim);
        let unknowns: Vec<f64> =
            (0..n).flat_map(|i| (0..dim).map(move |k| (i, k))).map(|(i, k)| right[k * n + i]).collect_vec();
        self.candidate(basis, basis.control_points(&unknowns, dim), smoothing, n)
    }

    fn candidate(
        &self,
        basis: &UniformBasis,
        mut control_points: Vec<f64>,
        smoothing: f64,
        coefficient_count: usize,
    ) -> Result<Candidate, FitError> {
        self.frame.outward(&mut control_points);
        let knots = basis.grid.knot_vector();
        let knots = knots.map_err(|_| FitError::DegenerateRange { axis: 'u', at: self.range.0 })?;
        // an overflow in the solution is the one thing that can be wrong
        let curve = Curve::new(self.dim, knots, control_points).map_err(|_| FitError::Singular)?;
        let mut measured = memory::filled(0.0, self.values.len());
        curve.eval_rows(self.u, 0, &mut measured);
        let rows = measured.chunks(self.dim).zip(self.values.chunks(self.dim));
        let errors = summarize(rows.map(|(a, b)| distance(a, b)).collect_vec());
        let between = self.between.measure(&curve);
        Ok(Candidate { curve, errors, between, smoothing, count: basis.grid.count, coefficient_count })
    }

    fn finish(&self, outcome: Outcome<Candidate>) -> CurveFit {
        let Outcome { best, stop, passes } = outcome;
        let mut report = FitReport {
            grid_u: best.count,
            grid_v: 1,
            coefficient_count: best.coefficient_count,
            smoothing: best.smoothing,
            ..FitReport::new(&best.errors, &self.goal, stop, passes)
        };
        report.add_interior(&best.between);
        CurveFit { curve: best.curve, report, errors: best.errors.each }
    }
}

/// Normal equations, factored.
struct System {
    factor: Cholesky,
    /// Columns of unknowns, one for each component.
    right: Vec<f64>,
}

impl System {
    /// How much each datum decides of the curve's value at its place, 0 to 1.
    fn leverages(&self, problem: &CurveProblem, basis: &UniformBasis) -> Vec<f64> {
        /// Columns solved at once: a bound on memory.
        const CHUNK: usize = 64;
        let n = basis.len();
        let window = |u: f64| {
            let (cell, s) = basis.grid.locate(u);
            basis.window(cell, s, 0)
        };
        let mut leverages = memory::with_capacity(problem.u.len());
        for chunk in problem.u.chunks(CHUNK) {
            let mut columns = memory::filled(0.0, n * chunk.len());
            let entries = |k: usize, u: f64| {
                let window = window(u);
                (0..basis.width()).map(move |a| (k * n + window.first + a, window.weights[a]))
            };
            for (k, &u) in chunk.iter().enumerate() {
                entries(k, u).for_each(|(at, weight)| columns[at] = weight);
            }
            self.factor.solve(&mut columns, chunk.len());
            for (k, &u) in chunk.iter().enumerate() {
                let weight = problem.options.weights.map_or(1.0, |weights| weights[leverages.len()]);
                let own: f64 = entries(k, u).map(|(at, share)| share * columns[at]).sum();
                // rounding must not make a datum decide all
                memory::push(&mut leverages, (weight * own).min(MOST_LEVERAGE));
            }
        }
        leverages
    }
}

/// A datum that decides all of its own value is predicted by none of the others.
const MOST_LEVERAGE: f64 = 1.0 - 1e-9;

#[cfg(test)]
mod tests {
    use super::*;

    fn fixed(method: Method, count: usize, smoothing: f64, buffer: f64) -> CurveOptions<'static> {
        CurveOptions { method, smoothing, buffer, fixed_count: Some(count), ..CurveOptions::default() }
    }

    fn error_sum(u: &[f64], x: &[f64], options: &CurveOptions) -> (f64, Curve) {
        let fit = fit_curve(u, x, 1, options, &mut Control::new(1)).unwrap();
        (fit.errors.iter().map(|e| e * e).sum(), fit.curve)
    }

    #[test]
    fn three_data_on_one_cell_have_the_fits_worked_out_by_hand() {
        let (u, x) = ([0.0, 0.25, 1.0], [0.0, 1.0, 0.0]);
        // no smoothing: the least positive number stands for none
        let none = f64::MIN_POSITIVE;
        let tol = 1e-14; // a 2 x 2 system of condition 10
        let (error, curve) = error_sum(&u, &x, &fixed(Method::LeastSquares, 2, none, 0.0));
        assert!((error - 8.0 / 13.0).abs() < tol, "{error}");
        assert!((curve.eval(0.0)[0] - 6.0 / 13.0).abs() < tol);
        assert!((curve.eval(1.0)[0] - 2.0 / 13.0).abs() < tol);
        let (error, curve) = error_sum(&u, &x, &fixed(Method::Ferguson, 2, none, 0.0));
        assert!((error - 7112.0 / 11449.0).abs() < tol, "{error}");
        assert!((curve.eval(0.0)[0] - 54.0 / 107.0).abs() < tol);
        assert!((curve.eval(1.0)[0] - 10.0 / 107.0).abs() < tol);
    }
}
