//! Least squares over all samples of all patches in the free unknowns of a smooth space.
//!
//! ```text
//! minimize  sum_n w_n |S(q_n,u_n,v_n) - P_n|^2 + smoothing sum_cells plate energy of the unit cell
//! subject to the enclosure equations C y = 0
//! ```
//! The jets of a cell's corners are linear in the free unknowns, so each cell adds `L^T M L` with its sixteen Hermite
//! unknowns' matrix M and its sixteen rows L. The matrix, scaled to a unit diagonal, is factored once for three
//! components. The few enclosure equations are met by a dense Schur complement `K = C A^-1 C^T`, twice, so that what is left is
//! rounding.

use super::samples::{ByCell, CellPlace};
use crate::control::{Pool, Watch};
use crate::fit::common::FitError;
use crate::fit::common::hermite_cell::{CellSums, Membrane, weights};
use crate::layout::Place;
use crate::linalg::{Cholesky, SymbolicCholesky};
use crate::memory::{self, CollectVec};
use crate::surface::g1::{Enclosure, Space};
use crate::surface::pht::expansions;
use crate::tmesh::NodeId;
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use sprs::CsMat;

/// Unknowns of a cell.
const CELL: usize = 16;

/// Components of a point.
const DIM: usize = 3;

/// What is added to the unit diagonal, so that a direction without data and energy stays where it is: far below any
/// data, far above rounding.
const DIAGONAL: f64 = 1e-13;

/// Cells summed in one piece of work.
const PIECE: usize = 32;

/// Pieces between two looks at whether to go on.
const PIECES: usize = 16;

/// Samples in any order: where they lie, what they should be, how much they count.
#[derive(Debug, Clone, Default)]
pub(super) struct Targets {
    /// Parameters on the patch of their cell.
    pub uv: Vec<DVec2>,
    pub points: Vec<DVec3>,
    pub weights: Vec<f64>,
}

/// What a space makes of the unknowns of each cell, and the pattern of its matrix.
#[derive(Debug)]
pub(super) struct System {
    free_count: usize,
    enclosures: Vec<Enclosure>,
    cells: Vec<CellPlace>,
    maps: Vec<CellMap>,
    /// The lower triangle by columns.
    starts: Vec<usize>,
    rows: Vec<u32>,
    symbolic: SymbolicCholesky,
}

/// The sixteen unknowns of a cell as combinations: for each free unknown the sixteen factors.
#[derive(Debug)]
struct CellMap {
    unknowns: Vec<u32>,
    factors: Vec<[f64; CELL]>,
}

/// The factored matrix with all that a right-hand side needs.
#[derive(Debug)]
pub(super) struct Solver {
    factor: Cholesky,
    matrix: CsMat<f64>,
    /// What makes the diagonal one.
    scale: Vec<f64>,
    enclosing: Option<Enclosing>,
}

/// The enclosure equations in scaled unknowns.
#[derive(Debug)]
struct Enclosing {
    /// `C`, row after row.
    equations: Vec<f64>,
    /// `A^-1 C^T`, column after column.
    responses: Vec<f64>,
    /// `C A^-1 C^T`, factored.
    complement: faer::linalg::solvers::PartialPivLu<f64>,
}

/// The normal equations: the lower triangle by columns, and columns of right sides.
struct Sums {
    values: Vec<f64>,
    right: Vec<f64>,
}

impl System {
    /// Prepares the space.
    pub(super) fn new(space: &Space, pool: &Pool) -> Self {
        let places = cells_of(space);
        let maps: Vec<CellMap> = pool.run(|| {
            (0..space.meshes().len()).into_par_iter().flat_map_iter(|quad| cell_maps(space, quad)).collect()
        });
        let (starts, rows) = pattern(space.free_count(), &maps);
        let ones = memory::filled(1.0, rows.len());
        let symbolic = SymbolicCholesky::new(&lower(&starts, &rows, ones).view(), None);
        let (free_count, enclosures) = (space.free_count(), space.enclosures().to_vec());
        Self { free_count, enclosures, cells: places, maps, starts, rows, symbolic }
    }

    /// The cells of all patches, patch after patch.
    pub(super) fn cells(&self) -> &[CellPlace] {
        &self.cells
    }

