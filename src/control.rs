//! How a long call runs: on how many threads, and who hears of its progress.

use crate::failure::{Classify, ErrorKind};
use rayon::{ThreadBuilder, ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};
use std::cell::Cell;
use std::num::NonZeroUsize;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc;
use std::sync::{Mutex, OnceLock};
use std::thread::JoinHandle;
use std::time::Duration;

/// The progress callback asked to stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("cancelled by the progress callback")]
pub struct Cancelled;

impl Classify for Cancelled {
    fn kind(&self) -> ErrorKind {
        ErrorKind::Cancelled
    }
}

/// Hears the done fraction (0 to 1) and the error so far (NaN while unknown); breaks to cancel.
pub type ProgressFn<'a> = dyn FnMut(f64, f64) -> ControlFlow<()> + 'a;

/// Threads that share work: exactly as many as asked for, started when first needed.
///
/// Results never depend on their number: work is cut into pieces of fixed size, and pieces are combined in
/// their order.
#[derive(Debug)]
pub struct Pool {
    thread_count: usize,
    threads: OnceLock<Threads>,
}

/// Threads that have ended when this is dropped: a program may unload the library after its last call.
#[derive(Debug)]
struct Threads {
    /// None while it is dropped.
    pool: Option<ThreadPool>,
    handles: Vec<JoinHandle<()>>,
}

impl Threads {
    fn start(count: usize) -> Result<Self, ThreadPoolBuildError> {
        let mut handles = Vec::with_capacity(count);
        let spawn = |thread: ThreadBuilder| {
            handles.push(std::thread::Builder::new().spawn(|| {
                IS_POOL_THREAD.set(true);
                thread.run();
            })?);
            Ok(())
        };
        let pool = ThreadPoolBuilder::new().num_threads(count).spawn_handler(spawn).build()?;
        Ok(Self { pool: Some(pool), handles })
    }

    fn pool(&self) -> &ThreadPool {
        self.pool.as_ref().expect("only taken when dropped")
    }
}

impl Drop for Threads {
    fn drop(&mut self) {
        self.pool = None; // tells the threads to end
        for handle in self.handles.drain(..) {
            // panics of the work have gone to whoever waited for it
            let _ = handle.join();
        }
    }
}

impl Pool {
    /// `thread_count` 0 means all cores.
    pub fn new(thread_count: usize) -> Self {
        let all = || std::thread::available_parallelism().map_or(1, NonZeroUsize::get);
        let thread_count = if thread_count == 0 { all() } else { thread_count };
        Self { thread_count, threads: OnceLock::new() }
    }

    /// Threads that share the work, at least 1.
    pub fn thread_count(&self) -> usize {
        self.thread_count
    }

    /// Runs `work` so that rayon's parallel iterators and joins inside it use this pool.
    pub fn run<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
        self.threads().install(work)
    }

    fn threads(&self) -> &ThreadPool {
        let start =
            || Threads::start(self.thread_count).expect("the system has a thread for each core it reports");
        self.threads.get_or_init(start).pool()
    }
}

thread_local! {
    static IS_POOL_THREAD: Cell<bool> = const { Cell::new(false) };
}

/// Whether this thread belongs to a [`Pool`]: a panic here is passed on to the thread that waits for the work.
pub fn is_pool_thread() -> bool {
    IS_POOL_THREAD.try_with(Cell::get).unwrap_or(false)
}

/// How a long call runs: a pool of threads, and a listener that is told on the thread that called.
pub struct Control<'a> {
    pool: Pool,
    progress: Option<&'a mut ProgressFn<'a>>,
    /// The part of the whole that the present call covers.
    part: (f64, f64),
    /// The part of it that the present stage covers.
    stage: (f64, f64),
    /// What the listener was told last.
    last: (f64, f64),
}

impl Default for Control<'_> {
    fn default() -> Self {
        Self::new(0)
    }
}

/// How often a listener is asked while threads are at work.
const POLL: Duration = Duration::from_millis(20);

impl<'a> Control<'a> {
    /// `thread_count` 0 means all cores; no progress is reported.
    pub fn new(thread_count: usize) -> Self {
        let whole = (0.0, 1.0);
        Self {
            pool: Pool::new(thread_count),
            progress: None,
            part: whole,
            stage: whole,
            last: (0.0, f64::NAN),
        }
    }

