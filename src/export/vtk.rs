//! VTK unstructured grids (`.vtu`), with raw binary arrays at the end of the file.
//!
//! "The VTK User's Guide", chapter "VTK File Formats". Readable by VTK 9, ParaView and meshio.

use super::error::{ExportError, write_file};
use crate::control::Pool;
use crate::error::Error;
use crate::mesh::{Mesh, MeshError};
use crate::query::deviation::{DeviationOptions, deviation};
use crate::query::tessellate::{TessellateOptions, tessellate};
use crate::surface::Surface;
use glam::{DVec2, DVec3};
use std::fmt::Write;
use std::path::Path;

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
    let count = mesh.points().len();
    for data in data {
        let expected = count * data.dim;
        if data.values.len() != expected {
            let name = data.name.to_owned();
            return Err(ExportError::Count { name, count: data.values.len(), expected });
        }
    }
    let uv: Vec<f64> = mesh.parameters().unwrap_or(&[]).iter().flat_map(|uv| uv.to_array()).collect();
    let points: Vec<f64> = mesh.points().iter().flat_map(|p| p.to_array()).collect();
    let triangles = mesh.triangles();
    let mut grid = Grid::new(count, triangles.len());
    grid.section("PointData", |grid| {
        if !uv.is_empty() {
            grid.doubles("uv", 2, &uv);
        }
        data.iter().for_each(|data| grid.doubles(data.name, data.dim, data.values));
    });
    grid.section("Points", |grid| grid.doubles("points", 3, &points));
    grid.section("Cells", |grid| {
        grid.integers("connectivity", triangles.iter().flatten().map(|&node| i64::from(node)));
        grid.integers("offsets", (1..=triangles.len() as i64).map(|k| 3 * k));
        grid.types(triangles.iter().map(|_| Grid::TRIANGLE));
    });
    write_file(path, &grid.finish())
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
) -> Result<(), Error> {
    let Some(mesh) = options.deviation_from else {
        let tessellation = tessellate(surface, &options.tessellate)?;
        return Ok(write_mesh(&tessellation.mesh, &[], path)?);
    };
    let report = deviation(surface, mesh, &DeviationOptions::default(), pool)?;
    let moved = on_surface(surface, mesh, &report.uv)?;
    let deviation = PointData { name: "deviation", dim: 1, values: &report.nodes.each };
    Ok(write_mesh(&moved, &[deviation], path)?)
}

/// A mesh with its nodes on a surface in space, at these parameters.
pub fn on_surface(surface: &dyn Surface, mesh: &Mesh, uv: &[DVec2]) -> Result<Mesh, MeshError> {
    let mut rows = vec![0.0; 3 * uv.len()];
    surface.eval_rows(uv, 0, &mut rows);
    let points = rows.chunks_exact(3).map(DVec3::from_slice).collect();
    let mut moved = Mesh::new(points, mesh.triangles().to_vec())?;
    moved.set_parameters(uv.to_vec())?;
    Ok(moved)
}

/// A file in the making: the XML part, and the bytes that it points into.
struct Grid {
    xml: String,
    appended: Vec<u8>,
}

impl Grid {
    /// VTK_TRIANGLE
    const TRIANGLE: u8 = 5;

    fn new(point_count: usize, cell_count: usize) -> Self {
        let xml = format!(
            "<?xml version=\"1.0\"?>\n\
             <VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" \
             header_type=\"UInt64\">\n<UnstructuredGrid>\n\
             <Piece NumberOfPoints=\"{point_count}\" NumberOfCells=\"{cell_count}\">\n"
        );
        Self { xml, appended: Vec::new() }
    }

    fn section(&mut self, name: &str, fill: impl FnOnce(&mut Self)) {
        // writing into a string cannot fail
        let _ = writeln!(self.xml, "<{name}>");
        fill(self);
        let _ = writeln!(self.xml, "</{name}>");
    }

    fn doubles(&mut self, name: &str, dim: usize, values: &[f64]) {
        self.array(name, "Float64", dim, values.iter().flat_map(|x| x.to_le_bytes()));
    }

    fn integers(&mut self, name: &str, values: impl Iterator<Item = i64>) {
        self.array(name, "Int64", 1, values.flat_map(i64::to_le_bytes));
    }

    fn types(&mut self, values: impl Iterator<Item = u8>) {
        self.array("types", "UInt8", 1, values);
    }

    fn array(&mut self, name: &str, kind: &str, dim: usize, bytes: impl Iterator<Item = u8>) {
        let offset = self.appended.len();
        let _ = writeln!(
            self.xml,
            "<DataArray type=\"{kind}\" Name=\"{}\" NumberOfComponents=\"{dim}\" format=\"appended\" \
             offset=\"{offset}\"/>",
            escape(name)
        );
        self.appended.extend([0; 8]);
        self.appended.extend(bytes);
        let size = (self.appended.len() - offset - 8) as u64;
        self.appended[offset..offset + 8].copy_from_slice(&size.to_le_bytes());
    }

    fn finish(self) -> Vec<u8> {
        let mut bytes = self.xml.into_bytes();
        bytes.extend_from_slice(b"</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_");
        bytes.extend(self.appended);
        bytes.extend_from_slice(b"\n</AppendedData>\n</VTKFile>\n");
        bytes
    }
}

fn escape(name: &str) -> String {
    name.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
