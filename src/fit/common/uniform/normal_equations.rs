//! Least squares over a tensor product of uniform bases: assembly cell by cell, energy, solution.
//!
//! Unknown `(i, j)` meets `(i + a, j + b)` for `|a|, |b| <= 3`: a stencil of 49, of which the lower
//! triangle keeps `a = 0, b = 0..=3` and `a = 1..=3, b = -3..=3`.

use super::energy::EnergyTerm;
use super::grid::{Direction, Part, UniformBasis};
use crate::control::{Pool, Watch};
use crate::linalg::dissection::grid_order;
use crate::linalg::{Cholesky, Conditions, NotPositiveDefinite, SymbolicCholesky, impose_all};
use crate::lists::Lists;
use crate::memory::{self, CollectVec, ParallelCollectVec};
use glam::DVec2;
use rayon::prelude::*;
use sprs::CsMat;
use std::ops::Range;

/// Farthest unknown that shares a cell, in each direction.
const REACH: usize = 3;
/// Entries kept for each unknown: offsets 0 to 3 along u times offsets -3 to 3 along v.
const STENCIL: usize = 4 * 7;

/// The data of a fit: parameters, rows of values, and weights.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Samples<'a> {
    pub uv: &'a [DVec2],
    /// Rows of `dim` numbers.
    pub values: &'a [f64],
    pub dim: usize,
    /// Positive; None weighs all alike.
    pub weights: Option<&'a [f64]>,
}

/// The basis over a rectangle of cells.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TensorBasis<D = UniformBasis> {
    pub u: D,
    pub v: D,
}

impl<D: Direction> TensorBasis<D> {
    /// Number of unknowns; `(i, j)` is number `i * v.len() + j`.
    pub(crate) fn len(&self) -> usize {
        self.u.len() * self.v.len()
    }

    /// Cells along u and v.
    pub(crate) fn cells(&self) -> [usize; 2] {
        [self.u.cell_count(), self.v.cell_count()]
    }

    /// The square of the distance between a value and the spline with some unknowns, which are in columns.
    pub(crate) fn error_sq(&self, uv: DVec2, value: &[f64], unknowns: &[f64]) -> f64 {
        let ((cell_u, s), (cell_v, t)) = (self.u.locate(uv.x), self.v.locate(uv.y));
        let (u, v) = (self.u.window(cell_u, s, 0), self.v.window(cell_v, t, 0));
        let n = self.len();
        let at = |component: usize| -> f64 {
            let column = &unknowns[component * n..][..n];
            let row = |a: usize| {
                let row = &column[(u.first + a) * self.v.len() + v.first..];
                row.iter().zip(&v.weights[..self.v.width()]).map(|(x, weight)| x * weight).sum::<f64>()
            };
            (0..self.u.width()).map(|a| u.weights[a] * row(a)).sum()
        };
        value.iter().enumerate().map(|(component, x)| (x - at(component)).powi(2)).sum()
    }

    /// The unknowns that the value at a place is made of, and their weights.
    pub(crate) fn terms(&self, uv: DVec2) -> Vec<(usize, f64)> {
        let ((cell_u, s), (cell_v, t)) = (self.u.locate(uv.x), self.v.locate(uv.y));
        let (along_u, along_v) = (self.u.window(cell_u, s, 0), self.v.window(cell_v, t, 0));
        let (width_u, width_v, count_v) = (self.u.width(), self.v.width(), self.v.len());
        let pairs = (0..width_u).flat_map(|a| (0..width_v).map(move |b| (a, b)));
        let unknown = |(a, b)| (along_u.first + a) * count_v + along_v.first + b;
        pairs.map(|(a, b)| (unknown((a, b)), along_u.weights[a] * along_v.weights[b])).collect_vec()
    }

    fn cell(&self, uv: DVec2) -> usize {
        self.u.locate(uv.x).0 * self.cells()[1] + self.v.locate(uv.y).0
    }
}

