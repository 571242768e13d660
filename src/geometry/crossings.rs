//! Where pieces of polylines in the plane meet.
//!
//! A sweep along u (M. Shamos, D. Hoey, "Geometric intersection problems", 1976) over all pieces, without its tree: few
//! pieces are over one place. All decisions are exact.

use super::{Orientation, orientation};
use crate::memory;
use glam::DVec2;
use std::ops::ControlFlow;

/// Visits pairs of pieces that meet other than at a common node, until `visit` breaks. A piece is the two nodes at its
/// ends.
pub fn visit_meetings(
    mut pieces: Vec<[u32; 2]>,
    place: impl Fn(u32) -> DVec2,
    mut visit: impl FnMut([u32; 2], [u32; 2]) -> ControlFlow<()>,
) -> ControlFlow<()> {
    let left = |piece: &[u32; 2]| place(piece[0]).x.min(place(piece[1]).x);
    let right = |piece: &[u32; 2]| place(piece[0]).x.max(place(piece[1]).x);
    pieces.sort_by(|a, b| left(a).total_cmp(&left(b)));
    // only pieces that have not ended yet can meet the next
    let mut active: Vec<[u32; 2]> = Vec::new();
    for piece in pieces {
        active.retain(|other| right(other) >= left(&piece));
        for &other in &active {
            if pieces_meet(other, piece, &place) {
                visit(other, piece)?;
            }
        }
        memory::push(&mut active, piece);
    }
    ControlFlow::Continue(())
}

/// Pieces with a common node meet elsewhere only if they run back along one another.
fn pieces_meet(first: [u32; 2], second: [u32; 2], place: impl Fn(u32) -> DVec2) -> bool {
    let ([a, b], [c, d]) = (first.map(&place), second.map(&place));
    let overlap = |min1: f64, max1: f64, min2: f64, max2: f64| min1 <= max2 && min2 <= max1;
    if !overlap(a.y.min(b.y), a.y.max(b.y), c.y.min(d.y), c.y.max(d.y))
        || !overlap(a.x.min(b.x), a.x.max(b.x), c.x.min(d.x), c.x.max(d.x))
    {
        return false;
    }
    if let Some(&node) = first.iter().find(|node| second.contains(node)) {
        let other_end = |[p, q]: [u32; 2]| place(if p == node { q } else { p });
        let (at, p, q) = (place(node), other_end(first), other_end(second));
        return orientation(at, p, q) == Orientation::Zero && (p - at).dot(q - at) > 0.0;
    }
    let apart = |p: DVec2, q: DVec2, r: DVec2, s: DVec2| {
        let (one, other) = (orientation(p, q, r), orientation(p, q, s));
        one == other && one != Orientation::Zero
    };
    !apart(a, b, c, d) && !apart(c, d, a, b)
}
