//! The same surface with more knots, as a tensor surface, or cut into strips; a near one with fewer knots.
//!
//! A knot along u goes into one curve and changes nothing else. A knot t along v makes a curve more: with
//! `alpha_j = (t - v_j) / (v_{j+3} - v_j)` (W. Boehm 1980) the three curves over it are
//! ```text
//! Q^_j = alpha_j Q_j + (1 - alpha_j) Q_{j-1}
//! ```
//! over the knots of both, so the number of control points can grow by more than one row. A tensor surface needs
//! the knots of all curves in each of them.

use super::{DEGREE, TSplineError, TSplineSurface};
use crate::bezier::extraction;
use crate::curve::{Curve, common_knots, on_common_knots};
use crate::knots::{KnotError, KnotVector};
use crate::memory::{self, CollectVec};
use crate::surface::tensor::{TensorError, TensorSurface};
use crate::surface::{ConvertError, Surface};
use std::sync::OnceLock;

/// What became of a knot that was to be removed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Removal {
    /// A bound of the distance that the surface moves, or would have moved, at any parameter.
    pub error: f64,
    /// Whether the knot is gone: `error` is not above the tolerance.
    pub is_removed: bool,
}

impl TSplineSurface {
    /// Inserts the knot `u` into one control curve; the surface stays the same.
    pub fn insert_knot_u(&mut self, curve: usize, u: f64) -> Result<(), TSplineError> {
        let refined = self.curve(curve)?.insert_knots(&[u])?;
        self.replace_curve(curve, refined);
        Ok(())
    }

    /// Removes the knot of index `knot` from one control curve if the surface then moves by no more than `tolerance`.
    pub fn remove_knot_u(
        &mut self,
        curve: usize,
        knot: usize,
        tolerance: f64,
    ) -> Result<Removal, TSplineError> {
        // basis functions along v are at most one, so the surface moves less than the curve
        let (without, error) = self.curve(curve)?.remove_knot(knot)?;
        let is_removed = error <= tolerance;
        if is_removed {
            self.replace_curve(curve, without);
        }
        Ok(Removal { error, is_removed })
    }

    fn curve(&self, index: usize) -> Result<&Curve, TSplineError> {
        self.curves.get(index).ok_or(TSplineError::NoSuchCurve { index, count: self.curves.len() })
    }

    fn replace_curve(&mut self, index: usize, curve: Curve) {
        self.curves[index] = curve;
        self.forget_tables();
    }

    fn forget_tables(&mut self) {
        (self.cells, self.fast) = (OnceLock::new(), OnceLock::new());
    }

    /// Inserts the knot `v`; the surface stays the same.
    pub fn insert_knot_v(&mut self, v: f64) -> Result<(), TSplineError> {
        let (t, (from, to)) = (self.knots_v.knots(), self.knots_v.domain());
        if !(from < v && v < to) {
            return Err(KnotError::Outside { at: v, from, to }.into());
        }
        if self.knots_v.multiplicity(v) >= DEGREE {
            return Err(KnotError::Torn { at: v, degree: DEGREE }.into());
        }
        let k = t.partition_point(|&t| t <= v) - 1;
        let mut knots = memory::copied(t);
        knots.insert(k + 1, v);
        let knots_v = KnotVector::new(knots, DEGREE)?;
        let blended = |j: usize| -> Result<Curve, TSplineError> {
            match (v - t[j]) / (t[j + DEGREE] - t[j]) {
                1.0 => Ok(self.curves[j].clone()),
                0.0 => Ok(self.curves[j - 1].clone()),
                alpha => Ok(blend(alpha, &self.curves[j], &self.curves[j - 1])?),
            }
        };
        let (first, last) = (k + 1 - DEGREE, k - self.knots_v.multiplicity(v));
        let between = (first..=last).map(blended).collect::<Result<Vec<_>, _>>()?;
        self.curves.splice(first..last, between);
        self.knots_v = knots_v;
        self.forget_tables();
        Ok(())
    }

