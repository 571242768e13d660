//! The two directions of a parameter plane.

/// A parameter direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Axis {
    /// The first parameter.
    U,
    /// The second parameter.
    V,
}
