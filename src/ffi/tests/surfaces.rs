use super::*;

#[test]
fn a_surface_says_how_large_it_is() {
    let surface = SurfaceHandle::saddle();
    let (mut numbers, mut area): ([f64; 6], f64) = (canary(), canary());
    // SAFETY: the arrays have these lengths, or are refused before.
    unsafe {
        null_refused(planish_surface_box(null(), numbers.as_mut_ptr()), "surface");
        null_refused(planish_surface_box(surface.0, null_mut()), "out_box");
        null_refused(planish_surface_area(null(), null(), &mut area), "surface");
        null_refused(planish_surface_area(surface.0, null(), null_mut()), "out_area");
        let coarse = planish_tessellate_options { chord_tolerance: -1.0, ..record() };
        let status = planish_surface_area(surface.0, &coarse, &mut area);
        refused(status, planish_status::InvalidArgument, -1, &["chord_tolerance"]);
        assert_untouched(&numbers);
        assert_untouched(&area);
        ok(planish_surface_box(surface.0, numbers.as_mut_ptr()));
        ok(planish_surface_area(surface.0, null(), &mut area));
        assert_eq!(planish_surface_is_closed(surface.0, 0), 0);
        assert_eq!(planish_surface_is_closed(null(), 0), 0);
    }
    assert!(
        area > (numbers[3] - numbers[0]) * (numbers[4] - numbers[1]),
        "{area} is no more than its shadow"
    );
}

#[test]
fn a_flag_cancels_and_a_stage_is_shown() {
    let surface = SurfaceHandle::saddle();
    let (points, mut uv) = ([0.5; 3], [canary::<f64>(); 2]);
    let (cancel, mut stage) = (1, canary::<u32>());
    let options = planish_project_options { cancel: &cancel, out_stage: &mut stage, ..record() };
    // SAFETY: one point.
    let status = unsafe {
        planish_surface_project(surface.0, points.as_ptr(), 1, &options, uv.as_mut_ptr(), null_mut())
    };
    // so short a call may have ended before the flag was looked at
    if status as i32 != 0 {
        refused(status, planish_status::Cancelled, -1, &["cancelled"]);
        assert_untouched(&uv);
    }
    assert_eq!(stage, planish_stage::Project as u32);
}

#[test]
fn name_and_unit_are_refused_by_name() {
    let surface = SurfaceHandle::saddle();
    // SAFETY: the handle is alive, the texts end with a NUL.
    unsafe {
        ok(planish_surface_set_name(surface.0, c"part".as_ptr()));
        ok(planish_surface_set_unit(surface.0, 2));
        assert_eq!((planish_surface_name(surface.0, null_mut(), 0), planish_surface_unit(surface.0)), (4, 2));
        null_refused(planish_surface_set_name(null_mut(), c"part".as_ptr()), "surface");
        null_refused(planish_surface_set_name(surface.0, null()), "name");
        let status = planish_surface_set_name(surface.0, c"\xff".as_ptr());
        refused(status, planish_status::InvalidArgument, 0, &["name is not UTF-8"]);
        null_refused(planish_surface_set_unit(null_mut(), 0), "surface");
        let status = planish_surface_set_unit(surface.0, 3);
        refused(status, planish_status::InvalidArgument, -1, &["unit is 3"]);
        assert_eq!((planish_surface_name(surface.0, null_mut(), 0), planish_surface_unit(surface.0)), (4, 2));
    }
}

#[test]
fn headers_of_other_versions_are_refused() {
    ok(planish_check_version(0, 2));
    refused(planish_check_version(0, 1), planish_status::Version, -1, &["0.1", "0.2.0"]);
    refused(planish_check_version(0, 3), planish_status::Version, -1, &["0.3", "0.2.0"]);
    refused(planish_check_version(1, 0), planish_status::Version, -1, &["1.0"]);
}

const NAN: f64 = f64::NAN;

