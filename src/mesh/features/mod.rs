//! Features of a mesh: edges where the surface is not smooth, as chains between corners.
//!
//! ```text
//!   c --- x --- x --- x .. o        c  corner: not exactly two feature edges, or a turn
//!    \                              x  inside a chain
//!     x -- d                        o  a chain's end goes on along edges that turn less, but still turn
//!                                   d  a bit that ends in nothing and is short: dropped
//! ```
//! Feature edges are those whose facets turn by more than an angle, blunter ones that stand out from the surface beside
//! them and divide it (`ridges`), edges between labels that do not meet smoothly, edges given, and the border. Normals of noisy facets
//! are filtered first (`noise`).

mod chains;
mod noise;
mod regions;
mod ridges;
#[cfg(test)]
mod tests;

use super::decimate::{half_edges, normal};
use super::{HalfEdge, Mesh};
use crate::control::Pool;
use crate::failure::{Classify, ErrorKind};
use crate::memory::CollectVec;
use crate::options::with_fields;
use chains::Net;
use glam::DVec3;
pub use regions::{LabelParts, Region, Regions, Side};
use ridges::Facets;
use std::collections::BTreeSet;
use std::f64::consts::PI;
use std::sync::OnceLock;

/// How features are found. Angles are in radians.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FeatureOptions<'a> {
    /// Edges whose facets turn by more than this are features; none for only those given. Default 0.7, 40 degrees.
    pub sharp_angle: Option<f64>,
    /// Chains that end go on along edges whose facets turn by more than this, and chains of such edges that stand out from the
    /// surface beside them are features if they divide it: they close, or run from feature to feature. Default 0.26, 15
    /// degrees; at pi, or without a `sharp_angle`, nothing of this happens.
    pub weak_angle: f64,
    /// Where a chain turns by more than this it has a corner. Default 0.6, 34 degrees.
    pub corner_angle: f64,
    /// Bits of chains that end in nothing are dropped if they are shorter than this part of the diagonal. Default 0.04.
    pub least_length: f64,
    /// Further feature edges, two nodes each.
    pub sharp_edges: &'a [[u32; 2]],
    /// A number for each triangle: edges between different ones are features. Empty for none.
    pub labels: &'a [u32],
    /// Two labels are one where the facets turn by no more than this along all edges between them; at pi labels part
    /// nothing. Default 0: all edges between labels are features.
    pub label_angle: f64,
    /// Whether the normals of a noisy mesh are filtered before angles are measured. Default: yes.
    pub filter_noise: bool,
    /// Whether edges between `weak_angle` and `sharp_angle` that stand out are features too. Default: yes.
    pub find_blunt: bool,
}

impl Default for FeatureOptions<'_> {
    fn default() -> Self {
        Self {
            sharp_angle: Some(0.7),
            weak_angle: 0.26,
            corner_angle: 0.6,
            least_length: 0.04,
            sharp_edges: &[],
            labels: &[],
            label_angle: 0.0,
            filter_noise: true,
            find_blunt: true,
        }
    }
}

impl<'a> FeatureOptions<'a> {
    with_fields! {
        with_sharp_angle sharp_angle: Option<f64>,
        with_weak_angle weak_angle: f64,
        with_corner_angle corner_angle: f64,
        with_least_length least_length: f64,
        with_sharp_edges sharp_edges: &'a [[u32; 2]],
        with_labels labels: &'a [u32],
        with_label_angle label_angle: f64,
        with_filter_noise filter_noise: bool,
        with_find_blunt find_blunt: bool,
    }

    /// Refuses options out of their ranges, labels that are not as many as triangles, and sharp edges that the mesh does
    /// not have.
    pub fn check(&self, mesh: &Mesh) -> Result<(), FeatureError> {
        let angles = [
            ("sharp_angle", self.sharp_angle.unwrap_or(0.0)),
            ("weak_angle", self.weak_angle),
            ("corner_angle", self.corner_angle),
            ("label_angle", self.label_angle),
        ];
        if let Some(&(option, value)) = angles.iter().find(|(_, value)| !(0.0..=PI).contains(value)) {
            return Err(FeatureError::Option { option, value, range: "between 0 and pi" });
        }
        if !(0.0..=1.0).contains(&self.least_length) {
            let (option, range) = ("least_length", "between 0 and 1");
            return Err(FeatureError::Option { option, value: self.least_length, range });
        }
        let (given, count) = (self.labels.len(), mesh.triangles().len());
        if given != 0 && given != count {
            return Err(FeatureError::LabelCount { given, count });
        }
        let count = mesh.points().len();
        for (index, &nodes) in self.sharp_edges.iter().enumerate() {
            if let Some(node) = nodes.into_iter().find(|&node| node as usize >= count) {
                return Err(FeatureError::NoSuchNode { index, node, count });
            }
            if mesh.edge_between(nodes[0], nodes[1]).is_none() {
                return Err(FeatureError::NotAnEdge { index, nodes });
            }
        }
        Ok(())
    }
}

