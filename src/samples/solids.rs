//! Closed shapes of any genus: meshes of implicit surfaces.
//!
//! S. F. F. Gibson, "Constrained elastic surface nets" (1998): one node in each cell of a grid that the surface passes,
//! one square for each edge of the grid that it crosses. Nodes are then moved about by a seeded jitter and put on to
//! the surface.

use super::Random;
use crate::mesh::{Mesh, MeshError};
use glam::{DVec3, UVec3};

/// Share of a cell by which nodes are moved about.
const JITTER: f64 = 0.15;
/// Steps of Newton's method along the gradient: from within a cell to rounding.
const PROJECTIONS: usize = 8;
/// Step of central differences, in cells.
const DIFFERENCE: f64 = 1e-3;

/// A round ball of about `count` nodes.
pub fn ball(count: usize, seed: u64) -> Result<Mesh, MeshError> {
    implicit(|p| p.length() - 1.0, DVec3::splat(1.1), count, 12.57, seed)
}

/// A ball with five arms of different lengths.
pub fn starfish(count: usize, seed: u64) -> Result<Mesh, MeshError> {
    let arms: [DVec3; 5] = std::array::from_fn(|k| {
        let angle = 0.4 * std::f64::consts::PI * k as f64;
        (1.5 + 0.3 * k as f64) * DVec3::new(angle.cos(), angle.sin(), 0.1 * k as f64)
    });
    let shape = move |p: DVec3| {
        let arm = |tip: &DVec3| {
            let t = (p.dot(*tip) / tip.length_squared()).clamp(0.0, 1.0);
            p.distance(t * *tip) - 0.3
        };
        smooth_least(arms.iter().map(arm).chain([p.length() - 0.6]), 0.15)
    };
    implicit(shape, DVec3::new(3.1, 3.1, 1.6), count, 25.0, seed)
}

/// A chain of `genus` rings, each grown into the next; a ball for none. About `count` nodes.
pub fn handles(genus: usize, count: usize, seed: u64) -> Result<Mesh, MeshError> {
    if genus == 0 {
        return ball(count, seed);
    }
    const RADIUS: f64 = 1.0;
    const THICKNESS: f64 = 0.42;
    let step = 2.0 * RADIUS + 0.5 * THICKNESS;
    let middle = 0.5 * step * (genus - 1) as f64;
    let shape = move |p: DVec3| {
        let ring = |k: usize| {
            let q = p - DVec3::X * (step * k as f64 - middle);
            (q.truncate().length() - RADIUS).hypot(q.z) - THICKNESS
        };
        smooth_least((0..genus).map(ring), 0.1)
    };
    let half = DVec3::new(middle + RADIUS + THICKNESS, RADIUS + THICKNESS, THICKNESS) + 0.1;
    implicit(shape, half, count, 15.0 * genus as f64, seed)
}

/// A flat block with round edges and `holes` round holes in a row. About `count` nodes.
pub fn holed_block(holes: usize, count: usize, seed: u64) -> Result<Mesh, MeshError> {
    let half = DVec3::new(0.9 * holes.max(1) as f64, 0.8, 0.25);
    let shape = move |p: DVec3| {
        const ROUND: f64 = 0.15;
        let outside = (p.abs() - (half - ROUND)).max(DVec3::ZERO).length() - ROUND;
        let hole = |k: usize| {
            let x = 1.8 * k as f64 - 0.9 * (holes - 1) as f64;
            0.42 - (p.truncate() - glam::DVec2::new(x, 0.0)).length()
        };
        -smooth_least((0..holes).map(hole).map(|h| -h).chain([-outside]), 0.1)
    };
    implicit(shape, half + 0.1, count, 8.4 * holes.max(1) as f64, seed)
}

