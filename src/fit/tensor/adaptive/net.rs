//! Least squares over a net of knot lines, and its measure.
//!
//! ```text
//! minimize  mean_n w_n |S(u_n,v_n) - P_n|^2 + lambda * integral of |S_uu|^2 + 2 |S_uv|^2 + |S_vv|^2
//! ```
//! over the data's box taken as the unit square, with values in a box of diagonal 1. Cells without data, in holes
//! and beyond the border, are a membrane as well, which has no reason to leave its rim:
//! ```text
//! + lambda / TENSE_WITHIN^2 * integral over them of |S_u|^2 + |S_v|^2
//! ```

use super::super::lines::Lines;
use super::super::tame::Emptiness;
use super::super::{FitError, Problem};
use crate::control::{Control, Pool, Watch};
use crate::fit::common::errors::DataErrors;
use crate::fit::common::interior::Between;
use crate::fit::common::signs::{PROBES, scramble, signs};
use crate::fit::common::tame::{CutCells, TENSE_WITHIN, is_wild};
use crate::fit::common::uniform::energy::EnergyTerm;
use crate::fit::common::uniform::grid::Direction;
use crate::fit::common::uniform::normal_equations::{NormalEquations, Samples, TensorBasis};
use crate::linalg::{Conditions, SymbolicCholesky};
use crate::memory::{self, CollectVec};
use crate::surface::tensor::TensorSurface;
use crate::surface::{Surface, Trims};
use glam::DVec2;
use rayon::prelude::*;
use std::borrow::Cow;

/// Weight of a place inside a triangle against that of a node, where triangles are larger than cells: enough to
/// keep the surface from swinging between nodes, too little to pull it off them.
const INTERIOR_WEIGHT: f64 = 0.2;

/// Triangles between whose nodes a net is measured in each step of taking lines out; in all of them it is in the end.
const SPARSE_TRIANGLES: usize = 8192;

/// One datum in this many scattered ones is withheld: fewer let a surface swing where a feature is sampled thinly.
const WITHHOLD_EVERY: u64 = 5;
/// Fewer data than this are all needed.
const LEAST_TO_WITHHOLD: usize = 512;

/// The data of a problem in the form that nets are fitted to.
pub(super) struct NetFitter<'a> {
    pub problem: &'a Problem<'a>,
    /// In the frame.
    values: Vec<f64>,
    /// Of each datum; 0 for one that is withheld.
    pub weights: Vec<f64>,
    weight_sum: f64,
    withholds: bool,
    trims: Trims,
    /// None for many scattered data: those that are withheld tell of what lies between the others.
    between: Option<&'a Between>,
    /// Of that, what is looked at while lines are taken out.
    sparse: Option<Between>,
    /// The coordinates of the data in each direction, in their order.
    sorted: [Vec<f64>; 2],
    /// Of nets where there are no data.
    pub tension: Tension,
    /// Whether nets may leave the box of the data as far as they like.
    pub may_be_wild: bool,
}

/// What is fitted: rows of `dim` numbers, one a datum.
struct Rows<'a> {
    values: &'a [f64],
    dim: usize,
    /// Whether they are the data's own values.
    are_own: bool,
}

/// The tension where there are no data.
#[derive(Clone, Copy)]
pub(super) struct Tension {
    /// As a multiple of what makes a plate a membrane within [`TENSE_WITHIN`].
    pub multiple: f64,
    /// Whether it is in parts of cells too.
    pub cut: CutCells,
}

/// A surface over a net of knot lines, measured.
#[derive(Clone)]
pub(super) struct Net {
    pub lines: [Lines; 2],
    pub surface: TensorSurface,
    pub errors: DataErrors,
    /// Errors between the data beyond what is explained, where they have been asked for.
    pub excess: Vec<f64>,
    pub smoothing: f64,
    /// What it has where there are no data.
    pub tension: Tension,
}

impl Net {
    /// Unknowns of the fit.
    pub(super) fn coefficient_count(&self) -> usize {
        coefficient_count(&self.lines)
    }

