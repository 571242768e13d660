//! Knots that begin and end with full multiplicity, as other programs expect them: the same surface, cut off at
//! the ends of its domain.
//!
//! The new control points are the values of the end pieces' blossoms at `degree` consecutive new knots.

use super::StepError;
use crate::basis::raise;
use crate::knots::{KnotVector, MAX_DEGREE};
use crate::surface::Surface;
use crate::surface::tensor::{Axis, TensorSurface};
use glam::DVec3;

/// A surface in space as the format holds it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Net {
    /// Along u and v.
    pub degree: [usize; 2],
    /// Along u and v, with multiplicities.
    pub knots: [Vec<f64>; 2],
    /// v running fastest.
    pub points: Vec<DVec3>,
    /// In the order of the points.
    pub weights: Option<Vec<f64>>,
}

impl Net {
    /// The net of a surface in space.
    pub fn new(surface: &TensorSurface) -> Result<Self, StepError> {
        let (knots_u, knots_v) = (surface.knots(Axis::U), surface.knots(Axis::V));
        check_whole(knots_u, Axis::U)?;
        check_whole(knots_v, Axis::V)?;
        let degree = [knots_u.degree(), knots_v.degree()];
        let (dim, weights) = (surface.dim(), surface.weights());
        if knots_u.is_clamped() && knots_v.is_clamped() {
            return Ok(Self {
                degree,
                knots: [knots_u.knots().to_vec(), knots_v.knots().to_vec()],
                points: surface.control_points().chunks_exact(dim).map(DVec3::from_slice).collect(),
                weights: weights.map(<[f64]>::to_vec),
            });
        }
        let width = dim + usize::from(weights.is_some());
        let rows: Vec<f64> = match weights {
            None => surface.control_points().to_vec(),
            Some(weights) => homogeneous(surface.control_points(), weights, dim),
        };
        let line = knots_v.basis_count() * width;
        let along_v: Vec<(Vec<f64>, Vec<f64>)> =
            rows.chunks_exact(line).map(|line| clamped(knots_v, line, width)).collect();
        let knots_of_v = along_v.first().map(|(knots, _)| knots.clone()).unwrap_or_default();
        let rows: Vec<f64> = along_v.into_iter().flat_map(|(_, line)| line).collect();
        let line = (knots_of_v.len() - knots_v.degree() - 1) * width;
        let (knots_of_u, rows) = clamped(knots_u, &rows, line);
        let weight = |row: &[f64]| if weights.is_some() { row[dim] } else { 1.0 };
        Ok(Self {
            degree,
            knots: [knots_of_u, knots_of_v],
            points: rows.chunks_exact(width).map(|row| DVec3::from_slice(row) / weight(row)).collect(),
            weights: weights.map(|_| rows.chunks_exact(width).map(weight).collect()),
        })
    }
}

fn homogeneous(points: &[f64], weights: &[f64], dim: usize) -> Vec<f64> {
    let rows = points.chunks_exact(dim).zip(weights);
    rows.flat_map(|(point, &w)| point.iter().map(move |x| w * x).chain([w])).collect()
}

/// Refuses knots inside the domain at which the surface falls apart.
fn check_whole(knots: &KnotVector, axis: Axis) -> Result<(), StepError> {
    let (degree, (from, to)) = (knots.degree(), knots.domain());
    let torn = |run: &[f64]| run[0] == run[degree] && from < run[0] && run[0] < to;
    match knots.knots().windows(degree + 1).position(torn) {
        None => Ok(()),
        Some(index) => Err(StepError::Torn { axis, index, degree }),
    }
}

/// Knots and rows of `width` numbers with full multiplicity at both ends.
fn clamped(knots: &KnotVector, rows: &[f64], width: usize) -> (Vec<f64>, Vec<f64>) {
    let (from, to) = knots.domain();
    let degree = knots.degree();
    let span = knots.span(from);
    let (t, rows) = clamp_start(knots.knots(), rows.to_vec(), width, degree, span, from);
    // the end is the start of the mirrored curve
    let (t, rows) = mirrored(&t, &rows, width);
    let span = t.iter().rposition(|&t| t <= -to).unwrap_or(degree).min(t.len() - degree - 2);
    let (t, rows) = clamp_start(&t, rows, width, degree, span, -to);
    mirrored(&t, &rows, width)
}

fn mirrored(t: &[f64], rows: &[f64], width: usize) -> (Vec<f64>, Vec<f64>) {
    (t.iter().rev().map(|t| -t).collect(), rows.chunks_exact(width).rev().flatten().copied().collect())
}

fn clamp_start(
    t: &[f64],
    rows: Vec<f64>,
    width: usize,
    degree: usize,
    span: usize,
    start: f64,
) -> (Vec<f64>, Vec<f64>) {
    if span == degree && t[0] == start {
        return (t.to_vec(), rows);
    }
    let new_knots: Vec<f64> = std::iter::repeat_n(start, degree + 1).chain(t[span + 1..].to_vec()).collect();
    let mut new_rows = vec![0.0; (degree + 1) * width];
    for (j, row) in new_rows.chunks_exact_mut(width).enumerate() {
        let mut values = [0.0; MAX_DEGREE + 1];
        values[0] = 1.0;
        for p in 1..=degree {
            raise(t, span, new_knots[j + p], p, &mut values);
        }
        for (point, share) in rows[(span - degree) * width..].chunks_exact(width).zip(&values[..=degree]) {
            row.iter_mut().zip(point).for_each(|(sum, x)| *sum += share * x);
        }
    }
    new_rows.extend_from_slice(&rows[(span + 1) * width..]);
    (new_knots, new_rows)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::Random;
    use glam::DVec2;

    #[test]
    fn a_clamped_net_is_the_same_surface() {
        let mut random = Random::new(4);
        for degree in [1, 2, 3, 5] {
            for is_rational in [false, true] {
                let mut knots = || {
                    let mut t: Vec<f64> = (0..2 * degree + 5).map(|_| random.unit()).collect();
                    t.sort_by(f64::total_cmp);
                    KnotVector::new(t, degree).unwrap()
                };
                let (u, v) = (knots(), knots());
                let count = u.basis_count() * v.basis_count();
                let points: Vec<f64> = (0..3 * count).map(|_| random.signed()).collect();
                let weights = is_rational.then(|| (0..count).map(|_| 0.5 + random.unit()).collect());
                let surface = TensorSurface::new(3, u, v, points, weights).unwrap();
                let net = Net::new(&surface).unwrap();
                let [u, v] = net.knots.clone().map(|knots| KnotVector::new(knots, degree).unwrap());
                assert!(u.is_clamped() && v.is_clamped());
                let points = net.points.iter().flat_map(|p| p.to_array()).collect();
                let same = TensorSurface::new(3, u, v, points, net.weights.clone()).unwrap();
                assert_eq!(same.domain(), surface.domain());
                for _ in 0..20 {
                    let share = DVec2::new(random.unit(), random.unit());
                    let uv = surface.domain().min + share * surface.domain().size();
                    let (mut a, mut b) = ([0.0; 3], [0.0; 3]);
                    surface.eval_rows(&[uv], 0, &mut a);
                    same.eval_rows(&[uv], 0, &mut b);
                    // short spans magnify roundings of the blossom
                    assert!(DVec3::from(a).distance(b.into()) < 1e-9, "{degree} at {uv}");
                }
                assert_eq!(Net::new(&same).unwrap(), net, "{degree}: again");
            }
        }
    }
}
