//! Who hears of the progress of a long call.

use super::arguments::{ArgumentError, check};
use super::guard::Failure;
use crate::Control;
use libc::c_void;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicI32, AtomicU32, Ordering};

// the numbers that callers see; tools/header follows the name
pub use crate::control::Stage as planish_stage;

/// Hears how far a call is and may end it. It is asked at least every 50 ms while other threads do the work.
///
/// fraction: how much is done, 0 to 1; it never falls.
/// error:    while a surface is fitted the largest error so far in model units; in calls that only parameterize a mesh
///           the L2 stretch so far; NaN while unknown.
/// user:     the pointer from the options.
/// Returns 0 to go on; anything else cancels, and the call returns PLANISH_STATUS_CANCELLED when the step in
/// progress, such as a factorization, has ended.
///
/// It is called on the thread that made the call. With thread_count 1 that thread does the work too and asks between its
/// steps. It must not throw or longjmp: a C++ exception that leaves it ends the process. It may call the library, but not
/// change or destroy what the call was given.
pub type planish_progress =
    Option<unsafe extern "C-unwind" fn(fraction: f64, error: f64, user: *mut c_void) -> i32>;

/// Most threads that a call may be asked to use.
const MAX_THREADS: u32 = 1024;

/// The number of threads that `given` asks for; 0 is for all cores.
pub(super) fn thread_count(given: u32) -> Result<usize, ArgumentError> {
    match given {
        0..=MAX_THREADS => Ok(given as usize),
        _ => Err(ArgumentError::Limit {
            name: "thread_count",
            given: given as usize,
            largest: MAX_THREADS as usize,
        }),
    }
}

/// Whom the options of a call name: who hears of it, and what may cancel it.
pub(super) struct Listener {
    pub progress: planish_progress,
    pub user: *mut c_void,
    pub cancel: *const i32,
    pub stage: *mut u32,
}

// SAFETY: the flag is atomic, and whoever asks the callback does so on the thread that made the call.
unsafe impl Send for Listener {}
// SAFETY: as above.
unsafe impl Sync for Listener {}

impl Listener {
    /// The control, showing its stage where the caller wants it.
    ///
    /// # Safety
    /// The pointers are NULL or as the header says.
    unsafe fn shown<'a>(&self, control: Control<'a>) -> Result<Control<'a>, ArgumentError> {
        if !self.cancel.is_null() {
            check(self.cancel, "cancel")?;
        }
        if self.stage.is_null() {
            return Ok(control);
        }
        check(self.stage, "out_stage")?;
        // SAFETY: the caller's promise.
        Ok(control.with_stage(unsafe { AtomicU32::from_ptr(self.stage) }))
    }

    /// Tells the callback, and looks at the flag.
    fn ask(&self, fraction: f64, error: f64) -> ControlFlow<()> {
        // SAFETY: the caller's promises; the flag is only read.
        let answer = unsafe {
            let is_set = !self.cancel.is_null()
                && AtomicI32::from_ptr(self.cancel.cast_mut()).load(Ordering::Relaxed) != 0;
            i32::from(is_set) | self.progress.map_or(0, |tell| tell(fraction, error, self.user))
        };
        if answer == 0 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    }
}

/// The listener of options with the fields progress, user, cancel and out_stage.
macro_rules! listener {
    ($options:expr) => {
        $crate::ffi::progress::Listener {
            progress: $options.progress,
            user: $options.user,
            cancel: $options.cancel,
            stage: $options.out_stage,
        }
    };
}

/// Runs `work` on so many threads, while this one asks the caller's listener; on this one alone for one.
///
/// # Safety
/// Each pointer of the listener is NULL or stays as the header says until `work` has ended.
pub(super) unsafe fn with_control<R: Send>(
    threads: u32,
    listener: Listener,
    work: impl FnOnce(&mut Control) -> R + Send,
) -> Result<R, Failure> {
    let threads = thread_count(threads)?;
    let control = Control::new(threads);
    if control.thread_count() > 1 {
        // SAFETY: the caller's promise.
        return unsafe { heard(threads, listener, work) };
    }
    // SAFETY: the caller's promise.
    let control = unsafe { listener.shown(control) }?;
    let is_nobody = listener.progress.is_none() && listener.cancel.is_null();
    let mut control = match is_nobody {
        true => control,
        false => control.with_asked(move |fraction, error| listener.ask(fraction, error)),
    };
    Ok(control.host(work)?)
}

/// The same for work that is serial, in calls without a choice of threads: a thread beside this one does it if there is a
/// listener.
///
/// # Safety
/// As [`with_control`].
pub(super) unsafe fn with_helper<R: Send>(
    listener: Listener,
    work: impl FnOnce(&mut Control) -> R + Send,
) -> Result<R, Failure> {
    // SAFETY: the caller's promise.
    unsafe { heard(1, listener, work) }
}

/// # Safety
/// As [`with_control`].
unsafe fn heard<R: Send>(
    threads: usize,
    listener: Listener,
    work: impl FnOnce(&mut Control) -> R + Send,
) -> Result<R, Failure> {
    let mut tell = |fraction: f64, error: f64| listener.ask(fraction, error);
    // SAFETY: the caller's promise.
    let mut control = unsafe { listener.shown(Control::new(threads)) }?;
    if listener.progress.is_none() && listener.cancel.is_null() {
        return Ok(control.host(work)?);
    }
    Ok(control.with_progress(&mut tell).host(work)?)
}
