//! Which face of the parameter mesh holds a point, and from which side limits are taken there.

use super::simplex::Site;
use super::turned::TurnedBoxes;
use crate::geometry::{Domain, Orientation, orientation, signed_area};
use crate::lists::Lists;
use crate::memory::{self, CollectVec};
use glam::DVec2;
use std::borrow::Cow;

/// Cells of the grid for each face: a cell then meets some four faces.
const CELLS_PER_FACE: f64 = 2.0;
/// A face whose box has more cells is long, or large among small ones, and no matter of the grid: a fan of n thin faces would
/// take some n^2 entries.
const MOST_CELLS: usize = 64;
/// Shares of a face's corners in the place towards which limits are taken on the border of the mesh. Nothing that
/// engineers draw is parallel to the way there.
const ASKEW: [f64; 3] = [0.302_775_637_7, 0.358_898_943_5, 0.338_325_418_8];
/// Against the largest coordinate: a point on a border, computed from its ends, is not farther outside.
const SLACK: f64 = 16.0 * f64::EPSILON;

/// Faces sorted into a uniform grid, long ones into a tree.
#[derive(Debug, Clone)]
pub(crate) struct Locator {
    places: Vec<DVec2>,
    faces: Vec<[u32; 3]>,
    domain: Domain,
    counts: [usize; 2],
    cells_per_unit: DVec2,
    /// The faces of each cell, in increasing order.
    by_cell: Lists,
    /// The other faces.
    long: TurnedBoxes,
    border: Vec<(u32, [u32; 2])>,
}

impl Locator {
    /// For faces of positive area.
    pub(crate) fn new(places: Vec<DVec2>, faces: Vec<[u32; 3]>) -> Self {
        let used = faces.iter().flatten().map(|&knot| places[knot as usize]);
        let domain = Domain::around(used);
        let size = domain.size().max(DVec2::splat(f64::MIN_POSITIVE));
        let cell = (size.x * size.y / (CELLS_PER_FACE * faces.len() as f64)).sqrt();
        let most = CELLS_PER_FACE * faces.len() as f64;
        let counts = [size.x, size.y].map(|length| (length / cell).ceil().clamp(1.0, most) as usize);
        let cells_per_unit = DVec2::new(counts[0] as f64, counts[1] as f64) / size;
        let border = border(&faces);
        let (by_cell, long) = (Lists::default(), TurnedBoxes::default());
        let mut locator = Self { places, faces, domain, counts, cells_per_unit, by_cell, long, border };
        locator.sort_faces();
        locator
    }

    fn sort_faces(&mut self) {
        let (mut pairs, mut long) = (Vec::new(), Vec::new());
        for face in 0..self.faces.len() as u32 {
            let corners = self.corners(face);
            let around = Domain::around(corners);
            let [first, last] = [around.min, around.max].map(|corner| self.cell(corner));
            let [columns, rows] = [0, 1].map(|axis| last[axis] - first[axis] + 1);
            if columns.saturating_mul(rows) > MOST_CELLS {
                memory::push(&mut long, (face, corners));
            } else {
                self.for_each_cell(&around, |cell| memory::push(&mut pairs, (cell as u32, face)));
            }
        }
        self.by_cell = Lists::new(self.counts[0] * self.counts[1], pairs.into_iter());
        self.long = TurnedBoxes::new(long, self.largest());
    }

    /// The largest coordinate.
    pub(super) fn largest(&self) -> f64 {
        self.domain.min.abs().max(self.domain.max.abs()).max_element()
    }

    /// The box of all faces.
    pub(crate) fn domain(&self) -> Domain {
        self.domain
    }

    /// The corners of a face.
    pub(crate) fn corners(&self, face: u32) -> [DVec2; 3] {
        self.faces[face as usize].map(|knot| self.places[knot as usize])
    }

    /// The faces.
    pub(crate) fn faces(&self) -> &[[u32; 3]] {
        &self.faces
    }

    /// The places of their corners.
    pub(crate) fn places(&self) -> &[DVec2] {
        &self.places
    }

    fn cell(&self, t: DVec2) -> [usize; 2] {
        let at = (t - self.domain.min) * self.cells_per_unit;
        [(at.x as usize).min(self.counts[0] - 1), (at.y as usize).min(self.counts[1] - 1)]
    }

    fn for_each_cell(&self, around: &Domain, mut work: impl FnMut(usize)) {
        let ([i0, j0], [i1, j1]) = (self.cell(around.min), self.cell(around.max));
        for i in i0..=i1 {
            (j0..=j1).for_each(|j| work(i * self.counts[1] + j));
        }
    }

    fn entries(&self, cell: usize) -> &[u32] {
        self.by_cell.of(cell)
    }