/// `N^T N` and `N^T x` of some data, without energy.
#[derive(Debug, Clone)]
pub(crate) struct NormalEquations<D = UniformBasis> {
    basis: TensorBasis<D>,
    /// `STENCIL` entries for each unknown.
    matrix: Vec<f64>,
    /// Columns of unknowns, one for each component.
    right: Vec<f64>,
    dim: usize,
}

/// The data of each cell; to be called within a pool.
pub(crate) fn by_cell(basis: &TensorBasis<impl Direction>, uv: &[DVec2]) -> Lists {
    let [cells_u, cells_v] = basis.cells();
    let cells: Vec<u32> = uv.par_iter().map(|&uv| basis.cell(uv) as u32).collect_vec();
    Lists::by_key(cells_u * cells_v, &cells)
}

/// What one row of cells adds: four rows of unknowns.
struct Strip {
    matrix: Vec<f64>,
    right: Vec<f64>,
}

impl Strip {
    /// Adds it to the whole, from the unknown `first` on.
    fn add_to(&self, first: usize, matrix: &mut [f64], right: &mut [f64]) {
        let matrix = &mut matrix[first * STENCIL..][..self.matrix.len()];
        matrix.iter_mut().zip(&self.matrix).for_each(|(sum, x)| *sum += x);
        let rows = self.matrix.len() / STENCIL;
        let (dim, n) = (self.right.len() / rows, right.len() * rows / self.right.len());
        for k in 0..dim {
            let column = &mut right[k * n + first..][..rows];
            column.iter_mut().zip(&self.right[k * rows..]).for_each(|(sum, x)| *sum += x);
        }
    }
}

impl<D: Direction + Clone> NormalEquations<D> {
    /// Adds up the data. Rows of cells are independent pieces of work, added in their order.
    pub(crate) fn assemble(basis: TensorBasis<D>, samples: &Samples, pool: &Pool) -> Self {
        let [cells_u, _] = basis.cells();
        let (rows, n, dim) = (basis.v.len(), basis.len(), samples.dim);
        let (mut matrix, mut right) = (memory::filled(0.0, n * STENCIL), memory::filled(0.0, n * dim));
        pool.run(|| {
            let by_cell = by_cell(&basis, samples.uv);
            // strips of a block are kept at once: the block bounds the memory, and is fixed
            const BLOCK: usize = 16;
            for block in (0..cells_u).step_by(BLOCK) {
                let strips: Vec<Strip> = (block..cells_u.min(block + BLOCK))
                    .into_par_iter()
                    .map(|cell_u| assemble_strip(&basis, samples, &by_cell, cell_u, pool.watch()))
                    .collect_vec();
                for (cell_u, strip) in (block..).zip(strips) {
                    strip.add_to(basis.u.first(cell_u) * rows, &mut matrix, &mut right);
                }
            }
        });
        Self { basis, matrix, right, dim }
    }

    /// The tension of a membrane, `integral of |x_u|^2 + |x_v|^2`, over those products of parts of cells that are
    /// `is_tense`, row by row: for `dim` components, without data.
    pub(crate) fn tension(
        basis: TensorBasis<D>,
        dim: usize,
        parts: &[Vec<Part>; 2],
        is_tense: &[bool],
    ) -> Self {
        let (n, count_v) = (basis.len(), basis.v.len());
        let mut matrix = memory::filled(0.0, n * STENCIL);
        let across: Vec<_> = parts[1].iter().map(|part| LocalGrams::new(&basis.v, part)).collect_vec();
        for (part, is_tense) in parts[0].iter().zip(is_tense.chunks_exact(across.len())) {
            let along = LocalGrams::new(&basis.u, part);
            for (across, _) in across.iter().zip(is_tense).filter(|(_, tense)| **tense) {
                for (a, a2) in pairs().filter(|&(_, a2)| a2 < basis.u.width()) {
                    for b in 0..basis.v.width() {
                        for b2 in if a == a2 { b..basis.v.width() } else { 0..basis.v.width() } {
                            let unknown = (along.first + a) * count_v + across.first + b;
                            matrix[unknown * STENCIL + 7 * (a2 - a) + REACH + b2 - b] += along.slopes[a][a2]
                                * across.values[b][b2]
                                + along.values[a][a2] * across.slopes[b][b2];
                        }
                    }
                }
            }
        }
        Self { basis, matrix, right: memory::filled(0.0, n * dim), dim }
    }

