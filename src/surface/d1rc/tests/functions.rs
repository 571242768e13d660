//! Functions: exact fractions and identities.

use super::super::simplex::{Site, simplex_spline};
use super::*;
use crate::geometry::signed_area;

/// A function by itself: its own knots and a ring, counter-clockwise.
fn alone(knots: &[[f64; 2]], ring: &[[f64; 2]]) -> (Configuration, Vec<DVec2>) {
    let k = knots.len() as u32;
    let n = ring.len() as u32;
    let edges = (0..n).map(|i| [k + i, k + (i + 1) % n]).collect();
    let places = knots.iter().chain(ring).map(|&knot| DVec2::from(knot)).collect();
    (Configuration { knots: (0..k).collect(), edges, weight: 1.0, row: Vec::new() }, places)
}

const K2: [[f64; 2]; 2] = [[0., 0.], [1., 0.]];
const K2_RING: [[f64; 2]; 8] =
    [[0., -1.], [1., -1.], [2., -1.], [2., 0.], [1., 1.], [0., 1.], [-1., 1.], [-1., 0.]];
const K3: [[f64; 2]; 3] = [[0., 0.], [1., 0.], [0., 1.]];
const K3_RING: [[f64; 2]; 9] =
    [[0., -1.], [1., -1.], [2., -1.], [2., 0.], [1., 1.], [0., 2.], [-1., 2.], [-1., 1.], [-1., 0.]];
const K2_GENERIC: [[f64; 2]; 2] = [[0., 0.], [3., 1.]];
const K2_GENERIC_RING: [[f64; 2]; 6] = [[0., -4.], [5., -3.], [7., 1.], [4., 5.], [-1., 4.], [-3., 1.]];
const CREASE: [[f64; 2]; 2] = [[0., 0.], [1.5, 0.5]];
const CREASE_RING: [[f64; 2]; 5] = [[1., -3.], [3., 1.], [1., 4.], [-3., 2.], [-2., -3.]];
const K3_GENERIC: [[f64; 2]; 3] = [[0., 0.], [3., 1.], [1., 3.]];
const K3_GENERIC_RING: [[f64; 2]; 7] =
    [[-1., -3.], [3., -3.], [6., -1.], [5., 3.], [2., 6.], [-2., 5.], [-4., 1.]];

#[test]
fn functions_take_their_exact_values() {
    let third = 1. / 3.;
    for (knots, ring, t, value) in [
        (&K2[..], &K2_RING[..], [0.5, 0.], 3. / 4.),
        (&K2, &K2_RING, [0., 0.], 1. / 2.),
        (&K2, &K2_RING, [third, third], 4. / 9.),
        (&K2, &K2_RING, [0.5, 0.5], 1. / 4.),
        (&K3, &K3_RING, [third, third], 7. / 12.),
        (&K3, &K3_RING, [0., 0.], 1. / 4.),
        (&K3, &K3_RING, [0.5, 0.], 7. / 16.),
        (&K2_GENERIC, &K2_GENERIC_RING, [0., 0.], 2. / 5.),
        (&K2_GENERIC, &K2_GENERIC_RING, [1., 1.], 210. / 341.),
        (&K2_GENERIC, &K2_GENERIC_RING, [1.5, 0.5], 113. / 155.),
        (&CREASE, &CREASE_RING, [0., 0.], 13. / 21.),
        (&CREASE, &CREASE_RING, [0., 1.], 10. / 21.),
        (&K3_GENERIC, &K3_GENERIC_RING, [0., 0.], 13. / 56.),
        (&K3_GENERIC, &K3_GENERIC_RING, [1., 1.], 767_215. / 1_302_336.),
    ] {
        let (function, places) = alone(knots, ring);
        let measured = function.jet(&Site::new(DVec2::from(t)), &places, 0)[0];
        assert!((measured - value).abs() <= 1e-13, "{knots:?} at {t:?}: {measured} instead of {value}");
        let kernel =
            kernel::Kernel::new(knots.len(), std::slice::from_ref(&function), &places, &Watch::default())
                .unwrap();
        let mut workspace = kernel::Workspace::default();
        let site = [Site::new(DVec2::from(t))];
        let fast = kernel.jets(0, &function, &places, &site, 0, &mut workspace).unwrap()[0][0];
        assert!((fast - value).abs() <= 1e-13, "{knots:?} at {t:?}: {fast} instead of {value}");
    }
}

