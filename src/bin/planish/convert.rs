//! `planish convert`.

use crate::input::MeshInput;
use crate::output::{self, Table};
use crate::step::StepArguments;
use crate::{Failure, Given, Outcome};
use clap::Args;
use planish::export::native::{Saved, load_any_file};
use planish::export::vtk;
use planish::mesh::Mesh;
use planish::model::{Form, Model};
use planish::query::tessellate::TessellateOptions;
use planish::surface::{AnySurface, Label};
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub(crate) struct ConvertArguments {
    /// What was saved (.planish): a surface, model or curve; or a mesh file (OFF, OBJ, PLY, STL).
    file: PathBuf,
    /// Files to write, each in the format that its name ends in: .step or .stp, .vtu, .obj, .off, .ply, .stl, .glb, .planish.
    #[arg(required = true)]
    out: Vec<PathBuf>,
    #[command(flatten)]
    step: StepArguments,
    /// Largest distance between a surface and its triangles, in model units; 0 for a share of the diagonal.
    #[arg(long, default_value_t = 0.0, value_name = "DISTANCE", allow_negative_numbers = true)]
    chord: f64,
    /// Longest edge of triangles, in model units; 0 for no limit.
    #[arg(long, default_value_t = 0.0, value_name = "LENGTH", allow_negative_numbers = true)]
    max_edge: f64,
    #[command(flatten)]
    input: MeshInput,
}

/// What is converted.
#[allow(clippy::large_enum_variant, reason = "there is one in a run")]
enum Source {
    Surface(AnySurface),
    Model(Model),
    Mesh(Mesh),
}

pub(crate) fn run(arguments: &ConvertArguments, given: &Given) -> Result<Outcome, Failure> {
    output::check_names(&arguments.out)?;
    if output::is_step(&arguments.file) {
        return Err(Failure::new("STEP files are written, not read: convert what was saved as .planish"));
    }
    let mut table = Table::default();
    let source = read(arguments, given, &mut table)?;
    check_used(arguments, &source, given)?;
    let stem = arguments.file.file_stem().unwrap_or_default().to_string_lossy();
    let label = match &source {
        Source::Surface(surface) => surface.as_surface().region().label.clone(),
        Source::Model(_) | Source::Mesh(_) => Label::default(),
    };
    let mut step = arguments.step.step(&label, &stem);
    step.triangles = TessellateOptions {
        chord_tolerance: arguments.chord,
        max_edge_length: arguments.max_edge,
        ..TessellateOptions::default()
    };
    if let (Source::Surface(AnySurface::TSpline(_)), true) = (&source, arguments.step.is_patches()) {
        step.conversion.form.form = Form::Strips;
    }
    for path in &arguments.out {
        match &source {
            Source::Surface(surface) => output::write_surface(surface, path, &step)?,
            Source::Model(model) => output::write_model(model, path, &step)?,
            Source::Mesh(mesh) => write_mesh(mesh, path)?,
        }
        table.row("written", path.display().to_string());
    }
    output::print(table)?;
    Ok(Outcome::Done)
}

fn read(arguments: &ConvertArguments, given: &Given, table: &mut Table) -> Result<Source, Failure> {
    if !output::is_saved(&arguments.file) {
        for option in ["chord", "max-edge"] {
            given.refuse(option, false, "is not used: a mesh is triangles already")?;
        }
        let (mesh, repairs) = arguments.input.read(&arguments.file)?;
        output::repair_rows(table, &repairs);
        return Ok(Source::Mesh(mesh));
    }
    MeshInput::refuse(given)?;
    match load_any_file(&arguments.file)? {
        Saved::Surface(surface) => Ok(Source::Surface(surface)),
        Saved::Model(model) => Ok(Source::Model(model)),
        Saved::Curve(_) => {
            Err(Failure::new("a curve has no triangles and no faces: read it by planish_curve_load"))
        }
    }
}

/// Refuses what no file that is asked for would show.
fn check_used(arguments: &ConvertArguments, source: &Source, given: &Given) -> Result<(), Failure> {
    if let (Source::Mesh(_), Some(path)) = (source, arguments.out.iter().find(|path| output::is_exact(path)))
    {
        let name = path.display();
        return Err(Failure::new(format!(
            "a mesh is no surface: make '{name}' by planish fit MESH --out '{name}'"
        )));
    }
    StepArguments::check_used(given, output::writes_step(&arguments.out))?;
    let has_forms = matches!(source, Source::Surface(AnySurface::Pht(_) | AnySurface::TSpline(_)));
    for option in ["step-form", "level-spread"] {
        given.refuse(option, has_forms, "is not used: only a PHT-spline or T-spline has several forms")?;
    }
    given.refuse("level-spread", arguments.step.is_patches(), "is used with --step-form patches only")?;
    let has_triangles = !arguments.out.iter().all(|path| output::is_exact(path));
    for option in ["chord", "max-edge"] {
        given.refuse(option, has_triangles, "is not used: no triangles are written")?;
    }
    Ok(())
}

fn write_mesh(mesh: &Mesh, path: &Path) -> Result<(), Failure> {
    if !output::is_vtk(path) {
        return output::write_mesh(mesh, path);
    }
    let fields = mesh.fields().iter();
    let data: Vec<vtk::PointData> =
        fields.map(|field| vtk::PointData { name: &field.name, dim: 1, values: &field.values }).collect();
    Ok(vtk::write_mesh(mesh, &data, path)?)
}