    /// These and `weight` times others over the same basis.
    pub(crate) fn plus(&self, other: &Self, weight: f64) -> Self {
        let add = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a + weight * b).collect_vec();
        let (matrix, right) = (add(&self.matrix, &other.matrix), add(&self.right, &other.right));
        Self { matrix, right, basis: self.basis.clone(), dim: self.dim }
    }

    /// Solves under conditions; the unknowns come in columns, one for each component.
    /// `factor` is made by [`NormalEquations::factor`] of the same equations.
    pub(crate) fn solve(&self, factor: &Cholesky, conditions: &[Conditions]) -> Vec<f64> {
        let mut unknowns = memory::copied(&self.right);
        factor.solve(&mut unknowns, self.dim);
        impose_all(conditions, factor, &mut unknowns, self.basis.len());
        unknowns
    }

    /// The factor with `weight` times the energy added. `symbolic` is made by [`NormalEquations::analyse`] for the same
    /// basis.
    pub(crate) fn factor(
        &self,
        symbolic: &SymbolicCholesky,
        weight: f64,
        energy: &[EnergyTerm],
    ) -> Result<Cholesky, NotPositiveDefinite> {
        symbolic.factor(&self.with_energy(weight, energy).view())
    }

    /// The pattern, analysed; the same for all data and energies over one basis.
    pub(crate) fn analyse(&self) -> SymbolicCholesky {
        let order = grid_order(self.basis.u.len(), self.basis.v.len(), REACH);
        SymbolicCholesky::new(&self.with_energy(0.0, &[]).view(), Some(&order))
    }

    /// The lower triangle of `N^T N + weight * energy`.
    fn with_energy(&self, weight: f64, terms: &[EnergyTerm]) -> CsMat<f64> {
        let (count_u, count_v) = (self.basis.u.len(), self.basis.v.len());
        let n = count_u * count_v;
        let mut starts = memory::with_capacity(n + 1);
        let mut rows = memory::with_capacity(n * 25);
        let mut values = memory::with_capacity(n * 25);
        memory::push(&mut starts, 0);
        for i in 0..count_u {
            for j in 0..count_v {
                for a in 0..=REACH.min(count_u - 1 - i) {
                    for jj in neighbours(j, a, count_v) {
                        let bend: f64 =
                            terms.iter().map(|t| t.weight * t.u.rows[i][a] * t.v.get(j, jj)).sum();
                        let stencil = &self.matrix[(i * count_v + j) * STENCIL..];
                        memory::push(&mut rows, (i + a) * count_v + jj);
                        memory::push(&mut values, stencil[7 * a + REACH + jj - j] + weight * bend);
                    }
                }
                memory::push(&mut starts, rows.len());
            }
        }
        CsMat::new_csc((n, n), starts, rows, values)
    }
}

/// Unknowns along v that `j` meets `a` rows further on: in its own row only those behind it.
fn neighbours(j: usize, a: usize, count: usize) -> Range<usize> {
    let begin = if a == 0 { j } else { j.saturating_sub(REACH) };
    begin..(j + REACH + 1).min(count)
}

