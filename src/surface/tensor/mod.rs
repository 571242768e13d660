//! Tensor product B-spline surfaces of any degree, with or without weights.
//!
//! L. Piegl and W. Tiller, "The NURBS Book" (1997), chapters 3 and 4.
//! ```text
//! S(u,v) = sum_ij N_i(u) N_j(v) w_ij P_ij / sum_ij N_i(u) N_j(v) w_ij
//! ```

mod bicubic;
mod combine;
mod evaluate;
mod refine;

pub use combine::CombineError;

use super::{ControlNet, Domain, Kind, Patches, Region, Surface, eval_grid_by_rows};
pub use crate::geometry::Axis;
use crate::memory::{self, CollectVec};

use crate::bezier::{BezierPatch, apply, extraction};
use crate::failure::{Classify, ErrorKind};
use crate::knots::KnotVector;
use bicubic::BicubicTable;
use glam::{DVec2, DVec3};
use std::sync::OnceLock;

/// A tensor surface is not one.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TensorError {
    /// Values need at least one component.
    #[error("the dimension is 0")]
    Dimension,
    /// The knots in one direction are not a knot vector.
    #[error("in {axis:?}: {error}")]
    Knots {
        /// The direction.
        axis: Axis,
        /// What is wrong with them.
        error: crate::knots::KnotError,
    },
    /// There are not as many control points as basis functions.
    #[error("{count} numbers are given for {expected} control points of dimension {dim}")]
    ControlPointCount {
        /// Numbers given.
        count: usize,
        /// Control points that the knots ask for.
        expected: usize,
        /// Numbers a control point.
        dim: usize,
    },
    /// There are not as many weights as control points.
    #[error("{count} weights are given for {expected} control points")]
    WeightCount {
        /// Weights given.
        count: usize,
        /// Control points.
        expected: usize,
    },
    /// A coordinate is NaN or infinite.
    #[error("control point {index} is not finite")]
    NotFinite {
        /// The control point.
        index: usize,
    },
    /// A weight is not a positive number.
    #[error("weight {index} is {weight}, it must be positive and finite")]
    Weight {
        /// The control point.
        index: usize,
        /// Its weight.
        weight: f64,
    },
}

impl Classify for TensorError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::Knots { error, .. } => error.kind(),
            Self::NotFinite { .. } => ErrorKind::NotFinite,
            Self::Weight { weight, .. } if !weight.is_finite() => ErrorKind::NotFinite,
            _ => ErrorKind::InvalidArgument,
        }
    }

    /// The offending knot, control point or weight.
    fn index(&self) -> Option<usize> {
        match *self {
            Self::Knots { ref error, .. } => error.index(),
            Self::NotFinite { index } | Self::Weight { index, .. } => Some(index),
            _ => None,
        }
    }
}

/// A tensor product B-spline surface.
///
/// Control point `(i, j)`, `i` along u, is row `i * count_v + j` of `dim` numbers.
#[derive(Debug)]
pub struct TensorSurface {
    dim: usize,
    knots_u: KnotVector,
    knots_v: KnotVector,
    control_points: Vec<f64>,
    weights: Option<Weights>,
    region: Region,
    /// Made at the first evaluation; None for surfaces that it does not serve.
    bicubic: OnceLock<Option<BicubicTable>>,
}

/// The table is not copied: it is made again where it is of use.
impl Clone for TensorSurface {
    fn clone(&self) -> Self {
        let Self { dim, knots_u, knots_v, control_points, weights, region, bicubic: _ } = self;
        Self {
            dim: *dim,
            knots_u: knots_u.clone(),
            knots_v: knots_v.clone(),
            control_points: memory::copied(control_points),
            weights: weights.clone(),
            region: region.clone(),
            bicubic: OnceLock::new(),
        }
    }
}

impl PartialEq for TensorSurface {
    fn eq(&self, other: &Self) -> bool {
        self.dim == other.dim
            && self.knots_u == other.knots_u
            && self.knots_v == other.knots_v
            && self.control_points == other.control_points
            && self.weights == other.weights
            && self.region == other.region
    }
}

/// The weights, and the control points times their weights with the weight as one more component: what
/// evaluation works on.
#[derive(Debug, Clone, PartialEq)]
struct Weights {
    weights: Vec<f64>,
    homogeneous: Vec<f64>,
}

impl TensorSurface {
    /// Checks and keeps the parts. `control_points` are rows of `dim` numbers, v running fastest; `weights`
    /// are in the same order, None makes the surface polynomial.
    pub fn new(
        dim: usize,
        knots_u: KnotVector,
        knots_v: KnotVector,
        control_points: Vec<f64>,
        weights: Option<Vec<f64>>,
    ) -> Result<Self, TensorError> {
        let expected = knots_u.basis_count() * knots_v.basis_count();
        if dim == 0 {
            return Err(TensorError::Dimension);
        }
        if control_points.len() != expected * dim {
            return Err(TensorError::ControlPointCount { count: control_points.len(), expected, dim });
        }
        if let Some(index) = control_points.iter().position(|x| !x.is_finite()) {
            return Err(TensorError::NotFinite { index: index / dim });
        }
        let weights = weights.map(|weights| Weights::new(weights, &control_points, dim)).transpose()?;
        Ok(Self {
            dim,
            knots_u,
            knots_v,
            control_points,
            weights,
            region: Region::default(),
            bicubic: OnceLock::new(),
        })
    }

    /// The knot vector along one axis.
    pub fn knots(&self, axis: Axis) -> &KnotVector {
        match axis {
            Axis::U => &self.knots_u,
            Axis::V => &self.knots_v,
        }
    }

