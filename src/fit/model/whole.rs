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
use super::creased::over_features;
use super::error::ModelFitError;
use super::exact::{self, ExactFit, Obstacle};
use super::mesh_model::{
    Component, ComponentReport, Family, MeshModelOptions, ModelFit, Piece, Spot, origins, together,
};
use super::{ModelReport, NodePlaces, fit_over_layout};
use crate::control::{Cancelled, Control};
use crate::failure::{Classify, ErrorKind};
use crate::fit::common::report::{FitReport, Remarks, Tolerance, ToleranceScale};
use crate::fit::pht::{self, PhtOptions};
use crate::layout::Layout;
use crate::layout::of_mesh::{LayoutKind, MeshLayout, MeshLayoutError, MeshLayoutOptions, layout_of_mesh};
use crate::memory::{self, CollectVec};
use crate::mesh::{FeatureOptions, Features, Mesh};
use crate::model::{
    FaceId, Form, FormOptions, Origin, PatchModel, Patchwork, Role, ShellId, of_patches, of_surface,
};
use crate::parameterize::sphere::{SphereOptions, map_to_sphere};
use crate::query::crossings::crossings;
use crate::query::tessellate::TessellateOptions;
use crate::surface::AnySurface;
use glam::DVec2;
use std::cell::Cell;
use std::cmp::Ordering;
use std::f64::consts::PI;
use std::time::Instant;

/// Makes a model of a mesh.
pub fn fit_mesh(
    mesh: &Mesh,
    options: &MeshModelOptions,
    control: &mut Control,
) -> Result<ModelFit, ModelFitError> {
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
    fit.seconds = start.elapsed().as_secs_f64();
    Ok(fit)
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
    if mesh.component_count() > bodies::MAX_COMPONENTS || !asks_for_features(options) {
        return chart(mesh, options, control);
    }
    let features = mesh.find_features(&options.features)?;
    if features.edges.len() == features.border_count && mesh.loops().len() == 1 {
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
    let better =
        |made: ModelFit, best: ModelFit| if is_better(&made.report, &best.report) { made } else { best };
    first_done(&ways, |fit| is_good(&fit.report), better, control)
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

/// Whether a fit is all that was asked for.
fn is_good(report: &ModelReport) -> bool {
    !report.remarks.has(Remarks::TOLERANCE_NOT_MET) && report.folded_cells == 0
}

/// Whether a component is all that was asked for, or that noise lets be had.
fn is_done(made: &Component) -> bool {
    made.misses_noise_only || is_good(&made.report.fit)
}

/// Whether a fit is better than another: without folds, then with fewer where both are near enough, then nearer to the nodes.
fn is_better(report: &ModelReport, other: &ModelReport) -> bool {
    let is_near = |report: &ModelReport| report.max_error <= report.tolerance;
    match (report.folded_cells == 0, other.folded_cells == 0) {
        (true, false) => report.max_error <= NEARLY * other.max_error,
        (false, true) => NEARLY * report.max_error < other.max_error,
        (false, false) if is_near(report) && is_near(other) => report.folded_cells <= other.folded_cells,
        _ => report.max_error <= other.max_error,
    }
}

/// A fit with folds has to be so many times nearer to be preferred.
const NEARLY: f64 = 4.0;

/// Share of a component's time in which its map is made.
const MAP_SHARE: f64 = 0.4;

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
    if !is_open && (!asks_for_features(options) || options.layout.kind != LayoutKind::Auto) {
        return smooth(body, options, control);
    }
    let found = BodyFeatures::find(body, options, control)?;
    if is_open {
        return over_found(body, &found, options, control)?.ok_or_else(|| open_body(body));
    }
    let rounds_edges = found.all.regions(&body.mesh).regions.len() > 1;
    let over_edges = |control: &mut Control| over_found(body, &found, options, control);
    let rounded = |control: &mut Control| {
        let mut made = smooth(body, options, control)?;
        made.report.rounds_edges = rounds_edges;
        Ok(Some(made))
    };
    let ways: [Way<Component>; 2] = match are_texture(&found.all, options) {
        true => [(0.5, &rounded), (0.5, &over_edges)],
        false => [(0.5, &over_edges), (0.5, &rounded)],
    };
    let better = |made: Component, best: Component| {
        if is_better(&best.report.fit, &made.report.fit) { best } else { made }
    };
    first_done(&ways, is_done, better, control)
}

/// A way to make something, which may have nothing to do, and its share of the time.
type Way<'a, Made> = (f64, &'a dyn Fn(&mut Control) -> Result<Option<Made>, ModelFitError>);

