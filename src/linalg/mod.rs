//! Banded and sparse systems: sprs holds and multiplies, faer orders, factors and multiplies dense blocks. Small dense ones.

mod cholesky;
mod conditions;
mod dense;
pub mod dissection;
mod elimination;
mod general;
pub mod lu;
mod ordering;
mod small;
mod tridiagonal;

pub use cholesky::{Cholesky, NotPositiveDefinite, SolveMemory, SymbolicCholesky};
pub use conditions::{Condition, Conditions, impose_all};
pub use general::{Entries, Singular};
pub use lu::{LuError, NumericLu, SymbolicLu};
pub(crate) use small::{Symmetric2, principal_axes, shares};
pub use tridiagonal::Tridiagonal;
