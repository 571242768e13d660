//! The outer loop of every method that refines.
//!
//! ```text
//! repeat   fit, and measure
//!          keep the best
//!          refine, or say why there is no further round
//! ```

use super::error::FitError;
use super::report::StopReason;
use crate::control::{Cancelled, Control, Stage};

/// A method that fits in rounds.
pub(crate) trait Rounds {
    /// What a round comes to: a surface or curve, measured.
    type Round;
    /// Why a round is not possible.
    type Error: From<Cancelled> + From<FitError>;

    /// A round has gained something when it leaves less than this share of the least error before.
    const GAIN: f64 = 1.0;

    /// Fits and measures once more.
    fn fit(&mut self, control: &mut Control) -> Result<Self::Round, Self::Error>;

    /// Whether a further round may do where one was not possible.
    fn may_go_on(&self, _error: &Self::Error) -> bool {
        false
    }

    /// What the rounds are to make small: the largest error at the data.
    fn error(&self, round: &Self::Round) -> f64;

    /// The tolerance of that error.
    fn tolerance(&self) -> f64;

    /// Decides what follows, and makes ready for it.
    fn refine(&mut self, standing: &Standing<Self::Round>, control: &Control) -> Next;
}

/// Where a fit stands after a round.
pub(crate) struct Standing<'a, R> {
    /// The round; None where it was not possible.
    pub round: Option<&'a R>,
    /// Its error; infinite where it was not possible.
    pub error: f64,
    /// Whether it is the best so far.
    pub is_best: bool,
    /// Rounds in a row, this one included, that have gained nothing.
    pub idle: usize,
}

/// What follows a round.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Next {
    /// A further one.
    Round,
    /// Nothing: this one is what was asked for.
    Done,
    /// Nothing; the best is taken.
    Stop(StopReason),
    /// Nothing, and this round is none: the best of those before is taken.
    Drop(StopReason),
}

/// The best round, and how it was come by.
pub(crate) struct Outcome<R> {
    pub best: R,
    pub stop: StopReason,
    /// Rounds in all.
    pub passes: usize,
}

/// Fits in rounds until the method stops.
pub(crate) fn run<M: Rounds>(method: &mut M, control: &mut Control) -> Result<Outcome<M::Round>, M::Error> {
    let (mut best, mut failure): (Option<M::Round>, _) = (None, None);
    let (mut passes, mut idle, mut course) = (0, 0, Course::towards(method.tolerance()));
    let stop = loop {
        passes += 1;
        control.enter(Stage::Fit);
        let round = match method.fit(control) {
            Ok(round) => Some(round),
            Err(error) if method.may_go_on(&error) => {
                failure = Some(error);
                None
            }
            Err(error) => return Err(error),
        };
        let error = round.as_ref().map_or(f64::INFINITY, |round| method.error(round));
        let least = best.as_ref().map_or(f64::INFINITY, |best| method.error(best));
        let is_best = round.is_some() && (best.is_none() || error < least);
        if round.is_some() {
            idle = if best.is_none() || error < M::GAIN * least { 0 } else { idle + 1 };
        }
        course.report(if is_best { error } else { least }, control)?;
        let next = method.refine(&Standing { round: round.as_ref(), error, is_best, idle }, control);
        let is_taken = match next {
            Next::Done => true,
            Next::Drop(_) => false,
            Next::Round | Next::Stop(_) => is_best,
        };
        best = if is_taken { round.or(best) } else { best };
        match next {
            Next::Round => {}
            Next::Done => break StopReason::ToleranceMet,
            Next::Stop(stop) | Next::Drop(stop) => break stop,
        }
    };
    match (best, failure) {
        (Some(best), _) => Ok(Outcome { best, stop, passes }),
        (None, Some(error)) => Err(error),
        (None, None) => Err(FitError::Singular.into()),
    }
}

/// How far the error has come from the first towards the tolerance, on a logarithmic scale.
struct Course {
    first: f64,
    tolerance: f64,
}

