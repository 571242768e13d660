//! A field fitter replaces fields in place: no memory is asked for once a field of the width has been fitted.

#![allow(unsafe_code, reason = "an allocator that counts")]

use glam::DVec2;
use planish::Control;
use planish::fit::field::{FieldFitter, FieldGrid, FieldOptions};
use planish::samples::Random;
use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering};

/// The system's, counting.
struct Counting;

/// Bytes asked for so far.
static ASKED: AtomicUsize = AtomicUsize::new(0);

// SAFETY: all is left to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ASKED.fetch_add(layout.size(), Ordering::Relaxed);
        // SAFETY: the caller's promise.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        // SAFETY: the caller's promise.
        unsafe { System.dealloc(at, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Bytes that `work` asks for, on any thread.
fn asked_by(work: impl FnOnce()) -> usize {
    let before = ASKED.load(Ordering::Relaxed);
    work();
    ASKED.load(Ordering::Relaxed) - before
}

/// Updates, the last of which is with the second field.
const UPDATES: usize = 11;
/// Bytes of such blocks, less than a quarter of the coefficients alone: 35 x 35 x 2 numbers.
const QUEUE_BLOCKS: usize = 4096;

#[test]
fn an_update_asks_for_no_memory() {
    let mut random = Random::new(1);
    let uv: Vec<DVec2> = (0..20_000).map(|_| DVec2::new(random.unit(), random.unit())).collect();
    let field =
        |phase: f64| -> Vec<f64> { uv.iter().flat_map(|p| [p.x, (9.0 * p.y + phase).sin()]).collect() };
    let (first, second) = (field(0.0), field(1.0));
    for threads in [1, 2] {
        let options = FieldOptions { grid: FieldGrid::Fixed([33, 33]), ..FieldOptions::default() };
        let fitter = FieldFitter::at(&uv, &options, &mut Control::new(threads)).unwrap();
        let mut surface = fitter.fit(&first, 2).unwrap();
        let asked: Vec<usize> = [&second, &first]
            .into_iter()
            .cycle()
            .take(UPDATES)
            .map(|values| asked_by(|| fitter.update(&mut surface, values, 2).unwrap()))
            .collect();
        // rayon's queues take a block for every 63 jobs, and one for a thread that takes its first
        let [most, often] = if threads == 1 { [0, 0] } else { [QUEUE_BLOCKS, UPDATES / 2] };
        assert!(asked.iter().all(|&bytes| bytes <= most), "bytes with {threads} threads: {asked:?}");
        assert!(asked.iter().filter(|&&bytes| bytes > 0).count() <= often, "{asked:?}");
        assert_eq!(surface, fitter.fit(&second, 2).unwrap());
    }
}
