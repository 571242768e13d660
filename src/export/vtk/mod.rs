//! VTK unstructured grids (`.vtu`), with raw binary arrays at the end of the file.
//!
//! "The VTK User's Guide", chapter "VTK File Formats". Readable by VTK 9, ParaView and meshio.

mod bezier;
mod grid;

pub use bezier::write_patches;

use super::error::ExportError;
use crate::control::Pool;
use crate::failure::{Classify, ErrorKind};
use crate::file;
use crate::memory::{self, CollectVec};
use crate::mesh::{Mesh, MeshError};
use crate::model::{Model, ModelTessellation};
use crate::query::deviation::{DeviationError, DeviationOptions, deviation};
use crate::query::tessellate::{TessellateError, TessellateOptions, tessellate_watched};
use crate::surface::{ControlNet, Surface};
use glam::{DVec2, DVec3};
use grid::Grid;
use std::path::Path;

/// A surface cannot be written as triangles.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum VtkError {
    /// It cannot be tessellated.
    #[error(transparent)]
    Tessellate(#[from] TessellateError),
    /// It cannot be measured against the mesh.
    #[error(transparent)]
    Deviation(#[from] DeviationError),
    /// The mesh, moved onto it, is none.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The file cannot be written.
    #[error(transparent)]
    Export(#[from] ExportError),
}

impl VtkError {
    fn own(&self) -> &dyn Classify {
        match self {
            Self::Tessellate(error) => error,
            Self::Deviation(error) => error,
            Self::Mesh(error) => error,
            Self::Export(error) => error,
        }
    }
}

impl Classify for VtkError {
    fn kind(&self) -> ErrorKind {
        self.own().kind()
    }

    fn index(&self) -> Option<usize> {
        self.own().index()
    }
}

/// Numbers at each node of a mesh.
#[derive(Debug, Clone, Copy)]
pub struct PointData<'a> {
    /// What programs show; XML's special characters are replaced.
    pub name: &'a str,
    /// Numbers a node.
    pub dim: usize,
    /// Rows of `dim` numbers.
    pub values: &'a [f64],
}

/// Writes a mesh with its parameters (as `uv`) and further numbers at its nodes.
pub fn write_mesh(mesh: &Mesh, data: &[PointData], path: &Path) -> Result<(), ExportError> {
    write_triangles(mesh, data, &[], path)
}

/// The same with a number for each triangle, by name.
fn write_triangles(
    mesh: &Mesh,
    data: &[PointData],
    cells: &[(&str, &[f64])],
    path: &Path,
) -> Result<(), ExportError> {
    let count = mesh.points().len();
    for data in data {
        let expected = count * data.dim;
        if data.values.len() != expected {
            let name = data.name.to_owned();
            return Err(ExportError::Count { name, count: data.values.len(), expected });
        }
    }
    let uv: Vec<f64> = mesh.parameters().unwrap_or(&[]).iter().flat_map(|uv| uv.to_array()).collect_vec();
    let points: Vec<f64> = mesh.points().iter().flat_map(|p| p.to_array()).collect_vec();
    let triangles = mesh.triangles();
    let mut grid = Grid::new(count, triangles.len());
    grid.section("PointData", "", |grid| {
        if !uv.is_empty() {
            grid.doubles("uv", 2, &uv);
        }
        data.iter().for_each(|data| grid.doubles(data.name, data.dim, data.values));
    });
    if !cells.is_empty() {
        grid.section("CellData", "", |grid| {
            cells.iter().for_each(|(name, values)| grid.doubles(name, 1, values))
        });
    }
    grid.section("Points", "", |grid| grid.doubles("points", 3, &points));
    grid.cells(grid::TRIANGLE, triangles.iter().map(|nodes| nodes.map(i64::from)));
    Ok(file::write(path, &grid.finish())?)
}

/// What a picture of a surface shows.
#[derive(Debug, Clone, Copy, Default)]
pub struct SurfaceOptions<'a> {
    /// How the surface is tessellated.
    pub tessellate: TessellateOptions,
    /// A mesh to compare with: its triangles are then shown instead of a tessellation, each node moved to its
    /// nearest place on the surface, with the distance as `deviation`.
    pub deviation_from: Option<&'a Mesh>,
}

