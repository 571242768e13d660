//! Finds the leaf of a parameter pair in nearly constant time: a uniform grid of buckets, each of which knows the
//! deepest node that holds it whole, and from there down the quadtree.

use super::cell::{Cell, MAX_LEVEL, Vertex};
use super::mesh::{NodeId, TMesh};
use crate::geometry::Axis;
use crate::knots::KnotVector;
use crate::memory::{self, CollectVec};
use glam::DVec2;

/// The buckets of one mesh.
#[derive(Debug, Clone)]
pub struct Directory {
    /// The lines between buckets, as knots of degree 1: they are lines of the mesh to the bit.
    lines: [KnotVector; 2],
    /// Buckets along v.
    count_v: usize,
    /// Where to go on, for each bucket, v running fastest.
    nodes: Vec<NodeId>,
}

impl Directory {
    /// At most about one bucket a leaf; time and memory are linear in both.
    pub fn new(mesh: &TMesh) -> Self {
        let [count_u, count_v] = mesh.grid_size();
        let roots = count_u as usize * count_v as usize;
        let level =
            (0..MAX_LEVEL / 2).rev().find(|&level| roots << (2 * level) <= mesh.leaf_count().max(roots));
        let level = level.unwrap_or(0);
        let side = Vertex::side_at(level);
        let lines = [(Axis::U, count_u), (Axis::V, count_v)].map(|(axis, count)| {
            let breaks: Vec<f64> = (0..=count << level).map(|k| mesh.parameter(axis, k * side)).collect_vec();
            // lines so close that they coincide after rounding leave the initial grid
            KnotVector::clamped(&breaks, 1).ok().filter(|_| breaks.windows(2).all(|pair| pair[0] < pair[1]))
        });
        let (lines, level) = match lines {
            [Some(u), Some(v)] => ([u, v], level),
            _ => ([Axis::U, Axis::V].map(|axis| mesh.grid_lines(axis).clone()), 0),
        };
        let [count_u, count_v] = [count_u << level, count_v << level];
        let mut nodes = memory::with_capacity(count_u as usize * count_v as usize);
        for i in 0..count_u {
            for j in 0..count_v {
                nodes.push(mesh.find_or_holder(Cell { level, i, j }));
            }
        }
        Self { lines, count_v: count_v as usize, nodes }
    }

    /// The leaf that [`TMesh::locate`] finds.
    #[inline(always)]
    pub fn locate(&self, mesh: &TMesh, uv: DVec2) -> NodeId {
        let bucket = self.lines[0].rank_at(uv.x) * self.count_v + self.lines[1].rank_at(uv.y);
        mesh.descend(self.nodes[bucket], uv)
    }
}
