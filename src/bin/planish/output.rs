//! What the commands print and write.

use crate::Failure;
use glam::{DVec2, DVec3};
use planish::export::picture::{Picture, View};
use planish::export::step::{self, StepOptions};
use planish::export::{native, obj, vtk};
use planish::fit::tessellation::TensorFit;
use planish::mesh::{Mesh, MeshRepairs};
use planish::query::tessellate::{TessellateOptions, tessellate};
use planish::surface::tspline::TSplineSurface;
use planish::surface::{AnySurface, Domain, Patches, Surface};
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

/// Writes a fit in the format of the name; `step` says what STEP files say beside the shape.
pub fn write_fit(mesh: &Mesh, fit: &TensorFit, path: &Path, step: &StepOptions) -> Result<(), Failure> {
    if extension(path) == "vtu" {
        let data = vtk::PointData { name: "deviation", dim: 1, values: &fit.errors };
        vtk::write_mesh(&vtk::on_surface(&fit.surface, mesh, &fit.parameters)?, &[data], path)?;
        return Ok(());
    }
    write_surface(&fit.surface.clone().into(), path, step)
}

/// Writes a surface in the format of the name.
pub fn write_surface(surface: &AnySurface, path: &Path, step: &StepOptions) -> Result<(), Failure> {
    match extension(path).as_str() {
        "step" | "stp" => {
            step::write(surface, step, path)?;
        }
        "vtu" => match surface.as_surface().patches() {
            Some(patches) => vtk::write_patches(patches, path)?,
            None => return Err(Failure::new("this family of surface has no patches for .vtu")),
        },
        "obj" => obj::write(&tessellate(surface.as_surface(), &TessellateOptions::default())?.mesh, path)?,
        _ => native::save_file(surface.as_saved(), path)?,
    }
    Ok(())
}

/// Writes a picture of the surface coloured by the error at the nodes.
pub fn write_picture(mesh: &Mesh, fit: &TensorFit, path: &Path) -> Result<(), Failure> {
    let moved = vtk::on_surface(&fit.surface, mesh, &fit.parameters)?;
    let mut picture = Picture::new(1200, 900, &View::facing(&moved), &moved);
    let range = (0.0, fit.report.max_error);
    picture.draw_mesh(&moved, Some(&fit.errors), range);
    picture.draw_scale("deviation", range);
    write_png(&picture, path)
}

/// Writes a picture of a surface with the borders of its patches, and its control net on request.
pub fn write_knot_picture(surface: &TSplineSurface, has_net: bool, path: &Path) -> Result<(), Failure> {
    const KNOT_LINE: [f64; 3] = [0.15, 0.2, 0.3];
    const NET_LINE: [f64; 3] = [0.8, 0.2, 0.1];
    /// Straight pieces of one side of a patch.
    const PIECES: usize = 8;
    let shape = tessellate(surface, &TessellateOptions::default())?.mesh;
    let mut picture = Picture::new(1200, 900, &View::facing(&shape), &shape);
    picture.draw_mesh(&shape, None, (0.0, 1.0));
    for index in 0..surface.patch_count() {
        let Domain { min, max } = surface.patch(index).domain;
        for end in [DVec2::new(min.x, max.y), DVec2::new(max.x, min.y)] {
            let uv: Vec<DVec2> = (0..=PIECES).map(|k| min.lerp(end, k as f64 / PIECES as f64)).collect();
            let mut rows = vec![0.0; 3 * uv.len()];
            surface.eval_rows(&uv, 0, &mut rows);
            let points: Vec<DVec3> = rows.chunks(3).map(DVec3::from_slice).collect();
            picture.draw_line(&points, KNOT_LINE);
        }
    }
    for curve in surface.curves().iter().filter(|_| has_net) {
        let points: Vec<DVec3> = curve.control_points().chunks(3).map(DVec3::from_slice).collect();
        picture.draw_line(&points, NET_LINE);
    }
    write_png(&picture, path)
}

fn write_png(picture: &Picture, path: &Path) -> Result<(), Failure> {
    let fail = |reason: &dyn fmt::Display| Failure::new(format!("cannot write {}: {reason}", path.display()));
    let (width, height, pixels) = picture.finish();
    let file = std::fs::File::create(path).map_err(|error| fail(&error))?;
    let mut encoder = png::Encoder::new(std::io::BufWriter::new(file), width, height);
    encoder.set_color(png::ColorType::Rgb);
    let mut writer = encoder.write_header().map_err(|error| fail(&error))?;
    writer.write_image_data(&pixels).map_err(|error| fail(&error))?;
    writer.finish().map_err(|error| fail(&error))
}
