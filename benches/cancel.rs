//! How soon long calls end when they are cancelled, and how often they ask.
//!
//! `cargo bench --bench cancel -- [NODES [NAME...]]`, 100,000 nodes unless told otherwise; NAMEs pick calls.
//!
//! Each call runs once undisturbed on one thread, which asks its listener every 20 ms at most, wherever it looks whether it
//! is to end: `asked` is the longest time between two questions, in milliseconds of this thread's processor time, and `at`
//! the share of the whole that was told before. Then it runs on 2 threads, and a flag is set from another one after 1/8, 2/8
//! .. 7/8 of its time: `ended` is the longest from the flag to the end of the call, in milliseconds of the clock.

use glam::DVec2;
use planish::Control;
use planish::fit::d1rc::{D1rcFitOptions, fit_mesh as fit_d1rc};
use planish::fit::field::{FieldFitter, FieldOptions};
use planish::fit::pht::{PhtOptions, fit_mesh as fit_pht};
use planish::fit::report::Tolerance;
use planish::fit::tensor::{TensorOptions, fit_mesh as fit_tensor};
use planish::mesh::{DecimateOptions, Mesh};
use planish::parameterize::{ParameterizeOptions, parameterize};
use planish::query::deviation::{DeviationOptions, deviation};
use planish::query::project::{ProjectOptions, Projector};
use planish::query::tessellate::{TessellateOptions, tessellate_watched};
use planish::samples::{franke, grid};
use planish::surface::d1rc::{D1rcOptions, D1rcSurface};
use planish::surface::pht::{ConvertOptions, PhtSurface};
use planish::surface::tensor::TensorSurface;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicI32, Ordering};
use std::sync::{Arc, Mutex, mpsc};
use std::time::{Duration, Instant};

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| a != "--bench").collect();
    let nodes: usize = arguments.first().map_or(100_000, |nodes| nodes.parse().expect("a number of nodes"));
    let names = arguments.get(1..).unwrap_or_default();
    let sheet = sheet(nodes);
    let mut bare = sheet.clone();
    bare.clear_parameters();
    let tolerance = Tolerance { value: 1e-3, ..Tolerance::default() };
    let surface =
        fit_tensor(&sheet, &TensorOptions::default().with_tolerance(tolerance), &mut Control::new(2));
    let surface: TensorSurface = surface.expect("a sheet can be fitted").surface;
    let fine_conversion = ConvertOptions { tolerance: 1e-7, ..ConvertOptions::default() };
    let pht = PhtSurface::from_tensor(&surface, &fine_conversion).expect("it converts");
    let d1rc =
        D1rcSurface::from_mesh(&sheet, &D1rcOptions::default(), &[], &[]).expect("a sheet is a control mesh");
    let points: Vec<f64> = sheet.points().iter().flat_map(|p| (*p * 1.01).to_array()).collect();

    println!("| call | nodes | processor ms | asked | at | ended |\n|---|---|---|---|---|---|");
    let row = |call: &str, run: &(dyn Fn(&mut Control) + Sync)| {
        if names.is_empty() || names.iter().any(|name| name == call) {
            measure(call, nodes, run);
        }
    };
    row("parameterize", &|control| drop(parameterize(&bare, &ParameterizeOptions::TENSOR, control)));
    row("tensor_fit", &|control| {
        let fine = Tolerance { value: 1e-5, ..tolerance };
        drop(fit_tensor(&sheet, &TensorOptions::default().with_tolerance(fine), control));
    });
    row("pht_fit", &|control| {
        let options =
            PhtOptions { tolerance: Tolerance { value: 1e-5, ..tolerance }, ..PhtOptions::default() };
        drop(fit_pht(&sheet, &options, control));
    });
    row("d1rc_fit", &|control| drop(fit_d1rc(&sheet, &D1rcFitOptions::default(), control)));
    row("field_fitter", &|control| drop(FieldFitter::on_mesh(&sheet, &FieldOptions::default(), control)));
    row("decimate", &|control| drop(sheet.decimate(&DecimateOptions::default(), control)));
    row("project", &|control| {
        let projector = Projector::new(&surface).expect("it has patches");
        drop(projector.project(&points, &ProjectOptions::default(), control.pool()));
    });
    row("deviation", &|control| {
        let options = DeviationOptions { measure_back: true, ..DeviationOptions::default() };
        drop(deviation(&surface, &sheet, &options, control.pool()));
    });
    let chords = |chord_tolerance| TessellateOptions { chord_tolerance, ..TessellateOptions::default() };
    row("tessellate", &|control| drop(tessellate_watched(&surface, &chords(1e-5), control.pool().watch())));
    row("tessellate d1rc", &|control| drop(tessellate_watched(&d1rc, &chords(1e-4), control.pool().watch())));
    row("pht_from", &|control| {
        drop(PhtSurface::from_tensor_watched(&surface, &fine_conversion, control.pool().watch()));
    });
    row("pht_simplify", &|control| drop(pht.clone().simplify_watched(1e-3, control.pool().watch())));
}

