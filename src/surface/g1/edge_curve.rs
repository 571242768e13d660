//! The curve E over an edge: cubic on each segment, with the derivatives that make g E' a C1 cubic.
//!
//! ```text
//! inner break j:       2/l E'_{j-1} + (4/l + 4/r - [g']/g) E'_j + 2/r E'_{j+1}
//!                                                         = 6 (E_{j+1} - E_j)/r^2 + 6 (E_j - E_{j-1})/l^2
//! quadratic segment h: E_{N-1} = E_N - h/2 (E'_{N-1} + E'_N)
//! ```
//! with the segments l before it and r after it: `g [E''] + [g'] E' = 0`, a tridiagonal system. What is free are the
//! positions and the derivatives at both ends; all others are rows over these inputs.

use super::edge_function::{EdgeFunction, End};
use crate::linalg::Tridiagonal;

/// E_j and E'_j as rows over the inputs E_0, .., E_N, E'_0, E'_N.
#[derive(Debug, Clone)]
pub(super) struct EdgeCurve {
    segments: Vec<f64>,
    /// E at each break.
    pub positions: Vec<Vec<f64>>,
    /// E' at each break.
    pub slopes: Vec<Vec<f64>>,
}

/// What a position that is not free is made of: `E_end + half (E'_at + E'_end)`.
#[derive(Clone, Copy)]
struct Dependent {
    at: usize,
    end: usize,
    end_slope: usize,
    half: f64,
}

impl EdgeCurve {
    /// The curve over these breaks.
    pub(super) fn new(breaks: &[f64], g: &EdgeFunction) -> Self {
        let segments: Vec<f64> = breaks.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let n = segments.len();
        let width = n + 3;
        let dependent = Self::dependent(&segments, g);
        let inner = n - 1;
        let (mut lower, mut diagonal, mut upper) = (vec![0.0; inner], vec![0.0; inner], vec![0.0; inner]);
        let mut right = vec![0.0; inner * width];
        for j in 1..n {
            let (l, r, row) = (segments[j - 1], segments[j], j - 1);
            let kink = if g.values[j] == 0.0 { 0.0 } else { (g.right[j] - g.left[j]) / g.values[j] };
            (lower[row], diagonal[row], upper[row]) = (2.0 / l, 4.0 / l + 4.0 / r - kink, 2.0 / r);
            let inputs = &mut right[row * width..][..width];
            let (from_left, from_right) = (6.0 / (l * l), 6.0 / (r * r));
            for (at, factor) in [(j - 1, -from_left), (j, from_left - from_right), (j + 1, from_right)] {
                match dependent {
                    Some(dependent) if dependent.at == at => {
                        inputs[dependent.end] += factor;
                        inputs[dependent.end_slope] += factor * dependent.half;
                        let place = [&mut lower[row], &mut diagonal[row], &mut upper[row]];
                        *place.into_iter().nth(at + 1 - j).expect("a neighbour") -= factor * dependent.half;
                    }
                    _ => inputs[at] += factor,
                }
            }
            if j == 1 {
                inputs[n + 1] -= lower[row];
            }
            if j == n - 1 {
                inputs[n + 2] -= upper[row];
            }
        }
        if inner > 0 {
            Tridiagonal::new(lower, &diagonal, upper).solve(&mut right, width);
        }
        let unit = |k: usize| (0..width).map(|i| f64::from(u8::from(i == k))).collect::<Vec<f64>>();
        let mut slopes = vec![unit(n + 1)];
        slopes.extend(right.chunks_exact(width).map(<[f64]>::to_vec));
        slopes.push(unit(n + 2));
        let mut positions: Vec<Vec<f64>> = (0..=n).map(unit).collect();
        if let Some(Dependent { at, end, end_slope, half }) = dependent {
            positions[at] = slopes[at].iter().map(|x| half * x).collect();
            positions[at][end] += 1.0;
            positions[at][end_slope] += half;
        }
        Self { segments, positions, slopes }
    }

    fn dependent(segments: &[f64], g: &EdgeFunction) -> Option<Dependent> {
        let n = segments.len();
        g.quadratic.map(|end| match end {
            End::First => Dependent { at: 1, end: 0, end_slope: n + 1, half: 0.5 * segments[0] },
            End::Last => Dependent { at: n - 1, end: n, end_slope: n + 2, half: -0.5 * segments[n - 1] },
        })
    }

    /// Whether a position is free.
    pub(super) fn is_free(&self, at: usize) -> bool {
        self.positions[at][at] == 1.0
    }

    /// E'' to the right of a break.
    pub(super) fn second_right(&self, at: usize) -> Vec<f64> {
        let h = self.segments[at];
        self.row(at, |from, to, d_from, d_to| (6.0 / h * (to - from) - 4.0 * d_from - 2.0 * d_to) / h)
    }

    /// E'' to the left of a break.
    pub(super) fn second_left(&self, at: usize) -> Vec<f64> {
        let h = self.segments[at - 1];
        self.row(at - 1, |from, to, d_from, d_to| (-6.0 / h * (to - from) + 2.0 * d_from + 4.0 * d_to) / h)
    }

    /// A row made of those of the ends of a segment.
    fn row(&self, segment: usize, of: impl Fn(f64, f64, f64, f64) -> f64) -> Vec<f64> {
        let (p, d) = (&self.positions, &self.slopes);
        let inputs = 0..p[0].len();
        inputs.map(|k| of(p[segment][k], p[segment + 1][k], d[segment][k], d[segment + 1][k])).collect()
    }
}
