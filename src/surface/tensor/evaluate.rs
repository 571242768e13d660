//! Evaluation of tensor surfaces: two passes of basis functions over the control points of one span pair.

use super::{Axis, TensorSurface};
use crate::basis::basis_derivatives;
use crate::memory;
use crate::surface::homogeneous::divide;
use crate::surface::{ORDERS, derivative_rows};
use glam::DVec2;

impl TensorSurface {
    pub(super) fn eval_rows_generic(&self, uv: &[DVec2], max_derivative: usize, out: &mut [f64]) {
        let rows = derivative_rows(max_derivative);
        let point_len = rows * self.dim;
        match &self.weights {
            None => {
                let mut scratch = memory::filled(0.0, 3 * self.dim);
                for (uv, out) in uv.iter().zip(out.chunks_exact_mut(point_len)) {
                    self.contract(&self.control_points, self.dim, *uv, max_derivative, &mut scratch, out);
                }
            }
            Some(weights) => {
                let width = self.dim + 1;
                let mut scratch = memory::filled(0.0, 3 * width);
                let mut homogeneous = memory::filled(0.0, rows * width);
                for (uv, out) in uv.iter().zip(out.chunks_exact_mut(point_len)) {
                    let net = &weights.homogeneous;
                    self.contract(net, width, *uv, max_derivative, &mut scratch, &mut homogeneous);
                    divide(&homogeneous, self.dim, max_derivative, out);
                }
            }
        }
    }

    /// `sum_ij N_i^(a)(u) N_j^(b)(v) net_ij` for all orders `a + b <= max_derivative`, into rows of `width`.
    fn contract(
        &self,
        net: &[f64],
        width: usize,
        uv: DVec2,
        max_derivative: usize,
        scratch: &mut [f64],
        out: &mut [f64],
    ) {
        let (knots_u, knots_v) = (self.knots(Axis::U), self.knots(Axis::V));
        let (span_u, span_v) = (knots_u.span(uv.x), knots_v.span(uv.y));
        let basis_u = basis_derivatives(knots_u, span_u, uv.x, max_derivative);
        let basis_v = basis_derivatives(knots_v, span_v, uv.y, max_derivative);
        let (degree_u, degree_v) = (knots_u.degree(), knots_v.degree());
        let count_v = knots_v.basis_count();
        out.fill(0.0);
        for r in 0..=degree_u {
            let first = (span_u - degree_u + r) * count_v + span_v - degree_v;
            let line = &net[first * width..(first + degree_v + 1) * width];
            scratch.fill(0.0);
            for (b, sum) in scratch.chunks_exact_mut(width).enumerate().take(max_derivative + 1) {
                for (point, n) in line.chunks_exact(width).zip(basis_v[b]) {
                    sum.iter_mut().zip(point).for_each(|(s, x)| *s += n * x);
                }
            }
            for (&(a, b), row) in ORDERS.iter().zip(out.chunks_exact_mut(width)) {
                let n = basis_u[a][r];
                row.iter_mut().zip(&scratch[b * width..]).for_each(|(o, s)| *o += n * s);
            }
        }
    }
}
