//! The regions of a mesh between its features.
//!
//! ```text
//!   c ---<--- c     A region hangs together by edges that are no features. Its loops run with the region on the left,
//!   |    A    |     one side after the other: a whole chain from corner to corner, along it or against it. A chain
//!   v   d-x   ^     that ends inside (d x) does not separate: the loop runs along both its sides. On the border a
//!   |     |   |     chain has a region on one side only.
//!   c -->-c->-c
//! ```

use super::super::decimate::half_edges;
use super::super::{HalfEdge, Mesh};
use super::{Chain, FeatureError, FeatureOptions, Features};
use crate::memory::{self, CollectVec};
use std::collections::BTreeMap;

/// A chain as a bound of the region on one side of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Side {
    /// The chain, by its number among the features' chains.
    pub chain: u32,
    /// Whether the region lies on the left of the chain, and its loop runs along it; else against it.
    pub is_forward: bool,
    /// The node at which the loop comes to the side: a corner, or of a closed chain its first node.
    pub from: u32,
    /// The node at which the loop leaves it.
    pub to: u32,
}

/// Triangles that hang together without crossing a feature.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Region {
    /// Its triangles, in increasing order.
    pub triangles: Vec<u32>,
    /// Its bounds, each in order with the region on the left; the longest in space first. None for a region without bound.
    pub loops: Vec<Vec<Side>>,
    /// Handles of the region, cut open along its sides.
    pub genus: usize,
}

/// The regions of a mesh.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Regions {
    /// By triangle: its region.
    pub of_triangle: Vec<u32>,
    /// By their first triangles.
    pub regions: Vec<Region>,
    /// By chain: the region on its left and that on its right; none beyond the border.
    pub beside: Vec<[Option<u32>; 2]>,
}

impl Regions {
    /// The region on the other side of a side; the same one along a chain that does not separate, none at the border.
    pub fn across(&self, side: &Side) -> Option<u32> {
        self.beside[side.chain as usize][usize::from(side.is_forward)]
    }

    /// The other regions beside a region, each once, in increasing order.
    pub fn neighbours(&self, region: u32) -> Vec<u32> {
        let sides = self.regions[region as usize].loops.iter().flatten();
        let mut neighbours: Vec<u32> =
            sides.filter_map(|side| self.across(side)).filter(|&other| other != region).collect_vec();
        neighbours.sort_unstable();
        neighbours.dedup();
        neighbours
    }

    /// Noise along the normal away from the bounds of regions, as standard deviation by mean edge length: an estimate, 0
    /// if no region is so large.
    pub fn noise(&self, mesh: &Mesh) -> f64 {
        let region = |edge: HalfEdge| self.of_triangle[edge.triangle()];
        super::noise::estimate_of(mesh, |node| {
            let mut around = mesh.outgoing(node).map(region);
            around.next().is_some_and(|first| around.all(|other| other == first))
        })
    }

    /// Whether a chain has the same region on both sides.
    pub fn is_inside(&self, chain: u32) -> bool {
        let [left, right] = self.beside[chain as usize];
        left.is_some() && left == right
    }
}

/// How the triangles of a label hang together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LabelParts {
    /// The label.
    pub label: u32,
    /// Its triangles.
    pub triangle_count: usize,
    /// Pieces that share no edge: a face has one.
    pub pieces: usize,
    /// Handles of all pieces: a face has none.
    pub handles: usize,
}

impl Mesh {
    /// How each label hangs together, in increasing order of the labels; one label for each triangle.
    pub fn label_parts(&self, labels: &[u32]) -> Result<Vec<LabelParts>, FeatureError> {
        if labels.is_empty() {
            return Ok(Vec::new());
        }
        let options = FeatureOptions::default()
            .with_sharp_angle(None)
            .with_least_length(0.0)
            .with_filter_noise(false)
            .with_labels(labels);
        let regions = self.find_features(&options)?.regions(self).regions;
        let mut parts: BTreeMap<u32, LabelParts> = BTreeMap::new();
        for (&label, Region { triangles, genus, .. }) in
            regions.iter().filter_map(|region| Some((labels.get(region.triangles[0] as usize)?, region)))
        {
            let empty = LabelParts { label, triangle_count: 0, pieces: 0, handles: 0 };
            let of = parts.entry(label).or_insert(empty);
            of.triangle_count += triangles.len();
            of.pieces += 1;
            of.handles += genus;
        }
        Ok(parts.into_values().collect())
    }
}

/// Where a half-edge lies on a chain.
#[derive(Clone, Copy)]
struct On {
    chain: u32,
    is_forward: bool,
    /// Whether it is the first of its side.
    is_first: bool,
}

impl Features {
    /// The regions of the mesh whose features these are. Edges that the mesh does not have bound nothing.
    pub fn regions(&self, mesh: &Mesh) -> Regions {
        let on = on_chains(mesh, &self.chains);
        let (of_triangle, count) = flooded(mesh, &on);
        let mut regions =
            memory::filled(Region { triangles: Vec::new(), loops: Vec::new(), genus: 0 }, count);
        for (triangle, &region) in (0..).zip(&of_triangle) {
            regions[region as usize].triangles.push(triangle);
        }
        let mut beside = memory::filled([None; 2], self.chains.len());
        for (edge, on) in half_edges(mesh).zip(&on) {
            if let Some(on) = on {
                beside[on.chain as usize][usize::from(!on.is_forward)] = Some(of_triangle[edge.triangle()]);
            }
        }
        for Bound { region, sides, .. } in bounds(mesh, &on, &self.chains, &of_triangle) {
            regions[region as usize].loops.push(sides);
        }
        count_handles(mesh, &on, &of_triangle, &mut regions);
        Regions { of_triangle, regions, beside }
    }
}

