use super::super::{Plane, Symmetry};
use super::*;
use crate::failure::{Classify, ErrorKind};
use crate::fit::pht::{self, PhtOptions};
use crate::fit::tensor::{self, TensorOptions};
use crate::samples::grid;
use crate::surface::tensor::Axis;
use glam::DVec2;
use glam::{DQuat, DVec3};

/// A saddle that is even in x, over triangles that are not; `lean` makes it lopsided.
fn saddle(lean: f64) -> Mesh {
    let (uv, triangles) = grid([31, 24], 0.3, 9, |_| true);
    let point = |uv: &DVec2| {
        let (x, y) = (2.0 * uv.x - 1.0, 1.3 * uv.y);
        DVec3::new(x, y, 0.3 * (2.5 * x).cos() * (1.0 + 0.5 * y) - 0.2 * y * y + lean * x)
    };
    Mesh::new(uv.iter().map(point).collect(), triangles).unwrap()
}

fn demands(symmetry: Symmetry) -> Demands<'static> {
    Demands { symmetry, ..Demands::default() }
}

fn tolerance(value: f64) -> Tolerance {
    Tolerance { value, scale: ToleranceScale::Relative }
}

const MIDDLE: Plane = Plane { point: DVec3::ZERO, normal: DVec3::X };

/// Rows of value and derivatives at places and at their images.
fn rows_at_images(surface: &dyn Surface) -> [Vec<f64>; 2] {
    let places: Vec<DVec2> = (0..400)
        .map(|k| DVec2::new(-0.975 + 0.05 * f64::from(k % 20), 0.025 + 0.05 * f64::from(k / 20)))
        .collect();
    let images: Vec<DVec2> = places.iter().map(|uv| DVec2::new(-uv.x, uv.y)).collect();
    [places, images].map(|uv| {
        let mut rows = vec![0.0; 9 * uv.len()];
        surface.eval_rows(&uv, 1, &mut rows);
        rows
    })
}

#[test]
fn a_tensor_surface_is_its_own_image_to_the_bit() {
    let mesh = saddle(0.0);
    let options = TensorOptions {
        tolerance: tolerance(2e-3),
        demands: demands(Symmetry::About(MIDDLE)),
        ..TensorOptions::default()
    };
    let fit = tensor::fit_mesh(&mesh, &options, &mut Control::new(1)).unwrap();
    assert!(fit.report.max_error <= fit.report.tolerance, "{:?}", fit.report);
    let (u, row) = (fit.surface.knots(Axis::U), 3 * fit.surface.knots(Axis::V).basis_count());
    let knots: Vec<f64> = u.knots().iter().rev().map(|x| -x).collect();
    assert_eq!(u.knots(), knots);
    let lines: Vec<&[f64]> = fit.surface.control_points().chunks_exact(row).collect();
    for (line, image) in lines.iter().zip(lines.iter().rev()) {
        for (a, b) in line.chunks(3).zip(image.chunks(3)) {
            assert_eq!([a[0], a[1], a[2]], [-b[0], b[1], b[2]]);
        }
    }
    // unknowns of the half: with the cells of the whole there would be nearly twice as many
    let whole = fit.surface.coefficient_count();
    assert!(
        fit.report.coefficient_count as f64 <= 0.75 * whole as f64 && whole == lines.len() * row / 3,
        "{whole}"
    );
    let [own, image] = rows_at_images(&fit.surface);
    for (a, b) in own.chunks(9).zip(image.chunks(9)) {
        // the same control points with the weights in the other order: some roundings of numbers below 10
        let odd = [a[0] + b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3], a[4] + b[4], a[5] + b[5]];
        assert!(odd.iter().all(|x| x.abs() <= 1e-13), "{odd:?}");
    }
    assert_eq!((fit.report.mirror, fit.parameters.len()), (Some(MIDDLE), mesh.points().len()));
    assert!(fit.report.mirror_distance <= fit.report.tolerance && fit.report.mirror_distance > 0.0);
    assert!(fit.errors.iter().all(|&error| error <= fit.report.tolerance));
    // second derivatives are continuous across the plane
    let mut rows = vec![0.0; 36];
    for (side, rows) in [-1e-9, 1e-9].into_iter().zip(rows.chunks_mut(18)) {
        fit.surface.eval_rows(&[DVec2::new(side, 0.4)], 2, rows);
    }
    let (before, after) = rows.split_at(18);
    for (a, b) in before.iter().zip(after) {
        // third derivatives of size 100 over 2e-9
        assert!((a - b).abs() <= 1e-6, "{before:?} {after:?}");
    }
}

