//! Tensor fits: the tables of the method, and what every fit promises.

mod common;

use glam::{DVec2, DVec3};
use planish::Control;
use planish::fit::report::{Remarks, Tolerance, ToleranceScale};
use planish::fit::tessellation::{Method, Regularize, TensorFit, TensorOptions, fit_mesh, fit_points};
use planish::mesh::Mesh;
use planish::samples;

fn fit(mesh: &Mesh, options: &TensorOptions) -> TensorFit {
    fit_mesh(mesh, options, &mut Control::new(2)).unwrap()
}

/// A tolerance of `share` of the largest side, and grids of at most 5,000 knots, as in the table.
fn of_largest_side(mesh: &Mesh, share: f64) -> TensorOptions<'static> {
    let side = mesh.bounds().sides().fold(0.0, f64::max);
    TensorOptions {
        tolerance: Tolerance { value: share * side, scale: ToleranceScale::Absolute },
        max_coefficients: 5000,
        ..TensorOptions::default()
    }
}

#[test]
fn explore() {
    let sphere = samples::sphere_with_holes(5000, 5).unwrap();
    let curved = samples::curved_notch(2).unwrap();
    for (mesh, grids) in [
        (&sphere, vec![[9, 9], [17, 17], [33, 17], [17, 33], [33, 33], [65, 65]]),
        (&curved, vec![[9, 9], [17, 9], [9, 17], [33, 9]]),
    ] {
        for fixed in grids {
            for (method, smoothing) in [(Method::LeastSquares, 1e-6), (Method::Ferguson, 1e-3)] {
                let options = TensorOptions {
                    method,
                    smoothing,
                    fixed_grid: Some(fixed),
                    ..of_largest_side(mesh, 1e-4)
                };
                let r = fit(mesh, &options).report;
                eprintln!(
                    "{method:?} {fixed:?} max {:.2e} rms {:.2e} interior {:.2e} sag {:.2e} tol {:.2e} {:?}",
                    r.max_error, r.rms_error, r.max_interior_error, r.facet_sagitta, r.tolerance, r.remarks
                );
            }
        }
    }
}
