//! From any mesh to a model: the one place that chooses how.
//!
//! ```text
//! closed, exact       planes and cylinders that explain all of it, without a patch
//! sharp edges         patches and planes between them; where that fails, or they are but texture and it serves, as without
//! closed, genus 0     over the cube; where that misses the tolerance or folds, over a base complex too, and the better is kept
//! closed, handles     over a base complex
//! open, exact         shells of planes and cylinders
//! open                over its features if it has sharp edges or several loops, else, where these are but texture, or where
//!                     that is no good, one chart: a PHT-spline inside its trims; where no features serve and the chart
//!                     misses, over its borders alone
//! ```
//! Several closed components become several shells, one inside another a void.

use super::bodies::{self, Body, bodies};
use super::chart::chart;
use super::creased::over_features;
use super::error::ModelFitError;
use super::exact::{self, ExactFit, Obstacle};
use super::mesh_model::{
    Component, ComponentReport, Family, MeshModelOptions, ModelFit, Piece, Spot, origins, together,
};
use super::smooth::smooth;
use super::ways::{Way, first_done, is_better_both_ways, is_done, is_good_both_ways};
use crate::control::{Cancelled, Control};
use crate::failure::{Classify, ErrorKind};
use crate::fit::common::report::{Remarks, Tolerance, ToleranceScale};
use crate::geometry::safe_scale;
use crate::layout::of_mesh::{LayoutKind, check_patches};
use crate::memory::{self, CollectVec};
use crate::mesh::{FeatureOptions, Features, Mesh};
use crate::model::{FaceId, Origin, PatchModel, Patchwork, Role, ShellId, of_patches};
use crate::query::crossings::crossings;
use crate::query::tessellate::TessellateOptions;
use glam::DVec2;
use std::cell::Cell;
use std::f64::consts::PI;
use std::time::Instant;

/// Makes a model of a mesh.
pub fn fit_mesh(
    mesh: &Mesh,
    options: &MeshModelOptions,
    control: &mut Control,
) -> Result<ModelFit, ModelFitError> {
    check(mesh, options)?;
    let is_chart = match options.family {
        Family::Auto => !mesh.loops().is_empty(),
        Family::Chart => true,
        Family::Patches => false,
    };
    let start = Instant::now();
    let mut fit = match is_chart {
        true => match open_parts(mesh, options, control)? {
            Some(exact) => exact,
            None if options.family == Family::Auto => open(mesh, options, control)?,
            None => chart(mesh, options, control)?,
        },
        false => patches(mesh, options, control)?,
    };
    count_crossings(mesh, &mut fit, control)?;
    let (_, is_raised) = options.fit.tolerance.absolute(&mesh.bounds());
    fit.report.remarks.add_if(is_raised, Remarks::TOLERANCE_RAISED);
    fit.seconds = start.elapsed().as_secs_f64();
    Ok(fit)
}

/// Refuses what no way can do.
fn check(mesh: &Mesh, options: &MeshModelOptions) -> Result<(), ModelFitError> {
    let largest = mesh.points().iter().map(|point| point.abs().max_element()).fold(0.0, f64::max);
    if safe_scale(largest) != 1.0 {
        return Err(ModelFitError::Size { largest });
    }
    Ok(check_patches(mesh, options.layout.patches)?)
}

/// Counts the triangles that cross in the mesh and in the model, triangulated as finely as the tolerance.
fn count_crossings(mesh: &Mesh, fit: &mut ModelFit, control: &mut Control) -> Result<(), ModelFitError> {
    let options = TessellateOptions { chord_tolerance: fit.report.tolerance, ..TessellateOptions::default() };
    let model = &fit.model;
    let (of_mesh, of_model) = control.watch(|pool, watch| -> Result<_, Cancelled> {
        let of_mesh = crossings(mesh, pool)?.count;
        watch.check()?;
        // a model that cannot be triangulated has no triangles that cross
        let triangles = model.tessellate_by(&options, pool).ok();
        watch.check()?;
        Ok((of_mesh, triangles.map(|triangles| triangles.crossings)))
    })??;
    (fit.report.mesh_crossings, fit.report.crossings) = (of_mesh, of_model);
    let do_cross = of_mesh > 0 || of_model.is_some_and(|count| count > 0);
    fit.report.remarks.add_if(do_cross, Remarks::SELF_INTERSECTING);
    Ok(())
}

