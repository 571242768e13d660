//! Evening out parameters that came with the mesh.
//!
//! J. Dannenhoffer and R. Haimes (2009): interior nodes become mean values of their neighbours, boundary nodes keep their
//! (u,v) or slide along the boundary until its spacing is proportional to length in space. That
//! repairs squeezed parameters and spoils good ones, so the default tests before and after: the
//! largest singular value of d(x,y,z)/d(u,v) on the worst triangle over the median triangle.

use super::patch::{Holes, Patch};
use super::stretch::{TriangleStretch, triangle_stretch};
use super::system::MapSystem;
use super::{Method, ParameterizeError, folds, weights};
use crate::Control;
use crate::control::Stage;
use crate::memory::{self, CollectVec};
use crate::mesh::Mesh;
use crate::options::with_fields;
use glam::{DVec2, DVec3};
use std::time::Instant;

/// Which boundary nodes move.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Boundary {
    /// Along the (u,v) polyline between its corners, to spacing by length in space.
    #[default]
    Slide,
    /// None.
    Fixed,
}

/// When to replace the given parameters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum RegularizeWhen {
    /// When they are uneven, and the new ones are free of folds and at least twice as even.
    #[default]
    Auto,
    /// In any case.
    Always,
}

/// How given parameters are evened out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RegularizeOptions {
    /// Whether to test if it helps. Default: auto.
    pub when: RegularizeWhen,
    /// Which boundary nodes move. Default: slide.
    pub boundary: Boundary,
    /// A boundary node is a corner, and stays, if the (u,v) polyline turns there by more than this.
    /// Radians; default [`RegularizeOptions::DEFAULT_CORNER_ANGLE`].
    pub corner_angle: f64,
}

impl Default for RegularizeOptions {
    fn default() -> Self {
        Self {
            when: RegularizeWhen::Auto,
            boundary: Boundary::Slide,
            corner_angle: Self::DEFAULT_CORNER_ANGLE,
        }
    }
}

impl RegularizeOptions {
    /// 30 degrees: less splits round boundaries, more loses corners of cut sheets.
    pub const DEFAULT_CORNER_ANGLE: f64 = std::f64::consts::PI / 6.0;

    with_fields! {
        with_when when: RegularizeWhen,
        with_boundary boundary: Boundary,
        with_corner_angle corner_angle: f64,
    }
}

/// Parameters after [`regularize`]: the given ones if they are better.
#[derive(Debug, Clone, PartialEq)]
pub struct Regularization {
    /// By node.
    pub uv: Vec<DVec2>,
    /// What was measured and decided.
    pub report: RegularizeReport,
}

/// What [`regularize`] measured and decided.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RegularizeReport {
    /// Whether the given parameters were replaced.
    pub replaced: bool,
    /// Worst over median largest singular value of the given parameters.
    pub unevenness_before: f64,
    /// The same of the new ones; of the given ones if none were computed.
    pub unevenness_after: f64,
    /// Triangles of the result turned over against the rest.
    pub flipped_triangles: usize,
    /// Triangles of the result without parameter area.
    pub degenerate_triangles: usize,
    /// Wall time.
    pub seconds: f64,
}

/// Parameters more uneven than this are regularized. Good ones of real sheets measure 1 to 4.
const UNEVEN: f64 = 5.0;
/// The new parameters must be so many times as even to be kept.
const LEAST_GAIN: f64 = 2.0;

/// Evens out the parameters given with the mesh.
pub fn regularize(
    mesh: &Mesh,
    options: &RegularizeOptions,
    control: &mut Control,
) -> Result<Regularization, ParameterizeError> {
    let start = Instant::now();
    let (mesh, _) = mesh.at_safe_scale();
    let mesh = mesh.as_ref();
    let given = mesh.parameters().ok_or(ParameterizeError::NoParameters)?;
    let (value, allowed) = (options.corner_angle, "0 to pi");
    if !(0.0..=std::f64::consts::PI).contains(&value) {
        return Err(ParameterizeError::Option { name: "corner_angle", value, allowed });
    }
    if mesh.loops().is_empty() {
        return Err(ParameterizeError::Closed);
    }
    let before = unevenness(mesh, given)?;
    let finish = |uv: Vec<DVec2>, replaced, after| {
        let (flipped_triangles, degenerate_triangles) = folds(mesh.triangles(), &uv);
        let report = RegularizeReport {
            replaced,
            unevenness_before: before,
            unevenness_after: after,
            flipped_triangles,
            degenerate_triangles,
            seconds: start.elapsed().as_secs_f64(),
        };
        Regularization { uv, report }
    };
    if options.when == RegularizeWhen::Auto && before <= UNEVEN {
        return Ok(finish(memory::copied(given), false, before));
    }
    control.enter(Stage::Parameterize);
    control.report(0.0, f64::NAN)?;
    let uv = regularized(mesh, given, options, control)?;
    control.report(1.0, f64::NAN)?;
    let after = unevenness(mesh, &uv)?;
    let helps = folds(mesh.triangles(), &uv) == (0, 0) && after * LEAST_GAIN <= before;
    Ok(match options.when {
        RegularizeWhen::Auto if !helps => finish(memory::copied(given), false, after),
        _ => finish(uv, true, after),
    })
}

