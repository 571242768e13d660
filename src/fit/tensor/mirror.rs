//! Shapes that are their own mirror images, over free knots: half of them is fitted.
//!
//! The half lies over u from -1 to 0, the first component across the plane, which is odd, the others along it, which are
//! even. Along the mirror u = 0 that asks of a spline that is to continue twice differentiably
//! ```text
//! odd    x = 0, x_uu = 0       even    x_u = 0
//! ```
//! for each function of v. Unfolded, the knot 0 is simple, and the control point over it follows from its neighbours: with
//! the knots a, b, 0 before the end and f the blossom of the last cell, f(b, 0, -b) lies on the line from f(a, b, 0) to
//! f(b, 0, 0).

use super::lines::Lines;
use super::{FitError, Knots, Method, Problem, TensorFit, TensorOptions};
use crate::control::Control;
use crate::fit::common::checks::{check_unused, check_values};
use crate::fit::common::symmetric::{Folded, finish};
use crate::fit::common::uniform::grid::Direction;
use crate::fit::common::uniform::normal_equations::TensorBasis;
use crate::fit::common::{Demands, Half};
use crate::knots::KnotVector;
use crate::linalg::{Condition, Conditions};
use crate::mesh::Mesh;
use crate::surface::tensor::{Axis, TensorSurface};

/// The conditions of a mirror along the end of u; `across` is the plane's place in the frame of the unknowns.
pub(super) fn conditions(basis: &TensorBasis<Lines>, dim: usize, across: f64) -> Vec<Conditions> {
    let last = basis.u.cell_count() - 1;
    let vanish = |order: usize, value: f64, columns: usize| {
        let window = basis.u.window(last, 1.0, order);
        let largest = window.weights.iter().fold(0.0_f64, |most, weight| most.max(weight.abs()));
        let count_v = basis.v.len();
        (0..count_v).map(move |j| Condition {
            terms: (0..4).map(|a| ((window.first + a) * count_v + j, window.weights[a] / largest)).collect(),
            values: vec![value / largest; columns],
        })
    };
    vec![
        Conditions { columns: 0..1, conditions: vanish(0, across, 1).chain(vanish(2, 0.0, 1)).collect() },
        Conditions { columns: 1..dim, conditions: vanish(1, 0.0, dim - 1).collect() },
    ]
}

/// Fits the shape of a mesh that is its own mirror image by a surface that is.
pub(super) fn fit_symmetric(
    mesh: &Mesh,
    options: &TensorOptions,
    control: &mut Control,
) -> Result<TensorFit, FitError> {
    const BY: &str = "the fit of a symmetric shape";
    options.check()?;
    options.demands.check(mesh.points().len())?;
    check_unused(options.method == Method::default(), "method", BY)?;
    check_unused(options.knots == Knots::Adaptive, "knots", BY)?;
    check_unused(options.fixed_grid.is_none(), "grid", BY)?;
    let values: Vec<f64> = mesh.points().iter().flat_map(|p| p.to_array()).collect();
    check_values(mesh.points().len(), &values, 3, options.weights)?;
    let tolerance = options.tolerance;
    control.set_stage(0.0, 0.3);
    let folded =
        Folded::new(mesh, &options.demands, options.weights, &tolerance, &options.parameterize, control)?;
    let half_options = TensorOptions {
        tolerance: folded.tolerance,
        weights: Some(&folded.weights),
        demands: Demands { tolerances: Some(&folded.tolerances), ..Demands::default() },
        buffer: 0.0,
        correction_sweeps: 0,
        ..*options
    };
    control.set_stage(0.3, 1.0);
    let half = &folded.half;
    let mut problem = Problem::new(half.uv.clone(), &half.places, 3, None, &half_options)?;
    problem.is_mirrored = true;
    let fit = problem.fit_any(control)?;
    let surface = unfolded(&fit.surface, half)?;
    let asked = (&folded, &tolerance);
    let mut whole = finish(surface, fit.report, mesh, options.demands.tolerances, asked, control);
    whole.report.grid_u = whole.surface.knots(Axis::U).breaks().len();
    Ok(whole)
}

/// The surface of which a half is given.
fn unfolded(surface: &TensorSurface, half: &Half) -> Result<TensorSurface, FitError> {
    let (u, v) = (surface.knots(Axis::U), surface.knots(Axis::V));
    let (t, row) = (u.knots(), 3 * v.basis_count());
    let own = u.breaks();
    let below = own.len() - 1;
    let points = surface.control_points();
    let (before, after) = (&points[below * row..][..row], &points[(below + 1) * row..][..row]);
    // with a single cell, and no knot before its begin, that counts as one
    let (a, b) = (t[below + 1], t[below + 2]);
    let share = (-b - a) / (0.0 - a);
    let blend = |(k, (x, y)): (usize, (&f64, &f64))| if k % 3 == 0 { 0.0 } else { x + share * (y - x) };
    let middle: Vec<f64> = before.iter().zip(after).enumerate().map(blend).collect();
    let lower = &points[..(below + 1) * row];
    let image = |(k, x): (usize, &f64)| if k % 3 == 0 { -x } else { *x };
    let upper = lower.chunks_exact(row).rev().flat_map(|line| line.iter().enumerate().map(image));
    let mut control_points: Vec<f64> = lower.iter().copied().chain(middle).chain(upper).collect();
    control_points.chunks_exact_mut(3).for_each(|point| half.unfold(point));
    let breaks: Vec<f64> = own.iter().copied().chain(own[..below].iter().rev().map(|x| -x)).collect();
    let knots = KnotVector::clamped(&breaks, 3).map_err(|_| FitError::Singular)?;
    // an overflow is the one thing that can be wrong
    TensorSurface::new(3, knots, v.clone(), control_points, None).map_err(|_| FitError::Singular)
}