/// An open mesh: over its features if it has some inside or several loops, and what comes of it is good; else as one
/// chart. The chart comes first where its features are but texture.
fn open(mesh: &Mesh, options: &MeshModelOptions, control: &mut Control) -> Result<ModelFit, ModelFitError> {
    let may_be_chart = mesh.genus() == 0;
    if mesh.component_count() > bodies::MAX_COMPONENTS || (!asks_for_features(options) && may_be_chart) {
        return chart(mesh, options, control);
    }
    let features = mesh.find_features(&options.features)?;
    if features.edges.len() == features.border_count && mesh.loops().len() == 1 && may_be_chart {
        return chart(mesh, options, control);
    }
    options.fit.check(1)?;
    let has_layout = Cell::new(false);
    let over_edges = |control: &mut Control| {
        let fit = shells(mesh, bodies::shells(mesh), options, control);
        has_layout.set(fit.is_ok());
        fit.map(Some)
    };
    let chart = |control: &mut Control| chart(mesh, options, control).map(Some);
    let over_borders = |control: &mut Control| match has_layout.get() {
        true => Ok(None),
        false => over_borders(mesh, options, control),
    };
    let ways: [Way<ModelFit>; 3] = match are_texture(&features, options) {
        true => [(0.2, &chart), (0.4, &over_edges), (0.4, &over_borders)],
        false => [(0.4, &over_edges), (0.2, &chart), (0.4, &over_borders)],
    };
    let better = |made: ModelFit, best: ModelFit| {
        if is_better_both_ways(&made.report, &best.report) { made } else { best }
    };
    first_done(&ways, |fit| is_good_both_ways(&fit.report), better, control)
}

/// Where borders turn by more they have corners if all their features let no layout be had, one after the other: 57 degrees
/// leaves the corners of holes that are cut, 86 the sharpest of them, and the last none.
const BORDER_CORNERS: [f64; 3] = [1.0, 1.5, PI];

/// An open mesh over its borders and what is marked alone, with corners only where these turn by much; none where that lets no
/// layout be had either.
fn over_borders(
    mesh: &Mesh,
    options: &MeshModelOptions,
    control: &mut Control,
) -> Result<Option<ModelFit>, ModelFitError> {
    for (rank, corner_angle) in BORDER_CORNERS.into_iter().enumerate() {
        let features = FeatureOptions { sharp_angle: None, corner_angle, ..options.features };
        let options = MeshModelOptions { features, ..*options };
        let [from, to] = [rank, rank + 1].map(|k| k as f64 / BORDER_CORNERS.len() as f64);
        match control.within(from, to, |control| shells(mesh, bodies::shells(mesh), &options, control)) {
            Ok(mut fit) => {
                fit.components.iter_mut().for_each(|component| component.rounds_edges = true);
                return Ok(Some(fit));
            }
            Err(error) if error.kind() == ErrorKind::Cancelled => return Err(error),
            Err(_) => {}
        }
    }
    Ok(None)
}

/// Whether edges may stay sharp.
fn asks_for_features(options: &MeshModelOptions) -> bool {
    let FeatureOptions { sharp_angle, sharp_edges, labels, label_angle, .. } = options.features;
    sharp_angle.is_some() || !sharp_edges.is_empty() || (!labels.is_empty() && label_angle < PI)
}

/// Whether edges were found that are none of a part, and none are given.
fn are_texture(found: &Features, options: &MeshModelOptions) -> bool {
    found.are_texture() && options.features.sharp_edges.is_empty() && options.features.labels.is_empty()
}

fn patches(
    mesh: &Mesh,
    options: &MeshModelOptions,
    control: &mut Control,
) -> Result<ModelFit, ModelFitError> {
    options.fit.check(1)?;
    options.features.check(mesh)?;
    let bodies = bodies(mesh)?;
    // the tolerance is that of the whole
    let (value, _) = options.fit.tolerance.absolute(&mesh.bounds());
    if options.exact
        && options.family == Family::Auto
        && let Some(fit) = exact_parts(mesh, &bodies, value, options, control)?
    {
        return Ok(fit);
    }
    shells(mesh, bodies, options, control)
}

