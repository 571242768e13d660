//! `planish fair`.

use crate::bar::with_bar;
use crate::output::{self, Table};
use crate::step::StepArguments;
use crate::{Failure, Given, Outcome};
use clap::{Args, ValueEnum};
use glam::DVec2;
use planish::Control;
use planish::export::native;
use planish::fit::fair::{FairData, FairLimit, FairOptions, FairReport, Fairness, KeptBorder, fair};
use planish::fit::report::{Tolerance, ToleranceScale};
use planish::mesh::{MeshOptions, read};
use planish::query::project::{ProjectOptions, Projector};
use planish::surface::Surface;
use serde_json::json;
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub(crate) struct FairArguments {
    /// Saved surface (.planish): a tensor surface or a PHT-spline.
    surface: PathBuf,
    /// How far the surface may come to lie from itself, or from the mesh, as a fraction of the diagonal.
    #[arg(long, default_value_t = 1e-3, value_name = "T", allow_negative_numbers = true)]
    tolerance: f64,
    /// Take the tolerance in model units.
    #[arg(long)]
    absolute: bool,
    /// Stay near the nodes of this mesh instead of the surface itself (OFF, OBJ, PLY, STL).
    #[arg(long, value_name = "MESH")]
    mesh: Option<PathBuf>,
    /// The energy that is lowered.
    #[arg(long, value_enum, default_value_t = EnergyName::ThinPlate)]
    energy: EnergyName,
    /// What of the border of the domain stays.
    #[arg(long, value_enum, default_value_t = BorderName::None)]
    border: BorderName,
    /// How far the energy is lowered near the nodes of --mesh.
    #[arg(long, value_enum, default_value_t = LimitName::Noise)]
    limit: LimitName,
    /// Write a file: .planish, .step or .stp, .vtu, or a tessellation as .obj; may be given several times.
    #[arg(long, value_name = "FILE")]
    out: Vec<PathBuf>,
    #[command(flatten)]
    step: StepArguments,
    /// Print the report as JSON.
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum EnergyName {
    /// Bending.
    ThinPlate,
    /// Change of bending.
    Variation,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum BorderName {
    /// Nothing.
    None,
    /// Its place.
    Position,
    /// Its place and its tangent planes.
    Tangent,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum LimitName {
    /// Until each node is told best from the others: noise goes, and what is no noise stays.
    Noise,
    /// As far as the tolerance lets it.
    Tolerance,
}

pub(crate) fn run(arguments: &FairArguments, given: &Given) -> Result<Outcome, Failure> {
    output::check_names(&arguments.out)?;
    StepArguments::check_used(given, output::writes_step(&arguments.out))?;
    given.refuse(
        "limit",
        arguments.mesh.is_some(),
        "is not used: without --mesh the tolerance is the limit",
    )?;
    let surface = native::load_file(&arguments.surface)?;
    let nodes = arguments.mesh.as_deref().map(|path| nodes(path, surface.as_surface())).transpose()?;
    let data = nodes.as_ref().map(|(uv, values)| FairData { uv, values });
    let faired = with_bar(1, |control| fair(&surface, data, &options(arguments), control))?;
    let stem = arguments.surface.file_stem().unwrap_or_default().to_string_lossy();
    let step = arguments.step.step(&faired.surface.as_surface().region().label, &stem);
    for path in &arguments.out {
        output::write_surface(&faired.surface, path, &step)?;
    }
    if arguments.json {
        output::print(format_args!("{}\n", json_report(arguments, &faired.report)))?;
    } else {
        output::print(table(arguments, &faired.report))?;
    }
    Ok(Outcome::Done)
}

fn options(arguments: &FairArguments) -> FairOptions {
    FairOptions {
        tolerance: Tolerance {
            value: arguments.tolerance,
            scale: if arguments.absolute { ToleranceScale::Absolute } else { ToleranceScale::Relative },
        },
        energy: match arguments.energy {
            EnergyName::ThinPlate => Fairness::ThinPlate,
            EnergyName::Variation => Fairness::CurvatureVariation,
        },
        border: match arguments.border {
            BorderName::None => KeptBorder::None,
            BorderName::Position => KeptBorder::Position,
            BorderName::Tangent => KeptBorder::Tangent,
        },
        limit: match arguments.limit {
            LimitName::Noise => FairLimit::Noise,
            LimitName::Tolerance => FairLimit::Tolerance,
        },
    }
}

/// The nodes of a mesh, and the (u,v) nearest to them.
fn nodes(path: &Path, surface: &dyn Surface) -> Result<(Vec<DVec2>, Vec<f64>), Failure> {
    let mesh = read(path, &MeshOptions::default())?.0;
    let values: Vec<f64> = mesh.points().iter().flat_map(|p| p.to_array()).collect();
    let projector = Projector::new(surface)?;
    let feet = projector.project(&values, &ProjectOptions::default(), Control::default().pool())?;
    Ok((feet.uv, values))
}

fn table(arguments: &FairArguments, report: &FairReport) -> Table {
    let both = |length: f64| format!("{length:.3e}   {:.2e} of the diagonal", length / report.diagonal);
    let has_mesh = arguments.mesh.is_some();
    let mut table = Table::default();
    table.row("surface", format!("{}", arguments.surface.display()));
    table.row("energy", format!("{:.4e} to {:.4e}", report.energy_before, report.energy_after));
    table.row("tolerance", both(report.tolerance));
    table.row(if has_mesh { "max error" } else { "moved at most" }, both(report.max_deviation));
    if has_mesh {
        table.row("rms error", both(report.rms_deviation));
        table.row("moved at most", both(report.max_movement));
    }
    table.row("seconds", format!("{:.2}, {} solves", report.seconds, report.passes));
    for path in output::names(&arguments.out) {
        table.row("written", path);
    }
    table
}

fn json_report(arguments: &FairArguments, report: &FairReport) -> serde_json::Value {
    json!({
        "energy_before": report.energy_before,
        "energy_after": report.energy_after,
        "tolerance": report.tolerance,
        "diagonal": report.diagonal,
        "max_error": report.max_deviation,
        "rms_error": report.rms_deviation,
        "max_movement": report.max_movement,
        "passes": report.passes,
        "seconds": report.seconds,
        "written": output::names(&arguments.out),
    })
}
