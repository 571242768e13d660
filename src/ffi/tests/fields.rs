//! Fields that are fitted again and again, sums of surfaces, gradients.

use super::*;

/// A fitter that frees itself.
struct FitterHandle(*mut planish_field_fitter);

impl Drop for FitterHandle {
    fn drop(&mut self) {
        // SAFETY: made by the library and freed once.
        unsafe { planish_field_fitter_free(self.0) }
    }
}

/// A smooth field of two components on the nodes of a sheet.
fn field(sheet: &Sheet, phase: f64) -> Vec<f64> {
    sheet.uv.chunks_exact(2).flat_map(|p| [(3.0 * p[0] + phase).sin(), p[0] * p[1]]).collect()
}

fn fitter(sheet: &Sheet, options: &planish_field_options) -> FitterHandle {
    let mut out = null_mut();
    // SAFETY: live handles.
    ok(unsafe { planish_field_fitter_new(sheet.mesh_with_parameters().0, options, &mut out) });
    FitterHandle(out)
}

#[test]
fn a_field_is_fitted_and_replaced() {
    let sheet = Sheet::new(21);
    let count = sheet.count();
    let options = planish_field_options { grid_u: 9, grid_v: 5, ..record() };
    let fitter = fitter(&sheet, &options);
    let (first, second) = (field(&sheet, 0.0), field(&sheet, 1.0));
    let (mut grid, mut uv) = ([0_usize; 2], vec![0.0; 2 * count]);
    let (mut a, mut b) = (null_mut(), null_mut());
    let mut report: planish_fit_report = record();
    // SAFETY: live handles, and arrays of these lengths.
    unsafe {
        assert_eq!(planish_field_fitter_point_count(fitter.0), count);
        assert_eq!(planish_field_fitter_point_count(null()), 0);
        ok(planish_field_fitter_grid(fitter.0, grid.as_mut_ptr()));
        assert_eq!(grid, [9, 5]);
        ok(planish_field_fitter_copy_parameters(fitter.0, uv.as_mut_ptr(), count));
        assert_eq!(uv, sheet.uv);
        ok(planish_field_fitter_fit(fitter.0, first.as_ptr(), count, 2, &mut a, null_mut()));
        ok(planish_field_fitter_fit(fitter.0, second.as_ptr(), count, 2, &mut b, &mut report));
        let (a, b) = (SurfaceHandle(a), SurfaceHandle(b));
        assert!(report.max_error > 0.0 && report.max_error <= report.tolerance, "{report:?}");
        assert_eq!((report.grid_u, report.grid_v), (9, 5));
        ok(planish_field_fitter_update(fitter.0, a.0, second.as_ptr(), count, 2));
        let [updated, fitted] = [&a, &b].map(|surface| {
            let mut points = vec![0.0; 2 * planish_surface_coefficient_count(surface.0)];
            ok(planish_tensor_copy_control_points(surface.0, points.as_mut_ptr(), points.len() / 2));
            points
        });
        assert_eq!(updated, fitted);
    }
}

#[test]
fn masks_and_samples_choose_what_is_fitted() {
    let sheet = Sheet::new(21);
    let count = sheet.count();
    let mut values = field(&sheet, 0.0);
    let mut mask = vec![1_u8; count];
    mask[100] = 0;
    values[200] = f64::NAN;
    let options = planish_field_options { mask: mask.as_ptr(), ..record() };
    let masked = fitter(&sheet, &options);
    let mut surface = null_mut();
    // SAFETY: live handles, and arrays of these lengths.
    unsafe {
        let plain = fitter(&sheet, &record());
        let status = planish_field_fitter_fit(plain.0, values.as_ptr(), count, 2, &mut surface, null_mut());
        refused(status, planish_status::NotFinite, 100, &["datum 100"]);
        ok(planish_field_fitter_fit(masked.0, values.as_ptr(), count, 2, &mut surface, null_mut()));
        drop(SurfaceHandle(surface));
        let sample = field(&sheet, 0.0);
        let options = planish_field_options { sample_values: sample.as_ptr(), sample_dim: 2, ..record() };
        let found = fitter(&sheet, &options);
        let mut report: planish_fit_report = record();
        ok(planish_field_fitter_fit(found.0, sample.as_ptr(), count, 2, &mut surface, &mut report));
        drop(SurfaceHandle(surface));
        assert!(report.max_error <= report.tolerance, "{report:?}");
    }
}

