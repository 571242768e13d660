//! Exact fractions, identities, creases.

mod creases;
mod functions;
mod surfaces;

use super::*;
use crate::samples::{Random, grid};
use crate::surface::Surface;
use glam::DVec3;

/// A grid of n by n nodes, one apart, all diagonals falling.
fn three_directional(n: usize) -> (Vec<DVec2>, Vec<[u32; 3]>) {
    let uv = (0..n * n).map(|k| DVec2::new((k / n) as f64, (k % n) as f64)).collect();
    let mut triangles = Vec::new();
    for k in (0..n * n).filter(|k| k / n + 1 < n && k % n + 1 < n) {
        let [p, q, r, s] = [k, k + n, k + n + 1, k + 1].map(|k| k as u32);
        triangles.extend([[p, q, s], [q, r, s]]);
    }
    (uv, triangles)
}

fn space(
    uv: &[DVec2],
    triangles: &[[u32; 3]],
    options: D1rcOptions,
    sharp: &[[u32; 2]],
) -> Result<Space, D1rcError> {
    let (uv, triangles) = (uv.to_vec(), triangles.to_vec());
    Space::new(Recipe { uv, triangles, options, sharp_edges: sharp.to_vec(), corners: Vec::new() })
}

/// Name, places, faces.
type NamedMesh = (&'static str, Vec<DVec2>, Vec<[u32; 3]>);

/// Parameter meshes of all sorts.
fn meshes() -> Vec<NamedMesh> {
    let (moved, flipped) = grid([9, 8], 0.3, 3, |_| true);
    let (even, turned) = grid([8, 8], 0.0, 5, |_| true);
    let squeezed = moved.iter().map(|p| DVec2::from_angle(0.4).rotate(DVec2::new(p.x, p.y / 20.0))).collect();
    let (far, holed) = grid([10, 10], 0.2, 9, |p| (p - 0.5).length() > 0.2);
    let used: Vec<DVec2> = far.iter().map(|p| 1e3 + 7.0 * p).collect();
    let (uv, triangles) = three_directional(7);
    let (holed_uv, holed) = compact(&used, &holed);
    vec![
        ("moved", moved, flipped.clone()),
        ("even", even, turned),
        ("squeezed", squeezed, flipped),
        ("three directions", uv, triangles),
        ("holed, far away", holed_uv, holed),
    ]
}

/// Without the nodes that no triangle uses.
fn compact(uv: &[DVec2], triangles: &[[u32; 3]]) -> (Vec<DVec2>, Vec<[u32; 3]>) {
    let mut used: Vec<u32> = triangles.iter().flatten().copied().collect();
    used.sort_unstable();
    used.dedup();
    let new = |node: u32| used.binary_search(&node).unwrap() as u32;
    (used.iter().map(|&node| uv[node as usize]).collect(), triangles.iter().map(|t| t.map(new)).collect())
}

/// Random points of all faces, their corners, and the middles of their sides.
fn sample(uv: &[DVec2], triangles: &[[u32; 3]]) -> Vec<DVec2> {
    let mut random = Random::new(2);
    let mut all = Vec::new();
    for triangle in triangles {
        let [a, b, c] = triangle.map(|v| uv[v as usize]);
        all.extend([a, (a + b) / 2.0, (b + c) / 2.0]);
        let (s, t) = (random.unit(), random.unit());
        let (s, t) = if s + t > 1.0 { (1.0 - s, 1.0 - t) } else { (s, t) };
        all.push(a + s * (b - a) + t * (c - a));
    }
    all
}

/// A mesh of the square [-1, 1]^2 without symmetries, whose column `u = 0` (nodes of the middle) may be bent.
fn folded(n: usize, bend: f64) -> (Vec<DVec2>, Vec<[u32; 3]>, Vec<u32>) {
    let mut random = Random::new(17);
    let (places, triangles) = grid([n, n], 0.0, 4, |_| true);
    let middle = n / 2;
    let uv = places.iter().enumerate().map(|(k, p)| {
        let (i, j) = (k / n, k % n);
        let is_inner = (1..n - 1).contains(&i) && (1..n - 1).contains(&j) && i != middle;
        let jitter = if is_inner { 0.2 / n as f64 } else { 0.0 };
        let moved = 2.0 * *p - 1.0 + jitter * DVec2::new(random.signed(), random.signed());
        let wave = bend * (1.0 - moved.x.abs()) * (2.0 * moved.y + 0.3).sin();
        moved + DVec2::new(wave, 0.0)
    });
    (uv.collect(), triangles, (0..n).map(|j| (middle * n + j) as u32).collect())
}

fn crease_edges(column: &[u32]) -> Vec<[u32; 2]> {
    column.windows(2).map(|pair| [pair[0], pair[1]]).collect()
}

/// A wavy surface over a mesh without symmetries.
fn wavy(options: D1rcOptions, sharp: &[[u32; 2]]) -> D1rcSurface {
    let (uv, triangles, _) = folded(9, 0.1);
    let height = |p: &DVec2| 0.3 * (3.0 * p.x).sin() * (2.0 * p.y + 1.0).cos();
    let points = uv.iter().flat_map(|p| [p.x, p.y, height(p)]).collect();
    D1rcSurface::new(space(&uv, &triangles, options, sharp).unwrap(), 3, points).unwrap()
}
