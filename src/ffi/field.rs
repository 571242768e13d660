//! Fields fitted again and again.

use super::arguments::{
    ArgumentError, Record, ReportOut, array_len, copy_rows, deref, deref_mut, options, out, rows_mut, slice,
    slice_mut, slice_or_none, stride,
};
use super::choices::{
    ends, energy, missing, planish_ends, planish_energy, planish_missing, planish_tolerance_scale, tolerance,
};
use super::guard::{Failure, guard};
use super::mesh::planish_mesh;
use super::model::planish_model;
use super::progress::{thread_count, with_control};
use super::report::{gravest, planish_fit_report, write_pairs};
use super::status::query;
use super::surface::planish_surface;
use super::{planish_parameterize_options, planish_progress, planish_status};
use crate::control::{Control, Pool};
use crate::fit::common::FitError;
use crate::fit::field::{FieldError, FieldFitter, FieldGrid, FieldNodes, FieldOptions};
use crate::fit::found_grid::{self, SampleField};
use crate::fit::model::field::ModelFieldFitter;
use crate::mesh::Mesh;
use crate::query::gradient::{field_gradient, piece_count};
use crate::surface::tensor::TensorSurface;
use glam::DVec2;
use libc::c_void;

/// Fits fields on the nodes of one mesh, or at the same parameters, again and again: grid, factorization and threads
/// are kept. Made by planish_field_fitter_new(), destroyed by planish_field_fitter_free().
///
/// Calls that take it const may run at once on any threads. A process forked after its first use does not have its
/// threads: calls return PLANISH_STATUS_INVALID_ARGUMENT there, and only planish_field_fitter_free() is left to do. One
/// made with thread_count 1 has no threads and stays of use.
pub struct planish_field_fitter(Fitter);

#[allow(clippy::large_enum_variant, reason = "one for each handle")]
enum Fitter {
    /// Over a parameter plane.
    Plane(FieldFitter),
    /// Over the patches of a model.
    Patches(ModelFieldFitter),
}

impl planish_field_fitter {
    fn into_raw(fitter: Fitter) -> *mut Self {
        Box::into_raw(Box::new(Self(fitter)))
    }

    fn plane(&self) -> Result<&FieldFitter, ArgumentError> {
        match &self.0 {
            Fitter::Plane(fitter) => Ok(fitter),
            Fitter::Patches(_) => {
                let (found, needed) = ("one over the patches of a model", "one over a parameter plane");
                Err(ArgumentError::OtherKind { name: "fitter", found, needed })
            }
        }
    }

    fn patches(&self) -> Result<&ModelFieldFitter, ArgumentError> {
        match &self.0 {
            Fitter::Patches(fitter) => Ok(fitter),
            Fitter::Plane(_) => {
                let (found, needed) =
                    ("one over a parameter plane", "one of planish_field_fitter_new_model()");
                Err(ArgumentError::OtherKind { name: "fitter", found, needed })
            }
        }
    }

    fn node_count(&self) -> usize {
        match &self.0 {
            Fitter::Plane(fitter) => fitter.node_count(),
            Fitter::Patches(fitter) => fitter.node_count(),
        }
    }
}

const _: () = {
    const fn is_shared<T: Send + Sync>() {}
    is_shared::<planish_field_fitter>();
};

