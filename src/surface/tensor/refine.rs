//! Other nets of the same surface: more knots, a higher degree, a part, the reverse.

use super::{Axis, TensorError, TensorSurface};
use crate::geometry::Domain;
use crate::knots::{KnotError, KnotVector};
use crate::memory::CollectVec;
use crate::refinement::Refinement;
use crate::surface::{Region, Surface};
use glam::DVec2;

impl TensorSurface {
    /// The same surface with `added` knots along an axis, given in any order.
    pub fn insert_knots(&self, axis: Axis, added: &[f64]) -> Result<Self, TensorError> {
        let knots = self.knots(axis);
        let refined = self.refine(axis, &Refinement::insert(knots, added).map_err(|e| blame(axis, e))?)?;
        Ok(refined.with_region(self.region.clone()))
    }

    /// The same surface with a degree along an axis that is not below the present one.
    pub fn elevate_degree(&self, axis: Axis, degree: usize) -> Result<Self, TensorError> {
        if degree < self.knots(axis).degree() {
            return Err(blame(axis, KnotError::Degree { degree }));
        }
        let mut elevated = self.clone();
        while elevated.knots(axis).degree() < degree {
            let step = Refinement::elevate(elevated.knots(axis)).map_err(|e| blame(axis, e))?;
            elevated = elevated.refine(axis, &step)?;
        }
        Ok(elevated.with_region(self.region.clone()))
    }

    /// The part over a rectangle inside the domain, with clamped knots; trims are cut off at its sides.
    pub fn restrict(&self, part: Domain) -> Result<Self, TensorError> {
        let cut = |surface: &Self, axis, start, end| {
            let knots = surface.knots(axis);
            if knots.is_clamped() && knots.domain() == (start, end) {
                return Ok(surface.clone());
            }
            surface.refine(axis, &Refinement::restrict(knots, start, end).map_err(|e| blame(axis, e))?)
        };
        let half = cut(self, Axis::U, part.min.x, part.max.x)?;
        let whole = cut(&half, Axis::V, part.min.y, part.max.y)?;
        Ok(whole.with_region(self.region.restrict(&self.domain(), &part)))
    }

    /// The parts below and above a parameter inside the domain.
    pub fn split(&self, axis: Axis, at: f64) -> Result<[Self; 2], TensorError> {
        let (start, end) = self.knots(axis).domain();
        if !(start < at && at < end) {
            return Err(blame(axis, KnotError::Outside { at, from: start, to: end }));
        }
        let [mut lower, mut upper] = [self.domain(); 2];
        match axis {
            Axis::U => (lower.max.x, upper.min.x) = (at, at),
            Axis::V => (lower.max.y, upper.min.y) = (at, at),
        }
        Ok([self.restrict(lower)?, self.restrict(upper)?])
    }

    /// The same points in the other direction along an axis, over the same domain: `u` becomes
    /// `start + end - u`. Normals turn round.
    pub fn reverse(&self, axis: Axis) -> Result<Self, TensorError> {
        let (start, end) = self.knots(axis).domain();
        // the ends exchange exactly, and nothing inside leaves the domain by rounding
        let mirror = |t: f64| match t {
            _ if t == start => end,
            _ if t == end => start,
            _ if start < t && t < end => (start + end - t).clamp(start, end),
            _ => start + end - t,
        };
        let knots = self.knots(axis).knots().iter().rev().map(|&t| mirror(t)).collect_vec();
        let knots = KnotVector::new(knots, self.knots(axis).degree()).map_err(|e| blame(axis, e))?;
        let points = self.reverse_rows(axis, &self.control_points, self.dim);
        let weights = self.weights().map(|weights| self.reverse_rows(axis, weights, 1));
        let region = self.region.map(|uv| match axis {
            Axis::U => DVec2::new(mirror(uv.x), uv.y),
            Axis::V => DVec2::new(uv.x, mirror(uv.y)),
        });
        Ok(self.with_knots(axis, knots, points, weights)?.with_region(region))
    }

    /// Without a region.
    fn refine(&self, axis: Axis, refinement: &Refinement) -> Result<Self, TensorError> {
        let (net, width) = match &self.weights {
            Some(weights) => (&weights.homogeneous, self.dim + 1),
            None => (&self.control_points, self.dim),
        };
        let line = self.knots_v.basis_count() * width;
        let net: Vec<f64> = match axis {
            Axis::U => refinement.apply(net, line),
            Axis::V => net.chunks_exact(line).flat_map(|line| refinement.apply(line, width)).collect_vec(),
        };
        let knots = refinement.knots().clone();
        if self.weights.is_none() {
            return self.with_knots(axis, knots, net, None);
        }
        let rows = net.chunks_exact(width);
        let points =
            rows.clone().flat_map(|row| row[..self.dim].iter().map(|x| x / row[self.dim])).collect_vec();
        self.with_knots(axis, knots, points, Some(rows.map(|row| row[self.dim]).collect_vec()))
    }

    fn with_knots(
        &self,
        axis: Axis,
        knots: KnotVector,
        points: Vec<f64>,
        weights: Option<Vec<f64>>,
    ) -> Result<Self, TensorError> {
        let (knots_u, knots_v) = match axis {
            Axis::U => (knots, self.knots_v.clone()),
            Axis::V => (self.knots_u.clone(), knots),
        };
        Self::new(self.dim, knots_u, knots_v, points, weights)
    }

