use super::*;
use crate::fit::report::{Tolerance, ToleranceScale};
use crate::samples::Random;
use crate::samples::rows::{RowSet, dustpan, head, screwdriver, wave};

impl RowSet {
    fn as_rows(&self) -> Rows<'_> {
        Rows { points: &self.points, counts: &self.counts, dim: 3 }
    }
}

/// The settings of the paper.
fn paper(tolerance: f64) -> SkinOptions<'static> {
    SkinOptions {
        tolerance: Tolerance { value: tolerance, scale: ToleranceScale::Relative },
        ends: SectionEnds::Parabolic,
        extra_checks: 0,
        ..SkinOptions::default()
    }
}

#[track_caller]
fn fit(set: &RowSet, options: &SkinOptions) -> SkinFit {
    skin(&set.as_rows(), options, &mut Control::new(2)).unwrap()
}

#[test]
fn the_four_sets_need_as_few_control_points_as_the_theory_says() {
    // name, set, tolerance, total at most, baseline at most
    for (name, set, tolerance, total, baseline) in [
        ("dustpan", dustpan(), 1e-5, 511, 988),
        ("wave", wave(), 5e-4, 663, 1015),
        ("screwdriver", screwdriver(), 1e-4, 544, 924),
        ("head", head(), 5e-4, 3410, 7854),
    ] {
        let options = SkinOptions { compare: true, ..paper(tolerance) };
        let fit = fit(&set, &options);
        let (found, common) = (fit.report.coefficient_count, fit.skin.common_count);
        assert!(fit.report.max_error < fit.report.tolerance, "{name}: {:?}", fit.report);
        assert!(100 * found <= 101 * total, "{name}: {found} control points");
        assert!(100 * common <= 102 * baseline, "{name}: {common} with common knots");
        assert!(4 * found < 3 * common, "{name}");
    }
}

#[test]
fn every_datum_keeps_the_tolerance() {
    let mut random = Random::new(11);
    for case in 0..300 {
        let mut set = RowSet::default();
        let row_count = 2 + (8.0 * random.unit()) as usize;
        let mut y = 0.0;
        for _ in 0..row_count {
            y += 0.05 + random.unit().powi(4);
            let count = 3 + (37.0 * random.unit()) as usize;
            let (waves, height) = (6.0 * random.unit(), random.unit());
            let mut x = 0.0;
            for _ in 0..count {
                x += 0.01 + random.unit().powi(3);
                let noise = 0.02 * random.signed();
                set.points.extend([x, y + 0.1 * random.signed(), height * (waves * x).sin() + noise]);
            }
            set.counts.push(count);
        }
        let options = SkinOptions {
            extra_checks: case % 3,
            batch: case % 2 == 1,
            removal: case % 5 == 0,
            approximate_v: case % 7 == 0,
            ends: [SectionEnds::Parabolic, SectionEnds::Natural][case % 2],
            ..paper(10.0_f64.powf(-6.0 + 4.0 * random.unit()))
        };
        let fit = fit(&set, &options);
        // the sums along v round a few times more than the curves were checked with
        let rounding = 1e3 * f64::EPSILON * fit.report.diagonal * fit.skin.overshoot;
        assert!(fit.report.max_error < fit.report.tolerance + rounding, "case {case}: {:?}", fit.report);
    }
}

#[test]
fn straight_rows_need_four_control_points_a_curve() {
    let mut set = RowSet::default();
    for (j, count) in [2, 40, 3, 17, 9].into_iter().enumerate() {
        let place = |k: usize| (k as f64 / (count - 1) as f64).powi(2);
        set.points.extend((0..count).flat_map(|k| [place(k), j as f64, 0.5 * place(k)]));
        set.counts.push(count);
    }
    for extra_checks in [0, 3] {
        let fit = fit(&set, &SkinOptions { extra_checks, ..paper(1e-10) });
        assert_eq!((fit.skin.least_count, fit.skin.largest_count), (4, 4));
        assert!(fit.report.max_error < 1e-14, "{:?}", fit.report);
    }
}

