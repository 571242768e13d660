//! Sequences of C calls over a few handles: whatever the order and the arguments, a status comes back, handles stay
//! usable, and no failure is a bug of the library's own.
#![no_main]

use libfuzzer_sys::arbitrary::{self, Arbitrary};
use libfuzzer_sys::fuzz_target;
use planish::ffi::*;
use std::ptr::{null, null_mut};

#[derive(Debug, Arbitrary)]
enum Call {
    New { to: u8, points: Vec<[i8; 3]>, triangles: Vec<[u8; 3]>, repair: u8, components: u8, corner_count: u8 },
    Read { to: u8, format: u8, bytes: Vec<u8> },
    Clone { from: u8, to: u8 },
    Free { at: u8 },
    SetParameters { at: u8, uv: Vec<[i8; 2]> },
    SetPoints { at: u8, points: Vec<[i8; 3]> },
    SetField { at: u8, values: Vec<i8> },
    RemoveField { at: u8 },
    Parameterize { at: u8 },
    Cut { from: u8, to: u8, nodes: Vec<u8> },
    RemoveTriangles { from: u8, to: u8, triangles: Vec<u8> },
    Fit { from: u8, to: u8, grid: u8 },
    Eval { at: u8, uv: Vec<[u8; 2]>, outside: u8 },
    Save { from: u8, to: u8, flip: Option<(u16, u8)> },
    Tessellate { from: u8, to: u8 },
    FreeSurface { at: u8 },
}

const SLOTS: usize = 3;

struct Handles {
    meshes: [*mut planish_mesh; SLOTS],
    surfaces: [*mut planish_surface; SLOTS],
}

impl Drop for Handles {
    fn drop(&mut self) {
        // SAFETY: each is NULL or a handle that is in no other slot.
        unsafe {
            self.meshes.iter().for_each(|&mesh| planish_mesh_free(mesh));
            self.surfaces.iter().for_each(|&surface| planish_surface_free(surface));
        }
    }
}

fn slot(number: u8) -> usize {
    usize::from(number) % SLOTS
}

fn numbers<const N: usize>(rows: &[[i8; N]]) -> Vec<f64> {
    rows.iter().flatten().map(|&x| if x == i8::MIN { f64::NAN } else { f64::from(x) / 8.0 }).collect()
}

fn checked(status: planish_status) -> bool {
    assert_ne!(status as i32, planish_status::Internal as i32, "a bug of the library");
    status as i32 >= 0
}

impl Handles {
    fn put_mesh(&mut self, to: u8, mesh: *mut planish_mesh, is_done: bool) {
        if is_done {
            // SAFETY: the handle that was there is dropped from its slot.
            unsafe { planish_mesh_free(std::mem::replace(&mut self.meshes[slot(to)], mesh)) }
        }
    }

    fn put_surface(&mut self, to: u8, surface: *mut planish_surface, is_done: bool) {
        if is_done {
            // SAFETY: as above.
            unsafe { planish_surface_free(std::mem::replace(&mut self.surfaces[slot(to)], surface)) }
        }
    }

