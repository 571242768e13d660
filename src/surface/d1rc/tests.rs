//! Exact fractions, identities, creases.

use super::simplex::{Site, simplex_spline};
use super::*;
use crate::geometry::signed_area;
use crate::samples::{Random, grid};
use crate::surface::Surface;
use glam::DVec3;

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

/// A grid of n by n nodes, one apart, all diagonals falling.
fn three_directional(n: usize) -> (Vec<DVec2>, Vec<[u32; 3]>) {
    let uv = (0..n * n).map(|k| DVec2::new((k / n) as f64, (k % n) as f64)).collect();
    let mut triangles = Vec::new();
    for k in (0..n * n).filter(|k| k / n + 1 < n && k % n + 1 < n) {
        let [p, q, r, s] = [k, k + n, k + n + 1, k + 1].map(|k| k as u32);
        triangles.extend([[p, q, s], [q, r, s]]);
    }
    (uv, triangles)
}

fn space(
    uv: &[DVec2],
    triangles: &[[u32; 3]],
    options: D1rcOptions,
    sharp: &[[u32; 2]],
) -> Result<Space, D1rcError> {
    let (uv, triangles) = (uv.to_vec(), triangles.to_vec());
    Space::new(Recipe { uv, triangles, options, sharp_edges: sharp.to_vec(), corners: Vec::new() })
}

