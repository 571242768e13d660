//! Least squares over all samples in the control points of truncated hierarchical B-splines ([`TruncatedBasis`]).
//!
//! The sums of a cell are those of its sixteen Hermite unknowns, as for splines with one continuous derivative; each
//! function on the cell is a column `h` of such unknowns, and what the cell adds to the matrix is `h_a^T M h_b`.

use super::data::Data;
use super::sums::{ByLeaf, Energy, KnownSums};
use crate::control::{Pool, Watch};
use crate::fit::common::FitError;
use crate::fit::common::hermite_cell::{COUNT, CellSums, weights};
use crate::linalg::{SymbolicCholesky, impose_all};
use crate::lists::Lists;
use crate::surface::pht::{LeafFunctions, PhtSurface, TruncatedBasis};
use crate::tmesh::{Cell, TMesh, Topology};
use glam::DVec2;
use sprs::CsMat;

/// The matrix of one mesh: what stays when samples move.
pub(super) struct SmoothSystem<'a> {
    mesh: &'a TMesh,
    topology: &'a Topology,
    basis: TruncatedBasis,
    /// The rows of the lower triangle by columns.
    rows: Lists,
    symbolic: SymbolicCholesky,
}

/// What one leaf adds, in the order of its functions: the lower triangle by columns, and rows of the right side.
struct Share {
    lower: Vec<f64>,
    right: Vec<f64>,
}

impl<'a> SmoothSystem<'a> {
    pub(super) fn new(mesh: &'a TMesh, topology: &'a Topology) -> Self {
        let basis = TruncatedBasis::new(mesh);
        let rows = pattern(&basis);
        let zeros = vec![0.0; rows.items().len()];
        let symbolic = SymbolicCholesky::new(&lower_triangle(&rows, zeros).view(), None);
        Self { mesh, topology, basis, rows, symbolic }
    }

    /// The surface that is nearest to the data.
    pub(super) fn solve(
        &self,
        data: &Data,
        by_leaf: &ByLeaf,
        known: &mut KnownSums,
        energy: &Energy,
        pool: &Pool,
        watch: &Watch,
    ) -> Result<PhtSurface, FitError> {
        let (dim, n) = (data.dim, self.basis.count());
        let mut values = vec![0.0; self.rows.items().len()];
        let mut right = vec![0.0; n * dim];
        by_leaf.add_shares(
            (self.mesh, self.topology),
            data,
            known,
            (pool, watch),
            |leaf, sums| self.share(leaf, sums, energy, dim),
            |leaf, share| self.add(&self.basis.leaves()[leaf].ranks, &share, (&mut values, &mut right), dim),
        )?;
        let matrix = lower_triangle(&self.rows, values);
        let factor = self.symbolic.factor(&matrix.view()).map_err(|_| FitError::Singular)?;
        factor.solve(&mut right, dim);
        let samples = (&data.sample_values[..], dim);
        let conditions = data.standards.conditions(&data.uv, samples, |uv| self.terms(uv));
        impose_all(&conditions, &factor, &mut right, n);
        watch.check()?;
        let mut points: Vec<f64> = (0..n * dim).map(|at| right[at % dim * n + at / dim]).collect();
        points.chunks_exact_mut(dim).for_each(|point| data.frame.outward(point));
        // an overflow in the solution is the one thing that can be wrong
        PhtSurface::of_truncated(dim, self.mesh.clone(), &self.basis, points).map_err(|_| FitError::Singular)
    }

    fn cell(&self, leaf: usize) -> Cell {
        self.mesh.cell(self.topology.leaves[leaf])
    }

    /// The unknowns that the value at a place is made of, and their weights.
    fn terms(&self, uv: DVec2) -> Vec<(usize, f64)> {
        let leaf = self.topology.leaf_of(self.mesh.locate(uv));
        let domain = self.mesh.cell_domain(self.cell(leaf));
        let at = (uv - domain.min) / domain.size();
        let weights = weights(at.x, at.y);
        let LeafFunctions { ranks, hermite, .. } = &self.basis.leaves()[leaf];
        let weight = |column: &[f64; COUNT]| column.iter().zip(weights).map(|(h, w)| h * w).sum();
        ranks.iter().zip(hermite).map(|(&rank, column)| (rank as usize, weight(column))).collect()
    }

    fn share(&self, leaf: usize, sums: &CellSums, energy: &Energy, dim: usize) -> Share {
        let matrix = sums.with_energy(energy.plate(self.cell(leaf).level), energy.membrane(leaf));
        let columns = &self.basis.leaves()[leaf].hermite;
        let mut lower = Vec::with_capacity(columns.len() * (columns.len() + 1) / 2);
        let mut right = vec![0.0; columns.len() * dim];
        for (b, column) in columns.iter().enumerate() {
            let mut product = [0.0; COUNT];
            for (row, weight) in matrix.iter().zip(column).filter(|(_, weight)| **weight != 0.0) {
                product.iter_mut().zip(row).for_each(|(sum, x)| *sum += weight * x);
            }
            let dot = |column: &[f64; COUNT]| column.iter().zip(&product).map(|(h, x)| h * x).sum::<f64>();
            lower.extend(columns[b..].iter().map(dot));
            for (weight, row) in column.iter().zip(sums.right.chunks_exact(dim)) {
                right[b * dim..][..dim].iter_mut().zip(row).for_each(|(sum, x)| *sum += weight * x);
            }
        }
        Share { lower, right }
    }

    fn add(&self, ranks: &[u32], share: &Share, (values, right): (&mut [f64], &mut [f64]), dim: usize) {
        let n = self.basis.count();
        let mut entries = share.lower.iter();
        for (b, &column) in ranks.iter().enumerate() {
            for k in 0..dim {
                right[k * n + column as usize] += share.right[b * dim + k];
            }
            // both ascend, so a row is found beyond the one before it
            let mut places = self.rows.range(column as usize).zip(self.rows.of(column as usize));
            for row in &ranks[b..] {
                let place = places.by_ref().find(|(_, other)| *other == row);
                if let (Some((place, _)), Some(entry)) = (place, entries.next()) {
                    values[place] += entry;
                }
            }
        }
    }
}

/// The rows of the lower triangle by columns: functions that meet on some leaf.
fn pattern(basis: &TruncatedBasis) -> Lists {
    let leaves = basis.leaves().iter().enumerate();
    let touches =
        leaves.flat_map(|(leaf, functions)| functions.ranks.iter().map(move |&rank| (rank, leaf as u32)));
    let leaves_of = Lists::new(basis.count(), touches);
    let mut seen_in = vec![u32::MAX; basis.count()];
    let mut pairs: Vec<(u32, u32)> = Vec::new();
    for column in 0..basis.count() as u32 {
        let from = pairs.len();
        for &leaf in leaves_of.of(column as usize) {
            for &row in basis.leaves()[leaf as usize].ranks.iter().filter(|&&row| row >= column) {
                if std::mem::replace(&mut seen_in[row as usize], column) != column {
                    pairs.push((column, row));
                }
            }
        }
        pairs[from..].sort_unstable();
    }
    Lists::new(basis.count(), pairs.iter().copied())
}

fn lower_triangle(rows: &Lists, values: Vec<f64>) -> CsMat<f64> {
    let n = rows.count();
    let pointers = (0..n).map(|column| rows.range(column).start).chain([values.len()]).collect();
    let indices = rows.items().iter().map(|&row| row as usize).collect();
    CsMat::new_csc((n, n), pointers, indices, values)
}
