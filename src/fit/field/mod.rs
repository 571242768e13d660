//! Fields on the nodes of one surface, fitted again and again.
//!
//! The least squares of [`super::tensor`] on a fixed grid are linear in the values:
//! ```text
//! (N^T W N + (mu/12) E) c = N^T W x
//! ```
//! [`FieldFitter`] factors the left side once. Each further field costs its right side, one solution, and, where
//! it is asked for, the measure of its errors.

mod error;
mod options;
mod right_side;
mod solver;
pub mod transfer;

pub use error::FieldError;
pub use options::{FieldGrid, FieldOptions};

use super::common::checks::check_parameters;
use super::common::errors::{DataErrors, data_errors};
use super::common::report::{FitReport, Goal, Remarks, StopReason, Tolerance};
use super::common::samples::{InteriorPlace, interior_places};
use super::common::uniform::grid::{UniformBasis, UniformGrid};
use super::common::uniform::normal_equations::TensorBasis;
use super::common::{FitError, NodeParameters, Regularize, node_parameters, trims};
use crate::control::{Control, Pool, Stage};
use crate::geometry::Bounds;
use crate::knots::KnotVector;
use crate::memory::{self, CollectVec};
use crate::mesh::Mesh;
use crate::surface::tensor::{Axis, TensorSurface};
use crate::surface::{Domain, Region, Surface};
use glam::DVec2;
use right_side::Scratch;
use solver::{Chosen, Partly, Parts, Solver};
use std::time::Instant;

/// Most knots along one direction of [`FieldGrid::Auto`].
const LARGEST_AUTO_GRID: usize = 129;
/// Nodes a coefficient of [`FieldGrid::Auto`]: with fewer the smoothing decides between the nodes.
const NODES_PER_COEFFICIENT: usize = 4;

/// Fits fields over the same parameters, grid and threads.
#[derive(Debug)]
pub struct FieldFitter {
    uv: Vec<DVec2>,
    parts: Parts,
    knots: [KnotVector; 2],
    region: Region,
    /// For fields with values at all nodes that may have some.
    solver: Solver,
    partly: Partly,
    tolerance: Tolerance,
    map_remarks: Remarks,
    pool: Pool,
}

/// Nodes over the parameter plane, for fields that are to be fitted on them.
#[derive(Debug)]
pub struct FieldNodes<'a> {
    mesh: Option<&'a Mesh>,
    map: NodeParameters,
}

impl<'a> FieldNodes<'a> {
    /// Those of a mesh, over its parameters or, if it has none, over those it is given here.
    pub fn of_mesh(
        mesh: &'a Mesh,
        options: &FieldOptions,
        control: &mut Control,
    ) -> Result<Self, FieldError> {
        let mut map = node_parameters(mesh, &options.parameterize, Regularize::Never, control)?;
        options.check(map.uv.len())?;
        // wherever unused nodes lie, it is not where the surface has to go
        let some_place = map.uv[mesh.triangles()[0][0] as usize];
        mesh.unused_nodes().iter().for_each(|&node| map.uv[node as usize] = some_place);
        Ok(Self { mesh: Some(mesh), map })
    }

    /// Which nodes have values, if there are unused ones among them: these have none.
    pub fn mask(&self, options: &FieldOptions) -> Option<Vec<bool>> {
        let mesh = self.mesh.filter(|mesh| !mesh.unused_nodes().is_empty())?;
        let is_known = |node: usize| options.is_known.is_none_or(|is_known| is_known[node]);
        Some((0..self.map.uv.len()).map(|node| mesh.is_used(node as u32) && is_known(node)).collect_vec())
    }

    /// Scattered ones.
    pub fn at(uv: &[DVec2], options: &FieldOptions) -> Result<Self, FieldError> {
        options.check(uv.len())?;
        Ok(Self { mesh: None, map: NodeParameters { uv: memory::copied(uv), remarks: Remarks::default() } })
    }

