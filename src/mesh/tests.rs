use super::*;
use crate::failure::{Classify, ErrorKind};

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
    let sentence =
        "the edge between nodes 1 and 3 has 3 triangles, a mesh allows two; the repair 'sheets' parts them";
    assert_eq!(page.to_string(), sentence);
    assert_eq!((page.kind(), page.index()), (ErrorKind::Topology, Some(1)));
    let turned = refusal(&[[0, 1, 2], [1, 2, 3]]);
    assert_eq!(turned, MeshError::InconsistentOrientation { nodes: [1, 2], triangles: [0, 1] });
    assert_eq!((turned.kind(), turned.index()), (ErrorKind::Topology, Some(1)));
}

#[test]
fn loops_run_with_the_interior_on_the_left_and_the_longest_comes_first() {
    // an annulus: nodes 2i on the inner circle, 2i + 1 on the outer
    let count = 6;
    let place = |node: u32| {
        let angle = f64::from(node / 2) * std::f64::consts::TAU / f64::from(count);
        let radius = f64::from(1 + node % 2);
        DVec3::new(radius * angle.cos(), radius * angle.sin(), 0.0)
    };
    let turned = band(count, false).iter().map(|&[a, b, c]| [a, c, b]).collect();
    let annulus = Mesh::new((0..2 * count).map(place).collect(), turned).unwrap();
    assert_eq!(annulus.loops(), [vec![1, 3, 5, 7, 9, 11], vec![0, 10, 8, 6, 4, 2]]);
    assert!(annulus.is_disk());
}

#[test]
fn rings_of_neighbours_turn_counter_clockwise_from_the_boundary() {
    // +-- 3 --+     a fan of four right angles around 0, then without the one from 4 to 1
    // 4   0   2
    // +-- 1 --+
    let closed = mesh(&[[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]]);
    assert_eq!(closed.neighbours(0).collect::<Vec<_>>(), [1, 2, 3, 4]);
    assert!(!closed.is_boundary(0) && closed.is_boundary(1));
    assert_eq!(closed.neighbours(2).collect::<Vec<_>>(), [3, 0, 1]);
    let open = mesh(&[[0, 2, 3], [0, 3, 4], [0, 1, 2]]);
    assert_eq!(open.neighbours(0).collect::<Vec<_>>(), [1, 2, 3, 4]);
    let edge = open.edge_between(0, 4).unwrap();
    assert_eq!((edge.origin(open.triangles()), edge.target(open.triangles())), (4, 0));
    assert_eq!(open.edge_between(1, 4), None);
    assert_eq!(open.topology().twin(edge), None);
}

#[test]
fn nodes_without_triangles_are_allowed_and_do_not_count() {
    let mut far = points(5);
    far[3] = DVec3::splat(1e9);
    let mesh = Mesh::new(far, vec![[0, 1, 2], [2, 1, 4]]).unwrap();
    assert_eq!(mesh.unused_nodes(), [3]);
    assert!(!mesh.is_used(3) && mesh.is_used(4));
    assert_eq!(mesh.euler_characteristic(), 1);
    assert_eq!(mesh.bounds().max, [4.0, 16.0, 2.0]);
    assert_eq!(mesh.neighbours(3).count(), 0);
}

#[test]
fn orientation_is_repaired_by_the_fewest_turns() {
    let good = torus(5, 6);
    let mut bad = good.clone();
    for t in [0, 1, 2, 17, 40] {
        bad[t].swap(0, 1);
    }
    assert!(matches!(Mesh::new(points(30), bad.clone()), Err(MeshError::InconsistentOrientation { .. })));
    let options = MeshOptions::default();
    let none = Mesh::with_options(points(30), bad.clone(), &options.with_repair(Repair::NONE)).unwrap_err();
    assert!(matches!(none, MeshError::InconsistentOrientation { .. }), "{none}");
    let (mesh, repairs) = Mesh::with_options(points(30), bad, &options).unwrap();
    assert_eq!(repairs, MeshRepairs { flipped_triangles: 5, ..MeshRepairs::default() });
    assert_eq!(mesh.genus(), 1);
    let outward = |triangle: &[u32; 3]| {
        let start = (0..3).min_by_key(|&k| triangle[k]).unwrap();
        [0, 1, 2].map(|k| triangle[(start + k) % 3])
    };
    let sides = |triangles: &[[u32; 3]]| triangles.iter().map(outward).collect::<Vec<_>>();
    assert_eq!(sides(mesh.triangles()), sides(&good));
    assert!(Mesh::with_options(points(30), good, &options).unwrap().1.is_empty());
}

