//! Fitted fields: the same as single fits, linear in the values, and good at gaps.

use super::*;
use crate::failure::{Classify, ErrorKind};
use crate::fit::common::Missing;
use crate::fit::common::uniform::Ends;
use crate::fit::tensor::{TensorOptions, fit_field};
use crate::samples::{self, Random};

fn nodes(count: usize) -> Vec<DVec2> {
    let mut random = Random::new(5);
    (0..count).map(|_| DVec2::new(random.unit(), random.unit())).collect()
}

/// About one wave over the nodes, the second component far from zero.
fn waves(uv: &[DVec2], phase: f64) -> Vec<f64> {
    let Domain { min, max } = Domain::around(uv.iter().copied());
    let wave = |p: DVec2| [(7.0 * p.x + phase).sin() * p.y, 300.0 + (5.0 * p.y - phase).cos()];
    uv.iter().flat_map(|&uv| wave((uv - min) / (max - min))).collect()
}

fn fixed(counts: [usize; 2]) -> FieldOptions<'static> {
    FieldOptions { grid: FieldGrid::Fixed(counts), ..FieldOptions::default() }
}

#[test]
fn a_field_is_what_a_single_fit_makes_of_it() {
    let mesh = samples::curved_notch(2).unwrap();
    let uv = mesh.parameters().unwrap().to_vec();
    let values = waves(&uv, 0.3);
    for counts in [[9, 17], [65, 33]] {
        for ends in [Ends::Natural, Ends::Free] {
            let options = FieldOptions { ends, ..fixed(counts) };
            let fitter = FieldFitter::on_mesh(&mesh, &options, &mut Control::new(2)).unwrap();
            let surface = fitter.fit(&values, 2).unwrap();
            let single = TensorOptions {
                fixed_grid: Some(counts),
                smoothing: options.smoothing,
                regularize: Regularize::Never,
                ends,
                ..TensorOptions::default()
            };
            let single = fit_field(&mesh, &values, 2, &single, &mut Control::new(2)).unwrap();
            assert_eq!(surface.knots(Axis::U), single.surface.knots(Axis::U));
            assert_eq!(surface.region(), single.surface.region());
            // the same equations, added up in another order: the condition of the normal equations with a
            // smoothing of 1e-6 magnifies roundings of numbers of about 1 (in the frame of the values)
            let scale = single.report.diagonal;
            for (a, b) in surface.control_points().iter().zip(single.surface.control_points()) {
                assert!((a - b).abs() <= 1e-8 * scale, "{a} is not {b}, {counts:?} {ends:?}");
            }
            let report = fitter.measure(&surface, &values, 2).unwrap();
            assert!((report.fit.max_error - single.report.max_error).abs() <= 1e-8 * scale);
            assert_eq!((report.fit.grid_u, report.fit.grid_v), (counts[0], counts[1]));
        }
    }
}

#[test]
fn fits_are_linear_and_updates_equal_fits() {
    let uv = nodes(3000);
    let fitter = FieldFitter::at(&uv, &fixed([17, 17]), &mut Control::new(1)).unwrap();
    let (a, b) = (waves(&uv, 0.0), waves(&uv, 1.0));
    let sum: Vec<f64> = a.iter().zip(&b).map(|(a, b)| a - 2.0 * b).collect();
    let [fa, fb, fsum] = [&a, &b, &sum].map(|values| fitter.fit(values, 2).unwrap());
    for ((a, b), sum) in fa.control_points().iter().zip(fb.control_points()).zip(fsum.control_points()) {
        // numbers of a few hundred, conditions as above
        assert!((a - 2.0 * b - sum).abs() <= 1e-8 * 1e3, "{a} - 2 {b} is not {sum}");
    }
    let mut updated = fa.clone();
    fitter.update(&mut updated, &b, 2).unwrap();
    assert_eq!(updated, fb);
}

#[test]
fn bits_do_not_depend_on_threads_or_on_earlier_calls() {
    let uv = nodes(20_000);
    let values = waves(&uv, 0.5);
    let fits: Vec<TensorSurface> = [1, 2, 5]
        .map(|threads| {
            let fitter = FieldFitter::at(&uv, &fixed([33, 65]), &mut Control::new(threads)).unwrap();
            fitter.fit(&waves(&uv, 9.0), 2).unwrap();
            fitter.fit(&values[..uv.len()], 1).unwrap();
            fitter.fit(&values, 2).unwrap()
        })
        .into();
    assert!(fits.iter().all(|fit| *fit == fits[0]));
}

#[test]
fn nodes_without_values_do_not_count() {
    let mesh = samples::curved_notch(2).unwrap();
    let uv = mesh.parameters().unwrap().to_vec();
    let mut values = waves(&uv, 0.0);
    let is_known: Vec<bool> = (0..uv.len()).map(|node| node % 7 != 3).collect();
    for node in (0..uv.len()).filter(|&node| !is_known[node]) {
        values[2 * node] = f64::NAN;
        values[2 * node + 1] = 1e300;
    }
    let options = FieldOptions { is_known: Some(&is_known), ..fixed([33, 33]) };
    let fitter = FieldFitter::on_mesh(&mesh, &options, &mut Control::new(2)).unwrap();
    let surface = fitter.fit(&values, 2).unwrap();
    let report = fitter.measure(&surface, &values, 2).unwrap();
    assert!(report.fit.max_error < 1e-3 * report.fit.diagonal, "{:?}", report.fit);
    assert!(report.errors.iter().zip(&is_known).all(|(error, known)| error.is_nan() != *known));
    // what was left out is found between the others
    let exact = waves(&uv, 0.0);
    let mut rows = vec![0.0; 2 * uv.len()];
    surface.eval_rows(&uv, 0, &mut rows);
    let worst = rows.iter().zip(&exact).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(worst < 2e-3 * report.fit.diagonal, "{worst}");
}

