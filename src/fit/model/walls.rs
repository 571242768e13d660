//! Walls that are thinner than the tolerance allows: what their two sides have to keep for the model not to cross itself.
//!
//! ```text
//! ------------*------------   each side may move by a share of the distance d to the facet opposite,
//!             | d             where that is less than the tolerance
//! ---------------------------
//! ```
//! Opposite is a facet that faces the other way but for some degrees: where two facets meet at an edge there is no wall. Nor
//! is there where it is reached over the mesh without leaving the surroundings, as slivers that are turned over are.

use super::samples::{Samples, facet_normals};
use crate::control::Pool;
use crate::memory::{self, CollectVec, ParallelCollectVec};
use crate::mesh::{HalfEdge, Mesh};
use crate::query::crossings::crossings;
use crate::query::triangles::{TriangleTree, nearest_on_triangle};
use glam::DVec3;
use rayon::prelude::*;
use std::cmp::Reverse;
use std::collections::{BTreeSet, BinaryHeap};
use std::ops::Range;

/// Each side of a wall may be off by this share of its thickness: less than half, for what lies between the samples.
const SHARE: f64 = 0.4;
/// The tolerance is divided by so much at most; what is thinner still is told by its crossings.
const STRICTEST: f64 = 8.0;
/// The cosine between the normals of two sides, at most: they are parallel to 14 degrees, or meet farther off than four times
/// their distance.
const OPPOSITE: f64 = -0.97;
/// The surroundings of a place, as a multiple of the distance to what lies opposite.
const SURROUNDINGS: f64 = 1.5;

/// What the tolerance is to be divided by at each sample: 1 away from thin walls, and in meshes that cross themselves.
pub(super) fn strictness(mesh: &Mesh, samples: &Samples, tolerance: f64, pool: &Pool) -> Vec<f64> {
    let tree = TriangleTree::watched(mesh, pool.watch());
    let walls = Walls::new(&tree, tolerance / SHARE);
    let at = |sample: usize| {
        let (point, normal) = (samples.points[sample], samples.normals[sample]);
        // a cancelled call throws its fit away
        let thickness = pool.check().ok().and_then(|()| walls.thickness(point, normal));
        thickness.map_or(1.0, |d| (tolerance / (SHARE * d)).clamp(1.0, STRICTEST))
    };
    let of = |range: Range<usize>| pool.run(|| range.into_par_iter().with_min_len(256).map(at).collect_vec());
    let (nodes, all) = (samples.nodes.len(), samples.points.len());
    let mut strictness = of(0..nodes);
    let has_walls = strictness.iter().any(|&factor| factor > 1.0);
    // what crosses itself, as noise makes thin plates do, has no sides to keep apart
    if !has_walls || crossings(mesh, pool).is_ok_and(|found| found.count > 0) {
        return memory::filled(1.0, all);
    }
    memory::extend(&mut strictness, of(nodes..all));
    strictness
}

/// The normals of some facets: all within an angle of one direction.
struct Cone {
    axis: DVec3,
    angle: f64,
}

impl Cone {
    fn of(normals: impl Iterator<Item = DVec3> + Clone) -> Self {
        let axis = normals.clone().sum::<DVec3>().normalize_or(DVec3::Z);
        let angle = |normal: DVec3| axis.dot(normal).clamp(-1.0, 1.0).acos();
        Self { axis, angle: normals.map(angle).fold(0.0, f64::max) }
    }

    /// Whether some direction within it may be opposite to a normal.
    fn may_be_opposite(&self, normal: DVec3) -> bool {
        self.axis.dot(normal).clamp(-1.0, 1.0).acos() + self.angle + ROUNDING > OPPOSITE.acos()
    }
}

/// What cosines lose of an angle: at most the root of twice the rounding of a number near one.
const ROUNDING: f64 = 1e-7;

