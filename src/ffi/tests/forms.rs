//! Other forms of a surface: refined, split, reversed, converted, as patches, as files.

use super::*;

/// The value at a parameter pair.
fn point(surface: *const planish_surface, u: f64, v: f64) -> [f64; 3] {
    let (uv, mut out) = ([u, v], [0.0; 3]);
    // SAFETY: one point of three numbers.
    ok(unsafe { planish_surface_eval(surface, uv.as_ptr(), 1, null(), out.as_mut_ptr()) });
    out
}

const U: u32 = planish_axis::U as u32;
const V: u32 = planish_axis::V as u32;

#[test]
fn knots_and_degrees_change_the_net_and_not_the_surface() {
    let saddle = SurfaceHandle::saddle();
    let before = point(saddle.0, 0.3, 0.7);
    // SAFETY: live handles, and arrays of these lengths.
    unsafe {
        ok(planish_tensor_insert_knots(saddle.0, V, [0.25, 0.5].as_ptr(), 2));
        assert_eq!(planish_tensor_control_point_count(saddle.0, V), 4);
        ok(planish_tensor_insert_knots(saddle.0, V, null(), 0));
        ok(planish_tensor_elevate_degree(saddle.0, U, 3));
        assert_eq!(planish_tensor_degree(saddle.0, U), 3);
        let after = point(saddle.0, 0.3, 0.7);
        // convex combinations of numbers up to 1
        assert!(before.iter().zip(after).all(|(a, b)| (a - b).abs() <= 8.0 * f64::EPSILON), "{after:?}");
        ok(planish_tensor_reverse(saddle.0, U));
        let mirrored = point(saddle.0, 0.7, 0.7);
        assert!(
            before.iter().zip(mirrored).all(|(a, b)| (a - b).abs() <= 8.0 * f64::EPSILON),
            "{mirrored:?}"
        );
    }
}

#[test]
fn refused_changes_leave_the_surface_alone() {
    let saddle = SurfaceHandle::saddle();
    let other = SurfaceHandle::other_family();
    // SAFETY: live handles, and arrays of these lengths.
    unsafe {
        null_refused(planish_tensor_insert_knots(null_mut(), U, null(), 0), "surface");
        null_refused(planish_tensor_insert_knots(saddle.0, U, null(), 1), "knots");
        let insert = |knots: &[f64]| planish_tensor_insert_knots(saddle.0, U, knots.as_ptr(), knots.len());
        refused(insert(&[0.5, f64::NAN]), planish_status::NotFinite, 1, &["knot 1"]);
        refused(insert(&[1.5]), planish_status::Outside, -1, &["1.5"]);
        refused(insert(&[0.5, 0.5]), planish_status::InvalidArgument, -1, &["0.5", "tears"]);
        let status = planish_tensor_insert_knots(saddle.0, 2, null(), 0);
        refused(status, planish_status::InvalidArgument, -1, &["axis"]);
        let status = planish_tensor_insert_knots(other.0, U, null(), 0);
        refused(status, planish_status::WrongKind, -1, &["Tensor"]);
        null_refused(planish_tensor_elevate_degree(null_mut(), U, 2), "surface");
        for degree in [0, 10] {
            let status = planish_tensor_elevate_degree(saddle.0, U, degree);
            refused(status, planish_status::InvalidArgument, -1, &["degree"]);
        }
        null_refused(planish_tensor_reverse(null_mut(), U), "surface");
        refused(planish_tensor_reverse(saddle.0, 7), planish_status::InvalidArgument, -1, &["axis"]);
        assert_eq!(planish_surface_coefficient_count(saddle.0), 4);
    }
}

#[test]
fn parts_are_made_or_refused() {
    let saddle = SurfaceHandle::saddle();
    let (mut lower, mut upper): (*mut planish_surface, *mut planish_surface) = (canary(), canary());
    // SAFETY: live handles.
    unsafe {
        null_refused(planish_tensor_split(null(), U, 0.5, &mut lower, &mut upper), "surface");
        null_refused(planish_tensor_split(saddle.0, U, 0.5, null_mut(), &mut upper), "out_lower");
        null_refused(planish_tensor_split(saddle.0, U, 0.5, &mut lower, null_mut()), "out_upper");
        for at in [0.0, 1.0, f64::NAN] {
            let status = planish_tensor_split(saddle.0, U, at, &mut lower, &mut upper);
            refused(status, planish_status::Outside, -1, &["outside"]);
        }
        assert_untouched(&lower);
        assert_untouched(&upper);
        ok(planish_tensor_split(saddle.0, U, 0.25, &mut lower, &mut upper));
        let (lower, upper) = (SurfaceHandle(lower), SurfaceHandle(upper));
        assert_eq!(point(lower.0, 0.25, 0.5), point(upper.0, 0.25, 0.5));
        let mut domain = [0.0; 4];
        ok(planish_surface_domain(upper.0, domain.as_mut_ptr()));
        assert_eq!(domain, [0.25, 1.0, 0.0, 1.0]);
    }
}

