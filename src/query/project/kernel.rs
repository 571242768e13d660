//! Squared distance over a Bezier cell, as a polynomial in Bernstein form.
//!
//! With ordinates relative to the point, `S - P = R / w`, the squared distance is at least `b^2` on a cell if no
//! coefficient of
//! ```text
//! g(u,v) = |R|^2 - b^2 w^2
//! ```
//! is negative, and has one local minimum below `b^2` there if `g` is convex; for a rational cell `g` has to be
//! convex for every smaller `b` down to the cell's own bound as well, and it is linear in `b^2`. Both are read
//! off its coefficients, whose distance from `g` shrinks with the square of the cell's size, and with the second
//! derivatives of `g` itself: from the centre of a sphere one look is enough.
//!
//! A curve is a cell of degree 0 along v.

use crate::bezier::binomial;
use crate::knots::MAX_DEGREE;

/// What the cells of one index have in common.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Form {
    /// Degree along u and v.
    pub degree: [usize; 2],
    /// Components of a value.
    pub dim: usize,
    /// Whether a weight follows the components.
    pub is_rational: bool,
}

impl Form {
    /// Ordinates of a cell.
    pub fn count(&self) -> usize {
        (self.degree[0] + 1) * (self.degree[1] + 1)
    }

    /// Components of an ordinate.
    pub fn width(&self) -> usize {
        self.dim + usize::from(self.is_rational)
    }

    /// Numbers of a cell: component by component, v running fastest within each.
    pub fn len(&self) -> usize {
        self.count() * self.width()
    }
}

/// Products of cells of one form.
#[derive(Debug, Clone)]
pub struct Kernel {
    pub form: Form,
    /// Binomials that turn Bernstein products into convolutions, for each ordinate.
    scale: Vec<f64>,
    /// What turns convolutions back, for each coefficient of the square.
    unscale: Vec<f64>,
}

/// Bernstein coefficients of the squared distance over a cell, times the squared weight.
#[derive(Debug, Clone, Default)]
pub struct Square {
    scaled: Vec<f64>,
    distance: Vec<f64>,
    weight: Vec<f64>,
    g: Vec<f64>,
    /// Nothing in the cell judged last is nearer than the root of this.
    pub lowest: f64,
}

/// What [`Kernel::judge`] found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Verdict {
    /// Nothing in the cell is nearer than the limit.
    Beyond,
    /// One local minimum at most; the place, in the unit square, of the least coefficient.
    Convex([f64; 2]),
    /// Unknown; halve along this axis. The place is that of the least coefficient.
    Split(usize, [f64; 2]),
}

/// Most functions of one variable: a line across a patch has the sum of both degrees.
pub const MAX_FUNCTIONS: usize = 2 * MAX_DEGREE + 1;

impl Kernel {
    pub fn new(form: Form) -> Self {
        let weights = |[p, q]: [usize; 2]| -> Vec<f64> {
            (0..=p).flat_map(|i| (0..=q).map(move |j| binomial(p, i) * binomial(q, j))).collect()
        };
        let unscale = weights(form.degree.map(|degree| 2 * degree)).iter().map(|w| 1.0 / w).collect();
        Self { form, scale: weights(form.degree), unscale }
    }

    /// Looks at a cell: whether its squared distance can be less than `limit_sq`. `slack` is a change of
    /// `g` that does not matter.
    #[inline(always)]
    pub fn judge(&self, cell: &[f64], limit_sq: f64, slack: f64, square: &mut Square) -> Verdict {
        self.expand(cell, square);
        let Square { distance, weight, g, lowest: bound, .. } = square;
        let (mut least, mut at, mut lowest, mut largest) = (f64::INFINITY, 0, f64::INFINITY, 0.0_f64);
        if self.form.is_rational {
            g.clear();
            for (k, (&d, &w)) in distance.iter().zip(weight.iter()).enumerate() {
                let value = d - limit_sq * w;
                g.push(value);
                lowest = lowest.min(d / w);
                largest = largest.max(d.abs() + limit_sq * w);
                if value < least {
                    (least, at) = (value, k);
                }
            }
        } else {
            for (k, &d) in distance.iter().enumerate() {
                if d < least {
                    (least, at) = (d, k);
                }
                largest = largest.max(d.abs());
            }
            lowest = least;
            least -= limit_sq;
        }
        *bound = lowest;
        if least >= 0.0 {
            return Verdict::Beyond;
        }
        let degree = self.form.degree.map(|degree| 2 * degree);
        let [p, q] = degree;
        let place = [at / (q + 1), at % (q + 1)];
        let place = [0, 1].map(|k| if degree[k] > 0 { place[k] as f64 / degree[k] as f64 } else { 0.0 });
        // second differences of coefficients this large carry this much rounding
        let slack = slack + 64.0 * f64::EPSILON * largest;
        let (first, second) = if self.form.is_rational {
            let hessian = Hessian::of(g, p, q);
            let lowest = lowest.max(0.0);
            for (k, (&d, &w)) in distance.iter().zip(weight.iter()).enumerate() {
                g[k] = d - lowest * w;
            }
            (hessian, Hessian::of(g, p, q))
        } else {
            let hessian =
                if degree == [6, 6] { Hessian::of(distance, 6, 6) } else { Hessian::of(distance, p, q) };
            (hessian, hessian)
        };
        if first.is_convex(slack) && second.is_convex(slack) {
            return Verdict::Convex(place);
        }
        Verdict::Split(usize::from(first.size[1] > first.size[0]), place)
    }

