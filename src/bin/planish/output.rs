//! What the commands print and write.

use crate::Failure;
use crate::picture::{Picture, View};
use crate::step::Step;
use glam::DVec2;
use planish::Control;
use planish::control::Watch;
use planish::export::gltf::{self, Colours};
use planish::export::html::{self, ReportOptions};
use planish::export::mesh::Encoding;
use planish::export::{mesh as mesh_files, native, step, vtk};
use planish::file;
use planish::fit::conversion::to_model;
use planish::fit::model::ModelFit;
use planish::fit::report::{FitReport, Remarks, ToleranceScale};
use planish::memory;
use planish::mesh::{Format, Mesh, MeshRepairs};
use planish::model::Model;
use planish::query::tessellate::tessellate;
use planish::surface::AnySurface;
use std::fmt;
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

/// Names on the left, values on the right.
#[derive(Debug, Default)]
pub(crate) struct Table(Vec<(&'static str, String)>);

impl Table {
    pub(crate) fn row(&mut self, name: &'static str, value: String) {
        self.0.push((name, value));
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let width = self.0.iter().map(|(name, _)| name.len()).max().unwrap_or(0);
        self.0.iter().try_for_each(|(name, value)| writeln!(f, "{name:width$}  {value}"))
    }
}

/// Writes to standard output. Whoever reads may have heard enough: a closed pipe ends the output and is no failure.
pub(crate) fn print(text: impl fmt::Display) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    match write!(out, "{text}").and_then(|()| out.flush()) {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        Err(error) => Err(Failure::new(format!("cannot write to standard output: {error}"))),
        Ok(()) => Ok(()),
    }
}

/// The files that were written.
pub(crate) fn names<'a>(paths: impl IntoIterator<Item = &'a PathBuf>) -> Vec<String> {
    paths.into_iter().map(|path| path.display().to_string()).collect()
}

/// What was repaired while reading.
pub(crate) fn repairs(repairs: &MeshRepairs) -> String {
    let counts = [
        (repairs.welded_nodes, "nodes welded"),
        (repairs.dropped_triangles, "triangles without area dropped"),
        (repairs.duplicate_triangles, "copies of triangles dropped"),
        (repairs.parted_edges, "edges of several sheets parted"),
        (repairs.flipped_triangles, "triangles turned over"),
        (repairs.split_nodes, "nodes added where it touched itself"),
        (repairs.unused_nodes, "unused nodes passed over"),
    ];
    let mut parts: Vec<String> = counts
        .iter()
        .filter(|(count, _)| *count > 0)
        .map(|(count, what)| format!("{count} {what}"))
        .collect();
    if repairs.dropped_parameters {
        parts.push("parameters left out: they have seams, or span no area".to_owned());
    }
    if repairs.missing_end {
        parts.push("the file ends too early, after a whole facet".to_owned());
    }
    parts.join(", ")
}

/// Tables that begin with a mesh say what was repaired, and what was left aside.
pub(crate) fn repair_rows(table: &mut Table, made: &MeshRepairs) {
    if !made.is_empty() {
        table.row("repaired", repairs(made));
    }
    if made.excluded_triangles > 0 {
        table.row("left aside", format!("{} triangles of other components", made.excluded_triangles));
    }
}

/// Tells components that would hang together if nodes at one place were one, and how to join them.
pub(crate) fn loose_row(table: &mut Table, mesh: &Mesh) {
    let count = mesh.component_count();
    if count < 2 {
        return;
    }
    let mut places: Vec<[u64; 3]> = mesh.points().iter().map(|p| p.to_array().map(f64::to_bits)).collect();
    places.sort_unstable();
    let twins = places.windows(2).filter(|pair| pair[0] == pair[1]).count();
    if twins > 0 {
        let distance = 1e-9 * mesh.diagonal();
        let told =
            format!("{count} components, {twins} nodes lie on others: --weld {distance:.0e} joins them");
        table.row("loose", told);
    }
}

