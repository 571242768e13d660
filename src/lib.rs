//! Smooth spline surfaces from triangle meshes, rows of points and fields on nodes.
//!
//! The tree is the architecture; arrows run downwards only, a module knows what stands above it:
//!
//! * [`error`], [`control`]: what can go wrong; threads, progress and cancelling.
//! * [`geometry`]: boxes, exact predicates.
//! * [`linalg`]: banded and sparse systems.
//! * [`mesh`]: triangle meshes, their topology and files.
//! * [`parameterize`]: where a mesh gets its (u,v) from.
//! * [`ffi`]: the C ABI, documented in `include/planish.h`.

#![deny(unsafe_code)]

pub mod basis;
pub mod control;
pub mod curve;
pub mod error;
pub mod export;
#[allow(unsafe_code, reason = "the border to C; nothing else may be unsafe")]
pub mod ffi;
pub mod fit;
pub mod geometry;
pub mod hermite;
pub mod knots;
pub mod linalg;
pub mod mesh;
pub mod parameterize;
pub mod query;
pub mod samples;
pub mod surface;

pub use control::Control;
pub use error::{Error, ErrorKind};
