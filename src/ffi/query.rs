//! Questions to surfaces of any family: tessellation, closest points, deviation.

use super::arguments::{
    ArgumentError, ReportOut, array_len, copy_rows, deref, flag, options, out, slice, slice_mut,
    slice_mut_or_none, unused,
};
use super::guard::guard;
use super::mesh::planish_mesh;
use super::planish_status;
use super::progress::{planish_progress, thread_count, with_control, with_helper};
use super::report::write_pairs;
use super::surface::planish_surface;
use crate::control::Stage;
use crate::query::deviation::{
    DeviationError, DeviationOptions, DeviationReport, check_in_space, deviation_with,
};
use crate::query::project::{ProjectOptions, Projection};
use crate::query::side::signed;
use crate::query::tessellate::{TessellateOptions, Tessellation, tessellate_watched};
use crate::summary::{percentile, sorted_sizes};
use glam::DVec2;
use libc::c_void;

record! {
    /// How fine a tessellation is. Fill with planish_tessellate_options_init(), then change what you need.
    pub struct planish_tessellate_options (planish_tessellate_options_init; core: TessellateOptions) {
        /// Largest distance between the surface and the middles of the edges, in model units, positive; 0 (default)
        /// takes 1e-3 of the surface's diagonal.
        pub chord_tolerance: f64 = core.chord_tolerance,
        /// Longest edge in model units, positive; 0 (default) for no limit.
        pub max_edge_length: f64 = core.max_edge_length,
        /// Most nodes; with more the call fails. Default 4000000.
        pub max_point_count: usize = core.max_points,
        /// Hears of the progress and may cancel; NULL (default) for nobody.
        pub progress: planish_progress,
        /// Handed to progress as it is.
        pub user: *mut c_void,
        /// Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
        pub cancel: *const i32,
        /// Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
        /// Array: [1].
        pub out_stage: *mut u32,
        /// 1 (default) keeps to the part inside the trims, 0 covers the whole domain.
        pub keep_trims: u32 = u32::from(core.keep_trims),
        /// Threads that share the faces of a model, at most 1024; 0 (default) for all cores. A surface takes one. The
        /// result does not depend on it.
        pub thread_count: u32,
        /// Receives how good the mesh is, or NULL (default). Set its struct_size before. Filled on success only; not
        /// looked at where the options are part of others.
        pub out_report: *mut planish_tessellate_report,
    }
}

record! {
    /// How good a tessellation is. Set struct_size to sizeof(planish_tessellate_report) before the call; filled as far
    /// as that goes.
    pub struct planish_tessellate_report {
        /// Smallest angle of a triangle in space, in radians.
        pub smallest_angle: f64,
        /// Largest distance measured between the middle of an edge and the surface, in model units.
        pub chord_error: f64,
    }
}

impl planish_tessellate_options {
    pub(super) fn core(&self) -> Result<TessellateOptions, ArgumentError> {
        thread_count(self.thread_count)?;
        Ok(TessellateOptions {
            chord_tolerance: self.chord_tolerance,
            max_edge_length: self.max_edge_length,
            max_points: self.max_point_count,
            keep_trims: flag(self.keep_trims, "keep_trims")?,
        })
    }
}

/// Makes a triangle mesh of a surface in space. Its nodes lie on the surface and carry their (u,v) as
/// parameters; the trims become its boundary loops.
///
/// surface:  not NULL, of dimension 3.
/// options:  NULL for the defaults.
/// out_mesh: receives a new mesh; destroy with planish_mesh_free().
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option, or the
/// dimension), PLANISH_STATUS_TOPOLOGY (the trims cross), PLANISH_STATUS_DEGENERATE (they enclose no area),
/// PLANISH_STATUS_TOO_LARGE (more than max_point_count nodes) or PLANISH_STATUS_VERSION.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_tessellate(
    surface: *const planish_surface,
    options: *const planish_tessellate_options,
    out_mesh: *mut *mut planish_mesh,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let surface = deref(surface, "surface")?.any();
        let out_mesh = out(out_mesh, "out_mesh")?;
        let given = self::options(options)?;
        let report = ReportOut::new(given.out_report)?;
        let core = given.core()?;
        // results are the same for any number of threads, and one is enough
        let Tessellation { mesh, smallest_angle, chord_error } = with_helper(listener!(given), |control| {
            control.enter(Stage::Tessellate);
            tessellate_watched(surface, &core, control.pool().watch())
        })??;
        report.store(planish_tessellate_report { smallest_angle, chord_error, ..Default::default() });
        out_mesh.write(planish_mesh::into_raw(mesh));
        Ok(())
    })
}

