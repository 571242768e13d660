//! The rounds of a fit: control mesh, then sweeps of least squares, measuring, and foot points.

use super::least_squares::{Energy, Samples, solve};
use super::placement::Placement;
use super::{D1rcFit, D1rcFitError, D1rcFitOptions};
use crate::control::{Control, Pool, Watch};
use crate::fit::common::checks::check_parameters;
use crate::fit::common::errors::{DataErrors, data_errors};
use crate::fit::common::foot_points::{LONGEST_STEP, STEPS, gauss_newton_step, hold_back};
use crate::fit::common::interior::MeshData;
use crate::fit::common::report::{FitReport, Remarks, StopReason};
use crate::fit::common::{FitError, Frame, node_parameters};
use crate::fit::pht::refine::fraction;
use crate::geometry::Bounds;
use crate::mesh::{DecimateOptions, Mesh};
use crate::parameterize::parameterize;
use crate::surface::Surface;
use crate::surface::d1rc::D1rcSurface;
use glam::DVec2;
use rayon::prelude::*;

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
pub enum Source {
    /// One that was given, with its sharp edges.
    Given { coarse: Mesh, sharp_edges: Vec<[u32; 2]> },
    /// The mesh with its parameters and sharp edges, to be made coarser.
    Made { fine: Mesh, sharp_edges: Vec<[u32; 2]>, remarks: Remarks },
}