    /// Control points of [`TSplineSurface::to_tensor`].
    pub fn tensor_coefficient_count(&self) -> Result<usize, TSplineError> {
        let curves: Vec<&Curve> = self.curves.iter().collect_vec();
        Ok(common_knots(&curves)?.basis_count() * self.curves.len())
    }

    /// The same surface as a tensor surface over the knots of all curves; refused if that takes more than
    /// `max_coefficients` control points.
    pub fn to_tensor(&self, max_coefficients: usize) -> Result<TensorSurface, ConvertError> {
        let needed = self.tensor_coefficient_count()?;
        if needed > max_coefficients {
            return Err(ConvertError::TooLarge { needed, limit: max_coefficients });
        }
        let joined = on_common_knots(&self.curves.iter().collect_vec());
        let curves = joined.map_err(TSplineError::from)?;
        let lines: Vec<&[f64]> = curves.iter().map(Curve::control_points).collect_vec();
        let mut tensor = tensor_of(curves[0].knots().clone(), self.knots_v.clone(), &lines, self.dim())?;
        *tensor.region_mut() = self.region.clone();
        Ok(tensor)
    }

    /// Control points of [`TSplineSurface::to_strips`].
    pub fn strip_coefficient_count(&self) -> Result<usize, TSplineError> {
        let count = |span| {
            let curves: Vec<&Curve> = self.active(span).iter().collect_vec();
            Ok(common_knots(&curves)?.basis_count() * (DEGREE + 1))
        };
        self.knots_v.spans().map(count).sum()
    }

    /// The same surface as tensor surfaces over the single spans of v, each over the knots of its four curves only,
    /// each with its part of the trims.
    pub fn to_strips(&self) -> Result<Vec<TensorSurface>, TSplineError> {
        self.knots_v.spans().map(|span| self.strip(span)).collect()
    }

    fn strip(&self, span: usize) -> Result<TensorSurface, TSplineError> {
        let curves = on_common_knots(&self.active(span).iter().collect_vec())?;
        let rows = extraction(&self.knots_v, span);
        let lines: Vec<Vec<f64>> = rows
            .chunks_exact(DEGREE + 1)
            .map(|row| {
                let mut line = memory::filled(0.0, curves[0].control_points().len());
                for (weight, curve) in row.iter().zip(&curves) {
                    line.iter_mut().zip(curve.control_points()).for_each(|(sum, x)| *sum += weight * x);
                }
                line
            })
            .collect();
        let knots_v = KnotVector::clamped(&self.knots_v.knots()[span..=span + 1], DEGREE)?;
        let lines: Vec<&[f64]> = lines.iter().map(Vec::as_slice).collect_vec();
        let mut strip = tensor_of(curves[0].knots().clone(), knots_v, &lines, self.dim())?;
        *strip.region_mut() = self.region.restrict(&self.domain(), &strip.domain());
        Ok(strip)
    }
}

/// `alpha a + (1 - alpha) b` over the knots of both.
fn blend(alpha: f64, a: &Curve, b: &Curve) -> Result<Curve, KnotError> {
    let both = on_common_knots(&[a, b])?;
    let mixed = both[0].control_points().iter().zip(both[1].control_points());
    let points = mixed.map(|(a, b)| alpha * a + (1.0 - alpha) * b).collect();
    Ok(both[0].with_control_points(points))
}

/// The tensor surface whose lines of control points along u are `lines`.
fn tensor_of(
    knots_u: KnotVector,
    knots_v: KnotVector,
    lines: &[&[f64]],
    dim: usize,
) -> Result<TensorSurface, TSplineError> {
    let mut points = memory::with_capacity(lines.len() * lines[0].len());
    for start in (0..lines[0].len()).step_by(dim) {
        lines.iter().for_each(|line| points.extend_from_slice(&line[start..start + dim]));
    }
    TensorSurface::new(dim, knots_u, knots_v, points, None).map_err(|error| match error {
        TensorError::NotFinite { index } => TSplineError::NotFinite { index: index % lines.len() },
        _ => unreachable!("the counts agree"),
    })
}
