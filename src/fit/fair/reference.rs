//! What a surface is to stay near: itself, or data.

use super::quadratic::{CellForms, Pattern};
use super::space::Space;
use super::{FairData, FairError};
use crate::control::Watch;
use glam::DVec2;

/// A displacement beyond this share of the tolerance asks for more weight.
const WEIGH_FROM: f64 = 0.9;
/// Most that a weight grows at once, and in all: beyond that rounding decides.
const MOST_AT_ONCE: f64 = 1e2;
const MOST_WEIGHT: f64 = 1e8;
/// Weight of a cell against that of a datum in it: it keeps the surface where there are no data.
const CELL_SHARE: f64 = 1e-6;

/// What is near, and what near means.
pub(super) struct Reference<'a> {
    space: &'a Space,
    tolerance: f64,
    /// The matrices of the displacements of the cells.
    masses: Vec<Vec<f64>>,
    data: Option<Data>,
}

/// Data on their cells.
struct Data {
    cells: Vec<u32>,
    /// The weights of the control points of the cell at each datum.
    shares: Vec<Vec<f64>>,
    /// By how much the surface misses each datum: rows of `dim` numbers.
    misses: Vec<f64>,
    /// The mass of all cells, to be added with [`CELL_SHARE`].
    mass: f64,
}

impl<'a> Reference<'a> {
    pub(super) fn new(
        space: &'a Space,
        data: Option<FairData>,
        tolerance: f64,
        forms: &CellForms,
        lengths: DVec2,
        watch: &Watch,
    ) -> Result<Self, FairError> {
        let mut masses = Vec::with_capacity(space.cells.len());
        for (k, cell) in space.cells.iter().enumerate() {
            if k.is_multiple_of(64) {
                watch.check()?;
            }
            masses.push(forms.mass(cell, lengths));
        }
        let reference = Self { space, tolerance, masses, data: None };
        let Some(data) = data else { return Ok(reference) };
        let data = Data::new(space, &data, lengths);
        let nothing = vec![0.0; space.control_points.len()];
        let reference = Self { data: Some(data), ..reference };
        let (index, distance) = reference
            .deviations(&nothing)
            .into_iter()
            .enumerate()
            .fold((0, 0.0), |worst, next| if next.1 > worst.1 { next } else { worst });
        if distance > tolerance {
            return Err(FairError::NotWithin { index, distance, tolerance });
        }
        Ok(reference)
    }

    /// A weight for each cell, or for each datum, to begin with.
    pub(super) fn weights(&self) -> Vec<f64> {
        vec![1.0; self.data.as_ref().map_or(self.masses.len(), |data| data.cells.len())]
    }

    /// The matrix of the weighed squares.
    pub(super) fn form(&self, pattern: &Pattern, weights: &[f64]) -> Vec<f64> {
        let mut matrix = pattern.zeros();
        let cell_weight = |k: usize| match &self.data {
            None => weights[k],
            Some(data) => CELL_SHARE * data.cells.len() as f64 / data.mass,
        };
        for (k, (cell, mass)) in self.space.cells.iter().zip(&self.masses).enumerate() {
            pattern.add(&mut matrix, &cell.unknowns, mass, cell_weight(k));
        }
        if let Some(data) = &self.data {
            for ((&cell, shares), &weight) in data.cells.iter().zip(&data.shares).zip(weights) {
                let unknowns = &self.space.cells[cell as usize].unknowns;
                pattern.add_square(&mut matrix, unknowns, shares, weight);
            }
        }
        matrix
    }

    /// The right-hand side of the weighed squares: rows of `dim` numbers; empty without data.
    pub(super) fn pull(&self, weights: &[f64]) -> Vec<f64> {
        let Some(data) = &self.data else { return Vec::new() };
        let misses = data.misses.chunks_exact(self.space.dim).zip(weights);
        let weighed: Vec<f64> =
            misses.flat_map(|(miss, weight)| miss.iter().map(move |x| -weight * x)).collect();
        self.pull_of(&weighed, self.space.dim)
    }

    /// The right-hand side that rows of `width` numbers make, one for each datum.
    pub(crate) fn pull_of(&self, rows: &[f64], width: usize) -> Vec<f64> {
        let mut pull = vec![0.0; self.space.count() * width];
        let Some(data) = &self.data else { return pull };
        for ((&cell, shares), row) in data.cells.iter().zip(&data.shares).zip(rows.chunks_exact(width)) {
            for (&unknown, share) in self.space.cells[cell as usize].unknowns.iter().zip(shares) {
                let sums = &mut pull[unknown as usize * width..][..width];
                sums.iter_mut().zip(row).for_each(|(sum, x)| *sum += share * x);
            }
        }
        pull
    }

