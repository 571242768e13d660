//! Fill-reducing orders of a symmetric pattern.
//!
//! P. Amestoy, T. Davis, I. Duff, "An approximate minimum degree ordering algorithm", SIAM J.
//! Matrix Anal. Appl. 17 (1996), 886-905, through faer, on the parts that are left when a large graph
//! is bisected along levels of breadth-first search (A. George, "Nested dissection of a regular
//! finite element mesh", SIAM J. Numer. Anal. 10 (1973), 345-363). The parts are ordered in parallel
//! and give the elimination tree branches of equal weight.

use super::cholesky::buffer;
use crate::control::{Cancelled, Watch};
use crate::memory::{self, CollectVec};
use faer::dyn_stack::MemStack;
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::amd;

/// A symmetric pattern: the neighbours of each node, without the node itself.
#[derive(Debug, Clone)]
pub(super) struct Graph {
    pub starts: Vec<u32>,
    pub neighbours: Vec<u32>,
}

impl Graph {
    pub(super) fn len(&self) -> usize {
        self.starts.len() - 1
    }

    pub(super) fn neighbours(&self, node: usize) -> &[u32] {
        &self.neighbours[self.starts[node] as usize..self.starts[node + 1] as usize]
    }

    /// The graph of these nodes alone, numbered as they come. `place` is scratch as long as the graph.
    fn induced(&self, nodes: &[u32], place: &mut [u32]) -> Self {
        nodes.iter().enumerate().for_each(|(k, &node)| place[node as usize] = k as u32);
        let mut part = Self { starts: vec![0], neighbours: Vec::new() };
        for &node in nodes {
            let inside = self.neighbours(node as usize).iter().map(|&other| place[other as usize]);
            memory::extend(&mut part.neighbours, inside.filter(|&other| other != NONE));
            memory::push(&mut part.starts, part.neighbours.len() as u32);
        }
        nodes.iter().for_each(|&node| place[node as usize] = NONE);
        part
    }
}

const NONE: u32 = u32::MAX;

/// Smaller graphs are not bisected: minimum degree alone orders them better.
const LEAST_BISECTED: usize = 16_384;
/// A graph is not bisected if the separator would take a larger share of its nodes: it has no
/// narrow waist and the dense separator would cost more than it saves.
const WIDEST_SEPARATOR: f64 = 0.02;

/// `order[k]` is the node to eliminate k-th. Parallel on the rayon pool it is called in; the order
/// does not depend on the number of threads.
pub(super) fn fill_reducing_order(graph: &Graph, watch: &Watch) -> Result<Vec<u32>, Cancelled> {
    watch.check()?;
    if graph.len() < LEAST_BISECTED {
        return Ok(minimum_degree(graph));
    }
    let Some([left, right, separator]) = bisect(graph) else { return Ok(minimum_degree(graph)) };
    let mut place = memory::filled(NONE, graph.len());
    let (left_graph, right_graph) = (graph.induced(&left, &mut place), graph.induced(&right, &mut place));
    let (left_order, right_order) =
        rayon::join(|| fill_reducing_order(&left_graph, watch), || fill_reducing_order(&right_graph, watch));
    let (left_order, right_order) = (left_order?, right_order?);
    let left = left_order.iter().map(|&k| left[k as usize]);
    let right = right_order.iter().map(|&k| right[k as usize]);
    Ok(left.chain(right).chain(separator).collect_vec())
}

/// Two parts without a common edge and the nodes between them; none if there is no narrow waist.
fn bisect(graph: &Graph) -> Option<[Vec<u32>; 3]> {
    let far = *breadth_first(graph, 0).0.last()?;
    let (_, levels) = breadth_first(graph, far);
    let depth = levels.iter().copied().filter(|&level| level != NONE).max()? as usize;
    let mut counts = memory::filled(0_usize, depth + 1);
    levels.iter().filter(|&&level| level != NONE).for_each(|&level| counts[level as usize] += 1);
    let mut before = 0;
    let mut cut: Option<(usize, usize)> = None; // the narrowest level of those near the middle
    for (level, &count) in counts.iter().enumerate() {
        let middle = (before + count / 2) as f64 / graph.len() as f64;
        if (0.4..0.6).contains(&middle) && cut.is_none_or(|(_, least)| count < least) {
            cut = Some((level, count));
        }
        before += count;
    }
    let (cut, width) = cut?;
    if width as f64 > WIDEST_SEPARATOR * graph.len() as f64 {
        return None;
    }
    let mut parts = [Vec::new(), Vec::new(), Vec::new()];
    for node in 0..graph.len() {
        let level = levels[node] as usize;
        let goes_on =
            || graph.neighbours(node).iter().any(|&other| levels[other as usize] as usize == cut + 1);
        // nodes out of reach have the level NONE and go right; of the cut's nodes those that
        // touch nothing further go left
        let part = if level > cut {
            1
        } else if level == cut && goes_on() {
            2
        } else {
            0
        };
        memory::push(&mut parts[part], node as u32);
    }
    Some(parts)
}

/// Nodes in the order they are met from `start`, and the level of each.
fn breadth_first(graph: &Graph, start: u32) -> (Vec<u32>, Vec<u32>) {
    let mut levels = memory::filled(NONE, graph.len());
    levels[start as usize] = 0;
    let mut queue = vec![start];
    let mut next = 0;
    while next < queue.len() {
        let node = queue[next] as usize;
        next += 1;
        for &other in graph.neighbours(node) {
            if levels[other as usize] == NONE {
                levels[other as usize] = levels[node] + 1;
                queue.push(other);
            }
        }
    }
    (queue, levels)
}

/// Approximate minimum degree.
fn minimum_degree(graph: &Graph) -> Vec<u32> {
    let n = graph.len();
    let (mut order, mut position) = (memory::filled(0_u32, n), memory::filled(0_u32, n));
    let pattern = SymbolicSparseColMatRef::new_checked(n, n, &graph.starts, None, &graph.neighbours);
    let mut memory = buffer(amd::order_scratch::<u32>(n, graph.neighbours.len()));
    amd::order(&mut order, &mut position, pattern, amd::Control::default(), MemStack::new(&mut memory))
        .expect("the pattern has fewer than 2^31 entries");
    order
}
