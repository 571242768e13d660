//! The best quads over a polygon whose border is given.
//!
//! All ways to fill a small polygon with quadrilaterals are tried, edge by edge, as an advancing front, and the best is
//! kept (branch and bound, A. Land, A. Doig 1960).
//! ```text
//!      d ----- c       On the front's first edge a, b stands a quad a, b, c, d. Each of c and d is new or a vertex of the
//!     /        |       front; those leave up to three smaller fronts, which have an even number of edges like every
//!   -a ------- b-      border of quads.
//! ```
//! In a polygon that is a surface cut open, several vertices of the border are copies of one: they count together.
//!
//! Cost: what corners lack of a right angle, squared, if the angle at a vertex is shared equally: (a - k)^2 / k for an
//! angle of a quarter turns and k quads; and a share for each quad.

use std::collections::BTreeSet;

/// A polygon to fill.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Polygon {
    /// By vertex, counterclockwise: a number that no two corners of a quad may have in common.
    pub vertices: Vec<u32>,
    /// By vertex: the group of copies it belongs to.
    pub groups: Vec<u32>,
    /// By group.
    pub corners: Vec<Corner>,
}

/// What holds of all copies of a vertex of the border together.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Corner {
    /// The angle of the surface, in quarter turns.
    pub angle: f64,
    /// Quads that must meet there.
    pub need: u32,
}

/// Quads over a polygon.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Filling {
    /// Vertices of the polygon by their rank, those inside after them, counterclockwise.
    pub quads: Vec<[u32; 4]>,
    pub cost: f64,
}

/// Share of a quad in the cost: three more quads are worth an irregular vertex.
const QUAD_COST: f64 = 0.1;
/// Quads around a vertex inside.
const LEAST_VALENCE: u32 = 3;
const MOST_VALENCE: u32 = 6;
/// Vertices inside beyond the fewest: five quads in a circle have four.
const MOST_INNER: usize = 6;
/// Quads beyond the fewest.
const MOST_MORE_QUADS: usize = 4;

impl Polygon {
    /// The best filling after so many quads were tried at most; none if there is none, or none was found.
    pub(super) fn filled(&self, most_steps: usize) -> Option<Filling> {
        let count = self.groups.len();
        if count < 4 || count % 2 == 1 {
            return None;
        }
        let mut search = Search::new(self, most_steps);
        search.fill(vec![(0..count as u32).collect()]);
        search.best
    }
}

struct Search<'a> {
    polygon: &'a Polygon,
    quads: Vec<[u32; 4]>,
    /// Quads by vertex.
    valences: Vec<u32>,
    /// Open fronts by vertex.
    fronts: Vec<u32>,
    /// Copies by group that still lie on a front.
    open_copies: Vec<u32>,
    group_valences: Vec<u32>,
    edges: BTreeSet<[u32; 2]>,
    cost: f64,
    /// Quads that may still be tried.
    steps: usize,
    best: Option<Filling>,
}

impl<'a> Search<'a> {
    fn new(polygon: &'a Polygon, steps: usize) -> Self {
        let count = polygon.groups.len();
        let mut open_copies = vec![0; polygon.corners.len()];
        polygon.groups.iter().for_each(|&group| open_copies[group as usize] += 1);
        Self {
            polygon,
            quads: Vec::new(),
            valences: vec![0; count],
            fronts: vec![1; count],
            open_copies,
            group_valences: vec![0; polygon.corners.len()],
            edges: (0..count as u32).map(|v| key(v, (v + 1) % count as u32)).collect(),
            cost: 0.0,
            steps,
            best: None,
        }
    }

    fn border_count(&self) -> usize {
        self.polygon.groups.len()
    }