#[test]
fn a_saddle_answers_all_questions() {
    let saddle = SurfaceHandle::saddle();
    let (uv, mut values, mut rows) = ([0.25, 0.5, 1.0, 1.0], [0.0; 6], [0.0; 36]);
    let (mut normals, mut curvatures, mut grid) = ([0.0; 6], [0.0; 8], [0.0; 18]);
    let (mut domain, mut data_box) = ([0.0; 4], [0.0; 4]);
    let center = [0.0, 0.0];
    // SAFETY: the arrays have these lengths.
    unsafe {
        let s = saddle.0;
        assert_eq!(planish_surface_kind(s), planish_kind::Tensor as u32);
        assert_eq!((planish_surface_dim(s), planish_surface_coefficient_count(s)), (3, 4));
        ok(planish_surface_domain(s, domain.as_mut_ptr()));
        ok(planish_surface_data_box(s, data_box.as_mut_ptr()));
        ok(planish_surface_eval(s, uv.as_ptr(), 2, null(), values.as_mut_ptr()));
        ok(planish_surface_eval_derivatives(s, uv.as_ptr(), 2, 2, null(), rows.as_mut_ptr()));
        ok(planish_surface_normals(s, uv.as_ptr(), 2, null(), normals.as_mut_ptr()));
        ok(planish_surface_curvatures(s, center.as_ptr(), 1, null(), curvatures.as_mut_ptr()));
        let (u, v) = ([0.0, 0.5], [0.0, 0.25, 1.0]);
        ok(planish_surface_eval_grid(s, u.as_ptr(), 2, v.as_ptr(), 3, null(), grid.as_mut_ptr()));
        assert_eq!(planish_surface_trim_count(s), 0);
    }
    assert_eq!((domain, data_box), ([0.0, 1.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0]));
    assert_eq!(values, [0.25, 0.5, 0.125, 1.0, 1.0, 1.0]);
    let first = [0.25, 0.5, 0.125, 1., 0., 0.5, 0., 1., 0.25, 0., 0., 0., 0., 0., 1., 0., 0., 0.];
    assert_eq!(rows[..18], first);
    let length = (1.0_f64 + 0.25 + 0.0625).sqrt();
    for (n, expected) in normals.iter().zip([-0.5 / length, -0.25 / length, 1.0 / length]) {
        assert!((n - expected).abs() <= 4.0 * f64::EPSILON, "{normals:?}");
    }
    // z = x y has curvatures 1 and -1 along the diagonals
    let diagonal = 0.5_f64.sqrt();
    let expected = [1.0, -1.0, diagonal, diagonal, 0.0, -diagonal, diagonal, 0.0];
    for (k, expected) in curvatures.iter().zip(expected) {
        assert!((k - expected).abs() <= 4.0 * f64::EPSILON, "{curvatures:?}");
    }
    assert_eq!(grid[..9], [0., 0., 0., 0., 0.25, 0., 0., 1., 0.]);
    assert_eq!(grid[9..], [0.5, 0., 0., 0.5, 0.25, 0.125, 0.5, 1., 0.5]);
}

#[test]
fn strides_leave_gaps_alone() {
    let saddle = SurfaceHandle::saddle();
    let uv = [0.25, 0.5, NAN, 1.0, 1.0];
    let mut out: [f64; 9] = canary();
    let mut flags: [u8; 3] = canary();
    let options =
        planish_eval_options { uv_stride: 3, out_stride: 5, out_flags: flags.as_mut_ptr(), ..record() };
    // SAFETY: (2 - 1) * 3 + 2 and (2 - 1) * 5 + 3 numbers are used.
    ok(unsafe { planish_surface_eval(saddle.0, uv.as_ptr(), 2, &options, out.as_mut_ptr()) });
    assert_eq!([out[0], out[1], out[2], out[5], out[6], out[7]], [0.25, 0.5, 0.125, 1.0, 1.0, 1.0]);
    [3, 4, 8].iter().for_each(|&gap| assert_untouched(&out[gap]));
    assert_eq!(flags, [0, 0, CANARY]);
}

