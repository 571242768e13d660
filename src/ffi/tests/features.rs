use super::*;

fn find(mesh: &MeshHandle, options: &planish_feature_options, room: usize) -> Vec<u32> {
    let mut edges = vec![0; 2 * room];
    let mut count = 0;
    // SAFETY: so many edges.
    ok(unsafe { planish_mesh_find_features(mesh.0, options, edges.as_mut_ptr(), room, &mut count) });
    edges.truncate(2 * count);
    edges
}

#[test]
fn an_octahedron_is_sharp_all_over() {
    let mesh = closed_mesh();
    let mut report: planish_feature_report = canary();
    report.struct_size = size_of_val(&report);
    let mut is_corner: [u8; 7] = canary();
    let options = planish_feature_options {
        out_report: &mut report,
        out_is_corner: is_corner.as_mut_ptr(),
        filter_noise: 0,
        ..record()
    };
    let mut count = 0;
    // SAFETY: NULL asks for the number.
    ok(unsafe { planish_mesh_find_features(mesh.0, &options, null_mut(), 0, &mut count) });
    assert_eq!(count, 12);
    assert_eq!(find(&mesh, &options, 12).len(), 24);
    assert_eq!((report.edge_count, report.chain_count, report.corner_count), (12, 12, 6));
    assert_eq!(is_corner[..6], [1; 6]);
    assert_untouched(&is_corner[6]);
}

#[test]
fn labels_and_given_edges_are_taken() {
    let mesh = closed_mesh();
    // the upper four facets and the lower four
    let labels = [1, 1, 1, 1, 2, 2, 2, 2];
    let none = planish_feature_options { sharp_angle: 0.0, labels: labels.as_ptr(), ..record() };
    assert_eq!(find(&mesh, &none, 4), [0, 1, 0, 3, 1, 2, 2, 3]);
    let given = [4, 0];
    let one =
        planish_feature_options { labels: null(), sharp_edges: given.as_ptr(), sharp_edge_count: 1, ..none };
    assert_eq!(find(&mesh, &one, 1), [0, 4]);
}

#[test]
fn refusals_leave_outputs_alone() {
    use planish_status::*;
    let mesh = closed_mesh();
    let mut edges: [u32; 24] = canary();
    let mut count: usize = canary();
    let base = || record::<planish_feature_options>();
    let far: [u32; 4] = [0, 4, 0, 9];
    let with_edges = |edge_count| planish_feature_options {
        sharp_edges: far.as_ptr(),
        sharp_edge_count: edge_count,
        ..base()
    };
    let cases = [
        (planish_feature_options { sharp_angle: 4.0, ..base() }, 12, InvalidArgument, -1, "sharp_angle is 4"),
        (planish_feature_options { weak_angle: -1.0, ..base() }, 12, InvalidArgument, -1, "weak_angle is -1"),
        (
            planish_feature_options { least_length: 2.0, ..base() },
            12,
            InvalidArgument,
            -1,
            "least_length is 2",
        ),
        (planish_feature_options { filter_noise: 2, ..base() }, 12, InvalidArgument, -1, "filter_noise is 2"),
        (planish_feature_options { reserved: 1, ..base() }, 12, Version, -1, "reserved"),
        (
            planish_feature_options { sharp_edge_count: 1, ..base() },
            12,
            NullPointer,
            -1,
            "sharp_edges is NULL",
        ),
        (with_edges(2), 12, Index, 1, "node 9"),
        (base(), 11, BufferTooSmall, -1, "room for 11, 12 are needed"),
    ];
    for (options, room, status, index, word) in cases {
        // SAFETY: arrays of this test.
        let found =
            unsafe { planish_mesh_find_features(mesh.0, &options, edges.as_mut_ptr(), room, &mut count) };
        refused(found, status, index, &[word]);
    }
    // SAFETY: NULL is refused.
    unsafe {
        let at = edges.as_mut_ptr();
        null_refused(planish_mesh_find_features(null(), null(), at, 12, &mut count), "mesh");
        null_refused(planish_mesh_find_features(mesh.0, null(), at, 12, null_mut()), "out_count");
        null_refused(planish_feature_options_init(null_mut(), 96), "options");
    }
    assert_untouched(&edges);
    assert_untouched(&count);
}

#[test]
fn labels_in_two_pieces_are_told() {
    let mesh = closed_mesh();
    // two facets that meet in a corner alone, and the six others
    let labels = [9, 4, 9, 4, 4, 4, 4, 4];
    let (mut found, mut sizes, mut pieces, mut handles) = ([0; 2], [0; 2], [0; 2], [7; 2]);
    let mut count = 0;
    // SAFETY: arrays of this test.
    unsafe {
        let (at, nowhere) = (labels.as_ptr(), null_mut());
        let none = null_mut();
        ok(planish_mesh_label_parts(mesh.0, at, 8, none, nowhere, nowhere, nowhere, 0, &mut count));
        assert_eq!(count, 2);
        let (found_at, sizes_at) = (found.as_mut_ptr(), sizes.as_mut_ptr());
        let (pieces_at, handles_at) = (pieces.as_mut_ptr(), handles.as_mut_ptr());
        ok(planish_mesh_label_parts(mesh.0, at, 8, found_at, sizes_at, pieces_at, handles_at, 2, &mut count));
        ok(planish_mesh_label_parts(mesh.0, null(), 0, none, nowhere, nowhere, nowhere, 0, &mut count));
    }
    assert_eq!((found, sizes, pieces, handles, count), ([4, 9], [6, 2], [1, 2], [0, 0], 0));
}

#[test]
fn label_parts_that_are_refused_leave_outputs_alone() {
    use planish_status::*;
    let mesh = closed_mesh();
    let labels = [1, 1, 1, 1, 2, 2, 2, 2];
    let mut found: [u32; 2] = canary();
    let mut count: usize = canary();
    // SAFETY: arrays of this test; NULL is refused.
    unsafe {
        let (from, at, no) = (labels.as_ptr(), found.as_mut_ptr(), null_mut());
        let status = planish_mesh_label_parts(mesh.0, from, 7, at, no, no, no, 2, &mut count);
        refused(status, InvalidArgument, -1, &["7 labels do not fit 8 triangles"]);
        let status = planish_mesh_label_parts(mesh.0, from, 8, at, no, no, no, 1, &mut count);
        refused(status, BufferTooSmall, -1, &["room for 1, 2 are needed"]);
        null_refused(planish_mesh_label_parts(null(), from, 8, at, no, no, no, 2, &mut count), "mesh");
        null_refused(planish_mesh_label_parts(mesh.0, null(), 8, at, no, no, no, 2, &mut count), "labels");
        null_refused(planish_mesh_label_parts(mesh.0, from, 8, at, no, no, no, 2, no), "out_count");
    }
    assert_untouched(&found);
    assert_untouched(&count);
}
