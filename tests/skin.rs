//! Skins of real rows, and of rows taken from real meshes.

mod common;

use common::shared_data;
use planish::Control;
use planish::fit::report::Remarks;
use planish::fit::skin::{Rows, SkinFit, SkinOptions, skin};
use planish::query::rows::{SampleRowsOptions, Source, sample_rows};
use planish::samples::rows::{RowSet, dustpan, head, limb, screwdriver, wave};
use std::path::Path;

/// The numbers of a file of rows, and whether its rows are closed.
fn read_rows(path: &Path) -> (RowSet, bool) {
    let text = std::fs::read_to_string(path).unwrap();
    let (mut set, mut is_closed) = (RowSet::default(), false);
    for line in text.lines().filter(|line| !line.starts_with('#')) {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words[..] {
            ["row", _, count, ..] => {
                set.counts.push(count.parse().unwrap());
                is_closed |= words.last() == Some(&"closed");
            }
            [x, y, z] => set.points.extend([x, y, z].map(|word| word.parse::<f64>().unwrap())),
            _ => {}
        }
    }
    (set, is_closed)
}

fn fit(set: &RowSet, options: &SkinOptions) -> SkinFit {
    let rows = Rows { points: &set.points, counts: &set.counts, dim: 3 };
    skin(&rows, options, &mut Control::new(2)).unwrap()
}

/// Closed rows whose first point does not stand at their end once more.
fn without_repeated_points(set: &RowSet) -> RowSet {
    let rows = (0..set.counts.len()).map(|j| &set.row(j)[..3 * (set.counts[j] - 1)]);
    RowSet {
        points: rows.flatten().copied().collect(),
        counts: set.counts.iter().map(|count| count - 1).collect(),
    }
}

#[test]
fn samples_are_the_sets_of_the_acceptance_table() {
    for (name, set) in
        [("dustpan", dustpan()), ("wave", wave()), ("screwdriver", screwdriver()), ("head", head())]
    {
        let Some(path) = shared_data(&format!("synthetic/rows_{name}.txt")) else { continue };
        let (file, _) = read_rows(&path);
        assert_eq!(file.counts, set.counts, "{name}");
        let difference = file.points.iter().zip(&set.points).map(|(a, b)| (a - b).abs());
        // the wave's density has second differences over 1/20000, which magnify roundings by 4e8
        let most = difference.fold(0.0, f64::max);
        assert!(most <= 1e-6, "{name}: {most:e}");
    }
}

#[test]
fn real_rows_need_far_fewer_control_points_than_common_knots() {
    for (name, share) in [("limb", 1.0), ("mannequin_rows_60.txt", 0.5), ("hammer_handle_rows_12.txt", 1.0)] {
        let set = match name {
            "limb" => without_repeated_points(&limb()),
            file => {
                let Some(path) = shared_data(file) else { continue };
                let (set, is_closed) = read_rows(&path);
                assert!(is_closed);
                set
            }
        };
        let options = SkinOptions { closed: true, compare: true, certify: true, ..SkinOptions::default() };
        let fit = fit(&set, &options);
        assert!(fit.report.max_error < fit.report.tolerance, "{name}: {:?}", fit.report);
        assert!(!fit.report.remarks.has(Remarks::TWISTED_ROWS), "{name}: rows are in order");
        let (own, common) = (fit.report.coefficient_count, fit.skin.common_count);
        assert!((own as f64) < share * common as f64, "{name}: {own} against {common}");
        assert!(fit.skin.certified_distance < 3.0 * fit.report.tolerance, "{name}: {:?}", fit.skin);
    }
}

#[test]
fn rows_taken_from_meshes_are_skinned() {
    for name in ["limb", "mannequin_disk_13k.off", "hammer_closed_30k.ply"] {
        let Some(mesh) = common::mesh(name) else { continue };
        let sides: Vec<f64> = mesh.bounds().sides().collect();
        let axis = (0..3).max_by(|&a, &b| sides[a].total_cmp(&sides[b])).unwrap();
        let place = |&node: &u32| mesh.points()[node as usize][axis];
        let by_place = |a: &u32, b: &u32| place(a).total_cmp(&place(b));
        let nodes = 0..mesh.points().len() as u32;
        let (lowest, highest) = (nodes.clone().min_by(by_place).unwrap(), nodes.max_by(by_place).unwrap());
        let begin = if mesh.loops().is_empty() { Source::Node(lowest) } else { Source::Loop(0) };
        let options = SampleRowsOptions { begin, end: Source::Node(highest), row_count: 40, spacing: 0.0 };
        let rows = sample_rows(&mesh, &options, &mut Control::new(1)).unwrap();
        let set =
            RowSet { points: rows.points.iter().flat_map(|p| p.to_array()).collect(), counts: rows.counts };
        let fit = fit(&set, &SkinOptions { closed: true, ..SkinOptions::default() });
        println!("{name}: {:?} {:?}", fit.report, fit.skin);
        assert!(fit.report.max_error < fit.report.tolerance, "{name}: {:?}", fit.report);
    }
}
