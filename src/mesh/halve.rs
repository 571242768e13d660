//! Meshes with finer triangles of the same shape.
//!
//! ```text
//!        c                 c
//!       / \               / \
//!      /   \     ->      q---p      a middle is one node for both triangles at its edge
//!     /     \           / \ / \
//!    a-------b         a---r---b
//! ```

use super::{Mesh, MeshError};
use std::collections::HashMap;

/// The node in the middle of each edge that was halved, by its two ends.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Middles(HashMap<[u32; 2], u32>);

impl Middles {
    /// The node in the middle of an edge; none for an edge that was not halved.
    pub(crate) fn between(&self, a: u32, b: u32) -> Option<u32> {
        self.0.get(&[a.min(b), a.max(b)]).copied()
    }
}

impl Mesh {
    /// The mesh with all edges halved so many times; its own nodes keep their numbers. Parameters and fields are left out.
    pub(crate) fn halved(&self, times: u32) -> Result<(Self, Middles), MeshError> {
        let mut middles = HashMap::new();
        let (mut points, mut triangles) = (self.points().to_vec(), self.triangles().to_vec());
        for _ in 0..times {
            let mut middle = |a: u32, b: u32| {
                *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                    points.push(points[a as usize].midpoint(points[b as usize]));
                    points.len() as u32 - 1
                })
            };
            triangles = triangles
                .iter()
                .flat_map(|&[a, b, c]| {
                    let [p, q, r] = [middle(b, c), middle(c, a), middle(a, b)];
                    [[a, r, q], [r, b, p], [q, p, c], [p, q, r]]
                })
                .collect();
        }
        Ok((Self::new(points, triangles)?, Middles(middles)))
    }
}

#[cfg(test)]
mod tests {
    use crate::samples::ball;

    #[test]
    fn halved_meshes_have_the_same_shape() {
        let mesh = ball(100, 1).unwrap();
        let (fine, middles) = mesh.halved(2).unwrap();
        assert_eq!(fine.triangles().len(), 16 * mesh.triangles().len());
        assert_eq!((fine.genus(), fine.loops().len(), fine.component_count()), (0, 0, 1));
        assert_eq!(fine.points()[..mesh.points().len()], *mesh.points());
        for edge in mesh.edges() {
            let [a, b] = [edge.origin(mesh.triangles()), edge.target(mesh.triangles())];
            let half = middles.between(b, a).unwrap();
            let quarter = middles.between(a, half).unwrap();
            let [a, b, quarter] = [a, b, quarter].map(|node| fine.points()[node as usize]);
            // two midpoints, each rounded once
            assert!(quarter.distance(a.lerp(b, 0.25)) <= 4.0 * f64::EPSILON * a.length().max(b.length()));
        }
    }
}
