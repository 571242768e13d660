//! D1RC-splines.

use super::arguments::{
    ArgumentError, Record, array_len, choice, copy, copy_rows, deref, deref_mut, options, out, rows_mut,
    slice, slice_mut,
};
use super::guard::guard;
use super::mesh::planish_mesh;
use super::progress::with_control;
use super::surface::{planish_surface, query_surface};
use super::{planish_parameterize_options, planish_progress, planish_status, planish_tolerance_scale};
use crate::Error;
use crate::control::Stage;
use crate::fit::d1rc::D1rcFitOptions;

use crate::parameterize::parameterize;
use crate::surface::d1rc::{Boundary, D1rcMode, D1rcOptions, D1rcSurface, SharpRule, sharp_edges};
use glam::DVec2;
use libc::c_void;

/// Which functions a D1RC-spline has.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_d1rc_mode {
    /// They sum to one and reproduce polynomials, on the whole domain; the surface is polynomial on pieces.
    Reproducing = 0,
    /// As printed (Cao, Zheng, 2016): rational, only inner vertices count, the surface ends before the mesh does.
    Paper = 1,
}

/// The border of a D1RC-spline of PLANISH_D1RC_MODE_REPRODUCING.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_d1rc_boundary {
    /// Smooth everywhere; the border follows the boundary polygon as a B-spline follows its control points.
    Phantom = 0,
    /// The boundary polygon is interpolated; across the edges that touch it the surface is only continuous.
    Clamped = 1,
    /// The domain ends some faces before the mesh does.
    Open = 2,
}

/// What happens at sharp edges of a D1RC-spline.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_d1rc_sharp {
    /// PLANISH_D1RC_SHARP_CUT, in PLANISH_D1RC_MODE_PAPER PLANISH_D1RC_SHARP_ADDITIVE.
    Automatic = 0,
    /// The crease is the control polyline, at its full angle. In PLANISH_D1RC_MODE_REPRODUCING only.
    Cut = 1,
    /// Functions of the crease, and smooth functions only on their side of it. In PLANISH_D1RC_MODE_PAPER only.
    Sector = 2,
    /// Functions of the crease beside all smooth ones: a soft crease. The surface is rational then.
    Additive = 3,
}

