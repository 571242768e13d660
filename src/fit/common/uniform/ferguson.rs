//! The equations of the paper itself: values by differentiating with slopes held, slopes by spline sweeps.
//!
//! J. Dannenhoffer and R. Haimes (2009), equations 7 to 16, corrected (docs/theory.md). Unknowns at each knot
//! are the value x and the slopes Xu, Xv, Xuv in cell units. With r_n the residual of datum n, row (i, j) says
//! ```text
//! sum_n phi_ij(n) r_n + mu (bending along i + bending along j) = 0,    phi_ij a value function
//! ```
//! and the slopes are those of natural C2 splines: Xu from x along u, Xv from x along v, Xuv from Xv along u.
//! This is an oblique projection, not least squares.

use super::grid::UniformGrid;
use crate::fit::common::FitError;
use crate::hermite;
use crate::linalg::Entries;
use crate::memory::{self, CollectVec};
use glam::DVec2;

/// The four unknowns of a knot.
const VALUE: usize = 0;
const SLOPE_U: usize = 1;
const SLOPE_V: usize = 2;
const TWIST: usize = 3;

/// Control points over the clamped knots of `grid`, rows of `dim` numbers.
pub(crate) fn fit(
    grid: &[UniformGrid; 2],
    uv: &[DVec2],
    values: &[f64],
    dim: usize,
    smoothing: f64,
) -> Result<Vec<f64>, FitError> {
    let [count_u, count_v] = grid.map(|grid| grid.count);
    let knots = Knots { count_u, count_v };
    let (mut entries, mut right) = (Entries::default(), memory::filled(0.0, knots.unknown_count() * dim));
    add_data(&knots, grid, uv, values, dim, &mut entries, &mut right);
    knots.lines().for_each(|line| bend(&line, smoothing, &mut entries));
    add_sweeps(&knots, &mut entries);
    entries.solve(knots.unknown_count(), &mut right, dim).map_err(|_| FitError::Singular)?;
    Ok(control_points(&knots, &right, dim))
}

/// The same in one parameter: a row of knots without cross slopes.
pub(crate) fn fit_line(
    grid: &UniformGrid,
    u: &[f64],
    values: &[f64],
    dim: usize,
    smoothing: f64,
) -> Result<Vec<f64>, FitError> {
    let knots = Knots { count_u: grid.count, count_v: 1 };
    let line = Line { knots: &knots, is_u: true, at: 0 };
    let n = 2 * grid.count;
    let (mut entries, mut right) = (Entries::default(), memory::filled(0.0, n * dim));
    for (&u, value) in u.iter().zip(values.chunks_exact(dim)) {
        let (i, s) = grid.locate(u);
        let shapes = hermite::shape_functions(s);
        for a in 0..2 {
            let row = line.unknown(VALUE, i + a);
            for b in 0..4 {
                let column = line.unknown([VALUE, SLOPE_U][b / 2], i + b % 2);
                entries.add(row, column, shapes[a] * shapes[b]);
            }
            value.iter().enumerate().for_each(|(k, x)| right[k * n + row] += shapes[a] * x);
        }
    }
    bend(&line, smoothing, &mut entries);
    sweep(&line, VALUE, SLOPE_U, &mut entries);
    entries.solve(n, &mut right, dim).map_err(|_| FitError::Singular)?;
    let columns: Vec<Vec<f64>> = right
        .chunks_exact(n)
        .map(|column| hermite::control_points(&column[..grid.count], &column[grid.count..]))
        .collect_vec();
    Ok((0..grid.count + 2).flat_map(|i| columns.iter().map(move |column| column[i])).collect_vec())
}

/// Numbers the unknowns.
struct Knots {
    count_u: usize,
    count_v: usize,
}

impl Knots {
    fn unknown_count(&self) -> usize {
        4 * self.count_u * self.count_v
    }

    fn unknown(&self, field: usize, i: usize, j: usize) -> usize {
        (field * self.count_u + i) * self.count_v + j
    }

    /// The lines of knots along both directions: for each, its length, the slope across it that belongs to
    /// it, and the unknown of a field at place `k`.
    fn lines(&self) -> impl Iterator<Item = Line<'_>> {
        let along_u = (0..self.count_v).map(|j| Line { knots: self, is_u: true, at: j });
        let along_v = (0..self.count_u).map(|i| Line { knots: self, is_u: false, at: i });
        along_u.chain(along_v)
    }
}

/// A line of knots.
struct Line<'a> {
    knots: &'a Knots,
    is_u: bool,
    at: usize,
}

impl Line<'_> {
    fn len(&self) -> usize {
        if self.is_u { self.knots.count_u } else { self.knots.count_v }
    }

    fn slope(&self) -> usize {
        if self.is_u { SLOPE_U } else { SLOPE_V }
    }

    fn unknown(&self, field: usize, k: usize) -> usize {
        if self.is_u { self.knots.unknown(field, k, self.at) } else { self.knots.unknown(field, self.at, k) }
    }
}

