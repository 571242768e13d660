//! Triangles in pairs: the quads of the layout.
//!
//! The dual graph of a closed triangulation has three edges at each node and no bridge, so it has a perfect matching
//! (J. Petersen, "Die Theorie der regulaeren graphs", 1891): every triangle finds a partner. Of all matchings the one is
//! taken whose quads are best (J. Edmonds, "Paths, trees, and flowers", 1965; crate `mwmatching`):
//! ```text
//!       d --- c        weight = - sum of |angle - pi/2| over a, b, c, d - 2 fold angle at ac - price
//!      /   . /
//!     / .   /          The diagonal ac leaves the valences of a and c one smaller. Where a vertex would keep fewer
//!    a --- b           than three quads, the diagonals at it get a price, and the matching is done again.
//! ```
//! Of an open surface some triangles may be left over, and vertices of the border need one to three quads.

use crate::Control;
use crate::control::Cancelled;
use crate::samples::Random;
use glam::DVec3;
use mwmatching::{Matching, SENTINEL};
use std::collections::HashMap;
use std::f64::consts::FRAC_PI_2;

/// How long better pairings are looked for.
#[derive(Debug, Clone, Copy)]
pub(super) struct Effort {
    /// Sequences of prices.
    pub starts: u64,
    /// Matchings of each, until no vertex has too few quads.
    pub rounds: usize,
}

/// Raises of a price are this much times a half to one and a half, and grow with the rounds. Qualities differ by 1 to 10.
const RAISE: f64 = 1.5;
/// Rounds after which raises have doubled.
const RAISE_GROWTH: f64 = 10.0;
/// Weights are integers of this part of a radian; the crate needs them below 2^28.
const UNITS: f64 = 1e5;
/// No price beyond this: it outweighs all qualities, and the weight stays within the crate's limits.
const MOST_PRICE: f64 = 500.0;

/// Quads over triangles.
#[derive(Debug, Clone)]
pub(super) struct Pairing {
    /// The corners of each quad, counter-clockwise: a, b, c, d, its triangles are a, b, c and c, d, a.
    pub quads: Vec<[u32; 4]>,
    /// By triangle: its quad; none for one without a partner, which only an open surface may have.
    pub quad_of: Vec<Option<u32>>,
    /// Vertices that are left with fewer quads than they need.
    pub starved: Vec<u32>,
    /// What is to be small: bad corners, folds along diagonals, valences other than 4.
    ugliness: f64,
}

impl Pairing {
    /// Triangles without a partner.
    pub(super) fn single_count(&self) -> usize {
        self.quad_of.iter().filter(|quad| quad.is_none()).count()
    }

    fn rank(&self) -> (usize, f64) {
        (self.single_count() + self.starved.len(), self.ugliness)
    }
}

/// The edge between two triangles, which a quad of both would have as its diagonal.
struct Diagonal {
    triangles: [usize; 2],
    quad: [u32; 4],
    quality: f64,
    price: f64,
}

impl Diagonal {
    fn ends(&self) -> [u32; 2] {
        [self.quad[0], self.quad[2]]
    }

    fn weight(&self) -> i32 {
        (UNITS * (self.quality - self.price)) as i32
    }
}

/// Weight of the squared distance of a valence from 4, in radians: a vertex of 3 or 5 costs as much as corners that are
/// off by 30 degrees in all.
const VALENCE_WEIGHT: f64 = 0.5;

/// Pairs the triangles of a surface whose vertices have these places and need so many quads. None if not
/// one pair is to be had.
pub(super) fn paired(
    points: &[DVec3],
    triangles: &[[u32; 3]],
    needs: &[u32],
    effort: Effort,
    control: &mut Control,
) -> Result<Option<Pairing>, Cancelled> {
    let mut best: Option<Pairing> = None;
    for seed in 0..effort.starts {
        let Some(pairing) = priced(points, triangles, needs, effort.rounds, seed, control)? else {
            return Ok(None);
        };
        if best.as_ref().is_none_or(|best| pairing.rank() < best.rank()) {
            best = Some(pairing);
        }
    }
    Ok(best)
}