#[test]
fn values_that_are_missing_are_left_out_field_by_field() {
    let mesh = samples::curved_notch(2).unwrap();
    let uv = mesh.parameters().unwrap().to_vec();
    let whole = waves(&uv, 0.0);
    let skipping = fixed([33, 33]).with_missing(Missing::Skipped);
    let fitter = FieldFitter::on_mesh(&mesh, &skipping, &mut Control::new(2)).unwrap();
    let plain = FieldFitter::on_mesh(&mesh, &fixed([33, 33]), &mut Control::new(2)).unwrap();
    for missing in [3, 5, 5, 8] {
        // a field that lacks values is fitted as by a fitter that knows where it has some
        let is_known: Vec<bool> = (0..uv.len()).map(|node| node % 9 != missing).collect();
        let mut values = whole.clone();
        (0..uv.len()).filter(|&node| !is_known[node]).for_each(|node| values[2 * node + 1] = f64::NAN);
        let surface = fitter.fit(&values, 2).unwrap();
        let knowing = fixed([33, 33]).with_is_known(Some(&is_known));
        let knowing = FieldFitter::on_mesh(&mesh, &knowing, &mut Control::new(1)).unwrap();
        assert_eq!(surface, knowing.fit(&values, 2).unwrap(), "{missing}");
        let report = fitter.measure(&surface, &values, 2).unwrap();
        let expected = knowing.measure(&surface, &values, 2).unwrap();
        assert_eq!(report.fit.max_error, expected.fit.max_error);
        assert!(report.errors.iter().zip(&is_known).all(|(error, known)| error.is_nan() != *known));
        assert_eq!(fitter.fit(&whole, 2).unwrap(), plain.fit(&whole, 2).unwrap());
        let error = plain.fit(&values, 2).unwrap_err();
        assert_eq!(error.index(), Some(missing), "{error}");
    }
    let mut infinite = whole.clone();
    infinite[14] = f64::INFINITY;
    assert_eq!(fitter.fit(&infinite, 2).unwrap_err().index(), Some(7));
    let nothing = vec![f64::NAN; whole.len()];
    let error = fitter.fit(&nothing, 2).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::InvalidArgument, "{error}");
}

#[test]
fn refusals_name_the_offender() {
    let uv = nodes(100);
    let make = |options: &FieldOptions| FieldFitter::at(&uv, options, &mut Control::new(1));
    let fitter = make(&FieldOptions::default()).unwrap();
    let mut values = waves(&uv, 0.0);
    assert_eq!(fitter.fit(&values, 0).unwrap_err().kind(), crate::failure::ErrorKind::InvalidArgument);
    let short = fitter.fit(&values[1..], 2);
    assert!(matches!(short, Err(FieldError::Fit(FitError::Count { count: 199, expected: 200, .. }))));
    values[77] = f64::INFINITY;
    assert_eq!(fitter.fit(&values, 2).unwrap_err(), FitError::ValuesNotFinite { index: 38 }.into());
    let mut other = FieldFitter::at(&nodes(500), &fixed([5, 3]), &mut Control::new(1))
        .and_then(|other| other.fit(&waves(&nodes(500), 0.0), 2))
        .unwrap();
    assert_eq!(fitter.update(&mut other, &waves(&uv, 0.0), 2).unwrap_err(), FieldError::OtherGrid);
    let refuse = |options: &FieldOptions| match make(options).unwrap_err() {
        FieldError::Fit(error) => error,
        other => panic!("{other}"),
    };
    let none = FieldOptions::default();
    assert!(matches!(
        refuse(&FieldOptions { smoothing: 0.0, ..none }),
        FitError::Option { option: "smoothing", .. }
    ));
    assert!(matches!(
        refuse(&FieldOptions { buffer: -1.0, ..none }),
        FitError::Option { option: "buffer", .. }
    ));
    assert!(matches!(refuse(&fixed([1, 9])), FitError::Option { option: "grid", .. }));
    assert!(matches!(
        refuse(&FieldOptions { is_known: Some(&[true; 7]), ..none }),
        FitError::Count { what: "the mask", count: 7, expected: 100 }
    ));
    assert_eq!(
        refuse(&FieldOptions { is_known: Some(&[false; 100]), ..none }),
        FitError::TooFew { count: 0 }
    );
    let weights = [vec![1.0; 99], vec![-1.0]].concat();
    assert_eq!(
        refuse(&FieldOptions { weights: Some(&weights), ..none }),
        FitError::Weight { index: 99, weight: -1.0 }
    );
}