    /// The same with a listener.
    pub fn with_progress(self, progress: &'a mut ProgressFn<'a>) -> Self {
        Self { progress: Some(progress), ..self }
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

    /// How much of everything is done when `fraction` of the present stage is.
    fn fraction(&self, fraction: f64) -> f64 {
        let at = |(from, to): (f64, f64), fraction: f64| from + fraction * (to - from);
        at(self.part, at(self.stage, fraction))
    }

    /// Tells the listener; `fraction` is of the present stage. What was done stays done: it hears of no less than before.
    pub fn report(&mut self, fraction: f64, error: f64) -> Result<(), Cancelled> {
        self.last = (self.fraction(fraction).max(self.last.0), error);
        self.tell()
    }

    fn tell(&mut self) -> Result<(), Cancelled> {
        let (fraction, error) = self.last;
        match self.progress.as_mut().map(|tell| tell(fraction, error)) {
            Some(ControlFlow::Break(())) => Err(Cancelled),
            _ => Ok(()),
        }
    }

    /// Runs `work` on the pool while the calling thread keeps asking the listener, so that it can cancel
    /// in the middle of long work: `work` looks at the [`Watch`] between its steps.
    pub fn watch<R: Send>(&mut self, work: impl FnOnce(&Pool, &Watch) -> R + Send) -> Result<R, Cancelled> {
        let watch = Watch { is_cancelled: AtomicBool::new(false) };
        if self.progress.is_none() {
            let pool = &self.pool;
            return Ok(pool.run(|| work(pool, &watch)));
        }
        let result = Mutex::new(None);
        let (finished, has_finished) = mpsc::channel();
        let mut told = Ok(());
        let pool =
            Pool { thread_count: self.pool.thread_count, threads: std::mem::take(&mut self.pool.threads) };
        pool.threads().in_place_scope(|scope| {
            scope.spawn(|_| {
                // dropped at the end of this closure even when `work` panics, which ends the waiting
                let _finished: mpsc::Sender<()> = finished;
                let value = work(&pool, &watch);
                if let Ok(mut result) = result.lock() {
                    *result = Some(value);
                }
            });
            while has_finished.recv_timeout(POLL) == Err(mpsc::RecvTimeoutError::Timeout) {
                if told.is_ok() {
                    told = self.tell();
                    watch.is_cancelled.store(told.is_err(), Ordering::Relaxed);
                }
            }
        });
        self.pool = pool;
        told?;
        let value = result.into_inner().ok().flatten();
        Ok(value.expect("the scope passes a panic on, so here the work has ended well"))
    }
}

/// Seen by work on other threads: whether the listener wants it to end.
#[derive(Debug)]
pub struct Watch {
    is_cancelled: AtomicBool,
}

impl Watch {
    /// An error once the listener has cancelled.
    pub fn check(&self) -> Result<(), Cancelled> {
        if self.is_cancelled.load(Ordering::Relaxed) { Err(Cancelled) } else { Ok(()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_is_cancelled_from_the_calling_thread() {
        let caller = std::thread::current().id();
        let mut calls = 0;
        let mut progress = |_: f64, _: f64| {
            assert_eq!(std::thread::current().id(), caller);
            calls += 1;
            if calls > 2 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let mut control = Control::new(2).with_progress(&mut progress);
        let work = |_: &Pool, watch: &Watch| {
            while watch.check().is_ok() {
                std::thread::sleep(Duration::from_millis(1));
            }
        };
        assert_eq!(control.watch(work), Err(Cancelled));
        assert_eq!(calls, 3);
    }

    #[test]
    fn a_call_within_a_call_covers_its_part() {
        let mut told = Vec::new();
        let mut progress = |fraction: f64, _: f64| {
            told.push(fraction);
            ControlFlow::Continue(())
        };
        let mut control = Control::new(1).with_progress(&mut progress);
        let inner = |control: &mut Control| {
            control.set_stage(0.0, 0.5);
            control.report(0.5, f64::NAN)?;
            control.set_stage(0.5, 1.0);
            control.report(1.0, f64::NAN)
        };
        control.within(0.5, 0.75, inner).unwrap();
        control.report(0.5, f64::NAN).unwrap();
        assert_eq!(told, [0.5625, 0.75, 0.875]);
    }

    #[test]
    fn work_that_ends_first_returns_its_value() {
        let mut progress = |_: f64, _: f64| ControlFlow::Continue(());
        assert_eq!(Control::new(1).with_progress(&mut progress).watch(|_, _| 7), Ok(7));
        assert_eq!(Control::new(1).watch(|pool, _| pool.thread_count()), Ok(1));
    }
}
