//! A million triangles from binary PLY to a mesh with its topology: median of five, and of its two parts.

use planish::mesh::{Format, Mesh, MeshOptions, read, read_bytes};
use std::time::Instant;

/// Quads along each side: twice 708 squared is just over a million triangles.
const SIDE: u32 = 708;

fn main() -> Result<(), planish::Error> {
    let bytes = grid();
    let path = std::env::temp_dir().join(format!("planish_mesh_read_{}.ply", std::process::id()));
    std::fs::write(&path, &bytes).expect("the temporary folder takes a file");
    let options = MeshOptions::default();
    let (mesh, _) = read(&path, &options)?;
    let seconds = median(|| drop(read(&path, &options)));
    std::fs::remove_file(&path).expect("it was just written");

    let parse = median(|| drop(read_bytes(&bytes, Format::Ply, &options)));
    let (points, triangles) = (mesh.points(), mesh.triangles());
    let build = median(|| drop(Mesh::new(points.to_vec(), triangles.to_vec())));
    let weld = median(|| drop(read_bytes(&bytes, Format::Ply, &options.with_weld_distance(1e-6))));
    println!("{} triangles, {} nodes, {} MB", triangles.len(), points.len(), bytes.len() / 1_000_000);
    println!("| from | to | seconds |\n|---|---|---|");
    println!("| a file | a mesh | {seconds:.3} |");
    println!("| bytes | a mesh | {parse:.3} |");
    println!("| arrays | a mesh | {build:.3} |");
    println!("| bytes | a mesh, nodes joined | {weld:.3} |");
    Ok(())
}

fn median(mut work: impl FnMut()) -> f64 {
    let mut seconds = [0.0; 5].map(|_: f64| {
        let start = Instant::now();
        work();
        start.elapsed().as_secs_f64()
    });
    seconds.sort_by(f64::total_cmp);
    seconds[2]
}

/// A wavy square whose nodes are numbered all over the place, as scans are.
fn grid() -> Vec<u8> {
    let count = (SIDE + 1) * (SIDE + 1);
    // a bijection: the multiplier has no common factor with the count
    let scatter = |node: u32| (u64::from(node) * 1_000_003 % u64::from(count)) as u32;
    let mut place = vec![0; count as usize];
    (0..count).for_each(|node| place[scatter(node) as usize] = node);
    let header = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {count}\nproperty float x\nproperty float y\n\
         property float z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
        2 * SIDE * SIDE
    );
    let mut bytes = header.into_bytes();
    for node in place {
        let [x, y] = [node % (SIDE + 1), node / (SIDE + 1)].map(|i| i as f32 / SIDE as f32);
        for coordinate in [x, y, 0.1 * (9.0 * x).sin() * (7.0 * y).cos()] {
            bytes.extend(coordinate.to_le_bytes());
        }
    }
    for square in 0..SIDE * SIDE {
        let corner = square / SIDE * (SIDE + 1) + square % SIDE;
        let [a, b, c, d] = [corner, corner + 1, corner + SIDE + 2, corner + SIDE + 1].map(scatter);
        for triangle in [[a, b, c], [a, c, d]] {
            bytes.push(3);
            triangle.iter().for_each(|node| bytes.extend(node.to_le_bytes()));
        }
    }
    bytes
}
