//! Values between two unlike triangulations of a quarter of a cylinder, radius 1 and height pi/2, over the square of its
//! angle and height: set-up, both directions, and the error of Franke's function at the targets.
//!
//! `cargo bench --bench transfer`; with `-- --write FOLDER` the nodes and what came out are written there as doubles,
//! for `benches/peers/transfer.py`.

use glam::DVec2;
use planish::Control;
use planish::fit::field::transfer::{Carry, Transfer, TransferOptions};
use planish::fit::field::{FieldGrid, FieldOptions};
use planish::mesh::Mesh;
use planish::samples::{cylinder_patch, franke};
use planish::summary::summarize;
use std::f64::consts::FRAC_PI_2;
use std::path::Path;
use std::time::Instant;

/// Runs of which the median is printed.
const RUNS: usize = 9;
const SOURCE_COUNT: usize = 32_681;
const TARGET_COUNT: usize = 98_284;

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
    format!("{:.1} ({:.1} to {:.1})", times[RUNS / 2], times[0], times[RUNS - 1])
}

fn field(mesh: &Mesh) -> Vec<f64> {
    let uv = mesh.parameters().expect("the sample has parameters");
    uv.iter().map(|&uv| franke(uv / DVec2::splat(FRAC_PI_2))).collect()
}

fn measure(source: &Mesh, target: &Mesh, grid: FieldGrid, threads: usize) -> Vec<f64> {
    let field_options = FieldOptions { grid, ..FieldOptions::default() };
    let options = TransferOptions { field: field_options, ..TransferOptions::default() };
    let make =
        || Transfer::new(source, target.points(), &options, &mut Control::new(threads)).expect("they fit");
    let set_up = milliseconds(|| {
        make();
    });
    let (transfer, report) = make();
    let (values, exact) = (field(source), field(target));
    let (mut there, mut back) = (vec![0.0; TARGET_COUNT], vec![0.0; SOURCE_COUNT]);
    let apply = milliseconds(|| transfer.apply(&values, 1, &mut there).expect("values fit"));
    let transpose = milliseconds(|| transfer.apply_transpose(&exact, 1, &mut back).expect("forces fit"));
    let errors = summarize(there.iter().zip(&exact).map(|(a, b)| (a - b).abs()).collect());
    let displacements: Vec<f64> = values.iter().flat_map(|x| [*x, -0.5 * x, 0.3]).collect();
    let forces: Vec<f64> = exact.iter().flat_map(|x| [0.1, *x, x * x]).collect();
    let balance = transfer.balance(&displacements, &forces, glam::DVec3::ZERO).expect("both fit");
    println!(
        "| {} x {} | {threads} | {set_up} | {apply} | {transpose} | {:.2e} | {:.2e} | {:.1e} | {:.1e}, {:.1e} | {:.1e} of {:.1e} |",
        report.shape.grid_u,
        report.shape.grid_v,
        errors.max,
        errors.rms,
        report.max_distance,
        balance.force_error,
        balance.work_error,
        balance.moment_error,
        balance.moment_bound
    );
    there
}

fn write(folder: &Path, name: &str, numbers: impl Iterator<Item = f64>) {
    let bytes: Vec<u8> = numbers.flat_map(f64::to_le_bytes).collect();
    std::fs::write(folder.join(name), bytes).expect("the folder can be written to");
}

fn main() {
    let source = cylinder_patch(SOURCE_COUNT, 1).expect("the sample is a mesh");
    let target = cylinder_patch(TARGET_COUNT, 2).expect("the sample is a mesh");
    assert_eq!((source.points().len(), target.points().len()), (SOURCE_COUNT, TARGET_COUNT));
    println!(
        "| knots | threads | set up, ms | there, ms | back, ms | largest error | rms | largest distance | forces, work | moments |\n\
         |---|---|---|---|---|---|---|---|---|---|"
    );
    let mut carried = Vec::new();
    for grid in [FieldGrid::Auto, FieldGrid::Fixed([97, 97]), FieldGrid::Fixed([129, 129])] {
        for threads in [1, 2] {
            carried = measure(&source, &target, grid, threads);
        }
    }
    let arguments: Vec<String> = std::env::args().collect();
    let Some(place) = arguments.iter().position(|argument| argument == "--write") else { return };
    let folder = Path::new(&arguments[place + 1]);
    for (name, mesh) in [("source", &source), ("target", &target)] {
        let uv = mesh.parameters().expect("the sample has parameters");
        let rows = mesh.points().iter().zip(uv).zip(field(mesh));
        let numbers = rows.flat_map(|((p, uv), f)| [p.x, p.y, p.z, uv.x, uv.y, f]);
        write(folder, &format!("transfer_{name}.f64"), numbers);
    }
    write(folder, "transfer_carried.f64", carried.into_iter());
}
