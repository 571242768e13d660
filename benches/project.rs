//! Closest points: projections a second, on one core, near the surface and far from it.
//!
//! `cargo bench --bench project`

use glam::{DVec2, DVec3};
use planish::Control;
use planish::control::Pool;
use planish::fit::report::Tolerance;
use planish::fit::tensor::{TensorOptions, fit_mesh};
use planish::knots::KnotVector;
use planish::mesh::{Mesh, MeshOptions, read};
use planish::query::project::{ProjectOptions, Projector};
use planish::samples::{Random, curved_notch, sphere_with_holes};
use planish::surface::Surface;
use planish::surface::tensor::TensorSurface;
use std::path::Path;
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
    println!(
        "| cells | distance | points | points a second | slowest / fastest run | with a start, times as fast |\n|---|---|---|---|---|---|"
    );
    for cells in [64, 16] {
        let surface = surface(cells);
        let projector = Projector::new(&surface).expect("a tensor surface has patches");
        for (distance, count) in
            [(0.0, 100_000), (1e-3, 100_000), (1e-2, 50_000), (1e-1, 20_000), (1.0, 5_000)]
        {
            let points = around(&surface, count, distance * 1.5);
            let (median, spread) = timed(|| run(&projector, &points, &ProjectOptions::default()));
            let near: Vec<DVec2> = starts(&projector, &points);
            let guessed = ProjectOptions { guesses: Some(&near), ..ProjectOptions::default() };
            let (with_start, _) = timed(|| run(&projector, &points, &guessed));
            println!(
                "| {cells} x {cells} | {distance:.0e} | {count} | {:.0} | {spread:.2} | {:.2} |",
                count as f64 / median,
                median / with_start
            );
        }
    }
    trimmed();
}

/// Median and spread of some runs.
fn timed(mut run: impl FnMut() -> f64) -> (f64, f64) {
    let mut seconds: Vec<f64> = (0..RUNS).map(|_| run()).collect();
    seconds.sort_by(f64::total_cmp);
    (seconds[RUNS / 2], seconds[RUNS - 1] / seconds[0])
}

/// The answers, off by a thousandth of the domain.
fn starts(projector: &Projector, points: &[f64]) -> Vec<DVec2> {
    let mut random = Random::new(4);
    let answers =
        projector.project(points, &ProjectOptions::default(), &Pool::new(1)).expect("finite points");
    answers.uv.iter().map(|uv| uv + 1e-3 * DVec2::new(random.signed(), random.signed())).collect()
}

/// What trims cost, on fits of meshes with holes: the nodes, and points at distances up to two diagonals.
fn trimmed() {
    println!("\n| fit | points | us inside | us whole | ratio |\n|---|---|---|---|---|");
    for (name, mesh) in holed() {
        let tolerance = Tolerance { value: 1e-2, ..Tolerance::default() };
        let options = TensorOptions { tolerance, ..TensorOptions::default() };
        let fit = fit_mesh(&mesh, &options, &mut Control::new(0)).expect("a fit");
        let projector = Projector::new(&fit.surface).expect("a tensor surface has patches");
        let nodes: Vec<f64> = mesh.points().iter().flat_map(|p| p.to_array()).collect();
        let mut random = Random::new(9);
        let mut scatter = |p: &DVec3| {
            let direction = DVec3::new(random.signed(), random.signed(), random.signed()).normalize_or_zero();
            *p + 2.0 * fit.report.diagonal * 10f64.powf(-5.0 * random.unit()) * direction
        };
        let far: Vec<f64> = mesh.points().iter().step_by(4).flat_map(|p| scatter(p).to_array()).collect();
        for (kind, points) in [("nodes", nodes), ("scattered", far)] {
            let cost = |keep_trims: bool| {
                let options = ProjectOptions { keep_trims, ..ProjectOptions::default() };
                1e6 * timed(|| run(&projector, &points, &options)).0 / (points.len() / 3) as f64
            };
            let (inside, whole) = (cost(true), cost(false));
            println!(
                "| {name}, {kind} | {} | {inside:.2} | {whole:.2} | {:.2} |",
                points.len() / 3,
                inside / whole
            );
        }
    }
}

fn holed() -> Vec<(String, Mesh)> {
    let samples = [("sphere", sphere_with_holes(3000, 2)), ("notch", curved_notch(3))];
    let mut all: Vec<(String, Mesh)> =
        samples.into_iter().map(|(name, mesh)| (name.to_owned(), mesh.expect("a mesh"))).collect();
    for name in ["neon_side_holes_16k.off", "airplane_holes_8k.off", "igea_disk_43k.ply"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data").join(name);
        if let Ok((mesh, _)) = read(&path, &MeshOptions::default()) {
            all.push((name.split('_').next().unwrap_or(name).to_owned(), mesh));
        }
    }
    all
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

fn run(projector: &Projector, points: &[f64], options: &ProjectOptions) -> f64 {
    let start = Instant::now();
    let result = projector.project(points, options, &Pool::new(1)).expect("finite points");
    let seconds = start.elapsed().as_secs_f64();
    assert_eq!((result.missed(), result.unproven()), (0, 0));
    seconds
}
