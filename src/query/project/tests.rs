use super::*;
use crate::knots::KnotVector;
use crate::samples::Random;
use crate::surface::Trims;
use crate::surface::tensor::TensorSurface;

fn knots(degree: usize) -> KnotVector {
    KnotVector::clamped(&[0.0, 1.0], degree).unwrap()
}

/// The square `(2 u, v, 0)` over the unit square.
fn plane() -> TensorSurface {
    let points = vec![0., 0., 0., 0., 1., 0., 2., 0., 0., 2., 1., 0.];
    TensorSurface::new(3, knots(1), knots(1), points, None).unwrap()
}

/// A circle arc of a right angle: points and weights.
const ARC: [([f64; 2], f64); 3] =
    [([1.0, 0.0], 1.0), ([1.0, 1.0], std::f64::consts::FRAC_1_SQRT_2), ([0.0, 1.0], 1.0)];

/// A quarter of the unit cylinder, 3 high.
fn cylinder() -> TensorSurface {
    let points = ARC.iter().flat_map(|([x, y], _)| [*x, *y, 0.0, *x, *y, 3.0]).collect();
    let weights = ARC.iter().flat_map(|(_, w)| [*w; 2]).collect();
    TensorSurface::new(3, knots(2), knots(1), points, Some(weights)).unwrap()
}

/// An eighth of the unit sphere: its pole is a whole side.
fn sphere() -> TensorSurface {
    let (mut points, mut weights) = (Vec::new(), Vec::new());
    for ([x, y], w) in ARC {
        for ([radius, z], v) in ARC {
            points.extend([radius * x, radius * y, z]);
            weights.push(w * v);
        }
    }
    TensorSurface::new(3, knots(2), knots(2), points, Some(weights)).unwrap()
}

fn project(surface: &dyn Surface, points: &[f64], options: &ProjectOptions) -> (Vec<DVec2>, Vec<f64>) {
    let projector = Projector::new(surface).unwrap();
    let projection = projector.project(points, options, &Pool::new(1)).unwrap();
    assert_eq!(projection.unproven(), 0);
    (projection.uv, projection.distances)
}

/// Points around a surface of size one, some on planes of symmetry.
fn points(count: usize) -> Vec<[f64; 3]> {
    let mut random = Random::new(5);
    (0..count)
        .map(|k| {
            let mut point = [0; 3].map(|_| 4.0 * random.signed());
            point[k % 3] *= f64::from(u8::from(k % 4 > 0));
            point
        })
        .collect()
}

/// Compares with a closed form; the surfaces have a size of at most 4, their points one of at most 8.
fn check_closed_form(surface: &dyn Surface, exact: impl Fn([f64; 3]) -> f64) {
    let points = points(500);
    let (uv, distances) = project(surface, &points.concat(), &ProjectOptions::default());
    for (k, point) in points.iter().enumerate() {
        // the tolerance of a search, and roundoff of some thirty operations
        let tol = 4.0 * DISTANCE_TOLERANCE + 32.0 * f64::EPSILON * 8.0;
        assert!((distances[k] - exact(*point)).abs() <= tol, "{point:?} {} {}", uv[k], distances[k]);
    }
}

