//! What a transfer keeps of forces, moments and work: everything but roundoff and the distance between the meshes.

use super::TransferError;
use crate::summary::sum;
use glam::{DVec2, DVec3};

/// Sums over the forces given at the targets, and over those that arrive at the source's nodes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Balance {
    /// Sum of the forces given.
    pub force_given: DVec3,
    /// Sum of the forces that arrive.
    pub force_arrived: DVec3,
    /// Length of the difference, as a fraction of the sum of the lengths of the forces given.
    pub force_error: f64,
    /// Moment of the forces given.
    pub moment_given: DVec3,
    /// Moment of the forces that arrive.
    pub moment_arrived: DVec3,
    /// Length of the difference.
    pub moment_error: f64,
    /// What it cannot exceed but by roundoff: the sum of each force's length times its target's distance to the shape.
    pub moment_bound: f64,
    /// Work of the forces given along the displacements that arrive at the targets.
    pub work_given: f64,
    /// Work of the forces that arrive along the displacements given.
    pub work_arrived: f64,
    /// The difference, as a fraction of the sum of the targets' works without their signs.
    pub work_error: f64,
}

/// A linear map between the nodes of a source and targets, and its transpose.
pub trait Carry: std::fmt::Debug + Send + Sync {
    /// The nodes of the source, those without values included.
    fn source_points(&self) -> &[DVec3];

    /// The targets.
    fn target_points(&self) -> &[DVec3];

    /// Where the targets lie on it, if that has one parameter plane.
    fn parameters(&self) -> Option<&[DVec2]> {
        None
    }

    /// How far the targets are from the shape of the source.
    fn distances(&self) -> &[f64];

    /// Values at the targets: `out = T values`. Rows of `dim` numbers.
    fn apply(&self, values: &[f64], dim: usize, out: &mut [f64]) -> Result<(), TransferError>;

    /// Forces at the source's nodes: `out = T^T forces`. Rows of `dim` numbers; nodes without values get 0.
    fn apply_transpose(&self, forces: &[f64], dim: usize, out: &mut [f64]) -> Result<(), TransferError>;

    /// Number of nodes of the source, those without values included.
    fn source_count(&self) -> usize {
        self.source_points().len()
    }

    /// Number of targets.
    fn target_count(&self) -> usize {
        self.target_points().len()
    }

    /// Carries displacements of the source's nodes to the targets and forces on the targets to the nodes, both rows of
    /// three numbers, and adds up; moments are about `about`.
    fn balance(&self, displacements: &[f64], forces: &[f64], about: DVec3) -> Result<Balance, TransferError> {
        let mut moved = vec![0.0; 3 * self.target_count()];
        let mut arrived = vec![0.0; 3 * self.source_count()];
        self.apply(displacements, 3, &mut moved)?;
        self.apply_transpose(forces, 3, &mut arrived)?;
        let (given, got) = (rows(forces), rows(&arrived));
        let size: f64 = given.clone().map(DVec3::length).sum();
        let (force_given, force_arrived) = (vector_sum(given.clone()), vector_sum(got.clone()));
        let moment = |points: &[DVec3], forces: &[f64]| {
            vector_sum(points.iter().zip(rows(forces)).map(|(&p, force)| (p - about).cross(force)))
        };
        let moment_given = moment(self.target_points(), forces);
        let moment_arrived = moment(self.source_points(), &arrived);
        let lever =
            self.distances().iter().zip(given.clone()).map(|(distance, force)| distance * force.length());
        let works = given.zip(rows(&moved)).map(|(force, way)| force.dot(way));
        let work_given = sum(works.clone());
        // nodes without values get no force, and their displacements are not looked at
        let is_met = |(force, _): &(DVec3, DVec3)| *force != DVec3::ZERO;
        let work_arrived =
            sum(got.zip(rows(displacements)).filter(is_met).map(|(force, way)| force.dot(way)));
        Ok(Balance {
            force_given,
            force_arrived,
            force_error: fraction((force_arrived - force_given).length(), size),
            moment_given,
            moment_arrived,
            moment_error: (moment_arrived - moment_given).length(),
            moment_bound: sum(lever),
            work_given,
            work_arrived,
            work_error: fraction((work_arrived - work_given).abs(), works.map(f64::abs).sum()),
        })
    }
}

fn rows(numbers: &[f64]) -> impl Iterator<Item = DVec3> + Clone {
    numbers.chunks_exact(3).map(DVec3::from_slice)
}

fn vector_sum(vectors: impl Iterator<Item = DVec3> + Clone) -> DVec3 {
    DVec3::from_array([0, 1, 2].map(|k| sum(vectors.clone().map(|v| v[k]))))
}

/// `part / whole`; of nothing nothing.
fn fraction(part: f64, whole: f64) -> f64 {
    if part == 0.0 { 0.0 } else { part / whole }
}
