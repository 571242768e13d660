//! Tensor fits of mesh files: map, stretch, grid, coefficients, errors, seconds.
//!
//! `cargo bench --bench tensor_fit -- [--tolerance T] [--ignore-parameters] FILE...`

use planish::Control;
use planish::fit::report::Tolerance;
use planish::fit::tensor::{TensorOptions, fit_mesh};
use planish::mesh::{MeshOptions, read};
use std::path::Path;

fn main() {
    let mut tolerances = vec![1e-2, 1e-3];
    let mut files = Vec::new();
    let mut ignores_parameters = false;
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--bench" => {}
            "--ignore-parameters" => ignores_parameters = true,
            "--tolerance" => {
                let value = arguments.next().and_then(|value| value.parse().ok());
                tolerances = vec![value.expect("--tolerance needs a number")];
            }
            _ => files.push(argument),
        }
    }
    println!(
        "{:24} {:>7} {:>7} {:>9} {:>6} {:>9} {:>9} {:>9} {:>9} {:>6} {:>6} {:?}",
        "mesh",
        "nodes",
        "tol",
        "grid",
        "coeff",
        "max",
        "rms",
        "interior",
        "sagitta",
        "map s",
        "fit s",
        "stop"
    );
    for file in files {
        let (mut mesh, _) = read(Path::new(&file), &MeshOptions::default()).expect("the file is a mesh");
        if ignores_parameters {
            mesh.clear_parameters();
        }
        for &value in &tolerances {
            let options = TensorOptions {
                tolerance: Tolerance { value, ..Tolerance::default() },
                ..TensorOptions::default()
            };
            let name = file.rsplit('/').next().unwrap_or(&file);
            match fit_mesh(&mesh, &options, &mut Control::new(2)) {
                Err(error) => println!("{name:24} {error}"),
                Ok(fit) => {
                    let r = fit.report;
                    let relative = |error: f64| error / r.diagonal;
                    println!(
                        "{name:24} {:7} {value:7.0e} {:>9} {:6} {:9.2e} {:9.2e} {:9.2e} {:9.2e} {:6.2} {:6.2} {:?} stretch {:.2} flips {} mu {:.0e} {:?}",
                        mesh.points().len(),
                        format!("{}x{}", r.grid_u, r.grid_v),
                        r.coefficient_count,
                        relative(r.max_error),
                        relative(r.rms_error),
                        relative(r.max_interior_error),
                        relative(r.facet_sagitta),
                        r.parameterize_seconds,
                        r.seconds - r.parameterize_seconds,
                        r.stop,
                        r.stretch,
                        r.flipped_count,
                        r.smoothing,
                        r.remarks,
                    );
                }
            }
        }
    }
}
