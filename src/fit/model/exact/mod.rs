//! Models of exact faces: planes and cylinders that meet in lines, circles and ellipses.
//!
//! ```text
//! features -> regions -> carriers -> directions made parallel and square
//!          -> edges where two carriers meet, vertices where three do -> loops, seams -> faces
//! ```
//! Everything is checked against the mesh before it counts: nodes near their edges and faces, Euler's formula, the
//! volume. A part that is not exact throughout is none here, and told by the first [`Obstacle`].

pub(super) mod draft;
pub(super) mod edges;
pub(super) mod evidence;
mod measure;
pub(super) mod recognize;
pub(super) mod relations;
mod rim;
mod seam;
pub(super) mod split;
#[cfg(test)]
mod tests;

pub use evidence::Limits;
pub use recognize::{Recognized, recognize};

use super::ModelReport;
use crate::control::{Cancelled, Pool, Watch};
use crate::memory::{self, CollectVec};
use crate::mesh::{FacetNormals, FeatureOptions, Features, Mesh, Region, Regions};
use crate::model::{Builder, Carrier, FaceId, Model, ModelError, Role};
use draft::{Draft, Scale};
use glam::{DVec2, DVec3};
use recognize::recognize_region;
use split::{Part, Splitting};
use std::f64::consts::PI;
use std::time::Instant;

/// What keeps a mesh from being a model of exact faces.
#[derive(Debug, Clone, PartialEq)]
pub enum Obstacle {
    /// The features cannot be found.
    Features(crate::mesh::FeatureError),
    /// A region lies on no plane or cylinder.
    Region {
        /// By its first triangle.
        region: usize,
    },
    /// The carriers beside a chain of features do not meet in a line or conic near it.
    Edge {
        /// Among the chains of features between regions.
        chain: usize,
    },
    /// The carriers around a corner do not meet in a point near it.
    Corner {
        /// There.
        node: u32,
    },
    /// The loops of a region do not bound a face of its carrier.
    Loops {
        /// By its first triangle.
        region: usize,
    },
    /// Faces and edges do not fit together.
    Model(ModelError),
    /// The faces enclose another volume or have other handles than the mesh.
    Shape,
    /// The call is to end.
    Cancelled(Cancelled),
}

impl From<Cancelled> for Obstacle {
    fn from(cancelled: Cancelled) -> Self {
        Self::Cancelled(cancelled)
    }
}

/// A mesh as a model of exact faces.
#[derive(Debug, Clone)]
pub struct ExactFit {
    draft: Draft,
    /// The model of this mesh alone.
    pub model: Model,
    /// The face and parameters of each node; None for a node without triangles.
    pub places: Vec<Option<(FaceId, DVec2)>>,
    /// The error of each node; NaN without a place.
    pub errors: Vec<f64>,
    /// How good it is.
    pub report: ModelReport,
}

impl ExactFit {
    /// The fit of a mesh that lies elsewhere.
    fn moved(self, mesh: &Mesh, by: DVec3) -> Result<Self, Obstacle> {
        let draft = self.draft.moved(by).ok_or(Obstacle::Shape)?;
        let role = if mesh.loops().is_empty() { Role::Solid } else { Role::Open };
        let model = joined(&[&draft], &[role]).map_err(Obstacle::Model)?;
        Ok(Self { draft, model, ..self })
    }
}

/// Makes a model of exact faces of a mesh in one piece, within a tolerance in model units: a solid, or a shell if the mesh
/// has a border.
pub fn fit_exact(
    mesh: &Mesh,
    tolerance: f64,
    features: &FeatureOptions,
    pool: &Pool,
) -> Result<ExactFit, Obstacle> {
    fit_exact_by((mesh, &FacetNormals::new(mesh)), tolerance, features, pool)
}

/// The same by normals that are found once for several fits.
pub(super) fn fit_exact_by(
    (mesh, facets): (&Mesh, &FacetNormals),
    tolerance: f64,
    features: &FeatureOptions,
    pool: &Pool,
) -> Result<ExactFit, Obstacle> {
    if let Some(centre) = far_centre(mesh) {
        let mut near = mesh.clone();
        let points = mesh.points().iter().map(|&point| point - centre).collect_vec();
        near.set_points(points).map_err(|_| Obstacle::Shape)?;
        return fit_exact_by((&near, facets), tolerance, features, pool)?.moved(mesh, centre);
    }
    let start = Instant::now();
    let found = mesh.find_features_by(facets, features, pool).map_err(Obstacle::Features)?;
    let scale = Scale { tolerance, noise: 0.0, diagonal: mesh.diagonal() };
    let fit_at = |scale: &Scale| fit_segments((mesh, facets), &found, scale, features, pool);
    let mut fit = fit_at(&scale);
    // on coarse round walls the estimate finds noise where there is none, and over all nodes also beside edges
    let estimates =
        [found.regions(mesh).noise(mesh), found.noise].map(|noise| noise.min(MOST_NOISE) * mean_edge(mesh));
    for noise in estimates.into_iter().filter(|noise| *noise > 0.0) {
        if matches!(&fit, Ok(_) | Err(Obstacle::Cancelled(_))) {
            break;
        }
        fit = fit_at(&Scale { noise, ..scale });
    }
    let mut fit = fit?;
    fit.report.fit_seconds = start.elapsed().as_secs_f64();
    Ok(fit)
}

