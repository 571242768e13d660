//! Knot vectors: where the polynomial pieces of a spline meet.

use crate::failure::{Classify, ErrorKind};
use crate::memory::{self, CollectVec};

/// Largest degree that curves and surfaces may have; their evaluation keeps one value for each of the
/// `degree + 1` basis functions on the stack.
pub const MAX_DEGREE: usize = 9;

/// Knots that differ do so by this at least: second derivatives divide by their squares, so that values of any size
/// that a double has leave the range of doubles before a division by zero could.
pub const LEAST_STEP: f64 = 1e-290;
/// Knots are at most this large, so that their differences are finite.
pub const LARGEST: f64 = 1e290;

/// A knot vector is not one.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum KnotError {
    /// The degree is not offered.
    #[error("degree {degree} is outside 1 to {MAX_DEGREE}")]
    Degree {
        /// The degree asked for.
        degree: usize,
    },
    /// There is no room for one polynomial piece.
    #[error("{count} knots are too few for degree {degree}, at least {} are needed", 2 * (degree + 1))]
    TooFew {
        /// Knots given.
        count: usize,
        /// Degree given.
        degree: usize,
    },
    /// A knot is NaN or infinite.
    #[error("knot {index} is not finite")]
    NotFinite {
        /// The knot.
        index: usize,
    },
    /// A knot is less than the one before it.
    #[error("knot {index} is less than the knot before it")]
    Decreasing {
        /// The knot.
        index: usize,
    },
    /// A knot occurs so often that the spline falls apart there.
    #[error("knot {index} occurs more than {} times, degree {degree} allows no more", degree + 1)]
    Multiplicity {
        /// The first of the equal knots.
        index: usize,
        /// Degree given.
        degree: usize,
    },
    /// A knot would occur so often that nothing holds the spline together there.
    #[error("the knot {at} would occur more than {degree} times, which tears a spline of degree {degree}")]
    Torn {
        /// The knot.
        at: f64,
        /// Degree of the spline.
        degree: usize,
    },
    /// A knot is so near to the one before it that nothing can be divided by their difference.
    #[error("knot {index} is {step:e} above the knot before it: let them be equal, or {LEAST_STEP:e} apart")]
    TooNear {
        /// The knot.
        index: usize,
        /// How far it is from the one before.
        step: f64,
    },
    /// The knots reach so far that differences of them overflow.
    #[error("the knots reach from {from:e} to {to:e}, they must lie within {LARGEST:e} of zero")]
    TooFar {
        /// The first knot.
        from: f64,
        /// The last one.
        to: f64,
    },
    /// The domain, from knot `degree` to knot `count - degree - 1`, has no length.
    #[error("the knots span no interval: the domain begins and ends at {at}")]
    Empty {
        /// Both ends of the domain.
        at: f64,
    },
    /// A parameter at which a knot should go lies outside the domain.
    #[error("{at} lies outside the domain {from} to {to}")]
    Outside {
        /// The parameter.
        at: f64,
        /// Begin of the domain.
        from: f64,
        /// End of the domain.
        to: f64,
    },
    /// Only knots inside the domain at which the spline is continuous can be removed.
    #[error("there is no knot {index} inside the domain at which the spline is continuous")]
    NotRemovable {
        /// The knot asked for.
        index: usize,
    },
}

impl Classify for KnotError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::NotFinite { .. } => ErrorKind::NotFinite,
            Self::Empty { .. } => ErrorKind::Degenerate,
            Self::Outside { .. } => ErrorKind::Outside,
            Self::NotRemovable { .. } => ErrorKind::Index,
            _ => ErrorKind::InvalidArgument,
        }
    }

    /// The offending knot.
    fn index(&self) -> Option<usize> {
        match *self {
            Self::NotFinite { index }
            | Self::Decreasing { index }
            | Self::TooNear { index, .. }
            | Self::Multiplicity { index, .. }
            | Self::NotRemovable { index } => Some(index),
            _ => None,
        }
    }
}

/// Knots `t_0 <= t_1 <= ...` of a spline of some degree, always valid: finite, ordered, no knot more than
/// `degree + 1` times, and a domain of positive length.
#[derive(Debug, Clone)]
pub struct KnotVector {
    knots: Vec<f64>,
    degree: usize,
    finder: SpanFinder,
}

impl PartialEq for KnotVector {
    fn eq(&self, other: &Self) -> bool {
        self.degree == other.degree && self.knots == other.knots
    }
}