/// What the first way makes that does all that was asked for, or else the best of all; one at least has something to do.
fn first_done<Made>(
    ways: &[Way<Made>],
    is_done: impl Fn(&Made) -> bool,
    better: impl Fn(Made, Made) -> Made,
    control: &mut Control,
) -> Result<Made, ModelFitError> {
    let (mut best, mut failure) = (None, None);
    let mut from = 0.0;
    for (share, way) in ways {
        let to = from + share;
        match control.within(from, to, |control| way(control)) {
            Ok(Some(made)) if is_done(&made) => return Ok(made),
            Ok(Some(made)) => {
                best = Some(match best {
                    Some(best) => better(made, best),
                    None => made,
                })
            }
            Ok(None) => {}
            Err(error) if error.kind() == ErrorKind::Cancelled => return Err(error),
            Err(error) => failure = Some(error),
        }
        from = to;
    }
    best.ok_or_else(|| failure.expect("one way has something to do"))
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
        (Some(sharp), Some(all)) if !is_done(&all) && !is_better(&all.report.fit, &sharp.report.fit) => {
            Some(sharp)
        }
        (sharp, all) => all.or(sharp),
    })
}

fn open_body(body: &Body) -> ModelFitError {
    let loops = body.mesh.loops();
    ModelFitError::Open { loops: loops.len(), node: loops[0][0] as usize }
}

/// A body without sharp edges: over the cube, over a base complex, or the better of both.
fn smooth(
    body: &Body,
    options: &MeshModelOptions,
    control: &mut Control,
) -> Result<Component, ModelFitError> {
    let is_simple = body.mesh.genus() == 0;
    match options.layout.kind {
        LayoutKind::Cube => over_cube(body, options, control),
        LayoutKind::Complex => over_complex(body, options, control),
        LayoutKind::Auto if !is_simple => over_complex(body, options, control),
        LayoutKind::Auto => {
            let cube = control.within(0.0, 0.5, |control| over_cube(body, options, control))?;
            if is_good(&cube.report.fit) {
                return Ok(cube);
            }
            // patches that follow the limbs may do what six cannot
            match control.within(0.5, 1.0, |control| over_complex(body, options, control)) {
                Ok(complex) if !is_better(&cube.report.fit, &complex.report.fit) => Ok(complex),
                Err(error) if error.kind() == ErrorKind::Cancelled => Err(error),
                _ => Ok(cube),
            }
        }
    }
}

fn over_cube(
    body: &Body,
    options: &MeshModelOptions,
    control: &mut Control,
) -> Result<Component, ModelFitError> {
    let map = |control: &mut Control| map_to_sphere(&body.mesh, &SphereOptions::default(), control);
    let sphere = control.within(0.0, MAP_SHARE, map)?;
    let layout = Layout::cube();
    let places = NodePlaces::Sphere(&sphere.points);
    let fit = control.within(MAP_SHARE, 1.0, |control| {
        fit_over_layout(&body.mesh, &layout, places, &options.fit, control)
    })?;
    let report = ComponentReport {
        genus: 0,
        layout: Some(LayoutKind::Cube),
        exact_faces: 0,
        map_energy: sphere.report.energy,
        fold_count: sphere.report.folded_triangles,
        void_in: body.void_in,
        is_turned: body.is_turned,
        rounds_edges: false,
        map_seconds: sphere.report.seconds,
        fit: fit.report.clone(),
    };
    Ok(Component::smooth(layout, fit, report))
}

/// Over a base complex. Where the fit nearly does, a few with other numbers of patches are tried, and the best is kept: what is
/// left out of reach, or folds, lies at a few places where the patches lie badly.
fn over_complex(
    body: &Body,
    options: &MeshModelOptions,
    control: &mut Control,
) -> Result<Component, ModelFitError> {
    let mut others = other_counts(&body.mesh, &options.layout).into_iter();
    let made = control.within(0.0, MAP_SHARE, |control| {
        unfolded_complex(&body.mesh, &options.layout, &mut others, control)
    })?;
    let mut best =
        control.within(MAP_SHARE, FIRST_FIT, |control| fit_complex(body, made, options, control))?;
    for rank in 0..MORE_FITS {
        let Some(other) = others.next().filter(|_| nearly_serves(&best.report)) else { break };
        let [from, to] =
            [rank, rank + 1].map(|k| FIRST_FIT + (1.0 - FIRST_FIT) * k as f64 / MORE_FITS as f64);
        let made = control.within(from, to, |control| -> Result<_, ModelFitError> {
            let made =
                control.within(0.0, MAP_SHARE, |control| layout_of_mesh(&body.mesh, &other, control))?;
            control.within(MAP_SHARE, 1.0, |control| fit_complex(body, made, options, control))
        });
        match made {
            Ok(made) if is_better_component(&made.report, &best.report) => best = made,
            Err(error) if error.kind() == ErrorKind::Cancelled => return Err(error),
            // the best so far will do
            _ => {}
        }
    }
    Ok(best)
}

