//! Fields and forces between meshes whose nodes do not match.
//!
//! A. de Boer, A. H. van Zuijlen, H. Bijl, "Review of coupling methods for non-matching meshes", Comput. Methods
//! Appl. Mech. Engrg. 196 (2007), 1515-1525: values go one way by a matrix whose rows sum to one (consistent), forces
//! the other way by its transpose (conservative). Here the matrix is the fit of a field on the source's nodes
//! ([`FieldFitter`]), evaluated where the target's nodes lie on the source's shape, which is the fit of its points:
//! ```text
//! T0 = E (N^T W N + (mu/12) energy)^-1 N^T W,      T = T0 (I - 1 w^T) + 1 w^T
//! ```
//! N are the basis functions at the source's data, E those at the target's foot points; w are equal shares that sum
//! to one. T0 keeps constants up to the roundoff of the solution, T exactly: the sum of `T^T g` is that of `g`.
//! Positions go the same way, so the moment of `T^T g` differs from that of `g` by no more than the sum of
//! `|g_i|` times the target's distances to the shape.

mod balance;
mod error;
#[cfg(test)]
mod tests;

pub use balance::{Balance, Carry};
pub use error::TransferError;

use super::right_side::{Data, RightSide, Scratch};
use super::{FieldError, FieldFitter, FieldOptions};
use crate::control::{Control, Pool, Stage};
use crate::fit::common::FitError;
use crate::fit::common::checks::check_rows;
use crate::fit::common::report::{FitReport, ToleranceScale};
use crate::linalg::Cholesky;
use crate::memory::{self, CollectVec};
use crate::mesh::Mesh;
use crate::options::with_fields;
use crate::query::project::{ProjectOptions, Projector};
use crate::summary::{sum, summarize};
use crate::surface::tensor::TensorSurface;
use glam::{DVec2, DVec3};
use std::time::Instant;

/// What happens to targets beyond the limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum FarRule {
    /// The first of them is an error.
    #[default]
    Refuse,
    /// They are counted, and take part like all others.
    Keep,
}

/// Options of transfers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TransferOptions<'a> {
    /// How fields on the source are fitted: the grid, which nodes have values, their weights.
    pub field: FieldOptions<'a>,
    /// How far from the source's shape a target may lie; infinity for anywhere.
    pub max_distance: f64,
    /// What `max_distance` is measured in: the diagonal of the source's points, or model units.
    pub distance_scale: ToleranceScale,
    /// What happens to targets farther away.
    pub far: FarRule,
}

impl Default for TransferOptions<'_> {
    fn default() -> Self {
        Self {
            field: FieldOptions::default(),
            max_distance: 0.05,
            distance_scale: ToleranceScale::Relative,
            far: FarRule::Refuse,
        }
    }
}

impl<'a> TransferOptions<'a> {
    with_fields! {
        with_field field: FieldOptions<'a>,
        with_max_distance max_distance: f64,
        with_distance_scale distance_scale: ToleranceScale,
        with_far far: FarRule,
    }

    /// Checks the limit, and the targets.
    pub fn check(&self, targets: &[DVec3]) -> Result<(), TransferError> {
        let limit = self.max_distance;
        if !(limit >= 0.0) {
            return Err(TransferError::MaxDistance { value: limit });
        }
        match targets.iter().position(|point| !point.is_finite()) {
            Some(index) => Err(TransferError::NotFinite { index }),
            None => Ok(()),
        }
    }
}

/// How well the meshes lie on one another.
#[derive(Debug, Clone, PartialEq)]
pub struct TransferReport {
    /// The fit of the source's points, over which the targets are projected.
    pub shape: FitReport,
    /// The largest distance of a target to the shape.
    pub max_distance: f64,
    /// Square root of the mean of its square.
    pub rms_distance: f64,
    /// The target with the largest distance.
    pub farthest_index: usize,
    /// The limit, in model units.
    pub limit: f64,
    /// Targets beyond it.
    pub far_count: usize,
    /// Seconds in all.
    pub seconds: f64,
}

/// Carries values from the nodes of one mesh to those of another, and forces back.
#[derive(Debug)]
pub struct Transfer {
    fitter: FieldFitter,
    shape: TensorSurface,
    source_points: Vec<DVec3>,
    target_points: Vec<DVec3>,
    parameters: Vec<DVec2>,
    distances: Vec<f64>,
    targets: RightSide,
}

