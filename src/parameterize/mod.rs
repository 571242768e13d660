//! Where a mesh gets its (u,v) from.
//!
//! W. Tutte, "How to draw a graph" (1963); M. Floater, "Mean value coordinates" (2003);
//! S. Yoshizawa et al., "A fast and simple stretch-minimizing mesh parameterization" (2004). What we
//! changed stands in docs/theory.md, "Where meshes get their (u,v)".
//!
//! [`parameterize`] maps a disk, possibly with holes, onto a circle or a square with bulged sides:
//! fans close the holes, every interior node becomes the weighted mean of its neighbours, and the
//! weights are divided by the stretch found until the stretch no longer falls. With mean value
//! weights and a convex border no triangle flips, at any step. [`regularize`](fn@regularize) evens out parameters
//! that came with the mesh. [`stretch`](fn@stretch) measures any map.
//!
//! Closed meshes, handles and several components are refused: they need cuts first. A node without
//! triangles keeps the parameters given with the mesh and is refused if there are none.

mod border;
mod crossings;
pub(crate) mod dirichlet;
mod error;
mod height_field;
mod isometric;
mod options;
mod patch;
mod regularize;
pub mod sphere;
mod stretch;
mod system;
mod weights;

pub(crate) use crossings::crossing_nodes;
pub use error::ParameterizeError;
pub use height_field::plane_coordinates;
pub use options::{Border, Method, ParameterizeOptions};
pub use regularize::{
    Boundary, Regularization, RegularizeOptions, RegularizeReport, RegularizeWhen, regularize,
};
pub use stretch::{StretchMeasure, stretch};

use crate::Control;
use crate::control::Stage;
use crate::geometry::{Orientation, orientation};
use crate::memory::{self, CollectVec};
use crate::mesh::Mesh;
use border::BorderLine;
use glam::DVec2;
use patch::{Holes, Patch};
use std::time::Instant;
use stretch::PatchStretch;
use system::MapSystem;

/// The (u,v) of each node of a mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameterization {
    /// By node.
    pub uv: Vec<DVec2>,
    /// How good the map is and what it took.
    pub report: ParameterizeReport,
}

/// How good a map is and what it took.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ParameterizeReport {
    /// Triangles turned over against the rest, by the exact sign of their area: folds of the map.
    pub flipped_triangles: usize,
    /// Triangles of exactly zero parameter area.
    pub degenerate_triangles: usize,
    /// L2, Linf and area ratio of all triangles of the mesh.
    pub stretch: StretchMeasure,
    /// The border that was taken.
    pub border: Border,
    /// Whether the border slid with the stretch.
    pub border_slid: bool,
    /// Factorizations of the linear system, all candidates together.
    pub solves: usize,
    /// Stretch steps that improved the map returned.
    pub steps: usize,
    /// Wall time.
    pub seconds: f64,
    /// Everything worth knowing.
    pub remarks: Remarks,
}

/// A set of things worth knowing about a map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Remarks(u32);

impl Remarks {
    /// Triangles are flipped or have no parameter area.
    pub const FOLDED: Self = Self(1);
    /// Holes were closed by fans while the map was computed.
    pub const HOLES_FILLED: Self = Self(2);
    /// Triangles without area in space were left out of the weights.
    pub const ZERO_AREA: Self = Self(4);
    /// The L2 stretch is above [`HIGH_STRETCH`]. After stretch steps to the end one chart does not
    /// suit this shape, cut it into several; after fewer, allow more of them.
    pub const HIGH_STRETCH: Self = Self(8);

    /// Whether all of `other` is in this set.
    pub const fn contains(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }

    /// The bits, for an exported report.
    pub const fn bits(self) -> u32 {
        self.0
    }

    fn insert_if(&mut self, remark: Self, holds: bool) {
        self.0 |= if holds { remark.0 } else { 0 };
    }
}

/// L2 stretch above which cutting the shape is suggested: heads end at 1.6, an airliner at 7.7.
pub const HIGH_STRETCH: f64 = 3.0;

/// Up to this L2 stretch a map keeps lengths well enough; beyond it a height field is better seen from above.
const NEARLY_ISOMETRIC: f64 = 1.05;
/// The plane's coordinates are not taken if they stretch this many times more: the shape is then too steep.
const MOST_FLATTENED: f64 = 3.0;

/// A step must lower the stretch by this share for the next to be as long.
const LEAST_GAIN: f64 = 0.005;
/// Shortest step: halving on brings nothing measurable.
const LEAST_ETA: f64 = 1.0 / 8.0;

