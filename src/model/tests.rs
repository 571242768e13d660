use super::shapes::{
    PIPE_HEIGHT, PIPE_OFF, PIPE_RADIUS, circle, cube, hollow_cube, pipe, rectangle, torus_piece, trimmed,
    wave,
};
use super::*;
use crate::geometry::Axis;
use crate::surface::Surface;
use crate::surface::tensor::TensorSurface;

fn model(surface: &TensorSurface) -> Model {
    of_parts(surface, vec![surface.clone()]).unwrap()
}

fn refusal(surface: &TensorSurface) -> ModelError {
    of_parts(surface, vec![surface.clone()]).unwrap_err()
}

#[test]
fn material_is_on_the_left_of_every_bound() {
    for flip in [false, true] {
        let mut loops = vec![circle([0.3, 0.3], 0.1, 12), rectangle(0.1, 0.9), circle([0.7, 0.7], 0.1, 7)];
        if flip {
            loops.iter_mut().for_each(|polyline| polyline.reverse());
        }
        let model = model(&trimmed(wave(), loops));
        let bounds = model.polylines(FaceId(0));
        let area = |p: &Vec<DVec2>| -> f64 {
            (0..p.len()).map(|k| p[k].perp_dot(p[(k + 1) % p.len()])).sum::<f64>() / 2.0
        };
        assert!((area(&bounds[0]) - 0.64).abs() < 1e-12);
        assert!(bounds[1..].iter().all(|hole| area(hole) < 0.0));
    }
}

#[test]
fn edges_close_and_lie_on_the_surface() {
    let holes = vec![rectangle(0.05, 0.95), circle([0.5, 0.5], 0.3, 300), circle([0.87, 0.87], 0.03, 3)];
    for surface in [trimmed(wave(), holes.clone()), trimmed(torus_piece(), holes)] {
        let model = model(&surface);
        // corners of the rectangle and the triangle; a round hole has two edges
        let face = &model.faces()[0];
        assert_eq!(face.bounds.iter().map(Vec::len).collect::<Vec<_>>(), [4, 2, 3]);
        assert_eq!(model.euler_characteristic(), 2 - 3);
        for coedge in face.bounds.iter().flatten() {
            let edge = model.edge(coedge.edge);
            assert_ne!(edge.vertices[0], edge.vertices[1]);
            let pcurve = coedge.pcurve.as_ref().unwrap();
            let (from, to) = edge.curve.domain();
            let off = |t: f64| {
                let uv = surface.domain().clamp(DVec2::from_slice(&pcurve.eval(t)));
                let on_surface = model.surfaces()[0].points(&[uv])[0];
                on_surface.distance(edge.curve.points(&[t])[0])
            };
            for k in 0..=777 {
                let t = from + (to - from) * f64::from(k) / 777.0;
                assert!(off(t) <= 1e-7 * model.diagonal(), "{:e} at {t}", off(t));
            }
        }
    }
}

#[test]
fn what_is_no_face_is_refused() {
    let trims = |loops| refusal(&trimmed(wave(), loops));
    let eight = [(0.1, 0.1), (0.9, 0.9), (0.9, 0.1), (0.1, 0.9)].map(DVec2::from).to_vec();
    assert!(matches!(trims(vec![eight]), ModelError::Crossing { index: 0, .. }));
    let overlapping = vec![rectangle(0.1, 0.6), rectangle(0.4, 0.9)];
    assert!(matches!(trims(overlapping), ModelError::Crossing { index: 1, .. }));
    let corner_on_a_side = [(0.125, 0.5), (0.25, 0.25), (0.25, 0.75)].map(DVec2::from).to_vec();
    let touching = vec![rectangle(0.125, 0.875), corner_on_a_side];
    assert!(matches!(trims(touching), ModelError::Crossing { .. }));
    let twice = vec![rectangle(0.1, 0.4), rectangle(0.6, 0.9)];
    assert_eq!(trims(twice), ModelError::Pieces { count: 2 });
    let island = vec![rectangle(0.1, 0.9), rectangle(0.2, 0.8), rectangle(0.4, 0.6)];
    assert_eq!(trims(island), ModelError::Pieces { count: 2 });
    let point = vec![rectangle(0.1, 0.9), vec![DVec2::splat(0.5); 3]];
    assert_eq!(trims(point), ModelError::Empty { index: 1 });

    let line = KnotVector::clamped(&[0.0, 1.0], 1).unwrap();
    let surface = |dim, scale| {
        let points = (0..4 * dim).map(|k| scale * ((k * k) % 7) as f64).collect();
        TensorSurface::new(dim, line.clone(), line.clone(), points, None).unwrap()
    };
    assert_eq!(refusal(&surface(2, 1.0)), ModelError::Dimension { dim: 2 });
    assert!(matches!(refusal(&surface(3, 0.0)), ModelError::Size { .. }));
    assert!(matches!(refusal(&surface(3, 4e307)), ModelError::Size { .. }));
    let torn = KnotVector::new(vec![0., 0., 0.5, 0.5, 1., 1.], 1).unwrap();
    let points = (0..24).map(f64::from).collect();
    let torn = TensorSurface::new(3, torn, line.clone(), points, None).unwrap();
    assert_eq!(refusal(&torn), ModelError::Torn { axis: Axis::U, index: 2, degree: 1 });
}

