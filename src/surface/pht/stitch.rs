//! Two surfaces that shall meet with common tangents along an edge.
//!
//! Both edges get the same vertices, by splits on the coarser side, and the same jets there: the means of the
//! positions and of the derivatives along the edge, and of those across it with the sense in which the surfaces
//! run away from the edge. A surface whose parameters run faster across its edge keeps its pace: the derivative
//! across is averaged in units of both domains' widths.

use super::{PhtError, PhtSurface};
use crate::memory::{self, CollectVec};
use crate::surface::Surface;
use crate::surface::tensor::Axis;
use crate::tmesh::{Cell, MAX_LEVEL, TMesh, Vertex};
use std::sync::OnceLock;

/// One of the four edges of a surface's domain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BorderSide {
    /// Least u.
    LowU,
    /// Largest u.
    HighU,
    /// Least v.
    LowV,
    /// Largest v.
    HighV,
}

impl BorderSide {
    /// The direction in which the edge runs.
    fn along(self) -> Axis {
        match self {
            Self::LowU | Self::HighU => Axis::V,
            Self::LowV | Self::HighV => Axis::U,
        }
    }

    fn is_high(self) -> bool {
        matches!(self, Self::HighU | Self::HighV)
    }

    /// The vertex at a coordinate along the edge.
    fn vertex(self, mesh: &TMesh, at: u32) -> Vertex {
        let last = mesh.last_vertex();
        match self {
            Self::LowU => Vertex { i: 0, j: at },
            Self::HighU => Vertex { i: last.i, j: at },
            Self::LowV => Vertex { i: at, j: 0 },
            Self::HighV => Vertex { i: at, j: last.j },
        }
    }

    /// The rows of a jet: f, along the edge, across it, mixed.
    fn rows(self) -> [usize; 4] {
        match self.along() {
            Axis::U => [0, 1, 2, 3],
            Axis::V => [0, 2, 1, 3],
        }
    }
}

/// One side of a seam.
struct Seam<'a> {
    surface: &'a PhtSurface,
    side: BorderSide,
    is_reversed: bool,
}

impl Seam<'_> {
    /// Coordinates of the vertices along the edge, from the seam's beginning.
    fn coordinates(&self) -> Vec<u32> {
        let (axis, end) = (self.side.along(), self.end());
        let on_edge = |vertex: &&Vertex| **vertex == self.side.vertex(&self.surface.mesh, vertex.along(axis));
        let mut coordinates: Vec<u32> = self
            .surface
            .jets
            .keys()
            .filter(on_edge)
            .map(|vertex| self.turn(vertex.along(axis), end))
            .collect_vec();
        coordinates.sort_unstable();
        coordinates
    }

    fn end(&self) -> u32 {
        self.surface.mesh.last_vertex().along(self.side.along())
    }

    fn turn(&self, at: u32, end: u32) -> u32 {
        if self.is_reversed { end - at } else { at }
    }

    /// Splits the leaves at the edge until it has vertices at all of `wanted`.
    fn splits(&self, wanted: &[u32]) -> Result<Vec<Cell>, PhtError> {
        let mut mesh = self.surface.mesh.clone();
        let (axis, end) = (self.side.along(), self.end());
        let mut splits = Vec::new();
        for &at in wanted {
            let at = self.turn(at, end);
            let vertex = self.side.vertex(&mesh, at);
            let ahead = match (self.side, at < end) {
                (BorderSide::LowU, ahead) => [1, u32::from(ahead)],
                (BorderSide::HighU, ahead) => [0, u32::from(ahead)],
                (BorderSide::LowV, ahead) => [u32::from(ahead), 1],
                (BorderSide::HighV, ahead) => [u32::from(ahead), 0],
            };
            while let Some(leaf) = mesh.leaf_beside(vertex, ahead) {
                let cell = mesh.cell(leaf);
                if cell.corners().iter().any(|corner| corner.along(axis) == at) {
                    break;
                }
                debug_assert!(cell.level < MAX_LEVEL, "the coordinate is one of a vertex");
                mesh.split(leaf);
                memory::push(&mut splits, cell);
            }
        }
        Ok(splits)
    }

    /// The sizes of the domain along and across the edge, with the sense of the seam: along it, and away from
    /// it into the surface.
    fn scales(&self) -> [f64; 2] {
        let size = self.surface.domain().size();
        let (along, across) = if self.side.along() == Axis::U { (size.x, size.y) } else { (size.y, size.x) };
        [if self.is_reversed { -along } else { along }, if self.side.is_high() { -across } else { across }]
    }
}

