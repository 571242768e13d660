//! Fits over layouts with creases, made by hand.

use super::tests::*;
use super::*;
use crate::fit::common::report::Remarks;
use crate::layout::of_mesh::{LayoutKind, MeshLayoutOptions};
use crate::layout::{CUBE_FACES, Creases, HalfEdge, Side};
use crate::mesh::FeatureOptions;
use crate::model::{Frame, Patchwork, Plane, PlaneFace, Planes, Rim, Role, of_patches};
use crate::samples::layouts::{PlacedQuads, numbered_edges};
use crate::surface::g1::{Space, normal_jump};
use glam::DVec3;
use std::f64::consts::PI;

/// The quads of the cube with their corners.
fn cube() -> PlacedQuads {
    let layout = Layout::cube();
    let mut places = vec![DVec3::ZERO; 8];
    for (face, quad) in CUBE_FACES.iter().zip(layout.quads()) {
        for (uv, &vertex) in [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y].into_iter().zip(quad) {
            places[vertex as usize] = face.point(uv);
        }
    }
    (layout.quads().to_vec(), places)
}

/// A prism of four sides, each end with a quad at every side and one in the middle.
fn prism() -> PlacedQuads {
    let ring = |height: f64, radius: f64| {
        (0..4).map(move |k| {
            let (sin, cos) = (PI / 2.0 * f64::from(k)).sin_cos();
            DVec3::new(radius * cos, radius * sin, height)
        })
    };
    let places = ring(-0.6, 1.0).chain(ring(0.6, 1.0)).chain(ring(-0.6, 0.4)).chain(ring(0.6, 0.4));
    let around = (0..4).map(|k| [k, (k + 1) % 4]);
    let wall = around.clone().map(|[a, b]| [a, b, 4 + b, 4 + a]);
    let bottom = around.clone().map(|[a, b]| [b, a, 8 + a, 8 + b]).chain([[11, 10, 9, 8]]);
    let top = around.map(|[a, b]| [4 + a, 4 + b, 12 + b, 12 + a]).chain([[12, 13, 14, 15]]);
    (wall.chain(bottom).chain(top).collect(), places.collect())
}

fn creased(quads: &[[u32; 4]], sharp: &[[u32; 2]], angle: impl Fn(usize) -> f64) -> Layout {
    let (numbers, sharp) = numbered_edges(quads, sharp);
    let angle = |sector: &crate::layout::Sector| angle(sector.valence());
    Layout::with_creases(quads, &numbers, &Creases { sharp: &sharp, angle: &angle }).unwrap()
}

/// The prism with its two rims sharp, which go straight on.
fn prism_layout() -> (Layout, PlacedQuads) {
    let quads = prism();
    let rims: Vec<[u32; 2]> = (0..8).map(|k| [k, k / 4 * 4 + (k + 1) % 4]).collect();
    (creased(&quads.0, &rims, |_| PI), quads)
}

/// The cube with the edges around one face sharp; the other three quads at its corners meet at `angle` between them.
fn box_with_lid(angle: f64) -> (Layout, PlacedQuads) {
    let quads = cube();
    let rim: Vec<[u32; 2]> = (0..4).map(|k| [quads.0[0][k], quads.0[0][(k + 1) % 4]]).collect();
    (creased(&quads.0, &rim, |valence| if valence == 1 { PI / 2.0 } else { angle }), quads)
}

/// A cube with one sharp edge, which ends in the smooth rest at both ends.
fn cube_with_dart() -> (Layout, PlacedQuads) {
    let quads = cube();
    let edge = [quads.0[0][0], quads.0[0][1]];
    (creased(&quads.0, &[edge], |_| PI), quads)
}

