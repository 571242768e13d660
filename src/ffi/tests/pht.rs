//! PHT-splines through the C ABI.

use super::*;

/// A field over the unit square of seven cells, data zero.
fn seven_cells(dim: usize, is_rational: u32) -> SurfaceHandle {
    let (lines, cells) = ([0.0, 1.0], [0_u32, 0, 0, 1, 0, 0]);
    let mut out = null_mut();
    let l = lines.as_ptr();
    // SAFETY: arrays of these lengths.
    ok(unsafe { planish_pht_new(dim, is_rational, l, 2, l, 2, cells.as_ptr(), 2, null(), 0, &mut out) });
    SurfaceHandle(out)
}

fn value(surface: &SurfaceHandle, u: f64, v: f64) -> f64 {
    let (uv, mut out) = ([u, v], [0.0]);
    // SAFETY: one point of one number.
    ok(unsafe { planish_surface_eval(surface.0, uv.as_ptr(), 1, null(), out.as_mut_ptr()) });
    out[0]
}

#[test]
fn the_worked_example_goes_in_and_out() {
    let surface = seven_cells(1, 0);
    let s = surface.0;
    // SAFETY: live handles, and arrays of these lengths.
    unsafe {
        assert_eq!(planish_surface_kind(s), planish_kind::Pht as u32);
        assert_eq!((planish_pht_cell_count(s), planish_pht_vertex_count(s)), (7, 12));
        assert_eq!((planish_pht_hanging_count(s), planish_pht_width(s)), (2, 1));
        assert_eq!(planish_surface_coefficient_count(s), 48);
        let (mut cells, mut uv) = ([0_u32; 21], [0.0; 24]);
        ok(planish_pht_copy_cells(s, cells.as_mut_ptr(), 7));
        assert_eq!(cells[..6], [2, 0, 0, 2, 0, 1]);
        ok(planish_pht_copy_vertices(s, uv.as_mut_ptr(), 12));
        let middle = uv.chunks_exact(2).position(|uv| uv == [0.5, 0.5]).unwrap();
        let (mut hanging, mut hosts) = ([0.0; 4], [9_u32; 2]);
        ok(planish_pht_copy_hanging(s, hanging.as_mut_ptr(), hosts.as_mut_ptr(), 2));
        assert_eq!((hanging, hosts), ([0.25, 0.5, 0.5, 0.25], [4, 5]));
        let (mut near, mut count) = ([0_u32; 8], 0);
        ok(planish_pht_copy_neighbours(s, 4, null_mut(), 0, &mut count));
        assert_eq!(count, 3);
        ok(planish_pht_copy_neighbours(s, 4, near.as_mut_ptr(), 8, &mut count));
        assert_eq!(near[..count], [6, 1, 3]);
        assert_eq!(planish_pht_cell_at(s, 0.3, 0.3), 3);

        ok(planish_pht_set_data(s, [middle as u32].as_ptr(), 1, [1.0, 0.0, 0.0, 0.0].as_ptr()));
        assert!((value(&surface, 0.375, 0.375) - 19.0 / 32.0).abs() <= 4.0 * f64::EPSILON);
        let mut points = [0.0; 48];
        for basis in [planish_pht_basis::Canonical, planish_pht_basis::SupportSized] {
            ok(planish_pht_copy_control_points(s, basis as u32, points.as_mut_ptr(), 12));
            assert_eq!(points[4 * middle..][..4], [1.0; 4]);
            ok(planish_pht_set_control_points(
                s,
                [middle as u32].as_ptr(),
                1,
                basis as u32,
                [2.0; 4].as_ptr(),
            ));
            assert!((value(&surface, 0.375, 0.375) - 19.0 / 16.0).abs() <= 8.0 * f64::EPSILON);
            ok(planish_pht_set_data(s, [middle as u32].as_ptr(), 1, [1.0, 0.0, 0.0, 0.0].as_ptr()));
        }
        let mut data = [0.0; 48];
        ok(planish_pht_copy_data(s, data.as_mut_ptr(), 12));
        assert_eq!(data[4 * middle..][..4], [1.0, 0.0, 0.0, 0.0]);

        let (mut vertices, mut matrix) = ([0_u32; 12], [0.0; 16 * 48]);
        ok(planish_pht_copy_extraction(s, 3, 0, vertices.as_mut_ptr(), matrix.as_mut_ptr(), 12, &mut count));
        ok(planish_pht_copy_control_points(s, 0, points.as_mut_ptr(), 12));
        let row = |r: usize| {
            let numbers = matrix[4 * count * r..][..4 * count].iter().enumerate();
            numbers.map(|(c, share)| share * points[4 * vertices[c / 4] as usize + c % 4]).sum::<f64>()
        };
        let expected = [0., 0., 0.5, 0.5, 0., 0., 0.75, 0.75, 0.5, 0.75, 1., 1., 0.5, 0.75, 1., 1.];
        assert!((0..16).all(|r| (row(r) - expected[r]).abs() <= 16.0 * f64::EPSILON));
    }
}

