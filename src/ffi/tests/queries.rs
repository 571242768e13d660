//! Tessellation, projection, deviation, files.

use super::*;

/// The plane z = x + 2y over the unit square, cut into a mesh of its own.
struct Scene {
    surface: *mut planish_surface,
    mesh: *mut planish_mesh,
}

impl Scene {
    fn new() -> Self {
        let knots = [0.0, 0.0, 1.0, 1.0];
        let points = [0.0, 0.0, 0.0, 0.0, 1.0, 2.0, 1.0, 0.0, 1.0, 1.0, 1.0, 3.0];
        let (mut surface, mut mesh) = (null_mut(), null_mut());
        // SAFETY: the arrays have the lengths said.
        unsafe {
            let (u, v, p) = (knots.as_ptr(), knots.as_ptr(), points.as_ptr());
            ok(planish_tensor_new(3, 1, 1, u, 4, v, 4, p, null(), &raw mut surface));
            ok(planish_surface_tessellate(surface, null(), &raw mut mesh));
        }
        Self { surface, mesh }
    }
}

impl Drop for Scene {
    fn drop(&mut self) {
        // SAFETY: made in `new`.
        unsafe {
            planish_surface_free(self.surface);
            planish_mesh_free(self.mesh);
        }
    }
}

/// A path of its own for each test.
fn file(name: &str) -> CString {
    let name = format!("planish_{}_{name}", std::process::id());
    c(std::env::temp_dir().join(name).to_str().unwrap())
}

#[test]
fn tessellations_refuse_by_name() {
    let scene = Scene::new();
    let mut mesh: *mut planish_mesh = canary();
    let mut options: planish_tessellate_options = record();
    // SAFETY: all pointers are NULL or live.
    unsafe {
        null_refused(planish_surface_tessellate(null(), null(), &raw mut mesh), "surface");
        null_refused(planish_surface_tessellate(scene.surface, null(), null_mut()), "out_mesh");
        options.chord_tolerance = -1.0;
        let status = planish_surface_tessellate(scene.surface, &raw const options, &raw mut mesh);
        refused(status, planish_status::InvalidArgument, -1, &["chord_tolerance", "-1"]);
        options = planish_tessellate_options { max_edge_length: 1e-3, max_point_count: 500, ..record() };
        let status = planish_surface_tessellate(scene.surface, &raw const options, &raw mut mesh);
        refused(status, planish_status::TooLarge, -1, &["500"]);
        options = planish_tessellate_options { keep_trims: 2, ..record() };
        let status = planish_surface_tessellate(scene.surface, &raw const options, &raw mut mesh);
        refused(status, planish_status::InvalidArgument, -1, &["keep_trims", "2"]);
        options = planish_tessellate_options { thread_count: 1025, ..record() };
        let status = planish_surface_tessellate(scene.surface, &raw const options, &raw mut mesh);
        refused(status, planish_status::InvalidArgument, -1, &["thread_count", "1025"]);
        let bow = [0.1, 0.1, 0.9, 0.9, 0.9, 0.1, 0.1, 0.9];
        ok(planish_surface_set_trims(scene.surface, bow.as_ptr(), [4].as_ptr(), 1));
        let status = planish_surface_tessellate(scene.surface, null(), &raw mut mesh);
        refused(status, planish_status::Topology, -1, &["cross"]);
    }
    assert_untouched(&mesh);
}

#[test]
fn points_are_projected_onto_the_plane() {
    let scene = Scene::new();
    // (0.25, 0.5) moved by 3 along the normal (-1, -2, 1)
    let step = 3.0 / 6.0_f64.sqrt();
    let points = [0.25 - step, 0.5 - 2.0 * step, 1.25 + step, 0.25, 0.5, 1.25];
    let (mut uv, mut distances) = ([0.0; 4], [0.0; 2]);
    // SAFETY: the arrays have the lengths said.
    unsafe {
        let (uv, distances) = (uv.as_mut_ptr(), distances.as_mut_ptr());
        ok(planish_surface_project(scene.surface, points.as_ptr(), 2, null(), uv, distances));
        ok(planish_surface_project(scene.surface, null(), 0, null(), null_mut(), null_mut()));
    }
    // a flat bilinear patch: Newton ends at roundoff of numbers of size 3
    let tol = 64.0 * f64::EPSILON;
    assert!((distances[0] - 3.0).abs() <= tol && distances[1] <= tol, "{distances:?}");
    assert!((uv[0] - 0.25).abs() <= tol && (uv[1] - 0.5).abs() <= tol, "{uv:?}");
}

