//! Exact tensor product surfaces out of a PHT-spline: the whole, or few patches over parts of even fineness.
//!
//! Deng et al. 2008, section 5.3. A rectangle of cells is a tensor surface over all coordinates of
//! its vertices, with double knots inside: the control points are the ordinates 0 and 1 of the first interval,
//! then 2 and 1 around each line, then 2 and 3 of the last, which the jets at the crossings of the lines give.

use super::PhtSurface;
use super::evaluate::View;
use super::expansion::line_between;
use super::jet::{self, inside};
use crate::control::{Cancelled, Watch};
use crate::knots::KnotVector;
use crate::memory::{self, CollectVec};
use crate::surface::tensor::{Axis, TensorSurface};
use crate::surface::{ConvertError, Surface};
use crate::tmesh::{Cell, NodeId, TMesh, Vertex};

/// A rectangle of whole leaves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Block {
    min: Vertex,
    max: Vertex,
    /// The coarsest and the finest level of its leaves.
    levels: [u32; 2],
}

impl Block {
    fn spread(&self) -> u32 {
        self.levels[1] - self.levels[0]
    }

    /// Both together, if they share a whole side and the levels differ by at most `level_spread`.
    fn joined(&self, next: &Self, axis: Axis, level_spread: u32) -> Option<Self> {
        let shares_side = match axis {
            Axis::U => self.max.i == next.min.i && self.min.j == next.min.j && self.max.j == next.max.j,
            Axis::V => self.max.j == next.min.j && self.min.i == next.min.i && self.max.i == next.max.i,
        };
        let levels = [self.levels[0].min(next.levels[0]), self.levels[1].max(next.levels[1])];
        let joined = Self { min: self.min, max: next.max, levels };
        (shares_side && joined.spread() <= level_spread).then_some(joined)
    }
}

impl PhtSurface {
    /// The same surface as one tensor surface over the common refinement of all cells, if it has at most
    /// `max_coefficients` control points.
    pub fn to_tensor(&self, max_coefficients: usize) -> Result<TensorSurface, ConvertError> {
        self.to_tensor_watched(max_coefficients, &Watch::default())
    }

    /// The same, for a call that may be cancelled.
    pub fn to_tensor_watched(
        &self,
        max_coefficients: usize,
        watch: &Watch,
    ) -> Result<TensorSurface, ConvertError> {
        let (min, max) = (Vertex { i: 0, j: 0 }, self.mesh.last_vertex());
        let lines = self.lines(&Block { min, max, levels: [0, 0] }, 0..self.mesh.leaf_count(), watch)?;
        let needed = (2 * lines[0].len()).saturating_mul(2 * lines[1].len());
        if needed > max_coefficients {
            return Err(ConvertError::TooLarge { needed, limit: max_coefficients });
        }
        let mut tensor = self.tensor_over(&lines, watch)?;
        *tensor.region_mut() = self.region.clone();
        Ok(tensor)
    }

    /// The same surface in tensor patches that meet with equal parameters, each over cells whose levels differ
    /// by at most `level_spread`: the largest quadtree nodes that allow it, joined where whole sides meet. Each has its
    /// part of the trims.
    pub fn to_tensor_patches(&self, level_spread: u32) -> Result<Vec<TensorSurface>, ConvertError> {
        self.to_tensor_patches_watched(level_spread, &Watch::default())
    }

    /// The same, for a call that may be cancelled.
    pub fn to_tensor_patches_watched(
        &self,
        level_spread: u32,
        watch: &Watch,
    ) -> Result<Vec<TensorSurface>, ConvertError> {
        let blocks = blocks(&self.mesh, level_spread);
        watch.check()?;
        let leaves = self.leaves_by_block(&blocks, watch)?;
        let patch = |(block, leaves)| {
            let mut patch = self.tensor_over(&self.lines(block, leaves, watch)?, watch)?;
            *patch.region_mut() = self.region.restrict(&self.domain(), &patch.domain());
            Ok(patch)
        };
        blocks.iter().zip(leaves).map(patch).collect()
    }