/// Targets projected between two looks at the listener.
const PROJECTED_AT_ONCE: usize = 1 << 14;

impl Transfer {
    /// From the nodes of a mesh to any points near it.
    pub fn new(
        source: &Mesh,
        targets: &[DVec3],
        options: &TransferOptions,
        control: &mut Control,
    ) -> Result<(Self, TransferReport), TransferError> {
        options.check(targets)?;
        let start = Instant::now();
        let make = |control: &mut Control| FieldFitter::on_mesh(source, &options.field, control);
        let fitter = control.within(0.0, 0.5, make)?;
        let make = |control: &mut Control| Self::with_fitter(fitter, source, targets, options, control);
        let (transfer, mut report) = control.within(0.5, 1.0, make)?;
        report.seconds = start.elapsed().as_secs_f64();
        Ok((transfer, report))
    }

    /// The same with a fitter for fields on the source, in place of what `options` say of it.
    pub fn with_fitter(
        fitter: FieldFitter,
        source: &Mesh,
        targets: &[DVec3],
        options: &TransferOptions,
        control: &mut Control,
    ) -> Result<(Self, TransferReport), TransferError> {
        let shape = Shape::fit(source, targets, options, |positions| {
            let surface = fitter.fit(positions, 3)?;
            let report = fitter.measure(&surface, positions, 3)?.fit;
            Ok((surface, report))
        })?;
        let projector = Projector::new(&shape.surface)?;
        let mut parameters = Vec::new();
        let distances = project_in_pieces(targets, control, |points, pool| {
            let rows: Vec<f64> = points.iter().flat_map(|p| p.to_array()).collect_vec();
            let nearest = projector.project(&rows, &ProjectOptions::default(), pool)?;
            memory::extend(&mut parameters, nearest.uv);
            Ok(nearest.distances)
        })?;
        let (surface, distances, report) = shape.report(options, distances)?;
        let at_targets = Data::plain(&parameters);
        let targets_side = RightSide::new(fitter.basis(), at_targets, &fitter.pool);
        let transfer = Self {
            fitter,
            shape: surface,
            source_points: memory::copied(source.points()),
            target_points: memory::copied(targets),
            parameters,
            distances,
            targets: targets_side,
        };
        Ok((transfer, report))
    }

    /// The shape that the targets are projected onto.
    pub fn shape(&self) -> &TensorSurface {
        &self.shape
    }

    /// `T0` from the source to the targets, and its transpose from the targets to the source: the matrix between the
    /// two is symmetric.
    fn carry(
        &self,
        factor: &Cholesky,
        [from, to]: [&RightSide; 2],
        values: &[f64],
        scratch: &mut Scratch,
        out: &mut [f64],
    ) {
        let (basis, pool) = (self.fitter.basis(), &self.fitter.pool);
        from.assemble(values, scratch.dim, basis, scratch, pool);
        factor.solve_in(&mut scratch.columns, scratch.dim, &mut scratch.memory);
        to.transpose(basis, scratch, out, pool);
    }
}

impl Carry for Transfer {
    fn source_points(&self) -> &[DVec3] {
        &self.source_points
    }

    fn target_points(&self) -> &[DVec3] {
        &self.target_points
    }

    fn parameters(&self) -> Option<&[DVec2]> {
        Some(&self.parameters)
    }

    fn distances(&self) -> &[f64] {
        &self.distances
    }

    fn apply(&self, values: &[f64], dim: usize, out: &mut [f64]) -> Result<(), TransferError> {
        let solver = self.fitter.checked(values, dim)?;
        check_room("the values at the targets", out, self.target_count(), dim)?;
        solver.with_scratch(self.fitter.basis(), dim, |scratch| {
            let sources = &solver.right_side;
            let nodes = sources.nodes();
            let share = 1.0 / nodes.len() as f64;
            let at = |k: usize| nodes.iter().map(move |&node| values[node as usize * dim + k]);
            scratch.set_center((0..dim).map(|k| share * sum(at(k))));
            self.carry(&solver.factor, [sources, &self.targets], values, scratch, out);
            for row in out.chunks_exact_mut(dim) {
                row.iter_mut().zip(scratch.center()).for_each(|(x, c)| *x += c);
            }
        });
        Ok(())
    }