/// Makes two surfaces meet with common tangents along an edge of each. `is_reversed` says that the edges run in
/// opposite directions. Their initial grids must have equally many cells along the edge, at the same fractions.
/// Changes neither if they cannot be stitched.
pub fn stitch(
    first: (&mut PhtSurface, BorderSide),
    second: (&mut PhtSurface, BorderSide),
    is_reversed: bool,
) -> Result<(), PhtError> {
    let seams = [
        Seam { surface: first.0, side: first.1, is_reversed: false },
        Seam { surface: second.0, side: second.1, is_reversed },
    ];
    check(&seams)?;
    let wanted = seams.each_ref().map(Seam::coordinates);
    let splits = [seams[0].splits(&wanted[1])?, seams[1].splits(&wanted[0])?];
    let (mut a, mut b) = (seams[0].surface.clone(), seams[1].surface.clone());
    a.split(&splits[0])?;
    b.split(&splits[1])?;
    average([(&mut a, first.1, false), (&mut b, second.1, is_reversed)]);
    a.check_weights()?;
    b.check_weights()?;
    (*first.0, *second.0) = (a, b);
    Ok(())
}

fn check(seams: &[Seam; 2]) -> Result<(), PhtError> {
    let refuse = |reason| Err(PhtError::Stitch { reason });
    let [a, b] = seams.each_ref().map(|seam| seam.surface);
    if a.dim != b.dim || a.is_rational != b.is_rational {
        return refuse("the dimensions differ, or only one has weights");
    }
    let fractions = |seam: &Seam| -> Vec<f64> {
        let breaks = seam.surface.mesh.breaks(seam.side.along());
        let (from, to) = (breaks[0], breaks[breaks.len() - 1]);
        let mut fractions: Vec<f64> = breaks.iter().map(|t| (t - from) / (to - from)).collect_vec();
        if seam.is_reversed {
            fractions.reverse();
            fractions.iter_mut().for_each(|t| *t = 1.0 - *t);
        }
        fractions
    };
    let [a, b] = seams.each_ref().map(fractions);
    if a.len() != b.len() {
        return refuse("the initial grids have different numbers of cells along the edge");
    }
    // fractions of a few roundings each
    if a.iter().zip(&b).any(|(a, b)| (a - b).abs() > 8.0 * f64::EPSILON) {
        return refuse("the initial grid lines lie at different fractions of the edge");
    }
    Ok(())
}

/// Replaces the jets along the seam by their means.
fn average(sides: [(&mut PhtSurface, BorderSide, bool); 2]) {
    let [(a, side_a, _), (b, side_b, is_reversed)] = sides;
    let width = a.width();
    let seam_a = Seam { surface: a, side: side_a, is_reversed: false };
    let seam_b = Seam { surface: b, side: side_b, is_reversed };
    let (at_a, end) = (seam_a.coordinates(), seam_b.end());
    let scales = [seam_a.scales(), seam_b.scales()];
    for at in at_a {
        let vertices =
            [side_a.vertex(&a.mesh, at), side_b.vertex(&b.mesh, if is_reversed { end - at } else { at })];
        let (Some(jet_a), Some(jet_b)) = (a.jets.get_mut(&vertices[0]), b.jets.get_mut(&vertices[1])) else {
            continue; // both edges have vertices at the same places by now
        };
        for (row, (row_a, row_b)) in side_a.rows().into_iter().zip(side_b.rows()).enumerate() {
            // into the seam's own units; across, the surfaces run away from each other
            let unit = |scale: [f64; 2]| [1.0, scale[0], scale[1], scale[0] * scale[1]][row];
            let (unit_a, unit_b) = (unit(scales[0]), if row < 2 { 1.0 } else { -1.0 } * unit(scales[1]));
            for k in 0..width {
                let (x, y) = (&mut jet_a[row_a * width + k], &mut jet_b[row_b * width + k]);
                let mean = (*x * unit_a + *y * unit_b) / 2.0;
                (*x, *y) = (mean / unit_a, mean / unit_b);
            }
        }
    }
    (a.view, b.view) = (OnceLock::new(), OnceLock::new());
}
