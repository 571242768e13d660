//! Smooth spline surfaces from triangle meshes, rows of points and fields on nodes, within a stated tolerance
//! and with a report of the error that can be trusted.
//!
//! ```
//! use planish::fit::tensor::{TensorOptions, fit_mesh};
//! use planish::surface::Surface;
//! use planish::{Control, samples};
//!
//! let mesh = samples::fuselage_panel(1)?; // a panel with windows, without parameters
//! let fit = fit_mesh(&mesh, &TensorOptions::default(), &mut Control::default())?;
//! assert!(fit.report.max_error <= 1e-3 * fit.report.diagonal);
//! assert_eq!(fit.surface.region().trims.loops().len(), 4);
//!
//! let mut point = [0.0; 3];
//! fit.surface.eval_rows(&fit.parameters[..1], 0, &mut point);
//! # Ok::<(), planish::Error>(())
//! ```
//!
//! The tree is the architecture; arrows run downwards only, a module knows what stands above it:
//!
//! * [`failure`], [`control`]: what a failure is; threads, progress and cancelling.
//! * [`file`](mod@file), [`memory`]: files read and written as a whole, and how much of them there is room for.
//! * [`geometry`]: boxes, exact predicates.
//! * [`knots`], [`basis`], [`refinement`], [`bezier`], [`hermite`]: one-dimensional building blocks, and patches
//!   made of them.
//! * [`lists`]: many short lists in two arrays.
//! * [`linalg`]: banded and sparse systems.
//! * [`mesh`]: triangle meshes, their topology and files.
//! * [`parameterize`]: where a mesh gets its (u,v) from.
//! * [`layout`]: quadrilateral patches over surfaces of any genus, and how they meet.
//! * [`curve`]: B-spline curves.
//! * [`tmesh`]: hierarchical T-meshes, their cells and vertices.
//! * [`surface`]: what every surface can do, and the families.
//! * [`query`]: tessellation, closest points, deviation; fits measure themselves with it.
//! * [`model`]: faces that share edges and vertices.
//! * [`fit`]: one measure of error for all, and the methods.
//! * [`export`]: files for other programs, the library's own format.
//! * [`error`]: the errors of all modules as one.
//! * [`samples`]: seeded shapes for demonstrations, tests and benchmarks.
//! * [`ffi`]: the C ABI, documented in `include/planish.h`.

#![deny(unsafe_code)]

pub mod basis;
pub mod bezier;
pub mod control;
pub mod curve;
pub mod error;
pub mod export;
pub mod failure;
pub mod ffi;
pub mod file;
pub mod fit;
pub mod geometry;
pub mod hermite;
pub mod knots;
pub mod layout;
pub mod linalg;
pub mod lists;
pub mod memory;
pub mod mesh;
pub mod model;
mod options;
pub mod parameterize;
pub mod query;
pub mod refinement;
pub mod samples;
pub mod summary;
pub mod surface;
pub mod tmesh;

pub use control::Control;
pub use error::Error;
pub use failure::{Classify, ErrorKind};