record! {
    /// Options of D1RC-splines and of fits by them. Fill with planish_d1rc_options_init(), then change what you need.
    pub struct planish_d1rc_options (planish_d1rc_options_init; core: D1rcOptions, fit: D1rcFitOptions) {
        /// sharp_edge_count pairs of nodes joined by an edge; NULL (default) for none. Edges on the boundary do nothing.
        /// Array: [sharp_edge_count, 2].
        pub sharp_edges: *const u32,
        /// Pairs in sharp_edges. Default 0.
        pub sharp_edge_count: usize,
        /// corner_count nodes to be interpolated; NULL (default) for none.
        /// Array: [corner_count].
        pub corners: *const u32,
        /// Nodes in corners. Default 0.
        pub corner_count: usize,
        /// Edges whose faces meet at more than this angle in radians are sharp as well, up to pi; 0 (default) for none.
        pub sharp_angle: f64,
        /// Weight of the functions that sharp edges and corners add with PLANISH_D1RC_SHARP_SECTOR and
        /// PLANISH_D1RC_SHARP_ADDITIVE, positive. Default 1.
        pub sharp_weight: f64 = core.sharp_weight,
        /// How a mesh without parameters gets them; NULL (default) for the defaults. Of this record progress, user and
        /// thread_count are not looked at, and node_weights must be NULL.
        pub parameterize: *const planish_parameterize_options,
        /// Hears of the progress of the parameters and may cancel; NULL (default) for nobody.
        pub progress: planish_progress,
        /// Handed to progress as it is.
        pub user: *mut c_void,
        /// Cancels when it is not 0, which any thread may set while the call runs; NULL (default) for no such flag.
        pub cancel: *const i32,
        /// Shows what the call is doing, before progress hears of it: a planish_stage. NULL (default) for nobody.
        /// Array: [1].
        pub out_stage: *mut u32,
        /// Fits only: the largest error allowed at the nodes, positive, measured in tolerance_scale. Default 1e-3.
        pub tolerance: f64 = fit.tolerance.value,
        /// Fits only: weight of the energy that determines control points without data, positive. Default 1e-5.
        pub smoothing: f64 = fit.smoothing,
        /// Fits only: the control mesh to use as it is; NULL (default) for the mesh itself with fewer nodes, its boundary
        /// and sharp edges kept.
        pub control_mesh: *const planish_mesh,
        /// Fits only: a positive weight for each node; NULL (default) for all 1.
        /// Array: [nodes].
        pub weights: *const f64,
        /// Fits only: receives the (u,v) at which the error of each node is measured: two numbers for each node, or NULL
        /// (default). Written on success only.
        /// Array: [nodes, 2].
        pub out_parameters: *mut f64,
        /// Fits only: receives the error of each node in model units: one number for each node, or NULL (default).
        /// Written on success only.
        /// Array: [nodes].
        pub out_errors: *mut f64,
        /// Fits only: vertices of the control mesh that is made, at least 3; 0 (default) for as many as the tolerance
        /// takes.
        pub control_count: usize = fit.control_count,
        /// Fits only: most vertices of a control mesh that is made, at least 3. Default 100000.
        pub max_control_count: usize = fit.max_control_count,
        /// 1, 2 or 3. Default 3.
        pub degree: u32 = core.degree as u32,
        /// A planish_d1rc_mode. Default PLANISH_D1RC_MODE_REPRODUCING.
        pub mode: u32 = planish_d1rc_mode::Reproducing as u32,
        /// A planish_d1rc_boundary. Default PLANISH_D1RC_BOUNDARY_PHANTOM.
        pub boundary: u32 = planish_d1rc_boundary::Phantom as u32,
        /// A planish_d1rc_sharp. Default PLANISH_D1RC_SHARP_AUTOMATIC.
        pub sharp: u32 = planish_d1rc_sharp::Automatic as u32,
        /// Fits only: a planish_tolerance_scale. Default PLANISH_TOLERANCE_SCALE_RELATIVE.
        pub tolerance_scale: u32 = planish_tolerance_scale::Relative as u32,
        /// Fits only: sweeps in each round in which nodes move to their foot points and those with large errors gain
        /// weight. Default 3.
        pub correction_sweeps: u32 = fit.correction_sweeps as u32,
        /// Threads to use, at most 1024; 0 (default) for all cores. Results do not depend on it.
        pub thread_count: u32,
        /// 0.
        pub reserved: u32,
    }
}

impl planish_d1rc_options {
    pub(super) fn to_core(self) -> Result<D1rcOptions, ArgumentError> {
        if self.reserved != 0 {
            return Err(ArgumentError::Reserved { record: Self::NAME, given: self.reserved });
        }
        let boundaries = [Boundary::Phantom, Boundary::Clamped, Boundary::Open];
        let rules = [SharpRule::Automatic, SharpRule::Cut, SharpRule::Sector, SharpRule::Additive];
        Ok(D1rcOptions {
            degree: self.degree as usize,
            mode: choice(self.mode, &[D1rcMode::Reproducing, D1rcMode::Paper], "mode")?,
            boundary: choice(self.boundary, &boundaries, "boundary")?,
            sharp: choice(self.sharp, &rules, "sharp")?,
            sharp_weight: self.sharp_weight,
        })
    }
}

/// Pairs of nodes.
///
/// # Safety
/// `at` is NULL or points to `count` pairs.
pub(super) unsafe fn edges(
    at: *const u32,
    count: usize,
    name: &'static str,
) -> Result<Vec<[u32; 2]>, ArgumentError> {
    // SAFETY: the caller's promise.
    unsafe { copy_rows(at, count, 2, name, |pair: [u32; 2]| pair) }
}

