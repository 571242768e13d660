//! `planish decimate`.

use crate::output::Table;
use crate::{Failure, Outcome};
use clap::Args;
use planish::Control;
use planish::export::obj;
use planish::mesh::{DecimateOptions, MeshOptions, read};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct DecimateArguments {
    /// Mesh file: OFF, OBJ, PLY or STL.
    mesh: PathBuf,
    /// Where to write the coarser mesh (.obj).
    out: PathBuf,
    /// Nodes that are to be left.
    #[arg(long, value_name = "N")]
    vertices: usize,
    /// Edges whose triangles turn by more than this stay edges.
    #[arg(long, value_name = "DEGREES")]
    sharp_angle: Option<f64>,
    /// Join nodes closer than this.
    #[arg(long, default_value_t = 0.0, value_name = "DISTANCE")]
    weld: f64,
}

pub fn run(arguments: &DecimateArguments) -> Result<Outcome, Failure> {
    let (mesh, _) = read(&arguments.mesh, &MeshOptions::default().with_weld_distance(arguments.weld))?;
    let options = DecimateOptions::default()
        .with_target_count(arguments.vertices)
        .with_sharp_angle(arguments.sharp_angle.map(f64::to_radians));
    let coarse = mesh.decimate(&options, &mut Control::new(1))?;
    obj::write(&coarse.piece.mesh, &arguments.out)?;
    let mut table = Table::default();
    let both = |before: usize, after: usize| format!("{before} to {after}");
    let result = &coarse.piece.mesh;
    table.row("nodes", both(mesh.points().len(), result.points().len()));
    table.row("triangles", both(mesh.triangles().len(), result.triangles().len()));
    table.row("sharp edges", coarse.sharp_edges.len().to_string());
    table.row("seconds", format!("{:.2}", coarse.report.seconds));
    if coarse.report.excess_count > 0 {
        table.row("result", format!("{} NODES MORE: no edge can be collapsed", coarse.report.excess_count));
    }
    print!("{table}");
    Ok(if coarse.report.excess_count > 0 { Outcome::ToleranceNotMet } else { Outcome::Done })
}
