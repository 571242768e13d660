//! Maps of closed meshes of genus 0 on to the unit sphere, without folds by construction.
//!
//! E. Praun, H. Hoppe, "Spherical parametrization and remeshing", SIGGRAPH 2003: coarse to fine, each node enters where
//! no triangle turns over; energy, levels and limits of our own.
//!
//! 1. Half-edge collapses lead to a tetrahedron (`hierarchy`), whose map is the regular one.
//! 2. Nodes come back in the reverse order. The place of a node is one from which all edges of its ring are seen from
//!    inside (`place`): there is one beside the node it had gone to, whose triangles were positive.
//! 3. Guarded Newton steps lower the symmetric Dirichlet energy of the triangles around one node
//!    (`dirichlet`): of each new node, of its ring now and then, and in sweeps over all nodes whenever
//!    their number has grown by `GROWTH`. Nodes of one colour are no neighbours and move at the same time.
//!
//! No step ever turns a triangle over, so the map is one to one however far it has come. Areas in space are scaled to
//! those of the sphere: the energy per area is 4 for an isometry.

mod error;
mod hierarchy;
mod place;

pub use error::SphereError;

use super::dirichlet::{Shape, Star, Target};
use crate::Control;
use crate::control::Stage;
use crate::geometry::{Orientation, orientation_of_cone};
use crate::memory::{self, CollectVec, ParallelCollectVec};
use crate::mesh::Mesh;
use crate::mesh::rings::Rings;
use glam::DVec3;
use rayon::prelude::*;
use std::f64::consts::PI;
use std::time::Instant;

/// All nodes are swept when there are so many times more of them than at the last time.
const GROWTH: f64 = 1.7;
/// The number of nodes at the first sweeps.
const FIRST_LEVEL: usize = 16;
/// No sweeps so shortly before the last node: those at the end do the same.
const LAST_LEVEL: f64 = 1.2;
/// Sweeps of a level; of a small one, where large errors are mended cheaply, [`SMALL_LEVEL_SWEEPS`].
const LEVEL_SWEEPS: usize = 3;
/// Sweeps of a level below [`SMALL_LEVEL`] nodes.
const SMALL_LEVEL_SWEEPS: usize = 12;
const SMALL_LEVEL: usize = 4096;
/// Newton steps of a node that enters.
const ENTRY_STEPS: usize = 3;
/// Every so many entries the ring of the new node moves too; while there are few nodes, at each entry.
const RING_INTERVAL: usize = 4;
/// This many nodes are few.
const FEW_NODES: usize = 64;
/// Entries between two questions to the listener: ten milliseconds.
const ENTRIES_PER_REPORT: usize = 512;
/// Nodes of one colour that move between two questions to the listener.
const PIECE: usize = 8192;
/// Nodes that one thread takes at a time.
const CHUNK: usize = 128;
/// Below this many nodes of a colour starting threads costs more than it saves.
const SERIAL: usize = 512;
/// Times the nodes around an entry may move to make room for it.
const ROOM_ATTEMPTS: usize = 8;

/// How a mesh is mapped on to the sphere.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SphereOptions {
    /// Sweeps over all nodes at the end. Default 10; twice as many lower the energy by about a thousandth.
    pub sweeps: usize,
}

impl Default for SphereOptions {
    fn default() -> Self {
        Self { sweeps: 10 }
    }
}

impl SphereOptions {
    /// The same with another number of sweeps at the end.
    pub const fn with_sweeps(self, sweeps: usize) -> Self {
        Self { sweeps }
    }
}

/// How good a map is and what it took.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SphereReport {
    /// Symmetric Dirichlet energy by area: 4 for an isometry, which only a sphere has.
    pub energy: f64,
    /// Triangles whose images are turned over or flat, by the exact sign. 0 but where rounding leaves no room.
    pub folded_triangles: usize,
    /// Triangles so thin that they count as wider.
    pub clamped_triangles: usize,
    /// The fifth percentile of image area by area in space, each as a share of its whole; by area.
    pub low_area_ratio: f64,
    /// The ninety-fifth.
    pub high_area_ratio: f64,
    /// Wall time.
    pub seconds: f64,
}

/// The places of the nodes of a mesh on the unit sphere.
#[derive(Debug, Clone, PartialEq)]
pub struct SphereMap {
    /// By node: a unit vector, or zero for a node without triangles.
    pub points: Vec<DVec3>,
    /// How good the map is and what it took.
    pub report: SphereReport,
}

/// Maps a closed mesh of genus 0 on to the unit sphere; triangles are counter-clockwise seen from outside.
pub fn map_to_sphere(
    mesh: &Mesh,
    options: &SphereOptions,
    control: &mut Control,
) -> Result<SphereMap, SphereError> {
    let start = Instant::now();
    check(mesh)?;
    control.enter(Stage::Parameterize);
    control.set_stage(0.0, 0.3);
    let mut rings = Rings::new(mesh);
    let order = hierarchy::collapse(mesh, &mut rings, control)?;
    let mut map = Growing::from_tetrahedron(mesh, rings, &order);
    control.set_stage(0.3, 0.7);
    map.grow(&order, control)?;
    control.set_stage(0.7, 1.0);
    map.sweep(options.sweeps, control)?;
    let mut report = measure(mesh, &map.places);
    report.seconds = start.elapsed().as_secs_f64();
    Ok(SphereMap { points: map.places, report })
}

