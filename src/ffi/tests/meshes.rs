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

/// Five points in the plane.
const POINTS: [f64; 15] = [0., 0., 0., 1., 0., 0., 1., 1., 0., 0., 1., 0., 2., 0., 1.];

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
fn files_are_read_or_refused() {
    let directory = std::env::temp_dir().join(format!("planish-ffi-{}", std::process::id()));
    std::fs::create_dir_all(&directory).unwrap();
    let file = |name: &str, text: &str| {
        let path = directory.join(name);
        std::fs::write(&path, text).unwrap();
        c(path.to_str().unwrap())
    };
    let mut out = canary();
    // SAFETY: terminated texts.
    let mut read = |path: &CString| unsafe { planish_mesh_read(path.as_ptr(), null(), &mut out) };
    let missing = c("/nowhere/part.stl");
    refused(read(&missing), planish_status::File, -1, &["/nowhere/part.stl"]);
    let cut = file("cut.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n");
    refused(read(&cut), planish_status::Format, 2, &["line 3"]);
    let unknown = file("unknown.txt", "hello");
    refused(read(&unknown), planish_status::Format, -1, &["unknown.txt", "none of OFF"]);
    let wrong = file("wrong.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n");
    assert!((read(&wrong) as i32) < 0);
    assert!(message().contains('7'), "{}", message());
    let not_utf8 = CString::new([b'a', 0xff]).unwrap();
    assert!((read(&not_utf8) as i32) < 0);
    assert!(cfg!(not(unix)) || message().contains("cannot read"), "{}", message());
    assert_untouched(&out);

    let good = file("good.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    let mut out = null_mut();
    // SAFETY: a terminated text.
    ok(unsafe { planish_mesh_read(good.as_ptr(), null(), &mut out) });
    let mesh = MeshHandle(out);
    // SAFETY: a mesh.
    assert_eq!(unsafe { planish_mesh_triangle_count(mesh.0) }, 1);
    std::fs::remove_dir_all(directory).unwrap();
}

#[test]
fn counts_are_those_of_the_mesh() {
    let sheet = Sheet::new(4);
    let mesh = sheet.mesh();
    // SAFETY: a mesh, or NULL.
    unsafe {
        assert_eq!(planish_mesh_point_count(mesh.0), 16);
        assert_eq!(planish_mesh_triangle_count(mesh.0), 18);
        assert_eq!(planish_mesh_edge_count(mesh.0), 33);
        assert_eq!(planish_mesh_component_count(mesh.0), 1);
        assert_eq!(planish_mesh_genus(mesh.0), 0);
        assert_eq!(planish_mesh_euler_characteristic(mesh.0), 1);
        assert_eq!(planish_mesh_loop_count(mesh.0), 1);
        assert_eq!(planish_mesh_loop_point_count(mesh.0, 0), 12);
        assert_eq!(planish_mesh_loop_point_count(mesh.0, 1), 0);
        assert_eq!(planish_mesh_field_count(mesh.0), 0);
        assert_eq!(planish_mesh_has_parameters(mesh.0), 0);
        for query in [
            planish_mesh_point_count,
            planish_mesh_triangle_count,
            planish_mesh_edge_count,
            planish_mesh_component_count,
            planish_mesh_genus,
            planish_mesh_loop_count,
            planish_mesh_field_count,
        ] {
            assert_eq!(query(null()), 0);
        }
        assert_eq!(planish_mesh_euler_characteristic(null()), 0);
        assert_eq!(planish_mesh_loop_point_count(null(), 0), 0);
        assert_eq!(planish_mesh_has_parameters(null()), 0);
        assert_eq!(planish_mesh_field_name(null(), 0, null_mut(), 0), 0);
        assert_eq!(message(), "mesh is NULL");
        planish_mesh_free(null_mut());
    }
}

#[test]
fn arrays_come_back_as_they_went_in() {
    let sheet = Sheet::new(4);
    let mesh = sheet.mesh_with_parameters();
    let (mut points, mut triangles, mut uv) = ([0.0; 48], [0; 54], [0.0; 32]);
    let mut ring = [0; 12];
    // SAFETY: the arrays have these lengths.
    unsafe {
        ok(planish_mesh_copy_points(mesh.0, points.as_mut_ptr(), 16));
        ok(planish_mesh_copy_triangles(mesh.0, triangles.as_mut_ptr(), 18));
        ok(planish_mesh_copy_parameters(mesh.0, uv.as_mut_ptr(), 16));
        ok(planish_mesh_copy_loop(mesh.0, 0, ring.as_mut_ptr(), 12));
        assert_eq!(planish_mesh_has_parameters(mesh.0), 1);
    }
    assert_eq!(points[..], sheet.points);
    assert_eq!(triangles[..], sheet.triangles);
    assert_eq!(uv[..], sheet.uv);
    assert_eq!(ring, [0, 4, 8, 12, 13, 14, 15, 11, 7, 3, 2, 1]);
    let mut out = null_mut();
    // SAFETY: a mesh.
    ok(unsafe { planish_mesh_clone(mesh.0, &mut out) });
    let clone = MeshHandle(out);
    // SAFETY: both are meshes.
    assert!(unsafe { (*mesh.0).0 == (*clone.0).0 });
}

#[test]
fn short_arrays_and_null_are_refused() {
    let sheet = Sheet::new(4);
    let mesh = sheet.mesh_with_parameters();
    let values = [1.5; 16];
    let (mut numbers, mut nodes): ([f64; 64], [u32; 64]) = (canary(), canary());
    let (f, n, name) = (numbers.as_mut_ptr(), nodes.as_mut_ptr(), c"t".as_ptr());
    let mut out = canary();
    let short = |status, words: &[&str]| refused(status, planish_status::BufferTooSmall, -1, words);
    // SAFETY: the arrays are at least as long as said.
    unsafe {
        ok(planish_mesh_set_field(mesh.0, name, values.as_ptr(), 16));
        let mesh = mesh.0;
        short(planish_mesh_copy_points(mesh, f, 15), &["out_points has room for 15", "16"]);
        short(planish_mesh_copy_points(mesh, null_mut(), 0), &["room for 0", "16"]);
        short(planish_mesh_copy_triangles(mesh, n, 17), &["out_triangles", "17", "18"]);
        short(planish_mesh_copy_parameters(mesh, f, 0), &["out_uv", "room for 0", "16"]);
        short(planish_mesh_copy_loop(mesh, 0, n, 11), &["out_nodes", "11", "12"]);
        short(planish_mesh_copy_field(mesh, name, f, 15), &["out_values", "15", "16"]);
        short(planish_mesh_split_components(mesh, &mut out, 0), &["out_meshes", "0", "1"]);
        null_refused(planish_mesh_copy_points(mesh, null_mut(), 16), "out_points");
        null_refused(planish_mesh_copy_triangles(mesh, null_mut(), 18), "out_triangles");
        null_refused(planish_mesh_copy_parameters(mesh, null_mut(), 16), "out_uv");
        null_refused(planish_mesh_copy_loop(mesh, 0, null_mut(), 12), "out_nodes");
        null_refused(planish_mesh_copy_field(mesh, null(), f, 16), "name");
        null_refused(planish_mesh_copy_field(mesh, name, null_mut(), 16), "out_values");
        null_refused(planish_mesh_split_components(mesh, null_mut(), 1), "out_meshes");
        null_refused(planish_mesh_clone(mesh, null_mut()), "out_mesh");
        null_refused(planish_mesh_set_field(mesh, null(), values.as_ptr(), 16), "name");
        null_refused(planish_mesh_set_field(mesh, name, null(), 16), "values");
        null_refused(planish_mesh_set_parameters(mesh, null(), 16), "uv");
        null_refused(planish_mesh_remove_triangles(mesh, null(), 1, &mut out), "triangles");
        null_refused(planish_mesh_remove_triangles(mesh, n, 0, null_mut()), "out_mesh");
        null_refused(planish_mesh_cut_along(mesh, null(), 2, &mut out), "nodes");
        null_refused(planish_mesh_cut_along(mesh, n, 0, null_mut()), "out_mesh");
        null_refused(planish_mesh_shortest_path(mesh, 0, 1, n, 2, null_mut()), "out_count");
        let mut count: usize = canary();

        null_refused(planish_mesh_copy_points(null(), f, 16), "mesh");
        null_refused(planish_mesh_copy_triangles(null(), n, 18), "mesh");
        null_refused(planish_mesh_copy_parameters(null(), f, 16), "mesh");
        null_refused(planish_mesh_copy_loop(null(), 0, n, 12), "mesh");
        null_refused(planish_mesh_copy_field(null(), name, f, 16), "mesh");
        null_refused(planish_mesh_split_components(null(), &mut out, 1), "mesh");
        null_refused(planish_mesh_clone(null(), &mut out), "mesh");
        null_refused(planish_mesh_set_field(null_mut(), name, values.as_ptr(), 16), "mesh");
        null_refused(planish_mesh_set_parameters(null_mut(), values.as_ptr(), 8), "mesh");
        null_refused(planish_mesh_remove_triangles(null(), n, 0, &mut out), "mesh");
        null_refused(planish_mesh_cut_along(null(), n, 0, &mut out), "mesh");
        null_refused(planish_mesh_shortest_path(null(), 0, 1, n, 2, &mut count), "mesh");
        null_refused(planish_mesh_parameterize(null_mut(), null(), null_mut()), "mesh");
    }
    assert_untouched(&out);
    assert_untouched(&numbers);
    assert_untouched(&nodes);
}

#[test]
fn fields_are_kept_by_name() {
    let sheet = Sheet::new(3);
    let mesh = sheet.mesh();
    let values = [0., 1., 2., 3., f64::NAN, 5., 6., 7., 8.];
    let mut copied: [f64; 9] = canary();
    // SAFETY: the arrays have these lengths.
    unsafe {
        let set =
            |name: &CString, count| planish_mesh_set_field(mesh.0, name.as_ptr(), values.as_ptr(), count);
        let words = ["8 values", "'heat'", "9 nodes"];
        refused(set(&c("heat"), 8), planish_status::InvalidArgument, -1, &words);
        refused(set(&c("heat"), 0), planish_status::InvalidArgument, -1, &["0 values"]);
        let copy =
            |out: &mut [f64; 9]| planish_mesh_copy_field(mesh.0, c"heat".as_ptr(), out.as_mut_ptr(), 9);
        refused(copy(&mut copied), planish_status::InvalidArgument, -1, &["no field 'heat'"]);
        assert_untouched(&copied);
        ok(set(&c("heat"), 9));
        ok(copy(&mut copied));
        assert_eq!(copied.map(f64::to_bits), values.map(f64::to_bits));
        assert_eq!(planish_mesh_field_count(mesh.0), 1);
        let mut name = [CANARY; 8];
        assert_eq!(planish_mesh_field_name(mesh.0, 0, null_mut(), 0), 4);
        assert_eq!(planish_mesh_field_name(mesh.0, 0, name.as_mut_ptr().cast(), 8), 4);
        assert_eq!(name, *b"heat\0\xa5\xa5\xa5");
        assert_eq!(planish_mesh_field_name(mesh.0, 1, name.as_mut_ptr().cast(), 8), 0);
        assert_eq!(name, *b"heat\0\xa5\xa5\xa5");
        assert_eq!(message(), "field 1 does not exist, there are 1");
        assert_eq!(planish_error_index(), 1);
    }
}

#[test]
fn parameters_are_checked() {
    use planish_status::*;
    let mut sheet = Sheet::new(3);
    let mesh = sheet.mesh();
    let mut copied: [f64; 18] = canary();
    // SAFETY: the arrays have these lengths.
    unsafe {
        let status = planish_mesh_copy_parameters(mesh.0, copied.as_mut_ptr(), 9);
        refused(status, InvalidArgument, -1, &["no parameters"]);
        assert_untouched(&copied);
        let status = planish_mesh_set_parameters(mesh.0, sheet.uv.as_ptr(), 8);
        refused(status, InvalidArgument, -1, &["8 parameter pairs", "9 nodes"]);
        let status = planish_mesh_set_parameters(mesh.0, null(), 0);
        refused(status, InvalidArgument, -1, &["0 parameter pairs"]);
        sheet.uv[9] = f64::NAN;
        refused(planish_mesh_set_parameters(mesh.0, sheet.uv.as_ptr(), 9), NotFinite, 4, &["node 4"]);
        assert_eq!(planish_mesh_has_parameters(mesh.0), 0);
    }
}

#[test]
fn pieces_carry_fields_and_parameters() {
    let sheet = Sheet::new(4);
    let mesh = sheet.mesh_with_parameters();
    let numbers: [f64; 16] = std::array::from_fn(|i| i as f64);
    // the two triangles of the last cell, whose corner node 15 they alone have
    let (mut out, mut left) = (null_mut(), [0.0; 15]);
    // SAFETY: the arrays have these lengths.
    unsafe {
        ok(planish_mesh_set_field(mesh.0, c"node".as_ptr(), numbers.as_ptr(), 16));
        ok(planish_mesh_remove_triangles(mesh.0, [16, 17].as_ptr(), 2, &mut out));
        let piece = MeshHandle(out);
        assert_eq!(planish_mesh_point_count(piece.0), 15);
        assert_eq!(planish_mesh_has_parameters(piece.0), 1);
        ok(planish_mesh_copy_field(piece.0, c"node".as_ptr(), left.as_mut_ptr(), 15));
        assert_eq!(left, numbers[..15]);

        ok(planish_mesh_remove_triangles(mesh.0, null(), 0, &mut out));
        let whole = MeshHandle(out);
        assert!((*whole.0).0 == (*mesh.0).0);
        let mut out = canary();
        let status = planish_mesh_remove_triangles(mesh.0, [2, 18].as_ptr(), 2, &mut out);
        refused(status, planish_status::Index, 18, &["no triangle 18", "has 18"]);
        let all: Vec<u32> = (0..18).collect();
        let status = planish_mesh_remove_triangles(mesh.0, all.as_ptr(), 18, &mut out);
        refused(status, planish_status::InvalidArgument, -1, &["no triangles"]);
        assert_untouched(&out);
    }
}

#[test]
fn paths_are_found_and_cut() {
    let sheet = Sheet::new(4);
    let mesh = sheet.mesh();
    let (mut path, mut count, mut out) = ([0; 4], 0, null_mut());
    // SAFETY: the arrays have these lengths.
    unsafe {
        let find = |from, to, path: *mut u32, room, count| {
            planish_mesh_shortest_path(mesh.0, from, to, path, room, count)
        };
        ok(find(1, 13, null_mut(), 0, &mut count));
        assert_eq!(count, 4);
        ok(find(1, 13, path.as_mut_ptr(), 4, &mut count));
        assert_eq!((path, count), ([1, 5, 9, 13], 4));
        ok(planish_mesh_cut_along(mesh.0, path.as_ptr(), 4, &mut out));
        let cut = MeshHandle(out);
        assert_eq!(planish_mesh_component_count(cut.0), 2);
        let mut parts = [null_mut(); 3];
        ok(planish_mesh_split_components(cut.0, parts.as_mut_ptr(), 3));
        assert!(parts[2].is_null());
        let parts = [MeshHandle(parts[0]), MeshHandle(parts[1])];
        assert_eq!(parts.each_ref().map(|part| planish_mesh_triangle_count(part.0)), [6, 12]);

        let (mut out, mut count) = (canary(), canary());
        let mut nodes: [u32; 4] = canary();
        let status = find(1, 13, nodes.as_mut_ptr(), 3, &mut count);
        refused(status, planish_status::BufferTooSmall, -1, &["out_nodes has room for 3, 4"]);
        let status = find(16, 13, nodes.as_mut_ptr(), 4, &mut count);
        refused(status, planish_status::Index, 16, &["no node 16"]);
        let mut out_of_parts = canary();
        let status = planish_mesh_split_components(cut.0, &mut out_of_parts, 1);
        refused(status, planish_status::BufferTooSmall, -1, &["out_meshes", "1", "2"]);
        assert_untouched(&out_of_parts);
        // the other part of the cut mesh
        let status = planish_mesh_shortest_path(cut.0, 0, 15, nodes.as_mut_ptr(), 4, &mut count);
        refused(status, planish_status::Topology, 0, &["nodes 0 and 15"]);
        assert_untouched(&nodes);
        assert_untouched(&count);

        let cut = |nodes: &[u32], out| planish_mesh_cut_along(mesh.0, nodes.as_ptr(), nodes.len(), out);
        refused(cut(&[], &mut out), planish_status::InvalidArgument, -1, &["two nodes", "has 0"]);
        refused(cut(&[5, 99], &mut out), planish_status::Index, 99, &["no node 99"]);
        refused(cut(&[5, 15], &mut out), planish_status::Topology, 5, &["nodes 5 and 15"]);
        refused(cut(&[5, 9], &mut out), planish_status::Topology, 5, &["opens nothing"]);
        refused(
            planish_mesh_copy_loop(mesh.0, 1, nodes.as_mut_ptr(), 4),
            planish_status::Index,
            1,
            &["loop 1", "there are 1"],
        );
        assert_untouched(&out);
    }
}

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

#[test]
fn meshes_come_from_memory_and_go_to_files() {
    let text = b"OFF 4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";
    let mut out = null_mut();
    // SAFETY: the bytes are there.
    ok(unsafe { planish_mesh_read_buffer(text.as_ptr().cast(), text.len(), null(), &mut out) });
    let mesh = MeshHandle(out);
    let (mut nodes, mut faces) = ([canary::<u32>(); 4], [canary::<u32>(); 2]);
    // SAFETY: the arrays have these lengths.
    unsafe {
        ok(planish_mesh_copy_node_map(mesh.0, nodes.as_mut_ptr(), 4));
        ok(planish_mesh_copy_triangle_map(mesh.0, faces.as_mut_ptr(), 2));
    }
    assert_eq!((nodes, faces), ([0, 1, 2, 3], [0, 0]));
    let folder = tempfile::tempdir().unwrap();
    let path = c(folder.path().join("a.ply").to_str().unwrap());
    // SAFETY: a mesh and a terminated text.
    unsafe {
        ok(planish_mesh_write(mesh.0, path.as_ptr(), null()));
        ok(planish_mesh_read(path.as_ptr(), null(), &mut out));
    }
    let read = MeshHandle(out);
    // SAFETY: both are meshes.
    unsafe {
        assert_eq!((*read.0).0.triangles(), (*mesh.0).0.triangles());
        assert_eq!((*read.0).0.points(), (*mesh.0).0.points());
    }
    let mut out = canary();
    // SAFETY: NULL and wrong arguments are refused.
    unsafe {
        null_refused(planish_mesh_read_buffer(null(), 3, null(), &mut out), "buffer");
        null_refused(planish_mesh_read_buffer(text.as_ptr().cast(), 3, null(), null_mut()), "out_mesh");
        null_refused(planish_mesh_write(null(), path.as_ptr(), null()), "mesh");
        null_refused(planish_mesh_write(mesh.0, null(), null()), "path");
        null_refused(planish_mesh_copy_node_map(null(), nodes.as_mut_ptr(), 4), "mesh");
        null_refused(planish_mesh_copy_triangle_map(mesh.0, null_mut(), 2), "out_triangles");
        null_refused(planish_mesh_set_points(mesh.0, null(), 4), "points");
        null_refused(planish_mesh_remove_field(mesh.0, null()), "name");
        let unknown = planish_mesh_write(mesh.0, c"a.xyz".as_ptr(), null());
        refused(unknown, planish_status::InvalidArgument, -1, &["a.xyz", ".off"]);
        let options = planish_mesh_options { max_memory: 9, ..record() };
        let large = planish_mesh_read(path.as_ptr(), &options, &mut out);
        refused(large, planish_status::TooLarge, -1, &["a.ply", "9 bytes"]);
    }
    assert_untouched(&out);
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