/// Makes a smooth surface from a triangular control mesh: a disk, possibly with holes. Its nodes are the control
/// points; its parameters the domain, computed if it has none. The boundary loops become the trims.
///
/// control_mesh: not NULL; not kept.
/// options:      NULL for the defaults.
/// out_surface:  receives a new surface; destroy with planish_surface_free().
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option),
/// PLANISH_STATUS_NOT_FINITE (an option), PLANISH_STATUS_INDEX (a node that does not exist; the index is its place
/// among the edges or corners), PLANISH_STATUS_TOPOLOGY (no disk; a sharp edge that is no edge, the index is its
/// place; configurations that do not close, the index is the node), PLANISH_STATUS_DEGENERATE (a face turned over
/// or without area in the parameters, the index is the face; too few faces for the degree; no room for knots beyond
/// the boundary, the index is the node), or what planish_mesh_parameterize() returns.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_d1rc_new(
    control_mesh: *const planish_mesh,
    options: *const planish_d1rc_options,
    out_surface: *mut *mut planish_surface,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let mesh = &deref(control_mesh, "control_mesh")?.0;
        let given = self::options(options)?;
        let out_surface = out(out_surface, "out_surface")?;
        let core = given.to_core()?;
        let mut sharp = edges(given.sharp_edges, given.sharp_edge_count, "sharp_edges")?;
        let corners = copy(given.corners, given.corner_count, "corners")?;
        if given.sharp_angle != 0.0 {
            let is_new = |found: &[u32; 2]| !sharp.contains(found) && !sharp.contains(&[found[1], found[0]]);
            let found: Vec<[u32; 2]> =
                sharp_edges(mesh, given.sharp_angle)?.into_iter().filter(is_new).collect();
            sharp.extend(found);
        }
        let map = planish_parameterize_options::of_fit(given.parameterize)?;
        let surface = with_control(given.thread_count, listener!(given), |control| -> Result<_, Error> {
            let mut mapped = None;
            if mesh.parameters().is_none() {
                let uv = control.without_error(|control| parameterize(mesh, &map, control))?.uv;
                mapped.insert(mesh.clone()).set_parameters(uv)?;
            }
            control.enter(Stage::Fit);
            let mesh = mapped.as_ref().unwrap_or(mesh);
            let watch = control.pool().watch();
            Ok(D1rcSurface::from_mesh_watched(mesh, &core, &sharp, &corners, watch)?)
        })??;
        out_surface.write(planish_surface::into_raw(surface));
        Ok(())
    })
}

/// The degree of a D1RC-spline; 0 for NULL and for surfaces of other kinds.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_d1rc_degree(surface: *const planish_surface) -> u32 {
    // SAFETY: the caller's promise.
    unsafe { query_surface(surface, |surface| Ok(surface.d1rc()?.degree() as u32)) }
}

/// Gives a D1RC-spline other sharp edges and corners; control points and trims stay.
///
/// surface:      not NULL; changed.
/// sharp_edges:  edge_count pairs of control points joined by an edge.
/// edge_count:   may be 0.
/// corners:      corner_count control points to be interpolated; NULL if there are none.
/// corner_count: may be 0.
/// Arrays: sharp_edges[edge_count, 2], corners[corner_count].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_INDEX,
/// PLANISH_STATUS_TOPOLOGY or PLANISH_STATUS_DEGENERATE, with the index, as planish_d1rc_new().
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_d1rc_set_sharp_edges(
    surface: *mut planish_surface,
    sharp_edges: *const u32,
    edge_count: usize,
    corners: *const u32,
    corner_count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let d1rc = deref_mut(surface, "surface")?.d1rc_mut()?;
        let sharp = edges(sharp_edges, edge_count, "sharp_edges")?;
        Ok(d1rc.set_sharp_edges(&sharp, slice(corners, corner_count, "corners")?)?)
    })
}

