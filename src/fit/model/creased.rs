//! Parts with sharp edges: patches over the curved regions of a mesh, one face for each plane, the same curves between
//! them (docs/theory.md, models of many patches).
//!
//! ```text
//! regions between features, some of them planes
//! layout over the others, cut open along creases
//! fit with the creases in their planes
//! planes bounded by those creases and by straight lines
//! ```
//! Where noise hides planes, nodes lie about as far from them as it moves them, with no bend beyond that. The tolerance of
//! the patches beside them then grows to what noise does to nodes, and the report tells what is missed.
//!
//! A plane keeps its exact face if each side of its loops is a crease of patches or straight; else it gets patches, as
//! where a border of the mesh curves.

use super::bodies::Body;
use super::constraints::{Constraints, PlaneEquation, nearest_in};
use super::error::ModelFitError;
use super::exact::evidence::Evidence;
use super::exact::{Limits, MOST_NOISE, mean_edge};
use super::mesh_model::{Component, ComponentReport, MeshModelOptions, Piece, Spot};
use super::options::ModelOptions;
use super::report::mesh_volume;
use super::{LayoutFit, NodePlaces, fit_with_creases};
use crate::control::Control;
use crate::failure::{Classify, ErrorKind};
use crate::fit::common::report::{Remarks, StopReason, Tolerance, ToleranceScale};
use crate::layout::HalfEdge;
use crate::layout::of_features::{
    FeatureLayout, FeatureLayoutError, FeatureLayoutOptions, VertexSource, layout_of_features,
};
use crate::layout::of_mesh::LayoutKind;
use crate::linalg::Symmetric2;
use crate::mesh::{Features, Mesh, Region, Regions, Side};
use crate::model::{
    Carrier, Frame, ModelError, Patchwork, Plane, PlaneFace, Planes, Rim, RimVertex, of_patches,
};
use crate::summary::summarize;
use glam::{DVec2, DVec3};
use std::collections::{BTreeMap, BTreeSet};

/// Share of the time in which the layout is made.
const LAYOUT_SHARE: f64 = 0.4;
/// Energy of creased fits: ten times that of smooth ones keeps narrow patches beside corners from folding.
const SMOOTHING: f64 = 1e-3;
/// A region is a plane if its nodes lie within this part of the tolerance of one: what the other errors leave.
const PLANE_SHARE: f64 = 1.0 / 3.0;
/// Nodes beside planes that noise hides may be off by this many deviations of it, as beside exact faces.
const NOISE: f64 = 5.0;

/// A body as patches and planes, which make a model; none if its features part nothing. With them come the labels of its
/// triangles, or none.
pub(super) fn over_features(
    body: &Body,
    (features, labels): (&Features, &[u32]),
    options: &MeshModelOptions,
    control: &mut Control,
) -> Result<Option<Component>, ModelFitError> {
    let mesh = &body.mesh;
    let regions = features.regions(mesh);
    let is_parted = regions.regions.len() > 1 || !mesh.loops().is_empty();
    let (tolerance, _) = options.fit.tolerance.absolute(&mesh.bounds());
    if !is_parted {
        return Ok(None);
    }
    let mut planes: Vec<Option<PlaneEquation>> =
        regions.regions.iter().map(|region| plane_of(mesh, region, PLANE_SHARE * tolerance)).collect();
    if planes.iter().all(Option::is_some) {
        planes[simplest(&regions)] = None;
    }
    let part = Part { mesh, features, regions: &regions, labels };
    let layout = FeatureLayoutOptions { patches: options.layout.patches, sweeps: options.layout.sweeps };
    let fit = |planes, fit_options: &ModelOptions, control: &mut Control| {
        let component = part.fit(planes, (fit_options, &layout), control)?.component(body, &part, tolerance);
        check_shell(&component.piece, mesh.loops().is_empty(), options.level_spread)?;
        Ok::<Component, ModelFitError>(component)
    };
    let noise = regions.noise(mesh).min(MOST_NOISE) * mean_edge(mesh);
    let Some((more_planes, rms)) = part.planes_under_noise(&planes, &Limits::new(tolerance, noise)) else {
        return fit(planes, &options.fit, control).map(Some);
    };
    // planes miss their nodes by noise, and so do the patches at their common edges; the estimate may hold blunt edges too
    let allowed = Tolerance { value: tolerance.max(NOISE * rms), scale: ToleranceScale::Absolute };
    let fit_options = options.fit.with_tolerance(allowed);
    match control.within(0.0, 0.5, |control| fit(more_planes, &fit_options, control)) {
        Ok(made) if made.misses_noise_only => Ok(Some(made)),
        Err(error) if error.kind() == ErrorKind::Cancelled => Err(error),
        // with fewer planes that region gets patches too
        Err(ModelFitError::Regions(error @ FeatureLayoutError::NoLayout { .. })) => Err(error.into()),
        _ => control.within(0.5, 1.0, |control| fit(planes, &options.fit, control)).map(Some),
    }
}

