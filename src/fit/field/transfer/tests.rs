//! Transfers: what they reproduce, what they keep, and that one direction is the transpose of the other.

use super::*;
use crate::failure::Classify;
use crate::fit::common::Missing;
use crate::fit::field::FieldGrid;
use crate::samples::{self, Random};
use crate::surface::Surface;

fn fixed(counts: [usize; 2]) -> TransferOptions<'static> {
    let field = FieldOptions { grid: FieldGrid::Fixed(counts), ..FieldOptions::default() };
    TransferOptions { field, ..TransferOptions::default() }
}

/// Two unlike triangulations of the same patch.
fn meshes() -> (Mesh, Mesh) {
    (samples::cylinder_patch(3000, 1).unwrap(), samples::cylinder_patch(5000, 2).unwrap())
}

fn between(source: &Mesh, target: &Mesh, options: &TransferOptions) -> Transfer {
    Transfer::new(source, target.points(), options, &mut Control::new(2)).unwrap().0
}

fn random_rows(count: usize, seed: u64) -> Vec<f64> {
    let mut random = Random::new(seed);
    (0..count).map(|_| random.signed()).collect()
}

#[test]
fn values_are_those_of_the_fitted_field_at_the_targets() {
    let (source, target) = meshes();
    let transfer = between(&source, &target, &fixed([17, 33]));
    let values: Vec<f64> = source.points().iter().flat_map(|p| [p.x * p.z, 300.0 + p.y]).collect();
    let mut out = vec![0.0; 2 * target.points().len()];
    transfer.apply(&values, 2, &mut out).unwrap();
    let field = transfer.fitter.fit(&values, 2).unwrap();
    let mut exact = vec![0.0; out.len()];
    field.eval_rows(transfer.parameters().unwrap(), 0, &mut exact);
    for (x, exact) in out.iter().zip(&exact) {
        // the same equations in another frame: their condition with a smoothing of 1e-6 magnifies roundings of
        // numbers of about 1
        assert!((x - exact).abs() <= 1e-9, "{x} is not {exact}");
    }
}

#[test]
fn constants_arrive_as_they_are() {
    let (source, target) = meshes();
    let transfer = between(&source, &target, &fixed([9, 9]));
    let values = vec![1.0 / 3.0; source.points().len()];
    let mut out = vec![0.0; target.points().len()];
    transfer.apply(&values, 1, &mut out).unwrap();
    // the mean is rounded twice, and what is left of it goes through a bounded fit
    assert!(out.iter().all(|x| (x - 1.0 / 3.0).abs() <= 8.0 * f64::EPSILON), "{:?}", &out[..3]);
}

#[test]
fn forces_and_work_are_kept_to_roundoff_and_moments_to_the_distance() {
    let (source, target) = meshes();
    // a shell above the source: distances are 0.01, up to what the fit of the shape leaves
    let lifted: Vec<DVec3> = target.points().iter().map(|p| *p * DVec3::new(1.01, 1.01, 1.0)).collect();
    let about = DVec3::new(3.0, -1.0, 0.5);
    for (targets, least, most) in [(target.points(), 0.0, 1e-4), (&lifted, 0.0099, 0.0101)] {
        let control = &mut Control::new(2);
        let (transfer, report) = Transfer::new(&source, targets, &fixed([33, 33]), control).unwrap();
        assert!((least..most).contains(&report.max_distance), "{report:?}");
        let displacements = random_rows(3 * source.points().len(), 1);
        let forces = random_rows(3 * targets.len(), 2);
        let balance = transfer.balance(&displacements, &forces, about).unwrap();
        assert!(balance.force_error <= 1e-12 && balance.work_error <= 1e-12, "{balance:?}");
        let roundoff = 1e-10 * targets.len() as f64;
        assert!(balance.moment_error <= balance.moment_bound + roundoff, "{balance:?}");
        let size: f64 = forces.chunks(3).map(|f| DVec3::from_slice(f).length()).sum();
        assert!(balance.moment_bound <= report.max_distance * size * (1.0 + 1e-12), "{balance:?}");
    }
}

#[test]
fn the_transpose_is_the_transpose_entry_by_entry() {
    let (source, target) = (samples::cylinder_patch(60, 3).unwrap(), samples::cylinder_patch(41, 4).unwrap());
    // a grid so fine that triangles hold data of their own
    let transfer = between(&source, &target, &fixed([12, 9]));
    let (n, m) = (source.points().len(), target.points().len());
    let mut column = vec![0.0; m];
    let mut row = vec![0.0; n];
    let matrix: Vec<Vec<f64>> = (0..n)
        .map(|node| {
            let unit: Vec<f64> = (0..n).map(|k| f64::from(u8::from(k == node))).collect();
            transfer.apply(&unit, 1, &mut column).unwrap();
            column.clone()
        })
        .collect();
    for target in 0..m {
        let unit: Vec<f64> = (0..m).map(|k| f64::from(u8::from(k == target))).collect();
        transfer.apply_transpose(&unit, 1, &mut row).unwrap();
        for (node, x) in row.iter().enumerate() {
            // entries of about 1 through two triangular solutions
            assert!((x - matrix[node][target]).abs() <= 1e-10, "{node} {target}");
        }
        let row_sum: f64 = (0..n).map(|node| matrix[node][target]).sum();
        assert!((row_sum - 1.0).abs() <= 1e-10, "{row_sum}");
    }
}

