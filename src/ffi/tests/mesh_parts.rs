use super::*;

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
fn points_find_their_triangles() {
    let mesh = closed_mesh();
    // beyond the middles of two facets, and far away
    let points = [1.0, 1.0, 1.0, -2.0, 2.0, -2.0, 100.0, 90.0, -80.0];
    let (mut triangles, mut places, mut distances) = ([0; 3], [0.0; 9], [0.0; 3]);
    let near = planish_project_options { max_distance: 10.0, ..record() };
    // SAFETY: arrays of this test.
    unsafe {
        let at = points.as_ptr();
        let to = (triangles.as_mut_ptr(), places.as_mut_ptr(), distances.as_mut_ptr());
        let status = planish_mesh_project(mesh.0, at, 3, &near, to.0, to.1, to.2);
        assert_eq!(status, planish_status::PointsOutside);
        assert_eq!(triangles, [0, 5, PLANISH_NONE]);
        for (found, expected) in distances.iter().zip([2.0, 5.0]) {
            assert!((found - expected / 3_f64.sqrt()).abs() < 4.0 * f64::EPSILON, "{distances:?}");
        }
        for (found, sign) in places.iter().zip([1.0, 1.0, 1.0, -1.0, 1.0, -1.0]) {
            assert!((found - sign / 3.0).abs() < 1e-15, "{places:?}");
        }
        assert!(distances[2].is_nan() && places[6..].iter().all(|x| x.is_nan()));
        ok(planish_mesh_project(mesh.0, at, 3, null(), to.0, null_mut(), null_mut()));
        // the far one is nearest to a corner, which four facets have
        assert_eq!(triangles[..2], [0, 5]);
        assert!(triangles[2] < 8);
        ok(planish_mesh_project(mesh.0, null(), 0, null(), null_mut(), null_mut(), null_mut()));
    }
}

#[test]
fn projections_onto_meshes_that_are_refused_leave_outputs_alone() {
    use planish_status::*;
    let mesh = closed_mesh();
    let points = [1.0, 1.0, 1.0, 0.0, f64::INFINITY, 0.0];
    let guess = [0.0; 4];
    let mut triangles: [u32; 2] = canary();
    let mut flags: [u8; 2] = canary();
    let stop = 1;
    let base = || record::<planish_project_options>();
    let cases = [
        (base(), NotFinite, 1, "point 1 is not finite"),
        (
            planish_project_options { max_distance: -1.0, ..base() },
            InvalidArgument,
            -1,
            "largest distance is -1",
        ),
        (
            planish_project_options { guesses: guess.as_ptr(), ..base() },
            InvalidArgument,
            -1,
            "guesses is not used",
        ),
        (planish_project_options { keep_trims: 0, ..base() }, InvalidArgument, -1, "keep_trims is not used"),
        (
            planish_project_options { out_flags: flags.as_mut_ptr(), ..base() },
            InvalidArgument,
            -1,
            "out_flags is not",
        ),
        (
            planish_project_options { thread_count: 2000, ..base() },
            InvalidArgument,
            -1,
            "thread_count is 2000",
        ),
    ];
    for (options, status, index, word) in cases {
        // SAFETY: arrays of this test.
        let found = unsafe {
            let (at, to) = (points.as_ptr(), triangles.as_mut_ptr());
            planish_mesh_project(mesh.0, at, 2, &options, to, null_mut(), null_mut())
        };
        refused(found, status, index, &[word]);
    }
    for thread_count in [1, 2] {
        let stopped = planish_project_options { cancel: &stop, thread_count, ..base() };
        // SAFETY: arrays of this test.
        let found = unsafe {
            let (at, to) = (points.as_ptr(), triangles.as_mut_ptr());
            planish_mesh_project(mesh.0, at, 1, &stopped, to, null_mut(), null_mut())
        };
        refused(found, Cancelled, -1, &[]);
    }
    // SAFETY: NULL is refused.
    unsafe {
        let (at, to, nowhere) = (points.as_ptr(), triangles.as_mut_ptr(), null_mut());
        null_refused(planish_mesh_project(null(), at, 1, null(), to, nowhere, nowhere), "mesh");
        null_refused(planish_mesh_project(mesh.0, null(), 1, null(), to, nowhere, nowhere), "points");
    }
    assert_untouched(&triangles);
    assert_untouched(&flags);
}
