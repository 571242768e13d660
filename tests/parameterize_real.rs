//! Real disk meshes: no map folds, and each stretches as little as in a prototype.
//!
//! Skips, and says so, where the shared meshes are not at hand.

mod common;

use planish::Control;
use planish::mesh::Mesh;
use planish::parameterize::{Border, Method, ParameterizeOptions, ParameterizeReport, Remarks, parameterize};

/// L2, Linf and area ratio.
type Row = [f64; 3];

struct Case {
    file: &'static str,
    mean_turns: Row,
    mean_circle: Row,
    harmonic_circle: Row,
    stretch_turns: Row,
    stretch_circle: Row,
    winner: Border,
}

const CASES: [Case; 7] = [
    Case {
        file: "blow_shell_displacement.ply",
        mean_turns: [1.44, 2.03, 1.17],
        mean_circle: [2.08, 49.7, 81.0],
        harmonic_circle: [2.1, 49.7, 80.5],
        stretch_turns: [1.44, 2.03, 1.14],
        stretch_circle: [1.98, 49.7, 75.8],
        winner: Border::SquareByTurns,
    },
    Case {
        file: "maxface_disk_4k.off",
        mean_turns: [1.22, 5.92, 127.0],
        mean_circle: [1.13, 7.49, 52.1],
        harmonic_circle: [1.13, 7.64, 52.0],
        stretch_turns: [1.08, 2.21, 7.97],
        stretch_circle: [1.04, 2.48, 3.32],
        winner: Border::Circle,
    },
    Case {
        file: "neon_side_holes_16k.off",
        mean_turns: [1.85, 33.4, 457.0],
        mean_circle: [1.6, 39.6, 138.0],
        harmonic_circle: [1.61, 42.0, 143.0],
        stretch_turns: [1.6, 8.35, 53.9],
        stretch_circle: [1.24, 6.281, 11.7],
        winner: Border::Circle,
    },
    Case {
        file: "igea_disk_43k.ply",
        mean_turns: [10.6, 54.9, 1.8e5],
        mean_circle: [7.08, 17.8, 2.5e4],
        harmonic_circle: [5.08, 13.6, 1.07e4],
        stretch_turns: [1.47, 35.0, 286.0],
        stretch_circle: [1.32, 7.53, 84.1],
        winner: Border::Circle,
    },
    Case {
        file: "camelhead_disk_11k.off",
        mean_turns: [7.85, 125.0, 6.4e4],
        mean_circle: [7.71, 125.0, 3.2e4],
        harmonic_circle: [16.1, 294.0, 1.08e6],
        stretch_turns: [1.64, 7.31, 138.0],
        stretch_circle: [1.62, 6.16, 255.0],
        winner: Border::Circle,
    },
    Case {
        file: "mannequin_disk_13k.off",
        mean_turns: [13.2, 211.0, 9.8e5],
        mean_circle: [14.2, 238.0, 3.5e5],
        harmonic_circle: [19.0, 8.26e3, 5.8e6],
        stretch_turns: [1.57, 144.0, 239.0],
        stretch_circle: [1.43, 417.0, 125.0],
        winner: Border::Circle,
    },
    Case {
        file: "airplane_holes_8k.off",
        mean_turns: [5.9e7, 3.4e9, 9.6e20],
        mean_circle: [5.4e7, 3.1e9, 3.6e20],
        harmonic_circle: [5.0e7, 2.9e9, 3.2e20],
        stretch_turns: [7.74, 69.1, 1.02e4],
        stretch_circle: [189.0, 3.36e3, 5.2e6],
        winner: Border::SquareByTurns,
    },
];

fn run(mesh: &Mesh, options: ParameterizeOptions) -> ParameterizeReport {
    parameterize(mesh, &options, &mut Control::new(2)).expect("a disk").report
}

#[test]
fn maps_of_real_meshes_stretch_as_measured_and_never_fold() {
    let mut faults = Vec::new();
    for case in &CASES {
        let Some(mesh) = common::mesh(case.file) else { continue };
        let (first, full) = (ParameterizeOptions::MEAN_VALUE, ParameterizeOptions::TENSOR.with_unroll(false));
        let harmonic = first.with_method(Method::Harmonic);
        for (name, options, expected) in [
            ("mean value, turns", first.with_border(Border::SquareByTurns), case.mean_turns),
            ("mean value, circle", first.with_border(Border::Circle), case.mean_circle),
            ("harmonic, circle", harmonic.with_border(Border::Circle), case.harmonic_circle),
            ("stretch, turns", full.with_border(Border::SquareByTurns), case.stretch_turns),
            ("stretch, circle", full.with_border(Border::Circle), case.stretch_circle),
        ] {
            let report = run(&mesh, options);
            let found = [report.stretch.l2, report.stretch.max, report.stretch.area_ratio];
            eprintln!(
                "{:28} {name:18} {found:10.4?} {:3} solves {:.3} s",
                case.file, report.solves, report.seconds
            );
            let close = |(a, b): (&f64, &f64)| (a / b - 1.0).abs() < 0.03;
            if !found.iter().zip(&expected).all(close) {
                faults.push(format!("{} {name}: {found:?}, expected {expected:?}", case.file));
            }
            let folds = report.flipped_triangles + report.degenerate_triangles;
            if folds > 0 && options.method == Method::MeanValue {
                faults.push(format!("{} {name}: {folds} folds", case.file));
            }
            assert_eq!(report.remarks.contains(Remarks::FOLDED), folds > 0);
        }
        for (name, options) in [
            ("stretch, arc", full.with_border(Border::SquareByArc)),
            ("tensor preset", full),
            ("PHT preset", ParameterizeOptions::PHT),
        ] {
            let report = run(&mesh, options);
            let found = [report.stretch.l2, report.stretch.max, report.stretch.area_ratio];
            eprintln!(
                "{:28} {name:18} {found:10.4?} {:3} solves {:.3} s {:?}",
                case.file, report.solves, report.seconds, report.border
            );
            if report.flipped_triangles + report.degenerate_triangles > 0 {
                faults.push(format!("{} {name}: folds", case.file));
            }
            if options == full && report.border != case.winner {
                faults
                    .push(format!("{} auto took {:?}, expected {:?}", case.file, report.border, case.winner));
            }
        }
    }
    assert!(faults.is_empty(), "{faults:#?}");
}

#[test]
fn a_harmonic_map_of_a_head_reports_its_flips() {
    let Some(mesh) = common::mesh("mannequin_disk_13k.off") else { return };
    let report = run(&mesh, ParameterizeOptions::HARMONIC.with_border(Border::Circle));
    assert_eq!(report.flipped_triangles, 3);
    assert!(report.remarks.contains(Remarks::FOLDED));
}

#[test]
fn maps_of_samples_never_fold_and_stretch_steps_even_them_out() {
    for name in ["bust", "limb"] {
        let Some(mesh) = common::mesh(name) else { continue };
        for border in [Border::Circle, Border::SquareByTurns, Border::SquareByArc] {
            let first = run(&mesh, ParameterizeOptions::MEAN_VALUE.with_border(border));
            let full = run(&mesh, ParameterizeOptions::TENSOR.with_unroll(false).with_border(border));
            for report in [&first, &full] {
                assert_eq!(report.flipped_triangles + report.degenerate_triangles, 0, "{name}, {border:?}");
                assert!(!report.remarks.contains(Remarks::FOLDED));
            }
            assert!(full.stretch.l2 <= first.stretch.l2, "{name}, {border:?}: {full:?}");
        }
    }
}
