//! Nodes that no triangle needs: a fit passes them over, and answers in the numbers of the caller all the same.

use super::error::FitError;
use super::report::FitReport;
use super::{Demands, Outliers, Symmetry};
use crate::mesh::{Mesh, Piece};
use crate::parameterize::{Border, ParameterizeOptions};
use glam::DVec2;

/// What a fit sees of a mesh with unused nodes: the mesh without them, and what is known of the others.
pub(in crate::fit) struct Used {
    piece: Piece,
    /// Nodes of the whole mesh.
    count: usize,
    pub values: Vec<f64>,
    weights: Option<Vec<f64>>,
    fixed: Vec<u32>,
    tolerances: Option<Vec<f64>>,
    outliers: Outliers,
    symmetry: Symmetry,
}

impl Used {
    /// None if all nodes are used. `values`: rows of `dim` numbers, one a node.
    pub(crate) fn of(
        mesh: &Mesh,
        values: &[f64],
        dim: usize,
        weights: Option<&[f64]>,
        demands: &Demands,
    ) -> Result<Option<Self>, FitError> {
        let Some(piece) = mesh.without_unused_nodes() else { return Ok(None) };
        let count = mesh.points().len();
        let arrays = [("the values", Some(values), dim), ("the weights", weights, 1)];
        for (what, array, dim) in arrays {
            let expected = count.saturating_mul(dim);
            if let Some(count) = array.map(<[f64]>::len).filter(|&len| len != expected) {
                return Err(FitError::Count { what, count, expected });
            }
        }
        demands.check(count)?;
        let gather = |array: Option<&[f64]>| array.map(|array| piece.gather(array, 1));
        let (weights, tolerances) = (gather(weights), gather(demands.tolerances));
        let (fixed, outliers, symmetry) = (Vec::new(), demands.outliers, demands.symmetry);
        let values = piece.gather(values, dim);
        let mut used = Self { piece, count, values, weights, fixed, tolerances, outliers, symmetry };
        for &node in demands.fixed {
            match used.node(node) {
                u32::MAX => return Err(FitError::FixedUnused { index: node as usize }),
                node => used.fixed.push(node),
            }
        }
        Ok(Some(used))
    }

    pub(crate) fn mesh(&self) -> &Mesh {
        &self.piece.mesh
    }

    pub(crate) fn weights(&self) -> Option<&[f64]> {
        self.weights.as_deref()
    }

    pub(crate) fn demands(&self) -> Demands<'_> {
        let (outliers, symmetry) = (self.outliers, self.symmetry);
        Demands { fixed: &self.fixed, tolerances: self.tolerances.as_deref(), outliers, symmetry }
    }

    /// The number that a node of the whole mesh has here; one that does not exist for an unused node.
    pub(crate) fn node(&self, node: u32) -> u32 {
        self.piece.nodes.binary_search(&node).map_or(u32::MAX, |place| place as u32)
    }

    /// The same options for this mesh.
    pub(crate) fn parameterize(&self, options: ParameterizeOptions) -> ParameterizeOptions {
        match options.border {
            Border::Corners(nodes) => options.with_border(Border::Corners(nodes.map(|node| self.node(node)))),
            _ => options,
        }
    }

    /// An error of the fit in the numbers of the whole mesh.
    pub(crate) fn told(&self, mut error: FitError) -> FitError {
        let old = |index: &mut usize| {
            if let Some(&node) = self.piece.nodes.get(*index) {
                *index = node as usize;
            }
        };
        match &mut error {
            FitError::ParametersNotFinite { index }
            | FitError::ValuesNotFinite { index }
            | FitError::Weight { index, .. }
            | FitError::DatumTolerance { index, .. }
            | FitError::SideOff { index, .. } => old(index),
            FitError::Contradiction { first, second, .. } => {
                old(first);
                old(second);
            }
            FitError::Parameterize(error) => error.node_mut().into_iter().for_each(old),
            _ => {}
        }
        error
    }

    /// Gives what the fit found to all nodes. An unused node has no error, and the parameters of some other node, so
    /// that it can be evaluated.
    pub(crate) fn spread(&self, report: &mut FitReport, parameters: &mut Vec<DVec2>, errors: &mut Vec<f64>) {
        *parameters = self.piece.spread(parameters, self.count, parameters[0]);
        *errors = self.piece.spread(errors, self.count, f64::NAN);
        report.left_out.iter_mut().for_each(|node| *node = self.piece.nodes[*node as usize]);
        report.worst_index = self.piece.nodes[report.worst_index] as usize;
    }
}