#[test]
fn splits_are_undone_and_simplification_says_how_far_it_went() {
    let surface = seven_cells(1, 0);
    let s = surface.0;
    // SAFETY: live handles, and arrays of these lengths.
    unsafe {
        ok(planish_pht_set_data(s, [5].as_ptr(), 1, [0.1, 0.2, 0.3, 0.4].as_ptr()));
        let before = value(&surface, 0.3, 0.6);
        let cells = [1_u32, 0, 1, 2, 0, 2];
        ok(planish_pht_split(s, cells.as_ptr(), 2));
        assert_eq!(planish_pht_cell_count(s), 13);
        assert!((value(&surface, 0.3, 0.6) - before).abs() <= 4.0 * f64::EPSILON);
        let back = [2_u32, 0, 2, 1, 0, 1];
        ok(planish_pht_merge(s, back.as_ptr(), 2));
        assert_eq!((planish_pht_cell_count(s), value(&surface, 0.3, 0.6)), (7, before));
        ok(planish_pht_refine_region(s, [0.6, 0.7, 0.6, 0.7].as_ptr(), 3, 100));
        assert_eq!(planish_pht_cell_count(s), 13);
        let mut deviation = -1.0;
        ok(planish_pht_simplify(s, 1e-12, null(), &mut deviation));
        assert!((0.0..=1e-12).contains(&deviation) && planish_pht_cell_count(s) <= 7, "{deviation}");
        ok(planish_pht_simplify(s, 10.0, null(), null_mut()));
        assert_eq!(planish_pht_cell_count(s), 1);
    }
}

#[test]
fn conversions_keep_the_surface() {
    let saddle = SurfaceHandle::saddle();
    // SAFETY: live handles, and arrays of these lengths.
    unsafe {
        ok(planish_tensor_elevate_degree(saddle.0, 0, 2));
        ok(planish_tensor_elevate_degree(saddle.0, 1, 3));
        let mut out = null_mut();
        ok(planish_pht_from_surface(saddle.0, null(), &mut out));
        let pht = SurfaceHandle(out);
        assert_eq!((planish_pht_cell_count(pht.0), planish_surface_dim(pht.0)), (1, 3));
        ok(planish_pht_split(pht.0, [0_u32, 0, 0, 1, 1, 1].as_ptr(), 2));
        let mut out = null_mut();
        ok(planish_surface_to_tensor(pht.0, null(), &mut out));
        let tensor = SurfaceHandle(out);
        let (mut a, mut b) = ([0.0; 3], [0.0; 3]);
        ok(planish_surface_eval(tensor.0, [0.7, 0.9].as_ptr(), 1, null(), a.as_mut_ptr()));
        ok(planish_surface_eval(saddle.0, [0.7, 0.9].as_ptr(), 1, null(), b.as_mut_ptr()));
        assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 16.0 * f64::EPSILON), "{a:?} {b:?}");

        let mut count = 0;
        ok(planish_pht_to_tensor_patches(pht.0, null(), null_mut(), 0, &mut count));
        let mut handles = vec![null_mut(); count];
        let short = planish_pht_to_tensor_patches(pht.0, null(), handles.as_mut_ptr(), count - 1, &mut count);
        refused(short, planish_status::BufferTooSmall, -1, &["out_surfaces"]);
        assert!(handles.iter().all(|handle| handle.is_null()));
        ok(planish_pht_to_tensor_patches(pht.0, null(), handles.as_mut_ptr(), count, &mut count));
        let patches: Vec<SurfaceHandle> = handles.into_iter().map(SurfaceHandle).collect();
        assert!(count > 1 && patches.iter().all(|patch| planish_surface_kind(patch.0) == 1));

        // saved and loaded
        let size = planish_surface_save_size(pht.0);
        let mut bytes = vec![0_u8; size];
        ok(planish_surface_save(pht.0, bytes.as_mut_ptr().cast(), size));
        let mut out = null_mut();
        ok(planish_surface_load(bytes.as_ptr().cast(), size, &mut out));
        let loaded = SurfaceHandle(out);
        assert_eq!(planish_pht_cell_count(loaded.0), 7);
    }
}

