//! PHT-splines: C1 bicubic surfaces over hierarchical T-meshes, polynomial or rational.
//!
//! J. Deng, F. Chen, X. Li, C. Hu, W. Tong, Z. Yang, Y. Feng, "Polynomial splines over hierarchical T-meshes",
//! Graph. Models 70 (2008), in Hermite form:
//! ```text
//! state:    a jet (f, f_u, f_v, f_uv) at each basis vertex; any jets define exactly one spline
//! leaf:     the bicubic patch of the jets of its corners
//! T-vertex: its jet is that of its host's patch, a strictly larger leaf
//! dim = 4 (V_border + V_crossing)
//! ```
//! C1, because both sides of an edge share f and the derivative across it at all vertices of that edge, and
//! both are cubics fixed by the ends. A surface with weights keeps the jets of (w x, w y, .., w): all that
//! follows is linear in them.
//!
//! Splines that are C2 have control points of truncated hierarchical B-splines ([`TruncatedBasis`]), of which their jets are
//! made.
//!
//! Control points ([`Basis`]) and Bezier ordinates are derived. Splitting a cell stores what was there, so old
//! jets and control points never change; merging it is the exact inverse.

mod basis;
mod convert;
mod detail;
mod edit;
mod error;
mod evaluate;
mod expansion;
mod jet;
mod simplify;
mod stitch;
mod tensor;
#[cfg(test)]
mod tests;
mod truncated;

pub use basis::{Basis, BezierForm, LocalExtraction};
pub use convert::ConvertOptions;
pub use error::PhtError;
pub use expansion::{Matrix, all_jets, expansions};
pub use simplify::Simplification;
pub use stitch::{BorderSide, stitch};
pub use truncated::{LeafFunctions, TruncatedBasis};

use super::{Domain, Kind, Patches, Region, Surface};
use crate::bezier::BezierPatch;
use crate::memory;
use crate::tmesh::{TMesh, Topology, Vertex};
use evaluate::View;
use glam::DVec2;
use jet::ROWS;
use std::collections::BTreeMap;
use std::sync::OnceLock;

/// A PHT-spline surface.
#[derive(Debug)]
pub struct PhtSurface {
    dim: usize,
    is_rational: bool,
    mesh: TMesh,
    /// The jet of each basis vertex: four rows of `width` numbers.
    jets: BTreeMap<Vertex, Vec<f64>>,
    /// The control points of a spline that is C2, of which the jets are made; None for others.
    smooth: Option<Vec<f64>>,
    region: Region,
    /// Tables and Bezier ordinates, made when first needed after a change.
    view: OnceLock<View>,
}

/// Tables and ordinates are not copied: most copies are made to be changed.
impl Clone for PhtSurface {
    fn clone(&self) -> Self {
        let Self { dim, is_rational, mesh, jets, smooth, region, view: _ } = self;
        Self {
            dim: *dim,
            is_rational: *is_rational,
            mesh: mesh.clone(),
            jets: jets.clone(),
            smooth: smooth.clone(),
            region: region.clone(),
            view: OnceLock::new(),
        }
    }
}

impl PartialEq for PhtSurface {
    fn eq(&self, other: &Self) -> bool {
        self.dim == other.dim
            && self.is_rational == other.is_rational
            && self.mesh == other.mesh
            && self.jets == other.jets
            && self.smooth == other.smooth
            && self.region == other.region
    }
}

impl PhtSurface {
    /// The spline over `mesh` with these jets: for each basis vertex in order the rows f, f_u, f_v, f_uv of
    /// `dim` numbers, or of `dim + 1` where `is_rational`: (w x, .., w) and its derivatives.
    pub fn new(dim: usize, is_rational: bool, mesh: TMesh, jets: &[f64]) -> Result<Self, PhtError> {
        let surface = Self::with_any_weights(dim, is_rational, mesh, jets)?;
        surface.check_weights()?;
        Ok(surface)
    }

    /// The spline that is zero, with weights of 1.
    pub fn zero(dim: usize, is_rational: bool, mesh: TMesh) -> Result<Self, PhtError> {
        let width = dim.saturating_add(usize::from(is_rational));
        let mut jet = memory::filled(0.0, ROWS.saturating_mul(width));
        if is_rational {
            jet[dim] = 1.0;
        }
        let count = Topology::new(&mesh).basis.len();
        Self::new(dim, is_rational, mesh, &jet.repeat(count))
    }

