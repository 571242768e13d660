//! Machine parts as models: what becomes of 200 seeded ones, clean and under noise, and how long the samples take.
//!
//! `cargo bench --bench exact_parts [-- count [noise,.. [folder]]]`; the parts and their STEP files go to the folder. `-- samples`:
//! how long the samples take alone.

use planish::Control;
use planish::control::{Pool, Watch};
use planish::export;
use planish::export::mesh::Encoding;
use planish::export::step::{self, StepOptions};
use planish::fit::model::{MeshModelOptions, fit_exact, fit_mesh};
use planish::fit::report::Remarks;
use planish::mesh::{FeatureOptions, Format, Mesh};
use planish::samples::machine::{self, Part};
use std::path::Path;
use std::time::Instant;

/// A model of a mesh whose volume is farther from the part's own is looked at.
const VOLUME_OFF: f64 = 5e-3;

/// Seconds of a fit that is looked at.
const SLOW: f64 = 10.0;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    if arguments.first().is_some_and(|first| first == "samples") {
        return samples();
    }
    let count: u64 = arguments.first().map_or(200, |count| count.parse().expect("a number of parts"));
    let folder = arguments.get(2).map(Path::new);
    match arguments.get(1) {
        Some(noises) => {
            let noise = |noise: &str| noise.parse().expect("a share of the mean edge length");
            crowds(count, noises.split(',').map(noise), folder);
        }
        None => {
            samples();
            crowds(count, [0.0, 0.01, 0.05].into_iter(), folder);
        }
    }
}

fn samples() {
    println!(
        "| part | triangles | faces | seconds | volume off | area off | max error |\n|---|---|---|---|---|---|---|"
    );
    for nodes in [1000, 5000, 25_000] {
        for (name, part) in [
            ("cylinder", machine::cylinder(nodes, 1)),
            ("box with hole", machine::box_with_hole(nodes, 1)),
            ("bracket", machine::angle_bracket(nodes, 1)),
            ("flange", machine::flange(nodes, 1)),
            ("stepped shaft", machine::stepped_shaft(nodes, 1)),
            ("gear", machine::gear(nodes, 1)),
            ("slotted plate", machine::slotted_plate(nodes, 1)),
        ] {
            let Part { mesh, face_count, volume, area } = part.expect(name);
            let fit = fit_mesh(&mesh, &MeshModelOptions::default(), &mut Control::new(1)).expect(name);
            let measured = fit.model.measure();
            let exact: usize = fit.components.iter().map(|component| component.exact_faces).sum();
            println!(
                "| {name} | {} | {exact} of {face_count} | {:.3} | {:.1e} | {:.1e} | {:.1e} |",
                mesh.triangles().len(),
                fit.seconds,
                measured.volume / volume - 1.0,
                measured.area / area - 1.0,
                fit.report.max_error / fit.report.diagonal
            );
        }
    }
}

fn crowds(count: u64, noises: impl Iterator<Item = f64>, output: Option<&Path>) {
    let rows: Vec<String> = noises.map(|noise| crowd(count, noise, output)).collect();
    println!(
        "| noise | exact | planes and patches | smooth | met at the nodes | off | slowest, s | all, s |"
    );
    println!("|---|---|---|---|---|---|---|---|\n{}", rows.join("\n"));
}

/// Parts as users fit them: what becomes of each, and whether the report tells the truth about it.
fn crowd(count: u64, noise: f64, output: Option<&Path>) -> String {
    let start = Instant::now();
    let (mut exact, mut planes, mut smooth, mut met, mut off, mut slowest) = (0, 0, 0, 0, 0, 0.0_f64);
    for seed in 0..count {
        let Part { mesh, face_count, volume, .. } = machine::any_part(seed).expect("a part");
        let mesh = machine::roughened(&mesh, noise, seed).expect("the same triangles");
        let fit = match fit_mesh(&mesh, &MeshModelOptions::default(), &mut Control::new(2)) {
            Ok(fit) => fit,
            Err(error) => {
                println!("seed {seed}: {error}");
                continue;
            }
        };
        let (report, component) = (&fit.report, &fit.components[0]);
        let is_missed = report.remarks.has(Remarks::TOLERANCE_NOT_MET);
        assert_eq!(is_missed, report.max_error > report.tolerance, "seed {seed}: the report lies");
        let kind = match (component.layout, component.exact_faces) {
            (None, _) => {
                exact += 1;
                "exact"
            }
            (Some(_), 0) => {
                smooth += 1;
                "smooth"
            }
            _ => {
                planes += 1;
                "planes and patches"
            }
        };
        met += u32::from(!is_missed);
        slowest = slowest.max(fit.seconds);
        let why = if kind == "exact" { String::new() } else { obstacle(&mesh) };
        let is_other = kind == "exact" && component.exact_faces != face_count;
        let (free, crossings) = (fit.model.free_edge_count(), report.crossings.unwrap_or(0));
        // the mesh's own volume is off by its noise and its chords
        let volume_off = report.volume / volume - 1.0;
        let is_off = free > 0 || crossings > 0 || component.fold_count > 0 || volume_off.abs() > VOLUME_OFF;
        off += u32::from(is_off);
        if is_off || is_other || is_missed || kind == "smooth" || fit.seconds > SLOW {
            println!(
                "seed {seed}: {kind}, {} of {face_count} faces exact, {} patches, error {:.1e}, volume off {volume_off:.1e}, \
                 {free} free edges, {crossings} crossings, {} folds, {:.2} s{why}",
                component.exact_faces,
                report.patches.len(),
                report.max_error / report.diagonal,
                component.fold_count,
                fit.seconds
            );
        }
        if let Some(folder) = output {
            let name = folder.join(format!("part-{noise}-{seed}.obj"));
            export::mesh::write(&mesh, &name, Format::Obj, Encoding::Text)
                .expect("the folder can be written");
            let name = name.with_extension("step");
            step::write(&fit.model, &StepOptions::default(), &name, &Watch::default())
                .expect("the folder can be written");
        }
    }
    let seconds = start.elapsed().as_secs_f64();
    format!(
        "| {noise} | {exact} | {planes} | {smooth} | {met} of {count} | {off} | {slowest:.1} | {seconds:.0} |"
    )
}

/// What keeps a part from being exact.
fn obstacle(mesh: &Mesh) -> String {
    let fit = |pool: &Pool| fit_exact(mesh, 1e-3 * mesh.diagonal(), &FeatureOptions::default(), pool);
    match Control::new(1).watch(|pool, _| fit(pool)).expect("nobody cancels") {
        Ok(_) => String::new(),
        Err(obstacle) => format!("; {obstacle:?}"),
    }
}
