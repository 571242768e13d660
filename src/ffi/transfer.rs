//! Values and forces between meshes whose nodes do not match.

use super::arguments::{
    ArgumentError, ReportOut, array_len, choice, copy_rows, deref, options, out, rows_mut, slice,
};
use super::choices::{planish_tolerance_scale, tolerance_scale};
use super::field::{fitter_on_mesh, planish_field_options, with_field_options};
use super::guard::{Failure, guard};
use super::mesh::planish_mesh;
use super::model::planish_model;
use super::planish_status;
use super::report::write_pairs;
use super::status::query;
use crate::control::Control;
use crate::fit::common::FitError;
use crate::fit::field::transfer::{
    Balance, Carry, FarRule, Transfer, TransferError, TransferOptions, TransferReport,
};
use crate::fit::field::{FieldError, FieldOptions};
use crate::fit::found_grid::SampleField;
use crate::fit::model::field::ModelFieldFitter;
use crate::fit::model::field::transfer::ModelTransfer;
use crate::mesh::Mesh;
use glam::DVec3;

/// Carries values from the nodes of a source mesh to target points, and forces on these back to the nodes. Made by
/// planish_transfer_new(), destroyed by planish_transfer_free().
///
/// Calls that take it const may run at once on any threads.
pub struct planish_transfer(Box<dyn Carry>);

const _: () = {
    const fn is_shared<T: Send + Sync>() {}
    is_shared::<planish_transfer>();
};

/// What happens to targets beyond max_distance.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_far_rule {
    /// The first of them is an error, PLANISH_STATUS_OUTSIDE.
    Refuse = 0,
    /// They take part like all others; the call returns PLANISH_STATUS_POINTS_OUTSIDE.
    Keep = 1,
}

record! {
    /// How values are carried. Fill with planish_transfer_options_init(), then change what you need.
    pub struct planish_transfer_options (planish_transfer_options_init) {
        /// How fields on the source are fitted: the grid (given, found for a sample field, or chosen from the number of
        /// nodes, about four of them a coefficient), mask, weights; also threads and progress of the transfer. NULL
        /// (default) for the defaults. Borrowed for the call.
        pub field: *const planish_field_options,
        /// How far from the source's surface a target may lie, measured in distance_scale, not negative; infinity for
        /// anywhere. Default 0.05.
        pub max_distance: f64 = TransferOptions::default().max_distance,
        /// A planish_tolerance_scale: of the diagonal of the source's points, or model units. Default
        /// PLANISH_TOLERANCE_SCALE_RELATIVE.
        pub distance_scale: u32 = planish_tolerance_scale::Relative as u32,
        /// A planish_far_rule. Default PLANISH_FAR_RULE_REFUSE.
        pub far_rule: u32 = planish_far_rule::Refuse as u32,
    }
}

record! {
    /// How well source and targets lie on one another. Set struct_size to sizeof(planish_transfer_report) before the
    /// call; the report is filled as far as that goes, on success only. Lengths are in model units.
    pub struct planish_transfer_report {
        /// The largest distance of a target to the source's surface.
        pub max_distance: f64,
        /// Square root of the mean of its square.
        pub rms_distance: f64,
        /// The distance that was allowed.
        pub limit: f64,
        /// The largest distance between a node of the source and its surface at the node's (u,v).
        pub max_shape_error: f64,
        /// Square root of the mean of its square.
        pub rms_shape_error: f64,
        /// Wall time in all, in seconds.
        pub seconds: f64,
        /// The target with the largest distance, counted from 0.
        pub farthest_index: usize,
        /// Targets beyond the limit.
        pub far_count: usize,
        /// Knots of the grid along u.
        pub grid_u: usize,
        /// Knots of the grid along v.
        pub grid_v: usize,
        /// Unknowns of a fit on the grid.
        pub coefficient_count: usize,
        /// Everything worth knowing of the source's surface: bits of planish_remark.
        pub remarks: u64,
    }
}

impl From<&TransferReport> for planish_transfer_report {
    fn from(report: &TransferReport) -> Self {
        Self {
            struct_size: size_of::<Self>(),
            max_distance: report.max_distance,
            rms_distance: report.rms_distance,
            limit: report.limit,
            max_shape_error: report.shape.max_error,
            rms_shape_error: report.shape.rms_error,
            seconds: report.seconds,
            farthest_index: report.farthest_index,
            far_count: report.far_count,
            grid_u: report.shape.grid_u,
            grid_v: report.shape.grid_v,
            coefficient_count: report.shape.coefficient_count,
            remarks: report.shape.remarks.0,
        }
    }
}

