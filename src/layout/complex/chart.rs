//! Plane pictures of parts of a layout, large enough for the triangles around one node.
//!
//! ```text
//!   one quad       two quads at an edge, sheared       the quads around a vertex, as rhombi
//!  +------+           +------+                               \  |  /
//!  |      |          /      /   (t + q g/2, q)              --\-*-/--     corner k between the angles
//!  |      |         +------+                                   / \        k a and (k + 1) a, area 1
//!  +------+          \      \   (1 - t + q g/2, -q)           /   \
//!                     +------+
//! ```
//! g is what the quads' edge function is where the node lies, from 2 cos a of the one vertex to that of the other: the
//! pictures of edge and vertex then agree.

use crate::layout::{Layout, Place, Sector, Side};
use crate::linalg::shares;
use glam::DVec2;
use std::f64::consts::TAU;

/// A plane picture of some quads.
#[derive(Debug, Clone, Copy)]
pub(super) enum Chart<'a> {
    /// One quad; places just outside are looked for across its edges.
    Quad(u32),
    /// The two sides of an edge.
    Edge { sides: [Side; 2], shear: f64 },
    /// The quads around a vertex.
    Vertex(&'a Sector),
}

impl<'a> Chart<'a> {
    /// A picture with `place` and the places in these quads; none if the quads are too far apart.
    pub(super) fn around(layout: &'a Layout, place: Place, quads: impl Iterator<Item = u32> + Clone) -> Self {
        let others = quads.filter(|&quad| quad != place.quad);
        let Some(other) = others.clone().next() else { return Self::Quad(place.quad) };
        if others.clone().all(|quad| quad == other) {
            let mut sides = (0..4).map(|side| Side { quad: place.quad, side });
            let mut common = sides.by_ref().filter(|&side| meets(layout, side, other));
            if let (Some(side), None) = (common.next(), common.next()) {
                return Self::edge(layout, side, place).unwrap_or(Self::Quad(place.quad));
            }
        }
        // the nearest vertex whose quads they all are; if there is none the nearest
        let sees_all = |sector: &Sector| {
            others.clone().all(|quad| sector.corners.iter().any(|corner| corner.quad == quad))
        };
        let nearest = nearest_corners(place);
        let sectors = nearest.map(|corner| layout.sector_at(corner));
        Self::Vertex(sectors.into_iter().find(|sector| sees_all(sector)).unwrap_or(sectors[0]))
    }

    /// The pictures of the vertices of the quad of a place, the nearest first.
    pub(super) fn of_vertices(layout: &'a Layout, place: Place) -> [Self; 4] {
        nearest_corners(place).map(|corner| Self::Vertex(layout.sector_at(corner)))
    }

    fn edge(layout: &Layout, side: Side, place: Place) -> Option<Self> {
        let other = layout.opposite(side)?;
        let [t, _] = side.coordinates(place.uv);
        let [from, to] = [side, side.next()].map(|corner| layout.sector_at(corner).balance());
        Some(Self::Edge { sides: [side, other], shear: 0.5 * (from * (1.0 - t) - to * t) })
    }

    /// Where a place is in the picture; none if it is not in it.
    pub(super) fn picture(&self, place: Place) -> Option<DVec2> {
        match *self {
            Self::Quad(quad) => (place.quad == quad).then_some(place.uv),
            Self::Edge { sides: [near, far], shear } => {
                if place.quad == near.quad {
                    let [t, q] = near.coordinates(place.uv);
                    Some(DVec2::new(t + q * shear, q))
                } else {
                    let [t, q] = far.coordinates(place.uv);
                    (place.quad == far.quad).then_some(DVec2::new(1.0 - t + q * shear, -q))
                }
            }
            Self::Vertex(sector) => {
                let k = sector.corners.iter().position(|corner| corner.quad == place.quad)?;
                let [along, across] = sector.corners[k].coordinates(place.uv);
                let [first, second] = rays(sector, k);
                Some(along * first + across * second)
            }
        }
    }

    /// The place at a point of the picture; none if nothing is there.
    pub(super) fn place(&self, layout: &Layout, point: DVec2) -> Option<Place> {
        match *self {
            Self::Quad(quad) => inside(Place { quad, uv: point }).or_else(|| across(layout, quad, point)),
            Self::Edge { sides: [near, far], shear } => {
                let t = point.x - point.y.abs() * shear;
                inside(if point.y >= 0.0 { near.place(t, point.y) } else { far.place(1.0 - t, -point.y) })
            }
            Self::Vertex(sector) => {
                let angle = point.y.atan2(point.x).rem_euclid(TAU);
                let k = (angle / sector.corner_angle()) as usize;
                if k >= sector.valence() && sector.is_open() {
                    return None;
                }
                let k = k.min(sector.valence() - 1);
                let [first, second] = rays(sector, k);
                let [along, across] = shares(point, first, second).to_array();
                inside(sector.corners[k].place(along.max(0.0), across.max(0.0)))
            }
        }
    }
}