/// Raises prices until no vertex is starved.
fn priced(
    points: &[DVec3],
    triangles: &[[u32; 3]],
    needs: &[u32],
    rounds: usize,
    seed: u64,
    control: &mut Control,
) -> Result<Option<Pairing>, Cancelled> {
    let mut diagonals = diagonals(points, triangles);
    let mut valences = vec![0_u32; points.len()];
    triangles.iter().flatten().for_each(|&vertex| valences[vertex as usize] += 1);
    let mut random = Random::new(seed);
    let mut best: Option<Pairing> = None;
    for round in 0..rounds {
        control.report(1.0, f64::NAN)?;
        let Some(chosen) = matched(&diagonals, triangles.len()) else { return Ok(None) };
        let mut left = valences.clone();
        chosen.iter().flat_map(|&k| diagonals[k].ends()).for_each(|vertex| left[vertex as usize] -= 1);
        let is_starved = |vertex: u32| left[vertex as usize] < needs[vertex as usize];
        let starved: Vec<u32> = (0..points.len() as u32).filter(|&vertex| is_starved(vertex)).collect();
        let is_done = starved.is_empty();
        if best.as_ref().is_none_or(|best| starved.len() < best.starved.len()) {
            let off = left.iter().map(|&quads| (f64::from(quads) - 4.0).powi(2)).sum::<f64>();
            let quality: f64 = chosen.iter().map(|&k| diagonals[k].quality).sum();
            let ugliness = VALENCE_WEIGHT * off - quality;
            best = Some(pairing(&diagonals, &chosen, triangles.len(), starved, ugliness));
        }
        if is_done {
            break;
        }
        let raise = RAISE * (1.0 + round as f64 / RAISE_GROWTH);
        for k in chosen {
            if diagonals[k].ends().into_iter().any(is_starved) {
                diagonals[k].price = (diagonals[k].price + raise * (0.5 + random.unit())).min(MOST_PRICE);
            }
        }
    }
    Ok(best)
}

fn diagonals(points: &[DVec3], triangles: &[[u32; 3]]) -> Vec<Diagonal> {
    // the triangle at an edge, and its third corner
    let mut at_edge: HashMap<[u32; 2], (usize, u32)> = HashMap::new();
    let mut diagonals = Vec::new();
    for (t, triangle) in triangles.iter().enumerate() {
        for k in 0..3 {
            let [a, c, d] = [0, 1, 2].map(|j| triangle[(k + j) % 3]);
            if let Some(&(other, b)) = at_edge.get(&[c, a]) {
                let quad = [a, b, c, d];
                let quality = -ugliness(quad.map(|vertex| points[vertex as usize]));
                diagonals.push(Diagonal { triangles: [other, t], quad, quality, price: 0.0 });
            }
            at_edge.insert([a, c], (t, d));
        }
    }
    diagonals
}

/// How far a quad is from a plane square, in radians.
fn ugliness(quad: [DVec3; 4]) -> f64 {
    let angle_between = |a: DVec3, b: DVec3| a.cross(b).length().atan2(a.dot(b));
    let corners = (0..4).map(|k| {
        let [before, here, after] = [k + 3, k, k + 1].map(|j| quad[j % 4]);
        (angle_between(before - here, after - here) - FRAC_PI_2).abs()
    });
    let diagonal = quad[2] - quad[0];
    let [lower, upper] = [(quad[1] - quad[0]).cross(diagonal), diagonal.cross(quad[3] - quad[0])];
    corners.sum::<f64>() + 2.0 * angle_between(lower, upper)
}

