use super::*;

#[test]
fn parameterizing_keeps_what_it_says() {
    let sheet = Sheet::new(9);
    let mesh = sheet.mesh();
    let mut report: planish_parameterize_report = canary();
    report.struct_size = size_of_val(&report);
    // SAFETY: handles and records of this test.
    ok(unsafe { planish_mesh_parameterize(mesh.0, null(), &mut report) });
    assert!(report.stretch >= 1.0 && report.stretch < 1.2, "{report:?}");
    assert_eq!((report.flipped_count, report.degenerate_count, report.remarks), (0, 0, 0));
    assert!((1..=6).contains(&report.border) && report.border_slid == 0);
    // SAFETY: a mesh.
    assert_eq!(unsafe { planish_mesh_has_parameters(mesh.0) }, 1);

    let corners = planish_parameterize_options {
        border: planish_border::Corners as u32,
        corners: [0, 72, 80, 8],
        stretch_steps: 0,
        bulge: 0.0,
        thread_count: 1,
        ..record()
    };
    let mut uv = [0.0; 162];
    // SAFETY: handles and records of this test.
    unsafe {
        ok(planish_mesh_parameterize(mesh.0, &corners, &mut report));
        ok(planish_mesh_copy_parameters(mesh.0, uv.as_mut_ptr(), 81));
    }
    assert_eq!((report.border, report.step_count), (planish_border::Corners as u32, 0));
    assert_eq!(
        [uv[0], uv[1], uv[144], uv[145], uv[160], uv[161], uv[16], uv[17]],
        [0., 0., 1., 0., 1., 1., 0., 1.]
    );
}

#[test]
fn maps_that_cannot_be_made_leave_the_mesh_alone() {
    use planish_status::*;
    let sheet = Sheet::new(4);
    let mesh = sheet.mesh();
    let base = || record::<planish_parameterize_options>();
    let weights = [1., 1., 0., 1., 1., 1., 1., 1., 1., 1., 1., 1., 1., 1., 1., 1.];
    let cases: [(planish_parameterize_options, planish_status, i64, &str); 9] = [
        (planish_parameterize_options { method: 2, ..base() }, InvalidArgument, -1, "method is 2"),
        (planish_parameterize_options { border: 7, ..base() }, InvalidArgument, -1, "border is 7"),
        (planish_parameterize_options { fill_holes: 2, ..base() }, InvalidArgument, -1, "fill_holes is 2"),
        (planish_parameterize_options { bulge: 0.6, ..base() }, InvalidArgument, -1, "bulge is 0.6"),
        (planish_parameterize_options { bulge: f64::NAN, ..base() }, InvalidArgument, -1, "bulge is NaN"),
        (
            planish_parameterize_options { boundary_slide: -0.5, ..base() },
            InvalidArgument,
            -1,
            "boundary_slide is -0.5",
        ),
        (planish_parameterize_options { border: 5, ..base() }, InvalidArgument, -1, "no given parameters"),
        (
            planish_parameterize_options { border: 4, corners: [0, 5, 15, 3], ..base() },
            InvalidArgument,
            5,
            "corner node 5",
        ),
        (
            planish_parameterize_options { node_weights: weights.as_ptr(), ..base() },
            InvalidArgument,
            2,
            "node weight 2",
        ),
    ];
    let mut report: planish_parameterize_report = canary();
    report.struct_size = size_of_val(&report);
    let untouched = report;
    for (options, status, index, word) in cases {
        // SAFETY: handles and records of this test.
        let found = unsafe { planish_mesh_parameterize(mesh.0, &options, &mut report) };
        refused(found, status, index, &[word]);
    }
    let many = planish_parameterize_options { thread_count: 1025, ..base() };
    // SAFETY: handles and records of this test.
    let found = unsafe { planish_mesh_parameterize(mesh.0, &many, &mut report) };
    refused(found, InvalidArgument, -1, &["thread_count is 1025", "1024"]);
    assert_eq!(report.stretch.to_bits(), untouched.stretch.to_bits());
    // SAFETY: a mesh.
    assert_eq!(unsafe { planish_mesh_has_parameters(mesh.0) }, 0);
}

#[test]
fn closed_and_degenerate_meshes_cannot_be_parameterized() {
    use planish_status::*;
    let parameterize = |points: &[f64], triangles: &[u32]| {
        let sheet = Sheet { points: points.to_vec(), triangles: triangles.to_vec(), uv: vec![] };
        let mesh = sheet.mesh();
        // SAFETY: a mesh.
        unsafe { planish_mesh_parameterize(mesh.0, null(), null_mut()) }
    };
    let tetrahedron = [0, 2, 1, 0, 1, 4, 1, 2, 4, 2, 0, 4];
    refused(parameterize(&POINTS, &tetrahedron), Topology, -1, &["closed"]);
    let two: Vec<f64> = POINTS.iter().chain(&[5., 5., 5.]).copied().collect();
    refused(parameterize(&two, &[0, 1, 2, 3, 4, 5]), Topology, -1, &["2 components"]);
    ok(parameterize(&POINTS, &[0, 1, 2, 0, 2, 3])); // nodes without triangles are passed over
    let line: Vec<f64> = (0..4).flat_map(|i| [f64::from(i), 0., 0.]).collect();
    refused(parameterize(&line, &[0, 1, 2, 0, 2, 3]), Degenerate, -1, &["2 triangles", "zero area"]);
}

#[test]
fn folds_are_returned() {
    // two neighbours on the border exchange their parameters, and the border keeps them
    let mut sheet = Sheet::new(5);
    sheet.uv.swap(3, 5);
    let mesh = sheet.mesh_with_parameters();
    let kept =
        planish_parameterize_options { border: planish_border::Kept as u32, stretch_steps: 0, ..record() };
    let mut report: planish_parameterize_report = record();
    // SAFETY: handles and records of this test.
    let status = unsafe { planish_mesh_parameterize(mesh.0, &kept, &mut report) };
    assert_eq!(status, planish_status::FoldedParameters, "{report:?}");
    assert!(report.flipped_count > 0);
    assert_eq!(report.border, planish_border::Kept as u32);
    assert_ne!(report.remarks & planish_remark::FoldedParameters as u64, 0);
}
