//! Fits of meshes and of scattered samples: coefficients, errors at the data and between them, normals, how far the surface
//! strays, seconds.
//!
//! `cargo bench --bench tensor_fit -- [--tolerance T] [--given-parameters] [--only WORD] FILE...`
//!
//! A file is a mesh, whose own parameters are ignored unless asked for, or samples `u v x y z` as little-endian
//! doubles (`.f64`, tolerance absolute with `--absolute`), followed by `held:FILE` for places not given. The lines are those of docs/measured.md.
//!
//! `angle` is the root of the mean square of the angle, at triangle centroids, between the normal of the surface
//! and the mesh's: those of nodes are weighted by area and averaged over one ring. `astray` is how far the surface leaves the
//! box of the mesh, anywhere over its domain, also where there are no data.

use glam::{DVec2, DVec3};
use planish::Control;
use planish::fit::pht::{self, PhtOptions};
use planish::fit::report::{FitReport, Tolerance, ToleranceScale};
use planish::fit::tensor::{Knots, TensorOptions, fit_mesh, fit_points};
use planish::mesh::{Mesh, MeshOptions, read};
use planish::surface::{Surface, normal};
use std::path::Path;

struct Settings {
    tolerances: Vec<f64>,
    scale: ToleranceScale,
    keeps_parameters: bool,
    only: Option<String>,
}

fn main() {
    let mut settings = Settings {
        tolerances: vec![1e-2, 1e-3],
        scale: ToleranceScale::Relative,
        keeps_parameters: false,
        only: None,
    };
    let mut files: Vec<(String, Option<String>)> = Vec::new();
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--bench" => {}
            "--given-parameters" => settings.keeps_parameters = true,
            "--absolute" => settings.scale = ToleranceScale::Absolute,
            "--only" => settings.only = arguments.next(),
            "--tolerance" => {
                let value = arguments.next().and_then(|value| value.parse().ok());
                settings.tolerances = vec![value.expect("--tolerance needs a number")];
            }
            _ => match argument.strip_prefix("held:") {
                Some(held) => files.last_mut().expect("samples come first").1 = Some(held.to_owned()),
                None => files.push((argument, None)),
            },
        }
    }
    println!(
        "| data | count | tolerance | fit | grid | coefficients | max | rms | between | facets | angle | astray | held out | map, s | \
         fit, s | stop |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|"
    );
    for (file, held) in files {
        match (file.strip_suffix(".f64"), held) {
            (None, _) => mesh_lines(&file, &settings),
            (Some(_), held) => sample_lines(&file, held.as_deref(), &settings),
        }
    }
}

impl Settings {
    fn wants(&self, fit: &str) -> bool {
        self.only.as_ref().is_none_or(|only| only == fit)
    }
}

const KNOTS: [(&str, Knots); 2] = [("uniform", Knots::Uniform), ("adaptive", Knots::Adaptive)];

fn mesh_lines(file: &str, settings: &Settings) {
    let (mut mesh, _) = read(Path::new(&file), &MeshOptions::default()).expect("the file is a mesh");
    if !settings.keeps_parameters {
        mesh.clear_parameters();
    }
    for &value in &settings.tolerances {
        let tolerance = Tolerance { value, scale: settings.scale };
        let line = |fit: &'static str, surface: &dyn Surface, uv: &[DVec2], report: &FitReport| {
            let (angle, astray) = (Some(angle(&mesh, surface, uv)), Some(astray(&mesh, surface)));
            Line { file, count: mesh.points().len(), value, fit, report, angle, astray, held: None }.print();
        };
        for (name, knots) in KNOTS.into_iter().filter(|(name, _)| settings.wants(name)) {
            let options = TensorOptions { tolerance, knots, ..TensorOptions::default() };
            match fit_mesh(&mesh, &options, &mut Control::new(2)) {
                Err(error) => println!("{file} {name}: {error}"),
                Ok(fit) => line(name, &fit.surface, &fit.parameters, &fit.report),
            }
        }
        if settings.wants("pht") {
            let options = PhtOptions { tolerance, ..PhtOptions::default() };
            match pht::fit_mesh(&mesh, &options, &mut Control::new(2)) {
                Err(error) => println!("{file} pht: {error}"),
                Ok(fit) => line("PHT", &fit.surface, &fit.parameters, &fit.report),
            }
        }
    }
}

fn sample_lines(file: &str, held: Option<&str>, settings: &Settings) {
    let (uv, values) = samples(file);
    let held = held.map(samples);
    for &value in &settings.tolerances {
        let tolerance = Tolerance { value, scale: settings.scale };
        for (name, knots) in KNOTS.into_iter().filter(|(name, _)| settings.wants(name)) {
            let options = TensorOptions { tolerance, knots, ..TensorOptions::default() };
            match fit_points(&uv, &values, 3, &options, &mut Control::new(2)) {
                Err(error) => println!("{file} {name}: {error}"),
                Ok(fit) => {
                    let held = held.as_ref().map(|(uv, values)| held_error(&fit.surface, uv, values));
                    let (count, report) = (uv.len(), &fit.report);
                    Line { file, count, value, fit: name, report, angle: None, astray: None, held }.print();
                }
            }
        }
    }
}