/// A shell of patches and planes for each body.
fn shells(
    mesh: &Mesh,
    bodies: Vec<Body>,
    options: &MeshModelOptions,
    control: &mut Control,
) -> Result<ModelFit, ModelFitError> {
    // the tolerance is that of the whole
    let (value, _) = options.fit.tolerance.absolute(&mesh.bounds());
    let absolute = Tolerance { value, scale: ToleranceScale::Absolute };
    let options = MeshModelOptions { fit: options.fit.with_tolerance(absolute), ..*options };
    let mut places = memory::filled(None, mesh.points().len());
    let mut errors = memory::filled(f64::NAN, mesh.points().len());
    let (mut pieces, mut components, mut spots) = (Vec::new(), Vec::new(), Vec::new());
    let all = mesh.triangles().len() as f64;
    let mut done = 0.0;
    for body in &bodies {
        let next = done + body.mesh.triangles().len() as f64 / all;
        let mut made = control.within(done, next, |control| component(body, &options, control))?;
        done = next;
        if made.piece.labels.is_empty() {
            made.name_patches(&body.mesh, &of_body(&options.features, body).0);
        }
        for (&node, &error) in body.nodes.iter().zip(&made.errors) {
            errors[node as usize] = error;
        }
        spots.push(made.spots);
        pieces.push(made.piece);
        components.push(made.report);
    }
    let patchworks: Vec<Patchwork> = pieces
        .iter()
        .zip(&bodies)
        .map(|(piece, body)| Patchwork {
            layout: &piece.layout,
            surfaces: &piece.surfaces,
            planes: Some(&piece.planes),
            labels: &piece.labels,
            void_in: body.void_in,
        })
        .collect_vec();
    let stitched: PatchModel = of_patches(&patchworks, options.level_spread)?;
    for (number, (body, of_body)) in bodies.iter().zip(&spots).enumerate() {
        for (&node, spot) in body.nodes.iter().zip(of_body) {
            places[node as usize] = spot.map(|spot| match spot {
                Spot::Patch(place) => (stitched.face_at(number, place), place.uv),
                Spot::Plane(plane, uv) => (stitched.plane_at(number, plane), uv),
            });
        }
    }
    let mut report = together(mesh, &components, &errors);
    let has_planes = components.iter().any(|component| component.exact_faces > 0);
    if has_planes && stitched.model.free_edge_count() == 0 {
        report.volume = stitched.model.measure().volume;
    }
    // fields are fitted over patches that are smooth across all their edges
    let is_smooth = pieces
        .iter()
        .all(|piece| (0..piece.layout.edges().len() as u32).all(|edge| piece.layout.is_smooth(edge)));
    let origin = Origin {
        nodes: origins(&places, &errors),
        pieces: pieces.iter().filter(|_| is_smooth).map(Piece::origin).collect_vec(),
        patch_of_face: if is_smooth { stitched.patch_of_face() } else { Vec::new() },
    };
    let model = stitched.model.with_origin(origin)?;
    Ok(ModelFit { model, pieces, places, errors, components, report, seconds: 0.0 })
}

/// A mesh with a border as shells of exact faces, if they explain all of it.
fn open_parts(
    mesh: &Mesh,
    options: &MeshModelOptions,
    control: &mut Control,
) -> Result<Option<ModelFit>, ModelFitError> {
    if !options.exact || options.family != Family::Auto || mesh.component_count() > bodies::MAX_COMPONENTS {
        return Ok(None);
    }
    options.features.check(mesh)?;
    let (value, _) = options.fit.tolerance.absolute(&mesh.bounds());
    exact_parts(mesh, &bodies::shells(mesh), value, options, control)
}