record! {
    /// How fields are fitted. Fill with planish_field_options_init(), then change what you need. All pointers are borrowed
    /// for the call.
    pub struct planish_field_options (planish_field_options_init; core: FieldOptions) {
        /// What reports compare the errors with, positive, measured in tolerance_scale. Default 1e-3.
        pub tolerance: f64 = core.tolerance.value,
        /// Weight of the bending energy, positive. Default 1e-6. Where sample_values choose the grid they choose it too.
        pub smoothing: f64 = core.smoothing,
        /// How far the knots reach beyond the nodes, as a fraction of their range, 0 to 10. Default 0.1.
        pub buffer: f64 = core.buffer,
        /// How a mesh without parameters gets them; NULL (default) for the defaults. Not used for points.
        pub parameterize: *const planish_parameterize_options,
        /// A positive weight for each node; NULL (default) for all 1.
        /// Array: [nodes].
        pub weights: *const f64,
        /// For each node 1 if fields have values there, 0 if not: those values are never looked at and may be NaN. NULL
        /// (default) for values at all nodes.
        /// Array: [nodes].
        pub mask: *const u8,
        /// A field for which grid and smoothing are found that meet the tolerance: sample_dim numbers for each node; NULL
        /// (default) for none. grid_u and grid_v must then be 0.
        /// Array: [nodes, sample_dim].
        pub sample_values: *const f64,
        /// Numbers of a value of sample_values.
        pub sample_dim: usize,
        /// Hears of the progress of making the fitter and may cancel; NULL (default) for nobody.
        pub progress: planish_progress,
        /// Handed to progress as it is.
        pub user: *mut c_void,
        /// Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
        pub cancel: *const i32,
        /// Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
        /// Array: [1].
        pub out_stage: *mut u32,
        /// A planish_tolerance_scale. Default PLANISH_TOLERANCE_SCALE_RELATIVE.
        pub tolerance_scale: u32 = planish_tolerance_scale::Relative as u32,
        /// A planish_ends. Default PLANISH_ENDS_NATURAL.
        pub ends: u32 = planish_ends::Natural as u32,
        /// A planish_energy. Default PLANISH_ENERGY_BEAM.
        pub energy: u32 = planish_energy::Beam as u32,
        /// Knots along u, 2 to 8193; 0 (default, then grid_v too) for as many as the nodes bear, at most 129.
        pub grid_u: u32,
        /// Knots along v, 2 to 8193; 0 (default, then grid_u too) for as many as the nodes bear, at most 129.
        pub grid_v: u32,
        /// Threads to keep, at most 1024; 0 (default) for all cores. Results do not depend on it.
        pub thread_count: u32,
        /// A planish_missing: whether values of fields that are NaN are refused or missing. A field that lacks other values
        /// than the one before costs a factorization. Not for fields over models. Default PLANISH_MISSING_REFUSED.
        pub missing: u32 = planish_missing::Refused as u32,
        /// 0.
        pub reserved: u32,
    }
}

/// Runs `work` with the core's options for `count` nodes, the caller's threads and listener.
///
/// # Safety
/// The pointers of the options are NULL or as the header says.
pub(super) unsafe fn with_field_options<R: Send>(
    given: planish_field_options,
    count: usize,
    work: impl FnOnce(&FieldOptions, Option<SampleField>, &mut Control) -> R + Send,
) -> Result<R, Failure> {
    if given.reserved != 0 {
        let record = planish_field_options::NAME;
        return Err(ArgumentError::Reserved { record, given: given.reserved }.into());
    }
    // SAFETY: the caller's promises.
    unsafe {
        let parameterize = planish_parameterize_options::of_fit(given.parameterize)?;
        let weights = slice_or_none(given.weights, count, "weights")?;
        let mask = slice_or_none(given.mask, count, "mask")?;
        let is_known: Option<Vec<bool>> = mask.map(|mask| mask.iter().map(|&known| known != 0).collect());
        let counts = [given.grid_u, given.grid_v];
        let sample = match given.sample_values.is_null() {
            true => None,
            false if counts != [0, 0] => return Err(ArgumentError::NotNull { name: "sample_values" }.into()),
            false => {
                let len = array_len::<f64>(count, given.sample_dim, "sample_values")?;
                let values = slice(given.sample_values, len, "sample_values")?;
                Some(SampleField { values, dim: given.sample_dim })
            }
        };
        let grid = match counts {
            [0, 0] => FieldGrid::Auto,
            counts => FieldGrid::Fixed(counts.map(|count| count as usize)),
        };
        let core = FieldOptions {
            tolerance: tolerance(given.tolerance, given.tolerance_scale)?,
            grid,
            smoothing: given.smoothing,
            buffer: given.buffer,
            ends: ends(given.ends)?,
            energy: energy(given.energy)?,
            weights,
            is_known: is_known.as_deref(),
            missing: missing(given.missing)?,
            parameterize,
        };
        with_control(given.thread_count, listener!(given), |control| work(&core, sample, control))
    }
}

