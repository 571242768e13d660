//! Where there are no data, in holes and beyond the border, a surface stays near the box of its data.
//!
//! What is smooth alone runs on as steeply as it ends. A surface that leaves the box is fitted once more, over the
//! same cells, with those that have no data under tension: a membrane does not leave the box of its rim.

use crate::control::{Control, Pool};
use crate::geometry::{Bounds, Domain};
use crate::surface::Surface;
use glam::DVec2;
use rayon::prelude::*;

/// A surface may leave the box of its data by this share of the diagonal: a bilinear one does, over a buffer of a tenth
/// of its ranges. A little less is aimed at, since it is measured at some places only.
pub(in crate::fit) const FARTHEST: f64 = 0.1;
pub(in crate::fit) const AIM: f64 = 0.09;

/// Fits of few coefficients take more cells only beyond this share: what they cost in holes, 300 to 1,200 of a few hundred
/// coefficients, is more than a bulge that no trimmed face has.
pub(in crate::fit) const FINER_BEYOND: f64 = 0.25;

/// Where there are no data a plate becomes a membrane within this share of the range: a surface that ends steeply
/// runs on for about as long.
pub(in crate::fit) const TENSE_WITHIN: f64 = 0.03;

/// Multiples of the tension that makes a plate a membrane within [`TENSE_WITHIN`], the least that does is taken.
pub(in crate::fit) const TENSIONS: [f64; 5] = [1.0, 10.0, 1e2, 1e3, 1e4];

/// Errors may grow by this share for it.
const DEARER: f64 = 1.02;

/// Whether cells count as empty only as wholes, or in parts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::fit) enum CutCells {
    No,
    Yes,
}

/// Intervals in which each cell is sampled, along both directions.
const SAMPLES: usize = 3;

/// How a fit is judged.
#[derive(Clone, Copy)]
pub(in crate::fit) struct Standing {
    /// How far its surface leaves the box of the data, as a share of the diagonal.
    pub excursion: f64,
    /// Its error at the data.
    pub error: f64,
    /// Its error between them, beyond what is explained.
    pub between: f64,
}

impl Standing {
    /// Whether it is as good as `other` at the data, and between them no worse than that was anywhere.
    fn is_as_good_as(&self, other: &Self, tolerance: f64) -> bool {
        let is_kept =
            self.error <= DEARER * other.error && (self.error <= tolerance || other.error > tolerance);
        is_kept && self.between <= tolerance.max(DEARER * other.error.max(other.between))
    }
}

/// Whether a surface leaves the box of its data too far; a share of the diagonal.
pub(in crate::fit) fn is_wild(excursion: f64) -> bool {
    !(excursion <= AIM)
}

/// A fit, or one with tension in `refit`, which stays nearer to the box of the data and is as good at them: over the first
/// of the nets of the `same` size on which there is one that is not wild; where all of them leave the box by more than a
/// share, over the first `finer` one on which one leaves it by less.
pub(in crate::fit) fn tamed<N, T, E>(
    fit: T,
    tolerance: f64,
    same: &[N],
    (finer, beyond): (&[N], f64),
    judge: impl Fn(&T, &Pool) -> Standing,
    mut refit: impl FnMut(&N, f64, &mut Control) -> Result<T, E>,
    control: &mut Control,
) -> Result<T, E> {
    let first = judge(&fit, control.pool());
    let (mut tamest, mut least) = (fit, first.excursion);
    let same = same.iter().map(|net| (net, AIM));
    let finer = finer.iter().map(|net| (net, beyond));
    for (net, aim) in same.chain(finer) {
        for tension in TENSIONS {
            if least <= aim {
                break;
            }
            let tense = refit(net, tension, control)?;
            let standing = judge(&tense, control.pool());
            if !standing.is_as_good_as(&first, tolerance) {
                break;
            }
            if standing.excursion < least {
                (tamest, least) = (tense, standing.excursion);
            }
        }
    }
    Ok(tamest)
}

