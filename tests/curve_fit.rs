//! Curve fits against the measured table of the method.

use planish::Control;
use planish::fit::common::uniform::Method;
use planish::fit::curve::{CurveOptions, fit_curve};
use std::f64::consts::PI;

/// Knots, and sums of squared errors of the paper's equations and of least squares, with smoothing 1e-3.
const TABLE: [(usize, f64, f64); 6] = [
    (2, 163.42, 163.33),
    (3, 1.0320, 1.0264),
    (5, 0.32322, 0.30384),
    (9, 0.017485, 2.266e-3),
    (17, 2.903e-4, 7.075e-6),
    (33, 1.536e-5, 3.67e-8),
];

/// Places drawn once at random from 0 to 8, but for two gaps.
const PLACES: [f64; 31] = [
    0.0, 0.0832, 0.4011, 0.4426, 0.8612, 0.8851, 0.903, 1.0895, 1.5744, 1.6914, 1.95, 2.0181, 2.1293, 2.266,
    2.6223, 5.201, 5.2784, 5.4162, 5.5506, 5.5789, 5.6766, 5.6936, 5.8601, 6.2125, 6.3217, 7.5181, 7.5705,
    7.689, 7.8824, 7.8925, 8.0,
];

#[test]
fn a_curve_with_two_gaps_has_the_errors_of_the_table() {
    let wave = |u: &f64| 2.0 + 8.0 * (PI * (u + 0.2) / 8.6).sin() + 0.25 * (2.1 * u).cos();
    let x: Vec<f64> = PLACES.iter().map(wave).collect();
    for (count, ferguson, least_squares) in TABLE {
        for (method, exact) in [(Method::Ferguson, ferguson), (Method::LeastSquares, least_squares)] {
            let options = CurveOptions::default()
                .with_method(method)
                .with_smoothing(1e-3)
                .with_fixed_count(Some(count));
            let fit = fit_curve(&PLACES, &x, 1, &options, &mut Control::new(1)).unwrap();
            let sum: f64 = fit.errors.iter().map(|e| e * e).sum();
            // the table gives three to five digits
            assert!((sum / exact - 1.0).abs() < 2e-3, "{method:?} with {count} knots: {sum} is not {exact}");
        }
    }
}
