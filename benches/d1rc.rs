//! D1RC-splines on one core: construction, evaluation at random places and on divided faces, one vertex moved.
//!
//! `cargo bench --bench d1rc -- control.off`: a control mesh of a disk, 1,290 nodes in the numbers of docs/measured.md;
//! a wavy sheet of 1,296 nodes without it.
//!
//! `-- --fan [COUNT...]`: how construction grows with the neighbours of one node, 10,000 to 100,000 unless told otherwise: the
//! tip of a cone alone, and with a skirt of as many long faces below.

use glam::DVec2;
use planish::Control;
use planish::mesh::{Mesh, MeshOptions, read};
use planish::parameterize::{ParameterizeOptions, parameterize};
use planish::samples::{Random, grid};
use planish::surface::d1rc::{D1rcMode, D1rcOptions, D1rcSurface};
use planish::surface::{Facets, Surface};
use std::time::Instant;

/// Runs of which the median is printed.
const RUNS: usize = 9;
const POINTS: usize = 100_000;
/// Parts of a side of a face on a regular tessellation.
const PARTS: usize = 16;

/// The median of seconds.
fn seconds(mut run: impl FnMut()) -> f64 {
    run();
    let mut seconds: Vec<f64> = (0..RUNS)
        .map(|_| {
            let start = Instant::now();
            run();
            start.elapsed().as_secs_f64()
        })
        .collect();
    seconds.sort_by(f64::total_cmp);
    seconds[RUNS / 2]
}

fn control_mesh() -> Mesh {
    let Some(path) = std::env::args().skip(1).find(|argument| !argument.starts_with('-')) else {
        let (places, triangles) = grid([36, 36], 0.25, 1, |_| true);
        let height = |p: &DVec2| 0.1 * (9.0 * p.x).sin() * (7.0 * p.y).cos();
        let points = places.iter().map(|p| p.extend(height(p))).collect();
        let mut mesh = Mesh::new(points, triangles).expect("a grid is a mesh");
        mesh.set_parameters(places).expect("one place a node");
        return mesh;
    };
    let (mut mesh, _) = read(path.as_ref(), &MeshOptions::default()).expect("the file is a mesh");
    let map =
        parameterize(&mesh, &ParameterizeOptions::default(), &mut Control::new(1)).expect("it is a disk");
    mesh.set_parameters(map.uv).expect("one place a node");
    mesh
}

/// Points inside the trims.
fn random_points(surface: &D1rcSurface) -> Vec<DVec2> {
    let mut random = Random::new(5);
    let domain = surface.domain();
    let next = || domain.min + domain.size() * DVec2::new(random.unit(), random.unit());
    let trims = &surface.region().trims;
    std::iter::repeat_with(next)
        .filter(|&uv| trims.contains(uv) && surface.contains(uv))
        .take(POINTS)
        .collect()
}

/// The nodes of a divided face.
fn nodes([a, b, c]: [DVec2; 3]) -> Vec<DVec2> {
    let share = |k: usize| k as f64 / PARTS as f64;
    let rows = (0..=PARTS).flat_map(|j| (0..=PARTS - j).map(move |i| (i, j)));
    rows.map(|(i, j)| a + share(i) * (b - a) + share(j) * (c - a)).collect()
}

fn main() {
    if std::env::args().any(|argument| argument == "--fan") {
        return fans();
    }
    let mesh = control_mesh();
    println!("{} control points, {} faces", mesh.points().len(), mesh.triangles().len());
    println!(
        "| mode | degree | functions | construction, ms | random | with first derivatives | divided | vertex moved, ms |\n\
         |---|---|---|---|---|---|---|---|"
    );
    for mode in [D1rcMode::Reproducing, D1rcMode::Paper] {
        for degree in 1..=3 {
            run(&mesh, &D1rcOptions::default().with_mode(mode).with_degree(degree));
        }
    }
}

