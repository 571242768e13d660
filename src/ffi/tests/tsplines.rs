//! Skins and T-splines: results, refusals, parts in and out.

use super::*;
use libc::c_void;

/// A curve that frees itself.
struct CurveHandle(*mut planish_curve);

impl Drop for CurveHandle {
    fn drop(&mut self) {
        // SAFETY: made by the library and freed once.
        unsafe { planish_curve_free(self.0) }
    }
}

/// Waves over four rows of unlike counts.
struct Waves {
    points: Vec<f64>,
    counts: Vec<usize>,
}

impl Waves {
    fn new() -> Self {
        let counts = vec![20, 33, 9, 27];
        let row = |(j, &count): (usize, &usize)| {
            let share = move |k: usize| k as f64 / (count - 1) as f64;
            (0..count).flat_map(move |k| [share(k), j as f64, 0.2 * (9.0 * share(k) + j as f64).sin()])
        };
        Self { points: counts.iter().enumerate().flat_map(row).collect(), counts }
    }

    fn skin(
        &self,
        options: *const planish_skin_options,
        out: *mut *mut planish_surface,
        report: *mut planish_fit_report,
    ) -> planish_status {
        // SAFETY: as many points as the counts say.
        unsafe {
            planish_tspline_skin(
                self.points.as_ptr(),
                self.counts.as_ptr(),
                self.counts.len(),
                options,
                out,
                report,
            )
        }
    }

    fn surface(&self) -> SurfaceHandle {
        let mut out = null_mut();
        ok(self.skin(null(), &mut out, null_mut()));
        SurfaceHandle(out)
    }
}

#[test]
fn a_skin_keeps_the_tolerance_at_every_point() {
    let waves = Waves::new();
    let count = waves.points.len() / 3;
    let (mut uv, mut errors) = (vec![0.0; 2 * count], vec![0.0; count]);
    let (mut skin, mut report): (planish_skin_report, planish_fit_report) = (record(), record());
    let options = planish_skin_options {
        tolerance: 1e-4,
        tolerance_scale: planish_tolerance_scale::Absolute as u32,
        certify: 1,
        compare: 1,
        out_parameters: uv.as_mut_ptr(),
        out_errors: errors.as_mut_ptr(),
        out_report: &mut skin,
        ..record()
    };
    let mut out = null_mut();
    ok(waves.skin(&options, &mut out, &mut report));
    let surface = SurfaceHandle(out);
    let mut values = vec![0.0; 3 * count];
    // SAFETY: the arrays have these lengths.
    unsafe {
        ok(planish_surface_eval(surface.0, uv.as_ptr(), count, null(), values.as_mut_ptr()));
        assert_eq!(planish_surface_kind(surface.0), planish_kind::Tspline as u32);
        assert_eq!(planish_surface_coefficient_count(surface.0), report.coefficient_count);
        assert_eq!(planish_tspline_curve_count(surface.0), skin.curve_count);
    }
    for (k, (value, point)) in values.chunks(3).zip(waves.points.chunks(3)).enumerate() {
        let distance = (0..3).map(|c| (value[c] - point[c]).powi(2)).sum::<f64>().sqrt();
        assert!(distance <= 1e-4 && (distance - errors[k]).abs() <= 1e-15, "point {k}: {distance:e}");
    }
    assert_eq!(errors.iter().copied().fold(0.0, f64::max), report.max_error);
    assert_eq!((skin.curve_count, skin.twisted_row, skin.merged_point_count), (6, -1, 0));
    assert!(skin.least_count <= skin.largest_count && skin.largest_count * 6 <= skin.tensor_count);
    assert!(skin.common_count > 0 && skin.strip_count > 0 && skin.overshoot > 1.0);
    assert!(skin.certified_distance > 0.0 && skin.certified_distance < 1e-3);

    let common = planish_skin_options {
        method: planish_skin_method::CommonKnots as u32,
        out_parameters: null_mut(),
        ..options
    };
    let mut out = null_mut();
    let expected = skin.common_count;
    ok(waves.skin(&common, &mut out, &mut report));
    let _classical = SurfaceHandle(out);
    assert_eq!(report.coefficient_count, expected);
    assert!(report.max_error <= 1e-4);
}

