use super::*;
use crate::control::{Control, Watch};
use crate::mesh::Mesh;
use crate::samples::machine::{self, Part};

fn fit(mesh: &Mesh, tolerance: f64) -> Result<ExactFit, Obstacle> {
    let absolute = tolerance * mesh.diagonal();
    Control::new(1).watch(|pool, _| fit_exact(mesh, absolute, &FeatureOptions::default(), pool)).unwrap()
}

fn parts() -> Vec<(&'static str, Part)> {
    vec![
        ("cylinder", machine::cylinder(3000, 1).unwrap()),
        ("box with hole", machine::box_with_hole(3000, 2).unwrap()),
        ("bracket", machine::angle_bracket(3000, 6).unwrap()),
        ("flange", machine::flange(5000, 3).unwrap()),
        ("shaft", machine::stepped_shaft(3000, 5).unwrap()),
        ("gear", machine::gear(5000, 4).unwrap()),
        ("slotted plate", machine::slotted_plate(3000, 7).unwrap()),
    ]
}

#[test]
fn parts_of_planes_and_cylinders_are_exact() {
    for (name, Part { mesh, face_count, volume, area }) in parts() {
        let fit = fit(&mesh, 1e-3).unwrap_or_else(|obstacle| panic!("{name}: {obstacle:?}"));
        assert_eq!(fit.model.faces().len(), face_count, "{name}");
        let measured = fit.model.measure();
        // nodes are exact, so faces are to the conditioning of least squares
        let tol = 1e-9;
        assert!((measured.volume / volume - 1.0).abs() < tol, "{name}: {} {volume}", measured.volume);
        assert!((measured.area / area - 1.0).abs() < tol, "{name}: {} {area}", measured.area);
        assert_eq!((measured.free_edge_count, fit.report.remarks), (0, Default::default()), "{name}");
        assert!(fit.report.max_error < 1e-11 * mesh.diagonal(), "{name}: {}", fit.report.max_error);
        assert!(fit.model.curve_deviation() < 1e-11 * mesh.diagonal(), "{name}");
        assert!(measured.max_gap < 1e-11 * mesh.diagonal() && measured.max_normal_jump < 1e-6, "{name}");
        for ((place, &error), &point) in fit.places.iter().zip(&fit.errors).zip(mesh.points()) {
            let (face, uv) = place.unwrap();
            assert!(fit.model.carrier(face).points(&[uv])[0].distance(point) <= error + 1e-14);
        }
    }
}

#[test]
fn coarse_meshes_are_exact_too() {
    for (name, Part { mesh, face_count, volume, .. }) in [
        ("cylinder", machine::cylinder(100, 1).unwrap()),
        ("flange", machine::flange(300, 3).unwrap()),
        ("slotted plate", machine::slotted_plate(200, 7).unwrap()),
    ] {
        let fit = fit(&mesh, 1e-3).unwrap_or_else(|obstacle| panic!("{name}: {obstacle:?}"));
        assert_eq!(fit.model.faces().len(), face_count, "{name}");
        assert!((fit.report.volume / volume - 1.0).abs() < 1e-9, "{name}: {} {volume}", fit.report.volume);
        // what lies between nodes is what facets explain
        assert!(fit.report.max_interior_error > 1e-3 * mesh.diagonal());
    }
}

#[test]
fn labels_part_faces_and_name_them() {
    let Part { mesh, .. } = machine::box_with_hole(2000, 1).unwrap();
    let middle = |t: &[u32; 3]| t.iter().map(|&node| mesh.points()[node as usize]).sum::<glam::DVec3>() / 3.0;
    // 7 on the top, 9 elsewhere
    let labels: Vec<u32> =
        mesh.triangles().iter().map(|t| if middle(t).z > 1.0 - 1e-9 { 7 } else { 9 }).collect();
    let options = FeatureOptions::default().with_labels(&labels);
    let fit = Control::new(1).watch(|pool, _| fit_exact(&mesh, 1e-3, &options, pool)).unwrap().unwrap();
    let count = |label: u32| fit.model.faces().iter().filter(|face| face.label == label).count();
    assert_eq!((count(7), count(9)), (1, 6));
    // nodes of the top's inside lie on the face with its label
    for (node, place) in fit.places.iter().enumerate() {
        let is_inside = mesh.outgoing(node as u32).all(|edge| labels[edge.triangle()] == 7);
        assert!(!is_inside || fit.model.face(place.unwrap().0).label == 7);
    }
}

#[test]
fn noise_moves_faces_by_less_than_itself() {
    for (name, Part { mesh, face_count, volume, .. }) in parts().into_iter().take(3) {
        let rough = machine::roughened(&mesh, 0.05, 3).unwrap();
        let fit = fit(&rough, 1e-3).unwrap_or_else(|obstacle| panic!("{name}: {obstacle:?}"));
        assert_eq!(fit.model.faces().len(), face_count, "{name}");
        assert!((fit.report.volume / volume - 1.0).abs() < 2e-3, "{name}: {} {volume}", fit.report.volume);
    }
}

