//! Closest points: the globally nearest point of a surface, by branch and bound over its Bezier patches.
//!
//! A hierarchy of boxes around the patches' ordinates bounds the distance from below; on a single patch the
//! squared distance is itself a polynomial, and its Bernstein coefficients bound it and show where it is convex
//! (after T. W. Sederberg and R. J. Meyers, "Loop detection in surface patch intersections", Comput. Aided Geom.
//! Des. 5 (1988), 161-171, and Y.-J. Chen et al., "Computing the minimum distance between a point and a clamped
//! B-spline surface", Graphical Models 71 (2009), 107-112). Newton's method is used where it cannot fail: on
//! convex cells; all others are halved. Boundaries, poles, folds and sheets that cross need no care of their own.
//!
//! Surfaces over triangles go another way (`facets`).
//!
//! With trims the nearest point lies inside them or on them: the lines of the trims are curves on patches and are
//! searched alike, and minima outside do not count.

mod cells;
mod facets;
mod foot;
mod index;
mod kernel;
mod search;
#[cfg(test)]
mod tests;

use super::tessellate::TessellateError;
use crate::bezier::BezierPatch;
use crate::control::{Cancelled, Pool};
use crate::curve::Curve;
use crate::failure::{Classify, ErrorKind};
use crate::geometry::{Bounds, Domain};
use crate::surface::{Kind, Surface, Trims};
use cells::{curve_cells, surface_cells, trim_pieces};
use facets::FacetProjector;
use glam::{DVec2, DVec3};
use index::{Index, Place};
use rayon::prelude::*;
use search::{Best, Search, Workspace};

/// How to project.
#[derive(Debug, Clone, Copy)]
pub struct ProjectOptions<'a> {
    /// A (u,v) near the answer for each point. It saves time and may choose between equally near points; the
    /// answer is the global one all the same.
    pub guesses: Option<&'a [DVec2]>,
    /// Points farther away get NaN. Default: infinity.
    pub max_distance: f64,
    /// Whether only the part of the surface inside its trims counts. Default: yes.
    pub keep_trims: bool,
}

impl Default for ProjectOptions<'_> {
    fn default() -> Self {
        Self { guesses: None, max_distance: f64::INFINITY, keep_trims: true }
    }
}

/// Points cannot be projected.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ProjectError {
    /// The family has no Bezier patches.
    #[error("a surface of kind {kind:?} has no Bezier patches to project onto")]
    NoPatches {
        /// The family.
        kind: Kind,
    },
    /// The surface has no tessellation to start from.
    #[error(transparent)]
    Tessellate(#[from] TessellateError),
    /// Arrays do not fit together.
    #[error("{count} numbers are given for {what}, {expected} are needed")]
    Count {
        /// The array.
        what: &'static str,
        /// Numbers given.
        count: usize,
        /// Numbers needed.
        expected: usize,
    },
    /// A coordinate of a point is NaN or infinite.
    #[error("point {index} is not finite")]
    NotFinite {
        /// The point.
        index: usize,
    },
    /// A first guess is NaN or infinite.
    #[error("the first guess for point {index} is not finite")]
    GuessNotFinite {
        /// The point.
        index: usize,
    },
    /// The largest distance is negative or NaN.
    #[error("the largest distance is {value}, it must not be negative")]
    MaxDistance {
        /// The distance given.
        value: f64,
    },
    /// The caller asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl Classify for ProjectError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::NoPatches { .. } => ErrorKind::WrongKind,
            Self::Tessellate(error) => error.kind(),
            Self::Count { .. } | Self::MaxDistance { .. } => ErrorKind::InvalidArgument,
            Self::NotFinite { .. } | Self::GuessNotFinite { .. } => ErrorKind::NotFinite,
            Self::Cancelled(_) => ErrorKind::Cancelled,
        }
    }

    /// The offending point.
    fn index(&self) -> Option<usize> {
        match *self {
            Self::NotFinite { index } | Self::GuessNotFinite { index } => Some(index),
            _ => None,
        }
    }
}