/// The skin through the sections at a place, by its definition.
fn exact_skin(set: &RowSet, options: &SkinOptions, uv: &[DVec2]) -> Vec<f64> {
    let data = Data::of_rows(&set.as_rows(), options).unwrap();
    let steps = Steps::new(&data, options).unwrap();
    let loft =
        Loft::interpolating(steps.parameters(set.counts.len()), data.has_tangents, steps.length()).unwrap();
    let mut values = Vec::new();
    for uv in uv {
        let span = loft.knots_v.span(uv.y);
        let basis = crate::basis::basis_functions(&loft.knots_v, span, uv.y);
        let mut value = [0.0; 3];
        for r in 0..4 {
            let curve = data.sources.combine(&[&loft.weights[span - 3 + r]], &[uv.x]).swap_remove(0);
            (0..3).for_each(|c| value[c] += basis[r] * curve[c]);
        }
        values.extend(value);
    }
    values
}

fn distances(a: &[f64], b: &[f64]) -> f64 {
    let length = |a: &[f64], b: &[f64]| a.iter().zip(b).fold(0.0, |length: f64, (a, b)| length.hypot(a - b));
    a.chunks(3).zip(b.chunks(3)).map(|(a, b)| length(a, b)).fold(0.0, f64::max)
}

#[test]
fn the_certified_distance_bounds_the_true_one() {
    for (name, set, tolerance) in [
        ("dustpan", dustpan(), 1e-5),
        ("wave", wave(), 5e-4),
        ("screwdriver", screwdriver(), 1e-4),
        ("head", head(), 5e-4),
    ] {
        for extra_checks in [0, 3] {
            let options = SkinOptions { certify: true, extra_checks, ..paper(tolerance) };
            let fit = fit(&set, &options);
            let mut random = Random::new(2);
            let mut uv: Vec<DVec2> = (0..4000).map(|_| DVec2::new(random.unit(), random.unit())).collect();
            // the largest distances lie on rows more often than between them
            uv.extend(
                fit.parameters
                    .windows(2)
                    .step_by(1 + fit.parameters.len() / 4000)
                    .filter(|pair| pair[0].y == pair[1].y)
                    .map(|pair| pair[0].midpoint(pair[1])),
            );
            let mut found = vec![0.0; 3 * uv.len()];
            fit.surface.eval_rows(&uv, 0, &mut found);
            let measured = distances(&found, &exact_skin(&set, &options, &uv));
            let bound = fit.skin.certified_distance;
            assert!(measured <= bound * (1.0 + 1e-9), "{name}: {measured:e} above {bound:e}");
            assert!(bound < 10.0 * measured, "{name}: bound {bound:e}, measured {measured:e}");
        }
    }
}

#[test]
fn checks_between_the_data_keep_the_tolerance_there() {
    let (set, uv) = (dustpan(), {
        let mut random = Random::new(5);
        (0..20_000).map(|_| DVec2::new(random.unit(), random.unit())).collect::<Vec<_>>()
    });
    let deviation = |extra_checks| {
        let options = SkinOptions { extra_checks, ..paper(1e-5) };
        let fit = fit(&set, &options);
        let mut found = vec![0.0; 3 * uv.len()];
        fit.surface.eval_rows(&uv, 0, &mut found);
        distances(&found, &exact_skin(&set, &options, &uv)) / fit.report.tolerance
    };
    // the theory measured 10.3 and 1.05
    let (without, with) = (deviation(0), deviation(3));
    assert!(without > 5.0 && with < 1.5, "{without} and {with}");
}

/// The rows of the screwdriver without the repeated points.
fn closed_rows() -> RowSet {
    let set = screwdriver();
    let mut closed = RowSet::default();
    for j in 0..set.counts.len() {
        let row = set.row(j);
        closed.points.extend_from_slice(&row[..row.len() - 3]);
        closed.counts.push(set.counts[j] - 1);
    }
    closed
}

