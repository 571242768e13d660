//! Batches of points: rules for parameters outside, flags, strides, threads.

use super::differential::{curvatures, normal};
use super::{Domain, Surface, derivative_rows};
use crate::control::Pool;
use crate::failure::{Classify, ErrorKind};
use crate::memory::{self, CollectVec};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// Flag of a point: its parameters lie outside the domain.
pub const FLAG_OUTSIDE_DOMAIN: u8 = 1;
/// Flag of a point: it lies outside the trims.
pub const FLAG_OUTSIDE_TRIMS: u8 = 2;
/// Flag of a point: it lies in the buffer, inside the domain but beyond the box of the data.
pub const FLAG_IN_BUFFER: u8 = 4;
/// Flag of a point: the surface has no normal there, so normal and curvatures are NaN.
pub const FLAG_NO_NORMAL: u8 = 8;

/// What to do with parameters outside the domain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum OutsideRule {
    /// Refuse all, before one value is written.
    #[default]
    Fail,
    /// NaN and a flag.
    Flag,
    /// Continue the end polynomial, and a flag.
    Extrapolate,
}

/// What to compute at each point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// S: `dim` numbers.
    Values,
    /// S and its derivatives up to this order (at most [`super::MAX_DERIVATIVE`]).
    Derivatives(usize),
    /// The unit normal: 3 numbers. Needs `dim` 3.
    Normals,
    /// k1, k2, and their directions: 8 numbers. Needs `dim` 3.
    Curvatures,
}

impl Quantity {
    /// Numbers a point.
    pub fn width(self, dim: usize) -> usize {
        match self {
            Self::Values => dim,
            Self::Derivatives(order) => dim * derivative_rows(order),
            Self::Normals => 3,
            Self::Curvatures => 8,
        }
    }

    fn max_derivative(self) -> usize {
        match self {
            Self::Values => 0,
            Self::Derivatives(order) => order,
            Self::Normals => 1,
            Self::Curvatures => 2,
        }
    }
}

/// Points cannot be evaluated.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum EvalError {
    /// A parameter is NaN or infinite.
    #[error("the parameters of point {index} are not finite")]
    NotFinite {
        /// The point.
        index: usize,
    },
    /// A point lies outside the domain.
    #[error("point {index} at ({u}, {v}) lies outside the domain")]
    Outside {
        /// The point.
        index: usize,
        /// Its u.
        u: f64,
        /// Its v.
        v: f64,
    },
    /// The derivative is not offered.
    #[error("derivatives of order {order} are not offered, the highest is {}", super::MAX_DERIVATIVE)]
    Derivative {
        /// The order asked for.
        order: usize,
    },
    /// Only surfaces in space have normals and curvatures.
    #[error("a surface of dimension {dim} has no normals, dimension 3 is needed")]
    Dimension {
        /// Dimension of the surface.
        dim: usize,
    },
}

impl Classify for EvalError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::NotFinite { .. } => ErrorKind::NotFinite,
            Self::Outside { .. } => ErrorKind::Outside,
            Self::Derivative { .. } | Self::Dimension { .. } => ErrorKind::InvalidArgument,
        }
    }

    /// The offending point.
    fn index(&self) -> Option<usize> {
        match *self {
            Self::NotFinite { index } | Self::Outside { index, .. } => Some(index),
            _ => None,
        }
    }
}

/// The points of a batch.
#[derive(Debug, Clone, Copy)]
pub struct Points<'a> {
    count: usize,
    layout: Layout<'a>,
}

#[derive(Debug, Clone, Copy)]
enum Layout<'a> {
    /// Row `i` starts `i * stride` numbers after the first.
    Rows { data: &'a [f64], stride: usize },
    /// All pairs, v running fastest.
    Grid { u: &'a [f64], v: &'a [f64] },
}

impl<'a> Points<'a> {
    /// `count` rows of u and v in `data`, which has `(count - 1) * stride + 2` numbers.
    pub fn new(data: &'a [f64], stride: usize, count: usize) -> Self {
        assert!(stride >= 2 && (count == 0 || data.len() >= (count - 1) * stride + 2));
        Self { count, layout: Layout::Rows { data, stride } }
    }

    /// All pairs of `u` and `v`, `v` running fastest.
    pub fn grid(u: &'a [f64], v: &'a [f64]) -> Self {
        Self { count: u.len() * v.len(), layout: Layout::Grid { u, v } }
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.count
    }