#[test]
fn a_cube_is_a_solid_of_shared_edges() {
    for is_flat in [false, true] {
        let model = cube(is_flat).finish().unwrap();
        let counts =
            [model.vertices().len(), model.edges().len(), model.faces().len(), model.free_edge_count()];
        assert_eq!(counts, [8, 12, 6, 0]);
        assert_eq!(model.euler_characteristic(), 2);
        assert!((model.diagonal() - 3f64.sqrt()).abs() < 1e-15);
        assert_eq!(model.curve_deviation(), 0.0);
    }
}

#[test]
fn parts_that_do_not_fit_are_refused() {
    let change = |change: fn(&mut Builder)| {
        let mut builder = cube(false);
        change(&mut builder);
        builder.finish().unwrap_err()
    };
    assert_eq!(change(|parts| parts.vertices[3].x = f64::NAN), ModelError::NotFinite { vertex: 3 });
    assert_eq!(change(|parts| parts.faces.clear()), ModelError::NoFaces);
    assert_eq!(change(|parts| parts.faces[2].bounds.clear()), ModelError::EmptyLoop { face: 2 });
    assert_eq!(
        change(|parts| parts.faces[1].bounds[0].swap(0, 1)),
        ModelError::OpenLoop { face: 1, bound: 0, place: 0 }
    );
    assert_eq!(
        change(|parts| parts.faces[4].surface = SurfaceId(6)),
        ModelError::NoSuch { part: "face", index: 4 }
    );
    assert_eq!(
        change(|parts| parts.edges[5].vertices[1] = VertexId(8)),
        ModelError::NoSuch { part: "edge", index: 5 }
    );
    assert_eq!(
        change(|parts| parts.shells[0].role = Role::VoidIn(ShellId(0))),
        ModelError::NoSuch { part: "shell", index: 0 }
    );
    assert!(matches!(
        change(|parts| parts.faces[0].bounds[0][0].pcurve = None),
        ModelError::NoPcurve { face: 0, .. }
    ));
    assert!(matches!(
        change(|parts| {
            parts.shells[0].faces.pop();
        }),
        ModelError::Shells { face: 5 }
    ));
    assert!(matches!(change(|parts| parts.shells[0].faces.push(FaceId(1))), ModelError::Shells { face: 1 }));
    let open = change(|parts| {
        parts.faces.pop();
        parts.shells[0].faces.pop();
    });
    assert!(matches!(open, ModelError::FreeEdge { shell: 0, .. }), "{open}");
    let turned = change(|parts| {
        let bound = &mut parts.faces[0].bounds[0];
        bound.reverse();
        bound.iter_mut().for_each(|coedge| coedge.is_forward ^= true);
    });
    assert!(matches!(turned, ModelError::SharedTwice { .. }), "{turned}");
}

#[test]
fn area_and_volume_are_integrals() {
    // a cube with a void, by both kinds of faces
    for is_flat in [false, true] {
        let model = hollow_cube(is_flat);
        let measure = model.measure();
        assert!((measure.area - 7.5).abs() < 1e-14, "{measure:?}");
        assert!((measure.volume - 0.875).abs() < 1e-14, "{measure:?}");
        assert_eq!((measure.max_gap, measure.free_edge_count), (0.0, 0));
        assert!((measure.max_normal_jump - std::f64::consts::FRAC_PI_2).abs() < 1e-14, "{measure:?}");
        assert_eq!((measure.min, measure.max), (DVec3::ZERO, DVec3::ONE));
        assert_eq!(model.euler_characteristic(), 4);
    }
    // a quarter of a tube by a quarter of a ring
    let whole = model(&torus_piece()).measure();
    let exact = 0.5 * std::f64::consts::PI * (0.5 * std::f64::consts::PI * 3.0 + 1.0);
    assert!((whole.area - exact).abs() < 1e-6 * exact, "{whole:?} {exact}");
    assert_eq!((whole.volume, whole.free_edge_count), (0.0, 4));
}

