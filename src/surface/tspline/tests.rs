use super::*;
use crate::samples::Random;
use crate::surface::{ConvertError, derivative_rows};

/// Curves with a few common knots and many of their own; knots along v uneven, one of them twice.
fn surface(dim: usize, seed: u64) -> TSplineSurface {
    let mut random = Random::new(seed);
    let knots_v = KnotVector::clamped(&[-1.0, 0.0, 0.1, 0.1, 2.0, 2.5], 3).unwrap();
    let curves = (0..knots_v.basis_count()).map(|j| {
        let mut breaks: Vec<f64> = (0..2 + 3 * (j % 4)).map(|_| random.unit()).collect();
        breaks.extend([0.0, 0.25, 0.5, 1.0]);
        breaks.sort_unstable_by(f64::total_cmp);
        let knots = KnotVector::clamped(&breaks, 3).unwrap();
        let points = (0..dim * knots.basis_count()).map(|_| random.signed()).collect();
        Curve::new(dim, knots, points).unwrap()
    });
    TSplineSurface::new(knots_v.clone(), curves.collect()).unwrap()
}

fn places(surface: &TSplineSurface, count: usize, seed: u64) -> Vec<DVec2> {
    let (domain, mut random) = (surface.domain(), Random::new(seed));
    let mut uv: Vec<DVec2> =
        (0..count).map(|_| domain.min + DVec2::new(random.unit(), random.unit()) * domain.size()).collect();
    uv.extend([domain.min, domain.max, DVec2::new(0.25, 0.1), DVec2::new(1.0, 0.0)]);
    uv
}

fn values(surface: &dyn Surface, uv: &[DVec2]) -> Vec<f64> {
    let mut out = vec![0.0; uv.len() * surface.dim()];
    surface.eval_rows(uv, 0, &mut out);
    out
}

#[track_caller]
fn assert_same(a: &dyn Surface, b: &dyn Surface, uv: &[DVec2]) {
    for (k, (a, b)) in values(a, uv).iter().zip(values(b, uv)).enumerate() {
        // the contract of refinement and conversion, control points being of size one
        assert!((a - b).abs() <= 1e-12, "{k}: {a} is not {b} at {:?}", uv[k / 3]);
    }
}

#[test]
fn both_evaluations_agree() {
    for seed in 0..5 {
        let surface = surface(3, seed);
        let uv = places(&surface, 1000, seed);
        for order in 0..=1 {
            let len = 3 * derivative_rows(order) * uv.len();
            let (mut fast, mut plain) = (vec![0.0; len], vec![0.0; len]);
            assert!(surface.eval_fast(&uv, order, &mut fast));
            surface.eval_rows_plain(&uv, order, &mut plain);
            // roundings of coefficients near one, and of slopes over the shortest span of the seeds
            let tol = if order == 0 { 1e-12 } else { 1e-9 };
            for (k, (a, b)) in fast.iter().zip(&plain).enumerate() {
                assert!((a - b).abs() <= tol, "{k}: {a} is not {b}");
            }
        }
    }
}

#[test]
fn derivatives_are_limits_of_differences() {
    let surface = surface(2, 1);
    let (h, uv) = (1e-5, DVec2::new(0.37, 1.3));
    let row = |uv: DVec2| {
        let mut out = [0.0; 12];
        surface.eval_rows(&[uv], 2, &mut out);
        out
    };
    let exact = row(uv);
    for (axis, first, second) in [(DVec2::X, 1, 3), (DVec2::Y, 2, 5)] {
        let (before, after) = (row(uv - h * axis), row(uv + h * axis));
        for c in 0..2 {
            // second order in h, times derivatives that knots a hundredth apart make large
            let slope = (after[c] - before[c]) / (2.0 * h);
            assert!((slope - exact[2 * first + c]).abs() <= 1e-4, "{slope}");
            let slope = (after[2 * first + c] - before[2 * first + c]) / (2.0 * h);
            assert!((slope - exact[2 * second + c]).abs() <= 1e-2 * (1.0 + slope.abs()), "{slope}");
        }
    }
    let mixed = (row(uv + h * DVec2::Y)[2] - row(uv - h * DVec2::Y)[2]) / (2.0 * h);
    assert!((mixed - exact[8]).abs() <= 1e-3 * (1.0 + mixed.abs()), "{mixed}");
}

