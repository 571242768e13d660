//! Fitting: one measure of error for all methods, and a folder for each.

pub mod d1rc;
pub mod errors;
pub mod field;
pub mod pht;
pub mod report;
pub mod skin;
pub mod tessellation;
