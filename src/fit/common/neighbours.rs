//! Who is whose neighbour among scattered data, where no mesh says so: Delaunay triangles over the unit square.

use crate::geometry::Domain;
use glam::DVec2;
use spade::{DelaunayTriangulation, HasPosition, Point2, Triangulation, mitigate_underflow};

/// A datum and its place.
struct Site {
    place: Point2<f64>,
    datum: u32,
}

impl HasPosition for Site {
    type Scalar = f64;
    fn position(&self) -> Point2<f64> {
        self.place
    }
}

/// The triangles between data in a box; none where all lie on a line. Of data at one place one is taken.
pub fn triangles_between(uv: &[DVec2], data: &Domain) -> Vec<[u32; 3]> {
    let site = |(datum, &uv): (usize, &DVec2)| {
        let place = (uv - data.min) / data.size();
        Site { place: mitigate_underflow(Point2::new(place.x, place.y)), datum: datum as u32 }
    };
    let sites = uv.iter().enumerate().map(site).collect();
    // finite places are all that can be refused
    let Ok(triangles) = DelaunayTriangulation::<Site>::bulk_load(sites) else { return Vec::new() };
    triangles.inner_faces().map(|face| face.vertices().map(|vertex| vertex.data().datum)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangles_cover_the_box_and_name_the_data() {
        let uv: Vec<DVec2> = (0..25).map(|k| DVec2::new(f64::from(k % 5), 1e-3 * f64::from(k / 5))).collect();
        // copies of a place count once
        let uv = [uv.clone(), uv].concat();
        let triangles = triangles_between(&uv, &Domain::around(uv.iter().copied()));
        assert_eq!(triangles.len(), 32);
        let area: f64 = triangles
            .iter()
            .map(|t| {
                let [a, b, c] = t.map(|n| uv[n as usize]);
                (b - a).perp_dot(c - a) / 2.0
            })
            .sum();
        assert!((area - 16e-3).abs() < 1e-15, "{area}");
    }
}