/// By half-edge: the chain it lies on.
fn on_chains(mesh: &Mesh, chains: &[Chain]) -> Vec<Option<On>> {
    let mut on = memory::filled(None, 3 * mesh.triangles().len());
    for (number, chain) in (0..).zip(chains) {
        let edges = edges(chain);
        let last = edges.len().saturating_sub(1);
        for (place, [from, to]) in edges.into_iter().enumerate() {
            let Some(edge) = mesh.edge_between(from, to) else { continue };
            for side in [Some(edge), mesh.topology().twin(edge)].into_iter().flatten() {
                let is_forward = side.origin(mesh.triangles()) == from;
                let is_first = place == if is_forward { 0 } else { last };
                on[side.index()] = Some(On { chain: number, is_forward, is_first });
            }
        }
    }
    on
}

fn edges(chain: &Chain) -> Vec<[u32; 2]> {
    let nodes = &chain.nodes;
    let closing = chain.is_closed.then(|| [nodes[nodes.len() - 1], nodes[0]]);
    nodes.windows(2).map(|pair| [pair[0], pair[1]]).chain(closing).collect_vec()
}

/// The region of each triangle, and how many there are.
fn flooded(mesh: &Mesh, on: &[Option<On>]) -> (Vec<u32>, usize) {
    const NONE: u32 = u32::MAX;
    let mut of_triangle = memory::filled(NONE, mesh.triangles().len());
    let (mut count, mut stack) = (0, Vec::new());
    for seed in 0..of_triangle.len() {
        if of_triangle[seed] != NONE {
            continue;
        }
        of_triangle[seed] = count;
        stack.push(seed);
        while let Some(triangle) = stack.pop() {
            let sides = [0, 1, 2].map(|corner| HalfEdge::new(triangle, corner));
            for edge in sides.into_iter().filter(|edge| on[edge.index()].is_none()) {
                let Some(next) = mesh.topology().twin(edge).map(HalfEdge::triangle) else { continue };
                if of_triangle[next] == NONE {
                    of_triangle[next] = count;
                    stack.push(next);
                }
            }
        }
        count += 1;
    }
    (of_triangle, count as usize)
}

/// A loop of a region.
struct Bound {
    region: u32,
    length: f64,
    sides: Vec<Side>,
}

/// The loops of all regions, by region and then the longest first.
fn bounds(mesh: &Mesh, on: &[Option<On>], chains: &[Chain], of_triangle: &[u32]) -> Vec<Bound> {
    let triangles = mesh.triangles();
    let place = |node: u32| mesh.points()[node as usize];
    let mut is_seen = memory::filled(false, on.len());
    let mut bounds = Vec::new();
    for start in half_edges(mesh) {
        let (mut sides, mut length) = (Vec::new(), 0.0);
        let mut edge = start;
        while let Some(at) = on[edge.index()].filter(|_| !is_seen[edge.index()]) {
            is_seen[edge.index()] = true;
            length += place(edge.origin(triangles)).distance(place(edge.target(triangles)));
            if at.is_first {
                sides.push(side(at, &chains[at.chain as usize]));
            }
            edge = next_feature(mesh, on, edge);
        }
        if !sides.is_empty() {
            bounds.push(Bound { region: of_triangle[start.triangle()], length, sides });
        }
    }
    // the sort is stable: loops of one length stay in the order of their first half-edges
    bounds.sort_by(|a, b| a.region.cmp(&b.region).then(b.length.total_cmp(&a.length)));
    bounds
}

fn side(at: On, chain: &Chain) -> Side {
    let first = chain.nodes[0];
    let last = if chain.is_closed { first } else { chain.nodes[chain.nodes.len() - 1] };
    let [from, to] = if at.is_forward { [first, last] } else { [last, first] };
    Side { chain: at.chain, is_forward: at.is_forward, from, to }
}

/// The next half-edge of a loop: the first feature met when turning clockwise about the target, inside the region.
fn next_feature(mesh: &Mesh, on: &[Option<On>], edge: HalfEdge) -> HalfEdge {
    let mut next = edge.next();
    while on[next.index()].is_none()
        && let Some(twin) = mesh.topology().twin(next)
    {
        next = twin.next();
    }
    next
}

/// Handles by Euler's formula on each region, cut open: triangles at a node between two features are a node of its own,
/// so there are as many nodes on the bounds as edges.
fn count_handles(mesh: &Mesh, on: &[Option<On>], of_triangle: &[u32], regions: &mut [Region]) {
    let mut inner_nodes = memory::filled(0_i64, regions.len());
    for node in 0..mesh.points().len() as u32 {
        for start in mesh.topology().fans(node) {
            let is_plain =
                |edge: HalfEdge| on[edge.index()].is_none() && on[edge.previous().index()].is_none();
            if mesh.topology().fan_from(start).all(is_plain) {
                inner_nodes[of_triangle[start.triangle()] as usize] += 1;
            }
        }
    }
    let mut side_counts = memory::filled(0_i64, regions.len());
    for edge in half_edges(mesh).filter(|edge| on[edge.index()].is_some()) {
        side_counts[of_triangle[edge.triangle()] as usize] += 1;
    }
    for ((region, nodes), sides) in regions.iter_mut().zip(inner_nodes).zip(side_counts) {
        let triangles = region.triangles.len() as i64;
        let characteristic = nodes - (3 * triangles - sides) / 2 + triangles;
        region.genus = ((2 - region.loops.len() as i64 - characteristic) / 2).max(0) as usize;
    }
}
