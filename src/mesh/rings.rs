//! A closed mesh as the rings of its nodes: what half-edge collapses need, and their undoing.
//!
//! The ring of a node is its neighbours, counter-clockwise, from any of them on. Moving v on to u:
//! ```text
//!         q3 --- q2                q3 --- q2
//!        /  \   /  \              /  \    | \      v has the ring u, q1, q2, .., q(d-1).
//!      q4 --- v --- q1    ->    q4 -. \   |  q1    u gets q2 .. q(d-2) for v, q1 and q(d-1) lose it,
//!        \    |    /              \   `-\ | /      the others get u for it.
//!          `- u -'                  `---- u
//! ```
//! The ring of v stays as it was, beginning with u, until [`Rings::expand`] brings v back; collapses are undone in
//! the reverse order.

use super::Mesh;
use crate::memory::{self, CollectVec};

/// Neighbours of each node of a closed mesh, counter-clockwise.
#[derive(Debug, Clone)]
pub(crate) struct Rings {
    rings: Vec<Vec<u32>>,
}

impl Rings {
    /// Of a mesh without boundary and pinched nodes; nodes without triangles have an empty ring.
    pub(crate) fn new(mesh: &Mesh) -> Self {
        Self {
            rings: (0..mesh.points().len() as u32)
                .map(|node| mesh.neighbours(node).collect_vec())
                .collect_vec(),
        }
    }

    /// The neighbours of a node; of a collapsed one those it had, the node it went to first.
    pub(crate) fn of(&self, node: u32) -> &[u32] {
        &self.rings[node as usize]
    }

    /// Edges at a node.
    pub(crate) fn valence(&self, node: u32) -> usize {
        self.rings[node as usize].len()
    }

    /// Where `neighbour` stands in the ring of `node`.
    pub(crate) fn position(&self, node: u32, neighbour: u32) -> usize {
        let place = self.of(node).iter().position(|&other| other == neighbour);
        place.expect("only asked for neighbours")
    }

    /// Moves `from` on to its neighbour `to`. The link condition must hold: the two have exactly two common neighbours,
    /// each of more than three edges.
    pub(crate) fn collapse(&mut self, from: u32, to: u32) {
        let first = self.position(from, to);
        let mut ring = std::mem::take(&mut self.rings[from as usize]);
        ring.rotate_left(first);
        let last = ring.len() - 1;
        let place = self.position(to, from);
        self.rings[to as usize].splice(place..=place, ring[2..last].iter().copied());
        for side in [ring[1], ring[last]] {
            let place = self.position(side, from);
            self.rings[side as usize].remove(place);
        }
        for &node in &ring[2..last] {
            let place = self.position(node, from);
            self.rings[node as usize][place] = to;
        }
        self.rings[from as usize] = ring;
    }

    /// Undoes the collapse of `node`, the latest that is not undone.
    pub(crate) fn expand(&mut self, node: u32) {
        let ring = std::mem::take(&mut self.rings[node as usize]);
        let (to, last) = (ring[0], ring.len() - 1);
        let after = self.position(to, ring[1]) + 1;
        let around = &mut self.rings[to as usize];
        let len = around.len();
        around.rotate_left(after % len);
        around.splice(0..ring.len() - 3, [node]);
        for (side, offset) in [(ring[1], 0), (ring[last], 1)] {
            let place = self.position(side, to);
            self.rings[side as usize].insert(place + offset, node);
        }
        for &other in &ring[2..last] {
            let place = self.position(other, to);
            self.rings[other as usize][place] = node;
        }
        self.rings[node as usize] = ring;
    }

