//! The contract from the caller's side: statuses, sentences, indices, and what stays untouched.

mod curves;
mod d1rc;
mod d1rc_fits;
mod decimations;
mod features;
mod fields;
mod fits;
mod forms;
mod layouts;
mod mesh_files;
mod mesh_parts;
mod meshes;
mod model_fits;
mod models;
mod parameterizations;
mod pht;
mod queries;
pub(super) mod records;
mod rows;
mod spheres;
mod statuses;
mod surfaces;
mod transfers;
mod tsplines;

use super::arguments::Record;
use super::*;
use crate::surface::{Domain, Kind, Region, Surface};
use glam::DVec2;
use std::ffi::CString;
use std::ptr::{null, null_mut};

/// A surface that is no tensor.
#[derive(Clone, Default)]
pub(super) struct OtherFamily(Region);

impl Surface for OtherFamily {
    fn kind(&self) -> Kind {
        Kind::Pht
    }

    fn dim(&self) -> usize {
        3
    }

    fn domain(&self) -> Domain {
        Domain { min: DVec2::ZERO, max: DVec2::ONE }
    }

    fn coefficient_count(&self) -> usize {
        1
    }

    fn region(&self) -> &Region {
        &self.0
    }

    fn region_mut(&mut self) -> &mut Region {
        &mut self.0
    }

    fn eval_rows(&self, _: &[DVec2], _: usize, out: &mut [f64]) {
        out.fill(0.0);
    }

    fn eval_grid(&self, _: &[f64], _: &[f64], out: &mut [f64]) {
        out.fill(0.0);
    }
}

/// Five points in the plane.
const POINTS: [f64; 15] = [0., 0., 0., 1., 0., 0., 1., 1., 0., 0., 1., 0., 2., 0., 1.];

/// Every byte of an output before a call that must not touch it.
const CANARY: u8 = 0xA5;

/// A number or record of canaries.
fn canary<T: Copy>() -> T {
    let mut value = std::mem::MaybeUninit::uninit();
    // SAFETY: only used for numbers, pointers and records of them, for which any bits will do.
    unsafe {
        std::ptr::write_bytes(value.as_mut_ptr(), CANARY, 1);
        value.assume_init()
    }
}

#[track_caller]
fn assert_untouched<T>(output: &T) {
    // SAFETY: only used for values of [`canary`], which have no padding.
    let bytes = unsafe { std::slice::from_raw_parts((&raw const *output).cast::<u8>(), size_of::<T>()) };
    assert!(bytes.iter().all(|&byte| byte == CANARY), "{bytes:x?}");
}

fn message() -> String {
    // SAFETY: as long as asked for.
    unsafe {
        let len = planish_error_message(null_mut(), 0);
        let mut text = vec![0_u8; len + 1];
        assert_eq!(planish_error_message(text.as_mut_ptr().cast(), text.len()), len);
        assert_eq!(text.pop(), Some(0));
        String::from_utf8(text).unwrap()
    }
}

/// A failure with its status, the index, and words of its sentence.
#[track_caller]
fn refused(status: planish_status, expected: planish_status, index: i64, words: &[&str]) {
    let sentence = message();
    assert_eq!(status, expected, "{sentence}");
    assert_eq!(planish_error_index(), index, "{sentence}");
    for word in words {
        assert!(sentence.contains(word), "'{word}' is not in '{sentence}'");
    }
}

#[track_caller]
fn null_refused(status: planish_status, name: &str) {
    refused(status, planish_status::NullPointer, -1, &[&format!("{name} is NULL")]);
}

#[track_caller]
fn ok(status: planish_status) {
    assert_eq!(status, planish_status::Ok, "{}", message());
}

/// Options with their defaults, or an empty report.
fn record<T: Record>() -> T {
    T::default()
}

fn c(text: &str) -> CString {
    CString::new(text).unwrap()
}

