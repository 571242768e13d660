//! The linear system of a map: every interior node is the weighted mean of its neighbours.
//!
//! ```text
//! u_n - sum_m w_nm u_m = 0  (the same for v),   sum_m w_nm = 1,   fixed nodes known
//! ```
//! With positive weights a row-dominant M-matrix, so LU needs no pivoting; its pattern is that of
//! the mesh, analysed once for all steps.

use super::ParameterizeError;
use super::patch::{FIXED, Patch};
use crate::Control;
use crate::linalg::{LuError, NumericLu, SymbolicLu};
use crate::memory;
use glam::DVec2;
use sprs::CsMat;

/// The entry is the diagonal, which is always 1.
const DIAGONAL: u32 = u32::MAX;

/// A patch's system, for any weights.
pub(super) struct MapSystem<'p> {
    patch: &'p Patch,
    matrix: CsMat<f64>,
    /// The slot that each entry of the matrix gets its value from.
    slots: Vec<u32>,
    symbolic: SymbolicLu,
    numeric: NumericLu,
    weights: Vec<f64>,
    pub factor_count: usize,
}

impl<'p> MapSystem<'p> {
    /// Analyses the pattern and factors with the first weights.
    pub(super) fn new(
        patch: &'p Patch,
        weights: Vec<f64>,
        control: &Control,
    ) -> Result<Self, ParameterizeError> {
        let (mut matrix, slots) = pattern(patch);
        fill(&mut matrix, &slots, &weights);
        let named = |error| name_node(patch, error);
        let watch = control.pool().watch();
        watch.check()?;
        let symbolic = control.run(|| SymbolicLu::new(matrix.view(), watch)).map_err(named)?;
        let numeric = control.run(|| symbolic.factor(matrix.view(), watch)).map_err(named)?;
        watch.check()?;
        Ok(Self { patch, matrix, slots, symbolic, numeric, weights, factor_count: 1 })
    }

    /// The patch whose system this is.
    pub(super) fn patch(&self) -> &'p Patch {
        self.patch
    }

    /// Factors with other weights; none is spared, callers change all of them.
    pub(super) fn set_weights(
        &mut self,
        weights: Vec<f64>,
        control: &Control,
    ) -> Result<(), ParameterizeError> {
        let Self { matrix, symbolic, numeric, .. } = self;
        fill(matrix, &self.slots, &weights);
        let watch = control.pool().watch();
        control
            .run(|| symbolic.refactor(matrix.view(), numeric, watch))
            .map_err(|error| name_node(self.patch, error))?;
        self.weights = weights;
        self.factor_count += 1;
        Ok(())
    }

    /// The map with the present weights; `uv` has the fixed nodes and receives the others. A cancelled call throws it away.
    pub(super) fn solve(&self, uv: &mut [DVec2], control: &Control) {
        let mut rhs = memory::filled([0.0; 2], self.patch.nodes.len());
        for (sum, &node) in rhs.iter_mut().zip(&self.patch.nodes) {
            for slot in self.patch.neighbours.slots(node as usize) {
                let other = self.patch.neighbours.nodes()[slot];
                if self.patch.is_fixed(other) {
                    let term = uv[other as usize] * self.weights[slot];
                    *sum = [sum[0] + term.x, sum[1] + term.y];
                }
            }
        }
        let watch = control.pool().watch();
        let solution = control.run(|| self.symbolic.solve(&self.numeric, self.matrix.view(), &rhs, watch));
        for (&node, &value) in self.patch.nodes.iter().zip(&solution) {
            uv[node as usize] = DVec2::from_array(value);
        }
    }
}

/// The matrix of the unknowns with their slots; neighbours ascend, so columns do.
fn pattern(patch: &Patch) -> (CsMat<f64>, Vec<u32>) {
    let size = patch.nodes.len();
    let (mut starts, mut columns, mut slots) = (vec![0], Vec::new(), Vec::new());
    for (row, &node) in patch.nodes.iter().enumerate() {
        let mut diagonal_done = false;
        for slot in patch.neighbours.slots(node as usize) {
            let column = patch.unknown[patch.neighbours.nodes()[slot] as usize];
            if !diagonal_done && column as usize > row && column != FIXED {
                memory::push(&mut columns, row);
                memory::push(&mut slots, DIAGONAL);
                diagonal_done = true;
            }
            if column != FIXED {
                memory::push(&mut columns, column as usize);
                memory::push(&mut slots, slot as u32);
            }
        }
        if !diagonal_done {
            memory::push(&mut columns, row);
            memory::push(&mut slots, DIAGONAL);
        }
        memory::push(&mut starts, columns.len());
    }
    let values = memory::filled(0.0, columns.len());
    (CsMat::new((size, size), starts, columns, values), slots)
}

fn fill(matrix: &mut CsMat<f64>, slots: &[u32], weights: &[f64]) {
    for (value, &slot) in matrix.data_mut().iter_mut().zip(slots) {
        *value = if slot == DIAGONAL { 1.0 } else { -weights[slot as usize] };
    }
}

fn name_node(patch: &Patch, error: LuError) -> ParameterizeError {
    match error {
        LuError::Singular { row } => ParameterizeError::Singular { node: patch.nodes[row] as usize },
        LuError::Cancelled(cancelled) => cancelled.into(),
        other => ParameterizeError::Lu(other),
    }
}