record! {
    /// What a transfer keeps of forces, moments and work. Set struct_size to sizeof(planish_balance_report) before the
    /// call; the report is filled as far as that goes, on success only.
    pub struct planish_balance_report {
        /// Sum of the forces on the targets.
        pub force_given: [f64; 3],
        /// Sum of the forces that arrive at the nodes of the source.
        pub force_arrived: [f64; 3],
        /// Length of the difference, as a fraction of the sum of the lengths of the forces given: roundoff.
        pub force_error: f64,
        /// Moment of the forces on the targets.
        pub moment_given: [f64; 3],
        /// Moment of the forces that arrive.
        pub moment_arrived: [f64; 3],
        /// Length of the difference.
        pub moment_error: f64,
        /// What moment_error cannot exceed but by roundoff: the sum over the targets of the force's length times the
        /// distance to the source's surface.
        pub moment_bound: f64,
        /// Work of the forces given along the displacements that arrive at the targets.
        pub work_given: f64,
        /// Work of the forces that arrive along the displacements given.
        pub work_arrived: f64,
        /// The difference, as a fraction of the sum of the targets' works without their signs: roundoff.
        pub work_error: f64,
    }
}

impl From<&Balance> for planish_balance_report {
    fn from(balance: &Balance) -> Self {
        Self {
            struct_size: size_of::<Self>(),
            force_given: balance.force_given.to_array(),
            force_arrived: balance.force_arrived.to_array(),
            force_error: balance.force_error,
            moment_given: balance.moment_given.to_array(),
            moment_arrived: balance.moment_arrived.to_array(),
            moment_error: balance.moment_error,
            moment_bound: balance.moment_bound,
            work_given: balance.work_given,
            work_arrived: balance.work_arrived,
            work_error: balance.work_error,
        }
    }
}

/// Makes a transfer: `make_fitter` says how fields on the source are fitted, `make` makes the transfer of that.
///
/// # Safety
/// The pointers are NULL or as the header says.
unsafe fn make_transfer<F: Send, T: Carry + Send + 'static>(
    (targets, count): (*const f64, usize),
    source: &Mesh,
    options: *const planish_transfer_options,
    (out_transfer, out_report): (*mut *mut planish_transfer, *mut planish_transfer_report),
    make_fitter: impl FnOnce(&FieldOptions, Option<SampleField>, &mut Control) -> Result<F, FieldError> + Send,
    make: impl FnOnce(F, &[DVec3], &TransferOptions, &mut Control) -> Result<(T, TransferReport), TransferError>
    + Send,
) -> Result<planish_status, Failure> {
    // SAFETY: the caller's promises.
    unsafe {
        let targets = copy_rows(targets, count, 3, "targets", DVec3::from_array)?;
        let given = self::options(options)?;
        let (out_transfer, report) = (out(out_transfer, "out_transfer")?, ReportOut::new(out_report)?);
        let distance_scale = tolerance_scale(given.distance_scale, "distance_scale")?;
        let far = choice(given.far_rule, &[FarRule::Refuse, FarRule::Keep], "far_rule")?;
        let field: planish_field_options = self::options(given.field)?;
        let (transfer, made) =
            with_field_options(field, source.points().len(), |field, sample, control| {
                let max_distance = given.max_distance;
                let core = TransferOptions { field: *field, max_distance, distance_scale, far };
                core.check(&targets)?;
                let fitter = control.within(0.0, 0.5, |control| make_fitter(field, sample, control))?;
                control.within(0.5, 1.0, |control| make(fitter, &targets, &core, control))
            })??;
        report.store((&made).into());
        out_transfer.write(Box::into_raw(Box::new(planish_transfer(Box::new(transfer)))));
        Ok(if made.far_count > 0 { planish_status::PointsOutside } else { planish_status::Ok })
    }
}

/// Makes a transfer from the nodes of a mesh to points near it. The points of the mesh are fitted by a surface over its
/// parameters or, if it has none, over those it is given here; each target is projected onto that once, inside the
/// mesh's boundary. It keeps what it needs; mesh and points may go.
///
/// source:       not NULL.
/// targets:      count rows of x, y, z.
/// count:        may be 0.
/// options:      NULL for the defaults.
/// out_transfer: receives a new transfer; destroy with planish_transfer_free().
/// out_report:   receives how well the two lie on one another; NULL for no report.
/// Arrays: targets[count, 3].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_POINTS_OUTSIDE (targets beyond max_distance were kept), or an error:
/// PLANISH_STATUS_OUTSIDE (a target lies beyond it; the index is the target), PLANISH_STATUS_NOT_FINITE (a target; the
/// index), PLANISH_STATUS_INVALID_ARGUMENT (an option), or what planish_field_fitter_new() returns.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_transfer_new(
    source: *const planish_mesh,
    targets: *const f64,
    count: usize,
    options: *const planish_transfer_options,
    out_transfer: *mut *mut planish_transfer,
    out_report: *mut planish_transfer_report,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let source = &deref(source, "source")?.0;
        make_transfer(
            (targets, count),
            source,
            options,
            (out_transfer, out_report),
            |field, sample, control| fitter_on_mesh(source, field, sample, control),
            |fitter, targets, options, control| {
                Transfer::with_fitter(fitter, source, targets, options, control)
            },
        )
    })
}

