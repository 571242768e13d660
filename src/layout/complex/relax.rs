//! Relaxation of a node map over the whole layout.
//!
//! Each node takes Newton steps in a picture of the quads around it ([`chart`](super::chart)), with the symmetric
//! Dirichlet energy of its triangles ([`dirichlet`](crate::parameterize::dirichlet)). Nodes cross edges, and with them
//! edges and vertices of the layout slide over the mesh until patches are equal and square. Nodes whose triangles are
//! turned over at the start go first to where the least of their determinants is largest; from then on none turns over.

use super::chart::Chart;
use crate::Control;
use crate::control::Cancelled;
use crate::layout::{Layout, Place};
use crate::mesh::Mesh;
use crate::mesh::rings::Rings;
use crate::parameterize::dirichlet::{Shape, Star, Target};
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use std::f64::consts::FRAC_PI_4;

/// Sweeps between two looks at the energy.
const SWEEPS_PER_LOOK: usize = 10;
/// Sweeps end when as many lower the energy by no more than this share.
const LEAST_GAIN: f64 = 1e-4;
/// Nodes of one colour that move between two questions to the listener.
const PIECE: usize = 4096;
/// Nodes that one thread takes at a time.
const CHUNK: usize = 64;
/// Below this many nodes of a colour starting threads costs more than it saves.
const SERIAL: usize = 256;
/// Shortest step of a repair.
const LEAST_STEP: f64 = 1e-7;

/// How good a map is.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Quality {
    /// Energy by area, of the nodes that have one: 4 for an isometry.
    pub energy: f64,
    /// Nodes with a triangle that is turned over.
    pub folded: usize,
    /// Nodes whose triangles are spread over more quads than one picture shows.
    pub spread: usize,
}

/// Relaxes the map in at most so many sweeps; `places` are there for all nodes with triangles.
pub(super) fn relax(
    mesh: &Mesh,
    layout: &Layout,
    places: &mut [Option<Place>],
    sweeps: usize,
    control: &mut Control,
) -> Result<Quality, Cancelled> {
    let map = Map::new(mesh, layout, places);
    let colours = map.rings.coloured(&map.nodes);
    let mut quality = map.quality(control);
    for sweep in 1..=sweeps {
        for piece in colours.iter().flat_map(|colour| colour.chunks(PIECE)) {
            let settled = map.all_settled(piece, control);
            piece.iter().zip(settled).for_each(|(&node, place)| map.places[node as usize] = place);
            control.report((sweep - 1) as f64 / sweeps as f64, f64::NAN)?;
        }
        if sweep.is_multiple_of(SWEEPS_PER_LOOK) || sweep == sweeps {
            let now = map.quality(control);
            let is_sound = now.folded + now.spread == 0;
            let has_settled = is_sound && now.energy > (1.0 - LEAST_GAIN) * quality.energy;
            quality = now;
            if has_settled {
                break;
            }
        }
    }
    control.report(1.0, f64::NAN)?;
    Ok(quality)
}

/// The quality of a map as it is.
pub(super) fn measure(
    mesh: &Mesh,
    layout: &Layout,
    places: &mut [Option<Place>],
    control: &Control,
) -> Quality {
    Map::new(mesh, layout, places).quality(control)
}

struct Map<'a> {
    points: &'a [DVec3],
    layout: &'a Layout,
    rings: Rings,
    /// Nodes with triangles.
    nodes: Vec<u32>,
    places: &'a mut [Option<Place>],
    /// Area of all patches by area in space.
    area_scale: f64,
}

