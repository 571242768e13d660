//! `planish fit` where a mesh becomes a model: a solid of patches that meet smoothly.

use crate::bar::with_bar;
use crate::fit_options::{FitArguments, LayoutName, tolerance};
use crate::output::{self, Table};
use crate::picture::{Picture, View};
use crate::step::Step;
use crate::verdict::{between_nodes, outcome, remarks, verdict, written};
use crate::{Failure, Outcome};
use glam::DVec3;
use planish::Control;
use planish::fit::model::{Family, MeshModelOptions, ModelFit, ModelOptions, fit_mesh};
use planish::fit::report::{FitReport, Remarks};
use planish::layout::of_mesh::{LayoutKind, MeshLayoutOptions};
use planish::mesh::{FeatureOptions, LabelParts, Mesh, MeshRepairs, read_face_property};
use planish::surface::Label;
use serde_json::json;
use std::f64::consts::PI;
use std::path::Path;

pub(crate) fn fit(mesh: &Mesh, labels: &[u32], arguments: &FitArguments) -> Result<ModelFit, Failure> {
    let options = options(arguments, labels);
    Ok(with_bar(arguments.threads, |control| fit_mesh(mesh, &options, control))?)
}

/// A model, where one surface does not serve and a model does better: the tolerance is met first at the nodes, then between
/// them; where both miss it, the nearer one is better.
pub(crate) fn better(
    mesh: &Mesh,
    arguments: &FitArguments,
    surface: &FitReport,
) -> Result<Option<ModelFit>, Failure> {
    if outcome(surface.remarks) == Outcome::Done {
        return Ok(None);
    }
    let misses = |remarks: Remarks, max_error: f64| {
        let is_missed = remarks.has(Remarks::TOLERANCE_NOT_MET);
        (if is_missed { max_error } else { 0.0 }, remarks.has(Remarks::ROUGH_BETWEEN_NODES))
    };
    // a mesh that no model can be made of has its surface
    let fit = fit(mesh, &[], arguments).ok();
    let of_surface = misses(surface.remarks, surface.max_error);
    Ok(fit.filter(|fit| misses(fit.report.remarks, fit.report.max_error) < of_surface))
}

/// Writes what is asked for and says how it went.
pub(crate) fn tell(
    mesh: &Mesh,
    repairs: &MeshRepairs,
    labels: &[u32],
    fit: &ModelFit,
    arguments: &FitArguments,
) -> Result<Outcome, Failure> {
    let stem = arguments.mesh.file_stem().unwrap_or_default().to_string_lossy();
    let label = Label::default();
    let step = arguments.step.step(&label, &stem);
    for path in &arguments.out {
        write(mesh, fit, path, &step)?;
    }
    if let Some(path) = &arguments.picture {
        let moved = moved(mesh, fit);
        let mut picture = Picture::new(1200, 900, &View::facing(&moved), &moved);
        let range = (0.0, fit.report.max_error);
        picture.draw_mesh(&moved, Some(&fit.errors), range);
        picture.draw_scale("deviation", range);
        output::write_png(&picture, path)?;
    }
    if let Some(path) = &arguments.report {
        let write = |control: &mut Control| output::write_model_report(mesh, fit, &stem, path, control);
        with_bar(arguments.threads, write)?;
    }
    let labels = mesh.label_parts(labels)?;
    if arguments.json {
        output::print(format_args!("{}\n", json_report(arguments, mesh, repairs, fit, &labels)))?;
    } else {
        output::print(table(arguments, mesh, repairs, fit, &labels))?;
    }
    Ok(outcome(fit.report.remarks))
}

/// The label of each triangle; none without `--labels`.
pub(crate) fn labels(
    mesh: &Mesh,
    repairs: &MeshRepairs,
    arguments: &FitArguments,
) -> Result<Vec<u32>, Failure> {
    let Some(name) = &arguments.labels else { return Ok(Vec::new()) };
    let path = Path::new(name);
    let (of_faces, told): (Vec<f64>, String) = if path.is_file() {
        let text = output::read_text(path)?;
        let number = |(line, word): (usize, &str)| {
            let wrong = || Failure::new(format!("line {} of {name} is no number: '{word}'", line + 1));
            word.trim().parse::<f64>().map_err(|_| wrong())
        };
        let lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
        (lines.map(number).collect::<Result<_, _>>()?, format!("the file {name}"))
    } else {
        (read_face_property(&arguments.mesh, name, arguments.input.max_memory)?, format!("'{name}'"))
    };
    let label = |face: u32| {
        let Some(&number) = of_faces.get(face as usize) else {
            let count = of_faces.len();
            return Err(Failure::new(format!("{told} has {count} labels, none for face {face} of the mesh")));
        };
        let is_label = number.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&number);
        let wrong =
            || Failure::new(format!("label {number} of face {face} is no whole number from 0 to 4294967295"));
        if is_label { Ok(number as u32) } else { Err(wrong()) }
    };
    let faces = mesh.triangle_origins().max().map_or(0, |last| last as usize + 1);
    let left_out = repairs.dropped_triangles + repairs.duplicate_triangles + repairs.excluded_triangles;
    if of_faces.len() > faces && left_out == 0 {
        let count = of_faces.len();
        return Err(Failure::new(format!(
            "{told} has {count} labels for {faces} faces: it takes one for each"
        )));
    }
    mesh.triangle_origins().map(label).collect()
}

