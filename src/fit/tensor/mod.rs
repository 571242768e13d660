//! Bicubic surfaces from tessellations, scattered points and fields on nodes.
//!
//! J. Dannenhoffer and R. Haimes, "Generation of spline approximations to tessellations" (2009). The default
//! is true least squares in the space of natural C2 splines, with a bending energy where data are thin;
//! [`Method::Ferguson`] keeps the paper's own equations. [`Knots::Adaptive`] puts knot lines where the error asks for
//! them; [`Knots::Uniform`], as in the paper, doubles grids in one direction at a time until
//! every datum lies within the tolerance.
//!
//! ```text
//! minimize  sum_n |S(u_n,v_n) - P_n|^2 + (mu/12) energy(S)
//! ```

mod adaptive;
mod candidate;
mod closing;
mod lines;
mod measure;
mod mirror;
mod options;
mod refine;
mod sides;
mod single_grid;
mod tame;

pub use super::common::uniform::{Ends, Energy, Method, SMOOTHING_LADDER};
pub use super::common::{Neighbour, Sides};
pub use options::{Knots, TensorOptions};

use super::common::checks::{check_parameters, check_unused, check_values};
use super::common::errors::{DataErrors, data_errors};
use super::common::interior::Between;
use super::common::neighbours::triangles_between;
use super::common::outliers::{self, Cloud};
use super::common::partial::{self, is_on_triangles, is_partial};
use super::common::report::Goal;
use super::common::sides::{GivenSide, SideJoints, SideMeasure};
use super::common::uniform::normal_equations::TensorBasis;
use super::common::{
    Demands, Fit, FitError, Frame, Outliers, Partial, Standards, Symmetry, Used, node_parameters, timed,
};
use crate::control::{Control, Pool};
use crate::geometry::Bounds;
use crate::linalg::Conditions;
use crate::memory::CollectVec;
use crate::mesh::Mesh;
use crate::surface::tensor::TensorSurface;
use crate::surface::{Domain, Region};
use glam::DVec2;
use lines::Lines;
use std::sync::OnceLock;
use std::time::Instant;

/// A fitted tensor surface with all that is known of it.
pub type TensorFit = Fit<TensorSurface>;

/// Fits the shape of a mesh. Without parameters the mesh is parameterized first.
pub fn fit_mesh(mesh: &Mesh, options: &TensorOptions, control: &mut Control) -> Result<TensorFit, FitError> {
    let values: Vec<f64> = mesh.points().iter().flat_map(|p| p.to_array()).collect_vec();
    timed(|| fit_on_mesh(mesh, &values, 3, true, options, control))
}

/// Fits values on the nodes of a mesh, `dim` numbers a node, over the same parameters as its shape; as many rows as the
/// mesh has triangles are taken at their centroids.
pub fn fit_field(
    mesh: &Mesh,
    values: &[f64],
    dim: usize,
    options: &TensorOptions,
    control: &mut Control,
) -> Result<TensorFit, FitError> {
    timed(|| {
        if dim > 0 && (is_partial(values, options.missing) || is_on_triangles(mesh, values.len() / dim)) {
            options.check()?;
            check_unused(!options.closes(), "periods", "the fit over a mesh")?;
            let map = |control: &mut Control| {
                node_parameters(mesh, &options.parameterize, options.regularize, control)
            };
            return partial::fit_on_mesh(
                mesh,
                values.len() / dim,
                control,
                map,
                |places, data_box, control| fit_partial(places, data_box, values, dim, options, control),
            );
        }
        fit_on_mesh(mesh, values, dim, false, options, control)
    })
}