#[test]
fn projections_refuse_by_name_and_index() {
    let scene = Scene::new();
    let points = [0.0, 0.0, 0.0, 0.0, f64::NAN, 0.0];
    let (mut uv, mut distances): ([f64; 4], [f64; 2]) = (canary(), canary());
    let mut options: planish_project_options = record();
    // SAFETY: all pointers are NULL or live, the arrays have the lengths said.
    unsafe {
        let (to_uv, to_distances) = (uv.as_mut_ptr(), distances.as_mut_ptr());
        let status = planish_surface_project(null(), points.as_ptr(), 2, null(), to_uv, to_distances);
        null_refused(status, "surface");
        let status = planish_surface_project(scene.surface, null(), 2, null(), to_uv, to_distances);
        null_refused(status, "points");
        let status = planish_surface_project(scene.surface, points.as_ptr(), 2, null(), to_uv, to_distances);
        refused(status, planish_status::NotFinite, 1, &["point 1"]);
        options.max_distance = -2.0;
        let options = &raw const options;
        let status = planish_surface_project(scene.surface, points.as_ptr(), 1, options, to_uv, to_distances);
        refused(status, planish_status::InvalidArgument, -1, &["-2"]);
        let other = planish_surface::other_into_raw(OtherFamily::default());
        let status = planish_surface_project(other, points.as_ptr(), 1, null(), to_uv, to_distances);
        refused(status, planish_status::WrongKind, -1, &["Pht"]);
        planish_surface_free(other);
    }
    assert_untouched(&uv);
    assert_untouched(&distances);
}

#[test]
fn points_farther_than_asked_are_nan_and_told() {
    let scene = Scene::new();
    let points = [0.0, 0.0, 9.0, 0.5, 0.5, 1.5];
    let mut distances = [0.0; 2];
    let options = planish_project_options { max_distance: 1.0, ..record() };
    // SAFETY: the arrays have the lengths said.
    let status = unsafe {
        let to = distances.as_mut_ptr();
        planish_surface_project(scene.surface, points.as_ptr(), 2, &raw const options, null_mut(), to)
    };
    assert_eq!(status, planish_status::PointsOutside);
    assert!(distances[0].is_nan() && distances[1] < 1e-12, "{distances:?}");
}

#[test]
fn deviations_are_measured_and_refuse_by_name() {
    let scene = Scene::new();
    let mut report: planish_deviation_report = record();
    // SAFETY: all pointers are NULL or live, the arrays have the lengths said.
    unsafe {
        let count = planish_mesh_point_count(scene.mesh);
        let mut distances = vec![7.0; count];
        let to = distances.as_mut_ptr();
        ok(planish_surface_deviation(scene.surface, scene.mesh, null(), to, count, &raw mut report));
        assert!(report.max_distance < 1e-14 && report.max_back_distance.is_nan(), "{report:?}");
        assert!(distances.iter().all(|&distance| distance <= report.max_distance));
        assert!(report.median_distance <= report.distance_95 && report.distance_99 <= report.max_distance);
        let (mut signed, mut uv, mut faces) = (vec![7.0; count], vec![7.0; 2 * count], vec![7_u32; count]);
        let mut places = planish_deviation_options { out_signed: signed.as_mut_ptr(), ..record() };
        places.out_uv = uv.as_mut_ptr();
        ok(planish_surface_deviation(scene.surface, scene.mesh, &places, to, count, null_mut()));
        for (signed, distance) in signed.iter().zip(&distances) {
            assert_eq!(signed.abs(), *distance);
        }
        let mut at = vec![0.0; 3 * count];
        ok(planish_surface_eval(scene.surface, uv.as_ptr(), count, null(), at.as_mut_ptr()));
        let mut points = vec![0.0; 3 * count];
        ok(planish_mesh_copy_points(scene.mesh, points.as_mut_ptr(), count));
        assert!(at.iter().zip(&points).all(|(a, b)| (a - b).abs() < 1e-14));
        places.out_faces = faces.as_mut_ptr();
        let status = planish_surface_deviation(scene.surface, scene.mesh, &places, to, count, null_mut());
        refused(status, planish_status::InvalidArgument, -1, &["out_faces"]);
        let back = planish_deviation_options { measure_back: 1, ..record() };
        let back = &raw const back;
        ok(planish_surface_deviation(scene.surface, scene.mesh, back, null_mut(), 0, &raw mut report));
        assert!(report.max_back_distance < 1e-12 && report.back_count > 100, "{report:?}");

        let mut report: planish_deviation_report = canary();
        report.struct_size = size_of::<planish_deviation_report>();
        let to_report = &raw mut report;
        let status = planish_surface_deviation(null(), scene.mesh, null(), to, count, to_report);
        null_refused(status, "surface");
        let status = planish_surface_deviation(scene.surface, null(), null(), to, count, to_report);
        null_refused(status, "mesh");
        let status = planish_surface_deviation(scene.surface, scene.mesh, null(), to, count - 1, to_report);
        refused(status, planish_status::BufferTooSmall, -1, &["out_distances", &count.to_string()]);
        report.struct_size = canary();
        assert_untouched(&report);
    }
}

