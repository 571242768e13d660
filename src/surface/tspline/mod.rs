//! T-splines with control curves: bicubic surfaces whose lines of control points have knots of their own.
//!
//! X. Yang and J. Zheng, "Approximate T-spline surface skinning" (2012).
//! ```text
//! S(u,v) = sum_j Q_j(u) N_j(v),    Q_j(u) = sum_i V_ij N_i^(j)(u)
//! ```
//! One knot vector along v, one along u for each control curve `Q_j`. The blending functions sum to one and are
//! linearly independent. Four curves are active at a point, so a point costs four points of curves; over one span
//! of v the pieces along u are those of the four curves' knots together.

mod cells;
mod evaluate;
mod fast;
mod refine;
#[cfg(test)]
mod tests;

pub use refine::Removal;

use super::{ControlNet, Domain, Kind, Patches, Region, Surface};
use crate::curve::Curve;
use crate::failure::{Classify, ErrorKind};
use crate::knots::{KnotError, KnotVector};
use crate::memory::CollectVec;
use cells::Cells;
use fast::FastTable;
use glam::{DVec2, DVec3};
use std::sync::OnceLock;

/// The degree in both directions.
pub const DEGREE: usize = 3;

/// Parts are no T-spline, or cannot be changed as asked.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TSplineError {
    /// There are not as many control curves as basis functions along v.
    #[error("{count} control curves are given, the knots along v ask for {expected}")]
    CurveCount {
        /// Curves given.
        count: usize,
        /// Curves that the knots ask for.
        expected: usize,
    },
    /// Every piece is cubic.
    #[error("the degree along v, or of a control curve, is {degree}, it must be {DEGREE}")]
    Degree {
        /// The degree given.
        degree: usize,
    },
    /// A control curve differs from the first one in its dimension or domain, or its ends are not clamped.
    #[error("control curve {index} must be clamped and have the dimension and the domain of the first one")]
    Mismatch {
        /// The curve.
        index: usize,
    },
    /// There is no such control curve.
    #[error("control curve {index} does not exist, there are {count}")]
    NoSuchCurve {
        /// The curve asked for.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// Knots cannot be inserted or removed.
    #[error(transparent)]
    Knots(#[from] KnotError),
    /// Control points are so large that sums of them overflow.
    #[error("the points of control curve {index} are too large to be combined")]
    NotFinite {
        /// The curve.
        index: usize,
    },
}

impl Classify for TSplineError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::NoSuchCurve { .. } => ErrorKind::Index,
            Self::NotFinite { .. } => ErrorKind::NotFinite,
            Self::Knots(error) => error.kind(),
            _ => ErrorKind::InvalidArgument,
        }
    }

    /// The offending control curve or knot.
    fn index(&self) -> Option<usize> {
        match *self {
            Self::Mismatch { index } | Self::NoSuchCurve { index, .. } | Self::NotFinite { index } => {
                Some(index)
            }
            Self::Knots(ref error) => error.index(),
            _ => None,
        }
    }
}

/// A T-spline with control curves.
#[derive(Debug, Clone)]
pub struct TSplineSurface {
    knots_v: KnotVector,
    curves: Vec<Curve>,
    region: Region,
    /// Made at the first call that needs the patches.
    cells: OnceLock<Cells>,
    /// Made at the first evaluation; None for surfaces that it does not serve.
    fast: OnceLock<Option<FastTable>>,
}

impl PartialEq for TSplineSurface {
    fn eq(&self, other: &Self) -> bool {
        self.knots_v == other.knots_v && self.curves == other.curves && self.region == other.region
    }
}

