//! Fitting: what all methods share, and a folder for each.

pub mod common;
pub mod conversion;
pub mod curve;
pub mod d1rc;
pub mod fair;
pub mod field;
pub mod found_grid;
pub mod model;
pub mod pht;
pub mod skin;
pub mod tensor;

pub use common::{errors, report};