fn fans() {
    let mut counts: Vec<u32> = std::env::args().filter_map(|argument| argument.parse().ok()).collect();
    if counts.is_empty() {
        counts = vec![10_000, 20_000, 40_000, 100_000];
    }
    println!(
        "| neighbours | rings | degree | functions | construction, s | a point near the tip, us |\n|---|---|---|---|---|---|"
    );
    for (rings, degree) in [(1, 1), (1, 2), (1, 3), (2, 3)] {
        for &count in &counts {
            let mesh = cone(count, rings);
            let start = Instant::now();
            let surface =
                D1rcSurface::from_mesh(&mesh, &D1rcOptions::default().with_degree(degree), &[], &[])
                    .expect("it is good");
            let build = start.elapsed().as_secs_f64();
            let mut random = Random::new(9);
            let uv: Vec<DVec2> =
                (0..1000).map(|_| 0.7 * DVec2::new(random.signed(), random.signed())).collect();
            let start = Instant::now();
            surface.eval_rows(&uv, 0, &mut [0.0; 3000]);
            let point = start.elapsed().as_secs_f64() / uv.len() as f64;
            let functions = surface.space().configurations().len();
            println!("| {count} | {rings} | {degree} | {functions} | {build:.2} | {:.1} |", 1e6 * point);
        }
    }
}

/// A cone over the unit disk, and with two rings a skirt around it.
fn cone(count: u32, rings: u32) -> Mesh {
    let rim = |k: u32| DVec2::from_angle(std::f64::consts::TAU * f64::from(k) / f64::from(count));
    let ring = |ring: u32| (0..count).map(move |k| f64::from(ring) * rim(k));
    let places: Vec<DVec2> = std::iter::once(DVec2::ZERO).chain((1..=rings).flat_map(ring)).collect();
    let points = places.iter().map(|p| p.extend(0.3 * (1.0 - p.length()))).collect();
    let faces = |k: u32| {
        let (a, b) = (1 + k, 1 + (k + 1) % count);
        let skirt = [[a, a + count, b + count], [a, b + count, b]];
        std::iter::once([0, a, b]).chain(skirt.into_iter().filter(move |_| rings > 1))
    };
    let mut mesh = Mesh::new(points, (0..count).flat_map(faces).collect()).expect("a cone is a mesh");
    mesh.set_parameters(places).expect("one place a node");
    mesh
}

fn run(mesh: &Mesh, options: &D1rcOptions) {
    let make = || D1rcSurface::from_mesh(mesh, options, &[], &[]).expect("the mesh is good");
    let build = seconds(|| drop(make()));
    let mut surface = make();
    let uv = random_points(&surface);
    let mut rows = vec![0.0; 9 * POINTS];
    let values = seconds(|| surface.eval_rows(&uv, 0, &mut rows[..3 * POINTS]));
    let tangents = seconds(|| surface.eval_rows(&uv, 1, &mut rows));
    let faces: Vec<Vec<DVec2>> =
        surface.triangles().iter().map(|face| nodes(face.map(|v| surface.places()[v as usize]))).collect();
    let count: usize = faces.iter().map(Vec::len).sum();
    let divide = |surface: &D1rcSurface, faces: &[usize], all: &[Vec<DVec2>]| {
        for &face in faces {
            let mut rows = vec![0.0; 3 * all[face].len()];
            surface.eval_on_facet(face, &all[face], &mut rows);
            std::hint::black_box(&rows);
        }
    };
    let every: Vec<usize> = (0..faces.len()).collect();
    let divided = seconds(|| divide(&surface, &every, &faces));
    // the vertex in the middle of the list, moved, and the faces that move with it; only where all faces are shown
    let vertex = (mesh.points().len() / 2) as u32;
    let region: Vec<usize> =
        surface.influence(vertex).expect("it exists").into_iter().map(|face| face as usize).collect();
    let moved = (options.mode != D1rcMode::Paper).then(|| {
        seconds(|| {
            let point = mesh.points()[vertex as usize] + 0.01 * glam::DVec3::Z;
            surface.set_control_points(&[vertex], &point.to_array()).expect("it is finite");
            divide(&surface, &region, &faces);
        })
    });
    println!(
        "| {:?} | {} | {} | {:.1} | {:.0} | {:.0} | {:.0} | {} |",
        options.mode,
        options.degree,
        surface.space().configurations().len(),
        1e3 * build,
        POINTS as f64 / values,
        POINTS as f64 / tangents,
        count as f64 / divided,
        moved.map_or(String::new(), |moved| format!("{:.2} ({} faces)", 1e3 * moved, region.len())),
    );
}
