//! Surfaces of any family.

use super::arguments::{
    ArgumentError, array_len, choice, copy_rows, deref, deref_mut, options, out, rows_mut, slice, slice_mut,
    slice_mut_or_none, stride, strided_len,
};
use super::guard::{Failure, guard};
use super::planish_status;
use super::progress::thread_count;
use super::report::write_pairs;
use super::status::query;
use crate::control::Pool;
use crate::query::project::{FLAG_NOT_PROVEN, ProjectError, Projector};
use crate::surface::d1rc::D1rcSurface;
use crate::surface::evaluate::{
    FLAG_IN_BUFFER, FLAG_NO_NORMAL, FLAG_OUTSIDE_DOMAIN, FLAG_OUTSIDE_TRIMS, Output, OutsideRule, Points,
    Quantity, evaluate, piece_count,
};
use crate::surface::pht::PhtSurface;
use crate::surface::tensor::TensorSurface;
use crate::surface::tspline::TSplineSurface;
use crate::surface::{AnySurface, Domain, Kind, MAX_DERIVATIVE, Surface, Trims};
use glam::DVec2;
use std::sync::OnceLock;

/// A surface: a map from a rectangle of parameters (u,v) to R^dim. Made by planish_tensor_fit() and others,
/// destroyed by planish_surface_free().
///
/// Calls that take it const may run at once on any threads; a call that takes it non-const needs it alone.
/// The first projection onto it builds an index, some hundred bytes for each control point, which it keeps until it
/// is changed or destroyed.
pub struct planish_surface {
    family: Family,
    /// Made when first needed, forgotten when the surface changes.
    projector: OnceLock<Projector>,
}

const _: () = {
    const fn is_shared<T: Send + Sync>() {}
    is_shared::<planish_surface>();
};

/// What a handle holds.
#[derive(Clone)]
#[cfg_attr(test, allow(clippy::large_enum_variant, reason = "handles hold it in a box"))]
pub(super) enum Family {
    Any(AnySurface),
    /// Stands for every family that is not known here.
    #[cfg(test)]
    Other(super::tests::OtherFamily),
}

impl planish_surface {
    pub(super) fn into_raw(surface: impl Into<AnySurface>) -> *mut Self {
        Self::of(Family::Any(surface.into()))
    }

    /// A handle of no family that the library knows.
    #[cfg(test)]
    pub(super) fn other_into_raw(surface: super::tests::OtherFamily) -> *mut Self {
        Self::of(Family::Other(surface))
    }

    fn of(family: Family) -> *mut Self {
        Box::into_raw(Box::new(Self { family, projector: OnceLock::new() }))
    }

    /// What projects onto it; the first call makes it.
    pub(super) fn projector(&self) -> Result<&Projector, ProjectError> {
        if let Some(projector) = self.projector.get() {
            return Ok(projector);
        }
        let made = Projector::new(self.any())?;
        Ok(self.projector.get_or_init(|| made))
    }

    /// To change the surface: what was kept for it no longer holds.
    fn family_mut(&mut self) -> &mut Family {
        self.projector = OnceLock::new();
        &mut self.family
    }

    pub(super) fn any(&self) -> &dyn Surface {
        match &self.family {
            Family::Any(surface) => surface.as_surface(),
            #[cfg(test)]
            Family::Other(other) => other,
        }
    }

    pub(super) fn any_mut(&mut self) -> &mut dyn Surface {
        match self.family_mut() {
            Family::Any(surface) => surface.as_surface_mut(),
            #[cfg(test)]
            Family::Other(other) => other,
        }
    }

    /// The surface for calls that tell the families apart themselves.
    pub(super) fn family(&self) -> Result<&AnySurface, ArgumentError> {
        match &self.family {
            Family::Any(surface) => Ok(surface),
            #[cfg(test)]
            Family::Other(_) => Err(self.wrong_kind(Kind::Tensor)),
        }
    }

    pub(super) fn tensor(&self) -> Result<&TensorSurface, ArgumentError> {
        match &self.family {
            Family::Any(AnySurface::Tensor(tensor)) => Ok(tensor),
            _ => Err(self.wrong_kind(Kind::Tensor)),
        }
    }