/// Exact faces, if they explain all bodies.
fn exact_parts(
    mesh: &Mesh,
    bodies: &[Body],
    tolerance: f64,
    options: &MeshModelOptions,
    control: &mut Control,
) -> Result<Option<ModelFit>, ModelFitError> {
    let mut fits: Vec<ExactFit> = Vec::new();
    for body in bodies {
        let (labels, sharp_edges) = of_body(&options.features, body);
        let features = FeatureOptions { labels: &labels, sharp_edges: &sharp_edges, ..options.features };
        let part = (&body.mesh, body.facets());
        match control.watch(|pool, _| exact::fit_exact_by(part, tolerance, &features, pool))? {
            Ok(fit) => fits.push(fit),
            Err(Obstacle::Features(error)) => return Err(error.into()),
            Err(Obstacle::Cancelled(cancelled)) => return Err(cancelled.into()),
            // what is not exact throughout is left to patches
            Err(_) => return Ok(None),
        }
    }
    let role = |body: &Body| match body.void_in {
        Some(solid) => Role::VoidIn(ShellId::new(solid as u32)),
        None if body.mesh.loops().is_empty() => Role::Solid,
        None => Role::Open,
    };
    let roles: Vec<Role> = bodies.iter().map(role).collect_vec();
    let (model, starts) = exact::together(&fits.iter().collect::<Vec<_>>(), &roles)?;
    let mut places = memory::filled(None, mesh.points().len());
    let mut errors = memory::filled(f64::NAN, mesh.points().len());
    let mut components = Vec::new();
    for ((body, fit), start) in bodies.iter().zip(&fits).zip(starts) {
        for ((&node, place), &error) in body.nodes.iter().zip(&fit.places).zip(&fit.errors) {
            let moved = |(face, uv): (FaceId, DVec2)| (FaceId::new((face.index() + start) as u32), uv);
            places[node as usize] = place.map(moved);
            errors[node as usize] = error;
        }
        components.push(ComponentReport {
            genus: body.mesh.genus(),
            layout: None,
            exact_faces: fit.model.faces().len(),
            map_energy: f64::NAN,
            fold_count: 0,
            void_in: body.void_in,
            is_turned: body.is_turned,
            rounds_edges: false,
            map_seconds: 0.0,
            fit: fit.report.clone(),
        });
    }
    let report = together(mesh, &components, &errors);
    let nodes = origins(&places, &errors);
    let model = model.with_origin(Origin { nodes, pieces: Vec::new(), patch_of_face: Vec::new() })?;
    Ok(Some(ModelFit { model, pieces: Vec::new(), places, errors, components, report, seconds: 0.0 }))
}

/// The labels and sharp edges of a body, by its own triangles and nodes.
fn of_body(features: &FeatureOptions, body: &Body) -> (Vec<u32>, Vec<[u32; 2]>) {
    let label = |&triangle: &u32| features.labels.get(triangle as usize).copied();
    let labels = body.triangles.iter().filter_map(label).collect_vec();
    // nodes of a part keep their order
    let own = |node: u32| body.nodes.binary_search(&node).ok().map(|node| node as u32);
    let both = |&[a, b]: &[u32; 2]| Some([own(a)?, own(b)?]);
    (labels, features.sharp_edges.iter().filter_map(both).collect_vec())
}

/// One component: over its features or smooth, whichever serves first, or else the better of both.
fn component(
    body: &Body,
    options: &MeshModelOptions,
    control: &mut Control,
) -> Result<Component, ModelFitError> {
    let is_open = !body.mesh.loops().is_empty();
    if !is_open && !asks_for_features(options) {
        return smooth(body, options, control);
    }
    let found = BodyFeatures::find(body, options, control)?;
    if is_open {
        return over_found(body, &found, options, control)?.ok_or_else(|| open_body(body));
    }
    let rounds_edges = found.all.regions(&body.mesh).regions.len() > 1;
    let rounded = |control: &mut Control| {
        let mut made = smooth(body, options, control)?;
        made.report.rounds_edges = rounds_edges;
        Ok(made)
    };
    // the cube's edges lie anywhere
    if options.layout.kind == LayoutKind::Cube {
        return rounded(control);
    }
    let over_edges = |control: &mut Control| over_found(body, &found, options, control);
    let rounded = |control: &mut Control| rounded(control).map(Some);
    let ways: [Way<Component>; 2] = match are_texture(&found.all, options) {
        true => [(0.5, &rounded), (0.5, &over_edges)],
        false => [(0.5, &over_edges), (0.5, &rounded)],
    };
    let better = |made: Component, best: Component| {
        if is_better_both_ways(&best.report.fit, &made.report.fit) { best } else { made }
    };
    first_done(&ways, is_done, better, control)
}

