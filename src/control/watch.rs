//! Whether a call is to end, seen by its work.

use crate::failure::{Classify, ErrorKind};
use std::fmt;
use std::ops::ControlFlow;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::ThreadId;
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

/// How often a listener is asked while threads are at work.
pub(super) const POLL: Duration = Duration::from_millis(20);

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
    /// One that asks the listener of a call that this thread runs alone.
    pub(super) fn asking(
        ask: impl Fn(f64, f64) -> ControlFlow<()> + Send + Sync + 'static,
        last: (f64, f64),
    ) -> Self {
        let thread = std::thread::current().id();
        let asker = Asker { thread, ask: Box::new(ask), last: Mutex::new((Instant::now(), last)) };
        Self { asker: Some(asker), ..Self::default() }
    }

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
    pub(super) fn ask(&self, fraction: f64, error: f64) {
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

    pub(crate) fn cancel(&self) {
        self.is_cancelled.store(true, Ordering::Relaxed);
    }
}