/// A rocker: two arms of unlike length on a hub with a round hole, one handle in all. About `count` nodes.
pub fn rocker(count: usize, seed: u64) -> Result<Mesh, MeshError> {
    const ENDS: [DVec3; 2] = [DVec3::new(1.7, 0.4, 0.0), DVec3::new(-1.3, 0.5, 0.1)];
    const THICKNESS: f64 = 0.28;
    const HOLE: f64 = 0.26;
    let shape = |p: DVec3| {
        let across = p.truncate().length();
        let hub = (across - 0.4).max(0.0).hypot(p.z) - THICKNESS;
        let arm = |end: DVec3| {
            let share = (p.dot(end) / end.length_squared()).clamp(0.0, 1.0);
            p.distance(share * end) - THICKNESS * (0.8 + 0.3 * share)
        };
        let body = smooth_least(ENDS.into_iter().map(arm).chain([hub]), 0.15);
        -smooth_least([-body, across - HOLE].into_iter(), 0.1)
    };
    let mesh = implicit(shape, DVec3::new(2.2, 1.0, 0.6), count, 9.0, seed)?;
    evened(mesh, shape)
}

/// The mesh with its nodes amid their neighbours, on the surface: no triangle is thin or turned over.
fn evened(mesh: Mesh, f: impl Fn(DVec3) -> f64) -> Result<Mesh, MeshError> {
    const SWEEPS: usize = 5;
    /// Step of central differences, in diagonals: small beside any cell.
    const SHARE: f64 = 1e-5;
    let step = SHARE * mesh.diagonal();
    let mut points = mesh.points().to_vec();
    for _ in 0..SWEEPS {
        let amid = |node: u32| {
            let (sum, count) = mesh.neighbours(node).fold((DVec3::ZERO, 0.0), |(sum, count), beside| {
                (sum + points[beside as usize], count + 1.0)
            });
            projected(&f, sum / count, step)
        };
        points = (0..points.len() as u32).map(amid).collect();
    }
    Mesh::new(points, mesh.triangles().to_vec())
}

/// The least of some numbers, rounded off over `width` where they are nearly equal.
fn smooth_least(values: impl Iterator<Item = f64>, width: f64) -> f64 {
    let blend = |a: f64, b: f64| {
        let share = (1.0 - (a - b).abs() / width).max(0.0);
        a.min(b) - 0.25 * width * share * share
    };
    values.reduce(blend).unwrap_or(f64::INFINITY)
}

/// Places of the grid tried: where a saddle touches a plane of the grid the surface meets itself in an edge.
const ATTEMPTS: usize = 32;

/// The surface f = 0, f negative inside, in the box from -half to half; `area` is a guess of its area.
fn implicit(
    f: impl Fn(DVec3) -> f64,
    half: DVec3,
    count: usize,
    area: f64,
    seed: u64,
) -> Result<Mesh, MeshError> {
    // a surface passes about 1.5 cells for each cell's face of its area
    let cell = (1.5 * area / count as f64).sqrt();
    let mut random = Random::new(seed);
    let is_closed = |mesh: &Mesh| mesh.loops().is_empty() && mesh.pinched_nodes().is_empty();
    for _ in 1..ATTEMPTS {
        if let Ok(mesh) = net(&f, half, cell, &mut random)
            && is_closed(&mesh)
        {
            return Ok(mesh);
        }
    }
    net(&f, half, cell, &mut random)
}