/// A fitter for fields on the nodes of a mesh, on the grid that is found for a sample if there is one.
pub(super) fn fitter_on_mesh(
    mesh: &Mesh,
    options: &FieldOptions,
    sample: Option<SampleField>,
    control: &mut Control,
) -> Result<FieldFitter, FieldError> {
    let Some(sample) = sample else { return FieldFitter::on_mesh(mesh, options, control) };
    let nodes = control.within(0.0, 0.3, |control| FieldNodes::of_mesh(mesh, options, control))?;
    control.within(0.3, 1.0, |control| found_grid::fitter(nodes, &sample, options, control))
}

/// Makes a fitter for fields on the nodes of a mesh, over its parameters or, if it has none, over those it is given
/// here. It keeps what it needs; the mesh may go.
///
/// mesh:       not NULL.
/// options:    NULL for the defaults.
/// out_fitter: receives a new fitter; destroy with planish_field_fitter_free().
/// Returns PLANISH_STATUS_OK or an error: PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option, too
/// few nodes with values), PLANISH_STATUS_NOT_FINITE (a parameter, a weight, a value of sample_values; the index is the
/// node), PLANISH_STATUS_TOPOLOGY (a mesh without parameters that is no disk: a closed one must be cut open first),
/// PLANISH_STATUS_DEGENERATE (all nodes have the same u or v), PLANISH_STATUS_SINGULAR (the nodes do not determine a
/// surface), PLANISH_STATUS_CANCELLED or PLANISH_STATUS_VERSION.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_field_fitter_new(
    mesh: *const planish_mesh,
    options: *const planish_field_options,
    out_fitter: *mut *mut planish_field_fitter,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let mesh = &deref(mesh, "mesh")?.0;
        let (out_fitter, given) = (out(out_fitter, "out_fitter")?, self::options(options)?);
        let fitter = with_field_options(given, mesh.points().len(), |core, sample, control| {
            fitter_on_mesh(mesh, core, sample, control)
        })??;
        out_fitter.write(planish_field_fitter::into_raw(Fitter::Plane(fitter)));
        Ok(())
    })
}

/// Makes a fitter for fields at scattered parameters.
///
/// uv:         count rows of u, v.
/// count:      at least 3.
/// options:    NULL for the defaults.
/// out_fitter: receives a new fitter; destroy with planish_field_fitter_free().
/// Arrays: uv[count, 2].
/// Returns what planish_field_fitter_new() returns, but for PLANISH_STATUS_TOPOLOGY.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_field_fitter_new_points(
    uv: *const f64,
    count: usize,
    options: *const planish_field_options,
    out_fitter: *mut *mut planish_field_fitter,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let uv = copy_rows(uv, count, 2, "uv", DVec2::from_array)?;
        let (out_fitter, given) = (out(out_fitter, "out_fitter")?, self::options(options)?);
        let fitter = with_field_options(given, count, |core, sample, control| match sample {
            None => FieldFitter::at(&uv, core, control),
            Some(sample) => found_grid::fitter(FieldNodes::at(&uv, core)?, &sample, core, control),
        })??;
        out_fitter.write(planish_field_fitter::into_raw(Fitter::Plane(fitter)));
        Ok(())
    })
}

