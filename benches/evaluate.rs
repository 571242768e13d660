//! Evaluation of bicubic surfaces on one core: million points a second.
//!
//! `cargo bench --bench evaluate`

use glam::DVec2;
use planish::knots::KnotVector;
use planish::samples::Random;
use planish::surface::Surface;
use planish::surface::tensor::TensorSurface;
use std::time::Instant;

/// Runs of which the median is printed.
const RUNS: usize = 5;
const POINTS: usize = 1_000_000;

fn surface(counts: [usize; 2], is_uniform: bool) -> TensorSurface {
    let mut random = Random::new(1);
    let mut knots = |count: usize| {
        let mut t = 0.0;
        let breaks: Vec<f64> = (0..count - 2)
            .map(|_| {
                t += if is_uniform { 1.0 } else { 0.1 + random.unit() };
                t
            })
            .collect();
        KnotVector::clamped(&breaks, 3).expect("breaks rise")
    };
    let (knots_u, knots_v) = (knots(counts[0]), knots(counts[1]));
    let points = (0..3 * counts[0] * counts[1]).map(|_| random.signed()).collect();
    TensorSurface::new(3, knots_u, knots_v, points, None).expect("counts agree")
}

/// The median of million points a second.
fn rate(points: usize, mut run: impl FnMut()) -> f64 {
    run();
    let mut seconds: Vec<f64> = (0..RUNS)
        .map(|_| {
            let start = Instant::now();
            run();
            start.elapsed().as_secs_f64()
        })
        .collect();
    seconds.sort_by(f64::total_cmp);
    points as f64 / seconds[RUNS / 2] / 1e6
}

fn main() {
    println!(
        "| control points | knots | random | random, with first derivatives | row by row | row by row, with first \
         derivatives | grid |\n|---|---|---|---|---|---|---|"
    );
    for counts in [[65, 17], [200, 200], [1000, 1000]] {
        for is_uniform in [true, false] {
            let surface = surface(counts, is_uniform);
            let domain = surface.domain();
            let mut random = Random::new(2);
            let mut uv: Vec<DVec2> = (0..POINTS)
                .map(|_| domain.min + DVec2::new(random.unit(), random.unit()) * domain.size())
                .collect();
            let mut out = vec![0.0; 9 * POINTS];
            let mut rates = Vec::new();
            for is_ordered in [false, true] {
                if is_ordered {
                    for (k, uv) in uv.iter_mut().enumerate() {
                        let share = DVec2::new((k / 1000) as f64, (k % 1000) as f64) / 1000.0;
                        *uv = domain.min + share * domain.size();
                    }
                }
                rates.push(rate(POINTS, || surface.eval_rows(&uv, 0, &mut out[..3 * POINTS])));
                rates.push(rate(POINTS, || surface.eval_rows(&uv, 1, &mut out)));
            }
            let line = |axis: usize| -> Vec<f64> {
                (0..1000).map(|k| domain.min[axis] + k as f64 / 1000.0 * domain.size()[axis]).collect()
            };
            let (u, v) = (line(0), line(1));
            rates.push(rate(POINTS, || surface.eval_grid(&u, &v, &mut out[..3 * POINTS])));
            let name = format!("{} x {}", counts[0], counts[1]);
            let knots = if is_uniform { "uniform" } else { "arbitrary" };
            let rates: Vec<String> = rates.iter().map(|rate| format!("{rate:.1}")).collect();
            println!("| {name} | {knots} | {} |", rates.join(" | "));
        }
    }
}