/// Copies the sharp edges of a D1RC-spline, those found by their angle included.
///
/// surface:   not NULL.
/// out_edges: receives pairs of control points; NULL asks how many there are.
/// count:     pairs that out_edges has room for.
/// out_count: receives how many there are.
/// Arrays: out_edges[count, 2], out_count[1].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND or
/// PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_d1rc_copy_sharp_edges(
    surface: *const planish_surface,
    out_edges: *mut u32,
    count: usize,
    out_count: *mut usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let sharp = &deref(surface, "surface")?.d1rc()?.space().recipe.sharp_edges;
        let out_count = out(out_count, "out_count")?;
        if !out_edges.is_null() {
            rows_mut(out_edges, count, sharp.len(), 2, "out_edges")?.copy_from_slice(sharp.as_flattened());
        }
        out_count.write(sharp.len());
        Ok(())
    })
}

/// Copies the control points of a D1RC-spline, in the order of the nodes of its control mesh.
///
/// surface:    not NULL.
/// out_points: receives planish_surface_coefficient_count() rows of dim numbers.
/// count:      rows that out_points has room for.
/// Arrays: out_points[surface_coefficient_count, surface_dim].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND or
/// PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_d1rc_copy_control_points(
    surface: *const planish_surface,
    out_points: *mut f64,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let surface = deref(surface, "surface")?;
        let (d1rc, dim) = (surface.d1rc()?, surface.any().dim());
        let points = d1rc.control_points();
        rows_mut(out_points, count, points.len() / dim, dim, "out_points")?.copy_from_slice(points);
        Ok(())
    })
}

/// Moves control points of a D1RC-spline. Parameters and functions stay, so this takes microseconds a point.
///
/// surface:  not NULL; changed.
/// vertices: count control points.
/// count:    may be 0.
/// points:   count rows of dim numbers.
/// Arrays: vertices[count], points[count, surface_dim].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_INDEX or
/// PLANISH_STATUS_NOT_FINITE (the index is the row).
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_d1rc_set_control_points(
    surface: *mut planish_surface,
    vertices: *const u32,
    count: usize,
    points: *const f64,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let surface = deref_mut(surface, "surface")?;
        let dim = surface.any().dim();
        let d1rc = surface.d1rc_mut()?;
        let vertices = slice(vertices, count, "vertices")?;
        let rows = slice(points, array_len::<f64>(count, dim, "points")?, "points")?;
        Ok(d1rc.set_control_points(vertices, rows)?)
    })
}

/// How often a D1RC-spline is differentiable across edges of its control mesh, for knots in general position: 0 on
/// creases and on edges that touch repeated knots, else the degree less one.
///
/// surface:    not NULL.
/// edges:      count pairs of control points joined by an edge.
/// count:      may be 0.
/// out_orders: receives count numbers.
/// Arrays: edges[count, 2], out_orders[count].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_INDEX (no such
/// control point) or PLANISH_STATUS_TOPOLOGY (no edge); the index is the pair.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_d1rc_edge_continuity(
    surface: *const planish_surface,
    edges: *const u32,
    count: usize,
    out_orders: *mut u32,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let d1rc = deref(surface, "surface")?.d1rc()?;
        let edges = self::edges(edges, count, "edges")?;
        let out_orders = slice_mut(out_orders, count, "out_orders")?;
        let orders = d1rc.edge_continuity(&edges)?;
        out_orders.iter_mut().zip(orders).for_each(|(out, order)| *out = order as u32);
        Ok(())
    })
}

/// Copies the numbers of the faces of the control mesh whose surface moves with a control point, in order.
///
/// surface:   not NULL.
/// vertex:    below planish_surface_coefficient_count().
/// out_faces: receives the numbers; NULL asks how many there are.
/// count:     numbers that out_faces has room for.
/// out_count: receives how many there are.
/// Arrays: out_faces[count], out_count[1].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_INDEX or
/// PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_d1rc_copy_influence(
    surface: *const planish_surface,
    vertex: u32,
    out_faces: *mut u32,
    count: usize,
    out_count: *mut usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let d1rc = deref(surface, "surface")?.d1rc()?;
        let out_count = out(out_count, "out_count")?;
        let faces = d1rc.influence(vertex)?;
        if !out_faces.is_null() {
            rows_mut(out_faces, count, faces.len(), 1, "out_faces")?.copy_from_slice(&faces);
        }
        out_count.write(faces.len());
        Ok(())
    })
}

