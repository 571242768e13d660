//! Banded and sparse systems: sprs holds and multiplies, faer factors.

mod cholesky;
pub mod dissection;

pub use cholesky::{Cholesky, NotPositiveDefinite, SymbolicCholesky};
