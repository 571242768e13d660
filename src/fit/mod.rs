//! Fitting: what all methods share, and a folder for each.
//!
//! Each method has its options. Tensor surfaces, PHT-splines and curves have one report and one error, those of [`common`]:
//! they answer the same question about the same data (how near, with how many coefficients, why no nearer) and fail for the
//! same reasons, so that callers compare them field by field, and the C ABI has one `planish_fit_report`. Methods that can
//! say more or fail otherwise have their own, around the common ones: [`skin`], [`d1rc`], [`field`], [`model`].

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
pub mod trim;

pub use common::{errors, report};