#[test]
fn a_cube_of_sharp_edges_is_exact() {
    let quads = cube();
    let all: Vec<[u32; 2]> = Layout::cube().edges().iter().map(|edge| edge.ends).collect();
    let layout = creased(&quads.0, &all, |_| PI / 2.0);
    for level in [0, 2] {
        let space = Space::new(&layout, uniform(&layout, level).unwrap()).unwrap();
        let places = dense_places(&space, 5);
        let points = between_vertices(&quads, &places, true);
        let surfaces = solve(&space, &places, &points, 1e-4);
        let between = dense_places(&space, 7);
        let exact = between_vertices(&quads, &between, true);
        let misses = points_at(&surfaces, &between).into_iter().zip(exact).map(|(a, b)| a.distance(b));
        let miss = misses.fold(0.0, f64::max);
        // normal equations of a condition of some hundreds, solved for numbers up to 1
        assert!(miss <= 512.0 * f64::EPSILON, "level {level}: {miss:e}");
        assert_eq!(normal_jump(&layout, &surfaces).unwrap().normal, 0.0, "no edge is smooth");
        // the shape really has edges
        let corner = points_at(&surfaces, &[Place { quad: 0, uv: DVec2::ZERO }])[0];
        assert!(corner.distance(quads.1[quads.0[0][0] as usize]) <= 2048.0 * f64::EPSILON, "{corner}");
    }
}

#[test]
fn patches_are_smooth_between_creases_and_share_them() {
    let (prism, prism_quads) = prism_layout();
    check_smoothness_over("prism", &prism, &prism_quads, [2, 20], true);
    for angle in [0.6, 1.5, 2.4, 4.0, 5.4] {
        let (layout, quads) = box_with_lid(angle);
        check_smoothness_over(&format!("wedges of {angle}"), &layout, &quads, [2, 20], false);
    }
    let (dart, quads) = cube_with_dart();
    check_smoothness_over("dart", &dart, &quads, [2, 20], false);
}

#[test]
fn shapes_with_creases_converge_at_order_four() {
    let cases = [
        ("prism", prism_layout(), true),
        ("wedge", box_with_lid(2.4), false),
        ("dart", cube_with_dart(), false),
    ];
    for (name, (layout, quads), is_flat) in cases {
        let order = orders_over(&layout, &quads, 1, [2, 3], is_flat);
        assert!(order >= 3.5, "{name}: {order}");
    }
}

/// The wall of a cylinder of radius 1 and height 2, triangulated in `turn` by `rows` squares, with the places of its nodes on
/// the wall of [`wall_layout`]; `slip` displaces them along the rims.
fn wall(turn: u32, rows: u32, slip: f64) -> (Mesh, Vec<Option<Place>>) {
    let mut points = Vec::new();
    let mut places = Vec::new();
    for row in 0..=rows {
        for k in 0..turn {
            let (height, around) = (f64::from(row) / f64::from(rows), f64::from(k) / f64::from(turn));
            let (sin, cos) = (2.0 * PI * around).sin_cos();
            points.push(DVec3::new(cos, sin, 2.0 * height));
            let slipped = 4.0 * around + slip * (8.0 * PI * around).sin();
            let quad = (slipped.floor() as u32).min(3);
            places.push(Some(Place { quad, uv: DVec2::new(slipped - f64::from(quad), height) }));
        }
    }
    let squares = (0..turn * rows).map(|at| (at / turn * turn, at % turn));
    let triangles = squares.flat_map(|(row, k)| {
        let [a, b] = [row + k, row + (k + 1) % turn];
        [[a, b, b + turn], [a, b + turn, a + turn]]
    });
    (Mesh::new(points, triangles.collect()).unwrap(), places)
}

/// Four quads around, with the planes of the caps.
fn wall_layout() -> (Layout, Constraints, Planes) {
    let quads: Vec<[u32; 4]> = (0..4).map(|k| [k, (k + 1) % 4, 4 + (k + 1) % 4, 4 + k]).collect();
    let layout = creased(&quads, &[], |_| PI);
    let planes = [(DVec3::NEG_Z, 0.0), (DVec3::Z, 2.0)];
    let mut constraints = Constraints {
        planes: planes.map(|(normal, offset)| PlaneEquation { normal, offset }).to_vec(),
        ..Constraints::default()
    };
    let mut faces = Vec::new();
    for (number, side) in [(0_u32, 0_u8), (1, 2)] {
        let edges = (0..4).map(|quad| layout.edge_of(Side { quad, side }));
        let mut rims: Vec<Rim> = edges.map(|edge| Rim::Edge(edge.reversed())).collect();
        // the sides above run against the way around, those below along it
        if side == 0 {
            rims.reverse();
        }
        for rim in &rims {
            let Rim::Edge(HalfEdge { edge, .. }) = *rim else { continue };
            constraints.of_edges.insert(edge, vec![number]);
        }
        let (normal, offset) = planes[number as usize];
        let frame = Frame::new(offset * normal, normal, DVec3::X).unwrap();
        faces.push(PlaneFace { plane: Plane(frame), loops: vec![rims], label: number });
    }
    (layout, constraints, Planes { vertices: Vec::new(), faces })
}

