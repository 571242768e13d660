//! The loops of a face as polygons in the plane of its parameters.

use super::nodes::Nodes;
use crate::model::{Carrier, FaceId, Loop, Model, Use};
use glam::DVec2;
use std::f64::consts::{PI, TAU};

/// A closed polygon of places and nodes.
pub(super) type Polygon = Vec<(DVec2, u32)>;

/// The loops of a face as polygons.
pub(super) fn polygons(model: &Model, face: FaceId, nodes: &Nodes) -> Vec<Polygon> {
    let carrier = model.carrier(face);
    let polygon = |(bound, coedges): (usize, &Loop)| {
        let mut polygon = Polygon::new();
        for (place, coedge) in coedges.iter().enumerate() {
            let (parameters, along) = &nodes.edges[coedge.edge.index()];
            let mut places = model.places(Use { face, bound, place }, parameters);
            let mut along = along.clone();
            if !coedge.is_forward {
                places.reverse();
                along.reverse();
            }
            carrier.go_on(polygon.last().map(|&(uv, _)| uv), &mut places);
            polygon.extend(places.into_iter().zip(along));
        }
        // an edge begins where the one before ends: at the same place, but at a pole or seam
        polygon.dedup_by(|next, before| is_same(next, before));
        polygon
    };
    let polygons: Vec<Polygon> = model.face(face).bounds.iter().enumerate().map(polygon).collect();
    let (open, mut closed): (Vec<Polygon>, Vec<Polygon>) =
        polygons.into_iter().partition(|polygon| winds(carrier, polygon));
    if let [a, b] = open.as_slice() {
        closed.insert(0, joined(a, b));
    } else {
        closed.extend(open);
    }
    carrier.align_holes(&mut closed, |(uv, _)| uv);
    for polygon in &mut closed {
        while polygon.len() > 1 && is_same(&polygon[0], &polygon[polygon.len() - 1]) {
            polygon.pop();
        }
    }
    closed
}

/// Places of one node that differ by less than this share of their size are one: they come from two p-curves.
const SAME: f64 = 1e-12;

fn is_same(a: &(DVec2, u32), b: &(DVec2, u32)) -> bool {
    a.1 == b.1 && a.0.distance(b.0) <= SAME * a.0.abs().max_element().max(1.0)
}

/// Whether a loop goes round a cylinder, so that it ends a whole turn from where it begins.
fn winds(carrier: &Carrier, polygon: &[(DVec2, u32)]) -> bool {
    matches!(carrier, Carrier::Cylinder(_))
        && polygon.first().zip(polygon.last()).is_some_and(|(first, last)| (last.0.x - first.0.x).abs() > PI)
}

/// Two loops round a cylinder as one polygon, cut open along a line between them.
/// ```text
/// b begins  <------  b ends      The line on the left and that on the right are one in space: their ends are the
///      |                ^        same nodes.
/// a begins  ------>  a ends
/// ```
fn joined(a: &[(DVec2, u32)], b: &[(DVec2, u32)]) -> Polygon {
    let (start, end) = (a[0].0.x, a[a.len() - 1].0.x);
    // b without its repeated end, turned round to begin as near as it can to where a ends
    let mut ring = b[..b.len() - 1].to_vec();
    let turn = TAU.copysign(end - start);
    let off = |&k: &usize| ((ring[k].0.x - end) / TAU - ((ring[k].0.x - end) / TAU).round()).abs();
    let first = (0..ring.len()).min_by(|i, j| off(i).total_cmp(&off(j))).unwrap_or(0);
    for (uv, _) in &mut ring[..first] {
        uv.x -= turn;
    }
    ring.rotate_left(first);
    let shift = TAU * ((end - ring[0].0.x) / TAU).round();
    ring.iter_mut().for_each(|(uv, _)| uv.x += shift);
    let (uv, node) = ring[0];
    ring.push((uv - DVec2::new(turn, 0.0), node));
    a.iter().copied().chain(ring).collect()
}
