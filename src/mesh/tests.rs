use super::*;
use crate::error::ErrorKind;

fn points(count: usize) -> Vec<DVec3> {
    (0..count).map(|i| DVec3::new(i as f64, (i * i) as f64, 0.5 * i as f64)).collect()
}

fn mesh(triangles: &[[u32; 3]]) -> Mesh {
    let count = triangles.iter().flatten().max().map_or(0, |&node| node as usize + 1);
    Mesh::new(points(count), triangles.to_vec()).unwrap_or_else(|error| panic!("{triangles:?}: {error}"))
}

fn refusal(triangles: &[[u32; 3]]) -> MeshError {
    let count = triangles.iter().flatten().max().map_or(0, |&node| node as usize + 1);
    Mesh::new(points(count), triangles.to_vec()).expect_err("not a mesh")
}

/// A band of `count` quads, closed to a ring; with a half turn it is a Moebius strip.
fn band(count: u32, half_turn: bool) -> Vec<[u32; 3]> {
    let node = |i: u32, side: u32| {
        let turned = i == count && half_turn;
        2 * (i % count) + if turned { 1 - side } else { side }
    };
    let quad = |i| [[node(i, 0), node(i + 1, 0), node(i + 1, 1)], [node(i, 0), node(i + 1, 1), node(i, 1)]];
    (0..count).flat_map(quad).collect()
}

/// A grid of quads closed in both directions.
fn torus(m: u32, n: u32) -> Vec<[u32; 3]> {
    let node = |i: u32, j: u32| (i % m) * n + j % n;
    let quads = (0..m).flat_map(|i| (0..n).map(move |j| (i, j)));
    quads
        .flat_map(|(i, j)| {
            let [a, b, c, d] = [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)];
            [[a, b, c], [a, c, d]]
        })
        .collect()
}

const TETRAHEDRON: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
const BOW_TIE: [[u32; 3]; 2] = [[0, 1, 2], [2, 3, 4]];

/// (components, loops, Euler characteristic, genus, edges)
fn census(mesh: &Mesh) -> (usize, usize, i64, usize, usize) {
    (mesh.component_count(), mesh.loops().len(), mesh.euler_characteristic(), mesh.genus(), mesh.edge_count())
}

#[test]
fn known_shapes_have_their_topology() {
    assert_eq!(census(&mesh(&[[0, 1, 2]])), (1, 1, 1, 0, 3));
    assert_eq!(census(&mesh(&TETRAHEDRON)), (1, 0, 2, 0, 6));
    assert_eq!(census(&mesh(&band(5, false))), (1, 2, 0, 0, 20));
    assert_eq!(census(&mesh(&torus(4, 5))), (1, 0, 0, 1, 60));
    let two: Vec<[u32; 3]> =
        TETRAHEDRON.iter().chain(&TETRAHEDRON.map(|t| t.map(|i| i + 4))).copied().collect();
    assert_eq!(census(&mesh(&two)), (2, 0, 4, 0, 12));
    let mut holed = torus(4, 5);
    holed.remove(7);
    assert_eq!(census(&mesh(&holed)), (1, 1, -1, 1, 60));
}

#[test]
fn pinched_nodes_are_allowed_and_named() {
    let bow_tie = mesh(&BOW_TIE);
    assert_eq!(census(&bow_tie), (2, 2, 1, 0, 6));
    assert_eq!(bow_tie.pinched_nodes(), [2]);
    assert!(!bow_tie.is_disk());
    let mut nodes: Vec<u32> = bow_tie.neighbours(2).collect();
    nodes.sort_unstable();
    assert_eq!(nodes, [0, 1, 3, 4]);
    // two tetrahedra that share a node: two spheres, no handle
    let other = TETRAHEDRON.map(|t| t.map(|i| i + 3));
    let touching: Vec<[u32; 3]> = TETRAHEDRON.iter().chain(&other).copied().collect();
    assert_eq!(census(&mesh(&touching)), (2, 0, 3, 0, 12));
    assert_eq!(mesh(&touching).pinched_nodes(), [3]);
}

#[test]
fn refusals_name_the_offender() {
    let triangle = vec![[0, 1, 2]];
    assert_eq!(Mesh::new(vec![], triangle.clone()), Err(MeshError::NoPoints));
    assert_eq!(Mesh::new(points(3), vec![]), Err(MeshError::NoTriangles));
    let mut bad = points(3);
    bad[1].y = f64::NAN;
    assert_eq!(Mesh::new(bad, triangle), Err(MeshError::NotFinite { node: 1 }));
    let range = Mesh::new(points(3), vec![[0, 1, 2], [1, 3, 2]]);
    assert_eq!(range, Err(MeshError::IndexOutOfRange { triangle: 1, node: 3, first: 0, last: 2 }));
    assert_eq!(refusal(&[[0, 1, 2], [2, 1, 2]]), MeshError::RepeatedNode { triangle: 1, node: 2 });
    assert_eq!(refusal(&[[0, 1, 2], [1, 2, 0]]), MeshError::DuplicateTriangle { triangle: 1, first: 0 });
    assert_eq!(refusal(&[[0, 1, 2], [1, 0, 2]]), MeshError::DuplicateTriangle { triangle: 1, first: 0 });
    let page = refusal(&[[3, 1, 2], [1, 3, 4], [3, 1, 0]]);
    assert_eq!(page, MeshError::NonManifoldEdge { nodes: [1, 3], triangle_count: 3 });
    assert_eq!(page.to_string(), "the edge between nodes 1 and 3 has 3 triangles, a mesh allows two");
    assert_eq!((page.kind(), page.index()), (ErrorKind::Topology, Some(1)));
    let turned = refusal(&[[0, 1, 2], [1, 2, 3]]);
    assert_eq!(turned, MeshError::InconsistentOrientation { nodes: [1, 2], triangles: [0, 1] });
    assert_eq!((turned.kind(), turned.index()), (ErrorKind::Topology, Some(1)));
}
