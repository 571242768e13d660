//! What is as small as 1e-100 or as large as 1e100 is fitted as what is of size 1.

use planish::Control;
use planish::fit::d1rc::{self, D1rcFitOptions};
use planish::fit::pht::{self, PhtOptions};
use planish::fit::report::Tolerance;
use planish::fit::tensor::{self, Knots, TensorOptions};
use planish::mesh::{DecimateOptions, Mesh};
use planish::samples;
use planish::surface::Surface;

/// Powers of two, which round nothing: about 1e-100 and 1e100.
const EXPONENTS: [i32; 2] = [-332, 332];

fn scaled(mesh: &Mesh, scale: f64) -> Mesh {
    let points = mesh.points().iter().map(|&p| scale * p).collect();
    let mut scaled = Mesh::new(points, mesh.triangles().to_vec()).unwrap();
    if let Some(uv) = mesh.parameters() {
        scaled.set_parameters(uv.to_vec()).unwrap();
    }
    scaled
}

/// What a fit comes to: its coefficients, its values at the nodes, and its largest error.
type Fit = (usize, Vec<f64>, f64);

fn fit(name: &str, mesh: &Mesh) -> Fit {
    let tolerance = Tolerance { value: 3e-3, ..Tolerance::default() };
    let control = &mut Control::new(2);
    let tensor = |knots| TensorOptions { tolerance, knots, ..TensorOptions::default() };
    let of = |surface: &dyn Surface, uv: &[glam::DVec2], error: f64| {
        let mut rows = vec![0.0; 3 * uv.len()];
        surface.eval_rows(uv, 0, &mut rows);
        (surface.coefficient_count(), rows, error)
    };
    match name {
        "uniform" | "adaptive" => {
            let knots = if name == "uniform" { Knots::Uniform } else { Knots::Adaptive };
            let fit = tensor::fit_mesh(mesh, &tensor(knots), control).unwrap();
            of(&fit.surface, &fit.parameters, fit.report.max_error)
        }
        "PHT" => {
            let options = PhtOptions { tolerance, ..PhtOptions::default() };
            let fit = pht::fit_mesh(mesh, &options, control).unwrap();
            of(&fit.surface, &fit.parameters, fit.report.max_error)
        }
        _ => {
            let options = D1rcFitOptions { tolerance, ..D1rcFitOptions::default() };
            let fit = d1rc::fit_mesh(mesh, &options, control).unwrap();
            of(&fit.surface, &fit.parameters, fit.report.max_error)
        }
    }
}

#[test]
fn fits_do_not_depend_on_the_size() {
    let mesh = samples::fuselage_panel(1).unwrap();
    let diagonal = mesh.bounds().diagonal();
    for name in ["uniform", "adaptive", "PHT", "D1RC"] {
        let (count, rows, error) = fit(name, &mesh);
        for scale in EXPONENTS.map(|exponent| 2f64.powi(exponent)) {
            let (other_count, other, other_error) = fit(name, &scaled(&mesh, scale));
            assert_eq!(other_count, count, "{name} {scale:e}");
            // scaling rounds nothing, but logarithms and roots of what is scaled do: as much as a condition of 1e6 makes of it
            let tol = 1e6 * f64::EPSILON * diagonal;
            let off = rows.iter().zip(&other).map(|(a, b)| (a - b / scale).abs()).fold(0.0, f64::max);
            assert!(off <= tol && (error - other_error / scale).abs() <= tol, "{name} {scale:e}: {off:e}");
        }
    }
}

#[test]
fn decimation_does_not_depend_on_the_size() {
    let mesh = samples::fuselage_panel(1).unwrap();
    let decimate = |mesh: &Mesh| {
        let options = DecimateOptions::default().with_target_count(200);
        mesh.decimate(&options, &mut Control::new(1)).unwrap().piece
    };
    let coarse = decimate(&mesh);
    for scale in EXPONENTS.map(|exponent| 2f64.powi(exponent)) {
        let other = decimate(&scaled(&mesh, scale));
        assert_eq!(other.nodes, coarse.nodes, "{scale:e}");
        assert_eq!(other.mesh.triangles(), coarse.mesh.triangles(), "{scale:e}");
    }
}