/// Makes a transfer from the nodes of the mesh that a model was fitted to, closed and of any genus, to points near it.
/// Fields are those of planish_field_fitter_new_model(): the points of the mesh are fitted over the patches of the model,
/// and each target is projected onto that shape once. It keeps what it needs; model, mesh and points may go.
///
/// model:        not NULL, made by planish_model_fit() of patches, or a copy of such a model.
/// source:       not NULL, with as many nodes as planish_model_node_count(): the mesh, perhaps moved.
/// targets:      count rows of x, y, z.
/// count:        may be 0.
/// options:      NULL for the defaults.
/// out_transfer: receives a new transfer; destroy with planish_transfer_free().
/// out_report:   receives how well the two lie on one another, with 0 for the grid; NULL for no report.
/// Arrays: targets[count, 3].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_POINTS_OUTSIDE (targets beyond max_distance were kept), or an error:
/// PLANISH_STATUS_OUTSIDE (a target lies beyond it; the index is the target), PLANISH_STATUS_NOT_FINITE (a target; the
/// index), PLANISH_STATUS_INVALID_ARGUMENT (an option), or what planish_field_fitter_new_model() returns.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_transfer_new_model(
    model: *const planish_model,
    source: *const planish_mesh,
    targets: *const f64,
    count: usize,
    options: *const planish_transfer_options,
    out_transfer: *mut *mut planish_transfer,
    out_report: *mut planish_transfer_report,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let model = deref(model, "model")?.core()?;
        let source = &deref(source, "source")?.0;
        make_transfer(
            (targets, count),
            source,
            options,
            (out_transfer, out_report),
            |field, sample, control| ModelFieldFitter::new(model, source, field, sample, control),
            |fitter, targets, options, control| {
                ModelTransfer::with_fitter(fitter, source, targets, options, control)
            },
        )
    })
}

/// Destroys a transfer.
///
/// transfer: from this library and not destroyed yet; NULL does nothing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_transfer_free(transfer: *mut planish_transfer) {
    query(|| {
        if !transfer.is_null() {
            // SAFETY: the caller's promise.
            drop(unsafe { Box::from_raw(transfer) });
        }
        Ok(())
    });
}

/// Number of nodes of the source, those without values included; 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_transfer_source_count(transfer: *const planish_transfer) -> usize {
    // SAFETY: the caller's promise.
    query(|| Ok(unsafe { deref(transfer, "transfer") }?.0.source_count()))
}

/// Number of targets; 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_transfer_target_count(transfer: *const planish_transfer) -> usize {
    // SAFETY: the caller's promise.
    query(|| Ok(unsafe { deref(transfer, "transfer") }?.0.target_count()))
}

/// Copies where the targets lie on the source's surface.
///
/// transfer: not NULL.
/// out_uv:   receives planish_transfer_target_count() rows of u, v.
/// count:    rows that out_uv has room for.
/// Arrays: out_uv[transfer_target_count, 2].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND (of planish_transfer_new_model()) or
/// PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_transfer_copy_parameters(
    transfer: *const planish_transfer,
    out_uv: *mut f64,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let (name, found) = ("transfer", "one over the patches of a model");
        let wrong = ArgumentError::OtherKind { name, found, needed: "one over a parameter plane" };
        let uv = deref(transfer, "transfer")?.0.parameters().ok_or(wrong)?;
        write_pairs(uv, rows_mut(out_uv, count, uv.len(), 2, "out_uv")?);
        Ok(())
    })
}

/// Copies how far the targets are from the source's surface.
///
/// transfer:      not NULL.
/// out_distances: receives planish_transfer_target_count() distances.
/// count:         distances that out_distances has room for.
/// Arrays: out_distances[transfer_target_count].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_transfer_copy_distances(
    transfer: *const planish_transfer,
    out_distances: *mut f64,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let distances = deref(transfer, "transfer")?.0.distances();
        rows_mut(out_distances, count, distances.len(), 1, "out_distances")?.copy_from_slice(distances);
        Ok(())
    })
}