#[test]
fn a_moebius_strip_is_refused_for_having_one_side() {
    let strip = band(5, true);
    assert!(matches!(refusal(&strip), MeshError::InconsistentOrientation { .. }));
    let options = MeshOptions::default();
    let error = Mesh::with_options(points(10), strip, &options).unwrap_err();
    assert!(matches!(error, MeshError::NonOrientable { .. }), "{error}");
    assert_eq!(error.kind(), ErrorKind::Topology);
}

#[test]
fn welding_joins_near_nodes_and_no_chain_collapses() {
    // a row of nodes 0.6 apart: neighbours are within 1, but all of them are not
    let row: Vec<DVec3> = (0..9).map(|i| DVec3::new(0.6 * f64::from(i), 0.0, 0.0)).collect();
    assert_eq!(weld::weld(&row, 1.0), [0, 0, 2, 2, 4, 4, 6, 6, 8]);
    assert_eq!(weld::weld(&row, 0.5), [0, 1, 2, 3, 4, 5, 6, 7, 8]);
    assert_eq!(weld::weld(&[DVec3::ZERO, -DVec3::ZERO, DVec3::X, DVec3::ZERO], 0.0), [0, 0, 2, 0]);
    // far below the spacing of the numbers
    assert_eq!(weld::weld(&[DVec3::splat(1e15), DVec3::ONE, DVec3::splat(1e15)], 1e-300), [0, 1, 0]);
}

#[test]
fn welding_reports_what_it_did_in_the_callers_numbers() {
    let quad = vec![DVec3::ZERO, DVec3::X, DVec3::ONE, DVec3::X, DVec3::Y, DVec3::ONE, DVec3::Y];
    let triangles = vec![[0, 1, 2], [4, 0, 5], [4, 6, 5]];
    let options = MeshOptions::default().with_weld_distance(1e-9);
    let (mesh, repairs) = Mesh::with_options(quad.clone(), triangles, &options).unwrap();
    let node_map = Some(vec![0, 1, 2, 1, 3, 2, 3]);
    let expected = MeshRepairs { welded_nodes: 3, dropped_triangles: 1, node_map, ..MeshRepairs::default() };
    assert_eq!(repairs, expected);
    assert_eq!(mesh.triangles(), [[0, 1, 2], [3, 0, 2]]);
    assert_eq!(mesh.loops().len(), 1);

    let twice = vec![[4, 6, 5], [0, 1, 2], [0, 3, 5]];
    let no_copies = options.with_repair(Repair::NONE.with(Repair::UNUSED_NODES));
    let error = Mesh::with_options(quad.clone(), twice.clone(), &no_copies).unwrap_err();
    assert_eq!(error, MeshError::DuplicateTriangle { triangle: 2, first: 1 });
    let (once, repairs) = Mesh::with_options(quad.clone(), twice, &options).unwrap();
    assert_eq!((repairs.dropped_triangles, repairs.duplicate_triangles, repairs.unused_nodes), (1, 1, 1));
    assert_eq!(once.triangle_origins().collect::<Vec<_>>(), [1]);
    assert_eq!(once.node_origins().collect::<Vec<_>>(), [0, 1, 2, 4]);
    let nothing = Mesh::with_options(quad.clone(), vec![[4, 6, 5]], &options).unwrap_err();
    assert_eq!(nothing, MeshError::NothingLeft { distance: 1e-9 });
    let bad = Mesh::with_options(quad, vec![[0, 1, 2]], &options.with_weld_distance(-1.0)).unwrap_err();
    assert_eq!(bad, MeshError::WeldDistance { distance: -1.0 });
}