#[test]
fn gradients_take_their_exact_values() {
    let third = 1. / 3.;
    for (knots, ring, t, gradient) in [
        (&K3[..], &K3_RING[..], [third, third], [0., 0.]),
        (&K2_GENERIC, &K2_GENERIC_RING, [0., 0.], [1. / 3., 1. / 5.]),
        (&K3_GENERIC, &K3_GENERIC_RING, [0., 0.], [3. / 14., 9. / 56.]),
    ] {
        let (function, places) = alone(knots, ring);
        let jet = function.jet(&Site::new(DVec2::from(t)), &places, 1);
        let off = (jet[1] - gradient[0]).hypot(jet[2] - gradient[1]);
        assert!(off <= 1e-13, "{knots:?} at {t:?}: {jet:?} instead of {gradient:?}");
    }
}

#[test]
fn integrals_are_those_of_the_region() {
    // b is a spline of degree k on a fine grid: the midpoint rule is off by about h^2
    for (knots, ring, integral) in [
        (&K2[..], &K2_RING[..], 5. / 6.),
        (&K3, &K3_RING, 13. / 20.),
        (&K2_GENERIC, &K2_GENERIC_RING, 121. / 12.),
        (&CREASE, &CREASE_RING, 19. / 4.),
        (&K3_GENERIC, &K3_GENERIC_RING, 127. / 20.),
    ] {
        let (function, places) = alone(knots, ring);
        let around = Domain::around(places.iter().copied());
        let sum_over = |n: usize| {
            let step = around.size() / n as f64;
            let place = |k: usize| around.min + step * (DVec2::new((k / n) as f64, (k % n) as f64) + 0.5);
            let values = (0..n * n).map(|k| function.jet(&Site::new(place(k)), &places, 0)[0]);
            step.x * step.y * values.sum::<f64>()
        };
        let (coarse, fine) = ((sum_over(60) - integral).abs(), (sum_over(120) - integral).abs());
        assert!(fine <= 2e-3 * integral && fine <= 0.7 * coarse, "{knots:?}: {coarse:e}, then {fine:e}");
    }
}

#[test]
fn the_edge_form_is_the_face_form() {
    let mut random = Random::new(11);
    for (knots, ring) in [(&K2_GENERIC[..], &K2_GENERIC_RING[..]), (&K3_GENERIC, &K3_GENERIC_RING)] {
        let (function, places) = alone(knots, ring);
        let k = knots.len();
        let x = &places[..k];
        for _ in 0..300 {
            let site = Site::new(DVec2::new(5.0 * random.signed(), 5.0 * random.signed()));
            // the fan of the ring around its first knot: any triangulation will do, turned over or not
            let fan = (1..ring.len() - 1).map(|i| [places[k], places[k + i], places[k + i + 1]]);
            let each = fan.map(|[a, b, c]| {
                let all: Vec<DVec2> = x.iter().copied().chain([a, b, c]).collect();
                signed_area(a, b, c) * simplex_spline(&site, &all)
            });
            let faces: f64 = each.sum();
            let edges = function.jet(&site, &places, 0)[0];
            // some hundred products, the largest a few units
            assert!((faces - edges).abs() <= 64.0 * f64::EPSILON, "{site:?}: {faces} {edges}");
            assert!(edges >= -1e-15, "{site:?}: {edges}");
        }
    }
}

