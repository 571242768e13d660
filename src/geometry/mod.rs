//! Points, boxes and exact predicates.

mod axis;
mod bounds;
mod crossings;
mod domain;
mod orientation;
mod scale;

pub use axis::Axis;
pub use bounds::Bounds;
pub use crossings::visit_meetings;
pub use domain::Domain;
pub use orientation::{
    CANCELLATION, Orientation, is_in_circle, orientation, orientation_of_cone, signed_area,
};
pub use scale::safe_scale;
