//! Questions to a surface that take more than an evaluation: tessellation, closest points, deviation.

pub mod deviation;
pub mod gradient;
pub mod project;
pub mod rows;
pub mod tessellate;
pub mod triangles;