    fn leaves_by_block(&self, blocks: &[Block], watch: &Watch) -> Result<Vec<Vec<usize>>, Cancelled> {
        // blocks sorted by their first vertex: a leaf belongs to one of those that begin at or before it
        let mut leaves = memory::filled(Vec::new(), blocks.len());
        for (leaf, &node) in self.topology().leaves.iter().enumerate() {
            watch.check_at(leaf)?;
            let [Vertex { i, j }, _, _, _] = self.mesh.cell(node).corners();
            let begins = blocks.partition_point(|block| block.min.i <= i);
            let holds = |block: &Block| i < block.max.i && block.min.j <= j && j < block.max.j;
            if let Some(block) = blocks[..begins].iter().rposition(holds) {
                memory::push(&mut leaves[block], leaf);
            }
        }
        Ok(leaves)
    }

    /// The coordinates of all vertices of some leaves.
    fn lines(
        &self,
        block: &Block,
        leaves: impl IntoIterator<Item = usize>,
        watch: &Watch,
    ) -> Result<[Vec<u32>; 2], Cancelled> {
        let topology = self.topology();
        let mut lines = [vec![block.min.i, block.max.i], vec![block.min.j, block.max.j]];
        for leaf in leaves {
            watch.check_at(leaf)?;
            let [low, _, _, high] = self.mesh.cell(topology.leaves[leaf]).corners();
            memory::extend(&mut lines[0], [low.i, high.i]);
            memory::extend(&mut lines[1], [low.j, high.j]);
        }
        Ok(lines.map(|mut lines| {
            lines.sort_unstable();
            lines.dedup();
            lines
        }))
    }

    /// The tensor surface over the rectangle that these lines cut.
    fn tensor_over(&self, lines: &[Vec<u32>; 2], watch: &Watch) -> Result<TensorSurface, ConvertError> {
        let (view, width) = (self.view(), self.width());
        let breaks = [(Axis::U, &lines[0]), (Axis::V, &lines[1])]
            .map(|(axis, lines)| lines.iter().map(|&at| self.mesh.parameter(axis, at)).collect::<Vec<f64>>());
        let offsets = [&breaks[0], &breaks[1]].map(|breaks| offsets(breaks));
        let count_v = 2 * breaks[1].len();
        let mut net = memory::filled(0.0, 2 * breaks[0].len() * count_v * width);
        for (a, &i) in lines[0].iter().enumerate() {
            for (b, &j) in lines[1].iter().enumerate() {
                watch.check_at(b)?;
                let is_last = [a + 1 == lines[0].len(), b + 1 == lines[1].len()];
                let jet = self.jet_inside(view, Vertex { i, j }, is_last);
                for (s, p) in offsets[0][a].into_iter().enumerate() {
                    for (t, q) in offsets[1][b].into_iter().enumerate() {
                        let at = ((2 * a + s) * count_v + 2 * b + t) * width;
                        jet::ordinate(&jet, p, q, &mut net[at..at + width]);
                    }
                }
            }
        }
        let [knots_u, knots_v] = breaks.map(|breaks| double_knots(&breaks));
        let (points, weights) = split_weights(&net, self.dim, self.is_rational);
        Ok(TensorSurface::new(self.dim, knots_u, knots_v, points, weights)?)
    }

    /// The jet at a place of a rectangle, from the leaf to the right and above, or below at the ends.
    fn jet_inside(&self, view: &View, at: Vertex, [is_right, is_top]: [bool; 2]) -> Vec<f64> {
        let quadrant = [u32::from(!is_right), u32::from(!is_top)];
        let node = self.mesh.leaf_beside(at, quadrant).expect("the rectangle lies in the domain");
        let leaf = view.topology.leaf_of(node);
        let jets = view.topology.corners[leaf].map(|vertex| view.jet(vertex));
        let corners = self.mesh.cell(node).corners();
        if let Some(corner) = corners.iter().position(|&corner| corner == at) {
            return jets[corner].to_vec();
        }
        let lines = [Axis::U, Axis::V].map(|axis| {
            let range = [corners[0].along(axis), corners[3].along(axis)];
            line_between(&self.mesh, axis, at.along(axis), range)
        });
        inside(jets, lines, self.width())
    }
}