fn options<'a>(arguments: &FitArguments, labels: &'a [u32]) -> MeshModelOptions<'a> {
    let mut fit = ModelOptions::default().with_tolerance(tolerance(arguments));
    if arguments.smoothing != 0.0 {
        fit.smoothing = arguments.smoothing;
    }
    if let Some(steps) = arguments.sweeps {
        fit.foot_steps = u32::try_from(steps).unwrap_or(u32::MAX);
    }
    let defaults = MeshLayoutOptions::default();
    let layout = MeshLayoutOptions {
        kind: match (arguments.layout, arguments.patches) {
            // who asks for a number of patches wants a complex
            (LayoutName::Auto, Some(_)) | (LayoutName::Complex, _) => LayoutKind::Complex,
            (LayoutName::Auto, None) => LayoutKind::Auto,
            (LayoutName::Cube, _) => LayoutKind::Cube,
        },
        patches: arguments.patches.unwrap_or(defaults.patches),
        ..defaults
    };
    let level_spread = arguments.step.level_spread;
    let mut features = FeatureOptions::default().with_labels(labels);
    if let Some(angle) = arguments.sharp_angle {
        features.sharp_angle = Some(angle.to_radians());
    }
    if let Some(angle) = arguments.label_angle {
        features.label_angle = angle.to_radians();
    }
    if arguments.smooth {
        (features.sharp_angle, features.label_angle) = (None, PI);
    }
    // who asks for a layout wants patches
    let is_layout_given = arguments.patches.is_some() || arguments.layout != LayoutName::Auto;
    let exact = !(arguments.no_exact || arguments.smooth || is_layout_given);
    MeshModelOptions { family: Family::Auto, fit, layout, level_spread, exact, features }
}

fn write(mesh: &Mesh, fit: &ModelFit, path: &Path, step: &Step) -> Result<(), Failure> {
    if output::shows_deviation(path) {
        return output::write_deviation(&moved(mesh, fit), &fit.errors, path);
    }
    output::write_model(&fit.model, path, step)
}

/// The mesh with its nodes on the model.
fn moved(mesh: &Mesh, fit: &ModelFit) -> Mesh {
    let point = |(place, &point): (&Option<_>, &DVec3)| match *place {
        Some((face, uv)) => fit.model.carrier(face).points(&[uv])[0],
        None => point,
    };
    let points = fit.places.iter().zip(mesh.points()).map(point).collect();
    Mesh::new(points, mesh.triangles().to_vec()).expect("the same triangles at finite places")
}

/// Labels told one by one.
const MOST_LABELS: usize = 5;

/// How many labels there are, and which of them are no face: in several pieces, or with handles.
fn told_labels(labels: &[LabelParts]) -> String {
    let is_odd = |parts: &&LabelParts| parts.pieces > 1 || parts.handles > 0;
    let odd: Vec<&LabelParts> = labels.iter().filter(is_odd).collect();
    let mut told = vec![labels.len().to_string()];
    told.extend(odd.iter().take(MOST_LABELS).map(|LabelParts { label, pieces, handles, .. }| {
        match (pieces, handles) {
            (1, _) => format!("label {label} has {handles} handles"),
            (_, 0) => format!("label {label} is in {pieces} pieces"),
            _ => format!("label {label} is in {pieces} pieces with {handles} handles"),
        }
    }));
    if odd.len() > MOST_LABELS {
        told.push(format!("{} more in pieces or with handles", odd.len() - MOST_LABELS));
    }
    told.join(", ")
}