    /// # Safety
    /// Handles are what they were made to be.
    unsafe fn call(&mut self, call: Call) {
        let (mut mesh, mut surface) = (null_mut(), null_mut());
        // SAFETY: lengths are those of the arrays, handles NULL or alive.
        unsafe {
            match call {
                Call::New { to, points, triangles, repair, components, corner_count } => {
                    let mut options = std::mem::zeroed::<planish_mesh_options>();
                    checked(planish_mesh_options_init(&mut options, size_of_val(&options)));
                    options.repair = repair.into();
                    options.components = (components % 4).into();
                    options.corner_count = (corner_count % 6).into();
                    let corners: Vec<u32> = triangles.iter().flatten().map(|&node| node.into()).collect();
                    let width = usize::from(corner_count % 6).max(3);
                    let (points, count) = (numbers(&points), corners.len() / width);
                    let (at, nodes) = (points.as_ptr(), points.len() / 3);
                    let done = checked(planish_mesh_new(at, nodes, corners.as_ptr(), count, &options, &mut mesh));
                    self.put_mesh(to, mesh, done);
                }
                Call::Read { to, format, bytes } => {
                    let mut options = std::mem::zeroed::<planish_mesh_options>();
                    checked(planish_mesh_options_init(&mut options, size_of_val(&options)));
                    options.format = (format % 6).into();
                    options.max_memory = 1 << 20;
                    let (at, size) = (bytes.as_ptr().cast(), bytes.len());
                    let done = checked(planish_mesh_read_buffer(at, size, &options, &mut mesh));
                    self.put_mesh(to, mesh, done);
                }
                Call::Clone { from, to } => {
                    let done = checked(planish_mesh_clone(self.meshes[slot(from)], &mut mesh));
                    self.put_mesh(to, mesh, done);
                }
                Call::Free { at } => self.put_mesh(at, null_mut(), true),
                Call::SetParameters { at, uv } => {
                    let uv = numbers(&uv);
                    checked(planish_mesh_set_parameters(self.meshes[slot(at)], uv.as_ptr(), uv.len() / 2));
                }
                Call::SetPoints { at, points } => {
                    let points = numbers(&points);
                    checked(planish_mesh_set_points(self.meshes[slot(at)], points.as_ptr(), points.len() / 3));
                }
                Call::SetField { at, values } => {
                    let values: Vec<f64> = values.into_iter().map(f64::from).collect();
                    let mesh = self.meshes[slot(at)];
                    checked(planish_mesh_set_field(mesh, c"f".as_ptr(), values.as_ptr(), values.len()));
                }
                Call::RemoveField { at } => {
                    checked(planish_mesh_remove_field(self.meshes[slot(at)], c"f".as_ptr()));
                }
                Call::Parameterize { at } => {
                    checked(planish_mesh_parameterize(self.meshes[slot(at)], null(), null_mut()));
                }
                Call::Cut { from, to, nodes } => {
                    let nodes: Vec<u32> = nodes.into_iter().map(u32::from).collect();
                    let from = self.meshes[slot(from)];
                    let done = checked(planish_mesh_cut_along(from, nodes.as_ptr(), nodes.len(), &mut mesh));
                    self.put_mesh(to, mesh, done);
                }
                Call::RemoveTriangles { from, to, triangles } => {
                    let triangles: Vec<u32> = triangles.into_iter().map(u32::from).collect();
                    let (from, at) = (self.meshes[slot(from)], triangles.as_ptr());
                    let done = checked(planish_mesh_remove_triangles(from, at, triangles.len(), &mut mesh));
                    self.put_mesh(to, mesh, done);
                }
                Call::Fit { from, to, grid } => {
                    let mut options = std::mem::zeroed::<planish_tensor_options>();
                    checked(planish_tensor_options_init(&mut options, size_of_val(&options)));
                    options.max_grid = 2 + u32::from(grid % 16);
                    options.thread_count = 1;
                    let from = self.meshes[slot(from)];
                    let done = checked(planish_tensor_fit(from, &options, &mut surface, null_mut()));
                    self.put_surface(to, surface, done);
                }
                Call::Eval { at, uv, outside } => {
                    let uv: Vec<f64> = uv.into_iter().flatten().map(|x| f64::from(x) / 128.0).collect();
                    let mut options = std::mem::zeroed::<planish_eval_options>();
                    checked(planish_eval_options_init(&mut options, size_of_val(&options)));
                    options.outside = (outside % 4).into();
                    let surface = self.surfaces[slot(at)];
                    let mut rows = vec![0.0; 3 * uv.len() / 2];
                    checked(planish_surface_eval(surface, uv.as_ptr(), uv.len() / 2, &options, rows.as_mut_ptr()));
                }
                Call::Save { from, to, flip } => {
                    let from = self.surfaces[slot(from)];
                    let mut bytes = vec![0_u8; planish_surface_save_size(from)];
                    checked(planish_surface_save(from, bytes.as_mut_ptr().cast(), bytes.len()));
                    if let (Some((at, bits)), false) = (flip, bytes.is_empty()) {
                        let at = usize::from(at) % bytes.len();
                        bytes[at] ^= bits;
                    }
                    let done = checked(planish_surface_load(bytes.as_ptr().cast(), bytes.len(), &mut surface));
                    self.put_surface(to, surface, done);
                }
                Call::Tessellate { from, to } => {
                    let mut options = std::mem::zeroed::<planish_tessellate_options>();
                    checked(planish_tessellate_options_init(&mut options, size_of_val(&options)));
                    options.max_point_count = 5000;
                    let from = self.surfaces[slot(from)];
                    let done = checked(planish_surface_tessellate(from, &options, &mut mesh));
                    self.put_mesh(to, mesh, done);
                }
                Call::FreeSurface { at } => self.put_surface(at, null_mut(), true),
            }
        }
    }
}

fuzz_target!(|calls: Vec<Call>| {
    let mut handles = Handles { meshes: [null_mut(); SLOTS], surfaces: [null_mut(); SLOTS] };
    for call in calls.into_iter().take(20) {
        // SAFETY: handles come from the calls alone.
        unsafe { handles.call(call) };
    }
});