#[test]
fn what_is_not_exact_is_told() {
    let ball = crate::samples::ball(1500, 1).unwrap();
    assert_eq!(fit(&ball, 1e-3).unwrap_err(), Obstacle::Region { region: 0 });
}

#[test]
fn most_parts_of_a_seeded_crowd_are_exact() {
    let mut told = Vec::new();
    for seed in 0..60 {
        let Part { mesh, face_count, volume, area } = machine::any_part(seed).unwrap();
        match fit(&mesh, 1e-3) {
            Ok(fit) => {
                let measured = fit.model.measure();
                let off = (measured.volume / volume - 1.0).abs().max((measured.area / area - 1.0).abs());
                let is_right = off < 1e-6 && measured.free_edge_count == 0;
                if !is_right || fit.model.faces().len() != face_count {
                    told.push(format!("{seed}: {} faces of {face_count}, {off:e}", fit.model.faces().len()));
                }
            }
            Err(obstacle) => told.push(format!("{seed}: {obstacle:?}")),
        }
    }
    assert!(told.len() <= 6, "{told:#?}");
}

#[test]
fn most_parts_of_a_noisy_crowd_are_exact() {
    const NOISE: f64 = 0.01;
    let mut told = Vec::new();
    for seed in 0..60 {
        let Part { mesh, face_count, volume, area } = machine::any_part(seed).unwrap();
        let rough = machine::roughened(&mesh, NOISE, seed).unwrap();
        match fit(&rough, 1e-3) {
            Ok(fit) => {
                assert_eq!(fit.model.free_edge_count(), 0, "seed {seed}");
                // a face of many nodes moves by less than one of them
                let moved = NOISE * mean_edge(&rough) * area;
                let off = (fit.model.measure().volume - volume).abs();
                if off > moved || fit.model.faces().len() != face_count {
                    told.push(format!("{seed}: {} faces of {face_count}", fit.model.faces().len()));
                }
            }
            Err(obstacle) => told.push(format!("{seed}: {obstacle:?}")),
        }
    }
    assert!(told.len() <= 9, "{told:#?}");
}

#[test]
fn exact_models_are_written_and_saved_as_they_are() {
    use crate::export::{native, step};
    let Part { mesh, .. } = machine::box_with_hole(1000, 2).unwrap();
    let model = fit(&mesh, 1e-3).unwrap().model;
    let (text, report) = step::to_text(&model, &step::StepOptions::default(), &Watch::default()).unwrap();
    let count = |entity: &str| text.matches(&format!("={entity}(")).count();
    // twelve lines of the block and the seam; two rims
    assert_eq!((count("PLANE"), count("CYLINDRICAL_SURFACE"), count("CIRCLE"), count("LINE")), (6, 1, 2, 13));
    assert_eq!((count("B_SPLINE_CURVE_WITH_KNOTS"), report.edge_count), (0, 15));
    let saved = native::save(&model);
    assert_eq!(native::load_model(&saved).unwrap(), model);
    // a version before arcs does not know it
    assert_eq!(saved[8..12], 2_u32.to_le_bytes());
}

#[test]
fn exact_models_answer_as_their_formulas_do() {
    use crate::control::Pool;
    use crate::model::ModelProjector;
    use crate::query::project::ProjectOptions;
    let Part { mesh, .. } = machine::cylinder(1000, 2).unwrap();
    let model = fit(&mesh, 1e-3).unwrap().model;
    let mut random = crate::samples::Random::new(5);
    let points: Vec<glam::DVec3> = (0..400)
        .map(|_| glam::DVec3::new(random.signed(), random.signed(), random.signed()) * 1.6 + glam::DVec3::Z)
        .collect();
    let projector = ModelProjector::new(&model).unwrap();
    let feet = projector.project(&points, &ProjectOptions::default(), &Pool::new(1)).unwrap();
    for (point, distance) in points.iter().zip(&feet.distances) {
        // radius 1, from 0 to 2 along z
        let out = glam::DVec2::new(point.truncate().length() - 1.0, (point.z - 1.0).abs() - 1.0);
        let exact =
            if out.max_element() < 0.0 { -out.max_element() } else { out.max(glam::DVec2::ZERO).length() };
        assert!((distance - exact).abs() < 1e-12, "{point}: {distance} {exact}");
    }
}

