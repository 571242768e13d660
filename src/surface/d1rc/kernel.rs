//! Fast values of functions whose knots are in general position.
//!
//! The degree 1 spline of four knots is the thickness of a tetrahedron seen from above: the height of the lower of
//! its upper faces over the higher of its lower ones, so the least of linear forms, one for each edge of the
//! hull of its knots. A form vanishes on its edge (i,j); with the other knots k, l it is
//! ```text
//! M_1(t|i,j,k,l) = max(0, min over hull edges of det(i,j,t) / |det(i,j,k) det(i,j,l)|)
//! M_2(t|U)         = sum_j lambda_j(t|W) M_1(t|U \ w_j)           k = 3, W the three knots of largest area
//! ```
//! which follows from `integral M_1 = 1/6` for both shapes of the hull. It is continuous, so no sides need be taken. Per
//! function and point there is one area for each pair of knots that share a simplex spline; everything else is
//! products and comparisons, for several points at once. First and second derivatives come from the same `M`.
//!
//! Functions with collinear or equal knots and those of degree 1 go by definition (`configuration`).

use super::configuration::{Configuration, Jet};
use super::simplex::{Site, barycentric_gradients, widest_triangle};
use crate::control::{Cancelled, Watch};
use crate::geometry::{CANCELLATION, signed_area};
use crate::memory::{self, CollectVec};
use glam::DVec2;
use std::ops::Range;

/// Most knots in the edges of a fast function; rings of the printed construction have up to 18.
const MAX_RING: usize = 24;
const MAX_KNOTS: usize = 3 + MAX_RING;
/// Most areas of one function: pairs among X, pairs of X and ring, edges.
const MAX_AREAS: usize = 3 + 4 * MAX_RING;

/// Points that are evaluated together.
pub(super) const LANES: usize = 4;

/// One of the forms of an `M_1`: areas and their factors. A hull of three edges repeats one.
#[derive(Debug, Clone, Copy, Default)]
struct Thickness {
    areas: [u8; 4],
    factors: [f64; 4],
}

/// An edge, and the `M_1` of its knots and X without one of W (degree 3), or of all (degree 2).
#[derive(Debug, Clone, Copy)]
struct Term {
    /// From the first knot of the edge to the second, turned left.
    across: DVec2,
    /// Of the edge's area.
    area: u8,
    /// Its knots.
    ends: [u8; 2],
    thickness: [Thickness; 3],
    /// Degree 3: the barycentric coordinates that go with them.
    lambda: [Lambda; 3],
}

/// A barycentric coordinate of a point in W: an area and its factor.
#[derive(Debug, Clone, Copy, Default)]
struct Lambda {
    area: u8,
    factor: f64,
    gradient: DVec2,
}

/// What is known of a function beforehand.
#[derive(Debug, Clone)]
struct Piece {
    min: DVec2,
    max: DVec2,
    /// X, then the ring; empty for functions that go by definition.
    knots: Range<u32>,
    terms: Range<u32>,
}

/// All functions of a space.
#[derive(Debug, Clone)]
pub(super) struct Kernel {
    degree: usize,
    pieces: Vec<Piece>,
    knots: Vec<DVec2>,
    terms: Vec<Term>,
}

/// Room for the areas of one function.
pub(super) struct Workspace<const L: usize> {
    areas: [[f64; L]; MAX_AREAS],
    /// From the points to the knots.
    x: [[f64; L]; MAX_KNOTS],
    y: [[f64; L]; MAX_KNOTS],
}

impl<const L: usize> Default for Workspace<L> {
    fn default() -> Self {
        Self { areas: [[0.0; L]; MAX_AREAS], x: [[0.0; L]; MAX_KNOTS], y: [[0.0; L]; MAX_KNOTS] }
    }
}

/// Jets at `L` points: value, u, v, uu, uv, vv of each.
pub(super) type Jets<const L: usize> = [[f64; L]; 6];

impl Kernel {
    /// Prepares functions of one degree.
    pub(super) fn new(
        degree: usize,
        configurations: &[Configuration],
        places: &[DVec2],
        watch: &Watch,
    ) -> Result<Self, Cancelled> {
        let mut kernel = Self { degree, pieces: Vec::new(), knots: Vec::new(), terms: Vec::new() };
        for (number, configuration) in configurations.iter().enumerate() {
            watch.check_at(number)?;
            let piece = kernel.prepare(configuration, places);
            memory::push(&mut kernel.pieces, piece);
        }
        Ok(kernel)
    }