impl TSplineSurface {
    /// Checks and keeps the parts: cubic knots along v and a clamped cubic curve for each of their basis functions,
    /// all over one domain.
    pub fn new(knots_v: KnotVector, curves: Vec<Curve>) -> Result<Self, TSplineError> {
        let expected = knots_v.basis_count();
        if curves.len() != expected {
            return Err(TSplineError::CurveCount { count: curves.len(), expected });
        }
        let degrees = curves.iter().map(|curve| curve.knots().degree()).chain([knots_v.degree()]);
        if let Some(degree) = degrees.into_iter().find(|&degree| degree != DEGREE) {
            return Err(TSplineError::Degree { degree });
        }
        let is_like = |a: &Curve, b: &Curve| a.dim() == b.dim() && a.knots().domain() == b.knots().domain();
        match curves.iter().position(|curve| !curve.knots().is_clamped() || !is_like(curve, &curves[0])) {
            Some(index) => Err(TSplineError::Mismatch { index }),
            None => Ok(Self {
                knots_v,
                curves,
                region: Region::default(),
                cells: OnceLock::new(),
                fast: OnceLock::new(),
            }),
        }
    }

    /// The knots along v.
    pub fn knots_v(&self) -> &KnotVector {
        &self.knots_v
    }

    /// The control curves, one for each basis function along v.
    pub fn curves(&self) -> &[Curve] {
        &self.curves
    }

    /// The four curves over a span of the knots along v.
    fn active(&self, span: usize) -> &[Curve] {
        &self.curves[span - DEGREE..=span]
    }

    fn cells(&self) -> &Cells {
        self.cells.get_or_init(|| Cells::new(self))
    }
}

impl Surface for TSplineSurface {
    fn kind(&self) -> Kind {
        Kind::TSpline
    }

    fn dim(&self) -> usize {
        self.curves[0].dim()
    }

    fn domain(&self) -> Domain {
        let ((u0, u1), (v0, v1)) = (self.curves[0].knots().domain(), self.knots_v.domain());
        Domain { min: DVec2::new(u0, v0), max: DVec2::new(u1, v1) }
    }

    fn coefficient_count(&self) -> usize {
        self.curves.iter().map(|curve| curve.knots().basis_count()).sum()
    }

    fn region(&self) -> &Region {
        &self.region
    }

    fn region_mut(&mut self) -> &mut Region {
        &mut self.region
    }

    fn eval_rows(&self, uv: &[DVec2], max_derivative: usize, out: &mut [f64]) {
        if !self.eval_fast(uv, max_derivative, out) {
            self.eval_rows_plain(uv, max_derivative, out);
        }
    }

    fn patches(&self) -> Option<&dyn Patches> {
        Some(self)
    }

    /// The knots along v, and the knots of each control curve half way to its neighbours.
    fn knot_lines(&self) -> Vec<[DVec2; 2]> {
        let Domain { min, max } = self.domain();
        let across = |v: f64| [DVec2::new(min.x, v), DVec2::new(max.x, v)];
        let mut lines: Vec<[DVec2; 2]> = self.knots_v.breaks().into_iter().map(across).collect_vec();
        let places: Vec<f64> = (0..self.curves.len()).map(|curve| self.knots_v.greville(curve)).collect_vec();
        for (k, curve) in self.curves.iter().enumerate() {
            let from = k.checked_sub(1).map_or(min.y, |before| places[before].midpoint(places[k]));
            let to = places.get(k + 1).map_or(max.y, |&after| places[k].midpoint(after));
            let knots = curve.knots().breaks();
            lines.extend(knots.into_iter().map(|u| [DVec2::new(u, from), DVec2::new(u, to)]));
        }
        lines
    }

    /// The control points of each control curve are a line; those of neighbours are not opposite to one another.
    fn control_net(&self) -> Option<ControlNet> {
        if self.dim() != 3 {
            return None;
        }
        let mut net = ControlNet { points: Vec::new(), weights: None, lines: Vec::new() };
        for curve in &self.curves {
            let start = net.points.len();
            net.points.extend(curve.control_points().chunks_exact(3).map(DVec3::from_slice));
            net.lines.push((start as u32..net.points.len() as u32).collect());
        }
        Some(net)
    }
}