#[test]
fn blending_functions_sum_to_one() {
    let shape = surface(1, 3);
    let ones =
        shape.curves().iter().map(|curve| curve.with_control_points(vec![1.0; curve.knots().basis_count()]));
    let flat = TSplineSurface::new(shape.knots_v().clone(), ones.collect()).unwrap();
    for value in values(&flat, &places(&flat, 1000, 3)) {
        assert!((value - 1.0).abs() <= 64.0 * f64::EPSILON); // sixteen products
    }
}

#[test]
fn blending_functions_are_linearly_independent() {
    // by the dual functionals: from the surface alone every control point comes back
    let surface = surface(1, 4);
    let tensor = surface.to_tensor(usize::MAX).unwrap();
    let knots_v = surface.knots_v();
    for (j, curve) in surface.curves().iter().enumerate() {
        // the surface over the common knots restricted to line j is curve j refined: it has the curve's knots twice
        // differentiable elsewhere, so removing the others gives the curve's own control points back
        let count = knots_v.basis_count();
        let line: Vec<f64> = tensor.control_points().iter().skip(j).step_by(count).copied().collect();
        let mut refined = Curve::new(1, tensor.knots(crate::surface::tensor::Axis::U).clone(), line).unwrap();
        let mut index = 4;
        while index < refined.knots().basis_count() {
            let t = refined.knots().knots()[index];
            if refined.knots().multiplicity(t) > curve.knots().multiplicity(t) {
                let (without, error) = refined.remove_knot(index).unwrap();
                // insertions and removals amplify roundings where knots are near
                assert!(error <= 1e-8, "{error:e}");
                refined = without;
            } else {
                index += 1;
            }
        }
        assert_eq!(refined.knots(), curve.knots());
        for (a, b) in refined.control_points().iter().zip(curve.control_points()) {
            assert!((a - b).abs() <= 1e-7, "{a} is not {b}");
        }
    }
}

#[test]
fn insertion_and_conversion_keep_the_surface() {
    for seed in 0..5 {
        let mut surface = surface(3, seed);
        let original = surface.clone();
        let uv = places(&surface, 500, seed);
        surface.insert_knot_u(2, 0.61).unwrap();
        surface.insert_knot_u(2, 0.61).unwrap();
        assert_eq!(surface.coefficient_count(), original.coefficient_count() + 2);
        assert_same(&surface, &original, &uv);
        for v in [0.05, 1.0, 1.0, 1.0, 0.1, -0.5] {
            surface.insert_knot_v(v).unwrap();
            assert_same(&surface, &original, &uv);
        }
        let tensor = surface.to_tensor(usize::MAX).unwrap();
        assert_eq!(tensor.coefficient_count(), surface.tensor_coefficient_count().unwrap());
        assert_same(&tensor, &original, &uv);
        for strip in surface.to_strips().unwrap() {
            let domain = strip.domain();
            let inside: Vec<DVec2> = uv.iter().copied().filter(|&uv| domain.contains(uv)).collect();
            assert_same(&strip, &original, &inside);
        }
    }
}

#[test]
fn one_span_is_refined_as_worked_out_by_hand() {
    let knots_v = KnotVector::clamped(&[0.0, 1.0], 3).unwrap();
    let line = KnotVector::clamped(&[0.0, 1.0], 3).unwrap();
    let numbers = [1.0, -2.0, 4.0, 0.5];
    let curves = numbers.map(|x| Curve::new(1, line.clone(), vec![x; 4]).unwrap());
    let mut surface = TSplineSurface::new(knots_v, curves.to_vec()).unwrap();
    surface.insert_knot_v(0.5).unwrap();
    let found: Vec<f64> = surface.curves().iter().map(|curve| curve.control_points()[0]).collect();
    // Q_0, (Q_0 + Q_1)/2, (Q_1 + Q_2)/2, (Q_2 + Q_3)/2, Q_3
    assert_eq!(found, [1.0, -0.5, 1.0, 2.25, 0.5]);
}