/// Fits rows of `dim` numbers at scattered parameters.
pub fn fit_points(
    uv: &[DVec2],
    values: &[f64],
    dim: usize,
    options: &TensorOptions,
    control: &mut Control,
) -> Result<TensorFit, FitError> {
    timed(|| {
        if dim > 0 && is_partial(values, options.missing) {
            return partial::fit_at_points(uv, |places, data_box| {
                fit_partial(places, data_box, values, dim, options, control)
            });
        }
        check(uv, values, dim, options)?;
        if options.demands.outliers != Outliers::None {
            let triangles =
                triangles_between(uv, &Domain::around(uv.iter().copied()), control.pool().watch());
            let cloud = Cloud { uv, values, dim, triangles: &triangles };
            let asked = (&options.demands, &options.tolerance);
            return outliers::fit_without(&cloud, asked, control, |values, demands, control| {
                fit_points(uv, values, dim, &TensorOptions { demands: *demands, ..*options }, control)
            });
        }
        let problem = Problem::new(uv.to_vec(), values, dim, None, options)?;
        problem.fit_any(control)
    })
}

/// Fits those values that there are, over the box of all.
fn fit_partial(
    places: &[Option<DVec2>],
    data_box: Domain,
    values: &[f64],
    dim: usize,
    options: &TensorOptions,
    control: &mut Control,
) -> Result<TensorFit, FitError> {
    const BY: &str = "the fit of data without values at some places";
    check_unused(options.demands == Demands::default(), "what single data demand", BY)?;
    check_unused(options.sides.are_free(), "sides", BY)?;
    let partial = Partial::of(places, data_box, values, dim, options.weights, options.missing)?;
    partial.fit(|partial| {
        let options = TensorOptions { weights: partial.weights(), ..*options };
        check(&partial.uv, &partial.values, dim, &options)?;
        let problem = Problem::new(partial.uv.clone(), &partial.values, dim, None, &options)?;
        Problem { data_box: options.whole_box(partial.data_box)?, ..problem }.fit_any(control)
    })
}

fn fit_on_mesh(
    mesh: &Mesh,
    values: &[f64],
    dim: usize,
    is_shape: bool,
    options: &TensorOptions,
    control: &mut Control,
) -> Result<TensorFit, FitError> {
    if let Some(used) = Used::of(mesh, values, dim, options.weights, &options.demands)? {
        let parameterize = used.parameterize(options.parameterize);
        let options =
            TensorOptions { weights: used.weights(), demands: used.demands(), parameterize, ..*options };
        let fit = fit_on_mesh(used.mesh(), &used.values, dim, is_shape, &options, control);
        let mut fit = fit.map_err(|error| used.told(error))?;
        used.spread(&mut fit.report, &mut fit.parameters, &mut fit.errors);
        return Ok(fit);
    }
    let start = Instant::now();
    check_unused(!options.closes(), "periods", "the fit over a mesh")?;
    if options.demands.symmetry != Symmetry::None {
        check_unused(is_shape, "symmetry", "the fit of a field")?;
        return mirror::fit_symmetric(mesh, options, control);
    }
    options.check()?;
    check_values(mesh.points().len(), values, dim, options.weights)?;
    options.demands.check(mesh.points().len())?;
    control.set_stage(0.0, 0.3);
    let map = node_parameters(mesh, &options.parameterize, options.regularize, control)?;
    let parameterize_seconds = start.elapsed().as_secs_f64();
    check(&map.uv, values, dim, options)?;
    if options.demands.outliers != Outliers::None {
        let (data, asked) = ((values, dim, is_shape), (&options.demands, &options.tolerance));
        return outliers::fit_mesh_without(
            (mesh, &map.uv),
            data,
            asked,
            control,
            |mesh, values, demands, control| {
                let options = TensorOptions { demands: *demands, ..*options };
                fit_on_mesh(mesh, values, dim, is_shape, &options, control)
            },
        );
    }
    let mut problem = Problem::new(map.uv, values, dim, Some(mesh), options)?;
    problem.is_shape = is_shape;
    control.set_stage(0.3, 1.0);
    let mut fit = problem.fit_any(control)?;
    control.pool().check()?;
    fit.report.parameterize_seconds = parameterize_seconds;
    fit.report.remarks.0 |= map.remarks.0;
    fit.report.measure_map(mesh, &fit.parameters, control.pool().watch());
    Ok(fit)
}

fn check(uv: &[DVec2], values: &[f64], dim: usize, options: &TensorOptions) -> Result<(), FitError> {
    options.check()?;
    check_unused(options.demands.symmetry == Symmetry::None, "symmetry", "the fit of points")?;
    check_values(uv.len(), values, dim, options.weights)?;
    options.demands.check(uv.len())?;
    check_parameters(uv)
}

