//! Models fitted to meshes.

use super::arguments::{
    ArgumentError, ReportOut, choice, deref, flag, options, out, slice, slice_mut_or_none,
};
use super::choices::tolerance;
use super::guard::guard;
use super::mesh::planish_mesh;

use super::model::{PLANISH_NONE, planish_model};
use super::planish_status;
use super::progress::{planish_progress, with_control};
use super::report::{gravest, planish_stop_reason};
use crate::fit::model::{Family, MeshModelOptions, ModelFit, ModelOptions, fit_mesh};
use crate::layout::of_mesh::{LayoutKind, MeshLayoutOptions};
use crate::mesh::FeatureOptions;
use std::f64::consts::PI;
use std::ffi::c_void;

/// Which way a mesh becomes a model.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_model_family {
    /// Exact faces where planes and cylinders explain the mesh, else patches that keep sharp edges where that serves; one
    /// chart for a mesh with one border loop and no features inside, and for other open ones where it does better.
    Auto = 0,
    /// One chart: a PHT-spline inside its trims.
    Chart = 1,
    /// Patches over a layout of quadrilaterals.
    Patches = 2,
}

/// Which layout the patches have.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_model_layout {
    /// Over its features, if it has some; else the cube for genus 0, a base complex with handles, or where the cube misses
    /// the tolerance and the complex does better.
    Auto = 0,
    /// The six faces of a cube, which round sharp edges off; genus 0 only.
    Cube = 1,
    /// Over its features, if it has some; else a base complex: patches that follow the shape.
    Complex = 2,
}

record! {
    /// How a mesh becomes a model. Fill with planish_model_options_init(), then change what you need.
    pub struct planish_model_options (planish_model_options_init; core: ModelOptions, layout_core: MeshLayoutOptions, feature_core: FeatureOptions) {
        /// Hears of the progress and may cancel; NULL (default) for nobody.
        pub progress: planish_progress,
        /// Handed to progress as it is.
        pub user: *mut c_void,
        /// Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
        pub cancel: *const i32,
        /// Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
        /// Array: [1].
        pub out_stage: *mut u32,
        /// Receives the face on which each node lies, PLANISH_NONE for a node without triangles; NULL (default) for
        /// nobody.
        /// Array: [mesh_point_count].
        pub out_faces: *mut u32,
        /// Receives (u,v) of each node on its face; NULL (default) for nobody.
        /// Array: [mesh_point_count, 2].
        pub out_uv: *mut f64,
        /// Receives the error of each node, NaN for a node without triangles; NULL (default) for nobody.
        /// Array: [mesh_point_count].
        pub out_errors: *mut f64,
        /// Largest error allowed at the nodes. Default 1e-3.
        pub tolerance: f64 = core.tolerance.value,
        /// Weight of the plate energy of each cell of a patch, mapped to the unit cell. Default 1e-4.
        pub smoothing: f64 = core.smoothing,
        /// Most cells of all patches of a component, beside those that patches need to meet. Default 200000.
        pub max_cells: usize = core.max_cells,
        /// A cell with fewer samples is not split, as long as others help. Default 6.
        pub min_samples: usize = core.min_samples,
        /// About how many patches a base complex has, or the regions between features that few do not fill; a base complex
        /// takes 0.85 to 4 times as many where it would fold nodes, or where the fit folds or misses the tolerance by less
        /// than twice and another number does better. Default 40.
        pub patches: usize = layout_core.patches,
        /// A planish_tolerance_scale; PLANISH_TOLERANCE_SCALE_RELATIVE (default): to the diagonal of the mesh's box.
        pub tolerance_scale: u32,
        /// A planish_model_family. Default PLANISH_MODEL_FAMILY_AUTO.
        pub family: u32,
        /// A planish_model_layout, for patches. Default PLANISH_MODEL_LAYOUT_AUTO.
        pub layout: u32,
        /// Level of the cells to start from, 1 to 8; 0 (default) takes 3 over a cube and 2 over a base complex.
        pub start_level: u32 = core.start_level,
        /// Deepest level of a cell, at most 20. Default 12.
        pub max_level: u32 = core.max_level,
        /// Levels by which neighbours in a patch may differ; 0 for any number. Default 1.
        pub grade: u32 = core.grade,
        /// Steps of the samples towards their foot points in each round. Default 1.
        pub foot_steps: u32 = core.foot_steps,
        /// Whether cells with few samples are held to the mesh between them: 0 or 1 (default).
        pub guard: u32 = 1,
        /// Most rounds of fitting and refining. Default 20.
        pub max_rounds: u32 = core.max_rounds as u32,
        /// Most sweeps over all nodes while a base complex is laid. Default 300.
        pub sweeps: u32 = layout_core.sweeps as u32,
        /// By how much the levels of the cells in one face may differ. Default 1.
        pub level_spread: u32 = 1,
        /// Threads that share the work; 0 (default) for all cores. The result does not depend on it.
        pub thread_count: u32,
        /// Edges whose facets turn by more than this are sharp, in radians, at most pi; 0 looks for none. Default 0.7, which
        /// is 40 degrees.
        pub sharp_angle: f64 = feature_core.sharp_angle.unwrap_or(0.0),
        /// A number for each triangle, such as the face of a CAD model that it comes from: edges between triangles of
        /// different numbers are features unless label_angle says otherwise, and faces have the number as their label;
        /// NULL (default) for none.
        /// Array: [label_count].
        pub labels: *const u32,
        /// Numbers in labels: planish_mesh_triangle_count(), or 0 (default).
        pub label_count: usize,
        /// Whether a mesh of planes and cylinders becomes exact faces instead of patches or a chart, with
        /// PLANISH_MODEL_FAMILY_AUTO: 0 or 1 (default).
        pub exact: u32 = 1,
        /// 1 ignores all features: smooth patches everywhere; 0 (default) does not. Each patch then has the label that most
        /// of it comes from.
        pub smooth: u32,
        /// Two labels are one where the facets turn by no more than this along all edges between them, in radians, at most
        /// pi: labels of one smooth skin become one region, with the label of its first triangle. Default 0: all edges
        /// between labels are features.
        pub label_angle: f64 = feature_core.label_angle,
    }
}

