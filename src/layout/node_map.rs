//! Where the nodes of a mesh lie on a layout.

use super::Place;
use crate::mesh::Middles;

/// A place on a layout for each node of a mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct NodeMap {
    places: Vec<Option<Place>>,
    /// Nodes of the mesh; the places of middles of its edges follow.
    count: usize,
    middles: Middles,
}

impl NodeMap {
    /// From places by node; none for nodes without triangles.
    pub fn new(places: Vec<Option<Place>>) -> Self {
        Self { count: places.len(), places, middles: Middles::default() }
    }

    /// The same for the first `count` nodes of a mesh whose others are middles of edges: on triangles too large for the
    /// patches these say where a place is.
    pub(crate) fn with_middles(places: Vec<Option<Place>>, count: usize, middles: Middles) -> Self {
        Self { places, count, middles }
    }

    /// By node; none for a node without triangles.
    pub fn places(&self) -> &[Option<Place>] {
        &self.places[..self.count]
    }

    /// The place of a node.
    pub fn place(&self, node: u32) -> Option<Place> {
        self.places[node as usize]
    }

    /// By node, middles too.
    pub(crate) fn all_places(&self) -> &[Option<Place>] {
        &self.places
    }

    /// The same mean of two or three nodes by the nodes of the finest triangle around it.
    pub(crate) fn finest(&self, nodes: &[u32], shares: &[f64]) -> (Vec<u32>, Vec<f64>) {
        let (mut nodes, mut shares) = (nodes.to_vec(), shares.to_vec());
        while let Some(finer) = self.finer(&nodes, &shares) {
            (nodes, shares) = finer;
        }
        (nodes, shares)
    }

    fn finer(&self, nodes: &[u32], shares: &[f64]) -> Option<(Vec<u32>, Vec<f64>)> {
        let count = nodes.len();
        let middle = |k: usize, l: usize| self.middles.between(nodes[k], nodes[l]);
        // the triangle at a node has half of its edges; of the one in the middle each corner is opposite to a node
        let at_node = shares.iter().position(|&share| share >= 0.5);
        let finer = |k: usize| match at_node {
            Some(near) if near == k => Some((nodes[k], 2.0 * shares[k] - 1.0)),
            Some(near) => Some((middle(near, k)?, 2.0 * shares[k])),
            None => Some((middle((k + 1) % 3, (k + 2) % 3)?, 1.0 - 2.0 * shares[k])),
        };
        match count {
            2 | 3 => (0..count).map(finer).collect::<Option<Vec<_>>>().map(|pairs| pairs.into_iter().unzip()),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::{Random, ball};
    use glam::DVec3;

    #[test]
    fn finer_triangles_have_the_same_mean() {
        let mesh = ball(60, 1).unwrap();
        let (fine, middles) = mesh.halved(3).unwrap();
        let map = NodeMap::with_middles(vec![None; fine.points().len()], mesh.points().len(), middles);
        let mut random = Random::new(1);
        for triangle in mesh.triangles() {
            let shares = [random.unit(), random.unit(), random.unit()];
            let sum: f64 = shares.iter().sum();
            let shares = shares.map(|share| share / sum);
            for (nodes, shares) in
                [(&triangle[..], &shares[..]), (&triangle[..2], &[0.3, 0.7][..]), (&triangle[1..], &[0.5; 2])]
            {
                let mean = |(nodes, shares): (&[u32], &[f64])| -> DVec3 {
                    nodes.iter().zip(shares).map(|(&node, &share)| share * fine.points()[node as usize]).sum()
                };
                let (finest, parts) = map.finest(nodes, shares);
                assert!(parts.iter().all(|part| *part >= 0.0), "{parts:?}");
                // three levels, each a few roundings of points of length 1 at most, doubled by the next
                let off = mean((&finest, &parts)).distance(mean((nodes, shares)));
                assert!(off <= 64.0 * f64::EPSILON, "{off:e}");
                let longest = |nodes: &[u32]| {
                    let ends = nodes.iter().flat_map(|&a| nodes.iter().map(move |&b| (a, b)));
                    ends.map(|(a, b)| fine.points()[a as usize].distance(fine.points()[b as usize]))
                        .fold(0.0, f64::max)
                };
                assert!(longest(&finest) <= longest(triangle) / 8.0 * (1.0 + 1e-12));
            }
        }
    }
}