    /// The same, whatever the signs of the weights.
    fn with_any_weights(dim: usize, is_rational: bool, mesh: TMesh, jets: &[f64]) -> Result<Self, PhtError> {
        if dim == 0 {
            return Err(PhtError::Dimension);
        }
        let topology = Topology::new(&mesh);
        let length = ROWS * (dim + usize::from(is_rational));
        let expected = topology.basis.len() * length;
        if jets.len() != expected {
            return Err(PhtError::Count { what: "the data of the vertices", count: jets.len(), expected });
        }
        if let Some(index) = jets.iter().position(|x| !x.is_finite()) {
            return Err(PhtError::NotFinite { index: index / length });
        }
        let vertices = topology.basis.iter().map(|&vertex| topology.vertices[vertex as usize]);
        let jets = memory::tree_of(vertices.zip(jets.chunks_exact(length).map(memory::copied)));
        let (smooth, region) = (None, Region::default());
        let surface = Self { dim, is_rational, mesh, jets, smooth, region, view: OnceLock::new() };
        surface.view.get_or_init(|| View::new(&surface, topology));
        Ok(surface)
    }

    /// The mesh.
    pub fn mesh(&self) -> &TMesh {
        &self.mesh
    }

    /// Leaves, vertices and hosts as tables.
    pub fn topology(&self) -> &Topology {
        &self.view().topology
    }

    /// Whether the surface has weights.
    pub fn is_rational(&self) -> bool {
        self.is_rational
    }

    /// Numbers in a row of a jet: the dimension, and one for the weight.
    pub fn width(&self) -> usize {
        self.dim + usize::from(self.is_rational)
    }

    /// The jets of the basis vertices in order.
    pub fn jets(&self) -> impl ExactSizeIterator<Item = (Vertex, &[f64])> + '_ {
        self.jets.iter().map(|(&vertex, jet)| (vertex, jet.as_slice()))
    }

    fn view(&self) -> &View {
        self.view.get_or_init(|| View::new(self, Topology::new(&self.mesh)))
    }

    /// All ordinates of the weights are positive, so the weight itself is.
    fn check_weights(&self) -> Result<(), PhtError> {
        match (0..self.mesh.leaf_count())
            .map(|leaf| self.least_weight(leaf))
            .position(|weight| !(weight > 0.0))
        {
            Some(index) => Err(PhtError::Weight { index, weight: self.least_weight(index) }),
            None => Ok(()),
        }
    }

    /// The least ordinate of the weights on a leaf; 1 for a surface without.
    fn least_weight(&self, leaf: usize) -> f64 {
        let rows = self.view().leaf_ordinates(leaf).chunks_exact(self.width());
        let weights = rows.map(|row| if self.is_rational { row[self.dim] } else { 1.0 });
        weights.fold(f64::INFINITY, f64::min)
    }
}

impl Surface for PhtSurface {
    fn kind(&self) -> Kind {
        Kind::Pht
    }

    fn dim(&self) -> usize {
        self.dim
    }

    fn domain(&self) -> Domain {
        self.mesh.domain()
    }

    fn coefficient_count(&self) -> usize {
        self.smooth.as_ref().map_or(ROWS * self.jets.len(), |points| points.len() / self.dim)
    }

    fn region(&self) -> &Region {
        &self.region
    }

    fn region_mut(&mut self) -> &mut Region {
        &mut self.region
    }

    fn eval_rows(&self, uv: &[DVec2], max_derivative: usize, out: &mut [f64]) {
        self.eval_leaves(uv, max_derivative, out);
    }

    fn patches(&self) -> Option<&dyn Patches> {
        Some(self)
    }
}

/// Patches in the order of the leaves.
impl Patches for PhtSurface {
    fn patch_count(&self) -> usize {
        self.mesh.leaf_count()
    }

    fn patch(&self, index: usize) -> BezierPatch {
        let view = self.view();
        let cell = self.mesh.cell(view.topology.leaves[index]);
        BezierPatch {
            domain: self.mesh.cell_domain(cell),
            degree: [3, 3],
            dim: self.dim,
            is_rational: self.is_rational,
            ordinates: view.leaf_ordinates(index).to_vec(),
        }
    }

    fn patch_at(&self, uv: DVec2) -> usize {
        self.view().leaf_at(&self.mesh, uv)
    }
}
