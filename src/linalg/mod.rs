//! Banded and sparse systems: sprs holds and multiplies, faer orders and multiplies dense blocks.

mod dense;
mod elimination;
pub mod lu;
mod ordering;

pub use lu::{LuError, NumericLu, SymbolicLu};