/// Whether there can be a map at all.
fn check(mesh: &Mesh) -> Result<(), SphereError> {
    if mesh.component_count() != 1 {
        return Err(SphereError::Components { count: mesh.component_count() });
    }
    if let Some(first) = mesh.loops().first() {
        return Err(SphereError::Open { loops: mesh.loops().len(), node: first[0] as usize });
    }
    if let Some(&node) = mesh.pinched_nodes().first() {
        return Err(SphereError::Pinched { node: node as usize });
    }
    if mesh.genus() != 0 {
        return Err(SphereError::Genus { genus: mesh.genus() });
    }
    if !(total_area(mesh) > 0.0) {
        return Err(SphereError::ZeroArea { count: mesh.triangles().len() });
    }
    Ok(())
}

fn total_area(mesh: &Mesh) -> f64 {
    mesh.triangles().iter().map(|triangle| area(triangle.map(|node| mesh.points()[node as usize]))).sum()
}

fn area([a, b, c]: [DVec3; 3]) -> f64 {
    0.5 * (b - a).cross(c - a).length()
}

/// A map of the nodes that have come back.
struct Growing<'a> {
    points: &'a [DVec3],
    rings: Rings,
    places: Vec<DVec3>,
    /// The nodes that are there.
    live: Vec<u32>,
    /// Area of the sphere by the area of their triangles.
    area_scale: f64,
}

impl<'a> Growing<'a> {
    /// The four nodes that are left at the corners of the regular tetrahedron.
    fn from_tetrahedron(mesh: &'a Mesh, rings: Rings, order: &[u32]) -> Self {
        let mut is_gone = memory::filled(false, mesh.points().len());
        order.iter().for_each(|&node| is_gone[node as usize] = true);
        let nodes = 0..mesh.points().len() as u32;
        let live: Vec<u32> =
            nodes.filter(|&node| !is_gone[node as usize] && rings.valence(node) > 0).collect_vec();
        let mut places = memory::filled(DVec3::ZERO, mesh.points().len());
        // the other three are counter-clockwise around the first, seen from outside
        let top = live[0];
        places[top as usize] = DVec3::Z;
        for (k, &node) in rings.of(top).iter().enumerate() {
            let angle = 2.0 * PI * k as f64 / 3.0;
            let (radius, height) = (8.0_f64.sqrt() / 3.0, -1.0 / 3.0);
            places[node as usize] = DVec3::new(radius * angle.cos(), radius * angle.sin(), height);
        }
        let mut map = Self { points: mesh.points(), rings, places, live, area_scale: 1.0 };
        map.scale_areas();
        map
    }

    fn scale_areas(&mut self) {
        let corners = self.live.iter().flat_map(|&node| self.triangles(node));
        let sum: f64 = corners.map(|triangle| area(triangle.map(|node| self.points[node as usize]))).sum();
        self.area_scale = 4.0 * PI / (sum / 3.0).max(f64::MIN_POSITIVE);
    }

