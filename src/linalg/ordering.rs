//! Fill-reducing orders of a symmetric pattern.
//!
//! P. Amestoy, T. Davis, I. Duff, "An approximate minimum degree ordering algorithm", SIAM J.
//! Matrix Anal. Appl. 17 (1996), 886-905; through faer.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::amd;

/// A symmetric pattern: the neighbours of each node, without the node itself.
#[derive(Debug, Clone)]
pub(super) struct Graph {
    pub starts: Vec<u32>,
    pub neighbours: Vec<u32>,
}

impl Graph {
    pub fn len(&self) -> usize {
        self.starts.len() - 1
    }

    pub fn neighbours(&self, node: usize) -> &[u32] {
        &self.neighbours[self.starts[node] as usize..self.starts[node + 1] as usize]
    }
}

/// Approximate minimum degree; `order[k]` is the node to eliminate k-th.
pub(super) fn fill_reducing_order(graph: &Graph) -> Vec<u32> {
    let n = graph.len();
    let (mut order, mut position) = (vec![0_u32; n], vec![0_u32; n]);
    let pattern = SymbolicSparseColMatRef::new_checked(n, n, &graph.starts, None, &graph.neighbours);
    let scratch = amd::order_scratch::<u32>(n, graph.neighbours.len());
    let mut memory = MemBuffer::new(scratch);
    amd::order(&mut order, &mut position, pattern, amd::Control::default(), MemStack::new(&mut memory))
        .expect("the pattern has fewer than 2^31 entries");
    order
}