/// Writes the part of a surface inside its trims as triangles.
pub fn write_surface(
    surface: &dyn Surface,
    options: &SurfaceOptions,
    path: &Path,
    pool: &Pool,
) -> Result<(), VtkError> {
    let Some(mesh) = options.deviation_from else {
        let tessellation = tessellate_watched(surface, &options.tessellate, pool.watch())?;
        return Ok(write_mesh(&tessellation.mesh, &[], path)?);
    };
    let report = deviation(surface, mesh, &DeviationOptions::default(), pool)?;
    let moved = on_surface(surface, mesh, &report.uv)?;
    let deviation = PointData { name: "deviation", dim: 1, values: &report.nodes.each };
    Ok(write_mesh(&moved, &[deviation], path)?)
}

/// Writes a model as triangles, with the number of the face under each as cell data `face`.
pub fn write_model(
    model: &Model,
    options: &SurfaceOptions,
    path: &Path,
    pool: &Pool,
) -> Result<(), VtkError> {
    let Some(mesh) = options.deviation_from else {
        let ModelTessellation { mesh, faces, .. } = model.tessellate(&options.tessellate)?;
        let faces: Vec<f64> = faces.iter().map(|face| face.index() as f64).collect_vec();
        return Ok(write_triangles(&mesh, &[], &[("face", &faces)], path)?);
    };
    let report = model.deviation(mesh, &DeviationOptions::default(), pool)?;
    let feet = report.faces.iter().zip(&report.uv);
    let places = feet.map(|(face, &uv)| face.map_or(DVec3::NAN, |face| model.carrier(face).points(&[uv])[0]));
    let moved = Mesh::new(places.collect_vec(), memory::copied(mesh.triangles()))?;
    let deviation = PointData { name: "deviation", dim: 1, values: &report.nodes.each };
    Ok(write_mesh(&moved, &[deviation], path)?)
}

/// A mesh with its nodes on a surface in space, at these parameters. Nodes without triangles stay where they are, if they
/// are anywhere.
pub fn on_surface(surface: &dyn Surface, mesh: &Mesh, uv: &[DVec2]) -> Result<Mesh, MeshError> {
    let some_place = uv[mesh.triangles()[0][0] as usize];
    let is_used = |node: usize| mesh.is_used(node as u32);
    let uv: Vec<DVec2> =
        uv.iter().enumerate().map(|(node, &uv)| if is_used(node) { uv } else { some_place }).collect_vec();
    let mut rows = memory::filled(0.0, 3 * uv.len());
    surface.eval_rows(&uv, 0, &mut rows);
    let place = |(node, row): (usize, &[f64])| match mesh.points()[node] {
        point if point.is_finite() && !is_used(node) => point,
        _ => DVec3::from_slice(row),
    };
    let mut moved = Mesh::new(
        rows.chunks_exact(3).enumerate().map(place).collect_vec(),
        memory::copied(mesh.triangles()),
    )?;
    moved.set_parameters(uv)?;
    Ok(moved)
}

/// Writes the control points of a surface in space, joined by the lines of its control net.
pub fn write_control_net(net: &ControlNet, path: &Path) -> Result<(), ExportError> {
    let mut grid = Grid::new(net.points.len(), net.lines.len());
    let points: Vec<f64> = net.points.iter().flat_map(|p| p.to_array()).collect_vec();
    grid.section("PointData", "", |grid| {
        if let Some(weights) = &net.weights {
            grid.doubles("weight", 1, weights);
        }
    });
    grid.section("Points", "", |grid| grid.doubles("points", 3, &points));
    grid.cells(grid::POLY_LINE, net.lines.iter().map(|line| line.iter().map(|&point| i64::from(point))));
    Ok(file::write(path, &grid.finish())?)
}
