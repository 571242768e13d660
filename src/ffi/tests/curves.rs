use super::*;

struct CurveHandle(*mut planish_curve);

impl Drop for CurveHandle {
    fn drop(&mut self) {
        // SAFETY: made by the library and freed once.
        unsafe { planish_curve_free(self.0) }
    }
}

/// Eleven data on the line (2 u, 1 - u), which natural splines contain.
fn line() -> (CurveHandle, planish_fit_report, [f64; 11]) {
    let u: [f64; 11] = std::array::from_fn(|i| i as f64 / 10.0);
    let values: Vec<f64> = u.iter().flat_map(|u| [2.0 * u, 1.0 - u]).collect();
    let (mut out, mut report, mut errors) = (null_mut(), record(), [NAN; 11]);
    let options = planish_tensor_options { out_errors: errors.as_mut_ptr(), ..record() };
    // SAFETY: the arrays have these lengths.
    ok(unsafe { planish_curve_fit(u.as_ptr(), values.as_ptr(), 11, 2, &options, &mut out, &mut report) });
    (CurveHandle(out), report, errors)
}

const NAN: f64 = f64::NAN;

#[test]
fn a_line_is_fitted_and_evaluated() {
    let (curve, report, errors) = line();
    let (u, mut out, mut domain) = ([0.5, NAN, 0.25], [0.0; 12], [0.0; 2]);
    assert!(errors.iter().all(|&error| error <= report.max_error) && report.max_error < 1e-13);
    assert_eq!((report.grid_u, report.grid_v, report.coefficient_count), (2, 1, 2));
    // SAFETY: the arrays have these lengths.
    unsafe {
        let c = curve.0;
        assert_eq!((planish_curve_dim(c), planish_curve_degree(c)), (2, 3));
        assert_eq!((planish_curve_knot_count(c), planish_curve_control_point_count(c)), (8, 4));
        let strided = planish_eval_options { uv_stride: 2, out_stride: 6, ..record() };
        ok(planish_curve_eval(c, u.as_ptr(), 2, 1, &strided, out.as_mut_ptr()));
        ok(planish_curve_domain(c, domain.as_mut_ptr()));
        let (mut knots, mut points, mut copy) = ([0.0; 8], [0.0; 8], null_mut());
        ok(planish_curve_copy_knots(c, knots.as_mut_ptr(), 8));
        ok(planish_curve_copy_control_points(c, points.as_mut_ptr(), 4));
        assert_eq!([knots[0], knots[3], knots[4], knots[7]], [domain[0], domain[0], domain[1], domain[1]]);
        assert!((points[0] - 2.0 * domain[0]).abs() < 1e-13);
        ok(planish_curve_clone(c, &mut copy));
        assert_eq!(planish_curve_knot_count(CurveHandle(copy).0), 8);
    }
    let expected = [1.0, 0.5, 2.0, -1.0, 0.0, 0.0, 0.5, 0.75, 2.0, -1.0, 0.0, 0.0];
    for (found, expected) in out.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-13, "{out:?}");
    }
    assert!((domain[0] + 0.1).abs() < 1e-15 && (domain[1] - 1.1).abs() < 1e-15);
}

#[test]
fn parameters_outside_follow_the_rule() {
    let (curve, ..) = line();
    let (mut out, mut flags): ([f64; 4], [u8; 2]) = (canary(), canary());
    let with = |outside: planish_outside, flags: *mut u8| planish_eval_options {
        outside: outside as u32,
        out_flags: flags,
        ..record()
    };
    let far = [0.5, 2.0];
    let mut eval = |u: &[f64; 2], options: planish_eval_options| {
        // SAFETY: two points of two numbers.
        let status = unsafe { planish_curve_eval(curve.0, u.as_ptr(), 2, 0, &options, out.as_mut_ptr()) };
        (status, out)
    };
    let f = flags.as_mut_ptr();
    let (status, found) = eval(&far, with(planish_outside::Fail, f));
    refused(status, planish_status::Outside, 1, &["point 1 at 2"]);
    assert_untouched(&found);
    for rule in [planish_outside::Fail, planish_outside::Extrapolate] {
        let (status, found) = eval(&[NAN, 0.0], with(rule, f));
        refused(status, planish_status::NotFinite, 0, &["point 0"]);
        assert_untouched(&found);
    }
    assert_untouched(&flags);
    let (status, found) = eval(&far, with(planish_outside::Flag, flags.as_mut_ptr()));
    assert_eq!((status, flags), (planish_status::PointsOutside, [0, 1]));
    assert!((found[0] - 1.0).abs() < 1e-13 && found[2].is_nan() && found[3].is_nan());
    let (status, found) = eval(&far, with(planish_outside::Extrapolate, flags.as_mut_ptr()));
    assert_eq!((status, flags), (planish_status::Ok, [0, 1]));
    assert!((found[2] - 4.0).abs() < 1e-12 && (found[3] + 1.0).abs() < 1e-12);
}

