//! Values and forces between meshes.

use super::*;

/// A transfer that frees itself.
struct TransferHandle(*mut planish_transfer);

impl Drop for TransferHandle {
    fn drop(&mut self) {
        // SAFETY: made by the library and freed once.
        unsafe { planish_transfer_free(self.0) }
    }
}

/// From a sheet to the nodes of a finer one, and its report.
fn transfer(
    options: *const planish_transfer_options,
    targets: &[f64],
) -> (planish_status, TransferHandle, planish_transfer_report) {
    let (mut out, mut report) = (null_mut(), record());
    let source = Sheet::new(21).mesh_with_parameters();
    // SAFETY: live handles, and an array of this length.
    let status = unsafe {
        planish_transfer_new(source.0, targets.as_ptr(), targets.len() / 3, options, &mut out, &mut report)
    };
    (status, TransferHandle(out), report)
}

const SOURCES: usize = 21 * 21;
const TARGETS: usize = 33 * 33;

#[test]
fn values_go_there_and_forces_come_back() {
    let (source, target) = (Sheet::new(21), Sheet::new(33));
    let field = planish_field_options { grid_u: 17, grid_v: 17, ..record() };
    let options = planish_transfer_options { field: &field, ..record() };
    let (status, transfer, report) = transfer(&options, &target.points);
    ok(status);
    assert_eq!((report.grid_u, report.grid_v, report.far_count), (17, 17, 0));
    assert!(report.max_distance < 0.01 && report.limit > 0.05, "{report:?}");
    assert!(report.rms_distance <= report.max_distance && report.rms_shape_error <= report.max_shape_error);
    let (mut values, mut forces) = (vec![0.0; TARGETS], vec![0.0; 2 * SOURCES]);
    let (mut uv, mut distances) = (vec![0.0; 2 * TARGETS], vec![0.0; TARGETS]);
    let constants = vec![7.0; SOURCES];
    let pressures: Vec<f64> = (0..2 * TARGETS).map(|k| (k % 17) as f64 - 3.0).collect();
    let mut balance: planish_balance_report = record();
    // SAFETY: live handles, and arrays of these lengths.
    unsafe {
        let t = transfer.0;
        assert_eq!((planish_transfer_source_count(t), planish_transfer_target_count(t)), (SOURCES, TARGETS));
        ok(planish_transfer_apply(t, constants.as_ptr(), SOURCES, 1, values.as_mut_ptr()));
        assert!(values.iter().all(|x| (x - 7.0).abs() <= 8.0 * 7.0 * f64::EPSILON));
        ok(planish_transfer_apply_transpose(t, pressures.as_ptr(), TARGETS, 2, forces.as_mut_ptr()));
        ok(planish_transfer_copy_parameters(t, uv.as_mut_ptr(), TARGETS));
        ok(planish_transfer_copy_distances(t, distances.as_mut_ptr(), TARGETS));
        let displacements = &source.points;
        let status = planish_transfer_balance(
            t,
            displacements.as_ptr(),
            SOURCES,
            target.points.as_ptr(),
            TARGETS,
            null(),
            &mut balance,
        );
        ok(status);
    }
    for k in 0..2 {
        let sum = |rows: &[f64]| rows.iter().skip(k).step_by(2).sum::<f64>();
        assert!((sum(&pressures) - sum(&forces)).abs() <= 1e-12 * 20.0 * TARGETS as f64);
    }
    assert!(uv.iter().all(|x| (-1e-9..=1.0 + 1e-9).contains(x)));
    assert_eq!(distances[report.farthest_index], report.max_distance);
    assert!(balance.force_error <= 1e-12 && balance.work_error <= 1e-12, "{balance:?}");
    assert!(balance.moment_error <= balance.moment_bound * (1.0 + 1e-9) + 1e-9, "{balance:?}");
}

#[test]
fn far_targets_are_told_with_their_distance() {
    let mut targets = Sheet::new(33).points;
    targets[3 * 100 + 2] += 2.0;
    let (status, nothing, _) = transfer(null(), &targets);
    refused(status, planish_status::Outside, 100, &["target 100", "away", "max_distance"]);
    assert!(nothing.0.is_null());
    let options = planish_transfer_options { far_rule: planish_far_rule::Keep as u32, ..record() };
    let (status, _, report) = transfer(&options, &targets);
    assert_eq!((status, report.far_count, report.farthest_index), (planish_status::PointsOutside, 1, 100));
    let absolute = planish_tolerance_scale::Absolute as u32;
    let options = planish_transfer_options { max_distance: 3.0, distance_scale: absolute, ..record() };
    let (status, _, report) = transfer(&options, &targets);
    ok(status);
    assert_eq!(report.limit, 3.0);
}

