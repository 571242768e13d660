//! Closed meshes as models, through C.

use super::*;
use crate::layout::CUBE_FACES;
use glam::DVec2;

/// A ball of some nodes a face of the cube; the triangles run inwards if `is_inside_out`.
fn ball(n: u32, is_inside_out: bool) -> MeshHandle {
    let mut numbers = std::collections::BTreeMap::new();
    let (mut points, mut triangles): (Vec<f64>, Vec<u32>) = (Vec::new(), Vec::new());
    for face in CUBE_FACES {
        let mut at = |i: u32, j: u32| {
            let place = face.point(DVec2::new(f64::from(i), f64::from(j)) / f64::from(n));
            let key = (place * f64::from(n)).round().to_array().map(|x| x as i64);
            *numbers.entry(key).or_insert_with(|| {
                points.extend(place.normalize().to_array());
                points.len() as u32 / 3 - 1
            })
        };
        for (i, j) in (0..n * n).map(|k| (k / n, k % n)) {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            let both = if is_inside_out { [[a, c, b], [a, d, c]] } else { [[a, b, c], [a, c, d]] };
            triangles.extend(both.into_iter().flatten());
        }
    }
    let (mut mesh, counts) = (null_mut(), (points.len() / 3, triangles.len() / 3));
    // SAFETY: arrays of these sizes.
    ok(unsafe {
        planish_mesh_new(points.as_ptr(), counts.0, triangles.as_ptr(), counts.1, null(), &mut mesh)
    });
    MeshHandle(mesh)
}

fn defaults() -> planish_model_options {
    planish_model_options { thread_count: 2, ..planish_model_options::default() }
}

#[test]
fn a_ball_becomes_a_solid_and_every_node_finds_its_place() {
    let mesh = ball(8, false);
    // SAFETY: a mesh.
    let count = unsafe { planish_mesh_point_count(mesh.0) };
    let (mut faces, mut uv, mut errors) = (vec![9_u32; count], vec![9.0; 2 * count], vec![9.0; count]);
    let options = planish_model_options {
        out_faces: faces.as_mut_ptr(),
        out_uv: uv.as_mut_ptr(),
        out_errors: errors.as_mut_ptr(),
        ..defaults()
    };
    let (mut model, mut report) = (null_mut(), planish_model_report::default());
    // SAFETY: a live mesh, arrays of its size.
    unsafe {
        ok(planish_model_fit(mesh.0, &options, &mut model, &mut report));
        assert!(report.max_error <= report.tolerance && report.normal_jump <= 1e-12, "{report:?}");
        assert_eq!((report.component_count, report.patch_count, report.genus, report.is_chart), (1, 6, 0, 0));
        assert_eq!((report.mesh_crossing_count, report.crossing_count), (0, 0));
        assert_eq!(errors.iter().copied().fold(0.0, f64::max), report.max_error);
        let mut measure = planish_measure_report::default();
        ok(planish_model_measure(model, &mut measure));
        assert_eq!((measure.free_edge_count, measure.euler_characteristic), (0, 2));
        assert!((measure.volume / report.volume - 1.0).abs() <= 1e-10);
        assert!(faces.iter().all(|&face| (face as usize) < planish_model_face_count(model)));
        // the first node again, through the face's own surface
        let mut surface = null_mut();
        ok(planish_model_copy_face(model, faces[0] as usize, &mut surface));
        let surface = SurfaceHandle(surface);
        let mut point = [0.0; 3];
        ok(planish_surface_eval(surface.0, uv.as_ptr(), 1, null(), point.as_mut_ptr()));
        let mut node = vec![0.0; 3 * count];
        ok(planish_mesh_copy_points(mesh.0, node.as_mut_ptr(), count));
        let miss: f64 = (0..3).map(|k| (point[k] - node[k]).powi(2)).sum::<f64>().sqrt();
        assert!((miss - errors[0]).abs() <= 1e-13, "{miss} {}", errors[0]);
        check_origin(model, (&faces, &uv, &errors));
        check_page(model, mesh.0);
        planish_model_free(model);
    }
}

