//! The C ABI: `include/planish.h` is generated from these files.
//!
//! The only place with `unsafe`, and one without mathematics: every function borrows its arguments, calls
//! the core and stores the results. [`guard`](self) keeps panics in, one file for each C type holds its
//! functions in the order of the header. The documentation of a function is its safety contract: what each
//! argument must be is said there once, for readers of the header.

#![allow(unsafe_code, reason = "the border to C; nothing else may be unsafe")]
#![allow(non_camel_case_types, reason = "these are the names of the header")]
#![allow(
    clippy::missing_safety_doc,
    reason = "each function's documentation of its arguments is that section"
)]
#![allow(
    rustdoc::broken_intra_doc_links,
    reason = "the shapes of arrays are told in brackets, for the header"
)]
#![allow(clippy::too_many_arguments, reason = "C passes an array as two arguments")]

#[macro_use]
mod arguments;
#[macro_use]
mod demands;
#[macro_use]
mod progress;
mod choices;
mod curve;
mod curve_query;
mod d1rc;
mod d1rc_fit;
mod decimate;
mod export;
mod extent;
mod failure;
mod fair;
mod features;
mod field;
mod from_patches;
mod guard;
mod label;
mod layout;
mod mesh;
mod mesh_cut;
mod mesh_fields;
mod mesh_file;
mod mesh_parts;
mod mesh_query;
mod model;
mod model_file;
mod model_fit;
mod model_measure;
mod model_parts;
mod model_query;
mod parameterize;
mod patch;
mod pht;
mod pht_edit;
mod pht_parts;
mod query;
mod report;
mod report_page;
mod rows;
mod sphere;
mod status;
mod step;
mod surface;
mod surface_eval;
mod tensor;
mod tensor_parts;
#[cfg(test)]
mod tests;
mod transfer;
mod trims;
mod tspline;

pub use choices::*;
pub use curve::*;
pub use curve_query::*;
pub use d1rc::*;
pub use d1rc_fit::*;
pub use decimate::*;
pub use demands::planish_symmetry;
pub use export::*;
pub use extent::*;
pub use fair::*;
pub use features::*;
pub use field::*;
pub use from_patches::*;
pub use label::*;
pub use layout::*;
pub use mesh::*;
pub use mesh_cut::*;
pub use mesh_fields::*;
pub use mesh_file::*;
pub use mesh_parts::*;
pub use mesh_query::*;
pub use model::*;
pub use model_file::*;
pub use model_fit::*;
pub use model_measure::*;
pub use model_parts::*;
pub use model_query::*;
pub use parameterize::*;
pub use patch::*;
pub use pht::*;
pub use pht_edit::*;
pub use pht_parts::*;
pub use progress::*;
pub use query::*;
pub use report::*;
pub use report_page::*;
pub use rows::*;
pub use sphere::*;
pub use status::*;
pub use step::*;
pub use surface::*;
pub use surface_eval::*;
pub use tensor::*;
pub use tensor_parts::*;
pub use transfer::*;
pub use trims::*;
pub use tspline::*;