#[test]
fn surfaces_come_back_from_buffers_and_files() {
    let scene = Scene::new();
    let path = file("saved.planish");
    // SAFETY: all pointers are NULL or live, the buffers have the sizes said.
    unsafe {
        let size = planish_surface_save_size(scene.surface);
        let mut bytes = vec![0_u8; size];
        ok(planish_surface_save(scene.surface, bytes.as_mut_ptr().cast(), size));
        ok(planish_surface_save_file(scene.surface, path.as_ptr()));
        assert_eq!(std::fs::read(path.to_str().unwrap()).unwrap(), bytes);
        let (mut one, mut other) = (null_mut(), null_mut());
        ok(planish_surface_load(bytes.as_ptr().cast(), size, &raw mut one));
        ok(planish_surface_load_file(path.as_ptr(), &raw mut other));
        for loaded in [one, other] {
            let mut again = vec![0_u8; size];
            ok(planish_surface_save(loaded, again.as_mut_ptr().cast(), size));
            assert_eq!(again, bytes);
            planish_surface_free(loaded);
        }
        std::fs::remove_file(path.to_str().unwrap()).unwrap();
    }
}

#[test]
fn damaged_or_missing_bytes_are_refused() {
    let scene = Scene::new();
    let mut loaded: *mut planish_surface = canary();
    // SAFETY: all pointers are NULL or live, the buffers have the sizes said.
    unsafe {
        let size = planish_surface_save_size(scene.surface);
        let mut bytes: Vec<u8> = vec![CANARY; size];
        let status = planish_surface_save(scene.surface, bytes.as_mut_ptr().cast(), size - 1);
        refused(status, planish_status::BufferTooSmall, -1, &["buffer", &size.to_string()]);
        assert!(bytes.iter().all(|&byte| byte == CANARY));
        null_refused(planish_surface_save(scene.surface, null_mut(), size), "buffer");
        null_refused(planish_surface_save(null(), bytes.as_mut_ptr().cast(), size), "surface");
        ok(planish_surface_save(scene.surface, bytes.as_mut_ptr().cast(), size));
        bytes[100] ^= 1;
        let at_sum = size as i64 - 8;
        let status = planish_surface_load(bytes.as_ptr().cast(), size, &raw mut loaded);
        refused(status, planish_status::Format, at_sum, &["checksum"]);
        let status = planish_surface_load(bytes.as_ptr().cast(), 0, &raw mut loaded);
        refused(status, planish_status::Format, 0, &["mark"]);
        null_refused(planish_surface_load(null(), 5, &raw mut loaded), "buffer");
        null_refused(planish_surface_load(bytes.as_ptr().cast(), size, null_mut()), "out_surface");
        let missing = file("no_such_file");
        let status = planish_surface_load_file(missing.as_ptr(), &raw mut loaded);
        refused(status, planish_status::File, -1, &["no_such_file"]);
        null_refused(planish_surface_load_file(null(), &raw mut loaded), "path");
        null_refused(planish_surface_save_file(scene.surface, null()), "path");
        let nowhere = c("/no/such/folder/part.planish");
        refused(
            planish_surface_save_file(scene.surface, nowhere.as_ptr()),
            planish_status::File,
            -1,
            &["folder"],
        );
        assert_eq!(planish_surface_save_size(null()), 0);
    }
    assert_untouched(&loaded);
}

