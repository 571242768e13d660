//! Models: every part comes out, fits the others, and goes into files.

use super::*;

struct ModelHandle(*mut planish_model);

impl Drop for ModelHandle {
    fn drop(&mut self) {
        // SAFETY: made by the library, freed once.
        unsafe { planish_model_free(self.0) };
    }
}

fn model_of(surface: *const planish_surface) -> ModelHandle {
    let mut out = null_mut();
    // SAFETY: a live handle.
    ok(unsafe { planish_model_from_surface(surface, &mut out) });
    ModelHandle(out)
}

/// The saddle with a square hole.
fn holed() -> ModelHandle {
    let saddle = SurfaceHandle::saddle();
    let uv = [0.1, 0.1, 0.9, 0.1, 0.9, 0.9, 0.1, 0.9, 0.4, 0.4, 0.6, 0.4, 0.6, 0.6, 0.4, 0.6];
    // SAFETY: two trims of four points.
    ok(unsafe { planish_surface_set_trims(saddle.0, uv.as_ptr(), [4, 4].as_ptr(), 2) });
    model_of(saddle.0)
}

#[test]
fn all_parts_come_out_and_fit() {
    let model = holed();
    // SAFETY: live handles, and arrays of these lengths.
    unsafe {
        assert_eq!(planish_model_face_count(model.0), 1);
        assert_eq!(planish_model_edge_count(model.0), 8);
        assert_eq!(planish_model_vertex_count(model.0), 8);
        assert_eq!(planish_model_shell_count(model.0), 1);
        assert_eq!(planish_model_loop_count(model.0, 0), 2);
        assert_eq!(planish_model_coedge_count(model.0, 0), 8);
        let mut vertices = [[0.0; 3]; 8];
        ok(planish_model_copy_vertices(model.0, vertices[0].as_mut_ptr(), 8));
        let (mut sizes, mut edges, mut forward) = ([0; 2], [0; 8], [9; 8]);
        ok(planish_model_copy_loops(
            model.0,
            0,
            sizes.as_mut_ptr(),
            2,
            edges.as_mut_ptr(),
            forward.as_mut_ptr(),
            8,
        ));
        assert_eq!(sizes, [4, 4]);
        let mut ends = Vec::new();
        for (place, (&edge, &is_forward)) in edges.iter().zip(&forward).enumerate() {
            let (mut curve, mut info) = (null_mut(), planish_edge_info::default());
            ok(planish_model_copy_edge(model.0, edge as usize, &mut curve, &mut info));
            assert_eq!((info.face_along, info.face_against), (0, PLANISH_NONE));
            let mut domain = [0.0; 2];
            ok(planish_curve_domain(curve, domain.as_mut_ptr()));
            let mut points = [[0.0; 3]; 2];
            ok(planish_curve_eval(curve, domain.as_ptr(), 2, 0, null(), points[0].as_mut_ptr()));
            for (point, vertex) in points.iter().zip([info.vertex_start, info.vertex_end]) {
                // a curve of a few control points, all below 1
                let near = |k: usize| (point[k] - vertices[vertex as usize][k]).abs() <= 4.0 * f64::EPSILON;
                assert!((0..3).all(near), "{point:?}");
            }
            let mut pcurve = null_mut();
            ok(planish_model_copy_pcurve(model.0, 0, place, &mut pcurve));
            let mut uv = [[0.0; 2]; 2];
            ok(planish_curve_eval(pcurve, domain.as_ptr(), 2, 0, null(), uv[0].as_mut_ptr()));
            for (uv, point) in uv.iter().zip(points) {
                // the saddle is z = x y
                assert!((uv[0] * uv[1] - point[2]).abs() < 1e-15);
            }
            planish_curve_free(curve);
            planish_curve_free(pcurve);
            assert_eq!(is_forward, 1);
            ends.push([info.vertex_start, info.vertex_end]);
        }
        for bound in ends.chunks(4) {
            assert!((0..4).all(|k| bound[k][1] == bound[(k + 1) % 4][0]), "{bound:?}");
        }
        let mut info = planish_face_info::default();
        ok(planish_model_face_info(model.0, 0, &mut info));
        assert_eq!((info.carrier, info.loop_count, info.coedge_count, info.shell), (0, 2, 8, 0));
        let (mut shell, mut faces) = (planish_shell_info::default(), [7; 1]);
        ok(planish_model_copy_shell(model.0, 0, &mut shell, faces.as_mut_ptr(), 1));
        assert_eq!((shell.face_count, shell.role, shell.void_in, faces), (1, 0, PLANISH_NONE, [0]));
        let mut surface = null_mut();
        ok(planish_model_copy_face(model.0, 0, &mut surface));
        assert_eq!(planish_surface_trim_count(surface), 2);
        planish_surface_free(surface);
    }
}