/// The formats of surfaces, by the ends of names.
pub(crate) const SURFACES: &[&str] = &["step", "stp", "vtu", "obj", "off", "ply", "stl", "glb", "planish"];
/// Those of meshes.
pub(crate) const MESHES: &[&str] = &["obj", "off", "ply", "stl", "glb"];
/// Those of pictures.
pub(crate) const PICTURES: &[&str] = &["png"];
/// Those of reports.
pub(crate) const REPORTS: &[&str] = &["html", "htm"];

/// Refuses names whose format is not known before any work is done.
pub(crate) fn check_names(paths: &[impl AsRef<Path>]) -> Result<(), Failure> {
    paths.iter().try_for_each(|path| check_name(path.as_ref(), SURFACES))
}

/// Refuses a name that does not end in one of these, or where no file can be.
pub(crate) fn check_name(path: &Path, known: &[&str]) -> Result<(), Failure> {
    let name = path.display();
    if !known.contains(&extension(path).as_str()) {
        let known = known.join(", .");
        return Err(Failure::new(format!("cannot tell the format of '{name}', known are .{known}")));
    }
    if path.is_dir() {
        return Err(Failure::new(format!("cannot write '{name}': it is a folder")));
    }
    match path.parent().filter(|folder| !folder.as_os_str().is_empty() && !folder.is_dir()) {
        Some(folder) => {
            let folder = folder.display();
            Err(Failure::new(format!("cannot write '{name}': there is no folder '{folder}', make it first")))
        }
        None => Ok(()),
    }
}

fn extension(path: &Path) -> String {
    path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase()
}

/// Whether a name asks for a STEP file.
pub(crate) fn is_step(path: &Path) -> bool {
    ["step", "stp"].contains(&extension(path).as_str())
}

/// Whether one of some names asks for a STEP file.
pub(crate) fn writes_step(paths: &[PathBuf]) -> bool {
    paths.iter().any(|path| is_step(path))
}

/// Whether a name asks for a file of this program's own.
pub(crate) fn is_saved(path: &Path) -> bool {
    extension(path) == "planish"
}

/// Whether a name asks for a file of surfaces, not of triangles.
pub(crate) fn is_exact(path: &Path) -> bool {
    is_step(path) || is_saved(path)
}

/// Whether a name asks for a file for ParaView.
pub(crate) fn is_vtk(path: &Path) -> bool {
    extension(path) == "vtu"
}

/// Whether what a fit writes under a name is the mesh with its deviation.
pub(crate) fn shows_deviation(path: &Path) -> bool {
    ["vtu", "glb"].contains(&extension(path).as_str())
}

/// A fit by any method.
#[derive(Debug)]
pub(crate) struct Fit {
    pub surface: AnySurface,
    pub report: FitReport,
    /// The (u,v) of each node.
    pub parameters: Vec<DVec2>,
    /// The error of each node.
    pub errors: Vec<f64>,
}

/// Writes a fit in the format of the name.
pub(crate) fn write_fit(mesh: &Mesh, fit: &Fit, path: &Path, step: &Step) -> Result<(), Failure> {
    if shows_deviation(path) {
        let moved = vtk::on_surface(fit.surface.as_surface(), mesh, &fit.parameters)?;
        return write_deviation(&moved, &fit.errors, path);
    }
    write_surface(&fit.surface, path, step)
}

/// Writes a mesh that lies on what was fitted to it, with the errors of its nodes.
pub(crate) fn write_deviation(moved: &Mesh, errors: &[f64], path: &Path) -> Result<(), Failure> {
    if extension(path) == "glb" {
        let largest =
            errors.iter().copied().filter(|error| error.is_finite()).fold(f64::MIN_POSITIVE, f64::max);
        return Ok(gltf::write(moved, Some(Colours { values: errors, limit: largest }), path)?);
    }
    let data = vtk::PointData { name: "deviation", dim: 1, values: errors };
    Ok(vtk::write_mesh(moved, &[data], path)?)
}

