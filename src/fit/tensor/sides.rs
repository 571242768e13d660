//! Sides of a tensor surface that are given, as conditions on its control points.
//!
//! Along a side at the begin or end of a clamped direction the first row of control points is that of the side's curve, and
//! the second adds the derivative across:
//! ```text
//! c_0 = b                 b the control points of the curve over the lines of the net
//! c_1 - c_0 = h k a / 3   a those of the neighbour's derivative across it, h the first cell
//! ```

use super::lines::Lines;
use super::{FitError, Problem};
use crate::curve::Curve;
use crate::fit::common::sides::GivenSide;
use crate::fit::common::uniform::grid::Direction;
use crate::fit::common::uniform::normal_equations::TensorBasis;
use crate::linalg::Condition;

impl Problem<'_> {
    /// The conditions of all sides that are given.
    pub(crate) fn side_conditions(&self, basis: &TensorBasis<Lines>) -> Vec<Condition> {
        self.sides.iter().flat_map(|side| self.conditions_of(side, basis)).collect()
    }

    /// The conditions of a side on a surface over some lines, in the frame of the problem.
    fn conditions_of(&self, side: &GivenSide, basis: &TensorBasis<Lines>) -> Vec<Condition> {
        let across = if side.across_axis() == 0 { &basis.u } else { &basis.v };
        let along = if side.across_axis() == 0 { &basis.v } else { &basis.u };
        let count_v = basis.v.len();
        let last = across.len() - 1;
        let number = |depth: usize, j: usize| {
            let i = if side.is_end() { last - depth } else { depth };
            if side.across_axis() == 0 { i * count_v + j } else { j * count_v + i }
        };
        let dim = self.dim;
        let Ok(curve) = on_lines(&side.curve, along) else { return Vec::new() };
        let places = self.frame.inward(&curve);
        let position = places.chunks_exact(dim).enumerate();
        let mut conditions: Vec<Condition> = position
            .map(|(j, row)| Condition { terms: vec![(number(0, j), 1.0)], values: row.to_vec() })
            .collect();
        if let Some(slopes) = side.across.as_ref().and_then(|slopes| on_lines(slopes, along).ok()) {
            let breaks = across.breaks();
            let cell = if side.is_end() { breaks.len() - 2 } else { 0 };
            let share = (breaks[cell + 1] - breaks[cell]) / 3.0 / self.frame.scale;
            conditions.extend(slopes.chunks_exact(dim).enumerate().map(|(j, row)| Condition {
                terms: vec![(number(1, j), 1.0), (number(0, j), -1.0)],
                values: row.iter().map(|x| share * x).collect(),
            }));
        }
        conditions
    }
}