    /// Fills the last of these fronts in all ways, and the others after it.
    fn fill(&mut self, mut fronts: Vec<Vec<u32>>) {
        let Some(front) = fronts.pop() else {
            let best = self.best.as_ref().map_or(f64::INFINITY, |best| best.cost);
            if self.cost < best {
                self.best = Some(Filling { quads: self.quads.clone(), cost: self.cost });
            }
            return;
        };
        let m = front.len();
        let (a, b) = (front[0], front[1]);
        let has_room = self.valences.len() < self.border_count() + MOST_INNER;
        // both corners on the front, from small fronts left to large ones
        for i in (2..m - 1).step_by(2) {
            for j in (i + 1..m).step_by(2) {
                let [c, d] = [front[i], front[j]];
                let left = [&front[1..=i], &front[i..=j], &front[j..]];
                let mut left: Vec<Vec<u32>> = left.into_iter().map(<[u32]>::to_vec).collect();
                left[2].push(a);
                self.stand([a, b, c, d], &fronts, left.into_iter().filter(|path| path.len() > 2).collect());
            }
        }
        if has_room {
            let new = self.valences.len() as u32;
            for i in (2..m - 1).step_by(2) {
                let below = front[1..=i].to_vec();
                let mut above = front[i..].to_vec();
                above.extend([a, new]);
                let left = [below, above].into_iter().filter(|path| path.len() > 2).collect();
                self.stand([a, b, front[i], new], &fronts, left);
            }
            for j in (3..m).step_by(2) {
                let mut above = vec![new];
                above.extend(&front[1..=j]);
                let mut below = front[j..].to_vec();
                below.push(a);
                let left = [above, below].into_iter().filter(|path| path.len() > 2).collect();
                self.stand([a, b, new, front[j]], &fronts, left);
            }
        }
        if self.valences.len() + 1 < self.border_count() + MOST_INNER {
            let new = self.valences.len() as u32;
            let mut around = vec![new + 1, new];
            around.extend(&front[1..]);
            around.push(a);
            self.stand([a, b, new, new + 1], &fronts, vec![around]);
        }
    }

    /// Puts a quad on a front of which `left` stay, each a path whose last vertex is joined to its first, goes on, and
    /// takes the quad away again.
    fn stand(&mut self, quad: [u32; 4], fronts: &[Vec<u32>], left: Vec<Vec<u32>>) {
        if self.steps == 0 || self.has_copies(quad) {
            return;
        }
        self.steps -= 1;
        let saved = (self.valences.clone(), self.fronts.clone(), self.open_copies.clone());
        let (group_valences, cost) = (self.group_valences.clone(), self.cost);
        let new_count = quad.iter().map(|&v| v as usize + 1).max().unwrap_or(0).max(self.valences.len());
        self.valences.resize(new_count, 0);
        self.fronts.resize(new_count, 0);
        let sides = [0, 1, 2, 3].map(|k| key(quad[k], quad[(k + 1) % 4]));
        // sides between fronts are new; no other edge may have the same ends
        let is_new = |side: &[u32; 2]| {
            left.iter().any(|path| key(path[0], path[path.len() - 1]) == *side) || {
                side[1] as usize >= saved.0.len()
            }
        };
        let added: Vec<[u32; 2]> = sides.iter().filter(|side| is_new(side)).copied().collect();
        if added.iter().all(|side| !self.edges.contains(side)) {
            self.edges.extend(&added);
            self.quads.push(quad);
            self.cost += QUAD_COST;
            for &vertex in &quad {
                self.valences[vertex as usize] += 1;
            }
            left.iter().flatten().for_each(|&vertex| self.fronts[vertex as usize] += 1);
            // the front that was: all old vertices of the front leave it
            let mut of_front: Vec<u32> = left.iter().flatten().copied().chain(quad).collect();
            of_front.retain(|&vertex| (vertex as usize) < saved.0.len());
            of_front.sort_unstable();
            of_front.dedup();
            of_front.iter().for_each(|&vertex| self.fronts[vertex as usize] -= 1);
            if of_front.iter().all(|&vertex| self.fronts[vertex as usize] > 0 || self.close(vertex))
                && self.bound(fronts, &left) < self.best.as_ref().map_or(f64::INFINITY, |best| best.cost)
            {
                let next = fronts.iter().cloned().chain(left).collect();
                self.fill(next);
            }
            self.quads.pop();
            added.iter().for_each(|side| {
                self.edges.remove(side);
            });
        }
        (self.valences, self.fronts, self.open_copies) = saved;
        (self.group_valences, self.cost) = (group_valences, cost);
    }

