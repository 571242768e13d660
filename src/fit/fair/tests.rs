use super::*;
use crate::control::Pool;
use crate::failure::{Classify, ErrorKind};
use crate::fit::common::report::ToleranceScale;
use crate::fit::{pht, tensor};
use crate::knots::KnotVector;
use crate::query::project::{ProjectOptions, Projector};
use crate::samples::Random;
use crate::surface::tensor::TensorSurface;
use crate::surface::{Surface, normal};
use glam::DVec3;

/// A smooth sheet.
fn sheet(uv: DVec2) -> DVec3 {
    DVec3::new(2.0 * uv.x, uv.y, 0.2 * (3.0 * uv.x).sin() * (2.0 * uv.y + 0.4).cos())
}

fn sheet_normal(uv: DVec2) -> DVec3 {
    let h = 1e-5;
    let along = |step: DVec2| (sheet(uv + step) - sheet(uv - step)) / (2.0 * h);
    along(DVec2::new(h, 0.0)).cross(along(DVec2::new(0.0, h))).normalize()
}

/// The sheet sampled with errors of a given size.
fn noisy(count: usize, noise: f64) -> (Vec<DVec2>, Vec<f64>) {
    let mut random = Random::new(12);
    let uv: Vec<DVec2> = (0..count).map(|_| DVec2::new(random.unit(), random.unit())).collect();
    let mut error = || noise * (random.signed() + random.signed() + random.signed());
    let values = uv.iter().flat_map(|&uv| (sheet(uv) + DVec3::new(error(), error(), error())).to_array());
    let values = values.collect();
    (uv, values)
}

fn absolute(value: f64) -> Tolerance {
    Tolerance { value, scale: ToleranceScale::Absolute }
}

/// Root mean square of the angles between the normals of a surface and those of the sheet.
fn normal_deviation(surface: &dyn Surface) -> f64 {
    let mut sum = 0.0;
    for i in 0..60 {
        for j in 0..60 {
            let uv = DVec2::new((f64::from(i) + 0.5) / 60.0, (f64::from(j) + 0.5) / 60.0);
            let mut rows = [0.0; 9];
            surface.eval_rows(&[uv], 1, &mut rows);
            let [_, su, sv] = [0, 3, 6].map(|k| DVec3::from_slice(&rows[k..]));
            sum += normal(su, sv).angle_between(sheet_normal(uv)).powi(2);
        }
    }
    (sum / 3600.0).sqrt()
}

/// Fits of noisy data that follow the noise.
fn fits(uv: &[DVec2], values: &[f64], tolerance: f64) -> [AnySurface; 2] {
    let mut control = Control::new(1);
    let options = tensor::TensorOptions {
        tolerance: absolute(tolerance),
        fixed_grid: Some([24, 24]),
        ends: tensor::Ends::Free,
        smoothing: 1e-9,
        buffer: 0.0,
        ..tensor::TensorOptions::default()
    };
    let tensor = tensor::fit_points(uv, values, 3, &options, &mut control).unwrap().surface;
    let options = pht::PhtOptions {
        tolerance: absolute(tolerance),
        smoothing: 1e-7,
        initial_grid: [16, 16],
        ..pht::PhtOptions::default()
    };
    let pht = pht::fit_points(uv, values, 3, &options, &mut control).unwrap().surface;
    [tensor.into(), pht.into()]
}

#[test]
fn noise_is_smoothed_within_the_tolerance_of_the_data() {
    let tolerance = 6e-3;
    let (uv, values) = noisy(4000, 1e-3);
    let data = FairData { uv: &uv, values: &values };
    for surface in fits(&uv, &values, tolerance) {
        let options = FairOptions::default().with_tolerance(absolute(tolerance));
        let faired = fair(&surface, Some(data), &options, &mut Control::new(1)).unwrap();
        let report = faired.report;
        assert!(report.energy_after < 0.5 * report.energy_before, "{report:?}");
        assert!(report.max_deviation <= tolerance && report.rms_deviation <= report.max_deviation);
        let mut rows = vec![0.0; values.len()];
        faired.surface.as_surface().eval_rows(&uv, 0, &mut rows);
        let miss = |(a, b): (&[f64], &[f64])| DVec3::from_slice(a).distance(DVec3::from_slice(b));
        let largest = rows.chunks(3).zip(values.chunks(3)).map(miss).fold(0.0, f64::max);
        assert!((largest - report.max_deviation).abs() <= 1e-12, "{largest} {report:?}");
        let (before, after) =
            (normal_deviation(surface.as_surface()), normal_deviation(faired.surface.as_surface()));
        println!("normals {before:.3e} -> {after:.3e}, {report:?}");
        assert!(after < 0.5 * before, "{before} {after} {report:?}");
    }
}