/// A model, its copy, and what comes back from its bytes know where the nodes went, and how far they are off.
unsafe fn check_origin(model: *const planish_model, (faces, uv, errors): (&[u32], &[f64], &[f64])) {
    // SAFETY: a live model, arrays of the size of its mesh.
    unsafe {
        let (mut copy, mut loaded) = (null_mut(), null_mut());
        ok(planish_model_clone(model, &mut copy));
        let mut bytes = vec![0_u8; planish_model_save_size(model)];
        ok(planish_model_save(model, bytes.as_mut_ptr().cast(), bytes.len()));
        ok(planish_model_load(bytes.as_ptr().cast(), bytes.len(), &mut loaded));
        for model in [model, copy, loaded] {
            let count = planish_model_node_count(model);
            assert_eq!(count, faces.len());
            let (mut of_nodes, mut places) = (vec![0; count], vec![0.0; 2 * count]);
            ok(planish_model_locate_nodes(model, of_nodes.as_mut_ptr(), places.as_mut_ptr(), count));
            assert_eq!((of_nodes.as_slice(), places.as_slice()), (faces, uv));
            let status = planish_model_locate_nodes(model, of_nodes.as_mut_ptr(), null_mut(), count - 1);
            refused(status, planish_status::BufferTooSmall, -1, &["out_faces"]);
            for face in 0..planish_model_face_count(model) {
                let mut info = planish_face_info::default();
                ok(planish_model_face_info(model, face, &mut info));
                let of_face = || faces.iter().zip(errors).filter(|(at, _)| **at as usize == face);
                assert_eq!(info.node_count, of_face().count());
                let largest = of_face().map(|(_, &error)| error).fold(f64::NAN, f64::max);
                assert_eq!(info.max_error.to_bits(), largest.to_bits());
                assert!(!(info.rms_error > info.max_error));
            }
        }
        let mut again = vec![0_u8; bytes.len()];
        ok(planish_model_save(loaded, again.as_mut_ptr().cast(), again.len()));
        assert!(again == bytes, "what is loaded is saved as it was");
        planish_model_free(copy);
        planish_model_free(loaded);
    }
}

/// The page of a model names its faces, and a place that cannot be written is told.
unsafe fn check_page(model: *const planish_model, mesh: *const planish_mesh) {
    let path = std::env::temp_dir().join(format!("planish-model-{}.html", std::process::id()));
    let c_path = std::ffi::CString::new(path.to_str().unwrap()).unwrap();
    // SAFETY: a live model and mesh.
    unsafe {
        ok(planish_model_write_report(model, mesh, c_path.as_ptr(), null()));
        let page = std::fs::read_to_string(&path).unwrap();
        std::fs::remove_file(&path).unwrap();
        for word in
            ["<td>shells</td><td>1</td>", "<td>edges of one face</td><td>0</td>", "face ", "Tolerance met"]
        {
            assert!(page.contains(word), "{word}");
        }
        let options = planish_report_options { tolerance: -1.0, ..planish_report_options::default() };
        let status = planish_model_write_report(model, mesh, c_path.as_ptr(), &options);
        refused(status, planish_status::InvalidArgument, -1, &["tolerance"]);
        null_refused(planish_model_write_report(model, null(), c_path.as_ptr(), null()), "mesh");
    }
}