/// Name, places, faces.
type NamedMesh = (&'static str, Vec<DVec2>, Vec<[u32; 3]>);

/// Parameter meshes of all sorts.
fn meshes() -> Vec<NamedMesh> {
    let (moved, flipped) = grid([9, 8], 0.3, 3, |_| true);
    let (even, turned) = grid([8, 8], 0.0, 5, |_| true);
    let squeezed = moved.iter().map(|p| DVec2::from_angle(0.4).rotate(DVec2::new(p.x, p.y / 20.0))).collect();
    let (far, holed) = grid([10, 10], 0.2, 9, |p| (p - 0.5).length() > 0.2);
    let used: Vec<DVec2> = far.iter().map(|p| 1e3 + 7.0 * p).collect();
    let (uv, triangles) = three_directional(7);
    let (holed_uv, holed) = compact(&used, &holed);
    vec![
        ("moved", moved, flipped.clone()),
        ("even", even, turned),
        ("squeezed", squeezed, flipped),
        ("three directions", uv, triangles),
        ("holed, far away", holed_uv, holed),
    ]
}

/// Without the nodes that no triangle uses.
fn compact(uv: &[DVec2], triangles: &[[u32; 3]]) -> (Vec<DVec2>, Vec<[u32; 3]>) {
    let mut used: Vec<u32> = triangles.iter().flatten().copied().collect();
    used.sort_unstable();
    used.dedup();
    let new = |node: u32| used.binary_search(&node).unwrap() as u32;
    (used.iter().map(|&node| uv[node as usize]).collect(), triangles.iter().map(|t| t.map(new)).collect())
}

/// Random points of all faces, their corners, and the middles of their sides.
fn sample(uv: &[DVec2], triangles: &[[u32; 3]]) -> Vec<DVec2> {
    let mut random = Random::new(2);
    let mut all = Vec::new();
    for triangle in triangles {
        let [a, b, c] = triangle.map(|v| uv[v as usize]);
        all.extend([a, (a + b) / 2.0, (b + c) / 2.0]);
        let (s, t) = (random.unit(), random.unit());
        let (s, t) = if s + t > 1.0 { (1.0 - s, 1.0 - t) } else { (s, t) };
        all.push(a + s * (b - a) + t * (c - a));
    }
    all
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

/// A mesh of the square [-1, 1]^2 without symmetries, whose column `u = 0` (nodes of the middle) may be bent.
fn folded(n: usize, bend: f64) -> (Vec<DVec2>, Vec<[u32; 3]>, Vec<u32>) {
    let mut random = Random::new(17);
    let (places, triangles) = grid([n, n], 0.0, 4, |_| true);
    let middle = n / 2;
    let uv = places.iter().enumerate().map(|(k, p)| {
        let (i, j) = (k / n, k % n);
        let is_inner = (1..n - 1).contains(&i) && (1..n - 1).contains(&j) && i != middle;
        let jitter = if is_inner { 0.2 / n as f64 } else { 0.0 };
        let moved = 2.0 * *p - 1.0 + jitter * DVec2::new(random.signed(), random.signed());
        let wave = bend * (1.0 - moved.x.abs()) * (2.0 * moved.y + 0.3).sin();
        moved + DVec2::new(wave, 0.0)
    });
    (uv.collect(), triangles, (0..n).map(|j| (middle * n + j) as u32).collect())
}

fn crease_edges(column: &[u32]) -> Vec<[u32; 2]> {
    column.windows(2).map(|pair| [pair[0], pair[1]]).collect()
}

/// The control points of a roof along u = 0 whose sides fall at half the angle each.
fn roof(uv: &[DVec2], angle: f64) -> Vec<f64> {
    let slope = (angle / 2.0).tan();
    uv.iter().flat_map(|p| [p.x, p.y, -slope * p.x.abs()]).collect()
}

fn normal_at(surface: &D1rcSurface, uv: DVec2) -> DVec3 {
    let mut rows = [0.0; 9];
    surface.eval_rows(&[uv], 1, &mut rows);
    crate::surface::normal(DVec3::from_slice(&rows[3..]), DVec3::from_slice(&rows[6..]))
}

#[test]
fn a_straight_fold_keeps_its_45_degrees() {
    let (uv, triangles, column) = folded(7, 0.0);
    for degree in 1..=3 {
        let options = D1rcOptions::default().with_degree(degree);
        let space = space(&uv, &triangles, options, &crease_edges(&column)).unwrap();
        let points = roof(&uv, 45_f64.to_radians());
        let surface = D1rcSurface::new(space, 3, points.clone()).unwrap();
        for k in 0..40 {
            let v = -0.99 + 1.98 * f64::from(k) / 39.0;
            let [left, right] = [-1e-9, 1e-9].map(|u| normal_at(&surface, DVec2::new(u, v)));
            let angle = left.angle_between(right).to_degrees();
            // both sides are planes, and are reproduced
            assert!((angle - 45.0).abs() <= 1e-6, "degree {degree} at {v}: {angle}");
            let mut at = [0.0; 3];
            surface.eval_rows(&[DVec2::new(0.0, v)], 0, &mut at);
            assert!(at[0].abs() + at[2].abs() <= 1e-13, "degree {degree} at {v}: {at:?}");
        }
    }
}

/// Largest distance of the surface's crease from the control polyline, over the middle and ends of its edges.
fn crease_error(surface: &D1rcSurface, edges: &[[u32; 2]]) -> f64 {
    let uv = &surface.space().recipe.uv;
    let point = |v: u32| DVec3::from_slice(&surface.control_points()[3 * v as usize..]);
    let mut worst = 0.0_f64;
    for &[a, b] in edges {
        for share in [0.0, 0.25, 0.5, 0.875] {
            let t = uv[a as usize] + share * (uv[b as usize] - uv[a as usize]);
            let expected = point(a) + share * (point(b) - point(a));
            // the nearest places on both sides, and what rounding makes of the place itself
            let across = (uv[b as usize] - uv[a as usize]).perp();
            for side in [-1e-15, 0.0, 1e-15] {
                let mut at = [0.0; 3];
                surface.eval_rows(&[t + side * across], 0, &mut at);
                worst = worst.max((DVec3::from_array(at) - expected).length());
            }
        }
    }
    worst
}

/// Creases of all sorts on one mesh: name, edges.
fn creases(n: usize) -> Vec<(&'static str, Vec<[u32; 2]>)> {
    let at = |i: usize, j: usize| (i * n + j) as u32;
    let chain = |nodes: Vec<u32>| crease_edges(&nodes);
    let column: Vec<u32> = (0..n).map(|j| at(n / 2, j)).collect();
    let row: Vec<u32> = (0..n).map(|i| at(i, n / 2)).collect();
    let square =
        [(2, 2), (3, 2), (4, 2), (5, 2), (5, 3), (5, 4), (5, 5), (4, 5), (3, 5), (2, 5), (2, 4), (2, 3)];
    let ring: Vec<u32> = square.iter().chain([&square[0]]).map(|&(i, j)| at(i, j)).collect();
    vec![
        ("through", chain(column.clone())),
        ("ends inside", chain(column[..n - 3].to_vec())),
        ("both ends inside", chain(column[2..n - 2].to_vec())),
        ("one edge", chain(column[3..5].to_vec())),
        ("two lonely edges", [chain(column[2..4].to_vec()), chain(row[5..7].to_vec())].concat()),
        ("T", [chain(column.clone()), chain(row[n / 2..].to_vec())].concat()),
        ("X", [chain(column), chain(row)].concat()),
        ("closed", chain(ring)),
    ]
}

#[test]
fn creases_are_their_control_polylines() {
    let n = 9;
    let (uv, triangles, _) = folded(n, 0.15);
    let height = |p: &DVec2| 0.3 * (3.0 * p.x).sin() * (2.0 * p.y + 1.0).cos() - 0.5 * (p.x - 0.1).abs();
    let points: Vec<f64> = uv.iter().flat_map(|p| [p.x, p.y, height(p)]).collect();
    for (name, edges) in creases(n) {
        for degree in 1..=3 {
            for boundary in [Boundary::Phantom, Boundary::Clamped] {
                let options = D1rcOptions::default().with_degree(degree).with_boundary(boundary);
                let made = space(&uv, &triangles, options, &edges);
                let space = made.unwrap_or_else(|e| panic!("{name}, degree {degree}, {boundary:?}: {e}"));
                let surface = D1rcSurface::new(space, 3, points.clone()).unwrap();
                let mut worst = (0.0_f64, 0.0_f64);
                for t in sample(&uv, &triangles) {
                    let shares = surface.space().shares(t).unwrap();
                    worst.0 = worst.0.max((shares.iter().map(|s| s.1).sum::<f64>() - 1.0).abs());
                    let mut at = [0.0; 3];
                    surface.eval_rows(&[t], 0, &mut at);
                    worst.1 = worst.1.max((DVec2::new(at[0], at[1]) - t).length());
                }
                let error = crease_error(&surface, &edges);
                assert!(
                    worst.0 < 1e-13 && worst.1 < 1e-13,
                    "{name}, degree {degree}, {boundary:?}: {worst:?}"
                );
                assert!(error < 1e-13, "{name}, degree {degree}, {boundary:?}: {error:e}");
            }
        }
    }
}

#[test]
fn corners_are_interpolated() {
    let (uv, triangles, column) = folded(9, 0.1);
    let height = |p: &DVec2| 0.3 * (3.0 * p.x).sin() * (2.0 * p.y + 1.0).cos();
    let points: Vec<f64> = uv.iter().flat_map(|p| [p.x, p.y, height(p)]).collect();
    let corners = vec![20, 50, column[4], 0, 3];
    for degree in 1..=3 {
        let recipe = Recipe {
            uv: uv.clone(),
            triangles: triangles.clone(),
            options: D1rcOptions::default().with_degree(degree),
            sharp_edges: crease_edges(&column),
            corners: corners.clone(),
        };
        let surface = D1rcSurface::new(Space::new(recipe).unwrap(), 3, points.clone()).unwrap();
        for &corner in &corners {
            let mut at = [0.0; 3];
            surface.eval_rows(&[uv[corner as usize]], 0, &mut at);
            let expected = DVec3::from_slice(&points[3 * corner as usize..]);
            let off = (DVec3::from_array(at) - expected).length();
            assert!(off < 1e-13, "degree {degree}, corner {corner}: {off:e}");
        }
        for t in sample(&uv, &triangles) {
            let sum: f64 = surface.space().shares(t).unwrap().iter().map(|s| s.1).sum();
            assert!((sum - 1.0).abs() < 1e-13, "degree {degree} at {t}: {sum}");
        }
    }
}

/// A wavy surface over a mesh without symmetries.
fn wavy(options: D1rcOptions, sharp: &[[u32; 2]]) -> D1rcSurface {
    let (uv, triangles, _) = folded(9, 0.1);
    let height = |p: &DVec2| 0.3 * (3.0 * p.x).sin() * (2.0 * p.y + 1.0).cos();
    let points = uv.iter().flat_map(|p| [p.x, p.y, height(p)]).collect();
    D1rcSurface::new(space(&uv, &triangles, options, sharp).unwrap(), 3, points).unwrap()
}

/// All kinds of surfaces.
fn kinds() -> Vec<(String, D1rcSurface)> {
    let crease = crease_edges(&folded(9, 0.1).2[2..7]);
    let mut all = Vec::new();
    for degree in 1..=3 {
        let options = D1rcOptions::default().with_degree(degree);
        let paper = options.with_mode(D1rcMode::Paper);
        for (name, options, sharp) in [
            ("phantom", options, &[][..]),
            ("clamped", options.with_boundary(Boundary::Clamped), &[]),
            ("open", options.with_boundary(Boundary::Open), &[]),
            ("cut", options, &crease),
            ("soft crease", options.with_sharp(SharpRule::Additive), &crease),
            ("paper", paper, &[]),
            ("paper, additive", paper, &crease),
            ("paper, sector", paper.with_sharp(SharpRule::Sector), &crease),
        ] {
            all.push((format!("{name}, degree {degree}"), wavy(options, sharp)));
        }
    }
    all
}

/// Random places where a surface is.
fn places(surface: &D1rcSurface, count: usize) -> Vec<DVec2> {
    let mut random = Random::new(23);
    let domain = surface.domain();
    let next = || domain.min + domain.size() * DVec2::new(random.unit(), random.unit());
    std::iter::repeat_with(next).filter(|&uv| surface.contains(uv)).take(count).collect()
}

#[test]
fn vertex_weights_are_the_surface() {
    for (name, surface) in kinds() {
        let mut weights = Vec::new();
        for uv in places(&surface, 100) {
            surface.vertex_weights(uv, &mut weights);
            let sum: f64 = weights.iter().map(|w| w.1).sum();
            assert!((sum - 1.0).abs() < 1e-13, "{name} at {uv}: {sum}");
            let point = |v: u32| DVec3::from_slice(&surface.control_points()[3 * v as usize..]);
            let mean: DVec3 = weights.iter().map(|&(vertex, weight)| weight * point(vertex)).sum();
            let mut at = [0.0; 3];
            surface.eval_rows(&[uv], 0, &mut at);
            assert!((mean - DVec3::from_array(at)).length() < 1e-13, "{name} at {uv}");
        }
    }
}

#[test]
fn values_are_convex_combinations() {
    for (name, surface) in kinds() {
        for uv in places(&surface, 200) {
            let shares = surface.space().shares(uv).unwrap();
            let least = shares.iter().fold(0.0_f64, |least, share| least.min(share.1));
            assert!(least >= -1e-14, "{name} at {uv}: {least:e}");
        }
        // without phantom knots each function has a mean of control points: the surface stays in their hull
        let options = &surface.space().recipe.options;
        if options.mode == D1rcMode::Paper || options.boundary == Boundary::Clamped {
            let rows = surface.space().configurations.iter().flat_map(|c| &c.row);
            assert!(rows.clone().count() > 0 && rows.clone().all(|&(_, weight)| weight > 0.0), "{name}");
        }
    }
}

#[test]
fn derivatives_are_the_limits_of_differences() {
    let h = 1e-5;
    for (name, surface) in kinds() {
        let mut checked = 0;
        for uv in places(&surface, 120) {
            let at = |x: f64, y: f64| uv + h * DVec2::new(x, y);
            let cross = [at(1., 0.), at(-1., 0.), at(0., 1.), at(0., -1.)];
            // kinks of first derivatives between these points, as degree 1 and creases have, spoil the quotients
            let faces = |uv| surface.space().find(uv).map(|found| found.0);
            if cross.iter().any(|&uv2| faces(uv2) != faces(uv)) {
                continue;
            }
            let mut rows = [0.0; 18];
            surface.eval_rows(&[uv], 2, &mut rows);
            let mut near = [0.0; 4 * 9];
            surface.eval_rows(&cross, 1, &mut near);
            let near = |point: usize, row: usize, k: usize| near[9 * point + 3 * row + k];
            for k in 0..3 {
                for (axis, row) in [(0, 1), (1, 2)] {
                    let quotient = (near(2 * axis, 0, k) - near(2 * axis + 1, 0, k)) / (2.0 * h);
                    // roundoff 1e-16 / h, and h times a jump of second derivatives (some hundred) between the points
                    assert!((quotient - rows[3 * row + k]).abs() <= 2e-3, "{name} at {uv}: {quotient}");
                }
                if surface.degree() == 3 {
                    for (axis, first, row) in [(0, 1, 3), (0, 2, 4), (1, 1, 4), (1, 2, 5)] {
                        let quotient = (near(2 * axis, first, k) - near(2 * axis + 1, first, k)) / (2.0 * h);
                        let off = (quotient - rows[3 * row + k]).abs();
                        assert!(off <= 0.05 * (1.0 + quotient.abs()), "{name} at {uv}, row {row}: {off:e}");
                    }
                }
            }
            checked += 1;
        }
        assert!(checked > 60, "{name}: {checked}");
    }
}

#[test]
fn degree_k_is_k_less_one_times_differentiable() {
    // jumps across edges of derivatives of order k - 1, from points beside their middles, shrink with the distance
    for degree in 2..=3 {
        let surface = wavy(D1rcOptions::default().with_degree(degree), &[]);
        let recipe = &surface.space().recipe;
        let rows = 3 * crate::surface::derivative_rows(degree - 1);
        let jump = |distance: f64| {
            let mut worst = 0.0_f64;
            for &[a, b, _] in &recipe.triangles {
                let [p, q] = [a, b].map(|v| recipe.uv[v as usize]);
                let (middle, across) = (0.4 * p + 0.6 * q, distance * (q - p).perp().normalize());
                let sides = [middle - across, middle + across];
                if sides.iter().all(|&uv| surface.contains(uv)) {
                    let mut both = vec![0.0; 2 * rows];
                    surface.eval_rows(&sides, degree - 1, &mut both);
                    let (left, right) = both.split_at(rows);
                    worst = left.iter().zip(right).fold(worst, |worst, (l, r)| worst.max((l - r).abs()));
                }
            }
            worst
        };
        let (far, near) = (jump(1e-5), jump(1e-7));
        assert!(near <= 0.02 * far, "degree {degree}: {far:e}, then {near:e}");
    }
}

#[test]
fn edges_are_as_smooth_as_they_are_said_to_be() {
    let (uv, triangles, column) = folded(9, 0.1);
    let crease = crease_edges(&column);
    for degree in 2..=3 {
        let surface = wavy(D1rcOptions::default().with_degree(degree), &crease);
        let mut kinked = [0; 2];
        for [a, b, c] in triangles.iter().copied() {
            for edge in [[a, b], [b, c], [c, a]] {
                let order = surface.edge_continuity(&[edge]).unwrap()[0];
                let [p, q] = edge.map(|v| uv[v as usize]);
                let (middle, across) = (0.45 * p + 0.55 * q, (q - p).perp().normalize());
                if ![-1e-6, 1e-6].iter().all(|side| surface.contains(middle + side * across)) {
                    continue;
                }
                let differences = |distance: f64| {
                    let mut rows = [0.0; 18];
                    surface.eval_rows(
                        &[-distance, distance].map(|side| middle + side * across),
                        1,
                        &mut rows,
                    );
                    let worst = |from: usize, to: usize| {
                        (from..to).fold(0.0_f64, |worst, k| worst.max((rows[k] - rows[9 + k]).abs()))
                    };
                    (worst(0, 3), worst(3, 9))
                };
                let ((gap, kink), (_, far)) = (differences(1e-8), differences(1e-6));
                assert!(gap < 1e-6, "{edge:?} is torn by {gap:e}");
                let is_crease = edge.iter().all(|v| column.contains(v));
                let touches = edge.iter().any(|v| column.contains(v));
                assert_eq!(order, if touches { 0 } else { degree - 1 }, "{edge:?}");
                // what is continuous shrinks with the distance, down to roundoff
                assert!(touches || kink <= 0.02 * far + 1e-9, "{edge:?} has a kink of {kink:e}");
                kinked[0] += usize::from(is_crease && kink > 1e-3);
                kinked[1] += usize::from(!is_crease && touches && kink > 1e-3);
            }
        }
        // both classes of order 0 are really met
        assert!(kinked[0] > 4 && kinked[1] > 4, "degree {degree}: {kinked:?}");
    }
}

#[test]
fn moved_parameters_and_points_move_the_surface() {
    let turn = |p: DVec2| DVec2::from_angle(0.7).rotate(p) * 3.0 + DVec2::new(5.0, -2.0);
    for (name, surface) in kinds() {
        let mut recipe = surface.space().recipe.clone();
        recipe.uv.iter_mut().for_each(|uv| *uv = turn(*uv));
        let affine = |p: DVec3| DVec3::new(2.0 * p.y - p.z, p.x + 1.0, p.x - 3.0 * p.z);
        let points = surface.control_points().chunks_exact(3);
        let points = points.flat_map(|p| affine(DVec3::from_slice(p)).to_array()).collect();
        let moved = D1rcSurface::new(Space::new(recipe).unwrap(), 3, points).unwrap();
        for uv in places(&surface, 60) {
            let (mut before, mut after) = ([0.0; 3], [0.0; 3]);
            surface.eval_rows(&[uv], 0, &mut before);
            moved.eval_rows(&[turn(uv)], 0, &mut after);
            let off = (affine(DVec3::from_array(before)) - DVec3::from_array(after)).length();
            assert!(off < 1e-12, "{name} at {uv}: {off:e}");
        }
    }
}

#[test]
fn a_vertex_moves_its_region_and_nothing_else() {
    for (name, mut surface) in kinds() {
        let before = surface.clone();
        let vertex = 4 * 9 + 4;
        let faces = surface.influence(vertex).unwrap();
        let mut point = surface.control_points()[3 * vertex as usize..][..3].to_vec();
        point[2] += 1.0;
        surface.set_control_points(&[vertex], &point).unwrap();
        let mut moved = 0;
        for uv in places(&surface, 400) {
            let (mut old, mut new) = ([0.0; 3], [0.0; 3]);
            before.eval_rows(&[uv], 0, &mut old);
            surface.eval_rows(&[uv], 0, &mut new);
            let face = surface.space().parents[surface.space().find(uv).unwrap().0 as usize];
            moved += usize::from(old != new);
            assert!(old == new || faces.contains(&face), "{name} at {uv}");
        }
        assert!(moved > 0, "{name}");
        // as if it had been made so
        let made = D1rcSurface::new(surface.space().clone(), 3, surface.control_points().to_vec()).unwrap();
        assert_eq!(made.coefficients, surface.coefficients, "{name}");
    }
}

#[test]
fn points_give_the_same_bits_alone_and_together() {
    for (name, surface) in kinds() {
        // many points of each face, in a row
        let uv: Vec<DVec2> = places(&surface, 40).iter().flat_map(|&uv| [uv, uv + 1e-9, uv - 2e-9]).collect();
        let uv: Vec<DVec2> = uv.into_iter().filter(|&uv| surface.contains(uv)).collect();
        for order in 0..=2 {
            let row = 3 * crate::surface::derivative_rows(order);
            let mut together = vec![0.0; uv.len() * row];
            surface.eval_rows(&uv, order, &mut together);
            for (&uv, expected) in uv.iter().zip(together.chunks_exact(row)) {
                let mut alone = vec![0.0; row];
                surface.eval_rows(&[uv], order, &mut alone);
                assert_eq!(alone, expected, "{name} at {uv}, order {order}");
            }
        }
    }
}

#[test]
fn open_surfaces_keep_the_plane_where_they_are() {
    for degree in 1..=3 {
        let surface = wavy(D1rcOptions::default().with_degree(degree).with_boundary(Boundary::Open), &[]);
        for uv in places(&surface, 300) {
            let mut at = [0.0; 3];
            surface.eval_rows(&[uv], 0, &mut at);
            assert!((DVec2::new(at[0], at[1]) - uv).length() < 1e-13, "degree {degree} at {uv}");
        }
        assert!(!surface.contains(DVec2::splat(-0.99)), "degree {degree}");
    }
}

#[test]
fn additive_creases_are_sharper_with_weight() {
    let (uv, triangles, column) = folded(9, 0.0);
    let angle = |weight: f64, rule: SharpRule| {
        let options = D1rcOptions { sharp_weight: weight, ..D1rcOptions::default() };
        let options = options.with_mode(D1rcMode::Paper).with_sharp(rule);
        let space = space(&uv, &triangles, options, &crease_edges(&column)).unwrap();
        let surface = D1rcSurface::new(space, 3, roof(&uv, 45_f64.to_radians())).unwrap();
        let [left, right] = [-1e-9, 1e-9].map(|u| normal_at(&surface, DVec2::new(u, 0.07)));
        left.angle_between(right).to_degrees()
    };
    let [soft, harder] = [1.0, 16.0].map(|weight| angle(weight, SharpRule::Additive));
    assert!(soft > 5.0 && harder > soft && harder < 45.0 + 1e-6, "{soft} {harder}");
    let sector = angle(1.0, SharpRule::Sector);
    assert!((sector - 45.0).abs() < 1e-3, "straight chains keep their angle: {sector}");
}

#[test]
fn bad_recipes_are_refused() {
    let (uv, triangles, _) = folded(5, 0.0);
    let options = D1rcOptions::default();
    let mut folded_uv = uv.clone();
    folded_uv.swap(12, 13);
    let refused = space(&folded_uv, &triangles, options, &[]).unwrap_err();
    assert!(matches!(refused, D1rcError::Folded { .. }), "{refused}");
    let mut flat = uv.clone();
    flat[6] = flat[1];
    assert!(matches!(space(&flat, &triangles, options, &[]).unwrap_err(), D1rcError::NoArea { .. }));
    let closed = vec![[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]];
    assert!(matches!(space(&uv[..4], &closed, options, &[]).unwrap_err(), D1rcError::NotDisk { .. }));
    let tiny = (vec![DVec2::ZERO, DVec2::X, DVec2::Y], vec![[0, 1, 2]]);
    let paper = options.with_mode(D1rcMode::Paper);
    assert_eq!(space(&tiny.0, &tiny.1, paper, &[]).unwrap_err(), D1rcError::NoConfiguration { degree: 3 });
    let not_an_edge = D1rcError::NotAnEdge { index: 1, vertices: [0, 24] };
    assert_eq!(space(&uv, &triangles, options, &[[0, 1], [0, 24]]).unwrap_err(), not_an_edge);
    // a single face is a surface of its own with knots beyond it
    assert!(space(&tiny.0, &tiny.1, options, &[]).is_ok());
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
