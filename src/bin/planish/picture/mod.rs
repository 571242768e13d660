//! Pictures: a small software rasterizer, and what is drawn of a surface, model or mesh with it.

mod raster;
mod scene;

pub(crate) use raster::{Picture, View};
pub(crate) use scene::{RenderOptions, render, render_mesh, render_model};
