//! `planish fit`.

use crate::input::{MeshInput, threads};
use crate::model;
use crate::output::{self, Fit, Table};
use crate::step::StepArguments;
use crate::{Failure, Given, Outcome};
use clap::{Args, ValueEnum};
use indicatif::{ProgressBar, ProgressStyle};
use planish::export::native::{Saved, load_any_file};
use planish::fit::common::{Demands, Outliers, Plane, Regularize, Symmetry};
use planish::fit::d1rc::{self, D1rcFitOptions};
use planish::fit::pht::{self, Coarsening, Continuity, PhtOptions};
use planish::fit::report::{FitReport, Remarks, StopReason, Tolerance, ToleranceScale};
use planish::fit::tensor::{self, Ends, Knots, Method, Sides, TensorOptions};
use planish::mesh::{Mesh, MeshRepairs};
use planish::parameterize::{Border, ParameterizeOptions};
use planish::surface::{AnySurface, Label};
use planish::{Control, Error};
use serde_json::json;
use std::io::IsTerminal;
use std::ops::ControlFlow;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct FitArguments {
    /// Mesh file: OFF, OBJ, PLY or STL.
    pub mesh: PathBuf,
    /// Family of the surface.
    #[arg(long, value_enum, default_value_t = FamilyName::Auto)]
    family: FamilyName,
    /// Patches of a model, about so many; a layout of its own for the shape.
    #[arg(long, value_name = "N")]
    pub patches: Option<usize>,
    /// Layout of the patches of a model.
    #[arg(long, value_enum, default_value_t = LayoutName::Auto)]
    pub layout: LayoutName,
    /// Largest error allowed at the nodes, as a fraction of the bounding box's diagonal.
    #[arg(long, default_value_t = 1e-3, value_name = "T", allow_negative_numbers = true)]
    tolerance: f64,
    /// Take the tolerance in model units.
    #[arg(long)]
    absolute: bool,
    /// Write a file: .step or .stp (the trimmed surface), .vtu or .glb (the mesh on the surface with its deviation), .obj,
    /// .off, .ply or .stl (a tessellation), .planish (the surface itself); may be given several times.
    #[arg(long, value_name = "FILE")]
    pub out: Vec<PathBuf>,
    #[command(flatten)]
    pub step: StepArguments,
    /// Write a picture of the surface coloured by deviation.
    #[arg(long, value_name = "PNG")]
    pub picture: Option<PathBuf>,
    /// Write a report: a page with the mesh in the colours of its distances, numbers and worst places.
    #[arg(long, value_name = "HTML")]
    pub report: Option<PathBuf>,
    /// Border of the map for meshes without parameters.
    #[arg(long, value_enum, default_value_t = BorderName::Auto)]
    border: BorderName,
    /// Ignore parameters that the file has.
    #[arg(long)]
    ignore_parameters: bool,
    /// Most knots along one direction.
    #[arg(long, default_value_t = 257, value_name = "N")]
    max_grid: usize,
    /// Where the knot lines of a tensor surface stand.
    #[arg(long, value_enum, default_value_t = KnotsName::Adaptive)]
    knots: KnotsName,
    /// Continuous derivatives of a surface with cells: 1, or 2, which takes the fewest coefficients (pht).
    #[arg(long, default_value_t = 1, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=2))]
    continuity: u32,
    /// Merge cells again as long as the tolerance is met, or not; auto does where the surface has two continuous
    /// derivatives (pht).
    #[arg(long, value_enum, default_value_t = CoarseningName::Auto)]
    coarsening: CoarseningName,
    /// Weight of the bending energy; 0 finds one.
    #[arg(long, default_value_t = 0.0, value_name = "MU", allow_negative_numbers = true)]
    pub smoothing: f64,
    /// Leave the ends of the knots free instead of straight.
    #[arg(long)]
    free_ends: bool,
    /// Use the equations of Dannenhoffer and Haimes instead of least squares.
    #[arg(long)]
    ferguson: bool,
    /// Edges whose triangles turn by more than this stay sharp (d1rc, model; 40 for a model if it is left out).
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true)]
    pub sharp_angle: Option<f64>,
    /// A number for each triangle, edges between different ones stay: a number of the faces of a PLY file by its name, or
    /// a text file with one a line (model).
    #[arg(long, value_name = "NAME", conflicts_with = "smooth")]
    pub labels: Option<String>,
    /// Make patches of planes and cylinders too (model).
    #[arg(long)]
    pub no_exact: bool,
    /// Ignore sharp edges: smooth patches everywhere (model).
    #[arg(long)]
    pub smooth: bool,
    /// Vertices of the control mesh (d1rc); as many as the tolerance takes if it is left out.
    #[arg(long, value_name = "N")]
    control: Option<usize>,
    /// Sweeps of parameter correction on each grid, or in each round; the default depends on the family.
    #[arg(long, value_name = "N")]
    pub sweeps: Option<usize>,
    /// Nodes that the surface passes through (tensor, pht).
    #[arg(long, value_name = "NODE", value_delimiter = ',')]
    fixed: Vec<u32>,
    /// Field of the mesh file with a tolerance for each node; infinity leaves a node out (tensor, pht).
    #[arg(long, value_name = "FIELD")]
    tolerances: Option<String>,
    /// Field of the mesh file with a weight for each node (tensor, pht, d1rc).
    #[arg(long, value_name = "FIELD")]
    weights: Option<String>,
    /// Leave out at most this share of the nodes as gross errors (tensor, pht).
    #[arg(long, value_name = "SHARE", conflicts_with = "outlier_scale", allow_negative_numbers = true)]
    outlier_share: Option<f64>,
    /// Leave out nodes that miss the surface of the others by more than this, measured like the tolerance (tensor, pht).
    #[arg(long, value_name = "LENGTH", allow_negative_numbers = true)]
    outlier_scale: Option<f64>,
    /// Make the surface its own mirror image about a plane: `found`, or a place in it and a normal (tensor, pht).
    #[arg(long, value_name = "found|X,Y,Z,NX,NY,NZ", value_parser = symmetry, allow_hyphen_values = true)]
    symmetry: Option<Symmetry>,
    /// Take a side over from a saved curve, or from the nearest side of a saved surface with its tangent planes
    /// (tensor, pht): SIDE is u-low, u-high, v-low or v-high; may be given several times.
    #[arg(long, value_name = "SIDE=FILE", value_parser = side)]
    side: Vec<(usize, PathBuf)>,
    #[command(flatten)]
    input: MeshInput,
    /// Threads; 0 for all cores.
    #[arg(long, default_value_t = 0, value_name = "N", value_parser = threads)]
    pub threads: usize,
    /// Print the report as JSON.
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum BorderName {
    /// The least stretched of the others.
    Auto,
    Circle,
    /// Square with its corners at the sharpest turns.
    Turns,
    /// Square with its corners at quarters of the length.
    Arc,
}