#[test]
fn closed_rows_have_no_seam() {
    let options = SkinOptions { closed: true, ends: SectionEnds::Auto, ..paper(1e-4) };
    let fit = fit(&closed_rows(), &options);
    assert!(fit.report.max_error < fit.report.tolerance);
    for k in 0..=50 {
        let v = f64::from(k) / 50.0;
        let mut rows = [0.0; 36];
        fit.surface.eval_rows(&[DVec2::new(0.0, v), DVec2::new(1.0, v)], 2, &mut rows);
        for (c, (a, b)) in rows[..18].iter().zip(&rows[18..]).enumerate() {
            // first and second derivatives over spans of a hundredth
            let scale = [1.0, 1e2, 1.0, 1e4, 1e2, 1e1][c / 3];
            assert!((a - b).abs() <= 1e-11 * scale, "v {v}, row {}: {a} is not {b}", c / 3);
        }
    }
}

#[test]
fn a_surface_closed_along_v_has_no_seam_either() {
    let options = SkinOptions { closed: true, closed_v: true, ends: SectionEnds::Auto, ..paper(1e-4) };
    let fit = fit(&torus(), &options);
    assert!(fit.report.max_error < fit.report.tolerance);
    assert_eq!(fit.surface.curves().len(), 15);
    assert_eq!(fit.surface.curves()[..3], fit.surface.curves()[12..]);
    for k in 0..=50 {
        let u = f64::from(k) / 50.0;
        let mut rows = [0.0; 36];
        fit.surface.eval_rows(&[DVec2::new(u, 0.0), DVec2::new(u, 1.0)], 2, &mut rows);
        for (c, (a, b)) in rows[..18].iter().zip(&rows[18..]).enumerate() {
            let scale = [1.0, 1e2, 1e2, 1e4, 1e4, 1e4][c / 3];
            assert!((a - b).abs() <= 1e-11 * scale, "u {u}, row {}: {a} is not {b}", c / 3);
        }
    }
}

/// Rings of a torus with unlike counts; each ends before it comes to its first point again.
fn torus() -> RowSet {
    let mut set = RowSet::default();
    for j in 0..12 {
        let around = std::f64::consts::TAU * f64::from(j) / 12.0;
        let count = 30 + 7 * (j as usize % 5);
        set.points.extend((0..count).flat_map(|k| {
            let angle = std::f64::consts::TAU * k as f64 / count as f64;
            let radius = 3.0 + angle.cos();
            [radius * around.cos(), radius * around.sin(), angle.sin()]
        }));
        set.counts.push(count);
    }
    set
}

/// The largest jump of value and two derivatives between two sides of the unit square, as a share of what rounding
/// explains, and the largest second derivative across there in the same measure.
fn seam_jump(surface: &TSplineSurface, axis: usize) -> (f64, f64) {
    let shortest = |breaks: &[f64]| breaks.windows(2).map(|pair| pair[1] - pair[0]).fold(1.0, f64::min);
    let of_curves = surface.curves().iter().map(|curve| shortest(&curve.knots().breaks()));
    let spans = [of_curves.fold(1.0, f64::min), shortest(&surface.knots_v().breaks())];
    let numbers = surface.curves().iter().flat_map(|curve| curve.control_points());
    let largest = numbers.fold(0.0, |most: f64, x| most.max(x.abs()));
    // basis functions have derivatives of at most 6 / h and 36 / h^2 over spans h, of sixteen terms; knots that come
    // again a period later are rounded in proportion to 1 / h
    let rounding = 16.0 * f64::EPSILON * largest / spans[0].min(spans[1]);
    let scale = |[i, j]: [i32; 2]| rounding * (6.0 / spans[0]).powi(i) * (6.0 / spans[1]).powi(j);
    let orders = [[0, 0], [1, 0], [0, 1], [2, 0], [1, 1], [0, 2]];
    let (mut jump, mut bend) = (0.0_f64, 0.0_f64);
    for k in 0..=100 {
        let ends = [0.0, 1.0].map(|end| {
            let mut uv = DVec2::splat(f64::from(k) / 100.0);
            uv[axis] = end;
            uv
        });
        let mut rows = [0.0; 36];
        surface.eval_rows(&ends, 2, &mut rows);
        for (c, (a, b)) in rows[..18].iter().zip(&rows[18..]).enumerate() {
            jump = jump.max((a - b).abs() / scale(orders[c / 3]));
            if orders[c / 3][axis] == 2 {
                bend = bend.max(a.abs() / scale(orders[c / 3]));
            }
        }
    }
    (jump, bend)
}

