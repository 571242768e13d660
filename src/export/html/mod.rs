//! The report as one page that needs nothing from outside: a table of what was measured, a histogram, the worst
//! places, and the mesh in space with its signed distances as colours, beside the surface and its control net.
//!
//! Positions travel as 16-bit shares of the view's half size: 1/65,536 of it is far below a pixel. A mesh of 10,000
//! nodes takes about 300 KB.

mod measured;
mod summary;

use super::error::ExportError;
use crate::file;
use crate::mesh::Mesh;
use crate::surface::ControlNet;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use glam::DVec3;
pub use measured::{ReportError, ReportOptions, write_model_report, write_report};
use std::fmt::Write;
use std::path::Path;
pub use summary::Statistics;

/// The page with places for its title, summary and data.
const PAGE: &str = include_str!("page.html");

/// The largest share of the half size in 16 bits.
const LARGEST: f64 = 32_767.0;

/// What a page shows.
pub struct Page<'a> {
    /// Its headline.
    pub title: &'a str,
    /// What one unit of length is called; may be empty.
    pub unit: &'a str,
    /// The mesh that was measured.
    pub mesh: &'a Mesh,
    /// The signed distance of each of its nodes: positive on the side of the surface's normal.
    pub distances: &'a [f64],
    /// Where the nearest place to each node lies, in words: (u,v), or a face and (u,v) on it.
    pub places: &'a dyn Fn(usize) -> String,
    /// The largest distance allowed.
    pub tolerance: f64,
    /// Further facts: a name and a value each.
    pub facts: &'a [(String, String)],
    /// What is worth knowing, and what to do about it.
    pub remarks: &'a [(String, String)],
    /// The surface as triangles, to be shown beside the mesh.
    pub surface: Option<&'a Mesh>,
    /// Its control points.
    pub net: Option<&'a ControlNet>,
}

/// Writes the page.
pub fn write(page: &Page, path: &Path) -> Result<(), ExportError> {
    Ok(file::write(path, text(page)?.as_bytes())?)
}

/// The page as one text.
pub fn text(page: &Page) -> Result<String, ExportError> {
    let nodes = page.mesh.points().len();
    if page.distances.len() != nodes {
        let name = "distances".to_owned();
        return Err(ExportError::Count { name, count: page.distances.len(), expected: nodes });
    }
    // in this order: what users write stands in the last two and is never searched
    let page_with = |place: &str, text: &str, of: &str| of.replacen(place, text, 1);
    let with_data = page_with("@DATA@", &data(page), PAGE);
    let with_title = page_with("@TITLE@", &escaped(page.title), &with_data);
    Ok(page_with("@SUMMARY@", &summary::html(page), &with_title))
}

/// The view: everything lies in the cube of this half size around this centre.
struct Frame {
    centre: DVec3,
    half: f64,
}

impl Frame {
    fn of(mesh: &Mesh) -> Self {
        let Some(&first) = mesh.points().first() else { return Self { centre: DVec3::ZERO, half: 1.0 } };
        let box_of = |(min, max): (DVec3, DVec3), p: &DVec3| (min.min(*p), max.max(*p));
        let (min, max) = mesh.points().iter().fold((first, first), box_of);
        Self { centre: (min + max) / 2.0, half: (min.distance(max) / 2.0).max(f64::MIN_POSITIVE) }
    }

    /// Points as 16-bit shares; what lies outside is brought to the edge.
    fn shares(&self, points: &[DVec3]) -> String {
        let bytes = points.iter().flat_map(|&p| {
            let share = ((p - self.centre) / self.half).clamp(DVec3::NEG_ONE, DVec3::ONE) * LARGEST;
            share.to_array().map(|x| x.round() as i16)
        });
        STANDARD.encode(bytes.flat_map(i16::to_le_bytes).collect::<Vec<u8>>())
    }

    fn triangles(&self, mesh: &Mesh, distances: Option<&[f64]>) -> String {
        let corners = mesh.triangles().iter().flatten().copied();
        let corners: Vec<u8> = match mesh.points().len() {
            0..=65_535 => corners.flat_map(|node| (node as u16).to_le_bytes()).collect(),
            _ => corners.flat_map(u32::to_le_bytes).collect(),
        };
        let mut json = format!(
            r#"{{"points":"{}","triangles":"{}""#,
            self.shares(mesh.points()),
            STANDARD.encode(corners)
        );
        if let Some(distances) = distances {
            let bytes: Vec<u8> = distances.iter().flat_map(|&d| (d as f32).to_le_bytes()).collect();
            // writing into a string cannot fail
            let _ = write!(json, r#","distances":"{}""#, STANDARD.encode(bytes));
        }
        json + "}"
    }

    fn net(&self, net: &ControlNet) -> String {
        let pairs = net.lines.iter().flat_map(|line| line.windows(2)).flatten();
        let ends: Vec<u8> = pairs.flat_map(|end| end.to_le_bytes()).collect();
        format!(r#"{{"points":"{}","ends":"{}"}}"#, self.shares(&net.points), STANDARD.encode(ends))
    }
}

/// What the page's program reads, as JSON.
fn data(page: &Page) -> String {
    let frame = Frame::of(page.mesh);
    let or_null = |part: Option<String>| part.unwrap_or_else(|| "null".to_owned());
    let DVec3 { x, y, z } = frame.centre;
    format!(
        r#"{{"tolerance":{:e},"unit":{},"centre":[{x:e},{y:e},{z:e}],"half":{:e},"mesh":{},"surface":{},"net":{}}}"#,
        page.tolerance.max(f64::MIN_POSITIVE),
        json_text(page.unit),
        frame.half,
        frame.triangles(page.mesh, Some(page.distances)),
        or_null(page.surface.map(|surface| frame.triangles(surface, None))),
        or_null(page.net.map(|net| frame.net(net))),
    )
}

/// A text that HTML shows as it is.
fn escaped(text: &str) -> String {
    text.chars().fold(String::with_capacity(text.len()), |mut done, c| {
        match c {
            '&' => done.push_str("&amp;"),
            '<' => done.push_str("&lt;"),
            '>' => done.push_str("&gt;"),
            '"' => done.push_str("&quot;"),
            '\'' => done.push_str("&#39;"),
            c => done.push(c),
        }
        done
    })
}

/// A JSON text that may stand in a script element: no `<` ends that early.
fn json_text(text: &str) -> String {
    let quoted = text.chars().fold(String::from("\""), |mut done, c| {
        match c {
            '"' | '\\' | '<' | '\u{0}'..='\u{1f}' | '\u{2028}' | '\u{2029}' => {
                let _ = write!(done, "\\u{:04x}", c as u32);
            }
            c => done.push(c),
        }
        done
    });
    quoted + "\""
}

#[cfg(test)]
mod tests;