/// Makes a fitter for fields on the nodes of the mesh that a model was fitted to: closed, of any genus, several
/// components. Fields are fitted over the patches of the model by planish_field_fitter_fit_model(), on the cells that the
/// shape needed, or on cells that are split until sample_values keep the tolerance. It keeps what it needs; model and
/// mesh may go.
///
/// model:      not NULL, made by planish_model_fit() of patches, or a copy of such a model.
/// mesh:       not NULL, with as many nodes as planish_model_node_count(): the mesh, perhaps moved.
/// options:    NULL for the defaults; grid_u and grid_v must be 0, buffer, ends, energy and parameterize are not used.
/// out_fitter: receives a new fitter; destroy with planish_field_fitter_free().
/// Returns PLANISH_STATUS_OK or an error: PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND (the model was not
/// fitted, is one chart, or has a face that is no part of a patch), PLANISH_STATUS_INVALID_ARGUMENT (an option, the number
/// of nodes, too few nodes with values), PLANISH_STATUS_NOT_FINITE (a weight, a value of sample_values; the index is the
/// node), PLANISH_STATUS_SINGULAR, PLANISH_STATUS_CANCELLED or PLANISH_STATUS_VERSION.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_field_fitter_new_model(
    model: *const planish_model,
    mesh: *const planish_mesh,
    options: *const planish_field_options,
    out_fitter: *mut *mut planish_field_fitter,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let model = deref(model, "model")?.core()?;
        let mesh = &deref(mesh, "mesh")?.0;
        let (out_fitter, given) = (out(out_fitter, "out_fitter")?, self::options(options)?);
        let fitter = with_field_options(given, mesh.points().len(), |core, sample, control| {
            ModelFieldFitter::new(model, mesh, core, sample, control)
        })??;
        out_fitter.write(planish_field_fitter::into_raw(Fitter::Patches(fitter)));
        Ok(())
    })
}

/// Destroys a fitter.
///
/// fitter: from this library and not destroyed yet; NULL does nothing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_field_fitter_free(fitter: *mut planish_field_fitter) {
    query(|| {
        if !fitter.is_null() {
            // SAFETY: the caller's promise.
            drop(unsafe { Box::from_raw(fitter) });
        }
        Ok(())
    });
}

/// Number of nodes, those without values included; 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_field_fitter_point_count(fitter: *const planish_field_fitter) -> usize {
    // SAFETY: the caller's promise.
    query(|| Ok(unsafe { deref(fitter, "fitter") }?.node_count()))
}

/// Knots of the grid.
///
/// fitter:   not NULL.
/// out_grid: receives 2 numbers: knots along u and v.
/// Arrays: out_grid[2].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER or PLANISH_STATUS_WRONG_KIND (of
/// planish_field_fitter_new_model()).
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_field_fitter_grid(
    fitter: *const planish_field_fitter,
    out_grid: *mut usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let grid = deref(fitter, "fitter")?.plane()?.grid();
        slice_mut(out_grid, 2, "out_grid")?.copy_from_slice(&grid);
        Ok(())
    })
}

/// Copies the (u,v) of the nodes.
///
/// fitter: not NULL.
/// out_uv: receives planish_field_fitter_point_count() rows of u, v.
/// count:  rows that out_uv has room for.
/// Arrays: out_uv[field_fitter_point_count, 2].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND (of
/// planish_field_fitter_new_model()) or PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_field_fitter_copy_parameters(
    fitter: *const planish_field_fitter,
    out_uv: *mut f64,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let uv = deref(fitter, "fitter")?.plane()?.parameters();
        write_pairs(uv, rows_mut(out_uv, count, uv.len(), 2, "out_uv")?);
        Ok(())
    })
}

/// The rows of a field for the `expected` nodes of a fitter.
///
/// # Safety
/// `values` is NULL or has `count` rows of `dim` numbers.
unsafe fn field_values<'a>(
    expected: usize,
    values: *const f64,
    count: usize,
    dim: usize,
) -> Result<&'a [f64], Failure> {
    if count != expected {
        return Err(FitError::Count { what: "the nodes", count, expected }.into());
    }
    // SAFETY: the caller's promise.
    Ok(unsafe { slice(values, array_len::<f64>(count, dim, "values")?, "values") }?)
}

