//! How the triangles of a mesh hang together.
//!
//! Triangle t with the nodes (a, b, c) has three half-edges, 3t from a to b, 3t + 1 from b to c, 3t + 2 from
//! c to a; the triangle is on their left. Where two triangles meet, their half-edges are twins.
//! ```text
//!            x            o = v -> w, previous(o) = x -> v
//!          / | \          twin(previous(o)) = v -> x leaves v in the next triangle,
//!        /   |   \        counter-clockwise. The triangles met in this way are a *fan*.
//!      y --- v --- w      A node of two or more fans is *pinched*.
//! ```
//! Edges are paired by a counting sort over their smaller node: linear time, no hash table.

use super::error::MeshError;
use crate::memory::{self, CollectVec};

/// Stands for "no half-edge" in the arrays.
const NONE: u32 = u32::MAX;

/// Most triangles of one mesh: a half-edge and one bit for its direction share 32 bits while edges are paired.
pub(super) const MAX_TRIANGLES: usize = (1 << 31) / 3;

/// One side of one edge: the edge that leaves corner `h % 3` of triangle `h / 3`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct HalfEdge(u32);

impl HalfEdge {
    /// The half-edge from corner `corner` (0, 1 or 2) of `triangle` to the next corner.
    pub fn new(triangle: usize, corner: usize) -> Self {
        Self((3 * triangle + corner) as u32)
    }

    /// Its number, 3 * triangle + corner.
    pub fn index(self) -> usize {
        self.0 as usize
    }

    /// The triangle on its left.
    pub fn triangle(self) -> usize {
        self.0 as usize / 3
    }

    /// The corner it leaves.
    pub fn corner(self) -> usize {
        self.0 as usize % 3
    }

    /// The one after it in its triangle.
    pub fn next(self) -> Self {
        Self(if self.0 % 3 == 2 { self.0 - 2 } else { self.0 + 1 })
    }

    /// The one before it in its triangle.
    pub fn previous(self) -> Self {
        Self(if self.0.is_multiple_of(3) { self.0 + 2 } else { self.0 - 1 })
    }

    /// The node it leaves.
    pub fn origin(self, triangles: &[[u32; 3]]) -> u32 {
        triangles[self.triangle()][self.corner()]
    }

    /// The node it goes to.
    pub fn target(self, triangles: &[[u32; 3]]) -> u32 {
        self.next().origin(triangles)
    }
}

/// Twins and fans of a mesh.
#[derive(Debug, PartialEq)]
pub struct Topology {
    /// By half-edge; NONE on the boundary.
    twins: Vec<u32>,
    /// By node: the most clockwise half-edge of its first fan; NONE for a node without triangles.
    fans: Vec<u32>,
    /// (node, half-edge) of the second and further fans of pinched nodes, by node.
    further_fans: Vec<(u32, u32)>,
    boundary_edge_count: usize,
}

impl Clone for Topology {
    fn clone(&self) -> Self {
        let Self { twins, fans, further_fans, boundary_edge_count } = self;
        Self {
            twins: memory::copied(twins),
            fans: memory::copied(fans),
            further_fans: memory::copied(further_fans),
            boundary_edge_count: *boundary_edge_count,
        }
    }
}

impl Topology {
    /// Pairs the edges of `triangles`, whose nodes are below `node_count`.
    pub(super) fn new(triangles: &[[u32; 3]], node_count: usize) -> Result<Self, MeshError> {
        let Pairing { mates: twins, clash, crowded } = Pairing::new(triangles, node_count);
        if let Some(&CrowdedEdge { nodes, triangle_count }) = crowded.first() {
            let error = MeshError::NonManifoldEdge { nodes, triangle_count };
            return Err(duplicate(triangles).unwrap_or(error));
        }
        if let Some(half_edges) = clash {
            return Err(duplicate(triangles).unwrap_or_else(|| inconsistent(triangles, half_edges)));
        }
        // two triangles with two common edges have three; anything else was caught above
        let double =
            (0..triangles.len()).find(|&t| twins[3 * t] != NONE && twins[3 * t] / 3 == twins[3 * t + 1] / 3);
        if let Some(t) = double {
            return Err(MeshError::DuplicateTriangle { triangle: twins[3 * t] as usize / 3, first: t });
        }
        let (fans, further_fans) = find_fans(triangles, &twins, node_count);
        let boundary_edge_count = twins.iter().filter(|&&twin| twin == NONE).count();
        Ok(Self { twins, fans, further_fans, boundary_edge_count })
    }

