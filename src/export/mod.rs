//! Files for other programs.

mod error;
pub mod gltf;
pub mod html;
pub mod mesh;
pub mod native;
pub mod step;
pub mod vtk;

pub use error::ExportError;
