use super::*;

#[test]
fn files_are_read_or_refused() {
    let directory = std::env::temp_dir().join(format!("planish-ffi-{}", std::process::id()));
    std::fs::create_dir_all(&directory).unwrap();
    let file = |name: &str, text: &str| {
        let path = directory.join(name);
        std::fs::write(&path, text).unwrap();
        c(path.to_str().unwrap())
    };
    let mut out = canary();
    // SAFETY: terminated texts.
    let mut read = |path: &CString| unsafe { planish_mesh_read(path.as_ptr(), null(), &mut out) };
    let missing = c("/nowhere/part.stl");
    refused(read(&missing), planish_status::File, -1, &["/nowhere/part.stl"]);
    let cut = file("cut.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n");
    refused(read(&cut), planish_status::Format, 2, &["line 3"]);
    let unknown = file("unknown.txt", "hello");
    refused(read(&unknown), planish_status::Format, -1, &["unknown.txt", "none of OFF"]);
    let wrong = file("wrong.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n");
    assert!((read(&wrong) as i32) < 0);
    assert!(message().contains('7'), "{}", message());
    let not_utf8 = CString::new([b'a', 0xff]).unwrap();
    assert!((read(&not_utf8) as i32) < 0);
    assert!(cfg!(not(unix)) || message().contains("cannot read"), "{}", message());
    assert_untouched(&out);

    let good = file("good.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    let mut out = null_mut();
    // SAFETY: a terminated text.
    ok(unsafe { planish_mesh_read(good.as_ptr(), null(), &mut out) });
    let mesh = MeshHandle(out);
    // SAFETY: a mesh.
    assert_eq!(unsafe { planish_mesh_triangle_count(mesh.0) }, 1);
    std::fs::remove_dir_all(directory).unwrap();
}

#[test]
fn meshes_come_from_memory_and_go_to_files() {
    let text = b"OFF 4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";
    let mut out = null_mut();
    // SAFETY: the bytes are there.
    ok(unsafe { planish_mesh_read_buffer(text.as_ptr().cast(), text.len(), null(), &mut out) });
    let mesh = MeshHandle(out);
    let (mut nodes, mut faces) = ([canary::<u32>(); 4], [canary::<u32>(); 2]);
    // SAFETY: the arrays have these lengths.
    unsafe {
        ok(planish_mesh_copy_node_map(mesh.0, nodes.as_mut_ptr(), 4));
        ok(planish_mesh_copy_triangle_map(mesh.0, faces.as_mut_ptr(), 2));
    }
    assert_eq!((nodes, faces), ([0, 1, 2, 3], [0, 0]));
    let folder = tempfile::tempdir().unwrap();
    let path = c(folder.path().join("a.ply").to_str().unwrap());
    // SAFETY: a mesh and a terminated text.
    unsafe {
        ok(planish_mesh_write(mesh.0, path.as_ptr(), null()));
        ok(planish_mesh_read(path.as_ptr(), null(), &mut out));
    }
    let read = MeshHandle(out);
    // SAFETY: both are meshes.
    unsafe {
        assert_eq!((*read.0).0.triangles(), (*mesh.0).0.triangles());
        assert_eq!((*read.0).0.points(), (*mesh.0).0.points());
    }
    let mut out = canary();
    // SAFETY: NULL and wrong arguments are refused.
    unsafe {
        null_refused(planish_mesh_read_buffer(null(), 3, null(), &mut out), "buffer");
        null_refused(planish_mesh_read_buffer(text.as_ptr().cast(), 3, null(), null_mut()), "out_mesh");
        null_refused(planish_mesh_write(null(), path.as_ptr(), null()), "mesh");
        null_refused(planish_mesh_write(mesh.0, null(), null()), "path");
        null_refused(planish_mesh_copy_node_map(null(), nodes.as_mut_ptr(), 4), "mesh");
        null_refused(planish_mesh_copy_triangle_map(mesh.0, null_mut(), 2), "out_triangles");
        null_refused(planish_mesh_set_points(mesh.0, null(), 4), "points");
        null_refused(planish_mesh_remove_field(mesh.0, null()), "name");
        let unknown = planish_mesh_write(mesh.0, c"a.xyz".as_ptr(), null());
        refused(unknown, planish_status::InvalidArgument, -1, &["a.xyz", ".off"]);
        let options = planish_mesh_options { max_memory: 9, ..record() };
        let large = planish_mesh_read(path.as_ptr(), &options, &mut out);
        refused(large, planish_status::TooLarge, -1, &["a.ply", "9 bytes"]);
    }
    assert_untouched(&out);
}
