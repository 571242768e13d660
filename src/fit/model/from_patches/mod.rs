//! Patches that somebody else made as one smooth model.
//!
//! Tensor surfaces that meet edge to edge within a tolerance are joined into layouts. Points of each, spread
//! evenly over its parameters, are then what the smooth space over the layout is fitted to, with foot-point steps in which the
//! parameters slide (at vertices of other than four patches no smooth surface has the given ones) and cells that are split where
//! the deviation is above the tolerance. Position and tangent plane across all edges are those of the space: equal to
//! rounding whatever was given.

mod join;
#[cfg(test)]
mod tests;

use super::foot::{Ground, foot_points};
use super::least_squares::{System, Targets};
use super::locks::Lock;
use super::samples::ByCell;
use super::split::{LEAST_SAMPLES, SplitLimits, split_cells};
use crate::control::{Cancelled, Control, Pool, Watch};
use crate::failure::{Classify, ErrorKind};
use crate::fit::common::FitError;
use crate::fit::common::checks::{check_option, check_smoothing, check_tolerance};
use crate::fit::common::report::{Remarks, StopReason, Tolerance};
use crate::fit::common::rounds::{Next, Rounds, Standing, run};
use crate::geometry::{Bounds, Domain};
use crate::layout::{Layout, LayoutError, Place};
use crate::model::{Model, ModelError, Origin, PatchPiece, Patchwork, of_patches};
use crate::options::with_fields;
use crate::summary::summarize;
use crate::surface::g1::{Space, SpaceError, enclosed_volume, normal_jump, uniform};
use crate::surface::pht::PhtSurface;
use crate::surface::tensor::TensorSurface;
use crate::surface::{Patches, Surface};
use crate::tmesh::{TMesh, TMeshError};
use glam::{DVec2, DVec3};
use join::{Given, Joined, join};
use std::time::Instant;

/// How given patches become one smooth model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FromPatchesOptions {
    /// The largest deviation from the given surfaces.
    pub tolerance: Tolerance,
    /// Within what distance corners and sides meet.
    pub join_tolerance: Tolerance,
    /// Weight of the plate energy of each cell, mapped to the unit cell. Default 1e-6.
    pub smoothing: f64,
    /// Most cells of all patches of a piece, beside those that patches need to meet. Default 200000.
    pub max_cells: usize,
    /// Most rounds. Default 12.
    pub max_rounds: usize,
    /// By how much levels of cells in one face may differ. Default 1.
    pub level_spread: u32,
}

impl Default for FromPatchesOptions {
    fn default() -> Self {
        Self {
            tolerance: Tolerance::default(),
            join_tolerance: Tolerance::default(),
            smoothing: 1e-6,
            max_cells: 200_000,
            max_rounds: 12,
            level_spread: 1,
        }
    }
}

impl FromPatchesOptions {
    with_fields! {
        with_tolerance tolerance: Tolerance,
        with_join_tolerance join_tolerance: Tolerance,
        with_smoothing smoothing: f64,
        with_max_cells max_cells: usize,
        with_max_rounds max_rounds: usize,
        with_level_spread level_spread: u32,
    }
}

/// What became of given patches.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct FromPatchesReport {
    /// Largest distance of a place of a given surface from the model, at the place that the fit gave it.
    pub max_deviation: f64,
    /// Square root of the mean of its square.
    pub rms_deviation: f64,
    /// Its mean.
    pub mean_deviation: f64,
    /// The given patch that deviates most.
    pub worst_patch: usize,
    /// The tolerance in model units.
    pub tolerance: f64,
    /// Diagonal of the box around the given control points.
    pub diagonal: f64,
    /// Largest distance between given sides that were joined.
    pub given_gap: f64,
    /// Largest difference of unit normals across given sides that were joined.
    pub given_normal_jump: f64,
    /// Largest distance between the sides of an edge of the model.
    pub gap: f64,
    /// Largest difference of unit normals across edges of the model.
    pub normal_jump: f64,
    /// Enclosed by closed pieces.
    pub volume: f64,
    /// Edges of two patches.
    pub joined_count: usize,
    /// Edges of one patch.
    pub free_count: usize,
    /// Pieces: shells of the model.
    pub piece_count: usize,
    /// Control points, four a basis vertex and patch.
    pub coefficient_count: usize,
    /// Cells of all patches.
    pub cell_count: usize,
    /// Rounds of the piece that took most.
    pub passes: usize,
    /// Why the fit ended.
    pub stop: StopReason,
    /// Everything worth knowing.
    pub remarks: Remarks,
    /// Seconds in all.
    pub seconds: f64,
}