    /// The free unknowns of the best surface, a row of three numbers each; `smoothing` by cell.
    pub(super) fn solve(
        &self,
        targets: &Targets,
        by_cell: &ByCell,
        smoothing: &[f64],
        pool: &Pool,
        watch: &Watch,
    ) -> Result<Vec<f64>, FitError> {
        let Sums { values, right } = self.sums(targets, by_cell, smoothing, pool, watch)?;
        let solver = self.solver(values)?;
        watch.check()?;
        let (n, columns) = (self.free_count, solver.solve(right));
        Ok((0..n).flat_map(|k| (0..DIM).map(move |c| c * n + k)).map(|at| columns[at]).collect_vec())
    }

    /// The left side for samples of these places and weights, factored; their points are not looked at.
    pub(super) fn factor(
        &self,
        targets: &Targets,
        by_cell: &ByCell,
        smoothing: f64,
        pool: &Pool,
        watch: &Watch,
    ) -> Result<Solver, FitError> {
        let energy = memory::filled(smoothing, self.cells.len());
        self.solver(self.sums(targets, by_cell, &energy, pool, watch)?.values)
    }

    /// The right side of weighted rows of `dim` numbers at places: columns.
    pub(super) fn gather(
        &self,
        places: &[Place],
        by_cell: &ByCell,
        rows: &[f64],
        dim: usize,
        pool: &Pool,
    ) -> Vec<f64> {
        let of_cell = |cell: usize| {
            let mut sums = memory::filled(0.0, CELL * dim);
            for &sample in by_cell.of(cell) {
                let row = &rows[sample as usize * dim..][..dim];
                for (sum, n) in sums.chunks_exact_mut(dim).zip(self.weights(cell, places[sample as usize])) {
                    sum.iter_mut().zip(row).for_each(|(sum, x)| *sum += n * x);
                }
            }
            let mut shares = memory::filled(0.0, self.maps[cell].unknowns.len() * dim);
            for (share, factors) in shares.chunks_exact_mut(dim).zip(&self.maps[cell].factors) {
                for (sum, &factor) in
                    sums.chunks_exact(dim).zip(factors).filter(|(_, factor)| **factor != 0.0)
                {
                    share.iter_mut().zip(sum).for_each(|(share, x)| *share += factor * x);
                }
            }
            shares
        };
        let shares: Vec<Vec<f64>> = self.for_cells(pool, of_cell);
        let mut columns = memory::filled(0.0, dim * self.free_count);
        for (map, shares) in self.maps.iter().zip(&shares) {
            for (&unknown, share) in map.unknowns.iter().zip(shares.chunks_exact(dim)) {
                (0..dim).for_each(|c| columns[c * self.free_count + unknown as usize] += share[c]);
            }
        }
        columns
    }

    /// What columns of free unknowns are at places: rows. The transpose of [`System::gather`].
    pub(super) fn read(
        &self,
        places: &[Place],
        by_cell: &ByCell,
        columns: &[f64],
        dim: usize,
        pool: &Pool,
    ) -> Vec<f64> {
        let of_cell = |cell: usize| {
            let mut corners = memory::filled(0.0, CELL * dim);
            let map = &self.maps[cell];
            for (&unknown, factors) in map.unknowns.iter().zip(&map.factors) {
                for (corner, &factor) in
                    corners.chunks_exact_mut(dim).zip(factors).filter(|(_, f)| **f != 0.0)
                {
                    let column = |c: usize| columns[c * self.free_count + unknown as usize];
                    corner.iter_mut().enumerate().for_each(|(c, sum)| *sum += factor * column(c));
                }
            }
            let mut rows = memory::filled(0.0, by_cell.of(cell).len() * dim);
            for (row, &sample) in rows.chunks_exact_mut(dim).zip(by_cell.of(cell)) {
                for (corner, n) in corners.chunks_exact(dim).zip(self.weights(cell, places[sample as usize]))
                {
                    row.iter_mut().zip(corner).for_each(|(sum, x)| *sum += n * x);
                }
            }
            rows
        };
        let of_cells: Vec<Vec<f64>> = self.for_cells(pool, of_cell);
        let mut rows = memory::filled(0.0, dim * places.len());
        for (cell, of_cell) in of_cells.iter().enumerate() {
            for (&sample, row) in by_cell.of(cell).iter().zip(of_cell.chunks_exact(dim)) {
                rows[sample as usize * dim..][..dim].copy_from_slice(row);
            }
        }
        rows
    }

