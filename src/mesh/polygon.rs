//! Faces, and how polygons become triangles.
//!
//! A polygon is seen in its mean plane (the normal after Newell). A strictly convex one becomes a fan around
//! its first corner. Of any other, ears are cut off one by one (G. H. Meisters, "Polygons have ears", Amer.
//! Math. Monthly 82 (1975), 648-651), with exact orientations.
//!
//! A hole may be joined to the rim by a bridge that is run both ways, so that places occur twice:
//! ```text
//!   3-----------2     0 1 2 3 0 4 7 6 5 4: whether a corner in the place of the ear's corner b
//!   |   5---6   |     is in the way is seen from the edges that leave it. Those that go into the
//!   |   |   |   |     wedge between the ear's sides at b are, those along the sides or outside
//!   |   4---7   |     it are not.
//!   | /         |
//!   0-----------1
//! ```

use super::MeshError;
use crate::geometry::{Orientation, orientation};
use crate::memory::{self, CollectVec};
use glam::{DVec2, DVec3};

/// Ears take cubic time at worst, so a polygon that is not convex may have this many corners.
const MAX_CONCAVE: usize = 2000;

/// Polygons as lists of nodes, one behind the other.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Faces {
    corners: Vec<u32>,
    /// Where each face ends in `corners`.
    ends: Vec<usize>,
    /// Faces that were given.
    given: usize,
    /// The numbers of the faces that were kept; none while all are.
    kept: Option<Vec<u32>>,
}

/// The triangles of faces.
pub(super) struct Triangulation {
    pub triangles: Vec<[u32; 3]>,
    /// The face of each triangle; none if they are the same.
    pub faces: Option<Vec<u32>>,
}

impl Faces {
    /// Room for `count` triangles; the caller has checked that there can be so many.
    pub fn reserve(&mut self, count: usize) {
        self.corners.reserve(3 * count);
        self.ends.reserve(count);
    }

    /// Adds a corner to the face that is being made.
    pub fn push(&mut self, node: u32) {
        memory::push(&mut self.corners, node);
    }

    /// Ends a face. One of less than three corners is left out: it has no area.
    pub fn end_face(&mut self) {
        let start = self.ends.last().copied().unwrap_or(0);
        if self.corners.len() - start < 3 {
            self.corners.truncate(start);
            self.kept.get_or_insert_with(|| (0..self.given as u32).collect_vec());
        } else {
            memory::push(&mut self.ends, self.corners.len());
            if let Some(kept) = &mut self.kept {
                memory::push(kept, self.given as u32);
            }
        }
        self.given += 1;
    }

    /// Lets nodes count from 0 instead of `first`; the first face that has one which is none of `count` is refused.
    pub(super) fn rebase(&mut self, first: u32, count: usize) -> Result<(), MeshError> {
        let end = count as u64 + u64::from(first);
        let exists = |node: u32| node >= first && u64::from(node) < end;
        if let Some(corner) = self.corners.iter().position(|&node| !exists(node)) {
            let face = self.ends.partition_point(|&end| end <= corner);
            let (triangle, node) = (self.number(face) as usize, self.corners[corner]);
            return Err(MeshError::IndexOutOfRange { triangle, node, first, last: end - 1 });
        }
        if first != 0 {
            self.corners.iter_mut().for_each(|node| *node -= first);
        }
        Ok(())
    }

    /// The number that a face had among those given.
    fn number(&self, face: usize) -> u32 {
        self.kept.as_ref().map_or(face as u32, |kept| kept[face])
    }

    /// Whether no face was given.
    pub fn is_empty(&self) -> bool {
        self.given == 0
    }

    /// The nodes of all corners.
    pub fn corners(&self) -> &[u32] {
        &self.corners
    }

    /// The first face that was left out because it has less than three corners, and how many there are.
    pub(super) fn left_out(&self) -> Option<(usize, usize)> {
        let kept = self.kept.as_ref()?;
        let first = kept.iter().zip(0..).position(|(&face, i)| face != i).unwrap_or(kept.len());
        Some((first, self.given - kept.len()))
    }

    pub(super) fn into_triangles(self, points: &[DVec3]) -> Result<Triangulation, MeshError> {
        let is_plain = self.kept.is_none() && self.corners.len() == 3 * self.ends.len();
        let mut triangles = memory::with_capacity(self.ends.len());
        let mut faces = Vec::new();
        let mut start = 0;
        for (face, &end) in self.ends.iter().enumerate() {
            match self.corners[start..end] {
                [a, b, c] => triangles.push([a, b, c]),
                ref polygon => split(polygon, points, self.number(face) as usize, &mut triangles)?,
            }
            if !is_plain {
                faces.resize(triangles.len(), self.number(face));
            }
            start = end;
        }
        Ok(Triangulation { triangles, faces: (!is_plain).then_some(faces) })
    }
}