    #[inline(always)]
    fn expand(&self, cell: &[f64], square: &mut Square) {
        let count = self.form.count();
        let [p, q] = self.form.degree;
        let size = self.unscale.len();
        for (sums, wanted) in [(&mut square.distance, true), (&mut square.weight, self.form.is_rational)] {
            sums.clear();
            sums.resize(if wanted { size } else { 0 }, 0.0);
        }
        square.scaled.clear();
        square.scaled.resize(count, 0.0);
        for (k, component) in cell.chunks_exact(count).enumerate() {
            for i in 0..count {
                square.scaled[i] = component[i] * self.scale[i];
            }
            let sums = if k < self.form.dim { &mut square.distance } else { &mut square.weight };
            match [p, q] {
                [3, 3] => convolve(&square.scaled, 3, 3, sums),
                _ => convolve(&square.scaled, p, q, sums),
            }
        }
        for sums in [&mut square.distance, &mut square.weight] {
            for (sum, factor) in sums.iter_mut().zip(&self.unscale) {
                *sum *= factor;
            }
        }
    }
}

/// Adds the square of a polynomial with `p + 1` times `q + 1` coefficients.
#[inline(always)]
fn convolve(a: &[f64], p: usize, q: usize, out: &mut [f64]) {
    let (n, wide) = (q + 1, 2 * q + 1);
    let a = &a[..(p + 1) * n];
    let out = &mut out[..(2 * p + 1) * wide];
    for i in 0..p + 1 {
        for k in i..p + 1 {
            let twice = if i == k { 1.0 } else { 2.0 };
            let out = &mut out[(i + k) * wide..][..wide];
            for j in 0..q + 1 {
                let x = twice * a[i * n + j];
                for l in 0..q + 1 {
                    out[j + l] += x * a[k * n + l];
                }
            }
        }
    }
}

/// Bounds of the second derivatives over the unit square.
#[derive(Debug, Clone, Copy)]
struct Hessian {
    least: [f64; 2],
    /// Largest size of both, which says along which axis the coefficients are farthest from `g`.
    size: [f64; 2],
    mixed: f64,
    is_curve: bool,
}

impl Hessian {
    #[inline(always)]
    fn of(g: &[f64], p: usize, q: usize) -> Self {
        let n = q + 1;
        let g = &g[..(p + 1) * n];
        let mut hessian = Self { least: [f64::INFINITY; 2], size: [0.0; 2], mixed: 0.0, is_curve: q == 0 };
        let mut add = |axis: usize, x: f64| {
            // comparisons, because f64::min and f64::max care for NaN
            hessian.least[axis] = if x < hessian.least[axis] { x } else { hessian.least[axis] };
            hessian.size[axis] = if x.abs() > hessian.size[axis] { x.abs() } else { hessian.size[axis] };
        };
        let factor = (p * p.saturating_sub(1)) as f64;
        for k in 0..(p + 1).saturating_sub(2) * n {
            add(0, factor * (g[k] - 2.0 * g[k + n] + g[k + 2 * n]));
        }
        let factor = (q * q.saturating_sub(1)) as f64;
        for row in g.chunks_exact(n) {
            for c in row.windows(3) {
                add(1, factor * (c[0] - 2.0 * c[1] + c[2]));
            }
        }
        let factor = (p * q) as f64;
        for (row, next) in g.chunks_exact(n).zip(g.chunks_exact(n).skip(1)) {
            for (c, d) in row.windows(2).zip(next.windows(2)) {
                let x = (factor * (c[0] - c[1] - d[0] + d[1])).abs();
                hessian.mixed = if x > hessian.mixed { x } else { hessian.mixed };
            }
        }
        hessian
    }

    #[inline(always)]
    fn is_convex(&self, slack: f64) -> bool {
        let [a, c] = self.least.map(|x| x + slack);
        if self.is_curve { a >= 0.0 } else { a >= 0.0 && c >= 0.0 && a * c >= self.mixed * self.mixed }
    }
}