/// The faults that each repair mends, alone: the nodes, the triangles, and what refuses them.
fn faults() -> [(Repair, usize, Vec<[u32; 3]>, MeshError); 6] {
    [
        (Repair::UNUSED_NODES, 4, vec![[0, 1, 2]], MeshError::UnusedNode { node: 3 }),
        (
            Repair::REPEATED_CORNERS,
            3,
            vec![[0, 1, 1], [0, 1, 2]],
            MeshError::RepeatedNode { triangle: 0, node: 1 },
        ),
        (
            Repair::DUPLICATE_TRIANGLES,
            3,
            vec![[0, 1, 2], [2, 1, 0]],
            MeshError::DuplicateTriangle { triangle: 1, first: 0 },
        ),
        (Repair::TOUCHING_NODES, 5, BOW_TIE.to_vec(), MeshError::TouchingNode { node: 2 }),
        (
            Repair::ORIENTATION,
            4,
            vec![[0, 1, 2], [1, 2, 3]],
            MeshError::InconsistentOrientation { nodes: [1, 2], triangles: [0, 1] },
        ),
        (
            Repair::SHEETS,
            5,
            vec![[3, 1, 2], [1, 3, 4], [3, 1, 0]],
            MeshError::NonManifoldEdge { nodes: [1, 3], triangle_count: 3 },
        ),
    ]
}

#[test]
fn each_repair_mends_its_fault_and_no_other() {
    for (repair, count, triangles, fault) in faults() {
        let others =
            Repair::from_bits(0b11_1111 & !(1 << faults().iter().position(|f| f.0 == repair).unwrap()));
        let make = |repair| {
            Mesh::with_options(points(count), triangles.clone(), &MeshOptions::default().with_repair(repair))
        };
        assert_eq!(make(others.unwrap()).unwrap_err(), fault, "{repair:?}");
        assert_eq!(make(Repair::NONE).unwrap_err(), fault, "{repair:?}");
        let (mesh, repairs) = make(repair).unwrap_or_else(|error| panic!("{repair:?}: {error}"));
        assert!(!repairs.is_empty(), "{repair:?}");
        for (node, origin) in mesh.node_origins().enumerate() {
            assert_eq!(mesh.points()[node], points(count)[origin as usize]);
        }
    }
}

#[test]
fn unused_nodes_may_hold_anything() {
    let mut bad = points(4);
    bad[0] = DVec3::NAN;
    bad.push(DVec3::INFINITY);
    for weld in [0.0, 1e-3] {
        let options = MeshOptions::default().with_weld_distance(weld);
        let (mesh, repairs) = Mesh::with_options(bad.clone(), vec![[1, 2, 3]], &options).unwrap();
        assert_eq!((repairs.unused_nodes, mesh.points().len()), (2, 5));
        assert_eq!(mesh.bounds().max, [3.0, 9.0, 1.5]);
        let piece = mesh.without_unused_nodes().unwrap();
        assert_eq!(piece.nodes, [1, 2, 3]);
    }
    let used = Mesh::with_options(bad, vec![[1, 2, 4]], &MeshOptions::default()).unwrap_err();
    assert_eq!(used, MeshError::NotFinite { node: 4 });
}

