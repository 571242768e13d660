//! A file in the making.

use crate::memory;
use std::fmt::Write;

/// VTK_POLY_LINE
pub(super) const POLY_LINE: u8 = 4;
/// VTK_TRIANGLE
pub(super) const TRIANGLE: u8 = 5;
/// VTK_BEZIER_QUADRILATERAL
pub(super) const BEZIER_QUADRILATERAL: u8 = 77;

/// The XML part of a file, and the bytes that it points into.
pub(super) struct Grid {
    xml: String,
    appended: Vec<u8>,
}

impl Grid {
    pub(super) fn new(point_count: usize, cell_count: usize) -> Self {
        let xml = format!(
            "<?xml version=\"1.0\"?>\n\
             <VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" \
             header_type=\"UInt64\">\n<UnstructuredGrid>\n\
             <Piece NumberOfPoints=\"{point_count}\" NumberOfCells=\"{cell_count}\">\n"
        );
        Self { xml, appended: Vec::new() }
    }

    /// A section with the arrays that `fill` adds; `active` says which of them have a meaning.
    pub(super) fn section(&mut self, name: &str, active: &str, fill: impl FnOnce(&mut Self)) {
        // writing into a string cannot fail
        let _ = writeln!(self.xml, "<{name}{active}>");
        fill(self);
        let _ = writeln!(self.xml, "</{name}>");
    }

    pub(super) fn doubles(&mut self, name: &str, dim: usize, values: &[f64]) {
        self.array(name, "Float64", dim, values.iter().flat_map(|x| x.to_le_bytes()));
    }

    fn integers(&mut self, name: &str, values: impl Iterator<Item = i64>) {
        self.array(name, "Int64", 1, values.flat_map(i64::to_le_bytes));
    }

    /// Cells of one type, each with the numbers of its points.
    pub(super) fn cells<C: IntoIterator<Item = i64>>(&mut self, kind: u8, cells: impl Iterator<Item = C>) {
        let (mut points, mut ends) = (Vec::new(), Vec::new());
        for cell in cells {
            memory::extend(&mut points, cell);
            memory::push(&mut ends, points.len() as i64);
        }
        self.section("Cells", "", |grid| {
            let count = ends.len();
            grid.integers("connectivity", points.into_iter());
            grid.integers("offsets", ends.into_iter());
            grid.array("types", "UInt8", 1, std::iter::repeat_n(kind, count));
        });
    }

    fn array(&mut self, name: &str, kind: &str, dim: usize, bytes: impl Iterator<Item = u8>) {
        let offset = self.appended.len();
        let _ = writeln!(
            self.xml,
            "<DataArray type=\"{kind}\" Name=\"{}\" NumberOfComponents=\"{dim}\" format=\"appended\" \
             offset=\"{offset}\"/>",
            escape(name)
        );
        memory::extend(&mut self.appended, [0; 8]);
        memory::extend(&mut self.appended, bytes);
        let size = (self.appended.len() - offset - 8) as u64;
        self.appended[offset..offset + 8].copy_from_slice(&size.to_le_bytes());
    }

    pub(super) fn finish(self) -> Vec<u8> {
        let mut bytes = self.xml.into_bytes();
        memory::extend(&mut bytes, *b"</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_");
        memory::extend(&mut bytes, self.appended);
        memory::extend(&mut bytes, *b"\n</AppendedData>\n</VTKFile>\n");
        bytes
    }
}

fn escape(name: &str) -> String {
    name.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
