//! Fast values of functions whose knots are in general position.
//!
//! The degree 1 spline of four knots is the thickness of a tetrahedron seen from above: the height of the lower of
//! its upper faces over the higher of its lower ones, so the least of linear forms, one for each edge of the
//! hull of its knots. A form vanishes on its edge (i,j); with the other knots k, l it is
//! ```text
//! M_1(t|i,j,k,l) = max(0, min over hull edges of det(i,j,t) / |det(i,j,k) det(i,j,l)|)
//! M_2(t|X,a,b)   = sum_j lambda_j(t|X) M_1(t|X \ x_j, a, b)                      k = 3
//! ```
//! which follows from `integral M_1 = 1/6` for both shapes of the hull. It is continuous, so no sides need be taken. Per
//! function and point there is one area for each pair of knots that share a simplex spline; everything else is
//! products and comparisons, for several points at once. First and second derivatives come from the same `M`.
//!
//! Functions with collinear or equal knots, with an X that is nearly flat, and those of degree 1 go by definition
//! (`configuration`).

use super::configuration::{Configuration, Jet};
use super::simplex::{Site, barycentric_gradients};
use crate::geometry::signed_area;
use glam::DVec2;
use std::ops::Range;

/// Most knots in the edges of a fast function; rings of the printed construction have up to 18.
const MAX_RING: usize = 24;
/// Most areas of one function: pairs among X, pairs of X and ring, edges.
const MAX_AREAS: usize = 3 + 4 * MAX_RING;

/// Least area of X against the squared diagonal of all knots: as many digits are lost as barycentric coordinates
/// of X are large.
const FLATTEST: f64 = 1.0 / 256.0;

/// Points that are evaluated together.
pub const LANES: usize = 4;

/// One of the forms of an `M_1`: areas and their factors. A hull of three edges repeats one.
#[derive(Debug, Clone, Copy, Default)]
struct Thickness {
    areas: [u8; 4],
    factors: [f64; 4],
}

/// An edge, and the `M_1` of its knots with all but one of X (degree 3), or with X (degree 2).
#[derive(Debug, Clone, Copy)]
struct Term {
    /// From the first knot of the edge to the second, turned left.
    across: DVec2,
    /// Of the edge's area.
    area: u8,
    /// Its knots.
    ends: [u8; 2],
    thickness: [Thickness; 3],
}

/// What is known of a function beforehand.
#[derive(Debug, Clone)]
struct Piece {
    min: DVec2,
    max: DVec2,
    /// X, then the ring; empty for functions that go by definition.
    knots: Range<u32>,
    terms: Range<u32>,
    /// One over twice the area of X, and the gradients of its barycentric coordinates.
    inverse_area: f64,
    gradients: [DVec2; 3],
}

/// All functions of a space.
#[derive(Debug, Clone)]
pub struct Kernel {
    degree: usize,
    pieces: Vec<Piece>,
    knots: Vec<DVec2>,
    terms: Vec<Term>,
}

/// Room for the areas of one function.
pub struct Workspace<const L: usize> {
    areas: [[f64; L]; MAX_AREAS],
}

impl<const L: usize> Default for Workspace<L> {
    fn default() -> Self {
        Self { areas: [[0.0; L]; MAX_AREAS] }
    }
}

/// Jets at `L` points: value, u, v, uu, uv, vv of each.
pub type Jets<const L: usize> = [[f64; L]; 6];

impl Kernel {
    /// Prepares functions of one degree.
    pub fn new(degree: usize, configurations: &[Configuration], places: &[DVec2]) -> Self {
        let mut kernel = Self { degree, pieces: Vec::new(), knots: Vec::new(), terms: Vec::new() };
        for configuration in configurations {
            let piece = kernel.prepare(configuration, places);
            kernel.pieces.push(piece);
        }
        kernel
    }

