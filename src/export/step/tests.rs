use super::*;
use crate::Control;
use crate::fit::tensor::{TensorOptions, fit_mesh};
use crate::knots::KnotVector;
use crate::samples;
use crate::surface::{Region, Trims};
use std::collections::HashSet;
use std::f64::consts::{FRAC_1_SQRT_2, TAU};

/// A wave over the unit square, bicubic with some inner knots.
fn wave() -> TensorSurface {
    let knots = KnotVector::clamped(&[0.0, 0.2, 0.5, 0.6, 1.0], 3).unwrap();
    let count = knots.basis_count();
    let mut points = Vec::new();
    for i in 0..count {
        for j in 0..count {
            let (x, y) = (knots.greville(i), knots.greville(j));
            points.extend([x, y, 0.2 * (5.0 * x).sin() * (4.0 * y).cos()]);
        }
    }
    TensorSurface::new(3, knots.clone(), knots, points, None).unwrap()
}

/// A quarter of a torus tube by a quarter of its ring, exactly.
fn torus_piece() -> TensorSurface {
    let knots = KnotVector::clamped(&[0.0, 1.0], 2).unwrap();
    let (ring, tube) = (3.0, 1.0);
    let w = [1.0, FRAC_1_SQRT_2, 1.0];
    let arc = [(1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
    let (mut points, mut weights) = (Vec::new(), Vec::new());
    for (i, (cx, cy)) in arc.into_iter().enumerate() {
        for (j, (tr, tz)) in arc.into_iter().enumerate() {
            let radius = ring + tube * tr;
            points.extend([radius * cx, radius * cy, tube * tz]);
            weights.push(w[i] * w[j]);
        }
    }
    TensorSurface::new(3, knots.clone(), knots, points, Some(weights)).unwrap()
}

fn circle(center: [f64; 2], radius: f64, count: usize) -> Vec<DVec2> {
    let place = |k: usize| DVec2::from(center) + radius * DVec2::from_angle(TAU * k as f64 / count as f64);
    (0..count).map(place).collect()
}

fn rectangle(min: f64, max: f64) -> Vec<DVec2> {
    [(min, min), (min, max), (max, max), (max, min)].map(DVec2::from).to_vec() // clockwise
}

fn trimmed(mut surface: TensorSurface, loops: Vec<Vec<DVec2>>) -> TensorSurface {
    let trims = Trims::new(loops, &surface.domain()).unwrap();
    *surface.region_mut() = Region { data_box: None, trims };
    surface
}

fn text(surface: &TensorSurface) -> (String, StepReport) {
    to_text(&surface.clone().into(), &StepOptions::default()).unwrap()
}

fn refusal(surface: &TensorSurface) -> StepError {
    to_text(&surface.clone().into(), &StepOptions::default()).map(|(_, report)| report).unwrap_err()
}

/// The numbers of the entities that a text without quotes refers to.
fn references(entity: &str) -> impl Iterator<Item = usize> {
    entity.split('#').skip(1).map(|rest| {
        let digits = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
        rest[..digits].parse().unwrap()
    })
}

/// Every statement ends, brackets balance, every reference points back, and everything but the ends is used.
fn check_syntax(text: &str) {
    assert!(text.is_ascii() && text.ends_with("ENDSEC;\nEND-ISO-10303-21;\n"));
    let data = text.split("DATA;\n").nth(1).unwrap().split("ENDSEC;").next().unwrap().replace('\n', "");
    let (mut defined, mut used) = (HashSet::new(), HashSet::new());
    for entity in data.split_terminator(';') {
        let (name, body) = entity.split_once('=').unwrap();
        assert_eq!(body.matches('(').count(), body.matches(')').count(), "{entity}");
        assert_eq!(body.matches('\'').count() % 2, 0, "{entity}");
        for id in references(body) {
            assert!(defined.contains(&id), "{entity}");
            used.insert(id);
        }
        assert!(defined.insert(references(name).next().unwrap()), "{entity}");
    }
    let unused = defined.difference(&used).count();
    // application protocol, product category, shape definition
    assert_eq!(unused, 3);
}

#[test]
fn files_are_well_formed_and_the_same_each_time() {
    let holes = || vec![rectangle(0.1, 0.9), circle([0.4, 0.5], 0.1, 40), circle([0.7, 0.7], 0.05, 9)];
    for (surface, loops) in
        [(wave(), 1), (torus_piece(), 1), (trimmed(wave(), holes()), 3), (trimmed(torus_piece(), holes()), 3)]
    {
        let (text, report) = text(&surface);
        check_syntax(&text);
        assert_eq!(text, self::text(&surface).0);
        assert_eq!((report.loop_count, text.matches("=EDGE_LOOP(").count()), (loops, loops));
        assert_eq!(text.matches("=EDGE_CURVE(").count(), report.edge_count);
        assert_eq!(text.matches("=ADVANCED_FACE(").count(), 1);
        assert_eq!(text.contains("RATIONAL_B_SPLINE_SURFACE("), surface.weights().is_some());
        assert!(report.curve_deviation <= 1e-7 * report.diagonal, "{report:?}");
        assert_eq!(report.uncertainty, 1e-7 * report.diagonal);
    }
}

#[test]
fn options_are_in_the_file() {
    let options = StepOptions {
        schema: Schema::Ap242,
        unit: Unit::Inch,
        product: "Fläche",
        author: "A. N. Other",
        organization: "O'Hara",
        timestamp: "2026-01-31T12:00:00",
        ..StepOptions::default()
    };
    let text = to_text(&wave().into(), &options).unwrap().0;
    check_syntax(&text);
    for part in
        ["AP242_MANAGED", "'INCH'", "Fl\\X2\\00E4\\X0\\che", "('A. N. Other'),('O''Hara')", "2026-01-31"]
    {
        assert!(text.contains(part), "{part}");
    }
    let metres = to_text(&wave().into(), &StepOptions { unit: Unit::Metre, ..options }).unwrap().0;
    assert!(metres.contains("SI_UNIT($,.METRE.)"));
}

#[test]
fn the_domain_has_four_edges_and_simple_curves() {
    let (text, report) = text(&wave());
    assert_eq!((report.loop_count, report.edge_count), (1, 4));
    // borders of a bicubic are cubics: nothing but rounding is between the curves
    assert!(report.curve_deviation < 1e-14, "{report:?}");
    assert_eq!(text.matches("=VERTEX_POINT(").count(), 4);
}

#[test]
fn material_is_on_the_left_of_every_bound() {
    for flip in [false, true] {
        let mut loops = vec![circle([0.3, 0.3], 0.1, 12), rectangle(0.1, 0.9), circle([0.7, 0.7], 0.1, 7)];
        if flip {
            loops.iter_mut().for_each(|polyline| polyline.reverse());
        }
        let bounds = loops::bounds(&trimmed(wave(), loops)).unwrap();
        let area = |p: &Vec<DVec2>| -> f64 {
            (0..p.len()).map(|k| p[k].perp_dot(p[(k + 1) % p.len()])).sum::<f64>() / 2.0
        };
        assert!((area(&bounds[0]) - 0.64).abs() < 1e-12);
        assert!(bounds[1..].iter().all(|hole| area(hole) < 0.0));
    }
}

#[test]
fn edges_close_and_lie_on_the_surface() {
    let holes = vec![rectangle(0.05, 0.95), circle([0.5, 0.5], 0.3, 300), circle([0.87, 0.87], 0.03, 3)];
    for surface in [trimmed(wave(), holes.clone()), trimmed(torus_piece(), holes)] {
        let loops = loops::bounds(&surface).unwrap();
        let shell = Shell::new(&[&surface], &loops, 1e-7).unwrap();
        // corners of the rectangle and the triangle; a round hole has two edges
        assert_eq!(shell.faces[0].bounds.iter().map(Vec::len).collect::<Vec<_>>(), [4, 2, 3]);
        for edge in &shell.edges {
            assert_ne!(edge.start, edge.end);
            let (curve, pcurve) = (&edge.image.curve, &edge.image.pcurve);
            assert_eq!(curve.knots().domain(), pcurve.knots().domain());
            let (from, to) = curve.knots().domain();
            for k in 0..=777 {
                let t = from + (to - from) * f64::from(k) / 777.0;
                let uv = surface.domain().clamp(DVec2::from_slice(&pcurve.eval(t)));
                let mut point = [0.0; 3];
                surface.eval_rows(&[uv], 0, &mut point);
                let off = glam::DVec3::from(point).distance(glam::DVec3::from_slice(&curve.eval(t)));
                assert!(off <= 1e-7, "{off:e} at {t}");
            }
        }
    }
}

#[test]
fn an_edge_across_a_crease_bends_with_it() {
    let u = KnotVector::new(vec![0., 0., 0., 0.5, 0.5, 1., 1., 1.], 2).unwrap();
    let v = KnotVector::clamped(&[0.0, 1.0], 1).unwrap();
    let profile = [(0.0, 0.0), (0.2, 0.3), (0.5, 1.0), (0.7, 0.1), (1.0, 0.0)];
    let points = profile.into_iter().flat_map(|(x, z)| [x, 0.0, z, x, 1.0, z]).collect();
    let surface = TensorSurface::new(3, u, v, points, None).unwrap();
    let report = text(&surface).1;
    assert!(report.curve_deviation < 1e-14, "{report:?}");
}

#[test]
fn a_pole_has_no_edge() {
    // an eighth of a sphere: the side v = 1 is one point
    let mut sphere = torus_piece();
    let knots = sphere.knots(Axis::U).clone();
    let arc = [(1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
    let points =
        arc.iter().flat_map(|&(x, y)| arc.iter().flat_map(move |&(r, z)| [r * x, r * y, z])).collect();
    let weights = sphere.weights().map(<[f64]>::to_vec);
    sphere = TensorSurface::new(3, knots.clone(), knots, points, weights).unwrap();
    let report = text(&sphere).1;
    assert_eq!((report.loop_count, report.edge_count), (1, 3));
}

#[test]
fn what_is_no_face_is_refused() {
    let trims = |loops| refusal(&trimmed(wave(), loops));
    let eight = [(0.1, 0.1), (0.9, 0.9), (0.9, 0.1), (0.1, 0.9)].map(DVec2::from).to_vec();
    assert!(matches!(trims(vec![eight]), StepError::Crossing { index: 0, .. }));
    let overlapping = vec![rectangle(0.1, 0.6), rectangle(0.4, 0.9)];
    assert!(matches!(trims(overlapping), StepError::Crossing { index: 1, .. }));
    let corner_on_a_side = [(0.125, 0.5), (0.25, 0.25), (0.25, 0.75)].map(DVec2::from).to_vec();
    let touching = vec![rectangle(0.125, 0.875), corner_on_a_side];
    assert!(matches!(trims(touching), StepError::Crossing { .. }));
    let twice = vec![rectangle(0.1, 0.4), rectangle(0.6, 0.9)];
    assert_eq!(trims(twice), StepError::Pieces { count: 2 });
    let island = vec![rectangle(0.1, 0.9), rectangle(0.2, 0.8), rectangle(0.4, 0.6)];
    assert_eq!(trims(island), StepError::Pieces { count: 2 });
    let point = vec![rectangle(0.1, 0.9), vec![DVec2::splat(0.5); 3]];
    assert_eq!(trims(point), StepError::Empty { index: 1 });

    let line = KnotVector::clamped(&[0.0, 1.0], 1).unwrap();
    let surface = |dim, scale| {
        let points = (0..4 * dim).map(|k| scale * ((k * k) % 7) as f64).collect();
        TensorSurface::new(dim, line.clone(), line.clone(), points, None).unwrap()
    };
    assert_eq!(refusal(&surface(2, 1.0)), ExportError::Dimension { dim: 2 }.into());
    assert!(matches!(refusal(&surface(3, 0.0)), StepError::Size { .. }));
    assert!(matches!(refusal(&surface(3, 4e307)), StepError::Size { .. }));
    let torn = KnotVector::new(vec![0., 0., 0.5, 0.5, 1., 1.], 1).unwrap();
    let points = (0..24).map(f64::from).collect();
    let torn = TensorSurface::new(3, torn, line.clone(), points, None).unwrap();
    assert_eq!(refusal(&torn), StepError::Torn { axis: Axis::U, index: 2, degree: 1 });
}

#[test]
fn a_fitted_panel_keeps_its_windows() {
    let mesh = samples::fuselage_panel(1).unwrap();
    let fit = fit_mesh(&mesh, &TensorOptions::default(), &mut Control::default()).unwrap();
    let (text, report) = text(&fit.surface);
    check_syntax(&text);
    assert_eq!(report.loop_count, 4);
    assert!(report.edge_count < 60, "{report:?}");
    assert!(report.curve_deviation <= 0.5e-7 * report.diagonal, "{report:?}");
}

#[test]
fn files_appear_whole_or_not_at_all() {
    let path = std::env::temp_dir().join(format!("planish_{}.step", std::process::id()));
    write(&wave().into(), &StepOptions::default(), &path).unwrap();
    let written = std::fs::read_to_string(&path).unwrap();
    assert_eq!(written, text(&wave()).0);
    let crossing = trimmed(wave(), vec![rectangle(0.1, 0.6), rectangle(0.4, 0.9)]);
    assert!(write(&crossing.into(), &StepOptions::default(), &path).is_err());
    assert_eq!(std::fs::read_to_string(&path).unwrap(), written);
    std::fs::remove_file(&path).unwrap();
}

#[test]
fn a_t_spline_is_written_whole_or_in_strips() {
    use crate::Control;
    use crate::fit::skin::{Rows, SkinOptions, skin};
    let set = crate::samples::rows::dustpan();
    let rows = Rows { points: &set.points, counts: &set.counts, dim: 3 };
    let fit = skin(&rows, &SkinOptions::default(), &mut Control::new(1)).unwrap();
    let surface = AnySurface::from(fit.surface.clone());
    let whole = StepOptions::default();
    let (_, report) = to_text(&surface, &whole).unwrap();
    assert_eq!((report.face_count, report.pole_count), (1, fit.skin.tensor_count));
    let strips = StepOptions { form: Form::Strips, ..whole };
    let (text, report) = to_text(&surface, &strips).unwrap();
    assert_eq!((report.face_count, report.pole_count), (set.counts.len() - 1, fit.skin.strip_count));
    assert_eq!(text.matches("ADVANCED_FACE").count(), report.face_count);

    let limited = StepOptions { max_coefficients: 10, ..whole };
    let error = to_text(&surface, &limited).unwrap_err();
    assert_eq!(
        error,
        StepError::Convert(ConvertError::TooLarge { needed: fit.skin.tensor_count, limit: 10 })
    );
    let mut trimmed = fit.surface;
    let triangle = [(0.1, 0.1), (0.9, 0.1), (0.5, 0.8)].map(|(u, v)| DVec2::new(u, v)).to_vec();
    trimmed.region_mut().trims = Trims::new(vec![triangle], &trimmed.domain()).unwrap();
    let (text, report) = to_text(&trimmed.into(), &strips).unwrap();
    check_syntax(&text);
    // three corners, and two more where each line of v between strips enters and leaves
    assert_eq!(report.edge_count - report.face_count, 3 + 2 * (report.face_count - 1) - 1);
}

#[test]
fn a_pht_spline_is_a_shell_of_patches() {
    use crate::surface::pht::{ConvertOptions, PhtSurface};
    use crate::tmesh::Cell;
    let mut pht = PhtSurface::from_tensor(&wave(), &ConvertOptions::default()).unwrap();
    pht.split(&[Cell { level: 0, i: 0, j: 0 }, Cell { level: 1, i: 1, j: 1 }]).unwrap();
    let options = |level_spread| StepOptions { form: Form::Patches, level_spread, ..StepOptions::default() };
    for loops in [Vec::new(), vec![rectangle(0.1, 0.9), circle([0.4, 0.5], 0.1, 40)]] {
        pht.region_mut().trims = Trims::new(loops.clone(), &pht.domain()).unwrap();
        let surface = AnySurface::from(pht.clone());
        let holes = loops.len().saturating_sub(1);
        for level_spread in [0, 1, 20] {
            let (text, report) = to_text(&surface, &options(level_spread)).unwrap();
            check_syntax(&text);
            let counts = ["=ADVANCED_FACE(", "=EDGE_CURVE(", "=VERTEX_POINT(", "=EDGE_LOOP("]
                .map(|name| text.matches(name).count());
            let [faces, edges, vertices, bounds] = counts;
            assert_eq!([faces, edges, bounds], [report.face_count, report.edge_count, report.loop_count]);
            // a disk with holes
            assert_eq!(vertices + 2 * faces, edges + bounds + 1 - holes);
            assert_eq!(faces == 1, level_spread == 20);
            assert!(report.curve_deviation <= 1e-7 * report.diagonal, "{report:?}");
        }
    }
}