#[test]
fn bad_arguments_are_refused() {
    use planish_status::*;
    let targets = Sheet::new(33).points;
    let (_, transfer, _) = transfer(null(), &targets);
    let source = Sheet::new(21).mesh_with_parameters();
    let closed = closed_mesh();
    let mut ugly = targets.clone();
    ugly[3 * 7] = f64::NAN;
    let mut numbers: [f64; 4] = canary();
    let mut out = canary();
    let mut report: planish_balance_report = canary();
    // SAFETY: live handles, and arrays of these lengths, or refused before.
    unsafe {
        let (t, x, n, none) = (transfer.0, targets.as_ptr(), numbers.as_mut_ptr(), null_mut());
        null_refused(planish_transfer_new(null(), x, TARGETS, null(), &mut out, none), "source");
        null_refused(planish_transfer_new(source.0, null(), TARGETS, null(), &mut out, none), "targets");
        null_refused(planish_transfer_new(source.0, x, TARGETS, null(), null_mut(), none), "out_transfer");
        let status = planish_transfer_new(source.0, ugly.as_ptr(), TARGETS, null(), &mut out, none);
        refused(status, NotFinite, 7, &["target 7"]);
        let status = planish_transfer_new(closed.0, x, TARGETS, null(), &mut out, none);
        refused(status, Topology, -1, &["cut"]);
        let options = planish_transfer_options { max_distance: -1.0, ..record() };
        let status = planish_transfer_new(source.0, x, TARGETS, &options, &mut out, none);
        refused(status, InvalidArgument, -1, &["max_distance is -1"]);
        let options = planish_transfer_options { far_rule: 2, ..record() };
        let status = planish_transfer_new(source.0, x, TARGETS, &options, &mut out, none);
        refused(status, InvalidArgument, -1, &["far_rule is 2"]);
        assert_untouched(&out);

        null_refused(planish_transfer_apply(null(), x, SOURCES, 1, n), "transfer");
        null_refused(planish_transfer_apply(t, null(), SOURCES, 1, n), "values");
        null_refused(planish_transfer_apply(t, x, SOURCES, 1, null_mut()), "out_values");
        let few = planish_transfer_apply(t, x, SOURCES - 1, 1, n);
        refused(few, InvalidArgument, -1, &["440", "441", "values"]);
        refused(planish_transfer_apply(t, x, SOURCES, 0, n), InvalidArgument, -1, &["dim is 0"]);
        let mut back = vec![0.0; 3 * TARGETS];
        let b = back.as_mut_ptr();
        refused(planish_transfer_apply(t, ugly.as_ptr(), SOURCES, 3, b), NotFinite, 7, &["datum 7"]);
        null_refused(planish_transfer_apply_transpose(null(), x, TARGETS, 1, n), "transfer");
        null_refused(planish_transfer_apply_transpose(t, null(), TARGETS, 1, n), "forces");
        null_refused(planish_transfer_apply_transpose(t, x, TARGETS, 1, null_mut()), "out_forces");
        let few = planish_transfer_apply_transpose(t, x, 5, 1, n);
        refused(few, InvalidArgument, -1, &["5", "1089", "forces"]);
        let status = planish_transfer_apply_transpose(t, ugly.as_ptr(), TARGETS, 3, b);
        refused(status, NotFinite, 7, &["datum 7"]);
        null_refused(planish_transfer_copy_parameters(null(), n, TARGETS), "transfer");
        null_refused(planish_transfer_copy_parameters(t, null_mut(), TARGETS), "out_uv");
        refused(planish_transfer_copy_parameters(t, n, 1), BufferTooSmall, -1, &["1", "1089"]);
        null_refused(planish_transfer_copy_distances(null(), n, TARGETS), "transfer");
        null_refused(planish_transfer_copy_distances(t, null_mut(), TARGETS), "out_distances");
        refused(planish_transfer_copy_distances(t, n, 1), BufferTooSmall, -1, &["1", "1089"]);
        let r: *mut planish_balance_report = &mut report;
        null_refused(planish_transfer_balance(null(), x, SOURCES, x, TARGETS, null(), r), "transfer");
        null_refused(planish_transfer_balance(t, null(), SOURCES, x, TARGETS, null(), r), "displacements");
        null_refused(planish_transfer_balance(t, x, SOURCES, null(), TARGETS, null(), r), "forces");
        null_refused(planish_transfer_balance(t, x, SOURCES, x, TARGETS, null(), null_mut()), "out_report");
        let few = planish_transfer_balance(t, x, SOURCES, x, 3, null(), r);
        refused(few, InvalidArgument, -1, &["forces"]);
        assert_untouched(&report);
        assert_eq!((planish_transfer_source_count(null()), planish_transfer_target_count(null())), (0, 0));
        planish_transfer_free(null_mut());
    }
    assert_untouched(&numbers);
}
