//! Foot points: the local minimum of the distance on one cell.
//!
//! Newton's method on `|S - P|^2 / 2` within the box of the cell, by active sets: a parameter at its bound stays
//! there while the slope points outward. Where the Hessian is not positive, and where a step fails, it is damped
//! (K. Levenberg 1944, D. Marquardt 1963), starting from the Gauss-Newton matrix, which never is negative.

use super::kernel::{Form, MAX_FUNCTIONS};
use crate::linalg::Symmetric2;
use glam::DVec2;

/// Most steps; a regular foot point takes three or four, a singular one some twenty.
const MAX_STEPS: usize = 60;
/// A Newton step this short against the cell is followed by one of about its square, which moves the place by
/// roundoff and the distance not at all.
const LAST_STEP: f64 = 1e-7;
/// Steps this short change nothing.
const SHORTEST_STEP: f64 = 1e-14;
/// The first damping, against the curvature of the distance: a step in a valley loses a thousandth of its length.
const FIRST_DAMPING: f64 = 1e-3;
/// Damping this weak no longer shortens a step by as much as the next one gains: it is left out.
const LEAST_DAMPING: f64 = 1e-6;
/// Damping this strong makes steps of nothing: there is no lower place.
const MOST_DAMPING: f64 = 1e12;

/// A place on a cell.
#[derive(Debug, Clone, Copy)]
pub(super) struct Foot {
    /// In the unit square.
    pub at: [f64; 2],
    /// Squared distance there.
    pub distance_sq: f64,
}

/// Half the squared distance with its derivatives.
#[derive(Debug, Clone, Copy, Default)]
struct Local {
    distance_sq: f64,
    slope: [f64; 2],
    /// The full Hessian.
    hessian: Symmetric2,
    /// The part of it without second derivatives of the surface.
    metric: Symmetric2,
}

/// The squared distance at a place.
#[inline(always)]
pub(super) fn distance_sq(form: &Form, cell: &[f64], at: [f64; 2]) -> f64 {
    local(form, cell, at).distance_sq
}

/// The local minimum that Newton's method finds from `start`.
#[inline(always)]
pub(super) fn find(form: &Form, cell: &[f64], start: [f64; 2]) -> Foot {
    let mut at = start;
    let mut here = local(form, cell, at);
    let mut damping = 0.0;
    for _ in 0..MAX_STEPS {
        let step = constrained_step(form, &here, at, damping);
        let next = [0, 1].map(|k| (at[k] + step[k]).clamp(0.0, 1.0));
        let length = (next[0] - at[0]).abs().max((next[1] - at[1]).abs());
        if length < SHORTEST_STEP {
            break;
        }
        let there = local(form, cell, next);
        // near the minimum the distance no longer tells which of two places is lower
        let is_lower = there.distance_sq <= here.distance_sq || length < LAST_STEP;
        if is_lower {
            (at, here) = (next, there);
            if damping == 0.0 && length < LAST_STEP {
                break;
            }
            damping = if damping < LEAST_DAMPING { 0.0 } else { damping / 16.0 };
        } else if damping > MOST_DAMPING {
            break;
        } else {
            damping = if damping == 0.0 { FIRST_DAMPING } else { damping * 8.0 };
        }
    }
    Foot { at, distance_sq: here.distance_sq }
}

/// The step to the minimum of the quadratic model, with the parameters at their bounds held where the slope
/// points outward.
#[inline(always)]
fn constrained_step(form: &Form, here: &Local, at: [f64; 2], damping: f64) -> [f64; 2] {
    let is_held = |k: usize| {
        (at[k] <= 0.0 && here.slope[k] >= 0.0)
            || (at[k] >= 1.0 && here.slope[k] <= 0.0)
            || form.degree[k] == 0
    };
    let added = damping * here.metric.trace();
    let along = |k: usize| {
        let [bent, flat] = [here.hessian, here.metric].map(|matrix| [matrix.uu, matrix.vv][k]);
        let curvature = if bent > 0.0 { bent } else { flat };
        single_step(here.slope[k], curvature + added)
    };
    match [is_held(0), is_held(1)] {
        [true, true] => [0.0; 2],
        [true, false] => [0.0, along(1)],
        [false, true] => [along(0), 0.0],
        [false, false] => {
            let matrix = if here.hessian.is_positive() { here.hessian } else { here.metric };
            boxed_step(here, matrix.shifted(added), at)
        }
    }
}

/// A determinant below this share of the product of its diagonal is rounding: 45 roundings of that product. With less
/// a step would be noise; with more, skew patches would be searched along their slopes, which takes longer.
const PARALLEL: f64 = 1e-14;

/// The minimum of the model in the box around `at`, or on the side it crosses first.
#[inline(always)]
fn boxed_step(here: &Local, matrix: Symmetric2, at: [f64; 2]) -> [f64; 2] {
    let [p, q] = here.slope;
    let Symmetric2 { uu: a, uv: b, vv: c } = matrix;
    let clip = |k: usize, step: f64| step.clamp(-at[k], 1.0 - at[k]);
    if matrix.is_within(PARALLEL) {
        // parallel tangents: down the slope to the minimum of the model along it
        let curvature = (a * p + 2.0 * b * q) * p + c * q * q;
        let length = if curvature > 0.0 { (p * p + q * q) / curvature } else { 1.0 };
        return [clip(0, -length * p), clip(1, -length * q)];
    }
    let mut step = matrix.solve(DVec2::new(-p, -q)).to_array();
    // beyond a side the other parameter's best place moves with the one that is held
    let excess = [0, 1].map(|k| (step[k] - clip(k, step[k])).abs());
    if excess[0] > 0.0 && excess[0] >= excess[1] {
        step[0] = clip(0, step[0]);
        step[1] = single_step(q + b * step[0], c);
    } else if excess[1] > 0.0 {
        step[1] = clip(1, step[1]);
        step[0] = single_step(p + b * step[1], a);
    }
    [clip(0, step[0]), clip(1, step[1])]
}

