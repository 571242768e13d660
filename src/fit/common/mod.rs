//! What all methods share: checks of the data, the frame, parameters of nodes, the outer loop, foot points, what lies
//! between the nodes, one measure of error and one report.
//!
//! A method knows this folder and no other method.

pub(in crate::fit) mod checks;
mod demands;
mod error;
pub mod errors;
mod fitted;
pub(in crate::fit) mod foot_points;
mod frame;
pub(in crate::fit) mod hermite_cell;
pub(in crate::fit) mod interior;
pub(in crate::fit) mod neighbours;
pub(in crate::fit) mod outliers;
mod parameters;
pub(in crate::fit) mod partial;
mod plane;
mod remarks;
pub mod report;
pub(in crate::fit) mod rounds;
pub(in crate::fit) mod samples;
#[cfg(test)]
pub(in crate::fit) mod shell;
pub(in crate::fit) mod sides;
pub(in crate::fit) mod signs;
pub(in crate::fit) mod symmetric;
mod symmetry;
pub(in crate::fit) mod tame;
pub mod uniform;
mod unused;

pub use demands::Demands;
pub(in crate::fit) use demands::Standards;
pub use error::FitError;
pub use fitted::Fit;
pub(in crate::fit) use fitted::timed;
pub(in crate::fit) use frame::Frame;
pub use outliers::Outliers;
pub use parameters::Regularize;
pub(in crate::fit) use parameters::{NodeParameters, node_parameters, trims};
pub use partial::Missing;
pub(in crate::fit) use partial::Partial;
pub(in crate::fit) use plane::prefer_plane;
pub use sides::{Neighbour, Sides};
pub(in crate::fit) use symmetry::Half;
pub use symmetry::{Plane, Symmetry};
pub(in crate::fit) use unused::Used;