/// Where the two ordinates of each line lie, relative to it: a third of the intervals beside it.
fn offsets(breaks: &[f64]) -> Vec<[f64; 2]> {
    let last = breaks.len() - 1;
    let third = |k: usize| (breaks[k + 1] - breaks[k]) / 3.0;
    let around = |k: usize| match k {
        0 => [0.0, third(0)],
        k if k == last => [-third(k - 1), 0.0],
        k => [-third(k - 1), third(k)],
    };
    (0..=last).map(around).collect_vec()
}

/// Cubic knots with both ends fourfold and all others double.
fn double_knots(breaks: &[f64]) -> KnotVector {
    let doubled: Vec<f64> = breaks[1..breaks.len() - 1].iter().flat_map(|&t| [t, t]).collect_vec();
    let (first, last) = (breaks[0], breaks[breaks.len() - 1]);
    let knots = [[first; 4].as_slice(), &doubled, &[last; 4]].concat();
    KnotVector::new(knots, 3).expect("parameters of vertices increase")
}

/// From rows of a net to points and, where the rows are homogeneous, weights.
fn split_weights(net: &[f64], dim: usize, is_rational: bool) -> (Vec<f64>, Option<Vec<f64>>) {
    if !is_rational {
        return (memory::copied(net), None);
    }
    let rows = net.chunks_exact(dim + 1);
    let points = rows.clone().flat_map(|row| row[..dim].iter().map(|x| x / row[dim])).collect_vec();
    (points, Some(rows.map(|row| row[dim]).collect_vec()))
}

/// Rectangles of leaves whose levels differ by at most `level_spread`, sorted by their first vertex.
fn blocks(mesh: &TMesh, level_spread: u32) -> Vec<Block> {
    let mut blocks = Vec::new();
    let [count_u, count_v] = mesh.grid_size();
    for i in 0..count_u {
        for j in 0..count_v {
            let root = mesh.find(Cell { level: 0, i, j }).expect("a cell of the grid");
            collect_blocks(mesh, root, level_spread, &mut blocks);
        }
    }
    // joining along one direction may make sides fit along the other
    loop {
        let before = blocks.len();
        join(&mut blocks, Axis::U, level_spread);
        join(&mut blocks, Axis::V, level_spread);
        if blocks.len() == before {
            blocks.sort_unstable_by_key(|block| block.min);
            return blocks;
        }
    }
}

/// Adds the largest nodes below `node` with an admissible spread; returns the levels of its leaves.
fn collect_blocks(mesh: &TMesh, node: NodeId, level_spread: u32, blocks: &mut Vec<Block>) -> [u32; 2] {
    let cell = mesh.cell(node);
    let [min, _, _, max] = cell.corners();
    let first = blocks.len();
    let mut levels = [cell.level; 2];
    if let Some(children) = mesh.children(node) {
        let below = children.map(|child| collect_blocks(mesh, child, level_spread, blocks));
        levels = below.into_iter().fold([u32::MAX, 0], |[low, high], [a, b]| [low.min(a), high.max(b)]);
    }
    if levels[1] - levels[0] <= level_spread {
        blocks.truncate(first);
        blocks.push(Block { min, max, levels });
    }
    levels
}

fn join(blocks: &mut Vec<Block>, axis: Axis, level_spread: u32) {
    blocks.sort_unstable_by_key(|block| match axis {
        Axis::U => (block.min.j, block.max.j, block.min.i),
        Axis::V => (block.min.i, block.max.i, block.min.j),
    });
    let mut joined: Vec<Block> = memory::with_capacity(blocks.len());
    for block in blocks.iter() {
        match joined.last_mut().and_then(|last| Some((last.joined(block, axis, level_spread)?, last))) {
            Some((both, last)) => *last = both,
            None => joined.push(*block),
        }
    }
    *blocks = joined;
}
