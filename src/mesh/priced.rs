//! Nodes in the order of what they cost, for heaps.

use std::cmp::Ordering;

/// A node and its cost: of a collapse of it or onto it, of a way to it. In increasing order of cost; ties go to the smaller node.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Priced {
    pub cost: f64,
    pub node: u32,
}

impl Eq for Priced {}

impl Ord for Priced {
    fn cmp(&self, other: &Self) -> Ordering {
        self.cost.total_cmp(&other.cost).then(self.node.cmp(&other.node))
    }
}

impl PartialOrd for Priced {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
