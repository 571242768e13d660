//! D1RC-splines through the C ABI.

use super::*;

/// The sheet of n by n nodes as a surface.
fn sheet(n: u32, options: &planish_d1rc_options) -> SurfaceHandle {
    let mesh = Sheet::new(n).mesh_with_parameters();
    let mut out = null_mut();
    // SAFETY: a live mesh and whole options.
    ok(unsafe { planish_d1rc_new(mesh.0, options, &mut out) });
    SurfaceHandle(out)
}

fn point(surface: &SurfaceHandle, u: f64, v: f64) -> [f64; 3] {
    let (uv, mut out) = ([u, v], [0.0; 3]);
    // SAFETY: one point of three numbers.
    ok(unsafe { planish_surface_eval(surface.0, uv.as_ptr(), 1, null(), out.as_mut_ptr()) });
    out
}

#[test]
fn a_surface_keeps_the_plane_and_moves_where_it_is_pulled() {
    let surface = sheet(8, &record());
    let s = surface.0;
    let at = point(&surface, 0.4, 0.7);
    assert!((at[0] - 0.4).abs() <= 1e-14 && (at[1] - 0.7).abs() <= 1e-14, "{at:?}");
    // SAFETY: live handles, and arrays of these lengths.
    unsafe {
        assert_eq!(planish_surface_kind(s), planish_kind::D1rc as u32);
        assert_eq!((planish_d1rc_degree(s), planish_surface_coefficient_count(s)), (3, 64));
        let vertex = 8 * 3 + 4;
        let mut share = [0.0];
        ok(planish_d1rc_blending_values(s, vertex, [0.4, 0.7].as_ptr(), 1, share.as_mut_ptr()));
        let mut points = [0.0; 192];
        ok(planish_d1rc_copy_control_points(s, points.as_mut_ptr(), 64));
        let first = 3 * vertex as usize;
        let raised = [points[first], points[first + 1], points[first + 2] + 2.0];
        ok(planish_d1rc_set_control_points(s, &vertex, 1, raised.as_ptr()));
        let moved = point(&surface, 0.4, 0.7);
        // one sum of shares against another
        assert!((moved[2] - at[2] - 2.0 * share[0]).abs() <= 1e-14 && share[0] > 0.01, "{moved:?} {share:?}");
        let (mut faces, mut count) = ([u32::MAX; 98], 0);
        ok(planish_d1rc_copy_influence(s, vertex, null_mut(), 0, &mut count));
        assert!(count > 6 && count < 98, "{count}");
        ok(planish_d1rc_copy_influence(s, vertex, faces.as_mut_ptr(), count, &mut count));
        assert!(faces[..count].is_sorted() && faces[count..].iter().all(|&face| face == u32::MAX));
    }
}

#[test]
fn sharp_edges_change_on_a_live_surface() {
    let surface = sheet(7, &record());
    let s = surface.0;
    let crease: Vec<u32> = (0..6).flat_map(|j| [21 + j, 22 + j]).collect();
    let edges = [21, 22, 22, 29, 36, 37_u32];
    let mut orders = [9; 3];
    // SAFETY: live handles, and arrays of these lengths.
    unsafe {
        ok(planish_d1rc_edge_continuity(s, edges.as_ptr(), 3, orders.as_mut_ptr()));
        assert_eq!(orders, [2, 2, 2]);
        ok(planish_d1rc_set_sharp_edges(s, crease.as_ptr(), 6, [40].as_ptr(), 1));
        ok(planish_d1rc_edge_continuity(s, edges.as_ptr(), 3, orders.as_mut_ptr()));
        assert_eq!(orders, [0, 0, 2]); // the crease, an edge that touches it, one beside it
        let (mut back, mut count) = ([0_u32; 12], 0);
        ok(planish_d1rc_copy_sharp_edges(s, null_mut(), 0, &mut count));
        assert_eq!(count, 6);
        ok(planish_d1rc_copy_sharp_edges(s, back.as_mut_ptr(), 6, &mut count));
        assert_eq!(back[..], crease[..]);
        // the corner is interpolated
        let mut points = [0.0; 147];
        ok(planish_d1rc_copy_control_points(s, points.as_mut_ptr(), 49));
        let at = point(&surface, 5.0 / 6.0, 5.0 / 6.0);
        assert!((at[2] - points[3 * 40 + 2]).abs() <= 1e-14, "{at:?}");
    }
}