#[test]
fn fitters_refuse_by_name() {
    let sheet = Sheet::new(7);
    let count = sheet.count();
    let values = field(&sheet, 0.0);
    let mesh = sheet.mesh_with_parameters();
    let mut out: *mut planish_field_fitter = canary();
    let mut surface: *mut planish_surface = canary();
    let invalid = planish_status::InvalidArgument;
    // SAFETY: live handles, and arrays of these lengths.
    unsafe {
        null_refused(planish_field_fitter_new(null(), null(), &mut out), "mesh");
        null_refused(planish_field_fitter_new(mesh.0, null(), null_mut()), "out_fitter");
        null_refused(planish_field_fitter_new_points(null(), 3, null(), &mut out), "uv");
        null_refused(planish_field_options_init(null_mut(), 112), "options");
        let mut refuse = |options: planish_field_options, words: &[&str]| {
            refused(planish_field_fitter_new(mesh.0, &raw const options, &mut out), invalid, -1, words);
        };
        refuse(planish_field_options { smoothing: 0.0, ..record() }, &["smoothing", "0"]);
        refuse(planish_field_options { tolerance: -1.0, ..record() }, &["tolerance", "-1"]);
        refuse(planish_field_options { grid_u: 1, grid_v: 9, ..record() }, &["grid"]);
        refuse(planish_field_options { ends: 7, ..record() }, &["ends"]);
        let (sample_values, sample_dim) = (values.as_ptr(), 2);
        refuse(
            planish_field_options { sample_values, sample_dim, grid_u: 3, grid_v: 3, ..record() },
            &["sample_values"],
        );
        let status = planish_field_fitter_new_points(sheet.uv.as_ptr(), 2, null(), &mut out);
        refused(status, invalid, -1, &["2 data"]);
        assert_untouched(&out);
        let fitter = fitter(&sheet, &record());
        let (values, to) = (values.as_ptr(), &raw mut surface);
        null_refused(planish_field_fitter_fit(null(), values, count, 2, to, null_mut()), "fitter");
        null_refused(planish_field_fitter_fit(fitter.0, null(), count, 2, to, null_mut()), "values");
        null_refused(
            planish_field_fitter_fit(fitter.0, values, count, 2, null_mut(), null_mut()),
            "out_surface",
        );
        let status = planish_field_fitter_fit(fitter.0, values, count - 1, 2, to, null_mut());
        refused(status, invalid, -1, &["48", "49"]);
        refused(planish_field_fitter_fit(fitter.0, values, count, 0, to, null_mut()), invalid, -1, &["dim"]);
        let saddle = SurfaceHandle::saddle();
        let status = planish_field_fitter_update(fitter.0, saddle.0, values, count, 2);
        refused(status, invalid, -1, &["other knots"]);
        let other = SurfaceHandle::other_family();
        let status = planish_field_fitter_update(fitter.0, other.0, values, count, 2);
        refused(status, planish_status::WrongKind, -1, &["Tensor"]);
        null_refused(planish_field_fitter_update(fitter.0, null_mut(), values, count, 2), "surface");
        null_refused(planish_field_fitter_grid(null(), null_mut()), "fitter");
        null_refused(planish_field_fitter_grid(fitter.0, null_mut()), "out_grid");
        let mut uv = [0.0; 2];
        let status = planish_field_fitter_copy_parameters(fitter.0, uv.as_mut_ptr(), 1);
        refused(status, planish_status::BufferTooSmall, -1, &["out_uv", "49"]);
        planish_field_fitter_free(null_mut());
    }
    assert_untouched(&surface);
}

#[test]
fn a_field_on_a_closed_mesh_is_refused_with_what_to_do() {
    let (closed, values) = (closed_mesh(), [0.0; 6]);
    let (mut fitter, mut surface): (*mut planish_field_fitter, *mut planish_surface) = (canary(), canary());
    let to_do = ["closed", "cut it open"];
    // SAFETY: live handles, and one number a node.
    unsafe {
        let status = planish_field_fitter_new(closed.0, null(), &mut fitter);
        refused(status, planish_status::Topology, -1, &to_do);
        let status =
            planish_tensor_fit_field(closed.0, values.as_ptr(), 6, 1, null(), &mut surface, null_mut());
        refused(status, planish_status::Topology, -1, &to_do);
    }
    assert_untouched(&fitter);
    assert_untouched(&surface);
}

