use super::*;
use crate::mesh::{Components, MeshError, Repair};
use proptest::prelude::*;

const OPTIONS: MeshOptions = MeshOptions {
    weld_distance: 0.0,
    repair: Repair::SAFE,
    components: Components::All,
    index_base: 0,
    max_memory: 0,
};

fn mesh(text: &str, format: Format) -> (Mesh, MeshRepairs) {
    read_bytes(text.as_bytes(), format, &OPTIONS).unwrap_or_else(|error| panic!("{text}: {error}"))
}

fn refusal(bytes: impl AsRef<[u8]>, format: Format) -> ReadError {
    read_bytes(bytes.as_ref(), format, &OPTIONS).expect_err("not a file of the format")
}

fn sentence(text: &str, format: Format) -> String {
    refusal(text, format).to_string()
}

#[test]
fn off_is_read_with_comments_colours_normals_and_polygons() {
    let square = "OFF # a square\n# with a centre to come\n4 1 0\n0 0 0\n1 0 0\n1 1 0 # right\n0 1 0\n4 0 1 2 3 255 0 0\n";
    let (plain, repairs) = mesh(square, Format::Off);
    assert_eq!(plain.triangles(), [[0, 1, 2], [0, 2, 3]]);
    assert!(repairs.is_empty());
    let (coloured, _) =
        mesh("COFF 3 1 3\r\n0 0 0 9 9 9 9\r\n1 0 0 9 9 9 9\r\n0 1 0 9 9 9 9\r\n3 0 1 2", Format::Off);
    assert_eq!(coloured.points()[2], DVec3::Y);
    let (normals, _) = mesh("NOFF\n3 1 3\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n", Format::Off);
    assert_eq!(normals.points(), coloured.points());
    let (texture, _) = mesh("STOFF\n3 1 3\n0 0 0 .1 .2\n1 0 0 .3 .1\n0 1 0 .5 .6\n3 0 1 2\n", Format::Off);
    assert_eq!(texture.parameters().unwrap()[2], DVec2::new(0.5, 0.6));
}

#[test]
fn faults_of_off_name_their_line() {
    let error = refusal("OFF\n3 1 0\n0 0 0\n1 0 zero\n0 1 0\n3 0 1 2\n", Format::Off);
    assert_eq!(error.to_string(), "line 4: a coordinate should be a number, not 'zero'");
    assert_eq!((error.kind(), error.index()), (ErrorKind::Format, Some(3)));
    let far = sentence("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", Format::Off);
    assert_eq!(far, "line 6: the face refers to node 3 of 3");
    let forged = sentence("OFF\n4000000000 1 0\n0 0 0\n", Format::Off);
    assert_eq!(forged, "line 3: 4000000000 nodes cannot stand in the 6 bytes left");
    assert_eq!(
        sentence("OFF\n3 1 0\n0 0\n1 1 1\n2 2 2\n3 0 1 2\n", Format::Off),
        "line 3: the line ends where a coordinate should stand"
    );
    assert_eq!(sentence("", Format::Off), "line 1: the file is empty");
    assert_eq!(sentence("hello", Format::Off), "line 1: an OFF file does not begin with 'hello'");
    assert_eq!(sentence("4OFF\n", Format::Off), "line 1: nodes of the kind '4OFF' are not known");
}

