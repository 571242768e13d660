use super::*;
use crate::failure::{Classify, ErrorKind};
use crate::fit::common::errors::data_errors;
use crate::fit::common::report::{Remarks, StopReason, Tolerance, ToleranceScale};
use crate::mesh::DecimateOptions;
use crate::samples;
use crate::surface::Surface;
use crate::surface::d1rc::D1rcOptions;
use glam::DVec3;
use std::f64::consts::FRAC_PI_4;
use std::ops::ControlFlow;

fn fit(mesh: &Mesh, options: &D1rcFitOptions) -> D1rcFit {
    fit_mesh(mesh, options, &mut Control::new(1)).unwrap()
}

fn within(value: f64) -> D1rcFitOptions<'static> {
    D1rcFitOptions {
        tolerance: Tolerance { value, scale: ToleranceScale::Relative },
        ..D1rcFitOptions::default()
    }
}

/// A roof over the unit square with its ridge along v at u = 1/2, 45 degrees in all.
fn roof() -> Mesh {
    let (uv, triangles) = samples::grid([21, 17], 0.0, 5, |_| true);
    let slope = (0.5 * FRAC_PI_4).tan();
    let points = uv.iter().map(|p| p.extend(-slope * (p.x - 0.5).abs())).collect();
    let mut mesh = Mesh::new(points, triangles).unwrap();
    mesh.set_parameters(uv).unwrap();
    mesh
}

#[test]
fn a_plane_takes_the_first_control_mesh() {
    // straight sides: what lies on them in the mesh lies on them in the control mesh
    let (uv, triangles) = samples::grid([60, 50], 0.25, 1, |_| true);
    let plane = |p: &DVec2| DVec3::new(0.8 * p.x, 0.9 * p.y - 0.3 * p.x, 0.4 * p.x);
    let mut mesh = Mesh::new(uv.iter().map(plane).collect(), triangles).unwrap();
    mesh.set_parameters(uv).unwrap();
    let fit = fit(&mesh, &within(1e-7));
    assert_eq!((fit.report.passes, fit.report.stop), (1, StopReason::ToleranceMet));
    assert_eq!(fit.report.coefficient_count, 100);
    // linear precision, and an energy that is blind to linear functions: what is left is rounding times a condition
    // of 1e7, data of weight 3000 / 100 against an energy of 1e-5
    let tol = 1e7 * 64.0 * f64::EPSILON * fit.report.diagonal;
    assert!(fit.report.max_error <= tol, "{:e}", fit.report.max_error);
}

#[test]
fn tolerances_are_kept() {
    let (mesh, _) = samples::bumps([45, 40], 8, 3).unwrap();
    let mut before = 0;
    for tolerance in [1e-2, 1e-3, 2e-4] {
        let fit = fit(&mesh, &within(tolerance));
        let FitReport { max_error, diagonal, coefficient_count, stop, .. } = fit.report;
        assert!(max_error <= tolerance * diagonal, "asked {tolerance:e}, got {:e}", max_error / diagonal);
        assert_eq!(stop, StopReason::ToleranceMet);
        assert!(coefficient_count >= before && coefficient_count < mesh.points().len());
        before = coefficient_count;
        // what the report says is what the surface has
        let values: Vec<f64> = mesh.points().iter().flat_map(|p| p.to_array()).collect();
        let control = Control::new(1);
        let errors = data_errors(&fit.surface, &fit.parameters, &values, control.pool());
        assert_eq!((errors.max, errors.each), (max_error, fit.errors));
    }
}

#[test]
fn least_squares_halve_the_error_of_plain_vertices() {
    let (mesh, _) = samples::bumps([40, 40], 8, 5).unwrap();
    let options = D1rcFitOptions { control_count: 250, correction_sweeps: 0, ..within(1e-9) };
    let fit = fit(&mesh, &options);
    assert_eq!(fit.report.stop, StopReason::FixedGrid);
    assert!(fit.report.remarks.has(Remarks::TOLERANCE_NOT_MET));
    let coarse = DecimateOptions::default().with_target_count(250);
    let coarse = mesh.decimate(&coarse, &mut Control::new(1)).unwrap().piece.mesh;
    assert_eq!(coarse.triangles(), fit.surface.space().recipe.triangles);
    let plain = D1rcSurface::from_mesh(&coarse, &options.surface, &[], &[]).unwrap();
    let values: Vec<f64> = mesh.points().iter().flat_map(|p| p.to_array()).collect();
    let plain = data_errors(&plain, &fit.parameters, &values, Control::new(1).pool());
    assert!(fit.report.max_error <= 0.5 * plain.max, "{} against {}", fit.report.max_error, plain.max);
    assert!(fit.report.rms_error <= 0.5 * plain.rms, "{} against {}", fit.report.rms_error, plain.rms);
}