    fn for_cells<R: Send>(&self, pool: &Pool, of_cell: impl Fn(usize) -> R + Sync + Send) -> Vec<R> {
        pool.run(|| (0..self.cells.len()).into_par_iter().with_min_len(PIECE).map(of_cell).collect())
    }

    /// What a place weighs the sixteen unknowns of its cell.
    fn weights(&self, cell: usize, place: Place) -> [f64; CELL] {
        let at = (place.uv - self.cells[cell].min) / self.cells[cell].size;
        weights(at.x, at.y)
    }

    fn sums(
        &self,
        targets: &Targets,
        by_cell: &ByCell,
        smoothing: &[f64],
        pool: &Pool,
        watch: &Watch,
    ) -> Result<Sums, FitError> {
        let mut values = memory::filled(0.0, self.rows.len());
        let mut right = memory::filled(0.0, self.free_count * DIM);
        let cells: Vec<usize> = (0..self.cells.len()).collect_vec();
        for batch in cells.chunks(PIECE * PIECES) {
            watch.check()?;
            let share = |&cell: &usize| self.share(cell, targets, by_cell.of(cell), smoothing[cell]);
            let shares: Vec<Share> = pool.run(|| {
                let pieces = batch.par_chunks(PIECE);
                pieces.flat_map_iter(|piece| piece.iter().map(share).collect::<Vec<_>>()).collect()
            });
            for (&cell, share) in batch.iter().zip(&shares) {
                self.add(cell, share, &mut values, &mut right);
            }
        }
        watch.check()?;
        Ok(Sums { values, right })
    }

    /// Factors the matrix with these values.
    fn solver(&self, mut values: Vec<f64>) -> Result<Solver, FitError> {
        let n = self.free_count;
        let scale: Vec<f64> = self.starts[..n].iter().map(|&start| 1.0 / values[start].sqrt()).collect_vec();
        if scale.iter().any(|x| !x.is_finite()) {
            return Err(FitError::Singular);
        }
        for column in 0..n {
            for place in self.starts[column]..self.starts[column + 1] {
                values[place] *= scale[column] * scale[self.rows[place] as usize];
            }
            values[self.starts[column]] += DIAGONAL;
        }
        let matrix = lower(&self.starts, &self.rows, values);
        let factor = self.symbolic.factor(&matrix.view()).map_err(|_| FitError::Singular)?;
        let enclosing = Enclosing::new(&self.enclosures, &scale, &factor);
        Ok(Solver { factor, matrix, scale, enclosing })
    }

    /// The sums of one cell in its free unknowns.
    fn share(&self, cell: usize, targets: &Targets, samples: &[u32], smoothing: f64) -> Share {
        let place = self.cells[cell];
        let mut sums = CellSums::new(DIM);
        pulp::Arch::new().dispatch(
            #[inline(always)]
            || {
                for &sample in samples {
                    let sample = sample as usize;
                    let at = (targets.uv[sample] - place.min) / place.size;
                    sums.add(
                        &weights(at.x, at.y),
                        &targets.points[sample].to_array(),
                        targets.weights[sample],
                    );
                }
            },
        );
        let (matrix, map) = (sums.with_energy(smoothing, Membrane::default()), &self.maps[cell]);
        let count = map.unknowns.len();
        let mut products = memory::filled([0.0; CELL], count);
        for (product, factors) in products.iter_mut().zip(&map.factors) {
            for (row, &factor) in matrix.iter().zip(factors) {
                if factor != 0.0 {
                    product.iter_mut().zip(row).for_each(|(sum, x)| *sum += factor * x);
                }
            }
        }
        let mut lower = Vec::with_capacity(count * (count + 1) / 2);
        for (column, product) in products.iter().enumerate() {
            for factors in &map.factors[column..] {
                lower.push(factors.iter().zip(product).map(|(a, b)| a * b).sum());
            }
        }
        let right = map.factors.iter().map(|factors| {
            let mut sum = [0.0; DIM];
            for (row, factor) in sums.right.chunks_exact(DIM).zip(factors) {
                sum.iter_mut().zip(row).for_each(|(sum, x)| *sum += factor * x);
            }
            sum
        });
        Share { right: right.collect_vec(), lower }
    }