/// Projects points onto one surface or curve. It holds all it needs of that, as it was when this was made.
#[derive(Debug, Clone)]
pub struct Projector {
    dim: usize,
    domain: Domain,
    index: Index,
    trims: Trims,
    trim_index: Index,
    /// Differences of distance below this do not count: roundoff of the coordinates.
    tolerance: f64,
    /// Of a surface over triangles, which has no patches; the index is then empty.
    facets: Option<FacetProjector>,
}

/// Relative to the surface's size: a cell that cannot hold a place nearer by more than this is not searched.
const DISTANCE_TOLERANCE: f64 = 1e-12;
/// Points of one piece of work. Pieces do not depend on the number of threads.
const CHUNK: usize = 256;

/// The pieces of work that so many points are: no more threads are of use.
pub fn piece_count(count: usize) -> usize {
    count.div_ceil(CHUNK)
}

impl Projector {
    /// Builds the hierarchy: time and memory are proportional to the number of patches.
    pub fn new(surface: &dyn Surface) -> Result<Self, ProjectError> {
        let Some(patches) = surface.patches() else {
            return Self::of_facets(surface);
        };
        let trims = &surface.region().trims;
        let trim_index = Index::new(trim_pieces(patches, trims));
        Ok(Self {
            trim_index,
            trims: trims.clone(),
            ..Self::over(surface_cells(patches), surface.dim(), surface.domain())
        })
    }

    /// Onto a curve: its parameter is the u of the answers, their v means nothing. It has no trims.
    pub fn of_curve(curve: &Curve) -> Self {
        let (from, to) = curve.knots().domain();
        let domain = Domain { min: DVec2::new(from, 0.0), max: DVec2::new(to, 1.0) };
        Self::over(curve_cells(curve), curve.dim(), domain)
    }

    fn over(cells: Vec<(BezierPatch, Place)>, dim: usize, domain: Domain) -> Self {
        let corners: Vec<f64> = cells
            .iter()
            .flat_map(|(cell, _)| {
                let Bounds { min, max } = cell.bounds();
                min.into_iter().chain(max)
            })
            .collect();
        let bounds = Bounds::of_rows(&corners, dim);
        let largest = bounds.min.iter().chain(&bounds.max).fold(0.0, |most: f64, x| most.max(x.abs()));
        Self {
            dim,
            domain,
            index: Index::new(cells),
            trim_index: Index::new(Vec::new()),
            trims: Trims::default(),
            facets: None,
            tolerance: DISTANCE_TOLERANCE * bounds.diagonal() + 4.0 * f64::EPSILON * largest,
        }
    }

    fn of_facets(surface: &dyn Surface) -> Result<Self, ProjectError> {
        let facets = surface.facets().filter(|_| surface.dim() == 3);
        let facets = facets.ok_or(ProjectError::NoPatches { kind: surface.kind() })?;
        Ok(Self {
            dim: surface.dim(),
            domain: surface.domain(),
            index: Index::new(Vec::new()),
            trim_index: Index::new(Vec::new()),
            trims: surface.region().trims.clone(),
            facets: Some(FacetProjector::new(facets)?),
            tolerance: 0.0,
        })
    }