/// Calls all evaluations at `count` points with `options`; the last argument of each is an output.
fn eval_all(
    surface: *const planish_surface,
    uv: *const f64,
    count: usize,
    options: *const planish_eval_options,
    out: *mut f64,
    mut check: impl FnMut(planish_status, &str),
) {
    // SAFETY: the caller's arrays are long enough for each.
    unsafe {
        check(planish_surface_eval(surface, uv, count, options, out), "out_values");
        check(planish_surface_eval_derivatives(surface, uv, count, 2, options, out), "out");
        check(planish_surface_normals(surface, uv, count, options, out), "out_normals");
        check(planish_surface_curvatures(surface, uv, count, options, out), "out");
    }
}

#[test]
fn points_outside_are_refused_before_a_value_is_written() {
    let saddle = SurfaceHandle::saddle();
    let mut out: [f64; 64] = canary();
    let mut flags: [u8; 3] = canary();
    let options = planish_eval_options { out_flags: flags.as_mut_ptr(), ..record() };
    let uv = [0.5, 0.5, 1.0, 0.0, 0.5, 1.25];
    eval_all(saddle.0, uv.as_ptr(), 3, &options, out.as_mut_ptr(), |status, _| {
        refused(status, planish_status::Outside, 2, &["point 2", "(0.5, 1.25)"]);
    });
    for (bad, rule) in [(NAN, planish_outside::Fail), (f64::INFINITY, planish_outside::Extrapolate)] {
        let uv = [0.5, 0.5, bad, 0.0];
        let options = planish_eval_options { outside: rule as u32, ..options };
        eval_all(saddle.0, uv.as_ptr(), 2, &options, out.as_mut_ptr(), |status, _| {
            refused(status, planish_status::NotFinite, 1, &["point 1"]);
        });
    }
    let (u, v) = ([0.0, 2.0], [0.0, 1.0, 0.5]);
    // SAFETY: the arrays have these lengths.
    let status = unsafe {
        planish_surface_eval_grid(saddle.0, u.as_ptr(), 2, v.as_ptr(), 3, &options, out.as_mut_ptr())
    };
    refused(status, planish_status::Outside, 3, &["point 3", "(2, 0)"]);
    assert_untouched(&out);
    assert_untouched(&flags);
}

#[test]
fn points_outside_are_flagged_or_extrapolated() {
    let saddle = SurfaceHandle::saddle();
    let uv = [0.5, 0.5, 2.0, 1.5, NAN, 0.5, -1.0, 0.5];
    let (mut out, mut flags) = ([0.0; 12], [CANARY; 4]);
    let options = planish_eval_options {
        out_flags: flags.as_mut_ptr(),
        outside: planish_outside::Flag as u32,
        ..record()
    };
    // SAFETY: the arrays have these lengths.
    let status = unsafe { planish_surface_eval(saddle.0, uv.as_ptr(), 4, &options, out.as_mut_ptr()) };
    assert_eq!(status, planish_status::PointsOutside);
    assert_eq!(out[..3], [0.5, 0.5, 0.25]);
    assert!(out[3..].iter().all(|x| x.is_nan()), "{out:?}");
    assert_eq!(flags, [0, 1, 1, 1]);
    let mut many = [0.0; 72];
    eval_all(saddle.0, uv.as_ptr(), 4, &options, many.as_mut_ptr(), |status, _| {
        assert_eq!(status, planish_status::PointsOutside);
    });

    let options = planish_eval_options { outside: planish_outside::Extrapolate as u32, ..options };
    let uv = [0.5, 0.5, 2.0, 1.5, 1.0, 0.5, -1.0, 0.5];
    // SAFETY: the arrays have these lengths.
    ok(unsafe { planish_surface_eval(saddle.0, uv.as_ptr(), 4, &options, out.as_mut_ptr()) });
    assert_eq!(out[3..6], [2.0, 1.5, 3.0]);
    assert_eq!(out[9..], [-1.0, 0.5, -0.5]);
    assert_eq!(flags, [0, 1, 0, 1]);
}

