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
    let options = planish_curve_options { out_errors: errors.as_mut_ptr(), ..record() };
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
        let options = planish_curve_options { grid: 1, ..record() };
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

/// The quarter of a circle of radius 2 by 9 points, with its tangents at the ends: within 1e-4.
fn arc() -> CurveHandle {
    let angles: [f64; 9] = std::array::from_fn(|i| i as f64 * std::f64::consts::FRAC_PI_2 / 8.0);
    let points: Vec<f64> = angles.iter().flat_map(|a| [2.0 * a.cos(), 2.0 * a.sin()]).collect();
    let slopes = [0.0, 2.0, -2.0, 0.0];
    let ends = planish_section_ends::Slopes as u32;
    let options = planish_interpolate_options { end_slopes: slopes.as_ptr(), ends, ..record() };
    let mut out = null_mut();
    // SAFETY: the arrays have these lengths.
    ok(unsafe { planish_curve_interpolate(angles.as_ptr(), points.as_ptr(), 9, 2, &options, &mut out) });
    CurveHandle(out)
}

#[test]
fn an_arc_has_its_length_and_its_nearest_places() {
    let curve = arc();
    let u = [0.0, 1.0, 0.25];
    // the center is as far from all places as the radius; the others lie on rays
    let points = [4.0, 0.0, 3.0 * 1.0_f64.cos(), 3.0 * 1.0_f64.sin(), 0.0, 0.0, -1.0, 5.0];
    let (mut lengths, mut places, mut distances) = ([0.0; 3], [0.0; 4], [0.0; 4]);
    // SAFETY: the arrays have these lengths.
    unsafe {
        let c = curve.0;
        ok(planish_curve_arc_lengths(c, u.as_ptr(), 3, lengths.as_mut_ptr()));
        ok(planish_curve_project(c, points.as_ptr(), 4, null(), places.as_mut_ptr(), distances.as_mut_ptr()));
        assert!((planish_curve_length(c) - std::f64::consts::PI).abs() < 1e-4);
        assert_eq!(planish_curve_length(null()), 0.0);
        let near = planish_project_options { max_distance: 1.5, guesses: u.as_ptr(), ..record() };
        let status = planish_curve_project(c, points.as_ptr(), 3, &near, places.as_mut_ptr(), null_mut());
        assert_eq!(status, planish_status::PointsOutside);
    }
    for (length, u) in lengths.iter().zip(u) {
        assert!((length - 2.0 * u).abs() < 1e-4, "{lengths:?}");
    }
    assert!(places[0].is_nan() && (places[1] - 1.0).abs() < 1e-4 && places[2].is_nan(), "{places:?}");
    let last = (1.0_f64 + 9.0).sqrt(); // from (-1, 5) to (0, 2)
    for (distance, exact) in distances.iter().zip([2.0, 1.0, 2.0, last]) {
        assert!((distance - exact).abs() < 1e-4, "{distances:?}");
    }
}

#[test]
fn a_curve_is_saved_and_loaded_to_the_bit() {
    let curve = arc();
    let path =
        c(&std::env::temp_dir().join(format!("planish curve {}", std::process::id())).to_string_lossy());
    let (mut loaded, mut from_file, mut refused_curve) = (null_mut(), null_mut(), canary());
    // SAFETY: live handles, and arrays of these lengths.
    unsafe {
        let size = planish_curve_save_size(curve.0);
        assert_eq!(planish_curve_save_size(null()), 0);
        let (mut bytes, mut again) = (vec![0_u8; size], vec![0_u8; size]);
        ok(planish_curve_save(curve.0, bytes.as_mut_ptr().cast(), size));
        ok(planish_curve_load(bytes.as_ptr().cast(), size, &mut loaded));
        ok(planish_curve_save_file(curve.0, path.as_ptr()));
        ok(planish_curve_load_file(path.as_ptr(), &mut from_file));
        for copy in [CurveHandle(loaded), CurveHandle(from_file)] {
            ok(planish_curve_save(copy.0, again.as_mut_ptr().cast(), size));
            assert_eq!(bytes, again);
        }
        let mut surface = canary();
        let status = planish_surface_load(bytes.as_ptr().cast(), size, &mut surface);
        refused(status, planish_status::Format, 24, &["a curve, not a surface"]);
        assert_untouched(&surface);
        let small = planish_curve_save(curve.0, again.as_mut_ptr().cast(), size - 1);
        refused(small, planish_status::BufferTooSmall, -1, &["buffer"]);
        null_refused(planish_curve_save(null(), again.as_mut_ptr().cast(), size), "curve");
        null_refused(planish_curve_save(curve.0, null_mut(), size), "buffer");
        null_refused(planish_curve_load(null(), size, &mut refused_curve), "buffer");
        null_refused(planish_curve_load(bytes.as_ptr().cast(), size, null_mut()), "out_curve");
        null_refused(planish_curve_save_file(null(), path.as_ptr()), "curve");
        null_refused(planish_curve_save_file(curve.0, null()), "path");
        null_refused(planish_curve_load_file(null(), &mut refused_curve), "path");
        null_refused(planish_curve_load_file(path.as_ptr(), null_mut()), "out_curve");
        bytes[40] ^= 1;
        let status = planish_curve_load(bytes.as_ptr().cast(), size, &mut refused_curve);
        refused(status, planish_status::Format, size as i64 - 8, &["checksum"]);
        std::fs::remove_file(path.to_str().unwrap()).unwrap();
        let status = planish_curve_load_file(path.as_ptr(), &mut refused_curve);
        refused(status, planish_status::File, -1, &["planish curve"]);
        assert_untouched(&refused_curve);
    }
}

