use super::*;

fn fit(
    mesh: &MeshHandle,
    options: &planish_d1rc_options,
) -> (planish_status, SurfaceHandle, planish_fit_report) {
    let mut out = null_mut();
    let mut report: planish_fit_report = record();
    // SAFETY: handles and records of this test.
    let status = unsafe { planish_d1rc_fit(mesh.0, options, &mut out, &mut report) };
    (status, SurfaceHandle(out), report)
}

#[test]
fn a_sheet_is_fitted_within_the_tolerance() {
    let sheet = Sheet::new(20);
    let mesh = sheet.mesh_with_parameters();
    let (mut uv, mut errors) = (vec![0.0; 800], vec![0.0; 400]);
    let options = planish_d1rc_options {
        tolerance: 2e-3,
        out_parameters: uv.as_mut_ptr(),
        out_errors: errors.as_mut_ptr(),
        thread_count: 1,
        ..record()
    };
    let (status, surface, report) = fit(&mesh, &options);
    ok(status);
    assert!(report.max_error <= report.tolerance);
    assert_eq!(errors.iter().copied().fold(0.0, f64::max), report.max_error);
    let mut values = vec![0.0; 1200];
    // SAFETY: 400 points.
    unsafe {
        assert_eq!(planish_surface_kind(surface.0), planish_kind::D1rc as u32);
        assert_eq!(planish_surface_coefficient_count(surface.0), report.coefficient_count);
        ok(planish_surface_eval(surface.0, uv.as_ptr(), 400, null(), values.as_mut_ptr()));
    }
    let miss = |k: usize| (0..3).map(|i| (values[3 * k + i] - sheet.points[3 * k + i]).powi(2)).sum::<f64>();
    // the same evaluation, a square root apart
    assert!((0..400).all(|k| (miss(k).sqrt() - errors[k]).abs() <= 4.0 * f64::EPSILON));
}

#[test]
fn control_meshes_are_counted_or_given() {
    let sheet = Sheet::new(20);
    let mesh = sheet.mesh_with_parameters();
    let counted = planish_d1rc_options { tolerance: 1e-9, control_count: 60, ..record() };
    let (status, _surface, report) = fit(&mesh, &counted);
    assert_eq!(status, planish_status::ToleranceNotMet);
    assert_eq!((report.coefficient_count, report.pass_count), (60, 1));
    let coarse = Sheet::new(9).mesh();
    let given = planish_d1rc_options { tolerance: 1e-9, control_mesh: coarse.0, ..record() };
    let (status, surface, report) = fit(&mesh, &given);
    assert_eq!(status, planish_status::ToleranceNotMet);
    assert_eq!(report.coefficient_count, 81);
    // SAFETY: a surface.
    assert_eq!(unsafe { planish_d1rc_degree(surface.0) }, 3);
}

#[test]
fn refusals_leave_outputs_alone() {
    use planish_status::*;
    let sheet = Sheet::new(9);
    let mesh = sheet.mesh_with_parameters();
    let mut out = canary();
    let mut report: planish_fit_report = canary();
    report.struct_size = size_of_val(&report);
    let before = report;
    let base = || record::<planish_d1rc_options>();
    let weights: Vec<f64> = (0..81).map(|k| f64::from(k != 5)).collect();
    let edges: [u32; 4] = [10, 11, 10, 30];
    let cases = [
        (planish_d1rc_options { tolerance: 0.0, ..base() }, InvalidArgument, -1, "tolerance is 0"),
        (planish_d1rc_options { smoothing: -1.0, ..base() }, InvalidArgument, -1, "smoothing is -1"),
        (planish_d1rc_options { control_count: 2, ..base() }, InvalidArgument, -1, "control_count is 2"),
        (
            planish_d1rc_options { max_control_count: 0, ..base() },
            InvalidArgument,
            -1,
            "max_control_count is 0",
        ),
        (planish_d1rc_options { sharp_angle: 4.0, ..base() }, InvalidArgument, -1, "sharp_angle is 4"),
        (planish_d1rc_options { tolerance_scale: 2, ..base() }, InvalidArgument, -1, "tolerance_scale is 2"),
        (planish_d1rc_options { degree: 4, ..base() }, InvalidArgument, -1, "degree is 4"),
        (planish_d1rc_options { mode: 2, ..base() }, InvalidArgument, -1, "mode is 2"),
        (planish_d1rc_options { thread_count: 1025, ..base() }, InvalidArgument, -1, "thread_count is 1025"),
        (planish_d1rc_options { reserved: 1, ..base() }, Version, -1, "reserved"),
        (planish_d1rc_options { corner_count: 1, ..base() }, InvalidArgument, -1, "corners must be NULL"),
        (planish_d1rc_options { weights: weights.as_ptr(), ..base() }, InvalidArgument, 5, "weight 5"),
        (planish_d1rc_options { sharp_edge_count: 1, ..base() }, NullPointer, -1, "sharp_edges is NULL"),
        (
            planish_d1rc_options { sharp_edges: edges.as_ptr(), sharp_edge_count: 2, ..base() },
            Topology,
            1,
            "no edge of the mesh",
        ),
    ];
    for (options, status, index, word) in cases {
        // SAFETY: handles and records of this test.
        let found = unsafe { planish_d1rc_fit(mesh.0, &options, &mut out, &mut report) };
        refused(found, status, index, &[word]);
    }
    // SAFETY: NULL is refused.
    unsafe {
        null_refused(planish_d1rc_fit(null(), null(), &mut out, &mut report), "mesh");
        null_refused(planish_d1rc_fit(mesh.0, null(), null_mut(), &mut report), "out_surface");
    }
    assert_untouched(&out);
    assert_eq!(report.seconds.to_bits(), before.seconds.to_bits());
}