/// The corners of the quad of a place, the nearest first.
fn nearest_corners(place: Place) -> [Side; 4] {
    let [right, high] = [place.uv.x > 0.5, place.uv.y > 0.5];
    let first = match (right, high) {
        (false, false) => 0,
        (true, false) => 1,
        (true, true) => 2,
        (false, true) => 3,
    };
    // how far the place is from the middle of both sides says which of the two neighbouring corners comes next
    let [along_u, along_v] = (place.uv - 0.5).abs().to_array();
    let is_u_first = along_u < along_v;
    let (beside_u, beside_v) = (first ^ 1, 3 - first);
    let order = if is_u_first { [first, beside_u, beside_v] } else { [first, beside_v, beside_u] };
    [order[0], order[1], order[2], (first + 2) % 4].map(|side| Side { quad: place.quad, side })
}

fn meets(layout: &Layout, side: Side, quad: u32) -> bool {
    layout.opposite(side).is_some_and(|opposite| opposite.quad == quad)
}

/// The edges of a corner in the picture of its vertex, of a rhombus of area 1.
fn rays(sector: &Sector, k: usize) -> [DVec2; 2] {
    let angle = sector.corner_angle();
    let length = angle.sin().abs().sqrt().recip();
    [k, k + 1].map(|k| length * DVec2::from_angle(k as f64 * angle))
}

fn inside(place: Place) -> Option<Place> {
    (place.uv.cmpge(DVec2::ZERO).all() && place.uv.cmple(DVec2::ONE).all()).then_some(place)
}

/// Beyond one side of a quad, in the neighbour; nothing is beyond a border.
fn across(layout: &Layout, quad: u32, point: DVec2) -> Option<Place> {
    let out = [point.y < 0.0, point.x > 1.0, point.y > 1.0, point.x < 0.0];
    let side = Side { quad, side: out.iter().position(|&out| out)? as u8 };
    let [t, q] = side.coordinates(point);
    inside(layout.opposite(side)?.place(1.0 - t, -q))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::Random;

    #[test]
    fn pictures_and_places_invert_each_other() {
        let layout = Layout::cube();
        let mut random = Random::new(1);
        for _ in 0..2000 {
            let quad = (6.0 * random.unit()) as u32;
            let place = Place { quad, uv: DVec2::new(random.unit(), random.unit()) };
            let side = Side { quad, side: (4.0 * random.unit()) as u8 };
            let other = layout.opposite(side).unwrap();
            let corners = layout.sector_at(side).corners.iter().map(|corner| corner.quad);
            let charts = [
                Chart::around(&layout, place, [quad].into_iter()),
                Chart::around(&layout, place, [quad, other.quad].into_iter()),
                Chart::around(&layout, place, corners.collect::<Vec<_>>().into_iter()),
            ];
            for chart in charts {
                let Some(point) = chart.picture(place) else { panic!("{chart:?} has its own place") };
                let back = chart.place(&layout, point).unwrap();
                // on a common edge either quad may be the answer
                let same = chart.picture(back).unwrap();
                assert!(same.distance(point) <= 16.0 * f64::EPSILON, "{chart:?} {place:?} {back:?}");
            }
        }
    }

    #[test]
    fn the_pictures_of_an_edge_meet_in_it() {
        let layout = Layout::cube();
        let side = Side { quad: 0, side: 1 };
        let other = layout.opposite(side).unwrap();
        let place = side.place(0.3, 0.1);
        let chart = Chart::around(&layout, place, [0, other.quad].into_iter());
        let [near, far] = [side.place(0.7, 0.0), other.place(0.3, 0.0)].map(|p| chart.picture(p).unwrap());
        assert!(near.distance(far) <= 4.0 * f64::EPSILON);
        // positive areas on both sides
        let [a, b] = [side.place(0.2, 0.0), side.place(0.8, 0.0)].map(|p| chart.picture(p).unwrap());
        let [up, down] = [side.place(0.5, 0.5), other.place(0.5, 0.5)].map(|p| chart.picture(p).unwrap());
        assert!((b - a).perp_dot(up - a) > 0.0 && (b - a).perp_dot(down - a) < 0.0);
    }
}