/// What of a body may stay sharp.
struct BodyFeatures {
    /// Labels of its triangles, or none.
    labels: Vec<u32>,
    /// Edges that are sharp.
    sharp: Features,
    /// These and blunt ones.
    all: Features,
}

impl BodyFeatures {
    fn find(body: &Body, options: &MeshModelOptions, control: &mut Control) -> Result<Self, ModelFitError> {
        let (labels, sharp_edges) = of_body(&options.features, body);
        let mut find = |find_blunt: bool| {
            let features =
                FeatureOptions { labels: &labels, sharp_edges: &sharp_edges, find_blunt, ..options.features };
            control.watch(|pool, _| body.mesh.find_features_by(body.facets(), &features, pool))
        };
        let (sharp, all) = (find(false)??, find(options.features.find_blunt)??);
        Ok(Self { labels, sharp, all })
    }
}

/// One component over its features: those that are sharp, and where nothing good comes of them, blunt ones too. None if they
/// part nothing.
fn over_found(
    body: &Body,
    found: &BodyFeatures,
    options: &MeshModelOptions,
    control: &mut Control,
) -> Result<Option<Component>, ModelFitError> {
    let BodyFeatures { labels, sharp, all } = found;
    let fit = |features: &Features, control: &mut Control| {
        over_features(body, (features, labels), options, control)
    };
    if (&sharp.chains, &sharp.corners) == (&all.chains, &all.corners) {
        return fit(sharp, control);
    }
    let over_sharp = match control.within(0.0, 0.5, |control| fit(sharp, control)) {
        Ok(Some(made)) if !is_done(&made) => Some(made),
        Err(error) if error.kind() != ErrorKind::Cancelled => None,
        Ok(None) => None,
        done => return done,
    };
    let over_all = match control.within(0.5, 1.0, |control| fit(all, control)) {
        Err(error) if error.kind() != ErrorKind::Cancelled && over_sharp.is_some() => None,
        made => made?,
    };
    Ok(match (over_sharp, over_all) {
        (Some(sharp), Some(all))
            if !is_done(&all) && !is_better_both_ways(&all.report.fit, &sharp.report.fit) =>
        {
            Some(sharp)
        }
        (sharp, all) => all.or(sharp),
    })
}

fn open_body(body: &Body) -> ModelFitError {
    let loops = body.mesh.loops();
    ModelFitError::Open { loops: loops.len(), node: loops[0][0] as usize }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn ragged_borders_serve_where_features_do_not() {
        let ball = crate::samples::ball(3000, 1).unwrap();
        let is_kept = |triangle: &&[u32; 3]| {
            let middle = triangle.iter().map(|&node| ball.points()[node as usize]).sum::<DVec3>() / 3.0;
            let holes = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::Z];
            holes.iter().all(|hole| middle.distance(*hole) > 0.4)
        };
        let triangles: Vec<[u32; 3]> = ball.triangles().iter().filter(is_kept).copied().collect();
        let mesh = Mesh::new(ball.points().to_vec(), triangles).unwrap();
        assert_eq!(mesh.loops().len(), 4);
        let tolerance = Tolerance { value: 1e-2, ..Tolerance::default() };
        let fit = super::super::ModelOptions::default().with_tolerance(tolerance);
        let options = MeshModelOptions { fit, ..MeshModelOptions::default() };
        let made = over_borders(&mesh, &options, &mut Control::new(2)).unwrap().unwrap();
        assert!(made.components[0].rounds_edges && made.components[0].fold_count == 0);
        let finer = MeshModelOptions { layout: options.layout.with_patches(80), ..options };
        let finer = over_borders(&mesh, &finer, &mut Control::new(2)).unwrap().unwrap();
        assert!(finer.report.patches.len() > made.report.patches.len());
        let tolerance = made.report.tolerance;
        assert!(tolerance > 0.0 && made.errors.iter().all(|error| !(*error > tolerance)));
    }
}
