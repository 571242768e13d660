//! Threads that share the work of a call.

use super::watch::{Cancelled, Watch};
use rayon::{ThreadBuilder, ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};
use std::cell::Cell;
use std::io;
use std::num::NonZeroUsize;
use std::sync::OnceLock;
use std::thread::JoinHandle;

/// Threads were started in the process that this one was forked from, and stayed there.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("its threads stayed in the process that was forked: make another one in this process")]
pub struct Forked;

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
    /// The same number of threads, for a call that `watch` may end.
    pub(super) fn with_watch(&self, watch: Watch) -> Self {
        Self { thread_count: self.thread_count, threads: OnceLock::new(), watch }
    }

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
    pub(super) fn threads(&self) -> Option<&ThreadPool> {
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

#[cfg(test)]
mod tests {
    use super::*;

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
}
