//! On which side of a surface points lie.

use crate::control::Pool;
use crate::surface::{Surface, normal};
use glam::{DVec2, DVec3};

/// Distances with the sign of their side: positive where a point lies on the side of the normal at the place nearest
/// to it. Where the surface has no normal the sign is positive.
///
/// Beyond a border the nearest place is on the border, and the sign that of its tangent plane.
pub fn signed(
    surface: &dyn Surface,
    points: &[DVec3],
    nearest: &[DVec2],
    distances: &[f64],
    pool: &Pool,
) -> Vec<f64> {
    // a node without triangles has no place: its distance is NaN whatever the sign
    let some_place = surface.domain().min;
    let places: Vec<DVec2> = nearest.iter().map(|&uv| if uv.is_nan() { some_place } else { uv }).collect();
    let mut rows = vec![0.0; 9 * places.len()];
    pool.run(|| surface.eval_rows(&places, 1, &mut rows));
    let sides = points.iter().zip(rows.chunks_exact(9)).map(|(&point, row)| side(point, row));
    sides.zip(distances).map(|(side, &distance)| if side < 0.0 { -distance } else { distance }).collect()
}

/// How far a point lies along the normal of a place, whose row of nine numbers is the place and its two tangents.
pub fn side(point: DVec3, row: &[f64]) -> f64 {
    let [place, su, sv] = [0, 3, 6].map(|at| DVec3::from_slice(&row[at..]));
    (point - place).dot(normal(su, sv))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::query::deviation::{DeviationOptions, deviation};
    use crate::samples;
    use crate::surface::tensor::TensorSurface;

    #[test]
    fn heights_above_a_plane_come_back_with_their_sign() {
        let knots = || crate::knots::KnotVector::clamped(&[0.0, 1.0], 1).unwrap();
        let corners = vec![0., 0., 0., 0., 1., 0., 1., 0., 0., 1., 1., 0.];
        let square = TensorSurface::new(3, knots(), knots(), corners, None).unwrap();
        let (places, triangles) = samples::grid([9, 9], 0.0, 1, |_| true);
        let height = |p: DVec2| 0.1 * (p.x - 0.5);
        let points = places.iter().map(|&p| p.extend(height(p))).collect();
        let mesh = crate::mesh::Mesh::new(points, triangles).unwrap();
        let pool = Pool::new(1);
        let report = deviation(&square, &mesh, &DeviationOptions::default(), &pool).unwrap();
        let found = signed(&square, mesh.points(), &report.uv, &report.nodes.each, &pool);
        for (point, distance) in mesh.points().iter().zip(&found) {
            assert!((distance - point.z).abs() <= 1e-12, "{distance} at {point}");
        }
    }
}