/// The region that is most like a quadrilateral: where all are flat that one becomes a patch, as a layout has one at least.
fn simplest(regions: &Regions) -> usize {
    let sides = |region: &usize| {
        let loops = &regions.regions[*region].loops;
        (loops.len(), loops.iter().flatten().count().abs_diff(4))
    };
    (0..regions.regions.len()).min_by_key(sides).unwrap_or(0)
}

/// Refuses patches and planes that do not make one shell, closed where the mesh is.
fn check_shell(piece: &Piece, is_closed: bool, level_spread: u32) -> Result<(), ModelError> {
    let Piece { layout, surfaces, planes, labels } = piece;
    let patchwork = Patchwork { layout, surfaces, planes: Some(planes), labels, void_in: None };
    let model = of_patches(&[patchwork], level_spread)?.model;
    match model.edge_ids().find(|&edge| model.is_free(edge)) {
        Some(edge) if is_closed => Err(ModelError::FreeEdge { shell: 0, edge: edge.index() }),
        _ => Ok(()),
    }
}

/// The plane of a region whose nodes all lie within a distance of it: least squares over its plane of mean normals.
fn plane_of(mesh: &Mesh, region: &Region, distance: f64) -> Option<PlaneEquation> {
    let corners = |&triangle: &u32| mesh.triangles()[triangle as usize];
    let nodes: BTreeSet<u32> = region.triangles.iter().flat_map(corners).collect();
    let points: Vec<DVec3> = nodes.iter().map(|&node| mesh.points()[node as usize]).collect();
    let area = |triangle: &u32| {
        let [a, b, c] = corners(triangle).map(|node| mesh.points()[node as usize]);
        (b - a).cross(c - a)
    };
    let rough = region.triangles.iter().map(area).sum::<DVec3>().try_normalize()?;
    let middle = points.iter().sum::<DVec3>() / points.len() as f64;
    let (x, y) = rough.any_orthonormal_pair();
    // heights z = a x + b y over the rough plane, around the middle
    let sums = points.iter().fold([0.0; 5], |[xx, xy, yy, xz, yz], point| {
        let at = *point - middle;
        let (x, y, z) = (at.dot(x), at.dot(y), at.dot(rough));
        [xx + x * x, xy + x * y, yy + y * y, xz + x * z, yz + y * z]
    });
    let [xx, xy, yy, xz, yz] = sums;
    let slope = Symmetric2 { uu: xx, uv: xy, vv: yy }.solve(DVec2::new(xz, yz));
    let normal = (rough - slope.x * x - slope.y * y).try_normalize()?;
    let offset = normal.dot(middle);
    let is_on = |point: &DVec3| (normal.dot(*point) - offset).abs() <= distance;
    points.iter().all(is_on).then_some(PlaneEquation { normal, offset })
}

/// A part fitted over its regions.
struct CreasedFit {
    /// The layout over its curved regions.
    made: FeatureLayout,
    /// The patches; places and errors by node of the cut mesh.
    fit: LayoutFit,
    /// The faces beside them.
    planes: Planes,
    /// By plane face: its region and equation.
    of_planes: Vec<(u32, PlaneEquation)>,
}