    fn prepare(&mut self, configuration: &Configuration, places: &[DVec2]) -> Piece {
        let (first_knot, first_term) = (self.knots.len(), self.terms.len());
        let all = || configuration.all_knots().map(|knot| places[knot as usize]);
        let (min, max) = all().fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(a, b), p| (a.min(p), b.max(p)));
        let mut piece = Piece { min, max, knots: 0..0, terms: 0..0 };
        let ring_count = configuration.edges.len();
        if self.degree == 1 || ring_count > MAX_RING {
            return piece;
        }
        let ring: Vec<u32> = configuration.edges.iter().map(|edge| edge[0]).collect_vec();
        let local = Local { degree: self.degree, ring_count, knots: all().collect_vec() };
        for (number, edge) in configuration.edges.iter().enumerate() {
            let Some(to) = ring.iter().position(|&knot| knot == edge[1]) else { return piece };
            let Some(term) = local.term(number, to) else {
                self.terms.truncate(first_term);
                return piece;
            };
            memory::push(&mut self.terms, term);
        }
        memory::extend(&mut self.knots, local.knots);
        piece.knots = first_knot as u32..self.knots.len() as u32;
        piece.terms = first_term as u32..self.terms.len() as u32;
        piece
    }

    /// Whether a function goes the fast way.
    pub(super) fn is_fast(&self, function: u32, order: usize) -> bool {
        // second derivatives of degree 2 are not continuous
        !self.pieces[function as usize].knots.is_empty() && (order < 2 || self.degree == 3)
    }

    /// The function at `L` points; None where it is zero at all of them because they lie outside its box.
    #[inline(always)]
    pub(super) fn jets<const L: usize>(
        &self,
        function: u32,
        configuration: &Configuration,
        places: &[DVec2],
        sites: &[Site; L],
        order: usize,
        workspace: &mut Workspace<L>,
    ) -> Option<Jets<L>> {
        let piece = &self.pieces[function as usize];
        let mut is_out = true;
        for site in sites {
            is_out &= site.t.x < piece.min.x
                || site.t.x > piece.max.x
                || site.t.y < piece.min.y
                || site.t.y > piece.max.y;
        }
        if is_out {
            return None;
        }
        if !self.is_fast(function, order) {
            return Some(by_definition(configuration, places, sites, order));
        }
        match (self.degree, order) {
            (2, _) => Some(self.quadratic(piece, sites, workspace)),
            (_, 0) => Some(self.cubic::<L, 0>(piece, sites, workspace)),
            (_, 1) => Some(self.cubic::<L, 1>(piece, sites, workspace)),
            _ => Some(self.cubic::<L, 2>(piece, sites, workspace)),
        }
    }

    /// Values and first derivatives.
    #[inline(always)]
    fn quadratic<const L: usize>(
        &self,
        piece: &Piece,
        sites: &[Site; L],
        workspace: &mut Workspace<L>,
    ) -> Jets<L> {
        self.areas::<L, 2>(piece, sites, workspace);
        let areas = &workspace.areas;
        let mut jets = [[0.0; L]; 6];
        for term in &self.terms[piece.terms.start as usize..piece.terms.end as usize] {
            let spline = thickness(&term.thickness[0], areas);
            let area = &areas[term.area as usize];
            for l in 0..L {
                jets[0][l] += area[l] * spline[l];
                jets[1][l] += 2.0 * term.across.x * spline[l];
                jets[2][l] += 2.0 * term.across.y * spline[l];
            }
        }
        jets
    }

    #[inline(always)]
    fn cubic<const L: usize, const ORDER: usize>(
        &self,
        piece: &Piece,
        sites: &[Site; L],
        workspace: &mut Workspace<L>,
    ) -> Jets<L> {
        self.areas::<L, 3>(piece, sites, workspace);
        let areas = &workspace.areas;
        let mut jets = [[0.0; L]; 6];
        for term in &self.terms[piece.terms.start as usize..piece.terms.end as usize] {
            let splines = [
                thickness(&term.thickness[0], areas),
                thickness(&term.thickness[1], areas),
                thickness(&term.thickness[2], areas),
            ];
            let area = &areas[term.area as usize];
            let [j0, j1, j2] = &term.lambda;
            let lambda = [&areas[j0.area as usize], &areas[j1.area as usize], &areas[j2.area as usize]];
            for l in 0..L {
                let spline = j0.factor * lambda[0][l] * splines[0][l]
                    + (j1.factor * lambda[1][l] * splines[1][l] + j2.factor * lambda[2][l] * splines[2][l]);
                jets[0][l] += area[l] * spline;
                if ORDER > 0 {
                    jets[1][l] += 3.0 * term.across.x * spline;
                    jets[2][l] += 3.0 * term.across.y * spline;
                }
                if ORDER > 1 {
                    let slope = splines[0][l] * j0.gradient
                        + (splines[1][l] * j1.gradient + splines[2][l] * j2.gradient);
                    jets[3][l] += 6.0 * term.across.x * slope.x;
                    jets[4][l] += 3.0 * (term.across.x * slope.y + term.across.y * slope.x);
                    jets[5][l] += 6.0 * term.across.y * slope.y;
                }
            }
        }
        jets
    }

    /// The areas of all pairs with each point, in the order of [`Local::directed_pair`].
    #[inline(always)]
    fn areas<const L: usize, const K: usize>(
        &self,
        piece: &Piece,
        sites: &[Site; L],
        workspace: &mut Workspace<L>,
    ) {
        let knots = &self.knots[piece.knots.start as usize..piece.knots.end as usize];
        let Workspace { areas, x, y } = workspace;
        for (k, knot) in knots.iter().enumerate() {
            for l in 0..L {
                x[k][l] = knot.x - sites[l].t.x;
                y[k][l] = knot.y - sites[l].t.y;
            }
        }
        let seen = Seen { knots, sites, x, y };
        if K == 3 {
            seen.area(1, 2, &mut areas[0]);
            seen.area(2, 0, &mut areas[1]);
            seen.area(0, 1, &mut areas[2]);
        } else {
            seen.area(0, 1, &mut areas[0]);
        }
        let mut next = if K == 3 { 3 } else { 1 };
        for ring in K..knots.len() {
            for i in 0..K {
                seen.area(i, ring, &mut areas[next]);
                next += 1;
            }
        }
        for term in &self.terms[piece.terms.start as usize..piece.terms.end as usize] {
            seen.area(term.ends[0] as usize, term.ends[1] as usize, &mut areas[next]);
            next += 1;
        }
    }
}