/// The share of one control point in the surface at points; those of all control points sum to one.
///
/// surface:    not NULL.
/// vertex:     below planish_surface_coefficient_count().
/// uv:         count rows of u, v.
/// count:      may be 0.
/// out_values: receives count numbers.
/// Arrays: uv[count, 2], out_values[count].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_INDEX (vertex),
/// PLANISH_STATUS_NOT_FINITE or PLANISH_STATUS_OUTSIDE (the index is the point).
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_d1rc_blending_values(
    surface: *const planish_surface,
    vertex: u32,
    uv: *const f64,
    count: usize,
    out_values: *mut f64,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let d1rc = deref(surface, "surface")?.d1rc()?;
        let uv: Vec<DVec2> = copy_rows(uv, count, 2, "uv", |row: [f64; 2]| DVec2::from(row))?;
        let out_values = slice_mut(out_values, count, "out_values")?;
        out_values.copy_from_slice(&d1rc.blending_values(vertex, &uv)?);
        Ok(())
    })
}

/// Number of knots of a D1RC-spline, those beyond its border included; 0 for NULL and for surfaces of other kinds.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_d1rc_knot_count(surface: *const planish_surface) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_surface(surface, |surface| Ok(surface.d1rc()?.space().places.len())) }
}

/// Copies the (u,v) of the knots of a D1RC-spline: first those of the control mesh's nodes.
///
/// surface: not NULL.
/// out_uv:  receives planish_d1rc_knot_count() rows of u, v.
/// count:   rows that out_uv has room for.
/// Arrays: out_uv[d1rc_knot_count, 2].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND or
/// PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_d1rc_copy_knots(
    surface: *const planish_surface,
    out_uv: *mut f64,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let places = &deref(surface, "surface")?.d1rc()?.space().places;
        let rows = rows_mut(out_uv, count, places.len(), 2, "out_uv")?;
        rows.chunks_exact_mut(2).zip(places).for_each(|(row, place)| place.write_to_slice(row));
        Ok(())
    })
}

/// Number of functions of a D1RC-spline; 0 for NULL and for surfaces of other kinds.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_d1rc_configuration_count(surface: *const planish_surface) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_surface(surface, |surface| Ok(surface.d1rc()?.space().configurations.len())) }
}

/// Copies what a function of a D1RC-spline is made of: b(t) = sum over the edges (a,b) of det(a,b,t) M(t|X,a,b).
///
/// surface:   not NULL.
/// index:     below planish_d1rc_configuration_count().
/// out_knots: receives the knots X, as many as the degree; NULL for none.
/// out_edges: receives pairs of knots, with X on their left; NULL asks how many there are.
/// count:     pairs that out_edges has room for.
/// out_count: receives how many there are.
/// Arrays: out_knots[d1rc_degree], out_edges[count, 2], out_count[1].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_WRONG_KIND, PLANISH_STATUS_INDEX or
/// PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_d1rc_copy_configuration(
    surface: *const planish_surface,
    index: usize,
    out_knots: *mut u32,
    out_edges: *mut u32,
    count: usize,
    out_count: *mut usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let configurations = &deref(surface, "surface")?.d1rc()?.space().configurations;
        let out_count = out(out_count, "out_count")?;
        let no_such = ArgumentError::NoSuch { name: "configuration", index, count: configurations.len() };
        let configuration = configurations.get(index).ok_or(no_such)?;
        let edges = &configuration.edges;
        if !out_edges.is_null() {
            rows_mut(out_edges, count, edges.len(), 2, "out_edges")?.copy_from_slice(edges.as_flattened());
        }
        if !out_knots.is_null() {
            slice_mut(out_knots, configuration.knots.len(), "out_knots")?
                .copy_from_slice(&configuration.knots);
        }
        out_count.write(edges.len());
        Ok(())
    })
}
