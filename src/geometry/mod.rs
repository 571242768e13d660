//! Points, boxes and exact predicates.

mod bounds;
mod orientation;

pub use bounds::Bounds;
pub use orientation::{Orientation, orientation};
