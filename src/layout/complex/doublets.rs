//! Vertices of two quads removed.
//!
//! Two quads that meet at a vertex w of valence 2 share two edges and become one. Limbs of a shape end in chains of
//! such vertices, one after the other.
//! ```text
//!        x                    x
//!      / | \                /   \        The quads (w, a, x, b) and (w, b, y, a) become (a, x, b, y); w lies in its
//!     a -w- b      ->     a   w   b      middle, and places follow by the bilinear maps of both.
//!      \   /                \   /
//!        y                    y
//! ```
//! The new quad may have the same two vertices as another at two of its edges, so edges keep numbers of their own.

use super::Patches;
use crate::layout::Place;
use glam::DVec2;

/// Removes all vertices of two quads and says how many there were; none if what is left would be no layout.
pub(super) fn remove(patches: &mut Patches) -> Option<usize> {
    let mut removed = 0;
    while let Some((w, pair)) = doublet(patches) {
        merge(patches, w, pair)?;
        removed += 1;
    }
    Some(removed)
}

/// The first vertex inside with exactly two quads.
fn doublet(patches: &Patches) -> Option<(u32, [usize; 2])> {
    let vertex_count = patches.corners.iter().flatten().max().map_or(0, |&vertex| vertex as usize + 1);
    let mut around: Vec<Vec<usize>> = vec![Vec::new(); vertex_count];
    for (quad, corners) in patches.corners.iter().enumerate() {
        corners.iter().for_each(|&vertex| around[vertex as usize].push(quad));
    }
    let inside = (0..).zip(around).filter(|&(w, _)| patches.border[w as usize].is_none());
    inside.into_iter().find_map(|(w, quads)| Some((w, quads.try_into().ok()?)))
}

fn merge(patches: &mut Patches, w: u32, [first, second]: [usize; 2]) -> Option<()> {
    let starting_at = |quad: usize| {
        let (mut corners, mut edges) = (patches.corners[quad], patches.edges[quad]);
        let turn = corners.iter().position(|&vertex| vertex == w)?;
        corners.rotate_left(turn);
        edges.rotate_left(turn);
        Some((corners, edges))
    };
    let ([_, a, x, b], [_, ax, xb, _]) = starting_at(first)?;
    let ([_, b_again, y, a_again], [_, by, ya, _]) = starting_at(second)?;
    if (a, b) != (a_again, b_again) || x == y {
        return None;
    }
    let place_of = |vertex: u32| match vertex {
        _ if vertex == w => DVec2::splat(0.5),
        _ if vertex == a => DVec2::ZERO,
        _ if vertex == x => DVec2::X,
        _ if vertex == b => DVec2::ONE,
        _ => DVec2::Y,
    };
    let of_pair = [first, second].map(|quad| patches.corners[quad].map(place_of));
    let last = patches.corners.len() - 1;
    for place in patches.places.iter_mut().flatten() {
        if let Some(k) = [first, second].iter().position(|&quad| quad == place.quad as usize) {
            *place = Place { quad: first as u32, uv: bilinear(of_pair[k], place.uv) };
        } else if place.quad as usize == last {
            place.quad = second as u32; // the last takes the number that becomes free
        }
    }
    patches.corners[first] = [a, x, b, y];
    patches.edges[first] = [ax, xb, by, ya];
    patches.corners.swap_remove(second);
    patches.edges.swap_remove(second);
    Some(())
}

/// The bilinear map with these values at (0,0), (1,0), (1,1), (0,1).
fn bilinear(corners: [DVec2; 4], uv: DVec2) -> DVec2 {
    let low = corners[0].lerp(corners[1], uv.x);
    let high = corners[3].lerp(corners[2], uv.x);
    low.lerp(high, uv.y)
}
