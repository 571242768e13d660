//! What single data demand of a fit, and its sides, as the records of options have them.

use super::arguments::{ArgumentError, choice, deref, slice, slice_or_none, unused};
use super::curve::planish_curve;
use super::surface::planish_surface;
use crate::fit::common::{Demands, Outliers, Plane, Sides, Symmetry};
use crate::surface::AnySurface;
use glam::DVec3;

/// Whether the fit of a mesh's shape is its own mirror image.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum planish_symmetry {
    /// As it comes.
    None = 0,
    /// About a plane that is given. The mesh must be its own image within the tolerance, and the plane must cut it into
    /// two halves along one line from border to border.
    About = 1,
    /// About the plane for which the mesh is nearest to its image.
    Found = 2,
}

/// The fields of a record that tell of single data, and of symmetry.
#[derive(Clone, Copy)]
pub(super) struct GivenDemands {
    pub tolerances: *const f64,
    pub fixed: *const u32,
    pub fixed_count: usize,
    pub outlier_share: f64,
    pub outlier_scale: f64,
    pub symmetry: u32,
    pub plane: *const f64,
}

/// Those fields of a record.
macro_rules! demands {
    ($options:expr) => {
        $crate::ffi::demands::GivenDemands {
            tolerances: $options.tolerances,
            fixed: $options.fixed,
            fixed_count: $options.fixed_count,
            outlier_share: $options.outlier_share,
            outlier_scale: $options.outlier_scale,
            symmetry: $options.symmetry,
            plane: $options.plane,
        }
    };
}

impl GivenDemands {
    /// # Safety
    /// The pointers are NULL or as the header says, for `count` data, until the demands are no longer used.
    pub(super) unsafe fn to_core<'a>(self, count: usize) -> Result<Demands<'a>, ArgumentError> {
        // SAFETY: the caller's promise.
        let tolerances = unsafe { slice_or_none(self.tolerances, count, "tolerances") }?;
        // SAFETY: the caller's promise.
        let fixed = unsafe { slice(self.fixed, self.fixed_count, "fixed") }?;
        let outliers = match (self.outlier_share, self.outlier_scale) {
            (0.0, 0.0) => Outliers::None,
            (0.0, scale) => Outliers::Scale(scale),
            (share, scale) => {
                unused(scale == 0.0, "outlier_scale", "outlier_share")?;
                Outliers::Share(share)
            }
        };
        // SAFETY: the caller's promise.
        let symmetry = unsafe { symmetry(self.symmetry, self.plane) }?;
        Ok(Demands { fixed, tolerances, outliers, symmetry })
    }
}

/// # Safety
/// `plane` is NULL or points to six numbers.
unsafe fn symmetry(given: u32, plane: *const f64) -> Result<Symmetry, ArgumentError> {
    let given = choice(
        given,
        &[planish_symmetry::None, planish_symmetry::About, planish_symmetry::Found],
        "symmetry",
    )?;
    if given != planish_symmetry::About {
        unused(plane.is_null(), "plane", "symmetry")?;
    }
    Ok(match given {
        planish_symmetry::None => Symmetry::None,
        planish_symmetry::Found => Symmetry::Found,
        planish_symmetry::About => {
            // SAFETY: the caller's promise.
            let plane = unsafe { slice(plane, 6, "plane") }?;
            Symmetry::About(Plane { point: DVec3::from_slice(plane), normal: DVec3::from_slice(&plane[3..]) })
        }
    })
}

/// Sides of a surface, as options records have them: those at the least u, the largest u, the least v and the largest v.
pub(super) struct GivenSides {
    pub curves: [*const planish_curve; 4],
    pub neighbours: [*const planish_surface; 4],
}

/// The sides of a record.
macro_rules! sides {
    ($options:expr) => {
        $crate::ffi::demands::GivenSides {
            curves: [
                $options.curve_u_low,
                $options.curve_u_high,
                $options.curve_v_low,
                $options.curve_v_high,
            ],
            neighbours: [
                $options.neighbour_u_low,
                $options.neighbour_u_high,
                $options.neighbour_v_low,
                $options.neighbour_v_high,
            ],
        }
    };
}

impl GivenSides {
    /// # Safety
    /// The handles are NULL or those of curves and surfaces that live until the sides are no longer used.
    pub(super) unsafe fn to_core<'a>(&self) -> Result<Sides<'a>, ArgumentError> {
        let mut sides = Sides::default();
        for (given, &at) in sides.curves.iter_mut().zip(&self.curves).filter(|(_, at)| !at.is_null()) {
            // SAFETY: the caller's promise.
            *given = Some(unsafe { deref(at, "curve") }?.core());
        }
        for (given, &at) in sides.neighbours.iter_mut().zip(&self.neighbours).filter(|(_, at)| !at.is_null())
        {
            // SAFETY: the caller's promise.
            let surface = unsafe { deref(at, "neighbour") }?;
            *given = Some(match surface.family() {
                Ok(AnySurface::Pht(pht)) => pht.into(),
                _ => surface.tensor()?.into(),
            });
        }
        Ok(sides)
    }
}
