use super::*;
use crate::failure::{Classify, ErrorKind};
use glam::DVec3;
use std::f64::consts::PI;

/// A torus of `m` times `n` quads.
fn torus(m: u32, n: u32) -> Vec<[u32; 4]> {
    let at = |i: u32, j: u32| (i % m) * n + j % n;
    (0..m * n)
        .map(|k| (k / n, k % n))
        .map(|(i, j)| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)])
        .collect()
}

#[test]
fn a_cube_has_eight_vertices_of_three_quads() {
    let cube = Layout::cube();
    assert_eq!((cube.quads().len(), cube.edges().len(), cube.vertex_count()), (6, 12, 8));
    assert_eq!(cube.genus(), Some(0));
    assert!((0..8).all(|v| cube.valence(v) == 3 && !cube.is_border(v)));
    for (edge, number) in cube.edges().iter().zip(0..) {
        let second = edge.second.unwrap();
        assert_eq!(cube.opposite(edge.first), Some(second));
        assert_eq!(cube.opposite(second), Some(edge.first));
        assert_eq!(cube.edge_of(second), HalfEdge { edge: number, is_forward: false });
        // both sides run along the same line of the cube
        let on = |place: Place| CUBE_FACES[place.quad as usize].point(place.uv);
        assert_eq!(on(edge.first.place(0.25, 0.0)), on(second.place(0.75, 0.0)));
    }
}

#[test]
fn sectors_run_counterclockwise_from_edge_to_edge() {
    let cube = Layout::cube();
    for sector in cube.sectors() {
        assert!(!sector.is_open() && (sector.balance() + 1.0).abs() <= 4.0 * f64::EPSILON);
        for (rank, corner) in sector.corners.iter().enumerate() {
            assert_eq!(cube.sector_at(*corner), sector);
            assert_eq!(cube.quads()[corner.quad as usize][corner.side as usize], sector.vertex);
            assert_eq!(cube.edge_of(*corner), sector.edges[rank]);
            assert_eq!(cube.edge_of(corner.previous()).reversed(), sector.edges[(rank + 1) % 3]);
        }
    }
}

#[test]
fn directions_find_their_place_on_the_cube() {
    for direction in [DVec3::new(0.3, -2.0, 1.0), DVec3::new(-1.0, 1.0, 1.0), DVec3::new(0.1, 0.2, 0.3)] {
        let place = cube_place(direction);
        let point = CUBE_FACES[place.quad as usize].point(place.uv);
        // one division and two roundings more
        assert!((point * direction.abs().max_element() - direction).length() <= 8.0 * f64::EPSILON * 2.0);
    }
}

#[test]
fn coordinates_of_sides_are_the_inverse_of_places() {
    for side in 0..4 {
        let side = Side { quad: 3, side };
        let place = side.place(0.25, 0.125);
        assert_eq!((place.quad, side.coordinates(place.uv)), (3, [0.25, 0.125]));
    }
}

#[test]
fn handles_borders_and_pieces_are_counted() {
    let layout = Layout::new(&torus(4, 3)).unwrap();
    assert_eq!((layout.genus(), layout.euler_characteristic()), (Some(1), 0));
    assert!(layout.sectors().iter().all(|sector| sector.balance() == 0.0));

    let open = Layout::new(&torus(4, 3)[1..]).unwrap();
    assert_eq!((open.genus(), open.euler_characteristic()), (None, -1));
    let corner = open.sectors_of(0);
    assert!(corner[0].is_open() && corner[0].valence() == 3 && corner[0].angle == PI);

    let mut two: Vec<[u32; 4]> = Layout::cube().quads().to_vec();
    two.extend(Layout::cube().quads().iter().map(|quad| quad.map(|v| v + 8)));
    assert_eq!(Layout::new(&two).unwrap().component_count(), 2);
}

#[test]
fn two_edges_may_join_the_same_vertices() {
    // a torus of two by one quads would repeat vertices; of two by two it has two edges between neighbours
    let quads = torus(2, 2);
    assert!(matches!(
        Layout::new(&quads),
        Err(LayoutError::CrowdedEdge { .. } | LayoutError::SameDirection { .. })
    ));
    let along = |i: u32, j: u32| (i % 2) * 2 + j % 2;
    let edges: Vec<[u32; 4]> = (0..4)
        .map(|k| (k / 2, k % 2))
        .map(|(i, j)| [along(i, j), 4 + along(i + 1, j), along(i, j + 1), 4 + along(i, j)])
        .collect();
    let layout = Layout::with_edges(&quads, &edges).unwrap();
    assert_eq!((layout.genus(), layout.edges().len()), (Some(1), 8));
}

