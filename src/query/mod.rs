//! Questions that take more than an evaluation: tessellation, closest points and deviation of surfaces, rows of points on
//! meshes.

pub mod crossings;
pub mod deviation;
pub mod extent;
pub mod gradient;
pub mod project;
pub mod rows;
pub mod side;
pub mod tessellate;
pub mod triangles;
