//! Parameters for meshes of disk topology.
