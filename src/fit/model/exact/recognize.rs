//! Which regions lie on a plane or a cylinder.

use super::evidence::{Evidence, Limits};
use crate::mesh::{Mesh, Regions};
use crate::model::Carrier;

/// A region with the carrier that explains all of it.
#[derive(Debug, Clone)]
pub struct Recognized {
    /// A plane or cylinder.
    pub carrier: Carrier,
    /// The nodes and facets that tell it.
    pub evidence: Evidence,
}

/// The carrier of each region that has one: a plane or cylinder on which all its nodes lie within the limits.
///
/// A cylinder is one only between planes and cylinders: beside a patch its edges would be no circles and lines.
pub fn recognize(mesh: &Mesh, regions: &Regions, limits: &Limits) -> Vec<Option<Recognized>> {
    let of_region = |region: &crate::mesh::Region| recognize_region(mesh, &region.triangles, limits);
    let mut found: Vec<Option<Recognized>> = regions.regions.iter().map(of_region).collect();
    loop {
        let is_beside_patch = |&region: &u32| {
            let is_cylinder = found[region as usize]
                .as_ref()
                .is_some_and(|found| matches!(found.carrier, Carrier::Cylinder(_)));
            is_cylinder && regions.neighbours(region).iter().any(|&other| found[other as usize].is_none())
        };
        let dropped: Vec<u32> = (0..found.len() as u32).filter(is_beside_patch).collect();
        if dropped.is_empty() {
            return found;
        }
        dropped.into_iter().for_each(|region| found[region as usize] = None);
    }
}

/// The carrier on which all of some triangles lie.
pub(crate) fn recognize_region(mesh: &Mesh, triangles: &[u32], limits: &Limits) -> Option<Recognized> {
    let evidence = Evidence::new(mesh, triangles)?;
    let carrier = carrier(&evidence, limits)?;
    Some(Recognized { carrier, evidence })
}

/// The simplest carrier that explains all nodes.
fn carrier(evidence: &Evidence, limits: &Limits) -> Option<Carrier> {
    let plane = evidence.plane().map(Carrier::Plane).filter(|plane| evidence.accepts(plane, limits));
    plane.or_else(|| {
        let cylinder = evidence.cylinder().filter(|cylinder| evidence.tells_roundness(cylinder, limits))?;
        Some(Carrier::Cylinder(cylinder)).filter(|cylinder| evidence.accepts(cylinder, limits))
    })
}