impl CreasedFit {
    /// What is known by node of the whole, held against a tolerance.
    fn component(self, body: &Body, part: &Part, tolerance: f64) -> Component {
        let Self { made, fit, planes, of_planes } = self;
        let count = part.mesh.points().len();
        let (mut spots, mut errors) = (vec![None; count], vec![f64::NAN; count]);
        for (number, &(region, plane)) in of_planes.iter().enumerate() {
            let carrier = Carrier::Plane(planes.faces[number].plane);
            for &triangle in &part.regions.regions[region as usize].triangles {
                for node in part.mesh.triangles()[triangle as usize].map(|node| node as usize) {
                    let point = part.mesh.points()[node];
                    let distance = (plane.normal.dot(point) - plane.offset).abs();
                    if !(errors[node] >= distance) {
                        errors[node] = distance;
                        spots[node] = carrier.nearest(point).map(|uv| Spot::Plane(number, uv));
                    }
                }
            }
        }
        // a node of several faces has the place where it is farthest
        for ((&node, place), &error) in made.cut.nodes.iter().zip(&fit.places).zip(&fit.errors) {
            let node = node as usize;
            if let Some(place) = place
                && !(errors[node] > error)
            {
                (errors[node], spots[node]) = (error, Some(Spot::Patch(*place)));
            }
        }
        let known: Vec<f64> = errors.iter().copied().filter(|error| !error.is_nan()).collect();
        let summary = summarize(known);
        let worst = errors.iter().position(|&error| error == summary.max).unwrap_or(0);
        let mut report = fit.report;
        let misses_noise_only = report.max_error <= report.tolerance && report.folded_cells == 0;
        report.tolerance = tolerance;
        (report.max_error, report.rms_error, report.mean_error) = (summary.max, summary.rms, summary.mean);
        (report.worst_node, report.diagonal) = (worst, part.mesh.diagonal());
        report.mesh_volume = mesh_volume(part.mesh);
        let is_missed = report.max_error > tolerance;
        report.remarks.add_if(is_missed, Remarks::TOLERANCE_NOT_MET);
        let beyond_facets = report.max_interior_error - report.facet_sagitta;
        report.remarks.add_if(beyond_facets > tolerance, Remarks::ROUGH_BETWEEN_NODES);
        if is_missed && report.stop == StopReason::ToleranceMet {
            report.stop = StopReason::Stagnated;
        }
        let labels = part.labels_of_patches(&made.report.patches);
        let report = ComponentReport {
            genus: part.mesh.genus(),
            layout: Some(LayoutKind::Complex),
            exact_faces: planes.faces.len(),
            map_energy: made.report.energy,
            fold_count: made.report.folded_nodes,
            void_in: body.void_in,
            is_turned: body.is_turned,
            rounds_edges: false,
            map_seconds: made.report.seconds,
            fit: report,
        };
        let piece = Piece { layout: made.layout, surfaces: fit.surfaces, planes, labels };
        Component { piece, spots, errors, report, misses_noise_only }
    }
}

/// A mesh as its features part it.
#[derive(Clone, Copy)]
struct Part<'a> {
    mesh: &'a Mesh,
    features: &'a Features,
    regions: &'a Regions,
    /// By triangle, or none.
    labels: &'a [u32],
}

