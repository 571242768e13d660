//! Edge collapse of mesh files: seconds, and the distance of the nodes from the coarser mesh.
//!
//! `cargo bench --bench decimate -- [--share S] [--sharp-angle DEGREES] FILE...`

use planish::Control;
use planish::mesh::{DecimateOptions, MeshOptions, read};
use planish::query::triangles::TriangleTree;
use std::path::Path;

fn main() {
    let (mut share, mut sharp_angle, mut files) = (0.1, None, Vec::new());
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
            _ => files.push(argument),
        }
    }
    println!(
        "{:28} {:>8} {:>8} {:>7} {:>8} {:>9} {:>9} {:>9}",
        "mesh", "nodes", "left", "sharp", "seconds", "nodes/s", "max", "rms"
    );
    for file in files {
        let (mesh, _) = read(Path::new(&file), &MeshOptions::default()).expect("the file is a mesh");
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
            "{:28} {count:8} {:8} {:7} {:8.3} {:9.0} {:9.2e} {:9.2e}",
            file.rsplit('/').next().unwrap_or(&file),
            coarse.piece.nodes.len(),
            coarse.sharp_edges.len(),
            coarse.report.seconds,
            coarse.report.collapse_count as f64 / coarse.report.seconds,
            max / mesh.diagonal(),
            (squares / count as f64).sqrt() / mesh.diagonal(),
        );
    }
}