#[test]
fn parameters_that_are_feet_on_the_surface_do_not_speak_for_its_noise() {
    let tolerance = 6e-3;
    let (uv, values) = noisy(4000, 1e-3);
    for surface in fits(&uv, &values, tolerance) {
        let projector = Projector::new(surface.as_surface()).unwrap();
        let feet = projector.project(&values, &ProjectOptions::default(), &Pool::new(1)).unwrap().uv;
        let options = FairOptions::default().with_tolerance(absolute(tolerance));
        let data = FairData { uv: &feet, values: &values };
        let faired = fair(&surface, Some(data), &options, &mut Control::new(1)).unwrap();
        let (before, after) =
            (normal_deviation(surface.as_surface()), normal_deviation(faired.surface.as_surface()));
        assert!(after < 0.5 * before, "{before} {after} {:?}", faired.report);
    }
}

#[test]
fn no_place_moves_by_more_than_the_bound() {
    let (uv, values) = noisy(3000, 1e-3);
    let mut random = Random::new(3);
    for surface in fits(&uv, &values, 1e-2) {
        let mut last = f64::INFINITY;
        for tolerance in [1e-4, 1e-3, 1e-2] {
            let options = FairOptions::default().with_tolerance(absolute(tolerance));
            let Faired { surface: faired, report } =
                fair(&surface, None, &options, &mut Control::new(1)).unwrap();
            assert!(report.max_deviation <= tolerance, "{report:?}");
            assert!(report.energy_after < report.energy_before.min(last), "{report:?}");
            last = report.energy_after;
            let places: Vec<DVec2> = (0..2000).map(|_| DVec2::new(random.unit(), random.unit())).collect();
            let (mut a, mut b) = (vec![0.0; 6000], vec![0.0; 6000]);
            surface.as_surface().eval_rows(&places, 0, &mut a);
            faired.as_surface().eval_rows(&places, 0, &mut b);
            let moved = |(a, b): (&[f64], &[f64])| DVec3::from_slice(a).distance(DVec3::from_slice(b));
            let largest = a.chunks(3).zip(b.chunks(3)).map(moved).fold(0.0, f64::max);
            assert!(largest <= report.max_movement * (1.0 + 1e-9), "{largest} {report:?}");
        }
    }
}

#[test]
fn what_has_no_energy_stays_as_it_is() {
    let mut control = Control::new(1);
    let knots = KnotVector::clamped(&[0.0, 0.3, 1.0], 3).unwrap();
    let places = (0..5).flat_map(|i| (0..5).map(move |j| (i, j)));
    let plane = places
        .clone()
        .flat_map(|(i, j)| [knots_place(&[0.0, 0.3, 1.0], i), knots_place(&[0.0, 0.3, 1.0], j), 0.0]);
    let plane = TensorSurface::new(3, knots.clone(), knots.clone(), plane.collect(), None).unwrap();
    for energy in [Fairness::ThinPlate, Fairness::CurvatureVariation] {
        let options = FairOptions::default().with_energy(energy);
        let faired = fair(&plane.clone().into(), None, &options, &mut control).unwrap();
        // rounding of the energy of a plane of size one
        assert!(faired.report.energy_after <= 1e-24, "{:?}", faired.report);
        assert!(faired.report.max_movement <= 1e-10, "{:?}", faired.report);
    }
    // a paraboloid bends, but evenly
    let parabola = |i: usize| {
        let t = knots.knots();
        (t[i + 1] * t[i + 2] + t[i + 2] * t[i + 3] + t[i + 3] * t[i + 1]) / 3.0
    };
    let bowl = places.flat_map(|(i, j)| {
        [knots_place(&[0.0, 0.3, 1.0], i), knots_place(&[0.0, 0.3, 1.0], j), parabola(i) + parabola(j)]
    });
    let bowl = TensorSurface::new(3, knots.clone(), knots.clone(), bowl.collect(), None).unwrap();
    let even = fair(
        &bowl.clone().into(),
        None,
        &FairOptions::default().with_energy(Fairness::CurvatureVariation),
        &mut control,
    );
    assert!(even.unwrap().report.max_movement <= 1e-10);
    let flat = fair(&bowl.into(), None, &FairOptions::default(), &mut control).unwrap();
    assert!(flat.report.max_movement > 1e-4, "{:?}", flat.report);
}