impl Course {
    fn towards(tolerance: f64) -> Self {
        Self { first: f64::NAN, tolerance }
    }

    /// Tells the listener; `error` is the least so far, infinite before there is one.
    fn report(&mut self, error: f64, control: &mut Control) -> Result<(), Cancelled> {
        if !error.is_finite() {
            return control.report(0.0, f64::NAN);
        }
        self.first = if self.first.is_nan() { error } else { self.first };
        control.report(self.fraction(error), error)
    }

    fn fraction(&self, error: f64) -> f64 {
        let way = (self.first / self.tolerance).ln();
        if way > 0.0 { ((self.first / error.max(self.tolerance)).ln() / way).clamp(0.0, 1.0) } else { 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const IMPOSSIBLE: FitError = FitError::TooFew { count: 0 };

    /// Rounds with given errors; None is one that is not possible.
    struct Given {
        errors: Vec<Option<f64>>,
        next: Vec<Next>,
        idle: Vec<usize>,
    }

    impl Rounds for Given {
        type Round = f64;
        type Error = FitError;

        fn fit(&mut self, _: &mut Control) -> Result<f64, FitError> {
            self.errors.remove(0).ok_or(IMPOSSIBLE)
        }

        fn may_go_on(&self, error: &FitError) -> bool {
            *error == IMPOSSIBLE
        }

        fn error(&self, round: &f64) -> f64 {
            *round
        }

        fn tolerance(&self) -> f64 {
            1.0
        }

        fn refine(&mut self, standing: &Standing<f64>, _: &Control) -> Next {
            self.idle.push(standing.idle);
            self.next.remove(0)
        }
    }

    /// The best error, why the rounds ended, and how many there were.
    type Ending = Result<(f64, StopReason, usize), FitError>;

    /// How the rounds end, the idle ones before each, and the fractions told.
    fn given(rounds: &[(Option<f64>, Next)]) -> (Ending, Vec<usize>, Vec<f64>) {
        let (errors, next) = rounds.iter().copied().unzip();
        let mut told = Vec::new();
        let mut listen = |fraction, _| {
            told.push(fraction);
            std::ops::ControlFlow::Continue(())
        };
        let mut method = Given { errors, next, idle: Vec::new() };
        let outcome = run(&mut method, &mut Control::new(1).with_progress(&mut listen));
        (outcome.map(|o| (o.best, o.stop, o.passes)), method.idle, told)
    }

    #[test]
    fn the_best_is_kept_and_rounds_without_gain_are_counted() {
        let rounds = [
            (Some(100.0), Next::Round),
            (Some(120.0), Next::Round),
            (Some(100.0), Next::Round),
            (Some(10.0), Next::Round),
            (None, Next::Round),
            (Some(20.0), Next::Stop(StopReason::Limit)),
        ];
        let (outcome, idle, told) = given(&rounds);
        assert_eq!(outcome, Ok((10.0, StopReason::Limit, 6)));
        assert_eq!(idle, [0, 1, 2, 0, 0, 1]);
        assert_eq!(told, [0.0, 0.0, 0.0, 0.5, 0.5, 0.5]);
    }

    #[test]
    fn what_was_asked_for_is_taken_and_what_follows_noise_is_not() {
        let done = [(Some(2.0), Next::Round), (Some(3.0), Next::Done)];
        assert_eq!(given(&done).0, Ok((3.0, StopReason::ToleranceMet, 2)));
        let noise = [(Some(2.0), Next::Round), (Some(1.5), Next::Drop(StopReason::Stagnated))];
        assert_eq!(given(&noise).0, Ok((2.0, StopReason::Stagnated, 2)));
    }

    #[test]
    fn a_fit_without_any_round_says_why() {
        assert_eq!(given(&[(None, Next::Stop(StopReason::Limit))]).0, Err(IMPOSSIBLE));
    }
}