#[test]
fn what_cannot_be_interpolated_or_measured_is_refused() {
    use planish_status::*;
    let curve = arc();
    let (u, values) = ([0.0, 0.5, 0.5, 1.0], [0.0, 1.0, 2.0, NAN]);
    let mut numbers: [f64; 4] = canary();
    let mut out = canary();
    // SAFETY: the arrays have these lengths, or are refused before.
    unsafe {
        let (u, v, n) = (u.as_ptr(), values.as_ptr(), numbers.as_mut_ptr());
        let mut make =
            |u, v, count, dim, options| planish_curve_interpolate(u, v, count, dim, options, &mut out);
        null_refused(make(null(), v, 3, 1, null()), "u");
        null_refused(make(u, null(), 3, 1, null()), "values");
        refused(make(u, v, 3, 1, null()), Degenerate, 2, &["parameter 2"]);
        refused(make(u, v, 4, 1, null()), NotFinite, 3, &["point 3"]);
        refused(make(u, v, 1, 1, null()), InvalidArgument, -1, &["1 points"]);
        refused(make(u, v, 2, 0, null()), InvalidArgument, -1, &["dimension is 0"]);
        let with = |ends, end_slopes| planish_interpolate_options { ends, end_slopes, ..record() };
        refused(make(u, v, 2, 1, &with(5, null())), InvalidArgument, -1, &["ends is 5"]);
        refused(make(u, v, 2, 1, &with(4, null())), InvalidArgument, -1, &["repeat the first point"]);
        refused(make(u, v, 2, 1, &with(0, v)), InvalidArgument, -1, &["end_slopes must be NULL"]);
        null_refused(make(u, v, 2, 1, &with(3, null())), "end_slopes");
        let newer = planish_interpolate_options { reserved: 1, ..record() };
        refused(make(u, v, 2, 1, &newer), Version, -1, &["reserved"]);
        null_refused(planish_curve_interpolate(u, v, 2, 1, null(), null_mut()), "out_curve");
        null_refused(planish_interpolate_options_init(null_mut(), 24), "options");
        assert_untouched(&out);

        let c = curve.0;
        null_refused(planish_curve_arc_lengths(null(), u, 1, n), "curve");
        null_refused(planish_curve_arc_lengths(c, null(), 1, n), "u");
        null_refused(planish_curve_arc_lengths(c, u, 1, null_mut()), "out_lengths");
        ok(planish_curve_arc_lengths(c, null(), 0, null_mut()));
        refused(planish_curve_arc_lengths(c, v.add(1), 2, n), Outside, 1, &["point 1 at 2"]);
        refused(planish_curve_arc_lengths(c, v.add(3), 1, n), NotFinite, 0, &["point 0"]);
        null_refused(planish_curve_project(null(), v, 1, null(), n, null_mut()), "curve");
        null_refused(planish_curve_project(c, null(), 1, null(), n, null_mut()), "points");
        refused(planish_curve_project(c, v, 2, null(), n, null_mut()), NotFinite, 1, &["point 1"]);
        let negative = planish_project_options { max_distance: -1.0, ..record() };
        let status = planish_curve_project(c, v, 1, &negative, n, null_mut());
        refused(status, InvalidArgument, -1, &["largest distance"]);
        assert_untouched(&numbers);
    }
}