#[test]
fn results_do_not_depend_on_threads() {
    let (source, target) = meshes();
    let (values, forces) = (random_rows(2 * 3000, 5), random_rows(2 * 5000, 6));
    let run = |threads: usize| {
        let control = &mut Control::new(threads);
        let transfer = Transfer::new(&source, target.points(), &fixed([17, 17]), control).unwrap().0;
        let (mut there, mut back) = (vec![0.0; forces.len()], vec![0.0; values.len()]);
        transfer.apply(&values, 2, &mut there).unwrap();
        transfer.apply_transpose(&forces, 2, &mut back).unwrap();
        (there, back)
    };
    assert_eq!(run(1), run(3));
}

#[test]
fn nodes_without_values_take_no_part() {
    let (source, target) = meshes();
    let is_known: Vec<bool> = (0..3000).map(|node| node % 7 != 0).collect();
    let field = FieldOptions { is_known: Some(&is_known), ..fixed([9, 9]).field };
    let transfer = between(&source, &target, &TransferOptions { field, ..TransferOptions::default() });
    let farthest = transfer.distances().iter().fold(0.0_f64, |most, &distance| most.max(distance));
    let values: Vec<f64> =
        source.points().iter().zip(&is_known).map(|(p, &known)| if known { p.z } else { f64::NAN }).collect();
    let mut out = vec![0.0; 5000];
    transfer.apply(&values, 1, &mut out).unwrap();
    // heights are linear in the parameters, which the fit reproduces: each is that of the foot point
    let error = out.iter().zip(target.points()).map(|(x, p)| (x - p.z).abs()).fold(0.0, f64::max);
    assert!(error <= farthest + 1e-9 && farthest < 1e-3, "{error} {farthest}");
    // a transfer that is not told where there are values finds out
    let field = fixed([9, 9]).field.with_missing(Missing::Skipped);
    let skipping = between(&source, &target, &TransferOptions { field, ..TransferOptions::default() });
    let mut found = vec![0.0; 5000];
    skipping.apply(&values, 1, &mut found).unwrap();
    // the targets lie where the shape of all nodes is
    let apart = out.iter().zip(&found).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(apart <= 2.0 * farthest + 1e-9, "{apart}");
    let mut back = vec![0.0; 3000];
    transfer.apply_transpose(&out, 1, &mut back).unwrap();
    assert!(back.iter().zip(&is_known).all(|(x, &known)| known || *x == 0.0));
    let (given, arrived) = (sum(out.iter().copied()), sum(back.iter().copied()));
    assert!((given - arrived).abs() <= 1e-12 * given, "{given} {arrived}");
}

#[test]
fn far_targets_are_refused_or_counted() {
    let (source, target) = meshes();
    let mut targets = target.points().to_vec();
    targets[17] = DVec3::new(3.0, 0.0, 1.0);
    let options = fixed([9, 9]);
    let refused = Transfer::new(&source, &targets, &options, &mut Control::new(1)).unwrap_err();
    let TransferError::Far { index: 17, distance, limit } = refused else { panic!("{refused}") };
    assert!((distance - 2.0).abs() < 1e-3 && (limit / (0.05 * 4.4674_f64.sqrt()) - 1.0).abs() < 1e-3);
    let keep = TransferOptions { far: FarRule::Keep, ..options };
    let (_, report) = Transfer::new(&source, &targets, &keep, &mut Control::new(1)).unwrap();
    assert_eq!((report.far_count, report.farthest_index), (1, 17));
    targets[16].y = f64::NAN;
    let refused = Transfer::new(&source, &targets, &options, &mut Control::new(1)).unwrap_err();
    assert_eq!(refused, TransferError::NotFinite { index: 16 });
    let negative = TransferOptions { max_distance: -1.0, ..options };
    let refused = Transfer::new(&source, target.points(), &negative, &mut Control::new(1)).unwrap_err();
    assert_eq!(refused, TransferError::MaxDistance { value: -1.0 });
}

#[test]
fn wrong_arrays_are_refused() {
    let (source, target) = meshes();
    let transfer = between(&source, &target, &fixed([5, 5]));
    let mut values = vec![0.0; 3000];
    let mut out = vec![0.0; 5000];
    let short = transfer.apply(&values[1..], 1, &mut out).unwrap_err();
    let expected = FitError::Count { what: "the values", count: 2999, expected: 3000 };
    assert_eq!(short, TransferError::Fit(expected));
    assert!(transfer.apply(&values, 1, &mut out[1..]).is_err());
    assert!(transfer.apply_transpose(&out, 0, &mut values).is_err());
    values[42] = f64::INFINITY;
    assert_eq!(transfer.apply(&values, 1, &mut out).unwrap_err().index(), Some(42));
    out[43] = f64::NAN;
    assert_eq!(transfer.apply_transpose(&out, 1, &mut values).unwrap_err().index(), Some(43));
}
