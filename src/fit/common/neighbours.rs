//! Who is whose neighbour among scattered data, where no mesh says so: Delaunay triangles over the unit square.

use crate::control::Watch;
use crate::geometry::Domain;
use crate::memory::CollectVec;
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

/// As many places are triangulated in one piece of work: in some 30 milliseconds.
const BULK: usize = 32_768;
/// Places inserted between looks at whether the call is to end.
const CHUNK: usize = 2048;

/// The triangles between data in a box; none where all lie on a line, or the call is cancelled. Of data at one place one
/// is taken.
pub(crate) fn triangles_between(uv: &[DVec2], data: &Domain, watch: &Watch) -> Vec<[u32; 3]> {
    let site = |datum: u32| {
        let place = (uv[datum as usize] - data.min) / data.size();
        Site { place: mitigate_underflow(Point2::new(place.x, place.y)), datum }
    };
    let triangles = match uv.len() {
        ..=BULK => {
            DelaunayTriangulation::<Site>::bulk_load((0..uv.len() as u32).map(site).collect_vec()).ok()
        }
        _ => one_by_one(&z_order(uv), site, watch),
    };
    // finite places are all that can be refused
    let Some(triangles) = triangles else { return Vec::new() };
    triangles.inner_faces().map(|face| face.vertices().map(|vertex| vertex.data().datum)).collect_vec()
}

/// In an order in which each place is near the one before it.
fn one_by_one(
    order: &[u32],
    site: impl Fn(u32) -> Site,
    watch: &Watch,
) -> Option<DelaunayTriangulation<Site>> {
    let mut triangles = DelaunayTriangulation::<Site>::new();
    for chunk in order.chunks(CHUNK) {
        watch.check().ok()?;
        for &datum in chunk {
            triangles.insert(site(datum)).ok()?;
        }
    }
    Some(triangles)
}

/// Numbers of places along a Z curve (G. Morton, "A computer oriented geodetic data base", 1966) of 2^16 cells a
/// side; equal cells in the order given.
pub(crate) fn z_order(uv: &[DVec2]) -> Vec<u32> {
    let domain = Domain::around(uv.iter().copied());
    let spread = |x: f64| {
        let mut bits = u64::from((x * 65535.0) as u32);
        bits = (bits | bits << 8) & 0x00ff_00ff;
        bits = (bits | bits << 4) & 0x0f0f_0f0f;
        bits = (bits | bits << 2) & 0x3333_3333;
        (bits | bits << 1) & 0x5555_5555
    };
    let code = |uv: DVec2| {
        let at = (uv - domain.min) / domain.size();
        spread(at.x) << 1 | spread(at.y)
    };
    let mut order: Vec<(u64, u32)> = uv.iter().zip(0..).map(|(&uv, k)| (code(uv), k)).collect_vec();
    order.sort_unstable();
    order.into_iter().map(|(_, k)| k).collect_vec()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::Random;

    #[test]
    fn triangles_cover_the_box_and_name_the_data() {
        let uv: Vec<DVec2> = (0..25).map(|k| DVec2::new(f64::from(k % 5), 1e-3 * f64::from(k / 5))).collect();
        // copies of a place count once
        let uv = [uv.clone(), uv].concat();
        let triangles = triangles_between(&uv, &Domain::around(uv.iter().copied()), &Watch::default());
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

    #[test]
    fn many_places_are_triangulated_as_few_are() {
        let mut random = Random::new(7);
        let uv: Vec<DVec2> = (0..BULK + 1000).map(|_| DVec2::new(random.unit(), random.unit())).collect();
        let data = Domain { min: DVec2::ZERO, max: DVec2::ONE };
        let sorted = |mut triangles: Vec<[u32; 3]>| {
            triangles.iter_mut().for_each(|nodes| nodes.sort_unstable());
            triangles.sort_unstable();
            triangles
        };
        let bulk: Vec<Site> = (0..uv.len() as u32)
            .map(|datum| {
                let uv = uv[datum as usize];
                Site { place: Point2::new(uv.x, uv.y), datum }
            })
            .collect();
        let bulk = DelaunayTriangulation::<Site>::bulk_load(bulk).unwrap();
        let bulk = bulk.inner_faces().map(|face| face.vertices().map(|vertex| vertex.data().datum));
        assert_eq!(sorted(triangles_between(&uv, &data, &Watch::default())), sorted(bulk.collect()));
    }
}
