//! PHT fits: coefficients, levels, errors, held-out errors, seconds, peak memory; conversion, evaluation.
//!
//! `cargo bench --bench pht -- [fits | points | meshes | convert | evaluate] DATA`, DATA the folder of shapes. Peak memory is that
//! of a process, so each fit runs in one of its own.

use glam::DVec2;
use planish::Control;
use planish::fit::pht::{Estimator, PhtFit, PhtOptions, fit_mesh, fit_points};
use planish::fit::report::Tolerance;
use planish::mesh::{MeshOptions, read};
use planish::surface::Surface;
use std::path::Path;
use std::process::Command;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| a != "--bench").collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words.as_slice() {
        ["one", file, tolerance, held @ ..] => {
            one(file, tolerance.parse().expect("a tolerance"), held.first())
        }
        ["points", folder] => points(folder),
        ["meshes", folder] => meshes(folder),
        _ => println!("cargo bench --bench pht -- points DATA | meshes DATA | one FILE TOLERANCE [HELD]"),
    }
}

/// Runs a fit in a process of its own.
fn apart(arguments: &[&str]) {
    let program = std::env::current_exe().expect("a program");
    let status = Command::new(program).arg("one").args(arguments).status();
    assert!(status.is_ok_and(|status| status.success()), "{arguments:?}");
}

fn points(folder: &str) {
    let at = |name: &str| format!("{folder}/synthetic/{name}");
    apart(&[&at("ridges_45k.f64"), "1e-3", &at("ridges_held_100k.f64")]);
    for tolerance in ["1.5e-3", "1e-4"] {
        apart(&[&at("rough_4k_noise.f64"), tolerance]);
    }
    apart(&[&at("rough_4k.f64"), "1e-3"]);
}

fn meshes(folder: &str) {
    for name in [
        "maxface_disk_4k.off",
        "camelhead_disk_11k.off",
        "neon_side_holes_16k.off",
        "mannequin_disk_13k.off",
        "igea_disk_43k.ply",
        "airplane_holes_8k.off",
    ] {
        for tolerance in ["1e-2", "1e-3"] {
            apart(&[&format!("{folder}/{name}"), tolerance]);
        }
    }
}

/// Rows of u, v, x, y, z as little-endian doubles.
fn read_points(file: &str) -> (Vec<DVec2>, Vec<f64>) {
    let bytes = std::fs::read(file).expect("a file of points");
    let numbers: Vec<f64> =
        bytes.chunks_exact(8).map(|x| f64::from_le_bytes(x.try_into().expect("8"))).collect();
    let rows = numbers.chunks_exact(5);
    (rows.clone().map(DVec2::from_slice).collect(), rows.flat_map(|row| row[2..].to_vec()).collect())
}

fn one(file: &str, value: f64, held: Option<&&str>) {
    let estimator = match std::env::var("ESTIMATOR").as_deref() {
        Ok("quadratic") => Estimator::LocalQuadratic,
        Ok("cubic") => Estimator::LocalCubic,
        _ => Estimator::Global,
    };
    let options = PhtOptions {
        tolerance: Tolerance { value, ..Tolerance::default() },
        estimator,
        ..PhtOptions::default()
    };
    let name = file.rsplit('/').next().unwrap_or(file);
    let mut control = Control::new(2);
    let fit = if file.ends_with(".f64") {
        let (uv, values) = read_points(file);
        fit_points(&uv, &values, 3, &options, &mut control)
    } else {
        let (mut mesh, _) = read(Path::new(file), &MeshOptions::default()).expect("the file is a mesh");
        mesh.clear_parameters();
        fit_mesh(&mesh, &options, &mut control)
    };
    match fit {
        Err(error) => println!("{name:24} {value:7.1e} {error}"),
        Ok(fit) => row(name, value, &fit, held.map(|held| held_out(&fit, held))),
    }
}

fn held_out(fit: &PhtFit, file: &str) -> f64 {
    let (uv, values) = read_points(file);
    let mut rows = vec![0.0; values.len()];
    fit.surface.eval_rows(&uv, 0, &mut rows);
    let square = |(a, b): (&[f64], &[f64])| a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>();
    let largest = rows.chunks_exact(3).zip(values.chunks_exact(3)).map(square).fold(0.0, f64::max);
    largest.sqrt() / fit.report.diagonal
}

fn row(name: &str, value: f64, fit: &PhtFit, held: Option<f64>) {
    let r = &fit.report;
    let relative = |error: f64| error / r.diagonal;
    println!(
        "{name:24} {value:7.1e} {:6} coefficients {:6} cells level {:2} max {:8.2e} rms {:8.2e} held {:8.2e} interior {:8.2e} sagitta {:8.2e} map {:5.2} s fit {:6.3} s {:4} MB {} passes {:?} rough {} flips {} stretch {:.2} {:?}",
        r.coefficient_count,
        r.cell_count,
        r.deepest_level,
        relative(r.max_error),
        relative(r.rms_error),
        held.unwrap_or(f64::NAN),
        relative(r.max_interior_error),
        relative(r.facet_sagitta),
        r.parameterize_seconds,
        r.seconds - r.parameterize_seconds,
        peak_megabytes(),
        r.passes,
        r.stop,
        r.rough_cell_count,
        r.flipped_count,
        r.stretch,
        r.remarks,
    );
}

/// The most memory this process has held.
fn peak_megabytes() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find(|line| line.starts_with("VmHWM:")).unwrap_or_default();
    line.split_whitespace().nth(1).and_then(|kilobytes| kilobytes.parse::<u64>().ok()).unwrap_or(0) / 1024
}
