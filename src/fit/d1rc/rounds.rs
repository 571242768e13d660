//! The rounds of a fit: control mesh, then sweeps of least squares, measuring, and foot points.

use super::least_squares::{Energy, Samples, solve};
use super::placement::Placement;
use super::{D1rcFit, D1rcFitError, D1rcFitOptions};
use crate::control::{Control, Pool, Watch};
use crate::fit::common::checks::check_parameters;
use crate::fit::common::errors::{DataErrors, data_errors};
use crate::fit::common::foot_points::{LONGEST_STEP, foot_points, hold_back};
use crate::fit::common::interior::MeshData;
use crate::fit::common::report::{FitReport, Goal, Remarks, StopReason};
use crate::fit::common::rounds::{self, Next, Outcome, Rounds, Standing};
use crate::fit::common::{FitError, Frame, Standards, node_parameters, prefer_plane};
use crate::geometry::Bounds;
use crate::memory::{self, CollectVec};
use crate::mesh::{DecimateOptions, Mesh};
use crate::parameterize::{ParameterizeOptions, parameterize};
use crate::surface::Surface;
use crate::surface::d1rc::D1rcSurface;
use glam::DVec2;

/// Vertices of the first control mesh.
const FIRST_COUNT: usize = 100;
/// A control mesh has at least and at most so many times the vertices of the one before. Errors of smooth shapes fall
/// with the square of the count; those of features that a coarse mesh cannot hold fall slowly at first.
const GROWTH: (f64, f64) = (1.4, 4.0);
/// So many rounds in a row that do not lower the error by a tenth end the fit.
const IDLE_ROUNDS: usize = 4;
/// Smallest share of its area that a triangle of the mesh keeps in the parameter plane when its nodes move.
const LEAST_AREA: f64 = 0.3;
/// A sweep multiplies the weight of a node by at most this; more makes the largest error jump from node to node.
const MOST_STRESS: f64 = 4.0;

/// Where control meshes come from.
pub(super) enum Source {
    /// One that was given, with its sharp edges.
    Given { coarse: Mesh, sharp_edges: Vec<[u32; 2]> },
    /// The mesh with its parameters and sharp edges, to be made coarser.
    Made { fine: Mesh, sharp_edges: Vec<[u32; 2]>, remarks: Remarks },
}

impl Source {
    pub(super) fn new(
        mesh: &Mesh,
        options: &D1rcFitOptions,
        control: &mut Control,
    ) -> Result<Self, D1rcFitError> {
        let sharp_edges_of = |mesh: &Mesh| {
            let mut known: Vec<[u32; 2]> =
                options.sharp_edges.iter().map(|&[a, b]| [a.min(b), a.max(b)]).collect_vec();
            known.sort_unstable();
            let mut found = options.sharp_angle.map(|angle| mesh.sharp_edges(angle)).unwrap_or_default();
            found.retain(|edge| known.binary_search(edge).is_err());
            // those given come first: errors tell their places
            options.sharp_edges.iter().copied().chain(found).collect_vec()
        };
        if let Some(given) = options.control_mesh {
            let mut coarse = given.clone();
            if given.parameters().is_none() {
                // a control mesh is coarse, and its map is no start for anything: the least stretch is best
                let is_usual = options.parameterize == D1rcFitOptions::default().parameterize;
                let map_options =
                    if is_usual { ParameterizeOptions::default() } else { options.parameterize };
                let map = control.without_error(|control| parameterize(given, &map_options, control));
                let uv = map.map_err(D1rcFitError::ControlMesh)?.uv;
                coarse.set_parameters(uv).map_err(|_| FitError::Singular)?;
            }
            let sharp_edges = sharp_edges_of(given);
            return Ok(Self::Given { coarse, sharp_edges });
        }
        let mut map = node_parameters(mesh, &options.parameterize, options.regularize, control)?;
        if mesh.parameters().is_none() && options.parameterize == D1rcFitOptions::default().parameterize {
            map = prefer_plane(mesh, map, control)?;
        }
        check_parameters(&map.uv)?;
        let mut fine = mesh.clone();
        fine.set_parameters(map.uv).map_err(|_| FitError::Singular)?;
        Ok(Self::Made { sharp_edges: sharp_edges_of(mesh), fine, remarks: map.remarks })
    }

