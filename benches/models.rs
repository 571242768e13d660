//! Closed meshes as models: control points, errors both ways, smoothness, volume, and where the time goes.
//!
//! `cargo bench --bench models [-- name tolerance]`; real meshes from `../shared/data`, those at hand, and, if it is named, a bumpy
//! ball of 1.4 million nodes. STEP files go to `target/models`, scaled to a diagonal of 100 as the tables of the theory are.

use glam::{DVec3, IVec3};
use planish::Control;
use planish::control::Watch;
use planish::export::step;
use planish::fit::model::{MeshModelOptions, ModelOptions, fit_mesh};
use planish::fit::report::Tolerance;
use planish::layout::of_mesh::{LayoutKind, MeshLayoutOptions};
use planish::mesh::{Mesh, MeshOptions, read};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
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
    println!(
        "| mesh | nodes | tolerance | patches | control points | cells | rounds | at nodes | between | model to mesh | normal jump | \
         volume off | folds | map, s | fit, s | all, s | faces of STEP |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|"
    );
    if arguments.first().is_some_and(|wanted| wanted == "ball") {
        let mesh = ball(BALL_SQUARES);
        for &tolerance in &tolerances {
            run("bumpy ball", &mesh, LayoutKind::Auto, 40, tolerance, &output);
        }
    }
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

/// Squares along an edge of a cube that make 1,399,736 nodes.
const BALL_SQUARES: i32 = 483;

/// A ball with waves, over the squares of the faces of a cube.
fn ball(squares: i32) -> Mesh {
    let mut numbers: HashMap<IVec3, u32> = HashMap::new();
    let mut places = Vec::new();
    let mut node = |place: IVec3| {
        *numbers.entry(place).or_insert_with(|| {
            places.push(place);
            places.len() as u32 - 1
        })
    };
    let mut triangles = Vec::new();
    let axes = [IVec3::X, IVec3::Y, IVec3::Z];
    for (k, side) in (0..3).flat_map(|k| [(k, 0), (k, squares)]) {
        // the normal of a square turns with the order of its axes
        let (u, v) = (axes[(k + 1) % 3], axes[(k + 2) % 3]);
        let (u, v) = if side == 0 { (v, u) } else { (u, v) };
        for (i, j) in (0..squares).flat_map(|i| (0..squares).map(move |j| (i, j))) {
            let corner = axes[k] * side + u * i + v * j;
            let [a, b, c, d] = [corner, corner + u, corner + u + v, corner + v].map(&mut node);
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    let point = |place: &IVec3| {
        let p = (place.as_dvec3() * (2.0 / f64::from(squares)) - DVec3::ONE).normalize();
        (1.0 + 0.05 * (5.0 * p.x).sin() * (4.0 * p.y).cos() + 0.03 * (7.0 * p.z).sin()) * p
    };
    Mesh::new(places.iter().map(point).collect(), triangles).expect("a cube's faces are a mesh")
}

fn run(name: &str, mesh: &Mesh, kind: LayoutKind, patches: usize, tolerance: f64, output: &Path) {
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
    let path = output.join(format!("{}_{tolerance:e}.step", name.split('.').next().unwrap_or(name)));
    let faces = match step::write(&fit.model, &step::StepOptions::default(), &path, &Watch::default()) {
        Ok(step) => step.face_count.to_string(),
        Err(error) => error.to_string(),
    };
    println!(
        "| {name} | {} | {tolerance:e} | {} | {} | {} | {} | {:.2e} | {:.2e} | {:.2e} | {:.1e} | {:.1e} | {} | {:.2} | {:.2} | \
         {seconds:.2} | {faces} |",
        mesh.points().len(),
        report.patches.len(),
        report.coefficient_count,
        report.cell_count,
        report.passes,
        relative(report.max_error),
        relative(report.max_interior_error),
        relative(report.max_back_distance),
        report.normal_jump,
        report.volume / report.mesh_volume - 1.0,
        component.fold_count + report.folded_cells,
        component.map_seconds,
        report.fit_seconds,
    );
}