#[test]
fn models_are_measured_copied_saved_and_written() {
    let model = holed();
    let mut copy = null_mut();
    let mut report = planish_measure_report::default();
    // SAFETY: live handles, and arrays of these lengths.
    unsafe {
        ok(planish_model_clone(model.0, &mut copy));
        let copy = ModelHandle(copy);
        ok(planish_model_measure(copy.0, &mut report));
        for k in 0..2 {
            assert!((report.box_min[k] - 0.1).abs() <= 4.0 * f64::EPSILON, "{report:?}");
            assert!((report.box_max[k] - 0.9).abs() <= 4.0 * f64::EPSILON, "{report:?}");
        }
        assert_eq!((report.free_edge_count, report.euler_characteristic, report.volume), (8, 0, 0.0));
        assert!(report.area > 0.6 && report.area < 0.9, "{report:?}");

        let mut bytes = vec![0_u8; planish_model_save_size(model.0)];
        ok(planish_model_save(model.0, bytes.as_mut_ptr().cast(), bytes.len()));
        let mut out = null_mut();
        ok(planish_model_load(bytes.as_ptr().cast(), bytes.len(), &mut out));
        let loaded = ModelHandle(out);
        assert_eq!(planish_model_save_size(loaded.0), bytes.len());

        let path = std::env::temp_dir().join(format!("planish_model_{}.planish", std::process::id()));
        let text = CString::new(path.to_str().unwrap()).unwrap();
        ok(planish_model_save_file(model.0, text.as_ptr()));
        ok(planish_model_load_file(text.as_ptr(), &mut out));
        drop(ModelHandle(out));
        let mut size = 0;
        ok(planish_model_write_step_memory(loaded.0, null(), null_mut(), 0, &mut size));
        let mut content = vec![0_u8; size];
        let written = content.as_mut_ptr().cast();
        ok(planish_model_write_step_memory(loaded.0, null(), written, size, &mut size));
        ok(planish_model_write_step(model.0, text.as_ptr(), null()));
        assert_eq!(std::fs::read(&path).unwrap(), content);
        let status = planish_model_write_step_memory(loaded.0, null(), written, size - 1, &mut size);
        refused(status, planish_status::BufferTooSmall, -1, &["out_bytes"]);
        std::fs::remove_file(path).unwrap();
    }
}

#[test]
fn refusals_leave_outputs_alone() {
    let model = holed();
    let (mut surface, mut curve): (*mut planish_surface, *mut planish_curve) = (canary(), canary());
    let mut out: *mut planish_model = canary();
    // SAFETY: live handles, and arrays of these lengths.
    unsafe {
        null_refused(planish_model_from_surface(null(), &mut out), "surface");
        null_refused(planish_model_from_surface(SurfaceHandle::saddle().0, null_mut()), "out_model");
        let status = planish_model_from_surface(SurfaceHandle::other_family().0, &mut out);
        refused(status, planish_status::WrongKind, -1, &["family"]);
        null_refused(planish_model_clone(null(), &mut out), "model");
        planish_model_free(null_mut());
        for count in [planish_model_face_count, planish_model_edge_count, planish_model_vertex_count] {
            assert_eq!(count(null()), 0);
        }
        assert_eq!(planish_model_shell_count(null()) + planish_model_save_size(null()), 0);
        assert_eq!(planish_model_loop_count(model.0, 1) + planish_model_coedge_count(model.0, 1), 0);
        let status = planish_model_copy_face(model.0, 1, &mut surface);
        refused(status, planish_status::Index, 1, &["face 1", "there are 1"]);
        let status = planish_model_copy_edge(model.0, 8, &mut curve, null_mut());
        refused(status, planish_status::Index, 8, &["edge 8"]);
        let status = planish_model_copy_pcurve(model.0, 0, 8, &mut curve);
        refused(status, planish_status::Index, 8, &["coedge 8"]);
        let status = planish_model_copy_shell(model.0, 1, null_mut(), null_mut(), 0);
        refused(status, planish_status::Index, 1, &["shell 1"]);
        null_refused(planish_model_face_info(model.0, 0, null_mut()), "out_info");
        null_refused(planish_model_measure(model.0, null_mut()), "out_report");
        let mut edges = [7_u32; 8];
        let status = planish_model_copy_loops(model.0, 0, null_mut(), 0, edges.as_mut_ptr(), null_mut(), 7);
        refused(status, planish_status::BufferTooSmall, -1, &["out_edges", "8"]);
        assert_eq!(edges, [7; 8]);
        let mut points = [0.5; 21];
        let status = planish_model_copy_vertices(model.0, points.as_mut_ptr(), 7);
        refused(status, planish_status::BufferTooSmall, -1, &["out_points"]);
        assert_eq!(points, [0.5; 21]);
        let status = planish_model_load(b"PLANISH".as_ptr().cast(), 7, &mut out);
        refused(status, planish_status::Format, 0, &["mark"]);
        assert_untouched(&surface);
        assert_untouched(&curve);
        assert_untouched(&out);
    }
}