#[test]
fn progress_is_heard_with_any_grid_and_cancels() {
    unsafe extern "C-unwind" fn listen(fraction: f64, _: f64, user: *mut libc::c_void) -> i32 {
        // SAFETY: the vector given as user.
        let told = unsafe { &mut *user.cast::<Vec<f64>>() };
        told.push(fraction);
        i32::from(told.capacity() == 1)
    }
    let sheet = Sheet::new(21);
    let sample = field(&sheet, 0.0);
    let fixed = planish_field_options { grid_u: 9, grid_v: 5, ..record() };
    let found = planish_field_options { sample_values: sample.as_ptr(), sample_dim: 2, ..record() };
    for options in [fixed, found, record()] {
        let mut told: Vec<f64> = Vec::with_capacity(1000);
        let user = (&raw mut told).cast();
        drop(fitter(&sheet, &planish_field_options { progress: Some(listen), user, ..options }));
        assert!(told.is_sorted() && told.last() == Some(&1.0), "{told:?}");
        // no room for a second call: this listener ends the first one
        let mut first: Vec<f64> = Vec::with_capacity(1);
        let user = (&raw mut first).cast();
        let options = planish_field_options { progress: Some(listen), user, ..options };
        let mut out: *mut planish_field_fitter = canary();
        // SAFETY: live handles.
        let status = unsafe { planish_field_fitter_new(sheet.mesh_with_parameters().0, &options, &mut out) };
        refused(status, planish_status::Cancelled, -1, &["cancelled"]);
        assert_untouched(&out);
    }
}

#[test]
fn surfaces_are_added_or_refused() {
    let (saddle, other) = (SurfaceHandle::saddle(), SurfaceHandle::other_family());
    let mut out: *mut planish_surface = canary();
    // SAFETY: live handles, and arrays of these lengths.
    unsafe {
        let both: [*const planish_surface; 2] = [saddle.0, saddle.0];
        let combine =
            |surfaces: &[*const planish_surface], factors: &[f64], out: *mut *mut planish_surface| {
                planish_tensor_combine(surfaces.as_ptr(), factors.as_ptr(), surfaces.len(), out)
            };
        let invalid = planish_status::InvalidArgument;
        refused(planish_tensor_combine(null(), null(), 0, &mut out), invalid, -1, &["no surfaces"]);
        null_refused(planish_tensor_combine(null(), null(), 1, &mut out), "surfaces");
        null_refused(combine(&both, &[1.0, 1.0], null_mut()), "out_surface");
        refused(combine(&both, &[1.0, f64::NAN], &mut out), planish_status::NotFinite, 1, &["factor 1"]);
        refused(combine(&[saddle.0, other.0], &[1.0; 2], &mut out), planish_status::WrongKind, -1, &[]);
        assert_untouched(&out);
        ok(combine(&both, &[2.0, -0.5], &mut out));
        let sum = SurfaceHandle(out);
        let (uv, mut point) = ([0.5, 0.25], [0.0; 3]);
        ok(planish_surface_eval(sum.0, uv.as_ptr(), 1, null(), point.as_mut_ptr()));
        assert_eq!(point, [0.75, 0.375, 1.5 * 0.125]);
    }
}

#[test]
fn gradients_lie_in_the_tangent_plane() {
    let saddle = SurfaceHandle::saddle();
    let (uv, mut out) = ([0.5, 0.25], [0.0; 9]);
    // SAFETY: live handles, and arrays of these lengths.
    unsafe {
        let to = out.as_mut_ptr();
        ok(planish_surface_field_gradient(saddle.0, saddle.0, uv.as_ptr(), 1, null(), to));
        // the field is the place itself: the gradients are the projections of the axes onto the tangent plane of
        // z = x y, whose normal is (-1/4, -1/2, 1)
        let n = [-0.25, -0.5, 1.0];
        for (k, gradient) in out.chunks_exact(3).enumerate() {
            for (i, x) in gradient.iter().enumerate() {
                let exact = f64::from(u8::from(i == k)) - n[i] * n[k] / 1.3125;
                assert!((x - exact).abs() <= 16.0 * f64::EPSILON, "{out:?}");
            }
        }
        null_refused(planish_surface_field_gradient(null(), saddle.0, uv.as_ptr(), 1, null(), to), "shape");
        null_refused(planish_surface_field_gradient(saddle.0, null(), uv.as_ptr(), 1, null(), to), "field");
        null_refused(planish_surface_field_gradient(saddle.0, saddle.0, null(), 1, null(), to), "uv");
        null_refused(
            planish_surface_field_gradient(saddle.0, saddle.0, uv.as_ptr(), 1, null(), null_mut()),
            "out_gradients",
        );
        let outside = [0.5, 2.0];
        let status = planish_surface_field_gradient(saddle.0, saddle.0, outside.as_ptr(), 1, null(), to);
        refused(status, planish_status::Outside, 0, &["point 0", "shape"]);
    }
}
