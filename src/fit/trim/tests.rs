use super::*;
use crate::curve::{EndRule, interpolate};
use crate::failure::{Classify, ErrorKind};
use crate::fit::common::report::ToleranceScale;
use crate::knots::KnotVector;
use crate::query::project::ProjectOptions;
use crate::surface::tensor::TensorSurface;
use glam::DVec3;
use std::f64::consts::{FRAC_1_SQRT_2, PI, TAU};

/// The square (4 u, 4 v, 0) over the unit square.
fn plane() -> TensorSurface {
    let knots = || KnotVector::clamped(&[0.0, 1.0], 1).unwrap();
    let points = vec![0., 0., 0., 0., 4., 0., 4., 0., 0., 4., 4., 0.];
    TensorSurface::new(3, knots(), knots(), points, None).unwrap()
}

/// The whole unit cylinder, 3 high, its seam at y = 0 < x: four quarters along u.
fn cylinder() -> TensorSurface {
    let corners =
        [(1., 0.), (1., 1.), (0., 1.), (-1., 1.), (-1., 0.), (-1., -1.), (0., -1.), (1., -1.), (1., 0.)];
    let points = corners.iter().flat_map(|&(x, y)| [x, y, 0.0, x, y, 3.0]).collect();
    let weights = (0..9).flat_map(|k| [if k % 2 == 0 { 1.0 } else { FRAC_1_SQRT_2 }; 2]).collect();
    let around = [0., 0., 0., 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1., 1., 1.];
    let knots_u = KnotVector::new(around.to_vec(), 2).unwrap();
    let knots_v = KnotVector::clamped(&[0.0, 1.0], 1).unwrap();
    TensorSurface::new(3, knots_u, knots_v, points, Some(weights)).unwrap()
}

/// A closed cubic through points of a curve of period 1.
fn closed(count: usize, place: impl Fn(f64) -> DVec3) -> Curve {
    let u: Vec<f64> = (0..=count).map(|k| k as f64 / count as f64).collect();
    let at = |k: usize| place((k % count) as f64 / count as f64).to_array();
    let points: Vec<f64> = (0..=count).flat_map(at).collect();
    interpolate(3, &u, &points, EndRule::Periodic).unwrap()
}

fn circle(x: f64, y: f64, z: f64, radius: f64) -> Curve {
    closed(32, |t| DVec3::new(x + radius * (TAU * t).cos(), y + radius * (TAU * t).sin(), z))
}

fn line(from: [f64; 3], to: [f64; 3]) -> Curve {
    Curve::new(3, KnotVector::clamped(&[0.0, 1.0], 1).unwrap(), [from, to].concat()).unwrap()
}

fn absolute(value: f64) -> CurveTrimOptions {
    CurveTrimOptions { tolerance: Tolerance { value, scale: ToleranceScale::Absolute }, adds: false }
}

fn trim(
    surface: &dyn Surface,
    loops: &[Vec<&Curve>],
    options: &CurveTrimOptions,
) -> Result<CurveTrims, CurveTrimError> {
    trim_by_curves(surface, &Projector::new(surface).unwrap(), loops, options, &mut Control::new(1))
}

/// Places over a polyline, `steps` a side.
fn over(surface: &dyn Surface, polyline: &[DVec2], steps: usize) -> Vec<DVec3> {
    let next = polyline.iter().cycle().skip(1);
    let side = |(a, b): (&DVec2, &DVec2)| {
        (0..steps).map(|k| a.lerp(*b, k as f64 / steps as f64)).collect::<Vec<_>>()
    };
    let uv: Vec<DVec2> = polyline.iter().zip(next).flat_map(side).collect();
    let mut rows = vec![0.0; 3 * uv.len()];
    surface.eval_rows(&uv, 0, &mut rows);
    rows.chunks_exact(3).map(DVec3::from_slice).collect()
}