/// Rows `Phi^T [Phi, Gu, Gv, Guv]` and `Phi^T x`.
fn add_data(
    knots: &Knots,
    grid: &[UniformGrid; 2],
    uv: &[DVec2],
    values: &[f64],
    dim: usize,
    entries: &mut Entries,
    right: &mut [f64],
) {
    let n = knots.unknown_count();
    for (uv, value) in uv.iter().zip(values.chunks_exact(dim)) {
        let ((i, s), (j, t)) = (grid[0].locate(uv.x), grid[1].locate(uv.y));
        let (along_u, along_v) = (hermite::shape_functions(s), hermite::shape_functions(t));
        // products of {A, B | C, D}: bit 0 of a function is its knot, bit 1 tells slope from value
        let functions: Vec<(usize, f64)> = (0..16)
            .map(|k| {
                let (a, b) = (k % 4, k / 4);
                let field = [VALUE, SLOPE_U, SLOPE_V, TWIST][a / 2 + 2 * (b / 2)];
                (knots.unknown(field, i + a % 2, j + b % 2), along_u[a] * along_v[b])
            })
            .collect_vec();
        for &(row, weight) in functions.iter().filter(|(unknown, _)| *unknown < n / 4) {
            functions.iter().for_each(|&(column, shape)| entries.add(row, column, weight * shape));
            value.iter().enumerate().for_each(|(k, x)| right[k * n + row] += weight * x);
        }
    }
}

/// The gradient of the bending energy with slopes held, in the rows of the values (equation S and its ends).
fn bend(line: &Line, smoothing: f64, entries: &mut Entries) {
    let mut add = |row: usize, field: usize, k: usize, weight: f64| {
        entries.add(line.unknown(VALUE, row), line.unknown(field, k), smoothing * weight);
    };
    for k in 0..line.len() - 1 {
        // the cell k, k + 1 adds x_k - x_{k+1} + (X_k + X_{k+1})/2 to row k and the opposite to row k + 1
        for (row, sign) in [(k, 1.0), (k + 1, -1.0)] {
            add(row, VALUE, k, sign);
            add(row, VALUE, k + 1, -sign);
            add(row, line.slope(), k, 0.5 * sign);
            add(row, line.slope(), k + 1, 0.5 * sign);
        }
    }
}

/// The slopes are those of natural C2 splines (N1 to N3).
fn add_sweeps(knots: &Knots, entries: &mut Entries) {
    for line in knots.lines() {
        sweep(&line, VALUE, line.slope(), entries);
        if line.is_u {
            sweep(&line, SLOPE_V, TWIST, entries);
        }
    }
}

fn sweep(line: &Line, values: usize, slopes: usize, entries: &mut Entries) {
    let last = line.len() - 1;
    for k in 0..=last {
        let row = line.unknown(slopes, k);
        let (before, after) = (k.saturating_sub(1), (k + 1).min(last));
        entries.add(row, row, if before < k && k < after { 4.0 } else { 2.0 });
        for neighbour in [before, after].into_iter().filter(|&neighbour| neighbour != k) {
            entries.add(row, line.unknown(slopes, neighbour), 1.0);
        }
        entries.add(row, line.unknown(values, before), 3.0);
        entries.add(row, line.unknown(values, after), -3.0);
    }
}

fn control_points(knots: &Knots, unknowns: &[f64], dim: usize) -> Vec<f64> {
    let (n, count_v) = (knots.unknown_count(), knots.count_v);
    let mut points = memory::filled(0.0, (knots.count_u + 2) * (count_v + 2) * dim);
    for k in 0..dim {
        let column = &unknowns[k * n..][..n];
        let along_u = |values: usize, slopes: usize, j: usize| {
            let line = |field| -> Vec<f64> {
                (0..knots.count_u).map(|i| column[knots.unknown(field, i, j)]).collect_vec()
            };
            hermite::control_points(&line(values), &line(slopes))
        };
        let values: Vec<Vec<f64>> = (0..count_v).map(|j| along_u(VALUE, SLOPE_U, j)).collect_vec();
        let slopes: Vec<Vec<f64>> = (0..count_v).map(|j| along_u(SLOPE_V, TWIST, j)).collect_vec();
        for i in 0..knots.count_u + 2 {
            let line = |rows: &[Vec<f64>]| -> Vec<f64> { rows.iter().map(|row| row[i]).collect_vec() };
            for (j, x) in hermite::control_points(&line(&values), &line(&slopes)).into_iter().enumerate() {
                points[(i * (count_v + 2) + j) * dim + k] = x;
            }
        }
    }
    points
}