    /// The control points, v running fastest.
    pub fn control_points(&self) -> &[f64] {
        &self.control_points
    }

    /// Gives the surface other control points, and keeps knots and weights. Numbers that are not finite are
    /// refused and change nothing.
    pub fn set_control_points(&mut self, control_points: &[f64]) -> Result<(), TensorError> {
        let (count, expected, dim) = (control_points.len(), self.coefficient_count(), self.dim);
        if count != expected * dim {
            return Err(TensorError::ControlPointCount { count, expected, dim });
        }
        if let Some(index) = control_points.iter().position(|x| !x.is_finite()) {
            return Err(TensorError::NotFinite { index: index / dim });
        }
        self.control_points.copy_from_slice(control_points);
        if let Some(weights) = self.weights.take() {
            self.weights = Some(Weights::new(weights.weights, control_points, dim)?);
        }
        Ok(())
    }

    /// The weights, in the order of the control points; None for a polynomial surface.
    pub fn weights(&self) -> Option<&[f64]> {
        self.weights.as_ref().map(|weights| weights.weights.as_slice())
    }
}

impl Weights {
    fn new(weights: Vec<f64>, control_points: &[f64], dim: usize) -> Result<Self, TensorError> {
        let expected = control_points.len() / dim;
        if weights.len() != expected {
            return Err(TensorError::WeightCount { count: weights.len(), expected });
        }
        if let Some(index) = weights.iter().position(|&w| !(w > 0.0 && w.is_finite())) {
            return Err(TensorError::Weight { index, weight: weights[index] });
        }
        let homogeneous = control_points
            .chunks_exact(dim)
            .zip(&weights)
            .flat_map(|(point, &w)| point.iter().map(move |x| w * x).chain([w]))
            .collect_vec();
        Ok(Self { weights, homogeneous })
    }
}

impl Surface for TensorSurface {
    fn kind(&self) -> Kind {
        Kind::Tensor
    }

    fn dim(&self) -> usize {
        self.dim
    }

    fn domain(&self) -> Domain {
        let ((u0, u1), (v0, v1)) = (self.knots_u.domain(), self.knots_v.domain());
        Domain { min: DVec2::new(u0, v0), max: DVec2::new(u1, v1) }
    }

    fn coefficient_count(&self) -> usize {
        self.control_points.len() / self.dim
    }

    fn region(&self) -> &Region {
        &self.region
    }

    fn region_mut(&mut self) -> &mut Region {
        &mut self.region
    }

    fn eval_rows(&self, uv: &[DVec2], max_derivative: usize, out: &mut [f64]) {
        if !self.eval_bicubic(uv, max_derivative, out) {
            self.eval_rows_generic(uv, max_derivative, out);
        }
    }

    fn eval_grid(&self, u: &[f64], v: &[f64], out: &mut [f64]) {
        if !self.eval_bicubic_grid(u, v, out) {
            eval_grid_by_rows(self, u, v, out);
        }
    }

    fn patches(&self) -> Option<&dyn Patches> {
        Some(self)
    }

    fn control_net(&self) -> Option<ControlNet> {
        if self.dim != 3 {
            return None;
        }
        let (count_u, count_v) = (self.knots_u.basis_count() as u32, self.knots_v.basis_count() as u32);
        let along_u = (0..count_v).map(|j| (0..count_u).map(|i| i * count_v + j).collect_vec());
        let along_v = (0..count_u).map(|i| (0..count_v).map(|j| i * count_v + j).collect_vec());
        Some(ControlNet {
            points: self.control_points.chunks_exact(3).map(DVec3::from_slice).collect_vec(),
            weights: self.weights().map(<[f64]>::to_vec),
            lines: along_u.chain(along_v).collect_vec(),
        })
    }
}

/// Patches in the order of their spans, v running fastest.
impl Patches for TensorSurface {
    fn patch_count(&self) -> usize {
        self.knots_u.spans().len() * self.knots_v.spans().len()
    }

    fn patch(&self, index: usize) -> BezierPatch {
        let count = self.knots_v.spans().len();
        let span_u = self.knots_u.span_of_rank(index / count);
        let span_v = self.knots_v.span_of_rank(index % count);
        let degree = [self.knots_u.degree(), self.knots_v.degree()];
        let (net, width) = match &self.weights {
            Some(weights) => (&weights.homogeneous, self.dim + 1),
            None => (&self.control_points, self.dim),
        };
        let line = (degree[1] + 1) * width;
        let mut part = memory::with_capacity((degree[0] + 1) * line);
        for i in span_u - degree[0]..=span_u {
            let first = (i * self.knots_v.basis_count() + span_v - degree[1]) * width;
            part.extend_from_slice(&net[first..first + line]);
        }
        let (rows_u, rows_v) = (extraction(&self.knots_u, span_u), extraction(&self.knots_v, span_v));
        let corner =
            |a: usize| DVec2::new(self.knots_u.knots()[span_u + a], self.knots_v.knots()[span_v + a]);
        BezierPatch {
            domain: Domain { min: corner(0), max: corner(1) },
            degree,
            dim: self.dim,
            is_rational: self.weights.is_some(),
            ordinates: apply(&part, degree, width, &rows_u, &rows_v),
        }
    }

    fn patch_at(&self, uv: DVec2) -> usize {
        self.knots_u.rank_at(uv.x) * self.knots_v.spans().len() + self.knots_v.rank_at(uv.y)
    }
}
