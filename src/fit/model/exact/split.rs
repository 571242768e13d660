//! Smooth regions of several carriers: the ends of a slot, the rounded edges of a block.
//!
//! ```text
//!  ( ======== )    Cylinders grow from edges whose facets turn, as far as nodes lie on them. What is left must be
//!                  planes. It counts only if all of the region is explained.
//!
//!   /\__/\         Planes that meet in blunt edges grow in the same way where noise hides the edges: each counts only if
//!                  with looser limits it would hardly grow.
//! ```

use super::evidence::{Evidence, Limits, gradient, signed_distance};
use super::recognize::{Recognized, recognize_region};
use crate::control::Watch;
use crate::memory::{self, CollectVec};
use crate::mesh::{HalfEdge, Mesh};
use crate::model::Carrier;
use glam::DVec3;
use std::collections::{BTreeMap, BTreeSet};

/// Facets of one plane turn by less: half a degree.
const FLAT: f64 = 0.009;
/// Filtered normals still turn by so much of the noise, by the size of a facet.
const NOISE_TURN: f64 = 0.3;
/// Facets look along their cylinder's normal up to this angle: half the turn of a coarse chord.
const LARGEST_TURN: f64 = 0.35;
/// Starts that come to nothing before no more are tried, those that come to nothing for each part that is found, and at most:
/// starts beside edges do, and no others should.
const FAILURES: [usize; 3] = [20, 10, 100];
/// Times that a cylinder is fitted anew while it grows.
const ROUNDS: usize = 12;
/// Rings of triangles around a start: enough to hold four lines of a wall.
const START_RINGS: usize = 3;
/// Steps through the edges, so that starts are spread over a region: a prime that no region's edges are a multiple of.
const STRIDE: usize = 7919;

/// Starts that may come to nothing where so many parts are found.
fn most_failures(parts: &[Part]) -> usize {
    let [first, for_each, most] = FAILURES;
    (first + for_each * parts.len()).min(most)
}

/// Triangles with the carrier that explains them.
#[derive(Debug, Clone)]
pub(crate) struct Part {
    pub triangles: Vec<u32>,
    pub found: Recognized,
}

/// How regions of a mesh are split. A cancelled call finds nothing.
#[derive(Clone, Copy)]
pub(crate) struct Splitting<'a> {
    pub mesh: &'a Mesh,
    /// Of all facets, without noise.
    pub normals: &'a [DVec3],
    pub limits: &'a Limits,
    pub watch: &'a Watch,
}

/// Angles that part blunt edges, the largest first, and whether only planes with nodes inside count: chords of a cylinder
/// turn by less than the third, and the strips between them have none.
const BLUNT: [(f64, bool); 5] = [(0.5, false), (0.35, false), (0.27, false), (0.05, true), (FLAT, true)];

/// Limits of the growth test are so many times looser.
const LOOSER: f64 = 3.0;
/// By what part of its area a plane may grow with looser limits: a strip of something round grows at once.
const MOST_GROWTH: f64 = 0.15;

impl Splitting<'_> {
    /// Planes and cylinders that explain all of a region, whose triangles are in increasing order; none if they do not.
    pub(crate) fn split(&self, triangles: &[u32]) -> Option<Vec<Part>> {
        let mut region = Region::new(*self, triangles);
        let mut parts = region.cylinders();
        if parts.is_empty() {
            return None;
        }
        for piece in region.pieces(None) {
            if let Some(found) = region.plane_of(&piece) {
                parts.push(region.take(piece, found));
            }
        }
        region.explain_the_rest(parts)
    }

    /// The parts of a region between edges that turn by less than sharp ones, if all of them are explained.
    pub(crate) fn split_at_blunt_edges(&self, triangles: &[u32]) -> Option<Vec<Part>> {
        // pieces that are not explained come back where smaller angles part nothing more
        let mut hopeless: Vec<u32> = Vec::new();
        BLUNT.into_iter().find_map(|(angle, needs_inner)| {
            let pieces = Region::new(*self, triangles).pieces(Some(angle));
            if pieces.len() < 2 || pieces.contains(&hopeless) {
                return None;
            }
            if needs_inner && !pieces.iter().all(|piece| has_inner_node(self.mesh, piece)) {
                return None;
            }
            let mut parts = Vec::new();
            for piece in pieces {
                match recognize_region(self.mesh, &piece, self.limits) {
                    Some(found) => parts.push(Part { triangles: piece, found }),
                    None => match self.split(&piece) {
                        Some(of_piece) => parts.extend(of_piece),
                        None => {
                            hopeless = piece;
                            return None;
                        }
                    },
                }
            }
            Some(parts)
        })
    }

    /// Planes that explain all of a region under noise, if they do.
    pub(crate) fn split_into_planes(&self, triangles: &[u32]) -> Option<Vec<Part>> {
        let parts = Region::new(*self, triangles).explain_the_rest(Vec::new())?;
        (parts.len() > 1).then_some(parts)
    }
}

