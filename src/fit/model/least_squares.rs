//! Least squares over all samples of all patches in the free unknowns of a smooth space: `closed.md` 4.
//!
//! ```text
//! minimize  sum_n w_n |S(q_n,u_n,v_n) - P_n|^2 + smoothing sum_cells plate energy of the unit cell
//! subject to the enclosure equations C y = 0
//! ```
//! The jets of a cell's corners are linear in the free unknowns, so each cell adds `L^T M L` with its sixteen Hermite
//! unknowns' matrix M and its sixteen rows L. The matrix, scaled to a unit diagonal, is factored once for three
//! components. The few enclosure equations are met by a dense Schur complement `K = C A^-1 C^T`, twice, so that what is left is
//! rounding.

use super::constraints::Projector;
use super::samples::ByCell;
use crate::control::{Pool, Watch};
use crate::fit::common::FitError;
use crate::fit::common::hermite_cell::{CellSums, weights};
use crate::linalg::{Cholesky, SymbolicCholesky};
use crate::surface::g1::Space;
use crate::surface::pht::{PhtSurface, expansions};
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
pub struct Targets {
    /// Parameters on the patch of their cell.
    pub uv: Vec<DVec2>,
    pub points: Vec<DVec3>,
    pub weights: Vec<f64>,
}

/// A cell of all patches together.
#[derive(Debug, Clone, Copy)]
pub struct CellPlace {
    pub min: DVec2,
    pub size: f64,
}

/// What a space makes of the unknowns of each cell, and the pattern of its matrix.
pub struct System<'s, 'l> {
    space: &'s Space<'l>,
    cells: Vec<CellPlace>,
    maps: Vec<CellMap>,
    /// The lower triangle by columns.
    starts: Vec<usize>,
    rows: Vec<u32>,
    symbolic: SymbolicCholesky,
}

/// The sixteen unknowns of a cell as combinations: for each free unknown the sixteen factors.
struct CellMap {
    unknowns: Vec<u32>,
    factors: Vec<[f64; CELL]>,
}

/// The factored matrix with all that a right-hand side needs.
struct Solver<'m> {
    factor: Cholesky,
    matrix: &'m CsMat<f64>,
}

impl<'s, 'l> System<'s, 'l> {
    /// Prepares the space.
    pub fn new(space: &'s Space<'l>, pool: &Pool) -> Self {
        let places = cells_of(space);
        let maps: Vec<CellMap> = pool.run(|| {
            (0..space.meshes().len()).into_par_iter().flat_map_iter(|quad| cell_maps(space, quad)).collect()
        });
        let (starts, rows) = pattern(space.free_count(), &maps);
        let ones = vec![1.0; rows.len()];
        let symbolic = SymbolicCholesky::new(&lower(&starts, &rows, ones).view(), None);
        Self { space, cells: places, maps, starts, rows, symbolic }
    }

    /// The cells of all patches, patch after patch.
    pub fn cells(&self) -> &[CellPlace] {
        &self.cells
    }

    /// The best surface: `smoothing` by cell.
    pub fn solve(
        &self,
        targets: &Targets,
        by_cell: &ByCell,
        smoothing: &[f64],
        projector: &Projector,
        pool: &Pool,
        watch: &Watch,
    ) -> Result<Vec<PhtSurface>, FitError> {
        let n = self.space.free_count();
        let mut values = vec![0.0; self.rows.len()];
        let mut right = vec![0.0; n * DIM];
        let cells: Vec<usize> = (0..self.cells.len()).collect();
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
        let scale: Vec<f64> = self.starts[..n].iter().map(|&start| 1.0 / values[start].sqrt()).collect();
        if scale.iter().any(|x| !x.is_finite()) {
            return Err(FitError::Singular);
        }
        for column in 0..n {
            for place in self.starts[column]..self.starts[column + 1] {
                values[place] *= scale[column] * scale[self.rows[place] as usize];
            }
            values[self.starts[column]] += DIAGONAL;
        }
        for rows in right.chunks_exact_mut(n) {
            rows.iter_mut().zip(&scale).for_each(|(x, d)| *x *= d);
        }
        let matrix = lower(&self.starts, &self.rows, values);
        let factor = self.symbolic.factor(&matrix.view()).map_err(|_| FitError::Singular)?;
        watch.check()?;
        let solver = Solver { factor, matrix: &matrix };
        let mut unknowns = solver.solve(&right);
        solver.enclose(self.space, &scale, &mut unknowns);
        let mut rows: Vec<f64> = (0..n)
            .flat_map(|k| (0..DIM).map(move |c| c * n + k))
            .map(|at| unknowns[at] * scale[at % n])
            .collect();
        projector.apply(self.space, &mut rows);
        // an overflow in the solution is the one thing that can be wrong
        self.space.surfaces(&rows, DIM).map_err(|_| FitError::Singular)
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
        let (matrix, map) = (sums.with_energy(smoothing, 0.0), &self.maps[cell]);
        let count = map.unknowns.len();
        let mut products = vec![[0.0; CELL]; count];
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
        Share { right: right.collect(), lower }
    }