#[test]
fn a_cylinder_is_its_wall_between_two_planes() {
    let (layout, constraints, planes) = wall_layout();
    for slip in [0.0, 0.04] {
        let (mesh, places) = wall(60, 12, slip);
        let options = ModelOptions::default().with_smoothing(1e-3);
        let places = NodePlaces::Patches(&places);
        let mut control = Control::new(1);
        let fit = fit_with_creases(&mesh, &layout, places, &constraints, &options, &mut control).unwrap();
        let report = &fit.report;
        assert!(report.max_error <= report.tolerance, "slip {slip}: {report:?}");
        assert_eq!(report.folded_cells, 0, "slip {slip}");
        assert!(report.normal_jump <= 1e-12 && report.gap <= 4.0 * f64::EPSILON, "slip {slip}: {report:?}");
        // the rims miss their nodes by less than half of what the facets say between them
        assert!(report.crease_error <= 0.5 * report.tolerance, "slip {slip}: {:e}", report.crease_error);
        assert!(report.coefficient_count <= 700, "slip {slip}: {}", report.coefficient_count);
        // each rim lies in its plane to rounding of coordinates up to 2
        let along: Vec<Place> = (0..4 * 33)
            .map(|k| Place { quad: k / 33, uv: DVec2::new(f64::from(k % 33) / 32.0, 0.0) })
            .collect();
        for (height, offset) in [(0.0, 0.0), (1.0, 2.0)] {
            let rim: Vec<Place> =
                along.iter().map(|at| Place { uv: DVec2::new(at.uv.x, height), ..*at }).collect();
            let off = points_at(&fit.surfaces, &rim).iter().map(|p| (p.z - offset).abs()).fold(0.0, f64::max);
            assert!(off <= 16.0 * f64::EPSILON, "slip {slip}: {off:e}");
        }

        let piece = Patchwork {
            layout: &layout,
            surfaces: &fit.surfaces,
            planes: Some(&planes),
            labels: &[],
            void_in: None,
        };
        let model = of_patches(&[piece], 1).unwrap().model;
        assert_eq!((model.shells().len(), model.shells()[0].role), (1, Role::Solid));
        assert_eq!(model.euler_characteristic(), 2);
        let measure = model.measure();
        assert!(measure.max_gap <= 1e-12 && measure.free_edge_count == 0, "{measure:?}");
        let exact = [2.0 * PI, 6.0 * PI];
        assert!(
            (measure.volume / exact[0] - 1.0).abs() <= 5e-4,
            "slip {slip}: {}",
            measure.volume / exact[0]
        );
        assert!((measure.area / exact[1] - 1.0).abs() <= 1e-3, "slip {slip}: {}", measure.area / exact[1]);
    }
}

#[test]
fn a_fold_is_told() {
    let (layout, constraints, _) = wall_layout();
    let (mesh, mut places) = wall(60, 12, 0.0);
    let fit = |places: &[Option<Place>]| {
        let options = ModelOptions::default().with_smoothing(1e-3).with_max_rounds(1);
        let places = NodePlaces::Patches(places);
        fit_with_creases(&mesh, &layout, places, &constraints, &options, &mut Control::new(1)).unwrap()
    };
    assert_eq!(fit(&places).report.folded_cells, 0);
    // inside one patch the map runs backwards
    for place in places.iter_mut().flatten() {
        let is_inside = (0.01..0.99).contains(&place.uv.x) && (0.01..0.99).contains(&place.uv.y);
        if place.quad == 0 && is_inside {
            place.uv.x = 1.0 - place.uv.x;
        }
    }
    let report = fit(&places).report;
    assert!(report.folded_cells > 0 && report.remarks.has(Remarks::FOLDED_PARAMETERS), "{report:?}");
}