/// The largest distance of the surface over a trim to a curve, and of the curve to that.
fn two_sided(surface: &dyn Surface, polyline: &[DVec2], curve: &Curve) -> (f64, f64) {
    let places = over(surface, polyline, 64);
    let flat: Vec<f64> = places.iter().flat_map(|place| place.to_array()).collect();
    let pool = crate::control::Pool::new(1);
    let found = Projector::of_curve(curve).project(&flat, &ProjectOptions::default(), &pool).unwrap();
    let there = found.distances.iter().copied().fold(0.0, f64::max);
    let (from, to) = curve.knots().domain();
    let on_curve =
        (0..1000).map(|k| DVec3::from_slice(&curve.eval(from + (to - from) * f64::from(k) / 1000.0)));
    let pairs = || places.iter().zip(places.iter().cycle().skip(1));
    let to_side = |p: DVec3, a: DVec3, b: DVec3| {
        let share = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
        p.distance(a.lerp(b, share))
    };
    let nearest = |p: DVec3| pairs().map(|(a, b)| to_side(p, *a, *b)).fold(f64::INFINITY, f64::min);
    (there, on_curve.map(nearest).fold(0.0, f64::max))
}

/// A closed curve on the cylinder, away from its seam.
fn ring() -> Curve {
    closed(64, |t| {
        let around = PI + 0.8 * (TAU * t).cos();
        DVec3::new(around.cos(), around.sin(), 1.5 + 0.9 * (TAU * t).sin())
    })
}

#[test]
fn a_trim_keeps_the_tolerance_between_its_vertices_too() {
    let (surface, curve) = (cylinder(), ring());
    let mut counts = Vec::new();
    for tolerance in [1e-2, 1e-4, 1e-6_f64] {
        // the cubic is off the cylinder itself, by 5/384 h^4 times fourth derivatives of about 1500 at h = 1/64
        let tolerance = tolerance.max(5e-6);
        let found = trim(&surface, &[vec![&curve]], &absolute(tolerance)).unwrap();
        let (loops, report) = (found.trims.loops(), found.report);
        assert_eq!((loops.len(), loops[0].len()), (1, report.vertex_count));
        assert!(
            report.max_vertex_distance <= report.tolerance && report.max_distance_between <= report.tolerance
        );
        assert!(report.rms_distance_between <= report.max_distance_between);
        assert_eq!((report.worst_curve, report.unproven_count), (0, 0));
        let (there, back) = two_sided(&surface, &loops[0], &curve);
        // a deviation 4 e s (1 - s) along a line, seen at eighths of it, or at quarters of the piece of curve, is e / 64
        // or e / 16 larger between; the chords of 64 places a side hide 4 e / 64^2 more
        assert!(there <= tolerance * (1.0 + 1.0 / 64.0), "{there:e} of {tolerance:e}");
        assert!(back <= tolerance * (1.0 + 1.0 / 16.0 + 1e-3), "{back:e} of {tolerance:e}");
        counts.push(loops[0].len());
    }
    assert!(counts.windows(2).all(|pair| pair[0] <= pair[1]), "{counts:?}");
}

#[test]
fn vertices_are_as_many_as_the_square_root_of_the_tolerance_asks() {
    let (surface, curve) = (plane(), circle(2.0, 2.0, 0.0, 1.5));
    let count =
        |tolerance| trim(&surface, &[vec![&curve]], &absolute(tolerance)).unwrap().report.vertex_count;
    let (few, many) = (count(1e-5), count(1e-7));
    // halving reaches what is needed within a factor of two, and the curve bends evenly
    assert!((5 * few..=20 * few).contains(&many), "{few} and {many}");
    // a chord of angle a lies r a^2 / 8 inside its arc
    let least = TAU / (8.0 * 1e-7 / 1.5_f64).sqrt();
    assert!(many as f64 >= least && many as f64 <= 2.0 * least + 1.0, "{many}, at least {least}");
}

