use super::*;
use std::ffi::c_void;

/// A layout that frees itself.
struct LayoutHandle(*mut planish_layout);

impl Drop for LayoutHandle {
    fn drop(&mut self) {
        // SAFETY: made by the library and freed once.
        unsafe { planish_layout_free(self.0) }
    }
}

fn counts(layout: &LayoutHandle) -> [usize; 4] {
    // SAFETY: a layout.
    unsafe {
        [
            planish_layout_quad_count(layout.0),
            planish_layout_vertex_count(layout.0),
            planish_layout_edge_count(layout.0),
            planish_layout_node_count(layout.0),
        ]
    }
}

fn cube() -> LayoutHandle {
    let mut out = null_mut();
    // SAFETY: room for a handle.
    ok(unsafe { planish_layout_cube(&mut out) });
    LayoutHandle(out)
}

fn corners(layout: &LayoutHandle) -> Vec<u32> {
    let mut corners = vec![0; 4 * counts(layout)[0]];
    // SAFETY: four vertices a quad.
    ok(unsafe { planish_layout_copy_corners(layout.0, corners.as_mut_ptr(), corners.len() / 4) });
    corners
}

#[test]
fn a_cube_goes_out_and_comes_in() {
    let layout = cube();
    assert_eq!(counts(&layout), [6, 8, 12, 0]);
    let corners = corners(&layout);
    let mut valences = [0; 8];
    let mut edges = [0; 72];
    // SAFETY: arrays of these lengths.
    unsafe {
        ok(planish_layout_copy_valences(layout.0, valences.as_mut_ptr(), 8));
        ok(planish_layout_copy_edges(layout.0, edges.as_mut_ptr(), 12));
    }
    assert_eq!(valences, [3; 8]);
    for [begin, end, quad, side, other, other_side] in edges.as_chunks().0 {
        let corner = |quad: u32, k: u32| corners[(4 * quad + k % 4) as usize];
        assert_eq!([corner(*quad, *side), corner(*quad, side + 1)], [*begin, *end]);
        assert_eq!([corner(*other, *other_side), corner(*other, other_side + 1)], [*end, *begin]);
    }
    let mut again = null_mut();
    // SAFETY: six quads.
    ok(unsafe { planish_layout_new(corners.as_ptr(), 6, null(), &mut again) });
    assert_eq!(self::corners(&LayoutHandle(again)), corners);
}

#[test]
fn a_mesh_gets_a_layout_with_its_nodes() {
    let mesh = closed_mesh();
    let mut out = null_mut();
    let mut report: planish_mesh_layout_report = canary();
    report.struct_size = size_of_val(&report);
    // SAFETY: handles and records of this test.
    ok(unsafe { planish_layout_of_mesh(mesh.0, null(), &mut out, &mut report) });
    let layout = LayoutHandle(out);
    assert_eq!(counts(&layout), [6, 8, 12, 6]);
    assert_eq!((report.kind, report.folded_node_count, report.spread_node_count), (1, 0, 0));
    let mut quads: [u32; 7] = canary();
    let mut uv: [f64; 14] = canary();
    // SAFETY: six nodes, and room for one more.
    ok(unsafe { planish_layout_copy_node_map(layout.0, quads.as_mut_ptr(), uv.as_mut_ptr(), 7) });
    assert!(quads[..6].iter().all(|&quad| quad < 6));
    assert!(uv[..12].iter().all(|x| (0.0..=1.0).contains(x)));
    assert_untouched(&quads[6]);
    uv[12..].iter().for_each(assert_untouched);
}

#[test]
fn refusals_leave_outputs_alone() {
    use planish_status::*;
    let mut out: *mut planish_layout = canary();
    let twice = [0, 1, 2, 1];
    let three = [0, 1, 2, 3, 1, 0, 4, 5, 0, 1, 6, 7];
    let sheet = Sheet::new(4).mesh();
    let closed = closed_mesh();
    let layout = cube();
    let mut numbers: [u32; 72] = canary();
    let mut uv: [f64; 12] = canary();
    // SAFETY: arrays of these lengths; NULL is refused.
    unsafe {
        null_refused(planish_layout_new(null(), 1, null(), &mut out), "corners");
        null_refused(planish_layout_new(twice.as_ptr(), 1, null(), null_mut()), "out_layout");
        refused(planish_layout_new(null(), 0, null(), &mut out), InvalidArgument, -1, &["at least one quad"]);
        refused(planish_layout_new(twice.as_ptr(), 1, null(), &mut out), Topology, 0, &["twice"]);
        refused(planish_layout_new(three.as_ptr(), 3, null(), &mut out), Topology, 2, &["edge"]);
        null_refused(planish_layout_cube(null_mut()), "out_layout");
        null_refused(planish_layout_of_mesh(null(), null(), &mut out, null_mut()), "mesh");
        null_refused(planish_layout_of_mesh(closed.0, null(), null_mut(), null_mut()), "out_layout");
        let cube_only = planish_mesh_layout_options { kind: 1, ..record() };
        let open = planish_layout_of_mesh(sheet.0, &cube_only, &mut out, null_mut());
        refused(open, Topology, 0, &["1 boundary loops"]);
        let few = planish_mesh_layout_options { kind: 2, patches: 5, ..record() };
        let refusal = planish_layout_of_mesh(closed.0, &few, &mut out, null_mut());
        refused(refusal, InvalidArgument, -1, &["patches is 5"]);
        let strange = planish_mesh_layout_options { kind: 3, ..record() };
        let refusal = planish_layout_of_mesh(closed.0, &strange, &mut out, null_mut());
        refused(refusal, InvalidArgument, -1, &["kind is 3"]);
        let at = numbers.as_mut_ptr();
        null_refused(planish_layout_copy_corners(null(), at, 6), "layout");
        null_refused(planish_layout_copy_corners(layout.0, null_mut(), 6), "out_corners");
        refused(planish_layout_copy_corners(layout.0, at, 5), BufferTooSmall, -1, &["6 are needed"]);
        null_refused(planish_layout_copy_edges(null(), at, 12), "layout");
        refused(planish_layout_copy_edges(layout.0, at, 11), BufferTooSmall, -1, &["12 are needed"]);
        null_refused(planish_layout_copy_valences(null(), at, 8), "layout");
        refused(planish_layout_copy_valences(layout.0, at, 7), BufferTooSmall, -1, &["8 are needed"]);
        null_refused(planish_layout_copy_node_map(null(), at, uv.as_mut_ptr(), 6), "layout");
        let none = planish_layout_copy_node_map(layout.0, at, uv.as_mut_ptr(), 6);
        refused(none, InvalidArgument, -1, &["not made for a mesh"]);
        null_refused(planish_layout_options_init(null_mut(), 16), "options");
        null_refused(planish_mesh_layout_options_init(null_mut(), 56), "options");
        planish_layout_free(null_mut());
        assert_eq!(planish_layout_quad_count(null()), 0);
    }
    assert_untouched(&out);
    assert_untouched(&numbers);
    assert_untouched(&uv);
}

#[test]
fn a_listener_cancels() {
    unsafe extern "C-unwind" fn stop(_: f64, _: f64, _: *mut c_void) -> i32 {
        1
    }
    let mesh = closed_mesh();
    let mut out: *mut planish_layout = canary();
    let options = planish_mesh_layout_options { progress: Some(stop), ..record() };
    // SAFETY: handles and records of this test.
    let status = unsafe { planish_layout_of_mesh(mesh.0, &options, &mut out, null_mut()) };
    refused(status, planish_status::Cancelled, -1, &["cancelled"]);
    assert_untouched(&out);
}
