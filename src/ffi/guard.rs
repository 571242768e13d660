//! What every entry point runs in: nothing unwinds out of it, and a failure leaves its sentence here.
//!
//! Panics are bugs of the library. They become [`planish_status::Internal`] and are silent: the first guard
//! installs a panic hook that says nothing of panics inside a guard or on the library's own threads, and
//! passes all others on to the hook that was there.
//!
//! Memory that cannot be had is [`planish_status::OutOfMemory`]: arrays of the caller are copied with `try_reserve`, and
//! the core unwinds with [`OutOfMemory`].

pub(super) use super::failure::Failure;
use super::planish_status;
use crate::memory::OutOfMemory;
use std::cell::{Cell, RefCell};
use std::panic::{self, AssertUnwindSafe, catch_unwind};
use std::sync::Once;

thread_local! {
    static LAST: RefCell<(String, Option<usize>)> = const { RefCell::new((String::new(), None)) };
    /// How many guards the thread is in: a progress callback may call back into the library.
    static DEPTH: Cell<usize> = const { Cell::new(0) };
}

/// Runs an entry point that returns a status.
pub(super) fn guard<R: Into<planish_status>>(body: impl FnOnce() -> Result<R, Failure>) -> planish_status {
    match guard_value(body) {
        Ok(outcome) => outcome.into(),
        Err(status) => status,
    }
}

/// Runs an entry point that returns a plain value.
pub(super) fn guard_value<R>(body: impl FnOnce() -> Result<R, Failure>) -> Result<R, planish_status> {
    install_hook();
    let depth = change_depth(|depth| depth + 1);
    let result = catch_unwind(AssertUnwindSafe(body));
    change_depth(|_| depth);
    match result {
        Ok(Ok(value)) => Ok(value),
        Ok(Err(failure)) => Err(remember(failure)),
        Err(payload) => {
            if let Some(error) = OutOfMemory::of_panic(&*payload) {
                return Err(remember(error.into()));
            }
            let text = payload.downcast_ref::<&str>().copied();
            let text = text.or_else(|| payload.downcast_ref::<String>().map(String::as_str));
            let sentence = format!("internal error: {}", text.unwrap_or("a panic without a message"));
            // the payload's own drop may panic
            if let Err(second) = catch_unwind(AssertUnwindSafe(|| drop(payload))) {
                std::mem::forget(second);
            }
            Err(remember(Failure { status: planish_status::Internal, sentence, index: None }))
        }
    }
}

/// Shows the thread's last failure to `read`.
pub(super) fn last_failure<R>(read: impl Fn(&str, Option<usize>) -> R) -> R {
    let shown = LAST.try_with(|last| {
        let last = last.borrow();
        read(&last.0, last.1)
    });
    shown.unwrap_or_else(|_| read("", None)) // the thread is being torn down
}

fn remember(failure: Failure) -> planish_status {
    let Failure { status, mut sentence, index } = failure;
    sentence.retain(|c| c != '\0'); // a name or path of the caller may have brought one
    // a thread that is being torn down remembers nothing
    let _ = LAST.try_with(|last| *last.borrow_mut() = (sentence, index));
    status
}

/// Returns the depth as it was.
fn change_depth(change: impl Fn(usize) -> usize) -> usize {
    DEPTH.try_with(|depth| depth.replace(change(depth.get()))).unwrap_or(0)
}

fn is_guarded() -> bool {
    DEPTH.try_with(Cell::get).is_ok_and(|depth| depth > 0) || crate::control::is_pool_thread()
}

fn install_hook() {
    static HOOK: Once = Once::new();
    if HOOK.is_completed() || std::thread::panicking() {
        return; // hooks cannot be changed while a panic is on its way
    }
    HOOK.call_once(|| {
        let others = panic::take_hook();
        panic::set_hook(Box::new(move |info| {
            if !is_guarded() {
                others(info);
            }
        }));
    });
}
