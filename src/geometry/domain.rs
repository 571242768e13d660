//! Rectangles in the parameter plane.

use glam::DVec2;

/// A rectangle of parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Domain {
    /// Least u and v.
    pub min: DVec2,
    /// Largest u and v.
    pub max: DVec2,
}

impl Domain {
    /// The smallest rectangle around `points`.
    pub fn around(points: impl IntoIterator<Item = DVec2>) -> Self {
        let empty = Self { min: DVec2::INFINITY, max: DVec2::NEG_INFINITY };
        points.into_iter().fold(empty, |domain, p| Self { min: domain.min.min(p), max: domain.max.max(p) })
    }

    /// Whether a parameter pair lies inside or on the border; false for NaN.
    pub fn contains(&self, uv: DVec2) -> bool {
        uv.cmpge(self.min).all() && uv.cmple(self.max).all()
    }

    /// Width and height.
    pub fn size(&self) -> DVec2 {
        self.max - self.min
    }

    /// The nearest parameter pair inside.
    pub fn clamp(&self, uv: DVec2) -> DVec2 {
        uv.max(self.min).min(self.max)
    }
}