    /// The mesh, if its nodes have parameters of its own.
    pub fn mesh_with_parameters(&self) -> Option<&'a Mesh> {
        self.mesh.filter(|mesh| mesh.parameters().is_some())
    }

    /// The (u,v) of the nodes.
    pub fn parameters(&self) -> &[DVec2] {
        &self.map.uv
    }
}

/// A fitted field, measured.
#[derive(Debug, Clone)]
pub struct FieldReport {
    /// What every fit reports.
    pub fit: FitReport,
    /// The error of each node; NaN for nodes without values.
    pub errors: Vec<f64>,
}

impl FieldFitter {
    /// For fields on the nodes of a mesh, over its parameters or, if it has none, over those it is given here.
    pub fn on_mesh(mesh: &Mesh, options: &FieldOptions, control: &mut Control) -> Result<Self, FieldError> {
        let nodes = control.within(0.0, 0.3, |control| FieldNodes::of_mesh(mesh, options, control))?;
        control.within(0.3, 1.0, |control| Self::new(nodes, options, control))
    }

    /// For fields at scattered parameters.
    pub fn at(uv: &[DVec2], options: &FieldOptions, control: &mut Control) -> Result<Self, FieldError> {
        Self::new(FieldNodes::at(uv, options)?, options, control)
    }

    /// For fields on these nodes.
    pub fn new(nodes: FieldNodes, options: &FieldOptions, control: &mut Control) -> Result<Self, FieldError> {
        options.check(nodes.map.uv.len())?;
        let mask = nodes.mask(options);
        let options = &FieldOptions { is_known: mask.as_deref().or(options.is_known), ..*options };
        let FieldNodes { mesh, map: NodeParameters { uv, remarks } } = nodes;
        let known = known_nodes(&uv, options)?;
        let known_uv: Vec<DVec2> = match &known {
            None => memory::copied(&uv),
            Some(known) => known.iter().map(|&node| uv[node as usize]).collect_vec(),
        };
        check_parameters(&known_uv)?;
        let data_box = Domain::around(uv.iter().copied());
        let energy = options.energy.determining(&known_uv, &data_box)?;
        control.enter(Stage::Fit);
        let counts = match options.grid {
            FieldGrid::Fixed(counts) => counts,
            FieldGrid::Auto => [bearable_count(known_uv.len()); 2],
        };
        control.report(0.0, f64::NAN)?;
        let grid = [
            UniformGrid::over(data_box.min.x, data_box.max.x, options.buffer, counts[0]),
            UniformGrid::over(data_box.min.y, data_box.max.y, options.buffer, counts[1]),
        ];
        let [u, v] = grid.map(|grid| UniformBasis { grid, ends: options.ends });
        let basis = TensorBasis { u, v };
        let places = mesh.map_or(Vec::new(), |mesh| known_places(mesh, &uv, &grid, options));
        let parts = Parts::new(basis, options, energy, places);
        let solver = control.watch(|pool, watch| parts.solver(&uv, known, pool, watch))??;
        control.report(1.0, f64::NAN)?;
        let knots = knots_of(&grid)?;
        let ((u0, u1), (v0, v1)) = (knots[0].domain(), knots[1].domain());
        let domain = Domain { min: DVec2::new(u0, v0), max: DVec2::new(u1, v1) };
        let trims = trims(mesh, &uv, &domain);
        let region = Region { data_box: Some(data_box), trims, ..Region::default() };
        Ok(Self {
            uv,
            parts,
            knots,
            region,
            solver,
            partly: Partly::new(options.missing, data_box),
            tolerance: options.tolerance,
            map_remarks: remarks,
            pool: Pool::new(control.thread_count()),
        })
    }

    /// Number of nodes, those without values included.
    pub fn node_count(&self) -> usize {
        self.uv.len()
    }