#[test]
fn skins_of_data_that_close_have_two_derivatives_across_both_seams() {
    let set = torus();
    // the same rings as closed cubics, each over its own knots
    let ring = |j: usize| {
        let count = set.counts[j];
        let u: Vec<f64> = (0..=count).map(|k| k as f64 / count as f64).collect();
        let row = set.row(j);
        let points = [row, &row[..3]].concat();
        crate::curve::interpolate(3, &u, &points, crate::curve::EndRule::Periodic).unwrap()
    };
    let rings: Vec<Curve> = (0..set.counts.len()).map(ring).collect();
    for method in [SkinMethod::ControlCurves, SkinMethod::CommonKnots] {
        for removal in [false, true] {
            let closed = SkinOptions { closed: true, closed_v: true, ends: SectionEnds::Auto, ..paper(1e-4) };
            let options = SkinOptions { method, removal, ..closed };
            let of_curves = skin_curves(&rings, &options, &mut Control::new(1)).unwrap();
            for (what, fit) in [("rows", fit(&set, &options)), ("curves", of_curves)] {
                assert!(fit.report.max_error < fit.report.tolerance);
                for axis in [0, 1] {
                    let (jump, bend) = seam_jump(&fit.surface, axis);
                    assert!(jump <= 1.0, "{what}, {method:?}, {removal}, axis {axis}: {jump}");
                    assert!(bend > 1e3, "a jump of a thousandth of {bend} would not be seen");
                }
            }
        }
    }
}

#[test]
fn rows_turned_round_and_shifted_are_put_right() {
    let ordered = closed_rows();
    let mut random = Random::new(7);
    let mut mixed = RowSet::default();
    for (j, &count) in ordered.counts.iter().enumerate() {
        let mut points: Vec<[f64; 3]> = ordered.row(j).as_chunks().0.to_vec();
        if j > 0 {
            points.rotate_left((count as f64 * random.unit()) as usize);
            if random.unit() < 0.5 {
                points.reverse();
            }
        }
        mixed.points.extend(points.into_iter().flatten());
        mixed.counts.push(count);
    }
    let options = SkinOptions { closed: true, ends: SectionEnds::Auto, align: true, ..paper(1e-4) };
    let (as_ordered, aligned) = (fit(&ordered, &options), fit(&mixed, &options));
    assert_eq!(as_ordered.skin.aligned_row_count, 0);
    assert!(aligned.skin.aligned_row_count >= 10);
    assert_eq!(aligned.report.remarks.0 & Remarks::TWISTED_ROWS.0, 0);
    let mut uv: Vec<DVec2> = (0..1000).map(|_| DVec2::new(random.unit(), random.unit())).collect();
    uv.push(DVec2::ZERO);
    let values = |fit: &SkinFit| {
        let mut out = vec![0.0; 3 * uv.len()];
        fit.surface.eval_rows(&uv, 0, &mut out);
        out
    };
    assert!(distances(&values(&as_ordered), &values(&aligned)) <= 1e-9);
    // errors are told in the caller's order
    let mut at_data = vec![0.0; mixed.points.len()];
    aligned.surface.eval_rows(&aligned.parameters, 0, &mut at_data);
    assert!(distances(&at_data, &mixed.points) < aligned.report.tolerance);

    let warned = fit(&mixed, &SkinOptions { align: false, ..options });
    assert!(warned.report.remarks.has(Remarks::TWISTED_ROWS));
    assert_eq!(fit(&ordered, &SkinOptions { align: false, ..options }).skin.twisted_row, None);
}