    pub(super) fn tensor_mut(&mut self) -> Result<&mut TensorSurface, ArgumentError> {
        let refused = self.wrong_kind(Kind::Tensor);
        match self.family_mut() {
            Family::Any(AnySurface::Tensor(tensor)) => Ok(tensor),
            _ => Err(refused),
        }
    }

    pub(super) fn tspline(&self) -> Result<&TSplineSurface, ArgumentError> {
        match &self.family {
            Family::Any(AnySurface::TSpline(tspline)) => Ok(tspline),
            _ => Err(self.wrong_kind(Kind::TSpline)),
        }
    }

    pub(super) fn tspline_mut(&mut self) -> Result<&mut TSplineSurface, ArgumentError> {
        let refused = self.wrong_kind(Kind::TSpline);
        match self.family_mut() {
            Family::Any(AnySurface::TSpline(tspline)) => Ok(tspline),
            _ => Err(refused),
        }
    }

    pub(super) fn pht(&self) -> Result<&PhtSurface, ArgumentError> {
        match &self.family {
            Family::Any(AnySurface::Pht(pht)) => Ok(pht),
            _ => Err(self.wrong_kind(Kind::Pht)),
        }
    }

    pub(super) fn pht_mut(&mut self) -> Result<&mut PhtSurface, ArgumentError> {
        let refused = self.wrong_kind(Kind::Pht);
        match self.family_mut() {
            Family::Any(AnySurface::Pht(pht)) => Ok(pht),
            _ => Err(refused),
        }
    }

    pub(super) fn d1rc(&self) -> Result<&D1rcSurface, ArgumentError> {
        match &self.family {
            Family::Any(AnySurface::D1rc(d1rc)) => Ok(d1rc),
            _ => Err(self.wrong_kind(Kind::D1rc)),
        }
    }

    pub(super) fn d1rc_mut(&mut self) -> Result<&mut D1rcSurface, ArgumentError> {
        let refused = self.wrong_kind(Kind::D1rc);
        match self.family_mut() {
            Family::Any(AnySurface::D1rc(d1rc)) => Ok(d1rc),
            _ => Err(refused),
        }
    }

    fn wrong_kind(&self, needed: Kind) -> ArgumentError {
        ArgumentError::WrongKind { found: self.any().kind(), needed }
    }
}

/// The family of a surface.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_kind {
    /// No surface: the answer for NULL.
    None = 0,
    /// Tensor product B-spline, with or without weights.
    Tensor = 1,
    /// T-spline with control curves.
    Tspline = 2,
    /// Bicubic spline over a hierarchical T-mesh.
    Pht = 3,
    /// Spline over a triangular control mesh.
    D1rc = 4,
}

impl From<Kind> for planish_kind {
    fn from(kind: Kind) -> Self {
        match kind {
            Kind::Tensor => Self::Tensor,
            Kind::TSpline => Self::Tspline,
            Kind::Pht => Self::Pht,
            Kind::D1rc => Self::D1rc,
        }
    }
}

/// What to do with points outside the domain.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_outside {
    /// Refuse all points, before one value is written.
    Fail = 0,
    /// NaN and a flag; the call returns PLANISH_STATUS_POINTS_OUTSIDE.
    Flag = 1,
    /// The polynomial at the domain's end is continued, and the point flagged.
    /// A D1RC-spline, whose domain are the faces of its control mesh, is continued by its tangent plane at the nearest
    /// place of the border.
    Extrapolate = 2,
}

/// Flags of a point: bits of the elements of out_flags.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_flag {
    /// The parameters lie outside the domain.
    OutsideDomain = 1,
    /// The point lies outside the trims: in a hole, or beyond the boundary of the data.
    OutsideTrims = 2,
    /// The parameters lie in the domain but beyond the box of the data: the surface is extrapolated there.
    InBuffer = 4,
    /// The surface has no normal there, so that normal and curvatures are NaN.
    NoNormal = 8,
    /// The answer for the point is not proved: the distance is that of a place on the surface, and the least one may
    /// be smaller.
    NotProven = 16,
}

