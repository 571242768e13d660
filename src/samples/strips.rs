//! Bodies whose triangles know the face of a CAD model that they come from.

use super::{Random, grid};
use crate::mesh::{Mesh, MeshError};
use glam::{DVec2, DVec3};

/// A body with a label for each triangle.
#[derive(Debug, Clone)]
pub struct Strips {
    /// Closed, in one piece.
    pub mesh: Mesh,
    /// By triangle.
    pub labels: Vec<u32>,
    /// Of the body, not of the mesh.
    pub volume: f64,
}

/// Strips of each skin of [`wing_strips`].
const STRIPS: usize = 20;
/// Rows of cells of a strip.
const ROWS: usize = 3;
/// Cells along the chord.
const CELLS: usize = 24;
/// Height of both skins over the chord line: by chord, times 4 s (1 - s) at a share s of the chord.
const HEIGHTS: [f64; 2] = [0.09, -0.05];
/// How far the tip is from the root.
const SPAN: f64 = 6.0;

/// A wing in strips along its chords: 0 to 19 are those of the upper skin from root to tip, 20 to 39 those of the lower
/// skin, 40 is the root and 41 the tip. Skins bend along and across, and meet in sharp edges at the nose and behind; root
/// and tip are planes. 2,928 nodes, moved along their chords by a seeded jitter.
///
/// Its sections are two parabolas, turned and moved within their planes, so that the volume has a closed form.
pub fn wing_strips(seed: u64) -> Result<Strips, MeshError> {
    let count = [CELLS + 1, STRIPS * ROWS + 1];
    let (mut points, mut triangles, mut labels) = (Vec::new(), Vec::new(), Vec::new());
    // by skin: the nodes of its grid, which share those of the nose and of the edge behind
    let mut nodes: [Vec<u32>; 2] = Default::default();
    let mut random = Random::new(seed);
    for (side, height) in HEIGHTS.into_iter().enumerate() {
        let (places, cells) = grid(count, 0.0, seed.wrapping_add(side as u64), |_| true);
        for (number, place) in places.into_iter().enumerate() {
            let is_shared = [0.0, 1.0].contains(&place.x);
            if is_shared && side == 1 {
                let node = nodes[0][number];
                nodes[1].push(node);
                continue;
            }
            // root and tip keep theirs, so that the skins see the same places
            let is_inner = !is_shared && place.y > 0.0 && place.y < 1.0;
            let moved = if is_inner { 0.3 * random.signed() / CELLS as f64 } else { 0.0 };
            nodes[side].push(points.len() as u32);
            points.push(wing_place(place + DVec2::X * moved, height));
        }
        for cell in cells {
            let mut triangle = cell.map(|node| nodes[side][node as usize]);
            if side == 1 {
                triangle.swap(1, 2);
            }
            triangles.push(triangle);
            // the lowest row of a triangle is that of its cell
            let row = cell.iter().map(|&node| node as usize % count[1]).min().unwrap_or(0);
            labels.push((side * STRIPS + row / ROWS) as u32);
        }
    }
    for (label, column) in [(2 * STRIPS, 0), (2 * STRIPS + 1, count[1] - 1)] {
        for cell in 0..CELLS {
            let [up, low] =
                [0, 1].map(|side: usize| [0, 1].map(|k| nodes[side][(cell + k) * count[1] + column]));
            let mut add = |[a, b, c]: [u32; 3]| {
                let is_flat = a == b || b == c || c == a;
                if !is_flat {
                    triangles.push(if column == 0 { [a, b, c] } else { [a, c, b] });
                    labels.push(label as u32);
                }
            };
            add([low[0], low[1], up[1]]);
            add([low[0], up[1], up[0]]);
        }
    }
    // sections have 2/3 of the area of their box, and chords from 2 to 1: the mean of their squares is 7/3
    let volume = 2.0 / 3.0 * (HEIGHTS[0] - HEIGHTS[1]) * 7.0 / 3.0 * SPAN;
    Ok(Strips { mesh: Mesh::new(points, triangles)?, labels, volume })
}

/// The place at shares of the chord and of the span, on the skin of a height.
fn wing_place(place: DVec2, height: f64) -> DVec3 {
    let (s, b) = (place.x, place.y);
    let chord = 2.0 - b;
    let section = chord * DVec2::new(s, 4.0 * height * s * (1.0 - s));
    let turned = DVec2::from_angle(-0.07 * b).rotate(section) + DVec2::new(1.2 * b, 0.5 * b * b);
    DVec3::new(turned.x, SPAN * b, turned.y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn wing_strips_are_closed_and_all_labels_are_there() {
        for seed in [1, 2] {
            let Strips { mesh, labels, volume } = wing_strips(seed).unwrap();
            assert_eq!((mesh.loops().len(), mesh.genus(), mesh.component_count()), (0, 0, 1));
            // both skins, which share two rows, of 25 by 61
            assert_eq!(mesh.points().len(), 2 * 25 * 61 - 2 * 61);
            assert_eq!(labels.len(), mesh.triangles().len());
            assert_eq!(labels.iter().copied().collect::<BTreeSet<u32>>(), (0..42).collect());
            // chords of a parabola take 1 / n^2 of a section; those along the span are flatter. Jitter of 0.3 cells lets the
            // largest be 1.6 times longer, its part of the area 4 times larger
            let place = |node: u32| mesh.points()[node as usize];
            let cone = |t: &[u32; 3]| place(t[0]).dot(place(t[1]).cross(place(t[2]))) / 6.0;
            let of_mesh: f64 = mesh.triangles().iter().map(cone).sum();
            let most = 4.0 / (CELLS * CELLS) as f64;
            assert!((of_mesh / volume - 1.0).abs() <= most, "{of_mesh} {volume}");
        }
    }
}
