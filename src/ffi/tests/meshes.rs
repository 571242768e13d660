use super::*;

/// Makes a mesh that is refused.
#[track_caller]
fn bad_mesh(points: &[f64], triangles: &[u32], expected: planish_status, index: i64, words: &[&str]) {
    let mut out = canary();
    let options = planish_mesh_options { repair: planish_mesh_repair::None as u32, ..record() };
    // SAFETY: the arrays have these lengths.
    let status = unsafe {
        planish_mesh_new(
            points.as_ptr(),
            points.len() / 3,
            triangles.as_ptr(),
            triangles.len() / 3,
            &options,
            &mut out,
        )
    };
    refused(status, expected, index, words);
    assert_untouched(&out);
}

#[test]
fn bad_arrays_are_refused_by_name() {
    use planish_status::*;
    let mut infinite = POINTS;
    infinite[10] = f64::NEG_INFINITY;
    bad_mesh(&[], &[0, 1, 2], InvalidArgument, -1, &["no points"]);
    bad_mesh(&POINTS, &[], InvalidArgument, -1, &["no triangles"]);
    bad_mesh(&infinite, &[0, 1, 3], NotFinite, 3, &["node 3", "not finite"]);
    bad_mesh(&POINTS, &[0, 1, 2, 0, 2, 5], Index, 1, &["triangle 1", "node 5", "0 to 4"]);
    bad_mesh(&POINTS, &[0, 1, 2, 3, 2, 3], Degenerate, 1, &["triangle 1", "node 3 twice"]);
    bad_mesh(&POINTS, &[0, 1, 2, 2, 1, 0], Topology, 1, &["triangle 1", "triangle 0"]);
    let three = [0, 1, 2, 1, 0, 3, 0, 1, 4];
    bad_mesh(&POINTS, &three, Topology, 0, &["nodes 0 and 1", "3 triangles"]);
    bad_mesh(&POINTS, &[0, 1, 2, 0, 3, 2, 0, 1, 3], Topology, 2, &["triangles 0 and 2", "node 0 to node 1"]);
}

#[test]
fn null_arrays_are_refused_by_name() {
    let sheet = Sheet::new(3);
    let mut out = canary();
    let (points, triangles) = (sheet.points.as_ptr(), sheet.triangles.as_ptr());
    // SAFETY: NULL is refused, and empty arrays are not read.
    unsafe {
        null_refused(planish_mesh_new(null(), 9, triangles, 8, null(), &mut out), "points");
        null_refused(planish_mesh_new(points, 9, null(), 8, null(), &mut out), "triangles");
        let status = planish_mesh_new(null(), 0, null(), 0, null(), &mut out);
        refused(status, planish_status::InvalidArgument, -1, &["no points"]);
        null_refused(planish_mesh_new(points, 9, triangles, 8, null(), null_mut()), "out_mesh");
        null_refused(planish_mesh_read(null(), null(), &mut out), "path");
        null_refused(planish_mesh_read(c"a.off".as_ptr(), null(), null_mut()), "out_mesh");
    }
    assert_untouched(&out);
}

#[test]
fn misaligned_arrays_are_refused() {
    let sheet = Sheet::new(3);
    let mut out = canary();
    let shifted = sheet.points.as_ptr().cast::<u8>().wrapping_add(4).cast::<f64>();
    // SAFETY: refused before an element is read.
    let status = unsafe { planish_mesh_new(shifted, 8, sheet.triangles.as_ptr(), 8, null(), &mut out) };
    refused(status, planish_status::InvalidArgument, -1, &["points is not aligned"]);
    assert_untouched(&out);
}

#[test]
fn sizes_that_overflow_are_refused() {
    let sheet = Sheet::new(3);
    let mut out = canary();
    for count in [usize::MAX, usize::MAX / 2, usize::MAX / 24, isize::MAX as usize / 24 + 1] {
        // SAFETY: refused before an element is read.
        let status = unsafe {
            planish_mesh_new(sheet.points.as_ptr(), count, sheet.triangles.as_ptr(), 8, null(), &mut out)
        };
        refused(status, planish_status::TooLarge, -1, &["points", "more than memory can address"]);
    }
    let options = planish_mesh_options { triangle_stride: usize::MAX, ..record() };
    refused(sheet.mesh_with(&options, &mut out), planish_status::TooLarge, -1, &["triangles"]);
    assert_untouched(&out);
}

#[test]
fn memory_that_cannot_be_had_is_refused() {
    let sheet = Sheet::new(3);
    let mut out = canary();
    let count = isize::MAX as usize / 24; // no machine has so much
    // SAFETY: refused before an element is read.
    let status = unsafe {
        planish_mesh_new(sheet.points.as_ptr(), count, sheet.triangles.as_ptr(), 8, null(), &mut out)
    };
    refused(status, planish_status::OutOfMemory, -1, &["points", &count.to_string()]);
    assert_untouched(&out);
}