#[test]
fn an_open_row_turned_round_is_noticed_and_put_right() {
    let ordered = wave();
    let mut mixed = ordered.clone();
    let start = 3 * (ordered.counts[0] + ordered.counts[1]);
    let row = &mut mixed.points[start..start + 3 * ordered.counts[2]];
    let reversed: Vec<f64> = row.chunks(3).rev().flatten().copied().collect();
    row.copy_from_slice(&reversed);
    assert_eq!(fit(&mixed, &paper(1e-3)).skin.twisted_row, Some(2));
    let aligned = fit(&mixed, &SkinOptions { align: true, ..paper(1e-3) });
    assert_eq!(aligned.skin.aligned_row_count, 1);
    assert_eq!(aligned.report.coefficient_count, fit(&ordered, &paper(1e-3)).report.coefficient_count);
}

#[test]
fn fewer_knots_along_v_keep_the_tolerance() {
    let options = SkinOptions { approximate_v: true, ..paper(2e-3) };
    let (few, all) = (fit(&head(), &options), fit(&head(), &paper(2e-3)));
    assert!(few.report.max_error < few.report.tolerance, "{:?}", few.report);
    assert!(few.skin.v_error > 0.0 && few.skin.v_error < 0.5 * few.report.tolerance);
    assert!(few.skin.curve_count < all.skin.curve_count, "{:?}", few.skin);
}

#[test]
fn tangents_across_the_end_rows_are_kept() {
    let set = wave();
    let begin: Vec<f64> = (0..set.counts[0]).flat_map(|_| [0.0, 0.6, 0.8]).collect();
    let options = SkinOptions { begin_tangents: Some(&begin), ..paper(1e-6) };
    let fit = fit(&set, &options);
    for k in 0..=20 {
        let mut rows = [0.0; 9];
        fit.surface.eval_rows(&[DVec2::new(f64::from(k) / 20.0, 0.0)], 1, &mut rows);
        let length = (rows[6] * rows[6] + rows[7] * rows[7] + rows[8] * rows[8]).sqrt();
        // both curves at the end are within 1e-6 of the exact ones, 1/12 apart: a thousandth is far above
        assert!((rows[7] / length - 0.6).abs() < 1e-3 && (rows[8] / length - 0.8).abs() < 1e-3, "{rows:?}");
    }
    assert!(fit.report.max_error < fit.report.tolerance);
}

#[test]
fn section_curves_give_the_skin_of_their_rows() {
    let set = wave();
    let data = Data::of_rows(&set.as_rows(), &paper(1e-4)).unwrap();
    let curve = |section: &Section| match section {
        Section::Cubic(cubic) => cubic.to_curve().unwrap(),
        Section::Other { curve, .. } => curve.clone(),
    };
    let curves: Vec<Curve> = data.sources.rows().iter().map(curve).collect();
    let of_curves = skin_curves(&curves, &paper(1e-4), &mut Control::new(1)).unwrap();
    let of_rows = fit(&set, &paper(1e-4));
    assert_eq!(of_curves.report.coefficient_count, of_rows.report.coefficient_count);
    let mut values = vec![0.0; set.points.len()];
    of_curves.surface.eval_rows(&of_rows.parameters, 0, &mut values);
    assert!(distances(&values, &set.points) < of_rows.report.tolerance);
}

#[test]
fn curves_of_any_degree_become_sections() {
    let knots = |breaks: &[f64], degree| crate::knots::KnotVector::clamped(breaks, degree).unwrap();
    let line = Curve::new(3, knots(&[5.0, 7.0], 1), vec![0., 0., 0., 1., 0., 0.]).unwrap();
    let bent = Curve::new(3, knots(&[0.0, 1.0, 2.0], 1), vec![0., 1., 0., 0.5, 1., 0.2, 1., 1., 0.]).unwrap();
    let quintic = Curve::new(
        3,
        knots(&[0.0, 1.0], 5),
        (0..6).flat_map(|k| [0.2 * f64::from(k), 2.0, f64::from(k % 2)]).collect(),
    );
    let curves = [line, bent, quintic.unwrap()];
    let fit =
        skin_curves(&curves, &SkinOptions { certify: true, ..SkinOptions::default() }, &mut Control::new(1));
    let fit = fit.unwrap();
    assert!(fit.report.max_error < fit.report.tolerance);
    assert!(fit.skin.certified_distance.is_nan(), "a kink and a fifth degree are no cubics");
}

