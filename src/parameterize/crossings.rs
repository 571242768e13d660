//! Where the boundary of a map meets itself.
//!
//! A sweep along u (M. Shamos, D. Hoey, "Geometric intersection problems", 1976) over the pieces of all loops, without
//! its tree: few pieces are over one place. All decisions are exact. Without flips and without such meetings a map
//! covers no place twice, and its trims are simple polygons.

use crate::geometry::{Orientation, orientation};
use crate::memory::{self, CollectVec};
use crate::mesh::Mesh;
use glam::DVec2;
use std::ops::ControlFlow;

/// Whether any two pieces of the boundary meet other than at a common node.
pub(super) fn boundary_crosses(mesh: &Mesh, uv: &[DVec2]) -> bool {
    visit_meetings(mesh, uv, |_, _| ControlFlow::Break(())).is_break()
}

/// The nodes at the ends of pieces of the boundary that meet others elsewhere than at a common node; some several
/// times.
pub(crate) fn crossing_nodes(mesh: &Mesh, uv: &[DVec2]) -> Vec<u32> {
    let mut nodes = Vec::new();
    let _ = visit_meetings(mesh, uv, |first, second| {
        memory::extend(&mut nodes, first);
        memory::extend(&mut nodes, second);
        ControlFlow::Continue(())
    });
    nodes
}

fn visit_meetings(
    mesh: &Mesh,
    uv: &[DVec2],
    mut visit: impl FnMut([u32; 2], [u32; 2]) -> ControlFlow<()>,
) -> ControlFlow<()> {
    let mut pieces: Vec<[u32; 2]> = mesh.boundary_edges().collect_vec();
    let place = |node: u32| uv[node as usize];
    let left = |piece: &[u32; 2]| place(piece[0]).x.min(place(piece[1]).x);
    let right = |piece: &[u32; 2]| place(piece[0]).x.max(place(piece[1]).x);
    pieces.sort_by(|a, b| left(a).total_cmp(&left(b)));
    // only pieces that have not ended yet can meet the next
    let mut active: Vec<[u32; 2]> = Vec::new();
    for piece in pieces {
        active.retain(|other| right(other) >= left(&piece));
        for &other in &active {
            if pieces_meet(other, piece, place) {
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

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn meetings_are_seen_however_slight() {
        let triangles = vec![[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];
        let mesh = Mesh::new(
            [(0., 0.), (1., 0.), (1., 1.), (0., 1.), (0.5, 0.5)].map(|(x, y)| DVec3::new(x, y, 0.0)).to_vec(),
            triangles,
        )
        .unwrap();
        let crosses = |places: [(f64, f64); 5]| boundary_crosses(&mesh, &places.map(DVec2::from));
        let middle = (0.5, 0.5);
        assert!(!crosses([(0., 0.), (1., 0.), (1., 1.), (0., 1.), middle]));
        // a bow tie; a corner on the opposite side, exactly or a rounding short of it; a spike
        assert!(crosses([(0., 0.), (1., 1.), (1., 0.), (0., 1.), middle]));
        assert!(crosses([(0., 0.), (1., 0.), (0.25, 0.0), (0., 1.), middle]));
        assert!(!crosses([(0., 0.), (1., 0.), (0.25, f64::EPSILON), (0., 1.), middle]));
        assert!(crosses([(0., 0.), (1., 0.), (0.5, 0.0), (0., 1.), middle]));
    }
}