#[test]
fn vtk_files_are_written_or_refused() {
    let scene = Scene::new();
    let path = file("surface.vtu");
    // SAFETY: all pointers are NULL or live.
    unsafe {
        ok(planish_surface_write_vtk(scene.surface, path.as_ptr(), null()));
        let options = planish_vtk_options { deviation_from: scene.mesh, ..record() };
        ok(planish_surface_write_vtk(scene.surface, path.as_ptr(), &raw const options));
        let bytes = std::fs::read(path.to_str().unwrap()).unwrap();
        assert!(String::from_utf8_lossy(&bytes).contains("Name=\"deviation\""));
        std::fs::remove_file(path.to_str().unwrap()).unwrap();
        null_refused(planish_surface_write_vtk(null(), path.as_ptr(), null()), "surface");
        null_refused(planish_surface_write_vtk(scene.surface, null(), null()), "path");
        let options = planish_vtk_options { content: 9, ..record() };
        let status = planish_surface_write_vtk(scene.surface, path.as_ptr(), &raw const options);
        refused(status, planish_status::InvalidArgument, -1, &["content"]);
        let nowhere = c("/no/such/folder/part.vtu");
        let status = planish_surface_write_vtk(scene.surface, nowhere.as_ptr(), null());
        refused(status, planish_status::File, -1, &["folder"]);
    }
}

#[test]
fn step_files_are_written_or_refused() {
    let saddle = SurfaceHandle::saddle();
    let path = file("surface.step");
    let product = c("Fläche");
    let mut report: planish_step_report = record();
    // SAFETY: all pointers are NULL or live.
    unsafe {
        ok(planish_surface_write_step(saddle.0, path.as_ptr(), null()));
        let options = planish_step_options {
            product: product.as_ptr(),
            unit: planish_unit::Inch as u32,
            out_report: &raw mut report,
            ..record()
        };
        ok(planish_surface_write_step(saddle.0, path.as_ptr(), &raw const options));
        assert_eq!((report.loop_count, report.edge_count), (1, 4));
        assert!(report.curve_deviation <= report.uncertainty, "{report:?}");
        let written = std::fs::read_to_string(path.to_str().unwrap()).unwrap();
        assert!(written.contains("'INCH'") && written.contains("Fl\\X2\\00E4\\X0\\che"));
        std::fs::remove_file(path.to_str().unwrap()).unwrap();
        null_refused(planish_surface_write_step(null(), path.as_ptr(), null()), "surface");
        null_refused(planish_surface_write_step(saddle.0, null(), null()), "path");
        null_refused(planish_step_options_init(null_mut(), 56), "options");
        let bad = [
            (planish_step_options { schema: 2, ..record() }, "schema is 2"),
            (planish_step_options { unit: 3, ..record() }, "unit is 3"),
            (planish_step_options { author: c"\xff".as_ptr(), ..record() }, "author is not UTF-8"),
        ];
        for (options, words) in bad {
            let status = planish_surface_write_step(saddle.0, path.as_ptr(), &raw const options);
            let index = if words.starts_with("author") { 0 } else { -1 };
            refused(status, planish_status::InvalidArgument, index, &[words]);
        }
        let other = SurfaceHandle::other_family();
        let status = planish_surface_write_step(other.0, path.as_ptr(), null());
        refused(status, planish_status::WrongKind, -1, &["family"]);
        let nowhere = c("/no/such/folder/part.step");
        let status = planish_surface_write_step(saddle.0, nowhere.as_ptr(), null());
        refused(status, planish_status::File, -1, &["folder"]);
    }
    assert!(!std::path::Path::new(path.to_str().unwrap()).exists());
}
