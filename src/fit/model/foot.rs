//! Foot points on a surface of patches: they may cross smooth edges, and those on creases slide along them.

use super::locks::{Lock, along, on_side};
use crate::control::Pool;
use crate::layout::{Layout, Place};
use crate::linalg::Symmetric2;
use crate::memory;
use crate::surface::Surface;
use crate::surface::pht::PhtSurface;
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// Longest step, as a part of a patch.
const LONGEST_STEP: f64 = 0.1;
/// Least part of a right angle's determinant that a step is divided by: below it the tangents are nearly parallel.
const LEAST_ANGLE: f64 = 1e-6;
/// Times that a step which leads away is halved: beside narrow corners, and across edges to patches of another size, full
/// steps go too far.
const HALVINGS: i32 = 3;
/// A step that changes the distance by less than this part has arrived.
const ARRIVED: f64 = 1e-9;
/// Samples of one piece of work.
const PIECE: usize = 512;

/// What foot points move over.
#[derive(Clone, Copy)]
pub(super) struct Ground<'a> {
    pub layout: &'a Layout,
    pub surfaces: &'a [PhtSurface],
    /// By vertex of the layout: whether samples on creases stop there.
    pub is_corner: &'a [bool],
}

/// Moves each place by Gauss-Newton steps towards the foot of its point, if that brings it nearer and its lock lets
/// it; returns the distances.
pub(super) fn foot_points(
    ground: Ground,
    places: &mut [Place],
    locks: &mut [Lock],
    points: &[DVec3],
    steps: u32,
    pool: &Pool,
) -> Vec<f64> {
    let mut distances = memory::filled(0.0, places.len());
    pool.run(|| {
        let data =
            places.par_chunks_mut(PIECE).zip(locks.par_chunks_mut(PIECE)).zip(points.par_chunks(PIECE));
        distances.par_chunks_mut(PIECE).zip(data).for_each(|(distances, ((places, locks), points))| {
            let samples = places.iter_mut().zip(locks).zip(points);
            for (distance, ((place, lock), &point)) in distances.iter_mut().zip(samples) {
                *distance = ground.step_to_foot(place, lock, point, steps);
            }
        });
    });
    distances
}

impl Ground<'_> {
    fn step_to_foot(&self, place: &mut Place, lock: &mut Lock, point: DVec3, steps: u32) -> f64 {
        let mut row = [0.0; 9];
        for _ in 0..steps {
            self.surfaces[place.quad as usize].eval_rows(&[place.uv], 1, &mut row);
            let [on_surface, along_u, along_v] = [0, 3, 6].map(|k| DVec3::from_slice(&row[k..k + 3]));
            let miss = point - on_surface;
            let before = miss.length();
            let moved = |share: f64| self.moved(*place, *lock, share, [miss, along_u, along_v]);
            let mut tried = (0..=HALVINGS).map(|k| {
                let to = moved(0.5_f64.powi(k));
                (to, distance(self.surfaces, to.0, point))
            });
            match tried.find(|(_, after)| *after < (1.0 + ARRIVED) * before) {
                Some((to, after)) if after < before => (*place, *lock) = to,
                _ => return before,
            }
        }
        distance(self.surfaces, *place, point)
    }

    /// Where a share of the step to the foot leads.
    fn moved(
        &self,
        place: Place,
        lock: Lock,
        share: f64,
        [miss, along_u, along_v]: [DVec3; 3],
    ) -> (Place, Lock) {
        match lock {
            Lock::Fixed => (place, lock),
            Lock::Free => {
                (self.layout.cross(place.quad, place.uv + share * step(miss, along_u, along_v)), lock)
            }
            Lock::Along(side) => {
                let step = share * step_along(miss, along(side, along_u, along_v));
                let next = on_side(place, side).slide(self.layout, step, self.is_corner);
                (next.place(), next.lock())
            }
        }
    }
}

/// The step that would reach the foot on the tangent.
fn step_along(miss: DVec3, tangent: DVec3) -> f64 {
    let square = tangent.length_squared();
    if square > 0.0 { (tangent.dot(miss) / square).clamp(-LONGEST_STEP, LONGEST_STEP) } else { 0.0 }
}

/// The step that would reach the foot on the tangent plane.
fn step(miss: DVec3, along_u: DVec3, along_v: DVec3) -> DVec2 {
    let metric = Symmetric2::of_products(along_u, along_v);
    let determinant = metric.determinant().max(LEAST_ANGLE * metric.uu * metric.vv);
    if !(determinant > 0.0) {
        return DVec2::ZERO;
    }
    let step = metric.adjugate(DVec2::new(along_u.dot(miss), along_v.dot(miss))) / determinant;
    step.clamp(DVec2::splat(-LONGEST_STEP), DVec2::splat(LONGEST_STEP))
}

fn distance(surfaces: &[PhtSurface], place: Place, point: DVec3) -> f64 {
    let mut row = [0.0; 3];
    surfaces[place.quad as usize].eval_rows(&[place.uv], 0, &mut row);
    DVec3::from_array(row).distance(point)
}
