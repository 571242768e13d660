//! Maps of closed mesh files and of a seeded ball to the sphere: seconds, energy, folds.
//!
//! `cargo bench --bench sphere -- [--threads N] [--ball NODES] FILE...`

use planish::mesh::{Mesh, MeshOptions, read};
use planish::parameterize::sphere::{SphereOptions, map_to_sphere};
use planish::{Control, samples};
use std::path::Path;

fn main() {
    let (mut threads, mut meshes): (usize, Vec<(String, Mesh)>) = (1, Vec::new());
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        let mut number = || -> usize {
            let value = arguments.next().and_then(|value| value.parse().ok());
            value.unwrap_or_else(|| panic!("{argument} needs a number"))
        };
        match argument.as_str() {
            "--bench" => {}
            "--threads" => threads = number(),
            "--ball" => meshes.push(("ball".to_owned(), samples::ball(number(), 1).expect("a ball"))),
            _ => {
                let (mesh, _) =
                    read(Path::new(&argument), &MeshOptions::default()).expect("the file is a mesh");
                meshes.push((argument, mesh));
            }
        }
    }
    println!(
        "| mesh | nodes | seconds | nodes a second | energy | folds | slivers | area, 5 % | area, 95 % |\n\
         |---|---|---|---|---|---|---|---|---|"
    );
    for (name, mesh) in meshes {
        let map = map_to_sphere(&mesh, &SphereOptions::default(), &mut Control::new(threads));
        let report = map.expect("the mesh is a sphere").report;
        println!(
            "| {} | {} | {:.3} | {:.0} | {:.4} | {} | {} | {:.3} | {:.3} |",
            name.rsplit('/').next().unwrap_or(&name),
            mesh.points().len(),
            report.seconds,
            mesh.points().len() as f64 / report.seconds,
            report.energy,
            report.folded_triangles,
            report.clamped_triangles,
            report.low_area_ratio,
            report.high_area_ratio,
        );
    }
}
