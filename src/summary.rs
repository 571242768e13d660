//! Many numbers in a few.

use crate::memory::CollectVec;

/// Errors at some data.
#[derive(Debug, Clone, Default)]
pub struct DataErrors {
    /// |S(u_n,v_n) - P_n| of each datum.
    pub each: Vec<f64>,
    /// The largest; 0 without data.
    pub max: f64,
    /// The largest measured by what each datum demands: [`DataErrors::max`] where all demand alike.
    pub demand: f64,
    /// Square root of the mean square.
    pub rms: f64,
    /// The mean.
    pub mean: f64,
    /// The datum with the largest error.
    pub worst_index: usize,
}

/// Sums up the errors of single data.
pub fn summarize(each: Vec<f64>) -> DataErrors {
    let count = each.len().max(1) as f64;
    let (worst_index, max) = each
        .iter()
        .enumerate()
        .fold((0, 0.0), |worst, (index, &error)| if error > worst.1 { (index, error) } else { worst });
    // scaled by the largest, so that squares neither overflow nor vanish
    let scale = if max > 0.0 { max } else { 1.0 };
    let squares: f64 = each.iter().map(|e| (e / scale) * (e / scale)).sum();
    let sum: f64 = each.iter().sum();
    DataErrors {
        rms: scale * (squares / count).sqrt(),
        mean: sum / count,
        max,
        demand: max,
        worst_index,
        each,
    }
}

/// How large numbers are without their signs, the least first; what is no number is left out.
pub fn sorted_sizes(numbers: &[f64]) -> Vec<f64> {
    let mut sizes: Vec<f64> = numbers.iter().map(|x| x.abs()).filter(|x| !x.is_nan()).collect_vec();
    sizes.sort_unstable_by(f64::total_cmp);
    sizes
}

/// The least of sorted numbers that at least this share of them do not exceed; 0 without numbers.
pub fn percentile(sorted: &[f64], share: f64) -> f64 {
    let rank = (share * sorted.len() as f64).ceil() as usize;
    sorted.get(rank.max(1) - 1).copied().unwrap_or(0.0)
}

/// The sum, rounded about once: what each addition loses is added up beside it (A. Neumaier, "Rundungsfehleranalyse
/// einiger Verfahren zur Summation endlicher Summen", Z. Angew. Math. Mech. 54 (1974), 39-51).
pub fn sum(numbers: impl Iterator<Item = f64>) -> f64 {
    let (sum, lost) = numbers.fold((0.0_f64, 0.0), |(sum, lost), x| {
        let next = sum + x;
        let (large, small) = if sum.abs() >= x.abs() { (sum, x) } else { (x, sum) };
        (next, lost + ((large - next) + small))
    });
    sum + lost
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_are_numbers_that_the_share_does_not_exceed() {
        let sizes = sorted_sizes(&[-3.0, f64::NAN, 1.0, 2.0, -4.0]);
        assert_eq!(sizes, [1.0, 2.0, 3.0, 4.0]);
        assert_eq!(
            [0.0, 0.25, 0.26, 0.5, 1.0].map(|share| percentile(&sizes, share)),
            [1.0, 1.0, 2.0, 2.0, 4.0]
        );
        assert_eq!(percentile(&[], 0.5), 0.0);
    }

    #[test]
    fn sums_keep_what_large_terms_would_swallow() {
        assert_eq!(sum([1.0, 1e100, 1.0, -1e100].into_iter()), 2.0);
        assert_eq!(sum(std::iter::repeat_n(0.1, 1 << 20)), 0.1 * f64::from(1 << 20));
    }
}