/// The Greville abscissa of a clamped cubic.
fn knots_place(breaks: &[f64], i: usize) -> f64 {
    let knots = KnotVector::clamped(breaks, 3).unwrap();
    knots.greville(i)
}

#[test]
fn a_kept_border_does_not_move() {
    let (uv, values) = noisy(3000, 1e-3);
    for surface in fits(&uv, &values, 1e-2) {
        let Domain { min, max } = surface.as_surface().domain();
        let at = |k: i32| DVec2::new(min.x + (max.x - min.x) * f64::from(k) / 100.0, max.y);
        let side: Vec<DVec2> = (0..=100).map(at).collect();
        let rows = |surface: &AnySurface| {
            let mut rows = vec![0.0; 9 * side.len()];
            surface.as_surface().eval_rows(&side, 1, &mut rows);
            rows
        };
        let before = rows(&surface);
        for (border, count) in [(KeptBorder::Position, 3), (KeptBorder::Tangent, 9)] {
            let options = FairOptions::default().with_tolerance(absolute(5e-3)).with_border(border);
            let faired = fair(&surface, None, &options, &mut Control::new(1)).unwrap();
            assert!(faired.report.energy_after < faired.report.energy_before);
            let after = rows(&faired.surface);
            for (a, b) in before.chunks(9).zip(after.chunks(9)) {
                for k in 0..count {
                    // what is kept is not computed anew, but evaluated beside numbers that changed: slopes up to 100
                    assert!((a[k] - b[k]).abs() <= 1e-12, "{border:?} {k}: {a:?} {b:?}");
                }
            }
        }
    }
}

#[test]
fn what_cannot_be_faired_is_refused() {
    let mut control = Control::new(1);
    let (uv, values) = noisy(2000, 1e-3);
    let [tensor, pht] = fits(&uv, &values, 1e-2);
    let mut refuse = |surface: &AnySurface, data: Option<FairData>, options: &FairOptions| {
        let error = fair(surface, data, options, &mut control).unwrap_err();
        (error.kind(), error.index(), error.to_string())
    };
    let plain = FairOptions::default();
    let variation = plain.with_energy(Fairness::CurvatureVariation);
    let (kind, _, text) = refuse(&pht, None, &variation);
    assert!(kind == ErrorKind::InvalidArgument && text.contains("curvature jumps"), "{text}");
    let (kind, _, _) = refuse(&tensor, None, &plain.with_tolerance(absolute(0.0)));
    assert_eq!(kind, ErrorKind::InvalidArgument);
    let mut far = values.clone();
    far[3 * 77] += 0.5;
    let (kind, index, text) = refuse(&tensor, Some(FairData { uv: &uv, values: &far }), &plain);
    assert_eq!((kind, index), (ErrorKind::InvalidArgument, Some(77)), "{text}");
    assert!(text.contains("more than the tolerance"), "{text}");
    let mut outside = uv.clone();
    outside[5].x = 1.5;
    let (kind, index, _) = refuse(&tensor, Some(FairData { uv: &outside, values: &values }), &plain);
    assert_eq!((kind, index), (ErrorKind::Outside, Some(5)));
    let AnySurface::Tensor(polynomial) = &tensor else { panic!("a tensor surface") };
    let [u, v] = [Axis::U, Axis::V].map(|axis| polynomial.knots(axis).clone());
    let weights = vec![1.0; polynomial.coefficient_count()];
    let rational = TensorSurface::new(3, u, v, polynomial.control_points().to_vec(), Some(weights)).unwrap();
    let (kind, _, text) = refuse(&rational.into(), None, &plain);
    assert!(kind == ErrorKind::WrongKind && text.contains("weights"), "{text}");
}