record! {
    /// How points are projected. Fill with planish_project_options_init(), then change what you need.
    pub struct planish_project_options (planish_project_options_init) {
        /// A row u, v near the answer for each point, or NULL (default). It saves time and may choose between
        /// equally near places; the answer is the nearest place all the same. Borrowed.
        /// Array: [points, 2].
        pub guesses: *const f64,
        /// Points farther from the surface than this get NaN, and the call returns
        /// PLANISH_STATUS_POINTS_OUTSIDE. Not negative. Default infinity.
        pub max_distance: f64 = f64::INFINITY,
        /// Hears of the progress and may cancel; NULL (default) for nobody.
        pub progress: planish_progress,
        /// Handed to progress as it is.
        pub user: *mut c_void,
        /// Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
        pub cancel: *const i32,
        /// Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
        /// Array: [1].
        pub out_stage: *mut u32,
        /// 1 (default) looks for the nearest place inside the trims, 0 in the whole domain.
        pub keep_trims: u32 = 1,
        /// Threads to use, at most 1024; 0 (default) for all cores. Results do not depend on it.
        pub thread_count: u32,
        /// Receives the planish_flag bits of each point, of which PLANISH_FLAG_NOT_PROVEN occurs here, or NULL
        /// (default).
        /// Array: [points].
        pub out_flags: *mut u8,
    }
}

/// What a projection came to.
pub(super) fn status_of(projection: &Projection) -> planish_status {
    match (projection.missed(), projection.unproven()) {
        (0, 0) => planish_status::Ok,
        (0, _) => planish_status::NotProven,
        _ => planish_status::PointsOutside,
    }
}

/// Finds the place on a surface nearest to each point, inside its trims unless the options say otherwise.
///
/// On tensor surfaces, T-splines and PHT-splines the answer is the nearest of all places: there is no start to
/// choose, and no local minimum to fall into. Should a search end without a proof (it takes a continuum of places
/// that are nearest but for roundoff, such as a tube seen from its axis), the point is flagged. D1RC-splines are
/// searched from the nearest place of a tessellation: the answer is a local minimum, each point that does not lie on
/// the surface is flagged, and the call returns PLANISH_STATUS_NOT_PROVEN.
///
/// The first call for a surface builds an index that later calls use; points may be given one at a time.
///
/// surface:       not NULL.
/// points:        count rows of planish_surface_dim() doubles.
/// count:         number of points; with 0 nothing is done.
/// options:       NULL for the defaults.
/// out_uv:        receives count rows u, v; NULL for none.
/// out_distances: receives count distances; NULL for none.
/// Arrays: points[count, surface_dim], out_uv[count, 2], out_distances[count].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_POINTS_OUTSIDE (some points are farther than max_distance),
/// PLANISH_STATUS_NOT_PROVEN (some answers are flagged), PLANISH_STATUS_NULL_POINTER,
/// PLANISH_STATUS_NOT_FINITE (the index is the point),
/// PLANISH_STATUS_INVALID_ARGUMENT, PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_TOO_LARGE or
/// PLANISH_STATUS_VERSION.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_project(
    surface: *const planish_surface,
    points: *const f64,
    count: usize,
    options: *const planish_project_options,
    out_uv: *mut f64,
    out_distances: *mut f64,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let surface = deref(surface, "surface")?;
        let given = self::options(options)?;
        let points = slice(points, array_len::<f64>(count, surface.any().dim(), "points")?, "points")?;
        let guesses = match given.guesses.is_null() {
            true => None,
            false => Some(copy_rows(given.guesses, count, 2, "guesses", DVec2::from_array)?),
        };
        let core = ProjectOptions {
            guesses: guesses.as_deref(),
            max_distance: given.max_distance,
            keep_trims: flag(given.keep_trims, "keep_trims")?,
        };
        let out_uv = slice_mut_or_none(out_uv, array_len::<f64>(count, 2, "out_uv")?, "out_uv")?;
        let out_distances = slice_mut_or_none(out_distances, count, "out_distances")?;
        let out_flags = slice_mut_or_none(given.out_flags, count, "out_flags")?;
        let projection = with_control(given.thread_count, listener!(given), |control| {
            control.enter(Stage::Project);
            surface.projector()?.project(points, &core, control.pool())
        })??;
        if let Some(out_uv) = out_uv {
            write_pairs(&projection.uv, out_uv);
        }
        if let Some(out_distances) = out_distances {
            out_distances.copy_from_slice(&projection.distances);
        }
        if let Some(out_flags) = out_flags {
            out_flags.copy_from_slice(&projection.flags);
        }
        Ok(status_of(&projection))
    })
}

