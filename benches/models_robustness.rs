//! 200 seeded closed meshes of genus 0 to 6, with noise, thin plates and limbs, 500 to 20,000 nodes: all met, or truthfully
//! reported; no fold, no free edge. Prints the totals.
//!
//! `cargo bench --bench models_robustness [-- count|seed,seed.. [tolerance [folder]]]`; the meshes and their STEP files go to the
//! folder.

use planish::Control;
use planish::control::Watch;
use planish::export;
use planish::export::mesh::Encoding;
use planish::export::step::{self, StepOptions};
use planish::fit::model::{MeshModelOptions, ModelOptions, fit_mesh};
use planish::fit::report::{Remarks, Tolerance};
use planish::mesh::Format;
use planish::samples::closed::seeded_block;
use std::path::Path;
use std::time::Instant;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let number = |text: &str| text.parse().expect("a number of meshes, or seeds");
    let seeds: Vec<u64> = match arguments.first() {
        Some(list) if list.contains(',') => list.split(',').map(number).collect(),
        count => (0..count.map_or(200, |count| number(count))).collect(),
    };
    let tolerances = match arguments.get(1) {
        Some(tolerance) => vec![tolerance.parse().expect("a tolerance")],
        None => vec![1e-2, 1e-3],
    };
    let folder = arguments.get(2).map(Path::new);
    let rows: Vec<String> = tolerances.into_iter().map(|tolerance| run(&seeds, tolerance, folder)).collect();
    println!(
        "| tolerance | blocks | nodes | met | missed | refused | with folds of the map | with folded cells | seconds |"
    );
    println!("|---|---|---|---|---|---|---|---|---|\n{}", rows.join("\n"));
}

fn run(seeds: &[u64], tolerance: f64, output: Option<&Path>) -> String {
    let start = Instant::now();
    let (mut met, mut missed, mut refused, mut folded, mut has_folded_cells, mut nodes) = (0, 0, 0, 0, 0, 0);
    for &seed in seeds {
        let (name, mesh) = seeded_block(seed).expect("a block is a mesh");
        nodes += mesh.points().len();
        let fit =
            ModelOptions::default().with_tolerance(Tolerance { value: tolerance, ..Tolerance::default() });
        let options = MeshModelOptions { fit, ..MeshModelOptions::default() };
        let fit = match fit_mesh(&mesh, &options, &mut Control::new(2)) {
            Ok(fit) => fit,
            Err(error) => {
                println!("seed {seed} ({name}): {error}");
                refused += 1;
                continue;
            }
        };
        assert_eq!(fit.model.free_edge_count(), 0, "seed {seed}");
        let is_missed = fit.report.remarks.has(Remarks::TOLERANCE_NOT_MET);
        assert_eq!(is_missed, fit.report.max_error > fit.report.tolerance, "seed {seed}: the report lies");
        let folds: usize = fit.components.iter().map(|component| component.fold_count).sum();
        folded += usize::from(folds > 0);
        has_folded_cells += usize::from(fit.report.folded_cells > 0);
        if is_missed || folds + fit.report.folded_cells > 0 || fit.report.normal_jump > 1e-10 {
            println!(
                "seed {seed} ({name}): {} nodes, {} patches, error {:.2e}, {folds} folds of the map, {} of cells, \
                 {} crossings, jump {:.1e}, {:?}, {:.2} s",
                mesh.points().len(),
                fit.report.patches.len(),
                fit.report.max_error / fit.report.diagonal,
                fit.report.folded_cells,
                fit.report.crossings.unwrap_or(0),
                fit.report.normal_jump,
                fit.report.stop,
                fit.seconds
            );
        }
        if is_missed {
            missed += 1
        } else {
            met += 1
        }
        if let Some(folder) = output {
            let name = folder.join(format!("closed-{seed}.obj"));
            export::mesh::write(&mesh, &name, Format::Obj, Encoding::Text)
                .expect("the folder can be written");
            let name = folder.join(format!("closed-{tolerance}-{seed}.step"));
            step::write(&fit.model, &StepOptions::default(), &name, &Watch::default())
                .expect("the folder can be written");
        }
    }
    let seconds = start.elapsed().as_secs_f64();
    format!(
        "| {tolerance:e} | {} | {nodes} | {met} | {missed} | {refused} | {folded} | {has_folded_cells} | {seconds:.0} |",
        seeds.len()
    )
}
