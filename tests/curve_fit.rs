//! Curve fits against the measured table of the method.

mod common;

use planish::Control;
use planish::fit::tessellation::{Method, TensorOptions, fit_curve};

/// Knots, and sums of squared errors of the paper's equations and of least squares, with smoothing 1e-3.
const TABLE: [(usize, f64, f64); 6] = [
    (2, 163.42, 163.33),
    (3, 1.0320, 1.0264),
    (5, 0.32322, 0.30384),
    (9, 0.017485, 2.266e-3),
    (17, 2.903e-4, 7.075e-6),
    (33, 1.536e-5, 3.67e-8),
];

#[test]
fn a_curve_with_two_gaps_has_the_errors_of_the_table() {
    let Some(path) = common::shared_data("synthetic/curve_two_gaps.txt") else { return };
    let text = std::fs::read_to_string(path).unwrap();
    let rows = text.lines().filter(|line| !line.starts_with('#'));
    let numbers: Vec<f64> =
        rows.flat_map(str::split_whitespace).map(|number| number.parse().unwrap()).collect();
    let (u, x): (Vec<f64>, Vec<f64>) = numbers.chunks(2).map(|row| (row[0], row[1])).unzip();
    for (count, ferguson, least_squares) in TABLE {
        for (method, exact) in [(Method::Ferguson, ferguson), (Method::LeastSquares, least_squares)] {
            let options = TensorOptions {
                method,
                smoothing: 1e-3,
                fixed_grid: Some([count, 2]),
                ..TensorOptions::default()
            };
            let fit = fit_curve(&u, &x, 1, &options, &mut Control::new(1)).unwrap();
            let sum: f64 = fit.errors.iter().map(|e| e * e).sum();
            // the table gives three to five digits
            assert!((sum / exact - 1.0).abs() < 2e-3, "{method:?} with {count} knots: {sum} is not {exact}");
        }
    }
}
