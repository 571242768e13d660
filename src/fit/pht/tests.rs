use super::*;
use crate::failure::{Classify, ErrorKind};
use crate::fit::common::Regularize;
use crate::fit::common::report::{StopReason, Tolerance, ToleranceScale};
use crate::samples::{self, Random};
use crate::surface::Surface;
use std::ops::ControlFlow;

/// Scattered places over a rectangle that is no square, corners included.
fn places(count: usize, seed: u64) -> Vec<DVec2> {
    let mut random = Random::new(seed);
    let corners = [(0., 0.), (1., 0.), (0., 1.), (1., 1.)].map(|(x, y)| DVec2::new(x, y));
    let inner = (4..count).map(|_| DVec2::new(random.unit(), random.unit()));
    corners.into_iter().chain(inner).map(|p| DVec2::new(-1.0, 5.0) + p * DVec2::new(2.0, 6.0)).collect()
}

/// A hill on a slope; its steepest part needs small cells.
fn hill(uv: DVec2) -> f64 {
    let d = (uv - DVec2::new(0.3, 7.0)) / DVec2::new(0.3, 0.9);
    0.2 * uv.x + 0.05 * uv.y + (-d.length_squared()).exp()
}

fn with_tolerance<'a>(value: f64) -> PhtOptions<'a> {
    PhtOptions { tolerance: Tolerance { value, ..Tolerance::default() }, ..PhtOptions::default() }
}

fn fit_hill(count: usize, options: &PhtOptions) -> PhtFit {
    let uv = places(count, 3);
    let values: Vec<f64> = uv.iter().map(|&uv| hill(uv)).collect();
    fit_points(&uv, &values, 1, options, &mut Control::new(2)).unwrap()
}

#[test]
fn bicubics_take_one_cell_without_smoothing_and_planes_with_it() {
    let uv = places(60, 1);
    for (smoothing, height) in [
        (0.0, (|p: DVec2| p.x.powi(3) * p.y.powi(2) - p.y.powi(3)) as fn(DVec2) -> f64),
        (1e-3, |p| p.x - 2.0 * p.y),
    ] {
        let values: Vec<f64> = uv.iter().map(|&p| height(p)).collect();
        let options = PhtOptions { smoothing, ..with_tolerance(1e-9) };
        let fit = fit_points(&uv, &values, 1, &options, &mut Control::new(1)).unwrap();
        assert_eq!((fit.report.coefficient_count, fit.report.passes), (16, 1));
        // the normal equations of sixteen unknowns have a condition below 1e6
        assert!(fit.report.max_error <= 1e-9 * fit.report.diagonal, "{:e}", fit.report.max_error);
    }
}

#[test]
fn what_was_asked_for_is_kept_by_every_estimator() {
    // linear interpolation of jets ends where the spacing of the data does
    let cases = [(Estimator::Global, 1e-4), (Estimator::LocalCubic, 1e-3), (Estimator::LocalQuadratic, 1e-2)];
    for (estimator, finest) in cases {
        let mut before = 0;
        for value in [1e-1, 1e-2, 1e-3, 1e-4].into_iter().filter(|&value| value >= finest) {
            let fit = fit_hill(6000, &PhtOptions { estimator, ..with_tolerance(value) });
            let report = &fit.report;
            assert_eq!(report.stop, StopReason::ToleranceMet, "{estimator:?} {value:e}");
            assert!(report.max_error <= value * report.diagonal, "{estimator:?} {value:e}: {report:?}");
            assert_eq!(report.rough_cell_count, 0);
            assert_eq!(report.cell_count, fit.surface.mesh().leaf_count());
            assert!(report.coefficient_count >= before);
            before = report.coefficient_count;
        }
    }
}

#[test]
fn cells_are_small_where_the_shape_asks_and_graded() {
    let fit = fit_hill(6000, &with_tolerance(1e-3));
    let mesh = fit.surface.mesh();
    let level = |uv| mesh.cell(mesh.locate(uv)).level;
    assert!(level(DVec2::new(0.3, 7.5)) >= level(DVec2::new(-0.9, 10.8)) + 2);
    for leaf in mesh.leaves() {
        for neighbour in mesh.neighbours(leaf) {
            assert!(mesh.cell(leaf).level.abs_diff(mesh.cell(neighbour).level) <= 1);
        }
    }
}

#[test]
fn the_bits_do_not_depend_on_the_number_of_threads() {
    let (mesh, _) = samples::bumps([40, 50], 6, 2).unwrap();
    for estimator in [Estimator::Global, Estimator::LocalCubic] {
        let options = PhtOptions { estimator, ..with_tolerance(1e-3) };
        let fit = |threads| fit_mesh(&mesh, &options, &mut Control::new(threads)).unwrap();
        let (one, three) = (fit(1), fit(3));
        assert_eq!(one.surface, three.surface);
        assert_eq!(one.errors, three.errors);
    }
}

