//! Binary glTF 2.0 (.glb): triangles, in colours if there are values on the nodes. Windows, macOS, Blender and
//! browsers show it.
//!
//! Khronos Group, "glTF 2.0 Specification", sections 3 and 4.4:
//! ```text
//! header (magic, version, length)   chunk JSON, padded with blanks   chunk BIN, padded with zeros
//! ```
//! Positions are 32-bit floats about the mesh's centre, which a translation puts back: a part far from the origin
//! keeps its digits.

use super::error::ExportError;
use crate::file;
use crate::memory::{self, CollectVec};
use crate::mesh::Mesh;
use glam::DVec3;
use std::path::Path;

/// Signed values on the nodes, shown as colours.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Colours<'a> {
    /// One for each node.
    pub values: &'a [f64],
    /// Where the colours end on both sides; positive.
    pub limit: f64,
}

/// Blue over green to red, as inspection programs show signed distances.
const STOPS: [[f64; 3]; 5] =
    [[0.05, 0.2, 0.8], [0.1, 0.75, 0.85], [0.25, 0.8, 0.3], [0.98, 0.85, 0.2], [0.85, 0.1, 0.1]];

/// Writes the triangles.
pub fn write(mesh: &Mesh, colours: Option<Colours>, path: &Path) -> Result<(), ExportError> {
    let expected = mesh.points().len();
    if let Some(Colours { values, .. }) = colours.filter(|colours| colours.values.len() != expected) {
        return Err(ExportError::Count { name: "values".to_owned(), count: values.len(), expected });
    }
    Ok(file::write(path, &bytes(mesh, colours))?)
}

/// A part of the binary chunk, as the JSON describes it.
struct View {
    bytes: Vec<u8>,
    /// 34962 for data of vertices, 34963 for indices.
    target: u32,
    accessor: String,
}

fn bytes(mesh: &Mesh, colours: Option<Colours>) -> Vec<u8> {
    let (centre, views) = views(mesh, colours);
    let mut binary = Vec::new();
    let mut told = Vec::new();
    for view in &views {
        told.push(format!(
            r#"{{"buffer":0,"byteOffset":{},"byteLength":{},"target":{}}}"#,
            binary.len(),
            view.bytes.len(),
            view.target
        ));
        binary.extend_from_slice(&view.bytes);
        pad(&mut binary, 0);
    }
    let accessors: Vec<&str> = views.iter().map(|view| view.accessor.as_str()).collect_vec();
    let attributes = if colours.is_some() { r#""POSITION":1,"COLOR_0":2"# } else { r#""POSITION":1"# };
    let json = format!(
        concat!(
            r#"{{"asset":{{"version":"2.0","generator":"planish"}},"scene":0,"scenes":[{{"nodes":[0]}}],"#,
            r#""nodes":[{{"mesh":0,"translation":[{},{},{}]}}],"#,
            r#""meshes":[{{"primitives":[{{"attributes":{{{}}},"indices":0,"material":0}}]}}],"#,
            r#""materials":[{{"doubleSided":true,"pbrMetallicRoughness":{{"metallicFactor":0,"roughnessFactor":0.8}}}}],"#,
            r#""buffers":[{{"byteLength":{}}}],"bufferViews":[{}],"accessors":[{}]}}"#,
        ),
        centre.x,
        centre.y,
        centre.z,
        attributes,
        binary.len(),
        told.join(","),
        accessors.join(",")
    );
    let mut json = json.into_bytes();
    pad(&mut json, b' ');
    let length = 12 + 8 + json.len() + 8 + binary.len();
    let mut file = memory::with_capacity(length);
    file.extend_from_slice(b"glTF");
    for word in [2, length as u32, json.len() as u32] {
        file.extend_from_slice(&word.to_le_bytes());
    }
    file.extend_from_slice(b"JSON");
    file.extend_from_slice(&json);
    file.extend_from_slice(&(binary.len() as u32).to_le_bytes());
    file.extend_from_slice(b"BIN\0");
    file.extend_from_slice(&binary);
    file
}

/// Chunks and the data in them begin at multiples of four bytes.
fn pad(bytes: &mut Vec<u8>, with: u8) {
    bytes.resize(bytes.len().next_multiple_of(4), with);
}

/// The centre of the mesh; its indices, positions about the centre, and colours.
fn views(mesh: &Mesh, colours: Option<Colours>) -> (DVec3, Vec<View>) {
    let points = mesh.points();
    let bounds = |(min, max): (DVec3, DVec3), p: &DVec3| (min.min(*p), max.max(*p));
    let (min, max) = points.iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), bounds);
    let centre = if points.is_empty() { DVec3::ZERO } else { (min + max) / 2.0 };
    let indices = View {
        bytes: mesh.triangles().iter().flatten().flat_map(|node| node.to_le_bytes()).collect(),
        target: 34963,
        accessor: format!(
            r#"{{"bufferView":0,"componentType":5125,"count":{},"type":"SCALAR"}}"#,
            3 * mesh.triangles().len()
        ),
    };
    let places: Vec<[f32; 3]> =
        points.iter().map(|&p| (p - centre).to_array().map(|x| x as f32)).collect_vec();
    // the specification wants the exact box of the numbers written
    let least = |k: usize| places.iter().fold(f32::INFINITY, |least, p| least.min(p[k]));
    let largest = |k: usize| places.iter().fold(f32::NEG_INFINITY, |largest, p| largest.max(p[k]));
    let positions = View {
        bytes: places.iter().flatten().flat_map(|x| x.to_le_bytes()).collect(),
        target: 34962,
        accessor: format!(
            r#"{{"bufferView":1,"componentType":5126,"count":{},"type":"VEC3","min":{:?},"max":{:?}}}"#,
            places.len(),
            [0, 1, 2].map(least),
            [0, 1, 2].map(largest)
        ),
    };
    let mut views = vec![indices, positions];
    if let Some(Colours { values, limit }) = colours {
        let rgba = values.iter().flat_map(|&value| {
            let [r, g, b] = colour(value / limit).map(|share| (255.0 * share).round() as u8);
            [r, g, b, 255]
        });
        views.push(View {
            bytes: rgba.collect(),
            target: 34962,
            accessor: format!(
                r#"{{"bufferView":2,"componentType":5121,"normalized":true,"count":{},"type":"VEC4"}}"#,
                values.len()
            ),
        });
    }
    (centre, views)
}