#[test]
fn two_surfaces_are_stitched() {
    let (a, b) = (seven_cells(1, 0), seven_cells(1, 0));
    // SAFETY: live handles, and arrays of these lengths.
    unsafe {
        ok(planish_pht_set_data(a.0, [0].as_ptr(), 1, [1.0, 0.0, 0.0, 0.0].as_ptr()));
        let (low, high) = (planish_border_side::LowU as u32, planish_border_side::HighU as u32);
        ok(planish_pht_stitch(a.0, low, b.0, high, 0));
        assert_eq!((value(&a, 0.0, 0.1), value(&a, 0.0, 0.0)), (value(&b, 1.0, 0.1), 0.5));
        refused(planish_pht_stitch(a.0, low, a.0, high, 0), planish_status::InvalidArgument, -1, &["second"]);
        refused(
            planish_pht_stitch(a.0, 4, b.0, high, 0),
            planish_status::InvalidArgument,
            -1,
            &["first_side"],
        );
        null_refused(planish_pht_stitch(null_mut(), low, b.0, high, 0), "first");
        let other = seven_cells(2, 0);
        let status = planish_pht_stitch(a.0, low, other.0, high, 0);
        refused(status, planish_status::InvalidArgument, -1, &["dimensions"]);
    }
}

#[test]
fn fits_fill_the_report() {
    let sheet = Sheet::new(33);
    let mesh = sheet.mesh();
    let mapped = sheet.mesh_with_parameters();
    let count = sheet.count();
    let (mut errors, mut report): (Vec<f64>, planish_fit_report) = (vec![0.0; count], record());
    let options = planish_pht_options { out_errors: errors.as_mut_ptr(), ..record() };
    let mut out = null_mut();
    // SAFETY: live handles, and arrays of these lengths.
    unsafe {
        ok(planish_pht_fit(mesh.0, &options, &mut out, &mut report));
        let surface = SurfaceHandle(out);
        assert!(report.max_error <= report.tolerance, "{report:?}");
        assert_eq!(errors[report.worst_index], report.max_error);
        assert_eq!(report.cell_count, planish_pht_cell_count(surface.0));
        assert_eq!(report.coefficient_count, planish_surface_coefficient_count(surface.0));
        assert!(report.deepest_level > 0 && report.rough_cell_count == 0);
        assert_eq!(planish_surface_trim_count(surface.0), 1);

        let mut out = null_mut();
        let values: Vec<f64> = sheet.points.chunks_exact(3).map(|p| p[2]).collect();
        let (uv, v) = (sheet.uv.as_ptr(), values.as_ptr());
        ok(planish_pht_fit_points(uv, v, count, 1, null(), &mut out, &mut report));
        let field = SurfaceHandle(out);
        assert_eq!((planish_surface_dim(field.0), report.stretch), (1, 0.0));
        let mut out = null_mut();
        ok(planish_pht_fit_field(mapped.0, v, count, 1, null(), &mut out, null_mut()));
        drop(SurfaceHandle(out));
        let mut out = canary();
        let status = planish_pht_fit_field(mapped.0, v, count - 1, 1, null(), &mut out, null_mut());
        refused(status, planish_status::InvalidArgument, -1, &["nodes"]);
        for (options, word) in [
            (planish_pht_options { estimator: 3, ..record() }, "estimator"),
            (planish_pht_options { regularize: 3, ..record() }, "regularize"),
            (planish_pht_options { tolerance_scale: 2, ..record() }, "tolerance_scale"),
            (planish_pht_options { max_level: 21, ..record() }, "max_level"),
            (planish_pht_options { measure_distance: 2, ..record() }, "measure_distance"),
            (planish_pht_options { missing: 1, ..record() }, "missing"),
            (planish_pht_options { symmetry: 3, ..record() }, "symmetry"),
        ] {
            let status = planish_pht_fit(mesh.0, &options, &mut out, null_mut());
            refused(status, planish_status::InvalidArgument, -1, &[word]);
        }
        let newer = planish_pht_options { reserved_end: 1, ..record() };
        let status = planish_pht_fit(mesh.0, &newer, &mut out, null_mut());
        refused(status, planish_status::Version, -1, &["reserved"]);
        null_refused(planish_pht_fit(null(), null(), &mut out, null_mut()), "mesh");
        null_refused(planish_pht_fit(mesh.0, null(), null_mut(), null_mut()), "out_surface");
        assert_untouched(&out);
    }
}