#[test]
fn touching_nodes_are_split_and_their_copies_appended() {
    let other = TETRAHEDRON.map(|t| t.map(|i| i + 3));
    let touching: Vec<[u32; 3]> = TETRAHEDRON.iter().chain(&other).copied().collect();
    let (mesh, repairs) = Mesh::with_options(points(7), touching.clone(), &MeshOptions::default()).unwrap();
    assert_eq!((repairs.split_nodes, mesh.points().len()), (1, 8));
    assert!(mesh.pinched_nodes().is_empty());
    assert_eq!(census(&mesh), (2, 0, 4, 0, 12));
    assert_eq!(mesh.node_origins().last(), Some(3));
    assert_eq!(mesh.triangle_origins().collect::<Vec<_>>(), (0..8).collect::<Vec<_>>());
    // one component alone does not touch itself
    let options = MeshOptions::default().with_components(Components::One(1));
    let (part, repairs) = Mesh::with_options(points(7), touching, &options).unwrap();
    assert_eq!((repairs.split_nodes, repairs.excluded_triangles, part.unused_nodes()), (0, 4, vec![0, 1, 2]));
    assert_eq!(part.triangle_origins().collect::<Vec<_>>(), [4, 5, 6, 7]);
}

#[test]
fn the_largest_component_is_picked() {
    let mut triangles = vec![[5, 6, 7]];
    triangles.extend(TETRAHEDRON);
    triangles.extend(TETRAHEDRON.map(|t| t.map(|i| i + 8)));
    let make = |components| {
        let options = MeshOptions::default().with_components(components);
        Mesh::with_options(points(12), triangles.clone(), &options)
    };
    let (mesh, repairs) = make(Components::Largest).unwrap();
    assert_eq!((mesh.triangles(), repairs.excluded_triangles), (&TETRAHEDRON[..], 5));
    assert!(repairs.unused_nodes == 1 && !repairs.is_empty(), "node 4 alone was never used: {repairs:?}");
    let error = make(Components::One(3)).unwrap_err();
    assert_eq!(error, MeshError::NoSuchComponent { component: 3, count: 3 });
}

#[test]
fn sheets_are_parted_where_more_than_two_meet() {
    let options = MeshOptions::default().with_repair(Repair::ALL);
    // a tetrahedron with a fin on the edge from 0 to 1: the body stays closed
    let mut finned = TETRAHEDRON.to_vec();
    finned.push([0, 1, 4]);
    let (mesh, repairs) = Mesh::with_options(points(5), finned, &options).unwrap();
    assert_eq!((repairs.parted_edges, repairs.split_nodes), (1, 2));
    assert_eq!(census(&mesh), (2, 1, 3, 0, 9));
    assert_eq!(mesh.triangles()[..4], TETRAHEDRON);
    // two tetrahedra that share an edge
    let other = TETRAHEDRON.map(|t| t.map(|i| if i < 2 { i } else { i + 2 }));
    let two: Vec<[u32; 3]> = TETRAHEDRON.iter().chain(&other).copied().collect();
    let (mesh, repairs) = Mesh::with_options(points(6), two, &options).unwrap();
    assert_eq!((repairs.parted_edges, repairs.split_nodes), (1, 2));
    assert_eq!(census(&mesh), (2, 0, 4, 0, 12));
    // pages of a book
    let book: Vec<[u32; 3]> = (0..5).map(|page| [0, 1, 2 + page]).collect();
    let (mesh, _) = Mesh::with_options(points(7), book, &options).unwrap();
    assert_eq!((mesh.component_count(), mesh.points().len()), (5, 7 + 8));
}

#[test]
fn moved_nodes_keep_everything_else() {
    let mut mesh = mesh(&[[0, 1, 2]]);
    mesh.set_field("t", vec![1.0, 2.0, 3.0]).unwrap();
    let moved = vec![DVec3::ZERO, DVec3::X, DVec3::Y];
    mesh.set_points(moved.clone()).unwrap();
    assert_eq!((mesh.points(), mesh.field("t")), (&moved[..], Some(&[1.0, 2.0, 3.0][..])));
    assert_eq!(mesh.set_points(vec![]), Err(MeshError::PointCount { given: 0, count: 3 }));
    let nan = vec![DVec3::ZERO, DVec3::NAN, DVec3::Y];
    assert_eq!(mesh.set_points(nan), Err(MeshError::NotFinite { node: 1 }));
    assert!(mesh.remove_field("t") && !mesh.remove_field("t") && mesh.fields().is_empty());
}