record! {
    /// How a surface is compared with a mesh. Fill with planish_deviation_options_init(), then change what you
    /// need.
    pub struct planish_deviation_options (planish_deviation_options_init; core: DeviationOptions) {
        /// Chord tolerance of the tessellation that is measured back from, in model units; 0 (default) takes 1e-3
        /// of the surface's diagonal.
        pub chord_tolerance: f64 = core.chord_tolerance,
        /// Longest edge of that tessellation in model units; 0 (default) takes 1e-2 of the mesh's diagonal,
        /// and at least 2e-3 of the surface's.
        /// Smaller holes may be missed.
        pub max_edge_length: f64 = core.max_edge_length,
        /// Hears of the progress and may cancel; NULL (default) for nobody.
        pub progress: planish_progress,
        /// Handed to progress as it is.
        pub user: *mut c_void,
        /// Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
        pub cancel: *const i32,
        /// Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
        /// Array: [1].
        pub out_stage: *mut u32,
        /// 1 (default): only the part of the surface inside its trims counts.
        pub keep_trims: u32 = u32::from(core.keep_trims),
        /// 1 (default): the mesh's parameters, if it has any, are where searches start. The distances are the
        /// least ones all the same.
        pub use_parameters: u32 = u32::from(core.use_parameters),
        /// 1: measure from the surface to the mesh as well, which notices filled holes and surplus sheets.
        /// Default 0.
        pub measure_back: u32 = u32::from(core.measure_back),
        /// Threads to use, at most 1024; 0 (default) for all cores. Results do not depend on it.
        pub thread_count: u32,
        /// Receives the distances of the nodes with the sign of their side: positive on the side of the normal, which is
        /// the outside of a solid; NaN for a node without triangles. NULL (default) for none. Written on success only.
        /// Array: [mesh_point_count].
        pub out_signed: *mut f64,
        /// Receives the u, v nearest to each node; NaN for a node without triangles. NULL (default) for none. Written on
        /// success only.
        /// Array: [mesh_point_count, 2].
        pub out_uv: *mut f64,
        /// Receives the face of the model nearest to each node, PLANISH_NONE where there is none; NULL (default) for none,
        /// and for a surface. Written on success only.
        /// Array: [mesh_point_count].
        pub out_faces: *mut u32,
    }
}

record! {
    /// Distances between a surface and a mesh, in model units. Set struct_size to
    /// sizeof(planish_deviation_report) before the call; filled as far as that goes, on success only.
    pub struct planish_deviation_report {
        /// Largest distance from a node to its nearest place on the surface.
        pub max_distance: f64,
        /// Square root of the mean of its square.
        pub rms_distance: f64,
        /// Its mean.
        pub mean_distance: f64,
        /// Largest distance from a place on the surface to the mesh; NaN unless measure_back asked for it.
        pub max_back_distance: f64,
        /// u of that place; NaN unless asked for.
        pub worst_back_u: f64,
        /// v of that place; NaN unless asked for.
        pub worst_back_v: f64,
        /// The node farthest from the surface.
        pub worst_index: usize,
        /// Places on the surface that were measured back from.
        pub back_count: usize,
        /// Nodes whose distance is not proved to be the least one: planish_surface_project() says when.
        pub unproven_count: usize,
        /// What half of the distances do not exceed.
        pub median_distance: f64,
        /// What 95 of a hundred distances do not exceed.
        pub distance_95: f64,
        /// What 99 of a hundred distances do not exceed.
        pub distance_99: f64,
    }
}