/// The colour of a share of the limit, -1 to 1; what is beyond has that of the end, NaN that of zero.
fn colour(share: f64) -> [f64; 3] {
    let share = if share.is_nan() { 0.0 } else { share.clamp(-1.0, 1.0) };
    let at = (share + 1.0) * 2.0;
    let low = (at as usize).min(STOPS.len() - 2);
    let share = at - low as f64;
    [0, 1, 2].map(|k| (1.0 - share) * STOPS[low][k] + share * STOPS[low + 1][k])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples;

    fn word(bytes: &[u8], at: usize) -> usize {
        u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize
    }

    #[test]
    fn the_file_is_laid_out_as_the_specification_says() {
        let mesh = samples::curved_notch(1).unwrap();
        let nodes = mesh.points().len();
        let values = vec![0.25; nodes];
        for colours in [None, Some(Colours { values: &values, limit: 0.5 })] {
            let file = bytes(&mesh, colours);
            assert_eq!((&file[..4], word(&file, 4), word(&file, 8)), (&b"glTF"[..], 2, file.len()));
            let json = word(&file, 12);
            assert_eq!((&file[16..20], json % 4), (&b"JSON"[..], 0));
            let text = std::str::from_utf8(&file[20..20 + json]).unwrap();
            assert_eq!(text.matches('{').count(), text.matches('}').count());
            assert!(!text.contains("inf") && !text.contains("NaN"));
            let binary = &file[20 + json..];
            assert_eq!((word(binary, 0), &binary[4..8]), (binary.len() - 8, &b"BIN\0"[..]));
            let parts = 12 * mesh.triangles().len() + nodes * if colours.is_some() { 16 } else { 12 };
            assert_eq!(binary.len() - 8, parts);
        }
    }

    #[test]
    fn colours_run_from_blue_over_green_to_red() {
        assert_eq!([-2.0, -1.0, 0.0, 1.0].map(colour), [STOPS[0], STOPS[0], STOPS[2], STOPS[4]]);
        assert_eq!(colour(f64::NAN), STOPS[2]);
    }

    #[test]
    fn a_value_for_each_node_is_needed() {
        let mesh = samples::curved_notch(1).unwrap();
        let colours = Colours { values: &[0.0], limit: 1.0 };
        let error = write(&mesh, Some(colours), Path::new("never written")).unwrap_err();
        assert!(matches!(error, ExportError::Count { count: 1, .. }));
    }
}