    /// The faces in one of which a point is, in increasing order.
    pub(super) fn candidates(&self, t: DVec2) -> Cow<'_, [u32]> {
        let [i, j] = self.cell(t);
        let near = self.entries(i * self.counts[1] + j);
        if self.long.is_empty() {
            return Cow::Borrowed(near);
        }
        let mut all = memory::copied(near);
        self.long.near(&[t], &mut all);
        all.sort_unstable();
        Cow::Owned(all)
    }

    /// The face that holds a point, and the side from which limits are taken: from the right and above where a
    /// face is there, else from the inside of the face.
    pub(crate) fn find(&self, t: DVec2) -> Option<(u32, Site)> {
        if !self.domain.contains(t) {
            return None;
        }
        let near = self.candidates(t);
        let site = Site::new(t);
        if let Some(&face) = near.iter().find(|&&face| self.holds(face, &site)) {
            return Some((face, site));
        }
        if let Some(&face) = near.iter().find(|&&face| self.touches(face, t)) {
            return Some((face, self.site_in(face, t)));
        }
        near.iter().find_map(|&face| Some((face, self.site_in(face, self.nudged(face, t)?))))
    }

    /// A point that only rounding has put outside a face, moved back in.
    fn nudged(&self, face: u32, t: DVec2) -> Option<DVec2> {
        let slack = SLACK * self.largest();
        let inward = self.site_in(face, t).toward;
        let steps = std::iter::successors(Some(f64::EPSILON / SLACK * slack), |step| Some(2.0 * step));
        steps
            .map(|step| step / inward.length() * inward)
            .take_while(|step| step.length() <= slack)
            .map(|step| t + step)
            .find(|&moved| self.touches(face, moved))
    }

    fn holds(&self, face: u32, site: &Site) -> bool {
        let [a, b, c] = self.corners(face);
        let areas = [signed_area(a, b, site.t), signed_area(b, c, site.t), signed_area(c, a, site.t)];
        let is_inside = areas.iter().all(|&area| area > 0.0);
        is_inside || (areas.iter().all(|&area| area >= 0.0) && site.is_in([a, b, c]))
    }

    fn touches(&self, face: u32, t: DVec2) -> bool {
        let [a, b, c] = self.corners(face);
        [(a, b), (b, c), (c, a)].iter().all(|&(p, q)| orientation(p, q, t) != Orientation::Negative)
    }

    /// A point of a face as [`Locator::find`] would see it if there were no other.
    pub(crate) fn site_on(&self, face: u32, t: DVec2) -> Site {
        match Site::new(t) {
            site if self.holds(face, &site) => site,
            _ if self.touches(face, t) => self.site_in(face, t),
            _ => self.site_in(face, self.nudged(face, t).unwrap_or(t)),
        }
    }

    /// A point of a face, seen from inside the face.
    pub(crate) fn site_in(&self, face: u32, t: DVec2) -> Site {
        let corners = self.corners(face);
        let inside: DVec2 = corners.iter().zip(ASKEW).map(|(&corner, share)| share * (corner - t)).sum();
        Site { t, toward: inside }
    }

    /// The sides that bound the faces, with their faces.
    pub(super) fn border(&self) -> &[(u32, [u32; 2])] {
        &self.border
    }

    /// The ends of the sides that bound the faces; each comes twice.
    pub(crate) fn border_knots(&self) -> impl Iterator<Item = u32> + '_ {
        self.border.iter().flat_map(|&(_, side)| side)
    }

    /// The place on the faces nearest to a point outside, and its face.
    pub(crate) fn nearest(&self, t: DVec2) -> Option<(u32, DVec2)> {
        let place = |knot: u32| self.places[knot as usize];
        let on = |&(face, [a, b]): &(u32, [u32; 2])| (face, nearest_on_segment(t, place(a), place(b)));
        let nearer =
            |p: &(u32, DVec2), q: &(u32, DVec2)| p.1.distance_squared(t).total_cmp(&q.1.distance_squared(t));
        let (face, near) = self.border.iter().map(on).min_by(nearer)?;
        Some((face, if self.touches(face, near) { near } else { self.nudged(face, near).unwrap_or(near) }))
    }
}

/// The sides of faces that no other face has, with their faces.
fn border(faces: &[[u32; 3]]) -> Vec<(u32, [u32; 2])> {
    let sides = |[a, b, c]: [u32; 3]| [[a, b], [b, c], [c, a]];
    let mut all: Vec<[u32; 2]> = faces.iter().flat_map(|&face| sides(face)).collect_vec();
    all.sort_unstable();
    let is_free = |[a, b]: &[u32; 2]| all.binary_search(&[*b, *a]).is_err();
    let numbered = faces.iter().enumerate();
    numbered
        .flat_map(|(f, &face)| sides(face).into_iter().filter(is_free).map(move |side| (f as u32, side)))
        .collect_vec()
}

fn nearest_on_segment(t: DVec2, from: DVec2, to: DVec2) -> DVec2 {
    let along = to - from;
    from + ((t - from).dot(along) / along.length_squared()).clamp(0.0, 1.0) * along
}
