//! Wavefront OBJ: nodes, parameters as `vt`, triangles.

use super::error::ExportError;
use crate::file;
use crate::mesh::Mesh;
use std::fmt::Write;
use std::path::Path;

/// Writes a mesh; numbers read back to the same bits.
pub fn write(mesh: &Mesh, path: &Path) -> Result<(), ExportError> {
    Ok(file::write(path, text(mesh).as_bytes())?)
}

fn text(mesh: &Mesh) -> String {
    let mut text = String::from("# planish\n");
    // writing into a string cannot fail
    for p in mesh.points() {
        let _ = writeln!(text, "v {} {} {}", p.x, p.y, p.z);
    }
    for uv in mesh.parameters().unwrap_or(&[]) {
        let _ = writeln!(text, "vt {} {}", uv.x, uv.y);
    }
    for triangle in mesh.triangles() {
        let [a, b, c] = triangle.map(|node| node + 1);
        let _ = match mesh.parameters() {
            Some(_) => writeln!(text, "f {a}/{a} {b}/{b} {c}/{c}"),
            None => writeln!(text, "f {a} {b} {c}"),
        };
    }
    text
}

#[cfg(test)]
mod tests {
    use crate::mesh::{Format, MeshOptions, read_bytes};

    #[test]
    fn what_is_written_reads_back_to_the_same_bits() {
        let mut mesh = crate::samples::curved_notch(3).unwrap();
        for _ in 0..2 {
            let text = super::text(&mesh);
            let (read, _) = read_bytes(text.as_bytes(), Format::Obj, &MeshOptions::default()).unwrap();
            assert_eq!(read.points(), mesh.points());
            assert_eq!(read.triangles(), mesh.triangles());
            assert_eq!(read.parameters(), mesh.parameters());
            mesh.clear_parameters();
        }
    }
}
