//! The same methods in one parameter: curves on uniform knots.

use super::common::checks::{LEAST_RANGE, check_values};
use super::common::errors::{DataErrors, summarize};
use super::common::report::{FitReport, Remarks, StopReason};
use super::common::uniform::ferguson;
use super::common::uniform::grid::{UniformBasis, UniformGrid};
use super::common::uniform::{Method, SMOOTHING_LADDER};
use super::common::{FitError, Frame};
use super::tensor::{TensorOptions, check_options};
use crate::control::Control;
use crate::curve::Curve;
use crate::geometry::Bounds;
use crate::linalg::SymbolicCholesky;
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
    options: &TensorOptions,
    control: &mut Control,
) -> Result<CurveFit, FitError> {
    let start = Instant::now();
    let problem = CurveProblem::new(u, values, dim, options)?;
    let mut count = options.fixed_grid.map_or(2, |[count, _]| count);
    let mut best = problem.fit_grid(count)?;
    let mut passes = 1;
    let mut stagnant = 0;
    let tolerance = problem.tolerance.0;
    let stop = loop {
        control.report((tolerance / best.errors.max).min(1.0), best.errors.max)?;
        if best.errors.max <= tolerance {
            break StopReason::ToleranceMet;
        }
        if options.fixed_grid.is_some() {
            break StopReason::FixedGrid;
        }
        if stagnant >= 2 {
            break StopReason::Stagnated;
        }
        count = 2 * count - 1;
        if count > options.max_grid {
            break StopReason::Limit;
        }
        if count > u.len().max(64) {
            break StopReason::DataExhausted;
        }
        let candidate = problem.fit_grid(count)?;
        passes += 1;
        if candidate.errors.max < best.errors.max {
            (best, stagnant) = (candidate, 0);
        } else {
            stagnant += 1;
        }
    };
    Ok(problem.finish(best, stop, passes, start))
}

struct CurveProblem<'a> {
    u: &'a [f64],
    values: &'a [f64],
    dim: usize,
    options: &'a TensorOptions<'a>,
    bounds: Bounds,
    frame: Frame,
    range: (f64, f64),
    tolerance: (f64, bool),
}

struct Candidate {
    curve: Curve,
    errors: DataErrors,
    smoothing: f64,
    count: usize,
    coefficient_count: usize,
}

impl<'a> CurveProblem<'a> {
    fn new(
        u: &'a [f64],
        values: &'a [f64],
        dim: usize,
        options: &'a TensorOptions<'a>,
    ) -> Result<Self, FitError> {
        check_options(options)?;
        check_values(u.len(), values, dim, options.weights)?;
        if let Some(index) = u.iter().position(|u| !u.is_finite()) {
            return Err(FitError::ParametersNotFinite { index });
        }
        let range = u.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), &u| (a.min(u), b.max(u)));
        if range.1 - range.0 <= LEAST_RANGE * range.0.abs().max(range.1.abs()) {
            return Err(FitError::DegenerateRange { axis: 'u', at: range.0 });
        }
        let bounds = Bounds::of_rows(values, dim);
        let tolerance = options.tolerance.absolute(&bounds);
        let frame = Frame::new(&bounds);
        Ok(Self { u, values, dim, options, bounds, frame, range, tolerance })
    }

    fn fit_grid(&self, count: usize) -> Result<Candidate, FitError> {
        let grid = UniformGrid::over(self.range.0, self.range.1, self.options.buffer, count);
        let basis = UniformBasis { grid, ends: self.options.ends };
        let asked = self.options.smoothing;
        let tolerance = self.tolerance.0;
        match self.options.method {
            Method::Ferguson => {
                let smoothing = if asked > 0.0 { asked } else { SMOOTHING_LADDER[0] };
                let values = self.frame.inward(self.values);
                let points = ferguson::fit_line(&grid, self.u, &values, self.dim, smoothing)?;
                self.candidate(&basis, points, smoothing, count)
            }
            Method::LeastSquares if asked > 0.0 => self.least_squares(&basis, asked),
            Method::LeastSquares => {
                let mut closest = self.least_squares(&basis, SMOOTHING_LADDER[0])?;
                for &smoothing in &SMOOTHING_LADDER[1..] {
                    if closest.errors.max <= tolerance {
                        break;
                    }
                    closest = self.least_squares(&basis, smoothing)?;
                }
                Ok(closest)
            }
        }
    }

    fn least_squares(&self, basis: &UniformBasis, smoothing: f64) -> Result<Candidate, FitError> {
        let (n, width, dim) = (basis.len(), basis.width(), self.dim);
        let mut matrix = basis.gram(2);
        matrix.rows.iter_mut().flatten().for_each(|x| *x *= smoothing / 12.0);
        let mut right = vec![0.0; n * dim];
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
        let starts = (0..=n).map(|i| (0..i).map(|i| 4.min(n - i)).sum()).collect();
        let entries = || (0..n).flat_map(|i| (0..4.min(n - i)).map(move |d| (i, d)));
        let rows = entries().map(|(i, d)| i + d).collect();
        let data = entries().map(|(i, d)| matrix.rows[i][d]).collect();
        let matrix = CsMat::new_csc((n, n), starts, rows, data);
        let symbolic = SymbolicCholesky::new(&matrix.view(), Some(&(0..n).collect::<Vec<_>>()));
        let factor = symbolic.factor(&matrix.view()).map_err(|_| FitError::Singular)?;
        factor.solve(&mut right, dim);
        let unknowns: Vec<f64> =
            (0..n).flat_map(|i| (0..dim).map(move |k| (i, k))).map(|(i, k)| right[k * n + i]).collect();
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
        let mut measured = vec![0.0; self.values.len()];
        curve.eval_rows(self.u, 0, &mut measured);
        let rows = measured.chunks(self.dim).zip(self.values.chunks(self.dim));
        let distance =
            |(a, b): (&[f64], &[f64])| a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt();
        let errors = summarize(rows.map(distance).collect());
        Ok(Candidate { curve, errors, smoothing, count: basis.grid.count, coefficient_count })
    }

    fn finish(&self, best: Candidate, stop: StopReason, passes: usize, start: Instant) -> CurveFit {
        let (tolerance, raised) = self.tolerance;
        let mut remarks = Remarks::default();
        remarks.add_if(best.errors.max > tolerance, Remarks::TOLERANCE_NOT_MET);
        remarks.add_if(stop == StopReason::Stagnated, Remarks::STAGNATED);
        remarks.add_if(raised, Remarks::TOLERANCE_RAISED);
        let report = FitReport {
            max_error: best.errors.max,
            rms_error: best.errors.rms,
            mean_error: best.errors.mean,
            worst_index: best.errors.worst_index,
            tolerance,
            diagonal: self.bounds.diagonal(),
            max_distance: f64::NAN,
            grid_u: best.count,
            grid_v: 1,
            coefficient_count: best.coefficient_count,
            smoothing: best.smoothing,
            passes,
            stop,
            seconds: start.elapsed().as_secs_f64(),
            remarks,
            ..FitReport::default()
        };
        CurveFit { curve: best.curve, report, errors: best.errors.each }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fixed(method: Method, count: usize, smoothing: f64, buffer: f64) -> TensorOptions<'static> {
        TensorOptions { method, smoothing, buffer, fixed_grid: Some([count, 2]), ..TensorOptions::default() }
    }

    fn error_sum(u: &[f64], x: &[f64], options: &TensorOptions) -> (f64, Curve) {
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
