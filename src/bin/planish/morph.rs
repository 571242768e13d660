//! `planish morph`.

use crate::input::MeshInput;
use crate::output::{self, write_png, write_surface};
use crate::picture::{Picture, View};
use crate::step::Step;
use crate::{Failure, Outcome};
use clap::Args;
use glam::{DVec2, DVec3};
use planish::Control;
use planish::export::vtk::on_surface;
use planish::fit::common::Regularize;
use planish::fit::report::{Remarks, Tolerance};
use planish::fit::tensor::{TensorFit, TensorOptions, fit_field, fit_mesh};
use planish::mesh::Mesh;
use planish::query::tessellate::{TessellateOptions, tessellate};
use planish::surface::tensor::TensorSurface;
use planish::surface::{Surface, normal};
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub(crate) struct MorphArguments {
    /// Mesh file with fields on its nodes (PLY).
    mesh: PathBuf,
    /// Fields of the mesh that are the displacement: three for its components, or one along the normals.
    #[arg(long, value_name = "X,Y,Z", value_delimiter = ',', required = true)]
    displacement: Vec<String>,
    /// The pictures to write: NAME.png becomes NAME-00.png, NAME-01.png and so on.
    #[arg(long, value_name = "PNG")]
    out: PathBuf,
    /// Number of pictures.
    #[arg(long, default_value_t = 6, value_name = "N", value_parser = clap::value_parser!(u16).range(2..=1000))]
    frames: u16,
    /// Factor of the displacement in the first picture.
    #[arg(long, default_value_t = 0.0, value_name = "FACTOR", allow_hyphen_values = true)]
    from: f64,
    /// Factor of the displacement in the last picture.
    #[arg(long, default_value_t = 1.0, value_name = "FACTOR", allow_hyphen_values = true)]
    to: f64,
    /// Open a closed mesh along the shortest path between two nodes, counted from 0.
    #[arg(long, value_name = "A,B", value_delimiter = ',', num_args = 1)]
    cut: Vec<u32>,
    /// Largest error allowed at the nodes, as a fraction of the diagonal of shape and of displacement.
    #[arg(long, default_value_t = 1e-3, value_name = "T", allow_negative_numbers = true)]
    tolerance: f64,
    #[command(flatten)]
    input: MeshInput,
    /// Save the surface of the last picture: .planish, .step, .vtu, .obj.
    #[arg(long, value_name = "FILE")]
    save: Option<PathBuf>,
}

pub(crate) fn run(arguments: &MorphArguments) -> Result<Outcome, Failure> {
    if let Some(path) = &arguments.save {
        output::check_names(&[path])?;
    }
    output::check_name(&arguments.out, output::PICTURES)?;
    let mut mesh = opened(arguments.input.read(&arguments.mesh)?.0, &arguments.cut)?;
    let mut control = Control::default();
    let options = TensorOptions {
        tolerance: Tolerance { value: arguments.tolerance, ..Tolerance::default() },
        regularize: Regularize::Never,
        ..TensorOptions::default()
    };
    let shape = fit_mesh(&mesh, &options, &mut control)?;
    mesh.set_parameters(shape.parameters.clone())?;
    let ways = displacement(&mesh, &shape, &arguments.displacement)?;
    let way = fit_field(&mesh, &ways, 3, &options, &mut control)?;
    say("shape", &shape)?;
    say("displacement", &way)?;

    let moved = |factor: f64| TensorSurface::combine(&[(1.0, &shape.surface), (factor, &way.surface)]);
    let last = moved(arguments.to)?;
    let triangles = tessellate(&last, &TessellateOptions::default())?.mesh;
    let uv = triangles.parameters().unwrap_or_default();
    let at = |surface: &TensorSurface| on_surface(surface, &triangles, uv);
    let first = at(&moved(arguments.from)?)?;
    let scene = together(&first, &triangles)?;
    let view = View::facing(&first);
    let lengths: Vec<f64> = rows(&way.surface, uv, 0).chunks(3).map(|row| vector(row).length()).collect();
    let most = arguments.from.abs().max(arguments.to.abs()) * lengths.iter().fold(0.0, |a: f64, b| a.max(*b));
    for frame in 0..arguments.frames {
        let share = f64::from(frame) / f64::from(arguments.frames - 1);
        let factor = arguments.from + share * (arguments.to - arguments.from);
        let colors: Vec<f64> = lengths.iter().map(|length| factor.abs() * length).collect();
        let mut picture = Picture::new(1200, 900, &view, &scene);
        picture.draw_mesh(&at(&moved(factor)?)?, Some(&colors), (0.0, most));
        picture.draw_scale("displacement", (0.0, most));
        let path = numbered(&arguments.out, frame);
        write_png(&picture, &path)?;
        output::print(format_args!("written  {}\n", path.display()))?;
    }
    if let Some(path) = &arguments.save {
        write_surface(&last.into(), path, &Step::default())?;
        output::print(format_args!("written  {}\n", path.display()))?;
    }
    let is_met = [&shape, &way].iter().all(|fit| !fit.report.remarks.has(Remarks::TOLERANCE_NOT_MET));
    Ok(if is_met { Outcome::Done } else { Outcome::ToleranceNotMet })
}