/// `count` rows of `dim` numbers, of which there must be `expected`.
///
/// # Safety
/// `rows` is NULL or has `count` rows of `dim` numbers.
unsafe fn all_rows<'a>(
    rows: *const f64,
    (count, expected): (usize, usize),
    dim: usize,
    name: &'static str,
) -> Result<&'a [f64], Failure> {
    if count != expected {
        return Err(FitError::Count { what: name, count, expected }.into());
    }
    // SAFETY: the caller's promise.
    Ok(unsafe { slice(rows, array_len::<f64>(count, dim, name)?, name) }?)
}

/// Values at the targets, from values at the nodes of the source: they are fitted, and the fit is evaluated where the
/// targets lie. A constant arrives as it is.
///
/// transfer:   not NULL.
/// values:     count rows of dim numbers, one a node.
/// count:      planish_transfer_source_count().
/// dim:        numbers of a value, at least 1.
/// out_values: receives planish_transfer_target_count() rows of dim numbers; it must not overlap values.
/// Arrays: values[count, dim], out_values[transfer_target_count, dim].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (count, dim),
/// PLANISH_STATUS_NOT_FINITE (the index is the node) or PLANISH_STATUS_TOO_LARGE.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_transfer_apply(
    transfer: *const planish_transfer,
    values: *const f64,
    count: usize,
    dim: usize,
    out_values: *mut f64,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let transfer = deref(transfer, "transfer")?.0.as_ref();
        let values = all_rows(values, (count, transfer.source_count()), dim, "values")?;
        let targets = transfer.target_count();
        Ok(transfer.apply(values, dim, rows_mut(out_values, targets, targets, dim, "out_values")?)?)
    })
}

/// Forces at the nodes of the source, from forces on the targets: the transpose of planish_transfer_apply(), so that
/// both do the same work; the sum of the forces stays.
///
/// transfer:   not NULL.
/// forces:     count rows of dim numbers, one a target.
/// count:      planish_transfer_target_count().
/// dim:        numbers of a force, at least 1.
/// out_forces: receives planish_transfer_source_count() rows of dim numbers, 0 for nodes without values; it must not
///             overlap forces.
/// Arrays: forces[count, dim], out_forces[transfer_source_count, dim].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (count, dim),
/// PLANISH_STATUS_NOT_FINITE (the index is the target) or PLANISH_STATUS_TOO_LARGE.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_transfer_apply_transpose(
    transfer: *const planish_transfer,
    forces: *const f64,
    count: usize,
    dim: usize,
    out_forces: *mut f64,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let transfer = deref(transfer, "transfer")?.0.as_ref();
        let forces = all_rows(forces, (count, transfer.target_count()), dim, "forces")?;
        let nodes = transfer.source_count();
        Ok(transfer.apply_transpose(forces, dim, rows_mut(out_forces, nodes, nodes, dim, "out_forces")?)?)
    })
}

/// Carries displacements one way and forces the other, and adds up forces, moments and work on both sides.
///
/// transfer:      not NULL.
/// displacements: source_count rows of 3 numbers, one a node of the source.
/// source_count:  planish_transfer_source_count().
/// forces:        target_count rows of 3 numbers, one a target.
/// target_count:  planish_transfer_target_count().
/// about:         3 numbers: the point that moments are about; NULL for the origin.
/// out_report:    not NULL; receives the sums.
/// Arrays: displacements[source_count, 3], forces[target_count, 3], about[3].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (a count),
/// PLANISH_STATUS_NOT_FINITE (the index is the node or the target) or PLANISH_STATUS_TOO_LARGE.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_transfer_balance(
    transfer: *const planish_transfer,
    displacements: *const f64,
    source_count: usize,
    forces: *const f64,
    target_count: usize,
    about: *const f64,
    out_report: *mut planish_balance_report,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let transfer = deref(transfer, "transfer")?.0.as_ref();
        let nodes = (source_count, transfer.source_count());
        let displacements = all_rows(displacements, nodes, 3, "displacements")?;
        let forces = all_rows(forces, (target_count, transfer.target_count()), 3, "forces")?;
        let about = if about.is_null() { DVec3::ZERO } else { DVec3::from_slice(slice(about, 3, "about")?) };
        deref(out_report, "out_report")?;
        let report = ReportOut::new(out_report)?;
        report.store((&transfer.balance(displacements, forces, about)?).into());
        Ok(())
    })
}
