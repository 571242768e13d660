use super::edge_curve::EdgeCurve;
use super::*;
use crate::layout::CUBE_FACES;
use crate::samples::layouts::{random_sphere, stellated_tetrahedron, torus, trapezohedron};
use crate::surface::Surface;
use glam::{DVec2, DVec3};

fn space(layout: &Layout, level: u32) -> Space<'_> {
    Space::new(layout, uniform(layout, level).unwrap()).unwrap()
}

#[test]
fn free_unknowns_are_counted_as_the_theory_does() {
    let cube = Layout::cube();
    for (level, count) in (0..).zip([24, 84, 348, 1452, 5964]) {
        assert_eq!(space(&cube, level).free_count(), count, "cube at level {level}");
    }
    let eight = Layout::new(&trapezohedron(8).0).unwrap();
    for (level, count) in (0..).zip([56, 216, 920]) {
        let space = space(&eight, level);
        assert_eq!((space.free_count(), space.enclosures().len()), (count, 2), "level {level}");
    }
    let stellated = Layout::new(&stellated_tetrahedron().0).unwrap();
    let space = space(&stellated, 1);
    assert_eq!((space.free_count(), space.enclosures().len()), (496, 4));
}

#[test]
fn a_cube_of_one_cell_a_face_is_the_body_worked_out_by_hand() {
    let cube = Layout::cube();
    let space = space(&cube, 0);
    let corner = |v: u32| DVec3::new(f64::from(v >> 2 & 1), f64::from(v >> 1 & 1), f64::from(v & 1));
    let mut unknowns: Vec<DVec3> = (0..8).map(corner).collect();
    for vertex in 0..8 {
        let sector = &cube.sectors_of(vertex)[0];
        let ends = [0, 1, 2].map(|k| {
            let edge = cube.edges()[sector.edges[k].edge as usize];
            corner(edge.ends[usize::from(sector.edges[k].is_forward)]) - corner(vertex)
        });
        let mean = ends.iter().sum::<DVec3>() / 3.0;
        let [t_0, t_1] = [ends[0] - mean, ends[1] - mean];
        let (sin, cos) = sector.corner_angle().sin_cos();
        unknowns.extend([t_0, (t_1 - cos * t_0) / sin]);
    }
    let rows: Vec<f64> = unknowns.iter().flat_map(|p| p.to_array()).collect();
    let surfaces = space.surfaces(&rows, 3).unwrap();

    let below = CUBE_FACES.iter().position(|face| face.normal == DVec3::NEG_Z).unwrap();
    let mut middle = [0.0; 3];
    surfaces[below].eval_rows(&[DVec2::splat(0.5)], 0, &mut middle);
    let tol = 64.0 * f64::EPSILON; // some thirty operations on numbers up to 4
    for (x, exact) in middle.into_iter().zip([0.5, 0.5, -11.0 / 48.0]) {
        assert!((x - exact).abs() <= tol, "{middle:?}");
    }
    let mut at_corner = [0.0; 18];
    surfaces[below].eval_rows(&[DVec2::ZERO], 2, &mut at_corner);
    let origin = CUBE_FACES[below].point(DVec2::ZERO);
    assert_eq!(at_corner[..3], (0.5 * (origin + DVec3::ONE)).to_array());
    // at (0,0,0) the twist of this face is -(1,1,3)/3; the face has that corner at one of its four
    let twist_at = |uv: DVec2| {
        let mut row = [0.0; 18];
        surfaces[below].eval_rows(&[uv], 2, &mut row);
        (DVec3::from_slice(&row[..3]), DVec3::from_slice(&row[12..15]))
    };
    let corners = [DVec2::ZERO, DVec2::X, DVec2::Y, DVec2::ONE].map(twist_at);
    let (_, twist) = corners.into_iter().find(|(point, _)| point.length() <= tol).unwrap();
    // on two of the corners one of the directions runs towards the corner
    let exact = DVec3::new(1.0, 1.0, 3.0) / -3.0;
    assert!(twist.distance(exact).min(twist.distance(-exact)) <= tol, "{twist}");

    let volume = enclosed_volume(&surfaces);
    assert!((volume - 2.12912068531).abs() <= 1e-11, "{volume}");
    let jump = normal_jump(&cube, &surfaces).unwrap();
    assert!(jump.normal <= 1e-14 && jump.gap <= 1e-15, "{jump:?}");
}