fn table(
    arguments: &FitArguments,
    mesh: &Mesh,
    repairs: &MeshRepairs,
    fit: &ModelFit,
    labels: &[LabelParts],
) -> String {
    let (report, model) = (&fit.report, &fit.model);
    let mut table = Table::default();
    let both = |error: f64| format!("{error:.3e}   {:.2e} of the diagonal", error / report.diagonal);
    let (points, triangles) = (mesh.points().len(), mesh.triangles().len());
    table.row("mesh", format!("{}", arguments.mesh.display()));
    table.row("nodes, triangles", format!("{points}, {triangles}, {} boundary loops", mesh.loops().len()));
    output::repair_rows(&mut table, repairs);
    output::loose_row(&mut table, mesh);
    if arguments.labels.is_some() {
        table.row("labels", told_labels(labels));
    }
    for component in &fit.components {
        let layout = match component.layout {
            None if component.exact_faces > 0 => format!("{} exact faces", component.exact_faces),
            None => "one chart".to_owned(),
            Some(LayoutKind::Cube) => format!("cube, map energy {:.3}", component.map_energy),
            Some(_) => format!("base complex, map energy {:.3}", component.map_energy),
        };
        let mut parts = vec![format!("genus {}", component.genus), layout];
        let has_both = component.layout.is_some() && component.exact_faces > 0;
        parts.extend(has_both.then(|| format!("{} planes beside patches", component.exact_faces)));
        parts.extend((component.fold_count > 0).then(|| format!("{} folds", component.fold_count)));
        parts.extend(component.void_in.map(|outer| format!("void in {outer}")));
        parts.extend(component.is_turned.then(|| "was inside out, turned".to_owned()));
        parts.extend(component.rounds_edges.then(|| "its sharp edges are rounded off".to_owned()));
        table.row("component", parts.join(", "));
    }
    table.row(
        "model",
        format!(
            "{} shells, {} faces, {} edges, {} free",
            model.shells().len(),
            model.faces().len(),
            model.edges().len(),
            model.free_edge_count()
        ),
    );
    let patches = if fit.is_chart() { 1 } else { report.patches.len() };
    table.row(
        "patches",
        format!(
            "{patches}, {} cells down to level {}, {} control points",
            report.cell_count, report.deepest_level, report.coefficient_count
        ),
    );
    table.row("tolerance", both(report.tolerance));
    table.row("max error", both(report.max_error));
    table.row("rms, mean error", format!("{:.3e}, {:.3e}", report.rms_error, report.mean_error));
    table.row("between nodes", between_nodes(report.max_interior_error, report.facet_sagitta));
    if !fit.is_chart() {
        table.row("model to mesh", both(report.max_back_distance));
        table.row("normal jump, gap", format!("{:.1e}, {:.1e}", report.normal_jump, report.gap));
    }
    if report.volume.is_finite() {
        table.row("volume", format!("{:.6e}, of the mesh {:.6e}", report.volume, report.mesh_volume));
    }
    let crossings = report.crossings.unwrap_or(0);
    if report.mesh_crossings + crossings > 0 {
        let pairs = format!("{} pairs of the mesh, {crossings} of the model", report.mesh_crossings);
        table.row("crossings", pairs);
    }
    let map: f64 = fit.components.iter().map(|component| component.map_seconds).sum();
    table.row("seconds", format!("{map:.2} map, {:.2} fit, {:.2} in all", report.fit_seconds, fit.seconds));
    table.row("result", verdict(report.remarks, report.stop));
    for remark in remarks(report.remarks) {
        table.row("remark", remark);
    }
    for path in written(arguments) {
        table.row("written", path);
    }
    table.to_string()
}

fn json_report(
    arguments: &FitArguments,
    mesh: &Mesh,
    repairs: &MeshRepairs,
    fit: &ModelFit,
    labels: &[LabelParts],
) -> serde_json::Value {
    let report = &fit.report;
    let label = |parts: &LabelParts| {
        json!({
            "label": parts.label,
            "triangle_count": parts.triangle_count,
            "piece_count": parts.pieces,
            "handle_count": parts.handles,
        })
    };
    let component = |component: &planish::fit::model::ComponentReport| {
        json!({
            "genus": component.genus,
            "layout": component.layout.map(|layout| format!("{layout:?}").to_lowercase()),
            "exact_face_count": component.exact_faces,
            "map_energy": component.map_energy,
            "fold_count": component.fold_count,
            "void_in": component.void_in,
            "is_turned": component.is_turned,
            "rounds_edges": component.rounds_edges,
            "patch_count": component.fit.patches.len(),
            "max_error": component.fit.max_error,
        })
    };
    json!({
        "nodes": mesh.points().len(),
        "triangles": mesh.triangles().len(),
        "tolerance_met": !report.remarks.has(Remarks::TOLERANCE_NOT_MET),
        "met_between_nodes": !report.remarks.has(Remarks::ROUGH_BETWEEN_NODES),
        "tolerance": report.tolerance,
        "diagonal": report.diagonal,
        "max_error": report.max_error,
        "rms_error": report.rms_error,
        "mean_error": report.mean_error,
        "worst_node": report.worst_node,
        "max_interior_error": report.max_interior_error,
        "facet_sagitta": report.facet_sagitta,
        "max_back_distance": report.max_back_distance,
        "normal_jump": report.normal_jump,
        "gap": report.gap,
        "folded_cells": report.folded_cells,
        "volume": report.volume,
        "mesh_volume": report.mesh_volume,
        "labels": arguments.labels.as_ref().map(|_| labels.iter().map(label).collect::<Vec<_>>()),
        "components": fit.components.iter().map(component).collect::<Vec<_>>(),
        "shell_count": fit.model.shells().len(),
        "face_count": fit.model.faces().len(),
        "edge_count": fit.model.edges().len(),
        "free_edge_count": fit.model.free_edge_count(),
        "patch_count": report.patches.len(),
        "cell_count": report.cell_count,
        "coefficient_count": report.coefficient_count,
        "free_count": report.free_count,
        "deepest_level": report.deepest_level,
        "passes": report.passes,
        "stop": verdict(report.remarks, report.stop),
        "fit_seconds": report.fit_seconds,
        "seconds": fit.seconds,
        "mesh_crossings": report.mesh_crossings,
        "crossings": report.crossings,
        "remarks": remarks(report.remarks),
        "repaired": output::repairs(repairs),
        "written": written(arguments),
    })
}
