//! A tensor surface.
//!
//! ```text
//! offset  type          content
//! 24      u64           dim
//! 32      u64 x 2       degrees along u and v
//! 48      u64 x 2       knot counts K_u, K_v along u and v
//! 64      u64           1 if there are weights, else 0
//! 72      u64           1 if there is a data box, else 0
//! 80      u64           number of trims
//! 88      f64           K_u knots, K_v knots, control points (v runs fastest, dim numbers each),
//!                       weights, data box (u0 u1 v0 v1); for each trim a u64 count and count pairs (u,v)
//! ```

use super::bytes::{Reader, Writer, region_size};
use super::{LoadError, Save, TENSOR};
use crate::surface::tensor::{Axis, TensorSurface};
use crate::surface::{Label, Surface};

impl Save for TensorSurface {
    fn file_kind(&self) -> u32 {
        TENSOR
    }

    fn label(&self) -> Option<&Label> {
        Some(&self.region().label)
    }

    fn content_size(&self) -> usize {
        let doubles = self.knots(Axis::U).knots().len()
            + self.knots(Axis::V).knots().len()
            + self.control_points().len()
            + self.weights().map_or(0, <[f64]>::len);
        8 * (8 + doubles) + region_size(self.region())
    }

    fn write(&self, writer: &mut Writer) {
        let (knots_u, knots_v) = (self.knots(Axis::U), self.knots(Axis::V));
        writer.count(self.dim());
        writer.count(knots_u.degree());
        writer.count(knots_v.degree());
        writer.count(knots_u.knots().len());
        writer.count(knots_v.knots().len());
        writer.count(usize::from(self.weights().is_some()));
        writer.region_sizes(self.region());
        writer.doubles(knots_u.knots());
        writer.doubles(knots_v.knots());
        writer.doubles(self.control_points());
        writer.doubles(self.weights().unwrap_or(&[]));
        writer.region(self.region());
    }
}

pub(super) fn read(reader: &mut Reader) -> Result<TensorSurface, LoadError> {
    let dim = reader.count()?;
    let degrees = [reader.count()?, reader.count()?];
    let knot_counts = [reader.count()?, reader.count()?];
    let [has_weights, has_data_box] = [reader.flag()?, reader.flag()?];
    let trim_count = reader.count()?;
    let knots_u = reader.knots(degrees[0], knot_counts[0])?;
    let knots_v = reader.knots(degrees[1], knot_counts[1])?;
    let point_count = knots_u.basis_count() * knots_v.basis_count();
    let control_points = reader.doubles(point_count.saturating_mul(dim))?;
    let weights = if has_weights { Some(reader.doubles(point_count)?) } else { None };
    let mut surface = TensorSurface::new(dim, knots_u, knots_v, control_points, weights)
        .map_err(|error| reader.wrong(error.to_string()))?;
    *surface.region_mut() = reader.region(has_data_box, trim_count, &surface.domain())?;
    Ok(surface)
}