/// A mesh that frees itself.
struct MeshHandle(*mut planish_mesh);

impl Drop for MeshHandle {
    fn drop(&mut self) {
        // SAFETY: made by the library and freed once.
        unsafe { planish_mesh_free(self.0) }
    }
}

/// A surface that frees itself.
struct SurfaceHandle(*mut planish_surface);

impl Drop for SurfaceHandle {
    fn drop(&mut self) {
        // SAFETY: made by the library and freed once.
        unsafe { planish_surface_free(self.0) }
    }
}

impl SurfaceHandle {
    fn other_family() -> Self {
        Self(planish_surface::other_into_raw(OtherFamily::default()))
    }

    /// z = x y over the unit square, degree 1.
    fn saddle() -> Self {
        let knots = [0.0, 0.0, 1.0, 1.0];
        let points = [0., 0., 0., 0., 1., 0., 1., 0., 0., 1., 1., 1.];
        let mut out = null_mut();
        // SAFETY: the arrays have these lengths.
        ok(unsafe {
            planish_tensor_new(
                3,
                1,
                1,
                knots.as_ptr(),
                4,
                knots.as_ptr(),
                4,
                points.as_ptr(),
                null(),
                &mut out,
            )
        });
        Self(out)
    }
}

/// The nodes of a wavy sheet over the unit square, n by n.
struct Sheet {
    points: Vec<f64>,
    triangles: Vec<u32>,
    uv: Vec<f64>,
}

impl Sheet {
    fn new(n: u32) -> Self {
        let place = |i: u32| f64::from(i) / f64::from(n - 1);
        let nodes: Vec<(f64, f64)> =
            (0..n).flat_map(|i| (0..n).map(move |j| (i, j))).map(|(i, j)| (place(i), place(j))).collect();
        let height = |x: f64, y: f64| 0.2 * (7.0 * x).sin() * (5.0 * y).cos();
        let cells = (0..n - 1).flat_map(|i| (0..n - 1).map(move |j| n * i + j));
        Self {
            points: nodes.iter().flat_map(|&(x, y)| [x, y, height(x, y)]).collect(),
            triangles: cells.flat_map(|a| [a, a + n, a + n + 1, a, a + n + 1, a + 1]).collect(),
            uv: nodes.iter().flat_map(|&(u, v)| [u, v]).collect(),
        }
    }

    fn count(&self) -> usize {
        self.points.len() / 3
    }

    fn mesh(&self) -> MeshHandle {
        let mut out = null_mut();
        assert!(self.mesh_with(null(), &mut out) as i32 >= 0, "{}", message()); // nodes may be unused
        MeshHandle(out)
    }

    fn mesh_with(&self, options: *const planish_mesh_options, out: *mut *mut planish_mesh) -> planish_status {
        // SAFETY: the arrays have these lengths.
        unsafe {
            planish_mesh_new(
                self.points.as_ptr(),
                self.count(),
                self.triangles.as_ptr(),
                self.triangles.len() / 3,
                options,
                out,
            )
        }
    }

    fn mesh_with_parameters(&self) -> MeshHandle {
        let mesh = self.mesh();
        // SAFETY: one pair a node.
        ok(unsafe { planish_mesh_set_parameters(mesh.0, self.uv.as_ptr(), self.count()) });
        mesh
    }
}

/// An octahedron: nothing that lies flat without being cut.
fn closed_mesh() -> MeshHandle {
    let points = [1., 0., 0., 0., 1., 0., -1., 0., 0., 0., -1., 0., 0., 0., 1., 0., 0., -1.];
    let triangles = [0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 1, 0, 5, 2, 1, 5, 3, 2, 5, 0, 3, 5];
    let mut out = null_mut();
    // SAFETY: arrays of these lengths.
    ok(unsafe { planish_mesh_new(points.as_ptr(), 6, triangles.as_ptr(), 8, null(), &mut out) });
    MeshHandle(out)
}