#[test]
fn bad_rows_are_refused_and_nothing_is_touched() {
    let waves = Waves::new();
    let (mut out, mut report): (*mut planish_surface, planish_fit_report) = (canary(), canary());
    report.struct_size = size_of_val(&report);
    let mut bad = |points: &[f64], counts: &[usize], options: planish_skin_options| {
        // SAFETY: refused before points beyond the array are read, as the counts are those of the points.
        unsafe {
            planish_tspline_skin(
                points.as_ptr(),
                counts.as_ptr(),
                counts.len(),
                &options,
                &mut out,
                &mut report,
            )
        }
    };
    let (points, counts) = (&waves.points[..], &waves.counts[..]);
    let invalid = planish_status::InvalidArgument;
    refused(bad(&points[..60], &counts[..1], record()), invalid, -1, &["1 rows are too few"]);
    refused(bad(points, &[20, 0, 33, 9, 27], record()), invalid, 1, &["row 1 has no points"]);
    let mut broken = points.to_vec();
    broken[3 * 25 + 2] = f64::INFINITY;
    refused(bad(&broken, counts, record()), planish_status::NotFinite, 25, &["point 25", "row 1"]);
    let twice = [&points[..60], points].concat();
    let status = bad(&twice, &[20, 20, 33, 9, 27], record());
    refused(status, planish_status::Degenerate, 1, &["row 1 lies on the row before"]);
    for (options, word) in [
        (planish_skin_options { tolerance: 0.0, ..record() }, "tolerance"),
        (planish_skin_options { dim: 0, ..record() }, "dim"),
        (planish_skin_options { tolerance_scale: 2, ..record() }, "tolerance_scale"),
        (planish_skin_options { method: 2, ..record() }, "method"),
        (planish_skin_options { closed: 2, ..record() }, "closed"),
        (planish_skin_options { ends: 5, ..record() }, "ends"),
        (planish_skin_options { ends: 4, ..record() }, "ends"),
        (planish_skin_options { closed_v: 2, ..record() }, "closed_v"),
        (planish_skin_options { v_rule: 2, ..record() }, "v_rule"),
        (planish_skin_options { align: 2, ..record() }, "align"),
        (planish_skin_options { approximate_v: 2, ..record() }, "approximate_v"),
        (planish_skin_options { approximate_v: 1, closed_v: 1, ..record() }, "approximate_v"),
        (planish_skin_options { extra_checks: 101, ..record() }, "extra_checks"),
        (planish_skin_options { batch: 2, ..record() }, "batch"),
        (planish_skin_options { removal: 2, ..record() }, "removal"),
        (planish_skin_options { certify: 2, ..record() }, "certify"),
        (planish_skin_options { compare: 2, ..record() }, "compare"),
        (planish_skin_options { thread_count: 1025, ..record() }, "thread_count"),
    ] {
        refused(bad(points, counts, options), invalid, -1, &[word]);
    }
    let no_slopes = planish_skin_options { ends: planish_section_ends::Slopes as u32, ..record() };
    null_refused(bad(points, counts, no_slopes), "end_slopes");
    let wrong = [f64::NAN; 60];
    let tangents = planish_skin_options { begin_tangents: wrong.as_ptr(), ..record() };
    refused(bad(points, counts, tangents), planish_status::NotFinite, 0, &["begin_tangents"]);
    let too_many = [usize::MAX, 2];
    refused(bad(points, &too_many, record()), planish_status::TooLarge, -1, &["points"]);
    assert_untouched(&out);
    report.struct_size = canary();
    assert_untouched(&report);

    // SAFETY: NULL is refused.
    unsafe {
        let (points, counts) = (points.as_ptr(), counts.as_ptr());
        null_refused(planish_tspline_skin(null(), counts, 4, null(), &mut out, null_mut()), "points");
        null_refused(planish_tspline_skin(points, null(), 4, null(), &mut out, null_mut()), "row_counts");
        null_refused(planish_tspline_skin(points, counts, 4, null(), null_mut(), null_mut()), "out_surface");
        let status = planish_tspline_skin(null(), null(), 0, null(), &mut out, null_mut());
        refused(status, invalid, -1, &["0 rows"]);
    }
    assert_untouched(&out);
}

#[test]
fn remarks_come_back_as_statuses() {
    let mut waves = Waves::new();
    waves.points.copy_within(0..3, 3);
    let (mut out, mut report) = (null_mut(), record());
    assert_eq!(waves.skin(null(), &mut out, &mut report), planish_status::InputRepaired);
    let _surface = SurfaceHandle(out);
    assert_eq!(report.remarks, planish_remark::MergedPoints as u64);

    unsafe extern "C-unwind" fn stop(_: f64, _: f64, _: *mut c_void) -> i32 {
        1
    }
    let mut out = canary();
    let options = planish_skin_options { progress: Some(stop), ..record() };
    refused(waves.skin(&options, &mut out, null_mut()), planish_status::Cancelled, -1, &["cancelled"]);
    assert_untouched(&out);
}