#[test]
fn obj_is_read_with_texture_negative_indices_and_continued_lines() {
    let text = "# square\no square\nv 0 0 0 0.5 0.5 0.5\nv 1 0 0 1.0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt .5 0\nvt .5 1 0\nvt 0 1\n\
                vn 0 0 1\nusemtl steel\nf 1/1/1 2/2/1 \\\n3/3/1\nf -4/-4 -2/-2 -1/-1\nl 1 2\n";
    let (square, repairs) = mesh(text, Format::Obj);
    assert_eq!(square.triangles(), [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(
        square.parameters().unwrap(),
        [[0.0, 0.0], [0.5, 0.0], [0.5, 1.0], [0.0, 1.0]].map(DVec2::from)
    );
    assert!(repairs.is_empty());
    // a seam: node 1 has two different texture points, so there are no parameters
    let seam = text.replace("f -4/-4", "f -4/-3");
    let (square, repairs) = mesh(&seam, Format::Obj);
    assert_eq!(square.parameters(), None);
    assert!(repairs.dropped_parameters);
    let (_, repairs) = mesh(&text.replace("f -4/-4", "f -4"), Format::Obj);
    assert!(repairs.dropped_parameters);
    // faces may come first
    let (early, _) = mesh("f 1//1 2//1 3//1\nv 0 0 0\nv 1 0 0\nv 0 1 0\n", Format::Obj);
    assert_eq!(early.triangles(), [[0, 1, 2]]);
}

#[test]
fn faults_of_obj_name_their_line() {
    let nodes = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (tail, expected) in [
        ("f 1 2 4\n", "line 4: the face refers to node 4 of 3"),
        ("f 1 2 0\n", "line 4: the face refers to node 0 of 3"),
        ("f 1 2 -4\n", "line 4: the face refers to node -4 of 3"),
        ("f 1 2 x\n", "line 4: 'x' is no index"),
        ("v 1 2\n", "line 4: the line ends where z should stand"),
    ] {
        assert_eq!(sentence(&format!("{nodes}{tail}"), Format::Obj), expected, "{tail}");
    }
    let nodes = "v 0 0 nan\nv 1 0 0\nv 0 1 0\n";
    let error = refusal(nodes.to_owned() + "f 1 2 3\n", Format::Obj);
    assert_eq!(error, MeshError::NotFinite { node: 0 }.into());
    assert_eq!(refusal(nodes, Format::Obj), MeshError::PointCloud { count: 3 }.into());
    assert_eq!(refusal("", Format::Obj), MeshError::NoPoints.into());
}

const PLY_HEADER: &str = "comment made by hand\nobj_info no\nelement camera 1\nproperty list uchar short views\n\
    element vertex 4\nproperty double x\nproperty float y\nproperty short z\nproperty uchar heat\n\
    property list uchar int unused\nproperty float s\nproperty float t\nelement face 2\nproperty char flag\n\
    property list uchar uint vertex_indices\nelement edge 1\nproperty int a\nend_header\n";

fn ascii_ply() -> String {
    format!(
        "ply\nformat ascii 1.0\n{PLY_HEADER}2 7 8\n0.1 0 0 10 0 0 0\n1 0 0 20 1 5 1 0\n1 1 -3 30 0 1 1\n\
         0 1 0 40 2 6 7 0 1\n-1 3 0 1 2\n1 3 0 2 3\n5\n"
    )
}

/// The file of [`ascii_ply`] in binary, each number through `word`.
fn binary_ply(big_endian: bool) -> Vec<u8> {
    let name = if big_endian { "binary_big_endian" } else { "binary_little_endian" };
    let mut bytes = format!("ply\nformat {name} 1.0\n{PLY_HEADER}").into_bytes();
    let mut put = |word: &[u8]| {
        let from = bytes.len();
        bytes.extend(word);
        if big_endian {
            bytes[from..].reverse();
        }
    };
    put(&[2]);
    put(&7i16.to_le_bytes());
    put(&8i16.to_le_bytes());
    type Row<'a> = (f64, f32, i16, u8, &'a [i32], [f32; 2]);
    let rows: [Row; 4] = [
        (0.1, 0.0, 0, 10, &[], [0.0, 0.0]),
        (1.0, 0.0, 0, 20, &[5], [1.0, 0.0]),
        (1.0, 1.0, -3, 30, &[], [1.0, 1.0]),
        (0.0, 1.0, 0, 40, &[6, 7], [0.0, 1.0]),
    ];
    for (x, y, z, heat, list, uv) in rows {
        put(&x.to_le_bytes());
        put(&y.to_le_bytes());
        put(&z.to_le_bytes());
        put(&[heat]);
        put(&[list.len() as u8]);
        list.iter().for_each(|entry| put(&entry.to_le_bytes()));
        uv.iter().for_each(|entry| put(&entry.to_le_bytes()));
    }
    for (flag, nodes) in [(-1i8, [0u32, 1, 2]), (1, [0, 2, 3])] {
        put(&flag.to_le_bytes());
        put(&[3]);
        nodes.iter().for_each(|node| put(&node.to_le_bytes()));
    }
    put(&5i32.to_le_bytes());
    bytes
}

#[test]
fn ply_is_the_same_in_text_and_both_byte_orders() {
    let text = mesh(&ascii_ply(), Format::Ply);
    assert_eq!(text.0.points()[0], DVec3::new(0.1, 0.0, 0.0));
    assert_eq!(text.0.points()[2].z, -3.0);
    assert_eq!(text.0.field("heat"), Some(&[10.0, 20.0, 30.0, 40.0][..]));
    assert_eq!(text.0.parameters().unwrap()[3], DVec2::Y);
    assert_eq!(text.0.triangles(), [[0, 1, 2], [0, 2, 3]]);
    for big_endian in [false, true] {
        assert_eq!(read_bytes(&binary_ply(big_endian), Format::Ply, &OPTIONS).as_ref(), Ok(&text));
    }
}

#[test]
fn truncated_files_are_refused_at_every_byte() {
    let last_row = 4; // an element after the faces, which nobody reads
    for big_endian in [false, true] {
        let bytes = binary_ply(big_endian);
        for size in 0..bytes.len() - last_row {
            let error = refusal(&bytes[..size], Format::Ply);
            assert!(matches!(error.kind(), ErrorKind::Format), "{size} bytes: {error}");
        }
    }
    let stl = binary_stl("solid of 80 bytes");
    for size in 0..stl.len() {
        let error = refusal(&stl[..size], Format::Stl);
        assert!(matches!(error.kind(), ErrorKind::Format), "{size} bytes: {error}");
    }
    // texts may end between two rows or within a number and still be whole
    let texts = [(ascii_ply(), Format::Ply), (TETRAHEDRON_STL.to_owned(), Format::Stl)];
    for (text, format) in texts {
        (0..text.len()).for_each(|size| drop(read_bytes(&text.as_bytes()[..size], format, &OPTIONS)));
    }
}

#[test]
fn faults_of_ply_name_line_or_byte() {
    let text = ascii_ply();
    for (from, to, expected) in [
        ("ply\n", "plx\n", "line 1: a PLY file begins with 'ply'"),
        ("ascii", "runes", "line 2: the format 'runes' is not known"),
        ("double x", "quad x", "line 8: the type 'quad' is not known"),
        ("float y", "float w", "line 21: the nodes have no 'y'"),
        ("vertex_indices", "corners", "line 25: the faces have no list 'vertex_indices'"),
        ("3 0 2 3", "3 0 2 4", "line 27: the face refers to node 4 of 4"),
        ("vertex 4", "vertex 4000000000", "line 21: 4000000000 rows of 'vertex' cannot stand in the"),
        ("2 7 8", "-2 7 8", "line 21: a list cannot have -2 entries"),
    ] {
        let error = sentence(&text.replacen(from, to, 1), Format::Ply);
        assert!(error.starts_with(expected), "{to}: {error}");
    }
    let mut bytes = binary_ply(false);
    let at = bytes.len() - 4 - 4;
    bytes[at..at + 4].copy_from_slice(&4u32.to_le_bytes());
    let error = refusal(&bytes, Format::Ply);
    assert_eq!(error.to_string(), format!("byte {}: the face refers to node 4 of 4", at + 4));
    assert_eq!(error.index(), Some(at + 4));
}

const TETRAHEDRON_STL: &str = "solid thing with a name\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\nendloop\nendfacet
FACET NORMAL 0 0 0\nOUTER LOOP\nVERTEX 0 0 0\nVERTEX 1 0 0\nVERTEX 0 0 1\nENDLOOP\nENDFACET
facet normal 0 0 0\nouter loop\nvertex 1 0 0\nvertex 0 1 0\nvertex 0 0 1\nendloop\nendfacet
facet normal 0 0 0\nouter loop\nvertex 0 1 0\nvertex -0.0 0e5 0\nvertex 0 0 1e0\nendloop\nendfacet\nendsolid thing\n";

fn binary_stl(header: &str) -> Vec<u8> {
    let mut bytes = header.as_bytes().to_vec();
    bytes.resize(80, b' ');
    let corners = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    let points = [[0f32, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    bytes.extend(4u32.to_le_bytes());
    for triangle in corners {
        bytes.extend([0; 12]);
        triangle.iter().flat_map(|&i: &usize| points[i]).for_each(|x| bytes.extend(x.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

#[test]
fn stl_is_welded_in_text_and_binary() {
    let text = mesh(TETRAHEDRON_STL, Format::Stl);
    assert_eq!((text.0.points().len(), text.0.genus(), text.1.welded_nodes), (4, 0, 8));
    assert!(text.0.loops().is_empty());
    for header in ["by hand", "solid of 80 bytes"] {
        assert_eq!(read_bytes(&binary_stl(header), Format::Stl, &OPTIONS).as_ref(), Ok(&text));
    }
    let cut = sentence(&TETRAHEDRON_STL.replace("vertex 0 1 0\nvertex 1 0 0\n", ""), Format::Stl);
    assert_eq!(cut, "line 5: a facet has 1 corners, it needs three");
    let word = sentence(&TETRAHEDRON_STL.replacen("outer", "inner", 1), Format::Stl);
    assert_eq!(word, "line 3: 'inner' should not stand here");
}

#[test]
fn concave_polygons_are_cut_into_ears() {
    let area = |mesh: &Mesh| {
        let corners = mesh.triangles().iter().map(|t| t.map(|i| mesh.points()[i as usize]));
        corners.map(|[a, b, c]| (b - a).cross(c - a) / 2.0).collect::<Vec<_>>()
    };
    // an L with a corner in the middle of a side, tilted; any fan of it is wrong
    let corners = [[0, 0], [1, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]];
    for turn in 0..7 {
        let nodes = corners.iter().cycle().skip(turn).take(7).map(|[x, y]| format!("{x} {y} {x}\n"));
        let (letter, _) =
            mesh(&format!("OFF\n7 1 0\n{}7 0 1 2 3 4 5 6\n", nodes.collect::<String>()), Format::Off);
        let areas = area(&letter);
        assert!(areas.iter().all(|normal| normal.z > 0.0), "turn {turn}: {areas:?}");
        assert_eq!(areas.iter().map(|normal| normal.z).sum::<f64>(), 3.0, "turn {turn}");
        assert!(letter.is_disk());
    }
    // a triangle written as a quad
    let (triangle, _) = mesh("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4 0 1 2 2\n", Format::Off);
    assert_eq!(triangle.triangles(), [[0, 1, 2]]);
    let same = refusal("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4 1 1 1 1\n", Format::Off);
    assert_eq!(same, MeshError::NoArea { count: 1 }.into());
}

#[test]
fn welded_files_keep_parameters_that_agree_and_fields() {
    let rows = |last: &str| {
        format!(
            "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n\
             property float u\nproperty float v\nproperty float heat\nelement face 2\n\
             property list uchar int vertex_index\nend_header\n0 0 0 0 0 1\n1 0 0 1 0 2\n1 1 0 1 1 3\n\
             0 0 0 0 0 4\n1 1 0 1 1 5\n0 1 0 {last} 6\n3 0 1 2\n3 3 4 5\n"
        )
    };
    let options = OPTIONS.with_weld_distance(1e-6);
    let (welded, repairs) = read_bytes(rows("0 1").as_bytes(), Format::Ply, &options).unwrap();
    assert_eq!(welded.field("heat"), Some(&[1.0, 2.0, 3.0, 6.0][..]));
    assert_eq!(welded.parameters().unwrap()[3], DVec2::Y);
    assert!(!repairs.dropped_parameters && welded.component_count() == 1);
    let seam = rows("0 1").replace("0 0 0 0 0 4", "0 0 0 9 9 4");
    let (welded, repairs) = read_bytes(seam.as_bytes(), Format::Ply, &options).unwrap();
    assert!(repairs.dropped_parameters && welded.parameters().is_none());
    let (bad, repairs) = read_bytes(rows("0 nan").as_bytes(), Format::Ply, &options).unwrap();
    assert!(repairs.dropped_parameters && bad.parameters().is_none());
}

#[test]
fn names_and_contents_tell_the_format() {
    for (name, format) in
        [("a.OFF", Format::Off), ("b.obj", Format::Obj), ("c.d.ply", Format::Ply), ("e.STL", Format::Stl)]
    {
        assert_eq!(Format::of_path(Path::new(name)), Some(format));
    }
    assert_eq!(Format::of_path(Path::new("mesh.txt")), None);
    assert_eq!(Format::of_bytes(ascii_ply().as_bytes()), Some(Format::Ply));
    assert_eq!(Format::of_bytes(&binary_stl("by hand")), Some(Format::Stl));
    assert_eq!(Format::of_bytes(TETRAHEDRON_STL.as_bytes()), Some(Format::Stl));
    assert_eq!(Format::of_bytes(b"# cube\n\nv 0 0 0\n"), Some(Format::Obj));
    assert_eq!(Format::of_bytes(b"STOFF 3 1 0"), Some(Format::Off));
    assert_eq!(Format::of_bytes(b"x,y,z\n1,2,3\n"), None);
}

#[test]
fn missing_files_are_named() {
    let error = read(Path::new("no/such/mesh.off"), &OPTIONS).unwrap_err();
    assert_eq!((error.kind(), error.index()), (ErrorKind::File, None));
    assert!(error.to_string().starts_with("cannot read 'no/such/mesh.off': "), "{error}");
}

/// A hilly grid of `side` by `side` squares without some of its triangles.
fn hills(side: u32, scale: f64, removed: &[usize]) -> Mesh {
    let place = |node: u32| {
        let [x, y] = [node % (side + 1), node / (side + 1)].map(f64::from);
        DVec3::new(x, y, (x * 1.3).sin() * (y * 0.7).cos()) * scale + scale * 1e3
    };
    let squares = (0..side).flat_map(|j| (0..side).map(move |i| j * (side + 1) + i));
    let all: Vec<[u32; 3]> =
        squares.flat_map(|a| [[a, a + 1, a + side + 2], [a, a + side + 2, a + side + 1]]).collect();
    let kept = all.iter().enumerate().filter(|(t, _)| !removed.contains(t)).map(|(_, &triangle)| triangle);
    let mut mesh =
        Mesh::new((0..(side + 1) * (side + 1)).map(place).collect(), kept.collect()).expect("a grid");
    mesh.set_field("height", mesh.points().iter().map(|point| point.z).collect()).expect("one for each node");
    mesh
}

proptest! {
    #[test]
    fn what_is_written_is_read(
        side in 1u32..6,
        scale in prop::sample::select(vec![1e-6, 0.1, 1.0, 1e6]),
        removed in prop::collection::vec(1usize..72, 0..5),
    ) {
        let mesh = hills(side, scale, &removed);
        prop_assume!(mesh.pinched_nodes().is_empty()); // these would be parted
        let numbers = |point: &DVec3| format!("{} {:e} {}", point.x, point.y, point.z);
        let (nodes, faces) = (mesh.points().len(), mesh.triangles().len());
        let rows = |begin: &str, end: &dyn Fn(&DVec3) -> String| -> String {
            mesh.points().iter().map(|point| format!("{begin}{}{}\n", numbers(point), end(point))).collect()
        };
        let corners = |begin: &str, base: u32| -> String {
            mesh.triangles().iter().map(|t| format!("{begin} {} {} {}\n", t[0] + base, t[1] + base, t[2] + base)).collect()
        };
        let nothing = |_: &DVec3| String::new();
        let height = |point: &DVec3| format!(" {}", point.z);
        let off = format!("OFF\n{nodes} {faces} 0\n{}{}", rows("", &nothing), corners("3", 0));
        let obj = format!("{}{}", rows("v ", &nothing), corners("f", 1));
        let ply = format!(
            "ply\nformat ascii 1.0\nelement vertex {nodes}\nproperty double x\nproperty double y\nproperty double z\n\
             property double height\nelement face {faces}\nproperty list uchar int vertex_indices\nend_header\n{}{}",
            rows("", &height), corners("3", 0)
        );
        for (text, format) in [(off, Format::Off), (obj, Format::Obj), (ply, Format::Ply)] {
            let (read, repairs) = read_bytes(text.as_bytes(), format, &OPTIONS).unwrap();
            prop_assert_eq!(read.points(), mesh.points());
            prop_assert_eq!(read.triangles(), mesh.triangles());
            prop_assert_eq!(read.topology(), mesh.topology());
            prop_assert_eq!(read.field("height"), mesh.field("height").filter(|_| format == Format::Ply));
            prop_assert_eq!(repairs, MeshRepairs { unused_nodes: mesh.unused_nodes().len(), ..MeshRepairs::default() });
        }
    }

    #[test]
    fn scattered_corners_weld_to_the_mesh_they_came_from(
        side in 1u32..6,
        seed in any::<u64>(),
        exponent in -9i32..-1,
    ) {
        let mesh = hills(side, 1.0, &[]);
        let distance = 10f64.powi(exponent);
        let mut state = seed | 1;
        let mut jitter = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            ((state >> 40) as f64 / 2f64.powi(24) - 0.5) * distance / 2.0 // corners of one node: within sqrt(3) / 2
        };
        let corners: Vec<DVec3> = mesh.triangles().iter().flatten()
            .map(|&i| mesh.points()[i as usize] + DVec3::new(jitter(), jitter(), jitter()))
            .collect();
        let triangles = (0..corners.len() as u32 / 3).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
        let (welded, repairs) =
            Mesh::with_options(corners, triangles, &OPTIONS.with_weld_distance(distance)).unwrap();
        prop_assert_eq!(welded.points().len(), mesh.points().len());
        prop_assert_eq!(welded.edge_count(), mesh.edge_count());
        prop_assert_eq!((welded.loops().len(), repairs.dropped_triangles), (1, 0));
        let map = repairs.node_map.unwrap();
        for (corner, &old) in mesh.triangles().iter().flatten().enumerate() {
            let moved = welded.points()[map[corner] as usize].distance(mesh.points()[old as usize]);
            prop_assert!(moved <= distance, "corner {} moved {:e}", corner, moved);
        }
    }

    #[test]
    fn noise_never_panics(bytes in prop::collection::vec(any::<u8>(), 0..300), seed in 0usize..4) {
        let starts = [&b"ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
                         element face 1\nproperty list uchar int vertex_index\nend_header\n"[..], b"OFF\n3 1 0\n", b"solid\n", b"v "];
        let file = [starts[seed], &bytes].concat();
        for format in [Format::Off, Format::Obj, Format::Ply, Format::Stl] {
            drop(read_bytes(&file, format, &OPTIONS));
        }
    }
}

#[test]
fn numbers_on_faces_of_ply_are_found_by_name() {
    let text = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
        element face 2\nproperty list uchar int vertex_indices\nproperty int label\nend_header\n\
        0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 7\n3 0 2 3 9\n";
    assert_eq!(ply::face_property(text.as_bytes(), "label").unwrap(), [7.0, 9.0]);
    let none = ply::face_property(text.as_bytes(), "colour").unwrap_err();
    assert!(none.to_string().contains("'colour'"), "{none}");
}