    /// The other side of the edge; none on the boundary.
    pub fn twin(&self, half_edge: HalfEdge) -> Option<HalfEdge> {
        some(self.twins[half_edge.index()])
    }

    /// The half-edge from which the node's first fan turns counter-clockwise, on the boundary if the fan is
    /// open; none for a node without triangles.
    pub fn first(&self, node: u32) -> Option<HalfEdge> {
        some(self.fans[node as usize])
    }

    /// The half-edge with which each fan of the node starts: one for most nodes, several for pinched ones.
    pub fn fans(&self, node: u32) -> impl Iterator<Item = HalfEdge> + '_ {
        let from = self.further_fans.partition_point(|&(other, _)| other < node);
        let further = self.further_fans[from..].iter().take_while(move |&&(other, _)| other == node);
        self.first(node).into_iter().chain(further.map(|&(_, half_edge)| HalfEdge(half_edge)))
    }

    /// The half-edges that leave the origin of `start`, counter-clockwise from `start` through its fan.
    pub fn fan_from(&self, start: HalfEdge) -> impl Iterator<Item = HalfEdge> + '_ {
        let turn = move |half_edge: &HalfEdge| self.twin(half_edge.previous()).filter(|&next| next != start);
        std::iter::successors(Some(start), turn)
    }

    /// Edges with one triangle.
    pub fn boundary_edge_count(&self) -> usize {
        self.boundary_edge_count
    }

    /// All edges, each counted once.
    pub fn edge_count(&self) -> usize {
        (self.twins.len() + self.boundary_edge_count) / 2
    }

    /// Nodes of more than one fan, in increasing order.
    pub fn pinched_nodes(&self) -> Vec<u32> {
        let mut nodes: Vec<u32> = self.further_fans.iter().map(|&(node, _)| node).collect_vec();
        nodes.dedup();
        nodes
    }

    /// The fans beyond the first of each node, as the node and the half-edge they start with, by node.
    pub(super) fn further_fans(&self) -> impl Iterator<Item = (u32, HalfEdge)> + '_ {
        self.further_fans.iter().map(|&(node, half_edge)| (node, HalfEdge(half_edge)))
    }

    /// Fans beyond the first of each node: how many nodes more there were if no node was pinched.
    pub(super) fn further_fan_count(&self) -> usize {
        self.further_fans.len()
    }

    /// The component of each triangle and their number; a component hangs together by edges.
    /// Components are counted by their smallest triangle.
    pub fn components(&self) -> (Vec<u32>, usize) {
        let triangle_count = self.twins.len() / 3;
        let mut labels = memory::filled(NONE, triangle_count);
        let mut count = 0;
        let mut stack = Vec::new();
        for seed in 0..triangle_count {
            if labels[seed] != NONE {
                continue;
            }
            labels[seed] = count;
            memory::push(&mut stack, seed);
            while let Some(t) = stack.pop() {
                for &twin in self.twins[3 * t..3 * t + 3].iter().filter(|&&twin| twin != NONE) {
                    let neighbour = twin as usize / 3;
                    if labels[neighbour] == NONE {
                        labels[neighbour] = count;
                        memory::push(&mut stack, neighbour);
                    }
                }
            }
            count += 1;
        }
        (labels, count as usize)
    }

    /// The boundary half-edge after `half_edge` along its loop.
    pub fn next_on_boundary(&self, half_edge: HalfEdge) -> HalfEdge {
        let mut next = half_edge.next();
        while let Some(twin) = self.twin(next) {
            next = twin.next();
        }
        next
    }

    /// The loops of boundary half-edges, by their smallest.
    pub fn boundary(&self) -> Vec<Vec<HalfEdge>> {
        let mut seen = memory::filled(false, if self.boundary_edge_count > 0 { self.twins.len() } else { 0 });
        let mut loops = Vec::new();
        for h in 0..seen.len() {
            if self.twins[h] != NONE || seen[h] {
                continue;
            }
            let mut chain = Vec::new();
            let mut half_edge = HalfEdge(h as u32);
            while !std::mem::replace(&mut seen[half_edge.index()], true) {
                memory::push(&mut chain, half_edge);
                half_edge = self.next_on_boundary(half_edge);
            }
            memory::push(&mut loops, chain);
        }
        loops
    }
}

