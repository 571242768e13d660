//! Relaxation of a node map over the whole layout.
//!
//! Each node takes Newton steps in a picture of the quads around it (`chart`), with the symmetric
//! Dirichlet energy of its triangles (`parameterize::dirichlet`). Nodes cross edges, and with them
//! edges and vertices of the layout slide over the mesh until patches are equal and square. Nodes whose triangles are
//! turned over go to where the least area of these is, which may turn over one of a neighbour's to right larger ones; steps of all
//! other nodes turn none over.

use super::base::Fine;
use super::border::Border;
use super::chart::Chart;
use crate::Control;
use crate::control::Cancelled;
use crate::layout::{Layout, Place, Side};
use crate::mesh::rings::Rings;
use crate::parameterize::dirichlet::{Shape, Star, Target};
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use std::f64::consts::FRAC_PI_4;

/// Sweeps between two looks at the energy.
const SWEEPS_PER_LOOK: usize = 10;
/// Sweeps of a level end when as many lower the energy by no more than this share.
const LEAST_GAIN: f64 = 1e-4;
/// Nodes come back until there are so many times more of them, then all are swept.
const GROWTH: f64 = 1.7;
/// Sweeps of a level between the middle one and the last.
const LEVEL_SWEEPS: usize = 6;
/// Most sweeps of the last level: what is smooth has settled before.
const LAST_SWEEPS: usize = 20;
/// Rounds over the nodes around those whose triangles are turned over or spread.
const MEND_ROUNDS: usize = 120;
/// Of so many rounds the last moves nodes to where their triangles are best, the others to the middle of their neighbours.
const MEND_CYCLE: usize = 4;
/// Newton steps of a node that comes back.
const ENTRY_STEPS: usize = 2;
/// Entries between two questions to the listener.
const ENTRIES_PER_REPORT: usize = 512;
/// Share of the work that the middle level is for the listener.
const MIDDLE_SHARE: f64 = 0.4;
/// Nodes of one colour that move between two questions to the listener.
const PIECE: usize = 4096;
/// Nodes that one thread takes at a time.
const CHUNK: usize = 64;
/// Below this many nodes of a colour starting threads costs more than it saves.
const SERIAL: usize = 256;
/// Shortest step of a repair.
const LEAST_STEP: f64 = 1e-7;
/// The share of the area turned over that a step of it has to gain, times its length beside the first: along a ridge it would go on
/// by what rounding gains, without end.
const WORTH_A_STEP: f64 = 1e-3;

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

impl Quality {
    fn is_sound(&self) -> bool {
        self.folded + self.spread == 0
    }
}

/// Relaxes the map of the middle level in at most so many sweeps, brings the other nodes back and relaxes them all.
/// Returns the quality before, of the middle level, and after.
pub(super) fn relax(
    border: &Border,
    layout: &Layout,
    places: &mut [Option<Place>],
    fine: Fine,
    sweeps: usize,
    control: &mut Control,
) -> Result<(Quality, Quality), Cancelled> {
    let mut map = Map::new(border, layout, places, fine.rings, &fine.order);
    let first = map.quality(control);
    let has_levels = !fine.order.is_empty();
    let middle = if has_levels { MIDDLE_SHARE } else { 1.0 };
    let mut quality = map.sweep(sweeps, control, |fraction| middle * fraction)?;
    if has_levels {
        map.grow(&fine.order, control)?;
        quality = map.sweep(LAST_SWEEPS.min(sweeps), control, |fraction| 0.7 + 0.3 * fraction)?;
    }
    if !quality.is_sound() {
        map.mend(control)?;
        quality = map.quality(control);
    }
    control.report(1.0, f64::NAN)?;
    Ok((first, quality))
}

struct Map<'a> {
    border: &'a Border,
    layout: &'a Layout,
    rings: Rings,
    /// Nodes that are there and may move.
    nodes: Vec<u32>,
    places: &'a mut [Option<Place>],
    /// Area of all patches by area in space.
    area_scale: f64,
}

impl<'a> Map<'a> {
    /// Without the nodes that come later; those of the border have places for good.
    fn new(
        border: &'a Border,
        layout: &'a Layout,
        places: &'a mut [Option<Place>],
        rings: Rings,
        later: &[u32],
    ) -> Self {
        let count = border.first_tip;
        let may_move = |node: u32| rings.valence(node) > 0 && border.node(node).is_none();
        let mut is_there: Vec<bool> = (0..count).map(may_move).collect();
        later.iter().for_each(|&node| is_there[node as usize] = false);
        let nodes = (0..).zip(is_there).filter(|&(_, is_there)| is_there).map(|(node, _)| node).collect();
        let area_scale = layout.quads().len() as f64 / border.area();
        Self { border, layout, rings, nodes, places, area_scale }
    }

