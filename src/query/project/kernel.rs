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
use crate::memory::CollectVec;

/// What the cells of one index have in common.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Form {
    /// Degree along u and v.
    pub degree: [usize; 2],
    /// Components of a value.
    pub dim: usize,
    /// Whether a weight follows the components.
    pub is_rational: bool,
}

impl Form {
    /// Ordinates of a cell.
    pub(super) fn count(&self) -> usize {
        (self.degree[0] + 1) * (self.degree[1] + 1)
    }

    /// Components of an ordinate.
    pub(super) fn width(&self) -> usize {
        self.dim + usize::from(self.is_rational)
    }

    /// Numbers of a cell: component by component, v running fastest within each.
    pub(super) fn len(&self) -> usize {
        self.count() * self.width()
    }
}

/// Products of cells of one form.
#[derive(Debug, Clone)]
pub(super) struct Kernel {
    pub form: Form,
    /// Binomials that turn Bernstein products into convolutions, for each ordinate.
    scale: Vec<f64>,
    /// What turns convolutions back, for each coefficient of the square.
    unscale: Vec<f64>,
}

/// Bernstein coefficients of the squared distance over a cell, times the squared weight.
#[derive(Debug, Clone, Default)]
pub(super) struct Square {
    scaled: Vec<f64>,
    distance: Vec<f64>,
    weight: Vec<f64>,
    g: Vec<f64>,
    /// Nothing in the cell judged last is nearer than the root of this.
    pub lowest: f64,
}

/// What [`Kernel::judge`] found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Verdict {
    /// Nothing in the cell is nearer than the limit.
    Beyond,
    /// Everywhere in the cell the distance falls towards a side that has a neighbour: no minimum is here.
    Slope,
    /// One local minimum at most; the place, in the unit square, of the least coefficient.
    Convex([f64; 2]),
    /// Unknown; halve along this axis. The place is that of the least coefficient.
    Split(usize, [f64; 2]),
}

/// Most functions of one variable: a line across a patch has the sum of both degrees.
pub(super) const MAX_FUNCTIONS: usize = 2 * MAX_DEGREE + 1;

impl Kernel {
    pub(super) fn new(form: Form) -> Self {
        let weights = |[p, q]: [usize; 2]| -> Vec<f64> {
            (0..=p).flat_map(|i| (0..=q).map(move |j| binomial(p, i) * binomial(q, j))).collect_vec()
        };
        let unscale = weights(form.degree.map(|degree| 2 * degree)).iter().map(|w| 1.0 / w).collect_vec();
        Self { form, scale: weights(form.degree), unscale }
    }

    /// Looks at a cell: whether its squared distance can be less than `limit_sq`. `slack` is a change of
    /// `g` that does not matter; `shared` says which sides, the lower and the upper along each axis, lie within
    /// a leaf, so that the surface is smooth across them.
    #[inline(always)]
    pub(super) fn judge(
        &self,
        cell: &[f64],
        limit_sq: f64,
        slack: f64,
        shared: [[bool; 2]; 2],
        square: &mut Square,
    ) -> Verdict {
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
        let rounding = 64.0 * f64::EPSILON * largest;
        let slack = slack + rounding;
        let falls_to_shared = |g: &[f64]| {
            let falls = falls(g, [p, q], rounding);
            [0, 1].map(|axis| [0, 1].map(|side| shared[axis][side] && falls[axis][side]))
        };
        let is_slope = |falls: [[bool; 2]; 2]| falls.as_flattened().contains(&true);
        let (first, second) = if self.form.is_rational {
            let hessian = Hessian::of(g, p, q);
            let falls = falls_to_shared(g);
            let lowest = lowest.max(0.0);
            for (k, (&d, &w)) in distance.iter().zip(weight.iter()).enumerate() {
                g[k] = d - lowest * w;
            }
            if is_slope(falls) {
                let at_lowest = falls_to_shared(g);
                let both = |axis: usize| [0, 1].map(|side| falls[axis][side] && at_lowest[axis][side]);
                if is_slope([both(0), both(1)]) {
                    return Verdict::Slope;
                }
            }
            (hessian, Hessian::of(g, p, q))
        } else {
            if shared != [[false; 2]; 2] && is_slope(falls_to_shared(distance)) {
                return Verdict::Slope;
            }
            let hessian =
                if degree == [6, 6] { Hessian::of(distance, 6, 6) } else { Hessian::of(distance, p, q) };
            (hessian, hessian)
        };
        if first.is_convex(slack) && second.is_convex(slack) {
            return Verdict::Convex(place);
        }
        Verdict::Split(usize::from(first.size[1] > first.size[0]), place)
    }

    /// The largest distance from a centre within which every point sees one local minimum at most in a cell; 0 where
    /// that is not known. With `e` the way from the centre to the point
    /// ```text
    /// |S - P|^2 = |S - C|^2 - 2 (S - C) e + |e|^2
    /// ```
    /// so second derivatives change by no more than `2 |e|` times the largest of the cell.
    pub(super) fn convex_radius(&self, cell: &[f64], centre: &[f64], square: &mut Square) -> f64 {
        let ([p, q], count) = (self.form.degree, self.form.count());
        if self.form.is_rational || q == 0 {
            return 0.0;
        }
        let relative: Vec<f64> = cell
            .chunks_exact(count)
            .zip(centre)
            .flat_map(|(row, c)| row.iter().map(move |a| a - c))
            .collect_vec();
        self.expand(&relative, square);
        let hessian = Hessian::of(&square.distance, 2 * p, 2 * q);
        let largest = square.distance.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let rounding = 64.0 * f64::EPSILON * largest;
        let mut bends_sq = [0.0_f64; 3];
        let parts: Vec<Hessian> =
            relative.chunks_exact(count).map(|row| Hessian::of(row, p, q)).collect_vec();
        for part in &parts {
            // the size of a vector is at most that of the largest of each component
            for (sum, x) in bends_sq.iter_mut().zip([part.size[0], part.size[1], part.mixed]) {
                *sum += x * x;
            }
        }
        let [uu, vv, uv] = bends_sq.map(f64::sqrt);
        let is_convex = |radius: f64| {
            let changed = |least: f64, bend: f64| least - rounding - 2.0 * radius * bend;
            let (a, c) = (changed(hessian.least[0], uu), changed(hessian.least[1], vv));
            let b = hessian.mixed + rounding + 2.0 * radius * uv;
            a >= 0.0 && c >= 0.0 && a * c >= b * b
        };
        let (mut low, mut high) = (0.0, 4.0 * largest.sqrt());
        if !is_convex(low) {
            return 0.0;
        }
        if is_convex(high) {
            return high;
        }
        /// More would not make a search faster.
        const HALVINGS: u32 = 12;
        for _ in 0..HALVINGS {
            let middle = (low + high) / 2.0;
            *(if is_convex(middle) { &mut low } else { &mut high }) = middle;
        }
        low
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

/// Along each axis: whether a polynomial falls everywhere towards the lower side, and towards the upper one.
#[inline(always)]
fn falls(g: &[f64], [p, q]: [usize; 2], rounding: f64) -> [[bool; 2]; 2] {
    let n = q + 1;
    let mut falls = [[p > 0; 2], [q > 0; 2]];
    let mut add = |axis: usize, rise: f64| {
        falls[axis][0] &= rise > rounding;
        falls[axis][1] &= rise < -rounding;
    };
    for k in 0..p * n {
        add(0, g[k + n] - g[k]);
    }
    for row in g.chunks_exact(n) {
        row.windows(2).for_each(|c| add(1, c[1] - c[0]));
    }
    falls
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
