//! The closed components of a mesh as bodies: which lie inside which, and which way they are turned.

use super::error::ModelFitError;
use super::report::mesh_volume;
use crate::geometry::Bounds;
use crate::memory::{self, CollectVec};
use crate::mesh::{FacetNormals, Mesh, Piece};
use glam::DVec3;
use std::f64::consts::PI;
use std::sync::OnceLock;

/// A component. The fronts of a closed one look out of the material: of a solid outwards, of a void inwards.
#[derive(Debug, Clone)]
pub(super) struct Body {
    /// Its triangles, with nodes of its own.
    pub mesh: Mesh,
    /// The node of the whole mesh that each of its nodes is.
    pub nodes: Vec<u32>,
    /// The triangle of the whole mesh that each of its triangles is.
    pub triangles: Vec<u32>,
    /// The body in which it is a void, by its number among all.
    pub void_in: Option<usize>,
    /// Whether it was turned inside out.
    pub is_turned: bool,
    /// The normals of its facets, once they are asked for.
    facets: OnceLock<FacetNormals>,
}

impl Body {
    pub(super) fn facets(&self) -> &FacetNormals {
        self.facets.get_or_init(|| FacetNormals::new(&self.mesh))
    }
}

/// Most components: each gets a fit of its own.
pub(super) const MAX_COMPONENTS: usize = 1000;
/// A volume below this part of the cube of the diagonal is none: rounding of coordinates.
const LEAST_VOLUME: f64 = 1e-12;

/// The bodies of a mesh without boundary, those around others first.
pub(super) fn bodies(mesh: &Mesh) -> Result<Vec<Body>, ModelFitError> {
    if let Some(first) = mesh.loops().first() {
        return Err(ModelFitError::Open { loops: mesh.loops().len(), node: first[0] as usize });
    }
    if mesh.component_count() > MAX_COMPONENTS {
        return Err(ModelFitError::Components { count: mesh.component_count(), limit: MAX_COMPONENTS });
    }
    let parts = mesh.split_components().expect("a component of a mesh is one");
    let mut triangles = triangles_of_components(mesh);
    let boxes: Vec<Bounds> = parts.iter().map(|part| part.mesh.bounds()).collect_vec();
    let around = |inner: usize| -> Vec<usize> {
        let place = parts[inner].mesh.points()[0];
        let holds = |&outer: &usize| {
            outer != inner
                && is_inside(&boxes[inner], &boxes[outer])
                && winding(&parts[outer].mesh, place).abs() > 0.5
        };
        (0..parts.len()).filter(holds).collect_vec()
    };
    let around: Vec<Vec<usize>> = (0..parts.len()).map(around).collect_vec();
    let mut order: Vec<usize> = (0..parts.len()).collect_vec();
    order.sort_by_key(|&part| around[part].len());
    let mut number = memory::filled(0, parts.len());
    order.iter().enumerate().for_each(|(place, &part)| number[part] = place);
    let mut parts: Vec<Option<Piece>> = parts.into_iter().map(Some).collect_vec();
    let body = |&part: &usize| {
        let Piece { mesh, nodes } = parts[part].take().expect("each part is one body");
        let volume = mesh_volume(&mesh);
        if volume.abs() <= LEAST_VOLUME * mesh.diagonal().powi(3) {
            return Err(ModelFitError::ZeroVolume { node: nodes[0] as usize });
        }
        let depth = around[part].len();
        let is_void = depth % 2 == 1;
        // of those around it the innermost has all others around itself
        let innermost = around[part].iter().copied().max_by_key(|&outer| around[outer].len());
        let is_turned = (volume < 0.0) != is_void;
        let mesh = if is_turned { turned(&mesh) } else { mesh };
        let triangles = std::mem::take(&mut triangles[part]);
        Ok(Body {
            mesh,
            nodes,
            triangles,
            void_in: innermost.filter(|_| is_void).map(|outer| number[outer]),
            is_turned,
            facets: OnceLock::new(),
        })
    };
    order.iter().map(body).collect()
}

/// The components of a mesh as they are: shells that may have borders.
pub(super) fn shells(mesh: &Mesh) -> Vec<Body> {
    let parts = mesh.split_components().expect("a component of a mesh is one");
    let triangles = triangles_of_components(mesh);
    let shell = |(part, triangles): (Piece, Vec<u32>)| Body {
        mesh: part.mesh,
        nodes: part.nodes,
        triangles,
        void_in: None,
        is_turned: false,
        facets: OnceLock::new(),
    };
    parts.into_iter().zip(triangles).map(shell).collect_vec()
}

fn triangles_of_components(mesh: &Mesh) -> Vec<Vec<u32>> {
    let (component, count) = mesh.topology().components();
    let mut triangles = memory::filled(Vec::new(), count);
    (0..).zip(component).for_each(|(triangle, part)| triangles[part as usize].push(triangle));
    triangles
}

/// The same with all triangles turned over.
fn turned(mesh: &Mesh) -> Mesh {
    let triangles = mesh.triangles().iter().map(|&[a, b, c]| [a, c, b]).collect_vec();
    Mesh::new(mesh.points().to_vec(), triangles).expect("a mesh turned inside out is one")
}

fn is_inside(inner: &Bounds, outer: &Bounds) -> bool {
    (0..3).all(|k| outer.min[k] <= inner.min[k] && inner.max[k] <= outer.max[k])
}

/// How often a closed mesh goes around a place (A. van Oosterom, J. Strackee, "The solid angle of a plane triangle", IEEE
/// Trans. Biomed. Eng. 30 (1983)).
fn winding(mesh: &Mesh, place: DVec3) -> f64 {
    let angle = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|node| mesh.points()[node as usize] - place);
        let [p, q, r] = [a, b, c].map(DVec3::length);
        a.dot(b.cross(c)).atan2(p * q * r + a.dot(b) * r + b.dot(c) * p + c.dot(a) * q)
    };
    crate::summary::sum(mesh.triangles().iter().map(angle)) / (2.0 * PI)
}