#[test]
fn meshes_keep_their_loops_and_fields_their_values() {
    let mesh = samples::fuselage_panel(1).unwrap();
    let fit = fit_mesh(&mesh, &with_tolerance(1e-3), &mut Control::new(2)).unwrap();
    assert!(fit.report.max_error <= fit.report.tolerance, "{:?}", fit.report);
    assert_eq!(fit.surface.region().trims.loops().len(), 4);
    assert_eq!(fit.report.flipped_count, 0);
    assert!(fit.report.remarks.has(Remarks::PARAMETERIZED));

    let field: Vec<f64> = mesh.points().iter().flat_map(|p| [p.x * p.x, (3.0 * p.y).sin()]).collect();
    let mut mapped = mesh.clone();
    mapped.set_parameters(fit.parameters.clone()).unwrap();
    let options = PhtOptions { regularize: Regularize::Never, ..with_tolerance(1e-3) };
    let field = fit_field(&mapped, &field, 2, &options, &mut Control::new(2)).unwrap();
    assert!(field.report.max_error <= field.report.tolerance, "{:?}", field.report);
    assert_eq!(field.parameters, fit.parameters, "a field moves no nodes");
}

#[test]
fn refinement_ends_at_the_noise() {
    let mut random = Random::new(8);
    let uv = places(20_000, 5);
    let noise = 3e-3;
    // a sum of four has the spread of a bell
    let mut bell = || (0..4).map(|_| random.signed()).sum::<f64>() * (3.0_f64 / 4.0).sqrt();
    let values: Vec<f64> = uv.iter().map(|&uv| hill(uv) + noise * bell()).collect();
    let tolerance = |value| Tolerance { value, scale: ToleranceScale::Absolute };
    let fit = |value| {
        let options = PhtOptions { tolerance: tolerance(value), ..PhtOptions::default() };
        fit_points(&uv, &values, 1, &options, &mut Control::new(2)).unwrap()
    };
    let loose = fit(7.0 * noise);
    assert_eq!(loose.report.stop, StopReason::ToleranceMet, "{:?}", loose.report);
    let tight = fit(noise / 3.0);
    assert_eq!(tight.report.stop, StopReason::Stagnated, "{:?}", tight.report);
    assert!(
        tight.report.remarks.has(Remarks::STAGNATED) && tight.report.remarks.has(Remarks::TOLERANCE_NOT_MET)
    );
    assert!(tight.report.passes <= loose.report.passes + 3, "{:?}", tight.report);
    assert!((tight.report.rms_error / noise - 1.0).abs() < 0.1, "{:?}", tight.report);
    // and the surface is nearer to the hill than the data are
    let mut exact = vec![0.0; uv.len()];
    tight.surface.eval_rows(&uv, 0, &mut exact);
    let miss = uv.iter().zip(&exact).map(|(&uv, x)| (x - hill(uv)).powi(2)).sum::<f64>() / uv.len() as f64;
    assert!(miss.sqrt() < 0.35 * noise, "{:e}", miss.sqrt());
}

#[test]
fn limits_end_the_fit_and_are_named() {
    let limited = fit_hill(6000, &PhtOptions { max_level: 2, ..with_tolerance(1e-5) });
    assert_eq!((limited.report.stop, limited.report.deepest_level), (StopReason::Limit, 2));
    assert!(limited.report.rough_cell_count > 0 && limited.report.remarks.has(Remarks::TOLERANCE_NOT_MET));
    let limited = fit_hill(6000, &PhtOptions { max_cells: 20, ..with_tolerance(1e-5) });
    assert!(limited.report.cell_count <= 20 && limited.report.stop == StopReason::Limit);
    let sparse = fit_hill(100, &with_tolerance(1e-6));
    assert_eq!(sparse.report.stop, StopReason::DataExhausted);
    assert!(sparse.report.coefficient_count <= 100);
    let grid = fit_hill(6000, &PhtOptions { initial_grid: [3, 2], ..with_tolerance(0.5) });
    assert_eq!(grid.report.cell_count, 6);
}

