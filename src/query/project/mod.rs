//! Closest points: the globally nearest point of a surface, by branch and bound over its Bezier patches.
//!
//! A hierarchy of boxes around the patches' ordinates bounds the distance from below; on a single patch the
//! squared distance is itself a polynomial, and its Bernstein coefficients bound it and show where it is convex
//! (after T. W. Sederberg and R. J. Meyers, "Loop detection in surface patch intersections", Comput. Aided Geom.
//! Des. 5 (1988), 161-171, and Y.-J. Chen et al., "Computing the minimum distance between a point and a clamped
//! B-spline surface", Graphical Models 71 (2009), 107-112). Newton's method is used where it cannot fail: on
//! convex cells; all others are halved. Boundaries, poles, folds and sheets that cross need no care of their own.
//!
//! Surfacets over triangles go another way (`facets`), which proves nothing.
//!
//! With trims the nearest point lies inside them or on them. The lines of the trims are curves on patches and are
//! searched alike; of the surface, cells outside are never looked at, cells inside are searched as if there were no
//! trims, and a cell that a trim cuts either has its one minimum inside or nothing that the trim does not bound
//! (`inside`).

mod cells;
mod facets;
mod foot;
mod index;
mod inside;
mod kernel;
mod mesh;
mod search;
#[cfg(test)]
mod tests;

use super::tessellate::TessellateError;
use crate::bezier::BezierPatch;
use crate::control::{Cancelled, Pool};
use crate::curve::Curve;
use crate::failure::{Classify, ErrorKind};
use crate::geometry::{Bounds, Domain, safe_scale};
use crate::memory::{self, CollectVec};
use crate::options::with_fields;
use crate::surface::{Kind, Surface};
use cells::{curve_cells, surface_cells, trim_pieces};
use facets::FacetProjector;
use glam::{DVec2, DVec3};
use index::{Index, Place};
use inside::Inside;
use rayon::prelude::*;
use search::{Best, Search, Workspace};
use std::borrow::Cow;

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

impl<'a> ProjectOptions<'a> {
    with_fields! {
        with_guesses guesses: Option<&'a [DVec2]>,
        with_max_distance max_distance: f64,
        with_keep_trims keep_trims: bool,
    }

    /// Refuses points that are not finite, and distances that are none.
    pub(crate) fn check(&self, points: &[DVec3]) -> Result<(), ProjectError> {
        if self.max_distance.is_nan() || self.max_distance < 0.0 {
            return Err(ProjectError::MaxDistance { value: self.max_distance });
        }
        match points.iter().position(|point| !point.is_finite()) {
            Some(index) => Err(ProjectError::NotFinite { index }),
            None => Ok(()),
        }
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
    trimmed: Option<Trimmed>,
    /// What coordinates are multiplied by, so that products of distances are numbers.
    scale: f64,
    /// Differences of distance below this do not count: roundoff of the coordinates.
    tolerance: f64,
    /// Of a surface over triangles, which has no patches; the index is then empty.
    facets: Option<FacetProjector>,
}

/// The part of a surface inside its trims.
#[derive(Debug, Clone)]
struct Trimmed {
    inside: Inside,
    /// The trims as curves on the surface.
    lines: Index,
}

/// The nearest places of a number of points.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Projection {
    /// The (u,v) of each; NaN where there is none within the largest distance.
    pub uv: Vec<DVec2>,
    /// How far each is; NaN as well.
    pub distances: Vec<f64>,
    /// The `FLAG_` bits that hold for each.
    pub flags: Vec<u8>,
}

/// The search ended before it had proved that no other place is nearer: the distance is that of a place on the
/// surface, and the least one may be smaller.
pub const FLAG_NOT_PROVEN: u8 = 16;

impl Projection {
    /// How many points are farther than [`ProjectOptions::max_distance`].
    pub fn missed(&self) -> usize {
        self.distances.iter().filter(|distance| distance.is_nan()).count()
    }