/// The knots of a function as the points see them.
struct Seen<'a, const L: usize> {
    knots: &'a [DVec2],
    sites: &'a [Site; L],
    x: &'a [[f64; L]; MAX_KNOTS],
    y: &'a [[f64; L]; MAX_KNOTS],
}

impl<const L: usize> Seen<'_, L> {
    /// [`signed_area`] of two knots and each point.
    #[inline(always)]
    fn area(&self, a: usize, b: usize, out: &mut [f64; L]) {
        let mut is_close = false;
        for l in 0..L {
            let (left, right) = (self.x[a][l] * self.y[b][l], self.y[a][l] * self.x[b][l]);
            out[l] = left - right;
            is_close |= out[l].abs() < CANCELLATION * (left.abs() + right.abs());
        }
        if is_close {
            careful_areas(self.knots[a], self.knots[b], self.sites, out);
        }
    }
}

#[cold]
#[inline(never)]
fn careful_areas<const L: usize>(a: DVec2, b: DVec2, sites: &[Site; L], out: &mut [f64; L]) {
    for (area, site) in out.iter_mut().zip(sites) {
        *area = signed_area(a, b, site.t);
    }
}

/// `M_1` from the areas of its hull.
#[inline(always)]
fn thickness<const L: usize>(thickness: &Thickness, areas: &[[f64; L]; MAX_AREAS]) -> [f64; L] {
    let mut least = [0.0; L];
    let first = &areas[thickness.areas[0] as usize];
    for l in 0..L {
        least[l] = thickness.factors[0] * first[l];
    }
    for form in 1..4 {
        let (area, factor) = (&areas[thickness.areas[form] as usize], thickness.factors[form]);
        for l in 0..L {
            let value = factor * area[l];
            least[l] = if value < least[l] { value } else { least[l] };
        }
    }
    for l in 0..L {
        least[l] = if least[l] > 0.0 { least[l] } else { 0.0 };
    }
    least
}

