//! Bicubic splines on uniform grids: their bases, energies, normal equations, and the equations of the paper.
//!
//! What surfaces, curves and fields on such grids have in common: J. Dannenhoffer and R. Haimes,
//! "Generation of Spline Approximations to Tessellations" (2009), and least squares instead of its equations.

pub(in crate::fit) mod energy;
pub(in crate::fit) mod ferguson;
pub(in crate::fit) mod grid;
pub(in crate::fit) mod normal_equations;

pub use energy::Energy;
pub use grid::Ends;

/// Which equations determine the surface on a grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Method {
    /// Least squares in the spline space itself.
    #[default]
    LeastSquares,
    /// The paper's equations: slopes are held while values are differentiated. Less accurate by orders of
    /// magnitude on fine grids; for comparison.
    Ferguson,
}

/// Smoothing weights tried on each grid, from the calmest to the closest: the first limits the accuracy of
/// fine grids, the last fills holes badly when data are noisy.
pub const SMOOTHING_LADDER: [f64; 4] = [1e-3, 1e-4, 1e-5, 1e-6];

/// Most knots along one direction that may be asked for.
pub(in crate::fit) const LARGEST_GRID: usize = 8193;