    /// The largest error at the data, and between them as far as it has been measured.
    pub(super) fn merit(&self) -> f64 {
        self.excess.iter().copied().fold(self.errors.demand, f64::max)
    }
}

/// Unknowns over knot lines.
pub(super) fn coefficient_count(lines: &[Lines; 2]) -> usize {
    lines[0].len() * lines[1].len()
}

/// The equations of one net, ready to be solved with any smoothing.
pub(super) struct NetEquations {
    lines: [Lines; 2],
    equations: NormalEquations<Lines>,
    /// Of the cells without data.
    tension: Option<NormalEquations<Lines>>,
    energy: Vec<EnergyTerm>,
    conditions: Vec<Conditions>,
    symbolic: SymbolicCholesky,
}

impl<'a> NetFitter<'a> {
    pub(super) fn new(problem: &'a Problem<'a>, watch: &Watch) -> Self {
        let count = problem.uv.len();
        let withholds = problem.mesh.is_none() && count >= LEAST_TO_WITHHOLD && !problem.has_equal_cells();
        let is_withheld = |datum: usize| withholds && scramble(datum).is_multiple_of(WITHHOLD_EVERY);
        let weight = |datum: usize| match &problem.weights {
            _ if is_withheld(datum) => 0.0,
            Some(weights) => weights[datum],
            None => 1.0,
        };
        let weights: Vec<f64> = (0..count).map(weight).collect_vec();
        let sort = |coordinate: fn(&DVec2) -> f64| {
            let mut sorted: Vec<f64> = problem.uv.iter().map(coordinate).collect_vec();
            sorted.sort_unstable_by(f64::total_cmp);
            sorted
        };
        let between = (!withholds).then(|| problem.between(watch));
        Self {
            withholds,
            values: problem.frame.inward(problem.values),
            weight_sum: weights.iter().sum(),
            weights,
            sparse: between.map(|between| between.thinned(SPARSE_TRIANGLES)),
            between,
            sorted: [sort(|uv| uv.x), sort(|uv| uv.y)],
            tension: Tension { multiple: 1.0, cut: CutCells::No },
            may_be_wild: false,
            trims: problem.trims(),
            problem,
        }
    }

    /// Lets the withheld data count.
    pub(super) fn use_all_data(&mut self) {
        self.withholds = false;
        let given = self.problem.weights.clone();
        self.weights = given.unwrap_or_else(|| memory::filled(1.0, self.problem.uv.len()));
        self.weight_sum = self.weights.iter().sum();
    }

    /// Whether data are withheld.
    pub(super) fn withholds(&self) -> bool {
        self.withholds
    }

    /// Data with a coordinate in the half-open interval.
    pub(super) fn count_between(&self, axis: usize, from: f64, to: f64) -> usize {
        let below = |x: f64| self.sorted[axis].partition_point(|&y| y < x);
        below(to) - below(from)
    }

    /// Adds the data up over some knot lines, with factors on their weights if there are any.
    pub(super) fn assemble(
        &self,
        lines: [Lines; 2],
        factors: Option<&[f64]>,
        control: &mut Control,
    ) -> Result<NetEquations, FitError> {
        let weights = match factors {
            None => Cow::Borrowed(&self.weights),
            Some(factors) => Cow::Owned(self.weights.iter().zip(factors).map(|(w, f)| w * f).collect_vec()),
        };
        let own = Rows { values: &self.values, dim: self.problem.dim, are_own: true };
        control.watch(|pool, watch| self.assemble_rows(lines, &own, &weights, pool, watch))?
    }

    /// The same with columns of signs in place of the values.
    pub(super) fn assemble_probes(
        &self,
        lines: [Lines; 2],
        control: &mut Control,
    ) -> Result<NetEquations, FitError> {
        let signs = Rows { values: &signs(self.problem.uv.len()), dim: PROBES, are_own: false };
        control.watch(|pool, watch| self.assemble_rows(lines, &signs, &self.weights, pool, watch))?
    }

