//! Cubic basis functions by their coefficients: what fast evaluation works on.
//!
//! On each knot span the four basis functions are cubics of the place in the span, `x` in [0, 1]; their
//! coefficients are kept, which makes a basis function three multiplications whatever the knots are.
//!
//! ```text
//! N_r(u) = ((c_r3 x + c_r2) x + c_r1) x + c_r0,    x = (u - t_k) / (t_{k+1} - t_k)
//! ```

use crate::bezier::extraction;
use crate::knots::KnotVector;
use crate::memory::CollectVec;
use pulp::Simd;

/// Basis functions of one span.
#[derive(Debug, Clone)]
pub(crate) struct CubicSpan {
    /// Row `m` has the coefficients of `x^m`.
    pub coefficients: [[f64; 4]; 4],
    pub start: f64,
    pub inverse_length: f64,
    /// The first control point of the span.
    pub first: usize,
}

impl CubicSpan {
    pub(crate) fn new(knots: &KnotVector, span: usize) -> Self {
        let (t, e) = (knots.knots(), extraction(knots, span));
        let ordinate = |j: usize, r: usize| e[4 * j + r];
        let mut coefficients = [[0.0; 4]; 4];
        for r in 0..4 {
            let b = [0, 1, 2, 3].map(|j| ordinate(j, r));
            coefficients[0][r] = b[0];
            coefficients[1][r] = 3.0 * (b[1] - b[0]);
            coefficients[2][r] = 3.0 * ((b[2] - b[1]) - (b[1] - b[0]));
            coefficients[3][r] = (b[3] - b[0]) - 3.0 * (b[2] - b[1]);
        }
        Self { coefficients, start: t[span], inverse_length: 1.0 / (t[span + 1] - t[span]), first: span - 3 }
    }

    /// All spans of positive length, in their order.
    pub(crate) fn all(knots: &KnotVector) -> Vec<Self> {
        knots.spans().map(|k| Self::new(knots, k)).collect_vec()
    }

    #[inline(always)]
    pub(crate) fn basis<S: Simd>(&self, u: f64) -> [f64; 4] {
        let x = (u - self.start) * self.inverse_length;
        let [c0, c1, c2, c3] = &self.coefficients;
        let mut n = [0.0; 4];
        for r in 0..4 {
            n[r] = fma::<S>(fma::<S>(fma::<S>(c3[r], x, c2[r]), x, c1[r]), x, c0[r]);
        }
        n
    }

    #[inline(always)]
    pub(crate) fn slopes<S: Simd>(&self, u: f64) -> [f64; 4] {
        let x = (u - self.start) * self.inverse_length;
        let [_, c1, c2, c3] = &self.coefficients;
        let mut n = [0.0; 4];
        for r in 0..4 {
            n[r] = fma::<S>(fma::<S>(3.0 * c3[r], x, 2.0 * c2[r]), x, c1[r]) * self.inverse_length;
        }
        n
    }
}

/// `a b + c`, in one instruction where there is one; the library function is slow.
#[inline(always)]
pub(super) fn fma<S: Simd>(a: f64, b: f64, c: f64) -> f64 {
    if S::IS_SCALAR { a * b + c } else { a.mul_add(b, c) }
}