#[test]
fn bad_parts_are_no_pht_spline() {
    use planish_status::*;
    let mut out = canary();
    let make = |lines: &[f64], cells: &[u32], data: &[f64], dim, is_rational, out| {
        let l = lines.as_ptr();
        let data_at = if data.is_empty() { null() } else { data.as_ptr() };
        let (n, c) = (lines.len(), cells.len() / 3);
        // SAFETY: arrays of these lengths.
        unsafe { planish_pht_new(dim, is_rational, l, n, l, n, cells.as_ptr(), c, data_at, data.len(), out) }
    };
    let out = &mut out;
    let line = [0.0, 1.0];
    refused(make(&[0.0, 0.0], &[], &[], 1, 0, out), InvalidArgument, 1, &["knot 1 in U"]);
    refused(make(&[0.0, f64::NAN], &[], &[], 1, 0, out), NotFinite, 1, &["knot 1 in U"]);
    refused(make(&[0.0], &[], &[], 1, 0, out), InvalidArgument, -1, &["1 knots"]);
    refused(make(&line, &[0, 0, 0, 1, 2, 0], &[], 1, 0, out), Index, 1, &["cell 1", "level 1, 2, 0"]);
    refused(make(&line, &[], &[0.0; 15], 1, 0, out), InvalidArgument, -1, &["15", "16"]);
    refused(make(&line, &[], &[], 0, 0, out), InvalidArgument, -1, &["dimension is 0"]);
    refused(make(&line, &[], &[], 1, 2, out), InvalidArgument, -1, &["is_rational"]);
    refused(make(&line, &[], &[0.0; 32], 1, 1, out), InvalidArgument, 0, &["weight in leaf 0"]);
    let mut data = [0.0; 16];
    data[13] = f64::INFINITY;
    refused(make(&line, &[], &data, 1, 0, out), NotFinite, 3, &["vertex 3"]);
    let deep: Vec<u32> = (0..=20).flat_map(|level| [level, 0, 0]).collect();
    refused(make(&line, &deep, &[], 1, 0, out), TooLarge, 20, &["level 20"]);
    assert_untouched(out);
}