#[test]
fn bad_arguments_are_refused() {
    use planish_status::*;
    let (curve, ..) = line();
    let c = curve.0;
    let (u, values) = ([0.0, 0.5, 1.0], [0.0, 1.0, NAN]);
    let mut numbers: [f64; 8] = canary();
    let mut out = canary();
    // SAFETY: the arrays have these lengths, or are refused before.
    unsafe {
        let (u, v, none, n) = (u.as_ptr(), values.as_ptr(), null_mut(), numbers.as_mut_ptr());
        null_refused(planish_curve_fit(null(), v, 3, 1, null(), &mut out, none), "u");
        null_refused(planish_curve_fit(u, null(), 3, 1, null(), &mut out, none), "values");
        null_refused(planish_curve_fit(u, v, 3, 1, null(), null_mut(), none), "out_curve");
        refused(planish_curve_fit(u, v, 3, 1, null(), &mut out, none), NotFinite, 2, &["datum 2"]);
        refused(planish_curve_fit(u, u, 0, 1, null(), &mut out, none), InvalidArgument, -1, &["0 data"]);
        refused(planish_curve_fit(u, u, 3, 0, null(), &mut out, none), InvalidArgument, -1, &["dim is 0"]);
        let options = planish_tensor_options { out_parameters: n, ..record() };
        let status = planish_curve_fit(u, u, 3, 1, &options, &mut out, none);
        refused(status, InvalidArgument, -1, &["out_parameters must be NULL"]);
        let options = planish_tensor_options { grid_u: 1, ..record() };
        let status = planish_curve_fit(u, u, 3, 1, &options, &mut out, none);
        refused(status, InvalidArgument, -1, &["grid is 1"]);
        null_refused(planish_curve_clone(null(), &mut out), "curve");
        null_refused(planish_curve_clone(c, null_mut()), "out_curve");
        assert_untouched(&out);

        null_refused(planish_curve_eval(null(), u, 1, 0, null(), n), "curve");
        null_refused(planish_curve_eval(c, null(), 1, 0, null(), n), "u");
        null_refused(planish_curve_eval(c, u, 1, 0, null(), null_mut()), "out");
        ok(planish_curve_eval(c, null(), 0, 0, null(), null_mut()));
        refused(
            planish_curve_eval(c, u, 1, 4, null(), n),
            InvalidArgument,
            -1,
            &["max_derivative is 4", "3"],
        );
        let options = planish_eval_options { out_stride: 1, ..record() };
        refused(planish_curve_eval(c, u, 1, 0, &options, n), InvalidArgument, -1, &["out_stride is 1"]);
        null_refused(planish_curve_domain(null(), n), "curve");
        null_refused(planish_curve_domain(c, null_mut()), "out_interval");
        null_refused(planish_curve_copy_knots(null(), n, 8), "curve");
        null_refused(planish_curve_copy_knots(c, null_mut(), 8), "out_knots");
        refused(planish_curve_copy_knots(c, n, 7), BufferTooSmall, -1, &["out_knots", "7", "8"]);
        null_refused(planish_curve_copy_control_points(null(), n, 4), "curve");
        null_refused(planish_curve_copy_control_points(c, null_mut(), 4), "out_control_points");
        refused(planish_curve_copy_control_points(c, n, 0), BufferTooSmall, -1, &["0", "4"]);
        assert_untouched(&numbers);
        assert_eq!((planish_curve_dim(null()), planish_curve_degree(null())), (0, 0));
        assert_eq!((planish_curve_knot_count(null()), planish_curve_control_point_count(null())), (0, 0));
        planish_curve_free(null_mut());
    }
}