const _: () = {
    assert!(planish_flag::OutsideDomain as u8 == FLAG_OUTSIDE_DOMAIN);
    assert!(planish_flag::OutsideTrims as u8 == FLAG_OUTSIDE_TRIMS);
    assert!(planish_flag::InBuffer as u8 == FLAG_IN_BUFFER);
    assert!(planish_flag::NoNormal as u8 == FLAG_NO_NORMAL);
    assert!(planish_flag::NotProven as u8 == FLAG_NOT_PROVEN);
};

record! {
    /// How points are evaluated. Fill with planish_eval_options_init(), then change what you need.
    pub struct planish_eval_options (planish_eval_options_init) {
        /// Doubles from one point to the next in `uv`; at least 2, or 0 (default) for 2. Must be 0 for grids.
        pub uv_stride: usize,
        /// Doubles from one point's results to the next; at least as many as a point has, or 0 (default) for
        /// exactly so many. What lies between is left alone.
        pub out_stride: usize,
        /// Receives bits of planish_flag, one element for each point; NULL (default) for none.
        /// Array: [points].
        pub out_flags: *mut u8,
        /// A planish_outside. Default PLANISH_OUTSIDE_FAIL.
        pub outside: u32 = planish_outside::Fail as u32,
        /// Threads to use, at most 1024; 0 (default) for all cores. Results do not depend on it, and fewer than
        /// about a thousand points are evaluated on the calling thread alone.
        pub thread_count: u32,
    }
}

/// Evaluates at points that are already borrowed.
///
/// # Safety
/// `out` and the options' flags are NULL or as the header says, for all points.
unsafe fn eval(
    surface: &dyn Surface,
    quantity: Quantity,
    points: Points,
    options: &planish_eval_options,
    out: *mut f64,
    name: &'static str,
) -> Result<planish_status, Failure> {
    let count = points.count();
    let rules = [OutsideRule::Fail, OutsideRule::Flag, OutsideRule::Extrapolate];
    let rule = choice(options.outside, &rules, "outside")?;
    let width = quantity.width(surface.dim());
    let stride = stride(options.out_stride, width, "out_stride")?;
    let pool = Pool::for_pieces(thread_count(options.thread_count)?, piece_count(count));
    let len = strided_len::<f64>(count, stride, width, name)?;
    // SAFETY: the caller's promise.
    let (rows, flags) =
        unsafe { (slice_mut(out, len, name)?, slice_mut_or_none(options.out_flags, count, "out_flags")?) };
    let flags = flags.unwrap_or(&mut []);
    let outside = evaluate(surface, quantity, points, rule, Output { rows, stride, flags }, &pool)?;
    let has_nan = rule == OutsideRule::Flag && outside > 0;
    Ok(if has_nan { planish_status::PointsOutside } else { planish_status::Ok })
}

/// Evaluates at rows of u and v.
///
/// # Safety
/// The pointers are NULL or as the header says.
unsafe fn eval_points(
    surface: *const planish_surface,
    quantity: Quantity,
    uv: *const f64,
    count: usize,
    options: *const planish_eval_options,
    out: *mut f64,
    name: &'static str,
) -> Result<planish_status, Failure> {
    // SAFETY: the caller's promises.
    unsafe {
        let surface = deref(surface, "surface")?.any();
        let options = self::options(options)?;
        let uv_stride = stride(options.uv_stride, 2, "uv_stride")?;
        let uv = slice(uv, strided_len::<f64>(count, uv_stride, 2, "uv")?, "uv")?;
        eval(surface, quantity, Points::new(uv, uv_stride, count), &options, out, name)
    }
}

/// What `find` reads from a surface; 0 for NULL.
///
/// # Safety
/// `surface` is NULL or a surface that nobody changes meanwhile.
pub(super) unsafe fn query_surface<T: Default>(
    surface: *const planish_surface,
    find: impl FnOnce(&planish_surface) -> Result<T, ArgumentError>,
) -> T {
    // SAFETY: the caller's promise.
    query(|| Ok(find(unsafe { deref(surface, "surface") }?)?))
}