#[test]
fn refused_changes_leave_the_surface_alone() {
    use planish_status::*;
    let surface = seven_cells(1, 0);
    let (saddle, s) = (SurfaceHandle::saddle(), surface.0);
    let missing = [1_u32, 0, 1, 1, 0, 0];
    let (mut count, mut numbers): (usize, [f64; 4]) = (canary(), canary());
    // SAFETY: live handles, and arrays of these lengths.
    unsafe {
        refused(planish_pht_split(s, missing.as_ptr(), 2), Index, 1, &["cell 1"]);
        refused(planish_pht_merge(s, missing.as_ptr(), 1), Index, 0, &["cell 0"]);
        refused(planish_pht_simplify(s, -1.0, null(), numbers.as_mut_ptr()), InvalidArgument, -1, &["-1"]);
        refused(planish_pht_set_data(s, [12].as_ptr(), 1, [0.0; 4].as_ptr()), Index, 12, &["vertex 12"]);
        let bad = [0.0, f64::NAN, 0.0, 0.0];
        refused(planish_pht_set_data(s, [3].as_ptr(), 1, bad.as_ptr()), NotFinite, 3, &["vertex 3"]);
        let status = planish_pht_refine_region(s, [0.0, 1.0, 0.0, 1.0].as_ptr(), 5, 20);
        refused(status, TooLarge, -1, &["20"]);
        refused(planish_pht_copy_cells(s, null_mut(), 6), BufferTooSmall, -1, &["out_cells"]);
        let status = planish_pht_copy_neighbours(s, 7, null_mut(), 0, &mut count);
        refused(status, Index, 7, &["cell 7"]);
        let status = planish_pht_copy_extraction(s, 0, 2, null_mut(), null_mut(), 0, &mut count);
        refused(status, InvalidArgument, -1, &["basis"]);
        assert_eq!((planish_pht_cell_count(s), value(&surface, 0.5, 0.5)), (7, 0.0));

        let wrong = |status| refused(status, WrongKind, -1, &["Tensor", "Pht"]);
        let (t, n) = (saddle.0, numbers.as_mut_ptr());
        wrong(planish_pht_split(t, missing.as_ptr(), 1));
        wrong(planish_pht_merge(t, missing.as_ptr(), 1));
        wrong(planish_pht_simplify(t, 1.0, null(), null_mut()));
        wrong(planish_pht_refine_region(t, [0.0; 4].as_ptr(), 1, 9));
        wrong(planish_pht_copy_data(t, n, 1));
        wrong(planish_pht_set_data(t, [0].as_ptr(), 1, n));
        wrong(planish_pht_copy_vertices(t, n, 2));
        wrong(planish_pht_copy_hanging(t, n, null_mut(), 2));
        wrong(planish_pht_copy_control_points(t, 0, n, 1));
        wrong(planish_pht_set_control_points(t, [0].as_ptr(), 1, 0, n));
        wrong(planish_pht_to_tensor_patches(t, null(), null_mut(), 0, &mut count));
        assert_eq!((planish_pht_cell_count(t), planish_pht_vertex_count(t)), (0, 0));
        assert_eq!(
            (planish_pht_hanging_count(t), planish_pht_width(t), planish_pht_cell_at(t, 0., 0.)),
            (0, 0, 0)
        );
        let mut out = canary();
        let status = planish_pht_from_surface(s, null(), &mut out);
        refused(status, WrongKind, -1, &["Tensor"]);
        let options = planish_pht_convert_options { tolerance: f64::NAN, ..record() };
        let status = planish_pht_from_surface(t, &options, &mut out);
        refused(status, InvalidArgument, -1, &["tolerance"]);
        assert_untouched(&out);
        null_refused(planish_pht_split(null_mut(), null(), 0), "surface");
        null_refused(planish_pht_split(s, null(), 1), "cells");
        null_refused(planish_pht_refine_region(s, null(), 1, 9), "region");
        null_refused(planish_pht_copy_neighbours(s, 0, null_mut(), 0, null_mut()), "out_count");
    }
    assert_untouched(&count);
    assert_untouched(&numbers);
}
