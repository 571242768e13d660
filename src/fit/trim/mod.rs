//! Trims that follow curves in space.
//!
//! A loop of curves is sampled, its places are projected on to the surface, and their feet are joined by straight lines in
//! the parameter plane. A line is halved, with the foot of the middle of its piece of curve between, until the surface over
//! it is within the tolerance of that piece and the piece within the tolerance of it: both ways, so that neither takes a
//! short cut. Distances are measured at shares of the line and of the piece; a line deviates by the square of its length,
//! so what lies between differs little from them.

mod chain;
mod error;
mod follow;
#[cfg(test)]
mod tests;

pub use error::CurveTrimError;

use crate::control::{Control, Stage};
use crate::curve::Curve;
use crate::fit::common::checks::check_tolerance;
use crate::fit::common::report::{Goal, Tolerance};
use crate::geometry::{Bounds, visit_meetings};
use crate::memory::{self, CollectVec};
use crate::options::with_fields;
use crate::query::project::Projector;
use crate::surface::{Surface, Trims};
use follow::{Distance, Followed, Ground, follow};
use glam::DVec2;
use std::ops::ControlFlow;
use std::time::Instant;

/// Options of [`trim_by_curves`].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CurveTrimOptions {
    /// How far the trims may lie from the curves, and the curves from the surface; relative to the diagonal of the box of
    /// the curves' control points.
    pub tolerance: Tolerance,
    /// Whether the loops are added to the trims that the surface has. Default: they replace them.
    pub adds: bool,
}

impl CurveTrimOptions {
    with_fields! {
        with_tolerance tolerance: Tolerance,
        with_adds adds: bool,
    }
}

/// How near trims are to the curves that they follow, in model units: distances of the surface over them to the pieces of
/// curve that they stand for.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CurveTrimReport {
    /// Largest distance at a vertex.
    pub max_vertex_distance: f64,
    /// Root mean square of the distances at vertices.
    pub rms_vertex_distance: f64,
    /// Largest distance between vertices.
    pub max_distance_between: f64,
    /// Root mean square of the distances between vertices.
    pub rms_distance_between: f64,
    /// The parameter of the place on its curve that the trims are farthest from.
    pub worst_parameter: f64,
    /// The curve of that place, counted through all loops.
    pub worst_curve: usize,
    /// Vertices of the new trims.
    pub vertex_count: usize,
    /// Of these those whose places are not proved to be nearest to the curve.
    pub unproven_count: usize,
    /// The tolerance, which is no less than what rounding leaves.
    pub tolerance: f64,
    /// What a relative tolerance is measured in.
    pub diagonal: f64,
    /// Seconds in all.
    pub seconds: f64,
}

/// Trims, and how near they are to their curves.
#[derive(Debug, Clone)]
pub struct CurveTrims {
    /// All trims that the surface is to have.
    pub trims: Trims,
    /// What was measured.
    pub report: CurveTrimReport,
}

/// Makes trims of a surface that follow loops of curves. A loop is one closed curve, or several in order that meet end to
/// end, each in either direction; gaps within the tolerance are closed. `projector` projects on to this surface.
pub fn trim_by_curves(
    surface: &dyn Surface,
    projector: &Projector,
    loops: &[Vec<&Curve>],
    options: &CurveTrimOptions,
    control: &mut Control,
) -> Result<CurveTrims, CurveTrimError> {
    let start = Instant::now();
    check_tolerance(&options.tolerance)?;
    check(surface, loops)?;
    let goal = Goal::new(&options.tolerance, &bounds(loops));
    let ground = Ground { surface, projector, tolerance: goal.tolerance };
    control.enter(Stage::Project);
    let mut trims = match options.adds {
        true => surface.region().trims.loops().to_vec(),
        false => Vec::new(),
    };
    let mut found: Vec<Followed> = memory::with_capacity(loops.len());
    let (mut first, part) = (0, 1.0 / loops.len() as f64);
    for (index, curves) in loops.iter().enumerate() {
        let links = chain::closed(curves, first, goal.tolerance)?;
        first += curves.len();
        let (from, to) = (part * index as f64, part * (index + 1) as f64);
        let followed = control.within(from, to, |control| follow(&ground, &links, control))?;
        if followed.loop_uv.len() < 3 {
            return Err(CurveTrimError::Thin { index });
        }
        memory::push(&mut trims, memory::copied(&followed.loop_uv));
        memory::push(&mut found, followed);
    }
    check_apart(&trims)?;
    let trims = Trims::new(trims, &surface.domain())?;
    let report = CurveTrimReport {
        tolerance: goal.tolerance,
        diagonal: goal.diagonal,
        seconds: start.elapsed().as_secs_f64(),
        ..report(&found)
    };
    Ok(CurveTrims { trims, report })
}