#[test]
fn curves_and_knots_come_out_and_make_the_same_surface() {
    let surface = Waves::new().surface();
    // SAFETY: live handles, and arrays of these lengths.
    unsafe {
        let mut knots = vec![0.0; planish_tspline_knot_count(surface.0)];
        ok(planish_tspline_copy_knots(surface.0, knots.as_mut_ptr(), knots.len()));
        let curves: Vec<CurveHandle> = (0..planish_tspline_curve_count(surface.0))
            .map(|curve| {
                let mut out = null_mut();
                ok(planish_tspline_clone_curve(surface.0, curve, &mut out));
                CurveHandle(out)
            })
            .collect();
        assert_eq!(knots.len(), curves.len() + 4);
        let counts = curves.iter().map(|curve| planish_curve_control_point_count(curve.0));
        assert_eq!(counts.sum::<usize>(), planish_surface_coefficient_count(surface.0));

        let pointers: Vec<*const planish_curve> = curves.iter().map(|curve| curve.0.cast_const()).collect();
        let mut again = null_mut();
        let new =
            |out| planish_tspline_new(knots.as_ptr(), knots.len(), pointers.as_ptr(), pointers.len(), out);
        ok(new(&mut again));
        let again = SurfaceHandle(again);
        let (mut a, mut b) = ([0.0; 3], [1.0; 3]);
        let uv = [0.37, 0.61];
        ok(planish_surface_eval(surface.0, uv.as_ptr(), 1, null(), a.as_mut_ptr()));
        ok(planish_surface_eval(again.0, uv.as_ptr(), 1, null(), b.as_mut_ptr()));
        assert_eq!(a, b);

        // skins of curves
        let mut skin = null_mut();
        ok(planish_tspline_skin_curves(pointers.as_ptr(), pointers.len(), null(), &mut skin, null_mut()));
        assert_eq!(planish_tspline_curve_count(SurfaceHandle(skin).0), curves.len() + 2);

        let mut out = canary();
        let given = planish_skin_options { out_errors: a.as_mut_ptr(), ..record() };
        let status = planish_tspline_skin_curves(pointers.as_ptr(), 2, &given, &mut out, null_mut());
        refused(status, planish_status::InvalidArgument, -1, &["out_errors must be NULL"]);
        let holes = [pointers[0], null()];
        null_refused(planish_tspline_skin_curves(holes.as_ptr(), 2, null(), &mut out, null_mut()), "a curve");
        null_refused(planish_tspline_skin_curves(null(), 2, null(), &mut out, null_mut()), "curves");
        let status = planish_tspline_skin_curves(null(), 0, null(), &mut out, null_mut());
        refused(status, planish_status::InvalidArgument, -1, &["0 rows"]);
        let status = planish_tspline_new(knots.as_ptr(), knots.len(), pointers.as_ptr(), 2, &mut out);
        refused(status, planish_status::InvalidArgument, -1, &["2 control curves"]);
        null_refused(planish_tspline_new(null(), 8, pointers.as_ptr(), 2, &mut out), "knots");
        null_refused(planish_tspline_new(knots.as_ptr(), 8, pointers.as_ptr(), 2, null_mut()), "out_surface");
        assert_untouched(&out);
    }
}

#[test]
fn curves_are_made_of_their_parts_or_refused() {
    let knots = [0.0, 0.0, 1.0, 1.0];
    let mut points = [0.0, 0.0, 2.0, 4.0];
    let mut out = null_mut();
    // SAFETY: arrays of these lengths.
    unsafe {
        ok(planish_curve_new(2, 1, knots.as_ptr(), 4, points.as_ptr(), &mut out));
        let curve = CurveHandle(out);
        assert_eq!((planish_curve_dim(curve.0), planish_curve_degree(curve.0)), (2, 1));
        let mut out = canary();
        let invalid = planish_status::InvalidArgument;
        let status = planish_curve_new(2, 0, knots.as_ptr(), 4, points.as_ptr(), &mut out);
        refused(status, invalid, -1, &["degree 0"]);
        refused(planish_curve_new(0, 1, knots.as_ptr(), 4, null(), &mut out), invalid, -1, &["dimension"]);
        points[3] = f64::NAN;
        let status = planish_curve_new(2, 1, knots.as_ptr(), 4, points.as_ptr(), &mut out);
        refused(status, planish_status::NotFinite, 1, &["control point 1"]);
        null_refused(planish_curve_new(2, 1, null(), 4, points.as_ptr(), &mut out), "knots");
        null_refused(planish_curve_new(2, 1, knots.as_ptr(), 4, null(), &mut out), "control_points");
        null_refused(planish_curve_new(2, 1, knots.as_ptr(), 4, points.as_ptr(), null_mut()), "out_curve");
        assert_untouched(&out);
    }
}

