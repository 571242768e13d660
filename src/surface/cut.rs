//! Trims cut off along a line of constant u or v.
//!
//! ```text
//!      .---.             Along the line the ends of the chains that are left alternate between entering and
//!   ---1---2---3---4--   leaving the region, whatever the direction of the loops: the first is joined to the
//!      |   '---'   |     second along the line, the third to the fourth.
//!      '-----------'
//! ```

use crate::memory::{self, CollectVec};
use glam::DVec2;

/// The half plane `normal . uv > offset`, its normal along an axis.
#[derive(Debug, Clone, Copy)]
pub(super) struct HalfPlane {
    pub normal: DVec2,
    pub offset: f64,
}

impl HalfPlane {
    fn height(&self, uv: DVec2) -> f64 {
        self.normal.dot(uv) - self.offset
    }

    /// Where a side of a loop leaves or enters.
    fn crossing(&self, inside: DVec2, outside: DVec2) -> DVec2 {
        let (a, b) = (self.height(inside), self.height(outside));
        let on_line = inside.lerp(outside, a / (a - b));
        // exact across the line, however the interpolation rounds
        on_line + self.normal * (self.offset - self.normal.dot(on_line))
    }

    fn along(&self, uv: DVec2) -> f64 {
        self.normal.perp_dot(uv)
    }
}

/// What is left of closed polylines in a half plane, the largest first. If nothing is left of a region, one loop
/// without area remains, so that it stays different from no loops at all.
pub(super) fn cut(loops: &[Vec<DVec2>], half: HalfPlane) -> Vec<Vec<DVec2>> {
    let mut whole = Vec::new();
    let mut chains = Vec::new();
    for polyline in loops {
        if polyline.iter().all(|&p| half.height(p) > 0.0) {
            memory::push(&mut whole, polyline.clone());
        } else {
            chains.extend(chains_inside(polyline, half));
        }
    }
    let mut left = whole;
    memory::extend(&mut left, join(&chains, half));
    left.iter_mut().for_each(|polyline| polyline.dedup());
    left.retain(|polyline| polyline.len() >= 3 && area(polyline) != 0.0);
    left.sort_by(|a, b| area(b).abs().total_cmp(&area(a).abs()));
    if left.is_empty() {
        let place = loops.iter().flatten().next().map(|&p| p - half.normal * half.height(p).min(0.0));
        memory::extend(&mut left, place.map(|place| vec![place; 3]));
    }
    left
}

/// The pieces of one loop inside, from one crossing to the next.
fn chains_inside(polyline: &[DVec2], half: HalfPlane) -> Vec<Vec<DVec2>> {
    let is_inside = |p: DVec2| half.height(p) > 0.0;
    let Some(start) = polyline.iter().position(|&p| !is_inside(p)) else {
        return Vec::new();
    };
    let mut chains: Vec<Vec<DVec2>> = Vec::new();
    let ring = (0..=polyline.len()).map(|k| polyline[(start + k) % polyline.len()]);
    let mut before = polyline[start];
    for p in ring.skip(1) {
        match (is_inside(before), is_inside(p)) {
            (false, true) => chains.push(vec![half.crossing(p, before), p]),
            (true, is_inside) => {
                let end = if is_inside { p } else { half.crossing(before, p) };
                chains.iter_mut().last().into_iter().for_each(|chain| chain.push(end));
            }
            (false, false) => {}
        }
        before = p;
    }
    chains
}

/// Closes the chains along the line.
fn join(chains: &[Vec<DVec2>], half: HalfPlane) -> Vec<Vec<DVec2>> {
    // end 2c is the first point of chain c, end 2c + 1 its last
    let place = |end: usize| {
        let chain = &chains[end / 2];
        half.along(if end.is_multiple_of(2) { chain[0] } else { chain[chain.len() - 1] })
    };
    let mut ends: Vec<usize> = (0..2 * chains.len()).collect_vec();
    ends.sort_by(|&a, &b| place(a).total_cmp(&place(b)));
    let mut partner = memory::filled(0, ends.len());
    for pair in ends.chunks_exact(2) {
        (partner[pair[0]], partner[pair[1]]) = (pair[1], pair[0]);
    }
    let mut is_used = memory::filled(false, chains.len());
    let mut loops = Vec::new();
    for first in 0..chains.len() {
        let mut polyline = Vec::new();
        let mut entry = 2 * first;
        while !is_used[entry / 2] {
            is_used[entry / 2] = true;
            let chain = chains[entry / 2].iter().copied();
            if entry % 2 == 0 {
                polyline.extend(chain)
            } else {
                polyline.extend(chain.rev())
            }
            entry = partner[entry ^ 1];
        }
        memory::push(&mut loops, polyline);
    }
    loops
}

/// Twice the signed area.
fn area(polyline: &[DVec2]) -> f64 {
    let next = polyline.iter().cycle().skip(1);
    polyline.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::Random;
    use crate::surface::{Domain, Trims};

    /// A star with wild spikes around the middle of the unit square.
    fn star(random: &mut Random, radius: f64, count: usize) -> Vec<DVec2> {
        (0..count)
            .map(|k| {
                let angle = std::f64::consts::TAU * k as f64 / count as f64;
                DVec2::splat(0.5) + radius * (0.3 + 0.7 * random.unit()) * DVec2::from_angle(angle)
            })
            .collect()
    }

    #[test]
    fn what_is_left_is_what_was_there() {
        let mut random = Random::new(2);
        let domain = Domain { min: DVec2::ZERO, max: DVec2::ONE };
        for _ in 0..200 {
            let mut loops = vec![star(&mut random, 0.5, 40), star(&mut random, 0.14, 15)];
            if random.unit() < 0.5 {
                loops[1].reverse();
            }
            let normal = [DVec2::X, DVec2::NEG_X, DVec2::Y, DVec2::NEG_Y][(4.0 * random.unit()) as usize];
            let half = HalfPlane { normal, offset: normal.dot(DVec2::splat(0.25 + 0.5 * random.unit())) };
            let before = Trims::new(loops.clone(), &domain).unwrap();
            let after = Trims::new(cut(&loops, half), &domain).unwrap();
            assert!(after.segments().all(|(a, _)| half.height(a) >= 0.0));
            for _ in 0..100 {
                let uv = DVec2::new(random.unit(), random.unit());
                let expected = before.contains(uv) && half.height(uv) > 0.0;
                assert_eq!(after.contains(uv), expected, "{uv} {half:?}");
            }
        }
    }

    #[test]
    fn nodes_on_the_line_and_empty_halves_do_no_harm() {
        let diamond =
            [(0.5, 0.0), (1.0, 0.5), (0.5, 1.0), (0.0, 0.5)].map(|(u, v)| DVec2::new(u, v)).to_vec();
        let right = cut(std::slice::from_ref(&diamond), HalfPlane { normal: DVec2::X, offset: 0.5 });
        assert_eq!(right, [[(0.5, 0.0), (1.0, 0.5), (0.5, 1.0)].map(|(u, v)| DVec2::new(u, v)).to_vec()]);
        let nothing = cut(&[diamond], HalfPlane { normal: DVec2::X, offset: 2.0 });
        assert_eq!(nothing.len(), 1);
        assert_eq!(area(&nothing[0]), 0.0);
        assert!(cut(&[], HalfPlane { normal: DVec2::X, offset: 2.0 }).is_empty());
    }
}
