//! Fits by D1RC-splines.

use super::arguments::{ArgumentError, deref, options, slice_or_none};
use super::choices::tolerance;
use super::d1rc::{edges, planish_d1rc_options};
use super::guard::guard;
use super::mesh::planish_mesh;
use super::progress::with_control;
use super::report::{FitOutputs, planish_fit_report};
use super::surface::planish_surface;
use super::{planish_parameterize_options, planish_status};
use crate::fit::d1rc::{D1rcFitOptions, fit_mesh};

/// Fits a D1RC-spline to the shape of a mesh within a tolerance: control points by least squares over a control mesh
/// that is given, or that grows until the tolerance is met. Nodes beyond the edges of the control mesh, which cuts
/// corners of the boundary, are measured at the nearest place on it.
///
/// mesh:        a disk, possibly with holes; parameterized first if it has no parameters and no control mesh is
///              given.
/// options:     NULL for the defaults; corners must be NULL. sharp_edges and sharp_angle are those of the control
///              mesh if it is given, else of the mesh, and all of them stay sharp. parameterize NULL means a circle
///              with one stretch step.
/// out_surface: receives a new surface; destroy with planish_surface_free().
/// out_report:  receives what the fit did and how good it is; NULL for no report. cell_count is that of the faces.
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_FOLDED_PARAMETERS, PLANISH_STATUS_TOLERANCE_NOT_MET or
/// PLANISH_STATUS_STAGNATED (the best surface found is there), or an error: PLANISH_STATUS_NULL_POINTER,
/// PLANISH_STATUS_INVALID_ARGUMENT (an option), PLANISH_STATUS_INDEX and PLANISH_STATUS_TOPOLOGY (sharp edges; the
/// index is the edge), PLANISH_STATUS_DEGENERATE (a triangle is flat or turned over in the parameters; it is the
/// index), PLANISH_STATUS_SINGULAR, PLANISH_STATUS_VERSION, PLANISH_STATUS_CANCELLED, or what
/// planish_mesh_parameterize() and planish_d1rc_new() return.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_d1rc_fit(
    mesh: *const planish_mesh,
    options: *const planish_d1rc_options,
    out_surface: *mut *mut planish_surface,
    out_report: *mut planish_fit_report,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let mesh = &deref(mesh, "mesh")?.0;
        let given = self::options(options)?;
        let count = mesh.points().len();
        let handle = (out_surface, "out_surface");
        let outputs = FitOutputs::new(handle, out_report, given.out_parameters, given.out_errors, count)?;
        if given.corner_count != 0 {
            return Err(ArgumentError::NotNull { name: "corners" }.into());
        }
        let sharp_edges = edges(given.sharp_edges, given.sharp_edge_count, "sharp_edges")?;
        let core = core(&given, &sharp_edges, count)?;
        let fit =
            with_control(given.thread_count, listener!(given), |control| fit_mesh(mesh, &core, control))??;
        Ok(outputs.store(planish_surface::into_raw(fit.surface), &fit.parameters, &fit.errors, &fit.report))
    })
}

/// # Safety
/// The pointers of the options are as the header says, for `count` nodes.
unsafe fn core<'a>(
    given: &planish_d1rc_options,
    sharp_edges: &'a [[u32; 2]],
    count: usize,
) -> Result<D1rcFitOptions<'a>, ArgumentError> {
    let defaults = D1rcFitOptions::default();
    // SAFETY: the caller's promise.
    unsafe {
        Ok(D1rcFitOptions {
            tolerance: tolerance(given.tolerance, given.tolerance_scale)?,
            surface: given.to_core()?,
            control_mesh: match given.control_mesh {
                at if at.is_null() => None,
                at => Some(&deref(at, "control_mesh")?.0),
            },
            sharp_edges,
            sharp_angle: (given.sharp_angle != 0.0).then_some(given.sharp_angle),
            control_count: given.control_count,
            max_control_count: given.max_control_count,
            smoothing: given.smoothing,
            correction_sweeps: given.correction_sweeps as usize,
            parameterize: match given.parameterize {
                at if at.is_null() => defaults.parameterize,
                at => planish_parameterize_options::of_fit(at)?,
            },
            weights: slice_or_none(given.weights, count, "weights")?,
            ..defaults
        })
    }
}