fn check(surface: &dyn Surface, loops: &[Vec<&Curve>]) -> Result<(), CurveTrimError> {
    if surface.dim() != 3 {
        return Err(CurveTrimError::SurfaceDimension { dim: surface.dim() });
    }
    if loops.is_empty() {
        return Err(CurveTrimError::NoLoops);
    }
    if let Some(index) = loops.iter().position(Vec::is_empty) {
        return Err(CurveTrimError::NoCurves { index });
    }
    match loops.iter().flatten().enumerate().find(|(_, curve)| curve.dim() != 3) {
        Some((curve, given)) => Err(CurveTrimError::CurveDimension { curve, dim: given.dim() }),
        None => Ok(()),
    }
}

/// The box of the control points of all curves.
fn bounds(loops: &[Vec<&Curve>]) -> Bounds {
    let numbers = loops.iter().flatten().flat_map(|curve| curve.control_points()).copied();
    Bounds::of_rows(&numbers.collect_vec(), 3)
}

/// Refuses trims that meet one another or themselves, exactly.
fn check_apart(trims: &[Vec<DVec2>]) -> Result<(), CurveTrimError> {
    let (mut nodes, mut owners, mut pieces) = (Vec::new(), Vec::new(), Vec::new());
    for (index, polyline) in trims.iter().enumerate() {
        let (start, count) = (nodes.len(), polyline.len());
        let node = |k: usize| (start + k % count) as u32;
        memory::extend(&mut pieces, (0..count).map(|k| [node(k), node(k + 1)]));
        memory::extend(&mut owners, std::iter::repeat_n(index, count));
        memory::extend(&mut nodes, polyline.iter().copied());
    }
    let mut meeting = None;
    let _ = visit_meetings(
        pieces,
        |node| nodes[node as usize],
        |one, other| {
            meeting = Some([one[0], other[0]].map(|node| node as usize));
            ControlFlow::Break(())
        },
    );
    let Some(at) = meeting else { return Ok(()) };
    let [one, other] = at.map(|node| owners[node]);
    let DVec2 { x: u, y: v } = nodes[at[1]];
    Err(CurveTrimError::Crossing { first: one.min(other), second: one.max(other), u, v })
}

fn report(found: &[Followed]) -> CurveTrimReport {
    let at_vertices = found.iter().flat_map(|followed| &followed.at_vertices);
    let between = found.iter().flat_map(|followed| &followed.between);
    let worst = at_vertices.clone().chain(between.clone()).max_by(|a, b| a.distance.total_cmp(&b.distance));
    let (max_vertex_distance, rms_vertex_distance) = sizes(at_vertices);
    let (max_distance_between, rms_distance_between) = sizes(between);
    CurveTrimReport {
        max_vertex_distance,
        rms_vertex_distance,
        max_distance_between,
        rms_distance_between,
        worst_parameter: worst.map_or(f64::NAN, |worst| worst.parameter),
        worst_curve: worst.map_or(0, |worst| worst.curve),
        vertex_count: found.iter().map(|followed| followed.loop_uv.len()).sum(),
        unproven_count: found.iter().map(|followed| followed.unproven).sum(),
        ..CurveTrimReport::default()
    }
}

/// The largest of some distances, and their root mean square.
fn sizes<'a>(distances: impl Iterator<Item = &'a Distance>) -> (f64, f64) {
    let add = |(max, sum, count): (f64, f64, f64), at: &Distance| {
        (max.max(at.distance), sum + at.distance * at.distance, count + 1.0)
    };
    let (max, sum, count) = distances.fold((0.0, 0.0, 0.0), add);
    (max, (sum / f64::max(count, 1.0)).sqrt())
}
