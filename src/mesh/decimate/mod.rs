//! Fewer nodes for the same shape: edges collapse until a mesh is as coarse as asked.
//!
//! M. Garland, P. Heckbert, "Surface simplification using quadric error metrics", SIGGRAPH 1997, 209-216, with
//! half-edge collapses: a node moves onto a neighbour, so that the nodes left are nodes of the mesh as it was
//! and keep their places, parameters and fields.
//! ```text
//! cost(u -> v) = Q_u(v) + Q_v(v) + a little of |uv|^2
//! ```
//! The boundary and sharp edges stay edges; their corners stay nodes. No triangle folds over, neither in space
//! nor, exactly, in the parameter plane. Ties go to the smaller node, so the result is always the same.

mod collapse;
mod features;
mod quadric;
#[cfg(test)]
mod tests;

pub(super) use features::{half_edges, normal};
pub(crate) use quadric::Quadric;

use super::{Mesh, Piece};
use crate::control::{Cancelled, Control, Stage, Watch};
use crate::failure::{Classify, ErrorKind};
use crate::geometry::{Orientation, orientation};
use crate::memory::{self, CollectVec};
use crate::options::with_fields;
use collapse::Collapsing;
use features::Features;
use glam::{DVec2, DVec3};
use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;
use std::f64::consts::{FRAC_PI_4, PI};
use std::time::Instant;

/// How coarse a mesh becomes, and what stays.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DecimateOptions<'a> {
    /// Nodes that are to be left, at least 3.
    pub target_count: usize,
    /// Edges whose triangles turn by more than this, in radians, are sharp. Default: none.
    pub sharp_angle: Option<f64>,
    /// Further sharp edges, by their nodes.
    pub sharp_edges: &'a [[u32; 2]],
    /// Where the boundary or a chain of sharp edges turns by more than this, in radians, its node stays.
    /// Default a quarter of pi.
    pub corner_angle: f64,
    /// Whether no triangle may turn over in the parameter plane, if the mesh has parameters. Default: yes.
    pub keep_map: bool,
}

impl Default for DecimateOptions<'_> {
    fn default() -> Self {
        Self {
            target_count: 1000,
            sharp_angle: None,
            sharp_edges: &[],
            corner_angle: FRAC_PI_4,
            keep_map: true,
        }
    }
}

impl<'a> DecimateOptions<'a> {
    with_fields! {
        with_target_count target_count: usize,
        with_sharp_angle sharp_angle: Option<f64>,
        with_sharp_edges sharp_edges: &'a [[u32; 2]],
        with_corner_angle corner_angle: f64,
        with_keep_map keep_map: bool,
    }

    /// The parameters that count.
    fn parameters_of<'m>(&self, mesh: &'m Mesh) -> Option<&'m [DVec2]> {
        mesh.parameters().filter(|_| self.keep_map)
    }

    fn check(&self) -> Result<(), DecimateError> {
        let check = |holds: bool, option, value, range| {
            if holds { Ok(()) } else { Err(DecimateError::Option { option, value, range }) }
        };
        check(self.target_count >= LEAST_COUNT, "target_count", self.target_count as f64, "at least 3")?;
        for (option, angle) in
            [("sharp_angle", self.sharp_angle.unwrap_or(PI)), ("corner_angle", self.corner_angle)]
        {
            check(angle > 0.0 && angle <= PI, option, angle, "positive and at most pi")?;
        }
        Ok(())
    }
}

/// Nodes of the smallest mesh.
const LEAST_COUNT: usize = 3;