fn assemble_strip(
    basis: &TensorBasis<impl Direction>,
    samples: &Samples,
    by_cell: &Lists,
    cell_u: usize,
    watch: &Watch,
) -> Strip {
    let (width_u, width_v, rows) = (basis.u.width(), basis.v.width(), basis.v.len());
    let (cells_v, dim) = (basis.cells()[1], samples.dim);
    let mut strip = Strip {
        matrix: memory::filled(0.0, width_u * rows * STENCIL),
        right: memory::filled(0.0, width_u * rows * dim),
    };
    let mut sums = CellSums { matrix: [0.0; 160], right: memory::filled(0.0, 16 * dim) };
    // a cancelled call throws its sums away
    for cell_v in (0..cells_v).take_while(|_| watch.check().is_ok()) {
        let data = by_cell.of(cell_u * cells_v + cell_v);
        if data.is_empty() {
            continue;
        }
        sums.clear();
        data.iter().for_each(|&datum| sums.add(basis, samples, datum as usize));
        let first_v = basis.v.first(cell_v);
        for (pair, (a, a2)) in pairs().enumerate() {
            if a2 >= width_u {
                continue;
            }
            for b in 0..width_v {
                for b2 in if a == a2 { b..width_v } else { 0..width_v } {
                    let unknown = a * rows + first_v + b;
                    strip.matrix[unknown * STENCIL + 7 * (a2 - a) + REACH + b2 - b] +=
                        sums.matrix[16 * pair + 4 * b + b2];
                }
            }
        }
        for k in 0..dim {
            for a in 0..width_u {
                for b in 0..width_v {
                    strip.right[(k * width_u + a) * rows + first_v + b] += sums.right[16 * k + 4 * a + b];
                }
            }
        }
    }
    strip
}

/// Integrals over a part of a cell of the products of its window's functions and of their slopes.
struct LocalGrams {
    first: usize,
    values: [[f64; 4]; 4],
    slopes: [[f64; 4]; 4],
}

impl LocalGrams {
    fn new(direction: &impl Direction, part: &Part) -> Self {
        let gram = |order: usize| {
            let scale = direction.length(part.cell).powi(1 - 2 * order as i32);
            let mut gram = [[0.0; 4]; 4];
            for (window, weight) in direction.squares_in(part, order) {
                for a in 0..4 {
                    for b in 0..4 {
                        gram[a][b] += scale * weight * window.weights[a] * window.weights[b];
                    }
                }
            }
            gram
        };
        Self { first: direction.first(part.cell), values: gram(0), slopes: gram(1) }
    }
}

/// The ten pairs `a <= a2` of window entries along u.
fn pairs() -> impl Iterator<Item = (usize, usize)> {
    (0..4).flat_map(|a| (a..4).map(move |a2| (a, a2)))
}

/// Sums over the data of one cell: products of window weights, 16 along v for each pair along u.
struct CellSums {
    matrix: [f64; 160],
    /// 16 sums for each component.
    right: Vec<f64>,
}

impl CellSums {
    fn clear(&mut self) {
        self.matrix.fill(0.0);
        self.right.fill(0.0);
    }

    fn add(&mut self, basis: &TensorBasis<impl Direction>, samples: &Samples, datum: usize) {
        let uv = samples.uv[datum];
        let ((cell_u, s), (cell_v, t)) = (basis.u.locate(uv.x), basis.v.locate(uv.y));
        let weight = samples.weights.map_or(1.0, |weights| weights[datum]);
        let u = basis.u.window(cell_u, s, 0).weights;
        let v = basis.v.window(cell_v, t, 0).weights;
        let weighted_u = u.map(|x| weight * x);
        let mut products_v = [0.0; 16];
        for b in 0..4 {
            for b2 in 0..4 {
                products_v[4 * b + b2] = v[b] * v[b2];
            }
        }
        for ((a, a2), sums) in pairs().zip(self.matrix.chunks_exact_mut(16)) {
            let product = weighted_u[a] * u[a2];
            sums.iter_mut().zip(&products_v).for_each(|(sum, p)| *sum += product * p);
        }
        let values = &samples.values[datum * samples.dim..][..samples.dim];
        for (x, sums) in values.iter().zip(self.right.chunks_exact_mut(16)) {
            for a in 0..4 {
                let product = weighted_u[a] * x;
                for b in 0..4 {
                    sums[4 * a + b] += product * v[b];
                }
            }
        }
    }
}
