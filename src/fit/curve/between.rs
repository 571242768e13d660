//! What a curve does between its data, where nothing is known but their neighbours.

use super::Candidate;
use crate::curve::Curve;
use crate::fit::common::interior::InteriorErrors;
use crate::memory::{self, CollectVec};

/// Places between two neighbours, as shares of the way.
const SHARES: [f64; 3] = [0.25, 0.5, 0.75];

/// Places between neighbours, with the values of the chords there.
pub(super) struct Between {
    u: Vec<f64>,
    values: Vec<f64>,
    /// For each pair of neighbours: the longest chord at either of them. What a curve does between its data is
    /// unknown, but one that leaves a chord by more than the data move around it oscillates.
    allowances: Vec<f64>,
}

impl Between {
    pub(super) fn new(u: &[f64], values: &[f64], dim: usize) -> Self {
        let mut order: Vec<usize> = (0..u.len()).collect_vec();
        order.sort_unstable_by(|&a, &b| u[a].total_cmp(&u[b]).then(a.cmp(&b)));
        let value = |datum: usize| &values[datum * dim..][..dim];
        let pairs: Vec<[usize; 2]> =
            order.windows(2).map(|pair| [pair[0], pair[1]]).filter(|&[a, b]| u[a] < u[b]).collect_vec();
        let chord = |&[a, b]: &[usize; 2]| distance(value(a), value(b));
        let chords: Vec<f64> = pairs.iter().map(chord).collect_vec();
        let allowances = (0..chords.len())
            .map(|k| {
                chords[k.saturating_sub(1)..(k + 2).min(chords.len())].iter().copied().fold(0.0, f64::max)
            })
            .collect_vec();
        let mut between = Self { u: Vec::new(), values: Vec::new(), allowances };
        for [a, b] in pairs {
            for share in SHARES {
                memory::push(&mut between.u, u[a] + share * (u[b] - u[a]));
                memory::extend(
                    &mut between.values,
                    value(a).iter().zip(value(b)).map(|(x, y)| x + share * (y - x)),
                );
            }
        }
        between
    }

    /// Measures a curve.
    pub(super) fn measure(&self, curve: &Curve) -> InteriorErrors {
        let mut rows = memory::filled(0.0, self.values.len());
        curve.eval_rows(&self.u, 0, &mut rows);
        let dim = rows.len() / self.u.len().max(1);
        let mut result = InteriorErrors::default();
        let places = rows.chunks(dim.max(1)).zip(self.values.chunks(dim.max(1)));
        for (k, (place, chord)) in places.enumerate() {
            let error = distance(place, chord);
            result.max = result.max.max(error);
            result.max_excess = result.max_excess.max(error - self.allowances[k / SHARES.len()]);
        }
        result
    }
}

pub(super) fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

impl Candidate {
    /// The largest error at the data and, beyond what these explain, between them.
    pub(super) fn merit(&self) -> f64 {
        self.errors.max.max(self.between.max_excess)
    }
}