/// Maps a disk, possibly with holes, into the plane.
pub fn parameterize(
    mesh: &Mesh,
    options: &ParameterizeOptions,
    control: &mut Control,
) -> Result<Parameterization, ParameterizeError> {
    parameterize_weighted(mesh, options, None, control)
}

/// The same, with more parameter area where `node_weights` are large: they multiply the stretch
/// that steps work against (an error-driven map). One positive number a node.
pub fn parameterize_weighted(
    mesh: &Mesh,
    options: &ParameterizeOptions,
    node_weights: Option<&[f64]>,
    control: &mut Control,
) -> Result<Parameterization, ParameterizeError> {
    let start = Instant::now();
    options.check()?;
    check_node_weights(mesh, node_weights)?;
    let (mesh, _) = mesh.at_safe_scale();
    let mesh = mesh.as_ref();
    patch::check_disk(mesh)?;
    let given = start_values(mesh, options)?;
    let zero_area = zero_area_count(mesh)?;

    control.pool().check()?;
    let patch = Patch::new(mesh, holes(options));
    control.pool().check()?;
    let lines = border::candidates(mesh, options)?;
    control.pool().check()?;
    let first_weights = weights::weights(&patch, options.method)?;
    control.enter(Stage::Parameterize);
    control.report(0.0, f64::NAN)?;
    let mut system = MapSystem::new(&patch, memory::copied(&first_weights), control)?;
    let mut first_maps = Vec::new();
    for line in &lines {
        let mut uv = memory::copied(&given);
        memory::reserve(&mut uv, patch.points.len().saturating_sub(given.len()));
        uv.resize(patch.points.len(), DVec2::ZERO);
        line.place(&mut uv);
        control.pool().check()?;
        system.solve(&mut uv, control);
        memory::push(&mut first_maps, uv);
    }
    let mut best: Option<Map> = None;
    let count = lines.len() as f64;
    for (i, (line, uv)) in lines.into_iter().zip(first_maps).enumerate() {
        control.pool().check()?;
        let map = Map::new(&patch, line, memory::copied(&first_weights), uv, node_weights, control);
        let mut stage = Part { control: &mut *control, from: i as f64 / count, to: (i + 1) as f64 / count };
        let map = lower_stretch(map, &mut system, options, node_weights, &mut stage)?;
        best = Some(match best {
            Some(best) if !map.is_better_than(&best) => best,
            _ => map,
        });
    }
    control.pool().check()?;
    let best = best.expect("there is at least one border");
    let mut report = best.report(mesh, system.factor_count);
    control.pool().check()?;
    report.remarks.insert_if(Remarks::HOLES_FILLED, patch.points.len() > patch.mesh_node_count);
    report.remarks.insert_if(Remarks::ZERO_AREA, zero_area > 0);
    let mut uv = best.uv;
    uv.truncate(patch.mesh_node_count);
    if options.border == Border::Free || (options.border == Border::Auto && options.unroll) {
        let is_wanted = options.border == Border::Free;
        let least_gain = if is_wanted { f64::NEG_INFINITY } else { LEAST_GAIN };
        let has_unrolled = unroll(mesh, &mut uv, &mut report, least_gain, control);
        control.pool().check()?;
        if is_wanted && !has_unrolled {
            return Err(ParameterizeError::CannotUnroll);
        }
        if !is_wanted && report.stretch.l2 > NEARLY_ISOMETRIC {
            flatten(mesh, &mut uv, &mut report);
        }
    }
    place_unused_nodes(mesh, &mut uv);
    report.seconds = start.elapsed().as_secs_f64();
    Ok(Parameterization { uv, report })
}

/// Takes the unrolled map if there is one that lowers the stretch by this share, and says whether.
fn unroll(
    mesh: &Mesh,
    uv: &mut Vec<DVec2>,
    report: &mut ParameterizeReport,
    least_gain: f64,
    control: &Control,
) -> bool {
    let Some(unrolled) = isometric::unroll(mesh, uv, control.pool()) else { return false };
    let measure = stretch(mesh.points(), mesh.triangles(), &unrolled);
    let gain = 1.0 - measure.l2 / report.stretch.l2;
    if !(gain >= least_gain) {
        return false;
    }
    *uv = unrolled;
    report.set_free(measure);
    true
}