    fn prepare(&mut self, configuration: &Configuration, places: &[DVec2]) -> Piece {
        let (first_knot, first_term) = (self.knots.len(), self.terms.len());
        let all = || configuration.all_knots().map(|knot| places[knot as usize]);
        let (min, max) = all().fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(a, b), p| (a.min(p), b.max(p)));
        let mut piece =
            Piece { min, max, knots: 0..0, terms: 0..0, inverse_area: 0.0, gradients: [DVec2::ZERO; 3] };
        let ring_count = configuration.edges.len();
        if self.degree == 1 || ring_count > MAX_RING {
            return piece;
        }
        let ring: Vec<u32> = configuration.edges.iter().map(|edge| edge[0]).collect();
        let local = Local { degree: self.degree, ring_count, knots: all().collect() };
        if self.degree == 3 {
            let x = [0, 1, 2].map(|i| local.knots[i]);
            let area = signed_area(x[0], x[1], x[2]);
            if area.abs() < FLATTEST * min.distance_squared(max) {
                return piece;
            }
            piece.inverse_area = 1.0 / area;
            piece.gradients = barycentric_gradients(x, area);
        }
        for (number, edge) in configuration.edges.iter().enumerate() {
            let Some(to) = ring.iter().position(|&knot| knot == edge[1]) else { return piece };
            let Some(term) = local.term(number, to) else {
                self.terms.truncate(first_term);
                return piece;
            };
            self.terms.push(term);
        }
        self.knots.extend(local.knots);
        piece.knots = first_knot as u32..self.knots.len() as u32;
        piece.terms = first_term as u32..self.terms.len() as u32;
        piece
    }

    /// Whether a function goes the fast way.
    pub fn is_fast(&self, function: u32, order: usize) -> bool {
        // second derivatives of degree 2 are not continuous
        !self.pieces[function as usize].knots.is_empty() && (order < 2 || self.degree == 3)
    }

    /// The function at `L` points; None where it is zero at all of them because they lie outside its box.
    #[inline(always)]
    pub fn jets<const L: usize>(
        &self,
        function: u32,
        configuration: &Configuration,
        places: &[DVec2],
        sites: &[Site; L],
        order: usize,
        workspace: &mut Workspace<L>,
    ) -> Option<Jets<L>> {
        let piece = &self.pieces[function as usize];
        let is_out = |site: &Site| site.t.cmplt(piece.min).any() || site.t.cmpgt(piece.max).any();
        if sites.iter().all(is_out) {
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
        let mut lambda = [[0.0; L]; 3];
        for j in 0..3 {
            for l in 0..L {
                lambda[j][l] = areas[j][l] * piece.inverse_area;
            }
        }
        let mut jets = [[0.0; L]; 6];
        for term in &self.terms[piece.terms.start as usize..piece.terms.end as usize] {
            let splines = [0, 1, 2].map(|j| thickness(&term.thickness[j], areas));
            let area = &areas[term.area as usize];
            for l in 0..L {
                let spline = lambda[0][l] * splines[0][l]
                    + (lambda[1][l] * splines[1][l] + lambda[2][l] * splines[2][l]);
                jets[0][l] += area[l] * spline;
                if ORDER > 0 {
                    jets[1][l] += 3.0 * term.across.x * spline;
                    jets[2][l] += 3.0 * term.across.y * spline;
                }
                if ORDER > 1 {
                    let [g0, g1, g2] = piece.gradients;
                    let slope = splines[0][l] * g0 + (splines[1][l] * g1 + splines[2][l] * g2);
                    jets[3][l] += 6.0 * term.across.x * slope.x;
                    jets[4][l] += 3.0 * (term.across.x * slope.y + term.across.y * slope.x);
                    jets[5][l] += 6.0 * term.across.y * slope.y;
                }
            }
        }
        jets
    }

    /// The areas of all pairs with each point, in the order of [`Local::pair`].
    #[inline(always)]
    fn areas<const L: usize, const K: usize>(
        &self,
        piece: &Piece,
        sites: &[Site; L],
        workspace: &mut Workspace<L>,
    ) {
        let knots = &self.knots[piece.knots.start as usize..piece.knots.end as usize];
        let (x, ring) = knots.split_at(K);
        let areas = &mut workspace.areas;
        let mut next = 0;
        let mut add = |a: DVec2, b: DVec2| {
            for l in 0..L {
                areas[next][l] = signed_area(a, b, sites[l].t);
            }
            next += 1;
        };
        if K == 3 {
            add(x[1], x[2]);
            add(x[2], x[0]);
        }
        add(x[0], x[1]);
        for &knot in ring {
            for i in 0..K {
                add(x[i], knot);
            }
        }
        for term in &self.terms[piece.terms.start as usize..piece.terms.end as usize] {
            let [a, b] = term.ends.map(|end| knots[end as usize]);
            add(a, b);
        }
    }
}

/// `M_1` from the areas of its hull.
#[inline(always)]
fn thickness<const L: usize>(thickness: &Thickness, areas: &[[f64; L]; MAX_AREAS]) -> [f64; L] {
    let mut least = [f64::INFINITY; L];
    for form in 0..4 {
        let (area, factor) = (&areas[thickness.areas[form] as usize], thickness.factors[form]);
        for l in 0..L {
            let value = factor * area[l];
            least[l] = if value < least[l] { value } else { least[l] };
        }
    }
    least.map(|value| if value > 0.0 { value } else { 0.0 })
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
        match self.degree {
            2 => thickness[0] = self.thickness([0, 1, ends[0], ends[1]], number)?,
            _ => {
                for j in 0..3 {
                    thickness[j] = self.thickness([(j + 1) % 3, (j + 2) % 3, ends[0], ends[1]], number)?;
                }
            }
        }
        let area = self.edge_area(number);
        Some(Term { across: (b - a).perp(), area, ends: ends.map(|end| end as u8), thickness })
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
                hull.areas[count] = self.pair(of[i], of[j], edge);
                hull.factors[count] = left.signum() / (left * right);
                count += 1;
            }
        }
        for spare in count..4 {
            (hull.areas[spare], hull.factors[spare]) = (hull.areas[0], hull.factors[0]);
        }
        hull.factors.iter().all(|factor| factor.is_finite()).then_some(hull)
    }

    /// Where the area of two knots is, the pair directed as in [`Kernel::areas`].
    fn pair(&self, i: usize, j: usize, edge: usize) -> u8 {
        let x_count = if self.degree == 3 { 3 } else { 1 };
        match (i < self.degree, j < self.degree) {
            // the pairs of X by the knot left out, of (j + 1, j + 2)
            (true, true) if self.degree == 3 => (3 - i - j) as u8,
            (true, true) => 0,
            (true, false) => (x_count + self.degree * (j - self.degree) + i) as u8,
            _ => self.edge_area(edge),
        }
    }

    fn edge_area(&self, edge: usize) -> u8 {
        let x_count = if self.degree == 3 { 3 } else { 1 };
        (x_count + self.degree * self.ring_count + edge) as u8
    }
}
