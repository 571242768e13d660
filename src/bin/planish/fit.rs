//! `planish fit`.

use crate::bar::with_bar;
use crate::fit_options::{
    FamilyName, FitArguments, LayoutName, check_fields, d1rc_options, pht_options, saved_sides, sides,
    tensor_options,
};
use crate::model;
use crate::output::{self, Fit, Table};
use crate::step::StepArguments;
use crate::verdict::{between_nodes, outcome, remarks, verdict, written};
use crate::{Failure, Given, Outcome};
use clap::ValueEnum;
use planish::export::native::Saved;
use planish::failure::{Classify, ErrorKind};
use planish::fit::common::Plane;
use planish::fit::d1rc;
use planish::fit::pht;
use planish::fit::report::{FitReport, Remarks};
use planish::fit::tensor;
use planish::mesh::{Mesh, MeshRepairs};
use planish::surface::Label;
use planish::{Control, Error};
use serde_json::json;

pub(crate) fn run(arguments: &FitArguments, given: &Given) -> Result<Outcome, Failure> {
    output::check_names(&arguments.out)?;
    arguments.picture.iter().try_for_each(|path| output::check_name(path, output::PICTURES))?;
    arguments.report.iter().try_for_each(|path| output::check_name(path, output::REPORTS))?;
    let (mut mesh, repairs) = arguments.input.read(&arguments.mesh)?;
    if arguments.ignore_parameters {
        mesh.clear_parameters();
    }
    let why = "does nothing for a mesh that has parameters: add --ignore-parameters";
    given.refuse("border", mesh.parameters().is_none(), why)?;
    let is_model = match arguments.family {
        FamilyName::Auto => mesh.loops().is_empty(),
        family => family == FamilyName::Model,
    };
    let family = match arguments.family {
        FamilyName::Auto if is_model => FamilyName::Model,
        FamilyName::Auto => FamilyName::Tensor,
        family => family,
    };
    check_used(arguments, family, given)?;
    check_fields(arguments, &mesh)?;
    let saved = saved_sides(arguments)?;
    if is_model {
        let labels = model::labels(&mesh, &repairs, arguments)?;
        let fit = model::fit(&mesh, &labels, arguments)?;
        return model::tell(&mesh, &repairs, &labels, &fit, arguments);
    }
    // what is asked of one grid alone is no matter of a model
    let is_free =
        arguments.family == FamilyName::Auto && check_used(arguments, FamilyName::Model, given).is_ok();
    let fit =
        with_bar(arguments.threads, |control| fit_by_family(&mesh, arguments, &saved, is_free, control));
    let fit = match fit {
        // handles and several parts are no matter of one surface
        Err(error) if is_free && error.kind() == ErrorKind::Topology => {
            let fit = model::fit(&mesh, &[], arguments)?;
            return model::tell(&mesh, &repairs, &[], &fit, arguments);
        }
        fit => fit?,
    };
    if is_free && let Some(better) = model::better(&mesh, arguments, &fit.report)? {
        // a surface is not asked for where labels are given
        return model::tell(&mesh, &repairs, &[], &better, arguments);
    }
    let stem = arguments.mesh.file_stem().unwrap_or_default().to_string_lossy();
    let label = Label::default();
    let step = arguments.step.step(&label, &stem);
    for path in &arguments.out {
        output::write_fit(&mesh, &fit, path, &step)?;
    }
    if let Some(path) = &arguments.picture {
        output::write_picture(&mesh, &fit, path)?;
    }
    if let Some(path) = &arguments.report {
        with_bar(arguments.threads, |control| output::write_report(&mesh, &fit, &stem, path, control))?;
    }
    if arguments.json {
        output::print(format_args!("{}\n", json_report(arguments, &mesh, &repairs, &fit.report)))?;
    } else {
        output::print(table(arguments, &mesh, &repairs, &fit.report))?;
    }
    Ok(outcome(fit.report.remarks))
}