#[derive(Debug, Clone, Copy, PartialEq, ValueEnum)]
enum FamilyName {
    /// A model for a closed mesh, a tensor surface for one with a boundary.
    Auto,
    /// Patches that meet smoothly, a solid: for closed meshes of any shape.
    Model,
    /// One grid of knots: what every CAD system edits.
    Tensor,
    /// Cells as small as the shape asks, place by place.
    Pht,
    /// A triangular control mesh, which may have sharp edges.
    D1rc,
}

#[derive(Debug, Clone, Copy, PartialEq, ValueEnum)]
pub(crate) enum LayoutName {
    /// The cube where there is one and it serves, else a base complex.
    Auto,
    /// The six faces of a cube: for meshes without handles.
    Cube,
    /// Patches that follow the shape.
    Complex,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum KnotsName {
    /// Where the error asks for them.
    Adaptive,
    /// At equal distances.
    Uniform,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum CoarseningName {
    Auto,
    On,
    Off,
}

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
        return model::run(&mesh, &repairs, arguments);
    }
    let fit = with_bar(arguments.threads, |control| fit_by_family(&mesh, arguments, &saved, control))?;
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
    let remarks = fit.report.remarks;
    let is_met = !(remarks.has(Remarks::TOLERANCE_NOT_MET) || remarks.has(Remarks::ROUGH_BETWEEN_NODES));
    Ok(if is_met { Outcome::Done } else { Outcome::ToleranceNotMet })
}