#[inline(always)]
fn single_step(slope: f64, curvature: f64) -> f64 {
    if curvature > 0.0 { -slope / curvature } else { -slope.signum() * f64::from(slope != 0.0) }
}

/// Bernstein functions of `degree < N` with first and second derivatives.
#[inline(always)]
fn bernstein<const N: usize>(degree: usize, t: f64) -> [[f64; N]; 3] {
    let mut rows = [[0.0; N]; 3];
    rows[0][0] = 1.0;
    for p in 1..degree + 1 {
        if p == degree {
            rows[1] = differences(&rows[0], p - 1, p as f64);
        }
        if p + 1 == degree {
            let once = differences(&rows[0], p - 1, p as f64);
            rows[2] = differences(&once, p, (p + 1) as f64);
        }
        let mut carried = 0.0;
        for r in 0..p {
            let share = rows[0][r];
            rows[0][r] = carried + (1.0 - t) * share;
            carried = t * share;
        }
        rows[0][p] = carried;
    }
    rows
}

/// The derivatives of functions of `degree + 1` from those of `degree`, which has `factor` one more.
#[inline(always)]
fn differences<const N: usize>(functions: &[f64; N], degree: usize, factor: f64) -> [f64; N] {
    let mut rows = [0.0; N];
    let mut carried = 0.0;
    for r in 0..degree + 1 {
        let share = factor * functions[r];
        rows[r] = carried - share;
        carried = share;
    }
    rows[degree + 1] = carried;
    rows
}

/// Compiled once more for bicubic surfaces in space, whose loops have fixed lengths.
#[inline(always)]
fn local(form: &Form, cell: &[f64], at: [f64; 2]) -> Local {
    match *form {
        Form { degree: [3, 3], dim: 3, is_rational: false } => local_of::<4>([3, 3], 3, false, cell, at),
        Form { degree, dim, is_rational } => local_of::<MAX_FUNCTIONS>(degree, dim, is_rational, cell, at),
    }
}

/// Value, u, v, uu, uv, vv of one component.
type Jet = [f64; 6];

#[inline(always)]
fn local_of<const N: usize>(
    [p, q]: [usize; 2],
    dim: usize,
    is_rational: bool,
    cell: &[f64],
    at: [f64; 2],
) -> Local {
    let (rows_u, rows_v) = (bernstein::<N>(p, at[0]), bernstein::<N>(q, at[1]));
    let count = (p + 1) * (q + 1);
    let weight = is_rational.then(|| jet([p, q], &cell[dim * count..], &rows_u, &rows_v));
    let mut sum = Local::default();
    for component in cell[..dim * count].chunks_exact(count) {
        let mut r = jet([p, q], component, &rows_u, &rows_v);
        if let Some(w) = &weight {
            r = divide(&r, w);
        }
        sum.distance_sq += r[0] * r[0];
        sum.slope[0] += r[0] * r[1];
        sum.slope[1] += r[0] * r[2];
        let metric = Symmetric2 { uu: r[1] * r[1], uv: r[1] * r[2], vv: r[2] * r[2] };
        let bent = Symmetric2 { uu: r[0] * r[3], uv: r[0] * r[4], vv: r[0] * r[5] };
        sum.metric = sum.metric + metric;
        sum.hessian = sum.hessian + (metric + bent);
    }
    sum
}

#[inline(always)]
fn jet<const N: usize>(
    [p, q]: [usize; 2],
    component: &[f64],
    rows_u: &[[f64; N]; 3],
    rows_v: &[[f64; N]; 3],
) -> Jet {
    let component = &component[..(p + 1) * (q + 1)];
    let mut lines = [[0.0; N]; 3];
    for i in 0..p + 1 {
        let line = &component[i * (q + 1)..][..q + 1];
        for (order, sums) in lines.iter_mut().enumerate() {
            let share = rows_u[order][i];
            for j in 0..q + 1 {
                sums[j] += share * line[j];
            }
        }
    }
    let mut jet = [0.0; 6];
    for (sum, (a, b)) in jet.iter_mut().zip([(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)]) {
        for j in 0..q + 1 {
            *sum += lines[a][j] * rows_v[b][j];
        }
    }
    jet
}

/// Derivatives of `r / w`: Leibniz' rule.
#[inline(always)]
fn divide(r: &Jet, w: &Jet) -> Jet {
    let s = r[0] / w[0];
    let su = (r[1] - w[1] * s) / w[0];
    let sv = (r[2] - w[2] * s) / w[0];
    let suu = (r[3] - 2.0 * w[1] * su - w[3] * s) / w[0];
    let suv = (r[4] - w[1] * sv - w[2] * su - w[4] * s) / w[0];
    let svv = (r[5] - 2.0 * w[2] * sv - w[5] * s) / w[0];
    [s, su, sv, suu, suv, svv]
}
