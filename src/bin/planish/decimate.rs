//! `planish decimate`.

use crate::input::{MeshInput, degrees};
use crate::output::{self, Table};
use crate::{Failure, Given, Outcome};
use clap::Args;
use planish::Control;
use planish::mesh::DecimateOptions;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct DecimateArguments {
    /// Mesh file: OFF, OBJ, PLY or STL.
    mesh: PathBuf,
    /// Where to write the coarser mesh: .obj, .off, .ply or .stl.
    out: PathBuf,
    /// Nodes that are to be left.
    #[arg(long, value_name = "N")]
    vertices: usize,
    /// Edges whose triangles turn by more than this stay edges.
    #[arg(long, value_name = "DEGREES", value_parser = degrees, allow_negative_numbers = true)]
    sharp_angle: Option<f64>,
    /// Ignore parameters that the file has.
    #[arg(long)]
    ignore_parameters: bool,
    #[command(flatten)]
    input: MeshInput,
}

pub(crate) fn run(arguments: &DecimateArguments, given: &Given) -> Result<Outcome, Failure> {
    output::check_name(&arguments.out, output::MESHES)?;
    let (mut mesh, repairs) = arguments.input.read(&arguments.mesh)?;
    let has_parameters = mesh.parameters().is_some();
    given.refuse("ignore-parameters", has_parameters, "does nothing for a mesh that has none")?;
    if arguments.ignore_parameters {
        mesh.clear_parameters();
    }
    let options = DecimateOptions::default()
        .with_target_count(arguments.vertices)
        .with_sharp_angle(arguments.sharp_angle.map(f64::to_radians));
    let coarse = mesh.decimate(&options, &mut Control::new(1))?;
    output::write_mesh(&coarse.piece.mesh, &arguments.out)?;
    let mut table = Table::default();
    output::repair_rows(&mut table, &repairs);
    let both = |before: usize, after: usize| format!("{before} to {after}");
    let result = &coarse.piece.mesh;
    table.row("nodes", both(mesh.points().len(), result.points().len()));
    table.row("triangles", both(mesh.triangles().len(), result.triangles().len()));
    table.row("sharp edges", coarse.sharp_edges.len().to_string());
    table.row("seconds", format!("{:.2}", coarse.report.seconds));
    if coarse.report.excess_count > 0 {
        table.row("result", format!("{} NODES MORE: no edge can be collapsed", coarse.report.excess_count));
    }
    table.row("written", arguments.out.display().to_string());
    output::print(table)?;
    Ok(if coarse.report.excess_count > 0 { Outcome::ToleranceNotMet } else { Outcome::Done })
}