#[test]
fn configurations_come_in_whole() {
    let surface = sheet(5, &planish_d1rc_options { degree: 2, ..record() });
    let s = surface.0;
    // SAFETY: live handles, and arrays of these lengths.
    unsafe {
        let knot_count = planish_d1rc_knot_count(s);
        assert_eq!(knot_count, 25 + 2 * 16); // two rings of clones
        let mut uv = vec![f64::NAN; 2 * knot_count];
        ok(planish_d1rc_copy_knots(s, uv.as_mut_ptr(), knot_count));
        assert!(uv[..50] == Sheet::new(5).uv[..] && uv.iter().all(|x| x.is_finite()));
        for index in 0..planish_d1rc_configuration_count(s) {
            let (mut knots, mut edges, mut count) = ([u32::MAX; 2], [0_u32; 64], 0);
            ok(planish_d1rc_copy_configuration(s, index, knots.as_mut_ptr(), null_mut(), 0, &mut count));
            ok(planish_d1rc_copy_configuration(s, index, null_mut(), edges.as_mut_ptr(), count, &mut count));
            // closed: every knot that an edge leaves is the end of another
            let pairs = || edges[..2 * count].chunks_exact(2);
            assert!(count >= 3 && pairs().all(|from| pairs().any(|to| to[1] == from[0])), "{index}");
            assert!(knots.iter().all(|&knot| (knot as usize) < knot_count), "{index}");
        }
    }
}

#[test]
fn meshes_without_parameters_get_them() {
    let mesh = Sheet::new(6).mesh();
    let mut out = null_mut();
    // SAFETY: a live mesh.
    ok(unsafe { planish_d1rc_new(mesh.0, null(), &mut out) });
    drop(SurfaceHandle(out));
}

