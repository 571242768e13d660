use super::super::report::gravest;
use super::*;
use libc::c_void;

fn tensor() -> planish_tensor_options {
    record()
}

/// Fits with an empty report.
fn fit(
    mesh: &MeshHandle,
    options: &planish_tensor_options,
) -> (planish_status, SurfaceHandle, planish_fit_report) {
    let (mut out, mut report) = (null_mut(), record());
    // SAFETY: handles and records of this test.
    let status = unsafe { planish_tensor_fit(mesh.0, options, &mut out, &mut report) };
    (status, SurfaceHandle(out), report)
}

#[test]
fn a_fit_keeps_the_tolerance_at_every_node() {
    let sheet = Sheet::new(33);
    let mesh = sheet.mesh_with_parameters();
    let count = sheet.count();
    let (mut parameters, mut errors) = (vec![0.0; 2 * count], vec![0.0; count]);
    let options = planish_tensor_options {
        tolerance: 1e-3,
        tolerance_scale: planish_tolerance_scale::Absolute as u32,
        out_parameters: parameters.as_mut_ptr(),
        out_errors: errors.as_mut_ptr(),
        ..tensor()
    };
    let (status, surface, report) = fit(&mesh, &options);
    ok(status);
    assert!(report.max_error <= 1e-3 && report.tolerance == 1e-3, "{report:?}");
    assert_eq!((report.stop_reason, report.remarks), (planish_stop_reason::ToleranceMet as u32, 0));
    assert_eq!(parameters, sheet.uv);
    let mut values = vec![0.0; 3 * count];
    // SAFETY: the arrays have these lengths.
    ok(unsafe { planish_surface_eval(surface.0, parameters.as_ptr(), count, null(), values.as_mut_ptr()) });
    let distance =
        |i: usize| (0..3).map(|k| (values[3 * i + k] - sheet.points[3 * i + k]).powi(2)).sum::<f64>();
    for (i, &error) in errors.iter().enumerate() {
        assert!((distance(i).sqrt() - error).abs() <= 1e-15, "node {i}");
    }
    assert_eq!(errors.iter().copied().fold(0.0, f64::max), report.max_error);
    assert_eq!(errors[report.worst_index], report.max_error);

    // the surface reaches beyond the data, which the trims and the data box bound
    let (mut domain, mut data_box) = ([0.0; 4], [0.0; 4]);
    // SAFETY: the arrays have these lengths.
    unsafe {
        ok(planish_surface_domain(surface.0, domain.as_mut_ptr()));
        ok(planish_surface_data_box(surface.0, data_box.as_mut_ptr()));
        assert_eq!(planish_surface_trim_count(surface.0), 1);
        assert_eq!(planish_surface_trim_point_count(surface.0, 0), 128);
        let grid = [0, 1].map(|axis| planish_tensor_control_point_count(surface.0, axis) - 2);
        assert_eq!(grid, [report.grid_u, report.grid_v]);
        let (uv, mut value, mut flag) = ([-0.05, 0.5], [0.0; 3], 0);
        let flagged = planish_eval_options { out_flags: &mut flag, ..record() };
        ok(planish_surface_eval(surface.0, uv.as_ptr(), 1, &flagged, value.as_mut_ptr()));
        assert_eq!(flag, planish_flag::InBuffer as u8 | planish_flag::OutsideTrims as u8);
    }
    assert_eq!(data_box, [0.0, 1.0, 0.0, 1.0]);
    // by a tenth of the data's range, or less where the surface would leave their box, but not less than a twentieth
    for (found, side) in domain.iter().zip([0.0, 1.0, 0.0, 1.0]) {
        let beyond = (found - side).abs();
        assert!((0.05 - 4.0 * f64::EPSILON..=0.1 + 4.0 * f64::EPSILON).contains(&beyond), "{domain:?}");
    }
}

#[test]
fn a_mesh_without_parameters_is_parameterized() {
    let mesh = Sheet::new(9).mesh();
    let (status, surface, report) = fit(&mesh, &tensor());
    assert!(status as i32 >= 0 && !surface.0.is_null());
    assert_ne!(report.remarks & planish_remark::Parameterized as u64, 0);
    // SAFETY: a mesh.
    assert_eq!(unsafe { planish_mesh_has_parameters(mesh.0) }, 0);
    let harmonic = planish_parameterize_options {
        method: planish_map_method::Harmonic as u32,
        border: planish_border::Circle as u32,
        stretch_steps: 0,
        ..record()
    };
    let (_, _, other) = fit(&mesh, &planish_tensor_options { parameterize: &harmonic, ..tensor() });
    assert_ne!(other.stretch, report.stretch);
}