#[test]
fn no_points_are_no_work() {
    let saddle = SurfaceHandle::saddle();
    eval_all(saddle.0, null(), 0, null(), null_mut(), |status, _| ok(status));
    // SAFETY: nothing is read or written.
    unsafe {
        let u = [0.5];
        ok(planish_surface_eval_grid(saddle.0, null(), 0, null(), 0, null(), null_mut()));
        ok(planish_surface_eval_grid(saddle.0, u.as_ptr(), 1, null(), 0, null(), null_mut()));
        ok(planish_surface_eval_grid(saddle.0, null(), 0, u.as_ptr(), 1, null(), null_mut()));
    }
}

#[test]
fn null_is_refused_by_name() {
    let saddle = SurfaceHandle::saddle();
    let (uv, mut out) = ([0.5, 0.5], [0.0; 64]);
    let (uv, out, s) = (uv.as_ptr(), out.as_mut_ptr(), saddle.0);
    eval_all(null(), uv, 1, null(), out, |status, _| null_refused(status, "surface"));
    eval_all(s, null(), 1, null(), out, |status, _| null_refused(status, "uv"));
    eval_all(s, uv, 1, null(), null_mut(), null_refused);
    // SAFETY: NULL is refused.
    unsafe {
        null_refused(planish_surface_eval_grid(null(), uv, 1, uv, 1, null(), out), "surface");
        null_refused(planish_surface_eval_grid(s, null(), 1, uv, 1, null(), out), "u");
        null_refused(planish_surface_eval_grid(s, uv, 1, null(), 1, null(), out), "v");
        null_refused(planish_surface_eval_grid(s, uv, 1, uv, 1, null(), null_mut()), "out_values");
        null_refused(planish_surface_domain(null(), out), "surface");
        null_refused(planish_surface_domain(s, null_mut()), "out_box");
        null_refused(planish_surface_data_box(null(), out), "surface");
        null_refused(planish_surface_data_box(s, null_mut()), "out_box");
        null_refused(planish_surface_copy_trim(null(), 0, out, 1), "surface");
        null_refused(planish_surface_set_trims(null_mut(), uv, null(), 0), "surface");
        null_refused(planish_surface_set_trims(s, uv, null(), 1), "point_counts");
        null_refused(planish_surface_set_trims(s, null(), [3].as_ptr(), 1), "uv");
        let mut copy = canary();
        null_refused(planish_surface_clone(null(), &mut copy), "surface");
        null_refused(planish_surface_clone(s, null_mut()), "out_surface");
        assert_untouched(&copy);
        assert_eq!(planish_surface_kind(null()), planish_kind::None as u32);
        assert_eq!(planish_surface_dim(null()), 0);
        assert_eq!(planish_surface_coefficient_count(null()), 0);
        assert_eq!(planish_surface_trim_count(null()), 0);
        assert_eq!(planish_surface_trim_point_count(null(), 0), 0);
        assert_eq!(message(), "surface is NULL");
        planish_surface_free(null_mut());
    }
}

#[test]
fn bad_options_are_refused() {
    use planish_status::*;
    let saddle = SurfaceHandle::saddle();
    let uv = [0.5, 0.5];
    let mut out: [f64; 64] = canary();
    let cases = [
        (planish_eval_options { uv_stride: 1, ..record() }, "uv_stride is 1"),
        (planish_eval_options { out_stride: 2, ..record() }, "out_stride is 2"),
        (planish_eval_options { outside: 3, ..record() }, "outside is 3"),
        (planish_eval_options { thread_count: 4000, ..record() }, "thread_count is 4000"),
    ];
    for (options, word) in cases {
        eval_all(saddle.0, uv.as_ptr(), 1, &options, out.as_mut_ptr(), |status, _| {
            refused(status, InvalidArgument, -1, &[word]);
        });
    }
    let huge = planish_eval_options { out_stride: usize::MAX / 8, ..record() };
    let uvs = [0.5; 6];
    eval_all(saddle.0, uvs.as_ptr(), 3, &huge, out.as_mut_ptr(), |status, name| {
        refused(status, TooLarge, -1, &[name]);
    });
    eval_all(saddle.0, uv.as_ptr(), usize::MAX / 2, null(), out.as_mut_ptr(), |status, _| {
        refused(status, TooLarge, -1, &["uv"]);
    });
    // SAFETY: refused before an element is read.
    unsafe {
        let (s, uv, o) = (saddle.0, uv.as_ptr(), out.as_mut_ptr());
        let status = planish_surface_eval_derivatives(s, uv, 1, 3, null(), o);
        refused(status, InvalidArgument, -1, &["max_derivative is 3", "2"]);
        let status = planish_surface_eval_grid(s, uv, 1 << 40, uv, 1 << 40, null(), o);
        refused(status, TooLarge, -1, &["out_values"]);
        let strided = planish_eval_options { uv_stride: 2, ..record() };
        let status = planish_surface_eval_grid(s, uv, 1, uv, 1, &strided, o);
        refused(status, InvalidArgument, -1, &["uv_stride is 2"]);
    }
    assert_untouched(&out);
}