/// A solid between rings of as many points, each ring joined with the next, the first and the last with a point.
fn lathe(rings: &[Vec<DVec3>], ends: [DVec3; 2]) -> Mesh {
    let turn = rings[0].len() as u32;
    let points: Vec<DVec3> = rings.iter().flatten().copied().chain(ends).collect();
    let last = (rings.len() as u32 - 1) * turn;
    let [first_end, last_end] = [0, 1].map(|k| last + turn + k);
    let around = (0..turn).map(|k| [k, (k + 1) % turn]);
    let mut triangles: Vec<[u32; 3]> = Vec::new();
    for [a, b] in around {
        triangles.extend([[b, a, first_end], [last + a, last + b, last_end]]);
        for row in (0..last).step_by(turn as usize) {
            let [a, b] = [row + a, row + b];
            triangles.extend([[a, b, b + turn], [a, b + turn, a + turn]]);
        }
    }
    Mesh::new(points, triangles).unwrap()
}

/// A ring of `turn` points at a height.
fn ring(turn: u32, radius: f64, height: f64) -> Vec<DVec3> {
    let at = |k: u32| {
        let (sin, cos) = (2.0 * PI * f64::from(k) / f64::from(turn)).sin_cos();
        DVec3::new(radius * cos, radius * sin, height)
    };
    (0..turn).map(at).collect()
}

/// Rings of squares from one ring to the next, `wall` of them on each step.
fn between(from: &[DVec3], to: &[DVec3], count: u32) -> Vec<Vec<DVec3>> {
    let at = |k: u32| from.iter().zip(to).map(|(a, b)| a.lerp(*b, f64::from(k) / f64::from(count))).collect();
    (0..count).map(at).collect()
}

/// A cylinder of radius 1 and height 2, closed.
fn cylinder() -> Mesh {
    let [low, high] = [0.0, 2.0].map(|height| ring(60, 1.0, height));
    let caps = [0.0, 2.0].map(|height| ring(60, 0.5, height));
    let mut rings = vec![caps[0].clone()];
    rings.extend(between(&low, &high, 12));
    rings.extend([high, caps[1].clone()]);
    lathe(&rings, [DVec3::ZERO, DVec3::new(0.0, 0.0, 2.0)])
}

/// A plate of 4 by 3 by 1 with a hole of radius 0.7 through its middle.
fn holed_plate() -> Mesh {
    // as many points on the rectangle, with its corners among them
    let outline: Vec<DVec3> = (0..64)
        .map(|k| {
            let (side, at) = (k / 16, f64::from(k % 16) / 16.0);
            let corners = [[2.0, -1.5], [2.0, 1.5], [-2.0, 1.5], [-2.0, -1.5]];
            let [a, b] = [side, (side + 1) % 4].map(|k| DVec2::from_array(corners[k as usize]));
            a.lerp(b, at).extend(0.0)
        })
        .collect();
    let hole: Vec<DVec3> = outline
        .iter()
        .map(|p| {
            let angle = p.y.atan2(p.x);
            DVec3::new(0.7 * angle.cos(), 0.7 * angle.sin(), 0.0)
        })
        .collect();
    let raised = |ring: &[DVec3]| -> Vec<DVec3> { ring.iter().map(|p| *p + DVec3::Z).collect() };
    // down the hole, out below, up outside, in above
    let corners = [raised(&hole), hole, outline.clone(), raised(&outline)];
    let rings: Vec<Vec<DVec3>> =
        (0..4).flat_map(|k| between(&corners[k], &corners[(k + 1) % 4], [6, 4, 3, 4][k])).collect();
    let turn = 64;
    let count = rings.len() as u32;
    let squares = (0..count * turn).map(|at| (at / turn, at % turn));
    let triangles = squares.flat_map(|(row, k)| {
        let node = |row: u32, k: u32| row % count * turn + k % turn;
        let [a, b, c, d] = [node(row, k), node(row, k + 1), node(row + 1, k + 1), node(row + 1, k)];
        [[a, b, c], [a, c, d]]
    });
    Mesh::new(rings.iter().flatten().copied().collect(), triangles.collect()).unwrap()
}

