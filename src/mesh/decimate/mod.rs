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

use super::priced::Priced;
use super::{Mesh, Piece};
use crate::control::{Cancelled, Control, Stage, Watch};
use crate::failure::{Classify, ErrorKind};
use crate::geometry::{Orientation, orientation};
use crate::memory::{self, CollectVec};
use crate::options::with_fields;
use collapse::Collapsing;
use features::Features;
use glam::{DVec2, DVec3};
use std::cmp::Reverse;
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
        let watch = control.pool().watch();
        let features = Features::of(&safe, options, watch)?;
        let points = centred(&safe);
        let mut collapsing = Collapsing::new(&points, self.triangles(), uv.zip(side), features, watch)?;
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

/// The cheapest collapses of the nodes, in increasing order of cost. What has changed around a node is looked at when its
/// turn comes: costs only grow where planes are added up, so that what it cost before is a bound from below.
struct Queue {
    /// Entries up to the ceiling.
    heap: BinaryHeap<Reverse<Priced>>,
    /// Nodes that cost more wait until the heap is empty: one of all nodes would not stay in the processor's cache.
    ceiling: f64,
    nodes: Vec<Queued>,
    /// Entries taken so far.
    taken: usize,
    /// Of the node that is looked at.
    targets: Vec<Priced>,
}

/// What is known of a node's collapses.
#[derive(Clone)]
struct Queued {
    /// Of its entry in the heap if that is below the ceiling; other entries are out of date. Infinite: it is not queued.
    cost: f64,
    /// No collapse of it costs less, refused or not.
    least: f64,
    /// The dearest collapse refused since something changed beside it; so were its cheaper ones.
    refused: Option<Priced>,
}

/// The heap takes one of so many of the nodes that wait: of a million nodes its entries are a megabyte, which stays in a
/// processor's cache. To collapse 950,000 of them took 18 s with one heap of all nodes, 14 s with 16 or 64 parts.
const RISES: usize = 16;
/// Nodes whose costs say what the cheapest are, at most about. Few would make parts of uneven size, all take time in which
/// nobody asks whether the call is to end.
const SAMPLE: usize = 4096;

impl Queue {
    fn of(collapsing: &Collapsing, node_count: u32, watch: &Watch) -> Result<Self, Cancelled> {
        let none = Queued { cost: f64::INFINITY, least: f64::INFINITY, refused: None };
        let nodes = memory::filled(none, node_count as usize);
        let mut queue = Self { heap: BinaryHeap::new(), ceiling: -1.0, nodes, taken: 0, targets: Vec::new() };
        for node in 0..node_count {
            watch.check_at(node as usize)?;
            queue.look_around(node, collapsing);
        }
        Ok(queue)
    }

    /// Queues a node at a cost unless it is queued for less.
    fn push(&mut self, cost: f64, from: u32) {
        let node = &mut self.nodes[from as usize];
        if cost < node.cost {
            node.cost = cost;
            if cost <= self.ceiling {
                memory::reserve_item(&mut self.heap);
                self.heap.push(Reverse(Priced { cost, node: from }));
            }
        }
    }

    /// The cheapest entry; when there is none left, the ceiling rises.
    fn take(&mut self, watch: &Watch) -> Result<Option<Priced>, Cancelled> {
        if self.heap.is_empty() {
            self.rise(watch)?;
        }
        Ok(self.heap.pop().map(|Reverse(entry)| entry))
    }

    /// Raises the ceiling to the cheapest of the nodes that wait, and takes them into the heap.
    fn rise(&mut self, watch: &Watch) -> Result<(), Cancelled> {
        let some = self.nodes.iter().step_by(self.nodes.len() / SAMPLE + 1);
        let mut costs = some.map(|node| node.cost).filter(|&cost| cost < f64::INFINITY).collect_vec();
        self.ceiling = match costs.len() {
            0 => f64::MAX, // few are left, and all may come
            count => *costs.select_nth_unstable_by(count / RISES, f64::total_cmp).1,
        };
        let mut entries = Vec::new();
        for (node, from) in self.nodes.iter().zip(0..) {
            watch.check_at(from as usize)?;
            if node.cost <= self.ceiling {
                memory::push(&mut entries, Reverse(Priced { cost: node.cost, node: from }));
            }
        }
        self.heap = BinaryHeap::from(entries);
        Ok(())
    }

    /// Queues a node for its cheapest collapse as if none had been refused.
    fn look_around(&mut self, from: u32, collapsing: &Collapsing) {
        collapsing.targets_of(from, &mut self.targets);
        let least = cheapest(&self.targets, None).map_or(f64::INFINITY, |target| target.cost);
        let node = &mut self.nodes[from as usize];
        (node.least, node.refused) = (least, None);
        self.push(least, from);
    }

    /// Queues a node again after another one was collapsed onto `to` beside it.
    fn renew(&mut self, from: u32, to: u32, collapsing: &Collapsing) {
        let cost = collapsing.cost_if_target(from, to);
        let node = &mut self.nodes[from as usize];
        node.refused = None;
        node.least = node.least.min(cost);
        let least = node.least;
        self.push(least, from);
    }

    /// The nodes of the cheapest collapse that keeps the mesh a good one.
    fn pop(&mut self, collapsing: &Collapsing, watch: &Watch) -> Result<Option<[u32; 2]>, Cancelled> {
        while let Some(Priced { cost, node: from }) = self.take(watch)? {
            self.taken += 1;
            watch.check_at(self.taken)?;
            let node = &mut self.nodes[from as usize];
            if cost != node.cost {
                continue;
            }
            node.cost = f64::INFINITY;
            collapsing.targets_of(from, &mut self.targets);
            node.least = cheapest(&self.targets, None).map_or(f64::INFINITY, |target| target.cost);
            // as long as the node would be the next one taken
            let limit = self.heap.peek().map_or(self.ceiling, |Reverse(next)| next.cost);
            while let Some(target) = cheapest(&self.targets, node.refused) {
                if target.cost > limit {
                    self.push(target.cost, from);
                    break;
                }
                if collapsing.may_collapse(from, target.node) {
                    return Ok(Some([from, target.node]));
                }
                node.refused = Some(target);
            }
        }
        Ok(None)
    }
}

/// The cheapest target beyond those refused.
fn cheapest(targets: &[Priced], refused: Option<Priced>) -> Option<Priced> {
    let is_left = |target: &&Priced| refused.is_none_or(|refused| **target > refused);
    targets.iter().filter(is_left).min().copied()
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
            && let Some([from, to]) = queue.pop(collapsing, control.pool().watch())?
        {
            // all around the node that is left, or of a hub what was beside the other one
            let beside = collapsing.is_hub(to).then(|| collapsing.neighbours(from));
            collapsing.collapse(from, to);
            let changed = beside.unwrap_or_else(|| collapsing.neighbours(to));
            changed.into_iter().filter(|&node| node != to).for_each(|node| queue.renew(node, to, collapsing));
            queue.look_around(to, collapsing);
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