#[test]
fn index_base_is_subtracted_and_errors_keep_it() {
    let options = MeshOptions::default().with_index_base(1);
    let (mesh, repairs) = Mesh::with_options(points(3), vec![[1, 2, 3]], &options).unwrap();
    assert_eq!((mesh.triangles(), repairs.is_empty()), (&[[0, 1, 2]][..], true));
    for node in [0, 4] {
        let error = Mesh::with_options(points(3), vec![[1, 2, node]], &options).unwrap_err();
        assert_eq!(error, MeshError::IndexOutOfRange { triangle: 0, node, first: 1, last: 3 });
        assert_eq!(error.to_string(), format!("triangle 0 refers to node {node}, but nodes run from 1 to 3"));
    }
}

#[test]
fn parameters_and_fields_are_checked() {
    let mut mesh = mesh(&[[0, 1, 2]]);
    let uv = vec![DVec2::ZERO, DVec2::X, DVec2::Y];
    assert_eq!(mesh.set_parameters(vec![]), Err(MeshError::ParameterCount { given: 0, count: 3 }));
    let nan = vec![DVec2::ZERO, DVec2::X, DVec2::NAN];
    assert_eq!(mesh.set_parameters(nan), Err(MeshError::ParameterNotFinite { node: 2 }));
    assert_eq!(mesh.parameters(), None);
    mesh.set_parameters(uv.clone()).unwrap();
    assert_eq!(mesh.parameters(), Some(&uv[..]));
    mesh.clear_parameters();
    assert_eq!(mesh.parameters(), None);
    let error = MeshError::FieldCount { name: "t".into(), given: 1, count: 3 };
    assert_eq!(mesh.set_field("t", vec![1.0]), Err(error));
    mesh.set_field("t", vec![1.0, 2.0, 3.0]).unwrap();
    mesh.set_field("t", vec![4.0, 5.0, 6.0]).unwrap();
    assert_eq!((mesh.fields().len(), mesh.field("t")), (1, Some(&[4.0, 5.0, 6.0][..])));
}

mod cutting {
    use super::*;

    /// A square grid of 4 by 4 nodes in the plane, node 4j + i at (i, j).
    fn grid() -> Mesh {
        let points = (0..16).map(|n| DVec3::new(f64::from(n % 4), f64::from(n / 4), 0.0)).collect();
        let quads = (0..3).flat_map(|j| (0..3).map(move |i| 4 * j + i));
        let triangles = quads.flat_map(|n| [[n, n + 1, n + 5], [n, n + 5, n + 4]]).collect();
        let mut mesh = Mesh::new(points, triangles).unwrap();
        mesh.set_parameters(mesh.points().iter().map(|p| p.truncate() / 3.0).collect()).unwrap();
        mesh.set_field("number", (0..16).map(f64::from).collect()).unwrap();
        mesh
    }

    fn check_carried(mesh: &Mesh, piece: &Piece) {
        assert_eq!(piece.nodes.len(), piece.mesh.points().len());
        for (new, &old) in piece.nodes.iter().enumerate() {
            assert_eq!(piece.mesh.points()[new], mesh.points()[old as usize]);
            assert_eq!(piece.mesh.parameters().unwrap()[new], mesh.parameters().unwrap()[old as usize]);
            assert_eq!(piece.mesh.field("number").unwrap()[new], f64::from(old));
        }
    }