/// Whether some node has no triangle outside of a piece, whose triangles are in increasing order.
fn has_inner_node(mesh: &Mesh, piece: &[u32]) -> bool {
    let is_inner = |&node: &u32| {
        !mesh.is_boundary(node)
            && mesh.outgoing(node).all(|edge| piece.binary_search(&(edge.triangle() as u32)).is_ok())
    };
    piece.iter().flat_map(|&triangle| &mesh.triangles()[triangle as usize]).any(is_inner)
}

/// The triangles that no part has taken yet. Sets of triangles are in increasing order.
struct Region<'a> {
    how: Splitting<'a>,
    triangles: &'a [u32],
    /// By triangle of the mesh.
    is_free: Vec<bool>,
}

impl<'a> Region<'a> {
    fn new(how: Splitting<'a>, triangles: &'a [u32]) -> Self {
        debug_assert!(triangles.is_sorted());
        let mut is_free = memory::filled(false, how.mesh.triangles().len());
        triangles.iter().for_each(|&triangle| is_free[triangle as usize] = true);
        Self { how, triangles, is_free }
    }

    fn is_cancelled(&self) -> bool {
        self.how.watch.check().is_err()
    }

    fn is_free(&self, triangle: u32) -> bool {
        self.is_free[triangle as usize]
    }

