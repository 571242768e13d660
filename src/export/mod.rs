//! Files for other programs.

mod error;
pub mod obj;
pub mod vtk;

pub use error::ExportError;
