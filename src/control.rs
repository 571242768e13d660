//! How a long call runs: on how many threads, and who hears of its progress.

use crate::failure::{Classify, ErrorKind};
use rayon::{ThreadBuilder, ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};
use std::cell::Cell;
use std::fmt;
use std::io;
use std::num::NonZeroUsize;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicI32, AtomicU32, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::sync::{Arc, Mutex, OnceLock};
use std::thread::{JoinHandle, ThreadId};
use std::time::{Duration, Instant};

/// The listener, or whoever set the flag, asked to stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("cancelled by the caller")]
pub struct Cancelled;

impl Classify for Cancelled {
    fn kind(&self) -> ErrorKind {
        ErrorKind::Cancelled
    }
}

/// Threads were started in the process that this one was forked from, and stayed there.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("its threads stayed in the process that was forked: make another one in this process")]
pub struct Forked;

/// Hears the done fraction (0 to 1) and the error so far (NaN while unknown); breaks to cancel.
pub type ProgressFn<'a> = dyn FnMut(f64, f64) -> ControlFlow<()> + 'a;

/// What a long call is doing.
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

/// Threads that share work: as many as asked for, started when first needed; where the system has no more to give, as
/// many as it has, and in the end the calling thread alone, which is also the one of a pool of one.
///
/// Results never depend on their number: work is cut into pieces of fixed size, and pieces are combined in
/// their order.
#[derive(Debug)]
pub struct Pool {
    thread_count: usize,
    /// None where the system has no thread to give.
    threads: OnceLock<Option<Threads>>,
    watch: Watch,
}

/// Threads that have ended when this is dropped: a program may unload the library after its last call.
#[derive(Debug)]
struct Threads {
    /// None while it is dropped.
    pool: Option<ThreadPool>,
    handles: Vec<JoinHandle<()>>,
    /// A process forked from this one has none of the threads.
    process: u32,
}

/// Starts a thread of a pool.
type Spawn = fn(ThreadBuilder) -> io::Result<JoinHandle<()>>;

fn spawn(thread: ThreadBuilder) -> io::Result<JoinHandle<()>> {
    std::thread::Builder::new().spawn(|| {
        IS_POOL_THREAD.set(true);
        thread.run();
    })
}

impl Threads {
    /// As many as asked for, or half as often as it takes; None if there is not one.
    fn start(mut count: usize, spawn: Spawn) -> Option<Self> {
        loop {
            match Self::start_all(count, spawn) {
                Ok(threads) => return Some(threads),
                Err(_) if count > 1 => count /= 2,
                Err(_) => return None,
            }
        }
    }

    fn start_all(count: usize, spawn: Spawn) -> Result<Self, ThreadPoolBuildError> {
        let mut handles = Vec::with_capacity(count);
        let keep = |thread: ThreadBuilder| spawn(thread).map(|handle| handles.push(handle));
        match ThreadPoolBuilder::new().num_threads(count).spawn_handler(keep).build() {
            Ok(pool) => Ok(Self { pool: Some(pool), handles, process: std::process::id() }),
            Err(error) => {
                // those that have started are told to end, and panics are none here
                handles.into_iter().for_each(|handle| drop(handle.join()));
                Err(error)
            }
        }
    }

    /// Whether they are in this process.
    fn are_here(&self) -> bool {
        self.process == std::process::id()
    }

    fn pool(&self) -> &ThreadPool {
        self.pool.as_ref().expect("only taken when dropped")
    }
}

impl Drop for Threads {
    fn drop(&mut self) {
        if !self.are_here() {
            // nobody would hear, waiting would never end, and there is nothing to let go of
            std::mem::forget((self.pool.take(), std::mem::take(&mut self.handles)));
            return;
        }
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
        let thread_count = if thread_count == 0 { core_count() } else { thread_count };
        Self { thread_count, threads: OnceLock::new(), watch: Watch::default() }
    }

    /// Whether the call that this pool works for is to end, for work that needs no threads.
    pub fn watch(&self) -> &Watch {
        &self.watch
    }

    /// The same for so many pieces of work: more threads than pieces would only be started and ended.
    pub fn for_pieces(thread_count: usize, pieces: usize) -> Self {
        let most = pieces.max(1);
        // a single piece need not know how many cores there are
        Self::new(if most == 1 || thread_count == 1 {
            1
        } else {
            Self::new(thread_count).thread_count.min(most)
        })
    }

    /// An error once the call that this pool works for is to end: asked between pieces of work.
    pub fn check(&self) -> Result<(), Cancelled> {
        self.watch.check()
    }

    /// Threads that share the work, at least 1.
    pub fn thread_count(&self) -> usize {
        self.thread_count
    }

