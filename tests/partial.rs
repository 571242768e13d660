//! Fields without values at some nodes, and with values on triangles.

use glam::DVec2;
use planish::Control;
use planish::fit::common::{FitError, Missing};
use planish::fit::pht::{self, PhtOptions};
use planish::fit::report::{FitReport, Tolerance, ToleranceScale};
use planish::fit::tensor::{self, TensorOptions};
use planish::mesh::Mesh;
use planish::samples;
use planish::surface::{AnySurface, Surface};

const TOLERANCE: Tolerance = Tolerance { value: 1e-3, scale: ToleranceScale::Absolute };

fn wave(uv: DVec2) -> f64 {
    (0.4 * uv.x).sin() * (0.3 * uv.y).cos()
}

type Fit = (AnySurface, FitReport, Vec<DVec2>, Vec<f64>);

fn fit_field(family: &str, mesh: &Mesh, values: &[f64], missing: Missing) -> Result<Fit, FitError> {
    let control = &mut Control::new(2);
    if family == "tensor" {
        let options = TensorOptions { tolerance: TOLERANCE, missing, ..TensorOptions::default() };
        let fit = tensor::fit_field(mesh, values, 1, &options, control)?;
        return Ok((fit.surface.into(), fit.report, fit.parameters, fit.errors));
    }
    let options = PhtOptions { tolerance: TOLERANCE, missing, ..PhtOptions::default() };
    let fit = pht::fit_field(mesh, values, 1, &options, control)?;
    Ok((fit.surface.into(), fit.report, fit.parameters, fit.errors))
}

#[test]
fn values_that_are_missing_are_passed_over() {
    let mesh = samples::curved_notch(2).unwrap();
    let uv = mesh.parameters().unwrap().to_vec();
    let is_missing = |node: usize| node % 7 == 3;
    let value = |node: usize| if is_missing(node) { f64::NAN } else { wave(uv[node]) };
    let values: Vec<f64> = (0..uv.len()).map(value).collect();
    for family in ["tensor", "PHT"] {
        let refused = fit_field(family, &mesh, &values, Missing::Refused).unwrap_err();
        assert_eq!(refused, FitError::ValuesNotFinite { index: 3 });
        let (surface, report, parameters, errors) =
            fit_field(family, &mesh, &values, Missing::Skipped).unwrap();
        assert!(report.max_error <= 1e-3, "{family}: {report:?}");
        assert_eq!(errors[report.worst_index], report.max_error);
        assert_eq!((parameters.len(), errors.len()), (uv.len(), uv.len()));
        assert!((0..uv.len()).all(|node| errors[node].is_nan() == is_missing(node)));
        let surface = surface.as_surface();
        assert_eq!(surface.region().trims.loops().len(), mesh.loops().len());
        // a smooth wave between its samples, which are a seventh fewer
        let mut rows = vec![0.0; uv.len()];
        surface.eval_rows(&parameters, 0, &mut rows);
        let miss = |node: usize| (rows[node] - wave(uv[node])).abs();
        let worst = (0..uv.len()).filter(|&node| is_missing(node)).map(miss).fold(0.0, f64::max);
        assert!(worst <= 2e-3, "{family}: {worst}");
    }
    let infinite: Vec<f64> = values.iter().map(|x| if x.is_nan() { f64::INFINITY } else { *x }).collect();
    let refused = fit_field("tensor", &mesh, &infinite, Missing::Skipped).unwrap_err();
    assert_eq!(refused, FitError::ValuesNotFinite { index: 3 }, "infinity is no missing value");
}

#[test]
fn values_on_triangles_are_taken_at_their_centroids() {
    let mesh = samples::curved_notch(2).unwrap();
    let uv = mesh.parameters().unwrap();
    let middles: Vec<DVec2> = mesh
        .triangles()
        .iter()
        .map(|nodes| nodes.iter().map(|&node| uv[node as usize]).sum::<DVec2>() / 3.0)
        .collect();
    let values: Vec<f64> = middles.iter().map(|&uv| wave(uv)).collect();
    for family in ["tensor", "PHT"] {
        let (surface, report, parameters, errors) =
            fit_field(family, &mesh, &values, Missing::Refused).unwrap();
        assert!(report.max_error <= 1e-3, "{family}: {report:?}");
        assert_eq!((parameters, errors.len()), (middles.clone(), middles.len()));
        assert_eq!(surface.as_surface().region().trims.loops().len(), mesh.loops().len());
        let one_less = fit_field(family, &mesh, &values[1..], Missing::Refused).unwrap_err();
        assert!(matches!(one_less, FitError::Count { what: "the values", .. }), "{one_less:?}");
    }
}

#[test]
fn points_may_lack_values_too() {
    let uv: Vec<DVec2> = (0..900).map(|k| DVec2::new(f64::from(k % 30), f64::from(k / 30)) / 29.0).collect();
    let values: Vec<f64> =
        uv.iter().enumerate().map(|(k, &uv)| if k == 0 { f64::NAN } else { wave(6.0 * uv) }).collect();
    let options =
        TensorOptions { tolerance: TOLERANCE, missing: Missing::Skipped, ..TensorOptions::default() };
    let fit = tensor::fit_points(&uv, &values, 1, &options, &mut Control::new(1)).unwrap();
    assert!(fit.report.max_error <= 1e-3 && fit.errors[0].is_nan(), "{:?}", fit.report);
    // the corner without a value is in the domain all the same
    assert!(fit.surface.domain().contains(uv[0]));
    let nothing = vec![f64::NAN; 900];
    let refused = tensor::fit_points(&uv, &nothing, 1, &options, &mut Control::new(1)).unwrap_err();
    assert_eq!(refused, FitError::TooFew { count: 0 });
}
