//! Banded and sparse systems: sprs holds and multiplies, faer factors.

mod cholesky;
pub mod dissection;
mod general;

pub use cholesky::{Cholesky, NotPositiveDefinite, SymbolicCholesky};
pub use general::{Entries, Singular};