/// The control points of a curve over more lines.
fn on_lines(curve: &Curve, lines: &Lines) -> Result<Vec<f64>, FitError> {
    let own = curve.knots().breaks();
    let inner = &lines.breaks()[1..lines.breaks().len() - 1];
    let added: Vec<f64> = inner.iter().copied().filter(|line| !own.contains(line)).collect();
    let curve = curve.insert_knots(&added).map_err(|_| FitError::Singular)?;
    Ok(curve.control_points().to_vec())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::Control;
    use crate::fit::common::report::{Tolerance, ToleranceScale};
    use crate::fit::common::shell::{assert_same_ends, assert_smooth, half, shell};
    use crate::fit::common::sides::{Sides, side_of};
    use crate::fit::tensor::{TensorOptions, fit_points};
    use crate::knots::KnotVector;
    use crate::surface::tensor::TensorSurface;

    fn options<'a>() -> TensorOptions<'a> {
        let tolerance = Tolerance { value: 1e-4, scale: ToleranceScale::Relative };
        TensorOptions { tolerance, buffer: 0.0, ..TensorOptions::default() }
    }

    #[test]
    fn halves_of_a_shell_share_their_curve_and_their_tangent_planes() {
        let (uv, values) = half(0.0);
        let first = fit_points(&uv, &values, 3, &options(), &mut Control::new(1)).unwrap();
        let (uv, values) = half(1.0);
        let sides =
            Sides { neighbours: [Some((&first.surface).into()), None, None, None], ..Sides::default() };
        let second =
            fit_points(&uv, &values, 3, &TensorOptions { sides, ..options() }, &mut Control::new(1)).unwrap();
        assert!(second.report.max_error <= second.report.tolerance, "{:?}", second.report);
        assert_smooth(&first.surface, &second.surface, first.report.diagonal);
        assert!(second.report.max_side_error <= 1e-12 * second.report.diagonal, "{:?}", second.report);
        assert!(second.report.max_side_angle <= 1e-10, "{:?}", second.report);
    }

    #[test]
    fn given_curves_are_the_sides_exactly() {
        let (uv, values) = half(0.0);
        let first = fit_points(&uv, &values, 3, &options(), &mut Control::new(1)).unwrap();
        // the curves of a finer surface, over lines of their own
        let [low, high, before, after] =
            [0, 1, 2, 3].map(|side| side_of((&first.surface).into(), side).unwrap().0);
        let curves = [Some(&low), Some(&high), Some(&before), Some(&after)];
        let loose = Tolerance { value: 2e-3, scale: ToleranceScale::Relative };
        let sides = Sides { curves, ..Sides::default() };
        let options = TensorOptions { sides, tolerance: loose, ..options() };
        let fit = fit_points(&uv, &values, 3, &options, &mut Control::new(1)).unwrap();
        assert!(fit.report.max_error <= fit.report.tolerance && fit.report.max_side_angle == 0.0);
        assert!(fit.report.max_side_error <= 1e-12 * fit.report.diagonal, "{:?}", fit.report);
        assert_same_ends(&first.surface, &fit.surface, fit.report.diagonal);
    }

    #[test]
    fn sides_that_do_not_fit_are_refused() {
        let (uv, values) = half(0.0);
        let line =
            |points: Vec<f64>| Curve::new(3, KnotVector::clamped(&[0.0, 1.0], 1).unwrap(), points).unwrap();
        let refuse = |curves: [Option<&Curve>; 4], neighbours: [Option<&TensorSurface>; 4]| {
            let neighbours = neighbours.map(|surface| surface.map(Into::into));
            let options = TensorOptions { sides: Sides { curves, neighbours }, ..options() };
            fit_points(&uv, &values, 3, &options, &mut Control::new(1)).unwrap_err()
        };
        let straight = line([shell(0.0, 0.0), shell(0.0, 1.0)].concat());
        let error = refuse([Some(&straight), None, None, None], [None; 4]);
        let FitError::SideOff { side, distance, tolerance, .. } = error else { panic!("{error}") };
        assert!(side == "the least u" && distance > 0.01 && tolerance < 1e-3, "{error}");
        assert!(error.to_string().contains("the least u"), "{error}");
        let flat = Curve::new(2, KnotVector::clamped(&[0.0, 1.0], 1).unwrap(), vec![0.0; 4]).unwrap();
        assert!(matches!(refuse([Some(&flat), None, None, None], [None; 4]), FitError::SideCurve { .. }));
        let fit = fit_points(&uv, &values, 3, &options(), &mut Control::new(1)).unwrap();
        let [low, _, before, _] = [0, 1, 2, 3].map(|side| side_of((&fit.surface).into(), side).unwrap().0);
        let mut points = before.control_points().to_vec();
        points[2] += 1e-5;
        let moved = before.with_control_points(points);
        let error = refuse([Some(&low), None, Some(&moved), None], [None; 4]);
        assert!(matches!(error, FitError::SidesApart { .. }), "{error}");
        let error = refuse([Some(&low), None, None, None], [Some(&fit.surface), None, None, None]);
        assert!(matches!(error, FitError::SideTwice { .. }), "{error}");
        // the data lie where the neighbour is
        let error = refuse([None; 4], [Some(&fit.surface), None, None, None]);
        assert!(error.to_string().contains("other side"), "{error}");
    }
}
