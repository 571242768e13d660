//! Trims as bounds of a face: one outer loop counter-clockwise in (u,v), holes clockwise, none touching another.

use crate::geometry::{Domain, Orientation, orientation};
use crate::model::{ModelError, corners};
use crate::surface::{Surface, Trims};
use glam::DVec2;
use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation, mitigate_underflow};

type Loop = Vec<DVec2>;

/// The bounds of the part of a surface that counts, the outer one first; the border of the domain if there are
/// no trims. Material lies to the left of each.
pub(super) fn bounds(surface: &dyn Surface) -> Result<Vec<Loop>, ModelError> {
    let trims = &surface.region().trims;
    if trims.is_empty() {
        return Ok(vec![corners(&surface.domain()).to_vec()]);
    }
    let loops = without_repeats(trims)?;
    check_apart(&loops)?;
    let depths = depths(&loops);
    let outer: Vec<usize> = (0..loops.len()).filter(|&k| depths[k].is_multiple_of(2)).collect();
    let [outer] = outer[..] else { return Err(ModelError::Pieces { count: outer.len() }) };
    let order = std::iter::once(outer).chain((0..loops.len()).filter(|&k| k != outer));
    Ok(order.map(|k| directed(loops[k].clone(), k == outer)).collect())
}

/// The loops without points that repeat the one before.
fn without_repeats(trims: &Trims) -> Result<Vec<Loop>, ModelError> {
    let clean = |(index, polyline): (usize, &Loop)| {
        let mut points = polyline.clone();
        points.dedup();
        while points.len() > 1 && points.last() == points.first() {
            points.pop();
        }
        if points.len() < 3 { Err(ModelError::Empty { index }) } else { Ok(points) }
    };
    trims.loops().iter().enumerate().map(clean).collect()
}

/// Refuses loops that cross or touch each other or themselves: in a triangulation that has all their sides no
/// two sides meet, and no corner is met twice.
fn check_apart(loops: &[Loop]) -> Result<(), ModelError> {
    let mut plane = ConstrainedDelaunayTriangulation::<Point2<f64>>::new();
    let mut corners: Vec<Vec<FixedVertexHandle>> = Vec::with_capacity(loops.len());
    let fail = |index, uv: DVec2| ModelError::Crossing { index, u: uv.x, v: uv.y };
    for (index, polyline) in loops.iter().enumerate() {
        let mut vertices = Vec::with_capacity(polyline.len());
        for &uv in polyline {
            let count = plane.num_vertices();
            let place = mitigate_underflow(Point2::new(uv.x, uv.y));
            let vertex = plane.insert(place).map_err(|_| fail(index, uv))?;
            if plane.num_vertices() == count {
                return Err(fail(index, uv));
            }
            vertices.push(vertex);
        }
        corners.push(vertices);
    }
    for (index, vertices) in corners.iter().enumerate() {
        for (k, &from) in vertices.iter().enumerate() {
            let to = vertices[(k + 1) % vertices.len()];
            let is_apart = plane.can_add_constraint(from, to) && {
                plane.add_constraint(from, to);
                plane.get_edge_from_neighbors(from, to).is_some_and(|edge| edge.is_constraint_edge())
            };
            if !is_apart {
                return Err(fail(index, loops[index][k]));
            }
        }
    }
    Ok(())
}

/// How many other loops each loop lies in.
fn depths(loops: &[Loop]) -> Vec<usize> {
    let boxes: Vec<_> = loops.iter().map(|polyline| Domain::around(polyline.iter().copied())).collect();
    let lies_in = |k: usize, other: usize| {
        k != other && boxes[other].contains(loops[k][0]) && contains(&loops[other], loops[k][0])
    };
    (0..loops.len()).map(|k| (0..loops.len()).filter(|&other| lies_in(k, other)).count()).collect()
}

/// Whether a ray from `p` towards larger u crosses a loop an odd number of times. Exact.
pub(super) fn contains(polyline: &[DVec2], p: DVec2) -> bool {
    let crosses = |(a, b): (&DVec2, &DVec2)| match (a.y <= p.y, b.y <= p.y) {
        (true, false) => orientation(*a, *b, p) == Orientation::Positive,
        (false, true) => orientation(*a, *b, p) == Orientation::Negative,
        _ => false,
    };
    polyline.iter().zip(polyline.iter().cycle().skip(1)).filter(|&side| crosses(side)).count() % 2 == 1
}

/// A loop counter-clockwise or clockwise. The turn at its least point is that of the whole: the loop does not
/// touch itself.
fn directed(mut polyline: Loop, counter_clockwise: bool) -> Loop {
    let count = polyline.len();
    let less = |&a: &usize, &b: &usize| {
        let (a, b) = (polyline[a], polyline[b]);
        a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y))
    };
    let least = (0..count).min_by(less).unwrap_or(0);
    let turn =
        orientation(polyline[(least + count - 1) % count], polyline[least], polyline[(least + 1) % count]);
    if (turn == Orientation::Positive) != counter_clockwise {
        polyline.reverse();
    }
    polyline
}