#[test]
fn a_field_on_a_ball_is_a_model_of_its_own_dimension() {
    let mesh = ball(16, false);
    let (mut model, mut fitter, mut field) = (null_mut(), null_mut(), null_mut());
    let mut report = planish_fit_report::default();
    // SAFETY: live handles, arrays of their sizes.
    unsafe {
        let count = planish_mesh_point_count(mesh.0);
        ok(planish_model_fit(mesh.0, &defaults(), &mut model, null_mut()));
        let options = planish_field_options { thread_count: 2, ..planish_field_options::default() };
        ok(planish_field_fitter_new_model(model, mesh.0, &options, &mut fitter));
        assert_eq!(planish_field_fitter_point_count(fitter), count);
        // twice x, and what is the same everywhere
        let mut points = vec![0.0; 3 * count];
        ok(planish_mesh_copy_points(mesh.0, points.as_mut_ptr(), count));
        let values: Vec<f64> = points.chunks_exact(3).flat_map(|p| [2.0 * p[0], 4.0]).collect();
        let status =
            planish_field_fitter_fit_model(fitter, values.as_ptr(), count, 2, &mut field, &mut report);
        assert!(status == planish_status::Ok || status == planish_status::ToleranceNotMet);
        assert!(report.max_error <= 2e-3, "{}", report.max_error);
        assert_eq!(
            (planish_model_dim(field), planish_model_dim(model), planish_model_dim(null())),
            (2, 3, 0)
        );
        assert_eq!(planish_model_face_count(field), planish_model_face_count(model));

        let mut bytes = vec![0_u8; planish_model_save_size(field)];
        ok(planish_model_save(field, bytes.as_mut_ptr().cast(), bytes.len()));
        let (mut loaded, mut copy) = (null_mut(), null_mut());
        ok(planish_model_load(bytes.as_ptr().cast(), bytes.len(), &mut loaded));
        ok(planish_model_clone(loaded, &mut copy));
        let (faces, uv) = ([0_u32, 3], [0.25_f64; 4]);
        let mut rows = [[0.0; 12]; 2];
        for (field, rows) in [field, copy].into_iter().zip(&mut rows) {
            ok(planish_model_eval(field, faces.as_ptr(), uv.as_ptr(), 2, 1, null(), rows.as_mut_ptr()));
        }
        assert_eq!(rows[0], rows[1]);
        let (mut places, mut gradients) = ([0.0; 6], [0.0; 12]);
        ok(planish_model_eval(model, faces.as_ptr(), uv.as_ptr(), 2, 0, null(), places.as_mut_ptr()));
        let (face, uv) = (faces.as_ptr(), uv.as_ptr());
        ok(planish_model_field_gradient(model, field, face, uv, 2, null(), gradients.as_mut_ptr()));
        for (k, place) in places.chunks_exact(3).enumerate() {
            assert!(
                (rows[0][6 * k] - 2.0 * place[0]).abs() <= 2e-3 && (rows[0][6 * k + 1] - 4.0).abs() <= 1e-13
            );
            // of x along the sphere
            let exact = [0, 1, 2].map(|c| f64::from(u8::from(c == 0)) - place[0] * place[c]);
            for c in 0..3 {
                // the same over half a side
                assert!((gradients[6 * k + c] - 2.0 * exact[c]).abs() <= 0.2, "{gradients:?} {exact:?}");
                assert!(gradients[6 * k + 3 + c].abs() <= 1e-12);
            }
        }
        // what needs places in space, and what needs another fitter
        let (mut surface, mut mesh_of, mut bounds) =
            (null_mut(), null_mut(), planish_measure_report::default());
        let wrong = |status| refused(status, planish_status::WrongKind, -1, &["field over the faces"]);
        wrong(planish_model_tessellate(field, null(), &mut mesh_of));
        wrong(planish_model_measure(field, &mut bounds));
        wrong(planish_model_normals(field, face, uv, 2, null(), places.as_mut_ptr()));
        wrong(planish_field_fitter_new_model(field, mesh.0, null(), &mut fitter));
        let status = planish_model_field_gradient(model, model, face, uv, 2, null(), gradients.as_mut_ptr());
        refused(status, planish_status::WrongKind, -1, &["field"]);
        let status = planish_field_fitter_fit(fitter, values.as_ptr(), count, 2, &mut surface, null_mut());
        refused(status, planish_status::WrongKind, -1, &["patches"]);
        let mut grid = [0; 2];
        refused(
            planish_field_fitter_grid(fitter, grid.as_mut_ptr()),
            planish_status::WrongKind,
            -1,
            &["patches"],
        );
        ok(planish_model_copy_face(field, 0, &mut surface));
        drop(SurfaceHandle(surface));

        let targets: Vec<f64> = points[..30].iter().map(|x| 1.01 * x).collect();
        let (mut transfer, mut told) = (null_mut(), planish_transfer_report::default());
        let made =
            planish_transfer_new_model(model, mesh.0, targets.as_ptr(), 10, null(), &mut transfer, &mut told);
        assert_eq!((made, told.far_count), (planish_status::Ok, 0));
        let mut there = [0.0; 20];
        ok(planish_transfer_apply(transfer, values.as_ptr(), count, 2, there.as_mut_ptr()));
        for (row, point) in there.chunks_exact(2).zip(points.chunks_exact(3)) {
            assert!((row[0] - 2.0 * point[0]).abs() <= 0.02 && (row[1] - 4.0).abs() <= 1e-13);
        }
        let status = planish_transfer_copy_parameters(transfer, there.as_mut_ptr(), 10);
        refused(status, planish_status::WrongKind, -1, &["patches"]);
        planish_transfer_free(transfer);
        for handle in [model, field, loaded, copy] {
            planish_model_free(handle);
        }
        planish_field_fitter_free(fitter);
    }
}