    /// How many data a fit follows: the trace of the matrix that makes its values of theirs.
    pub(super) fn trace(
        &self,
        probes: &NetEquations,
        smoothing: f64,
        control: &mut Control,
    ) -> Result<f64, FitError> {
        let signs = signs(self.problem.uv.len());
        control.watch(|pool, watch| {
            let surface = self.surface(probes, PROBES, smoothing, watch)?;
            let mut rows = memory::filled(0.0, signs.len());
            evaluate_rows(&surface, &self.problem.uv, &mut rows, pool);
            Ok(rows.iter().zip(&signs).map(|(x, sign)| x * sign).sum::<f64>() / PROBES as f64)
        })?
    }

    fn assemble_rows(
        &self,
        lines: [Lines; 2],
        rows: &Rows,
        weights: &[f64],
        pool: &Pool,
        watch: &Watch,
    ) -> Result<NetEquations, FitError> {
        let problem = self.problem;
        let dim = rows.dim;
        let [u, v] = lines.clone();
        let basis = TensorBasis { u, v };
        let samples = Samples { uv: &problem.uv, values: rows.values, dim, weights: Some(weights) };
        watch.check()?;
        let nodes = NormalEquations::assemble(basis.clone(), &samples, pool);
        watch.check()?;
        let place = |axis: usize, u: f64| {
            let (cell, s) = lines[axis].locate(u);
            cell as f64 + s
        };
        let in_cells = |uv: DVec2| DVec2::new(place(0, uv.x), place(1, uv.y));
        let mut data = problem.interior_data(in_cells, &self.values);
        if !rows.are_own {
            data.values = memory::filled(0.0, dim * data.uv.len());
        }
        let equations = if data.uv.is_empty() {
            nodes
        } else {
            let inner = Samples { uv: &data.uv, values: &data.values, dim, weights: Some(&data.weights) };
            nodes.plus(&NormalEquations::assemble(basis.clone(), &inner, pool), INTERIOR_WEIGHT)
        };
        watch.check()?;
        let breaks = [lines[0].breaks(), lines[1].breaks()];
        let Emptiness { parts, is_empty } = problem.emptiness(breaks, self.tension.cut, &self.trims);
        let tension =
            is_empty.contains(&true).then(|| NormalEquations::tension(basis.clone(), dim, &parts, &is_empty));
        let conditions = match rows.are_own {
            true => problem.conditions(&basis, (rows.values, dim)),
            false => Vec::new(),
        };
        watch.check()?;
        let symbolic = equations.analyse();
        let energy = plate(&lines);
        Ok(NetEquations { lines, equations, tension, energy, conditions, symbolic })
    }

    /// Solves and measures at the data.
    pub(super) fn solve(
        &self,
        net: &NetEquations,
        smoothing: f64,
        control: &mut Control,
    ) -> Result<Net, FitError> {
        control.watch(|pool, watch| self.solve_in(net, smoothing, pool, watch))?
    }

    fn solve_in(
        &self,
        net: &NetEquations,
        smoothing: f64,
        pool: &Pool,
        watch: &Watch,
    ) -> Result<Net, FitError> {
        let problem = self.problem;
        let mut surface = self.surface(net, problem.dim, smoothing, watch)?;
        let mut points = surface.control_points().to_vec();
        problem.frame.outward(&mut points);
        // an overflow is the one thing that can be wrong
        surface.set_control_points(&points).map_err(|_| FitError::Singular)?;
        watch.check()?;
        Ok(Net {
            errors: problem.errors(&surface, pool),
            lines: net.lines.clone(),
            surface,
            excess: Vec::new(),
            smoothing,
            tension: self.tension,
        })
    }