/// Takes the plane's own coordinates if the mesh is a height field that they do not stretch much more.
fn flatten(mesh: &Mesh, uv: &mut Vec<DVec2>, report: &mut ParameterizeReport) {
    let Some(flat) = height_field::flatten(mesh, height_field::LEAST_COSINE) else { return };
    let measure = stretch(mesh.points(), mesh.triangles(), &flat);
    if measure.l2 <= MOST_FLATTENED * report.stretch.l2 {
        *uv = flat;
        report.set_free(measure);
    }
}

impl ParameterizeReport {
    /// For a map with a free border and without folds.
    fn set_free(&mut self, measure: StretchMeasure) {
        self.stretch = measure;
        self.border = Border::Free;
        self.border_slid = false;
        (self.flipped_triangles, self.degenerate_triangles) = (0, 0);
        self.remarks.0 &= !(Remarks::FOLDED.0 | Remarks::HIGH_STRETCH.0);
        self.remarks.insert_if(Remarks::HIGH_STRETCH, measure.l2 > HIGH_STRETCH);
    }
}

/// A map with what the next step starts from.
struct Map {
    line: BorderLine,
    weights: Vec<f64>,
    uv: Vec<DVec2>,
    stretch: PatchStretch,
    /// Triangles of the mesh that are turned against the rest, or flat.
    folded: usize,
    steps: usize,
}

impl Map {
    fn new(
        patch: &Patch,
        line: BorderLine,
        weights: Vec<f64>,
        uv: Vec<DVec2>,
        node_weights: Option<&[f64]>,
        control: &Control,
    ) -> Self {
        let stretch = PatchStretch::new(patch, &uv, node_weights, control);
        let (reversed, flat) = folds(&patch.triangles[..patch.mesh_triangle_count], &uv);
        let folded = reversed + flat;
        Self { line, weights, uv, stretch, folded, steps: 0 }
    }

    /// The stretch that steps lower.
    fn l2(&self) -> f64 {
        self.stretch.movable_l2
    }

    /// What decides between borders.
    fn is_better_than(&self, other: &Self) -> bool {
        self.folded < other.folded
            || (self.folded == other.folded && is_less(self.stretch.of_mesh.l2, other.stretch.of_mesh.l2))
    }

    fn report(&self, mesh: &Mesh, solves: usize) -> ParameterizeReport {
        let (flipped_triangles, degenerate_triangles) = folds(mesh.triangles(), &self.uv);
        let mut remarks = Remarks::default();
        remarks.insert_if(Remarks::FOLDED, flipped_triangles + degenerate_triangles > 0);
        remarks.insert_if(Remarks::HIGH_STRETCH, self.stretch.of_mesh.l2 > HIGH_STRETCH);
        ParameterizeReport {
            flipped_triangles,
            degenerate_triangles,
            stretch: self.stretch.of_mesh,
            border: self.line.kind,
            border_slid: self.line.slide > 0.0,
            solves,
            steps: self.steps,
            seconds: 0.0,
            remarks,
        }
    }
}

/// A part of the whole progress.
struct Part<'c, 'a> {
    control: &'c mut Control<'a>,
    from: f64,
    to: f64,
}

impl Part<'_, '_> {
    /// Steps are not known beforehand: each takes a fifth of what is left.
    fn report(&mut self, steps_done: usize, l2: f64) -> Result<(), ParameterizeError> {
        let done = 1.0 - 0.8_f64.powi(steps_done as i32);
        Ok(self.control.report(self.from + done * (self.to - self.from), l2)?)
    }
}

/// Divides the weights by the stretch of the neighbours until that no longer helps (section 3).
fn lower_stretch(
    mut map: Map,
    system: &mut MapSystem,
    options: &ParameterizeOptions,
    node_weights: Option<&[f64]>,
    stage: &mut Part,
) -> Result<Map, ParameterizeError> {
    let patch = system.patch();
    let mut eta = 1.0;
    let mut steps = 0;
    while eta >= LEAST_ETA && steps < options.stretch_steps && !patch.nodes.is_empty() {
        stage.report(steps, map.l2())?;
        steps += 1;
        let s = map.stretch.of_nodes(patch, node_weights, options.rings);
        let next = next_map(&map, &s, eta, system, node_weights, stage.control)?;
        let enough = next.folded <= map.folded && next.l2() < (1.0 - LEAST_GAIN) * map.l2();
        if next.folded < map.folded || (next.folded == map.folded && is_less(next.l2(), map.l2())) {
            map = Map { steps: map.steps + 1, ..next };
        }
        if !enough {
            eta /= 2.0;
        }
    }
    Ok(map)
}