#[test]
fn remarks_are_returned_with_the_surface() {
    let mesh = Sheet::new(9).mesh_with_parameters();
    let coarse = planish_tensor_options { tolerance: 1e-9, max_grid: 3, ..tensor() };
    let (status, surface, report) = fit(&mesh, &coarse);
    assert_eq!(status, planish_status::ToleranceNotMet);
    assert!(!surface.0.is_null() && report.max_error > report.tolerance);
    assert_eq!(report.stop_reason, planish_stop_reason::Limit as u32);
    assert_ne!(report.remarks & planish_remark::ToleranceNotMet as u64, 0);

    let fixed = planish_tensor_options { tolerance: 1e-9, grid_u: 3, grid_v: 4, ..tensor() };
    let (status, _, report) = fit(&mesh, &fixed);
    assert_eq!(status, planish_status::ToleranceNotMet);
    assert_eq!((report.grid_u, report.grid_v), (3, 4));
    assert_eq!(report.stop_reason, planish_stop_reason::FixedGrid as u32);

    // every other row of nodes is raised: whatever is met, no more coefficients than data and no swing between the rows
    let mut ridges = Sheet::new(8);
    (0..64).filter(|i| i / 8 % 2 == 1).for_each(|i| ridges.points[3 * i + 2] = 0.3);
    (0..64).filter(|i| i / 8 % 2 == 0).for_each(|i| ridges.points[3 * i + 2] = 0.0);
    for knots in [planish_knots::Adaptive, planish_knots::Uniform] {
        let loose = planish_tensor_options { tolerance: 1e-2, knots: knots as u32, ..tensor() };
        let (status, surface, report) = fit(&ridges.mesh_with_parameters(), &loose);
        let is_met = report.max_error <= report.tolerance;
        assert_eq!(status == planish_status::ToleranceNotMet, !is_met, "{report:?}");
        assert!(!surface.0.is_null() && report.coefficient_count <= 64, "{report:?}");
        // the tamest one is returned: it does not swing by more than the rows differ
        assert!(report.max_interior_error <= 0.3, "{report:?}");
    }

    // two values at each place: no grid follows both
    let places: Vec<f64> = (0..800).flat_map(|k| [f64::from(k / 2 % 20), f64::from(k / 40)]).collect();
    let twofold: Vec<f64> = (0..800).map(|k| 0.3 * f64::from(k % 2)).collect();
    let uniform = planish_tensor_options { knots: planish_knots::Uniform as u32, ..tensor() };
    let (mut out, mut report) = (null_mut(), record::<planish_fit_report>());
    // SAFETY: the arrays have these lengths.
    let status = unsafe {
        planish_tensor_fit_points(places.as_ptr(), twofold.as_ptr(), 800, 1, &uniform, &mut out, &mut report)
    };
    let _surface = SurfaceHandle(out);
    assert_eq!(status, planish_status::ToleranceNotMet, "the graver of both: {report:?}");
    assert_eq!(report.stop_reason, planish_stop_reason::Stagnated as u32);
    assert_ne!(report.remarks & planish_remark::Stagnated as u64, 0);

    // two nodes inside exchange their parameters
    let mut sheet = Sheet::new(9);
    sheet.uv.swap(2 * 40, 2 * 50);
    sheet.uv.swap(2 * 40 + 1, 2 * 50 + 1);
    let folded = sheet.mesh_with_parameters();
    let keep =
        planish_tensor_options { regularize: planish_regularize::Never as u32, max_grid: 5, ..tensor() };
    let (status, surface, report) = fit(&folded, &keep);
    assert_eq!(status, planish_status::FoldedParameters);
    assert!(!surface.0.is_null() && report.flipped_count > 0);
    let both = planish_remark::FoldedParameters as u64 | planish_remark::ToleranceNotMet as u64;
    assert_eq!(report.remarks & both, both);
}

