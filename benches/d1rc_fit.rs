//! D1RC fits of mesh files, and the same control meshes with plain vertices as control points.
//!
//! `cargo bench --bench d1rc_fit -- [--tolerance T] [--control N] [--degree K] [--smoothing MU] [--sweeps N]
//! [--sharp-angle DEGREES] FILE...`
//!
//! `plain`: errors of the surface whose control points are the vertices of the control mesh.

use planish::Control;
use planish::fit::d1rc::{D1rcFit, D1rcFitOptions, fit_mesh};
use planish::fit::errors::{DataErrors, data_errors};
use planish::fit::report::Tolerance;
use planish::mesh::{Mesh, MeshOptions, read};
use planish::surface::d1rc::{D1rcOptions, D1rcSurface};
use std::path::Path;
use std::time::Instant;

fn main() {
    let mut options = D1rcFitOptions::default();
    let mut files = Vec::new();
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        let mut number = || -> f64 {
            let value = arguments.next().and_then(|value| value.parse().ok());
            value.unwrap_or_else(|| panic!("{argument} needs a number"))
        };
        match argument.as_str() {
            "--bench" => {}
            "--tolerance" => options.tolerance = Tolerance { value: number(), ..Tolerance::default() },
            "--control" => options.control_count = number() as usize,
            "--degree" => options.surface = D1rcOptions::default().with_degree(number() as usize),
            "--smoothing" => options.smoothing = number(),
            "--sweeps" => options.correction_sweeps = number() as usize,
            "--sharp-angle" => options.sharp_angle = Some(number().to_radians()),
            _ => files.push(argument),
        }
    }
    println!(
        "| mesh | nodes | control vertices | max | rms | plain, max | plain, rms | between | facets | sharp edges | passes | map, s | \
         fit, s |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|"
    );
    for file in files {
        let (mesh, _) = read(Path::new(&file), &MeshOptions::default()).expect("the file is a mesh");
        let name = file.rsplit('/').next().unwrap_or(&file);
        let start = Instant::now();
        match fit_mesh(&mesh, &options, &mut Control::new(2)) {
            Err(error) => println!("{name:24} {error} ({:.2} s)", start.elapsed().as_secs_f64()),
            Ok(fit) => print_row(name, &mesh, &fit),
        }
    }
}

fn print_row(name: &str, mesh: &Mesh, fit: &D1rcFit) {
    let r = &fit.report;
    let relative = |error: f64| error / r.diagonal;
    let plain = plain(mesh, fit);
    println!(
        "| {name} | {} | {} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {} | {} | {:.2} | {:.2} |",
        mesh.points().len(),
        r.coefficient_count,
        relative(r.max_error),
        relative(r.rms_error),
        relative(plain.max),
        relative(plain.rms),
        relative(r.max_interior_error),
        relative(r.facet_sagitta),
        fit.sharp_edges.len(),
        r.passes,
        r.parameterize_seconds,
        r.seconds - r.parameterize_seconds,
    );
}

/// Errors at the parameters of the fit with the vertices that the control mesh kept as control points.
fn plain(mesh: &Mesh, fit: &D1rcFit) -> DataErrors {
    let (recipe, control_mesh) = (fit.surface.space().recipe(), &fit.control_mesh);
    let surface = D1rcSurface::from_mesh(control_mesh, &recipe.options, &fit.sharp_edges, &[]);
    let surface = surface.expect("the fit began with it");
    let values: Vec<f64> = mesh.points().iter().flat_map(|p| p.to_array()).collect();
    data_errors(&surface, &fit.parameters, &values, Control::new(2).pool())
}