    /// Runs `work` so that rayon's parallel iterators and joins inside it use this pool.
    pub fn run<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
        if self.thread_count == 1 {
            return on_this_thread(work);
        }
        match self.threads() {
            Some(threads) => threads.install(work),
            None => on_this_thread(work),
        }
    }

    /// None where the system has no thread to give.
    fn threads(&self) -> Option<&ThreadPool> {
        self.threads.get_or_init(|| Threads::start(self.thread_count, spawn)).as_ref().map(Threads::pool)
    }

    /// An error if the threads have been started in another process: asked by what keeps a pool between calls.
    pub fn check_process(&self) -> Result<(), Forked> {
        let are_here = self.threads.get().and_then(Option::as_ref).is_none_or(Threads::are_here);
        if are_here { Ok(()) } else { Err(Forked) }
    }
}

/// Cores that this process may use, asked for once: the system reads files to answer.
fn core_count() -> usize {
    static COUNT: OnceLock<usize> = OnceLock::new();
    *COUNT.get_or_init(|| std::thread::available_parallelism().map_or(1, NonZeroUsize::get))
}

/// Runs work without starting a thread.
fn on_this_thread<R>(work: impl FnOnce() -> R) -> R {
    if rayon::current_thread_index().is_none() {
        let alone = ThreadPoolBuilder::new().num_threads(1).use_current_thread().build();
        // rayon knows no end of such a pool: it lives as long as the thread
        alone.into_iter().for_each(std::mem::forget);
    }
    work()
}

thread_local! {
    static IS_POOL_THREAD: Cell<bool> = const { Cell::new(false) };
}

/// Whether this thread belongs to a [`Pool`]: a panic here is passed on to the thread that waits for the work.
pub fn is_pool_thread() -> bool {
    IS_POOL_THREAD.try_with(Cell::get).unwrap_or(false)
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

/// How often a listener is asked while threads are at work.
const POLL: Duration = Duration::from_millis(20);

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
        let asker = Asker {
            thread: std::thread::current().id(),
            ask: Box::new(ask),
            last: Mutex::new((Instant::now(), self.last)),
        };
        let watch = Watch { asker: Some(asker), ..Watch::default() };
        let pool = Pool { thread_count: self.pool.thread_count, threads: OnceLock::new(), watch };
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
                self.pool.watch.ask(fraction, error);
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
            self.pool.watch.cancel();
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
            let value = pool.run(|| work(pool, &pool.watch));
            pool.check().map(|()| value)
        })?
    }
}

/// Seen by work on other threads: whether the call is to end.
#[derive(Debug, Default)]
pub struct Watch {
    is_cancelled: AtomicBool,
    asker: Option<Asker>,
}

/// Asks the listener of a call that has one thread.
struct Asker {
    /// The only one on which it is asked.
    thread: ThreadId,
    ask: Box<dyn Fn(f64, f64) -> ControlFlow<()> + Send + Sync>,
    /// When it was asked last, and what it was told.
    last: Mutex<(Instant, (f64, f64))>,
}

impl fmt::Debug for Asker {
    fn fmt(&self, to: &mut fmt::Formatter) -> fmt::Result {
        write!(to, "Asker on {:?}", self.thread)
    }
}

impl Watch {
    /// An error once the call is cancelled.
    pub fn check(&self) -> Result<(), Cancelled> {
        if let Some(asker) = &self.asker
            && let Ok(last) = asker.last.try_lock().map(|last| *last)
            && last.0.elapsed() >= POLL
        {
            let (fraction, error) = last.1;
            self.ask(fraction, error);
        }
        if self.is_cancelled.load(Ordering::Relaxed) { Err(Cancelled) } else { Ok(()) }
    }

    /// The same once for so many pieces of work, each of some microseconds, that are numbered from 0.
    pub fn check_at(&self, piece: usize) -> Result<(), Cancelled> {
        const PIECES: usize = 256;
        if piece.is_multiple_of(PIECES) { self.check() } else { Ok(()) }
    }

    /// Asks the listener if this is its thread. One that has cancelled is not asked again.
    fn ask(&self, fraction: f64, error: f64) {
        let Some(asker) = &self.asker else { return };
        if self.is_cancelled.load(Ordering::Relaxed) || asker.thread != std::thread::current().id() {
            return;
        }
        // not locked while it is asked: it may call the library
        if let Ok(mut last) = asker.last.lock() {
            *last = (Instant::now(), (fraction, error));
        }
        if (asker.ask)(fraction, error).is_break() {
            self.cancel();
        }
    }

