//! Machine parts as models of exact faces: how many of 200 seeded ones are exact and valid, clean and under noise, and how
//! long the samples take.
//!
//! `cargo bench --bench exact_parts [-- count]`

use planish::Control;
use planish::fit::model::{MeshModelOptions, fit_exact, fit_mesh};
use planish::mesh::FeatureOptions;
use planish::samples::machine::{self, Part};
use std::time::Instant;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let count: u64 = arguments.first().map_or(200, |count| count.parse().expect("a number of parts"));
    samples();
    for noise in [0.0, 0.01, 0.05] {
        crowd(count, noise);
    }
}

fn samples() {
    println!("part           triangles  faces      s   volume off     area off    max error");
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
            assert_eq!(exact, face_count, "{name}");
            println!(
                "{name:14} {:9} {exact:6} {:6.3} {:12.1e} {:12.1e} {:12.1e}",
                mesh.triangles().len(),
                fit.seconds,
                measured.volume / volume - 1.0,
                measured.area / area - 1.0,
                fit.report.max_error / fit.report.diagonal
            );
        }
    }
}

/// Parts whose faces, volume and area are right, under noise by as much as that lets them.
fn crowd(count: u64, noise: f64) {
    let start = Instant::now();
    let (mut exact, mut met, mut wrong, mut slowest) = (0, 0, 0, 0.0_f64);
    for seed in 0..count {
        let Part { mesh, face_count, volume, area } = machine::any_part(seed).expect("a part");
        let mesh = machine::roughened(&mesh, noise, seed).expect("the same triangles");
        let (before, tolerance) = (Instant::now(), 1e-3 * mesh.diagonal());
        let fit = Control::new(1)
            .watch(|_, watch| fit_exact(&mesh, tolerance, &FeatureOptions::default(), watch))
            .expect("nobody cancels");
        slowest = slowest.max(before.elapsed().as_secs_f64());
        match fit {
            Ok(fit) => {
                let measured = fit.model.measure();
                let off = (measured.volume / volume - 1.0).abs().max((measured.area / area - 1.0).abs());
                let is_right = off <= if noise > 0.0 { 1e-2 } else { 1e-6 };
                exact += 1;
                met += usize::from(fit.report.max_error <= tolerance);
                if !is_right || fit.model.faces().len() != face_count {
                    wrong += 1;
                    println!(
                        "seed {seed}: {} faces of {face_count}, off by {off:.1e}",
                        fit.model.faces().len()
                    );
                }
            }
            Err(obstacle) => println!("seed {seed}: {obstacle:?}"),
        }
    }
    println!(
        "{count} parts, noise {noise}: {exact} exact, {met} of them met, {wrong} of them with other faces; slowest \
         {slowest:.3} s, {:.1} s in all",
        start.elapsed().as_secs_f64()
    );
}
