//! The bar of long calls.

use indicatif::{ProgressBar, ProgressStyle};
use planish::Control;
use std::io::IsTerminal;
use std::ops::ControlFlow;

/// Fits with a bar on a terminal, silently elsewhere.
pub(crate) fn with_bar<R>(threads: usize, fit: impl FnOnce(&mut Control) -> R) -> R {
    const STEPS: f64 = 1000.0;
    if !std::io::stderr().is_terminal() {
        return fit(&mut Control::new(threads));
    }
    let bar = ProgressBar::new(STEPS as u64);
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {percent:>3} %  {msg}") {
        bar.set_style(style);
    }
    let mut progress = |fraction: f64, error: f64| {
        bar.set_position((fraction * STEPS) as u64);
        if error.is_finite() {
            bar.set_message(format!("error {error:.2e}"));
        }
        ControlFlow::Continue(())
    };
    let fitted = fit(&mut Control::new(threads).with_progress(&mut progress));
    bar.finish_and_clear();
    fitted
}
