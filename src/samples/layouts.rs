//! Quad layouts with places for their vertices on the unit sphere, or on a torus.

use glam::DVec3;
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::PI;

/// Quads and the places of their vertices.
pub type PlacedQuads = (Vec<[u32; 4]>, Vec<DVec3>);

/// Two poles of `n` quads, and between them twice as many vertices of three.
pub fn trapezohedron(n: u32) -> PlacedQuads {
    let equator = |k: u32| k % (2 * n);
    let (north, south) = (2 * n, 2 * n + 1);
    let mut quads: Vec<[u32; 4]> =
        (0..n).map(|i| [north, equator(2 * i), equator(2 * i + 1), equator(2 * i + 2)]).collect();
    quads.extend((0..n).map(|i| [south, equator(2 * i + 1), equator(2 * i), equator(2 * i + 2 * n - 1)]));
    // even vertices belong to the northern edges
    let height = |k: u32| if k.is_multiple_of(2) { 0.3 } else { -0.3 };
    let mut places: Vec<DVec3> = (0..2 * n)
        .map(|k| {
            let (sin, cos) = (PI * f64::from(k) / f64::from(n)).sin_cos();
            DVec3::new(cos, sin, height(k)).normalize()
        })
        .collect();
    places.extend([DVec3::Z, DVec3::NEG_Z]);
    (quads, places)
}

/// The twelve triangles of a tetrahedron with a pyramid on each face, each split in three quads: vertices of 3, 4
/// and 6.
pub fn stellated_tetrahedron() -> PlacedQuads {
    let corners = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
    let mut places: Vec<DVec3> = corners.iter().map(|&corner| DVec3::from(corner).normalize()).collect();
    places.extend(corners.iter().map(|&corner| -DVec3::from(corner).normalize()));
    let mut triangles = Vec::new();
    // the pyramid over the face opposite to corner k has its tip at 4 + k
    for k in 0..4 {
        let others: Vec<u32> = (0..4).filter(|&other| other != k).collect();
        for [a, b] in [[0, 1], [1, 2], [2, 0]] {
            triangles.push(outwards([others[a], others[b], 4 + k], &places));
        }
    }
    split_in_three(&triangles, places)
}

/// A random triangulation of the sphere by `count` points, each triangle split in three quads.
pub fn random_sphere(count: usize, seed: u64) -> PlacedQuads {
    let mut random = super::Random::new(seed);
    let mut points: Vec<DVec3> = (0..count)
        .map(|_| {
            let (z, angle) = (random.signed(), PI * random.signed());
            DVec3::new((1.0 - z * z).sqrt() * angle.cos(), (1.0 - z * z).sqrt() * angle.sin(), z)
        })
        .collect();
    // apart, but not evenly
    for _ in 0..20 {
        let force = |p: DVec3| -> DVec3 {
            points.iter().filter(|&&q| q != p).map(|&q| (p - q) / p.distance(q).powi(3)).sum()
        };
        points = points.iter().map(|&p| (p + 0.02 * force(p)).normalize()).collect();
    }
    let mut triangles = Vec::new();
    for a in 0..count {
        for b in a + 1..count {
            for c in b + 1..count {
                let normal = (points[b] - points[a]).cross(points[c] - points[a]);
                let side = |k: usize| (points[k] - points[a]).dot(normal);
                let mut others = (0..count).filter(|k| ![a, b, c].contains(k)).map(side);
                let first = others.next().unwrap_or(0.0);
                if others.all(|height| height * first > 0.0) {
                    triangles.push(outwards([a, b, c].map(|k| k as u32), &points));
                }
            }
        }
    }
    split_in_three(&triangles, points)
}

/// A torus of `m` quads around and `n` across, of radii 1 and 0.4.
pub fn torus(m: u32, n: u32) -> PlacedQuads {
    let at = |i: u32, j: u32| (i % m) * n + j % n;
    let quads = (0..m * n).map(|k| (k / n, k % n));
    let quads = quads.map(|(i, j)| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]).collect();
    let place = |k: u32| {
        let (around, across) =
            (2.0 * PI * f64::from(k / n) / f64::from(m), 2.0 * PI * f64::from(k % n) / f64::from(n));
        let radius = 1.0 + 0.4 * across.cos();
        DVec3::new(radius * around.cos(), radius * around.sin(), 0.4 * across.sin())
    };
    (quads, (0..m * n).map(place).collect())
}

/// Numbers of the sides of quads, equal where they join the same two vertices, and those of some edges given by their
/// ends.
pub fn numbered_edges(quads: &[[u32; 4]], some: &[[u32; 2]]) -> (Vec<[u32; 4]>, BTreeSet<u32>) {
    let mut numbers = BTreeMap::new();
    let mut number = |[a, b]: [u32; 2]| {
        let next = numbers.len() as u32;
        *numbers.entry([a.min(b), a.max(b)]).or_insert(next)
    };
    let of_quads =
        quads.iter().map(|quad| std::array::from_fn(|k| number([quad[k], quad[(k + 1) % 4]]))).collect();
    (of_quads, some.iter().map(|&ends| number(ends)).collect())
}

fn outwards([a, b, c]: [u32; 3], points: &[DVec3]) -> [u32; 3] {
    let [p, q, r] = [a, b, c].map(|k| points[k as usize]);
    if p.dot(q.cross(r)) > 0.0 { [a, b, c] } else { [a, c, b] }
}

/// Quads from corner to middle of an edge to centroid to middle of an edge, on the unit sphere.
fn split_in_three(triangles: &[[u32; 3]], mut places: Vec<DVec3>) -> PlacedQuads {
    let mut middles: BTreeMap<[u32; 2], u32> = BTreeMap::new();
    let mut quads = Vec::new();
    for &triangle in triangles {
        let sum: DVec3 = triangle.iter().map(|&k| places[k as usize]).sum();
        let centre = places.len() as u32;
        places.push(sum.normalize());
        let [x, y, z] = [[0, 1], [1, 2], [2, 0]].map(|ends| {
            let [a, b] = ends.map(|k: usize| triangle[k]);
            *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                places.push((places[a as usize] + places[b as usize]).normalize());
                places.len() as u32 - 1
            })
        });
        let [a, b, c] = triangle;
        quads.extend([[a, x, centre, z], [b, y, centre, x], [c, z, centre, y]]);
    }
    (quads, places)
}