    /// The control mesh with about so many vertices, and its sharp edges.
    fn control_mesh(
        &self,
        count: usize,
        control: &mut Control,
    ) -> Result<(Mesh, Vec<[u32; 2]>), D1rcFitError> {
        match self {
            Self::Given { coarse, sharp_edges } => Ok((coarse.clone(), sharp_edges.clone())),
            Self::Made { fine, sharp_edges, .. } => {
                let options =
                    DecimateOptions::default().with_target_count(count).with_sharp_edges(sharp_edges);
                let made = fine.decimate(&options, control)?;
                Ok((made.piece.mesh, made.sharp_edges))
            }
        }
    }

    fn place(&self, mesh: &Mesh, coarse: &Mesh, coarse_sharp: &[[u32; 2]], pool: &Pool) -> Placement {
        match self {
            Self::Given { .. } => Placement::in_space(mesh, coarse, pool),
            Self::Made { fine, sharp_edges, .. } => {
                Placement::in_plane(fine, coarse, (sharp_edges, coarse_sharp), pool)
            }
        }
    }
}

/// Data, what they are fitted with, and how far the fit has come.
pub(super) struct Problem<'a> {
    mesh: &'a Mesh,
    values: &'a [f64],
    /// Values in the frame.
    samples: Vec<f64>,
    weights: Vec<f64>,
    source: Source,
    options: &'a D1rcFitOptions<'a>,
    frame: Frame,
    goal: Goal,
    /// Vertices of the control mesh of the next round.
    count: usize,
}

/// Gives nodes with more than the usual error more weight in the next sweep.
///
/// C. Lawson, "Contributions to the theory of linear least maximum approximation" (1961): least squares whose weights
/// are multiplied by the errors approach the least largest error, which is what a tolerance bounds.
fn stress(weights: &mut [f64], errors: &DataErrors) {
    let factor =
        |error: f64| if errors.rms > 0.0 { (error / errors.rms).clamp(1.0, MOST_STRESS) } else { 1.0 };
    weights.iter_mut().zip(&errors.each).for_each(|(weight, &error)| *weight *= factor(error));
}

/// A surface, measured.
pub(super) struct Round {
    surface: D1rcSurface,
    coarse: Mesh,
    sharp_edges: Vec<[u32; 2]>,
    uv: Vec<DVec2>,
    errors: DataErrors,
}

impl Rounds for Problem<'_> {
    type Round = Round;
    type Error = D1rcFitError;

    const GAIN: f64 = 0.9;

    fn fit(&mut self, control: &mut Control) -> Result<Round, D1rcFitError> {
        let (coarse, sharp_edges) = self.source.control_mesh(self.count, control)?;
        control.watch(|pool, watch| self.fit_on(coarse, sharp_edges, pool, watch))?
    }

    fn may_go_on(&self, error: &D1rcFitError) -> bool {
        // another control mesh may do
        matches!(error, D1rcFitError::Surface(_))
    }

    fn error(&self, round: &Round) -> f64 {
        round.errors.max
    }

    fn tolerance(&self) -> f64 {
        self.goal.tolerance
    }

    fn refine(&mut self, standing: &Standing<Round>, _: &Control) -> Next {
        match self.next_count(self.count, standing.error, standing.idle) {
            Ok(count) => self.count = count,
            Err(stop) => return Next::Stop(stop),
        }
        Next::Round
    }
}

impl<'a> Problem<'a> {
    pub(super) fn new(
        mesh: &'a Mesh,
        values: &'a [f64],
        source: Source,
        options: &'a D1rcFitOptions<'a>,
    ) -> Self {
        let bounds = Bounds::of_rows(values, 3);
        let frame = Frame::new(&bounds);
        let weights = options.weights.map_or(memory::filled(1.0, mesh.points().len()), <[f64]>::to_vec);
        let (samples, goal) = (frame.inward(values), Goal::new(&options.tolerance, &bounds));
        let most = options.max_control_count.min(mesh.points().len());
        let count = if options.control_count > 0 { options.control_count } else { FIRST_COUNT.min(most) };
        Self { mesh, values, samples, weights, source, options, frame, goal, count }
    }

    pub(super) fn run(mut self, control: &mut Control) -> Result<D1rcFit, D1rcFitError> {
        let outcome = rounds::run(&mut self, control)?;
        Ok(self.finish(outcome, control))
    }

    /// How many vertices to try after a round with this error, or why there is no further round.
    fn next_count(&self, count: usize, error: f64, idle: usize) -> Result<usize, StopReason> {
        let most = self.options.max_control_count.min(self.mesh.points().len());
        if error <= self.goal.tolerance {
            Err(StopReason::ToleranceMet)
        } else if matches!(self.source, Source::Given { .. }) || self.options.control_count > 0 {
            Err(StopReason::FixedGrid)
        } else if count >= self.mesh.points().len() {
            Err(StopReason::DataExhausted)
        } else if count >= most {
            Err(StopReason::Limit)
        } else if idle >= IDLE_ROUNDS {
            Err(StopReason::Stagnated)
        } else {
            let growth = (error / self.goal.tolerance).sqrt().clamp(GROWTH.0, GROWTH.1);
            Ok(((count as f64 * growth) as usize).min(most))
        }
    }