/// Appends the triangles of a polygon.
fn split(
    polygon: &[u32],
    points: &[DVec3],
    face: usize,
    triangles: &mut Vec<[u32; 3]>,
) -> Result<(), MeshError> {
    // a corner given twice in a row makes a shorter polygon: finite elements write triangles as such quads
    let mut corners = memory::copied(polygon);
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
    let mut seen: Vec<DVec2> = corners.iter().map(flat).collect_vec();
    if is_strictly_convex(&corners, &seen) {
        push_fan(&corners, triangles);
        return Ok(());
    }
    if corners.len() > MAX_CONCAVE {
        return Err(MeshError::PolygonTooLarge { face, corner_count: corners.len(), limit: MAX_CONCAVE });
    }
    while corners.len() > 3 {
        let ear = |touches| (0..corners.len()).find(|&i| is_ear(&seen, i, touches));
        // a polygon that touches itself may have no ear that others keep clear of
        if let Some(i) = ear(Touches::Corners).or_else(|| ear(Touches::Sides)) {
            let (before, after) = around_of(corners.len(), i);
            triangles.push([corners[before], corners[i], corners[after]]);
            corners.remove(i);
            seen.remove(i);
        } else if let Some(i) = (0..corners.len()).find(|&i| is_spike(&corners, i)) {
            // the way there and back, which bounds nothing
            let (_, after) = around_of(corners.len(), i);
            for at in [i.max(after), i.min(after)] {
                corners.remove(at);
                seen.remove(at);
            }
        } else {
            break;
        }
    }
    if corners.len() >= 3 && !(corners.len() == 3 && is_spike(&corners, 0)) {
        push_fan(&corners, triangles); // one triangle, or what is left of a polygon that crosses itself
    }
    Ok(())
}

/// Whether all corners turn left and no node comes twice: a star turns left too, but more than once around.
fn is_strictly_convex(corners: &[u32], seen: &[DVec2]) -> bool {
    let turns_left = (0..corners.len()).all(|i| turn(seen, i) == Orientation::Positive);
    // edges of a convex polygon go up once and down once
    let rises = |i: usize| seen[around_of(seen.len(), i).1].y > seen[i].y;
    let changes = (0..seen.len()).filter(|&i| rises(i) != rises(around_of(seen.len(), i).1)).count();
    turns_left && changes == 2
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

/// Where other corners may lie that do not keep an ear from being cut off.
#[derive(Clone, Copy, PartialEq)]
enum Touches {
    /// In the place of one of its corners, if their edges stay outside.
    Corners,
    /// On its sides too.
    Sides,
}

/// Whether corner `i` can be cut off: it turns left and nothing of the polygon lies in its triangle.
fn is_ear(seen: &[DVec2], i: usize, touches: Touches) -> bool {
    let (before, after) = around_of(seen.len(), i);
    let ear = [seen[before], seen[i], seen[after]];
    let side = |k: usize, p: DVec2| orientation(ear[k], ear[(k + 1) % 3], p);
    if side(0, ear[2]) != Orientation::Positive {
        return false;
    }
    // whether the way from corner k of the ear to p leads into it
    let enters = |k: usize, p: DVec2| {
        side(k, p) == Orientation::Positive && side((k + 2) % 3, p) == Orientation::Positive
    };
    let is_in_the_way = |j: usize| {
        let p = seen[j];
        if let Some(k) = ear.iter().position(|&corner| corner == p) {
            let (from, to) = around_of(seen.len(), j);
            return enters(k, seen[from]) || enters(k, seen[to]);
        }
        let sides = [0, 1, 2].map(|k| side(k, p));
        let is_inside = !sides.contains(&Orientation::Negative);
        let is_on_side = sides.contains(&Orientation::Zero);
        is_inside && !(is_on_side && touches == Touches::Sides)
    };
    !(0..seen.len()).filter(|&j| j != before && j != i && j != after).any(is_in_the_way)
}

/// Whether the nodes before and after corner `i` are the same.
fn is_spike(corners: &[u32], i: usize) -> bool {
    let (before, after) = around_of(corners.len(), i);
    corners[before] == corners[after]
}