/// Refuses what the family or the method would not look at.
fn check_used(arguments: &FitArguments, family: FamilyName, given: &Given) -> Result<(), Failure> {
    for (option, owner) in [
        ("continuity", FamilyName::Pht),
        ("coarsening", FamilyName::Pht),
        ("max-grid", FamilyName::Tensor),
        ("free-ends", FamilyName::Tensor),
        ("ferguson", FamilyName::Tensor),
        ("control", FamilyName::D1rc),
        ("layout", FamilyName::Model),
        ("no-exact", FamilyName::Model),
        ("labels", FamilyName::Model),
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
    given.refuse("sharp-angle", !arguments.smooth, "is not used with --smooth")?;
    let is_free = matches!(family, FamilyName::Tensor | FamilyName::Pht);
    for option in ["fixed", "tolerances", "outlier-share", "outlier-scale", "symmetry", "side"] {
        given.refuse(option, is_free, "is used by --family tensor and --family pht only")?;
    }
    given.refuse("weights", family != FamilyName::Model, "is not used by --family model")?;
    given.refuse("free-ends", !arguments.ferguson, "is not used with --ferguson")?;
    let writes_step = arguments.out.iter().any(|path| output::is_step(path));
    for option in StepArguments::OPTIONS {
        given.refuse(option, writes_step, "is not used: no STEP file is written")?;
    }
    given.refuse(
        "step-form",
        family == FamilyName::Pht,
        "is not used: only a PHT-spline has several forms",
    )?;
    let is_patches = family == FamilyName::Model || arguments.step.is_patches();
    given.refuse("level-spread", is_patches, "is used with --step-form patches only")
}

fn fit_by_family(
    mesh: &Mesh,
    arguments: &FitArguments,
    saved: &[(usize, Saved)],
    control: &mut Control,
) -> Result<Fit, Error> {
    match arguments.family {
        FamilyName::Auto | FamilyName::Model | FamilyName::Tensor => {
            let fit =
                tensor::fit_mesh(mesh, &tensor_options(arguments, mesh).with_sides(sides(saved)), control)?;
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

pub(crate) fn tolerance(arguments: &FitArguments) -> Tolerance {
    let scale = if arguments.absolute { ToleranceScale::Absolute } else { ToleranceScale::Relative };
    Tolerance { value: arguments.tolerance, scale }
}

fn border(arguments: &FitArguments) -> Border {
    match arguments.border {
        BorderName::Auto => Border::Auto,
        BorderName::Circle => Border::Circle,
        BorderName::Turns => Border::SquareByTurns,
        BorderName::Arc => Border::SquareByArc,
    }
}

/// A plane of symmetry from its word or its numbers.
fn symmetry(text: &str) -> Result<Symmetry, String> {
    if text == "found" {
        return Ok(Symmetry::Found);
    }
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|number| number.trim().parse()).collect();
    match numbers.as_deref() {
        Ok(&[x, y, z, nx, ny, nz]) => {
            Ok(Symmetry::About(Plane { point: [x, y, z].into(), normal: [nx, ny, nz].into() }))
        }
        _ => Err("is neither found nor six numbers, say 0,0,0,1,0,0".to_owned()),
    }
}

/// A side and the file that it is taken from.
fn side(text: &str) -> Result<(usize, PathBuf), String> {
    let found = text.split_once('=').and_then(|(side, file)| {
        let number = ["u-low", "u-high", "v-low", "v-high"].iter().position(|name| *name == side)?;
        Some((number, PathBuf::from(file)))
    });
    found.ok_or_else(|| "is no side and file, say u-low=edge.planish".to_owned())
}

/// The curves and surfaces that sides are taken from.
fn saved_sides(arguments: &FitArguments) -> Result<Vec<(usize, Saved)>, Failure> {
    let load = |(side, path): &(usize, PathBuf)| match load_any_file(path)? {
        saved @ (Saved::Curve(_) | Saved::Surface(AnySurface::Tensor(_) | AnySurface::Pht(_))) => {
            Ok((*side, saved))
        }
        _ => Err(Failure::new(format!(
            "'{}' holds no curve, no tensor surface and no PHT-spline",
            path.display()
        ))),
    };
    arguments.side.iter().map(load).collect()
}

fn sides(saved: &[(usize, Saved)]) -> Sides<'_> {
    let mut sides = Sides::default();
    for (side, saved) in saved {
        match saved {
            Saved::Curve(curve) => sides.curves[*side] = Some(curve),
            Saved::Surface(AnySurface::Tensor(surface)) => sides.neighbours[*side] = Some(surface.into()),
            Saved::Surface(AnySurface::Pht(surface)) => sides.neighbours[*side] = Some(surface.into()),
            _ => {}
        }
    }
    sides
}

/// What single nodes demand.
fn demands<'a>(arguments: &'a FitArguments, mesh: &'a Mesh) -> Demands<'a> {
    let outliers = match (arguments.outlier_share, arguments.outlier_scale) {
        (Some(share), _) => Outliers::Share(share),
        (_, Some(scale)) => Outliers::Scale(scale),
        _ => Outliers::None,
    };
    let symmetry = arguments.symmetry.unwrap_or_default();
    Demands { fixed: &arguments.fixed, tolerances: named(mesh, &arguments.tolerances), outliers, symmetry }
}

/// A field of the mesh that has been found to be there.
fn named<'a>(mesh: &'a Mesh, name: &Option<String>) -> Option<&'a [f64]> {
    name.as_deref().and_then(|name| mesh.field(name))
}