/// Fits a field.
///
/// fitter:      not NULL.
/// values:      count rows of dim numbers, one a node.
/// count:       planish_field_fitter_point_count().
/// dim:         numbers of a value, at least 1.
/// out_surface: receives a new surface over the (u,v) of the nodes; destroy with planish_surface_free().
/// out_report:  receives how good it is, measured on the surface; NULL for no report, which saves the measuring.
/// Arrays: values[count, dim].
/// Returns PLANISH_STATUS_OK, with a report also PLANISH_STATUS_TOLERANCE_NOT_MET, or an error:
/// PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND (of planish_field_fitter_new_model()),
/// PLANISH_STATUS_INVALID_ARGUMENT (count, dim), PLANISH_STATUS_NOT_FINITE (the index is the node),
/// PLANISH_STATUS_SINGULAR (numbers overflow) or PLANISH_STATUS_TOO_LARGE.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_field_fitter_fit(
    fitter: *const planish_field_fitter,
    values: *const f64,
    count: usize,
    dim: usize,
    out_surface: *mut *mut planish_surface,
    out_report: *mut planish_fit_report,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let fitter = deref(fitter, "fitter")?.plane()?;
        let values = field_values(fitter.node_count(), values, count, dim)?;
        let (out_surface, report) = (out(out_surface, "out_surface")?, ReportOut::new(out_report)?);
        let surface = fitter.fit(values, dim)?;
        let status = match out_report.is_null() {
            true => planish_status::Ok,
            false => {
                let measured = fitter.measure(&surface, values, dim)?.fit;
                report.store((&measured).into());
                gravest(measured.remarks.0)
            }
        };
        out_surface.write(planish_surface::into_raw(surface));
        Ok(status)
    })
}

/// Fits a field over the patches of a model. The result is a model of dimension dim with the same faces: a value for each
/// place of a face, with one gradient along the shape on both sides of every edge. planish_model_eval(),
/// planish_model_field_gradient(), planish_model_copy_face(), copies and files are for it too.
///
/// fitter:     not NULL, of planish_field_fitter_new_model().
/// values:     count rows of dim numbers, one a node.
/// count:      planish_field_fitter_point_count().
/// dim:        numbers of a value, at least 1.
/// out_field:  receives a new model of dimension dim; destroy with planish_model_free().
/// out_report: receives how good it is, measured on the field; NULL for no report, which saves the measuring.
/// Arrays: values[count, dim].
/// Returns PLANISH_STATUS_OK, with a report also PLANISH_STATUS_TOLERANCE_NOT_MET, or an error:
/// PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND (a fitter over a parameter plane),
/// PLANISH_STATUS_INVALID_ARGUMENT (count, dim), PLANISH_STATUS_NOT_FINITE (the index is the node),
/// PLANISH_STATUS_SINGULAR (numbers overflow) or PLANISH_STATUS_TOO_LARGE.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_field_fitter_fit_model(
    fitter: *const planish_field_fitter,
    values: *const f64,
    count: usize,
    dim: usize,
    out_field: *mut *mut planish_model,
    out_report: *mut planish_fit_report,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let fitter = deref(fitter, "fitter")?.patches()?;
        let values = field_values(fitter.node_count(), values, count, dim)?;
        let (out_field, report) = (out(out_field, "out_field")?, ReportOut::new(out_report)?);
        let field = fitter.fit(values, dim)?;
        let status = match out_report.is_null() {
            true => planish_status::Ok,
            false => {
                let measured = fitter.measure(&field, values, dim)?.fit;
                report.store((&measured).into());
                gravest(measured.remarks.0)
            }
        };
        out_field.write(planish_model::field_into_raw(field));
        Ok(status)
    })
}

/// Turns a surface of planish_field_fitter_fit() into the one of other values, in its place. Once a field of this dim
/// has been fitted, no memory is asked for that grows with nodes or grid.
///
/// fitter:  not NULL.
/// surface: from this fitter, or of the same grid; changed.
/// values:  count rows of dim numbers, one a node.
/// count:   planish_field_fitter_point_count().
/// dim:     planish_surface_dim() of the surface.
/// Arrays: values[count, dim].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_INVALID_ARGUMENT
/// (count, dim, a surface of another grid), PLANISH_STATUS_NOT_FINITE (the index is the node) or
/// PLANISH_STATUS_SINGULAR (numbers overflow).
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_field_fitter_update(
    fitter: *const planish_field_fitter,
    surface: *mut planish_surface,
    values: *const f64,
    count: usize,
    dim: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let fitter = deref(fitter, "fitter")?.plane()?;
        let values = field_values(fitter.node_count(), values, count, dim)?;
        Ok(fitter.update(deref_mut(surface, "surface")?.tensor_mut()?, values, dim)?)
    })
}