#[test]
fn the_bits_do_not_depend_on_the_threads() {
    let set = screwdriver();
    let on = |threads| {
        let options = SkinOptions { removal: true, extra_checks: 1, ..paper(1e-4) };
        skin(&set.as_rows(), &options, &mut Control::new(threads)).unwrap()
    };
    let one = on(1);
    for threads in [2, 5] {
        let many = on(threads);
        assert_eq!(one.surface, many.surface);
        assert_eq!(one.errors, many.errors);
    }
}

#[test]
fn unusual_rows_are_taken() {
    // an apex, a point given twice, a straight line, a row of three
    let points = [
        [0.5, 0.0, 1.0],
        [0.0, 1.0, 0.0],
        [0.3, 1.0, 0.2],
        [0.3, 1.0, 0.2],
        [1.0, 1.0, 0.0],
        [0.0, 2.0, 0.0],
        [1.0, 2.0, 0.0],
        [0.0, 3.0, 0.0],
        [0.5, 3.0, 0.5],
        [1.0, 3.0, 0.0],
    ];
    let set = RowSet { points: points.concat(), counts: vec![1, 4, 2, 3] };
    let fit = fit(&set, &paper(1e-6));
    assert!(fit.report.max_error < fit.report.tolerance, "{:?}", fit.report);
    assert_eq!(fit.skin.merged_point_count, 1);
    assert!(fit.report.remarks.has(Remarks::MERGED_POINTS));
    let mut apex = [0.0; 6];
    fit.surface.eval_rows(&[DVec2::ZERO, DVec2::X], 0, &mut apex);
    assert_eq!(apex[..3], apex[3..]);
}

#[test]
fn bad_input_is_named() {
    let good = dustpan();
    let refuse = |change: &dyn Fn(&mut RowSet), options: SkinOptions| {
        let mut set = good.clone();
        change(&mut set);
        skin(&set.as_rows(), &options, &mut Control::new(1)).unwrap_err()
    };
    let options = paper(1e-3);
    let nothing = |_: &mut RowSet| {};
    assert_eq!(
        refuse(
            &|set| {
                set.counts.truncate(1);
                set.points.truncate(30)
            },
            options
        ),
        SkinError::TooFewRows { count: 1, least: 2 }
    );
    assert_eq!(refuse(&|set| set.counts.insert(3, 0), options), SkinError::EmptyRow { row: 3 });
    assert_eq!(
        refuse(&|set| set.points[3 * 11 + 1] = f64::NAN, options),
        SkinError::NotFinite { point: 11, row: 1 }
    );
    assert!(matches!(
        refuse(
            &|set| {
                set.points.pop();
            },
            options
        ),
        SkinError::Count { count: 665, expected: 666, .. }
    ));
    for tolerance in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(refuse(&nothing, paper(tolerance)), SkinError::Option { option: "tolerance", .. }));
    }
    let twice = |set: &mut RowSet| {
        let row = set.row(2).to_vec();
        let start = 3 * set.counts[..3].iter().sum::<usize>();
        set.points.splice(start..start, row);
        set.counts.insert(3, set.counts[2]);
    };
    assert_eq!(refuse(&twice, options), SkinError::Identical { row: 3 });
    let periodic = SkinOptions { ends: SectionEnds::Periodic, ..options };
    assert!(matches!(refuse(&nothing, periodic), SkinError::Option { option: "ends", .. }));
    let slopes = SkinOptions { ends: SectionEnds::Slopes(&[0.0; 3]), ..options };
    assert!(matches!(refuse(&nothing, slopes), SkinError::Count { count: 3, expected: 66, .. }));
    let tangents = SkinOptions { end_tangents: Some(&[f64::NAN; 36]), ..options };
    assert!(matches!(refuse(&nothing, tangents), SkinError::VectorNotFinite { index: 0, .. }));
    let raised = fit(&good, &paper(1e-30));
    assert!(raised.report.remarks.has(Remarks::TOLERANCE_RAISED));
}

