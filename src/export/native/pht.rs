//! A PHT-spline.
//!
//! ```text
//! offset  type          content
//! 24      u64           dim d
//! 32      u64           1 if there are weights, else 0; width w = d, or d + 1 with weights
//! 40      u64 x 2       lines B_u, B_v of the initial grid along u and v
//! 56      u64           number of splits S
//! 64      u64           number of basis vertices V
//! 72      u64           1 if there is a data box, else 0
//! 80      u64           number of trims
//! 88      f64           B_u lines, B_v lines
//!         u64 x 3 S     level, i, j of each cell that is split, a cell before its quarters
//!         f64 x 4 w V   for each basis vertex f, f_u, f_v, f_uv of w numbers; vertices ordered along u, then v
//!                       data box (u0 u1 v0 v1); for each trim a u64 count and count pairs (u,v)
//! ```
//! One with two continuous derivatives has the control points of its truncated hierarchical B-splines instead:
//! ```text
//! 24      u64           dim d
//! 32      u64 x 2       lines B_u, B_v of the initial grid along u and v
//! 48      u64           number of splits S
//! 56      u64           number of control points N
//! 64      u64           1 if there is a data box, else 0
//! 72      u64           number of trims
//! 80      f64           B_u lines, B_v lines
//!         u64 x 3 S     level, i, j of each cell that is split, a cell before its quarters
//!         f64 x d N     control points: level after level, in each along u, then v
//!                       data box (u0 u1 v0 v1); for each trim a u64 count and count pairs (u,v)
//! ```

use super::bytes::{Reader, Writer, region_size};
use super::{FIRST_VERSION, LoadError, PHT, SMOOTH_PHT, Save};
use crate::memory;
use crate::surface::pht::{PhtError, PhtSurface};
use crate::surface::tensor::Axis;
use crate::surface::{Label, Surface};
use crate::tmesh::{Cell, TMesh};

impl Save for PhtSurface {
    fn file_kind(&self) -> u32 {
        if self.smooth_control_points().is_some() { SMOOTH_PHT } else { PHT }
    }

    fn version(&self) -> u32 {
        if self.smooth_control_points().is_some() { VERSION_OF_SMOOTH } else { FIRST_VERSION }
    }

    fn label(&self) -> Option<&Label> {
        Some(&self.region().label)
    }

    fn content_size(&self) -> usize {
        let mesh = self.mesh();
        let (sizes, numbers) = match self.smooth_control_points() {
            Some(points) => (7, points.len()),
            None => (8, 4 * self.width() * self.jets().len()),
        };
        let doubles = mesh.breaks(Axis::U).len() + mesh.breaks(Axis::V).len() + numbers;
        8 * (sizes + doubles + 3 * mesh.splits().count()) + region_size(self.region())
    }

    fn write(&self, writer: &mut Writer) {
        let (mesh, smooth) = (self.mesh(), self.smooth_control_points());
        writer.count(self.dim());
        if smooth.is_none() {
            writer.count(usize::from(self.is_rational()));
        }
        writer.count(mesh.breaks(Axis::U).len());
        writer.count(mesh.breaks(Axis::V).len());
        writer.count(mesh.splits().count());
        writer.count(smooth.map_or(self.jets().len(), |points| points.len() / self.dim()));
        writer.region_sizes(self.region());
        writer.doubles(mesh.breaks(Axis::U));
        writer.doubles(mesh.breaks(Axis::V));
        for cell in mesh.splits() {
            [cell.level, cell.i, cell.j].into_iter().for_each(|number| writer.count(number as usize));
        }
        match smooth {
            Some(points) => writer.doubles(points),
            None => self.jets().for_each(|(_, jet)| writer.doubles(jet)),
        }
        writer.region(self.region());
    }
}

/// The first version that knows surfaces with two continuous derivatives.
const VERSION_OF_SMOOTH: u32 = 3;

/// A surface with two continuous derivatives.
pub(super) fn read_smooth(reader: &mut Reader) -> Result<PhtSurface, LoadError> {
    let dim = reader.count()?;
    let line_counts = [reader.count()?, reader.count()?];
    let (split_count, point_count) = (reader.count()?, reader.count()?);
    let has_data_box = reader.flag()?;
    let trim_count = reader.count()?;
    let [breaks_u, breaks_v] = [reader.doubles(line_counts[0])?, reader.doubles(line_counts[1])?];
    let splits = read_splits(reader, split_count)?;
    let points = reader.doubles(point_count.saturating_mul(dim))?;
    // there are more functions than initial cells, so that a grid is no larger than the file
    if dim == 0 || line_counts[0].saturating_mul(line_counts[1]) > point_count {
        return Err(reader.wrong(format!(
            "{point_count} control points of dimension {dim} are too few for the initial grid"
        )));
    }
    let surface = || -> Result<PhtSurface, PhtError> {
        let mut mesh = TMesh::new(&breaks_u, &breaks_v)?;
        mesh.split_all(&splits)?;
        PhtSurface::truncated(dim, mesh, &points)
    };
    let mut surface = surface().map_err(|error| reader.wrong(error.to_string()))?;
    *surface.region_mut() = reader.region(has_data_box, trim_count, &surface.domain())?;
    Ok(surface)
}

pub(super) fn read(reader: &mut Reader) -> Result<PhtSurface, LoadError> {
    let dim = reader.count()?;
    let is_rational = reader.flag()?;
    let line_counts = [reader.count()?, reader.count()?];
    let (split_count, vertex_count) = (reader.count()?, reader.count()?);
    let has_data_box = reader.flag()?;
    let trim_count = reader.count()?;
    let [breaks_u, breaks_v] = [reader.doubles(line_counts[0])?, reader.doubles(line_counts[1])?];
    let splits = read_splits(reader, split_count)?;
    let width = dim.saturating_add(usize::from(is_rational));
    let jets = reader.doubles(vertex_count.saturating_mul(4).saturating_mul(width))?;
    // the vertices have been read, so a grid that has no more of them is no larger than the file
    if dim == 0 || line_counts[0].saturating_mul(line_counts[1]) > vertex_count {
        return Err(reader
            .wrong(format!("{vertex_count} vertices of dimension {dim} are too few for the initial grid")));
    }
    let surface = || -> Result<PhtSurface, PhtError> {
        let mut mesh = TMesh::new(&breaks_u, &breaks_v)?;
        mesh.split_all(&splits)?;
        PhtSurface::new(dim, is_rational, mesh, &jets)
    };
    let mut surface = surface().map_err(|error| reader.wrong(error.to_string()))?;
    *surface.region_mut() = reader.region(has_data_box, trim_count, &surface.domain())?;
    Ok(surface)
}

pub(super) fn read_splits(reader: &mut Reader, count: usize) -> Result<Vec<Cell>, LoadError> {
    let mut splits = Vec::new();
    for _ in 0..count {
        let mut number = || {
            let number = reader.count()?;
            u32::try_from(number).map_err(|_| reader.wrong(format!("the cell number {number} is too large")))
        };
        memory::push(&mut splits, Cell { level: number()?, i: number()?, j: number()? });
    }
    Ok(splits)
}