#[test]
fn a_hole_lies_inside_its_outer_loop() {
    let surface = plane();
    // the frame in three curves, the second from its end to its begin; the hole above the plane
    let frame = [
        Curve::new(
            3,
            KnotVector::clamped(&[0.0, 1.0, 2.0], 1).unwrap(),
            vec![0.5, 0.5, 0.0, 3.5, 0.5, 0.0, 3.5, 3.5, 0.0],
        )
        .unwrap(),
        line([0.5, 3.5, 0.0], [3.5, 3.5, 0.0]),
        line([0.5, 3.5, 0.0], [0.5, 0.5, 0.0]),
    ];
    let height = 4e-3;
    let hole = circle(2.0, 2.0, height, 1.0);
    let loops = [frame.iter().collect(), vec![&hole]];
    let found = trim(&surface, &loops, &absolute(5e-3)).unwrap();
    let [outer, inner] = found.trims.loops() else { panic!("two loops") };
    assert_eq!(outer.len(), 4, "straight lines on a plane need no vertices but their ends: {outer:?}");
    // a place nearer than a share of 1e-12 of the surface's diagonal is as good as the nearest
    let rounding = 1e-12 * 32.0_f64.sqrt();
    for (corner, exact) in outer.iter().zip([(0.5, 0.5), (3.5, 0.5), (3.5, 3.5), (0.5, 3.5)]) {
        assert!((4.0 * *corner).distance(DVec2::from(exact)) <= rounding, "{corner} is not {exact:?}");
    }
    for (x, y, counts) in [(0.4, 2.0, false), (0.7, 2.0, true), (2.0, 2.0, false), (2.0, 3.2, true)] {
        assert_eq!(found.trims.contains(DVec2::new(x, y) / 4.0), counts, "{x}, {y}");
    }
    // the hole's vertices are as far from its curve as that is from the plane
    assert!((found.report.max_vertex_distance - height).abs() <= rounding, "{:?}", found.report);
    assert!(found.report.max_distance_between > height && found.report.max_distance_between <= 5e-3);
    assert_eq!(inner.len(), 96, "three lines a span of a cubic are enough");
    assert_eq!(found.report.worst_curve, 3);

    let mut trimmed = plane();
    trimmed.region_mut().trims = trim(&surface, &loops[..1], &absolute(1e-3)).unwrap().trims;
    let added = trim(&trimmed, &loops[1..], &absolute(5e-3).with_adds(true)).unwrap();
    assert_eq!(added.trims.loops(), found.trims.loops());
    assert_eq!(added.report.worst_curve, 0);
}

#[test]
fn a_loop_may_run_along_a_seam() {
    // the border of the cylinder: its seam is passed up and down
    let surface = cylinder();
    let ends = |z| closed(64, move |t| DVec3::new((TAU * t).cos(), (TAU * t).sin(), z));
    let (bottom, top, seam) = (ends(0.0), ends(3.0), line([1.0, 0.0, 0.0], [1.0, 0.0, 3.0]));
    let top_back = {
        let (from, to) = top.knots().domain();
        let knots = top.knots().knots().iter().rev().map(|t| from + to - t).collect();
        let points = top.control_points().chunks(3).rev().flatten().copied().collect();
        Curve::new(3, KnotVector::new(knots, 3).unwrap(), points).unwrap()
    };
    let found = trim(&surface, &[vec![&bottom, &seam, &top_back, &seam]], &absolute(1e-4)).unwrap();
    let trims = found.trims;
    // all but the tolerance along the border counts
    for (u, v) in [(0.01, 0.01), (0.99, 0.99), (0.5, 0.5), (0.01, 0.99), (0.99, 0.01)] {
        assert!(trims.contains(DVec2::new(u, v)), "{u}, {v}");
    }
    assert!(trims.loops()[0].iter().all(|uv| uv.x.min(1.0 - uv.x).min(uv.y).min(1.0 - uv.y) < 1e-4));
    // once round is no loop in the parameter plane
    let error = trim(&surface, &[vec![&bottom]], &absolute(1e-4)).unwrap_err();
    assert!(matches!(error, CurveTrimError::Unreached { curve: 0, .. }), "{error}");
    assert_eq!(error.kind(), ErrorKind::Topology);
}