fn say(what: &str, fit: &TensorFit) -> Result<(), Failure> {
    let report = &fit.report;
    let mut line = format!(
        "{what}: {} x {} knots, max error {:.2e} of {:.2e} allowed",
        report.grid_u, report.grid_v, report.max_error, report.tolerance
    );
    for (remark, words) in [
        (Remarks::ROUGH_BETWEEN_NODES, ", rough between the nodes"),
        (Remarks::SEGMENTATION_ADVISED, ", cut it into several charts"),
    ] {
        if report.remarks.has(remark) {
            line.push_str(words);
        }
    }
    output::print(line + "\n")
}

fn opened(mesh: Mesh, cut: &[u32]) -> Result<Mesh, Failure> {
    match *cut {
        [] => Ok(mesh),
        [from, to] => Ok(mesh.cut_along(&mesh.shortest_path(from, to)?)?.mesh),
        _ => Err(Failure::new("--cut takes two nodes, say --cut 0,2000")),
    }
}

/// The displacement of each node, row by row.
fn displacement(mesh: &Mesh, shape: &TensorFit, names: &[String]) -> Result<Vec<f64>, Failure> {
    let field = |name: &String| {
        let there = || mesh.fields().iter().map(|field| field.name.as_str()).collect::<Vec<_>>().join(", ");
        mesh.field(name)
            .ok_or_else(|| Failure::new(format!("there is no field {name}; there are {}", there())))
    };
    match names {
        [x, y, z] => {
            let (x, y, z) = (field(x)?, field(y)?, field(z)?);
            Ok(x.iter().zip(y).zip(z).flat_map(|((x, y), z)| [*x, *y, *z]).collect())
        }
        [name] => {
            let rows = rows(&shape.surface, &shape.parameters, 1);
            let normals = rows.chunks_exact(9).map(|row| normal(vector(&row[3..]), vector(&row[6..])));
            Ok(field(name)?.iter().zip(normals).flat_map(|(x, normal)| (*x * normal).to_array()).collect())
        }
        _ => Err(Failure::new("--displacement takes one field or three")),
    }
}

/// Values of a surface in space and its derivatives up to an order.
fn rows(surface: &TensorSurface, uv: &[DVec2], order: usize) -> Vec<f64> {
    let mut rows = vec![0.0; 3 * (order + 1) * (order + 2) / 2 * uv.len()];
    surface.eval_rows(uv, order, &mut rows);
    rows
}

fn vector(numbers: &[f64]) -> DVec3 {
    DVec3::from_slice(numbers)
}

/// Two meshes as one, for a picture that has room for both.
fn together(first: &Mesh, last: &Mesh) -> Result<Mesh, Failure> {
    let count = first.points().len() as u32;
    let points = first.points().iter().chain(last.points()).copied().collect();
    let moved = last.triangles().iter().map(|triangle| triangle.map(|node| node + count));
    Ok(Mesh::new(points, first.triangles().iter().copied().chain(moved).collect())?)
}

/// `name.png` with a number.
fn numbered(path: &Path, number: u16) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{stem}-{number:02}.png"))
}