    fn with_region(mut self, region: Region) -> Self {
        self.region = region;
        self
    }

    /// Rows of `width` numbers of the net, in reverse along an axis.
    fn reverse_rows(&self, axis: Axis, rows: &[f64], width: usize) -> Vec<f64> {
        let line = self.knots_v.basis_count() * width;
        match axis {
            Axis::U => rows.chunks_exact(line).rev().flatten().copied().collect_vec(),
            Axis::V => rows
                .chunks_exact(line)
                .flat_map(|line| line.chunks_exact(width).rev().flatten())
                .copied()
                .collect_vec(),
        }
    }
}

fn blame(axis: Axis, error: KnotError) -> TensorError {
    TensorError::Knots { axis, error }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::Random;
    use crate::surface::Trims;

    /// A wavy surface with uneven knots, unclamped along v, trimmed by a square with a square hole.
    fn surface(is_rational: bool) -> TensorSurface {
        let mut random = Random::new(8);
        let knots_u = KnotVector::clamped(&[0.0, 0.4, 1.1, 1.1, 2.0], 3).unwrap();
        let knots_v = KnotVector::new(vec![-2.0, -1.0, 0.0, 0.5, 1.25, 2.0, 3.0, 3.5], 2).unwrap();
        let count = knots_u.basis_count() * knots_v.basis_count();
        let points = (0..3 * count).map(|_| random.signed()).collect();
        let weights = is_rational.then(|| (0..count).map(|_| 0.5 + random.unit()).collect());
        let surface = TensorSurface::new(3, knots_u, knots_v, points, weights).unwrap();
        let square =
            |a: f64, b: f64| [(a, a), (b, a), (b, b), (a, b)].map(|(u, v)| DVec2::new(u, v)).to_vec();
        let data_box = Domain { min: DVec2::splat(0.1), max: DVec2::splat(1.9) };
        let trims = Trims::new(vec![square(0.1, 1.9), square(0.5, 1.5)], &surface.domain()).unwrap();
        surface.with_region(Region { data_box: Some(data_box), trims, ..Region::default() })
    }

    /// The parameters in `of` that random places of `part` have there.
    fn assert_same(part: &TensorSurface, whole: &TensorSurface, to_whole: impl Fn(DVec2) -> DVec2) {
        let mut random = Random::new(1);
        let domain = part.domain();
        for _ in 0..200 {
            let uv = domain.min + DVec2::new(random.unit(), random.unit()) * domain.size();
            let (mut a, mut b) = ([0.0; 3], [0.0; 3]);
            part.eval_rows(&[uv], 0, &mut a);
            whole.eval_rows(&[to_whole(uv)], 0, &mut b);
            // a few hundred operations on numbers of about 1, magnified by ends of short spans
            let gap = a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(gap <= 1e4 * f64::EPSILON, "{gap} at {uv}");
            // trims cut polygons exactly; a place on a side may go either way
            assert_eq!(part.region.trims.contains(uv), whole.region.trims.contains(to_whole(uv)), "{uv}");
        }
    }

    #[test]
    fn the_surface_and_its_trims_stay_as_they_are() {
        for is_rational in [false, true] {
            let surface = surface(is_rational);
            for axis in [Axis::U, Axis::V] {
                let inserted = surface.insert_knots(axis, &[0.9, 0.3, 0.3]).unwrap();
                assert_eq!(inserted.knots(axis).knots().len(), surface.knots(axis).knots().len() + 3);
                assert_same(&inserted, &surface, |uv| uv);
                let elevated = surface.elevate_degree(axis, 5).unwrap();
                assert_eq!(elevated.knots(axis).degree(), 5);
                assert_same(&elevated, &surface, |uv| uv);
                for part in surface.split(axis, 0.77).unwrap() {
                    assert_same(&part, &surface, |uv| uv);
                }
                let reversed = surface.reverse(axis).unwrap();
                let (start, end) = surface.knots(axis).domain();
                assert_same(&reversed, &surface, |uv| match axis {
                    Axis::U => DVec2::new(start + end - uv.x, uv.y),
                    Axis::V => DVec2::new(uv.x, start + end - uv.y),
                });
                assert_eq!(reversed.reverse(axis).unwrap().control_points(), surface.control_points());
            }
        }
    }

    #[test]
    fn a_part_keeps_its_side_of_the_trims() {
        let [lower, upper] = surface(false).split(Axis::U, 1.0).unwrap();
        // the cut goes through the hole: the outer square and the hole become one loop on either side
        for part in [&lower, &upper] {
            assert_eq!(part.region.trims.loops().len(), 1);
            assert_eq!(part.region.trims.loops()[0].len(), 8);
        }
        assert_eq!(lower.region.data_box.unwrap().max.x, 1.0);
        assert_eq!(upper.domain().min.x, 1.0);
    }

    #[test]
    fn refusals_name_the_axis() {
        let surface = surface(false);
        let outside = surface.split(Axis::V, 7.0).unwrap_err();
        assert!(matches!(outside, TensorError::Knots { axis: Axis::V, error: KnotError::Outside { .. } }));
        let lower = surface.elevate_degree(Axis::U, 2).unwrap_err();
        assert!(matches!(
            lower,
            TensorError::Knots { axis: Axis::U, error: KnotError::Degree { degree: 2 } }
        ));
    }
}
