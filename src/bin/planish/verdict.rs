//! What came of a fit, in words.

use crate::Outcome;
use crate::fit_options::FitArguments;
use crate::output::{self};
use planish::fit::report::{Remarks, StopReason};

pub(crate) fn written(arguments: &FitArguments) -> Vec<String> {
    output::names(arguments.out.iter().chain(&arguments.picture).chain(&arguments.report))
}

pub(crate) fn verdict(remarks: Remarks, stop: StopReason) -> String {
    let reason = match stop {
        StopReason::ToleranceMet => "tolerance met",
        StopReason::FixedGrid => "grid as asked",
        StopReason::Limit => "limit on grid or cells reached",
        StopReason::DataExhausted => "more coefficients than data",
        StopReason::Stagnated => "refinement no longer helps",
    };
    if remarks.has(Remarks::TOLERANCE_NOT_MET) {
        format!("TOLERANCE NOT MET: {reason}")
    } else if remarks.has(Remarks::ROUGH_BETWEEN_NODES) {
        format!("{reason}, BUT NOT BETWEEN THE NODES")
    } else {
        reason.to_owned()
    }
}

/// What the exit code tells: whether the tolerance is met at the nodes and between them.
pub(crate) fn outcome(remarks: Remarks) -> Outcome {
    let is_missed = remarks.has(Remarks::TOLERANCE_NOT_MET) || remarks.has(Remarks::ROUGH_BETWEEN_NODES);
    if is_missed { Outcome::ToleranceNotMet } else { Outcome::Done }
}

/// The largest error between the nodes, and what facets explain of it, if they do.
pub(crate) fn between_nodes(error: f64, explained: f64) -> String {
    match explained > 0.0 {
        true => format!("{error:.3e}, of which facets explain {explained:.3e}"),
        false => format!("{error:.3e}"),
    }
}

/// What is worth knowing beside the verdict.
pub(crate) fn remarks(remarks: Remarks) -> Vec<String> {
    let mut rest = remarks;
    rest.remove(Remarks::TOLERANCE_NOT_MET);
    rest.remove(Remarks::STAGNATED);
    rest.words().map(|words| format!("{}: {}", words.what, words.advice)).collect()
}
