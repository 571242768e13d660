//! Fields fitted again and again: the fit that sets a fitter up, and further fields with and without a report.
//!
//! `cargo bench --bench field`

use glam::DVec2;
use planish::Control;
use planish::fit::field::{FieldFitter, FieldGrid, FieldOptions};
use planish::samples::Random;
use std::time::Instant;

/// Runs of which the median is printed.
const RUNS: usize = 9;
const THREADS: usize = 2;
const GRID: usize = 65;

/// The median and the range of milliseconds.
fn milliseconds(mut run: impl FnMut()) -> String {
    let mut times: Vec<f64> = (0..RUNS)
        .map(|_| {
            let start = Instant::now();
            run();
            1e3 * start.elapsed().as_secs_f64()
        })
        .collect();
    times.sort_by(f64::total_cmp);
    format!("{:8.2} ({:.2} to {:.2})", times[RUNS / 2], times[0], times[RUNS - 1])
}

fn main() {
    println!("| nodes | set up and fit | another field | with its report |\n|---|---|---|---|");
    for count in [45_000, 180_000, 1_400_000] {
        let mut random = Random::new(1);
        let uv: Vec<DVec2> = (0..count).map(|_| DVec2::new(random.unit(), random.unit())).collect();
        let field = |phase: f64| -> Vec<f64> {
            uv.iter().flat_map(|p| [p.x, p.y, (9.0 * p.x + phase).sin() * (7.0 * p.y).cos()]).collect()
        };
        let fields = [0.0, 0.1, 0.2].map(field);
        let options = FieldOptions { grid: FieldGrid::Fixed([GRID; 2]), ..FieldOptions::default() };
        let make = || FieldFitter::at(&uv, &options, &mut Control::new(THREADS)).expect("the data fit");
        let set_up = milliseconds(|| {
            make().fit(&fields[0], 3).expect("the data fit");
        });
        let fitter = make();
        let mut surface = fitter.fit(&fields[0], 3).expect("the data fit");
        let mut step = 0;
        let another = milliseconds(|| {
            step += 1;
            fitter.update(&mut surface, &fields[step % 3], 3).expect("the data fit");
        });
        let reported = milliseconds(|| {
            step += 1;
            fitter.update(&mut surface, &fields[step % 3], 3).expect("the data fit");
            let report = fitter.measure(&surface, &fields[step % 3], 3).expect("the data fit");
            assert!(report.fit.max_error < 1e-3);
        });
        println!("| {count} | {set_up} | {another} | {reported} |");
    }
}
