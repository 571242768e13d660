//! How large a surface is: its box, its area, and whether it closes upon itself.
//!
//! * The box is found by branch and bound: the Bernstein ordinates of a patch bound each component, its corners are
//!   reached, and a patch that may hold more than what was reached is divided.
//! * The area is the integral of |Su x Sv| over the triangles of a tessellation in the parameter plane, where trims are
//!   straight, by J. Radon's formula of seven points (Monatsh. Math. Phys. 52 (1948), 286-300), exact to degree 5. How
//!   finely the surface was divided matters little: no chord takes the place of an arc.
//! * Polynomials of degree p over one interval are equal if they are at p + 1 places: two sides of a domain are one curve
//!   if they agree so on each piece of both.

use crate::bezier::BezierPatch;
use crate::control::Pool;
use crate::geometry::{Bounds, Domain};
use crate::memory::{self, CollectVec, ParallelCollectVec};
use crate::query::tessellate::{TessellateError, TessellateOptions, tessellate_watched};
use crate::surface::{Patches, Surface};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// Against the size of a surface: what may lie outside the box, and how far sides that are one curve may be apart. Far
/// above roundoff of coordinates, far below any tolerance of a model.
const TOLERANCE: f64 = 1e-12;

/// The box of a surface over its whole domain. Of a surface without patches it is that of the corners of its facets and
/// of those of a division of them.
pub fn bounding_box(surface: &dyn Surface) -> Bounds {
    match (surface.patches(), surface.facets()) {
        (Some(patches), _) => patch_box(patches, surface.dim()),
        (None, Some(facets)) => {
            let places = facets.places();
            let middle =
                |[a, b, c]: [u32; 3]| (places[a as usize] + places[b as usize] + places[c as usize]) / 3.0;
            let half = |a: u32, b: u32| 0.5 * (places[a as usize] + places[b as usize]);
            let triangles = facets.triangles();
            let inner = triangles
                .iter()
                .flat_map(|&[a, b, c]| [half(a, b), half(b, c), half(c, a), middle([a, b, c])]);
            let uv: Vec<DVec2> = places.iter().copied().chain(inner).collect_vec();
            let mut rows = memory::filled(0.0, surface.dim() * uv.len());
            surface.eval_rows(&uv, 0, &mut rows);
            Bounds::of_rows(&rows, surface.dim())
        }
        (None, None) => Bounds::of_rows(&[], surface.dim()),
    }
}

fn patch_box(patches: &dyn Patches, dim: usize) -> Bounds {
    let all = || (0..patches.patch_count()).map(|index| patches.patch(index));
    let corners: Vec<f64> = all().flat_map(|patch| corner_values(&patch)).collect_vec();
    let mut reached = Bounds::of_rows(&corners, dim);
    let tolerance = TOLERANCE * reached.diagonal();
    let exceeds = |patch: &BezierPatch, reached: &Bounds| {
        let may = patch.bounds();
        (0..dim).any(|k| may.min[k] < reached.min[k] - tolerance || may.max[k] > reached.max[k] + tolerance)
    };
    for patch in all() {
        let mut open = vec![(patch, 0)];
        while let Some((patch, depth)) = open.pop() {
            // halving brings ordinates to the surface at second order: this deep they differ by roundoff
            if depth == 26 || !exceeds(&patch, &reached) {
                continue;
            }
            let Domain { min, max } = patch.domain;
            let middle = 0.5 * (min + max);
            let quarters = patch.split_u(middle.x).into_iter().flat_map(|half| half.split_v(middle.y));
            for quarter in quarters {
                let values = corner_values(&quarter);
                reached = Bounds::of_rows(&[values.as_slice(), &reached.min, &reached.max].concat(), dim);
                memory::push(&mut open, (quarter, depth + 1));
            }
        }
    }
    reached
}

/// The values at the corners of a patch, one after the other.
fn corner_values(patch: &BezierPatch) -> Vec<f64> {
    let Domain { min, max } = patch.domain;
    [min, DVec2::new(max.x, min.y), DVec2::new(min.x, max.y), max]
        .iter()
        .flat_map(|&uv| patch.eval(uv))
        .collect_vec()
}

/// The area of the part of a surface in space that is inside its trims.
pub fn area(surface: &dyn Surface, options: &TessellateOptions, pool: &Pool) -> Result<f64, TessellateError> {
    let mesh = tessellate_watched(surface, options, pool.watch())?.mesh;
    let uv = mesh.parameters().unwrap_or(&[]);
    let over = |triangle: &[u32; 3]| over_triangle(surface, triangle.map(|node| uv[node as usize]));
    // pieces are added in their order, so that the sum does not depend on the number of threads
    let parts: Vec<f64> = pool.run(|| mesh.triangles().par_iter().map(over).collect_vec());
    Ok(parts.iter().sum())
}

/// Radon's weights and barycentric coordinates: the centroid, and two orbits of three.
fn radon() -> [(f64, DVec3); 7] {
    let root = 15.0_f64.sqrt();
    let (near, far) = ((6.0 - root) / 21.0, (6.0 + root) / 21.0);
    let (near_weight, far_weight) = ((155.0 - root) / 1200.0, (155.0 + root) / 1200.0);
    let orbit = |a: f64, k: usize| {
        let mut at = DVec3::splat(a);
        at[k] = 1.0 - 2.0 * a;
        at
    };
    [
        (9.0 / 40.0, DVec3::splat(1.0 / 3.0)),
        (near_weight, orbit(near, 0)),
        (near_weight, orbit(near, 1)),
        (near_weight, orbit(near, 2)),
        (far_weight, orbit(far, 0)),
        (far_weight, orbit(far, 1)),
        (far_weight, orbit(far, 2)),
    ]
}