#[test]
fn the_gravest_remark_is_returned() {
    let order = [
        (planish_remark::FoldedParameters, planish_status::FoldedParameters),
        (planish_remark::ToleranceNotMet, planish_status::ToleranceNotMet),
        (planish_remark::Stagnated, planish_status::Stagnated),
        (planish_remark::MergedPoints, planish_status::InputRepaired),
    ];
    let mut lighter = !order.iter().map(|&(remark, _)| remark as u64).sum::<u64>();
    assert_eq!(gravest(lighter), planish_status::Ok);
    for (remark, status) in order.into_iter().rev() {
        lighter |= remark as u64;
        assert_eq!(gravest(lighter), status);
        assert_eq!(gravest(remark as u64), status);
    }
}

#[test]
fn bad_options_are_refused() {
    use planish_status::*;
    let mesh = Sheet::new(4).mesh_with_parameters();
    let mut weights = [1.0; 16];
    weights[5] = 0.0;
    let mut infinite = weights;
    infinite[5] = f64::INFINITY;
    let node_weights = planish_parameterize_options { node_weights: weights.as_ptr(), ..record() };
    let border = planish_parameterize_options { border: 9, ..record() };
    let cases: [(planish_tensor_options, planish_status, i64, &str); 21] = [
        (planish_tensor_options { tolerance: 0.0, ..tensor() }, InvalidArgument, -1, "tolerance is 0"),
        (planish_tensor_options { tolerance: f64::NAN, ..tensor() }, InvalidArgument, -1, "tolerance is NaN"),
        (planish_tensor_options { smoothing: -1.0, ..tensor() }, InvalidArgument, -1, "smoothing is -1"),
        (planish_tensor_options { buffer: 11.0, ..tensor() }, InvalidArgument, -1, "buffer is 11"),
        (planish_tensor_options { max_grid: 1, ..tensor() }, InvalidArgument, -1, "max_grid is 1"),
        (planish_tensor_options { max_coefficients: 3, ..tensor() }, InvalidArgument, -1, "is 3"),
        (planish_tensor_options { grid_u: 5, ..tensor() }, InvalidArgument, -1, "grid is 0"),
        (planish_tensor_options { grid_u: 5, grid_v: 8194, ..tensor() }, InvalidArgument, -1, "grid is 8194"),
        (
            planish_tensor_options { tolerance_scale: 2, ..tensor() },
            InvalidArgument,
            -1,
            "tolerance_scale is 2",
        ),
        (planish_tensor_options { method: 2, ..tensor() }, InvalidArgument, -1, "method is 2"),
        (planish_tensor_options { ends: 2, ..tensor() }, InvalidArgument, -1, "ends is 2"),
        (planish_tensor_options { energy: 2, ..tensor() }, InvalidArgument, -1, "energy is 2"),
        (planish_tensor_options { knots: 2, ..tensor() }, InvalidArgument, -1, "knots is 2"),
        (planish_tensor_options { regularize: 3, ..tensor() }, InvalidArgument, -1, "regularize is 3"),
        (planish_tensor_options { measure_distance: 2, ..tensor() }, InvalidArgument, -1, "distance is 2"),
        (
            planish_tensor_options { thread_count: 2000, ..tensor() },
            InvalidArgument,
            -1,
            "thread_count is 2000",
        ),
        (
            planish_tensor_options { weights: weights.as_ptr(), ..tensor() },
            InvalidArgument,
            5,
            "weight 5 is 0",
        ),
        (planish_tensor_options { weights: infinite.as_ptr(), ..tensor() }, NotFinite, 5, "weight 5 is inf"),
        (
            planish_tensor_options { parameterize: &node_weights, ..tensor() },
            InvalidArgument,
            -1,
            "node_weights",
        ),
        (planish_tensor_options { parameterize: &border, ..tensor() }, InvalidArgument, -1, "border is 9"),
        (planish_tensor_options { struct_size: 3, ..tensor() }, InvalidArgument, -1, "struct_size"),
    ];
    for (options, status, index, word) in cases {
        let (mut parameters, mut errors): ([f64; 32], [f64; 16]) = (canary(), canary());
        let (mut out, mut report): (_, planish_fit_report) = (canary(), canary());
        report.struct_size = size_of_val(&report);
        let options = planish_tensor_options {
            out_parameters: parameters.as_mut_ptr(),
            out_errors: errors.as_mut_ptr(),
            ..options
        };
        // SAFETY: handles and records of this test.
        let found = unsafe { planish_tensor_fit(mesh.0, &options, &mut out, &mut report) };
        refused(found, status, index, &[word]);
        report.struct_size = canary();
        assert_untouched(&out);
        assert_untouched(&report);
        assert_untouched(&parameters);
        assert_untouched(&errors);
    }
}