struct Walls<'a> {
    tree: &'a TriangleTree<&'a Mesh>,
    /// By facet.
    normals: Vec<DVec3>,
    /// By branch of the tree.
    cones: Vec<Cone>,
    /// Facets farther off do not matter.
    farthest: f64,
}

impl<'a> Walls<'a> {
    fn new(tree: &'a TriangleTree<&'a Mesh>, farthest: f64) -> Self {
        let normals = facet_normals(tree.mesh());
        let cone = |triangles: &[u32]| Cone::of(triangles.iter().map(|&triangle| normals[triangle as usize]));
        let cones = tree.branches().map(cone).collect_vec();
        Self { tree, normals, cones, farthest }
    }

    /// The distance from a place of the mesh to the nearest facet opposite; none if none is near.
    fn thickness(&self, point: DVec3, normal: DVec3) -> Option<f64> {
        let mut opposite: Vec<(f64, u32)> = Vec::new();
        let reach = DVec3::splat(self.farthest);
        let may_hold_one = |branch: usize| self.cones[branch].may_be_opposite(normal);
        self.tree.for_each_in_box_of(may_hold_one, point - reach, point + reach, |triangle| {
            if self.normals[triangle as usize].dot(normal) < OPPOSITE {
                let corners = self.tree.corners(triangle);
                let distance = nearest_on_triangle(point, corners).distance(point);
                if distance < self.farthest {
                    opposite.push((distance, triangle));
                }
            }
        });
        opposite.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut reach: Option<Reach> = None;
        for (distance, triangle) in opposite {
            let reach = match &mut reach {
                Some(reach) => reach,
                none => none.insert(Reach::new(self.tree, point)?),
            };
            if !reach.within(SURROUNDINGS * distance).contains(&triangle) {
                return Some(distance);
            }
        }
        None
    }
}

/// The facets that are reached over a mesh from a place of it without leaving a ball around it, as the ball grows.
struct Reach<'a> {
    tree: &'a TriangleTree<&'a Mesh>,
    point: DVec3,
    reached: BTreeSet<u32>,
    /// Facets beside those, with the bits of their distances: these are not negative, so bits are in their order.
    next: BinaryHeap<Reverse<(u64, u32)>>,
}

impl<'a> Reach<'a> {
    fn new(tree: &'a TriangleTree<&'a Mesh>, point: DVec3) -> Option<Self> {
        let first = tree.nearest(point)?.triangle;
        let next = BinaryHeap::from([Reverse((0, first))]);
        Some(Self { tree, point, reached: BTreeSet::new(), next })
    }

