use super::super::{MeshModelOptions, ModelFit, fit_mesh};
use super::transfer::ModelTransfer;
use super::*;
use crate::failure::{Classify, ErrorKind};
use crate::fit::field::transfer::{Carry, TransferOptions};
use crate::layout::Side;
use crate::model::FaceId;
use crate::samples::Random;
use crate::samples::layouts::torus;
use crate::surface::evaluate::OutsideRule;
use glam::{DVec2, DVec3};

/// A torus of triangles, about 2 across, and its model.
fn ring() -> (Mesh, ModelFit) {
    ring_of(40, 20)
}

fn ring_of(around: u32, across: u32) -> (Mesh, ModelFit) {
    let (quads, points) = torus(around, across);
    let triangles = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    let mesh = Mesh::new(points, triangles).unwrap();
    let fit = fit_mesh(&mesh, &MeshModelOptions::default(), &mut Control::new(2)).unwrap();
    (mesh, fit)
}

/// A wave in space.
fn wave(p: DVec3) -> f64 {
    (2.0 * p.x + 0.3).sin() + 0.5 * (1.5 * p.y).cos() * p.z
}

fn values(mesh: &Mesh, of: impl Fn(DVec3) -> f64) -> Vec<f64> {
    mesh.points().iter().map(|&p| of(p)).collect()
}

fn fitter(mesh: &Mesh, model: &Model) -> ModelFieldFitter {
    ModelFieldFitter::new(model, mesh, &FieldOptions::default(), None, &mut Control::new(2)).unwrap()
}

#[test]
fn constants_stay_and_waves_are_followed() {
    let (mesh, ModelFit { model, .. }) = ring();
    let fitter = fitter(&mesh, &model);
    let both: Vec<f64> = mesh.points().iter().flat_map(|&p| [7.25, wave(p)]).collect();
    let field = fitter.fit(&both, 2).unwrap();
    let report = fitter.measure(&field, &both, 2).unwrap();
    // a wave of length 3 over cells of a fifth of that
    assert!(report.fit.max_error <= 1e-2, "{}", report.fit.max_error);
    let faces: Vec<u32> = (0..model.faces().len() as u32).collect();
    let middles: Vec<DVec2> = model
        .face_ids()
        .map(|face| model.carrier(face).domain().map(|domain| domain.min.midpoint(domain.max)).unwrap())
        .collect();
    let pool = Pool::new(2);
    let at = field.evaluate(0, &faces, &middles, OutsideRule::Fail, &pool).unwrap();
    for row in at.rows.chunks_exact(2) {
        // the solution of the differences from the mean is zero but for its rounding
        assert!((row[0] - 7.25).abs() <= 1e-13, "{row:?}");
    }
    // errors again through the evaluation by faces
    for (node, place) in model.origin().unwrap().nodes.iter().enumerate() {
        let place = place.unwrap();
        let at = field.evaluate(0, &[place.face.index() as u32], &[place.uv], OutsideRule::Fail, &pool);
        let row = at.unwrap().rows;
        let error = (row[0] - 7.25).hypot(row[1] - both[2 * node + 1]);
        assert!((error - report.errors[node]).abs() <= 1e-14);
    }
}

#[test]
fn gradients_agree_across_edges_and_with_difference_quotients() {
    let (mesh, ModelFit { model, pieces, .. }) = ring();
    let field = fitter(&mesh, &model).fit(&values(&mesh, wave), 1).unwrap();
    let pool = Pool::new(1);
    let gradient = |quad: u32, uv: DVec2| {
        let surfaces = (&pieces[0].surfaces[quad as usize], &field.patches()[quad as usize]);
        let mut out = [0.0; 3];
        crate::query::gradient::field_gradient(surfaces.0, surfaces.1, &[uv], &mut out, &pool).unwrap();
        DVec3::from_array(out)
    };
    let layout = &pieces[0].layout;
    for edge in layout.edges() {
        let sides: Vec<Side> = edge.sides().collect();
        for k in 0..=16 {
            let t = f64::from(k) / 16.0;
            let [a, b] =
                [sides[0].place(t, 0.0), sides[1].place(1.0 - t, 0.0)].map(|p| gradient(p.quad, p.uv));
            // roundings over the least angle between the tangents
            assert!(a.distance(b) <= 1e-10, "edge {:?} at {t}: {a} {b}", edge.ends);
        }
    }
    // along the model, face by face
    let step = 1e-6;
    for face in 0..model.faces().len() as u32 {
        let domain = model.carrier(FaceId::new(face)).domain().unwrap();
        let uv = domain.min.lerp(domain.max, 0.37);
        let of = field.gradient(&model, &[face], &[uv], &pool).unwrap();
        let value = |uv: DVec2| {
            let row = field.evaluate(0, &[face], &[uv], OutsideRule::Fail, &pool).unwrap().rows[0];
            (model.carrier(FaceId::new(face)).points(&[uv])[0], row)
        };
        for along in [DVec2::X, DVec2::Y] {
            let [(p, f), (q, g)] = [uv - step * along, uv + step * along].map(value);
            let told = DVec3::from_slice(&of).dot(q - p);
            // third derivatives of patches of a few units times the step squared, and rounding
            assert!((g - f - told).abs() <= 1e-13 + 1e-7 * (g - f).abs(), "face {face}: {} {told}", g - f);
        }
    }
}

