//! Questions to models: values, closest points, deviation, tessellation, VTK.

use super::arguments::{
    self, ArgumentError, ReportOut, array_len, choice, copy_rows, deref, flag, options, out, rows_or_none,
    slice, slice_mut, slice_mut_or_none, stride,
};
use super::export::{planish_vtk_content, planish_vtk_options};
use super::field::planish_gradient_options;
use super::guard::{Failure, guard};
use super::mesh::planish_mesh;

use super::model::{PLANISH_NONE, planish_model};
use super::planish_status;
use super::progress::{thread_count, with_control};
use super::query::{
    planish_deviation_options, planish_deviation_report, planish_project_options, planish_tessellate_options,
    planish_tessellate_report,
};
use super::report::write_pairs;
use super::surface_eval::{derivative_order, planish_eval_options, status_of_values};
use crate::control::{Pool, Stage};
use crate::export::vtk;
use crate::model::{ModelField, ModelProjector, ModelTessellation};
use crate::query::deviation::{DeviationError, DeviationOptions};
use crate::query::gradient;
use crate::query::project::ProjectOptions;
use crate::surface::MAX_DERIVATIVE;
use crate::surface::evaluate::{self, Quantity};
use glam::{DVec2, DVec3};
use libc::c_char;

/// Evaluates at parameters on faces.
///
/// # Safety
/// The pointers are NULL or as the header says.
unsafe fn eval(
    model: *const planish_model,
    quantity: Quantity,
    (faces, uv): (*const u32, *const f64),
    count: usize,
    options: *const planish_eval_options,
    out: *mut f64,
    name: &'static str,
) -> Result<planish_status, Failure> {
    // SAFETY: the caller's promises.
    unsafe {
        let model = deref(model, "model")?;
        let given = self::options(options)?;
        let rule = given.rule()?;
        let faces = slice(faces, count, "faces")?;
        let uv = copy_rows(uv, count, stride(given.uv_stride, 2, "uv_stride")?, "uv", DVec2::from_array)?;
        let width = quantity.width(model.field().map_or(3, ModelField::dim));
        let output = given.output((out, name), count, width)?;
        let pool = Pool::for_pieces(thread_count(given.thread_count)?, evaluate::piece_count(count));
        let values = match (model.field(), quantity) {
            (Some(field), Quantity::Derivatives(order)) => field.evaluate(order, faces, &uv, rule, &pool)?,
            _ => model.core()?.evaluate(quantity, faces, &uv, rule, &pool)?,
        };
        for (to, row) in output.rows.chunks_mut(output.stride).zip(values.rows.chunks_exact(width)) {
            to[..width].copy_from_slice(row);
        }
        output.flags.iter_mut().zip(&values.flags).for_each(|(to, flag)| *to = *flag);
        Ok(status_of_values(rule, values.outside))
    }
}

/// Evaluates a model, or a field over its faces, and derivatives at parameters on the faces. On a spline u and v are those of
/// the surface of planish_model_copy_face(); on a plane those of that surface too; on a cylinder the angle in radians and the height.
///
/// model:          not NULL.
/// faces:          for each point its face, below planish_model_face_count().
/// uv:             count rows of u, v; rows start options->uv_stride doubles apart.
/// count:          may be 0.
/// max_derivative: 0, 1 or 2.
/// options:        NULL for the defaults.
/// out:            receives for each point 1, 3 or 6 rows of planish_model_dim() numbers: S; Su, Sv; Suu, Suv, Svv.
///                 Points start options->out_stride doubles apart. It must not overlap uv.
/// Arrays: faces[count], uv[count, 2], out[count, *, model_dim].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_POINTS_OUTSIDE (with PLANISH_OUTSIDE_FLAG), PLANISH_STATUS_NULL_POINTER,
/// PLANISH_STATUS_INVALID_ARGUMENT (an option, or max_derivative), PLANISH_STATUS_INDEX (a face; the index is the point),
/// PLANISH_STATUS_OUTSIDE (with PLANISH_OUTSIDE_FAIL; the index is the first such point of the first such face),
/// PLANISH_STATUS_NOT_FINITE (the index is the point), PLANISH_STATUS_TOO_LARGE or PLANISH_STATUS_VERSION.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_eval(
    model: *const planish_model,
    faces: *const u32,
    uv: *const f64,
    count: usize,
    max_derivative: u32,
    options: *const planish_eval_options,
    out: *mut f64,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let order = derivative_order(max_derivative, MAX_DERIVATIVE)?;
        eval(model, Quantity::Derivatives(order), (faces, uv), count, options, out, "out")
    })
}