record! {
    /// What a fit of a model did and how good it is, of all components together. Set struct_size to
    /// sizeof(planish_model_report) before the call; the report is filled as far as that goes, on success only.
    /// Errors and lengths are in model units and measured on the finished surfaces.
    pub struct planish_model_report {
        /// Largest distance between a node and the model at the node's place: what the tolerance bounds.
        pub max_error: f64,
        /// Square root of the mean of its square.
        pub rms_error: f64,
        /// Its mean.
        pub mean_error: f64,
        /// The tolerance that was kept or missed.
        pub tolerance: f64,
        /// Diagonal of the mesh's box: an error divided by it is relative.
        pub diagonal: f64,
        /// Largest distance of a centroid of a facet or a middle of an edge from the model.
        pub max_interior_error: f64,
        /// The part of that which flat facets on a curved shape explain: max_interior_error - facet_sagitta is the largest
        /// distance beyond what its own facet explains.
        pub facet_sagitta: f64,
        /// Largest distance from places all over the model to the mesh; NaN for a chart.
        pub max_back_distance: f64,
        /// Largest difference of unit normals across edges of patches.
        pub normal_jump: f64,
        /// Largest distance between the two sides of an edge.
        pub gap: f64,
        /// Volume that the model encloses; NaN for an open one.
        pub volume: f64,
        /// Volume that the mesh encloses; NaN for an open one.
        pub mesh_volume: f64,
        /// Largest symmetric Dirichlet energy of a component's map, by area: 4 if all lengths are kept; NaN for a chart.
        pub map_energy: f64,
        /// Seconds for layouts and maps.
        pub map_seconds: f64,
        /// Seconds for fits.
        pub fit_seconds: f64,
        /// Seconds in all.
        pub seconds: f64,
        /// The node with the largest error.
        pub worst_node: usize,
        /// Components of the mesh: shells of the model.
        pub component_count: usize,
        /// Components that are voids in others.
        pub void_count: usize,
        /// Components that were inside out and have been turned.
        pub turned_count: usize,
        /// Handles of all components.
        pub genus: usize,
        /// Patches of all components; 0 for a chart or exact faces.
        pub patch_count: usize,
        /// Control points, four a vertex of the cells of each patch.
        pub coefficient_count: usize,
        /// Unknowns a coordinate that remain when patches meet smoothly.
        pub free_count: usize,
        /// Cells of all patches.
        pub cell_count: usize,
        /// Nodes or triangles that the maps fold.
        pub fold_count: usize,
        /// Samples left out because their facets are spread over too many patches.
        pub dropped_count: usize,
        /// Everything worth knowing: bits of planish_remark.
        pub remarks: u64,
        /// The deepest level of a cell.
        pub deepest_level: u32,
        /// Rounds of fitting and measuring of the component that took most.
        pub pass_count: u32,
        /// A planish_stop_reason, why the fit ended.
        pub stop_reason: u32,
        /// 1 for one chart, 0 for patches and exact faces.
        pub is_chart: u32,
        /// Pairs of triangles of the mesh that cross.
        pub mesh_crossing_count: usize,
        /// Pairs of triangles of the model that cross, triangulated as finely as the tolerance: walls that are thinner
        /// than that, or folds. SIZE_MAX if the model could not be triangulated.
        pub crossing_count: usize,
        /// Faces on planes and cylinders.
        pub exact_face_count: usize,
        /// Components whose sharp edges were found and are rounded off, because what keeps them was no better or the cube was
        /// asked for.
        pub rounded_count: usize,
    }
}

