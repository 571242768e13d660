//! Rows from meshes.

use super::*;

/// A tube along z, 12 nodes round and 9 along, open at both ends.
fn tube() -> MeshHandle {
    let place = |j: u32, k: u32| {
        let angle = f64::from(k) / 12.0 * std::f64::consts::TAU;
        [angle.cos(), angle.sin(), 0.4 * f64::from(j)]
    };
    let points: Vec<f64> = (0..9).flat_map(|j| (0..12).flat_map(move |k| place(j, k))).collect();
    let node = |j: u32, k: u32| 12 * j + k % 12;
    let cell = |j, k| {
        [node(j, k), node(j, k + 1), node(j + 1, k + 1), node(j, k), node(j + 1, k + 1), node(j + 1, k)]
    };
    let triangles: Vec<u32> = (0..8).flat_map(|j| (0..12).flat_map(move |k| cell(j, k))).collect();
    let mut out = null_mut();
    // SAFETY: the arrays have these lengths.
    ok(unsafe {
        planish_mesh_new(
            points.as_ptr(),
            points.len() / 3,
            triangles.as_ptr(),
            triangles.len() / 3,
            null(),
            &mut out,
        )
    });
    MeshHandle(out)
}

#[test]
fn rows_come_in_two_calls() {
    let mesh = tube();
    let (mut counts, mut total) = ([0; 5], 0);
    // SAFETY: the arrays have these lengths.
    unsafe {
        ok(planish_mesh_sample_rows(mesh.0, null(), counts.as_mut_ptr(), 5, null_mut(), 0, &mut total));
        assert_eq!(counts.iter().sum::<usize>(), total);
        let mut points = vec![0.0; 3 * total];
        let again = |points: *mut f64, room| {
            let (mut counts, mut total) = ([0; 5], 0);
            planish_mesh_sample_rows(mesh.0, null(), counts.as_mut_ptr(), 5, points, room, &mut total)
        };
        ok(again(points.as_mut_ptr(), total));
        // every row has one height, and rows are one after the other
        let mut rest = &points[..];
        let heights: Vec<f64> = counts
            .iter()
            .map(|&count| {
                let row = rest.split_off(..3 * count).unwrap();
                assert!(row.chunks(3).all(|p| (p[2] - row[2]).abs() <= 1e-9), "{row:?}");
                row[2]
            })
            .collect();
        assert!(heights.is_sorted() || heights.iter().rev().is_sorted(), "{heights:?}");

        let mut untouched: [f64; 3] = canary();
        let status = again(untouched.as_mut_ptr(), 1);
        refused(status, planish_status::BufferTooSmall, -1, &["out_points", "room for 1"]);
        assert_untouched(&untouched);

        // what was taken is skinned
        let (mut surface, mut report) = (null_mut(), record());
        let closed = planish_skin_options { closed: 1, ..record() };
        ok(planish_tspline_skin(points.as_ptr(), counts.as_ptr(), 5, &closed, &mut surface, &mut report));
        let _surface = SurfaceHandle(surface);
        assert!(report.max_error <= report.tolerance);
    }
}

#[test]
fn what_gives_no_rows_is_refused() {
    let mesh = tube();
    let mut counts: [usize; 4] = canary();
    let mut total: usize = canary();
    let mut take = |options: planish_sample_rows_options, rows| {
        // SAFETY: the arrays have these lengths, or are refused first.
        unsafe {
            planish_mesh_sample_rows(mesh.0, &options, counts.as_mut_ptr(), rows, null_mut(), 0, &mut total)
        }
    };
    let invalid = planish_status::InvalidArgument;
    refused(take(record(), 0), invalid, -1, &["row_count is 0"]);
    refused(take(planish_sample_rows_options { spacing: -1.0, ..record() }, 4), invalid, -1, &["spacing"]);
    refused(take(planish_sample_rows_options { begin: 2, ..record() }, 4), invalid, -1, &["begin"]);
    refused(take(planish_sample_rows_options { end: 2, ..record() }, 4), invalid, -1, &["end"]);
    let other = planish_sample_rows_options { end_index: 7, ..record() };
    refused(take(other, 4), planish_status::Index, 7, &["loop 7", "there are 2"]);
    let node = planish_sample_rows_options { end: 1, end_index: 9999, ..record() };
    refused(take(node, 4), planish_status::Index, 9999, &["node 9999"]);
    assert_eq!(take(planish_sample_rows_options { end_index: 0, ..record() }, 4), invalid);
    assert!(message().contains("both sources share node"), "{}", message());
    // between two nodes levels end at the open loops
    let nodes = planish_sample_rows_options { begin: 1, begin_index: 48, end: 1, end_index: 54, ..record() };
    refused(take(nodes, 4), planish_status::Topology, 1, &["row 1", "open curves"]);
    assert_untouched(&counts);
    assert_untouched(&total);
    // SAFETY: NULL is refused.
    unsafe {
        let (counts, total) = (counts.as_mut_ptr(), &raw mut total);
        null_refused(planish_mesh_sample_rows(null(), null(), counts, 4, null_mut(), 0, total), "mesh");
        null_refused(
            planish_mesh_sample_rows(mesh.0, null(), null_mut(), 4, null_mut(), 0, total),
            "out_row_counts",
        );
        null_refused(
            planish_mesh_sample_rows(mesh.0, null(), counts, 4, null_mut(), 0, null_mut()),
            "out_point_count",
        );
        null_refused(planish_sample_rows_options_init(null_mut(), 56), "options");
    }
}
