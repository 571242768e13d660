//! What the commands print and write.

use crate::Failure;
use crate::picture::{Picture, View};
use glam::DVec2;
use planish::Control;
use planish::export::step::{self, StepOptions};
use planish::export::{native, obj, vtk};
use planish::fit::conversion::{ConversionOptions, to_model};
use planish::fit::report::FitReport;
use planish::mesh::{Mesh, MeshRepairs};
use planish::query::tessellate::{TessellateOptions, tessellate};
use planish::surface::AnySurface;
use std::fmt;
use std::path::Path;

/// Names on the left, values on the right.
#[derive(Debug, Default)]
pub struct Table(Vec<(&'static str, String)>);

impl Table {
    pub fn row(&mut self, name: &'static str, value: String) {
        self.0.push((name, value));
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let width = self.0.iter().map(|(name, _)| name.len()).max().unwrap_or(0);
        self.0.iter().try_for_each(|(name, value)| writeln!(f, "{name:width$}  {value}"))
    }
}

/// What was repaired while reading.
pub fn repairs(repairs: &MeshRepairs) -> String {
    let mut parts = Vec::new();
    for (count, what) in [
        (repairs.welded_nodes, "nodes welded"),
        (repairs.dropped_triangles, "triangles dropped"),
        (repairs.flipped_triangles, "triangles turned over"),
    ] {
        if count > 0 {
            parts.push(format!("{count} {what}"));
        }
    }
    if repairs.dropped_parameters {
        parts.push("parameters left out: they have seams".to_owned());
    }
    parts.join(", ")
}

const KNOWN: [&str; 5] = ["step", "stp", "vtu", "obj", "planish"];

/// Refuses names whose format is not known before any work is done.
pub fn check_names(paths: &[impl AsRef<Path>]) -> Result<(), Failure> {
    match paths.iter().map(AsRef::as_ref).find(|path| !KNOWN.contains(&extension(path).as_str())) {
        None => Ok(()),
        Some(path) => Err(Failure::new(format!(
            "cannot tell the format of {}, known are .{}",
            path.display(),
            KNOWN.join(", .")
        ))),
    }
}

fn extension(path: &Path) -> String {
    path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase()
}

/// Whether a name asks for a STEP file.
pub fn is_step(path: &Path) -> bool {
    ["step", "stp"].contains(&extension(path).as_str())
}

/// Whether a name asks for triangles of the surface.
pub fn is_tessellation(path: &Path) -> bool {
    extension(path) == "obj"
}

/// A fit by any method.
#[derive(Debug)]
pub struct Fit {
    pub surface: AnySurface,
    pub report: FitReport,
    /// The (u,v) of each node.
    pub parameters: Vec<DVec2>,
    /// The error of each node.
    pub errors: Vec<f64>,
}

/// What STEP files hold of a surface, and what they say beside the shape.
#[derive(Debug, Clone, Copy, Default)]
pub struct Step<'a> {
    pub conversion: ConversionOptions,
    pub text: StepOptions<'a>,
}

/// Writes a fit in the format of the name.
pub fn write_fit(mesh: &Mesh, fit: &Fit, path: &Path, step: &Step) -> Result<(), Failure> {
    if extension(path) == "vtu" {
        let data = vtk::PointData { name: "deviation", dim: 1, values: &fit.errors };
        let moved = vtk::on_surface(fit.surface.as_surface(), mesh, &fit.parameters)?;
        vtk::write_mesh(&moved, &[data], path)?;
        return Ok(());
    }
    write_surface(&fit.surface, path, step)
}

/// Writes a surface in the format of the name.
pub fn write_surface(surface: &AnySurface, path: &Path, step: &Step) -> Result<(), Failure> {
    match extension(path).as_str() {
        "step" | "stp" => {
            step::write(&to_model(surface, &step.conversion, &mut Control::default())?, &step.text, path)?;
        }
        "vtu" => match surface.as_surface().patches() {
            Some(patches) => vtk::write_patches(patches, path)?,
            None => {
                let options = vtk::SurfaceOptions::default();
                vtk::write_surface(surface.as_surface(), &options, path, Control::default().pool())?;
            }
        },
        "obj" => obj::write(&tessellate(surface.as_surface(), &TessellateOptions::default())?.mesh, path)?,
        _ => native::save_file(surface.as_saved(), path)?,
    }
    Ok(())
}

/// Writes a picture of the surface coloured by the error at the nodes.
pub fn write_picture(mesh: &Mesh, fit: &Fit, path: &Path) -> Result<(), Failure> {
    let moved = vtk::on_surface(fit.surface.as_surface(), mesh, &fit.parameters)?;
    let mut picture = Picture::new(1200, 900, &View::facing(&moved), &moved);
    let range = (0.0, fit.report.max_error);
    picture.draw_mesh(&moved, Some(&fit.errors), range);
    picture.draw_scale("deviation", range);
    write_png(&picture, path)
}

/// Writes a picture.
pub fn write_png(picture: &Picture, path: &Path) -> Result<(), Failure> {
    let fail = |reason: &dyn fmt::Display| Failure::new(format!("cannot write {}: {reason}", path.display()));
    let (width, height, pixels) = picture.finish();
    let file = std::fs::File::create(path).map_err(|error| fail(&error))?;
    let mut encoder = png::Encoder::new(std::io::BufWriter::new(file), width, height);
    encoder.set_color(png::ColorType::Rgb);
    let mut writer = encoder.write_header().map_err(|error| fail(&error))?;
    writer.write_image_data(&pixels).map_err(|error| fail(&error))?;
    writer.finish().map_err(|error| fail(&error))
}

/// Writes a text.
pub fn write_text(text: &str, path: &Path) -> Result<(), Failure> {
    std::fs::write(path, text)
        .map_err(|reason| Failure::new(format!("cannot write {}: {reason}", path.display())))
}