/// The diagonals of the matching of greatest weight among those with most pairs; none if there is no diagonal.
fn matched(diagonals: &[Diagonal], triangle_count: usize) -> Option<Vec<usize>> {
    let edges = diagonals.iter().map(|diagonal| {
        let [i, j] = diagonal.triangles;
        (i, j, diagonal.weight())
    });
    let mut mates = Matching::new(edges.collect()).max_cardinality().solve();
    // the crate does not know of triangles behind the last that has a neighbour
    mates.resize(triangle_count, SENTINEL);
    let is_chosen = |diagonal: &Diagonal| mates[diagonal.triangles[0]] == diagonal.triangles[1];
    let chosen = || diagonals.iter().enumerate().filter(|(_, diagonal)| is_chosen(diagonal)).map(|(k, _)| k);
    (!diagonals.is_empty()).then(|| chosen().collect())
}

fn pairing(
    diagonals: &[Diagonal],
    chosen: &[usize],
    triangle_count: usize,
    starved: Vec<u32>,
    ugliness: f64,
) -> Pairing {
    let mut quad_of = vec![None; triangle_count];
    for (quad, &k) in (0..).zip(chosen) {
        diagonals[k].triangles.iter().for_each(|&triangle| quad_of[triangle] = Some(quad));
    }
    Pairing { quads: chosen.iter().map(|&k| diagonals[k].quad).collect(), quad_of, starved, ugliness }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_octahedron_becomes_a_cube_without_two_corners() {
        // eight triangles in four quads: all matchings leave valences of 2, and the square ones are taken
        let points = [DVec3::X, DVec3::Y, DVec3::NEG_X, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];
        let triangles =
            [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [1, 0, 5], [2, 1, 5], [3, 2, 5], [0, 3, 5]];
        let pairing =
            paired(&points, &triangles, &[3; 6], Effort { starts: 8, rounds: 120 }, &mut Control::new(1))
                .unwrap()
                .unwrap();
        assert_eq!(pairing.quads.len(), 4);
        assert!(!pairing.starved.is_empty());
        for (triangle, &quad) in triangles.iter().zip(&pairing.quad_of) {
            let corners = pairing.quads[quad.unwrap() as usize];
            assert!(triangle.iter().all(|vertex| corners.contains(vertex)));
        }
    }

    #[test]
    fn matchings_have_the_greatest_weight() {
        // against all matchings of random cubic graphs: prisms over polygons
        let mut random = Random::new(2);
        for n in 3..6 {
            for _ in 0..40 {
                let mut edges = Vec::new();
                for k in 0..n {
                    edges.extend([(k, (k + 1) % n), (n + k, n + (k + 1) % n), (k, n + k)]);
                }
                let weight = |random: &mut Random| -10.0 * random.unit();
                let diagonals: Vec<Diagonal> = edges
                    .iter()
                    .map(|&(i, j)| Diagonal {
                        triangles: [i, j],
                        quad: [0; 4],
                        quality: weight(&mut random),
                        price: 0.0,
                    })
                    .collect();
                let sum =
                    |chosen: &[usize]| chosen.iter().map(|&k| i64::from(diagonals[k].weight())).sum::<i64>();
                let found = matched(&diagonals, 2 * n).expect("a prism has edges");
                assert_eq!(
                    sum(&found),
                    greatest(&diagonals, &mut vec![false; 2 * n], &sum, &mut Vec::new()).unwrap()
                );
            }
        }
    }

    /// The greatest weight of all perfect matchings.
    fn greatest(
        diagonals: &[Diagonal],
        taken: &mut [bool],
        sum: &impl Fn(&[usize]) -> i64,
        chosen: &mut Vec<usize>,
    ) -> Option<i64> {
        let Some(free) = taken.iter().position(|taken| !taken) else { return Some(sum(chosen)) };
        let mut most = None;
        for (k, diagonal) in diagonals.iter().enumerate() {
            let [i, j] = diagonal.triangles;
            if (i == free || j == free) && !taken[i] && !taken[j] {
                (taken[i], taken[j]) = (true, true);
                chosen.push(k);
                most = most.max(greatest(diagonals, taken, sum, chosen));
                chosen.pop();
                (taken[i], taken[j]) = (false, false);
            }
        }
        most
    }
}
