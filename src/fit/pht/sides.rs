//! Sides of a PHT-spline that are given: the jets of the vertices on them do not vary.
//!
//! Between two vertices of a side the surface and its derivative across are cubics, which the values and slopes at both
//! determine. With a vertex at each knot of the side's curve they are the curve, and the derivative across that the
//! neighbour tells; that sets f and one slope of each jet, or all four rows.

use super::data::Data;
use super::global::{System, units};
use crate::curve::Curve;
use crate::fit::common::FitError;
use crate::fit::common::report::Goal;
use crate::fit::common::sides::{GivenSide, SideJoints, SideMeasure, Sides};
use crate::linalg::Condition;
use sprs::CsMat;
use std::collections::BTreeMap;

impl Data<'_> {
    /// Takes over the sides that are given.
    pub(crate) fn give_sides(&mut self, sides: &Sides, goal: &Goal) -> Result<(), FitError> {
        let measure = SideMeasure { tolerance: goal.tolerance, diagonal: goal.diagonal };
        let data = (&self.values[..], self.dim);
        let all = GivenSide::all(sides, &self.data_box, &self.uv, data, SideJoints::Tangent, measure);
        self.sides = all.map_err(|error| match error {
            FitError::SideOff { side, index, distance, tolerance } => {
                let index = self.order.get(index).map_or(index, |&given| given as usize);
                FitError::SideOff { side, index, distance, tolerance }
            }
            error => error,
        })?;
        Ok(())
    }
}

/// Unknowns that do not vary, and what they are in each column.
#[derive(Default)]
pub(crate) struct Pinned(BTreeMap<usize, Vec<f64>>);

impl System<'_> {
    /// The unknowns that the sides determine. In a corner the first side has its way.
    pub(crate) fn pinned(&self, data: &Data) -> Pinned {
        let mut pinned = Pinned::default();
        for side in &data.sides {
            for rank in self.vertices_on(side.side) {
                for (row, values) in self.rows_of(side, rank, data) {
                    pinned.0.entry(4 * rank + row).or_insert(values);
                }
            }
        }
        pinned
    }

    /// The rows of the jet of a vertex on a side that the side determines: f and the slope along it, and both across.
    fn rows_of(&self, side: &GivenSide, rank: usize, data: &Data) -> Vec<(usize, Vec<f64>)> {
        let (along, across) = if side.across_axis() == 0 { (2, 1) } else { (1, 2) };
        let t = self.place_of(rank)[1 - side.across_axis()];
        let units = units(self.size_of(rank));
        let scaled = |row: usize, slope: &[f64]| -> Vec<f64> {
            slope.iter().map(|x| x * units[row] / data.frame.scale).collect()
        };
        let [place, slope] = value_and_slope(&side.curve, t);
        let mut rows = vec![(0, data.frame.inward(&place)), (along, scaled(along, &slope))];
        if let Some(slopes) = &side.across {
            let into = if side.is_end() { -1.0 } else { 1.0 };
            let [slope, twist] =
                value_and_slope(slopes, t).map(|row| row.iter().map(|x| into * x).collect::<Vec<f64>>());
            rows.extend([(across, scaled(across, &slope)), (3, scaled(3, &twist))]);
        }
        rows
    }
}

fn value_and_slope(curve: &Curve, t: f64) -> [Vec<f64>; 2] {
    let mut rows = vec![0.0; 2 * curve.dim()];
    curve.eval_rows(&[t], 1, &mut rows);
    let slope = rows.split_off(curve.dim());
    [rows, slope]
}

impl Pinned {
    /// Takes the unknowns out of a system, the lower triangle of its matrix in columns and columns of right-hand sides of
    /// length `n`: what they add goes to the right, and their own rows become what they are.
    pub(crate) fn eliminate(&self, matrix: &mut CsMat<f64>, right: &mut [f64], n: usize) {
        if self.0.is_empty() {
            return;
        }
        for (column, mut entries) in matrix.outer_iterator_mut().enumerate() {
            let by_column = self.0.get(&column);
            for (row, entry) in entries.iter_mut() {
                let by_row = self.0.get(&row);
                if row == column {
                    if let Some(values) = by_column {
                        values.iter().enumerate().for_each(|(k, x)| right[k * n + row] = *entry * x);
                    }
                    continue;
                }
                let mut add = |to: usize, values: &[f64]| {
                    values.iter().enumerate().for_each(|(k, x)| right[k * n + to] -= *entry * x);
                };
                match (by_row, by_column) {
                    (None, None) => continue,
                    (Some(values), None) => add(column, values),
                    (None, Some(values)) => add(row, values),
                    (Some(_), Some(_)) => {}
                }
                *entry = 0.0;
            }
        }
    }

    /// The unknowns to the bit, in a solution.
    pub(crate) fn impose(&self, solution: &mut [f64], n: usize) {
        for (&unknown, values) in &self.0 {
            values.iter().enumerate().for_each(|(k, &x)| solution[k * n + unknown] = x);
        }
    }