    fn add(&self, cell: usize, share: &Share, values: &mut [f64], right: &mut [f64]) {
        let (n, unknowns) = (self.free_count, &self.maps[cell].unknowns);
        let mut lower = share.lower.iter();
        for (k, &column) in unknowns.iter().enumerate() {
            let range = self.starts[column as usize]..self.starts[column as usize + 1];
            let (mut place, rows) = (0, &self.rows[range.clone()]);
            for &row in &unknowns[k..] {
                place += rows[place..].partition_point(|&other| other < row);
                values[range.start + place] += lower.next().expect("one for each pair");
            }
            (0..DIM).for_each(|c| right[c * n + column as usize] += share.right[k][c]);
        }
    }
}

/// What one cell adds: the lower triangle over its unknowns by columns, and their right sides.
struct Share {
    lower: Vec<f64>,
    right: Vec<[f64; DIM]>,
}

impl Solver {
    /// The free unknowns for columns of right sides: columns.
    pub(super) fn solve(&self, mut right: Vec<f64>) -> Vec<f64> {
        let n = self.matrix.cols();
        for column in right.chunks_exact_mut(n) {
            column.iter_mut().zip(&self.scale).for_each(|(x, d)| *x *= d);
        }
        let mut unknowns = self.solve_scaled(&right);
        for column in unknowns.chunks_exact_mut(n) {
            self.enclosing.iter().for_each(|enclosing| enclosing.keep(column));
            column.iter_mut().zip(&self.scale).for_each(|(x, d)| *x *= d);
        }
        unknowns
    }

    /// Solutions of right-hand sides stored one after the other, with one step of refinement, which takes back what
    /// [`DIAGONAL`] did where the data say something.
    fn solve_scaled(&self, right: &[f64]) -> Vec<f64> {
        let n = self.matrix.cols();
        let mut solutions = right.to_vec();
        self.factor.solve(&mut solutions, right.len() / n);
        let mut rest = right.to_vec();
        for (rest, solution) in rest.chunks_exact_mut(n).zip(solutions.chunks_exact(n)) {
            subtract_product(&self.matrix, solution, rest);
            rest.iter_mut().zip(solution).for_each(|(rest, x)| *rest += DIAGONAL * x);
        }
        self.factor.solve(&mut rest, right.len() / n);
        solutions.iter_mut().zip(&rest).for_each(|(x, d)| *x += d);
        solutions
    }
}

impl Enclosing {
    fn new(enclosures: &[Enclosure], scale: &[f64], factor: &Cholesky) -> Option<Self> {
        let (n, m) = (scale.len(), enclosures.len());
        if m == 0 {
            return None;
        }
        let mut equations = memory::filled(0.0, m * n);
        for (row, enclosure) in equations.chunks_exact_mut(n).zip(enclosures) {
            for &(number, factor) in enclosure.sum.terms() {
                row[number as usize] = factor * scale[number as usize];
            }
        }
        let mut responses = equations.clone();
        factor.solve(&mut responses, m);
        let complement =
            faer::Mat::from_fn(m, m, |i, j| dot(&equations[i * n..][..n], &responses[j * n..][..n]));
        let complement = complement.partial_piv_lu();
        Some(Self { equations, responses, complement })
    }

