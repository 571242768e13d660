//! Surfaces that were fitted, measured at the data.

use crate::fit::common::errors::DataErrors;
use crate::fit::common::uniform::grid::UniformGrid;
use crate::surface::tensor::TensorSurface;

/// A surface on some grid, measured.
pub(super) struct Candidate {
    pub grid: [UniformGrid; 2],
    pub surface: TensorSurface,
    pub errors: DataErrors,
    pub smoothing: f64,
    pub coefficient_count: usize,
}

/// A surface over any knots, measured at the data.
pub(super) struct Fitted {
    pub surface: TensorSurface,
    pub errors: DataErrors,
    pub smoothing: f64,
    pub coefficient_count: usize,
}

impl From<Candidate> for Fitted {
    fn from(candidate: Candidate) -> Self {
        let Candidate { surface, errors, smoothing, coefficient_count, .. } = candidate;
        Self { surface, errors, smoothing, coefficient_count }
    }
}

impl Candidate {
    /// Knots along u and v.
    pub(super) fn counts(&self) -> [usize; 2] {
        self.grid.map(|grid| grid.count)
    }
}