/// The gradient in space of a field over the faces of a model: for each component the vector, tangential to the model,
/// that gives its change along it.
///
/// shape:         not NULL, in space: the model that the field was fitted over.
/// field:         not NULL, of planish_field_fitter_fit_model().
/// faces:         for each point its face, below planish_model_face_count().
/// uv:            count rows of u, v on the faces; rows start options->uv_stride doubles apart.
/// count:         may be 0.
/// options:       NULL for the defaults.
/// out_gradients: receives count times planish_model_dim() of the field rows of 3 numbers; NaN where the model has no
///                tangent plane.
/// Arrays: faces[count], uv[count, 2], out_gradients[count, model_dim, 3].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND (shape is a field, or field is
/// none), PLANISH_STATUS_INVALID_ARGUMENT (an option; the numbers of faces differ), PLANISH_STATUS_INDEX (a face),
/// PLANISH_STATUS_NOT_FINITE, PLANISH_STATUS_OUTSIDE (the index is the point for all three), PLANISH_STATUS_TOO_LARGE or
/// PLANISH_STATUS_VERSION.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_field_gradient(
    shape: *const planish_model,
    field: *const planish_model,
    faces: *const u32,
    uv: *const f64,
    count: usize,
    options: *const planish_gradient_options,
    out_gradients: *mut f64,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let shape = deref(shape, "shape")?.core()?;
        let (name, found, needed) = ("field", "a model in space", "a field over its faces");
        let wrong = ArgumentError::OtherKind { name, found, needed };
        let field = deref(field, "field")?.field().ok_or(wrong)?;
        let given = self::options(options)?;
        if given.reserved != 0 {
            let record = "planish_gradient_options";
            return Err(ArgumentError::Reserved { record, given: given.reserved }.into());
        }
        let faces = slice(faces, count, "faces")?;
        let uv = copy_rows(uv, count, stride(given.uv_stride, 2, "uv_stride")?, "uv", DVec2::from_array)?;
        let rows = array_len::<f64>(count, field.dim(), "out_gradients")?;
        let out_gradients =
            slice_mut(out_gradients, array_len::<f64>(rows, 3, "out_gradients")?, "out_gradients")?;
        let pool = Pool::for_pieces(thread_count(given.thread_count)?, gradient::piece_count(count));
        out_gradients.copy_from_slice(&field.gradient(shape, faces, &uv, &pool)?);
        Ok(())
    })
}

/// Computes unit normals of a model, out of the fronts of its faces.
///
/// model:       not NULL.
/// faces:       for each point its face, below planish_model_face_count().
/// uv:          count rows of u, v; rows start options->uv_stride doubles apart.
/// count:       may be 0.
/// options:     NULL for the defaults.
/// out_normals: receives count rows of 3 numbers; NaN where there is no normal. Rows start options->out_stride
///              doubles apart. It must not overlap uv.
/// Arrays: faces[count], uv[count, 2], out_normals[count, 3].
/// Returns what planish_model_eval() returns.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_normals(
    model: *const planish_model,
    faces: *const u32,
    uv: *const f64,
    count: usize,
    options: *const planish_eval_options,
    out_normals: *mut f64,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        eval(model, Quantity::Normals, (faces, uv), count, options, out_normals, "out_normals")
    })
}

/// Computes principal curvatures of a model and their directions.
///
/// model:   not NULL.
/// faces:   for each point its face, below planish_model_face_count().
/// uv:      count rows of u, v; rows start options->uv_stride doubles apart.
/// count:   may be 0.
/// options: NULL for the defaults.
/// out:     receives count rows of 8 numbers: k1, k2 with k1 >= k2, positive where the face bends towards its normal,
///          then the unit tangents d1 and d2 of 3 numbers each, with d1 x d2 the normal; NaN where there is no
///          normal. Rows start options->out_stride doubles apart. It must not overlap uv.
/// Arrays: faces[count], uv[count, 2], out[count, 8].
/// Returns what planish_model_eval() returns.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_curvatures(
    model: *const planish_model,
    faces: *const u32,
    uv: *const f64,
    count: usize,
    options: *const planish_eval_options,
    out: *mut f64,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe { eval(model, Quantity::Curvatures, (faces, uv), count, options, out, "out") })
}