    /// The (u,v) of the nodes.
    pub fn parameters(&self) -> &[DVec2] {
        &self.uv
    }

    /// Knots along u and v.
    pub fn grid(&self) -> [usize; 2] {
        [self.basis().u.grid.count, self.basis().v.grid.count]
    }

    fn basis(&self) -> &TensorBasis {
        &self.parts.basis
    }

    /// Fits rows of `dim` numbers, one a node.
    pub fn fit(&self, values: &[f64], dim: usize) -> Result<TensorSurface, FieldError> {
        let solver = self.checked(values, dim)?;
        solver.with_scratch(self.basis(), dim, |scratch| {
            self.solve(&solver, values, scratch);
            let [u, v] = self.knots.clone();
            let surface = TensorSurface::new(dim, u, v, scratch.control_points.clone(), None);
            let mut surface = surface.map_err(|_| FitError::Singular)?;
            *surface.region_mut() = self.region.clone();
            Ok(surface)
        })
    }

    /// Turns a surface of [`FieldFitter::fit`] into that of other values, in its place: no memory is asked for
    /// that grows with the nodes or the grid, once a field of this `dim` has been fitted.
    pub fn update(&self, surface: &mut TensorSurface, values: &[f64], dim: usize) -> Result<(), FieldError> {
        let solver = self.checked(values, dim)?;
        let [u, v] = &self.knots;
        let is_ours = surface.dim() == dim
            && surface.weights().is_none()
            && surface.knots(Axis::U) == u
            && surface.knots(Axis::V) == v;
        if !is_ours {
            return Err(FieldError::OtherGrid);
        }
        solver.with_scratch(self.basis(), dim, |scratch| {
            self.solve(&solver, values, scratch);
            surface.set_control_points(&scratch.control_points).map_err(|_| FitError::Singular.into())
        })
    }

    /// Measures a surface against values.
    pub fn measure(
        &self,
        surface: &TensorSurface,
        values: &[f64],
        dim: usize,
    ) -> Result<FieldReport, FieldError> {
        let start = Instant::now();
        self.pool.check_process()?;
        let part = self.check_numbers(values, dim)?;
        let known = part.as_deref().or(self.solver.known.as_deref());
        let bounds = bounds(known, values, dim);
        let goal = Goal::new(&self.tolerance, &bounds);
        let errors = self.errors(surface, known, values, dim);
        let [grid_u, grid_v] = self.grid();
        let mut fit = FitReport {
            grid_u,
            grid_v,
            coefficient_count: self.basis().len(),
            smoothing: self.parts.smoothing,
            seconds: start.elapsed().as_secs_f64(),
            ..FitReport::new(&errors, &goal, StopReason::FixedGrid, 1)
        };
        fit.remarks.0 |= self.map_remarks.0;
        Ok(FieldReport { fit, errors: errors.each })
    }

    fn solve(&self, solver: &Solver, values: &[f64], scratch: &mut Scratch) {
        let dim = scratch.dim;
        solver.right_side.frame(values, dim, scratch);
        solver.right_side.assemble(values, dim, self.basis(), scratch, &self.pool);
        solver.factor.solve_in(&mut scratch.columns, dim, &mut scratch.memory);
        scratch.write_control_points(self.basis(), dim);
    }

