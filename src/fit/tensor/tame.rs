//! Cells without data, and what is done where the surface runs wild over them.

use super::candidate::Candidate;
use super::{FitError, Method, Problem};
use crate::control::{Control, Pool};
use crate::fit::common::tame::{CutCells, FARTHEST, FINER_BEYOND, Standing, excursion, is_wild, tamed};
use crate::fit::common::trims;
use crate::fit::common::uniform::grid::Part;
use crate::geometry::{Bounds, Domain};
use crate::surface::tensor::{Axis, TensorSurface};
use crate::surface::{Surface, Trims};
use glam::DVec2;

/// How often a buffer is halved before it is given up.
const BUFFER_HALVINGS: i32 = 4;
/// How often the cells of a grid are halved along u and v that are too large for their emptiness, in turn.
const FINER: [[u32; 2]; 4] = [[1, 0], [0, 1], [1, 1], [2, 2]];
/// How often cells between free knots are halved that are too large for their emptiness.
pub(super) const HALVINGS: usize = 2;

impl Problem<'_> {
    /// The loops of the mesh at the present parameters.
    pub(super) fn trims(&self) -> Trims {
        trims(self.mesh, &self.uv, &self.data_box)
    }

    /// Which cells between breaks have no data and are no part of the mesh.
    fn empty_cells(&self, breaks: [&[f64]; 2], trims: &Trims) -> Vec<bool> {
        let [cells_u, cells_v] = breaks.map(|breaks| breaks.len() - 1);
        let mut is_empty = vec![true; cells_u * cells_v];
        let cell = |axis: usize, u: f64| {
            let last = breaks[axis].len() - 1;
            breaks[axis][1..last].partition_point(|&at| at <= u)
        };
        for uv in &self.uv {
            is_empty[cell(0, uv.x) * cells_v + cell(1, uv.y)] = false;
        }
        let middle = |axis: usize, cell: usize| (breaks[axis][cell] + breaks[axis][cell + 1]) / 2.0;
        for (cell, is_empty) in is_empty.iter_mut().enumerate().filter(|(_, is_empty)| **is_empty) {
            let uv = DVec2::new(middle(0, cell / cells_v), middle(1, cell % cells_v));
            *is_empty = trims.is_empty() || !trims.contains(uv);
        }
        is_empty
    }

    /// The cells between breaks, or parts of them, and which of their products are empty. Cells are cut only where a mesh says
    /// what is between its nodes.
    pub(super) fn emptiness(&self, breaks: [&[f64]; 2], cut: CutCells, trims: &Trims) -> Emptiness {
        if cut == CutCells::No || trims.is_empty() {
            let whole = |breaks: &[f64]| {
                (0..breaks.len() - 1).map(|cell| Part { cell, from: 0.0, to: 1.0 }).collect()
            };
            return Emptiness { parts: breaks.map(whole), is_empty: self.empty_cells(breaks, trims) };
        }
        let parts = breaks.map(parts);
        let ends = [0, 1].map(|axis| {
            let at = |part: &Part| {
                let (begin, end) = (breaks[axis][part.cell], breaks[axis][part.cell + 1]);
                begin + part.from * (end - begin)
            };
            parts[axis].iter().map(at).chain(breaks[axis].last().copied()).collect::<Vec<f64>>()
        });
        Emptiness { is_empty: self.empty_cells([&ends[0], &ends[1]], trims), parts }
    }

    /// A fit over a grid, or one that stays nearer to the box of the data where there are none: over the same grid, or where
    /// its cells are too large for that, over a finer one.
    ///
    /// A field over a grid that was asked for is left as it is: what a field fitter makes of it on that grid.
    pub(super) fn tamed(&self, candidate: Candidate, control: &mut Control) -> Result<Candidate, FitError> {
        let is_left = self.options.fixed_grid.is_some() && !self.is_shape;
        if is_left || !is_wild(self.excursion(&candidate.surface, control.pool())) {
            return Ok(candidate);
        }
        let judge = |candidate: &Candidate, pool: &Pool| Standing {
            excursion: self.excursion(&candidate.surface, pool),
            error: candidate.errors.demand,
            between: self.interior_errors(&candidate.surface, pool).max_smooth_excess,
        };
        let smoothing = candidate.smoothing;
        let counts = candidate.counts();
        let mut same = vec![(counts, CutCells::No), (counts, CutCells::Yes)];
        let finer = FINER.map(|halvings| [0, 1].map(|axis| ((counts[axis] - 1) << halvings[axis]) + 1));
        let finer = finer.into_iter().filter(|&counts| self.allows(counts));
        let mut finer: Vec<_> = finer.map(|counts| (counts, CutCells::Yes)).collect();
        if self.options.fixed_grid.is_some() {
            finer.clear();
        }
        if self.options.method == Method::Ferguson {
            (same, finer) = (Vec::new(), Vec::new());
        }
        let refit = |&(counts, cut): &([usize; 2], CutCells), tension, control: &mut Control| {
            control.watch(|pool, watch| self.fit_tense(counts, cut, [smoothing, tension], pool, watch))?
        };
        let mut candidate =
            tamed(candidate, self.goal.tolerance, &same, (&finer, FINER_BEYOND), judge, refit, control)?;
        if self.excursion(&candidate.surface, control.pool()) > FARTHEST {
            candidate.surface = self.with_less_buffer(candidate.surface, control.pool());
            candidate.errors = self.errors(&candidate.surface, control.pool());
        }
        Ok(candidate)
    }

    /// How far a surface leaves the box of the data, as a share of its diagonal.
    pub(super) fn excursion(&self, surface: &TensorSurface, pool: &Pool) -> f64 {
        excursion(surface, &cells(surface), &Bounds::of_rows(self.values, self.dim), pool)
    }

    /// The part of a surface over the data and as much of its buffer as stays near their box; the whole where less of it
    /// does not help.
    fn with_less_buffer(&self, surface: TensorSurface, pool: &Pool) -> TensorSurface {
        let (data, whole) = (self.data_box, surface.domain());
        let parts = (1..=BUFFER_HALVINGS).map(|k| {
            let share = 0.5_f64.powi(k);
            Domain { min: data.min.lerp(whole.min, share), max: data.max.lerp(whole.max, share) }
        });
        let mut parts = parts.filter_map(|part| surface.restrict(part).ok());
        parts.find(|part| self.excursion(part, pool) <= FARTHEST).unwrap_or(surface)
    }
}

