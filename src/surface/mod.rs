//! Surfaces: maps from a rectangle of parameters (u,v) to R^d, in four families with one common view.
//!
//! [`Surface`] is what every family can do; [`evaluate`](evaluate::evaluate) turns it into batches over
//! threads with rules for parameters outside; [`Region`] holds what a surface knows of the data it was
//! made from: their box in (u,v), and their boundary loops, the trims.

mod any;
pub(crate) mod cubic;
mod cut;
pub mod d1rc;
mod differential;
pub mod evaluate;
pub mod g1;
mod homogeneous;
mod label;
pub mod pht;
mod region;
mod rows_of_four;
pub mod tensor;
pub mod tspline;

pub use crate::geometry::Domain;
pub use any::{AnySurface, ConvertError};
pub use differential::{Curvatures, curvatures, normal, surface_gradient};
pub use label::{Label, Unit};
pub use region::{Region, TrimError, Trims};

use crate::bezier::BezierPatch;
use crate::memory::{self, CollectVec};
use glam::{DVec2, DVec3};
use std::sync::Arc;

/// The family of a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Tensor product B-spline, with or without weights.
    Tensor,
    /// T-spline with control curves.
    TSpline,
    /// Bicubic spline over a hierarchical T-mesh.
    Pht,
    /// Spline over a triangular control mesh.
    D1rc,
}

/// Highest derivative that [`Surface::eval_rows`] computes.
pub const MAX_DERIVATIVE: usize = 2;

/// Rows that one point takes with all derivatives up to `max_derivative`: S; Su, Sv; Suu, Suv, Svv.
pub const fn derivative_rows(max_derivative: usize) -> usize {
    (max_derivative + 1) * (max_derivative + 2) / 2
}

/// Orders (in u, in v) of those rows.
const ORDERS: [(usize, usize); 6] = [(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)];

/// What a surface of any family can do.
pub trait Surface: Send + Sync {
    /// The family.
    fn kind(&self) -> Kind;

    /// Components of a value: 1 for a scalar field, 3 for a shape.
    fn dim(&self) -> usize;

    /// The rectangle on which the surface is defined, or the box around where it is.
    fn domain(&self) -> Domain;

    /// Whether the surface is defined at a parameter pair: everywhere on its domain, unless that is no rectangle.
    fn contains(&self, uv: DVec2) -> bool {
        self.domain().contains(uv)
    }

    /// Number of control points.
    fn coefficient_count(&self) -> usize;

    /// What the surface knows of the data it was made from.
    fn region(&self) -> &Region;

    /// The same, to replace trims.
    fn region_mut(&mut self) -> &mut Region;

    /// Values and derivatives up to `max_derivative` at each of `uv`: for each point the rows S, Su, Sv,
    /// Suu, Suv, Svv (as many as asked for) of `dim` numbers, tightly packed. Beyond the domain the end
    /// polynomials are continued.
    fn eval_rows(&self, uv: &[DVec2], max_derivative: usize, out: &mut [f64]);

    /// The surface as Bezier patches; None for a family that is not polynomial on rectangles.
    fn patches(&self) -> Option<&dyn Patches> {
        None
    }

    /// The triangles in the parameter plane over which the surface is made; None for the other families.
    fn facets(&self) -> Option<Arc<dyn Facets>> {
        None
    }

    /// The control points of a surface in space with the lines that join them; None for other dimensions.
    fn control_net(&self) -> Option<ControlNet> {
        None
    }

    /// Straight lines in the parameter plane that show how the surface is divided: knot lines, or the edges of a
    /// T-mesh or of a control mesh.
    fn knot_lines(&self) -> Vec<[DVec2; 2]> {
        match (self.patches(), self.facets()) {
            (Some(patches), _) => sides(patches, self.domain().max),
            (None, Some(facets)) => edges(facets.as_ref()),
            (None, None) => Vec::new(),
        }
    }

    /// Values at all pairs of `u` and `v`, `v` running fastest.
    fn eval_grid(&self, u: &[f64], v: &[f64], out: &mut [f64]) {
        eval_grid_by_rows(self, u, v, out);
    }
}

/// The control points of a surface in space, joined as neighbours.
#[derive(Debug, Clone, PartialEq)]
pub struct ControlNet {
    /// The control points, not multiplied by weights.
    pub points: Vec<DVec3>,
    /// Their weights; None for a polynomial surface.
    pub weights: Option<Vec<f64>>,
    /// Polylines of control points.
    pub lines: Vec<Vec<u32>>,
}

/// The common view of tensor surfaces, T-splines and PHT-splines: Bezier patches over rectangles that cover
/// the domain without overlap.
pub trait Patches: Send + Sync {
    /// Number of patches.
    fn patch_count(&self) -> usize;

    /// The exact patch of a number below [`Patches::patch_count`].
    fn patch(&self, index: usize) -> BezierPatch;

    /// The patch over a parameter pair, in constant or logarithmic time; beyond the domain the one whose
    /// polynomial is continued there.
    fn patch_at(&self, uv: DVec2) -> usize;
}

/// The lower sides of all patches, and the upper ones at the end of the domain.
fn sides(patches: &dyn Patches, end: DVec2) -> Vec<[DVec2; 2]> {
    let mut sides = memory::with_capacity(2 * patches.patch_count());
    for index in 0..patches.patch_count() {
        let Domain { min, max } = patches.patch(index).domain;
        let (lower_right, upper_left) = (DVec2::new(max.x, min.y), DVec2::new(min.x, max.y));
        memory::extend(&mut sides, [[min, lower_right], [min, upper_left]]);
        if max.x == end.x {
            memory::push(&mut sides, [lower_right, max]);
        }
        if max.y == end.y {
            memory::push(&mut sides, [upper_left, max]);
        }
    }
    sides
}

/// The edges of all facets, each once.
fn edges(facets: &dyn Facets) -> Vec<[DVec2; 2]> {
    let ends = |[a, b, c]: [u32; 3]| [[a, b], [b, c], [c, a]].map(|[p, q]| [p.min(q), p.max(q)]);
    let mut edges: Vec<[u32; 2]> = facets.triangles().into_iter().flat_map(ends).collect_vec();
    edges.sort_unstable();
    edges.dedup();
    edges.into_iter().map(|ends| ends.map(|corner| facets.places()[corner as usize])).collect_vec()
}

/// The view of a surface over triangles in the parameter plane, for those who keep it and divide its facets.
pub trait Facets: Surface + std::fmt::Debug {
    /// The places of the corners.
    fn places(&self) -> &[DVec2];

    /// Three corners each: the facets on which the surface is best shown.
    fn triangles(&self) -> Vec<[u32; 3]>;

    /// Values at points of one of those facets.
    fn eval_on_facet(&self, facet: usize, uv: &[DVec2], out: &mut [f64]);

    /// Whether the trims are the border of those facets.
    fn has_own_trims(&self) -> bool;

    /// The place of the domain nearest to a parameter pair.
    fn nearest_in_domain(&self, uv: DVec2) -> DVec2;
}

/// [`Surface::eval_grid`] for families without a faster way: row by row.
fn eval_grid_by_rows<S: Surface + ?Sized>(surface: &S, u: &[f64], v: &[f64], out: &mut [f64]) {
    let row = v.len() * surface.dim();
    for (&u, out) in u.iter().zip(out.chunks_exact_mut(row.max(1))) {
        let uv: Vec<DVec2> = v.iter().map(|&v| DVec2::new(u, v)).collect_vec();
        surface.eval_rows(&uv, 0, out);
    }
}
