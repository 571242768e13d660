//! How a long call runs: on how many threads, and who hears of its progress.

use rayon::{ThreadPool, ThreadPoolBuilder};
use std::num::NonZeroUsize;
use std::ops::ControlFlow;
use std::sync::OnceLock;

/// The progress callback asked to stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("cancelled by the progress callback")]
pub struct Cancelled;

/// Hears the done fraction (0 to 1) and the error so far (NaN while unknown); breaks to cancel.
pub type ProgressFn<'a> = dyn FnMut(f64, f64) -> ControlFlow<()> + 'a;

/// How a long call runs.
///
/// Work is handed to a pool of exactly `thread_count` threads that lives as long as this value;
/// progress is reported on the thread that called. Results never depend on the number of threads:
/// work is cut into pieces of fixed size, and pieces are combined in their order.
pub struct Control<'a> {
    thread_count: usize,
    pool: OnceLock<ThreadPool>,
    progress: Option<&'a mut ProgressFn<'a>>,
    /// The part of the whole that the present stage covers.
    stage: (f64, f64),
}

impl Default for Control<'_> {
    fn default() -> Self {
        Self::new(0)
    }
}

impl<'a> Control<'a> {
    /// `thread_count` 0 means all cores; no progress is reported.
    pub fn new(thread_count: usize) -> Self {
        let all = || std::thread::available_parallelism().map_or(1, NonZeroUsize::get);
        let thread_count = if thread_count == 0 { all() } else { thread_count };
        Self { thread_count, pool: OnceLock::new(), progress: None, stage: (0.0, 1.0) }
    }

    /// The same with a listener.
    pub fn with_progress(self, progress: &'a mut ProgressFn<'a>) -> Self {
        Self { progress: Some(progress), ..self }
    }

    /// Threads that share the work, at least 1.
    pub fn thread_count(&self) -> usize {
        self.thread_count
    }

    /// Runs `work` so that rayon's parallel iterators and joins inside it use this pool.
    pub fn run<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
        self.pool
            .get_or_init(|| {
                ThreadPoolBuilder::new()
                    .num_threads(self.thread_count)
                    .build()
                    .expect("the system has a thread for each core it reports")
            })
            .install(work)
    }

    /// From now on progress runs from `from` to `to` of the whole call.
    pub fn set_stage(&mut self, from: f64, to: f64) {
        self.stage = (from, to);
    }

    /// Tells the listener; `fraction` is of the present stage.
    pub fn report(&mut self, fraction: f64, error: f64) -> Result<(), Cancelled> {
        let (from, to) = self.stage;
        match self.progress.as_mut().map(|tell| tell(from + fraction * (to - from), error)) {
            Some(ControlFlow::Break(())) => Err(Cancelled),
            _ => Ok(()),
        }
    }
}
