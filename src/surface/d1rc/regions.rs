//! Where functions are not zero: faces by function, and functions by face.

use super::configuration::Configuration;
use super::locate::Locator;
use crate::control::{Cancelled, Watch};
use crate::geometry::{Domain, Orientation, orientation};
use crate::lists::Lists;
use crate::memory::{self, CollectVec};
use glam::DVec2;

/// Where functions are not zero.
#[derive(Debug, Clone)]
pub(crate) struct Regions {
    by_function: Lists,
    by_face: Lists,
}

impl Regions {
    /// By the hulls of the knots.
    pub(crate) fn new(
        configurations: &[Configuration],
        places: &[DVec2],
        locator: &Locator,
        watch: &Watch,
    ) -> Result<Self, Cancelled> {
        let mut pairs = Vec::new();
        for (function, configuration) in configurations.iter().enumerate() {
            watch.check_at(function)?;
            let knots = configuration.all_knots().map(|knot| places[knot as usize]).collect_vec();
            faces_under(knots, locator, &mut |face| memory::push(&mut pairs, (function as u32, face)));
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

/// Hands over the faces whose inside meets the hull of some points, in increasing order.
pub(super) fn faces_under(points: Vec<DVec2>, locator: &Locator, take: &mut impl FnMut(u32)) {
    let around = Domain::around(points.iter().copied());
    let hull = hull(points);
    if hull.len() < 3 || !overlap(&around, &locator.domain()) {
        return;
    }
    let mut near = Vec::new();
    locator.faces_near(&around, &mut near);
    for face in near {
        let corners = locator.corners(face);
        if overlap(&around, &Domain::around(corners))
            && !are_apart(&corners, &hull)
            && !are_apart(&hull, &corners)
        {
            take(face);
        }
    }
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
    points.sort_by(|p, q| p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y)));
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