    fn apply_transpose(&self, forces: &[f64], dim: usize, out: &mut [f64]) -> Result<(), TransferError> {
        check_rows(self.target_count(), forces, dim)?;
        check_room("the forces at the nodes", out, self.source_count(), dim)?;
        let solver = &self.fitter.solver;
        solver.with_scratch(self.fitter.basis(), dim, |scratch| {
            let sources = &solver.right_side;
            scratch.set_center(std::iter::repeat_n(0.0, dim));
            self.carry(&solver.factor, [&self.targets, sources], forces, scratch, out);
            let nodes = sources.nodes();
            let share = 1.0 / nodes.len() as f64;
            for k in 0..dim {
                let given = sum(forces.iter().skip(k).step_by(dim).copied());
                let arrived = sum(out.iter().skip(k).step_by(dim).copied());
                nodes.iter().for_each(|&node| out[node as usize * dim + k] += share * (given - arrived));
            }
        });
        Ok(())
    }
}

/// The shape of the source that targets are projected onto: the fit of its points by the fitter of its fields.
pub(in crate::fit) struct Shape<S> {
    pub surface: S,
    report: FitReport,
    /// How far targets may lie from it, in model units.
    limit: f64,
    start: Instant,
}

impl<S> Shape<S> {
    /// `fit` fits and measures the points of the source, rows of three numbers.
    pub(crate) fn fit(
        source: &Mesh,
        targets: &[DVec3],
        options: &TransferOptions,
        fit: impl FnOnce(&[f64]) -> Result<(S, FitReport), FieldError>,
    ) -> Result<Self, TransferError> {
        let start = Instant::now();
        options.check(targets)?;
        let positions: Vec<f64> = source.points().iter().flat_map(|p| p.to_array()).collect_vec();
        let (surface, report) = fit(&positions)?;
        let limit = match options.distance_scale {
            ToleranceScale::Relative => options.max_distance * report.diagonal,
            ToleranceScale::Absolute => options.max_distance,
        };
        Ok(Self { surface, report, limit, start })
    }

    /// The surface, and what there is to say of the distances of the targets to it if they are allowed.
    pub(crate) fn report(
        self,
        options: &TransferOptions,
        distances: Vec<f64>,
    ) -> Result<(S, Vec<f64>, TransferReport), TransferError> {
        let Self { surface, report, limit, start } = self;
        let is_far = |&distance: &f64| distance > limit;
        if options.far == FarRule::Refuse
            && let Some(index) = distances.iter().position(is_far)
        {
            return Err(TransferError::Far { index, distance: distances[index], limit });
        }
        let far_count = distances.iter().filter(|distance| is_far(distance)).count();
        let summary = summarize(distances);
        let report = TransferReport {
            shape: report,
            max_distance: summary.max,
            rms_distance: summary.rms,
            farthest_index: summary.worst_index,
            limit,
            far_count,
            seconds: start.elapsed().as_secs_f64(),
        };
        Ok((surface, summary.each, report))
    }
}

/// The distances of targets, of which `project` finds those of some at a time.
pub(in crate::fit) fn project_in_pieces(
    targets: &[DVec3],
    control: &mut Control,
    mut project: impl FnMut(&[DVec3], &Pool) -> Result<Vec<f64>, TransferError>,
) -> Result<Vec<f64>, TransferError> {
    control.enter(Stage::Project);
    let mut distances = Vec::new();
    for points in targets.chunks(PROJECTED_AT_ONCE) {
        control.report(distances.len() as f64 / targets.len() as f64, f64::NAN)?;
        distances.extend(project(points, control.pool())?);
    }
    control.report(1.0, f64::NAN)?;
    Ok(distances)
}

pub(in crate::fit) fn check_room(
    what: &'static str,
    out: &[f64],
    count: usize,
    dim: usize,
) -> Result<(), FitError> {
    let expected = count.saturating_mul(dim);
    match out.len() {
        count if count == expected => Ok(()),
        count => Err(FitError::Count { what, count, expected }),
    }
}