#[test]
fn fields_have_no_normals() {
    let knots = [0.0, 0.0, 1.0, 1.0];
    let points = [0.0, 1.0, 2.0, 3.0];
    let mut out = null_mut();
    let (k, p, uv) = (knots.as_ptr(), points.as_ptr(), [0.5, 0.5]);
    let mut result: [f64; 8] = canary();
    // SAFETY: the arrays have these lengths.
    unsafe {
        ok(planish_tensor_new(1, 1, 1, k, 4, k, 4, p, null(), &mut out));
        let field = SurfaceHandle(out);
        let status = planish_surface_normals(field.0, uv.as_ptr(), 1, null(), result.as_mut_ptr());
        refused(status, planish_status::InvalidArgument, -1, &["dimension 1", "3"]);
        let status = planish_surface_curvatures(field.0, uv.as_ptr(), 1, null(), result.as_mut_ptr());
        refused(status, planish_status::InvalidArgument, -1, &["dimension 1", "3"]);
        assert_untouched(&result);
        ok(planish_surface_eval(field.0, uv.as_ptr(), 1, null(), result.as_mut_ptr()));
        assert_eq!(result[0], 1.5);
        assert_untouched(&result[1]);
    }
}

#[test]
fn points_without_normal_are_flagged() {
    let knots = [0.0, 0.0, 1.0, 1.0];
    // the side v = 0 is one point
    let points = [0., 0., 0., 1., 0., 0., 0., 0., 0., 1., 1., 0.];
    let mut out = null_mut();
    let (k, p, uv) = (knots.as_ptr(), points.as_ptr(), [0.5, 0.0, 0.5, 0.5]);
    let (mut normals, mut flags) = ([0.0; 6], [CANARY; 2]);
    let options = planish_eval_options { out_flags: flags.as_mut_ptr(), ..record() };
    // SAFETY: the arrays have these lengths.
    unsafe {
        ok(planish_tensor_new(3, 1, 1, k, 4, k, 4, p, null(), &mut out));
        let fan = SurfaceHandle(out);
        ok(planish_surface_normals(fan.0, uv.as_ptr(), 2, &options, normals.as_mut_ptr()));
    }
    assert!(normals[..3].iter().all(|x| x.is_nan()));
    assert_eq!(normals[3..].iter().map(|x| x.abs()).collect::<Vec<_>>(), [0.0, 0.0, 1.0]);
    assert_eq!(flags, [planish_flag::NoNormal as u8, 0]);
}

#[test]
fn threads_do_not_change_the_bits() {
    let saddle = SurfaceHandle::saddle();
    let count = 60_000;
    let place = |i: usize| (i as f64 * 0.618_033_988_749_895).fract();
    let uv: Vec<f64> = (0..2 * count).map(place).collect();
    let run = |thread_count| {
        let mut out = vec![0.0; 8 * count];
        let mut flags = vec![CANARY; count];
        let options = planish_eval_options { thread_count, out_flags: flags.as_mut_ptr(), ..record() };
        // SAFETY: the arrays have these lengths.
        ok(unsafe { planish_surface_curvatures(saddle.0, uv.as_ptr(), count, &options, out.as_mut_ptr()) });
        (out.into_iter().map(f64::to_bits).collect::<Vec<_>>(), flags)
    };
    let one = run(1);
    assert!(one == run(2) && one == run(5) && one == run(0));
}

