//! The border of an open mesh, on its way to the border of a layout.
//!
//! ```text
//!   b --- a         A cone over each loop closes the mesh; its triangles are a void that gets no quads. Nodes of the
//!    \   /          border collapse along it only, corners stay, and where patches will have two or three corners at a
//!     tip           node of the border, as many triangles must be left.
//! ```

use crate::mesh::{Mesh, MeshError, close_loop};
use glam::DVec3;
use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_4, PI};

/// A border turns over this part of its length, so that jags are no corners.
const WINDOW: f64 = 0.02;
/// More than this is a corner.
const LEAST_TURN: f64 = FRAC_PI_4;
/// Up to these angles one and two patches meet in a corner.
const MOST_ANGLES: [f64; 2] = [150.0 / 180.0 * PI, 300.0 / 180.0 * PI];

/// Quads at a node of the border that is no corner.
const STRAIGHT_NEED: u32 = 2;

/// A place on a loop of the border.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Along {
    /// The loop.
    pub index: usize,
    /// The length from the loop's first node.
    pub length: f64,
}

/// What holds of a node of the border.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct BorderNode {
    pub along: Along,
    /// The nodes before and after it, the surface on the left.
    pub neighbours: [u32; 2],
    pub is_corner: bool,
    /// Quads that must meet there.
    pub need: u32,
}

/// The loops of a mesh, and the mesh without them.
#[derive(Debug, Clone)]
pub(super) struct Border {
    /// The mesh closed by cones.
    pub closed: Mesh,
    /// Nodes from this on are tips of cones.
    pub first_tip: u32,
    /// By node.
    pub nodes: Vec<Option<BorderNode>>,
    /// The length of each loop.
    pub lengths: Vec<f64>,
}

impl Border {
    pub(super) fn new(mesh: &Mesh) -> Result<Self, MeshError> {
        let mut border = Self::closed(mesh)?;
        for (index, nodes) in mesh.loops().iter().enumerate() {
            border.add_loop(mesh, index, nodes);
        }
        Ok(border)
    }

    /// With these nodes as corners and no others, and the quads that each of them needs.
    pub(super) fn with_corners(mesh: &Mesh, needs: &BTreeMap<u32, u32>) -> Result<Self, MeshError> {
        let mut border = Self::new(mesh)?;
        for (node, found) in (0..).zip(&mut border.nodes) {
            if let Some(found) = found {
                found.is_corner = needs.contains_key(&node);
                found.need = needs.get(&node).copied().unwrap_or(STRAIGHT_NEED);
            }
        }
        Ok(border)
    }

    /// The mesh closed by cones, without what is known of its border.
    fn closed(mesh: &Mesh) -> Result<Self, MeshError> {
        let first_tip = mesh.points().len() as u32;
        let (mut points, mut triangles) = (mesh.points().to_vec(), mesh.triangles().to_vec());
        mesh.loops().iter().for_each(|nodes| close_loop(nodes, &mut points, &mut triangles));
        Ok(Self {
            nodes: vec![None; points.len()],
            lengths: Vec::new(),
            closed: Mesh::new(points, triangles)?,
            first_tip,
        })
    }

    /// Nodes that collapses keep on every loop: its corners, and three at least.
    pub(super) fn least_nodes(&self) -> usize {
        let corners = |index: usize| {
            let of_loop = self.nodes.iter().flatten().filter(|node| node.along.index == index);
            of_loop.filter(|node| node.is_corner).count()
        };
        (0..self.lengths.len()).map(|index| corners(index).max(4)).sum()
    }