    /// The nearest place for each row of `points`: its (u,v), and the distance. Returns how many points are
    /// farther than [`ProjectOptions::max_distance`]; these get NaN.
    ///
    /// The result for a point depends on nothing but the point, its guess and the options.
    pub fn project(
        &self,
        points: &[f64],
        options: &ProjectOptions,
        out_uv: &mut [DVec2],
        out_distances: &mut [f64],
        pool: &Pool,
    ) -> Result<usize, ProjectError> {
        let count = points.len() / self.dim;
        self.check(points, options, out_uv.len(), out_distances.len())?;
        let guess = |index: usize| options.guesses.map(|guesses| guesses[index]);
        let piece = |chunk: usize, uv: &mut [DVec2], distances: &mut [f64]| {
            let mut workspace = Workspace::default();
            let mut missed = 0;
            if pool.check().is_err() {
                return missed;
            }
            // all that is inlined here uses the wide registers that the processor has
            pulp::Arch::new().dispatch(
                #[inline(always)]
                || {
                    for (k, (uv, distance)) in uv.iter_mut().zip(&mut *distances).enumerate() {
                        let i = chunk * CHUNK + k;
                        let point = &points[i * self.dim..][..self.dim];
                        (*uv, *distance) = self.nearest(point, guess(i), options, &mut workspace);
                        missed += usize::from(distance.is_nan());
                    }
                },
            );
            missed
        };
        if pool.thread_count() == 1 || count <= CHUNK {
            let chunks = out_uv.chunks_mut(CHUNK).zip(out_distances.chunks_mut(CHUNK));
            let missed = chunks.enumerate().map(|(k, (uv, distances))| piece(k, uv, distances)).sum();
            return Ok(pool.check().map(|()| missed)?);
        }
        let missed = pool.run(|| {
            let chunks = out_uv.par_chunks_mut(CHUNK).zip(out_distances.par_chunks_mut(CHUNK));
            chunks.enumerate().map(|(k, (uv, distances))| piece(k, uv, distances)).sum()
        });
        Ok(pool.check().map(|()| missed)?)
    }

    fn check(
        &self,
        points: &[f64],
        options: &ProjectOptions,
        uv_count: usize,
        distance_count: usize,
    ) -> Result<(), ProjectError> {
        let count = points.len() / self.dim;
        let guess_count = options.guesses.map_or(count, <[DVec2]>::len);
        for (what, given, expected) in [
            ("the points", points.len(), count * self.dim),
            ("the parameters", uv_count, count),
            ("the distances", distance_count, count),
            ("the first guesses", guess_count, count),
        ] {
            if given != expected {
                return Err(ProjectError::Count { what, count: given, expected });
            }
        }
        if options.max_distance.is_nan() || options.max_distance < 0.0 {
            return Err(ProjectError::MaxDistance { value: options.max_distance });
        }
        if let Some(index) = points.iter().position(|x| !x.is_finite()) {
            return Err(ProjectError::NotFinite { index: index / self.dim });
        }
        match options.guesses.and_then(|guesses| guesses.iter().position(|guess| !guess.is_finite())) {
            Some(index) => Err(ProjectError::GuessNotFinite { index }),
            None => Ok(()),
        }
    }

    #[inline(always)]
    fn nearest(
        &self,
        point: &[f64],
        guess: Option<DVec2>,
        options: &ProjectOptions,
        workspace: &mut Workspace,
    ) -> (DVec2, f64) {
        if let Some(facets) = &self.facets {
            return facets.nearest(DVec3::from_slice(point), guess, options);
        }
        // a little farther, so that a point right at the limit is found
        let farthest = options.max_distance * (1.0 + 4.0 * f64::EPSILON) + 2.0 * self.tolerance;
        let mut search = Search {
            point,
            tolerance: self.tolerance,
            best: Best::new(farthest * farthest, DVec2::NAN, self.tolerance),
            trims: None,
            workspace,
        };
        if options.keep_trims && !self.trims.is_empty() {
            search.run(&self.trim_index);
            search.trims = Some(&self.trims);
        }
        if let Some((leaf, at)) = guess.and_then(|uv| self.index.leaf_at(self.domain.clamp(uv))) {
            search.try_leaf(&self.index, leaf, at);
        }
        search.run(&self.index);
        let distance = search.best.distance_sq.sqrt();
        if distance <= options.max_distance && !search.best.uv.is_nan() {
            (search.best.uv, distance)
        } else {
            (DVec2::NAN, f64::NAN)
        }
    }
}