#[test]
fn one_surface_serves_many_threads() {
    let saddle = SurfaceHandle::saddle();
    let address = saddle.0 as usize;
    std::thread::scope(|scope| {
        for k in 0..4 {
            scope.spawn(move || {
                let surface = address as *const planish_surface;
                for i in 0..200 {
                    let (uv, mut out) = ([f64::from(k) / 4.0, f64::from(i) / 200.0], [0.0; 3]);
                    // SAFETY: one point of a living surface.
                    ok(unsafe { planish_surface_eval(surface, uv.as_ptr(), 1, null(), out.as_mut_ptr()) });
                    assert_eq!(out, [uv[0], uv[1], uv[0] * uv[1]]);
                }
            });
        }
    });
}

#[test]
fn trims_are_replaced_whole_or_not_at_all() {
    use planish_status::*;
    let saddle = SurfaceHandle::saddle();
    let s = saddle.0;
    let square = [0.1, 0.1, 0.9, 0.1, 0.9, 0.9, 0.1, 0.9];
    let hole = [0.4, 0.4, 0.6, 0.4, 0.5, 0.6];
    let both: Vec<f64> = square.iter().chain(&hole).copied().collect();
    let mut copied: [f64; 8] = canary();
    // SAFETY: the arrays have these lengths.
    unsafe {
        ok(planish_surface_set_trims(s, both.as_ptr(), [4, 3].as_ptr(), 2));
        assert_eq!(planish_surface_trim_count(s), 2);
        assert_eq!([0, 1, 2].map(|k| planish_surface_trim_point_count(s, k)), [4, 3, 0]);
        let c = copied.as_mut_ptr();
        refused(planish_surface_copy_trim(s, 2, c, 8), Index, 2, &["trim 2", "there are 2"]);
        refused(planish_surface_copy_trim(s, 0, c, 3), BufferTooSmall, -1, &["out_uv", "3", "4"]);
        null_refused(planish_surface_copy_trim(s, 0, null_mut(), 4), "out_uv");
        assert_untouched(&copied);
        let set = |uv: &[f64], counts: &[usize]| {
            planish_surface_set_trims(s, uv.as_ptr(), counts.as_ptr(), counts.len())
        };
        refused(set(&both, &[4, 2]), InvalidArgument, 1, &["trim 1 has 2 points"]);
        refused(set(&both, &[0]), InvalidArgument, 0, &["trim 0 has 0 points"]);
        refused(set(&[0.5, 0.5, 0.5, 1.5, 0.0, 0.0], &[3]), Outside, 0, &["point 1 of trim 0"]);
        refused(set(&[0.5, 0.5, 0.5, 0.0, 0.0, NAN], &[3]), NotFinite, 0, &["point 2 of trim 0"]);
        refused(set(&both, &[usize::MAX, 2]), TooLarge, -1, &["uv"]);
        refused(set(&both, &[usize::MAX / 16]), TooLarge, -1, &["uv"]);
        assert_eq!(planish_surface_trim_count(s), 2);
        ok(planish_surface_copy_trim(s, 0, c, 4));
        assert_eq!(copied, square);

        let (uv, mut out, mut flags) = ([0.5, 0.5, 0.2, 0.2, 0.0, 0.5], [0.0; 9], [CANARY; 3]);
        let options = planish_eval_options { out_flags: flags.as_mut_ptr(), ..record() };
        ok(planish_surface_eval(s, uv.as_ptr(), 3, &options, out.as_mut_ptr()));
        let outside = planish_flag::OutsideTrims as u8;
        assert_eq!(flags, [outside, 0, outside]);

        let mut other = null_mut();
        ok(planish_surface_clone(s, &mut other));
        let clone = SurfaceHandle(other);
        ok(planish_surface_set_trims(s, null(), null(), 0));
        assert_eq!((planish_surface_trim_count(s), planish_surface_trim_count(clone.0)), (0, 2));
    }
}