/// A bumpy sheet with about so many nodes over the unit square, their parameters.
fn sheet(nodes: usize) -> Mesh {
    let side = (nodes as f64).sqrt() as usize;
    let (places, triangles) = grid([side, side], 0.2, 1, |_| true);
    let height = |p: DVec2| 0.2 * franke(p) + 0.01 * (40.0 * p.x).sin() * (30.0 * p.y).cos();
    let mut mesh = Mesh::new(places.iter().map(|&p| p.extend(height(p))).collect(), triangles)
        .expect("a grid is a mesh");
    mesh.set_parameters(places).expect("one for each node");
    mesh
}

fn measure(name: &str, nodes: usize, run: &(dyn Fn(&mut Control) + Sync)) {
    let gaps = Arc::new(Mutex::new(Gaps { last: (processor_time(), 0.0), ..Gaps::default() }));
    let listen = {
        let gaps = gaps.clone();
        move |fraction: f64, _: f64| {
            gaps.lock().expect("nobody panics").end(fraction);
            ControlFlow::Continue(())
        }
    };
    let start = processor_time();
    let _ = Control::new(1).with_asked(listen).host(run);
    gaps.lock().expect("nobody panics").end(1.0);
    let all = processor_time() - start;
    let (gap, at) = gaps.lock().expect("nobody panics").longest;
    let start = Instant::now();
    let _ = Control::new(2).host(run);
    let time = start.elapsed();
    let ended = (1..8).map(|k| until_ended(time * k / 8, run)).max().unwrap_or_default();
    let ms = |time: Duration| time.as_secs_f64() * 1e3;
    println!("| {name} | {nodes} | {:.0} | {:.1} | {at:.3} | {:.1} |", ms(all), ms(gap), ms(ended));
}

/// Times between questions.
#[derive(Default)]
struct Gaps {
    /// When the last one was asked, and what was done then.
    last: (Duration, f64),
    longest: (Duration, f64),
}

impl Gaps {
    fn end(&mut self, fraction: f64) {
        let now = processor_time();
        if now - self.last.0 > self.longest.0 {
            self.longest = (now - self.last.0, self.last.1);
        }
        self.last = (now, fraction);
    }
}

/// Of this thread.
fn processor_time() -> Duration {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").expect("this is Linux");
    let nanoseconds = text.split_whitespace().next().and_then(|text| text.parse().ok());
    Duration::from_nanos(nanoseconds.expect("the first number is the time on a processor"))
}

/// From the flag, set after some time, to the end of the call; zero if it had ended before.
fn until_ended(after: Duration, run: &(dyn Fn(&mut Control) + Sync)) -> Duration {
    let flag = &AtomicI32::new(0);
    let (tell_end, end) = mpsc::channel();
    std::thread::scope(|scope| {
        let set = scope.spawn(move || {
            let has_ended = end.recv_timeout(after).is_ok();
            flag.store(1, Ordering::Relaxed);
            (!has_ended).then(Instant::now)
        });
        let _ = Control::new(2).with_cancel(flag).host(run);
        let ended = Instant::now();
        let _ = tell_end.send(());
        let set = set.join().expect("it only waits");
        set.map_or(Duration::ZERO, |set| ended.saturating_duration_since(set))
    })
}
