//! Evaluation: the tables of a surface, and its leaves in Bernstein form.
//!
//! Values, and first derivatives on request, of polynomial surfaces in space share their inner loop with tensor
//! surfaces; everything else goes the general way.

use super::PhtSurface;
use super::basis::Widths;
use super::expansion::{Matrix, all_jets};
use super::jet;
use crate::memory::{self, CollectVec};
use crate::surface::ORDERS;
use crate::surface::derivative_rows;
use crate::surface::homogeneous::divide;
use crate::surface::rows_of_four::{combine, contract};
use crate::tmesh::Directory;
use crate::tmesh::TMesh;
use crate::tmesh::Topology;
use glam::DVec2;
use pulp::{Arch, Simd, WithSimd};
use std::sync::OnceLock;

/// What is derived from the state.
#[derive(Debug, Clone)]
pub(super) struct View {
    pub topology: Topology,
    /// The jet of each vertex, T-vertices included.
    jets: Vec<f64>,
    /// Sixteen rows of ordinates a leaf, v running fastest.
    pub ordinates: Vec<f64>,
    width: usize,
    frames: Vec<Frame>,
    directory: Directory,
    /// What the vertices are made of, for basis functions.
    pub expansions: OnceLock<Vec<Vec<(u32, Matrix)>>>,
    /// Of the functions of each vertex, by [`Basis`](super::Basis).
    pub widths: [OnceLock<Vec<Widths>>; 2],
}

/// Where a leaf lies.
#[derive(Debug, Clone, Copy)]
struct Frame {
    min: DVec2,
    inverse_size: DVec2,
}

impl View {
    pub(super) fn new(surface: &PhtSurface, topology: Topology) -> Self {
        let (mesh, width) = (&surface.mesh, surface.width());
        let basis: Vec<f64> = surface.jets.values().flatten().copied().collect_vec();
        let jets = all_jets(&topology, mesh, &basis, width);
        let mut ordinates = memory::filled(0.0, topology.leaves.len() * 16 * width);
        let mut frames = memory::with_capacity(topology.leaves.len());
        let leaves = topology.leaves.iter().zip(&topology.corners);
        for ((&node, corners), ordinates) in leaves.zip(ordinates.chunks_exact_mut(16 * width)) {
            let domain = mesh.cell_domain(mesh.cell(node));
            let corners = corners.map(|vertex| row(&jets, vertex as usize, jet::ROWS * width));
            jet::ordinates(corners, domain.size().to_array(), width, ordinates);
            memory::push(&mut frames, Frame { min: domain.min, inverse_size: domain.size().recip() });
        }
        Self {
            topology,
            jets,
            ordinates,
            width,
            frames,
            directory: Directory::new(mesh),
            expansions: OnceLock::new(),
            widths: Default::default(),
        }
    }

    /// The leaf that has `uv`: on a grid line the one to the right or above; beyond the domain the nearest.
    #[inline(always)]
    pub(super) fn leaf_at(&self, mesh: &TMesh, uv: DVec2) -> usize {
        self.topology.leaf_of(self.directory.locate(mesh, uv))
    }

    /// The jet of a vertex.
    pub(super) fn jet(&self, vertex: u32) -> &[f64] {
        row(&self.jets, vertex as usize, jet::ROWS * self.width)
    }

    /// The ordinates of one leaf.
    pub(super) fn leaf_ordinates(&self, leaf: usize) -> &[f64] {
        row(&self.ordinates, leaf, 16 * self.width)
    }
}

fn row(rows: &[f64], index: usize, length: usize) -> &[f64] {
    &rows[index * length..][..length]
}

/// Cubic Bernstein polynomials at `x`.
#[inline(always)]
fn bernstein(x: f64) -> [f64; 4] {
    let y = 1.0 - x;
    let (xx, yy) = (x * x, y * y);
    [yy * y, 3.0 * x * yy, 3.0 * xx * y, xx * x]
}

/// Their first derivatives, for an interval of length `1 / inverse`.
#[inline(always)]
fn bernstein_slopes(x: f64, inverse: f64) -> [f64; 4] {
    let (y, k) = (1.0 - x, 3.0 * inverse);
    let (low, high) = (k * y * y, k * x * x);
    let middle = 2.0 * k * x * y;
    [-low, low - middle, middle - high, high]
}

