//! Who hears of the progress of a long call.

use super::arguments::ArgumentError;
use crate::Control;
use std::ffi::c_void;
use std::ops::ControlFlow;

/// Hears how far a call is and may end it.
///
/// fraction: how much is done, 0 to 1; it never falls.
/// error:    while a surface is fitted the largest error so far in model units, while a mesh is parameterized
///           the L2 stretch so far; NaN while unknown.
/// user:     the pointer from the options.
/// Returns 0 to go on; anything else cancels, and the call returns PLANISH_STATUS_CANCELLED when the step in
/// progress, such as a factorization, has ended.
///
/// It is called on the thread that made the call. It must not throw or longjmp: a C++ exception that leaves it
/// ends the process. It may call the library, but not change or destroy what the call was given.
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

/// Runs `work` on so many threads, with the caller's listener.
///
/// # Safety
/// `progress` is NULL or a function that may be called with `user` until `work` has ended.
pub(super) unsafe fn with_control<R>(
    threads: u32,
    progress: planish_progress,
    user: *mut c_void,
    work: impl FnOnce(&mut Control) -> R,
) -> Result<R, ArgumentError> {
    let threads = thread_count(threads)?;
    let Some(callback) = progress else { return Ok(work(&mut Control::new(threads))) };
    let mut tell = |fraction: f64, error: f64| {
        // SAFETY: the caller's promise.
        match unsafe { callback(fraction, error, user) } {
            0 => ControlFlow::Continue(()),
            _ => ControlFlow::Break(()),
        }
    };
    Ok(work(&mut Control::new(threads).with_progress(&mut tell)))
}