/// Turns triangles over so that neighbours agree, as few as that takes in each component (of two equal
/// halves the one without the smallest triangle), and returns how many.
pub(super) fn orient(triangles: &mut [[u32; 3]], node_count: usize) -> Result<usize, MeshError> {
    let Pairing { mates, clash, crowded } = Pairing::new(triangles, node_count);
    // edges of more than two triangles are told when the mesh is made
    let (Some(_), true) = (clash, crowded.is_empty()) else { return Ok(0) };
    if let Some(error) = duplicate(triangles) {
        return Err(error);
    }
    // 0: not reached, 1: stays, 2: is turned, seen from the component's seed
    let mut turns = memory::filled(0u8, triangles.len());
    let mut flipped_count = 0;
    let mut component = Vec::new();
    for seed in 0..triangles.len() {
        if turns[seed] != 0 {
            continue;
        }
        turns[seed] = 1;
        component.clear();
        memory::push(&mut component, seed);
        let mut done = 0;
        while done < component.len() {
            let t = component[done];
            done += 1;
            for corner in 0..3 {
                let half_edge = HalfEdge::new(t, corner);
                let Some(mate) = some(mates[half_edge.index()]) else { continue };
                let agrees = half_edge.origin(triangles) != mate.origin(triangles);
                let turn = if agrees { turns[t] } else { 3 - turns[t] };
                match turns[mate.triangle()] {
                    0 => {
                        turns[mate.triangle()] = turn;
                        memory::push(&mut component, mate.triangle());
                    }
                    known if known == turn => {}
                    _ => return Err(one_sided(triangles, [half_edge, mate])),
                }
            }
        }
        let turned = component.iter().filter(|&&t| turns[t] == 2).count();
        let minority = if 2 * turned > component.len() { 1 } else { 2 };
        for &t in component.iter().filter(|&&t| turns[t] == minority) {
            triangles[t].swap(1, 2);
            flipped_count += 1;
        }
    }
    Ok(flipped_count)
}

fn some(half_edge: u32) -> Option<HalfEdge> {
    (half_edge != NONE).then_some(HalfEdge(half_edge))
}

/// An edge of more than two triangles.
pub(super) struct CrowdedEdge {
    /// Its ends, the smaller first.
    pub nodes: [u32; 2],
    pub triangle_count: usize,
}

/// Which half-edges lie on the same edge, whatever their directions.
pub(super) struct Pairing {
    /// The other side of each half-edge; NONE on the boundary, and at edges of more than two triangles.
    mates: Vec<u32>,
    /// The first two mates that run in the same direction.
    clash: Option<[HalfEdge; 2]>,
    /// Edges of more than two triangles, by their smaller node, then by the larger.
    pub crowded: Vec<CrowdedEdge>,
}

impl Pairing {
    pub(super) fn new(triangles: &[[u32; 3]], node_count: usize) -> Self {
        // counting sort by the smaller node: entries of node i end at ends[i]
        let mut ends = memory::filled(0u32, node_count + 1);
        for &[a, b, c] in triangles {
            for node in [a.min(b), b.min(c), c.min(a)] {
                ends[node as usize + 1] += 1;
            }
        }
        for node in 0..node_count {
            ends[node + 1] += ends[node];
        }
        // one number for each half-edge: larger node, half-edge, whether it leaves the smaller node
        let mut entries = memory::filled(0u64, 3 * triangles.len());
        for (t, &[a, b, c]) in triangles.iter().enumerate() {
            for (corner, (from, to)) in [(a, b), (b, c), (c, a)].into_iter().enumerate() {
                let place = &mut ends[from.min(to) as usize];
                let half_edge = (3 * t + corner) as u64;
                entries[*place as usize] =
                    u64::from(from.max(to)) << 32 | half_edge << 1 | u64::from(from < to);
                *place += 1;
            }
        }

        let mut mates = memory::filled(NONE, entries.len());
        let mut clash = None;
        let mut crowded = Vec::new();
        let mut start = 0;
        for node in 0..node_count {
            let end = ends[node] as usize;
            let bucket = &mut entries[start..end];
            start = end;
            bucket.sort_unstable();
            for edge in bucket.chunk_by(|x, y| x >> 32 == y >> 32) {
                match *edge {
                    [_] => {}
                    [x, y] => {
                        let [first, second] = [x, y].map(|entry| HalfEdge(entry as u32 >> 1));
                        mates[first.index()] = second.0;
                        mates[second.index()] = first.0;
                        if x & 1 == y & 1 {
                            clash = clash.or(Some([first, second]));
                        }
                    }
                    _ => crowded.push(CrowdedEdge {
                        nodes: [node as u32, (edge[0] >> 32) as u32],
                        triangle_count: edge.len(),
                    }),
                }
            }
        }
        Self { mates, clash, crowded }
    }