    fn get(&self, index: usize) -> DVec2 {
        match self.layout {
            Layout::Rows { data, stride } => DVec2::from_slice(&data[index * stride..]),
            Layout::Grid { u, v } => DVec2::new(u[index / v.len()], v[index % v.len()]),
        }
    }
}

/// Points of one piece of work. Pieces do not depend on the number of threads.
const CHUNK: usize = 1024;

/// The pieces of work that so many points are: no more threads are of use.
pub fn piece_count(count: usize) -> usize {
    count.div_ceil(CHUNK)
}

/// Where results go.
#[derive(Debug)]
pub struct Output<'a> {
    /// Row `i` starts `i * stride` numbers after the first; what lies between rows is left alone.
    pub rows: &'a mut [f64],
    /// At least the width of the quantity.
    pub stride: usize,
    /// An entry for each point, which receives the `FLAG_` bits that hold; empty for none.
    pub flags: &'a mut [u8],
}

/// Evaluates `quantity` at all `points`. Returns how many of them lie outside the domain.
pub fn evaluate(
    surface: &dyn Surface,
    quantity: Quantity,
    points: Points,
    rule: OutsideRule,
    output: Output,
    pool: &Pool,
) -> Result<usize, EvalError> {
    let width = quantity.width(surface.dim());
    check_quantity(surface, quantity)?;
    if let Layout::Grid { u, v } = points.layout
        && quantity == Quantity::Values
        && output.stride == width
        && surface.patches().is_some() // else the domain may be no rectangle
        && is_grid_inside(&surface.domain(), u, v)
    {
        evaluate_grid(surface, u, v, output, pool);
        return Ok(0);
    }
    match rule {
        OutsideRule::Fail => check_inside(surface, &points)?,
        OutsideRule::Extrapolate => check_finite(&points)?,
        OutsideRule::Flag => {}
    }
    let Output { rows, stride, flags } = output;
    assert!(stride >= width, "rows of {width} numbers every {stride}");
    let wants_flags = !flags.is_empty();
    let piece = |chunk: usize, rows: &mut [f64], flags: &mut [u8]| {
        let first = chunk * CHUNK;
        let uv: Vec<DVec2> = (first..points.count.min(first + CHUNK)).map(|i| points.get(i)).collect_vec();
        eval_piece(surface, quantity, &uv, rule, Output { rows, stride, flags })
    };
    if pool.thread_count() == 1 || points.count <= CHUNK {
        let rows = rows.chunks_mut(CHUNK * stride);
        if wants_flags {
            return Ok(rows.zip(flags.chunks_mut(CHUNK)).enumerate().map(|(k, (r, f))| piece(k, r, f)).sum());
        }
        return Ok(rows.enumerate().map(|(k, r)| piece(k, r, &mut [])).sum());
    }
    Ok(pool.run(|| {
        let rows = rows.par_chunks_mut(CHUNK * stride).enumerate();
        if wants_flags {
            return rows.zip(flags.par_chunks_mut(CHUNK)).map(|((k, r), f)| piece(k, r, f)).sum();
        }
        rows.map(|(k, r)| piece(k, r, &mut [])).sum()
    }))
}

/// Lines of a grid in one piece of work, so that what is computed for all of v serves many of them.
const GRID_LINES: usize = 64;

/// Values on a grid inside the domain, tightly packed.
fn evaluate_grid(surface: &dyn Surface, u: &[f64], v: &[f64], output: Output, pool: &Pool) {
    let Output { rows, stride, flags } = output;
    let count = u.len() * v.len();
    if count == 0 {
        return;
    }
    let piece = |(u, rows): (&[f64], &mut [f64])| surface.eval_grid(u, v, rows);
    let rows = &mut rows[..count * stride];
    if pool.thread_count() == 1 || count <= CHUNK {
        u.chunks(GRID_LINES).zip(rows.chunks_mut(GRID_LINES * v.len() * stride)).for_each(piece);
    } else {
        pool.run(|| {
            u.par_chunks(GRID_LINES).zip(rows.par_chunks_mut(GRID_LINES * v.len() * stride)).for_each(piece);
        });
    }
    for (k, flag) in flags.iter_mut().enumerate() {
        *flag = flags_at(surface, DVec2::new(u[k / v.len()], v[k % v.len()]), false);
    }
}