/// Whether other patches may make of a fit what was asked for.
fn nearly_serves(report: &ComponentReport) -> bool {
    let is_near = report.fit.max_error <= WITHIN_REACH * report.fit.tolerance;
    is_near && !(is_good(&report.fit) && report.fold_count == 0)
}

/// Whether one component over a base complex is better than another: by the folds of its map, then by its fit.
fn is_better_component(report: &ComponentReport, other: &ComponentReport) -> bool {
    match report.fold_count.cmp(&other.fold_count) {
        Ordering::Equal => !is_better(&other.fit, &report.fit),
        order => order == Ordering::Less,
    }
}

/// Fits with other numbers of patches, at most.
const MORE_FITS: usize = 3;

/// So many tolerances may be missed by that other patches are worth their time.
const WITHIN_REACH: f64 = 2.0;

/// Share of a component's time for the number of patches that is asked for.
const FIRST_FIT: f64 = 0.5;

/// A fit over a base complex.
fn fit_complex(
    body: &Body,
    made: MeshLayout,
    options: &MeshModelOptions,
    control: &mut Control,
) -> Result<Component, ModelFitError> {
    let fit = fit_over_layout(&body.mesh, &made.layout, NodePlaces::Map(&made.map), &options.fit, control)?;
    let report = ComponentReport {
        genus: body.mesh.genus(),
        layout: Some(LayoutKind::Complex),
        exact_faces: 0,
        map_energy: made.report.energy,
        fold_count: made.report.folded_nodes,
        void_in: body.void_in,
        is_turned: body.is_turned,
        rounds_edges: false,
        map_seconds: made.report.seconds,
        fit: fit.report.clone(),
    };
    Ok(Component::smooth(made.layout, fit, report))
}

/// So many times as many patches are tried one after the other: over coarse meshes with handles numbers near the fewest that
/// these need have folds, and most larger ones have none.
const OTHER_COUNTS: [f64; 7] = [1.25, 1.6, 2.0, 0.85, 2.5, 3.0, 4.0];

/// Nodes a patch: fewer say too little of where it lies.
const NODES_PER_PATCH: usize = 8;

/// Base complexes with other numbers of patches.
fn other_counts(mesh: &Mesh, options: &MeshLayoutOptions) -> Vec<MeshLayoutOptions> {
    let most = options.patches.max(mesh.points().len() / NODES_PER_PATCH);
    let patches = OTHER_COUNTS.into_iter().map(|times| (times * options.patches as f64).round() as usize);
    patches.filter(|&count| count <= most).map(|count| complex(options).with_patches(count)).collect()
}

fn complex(options: &MeshLayoutOptions) -> MeshLayoutOptions {
    options.with_kind(LayoutKind::Complex)
}

/// A base complex; where it folds nodes, the one of another number of patches that folds fewest.
fn unfolded_complex(
    mesh: &Mesh,
    options: &MeshLayoutOptions,
    others: &mut std::vec::IntoIter<MeshLayoutOptions>,
    control: &mut Control,
) -> Result<MeshLayout, MeshLayoutError> {
    let make = |control: &mut Control| layout_of_mesh(mesh, &complex(options), control);
    let mut best = control.within(0.0, FIRST_COUNT, make)?;
    let count = others.len();
    while best.report.folded_nodes > 0
        && let Some(other) = others.next()
    {
        let rest = others.len();
        let [from, to] = [rest + 1, rest].map(|left| 1.0 - (1.0 - FIRST_COUNT) * left as f64 / count as f64);
        match control.within(from, to, |control| layout_of_mesh(mesh, &other, control)) {
            Ok(made) if made.report.folded_nodes < best.report.folded_nodes => best = made,
            Err(MeshLayoutError::Cancelled(cancelled)) => return Err(cancelled.into()),
            // the best so far will do
            _ => {}
        }
    }
    Ok(best)
}

/// Share of a map's time for the number of patches that is asked for.
const FIRST_COUNT: f64 = 0.5;