#[test]
fn null_is_refused_by_name() {
    let sheet = Sheet::new(4);
    let mesh = sheet.mesh_with_parameters();
    let (uv, values) = (sheet.uv.as_ptr(), sheet.points.as_ptr());
    let mut out = canary();
    let (m, none) = (mesh.0, null_mut());
    // SAFETY: NULL is refused.
    unsafe {
        null_refused(planish_tensor_fit(null(), null(), &mut out, none), "mesh");
        null_refused(planish_tensor_fit(m, null(), null_mut(), none), "out_surface");
        null_refused(planish_tensor_fit_points(null(), values, 16, 3, null(), &mut out, none), "uv");
        null_refused(planish_tensor_fit_points(uv, null(), 16, 3, null(), &mut out, none), "values");
        null_refused(planish_tensor_fit_points(uv, values, 16, 3, null(), null_mut(), none), "out_surface");
        null_refused(planish_tensor_fit_field(null(), values, 16, 3, null(), &mut out, none), "mesh");
        null_refused(planish_tensor_fit_field(m, null(), 16, 3, null(), &mut out, none), "values");
        null_refused(planish_tensor_fit_field(m, values, 16, 3, null(), null_mut(), none), "out_surface");
    }
    assert_untouched(&out);
}

#[test]
fn bad_data_are_refused() {
    use planish_status::*;
    let mut sheet = Sheet::new(4);
    let mesh = sheet.mesh_with_parameters();
    let mut out = canary();
    let points = |uv: &[f64], values: &[f64], count, dim, out| {
        // SAFETY: the arrays are as long as said, or refused before.
        unsafe {
            planish_tensor_fit_points(uv.as_ptr(), values.as_ptr(), count, dim, null(), out, null_mut())
        }
    };
    let field = |values: &[f64], count, dim, out| {
        // SAFETY: the arrays are as long as said, or refused before.
        unsafe { planish_tensor_fit_field(mesh.0, values.as_ptr(), count, dim, null(), out, null_mut()) }
    };
    let Sheet { points: values, uv, .. } = &mut sheet;
    refused(points(&[], &[], 0, 1, &mut out), InvalidArgument, -1, &["0 data"]);
    refused(points(uv, values, 2, 3, &mut out), InvalidArgument, -1, &["2 data", "3"]);
    refused(points(uv, values, 16, 0, &mut out), InvalidArgument, -1, &["dim is 0"]);
    refused(points(uv, values, 16, usize::MAX / 8, &mut out), TooLarge, -1, &["values"]);
    refused(points(uv, values, usize::MAX / 8, 1, &mut out), TooLarge, -1, &["uv"]);
    refused(points(uv, values, usize::MAX / 32, 1, &mut out), OutOfMemory, -1, &["uv"]);
    refused(field(values, 15, 3, &mut out), InvalidArgument, -1, &["15", "16"]);
    refused(field(values, 0, 3, &mut out), InvalidArgument, -1, &["0", "16"]);
    refused(field(values, 16, 0, &mut out), InvalidArgument, -1, &["dim is 0"]);
    refused(field(values, 16, usize::MAX / 16, &mut out), TooLarge, -1, &["values"]);
    values[3 * 7 + 1] = f64::NAN;
    refused(points(uv, values, 16, 3, &mut out), NotFinite, 7, &["values of datum 7"]);
    refused(field(values, 16, 3, &mut out), NotFinite, 7, &["values of datum 7"]);
    values[3 * 7 + 1] = 0.0;
    uv[2 * 9] = f64::INFINITY;
    refused(points(uv, values, 16, 3, &mut out), NotFinite, 9, &["parameters of datum 9"]);
    let flat: Vec<f64> = (0..16).flat_map(|i| [f64::from(i), 0.5]).collect();
    refused(points(&flat, values, 16, 3, &mut out), Degenerate, -1, &["v = 0.5"]);
    let line: Vec<f64> = (0..16).flat_map(|i| [f64::from(i), f64::from(2 * i)]).collect();
    refused(points(&line, values, 16, 3, &mut out), Singular, -1, &["one line"]);
    assert_untouched(&out);
}

