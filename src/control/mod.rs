//! How a long call runs: on how many threads, and who hears of its progress.

mod pool;
#[cfg(test)]
mod tests;
mod watch;

pub use pool::{Forked, Pool, is_pool_thread};
pub use watch::{Cancelled, Watch};

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicI32, AtomicU32, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::sync::{Arc, Mutex};
use watch::POLL;

/// Hears the done fraction (0 to 1) and the error so far (NaN while unknown); breaks to cancel.
pub type ProgressFn<'a> = dyn FnMut(f64, f64) -> ControlFlow<()> + 'a;

/// What a long call is doing.
// C has it under the name planish_stage, with these numbers
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[repr(u32)]
pub enum Stage {
    /// Looks at what it was given.
    #[default]
    Prepare = 0,
    /// Gives a mesh its parameters, or its places on a sphere.
    Parameterize = 1,
    /// Makes a mesh coarser.
    Coarsen = 2,
    /// Lays quadrilaterals over a mesh.
    Layout = 3,
    /// Fits, measures and refines.
    Fit = 4,
    /// Looks for the nearest places.
    Project = 5,
    /// Makes triangles of a surface.
    Tessellate = 6,
    /// Makes another form of a surface.
    Convert = 7,
    /// Writes a file.
    Write = 8,
}

/// Who hears of the progress.
enum Listener<'a> {
    Nobody,
    /// A function of this thread.
    Here(&'a mut ProgressFn<'a>),
    /// The thread that hosts the call.
    Host(mpsc::Sender<Report>),
    /// The function of the pool's watch, which asks between reports as well.
    Watch,
}

/// What a hosted call tells, and where it waits for the answer.
struct Report {
    fraction: f64,
    error: f64,
    answer: mpsc::Sender<ControlFlow<()>>,
}

/// How a long call runs: a pool of threads, a listener that is told on the thread that called, and a flag that any
/// thread may set.
pub struct Control<'a> {
    pool: Arc<Pool>,
    listener: Listener<'a>,
    cancel: Option<&'a AtomicI32>,
    shown_stage: Option<&'a AtomicU32>,
    /// The part of the whole that the present call covers.
    part: (f64, f64),
    /// The part of it that the present stage covers.
    stage: (f64, f64),
    /// What the listener was told last.
    last: (f64, f64),
    /// Whether errors of the present call mean nothing to the listener of the whole.
    hides_error: bool,
}

impl Default for Control<'_> {
    fn default() -> Self {
        Self::new(0)
    }
}

impl<'a> Control<'a> {
    /// `thread_count` 0 means all cores; no progress is reported.
    pub fn new(thread_count: usize) -> Self {
        let whole = (0.0, 1.0);
        Self {
            pool: Arc::new(Pool::new(thread_count)),
            listener: Listener::Nobody,
            cancel: None,
            shown_stage: None,
            part: whole,
            stage: whole,
            last: (0.0, f64::NAN),
            hides_error: false,
        }
    }

    /// The same with a listener.
    pub fn with_progress(self, progress: &'a mut ProgressFn<'a>) -> Self {
        Self { listener: Listener::Here(progress), ..self }
    }

    /// The same with a listener for a call that runs on this thread alone: no other thread is there to ask it, so it is
    /// asked wherever the call looks whether it is to end, at most every 20 ms, and when it reports.
    pub fn with_asked(self, ask: impl Fn(f64, f64) -> ControlFlow<()> + Send + Sync + 'static) -> Self {
        let pool = self.pool.with_watch(Watch::asking(ask, self.last));
        Self { pool: Arc::new(pool), listener: Listener::Watch, ..self }
    }

    /// The same with a flag that cancels when it is not 0.
    pub fn with_cancel(self, cancel: &'a AtomicI32) -> Self {
        Self { cancel: Some(cancel), ..self }
    }

    /// The same with a number that shows the [`Stage`].
    pub fn with_stage(self, stage: &'a AtomicU32) -> Self {
        Self { shown_stage: Some(stage), ..self }
    }

    /// The threads.
    pub fn pool(&self) -> &Pool {
        &self.pool
    }

    /// Threads that share the work, at least 1.
    pub fn thread_count(&self) -> usize {
        self.pool.thread_count()
    }