#[test]
fn three_directional_grids_sum_to_the_exact_fractions() {
    let (uv, triangles) = three_directional(9);
    for (degree, sums) in [(2, [3., 5. / 2., 7. / 3., 19. / 8.]), (3, [3. / 2., 5. / 4., 7. / 6., 39. / 32.])]
    {
        let options = D1rcOptions::default().with_degree(degree).with_mode(D1rcMode::Paper);
        let space = space(&uv, &triangles, options, &[]).unwrap();
        let third = 1. / 3.;
        for (t, sum) in [[0., 0.], [0.5, 0.], [third, third], [0.25, 0.25]].into_iter().zip(sums) {
            let t = DVec2::splat(4.0) + DVec2::from(t);
            let all = (0..space.configurations.len()).map(|f| space.function_jet(f, t, 0).unwrap()[0]);
            let measured: f64 = all.sum();
            assert!((measured - sum).abs() <= 1e-13, "degree {degree} at {t}: {measured} instead of {sum}");
        }
    }
}

#[test]
fn reproducing_functions_sum_to_one_and_keep_the_plane() {
    for (name, uv, triangles) in meshes() {
        let scale = uv.iter().fold(1.0_f64, |most, p| most.max(p.length()));
        for degree in 1..=3 {
            for boundary in [Boundary::Phantom, Boundary::Clamped] {
                let options = D1rcOptions::default().with_degree(degree).with_boundary(boundary);
                let space = space(&uv, &triangles, options, &[]);
                let space = space.unwrap_or_else(|e| panic!("{name}, degree {degree}, {boundary:?}: {e}"));
                let points: Vec<f64> = uv.iter().flat_map(|p| p.to_array()).collect();
                let surface = D1rcSurface::new(space, 2, points).unwrap();
                let (mut worst_sum, mut worst) = (0.0_f64, 0.0_f64);
                for t in sample(&uv, &triangles) {
                    let shares = surface.space().shares(t).unwrap();
                    worst_sum = worst_sum.max((shares.iter().map(|s| s.1).sum::<f64>() - 1.0).abs());
                    let least = shares.iter().fold(0.0_f64, |least, s| least.min(s.1));
                    assert!(least >= -1e-14, "{name}, degree {degree}, {boundary:?} at {t}: {least:e}");
                    let mut at = [0.0; 2];
                    surface.eval_rows(&[t], 0, &mut at);
                    worst = worst.max((DVec2::from(at) - t).length() / scale);
                }
                assert!(worst_sum < 1e-13, "{name}, degree {degree}, {boundary:?}: {worst_sum:e}");
                assert!(worst < 1e-13, "{name}, degree {degree}, {boundary:?}: {worst:e}");
            }
        }
    }
}

/// Two rings of `count` knots around a hub, a little out of round so that no four of them lie on a circle.
fn wheel(count: usize) -> (Vec<DVec2>, Vec<[u32; 3]>) {
    let mut random = Random::new(7);
    let n = count as u32;
    let mut uv = vec![DVec2::ZERO];
    for radius in [1.0, 2.0] {
        uv.extend((0..n).map(|k| {
            let angle = std::f64::consts::TAU * f64::from(k) / f64::from(n);
            radius * (1.0 + 1e-3 * random.signed()) * DVec2::from_angle(angle)
        }));
    }
    let triangles = (0..n).flat_map(|k| {
        let (a, b) = (1 + k, 1 + (k + 1) % n);
        [[0, a, b], [a, a + n, b + n], [a, b + n, b]]
    });
    (uv, triangles.collect())
}

#[test]
fn functions_around_a_knot_of_many_neighbours_sum_to_one() {
    for count in [5, 60, 300, 3000] {
        let (uv, triangles) = wheel(count);
        let space = space(&uv, &triangles, D1rcOptions::default(), &[]).unwrap();
        let ones = D1rcSurface::new(space, 1, vec![1.0; uv.len()]).unwrap();
        for place in [DVec2::new(0.01, 0.02), DVec2::new(-0.6, 0.3), DVec2::new(0.2, -1.4)] {
            let mut value = [0.0];
            ones.eval_rows(&[place], 0, &mut value);
            // each function is a sum over as many knots as the hub has neighbours
            assert!((value[0] - 1.0).abs() <= 1e-12 * count as f64, "{count} at {place}: {value:?}");
        }
    }
}