#[test]
fn a_sharp_ridge_needs_to_be_known() {
    let mesh = roof();
    let sharp = D1rcFitOptions { sharp_angle: Some(0.5), ..within(1e-6) };
    let with_ridge = fit(&mesh, &sharp);
    assert_eq!(with_ridge.report.stop, StopReason::ToleranceMet);
    assert_eq!(with_ridge.report.coefficient_count, 100);
    // the ridge is a chain from border to border, at u = 1/2
    assert!(!with_ridge.sharp_edges.is_empty());
    let recipe = &with_ridge.surface.space().recipe;
    assert!(with_ridge.sharp_edges.iter().flatten().all(|&node| recipe.uv[node as usize].x == 0.5));
    let mut rows = [0.0; 18];
    with_ridge.surface.eval_rows(&[DVec2::new(0.5 - 1e-6, 0.4), DVec2::new(0.5 + 1e-6, 0.4)], 1, &mut rows);
    let normal = |row: &[f64]| DVec3::from_slice(&row[3..]).cross(DVec3::from_slice(&row[6..]));
    let fold = normal(&rows[..9]).angle_between(normal(&rows[9..]));
    // errors of 1e-6 over a face a tenth wide turn a normal by 1e-5 or so
    assert!((fold - FRAC_PI_4).abs() <= 1e-4, "the fold is {} degrees", fold.to_degrees());
    let smooth = fit(&mesh, &D1rcFitOptions { control_count: 100, ..within(1e-6) });
    assert!(smooth.report.max_error > 100.0 * with_ridge.report.max_error);
}

#[test]
fn a_given_control_mesh_is_used_as_it_is() {
    let (mesh, _) = samples::bumps([40, 40], 6, 2).unwrap();
    let coarse = DecimateOptions::default().with_target_count(200);
    let mut coarse = mesh.decimate(&coarse, &mut Control::new(1)).unwrap().piece.mesh;
    let given = fit(&mesh, &D1rcFitOptions { control_mesh: Some(&coarse), ..within(1e-6) });
    assert_eq!(given.report.stop, StopReason::FixedGrid);
    assert_eq!(given.surface.space().recipe.uv, coarse.parameters().unwrap());
    assert!(given.report.max_error <= 1e-2 * given.report.diagonal, "{:?}", given.report);
    // without parameters it gets some
    coarse.clear_parameters();
    let mapped = fit(&mesh, &D1rcFitOptions { control_mesh: Some(&coarse), ..within(1e-6) });
    assert_eq!(mapped.surface.coefficient_count(), 200);
    assert!(mapped.report.max_error <= 1e-2 * given.report.diagonal, "{:?}", mapped.report);
}

#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let (mesh, _) = samples::bumps([40, 40], 6, 9).unwrap();
    let options = D1rcFitOptions { control_count: 300, ..within(1e-4) };
    let [one, three] = [1, 3].map(|threads| fit_mesh(&mesh, &options, &mut Control::new(threads)).unwrap());
    assert_eq!(one.surface.control_points(), three.surface.control_points());
    assert_eq!((one.parameters, one.errors), (three.parameters, three.errors));
}

#[test]
fn a_fit_ends_when_the_limit_is_reached() {
    let (mesh, _) = samples::bumps([40, 40], 8, 7).unwrap();
    let fit = fit(&mesh, &D1rcFitOptions { max_control_count: 150, ..within(1e-7) });
    assert_eq!((fit.report.stop, fit.report.coefficient_count), (StopReason::Limit, 150));
}

#[test]
fn refusals_say_what_is_wrong() {
    let mesh = roof();
    let refuse = |options: D1rcFitOptions| fit_mesh(&mesh, &options, &mut Control::new(1)).unwrap_err();
    for (options, word) in [
        (within(-1.0), "tolerance"),
        (D1rcFitOptions { smoothing: 0.0, ..within(1e-3) }, "smoothing"),
        (D1rcFitOptions { control_count: 2, ..within(1e-3) }, "control_count"),
        (D1rcFitOptions { max_control_count: 2, ..within(1e-3) }, "max_control_count"),
        (D1rcFitOptions { weights: Some(&[1.0]), ..within(1e-3) }, "weights"),
        (D1rcFitOptions { surface: D1rcOptions::default().with_degree(4), ..within(1e-3) }, "degree is 4"),
    ] {
        let error = refuse(options);
        assert_eq!(error.kind(), ErrorKind::InvalidArgument, "{error}");
        assert!(error.to_string().contains(word), "{error}");
    }
    let edge = refuse(D1rcFitOptions { sharp_edges: &[[0, 1], [0, 300]], ..within(1e-3) });
    assert_eq!((edge.kind(), edge.index()), (ErrorKind::Topology, Some(1)));
}

#[test]
fn a_listener_can_cancel() {
    let mesh = roof();
    let mut stop = |_: f64, _: f64| ControlFlow::Break(());
    let mut control = Control::new(1).with_progress(&mut stop);
    let error = fit_mesh(&mesh, &within(1e-3), &mut control).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Cancelled);
}
