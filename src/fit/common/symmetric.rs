//! What fits of symmetric shapes share: the data of the half, and the measure of the whole.

use super::checks::check_unused;
use super::demands::{Demands, Standards};
use super::error::FitError;
use super::errors::data_errors;
use super::interior::MeshData;
use super::report::{FitReport, Goal, Remarks, Tolerance, ToleranceScale};
use super::symmetry::Half;
use super::{Fit, Outliers, trims};
use crate::control::Control;
use crate::geometry::{Bounds, Domain};
use crate::mesh::Mesh;
use crate::parameterize::ParameterizeOptions;
use crate::surface::{Region, Surface};

/// The half of a shape, and what is asked of it.
pub(crate) struct Folded {
    pub half: Half,
    /// The tolerance in model units.
    pub tolerance: Tolerance,
    /// The same for each datum of the half.
    pub tolerances: Vec<f64>,
    pub weights: Vec<f64>,
}

impl Folded {
    pub(crate) fn new(
        mesh: &Mesh,
        demands: &Demands,
        weights: Option<&[f64]>,
        asked: &Tolerance,
        map: &ParameterizeOptions,
        control: &mut Control,
    ) -> Result<Self, FitError> {
        const BY: &str = "the fit of a symmetric shape";
        check_unused(demands.fixed.is_empty(), "fixed", BY)?;
        check_unused(demands.outliers == Outliers::None, "outliers", BY)?;
        let bounds = mesh.bounds();
        let (value, _) = asked.absolute(&bounds);
        let half = Half::of(mesh, demands.symmetry, value, map, control)?;
        let scale = match asked.scale {
            ToleranceScale::Relative => bounds.diagonal(),
            ToleranceScale::Absolute => 1.0,
        };
        let given = demands.tolerances.map(|all| all.iter().map(|tolerance| tolerance * scale).collect());
        let mut tolerances: Vec<f64> = given.unwrap_or_else(|| vec![value; mesh.points().len()]);
        // where edges cross the plane nothing was measured
        tolerances.resize(half.uv.len(), value);
        let mut weights = weights.map_or_else(|| vec![1.0; mesh.points().len()], <[f64]>::to_vec);
        weights.resize(half.uv.len(), 1.0);
        let tolerance = Tolerance { value, scale: ToleranceScale::Absolute };
        Ok(Self { half, tolerance, tolerances, weights })
    }
}

/// Gives the whole surface its trims and measures it at the nodes of the mesh and between them. `report` is that of the half.
pub(crate) fn finish<S: Surface>(
    mut surface: S,
    report: FitReport,
    mesh: &Mesh,
    tolerances: Option<&[f64]>,
    (folded, asked): (&Folded, &Tolerance),
    control: &Control,
) -> Fit<S> {
    let mut parameters = folded.half.parameters();
    parameters.truncate(mesh.points().len());
    let domain = surface.domain();
    let data_box = Some(Domain::around(parameters.iter().copied()));
    *surface.region_mut() =
        Region { data_box, trims: trims(Some(mesh), &parameters, &domain), ..Region::default() };
    let values: Vec<f64> = mesh.points().iter().flat_map(|p| p.to_array()).collect();
    let goal = Goal::new(asked, &Bounds::of_rows(&values, 3));
    let demands = Demands { tolerances, ..Demands::default() };
    // nothing is fixed, so nothing can be in contradiction
    let standards = Standards::new(&demands, asked, &goal, &parameters, (&values, 3)).unwrap_or_default();
    let errors = standards.measure(data_errors(&surface, &parameters, &values, control.pool()));
    let fresh = FitReport::new(&errors, &goal, report.stop, report.passes);
    let mut remarks = report.remarks;
    remarks.remove(Remarks::TOLERANCE_NOT_MET);
    let mut report = FitReport {
        max_error: fresh.max_error,
        rms_error: fresh.rms_error,
        mean_error: fresh.mean_error,
        worst_index: fresh.worst_index,
        diagonal: fresh.diagonal,
        remarks: Remarks(remarks.0 | fresh.remarks.0),
        mirror: Some(folded.half.plane),
        mirror_distance: folded.half.distance,
        ..report
    };
    standards.report(&errors.each, &mut report);
    let data = MeshData { mesh, uv: &parameters, values: &values, is_shape: true };
    report.add_interior(&data.interior_errors(&surface, &standards, control.pool()));
    report.measure_map(mesh, &parameters, control.pool().watch());
    Fit { surface, report, parameters, errors: errors.each }
}

#[cfg(test)]
mod tests;