#[test]
fn a_surface_without_patches_takes_the_common_calls() {
    let surface = sheet(7, &planish_d1rc_options { sharp_angle: 0.6, ..record() });
    let s = surface.0;
    let folder = std::env::temp_dir().join(format!("planish_d1rc_{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let path = |name: &str| c(folder.join(name).to_str().unwrap());
    // SAFETY: live handles, and arrays of these lengths.
    unsafe {
        let mut mesh = null_mut();
        ok(planish_surface_tessellate(s, null(), &mut mesh));
        assert!(planish_mesh_point_count(mesh) >= 49);
        let mut report: planish_deviation_report = record();
        ok(planish_surface_deviation(s, mesh, null(), null_mut(), 0, &mut report));
        // nodes of the surface itself
        assert!(report.max_distance <= 1e-9, "{}", report.max_distance);
        planish_mesh_free(mesh);
        let at = point(&surface, 0.31, 0.62);
        let (mut uv, mut distance) = ([0.0; 2], [f64::NAN]);
        ok(planish_surface_project(s, at.as_ptr(), 1, null(), uv.as_mut_ptr(), distance.as_mut_ptr()));
        assert!((uv[0] - 0.31).hypot(uv[1] - 0.62) <= 1e-7 && distance[0] <= 1e-9, "{uv:?} {distance:?}");
        // beside the surface the search is a local one, and says so
        let beside = [at[0], at[1], at[2] + 0.01];
        let mut flags = [0u8];
        let options = planish_project_options { out_flags: flags.as_mut_ptr(), ..record() };
        let status =
            planish_surface_project(s, beside.as_ptr(), 1, &options, null_mut(), distance.as_mut_ptr());
        assert_eq!((status, flags[0]), (planish_status::NotProven, planish_flag::NotProven as u8));
        ok(planish_surface_write_vtk(s, path("sheet.vtu").as_ptr(), null()));
        let patches = planish_vtk_options { content: 1, ..record() };
        let status = planish_surface_write_vtk(s, path("none.vtu").as_ptr(), &patches);
        refused(status, planish_status::WrongKind, -1, &["no patches"]);
        let smooth = sheet(7, &record());
        let step = planish_step_options { tolerance: 1e-2, ..record() };
        ok(planish_surface_write_step(smooth.0, path("sheet.step").as_ptr(), &step));
        let mut bytes = vec![0_u8; planish_surface_save_size(s)];
        ok(planish_surface_save(s, bytes.as_mut_ptr().cast(), bytes.len()));
        let mut loaded = null_mut();
        ok(planish_surface_load(bytes.as_ptr().cast(), bytes.len(), &mut loaded));
        let loaded = SurfaceHandle(loaded);
        assert_eq!(point(&loaded, 0.31, 0.62), at);
    }
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn points_beside_a_round_domain_are_outside() {
    // the sheet without the corner at the origin: a domain that is no rectangle
    let mut source = Sheet::new(6);
    source.triangles.drain(..6);
    let mesh = source.mesh_with_parameters();
    let mut out = null_mut();
    // SAFETY: live handles, and arrays of these lengths.
    unsafe {
        ok(planish_d1rc_new(mesh.0, null(), &mut out));
        let surface = SurfaceHandle(out);
        let (inside, beside) = ([0.5, 0.5, 0.3, 0.1], [0.5, 0.5, 0.01, 0.01]);
        let mut values: [f64; 6] = canary();
        let s = surface.0;
        let status = planish_surface_eval(s, beside.as_ptr(), 2, null(), values.as_mut_ptr());
        refused(status, planish_status::Outside, 1, &["point 1", "0.01"]);
        assert_untouched(&values);
        ok(planish_surface_eval(s, inside.as_ptr(), 2, null(), values.as_mut_ptr()));
        let mut flags = [9_u8; 2];
        let options = planish_eval_options { outside: 1, out_flags: flags.as_mut_ptr(), ..record() };
        let status = planish_surface_eval(s, beside.as_ptr(), 2, &options, values.as_mut_ptr());
        assert_eq!(status, planish_status::PointsOutside);
        assert!(flags[0] == 0 && flags[1] & 1 == 1 && values[0].is_finite() && values[3].is_nan());
        let mut share: [f64; 2] = canary();
        let status = planish_d1rc_blending_values(s, 20, beside.as_ptr(), 2, share.as_mut_ptr());
        refused(status, planish_status::Outside, 1, &["point 1"]);
        let status = planish_d1rc_blending_values(s, 20, [f64::NAN, 0.5].as_ptr(), 1, share.as_mut_ptr());
        refused(status, planish_status::NotFinite, 0, &["point 0"]);
        assert_untouched(&share);
    }
}

#[test]
fn bad_control_meshes_and_options_are_refused() {
    use planish_status::*;
    let mut out: *mut planish_surface = canary();
    let good = Sheet::new(5);
    let with = |source: &Sheet, options: planish_d1rc_options, out: &mut _| {
        let mesh = source.mesh_with_parameters();
        // SAFETY: a live mesh and whole options.
        unsafe { planish_d1rc_new(mesh.0, &options, out) }
    };
    let edges = |edges: &'static [u32]| planish_d1rc_options {
        sharp_edges: edges.as_ptr(),
        sharp_edge_count: edges.len() / 2,
        ..record()
    };
    let out = &mut out;
    for (options, status, index, word) in [
        (planish_d1rc_options { degree: 4, ..record() }, InvalidArgument, -1, "degree is 4"),
        (planish_d1rc_options { degree: 0, ..record() }, InvalidArgument, -1, "degree is 0"),
        (planish_d1rc_options { mode: 2, ..record() }, InvalidArgument, -1, "mode is 2"),
        (planish_d1rc_options { boundary: 3, ..record() }, InvalidArgument, -1, "boundary is 3"),
        (planish_d1rc_options { sharp: 4, ..record() }, InvalidArgument, -1, "sharp is 4"),
        (planish_d1rc_options { sharp: 2, ..record() }, InvalidArgument, -1, "sector"),
        (planish_d1rc_options { sharp: 1, mode: 1, ..record() }, InvalidArgument, -1, "cut"),
        (planish_d1rc_options { sharp_weight: 0.0, ..record() }, InvalidArgument, -1, "weight is 0"),
        (planish_d1rc_options { sharp_weight: f64::NAN, ..record() }, NotFinite, -1, "weight is NaN"),
        (planish_d1rc_options { sharp_angle: 4.0, ..record() }, InvalidArgument, -1, "angle is 4"),
        (planish_d1rc_options { sharp_angle: f64::INFINITY, ..record() }, NotFinite, -1, "angle is inf"),
        (planish_d1rc_options { reserved: 1, ..record() }, Version, -1, "reserved"),
        (edges(&[0, 1, 0, 12]), Topology, 1, "vertices 0 and 12"),
        (edges(&[0, 1, 1, 2, 25, 3]), Index, 2, "vertex 25"),
        (
            planish_d1rc_options { corners: [1, 25].as_ptr(), corner_count: 2, ..record() },
            Index,
            1,
            "vertex 25",
        ),
        (planish_d1rc_options { sharp_edge_count: 1, ..record() }, NullPointer, -1, "sharp_edges is NULL"),
        (planish_d1rc_options { corner_count: 1, ..record() }, NullPointer, -1, "corners is NULL"),
    ] {
        refused(with(&good, options, out), status, index, &[word]);
    }
    let mut folded = Sheet::new(5);
    folded.uv.swap(24, 26); // nodes 12 and 13 change places
    folded.uv.swap(25, 27);
    let status = with(&folded, record(), out);
    assert_eq!(status, Degenerate, "{}", message());
    assert!(message().contains("turned over") && planish_error_index() >= 0);
    let mut flat = Sheet::new(5);
    (flat.uv[12], flat.uv[13]) = (flat.uv[2], flat.uv[3]); // node 6 on node 1
    assert_eq!(with(&flat, record(), out), Degenerate);
    let two = Sheet::new(2);
    refused(with(&two, planish_d1rc_options { mode: 1, ..record() }, out), Degenerate, -1, &["degree 3"]);
    let mut parts = Sheet::new(5);
    parts.triangles.drain(24..72); // the middle columns of cells
    let status = with(&parts, record(), out);
    refused(status, Topology, -1, &["several pieces"]);
    // SAFETY: NULL where it is refused.
    unsafe {
        null_refused(planish_d1rc_new(null(), null(), out), "control_mesh");
        let mesh = good.mesh();
        null_refused(planish_d1rc_new(mesh.0, null(), null_mut()), "out_surface");
        null_refused(planish_d1rc_options_init(null_mut(), 104), "options");
    }
    assert_untouched(out);
}

#[test]
fn refused_changes_leave_the_surface_alone() {
    use planish_status::*;
    let surface = sheet(6, &record());
    let saddle = SurfaceHandle::saddle();
    let (s, t) = (surface.0, saddle.0);
    let before = point(&surface, 0.4, 0.6);
    let (mut count, mut numbers, mut orders): (usize, [f64; 3], [u32; 2]) = (canary(), canary(), canary());
    let n = numbers.as_mut_ptr();
    // SAFETY: live handles, and arrays of these lengths.
    unsafe {
        let bad = [0.0, 0.0, 1.0, 0.0, f64::NAN, 0.0];
        let status = planish_d1rc_set_control_points(s, [7, 8].as_ptr(), 2, bad.as_ptr());
        refused(status, NotFinite, 1, &["control point 1"]);
        let status = planish_d1rc_set_control_points(s, [7, 36].as_ptr(), 2, [0.0; 6].as_ptr());
        refused(status, Index, 1, &["vertex 36"]);
        let status = planish_d1rc_set_sharp_edges(s, [0, 1, 0, 35].as_ptr(), 2, null(), 0);
        refused(status, Topology, 1, &["vertices 0 and 35"]);
        let status = planish_d1rc_edge_continuity(s, [0, 35].as_ptr(), 1, orders.as_mut_ptr());
        refused(status, Topology, 0, &["edge 0"]);
        refused(planish_d1rc_copy_influence(s, 36, null_mut(), 0, &mut count), Index, 0, &["vertex 36"]);
        refused(planish_d1rc_copy_control_points(s, n, 1), BufferTooSmall, -1, &["36"]);
        refused(planish_d1rc_copy_knots(s, n, 1), BufferTooSmall, -1, &["out_uv"]);
        let status = planish_d1rc_copy_influence(s, 8, orders.as_mut_ptr(), 2, &mut count);
        refused(status, BufferTooSmall, -1, &["out_faces"]);
        let no_such = planish_d1rc_configuration_count(s);
        let status = planish_d1rc_copy_configuration(s, no_such, null_mut(), null_mut(), 0, &mut count);
        refused(status, Index, no_such as i64, &["configuration"]);
        assert_eq!(point(&surface, 0.4, 0.6), before);

        let wrong = |status| refused(status, WrongKind, -1, &["Tensor", "D1rc"]);
        wrong(planish_d1rc_set_sharp_edges(t, null(), 0, null(), 0));
        wrong(planish_d1rc_copy_sharp_edges(t, null_mut(), 0, &mut count));
        wrong(planish_d1rc_copy_control_points(t, n, 1));
        wrong(planish_d1rc_set_control_points(t, null(), 0, null()));
        wrong(planish_d1rc_edge_continuity(t, null(), 0, null_mut()));
        wrong(planish_d1rc_copy_influence(t, 0, null_mut(), 0, &mut count));
        wrong(planish_d1rc_blending_values(t, 0, null(), 0, null_mut()));
        wrong(planish_d1rc_copy_knots(t, n, 1));
        wrong(planish_d1rc_copy_configuration(t, 0, null_mut(), null_mut(), 0, &mut count));
        assert_eq!((planish_d1rc_degree(t), planish_d1rc_knot_count(t)), (0, 0));
        assert_eq!(planish_d1rc_configuration_count(t), 0);
        null_refused(planish_d1rc_set_sharp_edges(null_mut(), null(), 0, null(), 0), "surface");
        null_refused(planish_d1rc_copy_influence(s, 0, null_mut(), 0, null_mut()), "out_count");
        null_refused(planish_d1rc_edge_continuity(s, null(), 1, orders.as_mut_ptr()), "edges");
        null_refused(planish_d1rc_blending_values(s, 0, [0.5; 2].as_ptr(), 1, null_mut()), "out_values");
    }
    assert_untouched(&count);
    assert_untouched(&numbers);
    assert_untouched(&orders);
}