    /// The solution as a surface, in the frame.
    fn surface(
        &self,
        net: &NetEquations,
        dim: usize,
        smoothing: f64,
        watch: &Watch,
    ) -> Result<TensorSurface, FitError> {
        watch.check()?;
        let weight = smoothing * self.weight_sum;
        let tension_weight = self.tension.multiple * weight / TENSE_WITHIN.powi(2);
        let equations = match &net.tension {
            None => Cow::Borrowed(&net.equations),
            Some(tension) => Cow::Owned(net.equations.plus(tension, tension_weight)),
        };
        watch.check()?;
        let factor = equations.factor(&net.symbolic, weight, &net.energy);
        watch.check()?;
        let unknowns = equations.solve(&factor.map_err(|_| FitError::Singular)?, &net.conditions);
        watch.check()?;
        let n = coefficient_count(&net.lines);
        let points: Vec<f64> = (0..n)
            .flat_map(|i| (0..dim).map(move |k| (i, k)))
            .map(|(i, k)| unknowns[k * n + i])
            .collect_vec();
        let [u, v] = [0, 1].map(|axis| net.lines[axis].knots().clone());
        TensorSurface::new(dim, u, v, points, None).map_err(|_| FitError::Singular)
    }

    /// The fit over some knot lines with one smoothing.
    pub(super) fn fit(
        &self,
        lines: [Lines; 2],
        smoothing: f64,
        control: &mut Control,
    ) -> Result<Net, FitError> {
        self.solve(&self.assemble(lines, None, control)?, smoothing, control)
    }

    /// The tolerance, less a little: the finished surface is measured once more, with other roundings.
    pub(super) fn bound(&self) -> f64 {
        (1.0 - 1e-9) * self.problem.goal.tolerance
    }

    /// Whether a net is within the tolerance at the data and, beyond what the facets explain, between them.
    /// Between them it is measured only if it is good at them.
    pub(super) fn meets(&self, net: &mut Net, pool: &Pool) -> bool {
        if net.errors.demand > self.bound() {
            return false;
        }
        self.measure_between(net, pool);
        net.merit() <= self.bound()
    }

    /// Whether a net leaves the box of the data too far.
    pub(super) fn is_wild(&self, net: &Net, pool: &Pool) -> bool {
        !self.may_be_wild && is_wild(self.problem.excursion(&net.surface, pool))
    }

    /// The same as far as a part of what is between the data tells.
    pub(super) fn seems_to_meet(&self, net: &Net, pool: &Pool) -> bool {
        let tolerance = self.bound();
        let between = || self.sparse.as_ref().map(|between| between.excess(&net.surface, pool));
        net.errors.demand <= tolerance
            && between().is_none_or(|excess| excess.iter().all(|&e| e <= tolerance))
            && !self.is_wild(net, pool)
    }

    /// Measures between the data.
    pub(super) fn measure_between(&self, net: &mut Net, pool: &Pool) {
        if let (Some(between), true) = (self.between, net.excess.is_empty()) {
            net.excess = between.excess(&net.surface, pool);
        }
    }

    /// Places between the data, in the order of [`Net::excess`].
    pub(super) fn places_between(&self) -> &[DVec2] {
        self.between.map_or(&[], |between| &between.uv)
    }
}

/// The values of a surface at the data.
fn evaluate_rows(surface: &TensorSurface, uv: &[DVec2], rows: &mut [f64], pool: &Pool) {
    /// Data evaluated in one piece of work.
    const CHUNK: usize = 1024;
    let dim = surface.dim();
    pool.run(|| {
        let pieces = rows.par_chunks_mut(CHUNK * dim).zip(uv.par_chunks(CHUNK));
        pieces.for_each(|(rows, uv)| surface.eval_rows(uv, 0, rows));
    });
}

/// The energy of a thin plate over the unit square.
fn plate([u, v]: &[Lines; 2]) -> Vec<EnergyTerm> {
    [(1.0, 2, 0), (2.0, 1, 1), (1.0, 0, 2)]
        .map(|(weight, p, q)| EnergyTerm { weight, u: u.gram(p), v: v.gram(q) })
        .into()
}
