//! Records that are shorter, longer or wrong.

use super::*;

/// A caller's record with room for more fields.
#[repr(C)]
#[derive(Clone, Copy)]
struct Longer<T> {
    record: T,
    rest: [u8; 16],
}

fn eval_with(options: *const planish_eval_options) -> (planish_status, [f64; 3]) {
    let surface = SurfaceHandle::saddle();
    let mut out: [f64; 3] = canary();
    let uv = [0.5, 0.5];
    // SAFETY: one point.
    let status = unsafe { planish_surface_eval(surface.0, uv.as_ptr(), 1, options, (&raw mut out).cast()) };
    (status, out)
}

#[test]
fn init_fills_as_far_as_the_size_goes() {
    let known = size_of::<planish_eval_options>();
    for size in [8, 16, known - 8, known, known + 8, known + 16] {
        let mut longer: Longer<planish_eval_options> = canary();
        // SAFETY: `size` bytes.
        ok(unsafe { planish_eval_options_init((&raw mut longer).cast(), size) });
        // SAFETY: plain bytes.
        let bytes: [u8; 56] = unsafe { std::mem::transmute(longer) };
        assert_eq!(bytes[..8], size.to_ne_bytes());
        let zeros = [0; 56];
        assert_eq!(bytes[8..size], zeros[8..size], "all defaults of this record are 0");
        assert!(bytes[size..].iter().all(|&byte| byte == CANARY), "beyond {size}");
    }
}

#[test]
fn init_refuses_sizes_that_are_none() {
    let mut record: planish_eval_options = canary();
    for size in [0, 1, 7, 12, 4096, usize::MAX] {
        // SAFETY: refused before a byte is written.
        let status = unsafe { planish_eval_options_init(&mut record, size) };
        let words: [&str; 2] = ["planish_eval_options", &size.to_string()];
        refused(status, planish_status::InvalidArgument, -1, &words);
        assert_untouched(&record);
    }
}

#[test]
fn every_init_refuses_null() {
    // SAFETY: NULL is refused.
    unsafe {
        null_refused(planish_mesh_options_init(null_mut(), 56), "options");
        null_refused(planish_parameterize_options_init(null_mut(), 96), "options");
        null_refused(planish_decimate_options_init(null_mut(), 88), "options");
        null_refused(planish_sphere_options_init(null_mut(), 32), "options");
        null_refused(planish_eval_options_init(null_mut(), 40), "options");
        null_refused(planish_tensor_options_init(null_mut(), 136), "options");
        null_refused(planish_skin_options_init(null_mut(), 144), "options");
        null_refused(planish_pht_options_init(null_mut(), 128), "options");
        null_refused(planish_pht_convert_options_init(null_mut(), 32), "options");
        null_refused(planish_field_options_init(null_mut(), 112), "options");
        null_refused(planish_transfer_options_init(null_mut(), 32), "options");
    }
}

#[test]
fn defaults_are_those_of_the_header() {
    let mut mesh: planish_mesh_options = canary();
    let mut map: planish_parameterize_options = canary();
    let mut tensor: planish_tensor_options = canary();
    let mut skin: planish_skin_options = canary();
    // SAFETY: each of its size.
    unsafe {
        ok(planish_mesh_options_init(&mut mesh, size_of_val(&mesh)));
        ok(planish_parameterize_options_init(&mut map, size_of_val(&map)));
        ok(planish_tensor_options_init(&mut tensor, size_of_val(&tensor)));
        ok(planish_skin_options_init(&mut skin, size_of_val(&skin)));
    }
    assert_eq!((skin.tolerance, skin.dim, skin.tolerance_scale, skin.method), (1e-3, 3, 0, 0));
    assert_eq!((skin.closed, skin.ends, skin.closed_v, skin.v_rule, skin.align), (0, 0, 0, 0, 0));
    assert_eq!((skin.approximate_v, skin.extra_checks, skin.batch, skin.removal), (0, 3, 0, 0));
    assert_eq!((skin.certify, skin.compare, skin.thread_count), (0, 0, 0));
    assert!(skin.end_slopes.is_null() && skin.begin_tangents.is_null() && skin.end_tangents.is_null());
    assert!(skin.out_parameters.is_null() && skin.out_errors.is_null() && skin.out_report.is_null());
    assert!(skin.progress.is_none() && skin.user.is_null());
    assert_eq!((mesh.point_stride, mesh.triangle_stride, mesh.weld_distance), (0, 0, 0.0));
    assert_eq!((mesh.orient, mesh.index_base), (0, 0));
    assert!(mesh.out_repairs.is_null() && mesh.out_node_map.is_null());
    assert_eq!((map.bulge, map.boundary_slide, map.method, map.border), (0.02, 0.0, 0, 0));
    assert_eq!((map.stretch_steps, map.rings, map.fill_holes, map.unroll), (PLANISH_UNLIMITED, 0, 1, 1));
    assert_eq!((map.thread_count, map.reserved), (0, 0));
    assert!(map.node_weights.is_null() && map.progress.is_none() && map.user.is_null());
    assert_eq!((tensor.tolerance, tensor.smoothing, tensor.buffer), (1e-3, 0.0, 0.1));
    assert_eq!((tensor.max_coefficients, tensor.max_grid), (66049, 257));
    assert_eq!((tensor.tolerance_scale, tensor.method, tensor.ends, tensor.energy), (0, 0, 0, 0));
    assert_eq!((tensor.regularize, tensor.grid_u, tensor.grid_v, tensor.correction_sweeps), (0, 0, 0, 0));
    assert_eq!((tensor.measure_distance, tensor.thread_count, tensor.reserved), (0, 0, 0));
    assert!(tensor.parameterize.is_null() && tensor.weights.is_null() && tensor.progress.is_none());
    let (mut pht, mut convert): (planish_pht_options, planish_pht_convert_options) = (canary(), canary());
    // SAFETY: each of its size.
    unsafe {
        ok(planish_pht_options_init(&mut pht, size_of_val(&pht)));
        ok(planish_pht_convert_options_init(&mut convert, size_of_val(&convert)));
    }
    assert_eq!((pht.tolerance, pht.smoothing, pht.max_cells, pht.max_level), (1e-3, 1e-3, 200_000, 12));
    assert_eq!((pht.tolerance_scale, pht.estimator, pht.regularize, pht.min_samples), (0, 0, 0, 2));
    assert_eq!((pht.grid_u, pht.grid_v, pht.grade, pht.correction_sweeps), (1, 1, 1, 1));
    assert_eq!((pht.measure_distance, pht.thread_count, pht.reserved), (0, 0, 0));
    assert!(pht.parameterize.is_null() && pht.weights.is_null() && pht.progress.is_none());
    assert_eq!((convert.tolerance, convert.max_cells, convert.max_level), (0.0, 200_000, 12));
    assert!(tensor.out_parameters.is_null() && tensor.out_errors.is_null() && tensor.user.is_null());
    let mut transfer: planish_transfer_options = canary();
    // SAFETY: of its size.
    ok(unsafe { planish_transfer_options_init(&mut transfer, size_of_val(&transfer)) });
    assert_eq!((transfer.max_distance, transfer.distance_scale, transfer.far_rule), (0.05, 0, 0));
    assert!(transfer.field.is_null());
}