impl KnotVector {
    /// Checks and keeps `knots`.
    pub fn new(knots: Vec<f64>, degree: usize) -> Result<Self, KnotError> {
        if !(1..=MAX_DEGREE).contains(&degree) {
            return Err(KnotError::Degree { degree });
        }
        if knots.len() < 2 * (degree + 1) {
            return Err(KnotError::TooFew { count: knots.len(), degree });
        }
        if let Some(index) = knots.iter().position(|t| !t.is_finite()) {
            return Err(KnotError::NotFinite { index });
        }
        if let Some(index) = knots.windows(2).position(|pair| pair[0] > pair[1]) {
            return Err(KnotError::Decreasing { index: index + 1 });
        }
        let (first, last) = (knots[0], knots[knots.len() - 1]);
        if first.abs().max(last.abs()) > LARGEST {
            return Err(KnotError::TooFar { from: first, to: last });
        }
        let step = |pair: &[f64]| pair[1] - pair[0];
        if let Some(index) = knots.windows(2).position(|pair| step(pair) > 0.0 && step(pair) < LEAST_STEP) {
            return Err(KnotError::TooNear { index: index + 1, step: step(&knots[index..]) });
        }
        if let Some(index) = knots.windows(degree + 2).position(|run| run[0] == run[degree + 1]) {
            return Err(KnotError::Multiplicity { index, degree });
        }
        let (from, to) = (knots[degree], knots[knots.len() - degree - 1]);
        if from >= to {
            return Err(KnotError::Empty { at: from });
        }
        let finder = SpanFinder::new(&knots, degree);
        Ok(Self { knots, degree, finder })
    }

    /// `breaks` with both ends repeated `degree + 1` times.
    pub fn clamped(breaks: &[f64], degree: usize) -> Result<Self, KnotError> {
        let (Some(&first), Some(&last)) = (breaks.first(), breaks.last()) else {
            return Err(KnotError::TooFew { count: 0, degree });
        };
        let ends = |t| std::iter::repeat_n(t, degree);
        Self::new(ends(first).chain(breaks.iter().copied()).chain(ends(last)).collect(), degree)
    }

    /// All knots.
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// Degree of the pieces.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// Number of basis functions, and so of control points.
    pub fn basis_count(&self) -> usize {
        self.knots.len() - self.degree - 1
    }

    /// Begin and end of the domain.
    pub fn domain(&self) -> (f64, f64) {
        (self.knots[self.degree], self.knots[self.basis_count()])
    }

    /// Whether both ends are repeated `degree + 1` times, so that the spline begins and ends at its first
    /// and last control point.
    pub fn is_clamped(&self) -> bool {
        let last = self.knots.len() - 1;
        self.knots[0] == self.knots[self.degree] && self.knots[last] == self.knots[last - self.degree]
    }

    /// The span `k` with `t_k <= u < t_{k+1}`; the first or last span beyond the ends of the domain,
    /// and the last at its end. The basis functions `k - degree ..= k` are the ones not zero there.
    pub fn span(&self, u: f64) -> usize {
        self.finder.find(u)
    }

    /// The spans of positive length in the domain, in order.
    pub fn spans(&self) -> impl ExactSizeIterator<Item = usize> + '_ {
        self.finder.spans.iter().map(|&k| k as usize)
    }

    /// The span of positive length that has `rank` others before it.
    pub fn span_of_rank(&self, rank: usize) -> usize {
        self.finder.spans[rank] as usize
    }

    /// How many spans of positive length lie before the one of `u`.
    pub fn rank_at(&self, u: f64) -> usize {
        self.finder.rank_at(u)
    }

    /// The different knots of the domain, in order.
    pub fn breaks(&self) -> Vec<f64> {
        let (_, end) = self.domain();
        self.spans().map(|k| self.knots[k]).chain([end]).collect_vec()
    }

    /// How often `u` occurs among the knots.
    pub fn multiplicity(&self, u: f64) -> usize {
        self.knots.iter().filter(|&&t| t == u).count()
    }

    /// The parameter that control point `i` belongs to: the mean of its `degree` inner knots.
    pub fn greville(&self, i: usize) -> f64 {
        self.knots[i + 1..=i + self.degree].iter().sum::<f64>() / self.degree as f64
    }
}

/// Finds spans in constant time: the domain is cut into equal buckets, each of which knows the spans
/// that touch it, and the few of one bucket are searched.
#[derive(Debug, Clone)]
struct SpanFinder {
    start: f64,
    buckets_per_unit: f64,
    /// The spans of positive length; a rank is a place in this list.
    spans: Vec<u32>,
    /// The begins of the spans, and infinity.
    starts: Vec<f64>,
    /// The rank at the begin of each bucket, and the last rank at the end.
    first_rank: Vec<u32>,
}

impl SpanFinder {
    /// Buckets per span: with four, one comparison is nearly always enough.
    const BUCKETS_PER_SPAN: usize = 4;

    fn new(knots: &[f64], degree: usize) -> Self {
        let end = knots.len() - degree - 1;
        let spans: Vec<u32> =
            (degree..end).filter(|&k| knots[k] < knots[k + 1]).map(|k| k as u32).collect_vec();
        let bucket_count = Self::BUCKETS_PER_SPAN * spans.len();
        let (start, length) = (knots[degree], knots[end] - knots[degree]);
        let buckets_per_unit = bucket_count as f64 / length;
        let mut first_rank = memory::with_capacity(bucket_count + 1);
        for (rank, &k) in spans.iter().enumerate() {
            // `rank_at` puts a parameter into a bucket by this same rounding, so the bucket that holds
            // the end of a span may begin in it
            let bucket = ((knots[k as usize + 1] - start) * buckets_per_unit) as usize;
            while first_rank.len() <= bucket.min(bucket_count) {
                first_rank.push(rank as u32);
            }
        }
        first_rank.resize(bucket_count + 1, spans.len().saturating_sub(1) as u32);
        let starts = spans.iter().map(|&k| knots[k as usize]).chain([f64::INFINITY]).collect();
        Self { start, buckets_per_unit, spans, starts, first_rank }
    }