#[test]
fn a_sample_splits_cells_until_it_keeps_the_tolerance() {
    let (mesh, ModelFit { model, .. }) = ring_of(96, 48);
    // a wave over some two cells of the shape
    let values = values(&mesh, |p| (12.0 * p.x).sin() * (10.0 * p.y).cos());
    let options = FieldOptions::default().with_tolerance(Tolerance { value: 2e-3, ..Default::default() });
    let sample = SampleField { values: &values, dim: 1 };
    let make = |sample| ModelFieldFitter::new(&model, &mesh, &options, sample, &mut Control::new(2)).unwrap();
    let measured = [None, Some(sample)].map(|sample| {
        let fitter = make(sample);
        let field = fitter.fit(&values, 1).unwrap();
        fitter.measure(&field, &values, 1).unwrap().fit
    });
    assert!(measured[0].max_error > measured[0].tolerance, "{:?}", measured[0]);
    assert!(measured[1].max_error <= measured[1].tolerance, "{:?}", measured[1]);
    assert!(measured[1].cell_count > measured[0].cell_count);
}

#[test]
fn forces_keep_their_sum_and_their_work() {
    let (mesh, ModelFit { model, .. }) = ring();
    let mut random = Random::new(3);
    let mut vector = || DVec3::new(random.signed(), random.signed(), random.signed());
    let targets: Vec<DVec3> = mesh.points().iter().step_by(7).map(|&p| p + 0.02 * vector()).collect();
    let (transfer, report) = ModelTransfer::with_fitter(
        fitter(&mesh, &model),
        &mesh,
        &targets,
        &TransferOptions::default(),
        &mut Control::new(2),
    )
    .unwrap();
    assert!(report.max_distance <= 0.05 && report.far_count == 0, "{report:?}");
    let displacements: Vec<f64> = mesh.points().iter().flat_map(|&p| [wave(p), p.x, 1.0]).collect();
    let forces: Vec<f64> = targets.iter().flat_map(|_| vector().to_array()).collect();
    let balance = transfer.balance(&displacements, &forces, DVec3::new(0.1, 0.2, 0.3)).unwrap();
    // sums of some thousand terms, each of a solution with a condition of 1e6 at most
    assert!(balance.force_error <= 1e-13 && balance.work_error <= 1e-10, "{balance:?}");
    assert!(balance.moment_error <= balance.moment_bound * (1.0 + 1e-9), "{balance:?}");
    let mut arrived = vec![0.0; targets.len()];
    transfer.apply(&vec![2.5; mesh.points().len()], 1, &mut arrived).unwrap();
    assert!(arrived.iter().all(|x| (x - 2.5).abs() <= 1e-13));
    let mut waves = vec![0.0; targets.len()];
    transfer.apply(&values(&mesh, wave), 1, &mut waves).unwrap();
    // the wave changes by 2.2 times the distance
    assert!(waves.iter().zip(&targets).all(|(x, &p)| (x - wave(p)).abs() <= 0.12));
}

#[test]
fn masks_are_kept_and_what_does_not_fit_is_named() {
    let (mesh, ModelFit { model, .. }) = ring();
    let count = mesh.points().len();
    let is_known: Vec<bool> = (0..count).map(|node| node % 11 != 5).collect();
    let options = FieldOptions::default().with_is_known(Some(&is_known));
    let make = |model: &Model, mesh: &Mesh, options: &FieldOptions| {
        ModelFieldFitter::new(model, mesh, options, None, &mut Control::new(1))
    };
    let masked = make(&model, &mesh, &options).unwrap();
    let mut values = values(&mesh, wave);
    (0..count).filter(|node| node % 11 == 5).for_each(|node| values[node] = f64::NAN);
    let field = masked.fit(&values, 1).unwrap();
    let errors = masked.measure(&field, &values, 1).unwrap().errors;
    assert!(errors.iter().zip(&is_known).all(|(error, known)| error.is_nan() != *known));
    values[3] = f64::INFINITY;
    assert_eq!(masked.fit(&values, 1).unwrap_err(), FieldError::Fit(FitError::ValuesNotFinite { index: 3 }));
    assert!(matches!(masked.fit(&values[1..], 1), Err(FieldError::Fit(FitError::Count { .. }))));

    let other = Mesh::new(mesh.points()[..3].to_vec(), vec![[0, 1, 2]]).unwrap();
    let refused = make(&model, &other, &FieldOptions::default()).unwrap_err();
    assert_eq!(refused.kind(), ErrorKind::InvalidArgument, "{refused}");
    let fixed = FieldOptions::default().with_grid(FieldGrid::Fixed([4, 4]));
    assert!(make(&model, &mesh, &fixed).unwrap_err().to_string().contains("grid_u"));
    let unknown = crate::model::shapes::hollow_cube(false);
    assert_eq!(make(&unknown, &mesh, &FieldOptions::default()).unwrap_err(), FieldError::NotFitted);
    let chart = fit_mesh(&other, &MeshModelOptions::default(), &mut Control::new(1));
    if let Ok(chart) = chart {
        let refused = make(&chart.model, &other, &FieldOptions::default()).unwrap_err();
        assert_eq!(refused, FieldError::NoPatches);
    }
}