    /// The area of the mesh.
    pub(super) fn area(&self) -> f64 {
        let surface = self.closed.triangles().iter().filter(|t| !t.iter().any(|&node| self.is_tip(node)));
        let area = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|node| self.closed.points()[node as usize]);
            0.5 * (b - a).cross(c - a).length()
        };
        surface.map(area).sum()
    }

    pub(super) fn is_tip(&self, node: u32) -> bool {
        node >= self.first_tip
    }

    pub(super) fn node(&self, node: u32) -> Option<&BorderNode> {
        self.nodes[node as usize].as_ref()
    }

    fn add_loop(&mut self, mesh: &Mesh, index: usize, nodes: &[u32]) {
        let line = Line::new(nodes.iter().map(|&node| mesh.points()[node as usize]).collect());
        let turns: Vec<f64> = (0..nodes.len()).map(|k| line.turn(k)).collect();
        let window = WINDOW * line.length();
        let count = nodes.len();
        for (k, &node) in nodes.iter().enumerate() {
            // the sharpest node within the window, and of equal ones the first
            let is_near = |j: &usize| line.distance(*j, k) < window;
            let after = (1..count).map(|step| (k + step) % count).take_while(is_near);
            let before = (1..count).map(|step| (k + count - step) % count).take_while(is_near);
            let is_blunter = |j: usize| turns[j] < turns[k] || (turns[j] == turns[k] && j > k);
            let is_corner = turns[k] > LEAST_TURN && after.chain(before).all(is_blunter);
            let angle = inner_angle(mesh, node);
            let need = 1 + MOST_ANGLES.iter().filter(|&&most| angle > most).count() as u32;
            self.nodes[node as usize] = Some(BorderNode {
                along: Along { index, length: line.starts[k] },
                neighbours: [nodes[(k + count - 1) % count], nodes[(k + 1) % count]],
                is_corner,
                need: if is_corner { need } else { STRAIGHT_NEED },
            });
        }
        self.lengths.push(line.length());
    }
}

/// The angles of the triangles at a node.
pub(in crate::layout) fn inner_angle(mesh: &Mesh, node: u32) -> f64 {
    let angle = |triangle: usize| {
        let [a, b, c] = mesh.triangles()[triangle];
        let others = if node == a {
            [b, c]
        } else if node == b {
            [c, a]
        } else {
            [a, b]
        };
        let [p, q] = others.map(|other| mesh.points()[other as usize] - mesh.points()[node as usize]);
        p.cross(q).length().atan2(p.dot(q))
    };
    mesh.outgoing(node).map(|edge| angle(edge.triangle())).sum()
}

/// A closed polyline.
struct Line {
    points: Vec<DVec3>,
    /// The length up to each point, and of all.
    starts: Vec<f64>,
}

impl Line {
    fn new(points: Vec<DVec3>) -> Self {
        let mut starts = vec![0.0];
        for k in 0..points.len() {
            starts.push(starts[k] + points[k].distance(points[(k + 1) % points.len()]));
        }
        Self { points, starts }
    }

    fn length(&self) -> f64 {
        self.starts[self.points.len()]
    }

    /// The distance of two points along the line, the shorter way.
    fn distance(&self, j: usize, k: usize) -> f64 {
        let direct = (self.starts[j] - self.starts[k]).abs();
        direct.min(self.length() - direct)
    }

    fn at(&self, length: f64) -> DVec3 {
        let length = length.rem_euclid(self.length());
        let k = self.starts.partition_point(|&start| start <= length).clamp(1, self.points.len()) - 1;
        let share = (length - self.starts[k]) / (self.starts[k + 1] - self.starts[k]);
        self.points[k]
            .lerp(self.points[(k + 1) % self.points.len()], if share.is_finite() { share } else { 0.0 })
    }

    /// The angle by which the line turns over the window around a point.
    fn turn(&self, k: usize) -> f64 {
        let count = self.points.len();
        let beside = (self.starts[k + 1] - self.starts[k])
            .max(self.starts[(k + count - 1) % count + 1] - self.starts[(k + count - 1) % count]);
        let window = (WINDOW * self.length()).max(beside);
        let here = self.points[k];
        let before = here - self.at(self.starts[k] - window);
        let after = self.at(self.starts[k] + window) - here;
        before.cross(after).length().atan2(before.dot(after))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples;

    #[test]
    fn a_notched_plate_has_its_corners() {
        let mesh = samples::planar(1).unwrap();
        let border = Border::new(&mesh).unwrap();
        assert!(border.closed.loops().is_empty());
        assert_eq!(border.closed.points().len(), mesh.points().len() + 3);
        let corners = |index: usize| {
            let of_loop = border.nodes.iter().flatten().filter(|node| node.along.index == index);
            of_loop.filter(|node| node.is_corner).count()
        };
        // three of the rectangle and four of the notch; the cut off corner turns twice by half a right angle
        assert_eq!(corners(0), 7);
        for node in border.nodes.iter().flatten() {
            assert!((1..=3).contains(&node.need) && node.along.length < border.lengths[node.along.index]);
        }
    }
}
