//! Triangles of a mesh that cross each other, counted exactly.
//!
//! Two triangles cross where an edge of one pierces the other: its ends lie strictly on either side of the plane, and it
//! passes strictly inside all three edges. All five signs are those of determinants computed without rounding error
//! (J. R. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates", Discrete Comput.
//! Geom. 18 (1997)). Triangles that only touch, at common nodes and edges too, do not cross; coplanar ones are not
//! looked at.

use super::triangles::TriangleTree;
use crate::control::{Cancelled, Pool};
use crate::mesh::Mesh;
use glam::DVec3;
use rayon::prelude::*;

/// Triangles of one piece of work.
const PIECE: usize = 256;

/// The pairs of triangles that cross.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Crossings {
    /// How many there are.
    pub count: usize,
    /// The first of them, the smaller number first; None if there are none.
    pub first: Option<[u32; 2]>,
}

/// Counts the pairs of triangles of a mesh that cross.
pub fn crossings(mesh: &Mesh, pool: &Pool) -> Result<Crossings, Cancelled> {
    crossed_triangles(mesh, pool).map(|(found, _)| found)
}

/// Counts the pairs of triangles of a mesh that cross, and tells which triangles those are, ascending.
pub fn crossed_triangles(mesh: &Mesh, pool: &Pool) -> Result<(Crossings, Vec<u32>), Cancelled> {
    let tree = TriangleTree::new(mesh);
    let count = mesh.triangles().len() as u32;
    let pieces: Vec<u32> = (0..count).step_by(PIECE).collect();
    let of_piece = |&start: &u32| -> Result<(Crossings, Vec<u32>), Cancelled> {
        pool.check()?;
        let (mut found, mut crossed) = (Crossings::default(), Vec::new());
        for triangle in start..count.min(start + PIECE as u32) {
            let corners = tree.corners(triangle);
            tree.for_each_near(corners, |other| {
                if other > triangle && do_cross(corners, tree.corners(other)) {
                    found.count += 1;
                    let pair = [triangle, other];
                    found.first = Some(found.first.map_or(pair, |first| first.min(pair)));
                    crossed.extend(pair);
                }
            });
        }
        crossed.sort_unstable();
        crossed.dedup();
        Ok((found, crossed))
    };
    let of_pieces: Result<Vec<_>, Cancelled> = pool.run(|| pieces.par_iter().map(of_piece).collect());
    let (mut all, mut crossed) = (Crossings::default(), Vec::new());
    for (found, of_piece) in of_pieces? {
        all = Crossings { count: all.count + found.count, first: all.first.or(found.first) };
        crossed.extend(of_piece);
    }
    crossed.sort_unstable();
    crossed.dedup();
    Ok((all, crossed))
}

/// Whether an edge of one triangle pierces the other.
fn do_cross(a: [DVec3; 3], b: [DVec3; 3]) -> bool {
    let (of_a, of_b) = (a.map(|corner| side(b, corner)), b.map(|corner| side(a, corner)));
    let is_beside = |sides: [i8; 3]| !sides.contains(&1) || !sides.contains(&-1);
    if is_beside(of_a) || is_beside(of_b) {
        return false;
    }
    pierces(a, of_a, b) || pierces(b, of_b, a)
}

/// Whether an edge, of whose triangle the corners lie on these sides of another, passes inside that one.
fn pierces(edges_of: [DVec3; 3], sides: [i8; 3], [a, b, c]: [DVec3; 3]) -> bool {
    (0..3).any(|k| {
        let next = (k + 1) % 3;
        if sides[k] * sides[next] >= 0 {
            return false;
        }
        let [p, q] = [edges_of[k], edges_of[next]];
        let turns = [[a, b], [b, c], [c, a]].map(|[from, to]| side([p, q, from], to));
        turns[0] != 0 && turns.iter().all(|&turn| turn == turns[0])
    })
}

/// The exact side of a plane through three points on which a fourth lies.
fn side([a, b, c]: [DVec3; 3], d: DVec3) -> i8 {
    let coord = |p: DVec3| robust::Coord3D { x: p.x, y: p.y, z: p.z };
    match robust::orient3d(coord(a), coord(b), coord(c), coord(d)) {
        volume if volume > 0.0 => 1,
        volume if volume < 0.0 => -1,
        _ => 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::Random;

    fn count(points: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Crossings {
        let mesh = Mesh::new(points, triangles).unwrap();
        let one = crossings(&mesh, &Pool::new(1)).unwrap();
        assert_eq!(one, crossings(&mesh, &Pool::new(3)).unwrap());
        one
    }

    /// Two triangles of nodes of their own.
    fn pair(a: [[f64; 3]; 3], b: [[f64; 3]; 3]) -> usize {
        let points = a.into_iter().chain(b).map(DVec3::from_array).collect();
        count(points, vec![[0, 1, 2], [3, 4, 5]]).count
    }

    #[test]
    fn what_pierces_crosses_and_what_touches_does_not() {
        let floor = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]];
        assert_eq!(pair(floor, [[0.5, 0.5, -1.0], [0.5, 0.5, 1.0], [0.6, 3.0, 1.0]]), 1);
        // a corner, an edge, a side and a whole face in common
        assert_eq!(pair(floor, [[0.5, 0.5, 0.0], [0.5, 0.5, 1.0], [0.6, 3.0, 1.0]]), 0);
        assert_eq!(pair(floor, [[0.5, 0.0, -1.0], [0.5, 0.0, 1.0], [0.6, -3.0, 1.0]]), 0);
        assert_eq!(pair(floor, [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 1.0]]), 0);
        assert_eq!(pair(floor, [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0]]), 0);
        // beside it by the last bit
        let beside = 2.0_f64.next_up();
        assert_eq!(pair(floor, [[beside, 0.0, -1.0], [beside, 0.0, 1.0], [3.0, 0.1, 0.0]]), 0);
    }

    #[test]
    fn every_pair_is_found_by_the_tree() {
        let mut random = Random::new(11);
        let mut vector = || DVec3::new(random.signed(), random.signed(), random.signed());
        let (mut points, mut triangles) = (Vec::new(), Vec::new());
        for k in 0..300_u32 {
            let middle = vector();
            points.extend([(); 3].map(|()| middle + 0.3 * vector()));
            triangles.push([3 * k, 3 * k + 1, 3 * k + 2]);
        }
        let corners = |k: usize| triangles[k].map(|node| points[node as usize]);
        let pairs = (0..300).flat_map(|a| (a + 1..300).map(move |b| (a, b)));
        let crossing: Vec<(usize, usize)> =
            pairs.filter(|&(a, b)| do_cross(corners(a), corners(b))).collect();
        let found = count(points.clone(), triangles.clone());
        assert!(crossing.len() > 100, "{}", crossing.len());
        assert_eq!(found.count, crossing.len());
        assert_eq!(found.first, Some([crossing[0].0 as u32, crossing[0].1 as u32]));
    }
}
