//! Skins of the four row sets on one core: control points, errors, seconds; and evaluation of the result.
//!
//! `cargo bench --bench skin`

use glam::DVec2;
use planish::Control;
use planish::fit::report::Tolerance;
use planish::fit::skin::{Rows, SectionEnds, SkinFit, SkinOptions, skin};
use planish::samples::Random;
use planish::samples::rows::{RowSet, dustpan, head, screwdriver, wave};
use planish::surface::Surface;
use std::time::Instant;

/// Runs of which the median is printed.
const RUNS: usize = 9;
const POINTS: usize = 1_000_000;

fn fit(set: &RowSet, options: &SkinOptions) -> SkinFit {
    let rows = Rows { points: &set.points, counts: &set.counts, dim: 3 };
    skin(&rows, options, &mut Control::new(1)).expect("the rows are good")
}

/// The median of seconds.
fn seconds(mut run: impl FnMut()) -> f64 {
    run();
    let mut seconds: Vec<f64> = (0..RUNS)
        .map(|_| {
            let start = Instant::now();
            run();
            start.elapsed().as_secs_f64()
        })
        .collect();
    seconds.sort_by(f64::total_cmp);
    seconds[RUNS / 2]
}

fn main() {
    println!(
        "| rows | options | points | tolerance | control points | over common knots | as tensor | passes | error / tolerance | ms |\n\
         |---|---|---|---|---|---|---|---|---|---|"
    );
    let mut surface = None;
    for (name, set, value) in [
        ("dustpan", dustpan(), 1e-5),
        ("wave", wave(), 5e-4),
        ("screwdriver", screwdriver(), 1e-4),
        ("head", head(), 5e-4),
    ] {
        let tolerance = Tolerance { value, ..Tolerance::default() };
        let ends = SectionEnds::Parabolic;
        let paper = SkinOptions { tolerance, ends, extra_checks: 0, ..SkinOptions::default() };
        for (kind, options) in [
            ("paper", paper),
            ("batch", SkinOptions { batch: true, ..paper }),
            ("removal", SkinOptions { removal: true, ..paper }),
            ("between", SkinOptions { extra_checks: 3, ..paper }),
            ("certified", SkinOptions { certify: true, ..paper }),
        ] {
            let common = fit(&set, &SkinOptions { compare: true, ..options }).skin.common_count;
            let mut result = fit(&set, &options);
            let time = seconds(|| result = fit(&set, &options));
            let report = &result.report;
            println!(
                "| {name} | {kind} | {} | {value:e} | {} | {common} | {} | {} | {:.2} | {:.1} |",
                set.points.len() / 3,
                report.coefficient_count,
                result.skin.tensor_count,
                report.passes,
                report.max_error / report.tolerance,
                1e3 * time
            );
            surface = Some(result.surface);
        }
    }
    let Some(surface) = surface else { return };
    let mut random = Random::new(1);
    let uv: Vec<DVec2> = (0..POINTS).map(|_| DVec2::new(random.unit(), random.unit())).collect();
    let mut out = vec![0.0; 9 * POINTS];
    println!("\n| of the last one at random places | million points a second |\n|---|---|");
    for (name, order, width) in [("values", 0, 3), ("with first derivatives", 1, 9)] {
        let time = seconds(|| surface.eval_rows(&uv, order, &mut out[..width * POINTS]));
        println!("| {name} | {:.1} |", POINTS as f64 / time / 1e6);
    }
}