    fn free(&self) -> impl Iterator<Item = u32> + '_ {
        self.triangles.iter().copied().filter(|&triangle| self.is_free(triangle))
    }

    fn take(&mut self, triangles: Vec<u32>, found: Recognized) -> Part {
        triangles.iter().for_each(|&triangle| self.is_free[triangle as usize] = false);
        Part { triangles, found }
    }

    fn normal(&self, triangle: u32) -> DVec3 {
        self.how.normals[triangle as usize]
    }

    fn area(&self, triangle: u32) -> f64 {
        let [a, b, c] =
            self.how.mesh.triangles()[triangle as usize].map(|node| self.how.mesh.points()[node as usize]);
        0.5 * (b - a).cross(c - a).length()
    }

    /// The triangles beside one.
    fn sides(&self, triangle: u32) -> impl Iterator<Item = u32> + '_ {
        let across = move |corner| self.how.mesh.topology().twin(HalfEdge::new(triangle as usize, corner));
        (0..3).filter_map(across).map(|edge| edge.triangle() as u32)
    }

    /// The free ones of them.
    fn beside(&self, triangle: u32) -> impl Iterator<Item = u32> + '_ {
        self.sides(triangle).filter(|&other| self.is_free(other))
    }

    /// Some triangles with so many rings of free ones around them.
    fn rings(&self, start: &[u32], count: usize) -> Vec<u32> {
        let mut set: BTreeSet<u32> = memory::tree_of(start.iter().copied());
        for _ in 0..count {
            let ring: Vec<u32> = set.iter().flat_map(|&triangle| self.beside(triangle)).collect_vec();
            set.extend(ring);
        }
        set.into_iter().collect_vec()
    }

    /// Neighbours that turn, by more than noise of this size does, as pairs.
    fn turning_edges(&self, noise: f64) -> Vec<[u32; 2]> {
        let edge = (self.triangles.iter().map(|&triangle| self.area(triangle)).sum::<f64>()
            / self.triangles.len().max(1) as f64)
            .sqrt();
        let flat = FLAT + NOISE_TURN * noise / edge;
        let mut pairs = Vec::new();
        for &triangle in self.triangles {
            let turns = |&other: &u32| {
                let (m, n) = (self.normal(triangle), self.normal(other));
                other > triangle && m.cross(n).length().atan2(m.dot(n)) > flat
            };
            pairs.extend(self.beside(triangle).filter(turns).map(|other| [triangle, other]));
        }
        pairs
    }

    /// The cylinders that facets turn on.
    fn cylinders(&mut self) -> Vec<Part> {
        let mut parts = Vec::new();
        let edges = self.turning_edges(self.how.limits.noise);
        let mut failures = 0;
        for k in 0..edges.len() {
            let [a, b] = edges[k * STRIDE % edges.len()];
            if !(self.is_free(a) && self.is_free(b)) {
                continue;
            }
            match self.cylinder_from([a, b]) {
                Some((set, found)) => parts.push(self.take(set, found)),
                None if self.is_cancelled() || failures >= most_failures(&parts) => break,
                None => failures += 1,
            }
        }
        parts
    }

    /// Planes for what is left, and its slivers to the parts beside them; none if that is not all.
    fn explain_the_rest(mut self, mut parts: Vec<Part>) -> Option<Vec<Part>> {
        let mut failures = 0;
        for start in self.flattest_first() {
            if !self.is_free(start) {
                continue;
            }
            match self.plane_from(start) {
                Some((set, found)) => parts.push(self.take(set, found)),
                None if self.is_cancelled() || failures >= most_failures(&parts) => break,
                None => failures += 1,
            }
        }
        self.give_away(&mut parts);
        self.free().next().is_none().then(|| settled(self.how.mesh, parts))
    }

    /// A cylinder on both triangles and those around them, grown as far as it goes.
    fn cylinder_from(&self, start: [u32; 2]) -> Option<(Vec<u32>, Recognized)> {
        let mut set = self.rings(&start, START_RINGS);
        let mut found = self.fitted(&set)?;
        for _ in 0..ROUNDS {
            let grown = self.grown(start[0], &found.carrier);
            if grown == set || grown.binary_search(&start[1]).is_err() {
                break;
            }
            found = self.fitted(&grown)?;
            set = grown;
        }
        // noise bends every plane a little
        let is_plane = self.how.limits.noise > 0.0 && self.plane_of(&set).is_some();
        (!is_plane).then_some((set, found))
    }

    /// Free triangles, those first that turn least from the ones beside them.
    fn flattest_first(&self) -> Vec<u32> {
        let turn = |triangle: u32| {
            let own = self.normal(triangle);
            self.beside(triangle).map(|other| own.distance(self.normal(other))).fold(0.0, f64::max)
        };
        let mut turns: Vec<(f64, u32)> = self.free().map(|triangle| (turn(triangle), triangle)).collect_vec();
        turns.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        turns.into_iter().map(|(_, triangle)| triangle).collect_vec()
    }

    /// A plane on a triangle and those around it, grown as far as it goes; none if it hardly ends there.
    fn plane_from(&self, start: u32) -> Option<(Vec<u32>, Recognized)> {
        let mut found =
            (1..=START_RINGS).rev().find_map(|rings| self.plane_of(&self.rings(&[start], rings)))?;
        let mut set = Vec::new();
        for _ in 0..ROUNDS {
            let grown = self.grown(start, &found.carrier);
            if grown == set {
                break;
            }
            found = self.plane_of(&grown)?;
            set = grown;
        }
        let area = |set: &[u32]| set.iter().map(|&triangle| self.area(triangle)).sum::<f64>();
        let looser = self.grown_within(start, &found.carrier, LOOSER * self.how.limits.max);
        let is_whole = area(&looser) <= (1.0 + MOST_GROWTH) * area(&set);
        is_whole.then_some((set, found))
    }

    fn plane_of(&self, set: &[u32]) -> Option<Recognized> {
        let evidence = Evidence::new(self.how.mesh, set)?;
        let carrier = Carrier::Plane(evidence.plane()?);
        evidence.accepts(&carrier, self.how.limits).then_some(Recognized { carrier, evidence })
    }

    /// What is left along the edges of parts goes to the part beside it on which it lies best.
    fn give_away(&mut self, parts: &mut [Part]) {
        let mut part_of: BTreeMap<u32, usize> = BTreeMap::new();
        for (number, part) in parts.iter().enumerate() {
            part_of.extend(part.triangles.iter().map(|&triangle| (triangle, number)));
        }
        let mut ring: Vec<u32> = self.free().collect_vec();
        while !ring.is_empty() {
            let nearest = |&triangle: &u32| {
                let beside = self.sides(triangle).filter_map(|other| part_of.get(&other).copied());
                let off = |part: usize| off(self.how.mesh, triangle, &parts[part].found.carrier);
                let best = beside.min_by(|&a, &b| off(a).total_cmp(&off(b)))?;
                (off(best) <= self.how.limits.max).then_some((triangle, best))
            };
            let given: Vec<(u32, usize)> = ring.iter().filter_map(nearest).collect_vec();
            for &(triangle, part) in &given {
                self.is_free[triangle as usize] = false;
                parts[part].triangles.push(triangle);
                part_of.insert(triangle, part);
            }
            // only these have a part beside them that they had not before
            let next = given.iter().flat_map(|&(triangle, _)| self.beside(triangle)).collect_vec();
            ring = memory::tree_of::<BTreeSet<u32>, _>(next).into_iter().collect_vec();
        }
        parts.iter_mut().for_each(|part| part.triangles.sort_unstable());
    }

    fn fitted(&self, set: &[u32]) -> Option<Recognized> {
        let evidence = Evidence::new(self.how.mesh, set)?;
        let cylinder =
            evidence.cylinder().filter(|cylinder| evidence.tells_roundness(cylinder, self.how.limits))?;
        let carrier = Carrier::Cylinder(cylinder);
        evidence.accepts(&carrier, self.how.limits).then_some(Recognized { carrier, evidence })
    }

    /// The free triangles around a start that lie on a carrier.
    fn grown(&self, start: u32, carrier: &Carrier) -> Vec<u32> {
        self.grown_within(start, carrier, self.how.limits.max)
    }

    /// The same within a distance.
    fn grown_within(&self, start: u32, carrier: &Carrier, distance: f64) -> Vec<u32> {
        let place = |node: u32| self.how.mesh.points()[node as usize];
        let fits = |triangle: u32| {
            let nodes = self.how.mesh.triangles()[triangle as usize];
            let middle = nodes.iter().map(|&node| place(node)).sum::<DVec3>() / 3.0;
            let along = self.normal(triangle).dot(gradient(carrier, middle)).abs();
            along >= LARGEST_TURN.cos()
                && nodes.iter().all(|&node| signed_distance(carrier, place(node)).abs() <= distance)
        };
        let mut is_in = memory::filled(false, self.how.mesh.triangles().len());
        is_in[start as usize] = true;
        let mut set = vec![start];
        let mut done = 0;
        while done < set.len() {
            for other in self.beside(set[done]) {
                if !is_in[other as usize] && fits(other) {
                    is_in[other as usize] = true;
                    memory::push(&mut set, other);
                }
            }
            done += 1;
        }
        set.sort_unstable();
        set
    }

    /// Free triangles that hang together, by edges that do not turn by more than an angle if there is one.
    fn pieces(&self, most: Option<f64>) -> Vec<Vec<u32>> {
        let is_joined = |a: u32, b: u32| {
            most.is_none_or(|most| {
                let (m, n) = (self.normal(a), self.normal(b));
                m.cross(n).length().atan2(m.dot(n)) <= most
            })
        };
        let mut is_left = self.is_free.iter().copied().collect_vec();
        let mut pieces = Vec::new();
        for &start in self.triangles {
            if !std::mem::take(&mut is_left[start as usize]) {
                continue;
            }
            let mut piece = vec![start];
            let mut done = 0;
            while done < piece.len() {
                for other in self.beside(piece[done]) {
                    if is_joined(piece[done], other) && std::mem::take(&mut is_left[other as usize]) {
                        memory::push(&mut piece, other);
                    }
                }
                done += 1;
            }
            piece.sort_unstable();
            memory::push(&mut pieces, piece);
        }
        pieces
    }
}