/// Cells or parts of them, and which of their products are empty, row by row.
pub(super) struct Emptiness {
    pub parts: [Vec<Part>; 2],
    pub is_empty: Vec<bool>,
}

/// Cells cut into parts of no more than a share of the whole range.
fn parts(breaks: &[f64]) -> Vec<Part> {
    /// Parts that the range has at least: holes that matter are larger.
    const PARTS: f64 = 32.0;
    /// Parts of the smallest cells.
    const LEAST_PARTS: f64 = 2.0;
    let range = breaks[breaks.len() - 1] - breaks[0];
    let parts = breaks.windows(2).enumerate().flat_map(|(cell, ends)| {
        let count = (PARTS * ((ends[1] - ends[0]) / range)).ceil().max(LEAST_PARTS);
        (0..count as usize).map(move |k| Part { cell, from: k as f64 / count, to: (k + 1) as f64 / count })
    });
    parts.collect()
}

/// The cells of a surface.
fn cells(surface: &TensorSurface) -> Vec<Domain> {
    let [u, v] = [Axis::U, Axis::V].map(|axis| surface.knots(axis).breaks());
    let rows = u.windows(2).flat_map(|u| v.windows(2).map(move |v| (u[0], u[1], v[0], v[1])));
    rows.map(|(u0, u1, v0, v1)| Domain { min: DVec2::new(u0, v0), max: DVec2::new(u1, v1) }).collect()
}
