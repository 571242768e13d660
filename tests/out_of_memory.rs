//! Every main call survives an allocation above 64 KB that fails, whichever it is.
//!
//! This program runs itself: a child makes one call, and one of its large allocations fails, as if the system had no
//! memory left at that moment. What Rust does then to a vector that did not ask first is an end of the process; the
//! libraries below do so, and docs/testing.md says which.
//!
//! `PLANISH_OUT_OF_MEMORY=tensor_fit cargo test --test out_of_memory -- --nocapture` shows instead where a call asks for
//! memory in a way that cannot be refused.

#![allow(unsafe_code, reason = "an allocator that fails, and the C ABI, whose statuses are what is tested")]

use planish::ffi::*;
use planish::mesh::Mesh;
use planish::samples;
use std::alloc::{GlobalAlloc, Layout, System};
use std::backtrace::Backtrace;
use std::cell::Cell;
use std::collections::BTreeMap;
use std::ffi::CString;
use std::process::Command;
use std::ptr::{null, null_mut};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The system's, but for one large allocation.
struct Failing;

/// Smaller allocations never fail: a system that has not even so much left is beyond help.
const LARGE: usize = 64 << 10;

/// Large allocations of the present call so far.
static ASKED: AtomicUsize = AtomicUsize::new(0);
/// The one that fails, counted from 1; 0 for none.
static FAILS: AtomicUsize = AtomicUsize::new(0);
/// Where memory was asked for in a way that cannot be refused, and how often; None while nobody wants to know.
static PLACES: Mutex<Option<BTreeMap<String, usize>>> = Mutex::new(None);

thread_local! {
    static LOOKS: Cell<bool> = const { Cell::new(false) };
}

/// Whether this allocation is the one that fails.
fn fails(size: usize) -> bool {
    if size <= LARGE || LOOKS.get() {
        return false;
    }
    LOOKS.set(true);
    let nth = ASKED.fetch_add(1, Ordering::Relaxed) + 1;
    let fails = nth == FAILS.load(Ordering::Relaxed);
    if let Some(places) = PLACES.lock().unwrap().as_mut() {
        if let Some(place) = place() {
            *places.entry(place).or_default() += 1;
        }
    } else if fails && let Some(place) = place() {
        eprintln!("at {place}");
    }
    LOOKS.set(false);
    fails
}

/// The functions that ask for memory in a way that cannot be refused, the innermost first.
fn place() -> Option<String> {
    let trace = Backtrace::force_capture().to_string();
    let functions = trace.lines().filter_map(|line| line.trim().split_once(": ")).map(|(_, name)| name);
    let functions: Vec<&str> = functions.collect();
    if functions.iter().any(|name| name.contains("try_reserve")) {
        return None;
    }
    let is_own = |name: &&&str| {
        let name = name.trim_start_matches('<');
        !["std::", "alloc::", "core::", "out_of_memory", "__rust", "rayon_core::"]
            .iter()
            .any(|other| name.starts_with(other))
    };
    Some(functions.iter().filter(is_own).take(5).copied().collect::<Vec<_>>().join(" < "))
}