impl<'a> Map<'a> {
    fn new(mesh: &'a Mesh, layout: &'a Layout, places: &'a mut [Option<Place>]) -> Self {
        let nodes = (0..mesh.points().len() as u32).filter(|&node| mesh.is_used(node)).collect();
        let area = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|node| mesh.points()[node as usize]);
            0.5 * (b - a).cross(c - a).length()
        };
        let area: f64 = mesh.triangles().iter().map(area).sum();
        let area_scale = layout.quads().len() as f64 / area;
        Self { points: mesh.points(), layout, rings: Rings::new(mesh), nodes, places, area_scale }
    }

    /// The picture around a node with the node's place in it, and its triangles; none if one of them is not in it.
    fn star(&self, node: u32, star: &mut Star) -> Option<(Chart<'a>, DVec2)> {
        star.clear();
        let place = self.places[node as usize]?;
        let ring = self.rings.of(node);
        let quads = ring.iter().filter_map(|&other| self.places[other as usize]).map(|place| place.quad);
        let chart = Chart::around(self.layout, place, quads);
        let picture = |node: u32| chart.picture(self.places[node as usize]?);
        for (&a, &b) in ring.iter().zip(ring.iter().cycle().skip(1)) {
            let shape = Shape::new([node, a, b].map(|node| self.points[node as usize]), self.area_scale);
            star.push(&shape, picture(a)?.extend(1.0), picture(b)?.extend(1.0));
        }
        Some((chart, chart.picture(place)?))
    }

    /// Where a node goes in one step.
    fn settled(&self, node: u32, star: &mut Star) -> Option<Place> {
        let place = self.places[node as usize];
        let Some((chart, start)) = self.star(node, star) else { return place };
        let accepts = |point: DVec3| chart.place(self.layout, point.truncate()).is_some();
        let moved = if star.energy(start.extend(1.0)).is_finite() {
            star.step(start.extend(1.0), Target::Plane, accepts)
        } else {
            unfolded(star, start, accepts)
        };
        moved.and_then(|point| chart.place(self.layout, point.truncate())).or(place)
    }

    /// Where these nodes, no two of them neighbours, go in one step.
    fn all_settled(&self, nodes: &[u32], control: &Control) -> Vec<Option<Place>> {
        let settled = |nodes: &[u32]| -> Vec<Option<Place>> {
            let mut star = Star::default();
            nodes.iter().map(|&node| self.settled(node, &mut star)).collect()
        };
        if nodes.len() < SERIAL || control.thread_count() == 1 {
            return settled(nodes);
        }
        control.run(|| nodes.par_chunks(CHUNK).flat_map_iter(settled).collect())
    }

    fn quality(&self, control: &Control) -> Quality {
        let part = |nodes: &[u32]| {
            let mut star = Star::default();
            nodes.iter().fold(Quality::default(), |mut sum, &node| {
                match self.star(node, &mut star).map(|(_, place)| star.energy(place.extend(1.0))) {
                    None => sum.spread += 1,
                    Some(energy) if energy.is_finite() => sum.energy += energy,
                    Some(_) => sum.folded += 1,
                }
                sum
            })
        };
        // pieces of one size, added in their order: the same bits on any number of threads
        let parts: Vec<Quality> = control.run(|| self.nodes.par_chunks(PIECE).map(part).collect());
        let sum = parts.iter().fold(Quality::default(), |sum, part| Quality {
            energy: sum.energy + part.energy,
            folded: sum.folded + part.folded,
            spread: sum.spread + part.spread,
        });
        // each triangle is counted at its three nodes
        Quality { energy: sum.energy / (3.0 * self.layout.quads().len() as f64), ..sum }
    }
}

/// The place where the least determinant of the triangles is largest, by a search with shrinking steps.
fn unfolded(star: &Star, start: DVec2, accepts: impl Fn(DVec3) -> bool) -> Option<DVec3> {
    let (mut best, mut least) = (start.extend(1.0), star.least_det(start.extend(1.0)));
    let (count, sum) =
        star.corners().fold((0.0, DVec3::ZERO), |(count, sum), corner| (count + 1.0, sum + corner));
    let middle = sum / count;
    if star.least_det(middle) > least && accepts(middle) {
        (best, least) = (middle, star.least_det(middle));
    }
    let mut step = star.corners().map(|corner| corner.distance(best)).fold(0.0, f64::max);
    while step > LEAST_STEP {
        let around = (0..8).map(|k| best + step * DVec2::from_angle(f64::from(k) * FRAC_PI_4).extend(0.0));
        let better = around.map(|point| (point, star.least_det(point)));
        let better = better.filter(|&(point, det)| det > least && accepts(point));
        match better.max_by(|a, b| a.1.total_cmp(&b.1)) {
            Some(better) => (best, least) = better,
            None => step *= 0.5,
        }
    }
    Some(best)
}