/// Finds the place on a model nearest to each point, over all faces, inside their loops.
///
/// model:         not NULL.
/// points:        count rows of x, y, z.
/// count:         number of points; with 0 nothing is done.
/// options:       NULL for the defaults; guesses must be NULL, keep_trims is not used.
/// out_faces:     receives the face of each; PLANISH_NONE for points farther away than max_distance. NULL for none.
/// out_uv:        receives count rows u, v on the face's surface, NaN for such points; NULL for none.
/// out_distances: receives count distances, NaN for such points; NULL for none.
/// Arrays: points[count, 3], out_faces[count], out_uv[count, 2], out_distances[count].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_POINTS_OUTSIDE (some points are farther than max_distance),
/// PLANISH_STATUS_NOT_PROVEN (some answers are flagged), PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_NOT_FINITE (the
/// index is the point), PLANISH_STATUS_INVALID_ARGUMENT, PLANISH_STATUS_TOO_LARGE, PLANISH_STATUS_CANCELLED or PLANISH_STATUS_VERSION.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_project(
    model: *const planish_model,
    points: *const f64,
    count: usize,
    options: *const planish_project_options,
    out_faces: *mut u32,
    out_uv: *mut f64,
    out_distances: *mut f64,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let model = deref(model, "model")?.core()?;
        let given = self::options(options)?;
        if !given.guesses.is_null() {
            return Err(ArgumentError::NotNull { name: "guesses" }.into());
        }
        let points: Vec<DVec3> = copy_rows(points, count, 3, "points", DVec3::from_array)?;
        let core = ProjectOptions { max_distance: given.max_distance, ..ProjectOptions::default() };
        let out_faces = slice_mut_or_none(out_faces, count, "out_faces")?;
        let out_uv = slice_mut_or_none(out_uv, array_len::<f64>(count, 2, "out_uv")?, "out_uv")?;
        let out_distances = slice_mut_or_none(out_distances, count, "out_distances")?;
        let out_flags = slice_mut_or_none(given.out_flags, count, "out_flags")?;
        let feet = with_control(given.thread_count, listener!(given), |control| {
            control.enter(Stage::Project);
            ModelProjector::new(model)?.project(&points, &core, control.pool())
        })??;
        let number =
            |face: &Option<crate::model::FaceId>| face.map_or(PLANISH_NONE, |face| face.index() as u32);
        out_faces.into_iter().flatten().zip(&feet.faces).for_each(|(to, face)| *to = number(face));
        out_uv.into_iter().for_each(|to| write_pairs(&feet.uv, to));
        out_distances.into_iter().for_each(|to| to.copy_from_slice(&feet.distances));
        out_flags.into_iter().for_each(|to| to.copy_from_slice(&feet.flags));
        Ok(match (feet.faces.contains(&None), feet.unproven()) {
            (true, _) => planish_status::PointsOutside,
            (false, 0) => planish_status::Ok,
            _ => planish_status::NotProven,
        })
    })
}