#[test]
fn two_sides_of_a_roof_become_one_smooth_shell() {
    let knots = [0.0, 0.0, 1.0, 1.0];
    let bilinear = |points: [[f64; 3]; 4]| {
        let (mut surface, knots) = (null_mut(), knots.as_ptr());
        // SAFETY: knots and control points of degree 1.
        ok(unsafe {
            planish_tensor_new(
                3,
                1,
                1,
                knots,
                4,
                knots,
                4,
                points.as_flattened().as_ptr(),
                null(),
                &mut surface,
            )
        });
        SurfaceHandle(surface)
    };
    let left = bilinear([[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.2], [1.0, 1.0, 0.2]]);
    let right = bilinear([[1.0, 0.0, 0.2], [1.0, 1.0, 0.2], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0]]);
    let apart = bilinear([[1.0, 0.5, 0.2], [1.0, 1.0, 0.2], [2.0, 0.5, 0.0], [2.0, 1.0, 0.0]]);
    let (mut model, mut report): (*mut planish_model, _) = (null_mut(), planish_smooth_report::default());
    // SAFETY: live surfaces.
    unsafe {
        let options = planish_smooth_options { thread_count: 2, ..planish_smooth_options::default() };
        let both = [left.0.cast_const(), right.0.cast_const()];
        let made = planish_model_smooth_from_patches(both.as_ptr(), 2, &options, &mut model, &mut report);
        ok(made);
        assert_eq!((report.joined_count, report.free_count, report.piece_count), (1, 6, 1));
        assert!(report.given_normal_jump > 0.3 && report.normal_jump <= 1e-12, "{report:?}");
        assert!(report.max_deviation > 0.0 && report.max_deviation <= report.tolerance, "{report:?}");
        planish_model_free(model);

        let before = format!("{report:?}");
        let mut model = canary::<*mut planish_model>();
        let mut refuse = |patches: &[*const planish_surface], options: *const planish_smooth_options| {
            let status = planish_model_smooth_from_patches(
                patches.as_ptr(),
                patches.len(),
                options,
                &mut model,
                &mut report,
            );
            assert!(model == canary() && format!("{report:?}") == before);
            status
        };
        let meets = [left.0.cast_const(), apart.0.cast_const()];
        refused(refuse(&meets, null()), planish_status::Topology, 0, &["corner of patch 1", "patch 0"]);
        refused(refuse(&[], null()), planish_status::InvalidArgument, -1, &["no patches"]);
        null_refused(refuse(&[left.0, null()], null()), "surfaces");
        type Change = fn(&mut planish_smooth_options);
        let cases: [(Change, &str); 6] = [
            (|o| o.tolerance = 0.0, "tolerance"),
            (|o| o.join_tolerance = f64::NAN, "tolerance"),
            (|o| o.smoothing = -1.0, "smoothing"),
            (|o| o.max_cells = 3, "max_cells"),
            (|o| o.max_rounds = 0, "max_rounds"),
            (|o| o.tolerance_scale = 2, "tolerance_scale"),
        ];
        for (change, word) in cases {
            let mut options = options;
            change(&mut options);
            refused(refuse(&both, &options), planish_status::InvalidArgument, -1, &[word]);
        }
        let status = planish_model_smooth_from_patches(both.as_ptr(), 2, null(), null_mut(), null_mut());
        null_refused(status, "out_model");
    }
}

#[test]
fn a_mesh_inside_out_is_turned_and_told() {
    let mesh = ball(4, true);
    let (mut model, mut report) = (null_mut(), planish_model_report::default());
    // SAFETY: a live mesh.
    unsafe {
        let status = planish_model_fit(mesh.0, &defaults(), &mut model, &mut report);
        assert_eq!((status, report.turned_count), (planish_status::InputRepaired, 1));
        assert!(report.volume > 0.0);
        planish_model_free(model);
    }
}

#[test]
fn wrong_options_leave_everything_as_it_was() {
    let mesh = ball(4, false);
    let mut report: planish_model_report = canary();
    report.struct_size = size_of::<planish_model_report>();
    let before = format!("{report:?}");
    let mut model = null_mut();
    type Change = fn(&mut planish_model_options);
    let cases: [(Change, &str); 9] = [
        (|o| o.tolerance = 0.0, "tolerance"),
        (|o| o.smoothing = f64::NAN, "smoothing"),
        (|o| o.family = 3, "family"),
        (|o| o.layout = 3, "layout"),
        (|o| o.tolerance_scale = 2, "tolerance_scale"),
        (|o| o.guard = 2, "guard"),
        (|o| o.max_level = 21, "max_level"),
        (|o| o.start_level = 9, "start_level"),
        (|o| o.max_rounds = 0, "max_rounds"),
    ];
    for (change, word) in cases {
        let mut options = defaults();
        change(&mut options);
        // SAFETY: a live mesh.
        let status = unsafe { planish_model_fit(mesh.0, &options, &mut model, &mut report) };
        refused(status, planish_status::InvalidArgument, -1, &[word]);
        assert!(model.is_null() && format!("{report:?}") == before, "{word}");
    }
    // SAFETY: NULL is refused.
    unsafe {
        null_refused(planish_model_fit(null(), null(), &mut model, null_mut()), "mesh");
        null_refused(planish_model_fit(mesh.0, null(), null_mut(), null_mut()), "out_model");
        null_refused(planish_model_options_init(null_mut(), 152), "options");
    }
}