    /// Nodes in classes whose nodes are not neighbours of one another. First fit: few classes, on planar graphs no more
    /// than in proportion to the logarithm of the nodes (S. Irani, "Coloring inductive graphs on-line", 1994).
    pub(crate) fn coloured(&self, nodes: &[u32]) -> Vec<Vec<u32>> {
        const NONE: u8 = u8::MAX;
        let mut colours = memory::filled(NONE, self.rings.len());
        let mut classes: Vec<Vec<u32>> = Vec::new();
        for &node in nodes {
            let around = self.of(node).iter().map(|&other| colours[other as usize]);
            let taken =
                around.filter(|&colour| colour != NONE).fold(0_u128, |taken, colour| taken | 1 << colour);
            let colour = taken.trailing_ones() as usize;
            colours[node as usize] = colour as u8;
            if colour == classes.len() {
                memory::push(&mut classes, Vec::new());
            }
            memory::push(&mut classes[colour], node);
        }
        classes
    }
}

/// Marks the ring of one node, to ask quickly how many neighbours it has in common with others.
#[derive(Debug)]
pub(crate) struct RingMarks {
    marks: Vec<u32>,
    tick: u32,
}

impl RingMarks {
    pub(crate) fn new(node_count: usize) -> Self {
        Self { marks: memory::filled(0, node_count), tick: 0 }
    }

    /// Marks these nodes, and no other.
    pub(crate) fn mark(&mut self, ring: &[u32]) {
        if self.tick == u32::MAX {
            self.marks.fill(0);
            self.tick = 0;
        }
        self.tick += 1;
        ring.iter().for_each(|&node| self.marks[node as usize] = self.tick);
    }

    /// How many of these nodes are marked.
    pub(crate) fn count(&self, ring: &[u32]) -> usize {
        ring.iter().filter(|&&node| self.marks[node as usize] == self.tick).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples;

    /// Each ring beginning with its smallest node.
    fn canonical(rings: &Rings, nodes: impl Iterator<Item = u32>) -> Vec<Vec<u32>> {
        nodes
            .map(|node| {
                let mut ring = rings.of(node).to_vec();
                let least = ring.iter().enumerate().min_by_key(|&(_, &other)| other).map_or(0, |(k, _)| k);
                ring.rotate_left(least);
                ring
            })
            .collect()
    }

    #[test]
    fn expanding_undoes_collapses() {
        let mesh = samples::ball(300, 1).unwrap();
        let mut rings = Rings::new(&mesh);
        let count = mesh.points().len() as u32;
        let before = canonical(&rings, 0..count);
        let mut marks = RingMarks::new(count as usize);
        let mut gone = Vec::new();
        for node in 0..count {
            marks.mark(rings.of(node));
            let ring = rings.of(node);
            let fits = |k: usize| {
                let sides = [ring[(k + 1) % ring.len()], ring[(k + ring.len() - 1) % ring.len()]];
                marks.count(rings.of(ring[k])) == 2 && sides.iter().all(|&side| rings.valence(side) > 3)
            };
            if let Some(k) = (0..ring.len()).find(|&k| fits(k)) {
                let to = ring[k];
                rings.collapse(node, to);
                gone.push(node);
            }
        }
        assert!(gone.len() > 250, "{} collapses", gone.len());
        // a sphere all the while: n - e + f = 2 and 2 e = 3 f
        let left = || (0..count).filter(|node| !gone.contains(node));
        assert_eq!(left().map(|node| rings.valence(node)).sum::<usize>(), 6 * (left().count() - 2));
        while let Some(node) = gone.pop() {
            rings.expand(node);
        }
        assert_eq!(canonical(&rings, 0..count), before);
    }

    #[test]
    fn neighbours_differ_in_colour() {
        let mesh = samples::ball(500, 2).unwrap();
        let rings = Rings::new(&mesh);
        let nodes: Vec<u32> = (0..mesh.points().len() as u32).collect();
        let classes = rings.coloured(&nodes);
        assert!(classes.len() <= 8);
        assert_eq!(classes.iter().map(Vec::len).sum::<usize>(), nodes.len());
        for class in &classes {
            assert!(class.iter().all(|&node| !class.iter().any(|other| rings.of(node).contains(other))));
        }
    }
}