impl Part<'_> {
    /// The planes of regions, some found already, with those that nodes lie about as far from as noise moves them, and how
    /// far that is: the largest root of the mean square of theirs. None if there are no more of them.
    fn planes_under_noise(
        &self,
        found: &[Option<PlaneEquation>],
        limits: &Limits,
    ) -> Option<(Vec<Option<PlaneEquation>>, f64)> {
        let mut largest: f64 = 0.0;
        let mut plane_of = |region: &Region| {
            let evidence = Evidence::new(self.mesh, &region.triangles)?;
            let carrier = Carrier::Plane(evidence.plane()?);
            let Carrier::Plane(Plane(frame)) = &carrier else { return None };
            let is_plane = evidence.accepts(&carrier, limits) && evidence.is_straight(frame);
            let (normal, origin) = (frame.z(), frame.origin());
            if is_plane {
                largest = largest.max(evidence.rms(&carrier));
            }
            is_plane.then_some(PlaneEquation { normal, offset: normal.dot(origin) })
        };
        let both = found.iter().zip(&self.regions.regions);
        let planes: Vec<Option<PlaneEquation>> =
            both.map(|(plane, region)| plane.or_else(|| plane_of(region))).collect();
        (largest > 0.0).then_some((planes, largest))
    }

    /// Fits patches over the regions that are no planes.
    fn fit(
        &self,
        mut planes: Vec<Option<PlaneEquation>>,
        (options, layout): (&ModelOptions, &FeatureLayoutOptions),
        control: &mut Control,
    ) -> Result<CreasedFit, ModelFitError> {
        let Self { mesh, features, regions, .. } = *self;
        let (tolerance, _) = options.tolerance.absolute(&mesh.bounds());
        self.keep_bounded(&mut planes, tolerance);
        let has_patches: Vec<bool> = planes.iter().map(Option::is_none).collect();
        let made = control.within(0.0, LAYOUT_SHARE, |control| {
            layout_of_features(mesh, features, regions, &has_patches, layout, control)
        })?;
        let constraints = self.constraints(&made, &planes);
        let options = options.with_smoothing(options.smoothing.max(SMOOTHING));
        let fit = control.within(LAYOUT_SHARE, 1.0, |control| {
            let places = NodePlaces::Patches(made.map.places());
            fit_with_creases(&made.cut.mesh, &made.layout, places, &constraints, &options, control)
        })?;
        let of_planes: Vec<(u32, PlaneEquation)> =
            (0..).zip(&planes).filter_map(|(region, plane)| Some((region, (*plane)?))).collect();
        let planes = self.faces(&made, &of_planes);
        Ok(CreasedFit { made, fit, planes, of_planes })
    }

    /// Takes away planes whose loops cannot be made of creases of patches and straight lines, until none is left.
    fn keep_bounded(&self, planes: &mut [Option<PlaneEquation>], tolerance: f64) {
        loop {
            let is_bounded = |region: usize| {
                let sides = self.regions.regions[region].loops.iter().flatten();
                sides.into_iter().all(|side| match self.regions.across(side) {
                    Some(other) if other as usize == region => false,
                    Some(other) if planes[other as usize].is_none() => true,
                    _ => self.is_straight(side.chain, tolerance),
                })
            };
            let lost: Vec<usize> =
                (0..planes.len()).filter(|&region| planes[region].is_some() && !is_bounded(region)).collect();
            if lost.is_empty() {
                return;
            }
            lost.into_iter().for_each(|region| planes[region] = None);
        }
    }

    /// Whether a chain is a straight line from end to end.
    fn is_straight(&self, chain: u32, tolerance: f64) -> bool {
        let chain = &self.features.chains[chain as usize];
        let place = |node: u32| self.mesh.points()[node as usize];
        let [from, to] = [chain.nodes[0], chain.nodes[chain.nodes.len() - 1]].map(place);
        let Some(direction) = (to - from).try_normalize() else { return false };
        let off = |&node: &u32| (place(node) - from).reject_from_normalized(direction).length();
        !chain.is_closed && chain.nodes.iter().map(off).fold(0.0, f64::max) <= tolerance
    }

    /// The label of a region; 0 without labels.
    fn label(&self, region: u32) -> u32 {
        let first = self.regions.regions[region as usize].triangles[0];
        self.labels.get(first as usize).copied().unwrap_or(0)
    }

    /// The label of each patch, region after region; none without labels.
    fn labels_of_patches(&self, counts: &[usize]) -> Vec<u32> {
        let of_region = |(region, &count)| std::iter::repeat_n(self.label(region), count);
        if self.labels.is_empty() { Vec::new() } else { (0..).zip(counts).flat_map(of_region).collect() }
    }

    /// The planes of the regions around a node.
    fn planes_at(&self, node: u32, planes: &BTreeMap<u32, u32>) -> Vec<u32> {
        let around = self
            .mesh
            .outgoing(node)
            .filter_map(|edge| planes.get(&self.regions.of_triangle[edge.triangle()]).copied());
        let around: BTreeSet<u32> = around.collect();
        around.into_iter().collect()
    }

    fn constraints(&self, made: &FeatureLayout, planes: &[Option<PlaneEquation>]) -> Constraints {
        let mut constraints = Constraints::default();
        let mut numbers = BTreeMap::new();
        for (region, plane) in (0..).zip(planes) {
            if let Some(plane) = plane {
                numbers.insert(region, constraints.planes.len() as u32);
                constraints.planes.push(*plane);
            }
        }
        for (edge, span) in (0..).zip(&made.spans) {
            let Some(span) = span else { continue };
            let beside = self.regions.beside[span.chain as usize].into_iter().flatten();
            let of_edge = beside.filter_map(|region| numbers.get(&region).copied()).collect();
            constraints.of_edges.insert(edge, of_edge);
        }
        for (vertex, source) in (0..).zip(&made.vertices) {
            if let VertexSource::Corner(node) = *source {
                constraints.corners.push(vertex);
                constraints.of_vertices.insert(vertex, self.planes_at(node, &numbers));
            }
        }
        constraints
    }

    /// The faces of the planes.
    fn faces(&self, made: &FeatureLayout, planes: &[(u32, PlaneEquation)]) -> Planes {
        let mut rims = Rims::new(*self, made, planes);
        let faces = planes.iter().map(|&(region, plane)| {
            let Region { loops, triangles, .. } = &self.regions.regions[region as usize];
            let [a, b, _] = self.mesh.triangles()[triangles[0] as usize];
            let [a, b] = [a, b].map(|node| self.mesh.points()[node as usize]);
            let origin = a - (plane.normal.dot(a) - plane.offset) * plane.normal;
            let frame = Frame::new(origin, plane.normal, b - a)
                .or_else(|| Frame::new(origin, plane.normal, plane.normal.any_orthonormal_vector()))
                .expect("a direction at right angles to the normal");
            let loops = loops.iter().map(|sides| sides.iter().flat_map(|side| rims.of(side)).collect());
            PlaneFace { plane: Plane(frame), loops: loops.collect(), label: self.label(region) }
        });
        let faces = faces.collect();
        Planes { vertices: rims.further, faces }
    }
}

