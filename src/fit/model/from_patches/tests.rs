use super::*;
use crate::knots::KnotVector;
use crate::layout::CUBE_FACES;
use crate::surface::Trims;
use std::f64::consts::FRAC_PI_4;

/// A bicubic that interpolates a map of the unit square on a grid of `n` by `n` cells: cubic Hermite in each, with
/// derivatives by differences.
fn patch(n: usize, map: impl Fn(DVec2) -> DVec3) -> TensorSurface {
    let step = 1e-5;
    let slope = |uv: DVec2, along: DVec2| (map(uv + step * along) - map(uv - step * along)) / (2.0 * step);
    let twist = |uv: DVec2| {
        (slope(uv + step * DVec2::X, DVec2::Y) - slope(uv - step * DVec2::X, DVec2::Y)) / (2.0 * step)
    };
    let third = 1.0 / (3.0 * n as f64);
    let axis: Vec<(usize, f64)> = (0..=n)
        .flat_map(|k| {
            let both = [(k, -third), (k, third)];
            if k == 0 {
                vec![(0, 0.0), both[1]]
            } else if k == n {
                vec![both[0], (n, 0.0)]
            } else {
                both.to_vec()
            }
        })
        .collect();
    let mut points = Vec::new();
    for &(i, along_u) in &axis {
        for &(j, along_v) in &axis {
            let uv = DVec2::new(i as f64, j as f64) / n as f64;
            let (du, dv) = (slope(uv, DVec2::X), slope(uv, DVec2::Y));
            points.extend((map(uv) + along_u * du + along_v * dv + along_u * along_v * twist(uv)).to_array());
        }
    }
    let inner = (1..n).flat_map(|k| [k as f64 / n as f64; 2]);
    let knots: Vec<f64> = [0.0; 4].into_iter().chain(inner).chain([1.0; 4]).collect();
    let knots = || KnotVector::new(knots.clone(), 3).unwrap();
    TensorSurface::new(3, knots(), knots(), points, None).unwrap()
}

/// Six patches near the unit sphere, each moved a little on its own.
fn ball(off: f64) -> Vec<TensorSurface> {
    let face = |(k, face): (usize, crate::layout::CubeFace)| {
        patch(4, move |uv| {
            let on_cube = face.point(uv);
            let at = DVec3::from_array((on_cube * FRAC_PI_4).to_array().map(f64::tan)).normalize();
            at + off * DVec3::new((k as f64).sin(), (2.0 * k as f64).sin(), (3.0 * k as f64).cos())
        })
    };
    CUBE_FACES.into_iter().enumerate().map(face).collect()
}

fn smooth(
    patches: &[TensorSurface],
    options: &FromPatchesOptions,
) -> Result<(Model, FromPatchesReport), FromPatchesError> {
    let patches: Vec<&TensorSurface> = patches.iter().collect();
    smooth_from_patches(&patches, options, &mut Control::new(2))
}

#[test]
fn six_loose_patches_become_a_smooth_ball() {
    let off = 1e-4;
    let (model, report) = smooth(&ball(off), &FromPatchesOptions::default()).unwrap();
    assert!(report.given_gap > 0.1 * off && report.given_normal_jump > 1e-8, "{report:?}");
    assert!(report.max_deviation <= report.tolerance, "{report:?}");
    assert!(report.gap <= 1e-14 && report.normal_jump <= 1e-12, "{report:?}");
    assert_eq!((report.joined_count, report.free_count, report.piece_count), (12, 0, 1));
    assert_eq!((model.free_edge_count(), model.euler_characteristic()), (0, 2));
    let exact = 4.0 / 3.0 * std::f64::consts::PI;
    // a shell as thick as what the patches are off
    assert!((report.volume - exact).abs() <= 4.0 * std::f64::consts::PI * (report.max_deviation + 2.0 * off));
}

#[test]
fn patches_are_turned_until_all_look_outwards() {
    let mut patches = ball(0.0);
    for k in [1, 4] {
        // exchange u and v
        let (points, n) = (patches[k].control_points().to_vec(), 10);
        let turned = (0..n * n).flat_map(|at| points[3 * ((at % n) * n + at / n)..][..3].to_vec()).collect();
        let knots = patches[k].knots(crate::geometry::Axis::U).clone();
        patches[k] = TensorSurface::new(3, knots.clone(), knots, turned, None).unwrap();
    }
    let (_, report) = smooth(&patches, &FromPatchesOptions::default()).unwrap();
    assert!(report.volume > 0.0 && report.normal_jump <= 1e-12, "{report:?}");
}