#[test]
fn fields_and_points_are_fitted() {
    let sheet = Sheet::new(9);
    let mesh = sheet.mesh_with_parameters();
    // linear, which natural splines contain
    let values: Vec<f64> = sheet.uv.chunks(2).flat_map(|uv| [2.0 * uv[0] - uv[1], 1.0 + uv[1]]).collect();
    let mut report: planish_fit_report = record();
    let (mut field, mut points) = (null_mut(), null_mut());
    let at = [0.3, 0.6];
    // SAFETY: the arrays have these lengths.
    unsafe {
        ok(planish_tensor_fit_field(mesh.0, values.as_ptr(), 81, 2, null(), &mut field, &mut report));
        let field = SurfaceHandle(field);
        assert!(report.max_error < 1e-12 && report.coefficient_count == 4, "{report:?}");
        let status = planish_tensor_fit_points(
            sheet.uv.as_ptr(),
            values.as_ptr(),
            81,
            2,
            null(),
            &mut points,
            &mut report,
        );
        ok(status);
        let points = SurfaceHandle(points);
        assert_eq!((report.stretch, report.flipped_count), (0.0, 0));
        // between points without triangles, neighbours in (u,v) serve
        assert!(report.max_interior_error < 1e-12, "{report:?}");
        assert_eq!((planish_surface_trim_count(field.0), planish_surface_trim_count(points.0)), (1, 0));
        for surface in [field.0, points.0] {
            let mut value = [0.0; 2];
            assert_eq!(planish_surface_dim(surface), 2);
            ok(planish_surface_eval(surface, at.as_ptr(), 1, null(), value.as_mut_ptr()));
            assert!(value[0].abs() < 1e-12 && (value[1] - 1.6).abs() < 1e-12, "{value:?}");
        }
    }
}

/// What a listener saw.
#[derive(Default)]
struct Heard {
    fractions: Vec<f64>,
    thread: Option<std::thread::ThreadId>,
    cancel_after: usize,
    nested: bool,
}

unsafe extern "C-unwind" fn listen(fraction: f64, error: f64, user: *mut c_void) -> i32 {
    // SAFETY: the tests hand in a Heard that nobody else uses meanwhile.
    let heard = unsafe { &mut *user.cast::<Heard>() };
    heard.fractions.push(fraction);
    heard.thread = Some(std::thread::current().id());
    assert!(error >= 0.0 || error.is_nan());
    if heard.nested {
        // SAFETY: NULL is refused.
        null_refused(unsafe { planish_mesh_copy_points(null(), null_mut(), 0) }, "mesh");
    }
    i32::from(heard.fractions.len() > heard.cancel_after)
}

unsafe extern "C-unwind" fn panics(_: f64, _: f64, _: *mut c_void) -> i32 {
    panic!("the listener fell asleep")
}

#[test]
fn progress_rises_on_the_calling_thread() {
    let mesh = Sheet::new(33).mesh();
    let mut heard = Heard { cancel_after: usize::MAX, nested: true, ..Heard::default() };
    let options = planish_tensor_options {
        tolerance: 1e-5,
        progress: Some(listen),
        user: (&raw mut heard).cast(),
        ..tensor()
    };
    let (status, surface, report) = fit(&mesh, &options);
    assert!(status as i32 >= 0 && !surface.0.is_null(), "{}", message());
    assert!(heard.fractions.len() > 3, "{:?}", heard.fractions);
    assert!(heard.fractions.windows(2).all(|pair| pair[0] <= pair[1]), "{:?}", heard.fractions);
    assert!(heard.fractions.iter().all(|f| (0.0..=1.0).contains(f)), "{:?}", heard.fractions);
    assert_eq!(heard.thread, Some(std::thread::current().id()));
    let (_, _, silent) = fit(&mesh, &planish_tensor_options { progress: None, ..options });
    assert_eq!(silent.max_error.to_bits(), report.max_error.to_bits());
}

