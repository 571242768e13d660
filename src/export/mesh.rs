//! Mesh files that [`crate::mesh::read`] reads back: OFF, OBJ, PLY and STL.
//!
//! | | numbers | (u,v) | fields | nodes without triangles |
//! |---|---|---|---|---|
//! | OFF | text, to the same bits | as texture (`STOFF`) | no | kept |
//! | OBJ | text, to the same bits | as `vt` | no | kept |
//! | PLY | doubles, little-endian, or text | `u`, `v` | one property each | kept |
//! | STL | floats, little-endian, or text | no | no | lost, with all numbers of nodes |

use super::ExportError;
use crate::file;
use crate::memory::CollectVec;
use crate::mesh::{Format, Mesh};
use glam::DVec3;
use std::fmt::Write;
use std::path::Path;

/// Whether numbers are written as such or as their digits, in formats that know both.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Encoding {
    /// The bytes of the numbers.
    #[default]
    Binary,
    /// Their decimal digits.
    Text,
}

/// Writes a mesh. The file appears whole or not at all.
pub fn write(mesh: &Mesh, path: &Path, format: Format, encoding: Encoding) -> Result<(), ExportError> {
    Ok(file::write(path, &bytes(mesh, format, encoding))?)
}

/// Writes a mesh as a PLY file with a label for each triangle: a property of its faces, `uint label`. Labels that are not as
/// many as triangles are refused. The file appears whole or not at all.
pub fn write_labelled(
    mesh: &Mesh,
    labels: &[u32],
    path: &Path,
    encoding: Encoding,
) -> Result<(), ExportError> {
    let (count, expected) = (labels.len(), mesh.triangles().len());
    if count != expected {
        return Err(ExportError::Count { name: "labels".to_owned(), count, expected });
    }
    Ok(file::write(path, &ply(mesh, Some(labels), encoding))?)
}

/// The content of the file.
pub fn bytes(mesh: &Mesh, format: Format, encoding: Encoding) -> Vec<u8> {
    match (format, encoding) {
        (Format::Off, _) => off(mesh).into_bytes(),
        (Format::Obj, _) => obj(mesh).into_bytes(),
        (Format::Ply, _) => ply(mesh, None, encoding),
        (Format::Stl, Encoding::Text) => stl_text(mesh).into_bytes(),
        (Format::Stl, Encoding::Binary) => stl_binary(mesh),
    }
}

// writing into a string cannot fail, here and below

fn off(mesh: &Mesh) -> String {
    let kind = if mesh.parameters().is_some() { "STOFF" } else { "OFF" };
    let mut text = format!("{kind}\n{} {} 0\n", mesh.points().len(), mesh.triangles().len());
    for (node, p) in mesh.points().iter().enumerate() {
        let _ = match mesh.parameters() {
            Some(uv) => writeln!(text, "{} {} {} {} {}", p.x, p.y, p.z, uv[node].x, uv[node].y),
            None => writeln!(text, "{} {} {}", p.x, p.y, p.z),
        };
    }
    for [a, b, c] in mesh.triangles() {
        let _ = writeln!(text, "3 {a} {b} {c}");
    }
    text
}

fn obj(mesh: &Mesh) -> String {
    let mut text = String::from("# planish\n");
    for p in mesh.points() {
        let _ = writeln!(text, "v {} {} {}", p.x, p.y, p.z);
    }
    for uv in mesh.parameters().unwrap_or(&[]) {
        let _ = writeln!(text, "vt {} {}", uv.x, uv.y);
    }
    for triangle in mesh.triangles() {
        let [a, b, c] = triangle.map(|node| u64::from(node) + 1);
        let _ = match mesh.parameters() {
            Some(_) => writeln!(text, "f {a}/{a} {b}/{b} {c}/{c}"),
            None => writeln!(text, "f {a} {b} {c}"),
        };
    }
    text
}

fn ply(mesh: &Mesh, labels: Option<&[u32]>, encoding: Encoding) -> Vec<u8> {
    match encoding {
        Encoding::Text => ply_text(mesh, labels).into_bytes(),
        Encoding::Binary => ply_binary(mesh, labels),
    }
}

fn ply_header(mesh: &Mesh, labels: Option<&[u32]>, format: &str) -> String {
    let mut text =
        format!("ply\nformat {format} 1.0\ncomment planish\nelement vertex {}\n", mesh.points().len());
    let mut names: Vec<String> = ["x", "y", "z"].map(str::to_owned).to_vec();
    if mesh.parameters().is_some() {
        names.extend(["u", "v"].map(str::to_owned));
    }
    for field in mesh.fields() {
        // a property is one word, and a name that says something else is no field's
        let word: String =
            field.name.chars().map(|c| if c.is_whitespace() || c.is_control() { '_' } else { c }).collect();
        let mut name = if word.is_empty() { "field".to_owned() } else { word };
        while names.contains(&name) || RESERVED.contains(&name.as_str()) {
            name.insert_str(0, "field_");
        }
        names.push(name);
    }
    for name in names {
        let _ = writeln!(text, "property double {name}");
    }
    let label = labels.map_or("", |_| "property uint label\n");
    let _ = write!(
        text,
        "element face {}\nproperty list uchar uint vertex_indices\n{label}end_header\n",
        mesh.triangles().len()
    );
    text
}

/// Names that a reader takes for coordinates or parameters.
const RESERVED: [&str; 11] =
    ["x", "y", "z", "u", "v", "s", "t", "texture_u", "texture_v", "texture_s", "texture_t"];