#[test]
fn parts_of_a_tensor_come_back() {
    let (knots_u, knots_v) = ([0., 0., 0., 2., 2., 2.], [0., 0., 1., 3., 3.]);
    let points: [f64; 18] = std::array::from_fn(|i| (i * i) as f64);
    let weights: [f64; 9] = std::array::from_fn(|i| 1.0 + i as f64);
    let mut out = null_mut();
    let (mut u, mut v, mut p, mut w) = ([0.0; 6], [0.0; 5], [0.0; 18], [0.0; 9]);
    // SAFETY: the arrays have these lengths.
    unsafe {
        let (ku, kv, cp) = (knots_u.as_ptr(), knots_v.as_ptr(), points.as_ptr());
        for given in [weights.as_ptr(), null()] {
            ok(planish_tensor_new(2, 2, 1, ku, 6, kv, 5, cp, given, &mut out));
            let surface = SurfaceHandle(out);
            let s = surface.0;
            assert_eq!([0, 1].map(|axis| planish_tensor_degree(s, axis)), [2, 1]);
            assert_eq!([0, 1].map(|axis| planish_tensor_knot_count(s, axis)), [6, 5]);
            assert_eq!([0, 1].map(|axis| planish_tensor_control_point_count(s, axis)), [3, 3]);
            assert_eq!(planish_surface_coefficient_count(s), 9);
            ok(planish_tensor_copy_knots(s, planish_axis::U as u32, u.as_mut_ptr(), 6));
            ok(planish_tensor_copy_knots(s, planish_axis::V as u32, v.as_mut_ptr(), 5));
            ok(planish_tensor_copy_control_points(s, p.as_mut_ptr(), 9));
            ok(planish_tensor_copy_weights(s, w.as_mut_ptr(), 9));
            assert_eq!((u, v, p), (knots_u, knots_v, points));
            assert_eq!(planish_tensor_has_weights(s), u32::from(!given.is_null()));
            assert_eq!(w, if given.is_null() { [1.0; 9] } else { weights });

            let mut canaries: [f64; 18] = canary();
            let c = canaries.as_mut_ptr();
            let short = |status, name| refused(status, planish_status::BufferTooSmall, -1, &[name]);
            short(planish_tensor_copy_knots(s, 0, c, 5), "out_knots");
            short(planish_tensor_copy_control_points(s, c, 8), "out_control_points");
            short(planish_tensor_copy_weights(s, c, 0), "out_weights");
            null_refused(planish_tensor_copy_knots(s, 0, null_mut(), 6), "out_knots");
            null_refused(planish_tensor_copy_control_points(s, null_mut(), 9), "out_control_points");
            null_refused(planish_tensor_copy_weights(s, null_mut(), 9), "out_weights");
            null_refused(planish_tensor_copy_knots(null(), 0, c, 6), "surface");
            null_refused(planish_tensor_copy_control_points(null(), c, 9), "surface");
            null_refused(planish_tensor_copy_weights(null(), c, 9), "surface");
            let status = planish_tensor_copy_knots(s, 2, c, 6);
            refused(status, planish_status::InvalidArgument, -1, &["axis is 2", "choice is 1"]);
            assert_eq!((planish_tensor_degree(s, 2), planish_tensor_knot_count(s, 2)), (0, 0));
            assert_eq!(planish_tensor_control_point_count(s, 7), 0);
            assert_untouched(&canaries);
        }
    }
}