/// Feature edges one after the other.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Chain {
    /// Its nodes in order; of a closed chain the first is not repeated.
    pub nodes: Vec<u32>,
    /// Whether it has no ends.
    pub is_closed: bool,
}

/// The features of a mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct Features {
    /// All feature edges as nodes, the smaller first, in increasing order.
    pub edges: Vec<[u32; 2]>,
    /// The same edges as chains, by their first nodes.
    pub chains: Vec<Chain>,
    /// Nodes that are no part of a smooth chain, in increasing order.
    pub corners: Vec<u32>,
    /// Edges among them that lie on the border.
    pub border_count: usize,
    /// Edges by which chains were made longer, also those along which they fade out up to the next feature.
    pub prolonged_count: usize,
    /// Edges that were dropped in short bits.
    pub dropped_count: usize,
    /// Noise along the normal, as standard deviation by mean edge length: an estimate from differences of differences.
    pub noise: f64,
}

impl Features {
    /// Whether more edges had to be dropped or added than there are inside: chains that come and go are texture, as of a scan of
    /// hair, and no edges of a part.
    pub fn are_texture(&self) -> bool {
        self.prolonged_count + self.dropped_count > self.edges.len() - self.border_count
    }
}

/// Features cannot be found as asked.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FeatureError {
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
    /// There must be one label for each triangle.
    #[error("{given} labels do not fit {count} triangles")]
    LabelCount {
        /// Labels given.
        given: usize,
        /// Triangles of the mesh.
        count: usize,
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
}

impl Classify for FeatureError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::Option { .. } | Self::LabelCount { .. } => ErrorKind::InvalidArgument,
            Self::NoSuchNode { .. } => ErrorKind::Index,
            Self::NotAnEdge { .. } => ErrorKind::Topology,
        }
    }

    /// The offending sharp edge.
    fn index(&self) -> Option<usize> {
        match *self {
            Self::NoSuchNode { index, .. } | Self::NotAnEdge { index, .. } => Some(index),
            _ => None,
        }
    }
}

/// Edges over which a chain's turn is seen under noise: a tenth of an edge length turns single edges by 0.3, three by 0.1.
/// Borders that run in zigzag around equal triangles turn single edges by 1, three by 0.3.
const NOISY_REACH: usize = 3;

impl Mesh {
    /// Finds edges where the surface is not smooth.
    pub fn find_features(&self, options: &FeatureOptions) -> Result<Features, FeatureError> {
        let pool = Pool::new(1);
        self.find_features_by(&FacetNormals::new(self), options, &pool)
    }

    /// The same by normals that are found once for several searches.
    pub(crate) fn find_features_by(
        &self,
        facets: &FacetNormals,
        options: &FeatureOptions,
        pool: &Pool,
    ) -> Result<Features, FeatureError> {
        options.check(self)?;
        Ok(self.at_safe_scale().0.features(facets, options, pool))
    }

    fn features(&self, facets: &FacetNormals, options: &FeatureOptions, pool: &Pool) -> Features {
        let noise = facets.noise;
        let is_noisy = options.filter_noise && noise > noise::WORTH_FILTERING;
        let normals = facets.get(self, is_noisy, pool);
        let turns = turns(self, normals);
        let kept = given_edges(self, &turns, options);
        let sharp_angle = options.sharp_angle.unwrap_or(PI);
        let is_sharp = |edge: HalfEdge| turns[edge.index()] > sharp_angle;
        let mut net = Net::new(self, is_sharp, kept);
        let mut prolonged_count = 0;
        if options.sharp_angle.is_some() {
            prolonged_count += net.prolong(&turns, options.weak_angle);
        }
        if options.find_blunt && options.sharp_angle.is_some() && options.weak_angle < PI {
            let facets = Facets { mesh: self, normals, turns: &turns, sharp_angle };
            net.add(|edge| {
                turns[edge.index()] > options.weak_angle && facets.ratio(edge) > ridges::LEAST_RATIO
            });
            net.drop_chains(|net, chain| {
                net.is_blunt(chain, is_sharp) && net.length_of(chain) < ridges::LEAST_LENGTH * self.diagonal()
            });
            prolonged_count += net.prolong(&turns, options.weak_angle);
            prolonged_count += net.join(&turns, |edge| facets.ratio(edge) > ridges::FADING_RATIO);
            net.drop_chains(|net, chain| net.is_blunt(chain, is_sharp) && net.is_loose(chain));
        }
        let dropped_count = net.drop_slivers() + net.drop_bits(options.least_length * self.diagonal());
        let jagged = net.jagged_borders(options.corner_angle);
        let corners = net.corners(options.corner_angle, |node| {
            if is_noisy || jagged.contains(&node) { NOISY_REACH } else { 1 }
        });
        Features {
            edges: net.edges(),
            chains: net.chains(&corners),
            corners,
            border_count: self.topology().boundary_edge_count(),
            prolonged_count,
            dropped_count,
            noise,
        }
    }
}