/// The most that is taken for noise, by the mean length of edges: what is off by more has another shape.
pub(super) const MOST_NOISE: f64 = 0.1;

/// Where a mesh lies that is so far from the origin that rounding of its places is no longer that of its lengths.
fn far_centre(mesh: &Mesh) -> Option<DVec3> {
    /// So many diagonals away rounding takes three of the sixteen digits.
    const FAR: f64 = 1e3;
    let bounds = mesh.bounds();
    let centre = 0.5 * (DVec3::from_slice(&bounds.min) + DVec3::from_slice(&bounds.max));
    (centre.length() > FAR * bounds.diagonal()).then_some(centre)
}

/// With noise of the given size.
fn fit_segments(
    (mesh, facets): (&Mesh, &FacetNormals),
    found: &Features,
    scale: &Scale,
    options: &FeatureOptions,
    pool: &Pool,
) -> Result<ExactFit, Obstacle> {
    let (labels, watch) = (options.labels, pool.watch());
    let Segmented { features, regions, found } = segment((mesh, facets), found, scale, options, pool)?;
    watch.check()?;
    let draft = Draft::new(mesh, &features, &regions, &found, labels, scale)?;
    let role = if mesh.loops().is_empty() { Role::Solid } else { Role::Open };
    let model = joined(&[&draft], &[role]).map_err(Obstacle::Model)?;
    watch.check()?;
    let measured = measure::measure(mesh, &features, &regions, &model, scale, watch)?;
    Ok(ExactFit { draft, model, places: measured.places, errors: measured.errors, report: measured.report })
}

/// The model of several meshes, each a shell with its role, and the first face of each.
pub(super) fn together(fits: &[&ExactFit], roles: &[Role]) -> Result<(Model, Vec<usize>), ModelError> {
    let drafts: Vec<&Draft> = fits.iter().map(|fit| &fit.draft).collect();
    let starts = drafts.iter().scan(0, |next, draft| {
        let start = *next;
        *next += draft.faces.len();
        Some(start)
    });
    Ok((joined(&drafts, roles)?, starts.collect()))
}

fn joined(drafts: &[&Draft], roles: &[Role]) -> Result<Model, ModelError> {
    let mut builder = Builder::default();
    for (draft, &role) in drafts.iter().zip(roles) {
        let faces = draft.build(&mut builder)?;
        builder.shell(faces, role);
    }
    builder.finish()
}

/// A mesh in regions that all have a carrier.
struct Segmented {
    features: Features,
    regions: Regions,
    found: Vec<Recognized>,
}

fn segment(
    (mesh, facets): (&Mesh, &FacetNormals),
    features: &Features,
    scale: &Scale,
    options: &FeatureOptions,
    pool: &Pool,
) -> Result<Segmented, Obstacle> {
    let limits = Limits::new(scale.tolerance, scale.noise);
    let normals = facets.get(mesh, scale.noise > 0.0, pool);
    let parts = parts(mesh, normals, &features.regions(mesh), &limits, pool.watch())?;
    let mut parts = merge(mesh, parts, &limits, scale.tolerance);
    relations::align(&mut parts, scale.diagonal);
    let mut part_of = memory::filled(0, mesh.triangles().len());
    for (number, part) in (0..).zip(&parts) {
        part.triangles.iter().for_each(|&triangle| part_of[triangle as usize] = number);
    }
    // corners of coarse circles and edges that end inside are none between exact faces; on a border only they part lines
    let corner_angle = if mesh.loops().is_empty() { PI } else { options.corner_angle };
    let options = FeatureOptions {
        sharp_angle: None,
        corner_angle,
        least_length: 0.0,
        labels: &part_of,
        label_angle: 0.0,
        sharp_edges: &[],
        ..*options
    };
    let features = mesh.find_features_by(facets, &options, pool).map_err(Obstacle::Features)?;
    let regions = features.regions(mesh);
    let of_region = |region: &Region| parts[part_of[region.triangles[0] as usize] as usize].found.clone();
    let mut found: Vec<Recognized> = regions.regions.iter().map(of_region).collect();
    touch_neighbours(&mut found, &regions, scale.diagonal);
    Ok(Segmented { features, regions, found })
}

/// Regions with their carriers; a smooth region of several carriers in parts.
fn parts(
    mesh: &Mesh,
    normals: &[DVec3],
    regions: &Regions,
    limits: &Limits,
    watch: &Watch,
) -> Result<Vec<Part>, Obstacle> {
    let mut parts = Vec::new();
    for (region, of) in regions.regions.iter().enumerate() {
        watch.check()?;
        match recognize_region(mesh, &of.triangles, limits) {
            Some(found) => parts.push(Part { triangles: of.triangles.clone(), found }),
            None => {
                let splitting = Splitting { mesh, normals, limits, watch };
                let found = splitting
                    .split(&of.triangles)
                    .or_else(|| splitting.split_at_blunt_edges(&of.triangles))
                    .or_else(|| splitting.split_into_planes(&of.triangles));
                watch.check()?;
                parts.extend(found.ok_or(Obstacle::Region { region })?);
            }
        }
    }
    Ok(parts)
}