/// The sum of tensor surfaces, each times a factor, exactly: a shape and its displacements, modes and their factors.
/// All are polynomial, over the same domain and of the same dim; degrees and knots may differ.
///
/// surfaces:    count surfaces.
/// factors:     count factors; NULL for all 1.
/// count:       at least 1.
/// out_surface: receives a new surface with the trims of the first; destroy with planish_surface_free().
/// Arrays: surfaces[count], factors[count].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_INVALID_ARGUMENT
/// (count, or a surface does not fit the first; the index is the surface) or PLANISH_STATUS_NOT_FINITE (a factor, or
/// the sum overflows; the index is the factor).
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_tensor_combine(
    surfaces: *const *const planish_surface,
    factors: *const f64,
    count: usize,
    out_surface: *mut *mut planish_surface,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let surfaces = slice(surfaces, count, "surfaces")?;
        let factors = if factors.is_null() { &[][..] } else { slice(factors, count, "factors")? };
        let out_surface = out(out_surface, "out_surface")?;
        let term = |(index, &surface): (usize, &*const planish_surface)| -> Result<_, ArgumentError> {
            Ok((factors.get(index).copied().unwrap_or(1.0), deref(surface, "surfaces")?.tensor()?))
        };
        let terms = surfaces.iter().enumerate().map(term).collect::<Result<Vec<_>, _>>()?;
        out_surface.write(planish_surface::into_raw(TensorSurface::combine(&terms)?));
        Ok(())
    })
}

record! {
    /// How gradients are computed. Fill with planish_gradient_options_init(), then change what you need.
    pub struct planish_gradient_options (planish_gradient_options_init) {
        /// Doubles from one point to the next in `uv`; at least 2, or 0 (default) for 2.
        pub uv_stride: usize,
        /// Threads to use, at most 1024; 0 (default) for all cores. Results do not depend on it.
        pub thread_count: u32,
        /// 0.
        pub reserved: u32,
    }
}

/// The gradient in space of a field over the parameters of a shape: for each component the vector, tangential to the
/// shape, that gives its change along the shape.
///
/// shape:         not NULL, of dimension 3.
/// field:         not NULL, over the same (u,v).
/// uv:            count rows of u, v, inside both domains; rows start options->uv_stride doubles apart.
/// count:         may be 0.
/// options:       NULL for the defaults.
/// out_gradients: receives count times dim rows of 3 numbers, dim being that of the field; NaN where the shape has no
///                tangent plane.
/// Arrays: uv[count, 2], out_gradients[count, surface_dim, 3].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (the dimension of shape,
/// an option), PLANISH_STATUS_NOT_FINITE, PLANISH_STATUS_OUTSIDE (the index is the point for both),
/// PLANISH_STATUS_TOO_LARGE or PLANISH_STATUS_VERSION.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_field_gradient(
    shape: *const planish_surface,
    field: *const planish_surface,
    uv: *const f64,
    count: usize,
    options: *const planish_gradient_options,
    out_gradients: *mut f64,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let (shape, field) = (deref(shape, "shape")?.any(), deref(field, "field")?.any());
        let given = self::options(options)?;
        if given.reserved != 0 {
            let record = "planish_gradient_options";
            return Err(ArgumentError::Reserved { record, given: given.reserved }.into());
        }
        let uv = copy_rows(uv, count, stride(given.uv_stride, 2, "uv_stride")?, "uv", DVec2::from_array)?;
        let rows = array_len::<f64>(count, field.dim(), "out_gradients")?;
        let len = array_len::<f64>(rows, 3, "out_gradients")?;
        let out_gradients = slice_mut(out_gradients, len, "out_gradients")?;
        let pool = Pool::for_pieces(thread_count(given.thread_count)?, piece_count(count));
        Ok(field_gradient(shape, field, &uv, out_gradients, &pool)?)
    })
}
