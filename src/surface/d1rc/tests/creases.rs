//! Sharp edges and corners.

use super::*;

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