fn is_grid_inside(domain: &Domain, u: &[f64], v: &[f64]) -> bool {
    let within = |all: &[f64], from: f64, to: f64| all.iter().all(|&t| from <= t && t <= to);
    within(u, domain.min.x, domain.max.x) && within(v, domain.min.y, domain.max.y)
}

fn check_quantity(surface: &dyn Surface, quantity: Quantity) -> Result<(), EvalError> {
    match quantity {
        Quantity::Derivatives(order) if order > super::MAX_DERIVATIVE => Err(EvalError::Derivative { order }),
        Quantity::Normals | Quantity::Curvatures if surface.dim() != 3 => {
            Err(EvalError::Dimension { dim: surface.dim() })
        }
        _ => Ok(()),
    }
}

fn check_inside(surface: &dyn Surface, points: &Points) -> Result<(), EvalError> {
    match (0..points.count).find(|&i| !surface.contains(points.get(i))) {
        None => Ok(()),
        Some(index) => {
            let DVec2 { x: u, y: v } = points.get(index);
            Err(if u.is_finite() && v.is_finite() {
                EvalError::Outside { index, u, v }
            } else {
                EvalError::NotFinite { index }
            })
        }
    }
}

fn check_finite(points: &Points) -> Result<(), EvalError> {
    match (0..points.count).find(|&i| !points.get(i).is_finite()) {
        Some(index) => Err(EvalError::NotFinite { index }),
        None => Ok(()),
    }
}

/// One piece: evaluates into tight rows, derives what was asked, and writes it at the caller's stride.
fn eval_piece(
    surface: &dyn Surface,
    quantity: Quantity,
    uv: &[DVec2],
    rule: OutsideRule,
    output: Output,
) -> usize {
    let Output { rows: out, stride: out_stride, flags } = output;
    let dim = surface.dim();
    let width = quantity.width(dim);
    let is_raw = matches!(quantity, Quantity::Values | Quantity::Derivatives(_));
    if is_raw && out_stride == width {
        surface.eval_rows(uv, quantity.max_derivative(), &mut out[..uv.len() * width]);
    } else {
        let row = dim * derivative_rows(quantity.max_derivative());
        let mut rows = memory::filled(0.0, uv.len() * row);
        surface.eval_rows(uv, quantity.max_derivative(), &mut rows);
        for (k, row) in rows.chunks_exact(row).enumerate() {
            derive(quantity, row, &mut out[k * out_stride..][..width]);
        }
    }
    let mut outside = 0;
    for (k, &uv) in uv.iter().enumerate() {
        let row = &mut out[k * out_stride..][..width];
        let is_outside = !surface.contains(uv);
        outside += usize::from(is_outside);
        if is_outside && rule == OutsideRule::Flag {
            row.fill(f64::NAN);
        }
        if let Some(flag) = flags.get_mut(k) {
            *flag = flags_at(surface, uv, is_outside);
            if !is_raw && !is_outside && row[0].is_nan() {
                *flag |= FLAG_NO_NORMAL;
            }
        }
    }
    outside
}

fn derive(quantity: Quantity, row: &[f64], out: &mut [f64]) {
    let vector = |k: usize| DVec3::from_slice(&row[3 * k..]);
    match quantity {
        Quantity::Values | Quantity::Derivatives(_) => out.copy_from_slice(row),
        Quantity::Normals => normal(vector(1), vector(2)).write_to_slice(out),
        Quantity::Curvatures => {
            let at = curvatures([1, 2, 3, 4, 5].map(vector));
            out[0] = at.k1;
            out[1] = at.k2;
            at.direction1.write_to_slice(&mut out[2..]);
            at.direction2.write_to_slice(&mut out[5..]);
        }
    }
}

fn flags_at(surface: &dyn Surface, uv: DVec2, is_outside: bool) -> u8 {
    let region = surface.region();
    let mut flags = 0;
    if is_outside {
        flags |= FLAG_OUTSIDE_DOMAIN;
    }
    if !region.trims.contains(uv) {
        flags |= FLAG_OUTSIDE_TRIMS;
    }
    if !is_outside && region.data_box.is_some_and(|data| !data.contains(uv)) {
        flags |= FLAG_IN_BUFFER;
    }
    flags
}