/// Given patches make no smooth model.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FromPatchesError {
    /// There is nothing.
    #[error("there are no patches")]
    Empty,
    /// A field bounds nothing.
    #[error("patch {patch} is of dimension {dim}, a patch in space is needed")]
    Dimension {
        /// The patch.
        patch: usize,
        /// Its dimension.
        dim: usize,
    },
    /// A trimmed surface has other sides than its domain.
    #[error("patch {patch} has trims, so its sides are not those of its domain")]
    Trimmed {
        /// The patch.
        patch: usize,
    },
    /// A side whose ends are one vertex.
    #[error(
        "the ends of side {side} of patch {patch} are within the tolerance of each other: a patch needs four sides"
    )]
    ShortSide {
        /// The patch.
        patch: usize,
        /// The side, 0 to 3.
        side: usize,
    },
    /// Opposite corners are one vertex.
    #[error("opposite corners of patch {patch} are within the tolerance of each other: split the patch")]
    MeetsItself {
        /// The patch.
        patch: usize,
    },
    /// An edge of three sides.
    #[error("side {side} of patch {patch} lies on an edge that has two patches already")]
    ThirdSide {
        /// The patch.
        patch: usize,
        /// The side, 0 to 3.
        side: usize,
    },
    /// Patches do not meet edge to edge.
    #[error(
        "a corner of patch {other} lies inside side {side} of patch {patch}: patches have to meet edge to edge, so \
         split that side there"
    )]
    CornerOnSide {
        /// The patch whose side is met.
        patch: usize,
        /// The side, 0 to 3.
        side: usize,
        /// The patch whose corner it is.
        other: usize,
        /// The vertex at the corner.
        vertex: u32,
    },
    /// No turning makes all patches look the same way.
    #[error("patch {patch} is on both sides of a one-sided surface")]
    OneSided {
        /// The patch.
        patch: usize,
    },
    /// The patches have no layout.
    #[error("the patches make no layout: {0}")]
    Layout(#[from] LayoutError),
    /// What every fit refuses.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// The smooth space cannot be built.
    #[error(transparent)]
    Space(#[from] SpaceError),
    /// Cells cannot be made.
    #[error(transparent)]
    TMesh(#[from] TMeshError),
    /// The patches make no model.
    #[error(transparent)]
    Model(#[from] ModelError),
}

impl From<Cancelled> for FromPatchesError {
    fn from(cancelled: Cancelled) -> Self {
        Self::Fit(FitError::Cancelled(cancelled))
    }
}

impl Classify for FromPatchesError {
    fn kind(&self) -> ErrorKind {
        match self {
            Self::Empty | Self::Dimension { .. } | Self::Trimmed { .. } => ErrorKind::InvalidArgument,
            Self::ShortSide { .. } => ErrorKind::Degenerate,
            Self::MeetsItself { .. }
            | Self::ThirdSide { .. }
            | Self::CornerOnSide { .. }
            | Self::OneSided { .. } => ErrorKind::Topology,
            Self::Layout(error) => error.kind(),
            Self::Fit(error) => error.kind(),
            Self::Space(error) => error.kind(),
            Self::TMesh(error) => error.kind(),
            Self::Model(error) => error.kind(),
        }
    }

    /// The offending patch.
    fn index(&self) -> Option<usize> {
        match *self {
            Self::Dimension { patch, .. }
            | Self::Trimmed { patch }
            | Self::ShortSide { patch, .. }
            | Self::MeetsItself { patch }
            | Self::ThirdSide { patch, .. }
            | Self::CornerOnSide { patch, .. }
            | Self::OneSided { patch } => Some(patch),
            _ => None,
        }
    }
}

/// Level of the cells to start from: vertices of four patches ask for two segments an edge.
const START_LEVEL: u32 = 2;
/// Samples along each direction of a patch for each of its spans.
const PER_SPAN: usize = 6;
/// Samples along each direction of a patch, at least and at most.
const SAMPLES: [usize; 2] = [32, 128];
/// Rounds in a row that gain nothing before a fit ends.
const MOST_IDLE: usize = 3;

/// Makes one smooth model of patches, and says how far it is from them.
pub fn smooth_from_patches(
    surfaces: &[&TensorSurface],
    options: &FromPatchesOptions,
    control: &mut Control,
) -> Result<(Model, FromPatchesReport), FromPatchesError> {
    let start = Instant::now();
    check(surfaces, options)?;
    let rows: Vec<f64> = surfaces.iter().flat_map(|surface| surface.control_points()).copied().collect();
    let bounds = Bounds::of_rows(&rows, 3);
    let (tolerance, is_raised) = options.tolerance.absolute(&bounds);
    let (join_tolerance, _) = options.join_tolerance.absolute(&bounds);
    let (pieces, seams) = join(surfaces, join_tolerance)?;
    let mut report = FromPatchesReport {
        tolerance,
        diagonal: bounds.diagonal(),
        given_gap: seams.gap,
        given_normal_jump: seams.normal_jump,
        joined_count: seams.count,
        piece_count: pieces.len(),
        ..FromPatchesReport::default()
    };
    let (mut deviations, mut patch_of_sample, mut smooth) = (Vec::new(), Vec::new(), Vec::new());
    let count = pieces.len() as f64;
    for (number, piece) in pieces.iter().enumerate() {
        let share = |number: usize| number as f64 / count;
        let outcome = control.within(share(number), share(number + 1), |control| {
            let mut fit = PieceFit::new(piece, options, tolerance)?;
            run(&mut fit, control).map(|outcome| (outcome, fit.patch_of_sample))
        });
        let (outcome, of_samples) = outcome?;
        let jump = normal_jump(&piece.layout, &outcome.best.surfaces)?;
        report.gap = report.gap.max(jump.gap);
        report.normal_jump = report.normal_jump.max(jump.normal);
        report.passes = report.passes.max(outcome.passes);
        report.free_count += piece.layout.edges().iter().filter(|edge| edge.second.is_none()).count();
        if piece.layout.edges().iter().all(|edge| edge.second.is_some()) {
            report.volume += enclosed_volume(&outcome.best.surfaces);
        }
        report.stop = if report.stop == StopReason::default() { outcome.stop } else { report.stop };
        report.remarks.add_if(outcome.stop == StopReason::Stagnated, Remarks::STAGNATED);
        deviations.extend(outcome.best.distances);
        patch_of_sample.extend(of_samples);
        smooth.push(outcome.best.surfaces);
    }
    let sizes = summarize(deviations);
    report.max_deviation = sizes.max;
    report.rms_deviation = sizes.rms;
    report.mean_deviation = sizes.mean;
    report.worst_patch = patch_of_sample[sizes.worst_index];
    report.coefficient_count = smooth.iter().flatten().map(PhtSurface::coefficient_count).sum();
    report.cell_count = smooth.iter().flatten().map(|surface| surface.mesh().leaf_count()).sum();
    report.remarks.add_if(sizes.max > tolerance, Remarks::TOLERANCE_NOT_MET);
    report.remarks.add_if(is_raised, Remarks::TOLERANCE_RAISED);
    let patchworks: Vec<Patchwork> = pieces
        .iter()
        .zip(&smooth)
        .map(|(piece, surfaces)| Patchwork {
            layout: &piece.layout,
            surfaces,
            planes: None,
            labels: &[],
            void_in: None,
        })
        .collect();
    let stitched = of_patches(&patchworks, options.level_spread)?;
    let origin = Origin {
        nodes: Vec::new(),
        pieces: patchworks
            .iter()
            .map(|piece| PatchPiece::new(piece.layout.clone(), piece.surfaces.iter().map(PhtSurface::mesh)))
            .collect(),
        patch_of_face: stitched.patch_of_face(),
    };
    let model = stitched.model.with_origin(origin)?;
    report.seconds = start.elapsed().as_secs_f64();
    Ok((model, report))
}

fn check(surfaces: &[&TensorSurface], options: &FromPatchesOptions) -> Result<(), FromPatchesError> {
    check_tolerance(&options.tolerance)?;
    check_tolerance(&options.join_tolerance)?;
    check_smoothing(options.smoothing, true)?;
    let (cells, rounds) = (options.max_cells, options.max_rounds);
    let first = surfaces.len().saturating_mul(1 << (2 * START_LEVEL));
    check_option(cells >= first, "max_cells", cells as f64, "at least 16 a patch")?;
    check_option(rounds >= 1, "max_rounds", rounds as f64, "at least 1")?;
    if surfaces.is_empty() {
        return Err(FromPatchesError::Empty);
    }
    for (patch, surface) in surfaces.iter().enumerate() {
        if surface.dim() != 3 {
            return Err(FromPatchesError::Dimension { patch, dim: surface.dim() });
        }
        if !surface.region().trims.is_empty() {
            return Err(FromPatchesError::Trimmed { patch });
        }
    }
    Ok(())
}

/// The fit of one piece in progress.
struct PieceFit<'a> {
    layout: &'a Layout,
    options: &'a FromPatchesOptions,
    tolerance: f64,
    meshes: Vec<TMesh>,
    places: Vec<Place>,
    points: Vec<DVec3>,
    patch_of_sample: Vec<usize>,
    /// By vertex: no sample is held.
    is_corner: Vec<bool>,
    rounds: usize,
}

/// One round.
struct Round {
    surfaces: Vec<PhtSurface>,
    distances: Vec<f64>,
    by_cell: ByCell,
    places: Vec<Place>,
}

impl<'a> PieceFit<'a> {
    fn new(
        piece: &'a Joined,
        options: &'a FromPatchesOptions,
        tolerance: f64,
    ) -> Result<Self, FromPatchesError> {
        let (mut places, mut points, mut patch_of_sample) = (Vec::new(), Vec::new(), Vec::new());
        for (quad, patch) in (0..).zip(&piece.patches) {
            for uv in sample_places(patch) {
                places.push(Place { quad, uv });
                points.push(patch.point(uv));
                patch_of_sample.push(patch.number);
            }
        }
        let meshes = uniform(&piece.layout, START_LEVEL)?;
        let layout = &piece.layout;
        let is_corner = vec![false; layout.vertex_count()];
        Ok(Self { layout, options, tolerance, meshes, places, points, patch_of_sample, is_corner, rounds: 0 })
    }

    fn round(&self, pool: &Pool, watch: &Watch) -> Result<Round, FromPatchesError> {
        let space = Space::new(self.layout, self.meshes.clone())?;
        let system = System::new(&space, pool);
        watch.check()?;
        let by_cell = ByCell::sort(&space, &self.places, pool);
        let targets = Targets {
            uv: self.places.iter().map(|place| place.uv).collect(),
            points: self.points.clone(),
            weights: vec![1.0; self.points.len()],
        };
        let energy = vec![self.options.smoothing; by_cell.cell_count()];
        let unknowns = system.solve(&targets, &by_cell, &energy, pool, watch)?;
        let surfaces = space.surfaces(&unknowns, 3).map_err(|_| FitError::Singular)?;
        let mut places = self.places.clone();
        let ground = Ground { layout: self.layout, surfaces: &surfaces, is_corner: &self.is_corner };
        let mut locks = vec![Lock::Free; places.len()];
        let distances = foot_points(ground, &mut places, &mut locks, &self.points, 1, pool);
        let by_cell = ByCell::sort(&space, &places, pool);
        Ok(Round { surfaces, distances, by_cell, places })
    }

    /// Splits the cells in which a sample misses the tolerance. Where none can be split the samples slide once more.
    fn split(&mut self, round: &Round) {
        let is_rough = |&sample: &u32| !(round.distances[sample as usize] <= self.tolerance);
        let is_to_split = |cell: usize, _: &Domain| {
            let samples = round.by_cell.of(cell);
            samples.len() >= LEAST_SAMPLES && samples.iter().any(is_rough)
        };
        let limits = SplitLimits { max_cells: self.options.max_cells, ..SplitLimits::default() };
        let _ = split_cells(self.layout, &mut self.meshes, limits, is_to_split);
    }
}

impl Rounds for PieceFit<'_> {
    type Round = Round;
    type Error = FromPatchesError;

    fn fit(&mut self, control: &mut Control) -> Result<Round, FromPatchesError> {
        self.rounds += 1;
        let round = control.watch(|pool, watch| self.round(pool, watch))??;
        self.places.clone_from(&round.places);
        Ok(round)
    }

    fn error(&self, round: &Round) -> f64 {
        round.distances.iter().copied().fold(0.0, f64::max)
    }

    fn tolerance(&self) -> f64 {
        self.tolerance
    }

    fn refine(&mut self, standing: &Standing<Round>, _: &Control) -> Next {
        let Some(round) = standing.round else { return Next::Stop(StopReason::Stagnated) };
        if standing.error <= self.tolerance {
            return Next::Done;
        }
        if self.rounds >= self.options.max_rounds {
            return Next::Stop(StopReason::Limit);
        }
        if standing.idle >= MOST_IDLE {
            return Next::Stop(StopReason::Stagnated);
        }
        self.split(round);
        Next::Round
    }
}

/// Places of the unit square at which a patch is looked at: a grid with its sides.
fn sample_places(patch: &Given) -> Vec<DVec2> {
    let spans = (patch.surface.patch_count() as f64).sqrt().ceil() as usize;
    let count = (PER_SPAN * spans).clamp(SAMPLES[0], SAMPLES[1]);
    let places = (0..(count + 1) * (count + 1)).map(|k| (k / (count + 1), k % (count + 1)));
    places.map(|(i, j)| DVec2::new(i as f64, j as f64) / count as f64).collect()
}