impl planish_model_report {
    fn new(fit: &ModelFit) -> Self {
        let (report, components) = (&fit.report, &fit.components);
        Self {
            struct_size: size_of::<Self>(),
            max_error: report.max_error,
            rms_error: report.rms_error,
            mean_error: report.mean_error,
            tolerance: report.tolerance,
            diagonal: report.diagonal,
            max_interior_error: report.max_interior_error,
            facet_sagitta: report.facet_sagitta,
            max_back_distance: report.max_back_distance,
            normal_jump: report.normal_jump,
            gap: report.gap,
            volume: report.volume,
            mesh_volume: report.mesh_volume,
            map_energy: components.iter().map(|component| component.map_energy).fold(f64::NAN, f64::max),
            map_seconds: components.iter().map(|component| component.map_seconds).sum(),
            fit_seconds: report.fit_seconds,
            seconds: fit.seconds,
            worst_node: report.worst_node,
            component_count: components.len(),
            void_count: components.iter().filter(|component| component.void_in.is_some()).count(),
            turned_count: components.iter().filter(|component| component.is_turned).count(),
            genus: components.iter().map(|component| component.genus).sum(),
            patch_count: report.patches.len(),
            coefficient_count: report.coefficient_count,
            free_count: report.free_count,
            cell_count: report.cell_count,
            fold_count: components.iter().map(|component| component.fold_count).sum(),
            dropped_count: report.dropped_samples,
            remarks: report.remarks.0,
            deepest_level: report.deepest_level,
            pass_count: report.passes as u32,
            stop_reason: planish_stop_reason::from(report.stop) as u32,
            is_chart: u32::from(fit.is_chart()),
            mesh_crossing_count: report.mesh_crossings,
            crossing_count: report.crossings.unwrap_or(usize::MAX),
            exact_face_count: components.iter().map(|component| component.exact_faces).sum(),
            rounded_count: components.iter().filter(|component| component.rounds_edges).count(),
        }
    }

    /// The gravest thing that there is to say.
    fn status(&self) -> planish_status {
        match gravest(self.remarks) {
            planish_status::Ok if self.turned_count > 0 => planish_status::InputRepaired,
            status => status,
        }
    }
}

