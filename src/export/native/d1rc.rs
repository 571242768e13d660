//! A D1RC-spline: what it is made of; its functions are computed again.
//!
//! ```text
//! offset  type          content
//! 24      u64           dim d
//! 32      u64 x 2       vertices V and faces F of the control mesh
//! 48      u64           degree
//! 56      u64           mode: 0 reproducing, 1 as in the paper
//! 64      u64           boundary: 0 phantom, 1 clamped, 2 open
//! 72      u64           sharp edges: 0 as suits the mode, 1 cut, 2 sector, 3 additive
//! 80      u64 x 2       sharp edges S and corners C
//! 96      u64           1 if there is a data box, else 0
//! 104     u64           number of trims
//! 112     f64           weight of sharp functions
//! 120     f64 x 2 V     u, v of each vertex
//!         f64 x d V     control points
//!         u64 x 3 F     vertices of each face
//!         u64 x 2 S     ends of each sharp edge
//!         u64 x C       corners
//!                       data box (u0 u1 v0 v1); for each trim a u64 count and count pairs (u,v)
//! ```

use super::bytes::{Reader, Writer, region_size};
use super::{D1RC, LoadError, Save};
use crate::memory::{self, CollectVec};
use crate::surface::d1rc::{
    Boundary, D1rcError, D1rcMode, D1rcOptions, D1rcSurface, Recipe, SharpRule, Space,
};
use crate::surface::{Label, Surface};
use glam::DVec2;

const MODES: [D1rcMode; 2] = [D1rcMode::Reproducing, D1rcMode::Paper];
const BOUNDARIES: [Boundary; 3] = [Boundary::Phantom, Boundary::Clamped, Boundary::Open];
const SHARP_RULES: [SharpRule; 4] =
    [SharpRule::Automatic, SharpRule::Cut, SharpRule::Sector, SharpRule::Additive];

impl Save for D1rcSurface {
    fn file_kind(&self) -> u32 {
        D1RC
    }

    fn label(&self) -> Option<&Label> {
        Some(&self.region().label)
    }

    fn content_size(&self) -> usize {
        let recipe = &self.space().recipe;
        let arrays = 2 * recipe.uv.len()
            + self.control_points().len()
            + 3 * recipe.triangles.len()
            + 2 * recipe.sharp_edges.len()
            + recipe.corners.len();
        8 * (12 + arrays) + region_size(self.region())
    }

    fn write(&self, writer: &mut Writer) {
        let recipe = &self.space().recipe;
        let options = &recipe.options;
        writer.count(self.dim());
        writer.count(recipe.uv.len());
        writer.count(recipe.triangles.len());
        writer.count(options.degree);
        writer.count(number(&MODES, options.mode));
        writer.count(number(&BOUNDARIES, options.boundary));
        writer.count(number(&SHARP_RULES, options.sharp));
        writer.count(recipe.sharp_edges.len());
        writer.count(recipe.corners.len());
        writer.region_sizes(self.region());
        writer.doubles(&[options.sharp_weight]);
        recipe.uv.iter().for_each(|uv| writer.doubles(&uv.to_array()));
        writer.doubles(self.control_points());
        let vertices = recipe.triangles.iter().flatten().chain(recipe.sharp_edges.iter().flatten());
        vertices.chain(&recipe.corners).for_each(|&vertex| writer.count(vertex as usize));
        writer.region(self.region());
    }
}

fn number<T: PartialEq>(choices: &[T], choice: T) -> usize {
    choices.iter().position(|other| *other == choice).unwrap_or(0)
}

pub(super) fn read(reader: &mut Reader) -> Result<D1rcSurface, LoadError> {
    let dim = reader.count()?;
    let (vertex_count, face_count) = (reader.count()?, reader.count()?);
    let degree = reader.count()?;
    let mode = read_choice(reader, &MODES)?;
    let boundary = read_choice(reader, &BOUNDARIES)?;
    let sharp = read_choice(reader, &SHARP_RULES)?;
    let (sharp_count, corner_count) = (reader.count()?, reader.count()?);
    let has_data_box = reader.flag()?;
    let trim_count = reader.count()?;
    let sharp_weight = reader.doubles(1)?[0];
    let uv =
        reader.doubles(vertex_count.saturating_mul(2))?.chunks_exact(2).map(DVec2::from_slice).collect_vec();
    let points = reader.doubles(vertex_count.saturating_mul(dim))?;
    let recipe = Recipe {
        uv,
        triangles: read_vertices(reader, face_count.saturating_mul(3))?.as_chunks().0.to_vec(),
        options: D1rcOptions { degree, mode, boundary, sharp, sharp_weight },
        sharp_edges: read_vertices(reader, sharp_count.saturating_mul(2))?.as_chunks().0.to_vec(),
        corners: read_vertices(reader, corner_count)?,
    };
    let wrong = |error: D1rcError| reader.wrong(error.to_string());
    let mut surface = D1rcSurface::new(Space::new(recipe).map_err(wrong)?, dim, points).map_err(wrong)?;
    *surface.region_mut() = reader.region(has_data_box, trim_count, &surface.domain())?;
    Ok(surface)
}

fn read_choice<T: Copy>(reader: &mut Reader, choices: &[T]) -> Result<T, LoadError> {
    let number = reader.count()?;
    choices.get(number).copied().ok_or_else(|| reader.wrong(format!("there is no choice {number}")))
}

fn read_vertices(reader: &mut Reader, count: usize) -> Result<Vec<u32>, LoadError> {
    let mut vertices = Vec::new();
    for _ in 0..count {
        let vertex = reader.count()?;
        let vertex = u32::try_from(vertex);
        memory::push(&mut vertices, vertex.map_err(|_| reader.wrong("a vertex number is too large"))?);
    }
    Ok(vertices)
}
