//! Hierarchical T-meshes: a quadtree over each cell of a tensor grid.
//!
//! J. Deng et al., "Polynomial splines over hierarchical T-meshes", Graph. Models 70 (2008), section 2.
//! ```text
//! +-------+---+---+    Cells are split at their parametric middle. The dots are where vertices differ:
//! |       |   |   |    o is a corner of all four leaves that touch it, a basis vertex, and so is every
//! |       T---o---o    vertex of the border; T lies inside an edge of the larger leaf, its host.
//! |       |   |   |
//! +-------o---+---+
//! ```
//! A place in the mesh is a pair of integers in units of 2^-[`MAX_LEVEL`] of an initial cell; parameters are
//! made from it, never compared with it.

mod cell;
mod directory;
mod error;
mod mesh;
mod topology;

pub use cell::{Cell, EDGES, Edge, MAX_GRID, MAX_LEVEL, QUADRANTS, Vertex};
pub use directory::Directory;
pub use error::TMeshError;
pub use mesh::{NodeId, Role, TMesh};
pub use topology::{Hanging, Topology, VertexKind};