/// An open mesh of one piece as one surface inside its trims.
fn chart(mesh: &Mesh, options: &MeshModelOptions, control: &mut Control) -> Result<ModelFit, ModelFitError> {
    let pht_options = PhtOptions { tolerance: options.fit.tolerance, ..PhtOptions::default() };
    let fit = pht::fit_mesh(mesh, &pht_options, control)?;
    let form =
        FormOptions { form: Form::Patches, level_spread: options.level_spread, ..FormOptions::default() };
    let surface = AnySurface::Pht(fit.surface);
    let model = of_surface(&surface, &form, control.pool().watch())?;
    let face_at = |uv: DVec2| {
        let holds = |&face: &FaceId| model.carrier(face).domain().is_some_and(|domain| domain.contains(uv));
        model.face_ids().find(holds)
    };
    let places: Vec<Option<(FaceId, DVec2)>> = (0..mesh.points().len() as u32)
        .zip(&fit.parameters)
        .map(|(node, &uv)| Some((face_at(uv).filter(|_| mesh.is_used(node))?, uv)))
        .collect_vec();
    let report = of_chart(&fit.report);
    let component = ComponentReport {
        genus: mesh.genus(),
        layout: None,
        exact_faces: 0,
        map_energy: f64::NAN,
        fold_count: fit.report.flipped_count,
        void_in: None,
        is_turned: false,
        rounds_edges: false,
        map_seconds: fit.report.parameterize_seconds,
        fit: report.clone(),
    };
    let components = vec![component];
    let nodes = origins(&places, &fit.errors);
    let model = model.with_origin(Origin { nodes, pieces: Vec::new(), patch_of_face: Vec::new() })?;
    Ok(ModelFit { model, pieces: Vec::new(), places, errors: fit.errors, components, report, seconds: 0.0 })
}

fn of_chart(fit: &FitReport) -> ModelReport {
    ModelReport {
        max_error: fit.max_error,
        rms_error: fit.rms_error,
        mean_error: fit.mean_error,
        worst_node: fit.worst_index,
        tolerance: fit.tolerance,
        diagonal: fit.diagonal,
        max_interior_error: fit.max_interior_error,
        facet_sagitta: fit.facet_sagitta,
        max_back_distance: f64::NAN,
        volume: f64::NAN,
        mesh_volume: f64::NAN,
        coefficient_count: fit.coefficient_count,
        free_count: fit.coefficient_count,
        cell_count: fit.cell_count,
        deepest_level: fit.deepest_level,
        passes: fit.passes,
        stop: fit.stop,
        remarks: fit.remarks,
        fit_seconds: fit.seconds - fit.parameterize_seconds,
        ..ModelReport::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn the_first_way_that_serves_is_taken_or_else_the_best() {
        let made = |value: f64| move |_: &mut Control| Ok(Some(value));
        let nothing = |_: &mut Control| Ok(None);
        let fails = |_: &mut Control| Err(ModelFitError::Open { loops: 1, node: 0 });
        let [one, three, nine] = [made(1.0), made(3.0), made(9.0)];
        let take = |ways: &[Way<f64>]| first_done(ways, |made| *made > 8.0, f64::min, &mut Control::new(1));
        assert_eq!(take(&[(0.5, &three), (0.5, &one)]).unwrap(), 1.0);
        assert_eq!(take(&[(0.3, &three), (0.3, &nine), (0.4, &one)]).unwrap(), 9.0);
        assert_eq!(take(&[(0.3, &fails), (0.3, &nothing), (0.4, &one)]).unwrap(), 1.0);
        assert!(take(&[(0.5, &fails), (0.5, &nothing)]).is_err());
        let cancels = |_: &mut Control| Err(Cancelled.into());
        assert!(take(&[(0.5, &one), (0.5, &cancels)]).is_err());
    }

    #[test]
    fn other_numbers_of_patches_serve_where_the_first_nearly_does() {
        let (_, mesh) = crate::samples::closed::seeded_block(1).unwrap();
        let fit = super::super::ModelOptions::default();
        let options = MeshModelOptions { fit, ..MeshModelOptions::default() };
        let body = &bodies(&mesh).unwrap()[0];
        let first = {
            let made = layout_of_mesh(&body.mesh, &complex(&options.layout), &mut Control::new(2)).unwrap();
            fit_complex(body, made, &options, &mut Control::new(2)).unwrap().report
        };
        assert!(
            first.fit.max_error > first.fit.tolerance && nearly_serves(&first),
            "{:?}",
            first.fit.max_error
        );
        let best = over_complex(body, &options, &mut Control::new(2)).unwrap().report;
        assert!(best.fit.max_error <= best.fit.tolerance, "{:?}", best.fit.max_error);
        assert_ne!(best.fit.patches.len(), first.fit.patches.len());
    }

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
        let tolerance = made.report.tolerance;
        assert!(tolerance > 0.0 && made.errors.iter().all(|error| !(*error > tolerance)));
    }
}