/// What the loops of planes are made of.
struct Rims<'a> {
    part: Part<'a>,
    planes: &'a [(u32, PlaneEquation)],
    numbers: BTreeMap<u32, u32>,
    /// By chain, its edges of the layout with the lengths at which their first sides begin and end.
    edges: BTreeMap<u32, Vec<(u32, [f64; 2])>>,
    /// By node, the vertex at a corner.
    corners: BTreeMap<u32, RimVertex>,
    further: Vec<DVec3>,
}

impl<'a> Rims<'a> {
    fn new(part: Part<'a>, made: &FeatureLayout, planes: &'a [(u32, PlaneEquation)]) -> Self {
        let mut edges: BTreeMap<u32, Vec<(u32, [f64; 2])>> = BTreeMap::new();
        for (edge, span) in (0..).zip(&made.spans) {
            if let Some(span) = span {
                edges.entry(span.chain).or_default().push((edge, [span.from, span.to]));
            }
        }
        for of_chain in edges.values_mut() {
            of_chain.sort_by(|a, b| a.1[0].min(a.1[1]).total_cmp(&b.1[0].min(b.1[1])));
        }
        let corners = (0..).zip(&made.vertices).filter_map(|(vertex, source)| match *source {
            VertexSource::Corner(node) => Some((node, RimVertex::Layout(vertex))),
            _ => None,
        });
        Self {
            part,
            planes,
            numbers: (0..).zip(planes).map(|(number, &(region, _))| (region, number)).collect(),
            edges,
            corners: corners.collect(),
            further: Vec::new(),
        }
    }

    /// The edges along a side of a plane.
    fn of(&mut self, side: &Side) -> Vec<Rim> {
        let Some(edges) = self.edges.get(&side.chain) else {
            return vec![Rim::Line([side.from, side.to].map(|node| self.vertex(node)))];
        };
        let rim = |&(edge, [from, to]): &(u32, [f64; 2])| {
            Rim::Edge(HalfEdge { edge, is_forward: (from < to) == side.is_forward })
        };
        let mut rims: Vec<Rim> = edges.iter().map(rim).collect();
        if !side.is_forward {
            rims.reverse();
        }
        rims
    }

    /// The vertex at a corner; where the patches have none, a new one in all its planes.
    fn vertex(&mut self, node: u32) -> RimVertex {
        if let Some(&vertex) = self.corners.get(&node) {
            return vertex;
        }
        let planes = self.part.planes_at(node, &self.numbers);
        let planes = planes.into_iter().map(|number| self.planes[number as usize].1);
        let place = nearest_in(planes, self.part.mesh.points()[node as usize]);
        self.further.push(place);
        let vertex = RimVertex::Further(self.further.len() as u32 - 1);
        self.corners.insert(node, vertex);
        vertex
    }
}