/// How far a surface leaves the box of its data over some cells, as a share of the diagonal.
pub(in crate::fit) fn excursion(
    surface: &dyn Surface,
    cells: &[Domain],
    bounds: &Bounds,
    pool: &Pool,
) -> f64 {
    /// Cells looked at in one piece of work.
    const CHUNK: usize = 64;
    let farthest = |cells: &[Domain]| {
        // a cancelled call throws it away
        if pool.check().is_err() {
            return 0.0;
        }
        let mut places = Vec::with_capacity(cells.len() * (SAMPLES + 1) * (SAMPLES + 1));
        cells.iter().for_each(|cell| add_places(cell, &mut places));
        let mut rows = vec![0.0; places.len() * surface.dim()];
        surface.eval_rows(&places, 0, &mut rows);
        rows.chunks_exact(surface.dim()).map(|row| bounds.distance(row)).fold(0.0, f64::max)
    };
    let distance = pool.run(|| cells.par_chunks(CHUNK).map(farthest).reduce(|| 0.0, f64::max));
    if distance > 0.0 { distance / bounds.diagonal() } else { 0.0 }
}

/// Adds the places of a cell, its corners among them.
fn add_places(cell: &Domain, places: &mut Vec<DVec2>) {
    let (min, max) = (cell.min, cell.max);
    let along = |k: usize, min: f64, max: f64| match k {
        SAMPLES => max,
        _ => min + (max - min) * k as f64 / SAMPLES as f64,
    };
    for i in 0..=SAMPLES {
        for j in 0..=SAMPLES {
            places.push(DVec2::new(along(i, min.x, max.x), along(j, min.y, max.y)));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::knots::KnotVector;
    use crate::surface::tensor::TensorSurface;

    #[test]
    fn the_tension_that_suffices_is_taken_and_none_that_costs_errors() {
        // a fit is its tension; it leaves the box by 1 / tension, and misses by what `cost` says
        let run = |tolerance: f64, same: &[f64], cost: fn(f64) -> f64| {
            let judge =
                |&fit: &f64, _: &Pool| Standing { excursion: 1.0 / fit, error: cost(fit), between: 0.0 };
            let refit = |net: &f64, tension: f64, _: &mut Control| Ok::<f64, ()>(net * tension);
            tamed(0.5, tolerance, same, (&[], AIM), judge, refit, &mut Control::new(1)).unwrap()
        };
        assert_eq!(run(1.0, &[1.0], |_| 0.5), 100.0);
        assert_eq!(run(1.0, &[1.0], |fit| if fit > 5.0 { 0.6 } else { 0.5 }), 1.0);
        assert_eq!(run(1.0, &[1.0], |fit| if fit > 0.7 { 1.001 } else { 0.999 }), 0.5, "it was met");
        assert_eq!(run(0.9, &[1.0], |fit| if fit > 0.7 { 1.001 } else { 0.999 }), 100.0, "it was not met");
        assert_eq!(run(1.0, &[1.0, 50.0], |fit| if fit > 5.0 && fit < 50.0 { 0.6 } else { 0.5 }), 50.0);
    }

    #[test]
    fn a_plane_leaves_the_box_of_its_middle_as_far_as_it_goes() {
        let knots = KnotVector::clamped(&[0.0, 1.0], 1).unwrap();
        let points = [[0.0, 0.0, 0.0], [0.0, 2.0, 0.0], [1.0, 0.0, 0.0], [1.0, 2.0, 0.0]].concat();
        let plane = TensorSurface::new(3, knots.clone(), knots, points, None).unwrap();
        let bounds = Bounds { min: vec![0.25, 0.5, 0.0], max: vec![0.75, 1.5, 0.0] };
        let cells = [Domain { min: DVec2::ZERO, max: DVec2::ONE }];
        let away = excursion(&plane, &cells, &bounds, Control::new(1).pool());
        // a quarter of the sides beyond a box of half of them
        assert!((away - 0.5).abs() <= 4.0 * f64::EPSILON, "{away}");
    }
}