#[cold]
#[inline(never)]
fn by_definition<const L: usize>(
    configuration: &Configuration,
    places: &[DVec2],
    sites: &[Site; L],
    order: usize,
) -> Jets<L> {
    let each: [Jet; L] = sites.map(|site| configuration.jet(&site, places, order));
    std::array::from_fn(|row| std::array::from_fn(|l| each[l][row]))
}

/// The knots of one function, X first, while it is prepared.
struct Local {
    degree: usize,
    ring_count: usize,
    knots: Vec<DVec2>,
}

impl Local {
    /// None where three of the knots are collinear.
    fn term(&self, number: usize, to: usize) -> Option<Term> {
        let ends = [self.degree + number, self.degree + to];
        let [a, b] = ends.map(|end| self.knots[end]);
        let mut thickness = [Thickness::default(); 3];
        let mut lambda = [Lambda::default(); 3];
        if self.degree == 2 {
            thickness[0] = self.thickness([0, 1, ends[0], ends[1]], number)?;
        } else {
            let all = [0, 1, 2, ends[0], ends[1]];
            let (w, area) = widest_triangle(&all.map(|knot| self.knots[knot]))?;
            let gradients = barycentric_gradients(w.map(|j| self.knots[all[j]]), area);
            for j in 0..3 {
                let mut rest = [0; 4];
                let others = (0..5).filter(|&knot| knot != w[j]).map(|knot| all[knot]);
                rest.iter_mut().zip(others).for_each(|(place, knot)| *place = knot);
                thickness[j] = self.thickness(rest, number)?;
                let (area_of, sign) = self.directed_pair(all[w[(j + 1) % 3]], all[w[(j + 2) % 3]], number);
                lambda[j] = Lambda { area: area_of, factor: sign / area, gradient: gradients[j] };
            }
        }
        let area = self.edge_area(number);
        Some(Term { across: (b - a).perp(), area, ends: ends.map(|end| end as u8), thickness, lambda })
    }

    fn thickness(&self, of: [usize; 4], edge: usize) -> Option<Thickness> {
        let mut hull = Thickness::default();
        let mut count = 0;
        for (i, j, k, l) in
            [(0, 1, 2, 3), (0, 2, 1, 3), (0, 3, 1, 2), (1, 2, 0, 3), (1, 3, 0, 2), (2, 3, 0, 1)]
        {
            let [p, q] = [of[i], of[j]].map(|knot| self.knots[knot]);
            let [left, right] = [of[k], of[l]].map(|knot| signed_area(p, q, self.knots[knot]));
            if left == 0.0 || right == 0.0 {
                return None;
            }
            if (left > 0.0) == (right > 0.0) {
                let (area, sign) = self.directed_pair(of[i], of[j], edge);
                hull.areas[count] = area;
                hull.factors[count] = sign * left.signum() / (left * right);
                count += 1;
            }
        }
        for spare in count..4 {
            (hull.areas[spare], hull.factors[spare]) = (hull.areas[0], hull.factors[0]);
        }
        hull.factors.iter().all(|factor| factor.is_finite()).then_some(hull)
    }

    /// Where the area of two knots is, one of them in X or both of an edge, and -1 if it is that of the pair turned
    /// over.
    fn directed_pair(&self, i: usize, j: usize, edge: usize) -> (u8, f64) {
        let x_count = if self.degree == 3 { 3 } else { 1 };
        match (i < self.degree, j < self.degree) {
            // the pairs of X by the knot left out, each (j + 1, j + 2)
            (true, true) if self.degree == 3 => {
                ((3 - i - j) as u8, if (i + 1) % 3 == j { 1.0 } else { -1.0 })
            }
            (true, true) => (0, 1.0),
            (true, false) => ((x_count + self.degree * (j - self.degree) + i) as u8, 1.0),
            (false, true) => (self.directed_pair(j, i, edge).0, -1.0),
            (false, false) => (self.edge_area(edge), if i == self.degree + edge { 1.0 } else { -1.0 }),
        }
    }

    fn edge_area(&self, edge: usize) -> u8 {
        let x_count = if self.degree == 3 { 3 } else { 1 };
        (x_count + self.degree * self.ring_count + edge) as u8
    }
}
