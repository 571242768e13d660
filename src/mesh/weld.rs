//! Which nodes are one.
//!
//! Nodes are taken in their order; each joins the nearest node kept so far within the distance, or else is
//! kept itself. So no node moves further than the distance, kept nodes are further apart than it, and a long
//! chain of near nodes does not shrink to a point. Kept nodes lie in a hash grid whose cells hold only so
//! many of them: linear time.

use crate::memory;
use glam::DVec3;

/// Cells are this many distances wide. Wider cells hold more nodes, narrower ones make a ball touch more.
const CELL_WIDTH: f64 = 4.0;

/// For each point the first of the points it is welded to (itself if it is kept). Distance 0 welds points
/// whose coordinates are equal. Points that are not finite stay alone.
pub(super) fn weld(points: &[DVec3], distance: f64) -> Vec<u32> {
    let equal = weld_equal(points);
    if distance == 0.0 { equal } else { weld_near(points, &equal, distance) }
}

fn weld_equal(points: &[DVec3]) -> Vec<u32> {
    let mut table = Table::new(points.len());
    let mut firsts = memory::with_capacity(points.len());
    for (i, &point) in points.iter().enumerate() {
        if !point.is_finite() {
            memory::push(&mut firsts, i as u32);
            continue;
        }
        let hash = hash(point.to_array().map(|x| (x + 0.0).to_bits())); // -0 + 0 = 0
        let first = table.chain(hash).find(|&j| points[j as usize] == point);
        memory::push(&mut firsts, first.unwrap_or(i as u32));
        if first.is_none() {
            table.insert(hash, i as u32);
        }
    }
    firsts
}

/// `equal`: what [`weld_equal`] returned; equal points stay together.
fn weld_near(points: &[DVec3], equal: &[u32], distance: f64) -> Vec<u32> {
    let finite = || points.iter().copied().filter(|point| point.is_finite());
    let low = finite().fold(DVec3::INFINITY, DVec3::min);
    let high = finite().fold(DVec3::NEG_INFINITY, DVec3::max);
    // cells so small that neighbours have the same floating-point number would lose nodes
    let width = (CELL_WIDTH * distance).max((high - low).max_element() * 2f64.powi(-50));
    let cell_of = |point: DVec3| ((point - low) / width).floor().to_array();
    let distance_sq = |i: u32, point: DVec3| points[i as usize].distance_squared(point);

    let mut table = Table::new(points.len());
    let mut firsts: Vec<u32> = memory::with_capacity(points.len());
    for (i, &point) in points.iter().enumerate() {
        if (equal[i] as usize) < i {
            firsts.push(firsts[equal[i] as usize]);
            continue;
        }
        if !point.is_finite() {
            memory::push(&mut firsts, i as u32);
            continue;
        }
        let [from, to] = [cell_of(point - distance), cell_of(point + distance)];
        let mut nearest: Option<(f64, u32)> = None;
        for x in steps(from[0], to[0]) {
            for y in steps(from[1], to[1]) {
                for z in steps(from[2], to[2]) {
                    for j in table.chain(hash([x, y, z].map(f64::to_bits))) {
                        let candidate = (distance_sq(j, point), j);
                        if candidate.0 <= distance * distance && nearest.is_none_or(|best| candidate < best) {
                            nearest = Some(candidate);
                        }
                    }
                }
            }
        }
        memory::push(&mut firsts, nearest.map_or(i as u32, |(_, j)| j));
        if nearest.is_none() {
            table.insert(hash(cell_of(point).map(|x| (x + 0.0).to_bits())), i as u32);
        }
    }
    firsts
}

/// from, from + 1, ... to: two or three cells, since a cell is wider than the ball.
fn steps(from: f64, to: f64) -> impl Iterator<Item = f64> {
    std::iter::successors(Some(from + 0.0), |x| Some(x + 1.0)).take(3).take_while(move |&x| x <= to)
}

fn hash(bits: [u64; 3]) -> u64 {
    bits.iter().fold(0x9e37_79b9_7f4a_7c15, |hash: u64, &word| {
        let mixed = (hash ^ word).wrapping_mul(0xff51_afd7_ed55_8ccd);
        mixed ^ mixed >> 32
    })
}

/// Indices of points by hash, chained in arrays.
struct Table {
    heads: Vec<u32>,
    nexts: Vec<u32>,
}

impl Table {
    const END: u32 = u32::MAX;

    fn new(point_count: usize) -> Self {
        Self {
            heads: memory::filled(Self::END, point_count.next_power_of_two()),
            nexts: memory::filled(Self::END, point_count),
        }
    }

    fn slot(&self, hash: u64) -> usize {
        hash as usize & (self.heads.len() - 1)
    }

    fn chain(&self, hash: u64) -> impl Iterator<Item = u32> + '_ {
        let link = |index: u32| (index != Self::END).then_some(index);
        std::iter::successors(link(self.heads[self.slot(hash)]), move |&i| link(self.nexts[i as usize]))
    }

    fn insert(&mut self, hash: u64, index: u32) {
        let slot = self.slot(hash);
        self.nexts[index as usize] = self.heads[slot];
        self.heads[slot] = index;
    }
}