/// A mesh cannot be made coarser as asked.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum DecimateError {
    /// An option is out of its range.
    #[error("{option} is {value}, it must be {range}")]
    Option {
        /// Name of the option.
        option: &'static str,
        /// Its value.
        value: f64,
        /// What it may be.
        range: &'static str,
    },
    /// A sharp edge has a node that does not exist.
    #[error("sharp edge {index} has node {node}, the mesh has {count}")]
    NoSuchNode {
        /// The sharp edge.
        index: usize,
        /// Its node.
        node: u32,
        /// Nodes of the mesh.
        count: usize,
    },
    /// A sharp edge is no edge of the mesh.
    #[error("sharp edge {index} from node {} to node {} is no edge of the mesh", nodes[0], nodes[1])]
    NotAnEdge {
        /// The sharp edge.
        index: usize,
        /// Its nodes.
        nodes: [u32; 2],
    },
    /// The parameters fold, so they cannot be kept free of folds.
    #[error("triangle {triangle} is flat in the parameter plane, or turned against the first")]
    Folded {
        /// The first such triangle.
        triangle: usize,
    },
    /// The progress callback asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl Classify for DecimateError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::Option { .. } => ErrorKind::InvalidArgument,
            Self::NoSuchNode { .. } => ErrorKind::Index,
            Self::NotAnEdge { .. } => ErrorKind::Topology,
            Self::Folded { .. } => ErrorKind::Degenerate,
            Self::Cancelled(_) => ErrorKind::Cancelled,
        }
    }

    /// The offending sharp edge, or triangle.
    fn index(&self) -> Option<usize> {
        match *self {
            Self::NoSuchNode { index, .. } | Self::NotAnEdge { index, .. } => Some(index),
            Self::Folded { triangle } => Some(triangle),
            Self::Option { .. } | Self::Cancelled(_) => None,
        }
    }
}

/// A coarser mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct Decimation {
    /// The mesh, and which node each of its nodes was.
    pub piece: Piece,
    /// The sharp edges that its chains consist of now, as nodes of the coarser mesh, the smaller first.
    pub sharp_edges: Vec<[u32; 2]>,
    /// What was done.
    pub report: DecimateReport,
}

/// What was done to make a mesh coarser.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DecimateReport {
    /// Edges that were collapsed.
    pub collapse_count: usize,
    /// Nodes beyond the target that had to stay, because nothing more can be collapsed.
    pub excess_count: usize,
    /// Wall time in seconds.
    pub seconds: f64,
}

impl Mesh {
    /// The mesh with fewer nodes: as many as asked for, or as few as topology, features and the shapes of
    /// triangles allow. Nodes without triangles go.
    pub fn decimate(
        &self,
        options: &DecimateOptions,
        control: &mut Control,
    ) -> Result<Decimation, DecimateError> {
        let start = Instant::now();
        options.check()?;
        control.enter(Stage::Coarsen);
        let uv = options.parameters_of(self);
        let side = side(self.triangles(), uv)?;
        let (safe, _) = self.at_safe_scale();
        control.pool().check()?;
        let features = Features::of(&safe, options)?;
        let (points, watch) = (centred(&safe), control.pool().watch());
        let mut collapsing = Collapsing::new(points, self.triangles(), uv.zip(side), features, watch)?;
        let removable = self.used_count.saturating_sub(options.target_count);
        let collapse_count = collapse_all(&mut collapsing, removable, self.points.len() as u32, control)?;
        control.pool().check()?;
        let piece = self.compacted(collapsing.triangles()).expect("collapses keep a mesh a mesh");
        let sharp_edges = sharp_edges(&collapsing, &piece);
        let report = DecimateReport {
            collapse_count,
            excess_count: removable - collapse_count,
            seconds: start.elapsed().as_secs_f64(),
        };
        Ok(Decimation { piece, sharp_edges, report })
    }
}

/// The side that all triangles show in the parameter plane; none without parameters.
fn side(triangles: &[[u32; 3]], uv: Option<&[DVec2]>) -> Result<Option<Orientation>, DecimateError> {
    let Some(uv) = uv else { return Ok(None) };
    let side_of = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|node| uv[node as usize]);
        orientation(a, b, c)
    };
    let side = side_of(&triangles[0]);
    let folds = |t| side == Orientation::Zero || side_of(t) != side;
    match triangles.iter().position(folds) {
        Some(triangle) => Err(DecimateError::Folded { triangle }),
        None => Ok(Some(side)),
    }
}

/// The nodes around the middle of their box.
fn centred(mesh: &Mesh) -> Vec<DVec3> {
    let bounds = mesh.bounds();
    let middle = (DVec3::from_slice(&bounds.min) + DVec3::from_slice(&bounds.max)) / 2.0;
    mesh.points().iter().map(|&point| point - middle).collect_vec()
}