#[test]
fn refusals_name_the_offender() {
    let uv = places(30, 2);
    let values = vec![0.5; 30];
    let refuse = |uv: &[DVec2], values: &[f64], options: &PhtOptions| {
        fit_points(uv, values, 1, options, &mut Control::new(1)).unwrap_err()
    };
    let default = PhtOptions::default();
    for (options, name) in [
        (PhtOptions { smoothing: -1.0, ..default }, "smoothing"),
        (PhtOptions { initial_grid: [0, 1], ..default }, "initial_grid"),
        (PhtOptions { max_level: 21, ..default }, "max_level"),
        (PhtOptions { max_cells: 0, ..default }, "max_cells"),
        (PhtOptions { min_samples: 0, ..default }, "min_samples"),
        (with_tolerance(0.0), "tolerance"),
    ] {
        let error = refuse(&uv, &values, &options);
        assert!(matches!(error, FitError::Option { option, .. } if option == name), "{error}");
    }
    let mut bad = uv.clone();
    bad[7].y = f64::NAN;
    assert_eq!(refuse(&bad, &values, &default), FitError::ParametersNotFinite { index: 7 });
    let mut bad = values.clone();
    bad[9] = f64::INFINITY;
    assert_eq!(refuse(&uv, &bad, &default), FitError::ValuesNotFinite { index: 9 });
    let line: Vec<DVec2> = (0..30).map(|k| DVec2::splat(f64::from(k))).collect();
    assert_eq!(refuse(&line, &values, &default).kind(), ErrorKind::Singular);
    let mut stop = |_: f64, _: f64| ControlFlow::Break(());
    let mut control = Control::new(1).with_progress(&mut stop);
    let cancelled = fit_points(&uv, &values, 1, &default, &mut control).unwrap_err();
    assert_eq!(cancelled.kind(), ErrorKind::Cancelled);
}

fn smooth<'a>(tolerance: f64) -> PhtOptions<'a> {
    PhtOptions { continuity: Continuity::C2, ..with_tolerance(tolerance) }
}

#[test]
fn fits_with_two_continuous_derivatives_keep_the_tolerance_with_fewer_coefficients() {
    for value in [1e-1, 1e-2, 1e-3, 1e-4] {
        let fit = fit_hill(6000, &smooth(value));
        let (report, surface) = (&fit.report, &fit.surface);
        assert_eq!(report.stop, StopReason::ToleranceMet, "{value:e}");
        assert!(report.max_error <= value * report.diagonal, "{value:e}: {report:?}");
        assert_eq!((surface.continuity(), report.coefficient_count), (2, surface.coefficient_count()));
        assert!(report.coefficient_count <= report.refined_coefficient_count);
        let once = fit_hill(6000, &with_tolerance(value)).report.coefficient_count;
        // of few cells four functions a line are as many as two jets
        assert!(value > 1e-3 || report.coefficient_count < once, "{value:e}: {report:?}, {once}");
    }
}

#[test]
fn a_coarsened_fit_keeps_the_tolerance_and_the_grade() {
    for value in [1e-2, 1e-3, 1e-4] {
        let fine = fit_hill(6000, &with_tolerance(value));
        let coarse = fit_hill(6000, &PhtOptions { coarsening: Coarsening::On, ..with_tolerance(value) });
        let report = &coarse.report;
        assert_eq!(report.refined_coefficient_count, fine.report.coefficient_count);
        assert!(report.max_error <= value * report.diagonal, "{value:e}: {report:?}");
        assert!(report.coefficient_count <= fine.report.coefficient_count);
        let mesh = coarse.surface.mesh();
        for leaf in mesh.leaves() {
            for neighbour in mesh.neighbours(leaf) {
                assert!(mesh.cell(leaf).level.abs_diff(mesh.cell(neighbour).level) <= 1);
            }
        }
    }
}

#[test]
fn fits_with_two_continuous_derivatives_do_not_depend_on_the_number_of_threads() {
    let (mesh, _) = samples::bumps([40, 50], 6, 2).unwrap();
    let fit = |threads| fit_mesh(&mesh, &smooth(1e-3), &mut Control::new(threads)).unwrap();
    let (one, three) = (fit(1), fit(3));
    assert_eq!(one.surface, three.surface);
    assert_eq!(one.errors, three.errors);
    assert!(one.report.max_error <= one.report.tolerance);
}

#[test]
fn fixed_points_are_met_by_surfaces_with_two_continuous_derivatives() {
    let uv = places(3000, 8);
    let mut values: Vec<f64> = uv.iter().map(|&uv| hill(uv)).collect();
    values[100] += 1e-3;
    let demands = Demands { fixed: &[7, 100], ..Demands::default() };
    let options = PhtOptions { demands, ..smooth(1e-2) };
    let fit = fit_points(&uv, &values, 1, &options, &mut Control::new(1)).unwrap();
    assert!(fit.report.max_fixed_error <= 1e-12 * fit.report.diagonal, "{:?}", fit.report);
    let (mesh, _) = samples::bumps([20, 20], 6, 2).unwrap();
    let demands = Demands { symmetry: Symmetry::Found, ..Demands::default() };
    let error = fit_mesh(&mesh, &PhtOptions { demands, ..smooth(1e-2) }, &mut Control::new(1)).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::InvalidArgument);
    assert!(error.to_string().contains("symmetry"), "{error}");
}
