//! Faces of files, and how polygons become triangles.
//!
//! A polygon is seen in its mean plane (the normal after Newell). A strictly convex one becomes a fan around
//! its first corner. Of any other, ears are cut off one by one (G. H. Meisters, "Polygons have ears", Amer.
//! Math. Monthly 82 (1975), 648-651), with exact orientations.

use super::ReadError;
use crate::geometry::{Orientation, orientation};
use glam::{DVec2, DVec3};

/// Ears take cubic time at worst, so a polygon that is not convex may have this many corners.
const MAX_CONCAVE: usize = 2000;

/// Polygons as lists of nodes, one behind the other.
#[derive(Debug, Default)]
pub(super) struct Faces {
    corners: Vec<u32>,
    /// Where each face ends in `corners`.
    ends: Vec<usize>,
}

impl Faces {
    /// Room for `count` triangles; the caller has checked that the file can hold them.
    pub fn reserve(&mut self, count: usize) {
        self.corners.reserve(3 * count);
        self.ends.reserve(count);
    }

    /// Adds a corner to the face that is being read.
    pub fn push(&mut self, node: u32) {
        self.corners.push(node);
    }

    /// Ends a face. One of less than three corners is forgotten: it has no area.
    pub fn end_face(&mut self) {
        let start = self.ends.last().copied().unwrap_or(0);
        match self.corners.len() - start {
            0..3 => self.corners.truncate(start),
            _ => self.ends.push(self.corners.len()),
        }
    }

    /// The nodes of all corners.
    pub fn corners(&self) -> &[u32] {
        &self.corners
    }

    pub fn into_triangles(self, points: &[DVec3]) -> Result<Vec<[u32; 3]>, ReadError> {
        let mut triangles = Vec::with_capacity(self.ends.len());
        let mut start = 0;
        for (face, &end) in self.ends.iter().enumerate() {
            match self.corners[start..end] {
                [a, b, c] => triangles.push([a, b, c]),
                ref polygon => split(polygon, points, face, &mut triangles)?,
            }
            start = end;
        }
        Ok(triangles)
    }
}

/// Appends the triangles of a polygon.
fn split(
    polygon: &[u32],
    points: &[DVec3],
    face: usize,
    triangles: &mut Vec<[u32; 3]>,
) -> Result<(), ReadError> {
    // a corner given twice in a row makes a shorter polygon: finite elements write triangles as such quads
    let mut corners = polygon.to_vec();
    corners.dedup();
    while corners.len() > 3 && corners.first() == corners.last() {
        corners.pop();
    }
    let point = |corner: u32| points[corner as usize];
    if corners.len() <= 3 {
        triangles.push([corners[0], corners[1 % corners.len()], corners[corners.len() - 1]]);
        return Ok(());
    }
    let around = corners.iter().zip(corners.iter().cycle().skip(1));
    let origin = point(corners[0]);
    let normal: DVec3 = around.map(|(&a, &b)| (point(a) - origin).cross(point(b) - origin)).sum();
    let Some(normal) = normal.try_normalize() else {
        push_fan(&corners, triangles); // no plane: nothing is better than anything else
        return Ok(());
    };
    let across = normal.any_orthonormal_vector();
    let up = normal.cross(across);
    let flat = |corner: &u32| {
        let arm = point(*corner) - origin;
        DVec2::new(arm.dot(across), arm.dot(up))
    };
    let mut seen: Vec<DVec2> = corners.iter().map(flat).collect();
    if (0..corners.len()).all(|i| turn(&seen, i) == Orientation::Positive) {
        push_fan(&corners, triangles);
        return Ok(());
    }
    if corners.len() > MAX_CONCAVE {
        return Err(ReadError::PolygonTooLarge { face, corner_count: corners.len(), limit: MAX_CONCAVE });
    }
    while corners.len() > 3 {
        let Some(i) = (0..corners.len()).find(|&i| is_ear(&seen, i)) else { break };
        let (before, after) = around_of(corners.len(), i);
        triangles.push([corners[before], corners[i], corners[after]]);
        corners.remove(i);
        seen.remove(i);
    }
    push_fan(&corners, triangles); // one triangle, or what is left of a polygon that crosses itself
    Ok(())
}

fn push_fan(corners: &[u32], triangles: &mut Vec<[u32; 3]>) {
    triangles.extend(corners[1..].windows(2).map(|pair| [corners[0], pair[0], pair[1]]));
}

/// The indices before and after `i` in a ring.
fn around_of(count: usize, i: usize) -> (usize, usize) {
    ((i + count - 1) % count, (i + 1) % count)
}

fn turn(seen: &[DVec2], i: usize) -> Orientation {
    let (before, after) = around_of(seen.len(), i);
    orientation(seen[before], seen[i], seen[after])
}

/// Whether corner `i` can be cut off: it turns left and no other corner lies in its triangle.
fn is_ear(seen: &[DVec2], i: usize) -> bool {
    let (before, after) = around_of(seen.len(), i);
    let [a, b, c] = [seen[before], seen[i], seen[after]];
    let inside = |p: DVec2| {
        [(a, b), (b, c), (c, a)].iter().all(|&(from, to)| orientation(from, to, p) != Orientation::Negative)
    };
    let others = (0..seen.len()).filter(|&j| j != before && j != i && j != after);
    orientation(a, b, c) == Orientation::Positive && !others.map(|j| seen[j]).any(inside)
}