/// The normals of a mesh's facets, as they are and without noise, for all that is asked of the mesh.
#[derive(Debug, Clone)]
pub(crate) struct FacetNormals {
    plain: Vec<DVec3>,
    filtered: OnceLock<Vec<DVec3>>,
    /// See [`Features::noise`].
    noise: f64,
}

impl FacetNormals {
    pub(crate) fn new(mesh: &Mesh) -> Self {
        let (mesh, _) = mesh.at_safe_scale();
        let of_facet = |t: &[u32; 3]| normal(mesh.points(), t).normalize_or_zero();
        let plain = mesh.triangles().iter().map(of_facet).collect_vec();
        Self { plain, filtered: OnceLock::new(), noise: noise::estimate(&mesh) }
    }

    /// One for each facet of the same mesh, without noise if it is noisy.
    pub(crate) fn get(&self, mesh: &Mesh, is_noisy: bool, pool: &Pool) -> &[DVec3] {
        let filtered =
            || noise::filtered(&mesh.at_safe_scale().0, self.plain.iter().copied().collect_vec(), pool);
        if is_noisy { self.filtered.get_or_init(filtered) } else { &self.plain }
    }
}

/// By half-edge: the angle by which the facets at it turn; 0 at the border and where one has no area.
fn turns(mesh: &Mesh, normals: &[DVec3]) -> Vec<f64> {
    let turn = |edge: HalfEdge| {
        let [m, n] = [edge, mesh.topology().twin(edge)?].map(|edge| normals[edge.triangle()]);
        Some(m.cross(n).length().atan2(m.dot(n)))
    };
    half_edges(mesh).map(|edge| turn(edge).unwrap_or(0.0)).collect_vec()
}

/// The half-edges that are features whatever their angle: border, between labels that are not one, given by the caller and
/// checked.
fn given_edges(mesh: &Mesh, turns: &[f64], options: &FeatureOptions) -> Vec<bool> {
    let parting = parting_labels(mesh, turns, options);
    let is_kept = |edge: HalfEdge| match mesh.topology().twin(edge) {
        None => true,
        Some(twin) => labels_beside(edge, twin, options.labels).is_some_and(|pair| parting.contains(&pair)),
    };
    let mut kept: Vec<bool> = half_edges(mesh).map(is_kept).collect();
    for edge in options.sharp_edges.iter().filter_map(|&[a, b]| mesh.edge_between(a, b)) {
        let sides = [Some(edge), mesh.topology().twin(edge)];
        sides.into_iter().flatten().for_each(|side| kept[side.index()] = true);
    }
    kept
}

/// Pairs of labels that stay apart: some edge between them turns by more than the angle below which labels are one.
fn parting_labels(mesh: &Mesh, turns: &[f64], options: &FeatureOptions) -> BTreeSet<[u32; 2]> {
    let keeps_all = options.label_angle == 0.0;
    let parting = |edge: HalfEdge| {
        let pair = labels_beside(edge, mesh.topology().twin(edge)?, options.labels)?;
        (keeps_all || turns[edge.index()] > options.label_angle).then_some(pair)
    };
    half_edges(mesh).filter_map(parting).collect()
}

/// The labels on both sides of an edge, the smaller first; none if they are equal or not given.
fn labels_beside(edge: HalfEdge, twin: HalfEdge, labels: &[u32]) -> Option<[u32; 2]> {
    let [a, b] = [edge, twin].map(|side| labels.get(side.triangle()).copied());
    let (a, b) = (a?, b?);
    (a != b).then_some([a.min(b), a.max(b)])
}
