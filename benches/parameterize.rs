//! Maps of a jittered mesh of 100,000 nodes: harmonic, mean value, one more stretch step.
//!
//! Prints the median wall time of five runs for 1 and 2 threads.

use glam::DVec3;
use planish::Control;
use planish::mesh::Mesh;
use planish::parameterize::{Border, ParameterizeOptions, parameterize};
use std::time::Instant;

const RUNS: usize = 5;

fn main() {
    let mesh = bumpy_sheet(317, 316);
    println!("{} nodes, {} triangles", mesh.points().len(), mesh.triangles().len());
    println!("| threads | harmonic, s | mean value, s | a stretch step, s |\n|---|---|---|---|");
    for threads in [1, 2] {
        let mean_value = ParameterizeOptions::MEAN_VALUE.with_border(Border::Circle);
        let harmonic =
            median(|| seconds(&mesh, &ParameterizeOptions::HARMONIC.with_border(Border::Circle), threads));
        let first = median(|| seconds(&mesh, &mean_value, threads));
        let with_step = median(|| seconds(&mesh, &mean_value.with_stretch_steps(1), threads));
        println!("| {threads} | {harmonic:.3} | {first:.3} | {:.3} |", with_step - first);
    }
}

fn seconds(mesh: &Mesh, options: &ParameterizeOptions, threads: usize) -> f64 {
    let mut control = Control::new(threads);
    let start = Instant::now();
    parameterize(mesh, options, &mut control).expect("the sheet is a disk");
    start.elapsed().as_secs_f64()
}

fn median(run: impl Fn() -> f64) -> f64 {
    let mut times: Vec<f64> = (0..RUNS).map(|_| run()).collect();
    times.sort_by(f64::total_cmp);
    times[RUNS / 2]
}

/// A wavy height field over a jittered grid, each cell cut along a random diagonal.
fn bumpy_sheet(columns: usize, rows: usize) -> Mesh {
    let mut state = 7_u64;
    let mut random = move || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let points = (0..rows * columns)
        .map(|k| {
            let x = ((k % columns) as f64 + 0.5 * random()) / columns as f64;
            let y = ((k / columns) as f64 + 0.5 * random()) / rows as f64;
            DVec3::new(x, y, 0.1 * (9.0 * x).sin() * (7.0 * y).cos())
        })
        .collect();
    let mut triangles = Vec::new();
    for row in 0..rows - 1 {
        for column in 0..columns - 1 {
            let a = (row * columns + column) as u32;
            let (b, c, d) = (a + 1, a + 1 + columns as u32, a + columns as u32);
            let halves = if random() < 0.5 { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] };
            triangles.extend(halves);
        }
    }
    Mesh::new(points, triangles).expect("a grid is a mesh")
}
