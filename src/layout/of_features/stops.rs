//! A node for every vertex of the layout on a border.
//!
//! ```text
//!        c            Where the nodes of a chain are far apart a vertex s of the layout lies between them. Ways through
//!       /|\           a region and base complexes begin at nodes: the edge of the border is split there, and its
//!      / | \          triangle with it. The new nodes come after all others, and what becomes known of them is left
//!     a--s--b         out of the result.
//! ```

use super::over::Halving;
use super::pieces::{Line, Run, Sheet};
use super::places::Division;
use crate::mesh::{Mesh, MeshError};
use glam::DVec3;
use std::collections::HashMap;

impl Sheet {
    /// The same with a node at every stop of a division, but for the middles of edges that are halved.
    pub(super) fn with_stops(
        &self,
        lines: &[Line],
        division: &Division,
        halving: Halving,
    ) -> Result<Self, MeshError> {
        let step = if halving == Halving::Yes { 2 } else { 1 };
        let mut splitting = Splitting::new(self);
        let mut loops = self.loops.clone();
        for run in loops.iter_mut().flatten() {
            let line = &lines[run.chain as usize];
            for &length in division.lengths[run.chain as usize].iter().step_by(step) {
                splitting.insert(run, if line.is_closed { length.rem_euclid(line.length()) } else { length });
            }
        }
        let mesh = Mesh::new(splitting.points, splitting.triangles)?;
        Ok(Self { region: self.region, mesh, loops })
    }
}

/// Triangles whose border edges are being split.
struct Splitting {
    points: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    /// By edge in the direction of its triangle: that triangle.
    triangle_of: HashMap<[u32; 2], usize>,
}

impl Splitting {
    fn new(sheet: &Sheet) -> Self {
        let triangles = sheet.mesh.triangles().to_vec();
        let sides = triangles
            .iter()
            .enumerate()
            .flat_map(|(t, &[a, b, c])| [[a, b], [b, c], [c, a]].map(|side| (side, t)));
        let triangle_of = sides.collect();
        Self { points: sheet.mesh.points().to_vec(), triangle_of, triangles }
    }

    /// Puts a node at a length of a run, unless one is there.
    fn insert(&mut self, run: &mut Run, length: f64) {
        let is_between = |ends: &[f64]| ends[0].min(ends[1]) < length && length < ends[0].max(ends[1]);
        let Some(before) = run.lengths.windows(2).position(is_between) else { return };
        let [from, to] = [before, before + 1].map(|k| run.nodes[k]);
        let share = (length - run.lengths[before]) / (run.lengths[before + 1] - run.lengths[before]);
        let place = self.points[from as usize].lerp(self.points[to as usize], share);
        // a loop runs with its region on the left, as the triangle at the edge does
        let node = self.split([from, to], place);
        run.nodes.insert(before + 1, node);
        run.lengths.insert(before + 1, length);
    }

    /// Splits an edge of the border, and its triangle.
    fn split(&mut self, [from, to]: [u32; 2], place: DVec3) -> u32 {
        let node = self.points.len() as u32;
        self.points.push(place);
        let (old, new) = (self.triangle_of[&[from, to]], self.triangles.len());
        let third = self.triangles[old].into_iter().find(|corner| ![from, to].contains(corner));
        let third = third.expect("a triangle has three corners");
        self.triangles[old] = [from, node, third];
        self.triangles.push([node, to, third]);
        self.triangle_of.extend([
            ([from, node], old),
            ([node, third], old),
            ([node, to], new),
            ([to, third], new),
            ([third, node], new),
        ]);
        node
    }
}