/// Refuses what the family or the method would not look at.
fn check_used(arguments: &FitArguments, family: FamilyName, given: &Given) -> Result<(), Failure> {
    for (option, owner) in [
        ("continuity", FamilyName::Pht),
        ("coarsening", FamilyName::Pht),
        ("max-grid", FamilyName::Tensor),
        ("knots", FamilyName::Tensor),
        ("free-ends", FamilyName::Tensor),
        ("ferguson", FamilyName::Tensor),
        ("control", FamilyName::D1rc),
        ("layout", FamilyName::Model),
        ("no-exact", FamilyName::Model),
        ("labels", FamilyName::Model),
        ("label-angle", FamilyName::Model),
        ("smooth", FamilyName::Model),
        ("patches", FamilyName::Model),
    ] {
        let name = |family: FamilyName| family.to_possible_value().map(|value| value.get_name().to_owned());
        let (own, other) = (name(owner).unwrap_or_default(), name(family).unwrap_or_default());
        let why = format!("is not used by --family {other}, only by --family {own}");
        given.refuse(option, family == owner, &why)?;
    }
    let has_edges = matches!(family, FamilyName::D1rc | FamilyName::Model);
    given.refuse("sharp-angle", has_edges, "is used by --family d1rc and --family model only")?;
    for option in ["sharp-angle", "label-angle"] {
        given.refuse(option, !arguments.smooth, "is not used with --smooth")?;
    }
    let is_free = matches!(family, FamilyName::Tensor | FamilyName::Pht);
    for option in ["fixed", "tolerances", "outlier-share", "outlier-scale", "symmetry", "side"] {
        given.refuse(option, is_free, "is used by --family tensor and --family pht only")?;
    }
    for option in ["weights", "border"] {
        given.refuse(option, family != FamilyName::Model, "is not used by --family model")?;
    }
    given.refuse(
        "patches",
        arguments.layout != LayoutName::Cube,
        "is not used with --layout cube: it has six",
    )?;
    given.refuse("free-ends", !arguments.ferguson, "is not used with --ferguson")?;
    StepArguments::check_used(given, output::writes_step(&arguments.out))?;
    given.refuse(
        "step-form",
        family == FamilyName::Pht,
        "is not used: only a PHT-spline has several forms",
    )?;
    let is_patches = family == FamilyName::Model || arguments.step.is_patches();
    given.refuse("level-spread", is_patches, "is used by --family model and with --step-form patches only")
}

/// Coefficients of one grid at most where a model may follow: what needs more of them is better served by a surface that is
/// refined where it has to be, and the way there is long.
fn most_of_first(mesh: &Mesh) -> usize {
    const NODES_PER_COEFFICIENT: usize = 16;
    const LEAST: usize = 96 * 96;
    (mesh.points().len() / NODES_PER_COEFFICIENT).max(LEAST)
}

fn fit_by_family(
    mesh: &Mesh,
    arguments: &FitArguments,
    saved: &[(usize, Saved)],
    may_be_model: bool,
    control: &mut Control,
) -> Result<Fit, Error> {
    match arguments.family {
        FamilyName::Auto | FamilyName::Model | FamilyName::Tensor => {
            let mut options = tensor_options(arguments, mesh).with_sides(sides(saved));
            if may_be_model {
                options.max_coefficients = options.max_coefficients.min(most_of_first(mesh));
            }
            let fit = tensor::fit_mesh(mesh, &options, control)?;
            let (report, parameters, errors) = (fit.report, fit.parameters, fit.errors);
            Ok(Fit { surface: fit.surface.into(), report, parameters, errors })
        }
        FamilyName::Pht => {
            let fit = pht::fit_mesh(mesh, &pht_options(arguments, mesh).with_sides(sides(saved)), control)?;
            let (report, parameters, errors) = (fit.report, fit.parameters, fit.errors);
            Ok(Fit { surface: fit.surface.into(), report, parameters, errors })
        }
        FamilyName::D1rc => {
            let fit = d1rc::fit_mesh(mesh, &d1rc_options(arguments, mesh), control)?;
            let (report, parameters, errors) = (fit.report, fit.parameters, fit.errors);
            Ok(Fit { surface: fit.surface.into(), report, parameters, errors })
        }
    }
}