impl Source {
    pub fn new(mesh: &Mesh, options: &D1rcFitOptions, control: &mut Control) -> Result<Self, D1rcFitError> {
        let sharp_edges_of = |mesh: &Mesh| {
            let mut known: Vec<[u32; 2]> =
                options.sharp_edges.iter().map(|&[a, b]| [a.min(b), a.max(b)]).collect();
            known.sort_unstable();
            let mut found = options.sharp_angle.map(|angle| mesh.sharp_edges(angle)).unwrap_or_default();
            found.retain(|edge| known.binary_search(edge).is_err());
            // those given come first: errors tell their places
            options.sharp_edges.iter().copied().chain(found).collect()
        };
        if let Some(given) = options.control_mesh {
            let mut coarse = given.clone();
            if given.parameters().is_none() {
                let map = parameterize(given, &options.parameterize, control);
                let uv = map.map_err(D1rcFitError::ControlMesh)?.uv;
                coarse.set_parameters(uv).map_err(|_| FitError::Singular)?;
            }
            let sharp_edges = sharp_edges_of(given);
            return Ok(Self::Given { coarse, sharp_edges });
        }
        let map = node_parameters(mesh, &options.parameterize, options.regularize, control)?;
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

/// Everything that stays the same from round to round.
pub struct Problem<'a> {
    mesh: &'a Mesh,
    values: &'a [f64],
    /// Values in the frame.
    samples: Vec<f64>,
    weights: Vec<f64>,
    source: Source,
    options: &'a D1rcFitOptions<'a>,
    frame: Frame,
    bounds: Bounds,
    /// The tolerance in model units, and whether it was raised.
    tolerance: (f64, bool),
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
struct Round {
    surface: D1rcSurface,
    coarse: Mesh,
    sharp_edges: Vec<[u32; 2]>,
    uv: Vec<DVec2>,
    errors: DataErrors,
}

impl<'a> Problem<'a> {
    pub fn new(mesh: &'a Mesh, values: &'a [f64], source: Source, options: &'a D1rcFitOptions<'a>) -> Self {
        let bounds = Bounds::of_rows(values, 3);
        let frame = Frame::new(&bounds);
        let weights = options.weights.map_or(vec![1.0; mesh.points().len()], <[f64]>::to_vec);
        let (samples, tolerance) = (frame.inward(values), options.tolerance.absolute(&bounds));
        Self { mesh, values, samples, weights, source, options, frame, bounds, tolerance }
    }

    pub fn run(self, control: &mut Control) -> Result<D1rcFit, D1rcFitError> {
        let (mut best, mut failure): (Option<Round>, _) = (None, None);
        let (mut passes, mut idle, mut first_error) = (0, 0, f64::NAN);
        let mut count = self.first_count();
        let stop = loop {
            passes += 1;
            let round = self.round(count, control);
            let error = match round {
                Ok(round) => {
                    let error = round.errors.max;
                    let before = best.as_ref().map_or(f64::INFINITY, |best| best.errors.max);
                    idle = if error > 0.9 * before { idle + 1 } else { 0 };
                    if error < before {
                        best = Some(round);
                    }
                    error
                }
                // another control mesh may do
                Err(D1rcFitError::Surface(error)) => {
                    failure = Some(error);
                    f64::INFINITY
                }
                Err(error) => return Err(error),
            };
            first_error = if first_error.is_finite() { first_error } else { error };
            control.report(fraction(first_error, error, self.tolerance.0), error)?;
            match self.next_count(count, error, idle) {
                Ok(next) => count = next,
                Err(stop) => break stop,
            }
        };
        match (best, failure) {
            (Some(best), _) => Ok(self.finish(best, stop, passes, control)),
            (None, Some(error)) => Err(error.into()),
            (None, None) => Err(FitError::Singular.into()),
        }
    }

    fn first_count(&self) -> usize {
        let most = self.options.max_control_count.min(self.mesh.points().len());
        if self.options.control_count > 0 { self.options.control_count } else { FIRST_COUNT.min(most) }
    }

    /// How many vertices to try after a round with this error, or why there is no further round.
    fn next_count(&self, count: usize, error: f64, idle: usize) -> Result<usize, StopReason> {
        let most = self.options.max_control_count.min(self.mesh.points().len());
        if error <= self.tolerance.0 {
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
            let growth = (error / self.tolerance.0).sqrt().clamp(GROWTH.0, GROWTH.1);
            Ok(((count as f64 * growth) as usize).min(most))
        }
    }

    fn round(&self, count: usize, control: &mut Control) -> Result<Round, D1rcFitError> {
        let (coarse, sharp_edges) = self.source.control_mesh(count, control)?;
        control.watch(|pool, watch| self.fit(coarse, sharp_edges, pool, watch))?
    }

    /// Fits on one control mesh.
    fn fit(
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
        let (mut uv, mut weights) = (placement.uv.clone(), self.weights.clone());
        let mut best: Option<(D1rcSurface, Vec<DVec2>, DataErrors)> = None;
        for sweep in 0..=self.options.correction_sweeps {
            if sweep > 0 {
                uv = self.foot_points(&surface, &placement, uv, pool);
            }
            self.solve(&mut surface, &uv, &weights, &energy, pool, watch)?;
            let errors = data_errors(&surface, &uv, self.values, pool);
            stress(&mut weights, &errors);
            if best.as_ref().is_none_or(|(_, _, best)| errors.max < best.max) {
                best = Some((surface.clone(), uv.clone(), errors));
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
        let vertices: Vec<u32> = (0..surface.space().vertex_count() as u32).collect();
        surface.set_control_points(&vertices, &points)?;
        Ok(())
    }

    /// Where the nodes go: towards their foot points, but no triangle folds and none leaves the domain.
    fn foot_points(
        &self,
        surface: &D1rcSurface,
        placement: &Placement,
        uv: Vec<DVec2>,
        pool: &Pool,
    ) -> Vec<DVec2> {
        let size = surface.domain().size();
        let longest =
            DVec2::splat(LONGEST_STEP * (size.x * size.y / surface.coefficient_count() as f64).sqrt());
        let mut moved = uv.clone();
        pool.run(|| {
            let nodes = moved.par_iter_mut().zip(self.values.par_chunks(3)).enumerate();
            nodes.with_min_len(256).for_each(|(node, (uv, value))| {
                let mut row = [0.0; 9];
                for _ in 0..STEPS {
                    surface.eval_rows(&[*uv], 1, &mut row);
                    let step = gauss_newton_step(&row, value).clamp(-longest, longest);
                    let to = placement.settled(node, *uv + step);
                    *uv = if surface.contains(to) { to } else { *uv };
                }
            })
        });
        hold_back(self.mesh.triangles(), (&placement.uv, LEAST_AREA), &uv, &mut moved);
        moved
    }

    fn finish(&self, best: Round, stop: StopReason, passes: usize, control: &Control) -> D1rcFit {
        let Round { surface, coarse, sharp_edges, uv, errors } = best;
        let data = MeshData { mesh: self.mesh, uv: &uv, values: self.values, is_shape: true };
        let interior = data.interior_errors(&surface, control.pool());
        let (tolerance, raised) = self.tolerance;
        let mut remarks = Remarks::default();
        remarks.add_if(errors.max > tolerance, Remarks::TOLERANCE_NOT_MET);
        remarks.add_if(stop == StopReason::Stagnated, Remarks::STAGNATED);
        remarks.add_if(raised, Remarks::TOLERANCE_RAISED);
        remarks.add_if(interior.max_excess > tolerance, Remarks::ROUGH_BETWEEN_NODES);
        let mut report = FitReport {
            max_error: errors.max,
            rms_error: errors.rms,
            mean_error: errors.mean,
            worst_index: errors.worst_index,
            tolerance,
            diagonal: self.bounds.diagonal(),
            max_interior_error: interior.max,
            facet_sagitta: interior.sagitta,
            max_distance: f64::NAN,
            cell_count: surface.space().recipe.triangles.len(),
            coefficient_count: surface.coefficient_count(),
            smoothing: self.options.smoothing,
            passes,
            stop,
            remarks,
            ..FitReport::default()
        };
        // nodes on chains that the control mesh straightens lie upon one another: only the map itself can fold
        match &self.source {
            Source::Made { fine, remarks, .. } => {
                report.remarks.0 |= remarks.0;
                report.measure_map(fine, fine.parameters().unwrap_or_default());
            }
            Source::Given { coarse, .. } => {
                report.measure_map(coarse, coarse.parameters().unwrap_or_default());
            }
        }
        D1rcFit { surface, control_mesh: coarse, sharp_edges, report, parameters: uv, errors: errors.each }
    }
}