/// Parts whose triangles lie nearer to them than to the parts beside: a cylinder grows on to its tangent plane as far as
/// the limits let it.
fn settled(mesh: &Mesh, mut parts: Vec<Part>) -> Vec<Part> {
    let mut part_of = BTreeMap::new();
    for (number, part) in parts.iter().enumerate() {
        part_of.extend(part.triangles.iter().map(|&triangle| (triangle, number)));
    }
    let off = |triangle: u32, part: usize| off(mesh, triangle, &parts[part].found.carrier);
    let mut stack: Vec<u32> = part_of.keys().copied().collect_vec();
    let mut moves = 4 * stack.len();
    while let Some(triangle) = stack.pop() {
        let own = part_of[&triangle];
        let sides =
            (0..3).filter_map(|corner| mesh.topology().twin(HalfEdge::new(triangle as usize, corner)));
        let beside: Vec<u32> = sides.map(|edge| edge.triangle() as u32).collect_vec();
        let others =
            beside.iter().filter_map(|other| part_of.get(other)).copied().filter(|&part| part != own);
        let best = others.min_by(|&a, &b| off(triangle, a).total_cmp(&off(triangle, b)));
        // half as far: of two that are equal to rounding a triangle stays where it is
        if let Some(better) = best.filter(|&part| 2.0 * off(triangle, part) < off(triangle, own))
            && moves > 0
        {
            moves -= 1;
            part_of.insert(triangle, better);
            stack.extend(beside.into_iter().filter(|other| part_of.contains_key(other)));
        }
    }
    parts.iter_mut().for_each(|part| part.triangles.clear());
    for (triangle, part) in part_of {
        parts[part].triangles.push(triangle);
    }
    for part in &mut parts {
        if let Some(evidence) = Evidence::new(mesh, &part.triangles) {
            let better: Option<Carrier> = match part.found.carrier {
                Carrier::Plane(_) => evidence.plane().map(Carrier::Plane),
                _ => evidence.cylinder().map(Carrier::Cylinder),
            };
            if let Some(carrier) = better {
                part.found = Recognized { carrier, evidence };
            }
        }
    }
    parts.retain(|part| !part.triangles.is_empty());
    parts
}

/// How far the nodes of a triangle are from a carrier.
fn off(mesh: &Mesh, triangle: u32, carrier: &Carrier) -> f64 {
    let distance = |node: u32| signed_distance(carrier, mesh.points()[node as usize]).abs();
    mesh.triangles()[triangle as usize].into_iter().map(distance).fold(0.0, f64::max)
}