    /// Whether two corners of a quad are copies of one vertex.
    fn has_copies(&self, quad: [u32; 4]) -> bool {
        let vertex = |k: usize| self.polygon.vertices.get(quad[k] as usize);
        (0..4).any(|k| vertex(k).is_some() && (0..k).any(|j| vertex(j) == vertex(k)))
    }

    /// Adds the cost of a vertex that lies on no front any more; false if it may not be so.
    fn close(&mut self, vertex: u32) -> bool {
        let valence = self.valences[vertex as usize];
        let Some(&group) = self.polygon.groups.get(vertex as usize) else {
            self.cost += corner_cost(4.0, valence);
            return (LEAST_VALENCE..=MOST_VALENCE).contains(&valence);
        };
        let group = group as usize;
        self.group_valences[group] += valence;
        self.open_copies[group] -= 1;
        let Corner { angle, need } = self.polygon.corners[group];
        if self.open_copies[group] > 0 {
            return true;
        }
        self.cost += corner_cost(angle, self.group_valences[group]);
        self.group_valences[group] >= need
    }

    /// Least cost of any filling that goes on from here: of the fewest quads, and of the corners that stay on fronts, each of
    /// which gets one quad more at least.
    fn bound(&self, fronts: &[Vec<u32>], left: &[Vec<u32>]) -> f64 {
        let quads: usize = fronts.iter().chain(left).map(|front| front.len() / 2 - 1).sum();
        if self.quads.len() + quads > self.border_count() / 2 - 1 + MOST_MORE_QUADS {
            return f64::INFINITY;
        }
        let mut of_groups = self.group_valences.clone();
        let mut inside = 0.0;
        for (vertex, &fronts) in self.fronts.iter().enumerate().filter(|(_, fronts)| **fronts > 0) {
            let least = self.valences[vertex] + fronts;
            match self.polygon.groups.get(vertex) {
                Some(&group) => of_groups[group as usize] += least,
                None if least > MOST_VALENCE => return f64::INFINITY,
                None => inside += least_corner_cost(4.0, least.max(LEAST_VALENCE)),
            }
        }
        let corners = self.polygon.corners.iter().zip(&of_groups).zip(&self.open_copies);
        let border: f64 = corners
            .filter(|(_, copies)| **copies > 0)
            .map(|((corner, &least), _)| least_corner_cost(corner.angle, least.max(corner.need)))
            .sum();
        self.cost + QUAD_COST * quads as f64 + inside + border
    }
}

fn key(a: u32, b: u32) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

fn corner_cost(angle: f64, valence: u32) -> f64 {
    let valence = f64::from(valence);
    (angle - valence).powi(2) / valence
}

