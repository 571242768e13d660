//! A T-spline with control curves.
//!
//! ```text
//! offset  type          content
//! 24      u64           dim
//! 32      u64           knot count K_v along v; there are K_v - 4 control curves
//! 40      u64           1 if there is a data box, else 0
//! 48      u64           number of trims
//! 56      f64           K_v knots along v
//!                       for each curve a u64 knot count K, K knots, and (K - 4) rows of dim numbers
//!                       data box (u0 u1 v0 v1); for each trim a u64 count and count pairs (u,v)
//! ```

use super::bytes::{Reader, Writer, region_size};
use super::{LoadError, Save, TSPLINE};
use crate::curve::Curve;
use crate::memory;
use crate::surface::tspline::{DEGREE, TSplineSurface};
use crate::surface::{Label, Surface};

impl Save for TSplineSurface {
    fn file_kind(&self) -> u32 {
        TSPLINE
    }

    fn label(&self) -> Option<&Label> {
        Some(&self.region().label)
    }

    fn content_size(&self) -> usize {
        let of_curve = |curve: &Curve| 1 + curve.knots().knots().len() + curve.control_points().len();
        let numbers = 4 + self.knots_v().knots().len() + self.curves().iter().map(of_curve).sum::<usize>();
        8 * numbers + region_size(self.region())
    }

    fn write(&self, writer: &mut Writer) {
        writer.count(self.dim());
        writer.count(self.knots_v().knots().len());
        writer.region_sizes(self.region());
        writer.doubles(self.knots_v().knots());
        for curve in self.curves() {
            writer.count(curve.knots().knots().len());
            writer.doubles(curve.knots().knots());
            writer.doubles(curve.control_points());
        }
        writer.region(self.region());
    }
}

pub(super) fn read(reader: &mut Reader) -> Result<TSplineSurface, LoadError> {
    let dim = reader.count()?;
    let knot_count = reader.count()?;
    let has_data_box = reader.flag()?;
    let trim_count = reader.count()?;
    let knots_v = reader.knots(DEGREE, knot_count)?;
    let mut curves = Vec::new();
    for _ in 0..knots_v.basis_count() {
        let count = reader.count()?;
        let knots = reader.knots(DEGREE, count)?;
        let points = reader.doubles(knots.basis_count().saturating_mul(dim))?;
        memory::push(
            &mut curves,
            Curve::new(dim, knots, points).map_err(|error| reader.wrong(error.to_string()))?,
        );
    }
    let mut surface =
        TSplineSurface::new(knots_v, curves).map_err(|error| reader.wrong(error.to_string()))?;
    *surface.region_mut() = reader.region(has_data_box, trim_count, &surface.domain())?;
    Ok(surface)
}
