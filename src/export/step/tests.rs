use super::*;
use crate::Control;
use crate::control::Watch;
use crate::fit::tensor::{TensorOptions, fit_mesh};
use crate::geometry::Axis;
use crate::knots::KnotVector;
use crate::model::shapes::{circle, rectangle, torus_piece, trimmed, wave};
use crate::model::{Form, FormOptions, ModelError, of_parts, of_surface};
use crate::samples;
use crate::surface::tensor::TensorSurface;
use crate::surface::{AnySurface, ConvertError, Surface, Trims};
use glam::DVec2;
use std::collections::HashSet;

fn model(surface: &TensorSurface) -> Model {
    of_parts(surface, vec![surface.clone()]).unwrap()
}

fn text(surface: &TensorSurface) -> (String, StepReport) {
    to_text(&model(surface), &StepOptions::default(), &Watch::default()).unwrap()
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
    };
    let text = to_text(&model(&wave()), &options, &Watch::default()).unwrap().0;
    check_syntax(&text);
    for part in
        ["AP242_MANAGED", "'INCH'", "Fl\\X2\\00E4\\X0\\che", "('A. N. Other'),('O''Hara')", "2026-01-31"]
    {
        assert!(text.contains(part), "{part}");
    }
    let metres =
        to_text(&model(&wave()), &StepOptions { unit: Unit::Metre, ..options }, &Watch::default()).unwrap().0;
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
    write(&model(&wave()), &StepOptions::default(), &path, &Watch::default()).unwrap();
    let written = std::fs::read_to_string(&path).unwrap();
    assert_eq!(written, text(&wave()).0);
    let nowhere = path.join("below_a_file.step");
    assert!(write(&model(&wave()), &StepOptions::default(), &nowhere, &Watch::default()).is_err());
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
    let in_form = |surface: &AnySurface, form| {
        let model =
            of_surface(surface, &FormOptions { form, ..FormOptions::default() }, &Watch::default()).unwrap();
        to_text(&model, &StepOptions::default(), &Watch::default()).unwrap()
    };
    let (_, report) = in_form(&surface, Form::Tensor);
    assert_eq!((report.face_count, report.pole_count), (1, fit.skin.tensor_count));
    let (text, report) = in_form(&surface, Form::Strips);
    assert_eq!((report.face_count, report.pole_count), (set.counts.len() - 1, fit.skin.strip_count));
    assert_eq!(text.matches("ADVANCED_FACE").count(), report.face_count);

    let limited = FormOptions { max_coefficients: 10, ..FormOptions::default() };
    let too_large = ConvertError::TooLarge { needed: fit.skin.tensor_count, limit: 10 };
    assert_eq!(of_surface(&surface, &limited, &Watch::default()), Err(ModelError::Convert(too_large)));
    let mut trimmed = fit.surface;
    let triangle = [(0.1, 0.1), (0.9, 0.1), (0.5, 0.8)].map(|(u, v)| DVec2::new(u, v)).to_vec();
    trimmed.region_mut().trims = Trims::new(vec![triangle], &trimmed.domain()).unwrap();
    let (text, report) = in_form(&trimmed.into(), Form::Strips);
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
    let options = |level_spread| FormOptions { form: Form::Patches, level_spread, ..FormOptions::default() };
    for loops in [Vec::new(), vec![rectangle(0.1, 0.9), circle([0.4, 0.5], 0.1, 40)]] {
        pht.region_mut().trims = Trims::new(loops.clone(), &pht.domain()).unwrap();
        let surface = AnySurface::from(pht.clone());
        let holes = loops.len().saturating_sub(1);
        for level_spread in [0, 1, 20] {
            let model = of_surface(&surface, &options(level_spread), &Watch::default()).unwrap();
            let (text, report) = to_text(&model, &StepOptions::default(), &Watch::default()).unwrap();
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

#[test]
fn a_closed_skin_is_written_closed() {
    use crate::Control;
    use crate::fit::skin::{Rows, SkinMethod, SkinOptions, skin};
    let set = crate::samples::rows::screwdriver();
    let rows = Rows { points: &set.points, counts: &set.counts, dim: 3 };
    let forms = [
        (Form::Tensor, SkinMethod::default()),
        (Form::Strips, SkinMethod::default()),
        (Form::Tensor, SkinMethod::CommonKnots),
    ];
    for (form, method) in forms {
        let options = SkinOptions { method, ..SkinOptions::default() };
        let surface = skin(&rows, &options, &mut Control::new(2)).unwrap().surface.into();
        let model =
            of_surface(&surface, &FormOptions { form, ..FormOptions::default() }, &Watch::default()).unwrap();
        // only the first and the last row are free, each a closed edge
        let free: Vec<_> = model.edge_ids().filter(|&edge| model.is_free(edge)).collect();
        assert_eq!(free.len(), 2, "{form:?}");
        assert!(free.iter().all(|&edge| model.edge(edge).vertices[0] == model.edge(edge).vertices[1]));
        let (text, report) = to_text(&model, &StepOptions::default(), &Watch::default()).unwrap();
        check_syntax(&text);
        assert_eq!(text.matches("=SEAM_CURVE(").count(), report.face_count, "{form:?}");
        assert!(report.curve_deviation <= 1e-7 * report.diagonal, "{report:?}");
        // and the mesh of it has two rows of free edges
        let mesh = model.tessellate(&Default::default()).unwrap().mesh;
        assert_eq!((mesh.loops().len(), mesh.component_count()), (2, 1), "{form:?}");
    }
}

#[test]
fn a_face_lies_on_what_is_around_its_trims() {
    let whole = wave();
    let loops = vec![rectangle(0.3, 0.4), circle([0.35, 0.35], 0.02, 9)];
    let surface = AnySurface::from(trimmed(whole.clone(), loops.clone()));
    let model = of_surface(&surface, &FormOptions::default(), &Watch::default()).unwrap();
    let part = model.carrier(model.face_ids().next().unwrap()).domain().unwrap();
    assert!((part.min.x - 0.299).abs() < 1e-15 && (part.max.y - 0.401).abs() < 1e-15, "{part:?}");
    assert_eq!(model.trims(model.face_ids().next().unwrap()).unwrap().loops().len(), 2);
    let (text, report) = to_text(&model, &StepOptions::default(), &Watch::default()).unwrap();
    check_syntax(&text);
    assert!(report.curve_deviation <= 1e-7 * report.diagonal, "{report:?}");
}