    #[test]
    fn removed_triangles_leave_a_hole_and_lonely_nodes_go() {
        let mesh = grid();
        let hole = mesh.remove_triangles(&[8, 9, 8]).unwrap(); // the quad in the middle
        check_carried(&mesh, &hole);
        assert_eq!(census(&hole.mesh), (1, 2, 0, 0, 32));
        let corner = mesh.remove_triangles(&[0, 1]).unwrap();
        assert_eq!(corner.nodes, (1..16).collect::<Vec<_>>());
        let error = mesh.remove_triangles(&[18]).unwrap_err();
        assert_eq!(error, CutError::NoSuchTriangle { triangle: 18, count: 18 });
        let all: Vec<u32> = (0..18).collect();
        assert_eq!(mesh.remove_triangles(&all), Err(CutError::Mesh(MeshError::NoTriangles)));
    }

    #[test]
    fn paths_double_their_inner_nodes_and_their_ends_on_the_boundary() {
        let mesh = grid();
        let through = mesh.cut_along(&[1, 5, 9, 13]).unwrap();
        check_carried(&mesh, &through);
        assert_eq!(through.nodes[16..], [1, 5, 9, 13]);
        assert_eq!(through.mesh.component_count(), 2);
        let halves = through.mesh.split_components().unwrap();
        assert_eq!(halves.iter().map(|half| half.mesh.triangles().len()).sum::<usize>(), 18);
        assert!(halves.iter().all(|half| half.mesh.is_disk()));
        let slit = mesh.cut_along(&[13, 9, 5]).unwrap();
        assert_eq!(slit.nodes[16..], [9, 13]);
        assert_eq!(census(&slit.mesh), (1, 1, 1, 0, 35));
        let inner = mesh.cut_along(&[5, 6, 10]).unwrap();
        assert_eq!(inner.nodes[16..], [6]);
        assert_eq!(inner.mesh.loops()[1].len(), 4);
        let closed = mesh.cut_along(&[5, 6, 10, 9, 5]).unwrap();
        assert_eq!((closed.nodes.len(), closed.mesh.component_count()), (20, 2));
    }

    #[test]
    fn paths_that_are_none_are_refused() {
        let mesh = grid();
        assert_eq!(mesh.cut_along(&[3]), Err(CutError::PathTooShort { node_count: 1 }));
        assert_eq!(mesh.cut_along(&[5, 16]), Err(CutError::NoSuchNode { node: 16, count: 16 }));
        assert_eq!(mesh.cut_along(&[1, 5, 8]), Err(CutError::NotAnEdge { from: 5, to: 8 }));
        assert_eq!(mesh.cut_along(&[5, 5]), Err(CutError::NotAnEdge { from: 5, to: 5 }));
        assert_eq!(mesh.cut_along(&[5, 6]), Err(CutError::NothingOpened { from: 5, to: 6 }));
        assert_eq!(mesh.cut_along(&[0, 1, 2]), Err(CutError::NothingOpened { from: 0, to: 2 }));
    }

    #[test]
    fn cuts_open_closed_meshes_to_disks() {
        let sphere = mesh(&TETRAHEDRON);
        let open = sphere.cut_along(&[0, 1, 2]).unwrap();
        assert!(open.mesh.is_disk());
        assert_eq!(open.mesh.loops()[0].len(), 4);
        // two circles that cross take the handle away: the crossing becomes four nodes
        let torus = mesh(&torus(4, 5));
        let path = [0, 5, 10, 15, 0, 1, 2, 3, 4, 0];
        let square = torus.cut_along(&path).unwrap();
        assert!(square.mesh.is_disk(), "{:?}", census(&square.mesh));
        assert_eq!(square.mesh.loops()[0].len(), 2 * (4 + 5));
    }

    #[test]
    fn shortest_paths_follow_edges() {
        let mesh = grid();
        assert_eq!(mesh.shortest_path(0, 15).unwrap(), [0, 5, 10, 15]);
        assert_eq!(mesh.shortest_path(3, 12).unwrap().len(), 7); // against the diagonals
        assert_eq!(mesh.shortest_path(7, 7).unwrap(), [7]);
        let two = super::mesh(&[[0, 1, 2], [3, 4, 5]]);
        assert_eq!(two.shortest_path(0, 4), Err(CutError::NotConnected { from: 0, to: 4 }));
    }
}