/// A shaft of radius 1 and height 1 with one of radius 0.6 on it.
fn stepped_shaft() -> Mesh {
    let [low, step, shoulder, high] =
        [(1.0, 0.0), (1.0, 1.0), (0.6, 1.0), (0.6, 2.0)].map(|(radius, height)| ring(60, radius, height));
    let mut rings = vec![ring(60, 0.5, 0.0)];
    rings.extend(between(&low, &step, 8));
    rings.extend(between(&step, &shoulder, 3));
    rings.extend(between(&shoulder, &high, 8));
    rings.extend([high, ring(60, 0.3, 2.0)]);
    lathe(&rings, [DVec3::ZERO, DVec3::new(0.0, 0.0, 2.0)])
}

/// Patches and planes are what a part becomes, closed, within the tolerance and of its size; `curved` regions of it.
fn check_part(name: &str, mesh: &Mesh, [planes, curved]: [usize; 2], [volume, area]: [f64; 2], euler: i64) {
    let fit = fit_mesh(
        mesh,
        &MeshModelOptions { exact: false, ..MeshModelOptions::default() },
        &mut Control::new(1),
    )
    .unwrap();
    let (report, model) = (&fit.report, &fit.model);
    assert_eq!(fit.components[0].exact_faces, planes, "{name}");
    assert!(report.patches.len() <= 6 * curved, "{name}: {} patches", report.patches.len());
    assert!(report.coefficient_count <= 700 * curved, "{name}: {}", report.coefficient_count);
    assert!(report.max_error <= report.tolerance, "{name}: {report:?}");
    assert_eq!(report.folded_cells, 0, "{name}");
    assert!(report.normal_jump <= 1e-12, "{name}: {:e}", report.normal_jump);
    assert_eq!((model.shells().len(), model.shells()[0].role), (1, Role::Solid), "{name}");
    assert_eq!(model.euler_characteristic(), euler, "{name}");
    let measure = model.measure();
    assert!(measure.max_gap <= 1e-12 && measure.free_edge_count == 0, "{name}: {measure:?}");
    assert!((measure.volume / volume - 1.0).abs() <= 5e-4, "{name}: {}", measure.volume / volume);
    assert!((measure.area / area - 1.0).abs() <= 1e-3, "{name}: {}", measure.area / area);
    // each node lies on a face where its place says
    for (node, place) in fit.places.iter().enumerate() {
        let (face, uv) = place.unwrap();
        let point = model.carrier(face).points(&[uv])[0];
        let distance = point.distance(mesh.points()[node]);
        assert!(distance <= fit.errors[node] + 1e-12, "{name}: node {node}, {distance:e}");
    }
}

#[test]
fn parts_become_patches_between_planes() {
    check_part("cylinder", &cylinder(), [2, 1], [2.0 * PI, 6.0 * PI], 2);
    let disk = 0.49 * PI;
    let sides = 14.0 + 1.4 * PI;
    check_part("holed plate", &holed_plate(), [6, 1], [12.0 - disk, 2.0 * (12.0 - disk) + sides], 0);
    let shaft = [1.36 * PI, (2.0 + 2.0 + 1.2) * PI];
    check_part("stepped shaft", &stepped_shaft(), [3, 2], shaft, 2);
}

#[test]
fn patches_that_are_asked_for_keep_sharp_edges_and_the_cube_says_that_it_does_not() {
    let fit = |kind: LayoutKind| {
        let layout = MeshLayoutOptions::default().with_kind(kind);
        let options = MeshModelOptions { exact: false, layout, ..MeshModelOptions::default() };
        fit_mesh(&cylinder(), &options, &mut Control::new(1)).unwrap().components.remove(0)
    };
    let (complex, cube) = (fit(LayoutKind::Complex), fit(LayoutKind::Cube));
    assert!(complex.exact_faces == 2 && !complex.rounds_edges, "{complex:?}");
    assert!(cube.layout == Some(LayoutKind::Cube) && cube.rounds_edges, "{cube:?}");
}

