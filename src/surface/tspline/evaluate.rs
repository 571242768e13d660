//! Plain evaluation: any derivative is a sum over the four active control curves,
//! ```text
//! d^{a+b} S / du^a dv^b = sum_j Q_j^(a)(u) N_j^(b)(v)
//! ```

use super::{DEGREE, TSplineSurface};
use crate::basis::basis_derivatives;
use crate::memory;
use crate::surface::{ORDERS, Surface, derivative_rows};
use glam::DVec2;

impl TSplineSurface {
    pub(super) fn eval_rows_plain(&self, uv: &[DVec2], max_derivative: usize, out: &mut [f64]) {
        let dim = self.dim();
        let mut values = memory::filled(0.0, (max_derivative + 1) * dim);
        for (uv, out) in uv.iter().zip(out.chunks_exact_mut(derivative_rows(max_derivative) * dim)) {
            let span = self.knots_v.span(uv.y);
            let basis = basis_derivatives(&self.knots_v, span, uv.y, max_derivative);
            out.fill(0.0);
            for (r, curve) in self.active(span).iter().enumerate().take(DEGREE + 1) {
                curve.eval_rows(&[uv.x], max_derivative, &mut values);
                for (&(a, b), row) in ORDERS.iter().zip(out.chunks_exact_mut(dim)) {
                    let n = basis[b][r];
                    row.iter_mut().zip(&values[a * dim..]).for_each(|(sum, q)| *sum += n * q);
                }
            }
        }
    }
}
