use super::*;
use crate::failure::Classify;
use crate::samples::{self, Random};
use std::ops::ControlFlow;

fn map(mesh: &Mesh) -> SphereMap {
    map_to_sphere(mesh, &SphereOptions::default(), &mut Control::new(2)).unwrap()
}

/// What holds of every map.
#[track_caller]
fn assert_sound(mesh: &Mesh, map: &SphereMap) {
    assert_eq!(map.report.folded_triangles, 0);
    // one rounded division
    assert!(map.points.iter().all(|point| (point.length() - 1.0).abs() <= 4.0 * f64::EPSILON));
    // positive triangles that cover the sphere once
    let covered: f64 =
        mesh.triangles().iter().map(|t| solid_angle(t.map(|node| map.points[node as usize]))).sum();
    assert!((covered / (4.0 * PI) - 1.0).abs() <= 1e-9, "covered {} times", covered / (4.0 * PI));
}

#[test]
fn a_ball_is_mapped_almost_isometrically() {
    let mesh = samples::ball(2000, 1).unwrap();
    let map = map(&mesh);
    assert_sound(&mesh, &map);
    // the nodes lie on a sphere, so its own places are a map; what exceeds 4 is the sagitta of the triangles
    let own: Vec<DVec3> = mesh.points().iter().map(|point| point.normalize()).collect();
    let best = measure(&mesh, &own).energy;
    let excess = map.report.energy - 4.0;
    assert!(
        excess > 0.0 && excess <= 1.1 * (best - 4.0),
        "{excess} against {} of the sphere itself",
        best - 4.0
    );
    assert!(map.report.low_area_ratio > 0.9 && map.report.high_area_ratio < 1.1, "{:?}", map.report);
}

#[test]
fn stretched_and_ragged_shapes_never_fold() {
    let scaled = |scale: DVec3, seed: u64| {
        let ball = samples::ball(1500, seed).unwrap();
        Mesh::new(ball.points().iter().map(|p| *p * scale).collect(), ball.triangles().to_vec()).unwrap()
    };
    for (mesh, most) in [
        (scaled(DVec3::new(8.0, 1.0, 1.0), 1), 40.0),
        (scaled(DVec3::new(1.0, 1.0, 0.02), 2), 40.0),
        (scaled(DVec3::new(50.0, 1.0, 1.0), 3), 4000.0),
        (samples::starfish(3000, 4).unwrap(), 60.0),
    ] {
        let map = map(&mesh);
        assert_sound(&mesh, &map);
        assert!(map.report.energy < most, "energy {}", map.report.energy);
    }
    // radial noise of 30 % turns triangles over in space, but not on the sphere
    let ball = samples::ball(3000, 5).unwrap();
    let mut random = Random::new(5);
    let points = ball.points().iter().map(|p| *p * (1.0 + 0.3 * random.signed())).collect();
    let mesh = Mesh::new(points, ball.triangles().to_vec()).unwrap();
    assert_sound(&mesh, &map(&mesh));
}

#[test]
fn the_smallest_spheres_have_maps() {
    let tetrahedron = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    let mesh = Mesh::new(tetrahedron, vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]).unwrap();
    assert_sound(&mesh, &map(&mesh));
    // a double cone: its two tips have as many edges as there are nodes between them
    let n = 200;
    let mut points: Vec<DVec3> = (0..n)
        .map(|k| {
            let angle = 2.0 * PI * f64::from(k) / f64::from(n);
            DVec3::new(angle.cos(), angle.sin(), 0.0)
        })
        .collect();
    points.extend([DVec3::Z, -DVec3::Z]);
    let next = |k: i32| (k + 1) % n;
    let rim = (0..n).flat_map(|k| [[k, next(k), n], [next(k), k, n + 1]]);
    let mesh = Mesh::new(points, rim.map(|t| t.map(|k| k as u32)).collect()).unwrap();
    assert_sound(&mesh, &map(&mesh));
}

#[test]
fn nodes_without_triangles_stay_out() {
    let ball = samples::ball(200, 6).unwrap();
    let mut points = ball.points().to_vec();
    points.insert(0, DVec3::ONE);
    let triangles = ball.triangles().iter().map(|t| t.map(|node| node + 1)).collect();
    let padded = map(&Mesh::new(points, triangles).unwrap());
    assert_eq!(padded.points[0], DVec3::ZERO);
    assert_eq!(padded.points[1..], map(&ball).points);
}

#[test]
fn the_bits_do_not_depend_on_the_threads() {
    let mesh = samples::starfish(6000, 7).unwrap();
    let [one, three] = [1, 3].map(|threads| {
        map_to_sphere(&mesh, &SphereOptions::default(), &mut Control::new(threads)).unwrap().points
    });
    assert_eq!(one, three);
}

#[test]
fn refusals_name_the_offender() {
    let refuse =
        |mesh: &Mesh| map_to_sphere(mesh, &SphereOptions::default(), &mut Control::new(1)).unwrap_err();
    let open = samples::planar(1).unwrap();
    assert!(matches!(refuse(&open), SphereError::Open { loops: 3, .. }));
    let torus = refuse(&samples::handles(1, 800, 1).unwrap());
    assert_eq!(torus, SphereError::Genus { genus: 1 });
    assert_eq!((torus.kind(), torus.index()), (crate::failure::ErrorKind::Topology, None));
    let ball = samples::ball(100, 1).unwrap();
    let count = ball.points().len() as u32;
    let points = ball.points().iter().chain(ball.points()).copied().collect();
    let shifted = ball.triangles().iter().map(|t| t.map(|node| node + count));
    let two = Mesh::new(points, ball.triangles().iter().copied().chain(shifted).collect()).unwrap();
    assert_eq!(refuse(&two), SphereError::Components { count: 2 });
    let flat = Mesh::new(vec![DVec3::ZERO; 4], vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]).unwrap();
    assert_eq!(refuse(&flat), SphereError::ZeroArea { count: 4 });
}

#[test]
fn progress_never_falls_and_a_listener_cancels() {
    let mesh = samples::ball(3000, 8).unwrap();
    let mut last = 0.0;
    let mut listen = |fraction: f64, _: f64| {
        assert!(fraction >= last && fraction <= 1.0, "{fraction} after {last}");
        last = fraction;
        ControlFlow::Continue(())
    };
    let mut control = Control::new(1).with_progress(&mut listen);
    map_to_sphere(&mesh, &SphereOptions::default(), &mut control).unwrap();
    assert_eq!(last, 1.0);
    for stop_at in [0.1, 0.5, 0.9] {
        let mut stop = |fraction: f64, _: f64| match fraction >= stop_at {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        };
        let mut control = Control::new(1).with_progress(&mut stop);
        let error = map_to_sphere(&mesh, &SphereOptions::default(), &mut control).unwrap_err();
        assert_eq!(error, SphereError::Cancelled(crate::control::Cancelled));
    }
}
