//! Unrolling: a map with a free border that keeps lengths as well as it can.
//!
//! L. Liu, L. Zhang, Y. Xu, C. Gotsman, S. Gortler, "A local/global approach to mesh parameterization", Comput.
//! Graph. Forum 27 (2008), 1495-1504 (as-rigid-as-possible). Each triangle is laid flat; in turns every one is
//! rotated to fit the map best, and the map is fitted to all of them by a Laplace system that never changes:
//! ```text
//! sum_j w_ij (u_i - u_j) = sum_j (cot_t R_t + cot_t' R_t') (x_i - x_j) / 2
//! ```
//! On nearly developable sheets with notches and holes nothing is better; on deep shapes
//! triangles flip. So the result is a candidate only: it is taken if no triangle flips, no two pieces of the
//! boundary cross, and the stretch is less.

use super::crossings::boundary_crosses;
use super::patch::{Neighbours, landmark, outer_loop};
use crate::control::Pool;
use crate::geometry::{Orientation, orientation};
use crate::linalg::SymbolicCholesky;
use crate::memory::{self, CollectVec, ParallelCollectVec};
use crate::mesh::{Mesh, loop_edges};
use glam::{DMat2, DVec2, DVec3};
use rayon::prelude::*;
use sprs::CsMat;

/// Turns at most; nearly developable sheets need about ten.
const TURNS: usize = 40;
/// A turn that moves no node by this share of the map's size is the last.
const STILL: f64 = 1e-4;
/// A triangle of less than this share of the mean area is left out: its angles are noise.
const LEAST_AREA: f64 = 1e-12;

/// A length-keeping map of the mesh, started from `start`; None if it folds or overlaps itself. It is turned so
/// that its smallest bounding rectangle is upright, and lies in the unit square.
pub(super) fn unroll(mesh: &Mesh, start: &[DVec2], pool: &Pool) -> Option<Vec<DVec2>> {
    // a cancelled call throws its map away
    let sheet = Sheet::new(mesh);
    pool.check().ok()?;
    let matrix = sheet.laplacian(mesh);
    pool.check().ok()?;
    let symbolic = SymbolicCholesky::new(&matrix.view(), None);
    pool.check().ok()?;
    let factor = symbolic.factor(&matrix.view()).ok()?;
    let n = mesh.points().len();
    let mut uv = sheet.scaled(start);
    for _ in 0..TURNS {
        pool.check().ok()?;
        let mut columns = pool.run(|| sheet.right_sides(mesh, &uv));
        factor.solve(&mut columns, 2);
        let moved: Vec<DVec2> = (0..n).map(|i| DVec2::new(columns[i], columns[n + i])).collect_vec();
        // both maps are known up to a shift only; counted by triangles, so that unused nodes do not matter, nor
        // which node is first
        let corners = || mesh.triangles().iter().flatten().map(|&node| node as usize);
        let middle = |uv: &[DVec2]| corners().map(|n| uv[n]).sum::<DVec2>() / corners().count() as f64;
        let shift = middle(&uv) - middle(&moved);
        let step = corners().map(|n| (moved[n] + shift).distance(uv[n])).fold(0.0, f64::max);
        uv = moved;
        if step <= STILL * sheet.size {
            break;
        }
    }
    pool.check().ok()?;
    let mut upright = in_unit_square(mesh, &uv);
    mesh.unused_nodes().iter().for_each(|&node| upright[node as usize] = start[node as usize]);
    let is_open = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|n| upright[n as usize]);
        orientation(a, b, c) == Orientation::Positive
    };
    let is_valid = upright.iter().all(|p| p.is_finite())
        && mesh.triangles().iter().all(is_open)
        && !boundary_crosses(mesh, &upright);
    is_valid.then_some(upright)
}

/// The triangles, each laid flat in a frame of its own, with the cotangents of its angles.
struct Sheet {
    flat: Vec<[DVec2; 3]>,
    cotangents: Vec<[f64; 3]>,
    area: f64,
    size: f64,
    pinned: usize,
}