/// Fields that are asked for exist.
fn check_fields(arguments: &FitArguments, mesh: &Mesh) -> Result<(), Failure> {
    for name in arguments.tolerances.iter().chain(&arguments.weights) {
        if mesh.field(name).is_none() {
            let names: Vec<&str> = mesh.fields().iter().map(|field| field.name.as_str()).collect();
            let there = if names.is_empty() { "none".to_owned() } else { names.join(", ") };
            return Err(Failure::new(format!("the mesh has no field {name}; there are: {there}")));
        }
    }
    Ok(())
}

fn tensor_options<'a>(arguments: &'a FitArguments, mesh: &'a Mesh) -> TensorOptions<'a> {
    TensorOptions {
        tolerance: tolerance(arguments),
        knots: match arguments.knots {
            KnotsName::Adaptive => Knots::Adaptive,
            KnotsName::Uniform => Knots::Uniform,
        },
        method: if arguments.ferguson { Method::Ferguson } else { Method::LeastSquares },
        ends: if arguments.free_ends { Ends::Free } else { Ends::Natural },
        smoothing: arguments.smoothing,
        max_grid: arguments.max_grid,
        max_coefficients: arguments.max_grid.saturating_mul(arguments.max_grid),
        correction_sweeps: arguments.sweeps.unwrap_or(0),
        regularize: Regularize::Auto,
        parameterize: ParameterizeOptions::TENSOR.with_border(border(arguments)),
        weights: named(mesh, &arguments.weights),
        demands: demands(arguments, mesh),
        ..TensorOptions::default()
    }
}

