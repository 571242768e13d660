//! Which of several ways to a model is taken: the first that does all that was asked for, or else the best.

use super::ModelReport;
use super::error::ModelFitError;
use super::mesh_model::Component;
use super::report::BACK_SLACK;
use crate::control::Control;
use crate::failure::{Classify, ErrorKind};
use crate::fit::common::report::Remarks;

/// A way to make something, which may have nothing to do, and its share of the time.
pub(super) type Way<'a, Made> = (f64, &'a dyn Fn(&mut Control) -> Result<Option<Made>, ModelFitError>);

/// What the first way makes that does all that was asked for, or else the best of all; one at least has something to do.
pub(super) fn first_done<Made>(
    ways: &[Way<Made>],
    is_done: impl Fn(&Made) -> bool,
    better: impl Fn(Made, Made) -> Made,
    control: &mut Control,
) -> Result<Made, ModelFitError> {
    let (mut best, mut failure) = (None, None);
    let mut from = 0.0;
    for (share, way) in ways {
        let to = from + share;
        match control.within(from, to, |control| way(control)) {
            Ok(Some(made)) if is_done(&made) => return Ok(made),
            Ok(Some(made)) => {
                best = Some(match best {
                    Some(best) => better(made, best),
                    None => made,
                })
            }
            Ok(None) => {}
            Err(error) if error.kind() == ErrorKind::Cancelled => return Err(error),
            Err(error) => failure = Some(error),
        }
        from = to;
    }
    best.ok_or_else(|| failure.expect("one way has something to do"))
}

/// Whether a fit is all that was asked for at the nodes.
pub(super) fn is_good(report: &ModelReport) -> bool {
    !report.remarks.has(Remarks::TOLERANCE_NOT_MET) && report.folded_cells == 0
}

/// Whether it is that, and the model leaves no facet by much: few nodes tell little of large facets.
pub(super) fn is_good_both_ways(report: &ModelReport) -> bool {
    is_good(report) && report.max_back_excess <= BACK_SLACK * report.tolerance
}

fn error_both_ways(report: &ModelReport) -> f64 {
    report.max_error.max(report.max_back_excess / BACK_SLACK)
}

/// Whether a component is all that was asked for, or that noise lets be had.
pub(super) fn is_done(made: &Component) -> bool {
    made.misses_noise_only || is_good_both_ways(&made.report.fit)
}

/// Whether a fit is better than another: without folds, then with fewer where both are near enough, then nearer to the nodes.
pub(super) fn is_better(report: &ModelReport, other: &ModelReport) -> bool {
    is_better_by(|report| report.max_error, report, other)
}

/// The same with the distance of the model from the facets beside that of the nodes.
pub(super) fn is_better_both_ways(report: &ModelReport, other: &ModelReport) -> bool {
    is_better_by(error_both_ways, report, other)
}

fn is_better_by(error: impl Fn(&ModelReport) -> f64, report: &ModelReport, other: &ModelReport) -> bool {
    let is_near = |report: &ModelReport| error(report) <= report.tolerance;
    match (report.folded_cells == 0, other.folded_cells == 0) {
        (true, false) => error(report) <= NEARLY * error(other),
        (false, true) => NEARLY * error(report) < error(other),
        (false, false) if is_near(report) && is_near(other) => report.folded_cells <= other.folded_cells,
        _ => error(report) <= error(other),
    }
}

/// A fit with folds has to be so many times nearer to be preferred.
const NEARLY: f64 = 4.0;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::Cancelled;

    #[test]
    fn the_first_way_that_serves_is_taken_or_else_the_best() {
        let made = |value: f64| move |_: &mut Control| Ok(Some(value));
        let nothing = |_: &mut Control| Ok(None);
        let fails = |_: &mut Control| Err(ModelFitError::Open { loops: 1, node: 0 });
        let [one, three, nine] = [made(1.0), made(3.0), made(9.0)];
        let take = |ways: &[Way<f64>]| first_done(ways, |made| *made > 8.0, f64::min, &mut Control::new(1));
        assert_eq!(take(&[(0.5, &three), (0.5, &one)]).unwrap(), 1.0);
        assert_eq!(take(&[(0.3, &three), (0.3, &nine), (0.4, &one)]).unwrap(), 9.0);
        assert_eq!(take(&[(0.3, &fails), (0.3, &nothing), (0.4, &one)]).unwrap(), 1.0);
        assert!(take(&[(0.5, &fails), (0.5, &nothing)]).is_err());
        let cancels = |_: &mut Control| Err(Cancelled.into());
        assert!(take(&[(0.5, &one), (0.5, &cancels)]).is_err());
    }
}