    fn find(&self, u: f64) -> usize {
        self.spans[self.rank_at(u)] as usize
    }

    #[inline]
    fn rank_at(&self, u: f64) -> usize {
        // a negative or NaN position becomes bucket 0
        let bucket = ((u - self.start) * self.buckets_per_unit) as usize;
        let Some(next) = self.first_rank.get(bucket + 1) else {
            return self.first_rank[self.first_rank.len() - 1] as usize;
        };
        // an addition in place of a branch that would be guessed wrong half of the time
        let first = self.first_rank[bucket] as usize;
        let rank = first + usize::from(self.starts[first + 1] <= u);
        if self.starts[rank + 1] <= u { self.search(rank + 1, *next as usize, u) } else { rank }
    }

    fn search(&self, mut low: usize, mut high: usize, u: f64) -> usize {
        while low < high {
            let middle = (low + high).div_ceil(2);
            if self.starts[middle] <= u { low = middle } else { high = middle - 1 }
        }
        low
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn knots() -> KnotVector {
        KnotVector::new(vec![0., 0., 0., 0., 1., 2., 2., 2.5, 7., 7., 7., 7.], 3).unwrap()
    }

    #[test]
    fn knots_at_the_ends_of_the_range_are_refused_by_name() {
        let refuse = |knots: [f64; 6]| KnotVector::new(knots.to_vec(), 1).unwrap_err();
        let near = refuse([0., 0., 1e-300, 1e-300, 1., 1.]);
        assert_eq!(near, KnotError::TooNear { index: 2, step: 1e-300 });
        assert!(near.to_string().contains("knot 2 is 1e-300"), "{near}");
        let far = refuse([-1e300, -1e300, 0., 1., 1e300, 1e300]);
        assert_eq!(far, KnotError::TooFar { from: -1e300, to: 1e300 });
        // domains of any other width are as good as the unit interval
        for width in [1e-280, 1e-100, 1e100, 1e280] {
            let knots = KnotVector::clamped(&[0.0, 0.25 * width, width], 3).unwrap();
            let values = crate::basis::basis_functions(&knots, knots.span(0.5 * width), 0.5 * width);
            let sum: f64 = values.iter().take(4).sum();
            assert!((sum - 1.0).abs() <= 8.0 * f64::EPSILON, "{width:e}: {sum}");
        }
    }

    #[test]
    fn refusals_name_the_knot() {
        let refuse = |knots: &[f64], degree| KnotVector::new(knots.to_vec(), degree).unwrap_err();
        assert_eq!(refuse(&[0., 1.], 0), KnotError::Degree { degree: 0 });
        assert_eq!(refuse(&[0.; 40], 10), KnotError::Degree { degree: 10 });
        assert_eq!(refuse(&[0., 1., 2.], 1), KnotError::TooFew { count: 3, degree: 1 });
        assert_eq!(refuse(&[0., 1., f64::NAN, 2.], 1), KnotError::NotFinite { index: 2 });
        assert_eq!(refuse(&[0., 2., 1., 2.], 1), KnotError::Decreasing { index: 2 });
        assert_eq!(refuse(&[0., 0., 1., 1., 1., 2., 2.], 1), KnotError::Multiplicity { index: 2, degree: 1 });
        assert_eq!(refuse(&[0., 1., 1., 2.], 1), KnotError::Empty { at: 1.0 });
    }

    #[test]
    fn a_span_holds_its_parameter() {
        let knots = knots();
        assert_eq!(knots.spans().collect::<Vec<_>>(), [3, 4, 6, 7]);
        for (u, span) in
            [(-3., 3), (0., 3), (0.999, 3), (1., 4), (2., 6), (2.2, 6), (2.5, 7), (7., 7), (9., 7)]
        {
            assert_eq!(knots.span(u), span, "u = {u}");
        }
    }

    proptest::proptest! {
        #[test]
        fn spans_agree_with_a_linear_search(
            steps in proptest::collection::vec(0u32..5, 6..40),
            scale in -20i32..20,
            at in proptest::collection::vec(0.0..1.0f64, 50),
        ) {
            // steps of wildly different lengths, some of them zero
            let mut breaks = vec![0.0];
            for (k, step) in steps.iter().enumerate() {
                breaks.push(breaks[k] + f64::from(*step).powi(6) * f64::from(scale).exp2());
            }
            let Ok(knots) = KnotVector::clamped(&breaks, 3) else { return Ok(()) };
            let (from, to) = knots.domain();
            let places = at.iter().map(|s| from + s * (to - from)).chain(breaks.iter().copied());
            for u in places {
                let expected = knots.spans().filter(|&k| knots.knots()[k] <= u).last();
                proptest::prop_assert_eq!(Some(knots.span(u)), expected, "u = {}", u);
            }
        }
    }
}