#[test]
fn clustered_rows_are_reported() {
    let mut set = RowSet::default();
    for y in [0.0, 1.0, 1.001, 1.002, 2.0] {
        set.points.extend((0..20).flat_map(|k| [f64::from(k), y, (0.3 * f64::from(k)).sin()]));
        set.counts.push(20);
    }
    let fit = fit(
        &set,
        &SkinOptions { tolerance: Tolerance { value: 1e-3, scale: ToleranceScale::Absolute }, ..paper(1.0) },
    );
    assert!(fit.skin.overshoot > 100.0 && fit.report.remarks.has(Remarks::CLUSTERED_ROWS), "{:?}", fit.skin);
    assert!(fit.report.max_error < 1e-3);
}

#[test]
fn a_listener_can_cancel() {
    use std::ops::ControlFlow;
    let mut stop = |_: f64, _: f64| ControlFlow::Break(());
    let mut control = Control::new(1).with_progress(&mut stop);
    let error = skin(&wave().as_rows(), &paper(1e-3), &mut control).unwrap_err();
    assert!(matches!(error, SkinError::Cancelled(_)), "{error}");
}

#[test]
fn monotone_slopes_do_not_bulge() {
    // circles round a body: bunched stations, and a long part of one radius
    let stations = [0.0, 0.3, 1.0, 1.2, 3.0, 10.0, 10.2, 20.0, 28.0, 28.3, 32.0];
    let radii = [0.1, 0.8, 1.4, 1.5, 2.0, 2.0, 2.0, 2.0, 2.0, 1.95, 0.2];
    let counts: Vec<usize> = (0..stations.len()).map(|k| 24 + k).collect();
    let mut points = Vec::new();
    for ((&x, &radius), &count) in stations.iter().zip(&radii).zip(&counts) {
        for k in 0..count {
            let (sin, cos) = (std::f64::consts::TAU * k as f64 / count as f64).sin_cos();
            points.extend([x, radius * cos, radius * sin]);
        }
    }
    let rows = Rows { points: &points, counts: &counts, dim: 3 };
    let largest_radius = |v_slopes: VSlopes| {
        let options = SkinOptions { v_slopes, closed: true, ..SkinOptions::default() };
        let fit = skin(&rows, &options, &mut Control::new(1)).unwrap();
        assert!(fit.report.max_error <= fit.report.tolerance, "{:?}", fit.report);
        assert_eq!(fit.report.remarks.has(Remarks::CLUSTERED_ROWS), v_slopes == VSlopes::Smooth);
        let places: Vec<DVec2> =
            (0..40_000).map(|k| DVec2::new((k % 200) as f64, (k / 200) as f64) / 199.0).collect();
        let mut values = vec![0.0; 3 * places.len()];
        fit.surface.eval_rows(&places, 0, &mut values);
        let radius = values.chunks_exact(3).map(|p| p[1].hypot(p[2])).fold(0.0, f64::max);
        (radius, fit.report.tolerance)
    };
    let (smooth, _) = largest_radius(VSlopes::Smooth);
    let (monotone, tolerance) = largest_radius(VSlopes::Monotone);
    assert!(smooth > 2.1, "{smooth}");
    assert!(monotone <= 2.0 + 2.0 * tolerance, "{monotone}, tolerance {tolerance}");
    for refused in [
        SkinOptions { closed_v: true, ..SkinOptions::default() },
        SkinOptions { approximate_v: true, ..SkinOptions::default() },
    ] {
        let options = SkinOptions { v_slopes: VSlopes::Monotone, closed: true, ..refused };
        let error = skin(&rows, &options, &mut Control::new(1)).unwrap_err();
        assert!(error.to_string().contains("v_slopes"), "{error}");
    }
}
