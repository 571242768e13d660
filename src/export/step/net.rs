//! Knots that begin and end with full multiplicity, as other programs expect them: the same surface, cut off at
//! the ends of its domain.

use crate::geometry::Axis;
use crate::memory::{self, CollectVec};
use crate::surface::Surface;
use crate::surface::tensor::{TensorError, TensorSurface};
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
    pub(super) fn new(surface: &TensorSurface) -> Result<Self, TensorError> {
        let whole = surface.restrict(surface.domain())?;
        let knots = [Axis::U, Axis::V].map(|axis| whole.knots(axis).clone());
        Ok(Self {
            degree: [knots[0].degree(), knots[1].degree()],
            knots: knots.map(|knots| memory::copied(knots.knots())),
            points: whole.control_points().chunks_exact(whole.dim()).map(DVec3::from_slice).collect_vec(),
            weights: whole.weights().map(<[f64]>::to_vec),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::knots::KnotVector;
    use crate::samples::Random;
    use glam::DVec2;

    #[test]
    fn a_clamped_net_is_the_same_surface() {
        let mut random = Random::new(4);
        for degree in [1, 2, 3, 5] {
            for is_rational in [false, true] {
                let mut knots = || {
                    let mut t: Vec<f64> = (0..2 * degree + 5).map(|_| random.unit()).collect();
                    t.sort_unstable_by(f64::total_cmp);
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
