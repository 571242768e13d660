//! The map of a height field: the coordinates in the plane that it is a height field over.
//!
//! A map of least stretch follows every bump, and the surface over it has to undo that; the plane's own coordinates
//! are as smooth as the shape. Sheets that unroll without stretch need no such help.

use super::crossings::boundary_crosses;
use super::isometric::in_unit_square;
use crate::geometry::Orientation;
use crate::memory::CollectVec;
use crate::mesh::Mesh;
use glam::{DVec2, DVec3};

/// A triangle that is steeper over the plane keeps too little of its area there: 84 degrees.
pub(super) const LEAST_COSINE: f64 = 0.1;
/// The same where what a fit costs decides: 89.4 degrees. What is steeper stands upright but for rounding of its places.
const LEAST_COSINE_OF_CANDIDATES: f64 = 0.01;
/// The middle of the cap is found to a few hundredths of its radius, near enough for a choice of a plane.
const STEPS: usize = 64;
/// Cosines that differ by less are the same but for rounding.
const SAME: f64 = 1e-9;

/// The nodes in the plane across the best direction, turned and scaled as an unrolled map is; None if the mesh is no
/// height field over it: a triangle is too steep or turned over, or the border covers itself.
pub(super) fn flatten(mesh: &Mesh, least_cosine: f64) -> Option<Vec<DVec2>> {
    let direction = best_direction(mesh)?;
    let is_steep = |t: &[u32; 3]| {
        let area = area_vector(mesh, t);
        !(area.dot(direction) >= least_cosine * area.length())
    };
    if mesh.triangles().iter().any(is_steep) {
        return None;
    }
    let (e1, e2) = direction.any_orthonormal_pair();
    let flat: Vec<DVec2> = mesh.points().iter().map(|p| DVec2::new(p.dot(e1), p.dot(e2))).collect_vec();
    let uv = in_unit_square(mesh, &flat);
    let is_positive = |t: &[u32; 3]| super::triangle_orientation(&uv, t) == Orientation::Positive;
    (mesh.triangles().iter().all(is_positive) && !boundary_crosses(mesh, &uv)).then_some(uv)
}

/// The coordinates of a mesh in the plane that it is a height field over, however steep, in the unit square; None if it is
/// no height field, or not one piece. Compared to a map of less stretch they are as smooth as the shape.
pub fn plane_coordinates(mesh: &Mesh) -> Option<Vec<DVec2>> {
    super::patch::check_disk(mesh).ok()?;
    let (mesh, _) = mesh.at_safe_scale();
    let mut uv = flatten(&mesh, LEAST_COSINE_OF_CANDIDATES)?;
    super::place_unused_nodes(&mesh, &mut uv);
    Some(uv)
}

/// The direction from which the steepest triangle looks least steep: the middle of the smallest cap around all
/// normals (M. Badoiu and K. Clarkson, "Smaller core-sets for balls", 2003), from the mean normal on.
fn best_direction(mesh: &Mesh) -> Option<DVec3> {
    let normals: Vec<DVec3> =
        mesh.triangles().iter().filter_map(|t| area_vector(mesh, t).try_normalize()).collect_vec();
    let mut middle = mesh.triangles().iter().map(|t| area_vector(mesh, t)).sum::<DVec3>().try_normalize()?;
    for step in 1..=STEPS {
        let least = normals.iter().map(|normal| normal.dot(middle)).fold(f64::INFINITY, f64::min);
        // of a symmetric shape several are equally steep: their mean does not depend on which comes first
        let steepest = normals.iter().filter(|normal| normal.dot(middle) <= least + SAME);
        let (sum, count) = steepest.fold((DVec3::ZERO, 0), |(sum, count), normal| (sum + normal, count + 1));
        middle = (middle + (sum / f64::from(count) - middle) / (step + 1) as f64).try_normalize()?;
    }
    Some(middle)
}

/// Across the triangle, of twice its area.
fn area_vector(mesh: &Mesh, triangle: &[u32; 3]) -> DVec3 {
    let [a, b, c] = triangle.map(|node| mesh.points()[node as usize]);
    (b - a).cross(c - a)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples;

    #[test]
    fn a_terrain_is_flattened_and_a_deep_shape_is_not() {
        let (terrain, _) = samples::bumps([30, 30], 12, 4).unwrap();
        let uv = flatten(&terrain, LEAST_COSINE).unwrap();
        // seen from the best direction instead of from above, lengths change by the cosine of its tilt at most, and
        // heights of up to a fifth add the sine
        let z = best_direction(&terrain).unwrap().z;
        let (cosine, sine) = (z, (1.0 - z * z).sqrt());
        let (least, most) = (cosine - 0.4 * sine, 1.0 + 0.4 * sine);
        let seen: Vec<DVec2> = terrain.points().iter().map(|p| p.truncate()).collect();
        let scale = (uv[899] - uv[0]).length() / (seen[899] - seen[0]).length();
        for (a, b) in [(3, 700), (29, 870), (400, 880)] {
            let ratio = (uv[a] - uv[b]).length() / (seen[a] - seen[b]).length();
            assert!((least / most..=most / least).contains(&(ratio / scale)), "{ratio} is not {scale}");
        }
        let ball = samples::sphere_with_holes(2000, 1).unwrap();
        assert!(flatten(&ball, LEAST_COSINE).is_none());
        assert!(plane_coordinates(&samples::ball(300, 1).unwrap()).is_none());
    }
}
