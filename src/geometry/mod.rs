//! Points, boxes and exact predicates.

mod bounds;
mod domain;
mod orientation;

pub use bounds::Bounds;
pub use domain::Domain;
pub use orientation::{CANCELLATION, Orientation, is_in_circle, orientation, signed_area};