/// The least of the costs with so many quads or more: they fall up to the angle, and grow beyond it.
fn least_corner_cost(angle: f64, valence: u32) -> f64 {
    let best = valence.max(angle as u32);
    corner_cost(angle, best).min(corner_cost(angle, best + 1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::Random;

    /// Far more than these polygons need.
    const STEPS: usize = 1_000_000;

    fn polygon(angles: &[f64]) -> Polygon {
        let corner = |&angle: &f64| Corner { angle, need: if angle < 1.7 { 1 } else { 2 } };
        Polygon {
            vertices: (0..angles.len() as u32).collect(),
            groups: (0..angles.len() as u32).collect(),
            corners: angles.iter().map(corner).collect(),
        }
    }

    /// What holds of every filling: Euler's formula, each side of the border once, each edge inside twice, both ways.
    #[track_caller]
    fn check(polygon: &Polygon, filling: &Filling) {
        let count = polygon.groups.len();
        let mut sides = std::collections::BTreeMap::new();
        for quad in &filling.quads {
            for k in 0..4 {
                assert_eq!(sides.insert([quad[k], quad[(k + 1) % 4]], ()), None, "{filling:?}");
            }
        }
        for v in 0..count as u32 {
            let next = (v + 1) % count as u32;
            assert!(sides.contains_key(&[v, next]) && !sides.contains_key(&[next, v]), "{filling:?}");
        }
        let inner = sides.keys().filter(|[a, b]| sides.contains_key(&[*b, *a])).count();
        assert_eq!(inner + count, sides.len());
        let vertices = filling.quads.iter().flatten().max().unwrap() + 1;
        assert_eq!(vertices as usize + filling.quads.len() - inner / 2 - count, 1);
    }

    #[test]
    fn corners_decide_the_quads() {
        let (right, straight) = (1.0, 2.0);
        for (angles, quads) in [
            (vec![right; 4], 1),
            // a triangle whose sides are halved: three quads around a vertex; a pentagon: five
            ([[right, straight]; 3].concat(), 3),
            ([[right, straight]; 5].concat(), 5),
            // a circle: a square in its middle
            (vec![straight; 4], 5),
            // a strip, and an L
            (vec![right, straight, straight, right, right, straight, straight, right], 3),
            (vec![right, straight, right, right, 3.0, right, right, straight], 3),
        ] {
            let polygon = polygon(&angles);
            let filling = polygon.filled(STEPS).unwrap();
            check(&polygon, &filling);
            assert_eq!(filling.quads.len(), quads, "{angles:?} {filling:?}");
        }
    }

    #[test]
    fn six_right_angles_are_two_quads_over_the_widest() {
        let polygon = polygon(&[1.0, 1.0, 1.6, 1.0, 1.0, 1.6]);
        let filling = polygon.filled(STEPS).unwrap();
        check(&polygon, &filling);
        assert_eq!(filling.quads.len(), 2);
        assert!(filling.quads.iter().all(|quad| quad.contains(&2) && quad.contains(&5)), "{filling:?}");
    }

    #[test]
    fn no_filling_costs_less_than_is_said_before() {
        let mut random = Random::new(5);
        for count in [4, 6, 8, 10] {
            for _ in 0..20 {
                let angles: Vec<f64> = (0..count).map(|_| 1.0 + 1.2 * random.unit()).collect();
                let polygon = polygon(&angles);
                let search = Search::new(&polygon, STEPS);
                let least = search.bound(&[], &[(0..count).collect()]);
                let Some(filling) = polygon.filled(STEPS) else { continue };
                check(&polygon, &filling);
                // sums of about twenty costs of about one
                assert!(least <= filling.cost + 64.0 * f64::EPSILON, "{angles:?}: {least}, {filling:?}");
            }
        }
        // right angles all around and one quad are all there is to it
        let square = polygon(&[1.0; 4]);
        assert_eq!(Search::new(&square, STEPS).bound(&[], &[vec![0, 1, 2, 3]]), QUAD_COST);
    }

    #[test]
    fn an_odd_border_and_a_short_one_have_none() {
        assert_eq!(polygon(&[1.0; 5]).filled(STEPS), None);
        assert_eq!(polygon(&[1.0; 2]).filled(STEPS), None);
    }

    #[test]
    fn a_ring_cut_open_is_a_strip() {
        // the outer border 0 1 2 3 0', the inner one 3' 2' 1' 0'' and its copy; the cut joins the zeros
        let groups = vec![0, 1, 2, 3, 0, 4, 7, 6, 5, 4];
        let polygon =
            Polygon { vertices: groups.clone(), groups, corners: vec![Corner { angle: 2.0, need: 2 }; 8] };
        let filling = polygon.filled(STEPS).unwrap();
        check(&polygon, &filling);
        assert_eq!(filling.quads.len(), 4);
        assert!((filling.cost - 4.0 * QUAD_COST).abs() < 1e-12, "{filling:?}");
    }
}