impl Sheet {
    fn new(mesh: &Mesh) -> Self {
        let corners = |t: &[u32; 3]| t.map(|n| mesh.points()[n as usize]);
        let twice_area = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a).length();
        let areas: Vec<f64> = mesh.triangles().iter().map(|t| twice_area(corners(t))).collect_vec();
        let total: f64 = areas.iter().sum();
        let least = LEAST_AREA * total / areas.len() as f64;
        let flat = |[a, b, c]: [DVec3; 3]| {
            let (along, across) = (b - a, c - a);
            let length = along.length();
            let x = along.dot(across) / length;
            [DVec2::ZERO, DVec2::new(length, 0.0), DVec2::new(x, along.cross(across).length() / length)]
        };
        let cotangents = |corners: [DVec3; 3], area: f64| {
            std::array::from_fn(|k| {
                let [p, q, r] = [0, 1, 2].map(|d| corners[(k + d) % 3]);
                if area > least { (q - p).dot(r - p) / area } else { 0.0 }
            })
        };
        let triangles = mesh.triangles();
        Self {
            flat: triangles.iter().map(|t| flat(corners(t))).collect_vec(),
            cotangents: triangles
                .iter()
                .zip(&areas)
                .map(|(t, &area)| cotangents(corners(t), area))
                .collect_vec(),
            area: total / 2.0,
            size: mesh.diagonal(),
            pinned: triangles[0][0] as usize,
        }
    }

    /// The map with the area of the shape.
    fn scaled(&self, uv: &[DVec2]) -> Vec<DVec2> {
        let (min, max) = uv
            .iter()
            .fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(min, max), p| (min.min(*p), max.max(*p)));
        let scale = (self.area / (max - min).element_product().max(f64::MIN_POSITIVE)).sqrt();
        uv.iter().map(|p| (*p - min) * scale).collect_vec()
    }

    /// Lower triangle of the cotangent Laplacian. The first used node is held; nodes without triangles stay at
    /// the origin.
    fn laplacian(&self, mesh: &Mesh) -> CsMat<f64> {
        let n = mesh.points().len();
        let open_edges: Vec<[u32; 2]> = mesh.loops().iter().flat_map(|l| loop_edges(l)).collect_vec();
        let neighbours = Neighbours::new(n, mesh.triangles(), &open_edges);
        // each column has its diagonal, then the neighbours below it, which are the last of their list
        let (mut starts, mut rows) =
            (memory::with_capacity(n + 1), memory::with_capacity(n + neighbours.nodes().len() / 2));
        for node in 0..n {
            memory::push(&mut starts, rows.len());
            memory::push(&mut rows, node);
            let below = neighbours.of(node).iter().map(|&other| other as usize).filter(|&other| other > node);
            memory::extend(&mut rows, below);
        }
        memory::push(&mut starts, rows.len());
        let mut values = memory::filled(0.0, rows.len());
        for (triangle, cotangents) in mesh.triangles().iter().zip(&self.cotangents) {
            for k in 0..3 {
                let [i, j] = [triangle[(k + 1) % 3], triangle[(k + 2) % 3]];
                let (column, row) = (i.min(j), i.max(j));
                let behind = neighbours.slots(column as usize).end - neighbours.slot(column, row);
                let weight = cotangents[k] / 2.0;
                values[starts[i as usize]] += weight;
                values[starts[j as usize]] += weight;
                values[starts[column as usize + 1] - behind] -= weight;
            }
        }
        values[starts[self.pinned]] += 1.0;
        mesh.unused_nodes().iter().for_each(|&node| values[starts[node as usize]] += 1.0);
        CsMat::new_csc((n, n), starts, rows, values)
    }

    /// The edges of the flat triangles, each turned to fit the map best, summed at the nodes.
    fn right_sides(&self, mesh: &Mesh, uv: &[DVec2]) -> Vec<f64> {
        let pulls: Vec<[DVec2; 3]> = (mesh.triangles(), &self.flat, &self.cotangents)
            .into_par_iter()
            .map(|(triangle, flat, cotangents)| pulls(triangle.map(|n| uv[n as usize]), flat, cotangents))
            .collect_vec();
        let n = uv.len();
        let mut columns = memory::filled(0.0, 2 * n);
        for (triangle, pulls) in mesh.triangles().iter().zip(pulls) {
            for (&node, pull) in triangle.iter().zip(pulls) {
                columns[node as usize] += pull.x;
                columns[n + node as usize] += pull.y;
            }
        }
        columns
    }
}

/// What a triangle adds to the right-hand sides of its corners.
fn pulls(places: [DVec2; 3], flat: &[DVec2; 3], cotangents: &[f64; 3]) -> [DVec2; 3] {
    let edge = |points: &[DVec2; 3], k: usize| points[(k + 1) % 3] - points[(k + 2) % 3];
    // the rotation nearest to sum cot (u_i - u_j) (x_i - x_j)^T
    let (mut cos, mut sin) = (0.0, 0.0);
    for k in 0..3 {
        let (u, x) = (edge(&places, k), edge(flat, k));
        cos += cotangents[k] * u.dot(x);
        sin += cotangents[k] * x.perp_dot(u);
    }
    let turn = DMat2::from_angle(if cos == 0.0 && sin == 0.0 { 0.0 } else { sin.atan2(cos) });
    let mut pulls = [DVec2::ZERO; 3];
    for k in 0..3 {
        let pull = turn * edge(flat, k) * (cotangents[k] / 2.0);
        pulls[(k + 1) % 3] += pull;
        pulls[(k + 2) % 3] -= pull;
    }
    pulls
}