#[test]
fn refusals_name_the_curve_and_the_number() {
    let surface = plane();
    let refuse = |loops: &[Vec<&Curve>]| trim(&surface, loops, &absolute(1e-2)).unwrap_err();
    let (one, other) = (circle(1.5, 2.0, 0.0, 1.0), circle(2.5, 2.0, 0.0, 1.0));
    assert_eq!(refuse(&[]), CurveTrimError::NoLoops);
    assert_eq!(refuse(&[vec![&one], vec![]]), CurveTrimError::NoCurves { index: 1 });
    let flat = Curve::new(2, KnotVector::clamped(&[0.0, 1.0], 1).unwrap(), vec![0.0; 4]).unwrap();
    assert_eq!(refuse(&[vec![&one], vec![&flat]]), CurveTrimError::CurveDimension { curve: 1, dim: 2 });

    let sides = [
        line([1., 1., 0.], [3., 1., 0.]),
        line([3., 1., 0.], [2., 3., 0.]),
        line([2., 3., 0.], [1., 1.25, 0.]),
    ];
    let error = refuse(&[vec![&one], sides.iter().collect()]);
    assert_eq!(error, CurveTrimError::Open { curve: 3, next: 1, gap: 0.25, tolerance: 1e-2 });
    assert_eq!((error.kind(), error.index()), (ErrorKind::InvalidArgument, Some(3)));
    assert!(matches!(refuse(&[vec![&sides[0]]]), CurveTrimError::Open { curve: 0, next: 0, gap: 2.0, .. }));
    // a gap within the tolerance is closed
    let near = [&sides[0], &sides[1], &line([2., 3., 0.], [1., 1.008, 0.])];
    let found = trim(&surface, &[near.to_vec()], &absolute(1e-2)).unwrap();
    assert!((found.report.max_vertex_distance - 4e-3).abs() <= 1e-12, "{:?}", found.report);

    let error = refuse(&[vec![&circle(2.0, 2.0, 0.3, 1.0)]]);
    let CurveTrimError::TooFar { curve: 0, distance, tolerance: 1e-2, .. } = error else { panic!("{error}") };
    assert!((distance - 0.3).abs() <= 1e-12, "{distance}");
    // beside the surface, it is the farthest place that is named
    let error = refuse(&[vec![&circle(3.5, 2.0, 0.0, 1.0)]]);
    let CurveTrimError::TooFar { distance, parameter, .. } = error else { panic!("{error}") };
    assert!(
        (distance - 0.5).abs() <= 1e-12 && parameter.min(1.0 - parameter) < 1e-2,
        "{distance} at {parameter}"
    );

    let error = refuse(&[vec![&one], vec![&other]]);
    let CurveTrimError::Crossing { first: 0, second: 1, u, v } = error else { panic!("{error}") };
    // the circles meet at x = 2, y = 2 +- sqrt(3) / 2; sides are shorter than sqrt(8 * 1e-2)
    let meeting = DVec2::new(2.0, 2.0 + (3.0_f64.sqrt() / 2.0).copysign(4.0 * v - 2.0));
    assert!((4.0 * DVec2::new(u, v)).distance(meeting) < 0.3, "{u}, {v}");
    assert_eq!(refuse(&[vec![&one], vec![&other]]).kind(), ErrorKind::Topology);
    let eight = closed(64, |t| DVec3::new(2.0 + (TAU * t).sin(), 2.0 + (2.0 * TAU * t).sin(), 0.0));
    assert!(matches!(refuse(&[vec![&eight]]), CurveTrimError::Crossing { first: 0, second: 0, .. }));

    let mut trimmed = plane();
    trimmed.region_mut().trims = trim(&surface, &[vec![&one]], &absolute(1e-2)).unwrap().trims;
    let error = trim(&trimmed, &[vec![&other]], &absolute(1e-2).with_adds(true)).unwrap_err();
    assert!(matches!(error, CurveTrimError::Crossing { first: 0, second: 1, .. }), "{error}");

    assert_eq!(refuse(&[vec![&one], vec![&sides[0], &sides[0]]]), CurveTrimError::Thin { index: 1 });
    for value in [0.0, -1.0, f64::NAN] {
        let error = trim(&surface, &[vec![&one]], &absolute(value)).unwrap_err();
        assert!(matches!(error, CurveTrimError::Fit(_)), "{error}");
    }
}

#[test]
fn the_bits_do_not_depend_on_the_threads_and_a_listener_can_cancel() {
    let (surface, curve) = (cylinder(), ring());
    let projector = Projector::new(&surface).unwrap();
    let on = |threads| {
        let mut control = Control::new(threads);
        trim_by_curves(&surface, &projector, &[vec![&curve]], &absolute(1e-5), &mut control).unwrap().trims
    };
    assert_eq!(on(1), on(3));
    let mut stop = |_: f64, _: f64| ControlFlow::Break(());
    let mut control = Control::new(1).with_progress(&mut stop);
    let error =
        trim_by_curves(&surface, &projector, &[vec![&curve]], &absolute(1e-5), &mut control).unwrap_err();
    assert!(matches!(error, CurveTrimError::Cancelled(_)), "{error}");
}