#[test]
fn bad_options_are_refused() {
    use planish_status::InvalidArgument;
    let sheet = Sheet::new(3);
    let mut out = canary();
    let cases = [
        (planish_mesh_options { point_stride: 2, ..record() }, ["point_stride is 2", "at least 3"]),
        (planish_mesh_options { triangle_stride: 1, ..record() }, ["triangle_stride is 1", "at least 3"]),
        (planish_mesh_options { orient: 2, ..record() }, ["orient is 2", "choice is 1"]),
        (planish_mesh_options { weld_distance: -1.0, ..record() }, ["weld distance", "-1"]),
        (planish_mesh_options { weld_distance: f64::NAN, ..record() }, ["weld distance", "NaN"]),
    ];
    for (options, words) in cases {
        refused(sheet.mesh_with(&options, &mut out), InvalidArgument, -1, &words);
    }
    let mut node = 0;
    let options = planish_mesh_options { out_node_map: &mut node, ..record() };
    // SAFETY: refused before the file is looked for.
    let status = unsafe { planish_mesh_read(c"a.off".as_ptr(), &options, &mut out) };
    refused(status, InvalidArgument, -1, &["out_node_map must be NULL"]);
    let mut repairs = planish_mesh_repairs { struct_size: 0, ..record() };
    let options = planish_mesh_options { out_repairs: &mut repairs, ..record() };
    refused(sheet.mesh_with(&options, &mut out), InvalidArgument, -1, &["planish_mesh_repairs", "is 0"]);
    assert_untouched(&out);
}

#[test]
fn strides_and_index_base_reach_the_same_mesh() {
    let sheet = Sheet::new(4);
    let (plain, mut out) = (sheet.mesh(), null_mut());
    let points: Vec<f64> = sheet.points.chunks(3).flat_map(|p| [p[0], p[1], p[2], f64::NAN, 7.0]).collect();
    let triangles: Vec<u32> =
        sheet.triangles.chunks(3).flat_map(|t| [t[0] + 1, t[1] + 1, t[2] + 1, 999]).collect();
    let options = planish_mesh_options { point_stride: 5, triangle_stride: 4, index_base: 1, ..record() };
    // SAFETY: the last row need not be whole.
    ok(unsafe {
        planish_mesh_new(points[..78].as_ptr(), 16, triangles[..71].as_ptr(), 18, &options, &mut out)
    });
    let strided = MeshHandle(out);
    // SAFETY: both are meshes.
    assert!(unsafe { (*plain.0).0 == (*strided.0).0 });
}

#[test]
fn repairs_are_told() {
    let mut sheet = Sheet::new(3);
    sheet.triangles.swap(0, 1);
    let mut out = canary();
    let none = planish_mesh_options { repair: planish_mesh_repair::None as u32, ..record() };
    refused(
        sheet.mesh_with(&none, &mut out),
        planish_status::Topology,
        1,
        &["same direction", "'orientation'"],
    );
    assert_untouched(&out);

    // one more node on the place of node 8, used by the last triangle
    let last = sheet.points[24..].to_vec();
    sheet.points.extend(last);
    let corner = sheet.triangles.iter().rposition(|&node| node == 8).unwrap();
    sheet.triangles[corner] = 9;
    let mut repairs: planish_mesh_repairs = canary();
    repairs.struct_size = size_of_val(&repairs);
    let mut node_map = [canary::<u32>(); 10];
    let options = planish_mesh_options {
        orient: 1,
        weld_distance: 1e-9,
        out_repairs: &mut repairs,
        out_node_map: node_map.as_mut_ptr(),
        ..record()
    };
    assert_eq!(sheet.mesh_with(&options, &mut out), planish_status::InputRepaired);
    let mesh = MeshHandle(out);
    // SAFETY: a mesh.
    assert_eq!(unsafe { planish_mesh_point_count(mesh.0) }, 9);
    assert_eq!((repairs.welded_node_count, repairs.flipped_triangle_count), (1, 1));
    assert_eq!((repairs.dropped_triangle_count, repairs.dropped_parameters, repairs.missing_end), (0, 0, 0));
    assert_eq!(node_map, [0, 1, 2, 3, 4, 5, 6, 7, 8, 8]);

    // nothing to repair: the map is the identity
    let sheet = Sheet::new(3);
    ok(sheet.mesh_with(&planish_mesh_options { weld_distance: 1e-9, ..options }, &mut out));
    let _mesh = MeshHandle(out);
    assert_eq!(node_map[..9], [0, 1, 2, 3, 4, 5, 6, 7, 8]);
    assert_eq!((repairs.welded_node_count, repairs.flipped_triangle_count), (0, 0));
}

#[test]
fn repair_is_a_choice() {
    let mut sheet = Sheet::new(3);
    sheet.points.extend([f64::NAN; 3]);
    let make = |repair, out: &mut _| sheet.mesh_with(&planish_mesh_options { repair, ..record() }, out);
    let mut out = canary();
    let none = make(planish_mesh_repair::None as u32, &mut out);
    refused(none, planish_status::Topology, 9, &["node 9", "'unused'"]);
    refused(make(256, &mut out), planish_status::InvalidArgument, -1, &["repair is 256"]);
    assert_untouched(&out);
    for repair in [planish_mesh_repair::Safe, planish_mesh_repair::UnusedNodes, planish_mesh_repair::All] {
        let mut out = null_mut();
        assert_eq!(make(repair as u32, &mut out), planish_status::InputRepaired);
        let _mesh = MeshHandle(out);
    }
}