#[test]
fn another_family_is_no_tensor() {
    let other = SurfaceHandle::other_family();
    let mut out: [f64; 8] = canary();
    let (s, o) = (other.0, out.as_mut_ptr());
    let wrong = |status| refused(status, planish_status::WrongKind, -1, &["Pht", "Tensor"]);
    // SAFETY: a surface.
    unsafe {
        wrong(planish_tensor_copy_knots(s, 0, o, 8));
        wrong(planish_tensor_copy_control_points(s, o, 8));
        wrong(planish_tensor_copy_weights(s, o, 8));
        assert_eq!((planish_tensor_degree(s, 0), planish_tensor_knot_count(s, 0)), (0, 0));
        assert_eq!((planish_tensor_control_point_count(s, 0), planish_tensor_has_weights(s)), (0, 0));
        assert_eq!(planish_surface_kind(s), planish_kind::Pht as u32);
    }
    assert_untouched(&out);
}

#[test]
fn bad_parts_are_no_tensor() {
    use planish_status::*;
    let knots = [0.0, 0.0, 1.0, 1.0];
    let mut out = canary();
    let make =
        |dim, degrees: [u32; 2], u: &[f64], v: &[f64], points: *const f64, weights: *const f64, out| {
            // SAFETY: the arrays have these lengths, and points and weights are long enough.
            unsafe {
                let [p, q] = degrees;
                planish_tensor_new(dim, p, q, u.as_ptr(), u.len(), v.as_ptr(), v.len(), points, weights, out)
            }
        };
    let (points, weights) = ([0.0, 1.0, 2.0, NAN], [1.0, 1.0, -2.0, 1.0]);
    let (p, w) = (points.as_ptr(), weights.as_ptr());
    let flat = [1.0; 4];
    let f = flat.as_ptr();
    let out = &mut out;
    refused(make(0, [1, 1], &knots, &knots, p, null(), out), InvalidArgument, -1, &["dimension is 0"]);
    refused(make(1, [0, 1], &knots, &knots, p, null(), out), InvalidArgument, -1, &["in U", "degree 0"]);
    refused(make(1, [1, 10], &knots, &knots, p, null(), out), InvalidArgument, -1, &["in V", "degree 10"]);
    refused(make(1, [1, 1], &knots[..3], &knots, p, null(), out), InvalidArgument, -1, &["3 knots"]);
    refused(make(1, [1, 1], &knots, &[], p, null(), out), InvalidArgument, -1, &["in V", "0 knots"]);
    let falling = [0.0, 0.0, 1.0, 0.5];
    refused(make(1, [1, 1], &knots, &falling, p, null(), out), InvalidArgument, 3, &["in V", "knot 3"]);
    refused(make(1, [1, 1], &[0., 0., NAN, 1.], &knots, p, null(), out), NotFinite, 2, &["in U", "knot 2"]);
    let empty = [0.0, 1.0, 1.0, 2.0];
    refused(
        make(1, [1, 1], &empty, &knots, p, null(), out),
        Degenerate,
        -1,
        &["in U", "begins and ends at 1"],
    );
    refused(make(1, [1, 1], &knots, &knots, p, null(), out), NotFinite, 3, &["control point 3"]);
    refused(make(1, [1, 1], &knots, &knots, f, w, out), InvalidArgument, 2, &["weight 2 is -2"]);
    refused(make(1, [1, 1], &knots, &knots, f, p, out), InvalidArgument, 0, &["weight 0 is 0"]);
    null_refused(make(1, [1, 1], &knots, &knots, null(), null(), out), "control_points");
    refused(make(1 << 61, [1, 1], &knots, &knots, f, null(), out), TooLarge, -1, &["control_points"]);
    refused(make(1 << 57, [1, 1], &knots, &knots, f, null(), out), OutOfMemory, -1, &["control_points"]);
    // SAFETY: NULL is refused.
    unsafe {
        let k = knots.as_ptr();
        null_refused(planish_tensor_new(1, 1, 1, null(), 4, k, 4, f, null(), out), "knots_u");
        null_refused(planish_tensor_new(1, 1, 1, k, 4, null(), 4, f, null(), out), "knots_v");
        null_refused(planish_tensor_new(1, 1, 1, k, 4, k, 4, f, null(), null_mut()), "out_surface");
    }
    assert_untouched(out);
}
