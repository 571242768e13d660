//! Configurations and their functions.
//!
//! J. Cao, J. Zheng (2016), (3.1) and (3.2): k knots `X` and directed edges `E` that close around them give
//! ```text
//! b(t)      = sum_E det(a,b,t) M_(k-1)(t|X,a,b)
//! grad b(t) = k sum_E (-(b-a).y, (b-a).x) M_(k-1)(t|X,a,b)
//! D_z D_y b = k (k-1) sum_E ((b-a) x y) sum_j nu_j M_(k-2)(t|X,a,b \ w_j),   z = sum nu_j w_j, sum nu_j = 0
//! ```
//! For any triangulation of what the edges surround this is `sum det(tri) M_k(t|X,tri)`, since inner edges occur
//! twice with opposite signs: it is not negative where the edges surround positive triangles.

use super::simplex::{MAX_KNOTS, Site, simplex_gradient, simplex_spline};
use crate::geometry::signed_area;
use crate::memory::CollectVec;
use glam::DVec2;

/// Value, u, v, uu, uv, vv.
pub type Jet = [f64; 6];

/// A function of the space, and how its control point follows from those of the mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct Configuration {
    /// The knots that count in every edge: as many as the degree.
    pub knots: Vec<u32>,
    /// Pairs of knots, directed so that the knots above lie on their left.
    pub edges: Vec<[u32; 2]>,
    /// Its share in rational surfaces; 1 in polynomial ones.
    pub weight: f64,
    /// The control point: by vertex in increasing order, the vertex's share. They sum to one.
    pub row: Vec<(u32, f64)>,
}

impl Configuration {
    /// The function and its derivatives up to `order` by definition, for any knots; the weight is not in it.
    pub fn jet(&self, site: &Site, places: &[DVec2], order: usize) -> Jet {
        let degree = self.knots.len();
        let mut knots = [DVec2::ZERO; MAX_KNOTS];
        for (knot, &number) in knots.iter_mut().zip(&self.knots) {
            *knot = places[number as usize];
        }
        let mut jet = [0.0; 6];
        for edge in &self.edges {
            let [a, b] = edge.map(|knot| places[knot as usize]);
            knots[degree..degree + 2].copy_from_slice(&[a, b]);
            let all = &knots[..degree + 2];
            let spline = simplex_spline(site, all);
            let across = (b - a).perp();
            jet[0] += signed_area(a, b, site.t) * spline;
            jet[1] += degree as f64 * across.x * spline;
            jet[2] += degree as f64 * across.y * spline;
            if order >= 2 {
                let slope = degree as f64 * simplex_gradient(site, all);
                jet[3] += across.x * slope.x;
                jet[4] += (across.x * slope.y + across.y * slope.x) / 2.0;
                jet[5] += across.y * slope.y;
            }
        }
        jet
    }

    /// All knots, those of the edges last.
    pub fn all_knots(&self) -> impl Iterator<Item = u32> + '_ {
        self.knots.iter().copied().chain(self.edges.iter().map(|edge| edge[0]))
    }
}

/// The mean of rows, by vertex.
pub(super) fn mean_row<'a>(rows: impl ExactSizeIterator<Item = &'a [(u32, f64)]>) -> Vec<(u32, f64)> {
    let share = 1.0 / rows.len() as f64;
    let mut all: Vec<(u32, f64)> =
        rows.flatten().map(|&(vertex, weight)| (vertex, share * weight)).collect_vec();
    all.sort_by_key(|&(vertex, _)| vertex);
    all.dedup_by(|next, kept| {
        let is_same = next.0 == kept.0;
        kept.1 += if is_same { next.1 } else { 0.0 };
        is_same
    });
    all.retain(|&(_, weight)| weight != 0.0);
    all
}
