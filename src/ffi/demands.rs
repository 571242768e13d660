//! What single data demand of a fit, as the records of options have it.

use super::arguments::{ArgumentError, choice, slice, unused};
use crate::fit::common::{Demands, Outliers, Plane, Symmetry};
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

impl GivenDemands {
    /// # Safety
    /// The pointers are NULL or as the header says, for `count` data, until the demands are no longer used.
    pub(super) unsafe fn to_core<'a>(self, count: usize) -> Result<Demands<'a>, ArgumentError> {
        let tolerances = match self.tolerances {
            at if at.is_null() => None,
            // SAFETY: the caller's promise.
            at => Some(unsafe { slice(at, count, "tolerances") }?),
        };
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