/// The family of a surface: a planish_kind; PLANISH_KIND_NONE for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_kind(surface: *const planish_surface) -> u32 {
    // SAFETY: the caller's promise.
    unsafe { query_surface(surface, |surface| Ok(planish_kind::from(surface.any().kind()) as u32)) }
}

/// Numbers of a value: 1 for a scalar field, 3 for a shape; 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_dim(surface: *const planish_surface) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_surface(surface, |surface| Ok(surface.any().dim())) }
}

/// Number of control points; 0 for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_coefficient_count(surface: *const planish_surface) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_surface(surface, |surface| Ok(surface.any().coefficient_count())) }
}

/// The rectangle on which the surface is defined.
///
/// surface: not NULL.
/// out_box: receives 4 numbers: least u, largest u, least v, largest v.
/// Arrays: out_box[4].
/// Returns PLANISH_STATUS_OK or PLANISH_STATUS_NULL_POINTER.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_domain(
    surface: *const planish_surface,
    out_box: *mut f64,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let domain = deref(surface, "surface")?.any().domain();
        write_box(domain, slice_mut(out_box, 4, "out_box")?);
        Ok(())
    })
}

/// The box of the (u,v) of the data that the surface was made from: beyond it the surface is extrapolated. The
/// domain if the surface was not made from data.
///
/// surface: not NULL.
/// out_box: receives 4 numbers: least u, largest u, least v, largest v.
/// Arrays: out_box[4].
/// Returns PLANISH_STATUS_OK or PLANISH_STATUS_NULL_POINTER.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_data_box(
    surface: *const planish_surface,
    out_box: *mut f64,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let surface = deref(surface, "surface")?.any();
        let data_box = surface.region().data_box.unwrap_or(surface.domain());
        write_box(data_box, slice_mut(out_box, 4, "out_box")?);
        Ok(())
    })
}

fn write_box(domain: Domain, out: &mut [f64]) {
    out.copy_from_slice(&[domain.min.x, domain.max.x, domain.min.y, domain.max.y]);
}

/// Evaluates the surface at points.
///
/// surface:    not NULL.
/// uv:         count rows of u, v; rows start options->uv_stride doubles apart.
/// count:      may be 0.
/// options:    NULL for the defaults.
/// out_values: receives count rows of dim numbers; rows start options->out_stride doubles apart. It must not
///             overlap uv.
/// Arrays: uv[count, 2], out_values[count, surface_dim].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_POINTS_OUTSIDE (with PLANISH_OUTSIDE_FLAG; the values of those
/// points are NaN) or an error: PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (an option),
/// PLANISH_STATUS_OUTSIDE (with PLANISH_OUTSIDE_FAIL; the index is the first such point),
/// PLANISH_STATUS_NOT_FINITE (u or v, unless PLANISH_OUTSIDE_FLAG; the index is the point),
/// PLANISH_STATUS_TOO_LARGE (count times stride) or PLANISH_STATUS_VERSION.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_eval(
    surface: *const planish_surface,
    uv: *const f64,
    count: usize,
    options: *const planish_eval_options,
    out_values: *mut f64,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe { eval_points(surface, Quantity::Values, uv, count, options, out_values, "out_values") })
}

/// Evaluates the surface and its derivatives at points.
///
/// surface:        not NULL.
/// uv:             count rows of u, v; rows start options->uv_stride doubles apart.
/// count:          may be 0.
/// max_derivative: 0, 1 or 2.
/// options:        NULL for the defaults.
/// out:            receives for each point 1, 3 or 6 rows of dim numbers: S; Su, Sv; Suu, Suv, Svv. Points
///                 start options->out_stride doubles apart. It must not overlap uv.
/// Arrays: uv[count, 2], out[count, *, surface_dim].
/// Returns what planish_surface_eval() returns; PLANISH_STATUS_INVALID_ARGUMENT also for max_derivative.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_eval_derivatives(
    surface: *const planish_surface,
    uv: *const f64,
    count: usize,
    max_derivative: u32,
    options: *const planish_eval_options,
    out: *mut f64,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let order = max_derivative as usize;
        if order > MAX_DERIVATIVE {
            let (name, largest) = ("max_derivative", MAX_DERIVATIVE);
            return Err(ArgumentError::Limit { name, given: order, largest }.into());
        }
        eval_points(surface, Quantity::Derivatives(order), uv, count, options, out, "out")
    })
}

