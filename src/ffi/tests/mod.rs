use crate::surface::{Domain, Kind, Region, Surface};
use glam::DVec2;

/// A surface that is no tensor.
#[derive(Clone, Default)]
pub(super) struct OtherFamily(Region);

impl Surface for OtherFamily {
    fn kind(&self) -> Kind {
        Kind::Pht
    }

    fn dim(&self) -> usize {
        3
    }

    fn domain(&self) -> Domain {
        Domain { min: DVec2::ZERO, max: DVec2::ONE }
    }

    fn coefficient_count(&self) -> usize {
        1
    }

    fn region(&self) -> &Region {
        &self.0
    }

    fn region_mut(&mut self) -> &mut Region {
        &mut self.0
    }

    fn eval_rows(&self, _: &[DVec2], _: usize, out: &mut [f64]) {
        out.fill(0.0);
    }
}