    /// The triangles around a node, that first.
    fn triangles(&self, node: u32) -> impl Iterator<Item = [u32; 3]> + '_ {
        let ring = self.rings.of(node);
        ring.iter().zip(ring.iter().cycle().skip(1)).map(move |(&a, &b)| [node, a, b])
    }

    /// Brings the collapsed nodes back, the last first.
    fn grow(&mut self, order: &[u32], control: &mut Control) -> Result<(), SphereError> {
        let all = self.live.len() + order.len();
        let mut next_level = FIRST_LEVEL;
        let mut star = Star::default();
        for &node in order.iter().rev() {
            self.enter(node, &mut star)?;
            let count = self.live.len();
            if count == next_level {
                let sweeps = if count < SMALL_LEVEL { SMALL_LEVEL_SWEEPS } else { LEVEL_SWEEPS };
                let fraction = count as f64 / all as f64;
                control.report(fraction, f64::NAN)?;
                self.sweep_level(sweeps, control, |_| fraction)?;
                next_level = (GROWTH * count as f64) as usize;
                if LAST_LEVEL * next_level as f64 > all as f64 {
                    next_level = usize::MAX;
                }
            }
            if count.is_multiple_of(ENTRIES_PER_REPORT) {
                control.report(count as f64 / all as f64, f64::NAN)?;
            }
        }
        Ok(())
    }

    /// Brings a node back where it turns nothing over, and lets it settle.
    fn enter(&mut self, node: u32, star: &mut Star) -> Result<(), SphereError> {
        self.rings.expand(node);
        let ring = self.rings.of(node).to_vec();
        let room = |map: &Self| {
            let around: Vec<DVec3> = ring.iter().map(|&other| map.places[other as usize]).collect_vec();
            place::inside(&around)
        };
        let mut place = room(self);
        for _ in 0..ROOM_ATTEMPTS {
            if place.is_some() {
                break;
            }
            self.make_room(node, &ring, star);
            place = room(self);
        }
        self.places[node as usize] = place.ok_or(SphereError::NoRoom { node: node as usize })?;
        memory::push(&mut self.live, node);
        for _ in 0..ENTRY_STEPS {
            self.settle(node, star);
        }
        let count = self.live.len();
        if count < FEW_NODES || count.is_multiple_of(RING_INTERVAL) {
            ring.iter().for_each(|&other| self.settle(other, star));
            self.settle(node, star);
        }
        Ok(())
    }

    /// Lets the nodes around an entry settle as if it were still gone.
    fn make_room(&mut self, node: u32, ring: &[u32], star: &mut Star) {
        self.rings.collapse(node, ring[0]);
        ring.iter().for_each(|&other| self.settle(other, star));
        self.rings.expand(node);
    }

    /// One step of one node.
    fn settle(&mut self, node: u32, star: &mut Star) {
        self.places[node as usize] = self.settled(node, star);
    }

    fn settled(&self, node: u32, star: &mut Star) -> DVec3 {
        star.clear();
        for triangle in self.triangles(node) {
            let shape = Shape::new(triangle.map(|node| self.points[node as usize]), self.area_scale);
            let [_, a, b] = triangle.map(|node| self.places[node as usize]);
            star.push(&shape, a, b);
        }
        let place = self.places[node as usize];
        star.step(place, Target::Sphere, |_| true).unwrap_or(place)
    }

    /// Sweeps over all nodes, colour by colour.
    fn sweep(&mut self, sweeps: usize, control: &mut Control) -> Result<(), SphereError> {
        self.sweep_level(sweeps, control, |fraction| fraction)
    }

    fn sweep_level(
        &mut self,
        sweeps: usize,
        control: &mut Control,
        progress: impl Fn(f64) -> f64,
    ) -> Result<(), SphereError> {
        self.scale_areas();
        let colours = self.rings.coloured(&self.live);
        let steps = (sweeps * self.live.len()) as f64;
        let mut done = 0;
        for _ in 0..sweeps {
            for piece in colours.iter().flat_map(|colour| colour.chunks(PIECE)) {
                let settled = self.all_settled(piece, control);
                piece.iter().zip(settled).for_each(|(&node, place)| self.places[node as usize] = place);
                done += piece.len();
                control.report(progress(done as f64 / steps), f64::NAN)?;
            }
        }
        Ok(())
    }

    /// Where these nodes, no two of them neighbours, go in one step.
    fn all_settled(&self, nodes: &[u32], control: &Control) -> Vec<DVec3> {
        let settled = |nodes: &[u32]| -> Vec<DVec3> {
            let mut star = Star::default();
            nodes.iter().map(|&node| self.settled(node, &mut star)).collect_vec()
        };
        if nodes.len() < SERIAL || control.thread_count() == 1 {
            return settled(nodes);
        }
        let chunks = control.run(|| nodes.par_chunks(CHUNK).map(settled).collect_vec());
        chunks.into_iter().flatten().collect_vec()
    }
}

fn measure(mesh: &Mesh, places: &[DVec3]) -> SphereReport {
    let area_scale = 4.0 * PI / total_area(mesh);
    let (mut energy, mut folded, mut clamped) = (0.0, 0, 0);
    let mut ratios = memory::with_capacity(mesh.triangles().len());
    for triangle in mesh.triangles() {
        let corners = triangle.map(|node| mesh.points()[node as usize]);
        let images = triangle.map(|node| places[node as usize]);
        let shape = Shape::new(corners, area_scale);
        clamped += usize::from(shape.is_clamped);
        folded += usize::from(orientation_of_cone(images) != Orientation::Positive);
        energy += shape.energy(images);
        let own = area_scale * area(corners);
        if own > 0.0 {
            memory::push(&mut ratios, (solid_angle(images) / own, own));
        }
    }
    ratios.sort_unstable_by(|x, y| x.0.total_cmp(&y.0));
    let percentile = |share: f64| {
        let mut left = share * 4.0 * PI;
        let reached = ratios.iter().find(|&&(_, area)| {
            left -= area;
            left <= 0.0
        });
        reached.or(ratios.last()).map_or(f64::NAN, |&(ratio, _)| ratio)
    };
    SphereReport {
        energy: energy / (4.0 * PI),
        folded_triangles: folded,
        clamped_triangles: clamped,
        low_area_ratio: percentile(0.05),
        high_area_ratio: percentile(0.95),
        seconds: 0.0,
    }
}

/// A. van Oosterom, J. Strackee, "The solid angle of a plane triangle", IEEE Trans. Biomed. Eng. 30 (1983), 125-126.
fn solid_angle([a, b, c]: [DVec3; 3]) -> f64 {
    2.0 * a.dot(b.cross(c)).atan2(1.0 + a.dot(b) + b.dot(c) + c.dot(a))
}

#[cfg(test)]
mod tests;
