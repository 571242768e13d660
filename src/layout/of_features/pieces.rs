//! Curved regions as open surfaces: each is cut out of the mesh along the chains around it and those that end inside.

use super::FeatureLayoutError;
use crate::mesh::{Chain, Features, HalfEdge, Mesh, Regions};
use std::collections::BTreeMap;

/// A chain with the lengths along it.
#[derive(Debug, Clone)]
pub(super) struct Line {
    pub nodes: Vec<u32>,
    pub is_closed: bool,
    /// The length up to each node, and of a closed chain up to the first again.
    pub starts: Vec<f64>,
}

impl Line {
    pub(super) fn new(mesh: &Mesh, chain: &Chain) -> Self {
        let mut starts = vec![0.0];
        let place = |k: usize| mesh.points()[chain.nodes[k % chain.nodes.len()] as usize];
        for k in 1..chain.nodes.len() + usize::from(chain.is_closed) {
            starts.push(starts[k - 1] + place(k - 1).distance(place(k)));
        }
        Self { nodes: chain.nodes.clone(), is_closed: chain.is_closed, starts }
    }

    pub(super) fn length(&self) -> f64 {
        self.starts[self.starts.len() - 1]
    }

    /// Edges of the mesh along it.
    pub(super) fn edge_count(&self) -> usize {
        self.starts.len() - 1
    }
}

/// A chain as a side of a region: once along the loop, with the region on the left.
#[derive(Debug, Clone)]
pub(super) struct Run {
    pub chain: u32,
    pub is_forward: bool,
    /// Nodes of the piece from one end to the other; of a closed chain the first node again at the end.
    pub nodes: Vec<u32>,
    /// The length along the chain of each of them.
    pub lengths: Vec<f64>,
}

/// A region as an open surface by itself.
#[derive(Debug, Clone)]
pub(super) struct Sheet {
    pub region: u32,
    pub mesh: Mesh,
    pub loops: Vec<Vec<Run>>,
}

/// A region cut out of the mesh.
#[derive(Debug, Clone)]
pub(super) struct Piece {
    pub sheet: Sheet,
    /// By node: which one of the whole mesh it is.
    pub nodes: Vec<u32>,
    /// By triangle the same.
    pub triangles: Vec<u32>,
}

/// The pieces of some regions.
pub(super) fn pieces(
    mesh: &Mesh,
    features: &Features,
    regions: &Regions,
    lines: &[Line],
    has_patches: &[bool],
) -> Result<Vec<Piece>, FeatureLayoutError> {
    let place_of_edge = places_of_edges(&features.chains);
    let is_feature = |edge: HalfEdge| {
        let [a, b] = [edge.origin(mesh.triangles()), edge.target(mesh.triangles())];
        place_of_edge.contains_key(&[a.min(b), a.max(b)])
    };
    let mut pieces = Vec::new();
    for (region, part) in (0..).zip(&regions.regions).filter(|&(region, _)| has_patches[region as usize]) {
        let cut = mesh.cut_out(&part.triangles, is_feature)?;
        let mut loops = Vec::new();
        for nodes in cut.mesh.loops() {
            loops.push(runs(nodes, &cut.nodes, lines, &place_of_edge));
        }
        let sheet = Sheet { region, mesh: cut.mesh, loops };
        pieces.push(Piece { sheet, nodes: cut.nodes, triangles: part.triangles.clone() });
    }
    Ok(pieces)
}

/// By edge of the mesh, the smaller node first: the chain it lies on.
fn places_of_edges(chains: &[Chain]) -> BTreeMap<[u32; 2], u32> {
    let mut places = BTreeMap::new();
    for (number, chain) in (0..).zip(chains) {
        let count = chain.nodes.len();
        for k in 0..count - usize::from(!chain.is_closed) {
            let [a, b] = [chain.nodes[k], chain.nodes[(k + 1) % count]];
            places.insert([a.min(b), a.max(b)], number);
        }
    }
    places
}

/// A loop of a piece, chain by chain.
fn runs(nodes: &[u32], old: &[u32], lines: &[Line], chain_of_edge: &BTreeMap<[u32; 2], u32>) -> Vec<Run> {
    let count = nodes.len();
    let old = |k: usize| old[nodes[k % count] as usize];
    let chain = |k: usize| chain_of_edge[&[old(k).min(old(k + 1)), old(k).max(old(k + 1))]];
    let mut runs = Vec::new();
    // from the first edge that begins a chain, in either direction
    let place = |k: usize| {
        let line = &lines[chain(k) as usize];
        let at = line.nodes.iter().position(|&node| node == old(k)).expect("nodes of its chain");
        let last = line.nodes.len() - 1;
        let next = |step: usize| line.nodes[(at + step) % line.nodes.len()];
        // in a chain of one edge from both ends the same; there the first node decides
        let is_forward = match line.is_closed {
            true => next(1) == old(k + 1),
            false => at < last && next(1) == old(k + 1),
        };
        (at, is_forward)
    };
    // a chain from a corner to itself has one node at both ends
    let begins = |k: usize| {
        let line = &lines[chain(k) as usize];
        match place(k) {
            (at, true) => at == 0,
            (at, false) if line.is_closed => at == 0,
            (_, false) => line.nodes.last() == Some(&old(k)),
        }
    };
    let start = (0..count).find(|&k| begins(k)).expect("chains end in corners, or are closed");
    let mut k = start;
    while k < start + count {
        let (chain, (_, is_forward)) = (chain(k), place(k));
        let line = &lines[chain as usize];
        let edges = line.edge_count();
        let lengths = |j: usize| if is_forward { line.starts[j] } else { line.starts[edges - j] };
        runs.push(Run {
            chain,
            is_forward,
            nodes: (0..=edges).map(|j| nodes[(k + j) % count]).collect(),
            lengths: (0..=edges).map(lengths).collect(),
        });
        k += edges;
    }
    runs
}