/// The numbers of each node, in the order of the header.
fn rows(mesh: &Mesh) -> impl Iterator<Item = Vec<f64>> + '_ {
    mesh.points().iter().enumerate().map(|(node, point)| {
        let mut row = point.to_array().to_vec();
        row.extend(mesh.parameters().iter().flat_map(|uv| uv[node].to_array()));
        row.extend(mesh.fields().iter().map(|field| field.values[node]));
        row
    })
}

fn ply_text(mesh: &Mesh, labels: Option<&[u32]>) -> String {
    let mut text = ply_header(mesh, labels, "ascii");
    for row in rows(mesh) {
        let words: Vec<String> = row.iter().map(f64::to_string).collect_vec();
        let _ = writeln!(text, "{}", words.join(" "));
    }
    for (triangle, [a, b, c]) in mesh.triangles().iter().enumerate() {
        let label = labels.map_or(String::new(), |labels| format!(" {}", labels[triangle]));
        let _ = writeln!(text, "3 {a} {b} {c}{label}");
    }
    text
}

fn ply_binary(mesh: &Mesh, labels: Option<&[u32]>) -> Vec<u8> {
    let mut bytes = ply_header(mesh, labels, "binary_little_endian").into_bytes();
    rows(mesh).flatten().for_each(|number| bytes.extend(number.to_le_bytes()));
    for (triangle, nodes) in mesh.triangles().iter().enumerate() {
        bytes.push(3);
        nodes.iter().for_each(|node| bytes.extend(node.to_le_bytes()));
        bytes.extend(labels.into_iter().flat_map(|labels| labels[triangle].to_le_bytes()));
    }
    bytes
}

/// Each triangle's normal and corners.
fn facets(mesh: &Mesh) -> impl Iterator<Item = [DVec3; 4]> + '_ {
    mesh.triangles().iter().map(|triangle| {
        let [a, b, c] = triangle.map(|node| mesh.points()[node as usize]);
        [(b - a).cross(c - a).normalize_or_zero(), a, b, c]
    })
}

fn stl_text(mesh: &Mesh) -> String {
    let mut text = String::from("solid planish\n");
    for [n, a, b, c] in facets(mesh) {
        let _ = writeln!(text, "facet normal {} {} {}\nouter loop", n.x, n.y, n.z);
        for p in [a, b, c] {
            let _ = writeln!(text, "vertex {} {} {}", p.x, p.y, p.z);
        }
        text.push_str("endloop\nendfacet\n");
    }
    text.push_str("endsolid planish\n");
    text
}

fn stl_binary(mesh: &Mesh) -> Vec<u8> {
    // the name must not begin with `solid`, or other programs take the file for a text
    let mut bytes = b"planish".to_vec();
    bytes.resize(80, b' ');
    bytes.extend((mesh.triangles().len() as u32).to_le_bytes());
    for facet in facets(mesh) {
        facet.iter().flat_map(|p| p.to_array()).for_each(|x| bytes.extend((x as f32).to_le_bytes()));
        bytes.extend([0, 0]);
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{MeshOptions, read_bytes};

    const FORMATS: [Format; 4] = [Format::Off, Format::Obj, Format::Ply, Format::Stl];
    const ENCODINGS: [Encoding; 2] = [Encoding::Binary, Encoding::Text];

    #[test]
    fn what_is_written_reads_back_to_the_same_bits() {
        let mut mesh = crate::samples::curved_notch(3).unwrap();
        let heights: Vec<f64> = mesh.points().iter().map(|p| p.z / 3.0).collect();
        mesh.set_field("height of it", heights.clone()).unwrap();
        mesh.set_field("x", heights.clone()).unwrap();
        for _ in 0..2 {
            for (format, encoding) in FORMATS.into_iter().flat_map(|format| ENCODINGS.map(|e| (format, e))) {
                let (read, _) =
                    read_bytes(&bytes(&mesh, format, encoding), format, &MeshOptions::default()).unwrap();
                assert_eq!(read.triangles().len(), mesh.triangles().len());
                if format == Format::Stl {
                    let error = |(a, b): (f64, f64)| (a - b).abs();
                    let pairs = read.bounds().max.into_iter().zip(mesh.bounds().max);
                    let largest = pairs.map(error).fold(0.0, f64::max);
                    let rounding = if encoding == Encoding::Binary { f64::from(f32::EPSILON) } else { 0.0 };
                    assert!(largest <= rounding * mesh.diagonal(), "{largest:e}");
                    continue;
                }
                assert_eq!(read.points(), mesh.points());
                assert_eq!(read.triangles(), mesh.triangles());
                assert_eq!(read.parameters(), mesh.parameters());
                let is_ply = format == Format::Ply;
                assert_eq!(read.field("height_of_it"), is_ply.then_some(&heights[..]));
                assert_eq!(read.field("field_x"), is_ply.then_some(&heights[..]));
            }
            mesh.clear_parameters();
        }
    }

    #[test]
    fn labels_of_triangles_read_back() {
        let strips = crate::samples::wing_strips(1).unwrap();
        let folder = std::env::temp_dir();
        for encoding in ENCODINGS {
            let path = folder.join(format!("planish-labels-{}-{encoding:?}.ply", std::process::id()));
            write_labelled(&strips.mesh, &strips.labels, &path, encoding).unwrap();
            let read = crate::mesh::read_face_property(&path, "label", 0);
            std::fs::remove_file(&path).unwrap();
            let labels: Vec<f64> = strips.labels.iter().copied().map(f64::from).collect();
            assert_eq!(read.unwrap(), labels);
        }
        let few = &strips.labels[1..];
        let refused = write_labelled(&strips.mesh, few, &folder.join("none.ply"), Encoding::Text);
        assert!(matches!(refused, Err(ExportError::Count { .. })), "{refused:?}");
    }
}
