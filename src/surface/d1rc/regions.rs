//! Where functions are not zero: faces by function, and functions by face.
//!
//! The faces under a hull are found from one to the next. Each piece of the hull inside the domain has the middle of the
//! hull, or a side of the border meets it; so the faces there are where to begin.

use super::configuration::Configuration;
use super::locate::Locator;
use super::turned::TurnedBoxes;
use crate::control::{Cancelled, Watch};
use crate::geometry::{Domain, Orientation, orientation};
use crate::lists::Lists;
use crate::memory::{self, CollectVec};
use glam::DVec2;

/// With more edges a function's faces are looked for by edge: its hull may have a knot of thousands of neighbours.
const MOST_EDGES: usize = 64;

/// Where functions are not zero.
#[derive(Debug, Clone)]
pub(crate) struct Regions {
    by_function: Lists,
    by_face: Lists,
}

impl Regions {
    /// By the hulls of the knots; where they are many, by those of the simplex splines.
    pub(crate) fn new(
        configurations: &[Configuration],
        places: &[DVec2],
        locator: &Locator,
        watch: &Watch,
    ) -> Result<Self, Cancelled> {
        let mut pairs = Vec::new();
        let mut search = Search::new(locator);
        let mut faces = Vec::new();
        for (function, configuration) in configurations.iter().enumerate() {
            watch.check_at(function)?;
            faces.clear();
            let knots =
                |knots: &mut dyn Iterator<Item = u32>| knots.map(|knot| places[knot as usize]).collect_vec();
            if configuration.edges.len() <= MOST_EDGES {
                search.faces_under(knots(&mut configuration.all_knots()), &mut faces);
            } else {
                for &edge in &configuration.edges {
                    search
                        .faces_under(knots(&mut configuration.knots.iter().copied().chain(edge)), &mut faces);
                }
            }
            faces.sort_unstable();
            faces.dedup();
            memory::extend(&mut pairs, faces.iter().map(|&face| (function as u32, face)));
        }
        Ok(Self::from_pairs(&pairs, configurations.len(), locator.faces().len()))
    }

    fn from_pairs(pairs: &[(u32, u32)], function_count: usize, face_count: usize) -> Self {
        let by_function = Lists::new(function_count, pairs.iter().copied());
        let by_face = Lists::new(face_count, pairs.iter().map(|&(function, face)| (face, function)));
        Self { by_function, by_face }
    }

    /// Leaves out the functions that no face sees.
    pub(crate) fn without_unseen(self, configurations: Vec<Configuration>) -> (Vec<Configuration>, Self) {
        let face_count = self.by_face.count();
        let mut pairs = memory::with_capacity(self.by_face.items().len());
        let mut kept = memory::with_capacity(configurations.len());
        for (function, configuration) in configurations.into_iter().enumerate() {
            let faces = self.faces(function as u32);
            if !faces.is_empty() {
                memory::extend(&mut pairs, faces.iter().map(|&face| (kept.len() as u32, face)));
                memory::push(&mut kept, configuration);
            }
        }
        let regions = Self::from_pairs(&pairs, kept.len(), face_count);
        (kept, regions)
    }

    /// The functions that may not be zero on a face, in increasing order.
    pub(crate) fn functions(&self, face: u32) -> &[u32] {
        self.by_face.of(face as usize)
    }

    /// The faces on which a function may not be zero, in increasing order.
    pub(crate) fn faces(&self, function: u32) -> &[u32] {
        self.by_function.of(function as usize)
    }
}

/// Looks for faces under hulls.
pub(super) struct Search<'a> {
    locator: &'a Locator,
    /// By face, those beyond its sides; [`NONE`] beyond the border.
    beside: Vec<[u32; 3]>,
    /// The sides of the border, by face.
    border: TurnedBoxes,
    /// By face: in which search it was seen last.
    seen: Vec<u32>,
    searches: u32,
    /// Faces still to be looked at.
    open: Vec<u32>,
}

const NONE: u32 = u32::MAX;

