use super::*;
use crate::surface::ConvertError;

#[test]
fn tensor_surfaces_of_the_parts_and_of_the_whole_are_exact() {
    for is_rational in [false, true] {
        let surface = random_surface(21, 30, 3, is_rational);
        let whole = surface.to_tensor(usize::MAX).unwrap();
        // convex combinations of values of size 1, twice
        assert!(difference(&surface, &whole, 2000) <= 64.0 * f64::EPSILON * 4.0);
        let count = whole.coefficient_count();
        assert!(matches!(surface.to_tensor(count - 1), Err(ConvertError::TooLarge { .. })));
        let mut counts = Vec::new();
        for level_spread in 0..7 {
            let patches = surface.to_tensor_patches(level_spread).unwrap();
            let area: f64 = patches.iter().map(|patch| patch.domain().size().element_product()).sum();
            let exact = surface.domain().size().element_product();
            assert!((area - exact).abs() <= 64.0 * f64::EPSILON * exact);
            for uv in random_places(&surface, 500) {
                let patch = patches.iter().find(|patch| patch.domain().contains(uv)).unwrap();
                let (mut a, mut b) = ([0.0; 3], [0.0; 3]);
                surface.eval_rows(&[uv], 0, &mut a);
                patch.eval_rows(&[uv], 0, &mut b);
                assert!(
                    a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 256.0 * f64::EPSILON),
                    "{level_spread} {uv}"
                );
            }
            counts.push(patches.len());
        }
        assert!(counts.windows(2).all(|pair| pair[0] >= pair[1]), "{counts:?}");
        assert_eq!(counts[6], 1);
    }
}

#[test]
fn bicubic_tensor_surfaces_are_converted_exactly() {
    let mut random = Random::new(4);
    for (degree, is_rational) in [([3, 3], false), ([3, 2], true), ([2, 2], true)] {
        let knots = degree.map(|degree| {
            let breaks = [0.0, 0.3, 1.0, 1.0 + degree as f64];
            KnotVector::clamped(&breaks, degree).unwrap()
        });
        let count = knots[0].basis_count() * knots[1].basis_count();
        let points = (0..3 * count).map(|_| random.signed()).collect();
        let weights = is_rational.then(|| (0..count).map(|_| 0.5 + random.unit()).collect());
        let [knots_u, knots_v] = knots;
        let tensor = TensorSurface::new(3, knots_u, knots_v, points, weights).unwrap();
        let surface = PhtSurface::from_tensor(&tensor, &ConvertOptions::default()).unwrap();
        let off = difference(&surface, &tensor, 2000);
        assert!(off <= 1e-14, "{degree:?}: {off:e}");
        for tolerance in [1e-2, 1e-4] {
            let options = ConvertOptions { tolerance, ..Default::default() };
            let near = PhtSurface::from_tensor(&tensor, &options).unwrap();
            assert!(difference(&near, &tensor, 5000) <= tolerance);
        }
    }
}

#[test]
fn a_sphere_octant_takes_one_cell() {
    // rational biquadratic octant of the unit sphere (The NURBS Book, section 8.3)
    let h = 0.5_f64.sqrt();
    let knots = || KnotVector::clamped(&[0.0, 1.0], 2).unwrap();
    let points = [
        [1., 0., 0.],
        [1., 0., 1.],
        [0., 0., 1.],
        [1., 1., 0.],
        [1., 1., 1.],
        [0., 0., 1.],
        [0., 1., 0.],
        [0., 1., 1.],
        [0., 0., 1.],
    ];
    let weights = vec![1., h, 1., h, 0.5, h, 1., h, 1.];
    let tensor = TensorSurface::new(3, knots(), knots(), points.concat(), Some(weights)).unwrap();
    let surface = PhtSurface::from_tensor(&tensor, &ConvertOptions::default()).unwrap();
    assert_eq!(surface.patch_count(), 1);
    for uv in random_places(&surface, 1000) {
        let mut p = [0.0; 3];
        surface.eval_rows(&[uv], 0, &mut p);
        assert!((glam::DVec3::from_array(p).length() - 1.0).abs() <= 8.0 * f64::EPSILON, "{uv}");
    }
}

#[test]
fn conversion_converges_at_order_four() {
    let errors = [4, 5, 6].map(|level| {
        let surface = bump(level);
        let uv = random_places(&surface, 20_000);
        let mut values = vec![0.0; uv.len()];
        surface.eval_rows(&uv, 0, &mut values);
        let exact = |uv: &DVec2| 0.5 * (-40.0 * uv.distance_squared(DVec2::new(0.4, 0.6))).exp();
        uv.iter().zip(values).map(|(uv, value)| (exact(uv) - value).abs()).fold(0.0, f64::max)
    });
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((order - 4.0).abs() < 0.2, "order {order}");
    }
}