#[test]
fn models_answer_questions_as_their_surface_does() {
    let saddle = SurfaceHandle::saddle();
    let model = model_of(saddle.0);
    let (points, faces, uv) = ([0.3, 0.6, 0.5, 2.0, 0.5, 1.0], [0_u32, 0], [0.25, 0.5, 0.75, 0.125]);
    // SAFETY: live handles, and arrays of these lengths.
    unsafe {
        let (mut of_model, mut of_surface) = ([0.0; 36], [1.0; 36]);
        let out = of_model.as_mut_ptr();
        ok(planish_model_eval(model.0, faces.as_ptr(), uv.as_ptr(), 2, 2, null(), out));
        ok(planish_surface_eval_derivatives(saddle.0, uv.as_ptr(), 2, 2, null(), of_surface.as_mut_ptr()));
        assert_eq!(of_model, of_surface);
        ok(planish_model_normals(model.0, faces.as_ptr(), uv.as_ptr(), 2, null(), of_model.as_mut_ptr()));
        ok(planish_surface_normals(saddle.0, uv.as_ptr(), 2, null(), of_surface.as_mut_ptr()));
        assert_eq!(of_model[..6], of_surface[..6]);
        ok(planish_model_curvatures(model.0, faces.as_ptr(), uv.as_ptr(), 2, null(), of_model.as_mut_ptr()));
        ok(planish_surface_curvatures(saddle.0, uv.as_ptr(), 2, null(), of_surface.as_mut_ptr()));
        assert_eq!(of_model[..16], of_surface[..16]);

        let (mut found, mut feet, mut distances) = ([9_u32; 2], [0.0; 4], [0.0; 2]);
        let to = (found.as_mut_ptr(), feet.as_mut_ptr(), distances.as_mut_ptr());
        ok(planish_model_project(model.0, points.as_ptr(), 2, null(), to.0, to.1, to.2));
        let (mut own_feet, mut own) = ([1.0; 4], [1.0; 2]);
        ok(planish_surface_project(
            saddle.0,
            points.as_ptr(),
            2,
            null(),
            own_feet.as_mut_ptr(),
            own.as_mut_ptr(),
        ));
        assert_eq!(found, [0, 0]);
        assert!(distances.iter().zip(own).all(|(a, b)| (a - b).abs() < 1e-12), "{distances:?} {own:?}");
        let near = planish_project_options { max_distance: 0.5, ..record() };
        let status = planish_model_project(model.0, points.as_ptr(), 2, &near, to.0, to.1, to.2);
        assert_eq!(status, planish_status::PointsOutside);
        assert_eq!(found, [0, PLANISH_NONE]);
        assert!(distances[1].is_nan() && feet[2].is_nan());

        let mut mesh = null_mut();
        let fine = planish_tessellate_options { chord_tolerance: 1e-3, ..record() };
        ok(planish_model_tessellate(model.0, &fine, &mut mesh));
        let mesh = MeshHandle(mesh);
        assert_eq!(planish_mesh_loop_count(mesh.0), 1);
        let mut report = planish_deviation_report::default();
        // the same points a little along the normals of a saddle z = uv, and against them
        let count = planish_mesh_point_count(mesh.0);
        let mut points = vec![0.0; 3 * count];
        ok(planish_mesh_copy_points(mesh.0, points.as_mut_ptr(), count));
        for (node, point) in points.chunks_exact_mut(3).enumerate() {
            point[2] += if node % 2 == 0 { 1e-3 } else { -1e-3 };
        }
        let mut moved = null_mut();
        ok(planish_mesh_clone(mesh.0, &mut moved));
        let moved = MeshHandle(moved);
        ok(planish_mesh_set_points(moved.0, points.as_ptr(), count));
        let (mut signed, mut uv, mut faces) = (vec![7.0; count], vec![7.0; 2 * count], vec![7_u32; count]);
        let places = planish_deviation_options {
            out_signed: signed.as_mut_ptr(),
            out_uv: uv.as_mut_ptr(),
            out_faces: faces.as_mut_ptr(),
            ..record()
        };
        ok(planish_model_deviation(model.0, moved.0, &places, null_mut(), 0, &mut report));
        assert!(signed.iter().enumerate().all(|(node, &d)| (d > 0.0) == (node % 2 == 0)), "{signed:?}");
        assert!(faces.iter().all(|&face| face == 0) && uv.iter().all(|x| (0.0..=1.0).contains(x)));
        assert!(0.0 < report.median_distance && report.distance_99 <= report.max_distance);
        let back = planish_deviation_options { measure_back: 1, ..record() };
        ok(planish_model_deviation(model.0, mesh.0, &back, null_mut(), 0, &mut report));
        assert!(report.max_distance < 1e-12 && report.max_back_distance < 2e-3, "{report:?}");
        let path = std::env::temp_dir().join(format!("planish_model_{}.vtu", std::process::id()));
        let text = CString::new(path.to_str().unwrap()).unwrap();
        ok(planish_model_write_vtk(model.0, text.as_ptr(), null()));
        let content = std::fs::read(&path).unwrap();
        std::fs::remove_file(path).unwrap();
        assert!(content.windows(11).any(|part| part == b"Name=\"face\""));
    }
}