#[test]
fn patches_are_copied_in_two_calls() {
    let saddle = SurfaceHandle::saddle();
    let other = SurfaceHandle::other_family();
    let mut patch: planish_patch = record();
    let mut ordinates = [0.0; 12];
    // SAFETY: live handles, and arrays of these lengths.
    unsafe {
        ok(planish_tensor_insert_knots(saddle.0, U, [0.5].as_ptr(), 1));
        assert_eq!(planish_surface_patch_count(saddle.0), 2);
        assert_eq!(planish_surface_patch_at(saddle.0, 0.9, 0.1), 1);
        assert_eq!((planish_surface_patch_count(null()), planish_surface_patch_count(other.0)), (0, 0));
        ok(planish_surface_copy_patch(saddle.0, 1, &mut patch, null_mut(), 0));
        assert_eq!((patch.u_min, patch.u_max, patch.v_min, patch.v_max), (0.5, 1.0, 0.0, 1.0));
        assert_eq!((patch.degree_u, patch.degree_v, patch.is_rational), (1, 1, 0));
        assert_eq!((patch.ordinate_count, patch.ordinate_width), (4, 3));
        ok(planish_surface_copy_patch(saddle.0, 1, null_mut(), ordinates.as_mut_ptr(), 4));
        assert_eq!(ordinates, [0.5, 0., 0., 0.5, 1., 0.5, 1., 0., 0., 1., 1., 1.]);
        patch = canary();
        patch.struct_size = size_of::<planish_patch>();
        let to = ordinates.as_mut_ptr();
        let status = planish_surface_copy_patch(saddle.0, 1, &mut patch, to, 3);
        refused(status, planish_status::BufferTooSmall, -1, &["out_ordinates", "3", "4"]);
        let status = planish_surface_copy_patch(saddle.0, 2, &mut patch, to, 4);
        refused(status, planish_status::Index, 2, &["patch 2"]);
        let status = planish_surface_copy_patch(other.0, 0, &mut patch, to, 4);
        refused(status, planish_status::WrongKind, -1, &["no patches"]);
        null_refused(planish_surface_copy_patch(null(), 0, &mut patch, to, 4), "surface");
        assert_untouched(&patch.u_min);
    }
}

#[test]
fn conversion_keeps_to_its_limit() {
    let saddle = SurfaceHandle::saddle();
    let mut made: *mut planish_surface = canary();
    // SAFETY: live handles.
    unsafe {
        let options = planish_convert_options { max_coefficients: 3, ..record() };
        let status = planish_surface_to_tensor(saddle.0, &raw const options, &mut made);
        refused(status, planish_status::TooLarge, -1, &["4", "3"]);
        null_refused(planish_surface_to_tensor(null(), null(), &mut made), "surface");
        let other = SurfaceHandle::other_family();
        let status = planish_surface_to_tensor(other.0, null(), &mut made);
        refused(status, planish_status::WrongKind, -1, &[]);
        null_refused(planish_convert_options_init(null_mut(), 16), "options");
        assert_untouched(&made);
        null_refused(planish_surface_to_tensor(saddle.0, null(), null_mut()), "out_surface");
        ok(planish_surface_to_tensor(saddle.0, null(), &mut made));
        let made = SurfaceHandle(made);
        assert_eq!(point(made.0, 0.3, 0.6), point(saddle.0, 0.3, 0.6));
    }
}

#[test]
fn a_tessellation_reports_its_quality() {
    let saddle = SurfaceHandle::saddle();
    let mut report: planish_tessellate_report = record();
    let mut mesh = null_mut();
    // SAFETY: live handles.
    unsafe {
        let mut options: planish_tessellate_options = record();
        options.out_report = &raw mut report;
        options.max_edge_length = 0.2;
        ok(planish_surface_tessellate(saddle.0, &raw const options, &mut mesh));
    }
    let _mesh = MeshHandle(mesh);
    // z = x y over a square in Delaunay triangles: none is a needle
    assert!(
        report.smallest_angle > 0.3 && report.smallest_angle <= std::f64::consts::FRAC_PI_3,
        "{report:?}"
    );
    assert!(report.chord_error > 0.0 && report.chord_error <= 1e-3 * 3f64.sqrt(), "{report:?}");
}

#[test]
fn vtk_files_hold_what_was_asked_for() {
    let saddle = SurfaceHandle::saddle();
    let other = SurfaceHandle::other_family();
    let path = std::env::temp_dir().join(format!("planish-forms-{}.vtu", std::process::id()));
    let name = c(path.to_str().unwrap());
    let write = |surface: &SurfaceHandle, content: u32| {
        let options = planish_vtk_options { content, ..record() };
        // SAFETY: live handles.
        unsafe { planish_surface_write_vtk(surface.0, name.as_ptr(), &raw const options) }
    };
    for (content, array) in [
        (planish_vtk_content::Patches, "HigherOrderDegrees"),
        (planish_vtk_content::ControlNet, "connectivity"),
    ] {
        ok(write(&saddle, content as u32));
        let text = String::from_utf8_lossy(&std::fs::read(&path).unwrap()).into_owned();
        assert!(text.contains(array), "{text}");
        std::fs::remove_file(&path).unwrap();
        refused(write(&other, content as u32), planish_status::WrongKind, -1, &["Pht"]);
    }
    refused(write(&saddle, 3), planish_status::InvalidArgument, -1, &["content"]);
    assert!(!path.exists());
}