    /// The corners, 3 * triangle + corner, at each of some nodes, in groups of triangles that hang together by edges of
    /// two triangles; without the first group of each node, which is that of the smallest corner.
    pub(super) fn further_groups(&self, triangles: &[[u32; 3]], nodes: &[u32]) -> Vec<(u32, Vec<usize>)> {
        let mut has_group = memory::filled(false, nodes.len());
        let mut seen = memory::filled(false, self.mates.len());
        let mut groups = Vec::new();
        for corner in 0..seen.len() {
            let node = HalfEdge(corner as u32).origin(triangles);
            let Ok(place) = nodes.binary_search(&node) else { continue };
            if std::mem::replace(&mut seen[corner], true) {
                continue;
            }
            let mut group = vec![corner];
            let mut done = 0;
            while done < group.len() {
                let leaving = HalfEdge(group[done] as u32);
                done += 1;
                for mate in
                    [leaving, leaving.previous()].into_iter().filter_map(|h| some(self.mates[h.index()]))
                {
                    let next = if mate.origin(triangles) == node { mate } else { mate.next() };
                    if !std::mem::replace(&mut seen[next.index()], true) {
                        memory::push(&mut group, next.index());
                    }
                }
            }
            if std::mem::replace(&mut has_group[place], true) {
                memory::push(&mut groups, (node, group));
            }
        }
        groups
    }
}

/// The first fan of each node, and the others as (node, half-edge) by node. Open fans go first.
fn find_fans(triangles: &[[u32; 3]], twins: &[u32], node_count: usize) -> (Vec<u32>, Vec<(u32, u32)>) {
    let mut fans = memory::filled(NONE, node_count);
    let mut further = Vec::new();
    let mut seen = memory::filled(false, twins.len());
    let open = (0..twins.len()).filter(|&h| twins[h] == NONE);
    for h in open.chain(0..twins.len()) {
        if seen[h] {
            continue;
        }
        let start = HalfEdge(h as u32);
        let node = start.origin(triangles);
        match fans[node as usize] {
            NONE => fans[node as usize] = start.0,
            _ => further.push((node, start.0)),
        }
        let mut half_edge = Some(start);
        while let Some(current) = half_edge.filter(|current| !seen[current.index()]) {
            seen[current.index()] = true;
            half_edge = some(twins[current.previous().index()]);
        }
    }
    further.sort_unstable();
    (fans, further)
}

/// The first triangle that has the nodes of an earlier one. Sorts, so only asked when something is wrong.
fn duplicate(triangles: &[[u32; 3]]) -> Option<MeshError> {
    let keys = sorted_by_nodes(triangles);
    let pairs = keys.windows(2).filter(|pair| pair[0].0 == pair[1].0);
    let (triangle, first) = pairs.map(|pair| (pair[1].1, pair[0].1)).min()?;
    Some(MeshError::DuplicateTriangle { triangle, first })
}

/// Whether each triangle is the first one with its nodes.
pub(super) fn first_copies(triangles: &[[u32; 3]]) -> Vec<bool> {
    let mut is_first = memory::filled(true, triangles.len());
    for pair in sorted_by_nodes(triangles).windows(2) {
        is_first[pair[1].1] = pair[0].0 != pair[1].0;
    }
    is_first
}

/// Triangles as their nodes, in increasing order, and their numbers.
fn sorted_by_nodes(triangles: &[[u32; 3]]) -> Vec<([u32; 3], usize)> {
    let sorted = |(t, &triangle): (usize, &[u32; 3])| {
        let mut nodes = triangle;
        nodes.sort_unstable();
        (nodes, t)
    };
    let mut keys: Vec<([u32; 3], usize)> = triangles.iter().enumerate().map(sorted).collect_vec();
    keys.sort_unstable();
    keys
}

fn inconsistent(triangles: &[[u32; 3]], half_edges: [HalfEdge; 2]) -> MeshError {
    let nodes = [half_edges[0].origin(triangles), half_edges[0].target(triangles)];
    MeshError::InconsistentOrientation { nodes, triangles: half_edges.map(HalfEdge::triangle) }
}

fn one_sided(triangles: &[[u32; 3]], half_edges: [HalfEdge; 2]) -> MeshError {
    let mut nodes = [half_edges[0].origin(triangles), half_edges[0].target(triangles)];
    let mut pair = half_edges.map(HalfEdge::triangle);
    nodes.sort_unstable();
    pair.sort_unstable();
    MeshError::NonOrientable { nodes, triangles: pair }
}