    /// Runs `work` on the pool: [`Pool::run`].
    pub fn run<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
        self.pool.run(work)
    }

    /// From now on the call is at this stage.
    pub fn enter(&mut self, stage: Stage) {
        if let Some(shown) = self.shown_stage {
            shown.store(stage as u32, Ordering::Relaxed);
        }
    }

    /// From now on progress runs from `from` to `to` of the whole call.
    pub fn set_stage(&mut self, from: f64, to: f64) {
        self.stage = (from, to);
        self.last = (self.fraction(0.0), f64::NAN);
    }

    /// Runs a call that is only a part of this one: what is the whole to it covers `from` to `to` here.
    pub fn within<R>(&mut self, from: f64, to: f64, call: impl FnOnce(&mut Self) -> R) -> R {
        let outer = (self.part, self.stage);
        self.set_stage(from, to);
        self.part = (self.fraction(0.0), self.fraction(1.0));
        self.set_stage(0.0, 1.0);
        let result = call(self);
        (self.part, self.stage) = outer;
        self.set_stage(to, 1.0);
        result
    }

    /// Runs a call whose errors are not in the units of this one: the listener hears NaN instead.
    pub fn without_error<R>(&mut self, call: impl FnOnce(&mut Self) -> R) -> R {
        let outer = std::mem::replace(&mut self.hides_error, true);
        let result = call(self);
        self.hides_error = outer;
        result
    }

    /// How much of everything is done when `fraction` of the present stage is.
    fn fraction(&self, fraction: f64) -> f64 {
        let at = |(from, to): (f64, f64), fraction: f64| from + fraction * (to - from);
        at(self.part, at(self.stage, fraction))
    }

    /// Tells the listener; `fraction` is of the present stage. What was done stays done: it hears of no less than before.
    pub fn report(&mut self, fraction: f64, error: f64) -> Result<(), Cancelled> {
        let error = if self.hides_error { f64::NAN } else { error };
        self.last = (self.fraction(fraction).max(self.last.0), error);
        self.tell()
    }

    fn tell(&mut self) -> Result<(), Cancelled> {
        let (fraction, error) = self.last;
        let answer = match &mut self.listener {
            Listener::Nobody => ControlFlow::Continue(()),
            Listener::Watch => {
                self.pool.watch().ask(fraction, error);
                ControlFlow::Continue(())
            }
            Listener::Here(tell) => tell(fraction, error),
            Listener::Host(host) => {
                let (answer, answered) = mpsc::channel();
                // a host that is gone has cancelled
                let sent = host.send(Report { fraction, error, answer });
                sent.ok().and_then(|()| answered.recv().ok()).unwrap_or(ControlFlow::Break(()))
            }
        };
        let is_set = self.cancel.is_some_and(|cancel| cancel.load(Ordering::Relaxed) != 0);
        if answer.is_break() || is_set {
            self.pool.watch().cancel();
        }
        self.pool.check()
    }

    /// Runs a whole call on the pool. This thread asks the listener meanwhile, when the call reports and at least
    /// every 20 ms, so that it can cancel in the middle of long work: that asks [`Control::report`], [`Pool::check`] or
    /// [`Watch::check`] between its steps.
    pub fn host<R: Send>(&mut self, call: impl FnOnce(&mut Control) -> R + Send) -> Result<R, Cancelled> {
        if let Listener::Watch = self.listener {
            let value = call(self);
            self.pool.check()?;
            return Ok(value);
        }
        if matches!(self.listener, Listener::Nobody | Listener::Host(_)) && self.cancel.is_none() {
            return Ok(call(self));
        }
        let (sender, reports) = mpsc::channel();
        let pool = Arc::clone(&self.pool);
        let (shown_stage, part, stage, last, hides_error) =
            (self.shown_stage, self.part, self.stage, self.last, self.hides_error);
        let result = Mutex::new(None);
        // where there is no thread to give this one works, and asks only when the call reports
        let Some(threads) = pool.threads() else { return Ok(call(self)) };
        threads.in_place_scope(|scope| {
            scope.spawn(|_| {
                // its sender is dropped at the end of this closure even when `call` panics, which ends the waiting
                let mut inner = Control {
                    pool: Arc::clone(&pool),
                    listener: Listener::Host(sender),
                    cancel: None,
                    shown_stage,
                    part,
                    stage,
                    last,
                    hides_error,
                };
                let value = call(&mut inner);
                if let Ok(mut result) = result.lock() {
                    *result = Some((value, (inner.part, inner.stage, inner.last)));
                }
            });
            loop {
                let answer = match reports.recv_timeout(POLL) {
                    Ok(report) => {
                        self.last = (report.fraction, report.error);
                        Some(report.answer)
                    }
                    Err(RecvTimeoutError::Timeout) => None,
                    Err(RecvTimeoutError::Disconnected) => break,
                };
                // a listener that has cancelled is not asked again
                let told = if self.pool.check().is_ok() { self.tell() } else { Err(Cancelled) };
                if let Some(answer) = answer {
                    // nobody waits for it if the call has panicked
                    let _ = answer.send(if told.is_ok() {
                        ControlFlow::Continue(())
                    } else {
                        ControlFlow::Break(())
                    });
                }
            }
        });
        let value = result.into_inner().ok().flatten();
        let (value, state) = value.expect("the scope passes a panic on, so here the call has ended well");
        (self.part, self.stage, self.last) = state;
        self.pool.check()?;
        Ok(value)
    }

    /// Runs `work` on the pool, cancelled as a hosted call is: `work` looks at the [`Watch`] between its steps.
    pub fn watch<R: Send>(&mut self, work: impl FnOnce(&Pool, &Watch) -> R + Send) -> Result<R, Cancelled> {
        self.host(|control| {
            let pool = control.pool();
            let value = pool.run(|| work(pool, pool.watch()));
            pool.check().map(|()| value)
        })?
    }
}