#[test]
fn a_pht_spline_is_its_own_image_to_the_bit() {
    let mesh = saddle(0.0);
    let options = PhtOptions {
        tolerance: tolerance(2e-3),
        demands: demands(Symmetry::About(MIDDLE)),
        ..PhtOptions::default()
    };
    let fit = pht::fit_mesh(&mesh, &options, &mut Control::new(1)).unwrap();
    assert!(fit.report.max_error <= fit.report.tolerance, "{:?}", fit.report);
    let jets: std::collections::BTreeMap<_, _> = fit.surface.jets().collect();
    let last = fit.surface.mesh().last_vertex().i;
    for (vertex, jet) in &jets {
        let image = jets[&crate::tmesh::Vertex { i: last - vertex.i, ..*vertex }];
        for k in 0..12 {
            let is_odd = (k % 3 == 0) != ((k / 3) % 2 == 1);
            assert_eq!(jet[k], if is_odd { -image[k] } else { image[k] }, "{vertex:?} {k}");
        }
    }
    assert!(fit.report.coefficient_count as f64 <= 0.75 * fit.surface.coefficient_count() as f64);
    let [own, image] = rows_at_images(&fit.surface);
    for (a, b) in own.chunks(9).zip(image.chunks(9)) {
        let odd = [a[0] + b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3], a[4] + b[4], a[5] + b[5]];
        assert!(odd.iter().all(|x| x.abs() <= 1e-13), "{odd:?}");
    }
}

#[test]
fn the_plane_is_found_wherever_it_is() {
    let turn = DQuat::from_euler(glam::EulerRot::XYZ, 0.4, -1.1, 2.0);
    let shift = DVec3::new(3.0, -7.0, 0.5);
    let mut mesh = saddle(0.0);
    let points = mesh.points().iter().map(|&p| turn * p + shift).collect();
    mesh.set_points(points).unwrap();
    let options = TensorOptions {
        tolerance: tolerance(3e-3),
        demands: demands(Symmetry::Found),
        ..TensorOptions::default()
    };
    let fit = tensor::fit_mesh(&mesh, &options, &mut Control::new(1)).unwrap();
    let found = fit.report.mirror.unwrap();
    let normal = turn * DVec3::X;
    // facets of an uneven mesh leave the plane free by a share of their sagitta
    assert!(found.normal.cross(normal).length() < 3e-3, "{found:?} {normal}");
    assert!((found.point - shift).dot(normal).abs() < 3e-3, "{found:?}");
    assert!(fit.report.max_error <= fit.report.tolerance, "{:?}", fit.report);
    let [own, image] = rows_at_images(&fit.surface);
    for (a, b) in own.chunks(9).zip(image.chunks(9)) {
        let (p, q) = (DVec3::from_slice(a), DVec3::from_slice(b));
        let mirrored = p - 2.0 * (p - found.point).dot(found.normal) * found.normal;
        assert!(mirrored.distance(q) <= 1e-13 * 10.0, "{p} {q}");
    }
}

#[test]
fn what_is_not_symmetric_is_refused_with_its_distance() {
    let refuse = |mesh: &Mesh, symmetry: Symmetry| {
        let options = TensorOptions {
            tolerance: tolerance(1e-3),
            demands: demands(symmetry),
            ..TensorOptions::default()
        };
        let error = tensor::fit_mesh(mesh, &options, &mut Control::new(1)).unwrap_err();
        let other =
            PhtOptions { tolerance: tolerance(1e-3), demands: demands(symmetry), ..PhtOptions::default() };
        assert_eq!(pht::fit_mesh(mesh, &other, &mut Control::new(1)).unwrap_err(), error);
        error
    };
    let lopsided = saddle(0.1);
    let error = refuse(&lopsided, Symmetry::About(MIDDLE));
    let FitError::NotSymmetric { distance, tolerance } = error else { panic!("{error}") };
    // at its ends the saddle is off by 0.2 across a slope of about 45 degrees
    assert!(distance > 0.1 && distance < 0.21 && tolerance < 4e-3, "{error}");
    assert_eq!(error.kind(), ErrorKind::InvalidArgument);
    assert!(error.to_string().contains("not symmetric"), "{error}");
    // beside the mesh: its image is elsewhere
    let beside = Plane { point: DVec3::new(5.0, 0.0, 0.0), normal: DVec3::X };
    assert!(matches!(refuse(&saddle(0.0), Symmetry::About(beside)), FitError::NotSymmetric { .. }));
    let none = Plane { point: DVec3::ZERO, normal: DVec3::ZERO };
    assert_eq!(refuse(&saddle(0.0), Symmetry::About(none)), FitError::NoPlane);
    let ball = crate::samples::ball(300, 1).map(|mesh| refuse(&mesh, Symmetry::Found));
    assert!(matches!(ball, Ok(FitError::NotCutInTwo | FitError::NotSymmetric { .. })), "{ball:?}");
}
