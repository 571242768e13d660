//! Closest points of surfaces over triangles: the nearest triangle of a tessellation, then Newton's method.
//!
//! `|S - P|^2 / 2` is lowered by damped Newton steps (K. Levenberg 1944, D. Marquardt 1963) as in `foot`; a step
//! that leaves the domain goes to the nearest place of its border. The start is the nearest of a dense
//! tessellation: the answer is the global minimum where no other is nearer by less than the tessellation is off.

use super::ProjectOptions;
use crate::linalg::Symmetric2;
use crate::mesh::Mesh;
use crate::query::tessellate::subdivide::subdivided;
use crate::query::tessellate::{TessellateError, TessellateOptions, tessellate};
use crate::query::triangles::TriangleTree;
use crate::surface::Facets;
use glam::{DVec2, DVec3};
use std::sync::Arc;

/// Parts of each side of a face in the tessellation.
const PARTS: usize = 4;
/// Most nodes of it.
const MAX_POINTS: usize = 8_000_000;
/// Most steps; a regular foot point takes three or four.
const MAX_STEPS: usize = 40;
/// Steps this short against the domain change nothing.
const SHORTEST_STEP: f64 = 1e-14;
/// Damping is given up beyond this many times the metric.
const MOST_DAMPING: f64 = 1e12;
/// The first damping, against the curvature of the distance.
const FIRST_DAMPING: f64 = 1e-3;

/// A surface over triangles with a tessellation of it.
#[derive(Debug, Clone)]
pub(super) struct FacetProjector {
    surface: Arc<dyn Facets>,
    has_own_trims: bool,
    tree: TriangleTree<Mesh>,
}

impl FacetProjector {
    /// For a surface in space.
    pub(super) fn new(surface: Arc<dyn Facets>) -> Result<Self, TessellateError> {
        let has_own_trims = surface.has_own_trims();
        let mesh = match has_own_trims {
            true => subdivided(surface.as_ref(), PARTS, MAX_POINTS)?,
            false => tessellate(surface.as_ref(), &TessellateOptions::default())?.mesh,
        };
        Ok(Self { surface, has_own_trims, tree: TriangleTree::new(mesh) })
    }

    /// Of the box around it.
    pub(super) fn diagonal(&self) -> f64 {
        self.tree.mesh().diagonal()
    }

    /// The nearest place and its distance.
    pub(super) fn nearest(
        &self,
        point: DVec3,
        guess: Option<DVec2>,
        options: &ProjectOptions,
    ) -> (DVec2, f64) {
        let starts = [self.start(point), guess.filter(|&uv| self.counts(uv, options))];
        let feet = starts.into_iter().flatten().map(|uv| self.descend(point, uv, options));
        let best = feet.min_by(|a, b| a.1.total_cmp(&b.1));
        best.filter(|best| best.1 <= options.max_distance).unwrap_or((DVec2::NAN, f64::NAN))
    }

    /// The parameters of the nearest place on the tessellation.
    fn start(&self, point: DVec3) -> Option<DVec2> {
        let near = self.tree.nearest(point)?;
        let mesh = self.tree.mesh();
        let nodes = mesh.triangles()[near.triangle as usize];
        let [a, b, c] = nodes.map(|node| mesh.points()[node as usize]);
        let uv = mesh.parameters()?;
        let [ua, ub, uc] = nodes.map(|node| uv[node as usize]);
        let normal = (b - a).cross(c - a);
        let area_sq = normal.length_squared();
        if !(area_sq > 0.0) {
            return Some(ua);
        }
        let s = (near.point - a).cross(c - a).dot(normal) / area_sq;
        let t = (b - a).cross(near.point - a).dot(normal) / area_sq;
        Some(ua + s * (ub - ua) + t * (uc - ua))
    }

    fn counts(&self, uv: DVec2, options: &ProjectOptions) -> bool {
        self.surface.contains(uv) && (!options.keep_trims || self.surface.region().trims.contains(uv))
    }

    /// The local minimum that Newton's method finds.
    fn descend(&self, point: DVec3, start: DVec2, options: &ProjectOptions) -> (DVec2, f64) {
        let keeps_trims = options.keep_trims && !self.has_own_trims;
        let mut at = self.surface.nearest_in_domain(start);
        let mut here = self.local(point, at);
        let mut damping = 0.0;
        let size = self.surface.domain().size().length();
        for _ in 0..MAX_STEPS {
            let next = self.surface.nearest_in_domain(at + here.step(damping));
            if !((next - at).length() > SHORTEST_STEP * size) {
                break;
            }
            let there = self.local(point, next);
            let is_allowed = !keeps_trims || self.surface.region().trims.contains(next);
            if is_allowed && there.distance_sq < here.distance_sq {
                (at, here) = (next, there);
                damping /= 16.0;
            } else {
                damping = if damping == 0.0 { FIRST_DAMPING } else { 8.0 * damping };
                if damping > MOST_DAMPING {
                    break;
                }
            }
        }
        (at, here.distance_sq.sqrt())
    }

    fn local(&self, point: DVec3, uv: DVec2) -> Local {
        let mut rows = [0.0; 18];
        self.surface.eval_rows(&[uv], 2, &mut rows);
        let [s, su, sv, suu, suv, svv] = [0, 3, 6, 9, 12, 15].map(|k| DVec3::from_slice(&rows[k..]));
        let r = s - point;
        let metric = Symmetric2::of_products(su, sv);
        Local {
            distance_sq: r.length_squared(),
            slope: DVec2::new(r.dot(su), r.dot(sv)),
            metric,
            hessian: metric + Symmetric2 { uu: r.dot(suu), uv: r.dot(suv), vv: r.dot(svv) },
        }
    }
}

/// A determinant below this share of the product of its diagonal is rounding, and a step by it noise.
const PARALLEL: f64 = 1e-14;

/// Half the squared distance with its derivatives.
struct Local {
    distance_sq: f64,
    slope: DVec2,
    metric: Symmetric2,
    hessian: Symmetric2,
}

impl Local {
    /// The damped Newton step, with the metric alone where the Hessian is not positive.
    fn step(&self, damping: f64) -> DVec2 {
        let matrix = if self.hessian.is_positive() { self.hessian } else { self.metric };
        let matrix = matrix.shifted(damping * self.metric.trace());
        if matrix.is_within(PARALLEL) {
            // parallel tangents: straight down
            return -self.slope / matrix.trace().max(f64::MIN_POSITIVE);
        }
        matrix.solve(-self.slope)
    }
}
