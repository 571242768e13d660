//! Pictures: a small software rasterizer, and what is drawn of a surface with it.

mod raster;
mod scene;

pub use raster::{Picture, View};
pub use scene::{RenderOptions, render, render_model};