#[test]
fn faces_have_the_labels_of_their_regions() {
    let mesh = cylinder();
    let middle = |t: &[u32; 3]| t.iter().map(|&node| mesh.points()[node as usize]).sum::<DVec3>() / 3.0;
    let label = |middle: DVec3| match middle.z {
        low if low < 1e-9 => 7,
        high if high > 2.0 - 1e-9 => 8,
        _ if middle.y > 0.0 => 5,
        _ => 6,
    };
    let labels: Vec<u32> = mesh.triangles().iter().map(|t| label(middle(t))).collect();
    let features = FeatureOptions::default().with_labels(&labels);
    let options = MeshModelOptions { exact: false, features, ..MeshModelOptions::default() };
    let fit = fit_mesh(&mesh, &options, &mut Control::new(1)).unwrap();
    assert!(fit.report.max_error <= fit.report.tolerance, "{:?}", fit.report);
    let count = |label: u32| fit.model.faces().iter().filter(|face| face.label == label).count();
    assert_eq!((count(7), count(8)), (1, 1));
    assert!(count(5) > 0 && count(6) > 0 && count(0) == 0);
    // the map back: inside a region a node lies on a face of its label
    for (node, place) in fit.places.iter().enumerate() {
        let around: Vec<u32> = mesh.outgoing(node as u32).map(|edge| labels[edge.triangle()]).collect();
        let is_inside = around.iter().all(|&label| label == around[0]);
        assert!(!is_inside || fit.model.face(place.unwrap().0).label == around[0], "node {node}");
    }
}

#[test]
fn strips_of_a_wing_become_two_skins_between_planes() {
    let crate::samples::Strips { mesh, labels, volume } = crate::samples::wing_strips(1).unwrap();
    let features = FeatureOptions::default().with_labels(&labels).with_label_angle(5.0_f64.to_radians());
    let options = MeshModelOptions::default().with_features(features);
    let fit = fit_mesh(&mesh, &options, &mut Control::new(1)).unwrap();
    let (report, model) = (&fit.report, &fit.model);
    assert!(report.max_error <= report.tolerance && report.folded_cells == 0, "{report:?}");
    let mut labels_of_faces: Vec<u32> = model.faces().iter().map(|face| face.label).collect();
    labels_of_faces.sort_unstable();
    assert_eq!((labels_of_faces, fit.components[0].exact_faces), (vec![0, 20, 40, 41], 2));
    assert_eq!((model.free_edge_count(), model.euler_characteristic()), (0, 2));
    assert!(report.gap <= 1e-12 && model.edges().iter().all(|edge| edge.is_sharp), "{report:?}");
    // all of the model is within the tolerance of the body, whose area is at most that of both skins' boxes and ends
    let off = (model.measure().volume / volume - 1.0).abs();
    assert!(off <= report.tolerance * model.measure().area / volume, "{off:e}");
    // the map back: each node lies on a face of its skin or end, and the mesh there tells the strip
    let skin = |label: u32| if label < 40 { label / 20 * 20 } else { label };
    let tree = crate::query::triangles::TriangleTree::new(&mesh);
    for (node, place) in fit.places.iter().enumerate() {
        let (face, uv) = place.unwrap();
        let of_face = model.face(face).label;
        let around: Vec<u32> = mesh.outgoing(node as u32).map(|edge| labels[edge.triangle()]).collect();
        assert!(around.iter().any(|&label| skin(label) == of_face), "node {node}");
        if around.iter().all(|&label| label == around[0]) {
            let near = tree.nearest(model.carrier(face).points(&[uv])[0]).unwrap();
            assert_eq!(labels[near.triangle as usize], around[0], "node {node}");
        }
    }
}