/// Writes a surface in the format of the name.
pub(crate) fn write_surface(surface: &AnySurface, path: &Path, step: &Step) -> Result<(), Failure> {
    match extension(path).as_str() {
        "step" | "stp" => {
            step::write(
                &to_model(surface, &step.conversion, &mut Control::default())?,
                &step.text,
                path,
                &Watch::default(),
            )?;
        }
        "vtu" => match surface.as_surface().patches() {
            Some(patches) => vtk::write_patches(patches, path)?,
            None => {
                let options = vtk::SurfaceOptions { tessellate: step.triangles, ..Default::default() };
                vtk::write_surface(surface.as_surface(), &options, path, Control::default().pool())?;
            }
        },
        "planish" => native::save_file(surface.as_saved(), path)?,
        _ => write_mesh(&tessellate(surface.as_surface(), &step.triangles)?.mesh, path)?,
    }
    Ok(())
}

/// Writes a model in the format of the name.
pub(crate) fn write_model(model: &Model, path: &Path, step: &Step) -> Result<(), Failure> {
    match extension(path).as_str() {
        "step" | "stp" => {
            step::write(model, &step.text, path, &Watch::default())?;
        }
        "vtu" => {
            let options = vtk::SurfaceOptions { tessellate: step.triangles, ..Default::default() };
            vtk::write_model(model, &options, path, Control::default().pool())?;
        }
        "planish" => native::save_file(model, path)?,
        _ => write_mesh(&model.tessellate(&step.triangles)?.mesh, path)?,
    }
    Ok(())
}

/// A page about a fit with a tolerance in model units.
fn report_options(title: &str, tolerance: f64, remarks: Remarks) -> ReportOptions<'_> {
    let tolerance_scale = ToleranceScale::Absolute;
    ReportOptions { title, unit: "", tolerance: Some(tolerance), tolerance_scale, remarks }
}

/// Writes a report of the surface against the mesh that it was fitted to.
pub(crate) fn write_report(
    mesh: &Mesh,
    fit: &Fit,
    title: &str,
    path: &Path,
    control: &mut Control,
) -> Result<(), Failure> {
    let options = report_options(title, fit.report.tolerance, fit.report.remarks);
    Ok(html::write_report(fit.surface.as_surface(), mesh, &options, path, control)?)
}

/// Writes the page of a model.
pub(crate) fn write_model_report(
    mesh: &Mesh,
    fit: &ModelFit,
    title: &str,
    path: &Path,
    control: &mut Control,
) -> Result<(), Failure> {
    let options = report_options(title, fit.report.tolerance, fit.report.remarks);
    Ok(html::write_model_report(&fit.model, mesh, &options, path, control)?)
}

/// Writes a picture of the surface coloured by the error at the nodes.
pub(crate) fn write_picture(mesh: &Mesh, fit: &Fit, path: &Path) -> Result<(), Failure> {
    let moved = vtk::on_surface(fit.surface.as_surface(), mesh, &fit.parameters)?;
    let mut picture = Picture::new(1200, 900, &View::facing(&moved), &moved);
    let range = (0.0, fit.report.max_error);
    picture.draw_mesh(&moved, Some(&fit.errors), range);
    picture.draw_scale("deviation", range);
    write_png(&picture, path)
}

/// Writes a mesh in the format of the name.
pub(crate) fn write_mesh(mesh: &Mesh, path: &Path) -> Result<(), Failure> {
    check_name(path, MESHES)?;
    if extension(path) == "glb" {
        return Ok(gltf::write(mesh, None, path)?);
    }
    let format = Format::of_path(path).unwrap_or(Format::Obj);
    Ok(mesh_files::write(mesh, path, format, Encoding::Binary)?)
}

/// Writes a picture.
pub(crate) fn write_png(picture: &Picture, path: &Path) -> Result<(), Failure> {
    check_name(path, PICTURES)?;
    let (width, height, pixels) = picture.finish();
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&pixels)?;
    writer.finish()?;
    Ok(file::write(path, &bytes)?)
}

/// Writes a text.
pub(crate) fn write_text(text: &str, path: &Path) -> Result<(), Failure> {
    Ok(file::write(path, text.as_bytes())?)
}

/// Reads a text.
pub(crate) fn read_text(path: &Path) -> Result<String, Failure> {
    let bytes = file::read(path, memory::limit(0))?;
    String::from_utf8(bytes).map_err(|error| {
        Failure::new(format!(
            "'{}' is no text in UTF-8: byte {}",
            path.display(),
            error.utf8_error().valid_up_to()
        ))
    })
}