/// Turns the smallest bounding rectangle upright, its longer side along u, and scales it into the unit square.
///
/// Of several smallest rectangles, as symmetric outlines have, the one in which the border's landmark has the least u,
/// and of these the least v, is taken.
pub(super) fn in_unit_square(mesh: &Mesh, uv: &[DVec2]) -> Vec<DVec2> {
    /// Differences below this are rounding.
    const SAME: f64 = 1e-9;
    let border = &mesh.loops()[outer_loop(mesh).unwrap_or(0)];
    let mark = uv[border[landmark(mesh, border)] as usize];
    let hull = convex_hull(border.iter().map(|&n| uv[n as usize]).collect_vec());
    // a square may lie on either pair of sides
    let boxes: Vec<(DMat2, DVec2, DVec2)> =
        rectangles(&hull).into_iter().filter(|(_, _, size)| size.x >= (1.0 - SAME) * size.y).collect_vec();
    let least = boxes.iter().map(|(_, _, size)| size.element_product()).fold(f64::INFINITY, f64::min);
    let place = |(turn, min, size): &(DMat2, DVec2, DVec2)| (*turn * mark - *min) / size.x;
    let smallest = boxes.iter().filter(|(_, _, size)| size.element_product() <= (1.0 + SAME) * least);
    let best = smallest.min_by(|a, b| {
        let (a, b) = (place(a), place(b));
        if (a.x - b.x).abs() > SAME { a.x.total_cmp(&b.x) } else { a.y.total_cmp(&b.y) }
    });
    let Some(&(turn, min, size)) = best else { return memory::copied(uv) };
    uv.iter().map(|&p| (turn * p - min) / size.x).collect_vec()
}

/// The rectangles around a convex polygon with a side along one of its own, each as it lies on either pair of sides: the
/// turn that makes it upright, its corner and its size then. The points that touch the other sides move on around the
/// polygon as the first side does (G. Toussaint, "Solving geometric problems with the rotating calipers", 1983).
fn rectangles(hull: &[DVec2]) -> Vec<(DMat2, DVec2, DVec2)> {
    let box_along = |direction: DVec2, touched: &[DVec2; 4]| {
        let turn =
            DMat2::from_cols(DVec2::new(direction.x, -direction.y), DVec2::new(direction.y, direction.x));
        let (min, max) = touched
            .iter()
            .map(|&p| turn * p)
            .fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(min, max), p| (min.min(p), max.max(p)));
        (turn, min, max - min)
    };
    let sides = hull.iter().zip(hull.iter().cycle().skip(1)).map(|(a, b)| (*b - *a).normalize_or_zero());
    let mut farthest: Option<[usize; 4]> = None;
    let boxes = sides.filter(|side| *side != DVec2::ZERO).flat_map(|side| {
        let directions = [side, side.perp(), -side, -side.perp()];
        let touched = match farthest {
            None => directions.map(|direction| farthest_along(direction, hull)),
            Some(before) => std::array::from_fn(|k| moved_on(before[k], directions[k], hull)),
        };
        farthest = Some(touched);
        let points = touched.map(|k| hull[k]);
        [box_along(side, &points), box_along(side.perp(), &points)]
    });
    boxes.collect_vec()
}

/// The corner that lies farthest in a direction.
fn farthest_along(direction: DVec2, hull: &[DVec2]) -> usize {
    let along = |&k: &usize| direction.dot(hull[k]);
    (0..hull.len()).max_by(|a, b| along(a).total_cmp(&along(b))).unwrap_or(0)
}

/// The same, from the one that did so before the direction turned counter-clockwise.
fn moved_on(mut corner: usize, direction: DVec2, hull: &[DVec2]) -> usize {
    for _ in 0..hull.len() {
        let next = (corner + 1) % hull.len();
        if !(direction.dot(hull[next]) >= direction.dot(hull[corner])) {
            break;
        }
        corner = next;
    }
    corner
}

