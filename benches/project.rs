//! Closest points: projections a second, on one core, near the surface and far from it.
//!
//! `cargo bench --bench project`

use glam::{DVec2, DVec3};
use planish::control::Pool;
use planish::knots::KnotVector;
use planish::query::project::{ProjectOptions, Projector};
use planish::samples::Random;
use planish::surface::Surface;
use planish::surface::tensor::TensorSurface;
use std::time::Instant;

/// Runs of which the median is printed.
const RUNS: usize = 5;

/// A bicubic surface with waves and ripples over `cells` x `cells` spans.
fn surface(cells: usize) -> TensorSurface {
    let breaks: Vec<f64> = (0..=cells).map(|k| k as f64 / cells as f64).collect();
    let knots = KnotVector::clamped(&breaks, 3).expect("breaks rise");
    let mut points = Vec::new();
    for i in 0..knots.basis_count() {
        for j in 0..knots.basis_count() {
            let (u, v) = (knots.greville(i), knots.greville(j));
            let z = 0.15 * (6.0 * u).sin() * (5.0 * v).cos() + 0.01 * (40.0 * u + 25.0 * v).sin();
            points.extend([u + 0.1 * (4.0 * v).sin(), v, z]);
        }
    }
    TensorSurface::new(3, knots.clone(), knots, points, None).expect("counts agree")
}

fn main() {
    println!("{:>8} {:>10} {:>10} {:>14} {:>8}", "cells", "distance", "points", "points/s", "spread");
    for cells in [64, 16] {
        let surface = surface(cells);
        let start = Instant::now();
        let projector = Projector::new(&surface).expect("a tensor surface has patches");
        println!("{:>8} index built in {:.1} ms", cells, 1e3 * start.elapsed().as_secs_f64());
        for (distance, count) in
            [(0.0, 100_000), (1e-3, 100_000), (1e-2, 50_000), (1e-1, 20_000), (1.0, 5_000)]
        {
            let points = around(&surface, count, distance * 1.5);
            let mut seconds: Vec<f64> = (0..RUNS).map(|_| run(&projector, &points, count)).collect();
            seconds.sort_by(f64::total_cmp);
            let (median, spread) = (seconds[RUNS / 2], seconds[RUNS - 1] / seconds[0]);
            println!(
                "{cells:>8} {distance:>10.0e} {count:>10} {:>14.0} {spread:>8.2}",
                count as f64 / median
            );
        }
    }
}

/// Points at a distance from random places on the surface, in random directions.
fn around(surface: &dyn Surface, count: usize, distance: f64) -> Vec<f64> {
    let mut random = Random::new(11);
    let mut rows = Vec::with_capacity(3 * count);
    for _ in 0..count {
        let mut point = [0.0; 3];
        surface.eval_rows(&[DVec2::new(random.unit(), random.unit())], 0, &mut point);
        let direction = DVec3::new(random.signed(), random.signed(), random.signed()).normalize_or_zero();
        rows.extend((DVec3::from_array(point) + distance * direction).to_array());
    }
    rows
}

fn run(projector: &Projector, points: &[f64], count: usize) -> f64 {
    let (mut uv, mut distances) = (vec![DVec2::ZERO; count], vec![0.0; count]);
    let start = Instant::now();
    let result =
        projector.project(points, &ProjectOptions::default(), &mut uv, &mut distances, &Pool::new(1));
    let seconds = start.elapsed().as_secs_f64();
    assert_eq!(result, Ok(0));
    seconds
}