#[test]
fn patches_are_the_surface() {
    let surface = surface(3, 7);
    let mut seen = vec![false; surface.patch_count()];
    for uv in places(&surface, 3000, 8) {
        let index = surface.patch_at(uv);
        seen[index] = true;
        let patch = surface.patch(index);
        assert!(patch.domain.contains(uv));
        let exact = values(&surface, &[uv]);
        for (a, b) in patch.eval(uv).iter().zip(exact) {
            assert!((a - b).abs() <= 1e-12, "{a} is not {b}");
        }
    }
    assert!(seen.iter().filter(|&&seen| seen).count() > seen.len() / 2);
    assert_eq!(surface.patch_at(DVec2::splat(-9.0)), 0);
    assert_eq!(surface.patch_at(DVec2::splat(9.0)), surface.patch_count() - 1);
}

#[test]
fn removal_keeps_to_its_tolerance() {
    let mut surface = surface(3, 9);
    let original = surface.clone();
    let uv = places(&surface, 2000, 9);
    let kept = surface.remove_knot_u(3, 5, 0.0).unwrap();
    assert!(!kept.is_removed && kept.error > 0.0);
    assert_eq!(surface, original);
    let gone = surface.remove_knot_u(3, 5, kept.error).unwrap();
    assert!(gone.is_removed);
    let (a, b) = (values(&surface, &uv), values(&original, &uv));
    for (a, b) in a.chunks(3).zip(b.chunks(3)) {
        let distance = (0..3).map(|c| (a[c] - b[c]).powi(2)).sum::<f64>().sqrt();
        assert!(distance <= kept.error + 1e-12, "{distance:e} above {:e}", kept.error);
    }
    surface.insert_knot_u(3, 0.77).unwrap();
    let before = surface.clone();
    let index = surface.curves()[3].knots().knots().iter().position(|&t| t == 0.77).unwrap();
    assert!(surface.remove_knot_u(3, index, 1e-12).unwrap().is_removed, "what was inserted can go again");
    assert_same(&surface, &before, &uv);
}

#[test]
fn refusals_name_the_curve_or_the_knot() {
    let surface = surface(3, 1);
    let mut changed = surface.clone();
    let count = surface.curves().len();
    assert_eq!(changed.insert_knot_u(99, 0.5).unwrap_err(), TSplineError::NoSuchCurve { index: 99, count });
    assert_eq!(
        changed.insert_knot_v(2.5).unwrap_err(),
        TSplineError::Knots(KnotError::Outside { at: 2.5, from: -1.0, to: 2.5 })
    );
    assert!(matches!(
        changed.remove_knot_u(0, 2, 1.0),
        Err(TSplineError::Knots(KnotError::NotRemovable { index: 2 }))
    ));
    let needed = surface.tensor_coefficient_count().unwrap();
    let refused = surface.to_tensor(needed - 1).unwrap_err();
    assert_eq!(refused, ConvertError::TooLarge { needed, limit: needed - 1 });
    assert_eq!(changed, surface);

    let new = |curves: Vec<Curve>| TSplineSurface::new(surface.knots_v().clone(), curves).unwrap_err();
    let mut curves = surface.curves().to_vec();
    let last = curves.pop().unwrap();
    assert_eq!(new(curves.clone()), TSplineError::CurveCount { count: count - 1, expected: count });
    curves.push(
        Curve::new(2, last.knots().clone(), last.control_points()[..2 * last.knots().basis_count()].to_vec())
            .unwrap(),
    );
    assert_eq!(new(curves.clone()), TSplineError::Mismatch { index: count - 1 });
    curves.pop();
    curves.push(Curve::new(3, KnotVector::clamped(&[0.0, 1.0], 2).unwrap(), vec![0.0; 9]).unwrap());
    assert_eq!(new(curves), TSplineError::Degree { degree: 2 });
}