    fn cancel(&self) {
        self.is_cancelled.store(true, Ordering::Relaxed);
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
    fn work_is_done_with_fewer_threads_than_asked_for() {
        use rayon::prelude::*;
        let none: Spawn = |_| Err(io::Error::other("no thread to be had"));
        let one: Spawn = |thread| match thread.index() {
            0 => spawn(thread),
            _ => Err(io::Error::other("no other thread to be had")),
        };
        for (spawn, found) in [(none, None), (one, Some(1))] {
            // a thread of its own, which rayon then knows for the rest of its life
            let (threads, sum) = std::thread::spawn(move || {
                let pool = Pool::new(8);
                let threads = pool.threads.get_or_init(|| Threads::start(8, spawn)).as_ref();
                let threads = threads.map(|threads| threads.handles.len());
                (threads, [0, 1].map(|_| pool.run(|| (0..1000_u64).into_par_iter().sum::<u64>())))
            })
            .join()
            .unwrap();
            assert_eq!((threads, sum), (found, [499_500; 2]));
        }
    }

    #[test]
    fn a_pool_of_one_is_the_calling_thread() {
        use rayon::prelude::*;
        let caller = std::thread::current().id();
        let on_caller = |_: usize| std::thread::current().id() == caller;
        assert!(Pool::new(1).run(|| (0..1000).into_par_iter().all(on_caller)));
        // a listener too, which hears while the work says nothing
        let asked = Arc::new(AtomicI32::new(0));
        let ask = {
            let asked = Arc::clone(&asked);
            move |_: f64, _: f64| {
                assert_eq!(std::thread::current().id(), caller);
                if asked.fetch_add(1, Ordering::Relaxed) < 3 {
                    ControlFlow::Continue(())
                } else {
                    ControlFlow::Break(())
                }
            }
        };
        let work = |pool: &Pool, watch: &Watch| {
            let is_here = std::thread::current().id() == caller;
            while pool.run(|| watch.check()).is_ok() {
                std::thread::sleep(Duration::from_millis(1));
            }
            is_here
        };
        let start = Instant::now();
        assert_eq!(Control::new(1).with_asked(ask).watch(work), Err(Cancelled));
        assert_eq!(asked.load(Ordering::Relaxed), 4);
        assert!(start.elapsed() >= 4 * POLL);
    }

    #[test]
    fn pools_are_no_larger_than_the_pieces_of_work() {
        assert_eq!(Pool::for_pieces(64, 2).thread_count(), 2);
        assert_eq!(Pool::for_pieces(2, 64).thread_count(), 2);
        assert_eq!(Pool::for_pieces(0, 1).thread_count(), 1);
        assert_eq!(Pool::for_pieces(3, 0).thread_count(), 1);
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
    fn a_hosted_call_is_asked_for_while_it_says_nothing() {
        let mut told = Vec::new();
        let mut progress = |fraction: f64, _: f64| {
            told.push(fraction);
            ControlFlow::Continue(())
        };
        let call = |control: &mut Control| {
            control.report(0.25, f64::NAN)?;
            std::thread::sleep(4 * POLL);
            control.report(0.5, f64::NAN)
        };
        Control::new(1).with_progress(&mut progress).host(call).unwrap().unwrap();
        assert_eq!((told[0], told[told.len() - 1]), (0.25, 0.5));
        assert!(
            told.len() > 2 && told[1..told.len() - 1].iter().all(|&fraction| fraction == 0.25),
            "{told:?}"
        );
    }

    #[test]
    fn a_flag_cancels_without_a_listener() {
        let (flag, stage) = (AtomicI32::new(0), AtomicU32::new(7));
        let mut control = Control::new(2).with_cancel(&flag).with_stage(&stage);
        let call = |control: &mut Control| {
            control.enter(Stage::Fit);
            while control.pool().check().is_ok() {
                flag.store(1, Ordering::Relaxed);
            }
        };
        assert_eq!(control.host(call), Err(Cancelled));
        assert_eq!(stage.load(Ordering::Relaxed), Stage::Fit as u32);
    }

    #[test]
    fn errors_in_other_units_are_not_heard() {
        let mut told = Vec::new();
        let mut progress = |_: f64, error: f64| {
            told.push(error);
            ControlFlow::Continue(())
        };
        let mut control = Control::new(1).with_progress(&mut progress);
        control.without_error(|control| control.report(0.1, 1.5)).unwrap();
        control.report(0.2, 0.5).unwrap();
        assert!(told[0].is_nan() && told[1] == 0.5);
    }

    #[test]
    fn work_that_ends_first_returns_its_value() {
        let mut progress = |_: f64, _: f64| ControlFlow::Continue(());
        assert_eq!(Control::new(1).with_progress(&mut progress).watch(|_, _| 7), Ok(7));
        assert_eq!(Control::new(1).watch(|pool, _| pool.thread_count()), Ok(1));
    }
}
