//! Fields on the grid, and with the smoothing, that the adaptive fit of one of them takes.
//!
//! The one place that knows both methods: [`crate::fit::tensor`] finds, [`crate::fit::field`] fits.

use super::common::FitError;
use super::common::Regularize;
use super::common::report::FitReport;
use super::field::{FieldError, FieldFitter, FieldGrid, FieldNodes, FieldOptions};
use super::tensor::{Knots, TensorOptions, fit_field, fit_points};
use crate::control::Control;
use crate::memory::CollectVec;
use glam::DVec2;

/// A field that stands for others: rows of numbers, one a node.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SampleField<'a> {
    /// Rows of `dim` numbers.
    pub values: &'a [f64],
    /// Numbers a node.
    pub dim: usize,
}

/// A fitter for fields on these nodes; what `options` say of the grid and the smoothing has no meaning here.
pub fn fitter(
    nodes: FieldNodes,
    sample: &SampleField,
    options: &FieldOptions,
    control: &mut Control,
) -> Result<FieldFitter, FieldError> {
    let mask = nodes.mask(options);
    let options = &FieldOptions { is_known: mask.as_deref().or(options.is_known), ..*options };
    let found = control.within(0.0, 0.6, |control| find(&nodes, sample, options, control))?;
    let grid = FieldGrid::Fixed([found.grid_u, found.grid_v]);
    let options = options.with_grid(grid).with_smoothing(found.smoothing);
    control.within(0.6, 1.0, |control| FieldFitter::new(nodes, &options, control))
}

/// What the adaptive fit of a field says.
fn find(
    nodes: &FieldNodes,
    SampleField { values, dim }: &SampleField,
    options: &FieldOptions,
    control: &mut Control,
) -> Result<FitReport, FitError> {
    let (uv, dim) = (nodes.parameters(), *dim);
    let adaptive = TensorOptions {
        tolerance: options.tolerance,
        knots: Knots::Uniform,
        ends: options.ends,
        energy: options.energy,
        buffer: options.buffer,
        weights: options.weights,
        regularize: Regularize::Never,
        missing: options.missing,
        parameterize: options.parameterize,
        ..TensorOptions::default()
    };
    if let Some(is_known) = options.is_known {
        let expected = uv.len().saturating_mul(dim);
        if values.len() != expected {
            return Err(FitError::Count { what: "the values", count: values.len(), expected });
        }
        let nodes = || (0..uv.len()).filter(|&node| is_known[node]);
        let known_uv: Vec<DVec2> = nodes().map(|node| uv[node]).collect_vec();
        let rows: Vec<f64> = nodes().flat_map(|node| &values[node * dim..][..dim]).copied().collect_vec();
        let weights: Option<Vec<f64>> =
            options.weights.map(|weights| nodes().map(|node| weights[node]).collect());
        let adaptive = adaptive.with_weights(weights.as_deref());
        return Ok(fit_points(&known_uv, &rows, dim, &adaptive, control)?.report);
    }
    Ok(match nodes.mesh_with_parameters() {
        Some(mesh) => fit_field(mesh, values, dim, &adaptive, control)?.report,
        None => fit_points(uv, values, dim, &adaptive, control)?.report,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples;

    #[test]
    fn the_grid_found_for_a_field_meets_its_tolerance() {
        let mesh = samples::curved_notch(2).unwrap();
        let wave = |p: &DVec2| [(0.7 * p.x).sin() * (0.5 * p.y).cos(), 300.0 + p.x * p.y];
        let values: Vec<f64> = mesh.parameters().unwrap().iter().flat_map(wave).collect();
        let (options, mut control) = (FieldOptions::default(), Control::new(2));
        let nodes = FieldNodes::of_mesh(&mesh, &options, &mut control).unwrap();
        let sample = SampleField { values: &values, dim: 2 };
        let fitter = fitter(nodes, &sample, &options, &mut control).unwrap();
        let surface = fitter.fit(&values, 2).unwrap();
        let report = fitter.measure(&surface, &values, 2).unwrap().fit;
        assert!(report.max_error <= report.tolerance, "{report:?}");
    }
}