/// The feature edges that are not on the boundary, in the numbers of the coarser mesh.
fn sharp_edges(collapsing: &Collapsing, piece: &Piece) -> Vec<[u32; 2]> {
    let number = |node: u32| piece.nodes.binary_search(&node).map_or(u32::MAX, |number| number as u32);
    let edges = collapsing.feature_edges().map(|nodes| nodes.map(number));
    let is_inside = |&[from, to]: &[u32; 2]| {
        let edge = piece.mesh.edge_between(from, to);
        edge.is_some_and(|edge| piece.mesh.topology().twin(edge).is_some())
    };
    edges.filter(is_inside).collect()
}

/// A collapse that was possible when it was queued.
#[derive(PartialEq)]
struct Candidate {
    cost: f64,
    from: u32,
    to: u32,
    /// Of `from`; older ones are out of date.
    version: u32,
}

impl Eq for Candidate {}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        let nodes = |candidate: &Self| (candidate.from, candidate.to, candidate.version);
        self.cost.total_cmp(&other.cost).then(nodes(self).cmp(&nodes(other)))
    }
}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// The best collapse of each node.
struct Queue {
    heap: BinaryHeap<Reverse<Candidate>>,
    versions: Vec<u32>,
}

impl Queue {
    fn of(collapsing: &Collapsing, node_count: u32, watch: &Watch) -> Result<Self, Cancelled> {
        let mut queue = Self { heap: BinaryHeap::new(), versions: memory::filled(0, node_count as usize) };
        for node in 0..node_count {
            watch.check_at(node as usize)?;
            if collapsing.is_present(node) {
                queue.renew(node, collapsing);
            }
        }
        Ok(queue)
    }

    /// Queues the cheapest collapse that a node is capable of now, instead of what it had.
    fn renew(&mut self, from: u32, collapsing: &Collapsing) {
        self.versions[from as usize] += 1;
        let version = self.versions[from as usize];
        if collapsing.is_hub(from) {
            return; // it stays, and to look around it would take long
        }
        let star = collapsing.star(from);
        let candidate = |&to: &u32| Candidate { cost: collapsing.cost(from, to), from, to, version };
        let mut candidates: Vec<Candidate> = collapsing.targets(&star).iter().map(candidate).collect_vec();
        candidates.sort_unstable();
        let best = candidates.into_iter().find(|candidate| collapsing.may_collapse(&star, candidate.to));
        memory::reserve_item(&mut self.heap);
        self.heap.extend(best.map(Reverse));
    }

    /// The cheapest candidate that is up to date.
    fn pop(&mut self) -> Option<Candidate> {
        loop {
            let Reverse(candidate) = self.heap.pop()?;
            if candidate.version == self.versions[candidate.from as usize] {
                return Some(candidate);
            }
        }
    }
}

/// Collapses between two reports of progress: some milliseconds.
const REPORT_INTERVAL: usize = 512;

/// Collapses the cheapest edge `count` times, or as often as there is one; returns how often.
fn collapse_all(
    collapsing: &mut Collapsing,
    count: usize,
    node_count: u32,
    control: &mut Control,
) -> Result<usize, Cancelled> {
    let mut done = 0;
    while done < count {
        control.report(done as f64 / count as f64, f64::NAN)?;
        // what was impossible may have become possible by changes further away than those that are followed
        let mut queue = Queue::of(collapsing, node_count, control.pool().watch())?;
        let before = done;
        while done < count
            && let Some(Candidate { from, to, .. }) = queue.pop()
        {
            if !collapsing.may_collapse(&collapsing.star(from), to) {
                queue.renew(from, collapsing);
                continue;
            }
            // all around the node that is left, or of a hub what was beside the other one
            let beside = collapsing.is_hub(to).then(|| collapsing.neighbours(from));
            collapsing.collapse(from, to);
            queue.versions[from as usize] += 1;
            queue.renew(to, collapsing);
            let changed = beside.unwrap_or_else(|| collapsing.neighbours(to)).into_iter();
            changed.filter(|&node| node != to).for_each(|node| queue.renew(node, collapsing));
            done += 1;
            if done.is_multiple_of(REPORT_INTERVAL) {
                control.report(done as f64 / count as f64, f64::NAN)?;
            }
        }
        if done == before {
            break;
        }
    }
    Ok(done)
}