fn regularized(
    mesh: &Mesh,
    given: &[DVec2],
    options: &RegularizeOptions,
    control: &Control,
) -> Result<Vec<DVec2>, ParameterizeError> {
    let mut uv = memory::copied(given);
    if options.boundary == Boundary::Slide {
        for nodes in mesh.loops() {
            slide(nodes, mesh.points(), options.corner_angle, &mut uv);
        }
    }
    let patch = Patch::new(mesh, Holes::Fixed);
    let weights = weights::weights(&patch, Method::MeanValue)?;
    MapSystem::new(&patch, weights, control)?.solve(&mut uv, control);
    Ok(uv)
}

/// Worst over median of the largest singular values; infinite where a triangle collapsed.
fn unevenness(mesh: &Mesh, uv: &[DVec2]) -> Result<f64, ParameterizeError> {
    let part = |triangle| -> TriangleStretch { triangle_stretch(mesh.points(), uv, triangle) };
    let mut values: Vec<f64> = mesh.triangles().iter().map(|triangle| part(triangle).largest).collect_vec();
    let middle = values.len() / 2;
    let (_, &mut median, upper) = values.select_nth_unstable_by(middle, f64::total_cmp);
    match upper.iter().copied().fold(median, f64::max) / median {
        ratio if median.is_finite() && median > 0.0 => Ok(ratio),
        _ => Err(ParameterizeError::FlatParameters),
    }
}

/// Spaces the nodes between corners by their distance in space, on the polyline they had.
fn slide(nodes: &[u32], points: &[DVec3], corner_angle: f64, uv: &mut [DVec2]) {
    let old: Vec<DVec2> = nodes.iter().map(|&node| uv[node as usize]).collect_vec();
    let count = old.len();
    let turn = |i: usize| {
        let (before, after) = (old[i] - old[(i + count - 1) % count], old[(i + 1) % count] - old[i]);
        before.perp_dot(after).atan2(before.dot(after)).abs()
    };
    let corners: Vec<usize> = (0..count).filter(|&i| turn(i) > corner_angle).collect_vec();
    if corners.len() < 2 {
        return;
    }
    for (&start, &end) in corners.iter().zip(corners.iter().cycle().skip(1)) {
        let steps = (end + count - start - 1) % count + 1;
        let places: Vec<usize> = (0..=steps).map(|k| (start + k) % count).collect_vec();
        let along = cumulative(places.iter().map(|&place| old[place]), |a, b| a.distance(b));
        let in_space =
            cumulative(places.iter().map(|&place| points[nodes[place] as usize]), |a, b| a.distance(b));
        let (length, total) = (along[steps], in_space[steps]);
        if !(length > 0.0 && total > 0.0) {
            continue;
        }
        for k in 1..steps {
            let target = length * in_space[k] / total;
            let piece = along.partition_point(|&t| t <= target).clamp(1, steps) - 1;
            let t = (target - along[piece]) / (along[piece + 1] - along[piece]);
            uv[nodes[places[k]] as usize] = old[places[piece]].lerp(old[places[piece + 1]], t);
        }
    }
}

/// Length from the first point to each.
fn cumulative<P: Copy>(points: impl Iterator<Item = P>, distance: impl Fn(P, P) -> f64) -> Vec<f64> {
    let mut last = None;
    let mut sum = 0.0;
    points
        .map(|point| {
            sum += last.replace(point).map_or(0.0, |last| distance(last, point));
            sum
        })
        .collect_vec()
}