    /// A condition on the other unknowns.
    pub(crate) fn without(&self, condition: Condition) -> Condition {
        let mut values = condition.values;
        let mut terms = condition.terms;
        terms.retain(|(unknown, weight)| match self.0.get(unknown) {
            None => true,
            Some(known) => {
                values.iter_mut().zip(known).for_each(|(value, x)| *value -= weight * x);
                false
            }
        });
        Condition { terms, values }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::Control;
    use crate::fit::common::report::{Tolerance, ToleranceScale};
    use crate::fit::common::shell::{RANGE, assert_same_ends, assert_smooth, half};
    use crate::fit::common::sides::{Neighbour, side_of};
    use crate::fit::pht::{Demands, Estimator, PhtOptions, fit_points};
    use crate::fit::tensor;
    use crate::surface::Surface;
    use glam::DVec2;

    fn options<'a>() -> PhtOptions<'a> {
        let tolerance = Tolerance { value: 1e-4, scale: ToleranceScale::Relative };
        PhtOptions { tolerance, ..PhtOptions::default() }
    }

    #[test]
    fn halves_of_a_shell_share_their_curve_and_their_tangent_planes() {
        let (uv, values) = half(0.0);
        let pht = fit_points(&uv, &values, 3, &options(), &mut Control::new(1)).unwrap();
        let free = tensor::TensorOptions {
            tolerance: options().tolerance,
            buffer: 0.0,
            ..tensor::TensorOptions::default()
        };
        let tensor = tensor::fit_points(&uv, &values, 3, &free, &mut Control::new(1)).unwrap();
        let (uv, values) = half(1.0);
        let surfaces: [(Neighbour, &dyn Surface); 2] =
            [((&pht.surface).into(), &pht.surface), ((&tensor.surface).into(), &tensor.surface)];
        for (neighbour, first) in surfaces {
            let sides = Sides { neighbours: [Some(neighbour), None, None, None], ..Sides::default() };
            let options = PhtOptions { sides, ..options() };
            let second = fit_points(&uv, &values, 3, &options, &mut Control::new(1)).unwrap();
            let report = second.report;
            assert!(report.max_error <= report.tolerance, "{report:?}");
            assert_smooth(first, &second.surface, report.diagonal);
            assert!(report.max_side_error <= 1e-12 * report.diagonal, "{report:?}");
            assert!(report.max_side_angle <= 1e-10, "{report:?}");
        }
    }

    #[test]
    fn given_curves_are_the_sides_exactly_beside_fixed_data() {
        let (uv, values) = half(0.0);
        let fine = fit_points(&uv, &values, 3, &options(), &mut Control::new(1)).unwrap();
        let [low, high, before, after] =
            [0, 1, 2, 3].map(|side| side_of((&fine.surface).into(), side).unwrap().0);
        let sides =
            Sides { curves: [Some(&low), Some(&high), Some(&before), Some(&after)], ..Sides::default() };
        let tolerance = Tolerance { value: 2e-3, scale: ToleranceScale::Relative };
        let inner = uv.iter().position(|uv| (uv / RANGE).distance(DVec2::splat(0.4)) < 0.02).unwrap();
        let fixed = [inner as u32];
        let demands = Demands { fixed: &fixed, ..Demands::default() };
        let options = PhtOptions { sides, tolerance, demands, ..options() };
        let fit = fit_points(&uv, &values, 3, &options, &mut Control::new(1)).unwrap();
        assert!(fit.report.max_error <= fit.report.tolerance && fit.report.max_side_angle == 0.0);
        assert!(fit.report.max_side_error <= 1e-12 * fit.report.diagonal, "{:?}", fit.report);
        assert!(fit.report.max_fixed_error <= 1e-12 * fit.report.diagonal, "{:?}", fit.report);
        assert_same_ends(&fine.surface, &fit.surface, fit.report.diagonal);
    }

    #[test]
    fn sides_that_do_not_fit_are_refused_with_the_datum_as_given() {
        let (uv, values) = half(0.0);
        let fine = fit_points(&uv, &values, 3, &options(), &mut Control::new(1)).unwrap();
        let (low, _) = side_of((&fine.surface).into(), 0).unwrap();
        let mut points = low.control_points().to_vec();
        points.iter_mut().skip(2).step_by(3).for_each(|z| *z += 0.1);
        let moved = low.with_control_points(points);
        let refuse =
            |options: &PhtOptions| fit_points(&uv, &values, 3, options, &mut Control::new(1)).unwrap_err();
        let sides = Sides { curves: [Some(&moved), None, None, None], ..Sides::default() };
        let error = refuse(&PhtOptions { sides, ..options() });
        let FitError::SideOff { side: "the least u", index, distance, .. } = error else { panic!("{error}") };
        assert!(uv[index].x == 0.0 && (distance - 0.1).abs() < 1e-3, "{index} {distance}");
        let error = refuse(&PhtOptions { sides, estimator: Estimator::LocalCubic, ..options() });
        assert!(error.to_string().contains("sides"), "{error}");
    }
}
