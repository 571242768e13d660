//! The frame in which values are fitted.

use crate::geometry::Bounds;
use crate::memory::CollectVec;

/// Moves values into a box of size one around the origin, where sums of squares keep their digits.
pub(in crate::fit) struct Frame {
    center: Vec<f64>,
    pub scale: f64,
}

impl Frame {
    pub(crate) fn new(bounds: &Bounds) -> Self {
        let center = bounds.min.iter().zip(&bounds.max).map(|(a, b)| a + (b - a) / 2.0).collect_vec();
        let diagonal = bounds.diagonal();
        Self { center, scale: if diagonal > 0.0 { diagonal } else { 1.0 } }
    }

    pub(crate) fn inward(&self, values: &[f64]) -> Vec<f64> {
        let center = self.center.iter().cycle();
        values.iter().zip(center).map(|(x, c)| (x - c) / self.scale).collect_vec()
    }

    pub(crate) fn outward(&self, values: &mut [f64]) {
        let center = self.center.iter().cycle();
        values.iter_mut().zip(center).for_each(|(x, c)| *x = *x * self.scale + c);
    }
}
