//! Questions to meshes: nearest places.

use super::arguments::{array_len, copy_rows, deref, options, slice_mut_or_none, unused};
use super::guard::guard;
use super::mesh::planish_mesh;
use super::model::PLANISH_NONE;
use super::planish_status;
use super::progress::with_control;
use super::query::planish_project_options;
use crate::control::Stage;
use crate::query::project::ProjectOptions;
use crate::query::triangles::TriangleTree;
use glam::DVec3;

/// Finds the place on a mesh nearest to each point, and the triangle that it lies on.
///
/// For points of a model this is the way back to the mesh that it was fitted to: evaluate the model where you want to
/// know, with planish_model_eval(), and ask here for the triangle, and so for the label, that the place came from. That
/// holds for a face of several labels too, of which planish_face_info tells only one. A place no farther from a line
/// between labels, or from the other side of a wall, than from its own triangle may get either.
///
/// Each call sorts the triangles before it searches them: ask for many points at once.
///
/// mesh:          not NULL.
/// points:        count rows of x, y, z.
/// count:         number of points; with 0 nothing is done.
/// options:       NULL for the defaults; guesses and out_flags must be NULL, keep_trims 1.
/// out_triangles: receives the triangle of each, counted from 0, one of them where several are equally near;
///                PLANISH_NONE for points farther away than max_distance, or farther than a double can square. NULL for
///                none.
/// out_points:    receives count rows of x, y, z, the nearest places, NaN for such points; NULL for none.
/// out_distances: receives count distances in model units, NaN for such points; NULL for none.
/// Arrays: points[count, 3], out_triangles[count], out_points[count, 3], out_distances[count].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_POINTS_OUTSIDE (there are such points), or an error:
/// PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_NOT_FINITE (the index is the point), PLANISH_STATUS_INVALID_ARGUMENT (an
/// option), PLANISH_STATUS_TOO_LARGE, PLANISH_STATUS_OUT_OF_MEMORY, PLANISH_STATUS_VERSION or PLANISH_STATUS_CANCELLED.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_mesh_project(
    mesh: *const planish_mesh,
    points: *const f64,
    count: usize,
    options: *const planish_project_options,
    out_triangles: *mut u32,
    out_points: *mut f64,
    out_distances: *mut f64,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let mesh = &deref(mesh, "mesh")?.0;
        let given = self::options(options)?;
        let call = "planish_mesh_project";
        unused(given.guesses.is_null(), "guesses", call)?;
        unused(given.out_flags.is_null(), "out_flags", call)?;
        unused(given.keep_trims == 1, "keep_trims", call)?;
        let points: Vec<DVec3> = copy_rows(points, count, 3, "points", DVec3::from_array)?;
        let core = ProjectOptions { max_distance: given.max_distance, ..ProjectOptions::default() };
        let out_triangles = slice_mut_or_none(out_triangles, count, "out_triangles")?;
        let out_points =
            slice_mut_or_none(out_points, array_len::<f64>(count, 3, "out_points")?, "out_points")?;
        let out_distances = slice_mut_or_none(out_distances, count, "out_distances")?;
        let nearest = with_control(given.thread_count, listener!(given), |control| {
            control.enter(Stage::Project);
            control.report(0.0, f64::NAN)?;
            TriangleTree::watched(mesh, control.pool().watch()).project(&points, &core, control.pool())
        })??;
        for (to, place) in out_triangles.into_iter().flatten().zip(&nearest) {
            *to = place.map_or(PLANISH_NONE, |place| place.triangle);
        }
        let rows = out_points.into_iter().flat_map(|to| to.chunks_exact_mut(3));
        for (row, place) in rows.zip(&nearest) {
            place.map_or(DVec3::NAN, |place| place.point).write_to_slice(row);
        }
        for (to, place) in out_distances.into_iter().flatten().zip(&nearest) {
            *to = place.map_or(f64::NAN, |place| place.distance);
        }
        let is_outside = nearest.contains(&None);
        Ok(if is_outside { planish_status::PointsOutside } else { planish_status::Ok })
    })
}
