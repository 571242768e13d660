//! Edge collapse of mesh files: seconds, and the distance of the nodes from the coarser mesh.
//!
//! `cargo bench --bench decimate -- [--share S] [--sharp-angle DEGREES] [--field NODES] FILE...`: a field is a height field with
//! waves and noise.

use planish::Control;
use planish::mesh::{DecimateOptions, Mesh, MeshOptions, read};
use planish::query::triangles::TriangleTree;
use planish::samples::{Random, grid};
use std::path::Path;

fn main() {
    let (mut share, mut sharp_angle, mut meshes) = (0.1, None, Vec::new());
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        let mut number = || -> f64 {
            let value = arguments.next().and_then(|value| value.parse().ok());
            value.unwrap_or_else(|| panic!("{argument} needs a number"))
        };
        match argument.as_str() {
            "--bench" => {}
            "--share" => share = number(),
            "--sharp-angle" => sharp_angle = Some(number().to_radians()),
            "--field" => meshes.push(("height field".to_owned(), field(number() as usize))),
            _ => {
                let (mesh, _) =
                    read(Path::new(&argument), &MeshOptions::default()).expect("the file is a mesh");
                meshes.push((argument, mesh));
            }
        }
    }
    println!(
        "| mesh | nodes | left | sharp edges | seconds | nodes a second | max | rms |\n|---|---|---|---|---|---|---|---|"
    );
    for (name, mesh) in meshes {
        let count = mesh.points().len();
        let target_count = (share * count as f64) as usize;
        let options =
            DecimateOptions::default().with_target_count(target_count).with_sharp_angle(sharp_angle);
        let coarse = mesh.decimate(&options, &mut Control::new(1)).expect("the options are good");
        let tree = TriangleTree::new(&coarse.piece.mesh);
        let distances =
            mesh.points().iter().filter_map(|&point| tree.nearest(point)).map(|near| near.distance);
        let (max, squares) = distances.fold((0.0_f64, 0.0), |(max, sum), d| (max.max(d), sum + d * d));
        println!(
            "| {} | {count} | {} | {} | {:.3} | {:.0} | {:.1e} | {:.1e} |",
            name.rsplit('/').next().unwrap_or(&name),
            coarse.piece.nodes.len(),
            coarse.sharp_edges.len(),
            coarse.report.seconds,
            coarse.report.collapse_count as f64 / coarse.report.seconds,
            max / mesh.diagonal(),
            (squares / count as f64).sqrt() / mesh.diagonal(),
        );
    }
}

/// A height field over a jittered grid of about so many nodes, with waves, and noise of a tenth of an edge.
fn field(nodes: usize) -> Mesh {
    let side = (nodes as f64).sqrt() as usize;
    let (places, triangles) = grid([side, side], 0.2, 1, |_| true);
    let mut random = Random::new(2);
    let mut height =
        |x: f64, y: f64| 0.1 * (9.0 * x).sin() * (7.0 * y).cos() + 0.1 / side as f64 * random.signed();
    let points = places.iter().map(|p| p.extend(height(p.x, p.y))).collect();
    Mesh::new(points, triangles).expect("a grid is a mesh")
}