#[test]
fn smooth_patches_have_the_labels_that_most_of_them_comes_from() {
    let mesh = crate::samples::ball(1500, 1).unwrap();
    let is_high = |t: &[u32; 3]| t.iter().map(|&node| mesh.points()[node as usize].z).sum::<f64>() > 0.0;
    let labels: Vec<u32> = mesh.triangles().iter().map(|t| 3 + u32::from(is_high(t))).collect();
    let features = FeatureOptions::default().with_sharp_angle(None).with_labels(&labels).with_label_angle(PI);
    let options = MeshModelOptions::default().with_exact(false).with_features(features);
    let fit = fit_mesh(&mesh, &options, &mut Control::new(1)).unwrap();
    assert!((0..fit.model.edges().len()).all(|edge| !fit.model.edges()[edge].is_sharp));
    let mut votes = vec![[0; 2]; fit.model.faces().len()];
    for (triangle, &label) in mesh.triangles().iter().zip(&labels) {
        for (face, _) in triangle.iter().filter_map(|&node| fit.places[node as usize]) {
            votes[face.index()][label as usize - 3] += 1;
        }
    }
    for (face, [low, high]) in fit.model.faces().iter().zip(votes) {
        let is_most = if face.label == 3 { low >= high } else { face.label == 4 && high >= low };
        assert!(is_most, "label {} of {low} and {high}", face.label);
    }
}

#[test]
fn planes_under_noise_stay_planes() {
    use crate::samples::machine::{any_part, roughened};
    const NOISE: f64 = 0.01;
    for seed in [17, 181] {
        let clean = any_part(seed).unwrap().mesh;
        let mesh = roughened(&clean, NOISE, seed).unwrap();
        let fit = fit_mesh(&mesh, &MeshModelOptions::default(), &mut Control::new(1)).unwrap();
        let (report, model) = (&fit.report, &fit.model);
        // a prism whose sides meet too bluntly under noise: patches between two planes, without the folds of smooth ones
        assert_eq!(fit.components[0].exact_faces, 2, "seed {seed}");
        assert!(!report.patches.is_empty() && report.folded_cells == 0, "seed {seed}: {report:?}");
        assert_eq!((model.free_edge_count(), report.crossings), (0, Some(0)), "seed {seed}");
        let is_missed = report.max_error > report.tolerance;
        assert_eq!(report.remarks.has(Remarks::TOLERANCE_NOT_MET), is_missed, "seed {seed}");
        // least squares of many nodes tilt a plane by less than one deviation over its size does
        let sigma = NOISE * super::exact::mean_edge(&clean);
        let height = clean.bounds().max[2] - clean.bounds().min[2];
        let width = (clean.diagonal().powi(2) - height * height).sqrt();
        let planes: Vec<Plane> = (model.faces().iter())
            .filter_map(|face| match model.surface(face.surface) {
                crate::model::Carrier::Plane(plane) => Some(*plane),
                _ => None,
            })
            .collect();
        assert_eq!(planes.len(), 2, "seed {seed}");
        for Plane(frame) in planes {
            let tilt = frame.z().cross(DVec3::Z).length();
            assert!(tilt <= sigma / (0.25 * width), "seed {seed}: {tilt:e}, deviation {sigma:e}");
            let ends = [clean.bounds().min[2], clean.bounds().max[2]];
            let off =
                ends.map(|end| (frame.origin().z - end).abs()).into_iter().fold(f64::INFINITY, f64::min);
            assert!(off <= sigma, "seed {seed}: {off:e}, deviation {sigma:e}");
        }
    }
}

#[test]
fn bends_larger_than_noise_are_no_planes() {
    use super::exact::evidence::Evidence;
    let (places, triangles) = crate::samples::grid([20, 20], 0.2, 5, |_| true);
    let all: Vec<u32> = (0..triangles.len() as u32).collect();
    let mut random = crate::samples::Random::new(9);
    let noise: Vec<f64> = places.iter().map(|_| random.signed()).collect();
    // a quadric bend of 1 leaves a mean square of 4/45 of a plane, uniform noise of 1 one of 1/3: five bends are 6.7 times it
    for (bend, is_straight) in [(0.0, true), (0.3, true), (5.0, false)] {
        let height = |(k, p): (usize, &DVec2)| 1e-3 * (noise[k] + bend * (2.0 * p.x - 1.0).powi(2));
        let points = places.iter().enumerate().map(|at| at.1.extend(height(at))).collect();
        let mesh = Mesh::new(points, triangles.clone()).unwrap();
        let evidence = Evidence::new(&mesh, &all).unwrap();
        let Plane(frame) = evidence.plane().unwrap();
        assert_eq!(evidence.is_straight(&frame), is_straight, "bend {bend}");
    }
}