    fn add(&self, cell: usize, share: &Share, values: &mut [f64], right: &mut [f64]) {
        let (n, unknowns) = (self.space.free_count(), &self.maps[cell].unknowns);
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

impl Solver<'_> {
    /// Solutions of right-hand sides stored one after the other, with one step of refinement, which takes back what
    /// [`DIAGONAL`] did where the data say something.
    fn solve(&self, right: &[f64]) -> Vec<f64> {
        let n = self.matrix.cols();
        let mut solutions = right.to_vec();
        self.factor.solve(&mut solutions, right.len() / n);
        let mut rest = right.to_vec();
        for (rest, solution) in rest.chunks_exact_mut(n).zip(solutions.chunks_exact(n)) {
            subtract_product(self.matrix, solution, rest);
            rest.iter_mut().zip(solution).for_each(|(rest, x)| *rest += DIAGONAL * x);
        }
        self.factor.solve(&mut rest, right.len() / n);
        solutions.iter_mut().zip(&rest).for_each(|(x, d)| *x += d);
        solutions
    }

    /// Moves the solutions, in scaled unknowns, to the nearest that keep the enclosure equations.
    fn enclose(&self, space: &Space, scale: &[f64], solutions: &mut [f64]) {
        let (n, m) = (self.matrix.cols(), space.enclosures().len());
        if m == 0 {
            return;
        }
        let mut equations = vec![0.0; m * n];
        for (row, enclosure) in equations.chunks_exact_mut(n).zip(space.enclosures()) {
            for &(number, factor) in enclosure.sum.terms() {
                row[number as usize] = factor * scale[number as usize];
            }
        }
        let mut responses = equations.clone();
        self.factor.solve(&mut responses, m);
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let complement =
            faer::Mat::from_fn(m, m, |i, j| dot(&equations[i * n..][..n], &responses[j * n..][..n]));
        let complement = complement.partial_piv_lu();
        for solution in solutions.chunks_exact_mut(n) {
            for _ in 0..2 {
                let miss = faer::Mat::from_fn(m, 1, |i, _| dot(&equations[i * n..][..n], solution));
                let shares = faer::linalg::solvers::Solve::solve(&complement, &miss);
                for (i, response) in responses.chunks_exact(n).enumerate() {
                    let share = shares[(i, 0)];
                    solution.iter_mut().zip(response).for_each(|(x, r)| *x -= share * r);
                }
            }
        }
    }
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
    cells.collect()
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
    topology.corners.iter().zip(&topology.leaves).map(map).collect()
}

/// The pattern of the lower triangle: starts of columns, and rows ascending.
fn pattern(n: usize, maps: &[CellMap]) -> (Vec<usize>, Vec<u32>) {
    let mut cells_of_unknown: Vec<Vec<u32>> = vec![Vec::new(); n];
    for (cell, map) in (0..).zip(maps) {
        map.unknowns.iter().for_each(|&unknown| cells_of_unknown[unknown as usize].push(cell));
    }
    let (mut starts, mut rows) = (vec![0], Vec::new());
    let mut seen_by = vec![u32::MAX; n];
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
    let rows = rows.iter().map(|&row| row as usize).collect();
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
