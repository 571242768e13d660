//! Surfaces of any family.

use super::arguments::{ArgumentError, deref, out, slice_mut};
use super::guard::guard;
use super::planish_status;
use super::status::query;
use crate::query::project::{ProjectError, Projector};
use crate::surface::d1rc::D1rcSurface;
use crate::surface::pht::PhtSurface;
use crate::surface::tensor::TensorSurface;
use crate::surface::tspline::TSplineSurface;
use crate::surface::{AnySurface, Domain, Kind, Surface};
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