#[test]
fn edge_functions_have_the_values_worked_out_by_hand() {
    let quadratic = Rule::Quadratic { regular: End::Last };
    let g = quadratic.function([-1.0, 0.0], &[0.0, 0.25, 0.5, 0.75, 1.0]).unwrap();
    let tol = 8.0 * f64::EPSILON;
    assert!((g.values[3] + 1.0 / 7.0).abs() <= tol && (g.left[1] - 8.0 / 7.0).abs() <= tol, "{g:?}");
    assert_eq!((g.values[0], g.values[4], g.right[4]), (-1.0, 0.0, 0.0));
    // the pair 3|5 through a vertex of four: the common slope is 1
    let c = 2.0 * (2.0 * std::f64::consts::PI / 5.0).cos();
    let kinked = Rule::Kinked { regular: End::Last, slope: 1.0 };
    let from_five = kinked.function([c, 0.0], &[0.0, 0.5, 1.0]).unwrap();
    assert_eq!((from_five.values[1], from_five.right[1]), (-0.5, 1.0));
    assert!((from_five.left[1] - (-0.5 - c) * 2.0).abs() <= tol);
    let from_three = kinked.function([-1.0, 0.0], &[0.0, 0.5, 1.0]).unwrap();
    assert_eq!((from_three.left[1], from_three.right[1]), (1.0, 1.0));
    // seen from the other end g changes sign, its slopes do not
    let reversed =
        Rule::Kinked { regular: End::First, slope: 1.0 }.function([0.0, c], &[0.0, 0.5, 1.0]).unwrap();
    assert_eq!((reversed.values[1], reversed.left[1]), (0.5, 1.0));
}

#[test]
fn edge_curves_make_the_balance_a_smooth_cubic() {
    let breaks = [0.0, 0.125, 0.25, 0.5, 0.75, 1.0];
    let rules = [
        Rule::Linear,
        Rule::Kinked { regular: End::Last, slope: 0.7 },
        Rule::Kinked { regular: End::First, slope: 1.0 },
        Rule::Quadratic { regular: End::Last },
        Rule::Quadratic { regular: End::First },
    ];
    for rule in rules {
        let g = rule.function([-1.0, 0.6], &breaks).unwrap();
        let curve = EdgeCurve::new(&breaks, &g);
        for j in 1..breaks.len() - 1 {
            let rows = curve.second_right(j).into_iter().zip(curve.second_left(j)).zip(&curve.slopes[j]);
            for ((right, left), slope) in rows {
                let miss = g.values[j] * (right - left) + (g.right[j] - g.left[j]) * slope;
                // 6 / h^2 = 384 times a few roundings
                assert!(miss.abs() <= 32.0 * 384.0 * f64::EPSILON, "{rule:?} at {j}: {miss:e}");
            }
        }
        let quadratic_at = match g.quadratic {
            Some(End::First) => 0,
            Some(End::Last) => breaks.len() - 2,
            None => continue,
        };
        let ends = curve.second_right(quadratic_at).into_iter().zip(curve.second_left(quadratic_at + 1));
        assert!(ends.into_iter().all(|(a, b)| (a - b).abs() <= 32.0 * 384.0 * f64::EPSILON), "{rule:?}");
    }
}

#[test]
fn four_quads_meet_in_opposite_edges_of_equal_slopes() {
    // each edge that has a regular end says the same slope there as the opposite one, or g would not exist
    for (quads, _) in [stellated_tetrahedron(), random_sphere(9, 3), random_sphere(16, 4), torus(5, 4)] {
        let layout = Layout::new(&quads).unwrap();
        let space = space(&layout, 2); // its debug assertion checks all vertices of four
        assert!(space.coefficient_count() > 0);
    }
}

#[test]
fn meshes_are_made_to_agree_and_refused_where_they_do_not() {
    let cube = Layout::cube();
    let mut meshes = uniform(&cube, 1).unwrap();
    let corner = meshes[0].locate(DVec2::ZERO);
    meshes[0].split(corner);
    let corner = meshes[0].locate(DVec2::ZERO);
    meshes[0].split(corner);
    assert!(matches!(Space::new(&cube, meshes.clone()), Err(SpaceError::NotConforming { .. })));
    conform(&cube, &mut meshes);
    let space = Space::new(&cube, meshes).unwrap();
    // two neighbours were split twice, nobody else
    let leaves: Vec<usize> = space.meshes().iter().map(TMesh::leaf_count).collect();
    assert_eq!(leaves.iter().filter(|&&count| count == 10).count(), 3, "{leaves:?}");
    assert_eq!(leaves.iter().filter(|&&count| count == 4).count(), 3, "{leaves:?}");

    let stellated = Layout::new(&stellated_tetrahedron().0).unwrap();
    let coarse = Space::new(&stellated, uniform(&stellated, 0).unwrap());
    assert!(matches!(coarse, Err(SpaceError::TooCoarse { .. })));
    assert!(matches!(Space::new(&cube, Vec::new()), Err(SpaceError::MeshCount { .. })));
}