fn table(arguments: &FitArguments, mesh: &Mesh, repairs: &MeshRepairs, report: &FitReport) -> String {
    let mut table = Table::default();
    let both = |error: f64| format!("{error:.3e}   {:.2e} of the diagonal", error / report.diagonal);
    let (points, triangles) = (mesh.points().len(), mesh.triangles().len());
    table.row("mesh", format!("{}", arguments.mesh.display()));
    table.row("nodes, triangles", format!("{points}, {triangles}, {} boundary loops", mesh.loops().len()));
    output::repair_rows(&mut table, repairs);
    table.row("map", format!("stretch {:.3}, {} flipped triangles", report.stretch, report.flipped_count));
    let grid = match report.cell_count {
        0 => format!("{} x {} knots", report.grid_u, report.grid_v),
        faces if arguments.family == FamilyName::D1rc => format!("control mesh of {faces} faces"),
        cells => format!("{cells} cells down to level {}", report.deepest_level),
    };
    table.row("surface", format!("{grid}, {} coefficients", report.coefficient_count));
    table.row("tolerance", both(report.tolerance));
    table.row("max error", both(report.max_error));
    table.row("rms, mean error", format!("{:.3e}, {:.3e}", report.rms_error, report.mean_error));
    table.row("between nodes", between_nodes(report.max_interior_error, report.facet_sagitta));
    if !arguments.fixed.is_empty() {
        table.row("fixed nodes", both(report.max_fixed_error));
    }
    if arguments.tolerances.is_some() {
        table.row("own tolerances", format!("at most {:.3} of each", report.max_tolerance_share));
    }
    if !report.left_out.is_empty() {
        table.row("left out", numbers(&report.left_out));
    }
    if !arguments.side.is_empty() {
        let angle = report.max_side_angle;
        table.row("given sides", format!("met to {:.1e}, planes to {angle:.1e}", report.max_side_error));
    }
    if let Some(Plane { point, normal }) = report.mirror {
        table.row("mirror", format!("at {point:.6}, normal {normal:.6}"));
        table.row("image within", both(report.mirror_distance));
    }
    let (map, all) = (report.parameterize_seconds, report.seconds);
    table.row("seconds", format!("{map:.2} map, {:.2} fit, {} passes", all - map, report.passes));
    table.row("result", verdict(report.remarks, report.stop));
    for remark in remarks(report.remarks) {
        table.row("remark", remark);
    }
    for path in written(arguments) {
        table.row("written", path);
    }
    table.to_string()
}

/// The first of some numbers, and how many there are.
fn numbers(all: &[u32]) -> String {
    const MOST: usize = 8;
    let first: Vec<String> = all.iter().take(MOST).map(u32::to_string).collect();
    let rest = if all.len() > MOST { ", ..." } else { "" };
    format!("{} nodes: {}{rest}", all.len(), first.join(", "))
}

fn json_report(
    arguments: &FitArguments,
    mesh: &Mesh,
    repairs: &MeshRepairs,
    report: &FitReport,
) -> serde_json::Value {
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
        "worst_node": report.worst_index,
        "max_fixed_error": report.max_fixed_error,
        "max_tolerance_share": report.max_tolerance_share,
        "left_out": report.left_out,
        "mirror_distance": report.mirror_distance,
        "max_side_error": report.max_side_error,
        "max_side_angle": report.max_side_angle,
        "max_interior_error": report.max_interior_error,
        "facet_sagitta": report.facet_sagitta,
        "grid": [report.grid_u, report.grid_v],
        "cell_count": report.cell_count,
        "deepest_level": report.deepest_level,
        "coefficient_count": report.coefficient_count,
        "refined_coefficient_count": report.refined_coefficient_count,
        "smoothing": report.smoothing,
        "empty_cell_count": report.empty_cell_count,
        "passes": report.passes,
        "stop": verdict(report.remarks, report.stop),
        "stretch": report.stretch,
        "flipped_count": report.flipped_count,
        "parameterize_seconds": report.parameterize_seconds,
        "seconds": report.seconds,
        "remarks": remarks(report.remarks),
        "repaired": output::repairs(repairs),
        "written": written(arguments),
    })
}