impl<'a> Search<'a> {
    pub(super) fn new(locator: &'a Locator) -> Self {
        let place = |knot: u32| locator.places()[knot as usize];
        let side = |&(face, [a, b]): &(u32, [u32; 2])| (face, [place(a), place(b), place(b)]);
        let border = TurnedBoxes::new(locator.border().iter().map(side).collect_vec(), locator.largest());
        let seen = memory::filled(0, locator.faces().len());
        Self { locator, beside: beside(locator.faces()), border, seen, searches: 0, open: Vec::new() }
    }

    /// Appends the faces whose inside meets the hull of some points.
    pub(super) fn faces_under(&mut self, points: Vec<DVec2>, out: &mut Vec<u32>) {
        let around = Domain::around(points.iter().copied());
        let hull = hull(points);
        if hull.len() < 3 || !overlap(&around, &self.locator.domain()) {
            return;
        }
        self.searches += 1;
        self.begin(&hull);
        while let Some(face) = self.open.pop() {
            if std::mem::replace(&mut self.seen[face as usize], self.searches) == self.searches {
                continue;
            }
            let corners = self.locator.corners(face);
            if overlap(&around, &Domain::around(corners))
                && !are_apart(&corners, &hull)
                && !are_apart(&hull, &corners)
            {
                memory::push(out, face);
                let beside = self.beside[face as usize].into_iter().filter(|&next| next != NONE);
                memory::extend(&mut self.open, beside);
            }
        }
    }

    /// Opens faces at the middle of a hull and on the border.
    fn begin(&mut self, hull: &[DVec2]) {
        let middle = hull.iter().sum::<DVec2>() / hull.len() as f64;
        if self.locator.domain().contains(middle) {
            memory::extend(&mut self.open, self.locator.candidates(middle).iter().copied());
        }
        self.border.near(hull, &mut self.open);
    }
}

/// By face, the faces beyond its sides.
fn beside(faces: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let sides = |(face, &[a, b, c]): (usize, &[u32; 3])| {
        [(a, b), (b, c), (c, a)].map(|(p, q)| (p.min(q), p.max(q), face as u32))
    };
    let mut all = faces.iter().enumerate().flat_map(sides).collect_vec();
    all.sort_unstable();
    let mut beside = memory::filled([NONE; 3], faces.len());
    let mut join = |face: u32, other: u32| {
        let free = beside[face as usize].iter_mut().find(|next| **next == NONE);
        free.into_iter().for_each(|next| *next = other);
    };
    for pair in all.windows(2).filter(|pair| (pair[0].0, pair[0].1) == (pair[1].0, pair[1].1)) {
        join(pair[0].2, pair[1].2);
        join(pair[1].2, pair[0].2);
    }
    beside
}

fn overlap(a: &Domain, b: &Domain) -> bool {
    a.min.cmplt(b.max).all() && b.min.cmplt(a.max).all()
}

/// Whether a side of a convex counter-clockwise polygon has all of another on its right or on itself.
fn are_apart(polygon: &[DVec2], other: &[DVec2]) -> bool {
    let sides = polygon.iter().zip(polygon.iter().cycle().skip(1));
    sides.into_iter().any(|(&a, &b)| other.iter().all(|&p| orientation(a, b, p) != Orientation::Positive))
}

/// The corners of the convex hull, counter-clockwise (A. M. Andrew, "Another efficient algorithm for convex hulls
/// in two dimensions", 1979).
fn hull(mut points: Vec<DVec2>) -> Vec<DVec2> {
    points.sort_unstable_by(|p, q| p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y)));
    points.dedup();
    let chain = |points: &mut dyn Iterator<Item = DVec2>| {
        let mut chain: Vec<DVec2> = Vec::new();
        for point in points {
            while let [.., a, b] = chain[..]
                && orientation(a, b, point) != Orientation::Positive
            {
                chain.pop();
            }
            memory::push(&mut chain, point);
        }
        chain.pop();
        chain
    };
    let mut lower = chain(&mut points.iter().copied());
    memory::extend(&mut lower, chain(&mut points.iter().rev().copied()));
    lower
}