    /// Those within a radius, which is no less than in the calls before.
    fn within(&mut self, radius: f64) -> &BTreeSet<u32> {
        let topology = self.tree.mesh().topology();
        while let Some(&Reverse((distance, triangle))) = self.next.peek()
            && distance <= radius.to_bits()
        {
            self.next.pop();
            if !self.reached.insert(triangle) {
                continue;
            }
            let sides = (0..3).map(|corner| HalfEdge::new(triangle as usize, corner));
            for other in sides.filter_map(|side| topology.twin(side)) {
                let other = other.triangle() as u32;
                if !self.reached.contains(&other) {
                    let distance =
                        nearest_on_triangle(self.point, self.tree.corners(other)).distance(self.point);
                    self.next.push(Reverse((distance.to_bits(), other)));
                }
            }
        }
        &self.reached
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Control;
    use crate::fit::common::report::{Remarks, Tolerance};
    use crate::fit::model::{ModelOptions, NodePlaces, fit_over_layout};
    use crate::layout::Layout;
    use crate::parameterize::sphere::{SphereOptions, map_to_sphere};

    /// A wedge of two strips along the y-axis that meet at an angle, or with their edges apart by some distance.
    fn strips(angle: f64, apart: f64) -> Mesh {
        let rows = 40;
        let mut points = Vec::new();
        for side in [0.0, 1.0] {
            for k in 0..=rows {
                let x = f64::from(k) / f64::from(rows);
                for y in [-1.0, 0.0, 1.0] {
                    points.push(DVec3::new(x, y, side * (x * angle.tan() + apart)));
                }
            }
        }
        let count = 3 * (rows as u32 + 1);
        let mut triangles = Vec::new();
        for k in 0..rows as u32 {
            for j in 0..2 {
                let a = 3 * k + j;
                triangles.extend([[a, a + 1, a + 3], [a + 1, a + 4, a + 3]]);
                let [a, b, c, d] = [a, a + 1, a + 3, a + 4].map(|node| node + count);
                triangles.extend([[a, c, b], [b, c, d]]);
            }
        }
        if apart > 0.0 {
            return Mesh::new(points, triangles).unwrap();
        }
        // one edge for both
        let first = |node: u32| if (count..count + 3).contains(&node) { node - count } else { node };
        Mesh::new(points, triangles.into_iter().map(|t| t.map(first)).collect()).unwrap()
    }

    fn thickness(mesh: &Mesh, x: f64, farthest: f64) -> Option<f64> {
        let tree = TriangleTree::new(mesh);
        // the lower strip is wound to face down
        Walls::new(&tree, farthest).thickness(DVec3::new(x, 0.1, 0.0), DVec3::NEG_Z)
    }

    #[test]
    fn each_side_of_a_thin_sheet_keeps_its_share() {
        // at most 0.02 thick, while the tolerance is 0.028
        let ball = crate::samples::ball(4000, 1).unwrap();
        let wavy = |p: &DVec3| {
            let wave = (1.0 - p.x * p.x - p.y * p.y) * (6.0 * p.x).sin() * (5.0 * p.y).cos();
            DVec3::new(p.x, p.y, 0.01 * p.z + 0.05 * wave)
        };
        let mesh = Mesh::new(ball.points().iter().map(wavy).collect(), ball.triangles().to_vec()).unwrap();
        let mut control = Control::new(2);
        assert_eq!(crossings(&mesh, control.pool()).unwrap().count, 0);
        let sphere = map_to_sphere(&mesh, &SphereOptions::default(), &mut control).unwrap();
        let (layout, places) = (Layout::cube(), NodePlaces::Sphere(&sphere.points));
        let tolerance = Tolerance { value: 1e-2, ..Tolerance::default() };
        let options = ModelOptions { tolerance, ..ModelOptions::default() };
        let fit = fit_over_layout(&mesh, &layout, places, &options, &mut control).unwrap();
        assert!(!fit.report.remarks.has(Remarks::TOLERANCE_NOT_MET));
        let flat = vec![0.0; mesh.triangles().len()];
        let samples = Samples::new(&mesh, places, &layout, &flat, &[false; 8]);
        let tolerance = fit.report.tolerance;
        let strictness = strictness(&mesh, &samples, tolerance, control.pool());
        assert!(strictness.iter().filter(|&&factor| factor > 2.0).count() > 1000);
        for (&node, factor) in samples.nodes.iter().zip(&strictness) {
            let error = fit.errors[node as usize];
            assert!(error * factor <= tolerance, "node {node}: {error} of {tolerance} / {factor}");
        }
    }

    #[test]
    fn two_sheets_are_a_wall_as_thick_as_they_are_apart() {
        let mesh = strips(0.0, 0.01);
        let found = thickness(&mesh, 0.5, 0.05).unwrap();
        assert!((found - 0.01).abs() < 1e-15, "{found}");
        assert_eq!(thickness(&mesh, 0.5, 0.009), None);
    }

    #[test]
    fn a_wedge_is_no_wall_beside_its_edge() {
        let mesh = strips(0.3, 0.0);
        for x in [0.0, 0.01, 0.1] {
            assert_eq!(thickness(&mesh, x, 0.05), None, "at {x}");
        }
    }
}