/// The net of a grid that lies somewhere.
fn net(f: &impl Fn(DVec3) -> f64, half: DVec3, cell: f64, random: &mut Random) -> Result<Mesh, MeshError> {
    let cells = (2.0 * half / cell).ceil().as_uvec3() + 3;
    let shift = DVec3::new(random.unit(), random.unit(), random.unit());
    let origin = cell * (shift - 0.5 * cells.as_dvec3());
    let at = |p: UVec3| origin + cell * p.as_dvec3();
    let corners = cells + 1;
    let number = |p: UVec3, size: UVec3| ((p.z * size.y + p.y) * size.x + p.x) as usize;
    let all = |size: UVec3| {
        (0..size.z)
            .flat_map(move |z| (0..size.y).flat_map(move |y| (0..size.x).map(move |x| UVec3::new(x, y, z))))
    };
    let values: Vec<f64> = all(corners).map(|p| f(at(p))).collect();
    let value = |p: UVec3| values[number(p, corners)];
    let is_inside = |p: UVec3| value(p) < 0.0;

    let mut node_of_cell = vec![u32::MAX; cells.element_product() as usize];
    let mut points = Vec::new();
    for low in all(cells) {
        let (mut sum, mut crossings) = (DVec3::ZERO, 0);
        for axis in 0..3 {
            for side in 0..4 {
                let mut from = low;
                from[(axis + 1) % 3] += side & 1;
                from[(axis + 2) % 3] += side >> 1;
                let to = from + unit(axis);
                if is_inside(from) != is_inside(to) {
                    let share = value(from) / (value(from) - value(to));
                    sum += at(from).lerp(at(to), share);
                    crossings += 1;
                }
            }
        }
        if crossings > 0 {
            node_of_cell[number(low, cells)] = points.len() as u32;
            points.push(sum / f64::from(crossings));
        }
    }
    let mut triangles = Vec::new();
    for from in all(cells) {
        for axis in 0..3 {
            let to = from + unit(axis);
            let [i, j] = [(axis + 1) % 3, (axis + 2) % 3];
            if from[i] == 0 || from[j] == 0 || is_inside(from) == is_inside(to) {
                continue;
            }
            // the four cells around the edge, counter-clockwise seen from its end
            let around = [[1, 1], [0, 1], [0, 0], [1, 0]].map(|[a, b]| {
                let mut low = from;
                low[i] -= a;
                low[j] -= b;
                node_of_cell[number(low, cells)]
            });
            let [p, q, r, s] =
                if is_inside(from) { around } else { [around[0], around[3], around[2], around[1]] };
            let falling = random.unit() < 0.5;
            triangles.extend(if falling { [[p, q, r], [p, r, s]] } else { [[p, q, s], [q, r, s]] });
        }
    }
    for point in &mut points {
        let moved = DVec3::new(random.signed(), random.signed(), random.signed());
        *point = projected(f, *point + JITTER * cell * moved, DIFFERENCE * cell);
    }
    Mesh::new(points, triangles)
}

fn unit(axis: usize) -> UVec3 {
    let mut unit = UVec3::ZERO;
    unit[axis] = 1;
    unit
}

/// The place on the surface reached along the gradient.
fn projected(f: &impl Fn(DVec3) -> f64, mut p: DVec3, step: f64) -> DVec3 {
    for _ in 0..PROJECTIONS {
        let gradient = DVec3::from_array(
            [DVec3::X, DVec3::Y, DVec3::Z]
                .map(|axis| (f(p + step * axis) - f(p - step * axis)) / (2.0 * step)),
        );
        p -= gradient * (f(p) / gradient.length_squared().max(f64::MIN_POSITIVE));
    }
    p
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solids_are_closed_and_have_the_genus_they_promise() {
        for (mesh, count, genus) in [
            (ball(1000, 1), 1000, 0),
            (ball(100, 2), 100, 0),
            (starfish(3000, 3), 3000, 0),
            (handles(1, 1000, 4), 1000, 1),
            (handles(2, 2000, 5), 2000, 2),
            (handles(3, 3000, 6), 3000, 3),
            (handles(6, 8000, 7), 8000, 6),
            (holed_block(1, 1500, 8), 1500, 1),
            (holed_block(5, 5000, 9), 5000, 5),
        ] {
            let mesh = mesh.unwrap();
            let nodes = mesh.points().len();
            assert!(nodes > count / 2 && nodes < 2 * count, "{nodes} nodes, {count} wanted");
            assert!(mesh.loops().is_empty() && mesh.pinched_nodes().is_empty());
            assert_eq!((mesh.component_count(), mesh.genus()), (1, genus));
            let volume: f64 = mesh
                .triangles()
                .iter()
                .map(|t| {
                    let [a, b, c] = t.map(|node| mesh.points()[node as usize]);
                    a.dot(b.cross(c)) / 6.0
                })
                .sum();
            assert!(volume > 0.0, "turned inside out");
        }
    }
}
