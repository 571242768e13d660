use super::*;
use libc::c_void;

fn decimate(mesh: &MeshHandle, options: &planish_decimate_options) -> (MeshHandle, planish_decimate_report) {
    let mut out = null_mut();
    let mut report: planish_decimate_report = canary();
    report.struct_size = size_of_val(&report);
    // SAFETY: handles and records of this test.
    ok(unsafe { planish_mesh_decimate(mesh.0, options, &mut out, &mut report) });
    (MeshHandle(out), report)
}

#[test]
fn sharp_edges_go_in_and_come_out() {
    let sheet = Sheet::new(15);
    let mesh = sheet.mesh_with_parameters();
    // a row of edges across the sheet, ends on the boundary
    let row: Vec<u32> = (0..14).flat_map(|j| [7 * 15 + j, 7 * 15 + j + 1]).collect();
    let mut kept = [0; 28];
    let options = planish_decimate_options {
        target_count: 60,
        sharp_edges: row.as_ptr(),
        sharp_edge_count: 14,
        out_sharp_edges: kept.as_mut_ptr(),
        out_sharp_edge_count: 14,
        ..record()
    };
    let (coarse, report) = decimate(&mesh, &options);
    assert_eq!((report.collapse_count, report.excess_count), (225 - 60, 0));
    assert!((1..14).contains(&report.sharp_edge_count));
    let mut points = [0.0; 180];
    // SAFETY: sixty nodes.
    ok(unsafe { planish_mesh_copy_points(coarse.0, points.as_mut_ptr(), 60) });
    let places = kept[..2 * report.sharp_edge_count].iter().map(|&node| points[3 * node as usize]);
    assert!(places.into_iter().all(|x| x == 0.5), "the row is at x = 1/2");
}

#[test]
fn refusals_leave_outputs_alone() {
    use planish_status::*;
    let sheet = Sheet::new(6);
    let mesh = sheet.mesh_with_parameters();
    let mut out = canary();
    let mut report: planish_decimate_report = canary();
    report.struct_size = size_of_val(&report);
    let before = report;
    let base = || record::<planish_decimate_options>();
    let edges: [u32; 6] = [7, 8, 8, 8, 9, 36];
    let with_edges =
        |count| planish_decimate_options { sharp_edges: edges.as_ptr(), sharp_edge_count: count, ..base() };
    let mut node = 0;
    let cases = [
        (planish_decimate_options { target_count: 2, ..base() }, InvalidArgument, -1, "target_count is 2"),
        (planish_decimate_options { sharp_angle: 4.0, ..base() }, InvalidArgument, -1, "sharp_angle is 4"),
        (planish_decimate_options { corner_angle: 0.0, ..base() }, InvalidArgument, -1, "corner_angle is 0"),
        (planish_decimate_options { keep_map: 7, ..base() }, InvalidArgument, -1, "keep_map is 7"),
        (planish_decimate_options { reserved: 1, ..base() }, Version, -1, "reserved"),
        (planish_decimate_options { sharp_edge_count: 1, ..base() }, NullPointer, -1, "sharp_edges is NULL"),
        (
            planish_decimate_options { sharp_edge_count: usize::MAX, ..base() },
            TooLarge,
            -1,
            "sharp_edges would have",
        ),
        (with_edges(2), Topology, 1, "no edge of the mesh"),
        (with_edges(3), Topology, 1, "no edge of the mesh"),
        (
            planish_decimate_options { out_sharp_edges: &mut node, ..with_edges(1) },
            BufferTooSmall,
            -1,
            "room for 0, 1 are needed",
        ),
    ];
    for (options, status, index, word) in cases {
        // SAFETY: handles and records of this test.
        let found = unsafe { planish_mesh_decimate(mesh.0, &options, &mut out, &mut report) };
        refused(found, status, index, &[word]);
    }
    // SAFETY: NULL is refused.
    unsafe {
        null_refused(planish_mesh_decimate(null(), null(), &mut out, &mut report), "mesh");
        null_refused(planish_mesh_decimate(mesh.0, null(), null_mut(), &mut report), "out_mesh");
    }
    assert_untouched(&out);
    assert_eq!(report.seconds.to_bits(), before.seconds.to_bits());

    let mut folded = Sheet::new(6);
    folded.uv.swap(15, 17);
    let mesh = folded.mesh_with_parameters();
    // SAFETY: handles and records of this test.
    let found = unsafe { planish_mesh_decimate(mesh.0, null(), &mut out, &mut report) };
    assert_eq!(found, Degenerate, "{}", message());
    let loose = planish_decimate_options { target_count: 20, keep_map: 0, ..base() };
    assert_eq!(decimate(&mesh, &loose).1.collapse_count, 16);
}

#[test]
fn a_listener_cancels() {
    unsafe extern "C-unwind" fn stop(_: f64, _: f64, _: *mut c_void) -> i32 {
        1
    }
    let mesh = Sheet::new(40).mesh();
    let mut out = canary();
    let options = planish_decimate_options { target_count: 50, progress: Some(stop), ..record() };
    // SAFETY: handles and records of this test.
    let status = unsafe { planish_mesh_decimate(mesh.0, &options, &mut out, null_mut()) };
    refused(status, planish_status::Cancelled, -1, &["cancelled"]);
    assert_untouched(&out);
}