#[test]
fn what_is_no_layout_is_named() {
    let cube = Layout::cube().quads().to_vec();
    let refuse = |quads: &[[u32; 4]]| Layout::new(quads).unwrap_err();
    assert_eq!(refuse(&[]).kind(), ErrorKind::InvalidArgument);
    assert_eq!(refuse(&[[0, 1, 2, 0]]), LayoutError::RepeatedVertex { quad: 0 });
    assert_eq!(refuse(&[[0, 1, 2, 900]]).kind(), ErrorKind::Index);
    let mut turned = cube.clone();
    turned[4].reverse();
    assert!(matches!(refuse(&turned), LayoutError::SameDirection { .. }));
    let mut crowded = cube.clone();
    crowded.push([cube[0][1], cube[0][0], 8, 9]);
    assert!(matches!(refuse(&crowded), LayoutError::CrowdedEdge { quad: 6, .. }));
    assert_eq!(refuse(&[[0, 1, 2, 3], [0, 4, 5, 6]]), LayoutError::NonManifoldVertex { vertex: 0 });
    // a doublet: vertex 0 lies between two quads
    let doublet = [[0, 1, 2, 3], [0, 3, 4, 1]];
    assert_eq!(refuse(&doublet), LayoutError::Valence { vertex: 0, valence: 2 });
    let moebius = [[0, 1, 4, 3], [1, 2, 5, 4], [2, 3, 0, 5]];
    assert_eq!(refuse(&moebius).kind(), ErrorKind::Topology);
}

/// The layout with some edges sharp, given by their ends, and all open sectors of one angle.
fn creased(quads: &[[u32; 4]], sharp: &[[u32; 2]], angle: f64) -> Result<Layout, LayoutError> {
    let (numbers, sharp) = crate::samples::layouts::numbered_edges(quads, sharp);
    Layout::with_creases(quads, &numbers, &Creases { sharp: &sharp, angle: &|_| angle })
}

#[test]
fn creases_part_the_quads_around_a_vertex() {
    let cube = Layout::cube();
    let quads = cube.quads();
    let all: Vec<[u32; 2]> = cube.edges().iter().map(|edge| edge.ends).collect();
    let sharp = creased(quads, &all, PI / 2.0).unwrap();
    assert!((0..8).all(|vertex| sharp.sectors_of(vertex).len() == 3));
    assert!(sharp.sectors().iter().all(|sector| sector.valence() == 1 && sector.is_open()));
    assert!((0..12).all(|edge| !sharp.is_smooth(edge)));
    assert_eq!(sharp.smooth_pieces(), [0, 1, 2, 3, 4, 5]);
    // pieces that creases join are one
    assert_eq!((sharp.component_count(), sharp.genus()), (1, Some(0)));

    // around one face: an edge of the cube that leaves it lies between two quads of the wall
    let around: Vec<[u32; 2]> = (0..4).map(|k| [quads[0][k], quads[0][(k + 1) % 4]]).collect();
    let lid = creased(quads, &around, PI).unwrap();
    let mut valences: Vec<usize> = lid.sectors_of(quads[0][0]).iter().map(Sector::valence).collect();
    valences.sort_unstable();
    assert_eq!(valences, [1, 2]);
    assert!(lid.sectors().iter().filter(|sector| sector.is_open()).all(Sector::is_straight));
    assert_eq!(lid.smooth_pieces(), [0, 1, 1, 1, 1, 1]);
}

#[test]
fn a_crease_that_ends_inside_is_a_dart_of_three_quads() {
    let quads = torus(4, 3);
    let dart = creased(&quads, &[[0, 3]], 1.0).unwrap();
    for vertex in [0, 3] {
        let [sector] = dart.sectors_of(vertex) else { panic!("{:?}", dart.sectors_of(vertex)) };
        assert!(sector.is_dart() && sector.valence() == 4 && sector.angle == 2.0 * PI);
    }
    assert_eq!(dart.smooth_pieces(), [0; 12]);
    // two quads do not span a plane around the end of a crease
    let pillow = [[0, 1, 2, 3], [0, 3, 2, 4]];
    assert_eq!(creased(&pillow, &[[0, 3]], 1.0), Err(LayoutError::Valence { vertex: 3, valence: 2 }));
    let cube = Layout::cube();
    let ends = cube.edges()[0].ends;
    let on_three = creased(cube.quads(), &[ends], 1.0).unwrap();
    assert!(on_three.sectors_of(ends[0])[0].is_dart());
}

#[test]
fn angles_of_sectors_do_not_contradict_each_other() {
    let cube = Layout::cube();
    let all: Vec<[u32; 2]> = cube.edges().iter().map(|edge| edge.ends).collect();
    // three straight sectors would make each tangent the opposite of itself
    let layout = creased(cube.quads(), &all, PI).unwrap();
    for vertex in 0..8 {
        let straight = layout.sectors_of(vertex).iter().filter(|sector| sector.is_straight()).count();
        assert_eq!(straight, 1, "vertex {vertex}");
    }
    // nearly straight is straight, and a wedge keeps away from it
    for (angle, expected) in [(2.9, PI), (2.6, 2.6), (4.0, 4.0), (0.01, 5.0_f64.to_radians())] {
        let lid = creased(&torus(4, 3)[1..], &[], angle).unwrap();
        for sector in lid.sectors().iter().filter(|sector| sector.is_open() && sector.valence() > 1) {
            assert!((sector.angle - expected).abs() <= 4.0 * f64::EPSILON, "{angle}: {}", sector.angle);
        }
    }
}