#[test]
fn shorter_options_have_defaults_for_the_rest() {
    // uv_stride is known, out_stride lies beyond the record and would be refused if it were read
    let older = planish_eval_options { struct_size: 16, uv_stride: 2, out_stride: 1, ..record() };
    assert_eq!(eval_with(&older), (planish_status::Ok, [0.5, 0.5, 0.25]));
    let whole = planish_eval_options { struct_size: 40, ..older };
    let (status, out) = eval_with(&whole);
    refused(status, planish_status::InvalidArgument, -1, &["out_stride is 1", "at least 3"]);
    assert_untouched(&out);
}

#[test]
fn longer_options_must_end_with_zeros() {
    let mut newer = Longer { record: record::<planish_eval_options>(), rest: [0; 16] };
    newer.record.struct_size = size_of_val(&newer);
    assert_eq!(eval_with((&raw const newer).cast()).0, planish_status::Ok);
    newer.rest[15] = 1;
    let (status, out) = eval_with((&raw const newer).cast());
    refused(status, planish_status::Version, -1, &["planish_eval_options", "56 bytes", "knows 40"]);
    assert_untouched(&out);
}

#[test]
fn options_without_a_size_are_refused() {
    for size in [0, 4, 41, 4096, usize::MAX / 2] {
        let (status, out) = eval_with(&planish_eval_options { struct_size: size, ..record() });
        refused(status, planish_status::InvalidArgument, -1, &["struct_size", &size.to_string()]);
        assert_untouched(&out);
    }
}

#[test]
fn reserved_fields_must_be_zero() {
    let sheet = Sheet::new(4);
    let mesh = sheet.mesh_with_parameters();
    let newer = planish_tensor_options { reserved: 3, ..record() };
    let mut out = canary();
    // SAFETY: handles and records of this test.
    let status = unsafe { planish_tensor_fit(mesh.0, &newer, &mut out, null_mut()) };
    refused(status, planish_status::Version, -1, &["reserved", "3"]);
    assert_untouched(&out);
}

#[test]
fn reports_are_filled_as_far_as_the_size_goes() {
    let sheet = Sheet::new(9);
    let mesh = sheet.mesh_with_parameters();
    let fit = |report: *mut planish_fit_report| {
        let mut out = null_mut();
        // SAFETY: handles and records of this test.
        let status = unsafe { planish_tensor_fit(mesh.0, null(), &mut out, report) };
        let surface = SurfaceHandle(out);
        assert_eq!(surface.0.is_null(), (status as i32) < 0);
        status
    };
    let known = size_of::<planish_fit_report>();
    let mut whole: planish_fit_report = record();
    assert!(fit(&mut whole) as i32 >= 0);
    for size in [8, 24, known, known + 16] {
        let mut longer: Longer<planish_fit_report> = canary();
        longer.record.struct_size = size;
        assert!(fit((&raw mut longer).cast()) as i32 >= 0);
        assert_eq!(longer.record.struct_size, size);
        // SAFETY: plain bytes.
        let bytes: [u8; 208] = unsafe { std::mem::transmute(longer) };
        assert!(bytes[size..].iter().all(|&byte| byte == CANARY), "beyond {size}");
        if size > known {
            assert_eq!(bytes[known..size], [0; 16]);
        }
        if size >= 24 {
            assert_eq!(longer.record.max_error, whole.max_error);
            assert_eq!(longer.record.rms_error, whole.rms_error);
        }
    }
    let mut unset: planish_fit_report = canary();
    unset.struct_size = 0;
    refused(fit(&mut unset), planish_status::InvalidArgument, -1, &["planish_fit_report", "is 0"]);
    assert_eq!(unset.struct_size, 0);
    unset.struct_size = canary();
    assert_untouched(&unset);
}