/// Derivatives of any order up to 3 of the cubic Bernstein polynomials.
fn bernstein_derivative(x: f64, order: usize, inverse: f64) -> [f64; 4] {
    let y = 1.0 - x;
    let scale = inverse.powi(order as i32);
    let row = match order {
        0 => [y * y * y, 3.0 * x * y * y, 3.0 * x * x * y, x * x * x],
        1 => [-3.0 * y * y, 3.0 * y * (y - 2.0 * x), 3.0 * x * (2.0 * y - x), 3.0 * x * x],
        2 => [6.0 * y, 6.0 * (x - 2.0 * y), 6.0 * (y - 2.0 * x), 6.0 * x],
        3 => [-6.0, 18.0, -18.0, 6.0],
        _ => [0.0; 4],
    };
    row.map(|b| b * scale)
}

/// Points whose leaves are looked up before the first of them is summed, so that the memory of the next ones is
/// fetched meanwhile.
const BLOCK: usize = 32;

/// A batch of points on a polynomial surface in space.
struct Batch<'a> {
    surface: &'a PhtSurface,
    uv: &'a [DVec2],
    has_slopes: bool,
    out: &'a mut [f64],
}

impl WithSimd for Batch<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        if self.has_slopes { self.eval::<S, true>() } else { self.eval::<S, false>() }
    }
}

impl Batch<'_> {
    #[inline(always)]
    fn eval<S: Simd, const SLOPES: bool>(self) {
        let view = self.surface.view();
        let width = if SLOPES { 9 } else { 3 };
        let mut leaves = [0; BLOCK];
        for (uv, out) in self.uv.chunks(BLOCK).zip(self.out.chunks_mut(BLOCK * width)) {
            for (leaf, &uv) in leaves.iter_mut().zip(uv) {
                *leaf = view.leaf_at(&self.surface.mesh, uv);
            }
            for ((&leaf, &uv), out) in leaves.iter().zip(uv).zip(out.chunks_exact_mut(width)) {
                let Frame { min, inverse_size } = view.frames[leaf];
                let x = (uv - min) * inverse_size;
                let net = &view.ordinates[48 * leaf..][..48];
                let lines = [0, 1, 2, 3].map(|r| &net[12 * r..][..12]);
                let (n_u, n_v) = (bernstein(x.x), bernstein(x.y));
                let line = combine::<S>(lines, n_u);
                out[..3].copy_from_slice(&contract::<S>(&line, n_v));
                if SLOPES {
                    let across = combine::<S>(lines, bernstein_slopes(x.x, inverse_size.x));
                    out[3..6].copy_from_slice(&contract::<S>(&across, n_v));
                    let slopes = bernstein_slopes(x.y, inverse_size.y);
                    out[6..9].copy_from_slice(&contract::<S>(&line, slopes));
                }
            }
        }
    }
}

impl PhtSurface {
    pub(super) fn eval_leaves(&self, uv: &[DVec2], max_derivative: usize, out: &mut [f64]) {
        if self.dim == 3 && !self.is_rational && max_derivative <= 1 {
            return Arch::new().dispatch(Batch { surface: self, uv, has_slopes: max_derivative == 1, out });
        }
        let (rows, width) = (derivative_rows(max_derivative), self.width());
        let mut homogeneous = memory::filled(0.0, rows * width);
        for (&uv, out) in uv.iter().zip(out.chunks_exact_mut(rows * self.dim)) {
            for (orders, row) in ORDERS.into_iter().zip(homogeneous.chunks_exact_mut(width)) {
                self.derivative(uv, orders, row);
            }
            if self.is_rational {
                divide(&homogeneous, self.dim, max_derivative, out);
            } else {
                out.copy_from_slice(&homogeneous);
            }
        }
    }

    /// The derivative of these orders along u and v, up to 3 each, of the jets' rows: of (w S, w) where there
    /// are weights. On grid lines it is that of the leaf to the right or above.
    pub fn derivative(&self, uv: DVec2, orders: (usize, usize), out: &mut [f64]) {
        let leaf = self.view().leaf_at(&self.mesh, uv);
        self.leaf_derivative(leaf, uv, orders, out);
    }

    fn leaf_derivative(&self, leaf: usize, uv: DVec2, (a, b): (usize, usize), out: &mut [f64]) {
        let view = self.view();
        let Frame { min, inverse_size } = view.frames[leaf];
        let x = (uv - min) * inverse_size;
        let n_u = bernstein_derivative(x.x, a, inverse_size.x);
        let n_v = bernstein_derivative(x.y, b, inverse_size.y);
        let shares = n_u.iter().flat_map(|u| n_v.iter().map(move |v| u * v));
        out.fill(0.0);
        for (share, ordinate) in shares.zip(view.leaf_ordinates(leaf).chunks_exact(self.width())) {
            out.iter_mut().zip(ordinate).for_each(|(sum, x)| *sum += share * x);
        }
    }
}