/// Knots of the first grid.
const FIRST_GRID: [usize; 2] = [2, 2];

/// Data, what they are fitted with, and how far the fit has come.
struct Problem<'a> {
    options: &'a TensorOptions<'a>,
    mesh: Option<&'a Mesh>,
    /// Whether the values are the nodes' places in space.
    is_shape: bool,
    /// Rows of `dim` numbers, as given.
    values: &'a [f64],
    dim: usize,
    /// Parameters of the data; correction sweeps move them, by [`Self::move_data`].
    uv: Vec<DVec2>,
    /// What is known between the data, once it has been asked for.
    between: OnceLock<Between>,
    /// The box of `uv` as it was at first.
    data_box: Domain,
    /// The energy asked for, or the plate where that leaves the surface undetermined.
    energy: Energy,
    frame: Frame,
    goal: Goal,
    standards: Standards,
    /// Weights of the data, if they are not alike; 0 for those that are left out.
    weights: Option<Vec<f64>>,
    /// Whether the end of u is a mirror: the data are half of a symmetric shape.
    is_mirrored: bool,
    /// Sides that are given.
    sides: Vec<GivenSide>,
    /// The least merit of the rounds so far.
    least: f64,
    /// The grids to try in the next round.
    next: Vec<[usize; 2]>,
}

impl<'a> Problem<'a> {
    fn new(
        uv: Vec<DVec2>,
        values: &'a [f64],
        dim: usize,
        mesh: Option<&'a Mesh>,
        options: &'a TensorOptions<'a>,
    ) -> Result<Self, FitError> {
        let bounds = Bounds::of_rows(values, dim);
        let data_box = options.whole_box(Domain::around(uv.iter().copied()))?;
        let energy = options.energy.determining(&uv, &data_box)?;
        let goal = Goal::new(&options.tolerance, &bounds);
        let standards = Standards::new(&options.demands, &options.tolerance, &goal, &uv, (values, dim))?;
        let measure = SideMeasure { tolerance: goal.tolerance, diagonal: goal.diagonal };
        let data = (values, dim);
        let sides = GivenSide::all(&options.sides, &data_box, &uv, data, SideJoints::Curvature, measure)?;
        Ok(Self {
            weights: standards.weights(options.weights),
            goal,
            standards,
            least: f64::INFINITY,
            next: vec![options.fixed_grid.unwrap_or(FIRST_GRID)],
            energy,
            frame: Frame::new(&bounds),
            options,
            mesh,
            is_shape: false,
            is_mirrored: false,
            sides,
            values,
            dim,
            uv,
            between: OnceLock::new(),
            data_box,
        })
    }

    /// Measures a surface at the data.
    fn errors(&self, surface: &TensorSurface, pool: &Pool) -> DataErrors {
        self.standards.measure(data_errors(surface, &self.uv, self.values, pool))
    }

    /// The conditions on a surface over some lines; `values` are rows in the frame of the unknowns.
    fn conditions(&self, basis: &TensorBasis<Lines>, (values, dim): (&[f64], usize)) -> Vec<Conditions> {
        match self.is_mirrored {
            true => mirror::conditions(basis, dim, self.frame.inward(&vec![0.0; dim])[0]),
            false => {
                let mut all = self.standards.conditions(&self.uv, (values, dim), |uv| basis.terms(uv));
                let mut conditions = self.side_conditions(basis);
                conditions.extend(self.closing_conditions(basis));
                match all.first_mut() {
                    Some(fixed) => fixed.conditions.extend(conditions),
                    None if conditions.is_empty() => {}
                    None => all.push(Conditions { columns: 0..dim, conditions }),
                }
                all
            }
        }
    }

    /// Whether the ends of the surface are bound: by sides, or because it closes.
    fn has_bound_ends(&self) -> bool {
        !self.sides.is_empty() || self.options.closes()
    }

    fn region(&self) -> Region {
        Region { data_box: Some(self.data_box), ..Region::default() }
    }
}