#[test]
fn open_patches_and_several_pieces_become_open_shells() {
    let wave = |uv: DVec2| DVec3::new(uv.x, uv.y, 0.1 * (3.0 * uv.x).sin() * (2.0 * uv.y).cos());
    let strip = |k: usize, up: f64| patch(3, move |uv| wave(uv + DVec2::X * k as f64) + up * DVec3::Z);
    let patches = [strip(0, 0.0), strip(1, 0.0), strip(2, 0.0), strip(0, 5.0)];
    let (model, report) = smooth(&patches, &FromPatchesOptions::default()).unwrap();
    assert_eq!((report.piece_count, report.joined_count, report.free_count), (2, 2, 12));
    assert_eq!(model.shells().len(), 2);
    assert!(report.max_deviation <= report.tolerance && report.normal_jump <= 1e-12, "{report:?}");
}

#[test]
fn a_fold_is_smoothed_and_the_deviation_says_how_much() {
    let left = patch(1, |uv| DVec3::new(uv.x, uv.y, 0.2 * uv.x));
    let right = patch(1, |uv| DVec3::new(uv.x + 1.0, uv.y, 0.2 * (1.0 - uv.x)));
    let (_, report) = smooth(&[left, right], &FromPatchesOptions::default()).unwrap();
    assert!(report.given_normal_jump > 0.3 && report.normal_jump <= 1e-12, "{report:?}");
    assert!(report.max_deviation > 0.0 && report.max_deviation < 0.05, "{report:?}");
}

#[test]
fn what_does_not_meet_edge_to_edge_is_named() {
    let flat = |min: DVec2, max: DVec2| patch(1, move |uv| (min + uv * (max - min)).extend(0.0));
    let options = FromPatchesOptions::default();
    let refuse = |patches: &[TensorSurface]| smooth(patches, &options).unwrap_err();
    assert_eq!(refuse(&[]), FromPatchesError::Empty);
    let whole = flat(DVec2::ZERO, DVec2::ONE);
    let [low, high] = [0.0, 0.5].map(|y| flat(DVec2::new(1.0, y), DVec2::new(2.0, y + 0.5)));
    let refused = refuse(&[whole.clone(), low, high]);
    assert!(matches!(refused, FromPatchesError::CornerOnSide { patch: 0, side: 1, .. }), "{refused}");
    assert_eq!((refused.kind(), refused.index()), (ErrorKind::Topology, Some(0)));
    let point = patch(1, |uv| DVec3::new(uv.x * uv.y, uv.y, 0.0));
    assert_eq!(refuse(&[whole.clone(), point]), FromPatchesError::ShortSide { patch: 1, side: 0 });
    let up = patch(1, |uv| DVec3::new(1.0, uv.y, uv.x));
    let beside = flat(DVec2::X, DVec2::new(2.0, 1.0));
    let third = refuse(&[whole.clone(), beside, up]);
    assert!(matches!(third, FromPatchesError::ThirdSide { patch: 2, .. }), "{third}");
    let mut trimmed = whole.clone();
    let domain = trimmed.domain();
    let triangle = vec![DVec2::splat(0.1), DVec2::new(0.9, 0.1), DVec2::splat(0.9)];
    trimmed.region_mut().trims = Trims::new(vec![triangle], &domain).unwrap();
    assert_eq!(refuse(&[whole.clone(), trimmed]), FromPatchesError::Trimmed { patch: 1 });
    let field = TensorSurface::new(
        1,
        KnotVector::clamped(&[0.0, 1.0], 1).unwrap(),
        KnotVector::clamped(&[0.0, 1.0], 1).unwrap(),
        vec![0.0; 4],
        None,
    )
    .unwrap();
    assert_eq!(refuse(&[field]), FromPatchesError::Dimension { patch: 0, dim: 1 });
    let rounds = options.with_max_rounds(0);
    assert_eq!(smooth(&[whole], &rounds).unwrap_err().kind(), ErrorKind::InvalidArgument);
}

#[test]
fn a_one_sided_band_is_refused() {
    // three patches around, turned over by half a turn
    let band = |at: f64, across: f64| {
        let (around, half) = (std::f64::consts::TAU * at, std::f64::consts::PI * at);
        let radius = 1.0 + 0.4 * (across - 0.5) * half.cos();
        DVec3::new(radius * around.cos(), radius * around.sin(), 0.4 * (across - 0.5) * half.sin())
    };
    let patches: Vec<TensorSurface> =
        (0..3).map(|k| patch(6, move |uv| band((f64::from(k) + uv.x) / 3.0, uv.y))).collect();
    let options = FromPatchesOptions::default();
    let refused = smooth(&patches, &options).unwrap_err();
    assert!(matches!(refused, FromPatchesError::OneSided { .. }), "{refused}");
}