fn next_map(
    map: &Map,
    s: &[f64],
    eta: f64,
    system: &mut MapSystem,
    node_weights: Option<&[f64]>,
    control: &Control,
) -> Result<Map, ParameterizeError> {
    let patch = system.patch();
    control.pool().check()?;
    let divisors: Vec<f64> = s.iter().map(|s| s.powf(eta)).collect_vec();
    let mut weights = memory::copied(&map.weights);
    for (weight, &neighbour) in weights.iter_mut().zip(patch.neighbours.nodes()) {
        *weight /= divisors[neighbour as usize];
    }
    weights::scale_rows(patch, &mut weights)?;
    let line = map.line.slid(s, eta);
    let mut uv = memory::copied(&map.uv);
    line.place(&mut uv);
    control.pool().check()?;
    system.set_weights(memory::copied(&weights), control)?;
    control.pool().check()?;
    system.solve(&mut uv, control);
    control.pool().check()?;
    Ok(Map::new(patch, line, weights, uv, node_weights, control))
}

/// Whether one stretch is less than another by more than rounding: what is equal stays, whatever the last digits say.
fn is_less(stretch: f64, other: f64) -> bool {
    /// Roundoff of a sum over all triangles and of the map's system, with room.
    const ROUNDING: f64 = 1e-10;
    stretch < (1.0 - ROUNDING) * other
}

fn triangle_orientation(uv: &[DVec2], triangle: &[u32; 3]) -> Orientation {
    let [a, b, c] = triangle.map(|node| uv[node as usize]);
    orientation(a, b, c)
}

/// Triangles turned against the rest, and triangles without area, both exact. A mirrored map, most
/// of whose triangles are clockwise, is not folded for that.
pub fn folds(triangles: &[[u32; 3]], uv: &[DVec2]) -> (usize, usize) {
    let (mut positive, mut negative) = (0, 0);
    for triangle in triangles {
        match triangle_orientation(uv, triangle) {
            Orientation::Positive => positive += 1,
            Orientation::Negative => negative += 1,
            Orientation::Zero => {}
        }
    }
    (positive.min(negative), triangles.len() - positive - negative)
}

fn holes(options: &ParameterizeOptions) -> Holes {
    match (options.border, options.fill_holes) {
        (Border::Kept, _) => Holes::Fixed,
        (_, true) => Holes::Filled,
        (_, false) => Holes::Open,
    }
}

/// The parameters that nodes have before the map: those given, else zeros.
fn start_values(mesh: &Mesh, options: &ParameterizeOptions) -> Result<Vec<DVec2>, ParameterizeError> {
    match mesh.parameters() {
        Some(given) => Ok(memory::copied(given)),
        None if options.border == Border::Kept => Err(ParameterizeError::NoParameters),
        None => Ok(memory::filled(DVec2::ZERO, mesh.points().len())),
    }
}

/// Nodes without triangles have no place in the map. Unless they were given parameters, which they keep, they get those
/// of a node that has one: the range of the map stays as it is.
fn place_unused_nodes(mesh: &Mesh, uv: &mut [DVec2]) {
    let some_place = uv[mesh.triangles()[0][0] as usize];
    for node in mesh.unused_nodes() {
        uv[node as usize] = mesh.parameters().map_or(some_place, |given| given[node as usize]);
    }
}

fn check_node_weights(mesh: &Mesh, node_weights: Option<&[f64]>) -> Result<(), ParameterizeError> {
    let Some(given) = node_weights else { return Ok(()) };
    let count = mesh.points().len();
    let is_bad = |weight: &f64| !(*weight > 0.0 && weight.is_finite());
    match given.iter().position(is_bad).or((given.len() != count).then_some(given.len().min(count))) {
        Some(index) => Err(ParameterizeError::NodeWeight { index }),
        None => Ok(()),
    }
}

fn zero_area_count(mesh: &Mesh) -> Result<usize, ParameterizeError> {
    let has_area = |triangle: &&[u32; 3]| {
        let [a, b, c] = triangle.map(|node| mesh.points()[node as usize]);
        (b - a).cross(c - a).length() > 0.0
    };
    let count = mesh.triangles().len();
    match count - mesh.triangles().iter().filter(has_area).count() {
        zero if zero == count => Err(ParameterizeError::ZeroArea { count }),
        zero => Ok(zero),
    }
}

#[cfg(test)]
mod tests;