/// One row of the table; errors are not yet parts of the diagonal.
struct Line<'a> {
    file: &'a str,
    count: usize,
    /// The tolerance.
    value: f64,
    fit: &'static str,
    report: &'a FitReport,
    angle: Option<f64>,
    astray: Option<f64>,
    held: Option<f64>,
}

impl Line<'_> {
    fn print(&self) {
        let &Self { file, count, value, fit, report: r, .. } = self;
        let name = file.rsplit('/').next().unwrap_or(file);
        let relative = |error: f64| format!("{:.2e}", error / r.diagonal);
        let grid = match r.cell_count {
            0 => format!("{} x {}", r.grid_u, r.grid_v),
            count => format!("{count} cells"),
        };
        // samples have no triangles to look between
        let between = self.angle.map_or([String::new(), String::new()], |_| {
            [relative(r.max_interior_error), relative(r.facet_sagitta)]
        });
        println!(
            "| {name} | {count} | {value:.0e} | {fit} | {grid} | {} | {} | {} | {} | {} | {} | {} | {:.2} | {:.2} | {:?} |",
            r.coefficient_count,
            relative(r.max_error),
            relative(r.rms_error),
            between.join(" | "),
            self.angle.map_or(String::new(), |angle| format!("{angle:.1}")),
            self.astray.map_or(String::new(), |astray| format!("{:.2}", astray / r.diagonal)),
            self.held.map_or(String::new(), relative),
            r.parameterize_seconds,
            r.seconds - r.parameterize_seconds,
            r.stop,
        );
    }
}

/// Rows of u v x y z.
fn samples(file: &str) -> (Vec<DVec2>, Vec<f64>) {
    let bytes = std::fs::read(file).expect("samples");
    let numbers: Vec<f64> =
        bytes.chunks_exact(8).map(|b| f64::from_le_bytes(b.try_into().expect("eight bytes"))).collect();
    let uv = numbers.chunks_exact(5).map(|row| DVec2::new(row[0], row[1])).collect();
    (uv, numbers.chunks_exact(5).flat_map(|row| row[2..].iter().copied()).collect())
}

/// The largest error at places that the fit has not seen, as far as they lie in its domain.
fn held_error(surface: &dyn Surface, uv: &[DVec2], values: &[f64]) -> f64 {
    let mut rows = vec![0.0; values.len()];
    surface.eval_rows(uv, 0, &mut rows);
    let domain = surface.domain();
    let distance = |(a, b): (&[f64], &[f64])| DVec3::from_slice(a).distance(DVec3::from_slice(b));
    let errors = rows.chunks_exact(3).zip(values.chunks_exact(3)).map(distance);
    errors.zip(uv).filter(|(_, uv)| domain.contains(**uv)).map(|(error, _)| error).fold(0.0, f64::max)
}

/// How far the surface leaves the box of the mesh.
fn astray(mesh: &Mesh, surface: &dyn Surface) -> f64 {
    const PLACES: usize = 401;
    let domain = surface.domain();
    let places = |from: f64, to: f64| -> Vec<f64> {
        (0..PLACES).map(|k| from + (to - from) * k as f64 / (PLACES - 1) as f64).collect()
    };
    let (u, v) = (places(domain.min.x, domain.max.x), places(domain.min.y, domain.max.y));
    let mut rows = vec![0.0; 3 * PLACES * PLACES];
    surface.eval_grid(&u, &v, &mut rows);
    let bounds = mesh.bounds();
    let (low, high) = (DVec3::from_slice(&bounds.min), DVec3::from_slice(&bounds.max));
    let beyond = |p: DVec3| p.distance(p.clamp(low, high));
    rows.chunks_exact(3).map(|row| beyond(DVec3::from_slice(row))).fold(0.0, f64::max)
}

/// The root mean square angle between the normals of surface and mesh, in degrees.
fn angle(mesh: &Mesh, surface: &dyn Surface, uv: &[DVec2]) -> f64 {
    let points = mesh.points();
    let mut normals = vec![DVec3::ZERO; points.len()];
    for triangle in mesh.triangles() {
        let [a, b, c] = triangle.map(|node| points[node as usize]);
        triangle.iter().for_each(|&node| normals[node as usize] += (b - a).cross(c - a));
    }
    let normals: Vec<DVec3> = normals.into_iter().map(DVec3::normalize_or_zero).collect();
    let mut rings = normals.clone();
    for &[a, b, c] in mesh.triangles() {
        for (a, b) in [(a, b), (b, c), (c, a)] {
            rings[a as usize] += normals[b as usize];
        }
    }
    let mut squares = 0.0;
    for triangle in mesh.triangles() {
        let nodes = triangle.map(|node| node as usize);
        let center = nodes.iter().map(|&n| uv[n]).sum::<DVec2>() / 3.0;
        let mut row = [0.0; 9];
        surface.eval_rows(&[center], 1, &mut row);
        let found = normal(DVec3::from_slice(&row[3..]), DVec3::from_slice(&row[6..]));
        let wanted: DVec3 = nodes.iter().map(|&n| rings[n].normalize_or_zero()).sum();
        let angle = found.angle_between(wanted).min(found.angle_between(-wanted));
        squares += if angle.is_finite() { angle * angle } else { 0.0 };
    }
    (squares / mesh.triangles().len() as f64).sqrt().to_degrees()
}
