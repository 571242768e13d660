//! The different places of a row, and the order in which they are taken.

use crate::memory::{self, CollectVec};

/// In which order the places of a row are taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Order {
    /// The place that comes first; 0 unless the row is closed or reversed.
    pub first: usize,
    pub is_reversed: bool,
}

impl Order {
    /// The place number `k` of the row as it was given comes at this position.
    pub(super) fn place(&self, k: usize, count: usize) -> usize {
        if self.is_reversed { (self.first + count - k) % count } else { (k + count - self.first) % count }
    }

    /// The places in this order, the first once more at the end if asked for.
    pub(super) fn places(&self, count: usize, repeats_first: bool) -> impl Iterator<Item = usize> + use<> {
        let Self { first, is_reversed } = *self;
        (0..count + usize::from(repeats_first))
            .map(move |k| if is_reversed { (first + 2 * count - k) % count } else { (first + k) % count })
    }
}

/// The places of a row that differ from the one before.
#[derive(Debug, Clone)]
pub(super) struct Distinct<'a> {
    points: &'a [f64],
    dim: usize,
    /// The points that stand for the places.
    kept: Vec<usize>,
    /// For each point the place it belongs to.
    pub owner: Vec<usize>,
    is_closed: bool,
}

impl<'a> Distinct<'a> {
    pub(super) fn new(points: &'a [f64], dim: usize, merge_distance: f64, is_closed: bool) -> Self {
        let mut row =
            Self { points, dim, kept: vec![0], owner: memory::filled(0, points.len() / dim), is_closed };
        for k in 1..row.owner.len() {
            let last = row.kept[row.kept.len() - 1];
            if row.distance(last, k) > merge_distance {
                row.kept.push(k);
            }
            row.owner[k] = row.kept.len() - 1;
        }
        // a closed row whose first point is repeated all the same
        let last = row.kept.len() - 1;
        if is_closed && last > 0 && row.distance(row.kept[last], 0) <= merge_distance {
            row.kept.pop();
            row.owner.iter_mut().filter(|owner| **owner == last).for_each(|owner| *owner = 0);
        }
        row
    }

    fn distance(&self, a: usize, b: usize) -> f64 {
        let (a, b) = (&self.points[a * self.dim..], &self.points[b * self.dim..]);
        a.iter().zip(b).take(self.dim).fold(0.0, |length: f64, (a, b)| length.hypot(a - b))
    }

    /// Places.
    pub(super) fn count(&self) -> usize {
        self.kept.len()
    }

    pub(super) fn merged_count(&self) -> usize {
        self.owner.len() - self.kept.len()
    }

    /// The points in another order, the first one once more at the end of a closed row, and of a row of one place.
    pub(super) fn ordered(&self, order: &Order) -> Vec<f64> {
        self.ordered_of(self.points, order)
    }

    /// The same of other vectors than the points.
    pub(super) fn ordered_of(&self, vectors: &[f64], order: &Order) -> Vec<f64> {
        let places = order.places(self.count(), self.is_closed || self.count() == 1);
        places
            .flat_map(|place| vectors[self.kept[place] * self.dim..][..self.dim].iter().copied())
            .collect_vec()
    }

    /// Shares of the chord length at the points of [`Distinct::ordered`], and the length.
    pub(super) fn chord_parameters(&self, order: &Order) -> (Vec<f64>, f64) {
        if self.count() == 1 {
            return (vec![0.0, 1.0], 0.0);
        }
        let places: Vec<usize> = order.places(self.count(), self.is_closed).collect_vec();
        let mut parameters = vec![0.0];
        for pair in places.windows(2) {
            let step = self.distance(self.kept[pair[0]], self.kept[pair[1]]);
            parameters.push(parameters[parameters.len() - 1] + step);
        }
        let length = parameters[parameters.len() - 1];
        parameters.iter_mut().for_each(|s| *s /= length);
        (parameters, length)
    }
}