    /// How many answers are not proved to be the nearest.
    pub fn unproven(&self) -> usize {
        self.flags.iter().filter(|&flags| flags & FLAG_NOT_PROVEN != 0).count()
    }
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
        let whole = Self::over(surface_cells(patches), surface.dim(), surface.domain());
        let trims = Some(&surface.region().trims).filter(|trims| !trims.is_empty());
        let trimmed = trims.map(|trims| Trimmed {
            inside: Inside::new(&whole.index, trims, &whole.domain),
            lines: Index::new(whole.scaled(trim_pieces(patches, trims))),
        });
        Ok(Self { trimmed, ..whole })
    }

    /// Onto a curve: its parameter is the u of the answers, their v means nothing. It has no trims.
    pub fn of_curve(curve: &Curve) -> Self {
        let (from, to) = curve.knots().domain();
        let domain = Domain { min: DVec2::new(from, 0.0), max: DVec2::new(to, 1.0) };
        Self::over(curve_cells(curve), curve.dim(), domain)
    }

    fn over(mut cells: Vec<(BezierPatch, Place)>, dim: usize, domain: Domain) -> Self {
        let corners: Vec<f64> = cells
            .iter()
            .flat_map(|(cell, _)| {
                let Bounds { min, max } = cell.bounds();
                min.into_iter().chain(max)
            })
            .collect_vec();
        let bounds = Bounds::of_rows(&corners, dim);
        let largest = bounds.min.iter().chain(&bounds.max).fold(0.0, |most: f64, x| most.max(x.abs()));
        let scale = safe_scale(largest);
        if scale != 1.0 {
            cells.iter_mut().for_each(|(cell, _)| scale_values(cell, scale));
        }
        Self {
            dim,
            domain,
            index: Index::new(cells),
            trimmed: None,
            facets: None,
            tolerance: scale * (DISTANCE_TOLERANCE * bounds.diagonal() + 4.0 * f64::EPSILON * largest),
            scale,
        }
    }

    fn scaled(&self, mut cells: Vec<(BezierPatch, Place)>) -> Vec<(BezierPatch, Place)> {
        cells.iter_mut().for_each(|(cell, _)| scale_values(cell, self.scale));
        cells
    }

    fn of_facets(surface: &dyn Surface) -> Result<Self, ProjectError> {
        let facets = surface.facets().filter(|_| surface.dim() == 3);
        let facets = facets.ok_or(ProjectError::NoPatches { kind: surface.kind() })?;
        let facets = FacetProjector::new(facets)?;
        Ok(Self {
            dim: surface.dim(),
            domain: surface.domain(),
            index: Index::new(Vec::new()),
            trimmed: None,
            scale: 1.0,
            tolerance: DISTANCE_TOLERANCE * facets.diagonal(),
            facets: Some(facets),
        })
    }

    /// The nearest place for each row of `points`.
    ///
    /// The result for a point depends on nothing but the point, its guess and the options.
    pub fn project(
        &self,
        points: &[f64],
        options: &ProjectOptions,
        pool: &Pool,
    ) -> Result<Projection, ProjectError> {
        let count = points.len() / self.dim;
        self.check(points, options)?;
        let points: Cow<[f64]> = match self.scale {
            1.0 => points.into(),
            scale => points.iter().map(|x| x * scale).collect_vec().into(),
        };
        let options = &ProjectOptions { max_distance: options.max_distance * self.scale, ..*options };
        let mut all = Projection {
            uv: memory::filled(DVec2::NAN, count),
            distances: memory::filled(f64::NAN, count),
            flags: memory::filled(0, count),
        };
        let guess = |index: usize| options.guesses.map(|guesses| guesses[index]);
        let piece = |chunk: usize, ((uv, distances), flags): Piece| {
            let mut workspace = Workspace::default();
            if pool.check().is_err() {
                return;
            }
            // all that is inlined here uses the wide registers that the processor has
            pulp::Arch::new().dispatch(
                #[inline(always)]
                || {
                    for (k, uv) in uv.iter_mut().enumerate() {
                        let i = chunk * CHUNK + k;
                        let point = &points[i * self.dim..][..self.dim];
                        let nearest = self.nearest(point, guess(i), options, &mut workspace);
                        *uv = nearest.uv;
                        distances[k] = nearest.distance;
                        flags[k] = if nearest.is_proven { 0 } else { FLAG_NOT_PROVEN };
                    }
                },
            );
        };
        if pool.thread_count() == 1 || count <= CHUNK {
            let places = all.uv.chunks_mut(CHUNK).zip(all.distances.chunks_mut(CHUNK));
            places.zip(all.flags.chunks_mut(CHUNK)).enumerate().for_each(|(k, out)| piece(k, out));
        } else {
            pool.run(|| {
                let places = all.uv.par_chunks_mut(CHUNK).zip(all.distances.par_chunks_mut(CHUNK));
                places.zip(all.flags.par_chunks_mut(CHUNK)).enumerate().for_each(|(k, out)| piece(k, out));
            });
        }
        pool.check()?;
        if self.scale != 1.0 {
            all.distances.iter_mut().for_each(|distance| *distance /= self.scale);
        }
        Ok(all)
    }

    fn check(&self, points: &[f64], options: &ProjectOptions) -> Result<(), ProjectError> {
        let count = points.len() / self.dim;
        let guess_count = options.guesses.map_or(count, <[DVec2]>::len);
        for (what, given, expected) in
            [("the points", points.len(), count * self.dim), ("the first guesses", guess_count, count)]
        {
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
    ) -> Nearest {
        if let Some(facets) = &self.facets {
            let (uv, distance) = facets.nearest(DVec3::from_slice(point), guess, options);
            // a local minimum; only where it is nothing can no other be less
            return Nearest { uv, distance, is_proven: distance <= self.tolerance };
        }
        // a little farther, so that a point right at the limit is found
        let farthest = options.max_distance * (1.0 + 4.0 * f64::EPSILON) + 2.0 * self.tolerance;
        let mut search = Search {
            point,
            tolerance: self.tolerance,
            best: Best::new(farthest * farthest, DVec2::NAN, self.tolerance),
            inside: None,
            started: None,
            is_proven: true,
            workspace,
        };
        let guess = guess.and_then(|uv| self.index.leaf_at(self.domain.clamp(uv)));
        match self.trimmed.as_ref().filter(|_| options.keep_trims) {
            Some(trimmed) => self.search_trimmed(&mut search, trimmed, guess),
            None => {
                if let Some((leaf, at)) = guess {
                    search.try_leaf(&self.index, leaf, at);
                }
                search.run(&self.index);
            }
        }
        let (distance, is_proven) = (search.best.distance_sq.sqrt(), search.is_proven);
        if distance <= options.max_distance && !search.best.uv.is_nan() {
            Nearest { uv: search.best.uv, distance, is_proven }
        } else {
            Nearest { uv: DVec2::NAN, distance: f64::NAN, is_proven }
        }
    }

    /// The trims as curves, and what is inside them. What is nearer by a first glance is searched first, and
    /// bounds the other.
    #[inline(always)]
    fn search_trimmed<'a>(
        &self,
        search: &mut Search<'a>,
        Trimmed { inside, lines }: &'a Trimmed,
        guess: Option<(usize, [f64; 2])>,
    ) {
        search.sample(lines);
        let on_trim_sq = search.best.distance_sq;
        search.inside = Some(inside);
        match guess {
            Some((leaf, at)) => search.try_leaf(&self.index, leaf, at),
            None => search.sample(&self.index),
        }
        let trims_first = search.best.distance_sq >= on_trim_sq;
        for are_trims in [trims_first, !trims_first] {
            search.inside = if are_trims { None } else { Some(inside) };
            let started = if are_trims { search.started.take() } else { None };
            search.run(if are_trims { lines } else { &self.index });
            search.started = search.started.or(started);
        }
    }
}

/// Multiplies values, not weights.
fn scale_values(patch: &mut BezierPatch, scale: f64) {
    let (width, dim) = (patch.width(), patch.dim);
    patch.ordinates.chunks_exact_mut(width).flat_map(|row| &mut row[..dim]).for_each(|x| *x *= scale);
}

/// The answer for one point.
struct Nearest {
    uv: DVec2,
    distance: f64,
    is_proven: bool,
}

/// Where the answers of one piece of work go: parameters, distances, flags.
type Piece<'a> = ((&'a mut [DVec2], &'a mut [f64]), &'a mut [u8]);