/// Parts that lie on one carrier and hang together as one: halves of a cylinder, planes that labels or noise divide, and
/// slivers narrower than the tolerance.
fn merge(mesh: &Mesh, mut parts: Vec<Part>, limits: &Limits, tolerance: f64) -> Vec<Part> {
    let mut part_of = memory::filled(0, mesh.triangles().len());
    for (number, part) in parts.iter().enumerate() {
        part.triangles.iter().for_each(|&triangle| part_of[triangle as usize] = number);
    }
    let mut pairs: Vec<[usize; 2]> = Vec::new();
    for edge in mesh.edges() {
        let Some(twin) = mesh.topology().twin(edge) else { continue };
        let [a, b] = [edge, twin].map(|side| part_of[side.triangle()]);
        if a != b {
            pairs.push([a.min(b), a.max(b)]);
        }
    }
    pairs.sort_unstable();
    pairs.dedup();
    // by part: the one that it has become a piece of
    let mut root: Vec<usize> = (0..parts.len()).collect();
    let whole = |root: &[usize], mut part: usize| {
        while root[part] != part {
            part = root[part];
        }
        part
    };
    for pair in pairs {
        let [a, b] = pair.map(|part| whole(&root, part));
        if a == b || !may_be_one(&parts[a].found, &parts[b].found, limits, tolerance) {
            continue;
        }
        let mut triangles = [&parts[a].triangles[..], &parts[b].triangles[..]].concat();
        triangles.sort_unstable();
        if let Some(found) = recognize_region(mesh, &triangles, limits) {
            parts[a] = Part { triangles, found };
            root[b] = a;
        }
    }
    (0..).zip(parts).filter(|(number, _)| root[*number] == *number).map(|(_, part)| part).collect()
}

/// Whether each of two parts lies nearly on the carrier of the other, or one is a sliver on it.
fn may_be_one(a: &Recognized, b: &Recognized, limits: &Limits, tolerance: f64) -> bool {
    /// A carrier of a small part is off by more than the limits at the far end of a large one.
    const SLACK: f64 = 10.0;
    let loose = limits.scaled(SLACK);
    if is_sliver_on(a, &b.carrier, tolerance) || is_sliver_on(b, &a.carrier, tolerance) {
        return true;
    }
    let is_same_kind = matches!(
        (&a.carrier, &b.carrier),
        (Carrier::Plane(_), Carrier::Plane(_)) | (Carrier::Cylinder(_), Carrier::Cylinder(_))
    );
    is_same_kind && (a.evidence.accepts(&b.carrier, &loose) || b.evidence.accepts(&a.carrier, &loose))
}

/// Whether a part is so narrow that its facets do not tell which way they look, and lies on the carrier beside it: on a rim a
/// triangle between three nodes of a wall lies in the end plane.
fn is_sliver_on(part: &Recognized, carrier: &Carrier, tolerance: f64) -> bool {
    let evidence = &part.evidence;
    evidence.area() <= tolerance * evidence.extent() && evidence.holds(carrier, &Limits::new(tolerance, 0.0))
}

/// Sine of the angle below which faces are meant to be tangent along their edge: five degrees.
const TANGENT: f64 = 0.087;

/// Lets cylinders touch the planes that they meet smoothly.
fn touch_neighbours(found: &mut [Recognized], regions: &Regions, diagonal: f64) {
    for region in 0..found.len() {
        let Carrier::Cylinder(cylinder) = &found[region].carrier else { continue };
        let is_tangent = |plane: &crate::model::Plane| {
            let frame = plane.0;
            let height = (cylinder.frame().origin() - frame.origin()).dot(frame.z()).abs();
            let is_along = frame.z().dot(cylinder.frame().z()).abs() <= 1e-10;
            // of a chord at this height the sine is the root of 1 - (height / radius)^2
            is_along && (1.0 - (height / cylinder.radius()).powi(2)).abs() <= TANGENT * TANGENT
        };
        let beside = regions.neighbours(region as u32).into_iter();
        let planes: Vec<crate::model::Plane> = beside
            .filter_map(|other| match &found[other as usize].carrier {
                Carrier::Plane(plane) if is_tangent(plane) => Some(*plane),
                _ => None,
            })
            .collect();
        if planes.is_empty() {
            continue;
        }
        if let Some(touching) = relations::touch(&found[region], &planes, diagonal) {
            found[region].carrier = touching.into();
        }
    }
}

pub(super) fn mean_edge(mesh: &Mesh) -> f64 {
    let place = |node: u32| mesh.points()[node as usize];
    let length = |edge: crate::mesh::HalfEdge| {
        place(edge.origin(mesh.triangles())).distance(place(edge.target(mesh.triangles())))
    };
    crate::summary::sum(mesh.edges().map(length)) / mesh.edge_count().max(1) as f64
}