#[test]
fn knots_go_in_and_out() {
    let surface = Waves::new().surface();
    let count = |surface: &SurfaceHandle| {
        // SAFETY: a live handle.
        unsafe { planish_surface_coefficient_count(surface.0) }
    };
    let before = count(&surface);
    // SAFETY: live handles.
    unsafe {
        ok(planish_tspline_insert_knot_u(surface.0, 1, 0.123));
        assert_eq!(count(&surface), before + 1);
        let mut curve = null_mut();
        ok(planish_tspline_clone_curve(surface.0, 1, &mut curve));
        let curve = CurveHandle(curve);
        let mut knots = vec![0.0; planish_curve_knot_count(curve.0)];
        ok(planish_curve_copy_knots(curve.0, knots.as_mut_ptr(), knots.len()));
        let knot = knots.iter().position(|&t| t == 0.123).unwrap();
        let mut error = -1.0;
        let status = planish_tspline_remove_knot_u(surface.0, 1, knot, -1.0, &mut error);
        assert_eq!(status, planish_status::ToleranceNotMet);
        assert!((0.0..1e-12).contains(&error) && count(&surface) == before + 1);
        ok(planish_tspline_remove_knot_u(surface.0, 1, knot, 1e-12, null_mut()));
        assert_eq!(count(&surface), before);
        ok(planish_tspline_insert_knot_v(surface.0, 0.5));
        assert_eq!(planish_tspline_curve_count(surface.0), 7);

        let mut error = canary();
        let remove = |curve, knot, error| planish_tspline_remove_knot_u(surface.0, curve, knot, 1.0, error);
        refused(remove(99, 5, &mut error), planish_status::Index, 99, &["control curve 99"]);
        refused(remove(0, 2, &mut error), planish_status::Index, 2, &["no knot 2"]);
        assert_untouched(&error);
        let status = planish_tspline_insert_knot_u(surface.0, 0, f64::NAN);
        refused(status, planish_status::Outside, -1, &["NaN"]);
        let status = planish_tspline_insert_knot_u(surface.0, 99, 0.5);
        refused(status, planish_status::Index, 99, &["control curve 99"]);
        refused(planish_tspline_insert_knot_v(surface.0, 1.0), planish_status::Outside, -1, &["outside"]);
        ok(planish_tspline_insert_knot_v(surface.0, 0.5));
        ok(planish_tspline_insert_knot_v(surface.0, 0.5));
        let status = planish_tspline_insert_knot_v(surface.0, 0.5);
        refused(status, planish_status::InvalidArgument, -1, &["tears"]);
    }
}

#[test]
fn other_families_and_null_are_refused() {
    let (saddle, surface) = (SurfaceHandle::saddle(), Waves::new().surface());
    let mut curve: *mut planish_curve = canary();
    let mut knots = [0.0; 99];
    let wrong = planish_status::WrongKind;
    // SAFETY: live handles or NULL.
    unsafe {
        assert_eq!((planish_tspline_curve_count(saddle.0), planish_tspline_knot_count(saddle.0)), (0, 0));
        assert_eq!((planish_tspline_curve_count(null()), planish_tspline_knot_count(null())), (0, 0));
        refused(planish_tspline_insert_knot_u(saddle.0, 0, 0.5), wrong, -1, &["TSpline"]);
        refused(planish_tspline_insert_knot_v(saddle.0, 0.5), wrong, -1, &["TSpline"]);
        refused(planish_tspline_remove_knot_u(saddle.0, 0, 4, 1.0, null_mut()), wrong, -1, &["TSpline"]);
        refused(planish_tspline_copy_knots(saddle.0, knots.as_mut_ptr(), 99), wrong, -1, &["TSpline"]);
        refused(planish_tspline_clone_curve(saddle.0, 0, &mut curve), wrong, -1, &["TSpline"]);
        refused(planish_tensor_copy_knots(surface.0, 0, knots.as_mut_ptr(), 99), wrong, -1, &["Tensor"]);
        null_refused(planish_tspline_insert_knot_u(null_mut(), 0, 0.5), "surface");
        null_refused(planish_tspline_insert_knot_v(null_mut(), 0.5), "surface");
        null_refused(planish_tspline_remove_knot_u(null_mut(), 0, 4, 1.0, null_mut()), "surface");
        null_refused(planish_tspline_copy_knots(null(), knots.as_mut_ptr(), 99), "surface");
        null_refused(planish_tspline_clone_curve(null(), 0, &mut curve), "surface");
        null_refused(planish_tspline_clone_curve(surface.0, 0, null_mut()), "out_curve");
        let status = planish_tspline_copy_knots(surface.0, knots.as_mut_ptr(), 3);
        refused(status, planish_status::BufferTooSmall, -1, &["out_knots", "room for 3"]);
        let status = planish_tspline_clone_curve(surface.0, 6, &mut curve);
        refused(status, planish_status::Index, 6, &["control curve 6"]);
    }
    assert_untouched(&curve);
}
