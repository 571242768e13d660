//! All kinds of surfaces: their weights, derivatives, smoothness and bits.

use super::*;

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