    /// Checks values, and chooses the equations of the nodes that have some.
    fn checked(&self, values: &[f64], dim: usize) -> Result<Chosen<'_>, FieldError> {
        self.pool.check_process()?;
        Ok(match self.check_numbers(values, dim)? {
            None => Chosen::Whole(&self.solver),
            Some(known) => Chosen::Part(self.partly.solver(&self.parts, &self.uv, known, &self.pool)?),
        })
    }

    /// Checks values; the nodes that have some, where they are not all that may have.
    fn check_numbers(&self, values: &[f64], dim: usize) -> Result<Option<Vec<u32>>, FitError> {
        if dim == 0 {
            return Err(FitError::Option { option: "dim", value: 0.0, range: "at least 1" });
        }
        let expected = self.uv.len().saturating_mul(dim);
        if values.len() != expected {
            return Err(FitError::Count { what: "the values", count: values.len(), expected });
        }
        let part = self.partly.known_of(&self.solver, values, dim);
        let known = part.as_deref().unwrap_or(self.solver.right_side.nodes());
        let is_finite = |node: usize| values[node * dim..][..dim].iter().all(|x| x.is_finite());
        match known.iter().find(|&&node| !is_finite(node as usize)) {
            Some(&node) => Err(FitError::ValuesNotFinite { index: node as usize }),
            None => Ok(part),
        }
    }

    /// The errors of all nodes, NaN where there is no value; sums over the others.
    fn errors(
        &self,
        surface: &TensorSurface,
        known: Option<&[u32]>,
        values: &[f64],
        dim: usize,
    ) -> DataErrors {
        let Some(known) = known else {
            return data_errors(surface, &self.uv, values, &self.pool);
        };
        let uv: Vec<DVec2> = known.iter().map(|&node| self.uv[node as usize]).collect_vec();
        let rows: Vec<f64> =
            known.iter().flat_map(|&node| &values[node as usize * dim..][..dim]).copied().collect_vec();
        let mut errors = data_errors(surface, &uv, &rows, &self.pool);
        let mut each = memory::filled(f64::NAN, self.uv.len());
        known.iter().zip(&errors.each).for_each(|(&node, &error)| each[node as usize] = error);
        errors.worst_index = known[errors.worst_index] as usize;
        errors.each = each;
        errors
    }
}

fn known_nodes(uv: &[DVec2], options: &FieldOptions) -> Result<Option<Vec<u32>>, FitError> {
    let Some(is_known) = options.is_known else { return Ok(None) };
    let known: Vec<u32> = (0..uv.len() as u32).filter(|&node| is_known[node as usize]).collect_vec();
    if known.len() < 3 {
        return Err(FitError::TooFew { count: known.len() });
    }
    Ok(Some(known))
}

/// Places inside triangles whose nodes all have values.
fn known_places(
    mesh: &Mesh,
    uv: &[DVec2],
    grid: &[UniformGrid; 2],
    options: &FieldOptions,
) -> Vec<InteriorPlace> {
    let is_known = |node: usize| options.is_known.is_none_or(|is_known| is_known[node]);
    let places = interior_places(mesh, uv, grid, options.weights);
    places.filter(|place| place.nodes.into_iter().all(is_known)).collect_vec()
}

/// The knots of a grid; a range of a few roundings has no room for them.
fn knots_of([u, v]: &[UniformGrid; 2]) -> Result<[KnotVector; 2], FitError> {
    let knots = |grid: &UniformGrid, axis| {
        grid.knot_vector().map_err(|_| FitError::DegenerateRange { axis, at: grid.start })
    };
    Ok([knots(u, 'u')?, knots(v, 'v')?])
}

/// Knots along one direction that so many nodes with values bear.
fn bearable_count(known_count: usize) -> usize {
    let is_bearable =
        |count: usize| count <= LARGEST_AUTO_GRID && NODES_PER_COEFFICIENT * count * count <= known_count;
    let doubled = std::iter::successors(Some(2), |&count| Some(2 * count - 1));
    doubled.take_while(|&count| count == 2 || is_bearable(count)).last().unwrap_or(2)
}

/// The box of the values that there are.
fn bounds(known: Option<&[u32]>, values: &[f64], dim: usize) -> Bounds {
    let Some(known) = known else { return Bounds::of_rows(values, dim) };
    let rows: Vec<f64> =
        known.iter().flat_map(|&node| &values[node as usize * dim..][..dim]).copied().collect_vec();
    Bounds::of_rows(&rows, dim)
}

#[cfg(test)]
mod tests;