#[test]
fn questions_are_refused_by_name() {
    let model = holed();
    let (uv, mut out) = ([0.5, 0.5, 1.5, 0.5], [7.0; 6]);
    // SAFETY: live handles, and arrays of these lengths.
    unsafe {
        null_refused(
            planish_model_eval(null(), [0].as_ptr(), uv.as_ptr(), 1, 0, null(), out.as_mut_ptr()),
            "model",
        );
        null_refused(
            planish_model_eval(model.0, null(), uv.as_ptr(), 1, 0, null(), out.as_mut_ptr()),
            "faces",
        );
        let status =
            planish_model_eval(model.0, [0, 1].as_ptr(), uv.as_ptr(), 2, 0, null(), out.as_mut_ptr());
        refused(status, planish_status::Index, 1, &["face 1"]);
        let status =
            planish_model_eval(model.0, [0, 0].as_ptr(), uv.as_ptr(), 2, 0, null(), out.as_mut_ptr());
        refused(status, planish_status::Outside, 1, &["point 1"]);
        let status = planish_model_eval(model.0, [0].as_ptr(), uv.as_ptr(), 1, 3, null(), out.as_mut_ptr());
        refused(status, planish_status::InvalidArgument, -1, &["max_derivative"]);
        assert_eq!(out, [7.0; 6]);
        let points = [0.0, f64::NAN, 0.0];
        let nowhere = null_mut();
        let status =
            planish_model_project(model.0, points.as_ptr(), 1, null(), null_mut(), nowhere, null_mut());
        refused(status, planish_status::NotFinite, 0, &["point 0"]);
        let mut mesh: *mut planish_mesh = canary();
        let few = planish_tessellate_options { chord_tolerance: 1e-5, max_point_count: 50, ..record() };
        let status = planish_model_tessellate(model.0, &few, &mut mesh);
        refused(status, planish_status::TooLarge, -1, &["50"]);
        assert_untouched(&mesh);
    }
}