/// The area of a surface in space over a triangle of the parameter plane.
fn over_triangle(surface: &dyn Surface, [a, b, c]: [DVec2; 3]) -> f64 {
    let points = radon();
    let uv = points.map(|(_, at)| at.x * a + at.y * b + at.z * c);
    let mut rows = [0.0; 7 * 9];
    surface.eval_rows(&uv, 1, &mut rows);
    let stretch = rows.chunks_exact(9).zip(points).map(|(row, (weight, _))| {
        weight * DVec3::from_slice(&row[3..]).cross(DVec3::from_slice(&row[6..])).length()
    });
    0.5 * (b - a).perp_dot(c - a).abs() * stretch.sum::<f64>()
}

/// Whether the sides of the domain at the least and the largest parameter of an axis (0 for u, 1 for v) are one curve.
/// Never so for a surface without patches, whose domain has no sides.
pub fn is_closed(surface: &dyn Surface, axis: usize) -> bool {
    let Some(patches) = surface.patches() else { return false };
    let Domain { min, max } = surface.domain();
    let mut along = Vec::new();
    for patch in (0..patches.patch_count()).map(|index| patches.patch(index)) {
        let is_at_side = patch.domain.min[axis] == min[axis] || patch.domain.max[axis] == max[axis];
        if is_at_side {
            let (from, to, degree) =
                (patch.domain.min[1 - axis], patch.domain.max[1 - axis], patch.degree[1 - axis]);
            // rational pieces are equal if products of a numerator and a denominator are: twice the degree
            let count = if patch.is_rational { 2 * degree } else { degree };
            memory::extend(
                &mut along,
                (0..=count).map(|i| from + (to - from) * i as f64 / count.max(1) as f64),
            );
        }
    }
    let side = |across: f64| {
        let at = |&t: &f64| if axis == 0 { DVec2::new(across, t) } else { DVec2::new(t, across) };
        let uv: Vec<DVec2> = along.iter().map(at).collect_vec();
        let mut rows = memory::filled(0.0, surface.dim() * uv.len());
        surface.eval_rows(&uv, 0, &mut rows);
        rows
    };
    let (low, high) = (side(min[axis]), side(max[axis]));
    let size = bounding_box(surface).diagonal();
    low.iter().zip(&high).all(|(low, high)| (low - high).abs() <= TOLERANCE * size)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::knots::KnotVector;
    use crate::surface::tensor::TensorSurface;
    use std::f64::consts::TAU;

    /// A cylinder about the z axis, of radius 2 and height 3, as four rational arcs.
    fn cylinder() -> TensorSurface {
        let (h, w) = (3.0, 0.5_f64.sqrt());
        let corners = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0)];
        let mut points = Vec::new();
        let mut weights = Vec::new();
        for (k, (x, y)) in corners.into_iter().enumerate() {
            for z in [0.0, h] {
                points.extend([2.0 * f64::from(x), 2.0 * f64::from(y), z]);
                weights.push(if k % 2 == 1 { w } else { 1.0 });
            }
        }
        let u = KnotVector::new(vec![0., 0., 0., 1., 1., 2., 2., 3., 3., 4., 4., 4.], 2).unwrap();
        let v = KnotVector::clamped(&[0.0, 1.0], 1).unwrap();
        TensorSurface::new(3, u, v, points, Some(weights)).unwrap()
    }

    #[test]
    fn a_cylinder_has_the_measures_of_one() {
        let cylinder = cylinder();
        let found = bounding_box(&cylinder);
        let (least, largest) = ([-2.0, -2.0, 0.0], [2.0, 2.0, 3.0]);
        assert!(
            (0..3)
                .all(|k| (found.min[k] - least[k]).abs() <= 1e-12
                    && (found.max[k] - largest[k]).abs() <= 1e-12)
        );
        assert!(is_closed(&cylinder, 0) && !is_closed(&cylinder, 1));
        let pool = Pool::new(2);
        let exact = 2.0 * TAU * 3.0;
        let errors = [1e-1, 1e-2].map(|chord_tolerance| {
            let options = TessellateOptions { chord_tolerance, ..TessellateOptions::default() };
            (area(&cylinder, &options, &pool).unwrap() - exact).abs() / exact
        });
        // chords would be wrong by 2 %, and by 0.2 %
        assert!(errors[0] < 1e-5 && errors[1] <= errors[0].max(1e-12), "{errors:?}");
    }

    #[test]
    fn a_dome_is_as_high_as_it_reaches_and_no_higher() {
        // z = 4 (1 - u^2) (1 - v^2) over [-1, 1]^2: no corner of its patch is on top, and ordinates lie above it
        let line = || KnotVector::clamped(&[-1.0, 1.0], 2).unwrap();
        let heights = [0.0, 2.0, 0.0];
        let points = (0..9).flat_map(|k| {
            let (i, j) = (k / 3, k % 3);
            [i as f64 - 1.0, j as f64 - 1.0, 4.0 * heights[i] * heights[j]]
        });
        let dome = TensorSurface::new(3, line(), line(), points.collect(), None).unwrap();
        let found = bounding_box(&dome);
        assert!((found.max[2] - 4.0).abs() <= 1e-10, "{}", found.max[2]);
        assert_eq!(found.min, [-1.0, -1.0, 0.0]);
        assert!(!is_closed(&dome, 0) && !is_closed(&dome, 1));
    }
}
