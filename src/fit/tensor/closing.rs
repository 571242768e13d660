//! Surfaces that close: after a period they go on as they began, with value, slope and curvature.
//!
//! Over clamped knots these are three conditions for each line of control points:
//! ```text
//! S^(k)(u_0, v) = S^(k)(u_0 + period, v),    k = 0, 1, 2
//! ```

use super::lines::Lines;
use super::{FitError, Problem, TensorOptions};
use crate::fit::common::checks::check_option;
use crate::fit::common::uniform::grid::Direction;
use crate::fit::common::uniform::normal_equations::TensorBasis;
use crate::geometry::Domain;
use crate::linalg::Condition;

/// How often the surface is differentiable where it closes.
const SMOOTHNESS: usize = 2;

impl TensorOptions<'_> {
    /// Whether the surface closes in some direction.
    pub(crate) fn closes(&self) -> bool {
        self.periods != [0.0; 2]
    }

    /// The box of data with the whole periods.
    pub(crate) fn whole_box(&self, mut data_box: Domain) -> Result<Domain, FitError> {
        for (axis, name) in ["period_u", "period_v"].into_iter().enumerate() {
            let period = self.periods[axis];
            if period > 0.0 {
                let holds = data_box.size()[axis] <= period;
                check_option(holds, name, period, "at least the range of the data")?;
                data_box.max[axis] = data_box.min[axis] + period;
            }
        }
        Ok(data_box)
    }
}

impl Problem<'_> {
    /// The conditions under which a surface over some lines closes.
    pub(crate) fn closing_conditions(&self, basis: &TensorBasis<Lines>) -> Vec<Condition> {
        let [count_u, count_v] = [basis.u.len(), basis.v.len()];
        let mut conditions = Vec::new();
        if self.options.periods[0] > 0.0 {
            let number = |i: usize, j: usize| i * count_v + j;
            conditions.extend(self.closing_along(&basis.u, count_v, number));
        }
        if self.options.periods[1] > 0.0 {
            let number = |j: usize, i: usize| i * count_v + j;
            conditions.extend(self.closing_along(&basis.v, count_u, number));
        }
        conditions
    }

    /// The conditions along one direction; `number` is that of a control point by its places along and across it.
    fn closing_along(
        &self,
        lines: &Lines,
        across: usize,
        number: impl Fn(usize, usize) -> usize,
    ) -> Vec<Condition> {
        let last = lines.cell_count() - 1;
        // in units of a cell derivatives are of the size of the control points
        let unit = lines.length(0).min(lines.length(last));
        let places = (0..=SMOOTHNESS).flat_map(|order| (0..across).map(move |place| (order, place)));
        places
            .map(|(order, place)| {
                let ends = [(0, 0.0, 1.0), (last, 1.0, -1.0)];
                let terms = ends.into_iter().flat_map(|(cell, s, sign)| {
                    let window = lines.window(cell, s, order);
                    let scale = sign * (unit / lines.length(cell)).powi(order as i32);
                    let weights = window.weights.into_iter().enumerate();
                    let weights = weights.filter(|(_, weight)| *weight != 0.0);
                    let terms = weights.map(|(r, weight)| (number(window.first + r, place), scale * weight));
                    terms.collect::<Vec<_>>()
                });
                Condition { terms: terms.collect(), values: vec![0.0; self.dim] }
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::Control;
    use crate::fit::common::report::{Tolerance, ToleranceScale};
    use crate::fit::tensor::{Knots, fit_points};
    use crate::samples::Random;
    use crate::surface::Surface;
    use glam::{DVec2, DVec3, FloatExt};
    use std::f64::consts::TAU;

    /// A place on a vase.
    fn place(uv: DVec2) -> [f64; 3] {
        let radius = 1.0 + 0.3 * (3.0 * uv.y).sin() + 0.05 * (2.0 * uv.x).sin() * uv.y;
        [radius * uv.x.cos(), radius * uv.x.sin(), 2.0 * uv.y]
    }

    /// Places on it, none of them on a seam.
    fn vase() -> (Vec<DVec2>, Vec<f64>) {
        let mut random = Random::new(4);
        let uv: Vec<DVec2> =
            (0..3000).map(|_| DVec2::new(1.0 + TAU * random.unit(), random.unit())).collect();
        let values = uv.iter().flat_map(|&uv| place(uv)).collect();
        (uv, values)
    }

    #[test]
    fn a_surface_closes_with_its_curvature() {
        let (uv, values) = vase();
        let start = uv.iter().map(|uv| uv.x).fold(f64::INFINITY, f64::min);
        for knots in [Knots::Adaptive, Knots::Uniform] {
            let options = TensorOptions {
                tolerance: Tolerance { value: 1e-4, scale: ToleranceScale::Relative },
                periods: [TAU, 0.0],
                knots,
                ..TensorOptions::default()
            };
            let fit = fit_points(&uv, &values, 3, &options, &mut Control::new(1)).unwrap();
            let report = fit.report;
            assert!(report.max_error <= report.tolerance, "{report:?}");
            let domain = fit.surface.domain();
            assert_eq!((domain.min.x, domain.max.x), (start, start + TAU));
            let at = |u: f64| {
                let places: Vec<DVec2> = (0..=40)
                    .map(|k| DVec2::new(u, domain.min.y.lerp(domain.max.y, f64::from(k) / 40.0)))
                    .collect();
                let mut rows = vec![0.0; 18 * places.len()];
                fit.surface.eval_rows(&places, 2, &mut rows);
                rows
            };
            for (k, (a, b)) in at(domain.min.x).into_iter().zip(at(domain.max.x)).enumerate() {
                // roundings of places, over a cell of a hundredth in slopes, over its square in curvatures
                let tol = [1e-12, 1e-10, 1e-8][[0, 1, 1, 2, 2, 2][k % 18 / 3]] * report.diagonal;
                assert!((a - b).abs() <= tol, "{k}: {a} {b}");
            }
            // what lies between the data is the vase too, across the seam as elsewhere
            let mut random = Random::new(9);
            let uv: Vec<DVec2> = (0..2000)
                .map(|_| {
                    DVec2::new(start + TAU * random.unit(), domain.min.y.lerp(domain.max.y, random.unit()))
                })
                .collect();
            let mut rows = vec![0.0; 3 * uv.len()];
            fit.surface.eval_rows(&uv, 0, &mut rows);
            for (uv, row) in uv.iter().zip(rows.chunks(3)) {
                let miss = DVec3::from_slice(row).distance(DVec3::from(place(*uv)));
                assert!(miss <= 3.0 * report.tolerance, "{uv}: {miss:e} {report:?}");
            }
        }
    }

    #[test]
    fn a_period_shorter_than_the_data_is_refused() {
        let (uv, values) = vase();
        let options = TensorOptions { periods: [3.0, 0.0], ..TensorOptions::default() };
        let error = fit_points(&uv, &values, 3, &options, &mut Control::new(1)).unwrap_err();
        assert!(error.to_string().contains("period_u is 3"), "{error}");
    }
}
