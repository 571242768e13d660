//! Closed meshes as models: control points, errors both ways, smoothness, volume, and where the time goes.
//!
//! `cargo bench --bench models [-- name tolerance]`; real meshes from `../shared/data`, those at hand. STEP files go to
//! `target/models`, scaled to a diagonal of 100 as the tables of the theory are.

use planish::Control;
use planish::control::Watch;
use planish::export::step;
use planish::fit::model::{MeshModelOptions, ModelOptions, fit_mesh};
use planish::fit::report::Tolerance;
use planish::layout::of_mesh::{LayoutKind, MeshLayoutOptions};
use planish::mesh::{Mesh, MeshOptions, read};
use std::path::PathBuf;
use std::time::Instant;

const MESHES: [(&str, LayoutKind, usize); 6] = [
    ("igea_closed_45k.ply", LayoutKind::Auto, 40),
    ("hammer_closed_30k.ply", LayoutKind::Auto, 40),
    ("rockerarm_genus1_10k.off", LayoutKind::Auto, 40),
    ("fandisk_closed_6k.off", LayoutKind::Complex, 38),
    ("bullet_closed_14k.ply", LayoutKind::Auto, 40),
    ("igea_closed_134k.ply", LayoutKind::Auto, 40),
];

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let tolerances: Vec<f64> = match arguments.get(1) {
        Some(tolerance) => vec![tolerance.parse().expect("a tolerance")],
        None => vec![1e-3, 1e-2],
    };
    let output = folder.join("target/models");
    std::fs::create_dir_all(&output).expect("the target folder can be written");
    for (name, kind, patches) in MESHES {
        if arguments.first().is_some_and(|wanted| !name.contains(wanted.as_str())) {
            continue;
        }
        let Ok((mesh, _)) = read(&folder.join("../shared/data").join(name), &MeshOptions::default()) else {
            println!("{name}: not at hand");
            continue;
        };
        let scale = 100.0 / mesh.diagonal();
        let points = mesh.points().iter().map(|&p| p * scale).collect();
        let mesh = Mesh::new(points, mesh.triangles().to_vec()).expect("a scaled mesh is one");
        for &tolerance in &tolerances {
            run(name, &mesh, kind, patches, tolerance, &output);
        }
    }
}

fn run(name: &str, mesh: &Mesh, kind: LayoutKind, patches: usize, tolerance: f64, output: &std::path::Path) {
    let layout = MeshLayoutOptions::default().with_kind(kind).with_patches(patches);
    let fit = ModelOptions::default().with_tolerance(Tolerance { value: tolerance, ..Tolerance::default() });
    let options = MeshModelOptions { fit, layout, ..MeshModelOptions::default() };
    let start = Instant::now();
    let fit = match fit_mesh(mesh, &options, &mut Control::new(2)) {
        Ok(fit) => fit,
        Err(error) => return println!("{name} {tolerance:e}: {error}"),
    };
    let seconds = start.elapsed().as_secs_f64();
    let (report, component) = (&fit.report, &fit.components[0]);
    let relative = |x: f64| x / report.diagonal;
    println!(
        "{name} {tolerance:e}: {} patches, {} control points, {} free, {} cells to level {}, {} rounds ({:?}); nodes {:.2e}, between \
         {:.2e}, surface to mesh {:.2e}, jump {:.1e}, gap {:.1e}, volume {:+.2e}; map {:.2} s (energy {:.3}, {} folds), fit {:.2} s, all {seconds:.2} s",
        report.patches.len(),
        report.coefficient_count,
        report.free_count,
        report.cell_count,
        report.deepest_level,
        report.passes,
        report.stop,
        relative(report.max_error),
        relative(report.max_interior_error),
        relative(report.max_back_distance),
        report.normal_jump,
        report.gap,
        report.volume / report.mesh_volume - 1.0,
        component.map_seconds,
        component.map_energy,
        component.fold_count,
        report.fit_seconds,
    );
    let path = output.join(format!("{}_{tolerance:e}.step", name.split('.').next().unwrap_or(name)));
    match step::write(&fit.model, &step::StepOptions::default(), &path, &Watch::default()) {
        Ok(step) => println!(
            "    STEP: {} faces, {} edges, {} poles, curves off by {:.1e}",
            step.face_count, step.edge_count, step.pole_count, step.curve_deviation
        ),
        Err(error) => println!("    STEP: {error}"),
    }
}