    /// Moves a solution to the nearest that keeps the equations.
    fn keep(&self, solution: &mut [f64]) {
        let n = solution.len();
        let m = self.equations.len() / n;
        for _ in 0..2 {
            let miss = faer::Mat::from_fn(m, 1, |i, _| dot(&self.equations[i * n..][..n], solution));
            let shares = faer::linalg::solvers::Solve::solve(&self.complement, &miss);
            for (i, response) in self.responses.chunks_exact(n).enumerate() {
                let share = shares[(i, 0)];
                solution.iter_mut().zip(response).for_each(|(x, r)| *x -= share * r);
            }
        }
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The cells of all patches, patch after patch, in the order of their leaves.
fn cells_of(space: &Space) -> Vec<CellPlace> {
    let patches = space.meshes().iter().zip(space.topologies());
    let cells = patches.flat_map(|(mesh, topology)| {
        topology.leaves.iter().map(|&leaf| {
            let domain = mesh.cell_domain(mesh.cell(leaf));
            CellPlace { min: domain.min, size: domain.size().x }
        })
    });
    cells.collect_vec()
}

/// The maps of the cells of one patch.
fn cell_maps(space: &Space, quad: usize) -> Vec<CellMap> {
    let (mesh, topology) = (&space.meshes()[quad], &space.topologies()[quad]);
    let expansions = expansions(topology, mesh);
    let map = |(corners, &leaf): (&[u32; 4], &NodeId)| {
        let size = mesh.cell_domain(mesh.cell(leaf)).size();
        let units = [1.0, size.x, size.y, size.x * size.y];
        let mut entries: Vec<(u32, usize, f64)> = Vec::new();
        for (corner, &vertex) in corners.iter().enumerate() {
            for (rank, matrix) in &expansions[vertex as usize] {
                for (source, combination) in space.jet_rows(quad, *rank).iter().enumerate() {
                    for row in 0..4 {
                        let factor = units[row] * matrix[row][source];
                        if factor != 0.0 {
                            let terms = combination.terms().iter();
                            entries.extend(terms.map(|&(number, x)| (number, 4 * corner + row, factor * x)));
                        }
                    }
                }
            }
        }
        // stable: what comes together is added in the same order
        entries.sort_by_key(|&(number, row, _)| (number, row));
        let mut cell = CellMap { unknowns: Vec::new(), factors: Vec::new() };
        for (number, row, x) in entries {
            if cell.unknowns.last() != Some(&number) {
                cell.unknowns.push(number);
                cell.factors.push([0.0; CELL]);
            }
            let last = cell.factors.len() - 1;
            cell.factors[last][row] += x;
        }
        cell
    };
    topology.corners.iter().zip(&topology.leaves).map(map).collect_vec()
}

/// The pattern of the lower triangle: starts of columns, and rows ascending.
fn pattern(n: usize, maps: &[CellMap]) -> (Vec<usize>, Vec<u32>) {
    let mut cells_of_unknown: Vec<Vec<u32>> = memory::filled(Vec::new(), n);
    for (cell, map) in (0..).zip(maps) {
        map.unknowns.iter().for_each(|&unknown| cells_of_unknown[unknown as usize].push(cell));
    }
    let (mut starts, mut rows) = (vec![0], Vec::new());
    let mut seen_by = memory::filled(u32::MAX, n);
    for (column, cells) in (0..).zip(&cells_of_unknown) {
        let first = rows.len();
        // the diagonal first, also of an unknown without cells
        rows.push(column);
        seen_by[column as usize] = column;
        for &cell in cells {
            let unknowns = &maps[cell as usize].unknowns;
            for &row in &unknowns[unknowns.partition_point(|&row| row <= column)..] {
                if std::mem::replace(&mut seen_by[row as usize], column) != column {
                    rows.push(row);
                }
            }
        }
        rows[first..].sort_unstable();
        starts.push(rows.len());
    }
    (starts, rows)
}

fn lower(starts: &[usize], rows: &[u32], values: Vec<f64>) -> CsMat<f64> {
    let n = starts.len() - 1;
    let rows = rows.iter().map(|&row| row as usize).collect_vec();
    CsMat::new_csc((n, n), starts.to_vec(), rows, values)
}

/// `rest -= A x` of a symmetric matrix given by its lower triangle.
fn subtract_product(lower: &CsMat<f64>, x: &[f64], rest: &mut [f64]) {
    for (column, entries) in lower.outer_iterator().enumerate() {
        let mut sum = 0.0;
        for (row, &value) in entries.iter() {
            sum += value * x[row];
            if row != column {
                rest[row] -= value * x[column];
            }
        }
        rest[column] -= sum;
    }
}