    /// Fits on one control mesh.
    fn fit_on(
        &self,
        coarse: Mesh,
        sharp_edges: Vec<[u32; 2]>,
        pool: &Pool,
        watch: &Watch,
    ) -> Result<Round, D1rcFitError> {
        let mut surface = D1rcSurface::from_mesh(&coarse, &self.options.surface, &sharp_edges, &[])?;
        watch.check()?;
        let energy = Energy::new(&coarse, coarse.parameters().unwrap_or_default(), &sharp_edges);
        let placement = self.source.place(self.mesh, &coarse, &sharp_edges, pool);
        let (mut uv, mut weights) = (memory::copied(&placement.uv), memory::copied(&self.weights));
        let mut best: Option<(D1rcSurface, Vec<DVec2>, DataErrors)> = None;
        for sweep in 0..=self.options.correction_sweeps {
            if sweep > 0 {
                uv = self.moved(&surface, &placement, &uv, pool);
            }
            self.solve(&mut surface, &uv, &weights, &energy, pool, watch)?;
            let errors = data_errors(&surface, &uv, self.values, pool);
            stress(&mut weights, &errors);
            if best.as_ref().is_none_or(|(_, _, best)| errors.max < best.max) {
                best = Some((surface.clone(), memory::copied(&uv), errors));
            }
        }
        let (surface, uv, errors) = best.ok_or(FitError::Singular)?;
        Ok(Round { surface, coarse, sharp_edges, uv, errors })
    }

    fn solve(
        &self,
        surface: &mut D1rcSurface,
        uv: &[DVec2],
        weights: &[f64],
        energy: &Energy,
        pool: &Pool,
        watch: &Watch,
    ) -> Result<(), D1rcFitError> {
        let samples = Samples { uv, values: &self.samples, weights };
        let smoothing = self.options.smoothing * self.weights.iter().sum::<f64>();
        let solved = solve(surface, &samples, (energy, smoothing), pool, watch)?;
        let mut points = solved.ok_or(FitError::Singular)?;
        self.frame.outward(&mut points);
        let vertices: Vec<u32> = (0..surface.space().vertex_count() as u32).collect_vec();
        surface.set_control_points(&vertices, &points)?;
        Ok(())
    }

    /// Where the nodes go: towards their foot points, but no triangle folds and none leaves the domain.
    fn moved(&self, surface: &D1rcSurface, placement: &Placement, uv: &[DVec2], pool: &Pool) -> Vec<DVec2> {
        let size = surface.domain().size();
        let longest =
            DVec2::splat(LONGEST_STEP * (size.x * size.y / surface.coefficient_count() as f64).sqrt());
        let settle = |node, from, to| {
            let to = placement.settled(node, to);
            if surface.contains(to) { to } else { from }
        };
        let mut moved = foot_points(surface, self.values, uv, |_| longest, settle, pool);
        hold_back(self.mesh, (&placement.uv, LEAST_AREA), uv, &mut moved);
        moved
    }

    fn finish(self, outcome: Outcome<Round>, control: &Control) -> D1rcFit {
        let Outcome { best: Round { surface, coarse, sharp_edges, uv, errors }, stop, passes } = outcome;
        let data = MeshData { mesh: self.mesh, uv: &uv, values: self.values, is_shape: true };
        let mut report = FitReport {
            cell_count: surface.space().recipe.triangles.len(),
            coefficient_count: surface.coefficient_count(),
            smoothing: self.options.smoothing,
            ..FitReport::new(&errors, &self.goal, stop, passes)
        };
        report.add_interior(&data.interior_errors(&surface, &Standards::default(), control.pool()));
        let watch = control.pool().watch();
        // nodes on chains that the control mesh straightens lie upon one another: only the map itself can fold
        match &self.source {
            Source::Made { fine, remarks, .. } => {
                report.remarks.0 |= remarks.0;
                report.measure_map(fine, fine.parameters().unwrap_or_default(), watch);
            }
            Source::Given { coarse, .. } => {
                report.measure_map(coarse, coarse.parameters().unwrap_or_default(), watch);
            }
        }
        D1rcFit { surface, control_mesh: coarse, sharp_edges, report, parameters: uv, errors: errors.each }
    }
}
