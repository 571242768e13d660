//! An open mesh as one chart: a PHT-spline inside its trims.

use super::ModelReport;
use super::error::ModelFitError;
use super::mesh_model::{ComponentReport, MeshModelOptions, ModelFit, origins};
use crate::control::Control;
use crate::fit::common::report::FitReport;
use crate::fit::pht::{self, PhtOptions};
use crate::memory::CollectVec;
use crate::mesh::Mesh;
use crate::model::{FaceId, Form, FormOptions, Origin, of_surface};
use crate::surface::AnySurface;
use glam::DVec2;

/// An open mesh of one piece as one surface inside its trims.
pub(super) fn chart(
    mesh: &Mesh,
    options: &MeshModelOptions,
    control: &mut Control,
) -> Result<ModelFit, ModelFitError> {
    let pht_options = PhtOptions { tolerance: options.fit.tolerance, ..PhtOptions::default() };
    let fit = pht::fit_mesh(mesh, &pht_options, control)?;
    let form =
        FormOptions { form: Form::Patches, level_spread: options.level_spread, ..FormOptions::default() };
    let surface = AnySurface::Pht(fit.surface);
    let model = of_surface(&surface, &form, control.pool().watch())?;
    let face_at = |uv: DVec2| {
        let holds = |&face: &FaceId| model.carrier(face).domain().is_some_and(|domain| domain.contains(uv));
        model.face_ids().find(holds)
    };
    let places: Vec<Option<(FaceId, DVec2)>> = (0..mesh.points().len() as u32)
        .zip(&fit.parameters)
        .map(|(node, &uv)| Some((face_at(uv).filter(|_| mesh.is_used(node))?, uv)))
        .collect_vec();
    let report = of_chart(&fit.report);
    let component = ComponentReport {
        genus: mesh.genus(),
        layout: None,
        exact_faces: 0,
        map_energy: f64::NAN,
        fold_count: fit.report.flipped_count,
        void_in: None,
        is_turned: false,
        rounds_edges: false,
        map_seconds: fit.report.parameterize_seconds,
        fit: report.clone(),
    };
    let components = vec![component];
    let nodes = origins(&places, &fit.errors);
    let model = model.with_origin(Origin { nodes, pieces: Vec::new(), patch_of_face: Vec::new() })?;
    Ok(ModelFit { model, pieces: Vec::new(), places, errors: fit.errors, components, report, seconds: 0.0 })
}

fn of_chart(fit: &FitReport) -> ModelReport {
    ModelReport {
        max_error: fit.max_error,
        rms_error: fit.rms_error,
        mean_error: fit.mean_error,
        worst_node: fit.worst_index,
        tolerance: fit.tolerance,
        diagonal: fit.diagonal,
        max_interior_error: fit.max_interior_error,
        facet_sagitta: fit.facet_sagitta,
        max_back_distance: f64::NAN,
        volume: f64::NAN,
        mesh_volume: f64::NAN,
        coefficient_count: fit.coefficient_count,
        free_count: fit.coefficient_count,
        cell_count: fit.cell_count,
        deepest_level: fit.deepest_level,
        passes: fit.passes,
        stop: fit.stop,
        remarks: fit.remarks,
        fit_seconds: fit.seconds - fit.parameterize_seconds,
        ..ModelReport::default()
    }
}
