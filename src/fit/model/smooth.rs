//! A body without sharp edges as patches: over the cube, or over a base complex of as many patches as serve.

use super::bodies::Body;
use super::error::ModelFitError;
use super::mesh_model::{Component, ComponentReport, MeshModelOptions};
use super::ways::{is_better, is_good};
use super::{NodePlaces, fit_over_layout};
use crate::control::Control;
use crate::failure::{Classify, ErrorKind};
use crate::layout::Layout;
use crate::layout::of_mesh::{LayoutKind, MeshLayout, MeshLayoutError, MeshLayoutOptions, layout_of_mesh};
use crate::mesh::Mesh;
use crate::parameterize::sphere::{SphereOptions, map_to_sphere};
use std::cmp::Ordering;

/// Share of a component's time in which its map is made.
const MAP_SHARE: f64 = 0.4;

/// A body without sharp edges: over the cube, over a base complex, or the better of both.
pub(super) fn smooth(
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
    let map = MapReport {
        kind: LayoutKind::Cube,
        energy: sphere.report.energy,
        fold_count: sphere.report.folded_triangles,
        seconds: sphere.report.seconds,
    };
    let places = NodePlaces::Sphere(&sphere.points);
    control.within(MAP_SHARE, 1.0, |control| fit_over(body, Layout::cube(), places, map, options, control))
}

/// How a map over a layout came out.
struct MapReport {
    kind: LayoutKind,
    energy: f64,
    fold_count: usize,
    seconds: f64,
}

/// A fit over a layout whose map is made.
fn fit_over(
    body: &Body,
    layout: Layout,
    places: NodePlaces,
    map: MapReport,
    options: &MeshModelOptions,
    control: &mut Control,
) -> Result<Component, ModelFitError> {
    let fit = fit_over_layout(&body.mesh, &layout, places, &options.fit, control)?;
    let report = ComponentReport {
        genus: body.mesh.genus(),
        layout: Some(map.kind),
        exact_faces: 0,
        map_energy: map.energy,
        fold_count: map.fold_count,
        void_in: body.void_in,
        is_turned: body.is_turned,
        rounds_edges: false,
        map_seconds: map.seconds,
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
    let MeshLayout { layout, map, report } = made;
    let of_map = MapReport {
        kind: LayoutKind::Complex,
        energy: report.energy,
        fold_count: report.folded_nodes,
        seconds: report.seconds,
    };
    fit_over(body, layout, NodePlaces::Map(&map), of_map, options, control)
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

#[cfg(test)]
mod tests {
    use super::super::bodies::bodies;
    use super::*;

    #[test]
    fn other_numbers_of_patches_serve_where_the_first_nearly_does() {
        let (_, mesh) = crate::samples::closed::seeded_block(1).unwrap();
        let options = MeshModelOptions::default();
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
}
