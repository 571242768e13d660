//! `planish d1rc`.

use crate::input::{MeshInput, degrees, threads};
use crate::output::{self, Table};
use crate::step::Step;
use crate::{Failure, Given, Outcome};
use clap::{Args, ValueEnum};
use planish::Control;
use planish::export::step::StepOptions;
use planish::mesh::Mesh;
use planish::parameterize::{ParameterizeOptions, parameterize};
use planish::surface::d1rc::{Boundary, D1rcMode, D1rcOptions, D1rcSurface, SharpRule, sharp_edges};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct D1rcArguments {
    /// Control mesh file (OFF, OBJ, PLY, STL): a disk, possibly with holes. Its parameters are computed if it has none.
    mesh: PathBuf,
    /// Degree, 1 to 3.
    #[arg(long, default_value_t = 3)]
    degree: usize,
    /// Edges whose faces meet at more than this many degrees stay sharp.
    #[arg(long, value_name = "DEGREES", value_parser = degrees, allow_negative_numbers = true)]
    sharp_angle: Option<f64>,
    /// Which functions there are.
    #[arg(long, value_enum, default_value_t = ModeName::Reproducing)]
    mode: ModeName,
    /// The border of the surface.
    #[arg(long, value_enum, default_value_t = BoundaryName::Phantom)]
    boundary: BoundaryName,
    /// What happens at sharp edges.
    #[arg(long, value_enum, default_value_t = SharpName::Automatic)]
    sharp: SharpName,
    /// Write a file: .vtu, .obj (a tessellation), .step or .stp (fitted), .planish (the surface itself); may be given
    /// several times.
    #[arg(long, value_name = "FILE")]
    out: Vec<PathBuf>,
    /// Ignore parameters that the file has.
    #[arg(long)]
    ignore_parameters: bool,
    #[command(flatten)]
    input: MeshInput,
    /// Threads; 0 for all cores.
    #[arg(long, default_value_t = 0, value_name = "N", value_parser = threads)]
    threads: usize,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum ModeName {
    Reproducing,
    Paper,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum BoundaryName {
    Phantom,
    Clamped,
    Open,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum SharpName {
    Automatic,
    Cut,
    Sector,
    Additive,
}

pub(crate) fn run(arguments: &D1rcArguments, given: &Given) -> Result<Outcome, Failure> {
    output::check_names(&arguments.out)?;
    given.refuse("sharp", arguments.sharp_angle.is_some(), "is used with --sharp-angle only")?;
    let (mut mesh, repairs) = arguments.input.read(&arguments.mesh)?;
    if let Some(piece) = mesh.without_unused_nodes() {
        mesh = piece.mesh; // a control point that no face needs moves nothing
    }
    let has_parameters = mesh.parameters().is_some();
    given.refuse("ignore-parameters", has_parameters, "does nothing for a mesh that has none")?;
    if arguments.ignore_parameters {
        mesh.clear_parameters();
    }
    given.refuse("threads", mesh.parameters().is_none(), "does nothing for a mesh that has parameters")?;
    if mesh.parameters().is_none() {
        let mut control = Control::new(arguments.threads);
        let map = parameterize(&mesh, &ParameterizeOptions::default(), &mut control)?;
        mesh.set_parameters(map.uv)?;
    }
    let sharp = match arguments.sharp_angle {
        Some(degrees) => sharp_edges(&mesh, degrees.to_radians())?,
        None => Vec::new(),
    };
    let surface = D1rcSurface::from_mesh(&mesh, &options(arguments), &sharp, &[])?;
    let mut table = table(arguments, &mesh, &sharp, &surface);
    output::repair_rows(&mut table, &repairs);
    let surface = surface.into();
    let product = arguments.mesh.file_stem().unwrap_or_default().to_string_lossy();
    let text = StepOptions { product: &product, ..StepOptions::default() };
    let step = Step { text, ..Step::default() };
    for path in &arguments.out {
        output::write_surface(&surface, path, &step)?;
        table.row("written", path.display().to_string());
    }
    output::print(table)?;
    Ok(Outcome::Done)
}

fn options(arguments: &D1rcArguments) -> D1rcOptions {
    D1rcOptions {
        degree: arguments.degree,
        mode: match arguments.mode {
            ModeName::Reproducing => D1rcMode::Reproducing,
            ModeName::Paper => D1rcMode::Paper,
        },
        boundary: match arguments.boundary {
            BoundaryName::Phantom => Boundary::Phantom,
            BoundaryName::Clamped => Boundary::Clamped,
            BoundaryName::Open => Boundary::Open,
        },
        sharp: match arguments.sharp {
            SharpName::Automatic => SharpRule::Automatic,
            SharpName::Cut => SharpRule::Cut,
            SharpName::Sector => SharpRule::Sector,
            SharpName::Additive => SharpRule::Additive,
        },
        ..D1rcOptions::default()
    }
}

fn table(arguments: &D1rcArguments, mesh: &Mesh, sharp: &[[u32; 2]], surface: &D1rcSurface) -> Table {
    let mut table = Table::default();
    table.row("control mesh", arguments.mesh.display().to_string());
    table.row("control points", mesh.points().len().to_string());
    table.row("faces", mesh.triangles().len().to_string());
    table.row("sharp edges", sharp.len().to_string());
    table.row("degree", surface.degree().to_string());
    table.row("functions", surface.space().configurations().len().to_string());
    table
}