/// Evaluates the surface at all pairs of some u and some v.
///
/// surface:    not NULL.
/// u, u_count: parameters along u; may be none.
/// v, v_count: parameters along v; may be none.
/// options:    NULL for the defaults; uv_stride must be 0.
/// out_values: receives u_count * v_count rows of dim numbers, v running fastest; rows start
///             options->out_stride doubles apart. It must not overlap u or v.
/// Arrays: u[u_count], v[v_count], out_values[u_count, v_count, surface_dim].
/// Returns what planish_surface_eval() returns; the index of a point counts as the rows of out_values do.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_eval_grid(
    surface: *const planish_surface,
    u: *const f64,
    u_count: usize,
    v: *const f64,
    v_count: usize,
    options: *const planish_eval_options,
    out_values: *mut f64,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let surface = deref(surface, "surface")?.any();
        let options = self::options(options)?;
        if options.uv_stride != 0 {
            let (name, given) = ("uv_stride", options.uv_stride);
            return Err(ArgumentError::Limit { name, given, largest: 0 }.into());
        }
        array_len::<f64>(u_count, v_count, "out_values")?;
        let points = Points::grid(slice(u, u_count, "u")?, slice(v, v_count, "v")?);
        eval(surface, Quantity::Values, points, &options, out_values, "out_values")
    })
}

/// Computes unit normals Su x Sv / |Su x Sv| of a surface in space.
///
/// surface:     not NULL, of dim 3.
/// uv:          count rows of u, v; rows start options->uv_stride doubles apart.
/// count:       may be 0.
/// options:     NULL for the defaults.
/// out_normals: receives count rows of 3 numbers, NaN where Su and Sv are parallel; rows start
///              options->out_stride doubles apart. It must not overlap uv.
/// Arrays: uv[count, 2], out_normals[count, 3].
/// Returns what planish_surface_eval() returns; PLANISH_STATUS_INVALID_ARGUMENT also if dim is not 3.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_normals(
    surface: *const planish_surface,
    uv: *const f64,
    count: usize,
    options: *const planish_eval_options,
    out_normals: *mut f64,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        eval_points(surface, Quantity::Normals, uv, count, options, out_normals, "out_normals")
    })
}

/// Computes principal curvatures and their directions of a surface in space.
///
/// surface: not NULL, of dim 3.
/// uv:      count rows of u, v; rows start options->uv_stride doubles apart.
/// count:   may be 0.
/// options: NULL for the defaults.
/// out:     receives count rows of 8 numbers: k1, k2 with k1 >= k2, positive where the surface bends towards
///          its normal, then the unit tangents d1 and d2 of 3 numbers each, with d1 x d2 the normal; NaN where
///          there is no normal. Rows start options->out_stride doubles apart. It must not overlap uv.
/// Arrays: uv[count, 2], out[count, 8].
/// Returns what planish_surface_eval() returns; PLANISH_STATUS_INVALID_ARGUMENT also if dim is not 3.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_curvatures(
    surface: *const planish_surface,
    uv: *const f64,
    count: usize,
    options: *const planish_eval_options,
    out: *mut f64,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe { eval_points(surface, Quantity::Curvatures, uv, count, options, out, "out") })
}

/// Number of trims: closed polylines in the parameter plane that bound the part of the surface that counts. A
/// surface made from a mesh has the mesh's boundary loops. 0 if the whole domain counts, and for NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_trim_count(surface: *const planish_surface) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_surface(surface, |surface| Ok(surface.any().region().trims.loops().len())) }
}

