//! Fairness of surfaces that follow the noise of a rough shape.

mod common;

use glam::{DVec2, DVec3};
use planish::Control;
use planish::fit::fair::{FairData, FairLimit, FairOptions, fair};
use planish::fit::pht::{self, PhtOptions};
use planish::fit::report::Tolerance;
use planish::fit::tensor::{self, Ends, TensorOptions};
use planish::surface::{AnySurface, Surface, normal};
use std::path::Path;

/// Rows of u, v, x, y, z as little-endian doubles.
fn points(path: &Path) -> (Vec<DVec2>, Vec<f64>) {
    let bytes = std::fs::read(path).unwrap();
    let numbers: Vec<f64> = bytes.as_chunks().0.iter().map(|&x| f64::from_le_bytes(x)).collect();
    let rows = numbers.chunks_exact(5);
    (rows.clone().map(DVec2::from_slice).collect(), rows.flat_map(|row| row[2..].to_vec()).collect())
}

fn normals(surface: &dyn Surface) -> Vec<DVec3> {
    let middle = |k: i32| (f64::from(k) + 0.5) / 80.0;
    let uv: Vec<DVec2> = (0..6400).map(|k| DVec2::new(middle(k / 80), middle(k % 80))).collect();
    let mut rows = vec![0.0; 9 * uv.len()];
    surface.eval_rows(&uv, 1, &mut rows);
    rows.chunks(9).map(|row| normal(DVec3::from_slice(&row[3..]), DVec3::from_slice(&row[6..]))).collect()
}

fn root_mean_square(a: &[DVec3], b: &[DVec3]) -> f64 {
    let squares = a.iter().zip(b).map(|(a, b)| a.angle_between(*b).powi(2));
    (squares.sum::<f64>() / a.len() as f64).sqrt()
}

/// A tensor surface over so many equal cells, which follows its data as far as they let it.
fn closely(uv: &[DVec2], values: &[f64], knots: usize) -> AnySurface {
    let options = TensorOptions {
        fixed_grid: Some([knots, knots]),
        ends: Ends::Free,
        smoothing: 1e-9,
        buffer: 0.0,
        ..TensorOptions::default()
    };
    tensor::fit_points(uv, values, 3, &options, &mut Control::default()).unwrap().surface.into()
}

#[test]
fn normals_of_a_rough_scan_come_back_from_its_noise() {
    let [Some(clean), Some(noisy)] =
        ["synthetic/rough_4k.f64", "synthetic/rough_4k_noise.f64"].map(common::shared_data)
    else {
        return;
    };
    let (uv, values) = points(&clean);
    let truth = normals(closely(&uv, &values, 56).as_surface());
    let off = |surface: &AnySurface| root_mean_square(&normals(surface.as_surface()), &truth);
    let (uv, values) = points(&noisy);
    let data = FairData { uv: &uv, values: &values };
    let pht = |tolerance: f64, smoothing: f64| -> AnySurface {
        let tolerance = Tolerance { value: tolerance, ..Tolerance::default() };
        let options = PhtOptions { tolerance, smoothing, ..PhtOptions::default() };
        pht::fit_points(&uv, &values, 3, &options, &mut Control::default()).unwrap().surface.into()
    };
    // the noise has a root mean square of 3.5e-4 of the diagonal
    let tolerance = Tolerance { value: 1.5e-3, ..Tolerance::default() };
    // what normals are off by that follow noise falls to that of the best surface of these data, 0.02 to 0.025; a fit that
    // smoothed enough, whose cells are what it is off by, is left almost as it is
    for (name, rough, most) in [
        ("tensor, more unknowns than data", closely(&uv, &values, 64), 0.5),
        ("tensor, as close as 56 cells", closely(&uv, &values, 56), 0.6),
        ("PHT, hardly smoothed", pht(5e-4, 1e-5), 0.5),
        ("PHT", pht(1.5e-3, 1e-3), 1.0),
    ] {
        let options = FairOptions { tolerance, ..FairOptions::default() };
        let fine = fair(&rough, Some(data), &options, &mut Control::default()).unwrap();
        let (before, after, report) = (off(&rough), off(&fine.surface), fine.report);
        println!("{name}: {before:.4} to {after:.4}");
        assert!(after <= most * before, "{name}: {before} {after} {report:?}");
        assert!(report.max_deviation <= report.tolerance, "{name}: {report:?}");
        assert!(report.energy_after <= report.energy_before, "{name}: {report:?}");
        // all of the tolerance would flatten ridges
        let options = options.with_limit(FairLimit::Tolerance);
        let flat = fair(&rough, Some(data), &options, &mut Control::default()).unwrap();
        assert!(off(&flat.surface) >= after, "{name}: {after} {:?}", flat.report);
    }
}