    fn point(&self, node: u32) -> DVec3 {
        self.border.closed.points()[node as usize]
    }

    /// Sweeps over all nodes, until they have settled.
    fn sweep(
        &mut self,
        sweeps: usize,
        control: &mut Control,
        progress: impl Fn(f64) -> f64,
    ) -> Result<Quality, Cancelled> {
        let colours = self.rings.coloured(&self.nodes);
        let mut last: Option<Quality> = None;
        for sweep in 0..sweeps {
            if sweep.is_multiple_of(SWEEPS_PER_LOOK) {
                let now = self.quality(control);
                let gain = last.filter(Quality::is_sound).map_or(1.0, |last| 1.0 - now.energy / last.energy);
                last = Some(now);
                if now.is_sound() && gain < LEAST_GAIN {
                    break;
                }
            }
            for piece in colours.iter().flat_map(|colour| colour.chunks(PIECE)) {
                let settled = self.all_settled(piece, control);
                piece.iter().zip(settled).for_each(|(&node, place)| self.places[node as usize] = place);
                control.report(progress(sweep as f64 / sweeps as f64), f64::NAN)?;
            }
        }
        Ok(self.quality(control))
    }

    /// Untangles what sweeps could not: a node alone has no place where nothing is turned over, but when all around it
    /// move to the middle of their neighbours, as W. Tutte drew graphs (1963), there is one.
    fn mend(&mut self, control: &mut Control) -> Result<(), Cancelled> {
        let mut star = Star::default();
        let mut suspects = self.nodes.clone();
        for round in 0..MEND_ROUNDS {
            control.report(1.0, f64::NAN)?;
            let bad: Vec<u32> =
                suspects.into_iter().filter(|&node| !self.is_sound(node, &mut star)).collect();
            if bad.is_empty() {
                break;
            }
            let around = bad.iter().flat_map(|&node| self.rings.of(node)).copied();
            suspects =
                bad.iter().copied().chain(around).filter(|&node| self.border.node(node).is_none()).collect();
            suspects.sort_unstable();
            suspects.dedup();
            for &node in &suspects {
                let is_last = round % MEND_CYCLE == MEND_CYCLE - 1;
                let moved = if is_last { None } else { self.middle(node, &mut star) };
                self.places[node as usize] = moved.or_else(|| self.settled(node, &mut star));
            }
        }
        Ok(())
    }

    /// Whether all triangles of a node are in one picture and none is turned over.
    fn is_sound(&self, node: u32, star: &mut Star) -> bool {
        self.star(node, star).is_some_and(|(_, place)| star.energy(place.extend(1.0)).is_finite())
    }

    /// The middle of the neighbours of a node that is not sound.
    fn middle(&self, node: u32, star: &mut Star) -> Option<Place> {
        let (chart, place) = self.star(node, star)?;
        if star.energy(place.extend(1.0)).is_finite() {
            return None;
        }
        let (count, sum) =
            star.corners().fold((0.0, DVec3::ZERO), |(count, sum), corner| (count + 1.0, sum + corner));
        chart.place(self.layout, (sum / count).truncate())
    }

    /// Brings nodes back, the last first, and sweeps when there are many more.
    fn grow(&mut self, order: &[u32], control: &mut Control) -> Result<(), Cancelled> {
        let all = (self.nodes.len() + order.len()) as f64;
        let mut next_level = GROWTH * self.nodes.len() as f64;
        let mut star = Star::default();
        for &node in order.iter().rev() {
            self.enter(node, &mut star);
            let count = self.nodes.len();
            let progress = MIDDLE_SHARE + (0.7 - MIDDLE_SHARE) * count as f64 / all;
            if count as f64 >= next_level {
                self.sweep(LEVEL_SWEEPS, control, |_| progress)?;
                next_level *= GROWTH;
            }
            if count.is_multiple_of(ENTRIES_PER_REPORT) {
                control.report(progress, f64::NAN)?;
            }
        }
        Ok(())
    }

    /// Brings a node back inside its ring, if that fits into a picture, else where the node lies that it had gone to.
    fn enter(&mut self, node: u32, star: &mut Star) {
        self.rings.expand(node);
        if self.border.node(node).is_some() {
            return;
        }
        self.nodes.push(node);
        self.places[node as usize] = self.places[self.rings.of(node)[0] as usize];
        let Some((chart, start)) = self.star(node, star) else { return };
        let accepts = |point: DVec3| chart.place(self.layout, point.truncate()).is_some();
        if let Some(point) = unfolded(star, start, accepts)
            && let Some(place) = chart.place(self.layout, point.truncate())
        {
            self.places[node as usize] = Some(place);
        }
        for _ in 0..ENTRY_STEPS {
            self.places[node as usize] = self.settled(node, star);
        }
    }