fn trim(surface: &dyn Surface, index: usize) -> Result<&[DVec2], ArgumentError> {
    let loops = surface.region().trims.loops();
    let missing = ArgumentError::NoSuch { name: "trim", index, count: loops.len() };
    loops.get(index).map(Vec::as_slice).ok_or(missing)
}

/// Number of points of a trim; 0 for NULL or a trim that does not exist.
///
/// trim: below planish_surface_trim_count(); trim 0 is the outer one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_trim_point_count(
    surface: *const planish_surface,
    trim: usize,
) -> usize {
    // SAFETY: the caller's promise.
    unsafe { query_surface(surface, |surface| Ok(self::trim(surface.any(), trim)?.len())) }
}

/// Copies the points of a trim in order. The first is not repeated.
///
/// surface: not NULL.
/// trim:    below planish_surface_trim_count(); trim 0 is the outer one.
/// out_uv:  receives planish_surface_trim_point_count() rows of u, v.
/// count:   rows that out_uv has room for.
/// Arrays: out_uv[surface_trim_point_count, 2].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INDEX (the trim) or
/// PLANISH_STATUS_BUFFER_TOO_SMALL.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_copy_trim(
    surface: *const planish_surface,
    trim: usize,
    out_uv: *mut f64,
    count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let points = self::trim(deref(surface, "surface")?.any(), trim)?;
        write_pairs(points, rows_mut(out_uv, count, points.len(), 2, "out_uv")?);
        Ok(())
    })
}

/// Replaces the trims. A point counts when a ray from it crosses the trims an odd number of times, so the
/// outer one and holes may run in any direction.
///
/// surface:      not NULL; changed.
/// uv:           rows of u, v inside the domain, trim after trim, the first point of a trim not repeated.
///               Copied.
/// point_counts: trim_count numbers of points, each at least 3.
/// trim_count:   0 removes all trims.
/// Arrays: uv[*, 2], point_counts[trim_count].
/// Returns PLANISH_STATUS_OK, PLANISH_STATUS_NULL_POINTER, PLANISH_STATUS_INVALID_ARGUMENT (a trim of fewer
/// than 3 points), PLANISH_STATUS_NOT_FINITE, PLANISH_STATUS_OUTSIDE (the index is the trim for all three),
/// PLANISH_STATUS_TOO_LARGE or PLANISH_STATUS_OUT_OF_MEMORY.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_set_trims(
    surface: *mut planish_surface,
    uv: *const f64,
    point_counts: *const usize,
    trim_count: usize,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let surface = deref_mut(surface, "surface")?.any_mut();
        let point_counts = slice(point_counts, trim_count, "point_counts")?;
        let total = point_counts.iter().try_fold(0_usize, |sum, &count| sum.checked_add(count));
        let name = "uv";
        let total = total.ok_or(ArgumentError::Overflow { name, count: usize::MAX, width: trim_count })?;
        let mut rest = copy_rows(uv, total, 2, name, DVec2::from_array)?.into_iter();
        let loops = point_counts.iter().map(|&count| rest.by_ref().take(count).collect()).collect();
        surface.region_mut().trims = Trims::new(loops, &surface.domain())?;
        Ok(())
    })
}

/// Makes a copy of a surface with its trims.
///
/// surface:     not NULL.
/// out_surface: receives a new surface; destroy with planish_surface_free().
/// Returns PLANISH_STATUS_OK or PLANISH_STATUS_NULL_POINTER.
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_clone(
    surface: *const planish_surface,
    out_surface: *mut *mut planish_surface,
) -> planish_status {
    // SAFETY: the caller's promises.
    guard(|| unsafe {
        let surface = deref(surface, "surface")?;
        let out_surface = out(out_surface, "out_surface")?;
        out_surface.write(planish_surface::of(surface.family.clone()));
        Ok(())
    })
}

/// Destroys a surface.
///
/// surface: from this library and not destroyed yet; NULL does nothing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn planish_surface_free(surface: *mut planish_surface) {
    query(|| {
        if !surface.is_null() {
            // SAFETY: the caller's promise.
            drop(unsafe { Box::from_raw(surface) });
        }
        Ok(())
    });
}