#[test]
fn open_parts_become_shells_with_exact_borders() {
    // without its upper side: a wall, a hole and a lid whose border is lines and a circle
    let Part { mesh, face_count, area, .. } = machine::box_with_hole(2000, 1).unwrap();
    let place = |node: u32| mesh.points()[node as usize];
    let is_kept = |t: &&[u32; 3]| t.iter().any(|&node| place(node).z < 1.0 - 1e-9);
    let kept: Vec<[u32; 3]> = mesh.triangles().iter().filter(is_kept).copied().collect();
    let open = Mesh::new(mesh.points().to_vec(), kept).unwrap();
    let fit = fit(&open, 1e-3).unwrap_or_else(|obstacle| panic!("{obstacle:?}"));
    assert_eq!(fit.model.faces().len(), face_count - 1);
    let measured = fit.model.measure();
    let upper = 6.0 - PI * 0.25;
    assert!((measured.area / (area - upper) - 1.0).abs() < 1e-9, "{} {}", measured.area, area - upper);
    // four lines and a circle
    assert_eq!(measured.free_edge_count, 5);
    assert!(fit.report.volume.is_nan() && fit.report.max_error < 1e-11);
}

#[test]
fn parts_far_from_the_origin_are_what_they_are_there() {
    const FAR: f64 = 1e6;
    for (name, Part { mesh, face_count, volume, area }) in parts() {
        let places = mesh.points().iter().map(|&place| place + DVec3::splat(FAR)).collect();
        let far = Mesh::new(places, mesh.triangles().to_vec()).unwrap();
        let fit = fit(&far, 1e-3).unwrap_or_else(|obstacle| panic!("{name}: {obstacle:?}"));
        assert_eq!(fit.model.faces().len(), face_count, "{name}");
        // places are rounded, and so is each of the vertices of a face
        let moved = 16.0 * f64::EPSILON * FAR * area;
        let off = (fit.report.volume - volume).abs();
        assert!(off <= moved, "{name}: {off:e}, {moved:e}");
        for ((place, &error), &point) in fit.places.iter().zip(&fit.errors).zip(far.points()) {
            let (face, uv) = place.unwrap();
            let distance = fit.model.carrier(face).points(&[uv])[0].distance(point);
            assert!(distance <= error + 8.0 * f64::EPSILON * FAR, "{name}: {distance:e} {error:e}");
        }
    }
}

#[test]
fn a_triangle_between_three_nodes_of_a_rim_is_no_face() {
    // a wall between two rings and disks; at the first node of the upper ring's three it is turned over:
    //   b2---b1---b0        b2---b1---b0
    //     \   |   /    ->     \ ------ /     of which b2 b1 b0 lies in the plane of the disk
    //      \  |  /             \      /
    //         a1                  a1
    const COUNT: u32 = 96;
    let ring = |height: f64| {
        (0..COUNT).map(move |k| {
            let (sin, cos) = (2.0 * PI * f64::from(k) / f64::from(COUNT)).sin_cos();
            DVec3::new(cos, sin, height)
        })
    };
    let points: Vec<DVec3> = ring(0.0).chain(ring(2.0)).chain([DVec3::ZERO, 2.0 * DVec3::Z]).collect();
    let low = |k: u32| k % COUNT;
    let high = |k: u32| COUNT + k % COUNT;
    let mut triangles = vec![[low(0), low(1), high(0)], [low(1), high(2), high(0)]];
    triangles.extend([[high(2), high(1), high(0)], [low(1), low(2), high(2)]]);
    triangles
        .extend((2..COUNT).flat_map(|k| [[low(k), low(k + 1), high(k + 1)], [low(k), high(k + 1), high(k)]]));
    triangles.extend(
        (0..COUNT).flat_map(|k| [[2 * COUNT, low(k + 1), low(k)], [2 * COUNT + 1, high(k), high(k + 1)]]),
    );
    let mesh = Mesh::new(points, triangles).unwrap();
    let fit = fit(&mesh, 1e-3).unwrap_or_else(|obstacle| panic!("{obstacle:?}"));
    assert_eq!(fit.model.faces().len(), 3);
}

#[test]
fn corners_of_a_border_are_no_circle() {
    let frame = crate::model::Frame::new(DVec3::ZERO, DVec3::Z, DVec3::X).unwrap();
    let plane = Carrier::Plane(crate::model::Plane(frame));
    let arc = |count: u32, turn: f64| -> Vec<DVec3> {
        let angle = |k: u32| turn * f64::from(k) / f64::from(count - 1);
        (0..count).map(|k| DVec3::new(angle(k).cos(), angle(k).sin(), 0.0)).collect()
    };
    // two sides of a hexagon, and a third of a circle in chords of six degrees
    assert!(rim::rim(&plane, &arc(3, 2.0 * PI / 3.0), 1e-9).is_none());
    let round = rim::rim(&plane, &arc(21, 2.0 * PI / 3.0), 1e-9);
    assert!(matches!(round, Some(Carrier::Cylinder(_))), "{round:?}");
}