    /// The picture around a node with the node's place in it, and its triangles; none if one of them is not in it.
    fn star(&self, node: u32, star: &mut Star) -> Option<(Chart<'a>, DVec2)> {
        star.clear();
        let place = self.places[node as usize]?;
        let ring = self.rings.of(node);
        let around = ring.iter().filter_map(|&other| self.places[other as usize]);
        // a node at a vertex lies on all quads around it
        let is_here = |other: Place| self.corners_at(other).iter().any(|corner| corner.quad == place.quad);
        let quads = around.map(|other| if is_here(other) { place.quad } else { other.quad });
        let chart = Chart::around(self.layout, place, quads);
        let picture = |node: u32| self.picture(&chart, self.places[node as usize]?);
        for (&a, &b) in ring.iter().zip(ring.iter().cycle().skip(1)) {
            let shape = Shape::new([node, a, b].map(|node| self.point(node)), self.area_scale);
            star.push(&shape, picture(a)?.extend(1.0), picture(b)?.extend(1.0));
        }
        Some((chart, chart.picture(place)?))
    }

    /// Where a place is in a picture; one at a vertex on any quad around that.
    fn picture(&self, chart: &Chart, place: Place) -> Option<DVec2> {
        let at_corner = |&corner: &Side| chart.picture(corner.place(0.0, 0.0));
        chart.picture(place).or_else(|| self.corners_at(place).iter().find_map(at_corner))
    }

    /// The corners of all quads around the vertex at a place; none if it is at no vertex.
    fn corners_at(&self, place: Place) -> &[Side] {
        let side = match (place.uv.x, place.uv.y) {
            (0.0, 0.0) => 0,
            (1.0, 0.0) => 1,
            (1.0, 1.0) => 2,
            (0.0, 1.0) => 3,
            _ => return &[],
        };
        &self.layout.sector_at(Side { quad: place.quad, side }).corners
    }

    /// Where a node goes in one step.
    fn settled(&self, node: u32, star: &mut Star) -> Option<Place> {
        let place = self.places[node as usize];
        let Some((chart, start)) = self.star(node, star) else { return self.gathered(node).or(place) };
        let accepts = |point: DVec3| chart.place(self.layout, point.truncate()).is_some();
        let moved = if star.energy(start.extend(1.0)).is_finite() {
            star.step(start.extend(1.0), Target::Plane, accepts)
        } else {
            unfolded(star, start, accepts)
        };
        moved.and_then(|point| chart.place(self.layout, point.truncate())).or(place)
    }

    /// For a node with a star in no picture: the middle of its neighbours in the picture that has most of them. That may
    /// turn triangles over; once there is a picture, they are unfolded.
    fn gathered(&self, node: u32) -> Option<Place> {
        let charts = Chart::of_vertices(self.layout, self.places[node as usize]?);
        let around = |chart: &Chart| -> Vec<DVec2> {
            let places = self.rings.of(node).iter().filter_map(|&other| self.places[other as usize]);
            places.filter_map(|place| self.picture(chart, place)).collect()
        };
        let pictures = charts.map(|chart| (chart, around(&chart)));
        // of several the nearest vertex
        let (chart, points) = pictures.into_iter().rev().max_by_key(|(_, points)| points.len())?;
        let middle = points.iter().sum::<DVec2>() / points.len() as f64;
        chart.place(self.layout, middle)
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

/// The middle of the corners if nothing is turned over there, else the place where the area that is turned over is least, by a
/// search with shrinking steps. That area is a sum over triangles, so it shrinks for the whole map as far as pictures agree.
fn unfolded(star: &Star, start: DVec2, accepts: impl Fn(DVec3) -> bool) -> Option<DVec3> {
    let (mut best, mut least) = (start.extend(1.0), star.turned_area(start.extend(1.0)));
    let (count, sum) =
        star.corners().fold((0.0, DVec3::ZERO), |(count, sum), corner| (count + 1.0, sum + corner));
    let middle = sum / count;
    if star.turned_area(middle) < least && accepts(middle) {
        (best, least) = (middle, star.turned_area(middle));
        if star.energy(middle).is_finite() {
            return Some(middle);
        }
    }
    let first = star.corners().map(|corner| corner.distance(best)).fold(0.0, f64::max);
    let mut step = first;
    while step > LEAST_STEP {
        let worth = WORTH_A_STEP * step / first * least;
        let around = (0..8).map(|k| best + step * DVec2::from_angle(f64::from(k) * FRAC_PI_4).extend(0.0));
        let better = around.map(|point| (point, star.turned_area(point)));
        let better = better.filter(|&(point, area)| area < least - worth && accepts(point));
        match better.min_by(|a, b| a.1.total_cmp(&b.1)) {
            Some(better) => (best, least) = better,
            None => step *= 0.5,
        }
    }
    Some(best)
}
