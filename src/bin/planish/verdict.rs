//! What came of a fit, in words.

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

/// What is worth knowing beside the verdict.
pub(crate) fn remarks(remarks: Remarks) -> Vec<String> {
    let mut rest = remarks;
    rest.remove(Remarks::TOLERANCE_NOT_MET);
    rest.remove(Remarks::STAGNATED);
    rest.words().map(|words| format!("{}: {}", words.what, words.advice)).collect()
}
