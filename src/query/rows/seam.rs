//! A line along the gradient, on which all rows start.
//!
//! In a triangle the gradient of the field is constant: the line runs straight from side to side. Where it would turn
//! back over the side it has come through, on a ridge or in a valley, it follows that side to its higher node.

use crate::memory;
use crate::mesh::{HalfEdge, Mesh};
use glam::DVec3;

/// Where a seam has got to.
#[derive(Debug, Clone, Copy)]
enum Place {
    Node(u32),
    /// On a side of the triangle to be crossed next.
    Side(HalfEdge, DVec3),
}

/// A line along the gradient from a node of the first source to the second, with the field on it, which rises.
pub(super) fn seam(mesh: &Mesh, field: &[f64], start: u32) -> Vec<(f64, DVec3)> {
    let mut line = vec![(field[start as usize], mesh.points()[start as usize])];
    let mut place = Place::Node(start);
    // the field rises with each step, so that the line ends; rounding may let it stand
    while let Some((value, point, next)) = ascend(mesh, field, place) {
        if value <= line[line.len() - 1].0 {
            let Place::Side(edge, _) = place else { break };
            // it stands on a side: on to its higher end
            let ends = [edge.origin(mesh.triangles()), edge.target(mesh.triangles())];
            let higher = if field[ends[0] as usize] > field[ends[1] as usize] { ends[0] } else { ends[1] };
            if field[higher as usize] <= line[line.len() - 1].0 {
                break;
            }
            memory::push(&mut line, (field[higher as usize], mesh.points()[higher as usize]));
            place = Place::Node(higher);
            continue;
        }
        memory::push(&mut line, (value, point));
        place = next;
    }
    line
}

/// The next place along the gradient, with the field and the point there; None at the second source.
fn ascend(mesh: &Mesh, field: &[f64], place: Place) -> Option<(f64, DVec3, Place)> {
    let value = |node: u32| field[node as usize];
    let at_node = |node: u32| (value(node), mesh.points()[node as usize], Place::Node(node));
    match place {
        Place::Side(edge, point) => {
            let ends = [edge.origin(mesh.triangles()), edge.target(mesh.triangles())];
            let higher = if value(ends[0]) > value(ends[1]) { ends[0] } else { ends[1] };
            let across = [edge.next(), edge.previous()].into_iter();
            Some(across.filter_map(|side| leave(mesh, field, point, side)).next().unwrap_or(at_node(higher)))
        }
        Place::Node(node) => {
            let point = mesh.points()[node as usize];
            let through = mesh.outgoing(node).filter_map(|edge| {
                let slope = gradient(mesh, field, edge.triangle()).length();
                leave(mesh, field, point, edge.next()).map(|step| (slope, step))
            });
            let along = mesh.neighbours(node).filter(|&other| value(other) > value(node)).map(|other| {
                let slope = (value(other) - value(node)) / mesh.points()[other as usize].distance(point);
                (slope, at_node(other))
            });
            let steepest = through.chain(along).max_by(|a, b| a.0.total_cmp(&b.0));
            steepest.map(|(_, step)| step)
        }
    }
}

/// Of the field in a triangle; zero where that has no area.
fn gradient(mesh: &Mesh, field: &[f64], triangle: usize) -> DVec3 {
    let nodes = mesh.triangles()[triangle];
    let [a, b, c] = nodes.map(|node| mesh.points()[node as usize]);
    let [fa, fb, fc] = nodes.map(|node| field[node as usize]);
    let normal = (b - a).cross(c - a);
    let size = normal.length_squared();
    if size == 0.0 {
        return DVec3::ZERO;
    }
    normal.cross((c - b) * fa + (a - c) * fb + (b - a) * fc) / size
}

/// Where a line along the gradient from `point` on the rim of a triangle leaves it through `side`, if it does.
fn leave(mesh: &Mesh, field: &[f64], point: DVec3, side: HalfEdge) -> Option<(f64, DVec3, Place)> {
    let triangles = mesh.triangles();
    let [from, to] = [side.origin(triangles), side.target(triangles)];
    let [a, b] = [from, to].map(|node| mesh.points()[node as usize]);
    let gradient = gradient(mesh, field, side.triangle());
    let along = b - a;
    // point + s gradient = a + x along, in the triangle's plane
    let normal = gradient.cross(along);
    let size = normal.length_squared();
    let s = (a - point).cross(along).dot(normal) / size;
    let x = (a - point).cross(gradient).dot(normal) / size;
    if !(s > 0.0 && (0.0..=1.0).contains(&x)) {
        return None;
    }
    let value = field[from as usize] + x * (field[to as usize] - field[from as usize]);
    let next = match mesh.topology().twin(side) {
        Some(twin) => Place::Side(twin, a + x * along),
        None => Place::Node(if field[from as usize] > field[to as usize] { from } else { to }),
    };
    Some((value, a + x * along, next))
}

/// Where the seam has a level.
pub(super) fn seam_point(seam: &[(f64, DVec3)], level: f64) -> DVec3 {
    let k = seam.partition_point(|&(value, _)| value < level).clamp(1, seam.len().max(2) - 1);
    let Some(&(to, b)) = seam.get(k) else { return seam[0].1 };
    let (from, a) = seam[k - 1];
    a.lerp(b, ((level - from) / (to - from)).clamp(0.0, 1.0))
}