fn pht_options<'a>(arguments: &'a FitArguments, mesh: &'a Mesh) -> PhtOptions<'a> {
    let defaults = PhtOptions::default();
    let is_asked = !matches!(arguments.border, BorderName::Auto);
    PhtOptions {
        tolerance: tolerance(arguments),
        continuity: if arguments.continuity == 2 { Continuity::C2 } else { Continuity::C1 },
        coarsening: match arguments.coarsening {
            CoarseningName::Auto => Coarsening::Auto,
            CoarseningName::On => Coarsening::On,
            CoarseningName::Off => Coarsening::Off,
        },
        smoothing: if arguments.smoothing > 0.0 { arguments.smoothing } else { defaults.smoothing },
        correction_sweeps: arguments.sweeps.unwrap_or(defaults.correction_sweeps),
        parameterize: is_asked.then(|| ParameterizeOptions::PHT.with_border(border(arguments))),
        weights: named(mesh, &arguments.weights),
        demands: demands(arguments, mesh),
        ..defaults
    }
}

fn d1rc_options<'a>(arguments: &FitArguments, mesh: &'a Mesh) -> D1rcFitOptions<'a> {
    let defaults = D1rcFitOptions::default();
    let is_asked = !matches!(arguments.border, BorderName::Auto);
    let map =
        if is_asked { defaults.parameterize.with_border(border(arguments)) } else { defaults.parameterize };
    D1rcFitOptions {
        tolerance: tolerance(arguments),
        smoothing: if arguments.smoothing > 0.0 { arguments.smoothing } else { defaults.smoothing },
        sharp_angle: arguments.sharp_angle.map(f64::to_radians),
        control_count: arguments.control.unwrap_or(defaults.control_count),
        correction_sweeps: arguments.sweeps.unwrap_or(defaults.correction_sweeps),
        parameterize: map,
        weights: named(mesh, &arguments.weights),
        ..defaults
    }
}

/// Fits with a bar on a terminal, silently elsewhere.
pub(crate) fn with_bar<R>(threads: usize, fit: impl FnOnce(&mut Control) -> R) -> R {
    const STEPS: f64 = 1000.0;
    if !std::io::stderr().is_terminal() {
        return fit(&mut Control::new(threads));
    }
    let bar = ProgressBar::new(STEPS as u64);
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {percent:>3} %  {msg}") {
        bar.set_style(style);
    }
    let mut progress = |fraction: f64, error: f64| {
        bar.set_position((fraction * STEPS) as u64);
        if error.is_finite() {
            bar.set_message(format!("error {error:.2e}"));
        }
        ControlFlow::Continue(())
    };
    let fitted = fit(&mut Control::new(threads).with_progress(&mut progress));
    bar.finish_and_clear();
    fitted
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
    table.row(
        "between nodes",
        match report.facet_sagitta {
            explained if explained > 0.0 => {
                format!("{:.3e}, of which facets explain {explained:.3e}", report.max_interior_error)
            }
            _ => format!("{:.3e}", report.max_interior_error),
        },
    );
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

pub(crate) fn written(arguments: &FitArguments) -> Vec<String> {
    output::names(arguments.out.iter().chain(&arguments.picture).chain(&arguments.report))
}

pub(crate) fn verdict(remarks: Remarks, stop: StopReason) -> String {
    let reason = match stop {
        StopReason::ToleranceMet => "tolerance met",
        StopReason::FixedGrid => "grid as asked",
        StopReason::Limit => "limit on grid or cells reached",
        StopReason::DataExhausted => "more coefficients than data",
        StopReason::Stagnated => "refinement no longer helps",
    };
    if remarks.has(Remarks::TOLERANCE_NOT_MET) {
        format!("TOLERANCE NOT MET: {reason}")
    } else if remarks.has(Remarks::ROUGH_BETWEEN_NODES) {
        format!("{reason}, BUT NOT BETWEEN THE NODES")
    } else {
        reason.to_owned()
    }
}

/// What is worth knowing beside the verdict.
pub(crate) fn remarks(remarks: Remarks) -> Vec<String> {
    let mut rest = remarks;
    rest.remove(Remarks::TOLERANCE_NOT_MET);
    rest.remove(Remarks::STAGNATED);
    rest.words().map(|words| format!("{}: {}", words.what, words.advice)).collect()
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
