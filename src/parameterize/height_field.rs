//! The map of a height field: the coordinates in the plane that it is a height field over.
//!
//! A map of least stretch follows every bump, and the surface over it has to undo that; the plane's own coordinates
//! are as smooth as the shape. Sheets that unroll without stretch need no such help.

use super::isometric::{boundary_crosses, in_unit_square};
use crate::geometry::Orientation;
use crate::mesh::Mesh;
use glam::{DVec2, DVec3};

/// A triangle that is steeper over the plane keeps too little of its area there: 78 degrees.
const LEAST_COSINE: f64 = 0.2;

/// The nodes in the plane across the mean normal, turned and scaled as an unrolled map is; None if the mesh is no
/// height field over it: a triangle is too steep or turned over, or the border covers itself.
pub fn flatten(mesh: &Mesh) -> Option<Vec<DVec2>> {
    let area_vector = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|node| mesh.points()[node as usize]);
        (b - a).cross(c - a)
    };
    let normal = mesh.triangles().iter().map(area_vector).sum::<DVec3>().try_normalize()?;
    let is_steep = |t: &[u32; 3]| {
        let area = area_vector(t);
        !(area.dot(normal) >= LEAST_COSINE * area.length())
    };
    if mesh.triangles().iter().any(is_steep) {
        return None;
    }
    let (e1, e2) = normal.any_orthonormal_pair();
    let flat: Vec<DVec2> = mesh.points().iter().map(|p| DVec2::new(p.dot(e1), p.dot(e2))).collect();
    let uv = in_unit_square(mesh, &flat);
    let is_positive = |t: &[u32; 3]| super::triangle_orientation(&uv, t) == Orientation::Positive;
    (mesh.triangles().iter().all(is_positive) && !boundary_crosses(mesh, &uv)).then_some(uv)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples;

    #[test]
    fn a_terrain_is_flattened_and_a_deep_shape_is_not() {
        let (terrain, _) = samples::bumps([30, 30], 12, 4).unwrap();
        let uv = flatten(&terrain).unwrap();
        // a similarity of the plane: the map keeps the ratio of all lengths seen from above
        let seen: Vec<DVec2> = terrain.points().iter().map(|p| p.truncate()).collect();
        let scale = (uv[1] - uv[0]).length() / (seen[1] - seen[0]).length();
        for (a, b) in [(3, 700), (29, 870), (0, 899)] {
            let ratio = (uv[a] - uv[b]).length() / (seen[a] - seen[b]).length();
            // the mean normal is within a few degrees of the vertical
            assert!((ratio / scale - 1.0).abs() < 0.05, "{ratio} is not {scale}");
        }
        let ball = samples::sphere_with_holes(2000, 1).unwrap();
        assert!(flatten(&ball).is_none());
    }
}