fn norm(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

#[test]
fn distances_to_a_plane_are_exact() {
    check_closed_form(&plane(), |[x, y, z]| norm(&[x - x.clamp(0.0, 2.0), y - y.clamp(0.0, 1.0), z]));
}

#[test]
fn distances_to_a_cylinder_are_exact() {
    check_closed_form(&cylinder(), |[x, y, z]| {
        let above = z - z.clamp(0.0, 3.0);
        let radial = if x >= 0.0 && y >= 0.0 {
            norm(&[x, y]) - 1.0
        } else {
            norm(&[x - 1.0, y]).min(norm(&[x, y - 1.0]))
        };
        norm(&[radial, above])
    });
}

#[test]
fn distances_to_a_sphere_with_a_pole_are_exact() {
    let arc = |x: f64, y: f64| -> f64 {
        if x >= 0.0 && y >= 0.0 { norm(&[x, y]) - 1.0 } else { norm(&[x - 1.0, y]).min(norm(&[x, y - 1.0])) }
    };
    check_closed_form(&sphere(), |[x, y, z]| {
        if x >= 0.0 && y >= 0.0 && z >= 0.0 {
            return (norm(&[x, y, z]) - 1.0).abs();
        }
        norm(&[arc(x, y), z]).min(norm(&[arc(y, z), x])).min(norm(&[arc(z, x), y]))
    });
}

#[test]
fn a_centre_is_as_far_as_all_points() {
    let (_, distances) = project(&sphere(), &[0.0, 0.0, 0.0, 1e-9, -1e-7, 1e-8], &ProjectOptions::default());
    assert!((distances[0] - 1.0).abs() <= 1e-12, "{distances:?}");
    // nearest is the corner (0, 1, 0) or the side beside it, farthest from which is the centre's move
    assert!((distances[1] - (1.0 - 1.1e-8)).abs() <= 1e-7, "{distances:?}");
}

#[test]
fn results_do_not_depend_on_threads_order_or_guesses() {
    let surface = sphere();
    let rows: Vec<[f64; 3]> = points(2000);
    let (uv, distances) = project(&surface, &rows.concat(), &ProjectOptions::default());
    let reversed: Vec<[f64; 3]> = rows.iter().rev().copied().collect();
    let projector = Projector::new(&surface).unwrap();
    let options = ProjectOptions::default();
    let mut again = projector.project(&reversed.concat(), &options, &Pool::new(3)).unwrap();
    again.uv.reverse();
    again.distances.reverse();
    assert_eq!((&uv, &distances), (&again.uv, &again.distances));
    let mut random = Random::new(2);
    let guesses: Vec<DVec2> = (0..2000).map(|_| 2.0 * DVec2::new(random.signed(), random.signed())).collect();
    let options = ProjectOptions { guesses: Some(&guesses), ..options };
    let guessed = projector.project(&rows.concat(), &options, &Pool::new(2)).unwrap();
    for (a, b) in distances.iter().zip(&guessed.distances) {
        assert!((a - b).abs() <= 4.0 * DISTANCE_TOLERANCE, "{a} {b}");
    }
}

#[test]
fn points_beyond_the_largest_distance_get_nan() {
    let rows = [0.5, 0.5, 0.5, 0.5, 0.5, 0.5000001, 0.5, 0.5, -0.4, 9.0, 0.0, 0.0];
    let options = ProjectOptions { max_distance: 0.5, ..ProjectOptions::default() };
    let projector = Projector::new(&plane()).unwrap();
    let projection = projector.project(&rows, &options, &Pool::new(1)).unwrap();
    assert_eq!((projection.missed(), projection.unproven()), (2, 0));
    let Projection { uv, distances, .. } = projection;
    assert_eq!(distances[0], 0.5);
    assert!((distances[2] - 0.4).abs() <= 4.0 * f64::EPSILON && uv[2] == DVec2::new(0.25, 0.5));
    assert!(distances[1].is_nan() && distances[3].is_nan() && uv[1].is_nan() && uv[3].is_nan());
}

#[test]
fn trims_hold_the_answer_back() {
    let mut surface = plane();
    // in space: the square from (0.4, 0.2) to (1.6, 0.8) with a hole from (0.8, 0.4) to (1.2, 0.6)
    let frame = |a: f64, b: f64| [(a, a), (b, a), (b, b), (a, b)].map(|(u, v)| DVec2::new(u, v)).to_vec();
    surface.region_mut().trims =
        Trims::new(vec![frame(0.2, 0.8), frame(0.4, 0.6)], &surface.domain()).unwrap();
    let exact = |[x, y, z]: [f64; 3]| {
        let outer: [f64; 2] = [x - x.clamp(0.4, 1.6), y - y.clamp(0.2, 0.8)];
        let depth = (x - 0.8).min(1.2 - x).min(y - 0.4).min(0.6 - y).max(0.0);
        norm(&[outer[0], outer[1], depth, z])
    };
    let mut all = points(300);
    let mut random = Random::new(8);
    all.extend((0..300).map(|_| [2.0 * random.unit(), random.unit(), 0.1 * random.signed()]));
    let (uv, distances) = project(&surface, &all.concat(), &ProjectOptions::default());
    let whole = ProjectOptions { keep_trims: false, ..ProjectOptions::default() };
    let (_, free) = project(&surface, &all.concat(), &whole);
    for (k, point) in all.iter().enumerate() {
        let tol = 4.0 * 3.0 * DISTANCE_TOLERANCE;
        assert!((distances[k] - exact(*point)).abs() <= tol, "{point:?}: {} at {}", distances[k], uv[k]);
        assert!(free[k] <= distances[k]);
    }
}

#[test]
fn fields_of_any_dimension_have_nearest_values() {
    // f = u + v over the unit square: nearest to 0.7 is any place with u + v = 0.7
    let line = TensorSurface::new(1, knots(1), knots(1), vec![0., 1., 1., 2.], None).unwrap();
    let (uv, distances) = project(&line, &[0.7, 3.0, -1.0], &ProjectOptions::default());
    assert!((uv[0].x + uv[0].y - 0.7).abs() <= 1e-11 && distances[0] <= 1e-11);
    assert_eq!((distances[1], uv[1]), (1.0, DVec2::ONE));
    assert_eq!((distances[2], uv[2]), (1.0, DVec2::ZERO));
    // in five dimensions: (u, v, u v, 0, 1)
    let rows = [(0., 0.), (0., 1.), (1., 0.), (1., 1.)].map(|(u, v)| [u, v, u * v, 0.0, 1.0]).concat();
    let saddle = TensorSurface::new(5, knots(1), knots(1), rows, None).unwrap();
    let (uv, distances) = project(&saddle, &[0.5, 0.5, 0.25, 3.0, 5.0], &ProjectOptions::default());
    assert!((distances[0] - 5.0).abs() <= 16.0 * f64::EPSILON * 5.0, "{uv:?} {distances:?}");
}

#[test]
fn refusals_name_the_point() {
    let projector = Projector::new(&plane()).unwrap();
    let refuse =
        |rows: &[f64], options: &ProjectOptions| projector.project(rows, options, &Pool::new(1)).unwrap_err();
    let (options, good) = (ProjectOptions::default(), [0.0; 6]);
    let bad = [0., 0., 0., 0., f64::NAN, 0.];
    assert_eq!(refuse(&bad, &options), ProjectError::NotFinite { index: 1 });
    let guesses = [DVec2::ZERO, DVec2::NAN];
    let guessed = ProjectOptions { guesses: Some(&guesses), ..options };
    assert_eq!(refuse(&good, &guessed), ProjectError::GuessNotFinite { index: 1 });
    let negative = ProjectOptions { max_distance: -1.0, ..options };
    assert_eq!(refuse(&good, &negative), ProjectError::MaxDistance { value: -1.0 });
    let guessed = ProjectOptions { guesses: Some(&[DVec2::ZERO; 2]), ..options };
    let counts = ProjectError::Count { what: "the first guesses", count: 2, expected: 3 };
    assert_eq!(refuse(&[0.0; 9], &guessed), counts);
}

#[test]
fn the_nearest_place_of_a_curve_is_no_farther_than_any_other() {
    let knots = KnotVector::clamped(&[0.0, 0.3, 1.0, 1.2, 2.0], 3).unwrap();
    for dim in [1, 2, 3] {
        let mut random = Random::new(dim as u64);
        let points = (0..dim * knots.basis_count()).map(|_| random.signed()).collect();
        let curve = Curve::new(dim, knots.clone(), points).unwrap();
        let places: Vec<f64> = (0..=20_000).map(|k| f64::from(k) * 1e-4).collect();
        let mut rows = vec![0.0; dim * places.len()];
        curve.eval_rows(&places, 0, &mut rows);
        let queries: Vec<f64> = (0..dim * 200).map(|_| 2.0 * random.signed()).collect();
        let projector = Projector::of_curve(&curve);
        let Projection { uv, distances, .. } =
            projector.project(&queries, &ProjectOptions::default(), &Pool::new(1)).unwrap();
        for ((query, uv), distance) in queries.chunks(dim).zip(&uv).zip(&distances) {
            let to = |row: &[f64]| row.iter().zip(query).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt();
            assert!((to(&curve.eval(uv.x)) - distance).abs() <= 1e-14, "{uv} {distance}");
            let sampled = rows.chunks(dim).map(to).fold(f64::INFINITY, f64::min);
            assert!(*distance <= sampled + 1e-12, "{distance} {sampled}");
        }
    }
}

#[test]
fn sizes_at_the_ends_of_the_range_change_nothing() {
    let near = points(200);
    let wave = |scale: f64| {
        let breaks: Vec<f64> = (0..=6).map(f64::from).collect();
        let knots = KnotVector::clamped(&breaks, 3).unwrap();
        let count = knots.basis_count();
        let place = |k: usize| ((k / count) as f64 / 4.0, (k % count) as f64 / 4.0);
        let rows = (0..count * count).map(place).flat_map(|(u, v)| [u, v, (3.0 * u).sin() * (2.0 * v).cos()]);
        TensorSurface::new(3, knots.clone(), knots, rows.map(|x| scale * x).collect(), None).unwrap()
    };
    let plain = project(&wave(1.0), &near.concat(), &ProjectOptions::default());
    // powers of two, so that rounding is the same; about 1e-100 and 1e100
    for exponent in [-333, 333] {
        let scale = 2.0_f64.powi(exponent);
        let rows: Vec<f64> = near.concat().iter().map(|x| scale * x).collect();
        let (uv, distances) = project(&wave(scale), &rows, &ProjectOptions::default());
        for k in 0..near.len() {
            assert!((distances[k] / scale - plain.1[k]).abs() <= 1e-11, "{exponent}: {}", distances[k]);
            assert!(uv[k].is_finite());
        }
    }
}