/// Measures how far the nodes of a mesh lie from a model: closest-point distances, over all faces.
///
/// model:         not NULL.
/// mesh:          not NULL.
/// options:       NULL for the defaults; use_parameters and keep_trims are not used.
/// out_distances: receives planish_mesh_point_count() distances; NULL for none.
/// count:         doubles that out_distances has room for.
/// out_report:    receives the sizes of the distances; NULL for none. worst_back_u and worst_back_v are NaN.
/// Arrays: out_distances[count].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NOT_PROVEN (some distances are not proved to be the least ones, as
/// unproven_count says), PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option),
/// PLANISH_STATUS_BUFFER_TOO_SMALL, PLANISH_STATUS_TOPOLOGY or PLANISH_STATUS_TOO_LARGE (measuring back only),
/// PLANISH_STATUS_CANCELLED or PLANISH_STATUS_VERSION.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_deviation(
    model: *const planish_model,
    mesh: *const planish_mesh,
    options: *const planish_deviation_options,
    out_distances: *mut f64,
    count: usize,
    out_report: *mut planish_deviation_report,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let model = deref(model, "model")?.core()?;
        let mesh = &deref(mesh, "mesh")?.0;
        let given = self::options(options)?;
        let report = ReportOut::new(out_report)?;
        let out_distances = rows_or_none(out_distances, count, mesh.points().len(), 1, "out_distances")?;
        let core = DeviationOptions {
            measure_back: flag(given.measure_back, "measure_back")?,
            chord_tolerance: given.chord_tolerance,
            max_edge_length: given.max_edge_length,
            ..DeviationOptions::default()
        };
        let needed = mesh.points().len();
        let out_signed = slice_mut_or_none(given.out_signed, needed, "out_signed")?;
        let out_uv = slice_mut_or_none(given.out_uv, array_len::<f64>(needed, 2, "out_uv")?, "out_uv")?;
        let out_faces = slice_mut_or_none(given.out_faces, needed, "out_faces")?;
        let (result, sides) = with_control(given.thread_count, listener!(given), |control| {
            control.enter(Stage::Project);
            let found = model.deviation(mesh, &core, control.pool())?;
            let sides = out_signed.is_some().then(|| model.signed(mesh, &found, control.pool()));
            Ok::<_, DeviationError>((found, sides))
        })??;
        if let (Some(to), Some(sides)) = (out_signed, sides) {
            to.copy_from_slice(&sides);
        }
        if let Some(to) = out_uv {
            write_pairs(&result.uv, to);
        }
        if let Some(to) = out_faces {
            let numbers =
                result.faces.iter().map(|face| face.map_or(PLANISH_NONE, |face| face.index() as u32));
            to.iter_mut().zip(numbers).for_each(|(to, number)| *to = number);
        }
        out_distances.into_iter().for_each(|to| to.copy_from_slice(&result.nodes.each));
        report.store(planish_deviation_report {
            max_distance: result.nodes.max,
            rms_distance: result.nodes.rms,
            mean_distance: result.nodes.mean,
            max_back_distance: result.max_back_distance,
            worst_back_u: f64::NAN,
            worst_back_v: f64::NAN,
            worst_index: result.nodes.worst_index,
            back_count: result.back_count,
            unproven_count: result.unproven,
            ..planish_deviation_report::default().with_percentiles(&result.nodes.each)
        });
        Ok(if result.unproven > 0 { planish_status::NotProven } else { planish_status::Ok })
    })
}

/// Makes a triangle mesh of a model: watertight, with one polyline for each edge, closed where a shell is. Its nodes lie
/// on the model.
///
/// model:    not NULL.
/// options:  NULL for the defaults; keep_trims is not used.
/// out_mesh: receives a new mesh; destroy with planish_mesh_free().
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option),
/// PLANISH_STATUS_TOPOLOGY (loops cross), PLANISH_STATUS_DEGENERATE, PLANISH_STATUS_TOO_LARGE (more than
/// max_point_count nodes), PLANISH_STATUS_CANCELLED or PLANISH_STATUS_VERSION.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_tessellate(
    model: *const planish_model,
    options: *const planish_tessellate_options,
    out_mesh: *mut *mut planish_mesh,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let model = deref(model, "model")?.core()?;
        let out_mesh = out(out_mesh, "out_mesh")?;
        let given = self::options(options)?;
        let report = ReportOut::new(given.out_report)?;
        let core = given.core()?;
        let ModelTessellation { mesh, smallest_angle, chord_error, .. } =
            with_control(given.thread_count, listener!(given), |control| {
                control.enter(Stage::Tessellate);
                model.tessellate_by(&core, control.pool())
            })??;
        report.store(planish_tessellate_report { smallest_angle, chord_error, ..Default::default() });
        out_mesh.write(planish_mesh::into_raw(mesh));
        Ok(())
    })
}

/// Writes the triangles of a model as a VTK file: those of planish_model_tessellate() with the number of the face as
/// cell data "face", or those of a mesh to compare with, each node moved to its nearest place on the model, with the
/// distance as point data "deviation".
///
/// model:   not NULL.
/// path:    ends with a NUL; on Unix any bytes, elsewhere UTF-8. An existing file is replaced, see planish_mesh_write().
/// options: NULL for the defaults; content must be PLANISH_VTK_CONTENT_TRIANGLES.
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option, a path that is
/// not UTF-8), PLANISH_STATUS_FILE, or what planish_model_tessellate() or planish_model_deviation() return.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_model_write_vtk(
    model: *const planish_model,
    path: *const c_char,
    options: *const planish_vtk_options,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let model = deref(model, "model")?.core()?;
        let path = arguments::path(path, "path")?;
        let given = self::options(options)?;
        choice(given.content, &[planish_vtk_content::Triangles], "content")?;
        let core = given.triangles()?;
        Ok(with_control(given.thread_count, listener!(given), |control| {
            control.enter(Stage::Write);
            vtk::write_model(model, &core, path, control.pool())
        })??)
    })
}