impl planish_model_options {
    fn core<'a>(&self, labels: &'a [u32]) -> Result<MeshModelOptions<'a>, ArgumentError> {
        let kinds = [LayoutKind::Auto, LayoutKind::Cube, LayoutKind::Complex];
        let is_smooth = flag(self.smooth, "smooth")?;
        Ok(MeshModelOptions {
            family: choice(self.family, &[Family::Auto, Family::Chart, Family::Patches], "family")?,
            fit: ModelOptions {
                tolerance: tolerance(self.tolerance, self.tolerance_scale)?,
                smoothing: self.smoothing,
                start_level: self.start_level,
                max_level: self.max_level,
                max_cells: self.max_cells,
                min_samples: self.min_samples,
                grade: self.grade,
                foot_steps: self.foot_steps,
                guard: flag(self.guard, "guard")?,
                max_rounds: self.max_rounds as usize,
            },
            layout: MeshLayoutOptions {
                kind: choice(self.layout, &kinds, "layout")?,
                patches: self.patches,
                sweeps: self.sweeps as usize,
            },
            level_spread: self.level_spread,
            exact: flag(self.exact, "exact")? && !is_smooth,
            features: FeatureOptions {
                sharp_angle: (self.sharp_angle != 0.0 && !is_smooth).then_some(self.sharp_angle),
                labels,
                label_angle: if is_smooth { PI } else { self.label_angle },
                ..FeatureOptions::default()
            },
        })
    }
}

/// Makes a model of any mesh within a tolerance. A mesh of planes and cylinders between sharp edges becomes exact faces
/// that meet in lines, circles and ellipses. Any other closed mesh becomes a solid of B-spline faces that share position and
/// tangent plane to rounding, but for sharp edges, which stay sharp where that serves, with one plane face for each flat
/// region between them. One inside another becomes its void, several components several shells. An open mesh becomes such a
/// shell over its features and borders, or one PHT-spline inside its trims where it has one border loop and no features
/// inside, or where that does better. Components that are inside out are turned.
///
/// mesh:       not NULL; stays as it is.
/// options:    NULL for the defaults.
/// out_model:  receives a new model; destroy with planish_model_free().
/// out_report: receives what the fit did and how good it is; NULL for no report.
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_INPUT_REPAIRED (a component was turned), PLANISH_STATUS_FOLDED_PARAMETERS,
/// PLANISH_STATUS_TOLERANCE_NOT_MET or PLANISH_STATUS_STAGNATED (the best model found is there), or an error:
/// PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option; a start_level that the layout does not
/// allow; labels that are not as many as the triangles), PLANISH_STATUS_TOPOLOGY (patches for a mesh with a boundary, one of whose nodes is the index; a cube for a mesh
/// with handles; a node where the surface touches itself), PLANISH_STATUS_DEGENERATE (a component encloses no volume, one
/// of its nodes is the index; no layout), PLANISH_STATUS_TOO_LARGE (more than 1000 components; coordinates beyond 1e50, or all below 1e-50), PLANISH_STATUS_SINGULAR,
/// PLANISH_STATUS_VERSION, PLANISH_STATUS_CANCELLED, or for a chart what planish_pht_fit() and
/// planish_model_from_surface() return.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_fit(
    mesh: *const planish_mesh,
    options: *const planish_model_options,
    out_model: *mut *mut planish_model,
    out_report: *mut planish_model_report,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let mesh = &deref(mesh, "mesh")?.0;
        let given = self::options(options)?;
        let model = out(out_model, "out_model")?;
        let report = ReportOut::new(out_report)?;
        let count = mesh.points().len();
        let faces = slice_mut_or_none(given.out_faces, count, "out_faces")?;
        let uv = slice_mut_or_none(given.out_uv, count.saturating_mul(2), "out_uv")?;
        let errors = slice_mut_or_none(given.out_errors, count, "out_errors")?;
        let labels = slice(given.labels, given.label_count, "labels")?;
        let core = given.core(labels)?;
        let fit =
            with_control(given.thread_count, listener!(given), |control| fit_mesh(mesh, &core, control))??;
        let filled = planish_model_report::new(&fit);
        if let Some(faces) = faces {
            let number = |place: &Option<(crate::model::FaceId, _)>| {
                place.map_or(PLANISH_NONE, |(face, _)| face.index() as u32)
            };
            faces.iter_mut().zip(&fit.places).for_each(|(face, place)| *face = number(place));
        }
        if let Some(uv) = uv {
            for (row, place) in uv.chunks_exact_mut(2).zip(&fit.places) {
                place.map_or(glam::DVec2::NAN, |(_, uv)| uv).write_to_slice(row);
            }
        }
        if let Some(errors) = errors {
            errors.copy_from_slice(&fit.errors);
        }
        report.store(filled);
        model.write(planish_model::into_raw(fit.model));
        Ok(filled.status())
    })
}
