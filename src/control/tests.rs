use super::*;
use std::time::{Duration, Instant};

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
    assert!(told.len() > 2 && told[1..told.len() - 1].iter().all(|&fraction| fraction == 0.25), "{told:?}");
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
