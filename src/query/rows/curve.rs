//! Level curves, and points along them.

use super::half_edges;
use crate::memory::{self, CollectVec};
use crate::mesh::{HalfEdge, Mesh};
use glam::DVec3;

/// The curve of a level, with lower values on its left; or how many closed and open curves there are instead.
pub(super) fn level_curve(mesh: &Mesh, field: &[f64], level: f64) -> Result<Vec<DVec3>, (usize, usize)> {
    let triangles = mesh.triangles();
    let is_low = |node: u32| field[node as usize] < level;
    let mut rising: Vec<HalfEdge> = half_edges(mesh)
        .filter(|&(_, [from, to])| is_low(from) && !is_low(to))
        .map(|(edge, _)| edge)
        .collect_vec();
    // a triangle that the level crosses has one side that rises to it and one that falls
    let falling = |mut edge: HalfEdge| {
        while is_low(edge.origin(triangles)) || !is_low(edge.target(triangles)) {
            edge = edge.next();
        }
        edge
    };
    let mut is_seen = memory::filled(false, triangles.len());
    // curves that end at the boundary begin there: they are walked first
    rising.sort_by_key(|&edge| mesh.topology().twin(edge).is_some());
    let (mut curve, mut closed, mut open) = (Vec::new(), 0, 0);
    for start in rising {
        if is_seen[start.triangle()] {
            continue;
        }
        let mut edge = start;
        let mut points = Vec::new();
        let is_closed = loop {
            is_seen[edge.triangle()] = true;
            memory::push(&mut points, crossing(mesh, field, level, edge));
            match mesh.topology().twin(falling(edge)) {
                None => break false,
                Some(next) if next == start => break true,
                Some(next) => edge = next,
            }
        };
        (closed, open) = if is_closed { (closed + 1, open) } else { (closed, open + 1) };
        curve = points;
    }
    if (closed, open) == (1, 0) { Ok(curve) } else { Err((closed, open)) }
}

/// Where the level crosses a half-edge.
fn crossing(mesh: &Mesh, field: &[f64], level: f64, edge: HalfEdge) -> DVec3 {
    let [a, b] = [edge.origin(mesh.triangles()), edge.target(mesh.triangles())].map(|node| node as usize);
    let share = (level - field[a]) / (field[b] - field[a]);
    mesh.points()[a].lerp(mesh.points()[b], share.clamp(0.0, 1.0))
}

/// Fewest points of a row: enough for a round one to be recognized.
const LEAST_POINTS: usize = 8;

/// Points about `spacing` apart along a closed polyline, evenly, the first of them next to `start`.
pub(super) fn resample(curve: &[DVec3], start: DVec3, spacing: f64) -> Vec<DVec3> {
    let sides = || curve.iter().copied().zip(curve.iter().copied().cycle().skip(1));
    let mut ends = vec![0.0];
    sides().for_each(|(a, b)| ends.push(ends[ends.len() - 1] + a.distance(b)));
    let whole = ends[curve.len()];
    let nearest = sides().enumerate().map(|(k, (a, b))| {
        let along = b - a;
        let x = ((start - a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
        let x = if x.is_nan() { 0.0 } else { x };
        (a.lerp(b, x).distance(start), ends[k] + x * (ends[k + 1] - ends[k]))
    });
    let first = nearest.min_by(|a, b| a.0.total_cmp(&b.0)).map_or(0.0, |(_, at)| at);
    let count = ((whole / spacing).round() as usize).max(LEAST_POINTS);
    let point = |k: usize| {
        let at = (first + whole * k as f64 / count as f64) % whole;
        let side = ends.partition_point(|&end| end <= at).clamp(1, curve.len()) - 1;
        let length = ends[side + 1] - ends[side];
        let x = if length > 0.0 { (at - ends[side]) / length } else { 0.0 };
        curve[side].lerp(curve[(side + 1) % curve.len()], x)
    };
    (0..count).map(point).collect_vec()
}