impl planish_deviation_report {
    /// With what shares of the distances do not exceed.
    pub(super) fn with_percentiles(self, distances: &[f64]) -> Self {
        let sizes = sorted_sizes(distances);
        let [median_distance, distance_95, distance_99] =
            [0.5, 0.95, 0.99].map(|share| percentile(&sizes, share));
        Self { median_distance, distance_95, distance_99, ..self }
    }
}

impl From<&DeviationReport> for planish_deviation_report {
    fn from(report: &DeviationReport) -> Self {
        Self {
            struct_size: size_of::<Self>(),
            max_distance: report.nodes.max,
            rms_distance: report.nodes.rms,
            mean_distance: report.nodes.mean,
            max_back_distance: report.max_back_distance,
            worst_back_u: report.worst_back_uv.x,
            worst_back_v: report.worst_back_uv.y,
            worst_index: report.nodes.worst_index,
            back_count: report.back_count,
            unproven_count: report.unproven,
            ..Self::default()
        }
        .with_percentiles(&report.nodes.each)
    }
}

/// Measures how far the nodes of a mesh lie from a surface in space: closest-point distances, as
/// planish_surface_project() finds them.
///
/// surface:       not NULL, of dimension 3.
/// mesh:          not NULL.
/// options:       NULL for the defaults; out_faces must be NULL.
/// out_distances: receives planish_mesh_point_count() distances; NULL for none.
/// count:         doubles that out_distances has room for.
/// out_report:    receives the sizes of the distances; NULL for none.
/// Arrays: out_distances[count].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NOT_PROVEN (some distances are not proved to be the least ones, as
/// to a D1RC-spline), PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option, or the
/// dimension), PLANISH_STATUS_BUFFER_TOO_SMALL, PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_TOPOLOGY or
/// PLANISH_STATUS_TOO_LARGE (measuring back only), or PLANISH_STATUS_VERSION.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_deviation(
    surface: *const planish_surface,
    mesh: *const planish_mesh,
    options: *const planish_deviation_options,
    out_distances: *mut f64,
    count: usize,
    out_report: *mut planish_deviation_report,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let surface = deref(surface, "surface")?;
        let mesh = &deref(mesh, "mesh")?.0;
        let given = self::options(options)?;
        let report = ReportOut::new(out_report)?;
        let needed = mesh.points().len();
        if !out_distances.is_null() && count < needed {
            return Err(ArgumentError::TooSmall { name: "out_distances", given: count, needed }.into());
        }
        let core = DeviationOptions {
            keep_trims: flag(given.keep_trims, "keep_trims")?,
            use_parameters: flag(given.use_parameters, "use_parameters")?,
            measure_back: flag(given.measure_back, "measure_back")?,
            chord_tolerance: given.chord_tolerance,
            max_edge_length: given.max_edge_length,
        };
        unused(given.out_faces.is_null(), "out_faces", "planish_surface_deviation")?;
        let out_signed = slice_mut_or_none(given.out_signed, needed, "out_signed")?;
        let out_uv = slice_mut_or_none(given.out_uv, array_len::<f64>(needed, 2, "out_uv")?, "out_uv")?;
        check_in_space(surface.any())?;
        let (result, sides) = with_control(given.thread_count, listener!(given), |control| {
            control.enter(Stage::Project);
            let found = deviation_with(surface.projector()?, surface.any(), mesh, &core, control.pool())?;
            let distances = &found.nodes.each;
            let sides = out_signed
                .is_some()
                .then(|| signed(surface.any(), mesh.points(), &found.uv, distances, control.pool()));
            Ok::<_, DeviationError>((found, sides))
        })??;
        if !out_distances.is_null() {
            slice_mut(out_distances, needed, "out_distances")?.copy_from_slice(&result.nodes.each);
        }
        if let (Some(to), Some(sides)) = (out_signed, sides) {
            to.copy_from_slice(&sides);
        }
        if let Some(to) = out_uv {
            write_pairs(&result.uv, to);
        }
        report.store((&result).into());
        Ok(if result.unproven > 0 { planish_status::NotProven } else { planish_status::Ok })
    })
}