#[test]
fn cancelling_touches_nothing() {
    let sheet = Sheet::new(33);
    for (mesh, has_parameters) in [(sheet.mesh(), 0), (sheet.mesh_with_parameters(), 1)] {
        for cancel_after in [0, 1, 2] {
            let mut heard = Heard { cancel_after, ..Heard::default() };
            let mut errors = vec![canary::<f64>(); sheet.count()];
            let (mut out, mut report): (_, planish_fit_report) = (canary(), canary());
            report.struct_size = size_of_val(&report);
            let options = planish_tensor_options {
                tolerance: 1e-5,
                progress: Some(listen),
                user: (&raw mut heard).cast(),
                out_errors: errors.as_mut_ptr(),
                ..tensor()
            };
            // SAFETY: handles and records of this test.
            let status = unsafe { planish_tensor_fit(mesh.0, &options, &mut out, &mut report) };
            refused(status, planish_status::Cancelled, -1, &["cancelled"]);
            assert_eq!(heard.fractions.len(), cancel_after + 1, "not asked again");
            report.struct_size = canary();
            assert_untouched(&out);
            assert_untouched(&report);
            errors.iter().for_each(assert_untouched);
        }
        // SAFETY: a mesh.
        assert_eq!(unsafe { planish_mesh_has_parameters(mesh.0) }, has_parameters);
    }
    let mesh = sheet.mesh();
    let mut heard = Heard::default();
    let options =
        planish_parameterize_options { progress: Some(listen), user: (&raw mut heard).cast(), ..record() };
    // SAFETY: handles and records of this test.
    let status = unsafe { planish_mesh_parameterize(mesh.0, &options, null_mut()) };
    refused(status, planish_status::Cancelled, -1, &["cancelled"]);
    // SAFETY: a mesh.
    assert_eq!(unsafe { planish_mesh_has_parameters(mesh.0) }, 0);
}

#[test]
fn a_listener_that_panics_is_an_internal_error() {
    let mesh = Sheet::new(9).mesh_with_parameters();
    let mut out = canary();
    let options = planish_tensor_options { progress: Some(panics), ..tensor() };
    // SAFETY: handles and records of this test.
    let status = unsafe { planish_tensor_fit(mesh.0, &options, &mut out, null_mut()) };
    refused(status, planish_status::Internal, -1, &["fell asleep"]);
    assert_untouched(&out);
}

/// Everything that a fit hands out, as bytes; times left out.
fn bytes_of_fit(mesh: &MeshHandle, count: usize, thread_count: u32) -> Vec<u8> {
    let (mut parameters, mut errors) = (vec![0.0; 2 * count], vec![0.0; count]);
    let options = planish_tensor_options {
        tolerance: 2e-4,
        thread_count,
        correction_sweeps: 1,
        out_parameters: parameters.as_mut_ptr(),
        out_errors: errors.as_mut_ptr(),
        ..tensor()
    };
    let (status, surface, mut report) = fit(mesh, &options);
    assert!(status as i32 >= 0, "{}", message());
    (report.seconds, report.parameterize_seconds) = (0.0, 0.0);
    let mut numbers = parameters;
    numbers.append(&mut errors);
    // SAFETY: the arrays have these lengths.
    unsafe {
        for axis in [0, 1] {
            let mut knots = vec![0.0; planish_tensor_knot_count(surface.0, axis)];
            ok(planish_tensor_copy_knots(surface.0, axis, knots.as_mut_ptr(), knots.len()));
            numbers.append(&mut knots);
        }
        let mut points = vec![0.0; 3 * planish_surface_coefficient_count(surface.0)];
        ok(planish_tensor_copy_control_points(surface.0, points.as_mut_ptr(), points.len() / 3));
        numbers.append(&mut points);
    }
    let mut bytes: Vec<u8> = numbers.into_iter().flat_map(f64::to_ne_bytes).collect();
    bytes.push(status as u8);
    // SAFETY: a record without padding.
    bytes.extend(unsafe {
        std::slice::from_raw_parts((&raw const report).cast::<u8>(), size_of_val(&report))
    });
    bytes
}

/// Data are measured in pieces of 1024 and assembled likewise: 231 * 231 nodes make 53.
#[test]
fn fits_are_byte_equal_for_any_number_of_threads() {
    let sheet = Sheet::new(231);
    let mesh = sheet.mesh();
    let one = bytes_of_fit(&mesh, sheet.count(), 1);
    for thread_count in [2, 5] {
        let others = bytes_of_fit(&mesh, sheet.count(), thread_count);
        let first = one.iter().zip(&others).position(|(a, b)| a != b);
        assert!(one.len() == others.len() && first.is_none(), "{thread_count} threads: byte {first:?}");
    }
}
