use super::*;
use libc::c_void;

#[test]
fn an_octahedron_becomes_a_sphere() {
    let mesh = closed_mesh();
    let mut points: [f64; 21] = canary();
    let mut report: planish_sphere_report = canary();
    report.struct_size = size_of_val(&report);
    let options = planish_sphere_options { thread_count: 1, ..record() };
    // SAFETY: six nodes, and room for one more.
    ok(unsafe { planish_mesh_map_to_sphere(mesh.0, &options, points.as_mut_ptr(), 7, &mut report) });
    for row in points[..18].chunks_exact(3) {
        let length: f64 = row.iter().map(|x| x * x).sum::<f64>().sqrt();
        assert!((length - 1.0).abs() <= 4.0 * f64::EPSILON);
    }
    points[18..].iter().for_each(assert_untouched);
    assert_eq!((report.folded_triangles, report.clamped_triangles), (0, 0));
    // the regular octahedron: eight triangles of area pi/2 with images whose cones have the volume 1/6
    let pi = std::f64::consts::PI;
    let regular = 2.0 * 3.0_f64.sqrt() / pi * (1.0 + pi * pi);
    assert!((report.energy / regular - 1.0).abs() < 1e-3, "{} against {regular}", report.energy);
    assert!(report.seconds >= 0.0);
    // the records may be left out
    let mut again = [0.0; 18];
    // SAFETY: six nodes.
    ok(unsafe { planish_mesh_map_to_sphere(mesh.0, null(), again.as_mut_ptr(), 6, null_mut()) });
    assert_eq!(again, points[..18]);
}

#[test]
fn refusals_leave_outputs_alone() {
    use planish_status::*;
    let mesh = closed_mesh();
    let mut points: [f64; 18] = canary();
    let out = points.as_mut_ptr();
    let sheet = Sheet::new(4).mesh();
    let mut many: [f64; 48] = canary();
    // SAFETY: arrays of these lengths; NULL is refused.
    unsafe {
        null_refused(planish_mesh_map_to_sphere(null(), null(), out, 6, null_mut()), "mesh");
        null_refused(planish_mesh_map_to_sphere(mesh.0, null(), null_mut(), 6, null_mut()), "out_points");
        let short = planish_mesh_map_to_sphere(mesh.0, null(), out, 5, null_mut());
        refused(short, BufferTooSmall, -1, &["room for 5, 6 are needed"]);
        let open = planish_mesh_map_to_sphere(sheet.0, null(), many.as_mut_ptr(), 16, null_mut());
        refused(open, Topology, 0, &["1 boundary loops"]);
        let threads = planish_sphere_options { thread_count: 5000, ..record() };
        let crowd = planish_mesh_map_to_sphere(mesh.0, &threads, out, 6, null_mut());
        refused(crowd, InvalidArgument, -1, &["thread_count"]);
    }
    assert_untouched(&points);
    assert_untouched(&many);
}

#[test]
fn a_listener_cancels() {
    unsafe extern "C-unwind" fn stop(_: f64, _: f64, _: *mut c_void) -> i32 {
        1
    }
    let mesh = closed_mesh();
    let mut points: [f64; 18] = canary();
    let options = planish_sphere_options { progress: Some(stop), ..record() };
    // SAFETY: six nodes.
    let status = unsafe { planish_mesh_map_to_sphere(mesh.0, &options, points.as_mut_ptr(), 6, null_mut()) };
    refused(status, planish_status::Cancelled, -1, &["cancelled"]);
    assert_untouched(&points);
}
