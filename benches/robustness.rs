//! 500 seeded surfaces from plane to wavy, with holes and notches, 500 to 20,000 nodes: all met, or truthfully
//! reported. Prints the totals.
//!
//! `cargo bench --bench robustness [-- folder]`; meshes that miss go to the folder.

use glam::DVec2;
use planish::Control;
use planish::export::mesh::{Encoding, write};
use planish::fit::report::{Remarks, Tolerance};
use planish::fit::tensor::{TensorOptions, fit_mesh};
use planish::mesh::{Format, Mesh};
use planish::samples::{Random, grid};
use std::f64::consts::TAU;
use std::path::Path;
use std::time::Instant;

const SURFACES: u64 = 500;
const TOLERANCE: f64 = 1e-3;

fn main() {
    let (mut met, mut missed, mut nodes, mut coefficients) = (0, 0, 0, 0);
    let mut seconds = Vec::new();
    let folder = std::env::args().skip(1).find(|argument| !argument.starts_with("--"));
    let start = Instant::now();
    for seed in 0..SURFACES {
        let mesh = surface(seed);
        let options = TensorOptions {
            tolerance: Tolerance { value: TOLERANCE, ..Tolerance::default() },
            ..TensorOptions::default()
        };
        let fit = fit_mesh(&mesh, &options, &mut Control::new(2)).expect("a disk with holes can be fitted");
        let report = fit.report;
        let worst = worst_error(&mesh, &fit.surface, &fit.parameters);
        assert!((worst - report.max_error).abs() <= 1e-12 * report.diagonal, "seed {seed}: the report lies");
        assert_eq!(worst <= report.tolerance, !report.remarks.has(Remarks::TOLERANCE_NOT_MET), "seed {seed}");
        assert_eq!(report.flipped_count, 0, "seed {seed} folds");
        if report.remarks.has(Remarks::TOLERANCE_NOT_MET) {
            missed += 1;
            if let Some(folder) = &folder {
                let path = Path::new(folder).join(format!("sheet-{seed}.obj"));
                write(&mesh, &path, Format::Obj, Encoding::Text).expect("the folder can be written");
            }
            println!(
                "seed {seed}: {} nodes, {}x{}, {:.2e} of the diagonal",
                mesh.points().len(),
                report.grid_u,
                report.grid_v,
                report.max_error / report.diagonal
            );
        } else {
            met += 1;
        }
        nodes += mesh.points().len();
        coefficients += report.coefficient_count;
        seconds.push(report.seconds);
    }
    seconds.sort_by(f64::total_cmp);
    println!(
        "| surfaces | nodes | tolerance | coefficients | met | missed and told | all, s | a fit, s | slowest, s |\n\
         |---|---|---|---|---|---|---|---|---|"
    );
    println!(
        "| {SURFACES} | {nodes} | {TOLERANCE:e} | {coefficients} | {met} | {missed} | {:.0} | {:.3} | {:.2} |",
        start.elapsed().as_secs_f64(),
        seconds[seconds.len() / 2],
        seconds[seconds.len() - 1]
    );
}

/// Recomputed from the surface, without the report.
fn worst_error(mesh: &Mesh, surface: &dyn planish::surface::Surface, parameters: &[DVec2]) -> f64 {
    let mut rows = vec![0.0; 3 * parameters.len()];
    surface.eval_rows(parameters, 0, &mut rows);
    let error = |(p, s): (&glam::DVec3, &[f64])| p.distance(glam::DVec3::from_slice(s));
    mesh.points().iter().zip(rows.chunks_exact(3)).map(error).fold(0.0, f64::max)
}

/// A sheet with up to three holes and a notch, from flat to three waves each way, without parameters.
fn surface(seed: u64) -> Mesh {
    let mut random = Random::new(seed);
    let aspect = 0.5 + 2.0 * random.unit();
    let count = 500.0 * 40.0_f64.powf(random.unit());
    let counts = [(count * aspect).sqrt() as usize, (count / aspect).sqrt() as usize];
    let holes: Vec<(DVec2, f64)> = (0..(4.0 * random.unit()) as usize)
        .map(|_| {
            let center = DVec2::new(0.2 + 0.6 * random.unit(), 0.35 + 0.45 * random.unit());
            (center, 0.05 + 0.06 * random.unit())
        })
        .collect();
    let notch = random.unit() < 0.5;
    let keep = |p: DVec2| {
        holes.iter().all(|(center, radius)| p.distance(*center) > *radius)
            && !(notch && (p.x - 0.5).abs() < 0.12 && p.y < 0.2)
    };
    let height = 0.15 * random.unit() * random.unit().round();
    let waves = DVec2::new(1.0 + 2.0 * random.unit(), 1.0 + 2.0 * random.unit());
    let bend = 2.0 * random.unit();
    let (places, triangles) = grid(counts, 0.25, seed, keep);
    let points = places.iter().map(|p| {
        let z = height * (TAU * waves.x * p.x).sin() * (TAU * waves.y * p.y).cos();
        let angle = bend * (p.x - 0.5);
        // a sheet bent about a cylinder, with waves along its normal
        let radius = 1.0 / bend.max(1e-3) + z;
        glam::DVec3::new(
            aspect * radius * angle.sin(),
            p.y,
            aspect * (radius * angle.cos() - 1.0 / bend.max(1e-3)),
        )
    });
    largest_piece(&Mesh::new(points.collect(), triangles).expect("the grid is manifold"))
}

/// Holes that touch cut pieces off or pinch nodes; the sheet goes on with its largest piece.
fn largest_piece(mesh: &Mesh) -> Mesh {
    let pieces = mesh.split_components().expect("a mesh has components");
    let largest = pieces.into_iter().max_by_key(|piece| piece.mesh.triangles().len());
    let mut mesh = largest.expect("a mesh has a component").mesh;
    while let Some(&node) = mesh.pinched_nodes().first() {
        let triangles: Vec<u32> = (0..mesh.triangles().len() as u32)
            .filter(|&t| mesh.triangles()[t as usize].contains(&node))
            .collect();
        let cut = mesh.remove_triangles(&triangles).expect("triangles of the mesh").mesh;
        mesh = largest_piece(&cut);
    }
    mesh
}