#[test]
fn loops_across_knot_lines_enclose_what_they_do_in_the_plane() {
    // a plane with inner knots: areas are those of the polygons, whatever lines they cross
    let flat = {
        let wave = wave();
        let points = wave.control_points().chunks_exact(3).flat_map(|p| [p[0], p[1], 0.0]).collect();
        TensorSurface::new(3, wave.knots(Axis::U).clone(), wave.knots(Axis::V).clone(), points, None).unwrap()
    };
    let enclosed = |polyline: &[DVec2]| -> f64 {
        let next = polyline.iter().cycle().skip(1);
        0.5 * polyline.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum::<f64>().abs()
    };
    let slanted = [(0.02, 0.1), (0.98, 0.03), (0.9, 0.97), (0.1, 0.9)].map(DVec2::from).to_vec();
    let holes = [circle([0.5, 0.5], 0.2, 31), circle([0.2, 0.5], 0.03, 5)];
    for outer in [rectangle(0.0, 1.0), rectangle(0.2, 0.6), slanted] {
        for holes in [&holes[..0], &holes[..]] {
            if enclosed(&outer) < 0.2 && !holes.is_empty() {
                continue;
            }
            let loops: Vec<_> = std::iter::once(outer.clone()).chain(holes.iter().cloned()).collect();
            let exact = enclosed(&outer) - holes.iter().map(|hole| enclosed(hole)).sum::<f64>();
            let area = model(&trimmed(flat.clone(), loops)).measure().area;
            assert!((area - exact).abs() < 1e-13, "{area} {exact}");
        }
    }
}

#[test]
fn exact_surfaces_have_exact_integrals() {
    let model = pipe();
    assert_eq!(model.euler_characteristic(), 2);
    let measure = model.measure();
    let disk = std::f64::consts::PI * PIPE_RADIUS * PIPE_RADIUS;
    let area = 2.0 * disk + 2.0 * std::f64::consts::PI * PIPE_RADIUS * PIPE_HEIGHT;
    assert!(model.curve_deviation() < PIPE_OFF, "{}", model.curve_deviation());
    let off = 2.0 * PIPE_OFF / PIPE_RADIUS;
    assert!((measure.area - area).abs() < off * area, "{measure:?} {area}");
    assert!((measure.volume - disk * PIPE_HEIGHT).abs() < off * disk * PIPE_HEIGHT, "{measure:?}");
    assert_eq!((measure.max_normal_jump, measure.sharp_edge_count), (0.0, 32));
    for face in model.face_ids().skip(1) {
        // polygons of 8 sides an arc: their area is 1 - (2 pi / 128)^2 / 6 of the circle's
        let surface = model.face_surface(face).unwrap();
        let of_copy = of_parts(&surface, vec![surface.clone()]).unwrap().measure().area;
        assert!((of_copy / disk - 1.0).abs() < 5e-4, "{of_copy} {disk}");
    }
}

#[test]
fn a_piece_of_a_cylinder_becomes_rational_arcs() {
    let frame = Frame::new(DVec3::new(1.0, -2.0, 0.5), DVec3::new(0.1, 0.7, 0.4), DVec3::X).unwrap();
    let cylinder = Cylinder::new(frame, 1.5).unwrap();
    for angle in [0.3, 1.5, 2.0, 4.0, 6.2] {
        let domain = Domain { min: DVec2::new(-0.4, 1.0), max: DVec2::new(-0.4 + angle, 2.0) };
        let (surface, place) = as_tensor::cylinder_patch(&cylinder, &domain).unwrap();
        for k in 0..=60 {
            let uv = domain.min + DVec2::new(f64::from(k) / 60.0, 0.3) * domain.size();
            let exact = Carrier::from(cylinder).points(&[uv])[0];
            let at = surface.domain().clamp(place(uv));
            let off = Carrier::from(surface.clone()).points(&[at])[0].distance(exact);
            assert!(off < 1e-13, "{off:e} at {uv} of {angle}");
        }
    }
}

#[test]
fn what_runs_along_a_parameter_line_stays_on_it() {
    let mut random = crate::samples::Random::new(3);
    let edge = Curve::new(3, KnotVector::clamped(&[0.0, 1.0], 1).unwrap(), vec![0.0; 6]).unwrap();
    let carrier = Carrier::Spline(wave());
    for _ in 0..200 {
        let (u, from, to) = (random.unit(), random.unit(), random.unit());
        let pcurve = straight(&edge, [DVec2::new(u, from), DVec2::new(u, to)]);
        let parameters: Vec<f64> = (0..=30).map(|k| f64::from(k) / 30.0).collect();
        let places = places(&carrier, &EdgeCurve::Spline(edge.clone()), Some(&pcurve), &parameters);
        assert!(places.iter().all(|at| at.x == u), "{u}");
    }
}