    /// The sum of the products of rows of `width` numbers, one for each datum, with the values there of such rows for the
    /// control points.
    pub(crate) fn product(&self, points: &[f64], rows: &[f64], width: usize) -> f64 {
        let pull = self.pull_of(rows, width);
        pull.iter().zip(points).map(|(a, b)| a * b).sum()
    }

    /// How far each cell moves at most, or by how much each datum is missed, after a displacement.
    pub(super) fn deviations(&self, d: &[f64]) -> Vec<f64> {
        match &self.data {
            None => movements(self.space, d),
            Some(data) => data.misses_after(self.space, d, 1.0),
        }
    }

    /// By how much each datum is missed after a displacement: rows of `dim` numbers; empty without data.
    pub(crate) fn misses(&self, d: &[f64]) -> Vec<f64> {
        self.data.as_ref().map_or(Vec::new(), |data| data.rows_after(self.space, d, 1.0))
    }

    /// The longest step along a displacement, at most 1, that stays within the tolerance.
    pub(super) fn longest_step(&self, d: &[f64]) -> f64 {
        let largest = |deviations: Vec<f64>| deviations.into_iter().fold(0.0, f64::max);
        let whole = largest(self.deviations(d));
        if whole <= self.tolerance {
            return 1.0;
        }
        let Some(data) = &self.data else { return self.tolerance / whole * (1.0 - 1e-12) };
        // the largest distance is convex along the way, and within the tolerance at its begin
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..30 {
            let middle = (low + high) / 2.0;
            let is_within = largest(data.misses_after(self.space, d, middle)) <= self.tolerance;
            (low, high) = if is_within { (middle, high) } else { (low, middle) };
        }
        low
    }

    /// Gives more weight to what lies far off after a displacement.
    pub(super) fn weigh(&self, d: &[f64], weights: &mut [f64]) {
        for (weight, deviation) in weights.iter_mut().zip(self.deviations(d)) {
            let excess = deviation / (WEIGH_FROM * self.tolerance);
            *weight = (*weight * excess.clamp(1.0, MOST_AT_ONCE).powi(2)).min(MOST_WEIGHT);
        }
    }
}

impl Data {
    fn new(space: &Space, data: &FairData, lengths: DVec2) -> Self {
        let dim = space.dim;
        let cells: Vec<u32> = data.uv.iter().map(|&uv| space.cell_at(uv) as u32).collect();
        let shares: Vec<Vec<f64>> = cells
            .iter()
            .zip(data.uv)
            .map(|(&cell, &uv)| space.weights_at(&space.cells[cell as usize], uv))
            .collect();
        let mut misses: Vec<f64> = data.values.iter().map(|x| -x).collect();
        for ((&cell, shares), miss) in cells.iter().zip(&shares).zip(misses.chunks_exact_mut(dim)) {
            add_point(space, cell, shares, &space.control_points, 1.0, miss);
        }
        let mass = space.cells.iter().map(|cell| (cell.domain.size() * lengths).element_product()).sum();
        Self { cells, shares, misses, mass }
    }

    fn misses_after(&self, space: &Space, d: &[f64], step: f64) -> Vec<f64> {
        let rows = self.rows_after(space, d, step);
        rows.chunks_exact(space.dim).map(|miss| miss.iter().map(|x| x * x).sum::<f64>().sqrt()).collect()
    }

    /// By how much a displaced surface misses each datum: rows of `dim` numbers.
    fn rows_after(&self, space: &Space, d: &[f64], step: f64) -> Vec<f64> {
        let mut rows = self.misses.clone();
        for ((&cell, shares), miss) in
            self.cells.iter().zip(&self.shares).zip(rows.chunks_exact_mut(space.dim))
        {
            add_point(space, cell, shares, d, step, miss);
        }
        rows
    }
}

/// Adds `step` times a weighed sum of the control points of a cell.
fn add_point(space: &Space, cell: u32, shares: &[f64], points: &[f64], step: f64, sum: &mut [f64]) {
    for (&unknown, share) in space.cells[cell as usize].unknowns.iter().zip(shares) {
        let point = &points[unknown as usize * space.dim..][..space.dim];
        sum.iter_mut().zip(point).for_each(|(sum, x)| *sum += step * share * x);
    }
}

/// The most that a place of each cell moves: that of the ordinates of the displacement, of which it is a mean.
pub(super) fn movements(space: &Space, d: &[f64]) -> Vec<f64> {
    let length = |row: &[f64]| row.iter().map(|x| x * x).sum::<f64>().sqrt();
    let most = |ordinates: Vec<f64>| ordinates.chunks_exact(space.dim).map(length).fold(0.0, f64::max);
    space.cells.iter().map(|cell| most(space.ordinates(cell, d))).collect()
}