/// The corners of the convex hull, counter-clockwise (A. Andrew's monotone chain).
fn convex_hull(mut points: Vec<DVec2>) -> Vec<DVec2> {
    points.sort_unstable_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let mut hull: Vec<DVec2> = Vec::new();
    let upper = points.iter().rev().skip(1);
    let mut start = 0;
    for (k, &p) in points.iter().chain(upper).enumerate() {
        if k == points.len() {
            start = hull.len() - 1;
        }
        while hull.len() >= start + 2
            && orientation(hull[hull.len() - 2], hull[hull.len() - 1], p) != Orientation::Positive
        {
            hull.pop();
        }
        memory::push(&mut hull, p);
    }
    hull.pop();
    hull
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parameterize::stretch;

    #[test]
    fn the_smallest_rectangle_has_no_smaller_one_along_any_side() {
        let mut random = crate::samples::Random::new(11);
        for count in [3, 4, 5, 17, 200] {
            let points = (0..count).map(|_| DVec2::new(3.0 * random.signed(), random.signed())).collect();
            let hull = convex_hull(points);
            let area = |(_, _, size): &(DMat2, DVec2, DVec2)| size.element_product();
            let least = rectangles(&hull).into_iter().min_by(|a, b| area(a).total_cmp(&area(b)));
            let (turn, min, size) = least.unwrap();
            let tol = 32.0 * f64::EPSILON * 4.0; // a few operations on numbers below four
            for &p in &hull {
                let inside = turn * p - min;
                assert!(inside.cmpge(DVec2::splat(-tol)).all() && inside.cmple(size + tol).all(), "{inside}");
            }
            for (k, &a) in hull.iter().enumerate() {
                let side = (hull[(k + 1) % hull.len()] - a).normalize();
                let range = |direction: DVec2| {
                    let along = hull.iter().map(|&p| direction.dot(p));
                    let (low, high) =
                        along.fold((f64::MAX, f64::MIN), |(low, high), x| (x.min(low), x.max(high)));
                    high - low
                };
                assert!(range(side) * range(side.perp()) >= size.element_product() - 8.0 * tol, "side {k}");
            }
        }
    }

    fn start(mesh: &Mesh) -> Vec<DVec2> {
        mesh.parameters().unwrap().to_vec()
    }

    #[test]
    fn a_developable_sheet_with_holes_unrolls_without_stretch() {
        // the notched plane rolled onto a cylinder of radius 3
        let flat = crate::samples::planar(1).unwrap();
        let rolled = |uv: &DVec2| DVec3::new(3.0 * (uv.x / 3.0).sin(), uv.y, 3.0 * (uv.x / 3.0).cos());
        let points = start(&flat).iter().map(rolled).collect();
        let mesh = Mesh::new(points, flat.triangles().to_vec()).unwrap();
        let squeezed: Vec<DVec2> = start(&flat).iter().map(|p| DVec2::new(p.x, 0.5 * p.y)).collect();
        let uv = unroll(&mesh, &squeezed, &Pool::new(1)).unwrap();
        let l2 = stretch(mesh.points(), mesh.triangles(), &uv).l2;
        // chords of edges 0.1 long on radius 3 are shorter than their arcs by 5e-5
        assert!((l2 - 1.0).abs() < 1e-4, "{l2}");
    }

    #[test]
    fn a_strip_that_winds_over_itself_is_refused() {
        // a spiral ramp of one and a half turns lies flat only over itself
        let (places, triangles) = crate::samples::grid([120, 6], 0.0, 1, |_| true);
        let ramp = |p: &DVec2| {
            let angle = 9.0 * p.x;
            let radius = 1.0 + p.y;
            DVec3::new(radius * angle.cos(), radius * angle.sin(), 0.02 * angle)
        };
        let points: Vec<DVec3> = places.iter().map(ramp).collect();
        let seen_from_above: Vec<DVec2> = points.iter().map(|p| p.truncate()).collect();
        let mesh = Mesh::new(points, triangles).unwrap();
        assert!(unroll(&mesh, &seen_from_above, &Pool::new(1)).is_none());
    }

    #[test]
    fn a_half_sphere_keeps_its_triangles_open_or_is_refused() {
        let (places, triangles) = crate::samples::grid([30, 30], 0.2, 1, |_| true);
        let dome = |p: &DVec2| {
            let q = 2.0 * *p - 1.0;
            DVec3::new(q.x, q.y, 2.0 - q.length_squared())
        };
        let mesh = Mesh::new(places.iter().map(dome).collect(), triangles).unwrap();
        let uv = unroll(&mesh, &places, &Pool::new(1)).unwrap();
        assert_eq!(crate::parameterize::folds(mesh.triangles(), &uv), (0, 0));
        assert!(uv.iter().all(|p| p.min_element() >= -1e-12 && p.max_element() <= 1.0 + 1e-12));
    }
}
