//! The function g of an edge, which says how the derivatives across it balance: A_p + B_q = g E'.
//!
//! With c the balance of the sector at an end, `g(0) = c_0` and `g(1) = -c_1`; E is the edge curve and has to make
//! `g E'` a C1 cubic, so at an inner break `g [E''] + [g'] E' = 0`, [.] the jump.
//! ```text
//! both ends c = 0, or inner 4-valent    g = 0
//! no end inner 4-valent                 g = c_0 (1-s) - c_1 s, E is C2
//! one end inner 4-valent ("regular"):   four edges meet there, and opposite ones must have the same slope
//!   kinked      the opposite edge ends irregular too: both get the slope m = -c of the larger |c|;
//!               from the irregular end c to -m/2 at s = 1/2, and from there to 0
//!   quadratic   otherwise slope 0: c + l s as far as the last segment h, there a (1-s)^2,
//!               l = -2c/(2-h), a = c/(2h-h^2), and E is quadratic on that segment
//! ```
//! A kink bends nothing: [E''] is parallel to E', only the speed changes. A quadratic end costs about one order of
//! convergence.

use crate::layout::{HalfEdge, Layout, Sector};

/// g at the breaks of an edge, between which it is a polynomial.
#[derive(Debug, Clone, PartialEq)]
pub struct EdgeFunction {
    /// Values at the breaks.
    pub values: Vec<f64>,
    /// Slopes to the left of each break; at the first one, to its right.
    pub left: Vec<f64>,
    /// Slopes to the right of each break; at the last one, to its left.
    pub right: Vec<f64>,
    /// The end on whose segment g and E are quadratic.
    pub quadratic: Option<End>,
}

/// An end of an edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum End {
    /// Where it begins.
    First,
    /// Where it ends.
    Last,
}

/// How g comes about.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Rule {
    /// It vanishes.
    Zero,
    /// It is linear.
    Linear,
    /// It is linear on both halves, with this slope at the regular end.
    Kinked {
        /// The inner vertex of four quads.
        regular: End,
        /// The slope there.
        slope: f64,
    },
    /// It vanishes with its slope at the regular end.
    Quadratic {
        /// The inner vertex of four quads.
        regular: End,
    },
}

impl Rule {
    /// The rule of an edge that is smooth.
    pub fn of(layout: &Layout, edge: u32) -> Self {
        let ends = layout.end_sectors(edge);
        let [is_regular_0, is_regular_1] = ends.map(is_regular);
        let [c_0, c_1] = ends.map(Sector::balance);
        if (is_regular_0 && is_regular_1) || (c_0 == 0.0 && c_1 == 0.0) {
            return Self::Zero;
        }
        let regular = match [is_regular_0, is_regular_1] {
            [true, _] => End::First,
            [_, true] => End::Last,
            _ => return Self::Linear,
        };
        match common_slope(layout, edge, regular) {
            Some(slope) => Self::Kinked { regular, slope },
            None => Self::Quadratic { regular },
        }
    }

    /// Fewest segments an edge needs.
    pub fn least_segments(self) -> usize {
        match self {
            Self::Zero | Self::Linear => 1,
            Self::Kinked { .. } | Self::Quadratic { .. } => 2,
        }
    }

    /// g on these breaks, which are at least as many as needed; `c` are the balances at the ends.
    pub fn function(self, [c_0, c_1]: [f64; 2], breaks: &[f64]) -> Option<EdgeFunction> {
        match self {
            Self::Zero => None,
            Self::Linear => Some(piecewise_linear(breaks, &[(0.0, c_0), (1.0, -c_1)])),
            Self::Kinked { regular: End::First, slope } => {
                Some(piecewise_linear(breaks, &[(0.0, 0.0), (0.5, 0.5 * slope), (1.0, -c_1)]))
            }
            Self::Kinked { regular: End::Last, slope } => {
                Some(piecewise_linear(breaks, &[(0.0, c_0), (0.5, -0.5 * slope), (1.0, 0.0)]))
            }
            Self::Quadratic { regular: End::Last } => Some(quadratic(c_0, breaks)),
            Self::Quadratic { regular: End::First } => {
                let reversed: Vec<f64> = breaks.iter().rev().map(|s| 1.0 - s).collect();
                Some(quadratic(c_1, &reversed).reversed())
            }
        }
    }
}

fn is_regular(sector: &Sector) -> bool {
    !sector.is_open() && sector.valence() == 4
}

/// The slope that an edge shares with the opposite one at its regular end, if both end irregular.
fn common_slope(layout: &Layout, edge: u32, regular: End) -> Option<f64> {
    let [first, last] = layout.end_sectors(edge);
    let (here, far) = if regular == End::First { (first, last) } else { (last, first) };
    let away = HalfEdge { edge, is_forward: regular == End::First };
    let rank = here.edges.iter().position(|&other| other == away)?;
    let opposite = here.edges[(rank + 2) % 4];
    let far_opposite = layout.end_sectors(opposite.edge)[usize::from(opposite.is_forward)];
    let [c, d] = [far, far_opposite].map(|end| if end.is_open() { 0.0 } else { end.balance() });
    if c == 0.0 || d == 0.0 {
        return None;
    }
    let c_is_larger = if c.abs() == d.abs() { c > d } else { c.abs() > d.abs() };
    Some(if c_is_larger { -c } else { -d })
}

/// The function through a few points, the inner ones among the breaks.
fn piecewise_linear(breaks: &[f64], points: &[(f64, f64)]) -> EdgeFunction {
    let slopes: Vec<f64> = points.windows(2).map(|p| (p[1].1 - p[0].1) / (p[1].0 - p[0].0)).collect();
    let piece_before = |s: f64| points.windows(2).position(|p| s <= p[1].0).unwrap_or(slopes.len() - 1);
    let piece_after = |s: f64| points.windows(2).position(|p| s < p[1].0).unwrap_or(slopes.len() - 1);
    let value = |&s: &f64| {
        let piece = piece_before(s);
        let [(from, low), (to, high)] = [points[piece], points[piece + 1]];
        // exact at both ends
        (low * (to - s) + high * (s - from)) / (to - from)
    };
    EdgeFunction {
        values: breaks.iter().map(value).collect(),
        left: breaks.iter().map(|&s| slopes[piece_before(s)]).collect(),
        right: breaks.iter().map(|&s| slopes[piece_after(s)]).collect(),
        quadratic: None,
    }
}

/// From `c` at 0 to a double zero at 1.
fn quadratic(c: f64, breaks: &[f64]) -> EdgeFunction {
    let last = breaks.len() - 1;
    let h = breaks[last] - breaks[last - 1];
    let (l, a) = (-2.0 * c / (2.0 - h), c / (2.0 * h - h * h));
    let mut values: Vec<f64> = breaks.iter().map(|s| c + l * s).collect();
    (values[last - 1], values[last]) = (a * h * h, 0.0);
    let mut left = vec![l; last + 1];
    left[last] = 0.0;
    EdgeFunction { values, right: left.clone(), left, quadratic: Some(End::Last) }
}

impl EdgeFunction {
    /// The same from the other end: g and E' change sign, g' and E'' do not.
    fn reversed(self) -> Self {
        let flip = |rows: Vec<f64>| -> Vec<f64> { rows.into_iter().rev().collect() };
        Self {
            values: self.values.into_iter().rev().map(|g| -g).collect(),
            left: flip(self.right),
            right: flip(self.left),
            quadratic: self.quadratic.map(|end| if end == End::First { End::Last } else { End::First }),
        }
    }
}
