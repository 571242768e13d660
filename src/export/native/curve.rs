//! A curve.
//!
//! ```text
//! offset  type          content
//! 24      u64           dim
//! 32      u64           degree
//! 40      u64           knot count K
//! 48      f64           K knots, K - degree - 1 control points of dim numbers
//! ```

use super::bytes::{Reader, Writer};
use super::{CURVE, LoadError, Save};
use crate::curve::Curve;

impl Save for Curve {
    fn file_kind(&self) -> u32 {
        CURVE
    }

    fn content_size(&self) -> usize {
        8 * (3 + self.knots().knots().len() + self.control_points().len())
    }

    fn write(&self, writer: &mut Writer) {
        writer.count(self.dim());
        writer.count(self.knots().degree());
        writer.count(self.knots().knots().len());
        writer.doubles(self.knots().knots());
        writer.doubles(self.control_points());
    }
}

pub(super) fn read(reader: &mut Reader) -> Result<Curve, LoadError> {
    let [dim, degree, knot_count] = [reader.count()?, reader.count()?, reader.count()?];
    let knots = reader.knots(degree, knot_count)?;
    let control_points = reader.doubles(knots.basis_count().saturating_mul(dim))?;
    Curve::new(dim, knots, control_points).map_err(|error| reader.wrong(error.to_string()))
}