// SAFETY: all is left to the system's allocator, or refused.
unsafe impl GlobalAlloc for Failing {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // SAFETY: the caller's promise.
        if fails(layout.size()) { null_mut() } else { unsafe { System.alloc(layout) } }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        // SAFETY: the caller's promise.
        if fails(layout.size()) { null_mut() } else { unsafe { System.alloc_zeroed(layout) } }
    }

    unsafe fn realloc(&self, at: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        // SAFETY: the caller's promise.
        if fails(size) { null_mut() } else { unsafe { System.realloc(at, layout, size) } }
    }

    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        // SAFETY: the caller's promise.
        unsafe { System.dealloc(at, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Failing = Failing;

/// A bumpy sheet over the unit square, its parameters; 101 nodes a side, so that all arrays of a double or two numbers a
/// node are large.
fn sheet() -> Mesh {
    let (places, triangles) = samples::grid([101, 101], 0.2, 1, |_| true);
    let points = places.iter().map(|&p| p.extend(0.2 * samples::franke(p))).collect();
    let mut mesh = Mesh::new(points, triangles).unwrap();
    mesh.set_parameters(places).unwrap();
    mesh
}

/// Makes a handle by way of arrays.
fn new_mesh(
    mesh: &Mesh,
    out_mesh: &mut *mut planish_mesh,
    run: fn(&dyn Fn() -> planish_status) -> planish_status,
) -> planish_status {
    let points: Vec<f64> = mesh.points().iter().flat_map(|p| p.to_array()).collect();
    let triangles = mesh.triangles().as_flattened();
    let (point_count, triangle_count) = (points.len() / 3, triangles.len() / 3);
    let out_mesh: *mut *mut planish_mesh = out_mesh;
    // SAFETY: the arrays are as long as said.
    run(&|| unsafe {
        let (points, triangles) = (points.as_ptr(), triangles.as_ptr());
        planish_mesh_new(points, point_count, triangles, triangle_count, null(), out_mesh)
    })
}

/// The mesh as a handle, with its parameters.
fn handle(mesh: &Mesh) -> *mut planish_mesh {
    let mut handle = null_mut();
    assert_eq!(new_mesh(mesh, &mut handle, |call| call()), planish_status::Ok);
    if mesh.parameters().is_some() {
        let uv = parameters_of(mesh);
        // SAFETY: a row for each node.
        let status = unsafe { planish_mesh_set_parameters(handle, uv.as_ptr(), uv.len() / 2) };
        assert_eq!(status, planish_status::Ok);
    }
    handle
}

/// A bicubic surface of 64 x 64 cells over the unit square.
fn tensor() -> *mut planish_surface {
    const CELLS: usize = 64;
    let inner = (0..=CELLS).map(|k| k as f64 / CELLS as f64);
    let knots: Vec<f64> = [0.0; 3].into_iter().chain(inner).chain([1.0; 3]).collect();
    let place = |k: usize| k as f64 / (CELLS + 2) as f64;
    let point = |i: usize, j: usize| [place(i), place(j), (5.0 * place(i)).sin() * place(j)];
    let net: Vec<f64> = (0..CELLS + 3).flat_map(|i| (0..CELLS + 3).flat_map(move |j| point(i, j))).collect();
    let (at, count, mut surface) = (knots.as_ptr(), knots.len(), null_mut());
    // SAFETY: the arrays are as long as said.
    let status =
        unsafe { planish_tensor_new(3, 3, 3, at, count, at, count, net.as_ptr(), null(), &mut surface) };
    assert_eq!(status, planish_status::Ok);
    surface
}

/// The same as a PHT-spline.
fn pht() -> *mut planish_surface {
    let (tensor, mut surface) = (tensor(), null_mut());
    // SAFETY: handles of this library.
    unsafe {
        assert_eq!(planish_pht_from_surface(tensor, null(), &mut surface), planish_status::Ok);
        planish_surface_free(tensor);
    }
    surface
}

fn options<T>(init: unsafe extern "C" fn(*mut T, usize) -> planish_status) -> T {
    let mut options = std::mem::MaybeUninit::uninit();
    // SAFETY: the record is filled whole.
    unsafe {
        assert_eq!(init(options.as_mut_ptr(), size_of::<T>()), planish_status::Ok);
        options.assume_init()
    }
}

/// From here on memory fails; then the status of the call.
fn watched(call: impl FnOnce() -> planish_status) -> planish_status {
    ASKED.store(0, Ordering::Relaxed);
    match std::env::var(NTH).ok().and_then(|text| text.parse().ok()) {
        Some(fails) => FAILS.store(fails, Ordering::Relaxed),
        None => *PLACES.lock().unwrap() = Some(BTreeMap::new()),
    }
    let status = call();
    FAILS.store(0, Ordering::Relaxed);
    status
}

fn parameters_of(mesh: &Mesh) -> Vec<f64> {
    mesh.parameters().into_iter().flatten().flat_map(|p| p.to_array()).collect()
}

fn heights(mesh: &Mesh) -> Vec<f64> {
    mesh.points().iter().map(|p| p.z).collect()
}

fn file_name() -> CString {
    let name = format!("planish-memory-{}", std::process::id());
    CString::new(std::env::temp_dir().join(name).to_str().unwrap()).unwrap()
}

/// Names the call that a child makes.
const CALL: &str = "PLANISH_OUT_OF_MEMORY";
/// Says which of its large allocations fails; 0 for none.
const NTH: &str = "PLANISH_NTH_ALLOCATION";
/// So many allocations of each call fail in turn, evenly over the call.
const MOST_INJECTIONS: usize = 16;
/// Of so many injections one may end the process: docs/testing.md says where. It is one in thirty, and which allocations are
/// hit depends on their number.
const OF_INJECTIONS: usize = 15;

type Call = fn() -> planish_status;

/// The calls, one sheet or surface each. What they make is not freed: the child ends.
#[rustfmt::skip]
const CALLS: &[(&str, Call)] = &[
    ("mesh_new", || {
        new_mesh(&sheet(), &mut null_mut(), |call| watched(call))
    }),
    ("mesh_read", || {
        let mesh = sheet();
        let mut text = String::new();
        mesh.points().iter().for_each(|p| text += &format!("v {} {} {}\n", p.x, p.y, p.z));
        mesh.triangles().iter().for_each(|[a, b, c]| text += &format!("f {} {} {}\n", a + 1, b + 1, c + 1));
        let mut options = options(planish_mesh_options_init);
        options.format = planish_mesh_format::Obj as u32;
        let mut out = null_mut();
        // SAFETY: the buffer is as long as said.
        watched(|| unsafe { planish_mesh_read_buffer(text.as_ptr().cast(), text.len(), &options, &mut out) })
    }),
    ("mesh_clone", || {
        let (mesh, mut out) = (handle(&sheet()), null_mut());
        // SAFETY: handles of this library.
        watched(|| unsafe { planish_mesh_clone(mesh, &mut out) })
    }),
    ("mesh_decimate", || {
        let (mesh, mut out) = (handle(&sheet()), null_mut());
        // SAFETY: handles of this library.
        watched(|| unsafe { planish_mesh_decimate(mesh, null(), &mut out, null_mut()) })
    }),
    ("mesh_parameterize", || {
        let mesh = handle(&sheet());
        // SAFETY: a handle of this library.
        watched(|| unsafe { planish_mesh_parameterize(mesh, null(), null_mut()) })
    }),
    ("mesh_find_features", || {
        let (mesh, mut count) = (handle(&sheet()), 0);
        // SAFETY: a handle of this library; the array is empty.
        watched(|| unsafe { planish_mesh_find_features(mesh, null(), null_mut(), 0, &mut count) })
    }),
    ("mesh_map_to_sphere", || {
        let mesh = samples::ball(8000, 1).unwrap();
        let mut points = vec![0.0; 3 * mesh.points().len()];
        let mesh = handle(&mesh);
        // SAFETY: the array has a row for each node.
        watched(|| unsafe { planish_mesh_map_to_sphere(mesh, null(), points.as_mut_ptr(), points.len() / 3, null_mut()) })
    }),
    ("layout_of_mesh", || {
        let (mesh, mut out) = (handle(&samples::ball(8000, 1).unwrap()), null_mut());
        // SAFETY: handles of this library.
        watched(|| unsafe { planish_layout_of_mesh(mesh, null(), &mut out, null_mut()) })
    }),
    ("model_fit", || {
        let (mesh, mut out) = (handle(&samples::ball(4000, 1).unwrap()), null_mut());
        let mut options = options(planish_model_options_init);
        options.tolerance = 1e-2;
        // SAFETY: handles of this library.
        watched(|| unsafe { planish_model_fit(mesh, &options, &mut out, null_mut()) })
    }),
    ("tensor_fit", || {
        let (mesh, mut out) = (handle(&sheet()), null_mut());
        // SAFETY: handles of this library.
        watched(|| unsafe { planish_tensor_fit(mesh, null(), &mut out, null_mut()) })
    }),
    ("tensor_fit_points", || {
        let mesh = sheet();
        let (uv, values, mut out) = (parameters_of(&mesh), heights(&mesh), null_mut());
        let mut options = options(planish_tensor_options_init);
        options.tolerance = 1e-4;
        // SAFETY: the arrays are as long as said.
        watched(|| unsafe {
            planish_tensor_fit_points(uv.as_ptr(), values.as_ptr(), values.len(), 1, &options, &mut out, null_mut())
        })
    }),
    ("pht_fit", || {
        let (mesh, mut out) = (handle(&sheet()), null_mut());
        // SAFETY: handles of this library.
        watched(|| unsafe { planish_pht_fit(mesh, null(), &mut out, null_mut()) })
    }),
    ("pht_from_surface", || {
        let (surface, mut out) = (tensor(), null_mut());
        // SAFETY: handles of this library.
        watched(|| unsafe { planish_pht_from_surface(surface, null(), &mut out) })
    }),
    ("pht_refine_region", || {
        let surface = pht();
        // SAFETY: a handle of this library.
        watched(|| unsafe { planish_pht_refine_region(surface, [0.0, 0.3, 0.0, 0.3].as_ptr(), 3, 1 << 20) })
    }),
    ("pht_simplify", || {
        let surface = pht();
        // SAFETY: a handle of this library.
        watched(|| unsafe { planish_pht_simplify(surface, 1e-3, null(), null_mut()) })
    }),
    ("d1rc_new", || {
        let (mesh, mut out) = (handle(&sheet()), null_mut());
        // SAFETY: handles of this library.
        watched(|| unsafe { planish_d1rc_new(mesh, null(), &mut out) })
    }),
    ("d1rc_fit", || {
        let (mesh, mut out) = (handle(&sheet()), null_mut());
        // SAFETY: handles of this library.
        watched(|| unsafe { planish_d1rc_fit(mesh, null(), &mut out, null_mut()) })
    }),
    ("field_fitter", || {
        let mesh = sheet();
        let values = heights(&mesh);
        let (mesh, mut fitter, mut out) = (handle(&mesh), null_mut(), null_mut());
        // SAFETY: handles of this library; a value for each node.
        watched(|| unsafe {
            match planish_field_fitter_new(mesh, null(), &mut fitter) {
                planish_status::Ok => {
                    planish_field_fitter_fit(fitter, values.as_ptr(), values.len(), 1, &mut out, null_mut())
                }
                failure => failure,
            }
        })
    }),
    ("transfer_new", || {
        let mesh = sheet();
        let targets: Vec<f64> = mesh.points().iter().flat_map(|p| (*p * 1.001).to_array()).collect();
        let (mesh, mut out) = (handle(&mesh), null_mut());
        // SAFETY: the array is as long as said.
        watched(|| unsafe {
            planish_transfer_new(mesh, targets.as_ptr(), targets.len() / 3, null(), &mut out, null_mut())
        })
    }),
    ("curve_fit", || {
        let u: Vec<f64> = (0..10_000).map(|k| f64::from(k) / 1e4).collect();
        let values: Vec<f64> = u.iter().map(|u| (30.0 * u).sin()).collect();
        let mut out = null_mut();
        // SAFETY: the arrays are as long as said.
        watched(|| unsafe {
            planish_curve_fit(u.as_ptr(), values.as_ptr(), u.len(), 1, null(), &mut out, null_mut())
        })
    }),
    ("tspline_skin", || {
        let point = |row: usize, k: usize| {
            let (u, v) = (k as f64 / 400.0, row as f64 / 30.0);
            [u, v, 0.1 * (9.0 * u + 5.0 * v).sin()]
        };
        let points: Vec<f64> = (0..30).flat_map(|row| (0..=400).flat_map(move |k| point(row, k))).collect();
        let (counts, mut out) = ([401; 30], null_mut());
        // SAFETY: the arrays are as long as said.
        watched(|| unsafe {
            planish_tspline_skin(points.as_ptr(), counts.as_ptr(), 30, null(), &mut out, null_mut())
        })
    }),
    ("surface_project", || {
        let points: Vec<f64> = sheet().points().iter().flat_map(|p| (*p * 1.01).to_array()).collect();
        let (mut uv, mut distances) = (vec![0.0; points.len() / 3 * 2], vec![0.0; points.len() / 3]);
        let surface = tensor();
        // SAFETY: the arrays are as long as said.
        watched(|| unsafe {
            planish_surface_project(surface, points.as_ptr(), distances.len(), null(), uv.as_mut_ptr(), distances.as_mut_ptr())
        })
    }),
    ("surface_deviation", || {
        let (surface, mesh) = (tensor(), handle(&sheet()));
        let mut options = options(planish_deviation_options_init);
        options.measure_back = 1;
        let mut report = zeroed::<planish_deviation_report>();
        report.struct_size = size_of_val(&report);
        // SAFETY: handles of this library.
        watched(|| unsafe { planish_surface_deviation(surface, mesh, &options, null_mut(), 0, &mut report) })
    }),
    ("surface_tessellate", || {
        let (surface, mut out) = (tensor(), null_mut());
        let mut options = options(planish_tessellate_options_init);
        options.chord_tolerance = 1e-5;
        // SAFETY: handles of this library.
        watched(|| unsafe { planish_surface_tessellate(surface, &options, &mut out) })
    }),
    ("surface_to_tensor", || {
        let (surface, mut out) = (pht(), null_mut());
        // SAFETY: handles of this library.
        watched(|| unsafe { planish_surface_to_tensor(surface, null(), &mut out) })
    }),
    ("surface_eval_grid", || {
        let surface = tensor();
        let u: Vec<f64> = (0..300).map(|k| f64::from(k) / 299.0).collect();
        let mut values = vec![0.0; 3 * u.len() * u.len()];
        // SAFETY: the arrays are as long as said.
        watched(|| unsafe {
            planish_surface_eval_grid(surface, u.as_ptr(), u.len(), u.as_ptr(), u.len(), null(), values.as_mut_ptr())
        })
    }),
    ("surface_write_step", || {
        let (surface, name) = (tensor(), file_name());
        // SAFETY: a handle of this library.
        let status = watched(|| unsafe { planish_surface_write_step(surface, name.as_ptr(), null()) });
        let _ = std::fs::remove_file(name.to_str().unwrap());
        status
    }),
    ("surface_write_vtk", || {
        let (surface, name) = (tensor(), file_name());
        // SAFETY: a handle of this library.
        let status = watched(|| unsafe { planish_surface_write_vtk(surface, name.as_ptr(), null()) });
        let _ = std::fs::remove_file(name.to_str().unwrap());
        status
    }),
    ("surface_load", || {
        let (surface, mut out) = (pht(), null_mut());
        // SAFETY: a handle of this library.
        let size = unsafe { planish_surface_save_size(surface) };
        let mut saved = vec![0_u8; size];
        // SAFETY: the buffer is as long as said.
        watched(|| unsafe {
            match planish_surface_save(surface, saved.as_mut_ptr().cast(), size) {
                planish_status::Ok => planish_surface_load(saved.as_ptr().cast(), size, &mut out),
                failure => failure,
            }
        })
    }),
    ("surface_clone", || {
        let (surface, mut out) = (pht(), null_mut());
        // SAFETY: handles of this library.
        watched(|| unsafe { planish_surface_clone(surface, &mut out) })
    }),
];

/// Calls whose options ask for more than there is.
#[rustfmt::skip]
const LARGEST: &[(&str, Call)] = &[
    ("tensor_grid", || {
        let (mesh, mut out) = (handle(&sheet()), null_mut());
        let mut options = options(planish_tensor_options_init);
        (options.grid_u, options.grid_v, options.max_coefficients) = (1025, 1025, usize::MAX);
        // SAFETY: handles of this library.
        unsafe { planish_tensor_fit(mesh, &options, &mut out, null_mut()) }
    }),
    ("field_grid", || {
        let (mesh, mut out) = (handle(&sheet()), null_mut());
        let mut options = options(planish_field_options_init);
        (options.grid_u, options.grid_v) = (1025, 1025);
        // SAFETY: handles of this library.
        unsafe { planish_field_fitter_new(mesh, &options, &mut out) }
    }),
    ("pht_level", || {
        let surface = pht();
        // SAFETY: a handle of this library.
        unsafe { planish_pht_refine_region(surface, [0.0, 1.0, 0.0, 1.0].as_ptr(), 12, usize::MAX) }
    }),
];

fn zeroed<T>() -> T {
    // SAFETY: only for records of numbers and pointers.
    unsafe { std::mem::zeroed() }
}

/// What became of a child.
struct Outcome {
    /// The status of the call and how many large allocations it made; None if the process was ended.
    ended: Option<(i32, usize)>,
    /// The functions that asked for the memory that could not be had, if they could not be refused.
    place: Option<String>,
}

/// Runs a call in a process of its own; its nth large allocation fails.
fn child(call: &str, nth: usize) -> Outcome {
    finished(Command::new(std::env::current_exe().unwrap()).args(CHILD), call, nth)
}

/// The arguments of a child.
const CHILD: [&str; 3] = ["--exact", "memory_that_cannot_be_had_is_a_status", "--nocapture"];

fn finished(command: &mut Command, call: &str, nth: usize) -> Outcome {
    let output = command.env(CALL, call).env(NTH, nth.to_string()).output().unwrap();
    let (told, complaint) =
        (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr).into_owned());
    let ended = told.lines().find_map(|line| {
        let (status, asked) = line.strip_prefix("status ")?.split_once(" asked ")?;
        Some((status.parse().ok()?, asked.parse().ok()?))
    });
    let place = complaint.lines().find_map(|line| Some(line.strip_prefix("at ")?.to_owned()));
    Outcome { ended, place }
}

/// What a child does.
fn run(name: &str) {
    let (_, call) =
        CALLS.iter().chain(LARGEST).find(|(known, _)| *known == name).expect("a call of the table");
    let status = call();
    println!("status {} asked {}", status as i32, ASKED.load(Ordering::Relaxed));
    for (place, count) in PLACES.lock().unwrap().take().into_iter().flatten() {
        println!("{count:5} {place}");
    }
}

#[test]
fn memory_that_cannot_be_had_is_a_status() {
    if let Ok(name) = std::env::var(CALL) {
        return run(&name);
    }
    let (mut injections, mut aborts) = (0, BTreeMap::<String, usize>::new());
    for (name, _) in CALLS {
        let (status, count) = child(name, 0).ended.unwrap_or_else(|| panic!("{name} ends the process"));
        assert!(status >= 0, "{name} without failures: {status}");
        let (most, before) = (count.min(MOST_INJECTIONS), injections);
        for k in 0..most {
            let Outcome { ended, place } = child(name, 1 + k * count / most);
            injections += 1;
            match ended {
                Some((status, _)) => assert!(
                    status >= 0 || status == planish_status::OutOfMemory as i32,
                    "{name}, allocation {}: {status}",
                    1 + k * count / most
                ),
                None => *aborts.entry(place.unwrap_or_default()).or_default() += 1,
            }
        }
        println!("{name}: {} of {count} allocations failed in turn", injections - before);
    }
    let total: usize = aborts.values().sum();
    println!("{total} of {injections} failures end the process");
    aborts.iter().for_each(|(place, count)| println!("{count:4} {place}"));
    assert!(injections > 200, "{injections} failures");
    assert!(OF_INJECTIONS * total <= injections, "{total} of {injections} failures end the process");
}

#[test]
#[cfg(target_os = "linux")]
fn the_largest_options_are_a_status_where_there_is_little() {
    for (name, _) in LARGEST {
        let limited = "ulimit -v 4194304 && exec \"$@\"";
        let mut shell = Command::new("sh");
        shell.args(["-c", limited, "sh"]).arg(std::env::current_exe().unwrap()).args(CHILD);
        let Outcome { ended, place } = finished(&mut shell, name, 0);
        let (status, _) = ended.unwrap_or_else(|| panic!("{name} ends the process: {place:?}"));
        let refused = [planish_status::OutOfMemory, planish_status::TooLarge].map(|status| status as i32);
        assert!(status >= 0 || refused.contains(&status), "{name}: {status}");
    }
}
